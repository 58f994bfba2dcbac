//! Adds the shapes of an SVG to the draft, with their names, roles and fills.

use roxmltree::Node;
use svgtypes::{TransformListParser, TransformListToken};

use super::context::Context;
use super::style::Fill;
use super::walk::{MAX_CLIP_CORNERS, SvgWalk};
use super::{element, name, style};
use crate::sources::import::draft::{Part, PartGeometry};
use crate::sources::import::limit::MAX_BODIES;
use crate::sources::import::subpath::Affine;

impl<'a, 'd> SvgWalk<'a, 'd> {
    /// Adds a shape to the draft, in metres. A hidden shape is left out, and a shape that cannot be read is reported.
    pub(super) fn shape(&mut self, node: Node<'a, 'd>, around: &Context) {
        if !around.style.visible {
            self.skip(node, around, "it is hidden");
            return;
        }
        let subpaths = match element::subpaths(node, around.viewport) {
            Ok(subpaths) => subpaths,
            Err(why) => {
                self.lose("outline", node, around, &why, "");
                return;
            }
        };
        let fill = self.fill(node, around);
        if self.draft.parts.len() >= MAX_BODIES {
            self.more += 1;
            return;
        }
        self.clip_corners += around.clips.iter().map(|clip| clip.segments.len()).sum::<usize>();
        if self.clip_corners > MAX_CLIP_CORNERS {
            return;
        }
        let mapped = subpaths.iter().map(|t| t.mapped(&around.map)).collect();
        let (name, element) = (shape_name(node, around), self.element_label(node, around));
        let form = PartGeometry::Subpaths(mapped, around.style.rule);
        let part = Part::new(around.kind, &name, element, form);
        self.draft.parts.push(Part { clips: around.clips.clone(), fill, ..part });
    }

    /// Returns the fill colour of a shape. `None` if the drawing specifies no fill colour. A fill that cannot be a
    /// material is reported, and the result is also `None`.
    fn fill(&mut self, node: Node<'a, 'd>, around: &Context) -> Option<[u8; 3]> {
        let (why, help) = match around.style.fill {
            Fill::Colour(fill) => return Some(fill),
            Fill::Unspecified | Fill::None => return None,
            Fill::Paint => {
                ("a gradient or pattern cannot become a material; the fill is not imported", "use one colour")
            }
            Fill::Unknown => ("its fill is not a valid colour; it is not imported", "write it as #rrggbb"),
        };
        self.remark(node, around, why, help);
        None
    }

    /// Returns the transform of an element as an affine map, from an attribute or a style. If it has an error, the error
    /// is reported and only the part before it is used.
    pub(super) fn transform(&mut self, node: Node<'a, 'd>, around: &Context) -> Affine {
        let is_styled = self.moves || node.attribute("style").is_some_and(|style| style.contains("transform"));
        let value = |name: &str| match is_styled {
            true => style::declared(node, &self.sheet, name),
            false => node.attribute(name),
        };
        let (transform, origin) = (value("transform").unwrap_or("").trim(), value("transform-origin"));
        let fills_box = value("transform-box").is_some_and(|of| !matches!(of.trim(), "view-box" | "border-box"));
        if matches!(transform, "" | "none") {
            return Affine::IDENTITY;
        }
        // Lengths and angles of styles have units.
        let transform = ["px", "deg"].iter().fold(transform.to_owned(), |text, unit| text.replace(unit, ""));
        let place = |text: &str| {
            let numbers = text.split_whitespace().map(|number| number.trim_end_matches("px").parse::<f64>());
            match numbers.collect::<Result<Vec<f64>, _>>().ok()?[..] {
                [x, y, ..] => Some([x, y]),
                _ => None,
            }
        };
        let [x, y] = match origin.map(place) {
            Some(place) if place.is_none() || fills_box => {
                let why = "its transform has an origin that is not two numbers; the origin 0 0 is used";
                self.remark(node, around, why, "apply the transform to the shape, for example by ungrouping it");
                [0.0; 2]
            }
            place => place.flatten().unwrap_or_default(),
        };
        let mut map = Affine::translation(x, y);
        for token in TransformListParser::from(transform.as_str()) {
            let Ok(token) = token else {
                let why = "its transform cannot be read completely; the part before the error is used";
                self.remark(node, around, why, "");
                break;
            };
            map = map.after(&match token {
                TransformListToken::Matrix { a, b, c, d, e, f } => Affine([a, b, c, d, e, f]),
                TransformListToken::Translate { tx, ty } => Affine::translation(tx, ty),
                TransformListToken::Scale { sx, sy } => Affine::scale(sx, sy),
                TransformListToken::Rotate { angle } => Affine::rotation(angle),
                TransformListToken::SkewX { angle } => Affine([1.0, 0.0, libm::tan(angle.to_radians()), 1.0, 0.0, 0.0]),
                TransformListToken::SkewY { angle } => Affine([1.0, libm::tan(angle.to_radians()), 0.0, 1.0, 0.0, 0.0]),
            });
        }
        map.after(&Affine::translation(-x, -y))
    }
}

/// Returns the name of a shape. This is the first of the following that exists: the name of the `<use>` element that
/// copies it, its own name, the name of its group, its id.
fn shape_name(node: Node<'_, '_>, around: &Context) -> String {
    let copied = around.copy.as_ref().and_then(|c| c.name.clone());
    copied
        .or_else(|| name::user_name(node))
        .or_else(|| around.group.clone())
        .or_else(|| name::any_name(node))
        .unwrap_or_default()
}
