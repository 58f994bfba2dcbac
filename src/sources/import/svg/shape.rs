//! Adds the shapes of an SVG to the draft, with their names, roles and fills.

use roxmltree::Node;
use svgtypes::{TransformListParser, TransformListToken};

use super::context::Context;
use super::style::Fill;
use super::walk::{MAX_CLIP_CORNERS, SvgWalk};
use super::{element, name};
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

    /// Returns the `transform` attribute of an element as an affine map. If it has an error, the error is reported and
    /// only the part before it is used.
    pub(super) fn transform(&mut self, node: Node<'a, 'd>, around: &Context) -> Affine {
        let mut map = Affine::IDENTITY;
        for token in TransformListParser::from(node.attribute("transform").unwrap_or("")) {
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
        map
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
