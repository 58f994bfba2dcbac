//! Margins as JSON: a number, `null` where a frame falls at any value, `"unbounded"` where it stands at any.
//!
//! A tilt of `null` says that the frame falls unturned; it may stand turned. A margin that no verdict confirms is `null` as
//! well, and a notice of the frame says between which values it lies. What was not asked for is absent.

use serde::{Serialize, Serializer};

use super::{Motion, Number};
use crate::analysis::{Margin, Margins as Found, Sides as Either};
use crate::scene::Scene;

#[derive(Serialize)]
pub(super) struct Margins<'a> {
    #[serde(skip_serializing_if = "End::is_left_out")]
    friction: End,
    #[serde(skip_serializing_if = "Sides::is_left_out")]
    tilt: Sides<End>,
    #[serde(skip_serializing_if = "Sides::is_left_out")]
    horizontal_load: Sides<End>,
    #[serde(skip_serializing_if = "End::is_left_out")]
    kernel: End,
    #[serde(skip_serializing_if = "End::is_left_out")]
    load_factor: End,
    robots: Named<'a, Limits<End>>,
    mechanisms: Mechanisms<'a>,
}

/// How the blocks begin to move just beyond each edge.
#[derive(Serialize)]
struct Mechanisms<'a> {
    friction: Vec<Motion<'a>>,
    tilt: Sides<Vec<Motion<'a>>>,
    horizontal_load: Sides<Vec<Motion<'a>>>,
    kernel: Vec<Motion<'a>>,
    load_factor: Vec<Motion<'a>>,
    robots: Named<'a, Limits<Vec<Motion<'a>>>>,
}

#[derive(Serialize)]
struct Sides<T> {
    left: T,
    right: T,
}

#[derive(Serialize)]
struct Limits<T> {
    fx: T,
    fy: T,
    torque: T,
}

#[derive(Serialize)]
#[serde(untagged)]
enum End {
    At(Number),
    None,
    Unbounded(&'static str),
    /// Left out of the object.
    NotAsked,
}

impl End {
    fn is_left_out(&self) -> bool {
        matches!(self, End::NotAsked)
    }
}

impl Sides<End> {
    fn is_left_out(&self) -> bool {
        self.left.is_left_out()
    }
}

/// An object whose keys stand in the order of the list.
struct Named<'a, T>(Vec<(&'a str, T)>);

impl<T: Serialize> Serialize for Named<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl<'a> Margins<'a> {
    pub(super) fn new(scene: &'a Scene, found: &Found) -> Margins<'a> {
        let motions = |margin: &Margin| match margin {
            Margin::Value { mechanism, .. } => {
                mechanism.iter().map(|m| Motion::new(scene, m)).collect()
            }
            _ => Vec::new(),
        };
        Margins {
            friction: end(&found.friction),
            tilt: sides(&found.tilt, end),
            horizontal_load: sides(&found.horizontal_load, end),
            kernel: end(&found.kernel),
            load_factor: end(&found.load_factor),
            robots: robots(scene, found, end),
            mechanisms: Mechanisms {
                friction: motions(&found.friction),
                tilt: sides(&found.tilt, motions),
                horizontal_load: sides(&found.horizontal_load, motions),
                kernel: motions(&found.kernel),
                load_factor: motions(&found.load_factor),
                robots: robots(scene, found, motions),
            },
        }
    }
}

fn end(margin: &Margin) -> End {
    match margin {
        Margin::Value { at, .. } => End::At(Number(*at)),
        Margin::None | Margin::Unconfirmed { .. } => End::None,
        Margin::NotAsked => End::NotAsked,
        Margin::Unbounded => End::Unbounded("unbounded"),
    }
}

fn sides<T>(of: &Either, described: impl Fn(&Margin) -> T) -> Sides<T> {
    Sides {
        left: described(&of.left),
        right: described(&of.right),
    }
}

fn robots<'a, T>(
    scene: &'a Scene,
    found: &Found,
    described: impl Fn(&Margin) -> T,
) -> Named<'a, Limits<T>> {
    let robots = found.robots.iter().map(|robot| {
        let limits = Limits {
            fx: described(&robot.fx),
            fy: described(&robot.fy),
            torque: described(&robot.torque),
        };
        (scene.robots[robot.robot.0].id.as_str(), limits)
    });
    Named(robots.collect())
}
