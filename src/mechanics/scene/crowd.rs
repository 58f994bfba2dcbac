//! [`check`]: refuses scenes with corner contacts in which the corners of very many bodies meet at one point. A body
//! is a block or a polygon of the ground.
//!
//! Each pair of corners at the point is a separate contact. No contact can replace others, because two corners push
//! each other along the difference of their bisectors, and this direction differs from pair to pair. n corners at one
//! point lead to n·(n − 1)/2 contacts, and to a dense linear program of 3·n rows. For 400 wedges, in a file of 48 KB,
//! these are 79 800 contacts and a computation of 20 s.

use std::collections::BTreeSet;

use super::BodyId;
use super::collision::Numbered;
use super::finding::Findings;
use super::frame::Frame;
use super::problem;
use crate::geometry::Point;
use crate::read::Trail;

/// The largest number of bodies in one frame whose corners may meet at one point. These bodies have 4 950 contacts, for
/// which the computation takes half a second.
pub(super) const MAX_BODIES_AT_POINT: usize = 100;

/// Reports a point at which corners of more than [`MAX_BODIES_AT_POINT`] bodies meet in one frame. Of several such
/// points, reports the one with the smallest x. Corners within about `gap`, in the units of the file, count as corners
/// at the same point.
pub(super) fn check(findings: &mut Findings, bodies: &[Numbered<'_>], frames: &[Frame], gap: f64) {
    if let Some((at, count)) = crowded(bodies, frames, gap) {
        let top = Trail::Top;
        let key = top.key("corner_contacts");
        findings.add(&key, problem::outline::crowded(count, MAX_BODIES_AT_POINT, at));
    }
}

/// Returns the point of smallest x at which corners of more than [`MAX_BODIES_AT_POINT`] bodies meet in one frame. Also
/// returns the number of these bodies in the frame that contains most of them. `None` if there is no such point.
fn crowded(bodies: &[Numbered<'_>], frames: &[Frame], gap: f64) -> Option<(Point, usize)> {
    // Adding 0 turns −0 into 0, because `total_cmp` below distinguishes −0 from 0.
    let cell = |v: f64| if gap > 0.0 { (v / gap).round() } else { v } + 0.0;
    let mut corners: Vec<([f64; 2], Point, BodyId)> = Vec::new();
    for (id, body) in bodies {
        let own = body.polygon.rings().iter().flatten();
        corners.extend(own.map(|p| ([cell(p.x), cell(p.y)], *p, *id)));
    }
    corners.sort_by(|(a, _, one), (b, _, two)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(one.cmp(two)));
    let together = corners.chunk_by(|a, b| a.0 == b.0);
    together.filter(|group| group.len() > MAX_BODIES_AT_POINT).find_map(|group| {
        let meeting: BTreeSet<BodyId> = group.iter().map(|(_, _, id)| *id).collect();
        let ground = meeting.iter().filter(|id| matches!(id, BodyId::Ground(_)));
        let ground = ground.count();
        let present = |frame: &Frame| {
            let placed = frame.placed.iter();
            ground + placed.filter(|id| meeting.contains(&BodyId::Block(**id))).count()
        };
        let most = frames.iter().map(present).max()?;
        (most > MAX_BODIES_AT_POINT).then_some((group[0].1, most))
    })
}
