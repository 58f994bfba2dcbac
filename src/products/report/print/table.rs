//! Adds tables to pages. A table can break between rows; the next page then repeats the column heads.

use super::bar;
use super::flow::{COLUMN_GAP, Flow, LINE_HEIGHT, MARGIN, SMALL_TEXT_SIZE, TEXT_BOTTOM, TEXT_SIZE};
use crate::pictures::drawing::text::{width, wrap};
use crate::pictures::drawing::{Anchor, Face, PagePoint, PageRect};
use crate::pictures::output::pdf::Role;
use crate::products::report::entry::{Grid, TableCell, Thumbnail};

/// A table stays on one page if the total height of its rows is below this fraction of the height of the text area.
const MAX_UNBROKEN_SHARE: f64 = 0.18;
/// Width of a bar in a table, pixels.
const BAR_WIDTH: f64 = 160.0;
/// Width and height of a small picture in a table, pixels.
const PICTURE_SIZE: (f64, f64) = (64.0, 40.0);
/// Largest width that is added to each column if a table is narrower than the space for it, pixels.
const MAX_SPREAD: f64 = 45.0;
/// Width of the SVG document of a small picture, before it is scaled to [`PICTURE_SIZE`], pixels.
const DRAWN_PICTURE_WIDTH: f64 = 96.0;

/// The layout of a table.
struct Layout {
    /// The number of the table among all tables of its [`Flow`], from 1.
    number: usize,
    head: Vec<TableCell>,
    rows: Vec<Vec<TableCell>>,
    /// For each column, whether it contains numbers.
    is_number: Vec<bool>,
    /// The widths of the columns, pixels.
    widths: Vec<f64>,
}

impl Flow {
    /// Adds a table. The table starts on a new page if the current page has too little space. A table without rows is
    /// left out.
    pub fn grid(&mut self, grid: &Grid) {
        if grid.lines.is_empty() {
            return;
        }
        self.tables += 1;
        let layout = self.layout(grid);
        self.reserve(layout.least(grid));
        if !grid.caption.is_empty() {
            self.y += 0.2 * TEXT_SIZE;
            self.strong(&grid.caption);
        }
        self.row(&layout, &layout.head, 0);
        for (number, row) in layout.rows.iter().enumerate() {
            if self.y + layout.height(row) > TEXT_BOTTOM {
                self.new_page();
                self.row(&layout, &layout.head, 0);
            }
            self.row(&layout, row, number + 1);
        }
        self.y += 0.5 * TEXT_SIZE;
    }

    /// Returns the height, in pixels, that must be free on a page for a table to begin there; 0 for a table without
    /// rows.
    pub fn least(&self, grid: &Grid) -> f64 {
        if grid.lines.is_empty() { 0.0 } else { self.layout(grid).least(grid) }
    }

    fn layout(&self, grid: &Grid) -> Layout {
        let legible = |cell: &TableCell| TableCell { words: self.legible(&cell.words), ..cell.clone() };
        let rows: Vec<Vec<TableCell>> = grid.lines.iter().map(|l| l.cells.iter().map(legible).collect()).collect();
        let heads = grid.heads.iter();
        let head: Vec<TableCell> = heads.map(|h| TableCell::strong_if(true, self.legible(&h.0))).collect();
        Layout {
            number: self.tables,
            widths: widths(&head, &rows, self.room),
            is_number: grid.heads.iter().map(|h| h.1).collect(),
            head,
            rows,
        }
    }

    /// Adds a row of a table at the current position. `number` is the number of the row; the head is row 0.
    fn row(&mut self, layout: &Layout, row: &[TableCell], number: usize) {
        let (top, high) = (self.y, layout.height(row));
        let mut x = self.left;
        for (column, (cell, wide)) in row.iter().zip(&layout.widths).enumerate() {
            self.y = top;
            let is_number = layout.is_number.get(column) == Some(&true);
            self.cell(cell, x, *wide, is_number);
            self.close(Role::Cell { table: layout.number, row: number, head: number == 0 });
            x += wide + COLUMN_GAP;
        }
        self.y = top + high.min(TEXT_BOTTOM - MARGIN);
        let (left, y) = (self.left, self.y - 1.0);
        let (colour, stroke) = if number == 0 { (self.theme.faint, 1.0) } else { (self.theme.rule, 0.7) };
        self.rule(left, left + self.room, y, colour, stroke);
    }

    fn cell(&mut self, cell: &TableCell, x: f64, wide: f64, is_number: bool) {
        if let Some(of) = &cell.bar {
            bar::draw(self, of, PagePoint::new(x, self.y), wide);
            return;
        }
        if let Some(picture) = &cell.picture {
            let at = PagePoint::new(x, self.y + 1.0);
            let scale = PICTURE_SIZE.0 / DRAWN_PICTURE_WIDTH;
            self.page().charts.push((small(picture), "A small picture of the blocks".to_owned(), at, scale));
            return;
        }
        let (at, anchor) = if is_number { (x + wide, Anchor::End) } else { (x, Anchor::Start) };
        let top = self.y;
        let face = face(cell);
        let colour = self.theme.ink;
        // Cut the text of a cell that is taller than a page. The other forms of the report have the whole text.
        let most = ((TEXT_BOTTOM - MARGIN) / (LINE_HEIGHT * SMALL_TEXT_SIZE)) as usize - 4;
        for part in wrap(&cell.words, face, SMALL_TEXT_SIZE, wide).into_iter().take(most) {
            self.put(&part, at, face, SMALL_TEXT_SIZE, colour, anchor);
            self.y += LINE_HEIGHT * SMALL_TEXT_SIZE;
        }
        if let Some(scene) = cell.scene {
            let place = PageRect { at: PagePoint::new(x, top), width: wide, height: self.y - top };
            self.page().links.push((place, scene, cell.words.clone()));
        }
    }
}

impl Layout {
    /// Returns the height, in pixels, that must be free on a page for the table to begin there. For a short table,
    /// this is its whole height. For a long table, it is the height of the caption, the head and two rows.
    fn least(&self, grid: &Grid) -> f64 {
        let whole: f64 = self.rows.iter().map(|row| self.height(row)).sum();
        let rows = if whole < MAX_UNBROKEN_SHARE * (TEXT_BOTTOM - MARGIN) {
            whole
        } else {
            2.0 * LINE_HEIGHT * SMALL_TEXT_SIZE
        };
        let caption = if grid.caption.is_empty() { 0.2 } else { 1.6 };
        caption * TEXT_SIZE + self.height(&self.head) + rows
    }

    /// Returns the height of a row, in pixels.
    fn height(&self, row: &[TableCell]) -> f64 {
        let cells = row.iter().zip(&self.widths);
        let heights = cells.map(|(cell, wide)| match (&cell.bar, &cell.picture) {
            (Some(_), _) => bar::HEIGHT,
            (_, Some(_)) => PICTURE_SIZE.1,
            _ => LINE_HEIGHT * SMALL_TEXT_SIZE * wrap(&cell.words, face(cell), SMALL_TEXT_SIZE, *wide).len() as f64,
        });
        heights.fold(LINE_HEIGHT * SMALL_TEXT_SIZE, f64::max) + 4.0
    }
}

fn face(cell: &TableCell) -> Face {
    if cell.strong { Face::SansBold } else { Face::Sans }
}

/// Returns a small picture as an SVG document.
fn small(picture: &Thumbnail) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"96\" height=\"60\" viewBox=\"0 0 96 60\">\
         <path d=\"{}\" fill=\"#5b6b74\"/><path d=\"{}\" fill=\"#b9c3cf\" stroke=\"#ffffff\" stroke-width=\"0.6\"/></svg>",
        picture.ground, picture.blocks
    )
}

/// Returns the widths of the columns in pixels. If there is enough space, each column has the width of its text plus an
/// equal part of the free space, at most [`MAX_SPREAD`]. If not, column heads break at their spaces. If that is not
/// enough, the widest columns become narrower.
fn widths(heads: &[TableCell], rows: &[Vec<TableCell>], space: f64) -> Vec<f64> {
    let longest = |words: &str| {
        let parts = words.split_whitespace();
        parts.map(|w| width(w, Face::SansBold, SMALL_TEXT_SIZE)).fold(0.0, f64::max)
    };
    let cell_width = |cell: &TableCell| match (&cell.bar, &cell.picture) {
        (Some(_), _) => BAR_WIDTH,
        (_, Some(_)) => PICTURE_SIZE.0,
        _ => width(&cell.words, face(cell), SMALL_TEXT_SIZE),
    };
    let own = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(cell_width).fold(0.0, f64::max)
    };
    let room = space - COLUMN_GAP * heads.len().saturating_sub(1) as f64;
    let columns = 0..heads.len();
    let whole = |column: usize| width(&heads[column].words, Face::SansBold, SMALL_TEXT_SIZE);
    let mut widths: Vec<f64> = columns.clone().map(|column| own(column).max(whole(column)) + 2.0).collect();
    let left = room - widths.iter().sum::<f64>();
    if left >= 0.0 {
        let more = (left / heads.len().max(1) as f64).min(MAX_SPREAD);
        return widths.into_iter().map(|wide| wide + more).collect();
    }
    for column in columns {
        let head = longest(&heads[column].words).max(whole(column).min(60.0));
        widths[column] = own(column).max(head) + 2.0;
    }
    loop {
        let sum: f64 = widths.iter().sum();
        if sum <= room {
            return widths;
        }
        let most = widths.iter().copied().fold(0.0, f64::max);
        let narrower = widths.iter().copied().filter(|w| *w < most);
        let next = narrower.fold(20.0, f64::max);
        let count = widths.iter().filter(|w| **w >= most).count() as f64;
        let to = next.max(most - (sum - room) / count);
        if to >= most {
            // No column can become narrower.
            return widths;
        }
        for wide in widths.iter_mut().filter(|w| **w >= most) {
            *wide = to;
        }
    }
}
