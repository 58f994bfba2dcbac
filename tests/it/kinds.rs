//! Kinds of figure: mechanism, thrust, joints. The drawings show the computed results.

use drystone::analysis::Verdict;
use drystone::drawing::{Drawing, Group, Item, Outline, Path, Theme};
use drystone::figure::{self, Kind, Options};
use drystone::output::svg;
use drystone::{Analysis, Scene};
use serde_json::json;

use super::structure;

const KINDS: [Kind; 4] = [Kind::Flow, Kind::Mechanism, Kind::Thrust, Kind::Joints];

fn scene(path: &str) -> Scene {
    let full = format!("{}/assets/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&full).expect("the scene is there");
    Scene::from_json(&text).unwrap_or_else(|problems| panic!("{path}:\n{problems}"))
}

fn draw(analysis: &Analysis, kind: Kind) -> Drawing {
    figure::draw(analysis, kind, &Options::default())
}

/// All groups of a class.
fn of_class<'a>(items: &'a [Item], class: &str, found: &mut Vec<&'a Group>) {
    for item in items {
        if let Item::Group(group) = item {
            if group.class == class {
                found.push(group);
            }
            of_class(&group.items, class, found);
        }
    }
}

fn all<'a>(drawing: &'a Drawing, class: &str) -> Vec<&'a Group> {
    let mut found = Vec::new();
    of_class(&drawing.items, class, &mut found);
    found
}

fn paths(group: &Group) -> impl Iterator<Item = &Path> {
    group.items.iter().filter_map(|item| match item {
        Item::Path(path) => Some(path),
        _ => None,
    })
}

fn outlines(items: &[Item], visit: &mut dyn FnMut(&Outline)) {
    for item in items {
        match item {
            Item::Path(path) => visit(&path.outline),
            // Clipped parts may reach beyond the page.
            Item::Group(group) if group.clip.is_none() => outlines(&group.items, visit),
            _ => {}
        }
    }
}

#[test]
fn no_kind_of_figure_draws_beyond_the_page() {
    for name in [
        "thesis/figure-4.json",
        "thesis/figure-6-kernel-05.json",
        "thesis/figure-8-left.json",
        "thesis/figure-8-right.json",
        "thesis/figure-9b.json",
        "study/arch-27-thin.json",
        "study/stack-harmonic-falls.json",
        "study/robot-at-its-limit.json",
        "study/feather-falls.json",
    ] {
        let scene = scene(name);
        let analysis = Analysis::new(&scene);
        for kind in KINDS {
            let drawing = draw(&analysis, kind);
            outlines(&drawing.items, &mut |outline| {
                for p in outline.points() {
                    let inside = (0.0..=drawing.width).contains(&p.x) && (0.0..=drawing.height).contains(&p.y);
                    assert!(inside, "{name}, {kind:?}: {p:?}");
                }
            });
        }
    }
}

#[test]
fn stable_frames_have_no_mechanism_and_unstable_ones_show_every_moving_block() {
    let scene = scene("thesis/figure-4.json");
    let analysis = Analysis::new(&scene);
    let drawing = draw(&analysis, Kind::Mechanism);
    let frames = all(&drawing, "frame");
    for (found, frame) in analysis.frames.iter().zip(frames) {
        let mut moved = Vec::new();
        of_class(&frame.items, "displaced", &mut moved);
        let falls = found.verdict == Verdict::Unstable;
        assert_eq!(moved.is_empty(), !falls);
        assert!(moved.len() <= found.mechanism.len());
    }
    let svg = svg::write(&drawing);
    assert!(svg.contains("there is no mechanism"));
    assert!(svg.contains("turns about a hinge on block"), "{svg}");
    let held = self::scene("thesis/figure-9b.json");
    let svg = svg::write(&draw(&Analysis::new(&held), Kind::Mechanism));
    assert!(svg.contains("about the grip of robot"), "{svg}");
}

#[test]
fn the_safe_fraction_of_an_interface_is_one_minus_the_kernel() {
    for (name, kernel) in [
        ("thesis/figure-6-kernel-0.json", 0.0),
        ("thesis/figure-6-kernel-02.json", 0.2),
        ("thesis/figure-6-kernel-05.json", 0.5),
    ] {
        let scene = scene(name);
        let analysis = Analysis::new(&scene);
        let drawing = draw(&analysis, Kind::Joints);
        let interfaces = all(&drawing, "interface");
        assert!(interfaces.len() >= 2, "{name}");
        // Where no forces balance the structure, nothing is safe, and no joint has the colour of its friction.
        let is_rim = |path: &Path| path.stroke.as_ref().is_some_and(|own| own.colour == Theme::thesis().ink);
        let interfaces: Vec<_> = interfaces.into_iter().filter(|interface| paths(interface).any(is_rim)).collect();
        let standing = analysis.frames.iter().filter(|frame| frame.verdict == Verdict::Stable);
        let pressed =
            standing.flat_map(|frame| &frame.contacts).filter(|c| c.normal_forces.iter().sum::<f64>() > 1e-6).count();
        assert_eq!(interfaces.len(), pressed, "{name}");
        for interface in interfaces {
            let (mut safe, mut rest) = (0.0, 0.0);
            for path in paths(interface) {
                let stroke = path.stroke.as_ref().expect("a line");
                let points: Vec<_> = path.outline.points().collect();
                let length: f64 =
                    points.chunks(2).map(|ends| libm::hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y)).sum();
                if !stroke.dash.is_empty() {
                    rest += length;
                } else if stroke.colour == Theme::thesis().ink {
                    // The bar across a joint that uses all its friction comes last.
                    safe = if safe > 0.0 { safe } else { length };
                }
            }
            let share = safe / (safe + rest);
            assert!((share - (1.0 - kernel)).abs() < 1e-9, "{name}: {share}");
        }
    }
}

#[test]
fn with_a_kernel_of_one_the_safe_part_is_a_point() {
    let file = json!({ "drystone": 1, "friction": 0.7, "kernel": 1.0,
        "ground": [{ "polygon": structure::rectangle(-5.0, -1.0, 10.0, 1.0) }],
        "blocks": [structure::block("a", structure::rectangle(0.0, 0.0, 2.0, 1.0), 6.0)] });
    let scene = structure::scene(&file);
    let svg = svg::write(&draw(&Analysis::new(&scene), Kind::Joints));
    assert!(svg.contains("every safe part is a point"), "{svg}");
    assert!(svg.contains("; 0 m of 2 m safe"), "{svg}");
}

#[test]
fn interfaces_that_use_all_friction_are_marked_and_no_others() {
    let mut marked = 0;
    for name in ["thesis/figure-8-left.json", "thesis/figure-3b.json", "study/slope-exact.json"] {
        let scene = scene(name);
        let analysis = Analysis::new(&scene);
        let drawing = draw(&analysis, Kind::Joints);
        // An interface that uses all its friction has three paths: a rim, a line, and a bar across the line.
        let solid = |path: &&Path| path.stroke.as_ref().is_some_and(|stroke| stroke.dash.is_empty());
        let bars = all(&drawing, "interface").into_iter().filter(|group| paths(group).filter(solid).count() == 3);
        let titles: Vec<&str> = bars.map(|group| group.title.as_str()).collect();
        let used = analysis.frames[0].contacts.iter().filter(|c| c.friction_used >= 1.0 - 1e-6).count();
        assert_eq!(titles.len(), used, "{name}: {titles:?}");
        assert!(titles.iter().all(|t| t.contains(": 100\u{a0}% of the available friction")));
        marked += used;
    }
    assert!(marked >= 2, "{marked}");
}

#[test]
fn a_figure_of_more_than_a_thousand_blocks_has_few_paths() {
    // Single blocks on separate shelves, so that their analysis is quick.
    let blocks: Vec<_> = (0..1100)
        .map(|i| {
            let (x, y) = (2.0 * f64::from(i % 40), 3.0 * f64::from(i / 40));
            structure::block(&format!("{i}"), structure::rectangle(x, y, 1.0, 1.0), 6.0)
        })
        .collect();
    let ground: Vec<_> = (0..28)
        .map(|i| json!({ "polygon": structure::rectangle(-5.0, 3.0 * f64::from(i) - 1.0, 100.0, 1.0) }))
        .collect();
    let file = json!({ "drystone": 1, "friction": 0.7, "ground": ground, "blocks": blocks });
    let scene = structure::scene(&file);
    let analysis = Analysis::new(&scene);
    for kind in KINDS {
        let svg = svg::write(&draw(&analysis, kind));
        // The colour bar of a key alone has more than a hundred paths.
        assert!(svg.matches("<path").count() < 300, "{kind:?}");
        assert!(svg.len() < 600_000, "{kind:?}: {} bytes", svg.len());
    }
}

#[test]
fn every_kind_of_figure_of_the_same_scene_has_the_same_bytes() {
    for kind in KINDS {
        let text = || {
            let scene = scene("thesis/figure-4.json");
            svg::write(&draw(&Analysis::new(&scene), kind))
        };
        assert_eq!(text(), text(), "{kind:?}");
    }
}

#[test]
fn only_changes_from_frame_to_frame_are_marked() {
    // A second block is placed on the first: the ground carries more, and nothing else changes.
    let ground = json!([{ "polygon": structure::rectangle(-5.0, -1.0, 10.0, 1.0) }]);
    let blocks = json!([
        structure::block("low", structure::rectangle(0.0, 0.0, 2.0, 1.0), 6.0),
        structure::block("aside", structure::rectangle(-4.0, 0.0, 1.0, 1.0), 3.0),
        structure::block("high", structure::rectangle(0.0, 1.0, 2.0, 1.0), 4.0)
    ]);
    let file = json!({ "drystone": 1, "friction": 0.7, "ground": ground, "blocks": blocks,
        "steps": [{ "place": ["low", "aside"] }, { "place": ["high"] }, { "remove": ["high"] }] });
    let scene = structure::scene(&file);
    let drawing = draw(&Analysis::new(&scene), Kind::Compare);
    let frames = all(&drawing, "frame");
    let count = |frame: usize, class: &str| {
        let mut found = Vec::new();
        of_class(&frames[frame].items, class, &mut found);
        found.len()
    };
    let marks: Vec<[usize; 3]> = (0..3).map(|f| [count(f, "new"), count(f, "gone"), count(f, "change")]).collect();
    assert_eq!(marks, [[0, 0, 0], [1, 0, 1], [0, 1, 1]]);
    let svg = svg::write(&drawing);
    assert!(svg.contains("Between low and the ground: 6 N before, 10 N now"));
    assert!(svg.contains("new: high; 1 of 2 shared forces changed by over 5 %"), "{svg}");
}

#[test]
fn the_family_of_lines_of_thrust_lies_between_the_least_and_the_greatest_thrust() {
    let scene = scene("study/arch-27.json");
    let plain = Analysis::new(&scene);
    let kinds = Kind::Thrust.stated_margins(&plain).expect("the kernel");
    let margin_options = drystone::analysis::Options::default().margins(kinds);
    let analysis = Analysis::with(&scene, &margin_options);
    let family = analysis.thrust_states(0);
    let [least, central, greatest] =
        [&family.least, &family.central, &family.greatest].map(|state| state.as_ref().expect("it is an arch").thrust);
    assert!(least < central && central < greatest, "{least} {central} {greatest}");
    // The forces of the analysis are another balance of the same arch and lie in between.
    assert!(least <= family.present * (1.0 + 1e-6), "{}", family.present);
    assert!(family.present <= greatest * (1.0 + 1e-6));
    let drawing = draw(&analysis, Kind::Thrust);
    assert_eq!(all(&drawing, "thrust-least").len(), 1);
    assert_eq!(all(&drawing, "thrust-greatest").len(), 1);
    let svg = svg::write(&drawing);
    for words in ["least thrust", "greatest thrust", "most central line", "forces of least sum"] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn a_line_of_thrust_over_several_supports_names_its_state() {
    // A beam of three stones on three posts.
    let post = |id: &str, x: f64| structure::block(id, structure::rectangle(x, 0.0, 1.0, 3.0), 9.0);
    let posts = [("a", 0.0), ("b", 4.0), ("c", 8.0)].map(|(id, x)| post(id, x));
    let lintel = structure::block("lintel", structure::rectangle(0.0, 3.0, 9.0, 1.0), 20.0);
    let blocks: Vec<serde_json::Value> = posts.into_iter().chain([lintel]).collect();
    let scene = structure::scene(&structure::on_floor(0.7, blocks));
    let analysis = Analysis::new(&scene);
    assert_eq!(analysis.thrust_states(0).supports, 3);
    let svg = svg::write(&draw(&analysis, Kind::Thrust));
    assert!(svg.contains("line of thrust of the forces of least sum"), "{svg}");
    assert!(svg.contains("more than two supports"), "{svg}");
}

#[test]
fn structures_without_thrust_have_no_family_of_lines() {
    let scene = scene("study/stack-harmonic-stands.json");
    let analysis = Analysis::new(&scene);
    assert!(analysis.thrust_states(0).least.is_none());
    assert_eq!(Kind::Thrust.stated_margins(&analysis), None);
}

/// The ends of the only line of a group.
fn line(group: &Group) -> [(f64, f64); 2] {
    let points: Vec<_> = paths(group).flat_map(|path| path.outline.points()).collect();
    [points[0], points[1]].map(|p| (p.x, p.y))
}

#[test]
fn a_ray_of_the_force_polygon_is_the_force_in_its_joint() {
    let path = format!("{}/tests/scenes/archload.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the scene is there");
    let scene = Scene::from_json(&text).expect("sound");
    let analysis = Analysis::new(&scene);
    let options = Options::default().with_polygon(true);
    let drawing = figure::draw(&analysis, Kind::Thrust, &options);
    let rays = all(&drawing, "ray");
    let blocks = scene.frames()[0].placed.len();
    assert_eq!(rays.len(), blocks + 1, "one joint more than blocks");
    let mut scale = None;
    for (k, ray) in rays.iter().enumerate() {
        let words = ray.title.strip_prefix(&format!("Ray {}: ", k + 1));
        let words = words.unwrap_or_else(|| panic!("{}", ray.title));
        let amount: f64 = words.split(' ').next().and_then(|n| n.parse().ok()).expect("N");
        let amount = amount * if words.contains("kN") { 1000.0 } else { 1.0 };
        let [pole, tip] = line(ray);
        let length = libm::hypot(tip.0 - pole.0, tip.1 - pole.1);
        let scale = *scale.get_or_insert(amount / length);
        assert!((amount / length - scale).abs() < 0.01 * scale, "{}: {length} pixels", ray.title);
    }
    // The weights and loads form a polyline from the tip of the first ray to the tip of the last ray.
    let sides = all(&drawing, "side");
    let ends = |side: &Group| {
        let points: Vec<_> = paths(side).flat_map(|path| path.outline.points()).collect();
        [((points[0].x + points[6].x) / 2.0, (points[0].y + points[6].y) / 2.0), (points[3].x, points[3].y)]
    };
    // The two reactions come last. They close the polygon in the pole.
    let applied = &sides[..sides.len() - 2];
    let (first, last) = (ends(applied[0])[0], ends(applied[applied.len() - 1])[1]);
    for (end, ray) in [(first, rays[0]), (last, rays[rays.len() - 1])] {
        let tip = line(ray)[1];
        assert!(libm::hypot(tip.0 - end.0, tip.1 - end.1) < 0.1, "{tip:?} {end:?}");
    }
    let (pole, met) = (line(rays[0])[0], ends(sides[sides.len() - 1])[0]);
    assert!(libm::hypot(pole.0 - met.0, pole.1 - met.1) < 0.1, "{pole:?} {met:?}");
    for width in [397.0, 823.0] {
        let drawing = figure::draw(&analysis, Kind::Thrust, &options.clone().width(width));
        for group in all(&drawing, "labels") {
            for text in crate::labels::texts(group) {
                let [left, top, right, bottom] = crate::labels::ink(&text);
                let inside = left >= 0.0 && top >= 0.0;
                let inside = inside && right <= drawing.width && bottom <= drawing.height;
                assert!(inside && text.size >= 9.0, "{}", text.words);
            }
        }
    }
    // Without a thrust, the polygon has no pole, and is closed too.
    let slide = self::scene("study/stack-harmonic-stands.json");
    let drawing = figure::draw(&Analysis::new(&slide), Kind::Thrust, &options);
    assert!(svg::write(&drawing).contains("the force polygon is closed") && all(&drawing, "ray").is_empty());
}

/// Every kind of figure draws the loads, with their amounts.
#[test]
fn no_kind_leaves_out_a_load_silently() {
    let scene = Scene::from_json(
        &json!({
            "drystone": 1, "friction": 0.6,
            "ground": [{ "polygon": [[-1, -1], [5, -1], [5, 0], [-1, 0]] }],
            "blocks": [{ "id": "a", "polygon": [[0, 0], [3, 0], [3, 1], [0, 1]], "weight": 100 }],
            "loads": [{ "block": "a", "force": [7, 0], "at": [0, 0.5] }]
        })
        .to_string(),
    )
    .expect("a sound scene");
    let options = drystone::analysis::Options::default()
        .capacity(drystone::analysis::CapacityRequest::of_block(drystone::scene::BlockId(0)));
    let analysis = Analysis::with(&scene, &options);
    for kind in KINDS.into_iter().chain([Kind::Capacity, Kind::Structure]) {
        let text = svg::write(&draw(&analysis, kind));
        // The tooltip of an arrow or a text. Not only "7 N": other forces may have this amount too.
        let names_load =
            ["from a load: 7 N", "oad of 7 N", "oad on block a: 7 N"].iter().any(|words| text.contains(words));
        assert!(names_load, "{kind:?}: {text}");
    }
}

#[test]
fn a_figure_of_the_structure_tells_nothing_about_the_solution() {
    let text = svg::write(&draw(&Analysis::new(scene("thesis/figure-4.json")), Kind::Structure));
    for word in ["stands", "falls", "Force on", "Weight of", "issing"] {
        assert!(!text.contains(word), "{word}: {text}");
    }
    assert!(text.contains("Block 1"), "{text}");
}
