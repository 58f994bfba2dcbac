//! [`to_json`]: writes an analysis as a JSON object for other programs.
//!
//! Invariant: the same analysis always produces the same bytes, apart from times, which [`Timing::LeftOut`] omits.
//! Numbers are written as the shortest decimal that reads back as the same f64, and never as −0. A number that could
//! not be computed is `null`; this happens only in `undecided` frames. `unsupported`, `notices` and `doubt` are absent
//! if they are empty. `margins` and `only_by_wedging` are absent if they were not requested. `only_by_wedging` is also
//! absent if the frame does not stand.
//!
//! serde is used here and in `scene::format`. That module reads files that people write, and this module writes
//! results for programs. The two modules therefore change for different reasons.

#[cfg(feature = "report")]
mod accuracy;
mod frame;
#[cfg(feature = "import")]
mod import;
mod json;
#[doc(hidden)]
pub mod key;
mod line;
mod margin;
mod question;
mod refusal;
mod schema;
mod sensitivity;

use std::io;

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

#[cfg(feature = "report")]
pub use accuracy::accuracy_json;
#[cfg(feature = "import")]
pub use import::import_json;
#[cfg(feature = "wasm")]
pub(crate) use import::imported_json;
use json::{Json, compact, object, write};
pub use line::{Fields, Origin, PictureOutcome, UnknownField, line_of, verdict_line};
pub use margin::margins_json;
pub use question::capacity_json;
pub use refusal::{problem_line, refusal};
#[cfg(feature = "wasm")]
pub(crate) use refusal::{problem_list, remark_list};
pub use schema::schema;

use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::{Scene, ToleranceSource};

/// Whether a result contains solving times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// `solve.seconds` and `solve.stages` are present. They differ from run to run.
    Included,
    /// `solve.seconds` and `solve.stages` are absent. The same scene then always produces the same bytes.
    LeftOut,
}

/// The white space in a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One line per property, and one per interface, robot or failure. Ends with a line feed.
    Lines,
    /// Everything on one line, as JSON Lines requires. Ends with a line feed.
    OneLine,
}

/// Writes the result of an analysis as one JSON object.
///
/// Forces act on `bodies[0]`, `normal` points into `bodies[0]`, and `"ground"` names the ground. The `amount` of a
/// failure is the magnitude of the missing force in newtons. For a robot it is `|F_x| + |F_y|`, because the limits of
/// a robot are per component. For a missing torque, it is the magnitude of the torque in N·m.
///
/// # Units
/// Metres, newtons and N·m. A spin is in 1/m, because all velocities are divided by the speed of the fastest point.
///
/// # Example
/// ```
/// use drystone::analysis::Analysis;
/// use drystone::result::{Layout, Timing, to_json};
/// use drystone::scene::Scene;
///
/// let scene = Scene::from_json(
///     r#"{ "drystone": 1, "blocks": [{ "id": "a", "polygon": [[0, 0], [3, 0], [0, 2]] }] }"#)?;
/// let json = to_json(&Analysis::new(&scene), Timing::LeftOut, Layout::OneLine);
/// assert!(json.contains(r#""verdict":"unstable""#), "nothing holds it");
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn to_json(analysis: &Analysis, timing: Timing, layout: Layout) -> String {
    whole(None, analysis, false, timing, layout)
}

/// Like [`to_json`], with the path of the scene file under the key `file`.
pub fn to_json_of(file: &str, analysis: &Analysis, timing: Timing, layout: Layout) -> String {
    whole(Some(file), analysis, false, timing, layout)
}

/// Like [`to_json`], with the placed blocks of each frame under the key `frames[].blocks`. If `file` is given, the
/// result also has the path of the scene file.
pub fn to_json_with_blocks(file: Option<&str>, analysis: &Analysis, timing: Timing, layout: Layout) -> String {
    whole(file, analysis, true, timing, layout)
}

fn whole(file: Option<&str>, analysis: &Analysis, blocks: bool, timing: Timing, layout: Layout) -> String {
    let mut bytes = Vec::new();
    write_json(&mut bytes, file, analysis, blocks, timing, layout).expect("writing into memory succeeds");
    String::from_utf8(bytes).expect("serde_json writes UTF-8")
}

/// Writes the text of [`to_json`], or with `blocks` that of [`to_json_with_blocks`], one frame after the other.
pub(crate) fn write_json(
    out: &mut dyn io::Write,
    file: Option<&str>,
    analysis: &Analysis,
    blocks: bool,
    timing: Timing,
    layout: Layout,
) -> io::Result<()> {
    write(out, &Result { file, analysis, blocks, timing }, layout, 2)
}

/// A result. Each frame is made when it is written, so that a result with many frames needs little memory.
struct Result<'a> {
    file: Option<&'a str>,
    analysis: &'a Analysis,
    blocks: bool,
    timing: Timing,
}

impl<'a> Result<'a> {
    /// Returns the keys before `frames`.
    fn head(&self) -> Vec<(&'a str, Json<'a>)> {
        let scene = self.analysis.given();
        let notes = self.analysis.notes.iter().map(|note| {
            object! {
                code: note.code.word(),
                path: &note.path,
                line: Json::or_null((note.line > 0).then_some(note.line)),
                message: &note.message,
                hint: &note.hint,
            }
        });
        let head = object! {
            drystone: env!("CARGO_PKG_VERSION"),
            file: self.file,
            scene: &scene.title,
            set: Json::list(&scene.set).unless_empty(),
            contact_tolerance: tolerance(scene),
            notes: Json::list(notes).unless_empty(),
        };
        head.into_entries()
    }

    fn frames(&self) -> impl Iterator<Item = Json<'a>> {
        let (analysis, blocks, timing) = (self.analysis, self.blocks, self.timing);
        analysis.each().map(move |solved| {
            let placed = blocks.then_some(&solved.frame().placed[..]);
            frame::frame(solved, placed, timing)
        })
    }
}

impl Serialize for Result<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        /// Frames, made one after the other.
        struct Frames<'r, 'a>(&'r Result<'a>);
        impl Serialize for Frames<'_, '_> {
            fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
                serializer.collect_seq(self.0.frames())
            }
        }
        let mut map = serializer.serialize_map(None)?;
        for (key, value) in self.head() {
            map.serialize_entry(key, &value)?;
        }
        map.serialize_entry("frames", &Frames(self))?;
        map.end()
    }
}

/// Returns the distances within which edges touch and are merged, in metres, the source of these distances, and the
/// corners that were moved.
fn tolerance(scene: &Scene) -> Json<'_> {
    let (from, digits) = match scene.healed.source {
        ToleranceSource::Lattice => ("lattice", None),
        ToleranceSource::Given => ("given", None),
        ToleranceSource::Decimals(k) => ("decimals", Some(k)),
        ToleranceSource::Digits(n) => ("significant_digits", Some(n)),
        ToleranceSource::Float32 => ("float32", None),
        ToleranceSource::Size => ("size", None),
        ToleranceSource::Noise => ("noise", None),
    };
    object! {
        gap: scene.tolerance.gap,
        from: from,
        digits: digits,
        healed_within: scene.healed.within,
        moved_corners: scene.healed.corners,
        largest_move: scene.healed.distance,
    }
}

/// The number of scenes with each verdict in a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Scenes in which every step stands.
    pub stable: usize,
    /// Scenes in which at least one step falls.
    pub unstable: usize,
    /// Scenes in which no step falls and at least one is undecided.
    pub undecided: usize,
    /// Files that are not valid scenes.
    pub refused: usize,
}

/// Writes text as a JSON string, with its quotation marks.
pub fn quoted(words: &str) -> String {
    compact(words)
}

/// Writes a report as one JSON object that ends with a line feed. The object has the counts and a list of the scenes.
/// `list` is the key of this list. `objects` has the entries of the list as JSON, one for each scene, and each entry is
/// written on a line of its own.
///
/// ```
/// use drystone::result::{Counts, report_json};
/// let json = report_json(Counts { stable: 1, ..Counts::default() }, "scenes", &["{\"scene\":\"a\"}".into()]);
/// assert!(json.contains("\"stable\":1") && json.ends_with("\n]}\n"));
/// ```
pub fn report_json(counts: Counts, list: &str, objects: &[String]) -> String {
    let summary = compact(&counts);
    let objects: Vec<&str> = objects.iter().map(|o| o.trim_end()).collect();
    format!(
        "{{\"drystone\":{},\"summary\":{summary},{}:[\n{}\n]}}\n",
        quoted(env!("CARGO_PKG_VERSION")),
        quoted(list),
        objects.join(",\n")
    )
}

#[cfg(test)]
mod tests;
