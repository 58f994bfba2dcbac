//! [`Tolerance`]: the distances and the angle up to which two edges count as touching.
//!
//! Scenes on a lattice need no tolerance. In other scenes, coordinates are rounded: a file written from 32-bit floats
//! is off by 6·10⁻⁸ of each coordinate, a file with few decimals by more. The scene estimates this error from the
//! decimals of its coordinates. Two edges *touch* when their distance is at most [`Tolerance::gap`]. They form an
//! interface when they overlap by more than [`Tolerance::min_contact_length`], and otherwise only a touching corner.
//! This minimum length depends on the length of the edges. A tip as short as a millionth of a block may be the only
//! support of a stone, but two long bricks that overlap by this length merely touch.

/// The lengths, in metres, and the angle up to which differences between two bodies of a scene count as rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// The largest distance between two edges that touch, and the largest depth of an overlap that is ignored.
    pub gap: f64,
    /// Long edges that overlap by less than this length form a touching corner, not an interface.
    pub min_length: f64,
    /// Overlaps shorter than this are attributed to the rounding of coordinates, whatever the length of the edges.
    pub rounding: f64,
    /// The sine of the largest angle between two edges that can form an interface, whatever their length.
    pub angle: f64,
}

impl Tolerance {
    /// The gap as a fraction of the scene's extent.
    ///
    /// The gap is 20 µm for a building of 20 m. If it were ten times larger, joints of 0.2 mm would count as closed,
    /// although they may be open on purpose. If it were ten times smaller, it would be below the rounding of 32-bit
    /// floats at two edges (6·10⁻⁸ of each coordinate), and contacts would be missed.
    pub const GAP_PER_EXTENT: f64 = 1e-6;
    /// The shortest interface of long edges, as a fraction of the gap.
    pub const LENGTH_PER_GAP: f64 = 0.25;
    /// The shortest interface as a fraction of the shorter edge. This limit applies if it is less than `min_length`.
    pub const LENGTH_PER_EDGE: f64 = 1e-3;
    /// The largest angle between two edges that can form an interface, in radians.
    ///
    /// If it were ten times smaller, short joints with rounded ends would be missed. If it were ten times larger, open
    /// wedges would become interfaces.
    pub const MAX_ANGLE: f64 = 0.01;
    /// The extent is limited to this many typical block sizes, so that scattered blocks keep their small contacts.
    pub const MAX_EXTENT_IN_BLOCKS: f64 = 1000.0;

    /// Returns the tolerance of a scene with an extent of `extent` metres and a typical block size of `typical` metres.
    ///
    /// The extent counts as at most 1000 times `typical`. A scene without blocks has extent 0, so its gap is 0.
    pub fn new(extent: f64, typical: f64) -> Tolerance {
        let extent = extent.min(Self::MAX_EXTENT_IN_BLOCKS * typical);
        Tolerance::from_gap(Self::GAP_PER_EXTENT * extent)
    }

    /// Returns the tolerance for which two edges touch if their distance is at most `gap` metres.
    pub fn from_gap(gap: f64) -> Tolerance {
        Tolerance {
            gap,
            min_length: Self::LENGTH_PER_GAP * gap,
            rounding: Self::LENGTH_PER_GAP * gap,
            angle: Self::MAX_ANGLE,
        }
    }

    /// Returns this tolerance, adapted to coordinates with errors of up to `rounding` metres. Only the shortest contact
    /// length changes.
    pub fn with_rounding(self, rounding: f64) -> Tolerance {
        Tolerance { rounding: (Self::LENGTH_PER_GAP * rounding).min(self.min_length), ..self }
    }

    /// Returns the length, in metres, by which two edges must overlap to form an interface. `edge` is the length of the
    /// shorter edge, in metres.
    pub fn min_contact_length(&self, edge: f64) -> f64 {
        self.min_length.min(Self::LENGTH_PER_EDGE * edge).max(self.rounding)
    }

    /// Exact comparison, for scenes on a lattice.
    pub const EXACT: Tolerance = Tolerance { gap: 0.0, min_length: 0.0, rounding: 0.0, angle: 0.0 };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, wanted: f64) -> bool {
        (found - wanted).abs() <= 1e-12 * wanted
    }

    #[test]
    fn the_gap_is_a_millionth_of_the_extent_or_a_thousandth_of_the_block() {
        // A house of 20 m made of bricks of half a metre, and two such bricks a thousand kilometres apart.
        assert!(close(Tolerance::new(20.0, 0.5).gap, 20e-6));
        assert!(close(Tolerance::new(1e6, 0.5).gap, 500e-6));
        assert_eq!(Tolerance::new(0.0, 0.0).gap, 0.0);
    }

    #[test]
    fn the_shortest_interface_is_a_quarter_of_the_gap_or_a_thousandth_of_the_edge() {
        let written = Tolerance::from_gap(0.004);
        assert!(close(written.min_length, 0.001) && close(written.rounding, 0.001));
        // While the rounding of the coordinates is unknown, the limit from the gap applies.
        assert!(close(written.min_contact_length(0.1), 0.001));
        let known = written.with_rounding(2e-5);
        assert_eq!((known.gap, known.angle), (written.gap, written.angle));
        assert!(close(known.min_contact_length(3.0), 0.001), "a long edge");
        assert!(close(known.min_contact_length(0.1), 1e-4), "a short edge");
        assert!(close(known.min_contact_length(1e-3), 5e-6), "the rounding of coordinates");
        // A large rounding error does not raise the minimum above a quarter of the gap.
        assert!(close(written.with_rounding(1.0).min_contact_length(3.0), 0.001));
        assert_eq!(Tolerance::EXACT.min_contact_length(1.0), 0.0);
    }
}
