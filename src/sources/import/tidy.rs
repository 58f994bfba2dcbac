//! Leaves out what is drawn but is no stone: specks, exact repeats, fills of drawn outlines, and frames.

use std::collections::BTreeSet;

use super::draft::{Draft, FillRule, Part, PartGeometry, Role};
use super::subpath::{Segment, Subpath};
use crate::geometry::{Bounds, Point};

/// Outlines and lines up to this share of the size of the drawing are specks. Nobody draws such a stone, and CAD programs
/// leave such arcs where corners were rounded.
const SPECK: f64 = 1e-6;
/// Two boxes coincide if they differ by at most this share of their size.
const COINCIDENCE_TOL: f64 = 1e-6;
/// An outline is as large as the page if its corners are this close to those of the page, as a share of its diagonal.
const PAGE_TOL: f64 = 0.005;
/// A sheet has at most this many borders.
const MAX_BORDERS: usize = 4;
/// An outline of four or five corners is an upright rectangle if it fills this share of its box.
const RECTANGLE_SHARE: f64 = 0.999;

/// The bits of the coordinates of points.
type Places = Vec<[u64; 2]>;

/// Leaves out specks, lines of no length, and outlines and lines that are drawn twice. `size` is the size of the drawing in
/// metres.
pub(super) fn leave_dust_out(draft: &mut Draft, size: f64) {
    let (mut specks, mut repeats) = (0, 0);
    let mut lines: BTreeSet<(u8, usize, Places)> = BTreeSet::new();
    let mut outlines: BTreeSet<(u8, bool, Vec<Places>)> = BTreeSet::new();
    for part in &mut draft.parts {
        let (kind, group) = (part.kind as u8, part.group);
        let PartGeometry::Subpaths(subpaths, rule) = &mut part.form else { continue };
        let before = subpaths.len();
        subpaths.retain(|s| Bounds::from_points(s.hull()).is_some_and(|b| b.diagonal() > SPECK * size));
        specks += before - subpaths.len();
        let once = subpaths.len();
        subpaths.retain(|s| s.closed || lines.insert((kind, group, key(s))));
        // Outlines of one element may be its holes, and a stone may fill a hole of another one. So elements are compared
        // whole.
        let is_closed = !subpaths.is_empty() && subpaths.iter().all(|s| s.closed);
        let whole = || (kind, *rule == FillRule::EvenOdd, subpaths.iter().map(key).collect());
        if is_closed && !part.is_fill && !outlines.insert(whole()) {
            subpaths.clear();
        }
        repeats += once - subpaths.len();
    }
    draft.parts.retain(|part| !part.is_empty());
    for (count, what) in [(specks, "specks and lines of no length"), (repeats, "exact repeats")] {
        if count > 0 {
            draft.notes.push(format!("left out: {what} ({count})"));
        }
    }
}

/// Returns the corners of a subpath, and the middles of its curves, in an order that does not depend on its direction.
fn key(subpath: &Subpath) -> Places {
    let points = |(from, segment): (Point, Segment)| {
        let middle = (!matches!(segment, Segment::Line(_))).then(|| segment.at(from, 0.5));
        [from, segment.end()].into_iter().chain(middle)
    };
    let mut key: Places = subpath.starts().flat_map(points).map(|p| [p.x, p.y].map(f64::to_bits)).collect();
    key.sort_unstable();
    key.dedup();
    key
}

/// Leaves out the boundaries of hatches that fill a drawn outline.
pub(super) fn leave_fills_out(draft: &mut Draft) {
    let mut drawn: Vec<Bounds> = draft.parts.iter().filter(|part| !part.is_fill).filter_map(Part::around).collect();
    drawn.sort_by(|a, b| a.min.x.total_cmp(&b.min.x));
    let coincides = |own: Bounds| {
        let tolerance = COINCIDENCE_TOL * own.diagonal();
        let first = drawn.partition_point(|b| b.min.x < own.min.x - tolerance);
        let near = drawn[first..].iter().take_while(|b| b.min.x <= own.min.x + tolerance);
        near.into_iter().any(|b| (b.min - own.min).norm() <= tolerance && (b.max - own.max).norm() <= tolerance)
    };
    let mut filled = 0;
    for part in draft.parts.iter_mut().filter(|part| part.is_fill) {
        filled += part.retain(|s| Bounds::from_points(s.hull()).is_some_and(|own| !coincides(own)));
    }
    draft.parts.retain(|part| !part.is_empty());
    let mut blocks = draft.parts.iter().filter(|part| part.is_fill && part.kind == Role::Block);
    if let Some(first) = blocks.next().map(|part| part.element.clone()) {
        let message = format!("hatches without a drawn outline become blocks: {}", 1 + blocks.count());
        draft.remark(first, message, "if they show fill, leave them out with --ignore and the name of their layer");
    }
    if filled > 0 {
        draft.notes.push(format!("left out: boundaries of hatches that fill a drawn outline ({filled})"));
    }
}

/// Leaves out the frames: rectangles without a role that are as large as the page, or around all else. At
/// most [`MAX_BORDERS`] are left out. With `pages_only`, a rectangle around all else stays, because lines may cut it.
pub(super) fn leave_frames_out(draft: &mut Draft, pages_only: bool) {
    for _ in 0..MAX_BORDERS {
        let boxes: Vec<Option<Bounds>> = draft.parts.iter().map(Part::around).collect();
        let is_block = |i: &usize| draft.parts[*i].kind == Role::Block;
        let blocks: Vec<usize> = (0..boxes.len()).filter(is_block).collect();
        let holds_all = |own: Bounds, frame: usize| {
            let wide = own.grown(COINCIDENCE_TOL * own.diagonal());
            let others = boxes.iter().enumerate().filter(|(i, _)| *i != frame).filter_map(|(_, b)| *b);
            let is_in = |b: Bounds| (0..2).all(|d| wide.min[d] <= b.min[d] && wide.max[d] >= b.max[d]);
            others.into_iter().all(is_in)
        };
        let is_page = |own: Bounds| {
            let near = |a: Point, b: Point| (a - b).norm() <= PAGE_TOL * own.diagonal();
            draft.page.is_some_and(|page| near(own.min, page.min) && near(own.max, page.max))
        };
        let is_frame = |i: &usize| {
            let own = boxes[*i].filter(|own| is_rectangle(&draft.parts[*i], *own));
            own.is_some_and(|own| is_page(own) || (!pages_only && holds_all(own, *i)))
        };
        let Some(frame) = blocks.iter().copied().find(is_frame).filter(|_| blocks.len() > 1) else { return };
        let element = draft.parts.remove(frame).element;
        draft.skip("it is a frame: a rectangle around all else, or as large as the page", element);
        *draft.left_out.entry("frame").or_default() += 1;
    }
}

/// True if the outline of a part is an upright rectangle that fills the box `own`.
fn is_rectangle(part: &Part, own: Bounds) -> bool {
    // A rectangle with a hole is a stone around others.
    let [outline] = part.subpaths() else { return false };
    let corners: Vec<Point> = outline.starts().map(|(from, _)| from).chain([outline.end()]).collect();
    let twice: f64 = corners.windows(2).map(|pair| crate::geometry::cross(pair[0] - own.min, pair[1] - own.min)).sum();
    corners.len() <= 5 && !outline.has_curves() && twice.abs() / 2.0 > RECTANGLE_SHARE * own.width() * own.height()
}
