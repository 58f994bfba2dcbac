//! [`pair`]: frames of two scenes as two frames of one, so that they can be compared.
//!
//! A block of one name, outline, weight and loads in both is one block. One that differs in any of these is two: the
//! former is gone in the second frame, the latter new.

use super::{Analysis, Contact, Failure, FrameAnalysis};
use crate::geometry::Polygon;
use crate::scene::{Block, BlockId, BodyId, Frame, Load, RobotId, Scene};

/// Outlines whose corners are nearer than this share of their size are one.
const ALIKE: f64 = 1e-9;

/// One scene with two frames, the frame `before` (analysis and number from 0) and the frame `after`, and what was found out
/// about them. The frames are titled `titles`, the second with what else differs between the scenes: gravity's strength,
/// kernel, friction, thickness, corner contacts.
///
/// # Errors
/// In words, why the two cannot stand in one scene: another ground, or another direction of gravity.
pub fn pair(
    before: (&Analysis, usize),
    after: (&Analysis, usize),
    titles: [String; 2],
) -> Result<(Scene, Vec<FrameAnalysis>), String> {
    let (first, second) = (&*before.0.scene, &*after.0.scene);
    if (first.down() - second.down()).norm() > ALIKE {
        return Err("gravity points another way in the second; turn one of the two".into());
    }
    let grounds = first.ground.len() == second.ground.len()
        && first
            .ground
            .iter()
            .zip(&second.ground)
            .all(|(a, b)| alike(&a.body.polygon, &b.body.polygon));
    if !grounds {
        return Err(
            "the ground of the second is another; give both the same ground, part by part".into(),
        );
    }
    let mut scene = first.clone();
    scene.title = match (first.title.is_empty(), first.title == second.title) {
        (false, true) => first.title.clone(),
        _ => String::new(),
    };
    let mut blocks = Vec::new();
    for (number, block) in second.blocks.iter().enumerate() {
        let known = first.blocks.iter().position(|b| b.id == block.id);
        let known = known.filter(|k| {
            same(&first.blocks[*k], block)
                && loads(first, BlockId(*k)) == loads(second, BlockId(number))
        });
        let number = known.unwrap_or(scene.blocks.len());
        if known.is_none() {
            scene.blocks.push(block.clone());
        }
        blocks.push(BlockId(number));
    }
    let mut robots = Vec::new();
    for robot in &second.robots {
        let known = first.robots.iter().position(|r| r.id == robot.id);
        let number = known.unwrap_or(scene.robots.len());
        if known.is_none() {
            let mut robot = robot.clone();
            robot.holds = None;
            scene.robots.push(robot);
        }
        robots.push(RobotId(number));
    }
    let moved = Moved { blocks, robots };
    let new = |load: &&Load| moved.block(load.block).0 >= first.blocks.len();
    let more = second.loads.iter().filter(new).map(|load| Load {
        block: moved.block(load.block),
        ..*load
    });
    scene.loads.extend(more);
    let [title, later] = titles;
    let differences = differences(first, second);
    let mut frames = vec![
        first.frames[before.1].clone(),
        moved.frame(&second.frames[after.1]),
    ];
    frames[0].title = title;
    frames[1].title = match differences.is_empty() {
        true => later,
        false => format!("{later}: {}", differences.join(", ")),
    };
    scene.frames = frames;
    let found = vec![
        before.0.frames[before.1].clone(),
        moved.found(&after.0.frames[after.1]),
    ];
    Ok((scene, found))
}

/// What differs beside blocks, loads and robots, in words.
fn differences(first: &Scene, second: &Scene) -> Vec<String> {
    let mut words = Vec::new();
    let mut compare = |what: &str, a: f64, b: f64| {
        if (a - b).abs() > ALIKE * a.abs().max(b.abs()) {
            words.push(format!("{what} {b} in place of {a}"));
        }
    };
    compare("kernel", first.kernel, second.kernel);
    let rubs = |scene: &Scene| {
        let bodies = scene.blocks.iter().map(|b| &b.body);
        let mut all: Vec<f64> = bodies
            .chain(scene.ground.iter().map(|g| &g.body))
            .map(|body| body.friction)
            .collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let (a, b) = (rubs(first), rubs(second));
    match (&a[..], &b[..]) {
        ([a], [b]) => compare("friction", *a, *b),
        _ if a != b => words.push("other friction".into()),
        _ => {}
    }
    if first.corner_contacts != second.corner_contacts {
        let how = if second.corner_contacts {
            "with"
        } else {
            "without"
        };
        words.push(format!("{how} corner contacts"));
    }
    words
}

fn alike(a: &Polygon, b: &Polygon) -> bool {
    let reach = ALIKE * a.bounds().diagonal().max(b.bounds().diagonal());
    let (a, b) = (a.rings(), b.rings());
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| {
            a.len() == b.len() && a.iter().zip(b).all(|(p, q)| (p - q).norm() <= reach)
        })
}

fn same(a: &Block, b: &Block) -> bool {
    alike(&a.body.polygon, &b.body.polygon)
        && (a.weight - b.weight).abs() <= ALIKE * a.weight.max(b.weight)
}

/// The loads on a block, as numbers.
fn loads(scene: &Scene, block: BlockId) -> Vec<[f64; 5]> {
    let own = scene.loads.iter().filter(|l| l.block == block);
    own.map(|l| [l.force.x, l.force.y, l.at.x, l.at.y, l.torque])
        .collect()
}

/// Where the blocks and robots of the second scene are in the common one.
struct Moved {
    blocks: Vec<BlockId>,
    robots: Vec<RobotId>,
}

impl Moved {
    fn block(&self, id: BlockId) -> BlockId {
        self.blocks[id.0]
    }

    fn robot(&self, id: RobotId) -> RobotId {
        self.robots[id.0]
    }

    fn body(&self, id: BodyId) -> BodyId {
        match id {
            BodyId::Ground(_) => id,
            BodyId::Block(block) => BodyId::Block(self.block(block)),
        }
    }

    fn frame(&self, frame: &Frame) -> Frame {
        let mut frame = frame.clone();
        for id in &mut frame.placed {
            *id = self.block(*id);
        }
        for hold in &mut frame.holds {
            (hold.robot, hold.block) = (self.robot(hold.robot), self.block(hold.block));
        }
        for plan in &mut frame.plans {
            (plan.robot, plan.block) = (self.robot(plan.robot), self.block(plan.block));
        }
        frame
    }

    fn found(&self, found: &FrameAnalysis) -> FrameAnalysis {
        let mut found = found.clone();
        for Contact {
            interface,
            resultant,
            ..
        } in &mut found.contacts
        {
            interface.bodies = interface.bodies.map(|b| self.body(b));
            resultant.on = self.body(resultant.on);
        }
        for robot in &mut found.robots {
            (robot.robot, robot.block) = (self.robot(robot.robot), self.block(robot.block));
        }
        for failure in &mut found.failures {
            match failure {
                Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. } => {
                    *bodies = bodies.map(|b| self.body(b));
                }
                Failure::RobotForce { robot, block, .. }
                | Failure::RobotTorque { robot, block, .. } => {
                    (*robot, *block) = (self.robot(*robot), self.block(*block));
                }
            }
        }
        for block in &mut found.unsupported {
            *block = self.block(*block);
        }
        for motion in &mut found.mechanism {
            motion.block = self.block(motion.block);
        }
        // Of the changed numbers only what a comparison shows is carried over.
        found.margins = None;
        found
    }
}
