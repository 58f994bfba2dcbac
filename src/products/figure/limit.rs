//! Finds the joints and robots that are at a limit in the forces that a figure shows, and provides their symbols and
//! texts. A joint is at its limit if all its friction is used, or if the resultant acts at an end of the interface.

use super::bearing::{Bearing, bearings};
use super::words::FULL_UTILISATION;
use crate::mechanics::analysis::{Contact, FrameAnalysis, RobotForce, Verdict};
use crate::mechanics::scene::{RobotId, Scene};
use crate::mechanics::statics::interface::ContactKind;
use crate::pictures::drawing::{Item, Outline, PagePoint, Path, Theme};

/// A resultant acts at the edge if its distance from an end of the joint is at most this fraction of the joint's
/// length.
const EDGE_TOL: f64 = 0.01;

/// How near a joint is to its two limits: sliding, and opening at an end. Each value is 1 at the limit.
struct Nearness<'a> {
    contact: &'a Contact,
    /// The used fraction of the available friction; 0 if no friction is available.
    friction: f64,
    /// The distance of the resultant from the middle of the interface, as a fraction of the distance from the middle to
    /// an end; 0 for a contact at a corner.
    edge: f64,
}

impl Nearness<'_> {
    fn reached(&self) -> bool {
        self.friction >= FULL_UTILISATION || self.edge >= 1.0 - 2.0 * EDGE_TOL
    }

    /// Returns the larger of the two values.
    fn share(&self) -> f64 {
        self.friction.max(self.edge)
    }
}

/// Returns how near each joint that transmits a force is to its limits. The list is empty if the verdict of the frame
/// is not stable.
fn nearness<'a>(scene: &Scene, frame_analysis: &'a FrameAnalysis) -> Vec<Nearness<'a>> {
    if frame_analysis.verdict != Verdict::Stable {
        return Vec::new();
    }
    let bearings = bearings(scene, frame_analysis);
    let pressed = frame_analysis.contacts.iter().zip(bearings);
    let near = |(contact, bearing): (&'a Contact, Option<Bearing>)| {
        let friction = bearing?.friction.unwrap_or(0.0);
        let [from, to] = contact.interface.ends;
        let at = contact.resultant.at;
        let off = ((at - from).norm() - (at - to).norm()).abs();
        let edge = match contact.interface.kind {
            ContactKind::Corner => 0.0,
            _ => off / contact.interface.length(),
        };
        Some(Nearness { contact, friction, edge })
    };
    pressed.filter_map(near).collect()
}

/// Returns the joints of a frame that are at their limit. The list is empty if the frame does not stand.
pub(crate) fn reached<'a>(scene: &Scene, frame_analysis: &'a FrameAnalysis) -> Vec<&'a Contact> {
    let all = nearest(scene, frame_analysis).into_iter();
    all.filter(Nearness::reached).map(|n| n.contact).collect()
}

/// True if at least one limit of a robot, for a force or a torque, is finite and larger than 0.
pub(crate) fn has_limits(scene: &Scene, robot: RobotId) -> bool {
    let limits = scene.robots[robot.0].limits;
    let finite = |limit: f64| limit.is_finite() && limit > 0.0;
    finite(limits.fx) || finite(limits.fy) || finite(limits.torque)
}

/// Returns the robots whose force or torque reaches one of their limits in a frame. The list is empty if the frame does
/// not stand.
pub(crate) fn robots_reached<'a>(scene: &Scene, frame_analysis: &'a FrameAnalysis) -> Vec<&'a RobotForce> {
    let stands = frame_analysis.verdict == Verdict::Stable;
    let robots = frame_analysis.robots.iter().filter(|_| stands);
    let reached = robots.filter(|r| r.limit_used >= FULL_UTILISATION);
    reached.filter(|r| has_limits(scene, r.robot)).collect()
}

/// Two values of [`Nearness::share`] count as equal if their relative difference is below this.
const EQUAL_SHARE_TOL: f64 = 1e-6;

/// Least value of [`Nearness::share`] for which a joint is named. A smaller value would be shown as 0 % or be
/// numerical noise.
const MIN_NAMED_SHARE: f64 = 0.01;

/// Returns the joints that are at their limit. If none is, returns the joint that is nearest to one of its limits; no
/// joint if the value [`Nearness::share`] of every joint is below [`MIN_NAMED_SHARE`]. Marks and texts use this list.
fn nearest<'a>(scene: &Scene, frame_analysis: &'a FrameAnalysis) -> Vec<Nearness<'a>> {
    let (reached, others): (Vec<_>, Vec<_>) = nearness(scene, frame_analysis).into_iter().partition(Nearness::reached);
    if !reached.is_empty() {
        return reached;
    }
    // If several joints are equally near to their limits except for rounding, take the first, so that rounding errors
    // do not change the result.
    let farther = |a: &Nearness, b: &Nearness| b.share() > (1.0 + EQUAL_SHARE_TOL) * a.share();
    let nearest = others.into_iter().reduce(|a, b| if farther(&a, &b) { b } else { a });
    nearest.filter(|n| n.share() >= MIN_NAMED_SHARE).into_iter().collect()
}

/// Least distance from the centre of a diamond to its corners, pixels.
const LEAST_DIAMOND: f64 = 2.9;

/// Returns the symbol of a joint or a robot at its limit: a filled diamond. For the meaning of `radius`, see [`reach`].
pub(crate) fn symbol(at: PagePoint, radius: f64, theme: &Theme) -> Path {
    Path::filled(diamond(at, reach(radius)), theme.ink).cased(theme.page, 0.35 * radius)
}

/// Returns the distance from the centre of a diamond to its corners, in pixels. This is 1.5 times `radius` (pixels),
/// but at least [`LEAST_DIAMOND`], so that a diamond is visible in a small picture.
pub(crate) fn reach(radius: f64) -> f64 {
    (1.5 * radius).max(LEAST_DIAMOND)
}

fn diamond(at: PagePoint, r: f64) -> Outline {
    let corners = [(0.0, -r), (r, 0.0), (0.0, r), (-r, 0.0)];
    Outline::ring(corners.map(|(x, y)| at.moved(x, y)))
}

/// Draws the symbol of a joint at its limit for the legend.
pub(crate) fn key_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![symbol(at.moved(5.5, 0.0), 3.2, theme).into()]
}

/// The legend text for filled diamonds at joints.
pub(crate) const LEGEND_TEXT: &str = "joint at its limit: friction used up, or force at the edge";
/// A shorter form of [`LEGEND_TEXT`], for a page as narrow as a column of print.
pub(crate) const SHORT_LEGEND_TEXT: &str = "joint at its limit";
/// The legend text for filled diamonds on the discs of robots.
pub(crate) const ROBOT_LEGEND_TEXT: &str = "robot at its limit";
/// The legend text if filled diamonds occur on joints and on robots.
pub(crate) const JOINT_AND_ROBOT_LEGEND_TEXT: &str =
    "robot at its limit, or joint: friction used up, or force at the edge";
/// A shorter form of [`JOINT_AND_ROBOT_LEGEND_TEXT`], for a page as narrow as a column of print.
pub(crate) const SHORT_JOINT_AND_ROBOT_LEGEND_TEXT: &str = "joint or robot at its limit";
