//! Figures of elementary mechanisms: the bodies do not penetrate each other, and they slide along their joints.

use drystone::Analysis;
use drystone::analysis::{FrameAnalysis, MarginKinds, Motion, Verdict};
use drystone::drawing::{Camera, Group, Item};
use drystone::figure::{self, Kind, Options};
use drystone::internals::geometry::{ConvexPieces, Point, Polygon, Vector, cross, overlap};
use drystone::scene::{BodyId, Scene};

use crate::lines::{all, contributed};
use crate::pictures::scene;

fn speed(scene: &Scene, motions: &[Motion], body: BodyId, at: Point) -> Vector {
    let BodyId::Block(id) = body else {
        return Vector::zeros();
    };
    let motion = motions.iter().find(|m| m.block == id);
    motion.map_or(Vector::zeros(), |m| {
        let arm = at - scene.blocks()[id.0].centroid;
        m.velocity + Vector::new(-arm.y, arm.x) * m.spin
    })
}

/// The power of the loads in a motion, and the largest speed at which a contact closes.
fn power_and_closing(scene: &Scene, found: &FrameAnalysis, motions: &[Motion]) -> (f64, f64) {
    let power = motions.iter().map(|m| {
        let block = &scene.blocks()[m.block.0];
        let loads = scene.loads().iter().filter(|l| l.block == m.block);
        let loads = loads.map(|l| {
            let arm = l.at - block.centroid;
            l.force.dot(&m.velocity) + (cross(arm, l.force) + l.torque) * m.spin
        });
        (scene.down() * block.weight).dot(&m.velocity) + loads.sum::<f64>()
    });
    let power = power.sum();
    let mut closing: f64 = 0.0;
    for contact in &found.contacts {
        let [a, b] = contact.interface.bodies;
        for at in contact.application_points {
            let apart = speed(scene, motions, a, at) - speed(scene, motions, b, at);
            closing = closing.max(-apart.dot(&contact.interface.normal));
        }
    }
    (power, closing)
}

#[test]
fn elementary_mechanisms_do_work_and_close_no_contact() {
    let mut falling = 0;
    for (name, scene) in crate::pictures::gallery().into_iter().chain(contributed()) {
        let analysis = Analysis::new(&scene);
        let elementary = analysis.elementary();
        for (found, drawn) in analysis.frames.iter().zip(&elementary.frames) {
            if found.verdict != Verdict::Unstable {
                assert_eq!(found.mechanism, drawn.mechanism);
                continue;
            }
            falling += 1;
            let (power, closing) = power_and_closing(&scene, found, &drawn.mechanism);
            assert!(power > 0.0, "{name}: {power} W");
            assert!(closing < 1e-5, "{name}: closes with {closing}");
        }
    }
    assert!(falling >= 8, "{falling}");
}

#[test]
fn a_thin_arch_falls_on_four_hinges() {
    for name in ["arch13thin", "archri4.55"] {
        let scene = scene(&format!("tests/scenes/{name}.json"));
        let drawing = figure::draw(&Analysis::new(&scene), Kind::Mechanism, &Options::default());
        let hinges = all(&drawing.items, "hinge").len();
        assert_eq!(hinges, 4, "{name}");
    }
}

/// The outline of a drawn block, metres.
fn polygon(group: &Group, camera: &Camera) -> Polygon {
    let outline = group.items.iter().find_map(|item| match item {
        Item::Path(path) => Some(&path.outline),
        _ => None,
    });
    let corners = outline.expect("an outline").points().map(|p| camera.back(p));
    Polygon::new(corners.collect(), Vec::new()).expect("a rigid motion keeps it simple")
}

#[test]
fn bodies_do_not_penetrate_at_the_drawn_amplitude() {
    let mut compared = 0;
    for (name, scene) in contributed() {
        let analysis = Analysis::new(&scene);
        if analysis.frames[0].verdict != Verdict::Unstable || scene.kernel() > 0.0 {
            continue;
        }
        let drawing = figure::draw(&analysis, Kind::Mechanism, &Options::default());
        let picture = all(&drawing.items, "picture")[0];
        let camera = picture.camera.expect("it shows the scene");
        let mut bodies: Vec<Polygon> = all(&picture.items, "displaced")
            .into_iter()
            .chain(all(&picture.items, "block"))
            .map(|group| polygon(group, &camera))
            .collect();
        bodies.extend(scene.ground().iter().map(|g| g.body.polygon.clone()));
        for (i, a) in bodies.iter().enumerate() {
            for b in &bodies[..i] {
                let shared = overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), 0.0).map_or(0.0, |o| o.area);
                let share = shared / a.area().min(b.area());
                assert!(share < 0.005, "{name}: {share} of the smaller body");
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn sliding_bodies_stay_on_their_joints() {
    let scene = scene("tests/scenes/slide.json");
    let drawing = figure::draw(&Analysis::new(&scene), Kind::Mechanism, &Options::default());
    let picture = all(&drawing.items, "picture")[0];
    let camera = picture.camera.expect("it shows the scene");
    let moved = polygon(all(&picture.items, "displaced")[0], &camera);
    // The slope rises by 4 in 9.
    let normal = Vector::new(-4.0, 9.0).normalize();
    let heights: Vec<f64> = moved.outline().iter().map(|p| p.coords.dot(&normal)).collect();
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(lowest.abs() < 1e-5, "{heights:?}");
    let svg = drystone::output::svg::write(&drawing);
    assert!(svg.contains("slides along its joint"));
}

#[test]
fn an_animated_mechanism_moves_and_all_its_pages_have_the_same_size() {
    let scene = scene("tests/scenes/arch13thin.json");
    let analysis = Analysis::new(&scene);
    let film = figure::film(&analysis, Kind::Mechanism, &Options::default(), 2.0);
    assert_eq!(film.last().map(|(_, seconds)| *seconds), Some(1.0), "the last picture is shown for a second");
    let moving: f64 = film[..film.len() - 1].iter().map(|(_, seconds)| seconds).sum();
    assert!((moving - 2.0).abs() < 1e-9, "{moving} s");
    let pages: Vec<_> = film.into_iter().map(|(page, _)| page).collect();
    assert!(pages.len() >= 10);
    let first = |n: usize| {
        let picture = all(&pages[n].items, "picture")[0];
        let camera = picture.camera.expect("it shows the scene");
        polygon(all(&picture.items, "displaced")[3], &camera).centroid()
    };
    let distances: Vec<f64> = (0..pages.len()).map(|n| (first(n) - first(0)).norm()).collect();
    assert!(distances.windows(2).all(|w| w[1] > w[0]), "{distances:?}");
    let (first_step, middle) = (distances[1], distances[distances.len() / 2 + 1] - distances[distances.len() / 2]);
    assert!(middle > 3.0 * first_step, "the motion does not begin slowly: {distances:?}");
    let size = |n: usize| (pages[n].width, pages[n].height);
    assert!((1..pages.len()).all(|n| size(n) == size(0)));
}

#[test]
fn an_animation_shows_what_falls_symmetrically_and_says_if_nothing_moves() {
    let text = include_str!("../scenes/arch13thin.json");
    let scene = Scene::from_json(text).expect("a scene");
    let film = figure::film(&Analysis::new(&scene), Kind::Mechanism, &Options::default(), 2.0);
    let places = |page: usize| -> Vec<Point> {
        let picture = all(&film[page].0.items, "picture")[0];
        let camera = picture.camera.expect("it shows the scene");
        all(&picture.items, "displaced").into_iter().map(|block| polygon(block, &camera).centroid()).collect()
    };
    let (first, last) = (places(0), places(film.len() - 1));
    let axis = first.iter().map(|p| p.x).sum::<f64>() / first.len() as f64;
    let lowest = |points: &[Point]| points.iter().map(|p| p.y).fold(0.0, f64::max);
    assert!(lowest(&last) < 0.8 * lowest(&first), "the crown has come down: {} m", lowest(&last));
    for point in &last {
        let image = Point::new(2.0 * axis - point.x, point.y);
        let nearest = last.iter().map(|other| (other - image).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.02 * lowest(&first), "no block is the mirror image of that at {point}");
    }
    let scene = Scene::from_json(drystone::scene::starter()).expect("a scene");
    let film = figure::film(&Analysis::new(&scene), Kind::Mechanism, &Options::default(), 2.0);
    assert!(film.iter().all(|(page, _)| drystone::output::svg::write(page).contains("nothing moves")));
}

#[test]
fn the_figure_of_a_margin_shows_the_structure_and_its_fall() {
    // A block 1 m wide and 4 m high, too rough to slide, topples at atan(1/4) = 14.04°.
    let text = r#"{ "drystone": 1, "friction": 0.9, "ground": [ { "polygon": [[-5,-1],[6,-1],[6,0],[-5,0]] } ],
        "blocks": [ { "id": "a", "polygon": [[0,0],[1,0],[1,4],[0,4]], "weight": 8 } ] }"#;
    let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
    let options = drystone::analysis::Options::default().margins(MarginKinds::ALL);
    let analysis = Analysis::with(&scene, &options);
    let (turn, motions) = analysis.edge(0, drystone::analysis::MarginKind::Tilt).expect("it topples");
    assert!((turn.abs() - 14.036).abs() < 1e-2, "{turn}");
    let [motion] = &motions[..] else { panic!("{motions:?}") };
    // The block turns about the lower corner on the side towards which gravity tilts, so this corner is at rest.
    let corner = Point::new(if turn > 0.0 { 1.0 } else { 0.0 }, 0.0);
    let arm = corner - scene.blocks()[0].centroid;
    let velocity = motion.velocity + Vector::new(-arm.y, arm.x) * motion.spin;
    assert!(velocity.norm() < 1e-5, "{velocity}");
    let options = Options::default().at(figure::At::Margin(drystone::analysis::MarginKind::Tilt));
    let drawing = figure::draw(&analysis, Kind::Mechanism, &options);
    // It would topple to either side as soon; the panel shows one collapse.
    assert_eq!(all(&drawing.items, "ghosts").len(), 1);
    assert_eq!(all(&drawing.items, "gravity").len(), 1);
    let svg = drystone::output::svg::write(&drawing);
    assert!(svg.contains("stands from 14° left to 14° right"), "{svg}");
    // Without margins, the figure states that they were not computed.
    let plain = figure::draw(&Analysis::new(&scene), Kind::Mechanism, &options);
    assert!(drystone::output::svg::write(&plain).contains("its margins were not computed"));
}

/// Two stacks of seven blocks that lean towards each other, 0.2 m apart at the top.
fn corbelled_vault() -> Scene {
    let left = [-3.6, -3.35, -3.05, -2.7, -2.35, -2.0, -1.7];
    let mut blocks = Vec::new();
    for (row, x) in left.into_iter().enumerate() {
        let (low, high) = (0.5 * row as f64, 0.5 * (row + 1) as f64);
        for (side, x) in [("L", x), ("R", -x - 1.6)] {
            let right = x + 1.6;
            blocks.push(format!(
                r#"{{ "id": "{side}{row}", "polygon": [[{x},{low}],[{right},{low}],[{right},{high}],[{x},{high}]] }}"#
            ));
        }
    }
    let text = format!(
        r#"{{ "drystone": 1, "density": 2400, "ground": [{{ "polygon": [[-5,-0.6],[5,-0.6],[5,0],[-5,0]] }}],
             "blocks": [{}] }}"#,
        blocks.join(", ")
    );
    Scene::from_json(&text).unwrap_or_else(|problems| panic!("{problems}"))
}

/// The largest common area of two bodies in a picture, as a fraction of the area of the smaller body.
fn worst_overlap(scene: &Scene, drawing: &drystone::drawing::Drawing) -> f64 {
    let picture = all(&drawing.items, "picture")[0];
    let camera = picture.camera.expect("it shows the scene");
    let mut bodies: Vec<Polygon> = all(&picture.items, "displaced")
        .into_iter()
        .chain(all(&picture.items, "block"))
        .map(|group| polygon(group, &camera))
        .collect();
    bodies.extend(scene.ground().iter().map(|g| g.body.polygon.clone()));
    let mut worst: f64 = 0.0;
    for (i, a) in bodies.iter().enumerate() {
        for b in &bodies[..i] {
            let common = overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), 0.0);
            let area = common.map_or(0.0, |o| o.area);
            worst = worst.max(area / a.area().min(b.area()));
        }
    }
    worst
}

#[test]
fn the_motion_stops_before_bodies_that_did_not_touch_overlap() {
    let scene = corbelled_vault();
    let analysis = Analysis::new(&scene);
    assert_eq!(analysis.frames[0].verdict, Verdict::Unstable);
    let film = figure::film(&analysis, Kind::Mechanism, &Options::default(), 1.0);
    for (page, _) in &film {
        let worst = worst_overlap(&scene, page);
        assert!(worst < 0.005, "{worst} of the smaller body");
    }
}

#[test]
fn hinges_are_drawn_on_both_bodies_and_never_on_a_joint_that_slides() {
    for (name, scene) in contributed() {
        let analysis = Analysis::new(&scene);
        if analysis.frames[0].verdict != Verdict::Unstable || scene.kernel() > 0.0 {
            continue;
        }
        let drawing = figure::draw(&analysis, Kind::Mechanism, &Options::default());
        let picture = all(&drawing.items, "picture")[0];
        let camera = picture.camera.expect("it shows the scene");
        let mut bodies: Vec<Polygon> = all(&picture.items, "displaced")
            .into_iter()
            .chain(all(&picture.items, "block"))
            .map(|group| polygon(group, &camera))
            .collect();
        bodies.extend(scene.ground().iter().map(|g| g.body.polygon.clone()));
        let slides: Vec<&str> =
            all(&picture.items, "slip").iter().filter_map(|slip| slip.title.strip_prefix("Slip between ")).collect();
        for hinge in all(&picture.items, "hinge") {
            let pair = hinge.title.strip_prefix("Hinge between ").expect("titled");
            assert!(!slides.contains(&pair), "{name}: {pair} also slides");
            let ring = hinge.items.iter().find_map(|item| match item {
                Item::Path(path) => Some(&path.outline),
                _ => None,
            });
            let ring: Vec<Point> = ring.expect("a ring").points().map(|p| camera.back(p)).collect();
            let sum: Vector = ring.iter().map(|p| p.coords).sum();
            let centre = Point::from(sum / ring.len() as f64);
            let near = |body: &&Polygon| {
                let far = body.edges().map(|e| {
                    let along = e.to - e.from;
                    let share = (centre - e.from).dot(&along) / along.norm_squared();
                    (centre - (e.from + along * share.clamp(0.0, 1.0))).norm()
                });
                far.fold(f64::INFINITY, f64::min) * camera.length(1.0) < 1.5
            };
            let touching = bodies.iter().filter(near).count();
            assert!(touching >= 2, "{name}: the hinge between {pair} lies on fewer than two bodies");
        }
    }
}

#[test]
fn the_headline_states_the_friction_or_the_load_at_which_it_would_stand() {
    let slide = scene("tests/scenes/slide.json");
    let kinds = Kind::Mechanism.stated_margins(&Analysis::new(&slide));
    let kinds = kinds.expect("it has a headline");
    let options = drystone::analysis::Options::default().margins(kinds);
    let svg = |scene: &Scene| {
        let analysis = Analysis::with(scene, &options);
        let drawing = figure::draw(&analysis, Kind::Mechanism, &Options::default());
        drystone::output::svg::write(&drawing)
    };
    // The slope rises by 4 in 9: 0.4444 is needed, rounded up to 0.445.
    assert!(svg(&slide).contains("would need friction 0.445"));
    // A block of 8 N, 1 m wide and 2 m high, topples if a push at its top exceeds 2 N. This is 0.476 of 4.2 N,
    // rounded down.
    let text = r#"{ "drystone": 1, "friction": 0.9, "ground": [ { "polygon": [[-5,-1],[6,-1],[6,0],[-5,0]] } ],
        "blocks": [ { "id": "a", "polygon": [[0,0],[1,0],[1,2],[0,2]], "weight": 8 } ],
        "loads": [ { "block": "a", "force": [4.2, 0], "at": [0, 2] } ] }"#;
    let pushed = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
    let svg = svg(&pushed);
    assert!(svg.contains("carries 47.6\u{a0}% of its load"), "{svg}");
    assert!(svg.contains("Load on block a: 4.2 N"), "the load is drawn");
}
