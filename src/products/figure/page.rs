//! [`Page`]: writes a page from finished pictures: the title, rows of pictures with their lines below, and the legend.

use std::rc::Rc;

use super::canvas::Picture;
use super::design::{Key, Look};
use super::option::Options;
use super::panel::Figure;
use super::verdict;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, SolvedFrame};
use crate::pictures::drawing::{Anchor, Colour, Drawing, Face, Group, Item, PagePoint, Text, text};
use crate::products::wording::number::{counted, quantity};
use crate::products::wording::verdict::reason;

/// The margin of the page, mm.
pub(crate) const MARGIN: f64 = 1.0;
/// The gap between columns, mm.
pub(crate) const GAP: f64 = 3.0;
/// Width of a list below a picture, if the width of the page is not given, mm.
pub(crate) const LIST_WIDTH: f64 = 86.0;
/// The gap between rows, mm.
const ROW_GAP: f64 = 4.0;
/// The typeface of titles.
const TITLE_FACE: Face = Face::SerifBold;
/// Largest number of lines of a caption and of a reason.
const MAX_LINES: usize = 4;
/// With more lines, the legend leaves out its notes.
const MAX_KEY_ROWS: usize = 2;
/// Largest number of frames in the description of a page.
const MAX_DESCRIBED: usize = 30;

/// How the pictures are arranged.
#[derive(Clone, Copy)]
pub(crate) struct Arrangement<'a> {
    pub options: &'a Options,
    pub figure: &'static dyn Figure,
    pub look: Look,
    pub columns: usize,
    /// Width of the page, pixels.
    pub width: f64,
    /// Width of a panel, pixels.
    pub panel: f64,
}

/// A picture on a page.
#[derive(Clone)]
pub(crate) struct Shown<'p> {
    pub analysis: &'p Analysis,
    /// The index of its frame, from 0.
    pub frame: usize,
    /// Its number on the page, from 1.
    pub number: usize,
    pub picture: &'p Picture,
    pub caption: String,
}

impl Arrangement<'_> {
    /// Returns the width of an entry of the legend, pixels.
    fn key_width(&self, key: &Key) -> f64 {
        let size = self.look.text * self.options.theme.sizes.key;
        let gap = if key.symbol.is_empty() { 0.0 } else { self.look.mm(1.2) };
        key.width + gap + text::width(&key.words, Face::Sans, size)
    }

    /// Writes a page with the given pictures, which lie between the two `sides` on their canvases.
    pub fn page(&self, shown: &[Shown<'_>], sides: (f64, f64), heading: &str) -> Drawing {
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
        let mut page = Page { sheet: *self, width, inner, y: look.mm(MARGIN), items: Vec::new() };
        if options.titles && !heading.is_empty() {
            page.heading(heading);
        }
        for (number, row) in shown.chunks(columns).enumerate() {
            page.y += if number > 0 { look.mm(ROW_GAP) } else { 0.0 };
            page.row(row, panel, (sides.0 + sides.1) / 2.0);
        }
        if options.keys {
            page.legend(shown);
        }
        let described: Vec<String> = shown.iter().take(MAX_DESCRIBED).map(|one| self.described(one)).collect();
        Drawing {
            width: width.ceil(),
            height: (page.y + look.mm(MARGIN + 0.6)).ceil(),
            title: if heading.is_empty() { self.figure.about().title.to_owned() } else { heading.to_owned() },
            description: described.join(" "),
            background: Some(theme.page),
            items: page.items,
        }
    }

    /// Returns the words after the verdict.
    fn words(&self, one: &Shown<'_>) -> Vec<String> {
        let words = || self.figure.words(one.analysis, one.frame, self.options);
        one.picture.words.clone().unwrap_or_else(words)
    }

    /// Describes a frame in a sentence, for screen readers.
    fn described(&self, one: &Shown<'_>) -> String {
        let solved @ SolvedFrame { scene, found, .. } = one.analysis.at(one.frame);
        if !one.picture.description.is_empty() {
            return one.picture.description.clone();
        }
        let blocks = counted(solved.frame().placed.len(), "block");
        let weight = quantity(found.weight, scene.units.force());
        let mut parts = vec![format!("{blocks}, {weight} in all")];
        if self.options.verdicts {
            parts[0] = format!("{}, {}", parts[0], found.verdict.plain());
            parts.push(reason(solved));
            parts.extend(self.words(one));
            parts.extend(found.notices.iter().cloned());
        }
        parts.retain(|part| !part.is_empty());
        parts.dedup();
        let start = if one.caption.is_empty() { String::new() } else { format!("{}: ", one.caption) };
        format!("{start}{}.", parts.join("; ").replace(text::NO_BREAK, " "))
    }
}

impl Shown<'_> {
    fn found(&self) -> &FrameAnalysis {
        &self.analysis.frames[self.frame]
    }
}

/// A page that is written from top to bottom.
struct Page<'a> {
    sheet: Arrangement<'a>,
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
            let word = if self.sheet.options.verdicts { found.verdict.plain() } else { "no verdict is shown" };
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
            let badge = (self.sheet.figure.verdict(one.analysis, one.frame), Face::SansBold, colour);
            let mut line = if alone { vec![badge] } else { Vec::new() };
            let mut long = Vec::new();
            for words in self.sheet.words(one) {
                let span = (format!("{}·\u{a0}{words}", text::NO_BREAK), Face::Sans, theme.ink);
                let wide: f64 =
                    line.iter().chain([&span]).map(|(words, face, _)| text::width(words, *face, size)).sum();
                // What follows words that do not fit stands below them, so that the first margin stays first.
                let fits = alone && long.is_empty() && wide <= room - indent;
                if fits { line.push(span) } else { long.push(words) }
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
            let numbers = self.y + look.mm(0.4) + size;
            let has_numbers = row.iter().any(|key| !key.ticks.is_empty());
            for key in row {
                let middle = PagePoint::new(x, self.y - 0.36 * size);
                let symbol = key.symbol.iter().map(|path| Item::from(path.clone()).moved(middle.x, middle.y));
                group.items.extend(symbol);
                for (along, number) in &key.ticks {
                    let at = PagePoint::new(x + along, numbers);
                    let number = Text::new(at, *number, Face::Sans, size, theme.faint).anchored(Anchor::Middle);
                    group.items.push(number.into());
                }
                let words = text::width(&key.words, Face::Sans, size);
                let at = PagePoint::new(x + width(&key) - words, self.y);
                group.items.push(Text::new(at, key.words.as_str(), Face::Sans, size, theme.faint).into());
                x += width(&key) + between;
            }
            if has_numbers {
                self.y = numbers;
            }
        }
        if !group.items.is_empty() {
            self.items.push(group.into());
        }
    }
}
