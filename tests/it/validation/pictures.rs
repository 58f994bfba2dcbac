//! The pictures of the page. Each shows a scene just beyond its limit or at its limit.

use drystone::Analysis;
use drystone::figure::{self, Kind, Options};
use drystone::output::svg;
use serde_json::{Value, json};

use super::{arches, blocks, stacks, walls};
use crate::structure::{scene, tilted};

/// The scene with an additional horizontal gravity to the right, `share` times the vertical gravity.
fn pushed(mut file: Value, share: f64) -> Value {
    file["gravity"] = json!([9.81 * share, -9.81]);
    file
}

fn arch(thickness: f64, friction: f64) -> Value {
    arches::Arch::semicircle(30, thickness, friction).file()
}

/// The name of a picture, its kind, and its scene.
type Picture = (&'static str, Kind, fn() -> Value);

pub const PICTURES: &[Picture] = &[
    ("arch-thin", Kind::Mechanism, || arch(0.1065, 2.0)),
    ("arch-slides", Kind::Mechanism, || arch(0.25, 0.30)),
    ("arch-vertical", Kind::Mechanism, || arches::cut_vertically(0.108, 30)),
    ("arch-pushed", Kind::Mechanism, || pushed(arches::oppenheim(7), 0.38)),
    ("arch-tilted", Kind::Mechanism, || tilted(arches::lact3(), 17.3)),
    ("wall-1", Kind::Mechanism, || pushed(walls::ferris(1), 0.65)),
    ("wall-3", Kind::Mechanism, || pushed(walls::ferris(3), 0.41)),
    ("stack-4", Kind::Forces, || stacks::best(4, -1e-3)),
    ("stack-6", Kind::Forces, || stacks::best(6, -1e-3)),
    ("columns", Kind::Mechanism, || pushed(blocks::frame_of_columns(), 0.21)),
    ("ladder", Kind::Forces, blocks::ladder),
    ("toppling", Kind::Mechanism, || {
        let mut file = blocks::toppling(0.0);
        file["friction"] = json!(0.65);
        file
    }),
];

pub fn drawn(name: &str, kind: Kind, file: &Value) -> String {
    let analysis = Analysis::new(scene(file));
    let mut options = Options::default();
    (options.titles, options.captions, options.verdicts) = (false, false, false);
    (options.keys, options.labels) = (false, false);
    (options.width, options.height) = (Some(480.0), Some(300.0));
    let drawing = figure::draw(&analysis, kind, &options);
    let mut svg = svg::write(&drawing);
    svg.push_str(if svg.ends_with('\n') { "" } else { "\n" });
    assert!(svg.len() < 45_000, "{name} has {} bytes", svg.len());
    svg
}

/// The link definitions at the end of the page, one for each picture.
pub fn links() -> String {
    PICTURES.iter().map(|(name, ..)| format!("[{name}]: ../../assets/validation/{name}.svg\n")).collect()
}

/// A link definition that contains the picture itself. It is needed because rustdoc does not copy pictures. If a name
/// has several definitions, rustdoc uses the first one.
pub fn inline(name: &str, svg: &str) -> String {
    format!("[{name}]: data:image/svg+xml;base64,{}\n", base64(svg.as_bytes()))
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let part = |k: usize| u32::from(*three.get(k).unwrap_or(&0));
        let bits = part(0) << 16 | part(1) << 8 | part(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k)) as usize & 63];
            text.push(if k <= three.len() { letter as char } else { '=' });
        }
    }
    text
}
