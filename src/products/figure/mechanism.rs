//! Draws the mechanism of a structure that falls: the displaced blocks, their present positions as dashed outlines,
//! hinges and sliding joints.
//!
//! Blocks move along their velocities in finite rigid motions, so they keep their shapes. The amplitude is chosen for
//! visibility, but blocks do not visibly overlap. For each part that falls one elementary mechanism is drawn
//! ([`Analysis::elementary`](crate::mechanics::analysis::Analysis::elementary)). In the motion that proves a fall, a sliding
//! block also lifts, by μ per metre of sliding. If possible, the block is drawn sliding along its joint; otherwise
//! the legend states that it lifts. If the scene only allows contact forces in a safe part of each interface (the key
//! `kernel`), a block turns about an end of this safe part. Its corner is then drawn inside the neighbouring block.

mod joint_mark;

pub(crate) use joint_mark::{joint_entries, joint_marks};

use super::collapse;
use super::content::{About, PanelContent};
use super::context::FigureContext;
use super::description;
use super::displacement::{Course, Displacement};
use super::joint::{Joint, joints};
use super::label;
use super::legend::{self, Entry};
use super::panel::composed;
use super::pen::{DISPLACED_OPACITY, MIN_READABLE_UNIT_LENGTH, Pen};
use super::verdict;
use super::words::quantity;
use crate::geometry::Bounds;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, MarginKind, Motion, Verdict};
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::{Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Theme};
use crate::products::wording;

/// Returns a box around all displaced blocks in their displaced positions, metres; `None` if no block is displaced.
pub(crate) fn reach(analysis: &Analysis, displaced: &[Option<Displacement>]) -> Option<Bounds> {
    let blocks = displaced.iter().zip(&analysis.scene.blocks);
    let moved = blocks.filter_map(|(displacement, block)| Some((displacement.as_ref()?, block)));
    Bounds::from_points(moved.flat_map(|(displacement, block)| {
        let outline = block.body.polygon.outline().iter();
        outline.map(|p| displacement.moved(*p))
    }))
}

/// The figure of a collapse mechanism.
pub(crate) struct Mechanism;

impl PanelContent for Mechanism {
    fn about(&self) -> About {
        About {
            name: "mechanism",
            help: "How the structure falls: blocks displaced along the mechanism, hinges and slips",
            title: "How a dry-laid structure falls",
            needs_elementary_mechanisms: true,
            ..About::default()
        }
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        let falls = |frame: &FrameAnalysis| frame.verdict == Verdict::Unstable;
        if analysis.frames.iter().any(falls) { &[MarginKind::LoadFactor, MarginKind::Friction] } else { &[] }
    }

    fn course(&self, analysis: &Analysis, frame: usize, unit: f64) -> Course {
        Course::new(analysis, frame, unit)
    }

    fn headline(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let frame_analysis = &context.analysis.frames[frame];
        wording::margin::falls_headline(&context.analysis.scene, frame_analysis)
            .unwrap_or_else(|| verdict::badge(frame_analysis).to_owned())
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let how = collapse::reason(context.analysis, frame);
        // Panels next to each other have no room for a longer text.
        let forces = match context.analysis.frames.len() {
            1 => collapse::forces(context.analysis, frame),
            _ => String::new(),
        };
        let parts = [how, forces].into_iter().filter(|part| !part.is_empty());
        parts.collect::<Vec<_>>().join("; ")
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, camera) = (pen.context, pen.camera);
        let mut ink = label::ink(pen);
        let mut blocks = pen.blocks();
        blocks.items.extend(ghosts(pen));
        blocks.items.extend(displaced(pen));
        for (id, _) in moved(pen) {
            for edge in context.analysis.scene.blocks[id.0].body.polygon.edges() {
                let [from, to] = [edge.from, edge.to].map(|p| camera.place(pen.moved(id, p)));
                ink.line(from, to, pen.line);
            }
        }
        let [slips, hinges] = joint_marks(pen, context.analysis, &mut ink);
        let loads = pen.arrows(false);
        composed(pen, view, blocks, vec![slips, hinges, loads], ink)
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        let analysis = context.analysis;
        let falling = (0..analysis.frames.len()).filter(|f| analysis.frames[*f].verdict == Verdict::Unstable);
        let mut entries = Vec::new();
        let joints: Vec<Joint> = falling.clone().flat_map(|f| joints(analysis, f)).collect();
        if falling.clone().any(|f| !analysis.frames[f].mechanism.is_empty()) {
            let [stood, goes] = if context.options.is_column() {
                ["blocks now", "how blocks begin to move, enlarged"]
            } else {
                ["where the blocks stand now", "how the blocks begin to move, enlarged"]
            };
            entries.push(Entry::Symbol(ghost_symbol, SYMBOL_WIDTH, stood.to_owned()));
            entries.push(Entry::Symbol(moved_symbol, SYMBOL_WIDTH, goes.to_owned()));
        }
        entries.extend(joint_entries(&joints));
        entries.extend(legend::loads(context));
        entries.extend(legend::robots(context));
        entries
    }
}

/// Returns the blocks that are drawn in displaced positions, with their motions in the mechanism.
fn moved<'a>(pen: &'a Pen<'_>) -> impl Iterator<Item = (BlockId, &'a Motion)> {
    let motions = pen.context.analysis.frames[pen.number].mechanism.iter();
    motions.map(|m| (m.block, m)).filter(|m| pen.displacement(m.0).is_some())
}

/// Draws dashed outlines of the moving blocks in their present positions. Returns `None` if no block moves.
fn ghosts(pen: &Pen<'_>) -> Option<Item> {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let mut outline = Outline::default();
    for (id, _) in moved(pen) {
        outline.extend(pen.camera.polygon(&scene.blocks[id.0].body.polygon));
    }
    let width = pen.line.clamp(0.6, 1.1);
    let stroke = Stroke::new(theme.faint, width).dashed([3.6 * width, 2.8 * width]);
    // Small outlines are partly transparent, so that many of them do not hide the displaced blocks.
    let opacity = if pen.unit() < MIN_READABLE_UNIT_LENGTH { 0.6 } else { 1.0 };
    let path = Path::stroked(outline, stroke).with_opacity(opacity);
    let ghosts = Group::with_class("ghosts").titled("Where the blocks that move stand now");
    (!path.outline.segments.is_empty()).then(|| ghosts.with(path).into())
}

/// Draws the moving blocks in their displaced positions.
fn displaced(pen: &Pen<'_>) -> Vec<Item> {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let edge = theme.motion.mixed(theme.ink, 0.25);
    let drawn = |group: Group, outline: Outline| -> Item {
        let fill = Path::filled(outline.clone(), theme.motion).with_opacity(DISPLACED_OPACITY);
        let line = Path::stroked(outline, Stroke::new(edge, pen.line));
        group.with(fill).with(line).into()
    };
    let outline = |id: BlockId| {
        let mut outline = Outline::default();
        for ring in scene.blocks[id.0].body.polygon.rings() {
            let corners = ring.iter().map(|p| pen.camera.place(pen.moved(id, *p)));
            outline.extend(Outline::ring(corners));
        }
        outline
    };
    if pen.many() {
        let mut all = Outline::default();
        for (id, _) in moved(pen) {
            all.extend(outline(id));
        }
        let group = Group::with_class("displaced").titled("The blocks that move");
        return vec![drawn(group, all)];
    }
    moved(pen)
        .map(|(id, motion)| {
            let title = description::motion(scene, motion);
            let mut group = Group::with_class("displaced").titled(title);
            let weight = quantity(scene.blocks[id.0].weight, scene.units.force());
            group.description = format!("weight {weight}");
            drawn(group, outline(id))
        })
        .collect()
}

/// Width of the symbol of a block in the legend, pixels.
const SYMBOL_WIDTH: f64 = 20.0;

fn ghost_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let stroke = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
    vec![Path::stroked(Outline::rounded(swatch(at), 0.0), stroke).into()]
}

fn moved_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let outline = Outline::rounded(swatch(at), 0.0);
    let edge = Stroke::new(theme.motion.mixed(theme.ink, 0.25), 1.2);
    vec![
        Path::filled(outline.clone(), theme.motion).with_opacity(DISPLACED_OPACITY).into(),
        Path::stroked(outline, edge).into(),
    ]
}

fn swatch(at: PagePoint) -> PageRect {
    PageRect { at: at.moved(0.0, -6.5), width: SYMBOL_WIDTH, height: 13.0 }
}
