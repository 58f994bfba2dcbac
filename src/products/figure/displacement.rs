//! [`Displacement`]: how far a block has gone along a mechanism, as a finite rigid motion, so that it keeps its shape.

use std::collections::BTreeMap;

use crate::analysis::{Analysis, Motion, Verdict};
use crate::geometry::{Bounds, ConvexPieces, Point, Polygon, Vector, overlap, quarter_turn};
use crate::scene::{BlockId, BodyId};

/// The fastest point goes at least so many unit edges …
const LEAST: f64 = 0.35;
/// … and at least this share of the diagonal of all that moves: in an arch of many voussoirs a unit edge is too little
/// for a hinge to be seen to open …
const SHARE: f64 = 0.045;
/// … but no block turns farther than so many radians.
const MOST: f64 = 0.35;
/// Blocks that touch may lie in each other by this share of the smaller one; farther the motion is not followed …
const SHARED: f64 = 0.01;
/// … but so many times shortened by this factor it is drawn all the same: with a kernel, blocks turn about points within
/// their interfaces and dip into each other however little they turn.
const SHORTENED: (u32, f64) = (5, 0.75);
/// Blocks of larger heaps are not asked whether they lie in each other.
const MOST_ASKED: usize = 500;
/// A block is still where its fastest point is slower than this, as a share of the fastest of all.
const STILL: f64 = 1e-3;

/// A rotation about a point, then a shift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Displacement {
    about: Point,
    sin: f64,
    cos: f64,
    shift: Vector,
}

impl Displacement {
    /// A block's motion followed for a while: a rotation about its instantaneous centre by `amplitude`·spin, a shift by
    /// `amplitude`·velocity where it does not turn.
    ///
    /// Units: `amplitude` is the way in metres of a point of speed 1.
    pub fn new(motion: &Motion, centroid: Point, amplitude: f64) -> Displacement {
        let angle = amplitude * motion.spin;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        // The rotation about the instantaneous centre, written as one about the centroid and the centroid's way along
        // its arc: without a division by the spin it holds for a mere shift as well.
        let (along, aside) = if angle.abs() < 1e-6 {
            (1.0, 0.5 * angle)
        } else {
            (sin / angle, (1.0 - cos) / angle)
        };
        let shift = (motion.velocity * along + quarter_turn(motion.velocity) * aside) * amplitude;
        Displacement {
            about: centroid,
            sin,
            cos,
            shift,
        }
    }

    /// Where a point of the block has gone.
    pub fn moved(&self, point: Point) -> Point {
        self.about + self.turned(point - self.about) + self.shift
    }

    /// Which point of the block has gone here.
    pub fn back(&self, point: Point) -> Point {
        let d = point - self.about - self.shift;
        self.about + d * self.cos - quarter_turn(d) * self.sin
    }

    /// A direction that turns with the block.
    pub fn turned(&self, direction: Vector) -> Vector {
        direction * self.cos + quarter_turn(direction) * self.sin
    }
}

/// How each block of a frame that falls is displaced, by its number; `None` for a block that stays. Empty where the
/// frame does not fall.
///
/// Blocks that touch go equally far for their speed; a heap that falls apart from others has its own measure. `share` of
/// the way is drawn, 0 … 1.
pub(crate) fn displacements(
    analysis: &Analysis,
    frame: usize,
    unit: f64,
    share: f64,
) -> Vec<Option<Displacement>> {
    let way = |heap: &[Motion]| share * clear(analysis, frame, heap, unit);
    match analysis.frames[frame].verdict {
        Verdict::Unstable => followed(analysis, frame, way),
        _ => Vec::new(),
    }
}

/// How far the motion of a heap is followed so that no block lies in another.
fn clear(analysis: &Analysis, frame: usize, heap: &[Motion], unit: f64) -> f64 {
    let mut way = amplitude(analysis, heap, unit);
    if heap.len() > MOST_ASKED {
        return way;
    }
    let (times, factor) = SHORTENED;
    for _ in 0..times {
        if !dips(analysis, frame, heap, way) {
            break;
        }
        way *= factor;
    }
    way
}

/// Whether two bodies that touch lie in each other where a heap has gone so far.
fn dips(analysis: &Analysis, frame: usize, heap: &[Motion], way: f64) -> bool {
    let scene = &analysis.scene;
    let moves = |body: BodyId| {
        let BodyId::Block(id) = body else { return None };
        heap.iter().find(|m| m.block == id)
    };
    let gone = |body: BodyId| -> Option<Polygon> {
        let polygon = &scene.body(body).polygon;
        let BodyId::Block(id) = body else {
            return Some(polygon.clone());
        };
        let Some(motion) = moves(body) else {
            return Some(polygon.clone());
        };
        let moved = Displacement::new(motion, scene.blocks[id.0].centroid, way);
        let ring = |ring: &Vec<Point>| ring.iter().map(|p| moved.moved(*p)).collect();
        let mut rings = polygon.rings().iter().map(ring);
        Polygon::new(rings.next()?, rings.collect()).ok()
    };
    analysis.frames[frame].contacts.iter().any(|contact| {
        let [a, b] = contact.interface.bodies;
        if moves(a).is_none() && moves(b).is_none() {
            return false;
        }
        let (Some(a), Some(b)) = (gone(a), gone(b)) else {
            return false;
        };
        let smaller = a.area().min(b.area());
        let shared = overlap(&ConvexPieces::new(&a), &ConvexPieces::new(&b), 0.0);
        shared.is_some_and(|o| o.area > SHARED * smaller)
    })
}

/// How far the motion of a heap is followed: the way in metres of a point of speed 1.
fn amplitude(analysis: &Analysis, heap: &[Motion], unit: f64) -> f64 {
    let scene = &analysis.scene;
    let fastest = heap.iter().map(|m| m.fastest(scene)).fold(0.0, f64::max);
    let spin = heap.iter().map(|m| m.spin.abs()).fold(0.0, f64::max);
    let size = heap
        .iter()
        .map(|m| scene.blocks[m.block.0].body.polygon.bounds())
        .reduce(Bounds::union)
        .map_or(0.0, Bounds::diagonal);
    if fastest <= 0.0 {
        return 0.0;
    }
    let way = f64::max(LEAST * unit.min(size), SHARE * size) / fastest;
    if spin > 0.0 {
        way.min(MOST / spin)
    } else {
        way
    }
}

fn followed(
    analysis: &Analysis,
    frame: usize,
    amplitude: impl Fn(&[Motion]) -> f64,
) -> Vec<Option<Displacement>> {
    let scene = &analysis.scene;
    let mut displacements = vec![None; scene.blocks.len()];
    for heap in together(analysis, frame, |_| true) {
        let amplitude = amplitude(&heap);
        for motion in heap {
            let centroid = scene.blocks[motion.block.0].centroid;
            displacements[motion.block.0] = Some(Displacement::new(&motion, centroid, amplitude));
        }
    }
    displacements
}

/// The motions of the blocks that move, those together whose blocks are joined by contacts that `joins` tells by their
/// numbers; in the order of their first blocks.
pub(crate) fn together(
    analysis: &Analysis,
    frame: usize,
    joins: impl Fn(usize) -> bool,
) -> Vec<Vec<Motion>> {
    let motions: BTreeMap<BlockId, Motion> =
        moving(analysis, frame).map(|m| (m.block, *m)).collect();
    let mut next: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
    for (number, contact) in analysis.frames[frame].contacts.iter().enumerate() {
        if let ([BodyId::Block(a), BodyId::Block(b)], true) =
            (contact.interface.bodies, joins(number))
        {
            next.entry(a).or_default().push(b);
            next.entry(b).or_default().push(a);
        }
    }
    let mut seen = vec![false; analysis.scene.blocks.len()];
    let mut found = Vec::new();
    for first in motions.keys() {
        let (mut part, mut left) = (Vec::new(), vec![*first]);
        while let Some(block) = left.pop() {
            let Some(motion) = motions.get(&block).filter(|_| !seen[block.0]) else {
                continue;
            };
            seen[block.0] = true;
            part.push(*motion);
            left.extend(next.get(&block).into_iter().flatten());
        }
        if !part.is_empty() {
            part.sort_by_key(|m| m.block);
            found.push(part);
        }
    }
    found
}

/// The motions of the blocks of a frame that are seen to move.
fn moving(analysis: &Analysis, frame: usize) -> impl Iterator<Item = &Motion> {
    let (scene, motions) = (&analysis.scene, &analysis.frames[frame].mechanism);
    let speed = |m: &Motion| m.fastest(scene);
    let fastest = motions.iter().map(speed).fold(0.0, f64::max);
    motions
        .iter()
        .filter(move |m| m.fastest(scene) > STILL * fastest)
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
        let displaced = followed(analysis, 0, |_| amplitude);
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
            let heaps = together(&analysis, 0, |_| true);
            assert_eq!(heaps.len(), 1);
            let amplitude = amplitude(&analysis, &heaps[0], unit(&scene, None));
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
