//! Draws the structure without its solution, for exercises: the blocks, the ground, the robots and the loads.

use super::canvas::Canvas;
use super::panel::{About, Figure};
use super::{load, stage};

/// The figure of a structure without its solution.
pub(crate) struct Structure;

impl Figure for Structure {
    fn about(&self) -> About {
        About {
            name: "structure",
            help: "The structure and its loads without forces and verdict, for exercises; --dimensions adds its size",
            title: "A dry-laid structure",
            hides_verdicts: true,
            ..About::default()
        }
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        stage::ground(canvas);
        stage::blocks(canvas);
        stage::listed_contacts(canvas);
        stage::held(canvas);
        load::loads(canvas);
        stage::names(canvas);
    }
}
