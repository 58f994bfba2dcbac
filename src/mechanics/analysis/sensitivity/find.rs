//! Combines the sensitivities of the components of a frame into the sensitivity of the frame.
//!
//! [`Slope`]: the derivative of a margin, unless the margin has a kink.

use super::case::Case;
use super::corners::Corners;
use super::elimination::ZERO_TOL;
use super::rates::Rates;
use super::state::EndState;
use super::{CornerMoves, CornerSlope, EndSensitivity, LoadSlope, NoSensitivity, Sensitivity};
use crate::mechanics::analysis::margin::{END_TOL, End, Interval, MarginKind};
use crate::mechanics::scene::BodyId;
use crate::mechanics::solve::is_late;
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect::FrameContext;
use crate::mechanics::statics::interface::Interface;

/// A component of a frame, and its own interval of the parameter if that is known.
pub(in crate::mechanics::analysis) struct Part<'a> {
    pub component: &'a Assembly,
    pub interval: Option<&'a Interval>,
}

/// A function that returns the slope for one quantity. Its first argument is the largest derivative of the same kind.
/// Its second argument reads the derivative from the rates of a state.
type SlopeOf<'a> = dyn Fn(f64, &dyn Fn(&Rates) -> f64) -> Slope + 'a;

/// Computes how both ends of the interval of a margin change with corners, weights, friction and loads.
pub(in crate::mechanics::analysis) fn find(
    context: &FrameContext,
    parts: &[Part],
    interval: Option<&Interval>,
    kind: MarginKind,
) -> Sensitivity {
    // Contacts that the scene lists do not move with the corners of the outlines, so there are no derivatives.
    let (low, high) = match interval.filter(|_| !context.scene.lists_contacts()) {
        None => (Err(NoSensitivity::NotApplicable), Err(NoSensitivity::NotApplicable)),
        Some(Interval::Empty(_)) => (Err(NoSensitivity::Empty), Err(NoSensitivity::Empty)),
        Some(Interval::Undecided) => (Err(NoSensitivity::Unconfirmed), Err(NoSensitivity::Unconfirmed)),
        Some(Interval::Between { .. }) if is_late() => (Err(NoSensitivity::Unsolved), Err(NoSensitivity::Unsolved)),
        Some(Interval::Between { low, high }) => {
            let corners = Corners::new(context.scene, context.frame, context.interfaces);
            let frame = Search { context, parts, kind, corners: &corners };
            (frame.end(low, -1.0), frame.end(high, 1.0))
        }
    };
    Sensitivity { kind, low, high }
}

struct Search<'a> {
    context: &'a FrameContext<'a>,
    parts: &'a [Part<'a>],
    kind: MarginKind,
    corners: &'a Corners,
}

impl Search<'_> {
    fn end(&self, end: &End, outward: f64) -> Result<EndSensitivity, NoSensitivity> {
        let (value, mechanism) = match end {
            End::Unbounded => return Err(NoSensitivity::Unbounded),
            End::Unconfirmed { .. } => return Err(NoSensitivity::Unconfirmed),
            End::At { mechanism, .. } if mechanism.is_empty() => {
                return Err(NoSensitivity::RangeEnds);
            }
            End::At { value, mechanism } => (*value, mechanism),
        };
        let mut all = Vec::new();
        let mut exact = value;
        for part in self.parts {
            let Some(mechanism) = self.mechanism_of(part, value, mechanism, outward) else {
                continue;
            };
            let case = Case { component: part.component, kind: self.kind, value, outward, mechanism };
            let state = EndState::new(&case).ok_or(NoSensitivity::Unsolved)?;
            let rates = state.states.iter().map(|one| Rates::new(self.context, self.corners, &state.changed, one));
            let mut rates: Option<Vec<Rates>> = rates.collect();
            if self.kind == MarginKind::FrictionFactor {
                // The derivatives are per unit of the multiplied coefficient: d(fμ)/dμ = f.
                let scene = self.context.scene;
                let is_factored = |own: &Interface| scene.has_factored_friction(own.bodies, own.normal);
                for rates in rates.iter_mut().flatten() {
                    let each = rates.friction.iter_mut().zip(self.context.interfaces.iter());
                    each.filter(|(_, own)| is_factored(own)).for_each(|(rate, _)| *rate *= value);
                }
            }
            exact = state.value;
            all.push(rates.ok_or(NoSensitivity::Unsolved)?);
        }
        let is_same = (exact - value).abs() <= 1e3 * END_TOL * value.abs().max(1e-3);
        if all.is_empty() || !is_same {
            return Err(NoSensitivity::Unsolved);
        }
        Ok(self.slopes(exact, &all))
    }

    /// Returns the mechanism by which a component falls beyond the end of the frame's interval. `None` if other
    /// components fall there, but not this component.
    fn mechanism_of<'m>(
        &self,
        part: &'m Part,
        value: f64,
        mechanism: &'m [crate::mechanics::proof::Motion],
        outward: f64,
    ) -> Option<&'m [crate::mechanics::proof::Motion]> {
        let own = match part.interval {
            Some(interval) if outward > 0.0 => interval.high(),
            Some(interval) => interval.low(),
            None => {
                let moves =
                    |m: &crate::mechanics::proof::Motion| part.component.bodies.iter().any(|b| b.block == m.block);
                return mechanism.iter().any(moves).then_some(mechanism);
            }
        };
        match own? {
            End::At { value: at, mechanism } if !mechanism.is_empty() => {
                let is_same = (at - value).abs() <= END_TOL * at.abs().max(value.abs()).max(1e-3);
                is_same.then_some(mechanism)
            }
            _ => None,
        }
    }

    /// Combines the derivatives for all states, of all components that fall at this end, into those of the frame. A
    /// derivative is unique if it is the same for all of them.
    fn slopes(&self, value: f64, all: &[Vec<Rates>]) -> EndSensitivity {
        let (scene, frame) = (self.context.scene, self.context.frame);
        let slope = |largest: f64, read: &dyn Fn(&Rates) -> f64| {
            let mut each = all.iter().flatten().map(read);
            let first = each.next().unwrap_or(0.0);
            let is_unique = each.all(|other| (other - first).abs() <= ZERO_TOL * largest);
            if is_unique { Slope::Unique(first) } else { Slope::AtKink }
        };
        let first = || all.iter().filter_map(|rates| rates.first());
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |m: f64, v| m.max(v.abs()));
        let corners = self.corners(&slope, most(&mut first().flat_map(|r| r.corners.iter().flat_map(|v| [v.x, v.y]))));
        let weight = most(&mut first().flat_map(|r| r.weights.iter().copied()));
        let friction = most(&mut first().flat_map(|r| r.friction.iter().copied()));
        let load = most(&mut first().flat_map(|r| r.loads.iter().flat_map(|v| [v.x, v.y])));
        let mut placed = frame.placed.clone();
        placed.sort();
        let weights = placed.iter().map(|b| (*b, slope(weight, &|r| r.weights[b.0])));
        let loads = scene.loads().iter().enumerate();
        let loads = loads.filter(|(_, l)| placed.binary_search(&l.block).is_ok());
        let loads = loads.map(|(k, own)| {
            let slopes = [slope(load, &|r| r.loads[k].x), slope(load, &|r| r.loads[k].y)];
            LoadSlope { entry: own.entry, block: own.block, at: own.at, slopes }
        });
        let sets_friction = self.kind == MarginKind::Friction;
        let interfaces = 0..if sets_friction { 0 } else { self.context.interfaces.len() };
        EndSensitivity {
            value,
            corners,
            weights: weights.collect(),
            friction: interfaces.map(|k| (k, slope(friction, &|r| r.friction[k]))).collect(),
            friction_of_all: (!sets_friction).then(|| slope(friction, &|r| r.friction.iter().sum())),
            loads: loads.collect(),
        }
    }

    /// Returns the derivatives of the margin with respect to the positions of the corners of all placed blocks.
    /// `largest` is the largest absolute value of these derivatives.
    fn corners(&self, slope: &SlopeOf<'_>, largest: f64) -> Vec<CornerSlope> {
        let corners = self.corners;
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); corners.count];
        for (place, joined) in corners.joined.iter().enumerate() {
            members[*joined].push(place);
        }
        let moves: Vec<CornerMoves> = corners
            .moves
            .iter()
            .map(|moves| {
                let along = |k: usize| {
                    let field = &moves[k].field;
                    slope(largest, &|rates| {
                        let each = field.iter().map(|(corner, by)| rates.corners[*corner].dot(by));
                        each.sum()
                    })
                };
                match moves.len() {
                    0 => CornerMoves::Not,
                    1 => CornerMoves::Along { direction: moves[0].direction, slope: along(0) },
                    _ => CornerMoves::Freely([along(0), along(1)]),
                }
            })
            .collect();
        let of_blocks = corners.all.iter().zip(&corners.joined);
        let slopes = of_blocks.filter_map(|(corner, joined)| {
            let BodyId::Block(block) = corner.body else {
                return None;
            };
            let others = members[*joined].iter().map(|place| corners.all[*place].body);
            let mut with: Vec<BodyId> = others.filter(|body| *body != corner.body).collect();
            with.sort();
            with.dedup();
            Some(CornerSlope { block, corner: corner.number, at: corner.at, with, moves: moves[*joined] })
        });
        slopes.collect()
    }
}

/// The derivative of a margin's end with respect to one number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Slope {
    /// The same derivative if the number increases or decreases.
    Unique(f64),
    /// The derivative jumps here.
    AtKink,
}

impl Slope {
    /// Returns the derivative if it is the same on both sides; otherwise `None`.
    pub fn unique(self) -> Option<f64> {
        match self {
            Slope::Unique(slope) => Some(slope),
            Slope::AtKink => None,
        }
    }
}
