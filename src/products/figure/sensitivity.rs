//! Draws how a margin changes if corners of blocks move: an arrow at a corner shows in which direction a displacement
//! of this corner enlarges the margin most.
//!
//! The arrow points in the direction in which the interval of the margin grows most. Its length is proportional to the
//! growth per metre. Corners that move together have one arrow. The most effective changes have numbers, and the legend
//! lists them. They include changes of weights, loads and friction. A corner has no arrow if the derivatives of the
//! margin are not unique there (a kink). The figure shows the end of the interval that is nearer to 0; for the load
//! factor, it shows the upper end. The options of the analysis select the margin.

use super::arrow::MIN_VISIBLE_ARROW;
use super::canvas::Canvas;
use super::design::{Key, Layer, Mark, along, unit};
use super::option::Options;
use super::panel::{About, Figure};
use super::placing::Label;
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{
    Analysis, CornerMoves, EndSensitivity, FrameAnalysis, MarginKind, Slope, SolvedFrame,
};
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Colour, Face, Group, Outline, PagePoint, Path, Text, Theme, text};
use crate::products::wording::failure::pair;
use crate::products::wording::number::{counted, digits, round_below};
use crate::products::wording::sensitivity::{
    self as words, EffectiveChange, FRICTION_STEP, Target, corner_moves, end_name, length, name, step_length, value,
    visible, without,
};

/// Radius of the ring around the number of a change without an arrow, mm.
const RING_RADIUS: f64 = 1.9;
/// Largest length of the arrow that shows the scale, mm.
const MAX_SCALE_ARROW: f64 = 11.0;
/// Widths of the shafts of arrows with and without a number, mm.
const WIDTHS: [f64; 2] = [0.5, 0.3];

/// The figure that shows how corners of blocks affect a margin.
pub(crate) struct CornerEffects;

impl Figure for CornerEffects {
    fn about(&self) -> About {
        About {
            needs_sensitivity: true,
            ..About::new(
                "sensitivity",
                "Where to move corners to make a margin larger, the ten most effective changes numbered; --margin selects the margin",
                "How corners change the margin of a dry-laid structure",
            )
        }
    }

    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        let Some(sensitivity) = &analysis.frames[frame].sensitivity else {
            return vec!["the sensitivity of its margins was not computed".into()];
        };
        if let Some(reason) = sensitivity.reason() {
            return vec![without(sensitivity.kind, reason)];
        }
        let Some(plan) = Plan::new(analysis, frame, options) else { return Vec::new() };
        let (limit, end) = (value(plan.kind, plan.value, plan.is_high), end_name(plan.kind, plan.is_high));
        let name = name(plan.kind, plan.is_high);
        let mut words = vec![format!("limit: {name} {limit} ({end} end of the interval in which the frame stands)")];
        if plan.arrows.is_empty() && plan.changes.is_empty() {
            words.push(if plan.kinks == 0 {
                "no single corner makes it visibly better".into()
            } else {
                "it is at a kink, where corners have no unique derivatives".into()
            });
        }
        words
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        if let Some(plan) = Plan::new(canvas.analysis, canvas.number, canvas.options) {
            arrows(canvas, &plan);
            rings(canvas, &plan);
            if plan.kinks > 0 {
                let corners = counted(plan.kinks, "corner");
                canvas.note(70, &format!("{corners} without an arrow, because the margin has a kink there"));
            }
        }
    }

    /// Lists the numbered changes with the estimated new margins.
    fn list(&self, canvas: &Canvas<'_>, room: f64) -> (Group, f64) {
        let mut group = Group::with_class("list");
        let plan = Plan::new(canvas.analysis, canvas.number, canvas.options).filter(|_| canvas.options.keys);
        let (theme, ink) = (canvas.theme(), number_colour(canvas.theme()));
        let size = canvas.look.text * theme.sizes.verdict;
        let indent = 1.9 * size;
        let changes = plan.iter().flat_map(|plan| &plan.changes);
        let broken = changes.map(|change| {
            (change.number, text::sentence_lines(&change.words, Face::Sans, size, room - indent, usize::MAX))
        });
        let broken: Vec<(usize, Vec<String>)> = broken.collect();
        let widths = broken.iter().flat_map(|(_, lines)| lines).map(|line| text::width(line, Face::Sans, size));
        let left = -(widths.fold(0.0, f64::max) + indent) / 2.0;
        let mut y = 0.0;
        for (number, lines) in broken {
            for (place, line) in lines.into_iter().enumerate() {
                y += 1.36 * size;
                if place == 0 {
                    let at = PagePoint::new(left, y);
                    group = group.with(Text::new(at, number.to_string(), Face::SansBold, size, ink));
                }
                group = group.with(Text::new(PagePoint::new(left + indent, y), line, Face::Sans, size, theme.ink));
            }
        }
        (group, y + 0.4 * size)
    }
}

/// Draws the arrows at the corners. The numbered arrows, which have the largest effects, are drawn last, so that no
/// other arrow covers them.
fn arrows(canvas: &mut Canvas<'_>, plan: &Plan) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let metres = scale(canvas.analysis, unit(scene, canvas.options.zoom), canvas.options);
    let sized = |canvas: &Canvas<'_>, length: f64, is_numbered: bool| {
        let width = WIDTHS[usize::from(!is_numbered)];
        canvas.arrow(length, [width, 3.4 * width, 3.4 * width], 0.62)
    };
    let (start, long) = (PagePoint::new(0.0, 0.0), canvas.mm(4.8));
    let key = |rank: u8, words: String, is_numbered: bool, width: f64| {
        let outline = sized(canvas, width, is_numbered).outline(start, (1.0, 0.0));
        Key::new(rank, words, vec![Path::filled(outline, colour(theme, is_numbered))], width)
    };
    let plain_key = key(10, "where to move a corner; longer: more effect".into(), false, long);
    let numbered_key = key(12, "most effective moves, listed".into(), true, long);
    if let Some((width, words)) = scale_words(scene, plan, canvas.camera.length(metres), canvas.mm(MAX_SCALE_ARROW)) {
        let scale_key = key(11, words, false, width);
        canvas.explain(scale_key);
    }
    let mut order: Vec<&CornerArrow> = plan.arrows.iter().collect();
    order.sort_by_key(|arrow| std::cmp::Reverse(arrow.number.unwrap_or(usize::MAX)));
    for arrow in order {
        let from = canvas.place(arrow.at);
        let (x, y) = canvas.camera.turn(arrow.effect * metres);
        let long = libm::hypot(x, y);
        if long < MIN_VISIBLE_ARROW && arrow.number.is_none() {
            continue;
        }
        let u = (x / long, y / long);
        let outline = sized(canvas, long, arrow.number.is_some()).outline(from, u);
        let path = Path::filled(outline, colour(theme, arrow.number.is_some())).cased(theme.page, canvas.mm(0.15));
        let per_step = plan.change(arrow.effect.norm() * plan.step);
        let title = format!("{per_step} for {}", length(scene, plan.step));
        let key = if arrow.number.is_some() { &numbered_key } else { &plain_key };
        let mark = Mark::new(Layer::Missing, "effect", vec![path]).titled(title).keyed(key);
        canvas.put(mark.avoided(0.15));
        if let Some(number) = arrow.number {
            let anchors = vec![along(from, u, long, 0.0), along(from, u, 0.6 * long, 0.0)];
            let label = Label::new(number.to_string(), number_colour(theme), anchors, 10 + number.min(90) as u8);
            canvas.label(Label { bold: true, away: Some(u), ..label });
        }
    }
}

/// Draws a ring with a number for each numbered change that has a position but no arrow, such as changes of weights,
/// loads and the friction of one joint. Rings at one place stand side by side.
fn rings(canvas: &mut Canvas<'_>, plan: &Plan) {
    let (theme, radius) = (canvas.theme(), canvas.mm(RING_RADIUS));
    let ring = |at: PagePoint, radius: f64| {
        let edge = canvas.pen(number_colour(theme), 0.25);
        vec![Path::filled(Outline::circle(at, radius), theme.page).with_stroke(edge)]
    };
    let (small, width) = (0.6 * radius, 1.2 * radius + canvas.mm(0.3));
    let symbol = ring(PagePoint::new(small + canvas.mm(0.15), 0.0), small);
    let words = "change of a weight, load or joint, listed";
    let key = Key::new(13, words, symbol, width);
    let mut taken: Vec<PagePoint> = Vec::new();
    let mut drawn = Vec::new();
    for change in &plan.changes {
        let Some(place) = plan.mark(change) else { continue };
        let mut at = canvas.place(place);
        if change.is_load {
            // Leave the tip of the arrow of the load free.
            at = at.moved(1.3 * radius, -1.3 * radius);
        }
        while taken.iter().any(|other| other.distance(at) < 2.1 * radius) {
            at = at.moved(0.5 * radius, 0.0);
        }
        taken.push(at);
        drawn.push((at, ring(at, radius), change));
    }
    for (at, shapes, change) in drawn {
        let mark = Mark::new(Layer::Missing, "change", shapes).titled(format!("{}: {}", change.number, change.words));
        canvas.put(mark.keyed(&key).avoided(0.2));
        let label = Label::at(at, change.number.to_string(), number_colour(theme), 0);
        canvas.label(Label { bold: true, ..label });
    }
}

/// Returns the length of the arrow that shows the scale, pixels, and its words; `None` if there are no arrows. `pixels`
/// is the length of an arrow that shows a growth of the margin of 1 per metre, and `most` the largest length.
fn scale_words(scene: &Scene, plan: &Plan, pixels: f64, most: f64) -> Option<(f64, String)> {
    // The sample arrow is not longer than the longest arrow of the figure.
    let longest = plan.strongest() * pixels;
    let amount = round_below(longest.min(most) / pixels * plan.step);
    let drawn = amount / plan.step * pixels;
    let name = name(plan.kind, plan.is_high);
    let change = plan.change(amount);
    let change = match end_name(plan.kind, plan.is_high) {
        side if plan.kind.is_signed() => format!("{name} {change} farther to the {side}"),
        _ => format!("{name} {}{change}", if plan.is_high { '+' } else { '−' }),
    };
    (amount > 0.0 && drawn.is_finite()).then(|| (drawn, format!("{change} for {}", length(scene, plan.step))))
}

fn colour(theme: &Theme, is_numbered: bool) -> Colour {
    if is_numbered { theme.motion.mixed(theme.ink, 0.15) } else { theme.motion.mixed(theme.page, 0.4) }
}

fn number_colour(theme: &Theme) -> Colour {
    theme.motion.mixed(theme.ink, 0.45)
}

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
struct Plan {
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
struct CornerArrow {
    pub at: Point,
    /// The direction in which to move the corner. The length of the vector is the growth of the interval per metre.
    pub effect: Vector,
    /// The number of the change, from 1; `None` if it is not one of the most effective changes.
    pub number: Option<usize>,
}

/// One of the most effective changes.
struct Numbered {
    pub number: usize,
    /// The point of the scene to which the change belongs, metres; `None` for a change of all joints.
    pub at: Option<Point>,
    /// Whether a load is moved.
    pub is_load: bool,
    /// A description of the change, and the value of the margin after it.
    pub words: String,
}

impl Plan {
    /// Writes a change of the margin with its unit.
    fn change(&self, amount: f64) -> String {
        format!("{}{}", digits(amount), self.kind.about().unit)
    }

    /// Computes the arrows and the numbered changes of a frame. Returns `None` if the derivatives of the frame's margin
    /// are not known.
    pub fn new(analysis: &Analysis, frame: usize, options: &Options) -> Option<Plan> {
        let solved @ SolvedFrame { scene, found: frame_analysis, .. } = analysis.each().nth(frame)?;
        let sensitivity = frame_analysis.sensitivity.as_ref()?;
        let (is_high, end) = sensitivity.nearest()?;
        let kind = sensitivity.kind;
        let is_narrow = options.is_column();
        let most = match (analysis.frames.len(), is_narrow) {
            (0 | 1, false) => MAX_NUMBERED.0,
            (0 | 1, true) => MAX_NUMBERED.1,
            _ => MAX_NUMBERED.2,
        };
        let mut changes = visible(solved, (kind, end, is_high), most);
        let effect = |change: &EffectiveChange| (change.after - end.value).abs();
        let least = changes.iter().map(effect).fold(0.0, f64::max) * LEAST_EFFECT;
        changes.retain(|change| effect(change) >= least);
        let step = step_length(solved);
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
        let sketch = Sketch { scene, frame_analysis, end, kind, is_high };
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
fn scale(analysis: &Analysis, unit: f64, options: &Options) -> f64 {
    let scene = analysis.given();
    let frames = 0..analysis.frames.len();
    let plans = frames.filter_map(|frame| Plan::new(analysis, frame, options));
    let strongest = plans.map(|plan| plan.strongest()).fold(0.0, f64::max);
    let placed = scene.frames.iter().flat_map(|frame| &frame.placed);
    let size = scene.bounds(placed).map_or(0.0, |b| b.width().max(b.height()));
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
    is_high: bool,
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
            Target::Load(at, direction) => {
                let done = format!("load {by} {}", words::toward(direction));
                (Some(at), done)
            }
            Target::Weight(block, is_heavier) => {
                let sign = if is_heavier { '+' } else { '−' };
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
        let after = words::value(self.kind, change.after, self.is_high);
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
