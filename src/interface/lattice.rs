//! Interfaces of lattice scenes, decided in whole numbers.
//!
//! Two cells share an edge when one has it forwards and the other backwards; runs of such edges between the same two
//! bodies along one line are one interface.

use std::collections::BTreeMap;

use super::{ContactKind, Interface, bodies, ordered};
use crate::geometry::{Lattice, boundary, quarter_turn};
use crate::scene::{BodyId, Scene};

type Node = (i64, i64);

/// All edge interfaces of a scene made of cells.
pub(super) fn find(scene: &Scene, lattice: &Lattice) -> Vec<Interface> {
    let mut owners: BTreeMap<(Node, Node), Vec<BodyId>> = BTreeMap::new();
    for id in bodies(scene) {
        if let Some(cells) = &scene.body(id).cells {
            for step in boundary(cells) {
                owners.entry(step).or_default().push(id);
            }
        }
    }
    // Unit edges of the first body, by pair and direction, as a map from begin to end.
    let mut shared: BTreeMap<([BodyId; 2], Node), BTreeMap<Node, Node>> = BTreeMap::new();
    for ((a, b), first) in &owners {
        for other in owners.get(&(*b, *a)).into_iter().flatten() {
            for one in first {
                if let Some(pair) =
                    ordered(*one, *other).filter(|pair| pair[0] == *one && one != other)
                {
                    let direction = (b.0 - a.0, b.1 - a.1);
                    shared.entry((pair, direction)).or_default().insert(*a, *b);
                }
            }
        }
    }
    let mut found = Vec::new();
    for ((pair, direction), edges) in &shared {
        for begin in edges.keys() {
            if edges.contains_key(&(begin.0 - direction.0, begin.1 - direction.1)) {
                continue;
            }
            let mut end = *begin;
            while let Some(next) = edges.get(&end) {
                end = *next;
            }
            found.push(interface(scene, lattice, *pair, *begin, end));
        }
    }
    found
}

/// The first body lies to the left of begin → end, so that its inward normal is that direction's quarter turn.
fn interface(
    scene: &Scene,
    lattice: &Lattice,
    pair: [BodyId; 2],
    begin: Node,
    end: Node,
) -> Interface {
    let (from, to) = (lattice.node(begin), lattice.node(end));
    Interface {
        bodies: pair,
        kind: ContactKind::Edge,
        // (−n_y, n_x) of the left normal is the edge turned by a half: it runs from the end back to the begin.
        ends: [to, from],
        normal: quarter_turn((to - from).normalize()),
        friction: scene.friction_between(pair[0], pair[1]),
    }
}
