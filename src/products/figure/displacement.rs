//! [`Displacement`]: a block displaced along a collapse mechanism, as a finite rigid motion, so that it keeps its shape.
//!
//! A mechanism gives velocities only, so the figure has to choose an amplitude. For each group of blocks in contact:
//!
//! 1. The fastest point goes at least [`MIN_DISPLACEMENT`] and [`MIN_DISPLACEMENT_SHARE`] say, so that hinges are seen to open.
//! 2. No block turns by more than [`MAX_ROTATION`]: the velocities hold for small rotations only.
//! 3. While blocks overlap by more than [`MAX_OVERLAP`], the amplitude is reduced, a few times.

use std::collections::BTreeMap;

use crate::analysis::{Analysis, Motion, Verdict};
use crate::geometry::{Bounds, ConvexPieces, Point, Polygon, Vector, overlap, quarter_turn};
use crate::scene::{BlockId, BodyId};

/// Least displacement of the fastest point, unit edges.
const MIN_DISPLACEMENT: f64 = 0.35;
/// Least displacement of the fastest point, as a share of the diagonal of all that moves: in an arch of many voussoirs a unit
/// edge is too little for a hinge to be seen to open.
const MIN_DISPLACEMENT_SHARE: f64 = 0.045;
/// Largest rotation of a block, rad (20°).
const MAX_ROTATION: f64 = 0.35;
/// Largest overlap of two blocks in contact, as a share of the area of the smaller one. Finite rotations always make a
/// little overlap, of the order of the square of the angle; one hundredth is not visible.
const MAX_OVERLAP: f64 = 0.01;
/// How often the amplitude is reduced while blocks overlap, and by which factor. The number is limited because with a kernel
/// blocks turn about points inside their interfaces and overlap at any amplitude.
const MAX_REDUCTIONS: u32 = 5;
const REDUCTION: f64 = 0.75;
/// Groups of more blocks are not tested for overlap, which would take longer than the drawing.
const MAX_TESTED_BLOCKS: usize = 500;
/// A block is at rest if its fastest point is slower than this share of the fastest point of all. Slower motions are noise of
/// the solution, or not visible.
const REST_TOL: f64 = 1e-3;

/// A rotation about a point, followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Displacement {
    centre: Point,
    sin: f64,
    cos: f64,
    translation: Vector,
}

impl Displacement {
    /// A block's motion with this amplitude: a rotation about its instantaneous centre by `amplitude`·spin, or, without spin,
    /// a translation by `amplitude`·velocity.
    ///
    /// Units: `amplitude` is the displacement in metres of a point of speed 1.
    pub fn new(motion: &Motion, centroid: Point, amplitude: f64) -> Displacement {
        let angle = amplitude * motion.spin;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        // The rotation about the instantaneous centre is written as one about the centroid, plus the chord of the
        // centroid's arc: amplitude·(sin θ/θ·v + (1 − cos θ)/θ·v⊥). Below 1e-6 rad the first terms of the series are exact
        // to rounding, and a translation needs no case of its own.
        let (along, aside) = if angle.abs() < 1e-6 {
            (1.0, 0.5 * angle)
        } else {
            (sin / angle, (1.0 - cos) / angle)
        };
        let translation =
            (motion.velocity * along + quarter_turn(motion.velocity) * aside) * amplitude;
        Displacement {
            centre: centroid,
            sin,
            cos,
            translation,
        }
    }

    /// The displaced position of a point of the block.
    pub fn moved(&self, point: Point) -> Point {
        self.centre + self.turned(point - self.centre) + self.translation
    }

    /// The point of the block whose displaced position this is.
    pub fn back(&self, point: Point) -> Point {
        let d = point - self.centre - self.translation;
        self.centre + d * self.cos - quarter_turn(d) * self.sin
    }

    /// A direction, turned with the block.
    pub fn turned(&self, direction: Vector) -> Vector {
        direction * self.cos + quarter_turn(direction) * self.sin
    }
}

/// The displacement of each block of a frame that falls, by its number; `None` for a block at rest. Empty for a frame that
/// does not fall.
///
/// Blocks in contact have one amplitude; separate groups have their own. `share` is the share of the amplitude that is
/// drawn, 0 … 1.
pub(crate) fn displacements(
    analysis: &Analysis,
    frame: usize,
    unit: f64,
    share: f64,
) -> Vec<Option<Displacement>> {
    let amplitude = |group: &[Motion]| share * drawn_amplitude(analysis, frame, group, unit);
    match analysis.frames[frame].verdict {
        Verdict::Unstable => displaced(analysis, frame, amplitude),
        _ => Vec::new(),
    }
}

/// The amplitude of a group, reduced while blocks overlap.
fn drawn_amplitude(analysis: &Analysis, frame: usize, group: &[Motion], unit: f64) -> f64 {
    let mut amplitude = amplitude(analysis, group, unit);
    if group.len() > MAX_TESTED_BLOCKS {
        return amplitude;
    }
    for _ in 0..MAX_REDUCTIONS {
        if !overlaps(analysis, frame, group, amplitude) {
            break;
        }
        amplitude *= REDUCTION;
    }
    amplitude
}

/// Whether two bodies in contact overlap when a group is displaced with this amplitude.
fn overlaps(analysis: &Analysis, frame: usize, group: &[Motion], amplitude: f64) -> bool {
    let scene = &analysis.scene;
    let moves = |body: BodyId| {
        let BodyId::Block(id) = body else { return None };
        group.iter().find(|m| m.block == id)
    };
    let displaced = |body: BodyId| -> Option<Polygon> {
        let polygon = &scene.body(body).polygon;
        let BodyId::Block(id) = body else {
            return Some(polygon.clone());
        };
        let Some(motion) = moves(body) else {
            return Some(polygon.clone());
        };
        let moved = Displacement::new(motion, scene.blocks[id.0].centroid, amplitude);
        let ring = |ring: &Vec<Point>| ring.iter().map(|p| moved.moved(*p)).collect();
        let mut rings = polygon.rings().iter().map(ring);
        Polygon::new(rings.next()?, rings.collect()).ok()
    };
    analysis.frames[frame].contacts.iter().any(|contact| {
        let [a, b] = contact.interface.bodies;
        if moves(a).is_none() && moves(b).is_none() {
            return false;
        }
        let (Some(a), Some(b)) = (displaced(a), displaced(b)) else {
            return false;
        };
        let smaller = a.area().min(b.area());
        let common = overlap(&ConvexPieces::new(&a), &ConvexPieces::new(&b), 0.0);
        common.is_some_and(|o| o.area > MAX_OVERLAP * smaller)
    })
}

/// The amplitude of a group, without regard to overlaps: the displacement in metres of a point of speed 1.
fn amplitude(analysis: &Analysis, group: &[Motion], unit: f64) -> f64 {
    let scene = &analysis.scene;
    let fastest = group.iter().map(|m| m.fastest(scene)).fold(0.0, f64::max);
    let spin = group.iter().map(|m| m.spin.abs()).fold(0.0, f64::max);
    let size = group
        .iter()
        .map(|m| scene.blocks[m.block.0].body.polygon.bounds())
        .reduce(Bounds::union)
        .map_or(0.0, Bounds::diagonal);
    if fastest <= 0.0 {
        return 0.0;
    }
    let displacement = f64::max(
        MIN_DISPLACEMENT * unit.min(size),
        MIN_DISPLACEMENT_SHARE * size,
    );
    let amplitude = displacement / fastest;
    if spin > 0.0 {
        amplitude.min(MAX_ROTATION / spin)
    } else {
        amplitude
    }
}

/// The displacements of all groups of a frame, each with the amplitude that `amplitude` gives it.
fn displaced(
    analysis: &Analysis,
    frame: usize,
    amplitude: impl Fn(&[Motion]) -> f64,
) -> Vec<Option<Displacement>> {
    let scene = &analysis.scene;
    let mut displacements = vec![None; scene.blocks.len()];
    for group in connected_groups(analysis, frame, |_| true) {
        let amplitude = amplitude(&group);
        for motion in group {
            let centroid = scene.blocks[motion.block.0].centroid;
            displacements[motion.block.0] = Some(Displacement::new(&motion, centroid, amplitude));
        }
    }
    displacements
}

/// The motions of the moving blocks, in groups connected by the contacts for whose numbers `joins` is true: the connected
/// components, by depth-first search, in the order of their first blocks.
pub(crate) fn connected_groups(
    analysis: &Analysis,
    frame: usize,
    joins: impl Fn(usize) -> bool,
) -> Vec<Vec<Motion>> {
    let motions: BTreeMap<BlockId, Motion> =
        moving(analysis, frame).map(|m| (m.block, *m)).collect();
    let mut neighbours: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
    for (number, contact) in analysis.frames[frame].contacts.iter().enumerate() {
        if let ([BodyId::Block(a), BodyId::Block(b)], true) =
            (contact.interface.bodies, joins(number))
        {
            neighbours.entry(a).or_default().push(b);
            neighbours.entry(b).or_default().push(a);
        }
    }
    let mut seen = vec![false; analysis.scene.blocks.len()];
    let mut groups = Vec::new();
    for first in motions.keys() {
        let (mut group, mut stack) = (Vec::new(), vec![*first]);
        while let Some(block) = stack.pop() {
            let Some(motion) = motions.get(&block).filter(|_| !seen[block.0]) else {
                continue;
            };
            seen[block.0] = true;
            group.push(*motion);
            stack.extend(neighbours.get(&block).into_iter().flatten());
        }
        if !group.is_empty() {
            group.sort_by_key(|m| m.block);
            groups.push(group);
        }
    }
    groups
}

/// The motions of the blocks of a frame that are not at rest.
fn moving(analysis: &Analysis, frame: usize) -> impl Iterator<Item = &Motion> {
    let (scene, motions) = (&analysis.scene, &analysis.frames[frame].mechanism);
    let speed = |m: &Motion| m.fastest(scene);
    let fastest = motions.iter().map(speed).fold(0.0, f64::max);
    motions
        .iter()
        .filter(move |m| m.fastest(scene) > REST_TOL * fastest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::unit::unit;
    use crate::scene::Scene;

    fn falling() -> Vec<Scene> {
        [
            include_str!("../../../assets/study/arch-27-thin.json"),
            include_str!("../../../assets/study/stack-harmonic-falls.json"),
            include_str!("../../../assets/thesis/figure-8-right.json"),
        ]
        .map(|text| Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}")))
        .into()
    }

    fn moved(block: &crate::scene::Block, displacement: &Displacement) -> Polygon {
        let corners = block.body.polygon.outline().iter();
        let corners = corners.map(|p| displacement.moved(*p)).collect();
        Polygon::new(corners, Vec::new()).expect("a rigid motion keeps an outline simple")
    }

    #[test]
    fn displaced_blocks_keep_their_areas_and_sides() {
        for scene in falling() {
            let analysis = Analysis::new(&scene);
            let displaced = displacements(&analysis, 0, unit(&scene, None), 1.0);
            let mut count = 0;
            for (block, displacement) in scene.blocks.iter().zip(&displaced) {
                let Some(displacement) = displacement else {
                    continue;
                };
                let (before, after) = (&block.body.polygon, moved(block, displacement));
                assert!((before.area() - after.area()).abs() < 1e-9 * before.area());
                for (a, b) in before.edges().zip(after.edges()) {
                    assert!((a.length() - b.length()).abs() < 1e-9 * a.length());
                }
                count += 1;
            }
            assert!(count > 4, "{count} blocks move");
        }
    }

    /// How much displaced blocks lie in each other, m².
    fn shared(analysis: &Analysis, amplitude: f64) -> f64 {
        let displaced = displaced(analysis, 0, |_| amplitude);
        let blocks: Vec<Polygon> = analysis
            .scene
            .blocks
            .iter()
            .zip(&displaced)
            .filter_map(|(block, displacement)| Some(moved(block, displacement.as_ref()?)))
            .collect();
        let mut area = 0.0;
        for (i, a) in blocks.iter().enumerate() {
            for b in &blocks[..i] {
                area += overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), 0.0)
                    .map_or(0.0, |o| o.area);
            }
        }
        area
    }

    #[test]
    fn displaced_blocks_lie_in_each_other_by_no_more_than_the_square_of_their_way() {
        // A kernel lets blocks turn about points within an interface, so that what lies beyond dips in at once.
        for scene in falling().into_iter().filter(|s| s.kernel == 0.0) {
            let analysis = Analysis::new(&scene);
            let groups = connected_groups(&analysis, 0, |_| true);
            assert_eq!(groups.len(), 1);
            let amplitude = amplitude(&analysis, &groups[0], unit(&scene, None));
            // Where the way is short the square is all there is.
            let (short, half) = (
                shared(&analysis, amplitude / 4.0),
                shared(&analysis, amplitude / 8.0),
            );
            let size: f64 = scene.blocks.iter().map(|b| b.body.polygon.area()).sum();
            assert!(half <= 0.28 * short + 1e-9 * size, "{half} of {short} m²");
            let whole = shared(&analysis, amplitude);
            assert!(whole < 0.03 * size, "{whole} of {size} m²");
        }
    }

    #[test]
    fn a_rotation_leaves_its_centre_and_all_distances_and_can_be_taken_back() {
        let centroid = Point::new(3.0, 2.0);
        let corner = Point::new(4.0, 1.0);
        for spin in [0.8, -1e-9, 0.0] {
            // Turning about the corner: the velocity of the centroid is spin × arm.
            let velocity = if spin == 0.0 {
                Vector::new(1.0, -0.5)
            } else {
                quarter_turn(centroid - corner) * spin
            };
            let motion = Motion {
                block: BlockId(0),
                velocity,
                spin,
            };
            let moved = Displacement::new(&motion, centroid, 0.6);
            if spin != 0.0 {
                assert!((moved.moved(corner) - corner).norm() < 1e-12);
            } else {
                assert!((moved.moved(corner) - corner - velocity * 0.6).norm() < 1e-12);
            }
            let far = Point::new(-7.0, 5.0);
            let distance = (moved.moved(far) - moved.moved(centroid)).norm();
            assert!((distance - (far - centroid).norm()).abs() < 1e-12);
            assert!((moved.back(moved.moved(far)) - far).norm() < 1e-12);
        }
    }

    #[test]
    fn a_small_block_beside_a_large_scene_is_not_whirled_about() {
        let brick = |id: &str, x: f64, size: f64| {
            format!(
                r#"{{ "id": "{id}", "weight": 6,
                     "polygon": [[{x},0],[{},0],[{},{size}],[{x},{size}]] }}"#,
                x + size,
                x + size
            )
        };
        // Each stands with a third of its width on its own piece of ground, and tips.
        let ground = |x: f64, size: f64| {
            format!(
                r#"{{ "polygon": [[{x},-1],[{},-1],[{},0],[{x},0]] }}"#,
                x + size / 3.0,
                x + size / 3.0
            )
        };
        let text = format!(
            r#"{{ "drystone": 1, "ground": [{}, {}], "blocks": [{}, {}] }}"#,
            ground(0.0, 9.0),
            ground(200.0, 0.3),
            brick("large", 0.0, 9.0),
            brick("small", 200.0, 0.3)
        );
        let scene = Scene::from_json(&text).unwrap_or_else(|problems| panic!("{problems}"));
        let displaced = displacements(&Analysis::new(&scene), 0, unit(&scene, None), 1.0);
        for (block, displacement) in scene.blocks.iter().zip(displaced) {
            let displacement = displacement.expect("it tips");
            let turned = displacement.turned(Vector::new(1.0, 0.0));
            assert!(libm::atan2(turned.y, turned.x).abs() < 0.36, "{}", block.id);
            let way = (displacement.moved(block.centroid) - block.centroid).norm();
            assert!(way > 0.02 * block.body.polygon.area().sqrt(), "{way}");
        }
    }
}
