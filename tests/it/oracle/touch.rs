//! Finds contacts without any tolerance: edges that lie exactly on one line, face each other and overlap.

use dashu_ratio::RBig;
use drystone::internals::interface::Interfaces;
use drystone::scene::{BlockId, Body, BodyId, Scene};

/// An exact point or vector.
pub type Pair = [RBig; 2];

/// A straight contact between a block and another body.
#[derive(Clone, Debug)]
pub struct Touch {
    /// The number of the block.
    pub on: usize,
    /// The number of the other block; `None` for the ground.
    pub from: Option<usize>,
    /// The ends of the contact. Seen from the second end towards the first, the block `on` lies to the left.
    pub ends: [Pair; 2],
    pub friction: f64,
}

/// A floating-point number as an exact fraction.
pub fn exact(value: f64) -> RBig {
    RBig::try_from(value).expect("scenes contain only finite numbers")
}

pub fn pair(x: f64, y: f64) -> Pair {
    [exact(x), exact(y)]
}

pub fn minus(a: &Pair, b: &Pair) -> Pair {
    [&a[0] - &b[0], &a[1] - &b[1]]
}

pub fn cross(a: &Pair, b: &Pair) -> RBig {
    &a[0] * &b[1] - &a[1] * &b[0]
}

pub fn dot(a: &Pair, b: &Pair) -> RBig {
    &a[0] * &b[0] + &a[1] * &b[1]
}

/// The corners of a body's outline in anticlockwise order.
pub fn corners(body: &Body) -> Vec<Pair> {
    let mut corners: Vec<Pair> = body.polygon.outline().iter().map(|p| pair(p.x, p.y)).collect();
    let twice: RBig = (0..corners.len())
        .map(|i| cross(&corners[i], &corners[(i + 1) % corners.len()]))
        .fold(RBig::ZERO, |a, b| a + b);
    if twice < RBig::ZERO {
        corners.reverse();
    }
    corners
}

/// All exact contacts of a scene.
pub fn touches(scene: &Scene) -> Vec<Touch> {
    let blocks: Vec<Vec<Pair>> = scene.blocks().iter().map(|b| corners(&b.body)).collect();
    let ground: Vec<Vec<Pair>> = scene.ground().iter().map(|g| corners(&g.body)).collect();
    let mut found = Vec::new();
    for (i, one) in blocks.iter().enumerate() {
        for (j, other) in blocks[..i].iter().enumerate() {
            let friction = scene.blocks()[i].body.friction.min(scene.blocks()[j].body.friction);
            let common_segments = joined(common_segments(one, other));
            found.extend(common_segments.into_iter().map(|ends| Touch { on: i, from: Some(j), ends, friction }));
        }
        for (j, other) in ground.iter().enumerate() {
            let friction = scene.blocks()[i].body.friction.min(scene.ground()[j].body.friction);
            let common_segments = joined(common_segments(one, other));
            found.extend(common_segments.into_iter().map(|ends| Touch { on: i, from: None, ends, friction }));
        }
    }
    found
}

/// The contacts that drystone found, for scenes whose corners are not exact in floating-point numbers.
pub fn as_found(scene: &Scene) -> Vec<Touch> {
    let number = |body: BodyId| match body {
        BodyId::Block(BlockId(k)) => Some(k),
        BodyId::Ground(_) => None,
    };
    let all = Interfaces::new(scene).all;
    all.iter()
        .map(|i| Touch {
            on: number(i.bodies[0]).expect("the first body is a block"),
            from: number(i.bodies[1]),
            ends: i.ends.map(|p| pair(p.x, p.y)),
            friction: i.friction,
        })
        .collect()
}

/// The segments that the edges of two outlines have in common, if the bodies lie on opposite sides of them.
fn common_segments(one: &[Pair], other: &[Pair]) -> Vec<[Pair; 2]> {
    let mut found = Vec::new();
    for i in 0..one.len() {
        let (a, b) = (&one[i], &one[(i + 1) % one.len()]);
        let along = minus(b, a);
        for j in 0..other.len() {
            let (c, d) = (&other[j], &other[(j + 1) % other.len()]);
            let straight = cross(&along, &minus(c, a)) == RBig::ZERO && cross(&along, &minus(d, a)) == RBig::ZERO;
            if !straight || dot(&along, &minus(d, c)) >= RBig::ZERO {
                continue;
            }
            let position = |p: &Pair| dot(&along, &minus(p, a));
            let begin = if position(d) > RBig::ZERO { d } else { a };
            let end = if position(c) < position(b) { c } else { b };
            if position(begin) < position(end) {
                found.push([end.clone(), begin.clone()]);
            }
        }
    }
    found
}

/// Joins segments that lie on one line and share an end, so that a corner inside a straight edge does not split a
/// contact.
fn joined(mut list: Vec<[Pair; 2]>) -> Vec<[Pair; 2]> {
    let follows = |a: &[Pair; 2], b: &[Pair; 2]| {
        let (u, v) = (minus(&a[1], &a[0]), minus(&b[1], &b[0]));
        a[1] == b[0] && cross(&u, &v) == RBig::ZERO && dot(&u, &v) > RBig::ZERO
    };
    loop {
        let next = (0..list.len())
            .flat_map(|i| (0..list.len()).map(move |j| (i, j)))
            .find(|(i, j)| i != j && follows(&list[*i], &list[*j]));
        let Some((i, j)) = next else {
            return list;
        };
        list[i][1] = list[j][1].clone();
        list.swap_remove(j);
    }
}
