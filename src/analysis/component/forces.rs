//! Forces of a component in newtons, made admissible to the last bit, with their proof.

use super::Case;
use crate::geometry::Vector;
use crate::proof::{self, Forces, Held, Pressed, Proof};
use crate::solve::Amounts;

/// Forces in newtons with their proof.
pub(super) struct Carried {
    pub forces: Forces,
    pub proof: Proof,
}

impl Case<'_> {
    /// Newtons from pure numbers, made admissible to the last bit, with their proof.
    ///
    /// Noise below 1e-13 of the heaviest load (of friction: 1e-10 of N or μN, and never more than a tenth of the band)
    /// becomes 0 and friction is cut to μN, so that what is left of the solver's error shows as imbalance alone, where
    /// the proof measures it.
    pub fn carried(&self, amounts: &Amounts) -> Carried {
        let unit = self.scale.force;
        let heaviest = match self.assembly.heaviest() {
            0.0 => 1.0,
            heaviest => heaviest,
        };
        let noise = 1e-13 * heaviest;
        let clean = |v: f64| if v.abs() <= noise { 0.0 } else { v };
        let contacts = self
            .assembly
            .contacts
            .iter()
            .enumerate()
            .map(|(k, contact)| {
                let normal = amounts.normal[k].map(|v| clean(v * unit).max(0.0));
                let most = contact.friction * (normal[0] + normal[1]);
                let friction = (amounts.friction[k] * unit).clamp(-most, most);
                let still =
                    (1e-10 * most.min(normal[0] + normal[1])).min(0.1 * Proof::BAND * heaviest);
                Pressed {
                    normal,
                    friction: if friction.abs() <= still {
                        0.0
                    } else {
                        friction
                    },
                }
            });
        let grips = self.assembly.grips.iter().zip(&amounts.grip);
        let grips = grips.map(|(grip, [x, y, m])| {
            let length = self.scale.length;
            let cut = |v: f64, limit: f64| clean(v).clamp(-limit, limit);
            Held {
                force: Vector::new(cut(x * unit, grip.limits.fx), cut(y * unit, grip.limits.fy)),
                torque: cut(m * unit, grip.limits.torque / length) * length,
            }
        });
        let forces = Forces {
            contacts: contacts.collect(),
            grips: grips.collect(),
        };
        let proof = proof::forces(self.assembly, &forces);
        Carried { forces, proof }
    }
}
