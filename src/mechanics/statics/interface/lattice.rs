//! Finds the interfaces of scenes whose bodies consist of lattice cells. Integer arithmetic makes the result exact.
//!
//! Two bodies share a cell edge if the outline of one body contains the edge in one direction, and the outline of the
//! other in the opposite direction. Consecutive edges between the same two bodies along one line are one interface.

use std::collections::BTreeMap;

use super::{ContactKind, Interface, bodies, ordered};
use crate::geometry::{Cell, Lattice, boundary, quarter_turn};
use crate::mechanics::scene::{BodyId, Scene};

type Node = (i64, i64);

/// For each directed edge of a lattice cell: the bodies whose outline contains this edge. When a block is added to a
/// structure, its contacts are looked up in this table.
#[derive(Clone, Debug, Default)]
pub(crate) struct LatticeEdges {
    owners: BTreeMap<(Node, Node), Vec<BodyId>>,
}

impl LatticeEdges {
    /// Adds the boundary edges of the body `id`, which consists of `cells`.
    pub(crate) fn add(&mut self, id: BodyId, cells: &[Cell]) {
        for step in boundary(cells) {
            self.owners.entry(step).or_default().push(id);
        }
    }

    /// Removes the boundary edges of the body `id`, which consists of `cells`.
    pub(crate) fn remove(&mut self, id: BodyId, cells: &[Cell]) {
        for step in boundary(cells) {
            if let Some(owners) = self.owners.get_mut(&step) {
                owners.retain(|owner| *owner != id);
            }
        }
    }

    /// Returns the interfaces in which the body `id`, made of `cells`, is the first of the two bodies. For the last
    /// block of a scene, these are all its interfaces.
    pub(crate) fn interfaces_of(&self, scene: &Scene, lattice: &Lattice, id: BodyId, cells: &[Cell]) -> Vec<Interface> {
        let own = boundary(cells).into_iter();
        self.interfaces(scene, lattice, own.map(|step| (step, id)))
    }

    /// Returns the interfaces along the given edges. Each edge comes with the body that owns it; only interfaces with
    /// this body as the first of the two bodies are returned.
    fn interfaces(
        &self,
        scene: &Scene,
        lattice: &Lattice,
        edges: impl Iterator<Item = ((Node, Node), BodyId)>,
    ) -> Vec<Interface> {
        // The cell edges that each pair of bodies shares in each direction, as a map from start node to end node. The
        // direction is that of the first body's edge.
        let mut shared: BTreeMap<([BodyId; 2], Node), BTreeMap<Node, Node>> = BTreeMap::new();
        for ((a, b), one) in edges {
            for other in self.owners.get(&(b, a)).into_iter().flatten() {
                if let Some(pair) = ordered(one, *other).filter(|pair| pair[0] == one && one != *other) {
                    let direction = (b.0 - a.0, b.1 - a.1);
                    shared.entry((pair, direction)).or_default().insert(a, b);
                }
            }
        }
        joined(scene, lattice, &shared)
    }
}

/// Finds all edge interfaces of a scene whose bodies consist of cells.
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

/// Joins consecutive cell edges between the same two bodies along one line into one interface. Returns all interfaces.
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

/// Creates the interface along the edges from the node `begin` to the node `end`.
///
/// The first body lies to the left of the direction from `begin` to `end`, so the normal into it is this direction
/// rotated anticlockwise by 90°.
fn interface(scene: &Scene, lattice: &Lattice, pair: [BodyId; 2], begin: Node, end: Node) -> Interface {
    let (from, to) = (lattice.node(begin), lattice.node(end));
    // The tangent (−n_y, n_x) of this normal points from `end` to `begin`.
    let normal = quarter_turn((to - from).normalize());
    let friction = scene.friction_at(pair, normal);
    Interface { bodies: pair, kind: ContactKind::Edge, ends: [to, from], normal, friction }
}
