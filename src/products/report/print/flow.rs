//! [`Flow`]: places text, tables and figures on the pages of a PDF, from top to bottom.

use std::collections::VecDeque;

use super::Page;
use crate::pictures::drawing::text::{width, wrap};
use crate::pictures::drawing::{
    Anchor, Colour, Drawing, Face, Group, Item, Outline, PagePoint, Path, Stroke, Text, Theme,
};
use crate::pictures::output::fonts::Fonts;
use crate::pictures::output::pdf::{self, Role};
use crate::products::report::entry::{Chart, Figure, SheetPart};
use crate::text::line;

/// Width and height of A4 in pixels, 96 per inch.
pub(super) const PAGE_SIZE: (f64, f64) = (793.7, 1122.5);
/// The margin of a page in pixels: 15 mm.
pub(super) const MARGIN: f64 = 56.7;
/// The y coordinate of the lower end of the text area of a page, pixels.
pub(super) const TEXT_BOTTOM: f64 = PAGE_SIZE.1 - MARGIN - 8.0;
/// The font size of paragraphs in pixels: 9 pt.
pub(super) const TEXT_SIZE: f64 = 12.0;
/// The font size of tables, notes and captions in pixels: 7.9 pt.
pub(super) const SMALL_TEXT_SIZE: f64 = 10.5;
/// The line height relative to the font size.
pub(super) const LINE_HEIGHT: f64 = 1.38;
/// The largest height of a figure, pixels.
const MAX_FIGURE_HEIGHT: f64 = 300.0;
/// Figures become smaller, at most by this factor, to fit on the rest of a page.
const MIN_SHRINKAGE: f64 = 0.75;
/// The width of the text area, pixels.
const WHOLE_WIDTH: f64 = PAGE_SIZE.0 - 2.0 * MARGIN;
/// The height of a heading with the space around it, pixels.
pub(super) const HEADING_HEIGHT: f64 = 32.0;
/// A paragraph of at most this many lines stays on one page.
const MAX_UNBROKEN_LINES: usize = 6;
/// Space between two columns, pixels.
pub(super) const COLUMN_GAP: f64 = 14.0;

/// Places text, tables and figures on pages from top to bottom.
pub(super) struct Flow {
    pub pages: Vec<Page>,
    /// The index of the current page.
    current: usize,
    /// The y coordinate at which the next item begins, pixels.
    pub y: f64,
    /// The x coordinate of the left edge of the column, pixels.
    pub left: f64,
    /// The width of the column, pixels.
    pub room: f64,
    /// The number of tables added so far.
    pub tables: usize,
    pub theme: Theme,
    fonts: Fonts,
    /// The line at the foot of every page.
    foot: String,
    /// The items that were added since the last call of [`Flow::close`].
    open: Vec<Item>,
    /// Rows of figures that did not fit on the current page. They stand at the top of the next one.
    waiting: VecDeque<Vec<Figure>>,
}

impl Flow {
    /// Makes a flow with one empty page. `foot` is the line at the foot of every page.
    pub fn new(foot: String) -> Flow {
        let mut flow = Flow {
            pages: Vec::new(),
            current: 0,
            y: MARGIN,
            left: MARGIN,
            room: WHOLE_WIDTH,
            tables: 0,
            theme: Theme::thesis(),
            fonts: Fonts::default(),
            foot,
            open: Vec::new(),
            waiting: VecDeque::new(),
        };
        flow.page();
        flow
    }

    /// Returns the current page. Creates the page if it does not exist.
    pub fn page(&mut self) -> &mut Page {
        while self.pages.len() <= self.current {
            self.pages.push(Page { foot: self.foot.clone(), ..Page::default() });
        }
        &mut self.pages[self.current]
    }

    /// Continues at the top of the next page, below the figures that wait for it, unless the current page is empty.
    pub fn new_page(&mut self) {
        if self.y > MARGIN {
            self.current += 1;
            self.y = MARGIN;
            self.page();
            let column = (self.left, self.room);
            (self.left, self.room) = (MARGIN, WHOLE_WIDTH);
            while let Some(row) = self.waiting.pop_front() {
                if let Err(row) = self.placed(row) {
                    self.waiting.push_front(row);
                    break;
                }
            }
            (self.left, self.room) = column;
        }
    }

    /// Places all figures that wait for a page.
    pub fn flush(&mut self) {
        while !self.waiting.is_empty() {
            self.new_page();
        }
    }

    /// Continues on the next page if less than `height` pixels are left on this page.
    pub fn reserve(&mut self, height: f64) {
        if self.y + height > TEXT_BOTTOM {
            self.new_page();
        }
    }

    /// Adds one line of text. Its top is at the current y coordinate, and `x` is the coordinate of its anchor.
    pub fn put(&mut self, words: &str, x: f64, face: Face, size: f64, colour: Colour, anchor: Anchor) {
        let at = PagePoint::new(x, self.y + size);
        let text = Text::new(at, words, face, size, colour).anchored(anchor);
        self.open.push(text.into());
    }

    /// Adds an item to the group that the next [`Flow::close`] makes.
    pub fn add(&mut self, item: impl Into<Item>) {
        self.open.push(item.into());
    }

    /// Moves the items that were added since the last call of this function to the page, as one group with this role.
    /// Does nothing if there are no such items.
    pub fn close(&mut self, role: Role) {
        let items = std::mem::take(&mut self.open);
        if items.is_empty() {
            return;
        }
        let page = self.page();
        page.groups.push(Group { items, ..Group::default() });
        page.roles.push(role);
    }

    /// Draws a horizontal line between two x coordinates.
    pub fn rule(&mut self, from: f64, to: f64, y: f64, colour: Colour, width: f64) {
        let line = Outline::line([PagePoint::new(from, y), PagePoint::new(to, y)]);
        self.add(Path::stroked(line, Stroke::new(colour, width)));
        self.close(Role::Artifact);
    }

    /// Returns the text on one line. Code points such as `U+4E2D` replace characters that the fonts do not have.
    pub fn legible(&self, words: &str) -> String {
        self.fonts.spelled(&line(words)).into_owned()
    }

    /// Adds text, broken into lines that fit the column. A text of at most [`MAX_UNBROKEN_LINES`] lines stays on one
    /// page. `size` is the font size in pixels.
    pub fn words(&mut self, words: &str, face: Face, size: f64, colour: Colour, role: &Role) {
        let words = self.legible(words);
        let rows = wrap(&words, face, size, self.room);
        if rows.len() <= MAX_UNBROKEN_LINES {
            self.reserve(LINE_HEIGHT * size * rows.len() as f64);
        }
        for row in rows {
            if self.y + LINE_HEIGHT * size > TEXT_BOTTOM {
                self.close(role.clone());
                self.new_page();
            }
            self.put(&row, self.left, face, size, colour, Anchor::Start);
            self.y += LINE_HEIGHT * size;
        }
        self.close(role.clone());
    }

    /// Adds a heading of this level, with the font size `size` in pixels. Headings of levels 1 to 3 become bookmarks.
    pub fn heading(&mut self, words: &str, size: f64, level: u8) {
        self.reserve(6.0 * size);
        self.y += if self.y > MARGIN { 0.5 * size } else { 0.0 };
        if level < 4 {
            let (words, y) = (self.legible(words), self.y);
            self.page().bookmarks.push((level, words, y));
        }
        let role = Role::Heading(level, self.legible(words));
        self.words(words, Face::SerifBold, size, self.theme.ink, &role);
        if level == 4 {
            let (left, right, y) = (self.left, self.left + self.room, self.y);
            self.rule(left, right, y, self.theme.ink, 0.8);
        }
        self.y += 0.3 * size;
    }

    /// Adds the title of a scene, with project, author and date on the right.
    pub fn title(&mut self, words: &str, details: &[String]) {
        let (top, room) = (self.y, self.room);
        let details: Vec<String> = details.iter().map(|d| self.legible(d)).collect();
        let wide = details.iter().map(|d| width(d, Face::Sans, SMALL_TEXT_SIZE)).fold(0.0, f64::max);
        for detail in &details {
            let x = self.left + room;
            self.put(detail, x, Face::Sans, SMALL_TEXT_SIZE, self.theme.faint, Anchor::End);
            self.close(Role::Paragraph);
            self.y += LINE_HEIGHT * SMALL_TEXT_SIZE;
        }
        let end = self.y;
        self.y = top;
        self.room = (room - wide.min(0.5 * room) - COLUMN_GAP).max(0.4 * room);
        self.heading(words, 20.0, 2);
        self.room = room;
        self.y = self.y.max(end);
    }

    pub fn paragraph(&mut self, words: &str) {
        self.words(words, Face::Sans, TEXT_SIZE, self.theme.ink, &Role::Paragraph);
        self.y += 0.4 * TEXT_SIZE;
    }

    /// Adds a paragraph in bold letters, without space below it.
    pub fn strong(&mut self, words: &str) {
        self.words(words, Face::SansBold, TEXT_SIZE, self.theme.ink, &Role::Paragraph);
    }

    /// Adds a paragraph in small, faint letters.
    pub fn note(&mut self, words: &str) {
        self.words(words, Face::Sans, SMALL_TEXT_SIZE, self.theme.faint, &Role::Paragraph);
        self.y += 0.4 * TEXT_SIZE;
    }

    /// Adds figures next to each other, each with its caption. Figures for which the page has too little space wait for the
    /// next page, and what follows them fills this one.
    pub fn figures(&mut self, figures: &[Figure]) {
        let row = if self.waiting.is_empty() { self.placed(figures.to_vec()) } else { Err(figures.to_vec()) };
        if let Err(row) = row {
            self.waiting.push_back(row);
        }
    }

    /// Places a row of figures, a little smaller if it then fits on the page, or returns it.
    fn placed(&mut self, figures: Vec<Figure>) -> Result<(), Vec<Figure>> {
        let across = figures.len().max(1) as f64;
        let wide = (self.room - COLUMN_GAP * (across - 1.0)) / across;
        let mut scales: Vec<f64> = figures.iter().map(|f| fitted(&f.drawing, wide)).collect();
        let heights = figures.iter().zip(&scales).map(|(f, scale)| scale * f.drawing.height);
        let mut high = heights.fold(0.0, f64::max);
        let free = TEXT_BOTTOM - self.y - 4.0 * SMALL_TEXT_SIZE;
        if free < MIN_SHRINKAGE * high {
            return Err(figures);
        }
        if free < high {
            scales.iter_mut().for_each(|scale| *scale *= free / high);
            high = free;
        }
        let (top, left) = (self.y, self.left);
        let mut end = top;
        for (number, (figure, scale)) in figures.iter().zip(scales).enumerate() {
            let x = left + number as f64 * (wide + COLUMN_GAP);
            let inset = (wide - scale * figure.drawing.width) / 2.0;
            let down = high - scale * figure.drawing.height;
            let at = PagePoint::new(x + inset, top + down);
            self.page().figures.push((figure.drawing.clone(), at, scale));
            self.y = top + high + 2.0;
            end = f64::max(end, self.caption(&figure.caption, x, wide));
        }
        self.y = end + 0.4 * TEXT_SIZE;
        Ok(())
    }

    /// Adds a caption at the current y coordinate, with its left edge at `x` and a width of `wide` pixels. Returns the
    /// y coordinate of its lower end, in pixels.
    fn caption(&mut self, words: &str, x: f64, wide: f64) -> f64 {
        let words = self.legible(words);
        for row in wrap(&words, Face::Sans, SMALL_TEXT_SIZE, wide) {
            self.put(&row, x, Face::Sans, SMALL_TEXT_SIZE, self.theme.faint, Anchor::Start);
            self.y += LINE_HEIGHT * SMALL_TEXT_SIZE;
        }
        self.close(Role::Paragraph);
        self.y
    }

    /// Adds charts in rows of two. If any chart is wide, each row has one chart.
    pub fn charts(&mut self, charts: &[Chart]) {
        let across = if charts.iter().any(|c| c.wide) { 1 } else { 2 };
        let wide = (self.room - COLUMN_GAP * (across - 1) as f64) / across as f64;
        for row in charts.chunks(across) {
            let sized = row.iter().filter_map(|chart| {
                let svg = chart.document().into_owned();
                let (width, height) = pdf::svg_size(&svg)?;
                let scale = (wide / width).min(1.0);
                Some((chart, svg, scale, scale * height))
            });
            let sized: Vec<_> = sized.collect();
            let high = sized.iter().map(|s| s.3).fold(0.0, f64::max);
            self.reserve(high + 4.0 * SMALL_TEXT_SIZE);
            let (top, left) = (self.y, self.left);
            let mut end = top;
            for (place, (chart, svg, scale, _)) in sized.into_iter().enumerate() {
                let x = left + place as f64 * (wide + COLUMN_GAP);
                let shows = self.legible(&chart.caption);
                let picture = (svg, shows, PagePoint::new(x, top), scale);
                self.page().charts.push(picture);
                self.y = top + high + 4.0;
                end = f64::max(end, self.caption(&chart.caption, x, wide));
            }
            self.y = end + 0.6 * TEXT_SIZE;
        }
    }

    /// Adds columns next to each other. `parts` adds the parts of one column.
    pub fn columns(&mut self, columns: &[Vec<SheetPart>], parts: &dyn Fn(&mut Flow, &[SheetPart])) {
        let (left, room) = (self.left, self.room);
        let across = columns.len().max(1) as f64;
        let wide = (room - COLUMN_GAP * (across - 1.0)) / across;
        self.flush();
        self.reserve(120.0);
        let start = (self.current, self.y);
        let mut end = start;
        for (number, column) in columns.iter().enumerate() {
            (self.current, self.y) = start;
            (self.left, self.room) = (left + number as f64 * (wide + COLUMN_GAP), wide);
            parts(self, column);
            if (self.current, self.y) > end {
                end = (self.current, self.y);
            }
        }
        (self.current, self.y) = end;
        (self.left, self.room) = (left, room);
    }
}

/// Returns the scale, at most 1, at which a figure is at most `wide` pixels wide and at most [`MAX_FIGURE_HEIGHT`]
/// high.
fn fitted(drawing: &Drawing, wide: f64) -> f64 {
    (wide / drawing.width).min(MAX_FIGURE_HEIGHT / drawing.height).min(1.0)
}
