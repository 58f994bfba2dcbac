//! [`MarginBar`]: a margin as a bar: the values at which it stands, and the present one.

use crate::analysis::{End, FrameAnalysis, Interval};
use crate::scene::Scene;
use crate::wording::margin::{Parameter, Position, StatedMargin, confirmed, stated};

/// How one end of a bar is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarEnd {
    /// The parameter itself begins or ends here.
    Domain,
    /// It falls beyond.
    Edge,
    /// No verdict confirms the end, which lies beyond.
    Unconfirmed,
    /// It stands at every value beyond.
    Open,
}

/// A margin: the values at which the structure stands, and the place where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct MarginBar {
    /// What varies.
    pub name: String,
    /// At which values it stands and where it is now, in words.
    pub words: String,
    /// The ends of the scale.
    pub scale: (f64, f64),
    /// From where to where it stands; nowhere where `None`.
    pub safe: Option<(f64, f64)>,
    /// How the ends of that are drawn.
    pub ends: (BarEnd, BarEnd),
    /// The least and the largest present value, where they have a place on the scale.
    pub now: Option<(f64, f64)>,
    /// Where the present value is.
    pub position: Position,
    /// Whether this is the factor on the loads.
    pub is_load_factor: bool,
    /// How much is left to the nearest end, in parts of what there is: 0 at the end, 1 where nothing limits it.
    pub reserve: f64,
}

/// The margins of a frame as bars, those that were asked for, the headline first.
pub fn margin_bars(scene: &Scene, found: &FrameAnalysis) -> Vec<MarginBar> {
    stated(scene, found).iter().map(MarginBar::new).collect()
}

/// What the shapes of bars mean.
pub(super) const SHAPES: &str = "A bar covers the values at which it stands: it falls beyond a stroke (dashed: not confirmed) \
                                 and stands beyond an arrow. Present value: disc inside, cross outside, ring undecided.";

/// The scale reaches this much farther than the farthest value on it.
const BEYOND: f64 = 1.25;

impl MarginBar {
    fn new(margin: &StatedMargin<'_>) -> MarginBar {
        let present = margin
            .present
            .filter(|(low, high)| low.is_finite() && high.is_finite());
        let scale = scale(margin, present);
        let (safe, ends) = match margin.interval {
            Interval::Between { low, high } => {
                let from = confirmed(low).unwrap_or(scale.0);
                let to = confirmed(high).unwrap_or(scale.1);
                let begins = !margin.parameter.is_signed() && from <= 0.0;
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
            scale,
            safe,
            ends,
            now: present,
            position: margin.position,
            is_load_factor: margin.parameter == Parameter::LoadFactor,
            reserve: margin.reserve(),
        }
    }

    /// The place of a value on the scale, 0 … 1.
    pub(crate) fn share(&self, value: f64) -> f64 {
        let (low, high) = self.scale;
        let share = if high > low {
            (value - low) / (high - low)
        } else {
            0.0
        };
        if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            0.0
        }
    }

    /// Whether it stands at the present value.
    pub(crate) fn is_inside(&self) -> bool {
        self.position == Position::Inside
    }

    /// The margin as a sentence of its own. That of the loads names them already.
    pub fn short(&self) -> String {
        if self.is_load_factor {
            return self.words.clone();
        }
        format!("{}: {}", self.name, self.words)
    }
}

/// From 0, or to both sides of it, to somewhat beyond all values that are drawn; a kernel to 1.
fn scale(margin: &StatedMargin<'_>, present: Option<(f64, f64)>) -> (f64, f64) {
    let ends = [margin.interval.low(), margin.interval.high()];
    let values = ends.into_iter().flatten().filter_map(confirmed);
    let values = values.chain(present.map(|(_, high)| high));
    let farthest = values
        .map(f64::abs)
        .filter(|v| v.is_finite())
        .fold(0.0, f64::max);
    let top = match margin.parameter {
        Parameter::Kernel => 1.0,
        Parameter::Tilt if farthest == 0.0 => 90.0,
        _ if farthest == 0.0 => 1.0,
        _ => BEYOND * farthest,
    };
    (
        if margin.parameter.is_signed() {
            -top
        } else {
            0.0
        },
        top,
    )
}

fn bar_end(margin: &StatedMargin<'_>, end: &End) -> BarEnd {
    match end {
        // There is no kernel above 1.
        End::Unbounded if margin.parameter == Parameter::Kernel => BarEnd::Domain,
        End::Unbounded => BarEnd::Open,
        End::Unconfirmed { .. } => BarEnd::Unconfirmed,
        End::At { .. } => BarEnd::Edge,
    }
}
