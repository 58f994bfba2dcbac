//! [`Bearing`]: the normal force of an interface, its eccentricity (how near the interface is to opening), and the used
//! fraction of its friction; and the robots that reach their limits.

use crate::geometry::Point;
use crate::mechanics::analysis::{ActingForce, Contact, RobotForce, SolvedFrame, Verdict};
use crate::mechanics::scene::{BodyId, RobotId, Scene};
use crate::mechanics::statics::interface::ContactKind;
use crate::products::wording::number::FULL_UTILISATION;

/// Forces below this fraction of the largest force may be numerical noise of the solver, unless they exceed
/// [`WEIGHT_TOL`] times the weight of the block.
const FORCE_TOL: f64 = 1e-6;
/// Forces above this fraction of the weight of the lighter block count as real, however large the other forces are.
const WEIGHT_TOL: f64 = 1e-3;

/// The force of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bearing {
    /// The normal force of the interface, N; larger than 0.
    pub pressed: f64,
    /// The distance of the resultant from the middle of the interface, divided by half the length of the safe part. The
    /// safe part lies between the two application points. `None` if the safe part is only a point.
    pub eccentricity: Option<f64>,
    /// The used fraction of the available friction; `None` if the friction coefficient is 0.
    pub friction: Option<f64>,
}

/// Returns the normal force, the eccentricity and the used friction of each contact, in the order of the contacts. The
/// entry is `None` for a contact whose normal force is 0 or [numerical noise](noise).
pub(crate) fn bearings(solved: SolvedFrame<'_>) -> Vec<Option<Bearing>> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let largest = frame_analysis.contacts.iter().map(Contact::normal_force).fold(0.0, f64::max);
    let bearing = |contact: &Contact| {
        let pressed = contact.normal_force();
        let [one, other] = contact.normal_forces;
        let point = contact.interface.kind == ContactKind::Corner || scene.kernel >= 1.0;
        let weights = contact.interface.bodies.iter().map(|body| match body {
            BodyId::Block(id) => scene.blocks[id.0].weight,
            BodyId::Ground(_) => f64::INFINITY,
        });
        let lighter = weights.fold(f64::INFINITY, f64::min);
        (pressed > noise(largest, lighter)).then(|| Bearing {
            pressed,
            eccentricity: (!point).then(|| (one - other).abs() / pressed),
            friction: (contact.interface.friction > 0.0).then_some(contact.friction_used),
        })
    };
    frame_analysis.contacts.iter().map(bearing).collect()
}

/// Returns the contacts that press, without those whose force is 0 or [numerical noise](noise).
pub(crate) fn pressed<'a>(solved: SolvedFrame<'a>) -> impl Iterator<Item = (&'a Contact, Bearing)> {
    let SolvedFrame { found, .. } = solved;
    let bearings = bearings(solved).into_iter();
    found.contacts.iter().zip(bearings).filter_map(|(contact, bearing)| Some((contact, bearing?)))
}

/// Returns the largest force in newtons that counts as numerical noise of the solver on a block of weight `weight` (N).
/// `largest` is the largest force of the frame (N).
pub(crate) fn noise(largest: f64, weight: f64) -> f64 {
    if weight > 0.0 {
        f64::min(FORCE_TOL * largest, WEIGHT_TOL * weight)
    } else if largest.is_finite() {
        FORCE_TOL * largest
    } else {
        0.0
    }
}

/// Returns the forces of joints and robots on the blocks, without [numerical noise](noise). `at` returns the point where
/// the force of a joint acts.
pub(crate) fn pressing(solved: SolvedFrame<'_>, at: impl Fn(&Contact) -> Point) -> Vec<ActingForce> {
    let SolvedFrame { scene, found, .. } = solved;
    let mut forces = Vec::new();
    for (contact, _) in pressed(solved) {
        forces.extend(contact.acting().into_iter().map(|acting| ActingForce { at: at(contact), ..acting }));
    }
    let noise = |robot: &RobotForce| noise(f64::INFINITY, scene.blocks[robot.block.0].weight);
    let robots = found.robots.iter().filter(|robot| robot.force.norm() > noise(robot));
    forces.extend(robots.map(RobotForce::acting));
    forces
}

/// True if at least one limit of a robot, for a force or a torque, is finite and larger than 0.
pub(crate) fn has_limits(scene: &Scene, robot: RobotId) -> bool {
    let limits = scene.robots[robot.0].limits;
    let finite = |limit: f64| limit.is_finite() && limit > 0.0;
    finite(limits.fx) || finite(limits.fy) || finite(limits.torque)
}

/// Returns the robots whose force or torque reaches one of their limits in a frame. The list is empty if the frame does
/// not stand.
pub(crate) fn robots_reached<'a>(solved: SolvedFrame<'a>) -> Vec<&'a RobotForce> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let stands = frame_analysis.verdict == Verdict::Stable;
    let robots = frame_analysis.robots.iter().filter(|_| stands);
    let reached = robots.filter(|r| r.limit_used >= FULL_UTILISATION);
    reached.filter(|r| has_limits(scene, r.robot)).collect()
}
