//! The marks of forces in the look `plain`: each lies in the place of its joint, in the direction of its force, and none
//! is left out.

use drystone::Analysis;
use drystone::drawing::{Camera, Drawing, Group, Item, PagePoint, Theme};
use drystone::figure::{self, Options};
use drystone::scene::BodyId;

use crate::true_places::scenes;

/// Largest distance of a mark from its joint: 1.2 mm of the design, pixels of a screen.
const MAX_DISTANCE: f64 = 1.2 * 5.37;

/// Visits the groups of a class with the camera of their picture.
fn visit(items: &[Item], camera: Option<Camera>, class: &str, seen: &mut dyn FnMut(&Group, Camera)) {
    for item in items {
        if let Item::Group(group) = item {
            let camera = group.camera.or(camera);
            if group.class == class {
                seen(group, camera.expect("marks lie in a picture"));
            }
            visit(&group.items, camera, class, seen);
        }
    }
}

fn panels(drawing: &Drawing) -> Vec<&Group> {
    let frames = drawing.items.iter().filter_map(|item| match item {
        Item::Group(group) if group.class == "frame" => Some(group),
        _ => None,
    });
    frames.collect()
}

/// The middle of a mark with two heads, or the middle of the tail of a mark with one head.
fn start(group: &Group) -> PagePoint {
    let points: Vec<PagePoint> = match &group.items[0] {
        Item::Path(path) => path.outline.points().collect(),
        _ => panic!("a mark is a shape"),
    };
    let used: Vec<&PagePoint> = match points.len() {
        7 => vec![&points[0], &points[6]],
        10 => points.iter().collect(),
        other => panic!("a mark has {other} corners"),
    };
    let sum = used.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.x, sum.1 + p.y));
    PagePoint::new(sum.0 / used.len() as f64, sum.1 / used.len() as f64)
}

/// The marks of 60 scenes were up to 18.3 m away from their joints in the look before this one.
#[test]
fn every_mark_lies_at_its_joint_and_names_its_bodies() {
    let mut marks = 0;
    for (name, scene) in scenes() {
        let analysis = Analysis::new(&scene);
        let drawing = figure::forces(&analysis, &Options::default().theme(Theme::plain()));
        let panels = panels(&drawing);
        assert_eq!(panels.len(), analysis.frames.len(), "{name}");
        for (panel, frame) in panels.into_iter().zip(&analysis.frames) {
            let mut at = Vec::new();
            visit(&panel.items, None, "force", &mut |group, camera| {
                at.push((group.title.clone(), start(group), camera));
            });
            let all = analysis.frames.iter().flat_map(|frame| &frame.contacts);
            let largest = all.map(|contact| contact.resultant.force.norm()).fold(0.0, f64::max);
            let joints: Vec<_> = frame.contacts.iter().filter(|c| c.resultant.force.norm() > 1e-6 * largest).collect();
            assert_eq!(at.len(), joints.len(), "{name}: every force has a mark");
            for joint in joints {
                let bodies = joint.interface.bodies.map(|body| match body {
                    BodyId::Ground(_) if scene.name(body) == "ground" => "the ground".to_owned(),
                    _ => scene.name(body).to_owned(),
                });
                let title = format!("Force between {} and {}: ", bodies[0], bodies[1]);
                let distance = |(_, at, camera): &&(String, PagePoint, Camera)| {
                    let joint = camera.place(joint.resultant.at);
                    libm::hypot(joint.x - at.x, joint.y - at.y)
                };
                let own = at.iter().filter(|(words, ..)| words.starts_with(&title));
                let nearest = own.map(|mark| distance(&mark)).fold(f64::INFINITY, f64::min);
                assert!(nearest < MAX_DISTANCE, "{name}: {title} {nearest}");
                marks += 1;
            }
        }
    }
    assert!(marks > 1000, "{marks}");
}

/// A block on a slope, 35° steep, with the friction 0.3 and two loads.
const SLOPE: &str = r#"{ "drystone": 1, "friction": 0.3, "ground": [{ "polygon": [[0, 0], [10, 0], [10, 7]] }],
    "blocks": [{ "id": "a", "polygon": [[4, 2.8], [7, 4.9], [5.6, 6.9], [2.6, 4.8]], "mass": 500 }],
    "loads": [{ "id": "crane", "block": "a", "force": [0, -900] }, { "block": "a", "force": [100, -800] }] }"#;

#[test]
fn a_slip_has_no_mark_where_the_missing_friction_is_drawn() {
    let analysis = Analysis::new(drystone::Scene::from_json(SLOPE).expect("a scene"));
    let drawing = figure::forces(&analysis, &Options::default().theme(Theme::plain()));
    let count = |class| {
        let mut found = 0;
        visit(&drawing.items, None, class, &mut |_, _| found += 1);
        found
    };
    assert_eq!((count("missing"), count("slip")), (1, 0));
    let svg = drystone::output::svg::write(&drawing);
    assert!(svg.contains("missing") && !svg.contains("slides"), "the legend names what is drawn");
}

#[test]
fn figures_write_the_id_that_the_file_gives_a_load_beside_its_amount() {
    let analysis = Analysis::new(drystone::Scene::from_json(SLOPE).expect("a scene"));
    let svg = drystone::output::svg::write(&figure::forces(&analysis, &Options::default().theme(Theme::plain())));
    assert!(svg.contains("crane: 900 N") && svg.contains(">806 N<"), "{svg}");
}
