//! [`SheetPart`]: a part of a report page, without markup. The writers for HTML, Markdown and PDF all read these
//! parts, so their contents agree.

use std::borrow::Cow;

use super::{Grid, HoverTarget, MarginBar};
use crate::mechanics::analysis::Verdict;
use crate::pictures::drawing::Drawing;
use crate::products::figure::Kind;

/// A part of a page.
#[derive(Clone, Debug)]
pub enum SheetPart {
    /// The verdict with the headline margin.
    Badge(Box<Badge>),
    /// The heading of the parts that follow.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// A paragraph in small letters.
    Note(String),
    /// Figures next to each other.
    Figures(Vec<Figure>),
    /// A table; it is left out if it has no rows.
    Table(Grid),
    /// Columns of parts, next to each other.
    Columns(Vec<Vec<SheetPart>>),
    /// Charts next to each other.
    Charts(Vec<Chart>),
}

/// The verdict with the headline margin.
#[derive(Clone, Debug)]
pub struct Badge {
    /// The verdict.
    pub verdict: Verdict,
    /// The most important margin as a sentence; empty if no margin was computed.
    pub headline: String,
    /// The same margin as a bar; `None` if no margin was computed.
    pub bar: Option<MarginBar>,
    /// The verdict with its reasons.
    pub sentence: String,
}

/// Parts about one step, or about the whole scene.
#[derive(Clone, Debug)]
pub struct Section {
    /// The letter of the step. Empty if the scene has only one step, or if the section is about the whole scene.
    pub letter: String,
    /// The heading; empty if the heading of the scene is sufficient.
    pub title: String,
    /// The verdict of the step, or of the whole scene.
    pub verdict: Verdict,
    /// Whether the section begins on a new page in print.
    pub begins_page: bool,
    /// The parts of the section.
    pub parts: Vec<SheetPart>,
}

/// A figure with its caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The caption.
    pub caption: String,
    /// The figure.
    pub drawing: Drawing,
    /// The same figure in dark colours, if the page follows the colours of the reader's system; otherwise `None`.
    pub dark: Option<Drawing>,
    /// The parts of the figure that are highlighted together with rows of tables.
    pub touches: Vec<HoverTarget>,
    /// The kind of the figure, and the index of its step; `None` in a comparison of two scenes.
    pub subject: Option<(Kind, usize)>,
}

/// A chart as an SVG document, with its caption.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The caption.
    pub caption: String,
    /// The SVG.
    pub svg: String,
    /// Whether the chart takes the whole width of a page.
    pub wide: bool,
}

impl Chart {
    /// Returns the SVG with its XML namespace, which a separate file needs.
    pub(crate) fn document(&self) -> Cow<'_, str> {
        if self.svg.contains("xmlns=") {
            return Cow::Borrowed(&self.svg);
        }
        let head = "<svg xmlns=\"http://www.w3.org/2000/svg\"";
        Cow::Owned(self.svg.replacen("<svg", head, 1))
    }
}
