//! Draws the thin lines of least and of greatest thrust, and writes the texts about these two states and the most
//! central state.

use super::super::context::FigureContext;
use super::super::funicular::segments;
use super::super::legend::Entry;
use super::super::pen::Pen;
use super::super::words::quantity;
use super::chain::chains;
use super::line::colour;
use crate::mechanics::analysis::{Contact, ThrustState, ThrustStates, Verdict};
use crate::mechanics::statics::interface::ContactKind;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Group, Item, Outline, PagePoint, Path, Stroke, Theme};

/// Width of the lines of least and of greatest thrust, pixels, and their dashes.
const LINE_WIDTH: f64 = 1.3;
const LEAST_DASHES: [f64; 2] = [7.0, 3.0];
const GREATEST_DASHES: [f64; 2] = [2.0, 2.4];

/// Formats the horizontal thrust of a state for the legend: `H = 28.3 kN`, or `H = 12.1 kN, 5.08 kN at the supports` if
/// loads act sideways between crown and supports. The text is empty if there are several frames, because their thrusts
/// differ.
fn amount_in_words(context: &FigureContext<'_>, state: &ThrustState) -> String {
    let scene = &context.analysis.scene;
    let [frame] = &scene.frames[..] else {
        return String::new();
    };
    let amount = |newtons: f64| quantity(newtons, scene.units.force());
    let supports = amount(state.thrust);
    match chains(scene, frame, &state.frame).first().map(|chain| amount(chain.crown_thrust)) {
        Some(crown) if crown != supports => format!("H = {crown}, {supports} at the supports"),
        Some(crown) => format!("H = {crown}"),
        None => format!("thrust of {supports} at the supports"),
    }
}

/// Returns the thrust states (least, greatest and most central) of each frame.
fn thrust_states_of_frames<'c>(context: &'c FigureContext<'_>) -> impl Iterator<Item = &'c ThrustStates> {
    (0..context.analysis.frames.len()).map(|frame| context.thrust_states(frame))
}

/// Returns the part of the legend text that states the horizontal thrust of the most central line; it is empty if there
/// are several frames. Returns `None` if no frame shows this line.
pub(super) fn central_thrust_text(context: &FigureContext<'_>) -> Option<String> {
    let state = thrust_states_of_frames(context).find_map(|family| family.central.as_ref())?;
    Some(amount_in_words(context, state))
}

/// Returns the legend entries for the lines of least and greatest thrust.
pub(super) fn limit_entries(context: &FigureContext<'_>) -> Vec<Entry> {
    let least = thrust_states_of_frames(context).find_map(|family| family.least.as_ref());
    let greatest = thrust_states_of_frames(context).find_map(|family| family.greatest.as_ref());
    let entry = |state: Option<&ThrustState>, symbol: fn(PagePoint, &Theme) -> Vec<Item>, name: &str| {
        let parts = [name.to_owned(), amount_in_words(context, state?)].into_iter().filter(|part| !part.is_empty());
        Some(Entry::Symbol(symbol, 26.0, parts.collect::<Vec<_>>().join(": ")))
    };
    [entry(least, least_symbol, "least thrust"), entry(greatest, greatest_symbol, "greatest thrust")]
        .into_iter()
        .flatten()
        .collect()
}

/// Returns a note for the reader that other figures show a different equilibrium of the frame. Returns `None` if this
/// figure shows the same equilibrium as others, because the most central forces are not known.
pub(super) fn other_figures_note(context: &FigureContext<'_>, frame: usize) -> Option<String> {
    let family = context.thrust_states(frame);
    family.central.as_ref()?;
    let present = quantity(family.present, context.analysis.scene.units.force());
    Some(format!("other figures show the forces of least sum, with a thrust of {present} at the supports"))
}

/// Returns a note for the reader about a frame whose line of thrust is one of many possible lines. The caller uses it
/// if the most central forces of the frame are not known. Returns `None` if there is only one line. Also returns `None`
/// if the legend explains which line is shown and the frame has at most two supports.
pub(super) fn uniqueness_note(context: &FigureContext<'_>, frame: usize) -> Option<&'static str> {
    let several_supports = context.thrust_states(frame).supports > 2;
    match (central_thrust_text(context), several_supports) {
        _ if !has_many_lines(context, frame) => None,
        // In this figure, the legend only explains the most central line, which another frame shows.
        (Some(_), _) => Some("the line shown belongs to the forces of least sum"),
        (None, true) => Some("more than two supports: no single horizontal thrust"),
        (None, false) => None,
    }
}

/// True if the line of thrust of a frame that stands is one of many possible lines, because there are more unknown
/// forces than equations of equilibrium.
pub(super) fn has_many_lines(context: &FigureContext<'_>, frame: usize) -> bool {
    let (scene, frame_analysis) = (&context.analysis.scene, &context.analysis.frames[frame]);
    let unknowns = |contact: &Contact| match contact.interface.kind {
        ContactKind::Corner => 2,
        _ => 3,
    };
    let contacts: usize = frame_analysis.contacts.iter().map(unknowns).sum();
    let unknowns = contacts + 3 * frame_analysis.robots.len();
    frame_analysis.verdict == Verdict::Stable && unknowns > 3 * scene.frames[frame].placed.len()
}

/// Draws the thin lines of least and of greatest thrust, and adds them to `ink`. A line whose state is not known is
/// left out.
pub(super) fn limits(pen: &Pen<'_>, family: &ThrustStates, ink: &mut Ink) -> [Group; 2] {
    let scene = &pen.context.analysis.scene;
    let states = [
        (&family.least, "thrust-least", "Least thrust", LEAST_DASHES),
        (&family.greatest, "thrust-greatest", "Greatest thrust", GREATEST_DASHES),
    ];
    states.map(|(state, class, name, dashes)| {
        let Some(state) = state else {
            return Group::default();
        };
        let mut outline = Outline::default();
        for piece in segments(scene, &scene.frames[pen.number], &state.frame) {
            let [from, to] = [piece.from, piece.to].map(|p| pen.camera.place(p));
            ink.line(from, to, LINE_WIDTH);
            outline.extend(Outline::line([from, to]));
        }
        let thrust = quantity(state.thrust, scene.units.force());
        let title = format!("{name}: {thrust} horizontally at the supports");
        let group = Group::with_class(class).titled(title);
        group.with(thin(outline, dashes, &pen.context.options.theme))
    })
}

fn thin(outline: Outline, dashes: [f64; 2], theme: &Theme) -> Path {
    let colour = colour(theme).mixed(theme.ink, 0.45);
    Path::stroked(outline, Stroke::new(colour, LINE_WIDTH).dashed(dashes))
}

fn least_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(26.0, 0.0)]);
    vec![thin(line, LEAST_DASHES, theme).into()]
}

fn greatest_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(26.0, 0.0)]);
    vec![thin(line, GREATEST_DASHES, theme).into()]
}
