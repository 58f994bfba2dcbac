//! [`Plan`]: computes the arrows at the corners of a frame, and its most effective changes with their numbers.

use super::super::option::Options;
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::{Analysis, CornerMoves, EndSensitivity, FrameAnalysis, MarginKind, Slope};
use crate::mechanics::scene::Scene;
use crate::products::wording::failure::pair;
use crate::products::wording::sensitivity::{
    self as words, EffectiveChange, FRICTION_STEP, Target, corner_moves, length, step_length, visible,
};

/// The length of the longest arrow is the larger of two lengths: this fraction of the structure's size, and this
/// number of unit lengths.
const MAX_ARROW_SHARES: (f64, f64) = (0.09, 0.8);
/// The largest number of numbered changes: in a figure of one frame, in a figure of one frame in a column of print,
/// and in each panel of several frames.
const MAX_NUMBERED: (usize, usize, usize) = (10, 5, 3);
/// Changes with a smaller effect, relative to the most effective one, have no number.
const LEAST_EFFECT: f64 = 0.1;
/// A corner has no arrow if moving it by one step changes the margin by at most this fraction of its value. The
/// derivative may then be a rounding error.
const NO_EFFECT: f64 = 1e-6;

/// The arrows and numbers of a frame.
pub(super) struct Plan {
    pub kind: MarginKind,
    /// Whether the shown end of the interval is the upper one.
    pub is_high: bool,
    /// The value of the shown end, in the unit of the margin.
    pub value: f64,
    pub arrows: Vec<CornerArrow>,
    pub changes: Vec<Numbered>,
    /// The number of corners at a kink, which have no arrow.
    pub kinks: usize,
    /// The length by which the numbered list assumes that a corner or a load moves, metres.
    pub step: f64,
}

/// The arrow of a corner, or of several corners that move together.
pub(super) struct CornerArrow {
    pub at: Point,
    /// The direction in which to move the corner. The length of the vector is the growth of the interval per metre.
    pub effect: Vector,
    /// The number of the change, from 1; `None` if it is not one of the most effective changes.
    pub number: Option<usize>,
}

/// One of the most effective changes.
pub(super) struct Numbered {
    pub number: usize,
    /// The point of the scene to which the change belongs, metres; `None` for a change of all joints.
    pub at: Option<Point>,
    /// Whether a load is moved.
    pub is_load: bool,
    /// A description of the change, and the value of the margin after it.
    pub words: String,
}

impl Plan {
    /// Computes the arrows and the numbered changes of a frame. Returns `None` if the derivatives of the frame's margin
    /// are not known.
    pub fn new(analysis: &Analysis, frame: usize, options: &Options) -> Option<Plan> {
        let (scene, frame_analysis) = (&analysis.scene, analysis.frames.get(frame)?);
        let sensitivity = frame_analysis.sensitivity.as_ref()?;
        let (is_high, end) = sensitivity.nearest()?;
        let kind = sensitivity.kind;
        let is_narrow = options.is_column();
        let most = match (analysis.frames.len(), is_narrow) {
            (0 | 1, false) => MAX_NUMBERED.0,
            (0 | 1, true) => MAX_NUMBERED.1,
            _ => MAX_NUMBERED.2,
        };
        let mut changes = visible(scene, frame_analysis, (kind, end, is_high), most);
        let effect = |change: &EffectiveChange| (change.after - end.value).abs();
        let least = changes.iter().map(effect).fold(0.0, f64::max) * LEAST_EFFECT;
        changes.retain(|change| effect(change) >= least);
        let step = step_length(scene, frame_analysis);
        let outward = if is_high { 1.0 } else { -1.0 };
        let number_of = |corner: usize| {
            let is_this =
                |change: &EffectiveChange| matches!(change.target, Target::Corner(number, _) if number == corner);
            changes.iter().position(is_this).map(|place| place + 1)
        };
        let (mut arrows, mut kinks) = (Vec::new(), 0);
        for (number, best) in corner_moves(frame_analysis, end, outward) {
            let corner = &end.corners[number];
            if is_kink(corner.moves) {
                kinks += 1;
            } else if let Some((direction, rate)) = best
                && rate * step > NO_EFFECT * end.value.abs()
            {
                arrows.push(CornerArrow { at: corner.at, effect: direction * rate, number: number_of(number) });
            }
        }
        let sketch = Sketch { scene, frame_analysis, end, kind };
        let changes = changes.iter().enumerate();
        let changes = changes.map(|(place, change)| sketch.numbered(place + 1, change));
        Some(Plan { kind, is_high, value: end.value, changes: changes.collect(), arrows, kinks, step })
    }

    /// Returns the largest growth of the margin, per metre of displacement, that an arrow shows; 0 if there are no
    /// arrows.
    pub fn strongest(&self) -> f64 {
        let effects = self.arrows.iter().map(|arrow| arrow.effect.norm());
        effects.fold(0.0, f64::max)
    }

    /// Returns the position of the number of a change in the scene. Returns `None` if an arrow has the number, or if
    /// the change has no position.
    pub fn mark(&self, change: &Numbered) -> Option<Point> {
        let mut arrows = self.arrows.iter();
        if arrows.any(|arrow| arrow.number == Some(change.number)) { None } else { change.at }
    }
}

/// Returns the length, in metres, of an arrow that shows a growth of the margin of 1 per metre. The scale is the same
/// in all frames; it is 0 if there are no arrows.
pub(super) fn scale(analysis: &Analysis, unit: f64, options: &Options) -> f64 {
    let scene = &analysis.scene;
    let frames = 0..analysis.frames.len();
    let plans = frames.filter_map(|frame| Plan::new(analysis, frame, options));
    let strongest = plans.map(|plan| plan.strongest()).fold(0.0, f64::max);
    let placed = scene.frames.iter().flat_map(|frame| &frame.placed);
    let structure = placed.map(|id| scene.blocks[id.0].body.polygon.bounds()).reduce(Bounds::union);
    let size = structure.map_or(0.0, |b| b.width().max(b.height()));
    if strongest > 0.0 { (MAX_ARROW_SHARES.0 * size).max(MAX_ARROW_SHARES.1 * unit) / strongest } else { 0.0 }
}

/// True if the margin has no unique derivatives with respect to the position of a corner.
fn is_kink(moves: CornerMoves) -> bool {
    let is_open = |slope: Slope| slope.unique().is_none();
    match moves {
        CornerMoves::Freely(slopes) => slopes.into_iter().any(is_open),
        CornerMoves::Along { slope, .. } => is_open(slope),
        CornerMoves::Not => false,
    }
}

/// The data that [`Sketch::numbered`] needs to describe a change of the shown end of the interval.
struct Sketch<'a> {
    scene: &'a Scene,
    frame_analysis: &'a FrameAnalysis,
    end: &'a EndSensitivity,
    kind: MarginKind,
}

impl Sketch<'_> {
    /// Describes a change in words and finds the position of its number.
    fn numbered(&self, number: usize, change: &EffectiveChange) -> Numbered {
        let (scene, frame_analysis) = (self.scene, self.frame_analysis);
        let by = length(scene, change.amount);
        let (at, done) = match change.target {
            Target::Corner(corner, direction) => {
                let corner = &self.end.corners[corner];
                let done =
                    if is_kink(corner.moves) { format!("{by} {}", words::toward(direction)) } else { format!("+{by}") };
                (Some(corner.at), done)
            }
            Target::Load(load, direction) => {
                let done = format!("load {by} {}", words::toward(direction));
                (Some(scene.loads[load].at), done)
            }
            Target::Weight(block) => {
                let sign = if change.words.ends_with("heavier") { '+' } else { '−' };
                let block = &scene.blocks[block.0];
                let done = format!("weight of {} {sign}10 %", block.id);
                (Some(block.centroid), done)
            }
            Target::Friction(interface) => {
                let contact = frame_analysis.contacts.get(interface);
                let between = contact.map(|c| pair(scene, c.interface.bodies));
                let done = format!("friction of {}", between.unwrap_or_default());
                let at = contact.map(|c| c.interface.middle());
                (at, format!("{done} {}", friction_change_text(change)))
            }
            Target::AllFriction => (None, format!("friction of all joints {}", friction_change_text(change))),
        };
        let after = words::value(self.kind, change.after);
        Numbered {
            number,
            at,
            is_load: matches!(change.target, Target::Load(..)),
            words: format!("{done} → about {after}"),
        }
    }
}

/// Returns the change of a friction coefficient with its sign.
fn friction_change_text(change: &EffectiveChange) -> String {
    let sign = if change.words.starts_with("raising") { '+' } else { '−' };
    format!("{sign}{FRICTION_STEP}")
}
