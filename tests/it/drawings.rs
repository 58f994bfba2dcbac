//! Drawings and lists as people have them: each is a stored file, beside the scene and the messages that are expected
//! from it. `UPDATE_SNAPSHOTS=1` writes the expected files anew.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use drystone::analysis::Verdict;
use drystone::import::{DrawingProblems, Format, Imported, Options, import, import_files};
use drystone::{Analysis, Scene};

/// Each file, its format, and what is expected: the number of blocks, the verdict, and words of its notes or of the
/// count of what is left out.
const FILES: [(&str, Format, usize, Verdict, &str); 27] = [
    ("named-columns.csv", Format::Contacts, 2, Verdict::Stable, ""),
    ("arrays.csv", Format::Contacts, 2, Verdict::Stable, ""),
    ("decimal-commas.csv", Format::Contacts, 2, Verdict::Stable, ""),
    ("units.csv", Format::Contacts, 1, Verdict::Stable, "converted to m and kg"),
    ("boxes-german.csv", Format::Boxes, 2, Verdict::Stable, ""),
    ("table.csv", Format::Wkt, 1, Verdict::Stable, ""),
    ("lines.wkt", Format::Wkt, 1, Verdict::Stable, ""),
    ("styled.svg", Format::Svg, 3, Verdict::Stable, ""),
    ("boxes.csv", Format::Boxes, 2, Verdict::Stable, ""),
    ("boxes.json", Format::Boxes, 2, Verdict::Stable, ""),
    ("collection.wkt", Format::Wkt, 3, Verdict::Stable, "1 point"),
    ("features.geojsonl", Format::GeoJson, 2, Verdict::Stable, ""),
    ("features.json", Format::GeoJson, 2, Verdict::Stable, ""),
    ("specks.dxf", Format::Dxf, 2, Verdict::Stable, "exact repeats (1)"),
    ("wall-of-lines.dxf", Format::Dxf, 5, Verdict::Stable, "cut along the lines"),
    ("ring-of-arcs.dxf", Format::Dxf, 5, Verdict::Stable, "cut along the lines"),
    ("faces.dxf", Format::Dxf, 2, Verdict::Stable, ""),
    ("backfill.dxf", Format::Dxf, 2, Verdict::Stable, "hatch"),
    ("edges.svg", Format::Svg, 4, Verdict::Stable, "outlines between lines that meet: 4"),
    ("frame.svg", Format::Svg, 2, Verdict::Stable, "it is a frame"),
    ("pixels.svg", Format::Svg, 1, Verdict::Stable, ""),
    ("glyphs.svg", Format::Svg, 1, Verdict::Stable, "text"),
    ("matplotlib.svg", Format::Svg, 3, Verdict::Stable, "it is a frame"),
    ("curved.svg", Format::Svg, 1, Verdict::Stable, ""),
    ("overlap.svg", Format::Svg, 2, Verdict::Stable, ""),
    ("bodies.csv", Format::Contacts, 2, Verdict::Stable, ""),
    ("contacts.csv", Format::Contacts, 2, Verdict::Stable, ""),
];

const FORMATS: [(Format, &str); 7] = [
    (Format::Svg, "SVG"),
    (Format::Dxf, "DXF"),
    (Format::GeoJson, "GeoJSON"),
    (Format::Wkt, "well-known text"),
    (Format::Contacts, "a contact list"),
    (Format::Boxes, "a list of boxes"),
    (Format::Compas, "an assembly of COMPAS"),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/drawings")
}

fn text(name: &str) -> String {
    fs::read_to_string(folder().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Imports a file. The list of contacts comes with the list of its bodies.
fn read(name: &str, format: Format) -> Result<Imported, DrawingProblems> {
    let options = Options::default();
    match name {
        "bodies.csv" | "contacts.csv" => {
            let [bodies, contacts] = ["bodies.csv", "contacts.csv"].map(|name| (name, text(name)));
            let mut files = [(bodies.0, bodies.1.as_str()), (contacts.0, contacts.1.as_str())];
            files.rotate_left(usize::from(name == "contacts.csv"));
            import_files(&files, &options)
        }
        "pixels.svg" => import(&text(name), format, &options.scale(0.0254 / 96.0)),
        _ => import(&text(name), format, &options),
    }
}

/// The scene, and below it what the import says.
fn told(imported: &Imported) -> String {
    let mut text = imported.scene.to_json();
    imported.notes.iter().for_each(|note| writeln!(text, "note: {note}").expect("text"));
    for remark in &imported.remarks {
        writeln!(text, "remark: {}: {}; {}", remark.element, remark.message, remark.help).expect("text");
    }
    for (what, count) in &imported.left_out {
        writeln!(text, "left out: {count} {what}").expect("text");
    }
    text
}

#[test]
fn each_file_gives_its_scene() {
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    let mut faults = Vec::new();
    for (name, format, blocks, verdict, words) in FILES {
        let imported = match read(name, format) {
            Ok(imported) => imported,
            Err(refusal) => {
                faults.push(format!("{name}: {refusal:?}"));
                continue;
            }
        };
        let said = told(&imported);
        let scene = Scene::from_json(&imported.scene.to_json()).expect("a valid scene");
        let found = Analysis::new(&scene).verdict();
        if (scene.blocks().len(), found) != (blocks, verdict) || !said.contains(words) {
            faults.push(format!("{name}: {} blocks, {found:?}\n{said}", scene.blocks().len()));
        }
        let path = folder().join("expected").join(format!("{name}.txt"));
        if update {
            fs::write(&path, &said).expect("written");
        }
        if fs::read_to_string(&path).unwrap_or_default() != said {
            faults.push(format!("{name}: it differs from {}:\n{said}", path.display()));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_importer_names_the_format_of_the_files_of_the_others() {
    let mut faults = Vec::new();
    let alone = FILES.iter().filter(|file| !matches!(file.0, "bodies.csv" | "contacts.csv"));
    for (name, own, blocks, ..) in alone {
        let own_name = FORMATS.into_iter().find(|format| format.0 == *own).map_or("", |format| format.1);
        for (format, as_name) in FORMATS.into_iter().filter(|format| format.0 != *own) {
            match import(&text(name), format, &Options::default()) {
                // Tables and lists are one family: the columns decide.
                Ok(imported) if imported.scene.blocks.len() == *blocks => {}
                Ok(imported) => faults.push(format!("{name} as {as_name}: {}", told(&imported))),
                Err(refusal) => {
                    let said: Vec<&str> = refusal.problems.iter().map(|problem| problem.message.as_str()).collect();
                    let wanted = format!("this is {own_name}");
                    if !said.iter().any(|message| message.contains(&wanted)) {
                        faults.push(format!("{name} as {as_name}: {said:?}"));
                    }
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_curve_keeps_its_area() {
    // The area under the Bézier curve of curved.svg: for y = 50 − h, ∫ h dx with the control points h = 0, 20, 24, 0.
    let imported = read("curved.svg", Format::Svg).expect("a block");
    let scene = Scene::from_json(&imported.scene.to_json()).expect("a valid scene");
    let bezier = |p: [f64; 4], t: f64| {
        let u = 1.0 - t;
        u * u * u * p[0] + 3.0 * u * u * t * p[1] + 3.0 * u * t * t * p[2] + t * t * t * p[3]
    };
    let at = |k: u32| f64::from(k) / 1e5;
    let (x, h) = ([10.0, 14.0, 36.0, 40.0], [0.0, 20.0, 24.0, 0.0]);
    let strip = |k: u32| {
        let width = bezier(x, at(k + 1)) - bezier(x, at(k));
        width * f64::midpoint(bezier(h, at(k + 1)), bezier(h, at(k)))
    };
    let area = (0..100_000).map(strip).sum::<f64>() * 1e-6;
    let found = scene.blocks()[0].body.polygon.area();
    assert!((found / area - 1.0).abs() < 1e-4, "{found} {area}");
}
