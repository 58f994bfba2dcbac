//! [`stretches`]: the line of pressure through the blocks of a frame, in numbers.
//!
//! Where a block bears two forces beside its loads, their lines and that of its loads meet in one point, for their
//! moments balance: the line of pressure goes along the one force to that point and on along the other. Where that
//! point is no way between the two, or outside the block, as where all forces are parallel, it goes straight from one to
//! the other. A single force it follows to the block's centroid. Where more forces meet there is no such line: stretches
//! then only tell which forces meet in the block, in the point about which their moments are least.

use super::bearing::{self, bearings};
use crate::analysis::FrameAnalysis;
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::scene::{BlockId, BodyId, Frame, RobotId, Scene};

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
        if squared.sqrt() > bearing::noise(f64::INFINITY, scene.blocks[robot.block.0].weight) {
            // A torque moves the line along which the force acts aside, by torque per force.
            let aside = quarter_turn(robot.force) * (-robot.torque / squared);
            forces[robot.block.0].push(Given {
                giver: Giver::Robot(robot.robot),
                at: robot.at + aside,
                force: robot.force,
            });
        }
    }
    let mut stretches = Vec::new();
    for block in &frame.placed {
        let given = &forces[block.0];
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
    let crossing = crossing(scene, id, given);
    match (given, crossing) {
        ([a, b], crossing) => match crossing {
            Crossing::One(at) if block.body.polygon.contains(at) && between(a.at, b.at, at) => at,
            _ => a.at + (b.at - a.at) * 0.5,
        },
        (_, Crossing::One(at) | Crossing::Parallel(at)) if block.body.polygon.contains(at) => at,
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

/// Whether a way from one point to another over a third turns back nowhere.
fn between(from: Point, to: Point, over: Point) -> bool {
    let along = to - from;
    (0.0..=along.norm_squared()).contains(&(over - from).dot(&along))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Analysis;

    fn scene(text: &str) -> Scene {
        Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"))
    }

    #[test]
    fn the_line_passes_through_every_resultant_and_where_forces_meet_none_has_a_moment() {
        for text in [
            include_str!("../../assets/study/arch-27.json"),
            include_str!("../../assets/thesis/figure-3b.json"),
            include_str!("../../assets/thesis/figure-5.json"),
        ] {
            let scene = scene(text);
            let found = &Analysis::of(&scene).frames[0];
            let stretches = stretches(&scene, &scene.frames[0], found);
            for (number, contact) in found.contacts.iter().enumerate() {
                let here = |s: &&Stretch| s.giver == Giver::Contact(number);
                let ends: Vec<&Stretch> = stretches.iter().filter(here).collect();
                let blocks = contact.interface.bodies.iter();
                let blocks = blocks.filter(|b| matches!(b, BodyId::Block(_))).count();
                assert_eq!(ends.len(), blocks);
                assert!(ends.iter().all(|s| s.from == contact.resultant.at));
            }
            let mut meeting = 0;
            for pair in stretches.chunk_by(|a, b| a.on == b.on) {
                let [a, b] = pair else { continue };
                assert_eq!(a.to, b.to);
                let straight = (a.to - (a.from + (b.from - a.from) * 0.5)).norm() < 1e-12;
                let moment = |s: &Stretch| cross(s.to - s.from, s.force).abs() / s.force.norm();
                let centroid = scene.blocks[a.on.0].centroid;
                if straight {
                    continue;
                }
                assert!(moment(a) < 1e-6 && moment(b) < 1e-6, "{a:?} {b:?}");
                assert!((a.to.x - centroid.x).abs() < 1e-6, "the weight meets them");
                meeting += 1;
            }
            assert!(meeting > 0);
        }
    }

    #[test]
    fn a_torque_moves_a_robots_line_aside_and_parallel_forces_go_straight() {
        let scene = scene(
            r#"{ "drystone": 1, "blocks": [ { "id": "a", "polygon": [[0,0],[4,0],[4,2],[0,2]], "weight": 8 } ],
                 "robots": [ { "id": "r", "limits": { "torque": 100 } } ],
                 "steps": [ { "place": ["a"], "hold": { "r": { "block": "a", "at": [3, 1] } } } ] }"#,
        );
        let found = &Analysis::of(&scene).frames[0];
        let [one] = stretches(&scene, &scene.frames[0], found)[..] else {
            panic!("one force holds the block")
        };
        // 8 N at the grip with −8 N·m about it act along the line through the centroid, a metre beside it.
        assert!((one.from - Point::new(2.0, 1.0)).norm() < 1e-6, "{one:?}");
        assert!((one.to - Point::new(2.0, 1.0)).norm() < 1e-6, "{one:?}");
    }
}
