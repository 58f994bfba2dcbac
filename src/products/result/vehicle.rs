//! The influence line of a vehicle, as written in JSON.

use serde::Serialize;

use super::{Motion, Number, Pair, place};
use crate::mechanics::analysis::{Influence, VehiclePosition};
use crate::mechanics::scene::Scene;

#[derive(Serialize)]
pub(super) struct Vehicle<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    governing: Option<usize>,
    mechanism: Vec<Motion<'a>>,
    positions: Vec<Position<'a>>,
}

#[derive(Serialize)]
struct Position<'a> {
    at: Number,
    toward: &'static str,
    factor: Factor,
    axles: Vec<Axle<'a>>,
}

#[derive(Serialize)]
struct Axle<'a> {
    axle: usize,
    block: &'a str,
    at: Pair,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Factor {
    At(Number),
    Word(&'static str),
}

impl<'a> Vehicle<'a> {
    pub(super) fn new(scene: &'a Scene, influence: &Influence) -> Vehicle<'a> {
        let position = |position: &VehiclePosition| Position {
            at: Number(position.at),
            toward: if position.to_right { "right" } else { "left" },
            factor: position.factor.map_or(Factor::Word("unbounded"), |factor| Factor::At(Number(factor))),
            axles: (position.axles.iter())
                .map(|(axle, block, at)| Axle { axle: *axle, block: &scene.blocks[block.0].id, at: place(*at) })
                .collect(),
        };
        Vehicle {
            governing: influence.governing,
            mechanism: influence.mechanism.iter().map(|motion| Motion::new(scene, motion)).collect(),
            positions: influence.positions.iter().map(position).collect(),
        }
    }
}
