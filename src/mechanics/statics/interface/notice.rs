//! [`Notices`]: collects edges that nearly form interfaces. Reports them in at most two sentences for the whole scene:
//! one about contacts that are too short, one about gaps that are too wide.

use crate::geometry::Tolerance;
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{BodyId, Scene};

/// Collects the segments that are too short and the edges that are too far apart for an interface.
#[derive(Default)]
pub(super) struct Notices {
    /// Number of segments that are too short.
    short_count: usize,
    /// The length of the longest of these segments, metres.
    longest_short: f64,
    /// The largest [`Tolerance::min_length`] of the pairs of bodies with such a segment, metres.
    required_length: f64,
    /// Pairs of bodies that nearly touch: a text with both names, and the distance of their edges in metres.
    unjoined: Vec<(String, f64)>,
}

impl Notices {
    /// Records a segment of `length` metres, which is too short for an interface.
    pub(super) fn add_short(&mut self, length: f64, tolerance: Tolerance) {
        self.short_count += 1;
        self.longest_short = self.longest_short.max(length);
        self.required_length = self.required_length.max(tolerance.min_length);
    }

    /// Records two bodies with edges that are `distance` metres apart, which is more than the tolerance.
    pub(super) fn add_near_contact(&mut self, scene: &Scene, bodies: [BodyId; 2], distance: f64) {
        let names = bodies.map(|body| scene.name(body));
        self.unjoined.push((format!("{} and {}", names[0], names[1]), distance));
    }

    /// Returns the notices as sentences for users, with lengths in the unit of the scene. There is at most one
    /// sentence about contacts that are too short, and at most one about gaps that are too wide.
    pub(super) fn into_sentences(self, tolerance: Tolerance, units: UnitsEntry) -> Vec<String> {
        let mut sentences = Vec::new();
        if self.short_count > 0 {
            sentences.push(format!(
                "{} contact(s) up to {} long are shorter than {} and count as touching corners, which carry no force",
                self.short_count,
                units.small_length(self.longest_short, 1),
                units.small_length(self.required_length, 1)
            ));
        }
        if let Some((names, distance)) = self.unjoined.first() {
            let others = match self.unjoined.len() - 1 {
                0 => String::new(),
                n => format!(", and so do {n} other pair(s) of edges"),
            };
            sentences.push(format!(
                "{names} nearly touch, {} apart, more than the {} that count as contact{others}",
                units.small_length(*distance, 1),
                units.small_length(tolerance.gap, 1)
            ));
        }
        sentences
    }
}
