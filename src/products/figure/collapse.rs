//! [`sentence`]: describes a mechanism in words: which blocks turn or slide, and how many hinges there are.

use core::cell::RefCell;
use std::collections::BTreeSet;

use super::fall::{Fall, Joint};
use crate::mechanics::analysis::Motion;
use crate::mechanics::scene::{BlockId, BodyId};
use crate::pictures::drawing::text::NO_BREAK;
use crate::products::wording::number::{counted, listed};

/// Largest number of blocks of a body that are named.
const MAX_NAMED_BLOCKS: usize = 4;
/// If the speed due to rotation is at most this fraction of the speed of the body's fastest point, the text says that
/// the body slides or falls. A grip point counts as at rest if its speed is below this fraction.
const ROTATION_TOL: f64 = 0.02;

/// Returns the words after the verdict in a figure of a mechanism: how the blocks move.
pub(crate) fn sentence(fall: &Fall<'_>) -> String {
    let bodies = bodies(fall);
    if let [body] = &bodies[..] {
        return body.sentence.clone();
    }
    let hinges = fall.joints.iter().filter(|j| j.hinge.is_some()).count();
    let slips = fall.joints.iter().filter(|j| j.slip != 0.0).count();
    let counts = [(hinges, "hinge"), (slips, "sliding interface")].into_iter().filter(|c| c.0 > 0);
    let counts: Vec<String> = counts.map(|(count, what)| counted(count, what)).collect();
    let how = if counts.is_empty() { String::new() } else { format!(" with {}", listed(&counts)) };
    let moving: usize = bodies.iter().map(|body| body.blocks.len()).sum();
    let blocks = fall.scene.frames[fall.frame].placed.len();
    format!("{moving} of {blocks} blocks move as {} bodies{how}", bodies.len())
}

/// A rigid body that moves.
pub(crate) struct Body {
    pub blocks: Vec<BlockId>,
    /// A sentence about its motion: `blocks 4 and 5 slide on block 3`.
    pub sentence: String,
    /// The blocks that the sentence names.
    pub mentioned: Vec<BlockId>,
}

/// Returns the rigid bodies that move.
pub(crate) fn bodies(fall: &Fall<'_>) -> Vec<Body> {
    let bodies = fall.rigid_bodies();
    let one = |body: &Vec<Motion>| {
        let sentences = Sentences { fall, bodies: &bodies, mentioned: RefCell::default() };
        let sentence = sentences.body(body);
        Body { blocks: body.iter().map(|m| m.block).collect(), sentence, mentioned: sentences.mentioned.into_inner() }
    };
    bodies.iter().map(one).collect()
}

/// Writes the sentences about the rigid bodies of a mechanism.
struct Sentences<'a> {
    fall: &'a Fall<'a>,
    bodies: &'a [Vec<Motion>],
    mentioned: RefCell<Vec<BlockId>>,
}

impl Sentences<'_> {
    /// Describes the motion of one rigid body, such as `blocks 4 and 5 slide on block 3`.
    fn body(&self, body: &[Motion]) -> String {
        let scene = self.fall.scene;
        let names: Vec<String> = body.iter().map(|m| scene.blocks[m.block.0].id.clone()).collect();
        if names.len() <= MAX_NAMED_BLOCKS {
            self.mentioned.borrow_mut().extend(body.iter().map(|m| m.block));
        }
        let subject = match names.len() {
            1 => format!("block{NO_BREAK}{}", names[0]),
            n if n <= MAX_NAMED_BLOCKS => format!("blocks {}", listed(&names)),
            n => format!("{n} blocks"),
        };
        let (turns, slides, falls) =
            if body.len() == 1 { ("turns", "slides", "falls") } else { ("turn", "slide", "fall") };
        let fastest = body.iter().map(|m| m.fastest(scene)).fold(0.0, f64::max);
        let slip = self.joints_of(body).find(|j| j.0.slip != 0.0);
        if !self.turning(body, fastest) {
            return match slip {
                Some(_) => format!("{subject} {slides} on {}", self.slipped_on(body)),
                None => format!("{subject} {falls}"),
            };
        }
        if let Some(robot) = self.pinned(body, fastest) {
            return format!("{subject} {turns} about the grip of robot{NO_BREAK}{robot}");
        }
        let hinge = self.joints_of(body).find(|(joint, other)| {
            let still = !self.moves(*other);
            still && joint.slip == 0.0 && joint.hinge.is_some()
        });
        match (hinge, slip) {
            (Some((_, other)), _) => {
                // With a safety kernel, a block turns about a point inside its interface and not about a corner.
                let about = if scene.kernel > 0.0 { "hinge" } else { "corner" };
                let mut slips = self.joints_of(body).filter(|j| j.0.slip != 0.0);
                let also = match slips.find(|(_, support)| !self.moves(*support)) {
                    Some((_, support)) => format!(" and {slides} on {}", self.named(support)),
                    None => String::new(),
                };
                format!("{subject} {turns} about a {about} on {}{also}", self.named(other))
            }
            (None, Some(_)) => format!("{subject} {turns} and {slides} on {}", self.slipped_on(body)),
            (None, None) => format!("{subject} {turns}"),
        }
    }

    /// True if a body rotates fast enough for the text to say that it turns. `fastest` is the speed of the fastest
    /// point of the body.
    fn turning(&self, body: &[Motion], fastest: f64) -> bool {
        let scene = self.fall.scene;
        let turned = |m: &Motion| {
            let block = &scene.blocks[m.block.0];
            let corners = block.body.polygon.outline().iter();
            let reach = corners.map(|p| (p - block.centroid).norm());
            m.spin.abs() * reach.fold(0.0, f64::max)
        };
        body.iter().any(|m| turned(m) > ROTATION_TOL * fastest)
    }

    /// Returns the joints between a rigid body of the mechanism and the blocks or ground outside it, each with that
    /// block or ground. Joints to ground and to blocks at rest come first.
    fn joints_of(&self, body: &[Motion]) -> impl Iterator<Item = (&Joint, BodyId)> {
        let contacts = &self.fall.found.contacts;
        let within = |id: BodyId| matches!(id, BodyId::Block(b) if body.iter().any(|m| m.block == b));
        let mut joints: Vec<(&Joint, BodyId)> = Vec::new();
        for joint in &self.fall.joints {
            let [a, b] = contacts[joint.contact].interface.bodies;
            match (within(a), within(b)) {
                (true, false) => joints.push((joint, b)),
                (false, true) => joints.push((joint, a)),
                _ => {}
            }
        }
        joints.sort_by_key(|(_, other)| self.moves(*other));
        joints.into_iter()
    }

    /// Names what a rigid body slips on: the ground and blocks at rest or, if there are none, moving blocks.
    fn slipped_on(&self, body: &[Motion]) -> String {
        let slips = self.joints_of(body).filter(|(joint, _)| joint.slip != 0.0);
        let mut others: Vec<BodyId> = slips.map(|(_, other)| other).collect();
        if others.iter().any(|other| !self.moves(*other)) {
            others.retain(|other| !self.moves(*other));
        }
        let ground = others.iter().any(|other| matches!(other, BodyId::Ground(_)));
        let blocks = others.into_iter().filter_map(|other| if let BodyId::Block(id) = other { Some(id) } else { None });
        let mut blocks: Vec<BlockId> = blocks.collect();
        let mut known = BTreeSet::new();
        blocks.retain(|block| known.insert(*block));
        let names: Vec<String> = blocks.iter().map(|id| self.fall.scene.blocks[id.0].id.clone()).collect();
        if names.len() <= MAX_NAMED_BLOCKS {
            self.mentioned.borrow_mut().extend(blocks);
        }
        let blocks = match names.len() {
            0 => None,
            1 => Some(format!("block{NO_BREAK}{}", names[0])),
            n if n <= MAX_NAMED_BLOCKS => Some(format!("blocks {}", listed(&names))),
            n => Some(format!("{n} blocks")),
        };
        let ground = ground.then(|| "the ground".to_owned());
        let parts: Vec<String> = ground.into_iter().chain(blocks).collect();
        parts.join(" and ")
    }

    fn moves(&self, body: BodyId) -> bool {
        matches!(body, BodyId::Block(b) if self.bodies.iter().flatten().any(|m| m.block == b))
    }

    fn named(&self, body: BodyId) -> String {
        match body {
            BodyId::Ground(_) => "the ground".into(),
            BodyId::Block(block) => {
                self.mentioned.borrow_mut().push(block);
                format!("block{NO_BREAK}{}", self.fall.scene.name(body))
            }
        }
    }

    /// Returns the name of the robot about whose grip point a body turns. Returns `None` if the body does not turn
    /// about a grip point. `fastest` is the speed of the fastest point of the body.
    fn pinned(&self, body: &[Motion], fastest: f64) -> Option<&str> {
        let scene = self.fall.scene;
        let robots = &self.fall.found.robots;
        let holding = robots.iter().find(|robot| {
            body.iter().any(|m| m.block == robot.block && m.at(scene, robot.at).norm() < ROTATION_TOL * fastest)
        })?;
        Some(&scene.robots[holding.robot.0].id)
    }
}
