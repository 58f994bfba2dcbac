//! [`Bounds`], an axis-parallel rectangle, and [`BoxIndex`], which finds all items whose bounding box intersects a query
//! box.
//!
//! Up to [`MAX_SCANNED_ITEMS`] items are kept in a list sorted by the left end of their boxes and scanned (sweep and
//! prune). More items are put into a bounding-volume hierarchy: a binary tree that splits the items at the median of
//! one coordinate, and whose nodes store the box around their items. Building the tree costs more than many scans of a
//! short list.
//!
//! A box may have more than the two coordinates of the plane. The axis-parallel box of a thin, inclined stone can
//! overlap hundreds of others. A box that also bounds x + y and y − x ([`Aabb::with_diagonals`]), or another direction,
//! overlaps only a few.
//!
//! Reference: Ericson, Real-Time Collision Detection, 2005, chapters 6 (bounding-volume hierarchies) and 7 (sorted
//! lists).

use super::{Edge, Point, Vector, quarter_turn};

/// The largest number of items that are kept in a sorted list; more are put into a tree.
const MAX_SCANNED_ITEMS: usize = 64;

/// The largest number of items in a leaf of the tree.
const MAX_LEAF_ITEMS: usize = 8;

/// An axis-aligned bounding box: the least and the greatest value of each of `D` coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb<const D: usize = 2> {
    pub(crate) min: [f64; D],
    pub(crate) max: [f64; D],
}

impl Aabb<3> {
    /// Returns the ranges of x, y and the dot product with `across` over the points. Long parallel sides have disjoint
    /// ranges if `across` is perpendicular to them. The third range contains the error of rounding.
    pub(crate) fn with_direction(points: &[Point], across: Vector) -> Aabb<3> {
        points.iter().fold(Aabb::EMPTY, |bounds, p| {
            let (x, y) = (across.x * p.x, across.y * p.y);
            let error = 2.0 * f64::EPSILON * (x.abs() + y.abs());
            bounds.union(&Aabb { min: [p.x, p.y, x + y - error], max: [p.x, p.y, x + y + error] })
        })
    }
}

impl Aabb<4> {
    /// Returns the ranges of x, y, x + y and y − x over the points. These ranges describe two boxes around the points:
    /// an upright box and a box rotated by 45°.
    pub(crate) fn with_diagonals(points: &[Point]) -> Aabb<4> {
        points.iter().fold(Aabb::EMPTY, |bounds, p| {
            let at = [p.x, p.y, p.x + p.y, p.y - p.x];
            bounds.union(&Aabb { min: at, max: at })
        })
    }
}

impl<const D: usize> Aabb<D> {
    /// The box that contains no point: the neutral element of [`Aabb::union`].
    const EMPTY: Aabb<D> = Aabb { min: [f64::INFINITY; D], max: [f64::NEG_INFINITY; D] };

    /// Returns the box extended by `margin` on each side.
    pub(crate) fn grown(self, margin: f64) -> Aabb<D> {
        Aabb { min: self.min.map(|min| min - margin), max: self.max.map(|max| max + margin) }
    }

    /// True if the two boxes share at least one point. Boxes that only touch share points.
    pub(crate) fn intersects(&self, other: &Aabb<D>) -> bool {
        (0..D).all(|d| self.min[d] <= other.max[d] && self.max[d] >= other.min[d])
    }

    /// Returns the smallest box that contains both boxes.
    fn union(&self, other: &Aabb<D>) -> Aabb<D> {
        Aabb {
            min: std::array::from_fn(|d| self.min[d].min(other.min[d])),
            max: std::array::from_fn(|d| self.max[d].max(other.max[d])),
        }
    }

    /// Returns coordinate `d` of the box's centre, multiplied by 2. This saves a division, and the factor does not
    /// matter for comparisons.
    fn doubled_centre(&self, d: usize) -> f64 {
        self.min[d] + self.max[d]
    }
}

/// Returns a unit vector perpendicular to the longest of these edges; the x axis if there are none with a length.
pub(crate) fn across_longest(edges: impl Iterator<Item = Edge>) -> Vector {
    let longest = edges.map(|e| e.vector()).fold(Vector::zeros(), |longest, side| {
        if side.norm_squared() > longest.norm_squared() { side } else { longest }
    });
    quarter_turn(longest).try_normalize(0.0).unwrap_or(Vector::x())
}

/// Items that can be searched by their bounding boxes.
pub(crate) enum BoxIndex<T, const D: usize = 2> {
    /// A sorted list of up to [`MAX_SCANNED_ITEMS`] items.
    Sorted(SortedBoxes<T, D>),
    /// A tree of more than [`MAX_SCANNED_ITEMS`] items.
    Tree(BoxTree<T, D>),
}

/// Items sorted by the left ends of their boxes.
pub(crate) struct SortedBoxes<T, const D: usize> {
    entries: Vec<SortedEntry<T, D>>,
}

struct SortedEntry<T, const D: usize> {
    bounds: Aabb<D>,
    /// The largest right end of all boxes in the list up to and including this box.
    max_right: f64,
    item: T,
}

impl<T, const D: usize> SortedBoxes<T, D> {
    fn new(items: Vec<T>, bounds: impl Fn(&T) -> Aabb<D>) -> SortedBoxes<T, D> {
        let entry = |item: T| SortedEntry { bounds: bounds(&item), max_right: 0.0, item };
        let mut entries: Vec<SortedEntry<T, D>> = items.into_iter().map(entry).collect();
        entries.sort_by(|a, b| a.bounds.min[0].total_cmp(&b.bounds.min[0]));
        let mut max_right = f64::NEG_INFINITY;
        for entry in &mut entries {
            max_right = max_right.max(entry.bounds.max[0]);
            entry.max_right = max_right;
        }
        SortedBoxes { entries }
    }

    fn intersecting(&self, query: Aabb<D>) -> impl Iterator<Item = &T> {
        // All boxes before `begin` lie to the left of the query. The scan stops at the first box that begins to the
        // right of the query.
        let left = query.min[0];
        let begin = self.entries.partition_point(|entry| entry.max_right < left);
        let rest = self.entries[begin..].iter();
        let candidates = rest.take_while(move |entry| entry.bounds.min[0] <= query.max[0]);
        candidates.filter_map(move |SortedEntry { bounds, item, .. }| bounds.intersects(&query).then_some(item))
    }
}

/// A bounding-volume hierarchy: a binary tree of boxes, with up to [`MAX_LEAF_ITEMS`] items in each leaf.
pub(crate) struct BoxTree<T, const D: usize> {
    /// The items with their boxes, in the order of the leaves.
    entries: Vec<(Aabb<D>, T)>,
    /// The nodes in depth-first order: a node is followed by its first child's subtree, then by its second child's.
    nodes: Vec<Node<D>>,
}

struct Node<const D: usize> {
    /// The box around all items below this node.
    bounds: Aabb<D>,
    /// Index of the first node after this subtree. A search that does not descend into this subtree continues there.
    skip_to: usize,
    /// Indices of a leaf's items; empty for an inner node.
    items: std::ops::Range<usize>,
}

impl<T, const D: usize> BoxTree<T, D> {
    fn new(items: Vec<T>, bounds: impl Fn(&T) -> Aabb<D>) -> BoxTree<T, D> {
        let boxes = items.iter().map(bounds).enumerate();
        let mut order: Vec<(Aabb<D>, usize)> = boxes.map(|(n, bounds)| (bounds, n)).collect();
        let typical = typical_extent(&order);
        let mut nodes = Vec::with_capacity(4 * order.len() / MAX_LEAF_ITEMS);
        build(&mut order, 0, &typical, &mut nodes);
        let mut items: Vec<Option<T>> = items.into_iter().map(Some).collect();
        let entries = order.into_iter().filter_map(|(bounds, number)| Some((bounds, items[number].take()?)));
        BoxTree { entries: entries.collect(), nodes }
    }

    fn intersecting(&self, query: Aabb<D>) -> impl Iterator<Item = &T> {
        // Walk depth-first without a stack. If the box of a node does not intersect the query, `skip_to` leads to the
        // next node outside its subtree.
        let (mut node, mut leaf) = (0, [].iter());
        std::iter::from_fn(move || {
            loop {
                if let Some((_, item)) = leaf.find(|(bounds, _)| query.intersects(bounds)) {
                    return Some(item);
                }
                let next = self.nodes.get(node)?;
                if query.intersects(&next.bounds) {
                    leaf = self.entries[next.items.clone()].iter();
                    node += 1;
                } else {
                    node = next.skip_to;
                }
            }
        })
    }
}

/// Returns the typical size of a box in each coordinate. Distances in different coordinates are divided by these sizes
/// before they are compared.
///
/// Each typical size is the median size plus 1/500 of the interquartile range of the centres. The median is used
/// because the ground may be far larger than all other items. The second term prevents a result near 0 for point-like
/// boxes.
fn typical_extent<const D: usize>(order: &[(Aabb<D>, usize)]) -> [f64; D] {
    const SPREAD_SHARE: f64 = 1e-3;
    let mut values = Vec::with_capacity(order.len());
    let mut quartile = |value: &dyn Fn(&Aabb<D>) -> f64, quarters: usize| {
        values.clear();
        values.extend(order.iter().map(|(bounds, _)| value(bounds)));
        let place = quarters * values.len() / 4;
        *values.select_nth_unstable_by(place, f64::total_cmp).1
    };
    std::array::from_fn(|d| {
        let median_size = quartile(&|bounds| bounds.max[d] - bounds.min[d], 2);
        let centre = |bounds: &Aabb<D>| bounds.doubled_centre(d);
        let spread = quartile(&centre, 3) - quartile(&centre, 1);
        median_size + SPREAD_SHARE * spread + f64::MIN_POSITIVE
    })
}

/// Returns, for each coordinate, twice the difference between the largest and the smallest centre of the boxes.
fn doubled_centre_range<const D: usize>(order: &[(Aabb<D>, usize)]) -> [f64; D] {
    let (mut min, mut max) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for (bounds, _) in order {
        for d in 0..D {
            min[d] = min[d].min(bounds.doubled_centre(d));
            max[d] = max[d].max(bounds.doubled_centre(d));
        }
    }
    std::array::from_fn(|d| max[d] - min[d])
}

/// Builds the subtree of the boxes in `order`: sorts these boxes into the order of the leaves, and appends the nodes of
/// the subtree to `nodes`.
///
/// `begin` is the position of the first of these boxes in the list of all boxes.
fn build<const D: usize>(order: &mut [(Aabb<D>, usize)], begin: usize, typical: &[f64; D], nodes: &mut Vec<Node<D>>) {
    let number = nodes.len();
    nodes.push(Node { bounds: Aabb::EMPTY, skip_to: 0, items: begin..begin });
    if order.len() <= MAX_LEAF_ITEMS {
        nodes[number].bounds = order.iter().fold(Aabb::EMPTY, |all, b| all.union(&b.0));
        nodes[number].items.end += order.len();
    } else {
        // Split along the coordinate in which the range of the centres, divided by the typical size, is largest.
        let range = doubled_centre_range(order);
        let relative = |d: &usize| range[*d] / typical[*d];
        let split = (0..D).max_by(|a, b| relative(a).total_cmp(&relative(b)));
        let split = split.unwrap_or(0);
        let half = order.len() / 2;
        order
            .select_nth_unstable_by(half, |(a, _), (b, _)| a.doubled_centre(split).total_cmp(&b.doubled_centre(split)));
        let (low, high) = order.split_at_mut(half);
        build(low, begin, typical, nodes);
        let second = nodes.len();
        build(high, begin + half, typical, nodes);
        nodes[number].bounds = nodes[number + 1].bounds.union(&nodes[second].bounds);
    }
    nodes[number].skip_to = nodes.len();
}

impl<T, const D: usize> BoxIndex<T, D> {
    /// Creates an index of `items`. The function `bounds` returns the box of an item.
    pub(crate) fn new(items: Vec<T>, bounds: impl Fn(&T) -> Aabb<D>) -> BoxIndex<T, D> {
        if items.len() > MAX_SCANNED_ITEMS {
            return BoxIndex::Tree(BoxTree::new(items, bounds));
        }
        BoxIndex::Sorted(SortedBoxes::new(items, bounds))
    }

    /// Returns all items with their boxes. Callers must not rely on the order of the items.
    pub(crate) fn all(&self) -> impl Iterator<Item = (&Aabb<D>, &T)> {
        let (sorted, tree) = self.variants();
        let sorted = sorted.into_iter().flat_map(|list| &list.entries);
        let tree = tree.into_iter().flat_map(|tree| &tree.entries);
        (sorted.map(|entry| (&entry.bounds, &entry.item))).chain(tree.map(|(bounds, item)| (bounds, item)))
    }

    /// Returns the items whose boxes intersect `query`. Callers must not rely on the order of the items.
    pub(crate) fn intersecting(&self, query: Aabb<D>) -> impl Iterator<Item = &T> {
        let (sorted, tree) = self.variants();
        let sorted = sorted.into_iter();
        let sorted = sorted.flat_map(move |list| list.intersecting(query));
        let tree = tree.into_iter();
        sorted.chain(tree.flat_map(move |tree| tree.intersecting(query)))
    }

    /// Returns the sorted list and the tree of this index; one of them is `Some`, the other is `None`. Callers chain
    /// iterators over both options, so that one iterator type serves both variants.
    fn variants(&self) -> (Option<&SortedBoxes<T, D>>, Option<&BoxTree<T, D>>) {
        match self {
            BoxIndex::Sorted(list) => (Some(list), None),
            BoxIndex::Tree(tree) => (None, Some(tree)),
        }
    }
}

/// An axis-parallel rectangle, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Bounds {
    /// Returns the smallest axis-parallel rectangle that contains all points; `None` if there are no points.
    pub fn from_points(points: impl IntoIterator<Item = Point>) -> Option<Bounds> {
        points.into_iter().fold(None, |bounds: Option<Bounds>, p| {
            let b = bounds.unwrap_or(Bounds { min: p, max: p });
            Some(Bounds { min: b.min.inf(&p), max: b.max.sup(&p) })
        })
    }

    /// Returns the smallest rectangle that contains both rectangles.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// Returns the rectangle extended by `margin` metres on every side.
    pub fn grown(self, margin: f64) -> Bounds {
        let m = Vector::new(margin, margin);
        Bounds { min: self.min - m, max: self.max + m }
    }

    /// Returns the length of the diagonal in metres.
    pub fn diagonal(self) -> f64 {
        (self.max - self.min).norm()
    }

    /// Returns the width in metres.
    pub fn width(self) -> f64 {
        self.max.x - self.min.x
    }

    /// Returns the height in metres.
    pub fn height(self) -> f64 {
        self.max.y - self.min.y
    }

    /// True if a point lies in the rectangle or on its boundary.
    pub(crate) fn contains(self, p: Point) -> bool {
        (self.min.x..=self.max.x).contains(&p.x) && (self.min.y..=self.max.y).contains(&p.y)
    }

    /// True if the two rectangles share at least one point. Rectangles that only touch share points.
    pub fn intersects(self, other: Bounds) -> bool {
        self.min.x <= other.max.x && other.min.x <= self.max.x && self.min.y <= other.max.y && other.min.y <= self.max.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(at: [f64; 2]) -> Aabb {
        Aabb { min: at, max: at }
    }

    /// A hundred parallel needles, all inclined by 45°. Their axis-parallel boxes intersect, but their boxes with
    /// diagonals do not.
    #[test]
    fn inclined_needles_do_not_intersect() {
        let needle = |n: usize| {
            let x = n as f64;
            [Point::new(x, 0.0), Point::new(x + 200.0, 200.0)]
        };
        let bounds = |n: &usize| Aabb::with_diagonals(&needle(*n));
        let things = BoxIndex::new((0..100).collect(), bounds);
        for n in 0..100 {
            assert_eq!(things.intersecting(bounds(&n)).collect::<Vec<_>>(), [&n]);
        }
    }

    #[test]
    fn list_and_tree_find_the_same_items() {
        for side in [7_usize, 8, 12] {
            let at = |n: usize| [(n / side) as f64, (n % side) as f64];
            let things = BoxIndex::new((0..side * side).collect(), |n| point(at(*n)));
            assert_eq!(matches!(things, BoxIndex::Sorted(_)), side * side <= MAX_SCANNED_ITEMS);
            assert_eq!(things.all().count(), side * side);
            let found = things.intersecting(Aabb { min: [0.5, 1.0], max: [2.0, 3.0] });
            let mut found: Vec<usize> = found.copied().collect();
            found.sort_unstable();
            let wanted = [1, 2].map(|x| [1, 2, 3].map(|y| x * side + y));
            assert_eq!(found, wanted.concat());
        }
    }

    /// Boxes of several sizes with integer corners, so that many boxes only touch.
    #[test]
    fn exactly_the_boxes_that_share_a_point_are_found() {
        let mut seed = 1_u64;
        let mut upto = |n: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((seed >> 33) % n) as i32
        };
        for count in [1, 2, 5, 20, MAX_SCANNED_ITEMS, MAX_SCANNED_ITEMS + 1, 150] {
            let mut any = || {
                let (x, y) = (upto(12), upto(12));
                [x, y, x + upto(5), y + upto(5)]
            };
            let all: Vec<[i32; 4]> = (0..count).map(|_| any()).collect();
            let around = |b: [i32; 4]| {
                let [x, y, right, high] = b.map(f64::from);
                Aabb { min: [x, y], max: [right, high] }
            };
            let things = BoxIndex::new((0..count).collect(), |n| around(all[*n]));
            for _ in 0..60 {
                let asked = any();
                let mut found: Vec<usize> = things.intersecting(around(asked)).copied().collect();
                found.sort_unstable();
                let apart = |a: [i32; 4], b: [i32; 4]| a[2] < b[0] || a[3] < b[1];
                let meets = |n: &usize| !apart(all[*n], asked) && !apart(asked, all[*n]);
                let wanted: Vec<usize> = (0..count).filter(meets).collect();
                assert_eq!(found, wanted, "{asked:?} of {count}");
            }
        }
    }
}
