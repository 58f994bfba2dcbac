//! [`Nearby`]: things found by the boxes around them.
//!
//! Of few every box is looked at; of many a tree is made first, which is dearer than many such looks.

use rstar::{AABB, RTree, RTreeObject};

/// The box around a thing, in metres.
pub(crate) type Around = AABB<[f64; 2]>;

/// Up to so many things need no tree.
const FEW: usize = 64;

/// Things that have boxes around them.
pub(crate) enum Nearby<T: RTreeObject<Envelope = Around>> {
    Few(Row<T>),
    Many(RTree<T>),
}

/// Things sorted by the left ends of their boxes.
pub(crate) struct Row<T> {
    all: Vec<Placed<T>>,
}

struct Placed<T> {
    /// Left, lower, right and upper end of its box.
    own: [f64; 4],
    /// How far the boxes up to and with this one reach to the right.
    reach: f64,
    thing: T,
}

impl<T: RTreeObject<Envelope = Around>> Row<T> {
    fn of(things: Vec<T>) -> Row<T> {
        let placed = |thing: T| Placed {
            own: ends(thing.envelope()),
            reach: 0.0,
            thing,
        };
        let mut all: Vec<Placed<T>> = things.into_iter().map(placed).collect();
        all.sort_by(|a, b| a.own[0].total_cmp(&b.own[0]));
        let mut farthest = f64::NEG_INFINITY;
        for placed in &mut all {
            farthest = farthest.max(placed.own[2]);
            placed.reach = farthest;
        }
        Row { all }
    }

    fn near(&self, [left, low, right, high]: [f64; 4]) -> impl Iterator<Item = &T> {
        // Before `begin` all boxes end, and from `end` on all begin, beside the one asked about.
        let begin = self.all.partition_point(|placed| placed.reach < left);
        let rest = self.all[begin..].iter();
        let some = rest.take_while(move |placed| placed.own[0] <= right);
        some.filter_map(move |Placed { own, thing, .. }| {
            (own[2] >= left && own[1] <= high && own[3] >= low).then_some(thing)
        })
    }
}

/// Left, lower, right and upper end of a box.
fn ends(around: Around) -> [f64; 4] {
    let ([left, low], [right, high]) = (around.lower(), around.upper());
    [left, low, right, high]
}

impl<T: RTreeObject<Envelope = Around>> Nearby<T> {
    pub(crate) fn of(things: Vec<T>) -> Nearby<T> {
        if things.len() > FEW {
            return Nearby::Many(RTree::bulk_load(things));
        }
        Nearby::Few(Row::of(things))
    }

    /// All of them, in no order that may matter.
    pub(crate) fn all(&self) -> impl Iterator<Item = &T> {
        let (few, many) = self.parts();
        let few = few
            .into_iter()
            .flat_map(|row| row.all.iter().map(|placed| &placed.thing));
        few.chain(many.into_iter().flat_map(RTree::iter))
    }

    /// Those whose boxes share a point with a box, in no order that may matter.
    pub(crate) fn near(&self, around: Around) -> impl Iterator<Item = &T> {
        let (few, many) = self.parts();
        let few = few.into_iter().flat_map(move |row| row.near(ends(around)));
        let many = many.into_iter();
        few.chain(many.flat_map(move |tree| tree.locate_in_envelope_intersecting(around)))
    }

    fn parts(&self) -> (Option<&Row<T>>, Option<&RTree<T>>) {
        match self {
            Nearby::Few(few) => (Some(few), None),
            Nearby::Many(tree) => (None, Some(tree)),
        }
    }
}

#[cfg(test)]
mod tests {
    use rstar::primitives::{GeomWithData, Rectangle};

    use super::*;

    #[test]
    fn few_and_many_are_found_alike() {
        for side in [7_usize, 8, 12] {
            let at = |n: usize| [(n / side) as f64, (n % side) as f64];
            let all = (0..side * side).map(|n| GeomWithData::new(at(n), n));
            let things = Nearby::of(all.collect());
            assert_eq!(matches!(things, Nearby::Few(_)), side * side <= FEW);
            assert_eq!(things.all().count(), side * side);
            let found = things.near(AABB::from_corners([0.5, 1.0], [2.0, 3.0]));
            let mut found: Vec<usize> = found.map(|thing| thing.data).collect();
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
                AABB::from_corners([x, y], [right, high])
            };
            let thing =
                |(n, b): (usize, &[i32; 4])| GeomWithData::new(Rectangle::from_aabb(around(*b)), n);
            let things = Nearby::of(all.iter().enumerate().map(thing).collect());
            for _ in 0..60 {
                let asked = any();
                let mut found: Vec<usize> = things.near(around(asked)).map(|t| t.data).collect();
                found.sort_unstable();
                let apart = |a: [i32; 4], b: [i32; 4]| a[2] < b[0] || a[3] < b[1];
                let meets = |n: &usize| !apart(all[*n], asked) && !apart(asked, all[*n]);
                let wanted: Vec<usize> = (0..count).filter(meets).collect();
                assert_eq!(found, wanted, "{asked:?} of {count}");
            }
        }
    }
}
