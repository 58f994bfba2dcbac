//! Describes how a structure follows a support that moves.

use super::failure::pair;
use super::number::{NO_BREAK, counted, digits, listed, place, quantity, three};
use crate::geometry::Point;
use crate::mechanics::analysis::{Crack, Cracked, FrameAnalysis, MovementOutcome, SupportMovement};
use crate::mechanics::scene::{BodyId, Scene};

/// The largest number of joints that a sentence names.
const MAX_NAMED_JOINTS: usize = 3;

/// Describes a movement: `left moves by (−0.01, 0) m and turns by 0.2°`.
pub fn movement(scene: &Scene, moved: &SupportMovement) -> String {
    let movement = &scene.movements()[moved.number];
    let by = (movement.translation.norm() > 0.0)
        .then(|| format!("moves by {}", place(Point::from(movement.translation), scene.units())));
    let turns = (movement.rotation != 0.0).then(|| format!("turns by {}°", digits(movement.rotation.to_degrees())));
    let ways: Vec<String> = by.into_iter().chain(turns).collect();
    format!("{} {}", scene.name(BodyId::Ground(movement.ground)), listed(&ways))
}

/// Writes the force of the structure on the support: `H = 190 N, V = −1000 N`.
pub fn force(scene: &Scene, cracked: &Cracked) -> String {
    let unit = scene.units().force();
    let written = [cracked.force.x, cracked.force.y].map(|amount| quantity(amount, unit));
    format!("H{NO_BREAK}={NO_BREAK}{}, V{NO_BREAK}={NO_BREAK}{}", written[0], written[1])
}

/// Writes an amount per unit of the movement: `0.62 mm/mm`.
pub fn per_unit(amount: f64) -> String {
    format!("{}{NO_BREAK}mm/mm", three(amount))
}

/// Describes the joints that open or slide most.
pub fn cracks(scene: &Scene, found: &FrameAnalysis, cracked: &Cracked) -> String {
    let mut widest: Vec<&Crack> = cracked.cracks.iter().collect();
    widest.sort_by(|a, b| b.opening.total_cmp(&a.opening).then(a.contact.cmp(&b.contact)));
    let one = |crack: &&Crack| {
        let names = pair(scene, found.contacts[crack.contact].interface.bodies);
        let slides =
            if crack.slip == 0.0 { String::new() } else { format!(" and slide {}", per_unit(crack.slip.abs())) };
        format!("{names} open {}{slides}", per_unit(crack.opening))
    };
    let named: Vec<String> = widest.iter().take(MAX_NAMED_JOINTS).map(one).collect();
    let more = widest.len().saturating_sub(MAX_NAMED_JOINTS);
    let more = if more > 0 { format!("; {} more", counted(more, "joint")) } else { String::new() };
    format!("{}{more}", listed(&named))
}

/// Returns one sentence, without a full stop, about a movement of a support: the force on the support, and which joints
/// open or slide and by how much.
pub fn sentence(scene: &Scene, found: &FrameAnalysis, moved: &SupportMovement) -> String {
    let first = movement(scene, moved);
    match &moved.outcome {
        MovementOutcome::Follows(cracked) => format!(
            "if {first}, the structure pushes it with {}; {} (small displacements; sliding also opens a joint)",
            force(scene, cracked),
            cracks(scene, found, cracked)
        ),
        other => format!("if {first}, {}", without_state(other)),
    }
}

/// Says why a structure does not follow.
pub fn without_state(outcome: &MovementOutcome) -> &'static str {
    match outcome {
        MovementOutcome::Follows(_) => "the structure cracks and follows",
        MovementOutcome::Jams => "rigid blocks cannot follow: the support would have to crush them",
        MovementOutcome::Untouched => "no block touches it where it moves",
        MovementOutcome::Unsolved => "the solver found no result",
    }
}
