//! Resolves loads, load cases, movements of parts of the ground, and a vehicle. The pressure of one entry becomes one load
//! for each edge of a block on which it acts.

use std::collections::BTreeMap;

use super::Resolution;
use super::free_edges::{FreeEdges, Stretch};
use crate::geometry::{Point, Vector, cross, quarter_turn, range_of, sin_cos_degrees};
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::format::{BlockSide, DepthEntry, FixedLoad, LoadEntry, PressureEntry};
use crate::mechanics::scene::name::Names;
use crate::mechanics::scene::number::{at_least_zero, is_amount, is_sane};
use crate::mechanics::scene::{Axle, Block, BlockId, Case, Ground, Load, Movement, Spread, Vehicle, problem};
use crate::read::Trail;

/// The largest number of edges on which the pressures of a scene may act.
const MAX_PRESSED_EDGES: usize = 100_000;

/// An outward normal belongs to a side if it is at most 45° from the direction of the side. Normals at exactly 45° are
/// rounded.
const MIN_COSINE: f64 = std::f64::consts::FRAC_1_SQRT_2 - 1e-9;

impl Resolution<'_> {
    /// Returns the loads of the file, in its order, in the units of the file.
    pub(super) fn loads(
        &self,
        findings: &mut Findings,
        names: &Names<'_>,
        ground: &[Option<Ground>],
        blocks: &[Option<Block>],
    ) -> Vec<Load> {
        let top = Trail::Top;
        let list = top.key("loads");
        let mut loads = Vec::new();
        let mut free = None;
        for (number, entry) in self.file.loads.iter().enumerate() {
            let at = list.index(number);
            let named = entry.block.as_ref().map(|block| names.find(findings, &at.key("block"), block).map(BlockId));
            let fixed = self.fixed(entry.fixed);
            if let Some(pressure) = &entry.pressure {
                if !is_one_pressure(findings, &at, entry) {
                    continue;
                }
                let Some(pressure) = self.pressure(findings, &at.key("pressure"), pressure) else { continue };
                let stretches = match (entry.side, &entry.between[..]) {
                    (Some(side), _) => {
                        let Some(Some(block)) = named else { continue };
                        let Some(given) = blocks[block.0].as_ref() else { continue };
                        let found = side_of(given, block, side);
                        if found.is_empty() {
                            findings.add(&at.key("side"), problem::message::no_such_side(&self.ids[block.0], side));
                        }
                        found
                    }
                    (None, [from, to]) => {
                        if ![from, to].iter().all(|point| is_sane(findings, &at.key("between"), &point[..])) {
                            continue;
                        }
                        let ends = [from, to].map(|point| Point::new(point[0], point[1]));
                        let free = free.get_or_insert_with(|| FreeEdges::new(ground, blocks));
                        match free.between(ends) {
                            Ok(found) => found,
                            Err(apart) => {
                                findings.add(&at.key("between"), problem::message::not_on_free_edges(apart));
                                continue;
                            }
                        }
                    }
                    _ => continue,
                };
                if loads.len() + stretches.len() > MAX_PRESSED_EDGES {
                    findings.add(&at, problem::message::too_many_pressed(MAX_PRESSED_EDGES));
                    return loads;
                }
                loads.extend(stretches.iter().filter_map(|stretch| pressure.on(stretch, number, fixed)));
                continue;
            }
            if entry.side.is_some() || !entry.between.is_empty() {
                findings.add(&at, problem::message::no_pressure());
                continue;
            }
            let (force, torque) = (entry.force.unwrap_or([0.0, 0.0]), entry.torque.unwrap_or(0.0));
            is_amount(findings, &at.key("force"), &force);
            is_amount(findings, &at.key("torque"), &[torque]);
            if let Some(point) = entry.at {
                is_sane(findings, &at.key("at"), &point);
            }
            if named.is_none() {
                findings.add(&at, problem::message::load_without_block());
            }
            let Some(Some(block)) = named else { continue };
            let centroid = blocks[block.0].as_ref().map_or(Point::origin(), |block| block.centroid);
            loads.push(Load {
                block,
                force: Vector::new(force[0], force[1]),
                at: entry.at.map_or(centroid, |p| Point::new(p[0], p[1])),
                torque,
                is_fixed: fixed.0,
                fixed_along: fixed.1,
                entry: number,
                spread: None,
                at_centroid: entry.at.is_none(),
            });
        }
        loads
    }

    /// Returns whether all of a load is fixed. If only one part of it is, also returns the direction of this part.
    fn fixed(&self, entry: Option<FixedLoad>) -> (bool, Option<Vector>) {
        match entry {
            None => (false, None),
            Some(FixedLoad::All(all)) => (all, None),
            Some(FixedLoad::Part(part)) => {
                let [x, y] = self.file.gravity.unwrap_or([0.0, -1.0]);
                (false, Some(part.direction(Vector::new(x, y))))
            }
        }
    }

    /// Returns the load cases of the file.
    pub(super) fn cases(&self, findings: &mut Findings) -> Vec<Case> {
        let top = Trail::Top;
        let list = top.key("cases");
        let hidden = findings.unread.hides_names("loads", self.load_ids.len());
        let names = Names::new("load", self.load_ids.iter().map(String::as_str).collect(), hidden);
        let mut cases = Vec::new();
        for (number, entry) in self.file.cases.iter().enumerate() {
            let at = list.index(number);
            let weights = at_least_zero(findings, &at, "weights", entry.weights).unwrap_or(1.0);
            let mut loads = vec![if entry.loads.is_some() { 0.0 } else { 1.0 }; self.load_ids.len()];
            for (name, factor) in entry.loads.iter().flat_map(|map| &map.0) {
                let at = at.key("loads");
                let at = at.key(name);
                is_amount(findings, &at, &[*factor]);
                if let Some(load) = names.find(findings, &at, name) {
                    loads[load] = *factor;
                }
            }
            cases.push(Case { id: entry.id.clone(), weights, loads });
        }
        cases
    }

    /// Checks the numbers of a pressure, and returns it in the units of the file. `None` if a number is not valid.
    fn pressure<'p>(&self, findings: &mut Findings, at: &Trail<'_>, entry: &'p PressureEntry) -> Option<Pressure<'p>> {
        let is_valid = match entry {
            PressureEntry::Uniform(pressure) => is_amount(findings, at, &[*pressure]),
            PressureEntry::Linear(ends) => is_amount(findings, at, ends),
            PressureEntry::ByDepth(depth) => {
                let angle = depth.friction_angle.unwrap_or(0.0);
                let is_steep = !(-90.0..=90.0).contains(&angle);
                if is_steep {
                    findings.add(&at.key("friction_angle"), problem::message::friction_angle(angle));
                }
                let is_known = is_sane(findings, &at.key("surface"), &[depth.surface])
                    & at_least_zero(findings, at, "unit_weight", Some(depth.unit_weight)).is_some()
                    & at_least_zero(findings, at, "coefficient", Some(depth.coefficient.unwrap_or(1.0))).is_some();
                is_known && !is_steep
            }
        };
        // A pressure is a force per square metre. Lengths and the thickness are in the length unit of the file.
        let metre = self.units.length().size;
        is_valid.then_some(Pressure { entry, metre, per_length: self.thickness * metre * metre })
    }
}

/// True if an entry with a pressure has exactly the keys that it needs. Reports the first key that is wrong.
fn is_one_pressure(findings: &mut Findings, at: &Trail<'_>, entry: &LoadEntry) -> bool {
    let other = [("force", entry.force.is_some()), ("at", entry.at.is_some()), ("torque", entry.torque.is_some())];
    let wording = if let Some((key, _)) = other.into_iter().find(|(_, is_given)| *is_given) {
        problem::outline::two_outlines("pressure", key)
    } else if entry.side.is_some() && !entry.between.is_empty() {
        problem::outline::two_outlines("side", "between")
    } else if entry.side.is_some() && entry.block.is_none() {
        problem::message::load_without_block()
    } else if entry.side.is_none() && entry.between.len() != 2 {
        problem::message::pressure_without_place(entry.between.len())
    } else {
        return true;
    };
    findings.add(at, wording);
    false
}

/// Returns the edges of a block on one side: from its lower to its upper end, or from its left to its right end.
fn side_of(block: &Block, id: BlockId, side: BlockSide) -> Vec<Stretch> {
    let (outward, along) = match side {
        BlockSide::Left => (Vector::new(-1.0, 0.0), Vector::new(0.0, 1.0)),
        BlockSide::Right => (Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)),
        BlockSide::Top => (Vector::new(0.0, 1.0), Vector::new(1.0, 0.0)),
        BlockSide::Bottom => (Vector::new(0.0, -1.0), Vector::new(1.0, 0.0)),
    };
    let edges: Vec<_> = block.body.polygon.edges().filter(|edge| edge.outward().dot(&outward) >= MIN_COSINE).collect();
    let place = |point: Point| point.coords.dot(&along);
    let ends = edges.iter().flat_map(|edge| [place(edge.from), place(edge.to)]);
    let (low, high) = range_of(ends);
    let share = |point: Point| if high > low { (place(point) - low) / (high - low) } else { 0.0 };
    let stretches = edges.iter();
    stretches
        .map(|edge| Stretch { block: id, ends: [edge.from, edge.to], shares: [share(edge.from), share(edge.to)] })
        .collect()
}

/// A pressure, in the units of the file.
struct Pressure<'p> {
    entry: &'p PressureEntry,
    /// The metres of one unit of length.
    metre: f64,
    /// The force per unit of length along an edge that a pressure of 1 exerts.
    per_length: f64,
}

impl Pressure<'_> {
    /// Returns the load that the pressure exerts on a part of an edge. `None` if it does not press there.
    fn on(&self, stretch: &Stretch, entry: usize, fixed: (bool, Option<Vector>)) -> Option<Load> {
        let [mut from, mut to] = stretch.ends;
        let pressures = match self.entry {
            PressureEntry::Uniform(pressure) => [*pressure; 2],
            PressureEntry::Linear([first, last]) => stretch.shares.map(|share| first + (last - first) * share),
            PressureEntry::ByDepth(depth) => {
                [from, to] = below(depth.surface, [from, to])?;
                let factor = depth.unit_weight * depth.coefficient.unwrap_or(1.0) * self.metre;
                [from, to].map(|point| factor * (depth.surface - point.y).max(0.0))
            }
        };
        let edge = to - from;
        let length = edge.norm();
        let direction = self.direction(edge / length);
        let [first, last] = pressures.map(|pressure| pressure * self.per_length);
        if first == 0.0 && last == 0.0 {
            return None;
        }
        // The resultant of a trapezium acts at its centroid. If the pressure changes its sign along the edge, this point
        // may lie outside the edge, so a force at the middle and a torque replace it.
        let has_one_sign = first * last >= 0.0;
        let share = if has_one_sign { (first + 2.0 * last) / (3.0 * (first + last)) } else { 0.5 };
        let about_middle = (last - first) * length * length / 12.0 * cross(edge / length, direction);
        Some(Load {
            block: stretch.block,
            force: direction * (0.5 * (first + last) * length),
            at: from + edge * share,
            torque: if has_one_sign { 0.0 } else { about_middle },
            is_fixed: fixed.0,
            fixed_along: fixed.1,
            entry,
            spread: Some(Spread { ends: [from, to], force: [direction * first, direction * last] }),
            at_centroid: false,
        })
    }

    /// Returns the unit direction of the pressure on an edge with the unit direction `along`, whose block is on its left.
    fn direction(&self, along: Vector) -> Vector {
        let inward = quarter_turn(along);
        let angle = match self.entry {
            PressureEntry::ByDepth(DepthEntry { friction_angle: Some(angle), .. }) => *angle,
            _ => 0.0,
        };
        // Earth that settles drags an edge down along its slope. A level edge is not dragged.
        let down = if along.y > 0.0 { -along } else { along };
        let drag = if along.y == 0.0 { 0.0 } else { angle };
        let (sin, cos) = sin_cos_degrees(drag);
        inward * cos + down * sin
    }
}

/// Returns the part of an edge below the height `surface`; `None` if there is none.
fn below(surface: f64, [from, to]: [Point; 2]) -> Option<[Point; 2]> {
    let at_surface = || from + (to - from) * ((surface - from.y) / (to.y - from.y));
    match (from.y < surface, to.y < surface) {
        (true, true) => Some([from, to]),
        (true, false) => Some([from, at_surface()]),
        (false, true) => Some([at_surface(), to]),
        (false, false) => None,
    }
}

impl Resolution<'_> {
    /// Reports ids of parts of the ground that are empty, reserved, or also the id of a block or of another part.
    pub(super) fn check_ground_ids(&self, findings: &mut Findings) {
        let top = Trail::Top;
        let (blocks, list) = (top.key("blocks"), top.key("ground"));
        let given = || self.file.ground.iter().enumerate().filter_map(|(i, part)| Some((i, part.id.as_deref()?)));
        if given().next().is_none() {
            return;
        }
        let mut first: BTreeMap<&str, Trail<'_>> = BTreeMap::new();
        for (i, id) in self.ids.iter().enumerate() {
            first.entry(id).or_insert(blocks.index(i));
        }
        for (i, id) in given() {
            let entry = list.index(i);
            let at = entry.key("id");
            match (id, first.get(id)) {
                ("", _) => findings.add(&at, problem::message::empty_id("part of the ground")),
                ("ground", _) => findings.add(&at, problem::message::reserved_id("part of the ground")),
                (id, Some(other)) => {
                    findings.add(&at, problem::message::id_twice("body", id, &other.path().to_string()));
                }
                (id, None) => {
                    first.insert(id, list.index(i));
                }
            }
        }
    }

    pub(super) fn movements(&self, findings: &mut Findings, ground: &[Option<Ground>]) -> Vec<Movement> {
        if self.file.movements.is_empty() {
            return Vec::new();
        }
        let top = Trail::Top;
        let list = top.key("movements");
        let parts = self.file.ground.iter().enumerate();
        let (numbers, ids): (Vec<usize>, Vec<&str>) = parts.filter_map(|(i, g)| Some((i, g.id.as_deref()?))).unzip();
        let names = Names::new("ground id", ids, findings.unread.hides_names("ground", self.file.ground.len()));
        let mut movements = Vec::new();
        for (i, entry) in self.file.movements.iter().enumerate() {
            let at = list.index(i);
            let [x, y] = entry.translation.unwrap_or([0.0, 0.0]);
            let degrees = entry.rotation.unwrap_or(0.0);
            let sound = is_amount(findings, &at.key("translation"), &[x, y])
                & is_amount(findings, &at.key("rotation"), &[degrees])
                & entry.about.is_none_or(|about| is_sane(findings, &at.key("about"), &about));
            if sound && [x, y, degrees] == [0.0; 3] {
                findings.add(&at, problem::message::no_movement());
            }
            let number = names.find(findings, &at.key("ground"), &entry.ground).map(|found| numbers[found]);
            let Some((number, part)) = number.and_then(|n| Some((n, ground.get(n)?.as_ref()?))) else { continue };
            movements.push(Movement {
                ground: number,
                translation: Vector::new(x, y),
                rotation: degrees.to_radians(),
                about: entry.about.map_or_else(|| part.body.polygon.centroid(), |[x, y]| Point::new(x, y)),
            });
        }
        movements
    }

    pub(super) fn vehicle(&self, findings: &mut Findings, blocks: &Names<'_>) -> Option<Vehicle> {
        let entry = self.file.vehicle.as_ref()?;
        let top = Trail::Top;
        let at = top.key("vehicle");
        let list = at.key("axles");
        if entry.axles.is_empty() {
            findings.add(&list, problem::message::no_axles());
        }
        let mut axles = Vec::new();
        for (i, axle) in entry.axles.iter().enumerate() {
            let inner = list.index(i);
            let weight = at_least_zero(findings, &inner, "weight", Some(axle.weight)).unwrap_or(0.0);
            let offset = axle.offset.unwrap_or(0.0);
            is_sane(findings, &inner.key("offset"), &[offset]);
            axles.push(Axle { weight, offset });
        }
        let names = at.key("over");
        let over = entry.over.iter().enumerate();
        let over = over.filter_map(|(i, name)| blocks.find(findings, &names.index(i), name).map(BlockId)).collect();
        let step = at_least_zero(findings, &at, "step", entry.step).unwrap_or(0.0);
        Some(Vehicle { axles, over, step, both_ways: entry.both_ways.unwrap_or(true) })
    }
}
