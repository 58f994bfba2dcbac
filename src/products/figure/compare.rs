//! Draws the differences between consecutive frames: blocks that were added or removed, and interfaces whose forces
//! changed.
//!
//! Each frame is compared with the previous frame. Arrows have the same scale in all frames. A ring marks an interface
//! whose force changed by more than 5 % of the larger of the two forces. The previous force is drawn there in a faint
//! colour below the present force.

use super::arrow::{ArrowKind, ForceArrow, Marks};
use super::change::{ForceChange, bodies, count_in_words, noise, shared_forces};
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::description;
use super::label;
use super::legend::{self, Entry};
use super::mark;
use super::panel::composed;
use super::pen::Pen;
use super::words::{force, listed, quantity};
use crate::geometry::{Bounds, Vector};
use crate::mechanics::analysis::{Analysis, Verdict};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::{Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Theme};

/// The radius of the ring that marks a change, in unit lengths, with its least and largest allowed radius in pixels.
const RING_RADIUS: (f64, f64, f64) = (0.16, 4.0, 9.0);
/// Width of the outlines of blocks that are gone, pixels.
const GONE_WIDTH: f64 = 1.6;
/// Largest number of blocks that a sentence names.
const MAX_NAMED_BLOCKS: usize = 4;

/// Returns the blocks that were added since the previous frame, and the blocks that were removed since then. Both lists
/// are empty for the first frame.
fn blocks(analysis: &Analysis, frame: usize) -> [Vec<BlockId>; 2] {
    let Some(earlier) = frame.checked_sub(1) else {
        return [Vec::new(), Vec::new()];
    };
    let frames = &analysis.scene.frames;
    let (now, before) = (&frames[frame].placed, &frames[earlier].placed);
    let without = |a: &[BlockId], b: &[BlockId]| a.iter().copied().filter(|id| !b.contains(id)).collect();
    [without(now, before), without(before, now)]
}

/// Returns the blocks of `gone` whose outlines differ from the outlines of all blocks of `new`.
fn left_behind(scene: &Scene, new: &[BlockId], gone: &[BlockId]) -> Vec<BlockId> {
    let outline = |id: &BlockId| scene.blocks[id.0].body.polygon.outline();
    let is_left = |id: &BlockId| !new.iter().any(|other| outline(other) == outline(id));
    gone.iter().copied().filter(is_left).collect()
}

/// Compares the forces of a frame with those of the previous frame. Returns the interfaces that both frames have and
/// whose forces changed, and the number of interfaces that both frames have.
fn changes(analysis: &Analysis, frame: usize) -> (Vec<ForceChange<'_>>, usize) {
    let Some(earlier) = frame.checked_sub(1) else {
        return (Vec::new(), 0);
    };
    let scene = &*analysis.scene;
    let contacts = [earlier, frame].map(|f| (scene, &analysis.frames[f].contacts[..]));
    let shared = shared_forces(contacts);
    let count = shared.len();
    let noise = noise(shared.iter().map(ForceChange::larger));
    let changed = shared.into_iter().filter(|change| change.is_change(noise));
    (changed.collect(), count)
}

/// The figure of the changes between frames.
pub(crate) struct Comparison;

impl PanelContent for Comparison {
    fn about(&self) -> About {
        About {
            name: "compare",
            help: "Changes between consecutive frames, or between the last frames of two scenes",
            title: "Changes in a dry-laid structure",
            shares_arrow_scale: true,
            draws_forces: true,
            stretches_arrows: true,
            ..About::default()
        }
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        mark::largest(of.analysis, of.frame, of.options)
    }

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        mark::marks(of.analysis, of.frame, of.options, newtons_per_unit)
    }

    fn extent(&self, of: FrameSource<'_>, _unit: f64, _marks: &Marks) -> Option<Bounds> {
        let FrameSource { analysis, frame, .. } = of;
        let [_, gone] = blocks(analysis, frame);
        let bounds = |id: &BlockId| analysis.scene.blocks[id.0].body.polygon.bounds();
        gone.iter().map(bounds).reduce(Bounds::union)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame, camera) = (pen.context, pen.number, pen.camera);
        let (scene, theme) = (&context.analysis.scene, &context.options.theme);
        let mut ink = label::ink(pen);
        let outlines = |ids: &[BlockId]| {
            let mut outline = Outline::default();
            for id in ids {
                outline.extend(camera.polygon(&scene.blocks[id.0].body.polygon));
            }
            outline
        };
        let [came, went] = blocks(context.analysis, frame);
        let went = left_behind(scene, &came, &went);
        let mut parts = Vec::new();
        for id in &went {
            for edge in scene.blocks[id.0].body.polygon.edges() {
                ink.line(camera.place(edge.from), camera.place(edge.to), GONE_WIDTH);
            }
        }
        if !went.is_empty() {
            let gone = Group::with_class("gone").titled("Blocks that are gone");
            parts.push(gone.with(gone_path(outlines(&went), theme)));
        }
        if !came.is_empty() {
            let new = Group::with_class("new").titled("Blocks that are new");
            parts.push(new.with(new_path(outlines(&came), theme)));
        }
        let mut before = Group::with_class("before");
        let mut changed = Group::with_class("changed");
        let (share, least, most) = RING_RADIUS;
        let newtons = context.marks[frame].newtons_per_unit;
        let true_lines = mark::marks(context.analysis, frame, context.options, newtons);
        let radius = (share * pen.unit()).clamp(least, most);
        for change in changes(context.analysis, frame).0 {
            let now = change.contacts[1];
            let at = camera.place(now.resultant.at);
            let pair = description::pair(scene, now.interface.bodies);
            let [was, is] = change.amounts().map(|amount| quantity(amount, scene.units.force()));
            let title = format!("Between {pair}: {was} before, {is} now");
            ink.disc(at, radius + 1.0);
            let stroke = Stroke::new(theme.motion, 1.6);
            let ring = Path::stroked(Outline::circle(at, radius), stroke);
            let drawn = Group::with_class("change").titled(title);
            changed.items.push(drawn.with(ring).into());
            before.items.extend(previous_arrows(pen, &change, &true_lines));
        }
        parts.extend([before, pen.arrows(false), pen.arrows(true), changed]);
        composed(pen, view, pen.blocks(), parts, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let scene = &context.analysis.scene;
        let name = |id: &BlockId| &scene.blocks[id.0].id;
        let mut entries = legend::entries(context, unit);
        entries.retain(|entry| !matches!(entry, Entry::Amplitudes(..)) && !legend::is_limit(entry));
        let (mut came, mut went, mut changed) = (false, false, false);
        let mut altered = false;
        for frame in 0..context.analysis.frames.len() {
            let [new, gone] = blocks(context.analysis, frame);
            came |= !new.is_empty();
            altered |= new.iter().any(|id| gone.iter().any(|g| name(g) == name(id)));
            went |= !left_behind(scene, &new, &gone).is_empty();
            changed |= !changes(context.analysis, frame).0.is_empty();
        }
        if came {
            let words = if altered { "new or changed" } else { "new" };
            entries.push(Entry::Symbol(new_symbol, 20.0, words.to_owned()));
        }
        if went {
            let words = if altered { "gone, or the previous outline" } else { "gone" };
            entries.push(Entry::Symbol(gone_symbol, 20.0, words.to_owned()));
        }
        if changed {
            let what = "force changed by over 5 %; the previous force is faint".to_owned();
            entries.push(Entry::Symbol(ring_symbol, 14.0, what));
        }
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let analysis = context.analysis;

        let Some(earlier) = frame.checked_sub(1) else {
            return match analysis.frames.len() {
                1 => "there is only one frame, so there is nothing to compare".to_owned(),
                _ => String::new(),
            };
        };
        let [came, went] = blocks(analysis, frame);
        let mut stated = Vec::new();
        let verdicts = [earlier, frame].map(|f| analysis.frames[f].verdict);
        if verdicts[0] != verdicts[1] {
            stated.push(match verdicts[1] {
                Verdict::Stable => "stands, unlike the previous frame".to_owned(),
                Verdict::Unstable => "falls, unlike the previous frame".to_owned(),
                Verdict::Undecided => "undecided, unlike the previous frame".to_owned(),
            });
        }
        let names = |ids: &[BlockId]| -> Vec<String> {
            let names = ids.iter().map(|id| analysis.scene.blocks[id.0].id.clone());
            names.collect()
        };
        let (came, went) = (names(&came), names(&went));
        // `both` are the names of blocks that both frames contain, but with different outlines, weights or loads.
        let both: Vec<String> = came.iter().filter(|n| went.contains(n)).cloned().collect();
        let alone = |names: &[String]| -> Vec<String> { names.iter().filter(|n| !both.contains(n)).cloned().collect() };
        let loads: Vec<(&String, String)> =
            both.iter().filter_map(|name| Some((name, changed_load(analysis, [earlier, frame], name)?))).collect();
        let loaded = |name: &String| loads.iter().any(|(other, _)| *other == name);
        let reshaped: Vec<String> = both.iter().filter(|name| !loaded(name)).cloned().collect();
        for (names, how) in [(alone(&came), "new"), (alone(&went), "gone"), (reshaped, "changed")] {
            match names.len() {
                0 => {}
                n if n <= MAX_NAMED_BLOCKS => stated.push(format!("{how}: {}", listed(&names))),
                n => stated.push(format!("{how}: {n} blocks")),
            }
        }
        match loads.len() {
            n if n <= MAX_NAMED_BLOCKS => stated.extend(loads.into_iter().map(|(_, change)| change)),
            n => stated.push(format!("other loads on {n} blocks")),
        }
        let (changed, shared) = changes(analysis, frame);
        stated.push(count_in_words(changed.len(), shared));
        stated.join("; ")
    }
}

/// Describes how the sum of the loads on the block with this name changed between two frames: `load on block a: 2 kN at
/// 270° before, 3 kN at 270° now`. Returns `None` if it did not change.
fn changed_load(analysis: &Analysis, frames: [usize; 2], name: &str) -> Option<String> {
    let scene = &analysis.scene;
    let sum = |frame: usize| {
        let placed = &scene.frames[frame].placed;
        let own = scene.loads.iter().filter(|l| placed.contains(&l.block) && scene.blocks[l.block.0].id == name);
        own.fold((Vector::zeros(), 0.0), |(force, torque), load| (force + load.force, torque + load.torque))
    };
    let [was, is] = frames.map(sum);
    let words = |(load, turning): (Vector, f64)| match (load.norm() > 0.0, turning != 0.0) {
        (false, false) => "none".to_owned(),
        (false, true) => quantity(turning, scene.units.torque()),
        (true, false) => force(load, scene.units),
        (true, true) => format!("{} and {}", force(load, scene.units), quantity(turning, scene.units.torque())),
    };
    (was != is).then(|| format!("load on block {name}: {} before, {} now", words(was), words(is)))
}

/// Draws the previous force of a joint as a faint arrow on each of its blocks. `true_lines` are the arrows of the
/// present frame before they were moved off their lines of action.
fn previous_arrows(pen: &Pen<'_>, change: &ForceChange<'_>, true_lines: &Marks) -> Vec<Item> {
    let (context, theme) = (pen.context, &pen.context.options.theme);
    let marks = &context.marks[pen.number];
    let metres = context.unit / marks.newtons_per_unit.max(f64::MIN_POSITIVE);
    let [then, now] = change.contacts;
    let [force_then, force_now] = change.forces;
    let [a, b] = bodies(&context.analysis.scene, now);
    let on_blocks = [(a, b, 1.0), (b, a, -1.0)].into_iter();
    let on_blocks = on_blocks.filter(|on| matches!(on.0, BodyId::Block(_)));
    let arrow = |(body, other, sign): (BodyId, BodyId, f64)| -> Item {
        let aside = aside(marks, true_lines, body, other, force_now * sign);
        let from = pen.camera.place(then.resultant.at + aside);
        let along = pen.camera.turn(force_then * (sign * metres));
        let width = theme.widths.force * pen.unit();
        let arrow = Path::filled(straight(from, along, width), theme.faint);
        arrow.with_opacity(0.35).into()
    };
    on_blocks.map(arrow).collect()
}

/// Returns the vector, in metres, by which the arrow of the force from body `from` on body `on` was moved off its line
/// of action. The arrow of the previous force is moved by the same vector. `true_lines` are the arrows before they were
/// moved, and `marks` are the arrows afterwards. If there are several such arrows, the one whose force is nearest to
/// `force` is used. The vector is zero if there is none.
fn aside(marks: &Marks, true_lines: &Marks, on: BodyId, from: BodyId, force: Vector) -> Vector {
    let between = |a: &&ForceArrow| a.on == on && a.kind == ArrowKind::Contact(from);
    let far = |a: &ForceArrow| (a.force - force).norm();
    let nearest = |marks: &Marks| -> Option<ForceArrow> {
        let mut arrows = marks.arrows.iter().filter(between).copied();
        let first = arrows.next()?;
        Some(arrows.fold(first, |best, a| if far(&a) < far(&best) { a } else { best }))
    };
    match (nearest(marks), nearest(true_lines)) {
        (Some(drawn), Some(acts)) => drawn.at - acts.at,
        _ => Vector::zeros(),
    }
}

fn new_path(outline: Outline, theme: &Theme) -> Path {
    Path::stroked(outline, Stroke::new(theme.motion, 3.0))
}

fn gone_path(outline: Outline, theme: &Theme) -> Path {
    Path::stroked(outline, Stroke::new(theme.motion, GONE_WIDTH).dashed([5.0, 4.0]))
}

fn swatch(at: PagePoint) -> Outline {
    let rect = PageRect { at: at.moved(0.0, -6.5), width: 20.0, height: 13.0 };
    Outline::rounded(rect, 0.0)
}

fn new_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![new_path(swatch(at), theme).into()]
}

fn gone_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![gone_path(swatch(at), theme).into()]
}

fn ring_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let ring = Outline::circle(at.moved(7.0, 0.0), 6.0);
    vec![Path::stroked(ring, Stroke::new(theme.motion, 1.6)).into()]
}
