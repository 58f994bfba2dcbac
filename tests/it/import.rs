//! Imports drawings of other programs and figures of this crate, and checks the scenes that result.

use std::fs;
use std::path::{Path, PathBuf};

use drystone::analysis::Verdict;
use drystone::import::{Format, Imported, Options, import};
use drystone::scene::format::{LimitsEntry, SceneFile};
use drystone::{Analysis, Scene, figure, output};
use serde_json::Value;

use crate::random::Random;

fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(name)
}

fn read(name: &str, format: Format, options: &Options) -> Imported {
    let text = fs::read_to_string(asset("import").join(name)).expect("an asset");
    import(&text, format, options).unwrap_or_else(|refusal| panic!("{name}: {refusal:?}"))
}

fn ids(imported: &Imported) -> Vec<&str> {
    let blocks = imported.scene.blocks.iter();
    blocks.filter_map(|b| b.id.as_deref()).collect()
}

fn remarks(imported: &Imported) -> Vec<(&str, &str)> {
    let one = imported.remarks.iter();
    one.map(|r| (r.element.as_str(), r.message.split([';', ':']).next().unwrap_or(""))).collect()
}

fn verdict(file: &SceneFile) -> Verdict {
    let scene = Scene::from_json(&file.to_json()).expect("an imported scene is sound");
    Analysis::new(&scene).frames[0].verdict
}

/// The number of pairs of bodies with an interface.
fn touching(file: &SceneFile) -> usize {
    let scene = Scene::from_json(&file.to_json()).expect("sound");
    let analysis = Analysis::new(&scene);
    let mut pairs: Vec<_> = analysis.frames[0].contacts.iter().map(|c| c.interface.bodies).collect();
    pairs.sort();
    pairs.dedup();
    pairs.len()
}

#[test]
fn a_doorway_from_inkscape_stands_at_its_real_size() {
    let imported = read("doorway.svg", Format::Svg, &Options::default());
    assert_eq!(imported.scene.blocks.len(), 17);
    assert_eq!(imported.scene.ground.len(), 1);
    assert_eq!(imported.scene.title.as_deref(), Some("A doorway"));
    assert_eq!(remarks(&imported), [("text \"text1\"", "a text cannot become a block")]);
    assert!(imported.notes.iter().any(|n| n.contains("0.001 m, because it is 210mm wide")), "{:?}", imported.notes);
    for skipped in ["g \"guides\"", "g \"older attempt\""] {
        assert!(imported.notes.iter().any(|n| n.contains(skipped)), "{skipped}: {:?}", imported.notes);
    }
    let crane = &imported.scene.robots[0];
    assert_eq!((crane.id.as_deref(), crane.holds.as_deref()), (Some("crane"), Some("load")));
    // Every brick of the left pier was drawn some thousandths of a millimetre off its intended position.
    assert!(imported.snapped.len() >= 7, "{:?}", imported.snapped);
    assert!(imported.snapped.iter().all(|s| s.distance < 5e-6 && !s.to.is_empty()));
    // Each pier has 2 pairs with the ground, 4 within courses and 8 between courses. The lintel lies on both piers,
    // and two blocks stand alone.
    assert_eq!(touching(&imported.scene), 2 * (2 + 4 + 8) + 2 + 2);
    assert_eq!(verdict(&imported.scene), Verdict::Stable);
    let unsnapped = Options::default().gap(0.0);
    let text = fs::read_to_string(asset("import/doorway.svg")).expect("an asset");
    assert!(import(&text, Format::Svg, &unsnapped).is_err(), "as drawn, the blocks overlap");
}

#[test]
fn an_arch_from_illustrator_stands_on_its_curves() {
    let imported = read("arch.svg", Format::Svg, &Options::default());
    let expected = ["v1", "v2", "v3", "v4", "v5", "keystone", "v7", "v8", "v9", "v10", "v11"];
    assert_eq!(ids(&imported), expected);
    assert_eq!(remarks(&imported), []);
    assert_eq!(imported.scene.robots[0].holds.as_deref(), Some("keystone"));
    assert_eq!(touching(&imported.scene), 12);
    let mut alone = imported.scene.clone();
    alone.robots.clear();
    assert_eq!(verdict(&alone), Verdict::Stable);
    // Without its keystone the arch falls.
    alone.blocks.remove(5);
    assert_eq!(verdict(&alone), Verdict::Unstable);
}

#[test]
fn a_drum_touches_the_hole_that_contains_it() {
    let imported = read("window.svg", Format::Svg, &Options::default());
    assert_eq!(ids(&imported), ["quoin-left", "quoin-right", "panel", "drum", "cap"]);
    assert_eq!(
        remarks(&imported),
        [("circle \"drum\"", "a gradient or pattern cannot become a material"), ("path \"crack\"", "it is open"),]
    );
    assert_eq!(imported.scene.blocks[2].holes.len(), 1);
    assert_eq!(touching(&imported.scene), 6);
    assert_eq!(verdict(&imported.scene), Verdict::Stable);
}

#[test]
fn geojson_and_wkt_become_scenes_with_their_values() {
    let steps = read("steps.geojson", Format::GeoJson, &Options::default());
    assert_eq!(ids(&steps), ["tread", "tread-2", "tread-3"]);
    assert_eq!(steps.scene.blocks[0].density, Some(2400.0));
    assert_eq!(steps.scene.ground[0].friction, Some(0.5));
    assert_eq!(steps.scene.robots[0].holds.as_deref(), Some("tread-3"));
    assert_eq!(steps.snapped[0].body, "tread", "both treads move half-way");
    assert_eq!(verdict(&steps.scene), Verdict::Stable);
    let options = Options::default().scale(2.0);
    let post = read("post.wkt", Format::Wkt, &options);
    assert_eq!(ids(&post), ["footing", "post"]);
    assert_eq!(post.scene.blocks[1].polygon.as_ref().expect("a polygon")[2], [2.5, 7.0]);
    assert_eq!(verdict(&post.scene), Verdict::Stable);
}

#[test]
fn an_arch_from_a_cad_program_stands() {
    // Written by ezdxf as AutoCAD 2010: voussoirs with bulges, a keystone of lines and arcs, block references, and
    // hatches.
    let imported = read("arch.dxf", Format::Dxf, &Options::default());
    let blocks = &imported.scene.blocks;
    assert_eq!((blocks.len(), imported.scene.ground.len()), (12, 2));
    assert_eq!(imported.scene.robots.len(), 1);
    assert_eq!(&ids(&imported)[8..10], ["FINIAL", "FINIAL-2"]);
    // 8 pairs of voussoirs, 2 springings, 2 finials and the hatched stone on the ground.
    assert_eq!(touching(&imported.scene), 8 + 2 + 2 + 1);
    assert_eq!(verdict(&imported.scene), Verdict::Stable);
    let warned: Vec<&str> = remarks(&imported).iter().map(|r| r.1).collect();
    assert_eq!(warned, ["it is open", "hatches without a drawn outline become blocks"], "an open spline and a hatch");
    assert!(imported.notes[0].contains("0.001 m, because the drawing states millimetres"));
    // The layer LIMESTONE sets the density. The first voussoir weighs as much as a ninth of the half ring, minus the
    // segments that the chords cut off.
    let scene = Scene::from_json(&imported.scene.to_json()).expect("sound");
    let ring = std::f64::consts::PI / 2.0 * (1.3 * 1.3 - 1.0) / 9.0 * 2500.0 * 9.81;
    let weight = scene.blocks()[0].weight;
    assert!((weight / ring - 1.0).abs() < 0.03, "{weight} {ring}");
}

#[test]
fn drawings_of_other_programs_in_dxf_become_scenes() {
    // Written by GDAL: every polygon is a hatch, and the header states inches.
    let mut options = Options::default();
    options.scale = Some(1.0);
    let imported = read("lintel.dxf", Format::Dxf, &options);
    assert_eq!((imported.scene.blocks.len(), imported.scene.ground.len()), (3, 1));
    assert_eq!(verdict(&imported.scene), Verdict::Stable);
    // Written by ezdxf as release 12: polylines with vertices, an array of a block, a rotated block, no unit.
    let imported = read("bricks.dxf", Format::Dxf, &Options::default());
    assert_eq!((imported.scene.blocks.len(), imported.scene.ground.len()), (7, 1));
    assert_eq!(verdict(&imported.scene), Verdict::Stable);
    assert!(imported.notes.iter().any(|n| n.contains("taken as ground by name: Fundament")));
}

#[test]
fn a_scene_exported_to_dxf_and_imported_again_gives_the_same_verdict() {
    for (name, text) in [("stands", drystone::scene::starter()), ("falls", drystone::scene::falling_starter())] {
        let scene = Scene::from_json(text).expect("sound");
        let analysis = Analysis::new(&scene);
        for (i, frame) in analysis.frames.iter().enumerate() {
            let drawing = figure::dxf(&analysis, i);
            let mut options = Options::default();
            options.scene.friction = Some(scene.blocks()[0].body.friction);
            let imported = import(&drawing, Format::Dxf, &options).expect("our own drawing");
            assert_eq!(imported.scene.blocks.len(), scene.frames()[i].placed.len(), "{name} {i}");
            assert!(imported.remarks.is_empty(), "{:?}", imported.remarks);
            let has_guide = |layer: &str| drawing.contains(&format!("\n  8\nguide {layer}"));
            assert_eq!(has_guide("thrust line"), frame.verdict == Verdict::Stable);
            assert_eq!(has_guide("mechanism"), frame.verdict == Verdict::Unstable);
        }
    }
}

#[test]
fn imported_figures_of_this_crate_have_the_same_verdicts() {
    let mut frames = 0;
    for entry in fs::read_dir(asset("thesis")).expect("scenes") {
        let path = entry.expect("readable").path();
        let text = fs::read_to_string(&path).expect("a scene");
        let scene = Scene::from_json(&text).expect("sound");
        let analysis = Analysis::new(&scene);
        let svg = output::svg::write(&figure::forces(&analysis, &figure::Options::default()));
        let json: Value = serde_json::from_str(&text).expect("JSON");
        let file = SceneFile::from_json(&text).expect("a scene file");
        let limits: Vec<Option<LimitsEntry>> = file.robots.into_iter().map(|robot| robot.limits).collect();
        for (number, (frame, found)) in scene.frames().iter().zip(&analysis.frames).enumerate() {
            let first = &scene.blocks()[frame.placed[0].0];
            let options = Options::default().frame(number).scene(
                Scene::builder()
                    .friction(json["friction"].as_f64().expect("given"))
                    .kernel(json["kernel"].as_f64().unwrap_or(0.0))
                    .gravity([0.0, -1.0])
                    .density(first.weight / first.body.polygon.area()),
            );
            let name = format!("{} frame {number}", path.display());
            let mut imported = import(&svg, Format::Svg, &options).unwrap_or_else(|r| panic!("{name}: {r:?}"));
            assert_eq!(imported.remarks, [], "{name}");
            let names: Vec<&str> = frame.placed.iter().map(|id| scene.blocks()[id.0].id.as_str()).collect();
            assert_eq!(ids(&imported), names, "{name}");
            assert_eq!(imported.scene.ground.len(), scene.ground().len(), "{name}");
            assert_eq!(imported.scene.robots.len(), frame.holds.len(), "{name}");
            // A drawing contains no limits and no weights, so those of the scene are added.
            for (robot, hold) in imported.scene.robots.iter_mut().zip(&frame.holds) {
                let own = &scene.robots()[hold.robot.0];
                assert_eq!(robot.id.as_deref(), Some(own.id.as_str()), "{name}");
                assert_eq!(robot.holds.as_deref(), Some(scene.blocks()[hold.block.0].id.as_str()), "{name}");
                robot.limits = limits[hold.robot.0].clone();
            }
            for (block, id) in imported.scene.blocks.iter_mut().zip(&frame.placed) {
                block.weight = Some(scene.blocks()[id.0].weight);
            }
            imported.scene.corner_contacts = Some(scene.corner_contacts());
            let read = Scene::from_json(&imported.scene.to_json()).expect("sound");
            for (block, id) in read.blocks().iter().zip(&frame.placed) {
                let drawn = &scene.blocks()[id.0].body.polygon;
                let off = (block.body.polygon.centroid() - drawn.centroid()).norm();
                assert!(off < 1e-3, "{name}: {} is off by {off} m", block.id);
            }
            let again = Analysis::new(&read);
            assert_eq!(again.frames[0].verdict, found.verdict, "{name}");
            assert_eq!(again.frames[0].contacts.len(), found.contacts.len(), "{name}");
            frames += 1;
        }
    }
    assert!(frames >= 19, "{frames}");
}

#[test]
fn damaged_drawings_are_reported_and_never_panic() {
    let mut numbers = Random::new(1);
    let mut random = move |count: usize| numbers.below(count);
    let bits: [&[u8]; 10] = [b"1e308", b"-", b"<g>", b"z", b"\"", b"NaN", b"0", b"a1 1 0 0 1 ", b"#", b"1e-300"];
    for (name, format) in [
        ("doorway.svg", Format::Svg),
        ("arch.svg", Format::Svg),
        ("window.svg", Format::Svg),
        ("steps.geojson", Format::GeoJson),
        ("post.wkt", Format::Wkt),
        ("arch.dxf", Format::Dxf),
        ("lintel.dxf", Format::Dxf),
        ("bricks.dxf", Format::Dxf),
    ] {
        let whole = fs::read(asset("import").join(name)).expect("an asset");
        for _ in 0..150 {
            let mut bytes = whole.clone();
            for _ in 0..=random(4) {
                let at = random(bytes.len());
                let to = (at + random(12)).min(bytes.len());
                match random(3) {
                    0 => drop(bytes.splice(at..to, bits[random(bits.len())].iter().copied())),
                    1 => drop(bytes.drain(at..to)),
                    _ => bytes[at] = b"0123456789.-eMLHVCSQTAZ <>\"/"[random(28)],
                }
            }
            let text = String::from_utf8_lossy(&bytes);
            match import(&text, format, &Options::default()) {
                Ok(imported) => assert!(Scene::from_json(&imported.scene.to_json()).is_ok(), "{text}"),
                Err(refusal) => assert!(!refusal.problems.is_empty()),
            }
        }
    }
}

#[test]
fn a_figure_of_very_many_blocks_is_imported_completely() {
    let mut blocks = Vec::new();
    for row in 0..35 {
        for column in 0..30 {
            let corners = crate::structure::rectangle(f64::from(column), f64::from(row), 1.0, 1.0);
            blocks.push(crate::structure::block(&format!("{row}-{column}"), corners, 1.0));
        }
    }
    let scene = crate::structure::scene(&crate::structure::on_floor(0.7, blocks));
    let svg = output::svg::write(&figure::forces(&Analysis::new(&scene), &figure::Options::default()));
    let imported = import(&svg, Format::Svg, &Options::default()).expect("a scene");
    assert_eq!(imported.scene.blocks.len(), 1050);
    assert_eq!(imported.remarks, []);
}
