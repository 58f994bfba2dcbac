//! The placed blocks of a frame, which the JSON result contains on request.

use serde::Serialize;

use super::{Number, Pair, place};
use crate::geometry::Point;
use crate::mechanics::scene::{BlockId, Scene};

#[derive(Serialize)]
pub(super) struct Block<'a> {
    id: &'a str,
    centre: Pair,
    area: Number,
    weight: Number,
    vertices: Vec<Pair>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    holes: Vec<Vec<Pair>>,
}

impl<'a> Block<'a> {
    pub(super) fn new(scene: &'a Scene, id: BlockId) -> Block<'a> {
        let block = &scene.blocks[id.0];
        let ring = |corners: &[Point]| corners.iter().map(|p| place(*p)).collect();
        let polygon = &block.body.polygon;
        Block {
            id: &block.id,
            centre: place(block.centroid),
            area: Number(polygon.area()),
            weight: Number(block.weight),
            vertices: ring(polygon.outline()),
            holes: polygon.holes().iter().map(|hole| ring(hole)).collect(),
        }
    }
}
