//! Draws pictures and writes reports of an analysis for Python.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pyo3::prelude::*;

use super::{Ring, fault};
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::render::embedded;
use crate::geometry::Polygon;
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::Theme;
use crate::pictures::output::file::{Existing, write_whole};
use crate::pictures::output::fonts::Fonts;
use crate::products::report::entry::{Entry, File, ReportOptions};
use crate::products::report::page::{Form, Piece, Report};

/// Draws a figure of all frames, or only of frame number `frame`, counted from 0. Returns the bytes of the picture
/// file. `words` are options of `render`, and the file extension `ending` selects the format.
pub(super) fn drawn(
    analysis: &Analysis,
    words: &[String],
    ending: &str,
    frame: Option<usize>,
) -> Result<Vec<u8>, String> {
    match frame {
        None => embedded::figure(words, ending, analysis),
        Some(number) => embedded::figure(words, ending, &alone(analysis, number)),
    }
}

/// Returns a copy of an analysis with only one of its frames. `frame` is counted from 0.
fn alone(analysis: &Analysis, frame: usize) -> Analysis {
    let mut one = analysis.clone();
    let mut scene = (*analysis.scene).clone();
    scene.frames = scene.frames.into_iter().skip(frame).take(1).collect();
    one.frames = one.frames.into_iter().skip(frame).take(1).collect();
    one.scene = Arc::new(scene);
    one
}

/// Draws the outlines of a scene that is not valid, with its problems marked, and returns the bytes of the picture
/// file. `text` is the scene as JSON.
#[pyfunction]
pub(super) fn sketch(py: Python<'_>, text: &str, words: Vec<String>, ending: &str) -> PyResult<Vec<u8>> {
    py.detach(|| embedded::sketch(&words, ending, text)).map_err(|why| fault(py, &why))
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
    let path = PathBuf::from(path);
    let part = |part: Option<&std::ffi::OsStr>| part.map_or_else(String::new, |p| p.to_string_lossy().into_owned());
    let form = match part(path.extension()).to_ascii_lowercase().as_str() {
        "html" => Form::Html,
        "md" => Form::Markdown,
        "pdf" => Form::Pdf,
        "json" => Form::Json,
        other => {
            return Err(format!("the file name of a report must end in .html, .md, .pdf or .json, not in {other:?}"));
        }
    };
    let chosen = match theme {
        Some(name) => Theme::named(name).ok_or_else(|| {
            let known = Theme::NAMES.join(", ");
            format!("there is no theme {name}; the themes are {known}")
        })?,
        None => Theme::default(),
    };
    let mut analysis = analysis.clone();
    if form == Form::Pdf {
        // A PDF contains text in the built-in fonts of drystone. Code points replace characters that these fonts lack.
        analysis.scene = Arc::new(missing_glyphs::legible(&analysis.scene, &Fonts::default()));
    }
    let report_options =
        ReportOptions { theme: chosen, theme_name: theme.map(str::to_owned), ..ReportOptions::default() };
    let stem = part(path.file_stem());
    let entry = Entry::new(File { name, text }, &analysis, &report_options);
    let words = |error: &dyn std::error::Error| error.to_string();
    let piece = Piece::new(&entry, 1, form, &stem).map_err(|e| words(&e))?;
    let report = Report {
        title: title.unwrap_or_else(|| piece.row.title.clone()),
        pieces: vec![piece],
        refused: Vec::new(),
        notes: Vec::new(),
        compares: false,
        dark: theme.map(|_| report_options.theme.page.brightness() < 0.5),
        interactive: None,
    };
    let made = report.files(form, &stem).map_err(|e| words(&e))?;
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::with_capacity(made.len());
    for (number, (name, bytes)) in made.into_iter().enumerate() {
        let target = match number {
            0 => path.clone(),
            _ => folder.join(name),
        };
        if let (1.., Some(folder)) = (number, target.parent()) {
            std::fs::create_dir_all(folder).map_err(|e| words(&e))?;
        }
        files.push((target, bytes));
    }
    write_whole(&files, Existing::Replace)
        .map_err(|error| format!("cannot write {}: {}", error.path.display(), error.why))
}
