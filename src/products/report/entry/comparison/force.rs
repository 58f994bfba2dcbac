//! [`SharedForces`]: the forces at the interfaces that two frames have in common.

use std::collections::BTreeMap;

use super::Side;
use super::number::change;
use crate::analysis::Contact;
use crate::figure::{ForceChange, noise};
use crate::report::entry::Grid;
use crate::scene::Scene;
use crate::scene::format::UnitsEntry;
use crate::text::line;
use crate::wording::failure::pair;
use crate::wording::number::{digits, percent};

/// The forces at the interfaces that both frames have.
pub(super) struct SharedForces<'a> {
    /// One entry for each common interface, changed or not.
    pub all: Vec<ForceChange<'a>>,
    /// Forces of at most this magnitude, N, count as zero.
    noise: f64,
}

impl<'a> SharedForces<'a> {
    /// Pairs the interfaces of both frames by the names of their bodies. Several interfaces between two bodies are
    /// paired by their order.
    pub fn new(sides: [Side<'a>; 2], number: usize) -> SharedForces<'a> {
        let key = |scene: &Scene, contact: &Contact| {
            contact.interface.bodies.map(|b| scene.name(b).to_owned())
        };
        let [was, is] = sides.map(|side| {
            let analysis = side.analysis;
            (&analysis.scene, &analysis.frames[number].contacts)
        });
        let mut before: BTreeMap<[String; 2], Vec<&'a Contact>> = BTreeMap::new();
        for contact in was.1 {
            before.entry(key(was.0, contact)).or_default().push(contact);
        }
        let mut taken: BTreeMap<[String; 2], usize> = BTreeMap::new();
        let mut all = Vec::new();
        for contact in is.1 {
            let key = key(is.0, contact);
            let turn = taken.entry(key.clone()).or_default();
            let Some(then) = before.get(&key).and_then(|list| list.get(*turn)) else {
                continue;
            };
            *turn += 1;
            let contacts = [*then, contact];
            all.push(ForceChange {
                contacts,
                forces: contacts.map(|c| c.resultant.force),
            });
        }
        let forces = was.1.iter().chain(is.1);
        SharedForces {
            all,
            noise: noise(forces.map(|c| c.resultant.force.norm())),
        }
    }

    /// Iterates over the forces that changed by more than 5 % of the larger force. Forces at the level of rounding
    /// errors are left out.
    pub fn changed(&self) -> impl Iterator<Item = &ForceChange<'a>> {
        self.all.iter().filter(|force| force.is_change(self.noise))
    }

    /// Makes the table of the forces that changed, in the given units. `scene` is the second scene.
    pub fn grid(&self, scene: &Scene, units: UnitsEntry) -> Grid {
        let unit = units.force();
        let heads = ["first", "second"].map(|which| format!("#{which}, {}", unit.symbol()));
        let mut grid = Grid::new(
            "Forces that changed by over 5 %",
            &[
                "between",
                &heads[0],
                &heads[1],
                "#change of the magnitude",
                "#change as a vector, relative to the larger force",
            ],
        );
        for force in self.changed() {
            let [a, b] = force.amounts();
            let cells = [
                line(&pair(scene, force.contacts[1].interface.bodies)),
                digits(unit.value_from_si(a)),
                digits(unit.value_from_si(b)),
                change(a, b),
                percent(force.difference() / force.larger()),
            ];
            grid.add("", cells);
        }
        grid
    }
}
