//! [`joint_name`]: names a joint by its two bodies, and by its side if the same bodies have several joints.

use super::description;
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::{Contact, FrameAnalysis};
use crate::mechanics::scene::{BodyId, Scene};

/// Returns the names of the two bodies of a joint, such as `beam and the ground`. If the bodies have several joints,
/// the side of the joint follows: `beam and the ground (left)`.
pub(crate) fn joint_name(scene: &Scene, frame_analysis: &FrameAnalysis, contact: &Contact) -> String {
    let pair = description::pair(scene, contact.interface.bodies);
    let contacts = frame_analysis.contacts.iter();
    let alike = contacts.filter(|other| have_same_names(other, contact));
    let middles: Vec<Point> = alike.map(middle).collect();
    match side(&middles, middle(contact)) {
        Some(side) => format!("{pair} ({side})"),
        None => pair,
    }
}

fn middle(contact: &Contact) -> Point {
    let [from, to] = contact.interface.ends;
    from + 0.5 * (to - from)
}

/// True if two joints have the same two bodies. All ground counts as one body, because it has one name.
fn have_same_names(a: &Contact, b: &Contact) -> bool {
    let same = |a: BodyId, b: BodyId| match (a, b) {
        (BodyId::Ground(_), BodyId::Ground(_)) => true,
        _ => a == b,
    };
    let mut pairs = a.interface.bodies.into_iter().zip(b.interface.bodies);
    pairs.all(|(a, b)| same(a, b))
}

/// Returns the side of the joint with the middle `at` among several joints with the middles `middles`: `left` or
/// `right`, or `lower` or `upper` if the joints differ more in height. A joint between two others is `between the
/// others`. Returns `None` if there is only one joint, or if all are at one place.
fn side(middles: &[Point], at: Point) -> Option<&'static str> {
    let bounds = Bounds::from_points(middles.iter().copied())?;
    let (across, position, [first, last]) = if bounds.width() >= bounds.height() {
        (bounds.width(), at.x - bounds.min.x, ["left", "right"])
    } else {
        (bounds.height(), at.y - bounds.min.y, ["lower", "upper"])
    };
    if across <= 0.0 {
        return None;
    }
    // Only the first and the last joint have the name of a side; the tolerance covers rounding.
    let tolerance = 1e-9 * across;
    Some(match position {
        p if p <= tolerance => first,
        p if p >= across - tolerance => last,
        _ => "between the others",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_of_the_same_bodies_are_told_apart_by_their_sides() {
        let at = |x: f64, y: f64| Point::new(x, y);
        let feet = [at(0.0, 0.0), at(3.0, 0.1), at(5.0, 0.0)];
        let sides = feet.map(|p| side(&feet, p));
        assert_eq!(sides, [Some("left"), Some("between the others"), Some("right")]);
        let steps = [at(0.0, 0.0), at(0.5, 2.0)];
        assert_eq!(steps.map(|p| side(&steps, p)), [Some("lower"), Some("upper")]);
        assert_eq!(side(&[at(1.0, 1.0)], at(1.0, 1.0)), None);
    }
}
