//! Gaps that a stone keeps open: a pinning stone is meant, and so is its gap, however narrow.

use std::collections::BTreeMap;

use super::{Interface, NearMiss, PinnedGap};
use crate::scene::{BlockId, BodyId, Scene, size};

/// What touches each body.
pub(crate) struct ContactsByBody<'a>(BTreeMap<BodyId, Vec<&'a Interface>>);

impl<'a> ContactsByBody<'a> {
    /// Of these interfaces.
    pub(crate) fn new(all: &'a [Interface]) -> ContactsByBody<'a> {
        let mut touching: BTreeMap<BodyId, Vec<&Interface>> = BTreeMap::new();
        for interface in all {
            for body in interface.bodies {
                touching.entry(body).or_default().push(interface);
            }
        }
        ContactsByBody(touching)
    }

    fn body(&self, body: BodyId) -> &[&'a Interface] {
        self.0.get(&body).map_or(&[][..], |list| &list[..])
    }
}

/// The stone that stands between the two bodies and keeps the gap open.
///
/// Such a stone touches both, on opposite sides, and is as high between them as the gap is wide, give or take a tenth and
/// `tolerance` metres.
pub(crate) fn pinning_stone(
    gap: &NearMiss,
    touching: &ContactsByBody,
    stands: impl Fn(&BodyId) -> bool,
    tolerance: f64,
) -> Option<BlockId> {
    let [one, other] = gap.bodies;
    touching.body(one).iter().find_map(|below| {
        let stone = partner(below, one);
        let BodyId::Block(id) = stone else {
            return None;
        };
        let holds = stands(&stone)
            && touching.body(stone).iter().any(|above| {
                let across = (above.middle() - below.middle()).dot(&below.normal).abs();
                let opposite = below.normal.dot(&above.normal).abs() > 0.99;
                above.bodies.contains(&other)
                    && opposite
                    && across > 0.5 * gap.distance
                    && across <= 1.1 * gap.distance + tolerance
            });
        holds.then_some(id)
    })
}

/// A stone is at most so many gaps large (four times its area over its circumference) that keeps a gap open within the
/// tolerance: of a stone as high as the gap that is two at most, and what is larger touches both bodies at a step.
pub(super) const FLAT: f64 = 4.0;

/// Which of some gaps within the tolerance a stone keeps open.
pub(super) fn pinned_gaps(scene: &Scene, all: &[Interface], narrow: &[NearMiss]) -> Vec<PinnedGap> {
    if narrow.is_empty() {
        return Vec::new();
    }
    let touching = ContactsByBody::new(all);
    let held = narrow.iter().filter_map(|gap| {
        let flat = |body: &BodyId| size(&scene.body(*body).polygon) <= FLAT * gap.distance;
        let stone = pinning_stone(gap, &touching, flat, 0.0)?;
        Some(PinnedGap { gap: *gap, stone })
    });
    held.collect()
}

fn partner(interface: &Interface, body: BodyId) -> BodyId {
    let [a, b] = interface.bodies;
    if a == body { b } else { a }
}
