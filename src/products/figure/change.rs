//! [`ForceChange`]: compares the force of one interface in two frames, and decides whether it changed. Figures and
//! reports use this comparison.

use std::collections::BTreeMap;

use crate::geometry::Vector;
use crate::mechanics::analysis::Contact;
use crate::mechanics::scene::{BodyId, Scene};
use crate::products::wording::number::counted;

/// A force has changed if the difference exceeds this fraction of the larger of the two forces. If the forces of a
/// frame are not unique, smaller differences can come from the solver.
const CHANGE_TOL: f64 = 0.05;
/// Two interfaces are at the same place if the distance of their middles is at most this fraction of their length.
const SAME_PLACE_TOL: f64 = 1e-6;
/// Forces up to this fraction of the largest force count as rounding errors of the solver.
const NOISE_SHARE: f64 = 1e-6;

/// The force of an interface that two frames have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ForceChange<'a> {
    /// The interface in the earlier and in the later frame.
    pub contacts: [&'a Contact; 2],
    /// The force on the same body in the earlier and in the later frame, N.
    pub forces: [Vector; 2],
}

impl ForceChange<'_> {
    /// Returns the magnitudes of the earlier and the later force, N.
    pub(crate) fn amounts(&self) -> [f64; 2] {
        self.forces.map(|force| force.norm())
    }

    /// Returns the larger of the two magnitudes, N.
    pub(crate) fn larger(&self) -> f64 {
        let [before, after] = self.amounts();
        before.max(after)
    }

    /// Returns the magnitude of the difference between the earlier and the later force, N.
    pub(crate) fn difference(&self) -> f64 {
        (self.forces[1] - self.forces[0]).norm()
    }

    /// True if the force changed by more than 5 % of the larger magnitude. Forces of at most `noise` newtons count as
    /// zero; see [`noise`].
    pub(crate) fn is_change(&self, noise: f64) -> bool {
        let larger = self.larger();
        larger > noise && self.difference() > CHANGE_TOL * larger
    }
}

/// Pairs the interfaces of two frames by the names of their bodies. Of several interfaces between two bodies, those at
/// the same place belong together; the others are paired by their order. Interfaces of only one frame are left out. The
/// argument has the scene and the contacts of the earlier frame, then those of the later frame.
pub(crate) fn shared_forces<'a>([then, now]: [(&Scene, &'a [Contact]); 2]) -> Vec<ForceChange<'a>> {
    let mut before: BTreeMap<[String; 2], Vec<&'a Contact>> = BTreeMap::new();
    for contact in then.1 {
        let names = bodies(then.0, contact).map(|body| then.0.name(body).to_owned());
        before.entry(names).or_default().push(contact);
    }
    let pair = |contact: &'a Contact| {
        let names = bodies(now.0, contact).map(|body| now.0.name(body).to_owned());
        let rest = before.get_mut(&names).filter(|rest| !rest.is_empty())?;
        let same = rest.iter().position(|other| is_same_place(other, contact));
        let contacts = [rest.remove(same.unwrap_or(0)), contact];
        Some(ForceChange { contacts, forces: [force(then.0, contacts[0]), force(now.0, contact)] })
    };
    now.1.iter().filter_map(pair).collect()
}

/// Returns the two bodies of a contact, sorted by their names, so that the order is the same in all frames.
pub(crate) fn bodies(scene: &Scene, contact: &Contact) -> [BodyId; 2] {
    let [a, b] = contact.interface.bodies;
    if scene.name(a) <= scene.name(b) { [a, b] } else { [b, a] }
}

/// Returns the force of a contact on the first body of [`bodies`], N.
fn force(scene: &Scene, contact: &Contact) -> Vector {
    contact.force_on(bodies(scene, contact)[0])
}

fn is_same_place(a: &Contact, b: &Contact) -> bool {
    let (a, b) = (&a.interface, &b.interface);
    (a.middle() - b.middle()).norm() <= SAME_PLACE_TOL * a.length()
}

/// Says in words how many of the forces that are common to two frames have changed.
pub(crate) fn count_in_words(changed: usize, shared: usize) -> String {
    let all = counted(shared, "shared force");
    match (changed, shared) {
        (_, 0) => "the two steps have no interface in common".to_owned(),
        (0, 1) => "the only shared force changed by at most 5 %".to_owned(),
        (0, _) => format!("none of {all} changed by over 5 %"),
        (n, _) => format!("{n} of {all} changed by over 5 %"),
    }
}

/// Returns the largest magnitude that counts as a rounding error, N: a small fraction of the largest of `amounts`,
/// which are also in N.
pub(crate) fn noise(amounts: impl Iterator<Item = f64>) -> f64 {
    NOISE_SHARE * amounts.fold(0.0, f64::max)
}
