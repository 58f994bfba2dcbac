//! [`Draft`]: the elements of a drawing in metres with y up, before curves are flattened and names are made unique.

use super::affine::Affine;
use super::subpath::Subpath;
use crate::geometry::Point;

/// The elements of a drawing.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) title: String,
    /// The unit of the drawing in metres.
    pub(super) unit: f64,
    pub(super) parts: Vec<Part>,
    /// Sentences that explain how the drawing was read.
    pub(super) notes: Vec<String>,
    /// Elements that were not imported, or not exactly as drawn.
    pub(super) remarks: Vec<Remark>,
}

/// A message about an element that could not be imported exactly.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// The element of the drawing, for example `path "arch"` or `<rect> in line 12`; empty for the whole drawing.
    pub element: String,
    /// The message.
    pub message: String,
    /// The remedy; empty if there is none.
    pub help: String,
}

/// One element of a drawing.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) kind: Role,
    /// The name in the drawing, possibly empty or a duplicate.
    pub(super) name: String,
    /// A description by which the user finds the element in the drawing.
    pub(super) element: String,
    pub(super) form: PartGeometry,
    /// Outlines that cut this part, in metres with y up. Only what lies in all of them is part of the element.
    pub(super) clips: Vec<Subpath>,
    pub(super) fill: Option<[u8; 3]>,
    pub(super) values: Values,
}

/// The geometry of a part.
#[derive(Debug)]
pub(super) enum PartGeometry {
    /// The outlines of one element.
    Subpaths(Vec<Subpath>, FillRule),
    /// The grip point of a robot.
    Point(Point),
}

/// The rule that decides which regions several outlines enclose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FillRule {
    NonZero,
    EvenOdd,
}

/// The role of an element in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Block,
    Ground,
    Robot,
    /// The element is left out, because of its name or the option `--ignore`.
    Ignored,
}

/// Physical properties of an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Values {
    pub(super) friction: Option<f64>,
    pub(super) density: Option<f64>,
    pub(super) weight: Option<f64>,
}

impl Role {
    /// Returns the role of an element from the beginning of its name, in upper or lower case. `None` if no role
    /// follows from the name.
    pub(super) fn from_name(name: &str) -> Option<Role> {
        let begins = |with: &str| name.get(..with.len()).is_some_and(|start| start.eq_ignore_ascii_case(with));
        if begins("ground") {
            Some(Role::Ground)
        } else if begins("robot") {
            Some(Role::Robot)
        } else if begins("ignore") || begins("guide") {
            Some(Role::Ignored)
        } else {
            None
        }
    }
}

impl Draft {
    /// Turns the drawing upside down: y becomes −y.
    pub(super) fn flip(&mut self) {
        let map = Affine::scale(1.0, -1.0);
        for part in &mut self.parts {
            match &mut part.form {
                PartGeometry::Subpaths(subpaths, _) => {
                    subpaths.iter_mut().for_each(|subpath| *subpath = subpath.mapped(&map));
                }
                PartGeometry::Point(at) => *at = map.point(*at),
            }
        }
    }

    pub(super) fn remark(&mut self, element: impl Into<String>, message: impl Into<String>, help: impl Into<String>) {
        self.remarks.push(Remark { element: element.into(), message: message.into(), help: help.into() });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_role_follows_from_the_beginning_of_a_name() {
        for (name, kind) in [
            ("Ground", Some(Role::Ground)),
            ("robot-1", Some(Role::Robot)),
            ("guides", Some(Role::Ignored)),
            ("IGNORE me", Some(Role::Ignored)),
            ("underground", None),
            ("groun", None),
            ("gröund", None),
            ("", None),
        ] {
            assert_eq!(Role::from_name(name), kind, "{name}");
        }
    }
}
