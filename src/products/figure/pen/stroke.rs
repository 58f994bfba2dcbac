//! Draws the arrows of a frame, and dots for forces that are too small for an arrow.

use core::f64::consts::{FRAC_PI_2, PI};

use super::{CENTROID_RADIUS, MIN_READABLE_UNIT_LENGTH, MISSING_RADIUS, Pen};
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::arrow::{straight, turning};
use crate::pictures::drawing::{Colour, Group, Item, Outline, Path, Stroke};
use crate::products::figure::arrow::{
    ArrowKind, ForceArrow, MIN_VISIBLE_ARROW, TurnArrow, TurnKind, distance_to_arrow,
};
use crate::products::figure::description;

/// Radius of the arrow of a torque in unit lengths, larger than a robot's disc. If several torques act at one point, each
/// further arrow has a radius that is larger by the second number.
const TURN_RADII: (f64, f64) = (0.46, 0.28);
/// Angle of the arrow of a torque, radians (225°). All have the same, and their amounts beside them: an arc to scale
/// would be a triangle without direction for a small torque, and several turns for a large one.
pub(crate) const SWEEP: f64 = 1.25 * PI;

impl Pen<'_> {
    /// True if an arrow is long enough to be visible. Loads are always drawn.
    pub(crate) fn seen(&self, arrow: &ForceArrow) -> bool {
        self.camera.length(arrow.reach().norm()) >= MIN_VISIBLE_ARROW || arrow.kind == ArrowKind::Load
    }

    /// Returns the missing forces whose arrows are too small to be visible. Each of them is drawn as a dot at the point
    /// where it acts; two opposite forces have only one dot.
    pub(crate) fn dots(&self) -> impl Iterator<Item = &ForceArrow> {
        let marks = &self.context.marks[self.number];
        marks.arrows.iter().filter(|a| description::dotted(a, self.seen(a)))
    }

    fn dot(&self, arrow: &ForceArrow) -> Group {
        let outline = Outline::circle(self.camera.place(arrow.at), MISSING_RADIUS);
        let dot = Path::filled(outline, arrow.colour).cased(self.context.options.theme.casing, 0.6);
        Group::with_class("small")
            .titled(description::arrow(&self.context.analysis.scene, self.context.unit, arrow))
            .with(dot)
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

    pub(crate) fn turn(&self, turn: &TurnArrow) -> Path {
        let sweep = SWEEP.copysign(turn.torque);
        let outline = turning(
            self.camera.place(turn.at),
            self.camera.length(self.turn_radius(turn)),
            self.turn_middle(turn) - sweep / 2.0,
            sweep,
            self.camera.length(turn.width),
        );
        Path::filled(outline, turn.colour).cased(self.context.options.theme.casing, self.casing)
    }

    /// Returns the radius of the arrow of a torque, metres. `turn` is one of the arrows of this frame.
    pub(crate) fn turn_radius(&self, turn: &TurnArrow) -> f64 {
        let (first, step) = TURN_RADII;
        let earlier = self.context.marks[self.number].turns.iter().take_while(|other| !core::ptr::eq(*other, turn));
        let here = earlier.filter(|other| (other.at - turn.at).norm() < 1e-6 * self.context.unit).count();
        (first + step * here as f64) * self.context.unit
    }

    /// Returns the direction from the centre of a torque's arrow to the middle of its arc, radians. Of twelve
    /// directions, this is the one in which the arrow is farthest from straight arrows. If several directions are about
    /// equally good, the result is the one nearest to upwards.
    pub(crate) fn turn_middle(&self, turn: &TurnArrow) -> f64 {
        let arrows = &self.context.marks[self.number].arrows;
        let radius = self.turn_radius(turn);
        let from_arrows = |p: Point| arrows.iter().map(|a| distance_to_arrow(a, p)).fold(f64::INFINITY, f64::min);
        let clear = |middle: f64| along_arc(turn, radius, middle).map(from_arrows).fold(f64::INFINITY, f64::min);
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
            let title = description::arrow(&self.context.analysis.scene, self.context.unit, arrow);
            let mut force = Group::with_class("force").titled(title).with(self.arrow(arrow));
            force.items.extend(self.centroid(arrow).map(Item::from));
            group.items.push(force.into());
        }
        let small = self.dots().filter(|a| a.kind.is_failure() == missing);
        group.items.extend(small.map(|a| self.dot(a).into()));
        for turn in marks.turns.iter().filter(|t| matches!(t.kind, TurnKind::Missing(_)) == missing) {
            let title = description::turn(self.context, turn);
            group.items.push(Group::with_class("torque").titled(title).with(self.turn(turn)).into());
        }
        group
    }
}

/// Returns nine points along the arc of a torque's arrow, metres. `middle` is in radians.
fn along_arc(turn: &TurnArrow, radius: f64, middle: f64) -> impl Iterator<Item = Point> {
    let (centre, sweep) = (turn.at, SWEEP.copysign(turn.torque));
    let at = move |i: i32| {
        let angle = middle + sweep * (f64::from(i) / 8.0 - 0.5);
        centre + Vector::new(libm::cos(angle), libm::sin(angle)) * radius
    };
    (0..9).map(at)
}
