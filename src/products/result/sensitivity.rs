//! The sensitivity of a margin, as written in JSON.
//!
//! A derivative that is unique is a number. At a kink it is `[backward, forward]` if both were computed, otherwise
//! `"at_kink"`.

use serde::Serialize;

use super::{Number, Pair, arrow, place};
use crate::geometry::Vector;
use crate::mechanics::analysis::{
    CornerMoves, CornerSlope, EndSensitivity, FrameAnalysis, NoSensitivity, Sensitivity as Found, Slope,
};
use crate::mechanics::scene::{BodyId, Scene};

#[derive(Serialize)]
pub(super) struct Sensitivity<'a> {
    parameter: &'static str,
    ends: Vec<End<'a>>,
    without_value: Vec<AbsentEnd>,
}

#[derive(Serialize)]
struct AbsentEnd {
    end: &'static str,
    reason: &'static str,
}

#[derive(Serialize)]
struct End<'a> {
    end: &'static str,
    value: Number,
    vertices: Vec<Vertex<'a>>,
    weights: Vec<Weight<'a>>,
    friction: Vec<Friction<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    friction_of_all: Option<ScalarSlope>,
    loads: Vec<Load<'a>>,
}

#[derive(Serialize)]
struct Vertex<'a> {
    block: &'a str,
    vertex: usize,
    at: Pair,
    with: Vec<&'a str>,
    moves: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    along: Option<Pair>,
    #[serde(flatten)]
    slope: VectorSlope,
}

#[derive(Serialize)]
struct Weight<'a> {
    block: &'a str,
    #[serde(flatten)]
    slope: ScalarSlope,
}

#[derive(Serialize)]
struct Friction<'a> {
    /// The index of the interface in `interfaces`, from 0.
    interface: usize,
    bodies: [&'a str; 2],
    #[serde(flatten)]
    slope: ScalarSlope,
}

#[derive(Serialize)]
struct Load<'a> {
    /// The index of the load in the scene, from 0.
    load: usize,
    block: &'a str,
    at: Pair,
    #[serde(flatten)]
    slope: VectorSlope,
}

/// A derivative, or the derivatives along x and y.
#[derive(Serialize)]
struct Derivative<T> {
    unique: bool,
    slope: Value<T>,
}

type ScalarSlope = Derivative<Number>;
type VectorSlope = Derivative<Pair>;

#[derive(Serialize)]
#[serde(untagged)]
enum Value<T> {
    Unique(T),
    /// The backward and the forward derivative.
    Sides([T; 2]),
    AtKink(&'static str),
    /// The vertex cannot move.
    None,
}

impl<T> Derivative<T> {
    fn new(unique: Option<T>, sides: Option<[T; 2]>) -> Derivative<T> {
        Derivative {
            unique: unique.is_some(),
            slope: match (unique, sides) {
                (Some(slope), _) => Value::Unique(slope),
                (None, Some(sides)) => Value::Sides(sides),
                (None, None) => Value::AtKink("at_kink"),
            },
        }
    }
}

impl<'a> Sensitivity<'a> {
    pub(super) fn new(scene: &'a Scene, frame: &'a FrameAnalysis, found: &'a Found) -> Self {
        let ends = found.ends();
        let absent = [("low", &found.low), ("high", &found.high)];
        let absent = absent.into_iter().filter_map(|(end, found)| {
            let reason = word(*found.as_ref().err()?);
            Some(AbsentEnd { end, reason })
        });
        Sensitivity {
            parameter: found.kind.word(),
            ends: ends.map(|(is_high, end)| End::new(scene, frame, is_high, end)).collect(),
            without_value: absent.collect(),
        }
    }
}

impl<'a> End<'a> {
    fn new(scene: &'a Scene, frame: &'a FrameAnalysis, is_high: bool, found: &'a EndSensitivity) -> End<'a> {
        let corners = found.corners.iter();
        let weights =
            found.weights.iter().map(|(block, slope)| Weight { block: &scene.blocks[block.0].id, slope: one(*slope) });
        let friction = found.friction.iter().filter_map(|(interface, slope)| {
            let contact = frame.contacts.get(*interface)?;
            Some(Friction {
                interface: *interface,
                bodies: contact.interface.bodies.map(|body| name(scene, body)),
                slope: one(*slope),
            })
        });
        let loads = found.loads.iter().map(|(load, slopes)| {
            let given = &scene.loads[*load];
            Load { load: given.entry, block: &scene.blocks[given.block.0].id, at: place(given.at), slope: two(*slopes) }
        });
        End {
            end: if is_high { "high" } else { "low" },
            value: Number(found.value),
            vertices: corners.map(|corner| Vertex::new(scene, corner)).collect(),
            weights: weights.collect(),
            friction: friction.collect(),
            friction_of_all: found.friction_of_all.map(one),
            loads: loads.collect(),
        }
    }
}

impl<'a> Vertex<'a> {
    fn new(scene: &'a Scene, found: &CornerSlope) -> Vertex<'a> {
        let (moves, along, slope) = match found.moves {
            CornerMoves::Freely(slopes) => ("freely", None, two(slopes)),
            CornerMoves::Along { direction, slope } => ("along", Some(arrow(direction)), along_edge(direction, slope)),
            _ => {
                let none = Derivative { unique: false, slope: Value::None };
                ("not", None, none)
            }
        };
        Vertex {
            block: &scene.blocks[found.block.0].id,
            vertex: found.corner,
            at: place(found.at),
            with: found.with.iter().map(|body| name(scene, *body)).collect(),
            moves,
            along,
            slope,
        }
    }
}

fn one(slope: Slope) -> ScalarSlope {
    let sides = slope.both().map(|sides| sides.map(Number));
    Derivative::new(slope.unique().map(Number), sides)
}

fn two([x, y]: [Slope; 2]) -> VectorSlope {
    let unique = x.unique().zip(y.unique()).map(|(x, y)| [x, y].map(Number));
    let sides = x.both().zip(y.both());
    let sides = sides.map(|(x, y)| [0, 1].map(|side| [x[side], y[side]].map(Number)));
    Derivative::new(unique, sides)
}

fn along_edge(direction: Vector, slope: Slope) -> VectorSlope {
    let pair = |slope: f64| arrow(direction * slope);
    Derivative::new(slope.unique().map(pair), slope.both().map(|sides| sides.map(pair)))
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
