//! [`stretches`]: the line of pressure through the blocks of a frame, in numbers.
//!
//! Where a block bears two forces beside its loads, their lines and that of its loads meet in one point, for their
//! moments balance: the line of pressure goes along the one force to that point and on along the other. Where that
//! point lies far from the block, as where all forces are parallel, it goes straight from one to the other. Where more
//! forces meet there is no such line: stretches then only tell which forces meet in the block, in the point about which
//! their moments are least.

use crate::analysis::FrameAnalysis;
use crate::geometry::{Bounds, Point, Vector, cross, quarter_turn};
use crate::scene::{BlockId, BodyId, Frame, RobotId, Scene};

/// Forces below this share of the largest are noise of the solution.
const NOISE: f64 = 1e-6;
/// How far beyond a block's box its forces may meet, as a share of the box's shorter side.
const AROUND: f64 = 0.35;

/// Who gives a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Giver {
    /// Another body, through the contact of this number.
    Contact(usize),
    /// A robot.
    Robot(RobotId),
}

/// A piece of the line, from where a force enters a block to where the forces on it meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    /// The block it runs through.
    pub on: BlockId,
    /// Who gives the force.
    pub giver: Giver,
    /// Where it enters the block.
    pub from: Point,
    /// Where the forces on the block meet.
    pub to: Point,
    /// The force on the block, N.
    pub force: Vector,
    /// How many forces meet there beside the loads.
    pub meeting: usize,
}

/// The pieces of the line of pressure, block by block in placing order.
pub(crate) fn stretches(scene: &Scene, frame: &Frame, found: &FrameAnalysis) -> Vec<Stretch> {
    let mut forces: Vec<Vec<Given>> = vec![Vec::new(); scene.blocks.len()];
    for (number, contact) in found.contacts.iter().enumerate() {
        let [first, second] = contact.interface.bodies;
        let force = contact.resultant.force;
        let force = if contact.resultant.on == first { force } else { -force };
        for (body, force) in [(first, force), (second, -force)] {
            if let BodyId::Block(block) = body {
                forces[block.0].push(Given {
                    giver: Giver::Contact(number),
                    at: contact.resultant.at,
                    force,
                });
            }
        }
    }
    for robot in &found.robots {
        let squared = robot.force.norm_squared();
        if squared > 0.0 {
            // A torque moves the line along which the force acts aside, by torque per force.
            let aside = quarter_turn(robot.force) * (-robot.torque / squared);
            forces[robot.block.0].push(Given {
                giver: Giver::Robot(robot.robot),
                at: robot.at + aside,
                force: robot.force,
            });
        }
    }
    let all = forces.iter().flatten().map(|g| g.force.norm());
    let noise = NOISE * all.fold(0.0, f64::max);
    let mut stretches = Vec::new();
    for block in &frame.placed {
        let given = &mut forces[block.0];
        given.retain(|g| g.force.norm() > noise);
        let to = meeting(scene, *block, given);
        stretches.extend(given.iter().map(|g| Stretch {
            on: *block,
            giver: g.giver,
            from: g.at,
            to,
            force: g.force,
            meeting: given.len(),
        }));
    }
    stretches
}

/// A force on a block.
#[derive(Clone, Copy, Debug)]
struct Given {
    giver: Giver,
    at: Point,
    force: Vector,
}

/// Where the forces on a block meet.
fn meeting(scene: &Scene, id: BlockId, given: &[Given]) -> Point {
    let block = &scene.blocks[id.0];
    let bounds = block.body.polygon.bounds();
    let around = bounds.grown(AROUND * bounds.width().min(bounds.height()));
    match (crossing(scene, id, given), given) {
        (Crossing::One(at), _) if contains(around, at) => at,
        (_, [a, b]) => a.at + (b.at - a.at) * 0.5,
        (Crossing::Parallel(at), _) if contains(around, at) => at,
        _ => block.centroid,
    }
}

/// Where lines cross.
enum Crossing {
    /// In one point, or about it.
    One(Point),
    /// They are parallel; the nearest point of the middle one among them.
    Parallel(Point),
}

/// The point about which the squares of the moments of all forces on a block, its loads together, have the least sum;
/// of several the one nearest to its centroid. It lies on every force's line where those lines meet.
fn crossing(scene: &Scene, id: BlockId, given: &[Given]) -> Crossing {
    let block = &scene.blocks[id.0];
    let mut load = scene.down() * block.weight;
    let mut moment = 0.0;
    for extra in scene.loads.iter().filter(|l| l.block == id) {
        load += extra.force;
        moment += cross(extra.at - block.centroid, extra.force) + extra.torque;
    }
    let lines = given
        .iter()
        .map(|g| (g.force, cross(g.at - block.centroid, g.force)))
        .chain([(load, moment)]);
    // A force F of moment m about the centroid has the moment m − h×F about the centroid moved by h.
    let (mut xx, mut xy, mut yy, mut x, mut y) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (force, moment) in lines {
        let row = Vector::new(force.y, -force.x);
        xx += row.x * row.x;
        xy += row.x * row.y;
        yy += row.y * row.y;
        x += row.x * moment;
        y += row.y * moment;
    }
    let (trace, determinant) = (xx + yy, xx * yy - xy * xy);
    if trace <= 0.0 {
        return Crossing::Parallel(block.centroid);
    }
    if determinant > 1e-10 * trace * trace {
        let h = Vector::new(yy * x - xy * y, xx * y - xy * x) / determinant;
        return Crossing::One(block.centroid + h);
    }
    Crossing::Parallel(block.centroid + Vector::new(x, y) / trace)
}

fn contains(bounds: Bounds, p: Point) -> bool {
    (bounds.min.x..=bounds.max.x).contains(&p.x) && (bounds.min.y..=bounds.max.y).contains(&p.y)
}
