//! [`Influence`]: the largest load factor for each position of a vehicle that travels over a structure.
//!
//! The axles are loads along gravity on the tops of the blocks. While every axle stays on the same edge, the loads are linear
//! in the position x. The loads that the frame carries form a convex set, so 1/λ(x) is convex there, and the least factor λ
//! belongs to a position with an axle at an end of an edge. These positions are analysed, and with a step of the scene
//! others between them, for the curve. No other position has a smaller factor.
//!
//! All positions share the interfaces, the components and the forces of the unloaded frame. Each position needs one
//! linear program; its forces and its mechanism prove the factor like that of a margin.
//!
//! The vehicle belongs to the verdict ([`decide_under_vehicle`]): a frame that stands alone and falls under its vehicle falls, and its
//! results are those with the axles as loads at the governing position. That position is analysed like any scene, so its
//! verdict has its own proof.

use std::sync::Arc;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::answers::Answers;
use super::condition::Condition;
use super::decide::decided_forces;
use super::margin::{END_TOL, End, largest_load_factor};
use super::position::{MAX_POSITIONS, VehiclePosition, positions, track, with_axle_loads, with_axles};
use super::{Analysis, FrameAnalysis, Motion, Options, UndecidedReason, Verdict};
use crate::mechanics::proof::Forces;
use crate::mechanics::scene::{Frame, Scene, Vehicle};
use crate::mechanics::solve::{DeadlineGuard, is_late};
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;

/// The largest load factor for each position of a vehicle. The factor multiplies the weight of the vehicle and all listed
/// loads, like the load factor of a margin.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Influence {
    /// The positions, in the order of travel: first to the right, then to the left.
    pub positions: Vec<VehiclePosition>,
    /// The index of the position with the least factor; `None` if no factor is limited.
    pub governing: Option<usize>,
    /// How the structure begins to fall at this position, just beyond the factor.
    pub mechanism: Vec<Motion>,
}

impl Influence {
    /// Keeps at each position the smaller of two factors: those of two load cases, which have the same positions.
    pub(super) fn keep_least(&mut self, other: &Influence) {
        let least = |own: &Influence| own.governing.and_then(|number| own.positions[number].factor);
        if least(other).is_some_and(|factor| least(self).is_none_or(|own| factor < own)) {
            (self.governing, self.mechanism) = (other.governing, other.mechanism.clone());
        }
        for (own, other) in self.positions.iter_mut().zip(&other.positions) {
            own.factor = own.factor.into_iter().chain(other.factor).reduce(f64::min);
        }
    }
}

/// The vehicle at the position to which the results of a frame belong.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct UnderVehicle {
    /// The index of the position in [`Influence::positions`], if the frame has an influence line.
    pub position: Option<usize>,
    /// The verdict on the frame without the vehicle.
    pub alone: Verdict,
}

/// Decides each frame that stands without the vehicle again, with the vehicle at its positions. Also adds the influence
/// lines, unless `options` request only the verdict. `whole` is the scene with all its frames. `scene` lacks the frames that
/// repeat the state of an earlier frame, and `frames` are its results.
///
/// Returns one entry for each frame. It is the scene with the axles as loads if the results of the frame belong to a position
/// of the vehicle, otherwise `None`.
pub(super) fn decide_under_vehicle(
    (scene, whole): (&Scene, &Scene),
    interfaces: &Interfaces,
    frames: &mut [FrameAnalysis],
    options: &Options,
) -> Vec<Option<Arc<Scene>>> {
    let mut governing = vec![None; frames.len()];
    let Some(vehicle) = &scene.vehicle else { return governing };
    let _until = DeadlineGuard::new(options.deadline);
    for (number, (frame, found)) in scene.frames.iter().zip(frames).enumerate() {
        if found.verdict != Verdict::Stable {
            found.effects.push(effect::report::vehicle(false, None));
            continue;
        }
        let track = track(scene, frame, vehicle);
        let Some(positions) = positions(scene, vehicle, &track) else {
            if track.is_empty() {
                found.notices.push("vehicle: no axle stands on the structure at any position".to_owned());
            } else {
                found.leave_undecided(UndecidedReason::TooManyPositions { most: MAX_POSITIONS });
            }
            found.effects.push(effect::report::vehicle(true, None));
            continue;
        };
        let count = positions.len();
        let influence = influence(scene, frame, interfaces, vehicle, positions.clone());
        // The factor of a position proves that the frame stands there if it is 1 at least. A frame that stands only with its
        // listed loads has no factors, so each position is decided.
        let factor = |own: &usize| influence.as_ref().map_or(Some(0.0), |line| line.positions[*own].factor);
        let below = |own: &usize| factor(own).is_some_and(|factor| factor < 1.0);
        let mut open: Vec<usize> = (0..count).filter(below).collect();
        // The governing position comes first also if others have the same factor but for rounding.
        let governs = |own: &usize| influence.as_ref().is_some_and(|line| line.governing == Some(*own));
        let order = |own: &usize| if governs(own) { 0.0 } else { factor(own).unwrap_or_default() };
        open.sort_by(|a, b| order(a).total_cmp(&order(b)));
        let mut worst: Option<(Verdict, usize, Arc<Scene>, Scene)> = None;
        for own in open {
            if options.is_late() {
                found.leave_undecided(UndecidedReason::Late);
                break;
            }
            let loaded = Arc::new(with_axle_loads(whole, vehicle, &positions[own]));
            let alone = Scene { vehicle: None, frames: vec![frame.clone()], ..Scene::clone(&loaded) };
            let verdict = Analysis::decide(alone.clone().into(), &options.only_verdict()).verdict();
            if verdict > worst.as_ref().map_or(Verdict::Stable, |(worst, ..)| *worst) {
                worst = Some((verdict, own, loaded, alone));
            }
            if verdict == Verdict::Unstable {
                break;
            }
        }
        let mut answers = Answers::of(found, Condition::default());
        let mut worst_position = None;
        if let Some((_, own, loaded, alone)) = worst {
            let under = UnderVehicle { position: influence.is_some().then_some(own), alone: found.verdict };
            let asked = options.removable(false);
            if let Some(results) = Analysis::decide(alone.into(), &asked).frames.pop() {
                *found = Arc::unwrap_or_clone(results);
                answers.also(Answers::of(found, Condition { case: None, position: under.position }));
                worst_position = Some(own);
                found.under_vehicle = Some(under);
                governing[number] = Some(loaded);
            }
        }
        let has_others = options.ask.placement || options.ask.capacity.is_some() || options.ask.wedging;
        if !options.ask.with_needed().margins.is_empty() || has_others {
            let asked = options.removable(false);
            // The worst positions come first: their answers are seldom changed by others.
            let factor = |own: &usize| influence.as_ref().and_then(|line| line.positions[*own].factor);
            let mut order: Vec<usize> = (0..count).filter(|own| worst_position != Some(*own)).collect();
            let rank = |own: &usize| if governs(own) { 0.0 } else { factor(own).unwrap_or(f64::MAX) };
            order.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
            let bare = effect::assembly_of(scene, frame, interfaces);
            let (mut rest, mut examined) = (&order[..], usize::from(worst_position.is_some()));
            while !rest.is_empty() {
                let changes = |own: &usize| {
                    let _until = DeadlineGuard::new(options.deadline);
                    let loaded = with_axles(scene, &bare, vehicle, &positions[*own]).unwrap_or_else(|| bare.clone());
                    let there = with_axle_loads(whole, vehicle, &positions[*own]);
                    options.ask.wedging || is_late() || !answers.hold_for(&there, &loaded)
                };
                #[cfg(feature = "parallel")]
                let next = rest.par_iter().position_first(changes);
                #[cfg(not(feature = "parallel"))]
                let next = rest.iter().position(changes);
                let Some(next) = next else { break };
                if is_late() {
                    found.notices.push(format!(
                        "the time limit ended the search: margins and other answers were examined at {} of {count} \
                         positions of the vehicle",
                        count - rest.len() + next
                    ));
                    break;
                }
                let loaded = with_axle_loads(whole, vehicle, &positions[rest[next]]);
                let alone = Scene { vehicle: None, movements: Vec::new(), frames: vec![frame.clone()], ..loaded };
                if let Some(there) = Analysis::decide(alone.into(), &asked).frames.pop() {
                    answers.also(Answers::of(&there, Condition { case: None, position: Some(rest[next]) }));
                }
                (rest, examined) = (&rest[next + 1..], examined + 1);
            }
            if answers.has_placement_of_blocks() && examined < count {
                found.notices.push(format!(
                    "placement: the tolerances of single blocks were examined without the vehicle and at {examined} of \
                     {count} positions, that of all blocks at each"
                ));
            }
        }
        if !options.verdict_only {
            answers.give_to(whole, found);
            if !found.movements.is_empty() {
                found.notices.push("movements: computed without the vehicle, whose factor is given on its own".into());
            }
        }
        found.effects.retain(|report| report.effect != effect::EffectName::Vehicle);
        found.effects.push(effect::report::vehicle(true, Some(count)));
        found.vehicle = influence.filter(|_| !options.verdict_only);
    }
    governing
}

impl Analysis {
    /// Returns the analysis with scenes without the axles, which a figure of the vehicle draws itself.
    pub(crate) fn without_axles(&self) -> Analysis {
        let mut bare = self.clone();
        for (number, found) in self.frames.iter().enumerate() {
            let Some(line) = found.vehicle.as_ref().filter(|_| found.under_vehicle.is_some()) else { continue };
            let axles = found.under_vehicle.and_then(|under| Some(line.positions.get(under.position?)?.axles.len()));
            let Some(loaded) = bare.of_frames.get_mut(number).map(Arc::make_mut) else { continue };
            let count = loaded.loads.len() - axles.unwrap_or(0).min(loaded.loads.len());
            loaded.loads.truncate(count);
        }
        bare
    }
}

/// Returns the influence line of a frame for these positions. `None` if the frame does not stand without its loads, or
/// after the deadline.
fn influence(
    scene: &Scene,
    frame: &Frame,
    interfaces: &Interfaces,
    vehicle: &Vehicle,
    mut positions: Vec<VehiclePosition>,
) -> Option<Influence> {
    let components = effect::assembly_of(scene, frame, interfaces).components();
    let unloaded = components.iter().map(|own| Some(decided_forces(&own.clone().with_load_factor(0.0))?.0));
    let unloaded: Vec<Forces> = unloaded.collect::<Option<_>>()?;
    // Without an axle, a component has the same factor at every position.
    let pairs = || components.iter().zip(&unloaded);
    let present: Vec<End> = pairs().map(|(own, forces)| largest_load_factor(own, forces)).collect();
    let (mut governing, mut mechanism) = (None, Vec::new());
    for (number, position) in positions.iter_mut().enumerate() {
        if is_late() {
            return None;
        }
        for ((component, forces), present) in pairs().zip(&present) {
            let loaded = with_axles(scene, component, vehicle, position);
            let own = loaded.map_or_else(|| present.clone(), |loaded| largest_load_factor(&loaded, forces));
            let (factor, motion) = match own {
                End::Unbounded => continue,
                End::At { value, mechanism } => (value, mechanism),
                End::Unconfirmed { stands, .. } => (stands, Vec::new()),
            };
            position.factor = Some(position.factor.map_or(factor, |least| least.min(factor)));
            // Of equal factors, such as those of a symmetric structure, the first governs.
            let least =
                governing.and_then(|least: (usize, f64)| (least.1 <= factor * (1.0 + END_TOL)).then_some(least));
            if least.is_none() {
                (governing, mechanism) = (Some((number, factor)), motion);
            }
        }
    }
    Some(Influence { positions, governing: governing.map(|least| least.0), mechanism })
}
