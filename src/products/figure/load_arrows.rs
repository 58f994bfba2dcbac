//! Draws the loads of a frame as arrows, in the same way in every kind of figure.
//!
//! The arrow of a load lies on its line of action. Its tip is at the point where the load acts, so that it pushes from
//! outside, unless the space behind this point is freer of blocks and ground than the space before it: then the arrow
//! hangs from the point. Every load has an arrow that is long enough to show its direction; its amount is written
//! beside it.

use super::arrow::{ArrowKind, ForceArrow, Marks, TurnKind};
use super::mark;
use super::option::Options;
use super::pen::CENTROID_RADIUS;
use super::unit::{LOAD_SHAFT, longest_load, unit};
use crate::geometry::{Aabb, BoxIndex, Point, Polygon, Vector};
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::Scene;

/// Distance from the circle around the tail of a weight to the tip of a load that acts there. The distance is measured
/// from the centre of the circle, as a multiple of its radius. It is above 1 because small figures draw larger circles.
const TIP_DISTANCE: f64 = 1.35;
/// Least length of a load's arrow, as a fraction of the longest one. The arrow of a small load still shows its
/// direction; its label states how small it is.
const LEAST_SHARE: f64 = 0.4;
/// The number of points at which the space before and behind the point of a load is tested.
const TESTED_POINTS: u32 = 12;

/// Returns only the arrows of the loads of a frame and of their torques. The arrow of a load of `newtons_per_unit`
/// newtons is one unit length long.
pub(super) fn load_marks(analysis: &Analysis, frame: usize, options: &Options, newtons_per_unit: f64) -> Marks {
    let mut marks = mark::marks(analysis, frame, options, newtons_per_unit);
    marks.arrows.retain(|arrow| arrow.kind == ArrowKind::Load);
    marks.turns.retain(|turn| turn.kind == TurnKind::Load);
    let width = LOAD_SHAFT * longest_load(&analysis.scene, options.zoom);
    for arrow in &mut marks.arrows {
        arrow.width = arrow.width.max(width);
    }
    // If there are no arrows, return no scale either, so that the legend shows none.
    if marks.arrows.is_empty() && marks.turns.is_empty() { Marks::default() } else { marks }
}

/// Returns the load, in newtons, whose arrow is one unit length long in a figure of loads alone. At this scale, the
/// arrow of the largest load of the frame has the length [`longest_load`]. Weights are not loads.
pub(super) fn load_scale(analysis: &Analysis, frame: usize, options: &Options) -> f64 {
    let scene = &analysis.scene;
    let placed = &scene.frames[frame].placed;
    let loads = scene.loads.iter().filter(|l| placed.contains(&l.block));
    let largest = loads.map(|l| l.force.norm()).fold(0.0, f64::max);
    largest * unit(scene, options.zoom) / longest_load(scene, options.zoom)
}

/// Makes the arrows of loads longer. If the longest of them is shorter than `least` metres, all are multiplied by one
/// factor. Those that are then shorter than [`LEAST_SHARE`] of the longest get this length. `marks` has one element for
/// each frame.
pub(super) fn lengthen_loads(marks: &mut [Marks], least: f64) {
    let arrows = marks.iter_mut().flat_map(|marks| &mut marks.arrows);
    let loads: Vec<&mut ForceArrow> = arrows.filter(|arrow| arrow.kind == ArrowKind::Load).collect();
    let longest = loads.iter().map(|a| a.vector.norm()).fold(0.0, f64::max);
    let factor = if longest < least { least / longest } else { 1.0 };
    for arrow in loads {
        let length = arrow.vector.norm();
        if length > 0.0 {
            arrow.vector *= factor.max(LEAST_SHARE * factor * longest / length);
        }
    }
}

/// Moves the arrows of the loads of a frame along their lines of action, to their places before or behind the points
/// where the loads act. Before this call, each arrow begins at its point. A tip inside the circle of a weight moves back
/// to the edge of this circle.
pub(super) fn place_loads(scene: &Scene, frame: usize, marks: &mut Marks) {
    let weights = marks.arrows.iter().filter(|a| a.kind == ArrowKind::Weight);
    let circles: Vec<(Point, f64)> = weights.map(|a| (a.at, CENTROID_RADIUS * a.width)).collect();
    let mut loads = marks.arrows.iter_mut().filter(|arrow| arrow.kind == ArrowKind::Load).peekable();
    if loads.peek().is_none() {
        return;
    }
    let solids = Solids::new(scene, frame);
    for load in loads {
        let length = load.vector.norm();
        if length > 0.0 && solids.pressed(load.at, load.vector) {
            let covered = circles.iter().find(|(at, radius)| (load.at - at).norm() <= *radius);
            let back = covered.map_or(0.0, |(_, radius)| TIP_DISTANCE * radius);
            load.at -= load.vector * (1.0 + back / length);
        }
    }
}

/// The placed blocks and the ground of a frame, which an arrow of a load covers as little as possible.
pub(super) struct Solids<'a>(BoxIndex<&'a Polygon>);

impl<'a> Solids<'a> {
    pub fn new(scene: &'a Scene, frame: usize) -> Solids<'a> {
        let blocks = scene.frames[frame].placed.iter().map(|id| &scene.blocks[id.0].body.polygon);
        let polygons = blocks.chain(scene.ground.iter().map(|g| &g.body.polygon)).collect();
        Solids(BoxIndex::new(polygons, |polygon: &&Polygon| {
            let bounds = polygon.bounds();
            Aabb { min: [bounds.min.x, bounds.min.y], max: [bounds.max.x, bounds.max.y] }
        }))
    }

    /// True if the arrow `vector` (metres) of a load at the point `at` has its tip at this point, so that it pushes from
    /// outside. False if it begins there, because blocks cover less of the arrow behind the point.
    pub fn pressed(&self, at: Point, vector: Vector) -> bool {
        let covered = |sense: f64| {
            let points = (1..=TESTED_POINTS).map(|k| at + vector * (sense * f64::from(k) / f64::from(TESTED_POINTS)));
            points.filter(|p| self.contain(*p)).count()
        };
        covered(-1.0) <= covered(1.0)
    }

    fn contain(&self, p: Point) -> bool {
        let query = Aabb { min: [p.x, p.y], max: [p.x, p.y] };
        self.0.intersecting(query).any(|polygon| polygon.contains(p))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::scene::{BlockId, BodyId};
    use crate::pictures::drawing::Colour;
    use crate::products::figure::Head;

    fn load(at: [f64; 2], vector: [f64; 2]) -> ForceArrow {
        ForceArrow {
            on: BodyId::Block(BlockId(0)),
            at: Point::new(at[0], at[1]),
            vector: Vector::new(vector[0], vector[1]),
            force: Vector::new(vector[0], vector[1]),
            colour: Colour::hex(0),
            width: 0.05,
            head: Head::Within,
            kind: ArrowKind::Load,
        }
    }

    /// A block from (0, 0) to (2, 2) on ground: pushes come from outside, a pull at the right side hangs from it, and
    /// in its middle an arrow covers the block in both places.
    #[test]
    fn a_load_pushes_from_outside_or_hangs_from_its_point() {
        let text = r#"{ "drystone": 1, "ground": [{ "polygon": [[-1,-1],[3,-1],[3,0],[-1,0]] }],
            "blocks": [{ "id": "a", "polygon": [[0,0],[2,0],[2,2],[0,2]], "weight": 6 }] }"#;
        let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
        let cases = [([1.0, 2.0], [0.0, -0.5], [1.0, 2.5]), ([2.0, 1.0], [0.5, 0.0], [2.0, 1.0])];
        for (at, vector, tail) in cases.into_iter().chain([([1.0, 1.0], [0.0, -0.5], [1.0, 1.5])]) {
            let mut marks = Marks { arrows: vec![load(at, vector)], ..Marks::default() };
            place_loads(&scene, 0, &mut marks);
            assert_eq!([marks.arrows[0].at.x, marks.arrows[0].at.y], tail);
        }
    }

    #[test]
    fn a_small_load_keeps_an_arrow_that_shows_its_direction() {
        let arrows = vec![load([0.0, 0.0], [0.0, -2.0]), load([0.0, 0.0], [1e-3, 0.0])];
        let mut marks = [Marks { arrows, ..Marks::default() }];
        lengthen_loads(&mut marks, 4.0);
        let lengths: Vec<f64> = marks[0].arrows.iter().map(|a| a.vector.norm()).collect();
        assert!((lengths[0] - 4.0).abs() < 1e-12 && (lengths[1] - 1.6).abs() < 1e-12, "{lengths:?}");
    }
}
