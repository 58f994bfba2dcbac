//! Snaps the bodies of a drawing together, so that blocks that nearly touch do touch.

use super::Snapped;
use super::draft::{Draft, Role};
use super::name::Names;
use super::outline::{Body, Outlines};
use crate::geometry::snap::{self, Rings};
use crate::geometry::{Bounds, Tolerance};

impl Outlines {
    /// Snaps together edges and corners that are at most `gap` metres apart. Returns the bodies that were moved.
    pub(super) fn snap(&mut self, draft: &mut Draft, names: &Names, gap: f64) -> Vec<Snapped> {
        if !(gap > 0.0) {
            return Vec::new();
        }
        // A circle has no corners.
        let rings_of = |b: &Body| if b.circle.is_some() { Rings::new() } else { b.rings.clone() };
        let rings: Vec<Rings> = self.bodies.iter().map(rings_of).collect();
        let (gaps, fixed) =
            (vec![gap; rings.len()], self.bodies.iter().map(|b| b.circle.is_some()).collect::<Vec<_>>());
        // Corners of the ground stay in place. Where corners of blocks are joined, they move to the mean of their positions.
        let moved_from = self.bodies.iter().position(|body| body.kind == Role::Block).unwrap_or(0);
        let gaps = snap::Gaps { moved_from, ..snap::Gaps::new(&gaps) };
        let outcome = snap::snapped(&rings, gaps, &fixed, 0.5 * self.tolerance() / gap);
        for body in &outcome.kept {
            draft.remark(
                &self.bodies[*body].element,
                "it would change its shape or overlap its neighbours more if it were snapped; left as drawn",
                "draw it closer to its neighbours, or use another --gap",
            );
        }
        let described = |moved: &snap::Moved| Snapped {
            body: names.bodies[moved.body].clone(),
            element: self.bodies[moved.body].element.clone(),
            corners: moved.corners,
            distance: moved.distance,
            to: moved.to.iter().map(|b| names.bodies[*b].clone()).collect(),
        };
        let snapped = outcome.moved.iter().map(described).collect();
        let moved = self.bodies.iter_mut().zip(outcome.bodies.into_owned());
        for (body, rings) in moved.filter(|(body, _)| body.circle.is_none()) {
            body.rings = rings;
        }
        snapped
    }

    /// Returns the depth of overlap, in metres, that a scene of these blocks tolerates.
    fn tolerance(&self) -> f64 {
        let boxes = self.boxes(Role::Block);
        let mut sizes: Vec<f64> = boxes.iter().map(|b| b.diagonal()).collect();
        sizes.sort_by(f64::total_cmp);
        let typical = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        let all = boxes.into_iter().reduce(Bounds::union);
        Tolerance::new(all.map_or(0.0, Bounds::diagonal), typical).gap
    }
}
