//! [`Sketch`]: the bodies of a scene file that can be drawn, even if the scene is not valid, and the points at which
//! its problems lie.
//!
//! A sketch is only for drawing, not for analysis: outlines may cross, and bodies may overlap.

use std::borrow::Cow;

use super::format::{UnitsEntry, convert};
use super::problem::{Place, SCENE, SceneError};
use super::resolution::{self, SketchedBody};
use super::{BlockId, BodyId, Scene, finding, reading};
use crate::geometry::{Bounds, Point};
use crate::read::syntax;

/// The outlines of a scene file, and its problems. All coordinates are in the units of the file.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Sketch {
    /// The title of the scene; empty if it has none.
    pub title: String,
    /// Every body whose corners can be drawn, the ground first.
    pub bodies: Vec<SketchedBody>,
    /// The problems, in the order of the text; empty if the scene is valid.
    pub problems: SceneError,
    /// For each problem, its point in the drawing; `None` if the problem does not belong to a body that can be drawn.
    pub places: Vec<Option<Spot>>,
    /// The scene, if each of its bodies is valid, with lengths in the units of the file. The bodies may overlap.
    pub(crate) scene: Option<Scene>,
    /// The units of the file, in which all coordinates of the sketch are given.
    pub(crate) units: UnitsEntry,
}

/// The point of a drawing at which a problem lies.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Spot {
    /// The point, in the units of the file.
    pub at: Point,
    /// The bodies that have the problem.
    pub bodies: Vec<BodyId>,
}

impl Sketch {
    /// Reads the bytes of a scene file as a sketch. If `tolerance` is given, in metres, it replaces the contact
    /// tolerance of the file.
    ///
    /// # Example
    /// ```
    /// use drystone::scene::Sketch;
    /// let sketch = Sketch::from_bytes(br#"{ "drystone": 1, "blocks": [
    ///     { "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]] },
    ///     { "polygon": [[1, 0], [4, 0], [4, 1], [1, 1]] }] }"#, None);
    /// let place = sketch.places[0].as_ref().expect("the overlap has a place");
    /// assert_eq!((place.at.x, place.at.y), (1.5, 0.5));
    /// ```
    pub fn from_bytes(bytes: &[u8], tolerance: Option<f64>) -> Sketch {
        let mut sketch = Sketch {
            title: String::new(),
            bodies: Vec::new(),
            problems: SceneError::default(),
            places: Vec::new(),
            scene: None,
            units: UnitsEntry::default(),
        };
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        let text = String::from_utf8_lossy(bytes);
        match syntax::json(&text, &SCENE) {
            Ok(mut source) => {
                convert(&mut source);
                let (mut file, mut findings, unread) = reading::read(&source, &SCENE);
                file.tolerate(tolerance);
                sketch.units = file.units.unwrap_or_default();
                (sketch.bodies, sketch.scene) = resolution::sketch(&file, unread, &mut findings);
                sketch.title = file.title.unwrap_or_default();
                sketch.problems = finding::located(findings, Some(&source));
            }
            Err(broken) => sketch.problems = SceneError::broken(&text, broken),
        }
        if matches!(text, Cow::Owned(_)) {
            sketch.problems = reading::not_utf8(bytes);
        }
        sketch.places =
            (sketch.problems.list.iter()).map(|problem| sketch.spot(&problem.path, problem.place.as_ref())).collect();
        sketch
    }

    /// Returns the body with this id; `None` if the body cannot be drawn.
    pub fn body(&self, id: BodyId) -> Option<&SketchedBody> {
        self.bodies.iter().find(|body| body.id == id)
    }

    fn spot(&self, path: &str, place: Option<&Place>) -> Option<Spot> {
        let id = body_of(path)?;
        let body = self.body(id)?;
        let at = match place {
            Some(Place::Own(at)) => body.placement.place(*at),
            Some(Place::Between(at, _)) => *at,
            None => {
                let bounds = Bounds::from_points(body.rings.iter().flatten().copied())?;
                nalgebra::center(&bounds.min, &bounds.max)
            }
        };
        let other = match place {
            Some(Place::Between(_, other)) => Some(*other),
            _ => None,
        };
        Some(Spot { at, bodies: std::iter::once(id).chain(other).collect() })
    }
}

/// Returns the id of the body to which the value at a path such as `blocks[3].polygon[1]` belongs. `None` if the value
/// does not belong to a body.
fn body_of(path: &str) -> Option<BodyId> {
    let (list, rest) = path.split_once('[')?;
    let number = rest.split_once(']')?.0.parse().ok()?;
    match list {
        "blocks" => Some(BodyId::Block(BlockId(number))),
        "ground" => Some(BodyId::Ground(number)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crossing_is_reported_at_the_position_of_the_placed_body() {
        // A bow tie that crosses itself at (1, 1), rotated by a quarter turn and moved by (10, 0).
        let text = br#"{ "drystone": 1, "blocks": [{ "at": [10, 0], "angle": 90,
            "polygon": [[0, 0], [2, 2], [2, 0], [0, 2]] }] }"#;
        let sketch = Sketch::from_bytes(text, None);
        let spots: Vec<&Spot> = sketch.places.iter().flatten().collect();
        assert_eq!(spots.len(), 1, "{}", sketch.problems);
        assert!((spots[0].at - Point::new(9.0, 1.0)).norm() < 1e-12);
        assert_eq!(sketch.bodies[0].rings[0].len(), 4);
        assert!(sketch.scene.is_none());
    }

    #[test]
    fn unreadable_parts_do_not_prevent_a_drawing_of_the_rest() {
        let text = br#"{ "drystone": 1, "blocks": [{ "polygon": [[0, 0], [1, 0], [0, 1]], "wieght": 3 },
            { "id": "b", "polygon": "none" }, { "id": "c", "polygon": [[5, 5], [6, 5]] }] }"#;
        let sketch = Sketch::from_bytes(text, None);
        let names: Vec<&str> = sketch.bodies.iter().map(|b| b.name.as_str()).collect();
        assert_eq!(names, ["1", "c"]);
        assert_eq!(sketch.places.len(), sketch.problems.list.len());
        assert!(Sketch::from_bytes(b"{", None).bodies.is_empty());
        assert_eq!(Sketch::from_bytes(b"\xff", None).problems.list.len(), 1);
    }
}
