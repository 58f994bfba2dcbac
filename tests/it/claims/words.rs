//! The output for people is compared with the output for programs: the terminal's table, a report's sentences and
//! tables, the titles in figures.

use drystone::Analysis;
use drystone::analysis::Options;
use drystone::figure::{self, Kind};
use drystone::output::svg;
use serde_json::{Value, json};

use super::{Checked, dot, list, number, pair, structures};
use crate::structure::scene;

/// The numbers of a text. Commas, brackets, colons and semicolons separate words.
fn numbers(text: &str) -> Vec<f64> {
    let marks = |c: char| c.is_whitespace() || matches!(c, ',' | '(' | ')' | ':' | ';');
    let words = text.split(marks).map(|word| word.replace('−', "-"));
    words.filter_map(|word| word.parse().ok()).collect()
}

/// Whether `written` is `exact`, rounded to three digits or more.
fn is_near(written: f64, exact: f64) -> bool {
    (written - exact).abs() <= 5.1e-3 * exact.abs() + 1e-12
}

/// The numbers of a text, and each number that a unit follows also in newtons or newton metres.
fn amounts(text: &str) -> Vec<f64> {
    let marks = |c: char| c.is_whitespace() || matches!(c, ',' | '(' | ')' | ':' | ';');
    let words: Vec<&str> = text.split(marks).filter(|word| !word.is_empty()).collect();
    let with_unit = words.windows(2).filter(|pair| pair[1].trim_end_matches("·m").ends_with('N'));
    let in_newtons = with_unit.filter(|pair| pair[0].replace('−', "-").parse::<f64>().is_ok());
    let in_newtons: Vec<f64> = in_newtons.map(|pair| amount(&pair.join(" ")).0).collect();
    numbers(text).into_iter().chain(in_newtons).collect()
}

/// The largest value of a key in a list; 0 for an empty list.
fn largest(values: &Value, key: &str) -> f64 {
    let values = list(values).iter().map(|value| number(&value[key]));
    values.fold(0.0, f64::max)
}

/// The tables of `drystone check --verbose`, one for each scene, from one run.
fn tables(all: &[Checked]) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let mut names = Vec::new();
    for (number, checked) in all.iter().enumerate() {
        let name = format!("{number:03}.json");
        std::fs::write(folder.path().join(&name), checked.file.to_string()).expect("writable");
        names.push(name);
    }
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_drystone"));
    command.args(["check", "--verbose"]).args(&names).current_dir(folder.path());
    let out = command.env("NO_COLOR", "1").output().expect("starts").stdout;
    let text = String::from_utf8(out).expect("UTF-8");
    let begins = |name: &String| text.find(name.as_str()).expect("every scene has a table");
    let starts: Vec<usize> = names.iter().map(begins).chain([text.len()]).collect();
    let parts = starts.windows(2).map(|part| text[part[0]..part[1]].to_owned());
    parts.collect()
}

/// Every number in a frame's row, and every sentence below it, agrees with the result.
#[test]
fn the_terminals_table_says_what_the_result_says() {
    let all = structures();
    let (mut failures, mut unsupported) = (0, 0);
    for (checked, table) in all.iter().zip(tables(&all)) {
        let frame = &checked.json["frames"][0];
        let row = table.lines().nth(2).expect("a row");
        let word = match frame["verdict"].as_str().expect("a word") {
            "stable" => " stands ",
            "unstable" => " falls ",
            word => word,
        };
        assert!(row.contains(word), "{word}: {table}");
        let sums = table.lines().nth(3).expect("the sums").trim();
        let parts = sums.strip_prefix("forces ").and_then(|rest| rest.split_once(", sticking "));
        let (forces, rest) = parts.expect("forces and sticking");
        let (sticking, proof) = rest.split_once("; proof: ").expect("a proof");
        let cells: Vec<&str> = row.split("  ").map(str::trim).filter(|c| !c.is_empty()).collect();
        let [_, _, weight, margin, ref robots @ ..] = cells[..] else {
            panic!("four or five cells: {table}");
        };
        assert!(is_near(amount(weight).0, number(&frame["weight"])), "{table}");
        assert!(is_near(amount(forces).0, number(&frame["total_force"])), "{table}");
        let total = number(&frame["total_sticking"]);
        match numbers(sticking)[..] {
            [_] => assert!(is_near(amount(sticking).0, total), "{table}"),
            _ => assert!(sticking == "none" && total == 0.0, "{table}"),
        }
        // Shares are written to a tenth of a percent.
        if word == " stands " && !list(&frame["robots"]).is_empty() {
            let share = 100.0 * largest(&frame["robots"], "limit_used");
            match robots[0].strip_suffix(" %") {
                None => {
                    let forces = list(&frame["robots"]).iter().map(|robot| {
                        let [x, y] = [0, 1].map(|axis| number(&robot["force"][axis]));
                        libm::hypot(x, y)
                    });
                    assert!(share == 0.0 && is_near(amount(robots[0]).0, forces.fold(0.0, f64::max)), "{table}");
                }
                Some(used) => assert!((numbers(used)[0] - share).abs() <= 0.051, "{share}: {table}"),
            }
        }
        let stands_on = ["carries", "falls at", "needs friction", "stands up to", "stands down to"];
        let lacks = ["carries", "would need", "no friction coefficient", "no multiple", "stands if corners carry"];
        let beginnings: &[&str] = if word == " stands " { &stands_on } else { &lacks };
        assert!(margin == "-" || beginnings.iter().any(|words| margin.starts_with(words)), "{margin}: {table}");
        assert_proof(proof, &frame["proof"]);
        for failure in list(&frame["failures"]).iter().take(12) {
            assert!(says_failure(&table, failure), "{failure}: {table}");
            failures += 1;
        }
        let more = list(&frame["failures"]).len().saturating_sub(12);
        assert_eq!(table.contains(&format!("and {more} more")), more > 0, "{table}");
        for block in list(&frame["unsupported"]) {
            let block = block.as_str().expect("a name");
            let line = table.lines().find(|line| line.contains("nothing carries"));
            assert!(line.is_some_and(|line| line.contains(block)), "{block}: {table}");
            unsupported += 1;
        }
        for notice in list(&frame["notices"]) {
            let notice = format!("note: {}", notice.as_str().expect("text"));
            assert!(table.contains(&notice), "{notice}: {table}");
        }
    }
    assert!(failures > 50 && unsupported > 0, "{failures} {unsupported}");
}

/// Whether `written` is `exact`, rounded to one digit, as in `3e-12`.
fn is_rough(written: f64, exact: f64) -> bool {
    (written - exact).abs() <= 0.51 * libm::pow(10.0, libm::log10(exact.abs()).floor()) || written == exact
}

fn assert_proof(words: &str, proof: &Value) {
    let values = numbers(words);
    if proof["power"].is_null() {
        let worst = ["worst_imbalance", "worst_pull", "worst_slip"].map(|key| number(&proof[key]));
        let worst = worst.into_iter().fold(0.0, f64::max);
        assert!(words.starts_with("forces balance to") && is_rough(values[0], worst), "{words} {proof}");
        return;
    }
    assert!(is_near(values[0], number(&proof["power"])), "{words} {proof}");
    match proof["no_balance_below"].as_f64() {
        Some(sum) => assert!(words.contains("no balance below") && is_rough(values[1], sum), "{words} {proof}"),
        None => assert!(words.contains("no balance at all"), "{words} {proof}"),
    }
}

/// Whether a line of a text states the bodies, the position and the missing force or torque of a failure.
fn says_failure(text: &str, failure: &Value) -> bool {
    let name = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let says = |line: &str, words: &str, values: &[f64]| {
        let written = amounts(line);
        line.contains(words) && (values.iter()).all(|value| written.iter().any(|w| is_near(*w, *value)))
    };
    let (force, torque) = (&failure["force"], &failure["torque"]);
    let (words, values) = match failure["kind"].as_str().expect("a kind") {
        kind @ ("tension" | "friction") => {
            let [a, b] = [0, 1].map(|k| name(&failure["bodies"][k]));
            let at = pair(&failure["at"]);
            let verb = if kind == "tension" { "comes off" } else { "slides along" };
            let amount = dot(pair(force), pair(force)).sqrt();
            (format!("{a} {verb} {b} at"), vec![at[0], at[1], amount])
        }
        kind => {
            let [robot, block] = [name(&failure["robot"]), name(&failure["holds"])];
            let values = match kind {
                "robot_torque" => vec![number(torque).abs()],
                _ => pair(force).to_vec(),
            };
            let sense = match kind {
                "robot_torque" if number(torque) < 0.0 => " additional clockwise torque",
                "robot_torque" => " additional anticlockwise torque",
                _ => " additional force",
            };
            (format!("robot {robot} cannot hold {block}: it would need an{sense}"), values)
        }
    };
    text.lines().any(|line| says(line, &words, &values))
}

/// The force in a text such as `43.4 N at 90°` or `4.56 mN`, in newtons, and its direction in degrees. The force is
/// NaN if it is written with a power of ten.
fn amount(text: &str) -> (f64, Option<f64>) {
    let mut words = text.split_whitespace();
    let value = words.next().expect("an amount").replace('−', "-");
    let value: f64 = match value.split_once("×10") {
        None => value.parse().expect("a number"),
        Some(_) => return (f64::NAN, None),
    };
    let unit = words.next().expect("a unit");
    let factor = match unit.chars().next() {
        Some('n') => 1e-9,
        Some('µ') => 1e-6,
        Some('m') => 1e-3,
        Some('k') => 1e3,
        Some('M') => 1e6,
        Some('G') => 1e9,
        _ => 1.0,
    };
    let at = words.nth(1).and_then(|word| word.trim_end_matches('°').parse().ok());
    (value * factor, at)
}

/// The title of every arrow in a figure of forces states a magnitude and a direction that the result lists for the
/// same two bodies.
#[test]
fn titles_of_arrows_state_the_forces_of_the_result() {
    let (mut contacts, mut weights, mut robots) = (0, 0, 0);
    for checked in structures().iter().step_by(2) {
        let scene = scene(&checked.file);
        let analysis = Analysis::with(&scene, &Options::default());
        let drawing = figure::draw(&analysis, Kind::Forces, &figure::Options::default());
        let svg = svg::write(&drawing);
        let document = roxmltree::Document::parse(&svg).expect("XML");
        let frame = &checked.json["frames"][0];
        for node in document.descendants().filter(|n| n.has_tag_name("title")) {
            let title = node.text().unwrap_or_default();
            let Some((what, written_amount)) = title.split_once(": ") else {
                continue;
            };
            let fits = |force: [f64; 2]| {
                let (written, at) = amount(written_amount);
                let size = dot(force, force).sqrt();
                let angle = libm::atan2(force[1], force[0]).to_degrees();
                let off = at.map_or(0.0, |at: f64| (at - angle + 540.0).rem_euclid(360.0) - 180.0);
                written.is_nan() || ((written - size).abs() <= 5.1e-3 * size && off.abs() <= 0.51)
            };
            if let Some((on, from)) = (what.strip_prefix("Force on block ")).and_then(|w| w.split_once(" from ")) {
                if let Some(robot) = from.strip_prefix("robot ") {
                    let given = list(&frame["robots"]).iter();
                    let mut given = given.filter(|r| r["id"] == robot && r["holds"] == on);
                    assert!(given.any(|r| fits(pair(&r["force"]))), "{title}: {}", checked.file);
                    robots += 1;
                    continue;
                }
                let from = from.strip_prefix("block ").unwrap_or("ground");
                let between = list(&frame["interfaces"]).iter().filter_map(|interface| {
                    let force = pair(&interface["resultant"]["force"]);
                    let bodies = [&interface["bodies"][0], &interface["bodies"][1]];
                    if bodies[0] == on && bodies[1] == from {
                        Some(force)
                    } else if bodies[1] == on && bodies[0] == from {
                        Some([-force[0], -force[1]])
                    } else {
                        None
                    }
                });
                let between: Vec<[f64; 2]> = between.collect();
                assert!(between.into_iter().any(fits), "{title}: {}", checked.file);
                contacts += 1;
            } else if let Some((one, other)) = what.strip_prefix("Force between ").and_then(|w| w.split_once(" and ")) {
                let id = |name: &str| if name == "the ground" { "ground".to_owned() } else { name.to_owned() };
                let between = list(&frame["interfaces"]).iter().any(|interface| {
                    let bodies = [&interface["bodies"][0], &interface["bodies"][1]];
                    let force = pair(&interface["resultant"]["force"]);
                    let same = [[one, other], [other, one]].iter().any(|p| (0..2).all(|k| *bodies[k] == *id(p[k])));
                    same && (fits(force) || fits([-force[0], -force[1]]))
                });
                assert!(between, "{title}: {}", checked.file);
                contacts += 1;
            } else if let Some(on) = what.strip_prefix("Weight of block ") {
                let block = scene.blocks().iter().find(|b| b.id == on).expect("a block");
                let down = scene.down();
                assert!(fits([down.x * block.weight, down.y * block.weight]), "{title}");
                weights += 1;
            }
        }
    }
    assert!(contacts > 100 && weights > 50 && robots > 3, "{contacts} {weights} {robots}");
}

/// Unsupported blocks are reported with the correct reason: no path leads from them to the ground, or there is one
/// but adhesion could not hold them.
#[test]
fn unsupported_blocks_are_reported_with_their_true_reason() {
    let ground = json!([{ "polygon": [[-9, -1], [9, -1], [9, 0], [-9, 0]] }]);
    let tip = json!({ "id": "tip", "polygon": [[0, 0], [3, 1], [3, 3], [-1, 2]], "weight": 5 });
    let high = |id: &str, x: f64| {
        let polygon = json!([[x, 5], [x + 1.0, 5], [x + 1.0, 6], [x, 6]]);
        json!({ "id": id, "polygon": polygon, "weight": 1 })
    };
    let file = json!({ "drystone": 1, "corner_contacts": true, "friction": 0.5, "ground": ground,
        "blocks": [tip, high("a", 5.0), high("b", 6.0)] });
    let checked = super::check(&file);
    let frame = &checked.json["frames"][0];
    assert_eq!(frame["unsupported"], json!(["tip", "a", "b"]));
    let table = tables(&[checked]).remove(0);
    let says = |part: &str| table.lines().any(|line| line.trim() == part);
    assert!(says("nothing carries a, b: no chain of contacts leads to the ground or to a robot"), "{table}");
    let touches = "nothing carries tip: even if all contacts could stick and no robot had limits, no forces would balance the loads";
    assert!(says(touches), "{table}");
}
