//! How a structure cracks as a support moves: the displaced blocks and the displaced support, and at each joint how far it
//! opens or slides per unit of the movement. The support is one more block that moves.

use std::sync::Arc;

use super::{displaced_blocks, present_edge};
use crate::mechanics::analysis::{Analysis, Crack, Cracked, Motion, MovementOutcome, SupportMovement};
use crate::mechanics::scene::{Block, BlockId, BodyId, Movement, Scene};
use crate::pictures::drawing::{Outline, PagePoint, Path};
use crate::products::figure::canvas::Canvas;
use crate::products::figure::design::{Key, Layer, Mark, along, around, direction, moved_edge, unit};
use crate::products::figure::displacement::Course;
use crate::products::figure::fall::Fall;
use crate::products::figure::gives::{self, Gives, How, Place};
use crate::products::figure::option::{At, Options};
use crate::products::figure::placing::Label;
use crate::products::wording::failure::pair;
use crate::products::wording::number::{quantity, round_below_in, three};
use crate::products::wording::question::{movement, movement_force, per_unit, without_state};

/// The largest number of joints that state how far they open or slide.
const MAX_AMOUNTS: usize = 12;

/// States the movement, and with what force the structure pushes the support; or why the structure does not follow.
pub(super) fn words(analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
    let scene = analysis.at(frame).scene;
    let Some(moved) = chosen(analysis, frame, options) else {
        return vec![format!("there is no movement {}", options.movement.unwrap_or(1))];
    };
    let pushes = match &moved.outcome {
        MovementOutcome::Follows(cracked) => {
            format!("the structure pushes it with {}", movement_force(scene, cracked))
        }
        other => without_state(other).to_owned(),
    };
    vec![movement(scene, moved.number), pushes]
}

/// Displaces the blocks and the support. Returns false if the frame does not follow a movement.
pub(super) fn displace(canvas: &mut Canvas<'_>) -> bool {
    let state = state(canvas);
    if let Some((cracked, own)) = state {
        displace_blocks(canvas, cracked, own);
    }
    state.is_some()
}

/// Draws the displaced blocks and the joints that open or slide. Returns false if the frame does not follow a movement.
pub(super) fn draw(canvas: &mut Canvas<'_>) -> bool {
    let state = state(canvas);
    if let Some((cracked, own)) = state {
        displaced(canvas, own);
        cracks(canvas, cracked);
    }
    state.is_some()
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
    canvas.options.at.filter(|at| *at == At::Movement)?;
    let moved = chosen(canvas.analysis, canvas.number, canvas.options)?;
    match &moved.outcome {
        MovementOutcome::Follows(cracked) => Some((cracked, canvas.scene().movements.get(moved.number)?)),
        _ => None,
    }
}

/// Displaces the blocks and the support of the canvas. The paths are those of an analysis in which the support is the
/// last block.
fn displace_blocks(canvas: &mut Canvas<'_>, cracked: &Cracked, movement: &Movement) {
    let Some(mut alone) = canvas.analysis.alone(canvas.number) else { return };
    let mut scene = Scene::clone(alone.at(0).scene);
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
    let alone = Analysis::of_parts(scene, alone.frames);
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
    canvas.note(62, &format!("drawn for a movement of {moves}; numbers: opening in mm for each mm of it"));
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
    let middle = around(outline.points()).map(|rect| rect.at.moved(rect.width / 2.0, rect.height / 2.0));
    canvas.put(Mark::new(Layer::Stone, "ghosts", vec![Path::stroked(outline, present_edge(canvas))]));
    // An arrow below the support shows where it moves.
    if let Some(middle) = middle.filter(|_| movement.translation.norm() > 0.0) {
        let (u, length) = (direction(movement.translation), canvas.mm(7.0));
        let from = along(middle.moved(0.0, canvas.mm(3.2)), u, -0.5 * length, 0.0);
        let arrow = canvas.arrow(length, [0.5, 1.7, 1.8], 0.6).outline(from, u);
        let shape = Path::filled(arrow, moved_edge(canvas.theme())).cased(canvas.theme().page, canvas.mm(0.15));
        let symbol = canvas.arrow(canvas.mm(4.8), [0.5, 1.7, 1.8], 0.6).outline(PagePoint::new(0.0, 0.0), (1.0, 0.0));
        let symbol = vec![Path::filled(symbol, moved_edge(canvas.theme()))];
        let key = Key::new(13, "movement of the support", symbol, canvas.mm(4.8));
        canvas.put(Mark::new(Layer::Load, "movement", vec![shape]).keyed(&key).avoided(0.2));
    }
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
    gives::draw(canvas, &joints, words, Place::On);
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
