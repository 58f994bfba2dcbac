//! [`ProofCache`]: forces and motions of similar components. They may prove a verdict, so that no linear program must
//! be solved.
//!
//! A margin needs the verdicts of many components that differ in one number. Forces that balance one component often
//! balance the next one, and a motion by which one component falls often proves that another one falls. Forces and
//! motions are proved again for each new component.

use super::Component;
use crate::geometry::Point;
use crate::mechanics::proof::{self, ContactForces, Forces, Motion};
use crate::mechanics::statics::assembly::Assembly;

/// The largest number of sets of forces in the cache, and the largest number of motions. A search alternates between
/// few values, and each entry that is tried costs the check of a proof.
const MAX_CACHED: usize = 4;

/// Forces and motions of similar components, the latest last.
#[derive(Debug, Default)]
pub(in crate::mechanics::analysis) struct ProofCache {
    forces: Vec<CachedForces>,
    motions: Vec<Vec<Motion>>,
}

/// Forces with the application points at which they act.
#[derive(Debug)]
struct CachedForces {
    forces: Forces,
    points: Vec<[Point; 2]>,
}

impl ProofCache {
    /// Stores forces that balance an assembly, and the points at which they act. The oldest forces are removed if the
    /// cache is full.
    pub fn add_forces(&mut self, assembly: &Assembly, forces: Forces) {
        if self.forces.len() == MAX_CACHED {
            self.forces.remove(0);
        }
        let points = assembly.contacts.iter().map(|contact| contact.points);
        self.forces.push(CachedForces { forces, points: points.collect() });
    }

    /// Stores a motion, which has one entry for each body. The oldest motion is removed if the cache is full.
    pub fn add_motion(&mut self, motion: Vec<Motion>) {
        if self.motions.len() == MAX_CACHED {
            self.motions.remove(0);
        }
        self.motions.push(motion);
    }

    /// Returns the error of the most accurate forces in the cache that balance a component, as
    /// [`proof::Proof::force_error`] defines it. `None` if no forces in the cache balance it.
    pub(super) fn least_error(&self, component: &Component) -> Option<f64> {
        let errors = self.forces.iter().filter_map(|cached| {
            let forces = cached.transfer_to(component.assembly)?;
            let proof = proof::check_forces(component.assembly, &forces);
            proof.force_error().filter(|_| component.accepts(&proof))
        });
        errors.min_by(f64::total_cmp)
    }

    /// True if some forces in the cache balance a component.
    pub(super) fn balances(&self, component: &Component) -> bool {
        // Try the latest forces first: they belong to the previous value of a search, which is usually the nearest
        // value.
        let mut latest_first = self.forces.iter().rev();
        latest_first.any(|cached| {
            let forces = cached.transfer_to(component.assembly);
            forces.is_some_and(|forces| component.accepts(&proof::check_forces(component.assembly, &forces)))
        })
    }

    /// Returns a motion from the cache that proves that a component falls. `None` if no motion in the cache proves
    /// this.
    pub(super) fn falls(&self, component: &Component) -> Option<Vec<Motion>> {
        let mut latest_first = self.motions.iter().rev();
        let proves = |motion: &&Vec<Motion>| {
            let proof = component.check_mechanism(motion);
            component.accepts_motion(motion, &proof) && component.exceeds_force_tolerance(motion, &proof)
        };
        latest_first.find(proves).cloned()
    }
}

impl CachedForces {
    /// Returns the cached forces, changed to act at the application points of `assembly`. The resultant at each contact
    /// stays the same. `None` if the resultant at some contact does not pass between these points.
    fn transfer_to(&self, assembly: &Assembly) -> Option<Forces> {
        let mut forces = self.forces.clone();
        let contacts = assembly.contacts.iter().zip(&self.points);
        for (contact_forces, (contact, points)) in forces.contacts.iter_mut().zip(contacts) {
            if contact.points != *points {
                contact_forces.normal = transfer_normal_forces(contact_forces, points, &contact.points)?;
            }
        }
        Some(forces)
    }
}

/// Returns the two normal forces at the points `to` that have the same resultant as those at the points `from`. `None`
/// if one of them would be tension.
fn transfer_normal_forces(contact_forces: &ContactForces, from: &[Point; 2], to: &[Point; 2]) -> Option<[f64; 2]> {
    let [first, second] = contact_forces.normal;
    let sum = first + second;
    let along = to[1] - to[0];
    let square = along.norm_squared();
    if sum == 0.0 {
        return Some([0.0; 2]);
    }
    let middle = nalgebra::center(&to[0], &to[1]);
    let moment = (from[0] - middle) * first + (from[1] - middle) * second;
    if square == 0.0 {
        // The two points `to` coincide, so the resultant must pass through them.
        let offset = moment.norm() / sum;
        let size = (from[1] - from[0]).norm();
        return (offset <= f64::EPSILON * size).then_some([0.5 * sum; 2]);
    }
    // The sum of the two forces stays the same. Their moment about the middle also stays the same, and determines their
    // difference.
    let difference = 2.0 * moment.dot(&along) / square;
    let normal = [0.5 * (sum - difference), 0.5 * (sum + difference)];
    // A force that is negative only by rounding becomes 0.
    let min_normal = -4.0 * f64::EPSILON * sum;
    (normal[0] >= min_normal && normal[1] >= min_normal).then(|| normal.map(|n| n.max(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The resultant of 2 N at 0 m and 6 N at 4 m lies at 3 m.
    #[test]
    fn normal_forces_move_to_other_points_with_the_same_resultant() {
        let contact_forces = ContactForces { normal: [2.0, 6.0], friction: 1.0 };
        let stretch = |from: f64, to: f64| [Point::new(from, 1.0), Point::new(to, 1.0)];
        let given = stretch(0.0, 4.0);
        let found = transfer_normal_forces(&contact_forces, &given, &stretch(0.5, 3.5)).expect("between the points");
        assert!((found[0] - 4.0 / 3.0).abs() < 1e-14 && (found[1] - 20.0 / 3.0).abs() < 1e-14);
        assert_eq!(transfer_normal_forces(&contact_forces, &given, &stretch(1.0, 3.0)), Some([0.0, 8.0]));
        assert_eq!(transfer_normal_forces(&contact_forces, &given, &stretch(1.5, 2.5)), None);
        assert_eq!(transfer_normal_forces(&contact_forces, &given, &stretch(2.0, 2.0)), None);
        let middle = ContactForces { normal: [4.0, 4.0], ..contact_forces };
        assert_eq!(transfer_normal_forces(&middle, &given, &stretch(2.0, 2.0)), Some([4.0, 4.0]));
    }
}
