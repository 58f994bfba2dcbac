//! [`pair`]: joins a frame of one scene and a frame of another scene into one scene, so that a figure can compare them.
//!
//! Two blocks with the same name, outline, weight and loads become one block. If any of these differs, both blocks
//! are kept: the block of the first scene is absent from the second frame, and the block of the second scene is new
//! there.

use std::sync::Arc;

use super::{Analysis, Contact, Failure, FrameAnalysis};
use crate::geometry::Polygon;
use crate::mechanics::scene::{Block, BlockId, BodyId, CornerContacts, Frame, Load, RobotId, Scene};

/// Numbers that differ by at most this fraction are equal. For corners, the fraction is relative to the size of the
/// outline.
const EQUAL_TOL: f64 = 1e-9;

/// Joins two frames into one scene with two frames, and returns it with the results of both. `before` and `after` are
/// each an analysis and the number of a frame, from 0. `titles` are the titles of the frames. The second title also
/// lists how the scenes differ in kernel, friction and corner contacts.
///
/// # Errors
/// Returns a sentence for the user if the scenes differ in their ground, their direction of gravity or their listed
/// contacts.
pub fn pair(
    before: (&Analysis, usize),
    after: (&Analysis, usize),
    titles: [String; 2],
) -> Result<(Scene, Vec<Arc<FrameAnalysis>>), String> {
    let (first, second) = (before.0.at(before.1).scene, after.0.at(after.1).scene);
    // The common scene has only one ground, one direction of gravity and one list of contacts.
    check_ground_and_gravity(first, second)?;
    let mut scene = first.clone();
    if first.title != second.title {
        scene.title.clear();
    }
    let new_indices =
        NewIndices { blocks: add_blocks(&mut scene, first, second), robots: add_robots(&mut scene, second) };
    // A block that both scenes share has the same loads in both. Add the loads on new blocks.
    let new = |load: &&Load| new_indices.block(load.block).0 >= first.blocks.len();
    let entries = first.load_ids.len();
    let renamed = |load: &Load| Load { block: new_indices.block(load.block), entry: entries + load.entry, ..*load };
    let more = second.loads.iter().filter(new).map(renamed);
    scene.loads.extend(more);
    scene.load_ids.extend_from_slice(&second.load_ids);
    // Take one frame of each scene. The title of the second frame also lists how the scenes
    // differ in kernel, friction and corner contacts.
    let [title, later] = titles;
    let differences = differences(first, second);
    let mut frames = vec![first.frames[before.1].clone(), new_indices.frame(&second.frames[after.1])];
    frames[0].title = title;
    frames[1].title = if differences.is_empty() { later } else { format!("{later}: {}", differences.join(", ")) };
    scene.frames = frames;
    let found = vec![before.0.frames[before.1].clone(), new_indices.frame_analysis(&after.0.frames[after.1]).into()];
    Ok((scene, found))
}

/// Returns an error if two scenes differ in their ground, their direction of gravity or their listed contacts.
fn check_ground_and_gravity(first: &Scene, second: &Scene) -> Result<(), String> {
    if (first.down() - second.down()).norm() > EQUAL_TOL {
        return Err("the second scene has another direction of gravity; turn one of the two scenes".into());
    }
    if first.contacts != second.contacts {
        return Err("the second scene lists other contacts; compare scenes with the same contacts".into());
    }
    let mut parts = first.ground.iter().zip(&second.ground);
    let same = first.ground.len() == second.ground.len()
        && parts.all(|(a, b)| has_same_corners(&a.body.polygon, &b.body.polygon));
    if !same {
        return Err("the second scene has another ground; give both scenes the same ground, part by part".into());
    }
    Ok(())
}

/// Adds the blocks of the second scene that the first scene does not contain in the same form. Returns the index of
/// each block of the second scene in the common scene.
fn add_blocks(scene: &mut Scene, first: &Scene, second: &Scene) -> Vec<BlockId> {
    let mut ids = Vec::new();
    for (number, block) in second.blocks.iter().enumerate() {
        let known = first.blocks.iter().position(|b| b.id == block.id);
        let known = known.filter(|k| {
            is_same_block(&first.blocks[*k], block) && loads(first, BlockId(*k)) == loads(second, BlockId(number))
        });
        ids.push(BlockId(known.unwrap_or(scene.blocks.len())));
        if known.is_none() {
            scene.blocks.push(block.clone());
        }
    }
    ids
}

/// Adds the robots of the second scene whose names do not occur in the first scene. Returns the index of each robot of
/// the second scene in the common scene.
fn add_robots(scene: &mut Scene, second: &Scene) -> Vec<RobotId> {
    let first = scene.robots.len();
    let mut ids = Vec::new();
    for robot in &second.robots {
        let known = scene.robots[..first].iter().position(|r| r.id == robot.id);
        ids.push(RobotId(known.unwrap_or(scene.robots.len())));
        if known.is_none() {
            let mut robot = robot.clone();
            robot.holds = None;
            scene.robots.push(robot);
        }
    }
    ids
}

/// Lists the differences of two scenes in words: kernel, friction and corner contacts.
fn differences(first: &Scene, second: &Scene) -> Vec<String> {
    let mut words = Vec::new();
    let mut compare = |what: &str, a: f64, b: f64| {
        if (a - b).abs() > EQUAL_TOL * a.abs().max(b.abs()) {
            words.push(format!("{what} {b} in place of {a}"));
        }
    };
    compare("kernel", first.kernel, second.kernel);
    // Collect the different friction coefficients of all bodies of each scene, and compare them.
    let friction_coefficients = |scene: &Scene| {
        let bodies = scene.blocks.iter().map(|b| &b.body);
        let mut all: Vec<f64> = bodies.chain(scene.ground.iter().map(|g| &g.body)).map(|body| body.friction).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let (a, b) = (friction_coefficients(first), friction_coefficients(second));
    match (&a[..], &b[..]) {
        ([a], [b]) => compare("friction", *a, *b),
        _ if a != b => words.push("other friction".into()),
        _ => {}
    }
    if first.corner_contacts != second.corner_contacts {
        words.push(match second.corner_contacts {
            CornerContacts::At(_) => "corner contacts on edges".to_owned(),
            CornerContacts::All(true) => "with corner contacts".to_owned(),
            CornerContacts::All(false) => "without corner contacts".to_owned(),
        });
    }
    words
}

/// True if two polygons have the same corners in the same order, within `EQUAL_TOL` of their size.
fn has_same_corners(a: &Polygon, b: &Polygon) -> bool {
    let tolerance = EQUAL_TOL * a.bounds().diagonal().max(b.bounds().diagonal());
    let (a, b) = (a.rings(), b.rings());
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| a.len() == b.len() && a.iter().zip(b).all(|(p, q)| (p - q).norm() <= tolerance))
}

fn is_same_block(a: &Block, b: &Block) -> bool {
    has_same_corners(&a.body.polygon, &b.body.polygon)
        && (a.weight - b.weight).abs() <= EQUAL_TOL * a.weight.max(b.weight)
}

/// Returns the loads on a block, each as force x, force y (N), point x, point y (m) and torque (N·m).
fn loads(scene: &Scene, block: BlockId) -> Vec<[f64; 5]> {
    let own = scene.loads.iter().filter(|l| l.block == block);
    own.map(|l| [l.force.x, l.force.y, l.at.x, l.at.y, l.torque]).collect()
}

/// The indices in the common scene of the blocks and robots of the second scene.
struct NewIndices {
    blocks: Vec<BlockId>,
    robots: Vec<RobotId>,
}

impl NewIndices {
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

    fn frame_analysis(&self, found: &FrameAnalysis) -> FrameAnalysis {
        let mut found = found.clone();
        for Contact { interface, resultant, .. } in &mut found.contacts {
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
                Failure::RobotForce { robot, block, .. } | Failure::RobotTorque { robot, block, .. } => {
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
        // Leave out results that a comparison does not show.
        (found.margins, found.sensitivity, found.capacity) = (None, None, None);
        found.wedged = None;
        found
    }
}
