//! [`Sheet`]: a page of panels in the new look, one for each frame: the title, the pictures in one scale and position,
//! one line below each, and a legend of at most two lines.

use std::rc::Rc;

use super::about::About;
use super::canvas::{Canvas, Picture, Shared, corners};
use super::design::{Key, Look, around};
use super::option::Options;
use super::stage;
use super::unit::zoomed_view;
use super::verdict;
use super::words::{counted, letter, quantity};
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::{Analysis, FrameAnalysis, MarginKind, Verdict};
use crate::pictures::drawing::{Anchor, Colour, Drawing, Face, Group, Item, PagePoint, Text, text};
use crate::products::wording::margin::governing;
use crate::products::wording::placement;

/// The margin of the page, mm.
const MARGIN: f64 = 1.0;
/// The gap between columns, mm.
const GAP: f64 = 3.0;
/// Largest width of a page whose width is not given, mm of the design.
const SCREEN_WIDTH: f64 = 150.0;
/// A page narrower than this is a column of print, mm.
const COLUMN_WIDTH: f64 = 100.0;
/// Largest height of a picture in a column and on a wider page, mm.
const HIGH: [f64; 2] = [66.0, 100.0];
/// Largest size of a typical block in a picture, mm.
const LARGEST_BLOCK: f64 = 16.0;
/// Largest size of the block that a zoomed picture shows, mm.
const LARGEST_ZOOMED_BLOCK: f64 = 40.0;
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
/// How often the pictures are drawn to find the scale at which they fill the width.
const ROUNDS: usize = 6;
/// Width of a list below a picture, if the width of the page is not given, mm.
const LIST_WIDTH: f64 = 86.0;
/// The typeface of titles.
const TITLE_FACE: Face = Face::SerifBold;
/// Largest number of lines of a caption and of a reason.
const MAX_LINES: usize = 4;
/// With more lines, the legend leaves out its notes.
const MAX_KEY_ROWS: usize = 2;
/// Largest number of frames in the description of a page.
const MAX_DESCRIBED: usize = 30;

/// The part of the scene that all panels show, and the scale of its lengths.
pub(crate) struct View<'a> {
    pub analysis: &'a Analysis,
    /// All blocks of all frames, metres.
    pub structure: Bounds,
    /// Pixels per metre.
    pub zoom: f64,
}

/// What the panels of a figure show.
pub(crate) struct Subject {
    /// The frames of the panels, counted from 0.
    pub frames: Vec<usize>,
    /// The part of the scene that each panel shows, metres.
    pub bounds: Bounds,
    /// Whether everything outside this part is cut off.
    pub is_cut: bool,
    /// The side of a typical block, metres, and its largest size in a picture, mm.
    pub block: (f64, f64),
}

impl Subject {
    /// The structure in all frames, or the neighbourhood of the block of the option `zoom`.
    pub fn structure(analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        let scene = &analysis.scene;
        let frames = frames.map_or_else(|| (0..analysis.frames.len()).collect(), <[usize]>::to_vec);
        if let Some(block) = options.zoom {
            let side = scene.blocks[block.0].body.polygon.area().sqrt();
            let bounds = zoomed_view(scene, block);
            return Subject { frames, bounds, is_cut: true, block: (side, LARGEST_ZOOMED_BLOCK) };
        }
        let blocks = stage::shown_blocks(scene);
        let polygons = || blocks.iter().map(|id| &scene.blocks[id.0].body.polygon);
        let ground = scene.ground.iter().map(|ground| ground.body.polygon.bounds());
        let origin = Bounds { min: Point::origin(), max: Point::origin() };
        let bounds = polygons().map(|polygon| polygon.bounds()).reduce(Bounds::union);
        let bounds = bounds.or_else(|| ground.reduce(Bounds::union)).unwrap_or(origin.grown(1.0));
        let last = scene.frames.last().map_or(&[][..], |frame| &frame.placed);
        let mut sizes: Vec<f64> = last.iter().map(|id| scene.blocks[id.0].body.polygon.area().sqrt()).collect();
        sizes.sort_by(f64::total_cmp);
        let side = sizes.get(sizes.len() / 2).copied().unwrap_or(bounds.diagonal());
        Subject { frames, bounds, is_cut: false, block: (side, LARGEST_BLOCK) }
    }
}

/// A kind of figure on the canvas. A new kind implements `about` and `draw` in a file of its own;
/// [`Kind`](super::Kind) lists it.
pub(crate) trait Figure: Sync {
    /// Returns the name, the description and the requirements of this kind of figure.
    fn about(&self) -> About;

    /// Draws the picture of a frame.
    fn draw(&self, canvas: &mut Canvas<'_>);

    /// Returns the one scale of all forces of the figure, pixels per newton; 0 if the figure draws no forces of
    /// contacts.
    fn scale(&self, _view: &View<'_>, _look: Look) -> f64 {
        0.0
    }

    /// Returns the optional margins: the figure shows them if the analysis has computed them, and is complete without
    /// them. Margins that the figure needs are requested with [`About::needs_margins`].
    fn stated_margins(&self, _analysis: &Analysis) -> &'static [MarginKind] {
        &[]
    }

    /// Returns what the panels of these frames show; `None` for the frames that the figure shows on one page.
    fn subject(&self, analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        Subject::structure(analysis, options, frames)
    }

    /// Returns the caption of a frame.
    fn caption(&self, analysis: &Analysis, frame: usize, options: &Options) -> String {
        caption(analysis, frame, options)
    }

    /// Returns the words of the verdict of a frame, which are written in bold.
    fn verdict(&self, analysis: &Analysis, frame: usize) -> String {
        verdict::badge(&analysis.frames[frame]).to_owned()
    }

    /// Returns the words after the verdict of a frame: by default its headline margin, or what decides if no margin
    /// does.
    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        margin_words(analysis, frame, options)
    }

    /// Describes the picture of a frame for screen readers; empty to describe only the verdict.
    fn description(&self, _canvas: &Canvas<'_>) -> String {
        String::new()
    }

    /// Draws a list below the picture of a frame, in `room` pixels. Returns it with its height.
    fn list(&self, _canvas: &Canvas<'_>, _room: f64) -> (Group, f64) {
        (Group::default(), 0.0)
    }
}

/// The pictures of all frames, and their arrangement.
pub(crate) struct Sheet<'a> {
    analysis: &'a Analysis,
    figure: &'static dyn Figure,
    options: &'a Options,
    look: Look,
    subject: Subject,
    /// The results of each frame of the analysis that its pictures share.
    shared: Rc<Vec<Shared>>,
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

/// A picture on a page.
#[derive(Clone)]
struct Shown<'p> {
    sheet: &'p Sheet<'p>,
    /// The index of its frame, from 0.
    frame: usize,
    /// Its number on the page, from 1.
    number: usize,
    picture: &'p Picture,
    caption: String,
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
            Some(Shown { sheet: &sheets[of], frame, number: place + 1, picture, caption: caption.to_owned() })
        })
        .collect();
    let sides = pictures.iter().map(|pictures| pictures.sides);
    let sides = sides.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or_default();
    sheets.first().map_or_else(Drawing::default, |sheet| sheet.composed(&shown, sides, title))
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
        let shared = Rc::new(analysis.frames.iter().map(|_| Shared::default()).collect());
        let mut sheet = Sheet { analysis, figure, options, look, subject, shared, columns: 1, width, panel: width };
        sheet.columns = sheet.fitting_columns(count);
        sheet.panel = sheet.panel_width(sheet.columns);
        sheet
    }

    /// Creates the arrangement of one page with all panels, and draws them. If the labels make the pictures too wide for
    /// their columns at every scale, there are fewer columns, unless the options give their number.
    fn filled(analysis: &'a Analysis, figure: &'static dyn Figure, options: &'a Options) -> (Sheet<'a>, Pictures) {
        let mut sheet = Sheet::new(analysis, figure, options, None);
        loop {
            let pictures = sheet.pictures(&sheet.subject.frames);
            let fits = pictures.sides.1 - pictures.sides.0 <= sheet.panel + sheet.look.mm(MARGIN);
            if fits || sheet.columns <= 1 || options.columns.is_some() {
                return (sheet, pictures);
            }
            sheet.columns -= 1;
            sheet.panel = sheet.panel_width(sheet.columns);
        }
    }

    fn panel_width(&self, columns: usize) -> f64 {
        let gaps = self.look.mm(2.0 * MARGIN + GAP * (columns - 1) as f64);
        ((self.width - gaps) / columns as f64).max(1.0)
    }

    /// Chooses the number of columns: mostly 3 or 2 if the blocks are large enough, else 1. Long strips have more.
    fn fitting_columns(&self, count: usize) -> usize {
        if let Some(columns) = self.options.columns {
            return columns.clamp(1, count.max(1));
        }
        let size = |columns: usize| {
            let room = self.panel_width(columns) - self.look.mm(4.0);
            self.subject.block.0 * room / self.subject.bounds.width().max(f64::MIN_POSITIVE) / self.look.mm(1.0)
        };
        match count {
            0 | 1 => 1,
            count if count > 12 && size(4) >= 3.0 => 4,
            count if ![2, 4].contains(&count) && size(3) >= if count > 12 { 3.0 } else { 5.0 } => 3,
            _ if size(2) >= 4.0 => 2,
            count if count > 12 && size(1) > 3.0 => 3,
            _ => 1,
        }
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

    /// Draws the pictures of these frames at the largest scale at which they fit into the width of a panel.
    fn pictures(&self, frames: &[usize]) -> Pictures {
        let most = self.high() / self.subject.bounds.height().max(f64::MIN_POSITIVE);
        let most = most.min(self.largest_zoom());
        let mut zoom = self.first_zoom();
        let about = self.figure.about();
        let is_crowded = self.options.dimensions || about.shows_one_block || about.needs_margins;
        let least = if is_crowded { LEAST_CROWDED_ZOOM } else { LEAST_ZOOM } * zoom;
        // Labels do not shrink with the structure, so a step is never large, and the largest scale that fits is kept.
        let mut best: Option<(f64, Pictures)> = None;
        for _ in 0..ROUNDS {
            let pictures = self.drawn(frames, zoom);
            let over = pictures.sides.1 - pictures.sides.0 - self.panel;
            let fits = over <= self.look.mm(0.15);
            let share = over / (self.subject.bounds.width() * zoom).max(f64::MIN_POSITIVE);
            let next = (zoom * (1.0 - share).clamp(0.75, 1.3)).max(least).min(most);
            let is_better = |kept: &(f64, Pictures)| {
                let kept_fits = kept.1.sides.1 - kept.1.sides.0 - self.panel <= self.look.mm(0.15);
                if fits == kept_fits { fits == (zoom > kept.0) } else { fits }
            };
            if best.as_ref().is_none_or(is_better) {
                best = Some((zoom, pictures));
            }
            if over.abs() <= self.look.mm(0.15) || !(next > 0.0) || (next - zoom).abs() < 1e-3 * zoom {
                break;
            }
            zoom = next;
        }
        best.map_or_else(|| self.drawn(frames, zoom), |(_, pictures)| pictures)
    }

    /// Draws the pictures of these frames with `zoom` pixels per metre.
    fn drawn(&self, frames: &[usize], zoom: f64) -> Pictures {
        let size = self.subject.block.0 * zoom / self.look.mm(1.0);
        let blocks = self.analysis.scene.frames.iter().map(|frame| frame.placed.len()).max().unwrap_or(0);
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

    /// Returns the width of an entry of the legend, pixels.
    fn key_width(&self, key: &Key) -> f64 {
        let size = self.look.text * self.options.theme.sizes.key;
        let gap = if key.symbol.is_empty() { 0.0 } else { self.look.mm(1.2) };
        key.width + gap + text::width(&key.words, Face::Sans, size)
    }

    /// Writes a page with some of the pictures.
    fn write(&self, pictures: &Pictures, frames: &[usize]) -> Drawing {
        let shown = frames.iter().filter_map(|frame| {
            let caption = self.figure.caption(self.analysis, *frame, self.options);
            Some(Shown { sheet: self, frame: *frame, number: frame + 1, picture: pictures.of(*frame)?, caption })
        });
        self.composed(&shown.collect::<Vec<_>>(), pictures.sides, &self.analysis.scene.title)
    }

    /// Writes a page with the given pictures, which lie between the two `sides` on their canvases.
    fn composed(&self, shown: &[Shown<'_>], sides: (f64, f64), heading: &str) -> Drawing {
        let (options, look) = (self.options, self.look);
        let theme = &options.theme;
        let columns = self.columns.min(shown.len()).max(1);
        let natural = sides.1 - sides.0;
        // Without a given width, the page is as wide as its panels, but wide enough for short texts.
        let panel = match options.width {
            Some(_) => self.panel,
            None => {
                let has_list = shown.iter().any(|one| !one.picture.list.0.items.is_empty());
                let least = match (has_list, columns) {
                    (true, 1) => LIST_WIDTH,
                    // Lists stand beside each other, so each has the width for which it was written.
                    (true, _) => LIST_WIDTH.min(self.panel / look.mm(1.0)),
                    (false, 1) => 72.0,
                    (false, _) => 42.0,
                };
                let keys = shown.iter().flat_map(|one| &one.picture.keys);
                let widest = keys.map(|key| self.key_width(key)).fold(0.0, f64::max) / columns as f64;
                natural.max(look.mm(least)).max(widest).min(self.panel.max(natural))
            }
        };
        let inner = columns as f64 * panel + look.mm(GAP * (columns - 1) as f64);
        let width = if options.width.is_some() { self.width } else { inner + look.mm(2.0 * MARGIN) };
        let mut page = Page { sheet: self, width, inner, y: look.mm(MARGIN), items: Vec::new() };
        if options.titles && !heading.is_empty() {
            page.heading(heading);
        }
        for (number, row) in shown.chunks(columns).enumerate() {
            page.y += if number > 0 { look.mm(4.0) } else { 0.0 };
            page.row(row, panel, (sides.0 + sides.1) / 2.0);
        }
        if options.keys {
            page.legend(shown);
        }
        let described: Vec<String> = shown.iter().take(MAX_DESCRIBED).map(Shown::described).collect();
        Drawing {
            width: width.ceil(),
            height: (page.y + look.mm(MARGIN + 0.6)).ceil(),
            title: if heading.is_empty() { self.figure.about().title.to_owned() } else { heading.to_owned() },
            description: described.join(" "),
            background: Some(theme.page),
            items: page.items,
        }
    }
}

impl Shown<'_> {
    fn found(&self) -> &FrameAnalysis {
        &self.sheet.analysis.frames[self.frame]
    }

    /// Returns the words after the verdict.
    fn words(&self) -> Vec<String> {
        let words = || self.sheet.figure.words(self.sheet.analysis, self.frame, self.sheet.options);
        self.picture.words.clone().unwrap_or_else(words)
    }

    /// Describes a frame in a sentence, for screen readers.
    fn described(&self) -> String {
        let (scene, found) = (&self.sheet.analysis.scene, self.found());
        if !self.picture.description.is_empty() {
            return self.picture.description.clone();
        }
        let blocks = counted(scene.frames[self.frame].placed.len(), "block");
        let weight = quantity(found.weight, scene.units.force());
        let mut parts = vec![format!("{blocks}, {weight} in all")];
        if self.sheet.options.verdicts {
            parts[0] = format!("{}, {}", parts[0], verdict::word(found.verdict));
            parts.push(verdict::reason(scene, found));
            parts.extend(self.words());
            parts.extend(found.notices.iter().cloned());
        }
        parts.retain(|part| !part.is_empty());
        parts.dedup();
        let start = if self.caption.is_empty() { String::new() } else { format!("{}: ", self.caption) };
        format!("{start}{}.", parts.join("; ").replace(text::NO_BREAK, " "))
    }
}

/// Returns the caption of a frame: its letter and its title, in a figure of several frames. In a zoomed figure, the
/// caption also names the block in the centre.
pub(crate) fn caption(analysis: &Analysis, frame: usize, options: &Options) -> String {
    let scene = &analysis.scene;
    let own = &scene.frames[frame].title;
    let mut parts = Vec::new();
    if scene.frames.len() > 1 {
        parts.push(format!("({})", letter(frame)));
    }
    if !own.is_empty() && (scene.frames.len() > 1 || *own != scene.title) {
        parts.push(own.clone());
    }
    if let Some(block) = options.zoom {
        parts.push(format!("around block {}", scene.blocks[block.0].id));
    }
    parts.join(" ")
}

/// Returns the headline margin of a frame, or what decides if no margin does.
pub(crate) fn margin_words(analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
    let (scene, found) = (&analysis.scene, &analysis.frames[frame]);
    let unexplained =
        found.verdict == Verdict::Undecided || found.verdict == Verdict::Unstable && found.failures.is_empty();
    // The panels of a strip are too narrow for margins.
    let mut margin = if options.verdict_margin && analysis.frames.len() == 1 {
        governing(scene, frame, found).words
    } else {
        Vec::new()
    };
    // The placement tolerance is computed only if it was asked for; in a strip it shows which step is delicate.
    margin.extend(found.placement.as_ref().map(|placement| placement::proved(scene, placement)));
    if margin.is_empty() && unexplained {
        let reason = verdict::reason(scene, found);
        return if reason.is_empty() { Vec::new() } else { vec![reason] };
    }
    margin
}

/// A page that is written from top to bottom.
struct Page<'a> {
    sheet: &'a Sheet<'a>,
    /// Width of the page, pixels.
    width: f64,
    /// Width of all panels of a row, pixels.
    inner: f64,
    /// The y coordinate below all parts that are already written, pixels.
    y: f64,
    items: Vec<Item>,
}

/// A part of a line of text with its face and its colour.
type Span = (String, Face, Colour);

impl Page<'_> {
    fn mm(&self, length: f64) -> f64 {
        self.sheet.look.mm(length)
    }

    fn heading(&mut self, heading: &str) {
        let theme = &self.sheet.options.theme;
        let size = self.sheet.look.text * theme.sizes.title;
        let room = self.width - self.mm(2.0 * MARGIN);
        for line in text::balanced(heading, TITLE_FACE, size, room, MAX_LINES) {
            self.y += 1.15 * size;
            let at = PagePoint::new(self.width / 2.0, self.y - 0.22 * size);
            self.items.push(Text::new(at, line, TITLE_FACE, size, theme.ink).anchored(Anchor::Middle).into());
        }
        self.y += self.mm(2.2);
    }

    /// Draws a row of pictures, each with its lines below. `middle` is the middle of all pictures on their canvases.
    fn row(&mut self, row: &[Shown<'_>], panel: f64, middle: f64) {
        let extents = || row.iter().map(|one| one.picture.extent);
        let top = extents().map(|extent| extent.at.y).fold(f64::INFINITY, f64::min);
        let bottom = extents().map(|extent| extent.at.y + extent.height).fold(f64::NEG_INFINITY, f64::max);
        let left = (self.width - self.inner) / 2.0;
        let start = self.y;
        let mut end = start;
        for (column, one) in row.iter().enumerate() {
            let centre = left + panel / 2.0 + column as f64 * (panel + self.mm(GAP));
            let (found, caption) = (one.found(), &one.caption);
            let mut group = Group { id: Some(format!("frame-{}", one.number)), ..Group::with_class("frame") };
            let word = if self.sheet.options.verdicts { verdict::word(found.verdict) } else { "no verdict is shown" };
            group.title = if caption.is_empty() { word.to_owned() } else { format!("{caption}: {word}") };
            group = group.with(Item::from(one.picture.group.clone()).moved(centre - middle, start - top));
            let (lines, mut below) = self.lines(one, PagePoint::new(centre, start + bottom - top), panel);
            group.items.extend(lines);
            let (list, high) = &one.picture.list;
            if !list.items.is_empty() {
                let top = below + self.mm(0.8);
                group = group.with(Item::from(list.clone()).moved(centre, top));
                below = top + high;
            }
            self.items.push(group.into());
            end = end.max(below);
        }
        self.y = end;
    }

    /// Writes the lines below the picture of a frame: the symbol of its verdict with its caption in a strip, with the
    /// verdict and the governing margin otherwise. Also returns the y coordinate below them.
    fn lines(&self, one: &Shown<'_>, top: PagePoint, room: f64) -> (Vec<Item>, f64) {
        let (options, look) = (self.sheet.options, self.sheet.look);
        let (theme, found) = (&options.theme, one.found());
        let size = look.text * theme.sizes.verdict;
        let colour = verdict::badge_colour(found, theme);
        let caption = if options.captions { one.caption.as_str() } else { "" };
        let plain = |line: String| vec![(line, Face::Sans, theme.ink)];
        let broken = |words: &str, room: f64| {
            let lines = text::sentence_lines(words, Face::Sans, size, room, MAX_LINES).into_iter();
            lines.map(plain).collect::<Vec<Vec<Span>>>()
        };
        let indent = if options.verdicts { look.mm(3.8) } else { 0.0 };
        let mut lines = broken(caption, room - indent);
        // The symbol of the verdict stands before the caption in a strip, and before the verdict otherwise.
        let alone = !look.is_strip || caption.is_empty();
        let marked_line = if alone { lines.len() } else { 0 };
        if options.verdicts {
            let badge = (self.sheet.figure.verdict(one.sheet.analysis, one.frame), Face::SansBold, colour);
            let mut line = if alone { vec![badge] } else { Vec::new() };
            let mut long = Vec::new();
            for words in one.words() {
                let span = (format!("{}·\u{a0}{words}", text::NO_BREAK), Face::Sans, theme.ink);
                let wide: f64 =
                    line.iter().chain([&span]).map(|(words, face, _)| text::width(words, *face, size)).sum();
                if alone && wide <= room - indent { line.push(span) } else { long.push(words) }
            }
            if !line.is_empty() {
                lines.push(line);
            }
            lines.extend(long.iter().flat_map(|words| broken(words, room)));
        }
        let mut items = Vec::new();
        let mut y = top.y + look.mm(0.8);
        for (number, spans) in lines.iter().enumerate() {
            y += look.mm(3.4);
            let total: f64 = spans.iter().map(|(words, face, _)| text::width(words, *face, size)).sum();
            let marked = options.verdicts && number == marked_line;
            let mut x = top.x - (total + if marked { indent } else { 0.0 }) / 2.0;
            if marked {
                let centre = PagePoint::new(x + look.mm(1.35), y - 0.36 * size);
                items.push(verdict::mark_in(colour, found.verdict, centre, look.mm(1.35), theme).into());
                x += indent;
            }
            for (words, face, colour) in spans {
                items.push(Text::new(PagePoint::new(x, y), words.as_str(), *face, size, *colour).into());
                x += text::width(words, *face, size);
            }
        }
        (items, y + look.mm(0.8))
    }

    /// Writes the legend: the entries of the marks that are drawn, in as few lines as possible.
    fn legend(&mut self, shown: &[Shown<'_>]) {
        let (options, look) = (self.sheet.options, self.sheet.look);
        let theme = &options.theme;
        let size = look.text * theme.sizes.key;
        let mut keys: Vec<Rc<Key>> = shown.iter().flat_map(|one| one.picture.keys.iter().cloned()).collect();
        keys.sort_by_key(|key| key.rank);
        keys.dedup_by_key(|key| key.rank);
        let width = |key: &Key| self.sheet.key_width(key);
        let room = self.width - look.mm(2.0 * MARGIN);
        let between = look.mm(4.0);
        let broken = |keys: &[Rc<Key>]| {
            let mut rows: Vec<(f64, Vec<Rc<Key>>)> = Vec::new();
            for key in keys {
                let own = width(key);
                match rows.last_mut() {
                    Some((total, row)) if *total + between + own <= room => {
                        *total += between + own;
                        row.push(Rc::clone(key));
                    }
                    _ => rows.push((own, vec![Rc::clone(key)])),
                }
            }
            rows
        };
        let mut rows = broken(&keys);
        if rows.len() > MAX_KEY_ROWS {
            // Notes without a symbol are the first that a reader can miss.
            keys.retain(|key| !key.symbol.is_empty());
            rows = broken(&keys);
        }
        self.y += look.mm(1.0);
        let mut group = Group::with_class("legend");
        for (total, row) in rows {
            self.y += look.mm(3.4);
            let mut x = (self.width - total) / 2.0;
            for key in row {
                let middle = PagePoint::new(x, self.y - 0.36 * size);
                let symbol = key.symbol.iter().map(|path| Item::from(path.clone()).moved(middle.x, middle.y));
                group.items.extend(symbol);
                let words = text::width(&key.words, Face::Sans, size);
                let at = PagePoint::new(x + width(&key) - words, self.y);
                group.items.push(Text::new(at, key.words.as_str(), Face::Sans, size, theme.faint).into());
                x += width(&key) + between;
            }
        }
        if !group.items.is_empty() {
            self.items.push(group.into());
        }
    }
}
