//! Notes: input that is allowed in a scene but probably not intended.

use drystone::analysis::Verdict;
use drystone::scene::{Code, Note, NoteCode, Scene};
use drystone::{Analysis, starter};

const GROUND: &str = r#""ground": [{ "polygon": [[-5, -1], [9, -1], [9, 0], [-5, 0]] }]"#;

fn notes(text: &str) -> Vec<Note> {
    let scene = Scene::from_json(text).unwrap_or_else(|p| panic!("{text}\n{p}"));
    Analysis::new(&scene).notes
}

/// Scenes that cause one note each, with the code, path and line of the note.
fn cases() -> Vec<(String, NoteCode, &'static str, usize)> {
    let square = r#""polygon": [[0, 0], [1, 0], [1, 1], [0, 1]]"#;
    let scene = |rest: &str| format!("{{ \"drystone\": 1, {GROUND},\n{rest} }}");
    let block = format!("\"blocks\": [{{ \"id\": \"a\", {square}, \"weight\": 5 }}]");
    vec![
        (scene(&format!("\"friction\": 2.5, {block}")), NoteCode::FrictionHigh, "friction", 2),
        (
            scene(&format!("\"materials\": {{ \"ice\": {{ \"friction\": 30 }} }}, {block}")),
            NoteCode::FrictionHigh,
            "materials.ice.friction",
            2,
        ),
        (
            scene(&format!("{block},\n\"robots\": [{{ \"holds\": \"a\",\n\"at\": [1, 1.5] }}]")),
            NoteCode::GripOutside,
            "robots[0].at",
            4,
        ),
        (
            scene(&format!(
                "{block}, \"robots\": [{{ \"id\": \"r\" }}],\n\"steps\": [{{ \"place\": [\"a\"] }},\n{{ \"hold\": {{ \"r\": {{ \"block\": \"a\", \"at\": [-0.01, 0.5] }} }} }}]"
            )),
            NoteCode::GripOutside,
            "steps[1].hold.r.at",
            4,
        ),
        (
            scene(&format!("{block}, \"loads\": [{{ \"block\": \"a\", \"force\": [1, 0], \"at\": [0.5, 2] }}]")),
            NoteCode::LoadOutside,
            "loads[0].at",
            2,
        ),
        (scene(&format!("{block}, \"robots\": [{{}}]")), NoteCode::UnusedRobot, "robots[0]", 2),
        (
            scene(&format!(
                "\"blocks\": [{{ \"id\": \"a\", {square}, \"weight\": 5 }},\n{{ \"id\": \"b\", {square}, \"at\": [2, 0], \"weight\": 5 }}], \"steps\": [{{ \"place\": [\"a\"] }}]"
            )),
            NoteCode::UnusedBlock,
            "blocks[1]",
            3,
        ),
        (
            scene(&format!("\"blocks\": [{{ {square} }}],\n\"loads\": [{{ \"block\": \"1\", \"force\": [0, -500] }}]")),
            NoteCode::DefaultDensity,
            "blocks[0]",
            2,
        ),
        (
            scene(&format!(
                "\"blocks\": [{{ {square} }}],\n\"robots\": [{{ \"holds\": \"1\", \"limits\": {{ \"force\": 500 }} }}]"
            )),
            NoteCode::DefaultDensity,
            "blocks[0]",
            2,
        ),
        (scene(&format!("\"blocks\": [{{ {square} }}]")), NoteCode::DefaultDensity, "blocks[0]", 2),
        (format!("{{ \"drystone\": 1, {block} }}"), NoteCode::NoGround, "ground", 1),
        (scene("\"blocks\": []"), NoteCode::NoBlocks, "blocks", 2),
        (scene(&block.replace("\"weight\": 5", "\"weight\": 0")), NoteCode::NoWeight, "blocks", 2),
        // A wall in kilometres.
        (
            scene("\"blocks\": [{ \"polygon\": [[0, 0], [18000, 0], [18000, 90], [0, 90]], \"weight\": 5 }]"),
            NoteCode::ImplausibleSize,
            "blocks",
            2,
        ),
        // Kilonewtons per cubic metre as a density, and pounds-force per cubic foot of water.
        (
            scene(&format!("\"blocks\": [{{ {square}, \"density\": 23 }}]")),
            NoteCode::ImplausibleDensity,
            "blocks[0].density",
            2,
        ),
        (
            scene(&format!(
                "\"units\": {{ \"length\": \"ft\", \"force\": \"lbf\" }}, {block}, \"loads\": [{{ \"block\": \"a\", \"side\": \"left\",\n\"pressure\": {{ \"surface\": 1, \"unit_weight\": 62.4 }} }}]"
            )),
            NoteCode::ImplausibleUnitWeight,
            "loads[0].pressure.unit_weight",
            3,
        ),
        // A picture, in which y points down.
        (
            scene("\"blocks\": [{ \"polygon\": [[0, -9], [1, -9], [1, -8], [0, -8]], \"weight\": 5 }]"),
            NoteCode::BelowGround,
            "ground",
            1,
        ),
        (
            scene(
                "\"density\": 2500, \"blocks\": [{ \"polygon\": [[0, 0], [1, 0], [1, 1], [0, 1]] },\n{ \"polygon\": [[1.004, 0], [2, 0], [2, 1], [1.004, 1]] }]",
            ),
            NoteCode::NearMiss,
            "blocks[1]",
            3,
        ),
        (
            scene(&format!(
                "\"blocks\": [{{ \"id\": \"a\", {square}, \"weight\": 5, \"at\": [2, 0],\n\"angle\": 1.5708 }}]"
            )),
            NoteCode::AngleRadians,
            "blocks[0].angle",
            3,
        ),
    ]
}

#[test]
fn every_note_has_its_path_and_line_and_can_be_silenced() {
    let mut missing = NoteCode::ALL.to_vec();
    for (text, code, path, line) in cases() {
        let found = notes(&text);
        assert_eq!(found.len(), 1, "{text}\n{found:?}");
        assert_eq!((found[0].code, found[0].path.as_str(), found[0].line), (code, path, line), "{text}");
        assert!(found[0].hint.contains(&format!("\"silence\": [\"{code}\"]")), "{}", found[0].hint);
        missing.retain(|c| *c != code);
        let silent = text.replacen('{', &format!("{{ \"silence\": [\"{code}\"],"), 1);
        assert_eq!(notes(&silent), [], "{silent}");
    }
    // `--set` has tests of its own.
    assert_eq!(missing, [NoteCode::SetUnused]);
}

#[test]
fn usual_input_has_no_notes() {
    for text in [
        // A grip and a load on the boundary, a friction of 2, a block that is only planned, a density together with a
        // load.
        format!(
            "{{ \"drystone\": 1, {GROUND}, \"friction\": 2, \"density\": 2500, \"blocks\": [
                {{ \"id\": \"a\", \"polygon\": [[0, 0], [1, 0], [1, 1], [0, 1]] }},
                {{ \"id\": \"b\", \"polygon\": [[2, 0], [3, 0], [3, 1], [2, 1]] }}],
              \"robots\": [{{ \"id\": \"r\" }}], \"loads\": [{{ \"block\": \"a\", \"force\": [1, 0], \"at\": [0, 0.3] }}],
              \"steps\": [{{ \"place\": [\"a\"], \"hold\": {{ \"r\": {{ \"block\": \"a\", \"at\": [0.7, 1] }} }}, \"plan\": {{ \"r\": \"b\" }} }}] }}"
        ),
        starter::Arch::default().scene().to_json(),
        drystone::scene::starter().to_owned(),
    ] {
        assert_eq!(notes(&text), [], "{text}");
    }
}

#[test]
fn a_note_changes_no_verdict_and_an_unknown_code_is_a_problem() {
    let text = format!(
        "{{ \"drystone\": 1, {GROUND}, \"blocks\": [{{ \"polygon\": [[0, 0], [1, 0], [1, 1], [0, 1]], \"friction\": 3, \"weight\": 5 }}] }}"
    );
    let scene = Scene::from_json(&text).expect("sound");
    let analysis = Analysis::new(&scene);
    assert_eq!((analysis.verdict(), analysis.notes.len()), (Verdict::Stable, 1));
    let wrong = text.replacen('{', "{ \"silence\": [\"friction\"],", 1);
    let problems = Scene::from_json(&wrong).expect_err("refused");
    assert_eq!((problems.list[0].code, problems.list[0].path.as_str()), (Code::UnknownChoice, "silence[0]"));
}

#[test]
fn of_many_near_misses_at_most_ten_are_noted() {
    let blocks: Vec<String> = (0..30)
        .map(|i| {
            let (left, right) = (1.004 * f64::from(i), 1.004 * f64::from(i) + 1.0);
            format!("{{ \"polygon\": [[{left}, 0], [{right}, 0], [{right}, 1], [{left}, 1]] }}")
        })
        .collect();
    let text = format!(
        "{{ \"drystone\": 1, \"density\": 2500, \"ground\": [{{ \"polygon\": [[-5, -1], [99, -1], [99, 0], [-5, 0]] }}], \"blocks\": [{}] }}",
        blocks.join(",")
    );
    let found = notes(&text);
    assert_eq!(found.len(), 10);
    assert!(found[9].message.contains("there are more"), "{}", found[9].message);
}
