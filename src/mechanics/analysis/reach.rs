//! [`Reached`]: for each single change of a frame, the least amount with which a margin reaches a target.
//!
//! A changed frame must stand in all its *states*: as it is, and at the target, to both sides, in each load case. Forces
//! are loads of their own, while all other loads are fixed: the least amount is the lower end of the interval of their
//! load factor. It is proved like every margin. A motion with which a state falls gives a lower bound for each block, so
//! that only blocks with small bounds are tried.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::capacity::decided;
use super::margin::{End, Interval, MarginKind, Setting, interval_of};
use super::removable::{NotFound, least_hold};
use super::{FrameAnalysis, Options, Verdict, vehicle};
use crate::geometry::{Point, Polygon, Vector};
use crate::mechanics::proof::{Motion, net_power};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::mechanics::solve::{DeadlineGuard, is_late};
use crate::mechanics::statics::assembly::{Assembly, LoadVector};
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::{Interface, Interfaces};
use crate::text::Word;

/// At most this many blocks or pairs of blocks are tried for a change.
const MAX_TRIED: usize = 12;

/// At most this many blocks are examined, in all load cases with and without the target. Each takes about 700 bytes.
const MAX_BLOCKS: usize = 500_000;

/// A value that a margin must reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// [`MarginKind::LoadFactor`], [`MarginKind::Tilt`] or [`MarginKind::HorizontalLoad`].
    pub kind: MarginKind,
    /// The value, in degrees for the tilt.
    pub value: f64,
}

/// What reaches a target.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reached {
    /// The target.
    pub target: Reach,
    /// The worst verdict on the unchanged frame, as it is and at the target.
    pub verdict: Verdict,
    /// The changes of which each one alone reaches the target, and those that cannot. Empty if the frame does not fall.
    pub changes: Vec<Change>,
}

/// The least amount of a single change.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Change {
    /// What changes.
    pub what: ChangeKind,
    /// The changed block, or the two blocks that a tie or a prop connects. Of all blocks that were tried, these need the
    /// least amount.
    pub blocks: Vec<BlockId>,
    /// The least amount, rounded up to three digits: a friction coefficient, a factor, or newtons. `None` if no amount
    /// reaches the target.
    pub least: Option<f64>,
    /// A motion that no amount stops, if one is known.
    pub mechanism: Vec<Motion>,
}

words! {
    /// A single change of a frame.
    #[non_exhaustive]
    pub enum ChangeKind {
        /// One friction coefficient at all joints, if they have the same now.
        #[default]
        Friction = "friction";
        /// A factor on the friction coefficients, as the margin `friction_factor`, if they differ now.
        FrictionFactor = "friction_factor";
        /// A factor on the thickness of a chain of blocks, of which each touches exactly two bodies. The middles of the
        /// joints stay.
        Thickness = "thickness";
        /// More weight on one block, at its centroid.
        Weight = "weight";
        /// A force from outside that holds one block at its centroid, in any direction.
        Hold = "hold";
        /// A tie between the centroids of two blocks.
        Tie = "tie";
        /// A prop between the centroids of two blocks.
        Prop = "prop";
    }
}

/// Finds the changes with which each frame reaches the target, if the options request it.
pub(super) fn add_reach<'f>(
    scene: &Scene,
    frames: impl Iterator<Item = (usize, &'f mut FrameAnalysis)>,
    options: &Options,
) {
    let Some(target) = options.reach else { return };
    let _until = DeadlineGuard::new(options.deadline);
    for (number, found) in frames {
        let count = scene.frames[number].placed.len() * scene.cases.len().max(1) * settings(target).len();
        if count > MAX_BLOCKS {
            found.notices.push(format!(
                "reach: {count} blocks in all load cases, with and without the target, are too many, at most {MAX_BLOCKS} \
                 are examined; give fewer load cases"
            ));
        }
        if count > MAX_BLOCKS || options.is_late() {
            found.reach = Some(Reached { target, verdict: Verdict::Undecided, changes: Vec::new() });
            continue;
        }
        if scene.vehicle.is_some() {
            found.notices.push(
                "reach: the frame was examined without the vehicle and with it at its governing position; check the \
                 changed scene at all positions"
                    .to_owned(),
            );
        }
        let states = scene.alone(number).map(|alone| states(&alone, target)).unwrap_or_default();
        // The frame is also undecided if its verdict depends on gaps.
        let is_open = |verdict: Verdict| verdict == Verdict::Undecided;
        let is_undecided =
            options.is_late() || is_open(found.verdict) || states.iter().any(|state| is_open(state.verdict));
        let worst = states.iter().map(|state| state.verdict).max().unwrap_or(Verdict::Stable);
        let verdict = if is_undecided { Verdict::Undecided } else { worst };
        let search = Search { states };
        let mut changes = Vec::new();
        for what in if verdict == Verdict::Unstable { ChangeKind::all() } else { Vec::new() } {
            match search.change(what) {
                Ok(change) => changes.extend(change),
                Err(NotFound) => {
                    found.notices.push(format!("reach: it is not proved whether any {} suffices", what.word()))
                }
            }
        }
        found.reach = Some(Reached { target, verdict, changes });
    }
}

/// A frame as it is or at the target.
struct State {
    /// The scene in its load case, and what changes at the target.
    scene: Arc<Scene>,
    setting: Setting,
    /// The force of each newton of weight.
    pull: Vector,
    /// The frame with these changes, in which all loads are fixed.
    assembly: Assembly,
    verdict: Verdict,
    /// The motion with which the frame falls, and the power of all forces along it.
    motion: Vec<Motion>,
    velocities: BTreeMap<BlockId, Vector>,
    power: f64,
}

/// Returns the settings in which a frame is examined: as it is, and at the target.
fn settings(target: Reach) -> Vec<Setting> {
    let sides: &[f64] = if target.kind == MarginKind::LoadFactor { &[1.0] } else { &[-1.0, 1.0] };
    let changes = sides.iter().map(|side| (target.kind.about().setting)(side * target.value));
    std::iter::once(Setting::default()).chain(changes).collect()
}

/// Returns the states of a scene with one frame; not all of them after the deadline.
fn states(scene: &Scene, target: Reach) -> Vec<State> {
    let bases: Box<dyn Iterator<Item = (Arc<Scene>, f64)>> = match scene.cases.as_slice() {
        [] => Box::new(std::iter::once((Arc::new(scene.clone()), 1.0))),
        _ => Box::new(scene.in_cases().map(|(case, scene)| (Arc::new(scene), case.weights))),
    };
    let settings = &settings(target);
    // With a vehicle, the change must also suffice at the governing position.
    let bases = bases.flat_map(|(scene, weights)| {
        let loaded = vehicle::at_governing_position(&scene, 0, &Interfaces::new(&scene));
        [Some((scene, weights)), loaded.map(|loaded| (Arc::new(loaded), weights))].into_iter().flatten()
    });
    let each = bases.flat_map(|(scene, weights)| settings.iter().map(move |own| (scene.clone(), weights, *own)));
    each.take_while(|_| !is_late()).map(|(scene, weights, setting)| State::new(scene, weights, setting)).collect()
}

impl State {
    fn new(scene: Arc<Scene>, weights: f64, setting: Setting) -> State {
        let given = effect::assembly_of(&scene, &scene.frames[0], &Interfaces::new(&scene));
        let mut assembly = setting.apply(&given);
        for body in &mut assembly.bodies {
            (body.fixed, body.listed) = (body.given(assembly.load_factor), LoadVector::ZERO);
        }
        let assembly = assembly.with_load_factor(1.0);
        let (verdict, motion) = decided(&assembly.components());
        let power = net_power(&assembly, &motion);
        let velocities = motion.iter().map(|own| (own.block, own.velocity)).collect();
        State { pull: assembly.pull * weights, scene, setting, assembly, verdict, motion, velocities, power }
    }

    fn centre(&self, block: BlockId) -> Point {
        self.scene.blocks[block.0].centroid
    }

    /// Returns the forces of a change with the amount 1.
    fn unit(&self, what: ChangeKind, blocks: &[BlockId]) -> Vec<(BlockId, Vector)> {
        let [a, b] = *blocks else { return blocks.iter().map(|block| (*block, self.pull)).collect() };
        let along = (self.centre(b) - self.centre(a)).try_normalize(0.0).unwrap_or_default();
        let toward = if what == ChangeKind::Tie { along } else { -along };
        vec![(a, toward), (b, -toward)]
    }

    /// Returns a lower bound for the amount of a change; infinite if no amount stops the motion.
    fn bound(&self, what: ChangeKind, blocks: &[BlockId]) -> f64 {
        if is_late() {
            return f64::INFINITY;
        }
        let against = |(block, force): &(BlockId, Vector)| {
            let velocity = self.velocities.get(block).copied().unwrap_or_default();
            if what == ChangeKind::Hold { velocity.norm() } else { -velocity.dot(force) }
        };
        let rate: f64 = self.unit(what, blocks).iter().map(against).sum();
        if rate > 1e-9 { self.power / rate } else { f64::INFINITY }
    }

    /// Returns the interval of a margin while forces on blocks act too, which the load factor multiplies.
    fn interval(&self, kind: MarginKind, forces: &[(BlockId, Vector)]) -> Interval {
        let mut assembly = self.assembly.clone();
        for body in &mut assembly.bodies {
            let own = forces.iter().filter(|(block, _)| *block == body.block).map(|(_, force)| force);
            body.listed.force = own.sum();
        }
        interval_of(&assembly.with_load_factor(1.0), kind)
    }
}

struct Search {
    states: Vec<State>,
}

impl Search {
    /// Finds the least amount of a change. `None` if the change does not apply to this frame.
    fn change(&self, what: ChangeKind) -> Result<Option<Change>, NotFound> {
        let mut change = Change { what, blocks: Vec::new(), least: None, mechanism: Vec::new() };
        let placed = &self.states[0].scene.frames[0].placed;
        match what {
            ChangeKind::Friction | ChangeKind::FrictionFactor => {
                let contacts = || self.states.iter().flat_map(|state| &state.assembly.contacts);
                let first = contacts().next().map(|contact| contact.friction);
                let is_alike = contacts().all(|own| own.is_factored && Some(own.friction) == first);
                let kind = if is_alike { MarginKind::Friction } else { MarginKind::FrictionFactor };
                if is_alike != (what == ChangeKind::Friction) {
                    return Ok(None);
                }
                let each = self.states.iter().map(|state| state.interval(kind, &[]));
                let each: Vec<Interval> = each.collect();
                change.least = least_of_all(&each, 1.0)?;
                let exclusions =
                    each.into_iter().filter_map(|own| if let Interval::Empty(own) = own { Some(own) } else { None });
                change.mechanism = exclusions.flatten().next().map(|own| own.mechanism).unwrap_or_default();
            }
            ChangeKind::Thickness => {
                change.least = self.thickness();
                return Ok(change.least.map(|_| change));
            }
            ChangeKind::Weight | ChangeKind::Hold => {
                self.choose(&mut change, placed.iter().map(|block| vec![*block]).collect())?;
            }
            ChangeKind::Tie | ChangeKind::Prop => {
                let pairs = (0..placed.len()).flat_map(|k| (0..k).map(move |other| vec![placed[other], placed[k]]));
                let pairs: Vec<_> = pairs.collect();
                if pairs.is_empty() {
                    return Ok(None);
                }
                self.choose(&mut change, pairs)?;
            }
        }
        Ok(Some(change))
    }

    /// The states that fall.
    fn falling(&self) -> impl Iterator<Item = &State> {
        self.states.iter().filter(|state| state.verdict == Verdict::Unstable)
    }

    /// Finds the blocks of which a change needs the least amount.
    fn choose(&self, change: &mut Change, candidates: Vec<Vec<BlockId>>) -> Result<(), NotFound> {
        let stops = |state: &State, own: &Vec<BlockId>| state.bound(change.what, own).is_finite();
        let is_free = |state: &&State| !candidates.iter().any(|own| stops(state, own));
        change.mechanism = self.falling().find(is_free).map(|state| state.motion.clone()).unwrap_or_default();
        let bound = |own: &Vec<BlockId>| self.falling().map(|state| state.bound(change.what, own)).fold(0.0, f64::max);
        let mut open: Vec<(f64, Vec<BlockId>)> = candidates.into_iter().map(|own| (bound(&own), own)).collect();
        open.retain(|(bound, _)| bound.is_finite());
        if is_late() {
            return Err(NotFound);
        }
        open.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut is_missing = open.len() > MAX_TRIED;
        for (bound, blocks) in open.into_iter().take(MAX_TRIED) {
            if change.least.is_some_and(|least| bound >= least) {
                break;
            }
            match self.least(change.what, &blocks, bound) {
                Ok(Some(own)) if change.least.is_none_or(|least| own < least) => {
                    (change.blocks, change.least) = (blocks, Some(own));
                }
                Ok(_) => {}
                Err(NotFound) => is_missing = true,
            }
        }
        if change.least.is_none() && is_missing { Err(NotFound) } else { Ok(()) }
    }

    /// Returns the least amount of a change of some blocks. A weight acts in all states; a hold, a tie or a prop takes
    /// as much of its force as a state needs. `size` is of the order of the amount.
    fn least(&self, what: ChangeKind, blocks: &[BlockId], size: f64) -> Result<Option<f64>, NotFound> {
        if what == ChangeKind::Hold {
            let mut least: f64 = 0.0;
            for state in self.falling() {
                let points = blocks.iter().map(|block| (*block, state.centre(*block))).collect();
                let Some(help) = least_hold(&state.assembly, points, &state.motion)? else { return Ok(None) };
                least = least.max(help.force);
            }
            return Ok(Some(rounded_up(least)));
        }
        let acts_always = what == ChangeKind::Weight;
        let states = self.states.iter().filter(|state| acts_always || state.verdict == Verdict::Unstable);
        let each = states.map(|state| {
            let forces: Vec<_> = state.unit(what, blocks).iter().map(|(b, force)| (*b, *force * size)).collect();
            match state.interval(MarginKind::LoadFactor, &forces) {
                Interval::Between { low, .. } if !acts_always => Interval::Between { low, high: End::Unbounded },
                interval => interval,
            }
        });
        least_of_all(&each.collect::<Vec<_>>(), size)
    }

    /// Returns the least factor on the thickness, in steps of 0.01 up to 4. `None` if there is none, or if the frame is no
    /// chain.
    fn thickness(&self) -> Option<f64> {
        let stands = |hundredths: u32| {
            self.states.iter().all(|state| {
                let scene = thickened(&state.scene, f64::from(hundredths) * 1e-2);
                scene.is_some_and(|scene| State::new(scene.into(), 1.0, state.setting).verdict == Verdict::Stable)
            })
        };
        let mut found = [125, 150, 200, 300, 400].into_iter().find(|factor| stands(*factor))?;
        let mut falls = 100;
        while found - falls > 1 {
            let middle = u32::midpoint(falls, found);
            *(if stands(middle) { &mut found } else { &mut falls }) = middle;
        }
        Some(f64::from(found) * 1e-2)
    }
}

/// Returns the least value in all intervals, rounded up, times the size of its unit. `None` if there is no such value.
fn least_of_all(intervals: &[Interval], size: f64) -> Result<Option<f64>, NotFound> {
    let mut low: f64 = 0.0;
    for interval in intervals {
        match interval {
            Interval::Empty(_) => return Ok(None),
            Interval::Undecided | Interval::Between { low: End::Unconfirmed { .. }, .. } => return Err(NotFound),
            Interval::Between { low: own, .. } => low = low.max(own.value().unwrap_or(0.0)),
        }
    }
    let amount = rounded_up(low * size);
    match amount {
        _ if intervals.iter().all(|interval| interval.contains(amount / size)) => Ok(Some(amount)),
        _ if intervals.iter().any(|interval| interval.excludes(low)) => Ok(None),
        _ => Err(NotFound),
    }
}

/// Rounds a positive number up to three significant digits. A margin has a relative error of 10⁻⁶.
fn rounded_up(value: f64) -> f64 {
    let step = libm::exp10(2.0 - libm::floor(libm::log10(value.max(1e-300))));
    libm::ceil(value * (1.0 + 1e-6) * step) / step
}

/// Returns a scene in which the joints of a chain are longer by a factor, about their middles. `None` if some block has
/// other corners than those of its two joints.
fn thickened(scene: &Scene, factor: f64) -> Option<Scene> {
    let interfaces = Interfaces::new(scene);
    let joints = interfaces.in_frame(&scene.frames[0]);
    let mut changed = scene.clone();
    for block in &scene.frames[0].placed {
        let own: Vec<_> = joints.iter().filter(|joint| joint.bodies.contains(&BodyId::Block(*block))).collect();
        let body = &scene.blocks[block.0].body;
        let corners = body.polygon.outline();
        if own.len() != 2 || corners.len() != 4 || body.circle.is_some() || body.cells.is_some() {
            return None;
        }
        let ends = || own.iter().flat_map(|joint| joint.ends.map(|end| (*joint, end)));
        let moved = |corner: &Point| {
            let is_here = |at: &(&&Interface, Point)| (at.1 - corner).norm() <= 1e-4 * at.0.length();
            ends().find(is_here).map(|(joint, end)| joint.middle() + (end - joint.middle()) * factor)
        };
        let polygon = Polygon::new(corners.iter().map(moved).collect::<Option<_>>()?, Vec::new()).ok()?;
        let new = &mut changed.blocks[block.0];
        if new.weighs_by_area {
            new.weight *= polygon.area() / body.area();
        }
        new.body.polygon = polygon;
        if !new.has_own_centre {
            let shift = new.body.centroid() - new.centroid;
            new.centroid += shift;
            changed
                .loads
                .iter_mut()
                .filter(|load| load.block == *block && load.at_centroid)
                .for_each(|l| l.at += shift);
        }
    }
    Some(changed)
}
