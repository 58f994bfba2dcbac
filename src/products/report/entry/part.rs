//! [`SheetPart`]: a part of a report page, without markup. The writers for HTML, Markdown and PDF all read these
//! parts, so their contents agree.

use std::borrow::Cow;

use super::{HoverTarget, MarginBar, Thumbnail};
use crate::geometry::Point;
use crate::mechanics::analysis::Verdict;
use crate::pictures::drawing::{Camera, Drawing, Item};
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
    /// The most important margins in words, as below a figure; empty if no margin was computed.
    pub headline: String,
    /// The verdict with its reasons; empty if the headline says all.
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

impl SheetPart {
    /// Returns the number of figures of this part.
    pub(super) fn count_figures(&self) -> usize {
        match self {
            SheetPart::Figures(figures) => figures.len(),
            SheetPart::Columns(columns) => columns.iter().flatten().map(SheetPart::count_figures).sum(),
            _ => 0,
        }
    }

    /// Puts figures next to each other. The height `level` of their scenes, metres, is at one height on the page, so that the
    /// structures stand on one line. All figures become equally high.
    pub(super) fn row(figures: &[Figure], level: f64) -> SheetPart {
        let mut figures = figures.to_vec();
        let of = |drawing: &Drawing| camera(&drawing.items).map_or(0.0, |own| own.place(Point::new(0.0, level)).y);
        let mut drawings: Vec<&mut Drawing> = figures
            .iter_mut()
            .flat_map(|figure| std::iter::once(&mut figure.drawing).chain(&mut figure.dark))
            .collect();
        let lowest = drawings.iter().map(|drawing| of(drawing)).fold(0.0, f64::max);
        for drawing in &mut drawings {
            let down = lowest - of(drawing);
            drawing.items = std::mem::take(&mut drawing.items).into_iter().map(|item| item.moved(0.0, down)).collect();
            drawing.height += down;
        }
        let high = drawings.iter().map(|drawing| drawing.height).fold(0.0, f64::max);
        drawings.iter_mut().for_each(|drawing| drawing.height = high);
        SheetPart::Figures(figures)
    }
}

/// Returns the camera of the first scene among these items.
fn camera(items: &[Item]) -> Option<Camera> {
    items.iter().find_map(|item| match item {
        Item::Group(group) => group.camera.or_else(|| camera(&group.items)),
        _ => None,
    })
}

/// Numbers the figures of a report, from 1.
#[derive(Debug, Default)]
pub(super) struct FigureCount(usize);

impl FigureCount {
    /// Writes the numbers of figures into their captions, `Figure 2: The forces.`, and returns a reference to them:
    /// `Figures 2 to 4`. There is at least one.
    pub fn number<'f>(&mut self, figures: impl IntoIterator<Item = &'f mut Figure>) -> String {
        let first = self.0 + 1;
        for figure in figures {
            self.0 += 1;
            figure.caption = format!("Figure {}: {}", self.0, figure.caption);
        }
        match self.0.saturating_sub(first) {
            0 => format!("Figure {first}"),
            1 => format!("Figures {first} and {}", self.0),
            _ => format!("Figures {first} to {}", self.0),
        }
    }

    /// Numbers all figures of these parts.
    pub fn number_parts(&mut self, parts: &mut [SheetPart]) {
        for part in parts {
            match part {
                SheetPart::Figures(figures) => {
                    self.number(figures);
                }
                SheetPart::Columns(columns) => columns.iter_mut().for_each(|parts| self.number_parts(parts)),
                _ => {}
            }
        }
    }
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

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The caption; empty if the heading above the table is sufficient.
    pub caption: String,
    /// The column heads. The flag is true if the column contains numbers.
    pub heads: Vec<(String, bool)>,
    /// The rows.
    pub lines: Vec<Line>,
    /// Whether the last row is the sum of the other rows.
    pub has_sum: bool,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The id of the mark in the figure that belongs to this row: `i3` for a joint, `r0` for a robot, `f2` for a
    /// failure. Empty for a row without a mark.
    pub mark: String,
    /// The cells.
    pub cells: Vec<TableCell>,
}

/// A cell of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TableCell {
    /// The text.
    pub words: String,
    /// A margin that is drawn as a bar. The text of the cell then describes the bar.
    pub bar: Option<MarginBar>,
    /// A small picture, which is drawn instead of the text.
    pub picture: Option<Thumbnail>,
    /// The number of the scene to which the text links, from 1.
    pub scene: Option<usize>,
    /// Whether the text is emphasised.
    pub strong: bool,
}

impl<S: Into<String>> From<S> for TableCell {
    fn from(words: S) -> TableCell {
        TableCell { words: words.into(), ..TableCell::default() }
    }
}

impl TableCell {
    /// Makes a cell with a small picture and without text.
    pub fn picture(picture: Thumbnail) -> TableCell {
        TableCell { picture: Some(picture), ..TableCell::default() }
    }

    /// Makes a cell with a bar that shows a margin.
    pub fn bar(bar: MarginBar) -> TableCell {
        TableCell { words: bar.words.clone(), bar: Some(bar), ..TableCell::default() }
    }

    /// Makes a cell with this text, which is emphasised if `strong` is true.
    pub fn strong_if(strong: bool, words: impl Into<String>) -> TableCell {
        TableCell { strong, ..words.into().into() }
    }
}

impl Grid {
    /// Makes a table without rows. A `#` at the beginning of a head marks a column of numbers; the `#` is not shown.
    pub fn new<H: AsRef<str>>(caption: impl Into<String>, heads: &[H]) -> Grid {
        let head = |head: &H| match head.as_ref().strip_prefix('#') {
            Some(rest) => (rest.to_owned(), true),
            None => (head.as_ref().to_owned(), false),
        };
        Grid { caption: caption.into(), heads: heads.iter().map(head).collect(), lines: Vec::new(), has_sum: false }
    }

    /// Adds a row. `mark` is the id of a mark in the figure, or empty for a row without a mark.
    pub fn add<C: Into<TableCell>>(&mut self, mark: impl Into<String>, cells: impl IntoIterator<Item = C>) {
        self.lines.push(Line { mark: mark.into(), cells: cells.into_iter().map(Into::into).collect() });
    }
}
