//! [`Nodes`]: the points to which the corners of bodies move. Corners that are close together share one node.
//!
//! Corners are clustered bottom up with complete linkage: pairs are merged in the order of their distance, and two
//! clusters are merged only if every corner of one lies within the gap of every corner of the other. A long chain of
//! close corners therefore does not merge into one node. Reference: Everitt et al., Cluster Analysis, 2011, §4.2.

use std::ops::Range;

use super::{Corner, Gaps, Rings, most_visits};
use crate::geometry::{Aabb, BoxIndex, Point, Vector};

/// A point that replaces one or more corners.
pub(super) struct Node {
    pub(super) at: Point,
    /// The range of its bodies in [`Nodes::bodies`], the list for all nodes.
    bodies: Range<usize>,
    /// The smallest gap of its corners, in metres.
    pub(super) gap: f64,
    /// Whether the node must not move, because one of its bodies must stay as drawn.
    pub(super) fixed: bool,
}

/// All nodes, and the node of every corner.
pub(super) struct Nodes {
    pub(super) all: Vec<Node>,
    /// The bodies of all nodes in one list: those of the first node, then those of the second, and so on.
    bodies: Vec<usize>,
    /// Index of each body's first ring in the list of all rings.
    first_ring: Vec<usize>,
    /// Index of each ring's first corner in the list of all corners.
    first_corner: Vec<usize>,
    /// The number of the node of each corner.
    of_corner: Vec<usize>,
    /// Whether every corner lies exactly at its node.
    pub(super) exact: bool,
}

/// A corner that is not yet assigned to a node.
struct UnplacedCorner {
    at: Point,
    body: usize,
    /// The distance within which the corner is joined to other bodies, in metres.
    gap: f64,
}

/// A corner is paired with at most this number of corners at exactly its own position. One pair is enough to join a
/// corner to the cluster at its position; more pairs matter only if a body has several corners there. Thousands of
/// equal outlines would have millions of such pairs.
const MAX_COINCIDENT: usize = 64;

/// Returns the gap of each corner of a ring, in metres: the distance within which the corner is joined to other bodies.
///
/// This gap is the body's `gap`, but at most the fraction `share` of the shorter of the corner's two sides.
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
    /// Merges close corners of different bodies into nodes, the closest pairs first. Two corners are close if their
    /// distance is at most the smaller of their gaps.
    ///
    /// A node lies at a corner of a body that is marked in `kept`. Without such a body, it lies at the corner of the
    /// earliest body, or in the middle of its corners if this body is one of `gaps.moved_from` and later.
    pub(super) fn new(bodies: &[Rings], gaps: Gaps<'_>, kept: &[bool]) -> Nodes {
        // List all corners with their gaps.
        let rings = bodies.iter().flatten();
        let mut corners: Vec<UnplacedCorner> = Vec::with_capacity(rings.clone().map(Vec::len).sum());
        let mut first_ring = Vec::with_capacity(bodies.len());
        let mut first_corner = Vec::with_capacity(rings.count());
        for (body, rings) in bodies.iter().enumerate() {
            first_ring.push(first_corner.len());
            for ring in rings {
                first_corner.push(corners.len());
                let gaps = gaps_of_corners(ring, gaps.of_body[body], gaps.share_of_edge);
                let loose = |(c, gap): (&Corner, f64)| UnplacedCorner { at: c.at, body, gap };
                corners.extend(ring.iter().zip(gaps).map(loose));
            }
        }
        let joined = clustered(&corners, kept);
        let (all, bodies, number) = merge(&corners, &joined, kept, gaps.moved_from);
        // The node of a corner is the node of its cluster's first corner.
        let of_corner: Vec<usize> = joined.first.iter().map(|first| number[*first]).collect();
        let places = of_corner.iter().map(|n| all[*n].at);
        let exact = places.zip(&corners).all(|(at, corner)| at == corner.at);
        Nodes { all, bodies, first_ring, first_corner, of_corner, exact }
    }

    /// Returns the bodies with a corner at a node, each once, in ascending order.
    pub(super) fn bodies(&self, node: &Node) -> &[usize] {
        &self.bodies[node.bodies.clone()]
    }

    /// Returns the index, in `all`, of the node that replaces a corner. The corner is given by its body, its ring in
    /// this body, and its number in this ring.
    pub(super) fn number(&self, body: usize, ring: usize, corner: usize) -> usize {
        self.of_corner[self.first_corner[self.first_ring[body] + ring] + corner]
    }
}

/// A partition of the corners into clusters. The corners of a cluster form a circular linked list.
struct Clusters {
    /// For each corner, the first corner of its cluster.
    first: Vec<usize>,
    /// For each corner, the next corner in its cluster's circular list; the corner itself if it is alone.
    next: Vec<usize>,
}

impl Clusters {
    /// Returns the corners of the cluster that contains the corner `of`, beginning with `of`.
    fn members(&self, of: usize) -> impl Iterator<Item = usize> + '_ {
        let following = move |k: &usize| Some(self.next[*k]).filter(|next| *next != of);
        std::iter::successors(Some(of), following)
    }

    /// Merges the clusters whose first corners are `a` and `b`. The number `a` must be less than `b`.
    fn join(&mut self, a: usize, b: usize) {
        // Assign every corner of cluster `b` to `a`. Then join the two circular lists by exchanging the successors of
        // `a` and `b`.
        let mut k = b;
        while self.first[k] != a {
            self.first[k] = a;
            k = self.next[k];
        }
        self.next.swap(a, b);
    }
}

/// Makes one node for each cluster. Returns the nodes, the bodies of all nodes in one list, and a list of node indices:
/// the entry at the first corner of a cluster is the index of the cluster's node.
fn merge(
    corners: &[UnplacedCorner],
    joined: &Clusters,
    kept: &[bool],
    moved_from: usize,
) -> (Vec<Node>, Vec<usize>, Vec<usize>) {
    // Create the node of each cluster when the loop reaches the first corner of the cluster.
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
        // The node lies at the corner of the first kept body, or else at the first corner of the cluster. Its gap is
        // the smallest gap of its corners.
        let mut at = corner.at;
        let mut gap = f64::INFINITY;
        let mut fixed = false;
        for k in &members {
            let UnplacedCorner { at: own, body, gap: own_gap } = corners[*k];
            if kept[body] && !fixed {
                (at, fixed) = (own, true);
            }
            gap = gap.min(own_gap);
            bodies.push(body);
        }
        if !fixed && corner.body >= moved_from {
            let offs = members.iter().map(|k| corners[*k].at - corner.at);
            at = corner.at + offs.sum::<Vector>() / members.len() as f64;
        }
        number[first] = all.len();
        all.push(Node { at, bodies: begin..bodies.len(), gap, fixed });
    }
    (all, bodies, number)
}

/// Clusters close corners of different bodies by complete linkage, the closest pairs first. Two corners are close if
/// their distance is at most the smaller of their gaps.
fn clustered(corners: &[UnplacedCorner], kept: &[bool]) -> Clusters {
    let mut clusters = Clusters { first: (0..corners.len()).collect(), next: (0..corners.len()).collect() };
    for (_, i, j) in close_pairs(corners) {
        let (i, j) = (clusters.first[i], clusters.first[j]);
        let (a, b) = (i.min(j), i.max(j));
        if a == b {
            continue;
        }
        // Complete linkage: in every pair of corners from the two clusters, the corners must be close, belong to
        // different bodies, and not be two kept corners at different points.
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

/// Returns the pairs of corners of different bodies whose distance is at most the smaller of their gaps, as (distance
/// in metres, corner, corner).
///
/// The pairs are sorted by distance, then by the numbers of the corners, so that the result does not depend on the
/// order in which the spatial index finds them. A corner gets at most [`MAX_COINCIDENT`] pairs with earlier corners at
/// its own position. If there are more neighbours than [`most_visits`], no corners are joined.
fn close_pairs(corners: &[UnplacedCorner]) -> Vec<(f64, usize, usize)> {
    let nearby = BoxIndex::new((0..corners.len()).collect(), |i: &usize| {
        let at = corners[*i].at.into();
        Aabb { min: at, max: at }
    });
    let mut pairs = Vec::new();
    let mut coincident = Vec::new();
    let mut visits = most_visits(corners.len());
    for (i, corner) in corners.iter().enumerate() {
        coincident.clear();
        // Search a square around each corner. List each pair once, if its distance is at most the smaller of the two
        // gaps.
        let (x, y) = (corner.at.x, corner.at.y);
        let gap = corner.gap;
        let around = Aabb { min: [x - gap, y - gap], max: [x + gap, y + gap] };
        for j in nearby.intersecting(around).copied() {
            visits = visits.saturating_sub(1);
            let distance = (corners[j].at - corner.at).norm();
            let gap = gap.min(corners[j].gap);
            if j < i && corners[j].body != corner.body && distance <= gap {
                if distance == 0.0 { coincident.push(j) } else { pairs.push((distance, i, j)) }
            }
        }
        if visits == 0 {
            return Vec::new();
        }
        coincident.sort_unstable();
        let first = coincident.iter().take(MAX_COINCIDENT);
        pairs.extend(first.map(|j| (0.0, i, *j)));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    pairs
}

#[cfg(test)]
mod tests;
