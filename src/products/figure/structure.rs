//! Draws the structure without its solution, for exercises: the blocks, the ground, the robots and the loads.

use super::content::{About, PanelContent};
use super::context::FigureContext;
use super::label;
use super::legend::{self, Entry};
use super::panel::composed;
use super::pen::Pen;
use crate::geometry::Bounds;
use crate::pictures::drawing::Group;

/// The figure of a structure without its solution.
pub(crate) struct Structure;

impl PanelContent for Structure {
    fn about(&self) -> About {
        About {
            name: "structure",
            help: "The structure and its loads without forces and verdict, for exercises; --dimensions adds its size",
            title: "A dry-laid structure",
            hides_verdicts: true,
            ..About::default()
        }
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        composed(pen, view, pen.blocks(), vec![pen.arrows(false)], label::ink(pen))
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        legend::loads(context).into_iter().chain(legend::robots(context)).collect()
    }

    fn reason(&self, _context: &FigureContext<'_>, _frame: usize) -> String {
        String::new()
    }
}
