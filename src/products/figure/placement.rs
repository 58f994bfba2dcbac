//! Draws how accurately the blocks must be placed: for each block a whisker as long as its own error may be while all
//! others are in place, and behind the blocks the pattern of errors with which the structure falls, enlarged.

use std::rc::Rc;

use super::about::About;
use super::canvas::Canvas;
use super::design::{Key, Layer, Mark};
use super::option::Options;
use super::panel::Figure;
use super::placing::Label;
use super::stage;
use super::verdict;
use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::analysis::{Analysis, Placement, Verdict};
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Outline, PagePoint, Path, Stroke};
use crate::products::wording::number::{digits, round_below, three_down, three_up};
use crate::products::wording::placement::{length, proved};

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
            name: "placement",
            help: "How far blocks may be off their places: each one alone, and the pattern of errors with which it falls",
            title: "Placement tolerance of a dry-laid structure",
            needs_placement: true,
            states_own_margin: true,
            ..About::default()
        }
    }

    fn words(&self, analysis: &Analysis, frame: usize, _options: &Options) -> Vec<String> {
        let (scene, found) = (analysis.scene_of(frame), &analysis.frames[frame]);
        match (&found.placement, found.verdict) {
            (Some(placement), _) => sentences(scene, placement),
            (None, Verdict::Stable) => vec!["every block is in its place".into()],
            (None, Verdict::Unstable) => vec!["no error is allowed, because no forces balance the structure".into()],
            (None, Verdict::Undecided) => vec![verdict::reason(scene, found)],
        }
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        stage::ground(canvas);
        stage::blocks(canvas);
        if let Some(placement) = &canvas.found().placement {
            pattern(canvas, placement);
            whiskers(canvas, placement);
        }
        stage::held(canvas);
        stage::loads(canvas);
        stage::names(canvas);
    }
}

/// Returns the words after the verdict.
fn sentences(scene: &Scene, placement: &Placement) -> Vec<String> {
    let stands = length(scene, placement.proved, three_down);
    let falls = placement.falls_at.map(|at| match length(scene, at, three_up) {
        at if at == stands => "the grey pattern falls just beyond".to_owned(),
        at => format!("the grey pattern falls at {at}"),
    });
    [Some(proved(scene, placement)), falls].into_iter().flatten().collect()
}

/// Draws the outlines of the blocks with the errors of the pattern, enlarged by a round number.
fn pattern(canvas: &mut Canvas<'_>, placement: &Placement) {
    let largest = placement.pattern.iter().map(|error| error.offset.norm()).fold(0.0, f64::max);
    if largest == 0.0 {
        return;
    }
    let theme = canvas.theme();
    let factor = round_below(canvas.mm(SHOWN_ERROR) / canvas.camera.length(largest)).max(1.0);
    let stroke =
        Stroke::new(theme.faint.mixed(theme.page, 0.65), canvas.mm(0.2)).dashed([canvas.mm(0.9), canvas.mm(0.6)]);
    let (start, long) = (PagePoint::new(0.0, 0.0), canvas.mm(KEY_LENGTH));
    let words = match factor {
        1.0 => "centres off with which it falls; joint ends are off too".to_owned(),
        factor => format!("centres off with which it falls, × {}; joint ends are off too", digits(factor)),
    };
    let symbol = vec![Path::stroked(Outline::line([start, start.moved(long, 0.0)]), stroke.clone())];
    let key = Rc::new(Key { rank: 20, words, symbol, width: long });
    for error in &placement.pattern {
        let block = &canvas.scene().blocks[error.block.0];
        let corners = block.body.polygon.outline().iter().map(|corner| canvas.place(corner + error.offset * factor));
        let path = Path::stroked(Outline::ring(corners), stroke.clone());
        let title = format!("Block {}: off by {}", block.id, length(canvas.scene(), error.offset.norm(), three_up));
        canvas.put(Mark::new(Layer::Stone, "error", vec![path]).titled(title).keyed(&key));
    }
}

/// Draws, through the centre of gravity of each block, how far it alone may be off to either side. The blocks with the
/// smallest tolerance have their number.
fn whiskers(canvas: &mut Canvas<'_>, placement: &Placement) {
    let theme = canvas.theme();
    let gravity = canvas.scene().gravity;
    let side = quarter_turn(gravity).try_normalize(0.0).unwrap_or(Vector::new(1.0, 0.0));
    let stroke = Stroke::new(theme.ink, canvas.mm(WIDTH)).mitred();
    let (start, long, tick) = (PagePoint::new(0.0, canvas.mm(0.0)), canvas.mm(KEY_LENGTH), canvas.mm(TICK));
    let mut sample = Outline::line([start, start.moved(long, 0.0)]);
    for x in [0.0, long] {
        sample.extend(Outline::line([start.moved(x, -tick), start.moved(x, tick)]));
    }
    let words = "how far one block alone may be off".to_owned();
    let key = Rc::new(Key { rank: 10, words, symbol: vec![Path::stroked(sample, stroke.clone())], width: long });
    let is_small = placement.blocks.len() <= MAX_AMOUNTS;
    let mut stated = 0;
    let least = placement.blocks.iter().map(|own| own.proved).fold(f64::INFINITY, f64::min);
    for own in &placement.blocks {
        let block = &canvas.scene().blocks[own.block.0];
        let ends = [-1.0, 1.0].map(|sign| canvas.place(block.centroid + side * (sign * own.proved)));
        let mut whisker = Outline::line(ends);
        for end in ends {
            let (x, y) = (side.y * tick, side.x * tick);
            whisker.extend(Outline::line([end.moved(-x, -y), end.moved(x, y)]));
        }
        let amount = length(canvas.scene(), own.proved, three_down);
        let casing = Stroke::new(theme.page, canvas.mm(WIDTH + 0.3));
        let shapes =
            vec![Path::stroked(whisker.clone(), casing).with_opacity(0.7), Path::stroked(whisker, stroke.clone())];
        let mark = Mark::new(Layer::Symbol, "tolerance", shapes).avoided(canvas.mm(0.3)).keyed(&key);
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
