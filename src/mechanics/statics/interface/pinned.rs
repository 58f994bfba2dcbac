//! Finds gaps between two bodies that a small stone, a pinning stone, keeps open. Such gaps are open on purpose, even
//! if they are narrower than the tolerance.

use std::collections::BTreeMap;

use super::{Interface, NearMiss, PinnedGap};
use crate::mechanics::scene::{BlockId, BodyId, Scene, size};

/// The interfaces of each body.
pub(crate) struct ContactsByBody<'a>(BTreeMap<BodyId, Vec<&'a Interface>>);

impl<'a> ContactsByBody<'a> {
    /// Groups interfaces by their bodies. Each interface is listed under both of its bodies.
    pub(crate) fn new(all: &'a [Interface]) -> ContactsByBody<'a> {
        let mut by_body: BTreeMap<BodyId, Vec<&Interface>> = BTreeMap::new();
        for interface in all {
            for body in interface.bodies {
                by_body.entry(body).or_default().push(interface);
            }
        }
        ContactsByBody(by_body)
    }

    fn of_body(&self, body: BodyId) -> &[&'a Interface] {
        self.0.get(&body).map_or(&[][..], |list| &list[..])
    }
}

/// Finds a stone that lies between the two bodies of a gap and keeps the gap open. `None` if there is no such stone.
///
/// Such a stone touches the two bodies on opposite sides. Its height between them is more than half the width of the
/// gap, and at most 1.1 times the width plus `tolerance` metres. Only stones for which `is_present` is true are
/// considered.
pub(crate) fn pinning_stone(
    gap: &NearMiss,
    contacts: &ContactsByBody,
    is_present: impl Fn(&BodyId) -> bool,
    tolerance: f64,
) -> Option<BlockId> {
    let [one, other] = gap.bodies;
    contacts.of_body(one).iter().find_map(|below| {
        let stone = other_body(below, one);
        let BodyId::Block(id) = stone else {
            return None;
        };
        let pins = is_present(&stone)
            && contacts.of_body(stone).iter().any(|above| {
                let height = (above.middle() - below.middle()).dot(&below.normal).abs();
                // The two contacts are parallel within 8°.
                let is_opposite = below.normal.dot(&above.normal).abs() > 0.99;
                above.bodies.contains(&other)
                    && is_opposite
                    && height > 0.5 * gap.distance
                    && height <= 1.1 * gap.distance + tolerance
            });
        pins.then_some(id)
    })
}

/// The largest size of a stone that can keep a gap open, as a multiple of the width of the gap.
///
/// The size of a stone is four times its area over its perimeter, which is less than twice its height. A larger stone
/// touches the two bodies at a step instead. If it were ten times smaller, no stone would be recognised; if it were ten
/// times larger, the search would only take more time.
pub(super) const MAX_PINNED_SIZE_PER_GAP: f64 = 4.0;

/// Finds the joints in `open_joints` that a stone keeps open. The gaps of all joints in `open_joints` are within the
/// tolerance.
pub(super) fn pinned_gaps(scene: &Scene, all: &[Interface], open_joints: &[NearMiss]) -> Vec<PinnedGap> {
    if open_joints.is_empty() {
        return Vec::new();
    }
    let contacts = ContactsByBody::new(all);
    let pinned = open_joints.iter().filter_map(|gap| {
        let is_small_enough =
            |body: &BodyId| size(&scene.body(*body).polygon) <= MAX_PINNED_SIZE_PER_GAP * gap.distance;
        let stone = pinning_stone(gap, &contacts, is_small_enough, 0.0)?;
        Some(PinnedGap { gap: *gap, stone })
    });
    pinned.collect()
}

/// Returns the body of an interface that is not `body`.
fn other_body(interface: &Interface, body: BodyId) -> BodyId {
    let [a, b] = interface.bodies;
    if a == body { b } else { a }
}
