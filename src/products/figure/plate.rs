//! [`plate`]: draws frames of several scenes as panels on one page, all at the same scale and with one legend below.

use super::context::FigureContext;
use super::forces::FORCES;
use super::layout::Layout;
use super::option::Options;
use super::strip::{Strip, page};
use crate::mechanics::analysis::Analysis;
use crate::pictures::drawing::Drawing;

/// A panel of a plate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    /// The index of the analysis whose frame the panel shows.
    pub of: usize,
    /// The index of the frame in this analysis.
    pub frame: usize,
    /// The caption below the panel.
    pub caption: &'static str,
}

/// Draws `panels` on one page in the given order, in rows of `columns` panels. All panels of a row show the same
/// vertical range of their scenes, so that their structures can be compared.
pub(crate) fn plate(
    analyses: &[Analysis],
    panels: &[Panel],
    title: &str,
    columns: usize,
    options: &Options,
) -> Drawing {
    let options = Options { columns: Some(columns), ..options.clone() };
    let contexts: Vec<FigureContext<'_>> =
        analyses.iter().map(|analysis| FigureContext::new(analysis, &options, &FORCES)).collect();
    let layouts: Vec<Layout> = contexts.iter().map(|context| Layout::new(context, panels.len())).collect();
    let Some(layout) = layouts.iter().copied().reduce(Layout::both) else {
        return Drawing::default();
    };
    let caption = |of: usize, frame: usize| {
        let own = panels.iter().find(|p| (p.of, p.frame) == (of, frame));
        own.map_or_else(String::new, |p| p.caption.to_owned())
    };
    let captions: Vec<Vec<String>> =
        analyses.iter().enumerate().map(|(of, a)| (0..a.frames.len()).map(|f| caption(of, f)).collect()).collect();
    let strips: Vec<Strip<'_>> = contexts
        .iter()
        .zip(&captions)
        .map(|(context, captions)| Strip { content: &FORCES, context, layout, captions: Some(captions), alike: false })
        .collect();
    let strips: Vec<&Strip<'_>> = strips.iter().collect();
    let order: Vec<(usize, usize)> = panels.iter().map(|p| (p.of, p.frame)).collect();
    page(&strips, &order, title)
}
