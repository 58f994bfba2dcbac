//! The WebAssembly module for browsers. Its functions take scenes and options as JSON text, and return results and
//! pictures as text.
//!
//! The script `examples/playground/build.sh` makes a package of this module for JavaScript, with declarations for
//! TypeScript. A function that refuses its input throws an `Error`. The property `problems` of the `Error` is the list
//! of problems that `drystone check --json` prints, and is empty if an option is not valid. After an internal error (an
//! `Error` without `problems`) the module has to be started again.

mod request;

use std::panic;
use std::time::Duration;

use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

use request::{PageArgs, ResultArgs};

use crate::clock::Instant;
use crate::entry::request::{Refused, read_json};
use crate::mechanics::analysis::{self, Analysis, Verdict, verdicts};
use crate::mechanics::scene::format::SceneFile;
use crate::mechanics::scene::{Scene, SceneError, Setting};
use crate::mechanics::vary::{Found, Interval, Range, State, intervals, scan};
use crate::pictures::output::attachment::file_in;
use crate::products::figure::Kind;
use crate::products::result::{imported_json, problem_list, quoted, remark_list};
use crate::read::Given;
use crate::sources::import::{DrawingProblems, Format, Options, STONES, import};

/// Why the input was refused. JavaScript receives an `Error` with this message, whose property `problems` is the list
/// of the problems.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The message, which contains all problems.
    message: String,
    /// The problems as a JSON list; empty if an option is not valid.
    problems: String,
}

/// The refusal of options that are not valid; the text is the message.
impl From<String> for Refusal {
    fn from(message: String) -> Refusal {
        Refusal { message, problems: "[]".into() }
    }
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Refusal {
        Refusal { message: error.to_string(), problems: problem_list(&error.list) }
    }
}

impl From<Refused> for Refusal {
    fn from(why: Refused) -> Refusal {
        match why {
            Refused::Scene(error) => error.into(),
            Refused::Option(why) => why.into(),
        }
    }
}

impl From<DrawingProblems> for Refusal {
    fn from(error: DrawingProblems) -> Refusal {
        let messages: Vec<&str> = error.problems.iter().map(|p| p.message.as_str()).collect();
        Refusal { message: messages.join("\n"), problems: remark_list(&error.problems) }
    }
}

impl From<Refusal> for JsValue {
    fn from(refusal: Refusal) -> JsValue {
        let error = js_sys::Error::new(&refusal.message);
        let list = js_sys::JSON::parse(&refusal.problems).unwrap_or_default();
        // Setting a property of a new object cannot fail.
        let _ = js_sys::Reflect::set(&error, &"problems".into(), &list);
        error.into()
    }
}

/// Prepares the module, so that a panic becomes a JavaScript error with the same message.
#[wasm_bindgen(start)]
pub fn start() {
    if cfg!(target_family = "wasm") {
        panic::set_hook(Box::new(|fault| wasm_bindgen::throw_str(&fault.to_string())));
    }
}

/// Returns the version of drystone, such as `0.1.0`.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Returns the kinds of figures as a JSON list of objects `{ "kind", "label", "help" }`.
#[wasm_bindgen]
pub fn kinds() -> String {
    let entry = |kind: Kind| {
        let mut label = kind.name().to_owned();
        label[..1].make_ascii_uppercase();
        format!("{{\"kind\":{},\"label\":{},\"help\":{}}}", quoted(kind.name()), quoted(&label), quoted(kind.help()))
    };
    let entries: Vec<String> = Kind::ALL.into_iter().map(entry).collect();
    format!("[{}]", entries.join(","))
}

/// Analyses a scene. Returns the JSON that `drystone check --json` prints, but without times. `options` is a JSON
/// object with the names of the options of `check`: `margins` (true, false or a list), `wedging`, `verdict_only`,
/// `accuracy`, `contact_tolerance`, `time_limit`, `frame` (a number from 1, or "last"), `blocks`, `no_notes`,
/// `capacity` (such as "lintel", "lintel@2,3" or "lintel@1,3..3,3"), `for_all` (such as "tilt=±2,friction=0.5..0.7")
/// and `sensitivity` (load_factor, tilt, horizontal_load, friction_factor, friction or kernel). Two more options are `timing` (true to
/// add the times to the result) and `file` (the name of the file in the result).
///
/// # Errors
/// Returns the problems of the scene, or a message about all options that are not valid.
#[wasm_bindgen]
pub fn check(scene: &str, options: Option<String>) -> Result<String, Refusal> {
    let args = read_json(options.as_deref(), ResultArgs::read)?;
    Ok(args.written(&args.what.analysis(scene)?))
}

/// Draws a scene as SVG, as `drystone render` does. `options` is a JSON object with the names of the options of
/// `render`: `kind`, `frame`, `theme`, `width_mm`, `amounts`, `arrows`, `fill`, `capacity`, `for_all` and others.
/// Three more options exist. `style` is the text of a style file. `width_px` is the width of the page in pixels.
/// `way`, from 0 to 1, is the fraction of their paths that the blocks of a mechanism have moved.
///
/// # Errors
/// Returns the same errors as [`check`].
#[wasm_bindgen]
pub fn figure(scene: &str, options: Option<String>) -> Result<String, Refusal> {
    read_json(options.as_deref(), PageArgs::read)?.figure(scene)
}

/// Returns the problems of a scene as a JSON list of objects `{ code, path, line, column, message, hint }`. The list is
/// empty for a valid scene.
#[wasm_bindgen]
pub fn problems(scene: &str) -> String {
    match Scene::from_json(scene) {
        Ok(_) => "[]".into(),
        Err(error) => Refusal::from(error).problems,
    }
}

/// Finds for which values of a number a step stands, as `drystone vary` does with three digits. `name` is the name of the
/// number, as `--set` takes it, such as `loads[0].at[0]`, and `frame` counts the steps from 1. After `time_limit`, in seconds,
/// values that are left are undecided. Returns a JSON list of intervals `{ "state", "from", "to" }`; `state` is holds, fails,
/// undecided or no_scene.
///
/// # Errors
/// Returns the problems of the scene as it is given, or a message if it has no such step or the range is empty.
#[wasm_bindgen]
pub fn vary(scene: &str, name: &str, from: f64, to: f64, frame: usize, time_limit: f64) -> Result<String, Refusal> {
    let steps = Scene::from_json(scene)?.frames().len();
    if !(1..=steps).contains(&frame) {
        return Err(format!("frame must be a number from 1 to {steps}").into());
    }
    if !(from < to && from.is_finite() && to.is_finite()) {
        return Err("from must be less than to".to_owned().into());
    }
    let end = Instant::now() + Duration::from_secs_f64(time_limit.clamp(0.0, 1e6));
    let options = analysis::Options { deadline: Some(end), ..analysis::Options::default() };
    let state = |at: &[f64]| {
        if Instant::now() > end {
            return State::Undecided;
        }
        let setting = format!("{name}={}", at[0]).parse::<Setting>();
        let changed = setting.ok().and_then(|own| Scene::from_slice_changed(scene.as_bytes(), None, &[own]).ok());
        match changed.map(|(scene, _)| verdicts(&scene, &options)[frame - 1]) {
            Some(Verdict::Stable) => State::Holds,
            Some(Verdict::Unstable) => State::Fails,
            Some(Verdict::Undecided) => State::Undecided,
            None => State::NoScene,
        }
    };
    let range = Range { name: name.to_owned(), from, to, is_whole: false };
    let samples = scan(&range, VARIED, 3, |at| Found { state: state(at), value: None, words: String::new() });
    let entry =
        |own: Interval| format!("{{\"state\":\"{}\",\"from\":{},\"to\":{}}}", own.state.word(), own.from, own.to);
    Ok(format!("[{}]", intervals(&samples).into_iter().map(entry).collect::<Vec<_>>().join(",")))
}

/// The number of values that [`vary`] examines before it finds the ends.
const VARIED: usize = 17;

/// Returns the text of the scene file that a PNG or a PDF of `drystone render` carries.
///
/// # Errors
/// Returns a message if the picture carries no scene, or a damaged one.
#[wasm_bindgen(js_name = sceneIn)]
pub fn scene_in(picture: &[u8]) -> Result<String, Refusal> {
    let file = file_in(picture).map_err(|error| error.to_string())?;
    Ok(String::from_utf8_lossy(&file).into_owned())
}

/// Turns a drawing into a scene, as `drystone import` does. `format` is svg, dxf, geojson, json or wkt. Returns the
/// log of the import as JSON, with the text of the scene file under the key `scene`. `options` is a JSON object with
/// the keys `scale`, `flatten`, `gap`, `ratio`, `ground` (also called `ground_layers`), `ignore`, `flip_y`, `frame`
/// (counted from 1), `title`, `friction`, `material`, `density`, `thickness`, `kernel` and `gravity`.
///
/// # Errors
/// Returns the elements of the drawing that prevent an import, or a message about an option that is not valid.
#[wasm_bindgen(js_name = importDrawing)]
pub fn import_drawing(text: &str, format: &str, options: Option<String>) -> Result<String, Refusal> {
    imported(text, format, options.as_deref())
}

/// Imports a drawing, given as text. `format` is the name of its format. Returns JSON with the log of the import and
/// the text of the scene file.
fn imported(text: &str, format: &str, options: Option<&str>) -> Result<String, Refusal> {
    let format = match format {
        "svg" => Format::Svg,
        "dxf" => Format::Dxf,
        "geojson" | "json" => Format::GeoJson,
        "wkt" => Format::Wkt,
        other => return Err(format!("format must be svg, dxf, geojson, json or wkt, not {other:?}").into()),
    };
    Ok(imported_json(&import(text, format, &read_json(options, read)?)?))
}

/// Reads the options of an import. Their names are those of the fields of [`Options`] and of the keys of a scene file.
/// In addition, `material` is the name of a stone. `frame` is counted from 1.
fn read(given: &mut Given<'_, '_>) -> Options {
    let stones = STONES.map(|stone| (stone.name, stone));
    let material = given.key("material", |r, node, at| r.choice(node, at, &stones));
    Options {
        scale: given.number("scale"),
        ratio: given.number("ratio"),
        ground: [texts(given, "ground"), texts(given, "ground_layers")].concat(),
        ignore: texts(given, "ignore"),
        flip_y: given.flag("flip_y"),
        flatten: given.number("flatten"),
        gap: given.number("gap"),
        frame: given.whole("frame", [1, u32::MAX]).map(|number| number as usize - 1),
        scene: SceneFile {
            title: given.text("title"),
            friction: given.number("friction").or(material.map(|m| m.friction)),
            density: given.number("density").or(material.map(|m| m.density)),
            thickness: given.number("thickness"),
            kernel: given.number("kernel"),
            gravity: given.key("gravity", |r, node, at| r.vector(node, at)),
            ..SceneFile::default()
        },
    }
}

/// Reads a list of texts; empty if the key is missing.
fn texts(given: &mut Given<'_, '_>, key: &'static str) -> Vec<String> {
    given.list(key, |r, node, at| r.text(node, at)).unwrap_or_default()
}

/// A scene that is changed often, for example while a block is dragged. It is analysed once for each change. The
/// verdict, the result and the figures come from this analysis, unless a figure needs results that it lacks.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct Session {
    args: ResultArgs,
    analysis: Analysis,
}

#[wasm_bindgen]
impl Session {
    /// Analyses a first scene with the options of `check`. Later scenes get the same options.
    ///
    /// # Errors
    /// Returns the problems of the scene, or a message about an option that is not valid.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, options: Option<String>) -> Result<Session, Refusal> {
        let args = read_json(options.as_deref(), ResultArgs::read)?;
        let analysis = args.what.analysis(scene)?;
        Ok(Session { args, analysis })
    }

    /// Replaces the scene and analyses it. Returns the worst verdict of its frames; from best to worst: stable,
    /// undecided, unstable.
    ///
    /// # Errors
    /// Returns the problems of the scene, or a message about an option that does not fit the scene, such as a frame
    /// that does not exist. The session then keeps the previous scene.
    pub fn set(&mut self, scene: &str) -> Result<String, Refusal> {
        self.analysis = self.args.what.analysis(scene)?;
        Ok(self.verdict())
    }

    /// Returns the worst verdict of all frames; from best to worst: stable, undecided, unstable.
    pub fn verdict(&self) -> String {
        self.analysis.verdict().word().to_owned()
    }

    /// Returns the result of the analysis as JSON, as the function `check` does.
    pub fn result(&self) -> String {
        self.args.written(&self.analysis)
    }

    /// Draws a figure of the scene as SVG. `options` are those of the function `figure`; `frame`, `broken`, `accuracy`,
    /// `wedging`, `contact_tolerance` and `time_limit` have no effect. If the figure needs results that the session
    /// lacks, the scene is analysed again with the default accuracy and without a time limit.
    ///
    /// # Errors
    /// Returns a message about an option that is not valid.
    pub fn figure(&self, options: Option<String>) -> Result<String, Refusal> {
        read_json(options.as_deref(), PageArgs::read)?.drawn(&self.analysis)
    }
}
