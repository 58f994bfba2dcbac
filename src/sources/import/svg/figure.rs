//! Imports the blocks, ground and robots of an SVG figure that drystone drew, but not the forces.

use roxmltree::{Node, NodeType};

use super::context::Context;
use super::element;
use super::style::Style;
use super::viewport::Viewport;
use super::walk::SvgWalk;
use super::xml::{is, words};
use crate::sources::import::draft::{FillRule, Part, PartGeometry, Role};
use crate::sources::import::subpath::{Affine, Subpath};

const SCALE_ATTRIBUTE: &str = "data-drystone-scale";
const ORIGIN_ATTRIBUTE: &str = "data-drystone-origin";

/// Returns the frames of a figure that drystone drew, in order. Returns `None` for other drawings.
pub(super) fn frames<'a, 'd>(root: Node<'a, 'd>) -> Option<Vec<Node<'a, 'd>>> {
    let found: Vec<Node<'a, 'd>> = root
        .descendants()
        .filter(|n| {
            n.node_type() == NodeType::Element && n.has_attribute(SCALE_ATTRIBUTE) && n.has_attribute(ORIGIN_ATTRIBUTE)
        })
        .collect();
    (!found.is_empty()).then_some(found)
}

/// Returns the map from the pixels of a frame to metres, with y up. `scale`, in metres per pixel, replaces the scale
/// that the figure contains.
fn frame_map(picture: Node<'_, '_>, scale: Option<f64>) -> Result<Affine, String> {
    let numbers = |name: &str| -> Option<Vec<f64>> {
        let text = picture.attribute(name)?;
        let all = text.split_whitespace().map(|t| t.parse::<f64>().ok().filter(|x| x.is_finite()));
        all.collect()
    };
    let (pixels, origin) = (numbers(SCALE_ATTRIBUTE), numbers(ORIGIN_ATTRIBUTE));
    let (Some([pixels]), Some([x, y])) = (pixels.as_deref(), origin.as_deref()) else {
        return Err(format!(
            "its {SCALE_ATTRIBUTE} and {ORIGIN_ATTRIBUTE} are not the three numbers that drystone writes; export the figure again"
        ));
    };
    let metres = scale.unwrap_or(1.0 / pixels);
    if !(metres.is_finite() && metres > 0.0) {
        return Err(format!("its {SCALE_ATTRIBUTE} is {pixels}"));
    }
    Ok(Affine([metres, 0.0, 0.0, -metres, -metres * x, metres * y]))
}

impl<'a, 'd> SvgWalk<'a, 'd> {
    /// Reads one frame of a figure; `frame` is counted from 0, and the default is the last frame. Returns an error
    /// message if there is no such frame, or if its scale cannot be read.
    pub(super) fn figure(
        &mut self,
        pictures: &[Node<'a, 'd>],
        scale: Option<f64>,
        frame: Option<usize>,
    ) -> Result<(), String> {
        let count = pictures.len();
        let number = frame.unwrap_or(count - 1);
        let Some(picture) = pictures.get(number).copied() else {
            let has = if count == 1 { "one frame".into() } else { format!("{count} frames") };
            return Err(format!("there is no frame {}: the figure has {has}", number + 1));
        };
        let map = frame_map(picture, scale)?;
        self.draft.unit = 1.0;
        let note = if count == 1 {
            "a figure by drystone".into()
        } else {
            format!("a figure by drystone; imported from frame {} of {count}", number + 1)
        };
        self.draft.notes.push(format!(
            "{note}: colours and arrows show forces and are not imported; weights, friction and limits are not in the figure"
        ));
        let viewport = Viewport { width: 0.0, height: 0.0, copied: (None, None) };
        let around = Context::of_page(map, Style::ROOT, viewport);
        self.read_groups(picture, &around);
        Ok(())
    }

    fn read_groups(&mut self, node: Node<'a, 'd>, around: &Context) {
        // Stop at this depth, because figures that drystone draws have no groups that are nested more deeply.
        if around.depth > 4 {
            return;
        }
        for child in node.children().filter(|n| is(*n, "g")) {
            // Apply the transform: the user may have moved groups in an editor.
            let around = Context {
                map: around.map.after(&self.transform(child, around)),
                depth: around.depth + 1,
                ..around.clone()
            };
            let title = child.children().find(|n| is(*n, "title")).map(words).unwrap_or_default();
            match child.attribute("class").unwrap_or("") {
                "ground" => {
                    // The paths without a fill are the hatching.
                    let paths = child.descendants().filter(|n| is(*n, "path") && n.attribute("fill") != Some("none"));
                    for path in paths {
                        self.add_body(path, &around, Role::Ground, "");
                    }
                }
                "blocks" => {
                    // Figures with very many blocks have one path for each colour, without names.
                    for path in child.children().filter(|n| is(*n, "path")) {
                        self.add_body(path, &around, Role::Block, "");
                    }
                    self.read_groups(child, &around);
                }
                "block" => {
                    let name = title.strip_prefix("Block ").unwrap_or(&title);
                    if let Some(path) = child.children().find(|n| is(*n, "path")) {
                        self.add_body(path, &around, Role::Block, name);
                    }
                }
                "robots" | "symbols" => self.read_groups(child, &around),
                "robot" => {
                    let name = title.strip_prefix("Robot ").unwrap_or(&title);
                    let name = name.split_once(" holds block ").map_or(name, |n| n.0);
                    if let Some(path) = child.children().find(|n| is(*n, "path")) {
                        self.add_body(path, &around, Role::Robot, name);
                    }
                }
                "plans" => {
                    for plan in child.children().filter(|n| is(*n, "g")) {
                        self.skip(plan, &around, "it is only planned in this frame");
                    }
                }
                _ => {}
            }
        }
    }

    fn add_body(&mut self, path: Node<'a, 'd>, around: &Context, kind: Role, name: &str) {
        let map = around.map.after(&self.transform(path, around));
        let element = match (kind, name) {
            (Role::Block, name) if !name.is_empty() => format!("block \"{name}\""),
            (Role::Robot, name) => format!("robot \"{name}\""),
            _ => self.lines.element(path),
        };
        match element::subpaths(path, around.viewport) {
            Ok(subpaths) => {
                // Open lines repeat the outline of a body in another colour.
                let outlines = subpaths.iter().filter(|subpath| subpath.closed);
                let mapped: Vec<Subpath> = outlines.map(|outline| outline.mapped(&map)).collect();
                if mapped.is_empty() {
                    return;
                }
                let form = PartGeometry::Subpaths(mapped, FillRule::NonZero);
                self.draft.parts.push(Part::new(Some(kind), name, element, form));
            }
            Err(why) => self.draft.lose("outline", &element, &why, ""),
        }
    }
}
