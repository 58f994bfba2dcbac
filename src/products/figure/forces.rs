//! The figure of forces: every force as an arrow on the block it acts on.

use super::arrow::Marks;
use super::content::PanelContent;
use super::context::FigureContext;
use super::legend::{self, Entry};
use super::mark;
use super::option::Options;
use super::panel;
use super::verdict;
use crate::analysis::Analysis;
use crate::drawing::{Camera, Group};
use crate::geometry::Bounds;

/// The figure of forces, each panel with its own scale of arrows.
pub(crate) const FORCES: Forces = Forces {
    name: "forces",
    help: "Every force as an arrow on the block it acts on, and what is missing",
    shares_arrow_scale: false,
};

/// The forces in the steps of a construction, to one scale, so that the steps can be compared.
pub(crate) const BUILD: Forces = Forces {
    name: "build",
    help: "The steps of a construction, arrows to one scale in all of them; --animate shows them one after the other",
    shares_arrow_scale: true,
};

/// A figure of forces.
pub(crate) struct Forces {
    name: &'static str,
    help: &'static str,
    shares_arrow_scale: bool,
}

impl PanelContent for Forces {
    fn name(&self) -> &'static str {
        self.name
    }

    fn help(&self) -> &'static str {
        self.help
    }

    fn title(&self) -> &'static str {
        "Forces in a dry-laid structure"
    }

    fn shares_arrow_scale(&self) -> bool {
        self.shares_arrow_scale
    }

    fn colours_show_amplitudes(&self) -> bool {
        true
    }

    fn draws_forces(&self) -> bool {
        true
    }

    fn largest_force(&self, analysis: &Analysis, frame: usize, options: &Options) -> f64 {
        mark::largest(analysis, frame, options)
    }

    fn marks(
        &self,
        analysis: &Analysis,
        frame: usize,
        options: &Options,
        newtons_per_unit: f64,
    ) -> Marks {
        mark::marks(analysis, frame, options, newtons_per_unit)
    }

    fn picture(
        &self,
        context: &FigureContext<'_>,
        frame: usize,
        view: Bounds,
        camera: &Camera,
    ) -> Group {
        panel::picture(context, frame, view, camera)
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        legend::entries(context, unit)
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        verdict::reason(&context.analysis.scene, &context.analysis.frames[frame])
    }
}
