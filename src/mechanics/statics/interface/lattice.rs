//! Interfaces of lattice scenes, decided in whole numbers.
//!
//! Two cells share an edge when one has it forwards and the other backwards; runs of such edges between the same two
//! bodies along one line are one interface.

use std::collections::BTreeMap;

use super::{ContactKind, Interface, bodies, ordered};
use crate::geometry::{Cell, Lattice, boundary, quarter_turn};
use crate::scene::{BodyId, Scene};

type Node = (i64, i64);

/// Who has which unit edges of a lattice: what a growing structure touches is looked up here, and not searched anew.
#[derive(Clone, Debug, Default)]
pub(crate) struct LatticeEdges {
    owners: BTreeMap<(Node, Node), Vec<BodyId>>,
}

impl LatticeEdges {
    /// Enters a body of cells.
    pub(crate) fn add(&mut self, id: BodyId, cells: &[Cell]) {
        for step in boundary(cells) {
            self.owners.entry(step).or_default().push(id);
        }
    }

    /// Takes a body out.
    pub(crate) fn remove(&mut self, id: BodyId, cells: &[Cell]) {
        for step in boundary(cells) {
            if let Some(owners) = self.owners.get_mut(&step) {
                owners.retain(|owner| *owner != id);
            }
        }
    }

    /// The interfaces in which a body is the first of the two, as the last block of a scene is in all of its own.
    pub(crate) fn interfaces_of(
        &self,
        scene: &Scene,
        lattice: &Lattice,
        id: BodyId,
        cells: &[Cell],
    ) -> Vec<Interface> {
        let own = boundary(cells).into_iter();
        self.interfaces(scene, lattice, own.map(|step| (step, id)))
    }

    /// The interfaces of some edges, each given with its owner.
    fn interfaces(
        &self,
        scene: &Scene,
        lattice: &Lattice,
        edges: impl Iterator<Item = ((Node, Node), BodyId)>,
    ) -> Vec<Interface> {
        // Unit edges of the first body, by pair and direction, as a map from begin to end.
        let mut shared: BTreeMap<([BodyId; 2], Node), BTreeMap<Node, Node>> = BTreeMap::new();
        for ((a, b), one) in edges {
            for other in self.owners.get(&(b, a)).into_iter().flatten() {
                if let Some(pair) =
                    ordered(one, *other).filter(|pair| pair[0] == one && one != *other)
                {
                    let direction = (b.0 - a.0, b.1 - a.1);
                    shared.entry((pair, direction)).or_default().insert(a, b);
                }
            }
        }
        joined(scene, lattice, &shared)
    }
}

/// All edge interfaces of a scene made of cells.
pub(super) fn find(scene: &Scene, lattice: &Lattice) -> Vec<Interface> {
    let mut edges = LatticeEdges::default();
    for id in bodies(scene) {
        if let Some(cells) = &scene.body(id).cells {
            edges.add(id, cells);
        }
    }
    let all = edges.owners.iter();
    let all = all.flat_map(|(step, owners)| owners.iter().map(move |id| (*step, *id)));
    edges.interfaces(scene, lattice, all)
}

/// Runs of unit edges between the same two bodies along one line, each as one interface.
fn joined(
    scene: &Scene,
    lattice: &Lattice,
    shared: &BTreeMap<([BodyId; 2], Node), BTreeMap<Node, Node>>,
) -> Vec<Interface> {
    let mut found = Vec::new();
    for ((pair, direction), edges) in shared {
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
