//! Draws the influence line of a vehicle above the structure: the largest load factor for each position of its first axle,
//! the vehicle at the governing position, and how the structure would begin to fall there.
//!
//! In an animation the vehicle drives over the structure: progress below 1 of the motion shows one of the positions, and
//! progress 1 the governing one.

use super::canvas::Canvas;
use super::design::{ArrowSize, Key, Layer, Mark};
use super::fall::Fall;
use super::load::{hollow, load_size};
use super::margin::ghosts;
use super::option::Options;
use super::panel::{About, Figure};
use super::placing::Label;
use super::{gives, sheet};
use crate::geometry::quarter_turn;
use crate::mechanics::analysis::{Analysis, Influence, VehiclePosition, Verdict};
use crate::pictures::drawing::{Drawing, Outline, PagePoint, Path};
use crate::products::wording::number::three_down;
use crate::products::wording::question::{vehicle_factor, vehicle_position};
use crate::products::wording::verdict;

/// The height of the influence line, and its distance from the vehicle, mm.
const HEIGHT: f64 = 13.0;
const DISTANCE: f64 = 3.0;
/// The length of the arrow of the heaviest axle, mm.
const AXLE: f64 = 7.0;
/// The line ends at this multiple of the least factor; larger factors are cut off.
const MOST: f64 = 4.0;
/// The largest number of positions in an animation, and how long it shows the governing one, s.
const MAX_STOPS: usize = 60;
const GOVERNING_SECONDS: f64 = 2.0;

/// The figure of an influence line.
pub(crate) struct InfluenceLine;

impl Figure for InfluenceLine {
    fn about(&self) -> About {
        About::new(
            "influence",
            "The load factor for each position of the vehicle, and how the structure falls at the governing one",
            "A vehicle on a dry-laid structure",
        )
    }

    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        let (scene, found) = analysis.at(frame);
        match (&found.vehicle, found.verdict) {
            (Some(influence), _) => {
                let Some(own) = shown(influence, options.motion_progress) else {
                    return vec![vehicle_factor(scene, influence)];
                };
                let times = own.factor.map_or("any multiple of".to_owned(), |factor| three_down(factor) + " ×");
                let words = format!("carries {times} the vehicle, {}", vehicle_position(scene, own));
                let alone = found.under_vehicle.map(|under| format!("{} without the vehicle", under.alone.verb()));
                [words].into_iter().chain(alone).collect()
            }
            (None, Verdict::Stable) => vec!["no position of a vehicle was analysed".into()],
            (None, Verdict::Unstable) => vec!["it falls without the vehicle".into()],
            (None, Verdict::Undecided) => vec![verdict::reason(scene, found)],
        }
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        let (analysis, number) = (canvas.analysis, canvas.number);
        if let Some(influence) = &canvas.found().vehicle {
            if canvas.options.motion_progress >= 1.0 && !influence.mechanism.is_empty() {
                let fall = Fall::with(analysis, number, &influence.mechanism);
                ghosts(canvas, &fall);
                gives::draw_fall(canvas, &fall, &fall.joints);
            }
            let position = shown(influence, canvas.options.motion_progress);
            vehicle(canvas, position);
            line(canvas, influence, position);
        }
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
    for (number, _, at) in &position.axles {
        let weight = vehicle.axles[*number].weight;
        let length = canvas.mm(AXLE) * weight / heaviest.max(f64::MIN_POSITIVE);
        if length < canvas.mm(0.5) {
            continue;
        }
        let tip = canvas.place(*at);
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

/// Draws the influence line above everything else, with the position that is shown.
fn line(canvas: &mut Canvas<'_>, influence: &Influence, position: Option<&VehiclePosition>) {
    let Some(least) = influence.governing.and_then(|number| influence.positions[number].factor) else { return };
    let theme = canvas.theme();
    let across = quarter_turn(canvas.scene().down());
    let camera = canvas.camera;
    let x = |at: f64| camera.place((across * at).into()).x;
    // The height of the axles is reserved, so that the line does not move in an animation.
    let base = canvas.structure.at.y.min(canvas.extent().at.y + canvas.mm(AXLE)) - canvas.mm(AXLE + DISTANCE + 2.0);
    let top = f64::max(MOST * least, 1.25);
    let height = canvas.mm(HEIGHT);
    let y = move |factor: f64| base - height * (factor / top).min(1.0);
    let point =
        |position: &VehiclePosition| PagePoint::new(x(position.at), y(position.factor.unwrap_or(f64::INFINITY)));
    let (left, right) = (canvas.structure.at.x, canvas.structure.at.x + canvas.structure.width);
    // While only the last axles are on the structure, the first one is beyond it.
    let is_over = |own: &VehiclePosition| (left - 1e-3..=right + 1e-3).contains(&x(own.at));
    let level = |factor: f64| Outline::line([PagePoint::new(left, y(factor)), PagePoint::new(right, y(factor))]);
    let thin = canvas.pen(theme.faint, 0.16);
    canvas.put(Mark::new(Layer::Symbol, "axis", vec![Path::stroked(level(0.0), thin.clone())]).avoided(0.0));
    let one = canvas.dashes(theme.faint, 0.16, [0.6, 0.5]);
    canvas.put(Mark::new(Layer::Symbol, "axis", vec![Path::stroked(level(1.0), one)]).avoided(0.0));
    for factor in [0.0, 1.0] {
        let middle = PagePoint::new(left - canvas.mm(1.5), y(factor));
        canvas.label(Label::at(middle, three_down(factor), theme.faint, 1));
    }
    let long = canvas.mm(4.8);
    let cut = format!("load factor over the first axle, cut off at {}", three_down(top));
    for (to_right, words) in [(true, cut), (false, "the same, travelling to the left".to_owned())] {
        let own = influence.positions.iter().filter(|own| own.to_right == to_right && is_over(own));
        let own: Vec<&VehiclePosition> = own.collect();
        if own.is_empty() {
            continue;
        }
        let mut stroke = canvas.pen(theme.ink, 0.35);
        if !to_right {
            stroke = stroke.dashed([canvas.mm(1.0), canvas.mm(0.7)]);
        }
        let key = Key::line(if to_right { 14 } else { 15 }, words, long, stroke.clone());
        let path = Path::stroked(Outline::line(own.iter().map(|own| point(own))), stroke);
        canvas.put(Mark::new(Layer::Symbol, "influence", vec![path]).keyed(&key).avoided(0.2));
    }
    if let Some(position) = position.filter(|own| is_over(own)) {
        let at = point(position);
        let dot = canvas.disc(at, 0.8, theme.failure);
        let words = position.factor.map_or("no limit".to_owned(), three_down);
        canvas.put(Mark::new(Layer::Symbol, "governing", vec![dot]).titled(words.clone()).avoided(0.2));
        canvas.label(Label { bold: true, ..Label::new(words, theme.ink, vec![at], 0) });
    }
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
    sheet::steps(analysis, &InfluenceLine, options, &steps).into_iter().zip(times).collect()
}
