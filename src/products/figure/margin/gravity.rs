//! [`Gravity`]: the arrows to the left of the structure in a figure of a margin. A dashed line shows the present
//! direction of gravity. An arrow shows the turned gravity, or the additional horizontal load, at which the structure
//! begins to fall. A pale arrow shows the value at the other end of the interval.

use super::super::pen::Pen;
use super::super::words::degrees;
use super::reason::percent_of;
use crate::geometry::{Bounds, Point, Vector, quarter_turn, sin_cos_degrees};
use crate::mechanics::analysis::{Analysis, End, Toward};
use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Colour, Group, Item, Outline, PagePoint, Path, Stroke, Theme};

/// Length of an arrow that shows gravity, as a fraction of the diagonal of the structure.
const GRAVITY_LENGTH: f64 = 0.16;
/// Horizontal distance between the tail of the arrows and the structure, as a fraction of the structure's diagonal.
const GRAVITY_DISTANCE: f64 = 0.12;

/// The end points, in metres, of the arrows that show gravity or a horizontal load: the common tail `from`, the tip
/// `now` of the present gravity, and the tip `there` at the margin.
pub(super) struct Gravity {
    toward: Toward,
    /// The value of the parameter at the margin.
    edge: f64,
    from: Point,
    now: Point,
    there: Point,
    /// The tip at the other end of the interval; `None` if this end has no known value.
    other: Option<Point>,
}

impl Gravity {
    /// Computes the arrows to the left of the structure: gravity at present, and gravity or the horizontal load at the
    /// margin. The other end of the interval also has an arrow if its value is known. `edge` is the value of the
    /// parameter at the margin. Returns `None` for the load factor, and for a frame without blocks.
    pub fn new(analysis: &Analysis, frame: usize, edge: f64, toward: Toward) -> Option<Gravity> {
        let scene = &analysis.scene;
        let blocks = scene.frames[frame].placed.iter();
        let structure = blocks.map(|id| scene.blocks[id.0].body.polygon.bounds()).reduce(Bounds::union)?;
        let diagonal = structure.diagonal();
        let down = scene.down() * (GRAVITY_LENGTH * diagonal);
        let arrow = |edge: f64| match toward {
            Toward::Tilt => {
                let (sin, cos) = sin_cos_degrees(edge);
                let turned = Vector::new(cos * down.x - sin * down.y, sin * down.x + cos * down.y);
                Some(turned)
            }
            // The arrow of the horizontal load is `edge` times as long as the arrow of gravity.
            Toward::HorizontalLoad => Some(quarter_turn(down) * edge),
            Toward::LoadFactor => None,
        };
        let there = arrow(edge)?;
        let other = other_end(analysis, frame, edge, toward).and_then(arrow);
        // All arrows share one tail. If one of them extends far to the right, move the tail to the left by the same
        // distance, so that no arrow touches the structure.
        let beyond = other.map_or(there.x, |other| other.x.max(there.x));
        let beyond = down.x.max(beyond).max(0.0);
        let left = structure.min.x
            - GRAVITY_DISTANCE * diagonal
            - if beyond > 0.5 * GRAVITY_LENGTH * diagonal { beyond } else { 0.0 };
        let from = Point::new(left, structure.max.y);
        Some(Gravity {
            toward,
            edge,
            from,
            now: from + down,
            there: from + there,
            other: other.map(|other| from + other),
        })
    }

    /// Draws the arrows, and adds them to `ink`, so that labels do not cover them.
    pub fn draw(&self, pen: &Pen<'_>, ink: &mut Ink) -> Group {
        let (camera, theme) = (pen.camera, &pen.context.options.theme);
        let [from, now] = [self.from, self.now].map(|p| camera.place(p));
        let long = libm::hypot(now.x - from.x, now.y - from.y);
        let width = (0.04 * long).clamp(1.2, 3.0);
        let mut arrow = |tip: Point, width: f64, colour: Colour| {
            let tip = camera.place(tip);
            let along = (tip.x - from.x, tip.y - from.y);
            ink.arrow(from, along, width);
            Path::filled(straight(from, along, width), colour)
        };
        let there = arrow(self.there, width, theme.ink);
        let pale = theme.faint.mixed(theme.page, 0.4);
        let other = self.other.map(|tip| arrow(tip, 0.7 * width, pale));
        ink.line(from, now, 1.2);
        let dashed = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
        let present = Path::stroked(Outline::line([from, now]), dashed);
        let mut group = Group::with_class("gravity").titled(self.title()).with(present);
        if let Some(other) = other {
            group = group.with(other);
        }
        group.with(there)
    }

    /// Returns the tooltip of the arrows.
    fn title(&self) -> String {
        match self.toward {
            Toward::HorizontalLoad => {
                format!("In addition to gravity, a horizontal load of {} of each weight", percent_of(self.edge))
            }
            _ => format!("Gravity turned by {}", degrees(self.edge.abs())),
        }
    }

    /// Returns the common tail and the tips of the arrows, in metres.
    pub fn points(&self) -> impl Iterator<Item = Point> {
        [self.from, self.now, self.there].into_iter().chain(self.other)
    }
}

/// Returns the end of the interval whose sign is opposite to that of `edge`, in the unit of the parameter. Returns
/// `None` if there is no such end or its value is not known, and for the load factor.
fn other_end(analysis: &Analysis, frame: usize, edge: f64, toward: Toward) -> Option<f64> {
    let intervals = &analysis.frames[frame].margins.as_ref()?.intervals;
    let interval = match toward {
        Toward::Tilt => intervals.tilt.as_ref()?,
        Toward::HorizontalLoad => intervals.horizontal_load.as_ref()?,
        Toward::LoadFactor => return None,
    };
    let ends = [interval.low(), interval.high()].into_iter().flatten();
    let mut ends = ends.filter_map(End::value);
    ends.find(|other| *other != edge && other * edge <= 0.0)
}

/// Draws the symbol of turned gravity for the legend: a dashed line for the present direction, and an arrow.
pub(super) fn gravity_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    symbol(at.moved(8.0, -7.0), (8.0, 12.0), theme)
}

/// Draws the symbol of a horizontal load for the legend: a dashed line for gravity, and a horizontal arrow.
pub(super) fn push_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    symbol(at.moved(4.0, -7.0), (18.0, 0.0), theme)
}

/// Draws a dashed vertical line for the direction of gravity, and an arrow along `vector` for the turned gravity or the
/// horizontal load at the margin. Both begin at `from`. Lengths are in pixels.
fn symbol(from: PagePoint, vector: (f64, f64), theme: &Theme) -> Vec<Item> {
    let now = Outline::line([from, from.moved(0.0, 14.0)]);
    let dashed = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
    vec![Path::stroked(now, dashed).into(), Path::filled(straight(from, vector, 1.6), theme.ink).into()]
}
