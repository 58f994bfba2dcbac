//! Healing: before the analysis, moves corners of bodies that were meant to touch, so that the bodies touch exactly.
//!
//! Rounded coordinates leave wedges of 10⁻⁴ rad and narrow gaps between stones that were drawn to touch. Corners and
//! edges of two bodies whose distance is within tolerance are moved onto each other, by the code that also heals
//! imported drawings ([`snapped`]). Contacts, centroids and proofs are all computed from the healed outlines. A block
//! keeps the weight of its outline as written. Invariant: if everything already fits, no coordinate changes, not even
//! by rounding.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::{Block, BlockId, Body, BodyId, Ground, Scene};
use crate::geometry::snap::{Corner, Gaps, Rings, polygon, snapped};
use crate::geometry::{Point, Polygon, Tolerance};
use crate::text::{and_more, power_of_ten};

/// Rounded coordinates are healed only if rounding can move corners off their edges by at most this fraction of the
/// median block size. Healing then moves a corner by at most this fraction of its body's size.
pub(super) const MAX_ROUNDING_PER_SIZE: f64 = 1.0 / 200.0;
/// The largest gap of a body as a fraction of its size, if the gap comes neither from rounding nor from a given
/// tolerance.
const DEFAULT_GAP_PER_SIZE: f64 = 1e-3;
/// If a tolerance is given, a corner moves by at most this fraction of its body's size, even if the tolerance is
/// larger.
const MAX_GAP_PER_SIZE: f64 = 1.0 / 20.0;
/// If a tolerance is given, a corner moves by at most this fraction of its shorter side.
///
/// A tolerance is meant for gaps between bodies, not for sides shorter than itself: the outline of a round stone stays
/// round. When both ends of a side move, its length changes by at most half and its direction by at most 30°. If this
/// value were ten times smaller, joints next to short sides would stay open. If it were twice as large, a side could
/// lose its whole length.
const MAX_MOVE_PER_SIDE: f64 = 0.25;
/// An overlap that healing makes deeper by at most this fraction of the gap is ignored.
const MAX_DEEPENING_PER_GAP: f64 = 0.25;
/// Coordinates count as noisy if many corners lie slightly off the edge that they should touch, by at most a millionth
/// of the scene's extent. The two values are the smallest fraction of all corners and the smallest number of corners
/// for which this applies; both must be reached.
const MIN_NOISY_CORNERS: (f64, usize) = (0.2, 8);
/// Coordinates are assumed to have an error of this many units in the last place of the largest coordinate.
const MAX_LAST_PLACE_UNITS: f64 = 16.0;

/// Where the contact tolerance of a scene comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ToleranceSource {
    /// The bodies are cells of a lattice: contacts are exact.
    Lattice,
    /// The scene file or the command line gives the tolerance.
    Given,
    /// The coordinates are written with this number of decimals.
    Decimals(usize),
    /// The coordinates are written with this number of significant digits.
    Digits(usize),
    /// The coordinates are 32-bit floats.
    Float32,
    /// The digits of the coordinates show no rounding, or one that is too coarse for healing. The tolerance is a
    /// millionth of the scene's extent.
    #[default]
    Size,
    /// Many corners lie off the edges that they should touch, by up to a millionth of the scene's extent.
    Noise,
}

/// The result of healing: how many bodies and corners moved, and how far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Healed {
    /// Where the contact tolerance comes from.
    pub source: ToleranceSource,
    /// Corners and edges up to this distance apart were snapped, metres; 0 if coordinates are used as written.
    pub within: f64,
    /// The number of bodies that changed.
    pub bodies: usize,
    /// The number of corners that moved.
    pub corners: usize,
    /// The largest distance by which a corner moved, metres.
    pub distance: f64,
    /// The number of bodies left as written, because healing would have damaged their shape or made an overlap deeper.
    pub kept: usize,
    /// The first of the bodies left as written, where the parts of the ground come before the blocks. `None` if there
    /// is no such body.
    pub first_kept: Option<BodyId>,
}

/// The tolerance of healing: at what distance edges touch, and how far corners may move. All lengths are in the unit of
/// the corners: that of the file, or metres if a resolved scene is healed again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HealingReach {
    /// Where the tolerance comes from.
    pub(super) source: ToleranceSource,
    /// A millionth of the scene's extent: edges up to this distance apart touch, however their coordinates are written.
    /// It is 0 if a tolerance is given, and on a lattice.
    pub(super) default_gap: f64,
    /// Corners and edges up to this distance apart are snapped; 0 if nothing is snapped.
    pub(super) healing: f64,
}

impl HealingReach {
    /// The tolerance of a scene on a lattice.
    pub(super) const EXACT: HealingReach =
        HealingReach { source: ToleranceSource::Lattice, default_gap: 0.0, healing: 0.0 };

    /// Returns the largest distance between two edges that count as touching, in the unit of the corners.
    pub(super) fn gap(self) -> f64 {
        self.default_gap.max(self.healing)
    }

    /// Returns the largest distance by which corners of a body may move. `size` is the size of the body. Both are in
    /// the unit of the corners.
    fn healing_of(self, size: f64) -> f64 {
        let part = match self.source {
            ToleranceSource::Given => MAX_GAP_PER_SIZE,
            ToleranceSource::Size | ToleranceSource::Noise => DEFAULT_GAP_PER_SIZE,
            _ => MAX_ROUNDING_PER_SIZE,
        };
        self.healing.min(part * size)
    }

    /// Returns the largest distance by which a corner may move, as a fraction of the shorter of its two sides. Infinite
    /// if the sides do not limit the move.
    fn share_of_edge(self) -> f64 {
        match self.source {
            ToleranceSource::Given => MAX_MOVE_PER_SIDE,
            // Other tolerances come from rounding errors, which are smaller than the sides of outlines. The sides need
            // not limit the move.
            _ => f64::INFINITY,
        }
    }

    /// Returns the largest error that is assumed for the coordinates of a body. `size` is the size of the body, and
    /// `farthest` the largest absolute value of its coordinates. All lengths are in the unit of the corners.
    fn rounding_of(self, size: f64, farthest: f64) -> f64 {
        self.healing_of(size).max(MAX_LAST_PLACE_UNITS * f64::EPSILON * farthest)
    }

    /// Returns the gap of a body: the largest distance at which it counts as touching another body. `size` is the size
    /// of the body, and `farthest` the largest absolute value of its coordinates. All lengths are in the unit of the
    /// corners.
    fn gap_of(self, size: f64, farthest: f64) -> f64 {
        let default_gap = self.default_gap.min(DEFAULT_GAP_PER_SIZE * size);
        default_gap.max(self.rounding_of(size, farthest))
    }
}

/// Returns the size of a body, in the unit of its corners: four times its area divided by its perimeter. For a square,
/// this is the length of a side.
///
/// For a long thin stone, the size is about twice the thickness.
pub(crate) fn size(polygon: &Polygon) -> f64 {
    let around: f64 = polygon.edges().map(|e| e.length()).sum();
    4.0 * polygon.area() / around
}

/// The valid bodies of the scene before healing.
struct Drawn {
    /// The number of parts of the ground.
    parts: usize,
    /// The number of each body among all bodies, including those that are not valid. The parts of the ground come
    /// first.
    numbers: Vec<usize>,
    /// Sizes of the bodies, in the unit of the corners. A part of the ground has the size of the largest block.
    sizes: Vec<f64>,
    /// The outlines. A circle has no corners, so its outline is empty.
    outlines: Vec<Rings>,
    /// Whether a body may not move, because it consists of lattice cells or is a circle.
    fixed: Vec<bool>,
}

/// The bodies after snapping.
struct Closed<'d> {
    /// The outlines; borrowed from the input if nothing was moved.
    outlines: Cow<'d, [Rings]>,
    /// The bodies left as written, because snapping would have damaged their shape or made an overlap deeper. A body is
    /// given by its index in the lists of [`Drawn`].
    kept: Vec<usize>,
    reach: HealingReach,
}

/// Moves corners and edges of different bodies onto each other if they are within tolerance, and sets the gap of every
/// body. Returns how many bodies and corners moved, and how far.
///
/// 1. Measure the bodies.
/// 2. Snap corners and edges within the tolerance that was given, or that follows from the digits of the coordinates.
/// 3. If many corners still lie slightly off the edges that they should touch, the coordinates are noisy: snap these
///    corners too.
/// 4. Replace the outlines that changed by more than rounding, and count the corners that moved.
/// 5. Set the gap and the assumed error of the coordinates of every body, and the centroid of every block that has no centre of its own.
pub(super) fn heal(ground: &mut [Option<Ground>], blocks: &mut [Option<Block>], reach: HealingReach) -> Healed {
    let drawn = Drawn::new(ground, blocks);
    let closed = drawn.without_noise(drawn.within_reach(reach));
    let reach = closed.reach;
    let (healed, changed) = drawn.changes(&closed);
    for ((number, body), size) in bodies(ground, blocks).zip(&drawn.sizes) {
        if let Some(Ok(polygon)) = changed.get(&number).map(|new| polygon(new)) {
            body.polygon = polygon;
        }
        let bounds = body.polygon.bounds();
        let farthest = bounds.min.coords.amax().max(bounds.max.coords.amax());
        body.gap = reach.gap_of(*size, farthest);
        body.rounding = reach.rounding_of(*size, farthest);
    }
    for block in blocks.iter_mut().flatten().filter(|block| !block.has_own_centre) {
        block.centroid = block.body.centroid();
    }
    healed
}

impl Drawn {
    /// Step 1 of healing: measures the bodies. A part of the ground gets the size of the largest block, even if the
    /// part is thin.
    fn new(ground: &mut [Option<Ground>], blocks: &mut [Option<Block>]) -> Drawn {
        let parts = ground.len();
        let mut drawn =
            Drawn { parts, numbers: Vec::new(), sizes: Vec::new(), outlines: Vec::new(), fixed: Vec::new() };
        for (number, body) in bodies(ground, blocks) {
            drawn.numbers.push(number);
            drawn.sizes.push(size(&body.polygon));
            drawn.outlines.push(if body.circle.is_some() { Rings::new() } else { rings(&body.polygon) });
            drawn.fixed.push(body.cells.is_some() || body.circle.is_some());
        }
        let sizes = drawn.numbers.iter().zip(&mut drawn.sizes);
        let (grounds, blocks): (Vec<_>, Vec<_>) = sizes.partition(|(n, _)| **n < parts);
        let largest = blocks.iter().map(|(_, size)| **size).fold(0.0, f64::max);
        for (_, size) in grounds {
            *size = largest;
        }
        drawn
    }

    /// Returns the id of a body from its index `drawn` in the lists of this struct, which contain only valid bodies.
    fn body(&self, drawn: usize) -> BodyId {
        let number = self.numbers[drawn];
        match number.checked_sub(self.parts) {
            Some(block) => BodyId::Block(BlockId(block)),
            None => BodyId::Ground(number),
        }
    }

    /// Returns, for each body, the largest distance by which its corners may move, in the unit of the corners.
    fn gaps(&self, reach: HealingReach) -> Vec<f64> {
        self.sizes.iter().map(|s| reach.healing_of(*s)).collect()
    }

    /// Step 2 of healing: snaps corners and edges whose distance is within the tolerance `reach`.
    fn within_reach(&self, reach: HealingReach) -> Closed<'_> {
        let mut closed = Closed { outlines: Cow::Borrowed(&self.outlines[..]), kept: Vec::new(), reach };
        if reach.healing > 0.0 {
            let gaps = self.gaps(reach);
            let limits = Gaps { share_of_edge: reach.share_of_edge(), ..Gaps::new(&gaps) };
            let outcome = snapped(&self.outlines, limits, &self.fixed, MAX_DEEPENING_PER_GAP);
            (closed.outlines, closed.kept) = (outcome.bodies, outcome.kept);
        }
        closed
    }

    /// Step 3 of healing: snaps the corners that still lie slightly off the edges that they should touch, if there are
    /// at least as many as [`MIN_NOISY_CORNERS`] requires. Otherwise returns `closed` unchanged.
    fn without_noise<'d>(&self, closed: Closed<'d>) -> Closed<'d> {
        let default_gap = closed.reach.default_gap;
        if default_gap <= closed.reach.healing {
            return closed;
        }
        let reach = HealingReach { source: ToleranceSource::Noise, default_gap, healing: default_gap };
        let gaps = self.gaps(reach);
        let outcome = snapped(&closed.outlines, Gaps::new(&gaps), &self.fixed, MAX_DEEPENING_PER_GAP);
        let all: usize = self.outlines.iter().flatten().map(Vec::len).sum();
        let moved: usize = outcome.moved.iter().map(|m| m.corners).sum();
        let (share, least) = MIN_NOISY_CORNERS;
        if moved < least || (moved as f64) < share * all as f64 {
            return closed;
        }
        Closed { kept: outcome.kept, outlines: Cow::Owned(outcome.bodies.into_owned()), reach }
    }

    /// Step 4 of healing: counts the bodies and corners that moved. Returns these counts, and a map from the number of
    /// each changed body to its new outline.
    fn changes<'c>(&self, closed: &'c Closed<'_>) -> (Healed, BTreeMap<usize, &'c Rings>) {
        let reach = closed.reach;
        let mut healed = Healed {
            source: reach.source,
            within: reach.healing,
            kept: closed.kept.len(),
            first_kept: closed.kept.first().map(|body| self.body(*body)),
            ..Healed::default()
        };
        let mut changed = BTreeMap::new();
        let new = match &closed.outlines {
            Cow::Borrowed(_) => &[][..],
            Cow::Owned(new) => new,
        };
        let bodies = self.numbers.iter().zip(&self.outlines).zip(&self.sizes);
        for (((number, old), size), new) in bodies.zip(new) {
            let corners = old.iter().flatten().zip(new.iter().flatten());
            // A move by less than a millionth of the largest allowed move is only the rounding of numbers.
            let rounding = 1e-6 * reach.healing_of(*size);
            let moves = corners.map(|(a, b)| (b.at - a.at).norm());
            let moves: Vec<f64> = moves.filter(|by| *by > rounding).collect();
            if moves.is_empty() {
                continue;
            }
            healed.bodies += 1;
            healed.corners += moves.len();
            healed.distance = moves.into_iter().fold(healed.distance, f64::max);
            changed.insert(*number, new);
        }
        (healed, changed)
    }
}

/// Iterates over the valid bodies, each with its number among all bodies. The parts of the ground come first.
fn bodies<'b>(
    ground: &'b mut [Option<Ground>],
    blocks: &'b mut [Option<Block>],
) -> impl Iterator<Item = (usize, &'b mut Body)> {
    let ground = (ground.iter_mut()).map(|g| g.as_mut().map(|g| &mut g.body));
    let blocks = (blocks.iter_mut()).map(|b| b.as_mut().map(|b| &mut b.body));
    let all = ground.chain(blocks).enumerate();
    all.filter_map(|(number, body)| Some((number, body?)))
}

fn rings(polygon: &Polygon) -> Rings {
    let corner = |at: &Point| Corner { at: *at, curved: false };
    let ring = |ring: &Vec<Point>| ring.iter().map(corner).collect::<Vec<Corner>>();
    polygon.rings().iter().map(ring).collect()
}

impl Scene {
    /// Returns the tolerance for contacts between two bodies. It has the smaller gap and the larger rounding error of
    /// the two bodies.
    pub(crate) fn tolerance_between(&self, a: BodyId, b: BodyId) -> Tolerance {
        let (a, b) = (self.body(a), self.body(b));
        Tolerance::from_gap(a.gap.min(b.gap)).with_rounding(a.rounding.max(b.rounding))
    }

    /// Returns a copy of the scene, healed with the contact tolerance `gap`, in metres, and without its list of small
    /// overlaps. Bodies that healing does not move still count as touching within this distance, but within at most a
    /// twentieth of their size.
    pub(crate) fn closed(&self, gap: f64) -> Scene {
        let mut scene = self.clone();
        let reach = HealingReach { source: ToleranceSource::Given, default_gap: 0.0, healing: gap };
        let mut ground: Vec<Option<Ground>> = scene.ground.into_iter().map(Some).collect();
        let mut blocks: Vec<Option<Block>> = scene.blocks.into_iter().map(Some).collect();
        scene.healed = heal(&mut ground, &mut blocks, reach);
        scene.ground = ground.into_iter().flatten().collect();
        scene.blocks = blocks.into_iter().flatten().collect();
        scene.tolerance = Tolerance::from_gap(gap);
        scene.penetrations.clear();
        scene
    }

    /// Describes the contact tolerance in words: the distance at which edges touch, the source of this distance, and
    /// the corners that healing moved. `None` if the contacts are exact, on a lattice.
    pub fn tolerance_words(&self) -> Option<String> {
        let from: String = match self.healed.source {
            ToleranceSource::Lattice => return None,
            ToleranceSource::Given => "the given tolerance".into(),
            ToleranceSource::Decimals(1) => "coordinates with 1 decimal".into(),
            ToleranceSource::Decimals(k) => format!("coordinates with {k} decimals"),
            ToleranceSource::Digits(n) => format!("coordinates with {n} digits"),
            ToleranceSource::Float32 => "coordinates of 32-bit floats".into(),
            ToleranceSource::Size | ToleranceSource::Noise => {
                "many corners lie off the edges that they should touch, by up to a millionth of the scene's extent"
                    .into()
            }
        };
        let Healed { within, bodies, corners, distance, kept, first_kept, .. } = self.healed;
        let unit = self.units.length();
        let [gap, within, distance] = [self.tolerance.gap, within, distance].map(|metres| unit.value_from_si(metres));
        let unit = unit.symbol();
        let shown = |x: f64| power_of_ten(x, 2);
        let [is_apart, is_narrow] = [within <= 0.0, within < gap];
        let [gap, within, distance] = [gap, within, distance].map(shown);
        let mut words = if is_apart {
            format!("edges touch within a distance of {gap} {unit}, a millionth of the scene's extent")
        } else if is_narrow {
            format!(
                "edges touch within a distance of {gap} {unit}, a millionth of the scene's extent; edges within {within} {unit} are moved onto each other ({from})"
            )
        } else {
            format!("edges touch within a distance of {gap} {unit} ({from})")
        };
        if corners > 0 {
            let of = if bodies == 1 { "body" } else { "bodies" };
            let corner = if corners == 1 { "corner" } else { "corners" };
            words += &format!(
                "; {corners} {corner} of {bodies} {of} moved onto the edges they touch, by up to {distance} {unit}"
            );
        }
        if let Some(body) = first_kept {
            let (name, bounds) = (self.name(body), self.body(body).polygon.bounds());
            let [least, most] = [bounds.min, bounds.max]
                .map(|corner| [corner.x, corner.y].map(|v| self.units.length().value_from_si(v)));
            let more = and_more(kept - 1);
            words += &format!(
                "; {name} (from {:.4}, {:.4} to {:.4}, {:.4} {unit}){more} stayed as written: healing would damage its shape \
                 or deepen an overlap",
                least[0], least[1], most[0], most[1]
            );
        }
        Some(words)
    }
}
