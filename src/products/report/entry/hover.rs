//! [`HoverTarget`]: the part of a figure that is highlighted together with a table row.

use crate::geometry::Point;
use crate::pictures::drawing::{Camera, Colour, Drawing, Group, Item, Outline, Path, Stroke};
use crate::text::line;

/// Width of a target for an interface, in pixels: wide enough to hit with a mouse.
const INTERFACE_TARGET_WIDTH: f64 = 10.0;
/// Radius of a target for a point, in pixels.
const POINT_TARGET_RADIUS: f64 = 11.0;

/// A part of a scene that a table row describes.
#[derive(Clone, Debug, PartialEq)]
pub struct HoverTarget {
    /// The id of the target, which is also the id of the table row.
    pub mark: String,
    /// The text of the tooltip: a description of the part with its numbers.
    pub words: String,
    /// The two end points of an interface, in metres. A target at a point has this point twice.
    pub ends: [Point; 2],
}

/// Makes a hover target for a point. Its coordinates are in metres.
pub(super) fn target(mark: String, words: &str, at: Point) -> HoverTarget {
    HoverTarget { mark, words: line(words), ends: [at, at] }
}

/// Returns a copy of the drawing with an invisible hover target for each of `touches`, on top of the scene. If the
/// drawing contains no scene, the copy is unchanged.
pub fn touched(drawing: &Drawing, touches: &[HoverTarget]) -> Drawing {
    let mut drawing = drawing.clone();
    onto_scene(&mut drawing, &|camera| {
        let marks = touches.iter().map(|touch| mark(touch, camera));
        Group { items: marks.map(Item::from).collect(), ..Group::with_class("touches") }
    });
    drawing
}

/// Draws marks on top of the first scene of a drawing. `marks` creates them from the camera of the scene.
pub(super) fn onto_scene(drawing: &mut Drawing, marks: &dyn Fn(&Camera) -> Group) {
    for item in &mut drawing.items {
        if let Item::Group(group) = item
            && add_to_scene(group, marks)
        {
            break;
        }
    }
}

/// Adds marks to the first group that shows a scene: `group` itself or a group inside it. Returns false if none of
/// these groups shows a scene.
fn add_to_scene(group: &mut Group, marks: &dyn Fn(&Camera) -> Group) -> bool {
    if let Some(camera) = group.camera {
        group.items.push(marks(&camera).into());
        return true;
    }
    group.items.iter_mut().any(|item| match item {
        Item::Group(inner) => add_to_scene(inner, marks),
        _ => false,
    })
}

/// Draws a hover target as an invisible shape with a tooltip.
fn mark(touch: &HoverTarget, camera: &Camera) -> Group {
    let [a, b] = touch.ends.map(|p| camera.place(p));
    let colour = Colour::hex(0x4479b4);
    let path = if a == b {
        Path::filled(Outline::circle(a, POINT_TARGET_RADIUS), colour)
    } else {
        Path::stroked(Outline::line([a, b]), Stroke::new(colour, INTERFACE_TARGET_WIDTH))
    };
    Group { id: Some(touch.mark.clone()), ..Group::with_class("touch").titled(touch.words.clone()) }
        .with(path.with_opacity(0.0))
}
