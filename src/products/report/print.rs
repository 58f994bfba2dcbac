//! Writes a report as PDF: A4 pages with figures and searchable text.
//!
//! A [`Flow`] places text, tables and figures on pages from top to bottom. A page is a drawing with figures at positions on
//! it. Tables break between rows and repeat their heads. Figures are scaled down to fit, and never cut.

use super::entry::{Chart, Entry, Grid, Step};
use super::page::{Report, ReportError};
use crate::drawing::text::{width, wrap};
use crate::drawing::{
    Anchor, Colour, Drawing, Face, Item, Outline, PagePoint, Path, Stroke, Text, Theme,
};
use crate::output::fonts::Fonts;
use crate::output::pdf::{self, Content, Heading, Inset, Sheet};
use crate::text::line;
use crate::wording::verdict::plain;

/// Width and height of A4 in pixels, 96 per inch.
const PAGE: (f64, f64) = (793.7, 1122.5);
/// The margin of a page, 15 mm.
const MARGIN: f64 = 56.7;
/// The width between the margins.
const TEXT_WIDTH: f64 = PAGE.0 - 2.0 * MARGIN;
/// The lower end of the text.
const BOTTOM: f64 = PAGE.1 - MARGIN - 16.0;
/// The font size in pixels: 9 pt.
const TEXT_SIZE: f64 = 12.0;
/// The font size of step headings.
const HEADING: f64 = 14.0;
/// The font size of tables in pixels: 7.9 pt.
const SMALL: f64 = 10.5;
/// The line height relative to the font size.
const LINE: f64 = 1.38;
/// The largest height of a figure.
const MAX_FIGURE_HEIGHT: f64 = 460.0;
/// A table up to this share of a page stays on one page.
const UNBROKEN_SHARE: f64 = 0.4;
/// Space between two columns of a table.
const GAP: f64 = 12.0;

/// A page: a drawing with text, and figures at positions.
#[derive(Clone, Debug, Default)]
pub(super) struct Page {
    items: Vec<Item>,
    figures: Vec<(Drawing, PagePoint, f64)>,
    /// Charts as SVG, with their captions.
    charts: Vec<(String, String, PagePoint, f64)>,
}

/// Places text, tables and figures on pages from top to bottom.
struct Flow {
    pages: Vec<Page>,
    y: f64,
    fonts: Fonts,
    theme: Theme,
}

impl Flow {
    fn new() -> Flow {
        Flow {
            pages: vec![Page::default()],
            y: MARGIN,
            fonts: Fonts::default(),
            theme: Theme::thesis(),
        }
    }

    fn page(&mut self) -> &mut Page {
        if self.pages.is_empty() {
            self.pages.push(Page::default());
        }
        let last = self.pages.len() - 1;
        &mut self.pages[last]
    }

    /// Starts a new page if less than `height` is left.
    fn reserve(&mut self, height: f64) {
        if self.y + height > BOTTOM && self.y > MARGIN {
            self.pages.push(Page::default());
            self.y = MARGIN;
        }
    }

    fn put(&mut self, words: &str, x: f64, face: Face, size: f64, colour: Colour, anchor: Anchor) {
        let at = PagePoint::new(x, self.y + size);
        let text = Text::new(at, words, face, size, colour).anchored(anchor);
        self.page().items.push(text.into());
    }

    /// Replaces characters that the fonts do not have by their code points.
    fn legible(&self, words: &str) -> String {
        self.fonts.spelled(&line(words)).into_owned()
    }

    fn words(&mut self, words: &str, face: Face, size: f64, colour: Colour) {
        let words = self.legible(words);
        for row in wrap(&words, face, size, TEXT_WIDTH) {
            self.reserve(LINE * size);
            self.put(&row, MARGIN, face, size, colour, Anchor::Start);
            self.y += LINE * size;
        }
    }

    fn heading(&mut self, words: &str, size: f64) {
        self.reserve(6.0 * size);
        self.y += 0.5 * size;
        self.words(words, Face::SerifBold, size, self.theme.ink);
        self.y += 0.25 * size;
    }

    fn paragraph(&mut self, words: &str) {
        self.words(words, Face::Sans, TEXT_SIZE, self.theme.ink);
        self.y += 0.4 * TEXT_SIZE;
    }

    fn note(&mut self, words: &str) {
        self.words(words, Face::Sans, SMALL, self.theme.faint);
        self.y += 0.4 * TEXT_SIZE;
    }

    /// A figure with its caption, at most as wide as the text.
    fn figure(&mut self, drawing: &Drawing, caption: &str) {
        let scale = fitted(drawing);
        let (wide, high) = (scale * drawing.width, scale * drawing.height);
        self.reserve(high + 3.0 * SMALL);
        let at = PagePoint::new(MARGIN + (TEXT_WIDTH - wide) / 2.0, self.y);
        self.page().figures.push((drawing.clone(), at, scale));
        self.y += high + 4.0;
        self.note(caption);
    }

    /// Charts in rows of `across`, each with its caption.
    fn charts(&mut self, charts: &[Chart], across: usize) {
        let wide = (TEXT_WIDTH - GAP * (across - 1) as f64) / across as f64;
        for row in charts.chunks(across) {
            let sized = row.iter().filter_map(|chart| {
                let svg = chart.document().into_owned();
                let (width, height) = pdf::svg_size(&svg)?;
                let scale = (wide / width).min(MAX_FIGURE_HEIGHT / height).min(1.0);
                Some((chart, svg, scale, scale * height))
            });
            let sized: Vec<_> = sized.collect();
            let high = sized.iter().map(|s| s.3).fold(0.0, f64::max);
            self.reserve(high + 4.0 * SMALL);
            let top = self.y;
            let mut end = top;
            for (place, (chart, svg, scale, _)) in sized.into_iter().enumerate() {
                let x = MARGIN + place as f64 * (wide + GAP);
                let shows = self.legible(&chart.caption);
                let picture = (svg, shows.clone(), PagePoint::new(x, top), scale);
                self.page().charts.push(picture);
                self.y = top + high + 4.0;
                for words in wrap(&shows, Face::Sans, SMALL, wide) {
                    let faint = self.theme.faint;
                    self.put(&words, x, Face::Sans, SMALL, faint, Anchor::Start);
                    self.y += LINE * SMALL;
                }
                end = f64::max(end, self.y);
            }
            self.y = end + 0.6 * TEXT_SIZE;
        }
    }

    fn grid(&mut self, grid: &Grid) {
        if grid.lines.is_empty() {
            return;
        }
        let cells: Vec<Vec<String>> = grid
            .lines
            .iter()
            .map(|l| l.cells.iter().map(|c| self.legible(c)).collect())
            .collect();
        let heads: Vec<String> = grid.heads.iter().map(|h| h.0.clone()).collect();
        let widths = widths(&heads, &cells);
        let height = |row: &[String], face: Face| {
            let lines = row.iter().zip(&widths);
            let lines = lines.map(|(cell, w)| wrap(cell, face, SMALL, *w).len());
            LINE * SMALL * lines.max().unwrap_or(1).max(1) as f64 + 4.0
        };
        let head = height(&heads, Face::SansBold);
        // A short table stays on one page. A long one keeps at least two rows with its head.
        let whole: f64 = cells.iter().map(|row| height(row, Face::Sans)).sum();
        let least = if whole < UNBROKEN_SHARE * (BOTTOM - MARGIN) {
            whole
        } else {
            2.0 * LINE * SMALL
        };
        self.reserve(3.0 * TEXT_SIZE + head + least);
        if !grid.caption.is_empty() {
            self.y += 0.4 * TEXT_SIZE;
            self.words(&grid.caption, Face::SansBold, TEXT_SIZE, self.theme.ink);
        }
        self.row(&heads, grid, &widths, Face::SansBold, head);
        for row in &cells {
            let high = height(row, Face::Sans);
            if self.y + high > BOTTOM {
                self.pages.push(Page::default());
                self.y = MARGIN;
                self.row(&heads, grid, &widths, Face::SansBold, head);
            }
            self.row(row, grid, &widths, Face::Sans, high);
        }
        self.y += 0.6 * TEXT_SIZE;
    }

    fn row(&mut self, row: &[String], grid: &Grid, widths: &[f64], face: Face, high: f64) {
        let top = self.y;
        let mut x = MARGIN;
        for (column, (cell, wide)) in row.iter().zip(widths).enumerate() {
            let number = grid.heads.get(column).is_some_and(|h| h.1);
            let (at, anchor) = if number {
                (x + wide, Anchor::End)
            } else {
                (x, Anchor::Start)
            };
            self.y = top;
            // A cell that would not fit a page loses its end; its whole text is in the other forms of the report.
            let most = ((BOTTOM - MARGIN) / (LINE * SMALL)) as usize - 4;
            for part in wrap(cell, face, SMALL, *wide).into_iter().take(most) {
                self.put(&part, at, face, SMALL, self.theme.ink, anchor);
                self.y += LINE * SMALL;
            }
            x += wide + GAP;
        }
        self.y = top + high.min(BOTTOM - MARGIN);
        let rule = Outline::line([
            PagePoint::new(MARGIN, self.y - 1.0),
            PagePoint::new(x - GAP, self.y - 1.0),
        ]);
        let stroke = Stroke::new(self.theme.rule, 0.7);
        self.page().items.push(Path::stroked(rule, stroke).into());
    }
}

/// The scale at which a figure fits on a page.
fn fitted(drawing: &Drawing) -> f64 {
    let across = TEXT_WIDTH / drawing.width;
    across.min(MAX_FIGURE_HEIGHT / drawing.height).min(1.0)
}

/// The widths of the columns of a table: the width of their text if there is space, otherwise the widest are narrowed.
fn widths(heads: &[String], cells: &[Vec<String>]) -> Vec<f64> {
    let longest = |words: &str| {
        let parts = words.split_whitespace();
        parts
            .map(|w| width(w, Face::SansBold, SMALL))
            .fold(0.0, f64::max)
    };
    let wide = |column: usize| {
        let own = cells.iter().filter_map(|row| row.get(column));
        let own = own.map(|c| width(c, Face::Sans, SMALL)).fold(0.0, f64::max);
        // A head breaks at its spaces and widens its column only by its longest word.
        let head = width(&heads[column], Face::SansBold, SMALL).min(110.0);
        own.max(head).max(longest(&heads[column])) + 2.0
    };
    let mut widths: Vec<f64> = (0..heads.len()).map(wide).collect();
    let room = TEXT_WIDTH - GAP * heads.len().saturating_sub(1) as f64;
    loop {
        let sum: f64 = widths.iter().sum();
        if sum <= room {
            return widths;
        }
        let most = widths.iter().copied().fold(0.0, f64::max);
        let next = widths
            .iter()
            .copied()
            .filter(|w| *w < most)
            .fold(20.0, f64::max);
        let count = widths.iter().filter(|w| **w >= most).count() as f64;
        let to = next.max(most - (sum - room) / count);
        if to >= most {
            // All are as narrow as they may be.
            return widths;
        }
        for wide in widths.iter_mut().filter(|w| **w >= most) {
            *wide = to;
        }
    }
}

/// The pages before the scenes.
pub(super) fn head(report: &Report, summary: &str) -> Vec<Page> {
    let mut flow = Flow::new();
    flow.heading(&report.title, 24.0);
    flow.paragraph(&format!("{summary}."));
    flow.note(
        "“Stands” says that a balance of forces exists: for rigid blocks, laid dry (no mortar, no cohesion), at rest. A \
         balance that lives on wedging counts. Nothing here moves in time.",
    );
    for note in &report.notes {
        flow.note(note);
    }
    if !report.refused.is_empty() {
        flow.heading("Files that are no scenes", 16.0);
        for file in &report.refused {
            flow.words(&file.name, Face::SansBold, TEXT_SIZE, flow.theme.ink);
            for line in file.lines() {
                flow.paragraph(&line);
            }
        }
    }
    if report.pieces.len() > 1 {
        let what = if report.compares {
            "what changed"
        } else {
            "what fails"
        };
        let mut grid = Grid::new(
            "All of them",
            &[
                "name",
                "verdict",
                "#friction used, where it stands",
                "#blocks",
                "#largest force, where it stands",
                what,
            ],
        );
        for piece in &report.pieces {
            let row = &piece.row;
            let cells = [
                row.title.clone(),
                plain(row.verdict).to_owned(),
                row.friction_words(),
                row.blocks.to_string(),
                row.largest_words(),
                row.fails.clone(),
            ];
            grid.add("", cells);
        }
        flow.grid(&grid);
    }
    flow.pages
}

/// The pages of a scene.
pub(super) fn section(entry: &Entry) -> Vec<Page> {
    let mut flow = Flow::new();
    let row = &entry.row;
    flow.heading(&format!("{}: {}", row.title, plain(row.verdict)), 18.0);
    flow.note(&row.name);
    for remark in &entry.remarks {
        flow.note(remark);
    }
    for (number, step) in entry.steps.iter().enumerate() {
        // Keep the heading of a step on the page of its figure, and the first one below the heading of the scene.
        if number > 0 {
            flow.reserve(opening(step).min(BOTTOM - MARGIN));
        }
        self::step(&mut flow, step);
    }
    flow.charts(&entry.charts, 2);
    if let Some(study) = &entry.study {
        flow.charts(std::slice::from_ref(study), 1);
    }
    flow.reserve(entry.commands.len() as f64 * (LINE * SMALL + 0.4 * TEXT_SIZE));
    for (_, command) in &entry.commands {
        flow.note(command);
    }
    flow.pages
}

/// The height of the heading, the text and the first figure of a step.
fn opening(step: &Step) -> f64 {
    let lines = |words: &str, size: f64| {
        LINE * size * wrap(words, Face::Sans, size, TEXT_WIDTH).len() as f64 + 0.4 * TEXT_SIZE
    };
    let remarks = step.remarks.iter().map(|r| lines(r, SMALL));
    let figure = step.plates.first().map_or(0.0, |plate| {
        let high = fitted(&plate.drawing) * plate.drawing.height;
        high + 4.0 + lines(&plate.caption, SMALL)
    });
    3.0 * HEADING + lines(&step.sentence, TEXT_SIZE) + remarks.sum::<f64>() + figure
}

fn step(flow: &mut Flow, step: &Step) {
    if !step.letter.is_empty() {
        let words = format!("({}) {}: {}", step.letter, step.title, plain(step.verdict));
        flow.heading(&words, HEADING);
    }
    flow.paragraph(&step.sentence);
    for remark in &step.remarks {
        flow.note(remark);
    }
    for plate in &step.plates {
        flow.figure(&plate.drawing, &plate.caption);
    }
    if !step.bullets.is_empty() {
        let mut grid = Grid::new("Margins", &["margin", "in words"]);
        for bullet in &step.bullets {
            grid.add("", [bullet.name.clone(), bullet.words.clone()]);
        }
        flow.grid(&grid);
    }
    for grid in &step.grids {
        flow.grid(grid);
    }
    if !step.proof.is_empty() {
        flow.paragraph(&step.proof);
    }
    flow.charts(&step.charts, 2);
}

/// Numbers the pages and writes them as PDF.
pub(super) fn written(
    pages: &mut [Page],
    title: &str,
    description: &str,
) -> Result<Vec<u8>, ReportError> {
    let count = pages.len();
    let theme = Theme::thesis();
    let title = line(title);
    let words: Vec<Drawing> = pages
        .iter_mut()
        .enumerate()
        .map(|(number, page)| {
            let mut items = std::mem::take(&mut page.items);
            let at = PagePoint::new(PAGE.0 - MARGIN, PAGE.1 - MARGIN + 8.0);
            let number = format!("{} of {count}", number + 1);
            let number = Text::new(at, number, Face::Sans, SMALL, theme.faint);
            items.push(number.anchored(Anchor::End).into());
            Drawing {
                width: PAGE.0,
                height: PAGE.1,
                title: title.clone(),
                description: String::new(),
                background: None,
                items,
            }
        })
        .collect();
    let sheets: Vec<Sheet<'_>> = pages
        .iter()
        .zip(&words)
        .map(|(page, words)| {
            let mut parts = vec![Inset {
                content: Content::Drawing(words),
                at: PagePoint::new(0.0, 0.0),
                scale: 1.0,
            }];
            parts.extend(page.figures.iter().map(|(drawing, at, scale)| Inset {
                content: Content::Drawing(drawing),
                at: *at,
                scale: *scale,
            }));
            parts.extend(page.charts.iter().map(|(svg, shows, at, scale)| Inset {
                content: Content::Svg(svg, shows),
                at: *at,
                scale: *scale,
            }));
            Sheet {
                width: PAGE.0,
                height: PAGE.1,
                parts,
            }
        })
        .collect();
    let heading = Heading {
        title: &title,
        description,
    };
    Ok(pdf::write_sheets(&sheets, &heading)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Analysis;
    use crate::report::entry::{File, ReportOptions};
    use crate::scene::Scene;

    #[test]
    fn the_heading_of_a_step_stands_on_the_page_of_its_figure() {
        let text = include_str!("../../../tests/scenes/lintel.json");
        let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
        let file = File {
            name: "lintel.json",
            text,
        };
        let entry = Entry::new(file, &Analysis::new(&scene), &ReportOptions::default());
        let mut headings = 0;
        for page in section(&entry) {
            for item in &page.items {
                let Item::Text(words) = item else { continue };
                if words.size == HEADING && words.face == Face::SerifBold {
                    headings += 1;
                    let mut figures = page.figures.iter();
                    assert!(figures.any(|f| f.1.y > words.at.y), "{}", words.words);
                }
            }
        }
        assert_eq!(headings, 3);
    }
}
