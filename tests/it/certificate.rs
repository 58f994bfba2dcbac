//! Certificates: what `check --certificate` writes is proved exactly, by our checker and by `examples/verify/verify.py`
//! alike, and is refused as soon as a number in it is wrong.

mod conditions;
mod friction;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use drystone::analysis::{MarginKinds, Options, Verdict};
use drystone::certificate::{Certificate, Checked};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::oracle::{number_of, random, small};

/// Frames that stand exactly at their limit, where rounding leaves no room for an exact proof: harmonic stacks, a block
/// whose load passes through its edge, and a wedge that is held by rounding alone.
const AT_THEIR_LIMIT: &[&str] = &["stack-4", "stack-6", "wedge-1e-7"];

/// The valid scenes of the project with at most this number of bytes.
fn scenes(largest: u64) -> Vec<(String, Scene)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["tests/scenes", "assets", "examples"] {
        collect(&root.join(folder), &mut files);
    }
    files.sort();
    let small = files.into_iter().filter(|file| fs::metadata(file).is_ok_and(|data| data.len() <= largest));
    small
        .filter_map(|file| {
            let scene = Scene::from_json(&fs::read_to_string(&file).ok()?).ok()?;
            Some((file.file_stem()?.to_str()?.to_owned(), scene))
        })
        .collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|end| end == "json") {
            files.push(path);
        }
    }
}

/// Writes a certificate and reads it back; both must be equal to the last bit.
fn certificate(scene: &Scene, options: &Options) -> Certificate {
    let certificate = Certificate::new(&mut Analysis::with(scene, options), String::new(), true);
    let text = certificate.to_json();
    let read = Certificate::from_json(text.as_bytes()).expect("a certificate");
    assert_eq!(read, certificate);
    read
}

/// Runs `verify.py` on certificates. Returns its lines for each of them. `None` without Python, which is said; with `CI`
/// set, Python must be there.
fn by_python(certificates: &[String]) -> Option<Vec<Vec<String>>> {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = Command::new("python3");
    command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/verify/verify.py"));
    for (number, text) in certificates.iter().enumerate() {
        let path = folder.path().join(format!("{number}.json"));
        fs::write(&path, text).expect("a certificate");
        command.arg(path);
    }
    let Ok(output) = command.output() else {
        assert!(std::env::var_os("CI").is_none(), "python3 is needed");
        // The one place where a test says that it leaves something out.
        #[allow(clippy::print_stderr, reason = "a skipped test says so")]
        {
            eprintln!("skipped: python3 is not there");
        }
        return None;
    };
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut pages = vec![Vec::new()];
    for line in text.lines() {
        pages.last_mut().expect("a page").push(line.to_owned());
        if !line.starts_with("frame ") {
            pages.push(Vec::new());
        }
    }
    pages.pop();
    assert_eq!(pages.len(), certificates.len(), "{text}");
    Some(pages)
}

/// Whether each frame and each changed frame is proved, in their order.
fn proved(checked: &Checked) -> Vec<bool> {
    let frames = checked.frames.iter().map(|frame| frame.is_exact());
    frames.chain(checked.limits.iter().map(|limit| limit.faults.is_empty())).collect()
}

fn proved_by_python(lines: &[String]) -> Vec<bool> {
    lines.iter().filter(|line| line.starts_with("frame ")).map(|line| line.ends_with(", exactly")).collect()
}

#[test]
fn verdicts_of_the_projects_scenes_are_exact_for_both_checkers() {
    let mut texts = Vec::new();
    let mut rust = Vec::new();
    let (mut frames, mut exact) = (0, 0);
    for (name, scene) in scenes(60_000) {
        let certificate = certificate(&scene, &Options::default());
        let checked = certificate.check().expect("a structure");
        for frame in checked.frames.iter().filter(|frame| frame.verdict != Verdict::Undecided.word()) {
            frames += 1;
            exact += usize::from(frame.is_exact());
            let at_limit = AT_THEIR_LIMIT.contains(&name.as_str());
            assert!(frame.is_exact() || at_limit, "{name}, frame {}: {:?}", frame.frame, frame.faults);
        }
        if scene.blocks().len() <= 40 && certificate.frames.len() <= 12 {
            texts.push(certificate.to_json());
            rust.push((name, proved(&checked)));
        }
    }
    assert!(frames >= 170 && exact * 100 >= frames * 96, "{exact} of {frames} frames are exact");
    let Some(pages) = by_python(&texts) else { return };
    for ((name, rust), page) in rust.iter().zip(&pages) {
        assert_eq!(*rust, proved_by_python(page), "{name}: {page:#?}");
    }
}

/// A scene with all margins that a margin has: friction, tilt, horizontal load, kernel, load factor and robots.
const ROBOT: &str = r#"{ "drystone": 1, "friction": 0.6,
    "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
    "robots": [{ "id": "arm", "holds": "b", "limits": { "force": 50, "torque": 60 } }],
    "blocks": [{ "id": "a", "polygon": [[2, 0], [4, 0], [4, 1], [2, 1]], "weight": 100 },
               { "id": "b", "polygon": [[3, 1], [5.5, 1], [5.5, 2], [3, 2]], "weight": 90 }],
    "loads": [{ "block": "b", "force": [8, -4], "at": [3.2, 2] }] }"#;

/// Scenes without friction, with contacts of one point, and with parts that cannot move. `DRYSTONE_CERTIFICATES` sets their
/// number, `DRYSTONE_ORACLE_FIRST` the number of the first scene.
#[test]
fn random_hard_scenes_are_exact_for_both_checkers() {
    let (mut frames, mut inexact, mut steps) = (0, Vec::new(), 0);
    let first = number_of("DRYSTONE_ORACLE_FIRST", 0);
    let numbers: Vec<u64> = (first..first + number_of("DRYSTONE_CERTIFICATES", 90)).collect();
    for numbers in numbers.chunks(500) {
        let (mut texts, mut rust) = (Vec::new(), Vec::new());
        for file in numbers.iter().flat_map(|number| [random::scene(*number).1, small::scene(*number)]) {
            let Ok(scene) = Scene::from_json(&file.to_string()) else { continue };
            let certificate = certificate(&scene, &Options::default());
            let checked = certificate.check().expect("a structure");
            for (form, frame) in certificate.frames.iter().zip(&checked.frames) {
                if frame.verdict == Verdict::Undecided.word() {
                    continue;
                }
                frames += 1;
                if form.forces.is_none() && form.motion.is_none() {
                    inexact.push((file.to_string(), "no proof".to_owned(), Vec::new()));
                } else if !frame.is_exact() {
                    inexact.push((file.to_string(), frame.verdict.clone(), frame.faults.clone()));
                }
            }
            texts.push(certificate.to_json());
            rust.push(proved(&checked));
        }
        steps += texts.iter().filter(|text| text.contains("\"still\":")).count();
        let Some(pages) = by_python(&texts) else { continue };
        for ((text, rust), page) in texts.iter().zip(&rust).zip(&pages) {
            assert_eq!(*rust, proved_by_python(page), "{text}\n{page:#?}");
        }
    }
    assert!(inexact.len() * 100 <= frames * 3, "{} of {frames} frames are not exact: {inexact:#?}", inexact.len());
    assert!(steps > 0, "no motion needs contacts that stay closed");
}

/// The forces on the lower of two blocks balance it as given, but not those on the upper one. The correction of the upper
/// block changes those on the lower one, which needs its own step then.
#[test]
fn a_block_that_an_earlier_step_unbalances_is_corrected() {
    let text = r#"{ "drystone": 1, "friction": 1, "ground": [{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }],
        "blocks": [{ "id": "lower", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": 8 },
                   { "id": "upper", "polygon": [[0, 1], [1, 1], [1, 2], [0, 2]], "weight": 4 }] }"#;
    let mut certificate = certificate(&Scene::from_json(text).expect("a scene"), &Options::default());
    let frame = &mut certificate.frames[0];
    let forces = frame.forces.as_mut().expect("it stands");
    assert_eq!(forces.order.iter().map(|(bodies, _)| bodies[0]).collect::<Vec<_>>(), [2, 1]);
    for (contact, force) in frame.contacts.iter().zip(&mut forces.contacts) {
        let borne = if contact.bodies.contains(&0) { 6.0 } else { 2.0 };
        *force = [borne + 0.125, borne, 0.0];
    }
    assert_eq!(proved(&certificate.check().expect("a structure")), [true]);
    let Some(pages) = by_python(&[certificate.to_json()]) else { return };
    assert_eq!(proved_by_python(&pages[0]), [true], "{pages:#?}");
}

/// A push of 4 kN that is fixed, and one of 1 kN that the load factor multiplies, on a block of 88 kN.
#[test]
fn certificates_keep_fixed_loads_at_every_load_factor() {
    let text = r#"{ "drystone": 1, "friction": 2, "ground": [{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }],
        "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]], "weight": 88000 }],
        "loads": [{ "block": "a", "force": [4000, 0], "at": [0, 1], "fixed": true },
                  { "block": "a", "force": [1000, 0], "at": [0, 2] }] }"#;
    let options = Options::default().margins(MarginKinds::ALL);
    let certificate = certificate(&Scene::from_json(text).expect("a scene"), &options);
    let checked = certificate.check().expect("a structure");
    assert!(proved(&checked).iter().all(|proved| *proved), "{checked:?}");
    assert!(certificate.limits.iter().any(|limit| limit.of.starts_with("load_factor high")), "a limit of the loads");
    let texts = [certificate.to_json()];
    let Some(pages) = by_python(&texts) else { return };
    assert!(proved_by_python(&pages[0]).iter().all(|proved| *proved), "{:#?}", pages[0]);
}

/// A log in a groove, which stands, and three logs that slide apart.
#[test]
fn certificates_of_circles_are_exact_and_need_every_contact() {
    let groove = r#"{ "drystone": 1, "ground": [{ "polygon": [[-2, 2], [0, 0], [2, 2], [2, -1], [-2, -1]] }],
        "blocks": [{ "circle": { "centre": [0, 1.4142135623730951], "radius": 1 } }] }"#;
    let pile = r#"{ "drystone": 1, "friction": 0.26, "ground": [{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }],
        "blocks": [{ "circle": { "centre": [-1, 1], "radius": 1 } }, { "circle": { "centre": [1, 1], "radius": 1 } },
                   { "circle": { "centre": [0, 2.732050807568877], "radius": 1 } }] }"#;
    let mut texts = Vec::new();
    for (text, stands) in [(groove, true), (pile, false)] {
        let certificate = certificate(&Scene::from_json(text).expect("a scene"), &Options::default());
        let checked = certificate.check().expect("a structure");
        assert!(proved(&checked).iter().all(|proved| *proved), "{checked:?}");
        texts.push(certificate.to_json());
        // A motion proves nothing without the contact of the two lower logs, of a log with the ground, or at a wrong place.
        for left_out in (0..certificate.frames[0].contacts.len()).filter(|_| !stands) {
            let mut wrong = certificate.clone();
            wrong.frames[0].contacts.remove(left_out);
            assert!(!proved(&wrong.check().expect("a structure"))[0]);
            texts.push(wrong.to_json());
        }
        let mut wrong = certificate.clone();
        wrong.frames[0].contacts[0].points[0][0] += 1e-3;
        assert!(!proved(&wrong.check().expect("a structure"))[0]);
        texts.push(wrong.to_json());
    }
    let Some(pages) = by_python(&texts) else { return };
    let by_python: Vec<bool> = pages.iter().map(|page| proved_by_python(page)[0]).collect();
    assert_eq!(by_python.iter().map(|exact| usize::from(*exact)).sum::<usize>(), 2, "{by_python:?}");
    assert!(by_python[0] && by_python[2]);
}

#[test]
fn both_sides_of_margins_and_capacities_are_exact() {
    let robot = Scene::from_json(ROBOT).expect("a scene");
    let mut texts = Vec::new();
    let (mut sides, mut exact, mut kinds) = (0, 0, std::collections::BTreeSet::new());
    let mut inexact = Vec::new();
    let all = scenes(3_000).into_iter().filter(|(name, scene)| {
        !AT_THEIR_LIMIT.contains(&name.as_str()) && scene.frames().len() == 1 && scene.blocks().len() <= 9
    });
    for (name, scene) in std::iter::once(("robot".to_owned(), robot)).chain(all.take(30)) {
        let certificate = certificate(&scene, &Options::default().margins(MarginKinds::ALL));
        let checked = certificate.check().expect("a structure");
        for limit in &checked.limits {
            sides += 1;
            exact += usize::from(limit.faults.is_empty());
            kinds.insert(limit.of.rsplit_once(' ').expect("a value").0.to_owned());
            if !limit.faults.is_empty() {
                inexact.push(format!("{name}: {limit:?}"));
            }
        }
        texts.push((certificate.to_json(), proved(&checked)));
    }
    assert!(sides > 200 && exact * 100 >= sides * 96, "{exact} of {sides} sides are exact: {inexact:#?}");
    for kind in ["friction low", "tilt high", "horizontal_load low", "kernel high", "load_factor high", "r0 fy low"] {
        assert!(kinds.contains(kind), "{kind}: {kinds:?}");
    }
    let Some(pages) = by_python(&texts.iter().map(|(text, _)| text.clone()).collect::<Vec<_>>()) else { return };
    for ((text, rust), page) in texts.iter().zip(&pages) {
        assert_eq!(*rust, proved_by_python(page), "{text}\n{page:#?}");
    }
}

/// A placement tolerance is proved by forces for all errors, and the pattern that falls by a motion.
#[test]
fn placement_tolerances_are_exact_for_both_checkers() {
    let mut texts = Vec::new();
    let (mut stand, mut fall) = (0, 0);
    let robot = Scene::from_json(ROBOT).expect("a scene");
    let all = scenes(3_000).into_iter().filter(|(name, scene)| {
        let is_plain = scene.cases().is_empty() && scene.vehicle().is_none();
        is_plain && !AT_THEIR_LIMIT.contains(&name.as_str()) && scene.frames().len() == 1 && scene.blocks().len() <= 14
    });
    for (name, scene) in std::iter::once(("robot".to_owned(), robot)).chain(all.take(30)) {
        let certificate = certificate(&scene, &Options::default().placement(true));
        let checked = certificate.check().expect("a structure");
        for (limit, form) in checked.limits.iter().zip(&certificate.limits) {
            assert_eq!(limit.faults, [""; 0], "{name}: {}", form.change.to_json());
            let size = form.change.errors.as_ref().expect("errors").size;
            let stated: f64 = limit.of.split(' ').nth(1).expect("a number").parse().expect("a number");
            assert!((size - stated).abs() <= 1.01e-6 * stated, "{name}: {size} instead of {stated}");
            *(if limit.verdict == Verdict::Stable.word() { &mut stand } else { &mut fall }) += 1;
        }
        // Larger errors are not proved: a tolerance is found to a thousandth.
        let mut wrong = certificate.clone();
        for limit in &mut wrong.limits {
            let factor = if limit.verdict == Verdict::Stable.word() { 1.002 } else { 0.9 };
            limit.change.errors.as_mut().expect("errors").size *= factor;
        }
        let checked = wrong.check().expect("a structure");
        assert!(checked.limits.iter().all(|limit| !limit.faults.is_empty()), "{name}: {checked:?}");
        texts.extend([certificate, wrong].map(|own| (own.to_json(), proved(&own.check().expect("a structure")))));
    }
    assert!(stand > 12 && fall > 10, "{stand} and {fall}");
    let Some(pages) = by_python(&texts.iter().map(|(text, _)| text.clone()).collect::<Vec<_>>()) else { return };
    for ((text, rust), page) in texts.iter().zip(&pages) {
        assert_eq!(*rust, proved_by_python(page), "{text}\n{page:#?}");
    }
}

/// A left-out contact proves a margin too small, and a block that is placed twice has its weight twice.
#[test]
fn changed_frames_need_every_contact_and_no_block_counts_twice() {
    let right = certificate(&Scene::from_json(ROBOT).expect("a scene"), &Options::default().margins(MarginKinds::ALL));
    let (mut bare, mut twice) = (right.clone(), right.clone());
    // Replace the contact between the two blocks by a copy of the other contact, so that it is missing.
    let contacts = &mut bare.frames[0].contacts;
    let blocks = contacts.iter().position(|contact| contact.bodies == [2, 1]).expect("a joint");
    contacts[blocks] = contacts[1 - blocks].clone();
    let checked = bare.check().expect("a structure");
    let beyond = checked.limits.iter().filter(|limit| limit.verdict == Verdict::Unstable.word());
    let is_refused = |faults: &[String]| faults.iter().any(|fault| fault.contains("touch without a contact"));
    assert!(beyond.clone().count() > 0 && beyond.clone().all(|limit| is_refused(&limit.faults)), "{checked:?}");
    twice.frames[0].placed.push(right.frames[0].placed[0]);
    assert!(twice.check().is_err());
    let Some(pages) = by_python(&[bare.to_json(), twice.to_json()]) else { return };
    let beyond = pages[0].iter().filter(|line| line.contains(": falls"));
    assert!(
        beyond.clone().count() > 0 && beyond.clone().all(|line| is_refused(std::slice::from_ref(line))),
        "{:#?}",
        pages[0]
    );
    assert!(proved_by_python(&pages[1]).iter().all(|proved| !proved), "{:#?}", pages[1]);
}

/// Changes of a certificate that the page does not allow. Each is refused as a whole by both checkers.
#[test]
fn keys_and_types_that_are_not_on_the_page_prove_nothing() {
    let right = certificate(&Scene::from_json(ROBOT).expect("a scene"), &Options::default().margins(MarginKinds::ALL))
        .to_json();
    let right: Value = serde_json::from_str(&right).expect("JSON");
    let changes: [(&str, &str, Value); 14] = [
        ("/limits/0", "gravity", json!([0, -1])),
        ("/limits/0", "contacts", json!([])),
        ("/limits/0/change", "placed", json!([1])),
        ("/limits/0/change", "contacts", json!([])),
        ("/frames/0", "friction", json!(9)),
        ("/frames/0", "errors", json!({ "size": 0 })),
        ("/frames/0", "frame", json!(1.0)),
        ("/frames/0", "placed", json!([true, 2])),
        ("/frames/0", "gravity", json!([0, -1, 0])),
        ("/frames/0/contacts/0", "bodies", json!([1.0, 0])),
        ("/bodies/0", "ground", json!(1)),
        ("/bodies/1", "weight", json!("8")),
        ("", "listed", json!(null)),
        ("", "gravity?", json!([0, -1])),
    ];
    let mut texts = Vec::new();
    for (place, key, value) in changes {
        let mut changed = right.clone();
        changed.pointer_mut(place).expect("a place")[key] = value;
        texts.push(changed.to_string());
    }
    let mut twice = right.clone();
    twice["frames"].as_array_mut().expect("frames").push(right["frames"][0].clone());
    let right = right.to_string();
    texts.push(right.replacen('{', r#"{"listed":true,"#, 1));
    texts.push(format!("\u{feff}{right}"));
    texts.push("[".repeat(100_000));
    texts.push(twice.to_string());
    for text in &texts {
        let read = Certificate::from_json(text.as_bytes());
        assert!(read.is_err() || read.is_ok_and(|file| file.check().is_err()), "{}", &text[..text.len().min(2000)]);
    }
    let Some(pages) = by_python(&texts) else { return };
    for (text, page) in texts.iter().zip(&pages) {
        let is_refused = page.len() == 1 && page[0].contains("proves nothing");
        assert!(is_refused, "{page:?}\n{}", &text[..text.len().min(2000)]);
    }
}

/// A certificate without frames is right, but proves nothing. A hole that is larger than its outline is no structure.
#[test]
fn certificates_of_nothing_are_not_proved() {
    let right = certificate(&Scene::from_json(ROBOT).expect("a scene"), &Options::default());
    let (mut none, mut hollow) = (right.clone(), right.clone());
    none.frames.clear();
    let corners = hollow.bodies[1].outline.iter().rev();
    let corners: Vec<_> = corners.map(|[x, y]| [2.0 * x, 2.0 * y]).collect();
    hollow.bodies[1].holes = vec![corners];
    assert!(!none.check().expect("a structure").is_exact());
    let refused = hollow.check().expect_err("a hole without stone around it").join("; ");
    assert!(refused.contains("larger than its outline"), "{refused}");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("none.json"), none.to_json()).expect("a file");
    let ran = Command::new(env!("CARGO_BIN_EXE_drystone")).args(["verify", "none.json"]).current_dir(&folder).output();
    let ran = ran.expect("the program");
    assert_eq!(ran.status.code(), Some(3), "{ran:?}");
    let mut python = Command::new("python3");
    python
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/verify/verify.py"))
        .arg(folder.path().join("none.json"));
    if let Ok(ran) = python.output() {
        assert_eq!(ran.status.code(), Some(1), "{ran:?}");
    }
    let Some(pages) = by_python(&[hollow.to_json()]) else { return };
    assert_eq!(proved_by_python(&pages[0]), [false], "{pages:#?}");
}

#[test]
fn a_wrong_number_is_refused_by_both_checkers_or_by_none() {
    let mut random = 1_u64;
    let mut next = |below: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % below
    };
    let sources: Vec<Certificate> = scenes(2_500)
        .iter()
        .filter(|(_, scene)| scene.frames().len() == 1 && scene.blocks().len() <= 5)
        .take(12)
        .map(|(_, scene)| certificate(scene, &Options::default().margins(MarginKinds::ALL).placement(true)))
        .filter(|certificate| !certificate.limits.is_empty())
        .collect();
    let mut mutants = Vec::new();
    let count = number_of("DRYSTONE_MUTANTS", 400) as usize;
    while mutants.len() < count {
        // Each changed frame has its own proof, so one beside the unchanged frame is enough: it is drawn for each mutant.
        let mut source = sources[next(sources.len())].clone();
        let kept = next(source.limits.len());
        source.limits = vec![source.limits.swap_remove(kept)];
        let text = source.to_json();
        // Alter one number with a decimal point: its sign, a digit, or its size.
        let starts: Vec<usize> = text.match_indices('.').map(|(at, _)| at).collect();
        let at = starts[next(starts.len())];
        let is_part = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
        let from = text[..at].rfind(|c| !is_part(c)).map_or(0, |place| place + 1);
        let end = text[at..].find(|c| !is_part(c)).map_or(text.len(), |place| at + place);
        let Ok(number) = text[from..end].parse::<f64>() else { continue };
        let altered = match next(4) {
            0 => -number,
            1 => number * 2.0 + 1.0,
            2 => number * (1.0 + 1e-6),
            _ => number * 0.3,
        };
        mutants.push(format!("{}{altered:?}{}", &text[..from], &text[end..]));
    }
    let rust: Vec<Vec<bool>> = mutants
        .iter()
        .map(|text| match Certificate::from_json(text.as_bytes()).expect("a certificate").check() {
            Ok(checked) => proved(&checked),
            Err(_) => vec![false],
        })
        .collect();
    let refused = rust.iter().filter(|proved| proved.contains(&false)).count();
    assert!(refused > count / 4 && refused < count, "{refused} of {count} are refused");
    let Some(pages) = by_python(&mutants) else { return };
    for ((text, rust), page) in mutants.iter().zip(&rust).zip(&pages) {
        let python = proved_by_python(page);
        // A certificate that is not one is refused as a whole by us, and in each frame that shows it by Python.
        let agree = if *rust == [false] { python.contains(&false) } else { *rust == python };
        assert!(agree, "{text}\n{rust:?}\n{page:#?}");
    }
}

#[test]
fn the_program_writes_and_verifies_a_certificate() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
    write("stands.json", ROBOT);
    write("falls.json", &ROBOT.replace("[8, -4]", "[800, -4]"));
    let run = |words: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_drystone")).args(words).current_dir(&folder).output();
        let output = output.expect("the program");
        let text = String::from_utf8(output.stdout).expect("text") + &String::from_utf8_lossy(&output.stderr);
        (output.status.code(), text)
    };
    let (code, json) = run(&["check", "stands.json", "--json", "--no-timing", "--certificate", "proof.json"]);
    assert!(code == Some(0) && json.contains("\"exact\": true"), "{json}");
    let (code, text) = run(&["verify", "proof.json", "stands.json"]);
    assert!(code == Some(0) && text.contains("frame 1: stands, exactly"), "{text}");
    let points = "a@2.2,1..2.8,1";
    let capacities = [
        (&[points][..], "corner 0"),
        (&["b"], "corner 0"),
        (&["a", "--for-all", "tilt=±1,friction=0.55..0.6"], "corner 0 case 3"),
        (&[points, "--for-all", "tilt=±1"], "corner 0 case 3"),
    ];
    for (words, corner) in capacities {
        run(&[&["check", "stands.json", "--certificate", "capacity.json", "--capacity"], words].concat());
        let (code, text) = run(&["verify", "capacity.json", "stands.json"]);
        let is_whole = text.contains(&format!("capacity {corner}")) && text.contains("capacity edge 0");
        assert!(code == Some(0) && is_whole && !text.contains("not proved"), "{text}");
    }
    let (code, text) = run(&["verify", "proof.json", "falls.json"]);
    assert!(code == Some(2) && text.contains("is not about falls.json: the bodies differ"), "{text}");
    let (code, json) = run(&["check", "falls.json", "--json", "--no-timing", "--accuracy", "proved"]);
    assert!(code == Some(1) && json.contains("\"exact\": true"), "{json}");
    run(&["check", "falls.json", "--certificate", "proof.json"]);
    let (code, text) = run(&["verify", "proof.json"]);
    assert!(code == Some(1) && text.contains("frame 1: falls, exactly"), "{text}");
    let proof = fs::read_to_string(folder.path().join("proof.json")).expect("a certificate");
    write("proof.json", &proof.replace("\"weight\":100.0", "\"weight\":100000.0"));
    let (code, text) = run(&["verify", "proof.json"]);
    assert!(code == Some(3) && text.contains("falls, not proved exactly"), "{text}");
    let (code, text) = run(&["verify", "stands.json"]);
    assert!(code == Some(2) && text.contains("is not a certificate"), "{text}");
    let (code, text) = run(&["check", "stands.json", "falls.json", "--certificate", "proof.json"]);
    assert!(code == Some(2) && text.contains("one scene"), "{text}");
}

/// The crane of the first scene holds a half arch at its centroid, which is no double, and carries no torque. A kernel has no
/// values above 1, also where a search ends just below it.
#[test]
fn grips_at_a_centroid_and_kernels_up_to_one_are_exact_for_both_checkers() {
    let first = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/starter.json")).expect("a scene");
    let kernel = include_str!("../fuzz/seeds/read_scene/kernel-limit.json");
    let certificates = [first.as_str(), kernel].map(|text| {
        let scene = Scene::from_json(text).expect("a scene");
        certificate(&scene, &Options::default().margins(MarginKinds::ALL))
    });
    let kernels = certificates[1].limits.iter().filter_map(|limit| limit.change.kernel);
    let kernels: Vec<f64> = kernels.collect();
    assert!(kernels.contains(&1.0) && kernels.iter().all(|kernel| *kernel <= 1.0), "{kernels:?}");
    assert!(certificates[0].frames.iter().flat_map(|frame| &frame.grips).any(|grip| grip.at.is_none()));
    for certificate in &certificates {
        let checked = certificate.check().expect("a structure");
        assert!(checked.is_exact(), "{checked:#?}");
    }
    let texts: Vec<String> = certificates.iter().map(Certificate::to_json).collect();
    for page in by_python(&texts).into_iter().flatten() {
        assert!(!proved_by_python(&page).contains(&false), "{page:#?}");
    }
}

/// The examples of the page are what the program writes for their scenes, and their exact values follow from it.
#[test]
fn the_page_explains_the_certificates_of_its_two_blocks() {
    let page = include_str!("../../src/doc/certificate.md").replace('−', "-");
    let frame = |name: &str| {
        let path = format!("{}/assets/certificate/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let scene = Scene::from_json(&fs::read_to_string(path).expect("a scene")).expect("valid");
        let certificate = certificate(&scene, &Options::default());
        assert!(proved(&certificate.check().expect("checked")).iter().all(|exact| *exact), "{name}");
        let block = &certificate.bodies[1];
        (certificate.frames[0].clone(), block.weight, block.loads[0].clone())
    };
    let says = |words: String| assert!(page.contains(&words), "{words}");

    let (stands, weight, push) = frame("stands");
    let contact = &stands.contacts[0];
    assert_eq!((contact.bodies, contact.points.as_slice()), ([1, 0], [[1.0, 0.0], [0.0, 0.0]].as_slice()));
    assert_eq!((push.at, contact.friction), (Some([0.0, 1.0]), 0.75));
    let forces = stands.forces.expect("forces");
    let [first, second, along] = forces.contacts[0];
    assert_eq!(forces.order, [(vec![1], vec![0, 1, 2])]);
    let moments = -0.5 * weight - push.force[0];
    let exact = [-moments, weight + moments, push.force[0]];
    for (component, exact) in [first, second, along].into_iter().zip(exact) {
        assert!((component - exact).abs() < 1e-14, "{component} {exact}");
    }
    says(format!("| weight, at (0.5, 0.5) | {weight} | {weight} | 0 | -{weight} | {} |", -0.5 * weight));
    says(format!("| push, at (0, 1) | {0} | {0} | {0} | 0 | -{0} |", push.force[0]));
    says(format!("| N₁, at (1, 0) | {first} | {0} | 0 | {0} | {0} |", exact[0]));
    says(format!("| N₂, at (0, 0) | {second} | {0} | 0 | {0} | 0 |", exact[1]));
    says(format!("| T | {along} | {0} | -{0} | 0 | 0 |", exact[2]));
    says(format!("|T| = {} ≤ μ (N₁ + N₂) = {}", exact[2], 0.75 * weight));

    let (falls, weight, push) = frame("falls");
    let motion = &falls.motion.expect("a motion")[0];
    let ([x, y], spin) = (motion.velocity, motion.spin);
    assert_eq!((motion.at, push.at), (Some([0.5, 0.5]), Some([0.0, 1.0])));
    says(format!("v = ({x}, {y}) at a = (0.5, 0.5) and\nω = {spin}"));
    let velocity = |at: [f64; 2]| [x - spin * (at[1] - 0.5), y + spin * (at[0] - 0.5)];
    let [right, left, top] = [[1.0, 0.0], [0.0, 0.0], [0.0, 1.0]].map(velocity);
    assert!(right[0] == 0.0 && left[0] == 0.0, "{right:?} {left:?}");
    let tiny = format!("{:.1}·10⁻¹⁵", 1e15 * right[1]);
    says(format!("| right corner (1, 0) | (0, {tiny}) | n·u = {tiny} ≥ μ"));
    says(format!("| left corner (0, 0) | (0, {0:.4}) | n·u = {0:.4} ≥ μ", left[1]));
    says(format!("| weight, at (0.5, 0.5) | ({x:.4}, {y:.4}) | -{weight} · {y:.4} = {:.4} |", -weight * y));
    let driven = push.force[0] * top[0];
    says(format!(
        "| push, at (0, 1) | ({:.4}, {:.4}) | {} · {:.4} = {driven:.4} |",
        top[0], top[1], push.force[0], top[0]
    ));
    says(format!("| sum of the powers | | {:.4} > 0 |", driven - weight * y));
}
