//! The sensitivity of a margin, as written in JSON.
//!
//! A derivative that is unique is a number. At a kink it is `"at_kink"`.

use super::json::{Json, object};
use crate::mechanics::analysis::{
    CornerMoves, CornerSlope, EndSensitivity, NoSensitivity, Sensitivity, Slope, SolvedFrame,
};
use crate::mechanics::scene::{BodyId, Scene};

/// Returns the value of the key `sensitivity`.
pub(super) fn sensitivity<'a>(solved: SolvedFrame<'a>, found: &Sensitivity) -> Json<'a> {
    let absent = [("low", &found.low), ("high", &found.high)].into_iter();
    let absent = absent.filter_map(|(end, found)| Some(object! { end: end, reason: word(*found.as_ref().err()?) }));
    object! {
        parameter: found.kind.word(),
        ends: Json::list(found.ends().map(|(is_high, found)| end(solved, is_high, found))),
        without_value: Json::list(absent),
    }
}

fn end<'a>(solved: SolvedFrame<'a>, is_high: bool, found: &EndSensitivity) -> Json<'a> {
    let SolvedFrame { scene, found: frame, .. } = solved;
    let weights =
        (found.weights.iter()).map(|(block, slope)| object! { block: &scene.blocks[block.0].id }.and(one(*slope)));
    let friction = found.friction.iter().filter_map(|(interface, slope)| {
        let bodies = frame.contacts.get(*interface)?.interface.bodies.map(|body| name(scene, body));
        Some(object! { interface: *interface, bodies: bodies }.and(one(*slope)))
    });
    let loads = found.loads.iter().map(|load| {
        object! { load: load.entry, block: &scene.blocks[load.block.0].id, at: load.at }.and(two(load.slopes))
    });
    object! {
        end: if is_high { "high" } else { "low" },
        value: found.value,
        vertices: Json::list(found.corners.iter().map(|corner| vertex(scene, corner))),
        weights: Json::list(weights),
        friction: Json::list(friction),
        friction_of_all: found.friction_of_all.map(one),
        loads: Json::list(loads),
    }
}

fn vertex<'a>(scene: &'a Scene, found: &CornerSlope) -> Json<'a> {
    let (moves, along, slope) = match found.moves {
        CornerMoves::Freely(slopes) => ("freely", None, two(slopes)),
        CornerMoves::Along { direction, slope } => {
            ("along", Some(direction), derivative(slope.unique().map(|slope| direction * slope)))
        }
        _ => ("not", None, object! { unique: false, slope: Json::Null }),
    };
    object! {
        block: &scene.blocks[found.block.0].id,
        vertex: found.corner,
        at: found.at,
        with: Json::list(found.with.iter().map(|body| name(scene, *body))),
        moves: moves,
        along: along,
    }
    .and(slope)
}

/// Returns a derivative, or the derivatives along x and y.
fn derivative<'a, T: Into<Json<'a>>>(unique: Option<T>) -> Json<'a> {
    object! { unique: unique.is_some(), slope: unique.map_or(Json::from("at_kink"), T::into) }
}

fn one<'a>(slope: Slope) -> Json<'a> {
    derivative(slope.unique())
}

fn two<'a>([x, y]: [Slope; 2]) -> Json<'a> {
    derivative(x.unique().zip(y.unique()).map(|(x, y)| [x, y]))
}

fn name(scene: &Scene, body: BodyId) -> &str {
    match body {
        BodyId::Block(block) => &scene.blocks[block.0].id,
        BodyId::Ground(_) => "ground",
    }
}

fn word(reason: NoSensitivity) -> &'static str {
    match reason {
        NoSensitivity::NotApplicable => "not_applicable",
        NoSensitivity::Empty => "stands_at_no_value",
        NoSensitivity::Unbounded => "unbounded",
        NoSensitivity::RangeEnds => "range_ends",
        NoSensitivity::Unconfirmed => "unconfirmed",
        _ => "unsolved",
    }
}
