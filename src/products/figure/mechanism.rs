//! Draws the mechanism of a structure that falls: the displaced blocks, their present positions as dashed outlines,
//! hinges and sliding joints.
//!
//! Blocks move along their velocities in finite rigid motions, so they keep their shapes. The amplitude is chosen for
//! visibility, but blocks do not visibly overlap. For each part that falls one elementary mechanism is drawn
//! ([`Analysis::elementary`](crate::mechanics::analysis::Analysis::elementary)). In the motion that proves a fall, a sliding
//! block also lifts, by μ per metre of sliding. If possible, the block is drawn sliding along its joint; otherwise
//! the legend states that it lifts. If the scene only allows contact forces in a safe part of each interface (the key
//! `kernel`), a block turns about an end of this safe part. Its corner is then drawn inside the neighbouring block.

use std::collections::BTreeMap;

use super::canvas::Canvas;
use super::design::{Key, Layer, Mark, moved_edge, unit};
use super::displacement::Course;
use super::fall::{Fall, Joint};
use super::option::Options;
use super::panel::{About, Figure};
use super::{collapse, description, gives};
use crate::mechanics::analysis::{Analysis, MarginKind, Verdict};
use crate::mechanics::scene::{BlockId, BodyId};
use crate::pictures::drawing::{Outline, Path, Stroke};
use crate::products::wording::margin::governing;
use crate::products::wording::number::quantity;

/// Opacity of the fill of a displaced block.
const OPACITY: f64 = 0.38;

/// The figure of a collapse mechanism.
pub(crate) struct Mechanism;

impl Figure for Mechanism {
    fn about(&self) -> About {
        About {
            needs_elementary_mechanisms: true,
            ..About::new(
                "mechanism",
                "How the structure falls: blocks displaced along the mechanism, hinges and slips",
                "How a dry-laid structure falls",
            )
        }
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        if analysis.frames.iter().any(|frame| frame.verdict == Verdict::Unstable) {
            &[MarginKind::LoadFactor, MarginKind::Friction, MarginKind::FrictionFactor]
        } else {
            &[]
        }
    }

    /// Returns what the frame lacks to stand, and how it begins to fall.
    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        let found = &analysis.frames[frame];
        if options.film {
            return match found.verdict {
                Verdict::Unstable => vec!["moved along its mechanism: kinematics, not dynamics".to_owned()],
                Verdict::Stable => vec!["nothing moves".to_owned()],
                Verdict::Undecided => vec!["nothing moves, because no mechanism is proved".to_owned()],
            };
        }
        let lack = if found.verdict == Verdict::Unstable && options.verdict_margin {
            governing(analysis.scene_of(frame), frame, found).words
        } else {
            Vec::new()
        };
        lack.into_iter().chain([collapse::reason(analysis, frame)]).collect()
    }

    fn displace(&self, canvas: &mut Canvas<'_>) {
        let (analysis, frame) = (canvas.analysis, canvas.number);
        let unit = unit(canvas.scene(), canvas.options.zoom);
        let courses = canvas.own().courses.get_or_init(|| {
            let fall = Fall::of(analysis, frame);
            vec![if canvas.options.film { Course::far(&fall, unit) } else { Course::new(&fall, unit) }]
        });
        canvas.displaced = courses[0].at(canvas.options.motion_progress);
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        ghosts(canvas);
        displaced(canvas);
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        let (analysis, frame) = (canvas.analysis, canvas.number);
        if canvas.found().verdict == Verdict::Unstable {
            let all: Vec<Joint> =
                (0..analysis.frames.len()).flat_map(|frame| Fall::of(analysis, frame).joints).collect();
            gives::draw_fall(canvas, &Fall::of(analysis, frame), &all);
        }
    }
}

/// Returns the stroke of what moves in its present position.
pub(super) fn present_edge(canvas: &Canvas<'_>) -> Stroke {
    canvas.dashes(canvas.theme().faint, 0.16, [0.6, 0.5])
}

/// Draws dashed outlines of the moving blocks in their present positions.
pub(super) fn ghosts(canvas: &mut Canvas<'_>) {
    let scene = canvas.scene();
    let stroke = present_edge(canvas);
    let key = Key::block(10, "blocks now", canvas.look, |small| vec![Path::stroked(small, stroke.clone())]);
    let mut outline = Outline::default();
    for id in canvas.frame().placed.iter().filter(|id| canvas.displacement(**id).is_some()) {
        outline.extend(canvas.camera.polygon(&scene.blocks[id.0].body.polygon));
    }
    if !outline.segments.is_empty() {
        let mark = Mark::new(Layer::Stone, "ghosts", vec![Path::stroked(outline, stroke)]).keyed(&key);
        canvas.put(mark.titled("Where the blocks that move stand now"));
    }
}

/// Draws the moving blocks in their displaced positions.
fn displaced(canvas: &mut Canvas<'_>) {
    let scene = canvas.scene();
    let words = if canvas.options.film { "blocks that fall" } else { "how they begin to move, enlarged" };
    let bodies = collapse::bodies(&Fall::of(canvas.analysis, canvas.number));
    let sentences: BTreeMap<BlockId, &String> =
        bodies.iter().flat_map(|body| body.blocks.iter().map(|id| (*id, &body.sentence))).collect();
    if let [body] = &bodies[..] {
        canvas.mentioned.extend(&body.mentioned);
    }
    let motions = &canvas.found().mechanism;
    displaced_blocks(canvas, motions.iter().map(|motion| (motion.block, motion)), words, |motion, mut mark| {
        let sentence = sentences.get(&motion.block).map_or(String::new(), |sentence| format!("{sentence}; "));
        let weight = quantity(scene.blocks[motion.block.0].weight, scene.units.force());
        mark.description = format!("{sentence}weight {weight}");
        mark.titled(description::motion(scene, motion))
    });
}

/// Draws blocks in their displaced positions. `words` explain them in the legend, and `described` completes the mark of
/// each block. The second item of a pair is passed to `described`.
pub(super) fn displaced_blocks<T>(
    canvas: &mut Canvas<'_>,
    blocks: impl Iterator<Item = (BlockId, T)>,
    words: &str,
    described: impl Fn(T, Mark) -> Mark,
) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let edge = canvas.pen(moved_edge(theme), if canvas.look.large { 0.26 } else { 0.2 });
    let drawn = |outline: Outline| {
        let fill = Path::filled(outline.clone(), theme.motion).with_opacity(OPACITY);
        vec![fill, Path::stroked(outline, edge.clone())]
    };
    let key = Key::block(11, words, canvas.look, drawn);
    for (id, item) in blocks {
        if canvas.displacement(id).is_none() {
            continue;
        }
        let mut outline = Outline::default();
        for ring in scene.blocks[id.0].body.polygon.rings() {
            outline.extend(Outline::ring(ring.iter().map(|p| canvas.place_on(BodyId::Block(id), *p))));
        }
        canvas.put(described(item, Mark::new(Layer::Stone, "displaced", drawn(outline)).keyed(&key)));
    }
}
