//! [`Strip`]: the panels of one scene, one for each frame. A panel has a picture, which [`PanelContent`] draws, a caption
//! and a verdict. A page shows the panels of one or more strips, with one legend below them.
//!
//! This file decides which panels are on which page. `page` draws a page, `panel` a panel, and `words` has their texts.

mod page;
mod panel;
mod words;

pub(crate) use page::page;

use super::content::PanelContent;
use super::context::FigureContext;
use super::layout::Layout;
use super::option::Options;
use super::view;
use crate::mechanics::analysis::Analysis;
use crate::pictures::drawing::Drawing;

/// Spaces that are added around the structure if some labels have no good position, pixels. In each pair, the first
/// value is for the left and the right, the second for above and below. All pairs but the first are only tried for flat
/// structures.
const SPACES_FOR_NAMES: [(f64, f64); 3] = [(24.0, 30.0), (8.0, 30.0), (8.0, 64.0)];
/// A structure is flat if its height is at most this fraction of its width.
const FLAT: f64 = 0.3;

/// In a column of print, texts become smaller if the pictures need less than this fraction of the height of the page.
/// It is a little more than half, because a picture has some empty space at its edges.
const MIN_PICTURE_SHARE: f64 = 0.55;

/// Draws a figure with one panel for each frame of the analysis. `content` draws the pictures of the panels. In a
/// column of print, texts are smaller if the pictures would fill less than [`MIN_PICTURE_SHARE`] of the height.
pub(crate) fn strip(analysis: &Analysis, content: &'static dyn PanelContent, options: &Options) -> Drawing {
    let (drawing, pictures) = with_room_for_labels(analysis, content, options);
    if !options.is_column() || pictures >= MIN_PICTURE_SHARE * drawing.height {
        return drawing;
    }
    let mut compact = options.clone();
    compact.theme.sizes = compact.theme.sizes.compact();
    with_room_for_labels(analysis, content, &compact).0
}

/// Draws the figure of [`strip`] with the font sizes of the options. Adds space around the structure if labels need it.
/// Also returns the height of all rows of pictures, pixels.
fn with_room_for_labels(analysis: &Analysis, content: &'static dyn PanelContent, options: &Options) -> (Drawing, f64) {
    let context = FigureContext::new(analysis, options, content);
    let flat = context.view.height() <= FLAT * context.view.width();
    let count = analysis.frames.len();
    let drawn = |context: &FigureContext<'_>| {
        let layout = Layout::new(context, count);
        let strip = Strip { content, context, layout, captions: None, alike: false };
        let (_, pictures) = layout.least(context);
        let figure = (strip.drawing(), pictures);
        (figure, context.cramped.get(), layout.scale)
    };
    let (figure, cramped, scale) = drawn(&context);
    if cramped == 0 || options.zoom.is_some() || scale <= 0.0 {
        return figure;
    }
    // Some labels are placed badly. Draw the figure again with more space around the structure; for a flat structure,
    // try several amounts of space. Use the figure with the smallest penalty for its labels
    // (`FigureContext::cramped`), if this penalty is at most half of that of the first figure.
    let mut best = (figure, cramped);
    let count = if flat { SPACES_FOR_NAMES.len() } else { 1 };
    // Labels of a flat structure rarely need space below the ground.
    let on_ground = flat && view::has_ground_below(&analysis.scene, context.unit);
    for (across, up) in &SPACES_FOR_NAMES[..count] {
        let context = FigureContext::new(analysis, options, content);
        let (across, up) = (across / scale, up / scale);
        let down = if on_ground { 0.0 } else { up };
        let (roomier, still, _) = drawn(&context.with_room(across, up, down));
        if 2 * still <= cramped && still < best.1 {
            best = (roomier, still);
        }
        if best.1 == 0 {
            break;
        }
    }
    best.0
}

/// Draws the panels of [`strip`] for these frames, each on a separate page. All pages have the same size and scale, so
/// that they can be the pictures of an animation.
pub(crate) fn pages(
    analysis: &Analysis,
    content: &'static dyn PanelContent,
    options: &Options,
    frames: impl Iterator<Item = usize>,
) -> Vec<Drawing> {
    let context = FigureContext::new(analysis, options, content);
    let mut pages: Vec<Drawing> = Vec::new();
    for frame in frames {
        let strip = Strip { content, context: &context, layout: Layout::new(&context, 1), captions: None, alike: true };
        pages.push(page(&[&strip], &[(0, frame)], &analysis.scene.title));
    }
    let highest = pages.iter().map(|p| p.height).fold(0.0, f64::max);
    for page in &mut pages {
        page.height = highest;
    }
    pages
}

/// Draws the panels of [`strip`] on several pages at the same scale. The height of a page is at most `high` times its
/// width, unless a single row is higher.
pub(crate) fn split(
    analysis: &Analysis,
    content: &'static dyn PanelContent,
    options: &Options,
    high: f64,
) -> Vec<Drawing> {
    let context = FigureContext::new(analysis, options, content);
    let count = analysis.frames.len();
    let layout = Layout::roomy(&context, count);
    let strip = Strip { content, context: &context, layout, captions: None, alike: false };
    let order: Vec<(usize, usize)> = (0..count).map(|frame| (0, frame)).collect();
    let drawn = |order: &[(usize, usize)]| page(&[&strip], order, &analysis.scene.title);
    let mut pages = Vec::new();
    let mut rest = &order[..];
    while !rest.is_empty() {
        let mut taken = layout.columns.min(rest.len());
        let mut page = drawn(&rest[..taken]);
        while taken < rest.len() {
            let more = (taken + layout.columns).min(rest.len());
            let next = drawn(&rest[..more]);
            if next.height > high * next.width {
                break;
            }
            (taken, page) = (more, next);
        }
        pages.push(page);
        rest = &rest[taken..];
    }
    pages
}

/// The panels of one scene in a figure, all of the same kind.
pub(crate) struct Strip<'a> {
    pub content: &'static dyn PanelContent,
    pub context: &'a FigureContext<'a>,
    pub layout: Layout,
    /// Captions of the frames, instead of their letters and titles.
    pub captions: Option<&'a [String]>,
    /// Whether every panel shows the same part of the scene, which is large enough for all panels. An animation needs
    /// this.
    pub alike: bool,
}

impl Strip<'_> {
    fn drawing(&self) -> Drawing {
        let frames = 0..self.context.marks.len();
        let order: Vec<(usize, usize)> = frames.map(|frame| (0, frame)).collect();
        page(&[self], &order, &self.context.analysis.scene.title)
    }
}
