//! What results and captions state, each held against something else that is known: sums against what is listed, shares
//! against forces and limits, motions against contacts, margins against verdicts. `src/doc/claims.md` is the list.
//!
//! Everything here reads the JSON that other programs read, with geometry of its own, so that a number that is right
//! inside and wrong on its way out is caught too.

use drystone::analysis::{Ask, Options, Verdict};
use drystone::report::result::{Layout, Timing, to_json};
use drystone::{Analysis, figure};
use serde_json::{Value, json};

use crate::oracle::random;
use crate::structure::{arch, block, harmonic, on_floor, on_slope, rectangle, scene, wall};

/// A scene file, what `check --json` says of it, and L.
struct Told {
    file: Value,
    json: Value,
    length: f64,
}

fn told_with(file: &Value, options: &Options) -> Told {
    let scene = scene(file);
    let analysis = Analysis::with(&scene, options);
    let json = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
    let json: Value = serde_json::from_str(&json).expect("JSON");
    Told {
        file: file.clone(),
        length: number(&json["frames"][0]["length"]),
        json,
    }
}

fn told(file: &Value) -> Told {
    told_with(file, &Options::default())
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("a number: {value}"))
}

fn pair(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn less(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Standing, sliding, toppling, held with limits, loaded, without friction; and random ones.
fn structures() -> Vec<Told> {
    let mut files = vec![
        arch(11, 0.3, 0.7),
        arch(9, 0.05, 0.7),
        wall(4, 3),
        harmonic(5, 0.9),
        harmonic(5, 1.1),
        on_slope(35.0, 2.0, 1.0, 0.6, 0.0),
        on_slope(20.0, 2.0, 1.0, 0.6, 0.2),
    ];
    let mut held = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    held["robots"] =
        json!([{ "id": "r", "holds": "a", "limits": { "fx": 2, "fy": 3, "torque": 1 } }]);
    files.push(held.clone());
    held["robots"][0]["limits"] = json!({ "force": 0.25, "torque": 0.0 });
    files.push(held);
    let mut pushed = wall(3, 2);
    pushed["loads"] =
        json!([{ "block": "4", "force": [3.0, -2.0], "at": [1.25, 0.75], "torque": 0.5 }]);
    files.push(pushed);
    files.extend((0..90).map(|number| random::scene(number).1));
    let sound = |file: &Value| drystone::Scene::from_json(&file.to_string()).is_ok();
    files.iter().filter(|file| sound(file)).map(told).collect()
}

#[test]
fn totals_are_the_sums_of_what_is_listed() {
    let mut falling = 0;
    for told in structures() {
        let frame = &told.json["frames"][0];
        let mut sum = 0.0;
        for interface in list(&frame["interfaces"]) {
            let normal = pair(&interface["normal_forces"]);
            sum += normal[0] + normal[1] + number(&interface["friction_force"]).abs();
        }
        for robot in list(&frame["robots"]) {
            let force = pair(&robot["force"]);
            sum += force[0].abs() + force[1].abs() + number(&robot["torque"]).abs() / told.length;
        }
        let total = number(&frame["total_force"]);
        assert!(
            (sum - total).abs() <= 1e-9 * sum.max(1e-9),
            "{sum} {total}: {}",
            told.file
        );
        let missing: f64 = list(&frame["failures"])
            .iter()
            .map(|f| match f["torque"].is_null() {
                true => number(&f["amount"]),
                false => number(&f["amount"]) / told.length,
            })
            .sum();
        let sticking = number(&frame["total_sticking"]);
        let size = number(&frame["weight"]).max(sticking).max(total);
        assert!(
            (missing - sticking).abs() <= 1e-6 * size,
            "{missing} {sticking}: {}",
            told.file
        );
        falling += usize::from(missing > 0.0);
        for failure in list(&frame["failures"]) {
            let amount = number(&failure["amount"]);
            let own = match failure["kind"].as_str().expect("a kind") {
                "robot_torque" => number(&failure["torque"]).abs(),
                "robot_force" => pair(&failure["force"]).iter().map(|v| v.abs()).sum(),
                _ => dot(pair(&failure["force"]), pair(&failure["force"])).sqrt(),
            };
            assert!((amount - own).abs() <= 1e-9 * own, "{failure}");
        }
    }
    assert!(falling > 5, "some fall");
}

#[test]
fn the_weight_is_that_of_the_placed_blocks() {
    let file = on_floor(
        0.7,
        vec![
            block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0),
            block("b", rectangle(0.0, 1.0, 1.0, 1.0), 7.5),
            json!({ "id": "c", "polygon": rectangle(3.0, 0.0, 2.0, 0.5), "density": 200 }),
        ],
    );
    let told = told(&file);
    let weight = number(&told.json["frames"][0]["weight"]);
    assert!(
        (weight - (12.5 + 200.0 * 9.81)).abs() < 1e-9 * weight,
        "{weight}"
    );
}

#[test]
fn resultants_replace_the_forces_at_both_points() {
    for told in structures() {
        for interface in list(&told.json["frames"][0]["interfaces"]) {
            let normal = pair(&interface["normal"]);
            let tangent = [-normal[1], normal[0]];
            let forces = pair(&interface["normal_forces"]);
            let friction = number(&interface["friction_force"]);
            let points = [
                pair(&interface["application_points"][0]),
                pair(&interface["application_points"][1]),
            ];
            let (at, force) = (
                pair(&interface["resultant"]["at"]),
                pair(&interface["resultant"]["force"]),
            );
            let sum = forces[0] + forces[1];
            let size = sum + friction.abs();
            for ((n, t), force) in normal.iter().zip(tangent).zip(force) {
                assert!(
                    (n * sum + t * friction - force).abs() <= 1e-9 * size,
                    "{interface}"
                );
            }
            // The same moment about the first point, where friction has none.
            let span = less(points[1], points[0]);
            let moment = cross(span, normal.map(|n| n * forces[1]));
            let of_resultant = cross(less(at, points[0]), force);
            let reach = dot(span, span).sqrt();
            assert!(
                (moment - of_resultant).abs() <= 1e-6 * size * reach,
                "{interface}"
            );
        }
    }
}

#[test]
fn contact_forces_press_and_friction_is_told_as_its_share() {
    for told in structures() {
        for interface in list(&told.json["frames"][0]["interfaces"]) {
            let forces = pair(&interface["normal_forces"]);
            assert!(forces[0] >= 0.0 && forces[1] >= 0.0, "{interface}");
            let most = number(&interface["mu"]) * (forces[0] + forces[1]);
            let friction = number(&interface["friction_force"]).abs();
            let share = number(&interface["friction_used"]);
            assert!(friction <= most * (1.0 + 1e-12), "{interface}");
            assert!(
                (share * most - friction).abs() <= 1e-9 * most,
                "{interface}"
            );
            assert!(most > 0.0 || share == 0.0, "{interface}");
        }
    }
}

#[test]
fn a_robot_gives_no_more_than_it_may_and_tells_the_largest_share() {
    let mut limited = 0;
    for told in structures() {
        for robot in list(&told.json["frames"][0]["robots"]) {
            let listed = list(&told.file["robots"])
                .iter()
                .find(|r| r["id"] == robot["id"]);
            let limits = &listed.expect("a robot of the file")["limits"];
            let limit = |key: &str| {
                limits[key].as_f64().or_else(|| match key {
                    "torque" => None,
                    _ => limits["force"].as_f64(),
                })
            };
            let [x, y] = pair(&robot["force"]);
            let given = [
                (x, limit("fx")),
                (y, limit("fy")),
                // Without a limit of its own a robot gives no torque.
                (
                    number(&robot["torque"]),
                    Some(limit("torque").unwrap_or(0.0)),
                ),
            ];
            let mut most: f64 = 0.0;
            for (amount, limit) in given {
                let Some(limit) = limit else { continue };
                assert!(
                    amount.abs() <= limit * (1.0 + 1e-9),
                    "{robot} {}",
                    told.file
                );
                if limit > 0.0 {
                    most = most.max(amount.abs() / limit);
                    limited += 1;
                }
            }
            let share = number(&robot["limit_used"]);
            assert!((share - most).abs() <= 1e-9, "{robot} {most} {limits}");
        }
    }
    assert!(limited > 5);
}

/// Speed of a point of a moving body; the ground's is 0.
fn speed(frame: &Value, centroid: &dyn Fn(&str) -> [f64; 2], body: &str, at: [f64; 2]) -> [f64; 2] {
    let moves = list(&frame["mechanism"])
        .iter()
        .find(|m| m["block"] == body);
    moves.map_or([0.0; 2], |m| {
        let (v, spin, arm) = (
            pair(&m["velocity"]),
            number(&m["spin"]),
            less(at, centroid(body)),
        );
        [v[0] - spin * arm[1], v[1] + spin * arm[0]]
    })
}

#[test]
fn a_mechanism_presses_nothing_and_its_fastest_point_has_speed_one() {
    let mut seen = 0;
    for told in structures() {
        let frame = &told.json["frames"][0];
        if list(&frame["mechanism"]).is_empty() {
            assert_ne!(frame["verdict"], "unstable", "{}", told.file);
            continue;
        }
        seen += 1;
        let scene = scene(&told.file);
        let find = |id: &str| scene.blocks().iter().find(|b| b.id == id).expect("a block");
        let centroid = |id: &str| {
            let at = find(id).centroid;
            [at.x, at.y]
        };
        let mut fastest: f64 = 0.0;
        for moves in list(&frame["mechanism"]) {
            let id = moves["block"].as_str().expect("a name");
            for corner in find(id).body.polygon.outline() {
                let v = speed(frame, &centroid, id, [corner.x, corner.y]);
                fastest = fastest.max(dot(v, v).sqrt());
            }
        }
        assert!((fastest - 1.0).abs() < 1e-6, "{fastest}: {}", told.file);
        for interface in list(&frame["interfaces"]) {
            let normal = pair(&interface["normal"]);
            let tangent = [-normal[1], normal[0]];
            let [a, b] = [0, 1].map(|k| interface["bodies"][k].as_str().expect("a name"));
            let mu = number(&interface["mu"]);
            for at in list(&interface["application_points"]) {
                let at = pair(at);
                let apart = less(
                    speed(frame, &centroid, a, at),
                    speed(frame, &centroid, b, at),
                );
                // No admissible force (n, ±μ t) may take power from the motion.
                let power = dot(apart, normal) - mu * dot(apart, tangent).abs();
                assert!(
                    power >= -1e-5 * (1.0 + mu),
                    "{interface} {power}: {}",
                    told.file
                );
            }
        }
    }
    assert!(seen > 5);
}

/// Every margin of some scenes of ours, asked of changed files through the front door.
#[test]
fn margins_are_borne_out_by_verdicts_on_either_side() {
    let mut pushed = wall(3, 2);
    pushed["loads"] = json!([{ "block": "4", "force": [1.0, 0.0], "at": [1.0, 0.75] }]);
    let mut held = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    held["robots"] =
        json!([{ "id": "r", "holds": "a", "limits": { "fx": 9, "fy": 9, "torque": 9 } }]);
    let mut asked = 0;
    for file in [
        arch(11, 0.3, 0.7),
        wall(4, 3),
        harmonic(4, 0.9),
        pushed,
        held,
    ] {
        let options = Options::default().margins(Ask::Yes);
        let json = told_with(&file, &options).json;
        let margins = &json["frames"][0]["margins"];
        let mut agrees = |margin: &Value, more_is_worse: bool, change: &dyn Fn(f64) -> Value| {
            let Some(at) = margin.as_f64().filter(|at| *at > 1e-6) else {
                return;
            };
            for (share, inside) in [(1.0 - 1e-4, more_is_worse), (1.0 + 1e-4, !more_is_worse)] {
                let changed = change(at * share);
                let verdict = Analysis::of(scene(&changed)).frames[0].verdict;
                let expected = if inside {
                    Verdict::Stable
                } else {
                    Verdict::Unstable
                };
                assert_eq!(
                    verdict, expected,
                    "{at} times {share} in {margins}: {changed}"
                );
                asked += 1;
            }
        };
        let with = |key: &str, value: Value| {
            let mut changed = file.clone();
            changed[key] = value;
            changed
        };
        agrees(&margins["friction"], false, &|mu| {
            with("friction", json!(mu))
        });
        agrees(&margins["kernel"], true, &|kernel| {
            with("kernel", json!(kernel))
        });
        agrees(&margins["load_factor"], true, &|factor| {
            let mut changed = file.clone();
            for load in changed["loads"].as_array_mut().expect("loads") {
                for axis in 0..2 {
                    load["force"][axis] = json!(number(&load["force"][axis]) * factor);
                }
            }
            changed
        });
        for (side, way) in [("left", -1.0), ("right", 1.0)] {
            if file["loads"].is_null() {
                agrees(&margins["tilt"][side], true, &|degrees| {
                    let angle = degrees.to_radians();
                    with(
                        "gravity",
                        json!([way * libm::sin(angle), -libm::cos(angle)]),
                    )
                });
            }
            agrees(&margins["horizontal_load"][side], true, &|share| {
                let mut changed = file.clone();
                let scene = scene(&file);
                let mut loads = list(&file["loads"]).to_vec();
                for block in scene.blocks() {
                    let at = [block.centroid.x, block.centroid.y];
                    loads.push(json!({ "block": block.id, "force": [way * share * block.weight, 0.0], "at": at }));
                }
                changed["loads"] = json!(loads);
                changed
            });
        }
        for key in ["fx", "fy", "torque"] {
            agrees(&margins["robots"]["r"][key], false, &|limit| {
                let mut changed = file.clone();
                changed["robots"][0]["limits"][key] = json!(limit);
                changed
            });
        }
    }
    assert!(asked >= 20, "{asked}");
}

/// A caption's verdict and amounts are those of the result.
#[test]
fn captions_say_what_the_result_says() {
    for told in structures() {
        let scene = scene(&told.file);
        let analysis = Analysis::of(&scene);
        let caption = figure::caption(&analysis);
        let frame = &analysis.frames[0];
        let (word, others) = match frame.verdict {
            Verdict::Stable => ("It stands", ["It falls", "It is undecided"]),
            Verdict::Unstable => ("It falls", ["It stands", "It is undecided"]),
            Verdict::Undecided => ("It is undecided", ["It stands", "It falls"]),
        };
        assert!(caption.contains(word), "{caption}");
        assert!(others.iter().all(|w| !caption.contains(w)), "{caption}");
        if frame.failures.is_empty() {
            assert!(!caption.contains("would have to"), "{caption}");
            continue;
        }
        // The largest of what is missing is in the caption, to the digits it is written with.
        let largest = list(&told.json["frames"][0]["failures"])
            .iter()
            .filter(|f| f["torque"].is_null())
            .map(|f| dot(pair(&f["force"]), pair(&f["force"])).sqrt())
            .fold(0.0, f64::max);
        let amounts = caption.split(" N").filter_map(|part| {
            let word: String = part.rsplit([' ', '\u{a0}', '\u{202f}']).next()?.into();
            word.parse::<f64>().ok()
        });
        let near = amounts
            .into_iter()
            .any(|a: f64| (a - largest).abs() <= 0.06 * largest);
        assert!(
            !(0.01..=999.0).contains(&largest) || near,
            "{largest}: {caption}"
        );
    }
}

/// The list of claims names tests that exist, so that a renamed or removed one is missed.
#[test]
fn every_test_named_in_the_list_exists() {
    let root = env!("CARGO_MANIFEST_DIR");
    let read = |path: String| std::fs::read_to_string(path).unwrap_or_default();
    let text = read(format!("{root}/src/doc/claims.md"));
    let named = text
        .split('`')
        .skip(1)
        .step_by(2)
        .filter(|word| word.contains("::"));
    let mut seen = 0;
    for name in named.filter(|name| *name != "file::test") {
        let (file, test) = name.rsplit_once("::").expect("a test has a file");
        let path = format!("{root}/tests/it/{}", file.replace("::", "/"));
        let source = read(format!("{path}.rs")) + &read(format!("{path}/mod.rs"));
        assert!(source.contains(&format!("fn {test}(")), "{name} is no test");
        seen += 1;
    }
    assert!(seen > 30, "{seen}");
}

/// `only_by_wedging` is absent where nobody asked and where the frame falls, and says in its effect what shows it.
#[test]
fn wedging_is_told_with_what_shows_it() {
    let asked = Options::default().wedging(Ask::Yes);
    let between = json!({ "drystone": 1, "friction": 0.7,
        "ground": [{ "polygon": rectangle(-2.0, -2.0, 2.0, 4.0) }, { "polygon": rectangle(3.0, -2.0, 2.0, 4.0) }],
        "blocks": [block("bar", rectangle(0.0, 0.0, 3.0, 0.5), 7.0)] });
    let frame = |told: &Told| told.json["frames"][0].clone();
    let why = |frame: &Value| {
        let effect = list(&frame["effects"])
            .iter()
            .find(|e| e["effect"] == "wedging");
        effect.expect("every effect is told")["why"]
            .as_str()
            .expect("words")
            .to_string()
    };
    assert!(frame(&told(&between)).get("only_by_wedging").is_none());
    let wedged = frame(&told_with(&between, &asked));
    assert_eq!(wedged["only_by_wedging"], json!(true));
    // Friction of 0.7 must carry 7 N, so both faces together press with 10 N at least.
    assert!(why(&wedged).contains("1.000e1 N"), "{}", why(&wedged));
    assert!(
        why(&wedged).contains("bar moves and presses nothing"),
        "{}",
        why(&wedged)
    );
    let stands = frame(&told_with(&wall(2, 2), &asked));
    assert_eq!(stands["only_by_wedging"], json!(false));
    let falls = frame(&told_with(&harmonic(4, 1.1), &asked));
    assert!(falls.get("only_by_wedging").is_none());
}

/// What shows that a frame stands only by wedging is checked from the result alone: its interfaces, their forces, two motions.
#[test]
fn the_certificate_of_wedging_is_checked_from_the_result_alone() {
    let asked = Options::default().wedging(Ask::Yes);
    let walls = json!([{ "polygon": rectangle(-2.0, -2.0, 2.0, 4.0) }, { "polygon": rectangle(3.0, -2.0, 2.0, 4.0) }]);
    // Friction of μ must carry the weight, so both faces together press with weight/μ at least.
    for (mu, weight) in [(0.7, 7.0), (0.25, 3.0)] {
        let least = weight / mu;
        let file = json!({ "drystone": 1, "friction": mu, "ground": walls,
            "blocks": [block("bar", rectangle(0.0, 0.0, 3.0, 0.5), weight)] });
        let told = told_with(&file, &asked);
        let frame = &told.json["frames"][0];
        assert_eq!(frame["only_by_wedging"], json!(true));
        let wedging = &frame["wedging"];
        let at_least = number(&wedging["normal_force_at_least"]);
        assert!((at_least - least).abs() < 1e-6 * least, "{wedging}");
        let interfaces = list(&frame["interfaces"]);
        let mut must = vec![false; interfaces.len()];
        for face in list(&wedging["must_press"]) {
            let k = face["interface"].as_u64().expect("a number") as usize;
            assert_eq!(face["bodies"], interfaces[k]["bodies"]);
            must[k] = true;
        }
        let pair = |v: &Value| [number(&v[0]), number(&v[1])];
        let velocity = |motion: &Value, body: &Value, at: [f64; 2]| {
            let of = list(motion).iter().find(|m| m["block"] == *body);
            of.map_or([0.0, 0.0], |m| {
                let ([x, y], [u, v], spin) =
                    (pair(&m["at"]), pair(&m["velocity"]), number(&m["spin"]));
                [u - spin * (at[1] - y), v + spin * (at[0] - x)]
            })
        };
        // How fast a face opens and slides at an application point.
        let apart = |motion: &Value, face: &Value, point: usize| {
            let at = pair(&face["application_points"][point]);
            let [on, from] = [0, 1].map(|side| velocity(motion, &face["bodies"][side], at));
            let ([x, y], [u, v]) = (pair(&face["normal"]), [on[0] - from[0], on[1] - from[1]]);
            (x * u + y * v, x * v - y * u)
        };
        let (mut power, mut pressed) = (0.0, 0.0);
        for (face, must) in interfaces.iter().zip(&must) {
            let normal = [0, 1].map(|k| number(&face["normal_forces"][k]));
            for (point, normal) in normal.into_iter().enumerate() {
                // As springs give way only the faces named come apart, and none is pressed.
                let (opens, slides) = apart(&wedging["gives_way"], face, point);
                assert!(opens > -1e-5, "{face}");
                assert!(*must || opens.abs().max(slides.abs()) < 1e-5, "{face}");
                // Along the bound no other face takes work, and these no more than 1 for each newton.
                let (opens, slides) = apart(&wedging["bound"], face, point);
                let taken = number(&face["mu"]) * slides.abs() - opens;
                assert!(taken < f64::from(u8::from(*must)) + 1e-6, "{taken} {face}");
                power -= normal * opens;
            }
            let (_, slides) = apart(&wedging["bound"], face, 0);
            power -= number(&face["friction_force"]) * slides;
            pressed += if *must { normal[0] + normal[1] } else { 0.0 };
        }
        assert_eq!(wedging["presses_nothing"], json!(true));
        // What the loads give is what these forces take: in any balance the faces press with as much at least.
        assert!(
            (power - at_least).abs() < 1e-5 * at_least,
            "{power} {at_least}"
        );
        assert!(pressed > (1.0 - 1e-6) * at_least, "{pressed} {at_least}");
    }
}
