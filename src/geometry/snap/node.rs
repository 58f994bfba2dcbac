//! [`Nodes`]: places that corners of several bodies share.

use rstar::AABB;
use rstar::primitives::GeomWithData;

use super::Rings;
use crate::geometry::{Nearby, Point};

/// A place and the corners there.
pub(super) struct Node {
    pub(super) at: Point,
    /// Bodies with a corner here, each once, in their order.
    pub(super) bodies: Vec<usize>,
    /// The smallest gap of these bodies, metres.
    pub(super) gap: f64,
    /// Whether it may not move, because a body has to stay as it was drawn.
    pub(super) fixed: bool,
}

/// All nodes, and the node of every corner.
pub(super) struct Nodes {
    pub(super) all: Vec<Node>,
    /// First corner of each ring of each body, among all corners.
    starts: Vec<Vec<usize>>,
    of_corner: Vec<usize>,
    /// Whether every corner lies exactly where its node does.
    pub(super) exact: bool,
}

struct Loose {
    at: Point,
    body: usize,
}

impl Nodes {
    /// Corners of different bodies, no farther than their gaps from each other, become one node, the nearest first. It lies
    /// at the corner of the earliest body, or of one that has to stay.
    pub(super) fn of(bodies: &[Rings], gaps: &[f64], kept: &[bool]) -> Nodes {
        let mut corners: Vec<Loose> = Vec::new();
        let mut starts = Vec::new();
        for (body, rings) in bodies.iter().enumerate() {
            let mut own = Vec::new();
            for ring in rings {
                own.push(corners.len());
                corners.extend(ring.iter().map(|c| Loose { at: c.at, body }));
            }
            starts.push(own);
        }
        let mut clusters: Vec<Vec<usize>> = (0..corners.len()).map(|i| vec![i]).collect();
        let mut cluster_of: Vec<usize> = (0..corners.len()).collect();
        for (_, i, j) in near(&corners, gaps) {
            let (a, b) = (
                cluster_of[i].min(cluster_of[j]),
                cluster_of[i].max(cluster_of[j]),
            );
            if a == b {
                continue;
            }
            let fits = clusters[a].iter().all(|k| {
                clusters[b].iter().all(|l| {
                    let (k, l) = (&corners[*k], &corners[*l]);
                    k.body != l.body
                        && (k.at - l.at).norm() <= gaps[k.body].min(gaps[l.body])
                        && !(kept[k.body] && kept[l.body] && k.at != l.at)
                })
            });
            if fits {
                let joining = std::mem::take(&mut clusters[b]);
                for k in &joining {
                    cluster_of[*k] = a;
                }
                clusters[a].extend(joining);
            }
        }
        let mut number = vec![0; clusters.len()];
        let mut all = Vec::new();
        for (cluster, mut members) in clusters.into_iter().enumerate() {
            members.sort_unstable();
            let Some(first) = members.first() else {
                continue;
            };
            let fixed = members.iter().find(|k| kept[corners[**k].body]);
            number[cluster] = all.len();
            all.push(Node {
                at: corners[*fixed.unwrap_or(first)].at,
                bodies: members.iter().map(|k| corners[*k].body).collect(),
                gap: members
                    .iter()
                    .map(|k| gaps[corners[*k].body])
                    .fold(f64::INFINITY, f64::min),
                fixed: fixed.is_some(),
            });
        }
        let of_corner: Vec<usize> = cluster_of.into_iter().map(|c| number[c]).collect();
        let places = of_corner.iter().map(|n| all[*n].at);
        let exact = places.zip(&corners).all(|(at, corner)| at == corner.at);
        Nodes {
            all,
            starts,
            of_corner,
            exact,
        }
    }

    /// The node of a corner.
    pub(super) fn number(&self, body: usize, ring: usize, corner: usize) -> usize {
        self.of_corner[self.starts[body][ring] + corner]
    }
}

/// Pairs of corners of different bodies within their gaps of each other, the nearest first.
fn near(corners: &[Loose], gaps: &[f64]) -> Vec<(f64, usize, usize)> {
    let points = corners
        .iter()
        .enumerate()
        .map(|(i, c)| GeomWithData::new([c.at.x, c.at.y], i));
    let nearby = Nearby::of(points.collect());
    let mut pairs = Vec::new();
    for (i, corner) in corners.iter().enumerate() {
        let (x, y) = (corner.at.x, corner.at.y);
        let gap = gaps[corner.body];
        let around = AABB::from_corners([x - gap, y - gap], [x + gap, y + gap]);
        for other in nearby.near(around) {
            let j = other.data;
            let distance = (corners[j].at - corner.at).norm();
            let gap = gap.min(gaps[corners[j].body]);
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
