//! The states of the figure: most central thrust, least thrust and greatest thrust. Draws the thin lines of least and
//! greatest thrust, and writes the texts on all states.

use super::super::context::FigureContext;
use super::super::funicular::segments;
use super::super::legend::Entry;
use super::super::pen::Pen;
use super::super::words::quantity;
use super::line::colour;
use crate::analysis::{Contact, ThrustState, ThrustStates};
use crate::drawing::placement::Ink;
use crate::drawing::{Group, Item, Outline, PagePoint, Path, Stroke, Theme};
use crate::interface::ContactKind;

/// Width of the lines of least and of greatest thrust, pixels, and their dashes.
const THIN: f64 = 1.3;
const LEAST_DASHES: [f64; 2] = [7.0, 3.0];
const GREATEST_DASHES: [f64; 2] = [2.0, 2.4];

/// Formats the horizontal thrust of a state (N): `, horizontal thrust 28.3 kN`. Empty if there are several frames,
/// because their thrusts differ.
fn amount_in_words(context: &FigureContext<'_>, thrust: f64) -> String {
    if context.analysis.frames.len() == 1 {
        format!(
            ", horizontal thrust {}",
            quantity(thrust, context.analysis.scene.units.force())
        )
    } else {
        String::new()
    }
}

/// Returns the thrust states of all frames.
fn families<'c>(context: &'c FigureContext<'_>) -> impl Iterator<Item = &'c ThrustStates> {
    (0..context.analysis.frames.len()).map(|frame| context.thrust_states(frame))
}

/// Returns the part of a legend text that gives the thrust of the most central line. Returns `None` if no frame shows
/// this line.
pub(super) fn central(context: &FigureContext<'_>) -> Option<String> {
    let state = families(context).find_map(|family| family.central.as_ref())?;
    Some(amount_in_words(context, state.thrust))
}

/// Returns the legend entries for the lines of least and greatest thrust.
pub(super) fn limit_entries(context: &FigureContext<'_>) -> Vec<Entry> {
    let least = families(context).find_map(|family| family.least.as_ref());
    let greatest = families(context).find_map(|family| family.greatest.as_ref());
    let entry = |state: Option<&ThrustState>, sign: fn(PagePoint, &Theme) -> Vec<Item>, name| {
        let words = amount_in_words(context, state?.thrust);
        let words = words.replace(", horizontal thrust", "");
        Some(Entry::Sign(sign, 26.0, format!("{name}{words}")))
    };
    [
        entry(least, least_sign, "least thrust"),
        entry(greatest, greatest_sign, "greatest thrust"),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns a note that other figures show another state of the frame; `None` if no states of least thrust are known.
pub(super) fn other_figures(context: &FigureContext<'_>, frame: usize) -> Option<String> {
    let family = context.thrust_states(frame);
    family.least.as_ref()?;
    let present = quantity(family.present, context.analysis.scene.units.force());
    Some(format!(
        "other figures show the forces of least sum, with a horizontal thrust of {present}"
    ))
}

/// Returns a note that names the state shown in a frame without a family of lines. Returns `None` if the number of
/// unknowns shows that equilibrium determines all forces.
pub(super) fn one_of_many(context: &FigureContext<'_>, frame: usize) -> Option<String> {
    let (scene, found) = (&context.analysis.scene, &context.analysis.frames[frame]);
    let unknowns = |contact: &Contact| match contact.interface.kind {
        ContactKind::Corner => 2,
        _ => 3,
    };
    let contacts: usize = found.contacts.iter().map(unknowns).sum();
    let unknowns = contacts + 3 * found.robots.len();
    (unknowns > 3 * scene.frames[frame].placed.len())
        .then(|| "the line shown is that of the forces of least sum".to_owned())
}

/// Draws thin lines of least and greatest thrust.
pub(super) fn limits(pen: &Pen<'_>, family: &ThrustStates, ink: &mut Ink) -> [Group; 2] {
    let scene = &pen.context.analysis.scene;
    let states = [
        (&family.least, "thrust-least", "Least thrust", LEAST_DASHES),
        (
            &family.greatest,
            "thrust-greatest",
            "Greatest thrust",
            GREATEST_DASHES,
        ),
    ];
    states.map(|(state, class, name, dashes)| {
        let Some(state) = state else {
            return Group::default();
        };
        let mut outline = Outline::default();
        for piece in segments(scene, &scene.frames[pen.number], &state.frame) {
            let [from, to] = [piece.from, piece.to].map(|p| pen.camera.place(p));
            ink.line(from, to, THIN);
            outline.extend(Outline::line([from, to]));
        }
        let thrust = quantity(state.thrust, scene.units.force());
        let title = format!("{name}: {thrust} horizontally");
        let group = Group::with_class(class).titled(title);
        group.with(thin(outline, dashes, &pen.context.options.theme))
    })
}

fn thin(outline: Outline, dashes: [f64; 2], theme: &Theme) -> Path {
    let colour = colour(theme).mixed(theme.ink, 0.45);
    Path::stroked(outline, Stroke::new(colour, THIN).dashed(dashes))
}

fn least_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(26.0, 0.0)]);
    vec![thin(line, LEAST_DASHES, theme).into()]
}

fn greatest_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(26.0, 0.0)]);
    vec![thin(line, GREATEST_DASHES, theme).into()]
}
