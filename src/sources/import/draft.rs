//! [`Draft`]: what a drawing shows, in metres with y up, before curves are cut and names are settled.

use super::track::Track;
use crate::geometry::Point;

/// What a drawing shows.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) title: String,
    pub(super) parts: Vec<Part>,
    /// What was understood, for the reader to agree with.
    pub(super) notes: Vec<String>,
    /// What was not, or only half.
    pub(super) remarks: Vec<Remark>,
}

/// Something that could not be taken as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// The element of the drawing, as `path "arch"` or `<rect> in line 12`; empty for the whole drawing.
    pub element: String,
    /// What was found.
    pub message: String,
    /// What to do about it; empty where nothing can be done.
    pub help: String,
}

/// One element of a drawing.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) kind: Role,
    /// The name it asks for, perhaps empty or used twice.
    pub(super) name: String,
    /// How a person finds it in the drawing.
    pub(super) element: String,
    pub(super) form: Form,
    pub(super) fill: Option<[u8; 3]>,
    pub(super) values: Values,
}

/// Where a part lies.
#[derive(Debug)]
pub(super) enum Form {
    /// Outlines, all of one element.
    Tracks(Vec<Track>, Rule),
    /// A place, for a robot.
    Spot(Point),
}

/// Which parts of a plane several outlines enclose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    NonZero,
    EvenOdd,
}

/// What an element is to become.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Block,
    Ground,
    Robot,
    /// Left out, as its name wants it.
    Ignored,
}

/// Numbers an element brings along.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Values {
    pub(super) friction: Option<f64>,
    pub(super) density: Option<f64>,
    pub(super) weight: Option<f64>,
}

impl Role {
    /// What a name asks for by its beginning, in upper or lower case.
    pub(super) fn from_name(name: &str) -> Option<Role> {
        let begins = |with: &str| {
            name.get(..with.len())
                .is_some_and(|start| start.eq_ignore_ascii_case(with))
        };
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
    pub(super) fn remark(
        &mut self,
        element: impl Into<String>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.remarks.push(Remark {
            element: element.into(),
            message: message.into(),
            help: help.into(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_what_things_are_by_their_beginning() {
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
