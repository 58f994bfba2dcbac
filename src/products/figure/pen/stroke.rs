//! Draws the arrows of a frame, and dots for forces that are too small for an arrow.

use core::f64::consts::FRAC_PI_2;

use super::{CENTROID_RADIUS, DOT_RADIUS, MIN_READABLE_UNIT_LENGTH, MISSING_RADIUS, Pen};
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::arrow::{HEAD_WIDTH, head, straight, turning};
use crate::pictures::drawing::{Colour, Group, Item, Outline, Path, Stroke};
use crate::products::figure::arrow::{
    ArrowKind, ForceArrow, MIN_VISIBLE_ARROW, TurnArrow, TurnKind, distance_to_arrow,
};
use crate::products::figure::by_colour::ByColour;
use crate::products::figure::description;

/// Radius of the arrow of a torque in unit lengths, larger than a robot's disc.
pub(crate) const TURN_RADIUS: f64 = 0.46;
/// Least angle of the arrow of a load's torque, radians.
const MIN_SWEEP: f64 = 1.2;

impl Pen<'_> {
    /// True if an arrow is long enough to be visible.
    pub(crate) fn seen(&self, arrow: &ForceArrow) -> bool {
        self.camera.length(arrow.reach().norm()) >= MIN_VISIBLE_ARROW
    }

    /// True if the arrow of a torque is long enough to be visible. Always true for torques of loads.
    pub(crate) fn turn_seen(&self, turn: &TurnArrow) -> bool {
        self.camera.length(turn.arc.abs()) >= MIN_VISIBLE_ARROW || turn.kind == TurnKind::Load
    }

    /// Returns the loads and missing forces whose arrows are too small to be visible. Each of them is drawn as a dot at
    /// the point where it acts; two opposite forces have only one dot.
    pub(crate) fn dots(&self) -> impl Iterator<Item = &ForceArrow> {
        let marks = &self.context.marks[self.number];
        marks.arrows.iter().filter(|a| description::dotted(a, self.seen(a)))
    }

    fn dot(&self, arrow: &ForceArrow) -> Group {
        let radius = if arrow.kind == ArrowKind::Load { DOT_RADIUS } else { MISSING_RADIUS };
        let outline = Outline::circle(self.camera.place(arrow.at), radius);
        let theme = &self.context.options.theme;
        let dot = if arrow.kind == ArrowKind::Load {
            Path::filled(outline, theme.page).with_stroke(Stroke::new(arrow.colour, 1.2))
        } else {
            Path::filled(outline, arrow.colour).cased(theme.casing, 0.6)
        };
        Group::with_class("small").titled(description::arrow(self.context, arrow)).with(dot)
    }

    fn arrow(&self, arrow: &ForceArrow) -> Path {
        let outline = straight(self.camera.place(arrow.at), self.camera.turn(arrow.reach()), self.width(arrow));
        if arrow.kind == ArrowKind::Load {
            // Arrows of loads are hollow, so that they differ from other arrows even in a grey print.
            let edge = Stroke::new(arrow.colour, (0.3 * self.width(arrow)).clamp(0.7, 2.0));
            return Path::filled(outline, self.context.options.theme.page).with_stroke(edge.mitred());
        }
        Path::filled(outline, arrow.colour).cased(self.seam_around(arrow), self.casing)
    }

    /// Returns the small circle at the tail of the arrow of a weight, which distinguishes a weight from other forces.
    /// Returns `None` for other forces, for small figures, and for figures in the style of the thesis.
    fn centroid(&self, arrow: &ForceArrow) -> Option<Path> {
        let marked = arrow.kind == ArrowKind::Weight
            && !self.context.options.printed()
            && self.unit() >= MIN_READABLE_UNIT_LENGTH;
        let width = self.width(arrow);
        let ring = Outline::circle(self.camera.place(arrow.at), CENTROID_RADIUS * width);
        let edge = Stroke::new(arrow.colour, (0.45 * width).clamp(0.8, 2.0));
        marked.then(|| Path::filled(ring, self.context.options.theme.page).with_stroke(edge))
    }

    /// Returns the colour of the border that separates an arrow from the block on which it acts.
    fn seam_around(&self, arrow: &ForceArrow) -> Colour {
        let theme = &self.context.options.theme;
        let frame = &self.context.analysis.scene.frames[self.number];
        let BodyId::Block(on) = arrow.on else {
            return theme.casing;
        };
        match self.places.get(on.0).copied().flatten() {
            Some(place) => theme.casing_on(self.fill(place, frame.placed[place]), arrow.colour),
            None => theme.casing,
        }
    }

    /// Draws the heads of arrows and the circles of weights again, on top of all shafts, because a shaft must not hide
    /// the head of another arrow on the same line. On top of them, draws whole arrows of loads again, because the
    /// circle of a weight must not hide a load at the same point. Missing forces are not drawn again.
    pub(crate) fn heads(&self) -> Group {
        let mut group = Group { echo: true, ..Group::with_class("heads") };
        let marks = &self.context.marks[self.number];
        let there = marks.arrows.iter().filter(|a| !a.kind.is_failure() && a.kind != ArrowKind::Load);
        for arrow in there.filter(|a| self.seen(a)) {
            let width = self.width(arrow);
            let (from, along) = (self.camera.place(arrow.at), self.camera.turn(arrow.reach()));
            let head = Path::filled(head(from, along, width), arrow.colour);
            group.items.push(head.cased(self.seam_around(arrow), self.casing).into());
            group.items.extend(self.centroid(arrow).map(Item::from));
        }
        let loads = marks.arrows.iter().filter(|a| a.kind == ArrowKind::Load);
        let loads = loads.filter(|a| self.seen(a));
        group.items.extend(loads.map(|a| self.arrow(a).into()));
        group
    }

    pub(crate) fn turn(&self, turn: &TurnArrow) -> Path {
        let radius = TURN_RADIUS * self.context.unit;
        let sweep = self.sweep(turn, radius);
        let outline = turning(
            self.camera.place(turn.at),
            self.camera.length(radius),
            self.turn_middle(turn) - sweep / 2.0,
            sweep,
            self.camera.length(turn.width),
        );
        Path::filled(outline, turn.colour).cased(self.context.options.theme.casing, self.casing)
    }

    /// Returns the angle of the arrow of a torque in radians, with the sign of the torque. `radius` is the radius of
    /// the arrow in metres. The arrow of a load has at least the angle [`MIN_SWEEP`], so that its direction is visible.
    fn sweep(&self, turn: &TurnArrow, radius: f64) -> f64 {
        let sweep = turn.arc / radius;
        if turn.kind != TurnKind::Load || turn.torque == 0.0 {
            return sweep;
        }
        sweep.abs().max(MIN_SWEEP).copysign(turn.torque)
    }

    /// Returns the direction from the centre of a torque's arrow to the middle of its arc, radians. In this direction,
    /// the arrow is far from straight arrows and from the arrows of earlier torques at the same point.
    pub(crate) fn turn_middle(&self, turn: &TurnArrow) -> f64 {
        let radius = TURN_RADIUS * self.context.unit;
        let turns = self.context.marks[self.number].turns.iter();
        let here = turns.filter(|other| (other.at - turn.at).norm() < 1e-6 * radius);
        let mut taken: Vec<(Point, f64)> = Vec::new();
        let mut middle = FRAC_PI_2;
        for other in here {
            let sweep = self.sweep(other, radius);
            middle = self.clearest(other, radius, sweep, &taken);
            if core::ptr::eq(other, turn) {
                break;
            }
            let arc = along_arc(other.at, radius, middle, sweep);
            taken.extend(arc.map(|p| (p, HEAD_WIDTH * other.width)));
        }
        middle
    }

    /// Returns the direction from the centre of a torque's arrow to the middle of its arc, radians. Of twelve
    /// directions, this is the one in which the arrow is farthest from straight arrows and from the points `taken`. If
    /// several directions are about equally good, the result is the one nearest to upwards.
    ///
    /// The points `taken` lie on the arrows of earlier torques, each with the free width that it needs, in metres.
    /// Without this width, two torques on one arc would look like one.
    fn clearest(&self, turn: &TurnArrow, radius: f64, sweep: f64, taken: &[(Point, f64)]) -> f64 {
        let arrows = &self.context.marks[self.number].arrows;
        let from_others = |p: Point| {
            let straight = arrows.iter().map(|a| distance_to_arrow(a, p));
            let round = taken.iter().map(|(at, wide)| (p - at).norm() - wide);
            straight.chain(round).fold(f64::INFINITY, f64::min)
        };
        let clear = |middle: f64| {
            let points = along_arc(turn.at, radius, middle, sweep);
            points.map(from_others).fold(f64::INFINITY, f64::min)
        };
        let mut best = (clear(FRAC_PI_2), FRAC_PI_2);
        for step in [1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6] {
            let middle = FRAC_PI_2 + f64::from(step) * FRAC_PI_2 / 3.0;
            let room = clear(middle);
            if room > best.0 + 0.02 * self.context.unit {
                best = (room, middle);
            }
        }
        best.1
    }

    /// Draws the arrows of forces and torques, and dots for small forces: only missing forces and torques if `missing`
    /// is true, otherwise all others. The tooltip of each arrow states its magnitude.
    pub(crate) fn arrows(&self, missing: bool) -> Group {
        let marks = &self.context.marks[self.number];
        let mut group = Group::with_class(if missing { "failures" } else { "forces" });
        for arrow in marks.arrows.iter().filter(|a| a.kind.is_failure() == missing && self.seen(a)) {
            let title = description::arrow(self.context, arrow);
            let mut force = Group::with_class("force").titled(title).with(self.arrow(arrow));
            force.items.extend(self.centroid(arrow).map(Item::from));
            group.items.push(force.into());
        }
        let small = self.dots().filter(|a| a.kind.is_failure() == missing);
        group.items.extend(small.map(|a| self.dot(a).into()));
        for turn in
            marks.turns.iter().filter(|t| matches!(t.kind, TurnKind::Missing(_)) == missing && self.turn_seen(t))
        {
            let title = description::turn(self.context, turn);
            group.items.push(Group::with_class("torque").titled(title).with(self.turn(turn)).into());
        }
        group
    }

    /// Draws only the arrows and dots of loads, for a figure whose other arrows would be too small.
    pub(crate) fn loads(&self) -> Group {
        let mut group = Group::with_class("forces");
        let loads = self.context.marks[self.number].arrows.iter();
        let loads = loads.filter(|a| a.kind == ArrowKind::Load);
        for arrow in loads.filter(|a| self.seen(a)) {
            let force = Group::with_class("force").titled(description::arrow(self.context, arrow));
            group.items.push(force.with(self.arrow(arrow)).into());
        }
        let small = self.dots().filter(|a| a.kind == ArrowKind::Load);
        group.items.extend(small.map(|a| self.dot(a).into()));
        group
    }

    /// Draws all visible straight arrows except those of missing forces, for frames with very many blocks. All arrows
    /// of one colour are one path.
    pub(crate) fn arrows_by_colour(&self) -> Group {
        let mut group = Group::with_class("forces");
        let mut colours = ByColour::default();
        for arrow in self.context.marks[self.number].arrows.iter().filter(|a| !a.kind.is_failure() && self.seen(a)) {
            colours.add(arrow.colour, self.arrow(arrow).outline);
        }
        group.items.extend(colours.paths(None));
        group
    }
}

/// Returns nine points along the arc of a torque's arrow, metres. `middle` and `sweep` are in radians.
fn along_arc(centre: Point, radius: f64, middle: f64, sweep: f64) -> impl Iterator<Item = Point> {
    let at = move |i: i32| {
        let angle = middle + sweep * (f64::from(i) / 8.0 - 0.5);
        centre + Vector::new(libm::cos(angle), libm::sin(angle)) * radius
    };
    (0..9).map(at)
}
