//! Draws the figure of forces: every force is an arrow on the block on which it acts.

use super::arrow::{ForceArrow, Marks};
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::legend::{self, Entry, MissingWords};
use super::limit;
use super::mark;
use super::panel;
use super::pen::Pen;
use super::verdict;
use crate::geometry::Bounds;
use crate::pictures::drawing::Group;

/// The figure of forces. The options decide whether each panel has its own scale of arrows.
pub(crate) const FORCES: Forces = Forces {
    name: "forces",
    help: "Every force at a joint as a mark in its place, and every missing force",
    shares_arrow_scale: false,
};

/// The forces in the steps of a construction. The arrows of all panels have the same scale, so that steps can be
/// compared.
pub(crate) const BUILD: Forces = Forces {
    name: "build",
    help: "The steps of a construction, with one scale of arrows for all steps; --animate shows the steps one after the other",
    shares_arrow_scale: true,
};

/// The note on missing forces in the legend.
const BALANCE_TEXT: &str = "arrows and fills show the balance with the missing forces";
/// The same note for a figure in which the arrows of missing forces have a larger scale.
const BALANCE_AND_SCALE_TEXT: &str =
    "arrows and fills show the balance with the missing forces, whose arrows have a larger scale";

/// True if the arrows of missing forces are drawn at a larger scale than other arrows.
fn own_scale(marks: &Marks) -> bool {
    let ratio = |arrow: &ForceArrow| arrow.vector.norm() / arrow.force.norm();
    let of = |missing: bool| {
        let mut arrows = marks.arrows.iter();
        arrows.find(|a| a.kind.is_failure() == missing).map(ratio)
    };
    of(true).zip(of(false)).is_some_and(|(missing, other)| missing > 1.01 * other)
}

/// A figure of forces.
pub(crate) struct Forces {
    name: &'static str,
    help: &'static str,
    shares_arrow_scale: bool,
}

impl PanelContent for Forces {
    fn about(&self) -> About {
        About {
            name: self.name,
            help: self.help,
            title: "Forces in a dry-laid structure",
            shares_arrow_scale: self.shares_arrow_scale,
            colours_show_amplitudes: true,
            draws_forces: true,
            stretches_arrows: true,
            ..About::default()
        }
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        mark::largest(of.analysis, of.frame, of.options)
    }

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        mark::marks(of.analysis, of.frame, of.options, newtons_per_unit)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        panel::picture(pen, view)
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let mut entries = legend::entries(context, unit);
        let frames = &context.analysis.frames;
        if frames.iter().any(|f| !f.failures.is_empty()) && !context.options.printed() {
            let own = context.marks.iter().any(own_scale);
            let missing = entries.iter_mut().find(|e| matches!(e, Entry::Missing(_)));
            match (missing, own) {
                (Some(missing), _) if context.options.is_column() => {
                    *missing = Entry::Missing(MissingWords::Included(own));
                }
                (_, true) => entries.push(Entry::Note(BALANCE_AND_SCALE_TEXT.to_owned())),
                (_, false) => entries.push(Entry::Note(BALANCE_TEXT.to_owned())),
            }
        }
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let why = verdict::reason(&context.analysis.scene, &context.analysis.frames[frame]);
        let parts = [why, limit::sentence(context, frame)];
        let parts: Vec<String> = parts.into_iter().filter(|p| !p.is_empty()).collect();
        parts.join("; ")
    }
}
