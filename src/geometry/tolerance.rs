//! The only epsilons of the crate that speak of lengths.
//!
//! Off a lattice, coordinates carry noise: a file written from 32-bit floats is off by 6·10⁻⁸ of the coordinate, a
//! rounded one by more. A scene estimates that from how its coordinates are written. Two edges therefore *touch* when they
//! lie within [`Tolerance::gap`] of each other, and a common stretch shorter than [`Tolerance::shortest`] is a corner that
//! touches, not an interface. How short that is depends on the edges: a tip of a millionth of a block that stands on another
//! is all the support there is, and two bricks that overlap by as much are neighbours.

/// How close is close, in metres, for one scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Largest distance between two edges that still touch, and the deepest overlap that is still noise.
    pub gap: f64,
    /// A common stretch of long edges shorter than this is a touching corner.
    pub min_length: f64,
    /// A common stretch of any edges shorter than this is the rounding of coordinates.
    pub rounding: f64,
    /// Largest sine of the angle between two edges that still face each other, whatever their length.
    pub angle: f64,
}

impl Tolerance {
    /// Gap in parts of the scene's reach.
    pub const GAP_PER_EXTENT: f64 = 1e-6;
    /// Stretch in parts of the gap.
    pub const LENGTH_PER_GAP: f64 = 0.25;
    /// Stretch in parts of the shorter edge, where that is less.
    pub const LENGTH_PER_EDGE: f64 = 1e-3;
    /// The largest angle between two edges that face each other.
    pub const MAX_ANGLE: f64 = 0.01;
    /// The reach counts for at most so many typical block sizes, so that a far-flung scene keeps its small contacts.
    pub const MAX_EXTENT_IN_BLOCKS: f64 = 1000.0;

    /// The tolerance of a scene whose blocks reach `extent` metres across in all and are `typical` metres large each.
    ///
    /// Both are lengths in metres; a scene without blocks has extent 0 and gets the tolerance 0.
    pub fn new(extent: f64, typical: f64) -> Tolerance {
        Tolerance::from_gap(Self::GAP_PER_EXTENT * extent.min(Self::MAX_EXTENT_IN_BLOCKS * typical))
    }

    /// The tolerance by which edges within `gap` metres of each other touch.
    pub fn from_gap(gap: f64) -> Tolerance {
        Tolerance {
            gap,
            min_length: Self::LENGTH_PER_GAP * gap,
            rounding: Self::LENGTH_PER_GAP * gap,
            angle: Self::MAX_ANGLE,
        }
    }

    /// The same, where coordinates are off by no more than `rounding` metres.
    pub fn with_rounding(self, rounding: f64) -> Tolerance {
        Tolerance {
            rounding: (Self::LENGTH_PER_GAP * rounding).min(self.min_length),
            ..self
        }
    }

    /// The shortest common stretch that is an interface of two edges, metres, the shorter one `edge` long.
    pub fn min_contact_length(&self, edge: f64) -> f64 {
        self.min_length
            .min(Self::LENGTH_PER_EDGE * edge)
            .max(self.rounding)
    }

    /// Exact comparison, for lattices.
    pub const EXACT: Tolerance = Tolerance {
        gap: 0.0,
        min_length: 0.0,
        rounding: 0.0,
        angle: 0.0,
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, wanted: f64) -> bool {
        (found - wanted).abs() <= 1e-12 * wanted
    }

    #[test]
    fn edges_touch_within_a_millionth_of_the_reach() {
        // A house of 20 m from bricks of half a metre; and two of them a thousand kilometres apart.
        assert!(close(Tolerance::new(20.0, 0.5).gap, 20e-6));
        assert!(close(Tolerance::new(1e6, 0.5).gap, 500e-6));
        assert_eq!(Tolerance::new(0.0, 0.0).gap, 0.0);
    }

    #[test]
    fn the_shortest_stretch_is_a_quarter_of_the_gap_or_a_thousandth_of_the_edge() {
        let written = Tolerance::from_gap(0.004);
        assert!(close(written.min_length, 0.001) && close(written.rounding, 0.001));
        // As long as nothing is known of the coordinates, they may be off by as much as counts as touching.
        assert!(close(written.min_contact_length(0.1), 0.001));
        let known = written.with_rounding(2e-5);
        assert_eq!((known.gap, known.angle), (written.gap, written.angle));
        assert!(close(known.min_contact_length(3.0), 0.001), "a long edge");
        assert!(close(known.min_contact_length(0.1), 1e-4), "a short one");
        assert!(
            close(known.min_contact_length(1e-3), 5e-6),
            "the rounding of coordinates"
        );
        // Rounding never asks for more than the gap does.
        assert!(close(
            written.with_rounding(1.0).min_contact_length(3.0),
            0.001
        ));
        assert_eq!(Tolerance::EXACT.min_contact_length(1.0), 0.0);
    }
}
