//! [`Limits`]: proofs on both sides of each end of a margin, and of each corner and edge of a capacity.

use super::stand::slack_forces;
use super::{Certificate, Change, FrameForm, LimitForm, LoadForm, Locked};
use crate::geometry::{Vector, quarter_turn, sin_cos_degrees};
use crate::mechanics::analysis::{
    Cases, End, FrameAnalysis, Interval, LoadCapacity, MarginKind, Verdict, extremes, with_grip,
};
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::Scene;
use crate::mechanics::solve::is_late;
use crate::mechanics::statics::assembly::{Assembly, MIDDLE_THIRD, load_about};

/// How far from an end the two sides are proved, relative to its size: the first distance at which both the numbers of
/// the margin and the exact correction leave room.
pub(super) const DISTANCES: [f64; 2] = [1e-6, 1e-4];

/// The size of an end at 0, as a share of 1 or of the heaviest load.
const LEAST_SIZE: f64 = 1e-3;

/// A frame whose margins and capacity are proved.
pub(super) struct Limits<'a> {
    pub scene: &'a Scene,
    pub certificate: &'a Certificate,
    pub bare: &'a FrameForm,
    pub assembly: &'a Assembly,
    pub found: &'a FrameAnalysis,
}

/// A changed frame: the change, and the assembly that it gives.
type Changed = (Change, Assembly);

impl Limits<'_> {
    /// Returns the proofs of the capacity and the placement tolerance of the frame, as far as they were requested, and of
    /// all margins `with_margins`.
    pub fn all(&self, with_margins: bool) -> Vec<LimitForm> {
        let mut proofs = Vec::new();
        let given = self.assembly;
        let margins = self.found.margins_alone().filter(|_| with_margins);
        if let Some(margins) = margins {
            for kind in MarginKind::of_frame() {
                self.add_ends(&mut proofs, kind.word(), margins.of(kind), 1.0, &|value| self.changed(kind, value));
            }
            for (hold, (_, limits)) in margins.robots().enumerate() {
                let Some(grip) = given.grips.iter().position(|grip| grip.hold == hold) else { continue };
                let name = &self.bare.grips[grip].robot;
                for (component, (word, interval)) in ["fx", "fy", "torque"].into_iter().zip(limits).enumerate() {
                    let size = given.heaviest_load() * if component == 2 { given.length } else { 1.0 };
                    self.add_ends(&mut proofs, &format!("{name} {word}"), Some(interval), size, &|value| {
                        let mut limits = given.grips[grip].limits;
                        *[&mut limits.fx, &mut limits.fy, &mut limits.torque][component] = value;
                        let mut all: Vec<[Option<f64>; 3]> = self.bare.grips.iter().map(|grip| grip.limits).collect();
                        all[grip][component] = Some(value);
                        let change = Change { grip_limits: Some(all), ..Change::default() };
                        (change, given.clone().with_limits(grip, limits))
                    });
                }
            }
        }
        if let Some(capacity) = self.found.capacity_alone() {
            self.add_capacity(&mut proofs, capacity);
        }
        if let Some(placement) = self.found.placement_alone() {
            self.add_placement(&mut proofs, placement);
        }
        proofs
    }

    /// Returns the change of the frame for a value of the parameter of a margin.
    fn changed(&self, kind: MarginKind, value: f64) -> Changed {
        let (given, same) = (self.assembly.clone(), Change::default());
        match kind {
            MarginKind::Friction => (Change { friction: Some(value), ..same }, given.with_friction(value)),
            MarginKind::Tilt => self.tilted(value),
            MarginKind::HorizontalLoad => self.with_gravity(given.pull + quarter_turn(given.pull) * value),
            MarginKind::Kernel => (Change { kernel: Some(value), ..same }, given.with_kernel(value)),
            MarginKind::LoadFactor => (Change { load_factor: Some(value), ..same }, given.with_load_factor(value)),
            MarginKind::FrictionFactor => {
                (Change { friction_factor: Some(value), ..same }, given.with_friction_factor(value))
            }
            MarginKind::Sliding | MarginKind::Overturning | MarginKind::MiddleThird => {
                let change = match kind {
                    MarginKind::Sliding => Change { locked: Some(Locked::Turning), ..same },
                    MarginKind::Overturning => Change { locked: Some(Locked::Sliding), ..same },
                    _ => Change { kernel: Some(self.bare.kernel.max(MIDDLE_THIRD)), ..same },
                };
                let changed = kind.about().structure.map_or(given.clone(), |structure| structure(given));
                (Change { load_factor: Some(value), ..change }, changed.with_load_factor(value))
            }
            MarginKind::Robots => (same, given),
        }
    }

    /// Adds the proofs just inside and just beyond each end of an interval. An end at which the range of the parameter
    /// ends, such as friction 0, and an end that is not confirmed have none.
    fn add_ends(
        &self,
        proofs: &mut Vec<LimitForm>,
        name: &str,
        interval: Option<&Interval>,
        size: f64,
        change: &dyn Fn(f64) -> Changed,
    ) {
        let Some(Interval::Between { low, high }) = interval else { return };
        for (word, end, outward) in [("low", low, -1.0), ("high", high, 1.0)] {
            let End::At { value, mechanism } = end else { continue };
            if mechanism.is_empty() {
                continue;
            }
            let size = value.abs().max(LEAST_SIZE * size);
            // An interval may be as narrow as one value.
            let width = match (low.value(), high.value()) {
                (Some(low), Some(high)) => high - low,
                _ => f64::INFINITY,
            };
            // The range of the kernel ends at 1.
            let most = if name == MarginKind::Kernel.word() { 1.0 } else { f64::INFINITY };
            let name = format!("{name} {word} {value}");
            let inside = |share: f64| match share * size < width / 2.0 {
                true => change(value - outward * share * size),
                // Such a narrow interval is a value that people write, and rounding.
                false => change(roundest(value - outward * width / 2.0, width / 2.0)),
            };
            let beyond = |share: f64| change((value + outward * share * size).min(most));
            proofs.extend(self.proof(&name, Verdict::Stable, &[], &inside));
            proofs.extend(self.proof(&name, Verdict::Unstable, mechanism, &beyond));
        }
    }

    /// Adds a proof just inside each corner of a capacity, and one just beyond each edge: in ranges of parameters, inside
    /// in each extreme case, and beyond in the case to which the edge belongs. A force at two points is their resultant at
    /// the first: inside with the torque that leaves the largest slack, and beyond without a torque, because the motion does
    /// not rotate the block.
    fn add_capacity(&self, proofs: &mut Vec<LimitForm>, capacity: &LoadCapacity) {
        let Some(body) = self.assembly.bodies.iter().position(|body| body.block == capacity.block) else { return };
        let has_ranges = capacity.ranges != Cases::default();
        let Ok(cases) = extremes(self.assembly, &capacity.ranges) else { return };
        let (Some(&at), false) = (capacity.at.first(), capacity.vertices.is_empty()) else { return };
        let without = capacity.robot.and_then(|robot| self.assembly.grips.iter().position(|grip| grip.robot == robot));
        let corners: Vec<Vector> = capacity.vertices.iter().map(|vertex| vertex.force).collect();
        let heaviest = Some(self.assembly.heaviest_load()).filter(|load| *load > 0.0).unwrap_or(1.0);
        let size = corners.iter().map(|force| force.norm()).fold(LEAST_SIZE * heaviest, f64::max);
        let far = capacity.rays.iter().sum::<Vector>() * size;
        let middle = corners.iter().sum::<Vector>() / corners.len() as f64 + far;
        let loaded = |case: &Assembly, force: Vector, is_inside: bool| {
            let mut changed = if has_ranges { case.clone() } else { self.assembly.clone() };
            let own = &mut changed.bodies[body];
            // A block that nothing else holds carries only what balances its loads exactly.
            let is_rest = is_inside && (force + own.load.force).norm() <= 2.0 * DISTANCES[0] * size;
            let force = if is_rest { -own.load.force } else { force };
            own.load = own.load.plus(load_about(own.centroid, at, force, 0.0));
            let mut all: Vec<[Option<f64>; 3]> = self.bare.grips.iter().map(|grip| grip.limits).collect();
            if let Some(grip) = without {
                (all[grip][0], all[grip][1]) = (Some(0.0), Some(0.0));
                (changed.grips[grip].limits.fx, changed.grips[grip].limits.fy) = (0.0, 0.0);
            }
            // Two forces are a force and a torque at the first point: that of a grip without a limit.
            let held = || slack_forces(&with_grip(&changed, body, at, [0.0, 0.0, f64::INFINITY]));
            let held = (is_inside && capacity.at.len() > 1).then(held).flatten();
            let torque = held.and_then(|forces| forces.last().copied()).map_or(0.0, |[.., torque]| torque);
            let own = &mut changed.bodies[body];
            own.load = own.load.plus(load_about(own.centroid, at, Vector::zeros(), torque));
            let point = (at != self.assembly.bodies[body].centroid).then_some([at.x, at.y]);
            let load = LoadForm { force: [force.x, force.y], at: point, torque, fixed: false };
            let force = Some((self.bare.placed[body], load));
            let gravity = has_ranges.then_some([case.pull.x, case.pull.y]);
            let friction = capacity.ranges.friction.map(|[least, _]| least);
            let grip_limits = without.is_some().then_some(all);
            (Change { gravity, friction, force, grip_limits, ..Change::default() }, changed)
        };
        let name = |part: &str, number: usize, case: usize| match cases.len() {
            1 => format!("capacity {part} {number}"),
            _ => format!("capacity {part} {number} case {case}"),
        };
        for (number, corner) in corners.iter().enumerate() {
            for (k, case) in cases.iter().enumerate() {
                let inside = |share: f64| loaded(case, corner + (middle - corner) * share, true);
                proofs.extend(self.proof(&name("corner", number, k), Verdict::Stable, &[], &inside));
            }
        }
        for (number, edge) in capacity.edges.iter().enumerate() {
            let ends: Vec<usize> = edge.ends.iter().flatten().copied().collect();
            let (first, last) = (ends.first().unwrap_or(&0), ends.last().unwrap_or(&0));
            let on_edge = (corners[*first] + corners[*last]) / 2.0;
            let Some(case) = cases.get(edge.case) else { continue };
            let beyond = |share: f64| loaded(case, on_edge + edge.normal * (share * size), false);
            proofs.extend(self.proof(&name("edge", number, edge.case), Verdict::Unstable, &edge.mechanism, &beyond));
        }
    }

    /// Rotates gravity by an angle in degrees.
    fn tilted(&self, degrees: f64) -> Changed {
        let (sin, cos) = sin_cos_degrees(degrees);
        self.with_gravity(self.assembly.pull * cos + quarter_turn(self.assembly.pull) * sin)
    }

    fn with_gravity(&self, pull: Vector) -> Changed {
        (Change { gravity: Some([pull.x, pull.y]), ..Change::default() }, self.assembly.clone().with_gravity(pull))
    }

    /// Returns the proof nearest to an end that is exact, or else the farthest one that was tried. A given motion needs no
    /// program, so it is tried at all distances before other motions are computed.
    pub(super) fn proof(
        &self,
        of: &str,
        verdict: Verdict,
        mechanism: &[Motion],
        change: &dyn Fn(f64) -> Changed,
    ) -> Option<LimitForm> {
        let given_first: &[bool] = if verdict == Verdict::Stable { &[false] } else { &[true, false] };
        let mut last = None;
        if is_late() {
            return last;
        }
        for (given_only, share) in given_first.iter().flat_map(|given| DISTANCES.map(|share| (*given, share))) {
            let (change, assembly) = change(share);
            let bare = FrameForm { verdict: verdict.word().to_owned(), ..change.of(self.bare) };
            let (proved, faults) = match verdict {
                Verdict::Stable => self.certificate.standing(&bare, &assembly, None),
                _ => self.certificate.falling(&bare, &assembly, mechanism, given_only),
            };
            last = Some(LimitForm::new(of, change, proved));
            if faults.is_empty() || is_late() {
                break;
            }
        }
        last
    }
}

/// Returns the number with the fewest decimals that differs from `value` by at most `width`.
fn roundest(value: f64, width: f64) -> f64 {
    let mut rounded = (0..16).map(|decimals| format!("{value:.decimals$}").parse().unwrap_or(value));
    rounded.find(|near: &f64| (near - value).abs() <= width).unwrap_or(value)
}
