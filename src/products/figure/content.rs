//! [`PanelContent`]: what the panels of one kind of figure show, and the [`FigureContext`] computed from it.
//!
//! A kind of figure is a type without fields that implements the trait in a file of its own;
//! [`Kind`](super::Kind) lists them all. A new kind starts from the smallest one, `kernel.rs`.

use core::cell::Cell;

use super::apart::apart;
use super::arrow::Marks;
use super::context::FigureContext;
use super::displacement::Displacement;
use super::fill::Fills;
use super::legend::Entry;
use super::option::{ArrowScale, Options};
use super::unit::unit;
use super::view;
use crate::analysis::Analysis;
use crate::drawing::{Camera, Group};
use crate::geometry::{Bounds, Point};

/// What the panels of one kind of figure show. The methods without a default are what every kind has to say.
pub(crate) trait PanelContent: Sync {
    /// The name on the command line and in settings, in small letters.
    fn name(&self) -> &'static str;

    /// One line for the help of `drystone render --kind`.
    fn help(&self) -> &'static str;

    /// The title of a figure whose scene has none.
    fn title(&self) -> &'static str;

    /// Whether the analysis has to compute the margins.
    fn needs_margins(&self) -> bool {
        false
    }

    /// Whether each part that falls is shown with one elementary mechanism
    /// ([`Analysis::elementary`](crate::analysis::Analysis::elementary)), in steps where the figure is animated.
    fn needs_elementary_mechanisms(&self) -> bool {
        false
    }

    /// Whether the arrows of all panels have one scale, whatever the options say.
    fn shares_arrow_scale(&self) -> bool {
        false
    }

    /// Whether the colour of a block shows its amplitude; otherwise blocks are plain.
    fn colours_show_amplitudes(&self) -> bool {
        false
    }

    /// Whether the forces on each block are drawn. They often lie on one line and are then moved apart.
    fn draws_forces(&self) -> bool {
        false
    }

    /// Whether lines run across the blocks, below their names.
    fn lines_cross_names(&self) -> bool {
        false
    }

    /// The force that is one unit edge long where each panel has its own scale, N; 0 for a kind without arrows.
    fn largest_force(&self, _analysis: &Analysis, _frame: usize, _options: &Options) -> f64 {
        0.0
    }

    /// The arrows of a frame; an arrow of `newtons_per_unit` N is one unit edge long.
    fn marks(
        &self,
        _analysis: &Analysis,
        _frame: usize,
        _options: &Options,
        _newtons_per_unit: f64,
    ) -> Marks {
        Marks::default()
    }

    /// How each block of a frame is displaced along this share of its motion, by the block's number. Empty where all
    /// blocks are drawn in their places. `unit` is the unit edge in metres.
    fn displacements(
        &self,
        _analysis: &Analysis,
        _frame: usize,
        _unit: f64,
        _share: f64,
    ) -> Vec<Option<Displacement>> {
        Vec::new()
    }

    /// A box around what a frame shows in addition to blocks, ground, robots and arrows, metres.
    fn extent(
        &self,
        _analysis: &Analysis,
        _frame: usize,
        _unit: f64,
        _marks: &Marks,
        _options: &Options,
    ) -> Option<Bounds> {
        None
    }

    /// The picture of a frame; ground is cut at the edge of `view`.
    fn picture(
        &self,
        context: &FigureContext<'_>,
        frame: usize,
        view: Bounds,
        camera: &Camera,
    ) -> Group;

    /// The entries of the key: every sign that occurs in the figure. `unit` is the unit edge in pixels.
    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry>;

    /// The line below a frame's verdict.
    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String;
}

impl<'a> FigureContext<'a> {
    /// The context of a figure with this content. Its steps depend on each other in this order: the scale of the arrows,
    /// the arrows, the box that each frame shows, the line below each verdict.
    pub fn new(
        analysis: &'a Analysis,
        options: &'a Options,
        content: &dyn PanelContent,
    ) -> FigureContext<'a> {
        let scene = &analysis.scene;
        let frames = 0..analysis.frames.len();
        let marks = scaled_marks(analysis, options, content);
        let unit = unit(scene, options.zoom);
        let shown = match options.zoom {
            Some(block) => vec![view::around(scene, block); marks.len()],
            None => {
                let extent = |frame| content.extent(analysis, frame, unit, &marks[frame], options);
                let extents: Vec<Option<Bounds>> = frames.clone().map(extent).collect();
                view::shown(scene, &marks, &extents, options.theme.widths.disc, unit)
            }
        };
        let nothing = Bounds {
            min: Point::origin(),
            max: Point::origin(),
        };
        let view = shown.iter().copied().reduce(Bounds::union);
        let displacements = |frame| content.displacements(analysis, frame, unit, options.way);
        let mut context = FigureContext {
            analysis,
            colours_show_amplitudes: content.colours_show_amplitudes(),
            lines_cross_names: content.lines_cross_names(),
            options,
            unit,
            view: view.unwrap_or(nothing.grown(unit)),
            shown,
            fills: Fills::new(analysis, options.fill),
            marks,
            displaced: frames.clone().map(displacements).collect(),
            statements: Vec::new(),
            cramped: Cell::new(0),
        };
        context.statements = frames
            .map(|frame| content.reason(&context, frame))
            .collect();
        context
    }
}

/// The arrows of each frame, to the scale that the options ask for, moved apart where they lie on one line.
fn scaled_marks(analysis: &Analysis, options: &Options, content: &dyn PanelContent) -> Vec<Marks> {
    let frames = 0..analysis.frames.len();
    let own: Vec<f64> = frames
        .map(|frame| content.largest_force(analysis, frame, options))
        .collect();
    let shared = own.iter().copied().fold(0.0, f64::max);
    let zoomed = options
        .zoom
        .map(|block| view::around(&analysis.scene, block));
    let scaled = |(frame, own): (usize, f64)| {
        let newtons_per_unit = match options.scale {
            ArrowScale::Panel => own,
            ArrowScale::Strip => shared,
        };
        let mut marks = content.marks(analysis, frame, options, newtons_per_unit);
        if let Some(near) = zoomed {
            marks.arrows.retain(|arrow| view::holds(near, arrow.at));
            marks.turns.retain(|turn| view::holds(near, turn.at));
        }
        if content.draws_forces() && !options.printed() {
            apart(&mut marks);
        }
        marks
    };
    own.iter().copied().enumerate().map(scaled).collect()
}
