//! Builds the [`SceneFile`] of an import.

use std::collections::BTreeSet;

use super::draft::{Draft, Role, short};
use super::name::Names;
use super::outline::{Body, Outlines};
use crate::geometry::{Aabb, Bounds, BoxIndex, Circle, Point, Polygon};
use crate::mechanics::scene::format::{
    BlockEntry, CircleEntry, GroundEntry, Map, MaterialEntry, Pair, RobotEntry, SceneFile,
};

/// The step to which coordinates are rounded, as a fraction of the size of the drawing. The contact tolerance of a
/// scene is about a thousand times larger, so rounding does not separate bodies that touch.
const COORDINATE_STEP: f64 = 1e-9;

/// Returns the scene file of the outlines. `size` is the size of the drawing in metres, to which the rounding of
/// coordinates is proportional. Circles touch within `gap` metres. `given` contains the properties of the whole scene, such as friction.
pub(super) fn scene(
    outlines: &Outlines,
    names: &Names,
    draft: &mut Draft,
    title: String,
    [size, gap]: [f64; 2],
    given: &SceneFile,
) -> SceneFile {
    let round = Rounding::new(COORDINATE_STEP * size);
    let ground = outlines.ground();
    let fills: BTreeSet<[u8; 3]> = outlines.bodies[ground..].iter().filter_map(|b| b.fill).collect();
    let bodies = outlines.bodies.iter().zip(&names.bodies);
    let blocks = bodies.skip(ground).map(|(body, name)| block_entry(body, name, &round));
    let blocks = blocks.collect();
    let ground_entries = outlines.bodies[..ground].iter();
    let ground_entries = ground_entries.map(|body| ground_entry(body, &round)).collect();
    let materials = fills.into_iter().map(|fill| {
        let entry = MaterialEntry { fill: Some(hex(fill)), ..MaterialEntry::default() };
        (material(fill), entry)
    });
    SceneFile {
        title: given.title.clone().or(Some(title)).filter(|t| !t.is_empty()),
        gravity: given.gravity,
        friction: given.friction,
        kernel: given.kernel,
        density: given.density,
        thickness: given.thickness,
        materials: Map(materials.collect()),
        ground: ground_entries,
        blocks,
        robots: robots(outlines, names, draft, &round),
        contact_tolerance: Some(gap).filter(|gap| has_gaps(outlines, [COORDINATE_STEP * size, *gap])),
        ..SceneFile::default()
    }
}

fn block_entry(body: &Body, name: &str, round: &Rounding) -> BlockEntry {
    BlockEntry {
        id: Some(name.to_owned()),
        polygon: round.outline(body),
        circle: round.circle(body),
        holes: (1..body.rings.len()).map(|i| round.ring(body, i)).collect(),
        material: body.fill.map(material),
        weight: body.values.weight,
        mass: body.values.mass,
        density: body.values.density,
        friction: body.values.friction,
        ..BlockEntry::default()
    }
}

fn ground_entry(body: &Body, round: &Rounding) -> GroundEntry {
    GroundEntry {
        polygon: round.outline(body),
        circle: round.circle(body),
        holes: (1..body.rings.len()).map(|i| round.ring(body, i)).collect(),
        friction: body.values.friction,
        fill: body.fill.map(hex),
        ..GroundEntry::default()
    }
}

/// Returns the robots, each with the block that it holds: the block that contains its centre. A robot without such a
/// block is reported.
fn robots(outlines: &Outlines, names: &Names, draft: &mut Draft, round: &Rounding) -> Vec<RobotEntry> {
    let blocks = outlines.bodies.iter().enumerate().filter(|(_, b)| b.kind == Role::Block);
    let polygons: Vec<(usize, Polygon)> = blocks.filter_map(|(i, b)| Some((i, b.polygon()?))).collect();
    let mut entries = Vec::new();
    for (robot, name) in outlines.robots.iter().zip(&names.robots) {
        let held = polygons.iter().find(|(_, polygon)| polygon.contains(robot.at));
        if held.is_none() {
            let message = format!(
                "its centre ({}, {}) m is in no block, so the robot holds nothing",
                short(robot.at.x),
                short(robot.at.y)
            );
            draft.remark(&robot.element, message, "move its centre into the block that it grips");
        }
        entries.push(RobotEntry {
            id: Some(name.clone()),
            holds: held.map(|(i, ..)| names.bodies[*i].clone()),
            at: held.map(|_| round.pair(robot.at)),
            ..RobotEntry::default()
        });
    }
    entries
}

/// True if a circle and another body are apart, or overlap, by more than the first and at most the second length, in
/// metres. Circles are not moved, so such bodies touch only within a tolerance.
fn has_gaps(outlines: &Outlines, [least, most]: [f64; 2]) -> bool {
    let bodies: Vec<(Option<Circle>, Polygon)> =
        outlines.bodies.iter().filter_map(|body| Some((body.circle, body.polygon()?))).collect();
    if bodies.iter().all(|(circle, _)| circle.is_none()) {
        return false;
    }
    let around = |polygon: &Polygon| {
        let Bounds { min, max } = polygon.bounds();
        Aabb { min: [min.x, min.y], max: [max.x, max.y] }
    };
    let index = BoxIndex::new(bodies.iter().enumerate().collect(), |(_, (_, polygon))| around(polygon));
    bodies.iter().enumerate().any(|(i, (circle, _))| {
        let Some(circle) = circle else { return false };
        let near = index.intersecting(around(&circle.polygon()).grown(2.0 * most));
        let gaps = near.filter(|(k, _)| *k != i).map(|(_, (round, polygon))| match round {
            Some(round) => round.distance(circle.centre) - circle.radius,
            None => -circle.depth_in(polygon),
        });
        gaps.map(f64::abs).any(|gap| gap > least && gap <= most)
    })
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn material(fill: [u8; 3]) -> String {
    format!("fill-{}", &hex(fill)[1..])
}

/// Rounds coordinates to multiples of a power of ten.
struct Rounding {
    /// Rounded coordinates times this factor are whole numbers; 0 if coordinates are not rounded.
    factor: f64,
}

impl Rounding {
    /// Returns a rounding to multiples of the largest power of ten that is at most `step`, in metres.
    fn new(step: f64) -> Rounding {
        let power = -libm::floor(libm::log10(step));
        // Round only with factors from 1 to 10^15. Larger factors would change nothing, because f64 has 16 digits.
        // Smaller factors would round to 10 m or more.
        let factor = if (0.0..=15.0).contains(&power) { libm::pow(10.0, power) } else { 0.0 };
        Rounding { factor }
    }

    fn number(&self, x: f64) -> f64 {
        let rounded = (x * self.factor).round() / self.factor;
        // Adding 0 turns −0 into 0.
        if self.factor > 0.0 { rounded + 0.0 } else { x + 0.0 }
    }

    fn pair(&self, p: Point) -> Pair {
        [self.number(p.x), self.number(p.y)]
    }

    fn outline(&self, body: &Body) -> Option<Vec<Pair>> {
        body.circle.is_none().then(|| self.ring(body, 0))
    }

    fn circle(&self, body: &Body) -> Option<CircleEntry> {
        body.circle.map(|circle| CircleEntry::new(self.pair(circle.centre), self.number(circle.radius)))
    }

    fn ring(&self, body: &Body, ring: usize) -> Vec<Pair> {
        body.rings[ring].iter().map(|c| self.pair(c.at)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_removes_only_rounding_errors() {
        let round = Rounding::new(3.7e-9);
        assert_eq!(round.number(0.1 + 0.2), 0.3);
        assert_eq!(round.number(-1e-12).to_bits(), 0);
        assert_eq!(round.number(123.456_789_012), 123.456_789_012);
        assert_eq!(Rounding::new(0.0).number(1.0 / 3.0), 1.0 / 3.0);
        assert_eq!(Rounding::new(1e5).number(1.5e9), 1.5e9);
    }
}
