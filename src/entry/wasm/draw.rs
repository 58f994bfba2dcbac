//! Draws figures as SVG for the WebAssembly module.

use super::Refusal;
use super::figure_options::FigureOptions;
use super::option::{self, deadline, scene};
use crate::mechanics::analysis::{self, Analysis};
use crate::mechanics::scene::{Scene, Sketch};
use crate::products::figure::{self, Kind};

/// Draws a figure of a scene, and returns the SVG. With the option `broken`, draws the outlines of a scene that may be
/// invalid, with its problems.
pub(super) fn figure(text: &str, options: &FigureOptions) -> Result<String, Refusal> {
    if options.broken {
        let sketch = Sketch::from_bytes(text.as_bytes(), options.contact_tolerance);
        let drawing = figure::broken(&sketch, &options.figure(None)?);
        return options.svg(drawing);
    }
    let scene = scene(text, options.contact_tolerance, options.frame)?;
    let mut analysis_options =
        analysis::Options::default().accuracy(options.accuracy.accuracy()).wedging(options.wedging);
    analysis_options.deadline = deadline(options.time_limit)?;
    let analysis_options = with_requests(analysis_options, &scene, options)?;
    let analysis = match options.kind()? {
        Some(kind) => kind.analysed(&scene, &analysis_options),
        None => Analysis::with(&scene, &analysis_options),
    };
    page(&analysis, options)
}

/// Adds the requests of a figure to the options of the analysis. The option `capacity` names the block whose capacity
/// is computed. For a sensitivity figure, the option `margin` names the margin whose sensitivity is computed.
fn with_requests(
    analysis_options: analysis::Options,
    scene: &Scene,
    options: &FigureOptions,
) -> Result<analysis::Options, Refusal> {
    let (capacity, for_all) = (options.capacity.as_deref(), options.for_all.as_deref());
    let mut analysis_options = option::with_capacity(analysis_options, scene, capacity, for_all)?;
    if options.kind()?.is_some_and(Kind::needs_sensitivity) {
        analysis_options.sensitivity = options.margin();
    }
    Ok(analysis_options)
}

/// Draws a figure of an existing analysis, and returns the SVG. If the figure needs results that the analysis lacks,
/// the scene is analysed again.
pub(super) fn drawn(analysis: &Analysis, options: &FigureOptions) -> Result<String, Refusal> {
    let analysis_options = with_requests(analysis::Options::default(), &analysis.scene, options)?;
    match options.kind()? {
        Some(kind) if kind.lacks(analysis, &analysis_options) => {
            page(&kind.analysed(&analysis.scene, &analysis_options), options)
        }
        _ => page(analysis, options),
    }
}

/// Draws a figure of an analysis that has all results for it, and returns the SVG.
fn page(analysis: &Analysis, options: &FigureOptions) -> Result<String, Refusal> {
    let zoom = options.zoom.as_deref();
    let zoom = zoom.map(|name| figure::named_block(&analysis.scene, name));
    let figure_options = options.figure(zoom.transpose().map_err(Refusal::of_option)?)?;
    let drawing = match options.kind()? {
        Some(kind) => figure::draw(analysis, kind, &figure_options),
        None => {
            let block = options.block.as_deref();
            let (frame, block) = figure::free_block(&analysis.scene, block).map_err(Refusal::of_option)?;
            figure::freebody(analysis, frame, block, &figure_options).expect("the block was found in this frame")
        }
    };
    options.svg(drawing)
}
