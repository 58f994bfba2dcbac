//! [`Joint`]: the relative motion of two bodies at an interface in a mechanism. The joint is a hinge if only one end of
//! the interface stays in contact and does not slide. It is a slip if the interface slides.
//!
//! In a mechanism that proves a fall, a contact opens at least with μ times its sliding speed. A contact that opens
//! with exactly this speed slips with friction. A contact that opens faster is free.

use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, Motion};
use crate::mechanics::scene::{BlockId, BodyId};

/// Relative speeds below this fraction of the largest relative speed count as zero. The tolerance is larger than that
/// of forces, because the solver computes motions less accurately.
const SPEED_TOL: f64 = 2e-3;

/// The relative motion of the two bodies of an interface. If there is neither a hinge nor a slip, the bodies separate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joint {
    /// The index of the contact in the frame.
    pub contact: usize,
    /// The application point of a hinge. This point stays in contact, the other application point opens, and nothing
    /// slides.
    pub hinge: Option<Point>,
    /// The application point that slides; `None` if the joint does not slide, or if both points stay in contact.
    pub touch: Option<Point>,
    /// The point `touch`, or the middle of the interface if `touch` is `None`.
    pub at: Point,
    /// Speed of the first body relative to the second along (−n_y, n_x). It is 0 if the joint does not slide or loses
    /// contact.
    pub slip: f64,
    /// Speed at which a sliding joint opens; 0 if the motion is along the joint.
    pub lift: f64,
}

/// Returns the joints of a frame: the interfaces whose two bodies move relative to each other in the mechanism.
pub(crate) fn joints(analysis: &Analysis, frame: usize) -> Vec<Joint> {
    let frame_analysis = &analysis.frames[frame];
    let motions = by_block(analysis, frame_analysis);
    let relative: Vec<[Vector; 2]> = frame_analysis
        .contacts
        .iter()
        .map(|contact| {
            contact.application_points.map(|p| {
                let [a, b] = contact.interface.bodies;
                velocity(analysis, &motions, a, p) - velocity(analysis, &motions, b, p)
            })
        })
        .collect();
    let largest = relative.iter().flatten().map(|v| v.norm()).fold(0.0, f64::max);
    if largest <= 0.0 {
        return Vec::new();
    }
    let spin = |body| match body {
        BodyId::Ground(_) => 0.0,
        BodyId::Block(BlockId(id)) => motions[id].map_or(0.0, |m| m.spin),
    };
    let one = |(number, contact): (usize, &Contact)| {
        let [a, b] = contact.interface.bodies;
        let turning = (spin(a) - spin(b)).abs() * frame_analysis.length;
        let joint = joint(contact, relative[number], turning, SPEED_TOL * largest)?;
        Some(Joint { contact: number, ..joint })
    };
    frame_analysis.contacts.iter().enumerate().filter_map(one).collect()
}

/// Classifies the relative motion at a contact; `None` if the two bodies move together. `relative` contains the
/// relative velocities at the two application points. `turning` is the magnitude of the relative spin times the length
/// scale of the frame, so that it is a speed. Speeds up to `noise` count as zero. The caller sets the contact index of
/// the result.
fn joint(contact: &Contact, relative: [Vector; 2], turning: f64, noise: f64) -> Option<Joint> {
    let interface = &contact.interface;
    let along = relative.map(|v| v.dot(&interface.tangent()));
    let opening = relative.map(|v| v.dot(&interface.normal));
    // An end of the interface stays in contact if it does not open, or if it opens at μ times its sliding speed
    // (dilation).
    let touches = [0, 1].map(|k| {
        let free = opening[k] - interface.friction * along[k].abs();
        opening[k] <= noise || free.abs() <= noise
    });
    let points = contact.application_points;
    let turns_about = match touches {
        [true, false] => Some(points[0]),
        [false, true] => Some(points[1]),
        // The bodies turn although both points stay in contact, so the two points nearly coincide.
        [true, true] if turning > 5.0 * noise => Some(points[0]),
        _ => None,
    };
    let slide = match touches {
        [true, _] => along[0],
        [_, true] => along[1],
        _ => 0.0,
    };
    let slip = if slide.abs() > noise { slide } else { 0.0 };
    let lift = match touches {
        [true, _] => opening[0],
        _ => opening[1],
    };
    let lift = if slip != 0.0 && lift > noise { lift } else { 0.0 };
    let parted = touches == [false, false];
    let (hinge, touch) = if slip == 0.0 { (turns_about, None) } else { (None, turns_about) };
    (hinge.is_some() || slip != 0.0 || parted).then_some(Joint {
        contact: 0,
        hinge,
        touch,
        at: touch.unwrap_or(interface.middle()),
        slip,
        lift,
    })
}

/// Returns the motion of each block in the mechanism of the frame, indexed by block; `None` for a block at rest.
fn by_block(analysis: &Analysis, frame_analysis: &FrameAnalysis) -> Vec<Option<Motion>> {
    let mut motions = vec![None; analysis.scene.blocks.len()];
    for motion in &frame_analysis.mechanism {
        motions[motion.block.0] = Some(*motion);
    }
    motions
}

fn velocity(analysis: &Analysis, motions: &[Option<Motion>], body: BodyId, at: Point) -> Vector {
    match body {
        BodyId::Ground(_) => Vector::zeros(),
        BodyId::Block(id) => motions[id.0].map_or(Vector::zeros(), |m| m.at(&analysis.scene, at)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::scene::Scene;

    fn joints_of(text: &str) -> (Scene, Vec<Joint>) {
        let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
        let joints = joints(&Analysis::new(&scene), 0);
        (scene, joints)
    }

    #[test]
    fn the_hinges_of_a_thin_arch_alternate_between_its_two_faces() {
        let (_, joints) = joints_of(include_str!("../../../assets/study/arch-27-thin.json"));
        assert!(joints.iter().all(|j| j.slip == 0.0));
        let mut hinges: Vec<Point> = joints.iter().filter_map(|j| j.hinge).collect();
        // Sort the hinges from one springing to the other. The arch is a half circle about the origin, and its
        // centreline has radius 1.
        let angle = |p: &Point| libm::atan2(p.y, -p.x);
        hinges.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        let mut outside: Vec<bool> = hinges.iter().map(|p| p.coords.norm() > 1.0).collect();
        outside.dedup();
        assert_eq!(outside, [true, false, true, false, true], "{hinges:?}");
    }

    #[test]
    fn a_block_on_a_steep_slope_slips_and_a_tall_one_turns() {
        let on_slope = |high: f64| {
            format!(
                r#"{{ "drystone": 1, "friction": 0.4,
                     "shapes": {{ "slope": {{ "polygon": [[-9,-1],[9,-1],[9,0],[-9,0]] }},
                                  "block": {{ "polygon": [[0,0],[1,0],[1,{high}],[0,{high}]] }} }},
                     "ground": [ {{ "shape": "slope", "angle": 30 }} ],
                     "blocks": [ {{ "id": "a", "shape": "block", "angle": 30, "weight": 5 }} ] }}"#
            )
        };
        let (_, slides) = joints_of(&on_slope(0.5));
        let [joint] = slides[..] else { panic!("{slides:?}") };
        assert_eq!(joint.hinge, None);
        assert!(joint.slip != 0.0);
        let (_, turns) = joints_of(&on_slope(8.0).replace("0.4", "2.0"));
        let [joint] = turns[..] else { panic!("{turns:?}") };
        let hinge = joint.hinge.expect("a hinge at the lower corner");
        assert!(hinge.coords.norm() < 1e-9 && joint.slip == 0.0, "{joint:?}");
    }
}
