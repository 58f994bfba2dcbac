//! [`Nodes`]: places that corners of several bodies share.

use std::ops::Range;

use super::{Corner, Gaps, Rings};
use crate::geometry::{Aabb, BoxIndex, Point};

/// A place and the corners there.
pub(super) struct Node {
    pub(super) at: Point,
    /// Where its bodies stand in the list of all nodes' bodies.
    bodies: Range<usize>,
    /// The smallest gap of the corners here, metres.
    pub(super) gap: f64,
    /// Whether it may not move, because a body has to stay as it was drawn.
    pub(super) fixed: bool,
}

/// All nodes, and the node of every corner.
pub(super) struct Nodes {
    pub(super) all: Vec<Node>,
    /// The bodies of one node after the other.
    bodies: Vec<usize>,
    /// First ring of each body among all rings, and first corner of each ring among all corners.
    first_ring: Vec<usize>,
    first_corner: Vec<usize>,
    of_corner: Vec<usize>,
    /// Whether every corner lies exactly where its node does.
    pub(super) exact: bool,
}

/// A corner before it has a node.
struct Loose {
    at: Point,
    body: usize,
    /// How far it may move, metres.
    gap: f64,
}

/// How far the corners of a ring may move, metres, in a body of some gap: no farther than `share` of the shorter edge.
fn gaps_of_corners(ring: &[Corner], gap: f64, share: f64) -> impl Iterator<Item = f64> + '_ {
    let length = |a: &Corner, b: &Corner| (b.at - a.at).norm();
    ring.iter().enumerate().map(move |(i, corner)| {
        let before = &ring[(i + ring.len() - 1) % ring.len()];
        let after = &ring[(i + 1) % ring.len()];
        let shorter = length(before, corner).min(length(corner, after));
        gap.min(share * shorter)
    })
}

impl Nodes {
    /// Corners of different bodies, no farther than their gaps from each other, become one node, the nearest first. It lies
    /// at the corner of the earliest body, or of one that has to stay.
    pub(super) fn new(bodies: &[Rings], gaps: Gaps<'_>, kept: &[bool]) -> Nodes {
        let rings = bodies.iter().flatten();
        let mut corners: Vec<Loose> = Vec::with_capacity(rings.clone().map(Vec::len).sum());
        let mut first_ring = Vec::with_capacity(bodies.len());
        let mut first_corner = Vec::with_capacity(rings.count());
        for (body, rings) in bodies.iter().enumerate() {
            first_ring.push(first_corner.len());
            for ring in rings {
                first_corner.push(corners.len());
                let gaps = gaps_of_corners(ring, gaps.of_body[body], gaps.share_of_edge);
                let loose = |(c, gap): (&Corner, f64)| Loose {
                    at: c.at,
                    body,
                    gap,
                };
                corners.extend(ring.iter().zip(gaps).map(loose));
            }
        }
        let joined = joined(&corners, kept);
        let mut members = Vec::new();
        let mut number = vec![0; corners.len()];
        let mut all: Vec<Node> = Vec::with_capacity(corners.len());
        let mut bodies = Vec::with_capacity(corners.len());
        for (first, corner) in corners.iter().enumerate() {
            if joined.first[first] != first {
                continue;
            }
            members.clear();
            members.extend(joined.members(first));
            members.sort_unstable();
            let begin = bodies.len();
            let mut at = corner.at;
            let mut gap = f64::INFINITY;
            let mut fixed = false;
            for k in &members {
                let Loose {
                    at: own,
                    body,
                    gap: own_gap,
                } = corners[*k];
                if kept[body] && !fixed {
                    (at, fixed) = (own, true);
                }
                gap = gap.min(own_gap);
                bodies.push(body);
            }
            number[first] = all.len();
            all.push(Node {
                at,
                bodies: begin..bodies.len(),
                gap,
                fixed,
            });
        }
        let of_corner: Vec<usize> = joined.first.iter().map(|first| number[*first]).collect();
        let places = of_corner.iter().map(|n| all[*n].at);
        let exact = places.zip(&corners).all(|(at, corner)| at == corner.at);
        Nodes {
            all,
            bodies,
            first_ring,
            first_corner,
            of_corner,
            exact,
        }
    }

    /// Bodies with a corner at a node, each once, in their order.
    pub(super) fn bodies(&self, node: &Node) -> &[usize] {
        &self.bodies[node.bodies.clone()]
    }

    /// The node of a corner.
    pub(super) fn number(&self, body: usize, ring: usize, corner: usize) -> usize {
        self.of_corner[self.first_corner[self.first_ring[body] + ring] + corner]
    }
}

/// Corners parted into clusters. Those of one form a ring, so that none needs a list of its own.
struct Clusters {
    /// The first corner of each corner's cluster.
    first: Vec<usize>,
    /// Another corner of each corner's cluster, in no order; itself where it is alone.
    next: Vec<usize>,
}

impl Clusters {
    /// The corners of a cluster, the given one first.
    fn members(&self, of: usize) -> impl Iterator<Item = usize> + '_ {
        let following = move |k: &usize| Some(self.next[*k]).filter(|next| *next != of);
        std::iter::successors(Some(of), following)
    }

    /// Makes two clusters one, by their first corners, the lower one first.
    fn join(&mut self, a: usize, b: usize) {
        let mut k = b;
        while self.first[k] != a {
            self.first[k] = a;
            k = self.next[k];
        }
        self.next.swap(a, b);
    }
}

/// Joins corners of different bodies that lie within their gaps of each other, the nearest first.
fn joined(corners: &[Loose], kept: &[bool]) -> Clusters {
    let mut clusters = Clusters {
        first: (0..corners.len()).collect(),
        next: (0..corners.len()).collect(),
    };
    for (_, i, j) in near(corners) {
        let (i, j) = (clusters.first[i], clusters.first[j]);
        let (a, b) = (i.min(j), i.max(j));
        if a == b {
            continue;
        }
        let fits = clusters.members(a).all(|k| {
            clusters.members(b).all(|l| {
                let (k, l) = (&corners[k], &corners[l]);
                k.body != l.body
                    && (k.at - l.at).norm() <= k.gap.min(l.gap)
                    && !(kept[k.body] && kept[l.body] && k.at != l.at)
            })
        });
        if fits {
            clusters.join(a, b);
        }
    }
    clusters
}

/// Pairs of corners of different bodies within their gaps of each other, the nearest first.
fn near(corners: &[Loose]) -> Vec<(f64, usize, usize)> {
    let nearby = BoxIndex::new((0..corners.len()).collect(), |i: &usize| {
        let at = corners[*i].at.into();
        Aabb { min: at, max: at }
    });
    let mut pairs = Vec::new();
    for (i, corner) in corners.iter().enumerate() {
        let (x, y) = (corner.at.x, corner.at.y);
        let gap = corner.gap;
        let around = Aabb {
            min: [x - gap, y - gap],
            max: [x + gap, y + gap],
        };
        for j in nearby.intersecting(around).copied() {
            let distance = (corners[j].at - corner.at).norm();
            let gap = gap.min(corners[j].gap);
            if j < i && corners[j].body != corner.body && distance <= gap {
                pairs.push((distance, i, j));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    pairs
}

#[cfg(test)]
mod tests;
