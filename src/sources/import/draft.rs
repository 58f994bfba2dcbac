//! [`Draft`]: the elements of a drawing in metres with y up, before curves are flattened and names are made unique;
//! [`Scale`], the length of its unit in metres.

use std::collections::BTreeMap;

use super::MAX_NAMES;
use super::subpath::{Affine, Subpath};
use crate::geometry::{Bounds, Point};
use crate::text::first_of;

/// The largest number of places that one remark lists.
const MAX_PLACES: usize = 3;

/// The elements of a drawing.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) title: String,
    /// The unit of the drawing in metres.
    pub(super) unit: f64,
    /// The page of the drawing, in metres.
    pub(super) page: Option<Bounds>,
    pub(super) parts: Vec<Part>,
    /// Sentences that explain how the drawing was read.
    pub(super) notes: Vec<String>,
    /// Elements that were not imported, or not exactly as drawn.
    pub(super) remarks: Vec<Remark>,
    /// How many elements of each kind are left out, such as 2 for `line`.
    pub(super) left_out: BTreeMap<&'static str, usize>,
    /// The elements that are left out on purpose, by the reason.
    pub(super) skipped: BTreeMap<String, Vec<String>>,
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
#[derive(Clone, Debug)]
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
    /// Open lines of one group are joined to outlines before lines of other groups are considered.
    pub(super) group: usize,
    /// Whether the part is the boundary of a hatch, whose outline may also be drawn.
    pub(super) is_fill: bool,
}

impl Remark {
    pub(super) fn new(element: impl Into<String>, message: impl Into<String>, help: impl Into<String>) -> Remark {
        Remark { element: element.into(), message: message.into(), help: help.into() }
    }
}

impl Part {
    /// Creates a part without clip paths, fill and values; without a role, it is a block.
    pub(super) fn new(kind: Option<Role>, name: &str, element: String, form: PartGeometry) -> Part {
        Part {
            kind: kind.unwrap_or(Role::Block),
            name: name.to_owned(),
            element,
            form,
            clips: Vec::new(),
            fill: None,
            values: Values::default(),
            group: 0,
            is_fill: false,
        }
    }

    /// Returns the outlines and lines; nothing for a point.
    pub(super) fn subpaths(&self) -> &[Subpath] {
        match &self.form {
            PartGeometry::Subpaths(subpaths, _) => subpaths,
            PartGeometry::Point(_) => &[],
        }
    }

    /// Returns the bounding box; `None` for a point.
    pub(super) fn around(&self) -> Option<Bounds> {
        Bounds::from_points(self.subpaths().iter().flat_map(Subpath::hull))
    }

    /// Keeps the outlines for which `is_kept` holds, and returns the number of the others.
    pub(super) fn retain(&mut self, is_kept: impl FnMut(&Subpath) -> bool) -> usize {
        let PartGeometry::Subpaths(subpaths, _) = &mut self.form else { return 0 };
        let before = subpaths.len();
        subpaths.retain(is_kept);
        before - subpaths.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.subpaths().is_empty() && !matches!(self.form, PartGeometry::Point(_))
    }
}

/// The geometry of a part.
#[derive(Clone, Debug)]
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
    /// Mass in kg.
    pub(super) mass: Option<f64>,
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
        self.remarks.push(Remark::new(element, message, help));
    }

    /// Reports an element that is left out, and counts it as one `what`, such as `line`.
    pub(super) fn lose(&mut self, what: &'static str, element: &str, why: &str, help: &str) {
        self.remark(element, format!("{why}; left out"), help);
        *self.left_out.entry(what).or_default() += 1;
    }

    /// Notes that an element is left out on purpose, because of its name, its layer or an option.
    pub(super) fn skip(&mut self, why: &str, element: String) {
        self.skipped.entry(why.to_owned()).or_default().push(element);
    }

    /// Returns the notes and remarks. Equal ones are one, with the first of their elements and the number of the others.
    pub(super) fn told(&mut self) -> (Vec<String>, Vec<Remark>) {
        let mut notes = std::mem::take(&mut self.notes);
        for (why, elements) in std::mem::take(&mut self.skipped) {
            notes.push(format!("left out, because {why}: {}", first_of(elements, MAX_NAMES)));
        }
        (notes, merged(std::mem::take(&mut self.remarks)))
    }
}

/// Merges remarks with the same message and help. The merged remark names the first of their elements, and counts the
/// others.
pub(super) fn merged(remarks: Vec<Remark>) -> Vec<Remark> {
    let mut places: BTreeMap<(String, String), usize> = BTreeMap::new();
    let mut kept: Vec<(Remark, Vec<String>)> = Vec::new();
    for remark in remarks {
        let place = *places.entry((remark.message.clone(), remark.help.clone())).or_insert(kept.len());
        match kept.get_mut(place) {
            Some((_, elements)) if elements.last() == Some(&remark.element) => {}
            Some((_, elements)) => elements.push(remark.element),
            None => kept.push((remark.clone(), vec![remark.element])),
        }
    }
    let one = |(remark, elements): (Remark, Vec<String>)| Remark { element: first_of(elements, MAX_PLACES), ..remark };
    kept.into_iter().map(one).collect()
}

/// The options for the size of the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scale {
    /// Metres per unit of the drawing.
    pub(super) metres: Option<f64>,
    /// Real lengths divided by drawn lengths: 50 for a drawing at 1:50.
    pub(super) ratio: Option<f64>,
}

impl Scale {
    /// Returns the number of metres per unit of the drawing, and a sentence that explains it. `stated` is the unit that
    /// the drawing states, in metres, with an explanation. `silent` is the explanation if the drawing states no unit.
    ///
    /// # Errors
    /// Returns a message if the options have only a ratio and the drawing states no unit.
    pub(super) fn of(self, stated: Option<(f64, String)>, silent: &str) -> Result<(f64, String), String> {
        let ratio = self.ratio.unwrap_or(1.0);
        let drawn_at =
            self.ratio.map_or(String::new(), |ratio| format!(" and the drawing is at 1:{}", six_digits(ratio)));
        let unit = |metres: f64| format!("a unit of the drawing is {} m", six_digits(metres));
        match (self.metres, stated) {
            (Some(metres), _) => {
                let metres = metres * ratio;
                Ok((metres, format!("{} (set by an option)", unit(metres))))
            }
            (None, Some((metres, reason))) => {
                let metres = metres * ratio;
                Ok((metres, format!("{}, because {reason}{drawn_at}", unit(metres))))
            }
            (None, None) if self.ratio.is_some() => Err(format!(
                "a scale of 1:{} needs the unit of the drawing, because {silent}; add --unit mm, cm, m, in or ft",
                six_digits(ratio)
            )),
            (None, None) => Ok((
                1.0,
                format!("a unit of the drawing is 1 m, because {silent}; --unit or --scale sets another unit"),
            )),
        }
    }
}

/// Returns a length as text with three significant digits.
pub(super) fn short(x: f64) -> String {
    rounded(format!("{x:.2e}"))
}

/// Returns a scale as text with six significant digits.
pub(super) fn six_digits(x: f64) -> String {
    rounded(format!("{x:.5e}"))
}

fn rounded(text: String) -> String {
    text.parse::<f64>().map_or(text, |x| x.to_string())
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
