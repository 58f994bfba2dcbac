//! [`Force`]: a force on the block with its name, as it is listed. [`forces`] collects all of them.

use super::super::option::{Corners, Options};
use super::super::words::{force as amount, quantity};
use super::around::{corners, distinct, inward, other};
use crate::analysis::{Analysis, Contact, Failure};
use crate::drawing::Colour;
use crate::drawing::symbol::{Accent, Symbol};
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::scene::{BlockId, BodyId};

/// With at most this many interfaces the forces at both ends of each are drawn, unless the options say otherwise.
const MAX_INTERFACES_BY_CORNER: usize = 3;
/// Forces below this share of the largest are rounding errors of the solver.
const FORCE_TOL: f64 = 1e-9;

/// A force on the block.
#[derive(Clone, Debug)]
pub(super) struct Force {
    /// Its name.
    pub symbol: Symbol,
    /// Its kind, in words.
    pub what: &'static str,
    /// Its origin, in words.
    pub from: String,
    /// The point where it acts, metres.
    pub at: Point,
    /// The force, N.
    pub force: Vector,
    /// The torque, N·m.
    pub torque: f64,
    /// Its colour.
    pub colour: Colour,
}

impl Force {
    /// Returns its moment about a point, N·m.
    pub(super) fn moment(&self, about: Point) -> f64 {
        cross(self.at - about, self.force) + self.torque
    }

    /// Describes the force and its magnitude; `on` is the name of the block.
    pub(super) fn title(&self, on: &str) -> String {
        let amount = if self.force.norm() > 0.0 || self.torque == 0.0 {
            amount(self.force)
        } else {
            quantity(self.torque, "N·m")
        };
        format!(
            "{} {} on block {on}: {amount}",
            self.what,
            self.symbol.stated()
        )
    }
}

/// The level of detail of the forces of interfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// Normal and friction force at each corner, each with its own name: for a block with one interface.
    Parts,
    /// One force at each corner: for a block with few interfaces.
    Corners,
    /// One force for each interface.
    Resultants,
}

/// Returns the level of detail for a block with `count` interfaces.
pub(super) fn detail(count: usize, options: &Options) -> Detail {
    match (options.corners, count) {
        (_, 0..=1) => Detail::Parts,
        (Corners::All, _) => Detail::Corners,
        (Corners::Few, n) if n <= MAX_INTERFACES_BY_CORNER => Detail::Corners,
        (Corners::Few, _) => Detail::Resultants,
    }
}

/// Returns all forces on a block: weight, loads, forces of interfaces and robots, and missing forces.
pub(super) fn forces(
    analysis: &Analysis,
    frame: usize,
    block: BlockId,
    contacts: &[&Contact],
    options: &Options,
) -> Vec<Force> {
    let (scene, found) = (&analysis.scene, &analysis.frames[frame]);
    let (theme, body) = (&options.theme, &scene.blocks[block.0]);
    let mut forces = Vec::new();
    let mut add = |symbol, what, from, at, (force, torque), colour| {
        forces.push(Force {
            symbol,
            what,
            from,
            at,
            force,
            torque,
            colour,
        });
    };
    let arrow = |below: &str| Symbol::new("F", Accent::Arrow, below);
    if body.weight > 0.0 {
        let weight = scene.down() * body.weight;
        let whose = "weight".to_owned();
        add(
            self::weight(),
            "Weight",
            whose,
            body.centroid,
            (weight, 0.0),
            theme.ink,
        );
    }
    for (number, load) in scene.loads.iter().filter(|l| l.block == block).enumerate() {
        let below = (number + 1).to_string();
        let whose = "load".to_owned();
        if load.force.norm() > 0.0 {
            let symbol = Symbol::new("Q", Accent::Arrow, &below);
            add(
                symbol,
                "Load",
                whose.clone(),
                load.at,
                (load.force, 0.0),
                theme.load,
            );
        }
        if load.torque != 0.0 {
            let symbol = Symbol::new("M", Accent::None, &format!("Q{below}"));
            let torque = (Vector::zeros(), load.torque);
            add(
                symbol,
                "Torque of a load",
                whose,
                load.at,
                torque,
                theme.load,
            );
        }
    }
    let detail = detail(contacts.len(), options);
    let carried = contacts.iter().flat_map(|c| c.normal_forces);
    let noise = FORCE_TOL * carried.fold(body.weight, f64::max);
    for (number, contact) in contacts.iter().enumerate() {
        let given = corners(contact, block);
        let (normal, left) = (inward(contact, block), quarter_turn(inward(contact, block)));
        let whose = named(analysis, other(contact, block));
        let count = distinct(contact).len();
        match detail {
            Detail::Parts => {
                for (k, corner) in given.iter().enumerate().take(count) {
                    let k = k + 1;
                    let symbol = arrow(&format!("s{k}"));
                    let pushed = (normal * corner.normal, 0.0);
                    add(
                        symbol,
                        "Normal force",
                        whose.clone(),
                        corner.at,
                        pushed,
                        theme.ink,
                    );
                    let side = if corner.friction >= 0.0 { "l" } else { "r" };
                    for which in ["l", "r"] {
                        let acts = which == side && corner.friction.abs() > noise;
                        if options.corners == Corners::Few && !acts {
                            continue;
                        }
                        let amount = if acts { corner.friction } else { 0.0 };
                        let symbol = arrow(&format!("f{which}{k}"));
                        let rubbed = (left * amount, 0.0);
                        add(
                            symbol,
                            "Friction force",
                            whose.clone(),
                            corner.at,
                            rubbed,
                            theme.ink,
                        );
                    }
                }
            }
            Detail::Corners => {
                for (k, corner) in given.iter().enumerate().take(count) {
                    let (letter, accent) = match options.corners {
                        Corners::All => ("x", Accent::None),
                        Corners::Few => ("F", Accent::Arrow),
                    };
                    let symbol = Symbol::new(letter, accent, &(k + 1).to_string());
                    let symbol = symbol.raised(&format!("({})", number + 1));
                    let both = normal * corner.normal + left * corner.friction;
                    add(
                        symbol,
                        "Force",
                        whose.clone(),
                        corner.at,
                        (both, 0.0),
                        theme.ink,
                    );
                }
            }
            Detail::Resultants => {
                let force = given.iter().map(|c| normal * c.normal + left * c.friction);
                let symbol = arrow(&(number + 1).to_string());
                let sum = (force.sum(), 0.0);
                add(symbol, "Force", whose, contact.resultant.at, sum, theme.ink);
            }
        }
    }
    for robot in found.robots.iter().filter(|r| r.block == block) {
        let id = &scene.robots[robot.robot.0].id;
        let colour = theme.robot(robot.robot.0).mixed(theme.ink, 0.25);
        let whose = format!("robot {id}");
        let given = (robot.force, 0.0);
        add(
            arrow("").raised(id),
            "Force",
            whose.clone(),
            robot.at,
            given,
            colour,
        );
        if scene.robots[robot.robot.0].limits.torque > 0.0 {
            let symbol = Symbol::new("M", Accent::None, "").raised(id);
            let given = (Vector::zeros(), robot.torque);
            add(symbol, "Torque", whose, robot.at, given, colour);
        }
    }
    let mut count = 0;
    for failure in &found.failures {
        let Some((whose, what, at, missing)) = missing(analysis, failure, block) else {
            continue;
        };
        count += 1;
        let accent = if missing.1 == 0.0 {
            Accent::Arrow
        } else {
            Accent::None
        };
        let symbol = Symbol::new("X", accent, &count.to_string());
        add(symbol, what, whose, at, missing, theme.failure);
    }
    forces
}

/// Returns the missing force of a failure on a block: its origin, its kind, its point of action, and force (N) and
/// torque (N·m). Returns `None` if it does not act on this block.
fn missing(
    analysis: &Analysis,
    failure: &Failure,
    block: BlockId,
) -> Option<(String, &'static str, Point, (Vector, f64))> {
    let scene = &analysis.scene;
    let own = BodyId::Block(block);
    let action = failure.on(own)?;
    let what = match failure {
        Failure::Tension { .. } => "Missing pull",
        Failure::Friction { .. } => "Missing friction",
        Failure::RobotForce { .. } => "Missing force",
        Failure::RobotTorque { .. } => "Missing torque",
    };
    let whose = match *failure {
        Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. } => {
            let other = bodies.into_iter().find(|body| *body != own)?;
            named(analysis, other)
        }
        _ => format!("robot {}", scene.robots[failure.robot()?.0].id),
    };
    Some((format!("missing, {whose}"), what, failure.at(), action))
}

/// Returns the name of a body for the list.
fn named(analysis: &Analysis, body: BodyId) -> String {
    match body {
        BodyId::Ground(_) => "ground".to_owned(),
        BodyId::Block(_) => analysis.scene.name(body).to_owned(),
    }
}

/// Returns the force of the longest arrow, N; a torque counts as torque divided by `edge`, the unit edge in metres.
/// Returns 0 if lengths do not show magnitudes.
pub(super) fn largest(forces: &[Force], edge: f64, options: &Options) -> f64 {
    let size = |f: &Force| f.force.norm().max(f.torque.abs() / edge);
    match options.corners {
        Corners::All => 0.0,
        Corners::Few => forces.iter().map(size).fold(0.0, f64::max),
    }
}

/// Returns the symbol of a weight.
pub(super) fn weight() -> Symbol {
    Symbol::new("m", Accent::None, "").then(Symbol::new("g", Accent::Arrow, ""))
}
