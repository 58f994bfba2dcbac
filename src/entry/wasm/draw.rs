//! Draws figures as SVG.

use super::Refusal;
use super::look::FigureOptions;
use super::option::{deadline, scene};
use crate::analysis::{self, Analysis};
use crate::figure;
use crate::scene::Sketch;

/// Draws a figure of a scene, and returns the SVG. With the option `broken`, draws the outlines of a scene that is not
/// valid.
pub(super) fn figure(text: &str, options: &FigureOptions) -> Result<String, Refusal> {
    if options.broken {
        let sketch = Sketch::from_bytes(text.as_bytes(), options.contact_tolerance);
        let drawing = figure::broken(&sketch, &options.figure(None)?);
        return options.svg(drawing);
    }
    let scene = scene(text, options.contact_tolerance, options.frame)?;
    let mut asked = analysis::Options::default()
        .accuracy(options.accuracy.accuracy())
        .wedging(options.wedging);
    asked.deadline = deadline(options.time_limit)?;
    let found = match options.kind()? {
        Some(kind) => kind.analysed(&scene, &asked),
        None => Analysis::with(&scene, &asked),
    };
    drawn(&found, options)
}

/// Draws a figure of an existing analysis, and returns the SVG.
pub(super) fn drawn(found: &Analysis, options: &FigureOptions) -> Result<String, Refusal> {
    let zoom = options.zoom.as_deref();
    let zoom = zoom.map(|name| figure::named_block(&found.scene, name));
    let wanted = options.figure(zoom.transpose().map_err(Refusal::of_option)?)?;
    let drawing = match options.kind()? {
        Some(kind) if kind.needs_margins() && found.frames.iter().any(|f| f.margins.is_none()) => {
            let asked = analysis::Options::default();
            figure::draw(&kind.analysed(&found.scene, &asked), kind, &wanted)
        }
        Some(kind) => figure::draw(found, kind, &wanted),
        None => {
            let block = options.block.as_deref();
            let (frame, block) =
                figure::free_block(&found.scene, block).map_err(Refusal::of_option)?;
            figure::freebody(found, frame, block, &wanted)
                .expect("the block was found in this frame")
        }
    };
    options.svg(drawing)
}
