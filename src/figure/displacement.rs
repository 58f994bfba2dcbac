//! [`Displacement`]: how far a block has gone along a mechanism, as a finite rigid motion, so that it keeps its shape.

use crate::analysis::{Analysis, Motion, Verdict};
use crate::geometry::{Bounds, Point, Vector, quarter_turn};

/// The fastest point goes at least so many unit edges …
const LEAST: f64 = 0.35;
/// … and at least this share of the diagonal of all that moves: in an arch of many voussoirs a unit edge is too little
/// for a hinge to be seen to open.
const SHARE: f64 = 0.045;
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
    pub fn of(motion: &Motion, centroid: Point, amplitude: f64) -> Displacement {
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
pub(crate) fn displacements(
    analysis: &Analysis<'_>,
    frame: usize,
    unit: f64,
) -> Vec<Option<Displacement>> {
    let (scene, found) = (analysis.scene, &analysis.frames[frame]);
    let moving: Vec<&Motion> = moving(analysis, frame).collect();
    if found.verdict != Verdict::Unstable || moving.is_empty() {
        return Vec::new();
    }
    let fastest = moving
        .iter()
        .map(|m| m.fastest(scene))
        .fold(0.0, f64::max);
    let all = moving
        .iter()
        .map(|m| scene.blocks[m.block.0].body.polygon.bounds())
        .reduce(Bounds::union)
        .map_or(0.0, Bounds::diagonal);
    let amplitude = f64::max(LEAST * unit, SHARE * all) / fastest;
    let mut displacements = vec![None; scene.blocks.len()];
    for motion in moving {
        let centroid = scene.blocks[motion.block.0].centroid;
        displacements[motion.block.0] = Some(Displacement::of(motion, centroid, amplitude));
    }
    displacements
}

/// The motions of the blocks of a frame that are seen to move.
pub(crate) fn moving<'a>(
    analysis: &'a Analysis<'_>,
    frame: usize,
) -> impl Iterator<Item = &'a Motion> {
    let (scene, motions) = (analysis.scene, &analysis.frames[frame].mechanism);
    let speed = |m: &Motion| m.fastest(scene);
    let fastest = motions.iter().map(speed).fold(0.0, f64::max);
    motions
        .iter()
        .filter(move |m| m.fastest(scene) > STILL * fastest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::BlockId;

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
            let moved = Displacement::of(&motion, centroid, 0.6);
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
}
