//! Computes how well each body is balanced: its imbalance τ, relative to the forces on this body only.
//!
//! A body balances to τ if it balances exactly after each force on it is changed by at most τ of its amount and moved
//! by at most τ of the body's radius R. Each force is a vector (F_x, F_y, M/R), where M is its moment about the
//! centroid. The forces are each normal force, each friction force, each component of a robot, the weight, and the
//! listed loads. Moving all forces by R changes M/R by at most Σ |F|. The imbalance is therefore the gauge of the
//! residual in the zonotope of these vectors ([`zonotope_gauge`]). τ has no unit, and does not depend on other
//! bodies.
//!
//! Forces are rounded numbers, so the residual is summed with twice the digits. A rounding of about 10⁻¹⁵ Σ |F| is
//! allowed in every direction in which the body can compensate for it: by friction within its cone, or by a change of
//! its load by τ.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use super::Forces;
use crate::geometry::{
    CompensatedSum, Point, Vec3, Vector, cross, quick_gauge_bound, zonotope_gauge, zonotope_gauge_bound,
};
use crate::mechanics::statics::assembly::{Assembly, AssemblyBody};

/// An upper bound of the relative rounding error of a few sums and products.
const ROUNDING_TOL: f64 = 16.0 * f64::EPSILON;

/// The strictest threshold of any proof. The allowed rounding is scaled so that it changes τ by no more than this.
const MIN_THRESHOLD: f64 = 1e-9;

/// If an upper bound of τ is at most this, it is returned instead of τ. The bound is faster to compute than τ, and this
/// limit is at most a tenth of any threshold.
const NEGLIGIBLE_IMBALANCE: f64 = 1e-10;

/// The friction force at a contact of a body, and the largest friction force that the normal forces of the contact
/// allow.
struct Cone {
    /// A friction force of 1 N as a vector (F_x, F_y, M/R).
    along: Vec3,
    /// The absolute value of the friction force, N.
    given: f64,
    /// The largest friction force that the normal forces of the contact allow, N.
    available: f64,
}

/// All forces on one body.
struct BodyForces {
    centroid: Point,
    radius: f64,
    /// The sums of F_x, F_y and M.
    residual: [CompensatedSum; 3],
    generators: Vec<Vec3>,
    cones: Vec<Cone>,
    /// Σ |F| over all forces, N.
    total: f64,
    /// Σ |F| over the loads only, N; moments are divided by the radius.
    load: f64,
}

impl BodyForces {
    fn on(body: &AssemblyBody, pull: Vector, load_factor: f64) -> BodyForces {
        let mut acting = BodyForces {
            centroid: body.centroid,
            radius: body.radius(),
            residual: [CompensatedSum::default(); 3],
            generators: Vec::with_capacity(16),
            cones: Vec::with_capacity(8),
            total: 0.0,
            load: 0.0,
        };
        acting.load(pull * body.weight, 0.0);
        let listed = body.given(load_factor);
        acting.load(listed.force, listed.moment);
        acting
    }

    /// Adds a load on the body: a force, N, and a moment about the centroid, N·m.
    fn load(&mut self, force: Vector, moment: f64) {
        self.residual[0].add(force.x);
        self.residual[1].add(force.y);
        self.residual[2].add(moment);
        self.generators.push([force.x, force.y, moment / self.radius]);
        self.total += force.norm();
        self.load += force.norm() + moment.abs() / self.radius;
    }

    /// Adds a force on the body, N, that acts at the point `at`.
    fn force(&mut self, at: Point, force: Vector) {
        let arm = at - self.centroid;
        self.residual[0].add(force.x);
        self.residual[1].add(force.y);
        self.residual[2].add_product(arm.x, force.y);
        self.residual[2].add_product(-arm.y, force.x);
        self.generators.push([force.x, force.y, cross(arm, force) / self.radius]);
        self.total += force.norm();
    }

    /// Adds a torque on the body, N·m.
    fn torque(&mut self, torque: f64) {
        self.residual[2].add(torque);
        self.generators.push([0.0, 0.0, torque / self.radius]);
    }

    /// Returns the sum of all forces on the body, N: F_x, F_y, and the moment divided by the radius. The body balances
    /// if all are 0.
    fn residual(&self) -> Vec3 {
        let [x, y, moment] = self.residual.map(CompensatedSum::value);
        [x, y, moment / self.radius]
    }

    /// Adds the generators of the zonotope that concern all forces together: a displacement of all forces, and the
    /// allowed rounding error.
    fn add_common_generators(&mut self) {
        // Moving every force by τ R changes M/R by at most τ Σ |F|.
        self.generators.push([0.0, 0.0, self.total]);
        let rounding = ROUNDING_TOL / MIN_THRESHOLD * self.total;
        for cone in &self.cones {
            // Along each contact, friction may change by the rounding error, but at most by the available friction. The
            // friction force is already a generator; add only what exceeds it.
            let spare = rounding.min(cone.available) - cone.given;
            if spare > 0.0 {
                self.generators.push(cone.along.map(|v| v * spare));
            }
        }
        // A body without a load may have the full rounding error, because no load can make it move.
        let load_change = match self.load {
            0.0 => rounding,
            load => rounding.min(load),
        };
        self.generators.push([load_change, 0.0, 0.0]);
        self.generators.push([0.0, load_change, 0.0]);
    }

    /// Returns the imbalance τ of the body. A value up to [`NEGLIGIBLE_IMBALANCE`] is only an upper bound of τ. Call
    /// [`Self::add_common_generators`] first.
    fn imbalance(&self) -> f64 {
        let residual = self.residual();
        if residual == [0.0; 3] {
            return 0.0;
        }
        match zonotope_gauge_bound(&self.generators, residual) {
            Some(bound) if bound <= NEGLIGIBLE_IMBALANCE => bound,
            _ => zonotope_gauge(&self.generators, residual),
        }
    }
}

/// Returns the imbalance τ of each body, in the order of the bodies. τ is infinite if no relative changes of the
/// forces, however large, balance the body.
///
/// Values up to 10⁻¹⁰ are upper bounds of τ.
pub fn imbalances(assembly: &Assembly, forces: &Forces) -> Vec<f64> {
    let mut all = forces_by_body(assembly, forces);
    all.iter_mut().for_each(BodyForces::add_common_generators);
    all.iter().map(BodyForces::imbalance).collect()
}

/// Returns the largest imbalance τ of all bodies, and the largest ratio of a body's residual to its load. A value of τ
/// up to [`NEGLIGIBLE_IMBALANCE`] is only an upper bound.
///
/// Bodies are processed in the order of decreasing upper bounds of τ. τ is computed only for bodies whose bound
/// exceeds the largest τ found so far.
pub(super) fn worst_imbalance(assembly: &Assembly, forces: &Forces) -> (f64, f64) {
    let mut all = forces_by_body(assembly, forces);
    let mut share: f64 = 0.0;
    let mut bounds: Vec<(f64, usize)> = Vec::with_capacity(all.len());
    for (number, body) in all.iter_mut().enumerate() {
        let residual = body.residual();
        if residual == [0.0; 3] {
            continue;
        }
        let [x, y, moment] = residual;
        // The ratio of residual and load is only reported. It does not affect the verdict.
        if body.load > 0.0 {
            share = share.max(libm::hypot(x, y).max(moment.abs()) / body.load);
        }
        body.add_common_generators();
        let bound = quick_gauge_bound(&body.generators, residual).unwrap_or(f64::INFINITY);
        bounds.push((bound, number));
    }
    // Start with the body that has the largest bound. If a bound is not larger than the largest τ found so far, no
    // later body can have a larger τ.
    bounds.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    let mut imbalance: f64 = 0.0;
    for (bound, number) in bounds {
        if bound <= imbalance {
            break;
        }
        imbalance = imbalance.max(all[number].imbalance());
    }
    if imbalance > 0.0 {
        imbalance = imbalance.max(chain_error(assembly, forces, &all));
    }
    (imbalance, share)
}

/// A joint is weak if its normal force is at most this share of the greatest normal force. A chain begins at a weak joint.
const WEAK: f64 = 1e-4;
/// A joint is strong if its normal force is at least this share of the greatest normal force. A chain ends at a strong
/// joint.
const STRONG: f64 = 1e-3;
/// A chain has at least this many joints after the first.
const CHAIN: usize = 3;
/// From each joint of a chain to the next one, the normal force grows by a factor in this range.
const GROWTH: RangeInclusive<f64> = 1.2..=1e3;

/// Returns the largest residual of a body at the end of a chain, relative to the force that the chain passes to it; 0 if
/// there is no chain.
///
/// In a row of round stones, each joint passes on only a part of the force of the joint before, because friction takes
/// the rest. After a dozen stones, this part is small beside the weight of a stone. It is not small beside the force that
/// the chain passes on, and what is missing there would have to grow from joint to joint. Where solver noise is left, it
/// does not grow steadily to a real force.
fn chain_error(assembly: &Assembly, forces: &Forces, bodies: &[BodyForces]) -> f64 {
    let normal = |contact: usize| forces.contacts[contact].normal.iter().sum::<f64>();
    let strongest = (0..assembly.contacts.len()).map(normal).fold(0.0, f64::max);
    // The joints between two bodies that carry a force.
    let joint = |contact: usize| {
        let ends = [assembly.contacts[contact].on, assembly.contacts[contact].from?];
        Some((normal(contact), ends)).filter(|joint| joint.0 > 0.0)
    };
    let joints: Vec<(f64, [usize; 2])> = (0..assembly.contacts.len()).filter_map(joint).collect();
    let is_weak = |joint: &&(f64, [usize; 2])| joint.0 <= WEAK * strongest;
    if joints.iter().all(|joint| !is_weak(&joint)) {
        return 0.0;
    }
    let mut of_body: BTreeMap<usize, Vec<(f64, [usize; 2])>> = BTreeMap::new();
    for joint in &joints {
        joint.1.iter().for_each(|body| of_body.entry(*body).or_default().push(*joint));
    }
    let other = |ends: [usize; 2], body: usize| ends[usize::from(ends[0] == body)];
    let is_chain = |mut carried: f64, mut body: usize| {
        let mut length = 0;
        loop {
            if carried >= STRONG * strongest {
                return length >= CHAIN;
            }
            let grows = |next: &&(f64, [usize; 2])| GROWTH.contains(&(next.0 / carried));
            let Some((next, ends)) = of_body[&body].iter().filter(grows).max_by(|a, b| a.0.total_cmp(&b.0)) else {
                return false;
            };
            (carried, body, length) = (*next, other(*ends, body), length + 1);
        }
    };
    let mut worst: f64 = 0.0;
    for (carried, ends) in joints.iter().filter(is_weak) {
        for end in ends {
            let [x, y, _] = bodies[*end].residual();
            let error = libm::hypot(x, y) / carried;
            if error > worst && is_chain(*carried, other(*ends, *end)) {
                worst = error;
            }
        }
    }
    worst
}

/// Collects the forces on each body: its loads, and the forces at its contacts and grips.
fn forces_by_body(assembly: &Assembly, forces: &Forces) -> Vec<BodyForces> {
    let bodies = assembly.bodies.iter();
    let mut acting: Vec<BodyForces> =
        bodies.map(|body| BodyForces::on(body, assembly.pull, assembly.load_factor)).collect();
    for (contact, pressed) in assembly.contacts.iter().zip(&forces.contacts) {
        let [first, second] = pressed.normal;
        // Two normal forces act at their points. The friction force acts along the interface, so any point of the
        // interface can be its point of application.
        let pushes = [
            (contact.points[0], contact.normal * first),
            (contact.points[1], contact.normal * second),
            (contact.ends[0], contact.tangent() * pressed.friction),
        ];
        // The force acts on the first body, the opposite force on the second body. The ground needs no balance.
        let sides = [(Some(contact.on), 1.0), (contact.from, -1.0)];
        for (body, sign) in sides {
            let Some(number) = body else {
                continue;
            };
            let acting = &mut acting[number];
            for (at, push) in pushes.iter().filter(|(_, push)| *push != Vector::zeros()) {
                acting.force(*at, push * sign);
            }
            let arm = contact.ends[0] - acting.centroid;
            let along = contact.tangent();
            acting.cones.push(Cone {
                along: [along.x, along.y, cross(arm, along) / acting.radius],
                given: pressed.friction.abs(),
                available: contact.friction * (first + second),
            });
        }
    }
    for (grip, held) in assembly.grips.iter().zip(&forces.grips) {
        let acting = &mut acting[grip.body];
        // Add each component as a separate force, because τ limits the change of each component relative to its own
        // size.
        acting.force(grip.at, Vector::new(held.force.x, 0.0));
        acting.force(grip.at, Vector::new(0.0, held.force.y));
        acting.torque(held.torque);
    }
    acting
}
