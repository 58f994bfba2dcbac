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

use super::answers::Answers;
use super::condition::Condition;
use super::decide::decided_forces;
use super::margin::{END_TOL, End, largest_load_factor};
use super::{Analysis, FrameAnalysis, Motion, Options, UndecidedReason, Verdict};
use crate::geometry::{Edge, Point, Vector, quarter_turn};
use crate::mechanics::proof::Forces;
use crate::mechanics::scene::{BlockId, Frame, Load, Scene, Vehicle};
use crate::mechanics::solve::{DeadlineGuard, is_late};
use crate::mechanics::statics::assembly::{Assembly, load_about};
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;

/// More positions than this are not analysed.
const MAX_POSITIONS: usize = 5000;
/// More positions than this in one direction are not added for a `step`.
const MAX_STEPS: f64 = 1000.0;
/// Two ends of edges this close to each other, relative to the length of the track, are one point.
const SAME_PLACE: f64 = 1e-9;

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

/// A position of a vehicle.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct VehiclePosition {
    /// The coordinate of the first axle, metres: x if gravity points downwards.
    pub at: f64,
    /// Whether the vehicle travels to the right.
    pub to_right: bool,
    /// Each axle on the structure: its index, the block below it, and the point at which it stands.
    pub axles: Vec<(usize, BlockId, Point)>,
    /// The largest factor with which the frame is proved to stand; `None` if it may grow without limit.
    pub factor: Option<f64>,
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
        if let Some((_, own, loaded, alone)) = worst {
            let under = UnderVehicle { position: influence.is_some().then_some(own), alone: found.verdict };
            let mut results = Analysis::decide(alone.into(), options).frames;
            if let Some(results) = results.pop() {
                let results = Arc::unwrap_or_clone(results);
                let there = Condition { case: None, position: under.position };
                *found = Answers::of(&results, there).in_place_of(results);
                found.under_vehicle = Some(under);
                governing[number] = Some(loaded);
            }
        }
        if found.under_vehicle.is_none() {
            if let Some(position) = influence.as_ref().and_then(|line| line.governing)
                && (found.margins.is_some() || found.placement.is_some())
            {
                // These answers must also hold at the governing position.
                let loaded = with_axle_loads(whole, vehicle, &positions[position]);
                let alone = Scene { vehicle: None, frames: vec![frame.clone()], ..loaded };
                let asked = Options {
                    capacity: None,
                    sensitivity: None,
                    removable: false,
                    wedging: false,
                    reach: None,
                    margins: found.margins.is_some(),
                    margin_kinds: options.wanted_margins().unwrap_or_default(),
                    ..*options
                };
                let there = Analysis::decide(alone.into(), &asked).frames.pop().map(Arc::unwrap_or_clone);
                if let Some(mut there) = there {
                    there.removable.clone_from(&found.removable);
                    let mut answers = Answers::of(found, Condition::default());
                    answers.also(Answers::of(&there, Condition { case: None, position: Some(position) }));
                    answers.give_to(whole, found);
                    found.notices.push(format!(
                        "margins, placement: examined without the vehicle and at its governing position, not at {}",
                        if count == 2 { "the other one".to_owned() } else { format!("the other {}", count - 1) }
                    ));
                }
            }
            let answers = [
                ("sensitivity", found.sensitivity.is_some()),
                ("capacity", found.capacity.is_some()),
                ("movements", !found.movements.is_empty()),
                ("forces of removable blocks", found.removable.is_some()),
            ];
            let bare = answers.into_iter().filter(|(_, is_there)| *is_there).map(|(word, _)| word);
            let bare = bare.collect::<Vec<_>>().join(", ");
            if !bare.is_empty() {
                found.notices.push(format!("{bare}: computed without the vehicle, whose factor is given on its own"));
            }
        }
        found.effects.retain(|report| report.effect != effect::EffectName::Vehicle);
        found.effects.push(effect::report::vehicle(true, Some(count)));
        found.vehicle = influence.filter(|_| !options.verdict_only);
    }
    governing
}

/// Returns a scene with the axles of its vehicle as loads at the governing position of one of its frames. `None` if it has
/// no vehicle, or if the vehicle has no least factor there.
pub(super) fn at_governing_position(scene: &Scene, number: usize, interfaces: &Interfaces) -> Option<Scene> {
    let (vehicle, frame) = (scene.vehicle.as_ref()?, scene.frames.get(number)?);
    let positions = positions(scene, vehicle, &track(scene, frame, vehicle))?;
    let influence = influence(scene, frame, interfaces, vehicle, positions)?;
    Some(with_axle_loads(scene, vehicle, &influence.positions[influence.governing?]))
}

/// Returns a scene with the axles of its vehicle as loads at a position, and without the vehicle. `None` if it has none.
pub(super) fn scene_with_axles(scene: &Scene, position: &VehiclePosition) -> Option<Scene> {
    let loaded = with_axle_loads(scene, scene.vehicle.as_ref()?, position);
    Some(Scene { vehicle: None, ..loaded })
}

impl Analysis {
    /// Returns the analysis with scenes without the axles, which a figure of the vehicle draws itself.
    pub(crate) fn without_axles(&self) -> Analysis {
        let mut bare = self.clone();
        let Some(conditions) = &mut bare.cases else { return bare };
        for (number, found) in self.frames.iter().enumerate() {
            let Some(line) = found.vehicle.as_ref().filter(|_| found.under_vehicle.is_some()) else { continue };
            let axles = found.under_vehicle.and_then(|under| Some(line.positions.get(under.position?)?.axles.len()));
            let loaded = conditions.scene_mut(number);
            let count = loaded.loads.len() - axles.unwrap_or(0).min(loaded.loads.len());
            loaded.loads.truncate(count);
        }
        bare
    }
}

/// Returns a scene whose loads also contain the axles of a vehicle at a position.
fn with_axle_loads(scene: &Scene, vehicle: &Vehicle, position: &VehiclePosition) -> Scene {
    let first = scene.loads.iter().map(|load| load.entry + 1).max().unwrap_or(0);
    let mut loads = scene.loads.clone();
    loads.extend(position.axles.iter().enumerate().map(|(number, (axle, block, at))| Load {
        block: *block,
        force: scene.down() * vehicle.axles[*axle].weight,
        at: *at,
        torque: 0.0,
        is_fixed: false,
        entry: first + number,
        spread: None,
        at_centroid: false,
    }));
    Scene { loads, ..scene.clone() }
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

/// Returns a component with the axles on its blocks; `None` if no axle stands on them.
fn with_axles(scene: &Scene, component: &Assembly, vehicle: &Vehicle, position: &VehiclePosition) -> Option<Assembly> {
    let body_of = |block: BlockId| component.bodies.binary_search_by_key(&block, |body| body.block).ok();
    let mut loaded: Option<Assembly> = None;
    for (axle, block, at) in &position.axles {
        if let Some(number) = body_of(*block) {
            let body = &mut loaded.get_or_insert_with(|| component.clone()).bodies[number];
            let load = load_about(body.centroid, *at, scene.down() * vehicle.axles[*axle].weight, 0.0);
            body.listed = body.listed.plus(load);
        }
    }
    loaded
}

/// A part of the track: an edge of a block between two coordinates.
#[derive(Clone, Copy, Debug)]
struct Top {
    from: f64,
    to: f64,
    block: BlockId,
    edge: Edge,
}

/// Returns the edges of the blocks of the vehicle that are seen from above, from left to right. Other blocks hide what is
/// below them.
fn track(scene: &Scene, frame: &Frame, vehicle: &Vehicle) -> Vec<Top> {
    let across = quarter_turn(scene.down());
    let place = |point: Point| across.dot(&point.coords);
    let is_named = |block: &BlockId| vehicle.over.is_empty() || vehicle.over.contains(block);
    let mut edges: Vec<Top> = Vec::new();
    for block in &frame.placed {
        // The stone is on the left of an edge, so the edges that are seen from above run to the left.
        let of_block = scene.blocks[block.0].body.polygon.edges();
        let tops = of_block.map(|edge| Top { from: place(edge.to), to: place(edge.from), block: *block, edge });
        edges.extend(tops.filter(|top| top.from < top.to));
    }
    edges.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut places: Vec<f64> = edges.iter().flat_map(|top| [top.from, top.to]).collect();
    places.sort_by(f64::total_cmp);
    let length = places.last().zip(places.first()).map_or(0.0, |(last, first)| last - first);
    places.dedup_by(|b, a| *b - *a <= SAME_PLACE * length);
    let (mut track, mut open, mut next): (Vec<Top>, Vec<Top>, usize) = (Vec::new(), Vec::new(), 0);
    for ends in places.windows(2) {
        let middle = 0.5 * (ends[0] + ends[1]);
        while next < edges.len() && edges[next].from < middle {
            open.push(edges[next]);
            next += 1;
        }
        open.retain(|top| top.to > middle);
        let height = |top: &Top| -scene.down().dot(&top.point(across, middle).coords);
        let highest = open.iter().max_by(|a, b| height(a).total_cmp(&height(b)));
        let Some(highest) = highest.filter(|top| is_named(&top.block)) else { continue };
        match track.last_mut() {
            Some(last) if last.edge == highest.edge && last.to == ends[0] => last.to = ends[1],
            _ => track.push(Top { from: ends[0], to: ends[1], ..*highest }),
        }
    }
    track
}

impl Top {
    /// Returns the point of the edge at a coordinate along `across`.
    fn point(&self, across: Vector, at: f64) -> Point {
        let long = self.edge.to - self.edge.from;
        self.edge.from + long * ((at - across.dot(&self.edge.from.coords)) / across.dot(&long))
    }
}

/// Returns the positions of a vehicle that are analysed; `None` if there are none or too many.
fn positions(scene: &Scene, vehicle: &Vehicle, track: &[Top]) -> Option<Vec<VehiclePosition>> {
    let (first, last) = (track.first()?.from, track.last()?.to);
    // Most axles have a position of their own at each end of an edge.
    if vehicle.axles.len() * track.len() > 100 * MAX_POSITIONS {
        return None;
    }
    let across = quarter_turn(scene.down());
    let mut positions = Vec::new();
    for to_right in [true, false] {
        let behind = if to_right { 1.0 } else { -1.0 };
        if !to_right && (!vehicle.both_ways || vehicle.axles.len() < 2) {
            continue;
        }
        let offsets = vehicle.axles.iter().map(|axle| behind * axle.offset);
        // Each place with the side on which an axle at an end of an edge stands: -1 to the left, 1 to the right.
        let ends = track.iter().flat_map(|top| [(top.from, 1.0), (top.to, -1.0)]);
        let ends: Vec<(f64, f64)> = ends.collect();
        let at_ends = |offset: f64| ends.iter().map(move |(end, side)| (end + offset, *side));
        let mut places: Vec<(f64, f64)> = offsets.clone().flat_map(at_ends).collect();
        let [least, most] = [f64::min, f64::max].map(|of| offsets.clone().fold(0.0, of));
        let count = (last + most - first - least) / vehicle.step;
        // Positions between the ends only make the line smoother, so too many of them are left out.
        if vehicle.step > 0.0 && count <= MAX_STEPS {
            places.extend((0..=count as usize).map(|k| (first + least + k as f64 * vehicle.step, 1.0)));
        }
        places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        places.dedup();
        if !to_right {
            places.reverse();
        }
        positions.extend(places.into_iter().map(|(at, side)| {
            let axles = vehicle.axles.iter().enumerate();
            let axles = axles.filter_map(|(number, axle)| {
                let place = at - behind * axle.offset + side * SAME_PLACE * (last - first);
                let top = track[..track.partition_point(|top| top.from <= place)].last()?;
                let inside = (at - behind * axle.offset).clamp(top.from, top.to);
                (place <= top.to).then(|| (number, top.block, top.point(across, inside)))
            });
            VehiclePosition { at, to_right, axles: axles.collect(), factor: None }
        }));
    }
    positions.retain(|position: &VehiclePosition| !position.axles.is_empty());
    (!positions.is_empty() && positions.len() <= MAX_POSITIONS).then_some(positions)
}
