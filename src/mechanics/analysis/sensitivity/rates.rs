//! [`Rates`]: the derivatives of the limit of stability, if forces and mechanism at this limit are known.
//!
//! Every derivative is −u·∂r/∂p divided by u·∂r/∂λ. Here r is the sum of the forces on each body, u the mechanism, p
//! the quantity that changes, and λ the parameter of the margin. The bodies of the mechanism move rigidly. If the point
//! of a force moves, the power therefore changes by the change of its moment times the angular velocity.

use super::corners::Corners;
use super::reduced::{RigidMotion, State};
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::proof::ContactForces;
use crate::mechanics::scene::{BodyId, Scene};
use crate::mechanics::statics::assembly::{Assembly, AssemblyContact};
use crate::mechanics::statics::effect::FrameContext;

/// The derivatives of the value at an end, for one state.
pub(super) struct Rates {
    /// For each joined corner, per metre that it moves along x and along y.
    pub corners: Vec<Vector>,
    /// For each block, per newton of its weight; 0 for blocks outside the component.
    pub weights: Vec<f64>,
    /// For each interface, per unit of its friction coefficient.
    pub friction: Vec<f64>,
    /// For each load, per metre that its point moves along x and along y.
    pub loads: Vec<Vector>,
}

impl Rates {
    /// Computes the derivatives of the limit with respect to all corners, weights, friction coefficients and load
    /// points of a frame. `None` if the power along the
    /// mechanism does not depend on the margin's parameter.
    pub fn new(context: &FrameContext, corners: &Corners, changed: &Assembly, state: &State) -> Option<Rates> {
        let scene = context.scene;
        let value_per_power = -1.0 / state.work;
        if !value_per_power.is_finite() {
            return None;
        }
        let mut rates = Rates {
            corners: vec![Vector::zeros(); corners.count],
            weights: vec![0.0; scene.blocks().len()],
            friction: vec![0.0; context.interfaces.len()],
            loads: vec![Vector::zeros(); scene.loads().len()],
        };
        for (contact, forces) in changed.contacts.iter().zip(&state.forces) {
            rates.add_contact(corners, contact, forces, &state.motions);
        }
        let mut body_of_block = vec![None; scene.blocks().len()];
        for (number, body) in changed.bodies.iter().enumerate() {
            body_of_block[body.block.0] = Some(number);
            let motion = &state.motions[number];
            rates.weights[body.block.0] = changed.pull.dot(&motion.at(body.centroid));
        }
        // For each body: the change of the power of the loads and grip forces at its centroid, per metre that the
        // centroid moves.
        let mut follows = vec![Vector::zeros(); changed.bodies.len()];
        for (rate, load) in rates.loads.iter_mut().zip(scene.loads()) {
            let Some(body) = body_of_block[load.block.0] else {
                continue;
            };
            *rate = state.power_per_shift(body, load.times_factor(changed.load_factor).force);
            if load.at_centroid {
                follows[body] += *rate;
            }
        }
        for (grip, force) in changed.grips.iter().zip(&state.grips) {
            if context.frame.holds[grip.hold].at_centroid {
                follows[grip.body] += state.power_per_shift(grip.body, *force);
            }
        }
        for (place, corner) in corners.all.iter().enumerate() {
            let BodyId::Block(block) = corner.body else {
                continue;
            };
            if let Some(body) = body_of_block[block.0] {
                let shift = CornerShift::new(corners, place, changed.bodies[body].centroid, scene);
                let weight = changed.bodies[body].weight;
                let with_centroid = follows[body] + state.power_per_shift(body, changed.pull * weight);
                let mut rate = shift.of_centroid(with_centroid);
                if scene.blocks()[block.0].weighs_by_area {
                    let density = weight / shift.area;
                    rate += shift.of_area * (density * rates.weights[block.0]);
                }
                rates.corners[corners.joined[place]] += rate;
            }
        }
        rates.corners.iter_mut().for_each(|v| *v *= value_per_power);
        rates.weights.iter_mut().for_each(|v| *v *= value_per_power);
        rates.friction.iter_mut().for_each(|v| *v *= value_per_power);
        rates.loads.iter_mut().for_each(|v| *v *= value_per_power);
        Some(rates)
    }

    /// Adds the changes of the power of a contact's forces in two cases: the ends of the contact move, which also
    /// rotates its normal, or its friction coefficient changes.
    fn add_contact(
        &mut self,
        corners: &Corners,
        contact: &AssemblyContact,
        forces: &ContactForces,
        motions: &[RigidMotion],
    ) {
        let rest = RigidMotion::REST;
        let (on, from) = (&motions[contact.on], contact.from.map_or(rest, |b| motions[b]));
        let apart = |at: Point| on.at(at) - from.at(at);
        let spin = on.spin - from.spin;
        let (normal, tangent) = (contact.normal, contact.tangent());
        let slip = tangent.dot(&apart(contact.points[0]));
        let pressed = forces.normal[0] + forces.normal[1];
        self.friction[contact.interface] -= pressed * slip.abs();
        let Some(place) = &corners.contacts[contact.interface] else {
            return;
        };
        // Compute the change of power if an application point moves (per metre), and if the normal rotates (per
        // radian).
        let at_point = |k: usize| {
            let friction = if k == 0 { forces.friction } else { 0.0 };
            let force = normal * forces.normal[k] + tangent * friction;
            -quarter_turn(force) * spin
        };
        let mut turning = -forces.friction * normal.dot(&apart(contact.points[0]));
        for (force, at) in forces.normal.iter().zip(contact.points) {
            turning += force * tangent.dot(&apart(at));
        }
        // The application points are the ends of the contact, moved inward by the same fraction of its length.
        let length = (contact.ends[1] - contact.ends[0]).norm();
        let inward = if length > 0.0 { (contact.points[0] - contact.ends[0]).norm() / length } else { 0.0 };
        let [first, second] = [at_point(0), at_point(1)];
        self.corners[place.ends[0]] += first * (1.0 - inward) + second * inward;
        self.corners[place.ends[1]] += second * (1.0 - inward) + first * inward;
        // If the second end moves along the normal, the normal rotates clockwise.
        let (line, across, long) = match place.edge {
            None => (place.ends, normal, length),
            Some(edge) => {
                let [a, b] = edge.map(|joined| corners.positions[joined]);
                let along = b - a;
                let across = quarter_turn(along.normalize());
                (edge, -across, along.norm())
            }
        };
        let turn = across * (turning / long);
        self.corners[line[0]] += turn;
        self.corners[line[1]] -= turn;
    }
}

/// How the area and the centroid of a body change if one of its corners moves.
struct CornerShift {
    area: f64,
    /// The change of the area per metre along x and y.
    of_area: Vector,
    /// The changes of the centroid per metre along x and along y.
    of_axes: [Vector; 2],
}

impl CornerShift {
    fn new(corners: &Corners, place: usize, centroid: Point, scene: &Scene) -> CornerShift {
        let corner = &corners.all[place];
        let area = scene.body(corner.body).polygon.area();
        let [before, after] = corners.around(place).map(|at| at - centroid);
        let own = corner.at - centroid;
        // The area is half the sum of the cross products of neighbouring corners. The first moment is a sixth of the
        // sum of (cross product) · (sum of the two corners).
        let of_area = -quarter_turn(after - before) * 0.5;
        let of_axes = [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)].map(|d| {
            let (before_turn, after_turn) = (cross(before, d), cross(d, after));
            let moment = d * (cross(before, own) + cross(own, after))
                + (before + own) * before_turn
                + (own + after) * after_turn;
            moment / (6.0 * area)
        });
        CornerShift { area, of_area, of_axes }
    }

    /// Applies the chain rule: `rate` is the derivative with respect to the centroid of the block, and the result is
    /// the derivative with respect to this corner. Both have the components x and y.
    fn of_centroid(&self, rate: Vector) -> Vector {
        Vector::new(rate.dot(&self.of_axes[0]), rate.dot(&self.of_axes[1]))
    }
}
