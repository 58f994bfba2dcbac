//! [`Nearby`]: things found by the boxes around them.
//!
//! Of few every box is looked at; of many a tree is made first, which is dearer than many such looks.

use rstar::{AABB, Envelope, RTree, RTreeObject};

/// The box around a thing, in metres.
pub(crate) type Around = AABB<[f64; 2]>;

/// Up to so many things need no tree.
const FEW: usize = 64;

/// Things that have boxes around them.
pub(crate) enum Nearby<T: RTreeObject<Envelope = Around>> {
    Few(Vec<(Around, T)>),
    Many(RTree<T>),
}

impl<T: RTreeObject<Envelope = Around>> Nearby<T> {
    pub(crate) fn of(things: Vec<T>) -> Nearby<T> {
        if things.len() > FEW {
            return Nearby::Many(RTree::bulk_load(things));
        }
        let boxed = |thing: T| (thing.envelope(), thing);
        Nearby::Few(things.into_iter().map(boxed).collect())
    }

    /// All of them, in no order that may matter.
    pub(crate) fn all(&self) -> impl Iterator<Item = &T> {
        let (few, many) = self.parts();
        let many = many.into_iter().flat_map(RTree::iter);
        few.iter().map(|(_, thing)| thing).chain(many)
    }

    /// Those whose boxes share a point with a box, in no order that may matter.
    pub(crate) fn near(&self, around: Around) -> impl Iterator<Item = &T> {
        let (few, many) = self.parts();
        let few = few.iter().filter(move |(own, _)| own.intersects(&around));
        let many = many.into_iter();
        let many = many.flat_map(move |tree| tree.locate_in_envelope_intersecting(around));
        few.map(|(_, thing)| thing).chain(many)
    }

    fn parts(&self) -> (&[(Around, T)], Option<&RTree<T>>) {
        match self {
            Nearby::Few(few) => (few, None),
            Nearby::Many(tree) => (&[], Some(tree)),
        }
    }
}

#[cfg(test)]
mod tests {
    use rstar::primitives::GeomWithData;

    use super::*;

    #[test]
    fn few_and_many_are_found_alike() {
        for side in [7_usize, 12] {
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
}
