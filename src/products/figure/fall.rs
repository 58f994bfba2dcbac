//! [`Fall`]: a motion by which a frame falls, with the blocks that move visibly, the rigid bodies that they form, and the
//! [`Joint`]s between these bodies.
//!
//! A joint is a hinge if only one end of its interface stays in contact and does not slide. It is a slip if the
//! interface slides. In a mechanism that proves a fall, a contact opens at least with μ times its sliding speed. A
//! contact that opens with exactly this speed slips with friction. A contact that opens faster is free.

use std::collections::BTreeMap;

use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, Motion, SolvedFrame, Verdict};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::products::wording::margin::OtherFriction;

/// Relative speeds below this fraction of the largest relative speed count as zero. The tolerance is larger than that
/// of forces, because the solver computes motions less accurately.
const SPEED_TOL: f64 = 2e-3;
/// A block is at rest if the speed of its fastest point is at most this fraction of the largest speed of all blocks.
/// Slower motions are numerical noise of the solver or not visible.
const REST_TOL: f64 = 1e-3;

/// A motion by which a frame falls.
pub(crate) struct Fall<'a> {
    pub scene: &'a Scene,
    /// The index of the frame, from 0.
    pub frame: usize,
    pub found: &'a FrameAnalysis,
    /// The interfaces whose two bodies move relative to each other.
    pub joints: Vec<Joint>,
    /// The motion of each block, indexed by block; `None` for a block at rest.
    motions: Vec<Option<Motion>>,
}

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
    /// The larger relative speed of the two bodies at the ends of the interface.
    pub speed: f64,
}

impl<'a> Fall<'a> {
    /// The motion by which a frame (numbered from 0) falls. Nothing moves if the frame does not fall.
    pub fn of(analysis: &'a Analysis, frame: usize) -> Fall<'a> {
        let found = &analysis.frames[frame];
        let falls = found.verdict == Verdict::Unstable;
        Fall::with(analysis, frame, if falls { &found.mechanism } else { &[] })
    }

    /// A motion of a frame under other loads.
    pub fn with(analysis: &'a Analysis, frame: usize, motions: &[Motion]) -> Fall<'a> {
        Fall::with_friction(analysis, frame, motions, None)
    }

    /// A motion of a frame under other loads, and with another friction coefficient at all joints.
    pub fn with_friction(
        analysis: &'a Analysis,
        frame: usize,
        motions: &[Motion],
        friction: Option<OtherFriction>,
    ) -> Fall<'a> {
        let SolvedFrame { scene, found, .. } = analysis.at(frame);
        let motions = motions_by_block(scene, motions);
        let mut fall = Fall { scene, frame, found, joints: Vec::new(), motions };
        fall.joints = fall.found_joints(friction);
        fall
    }

    /// Returns the motions of the blocks that move visibly: the speed of their fastest point exceeds [`REST_TOL`] times
    /// the largest speed in the frame.
    pub fn moving(&self) -> impl Iterator<Item = &Motion> {
        let speeds = self.motions.iter().flatten().map(|motion| motion.fastest(self.scene));
        let fastest = speeds.fold(0.0, f64::max);
        self.motions.iter().flatten().filter(move |motion| motion.fastest(self.scene) > REST_TOL * fastest)
    }

    /// Returns the groups of moving blocks that are in contact, in the order of their first blocks in the scene.
    pub fn parts(&self) -> Vec<Vec<Motion>> {
        self.groups(|_| true)
    }

    /// Groups the moving blocks into rigid bodies: two blocks in contact belong to the same rigid body unless they move
    /// relative to each other. The rigid bodies are in the order of their first blocks in the scene.
    pub fn rigid_bodies(&self) -> Vec<Vec<Motion>> {
        let mut is_joint = vec![false; self.found.contacts.len()];
        for joint in &self.joints {
            is_joint[joint.contact] = true;
        }
        self.groups(|contact| !is_joint[contact])
    }

    /// Groups the moving blocks into connected components. Two blocks are connected if `joins` returns true for the index
    /// of a contact between them.
    fn groups(&self, joins: impl Fn(usize) -> bool) -> Vec<Vec<Motion>> {
        let mut rest: BTreeMap<BlockId, Motion> = self.moving().map(|motion| (motion.block, *motion)).collect();
        let mut neighbours: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
        for (number, contact) in self.found.contacts.iter().enumerate() {
            if let ([BodyId::Block(a), BodyId::Block(b)], true) = (contact.interface.bodies, joins(number)) {
                neighbours.entry(a).or_default().push(b);
                neighbours.entry(b).or_default().push(a);
            }
        }
        let mut groups = Vec::new();
        while let Some((first, _)) = rest.first_key_value() {
            let (mut group, mut stack) = (Vec::new(), vec![*first]);
            while let Some(block) = stack.pop() {
                if let Some(motion) = rest.remove(&block) {
                    group.push(motion);
                    stack.extend(neighbours.get(&block).into_iter().flatten());
                }
            }
            group.sort_by_key(|motion| motion.block);
            groups.push(group);
        }
        groups
    }

    fn motion(&self, body: BodyId) -> Option<&Motion> {
        let BodyId::Block(block) = body else { return None };
        self.motions[block.0].as_ref()
    }

    /// Returns the velocity of a point of the first body of a contact relative to the second body.
    fn relative(&self, contact: &Contact, at: Point) -> Vector {
        let [a, b] = contact.interface.bodies.map(|body| {
            let motion = self.motion(body);
            motion.map_or(Vector::zeros(), |motion| motion.at(self.scene, at))
        });
        a - b
    }

    fn found_joints(&self, friction: Option<OtherFriction>) -> Vec<Joint> {
        let contacts = &self.found.contacts;
        let relative = |contact: &Contact| contact.application_points.map(|at| self.relative(contact, at));
        let speeds = contacts.iter().flat_map(relative).map(|v| v.norm());
        let noise = SPEED_TOL * speeds.fold(0.0, f64::max);
        if noise <= 0.0 {
            return Vec::new();
        }
        let spin = |body| self.motion(body).map_or(0.0, |motion| motion.spin);
        let one = |(number, contact): (usize, &Contact)| {
            let [a, b] = contact.interface.bodies;
            let turning = (spin(a) - spin(b)).abs() * self.found.length;
            let present = contact.interface.friction;
            let friction = friction.map_or(present, |other| other.of(present));
            Some(Joint { contact: number, ..joint(contact, relative(contact), (turning, friction), noise)? })
        };
        contacts.iter().enumerate().filter_map(one).collect()
    }
}

/// Returns the motion of each block, indexed by block; `None` for a block that does not move.
pub(super) fn motions_by_block(scene: &Scene, motions: &[Motion]) -> Vec<Option<Motion>> {
    let mut by_block = vec![None; scene.blocks.len()];
    for motion in motions {
        by_block[motion.block.0] = Some(*motion);
    }
    by_block
}

/// Classifies the relative motion at a contact; `None` if the two bodies move together. `relative` contains the
/// relative velocities at the two application points. `turning` is the magnitude of the relative spin times the length
/// scale of the frame, so that it is a speed, and stands before the friction coefficient. Speeds up to `noise` count as
/// zero. The caller sets the contact index of the result.
fn joint(contact: &Contact, relative: [Vector; 2], (turning, friction): (f64, f64), noise: f64) -> Option<Joint> {
    let interface = &contact.interface;
    let along = relative.map(|v| v.dot(&interface.tangent()));
    let opening = relative.map(|v| v.dot(&interface.normal));
    // An end of the interface stays in contact if it does not open, or if it opens at μ times its sliding speed
    // (dilation).
    let touches = [0, 1].map(|k| {
        let free = opening[k] - friction * along[k].abs();
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
        speed: relative.map(|v| v.norm()).into_iter().fold(0.0, f64::max),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::scene::Scene;

    fn joints_of(text: &str) -> (Scene, Vec<Joint>) {
        let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
        let joints = Fall::of(&Analysis::new(&scene), 0).joints;
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
