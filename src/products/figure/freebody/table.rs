//! [`Table`]: the list of the forces on a block, with magnitudes, components and moments, and their sum.
//!
//! All forces have the same unit and the same number of decimals, and so do all moments. A reader can therefore add up
//! the columns. The last row is the sum, which is zero in equilibrium, except for rounding.

use super::force::Force;
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::Unit;
use crate::mechanics::scene::format::UnitsEntry;
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::pictures::drawing::{
    Anchor, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme, text,
};

/// Space between columns, pixels.
const COLUMN_GAP: f64 = 14.0;
/// Height of a row, as a multiple of the font size.
const ROW_HEIGHT: f64 = 1.6;
/// Largest number of text lines in the last column of a row, which states the origin of a force.
const MAX_NAME_LINES: usize = 4;
/// Distance of two text lines in the last column of a row, as a multiple of the font size.
const LINE_PITCH: f64 = 1.15;
/// Significant digits of the largest amount of a column.
const DIGITS: i32 = 4;
/// Moments up to this fraction of the largest force times the block's size count as zero.
const MOMENT_TOL: f64 = 1e-9;

/// The forces on a block, row by row.
pub(super) struct Table {
    rows: Vec<Row>,
    /// The headings of the columns of numbers: symbol and unit.
    heads: Vec<(Symbol, String)>,
}

struct Row {
    symbol: Option<Symbol>,
    /// The magnitude, the two components, and the moment about the centroid. The magnitude of the sum is empty.
    numbers: [String; 4],
    from: String,
}

/// The unit of a column, and the number of decimals.
#[derive(Clone)]
struct Column {
    /// The unit as a multiple of the SI unit, such as 1000 for kN.
    size: f64,
    decimals: usize,
    /// The symbol of the unit, such as `kN`.
    name: String,
}

impl Column {
    /// Chooses the unit prefix (µ, m, k or M) of a column so that its largest number has one to three digits before the
    /// decimal point, if possible. A unit that the scene selects has no prefix.
    fn new(largest: f64, unit: Unit) -> Column {
        let largest = unit.value_from_si(largest);
        let digits = if largest > 0.0 && largest.is_finite() { libm::floor(libm::log10(largest)) as i32 } else { 0 };
        let step = if unit.is_chosen { 0 } else { digits.div_euclid(3).clamp(-2, 2) };
        let before = digits - 3 * step + 1;
        let prefix = ["µ", "m", "", "k", "M"][(step + 2) as usize];
        Column {
            size: unit.size * libm::pow(10.0, f64::from(3 * step)),
            decimals: (DIGITS - before).clamp(0, 12) as usize,
            name: format!("{prefix}{}", unit.symbol()),
        }
    }

    fn write(&self, value: f64) -> String {
        let number = format!("{:.*}", self.decimals, value / self.size);
        match number.strip_prefix('-') {
            Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
            Some(rest) => format!("−{rest}"),
            None => number,
        }
    }
}

impl Table {
    /// Creates the table of these forces. Moments are about `centroid`. `size` is the size of the block in metres. A
    /// moment that is tiny compared with the largest force times this size counts as 0.
    pub(super) fn new(forces: &[Force], centroid: Point, size: f64, units: UnitsEntry) -> Table {
        let most = forces.iter().map(|f| f.force.norm()).fold(0.0, f64::max);
        let moment = |f: &Force| {
            let moment = f.moment(centroid);
            if moment.abs() <= MOMENT_TOL * most * size { 0.0 } else { moment }
        };
        let turns = forces.iter().map(|f| moment(f).abs()).fold(0.0, f64::max);
        let force_unit = Column::new(most, units.force());
        let moment_unit = Column::new(turns, units.torque());
        let row = |force: &Force| Row {
            symbol: Some(force.symbol.clone()),
            numbers: [
                force_unit.write(force.force.norm()),
                force_unit.write(force.force.x),
                force_unit.write(force.force.y),
                moment_unit.write(moment(force)),
            ],
            from: force.from.clone(),
        };
        let mut rows: Vec<Row> = forces.iter().map(row).collect();
        let sum: Vector = forces.iter().map(|f| f.force).sum();
        let turning: f64 = forces.iter().map(|f| f.moment(centroid)).sum();
        rows.push(Row {
            symbol: None,
            numbers: [String::new(), force_unit.write(sum.x), force_unit.write(sum.y), moment_unit.write(turning)],
            from: String::new(),
        });
        let head = |letter: &str, below: &str, unit: &Column| {
            let symbol = Symbol::new(letter, Accent::None, below);
            (symbol, unit.name.clone())
        };
        Table {
            rows,
            heads: vec![
                head("F", "", &force_unit),
                head("F", "x", &force_unit),
                head("F", "y", &force_unit),
                head("M", "c", &moment_unit),
            ],
        }
    }

    /// Returns each row of the table as text, such as `F_1 = 6 N: (0; 6) N, moment 0 N·m, ground`.
    pub(super) fn stated(&self) -> Vec<String> {
        let (force, moment) = (&self.heads[0].1, &self.heads[3].1);
        let row = |row: &Row| {
            let [amount, x, y, turning] = &row.numbers;
            let parts = format!("({x}; {y}) {force}, moment {turning} {moment}");
            match &row.symbol {
                Some(symbol) => format!("{} = {amount} {force}: {parts}, {}", symbol.stated(), row.from),
                None => format!("sum: {parts}"),
            }
        };
        self.rows.iter().map(row).collect()
    }

    /// Draws the table, at most `room` pixels wide, with the font size `size` in pixels. The middle of its upper edge
    /// is at `top`. Also returns the height of the table in pixels.
    pub(super) fn draw(&self, top: PagePoint, room: f64, size: f64, theme: &Theme) -> (Group, f64) {
        let writer = TableWriter { table: self, columns: Columns::new(self, top.x, room, size), size, theme };
        let mut group = Group::with_class("list").titled("The forces on the block, and their sum");
        let mut y = top.y + size;
        group.items.extend(writer.head(y));
        y += 1.3 * size + 0.55 * size;
        group.items.push(writer.rule(y));
        y += 1.25 * size;
        for row in &self.rows {
            let (items, lines) = writer.row(row, y);
            group.items.extend(items);
            for _ in 1..lines {
                y += LINE_PITCH * size;
            }
            y += ROW_HEIGHT * size;
        }
        // `y` is the baseline that a further row would have. Subtract most of the height of this row, so that only half
        // a row of space remains below the table.
        (group, y - top.y - 0.9 * size)
    }
}

/// The positions of the columns on the page, pixels.
struct Columns {
    /// The left edge of the first column, with the names of the forces.
    left: f64,
    /// The right edges of the columns of numbers.
    numbers: Vec<f64>,
    /// The left edge of the last column, with the origins of the forces.
    from: f64,
    /// The width of the last column.
    from_width: f64,
    /// The width of the table.
    total: f64,
}

impl Columns {
    /// Computes the positions of the columns. Each column is as wide as its widest entry. If the table would be wider
    /// than `room`, the last column is narrower. The table is centred at the x coordinate `middle`. All lengths are in
    /// pixels.
    fn new(table: &Table, middle: f64, room: f64, size: f64) -> Columns {
        let wide = |words: &str| text::width(words, Face::Serif, size);
        let named = |symbol: &Symbol| symbol.size(size).0;
        let names = table.rows.iter().filter_map(|r| r.symbol.as_ref());
        let names = names.map(named).fold(wide("sum"), f64::max);
        let widths: Vec<f64> = (0..4)
            .map(|k| {
                let (symbol, unit) = &table.heads[k];
                let numbers = table.rows.iter().map(|r| wide(&r.numbers[k]));
                numbers.fold(named(symbol).max(wide(unit)), f64::max)
            })
            .collect();
        let numbers = names + widths.iter().map(|c| c + COLUMN_GAP).sum::<f64>();
        let left_over = (room - numbers - COLUMN_GAP).max(0.0);
        let froms = table.rows.iter().map(|r| wide(&r.from));
        let from_width = froms.fold(wide("from"), f64::max).min(left_over);
        let total = numbers + COLUMN_GAP + from_width;
        let left = middle - total / 2.0;
        let mut edge = left + names;
        let edges = widths.iter().map(|width| {
            edge += COLUMN_GAP + width;
            edge
        });
        Columns { left, numbers: edges.collect(), from: edge + COLUMN_GAP, from_width, total }
    }
}

/// Writes the rows of a table. The argument `y` of a method is a y coordinate on the page, pixels.
struct TableWriter<'a> {
    table: &'a Table,
    columns: Columns,
    /// Font size, pixels.
    size: f64,
    theme: &'a Theme,
}

impl TableWriter<'_> {
    /// Writes the headings of the columns, with the units below them. `y` is the baseline of the headings.
    fn head(&self, y: f64) -> Vec<Item> {
        let mut items = Vec::new();
        for ((head, unit), x) in self.table.heads.iter().zip(&self.columns.numbers) {
            items.push(self.symbol(head, x - head.size(self.size).0, y));
            items.push(self.words(*x, y + 1.3 * self.size, unit, Anchor::End));
        }
        items.push(self.words(self.columns.from, y, "from", Anchor::Start));
        items
    }

    /// Writes a row of the table at the baseline `y`. The row of the sum has a line above it. Also returns the number
    /// of text lines in the last column of the row, at least 1.
    fn row(&self, row: &Row, y: f64) -> (Vec<Item>, usize) {
        let columns = &self.columns;
        let mut items = Vec::new();
        match &row.symbol {
            Some(name) => items.push(self.symbol(name, columns.left, y)),
            None => {
                items.push(self.rule(y - 1.15 * self.size));
                items.push(self.words(columns.left, y, "sum", Anchor::Start));
            }
        }
        for (number, x) in row.numbers.iter().zip(&columns.numbers) {
            if !number.is_empty() {
                items.push(self.words(*x, y, number, Anchor::End));
            }
        }
        if row.from.is_empty() || columns.from_width <= 0.0 {
            return (items, 1);
        }
        let lines = in_lines(&row.from, columns.from_width + 0.5, self.size);
        let mut y = y;
        for (number, line) in lines.iter().enumerate() {
            y += if number > 0 { LINE_PITCH * self.size } else { 0.0 };
            items.push(self.words(columns.from, y, line, Anchor::Start));
        }
        (items, lines.len().max(1))
    }

    fn words(&self, x: f64, y: f64, words: &str, anchor: Anchor) -> Item {
        let at = PagePoint::new(x, y);
        Text::new(at, words, Face::Serif, self.size, self.theme.ink).anchored(anchor).into()
    }

    fn symbol(&self, symbol: &Symbol, x: f64, y: f64) -> Item {
        let (width, height) = symbol.size(self.size);
        let at = PagePoint::new(x, y - 0.98 * self.size);
        let rect = PageRect { at, width, height };
        symbol.draw(rect, self.size, self.theme.ink).into()
    }

    /// Draws a horizontal line across the table at the height `y`.
    fn rule(&self, y: f64) -> Item {
        let (left, right) = (self.columns.left, self.columns.left + self.columns.total);
        let line = Outline::line([PagePoint::new(left, y), PagePoint::new(right, y)]);
        Path::stroked(line, Stroke::new(self.theme.rule, 1.0)).into()
    }
}

/// Breaks a name into lines of at most `room` pixels. If the name needs more than [`MAX_NAME_LINES`] lines, it is
/// shortened.
fn in_lines(name: &str, room: f64, size: f64) -> Vec<String> {
    if text::width(name, Face::Serif, size) <= room {
        return vec![name.to_owned()];
    }
    let words = name.replace(text::NO_BREAK, " ");
    let lines = text::wrap(&words, Face::Serif, size, room);
    text::cut(lines, MAX_NAME_LINES, Face::Serif, size, room)
}
