//! A report as a PDF: pages of A4, figures as they are drawn, words in our own fonts that can be searched.
//!
//! A page is a drawing of words and lines, and figures in their places on it. Tables break between lines and begin again
//! with their heads; a figure is made smaller where it must be and never cut.

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

/// Width and height of A4, pixels, 96 to the inch.
const PAGE: (f64, f64) = (793.7, 1122.5);
/// The edge that stays empty, 15 mm.
const EDGE: f64 = 56.7;
/// Width of the words.
const ROOM: f64 = PAGE.0 - 2.0 * EDGE;
/// Where words end below.
const BOTTOM: f64 = PAGE.1 - EDGE - 16.0;
/// Size of the words, pixels: 9 pt.
const SIZE: f64 = 12.0;
/// Size of the heading of a step.
const HEADING: f64 = 14.0;
/// Size of the words of tables, pixels: 7.9 pt.
const SMALL: f64 = 10.5;
/// Height of a line in sizes of its words.
const LINE: f64 = 1.38;
/// A figure is no higher than this.
const HIGHEST: f64 = 460.0;
/// A table that takes no more than this share of a page is not broken.
const SHORT: f64 = 0.4;
/// Room between two columns of a table.
const GAP: f64 = 12.0;

/// A page: its words, and figures in their places.
#[derive(Clone, Debug, Default)]
pub(super) struct Page {
    items: Vec<Item>,
    figures: Vec<(Drawing, PagePoint, f64)>,
    /// Charts as SVG, and what they show.
    charts: Vec<(String, String, PagePoint, f64)>,
}

/// What is put on pages from top to bottom.
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
            y: EDGE,
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

    /// Makes sure of so much room below, on a new page where there is too little.
    fn make_room(&mut self, height: f64) {
        if self.y + height > BOTTOM && self.y > EDGE {
            self.pages.push(Page::default());
            self.y = EDGE;
        }
    }

    fn put(&mut self, words: &str, x: f64, face: Face, size: f64, colour: Colour, anchor: Anchor) {
        let at = PagePoint::new(x, self.y + size);
        let text = Text::new(at, words, face, size, colour).anchored(anchor);
        self.page().items.push(text.into());
    }

    /// Words that our fonts have: others are written as their code points.
    fn legible(&self, words: &str) -> String {
        self.fonts.spelled(&line(words)).into_owned()
    }

    fn words(&mut self, words: &str, face: Face, size: f64, colour: Colour) {
        let words = self.legible(words);
        for row in wrap(&words, face, size, ROOM) {
            self.make_room(LINE * size);
            self.put(&row, EDGE, face, size, colour, Anchor::Start);
            self.y += LINE * size;
        }
    }

    fn heading(&mut self, words: &str, size: f64) {
        self.make_room(6.0 * size);
        self.y += 0.5 * size;
        self.words(words, Face::SerifBold, size, self.theme.ink);
        self.y += 0.25 * size;
    }

    fn paragraph(&mut self, words: &str) {
        self.words(words, Face::Sans, SIZE, self.theme.ink);
        self.y += 0.4 * SIZE;
    }

    fn note(&mut self, words: &str) {
        self.words(words, Face::Sans, SMALL, self.theme.faint);
        self.y += 0.4 * SIZE;
    }

    /// A figure and what it shows, as wide as the words or less.
    fn figure(&mut self, drawing: &Drawing, caption: &str) {
        let scale = fitted(drawing);
        let (wide, high) = (scale * drawing.width, scale * drawing.height);
        self.make_room(high + 3.0 * SMALL);
        let at = PagePoint::new(EDGE + (ROOM - wide) / 2.0, self.y);
        self.page().figures.push((drawing.clone(), at, scale));
        self.y += high + 4.0;
        self.note(caption);
    }

    /// Charts, so many beside each other, each with its caption below it.
    fn charts(&mut self, charts: &[Chart], across: usize) {
        let wide = (ROOM - GAP * (across - 1) as f64) / across as f64;
        for row in charts.chunks(across) {
            let sized = row.iter().filter_map(|chart| {
                let svg = chart.document().into_owned();
                let (width, height) = pdf::svg_size(&svg)?;
                let scale = (wide / width).min(HIGHEST / height).min(1.0);
                Some((chart, svg, scale, scale * height))
            });
            let sized: Vec<_> = sized.collect();
            let high = sized.iter().map(|s| s.3).fold(0.0, f64::max);
            self.make_room(high + 4.0 * SMALL);
            let top = self.y;
            let mut end = top;
            for (place, (chart, svg, scale, _)) in sized.into_iter().enumerate() {
                let x = EDGE + place as f64 * (wide + GAP);
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
            self.y = end + 0.6 * SIZE;
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
        // A short table stays in one piece; of a long one at least two lines stay with its head.
        let whole: f64 = cells.iter().map(|row| height(row, Face::Sans)).sum();
        let least = if whole < SHORT * (BOTTOM - EDGE) {
            whole
        } else {
            2.0 * LINE * SMALL
        };
        self.make_room(3.0 * SIZE + head + least);
        if !grid.caption.is_empty() {
            self.y += 0.4 * SIZE;
            self.words(&grid.caption, Face::SansBold, SIZE, self.theme.ink);
        }
        self.row(&heads, grid, &widths, Face::SansBold, head);
        for row in &cells {
            let high = height(row, Face::Sans);
            if self.y + high > BOTTOM {
                self.pages.push(Page::default());
                self.y = EDGE;
                self.row(&heads, grid, &widths, Face::SansBold, head);
            }
            self.row(row, grid, &widths, Face::Sans, high);
        }
        self.y += 0.6 * SIZE;
    }

    fn row(&mut self, row: &[String], grid: &Grid, widths: &[f64], face: Face, high: f64) {
        let top = self.y;
        let mut x = EDGE;
        for (column, (cell, wide)) in row.iter().zip(widths).enumerate() {
            let number = grid.heads.get(column).is_some_and(|h| h.1);
            let (at, anchor) = if number {
                (x + wide, Anchor::End)
            } else {
                (x, Anchor::Start)
            };
            self.y = top;
            // A cell that would not fit a page loses its end; its whole text is in the other forms of the report.
            let most = ((BOTTOM - EDGE) / (LINE * SMALL)) as usize - 4;
            for part in wrap(cell, face, SMALL, *wide).into_iter().take(most) {
                self.put(&part, at, face, SMALL, self.theme.ink, anchor);
                self.y += LINE * SMALL;
            }
            x += wide + GAP;
        }
        self.y = top + high.min(BOTTOM - EDGE);
        let rule = Outline::line([
            PagePoint::new(EDGE, self.y - 1.0),
            PagePoint::new(x - GAP, self.y - 1.0),
        ]);
        let stroke = Stroke::new(self.theme.rule, 0.7);
        self.page().items.push(Path::stroked(rule, stroke).into());
    }
}

/// The scale at which a figure fits a page.
fn fitted(drawing: &Drawing) -> f64 {
    let across = ROOM / drawing.width;
    across.min(HIGHEST / drawing.height).min(1.0)
}

/// How wide the columns of a table are: as wide as their words where there is room, the widest narrowed where not.
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
        // A head is broken at its spaces before it makes its column wider.
        let head = width(&heads[column], Face::SansBold, SMALL).min(110.0);
        own.max(head).max(longest(&heads[column])) + 2.0
    };
    let mut widths: Vec<f64> = (0..heads.len()).map(wide).collect();
    let room = ROOM - GAP * heads.len().saturating_sub(1) as f64;
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
            flow.words(&file.name, Face::SansBold, SIZE, flow.theme.ink);
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
        // A step's heading stands on the page of its figure; the first one's stands below the scene's.
        if number > 0 {
            flow.make_room(opening(step).min(BOTTOM - EDGE));
        }
        self::step(&mut flow, step);
    }
    flow.charts(&entry.charts, 2);
    if let Some(study) = &entry.study {
        flow.charts(std::slice::from_ref(study), 1);
    }
    flow.make_room(entry.commands.len() as f64 * (LINE * SMALL + 0.4 * SIZE));
    for (_, command) in &entry.commands {
        flow.note(command);
    }
    flow.pages
}

/// How high a step's heading, its words and its first figure are together.
fn opening(step: &Step) -> f64 {
    let lines = |words: &str, size: f64| {
        LINE * size * wrap(words, Face::Sans, size, ROOM).len() as f64 + 0.4 * SIZE
    };
    let remarks = step.remarks.iter().map(|r| lines(r, SMALL));
    let figure = step.plates.first().map_or(0.0, |plate| {
        let high = fitted(&plate.drawing) * plate.drawing.height;
        high + 4.0 + lines(&plate.caption, SMALL)
    });
    3.0 * HEADING + lines(&step.sentence, SIZE) + remarks.sum::<f64>() + figure
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
        let mut grid = Grid::new("Margins", &["margin", "in numbers"]);
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

/// The pages as a PDF, each with its number.
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
            let at = PagePoint::new(PAGE.0 - EDGE, PAGE.1 - EDGE + 8.0);
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
