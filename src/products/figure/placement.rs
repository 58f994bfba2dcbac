//! Draws how accurately the blocks must be placed: for each block a whisker as long as its own error may be while all
//! others are in place, and behind the blocks the pattern of errors with which the structure falls, enlarged.

use super::canvas::Canvas;
use super::design::{Key, Layer, Mark};
use super::option::Options;
use super::panel::{About, Figure};
use super::placing::Label;
use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::analysis::{Analysis, Placement, Verdict};
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Outline, PagePoint, Path};
use crate::products::wording::number::{digits, round_below, three_down, three_up};
use crate::products::wording::question::{placement_length, placement_proved};
use crate::products::wording::verdict;

/// The length of the largest error of the pattern in the picture, mm.
const SHOWN_ERROR: f64 = 3.0;
/// Half the length of the stroke across the end of a whisker, mm.
const TICK: f64 = 0.55;
/// Structures of at most this many blocks state the tolerance of each block, others only of the blocks with the smallest
/// one.
const MAX_AMOUNTS: usize = 12;
/// The largest number of blocks with the smallest tolerance that state it if not all blocks do.
const MAX_LEAST_AMOUNTS: usize = 4;
/// The width of a whisker, mm.
const WIDTH: f64 = 0.3;
/// Length of a symbol in the key, mm.
const KEY_LENGTH: f64 = 4.8;

/// The figure of placement tolerances.
pub(crate) struct PlacementTolerance;

impl Figure for PlacementTolerance {
    fn about(&self) -> About {
        About {
            needs_placement: true,
            ..About::new(
                "placement",
                "How far blocks may be off their places: each one alone, and the pattern of errors with which it falls",
                "Placement tolerance of a dry-laid structure",
            )
        }
    }

    fn words(&self, analysis: &Analysis, frame: usize, _options: &Options) -> Vec<String> {
        let (scene, found) = analysis.at(frame);
        match (&found.placement, found.verdict) {
            (Some(placement), _) => sentences(scene, placement),
            (None, Verdict::Stable) => vec!["every block is in its place".into()],
            (None, Verdict::Unstable) => vec!["no error is allowed, because no forces balance the structure".into()],
            (None, Verdict::Undecided) => vec![verdict::reason(scene, found)],
        }
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        if let Some(placement) = &canvas.found().placement {
            pattern(canvas, placement);
            whiskers(canvas, placement);
        }
    }
}

/// Returns the words after the verdict.
fn sentences(scene: &Scene, placement: &Placement) -> Vec<String> {
    let stands = placement_length(scene, placement.proved, three_down);
    let falls = placement.falls_at.map(|at| match placement_length(scene, at, three_up) {
        at if at == stands => "the grey pattern falls just beyond".to_owned(),
        at => format!("the grey pattern falls at {at}"),
    });
    [Some(placement_proved(scene, placement)), falls].into_iter().flatten().collect()
}

/// Draws the outlines of the blocks with the errors of the pattern, enlarged by a round number.
fn pattern(canvas: &mut Canvas<'_>, placement: &Placement) {
    let largest = placement.pattern.iter().map(|error| error.offset.norm()).fold(0.0, f64::max);
    if largest == 0.0 {
        return;
    }
    let theme = canvas.theme();
    let factor = round_below(canvas.mm(SHOWN_ERROR) / canvas.camera.length(largest)).max(1.0);
    let stroke = canvas.dashes(theme.faint.mixed(theme.page, 0.65), 0.2, [0.9, 0.6]);
    let words = match factor {
        1.0 => "centres off with which it falls; joint ends are off too".to_owned(),
        factor => format!("centres off with which it falls, × {}; joint ends are off too", digits(factor)),
    };
    let key = Key::line(20, words, canvas.mm(KEY_LENGTH), stroke.clone());
    for error in &placement.pattern {
        let block = &canvas.scene().blocks[error.block.0];
        let corners = block.body.polygon.outline().iter().map(|corner| canvas.place(corner + error.offset * factor));
        let path = Path::stroked(Outline::ring(corners), stroke.clone());
        let title =
            format!("Block {}: off by {}", block.id, placement_length(canvas.scene(), error.offset.norm(), three_up));
        canvas.put(Mark::new(Layer::Stone, "error", vec![path]).titled(title).keyed(&key));
    }
}

/// Draws, through the centre of gravity of each block, how far it alone may be off to either side. The blocks with the
/// smallest tolerance have their number.
fn whiskers(canvas: &mut Canvas<'_>, placement: &Placement) {
    let theme = canvas.theme();
    let gravity = canvas.scene().gravity;
    let side = quarter_turn(gravity).try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0));
    let stroke = canvas.pen(theme.ink, WIDTH).mitred();
    let (long, tick) = (canvas.mm(KEY_LENGTH), canvas.mm(TICK));
    let mut sample = Key::piece(long);
    sample.extend(Outline::lines([0.0, long].map(|x| [-tick, tick].map(|y| PagePoint::new(x, y)))));
    let words = "how far one block alone may be off";
    let key = Key::new(10, words, vec![Path::stroked(sample, stroke.clone())], long);
    let is_small = placement.blocks.len() <= MAX_AMOUNTS;
    let mut stated = 0;
    let least = placement.blocks.iter().map(|own| own.proved).fold(f64::INFINITY, f64::min);
    for own in &placement.blocks {
        let block = &canvas.scene().blocks[own.block.0];
        let ends = [-1.0, 1.0].map(|sign| canvas.place(block.centroid + side * (sign * own.proved)));
        let mut whisker = Outline::line(ends);
        let (x, y) = (side.y * tick, side.x * tick);
        whisker.extend(Outline::lines(ends.map(|end| [end.moved(-x, -y), end.moved(x, y)])));
        let amount = placement_length(canvas.scene(), own.proved, three_down);
        let casing = canvas.pen(theme.page, WIDTH + 0.3);
        let shapes =
            vec![Path::stroked(whisker.clone(), casing).with_opacity(0.7), Path::stroked(whisker, stroke.clone())];
        let mark = Mark::new(Layer::Symbol, "tolerance", shapes).avoided(0.3).keyed(&key);
        canvas.put(mark.titled(format!("Block {} alone may be off by {amount}", block.id)));
        let is_least = own.proved <= least * (1.0 + 1e-3);
        if canvas.options.main_amounts && (is_small || is_least && stated < MAX_LEAST_AMOUNTS) {
            stated += 1;
            let mut label = Label::new(amount, theme.ink, ends.to_vec(), if is_least { 10 } else { 60 });
            label.bold = is_least;
            canvas.label(label);
        }
    }
}
