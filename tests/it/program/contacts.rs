//! Scenes that list their contacts: the well-known exercise on the stability of an assembly of two bodies.

use drystone::analysis::{Analysis, Options, Verdict};
use drystone::figure::{self, Kind};
use drystone::output;
use drystone::scene::Scene;
use drystone::scene::format::{BlockEntry, SceneFile};
use drystone::session::Session;
use serde_json::{Value, json};

use super::Bench;

/// Two bodies that touch each other and have three contacts with the ground, with the given masses and friction
/// coefficients.
fn assembly(masses: [f64; 2], friction: [f64; 4]) -> Value {
    let contact = |bodies: [&str; 2], at: [f64; 2], normal: f64, friction: f64| json!({ "bodies": bodies, "at": at, "normal": normal, "friction": friction });
    json!({ "drystone": 1, "title": "Two bodies",
        "blocks": [{ "id": "1", "centre": [25, 35], "mass": masses[0] }, { "id": "2", "centre": [66, 42], "mass": masses[1] }],
        "contacts": [contact(["1", "2"], [60.0, 60.0], 180.0, friction[0]), contact(["1", "ground"], [0.0, 0.0], 90.0, friction[1]),
            contact(["2", "ground"], [60.0, 0.0], 90.0, friction[2]), contact(["2", "ground"], [72.0, 0.0], 90.0, friction[3])] })
}

fn stands(file: &Value) -> bool {
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    Analysis::new(&scene).verdict() == Verdict::Stable
}

/// The value at which the verdict changes, found by bisection between a value at which the structure falls and one at
/// which it stands.
fn threshold(mut falls: f64, mut holds: f64, is_stable: impl Fn(f64) -> bool) -> f64 {
    assert!(!is_stable(falls) && is_stable(holds));
    for _ in 0..40 {
        let middle = 0.5 * (falls + holds);
        *if is_stable(middle) { &mut holds } else { &mut falls } = middle;
    }
    holds
}

#[test]
fn the_exercise_has_its_known_answers() {
    assert!(!stands(&assembly([2.0, 5.0], [0.5, 0.1, 0.5, 0.5])));
    assert!(stands(&assembly([2.0, 10.0], [0.5; 4])));
    let mass = threshold(2.0, 10.0, |mass| stands(&assembly([2.0, mass], [0.5; 4])));
    assert!((mass - 5.0).abs() < 1e-3, "{mass}");
    let friction = threshold(0.1, 0.5, |mu| stands(&assembly([2.0, 10.0], [0.5, mu, 0.5, 0.5])));
    assert!((friction - 0.3226).abs() < 5e-5, "{friction}");
}

/// A block with a centre touches other bodies only at listed contacts. Without any, it falls, also where its symbol, a
/// disc of 0.03 m, touches the ground.
#[test]
fn the_symbol_of_a_centre_touches_nothing() {
    for height in [0.03, 0.03 * libm::cos(std::f64::consts::FRAC_PI_8)] {
        let mut file = json!({ "drystone": 1, "corner_contacts": true,
            "ground": [{ "polygon": [[-3, -1], [3, -1], [3, 0], [-3, 0]] }],
            "blocks": [{ "id": "a", "centre": [0, height], "weight": 10 }] });
        assert!(!stands(&file), "{height}");
        file["contacts"] = json!([{ "bodies": ["a", "ground"], "at": [0, 0], "normal": 90 }]);
        assert!(stands(&file), "{height}");
    }
}

#[test]
fn every_command_accepts_a_contact_list() {
    let bench = Bench::empty();
    let rows =
        "x,y,mass\n25,35,2\n66,42,10\n1,2,60,60,pi,0.5\n1,0,0,0,pi/2,0.5\n2,0,60,0,1.5708,0.5\n2,0,72,0,1.5708,0.5\n";
    std::fs::write(bench.path("list.csv"), rows).expect("writable");
    let ran = bench.run("import list.csv -o stands.json");
    assert_eq!(ran.code, 0, "{}", ran.err);
    std::fs::write(bench.path("falls.json"), assembly([2.0, 5.0], [0.5, 0.1, 0.5, 0.5]).to_string()).expect("writable");
    assert_eq!(bench.run("check --margins --wedging stands.json").code, 0);
    let ran = bench.run("check --margins --explain falls.json");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert_eq!(bench.run("check --json --blocks falls.json stands.json").code, 1);
    for kind in ["forces", "flow", "mechanism", "thrust", "joints", "build", "structure"] {
        for scene in ["stands", "falls"] {
            let ran =
                bench.run(&format!("render {scene}.json --kind {kind} --dimensions --scale-bar -o {scene}-{kind}.svg"));
            assert_eq!(ran.code, 0, "{kind}: {}", ran.err);
        }
    }
    for line in [
        "render falls.json --kind freebody --block 2 -o free.svg",
        "render stands.json falls.json --kind compare -o compare.svg",
        "render falls.json --kind mechanism --animate 1 -o falls.gif",
        "render stands.json --zoom 2 -o zoom.svg",
        "report falls.json stands.json -o all.md --full",
        "report --compare falls.json stands.json -o change.md",
        "export stands.json -o stands.dxf",
    ] {
        let ran = bench.run(line);
        assert!(ran.code <= 2, "{line}: {}", ran.err);
    }
    let ran = bench.run_with("batch -", format!("{}\n", assembly([2.0, 10.0], [0.5; 4])).as_bytes());
    assert!(ran.out.contains("\"stable\""), "{}{}", ran.out, ran.err);
}

#[test]
fn figures_show_centres_contacts_normals_and_cones() {
    let scene = Scene::from_json(&assembly([2.0, 10.0], [0.5; 4]).to_string()).expect("sound");
    let drawing = figure::draw(&Analysis::new(&scene), Kind::Forces, &figure::Options::default());
    let svg = output::svg::write(&drawing);
    assert_eq!(svg.matches("class=\"contact\"").count(), 4);
    assert!(svg.contains("Contact of 2 and 1: friction coefficient 0.5"), "{svg}");
}

#[test]
fn a_session_accepts_a_contact_list() {
    let file: SceneFile = {
        let mut file = Scene::builder().friction(0.5);
        let scene = assembly([2.0, 10.0], [0.5; 4]);
        for block in scene["blocks"].as_array().expect("blocks") {
            let id = block["id"].as_str().expect("an id");
            let at =
                ["0", "1"].map(|i| block["centre"][i.parse::<usize>().expect("0 or 1")].as_f64().expect("a number"));
            file = file.block(BlockEntry::new(id).centre(at).mass(block["mass"].as_f64().expect("a number")));
        }
        for contact in scene["contacts"].as_array().expect("contacts") {
            let text = |i: usize| contact["bodies"][i].as_str().expect("a name").to_owned();
            let at = [0, 1].map(|i| contact["at"][i].as_f64().expect("a number"));
            let normal = contact["normal"].as_f64().expect("a number");
            file = file.contact(drystone::scene::format::ContactEntry::between(text(0), text(1), at, normal));
        }
        file
    };
    let mut session = Session::with(file, Options::default()).expect("sound");
    assert_eq!(session.verdict(), Verdict::Stable);
    assert_eq!(session.remove("2").expect("it is there"), Verdict::Unstable);
    let new = BlockEntry::new("3").centre([5.0, 5.0]).mass(1.0);
    assert_eq!(session.place(new).expect("it is sound"), Verdict::Unstable);
}

#[test]
fn invalid_contact_lists_are_refused_with_messages() {
    let mut file = assembly([2.0, 10.0], [0.5; 4]);
    file["contacts"][0]["bodies"] = json!(["1", "1"]);
    file["contacts"][1]["bodies"] = json!(["1", "grond"]);
    file["blocks"][0] = json!({ "id": "1", "centre": [0, 0] });
    file["blocks"][1]["angle"] = json!(30);
    let problems = Scene::from_json(&file.to_string()).expect_err("refused").to_string();
    for words in [
        "both bodies of the contact are the same body",
        "grond",
        "no `mass` and no `weight`",
        "the keys `centre` and `angle` are both given",
    ] {
        assert!(problems.contains(words), "{words}: {problems}");
    }
}
