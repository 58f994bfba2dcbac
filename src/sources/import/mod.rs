//! From a drawing to a scene file: SVG, GeoJSON or well-known text.
//!
//! Every closed outline becomes a block, unless a name around it begins with `ground` or `robot`; what begins with
//! `ignore` or `guide` is left out. Curves are cut into chords, and what nearly touches is made to touch, so that
//! interfaces are found. What cannot be taken is reported, with the element it is about. Absent on purpose: friction
//! between materials, limits of robots, loads and steps, which no drawing holds.

mod affine;
mod crowd;
mod draft;
mod entry;
mod geojson;
mod name;
mod outline;
mod region;
mod svg;
mod track;
mod wkt;

pub use draft::Remark;

use crate::scene::Scene;
use crate::scene::format::SceneFile;
use draft::{Draft, Form, Role};
use outline::Outlines;

/// What a drawing is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Scalable Vector Graphics, as Inkscape and Illustrator write it, or a figure by this library.
    Svg,
    /// GeoJSON: polygons with properties.
    GeoJson,
    /// Well-known text: a geometry per line.
    Wkt,
}

/// How a drawing is to be read, and what a scene needs that no drawing holds.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Metres per unit of the drawing. Default: the real size of an SVG that has one, that of a figure by this library,
    /// else 1.
    pub scale: Option<f64>,
    /// Farthest that a chord may lie from its curve, in metres. Default: a thousandth of the drawing's size.
    pub flatten: Option<f64>,
    /// What is no farther apart, in metres, is made to touch; 0 for nothing. Default: a thousandth of the drawing's size,
    /// and at most a quarter of the thinnest body.
    pub gap: Option<f64>,
    /// Which frame of a figure by this library, from 0. Default: the last.
    pub frame: Option<usize>,
    /// Friction, kernel, density, thickness and gravity of the scene; its other keys are overwritten.
    pub scene: SceneFile,
}

impl Options {
    setters! {
        scene: SceneFile, "Friction, kernel, density, thickness and gravity of the scene.";
    }

    optional_setters! {
        scale: f64, "Metres per unit of the drawing.";
        flatten: f64, "Farthest that a chord may lie from its curve, in metres.";
        gap: f64, "What is no farther apart, in metres, is made to touch; 0 for nothing.";
        frame: usize, "Which frame of a figure by this library, from 0.";
    }
}

/// A drawing that has become a scene.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Imported {
    /// The scene file. It is sound: [`Scene::from_json`] takes its text.
    pub scene: SceneFile,
    /// How it was understood, in sentences.
    pub notes: Vec<String>,
    /// What was not taken, or not as it was drawn.
    pub remarks: Vec<Remark>,
    /// What was moved so that it touches.
    pub snapped: Vec<Snapped>,
}

/// A body that was moved so that it touches.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Snapped {
    /// The body: a block's id, or `ground[2]`.
    pub body: String,
    /// Its element in the drawing.
    pub element: String,
    /// How many of its corners moved or were put in.
    pub corners: usize,
    /// How far the farthest of them moved, in metres.
    pub distance: f64,
    /// The bodies that it touches now.
    pub to: Vec<String>,
}

/// A drawing that does not become a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct DrawingProblems {
    /// Why, at least one reason.
    pub problems: Vec<Remark>,
    /// What was not taken in any case.
    pub remarks: Vec<Remark>,
}

/// Reads a drawing.
///
/// # Units
/// Metres in the scene, y up. An SVG's y points down and is turned over; the lower left corner of its page becomes the
/// origin.
///
/// # Errors
/// A text that is not of its format; a drawing in which nothing is a block; blocks that lie in each other, and whatever
/// else [`Scene::from_json`] finds wrong.
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
    let problems = wrong_options(options);
    if !problems.is_empty() {
        return Err(DrawingProblems {
            problems,
            remarks: Vec::new(),
        });
    }
    let refused = |why: String| DrawingProblems {
        problems: vec![Remark {
            element: String::new(),
            message: why,
            help: String::new(),
        }],
        remarks: Vec::new(),
    };
    let scaled = |draft: Draft| {
        let (scale, how) = match options.scale {
            Some(scale) => (scale, "as --scale says"),
            None => (1.0, "since nothing else is said"),
        };
        let note = format!("a unit of the drawing is {scale} m, {how}");
        Draft {
            notes: std::iter::once(note).chain(draft.notes).collect(),
            ..draft
        }
    };
    let scale = options.scale.unwrap_or(1.0);
    if format != Format::Svg && options.frame.is_some() {
        return Err(refused(
            "only a figure that drystone drew has frames".into(),
        ));
    }
    let draft = match format {
        Format::Svg => svg::read(text, options.scale, options.frame).map_err(refused)?,
        Format::GeoJson => scaled(geojson::read(text, scale).map_err(refused)?),
        Format::Wkt => scaled(wkt::read(text, scale)),
    };
    made(draft, options)
}

/// Scale, tolerance and gap that are no lengths.
fn wrong_options(options: &Options) -> Vec<Remark> {
    let mut problems = Vec::new();
    let mut check = |name: &str, value: Option<f64>, zero: bool| {
        let Some(value) = value else { return };
        if !(value.is_finite() && (value > 0.0 || (zero && value == 0.0))) {
            problems.push(Remark {
                element: format!("--{name}"),
                message: format!("{value} is no length"),
                help: if zero {
                    "give 0 or more"
                } else {
                    "give more than 0"
                }
                .into(),
            });
        }
    };
    check("scale", options.scale, false);
    check("flatten", options.flatten, false);
    check("gap", options.gap, true);
    problems
}

fn made(mut draft: Draft, options: &Options) -> Result<Imported, DrawingProblems> {
    let size = outline::size(&mut draft);
    let flatten = options.flatten.unwrap_or(1e-3 * size);
    let close = options.gap.unwrap_or(1e-3 * size).min(1e-3 * size);
    if draft.parts.iter().any(|p| matches!(&p.form, Form::Tracks(t, _) if p.kind != Role::Robot && t.iter().any(track::Track::bends))) {
        draft.notes.push(format!("curves are cut into chords, {} m from them at most", entry::short(flatten)));
    }
    let title = std::mem::take(&mut draft.title);
    let mut outlines = Outlines::new(&mut draft, flatten, close);
    if !outlines.bodies.iter().any(|b| b.kind == Role::Block) {
        let empty = Remark {
            element: String::new(),
            message: "nothing in the drawing becomes a block".into(),
            help: "draw blocks as closed outlines, in layers whose names do not begin with ground, robot, ignore or guide".into(),
        };
        return Err(DrawingProblems {
            problems: vec![empty],
            remarks: draft.remarks,
        });
    }
    if let Some(problem) = crowd::problem(&outlines) {
        return Err(DrawingProblems {
            problems: vec![problem],
            remarks: draft.remarks,
        });
    }
    let gap = options
        .gap
        .unwrap_or_else(|| (1e-3 * size).min(0.25 * outlines.thinnest()));
    let names = name::given(&mut outlines);
    let snapped = outlines.snap(&mut draft, &names, gap);
    if gap > 0.0 {
        draft.notes.push(format!(
            "what lies within {} m of each other is made to touch",
            entry::short(gap)
        ));
    }
    let scene = entry::scene(&outlines, &names, &mut draft, title, size, &options.scene);
    let text = scene.to_json();
    // Outlines brought together leave nothing to be judged both ways: what still overlaps has to be drawn anew.
    let read = Scene::from_json(&text).and_then(|read| match read.penetrations.is_empty() {
        true => Ok(read),
        false => Scene::from_json_within(&text, Some(read.tolerance.gap)),
    });
    match read {
        Ok(_) => Ok(Imported {
            scene,
            notes: draft.notes,
            remarks: draft.remarks,
            snapped,
        }),
        Err(problems) => Err(DrawingProblems {
            problems: problems.list.iter().map(|p| outlines.located(p)).collect(),
            remarks: draft.remarks,
        }),
    }
}

#[cfg(test)]
mod tests;
