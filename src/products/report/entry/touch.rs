//! [`HoverTarget`]: what of a figure belongs to a line of a table, for a mouse that hovers over either.

use crate::drawing::{Camera, Colour, Drawing, Group, Item, Outline, Path, Stroke};
use crate::geometry::Point;

/// Width of a mark, pixels: as wide as a mouse can find.
const WIDTH: f64 = 10.0;
/// Radius of the mark of a point, pixels.
const RADIUS: f64 = 11.0;

/// A part of a scene that a line of a table tells of.
#[derive(Clone, Debug, PartialEq)]
pub struct HoverTarget {
    /// Its name, as of the line.
    pub mark: String,
    /// Its numbers in words.
    pub words: String,
    /// The ends of an interface, or a point twice; metres.
    pub ends: [Point; 2],
}

/// A drawing with an invisible mark over each of some parts of its scene, on top of everything. Nothing is added to a
/// drawing that shows no scene.
pub fn touched(drawing: &Drawing, touches: &[HoverTarget]) -> Drawing {
    let mut drawing = drawing.clone();
    onto_scene(&mut drawing, &|camera| {
        let marks = touches.iter().map(|touch| mark(touch, camera));
        Group {
            items: marks.map(Item::from).collect(),
            ..Group::with_class("touches")
        }
    });
    drawing
}

/// Lays marks over the first scene that a drawing shows.
pub(super) fn onto_scene(drawing: &mut Drawing, marks: &dyn Fn(&Camera) -> Group) {
    for item in &mut drawing.items {
        if let Item::Group(group) = item
            && laid(group, marks)
        {
            break;
        }
    }
}

/// Lays marks over the first group that shows a scene, and says whether there was one.
fn laid(group: &mut Group, marks: &dyn Fn(&Camera) -> Group) -> bool {
    if let Some(camera) = group.camera {
        group.items.push(marks(&camera).into());
        return true;
    }
    group.items.iter_mut().any(|item| match item {
        Item::Group(inner) => laid(inner, marks),
        _ => false,
    })
}

fn mark(touch: &HoverTarget, camera: &Camera) -> Group {
    let [a, b] = touch.ends.map(|p| camera.place(p));
    let colour = Colour::hex(0x4479b4);
    let path = if a == b {
        Path::filled(Outline::circle(a, RADIUS), colour)
    } else {
        Path::stroked(Outline::line([a, b]), Stroke::new(colour, WIDTH))
    };
    Group {
        id: Some(touch.mark.clone()),
        ..Group::with_class("touch").titled(touch.words.clone())
    }
    .with(path.with_opacity(0.0))
}
