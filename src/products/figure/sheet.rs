//! [`Sheet`]: a page of panels in the new look, one for each frame: the title, the pictures in one scale and position,
//! one line below each, and a legend of at most two lines.

use std::rc::Rc;

use super::canvas::{Canvas, Picture, Shared, corners};
use super::design::{Look, around};
use super::option::Options;
use super::page::{Arrangement, GAP, LIST_WIDTH, MARGIN, Shown};
use super::panel::{Figure, Subject, View};
use super::stage;
use crate::geometry::Bounds;
use crate::mechanics::analysis::Analysis;
use crate::pictures::drawing::Drawing;

/// Largest width of a page whose width is not given, mm of the design.
const SCREEN_WIDTH: f64 = 150.0;
/// A page narrower than this is a column of print, mm.
const COLUMN_WIDTH: f64 = 100.0;
/// Largest height of a picture in a column and on a wider page, mm.
const HIGH: [f64; 2] = [66.0, 100.0];
/// From this size of a typical block on, a frame of at most [`FEW`] blocks is drawn with large marks and weights, mm.
const LARGE_BLOCK: f64 = 9.0;
const FEW: usize = 12;
/// From this size of a typical block on, blocks have names, mm.
const NAMED_BLOCK: f64 = 6.5;
/// Space that a picture leaves for its loads and labels before they are known, mm.
const FIRST_SPACE: f64 = 6.0;
/// The structure is never drawn smaller than this share of the first scale, whatever space labels take.
const LEAST_ZOOM: f64 = 0.8;
/// The same share if dimension lines or coordinates take space too.
const LEAST_CROWDED_ZOOM: f64 = 0.5;
/// A picture may be this much wider than its panel, mm.
const WIDER: f64 = 0.15;
/// The pictures are drawn again if their scale changes by more than this share.
const LEAST_CHANGE: f64 = 0.02;
/// A page is at most so many times as high as wide, if its blocks are then not smaller than [`LEAST_BLOCK`], mm.
const MOST_HIGH: f64 = 1.4;
const LEAST_BLOCK: f64 = 2.5;
/// The height of the title and the legend of a page, and of the lines and labels of a row, mm.
const HEAD: f64 = 18.0;
const ROW: f64 = 15.0;
/// The least width of a panel with sentences below it, mm.
const WORDS: f64 = 36.0;

/// The pictures of all frames, and their arrangement.
pub(crate) struct Sheet<'a> {
    analysis: &'a Analysis,
    figure: &'static dyn Figure,
    options: &'a Options,
    look: Look,
    subject: Subject,
    /// The results of each frame of the analysis that its pictures share.
    shared: Rc<Vec<Rc<Shared>>>,
    columns: usize,
    /// Width of the page, pixels.
    width: f64,
    /// Width of a panel, pixels.
    panel: f64,
}

/// The pictures of some frames, all with the same scale.
struct Pictures {
    /// The pictures with the indices of their frames.
    all: Vec<(usize, Picture)>,
    /// The left and the right edge of all pictures together, pixels.
    sides: (f64, f64),
    /// Pixels per metre.
    zoom: f64,
}

/// Draws all frames on one page.
pub(crate) fn page(analysis: &Analysis, figure: &'static dyn Figure, options: &Options) -> Drawing {
    let (sheet, pictures) = Sheet::filled(analysis, figure, options);
    sheet.write(&pictures, &sheet.subject.frames)
}

/// Draws each of these frames on a page of its own. All pages have the same size and scale.
pub(crate) fn pages(
    analysis: &Analysis,
    figure: &'static dyn Figure,
    options: &Options,
    frames: &[usize],
) -> Vec<Drawing> {
    let sheet = Sheet::new(analysis, figure, options, Some(frames));
    let frames = &sheet.subject.frames;
    if frames.is_empty() {
        return Vec::new();
    }
    let pictures = sheet.pictures(frames);
    same_size(frames.iter().map(|frame| sheet.write(&pictures, &[*frame])).collect())
}

/// Draws frames of several scenes on one page, all at the same scale and position, in rows of `columns` pictures. Each
/// panel has the index of its analysis, the index of its frame, and its caption.
pub(crate) fn plate(
    analyses: &[Analysis],
    figure: &'static dyn Figure,
    panels: &[(usize, usize, &str)],
    title: &str,
    columns: usize,
    options: &Options,
) -> Drawing {
    let sheet = |analysis| Sheet::new(analysis, figure, options, Some(&[]));
    let mut sheets: Vec<Sheet<'_>> = analyses.iter().map(sheet).collect();
    let bounds = sheets.iter().map(|sheet| sheet.subject.bounds).reduce(Bounds::union);
    for (number, sheet) in sheets.iter_mut().enumerate() {
        sheet.columns = columns;
        sheet.panel = sheet.panel_width(columns);
        sheet.look.is_strip = true;
        sheet.subject.bounds = bounds.unwrap_or(sheet.subject.bounds);
        sheet.subject.frames = panels.iter().filter(|panel| panel.0 == number).map(|panel| panel.1).collect();
    }
    let zooms = sheets.iter().map(|sheet| sheet.pictures(&sheet.subject.frames).zoom);
    let zoom = zooms.fold(f64::INFINITY, f64::min);
    let pictures: Vec<Pictures> = sheets.iter().map(|sheet| sheet.drawn(&sheet.subject.frames, zoom)).collect();
    let shown: Vec<Shown<'_>> = panels
        .iter()
        .enumerate()
        .filter_map(|(place, &(of, frame, caption))| {
            let picture = pictures.get(of)?.of(frame)?;
            let analysis = &analyses[of];
            Some(Shown { analysis, frame, number: place + 1, picture, caption: caption.to_owned() })
        })
        .collect();
    let sides = pictures.iter().map(|pictures| pictures.sides);
    let sides = sides.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or_default();
    sheets.first().map_or_else(Drawing::default, |sheet| sheet.arrangement().page(&shown, sides, title))
}

/// Draws a page for each step of a motion: the index of its frame, and the way from 0 at the beginning to 1 at the end.
/// All pages have the same size and scale.
pub(crate) fn steps(
    analysis: &Analysis,
    figure: &'static dyn Figure,
    options: &Options,
    steps: &[(usize, f64)],
) -> Vec<Drawing> {
    let mut frames: Vec<usize> = steps.iter().map(|step| step.0).collect();
    frames.dedup();
    let sheet = Sheet::new(analysis, figure, options, Some(&frames));
    // The end of the motion takes the most space, so its scale is the scale of all pages.
    let ends = sheet.pictures(&frames);
    let page = |(frame, way): &(usize, f64)| {
        let options = Options { motion_progress: *way, ..options.clone() };
        let shared = Rc::clone(&sheet.shared);
        let sheet = Sheet { shared, ..Sheet::new(analysis, figure, &options, Some(&frames)) };
        let mut pictures = sheet.drawn(&[*frame], ends.zoom);
        // Every page has the space and the position of the end of the motion.
        for (number, picture) in &mut pictures.all {
            if let Some(end) = ends.of(*number) {
                picture.extent =
                    around(corners(end.extent).into_iter().chain(corners(picture.extent))).unwrap_or(picture.extent);
            }
        }
        sheet.write(&Pictures { sides: ends.sides, ..pictures }, &[*frame])
    };
    same_size(steps.iter().map(page).collect())
}

impl Pictures {
    fn of(&self, frame: usize) -> Option<&Picture> {
        self.all.iter().find(|(number, _)| *number == frame).map(|(_, picture)| picture)
    }
}

/// Makes all pages as large as the largest.
fn same_size(mut pages: Vec<Drawing>) -> Vec<Drawing> {
    let [high, wide] =
        [|page: &Drawing| page.height, |page: &Drawing| page.width].map(|of| pages.iter().map(of).fold(0.0, f64::max));
    for page in &mut pages {
        (page.height, page.width) = (high, wide);
    }
    pages
}

/// Draws all frames on several pages with the same scale. The height of a page is at most `ratio` times its width, unless
/// one row is higher.
pub(crate) fn split(analysis: &Analysis, figure: &'static dyn Figure, options: &Options, ratio: f64) -> Vec<Drawing> {
    let (sheet, pictures) = Sheet::filled(analysis, figure, options);
    let frames = &sheet.subject.frames;
    let mut pages = Vec::new();
    let mut rest = &frames[..];
    while !rest.is_empty() {
        let mut taken = sheet.columns.min(rest.len());
        let mut page = sheet.write(&pictures, &rest[..taken]);
        while taken < rest.len() {
            let more = (taken + sheet.columns).min(rest.len());
            let next = sheet.write(&pictures, &rest[..more]);
            if next.height > ratio * next.width {
                break;
            }
            (taken, page) = (more, next);
        }
        pages.push(page);
        rest = &rest[taken..];
    }
    pages
}

/// Returns lower bounds of the width and the height of the page of [`page`], pixels. Nothing is drawn.
pub(crate) fn least_size(analysis: &Analysis, figure: &'static dyn Figure, options: &Options) -> (f64, f64) {
    let sheet = Sheet::new(analysis, figure, options, None);
    let rows = sheet.subject.frames.len().div_ceil(sheet.columns);
    let width = if options.width.is_some() { sheet.width } else { 0.0 };
    (width, rows as f64 * 0.5 * sheet.subject.bounds.height() * sheet.first_zoom())
}

impl<'a> Sheet<'a> {
    /// Creates the arrangement of one page with all panels, or of a page for each of these frames.
    fn new(
        analysis: &'a Analysis,
        figure: &'static dyn Figure,
        options: &'a Options,
        frames: Option<&[usize]>,
    ) -> Sheet<'a> {
        let subject = figure.subject(analysis, options, frames);
        let count = if frames.is_some() { 1 } else { subject.frames.len() };
        let is_strip = analysis.frames.len() > 1 && !figure.about().shows_one_block;
        let look = Look::new(options, is_strip);
        let width = options.width.unwrap_or(look.mm(SCREEN_WIDTH));
        let shared = Rc::new(analysis.of_each(|_| Rc::default()));
        let mut sheet = Sheet { analysis, figure, options, look, subject, shared, columns: 1, width, panel: width };
        sheet.columns = sheet.fitting_columns(count);
        sheet.panel = sheet.panel_width(sheet.columns);
        sheet
    }

    /// Creates the arrangement of one page with all panels, and draws them. If the labels make the pictures too wide for
    /// their columns, there are fewer columns, unless the options give their number.
    fn filled(analysis: &'a Analysis, figure: &'static dyn Figure, options: &'a Options) -> (Sheet<'a>, Pictures) {
        let mut sheet = Sheet::new(analysis, figure, options, None);
        loop {
            let pictures = sheet.pictures(&sheet.subject.frames);
            let fits = sheet.over(&pictures) <= sheet.look.mm(MARGIN);
            if fits || sheet.columns <= 1 || options.columns.is_some() {
                return (sheet, pictures);
            }
            sheet.columns -= 1;
            sheet.panel = sheet.panel_width(sheet.columns);
        }
    }

    /// Returns by how much the pictures are wider than a panel, pixels.
    fn over(&self, pictures: &Pictures) -> f64 {
        pictures.sides.1 - pictures.sides.0 - self.panel
    }

    fn arrangement(&self) -> Arrangement<'a> {
        let Sheet { figure, options, look, columns, width, panel, .. } = *self;
        Arrangement { options, figure, look, columns, width, panel }
    }

    fn panel_width(&self, columns: usize) -> f64 {
        let gaps = self.look.mm(2.0 * MARGIN + GAP * (columns - 1) as f64);
        ((self.width - gaps) / columns as f64).max(1.0)
    }

    /// Chooses the number of columns: mostly 3 or 2 if the blocks are large enough, else 1. Long strips have more, so that
    /// the page is not much higher than wide.
    fn fitting_columns(&self, count: usize) -> usize {
        if let Some(columns) = self.options.columns {
            return columns.clamp(1, count.max(1));
        }
        let zoom = |columns: usize| {
            let room = self.panel_width(columns) - self.look.mm(4.0);
            room / self.subject.bounds.width().max(f64::MIN_POSITIVE)
        };
        let size = |columns: usize| self.subject.block.0 * zoom(columns) / self.look.mm(1.0);
        let height = |columns: usize| {
            let zoom = zoom(columns).min(self.largest_zoom());
            let row = (self.subject.bounds.height() * zoom).min(self.high()) + self.look.mm(ROW);
            count.div_ceil(columns) as f64 * row + self.look.mm(HEAD)
        };
        let mut columns = match count {
            0 | 1 => return 1,
            count if ![2, 4].contains(&count) && size(3) >= 5.0 => 3,
            _ if size(2) >= 4.0 => 2,
            _ => 1,
        };
        let about = self.figure.about();
        let has_words = about.needs_capacity || self.options.at.is_some() || about.needs_sensitivity;
        let least = self.look.mm(if has_words { WORDS } else { 0.0 });
        while height(columns) > MOST_HIGH * self.width {
            // More columns must save a row.
            let rows = count.div_ceil(columns);
            match (columns + 1..=count).find(|more| count.div_ceil(*more) < rows) {
                Some(more) if size(more) >= LEAST_BLOCK && self.panel_width(more) >= least => columns = more,
                _ => break,
            }
        }
        columns
    }

    /// Returns the scale that leaves some space for loads and labels, pixels per metre.
    fn first_zoom(&self) -> f64 {
        let (wide, high) = (self.subject.bounds.width(), self.subject.bounds.height());
        let across = (self.panel - self.look.mm(FIRST_SPACE)).max(1.0) / wide.max(f64::MIN_POSITIVE);
        let zoom = across.min(self.high() / high.max(f64::MIN_POSITIVE)).min(self.largest_zoom());
        if zoom.is_finite() && zoom > 0.0 { zoom } else { 1.0 }
    }

    /// Returns the scale at which a typical block has its largest size, pixels per metre.
    fn largest_zoom(&self) -> f64 {
        let (side, most) = self.subject.block;
        self.look.mm(most) / side.max(f64::MIN_POSITIVE)
    }

    /// Returns the largest height of the structure in a picture, pixels.
    fn high(&self) -> f64 {
        let wide = usize::from(self.width >= self.look.mm(COLUMN_WIDTH));
        self.look.mm(HIGH[wide]).min(self.options.height.unwrap_or(f64::INFINITY))
    }

    /// Draws the pictures of these frames at a scale at which they fit into the width of a panel. The first pictures show
    /// how much space their labels take, which hardly depends on the scale; the second have the scale that leaves this
    /// space. A third scale is only tried if both are too wide.
    fn pictures(&self, frames: &[usize]) -> Pictures {
        let most = self.high() / self.subject.bounds.height().max(f64::MIN_POSITIVE);
        let most = most.min(self.largest_zoom());
        let first = self.first_zoom();
        let about = self.figure.about();
        let is_crowded =
            self.options.dimensions || about.shows_one_block || self.options.at.is_some() || self.options.with_polygon;
        let least = if is_crowded { LEAST_CROWDED_ZOOM } else { LEAST_ZOOM } * first;
        let mut best = self.drawn(frames, first);
        for _ in 0..2 {
            let over = self.over(&best);
            let fits = over <= self.look.mm(WIDER);
            let next = best.zoom - over / self.subject.bounds.width().max(f64::MIN_POSITIVE);
            let next = next.max(least).min(most);
            let change = (next / best.zoom - 1.0).abs();
            if !(next > 0.0) || change < if fits { LEAST_CHANGE } else { 1e-3 } {
                break;
            }
            let pictures = self.drawn(frames, next);
            let now = self.over(&pictures);
            if now <= self.look.mm(WIDER) {
                return pictures;
            }
            if fits {
                break;
            }
            if now < over {
                best = pictures;
            }
        }
        best
    }

    /// Draws the pictures of these frames with `zoom` pixels per metre.
    fn drawn(&self, frames: &[usize], zoom: f64) -> Pictures {
        let size = self.subject.block.0 * zoom / self.look.mm(1.0);
        let blocks = self.analysis.given().frames.iter().map(|frame| frame.placed.len()).max().unwrap_or(0);
        let narrow = self.columns >= 3 && self.width < self.look.mm(COLUMN_WIDTH);
        let look = Look {
            large: size >= LARGE_BLOCK && blocks <= FEW,
            names: size >= NAMED_BLOCK && !narrow,
            panel: self.panel,
            ..self.look
        };
        let view = View { analysis: self.analysis, structure: self.subject.bounds, zoom };
        let scale = self.figure.scale(&view, look);
        let all: Vec<(usize, Picture)> = frames
            .iter()
            .map(|frame| {
                let shown = (view.structure, zoom);
                let of = (*frame, &self.shared[..]);
                let mut canvas = Canvas::new(self.analysis, of, self.options, look, shown, scale);
                canvas.window = self.subject.is_cut.then_some(canvas.structure);
                self.figure.draw(&mut canvas);
                if self.options.dimensions {
                    stage::dimensions(&mut canvas);
                }
                if self.options.scale_bar
                    && let Some(key) = stage::scale_bar(&canvas)
                {
                    canvas.explain(key);
                }
                let description = self.figure.description(&canvas);
                let room = if self.options.width.is_some() { self.panel } else { self.panel.min(look.mm(LIST_WIDTH)) };
                let list = self.figure.list(&canvas, room);
                (*frame, Picture { list, description, ..canvas.finish() })
            })
            .collect();
        let left = all.iter().map(|(_, picture)| picture.extent.at.x).fold(f64::INFINITY, f64::min);
        let right = all.iter().map(|(_, picture)| picture.extent.at.x + picture.extent.width);
        let sides = (left, right.fold(f64::NEG_INFINITY, f64::max));
        Pictures { all, sides, zoom }
    }

    /// Writes a page with some of the pictures.
    fn write(&self, pictures: &Pictures, frames: &[usize]) -> Drawing {
        let shown = frames.iter().filter_map(|frame| {
            let caption = self.figure.caption(self.analysis, *frame, self.options);
            let picture = pictures.of(*frame)?;
            Some(Shown { analysis: self.analysis, frame: *frame, number: frame + 1, picture, caption })
        });
        self.arrangement().page(&shown.collect::<Vec<_>>(), pictures.sides, &self.analysis.given().title)
    }
}
