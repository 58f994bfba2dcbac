//! Draws contacts that the scene file lists one by one, with their normals and friction cones. Also draws the centres
//! of blocks without an outline.

use super::Pen;
use crate::geometry::{Point, Vector};
use crate::pictures::drawing::{Group, Outline, Path, Stroke};

/// Length of a normal in unit lengths. The friction cone has the same length.
const NORMAL_LENGTH: f64 = 0.75;
/// Length of the head of a normal, as a fraction of the normal.
const HEAD_SHARE: f64 = 0.18;
/// Radius of the dot of a contact or a centre, pixels.
const DOT_RADIUS: f64 = 2.2;

impl Pen<'_> {
    /// Draws each contact of the frame that the scene lists: a dot with its normal and its friction cone. The group is
    /// empty if the scene lists no contacts.
    pub(super) fn listed_contacts(&self) -> Group {
        let (scene, theme) = (&self.context.analysis.scene, &self.context.options.theme);
        let mut group = Group::with_class("contacts");
        if !scene.lists_contacts() {
            return group;
        }
        let line = |ends: &[Point]| Outline::line(ends.iter().map(|p| self.camera.place(*p)));
        let long = NORMAL_LENGTH * self.context.unit;
        for contact in &self.context.analysis.frames[self.number].contacts {
            let interface = &contact.interface;
            let (at, normal) = (interface.middle(), interface.normal);
            let [left, right] = [1.0, -1.0].map(|side| {
                let edge: Vector = normal + interface.tangent() * (side * interface.friction);
                at + edge.normalize() * long
            });
            let tip = at + normal * long;
            let head =
                [1.0, -1.0].map(|side| tip - (normal + interface.tangent() * (0.5 * side)) * (HEAD_SHARE * long));
            let mut arrow = line(&[at, tip]);
            arrow.extend(line(&[head[0], tip, head[1]]));
            let title = format!(
                "Contact of {} and {}: friction coefficient {}",
                scene.name(interface.bodies[0]),
                scene.name(interface.bodies[1]),
                interface.friction
            );
            let cone = Stroke::new(theme.faint, 0.8 * self.line).dashed([3.0, 2.0]);
            let drawn = Group::with_class("contact")
                .titled(title)
                .with(Path::stroked(line(&[left, at, right]), cone))
                .with(Path::stroked(arrow, Stroke::new(theme.ink, self.line)))
                .with(Path::filled(Outline::circle(self.camera.place(at), DOT_RADIUS), theme.ink));
            group.items.push(drawn.into());
        }
        group
    }

    /// Returns the symbol of the point at which the weight of a block acts: a circle with a cross.
    pub(super) fn centre(&self, at: Point) -> Path {
        let (theme, at) = (&self.context.options.theme, self.camera.place(at));
        let mut mark = Outline::circle(at, 2.0 * DOT_RADIUS);
        mark.extend(Outline::line([at.moved(-2.0 * DOT_RADIUS, 0.0), at.moved(2.0 * DOT_RADIUS, 0.0)]));
        mark.extend(Outline::line([at.moved(0.0, -2.0 * DOT_RADIUS), at.moved(0.0, 2.0 * DOT_RADIUS)]));
        Path::stroked(mark, Stroke::new(theme.ink, 0.8 * self.line))
    }
}
