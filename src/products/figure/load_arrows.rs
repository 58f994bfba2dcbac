//! Draws the loads of a frame as arrows, and changes these arrows so that a reader can see them next to other arrows:
//! makes short arrows longer, and moves arrows along their lines of action away from weights and missing forces.

use super::arrow::{ArrowKind, ForceArrow, Marks, TurnKind};
use super::mark;
use super::option::Options;
use super::pen::CENTROID_RADIUS;
use super::unit::{LOAD_SHAFT, longest_load, unit};
use crate::geometry::Point;
use crate::mechanics::analysis::Analysis;
use crate::pictures::drawing::arrow::HEAD_WIDTH;

/// Distance from the circle around the tail of a weight to the tip of a load that acts there. The distance is measured
/// from the centre of the circle, as a multiple of its radius. It is above 1 because small figures draw larger circles.
const TIP_DISTANCE: f64 = 1.35;

/// The number of sections of a load's arrow. [`covers`] measures the distance from other arrows at their ends.
const TESTED_POINTS: u32 = 24;

/// Returns only the arrows of the loads of a frame and of their torques. The tip of a straight arrow is at the point
/// where the load acts. The arrow of a load of `newtons_per_unit` newtons is one unit length long.
pub(super) fn load_marks(analysis: &Analysis, frame: usize, options: &Options, newtons_per_unit: f64) -> Marks {
    let marks = mark::marks(analysis, frame, options, newtons_per_unit);
    let loads = marks.arrows.into_iter();
    let loads = loads.filter(|arrow| arrow.kind == ArrowKind::Load);
    let width = LOAD_SHAFT * longest_load(&analysis.scene, options.zoom);
    let ended = loads.map(|arrow| ForceArrow { at: arrow.at - arrow.vector, width: arrow.width.max(width), ..arrow });
    let turns = marks.turns.into_iter();
    let turns = turns.filter(|turn| turn.kind == TurnKind::Load);
    let loads = Marks { arrows: ended.collect(), turns: turns.collect(), newtons_per_unit };
    // If there are no arrows, return no scale either, so that the legend shows none.
    if loads.arrows.is_empty() && loads.turns.is_empty() { Marks::default() } else { loads }
}

/// Returns the load, in newtons, whose arrow is one unit length long in a figure of loads alone. At this scale, the
/// arrow of the largest load of the frame has the length [`longest_load`]. Weights are not loads.
pub(super) fn load_scale(analysis: &Analysis, frame: usize, options: &Options) -> f64 {
    let scene = &analysis.scene;
    let placed = &scene.frames[frame].placed;
    let loads = scene.loads.iter().filter(|l| placed.contains(&l.block));
    let largest = loads.map(|l| l.force.norm()).fold(0.0, f64::max);
    largest * unit(scene, options.zoom) / longest_load(scene, options.zoom)
}

/// Makes the arrows of loads longer if the longest of them is shorter than `least` metres, so that their directions are
/// visible. All arrows of loads are multiplied by one factor. `marks` has one element for each frame.
pub(super) fn lengthen_loads(marks: &mut [Marks], least: f64) {
    let arrows = marks.iter_mut().flat_map(|marks| &mut marks.arrows);
    let loads = arrows.filter(|arrow| arrow.kind == ArrowKind::Load);
    let loads: Vec<&mut ForceArrow> = loads.collect();
    let longest = loads.iter().map(|a| a.vector.norm()).fold(0.0, f64::max);
    if longest > 0.0 && longest < least {
        for arrow in loads {
            arrow.vector *= least / longest;
        }
    }
}

/// Moves the arrow of each load that begins inside the circle at the tail of a weight. The arrow moves along its line
/// of action, so that its tip is just outside this circle. Otherwise loads and a weight that begin at the same point
/// would hide each other.
pub(super) fn uncover_from_weights(marks: &mut Marks) {
    let weights = marks.arrows.iter().filter(|a| a.kind == ArrowKind::Weight);
    let circle = |weight: &ForceArrow| (weight.at, CENTROID_RADIUS * weight.width);
    let circles: Vec<(Point, f64)> = weights.map(circle).collect();
    let loads = marks.arrows.iter_mut();
    for load in loads.filter(|arrow| arrow.kind == ArrowKind::Load) {
        let length = load.vector.norm();
        let hidden = |(at, radius): &&(Point, f64)| (load.at - at).norm() <= *radius;
        if let Some((_, radius)) = circles.iter().find(hidden)
            && length > 0.0
        {
            let along = load.vector / length;
            load.at -= along * (length + TIP_DISTANCE * radius);
        }
    }
}

/// Moves the arrows of all loads of a frame so that their tips, not their tails, are at the points where the loads act.
/// This is only done if missing forces then cover fewer arrows of loads. In both cases the arrows lie on the lines of
/// action of the loads.
pub(super) fn uncover_from_missing_forces(marks: &mut Marks) {
    let of = |missing: bool| {
        let arrows = marks.arrows.iter();
        let arrows = arrows.filter(move |arrow| match missing {
            true => arrow.kind.is_failure(),
            false => arrow.kind == ArrowKind::Load,
        });
        arrows.copied().collect::<Vec<ForceArrow>>()
    };
    let (missing, loads) = (of(true), of(false));
    let ended = loads.iter().map(|load| ForceArrow { at: load.at - load.vector, ..*load });
    let ended: Vec<ForceArrow> = ended.collect();
    let covered = |loads: &[ForceArrow]| {
        let is_covered = |load: &&ForceArrow| missing.iter().any(|other| covers(other, load));
        loads.iter().filter(is_covered).count()
    };
    if covered(&ended) < covered(&loads) {
        let arrows = marks.arrows.iter_mut();
        for arrow in arrows.filter(|arrow| arrow.kind == ArrowKind::Load) {
            arrow.at -= arrow.vector;
        }
    }
}

/// True if the arrow of a missing force touches the shaft of the arrow of a load.
fn covers(missing: &ForceArrow, load: &ForceArrow) -> bool {
    let reach = missing.reach();
    let least = 0.5 * (HEAD_WIDTH * missing.width + load.width);
    (0..=TESTED_POINTS).any(|number| {
        let at = load.at + load.vector * (f64::from(number) / f64::from(TESTED_POINTS));
        let share = (at - missing.at).dot(&reach) / reach.norm_squared().max(f64::MIN_POSITIVE);
        let nearest = missing.at + reach * share.clamp(0.0, 1.0);
        (at - nearest).norm() < least
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::mechanics::scene::{BlockId, BodyId};
    use crate::pictures::drawing::Colour;
    use crate::products::figure::Head;

    fn arrow(kind: ArrowKind, at: [f64; 2], vector: [f64; 2]) -> ForceArrow {
        ForceArrow {
            on: BodyId::Block(BlockId(0)),
            at: Point::new(at[0], at[1]),
            vector: Vector::new(vector[0], vector[1]),
            force: Vector::new(vector[0], vector[1]),
            colour: Colour::hex(0),
            width: 0.05,
            head: Head::Within,
            kind,
        }
    }

    #[test]
    fn a_load_that_a_missing_force_would_cover_ends_at_its_point() {
        let missing = ArrowKind::MissingPull(BodyId::Block(BlockId(1)));
        let load = arrow(ArrowKind::Load, [0.0, 0.0], [0.0, -1.0]);
        for (y, expected) in [(-0.5, 1.0), (0.5, 0.0), (-3.0, 0.0)] {
            let red = arrow(missing, [-0.5, y], [1.0, 0.0]);
            let mut marks = Marks { arrows: vec![load, red], ..Marks::default() };
            uncover_from_missing_forces(&mut marks);
            let [drawn, same] = marks.arrows[..] else { panic!("two arrows") };
            assert_eq!((drawn.at.x, drawn.at.y), (0.0, expected), "{y}");
            assert_eq!((drawn.vector, same), (load.vector, red), "{y}");
        }
    }
}
