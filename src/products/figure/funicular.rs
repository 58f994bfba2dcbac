//! [`Stretch`]: the pieces of the line of thrust, block by block: where forces run, in numbers.
//!
//! A piece lies on a true line of action and on nothing else. Where two bodies press a block, the thrust follows the
//! line of the first force until it meets the line of a load or of the weight, goes on along the line of their
//! resultant, and so on until it arrives at the second body along the line of that body's force: the funicular polygon
//! of the block. That is drawn only where each of these lines meets the next one inside the block. Elsewhere (three
//! bodies press, or the forces are parallel and apart, or they do not balance) there is no single line: each joint
//! shows a short piece of the line of its own resultant, and no more.

use super::bearing::{self, bearings};
use crate::analysis::FrameAnalysis;
use crate::geometry::{Point, Polygon, Vector, cross, quarter_turn};
use crate::scene::{Block, BlockId, BodyId, Frame, RobotId, Scene};

/// How far a line may pass by a point that it should meet, as a share of the block's size.
const NEAR: f64 = 1e-6;
/// Imbalance up to which the forces on a block are one system in equilibrium, as a share of their sum.
const BALANCED: f64 = 1e-6;
/// Least length of the piece at a joint where no line runs through, unit edges.
const PIECE: f64 = 0.5;
/// The loads of a block with more than so many are put together with its weight.
const MOST_LOADS: usize = 3;

/// Who gives a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Giver {
    /// Another body, through the contact of this number.
    Contact(usize),
    /// A robot.
    Robot(RobotId),
    /// The load of this number in the scene.
    Load(usize),
    /// The force of a joint and the loads that the line has met on its way from there.
    Resultant,
}

/// A straight piece of the line of thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    /// The block it runs through.
    pub on: BlockId,
    /// Who gives the force.
    pub giver: Giver,
    /// One end.
    pub from: Point,
    /// The other end.
    pub to: Point,
    /// The force that acts along it, N.
    pub force: Vector,
    /// Whether the line runs on through the block; otherwise it stops here.
    pub through: bool,
}

/// The pieces of the line of thrust, block by block in placing order; `unit` metres are one unit edge.
pub(crate) fn stretches(
    scene: &Scene,
    frame: &Frame,
    found: &FrameAnalysis,
    unit: f64,
) -> Vec<Stretch> {
    let (pressing, loads) = (pressing(scene, found), loads(scene));
    let mut stretches = Vec::new();
    for id in &frame.placed {
        let case = Case {
            id: *id,
            block: &scene.blocks[id.0],
            pressing: &pressing[id.0],
            loads: &loads[id.0],
            unit,
        };
        match case.path() {
            Some(path) => stretches.extend(path),
            None => stretches.extend(case.pieces()),
        }
    }
    stretches
}

/// A force with its line of action.
#[derive(Clone, Copy, Debug)]
struct Line {
    giver: Giver,
    /// A point of the line: where the force enters the block.
    at: Point,
    force: Vector,
}

/// What bodies and robots give to each block, by its number.
fn pressing(scene: &Scene, found: &FrameAnalysis) -> Vec<Vec<Line>> {
    let mut lines: Vec<Vec<Line>> = vec![Vec::new(); scene.blocks.len()];
    let bearings = bearings(scene, found);
    for (number, contact) in found.contacts.iter().enumerate() {
        if bearings[number].is_none() {
            continue;
        }
        let [first, second] = contact.interface.bodies;
        let force = contact.resultant.force;
        let force = if contact.resultant.on == first {
            force
        } else {
            -force
        };
        for (body, force) in [(first, force), (second, -force)] {
            if let BodyId::Block(block) = body {
                lines[block.0].push(Line {
                    giver: Giver::Contact(number),
                    at: contact.resultant.at,
                    force,
                });
            }
        }
    }
    for robot in &found.robots {
        let noise = bearing::noise(f64::INFINITY, scene.blocks[robot.block.0].weight);
        if robot.force.norm() > noise {
            lines[robot.block.0].push(Line {
                giver: Giver::Robot(robot.robot),
                at: aside(robot.at, robot.force, robot.torque),
                force: robot.force,
            });
        }
    }
    lines
}

/// The weight and the loads of each block, by its number. A torque without a force moves the weight's line aside.
fn loads(scene: &Scene) -> Vec<Vec<Line>> {
    let mut torques = vec![0.0; scene.blocks.len()];
    for load in scene.loads.iter().filter(|l| l.force.norm() == 0.0) {
        torques[load.block.0] += load.torque;
    }
    let weight = |(block, torque): (&Block, &f64)| {
        let force = scene.down() * block.weight;
        let line = Line {
            giver: Giver::Resultant,
            at: aside(block.centroid, force, *torque),
            force,
        };
        if block.weight > 0.0 {
            vec![line]
        } else {
            Vec::new()
        }
    };
    let mut lines: Vec<Vec<Line>> = scene.blocks.iter().zip(&torques).map(weight).collect();
    for (number, load) in scene.loads.iter().enumerate() {
        if load.force.norm() > 0.0 {
            lines[load.block.0].push(Line {
                giver: Giver::Load(number),
                at: aside(load.at, load.force, load.torque),
                force: load.force,
            });
        }
    }
    lines
}

/// A point of the line along which a force at a point acts together with a torque: moved aside by torque per force.
fn aside(at: Point, force: Vector, torque: f64) -> Point {
    let squared = force.norm_squared();
    if torque == 0.0 || squared <= 0.0 {
        return at;
    }
    at + quarter_turn(force) * (-torque / squared)
}

/// One block and the forces on it.
struct Case<'a> {
    id: BlockId,
    block: &'a Block,
    pressing: &'a [Line],
    loads: &'a [Line],
    unit: f64,
}

impl Case<'_> {
    fn polygon(&self) -> &Polygon {
        &self.block.body.polygon
    }

    fn size(&self) -> f64 {
        self.polygon().bounds().diagonal()
    }

    /// The funicular polygon of the block; `None` where there is none inside it.
    fn path(&self) -> Option<Vec<Stretch>> {
        let (first, last) = match self.pressing {
            [one] => (one, None),
            [one, other] => (one, Some(other)),
            _ => return None,
        };
        if !self.balances() {
            return None;
        }
        let orders = if self.loads.len() <= MOST_LOADS + 1 {
            orders(self.loads)
        } else {
            Vec::new()
        };
        let together = self.together().map(|sum| vec![sum]);
        orders
            .into_iter()
            .chain(together)
            .find_map(|loads| self.funicular(first, &loads, last))
    }

    /// Whether the forces known of the block balance; where it falls they do not.
    fn balances(&self) -> bool {
        let (mut sum, mut moment, mut all) = (Vector::zeros(), 0.0, 0.0);
        for line in self.pressing.iter().chain(self.loads) {
            sum += line.force;
            moment += cross(line.at - self.block.centroid, line.force);
            all += line.force.norm();
        }
        sum.norm() <= BALANCED * all && moment.abs() <= BALANCED * all * self.size()
    }

    /// The weight and all loads as one force.
    fn together(&self) -> Option<Line> {
        let centroid = self.block.centroid;
        let force: Vector = self.loads.iter().map(|l| l.force).sum();
        let moments = self.loads.iter().map(|l| cross(l.at - centroid, l.force));
        let line = Line {
            giver: Giver::Resultant,
            at: aside(centroid, force, moments.sum()),
            force,
        };
        (self.loads.len() > 1 && force.norm() > 0.0).then_some(line)
    }

    /// The line from one joint over the lines of these loads, in this order, to the other joint or to where it ends.
    fn funicular(&self, first: &Line, loads: &[Line], last: Option<&Line>) -> Option<Vec<Stretch>> {
        let near = NEAR * self.size();
        let most: f64 = self.pressing.iter().map(|l| l.force.norm()).sum();
        let (mut at, mut force, mut giver) = (first.at, first.force, first.giver);
        let mut path = Vec::new();
        for (number, load) in loads.iter().enumerate() {
            let corner = met(at, force, load, near)?;
            let ends = last.is_none() && number + 1 == loads.len();
            if ends && matches!(load.giver, Giver::Load(_)) {
                // What is left is this load alone: the line ends where it acts.
                path.extend(self.piece(load.giver, (load.at, at), load.force));
                continue;
            }
            path.extend(self.piece(giver, (at, corner), force));
            if let Giver::Load(_) = load.giver {
                path.extend(self.piece(load.giver, (load.at, corner), load.force));
            }
            at = corner;
            force += load.force;
            // Once the other joint's force alone is left, the line is that force's.
            giver = match last {
                Some(last) if number + 1 == loads.len() => last.giver,
                _ => Giver::Resultant,
            };
            if !ends && force.norm() <= BALANCED * most {
                return None;
            }
        }
        if let Some(last) = last {
            let off = cross(last.at - at, force).abs() / force.norm().max(f64::MIN_POSITIVE);
            if off > 10.0 * near {
                return None;
            }
            let force = if giver == last.giver {
                last.force
            } else {
                force
            };
            path.extend(self.piece(giver, (at, last.at), force));
        }
        let inside = path.iter().all(|s| self.within(s.from, s.to));
        let main = path.iter().filter(|s| !matches!(s.giver, Giver::Load(_)));
        let ends = main
            .clone()
            .next()
            .map(|s| s.from)
            .zip(main.clone().next_back().map(|s| s.to));
        // A line that turns back lies on itself and cannot be read.
        let onward = ends.is_none_or(|(a, b)| {
            let chord = b - a;
            let mut main = main;
            main.all(|s| (s.to - s.from).dot(&chord) >= -near * chord.norm())
        });
        (inside && onward).then_some(path)
    }

    /// A piece that runs through, where it has a length.
    fn piece(&self, giver: Giver, (from, to): (Point, Point), force: Vector) -> Option<Stretch> {
        let stretch = Stretch {
            on: self.id,
            giver,
            from,
            to,
            force,
            through: true,
        };
        ((to - from).norm() > NEAR * self.size()).then_some(stretch)
    }

    /// Whether the way between two points stays in the block, the outline included.
    fn within(&self, from: Point, to: Point) -> bool {
        let near = 10.0 * NEAR * self.size();
        (0..=8).all(|i| {
            let p = from + (to - from) * (f64::from(i) / 8.0);
            self.polygon().contains(p)
                || self
                    .polygon()
                    .edges()
                    .any(|e| from_edge(e.from, e.to, p) <= near)
        })
    }

    /// A piece of each force's own line of action, from where it enters the block; between two joints half-way at most.
    fn pieces(&self) -> Vec<Stretch> {
        let between = match self.pressing {
            [one, other] => other.at - one.at,
            _ => Vector::zeros(),
        };
        let all = self.pressing.iter().chain(self.loads);
        let given = all.filter(|l| l.giver != Giver::Resultant && l.force.norm() > 0.0);
        let long = |line: &Line| {
            let half = 0.5 * between.dot(&line.force.normalize()).abs();
            let half = match line.giver {
                Giver::Load(_) => 0.0,
                _ => half,
            };
            half.max(PIECE * self.unit)
        };
        let piece = |line: &Line| {
            let along = line.force.normalize();
            // A push enters the block along the force; a pull, or a load within, leaves it that way.
            let ways = [along, -along].map(|way| (way, self.room(line.at, way)));
            let (way, room) = if ways[0].1 > NEAR * self.size() {
                ways[0]
            } else {
                ways[1]
            };
            Stretch {
                on: self.id,
                giver: line.giver,
                from: line.at,
                to: line.at + way * room.min(long(line)),
                force: line.force,
                through: false,
            }
        };
        given.map(piece).filter(|s| s.from != s.to).collect()
    }

    /// How far one can go from a point of the block in a direction without leaving it, metres.
    fn room(&self, at: Point, way: Vector) -> f64 {
        let near = 10.0 * NEAR * self.size();
        if !self.polygon().contains(at + way * (2.0 * near)) {
            return 0.0;
        }
        let beyond = |edge: crate::geometry::Edge| {
            let along = edge.to - edge.from;
            let across = cross(way, along);
            let (far, share) = (
                cross(edge.from - at, along) / across,
                cross(edge.from - at, way) / across,
            );
            (across != 0.0 && far > near && (0.0..=1.0).contains(&share)).then_some(far)
        };
        let crossings = self.polygon().edges().filter_map(beyond);
        crossings.fold(f64::INFINITY, f64::min).min(self.size())
    }
}

/// Where the line of a force through a point meets the line of a load; on one line with it, beside the load's point.
fn met(at: Point, force: Vector, load: &Line, near: f64) -> Option<Point> {
    let (a, b) = (force.normalize(), load.force.normalize());
    let sine = cross(a, b);
    let between = load.at - at;
    // Lines this near to each other throughout a block are one; where they cross, rounding alone would say.
    if sine.abs() < NEAR {
        let off = cross(between, a).abs();
        return (off <= near).then(|| at + a * between.dot(&a));
    }
    let corner = at + a * (cross(between, b) / sine);
    corner
        .coords
        .iter()
        .all(|c| c.is_finite())
        .then_some(corner)
}

/// All orders of a few loads, that of the list first.
fn orders(loads: &[Line]) -> Vec<Vec<Line>> {
    let Some((first, rest)) = loads.split_first() else {
        return vec![Vec::new()];
    };
    let mut all = Vec::new();
    for order in orders(rest) {
        for place in 0..=order.len() {
            let mut longer = order.clone();
            longer.insert(place, *first);
            all.push(longer);
        }
    }
    all
}

fn from_edge(a: Point, b: Point, p: Point) -> f64 {
    let along = b - a;
    let share = (p - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
    (p - (a + along * share.clamp(0.0, 1.0))).norm()
}

#[cfg(test)]
mod tests;
