//! [`Table`]: the list of the forces on a block, with magnitudes, components and moments, and their sum.
//!
//! All forces have the same unit and the same number of decimals, and so have all moments. So the columns can be added
//! up. The last row is their sum, which is zero in equilibrium, except for rounding.

use super::force::Force;
use crate::drawing::symbol::{Accent, Symbol};
use crate::drawing::{
    Anchor, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme, text,
};
use crate::geometry::{Point, Vector};

/// Space between columns, pixels.
const BETWEEN: f64 = 14.0;
/// Height of a row, as a multiple of the font size.
const ROW: f64 = 1.6;
/// Largest number of lines of a name that is too long for its column …
const MOST_LINES: usize = 4;
/// … and the distance of its lines, as a multiple of the font size.
const PITCH: f64 = 1.15;
/// Significant digits of the largest amount of a column.
const DIGITS: i32 = 4;
/// Moments below this share of the largest force times the block's size count as zero.
const NOISE: f64 = 1e-9;

/// The forces on a block, row by row.
pub(super) struct Table {
    rows: Vec<Row>,
    /// The headings of the columns of numbers: symbol and unit.
    heads: Vec<(Symbol, &'static str)>,
}

struct Row {
    symbol: Option<Symbol>,
    /// Magnitude, components, moment about the centroid; the magnitude is empty for a sum.
    numbers: [String; 4],
    from: String,
}

/// A unit: its name, its value in the base unit as a power of ten, and the number of decimals.
#[derive(Clone, Copy)]
struct Unit {
    power: i32,
    decimals: usize,
    name: &'static str,
}

impl Unit {
    /// Returns the unit in which the largest number of a column has one to three digits before the decimal point, as
    /// far as `names` allow it. `names` are the units from 10⁻⁶ to 10⁶ in steps of 1000.
    fn new(largest: f64, names: [&'static str; 5]) -> Unit {
        let digits = if largest > 0.0 && largest.is_finite() {
            libm::floor(libm::log10(largest)) as i32
        } else {
            0
        };
        let step = digits.div_euclid(3).clamp(-2, 2);
        let before = digits - 3 * step + 1;
        Unit {
            power: 3 * step,
            decimals: (DIGITS - before).clamp(0, 12) as usize,
            name: names[(step + 2) as usize],
        }
    }

    fn write(self, value: f64) -> String {
        let number = format!(
            "{:.*}",
            self.decimals,
            value / libm::pow(10.0, f64::from(self.power))
        );
        match number.strip_prefix('-') {
            Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
            Some(rest) => format!("−{rest}"),
            None => number,
        }
    }
}

impl Table {
    /// Creates the list of these forces. Moments are about `centroid`; `size` is the size of the block in metres.
    pub(super) fn new(forces: &[Force], centroid: Point, size: f64) -> Table {
        let most = forces.iter().map(|f| f.force.norm()).fold(0.0, f64::max);
        let moment = |f: &Force| {
            let moment = f.moment(centroid);
            if moment.abs() <= NOISE * most * size {
                0.0
            } else {
                moment
            }
        };
        let turns = forces.iter().map(|f| moment(f).abs()).fold(0.0, f64::max);
        let force_unit = Unit::new(most, ["µN", "mN", "N", "kN", "MN"]);
        let moment_unit = Unit::new(turns, ["µN·m", "mN·m", "N·m", "kN·m", "MN·m"]);
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
            numbers: [
                String::new(),
                force_unit.write(sum.x),
                force_unit.write(sum.y),
                moment_unit.write(turning),
            ],
            from: String::new(),
        });
        let head = |letter: &str, below: &str, unit: Unit| {
            (Symbol::new(letter, Accent::None, below), unit.name)
        };
        Table {
            rows,
            heads: vec![
                head("F", "", force_unit),
                head("F", "x", force_unit),
                head("F", "y", force_unit),
                head("M", "c", moment_unit),
            ],
        }
    }

    /// Returns a sentence for each row.
    pub(super) fn stated(&self) -> Vec<String> {
        let (force, moment) = (self.heads[0].1, self.heads[3].1);
        let row = |row: &Row| {
            let [amount, x, y, turning] = &row.numbers;
            let parts = format!("({x}; {y}) {force}, moment {turning} {moment}");
            match &row.symbol {
                Some(symbol) => format!(
                    "{} = {amount} {force}: {parts}, {}",
                    symbol.stated(),
                    row.from
                ),
                None => format!("sum: {parts}"),
            }
        };
        self.rows.iter().map(row).collect()
    }

    /// Draws the table with its upper edge at `top`, centred at `middle`, at most `room` pixels wide, with the font
    /// size `size`. Also returns its height. All numbers are in pixels.
    pub(super) fn draw(
        &self,
        middle: f64,
        top: f64,
        room: f64,
        size: f64,
        theme: &Theme,
    ) -> (Group, f64) {
        let wide = |words: &str| text::width(words, Face::Serif, size);
        let named = |symbol: &Symbol| symbol.size(size).0;
        let first = self.rows.iter().filter_map(|r| r.symbol.as_ref());
        let first = first.map(named).fold(wide("sum"), f64::max);
        let columns: Vec<f64> = (0..4)
            .map(|k| {
                let (symbol, unit) = &self.heads[k];
                let numbers = self.rows.iter().map(|r| wide(&r.numbers[k]));
                numbers.fold(named(symbol).max(wide(unit)), f64::max)
            })
            .collect();
        let numbers = first + columns.iter().map(|c| c + BETWEEN).sum::<f64>();
        let left_over = (room - numbers - BETWEEN).max(0.0);
        let froms = self.rows.iter().map(|r| wide(&r.from));
        let from = froms.fold(wide("from"), f64::max).min(left_over);
        let total = numbers + BETWEEN + from;
        let left = middle - total / 2.0;
        let mut group = Group::with_class("list").titled("The forces on the block, and their sum");
        let words = |x: f64, y: f64, words: &str, anchor: Anchor| -> Item {
            Text::new(PagePoint::new(x, y), words, Face::Serif, size, theme.ink)
                .anchored(anchor)
                .into()
        };
        let symbol = |symbol: &Symbol, x: f64, y: f64| -> Item {
            let (width, height) = symbol.size(size);
            let at = PagePoint::new(x, y - 0.98 * size);
            symbol
                .draw(PageRect { at, width, height }, size, theme.ink)
                .into()
        };
        // The right edges of the columns of numbers, followed by the left edge of the last column.
        let mut edge = left + first;
        let edges: Vec<f64> = columns
            .iter()
            .map(|c| {
                edge += BETWEEN + c;
                edge
            })
            .collect();
        let last = edge + BETWEEN;
        let mut y = top + size;
        for ((head, unit), x) in self.heads.iter().zip(&edges) {
            group.items.push(symbol(head, x - named(head), y));
            group
                .items
                .push(words(*x, y + 1.3 * size, unit, Anchor::End));
        }
        group.items.push(words(last, y, "from", Anchor::Start));
        y += 1.3 * size + 0.55 * size;
        let rule = |y: f64| -> Item {
            let line = Outline::line([PagePoint::new(left, y), PagePoint::new(left + total, y)]);
            Path::stroked(line, Stroke::new(theme.rule, 1.0)).into()
        };
        group.items.push(rule(y));
        y += 1.25 * size;
        for row in &self.rows {
            match &row.symbol {
                Some(name) => group.items.push(symbol(name, left, y)),
                None => {
                    group.items.push(rule(y - 1.15 * size));
                    group.items.push(words(left, y, "sum", Anchor::Start));
                }
            }
            for (number, x) in row.numbers.iter().zip(&edges) {
                if !number.is_empty() {
                    group.items.push(words(*x, y, number, Anchor::End));
                }
            }
            if !row.from.is_empty() && from > 0.0 {
                for (number, line) in in_lines(&row.from, from + 0.5, size).iter().enumerate() {
                    y += if number > 0 { PITCH * size } else { 0.0 };
                    group.items.push(words(last, y, line, Anchor::Start));
                }
            }
            y += ROW * size;
        }
        // Leave half a row of space below.
        (group, y - top - 0.9 * size)
    }
}

/// Breaks a name into lines for its column, between words or between code points. A name with too many lines is
/// shortened.
fn in_lines(name: &str, room: f64, size: f64) -> Vec<String> {
    if text::width(name, Face::Serif, size) <= room {
        return vec![name.to_owned()];
    }
    let words = name.replace(text::NO_BREAK, " ");
    let lines = text::wrap(&words, Face::Serif, size, room);
    text::cut(lines, MOST_LINES, Face::Serif, size, room)
}
