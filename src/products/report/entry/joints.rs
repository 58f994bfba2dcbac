//! [`Ranking`]: the joints of a frame that carry force, sorted by how near they are to opening or sliding. [`robots`]
//! makes the table of the robots, with their forces and the largest fraction of a limit that each of them uses.

use super::unit::Units;
use super::{Grid, HoverTarget, TableCell, hover};
use crate::mechanics::analysis::{Contact, Failure, FrameAnalysis, Verdict};
use crate::mechanics::scene::Unit;
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::mechanics::statics::interface::ContactKind;
use crate::products::wording::failure;
use crate::products::wording::number::percent;
use crate::text::line;

/// Largest number of joints in the table of a report that is not full.
const MAX_JOINTS: usize = 12;
/// Forces up to this fraction of the largest force at a joint count as rounding errors of the solver.
const FORCE_TOL: f64 = 1e-9;
/// Table cells with at least this utilisation are emphasised.
const HIGH_UTILISATION: f64 = 0.8;
/// Figures of frames with more joints have no hover targets, because the page would become too large.
const MAX_JOINTS_WITH_TARGETS: usize = 3000;

/// A joint that carries force, with its utilisation.
struct UsedJoint {
    /// The index of the contact in the frame.
    contact: usize,
    /// The distance of the resultant from the middle of the joint, m, and its ratio to the largest allowed distance.
    /// `None` for a corner or a joint of length 0.
    off_middle: Option<(f64, f64)>,
    /// The larger of the utilisations for opening and for sliding, 0 … 1.
    share: f64,
}

/// The joints of a frame that carry force, sorted by utilisation, the highest first.
pub(super) struct Ranking<'a> {
    scene: &'a Scene,
    frame_analysis: &'a FrameAnalysis,
    used: Vec<UsedJoint>,
    units: Units,
}

impl<'a> Ranking<'a> {
    pub fn new(scene: &'a Scene, frame_analysis: &'a FrameAnalysis) -> Ranking<'a> {
        let largest = frame_analysis.contacts.iter().map(size).fold(0.0, f64::max);
        let mut used: Vec<UsedJoint> = Vec::new();
        for (number, contact) in frame_analysis.contacts.iter().enumerate() {
            if size(contact) <= FORCE_TOL * largest {
                continue;
            }
            let off_middle = off_middle(contact, scene.kernel);
            let share = off_middle.map_or(0.0, |off| off.1).max(contact.friction_used);
            used.push(UsedJoint { contact: number, off_middle, share });
        }
        // Sort by utilisation, rounded to thousandths to remove rounding errors of the solver. If utilisations are
        // equal, the joint with the larger force comes first.
        let key = |u: &UsedJoint| (1e3 * u.share).round();
        used.sort_by(|a, b| {
            let force = |u: &UsedJoint| size(&frame_analysis.contacts[u.contact]);
            key(b).total_cmp(&key(a)).then(force(b).total_cmp(&force(a)))
        });
        Ranking { scene, frame_analysis, used, units: Units::new(scene, frame_analysis) }
    }

    /// Returns the governing block, for which the report lists all forces. It is a block at the largest failure or, if
    /// there are no failures, at the joint with the highest utilisation. If two blocks meet there, it is the heavier
    /// block. Returns `None` if there is no failure and no joint carries force.
    pub fn block(&self) -> Option<BlockId> {
        let bodies = match failure::by_amount(self.frame_analysis).first() {
            Some(Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. }) => *bodies,
            Some(Failure::RobotForce { block, .. } | Failure::RobotTorque { block, .. }) => {
                return Some(*block);
            }
            None => self.frame_analysis.contacts[self.used.first()?.contact].interface.bodies,
        };
        let blocks = bodies.iter().filter_map(|body| match body {
            BodyId::Block(block) => Some(*block),
            BodyId::Ground(_) => None,
        });
        blocks.max_by(|a, b| {
            let weight = |id: &BlockId| self.scene.blocks[id.0].weight;
            weight(a).total_cmp(&weight(b)).then(b.0.cmp(&a.0))
        })
    }

    /// Describes the joint with the highest utilisation: `v13 / v12: opening 100 %`. Returns `None` if no joint
    /// carries force.
    pub fn governing(&self) -> Option<String> {
        let first = self.used.first()?;
        let contact = &self.frame_analysis.contacts[first.contact];
        let why = match first.off_middle {
            Some((_, share)) if share >= contact.friction_used => {
                format!("opening {}", percent(share))
            }
            _ => format!("sliding {}", percent(contact.friction_used)),
        };
        Some(format!("{}: {why}", name(self.scene, contact)))
    }

    /// Makes the table of joints that carry force, with the highest utilisation first. If `all` is false, the table has
    /// only the first [`MAX_JOINTS`] joints.
    pub fn table(&self, all: bool) -> Grid {
        let shown: &[UsedJoint] = if all { &self.used } else { &self.used[..self.used.len().min(MAX_JOINTS)] };
        let contacts = || shown.iter().map(|u| &self.frame_analysis.contacts[u.contact]);
        let newtons = self.units.newtons(contacts().flat_map(|c| [normal(c), c.friction_force]));
        let positions = self.units.lengths(contacts().flat_map(|c| [c.resultant.at.x, c.resultant.at.y]));
        // Choose the decimals of the offsets from half the lengths of the joints, which are the largest possible
        // offsets.
        let offs = self.units.lengths(contacts().map(|c| 0.5 * c.interface.length()));
        let mut grid = Grid::new(
            if all { "All joints that carry force" } else { "" },
            &[
                "joint".to_owned(),
                positions.head("x"),
                positions.head("y"),
                newtons.head("normal N"),
                newtons.head("friction T"),
                offs.head("e"),
                "#opening".to_owned(),
                "#sliding".to_owned(),
            ],
        );
        for used in shown {
            let contact = &self.frame_analysis.contacts[used.contact];
            let at = contact.resultant.at;
            let (off, opening) = match used.off_middle {
                Some((off, share)) => (offs.write(off), share),
                None => ("corner".to_owned(), 0.0),
            };
            let share = |share: f64| TableCell::strong_if(share >= HIGH_UTILISATION, percent(share));
            let cells = [
                name(self.scene, contact).into(),
                positions.write(at.x).into(),
                positions.write(at.y).into(),
                newtons.write(normal(contact)).into(),
                newtons.write(contact.friction_force).into(),
                off.into(),
                share(opening),
                share(contact.friction_used),
            ];
            grid.add(format!("i{}", used.contact), cells);
        }
        grid
    }

    /// Explains the columns of the table of joints, and states how many joints the short table lists.
    pub fn words(&self) -> String {
        let count = self.frame_analysis.contacts.len();
        let shown = self.used.len().min(MAX_JOINTS);
        let kernel = match self.scene.kernel {
            0.0 => "",
            _ => " × (1 − kernel)",
        };
        let added = match self.frame_analysis.verdict {
            Verdict::Stable => "",
            Verdict::Unstable if self.frame_analysis.failures.is_empty() => "",
            Verdict::Unstable => " These forces are in equilibrium only together with the missing forces.",
            Verdict::Undecided => " These forces are not proved.",
        };
        format!(
            "{shown} of {count} joints, nearest to opening or sliding first. x, y: where the resultant acts; e: its distance from the middle. \
             Opening = 2 e / \
             (length of the joint{kernel}); sliding = |T| / (μ N). At 100 % the joint opens or slides.{added}"
        )
    }

    /// Returns the parts of a figure that have a tooltip: joints that carry force, robots and failures. The list is
    /// empty if the frame has more than [`MAX_JOINTS_WITH_TARGETS`] joints.
    pub fn touches(&self) -> Vec<HoverTarget> {
        if self.frame_analysis.contacts.len() > MAX_JOINTS_WITH_TARGETS {
            return Vec::new();
        }
        let newtons = self.units.newtons(self.frame_analysis.contacts.iter().map(normal));
        let joints = self.used.iter().map(|used| {
            let contact = &self.frame_analysis.contacts[used.contact];
            let mut words = format!(
                "{}: normal force {}, friction force {}, {} of the available friction used",
                name(self.scene, contact),
                newtons.with_unit(normal(contact)),
                newtons.with_unit(contact.friction_force.abs()),
                percent(contact.friction_used)
            );
            if let Some((_, share)) = used.off_middle {
                words.push_str(&format!(", opening {}", percent(share)));
            }
            HoverTarget { mark: format!("i{}", used.contact), words, ends: contact.interface.ends }
        });
        let robots = self.frame_analysis.robots.iter().enumerate().map(|(number, robot)| {
            let words = format!("robot {}", self.scene.robots[robot.robot.0].id);
            hover::target(format!("r{number}"), &words, robot.at)
        });
        let failures = self.frame_analysis.failures.iter().enumerate().map(|(number, failed)| {
            let words = format!("Failure: {}", missing(self.scene, failed, self.units));
            hover::target(format!("f{number}"), &words, failed.at())
        });
        joints.chain(robots).chain(failures).collect()
    }
}

/// Describes a failure in a sentence. Forces and torques are written in the units `units`.
pub(super) fn missing(scene: &Scene, failed: &Failure, units: Units) -> String {
    let write = |value: f64, unit: Unit| units.words(value, unit);
    failure::missing_sentence(scene, failed, &write)
}

/// Returns the magnitude of the force at a contact, N.
fn size(contact: &Contact) -> f64 {
    contact.resultant.force.norm()
}

/// Returns the normal force at a contact, N.
fn normal(contact: &Contact) -> f64 {
    contact.normal_forces[0] + contact.normal_forces[1]
}

/// Names a joint by its two bodies: `v3 / ground`.
pub(super) fn name(scene: &Scene, contact: &Contact) -> String {
    let [a, b] = contact.interface.bodies.map(|body| scene.name(body));
    line(&format!("{a} / {b}"))
}

/// Returns the distance of a resultant from the middle of its joint, m, and the ratio of this distance to the largest
/// allowed distance, at most 1. `kernel` is the safety kernel, which reduces the allowed distance. Returns `None` for a
/// corner or a joint of length 0.
fn off_middle(contact: &Contact, kernel: f64) -> Option<(f64, f64)> {
    let interface = &contact.interface;
    let half = 0.5 * interface.length() * (1.0 - kernel);
    if interface.kind == ContactKind::Corner || interface.length() <= 0.0 {
        return None;
    }
    let off = (contact.resultant.at - interface.middle()).dot(&interface.tangent()).abs();
    // With a kernel of 1, the allowed distance is 0, and the joint counts as fully used.
    let share = if half > 0.0 { (off / half).min(1.0) } else { 1.0 };
    Some((off, share))
}

/// Makes a table of the robots of a frame, with their forces and the largest fraction of a limit that each robot
/// uses.
pub(super) fn robots(scene: &Scene, frame_analysis: &FrameAnalysis) -> Grid {
    let forces = frame_analysis.robots.iter().flat_map(|r| [r.force.x, r.force.y]);
    let units = Units::new(scene, frame_analysis);
    let newtons = units.newtons(forces);
    let torques = units.torques(frame_analysis.robots.iter().map(|r| r.torque));
    let mut grid = Grid::new(
        "Robots",
        &[
            "robot".to_owned(),
            "holds".to_owned(),
            newtons.head("to the right"),
            newtons.head("up"),
            torques.head("torque"),
            "#limit used".to_owned(),
        ],
    );
    for (number, robot) in frame_analysis.robots.iter().enumerate() {
        let limits = scene.robots[robot.robot.0].limits;
        let limits = [limits.fx, limits.fy, limits.torque];
        let is_limited = limits.iter().any(|l| l.is_finite() && *l > 0.0);
        let used = if is_limited { percent(robot.limit_used) } else { "no limit".to_owned() };
        let cells = [
            line(&scene.robots[robot.robot.0].id),
            line(&scene.blocks[robot.block.0].id),
            newtons.write(robot.force.x),
            newtons.write(robot.force.y),
            torques.write(robot.torque),
            used,
        ];
        grid.add(format!("r{number}"), cells);
    }
    grid
}
