//! Composes the picture of one frame from its layers: ground, blocks, planned blocks, robots, arrows or other marks,
//! and labels on top.

use super::joint_name::joint_name;
use super::label::{self, Callout};
use super::largest;
use super::limit;
use super::pen::{MIN_READABLE_UNIT_LENGTH, Pen};
use super::unit::unit;
use super::view;
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::RobotForce;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Group, Item};

/// Draws the picture of a frame with the arrows of its forces. `view` is the shown part of the scene in metres; ground
/// outside it is cut off.
pub(crate) fn picture(pen: &Pen<'_>, view: Bounds) -> Group {
    let (context, camera) = (pen.context, pen.camera);
    let many = pen.many();
    let mut group = Group {
        camera: Some(*camera),
        clip: context.options.zoom.map(|_| camera.rect(view)),
        ..Group::with_class("picture")
    };
    group.items.push(pen.ground(view).into());
    group.items.push(pen.blocks().into());
    group.items.push(pen.plans().into());
    group.items.push(pen.discs().into());
    let too_small = context.arrows_too_small(camera.length(1.0));
    group.items.push(
        if too_small {
            pen.loads()
        } else if many {
            pen.arrows_by_colour()
        } else {
            pen.arrows(false)
        }
        .into(),
    );
    if !many && !too_small && pen.unit() >= MIN_READABLE_UNIT_LENGTH {
        group.items.push(pen.heads().into());
    }
    group.items.push(pen.arrows(true).into());
    let mut ink = label::ink(pen);
    if !too_small && !many && !context.options.printed() {
        group.items.push(limits(pen, &mut ink).into());
    }
    // If the arrows are left out because they are too small, a label at a joint states the largest contact force.
    let callouts = if too_small && context.analysis.frames.len() == 1 {
        let found = &context.analysis.frames[pen.number];
        largest::callout(pen, found, 4.0, context.options.theme.ink)
    } else {
        Vec::new()
    };
    group.items.push(label::labels(pen, view, callouts, || ink).into());
    group.items.retain(|item| !matches!(item, Item::Group(g) if g.items.is_empty() && g.description.is_empty()));
    group
}

/// Draws filled diamonds at the joints and the robots that are at their limit. If no joint is at its limit, draws an
/// open diamond at the joint nearest to its limit, provided that the text of the figure names this joint. Draws nothing
/// for a frame that does not stand.
fn limits(pen: &Pen<'_>, ink: &mut Ink) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let frame_analysis = &pen.context.analysis.frames[pen.number];
    let mut group = Group::with_class("limits");
    for marked in limit::marked(pen.context, pen.number) {
        let contact = marked.contact;
        let at = pen.camera.place(contact.resultant.at);
        let radius = limit_radius(pen);
        ink.disc(at, limit::reach(radius));
        let pair = joint_name(scene, frame_analysis, contact);
        let is = if marked.reached { "at" } else { "nearest to" };
        let title = format!("The joint between {pair} is {is} its limit");
        let symbol = marked.symbol(at, radius, theme);
        let mark = Group::with_class("limit").titled(title).with(symbol);
        group.items.push(mark.into());
    }
    group.items.extend(robot_limits(pen, ink));
    group
}

/// Draws a filled diamond on the disc of each robot whose force or torque reaches one of its limits. Draws nothing for
/// a frame that does not stand.
pub(crate) fn robot_limits(pen: &Pen<'_>, ink: &mut Ink) -> Vec<Item> {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let frame_analysis = &pen.context.analysis.frames[pen.number];
    let mark = |robot: &RobotForce| {
        let at = pen.camera.place(robot.at);
        let radius = limit_radius(pen);
        ink.disc(at, limit::reach(radius));
        let title = format!("Robot {} is at its limit", scene.robots[robot.robot.0].id);
        let mark = Group::with_class("limit").titled(title);
        mark.with(limit::symbol(at, radius, theme)).into()
    };
    let reached = limit::robots_reached(scene, frame_analysis).into_iter();
    reached.map(mark).collect()
}

/// Returns the radius from which [`limit::reach`] computes the size of diamonds, in pixels.
fn limit_radius(pen: &Pen<'_>) -> f64 {
    (0.06 * pen.unit()).clamp(1.6, 3.2)
}

/// Cuts off the ground of a picture beyond the right and the lower edge of [`view::ground_shown`], so that marks beyond
/// these edges do not seem to stand on the ground.
pub(crate) fn cut_ground(pen: &Pen<'_>, picture: &mut Group) {
    let scene = &pen.context.analysis.scene;
    let Some(shown) = view::ground_shown(scene, unit(scene, None)) else {
        return;
    };
    let corner = pen.camera.place(Point::new(shown.max.x, shown.min.y));
    for item in &mut picture.items {
        if let Item::Group(group) = item
            && group.class == "ground"
            && let Some(clip) = &mut group.clip
        {
            clip.width = clip.width.min(corner.x - clip.at.x).max(0.0);
            clip.height = clip.height.min(corner.y - clip.at.y).max(0.0);
        }
    }
}

/// Composes the picture of a frame: ground, `blocks`, planned blocks, robots, `marks`, and labels that do not cover
/// `ink`. `view` is the shown part of the scene in metres; ground outside it is cut off.
pub(crate) fn composed(pen: &Pen<'_>, view: Bounds, blocks: Group, marks: Vec<Group>, ink: Ink) -> Group {
    composed_with(pen, view, blocks, marks, Vec::new(), ink)
}

/// Like [`composed`], with additional texts (`callouts`), which are placed before other labels.
pub(crate) fn composed_with(
    pen: &Pen<'_>,
    view: Bounds,
    blocks: Group,
    marks: Vec<Group>,
    callouts: Vec<Callout>,
    ink: Ink,
) -> Group {
    let mut group = Group {
        camera: Some(*pen.camera),
        clip: pen.context.options.zoom.map(|_| pen.camera.rect(view)),
        ..Group::with_class("picture")
    };
    let parts = [pen.ground(view), blocks, pen.plans(), pen.discs()];
    let parts = parts.into_iter().chain(marks);
    group.items.extend(parts.map(Item::from));
    group.items.push(label::labels(pen, view, callouts, || ink).into());
    group.items.retain(|item| !matches!(item, Item::Group(g) if g.items.is_empty() && g.description.is_empty()));
    group
}
