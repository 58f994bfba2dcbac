//! [`Excluded`]: for parameters with an empty interval, the motions that prove that the frame falls at every value.

use serde::Serialize;

use super::named::Named;
use super::{Motion, Number};
use crate::mechanics::analysis::{Exclusion, Interval, Intervals};
use crate::mechanics::scene::Scene;

/// The motions that exclude all values of a parameter. `None` if its interval is not empty; the key is then left out.
type Reasons<'a> = Option<Vec<Reason<'a>>>;

/// For each parameter whose interval is empty, the motions that exclude all its values.
#[derive(Serialize)]
pub(super) struct Excluded<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    friction: Reasons<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Reasons<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    horizontal_load: Reasons<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kernel: Reasons<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    load_factor: Reasons<'a>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    robots: Named<'a, Limits<'a>>,
}

#[derive(Serialize)]
struct Limits<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    fx: Reasons<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fy: Reasons<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    torque: Reasons<'a>,
}

/// An interval of values at which the frame falls by one motion. An end that is `null` has no limit.
#[derive(Serialize)]
struct Reason<'a> {
    from: Option<Number>,
    to: Option<Number>,
    mechanism: Vec<Motion<'a>>,
}

impl<'a> Excluded<'a> {
    /// Collects, for each parameter with an empty interval, the motions that exclude all its values. Returns `None`
    /// if no interval is empty.
    pub(super) fn new(scene: &'a Scene, intervals: &Intervals) -> Option<Excluded<'a>> {
        let of = |interval: &Option<Interval>| reasons(scene, interval.as_ref()?);
        let robots = intervals.robots.iter().filter_map(|robot| {
            let limits = Limits {
                fx: reasons(scene, &robot.fx),
                fy: reasons(scene, &robot.fy),
                torque: reasons(scene, &robot.torque),
            };
            let is_any = limits.fx.is_some() || limits.fy.is_some() || limits.torque.is_some();
            is_any.then(|| (scene.robots[robot.robot.0].id.as_str(), limits))
        });
        let excluded = Excluded {
            friction: of(&intervals.friction),
            tilt: of(&intervals.tilt),
            horizontal_load: of(&intervals.horizontal_load),
            kernel: of(&intervals.kernel),
            load_factor: of(&intervals.load_factor),
            robots: Named(robots.collect()),
        };
        let has_parameter =
            [&excluded.friction, &excluded.tilt, &excluded.horizontal_load, &excluded.kernel, &excluded.load_factor]
                .into_iter()
                .any(Option::is_some);
        (has_parameter || !excluded.robots.is_empty()).then_some(excluded)
    }
}

fn reasons<'a>(scene: &'a Scene, interval: &Interval) -> Reasons<'a> {
    let Interval::Empty(excluded) = interval else {
        return None;
    };
    let reason = |excluded: &Exclusion| Reason {
        from: excluded.from.map(Number),
        to: excluded.to.map(Number),
        mechanism: excluded.mechanism.iter().map(|m| Motion::new(scene, m)).collect(),
    };
    Some(excluded.iter().map(reason).collect())
}
