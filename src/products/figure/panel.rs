//! What the panels of a figure show: [`Figure`], which every kind of figure implements, and the part of the scene that
//! is shown.

use super::canvas::Canvas;
use super::design::{Look, zoomed_view};
use super::option::Options;
use super::{load, stage, verdict};
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::{Analysis, MarginKind, SolvedFrame, Verdict};
use crate::pictures::drawing::Group;
use crate::products::wording::margin::governing;
use crate::products::wording::number::letter;
use crate::products::wording::question;
use crate::products::wording::verdict::reason;

/// Largest size of a typical block in a picture, mm.
const LARGEST_BLOCK: f64 = 16.0;
/// Largest size of the block that a zoomed picture shows, mm.
const LARGEST_ZOOMED_BLOCK: f64 = 40.0;

/// The part of the scene that all panels show, and the scale of its lengths.
pub(crate) struct View<'a> {
    pub analysis: &'a Analysis,
    /// All blocks of all frames, metres.
    pub structure: Bounds,
    /// Pixels per metre.
    pub zoom: f64,
}

/// What the panels of a figure show.
pub(crate) struct Subject {
    /// The frames of the panels, counted from 0.
    pub frames: Vec<usize>,
    /// The part of the scene that each panel shows, metres.
    pub bounds: Bounds,
    /// Whether everything outside this part is cut off.
    pub is_cut: bool,
    /// The side of a typical block, metres, and its largest size in a picture, mm.
    pub block: (f64, f64),
}

impl Subject {
    /// The structure in all frames, or the neighbourhood of the block of the option `zoom`.
    pub fn structure(analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        let scene = analysis.given();
        let frames = frames.map_or_else(|| (0..analysis.frames.len()).collect(), <[usize]>::to_vec);
        if let Some(block) = options.zoom {
            let side = scene.blocks[block.0].body.polygon.area().sqrt();
            let bounds = zoomed_view(scene, block);
            return Subject { frames, bounds, is_cut: true, block: (side, LARGEST_ZOOMED_BLOCK) };
        }
        let blocks = stage::shown_blocks(scene);

        let ground = scene.ground.iter().map(|ground| ground.body.polygon.bounds());
        let origin = Bounds { min: Point::origin(), max: Point::origin() };
        let bounds = scene.bounds(&blocks).or_else(|| ground.reduce(Bounds::union)).unwrap_or(origin.grown(1.0));
        let last = scene.frames.last().map_or(&[][..], |frame| &frame.placed);
        let mut sizes: Vec<f64> = last.iter().map(|id| scene.blocks[id.0].body.polygon.area().sqrt()).collect();
        sizes.sort_by(f64::total_cmp);
        let side = sizes.get(sizes.len() / 2).copied().unwrap_or(bounds.diagonal());
        Subject { frames, bounds, is_cut: false, block: (side, LARGEST_BLOCK) }
    }
}

/// A kind of figure on the canvas. A new kind implements `about` and `draw` in a file of its own;
/// [`Kind`](super::Kind) lists it.
pub(crate) trait Figure: Sync {
    /// Returns the name, the description and the requirements of this kind of figure.
    fn about(&self) -> About;

    /// Draws the picture of a frame: the ground, the blocks, the robots and the loads, and between and above them what
    /// this kind of figure shows.
    fn draw(&self, canvas: &mut Canvas<'_>) {
        self.displace(canvas);
        stage::ground(canvas);
        stage::blocks(canvas);
        self.below(canvas);
        stage::held(canvas);
        load::loads(canvas);
        self.above(canvas);
        stage::names(canvas);
    }

    /// Displaces the blocks that are not drawn where they stand.
    fn displace(&self, _canvas: &mut Canvas<'_>) {}

    /// Draws what lies below the robots and the loads.
    fn below(&self, _canvas: &mut Canvas<'_>) {}

    /// Draws what lies above the robots and the loads.
    fn above(&self, _canvas: &mut Canvas<'_>) {}

    /// Returns the one scale of all forces of the figure, pixels per newton; 0 if the figure draws no forces of
    /// contacts.
    fn scale(&self, _view: &View<'_>, _look: Look) -> f64 {
        0.0
    }

    /// Returns the margins that the figure shows if the analysis has computed them. The figure is complete without them.
    fn stated_margins(&self, _analysis: &Analysis) -> &'static [MarginKind] {
        &[]
    }

    /// Returns what the panels of these frames show; `None` for the frames that the figure shows on one page.
    fn subject(&self, analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        Subject::structure(analysis, options, frames)
    }

    /// Returns the caption of a frame.
    fn caption(&self, analysis: &Analysis, frame: usize, options: &Options) -> String {
        caption(analysis, frame, options)
    }

    /// Returns the words of the verdict of a frame, which are written in bold.
    fn verdict(&self, analysis: &Analysis, frame: usize) -> String {
        verdict::badge(&analysis.frames[frame]).to_owned()
    }

    /// Returns the words after the verdict of a frame: by default its headline margin, or what decides if no margin
    /// does.
    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        margin_words(analysis, frame, options)
    }

    /// Describes the picture of a frame for screen readers; empty to describe only the verdict.
    fn description(&self, _canvas: &Canvas<'_>) -> String {
        String::new()
    }

    /// Draws a list below the picture of a frame, in `room` pixels. Returns it with its height.
    fn list(&self, _canvas: &Canvas<'_>, _room: f64) -> (Group, f64) {
        (Group::default(), 0.0)
    }
}

/// Returns the caption of a frame: its letter and its title, in a figure of several frames. In a zoomed figure, the
/// caption also names the block in the centre.
pub(crate) fn caption(analysis: &Analysis, frame: usize, options: &Options) -> String {
    let scene = analysis.given();
    let own = &scene.frames[frame].title;
    let mut parts = Vec::new();
    if scene.frames.len() > 1 {
        parts.push(format!("({})", letter(frame)));
    }
    if !own.is_empty() && (scene.frames.len() > 1 || *own != scene.title) {
        parts.push(own.clone());
    }
    if let Some(block) = options.zoom {
        parts.push(format!("around block {}", scene.blocks[block.0].id));
    }
    parts.join(" ")
}

/// Returns the headline margin of a frame, or what decides if no margin does.
pub(crate) fn margin_words(analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
    let solved @ SolvedFrame { scene, found, .. } = analysis.at(frame);
    let unexplained =
        found.verdict == Verdict::Undecided || found.verdict == Verdict::Unstable && found.failures.is_empty();
    // The panels of a strip are too narrow for margins.
    let mut margin =
        if options.verdict_margin && analysis.frames.len() == 1 { governing(solved).words } else { Vec::new() };
    // The placement tolerance is computed only if it was asked for; in a strip it shows which step is delicate.
    margin.extend(found.placement.as_ref().map(|placement| question::placement_proved(scene, placement)));
    if margin.is_empty() && unexplained {
        let reason = reason(solved);
        return if reason.is_empty() { Vec::new() } else { vec![reason] };
    }
    margin
}

/// The name of a kind of figure, and its requirements. Every kind has a name, a help text and a title.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct About {
    /// The name on the command line and in settings, in lower case.
    pub name: &'static str,
    /// One line for the help of `drystone render --kind`.
    pub help: &'static str,
    /// The title of the figure if the scene has none.
    pub title: &'static str,
    /// Whether the analysis has to compute the forces that a block can carry.
    pub needs_capacity: bool,
    /// Whether the analysis has to compute how a margin changes with corners, weights, friction and loads.
    pub needs_sensitivity: bool,
    /// Whether each falling part is shown with one elementary mechanism
    /// ([`Analysis::elementary`](crate::mechanics::analysis::Analysis::elementary)), and an animation shows several
    /// steps of its motion.
    pub needs_elementary_mechanisms: bool,
    /// Whether the arrows of all panels have one scale, independent of the options.
    pub shares_arrow_scale: bool,
    /// Whether the figure shows no verdicts, independent of the options.
    pub hides_verdicts: bool,
    /// Whether the line of the verdict states the headline margin.
    pub states_margin: bool,
    /// Whether the figure shows only the block that the options name, in one frame.
    pub shows_one_block: bool,
}

impl About {
    /// Names a kind without requirements.
    pub fn new(name: &'static str, help: &'static str, title: &'static str) -> About {
        About { name, help, title, ..About::default() }
    }
}
