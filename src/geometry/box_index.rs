//! [`BoxIndex`]: things found by the boxes around them.
//!
//! Of few every box is looked at; of many a tree is made first, which is dearer than many such looks. A box may have more
//! sides than the plane has: of thin stones that lean, upright boxes overlap by the hundred, and boxes that lean as they
//! do, or tell directions apart, do not.

use super::Point;

/// Up to so many things need no tree.
const FEW: usize = 64;

/// So many things are looked at together, at most.
const TOGETHER: usize = 8;

/// The least and the greatest of each coordinate of a thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb<const D: usize = 2> {
    pub(crate) min: [f64; D],
    pub(crate) max: [f64; D],
}

impl Aabb {
    /// The box with everything that lies `by` metres off it.
    pub(crate) fn grown(self, by: f64) -> Aabb {
        Aabb {
            min: self.min.map(|least| least - by),
            max: self.max.map(|most| most + by),
        }
    }
}

impl Aabb<4> {
    /// The upright box around some points and the one that leans by 45°: x, y, x + y and y − x.
    pub(crate) fn leaning(points: &[Point]) -> Aabb<4> {
        points.iter().fold(Aabb::NOTHING, |around, p| {
            let at = [p.x, p.y, p.x + p.y, p.y - p.x];
            around.and(&Aabb { min: at, max: at })
        })
    }
}

impl<const D: usize> Aabb<D> {
    const NOTHING: Aabb<D> = Aabb {
        min: [f64::INFINITY; D],
        max: [f64::NEG_INFINITY; D],
    };

    /// Whether two boxes share a point.
    pub(crate) fn meets(&self, other: &Aabb<D>) -> bool {
        (0..D).all(|d| self.min[d] <= other.max[d] && self.max[d] >= other.min[d])
    }

    fn and(&self, other: &Aabb<D>) -> Aabb<D> {
        Aabb {
            min: std::array::from_fn(|d| self.min[d].min(other.min[d])),
            max: std::array::from_fn(|d| self.max[d].max(other.max[d])),
        }
    }

    /// Twice its middle.
    fn middle(&self, d: usize) -> f64 {
        self.min[d] + self.max[d]
    }
}

/// Things that have boxes around them.
pub(crate) enum BoxIndex<T, const D: usize = 2> {
    Few(SortedBoxes<T, D>),
    Many(Tree<T, D>),
}

/// Things sorted by the left ends of their boxes.
pub(crate) struct SortedBoxes<T, const D: usize> {
    all: Vec<Placed<T, D>>,
}

struct Placed<T, const D: usize> {
    own: Aabb<D>,
    /// How far the boxes up to and with this one reach to the right.
    reach: f64,
    thing: T,
}

impl<T, const D: usize> SortedBoxes<T, D> {
    fn new(things: Vec<T>, around: impl Fn(&T) -> Aabb<D>) -> SortedBoxes<T, D> {
        let placed = |thing: T| Placed {
            own: around(&thing),
            reach: 0.0,
            thing,
        };
        let mut all: Vec<Placed<T, D>> = things.into_iter().map(placed).collect();
        all.sort_by(|a, b| a.own.min[0].total_cmp(&b.own.min[0]));
        let mut farthest = f64::NEG_INFINITY;
        for placed in &mut all {
            farthest = farthest.max(placed.own.max[0]);
            placed.reach = farthest;
        }
        SortedBoxes { all }
    }

    fn intersecting(&self, asked: Aabb<D>) -> impl Iterator<Item = &T> {
        // Before `begin` all boxes end, and from `end` on all begin, beside the one asked about.
        let left = asked.min[0];
        let begin = self.all.partition_point(|placed| placed.reach < left);
        let rest = self.all[begin..].iter();
        let some = rest.take_while(move |placed| placed.own.min[0] <= asked.max[0]);
        some.filter_map(move |Placed { own, thing, .. }| own.meets(&asked).then_some(thing))
    }
}

/// Things halved again and again, across what parts them best, until few are left together.
pub(crate) struct Tree<T, const D: usize> {
    all: Vec<(Aabb<D>, T)>,
    /// Each before the two that it parts in.
    nodes: Vec<Node<D>>,
}

struct Node<const D: usize> {
    around: Aabb<D>,
    /// The first node that is not part of this one.
    next: usize,
    /// Its things, where it has no parts.
    things: std::ops::Range<usize>,
}

impl<T, const D: usize> Tree<T, D> {
    fn new(things: Vec<T>, around: impl Fn(&T) -> Aabb<D>) -> Tree<T, D> {
        let boxes = things.iter().map(around).enumerate();
        let mut order: Vec<(Aabb<D>, usize)> = boxes.map(|(n, own)| (own, n)).collect();
        let usual = usual(&order);
        let mut nodes = Vec::with_capacity(4 * order.len() / TOGETHER);
        parted(&mut order, 0, &usual, &mut nodes);
        let mut things: Vec<Option<T>> = things.into_iter().map(Some).collect();
        let taken = order.into_iter();
        let all = taken.filter_map(|(own, number)| Some((own, things[number].take()?)));
        Tree {
            all: all.collect(),
            nodes,
        }
    }

    fn intersecting(&self, asked: Aabb<D>) -> impl Iterator<Item = &T> {
        let (mut node, mut things) = (0, [].iter());
        std::iter::from_fn(move || {
            loop {
                if let Some((_, thing)) = things.find(|(own, _)| asked.meets(own)) {
                    return Some(thing);
                }
                let next = self.nodes.get(node)?;
                if asked.meets(&next.around) {
                    things = self.all[next.things.clone()].iter();
                    node += 1;
                } else {
                    node = next.next;
                }
            }
        })
    }
}

/// How long boxes are in each direction, half of them at most; where they are but points, a part of how far the inner half of
/// them is spread. The ground may reach much farther than all else.
fn usual<const D: usize>(order: &[(Aabb<D>, usize)]) -> [f64; D] {
    const PART: f64 = 1e-3;
    let mut all = Vec::with_capacity(order.len());
    let mut part = |of: &dyn Fn(&Aabb<D>) -> f64, quarters: usize| {
        all.clear();
        all.extend(order.iter().map(|(own, _)| of(own)));
        let place = quarters * all.len() / 4;
        *all.select_nth_unstable_by(place, f64::total_cmp).1
    };
    std::array::from_fn(|d| {
        let length = part(&|own| own.max[d] - own.min[d], 2);
        let middle = |own: &Aabb<D>| own.middle(d);
        length + PART * (part(&middle, 3) - part(&middle, 1)) + f64::MIN_POSITIVE
    })
}

/// How far apart the middles of boxes are, twice.
fn spread<const D: usize>(order: &[(Aabb<D>, usize)]) -> [f64; D] {
    let (mut least, mut most) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for (own, _) in order {
        for d in 0..D {
            least[d] = least[d].min(own.middle(d));
            most[d] = most[d].max(own.middle(d));
        }
    }
    std::array::from_fn(|d| most[d] - least[d])
}

/// Puts boxes in the order of the tree's leaves and adds its nodes; the first of them is number `begin` of all.
fn parted<const D: usize>(
    order: &mut [(Aabb<D>, usize)],
    begin: usize,
    usual: &[f64; D],
    nodes: &mut Vec<Node<D>>,
) {
    let number = nodes.len();
    nodes.push(Node {
        around: Aabb::NOTHING,
        next: 0,
        things: begin..begin,
    });
    if order.len() <= TOGETHER {
        nodes[number].around = order.iter().fold(Aabb::NOTHING, |all, b| all.and(&b.0));
        nodes[number].things.end += order.len();
    } else {
        let spread = spread(order);
        let parts = |d: &usize| spread[*d] / usual[*d];
        let across = (0..D).max_by(|a, b| parts(a).total_cmp(&parts(b)));
        let across = across.unwrap_or(0);
        let half = order.len() / 2;
        order.select_nth_unstable_by(half, |(a, _), (b, _)| {
            a.middle(across).total_cmp(&b.middle(across))
        });
        let (low, high) = order.split_at_mut(half);
        parted(low, begin, usual, nodes);
        let second = nodes.len();
        parted(high, begin + half, usual, nodes);
        nodes[number].around = nodes[number + 1].around.and(&nodes[second].around);
    }
    nodes[number].next = nodes.len();
}

impl<T, const D: usize> BoxIndex<T, D> {
    pub(crate) fn new(things: Vec<T>, around: impl Fn(&T) -> Aabb<D>) -> BoxIndex<T, D> {
        if things.len() > FEW {
            return BoxIndex::Many(Tree::new(things, around));
        }
        BoxIndex::Few(SortedBoxes::new(things, around))
    }

    /// All of them with the boxes around them, in no order that may matter.
    pub(crate) fn all(&self) -> impl Iterator<Item = (&Aabb<D>, &T)> {
        let (few, many) = self.parts();
        let few = few.into_iter().flat_map(|row| &row.all);
        let many = many.into_iter().flat_map(|tree| &tree.all);
        (few.map(|placed| (&placed.own, &placed.thing)))
            .chain(many.map(|(own, thing)| (own, thing)))
    }

    /// Those whose boxes share a point with a box, in no order that may matter.
    pub(crate) fn intersecting(&self, around: Aabb<D>) -> impl Iterator<Item = &T> {
        let (few, many) = self.parts();
        let few = few
            .into_iter()
            .flat_map(move |row| row.intersecting(around));
        let many = many.into_iter();
        few.chain(many.flat_map(move |tree| tree.intersecting(around)))
    }

    fn parts(&self) -> (Option<&SortedBoxes<T, D>>, Option<&Tree<T, D>>) {
        match self {
            BoxIndex::Few(few) => (Some(few), None),
            BoxIndex::Many(tree) => (None, Some(tree)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(at: [f64; 2]) -> Aabb {
        Aabb { min: at, max: at }
    }

    /// A hundred needles side by side, all leaning by 45°: their upright boxes meet, the leaning ones do not.
    #[test]
    fn needles_that_lean_are_told_apart() {
        let needle = |n: usize| {
            let x = n as f64;
            [Point::new(x, 0.0), Point::new(x + 200.0, 200.0)]
        };
        let leaning = |n: &usize| Aabb::leaning(&needle(*n));
        let things = BoxIndex::new((0..100).collect(), leaning);
        for n in 0..100 {
            assert_eq!(things.intersecting(leaning(&n)).collect::<Vec<_>>(), [&n]);
        }
    }

    #[test]
    fn few_and_many_are_found_alike() {
        for side in [7_usize, 8, 12] {
            let at = |n: usize| [(n / side) as f64, (n % side) as f64];
            let things = BoxIndex::new((0..side * side).collect(), |n| point(at(*n)));
            assert_eq!(matches!(things, BoxIndex::Few(_)), side * side <= FEW);
            assert_eq!(things.all().count(), side * side);
            let found = things.intersecting(Aabb {
                min: [0.5, 1.0],
                max: [2.0, 3.0],
            });
            let mut found: Vec<usize> = found.copied().collect();
            found.sort_unstable();
            let wanted = [1, 2].map(|x| [1, 2, 3].map(|y| x * side + y));
            assert_eq!(found, wanted.concat());
        }
    }

    /// Boxes of several sizes with corners in whole numbers, so that many only touch.
    #[test]
    fn found_is_whatever_shares_a_point_and_nothing_else() {
        let mut seed = 1_u64;
        let mut upto = |n: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((seed >> 33) % n) as i32
        };
        for count in [1, 2, 5, 20, FEW, FEW + 1, 150] {
            let mut any = || {
                let (x, y) = (upto(12), upto(12));
                [x, y, x + upto(5), y + upto(5)]
            };
            let all: Vec<[i32; 4]> = (0..count).map(|_| any()).collect();
            let around = |b: [i32; 4]| {
                let [x, y, right, high] = b.map(f64::from);
                Aabb {
                    min: [x, y],
                    max: [right, high],
                }
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
