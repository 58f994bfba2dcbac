//! The other end of a placement tolerance: a pattern of errors with which the component falls.

use super::model::{LARGEST_ERROR, Model};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::{LimitDistance, ProofCache, decide_verdict};
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::Motion;
use crate::mechanics::solve::{Limit, is_late, largest_factor_fast};
use crate::mechanics::statics::assembly::{Assembly, AssemblyContact};

/// A pattern counts as no better than another one if its tolerance is smaller by less than this share.
const IMPROVEMENT: f64 = 1e-6;

/// A pattern whose limit is within this share of the proved tolerance is the end of the search.
const CLOSED: f64 = 1e-5;

/// The largest number of steps to the limit of a pattern. Newton's method takes two to five.
const MAX_STEPS: usize = 40;

/// How far beyond the limit of a pattern the fall is confirmed, as shares of the limit.
const BEYOND: [f64; 6] = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];

/// How far before the limit of one body's error the stand is confirmed, as shares of the limit.
const WITHIN: [f64; 3] = [1e-6, 1e-4, 1e-2];

/// The relative accuracy of the limit of a pattern.
const PATTERN_ACCURACY: f64 = 1e-10;

/// The relative accuracy of the limit of one body's error.
const OWN_ACCURACY: f64 = 1e-7;

/// Components with at most this many bodies also try each pattern that differs in one body.
const MAX_NEIGHBOURS: usize = 40;

/// A component, and how far each of its bodies may be off.
pub(super) struct Errors<'a> {
    pub component: &'a Assembly,
    /// The moment of each body per metre of error, N: its weight and the magnitudes of its loads.
    pub moments: &'a [f64],
    /// The factor on the error of each body: the key `placement` of its block.
    pub scales: &'a [f64],
}

/// The largest error of a pattern while the joints keep their lengths.
struct PatternLimit {
    /// Metres.
    at: f64,
    /// The change of the limit per metre by which the joints are shortened.
    slope: f64,
    /// The motion beyond the limit.
    motion: Vec<f64>,
}

/// A pattern of errors with which a component falls.
pub(super) struct Falling {
    /// Metres.
    pub at: f64,
    /// The sense of the additional moment of each body: 1 anticlockwise, −1 clockwise.
    pub signs: Vec<f64>,
    pub mechanism: Vec<Motion>,
}

impl Errors<'_> {
    /// Returns the component with the ends of joints `error` metres inside their places, and with the moments of the
    /// pattern.
    pub fn placed(&self, error: f64, signs: &[f64]) -> Assembly {
        let mut moved = self.component.clone();
        for contact in &mut moved.contacts {
            let along = (contact.points[1] - contact.points[0]).normalize() * (error * self.scale_at(contact));
            contact.points = [contact.points[0] + along, contact.points[1] - along];
        }
        for (body, own) in moved.bodies.iter_mut().enumerate() {
            own.fixed.moment += signs[body] * self.moments[body] * self.scales[body] * error;
        }
        moved.with_summed_loads()
    }

    /// Returns the limit of the pattern with the joints shortened by `shortened` metres.
    fn limit(&self, shortened: f64, signs: &[f64]) -> Option<PatternLimit> {
        let none = vec![0.0; signs.len()];
        let moved = self.placed(shortened, &none);
        let scale = Scale::from_assembly(&moved);
        let program = Program::new(&moved, scale);
        let mut direction = vec![0.0; program.loads.len()];
        for (body, sign) in signs.iter().enumerate() {
            direction[3 * body + 2] = -sign * self.moments[body] * self.scales[body] / scale.moment();
        }
        let extreme = largest_factor_fast(&program, &direction);
        let motion = extreme.motion?;
        let at = match extreme.limit {
            Limit::At(error) => error,
            Limit::Infeasible => 0.0,
            Limit::Unbounded | Limit::Unsolved => return None,
        };
        // Shorter joints take power from the forces in the motion: N1 and N2 move against each other.
        let spin = |body: usize| motion[3 * body + 2];
        let taken = moved.contacts.iter().zip(extreme.forces.iter().flat_map(|forces| &forces.normal));
        let taken = taken.map(|(contact, [first, second])| {
            let turn = spin(contact.on) - contact.from.map_or(0.0, spin);
            (self.scale_at(contact) / scale.length * turn * (first - second)).abs()
        });
        let power = direction.iter().zip(&motion).map(|(load, velocity)| load * velocity).sum::<f64>().abs();
        let slope = -taken.sum::<f64>() / power;
        Some(PatternLimit { at, slope: if slope.is_finite() { slope } else { 0.0 }, motion })
    }

    /// Returns the factor on the error of a joint.
    fn scale_at(&self, contact: &AssemblyContact) -> f64 {
        contact.from.map_or(0.0, |body| self.scales[body]).max(self.scales[contact.on])
    }

    /// Returns the error at which the pattern's limit and the shortening of joints are equal, at most `end`: Newton's
    /// method from `start`, within the interval that is still possible. `None` if there is none up to `end`.
    fn root(&self, signs: &[f64], start: f64, end: f64, accuracy: f64) -> Option<f64> {
        let (mut low, mut high, mut at) = (0.0, end, start);
        for _ in 0..MAX_STEPS {
            let limit = self.limit(at, signs)?;
            let rest = limit.at - at;
            if rest.abs() <= accuracy * at {
                return Some(at);
            }
            if rest > 0.0 && at >= end {
                return None;
            }
            *(if rest > 0.0 { &mut low } else { &mut high }) = at;
            if is_late() || high.is_finite() && high - low <= accuracy * high {
                return Some(high);
            }
            let next = (at + rest / (1.0 - limit.slope)).min(end);
            let is_inside = next > low && (next < high || high == end && at < end);
            at = if is_inside { next } else { low + (high - low) / 2.0 };
        }
        Some(high)
    }

    /// Finds a pattern with a small limit, from the motion with which affine forces end.
    pub fn falling(&self, model: &Model, motion: &[f64], start: f64) -> Option<Falling> {
        let end = model.end_of_joints() * model.metres;
        let signs = |motion: &[f64], flip: f64| -> Vec<f64> {
            motion.chunks_exact(3).map(|v| if v[2] * flip < 0.0 { -1.0 } else { 1.0 }).collect()
        };
        let mut best: Option<(f64, Vec<f64>)> = None;
        let count = self.moments.len();
        let mut starts = vec![vec![1.0; count], vec![-1.0; count]];
        if motion.len() == 3 * count {
            starts.splice(0..0, [signs(motion, 1.0), signs(motion, -1.0)]);
        }
        let is_open = |best: &Option<(f64, Vec<f64>)>| best.as_ref().is_none_or(|(at, _)| *at > start * (1.0 + CLOSED));
        for first in starts {
            // Follow the motion of each pattern to the pattern that makes it work most.
            let mut pattern = first;
            let mut least = f64::INFINITY;
            while is_open(&best)
                && let Some(limit) = self.limit(start, &pattern)
                && limit.at < least * (1.0 - IMPROVEMENT)
            {
                least = limit.at;
                if best.as_ref().is_none_or(|(at, _)| limit.at < *at) {
                    best = Some((limit.at, pattern.clone()));
                }
                pattern = signs(&limit.motion, 1.0);
            }
        }
        let mut changed = count <= MAX_NEIGHBOURS && is_open(&best);
        let (mut least, mut pattern) = best?;
        while changed && !is_late() {
            changed = false;
            for body in (0..count).filter(|body| self.moments[*body] * self.scales[*body] > 0.0) {
                pattern[body] *= -1.0;
                match self.limit(start, &pattern) {
                    Some(limit) if limit.at < least * (1.0 - IMPROVEMENT) => (least, changed) = (limit.at, true),
                    _ => pattern[body] *= -1.0,
                }
            }
        }
        let at = self.root(&pattern, least.min(end), end, PATTERN_ACCURACY)?;
        self.confirmed(at, pattern)
    }

    /// Returns the largest error of one body, metres, up to which the component is proved to stand. Forces that balance
    /// both extreme errors balance all errors between them, by a mean of them. `None` if this is not proved.
    pub fn of_one(&self, body: usize) -> Option<f64> {
        let joints = self.component.contacts.iter().filter(|contact| contact.on == body || contact.from == Some(body));
        let lengths = joints.map(|contact| (contact.points[1] - contact.points[0]).norm());
        let mut least = lengths.fold(f64::INFINITY, f64::min) / self.scales[body] * LARGEST_ERROR;
        let sides = [1.0, -1.0].map(|sign| {
            let mut signs = vec![0.0; self.scales.len()];
            signs[body] = sign;
            signs
        });
        // The first side starts from no error, the second one from the limit of the first: it may be farther.
        for (signs, is_first) in sides.iter().zip([true, false]) {
            let start = if is_first || least.is_infinite() { 0.0 } else { least };
            if let Some(at) = self.root(signs, start, least, OWN_ACCURACY) {
                least = at;
            }
        }
        let errors = WITHIN.into_iter().map(|share| least * (1.0 - share));
        errors.filter(|error| error.is_finite()).find(|error| {
            sides.iter().all(|signs| {
                let moved = self.placed(*error, signs);
                decide_verdict(&moved, LimitDistance::Unknown, &mut ProofCache::default()).0 == Verdict::Stable
            })
        })
    }

    /// Returns the first error beyond `at` at which the pattern is proved to fall.
    fn confirmed(&self, at: f64, signs: Vec<f64>) -> Option<Falling> {
        BEYOND.into_iter().find_map(|share| {
            let at = at * (1.0 + share);
            let (verdict, mechanism) =
                decide_verdict(&self.placed(at, &signs), LimitDistance::Unknown, &mut ProofCache::default());
            (verdict == Verdict::Unstable).then(|| Falling { at, signs: signs.clone(), mechanism })
        })
    }
}
