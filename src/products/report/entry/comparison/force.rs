//! [`SharedForces`]: the forces at the interfaces that two frames have in common.

use super::Side;
use super::number::change;
use crate::mechanics::scene::Scene;
use crate::mechanics::scene::format::UnitsEntry;
use crate::products::figure::{ForceChange, noise, shared_forces};
use crate::products::report::entry::Grid;
use crate::products::wording::failure::pair;
use crate::products::wording::number::{digits, percent};
use crate::text::line;

/// The forces at the interfaces that both frames have.
pub(super) struct SharedForces<'a> {
    /// One entry for each common interface, changed or not.
    pub all: Vec<ForceChange<'a>>,
    /// Forces of at most this magnitude, N, count as zero.
    noise: f64,
}

impl<'a> SharedForces<'a> {
    /// Pairs the interfaces of frame `number` (from 0) of the first analysis with those of the same frame of the second;
    /// see [`shared_forces`].
    pub fn new(sides: [Side<'a>; 2], number: usize) -> SharedForces<'a> {
        let [was, is] = sides.map(|side| {
            let analysis = side.analysis;
            (&*analysis.scene, &analysis.frames[number].contacts[..])
        });
        let all = shared_forces([was, is]);
        let forces = was.1.iter().chain(is.1);
        SharedForces { all, noise: noise(forces.map(|c| c.resultant.force.norm())) }
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
                "#magnitude of the vector change, relative to the larger force",
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
