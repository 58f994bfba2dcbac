//! Lines and arrows are measured on the drawings and compared with the computed forces.

use drystone::Analysis;
use drystone::analysis::{Failure, FrameAnalysis};
use drystone::drawing::{Camera, Drawing, Group, Item, Outline, PagePoint, Theme};
use drystone::figure::{self, ArrowKind, ForceStyle, Kind, Normalisation, Options};
use drystone::internals::geometry::{Point, Vector, cross};
use drystone::scene::{BlockId, BodyId, Scene};

use crate::pictures::{gallery, scene};

/// Structures by other authors, from `tests/scenes`.
pub(crate) fn contributed() -> Vec<(String, Scene)> {
    let folder = format!("{}/tests/scenes", env!("CARGO_MANIFEST_DIR"));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("the folder of scenes")
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.ends_with(".json"))
        .collect();
    names.sort();
    assert!(names.len() >= 13);
    let read = |name: String| (name.clone(), scene(&format!("tests/scenes/{name}")));
    names.into_iter().map(read).collect()
}

fn of_class<'d>(items: &'d [Item], class: &str, found: &mut Vec<&'d Group>) {
    for item in items {
        if let Item::Group(group) = item {
            if group.class == class {
                found.push(group);
            }
            of_class(&group.items, class, found);
        }
    }
}

pub(crate) fn all<'d>(items: &'d [Item], class: &str) -> Vec<&'d Group> {
    let mut found = Vec::new();
    of_class(items, class, &mut found);
    found
}

fn outline(group: &Group) -> &Outline {
    let path = group.items.iter().find_map(|item| match item {
        Item::Path(path) => Some(path),
        _ => None,
    });
    &path.expect("it is drawn").outline
}

/// A force on a block and its moment about the block's centroid.
#[derive(Clone, Copy)]
struct Acting {
    force: Vector,
    moment: f64,
}

/// The forces of bodies and robots on a block, and separately its weight and loads.
fn acting(scene: &Scene, found: &FrameAnalysis, id: BlockId) -> [Vec<Acting>; 2] {
    let block = &scene.blocks()[id.0];
    let at = |p: Point, force: Vector, torque: f64| Acting { force, moment: cross(p - block.centroid, force) + torque };
    let (mut pressing, mut loads) = (Vec::new(), Vec::new());
    for contact in &found.contacts {
        let sign = match contact.interface.bodies {
            [BodyId::Block(b), _] if b == id => 1.0,
            [_, BodyId::Block(b)] if b == id => -1.0,
            _ => continue,
        };
        // The force is computed from the forces at the two points, because the picture is drawn from the resultant.
        let normal = contact.interface.normal;
        let [p, q] = contact.application_points;
        let [n, m] = contact.normal_forces;
        let parts = [
            at(p, normal * n, 0.0),
            at(q, normal * m, 0.0),
            at(p, Vector::new(-normal.y, normal.x) * contact.friction_force, 0.0),
        ];
        // The missing forces of a joint belong to its force. The scenes have one joint between two bodies.
        let own = found.failures.iter().filter(|failure| match failure {
            Failure::Tension { bodies: [a, b], .. } | Failure::Friction { bodies: [a, b], .. } => {
                contact.interface.bodies == [*a, *b] || contact.interface.bodies == [*b, *a]
            }
            _ => false,
        });
        let missing = own.filter_map(|failure| Some((failure.at(), failure.on(BodyId::Block(id))?)));
        let missing: Vec<Acting> = missing.map(|(p, (force, torque))| at(p, force, torque)).collect();
        let sums = |parts: &[Acting]| {
            let force = parts.iter().map(|a| a.force).sum::<Vector>();
            (force, parts.iter().map(|a| a.moment).sum::<f64>())
        };
        let ((force, moment), (more, turning)) = (sums(&parts), sums(&missing));
        pressing.push(Acting { force: force * sign + more, moment: moment * sign + turning });
    }
    for robot in found.robots.iter().filter(|r| r.block == id) {
        let own = found.failures.iter().filter(|failure| failure.robot() == Some(robot.robot));
        let (force, torque) =
            own.fold((robot.force, robot.torque), |sum, failure| (sum.0 + failure.force(), sum.1 + failure.torque()));
        pressing.push(at(robot.at, force, torque));
    }
    loads.push(at(block.centroid, scene.down() * block.weight, 0.0));
    for load in scene.loads().iter().filter(|l| l.block == id) {
        loads.push(at(load.at, load.force, load.torque));
    }
    [pressing, loads]
}

/// All forces whose line of action may be drawn in a block: each load, each force of a body or robot, and the latter
/// combined with any of the loads.
fn lines([pressing, loads]: &[Vec<Acting>; 2]) -> Vec<Acting> {
    let sum = |a: Acting, b: &Acting| Acting { force: a.force + b.force, moment: a.moment + b.moment };
    let mut lines: Vec<Acting> = loads.clone();
    for one in pressing {
        // With three or more forces, it is not determined with which of them a load is combined.
        let subsets = if pressing.len() <= 2 { 1 << loads.len() } else { 1 };
        for subset in 0..subsets {
            let chosen = loads.iter().enumerate().filter(|(i, _)| (subset >> i) & 1 == 1);
            lines.push(chosen.fold(*one, |a, (_, b)| sum(a, b)));
        }
    }
    lines
}

#[test]
fn every_piece_of_a_line_of_thrust_lies_on_a_true_line_of_action() {
    let (mut checked, mut scenes) = (0, 0);
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let analysis = Analysis::new(&scene);
        let drawing = figure::draw(&analysis, Kind::Thrust, &Options::default());
        for (found, frame) in analysis.frames.iter().zip(all(&drawing.items, "frame")) {
            let picture = all(&frame.items, "picture")[0];
            let camera = picture.camera.expect("it shows the scene");
            for force in all(&picture.items, "thrust") {
                checked += 1;
                assert_on_a_line(&name, &scene, found, force, &camera);
            }
        }
        scenes += 1;
    }
    // All other pieces are schematic and have another class.
    assert!(checked > 150 && scenes > 20, "{checked} pieces of {scenes}");
}

/// Asserts that a drawn line lies on the line of action of a force on its block.
fn assert_on_a_line(name: &str, scene: &Scene, found: &FrameAnalysis, drawn: &Group, camera: &Camera) {
    let title = &drawn.title;
    let on = title.strip_prefix("Force on block ").expect("it is titled");
    let on = on.split(" from ").next().expect("the block");
    let number = scene.blocks().iter().position(|b| b.id == on).expect("a block");
    let block = &scene.blocks()[number];
    let ends: Vec<Point> = outline(drawn).points().map(|p| camera.back(p)).collect();
    let size = block.body.polygon.bounds().diagonal();
    let off = |line: &Acting| {
        let away = |p: &Point| {
            let moment = line.moment - cross(p - block.centroid, line.force);
            moment.abs() / line.force.norm()
        };
        ends.iter().map(away).fold(0.0, f64::max)
    };
    let lines = lines(&acting(scene, found, BlockId(number)));
    let most = lines.iter().map(|l| l.force.norm()).fold(0.0, f64::max);
    let real = lines.iter().filter(|l| l.force.norm() > 1e-9 * most);
    let nearest = real.map(off).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-4 * size, "{name}: {title} is {nearest} m off, at {ends:?}");
}

#[test]
fn a_loaded_beam_has_no_line_along_its_soffit_and_shows_its_loads() {
    let scene = scene("tests/scenes/loaded.json");
    let analysis = Analysis::new(&scene);
    let drawing = figure::draw(&analysis, Kind::Thrust, &Options::default());
    for force in all(&drawing.items, "thrust") {
        let ends: Vec<PagePoint> = outline(force).points().collect();
        let level = (ends[0].y - ends[1].y).abs() < 0.2 * (ends[0].x - ends[1].x).abs();
        let load = force.title.contains("from a load");
        assert!(!level || load, "{}", force.title);
    }
    let titles: Vec<&str> = all(&drawing.items, "load").iter().map(|l| l.title.as_str()).collect();
    assert_eq!(titles, ["Load on block beam: 4 kN at 270°", "Load on block beam: 800 N at 0°"]);
}

/// A printed force with its unit, converted to newtons. `None` if the text is not a force.
fn newtons(words: &str) -> Option<f64> {
    let words = words.replace('\u{a0}', " ").replace('−', "-");
    let mut parts = words.split(' ');
    let (number, unit) = (parts.next()?.parse::<f64>().ok()?, parts.next()?);
    let factor = match unit {
        "N" => 1.0,
        "kN" => 1e3,
        "MN" => 1e6,
        "GN" => 1e9,
        "mN" => 1e-3,
        "µN" => 1e-6,
        _ => return None,
    };
    Some(number * factor)
}

/// The length of an arrow from tail to tip, in pixels. Its outline begins and ends at its tail; the fourth corner is
/// the tip.
fn arrow_length(outline: &Outline) -> f64 {
    let points: Vec<PagePoint> = outline.points().collect();
    assert_eq!(points.len(), 7);
    let tail = PagePoint::new((points[0].x + points[6].x) / 2.0, (points[0].y + points[6].y) / 2.0);
    let far = |p: &PagePoint| libm::hypot(p.x - tail.x, p.y - tail.y);
    let farthest = points.iter().map(far).fold(0.0, f64::max);
    let tip = far(&points[3]);
    // No corner lies clearly farther than the tip.
    assert!(farthest <= tip * 1.06, "{points:?}");
    tip
}

/// Least length of an arrow, 0.9 mm of the design, pixels.
const TICK: f64 = 5.0;

#[test]
fn every_arrow_has_the_length_of_its_force_in_the_scale_of_its_panel() {
    let (mut checked, mut shortest) = (0, f64::INFINITY);
    let options = [
        Options::default().theme(Theme::thesis()),
        Options::default().style(ForceStyle::Components),
        Options::default().normalisation(Normalisation::Source),
        Options::default().theme(Theme::thesis()).width(396.0),
    ];
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let analysis = Analysis::new(&scene);
        for options in &options {
            let drawing: Drawing = figure::draw(&analysis, Kind::Forces, options);
            for frame in all(&drawing.items, "frame") {
                let arrows = all(&frame.items, "force").into_iter().map(|arrow| {
                    let (_, written) = arrow.title.rsplit_once(": ").expect("a force");
                    let force = newtons(written).unwrap_or_else(|| panic!("{}", arrow.title));
                    (arrow, force, arrow_length(outline(arrow)))
                });
                let arrows: Vec<(&Group, f64, f64)> = arrows.collect();
                let longest = arrows.iter().max_by(|a, b| a.1.total_cmp(&b.1));
                let Some(per_newton) = longest.map(|(_, force, length)| length / force) else { continue };
                for (arrow, force, found) in &arrows {
                    let expected = force * per_newton;
                    // Three digits are printed. The smallest forces have arrows of the same length, which the legend explains.
                    let is_tick = *found > expected && *found < TICK;
                    assert!(
                        is_tick || (found - expected).abs() <= 0.012 * expected,
                        "{name}: {} is {found} px instead of {expected}",
                        arrow.title
                    );
                    shortest = f64::min(shortest, *found);
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 2000 && shortest > 3.0, "{checked}, {shortest}");
}

#[test]
fn no_force_is_left_out() {
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let analysis = Analysis::new(&scene);
        let options = Options::default().theme(Theme::thesis());
        let drawing = figure::forces(&analysis, &options);
        for (number, frame) in all(&drawing.items, "frame").into_iter().enumerate() {
            let arrows = figure::arrows(&analysis, number, &options).into_iter();
            let expected = arrows.filter(|arrow| match arrow.kind {
                ArrowKind::Weight => true,
                kind => kind.partner().is_some() && !kind.is_failure(),
            });
            assert_eq!(all(&frame.items, "force").len(), expected.count(), "{name}, frame {number}");
        }
    }
}

#[test]
fn the_arrows_of_a_force_polygon_join_tip_to_tail_and_close_if_the_structure_stands() {
    let (mut closed, mut joined) = (0, 0);
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let analysis = Analysis::new(&scene);
        let drawing = figure::draw(&analysis, Kind::Thrust, &Options::default().with_polygon(true));
        for (found, frame) in analysis.frames.iter().zip(all(&drawing.items, "frame")) {
            let ends = |group: &&Group| {
                let p: Vec<PagePoint> = outline(group).points().collect();
                let tail = ((p[0].x + p[6].x) / 2.0, (p[0].y + p[6].y) / 2.0);
                [tail, (p[3].x, p[3].y)]
            };
            let arrows: Vec<[(f64, f64); 2]> = all(&frame.items, "side").iter().map(ends).collect();
            let size = drawing.width;
            let near = |a: (f64, f64), b: (f64, f64)| libm::hypot(a.0 - b.0, a.1 - b.1) < 1e-6 * size;
            // If reactions would cover actions, the two are drawn apart and lines join the corresponding points.
            let joins: Vec<[(f64, f64); 2]> = all(&frame.items, "join")
                .iter()
                .map(|join| {
                    let p: Vec<PagePoint> = outline(join).points().collect();
                    [(p[0].x, p[0].y), (p[1].x, p[1].y)]
                })
                .collect();
            let is_joined = |a: (f64, f64), b: (f64, f64)| {
                near(a, b) || joins.iter().any(|[p, q]| (near(a, *p) && near(b, *q)) || (near(a, *q) && near(b, *p)))
            };
            assert!(arrows.windows(2).all(|w| is_joined(w[0][1], w[1][0])), "{name}");
            joined += usize::from(!joins.is_empty());
            let (Some(first), Some(last)) = (arrows.first(), arrows.last()) else {
                continue;
            };
            if found.verdict == drystone::analysis::Verdict::Stable {
                assert!(is_joined(last[1], first[0]), "{name}: {first:?} {last:?}");
                assert!(all(&frame.items, "gap").is_empty());
                closed += 1;
            }
        }
    }
    assert!(closed > 15 && joined > 3, "{closed}, {joined}");
}
