//! [`values`]: what the named forces amount to in the balance shown, and where they act.

use super::super::words::quantity;
use super::around::distinct;
use super::force::{inward, named, weight};
use crate::analysis::{Analysis, Contact};
use crate::drawing::symbol::{Accent, Symbol};
use crate::drawing::text::NO_BREAK;
use crate::drawing::{Face, Item, PagePoint, PageRect, Text, Theme, text};
use crate::scene::BlockId;

/// Room between values in a row, pixels.
const BETWEEN: f64 = 26.0;

/// A part of a line: a symbol, or words.
#[derive(Clone)]
pub(super) enum Piece {
    Symbol(Symbol),
    Words(String),
    Gap,
}

impl Piece {
    fn width(&self, size: f64) -> f64 {
        match self {
            Piece::Symbol(symbol) => symbol.size(size).0,
            Piece::Words(words) => text::width(words, Face::Serif, size),
            Piece::Gap => BETWEEN,
        }
    }

    /// The piece with the left end of its base line at `at`; and how wide it is.
    pub(super) fn draw(&self, at: PagePoint, size: f64, theme: &Theme) -> (Vec<Item>, f64) {
        let items = match self {
            Piece::Symbol(symbol) => {
                let (width, height) = symbol.size(size);
                let rect = PageRect {
                    at: at.moved(0.0, -0.98 * size),
                    width,
                    height,
                };
                vec![symbol.draw(rect, size, theme.ink).into()]
            }
            Piece::Words(words) => {
                vec![Text::new(at, words.as_str(), Face::Serif, size, theme.ink).into()]
            }
            Piece::Gap => Vec::new(),
        };
        (items, self.width(size))
    }

    pub(super) fn said(&self) -> String {
        match self {
            Piece::Symbol(symbol) => symbol.said(),
            Piece::Words(words) => words.replace(NO_BREAK, " "),
            Piece::Gap => " ".to_owned(),
        }
    }
}

/// How wide a row is, pixels.
pub(super) fn width(row: &[Piece], size: f64) -> f64 {
    row.iter().map(|p| p.width(size)).sum()
}

/// Values in rows of at most `room` pixels.
pub(super) fn rows(values: &[Vec<Piece>], size: f64, room: f64) -> Vec<Vec<Piece>> {
    let mut rows: Vec<Vec<Piece>> = Vec::new();
    for value in values {
        match rows.last_mut() {
            Some(row) if width(row, size) + BETWEEN + width(value, size) <= room => {
                row.push(Piece::Gap);
                row.extend(value.iter().cloned());
            }
            _ => rows.push(value.clone()),
        }
    }
    rows
}

/// What everything amounts to. Only the sum of an interface's friction has a value; it is given to the side it acts to.
pub(super) fn values(
    analysis: &Analysis<'_>,
    frame: usize,
    block: BlockId,
    contacts: &[&Contact],
    places: bool,
) -> Vec<Vec<Piece>> {
    let (scene, found) = (analysis.scene, &analysis.frames[frame]);
    let is = |symbol: Symbol, words: String| {
        vec![
            Piece::Symbol(symbol),
            Piece::Words(format!("{NO_BREAK}={NO_BREAK}{words}")),
        ]
    };
    let body = &scene.blocks[block.0];
    let mut values = vec![is(weight(), quantity(body.weight, "N"))];
    for (number, contact) in contacts.iter().enumerate() {
        let points = distinct(contact).len();
        let named = |below: &str| named(below, number, contacts.len());
        let normal: f64 = contact.normal_forces.iter().sum();
        for k in 0..points {
            let amount = if points == 1 {
                normal
            } else {
                contact.normal_forces[k]
            };
            values.push(is(
                named(&format!("s{}", k + 1)),
                quantity(tidy(amount, found.weight), "N"),
            ));
        }
        let friction = tidy(contact.friction_force, found.weight);
        let side = if friction >= 0.0 { "l" } else { "r" };
        let mut sum = Vec::new();
        for k in 0..points {
            if k > 0 {
                sum.push(Piece::Words(format!("{NO_BREAK}+{NO_BREAK}")));
            }
            sum.push(Piece::Symbol(named(&format!("f{side}{}", k + 1))));
        }
        sum.push(Piece::Words(format!(
            "{NO_BREAK}={NO_BREAK}{}",
            quantity(friction.abs(), "N")
        )));
        values.push(sum);
    }
    for robot in found.robots.iter().filter(|r| r.block == block) {
        let id = &scene.robots[robot.robot.0].id;
        for (axis, amount) in [("x", robot.force.x), ("y", robot.force.y)] {
            let symbol = Symbol::new("F", Accent::Arrow, axis).raised(id);
            values.push(is(symbol, quantity(tidy(amount, found.weight), "N")));
        }
        if scene.robots[robot.robot.0].limits.torque > 0.0 {
            let symbol = Symbol::new("M", Accent::None, "").raised(id);
            values.push(is(symbol, quantity(robot.torque, "N·m")));
        }
    }
    if places {
        let at = |x: f64, y: f64| format!("({}; {}){NO_BREAK}m", coordinate(x), coordinate(y));
        let c = body.centroid;
        values.push(is(Symbol::new("c", Accent::None, ""), at(c.x, c.y)));
        for contact in contacts {
            for (k, p) in distinct(contact).into_iter().enumerate() {
                let symbol = Symbol::new("p", Accent::None, &(k + 1).to_string());
                values.push(is(symbol, at(p.x, p.y)));
            }
            let s = inward(contact, block);
            let words = format!("({}; {})", coordinate(s.x), coordinate(s.y));
            values.push(is(Symbol::new("s", Accent::Hat, ""), words));
        }
    }
    values
}

/// An amount without the noise of a solution: nothing where it is a billionth of the weight.
fn tidy(amount: f64, weight: f64) -> f64 {
    if amount.abs() <= 1e-9 * weight {
        0.0
    } else {
        amount
    }
}

/// A coordinate with three decimals at most.
fn coordinate(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" | "" => "0".to_owned(),
        text => text.replace('-', "−"),
    }
}
