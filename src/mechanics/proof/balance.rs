//! How well each body balances, by its own forces alone.
//!
//! A body balances to τ when each force on it, changed by at most τ of its own amount and moved by at most τ of the body's
//! own radius R, balances it exactly. Each force is a generator (F_x, F_y, M/R), R about the centroid: each corner's normal
//! force, each friction force, each component of a robot, the weight, the listed loads. Moving them all widens the moment
//! by Σ |F|. So τ is the smallest number for which what is left unbalanced lies in τ times their zonotope; it has no unit,
//! and neither the heaviest block nor the size of anything else enters it.
//!
//! Forces are products and sums of rounded numbers: what is left is summed with twice the digits, and a rounding of some
//! 10⁻¹⁵ of Σ |F| is granted across the given forces where the body has something to take it up: friction within its cone,
//! or τ of its load.

use super::Forces;
use crate::assembly::{Assembly, AssemblyBody};
use crate::geometry::{
    CompensatedSum, Point, Vec3, Vector, cross, quick_gauge_bound, zonotope_gauge,
    zonotope_gauge_bound,
};

/// Rounding of a few sums and products, in parts of what is summed.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The finest τ that is asked for: rounding is granted so that it suffices there.
const FINEST: f64 = 1e-9;

/// Below this an upper bound of τ is good enough, and quicker.
const PLENTY: f64 = 1e-10;

/// Friction that a contact could give beside what it gives.
struct Cone {
    /// A unit of it, as a generator.
    along: Vec3,
    given: f64,
    most: f64,
}

/// All that acts on one body.
struct Acting {
    centroid: Point,
    radius: f64,
    left: [CompensatedSum; 3],
    generators: Vec<Vec3>,
    cones: Vec<Cone>,
    /// Σ |F|.
    total: f64,
    /// Σ |F| of the loads alone.
    load: f64,
}

impl Acting {
    fn on(body: &AssemblyBody, pull: Vector, load_factor: f64) -> Acting {
        let mut acting = Acting {
            centroid: body.centroid,
            radius: body.radius(),
            left: [CompensatedSum::default(); 3],
            generators: Vec::with_capacity(16),
            cones: Vec::with_capacity(8),
            total: 0.0,
            load: 0.0,
        };
        acting.load(pull * body.weight, 0.0);
        let listed = body.listed.times(load_factor);
        acting.load(listed.force, listed.moment);
        acting
    }

    fn load(&mut self, force: Vector, moment: f64) {
        self.left[0].add(force.x);
        self.left[1].add(force.y);
        self.left[2].add(moment);
        self.generators
            .push([force.x, force.y, moment / self.radius]);
        self.total += force.norm();
        self.load += force.norm() + moment.abs() / self.radius;
    }

    fn force(&mut self, at: Point, force: Vector) {
        let arm = at - self.centroid;
        self.left[0].add(force.x);
        self.left[1].add(force.y);
        self.left[2].add_product(arm.x, force.y);
        self.left[2].add_product(-arm.y, force.x);
        self.generators
            .push([force.x, force.y, cross(arm, force) / self.radius]);
        self.total += force.norm();
    }

    fn torque(&mut self, torque: f64) {
        self.left[2].add(torque);
        self.generators.push([0.0, 0.0, torque / self.radius]);
    }

    /// What is left unbalanced, N.
    fn left(&self) -> Vec3 {
        let [x, y, moment] = self.left.map(CompensatedSum::value);
        [x, y, moment / self.radius]
    }

    /// Adds what every body may lean on beside its forces: that they may be moved, and rounding.
    fn complete(&mut self) {
        self.generators.push([0.0, 0.0, self.total]);
        let rounding = ROUNDING / FINEST * self.total;
        for cone in &self.cones {
            let spare = rounding.min(cone.most) - cone.given;
            if spare > 0.0 {
                self.generators.push(cone.along.map(|v| v * spare));
            }
        }
        // Where nothing loads a body, nothing drives it through a rounding either.
        let turned = match self.load {
            0.0 => rounding,
            load => rounding.min(load),
        };
        self.generators.push([turned, 0.0, 0.0]);
        self.generators.push([0.0, turned, 0.0]);
    }

    /// The smallest τ to which the body balances, once it is complete.
    fn imbalance(&self) -> f64 {
        let left = self.left();
        if left == [0.0; 3] {
            return 0.0;
        }
        match zonotope_gauge_bound(&self.generators, left) {
            Some(enough) if enough <= PLENTY => enough,
            _ => zonotope_gauge(&self.generators, left),
        }
    }
}

/// The smallest τ to which each body balances, in their order; infinite where no such change would do.
///
/// What is below 10⁻¹⁰ is an upper bound of it.
pub fn imbalances(assembly: &Assembly, forces: &Forces) -> Vec<f64> {
    let mut all = acting(assembly, forces);
    all.iter_mut().for_each(Acting::complete);
    all.iter().map(Acting::imbalance).collect()
}

/// The worst imbalance of all bodies, and the worst of what is left of one in parts of its own load.
///
/// Only bodies that may be the worst are looked at closely, those with the largest bound first.
pub(super) fn worst(assembly: &Assembly, forces: &Forces) -> (f64, f64) {
    let mut all = acting(assembly, forces);
    let mut share: f64 = 0.0;
    let mut bounds: Vec<(f64, usize)> = Vec::with_capacity(all.len());
    for (number, acting) in all.iter_mut().enumerate() {
        let left = acting.left();
        if left == [0.0; 3] {
            continue;
        }
        let [x, y, moment] = left;
        if acting.load > 0.0 {
            share = share.max(libm::hypot(x, y).max(moment.abs()) / acting.load);
        }
        acting.complete();
        let bound = quick_gauge_bound(&acting.generators, left).unwrap_or(f64::INFINITY);
        bounds.push((bound, number));
    }
    bounds.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    let mut imbalance: f64 = 0.0;
    for (bound, number) in bounds {
        if bound <= imbalance {
            break;
        }
        imbalance = imbalance.max(all[number].imbalance());
    }
    (imbalance, share)
}

fn acting(assembly: &Assembly, forces: &Forces) -> Vec<Acting> {
    let bodies = assembly.bodies.iter();
    let mut acting: Vec<Acting> = bodies
        .map(|body| Acting::on(body, assembly.pull, assembly.load_factor))
        .collect();
    for (contact, pressed) in assembly.contacts.iter().zip(&forces.contacts) {
        let [first, second] = pressed.normal;
        let pushes = [
            (contact.points[0], contact.normal * first),
            (contact.points[1], contact.normal * second),
            (contact.ends[0], contact.tangent() * pressed.friction),
        ];
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
                most: contact.friction * (first + second),
            });
        }
    }
    for (grip, held) in assembly.grips.iter().zip(&forces.grips) {
        let acting = &mut acting[grip.body];
        acting.force(grip.at, Vector::new(held.force.x, 0.0));
        acting.force(grip.at, Vector::new(0.0, held.force.y));
        acting.torque(held.torque);
    }
    acting
}
