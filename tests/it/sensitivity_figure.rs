//! The figure of the sensitivity: its arrows show the derivatives, and a text states why a frame has none.

use drystone::analysis::{MarginKind, Options as AnalysisOptions};
use drystone::drawing::{Camera, Drawing, Group, Item, PagePoint};
use drystone::figure::{self, Kind, Options};
use drystone::geometry::Vector;
use drystone::output::svg;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::structure::{block, on_floor, rectangle, scene};

fn of_assets(path: &str) -> Scene {
    let full = format!("{}/assets/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&full).expect("the scene is there");
    Scene::from_json(&text).expect("sound")
}

fn analysed(scene: &Scene, kind: MarginKind) -> Analysis {
    Analysis::with(scene, &AnalysisOptions::default().sensitivity(kind))
}

fn draw(analysis: &Analysis) -> Drawing {
    figure::draw(analysis, Kind::Sensitivity, &Options::default())
}

/// The groups of a class, each with the camera of its picture.
fn of_class<'a>(items: &'a [Item], class: &str, camera: Option<Camera>, found: &mut Vec<(Camera, &'a Group)>) {
    for item in items {
        if let Item::Group(group) = item {
            let camera = group.camera.or(camera);
            if let (true, Some(camera)) = (group.class == class, camera) {
                found.push((camera, group));
            }
            of_class(&group.items, class, camera, found);
        }
    }
}

/// The tails and tips of the arrows, in pixels.
fn arrows(drawing: &Drawing) -> (Vec<[PagePoint; 2]>, Option<Camera>) {
    let mut found = Vec::new();
    of_class(&drawing.items, "effect", None, &mut found);
    let ends = |group: &Group| {
        let Some(Item::Path(path)) = group.items.last() else {
            panic!("an arrow is a path");
        };
        let p: Vec<PagePoint> = path.outline.points().collect();
        let tail = PagePoint::new(0.5 * (p[0].x + p[6].x), 0.5 * (p[0].y + p[6].y));
        [tail, p[3]]
    };
    let list = found.iter().map(|(_, group)| ends(group)).collect();
    (list, found.first().map(|(camera, _)| *camera))
}

fn distance(a: PagePoint, b: PagePoint) -> f64 {
    libm::hypot(a.x - b.x, a.y - b.y)
}

#[test]
fn arrows_have_the_directions_and_lengths_of_the_derivatives() {
    for (path, kind) in [
        ("study/arch-27.json", MarginKind::Tilt),
        ("study/arch-27.json", MarginKind::Friction),
        ("thesis/figure-8-left.json", MarginKind::Tilt),
        ("thesis/figure-8-left.json", MarginKind::HorizontalLoad),
    ] {
        let analysis = analysed(&of_assets(path), kind);
        let found = analysis.frames[0].sensitivity.as_ref().expect("requested");
        let (is_high, end) = found.nearest().expect("an end");
        let outward = if is_high { 1.0 } else { -1.0 };
        let drawing = draw(&analysis);
        let (arrows, camera) = arrows(&drawing);
        let camera = camera.expect("arrows");
        let mut ratios: Vec<f64> = Vec::new();
        for [tail, tip] in &arrows {
            let here = end.corners.iter().filter(|corner| distance(camera.place(corner.at), *tail) < 1e-6);
            // Of several corners that move together, only the first has an arrow.
            let slopes: Vec<Vector> = here.filter_map(|corner| corner.moves.gradient()).collect();
            let shown = Vector::new(tip.x - tail.x, tail.y - tip.y);
            let along = |slope: &Vector| outward * slope.dot(&shown) / shown.norm();
            let agrees = |slope: &&Vector| along(slope) > (1.0 - 1e-9) * slope.norm();
            let slope = slopes.iter().find(agrees);
            let slope = slope.unwrap_or_else(|| panic!("{path}: {shown:?} of {slopes:?}"));
            ratios.push(shown.norm() / slope.norm());
        }
        for ratio in &ratios {
            assert!((ratio / ratios[0] - 1.0).abs() < 1e-6, "{path}: {ratios:?}");
        }
        for (k, [tail, _]) in arrows.iter().enumerate() {
            let once = arrows[..k].iter().all(|other| distance(other[0], *tail) > 1e-6);
            assert!(once, "{path}: two arrows at {tail:?}");
        }
        // A corner without an arrow has an effect too small to show, or no unique effect.
        let drawn = |at: PagePoint| arrows.iter().any(|arrow| distance(arrow[0], at) < 1e-6);
        for corner in &end.corners {
            let Some(slope) = corner.moves.gradient() else {
                continue;
            };
            let seen = slope.norm() * ratios[0] > 2.1;
            assert!(!seen || drawn(camera.place(corner.at)), "{path}: {corner:?}");
        }
    }
}

#[test]
fn the_most_effective_changes_are_listed_with_their_values() {
    let analysis = analysed(&of_assets("study/arch-27.json"), MarginKind::Tilt);
    let text = svg::write(&draw(&analysis));
    assert!(text.contains("limit: tilt 15.8° right (right end of the interval in which the frame stands)"), "{text}");
    assert!(text.contains("+2 mm → about 16.1° right"), "{text}");
    let starter =
        Analysis::with(of_assets("starter.json"), &AnalysisOptions::default().sensitivity(MarginKind::LoadFactor));
    let text = svg::write(&draw(&starter)).replace("</tspan>", " ");
    assert!(text.contains("load factor 30.5"), "{text}");
}

fn outlines(items: &[Item], visit: &mut dyn FnMut(PagePoint)) {
    for item in items {
        match item {
            Item::Path(path) => path.outline.points().for_each(&mut *visit),
            // Clipped outlines may extend beyond the page.
            Item::Group(group) if group.clip.is_none() => outlines(&group.items, visit),
            _ => {}
        }
    }
}

#[test]
fn no_arrow_leaves_the_page() {
    for path in [
        "study/arch-27.json",
        "study/arch-27-thin.json",
        "study/stack-harmonic-stands.json",
        "thesis/figure-8-left.json",
        "starter.json",
    ] {
        let scene = of_assets(path);
        let kind = drystone::analysis::Sensitivity::default_kind(&scene);
        let analysis = analysed(&scene, kind);
        for width in [None, Some(84.0 / 25.4 * 96.0)] {
            let mut options = Options::default();
            options.width = width;
            let drawing = figure::draw(&analysis, Kind::Sensitivity, &options);
            outlines(&drawing.items, &mut |p| {
                let inside = (0.0..=drawing.width).contains(&p.x) && (0.0..=drawing.height).contains(&p.y);
                assert!(inside, "{path}, {width:?}: {p:?}");
            });
        }
    }
}

/// A block on the ground with a load at the middle of its upper face.
fn pressed(force: [f64; 2]) -> Value {
    let mut file = on_floor(0.5, vec![block("a", rectangle(1.0, 0.0, 3.0, 2.0), 6.0)]);
    file["loads"] = json!([{ "block": "a", "force": force, "at": [2.5, 2.0] }]);
    file
}

#[test]
fn a_frame_without_derivatives_states_why_and_has_no_arrows() {
    let unloaded = {
        let mut file = pressed([0.0, -1.0]);
        file["loads"] = json!([]);
        file
    };
    for (file, words) in [
        (unloaded, "there are no loads on placed blocks"),
        (pressed([0.0, -1.0]), "the frame stands at every larger value"),
    ] {
        let analysis = analysed(&scene(&file), MarginKind::LoadFactor);
        let drawing = draw(&analysis);
        assert!(arrows(&drawing).0.is_empty());
        let text: String = svg::write(&drawing).replace("\n", " ");
        assert!(text.contains(words), "{words}: {text}");
    }
    let plain = Analysis::new(scene(&pressed([0.0, -1.0])));
    assert!(svg::write(&draw(&plain)).contains("was not computed"));
}
