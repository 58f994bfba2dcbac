//! [`Program::simpler`]: programs that differ from a program only by rounding or by slight loads, and that solvers solve
//! more easily.

use core::f64::consts::FRAC_PI_2;

use super::Program;
use crate::geometry::{Vector, cross};

/// Joints whose angles differ by less than this (radians, modulo 90°) are meant to be parallel or perpendicular.
///
/// Rounding coordinates to six digits turns a joint by about 10⁻⁶. Ten times this value would straighten wedges that
/// were drawn on purpose; a tenth would miss joints of drawings with six digits.
const PARALLEL_TOL: f64 = 1e-5;
/// Rotations below this, in radians, are the rounding of the angles themselves.
const ROUNDING_TOL: f64 = 1e-12;

/// Components of loads below this fraction of the largest component are slight: a thousand times the tolerance of
/// solvers, so that a load that is not slight has three correct digits.
const SLIGHT_LOAD: f64 = 1e-6;

impl Program {
    /// Returns this program with parallel joints, and without slight loads, if it differs from them.
    pub fn simpler(&self) -> impl Iterator<Item = Program> {
        [self.with_parallel_joints(), self.without_slight_loads()].into_iter().flatten()
    }

    /// Returns the program without slight loads. `None` if there are none.
    ///
    /// A load of 10⁻⁷ of the weights may need forces of robots that balance nothing else. The program of least force
    /// then ends without a result. Without this load it has one.
    fn without_slight_loads(&self) -> Option<Program> {
        let largest = self.loads.iter().fold(0.0, |most: f64, load| most.max(load.abs()));
        let plain = |load: &f64| if load.abs() < SLIGHT_LOAD * largest { 0.0 } else { *load };
        let loads: Vec<f64> = self.loads.iter().map(plain).collect();
        (loads != self.loads).then(|| Program { loads, ..self.clone() })
    }

    /// Returns the program with all nearly parallel or perpendicular joints made exactly parallel or perpendicular.
    /// `None` if this changes no joint.
    ///
    /// A block between two faces that are parallel up to an angle of 10⁻⁶ is a very slender wedge. The faces open with
    /// a speed of 1 only if the block moves with a speed of 10⁶, so the solver ends without a result. It solves the
    /// program if the faces are exactly parallel.
    fn with_parallel_joints(&self) -> Option<Program> {
        let normals: Vec<Vector> = self.contacts.iter().map(|c| c.normal).collect();
        let alignment_angles = alignment_angles(&normals);
        if alignment_angles.iter().all(|turn| turn.abs() <= ROUNDING_TOL) {
            return None;
        }
        let mut straight = self.clone();
        for (contact, turn) in straight.contacts.iter_mut().zip(alignment_angles) {
            contact.normal = rotated(contact.normal, turn);
        }
        Some(straight)
    }
}

/// Returns by which angle, in radians, each direction must rotate, so that nearly parallel or perpendicular directions
/// become exactly parallel or perpendicular.
///
/// Angles modulo 90° are sorted and split into clusters at gaps (single linkage). All directions of a cluster are
/// rotated to its mean angle.
fn alignment_angles(directions: &[Vector]) -> Vec<f64> {
    let angles = directions.iter().map(|d| angle_to_axis(*d));
    let mut angles: Vec<(f64, usize)> = angles.zip(0..).collect();
    angles.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Angles are periodic: a cluster at 45° lies at both ends of the list. Rotate the list so that it starts after a
    // gap.
    let gap = angles.windows(2).position(|w| w[1].0 - w[0].0 > PARALLEL_TOL);
    let first = gap.map_or(0, |gap| gap + 1);
    for (angle, _) in &mut angles[..first] {
        *angle += FRAC_PI_2;
    }
    angles.rotate_left(first);
    let mut alignment_angles = vec![0.0; directions.len()];
    for same in angles.chunk_by(|a, b| b.0 - a.0 <= PARALLEL_TOL) {
        let mean = same.iter().map(|a| a.0).sum::<f64>() / same.len() as f64;
        for (angle, number) in same {
            alignment_angles[*number] = mean - angle;
        }
    }
    alignment_angles
}

/// Returns a direction rotated anticlockwise by an angle in radians.
fn rotated(direction: Vector, angle: f64) -> Vector {
    let (sin, cos) = libm::sincos(angle);
    Vector::new(cos * direction.x - sin * direction.y, sin * direction.x + cos * direction.y)
}

/// Returns the angle from the nearest coordinate half-axis (±x or ±y) to a direction, in radians from −π/4 to π/4,
/// anticlockwise positive.
fn angle_to_axis(direction: Vector) -> f64 {
    let axis = if direction.x.abs() >= direction.y.abs() {
        Vector::new(direction.x.signum(), 0.0)
    } else {
        Vector::new(0.0, direction.y.signum())
    };
    libm::atan2(cross(axis, direction), axis.dot(&direction))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_vector(angle: f64) -> Vector {
        Vector::new(libm::cos(angle), libm::sin(angle))
    }

    /// The result does not depend on the orientation of the wall, even if its joints lie halfway between the axes.
    #[test]
    fn nearly_parallel_or_perpendicular_joints_are_aligned_and_no_others() {
        for turn in [0.0, -0.7, 0.3, FRAC_PI_2 / 2.0, -FRAC_PI_2 / 2.0] {
            let off = [1e-6, -2e-6, 5e-7, 0.0, -1e-6];
            let mut directions: Vec<Vector> =
                (0..5_u8).zip(off).map(|(k, off)| unit_vector(turn + off + f64::from(k) * FRAC_PI_2)).collect();
            directions.push(unit_vector(turn + 0.01));
            let alignment_angles = alignment_angles(&directions);
            assert_eq!(alignment_angles[5], 0.0, "{turn}");
            let straight: Vec<Vector> =
                directions.iter().zip(&alignment_angles).map(|(d, turn)| rotated(*d, *turn)).collect();
            for other in &straight[1..5] {
                let (parallel, square) = (cross(straight[0], *other), straight[0].dot(other));
                assert!(parallel.abs().min(square.abs()) < 1e-15, "{turn}");
            }
            assert!(alignment_angles.iter().all(|turn| turn.abs() < 4e-6), "{turn}");
        }
        let exact = alignment_angles(&[unit_vector(0.0), unit_vector(FRAC_PI_2)]);
        assert!(exact.iter().all(|turn| turn.abs() <= ROUNDING_TOL));
    }
}
