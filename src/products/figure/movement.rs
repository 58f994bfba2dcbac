//! Draws how a structure cracks as a support moves: the displaced blocks and the displaced support, their present
//! positions as dashed outlines, and at each joint how far it opens or slides per unit of the movement.
//!
//! The picture is made like that of a mechanism, in which the support is one more block that moves. The words state the
//! movement for which it is drawn.

use std::sync::Arc;

use super::canvas::Canvas;
use super::design::{Layer, Mark, unit};
use super::displacement::Course;
use super::fall::Fall;
use super::gives::{self, Gives, How};
use super::mechanism::{displaced_blocks, ghosts, present_edge};
use super::option::Options;
use super::panel::{About, Figure};
use super::placing::Label;
use crate::mechanics::analysis::{Analysis, Crack, Cracked, Motion, MovementOutcome, SupportMovement, Verdict};
use crate::mechanics::scene::{Block, BlockId, BodyId, Movement, Scene};
use crate::pictures::drawing::{Outline, Path};
use crate::products::wording::failure::pair;
use crate::products::wording::number::{quantity, round_below_in, three};
use crate::products::wording::question::{movement, movement_force, per_unit, without_state};
use crate::products::wording::verdict;

/// The largest number of joints that state how far they open or slide.
const MAX_AMOUNTS: usize = 12;

/// The figure of a support that moves.
pub(crate) struct MovedSupport;

impl Figure for MovedSupport {
    fn about(&self) -> About {
        About::new(
            "movement",
            "How the structure cracks as a support moves; --movement selects one of several movements",
            "How a dry-laid structure follows its support",
        )
    }

    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        let (scene, found) = analysis.at(frame);
        match (chosen(analysis, frame, options), found.verdict) {
            (Some(moved), _) => {
                let pushes = match &moved.outcome {
                    MovementOutcome::Follows(cracked) => {
                        format!("the structure pushes it with {}", movement_force(scene, cracked))
                    }
                    other => without_state(other).to_owned(),
                };
                vec![movement(scene, moved), pushes]
            }
            (None, Verdict::Stable) => vec!["the scene lists no movement of a support".into()],
            (None, Verdict::Unstable) => vec!["it falls before a support moves".into()],
            (None, Verdict::Undecided) => vec![verdict::reason(scene, found)],
        }
    }

    fn displace(&self, canvas: &mut Canvas<'_>) {
        if let Some((cracked, own)) = state(canvas) {
            displace(canvas, cracked, own);
        }
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        if let Some((cracked, own)) = state(canvas) {
            ghosts(canvas);
            displaced(canvas, own);
            cracks(canvas, cracked);
        }
    }
}

/// Returns the movement that the options name, or the first one that the structure follows.
fn chosen<'a>(analysis: &'a Analysis, frame: usize, options: &Options) -> Option<&'a SupportMovement> {
    let all = &analysis.frames[frame].movements;
    match options.movement {
        Some(number) => all.get(number - 1),
        None => all.iter().find(|m| matches!(m.outcome, MovementOutcome::Follows(_))).or(all.first()),
    }
}

fn state<'a>(canvas: &Canvas<'a>) -> Option<(&'a Cracked, &'a Movement)> {
    let moved = chosen(canvas.analysis, canvas.number, canvas.options)?;
    match &moved.outcome {
        MovementOutcome::Follows(cracked) => Some((cracked, canvas.scene().movements.get(moved.number)?)),
        _ => None,
    }
}

/// Displaces the blocks and the support of the canvas. The paths are those of an analysis in which the support is the
/// last block.
fn displace(canvas: &mut Canvas<'_>, cracked: &Cracked, movement: &Movement) {
    let Some(mut alone) = canvas.analysis.alone(canvas.number) else { return };
    let mut scene = Scene::clone(&alone.scene);
    let (ground, support) = (BodyId::Ground(movement.ground), BlockId(scene.blocks.len()));
    let Some(first) = scene.blocks.first() else { return };
    let body = scene.ground[movement.ground].body.clone();
    let block = Block { centroid: body.polygon.centroid(), body, ..first.clone() };
    let velocity = movement.at(block.centroid) / cracked.unit;
    scene.blocks.push(block);
    // Bodies without an outline of their own stop no block.
    scene.ground[movement.ground].body.is_schematic = true;
    let contacts = &mut Arc::make_mut(&mut alone.frames[0]).contacts;
    for body in contacts.iter_mut().flat_map(|contact| &mut contact.interface.bodies) {
        if *body == ground {
            *body = BodyId::Block(support);
        }
    }
    alone.scene = scene.into();
    let motion = Motion { block: support, velocity, spin: movement.rotation / cracked.unit };
    let motions: Vec<Motion> = cracked.motions.iter().copied().chain([motion]).collect();
    let fall = Fall::with(&alone, 0, &motions);
    let size = unit(canvas.scene(), canvas.options.zoom);
    let course = &canvas.own().courses.get_or_init(|| vec![Course::new(&fall, size)])[0];
    let amplitude = course.amplitude();
    let drawn = round_below_in(amplitude, canvas.scene().units.length());
    canvas.displaced = course.at(canvas.options.motion_progress * drawn / amplitude.max(f64::MIN_POSITIVE));
    canvas.moved_ground = canvas.displaced.pop().flatten().map(|way| (movement.ground, way));
    let moves = quantity(drawn, canvas.scene().units.length());
    canvas.note(62, &format!("drawn for a movement of {moves}; amounts are mm per mm of it"));
}

/// Draws the displaced blocks, and the present edge of the support.
fn displaced(canvas: &mut Canvas<'_>, movement: &Movement) {
    let scene = canvas.scene();
    let blocks = canvas.frame().placed.iter().map(|id| (*id, &scene.blocks[id.0].id));
    displaced_blocks(canvas, blocks, "how they follow, enlarged", |name, mark| mark.titled(name.clone()));
    // Where the support touches the structure now.
    let contacts = canvas.found().contacts.iter().map(|contact| &contact.interface);
    let touching = contacts.filter(|interface| interface.bodies.contains(&BodyId::Ground(movement.ground)));
    let outline = Outline::lines(touching.map(|interface| interface.ends.map(|end| canvas.place(end))));
    canvas.put(Mark::new(Layer::Stone, "ghosts", vec![Path::stroked(outline, present_edge(canvas))]));
}

/// Draws the joints that open or slide, with their amounts.
fn cracks(canvas: &mut Canvas<'_>, cracked: &Cracked) {
    let found = canvas.found();
    let one = |crack: &Crack| {
        let contact = &found.contacts[crack.contact];
        let at = crack.end.map(|end| contact.application_points[end]);
        let how = match (at, crack.slip) {
            (Some(at), 0.0) => How::Hinge(at),
            (_, 0.0) => return None,
            (touch, slip) => How::Slip(slip, touch),
        };
        Some(Gives { contact, how })
    };
    let joints: Vec<Gives<'_>> = cracked.cracks.iter().filter_map(one).collect();
    let words = ["hinge".to_owned(), "slides, and opens by friction × distance".to_owned()];
    gives::draw(canvas, &joints, words);
    if !canvas.options.main_amounts {
        return;
    }
    let mut widest: Vec<&Crack> = cracked.cracks.iter().collect();
    widest.sort_by(|a, b| b.opening.max(b.slip.abs()).total_cmp(&a.opening.max(a.slip.abs())));
    for (rank, crack) in (0..).zip(widest.into_iter().take(MAX_AMOUNTS)) {
        let contact = &found.contacts[crack.contact];
        let points = contact.application_points;
        let open = crack.end.map_or(contact.interface.middle(), |end| points[1 - end]);
        let anchors = contact.interface.bodies.map(|body| canvas.place_on(body, open)).to_vec();
        let amount =
            if crack.slip == 0.0 { three(crack.opening) } else { format!("slides {}", three(crack.slip.abs())) };
        let mut label = Label::new(amount, canvas.theme().ink, anchors, rank);
        label.bold = rank == 0;
        canvas.label(label);
        let title = format!("{} open by {}", pair(canvas.scene(), contact.interface.bodies), per_unit(crack.opening));
        let line = Outline::line(contact.interface.bodies.map(|body| canvas.place_on(body, open)));
        let stroke = canvas.pen(canvas.theme().ink, 0.2);
        canvas.put(Mark::new(Layer::Symbol, "opening", vec![Path::stroked(line, stroke)]).titled(title));
    }
}
