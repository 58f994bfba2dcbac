//! Draws pictures and writes reports of an analysis for Python.

use std::path::Path;

use pyo3::prelude::*;

use super::{Ring, detached, fault};
use crate::entry::cli::draw::DrawArgs;
use crate::entry::cli::error::CliError;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::picture::Format;
use crate::entry::cli::report::{form_of, stem_of, write};
use crate::entry::request::{FigureArgs, in_json, read_json};
use crate::geometry::Polygon;
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::{Scene, Sketch};
use crate::pictures::drawing::Theme;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure::{self, Fill, View};
use crate::products::report::entry::{Entry, File, ReportOptions};
use crate::products::report::page::{Form, Piece, Report};
use crate::text::Word;

/// Draws a figure of all frames, or only of frame number `frame`, counted from 0. Returns the bytes of the picture
/// file. `request` are options of a figure as JSON, and the file extension `ending` selects the format.
pub(super) fn drawn(analysis: &Analysis, request: &str, ending: &str, frame: Option<usize>) -> Result<Vec<u8>, String> {
    let (args, format) = requested(request, ending)?;
    let one = frame.and_then(|number| analysis.alone(number));
    let mut analysis = args.figure.completed(one.as_ref().unwrap_or(analysis)).map_err(|why| in_json(&why))?;
    let mut drawn = || -> Result<Vec<u8>, CliError> {
        let fonts = args.picture.fonts()?;
        let options = args.figure.for_scene(&args.options()?, analysis.given())?;
        if args.picture.draws_words(format) && missing_glyphs::lacks(analysis.given(), &fonts) {
            analysis.change_scenes(|scene| missing_glyphs::legible(scene, &fonts));
        }
        Ok(args.bytes(&analysis, &options, format, &fonts)?.0)
    };
    drawn().map_err(message)
}

/// Draws the outlines of a scene that is not valid, with its problems marked, and returns the bytes of the picture
/// file. `text` is the scene as JSON.
#[pyfunction]
pub(super) fn sketch(py: Python<'_>, text: &str, request: &str, ending: &str) -> PyResult<Vec<u8>> {
    let drawn = || {
        let (args, format) = requested(request, ending)?;
        let sketch = Sketch::from_bytes(text.as_bytes(), args.figure.level.contact_tolerance);
        let drawing = figure::broken(&sketch, &args.options().map_err(message)?);
        let fonts = args.picture.fonts().map_err(message)?;
        args.picture.bytes(drawing, format, &fonts).map_err(message)
    };
    detached(py, drawn).map_err(|why| fault(py, &why))
}

/// Returns what to write instead of a kind of figure or a quantity of colours with a name of the last version.
#[pyfunction]
pub(super) fn new_name(kind: Option<&str>, fill: Option<&str>) -> Option<String> {
    let kind = kind.and_then(View::from_name).unwrap_or_default();
    let fill = fill.and_then(Fill::from_word).unwrap_or_default();
    let options = figure::Options { fill, ..figure::Options::default() };
    FigureArgs { kind, options, ..FigureArgs::default() }.note().map(|note| in_json(&note))
}

/// Reads the options of a figure from JSON, and checks that they fit the format of the file extension `ending`.
fn requested(request: &str, ending: &str) -> Result<(DrawArgs, Format), String> {
    let args = read_json(Some(request), DrawArgs::read)?;
    let format = Format::from_ending(ending).ok_or_else(|| {
        let known = Format::ALL.map(Format::ending).join(", ");
        format!("there is no format {ending}; a figure is one of {known}")
    })?;
    args.check(format).map_err(message)?;
    Ok((args, format))
}

/// Returns the message of an error, with the names that options have in Python.
fn message(error: CliError) -> String {
    in_json(&error.message())
}

/// Returns the name and the rings (in metres) of each body. The parts of the ground come first and have no name
/// (`None`); then come the blocks. The first ring of a body is its outline, and the others are its holes.
pub(super) fn outlines(scene: &Scene) -> Vec<(Option<String>, Vec<Ring>)> {
    let rings = |polygon: &Polygon| {
        let rings = polygon.rings().iter();
        rings.map(|ring| ring.iter().map(|p| [p.x, p.y]).collect()).collect()
    };
    let ground = scene.ground().iter();
    let ground = ground.map(|part| (None, rings(&part.body.polygon)));
    let blocks = scene.blocks().iter();
    let blocks = blocks.map(|block| (Some(block.id.clone()), rings(&block.body.polygon)));
    ground.chain(blocks).collect()
}

/// Writes a report on one scene to the file `path`, whose extension selects the format. `name` and `text` are the name
/// and the content of the scene file.
pub(super) fn report(
    analysis: &Analysis,
    path: &str,
    [name, text]: [&str; 2],
    title: Option<String>,
    theme: Option<&str>,
) -> Result<(), String> {
    let path = Path::new(path);
    let form = form_of(path).ok_or("the file name of a report must end in .html, .md, .pdf or .json")?;
    let unknown = |name: &str| format!("there is no theme {name}; the themes are {}", Theme::NAMES.join(", "));
    let chosen = theme.map(|name| Theme::named(name).ok_or_else(|| unknown(name))).transpose()?.unwrap_or_default();
    let mut analysis = analysis.clone();
    if form == Form::Pdf {
        // A PDF contains text in the built-in fonts of drystone. Code points replace characters that these fonts lack.
        analysis.change_scenes(|scene| missing_glyphs::legible(scene, &Fonts::default()));
    }
    let report_options =
        ReportOptions { theme: chosen, theme_name: theme.map(str::to_owned), ..ReportOptions::default() };
    let entry = Entry::new(File { name, text }, &analysis, &report_options);
    let piece = Piece::new(&entry, 1, form, &stem_of(path)).map_err(|error| error.to_string())?;
    let report = Report {
        title: title.unwrap_or_else(|| piece.row.title.clone()),
        pieces: vec![piece],
        refused: Vec::new(),
        notes: Vec::new(),
        compares: false,
        dark: theme.map(|_| report_options.theme.page.brightness() < 0.5),
        interactive: None,
    };
    write(report, form, path).map_err(message)
}
