//! Adapts the arrows of loads to the arrows of other forces: their length, and the end that touches the point where the
//! load acts.

use super::arrow::{ArrowKind, ForceArrow, Marks};
use super::pen::CENTROID_RADIUS;
use crate::geometry::Point;

/// Distance of the tip of a load from the point where it acts, as a multiple of the radius of the circle of a weight. It
/// is above 1 because shafts and circles are drawn wider at small scales.
const TIP_DISTANCE: f64 = 1.35;

/// Makes the arrows of loads longer if the longest of them is shorter than `least` metres, so that their directions are
/// visible. The factor is the same for all frames in `marks`.
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

/// Moves each load that would begin at the centroid of a block, on the circle of the weight, along its line of action:
/// its tip then touches this circle. Loads and a weight that all begin at one point would hide each other.
pub(super) fn uncover_loads(marks: &mut Marks) {
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
