//! [`PanelContent`]: the trait that each kind of figure implements. [`FigureContext::new`] computes the data that all
//! panels of a figure share.
//!
//! A kind of figure is a type that implements the trait in a separate file, usually without fields;
//! [`Kind`](super::Kind) lists all kinds. New kinds implement [`Figure`](super::sheet::Figure) instead.

use core::cell::Cell;

use super::arrow::Marks;
use super::context::FigureContext;
use super::fill::Fills;
use super::layout::Layout;
use super::legend::Entry;
use super::load_arrows::{lengthen_loads, load_marks, load_scale, place_loads};
use super::option::{ArrowScale, Options};
use super::parallel_arrows::separate_parallel_arrows;
use super::pen::Pen;
use super::unit::unit;
use super::verdict;
use super::view;
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::{Analysis, MarginKind};
use crate::pictures::drawing::Group;

/// The name of a kind of figure, and its requirements. Every kind has a name, a help text and a title.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct About {
    /// The name on the command line and in settings, in lower case.
    pub name: &'static str,
    /// One line for the help of `drystone render --kind`.
    pub help: &'static str,
    /// The title of the figure if the scene has none.
    pub title: &'static str,
    /// Whether the analysis has to compute the margins.
    pub needs_margins: bool,
    /// Whether the analysis has to compute the forces that a block can carry.
    pub needs_capacity: bool,
    /// Whether the analysis has to compute how a margin changes with corners, weights, friction and loads.
    pub needs_sensitivity: bool,
    /// Whether each falling part is shown with one elementary mechanism
    /// ([`Analysis::elementary`](crate::mechanics::analysis::Analysis::elementary)), and an animation shows several steps of its
    /// motion.
    pub needs_elementary_mechanisms: bool,
    /// Whether the arrows of all panels have one scale, independent of the options.
    pub shares_arrow_scale: bool,
    /// Whether the figure shows no verdicts, independent of the options.
    pub hides_verdicts: bool,
    /// Whether the line of the verdict states another margin than the headline margin.
    pub states_own_margin: bool,
    /// Whether the figure shows only the block that the options name, in one frame.
    pub shows_one_block: bool,
    /// Whether the colour of a block shows the quantity that the option `fill` selects, by default its amplitude (the
    /// larger of its weight and its largest normal force). Otherwise blocks are plain.
    pub colours_show_amplitudes: bool,
    /// Whether the forces on each block are drawn. Arrows on one line are then moved apart.
    pub draws_forces: bool,
    /// Whether arrows may be longer than a unit length if unit lengths are short on the page.
    pub stretches_arrows: bool,
    /// Whether lines are drawn across blocks. The letters of labels then have a border in the background colour.
    pub lines_cross_names: bool,
}

/// A frame of an analysis that is to be drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameSource<'a> {
    pub analysis: &'a Analysis,
    /// The index of the frame, from 0.
    pub frame: usize,
    pub options: &'a Options,
}

/// The content of the panels of one kind of figure. Every kind implements the methods without a default.
pub(crate) trait PanelContent: Sync {
    /// Returns the name, the description and the requirements of this kind of figure.
    fn about(&self) -> About;

    /// Returns the optional margins: the figure shows them if the analysis has computed them, and is complete without
    /// them. Margins that the figure needs are requested with [`About::needs_margins`].
    fn stated_margins(&self, _analysis: &Analysis) -> &'static [MarginKind] {
        &[]
    }

    /// Returns the force, in newtons, whose arrow is one unit length long if each panel has its own scale of arrows. By
    /// default, this is a scale for the loads of the frame. The result is 0 if the figure has no arrows.
    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        load_scale(of.analysis, of.frame, of.options)
    }

    /// Returns the arrows of a frame: by default its loads, because no figure may hide them. The arrow of a force of
    /// `newtons_per_unit` newtons is one unit length long.
    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        load_marks(of.analysis, of.frame, of.options, newtons_per_unit)
    }

    /// Returns the text next to the symbol of the verdict of a frame.
    fn headline(&self, context: &FigureContext<'_>, frame: usize) -> String {
        verdict::badge(&context.analysis.frames[frame]).to_owned()
    }

    /// Returns a box, in metres, around all items of a frame other than blocks, ground, robots and arrows. Returns
    /// `None` if there are no such items. `unit` is the unit length in metres.
    fn extent(&self, _of: FrameSource<'_>, _unit: f64, _marks: &Marks) -> Option<Bounds> {
        None
    }

    /// Draws the picture of one frame with `pen`. `view` is the shown part of the scene in metres; ground outside it is
    /// cut off.
    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group;

    /// Returns the entries of the legend, which explain all symbols in the figure. `unit` is the unit length in pixels.
    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry>;

    /// Returns the text below the verdict of a frame, which states the reason or the main result.
    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String;
}

impl<'a> FigureContext<'a> {
    /// Computes the data that all panels of a figure share. Each step uses the results of the earlier steps: the scale
    /// of the arrows, the arrows, the shown part of each frame, and the text below each verdict.
    pub fn new(analysis: &'a Analysis, options: &'a Options, content: &dyn PanelContent) -> FigureContext<'a> {
        let scene = &analysis.scene;
        let about = content.about();
        let frames = 0..analysis.frames.len();
        let marks = scaled_marks(analysis, options, content);
        let unit = unit(scene, options.zoom);
        let shown = match options.zoom {
            Some(block) => vec![view::zoomed_view(scene, block); marks.len()],
            None => {
                let extent = |frame: usize| {
                    let source = FrameSource { analysis, frame, options };
                    content.extent(source, unit, &marks[frame])
                };
                let extents: Vec<Option<Bounds>> = frames.clone().map(extent).collect();
                view::shown(scene, &marks, &extents, options.theme.widths.disc, unit)
            }
        };
        let nothing = Bounds { min: Point::origin(), max: Point::origin() };
        let view = shown.iter().copied().reduce(Bounds::union);
        let mut context = FigureContext {
            analysis,
            colours_show_amplitudes: about.colours_show_amplitudes,
            lines_cross_names: about.lines_cross_names,
            options,
            unit,
            view: view.unwrap_or(nothing.grown(unit)),
            shown,
            fills: Fills::new(analysis, options.fill),
            displaced: vec![Vec::new(); marks.len()],
            marks,
            statements: Vec::new(),
            cramped: Cell::new(0),
        };
        context.statements = frames.map(|frame| content.reason(&context, frame)).collect();
        context
    }
}

/// Returns the arrows of each frame at the scale that the options select. Arrows that overlap are moved apart if the
/// kind of figure draws the forces on each block, except in the style of the thesis.
fn scaled_marks(analysis: &Analysis, options: &Options, content: &dyn PanelContent) -> Vec<Marks> {
    let about = content.about();
    let source = |frame: usize| FrameSource { analysis, frame, options };
    let frames = 0..analysis.frames.len();
    let own: Vec<f64> = frames.map(|frame| content.largest_force(source(frame))).collect();
    let shared = own.iter().copied().fold(0.0, f64::max);
    let zoomed = options.zoom.map(|block| view::zoomed_view(&analysis.scene, block));
    let (stretch, least_load) =
        if about.stretches_arrows && !options.printed() { stretch(analysis, options) } else { (1.0, 0.0) };
    let scaled = |(frame, own): (usize, f64)| {
        let newtons_per_unit = match options.scale {
            ArrowScale::Panel => own / stretch,
            ArrowScale::Strip => shared / stretch,
        };
        let mut marks = content.marks(source(frame), newtons_per_unit);
        for arrow in &mut marks.arrows {
            arrow.width *= stretch.sqrt();
        }
        marks
    };
    let mut all: Vec<Marks> = own.iter().copied().enumerate().map(scaled).collect();
    match options.scale {
        // In the style of the thesis, lengths are always to scale.
        _ if options.printed() => {}
        ArrowScale::Panel => all.iter_mut().for_each(|marks| lengthen_loads(core::slice::from_mut(marks), least_load)),
        ArrowScale::Strip => lengthen_loads(&mut all, least_load),
    }
    for (frame, marks) in all.iter_mut().enumerate() {
        if let Some(near) = zoomed {
            marks.arrows.retain(|arrow| view::contains(near, arrow.at));
            marks.turns.retain(|turn| view::contains(near, turn.at));
        }
        // In the style of the thesis, every arrow begins at the point where its force acts.
        if !options.printed() {
            place_loads(&analysis.scene, frame, marks);
        }
        if about.draws_forces && !options.printed() {
            separate_parallel_arrows(marks);
        }
    }
    all
}

/// Least length of the longest arrow, pixels: in a single panel in a column of print (where it is about 8.5 mm), and in
/// other figures.
const MIN_LONGEST_ARROW: (f64, f64) = (40.0, 34.0);
/// Largest length of an arrow in unit lengths: in figures whose frames have at most `FEW_BLOCKS` blocks, and in all
/// other figures.
const MAX_ARROW_UNIT_LENGTHS: (f64, f64) = (3.0, 1.5);
/// The same two lengths for a single panel in a column of print, where unit lengths are short on the page.
const MAX_COLUMN_ARROW_UNIT_LENGTHS: (f64, f64) = (6.0, 3.5);
const FEW_BLOCKS: usize = 40;
/// Largest length of an arrow, as a fraction of the longer side of the shown part.
const MAX_ARROW_SHARE: f64 = 0.25;

/// Least length of the longest arrow of a load, pixels.
const MIN_LONGEST_LOAD_ARROW: f64 = 24.0;

/// Returns two lengths. The first is the length of the longest arrow in unit lengths, at least 1. It is larger than 1
/// if a unit length is short on the page, so that small arrows keep a visible shaft. The second is the least length of
/// the longest load arrow, in metres.
fn stretch(analysis: &Analysis, options: &Options) -> (f64, f64) {
    let unit = unit(&analysis.scene, options.zoom);
    let bare = FigureContext::new(analysis, options, &NoArrows);
    let scale = Layout::new(&bare, analysis.frames.len()).scale;
    let placed = analysis.scene.frames.iter().map(|f| f.placed.len());
    // Longer arrows need the space around one panel. Several panels are too narrow for them.
    let one_panel = options.is_column() && analysis.frames.len() == 1;
    let (least, (few, many)) = if one_panel {
        (MIN_LONGEST_ARROW.0, MAX_COLUMN_ARROW_UNIT_LENGTHS)
    } else {
        (MIN_LONGEST_ARROW.1, MAX_ARROW_UNIT_LENGTHS)
    };
    let most = if placed.max().unwrap_or(0) > FEW_BLOCKS { many } else { few };
    let longest = MAX_ARROW_SHARE * bare.view.width().max(bare.view.height());
    let stretch = (least / (unit * scale)).min(longest / unit).min(most);
    let load = (MIN_LONGEST_LOAD_ARROW / scale).min(longest);
    if stretch.is_finite() && load.is_finite() { (stretch.max(1.0), load) } else { (1.0, 0.0) }
}

/// A content without arrows, to compute the scale of a figure before its arrows are known.
struct NoArrows;

impl PanelContent for NoArrows {
    fn about(&self) -> About {
        About::default()
    }

    fn marks(&self, _: FrameSource<'_>, _: f64) -> Marks {
        Marks::default()
    }

    fn picture(&self, _: &Pen<'_>, _: Bounds) -> Group {
        Group::default()
    }

    fn entries(&self, _: &FigureContext<'_>, _: f64) -> Vec<Entry> {
        Vec::new()
    }

    fn reason(&self, _: &FigureContext<'_>, _: usize) -> String {
        String::new()
    }
}
