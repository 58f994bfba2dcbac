//! [`ByColour`]: joins outlines of the same colour into one path, so that a file has only a few paths.

use crate::pictures::drawing::{Colour, Item, Outline, Path, Stroke};

/// Outlines joined by colour, in the order in which the colours were added.
#[derive(Default)]
pub(crate) struct ByColour(Vec<(Colour, Outline)>);

impl ByColour {
    pub fn add(&mut self, fill: Colour, outline: Outline) {
        match self.0.iter_mut().find(|known| known.0 == fill) {
            Some(known) => known.1.extend(outline),
            None => self.0.push((fill, outline)),
        }
    }

    /// Returns one filled path for each colour. All paths have the same stroke.
    pub fn paths(self, stroke: Option<Stroke>) -> impl Iterator<Item = Item> {
        let path = move |(fill, outline)| Path { stroke: stroke.clone(), ..Path::filled(outline, fill) };
        self.0.into_iter().map(path).map(Item::from)
    }
}
