//! A program whose joints are parallel, or square to each other, where they are so but for the rounding of coordinates.

use super::Program;
use crate::geometry::{Vector, cross};

/// Joints whose directions, or the squares to them, differ by less than this, in radians, are meant to be the same.
const SAME: f64 = 1e-5;

impl Program {
    /// The program with nearly parallel joints made parallel; `None` where there are none.
    ///
    /// Between faces that are parallel but for 10⁻⁶ a block is a wedge so slender that velocities of 10⁶ open it; then the
    /// least force ends without a status, which it does not where the faces are parallel, or less nearly so.
    pub fn with_straight_joints(&self) -> Option<Program> {
        let mut angles: Vec<(f64, usize)> = self
            .contacts
            .iter()
            .enumerate()
            .map(|(k, contact)| (beyond_square(contact.normal), k))
            .collect();
        angles.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut straight = self.clone();
        let mut changed = false;
        for same in angles.chunk_by(|a, b| b.0 - a.0 <= SAME) {
            let mean = same.iter().map(|a| a.0).sum::<f64>() / same.len() as f64;
            for (angle, k) in same {
                changed |= *angle != mean;
                let normal = &mut straight.contacts[*k].normal;
                let (sin, cos) = libm::sincos(mean - angle);
                *normal = Vector::new(
                    cos * normal.x - sin * normal.y,
                    sin * normal.x + cos * normal.y,
                );
            }
        }
        changed.then_some(straight)
    }
}

/// The angle of a direction from the nearest axis, radians, from −π/4 to π/4.
fn beyond_square(direction: Vector) -> f64 {
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

    #[test]
    fn an_angle_is_that_from_the_nearest_axis() {
        for turn in [-0.7, -1e-7, 0.0, 0.3] {
            for quarters in 0..4 {
                let angle = turn + f64::from(quarters) * core::f64::consts::FRAC_PI_2;
                let direction = Vector::new(libm::cos(angle), libm::sin(angle));
                assert!((beyond_square(direction) - turn).abs() < 1e-15, "{angle}");
            }
        }
    }
}
