//! [`Closeness`]: the contact tolerance of a scene, and the result of healing, which moves corners so that bodies that
//! nearly touch do touch.

use super::Resolution;
use crate::geometry::{Bounds, Polygon, Tolerance};
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::heal::{self, Healed, HealingReach, ToleranceSource};
use crate::mechanics::scene::number::at_least_zero;
use crate::mechanics::scene::rounding::{self, Rounding};
use crate::mechanics::scene::{Block, Ground};
use crate::read::Trail;

/// Returns the largest distance by which rounding can move a corner off the edge that it touches, in the units of the
/// file. The corner and both ends of the edge can each have the error of a coordinate.
fn misfit(rounding: &Rounding) -> f64 {
    3.0 * rounding.error
}

/// The contact tolerance of a scene, and the result of healing.
pub(super) struct Closeness {
    /// Whether every body is a set of lattice cells.
    pub(super) exact: bool,
    /// The tolerance of healing, and where it comes from.
    reach: HealingReach,
    /// The result of healing: how many bodies and corners moved, and how far.
    pub(super) healed: Healed,
    /// The largest distance by which rounding can move a corner off the edge that it touches, in the units of the file;
    /// 0 if no rounding was found, or if the tolerance is given.
    pub(super) misfit: f64,
}

impl Closeness {
    /// Returns the contact tolerance of the whole scene, in the units of the file.
    pub(super) fn tolerance(&self) -> Tolerance {
        if self.exact { Tolerance::EXACT } else { Tolerance::from_gap(self.reach.gap()) }
    }

    /// True if the file or the caller gives the contact tolerance, so that it is not estimated.
    pub(super) fn is_given(&self) -> bool {
        self.reach.source == ToleranceSource::Given
    }
}

impl Resolution<'_> {
    /// Determines the contact tolerance, and heals the bodies with this tolerance. Bodies are not changed if all of
    /// them consist of lattice cells, if the file lists the contacts, or if a block has no outline.
    pub(super) fn heal(
        &self,
        findings: &mut Findings,
        ground: &mut [Option<Ground>],
        blocks: &mut [Option<Block>],
    ) -> Closeness {
        let mut bodies = (ground.iter().flatten().map(|g| &g.body)).chain(blocks.iter().flatten().map(|b| &b.body));
        let exact = self.lattice.is_some() && bodies.all(|body| body.cells.is_some());
        let given = self.file.contact_tolerance;
        let given = at_least_zero(findings, &Trail::Top, "contact_tolerance", given);
        // Estimate the rounding of the coordinates, unless the contacts are exact or the tolerance is given.
        let rounding = if exact || given.is_some() { None } else { rounding::estimate_rounding(self.file) };
        let (reach, healed) = if exact {
            let healed = Healed { source: ToleranceSource::Lattice, ..Healed::default() };
            (HealingReach::EXACT, healed)
        } else {
            let reach = reach(given, rounding, blocks);
            if self.has_schematic_bodies() {
                (reach, Healed::default())
            } else {
                (reach, heal::heal(ground, blocks, reach))
            }
        };
        Closeness { exact, reach, healed, misfit: rounding.map_or(0.0, |r| misfit(&r)) }
    }
}

/// Returns the tolerance of healing: the given tolerance, or else an estimate from the digits of the coordinates and
/// the scene's extent. All lengths are in the units of the file.
fn reach(given: Option<f64>, rounding: Option<Rounding>, blocks: &[Option<Block>]) -> HealingReach {
    if let Some(gap) = given {
        return HealingReach { source: ToleranceSource::Given, default_gap: 0.0, healing: gap };
    }
    let polygons = || blocks.iter().flatten().map(|b| &b.body.polygon);
    let median = |mut sizes: Vec<f64>| {
        sizes.sort_by(f64::total_cmp);
        sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
    };
    let around = polygons().map(Polygon::bounds).reduce(Bounds::union);
    let typical = median(polygons().map(|p| p.bounds().diagonal()).collect());
    let default_gap = Tolerance::new(around.map_or(0.0, Bounds::diagonal), typical).gap;
    let small = median(polygons().map(heal::size).collect());
    match rounding.filter(|r| misfit(r) <= heal::MAX_ROUNDING_PER_SIZE * small) {
        Some(rounding) => HealingReach { source: rounding.source, default_gap, healing: misfit(&rounding) },
        None => HealingReach { source: ToleranceSource::Size, default_gap, healing: 0.0 },
    }
}
