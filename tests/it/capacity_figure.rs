//! The figure of the capacity: its area is the set of the result, and its small pictures show the mechanisms of the
//! edges.

use drystone::analysis::{CapacityRequest, ForceAt, LoadCapacity, Options as AnalysisOptions};
use drystone::drawing::{Camera, Drawing, Group, Item, PagePoint, Path};
use drystone::figure::{self, Kind, Options};
use drystone::geometry::{Point, Vector};
use drystone::{Analysis, Scene};
use serde_json::json;

use crate::structure::{arch, block, on_floor, rectangle, scene};

fn analysed(scene: &Scene, block: &str, at: ForceAt) -> Analysis {
    let block = scene.block_named(block).expect("the block exists");
    let request = CapacityRequest::of_block(block).at(at);
    Analysis::with(scene, &AnalysisOptions::default().capacity(request))
}

/// Adds to `found` the groups of a class, each with the camera of its picture.
fn of_class<'a>(items: &'a [Item], class: &str, camera: Option<Camera>, found: &mut Vec<(Option<Camera>, &'a Group)>) {
    for item in items {
        if let Item::Group(group) = item {
            let camera = group.camera.or(camera);
            if group.class == class {
                found.push((camera, group));
            }
            of_class(&group.items, class, camera, found);
        }
    }
}

fn groups<'a>(drawing: &'a Drawing, class: &str) -> Vec<(Option<Camera>, &'a Group)> {
    let mut found = Vec::new();
    of_class(&drawing.items, class, None, &mut found);
    found
}

fn paths(group: &Group) -> Vec<&Path> {
    let paths = group.items.iter().filter_map(|item| match item {
        Item::Path(path) => Some(path),
        _ => None,
    });
    paths.collect()
}

/// The vector from one point of the page to another, with y upwards.
fn shown(from: PagePoint, to: PagePoint) -> Vector {
    Vector::new(to.x - from.x, from.y - to.y)
}

/// The corners of the drawn area, and the position of the force 0. The position is `None` if the area is drawn apart
/// from the point at which the force acts.
fn drawn(drawing: &Drawing, capacity: &LoadCapacity) -> (Vec<PagePoint>, Option<PagePoint>) {
    let found = groups(drawing, "capacity");
    let [(Some(camera), group)] = found[..] else {
        panic!("one polygon");
    };
    let corners = paths(group)[0].outline.points().collect();
    let is_apart = !groups(drawing, "leader").is_empty();
    (corners, (!is_apart).then(|| camera.place(capacity.at[0])))
}

/// The scale in pixels per newton and the position of the force 0 for which every force of the set is a corner of the
/// area.
fn scale(corners: &[PagePoint], forces: &[Vector], zero: Option<PagePoint>) -> (f64, PagePoint) {
    let place =
        |force: Vector, scale: f64, zero: PagePoint| PagePoint::new(zero.x + scale * force.x, zero.y - scale * force.y);
    let are_corners = |scale: f64, zero: PagePoint| {
        forces.iter().all(|force| {
            let at = place(*force, scale, zero);
            corners.iter().any(|corner| shown(*corner, at).norm() < 1e-6)
        })
    };
    let found = corners.iter().find_map(|corner| match zero {
        Some(zero) => {
            let scale = shown(zero, *corner).norm() / forces[0].norm();
            are_corners(scale, zero).then_some((scale, zero))
        }
        None => corners.iter().find_map(|other| {
            let scale = shown(*corner, *other).norm() / (forces[1] - forces[0]).norm();
            let zero = place(-forces[0], scale, *corner);
            (scale > 0.0 && are_corners(scale, zero)).then_some((scale, zero))
        }),
    });
    found.unwrap_or_else(|| panic!("{corners:?} {forces:?}"))
}

/// A block on the ground, held by a robot with limits. Its set is unbounded downwards.
fn held() -> Scene {
    let mut file = on_floor(0.5, vec![block("a", rectangle(-1.0, 0.0, 2.0, 1.0), 8.0)]);
    let limits = json!({ "fx": 3, "fy": 5, "torque": 2 });
    file["robots"] = json!([{ "id": "r", "holds": "a", "limits": limits }]);
    scene(&file)
}

/// Every corner of the area is a carried force, and every vertex of the set is a corner of the area, in one scale.
/// The force 0 is at the point of application, unless the area is drawn apart from it.
#[test]
fn the_area_is_the_set_of_the_result_in_one_scale() {
    let thick = scene(&arch(9, 0.4, 0.7));
    for (scene, name, at) in [(&thick, "v4", ForceAt::Default), (&held(), "a", ForceAt::Point(Point::new(0.5, 0.5)))] {
        let analysis = analysed(scene, name, at);
        let found = analysis.frames[0].capacity.as_ref().expect("requested");
        let drawing = figure::draw(&analysis, Kind::Capacity, &Options::default());
        let (corners, zero) = drawn(&drawing, found);
        let forces: Vec<Vector> = found.vertices.iter().map(|v| v.force).collect();
        let (scale, zero) = scale(&corners, &forces, zero);
        if found.rays.is_empty() {
            assert_eq!(corners.len(), forces.len());
        }
        let middle = forces.iter().sum::<Vector>() / forces.len() as f64;
        for corner in &corners {
            let force = shown(zero, *corner) / scale;
            let inside = force + (middle - force) * 1e-6;
            assert!(found.contains(inside), "{name}: {force:?} is not carried");
        }
    }
}

/// Each small picture has an arrow in the direction in which the block's point begins to move beyond the edge.
#[test]
fn small_pictures_belong_to_the_longest_edges() {
    let scene = scene(&arch(9, 0.4, 0.7));
    let analysis = analysed(&scene, "v4", ForceAt::Default);
    let found = analysis.frames[0].capacity.as_ref().expect("requested");
    let drawing = figure::draw(&analysis, Kind::Capacity, &Options::default());
    let pictures = groups(&drawing, "mechanism");
    let mut longest: Vec<usize> = found.longest_edges().into_iter().take(4).collect();
    longest.sort_unstable();
    assert!(!longest.is_empty());
    assert_eq!(pictures.len(), longest.len());
    for (k, ((_, group), edge)) in pictures.iter().zip(&longest).enumerate() {
        let title = format!("How the structure begins to fall beyond edge {}", k + 1);
        assert_eq!(group.title, title);
        let arrow = paths(group).pop().expect("an arrow");
        let p: Vec<PagePoint> = arrow.outline.points().collect();
        let tail = PagePoint::new(0.5 * (p[0].x + p[6].x), 0.5 * (p[0].y + p[6].y));
        let direction = shown(tail, p[3]).normalize();
        let normal = found.edges[*edge].normal;
        assert!((direction - normal).norm() < 1e-9, "{direction:?} instead of {normal:?}");
    }
}
