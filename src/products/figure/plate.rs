//! [`plate`]: frames of several scenes on one page, to one scale, with one key below them all.

use super::kind::Kind;
use super::layout::Layout;
use super::option::Options;
use super::stage::FigureContext;
use super::strip::{Strip, page};
use crate::analysis::Analysis;
use crate::drawing::Drawing;

/// A panel of a plate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    /// Which analysis it is of.
    pub of: usize,
    /// Which frame of it.
    pub frame: usize,
    /// What stands below it.
    pub caption: &'static str,
}

/// These panels in rows of `columns`, in their order, the structures of a row on one level.
pub(crate) fn plate(
    analyses: &[Analysis],
    panels: &[Panel],
    title: &str,
    columns: usize,
    options: &Options,
) -> Drawing {
    let options = Options {
        columns: Some(columns),
        ..options.clone()
    };
    let stages: Vec<FigureContext<'_>> = analyses
        .iter()
        .map(|analysis| Kind::Forces.stage(analysis, &options))
        .collect();
    let layouts: Vec<Layout> = stages
        .iter()
        .map(|stage| Layout::new(stage, panels.len()))
        .collect();
    let Some(layout) = layouts.iter().copied().reduce(Layout::both) else {
        return Drawing::default();
    };
    let caption = |of: usize, frame: usize| {
        let own = panels.iter().find(|p| (p.of, p.frame) == (of, frame));
        own.map_or_else(String::new, |p| p.caption.to_owned())
    };
    let captions: Vec<Vec<String>> = analyses
        .iter()
        .enumerate()
        .map(|(of, a)| (0..a.frames.len()).map(|f| caption(of, f)).collect())
        .collect();
    let strips: Vec<Strip<'_>> = stages
        .iter()
        .zip(&captions)
        .map(|(stage, captions)| Strip {
            kind: Kind::Forces,
            stage,
            layout,
            captions: Some(captions),
            alike: false,
        })
        .collect();
    let strips: Vec<&Strip<'_>> = strips.iter().collect();
    let order: Vec<(usize, usize)> = panels.iter().map(|p| (p.of, p.frame)).collect();
    page(&strips, &order, title)
}
