//! [`Ranking`]: the joints of a frame that carry force in the listed balance, sorted by how near they are to opening or
//! sliding. [`robots`] makes the table of the robots, with their forces and the largest fraction of a limit that each of them uses.

use super::unit::Units;
use super::{Grid, HoverTarget, TableCell, hover};
use crate::geometry::Point;
use crate::mechanics::analysis::{Contact, FrameAnalysis, SolvedFrame, Verdict};
use crate::mechanics::scene::{BodyId, Scene};
use crate::mechanics::statics::interface::ContactKind;
use crate::products::wording::failure;
use crate::products::wording::number::percent;
use crate::text::line;

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
    pub fn new(solved: SolvedFrame<'a>) -> Ranking<'a> {
        let SolvedFrame { scene, found: frame_analysis, .. } = solved;
        let largest = frame_analysis.largest_at_contacts();
        let mut used: Vec<UsedJoint> = Vec::new();
        for (number, contact) in frame_analysis.contacts.iter().enumerate() {
            if contact.amount() <= FORCE_TOL * largest {
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
            let force = |u: &UsedJoint| frame_analysis.contacts[u.contact].amount();
            key(b).total_cmp(&key(a)).then(force(b).total_cmp(&force(a)))
        });
        Ranking { scene, frame_analysis, used, units: Units::new(solved) }
    }

    /// Makes the table of all joints that carry force in the listed balance, with the highest utilisation first.
    pub fn table(&self) -> Grid {
        let contacts = || self.used.iter().map(|u| &self.frame_analysis.contacts[u.contact]);
        let newtons = self.units.newtons(contacts().flat_map(|c| [c.normal_force(), c.friction_force]));
        let positions = self.units.lengths(contacts().flat_map(|c| [c.resultant.at.x, c.resultant.at.y]));
        // Choose the decimals of the offsets from half the lengths of the joints, which are the largest possible
        // offsets.
        let offs = self.units.lengths(contacts().map(|c| 0.5 * c.interface.length()));
        let mut grid = Grid::new(
            "All joints that carry force in this balance, one of many possible: opening = 2 e / length of the joint, \
             sliding = |T| / (μ N)",
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
        for used in &self.used {
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
                newtons.write(contact.normal_force()).into(),
                newtons.write(contact.friction_force).into(),
                off.into(),
                share(opening),
                share(contact.friction_used),
            ];
            grid.add(format!("i{}", used.contact), cells);
        }
        grid
    }

    /// Returns the parts of a figure that have a tooltip: joints that carry force, robots and failures. The list is
    /// empty if the frame has more than [`MAX_JOINTS_WITH_TARGETS`] joints.
    pub fn touches(&self) -> Vec<HoverTarget> {
        if self.frame_analysis.contacts.len() > MAX_JOINTS_WITH_TARGETS {
            return Vec::new();
        }
        let newtons = self.units.newtons(self.frame_analysis.contacts.iter().map(Contact::normal_force));
        let joints = self.used.iter().map(|used| {
            let contact = &self.frame_analysis.contacts[used.contact];
            let mut words = format!(
                "{}: normal force {}, friction force {}, {} of the available friction used",
                name(self.scene, contact),
                newtons.with_unit(contact.normal_force()),
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
            let words = format!("Failure: {}", failure::missing_sentence(self.scene, failed));
            hover::target(format!("f{number}"), &words, failed.at())
        });
        joints.chain(robots).chain(failures).collect()
    }
}

/// Names a joint by its two bodies: `v3 / ground`.
pub(super) fn name(scene: &Scene, contact: &Contact) -> String {
    let [a, b] = contact.interface.bodies.map(|body| scene.name(body));
    line(&format!("{a} / {b}"))
}

/// Returns the distance of the resultant of a joint from one of its ends, the hinge, as a share of its length. `None` for
/// a corner or a joint of length 0.
pub(super) fn off_hinge(contact: &Contact, hinge: Point) -> Option<f64> {
    let interface = &contact.interface;
    let is_long = interface.kind != ContactKind::Corner && interface.length() > 0.0;
    let off = (contact.resultant.at - hinge).dot(&interface.tangent()).abs();
    is_long.then(|| (off / interface.length()).min(1.0))
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

/// If a structure has more base and bed joints than this, only a full report has their table.
const MAX_BASES: usize = 5;
/// A joint is a base or bed joint if its normal is at most this angle from the direction of gravity.
const MAX_BED_ANGLE: f64 = 45.0;

/// Makes a table of the pressures at the base and bed joints, those at the ground first, and a note. The note says whether
/// other balances of the loads may have other pressures. If there are more than [`MAX_BASES`] joints, the table is empty unless
/// the report is `full`.
pub(super) fn base_joints(solved: SolvedFrame<'_>, full: bool) -> (Grid, String) {
    let SolvedFrame { scene, number, found: frame_analysis, .. } = solved;
    let down = scene.down();
    let is_bed =
        |contact: &Contact| contact.interface.normal.dot(&down).abs() >= libm::cos(MAX_BED_ANGLE.to_radians()) - 1e-9;
    let pressing = frame_analysis.contacts.iter().enumerate().filter(|(_, contact)| contact.eccentricity().is_some());
    let mut beds: Vec<(usize, &Contact)> = pressing.filter(|(_, contact)| is_bed(contact)).collect();
    let is_base = |contact: &Contact| contact.interface.bodies.iter().any(|body| matches!(body, BodyId::Ground(_)));
    beds.sort_by_key(|(_, contact)| !is_base(contact));
    if beds.len() > MAX_BASES && !full {
        beds.clear();
    }
    let units = Units::new(solved);
    let contacts = || beds.iter().map(|(_, contact)| *contact);
    let newtons = units.newtons(contacts().map(Contact::normal_force));
    let offs = units.lengths(contacts().map(|contact| 0.5 * contact.interface.length()));
    let pressures = contacts().filter_map(|contact| contact.pressure(scene.thickness)).flatten();
    let stress = units.stresses(pressures);
    let heads = [
        "joint".to_owned(),
        newtons.head("normal N"),
        offs.head("e"),
        stress.head("pressure, left end"),
        stress.head("pressure, right end"),
        "resultant".to_owned(),
    ];
    let mut grid = Grid::new("", &heads);
    for (number, contact) in beds {
        let ends = contact.interface.ends;
        let pressure = contact
            .pressure(scene.thickness)
            .map(|[first, second]| if ends[0].x <= ends[1].x { [first, second] } else { [second, first] });
        let [left, right] =
            pressure.map_or(["–".to_owned(), "–".to_owned()], |both| both.map(|one| stress.write(one)));
        let third =
            if contact.is_in_middle_third() == Some(true) { "in the middle third" } else { "outside the middle third" };
        let off = contact.eccentricity().unwrap_or(0.0).abs();
        let cells = [
            name(scene, contact),
            newtons.write(contact.normal_force()),
            offs.write(off),
            left,
            right,
            third.to_owned(),
        ];
        grid.add(format!("i{number}"), cells);
    }
    // With as many joints as blocks, as in a stack, the loads determine all forces.
    let is_unique = frame_analysis.contacts.len() == scene.frames[number].placed.len()
        && frame_analysis.robots.is_empty()
        && frame_analysis.verdict == Verdict::Stable;
    let one = if is_unique { "" } else { " Other balances of the same loads may have other pressures." };
    let note = format!(
        "The pressure varies linearly, without tension; e is the distance of the resultant from the middle.{one}"
    );
    (grid, note)
}

/// Makes a table of the robots of a frame, with their forces and the largest fraction of a limit that each robot
/// uses.
pub(super) fn robots(solved: SolvedFrame<'_>) -> Grid {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let forces = frame_analysis.robots.iter().flat_map(|r| [r.force.x, r.force.y]);
    let units = Units::new(solved);
    let newtons = units.newtons(forces);
    let torques = units.torques(frame_analysis.robots.iter().map(|r| r.torque));
    let mut grid = Grid::new(
        "Robots",
        &[
            "robot".to_owned(),
            "holds".to_owned(),
            newtons.head("horizontal F_x"),
            newtons.head("vertical F_y"),
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
