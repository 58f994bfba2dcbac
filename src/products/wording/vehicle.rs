//! Describes the load factor at the positions of a vehicle.

use super::number::{amount, counted, listed, three_down};
use crate::mechanics::analysis::{Influence, VehiclePosition};
use crate::mechanics::scene::Scene;

/// Describes a position: `first axle at x = 3.2 m, travelling to the right, on A4`.
pub fn position(scene: &Scene, position: &VehiclePosition) -> String {
    let mut blocks: Vec<String> = position.axles.iter().map(|axle| scene.blocks()[axle.1.0].id.clone()).collect();
    blocks.dedup();
    let toward = match scene.vehicle() {
        Some(vehicle) if vehicle.axles.len() > 1 && position.to_right => ", travelling to the right",
        Some(vehicle) if vehicle.axles.len() > 1 => ", travelling to the left",
        _ => "",
    };
    format!("first axle at x = {}{toward}, on {}", amount(position.at, scene.units().length()), listed(&blocks))
}

/// States the least factor in a few words: `carries 2.31 times the vehicle`.
pub fn factor(influence: &Influence) -> String {
    match influence.governing.and_then(|number| influence.positions[number].factor) {
        None => "carries any multiple of the vehicle".to_owned(),
        Some(factor) if factor < 1.0 => {
            format!(
                "falls under the vehicle, and stands only without it: it carries {} times its weight",
                three_down(factor)
            )
        }
        Some(factor) => format!("carries {} times the vehicle", three_down(factor)),
    }
}

/// Describes the governing position of a vehicle in one sentence without a full stop.
pub fn sentence(scene: &Scene, influence: &Influence) -> String {
    let count = counted(influence.positions.len(), "position");
    let governing = influence.governing.map(|number| position(scene, &influence.positions[number]));
    let at = governing.map_or(String::new(), |at| format!("; it governs with the {at}"));
    format!("{}{at} ({count})", factor(influence))
}
