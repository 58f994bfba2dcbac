//! A vehicle on a structure: the largest load factor for each position of its first axle as a curve above the structure, the
//! vehicle at the governing position, and how the structure would begin to fall there.
//!
//! In an animation the vehicle drives over the structure: progress below 1 of the motion shows one of the positions, and
//! progress 1 the governing one.

use crate::geometry::quarter_turn;
use crate::mechanics::analysis::{Analysis, Influence, SolvedFrame, VehiclePosition};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::{Drawing, Face, Outline, PagePoint, Path, text};
use crate::products::figure::canvas::Canvas;
use crate::products::figure::design::{ArrowSize, Key, Layer, Mark};
use crate::products::figure::load::{hollow, load_size};
use crate::products::figure::option::Options;
use crate::products::figure::placing::Label;
use crate::products::figure::sheet;
use crate::products::wording::number::{digits, three_down};
use crate::products::wording::question::{vehicle_factor, vehicle_position};

use super::Mechanism;

/// The height of the curve, and its distance from the vehicle, mm.
const HEIGHT: f64 = 16.0;
const CHART_GAP: f64 = 3.0;
/// The length of the arrow of the heaviest axle, mm.
const AXLE: f64 = 7.0;
/// The curve ends at least at this multiple of the least factor; larger factors are cut off.
const MOST: f64 = 2.0;
/// The least distance of two numbers of the axis, in font sizes.
const APART: f64 = 1.3;
/// The largest number of positions in an animation, and how long it shows the governing one, s.
const MAX_STOPS: usize = 60;
const GOVERNING_SECONDS: f64 = 2.0;

/// States what the structure carries with the vehicle at the position that is shown.
pub(super) fn words(analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
    let SolvedFrame { scene, found, .. } = analysis.at(frame);
    let Some(influence) = &found.vehicle else { return Vec::new() };
    let Some(own) = shown(influence, options.motion_progress) else {
        return vec![vehicle_factor(scene, influence)];
    };
    let times = own.factor.map_or("any multiple of".to_owned(), |factor| three_down(factor) + " ×");
    let words = format!("carries {times} the vehicle, {}", vehicle_position(scene, own));
    let alone = found.under_vehicle.map(|under| format!("{} without the vehicle", under.alone.verb()));
    [words].into_iter().chain(alone).collect()
}

pub(super) fn draw(canvas: &mut Canvas<'_>) {
    if let Some(influence) = &canvas.found().vehicle {
        let position = shown(influence, canvas.options.motion_progress);
        vehicle(canvas, position);
        curve(canvas, influence, position);
    }
}

/// Returns the position that is drawn: the governing one at the end of the motion.
fn shown(influence: &Influence, progress: f64) -> Option<&VehiclePosition> {
    if progress >= 1.0 {
        return influence.positions.get(influence.governing?);
    }
    influence.positions.get((progress * influence.positions.len() as f64) as usize)
}

/// Draws the axles of the vehicle at a position.
fn vehicle(canvas: &mut Canvas<'_>, position: Option<&VehiclePosition>) {
    let (Some(vehicle), Some(position)) = (canvas.scene().vehicle(), position) else { return };
    let heaviest = vehicle.axles.iter().map(|axle| axle.weight).fold(0.0, f64::max);
    let (ink, down) = (canvas.theme().load, canvas.scene().down());
    let down = (down.x, -down.y);
    let start = PagePoint::new(0.0, 0.0);
    let sample = ArrowSize { length: canvas.mm(5.0), ..load_size(canvas) };
    let symbol = vec![hollow(canvas, sample.outline(start, (1.0, 0.0)), ink)];
    let key = Key::new(13, "axles of the vehicle", symbol, canvas.mm(5.5));
    for (number, block, at) in &position.axles {
        let weight = vehicle.axles[*number].weight;
        let length = canvas.mm(AXLE) * weight / heaviest.max(f64::MIN_POSITIVE);
        if length < canvas.mm(0.5) {
            continue;
        }
        let tip = canvas.place_on(BodyId::Block(*block), *at);
        let from = tip.moved(-down.0 * length, -down.1 * length);
        let size = ArrowSize { length, ..load_size(canvas) };
        let size = ArrowSize { head: (size.head.0, size.head.1.min(0.6 * length)), ..size };
        let words = canvas.newtons(weight);
        let mark = Mark::new(Layer::Load, "axle", vec![hollow(canvas, size.outline(from, down), ink)]).keyed(&key);
        canvas.put(mark.titled(format!("Axle {}: {words}", number + 1)).avoided(0.2));
        if canvas.options.main_amounts {
            canvas.label(Label::new(words, ink, vec![from], 20));
        }
    }
}

/// Returns the numbers of an axis from 0 to at least `least`: 0, a step, … The step is 1, 2 or 5 times a power of ten.
fn tick_values(least: f64, most_steps: f64) -> Vec<f64> {
    let mut step = 1.0;
    while least / step > most_steps {
        let tens = libm::pow(10.0, libm::floor(libm::log10(step)));
        step = if step < 1.5 * tens {
            2.0 * tens
        } else if step < 3.0 * tens {
            5.0 * tens
        } else {
            10.0 * tens
        };
    }
    (0..=(least / step).ceil() as usize).map(|number| number as f64 * step).collect()
}

/// Draws the curve above everything else, with its axis and the position that is shown.
fn curve(canvas: &mut Canvas<'_>, influence: &Influence, position: Option<&VehiclePosition>) {
    let Some(least) = influence.governing.and_then(|number| influence.positions[number].factor) else { return };
    let theme = canvas.theme();
    let across = quarter_turn(canvas.scene().down());
    let camera = canvas.camera;
    let x = |at: f64| camera.place((across * at).into()).x;
    let size = canvas.label_size();
    // The height of the axles is reserved, so that the curve does not move in an animation.
    let base = canvas.structure.at.y.min(canvas.extent().at.y + canvas.mm(AXLE)) - canvas.mm(AXLE + CHART_GAP) - size;
    let height = canvas.mm(HEIGHT);
    let mut ticks = tick_values((MOST * least).max(1.5), height / (APART * size));
    let top = ticks.last().copied().unwrap_or(1.0);
    if !ticks.contains(&1.0) {
        // The numbers beside 1 give way to it.
        ticks.retain(|tick| height * (tick - 1.0).abs() > APART * size * top);
        ticks.push(1.0);
    }
    let y = move |factor: f64| base - height * factor / top;
    let (left, right) = (canvas.structure.at.x, canvas.structure.at.x + canvas.structure.width);
    // While only the last axles are on the structure, the first one is beyond it.
    let is_over = |own: &VehiclePosition| (left - 1e-3..=right + 1e-3).contains(&x(own.at));
    let level = |factor: f64| Outline::line([PagePoint::new(left, y(factor)), PagePoint::new(right, y(factor))]);
    for tick in ticks {
        let stroke = match tick {
            1.0 => canvas.dashes(theme.ink, 0.2, [0.9, 0.6]),
            0.0 => canvas.pen(theme.faint, 0.2),
            _ => canvas.pen(theme.faint.mixed(theme.page, 0.7), 0.12),
        };
        canvas.put(Mark::new(Layer::Ground, "axis", vec![Path::stroked(level(tick), stroke)]).avoided(0.0));
        let number = digits(tick);
        let wide = text::width(&number, Face::Sans, size);
        let beside = PagePoint::new(left - canvas.mm(0.8) - wide / 2.0, y(tick));
        canvas.label(Label::at(beside, number, theme.faint, 1));
    }
    let name = "load factor, over the place of the first axle";
    let middle = PagePoint::new(left + text::width(name, Face::Sans, size) / 2.0, y(top) - 0.9 * size);
    canvas.label(Label::at(middle, name.to_owned(), theme.faint, 1));
    let long = canvas.mm(4.8);
    for (to_right, words) in [(true, "load factor"), (false, "the same, travelling to the left")] {
        let own = influence.positions.iter().filter(|own| own.to_right == to_right && is_over(own));
        let points: Vec<(f64, f64)> =
            own.map(|own| (x(own.at), own.factor.unwrap_or(f64::INFINITY).min(2.0 * top))).collect();
        let mut outline = Outline::default();
        for run in below(&points, top) {
            outline.extend(Outline::line(run.into_iter().map(|(x, factor)| PagePoint::new(x, y(factor)))));
        }
        if outline.segments.is_empty() {
            continue;
        }
        let mut stroke = canvas.pen(theme.ink, 0.35);
        if !to_right {
            stroke = stroke.dashed([canvas.mm(1.0), canvas.mm(0.7)]);
        }
        let key = Key::line(if to_right { 14 } else { 15 }, words, long, stroke.clone());
        let path = Path::stroked(outline, stroke);
        let mark = Mark::new(Layer::Symbol, "influence", vec![path]).avoided(0.2);
        canvas.put(if to_right { mark } else { mark.keyed(&key) });
    }
    if let Some(position) = position.filter(|own| is_over(own)) {
        let factor = position.factor.filter(|factor| *factor <= top);
        let at = PagePoint::new(x(position.at), y(factor.unwrap_or(top)));
        let foot = PagePoint::new(at.x, base + canvas.mm(CHART_GAP));
        let drop = Path::stroked(Outline::line([at, foot]), canvas.dashes(theme.failure, 0.2, [0.7, 0.5]));
        let dot = canvas.disc(at, 0.8, theme.failure);
        let words = position.factor.map_or("no limit".to_owned(), three_down);
        let mark = Mark::new(Layer::Symbol, "governing", vec![drop, dot]).titled(words.clone()).avoided(0.2);
        canvas.put(mark);
        canvas.label(Label { bold: true, away: Some((1.0, 0.0)), ..Label::new(words, theme.ink, vec![at], 0) });
    }
}

/// Returns the parts of a line through these points that lie at or below a level.
fn below(points: &[(f64, f64)], level: f64) -> Vec<Vec<(f64, f64)>> {
    let mut runs: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut before: Option<(f64, f64)> = None;
    for point in points {
        let cut = before.filter(|last| (last.1 <= level) != (point.1 <= level)).map(|last| {
            let share = (level - last.1) / (point.1 - last.1);
            (last.0 + share * (point.0 - last.0), level)
        });
        if before.is_none_or(|last| last.1 > level) {
            runs.push(Vec::new());
        }
        if let Some(run) = runs.last_mut() {
            run.extend(cut);
            run.extend(Some(*point).filter(|point| point.1 <= level));
        }
        before = Some(*point);
    }
    runs.retain(|run| run.len() > 1);
    runs
}

/// Draws an animation in which the vehicle drives over the structure; each frame takes this many seconds.
pub(crate) fn film(analysis: &Analysis, options: &Options, seconds: f64) -> Vec<(Drawing, f64)> {
    let (mut steps, mut times) = (Vec::new(), Vec::new());
    for (frame, found) in analysis.frames.iter().enumerate() {
        let count = found.vehicle.as_ref().map_or(0, |influence| influence.positions.len());
        let stops = count.min(MAX_STOPS);
        steps.extend((0..stops).map(|stop| (frame, (stop as f64 + 0.5) / stops as f64)));
        times.extend((0..stops).map(|_| (2.0 * seconds / stops as f64).max(0.04)));
        steps.push((frame, 1.0));
        times.push(GOVERNING_SECONDS.max(seconds));
    }
    sheet::steps(analysis, &Mechanism, options, &steps).into_iter().zip(times).collect()
}
