//! Writes a load capacity as JSON: the set of forces that a block can carry.

use serde::Serialize;

use super::{Motion, Number, Pair, arrow, compact, place};
use crate::mechanics::analysis::{CapacityEdge, CapacityVertex, LoadCapacity as Found};
use crate::mechanics::scene::Scene;

/// Writes a load capacity as one line of JSON: the value of the key `capacity` in the result of a frame.
pub fn capacity_json(scene: &Scene, capacity: &Found) -> String {
    compact(&Capacity::new(scene, capacity))
}

#[derive(Serialize)]
pub(super) struct Capacity<'a> {
    block: &'a str,
    at: Vec<Pair>,
    #[serde(skip_serializing_if = "Option::is_none")]
    robot: Option<&'a str>,
    shape: &'static str,
    stands_without: bool,
    vertices: Vec<Pair>,
    rays: Vec<Pair>,
    edges: Vec<Edge<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    balances: Vec<Balance>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    mechanism: Vec<Motion<'a>>,
    gap: Number,
    cases: usize,
}

#[derive(Serialize)]
struct Edge<'a> {
    from: Option<usize>,
    to: Option<usize>,
    normal: Pair,
    limit: Number,
    mechanism: Vec<Motion<'a>>,
    case: usize,
}

/// The balance of forces that proves one vertex.
#[derive(Serialize)]
struct Balance {
    torque: Number,
    interfaces: Vec<InterfaceForces>,
}

#[derive(Serialize)]
struct InterfaceForces {
    interface: usize,
    normal_forces: Pair,
    friction_force: Number,
}

impl<'a> Capacity<'a> {
    pub(super) fn new(scene: &'a Scene, capacity: &Found) -> Capacity<'a> {
        let motions =
            |list: &[crate::mechanics::analysis::Motion]| list.iter().map(|m| Motion::new(scene, m)).collect();
        let edge = |edge: &CapacityEdge| Edge {
            from: edge.ends[0],
            to: edge.ends[1],
            normal: arrow(edge.normal),
            limit: Number(edge.limit),
            mechanism: motions(&edge.mechanism),
            case: edge.case,
        };
        let proved = capacity.vertices.iter().filter(|v| v.proof.is_some());
        Capacity {
            block: &scene.blocks[capacity.block.0].id,
            at: capacity.at.iter().map(|p| place(*p)).collect(),
            robot: capacity.robot.map(|r| scene.robots[r.0].id.as_str()),
            shape: capacity.shape().word(),
            stands_without: capacity.contains([0.0, 0.0]),
            vertices: capacity.vertices.iter().map(|v| arrow(v.force)).collect(),
            rays: capacity.rays.iter().map(|r| arrow(*r)).collect(),
            edges: capacity.edges.iter().map(edge).collect(),
            balances: proved.map(Balance::new).collect(),
            mechanism: motions(&capacity.mechanism),
            gap: Number(capacity.gap),
            cases: capacity.cases,
        }
    }
}

impl Balance {
    fn new(vertex: &CapacityVertex) -> Balance {
        let pressed = vertex.contacts.iter().map(|forces| InterfaceForces {
            interface: forces.interface,
            normal_forces: forces.normal.map(Number),
            friction_force: Number(forces.friction),
        });
        Balance { torque: Number(vertex.torque), interfaces: pressed.collect() }
    }
}
