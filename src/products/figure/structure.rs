//! Draws the structure without its solution, for exercises: the blocks, the ground, the robots and the loads.

use super::canvas::Canvas;
use super::panel::{About, Figure};
use super::stage;

/// The figure of a structure without its solution.
pub(crate) struct Structure;

impl Figure for Structure {
    fn about(&self) -> About {
        About {
            hides_verdicts: true,
            ..About::new(
                "structure",
                "The structure and its loads without forces and verdict, for exercises; --dimensions adds its size",
                "A dry-laid structure",
            )
        }
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        stage::listed_contacts(canvas);
    }
}
