//! Draws how a margin changes if corners of blocks move: an arrow at a corner shows in which direction a displacement
//! of this corner enlarges the margin most.
//!
//! The arrow points in the direction in which the interval of the margin grows most. Its length is proportional to the
//! growth per metre. Corners that move together have one arrow. The most effective changes have numbers, and the legend
//! lists them. They include changes of weights, loads and friction. A corner has no arrow if the derivatives of the
//! margin are not unique there (a kink). The figure shows the end of the interval that is nearer to 0; for the load
//! factor, it shows the upper end. The options of the analysis select the margin.

mod plan;

use super::arrow::{ForceArrow, MIN_VISIBLE_ARROW, Marks};
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::label::{self, Callout};
use super::legend::{self, Entry};
use super::panel::composed_with;
use super::pen::Pen;
use super::words::{counted, round_below};
use crate::geometry::Bounds;
use crate::mechanics::analysis::MarginKind;
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{
    Anchor, Colour, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme, text,
};
use crate::products::wording::number::digits;
use crate::products::wording::sensitivity::{end_name, length, name, value, without};
use plan::{CornerArrow, Plan, scale};

/// Radius of the disc around the number of a change without an arrow, as a multiple of the font size.
const DISC_RADIUS: f64 = 0.68;
/// Largest length of the arrow that shows the scale, pixels.
const MAX_SCALE_ARROW: f64 = 60.0;

/// The figure that shows how corners of blocks affect a margin.
pub(crate) struct CornerEffects;

impl PanelContent for CornerEffects {
    fn about(&self) -> About {
        About {
            name: "sensitivity",
            help: "Where to move corners to make a margin larger, the ten most effective changes numbered; --margin selects the margin",
            title: "How corners change the margin of a dry-laid structure",
            needs_sensitivity: true,
            lines_cross_names: true,
            ..About::default()
        }
    }

    fn extent(&self, of: FrameSource<'_>, unit: f64, _marks: &Marks) -> Option<Bounds> {
        let plan = Plan::new(of.analysis, of.frame, of.options)?;
        let arrows = plan.bounds(scale(of.analysis, unit, of.options))?;
        Some(arrows.grown(0.2 * unit))
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let mut ink = label::ink(pen);
        let mut callouts = Vec::new();
        let mut parts = vec![pen.arrows(false)];
        if let Some(plan) = Plan::new(pen.context.analysis, pen.number, pen.context.options) {
            parts.push(arrows(pen, &plan, &mut ink, &mut callouts));
            parts.push(discs(pen, &plan, &mut ink));
        }
        composed_with(pen, view, pen.blocks(), parts, callouts, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let analysis = context.analysis;
        let frames = 0..analysis.frames.len();
        let plans = frames.filter_map(|f| Plan::new(analysis, f, context.options));
        let plans: Vec<Plan> = plans.collect();
        let mut entries = Vec::new();
        if plans.iter().any(|plan| !plan.arrows.is_empty()) {
            let words = "direction in which to move a corner; the length shows the effect";
            entries.push(Entry::Symbol(arrow_symbol, 26.0, words.into()));
        }
        let strongest = |a: &&Plan, b: &&Plan| a.strongest().total_cmp(&b.strongest());
        if let Some(plan) = plans.iter().max_by(strongest) {
            let pixels = scale(analysis, context.unit, context.options) * unit / context.unit;
            entries.extend(scale_entry(&analysis.scene, plan, pixels));
        }
        if plans.iter().any(|plan| plan.arrows.iter().any(|a| a.number.is_some())) {
            let words = "one of the most effective moves; the text below states the estimated new margin";
            entries.push(Entry::Symbol(numbered_symbol, 26.0, words.into()));
        }
        if plans.iter().any(Plan::has_marks) {
            let words = "change of a weight, load or joint; the text below states the estimated new margin";
            let wide = 1.6 * disc_radius(&context.options.theme);
            entries.push(Entry::Symbol(disc_symbol, wide, words.into()));
        }
        entries.extend(legend::loads(context));
        entries.extend(legend::robots(context));
        let kinks = plans.iter().map(|plan| plan.kinks).sum();
        if kinks > 0 {
            let corners = counted(kinks, "corner");
            entries.push(Entry::Note(format!("{corners} without an arrow, because the margin has a kink there")));
        }
        if let [only] = &plans[..]
            && analysis.frames.len() == 1
        {
            entries.extend(list(only, &context.options.theme));
        }
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let frame_analysis = &context.analysis.frames[frame];
        let Some(sensitivity) = &frame_analysis.sensitivity else {
            return "the sensitivity of its margins was not computed".into();
        };
        if let Some(reason) = sensitivity.reason() {
            return without(sensitivity.kind, reason);
        }
        let Some(plan) = Plan::new(context.analysis, frame, context.options) else {
            return String::new();
        };
        let end = end_name(plan.kind, plan.is_high);
        let stated = format!(
            "limit: {} {} ({end} end of the interval in which the frame stands)",
            name(plan.kind, plan.is_high),
            value(plan.kind, plan.value)
        );
        if plan.arrows.is_empty() && plan.changes.is_empty() {
            return match plan.kinks {
                0 => format!("{stated}; no single corner makes it visibly better"),
                _ => format!("{stated}; it is at a kink, where corners have no unique derivatives"),
            };
        }
        if context.analysis.frames.len() == 1 {
            return stated;
        }
        let changes = plan.changes.iter();
        let changes = changes.map(|c| format!("{}: {}", c.number, c.words));
        [stated].into_iter().chain(changes).collect::<Vec<_>>().join("; ")
    }
}

/// Draws the arrows at the corners. The numbered arrows, which have the largest effects, are drawn last, so that no
/// other arrow covers them.
fn arrows(pen: &Pen<'_>, plan: &Plan, ink: &mut Ink, callouts: &mut Vec<Callout>) -> Group {
    let (context, theme) = (pen.context, &pen.context.options.theme);
    let scale = scale(context.analysis, context.unit, context.options);
    let mut group = Group::with_class("effects").titled("Where to move corners");
    let mut order: Vec<&CornerArrow> = plan.arrows.iter().collect();
    order.sort_by_key(|arrow| std::cmp::Reverse(arrow.number.unwrap_or(usize::MAX)));
    for arrow in order {
        let from = pen.camera.place(arrow.at);
        let along = pen.camera.turn(arrow.effect * scale);
        let long = libm::hypot(along.0, along.1);
        if long < MIN_VISIBLE_ARROW && arrow.number.is_none() {
            continue;
        }
        let width = width(pen.unit(), arrow.number.is_some());
        ink.arrow(from, along, width);
        let outline = straight(from, along, width);
        let casing = Stroke::new(theme.page, 1.6);
        let per_step = format_change(plan.kind, arrow.effect.norm() * plan.step);
        let title = format!("{per_step} for {}", length(&context.analysis.scene, plan.step));
        let one = Group::with_class("effect").titled(title);
        let casing = Path::stroked(outline.clone(), casing).with_opacity(0.85);
        let fill = Path::filled(outline, colour(theme, arrow.number.is_some()));
        group.items.push(one.with(casing).with(fill).into());
        if let Some(number) = arrow.number {
            let ahead = 2.0 / long.max(MIN_VISIBLE_ARROW);
            callouts.push(Callout {
                at: from.moved((1.0 + ahead) * along.0, (1.0 + ahead) * along.1),
                clear: 2.5,
                words: number.to_string(),
                colour: number_colour(theme),
            });
        }
    }
    callouts.sort_by_key(|callout| callout.words.parse::<usize>().unwrap_or(usize::MAX));
    group
}

/// Draws a disc with a number for each numbered change that has a position but no arrow, such as changes of weights,
/// loads and the friction of one joint.
fn discs(pen: &Pen<'_>, plan: &Plan, ink: &mut Ink) -> Group {
    let theme = &pen.context.options.theme;
    let radius = disc_radius(theme);
    let mut group = Group::with_class("changes");
    let loads = &pen.context.marks[pen.number].arrows;
    let scale = scale(pen.context.analysis, pen.context.unit, pen.context.options);
    // A number without an empty position may cover other shapes, but not the arrows in `marks`.
    let mut marks = Ink::default();
    for load in loads {
        let (from, along) = (pen.camera.place(load.at), pen.camera.turn(load.vector));
        marks.arrow(from, along, pen.width(load));
    }
    for arrow in plan.arrows.iter().filter(|arrow| arrow.number.is_some()) {
        let along = arrow.effect * scale;
        marks.arrow(pen.camera.place(arrow.at), pen.camera.turn(along), 2.0);
    }
    for change in &plan.changes {
        let Some(at) = plan.mark(change) else {
            continue;
        };
        // The number of a moved load is at the tail of the arrow of this load.
        let near = 1e-6 * pen.context.unit;
        let ends_here = |arrow: &&ForceArrow| (arrow.at + arrow.vector - at).norm() < near;
        let load_arrow = (loads.iter()).find(|arrow| change.is_load && ends_here(arrow));
        let preferred = match load_arrow {
            Some(arrow) => {
                let (x, y) = pen.camera.turn(arrow.vector);
                let share = (radius + 1.5) / libm::hypot(x, y).max(f64::MIN_POSITIVE);
                pen.camera.place(arrow.at).moved(-share * x, -share * y)
            }
            None => pen.camera.place(at),
        };
        // The number of a change of friction is drawn on its joint, so it may cover other shapes.
        let near = nearest_free_position(ink, preferred, radius, 1.2).filter(|_| !change.is_joint);
        let at = near.or_else(|| nearest_free_position(&marks, preferred, radius, 3.0));
        let at = at.unwrap_or(preferred);
        ink.disc(at, radius + 1.0);
        marks.disc(at, radius + 1.0);
        let title = format!("{}: {}", change.number, change.words);
        let disc = Group::with_class("change").titled(title);
        let disc = disc.with(numbered(at, change.number, theme));
        group.items.push(disc.into());
    }
    group
}

/// Returns the candidate nearest to `preferred` at which the square around a disc covers nothing in `ink`. The
/// candidates lie on circles around `preferred`, up to `most` times `radius` away. Returns `None` if no candidate is
/// free.
fn nearest_free_position(ink: &Ink, preferred: PagePoint, radius: f64, most: f64) -> Option<PagePoint> {
    let side = 2.0 * radius;
    let is_free =
        |centre: &PagePoint| ink.clear(PageRect { at: centre.moved(-radius, -radius), width: side, height: side });
    // Candidates lie on circles around `preferred`, twelve on each circle. The radii of the circles are multiples of a
    // fifth of the disc's radius.
    let place = |k: usize| {
        let far = 0.2 * radius * k.div_ceil(12) as f64;
        let (sin, cos) = libm::sincos(k as f64 * std::f64::consts::TAU / 12.0);
        preferred.moved(far * cos, far * sin)
    };
    let last = (12.0 * most / 0.2).round() as usize;
    (0..=last).map(place).find(is_free)
}

/// Returns the legend entries of the numbered list of changes.
fn list(plan: &Plan, theme: &Theme) -> Vec<Entry> {
    let size = theme.sizes.key;
    let widths = plan.changes.iter();
    let widths = widths.map(|change| text::width(&change.words, Face::Sans, size));
    let column = widths.fold(0.0, f64::max) + 1.9 * size;
    let entry = |change: &plan::Numbered| {
        let colour = number_colour(theme);
        Entry::Numbered(change.number, colour, change.words.clone(), column)
    };
    plan.changes.iter().map(entry).collect()
}

/// Returns the legend entry for the scale of the arrows; `None` if there are no arrows. `pixels` is the length, in
/// pixels, of an arrow that shows a growth of the margin of 1 per metre.
fn scale_entry(scene: &Scene, plan: &Plan, pixels: f64) -> Option<Entry> {
    // The sample arrow is not longer than the longest arrow of the figure.
    let longest = plan.strongest() * pixels;
    let amount = round_below(longest.min(MAX_SCALE_ARROW) / pixels * plan.step);
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
    let words = format!("{change} for {}", length(scene, plan.step));
    (amount > 0.0 && drawn.is_finite()).then_some(Entry::Scale(drawn, 2.0, words))
}

/// Formats a change of a margin. A change of a tilt is followed by the degree sign.
fn format_change(kind: MarginKind, amount: f64) -> String {
    match kind {
        MarginKind::Tilt => format!("{}°", digits(amount)),
        _ => digits(amount),
    }
}

/// Returns the width of the shaft of a corner's arrow, in pixels. `unit` is the unit length in pixels.
fn width(unit: f64, is_numbered: bool) -> f64 {
    let width = (0.045 * unit).clamp(1.4, 2.6);
    match is_numbered {
        true => 1.25 * width,
        false => 0.8 * width,
    }
}

fn colour(theme: &Theme, is_numbered: bool) -> Colour {
    match is_numbered {
        true => theme.motion.mixed(theme.ink, 0.15),
        false => theme.motion.mixed(theme.page, 0.4),
    }
}

fn number_colour(theme: &Theme) -> Colour {
    theme.motion.mixed(theme.ink, 0.45)
}

fn disc_radius(theme: &Theme) -> f64 {
    DISC_RADIUS * theme.sizes.amount
}

/// Draws a disc with the number of a change.
fn numbered(at: PagePoint, number: usize, theme: &Theme) -> Group {
    let size = 0.92 * theme.sizes.amount;
    let disc = Path::filled(Outline::circle(at, disc_radius(theme)), number_colour(theme));
    let at = at.moved(0.0, 0.36 * size);
    let words = Text::new(at, number.to_string(), Face::SansBold, size, theme.page);
    Group::default().with(disc).with(words.anchored(Anchor::Middle))
}

fn arrow_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![Path::filled(straight(at, (26.0, 0.0), 2.0), colour(theme, false)).into()]
}

fn numbered_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![Path::filled(straight(at, (26.0, 0.0), 3.0), colour(theme, true)).into()]
}

fn disc_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let radius = 0.8 * disc_radius(theme);
    let disc = Outline::circle(at.moved(radius, 0.0), radius);
    vec![Path::filled(disc, number_colour(theme)).into()]
}
