//! Draws how a structure moves: how what does not stand falls, or with the option `at` how what stands falls just beyond a
//! margin, with errors of placement or under its vehicle, or how it cracks as a support moves. All have one drawing: the
//! displaced blocks, their present positions as dashed outlines, hinges and sliding joints.
//!
//! Blocks move along their velocities in finite rigid motions, so they keep their shapes. The amplitude is chosen for
//! visibility, but blocks do not visibly overlap. For each part that falls one elementary mechanism is drawn
//! ([`Analysis::elementary`](crate::mechanics::analysis::Analysis::elementary)). In the motion that proves a fall, a sliding
//! block also lifts, by μ per metre of sliding. If possible, the block is drawn sliding along its joint; otherwise
//! the legend states that it lifts. If the scene only allows contact forces in a safe part of each interface (the key
//! `kernel`), a block turns about an end of this safe part. Its corner is then drawn inside the neighbouring block.

mod margin;
mod movement;
mod placement;
pub(crate) mod vehicle;

use std::collections::BTreeMap;

use super::canvas::Canvas;
use super::design::{Key, Layer, Mark, moved_edge, unit};
use super::displacement::Course;
use super::fall::{Fall, Joint};
use super::moving::Moving;
use super::option::{At, Options};
use super::panel::{About, Figure};
use super::{collapse, description, gives};
use crate::mechanics::analysis::{Analysis, MarginKind, SolvedFrame, Verdict};
use crate::mechanics::scene::{BlockId, BodyId};
use crate::pictures::drawing::{Outline, Path, Stroke};
use crate::products::wording::margin::governing;
use crate::products::wording::number::quantity;

/// Opacity of the fill of a displaced block.
const OPACITY: f64 = 0.38;

/// The figure of a motion.
pub(crate) struct Mechanism;

/// Returns the motion of a frame, which all its pictures share.
fn moving<'a>(canvas: &Canvas<'a>, frame: usize) -> &'a Moving {
    canvas.shared[frame].moving.get_or_init(|| Moving::new(canvas.analysis, frame, canvas.options))
}

/// Returns the motion of a frame with its rigid bodies and joints.
fn fall<'a>(canvas: &Canvas<'a>, frame: usize) -> Fall<'a> {
    moving(canvas, frame).fall(canvas.analysis, frame)
}

/// True if the vehicle drives over the structure, which does not move.
fn drives(options: &Options) -> bool {
    options.at == Some(At::Vehicle) && options.motion_progress < 1.0
}

impl Figure for Mechanism {
    fn about(&self) -> About {
        About {
            needs_elementary_mechanisms: true,
            ..About::new(
                "mechanism",
                "How the structure falls: displaced blocks, hinges and slips; --at shows the fall beyond a margin and other motions",
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

    /// Returns what the frame lacks to stand or how far it is from the motion, and how it begins to move.
    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        let solved @ SolvedFrame { found, .. } = analysis.at(frame);
        if options.film {
            return match found.verdict {
                _ if !Moving::new(analysis, frame, options).motions.is_empty() => {
                    vec!["moved along its mechanism: kinematics, not dynamics".to_owned()]
                }
                Verdict::Undecided => vec!["nothing moves, because no mechanism is proved".to_owned()],
                _ => vec!["nothing moves".to_owned()],
            };
        }
        let words = match options.at {
            Some(At::Vehicle) if found.vehicle.is_some() => return vehicle::words(analysis, frame, options),
            Some(At::Movement) if !found.movements.is_empty() => return movement::words(analysis, frame, options),
            Some(At::Margin(kind)) if options.verdict_margin => vec![margin::words(solved, kind)],
            Some(At::Placement) => placement::words(solved),
            _ if found.verdict == Verdict::Unstable && options.verdict_margin => governing(solved).words,
            Some(At::Vehicle) if found.verdict == Verdict::Stable => {
                vec!["no position of a vehicle was analysed".to_owned()]
            }
            Some(At::Movement) if found.verdict == Verdict::Stable => {
                vec!["the scene lists no movement of a support".to_owned()]
            }
            _ => Vec::new(),
        };
        let moving = Moving::new(analysis, frame, options);
        let how = match found.verdict {
            _ if !moving.motions.is_empty() => {
                let how = collapse::sentence(&moving.fall(analysis, frame));
                Some(if found.verdict == Verdict::Stable { format!("then {how}") } else { how })
            }
            Verdict::Undecided => Some(format!("no mechanism is proved: {}", found.doubt())),
            _ if words.is_empty() => Some("there is no mechanism".to_owned()),
            _ => None,
        };
        words.into_iter().filter(|words| !words.is_empty()).chain(how).collect()
    }

    fn displace(&self, canvas: &mut Canvas<'_>) {
        if canvas.options.at == Some(At::Movement) && movement::displace(canvas) || drives(canvas.options) {
            return;
        }
        let unit = unit(canvas.scene(), canvas.options.zoom);
        let number = canvas.number;
        let courses = canvas.own().courses.get_or_init(|| {
            let fall = fall(canvas, number);
            vec![if canvas.options.film { Course::far(&fall, unit) } else { Course::new(&fall, unit) }]
        });
        canvas.displaced = courses[0].at(canvas.options.motion_progress);
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        ghosts(canvas);
        if !movement::draw(canvas) {
            displaced(canvas);
        }
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        let (frames, number) = (canvas.analysis.frames.len(), canvas.number);
        if !moving(canvas, number).motions.is_empty() && !drives(canvas.options) {
            let all: Vec<Joint> = (0..frames).flat_map(|frame| fall(canvas, frame).joints).collect();
            gives::draw_fall(canvas, &fall(canvas, number), &all);
        }
        match canvas.options.at {
            Some(At::Vehicle) => vehicle::draw(canvas),
            Some(At::Placement) => placement::draw(canvas),
            Some(At::Margin(kind)) => {
                if let Some(edge) = moving(canvas, number).edge {
                    margin::arrows(canvas, kind, edge);
                }
            }
            Some(At::Movement) | None => {}
        }
    }
}

/// Returns the stroke of what moves in its present position.
fn present_edge(canvas: &Canvas<'_>) -> Stroke {
    canvas.dashes(canvas.theme().faint, 0.16, [0.6, 0.5])
}

/// Draws dashed outlines of the moving blocks in their present positions.
fn ghosts(canvas: &mut Canvas<'_>) {
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
    let stands = canvas.found().verdict == Verdict::Stable;
    let words = match canvas.options.film {
        true => "blocks that fall",
        false if stands => "how they would begin to fall, enlarged",
        false => "how they begin to move, enlarged",
    };
    let number = canvas.number;
    let bodies = collapse::bodies(&fall(canvas, number));
    let sentences: BTreeMap<BlockId, &String> =
        bodies.iter().flat_map(|body| body.blocks.iter().map(|id| (*id, &body.sentence))).collect();
    if let [body] = &bodies[..] {
        canvas.mentioned.extend(&body.mentioned);
    }
    let motions = &moving(canvas, number).motions;
    displaced_blocks(canvas, motions.iter().map(|motion| (motion.block, motion)), words, |motion, mut mark| {
        let sentence = sentences.get(&motion.block).map_or(String::new(), |sentence| format!("{sentence}; "));
        let weight = quantity(scene.blocks[motion.block.0].weight, scene.units.force());
        mark.description = format!("{sentence}weight {weight}");
        mark.titled(description::motion(scene, motion))
    });
}

/// Draws blocks in their displaced positions. `words` explain them in the legend, and `described` completes the mark of
/// each block. The second item of a pair is passed to `described`.
fn displaced_blocks<T>(
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
