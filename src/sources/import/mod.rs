//! Imports drawings as scene files: SVG, DXF, GeoJSON or well-known text. Also imports contact lists and assemblies of
//! COMPAS.
//!
//! | step | file |
//! |---|---|
//! | 1. read the drawing into a `Draft`: subpaths in metres, y up; transforms are applied, roles follow from layers and names | `svg`, `dxf`, `geojson`, `wkt`, `box_list` |
//! | 2. leave out specks, repeats and frames; make outlines of lines that meet; flatten curves into chords | `tidy`, `network`, `subpath` |
//! | 3. find regions and their holes by the fill rule | `region` |
//! | 4. refuse drawings with too many outlines, or with too many that overlap | `limit` |
//! | 5. snap corners and edges that nearly touch, so that interfaces are found | `outline` |
//! | 6. write the scene file, and check it like any other | `scene_file` |
//!
//! Every closed outline becomes a block. If its name, or the name of a layer around it, begins with `ground` or
//! `robot`, it becomes ground or a robot; with `ignore` or `guide` it is left out. Elements that cannot be imported are
//! reported by name. Drawings contain no friction between materials, limits of robots, loads or steps, so these are not
//! imported.

mod limit;
mod box_list;
mod choice;
mod draft;
mod dxf;
mod format;
mod scene_file;
mod compas;
mod contact_list;
mod geojson;
mod name;
mod naming;
mod network;
mod outline;
mod snapping;
mod region;
mod svg;
mod stone;
mod subpath;
mod table;
mod tidy;
mod trial;
mod wkt;

use std::collections::BTreeMap;

use choice::Chosen;
#[cfg(feature = "python")]
pub(crate) use compas::sections;
pub use draft::Remark;
use draft::{Draft, Role, Scale};
pub use format::Format;
use naming::Naming;
use outline::Outlines;
pub use stone::{STONES, Stone};
use trial::Trial;

use crate::mechanics::scene::Scene;
use crate::mechanics::scene::format::SceneFile;
use crate::text::first_of;

/// The default largest distance of a chord from its curve, and the default gap, as fractions of the size of the
/// drawing. This is about a pixel on a screen; nobody draws more accurately by hand.
const LENGTH_TOL: f64 = 1e-3;
/// The largest default gap, as a fraction of the thickness of the thinnest body. Both faces of a body may move, so
/// the body keeps half its thickness.
const MAX_GAP_TO_THICKNESS: f64 = 0.25;
/// The largest number of names that a message lists.
const MAX_NAMES: usize = 8;

/// The options of an import, and the properties of a scene that no drawing contains.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Metres per unit of the drawing. Default: computed from the physical size of an SVG, from the unit of a DXF
    /// (`$INSUNITS`) or from the scale of a figure by this library; 1 if the drawing states none of these.
    pub scale: Option<f64>,
    /// Real lengths divided by drawn lengths, 50 for a drawing at 1:50. Default: 1. It multiplies `scale`, or the unit
    /// that the drawing states; a drawing that states no unit needs `scale` too.
    pub ratio: Option<f64>,
    /// Additional ground. Each entry is the name of a layer or element in upper or lower case, the number of a body in
    /// the drawing (from 1), a point `x,y` in a body, or `below:Y` for all bodies below a height. Lengths are in the
    /// unit of the drawing with y up. Layers and elements whose names begin with `ground` are always ground.
    pub ground: Vec<String>,
    /// What is left out, written like `ground`. Layers and elements whose names begin with `ignore` or `guide` are
    /// always left out.
    pub ignore: Vec<String>,
    /// Whether the drawing is turned upside down, because its y axis points down.
    pub flip_y: bool,
    /// The largest distance of a chord from its curve, in metres. Default: 0.001 times the size of the drawing.
    pub flatten: Option<f64>,
    /// Edges within this distance, in metres, are moved so that they touch; 0 turns this off. Default: 0.001 times the
    /// size of the drawing, but at most a quarter of the thickness of the thinnest body.
    pub gap: Option<f64>,
    /// The frame to import from a figure by this library, counted from 0. Default: the last.
    pub frame: Option<usize>,
    /// Title, friction, kernel, density, thickness and gravity of the scene. For drawings, the other keys have no
    /// effect.
    pub scene: SceneFile,
}

impl Options {
    setters! {
        scene: SceneFile, "Title, friction, kernel, density, thickness and gravity of the scene.";
        ground: Vec<String>, "Names, numbers, points or heights of bodies that are ground.";
        ignore: Vec<String>, "Names, numbers, points or heights of bodies that are left out.";
        flip_y: bool, "Whether the drawing is turned upside down, because its y axis points down.";
    }

    optional_setters! {
        scale: f64, "Metres per unit of the drawing.";
        ratio: f64, "Real lengths divided by drawn lengths, 50 for a drawing at 1:50.";
        flatten: f64, "The largest distance of a chord from its curve, in metres.";
        gap: f64, "Edges within this distance, in metres, are moved so that they touch; 0 turns this off.";
        frame: usize, "The frame to import from a figure by this library, counted from 0.";
    }
}

/// The result of an import.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Imported {
    /// The scene file. It is valid: [`Scene::from_json`] accepts its text.
    pub scene: SceneFile,
    /// Sentences that explain how the drawing was read.
    pub notes: Vec<String>,
    /// Elements that were not imported, or not exactly as drawn.
    pub remarks: Vec<Remark>,
    /// The bodies that were moved so that they touch.
    pub snapped: Vec<Snapped>,
    /// How many elements of each kind the scene lacks, such as 2 for `line`.
    pub left_out: BTreeMap<&'static str, usize>,
}

/// A body whose corners were moved or inserted so that it touches its neighbours.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Snapped {
    /// The body: the id of a block, or `ground[2]`.
    pub body: String,
    /// The element of the drawing from which the body was made.
    pub element: String,
    /// The number of corners that were moved or inserted.
    pub corners: usize,
    /// The largest movement of a corner, in metres.
    pub distance: f64,
    /// The bodies that this body touches now, named like `body`.
    pub to: Vec<String>,
}

/// The reasons why a drawing cannot be imported.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DrawingProblems {
    /// The problems, at least one.
    pub problems: Vec<Remark>,
    /// Elements that were not imported.
    pub remarks: Vec<Remark>,
    /// Sentences that explain how the drawing was read.
    pub notes: Vec<String>,
    /// The scene file, if overlaps of bodies are its only problem. [`Scene::from_json`] refuses it.
    pub overlapping: Option<Box<SceneFile>>,
}

impl DrawingProblems {
    fn of(problems: Vec<Remark>) -> DrawingProblems {
        let problems = draft::merged(problems);
        DrawingProblems { problems, remarks: Vec::new(), notes: Vec::new(), overlapping: None }
    }

    fn with(self, (notes, remarks): (Vec<String>, Vec<Remark>)) -> DrawingProblems {
        DrawingProblems { remarks, notes, ..self }
    }

    fn new(why: impl Into<String>) -> DrawingProblems {
        DrawingProblems::of(vec![Remark::new("", why, "")])
    }
}

/// Imports a drawing.
///
/// # Units
/// The scene is in metres with y up. The y axis of an SVG points down and is flipped, and the lower left corner of
/// its page becomes the origin.
///
/// # Errors
/// Returns an error if an option is not valid, if the text is not in this format, if no element is a block, if too many
/// outlines overlap, if blocks still overlap after nearby edges were snapped together, or if [`Scene::from_json`]
/// reports another problem.
///
/// # Example
/// ```
/// use drystone::{Scene, import::{Format, Options, import}};
/// let drawing = r##"<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="60mm" viewBox="0 0 80 60">
///     <rect id="ground" y="50" width="80" height="10"/>
///     <rect id="post" x="20" y="20.02" width="10" height="30" fill="#8b6b3d"/></svg>"##;
/// let imported = import(drawing, Format::Svg, &Options::default()).expect("a block on ground");
/// assert_eq!(imported.snapped[0].body, "post");
/// let scene = Scene::from_json(&imported.scene.to_json())?;
/// assert_eq!(scene.blocks()[0].body.polygon.bounds().min, drystone::scene::Point::new(0.02, 0.01));
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn import(text: &str, format: Format, options: &Options) -> Result<Imported, DrawingProblems> {
    check_options(options)?;
    let text = table::unmarked(text);
    // Spreadsheets and databases write outlines as a column of well-known text, and simulators write boxes.
    let format = match format {
        Format::Contacts if wkt::is_table(text) => Format::Wkt,
        Format::Contacts if format::has_boxes(text) => Format::Boxes,
        format => format,
    };
    read_as(text, format, options).map_err(|problems| match Format::of_text(text).filter(|found| *found != format) {
        Some(found) => DrawingProblems::of(vec![Remark::new(
            "",
            format!("it is not {}: this is {}", format.name(), found.name()),
            format!("import it as {}: rename the file, or give --format", found.name()),
        )]),
        None => problems,
    })
}

/// Imports a contact list of several files: each has a name for messages, and its text. Bodies and contacts may be in
/// different files.
///
/// # Errors
/// Returns an error like [`import`].
pub fn import_files(files: &[(&str, &str)], options: &Options) -> Result<Imported, DrawingProblems> {
    check_options(options)?;
    let other =
        files.iter().find_map(|file| Some((file.0, Format::of_text(file.1)?)).filter(|f| f.1 != Format::Contacts));
    if let Some((name, format)) = other {
        let why =
            format!("several files are read together only if they are contact lists; {name} is {}", format.name());
        return Err(DrawingProblems::new(why));
    }
    complete(contact_list::read(files, options)?)
}

/// Imports a text in this format.
fn read_as(text: &str, format: Format, options: &Options) -> Result<Imported, DrawingProblems> {
    if format != Format::Svg && options.frame.is_some() {
        return Err(DrawingProblems::new("--frame needs a figure by drystone; this drawing has no frames"));
    }
    if options.flip_y && matches!(format, Format::Contacts | Format::Compas) {
        return Err(DrawingProblems::new("--flip-y turns drawings upside down; this file is none"));
    }
    match format {
        Format::Contacts => complete(contact_list::read(&[("", text)], options)?),
        Format::Compas => complete(compas::read(text, options, &compas::PLANES)?),
        _ => {
            let naming = Naming::new(options, false);
            let draft = read_draft(text, format, options, &naming).map_err(DrawingProblems::new)?;
            let chosen = naming.choices().map_err(DrawingProblems::new)?;
            let draft = with_guessed_ground(draft, &chosen, text, format, options).map_err(DrawingProblems::new)?;
            build_scene(draft, &chosen, &naming.seen(), options)
        }
    }
}

/// Checks the scene of a contact list or of an assembly. Returns its problems as an error.
fn complete(imported: Imported) -> Result<Imported, DrawingProblems> {
    let Err(problems) = Scene::from_json(&imported.scene.to_json()) else {
        return Ok(imported);
    };
    Err(DrawingProblems::of(problems.list.into_iter().map(|p| Remark::new(p.path, p.message, p.help)).collect()))
}

/// If no element of `draft` is ground, and no value in `chosen` makes one ground, reads the drawing again with the rule
/// that names such as "abutment" also make an element ground.
///
/// # Errors
/// Returns a message if the drawing cannot be read.
fn with_guessed_ground(
    draft: Draft,
    chosen: &[Chosen<'_>],
    text: &str,
    format: Format,
    options: &Options,
) -> Result<Draft, String> {
    let has_ground = |draft: &Draft| draft.parts.iter().any(|p| p.kind == Role::Ground);
    if has_ground(&draft) || chosen.iter().any(|c| c.role == Role::Ground) {
        return Ok(draft);
    }
    let guess = Naming::new(options, true);
    let mut guessed = read_draft(text, format, options, &guess)?;
    if !has_ground(&guessed) {
        return Ok(draft);
    }
    guessed.notes.push(format!(
        "taken as ground by name: {}; nothing in the drawing has a name that begins with ground",
        first_of(guess.guessed(), MAX_NAMES)
    ));
    Ok(guessed)
}

/// Reads the drawing into a draft, with the rules `naming` for names (step 1).
fn read_draft(text: &str, format: Format, options: &Options, naming: &Naming<'_>) -> Result<Draft, String> {
    let scale = Scale { metres: options.scale, ratio: options.ratio };
    let scaled = |read: &dyn Fn(f64) -> Result<Draft, String>| {
        let (metres, note) = scale.of(None, "the drawing states no unit")?;
        let mut draft = read(metres)?;
        draft.unit = metres;
        draft.notes.insert(0, note);
        Ok(draft)
    };
    let mut draft = match format {
        Format::Svg => svg::read(text, scale, options.frame, naming),
        Format::Dxf => dxf::read(text, scale, naming),
        Format::GeoJson => scaled(&|metres| geojson::read(text, metres, options.scale.is_some(), naming)),
        Format::Wkt => scaled(&|metres| wkt::read(text, metres, options.scale.is_some(), naming)),
        Format::Boxes => scaled(&|metres| box_list::read(text, metres, naming)),
        Format::Contacts | Format::Compas => Err("it is not a drawing".into()),
    }?;
    if options.flip_y {
        draft.flip();
    }
    Ok(draft)
}

/// Returns a problem for each option that is not a valid length or scale.
fn check_options(options: &Options) -> Result<(), DrawingProblems> {
    let all = [
        ("--scale", options.scale),
        ("--scale 1:N", options.ratio),
        ("--flatten", options.flatten),
        ("--gap", options.gap),
    ];
    let wrong = |(name, value): (&str, Option<f64>)| {
        let (value, zero) = (value?, name == "--gap");
        let help = if zero { "give 0 or more" } else { "give more than 0" };
        let is_valid = value.is_finite() && (value > 0.0 || (zero && value == 0.0));
        (!is_valid).then(|| Remark::new(name, format!("{value} is not a valid value"), help))
    };
    let problems: Vec<Remark> = all.into_iter().filter_map(wrong).collect();
    if problems.is_empty() { Ok(()) } else { Err(DrawingProblems::of(problems)) }
}

/// Returns a remark if the outlines are not a structure: if there is no block, or if too many outlines overlap.
fn structure_problem(outlines: &Outlines) -> Option<Remark> {
    if !outlines.bodies.iter().any(|b| b.kind == Role::Block) {
        return Some(Remark::new(
            "",
            "nothing in the drawing becomes a block",
            "draw blocks as closed outlines, in layers whose names do not begin with ground, robot, ignore or guide",
        ));
    }
    limit::problem([Role::Block, Role::Ground].map(|kind| outlines.boxes(kind)))
}

/// Makes a scene from a draft (steps 2 to 6): flattens curves, finds regions, snaps edges together, and checks the
/// scene.
fn build_scene(
    mut draft: Draft,
    chosen: &[Chosen<'_>],
    names: &[String],
    options: &Options,
) -> Result<Imported, DrawingProblems> {
    let size = outline::size(&mut draft);
    if size > 0.0 {
        tidy::leave_dust_out(&mut draft, size);
        tidy::leave_frames_out(&mut draft, true);
        network::join(&mut draft, LENGTH_TOL * size);
        tidy::leave_fills_out(&mut draft);
        tidy::leave_frames_out(&mut draft, false);
    }
    let size = outline::size(&mut draft);
    let flatten = options.flatten.unwrap_or(LENGTH_TOL * size);
    let close = options.gap.unwrap_or(LENGTH_TOL * size).min(LENGTH_TOL * size);
    let has_curves = |s: &subpath::Subpath| s.has_curves() && s.circle().is_none();
    if draft.parts.iter().any(|p| p.kind != Role::Robot && p.subpaths().iter().any(has_curves)) {
        draft.notes.push(format!("curves are replaced by chords, at most {} m from the curve", draft::short(flatten)));
    }
    if let Some(problem) = limit::corners_problem(&draft, flatten) {
        return Err(DrawingProblems::of(vec![problem]));
    }
    let title = std::mem::take(&mut draft.title);
    let mut outlines = Outlines::new(&mut draft, flatten, close);
    if let Err(why) = outlines.assign_roles(&mut draft, chosen, names) {
        return Err(DrawingProblems::new(why).with(draft.told()));
    }
    if let Some(problem) = structure_problem(&outlines) {
        return Err(DrawingProblems::of(vec![problem]).with(draft.told()));
    }
    let gap = options.gap.unwrap_or_else(|| (LENGTH_TOL * size).min(MAX_GAP_TO_THICKNESS * outlines.thinnest()));
    let names = name::unique_names(&outlines);
    let trial = Trial { drawn: outlines.clone(), names: &names, size, gap };
    let snapped = outlines.snap(&mut draft, &names, gap);
    if gap > 0.0 {
        draft.notes.push(format!("edges within {} m of each other are moved so that they touch", draft::short(gap)));
    }
    let scene = scene_file::scene(&outlines, &names, &mut draft, title, [size, gap], &options.scene);
    if scene.thickness.is_none() {
        draft.notes.push("the blocks are 1 m thick perpendicular to the plane; --thickness sets another value".into());
    }
    match trial::checked(&scene.to_json()) {
        Ok(read) => {
            draft.notes.extend(trial.lonely(&read, &outlines));
            let (notes, remarks) = draft.told();
            Ok(Imported { scene, notes, remarks, snapped, left_out: draft.left_out })
        }
        Err(problems) => {
            let overlaps = trial.overlaps(&outlines, &problems.list);
            let overlapping = overlaps.is_some().then(|| Box::new(scene));
            let each = || problems.list.iter().map(|p| outlines.located(p)).collect();
            let problems = overlaps.map_or_else(each, |remark| vec![remark]);
            Err(DrawingProblems { overlapping, ..DrawingProblems::of(problems).with(draft.told()) })
        }
    }
}

#[cfg(test)]
mod tests;
