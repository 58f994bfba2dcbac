//! Healing: the structure that was meant, once, before anything is judged.
//!
//! Rounded coordinates leave wedges of 10⁻⁴ rad and slits between stones that were drawn to touch. Corners and edges
//! within a body's reach of each other are brought together here, by the code that also heals imported drawings; contacts,
//! centroids and proofs all come from the healed outlines. A block's weight stays that of its outline as written. Invariant:
//! where everything fits already, nothing changes by a single bit.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::{Block, BlockId, Body, BodyId, Ground, Scene};
use crate::geometry::snap::{Corner, Gaps, Rings, polygon, snapped};
use crate::geometry::{Point, Polygon, Tolerance};

/// A block rounded more coarsely than this part of its size is taken as it is written.
pub(super) const FINE: f64 = 1.0 / 200.0;
/// A body counts for touching within this part of its size at most, where its coordinates are given in full.
const SLIGHT: f64 = 1e-3;
/// A gap is closed only if it is smaller than this part of the body's size, whatever tolerance is given.
const MOST: f64 = 1.0 / 20.0;
/// Within a given tolerance a corner moves by at most this part of its shorter edge.
///
/// A tolerance speaks of gaps between bodies. Where it is wider than an edge is long it says nothing about that edge: the
/// outline of a round stone stays round. The two ends of an edge together change its length by half at most and turn it by
/// 30° at most. A tenth of this would leave joints next to short edges open; at twice this an edge can lose its whole length.
const OF_EDGE: f64 = 0.25;
/// Healing may deepen an overlap by less than this part of the gap; it does not count as an overlap.
const NOISE: f64 = 0.25;
/// Where this part of all corners, and at least so many, lie within a millionth of the scene's reach of what they touch and
/// not on it, the coordinates are noisy however many digits they have.
const NOISY: (f64, usize) = (0.2, 8);
/// Coordinates are assumed to be off by this many units in the last place of the largest one.
const LAST: f64 = 16.0;

/// Where the contact tolerance of a scene comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ToleranceSource {
    /// The bodies are cells of a lattice: contacts are exact.
    Lattice,
    /// The scene or the command line gives it.
    Given,
    /// The coordinates are written with this number of decimals.
    Decimals(usize),
    /// The coordinates are written with this number of significant digits.
    Digits(usize),
    /// The coordinates are 32-bit floats.
    Float32,
    /// The coordinates are written in full: a millionth of the scene's reach.
    #[default]
    Size,
    /// Most corners lie up to a millionth of the scene's reach off what they touch.
    Noise,
}

/// What healing has moved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Healed {
    /// Where the tolerance comes from.
    pub source: ToleranceSource,
    /// Corners and edges within this have become one, metres; 0 where coordinates are taken as they are written.
    pub within: f64,
    /// How many bodies have changed.
    pub bodies: usize,
    /// How many of their corners moved.
    pub corners: usize,
    /// How far the farthest moved, metres.
    pub distance: f64,
    /// How many bodies would have lost their shape, or come to lie deeper in others, and stayed as they are written.
    pub kept: usize,
    /// The first of these bodies, the ground's parts before the blocks.
    pub first_kept: Option<BodyId>,
}

/// How close is close, and how far corners may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HealingReach {
    pub(super) source: ToleranceSource,
    /// A millionth of the scene's reach, metres: within this edges touch however their coordinates are written.
    pub(super) usual: f64,
    /// Corners and edges within this are brought together, metres; 0 for none.
    pub(super) healing: f64,
}

impl HealingReach {
    /// Of a lattice.
    pub(super) const EXACT: HealingReach = HealingReach {
        source: ToleranceSource::Lattice,
        usual: 0.0,
        healing: 0.0,
    };

    /// Two edges within this touch, metres.
    pub(super) fn gap(self) -> f64 {
        self.usual.max(self.healing)
    }

    /// How far a body of some size comes to another; metres both.
    fn healing_of(self, size: f64) -> f64 {
        let part = match self.source {
            ToleranceSource::Given => MOST,
            ToleranceSource::Size | ToleranceSource::Noise => SLIGHT,
            _ => FINE,
        };
        self.healing.min(part * size)
    }

    /// How far a corner may move, in parts of its shorter edge.
    fn share_of_edge(self) -> f64 {
        match self.source {
            ToleranceSource::Given => OF_EDGE,
            // Rounding is smaller than the edges it leaves.
            _ => f64::INFINITY,
        }
    }

    /// How far the coordinates of a body of some size, up to `farthest`, may be off; metres all.
    fn rounding_of(self, size: f64, farthest: f64) -> f64 {
        self.healing_of(size).max(LAST * f64::EPSILON * farthest)
    }

    /// Within what a body of some size, with coordinates up to `farthest`, touches another; metres all.
    fn gap_of(self, size: f64, farthest: f64) -> f64 {
        let usual = self.usual.min(SLIGHT * size);
        usual.max(self.rounding_of(size, farthest))
    }
}

/// The size of a body, metres: four times its area over the length of its boundary, the side of a square.
///
/// Of a long thin stone it is twice the thickness.
pub(crate) fn size(polygon: &Polygon) -> f64 {
    let around: f64 = polygon.edges().map(|e| e.length()).sum();
    4.0 * polygon.area() / around
}

/// The bodies as they are written.
struct Drawn {
    /// The number of parts of the ground.
    parts: usize,
    /// Their numbers among all bodies, sound or not; the parts of the ground come first.
    numbers: Vec<usize>,
    /// How large they are, metres.
    sizes: Vec<f64>,
    outlines: Vec<Rings>,
    /// Whether they may not move, because they are cells of a lattice.
    fixed: Vec<bool>,
}

/// The bodies after corners were brought together.
struct Closed<'d> {
    /// Borrowed where nothing was moved.
    outlines: Cow<'d, [Rings]>,
    /// The bodies that stayed as they are written, because moved they would lose their shape or lie deeper in others.
    kept: Vec<usize>,
    reach: HealingReach,
}

/// Brings together what lies within reach, and gives every body its own gap.
///
/// 1. Measure the bodies.
/// 2. Bring corners and edges together within the tolerance that was given or that the digits of the coordinates show.
/// 3. If then many corners still lie slightly off what they touch, the coordinates are noisy: bring these together too.
/// 4. Replace the outlines that changed by more than rounding, and count what moved.
/// 5. Give every body its gap, and every block its centroid.
pub(super) fn heal(
    ground: &mut [Option<Ground>],
    blocks: &mut [Option<Block>],
    reach: HealingReach,
) -> Healed {
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
    for block in blocks.iter_mut().flatten() {
        block.centroid = block.body.polygon.centroid();
    }
    healed
}

impl Drawn {
    /// Step 1: measures the bodies. A part of the ground is as large as the largest block, however thin it is drawn.
    fn new(ground: &mut [Option<Ground>], blocks: &mut [Option<Block>]) -> Drawn {
        let parts = ground.len();
        let mut drawn = Drawn {
            parts,
            numbers: Vec::new(),
            sizes: Vec::new(),
            outlines: Vec::new(),
            fixed: Vec::new(),
        };
        for (number, body) in bodies(ground, blocks) {
            drawn.numbers.push(number);
            drawn.sizes.push(size(&body.polygon));
            drawn.outlines.push(rings(&body.polygon));
            drawn.fixed.push(body.cells.is_some());
        }
        let sizes = drawn.numbers.iter().zip(&mut drawn.sizes);
        let (grounds, blocks): (Vec<_>, Vec<_>) = sizes.partition(|(n, _)| **n < parts);
        let largest = blocks.iter().map(|(_, size)| **size).fold(0.0, f64::max);
        for (_, size) in grounds {
            *size = largest;
        }
        drawn
    }

    /// The id of a drawn body.
    fn body(&self, drawn: usize) -> BodyId {
        let number = self.numbers[drawn];
        match number.checked_sub(self.parts) {
            Some(block) => BodyId::Block(BlockId(block)),
            None => BodyId::Ground(number),
        }
    }

    /// How far each body may move, metres.
    fn gaps(&self, reach: HealingReach) -> Vec<f64> {
        self.sizes.iter().map(|s| reach.healing_of(*s)).collect()
    }

    /// Step 2: brings together what lies within the tolerance.
    fn within_reach(&self, reach: HealingReach) -> Closed<'_> {
        let mut closed = Closed {
            outlines: Cow::Borrowed(&self.outlines[..]),
            kept: Vec::new(),
            reach,
        };
        if reach.healing > 0.0 {
            let limits = Gaps {
                of_body: &self.gaps(reach),
                share_of_edge: reach.share_of_edge(),
            };
            let outcome = snapped(&self.outlines, limits, &self.fixed, NOISE);
            (closed.outlines, closed.kept) = (outcome.bodies, outcome.kept);
        }
        closed
    }

    /// Step 3: brings together what noise holds apart, if [`NOISY`] says that there is noise.
    fn without_noise<'d>(&self, closed: Closed<'d>) -> Closed<'d> {
        let usual = closed.reach.usual;
        if usual <= closed.reach.healing {
            return closed;
        }
        let reach = HealingReach {
            source: ToleranceSource::Noise,
            usual,
            healing: usual,
        };
        let gaps = self.gaps(reach);
        let outcome = snapped(&closed.outlines, Gaps::new(&gaps), &self.fixed, NOISE);
        let all: usize = self.outlines.iter().flatten().map(Vec::len).sum();
        let moved: usize = outcome.moved.iter().map(|m| m.corners).sum();
        let (share, least) = NOISY;
        if moved < least || (moved as f64) < share * all as f64 {
            return closed;
        }
        Closed {
            kept: outcome.kept,
            outlines: Cow::Owned(outcome.bodies.into_owned()),
            reach,
        }
    }

    /// Step 4: what moved, and the new outlines of the bodies that changed, by number.
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
            // Less than a millionth of the gap is the rounding of numbers.
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

/// The sound bodies, the ground's parts first, with their numbers among all.
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
    let corner = |at: &Point| Corner {
        at: *at,
        curved: false,
    };
    let ring = |ring: &Vec<Point>| ring.iter().map(corner).collect::<Vec<Corner>>();
    polygon.rings().iter().map(ring).collect()
}

impl Scene {
    /// How close two bodies have to be to touch: the smaller of their own gaps. What is rounding is the larger of theirs.
    pub(crate) fn tolerance_between(&self, a: BodyId, b: BodyId) -> Tolerance {
        let (a, b) = (self.body(a), self.body(b));
        Tolerance::from_gap(a.gap.min(b.gap)).with_rounding(a.rounding.max(b.rounding))
    }

    /// The scene with everything within `gap` metres brought together, and a contact where that cannot be done.
    pub(crate) fn closed(&self, gap: f64) -> Scene {
        let mut scene = self.clone();
        let reach = HealingReach {
            source: ToleranceSource::Given,
            usual: 0.0,
            healing: gap,
        };
        let mut ground: Vec<Option<Ground>> = scene.ground.into_iter().map(Some).collect();
        let mut blocks: Vec<Option<Block>> = scene.blocks.into_iter().map(Some).collect();
        scene.healed = heal(&mut ground, &mut blocks, reach);
        scene.ground = ground.into_iter().flatten().collect();
        scene.blocks = blocks.into_iter().flatten().collect();
        scene.tolerance = Tolerance::from_gap(gap);
        scene.penetrations.clear();
        scene
    }

    /// How close two edges have to be to touch, where that length comes from, and what was moved to make them; `None` on
    /// a lattice, where contacts are exact.
    pub fn tolerance_words(&self) -> Option<String> {
        let from: String = match self.healed.source {
            ToleranceSource::Lattice => return None,
            ToleranceSource::Given => "as asked for".into(),
            ToleranceSource::Decimals(1) => "coordinates with 1 decimal".into(),
            ToleranceSource::Decimals(k) => format!("coordinates with {k} decimals"),
            ToleranceSource::Digits(n) => format!("coordinates with {n} digits"),
            ToleranceSource::Float32 => "coordinates of 32-bit floats".into(),
            ToleranceSource::Size | ToleranceSource::Noise => {
                "most corners lie off what they touch, by less than a millionth of the scene's reach".into()
            }
        };
        let Healed {
            within,
            bodies,
            corners,
            distance,
            kept,
            first_kept,
            ..
        } = self.healed;
        let gap = self.tolerance.gap;
        let mut words = if within <= 0.0 {
            format!("edges touch within {gap:.2e} m, a millionth of the scene's reach")
        } else if within < gap {
            format!(
                "edges touch within {gap:.2e} m, a millionth of the scene's reach, and are one within {within:.2e} m ({from})"
            )
        } else {
            format!("edges touch within {gap:.2e} m ({from})")
        };
        if corners > 0 {
            let of = if bodies == 1 { "body" } else { "bodies" };
            let corner = if corners == 1 { "corner" } else { "corners" };
            words += &format!(
                "; {corners} {corner} of {bodies} {of} moved onto what they touch, by up to {distance:.1e} m"
            );
        }
        if let Some(body) = first_kept {
            let (name, bounds) = (self.name(body), self.body(body).polygon.bounds());
            let (least, most) = (bounds.min, bounds.max);
            let more = match kept {
                1 => String::new(),
                n => format!(" and {} more", n - 1),
            };
            words += &format!(
                "; {name} (from {:.4}, {:.4} to {:.4}, {:.4}){more} stayed as written: moved it would lose its shape or lie \
                 deeper in others",
                least.x, least.y, most.x, most.y
            );
        }
        Some(words)
    }
}
