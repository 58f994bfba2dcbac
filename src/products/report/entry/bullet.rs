//! [`MarginBar`]: a margin as a bar. It shows the values at which the structure stands, and the current value.

use crate::mechanics::analysis::{End, Interval, MarginKind, SolvedFrame};
use crate::products::wording::margin::{Position, StatedMargin, confirmed, stated};
use crate::products::wording::number::{three_down, three_up};
use crate::products::wording::question;

/// The way in which one end of a bar is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarEnd {
    /// The parameter has no values beyond this end: for example, a kernel cannot be larger than 1.
    Domain,
    /// The structure falls beyond this end.
    Edge,
    /// No verdict confirms where the interval ends. The true end may lie farther outside.
    Unconfirmed,
    /// The structure stands at every value beyond this end.
    Open,
}

/// A margin: the values at which the structure stands, and the current value.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginBar {
    /// The parameter that varies.
    pub name: String,
    /// The values at which the structure stands, and the current value, in words.
    pub words: String,
    /// The two ends of the interval in words, such as `0.3` or `no limit`, and the current value.
    pub ends_and_present: [String; 3],
    /// The lowest and the highest value on the scale.
    pub scale: (f64, f64),
    /// The lowest and the highest value at which the structure is known to stand. An end of the scale replaces an end
    /// that does not exist. `None` if the structure is not known to stand at any value.
    pub safe: Option<(f64, f64)>,
    /// How the ends of `safe` are drawn.
    pub ends: (BarEnd, BarEnd),
    /// The least and the largest current value; `None` if there is no current value or if it is infinite.
    pub now: Option<(f64, f64)>,
    /// The position of the current value: inside the interval, outside, or unknown.
    pub position: Position,
    /// Whether this is the factor on the loads.
    pub is_load_factor: bool,
    /// The relative distance of the current value from the nearest end: 0 at the end, 1 if there is no end. Also 0 if
    /// the structure is not known to stand at the current value.
    pub reserve: f64,
}

/// Returns the computed margins of a frame as bars, the headline margin first.
pub fn margin_bars(solved: SolvedFrame<'_>) -> Vec<MarginBar> {
    stated(solved).iter().map(MarginBar::new).collect()
}

/// Returns the placement tolerance of a frame as a bar, if it was computed. The bar covers the errors for which the frame
/// is proved to stand. Its end is confirmed if the frame falls with the same error, to three digits; the structure that
/// is analysed has the error 0.
pub(super) fn placement_bar(solved: SolvedFrame<'_>) -> Option<MarginBar> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let found = frame_analysis.placement.as_ref()?;
    let proved = question::placement_length(scene, found.proved, three_down);
    let confirmed = found.falls_at.is_some_and(|at| at <= found.proved * (1.0 + 1e-3));
    let farthest = found.falls_at.unwrap_or(found.proved);
    Some(MarginBar {
        name: "placement tolerance".to_owned(),
        words: question::placement_sentence(solved, found),
        ends_and_present: [
            "0".to_owned(),
            if confirmed { proved } else { format!("at least {proved}") },
            question::placement_length(scene, 0.0, three_up),
        ],
        scale: (0.0, if farthest > 0.0 { SCALE_END_RATIO * farthest } else { 1.0 }),
        safe: Some((0.0, found.proved)),
        ends: (BarEnd::Domain, if confirmed { BarEnd::Edge } else { BarEnd::Unconfirmed }),
        now: Some((0.0, 0.0)),
        position: Position::Inside,
        is_load_factor: false,
        reserve: 1.0,
    })
}

/// A legend for readers: the meaning of a bar and of the mark at the current value.
pub(super) const SHAPES_LEGEND: &str =
    "Bars: where it stands; disc, cross or ring: the present value, inside, outside or unknown.";

/// The upper end of the scale, as a multiple of the largest absolute value that is drawn.
const SCALE_END_RATIO: f64 = 1.25;

impl MarginBar {
    fn new(margin: &StatedMargin<'_>) -> MarginBar {
        let present = margin.present.filter(|(low, high)| low.is_finite() && high.is_finite());
        let scale = scale(margin, present);
        let (safe, ends) = match margin.interval {
            Interval::Between { low, high } => {
                let from = confirmed(low).unwrap_or(scale.0);
                let to = confirmed(high).unwrap_or(scale.1);
                let begins = !margin.kind.is_signed() && from <= 0.0;
                let lower = match bar_end(margin, low) {
                    BarEnd::Edge if begins => BarEnd::Domain,
                    end => end,
                };
                let ends = (lower, bar_end(margin, high));
                (Some((from, to)), ends)
            }
            _ => (None, (BarEnd::Domain, BarEnd::Domain)),
        };
        MarginBar {
            name: margin.name.clone(),
            words: margin.sentence(),
            ends_and_present: margin.ends_and_present(),
            scale,
            safe,
            ends,
            now: present,
            position: margin.position,
            is_load_factor: margin.kind == MarginKind::LoadFactor,
            reserve: margin.reserve(),
        }
    }

    /// Returns the position of a value on the scale, from 0 to 1. Values outside the scale are moved to the nearer
    /// end.
    pub(crate) fn share(&self, value: f64) -> f64 {
        let (low, high) = self.scale;
        let share = if high > low { (value - low) / (high - low) } else { 0.0 };
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Returns the lower and the upper end of the scale. The upper end is 1 for a kernel. For other parameters it is
/// [`SCALE_END_RATIO`] times the largest absolute value that is drawn. If all drawn values are 0, it is 90 for a tilt
/// and 1 otherwise. The lower end is 0, or minus the upper end if the parameter can be negative.
fn scale(margin: &StatedMargin<'_>, present: Option<(f64, f64)>) -> (f64, f64) {
    let ends = [margin.interval.low(), margin.interval.high()];
    let values = ends.into_iter().flatten().filter_map(confirmed);
    let values = values.chain(present.map(|(_, high)| high));
    let farthest = values.map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let top = match margin.kind {
        MarginKind::Kernel => 1.0,
        MarginKind::Tilt if farthest == 0.0 => 90.0,
        _ if farthest == 0.0 => 1.0,
        _ => SCALE_END_RATIO * farthest,
    };
    (if margin.kind.is_signed() { -top } else { 0.0 }, top)
}

fn bar_end(margin: &StatedMargin<'_>, end: &End) -> BarEnd {
    match end {
        // A kernel cannot be larger than 1.
        End::Unbounded if margin.kind == MarginKind::Kernel => BarEnd::Domain,
        End::Unbounded => BarEnd::Open,
        End::Unconfirmed { .. } => BarEnd::Unconfirmed,
        End::At { .. } => BarEnd::Edge,
    }
}
