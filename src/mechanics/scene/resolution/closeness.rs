//! [`Closeness`]: how close two edges have to be to touch, and what healing moved.

use super::Resolution;
use crate::geometry::{Bounds, Polygon, Tolerance};
use crate::scene::finding::Findings;
use crate::scene::heal::{self, Healed, HealingReach, ToleranceSource};
use crate::scene::number::at_least_zero;
use crate::scene::path::Trail;
use crate::scene::rounding::{self, Rounding};
use crate::scene::{Block, Ground};

/// How far a corner may lie off the edge that it touches, metres: the two ends of the edge and the corner are each off by the
/// error of a coordinate.
fn misfit(rounding: &Rounding) -> f64 {
    3.0 * rounding.error
}

/// How close is close in a scene.
pub(super) struct Closeness {
    /// Whether every body is a set of lattice cells.
    pub(super) exact: bool,
    /// How far corners may be moved, and why.
    reach: HealingReach,
    /// What was moved.
    pub(super) healed: Healed,
    /// How far a corner may lie off the edge that it touches because coordinates are rounded, metres.
    pub(super) misfit: f64,
}

impl Closeness {
    /// The contact tolerance of the whole scene.
    pub(super) fn tolerance(&self) -> Tolerance {
        if self.exact {
            Tolerance::EXACT
        } else {
            Tolerance::from_gap(self.reach.gap())
        }
    }

    /// Whether the file or the caller gives the tolerance.
    pub(super) fn is_given(&self) -> bool {
        self.reach.source == ToleranceSource::Given
    }
}

impl Resolution<'_> {
    /// Finds how close is close, and heals the bodies within it. Bodies on a lattice stay as they are.
    pub(super) fn heal(
        &self,
        findings: &mut Findings,
        ground: &mut [Option<Ground>],
        blocks: &mut [Option<Block>],
    ) -> Closeness {
        let mut bodies = (ground.iter().flatten().map(|g| &g.body))
            .chain(blocks.iter().flatten().map(|b| &b.body));
        let exact = self.lattice.is_some() && bodies.all(|body| body.cells.is_some());
        let given = self.file.contact_tolerance;
        let given = at_least_zero(findings, &Trail::Top, "contact_tolerance", given);
        // A lattice and a given tolerance need not be guessed from the digits.
        let rounding = match exact || given.is_some() {
            true => None,
            false => rounding::of(self.file),
        };
        let (reach, healed) = if exact {
            let healed = Healed {
                source: ToleranceSource::Lattice,
                ..Healed::default()
            };
            (HealingReach::EXACT, healed)
        } else {
            let reach = reach(given, rounding, blocks);
            (reach, heal::heal(ground, blocks, reach))
        };
        Closeness {
            exact,
            reach,
            healed,
            misfit: rounding.map_or(0.0, |r| misfit(&r)),
        }
    }
}

/// How close is close: as given, else from how the coordinates are written and how large the scene is.
fn reach(given: Option<f64>, rounding: Option<Rounding>, blocks: &[Option<Block>]) -> HealingReach {
    if let Some(gap) = given {
        return HealingReach {
            source: ToleranceSource::Given,
            usual: 0.0,
            healing: gap,
        };
    }
    let polygons = || blocks.iter().flatten().map(|b| &b.body.polygon);
    let median = |mut sizes: Vec<f64>| {
        sizes.sort_by(f64::total_cmp);
        sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
    };
    let around = polygons().map(Polygon::bounds).reduce(Bounds::union);
    let typical = median(polygons().map(|p| p.bounds().diagonal()).collect());
    let usual = Tolerance::new(around.map_or(0.0, Bounds::diagonal), typical).gap;
    let small = median(polygons().map(heal::size).collect());
    match rounding.filter(|r| misfit(r) <= heal::FINE * small) {
        Some(rounding) => HealingReach {
            source: rounding.source,
            usual,
            healing: misfit(&rounding),
        },
        None => HealingReach {
            source: ToleranceSource::Size,
            usual,
            healing: 0.0,
        },
    }
}
