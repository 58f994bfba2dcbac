//! [`Force`]: a force that may act on the block, with its name and its arrow on the page.

use super::super::option::Options;
use super::super::words::{force as amount, quantity};
use super::around::distinct;
use crate::analysis::{Analysis, Contact};
use crate::drawing::symbol::{Accent, Symbol};
use crate::drawing::{Camera, Colour, PagePoint};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::scene::{BlockId, BodyId, Scene};

/// Lengths of arrows, pixels: normal and weight, friction at most, ŝ.
const LONG: f64 = 52.0;
const FRICTION: f64 = 42.0;
const THIN: f64 = 30.0;
/// Widths of shafts, pixels.
const WIDTH: f64 = 2.4;
const THIN_WIDTH: f64 = 1.2;
/// Friction arrows of one interface reach at most so far towards each other, as a share of its length.
const APART: f64 = 0.30;

/// A force that may act on the block.
pub(super) struct Force {
    /// Its name.
    pub symbol: Symbol,
    /// What it is, in words.
    pub told: String,
    /// Where its arrow begins.
    pub from: PagePoint,
    /// Where it goes from there; of a turning arrow the radius.
    pub along: (f64, f64),
    /// The angle of a turning arrow, radians.
    pub turn: Option<f64>,
    /// Width of its shaft, pixels.
    pub width: f64,
    /// Its colour.
    pub colour: Colour,
}

impl Force {
    /// Middles of a name of this size beside the arrow's tip and shaft.
    pub(super) fn beside(&self, wide: f64, high: f64) -> Vec<PagePoint> {
        let (x, y) = self.along;
        let length = libm::hypot(x, y).max(1e-9);
        let (ux, uy) = (x / length, y / length);
        let reach = |x: f64, y: f64| x.abs() * wide / 2.0 + y.abs() * high / 2.0;
        if self.turn.is_some() {
            let off = |x: f64, y: f64| {
                let far = length + 3.0 * self.width + 2.0 + reach(x, y);
                self.from.moved(x * far, y * far)
            };
            return vec![off(1.0, 0.0), off(0.0, -1.0), off(-1.0, 0.0), off(0.0, 1.0)];
        }
        let mut middles = Vec::new();
        for share in [0.85, 1.1, 0.55, 0.3] {
            // Above the shaft first: that is where a reader looks.
            let up = if -ux > 0.0 { 1.0 } else { -1.0 };
            for side in [up, -up] {
                let (nx, ny) = (-uy * side, ux * side);
                let off = 1.5 * self.width + 3.0 + reach(nx, ny);
                middles.push(self.from.moved(x * share + nx * off, y * share + ny * off));
            }
        }
        let beyond = length + 4.5 * self.width + 3.0 + reach(ux, uy);
        middles.push(self.from.moved(ux * beyond, uy * beyond));
        middles
    }
}

/// The unit normal into a block at one of its contacts.
pub(super) fn inward(contact: &Contact, block: BlockId) -> Vector {
    if contact.interface.bodies[0] == BodyId::Block(block) {
        contact.interface.normal
    } else {
        -contact.interface.normal
    }
}

/// Names at contact `number` of `count`: a letter with an arrow, numbered by interface where there are several.
pub(super) fn named(below: &str, number: usize, count: usize) -> Symbol {
    let symbol = Symbol::new("F", Accent::Arrow, below);
    if count > 1 {
        symbol.raised(&format!("({})", number + 1))
    } else {
        symbol
    }
}

/// Every force that may act on a block, and ŝ of every interface.
pub(super) fn forces(
    analysis: &Analysis<'_>,
    frame: usize,
    block: BlockId,
    contacts: &[&Contact],
    camera: &Camera,
    options: &Options,
) -> Vec<Force> {
    let scene = analysis.scene;
    let (theme, name) = (&options.theme, &scene.blocks[block.0].id);
    let mut forces = Vec::new();
    // On a small block long arrows would reach across each other.
    let diagonal = scene.blocks[block.0].body.polygon.bounds().diagonal();
    let shorter = (camera.length(diagonal) / 300.0).clamp(0.5, 1.0);
    let (long, thin) = (shorter * LONG, shorter * THIN);
    let arrow = |symbol: Symbol, told: String, at, direction: Vector, length: f64| {
        let (x, y) = camera.turn(direction);
        let scale = length / libm::hypot(x, y).max(1e-300);
        Force {
            symbol,
            told,
            from: camera.place(at),
            along: (x * scale, y * scale),
            turn: None,
            width: WIDTH,
            colour: theme.ink,
        }
    };
    for (number, contact) in contacts.iter().enumerate() {
        let inward = inward(contact, block);
        let left = quarter_turn(inward);
        let [a, b] = contact.application_points;
        let reach = (APART * camera.length((b - a).norm())).clamp(14.0, shorter * FRICTION);
        let named = |below: &str| named(below, number, contacts.len());
        for (k, at) in distinct(contact).into_iter().enumerate() {
            let k = k + 1;
            let symbol = named(&format!("s{k}"));
            let told = format!("Normal force {} on block {name}", symbol.said());
            forces.push(arrow(symbol, told, at, inward, long));
            for (side, direction, word) in [("l", left, "left"), ("r", -left, "right")] {
                let symbol = named(&format!("f{side}{k}"));
                let told = format!(
                    "Friction force {} on block {name}, to the {word} of ŝ",
                    symbol.said()
                );
                forces.push(arrow(symbol, told, at, direction, reach));
            }
        }
        let below = if contacts.len() > 1 {
            (number + 1).to_string()
        } else {
            String::new()
        };
        let symbol = Symbol::new("s", Accent::Hat, &below);
        let told = format!("Unit normal {} into block {name}", symbol.said());
        let clear = camera.metres(FRICTION + 1.2 * thin);
        forces.push(Force {
            width: THIN_WIDTH,
            colour: theme.faint,
            ..arrow(
                symbol,
                told,
                beside(scene, contact, block, clear),
                inward,
                THIN,
            )
        });
    }
    let body = &scene.blocks[block.0];
    if body.weight > 0.0 {
        let symbol = weight();
        let told = format!(
            "Weight mg of block {name}: {}",
            amount(scene.down() * body.weight)
        );
        forces.push(arrow(symbol, told, body.centroid, scene.down(), long));
    }
    for (number, load) in scene.loads.iter().filter(|l| l.block == block).enumerate() {
        let below = (number + 1).to_string();
        if load.force.norm() > 0.0 {
            let symbol = Symbol::new("Q", Accent::Arrow, &below);
            let told = format!("Load on block {name}: {}", amount(load.force));
            forces.push(arrow(symbol, told, load.at, load.force, long));
        }
        if load.torque != 0.0 {
            let symbol = Symbol::new("M", Accent::None, &format!("Q{below}"));
            let told = format!(
                "Torque of a load on block {name}: {}",
                quantity(load.torque, "N·m")
            );
            let along = arrow(symbol, told, load.at, Vector::new(1.0, 0.0), 22.0);
            forces.push(Force {
                turn: Some(load.torque.signum() * 3.4),
                ..along
            });
        }
    }
    for hold in scene.frames[frame]
        .holds
        .iter()
        .filter(|h| h.block == block)
    {
        let (robot, colour) = (&scene.robots[hold.robot.0], theme.robot(hold.robot.0));
        let colour = colour.mixed(theme.ink, 0.25);
        for (axis, direction) in [("x", Vector::new(1.0, 0.0)), ("y", Vector::new(0.0, 1.0))] {
            let symbol = Symbol::new("F", Accent::Arrow, axis).raised(&robot.id);
            let told = format!(
                "Force {} of robot {} on block {name}",
                symbol.said(),
                robot.id
            );
            forces.push(Force {
                colour,
                width: 1.3 * WIDTH,
                ..arrow(symbol, told, hold.at, direction, long)
            });
        }
        if robot.limits.torque > 0.0 {
            let symbol = Symbol::new("M", Accent::None, "").raised(&robot.id);
            let told = format!("Torque {} of robot {}", symbol.said(), robot.id);
            let along = arrow(symbol, told, hold.at, Vector::new(1.0, 0.0), 24.0);
            forces.push(Force {
                colour,
                turn: Some(3.4),
                ..along
            });
        }
    }
    forces
}

/// Where ŝ stands: `clear` metres beside the interface where the neighbour's edge goes on, in its middle otherwise.
fn beside(scene: &Scene, contact: &Contact, block: BlockId, clear: f64) -> Point {
    let interface = &contact.interface;
    let (inward, along) = (inward(contact, block), interface.tangent());
    let [first, second] = interface.bodies;
    let neighbour = if first == BodyId::Block(block) {
        second
    } else {
        first
    };
    let tries = [
        interface.ends[1] + along * clear,
        interface.ends[0] - along * clear,
    ];
    let goes_on = |p: &Point| {
        let inside = |beyond: f64| *p + along * beyond - inward * (0.05 * clear);
        let polygon = &scene.body(neighbour).polygon;
        let own = &scene.blocks[block.0].body.polygon;
        [-0.2, 0.0, 0.2]
            .iter()
            .all(|b| polygon.contains(inside(b * clear)))
            && !polygon.contains(*p + inward * (0.05 * clear))
            && !own.contains(*p + inward * (0.05 * clear))
    };
    tries
        .into_iter()
        .find(goes_on)
        .unwrap_or(interface.middle())
}

/// The name of a weight.
pub(super) fn weight() -> Symbol {
    Symbol::new("m", Accent::None, "").then(Symbol::new("g", Accent::Arrow, ""))
}
