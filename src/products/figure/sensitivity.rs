//! Draws how a margin changes if corners of blocks move: an arrow at a corner shows in which direction a displacement
//! of this corner enlarges the margin most.
//!
//! The arrow points in the direction in which the interval of the margin grows most. Its length is proportional to the
//! growth per metre. Corners that move together have one arrow. The most effective changes have numbers, and the legend
//! lists them. They include changes of weights, loads and friction. A corner has no arrow if the derivatives of the
//! margin are not unique there (a kink). The figure shows the end of the interval that is nearer to 0; for the load
//! factor, it shows the upper end. The options of the analysis select the margin.

mod plan;

use std::rc::Rc;

use super::about::About;
use super::arrow::MIN_VISIBLE_ARROW;
use super::canvas::Canvas;
use super::design::{ArrowSize, Key, Layer, Mark, along};
use super::option::Options;
use super::placing::Label;
use super::sheet::Figure;
use super::stage;
use super::unit::unit;
use super::words::{counted, round_below};
use crate::mechanics::analysis::{Analysis, MarginKind};
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Colour, Face, Group, Outline, PagePoint, Path, Stroke, Text, Theme, text};
use crate::products::wording::number::digits;
use crate::products::wording::sensitivity::{end_name, length, name, value, without};
use plan::{CornerArrow, Plan, scale};

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
            name: "sensitivity",
            help: "Where to move corners to make a margin larger, the ten most effective changes numbered; --margin selects the margin",
            title: "How corners change the margin of a dry-laid structure",
            needs_sensitivity: true,
            states_own_margin: true,
            ..About::default()
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
        let (limit, end) = (value(plan.kind, plan.value), end_name(plan.kind, plan.is_high));
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

    fn draw(&self, canvas: &mut Canvas<'_>) {
        stage::ground(canvas);
        stage::blocks(canvas);
        stage::held(canvas);
        stage::loads(canvas);
        if let Some(plan) = Plan::new(canvas.analysis, canvas.number, canvas.options) {
            arrows(canvas, &plan);
            rings(canvas, &plan);
            if plan.kinks > 0 {
                let corners = counted(plan.kinks, "corner");
                canvas.note(70, &format!("{corners} without an arrow, because the margin has a kink there"));
            }
        }
        stage::names(canvas);
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
        let head = (canvas.mm(3.4 * width), canvas.mm(3.4 * width).min(0.62 * length));
        ArrowSize { length, shaft: canvas.mm(width), head }
    };
    let (start, long) = (PagePoint::new(0.0, 0.0), canvas.mm(4.8));
    let key = |rank: u8, words: String, is_numbered: bool, width: f64| {
        let outline = sized(canvas, width, is_numbered).outline(start, (1.0, 0.0));
        Rc::new(Key { rank, words, symbol: vec![Path::filled(outline, colour(theme, is_numbered))], width })
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
        let per_step = format_change(plan.kind, arrow.effect.norm() * plan.step);
        let title = format!("{per_step} for {}", length(scene, plan.step));
        let key = if arrow.number.is_some() { &numbered_key } else { &plain_key };
        let mark = Mark::new(Layer::Missing, "effect", vec![path]).titled(title).keyed(key);
        canvas.put(mark.avoided(canvas.mm(0.15)));
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
        let edge = Stroke::new(number_colour(theme), canvas.mm(0.25));
        vec![Path::filled(Outline::circle(at, radius), theme.page).with_stroke(edge)]
    };
    let (small, width) = (0.6 * radius, 1.2 * radius + canvas.mm(0.3));
    let symbol = ring(PagePoint::new(small + canvas.mm(0.15), 0.0), small);
    let words = "change of a weight, load or joint, listed".into();
    let key = Rc::new(Key { rank: 13, words, symbol, width });
    let mut taken: Vec<PagePoint> = Vec::new();
    let mut drawn = Vec::new();
    for change in &plan.changes {
        let Some(place) = plan.mark(change) else { continue };
        let mut at = canvas.place(place);
        if change.is_load {
            // Leave the tip of the arrow of the load free.
            at = at.moved(1.3 * radius, -1.3 * radius);
        }
        while taken.iter().any(|other| libm::hypot(other.x - at.x, other.y - at.y) < 2.1 * radius) {
            at = at.moved(0.5 * radius, 0.0);
        }
        taken.push(at);
        drawn.push((at, ring(at, radius), change));
    }
    for (at, shapes, change) in drawn {
        let mark = Mark::new(Layer::Missing, "change", shapes).titled(format!("{}: {}", change.number, change.words));
        canvas.put(mark.keyed(&key).avoided(canvas.mm(0.2)));
        let label = Label::new(change.number.to_string(), number_colour(theme), vec![at], 0);
        canvas.label(Label { bold: true, fixed: Some(at), ..label });
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
    let change = format_change(plan.kind, amount);
    let change = match (plan.kind, plan.is_high) {
        (MarginKind::Tilt | MarginKind::HorizontalLoad, is_high) => {
            let side = end_name(plan.kind, is_high);
            format!("{name} {change} farther to the {side}")
        }
        (_, true) => format!("{name} +{change}"),
        (_, false) => format!("{name} −{change}"),
    };
    (amount > 0.0 && drawn.is_finite()).then(|| (drawn, format!("{change} for {}", length(scene, plan.step))))
}

/// Formats a change of a margin. A change of a tilt is followed by the degree sign.
fn format_change(kind: MarginKind, amount: f64) -> String {
    match kind {
        MarginKind::Tilt => format!("{}°", digits(amount)),
        _ => digits(amount),
    }
}

fn colour(theme: &Theme, is_numbered: bool) -> Colour {
    if is_numbered { theme.motion.mixed(theme.ink, 0.15) } else { theme.motion.mixed(theme.page, 0.4) }
}

fn number_colour(theme: &Theme) -> Colour {
    theme.motion.mixed(theme.ink, 0.45)
}
