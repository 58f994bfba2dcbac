//! [`stated`] lists the margins of a frame, each with the current value of its parameter.

use super::{Parameter, Position, StatedMargin};
use crate::mechanics::analysis::{FrameAnalysis, Interval, Intervals, Verdict};
use crate::mechanics::scene::Scene;
use crate::text;

/// Returns all computed margins of a frame. The most important margin, which the headline describes, comes first.
pub fn stated<'a>(scene: &Scene, frame_analysis: &'a FrameAnalysis) -> Vec<StatedMargin<'a>> {
    let Some(margins) = &frame_analysis.margins else {
        return Vec::new();
    };
    let intervals = &margins.intervals;
    let position = match frame_analysis.verdict {
        Verdict::Stable => Position::Inside,
        Verdict::Unstable => Position::Outside,
        Verdict::Undecided => Position::Unknown,
    };
    let mut list = whole_frame(scene, frame_analysis, intervals, position);
    list.extend(robot_limits(scene, intervals, position));
    if let Some(first) = headline(&list) {
        list[..=first].rotate_right(1);
    }
    list
}

/// Returns the computed margins that concern the whole frame: all except the limits of robots.
fn whole_frame<'a>(
    scene: &Scene,
    frame_analysis: &FrameAnalysis,
    intervals: &'a Intervals,
    position: Position,
) -> Vec<StatedMargin<'a>> {
    use Parameter::{Friction, HorizontalLoad, Kernel, LoadFactor, Tilt};
    let share = "horizontal load, as a share of the weights";
    let all = [
        (LoadFactor, "factor on the loads", &intervals.load_factor, 1.0),
        (Friction, "friction coefficient", &intervals.friction, 0.0),
        (Tilt, "tilt of gravity", &intervals.tilt, 0.0),
        (HorizontalLoad, share, &intervals.horizontal_load, 0.0),
        (Kernel, "safety kernel", &intervals.kernel, scene.kernel),
    ];
    let mut list = Vec::new();
    for (parameter, name, interval, present) in all {
        let Some(interval) = interval else {
            continue;
        };
        let mut margin =
            StatedMargin { parameter, name: name.to_owned(), interval, present: Some((present, present)), position };
        if parameter == Friction {
            margin.present = friction(frame_analysis);
            margin.position = friction_position(interval, margin.present, position);
        }
        list.push(margin);
    }
    list
}

/// Returns the margins for the force and torque limits of each robot.
fn robot_limits<'a>(scene: &Scene, intervals: &'a Intervals, position: Position) -> Vec<StatedMargin<'a>> {
    let force = Parameter::RobotForce(scene.units.force());
    let torque = Parameter::RobotTorque(scene.units.torque());
    let mut list = Vec::new();
    for robot in &intervals.robots {
        let arm = &scene.robots[robot.robot.0];
        let (id, limits) = (text::line(&arm.id), arm.limits);
        let all = [
            (force, "horizontal force", &robot.fx, limits.fx),
            (force, "vertical force", &robot.fy, limits.fy),
            (torque, "torque", &robot.torque, limits.torque),
        ];
        list.extend(all.map(|(parameter, name, interval, limit)| StatedMargin {
            parameter,
            name: format!("limit of the {name} of robot {id}"),
            interval,
            present: Some((limit, limit)),
            position,
        }));
    }
    list
}

/// Returns the index of the most important margin. This is the load factor if the list has it and the frame does not
/// carry every multiple of its loads. Otherwise it is the margin with the smallest [`StatedMargin::reserve`]. Returns
/// `None` for an empty list.
fn headline(list: &[StatedMargin<'_>]) -> Option<usize> {
    let loads = list.iter().position(|m| m.parameter == Parameter::LoadFactor && !m.has_no_limit());
    let reserves = list.iter().map(StatedMargin::reserve).enumerate();
    loads.or_else(|| reserves.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(first, _)| first))
}

/// Returns the smallest and the largest friction coefficient of the frame's interfaces, or `None` if there are no
/// interfaces.
pub(super) fn friction(frame_analysis: &FrameAnalysis) -> Option<(f64, f64)> {
    let all = frame_analysis.contacts.iter().map(|contact| contact.interface.friction);
    all.fold(None, |range, friction| match range {
        None => Some((friction, friction)),
        Some((low, high)) => Some((friction.min(low), friction.max(high))),
    })
}

/// Returns the position of the present friction coefficients relative to the interval of the friction margin. This
/// interval assumes one coefficient at all interfaces. `alike` is the result if all present coefficients are equal, or
/// if there are no interfaces.
fn friction_position(interval: &Interval, present: Option<(f64, f64)>, alike: Position) -> Position {
    match present {
        Some((low, high)) if low < high => match (interval.contains(low), interval.contains(high)) {
            (true, true) => Position::Inside,
            (false, false) if !matches!(interval, Interval::Undecided) => Position::Outside,
            _ => Position::Unknown,
        },
        _ => alike,
    }
}
