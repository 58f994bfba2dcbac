//! Describes the sensitivity of a margin: which small changes of the scene change the margin most.

use super::failure::{named, pair};
use super::margin;
use super::number::{amount, counted, digits, round_below_in};
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{
    CornerMoves, EndSensitivity, FALLS, FrameAnalysis, MarginKind, NoSensitivity, STANDS, Sensitivity, Slope,
    SolvedFrame,
};
use crate::mechanics::scene::{BlockId, BodyId, Scene};

/// The largest distance by which a corner or a load is moved, as a fraction of the median length of the interfaces.
const LENGTH_STEP_SHARE: f64 = 1.0 / 50.0;
/// The change of a weight, as a fraction of this weight.
const WEIGHT_STEP_SHARE: f64 = 0.1;
/// The change of a friction coefficient.
pub const FRICTION_STEP: f64 = 0.05;
/// Changes whose effect is at most this fraction of the value of the margin are not listed.
const EFFECT_TOL: f64 = 1e-6;

/// The quantity that is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A corner, by its index in [`EndSensitivity::corners`], along a unit vector.
    Corner(usize, Vector),
    /// The weight of a block; true if it becomes heavier.
    Weight(BlockId, bool),
    /// The friction of an interface, by its index.
    Friction(usize),
    /// The friction of all interfaces.
    AllFriction,
    /// The point of a load, by its index in the scene, along a unit vector.
    Load(Point, Vector),
}

/// A change that makes the structure stronger, and its effect.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectiveChange {
    /// The quantity that is changed.
    pub target: Target,
    /// The change in words, with its size: `moving corner 3 of block v4 by 10 mm up`.
    pub words: String,
    /// The size of the change: in metres, in newtons, or as a difference of friction coefficients.
    pub amount: f64,
    /// The value of the margin after the change, to first order.
    pub after: f64,
}

/// Returns the changes that enlarge the interval of a margin at one end, at most `most` of them, the most effective
/// first. `is_high` is true if `end` is the upper end.
pub fn most_effective(
    solved: SolvedFrame<'_>,
    end: &EndSensitivity,
    is_high: bool,
    most: usize,
) -> Vec<EffectiveChange> {
    let outward = if is_high { 1.0 } else { -1.0 };
    let mut list = corners(solved, end, outward);
    list.extend(others(solved, end, outward));
    let effect = |change: &EffectiveChange| (change.after - end.value) * outward;
    list.retain(|change| effect(change) > EFFECT_TOL * end.value.abs());
    list.sort_by(|a, b| effect(b).total_cmp(&effect(a)));
    list.truncate(most);
    list
}

/// Returns the length, in metres, by which a described change moves a corner or a load. In the length unit of the
/// scene, this length is 1, 2 or 5 times a power of ten.
pub fn step_length(solved: SolvedFrame<'_>) -> f64 {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    round_below_in(LENGTH_STEP_SHARE * frame_analysis.length * (1.0 + 1e-9), scene.units.length())
}

/// Writes a length in the unit of the scene. If the scene gives no unit, writes a length below 1 m in millimetres,
/// and any other length in metres.
pub fn length(scene: &Scene, metres: f64) -> String {
    let unit = scene.units.length();
    if unit.is_chosen {
        return amount(metres, unit);
    }
    if metres < 1.0 { format!("{} mm", digits(1e3 * metres)) } else { format!("{} m", digits(metres)) }
}

/// Like [`most_effective`], but leaves out changes that do not alter the written value of the margin.
pub fn visible(
    solved: SolvedFrame<'_>,
    (kind, end, is_high): (MarginKind, &EndSensitivity, bool),
    most: usize,
) -> Vec<EffectiveChange> {
    let before = value(kind, end.value, is_high);
    let mut changes = most_effective(solved, end, is_high, most);
    changes.retain(|change| value(kind, change.after, is_high) != before);
    changes
}

/// Returns the best move of each corner. Each entry has the index of the corner in [`EndSensitivity::corners`], the
/// unit vector along which the interval grows most, and the growth per metre. The move is `None` if no known derivative
/// enlarges the interval. Of corners that move together and lie at the same point, only the first is listed.
/// `outward` is 1 for the upper end and −1 for the lower end.
pub fn corner_moves(
    frame_analysis: &FrameAnalysis,
    end: &EndSensitivity,
    outward: f64,
) -> Vec<(usize, Option<(Vector, f64)>)> {
    let mut list: Vec<(usize, Option<(Vector, f64)>)> = Vec::new();
    for (number, corner) in end.corners.iter().enumerate() {
        let is_here = |other: usize| (end.corners[other].at - corner.at).norm() < 1e-6 * frame_analysis.length;
        if !corner.with.is_empty() && list.iter().any(|known| is_here(known.0)) {
            continue;
        }
        let best = match corner.moves {
            CornerMoves::Freely(slopes) => best_direction(slopes, outward),
            CornerMoves::Along { direction, slope } => {
                best_side(slope, outward).map(|(side, rate)| (direction * side, rate))
            }
            _ => None,
        };
        list.push((number, best));
    }
    list
}

/// Returns the best move of each corner as a change that is described in words. Of corners that move together and lie
/// at the same point, only the first is listed.
fn corners(solved: SolvedFrame<'_>, end: &EndSensitivity, outward: f64) -> Vec<EffectiveChange> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let step = step_length(solved);
    let mut list = Vec::new();
    for (number, best) in corner_moves(frame_analysis, end, outward) {
        let corner = &end.corners[number];
        let Some((direction, rate)) = best else {
            continue;
        };
        let with: Vec<String> = corner.with.iter().map(|b| named(scene, *b)).collect();
        let with = if with.is_empty() { String::new() } else { format!(" with {}", super::number::listed(&with)) };
        list.push(EffectiveChange {
            target: Target::Corner(number, direction),
            words: format!(
                "moving corner {} of {}{with} by {} {}",
                corner.corner + 1,
                named(scene, BodyId::Block(corner.block)),
                length(scene, step),
                toward(direction)
            ),
            amount: step,
            after: end.value + outward * rate * step,
        });
    }
    list
}

/// Returns the changes of weights, friction coefficients and load positions that enlarge the interval.
fn others(solved: SolvedFrame<'_>, end: &EndSensitivity, outward: f64) -> Vec<EffectiveChange> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut list = Vec::new();
    let mut add = |target: Target, words: String, amount: f64, rate: f64| {
        list.push(EffectiveChange { target, words, amount, after: end.value + outward * rate * amount });
    };
    for (block, slope) in &end.weights {
        let amount = WEIGHT_STEP_SHARE * scene.blocks[block.0].weight;
        if let Some((side, rate)) = best_side(*slope, outward) {
            let name = named(scene, BodyId::Block(*block));
            let how = if side > 0.0 { "heavier" } else { "lighter" };
            let words = format!("making {name} 10 % {how}");
            add(Target::Weight(*block, side > 0.0), words, amount, rate);
        }
    }
    let friction_change = |slope: Slope, what: String, target: Target| {
        let (side, rate) = best_side(slope, outward)?;
        let how = if side > 0.0 { "raising" } else { "lowering" };
        let words = format!("{how} the friction {what} by {FRICTION_STEP}");
        Some((target, words, FRICTION_STEP, rate))
    };
    let all = end.friction.iter().filter_map(|(interface, slope)| {
        let bodies = frame_analysis.contacts.get(*interface)?.interface.bodies;
        let what = format!("between {}", pair(scene, bodies));
        friction_change(*slope, what, Target::Friction(*interface))
    });
    let whole =
        end.friction_of_all.and_then(|slope| friction_change(slope, "of every joint".into(), Target::AllFriction));
    for (target, words, amount, rate) in all.chain(whole) {
        add(target, words, amount, rate);
    }
    let step = step_length(solved);
    for load in &end.loads {
        if let Some((direction, rate)) = best_direction(load.slopes, outward) {
            let words = format!(
                "moving the load on {} by {} {}",
                named(scene, BodyId::Block(load.block)),
                length(scene, step),
                toward(direction)
            );
            add(Target::Load(load.at, direction), words, step, rate);
        }
    }
    list
}

/// Returns the direction in which a change of a quantity enlarges the interval: 1 for an increase, −1 for a decrease. The
/// second value is the growth of the interval per unit of the quantity. Returns `None` if the interval grows in neither
/// direction, or at a kink.
fn best_side(slope: Slope, outward: f64) -> Option<(f64, f64)> {
    let rate = outward * slope.unique()?;
    (rate != 0.0).then(|| (rate.signum(), rate.abs()))
}

/// Returns the unit vector along which a move enlarges the interval most, and the growth per metre. If a derivative
/// is not unique, the move is along the other axis. Returns `None` if no such move enlarges the interval.
pub fn best_direction(slopes: [Slope; 2], outward: f64) -> Option<(Vector, f64)> {
    let [x, y] = slopes.map(|slope| slope.unique().unwrap_or(0.0));
    let gradient = Vector::new(x, y) * outward;
    let size = gradient.norm();
    (size > 0.0).then(|| (gradient / size, size))
}

/// Describes a direction by the nearest of eight directions: `up and to the left`.
pub fn toward(direction: Vector) -> String {
    // The tangent of 22.5°, half the angle between two of the eight directions.
    const TAN_22_5: f64 = 0.414_213_562_373_095_1;
    let (x, y) = (direction.x.abs(), direction.y.abs());
    let upright = if direction.y > 0.0 { "up" } else { "down" };
    let side = if direction.x > 0.0 { "right" } else { "left" };
    if x < TAN_22_5 * y {
        upright.into()
    } else if y < TAN_22_5 * x {
        format!("to the {side}")
    } else {
        format!("{upright} and to the {side}")
    }
}

/// Returns the name of the quantity that a margin limits, such as `tilt`. Only the load factor has two names: `load
/// factor` for the upper end of the interval, and `least load factor` for the lower. [`end_name`] names the end itself.
pub fn name(kind: MarginKind, is_high: bool) -> &'static str {
    kind.about().limited[usize::from(is_high)]
}

/// Writes the value of an end of a margin as the margin itself does: rounded into the interval in which the frame stands.
pub fn value(kind: MarginKind, value: f64, is_high: bool) -> String {
    margin::end(kind, value, is_high)
}

/// Names an end of the interval of a margin: `upper` or `lower`, for tilts and horizontal loads `right` or `left`.
/// `right` is the upper end, because tilts and horizontal loads to the right are positive.
pub fn end_name(kind: MarginKind, is_high: bool) -> &'static str {
    let [low, high] = if kind.is_signed() { ["left", "right"] } else { ["lower", "upper"] };
    if is_high { high } else { low }
}

/// Returns lines of text that describe, for each end of a margin, the most effective changes.
pub fn lines(solved: SolvedFrame<'_>, sensitivity: &Sensitivity) -> Vec<String> {
    let kind = sensitivity.kind;
    let mut lines = Vec::new();
    if let Some(reason) = sensitivity.reason() {
        lines.push(without(kind, reason));
    }
    for (is_high, end) in sensitivity.ends() {
        let before = value(kind, end.value, is_high);
        let changes = visible(solved, (kind, end, is_high), 10);
        let name = name(kind, is_high);
        let stated = format!(
            "limit: {name} {before} ({} end of the interval in which the frame {STANDS})",
            end_name(kind, is_high)
        );
        lines.push(if changes.is_empty() {
            format!("{stated}: no single small change improves it visibly")
        } else {
            format!("{stated}; what changes it most, estimated from derivatives:")
        });
        for change in &changes {
            let after = value(kind, change.after, is_high);
            lines.push(format!("  {}: {name} {before} → about {after}", change.words));
        }
        let kinks = kinks(end);
        if kinks > 0 {
            lines.push(format!("  not listed: {}, because they jump at this value", counted(kinks, "derivative")));
        }
    }
    lines
}

/// Returns a phrase that explains why the sensitivity of a margin is not available.
pub fn without(kind: MarginKind, reason: NoSensitivity) -> String {
    let why = match reason {
        NoSensitivity::NotApplicable => {
            "there are no loads on placed blocks, or the scene lists its contacts".to_owned()
        }
        NoSensitivity::Empty => format!("the frame {FALLS} at every value"),
        NoSensitivity::Unbounded => format!("the frame {STANDS} at every larger value"),
        NoSensitivity::RangeEnds => format!("the frame {STANDS} up to the end of the possible range"),
        NoSensitivity::Unconfirmed => "its value is not confirmed by a verdict".to_owned(),
        _ => "the forces and the mechanism at its value could not be computed".to_owned(),
    };
    format!("no sensitivity of the {}: {why}", name(kind, true))
}

/// Returns the number of corners, weights, friction coefficients and loads for which the derivative jumps.
fn kinks(end: &EndSensitivity) -> usize {
    let is_kink = |slope: &Slope| slope.unique().is_none();
    let corners = end.corners.iter().filter(|corner| match corner.moves {
        CornerMoves::Freely(slopes) => slopes.iter().any(is_kink),
        CornerMoves::Along { slope, .. } => is_kink(&slope),
        _ => false,
    });
    let weights = end.weights.iter().filter(|(_, slope)| is_kink(slope));
    let friction = end.friction.iter().filter(|(_, slope)| is_kink(slope));
    let loads = end.loads.iter();
    let loads = loads.filter(|load| load.slopes.iter().any(is_kink));
    corners.count() + weights.count() + friction.count() + loads.count()
}

#[cfg(test)]
mod tests;
