//! [`VehiclePosition`]: the positions of a vehicle over a structure, and the loads of its axles there.

use crate::geometry::{Edge, Point, Vector, quarter_turn};
use crate::mechanics::scene::{BlockId, Frame, Load, Scene, Vehicle};
use crate::mechanics::statics::assembly::{Assembly, load_about};
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;

/// More positions than this are not analysed.
pub(super) const MAX_POSITIONS: usize = 5000;
/// More positions than this in one direction are not added for a `step`.
const MAX_STEPS: f64 = 1000.0;
/// Two ends of edges this close to each other, relative to the length of the track, are one point.
const SAME_PLACE: f64 = 1e-9;

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

/// Returns a scene with the axles of its vehicle as loads at a position, and without the vehicle. `None` if it has none.
pub(super) fn scene_with_axles(scene: &Scene, position: &VehiclePosition) -> Option<Scene> {
    let loaded = with_axle_loads(scene, scene.vehicle.as_ref()?, position);
    Some(Scene { vehicle: None, ..loaded })
}

/// Returns a scene whose loads also contain the axles of a vehicle at a position.
pub(super) fn with_axle_loads(scene: &Scene, vehicle: &Vehicle, position: &VehiclePosition) -> Scene {
    let first = scene.loads.iter().map(|load| load.entry + 1).max().unwrap_or(0);
    let mut loads = scene.loads.clone();
    loads.extend(position.axles.iter().enumerate().map(|(number, (axle, block, at))| Load {
        block: *block,
        force: scene.down() * vehicle.axles[*axle].weight,
        at: *at,
        torque: 0.0,
        is_fixed: false,
        fixed_along: None,
        entry: first + number,
        spread: None,
        at_centroid: false,
    }));
    Scene { loads, ..scene.clone() }
}

/// Returns the number of the position of a frame that is nearest to a position of another frame of the same scene.
pub(super) fn same_position(scene: &Scene, (from, number): (&Frame, usize), to: &Frame) -> Option<usize> {
    let vehicle = scene.vehicle.as_ref()?;
    let all = |frame: &Frame| positions(scene, vehicle, &track(scene, frame, vehicle));
    let own = all(from)?.into_iter().nth(number)?;
    let each = all(to)?.into_iter().enumerate().filter(|(_, other)| other.to_right == own.to_right);
    let nearest = each.min_by(|(_, a), (_, b)| (a.at - own.at).abs().total_cmp(&(b.at - own.at).abs()));
    nearest.map(|(number, _)| number)
}

/// Returns the assembly of a frame without its vehicle, and then with the axles at each position.
pub(super) fn in_all_positions(scene: &Scene, frame: &Frame, interfaces: &Interfaces) -> Vec<Assembly> {
    let bare = effect::assembly_of(scene, frame, interfaces);
    let found = scene.vehicle.as_ref().and_then(|own| Some((own, positions(scene, own, &track(scene, frame, own))?)));
    let loaded = found.iter().flat_map(|(vehicle, positions)| {
        let loaded = positions.iter().filter_map(|position| with_axles(scene, &bare, vehicle, position));
        loaded.map(|assembly| assembly.with_load_factor(bare.load_factor))
    });
    let loaded: Vec<Assembly> = loaded.collect();
    [bare].into_iter().chain(loaded).collect()
}

/// Returns an assembly with the axles on its blocks; `None` if no axle stands on them.
pub(super) fn with_axles(
    scene: &Scene,
    component: &Assembly,
    vehicle: &Vehicle,
    position: &VehiclePosition,
) -> Option<Assembly> {
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
pub(super) struct Top {
    from: f64,
    to: f64,
    block: BlockId,
    edge: Edge,
}

/// Returns the edges of the blocks of the vehicle that are seen from above, from left to right. Other blocks hide what is
/// below them.
pub(super) fn track(scene: &Scene, frame: &Frame, vehicle: &Vehicle) -> Vec<Top> {
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
pub(super) fn positions(scene: &Scene, vehicle: &Vehicle, track: &[Top]) -> Option<Vec<VehiclePosition>> {
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
