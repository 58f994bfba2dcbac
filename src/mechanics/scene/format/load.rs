//! The types of the scene file for loads, load cases, movements of supports and vehicles.

#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::Serialize;

use super::declare::{entry, word};
use super::{Map, Pair, vector};
use crate::geometry::{Vector, quarter_turn};
use crate::read::{Expected, Node, NodeKind, Read, Reader, Trail};

entry! {
    /// A load in addition to the weights: a force or a torque on a block, or a pressure on the sides of blocks.
    pub struct LoadEntry {
        /// Name of the load, used by no other load. Load cases refer to it. Default: the number of the load in the
        /// list, from 1.
        id: Option<String>,
        /// Name of the loaded block. A pressure on the edges `between` two points needs no block.
        block: bare Option<String>,
        /// Force [x, y] in the force unit of the scene. Default [0, 0].
        force: Option<Pair> [extend("default" = [0.0, 0.0])] as vector,
        /// Point [x, y], in the length unit of the scene, at which the force acts. Default: the block's centroid.
        at: Option<Pair>,
        /// Torque in the force unit times the length unit of the scene, anticlockwise positive. Default 0.
        torque: Option<f64> [extend("default" = 0.0)],
        /// Pressure on the sides of blocks, instead of a force and a torque.
        pressure: Option<PressureEntry>,
        /// Side of the block on which the pressure acts: all its edges whose outward normal is at most 45 degrees from
        /// this direction.
        side: Option<BlockSide>,
        /// Two points [x, y], in the length unit of the scene, on the free outline of the blocks: the pressure acts on
        /// all edges between them that touch no other body.
        between: Vec<Pair> [length(min = 2, max = 2)],
        /// Whether the load keeps its amount when the load factor changes. With "vertical", only the part of its force along
        /// gravity does; with "horizontal", only the part across gravity. Default false.
        fixed: Option<FixedLoad> [extend("default" = false)],
    }
}

/// Which part of a load is fixed: the load factor does not multiply it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(untagged)]
pub enum FixedLoad {
    /// All of the load is fixed, or nothing of it.
    All(bool),
    /// Only the part of the force in one direction is fixed.
    Part(FixedPart),
}

word! {
    /// The direction of the fixed part of a force. The load factor multiplies the rest of the force, and the torque.
    #[derive(serde::Deserialize)]
    pub enum FixedPart {
        /// Along gravity.
        Vertical = "vertical",
        /// At right angles to gravity.
        Horizontal = "horizontal",
    }
}

impl FixedPart {
    /// Returns the unit vector of this direction. Without gravity, down is (0, −1).
    pub(crate) fn direction(self, gravity: Vector) -> Vector {
        let down = if gravity.norm() > 0.0 { gravity.normalize() } else { -Vector::y() };
        if self == FixedPart::Vertical { down } else { quarter_turn(down) }
    }
}

impl From<bool> for FixedLoad {
    fn from(all: bool) -> FixedLoad {
        FixedLoad::All(all)
    }
}

impl Read for FixedLoad {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<FixedLoad> {
        match &node.kind {
            NodeKind::Flag(all) => Some(FixedLoad::All(*all)),
            NodeKind::Text(_) => FixedPart::read(r, node, at).map(FixedLoad::Part),
            _ => {
                r.wrong(node, at, Expected::Other("true, false, \"vertical\" or \"horizontal\""));
                None
            }
        }
    }
}

impl LoadEntry {
    /// Creates a load on the block with this id. Its force and torque are zero until they are set.
    pub fn on(block: impl Into<String>) -> LoadEntry {
        LoadEntry { block: Some(block.into()), ..LoadEntry::default() }
    }

    /// Creates a pressure on all edges of blocks that touch no other body, between two points of the free outline,
    /// [x, y] in the length unit of the scene.
    pub fn between(from: Pair, to: Pair, pressure: impl Into<PressureEntry>) -> LoadEntry {
        LoadEntry { between: vec![from, to], pressure: Some(pressure.into()), ..LoadEntry::default() }
    }
}

word! {
    /// A side of a block.
    pub enum BlockSide {
        /// The edges whose outward normal points to the left.
        Left = "left",
        /// The edges whose outward normal points to the right.
        Right = "right",
        /// The edges whose outward normal points up.
        Top = "top",
        /// The edges whose outward normal points down.
        Bottom = "bottom",
    }
}

/// A pressure: one number, the two numbers at the ends between which it varies linearly, or the pressure of a fluid or
/// of earth, which grows with the depth. In the force unit of the scene per square metre; positive if it presses on the
/// block.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(untagged)]
#[non_exhaustive]
pub enum PressureEntry {
    /// The same pressure everywhere.
    Uniform(f64),
    /// The pressure at the first and at the last end, and linear between them. The first end of a side is its lower or
    /// left end; of the edges between two points it is the first point.
    Linear(Pair),
    /// A pressure that grows with the depth.
    ByDepth(DepthEntry),
}

impl Default for PressureEntry {
    fn default() -> PressureEntry {
        PressureEntry::Uniform(0.0)
    }
}

impl From<f64> for PressureEntry {
    fn from(pressure: f64) -> PressureEntry {
        PressureEntry::Uniform(pressure)
    }
}

impl From<DepthEntry> for PressureEntry {
    fn from(depth: DepthEntry) -> PressureEntry {
        PressureEntry::ByDepth(depth)
    }
}

impl Read for PressureEntry {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<PressureEntry> {
        match &node.kind {
            NodeKind::Number(_) => r.number(node, at).map(PressureEntry::Uniform),
            NodeKind::List(_) => Pair::read(r, node, at).map(PressureEntry::Linear),
            NodeKind::Object(_) => DepthEntry::read(r, node, at).map(PressureEntry::ByDepth),
            _ => {
                r.wrong(node, at, Expected::Other("a number, a list of two numbers, or an object"));
                None
            }
        }
    }
}

entry! {
    /// The pressure of water or earth: coefficient × unit weight × depth. It acts below the surface.
    pub struct DepthEntry {
        /// Height y of the surface in the length unit of the scene. The depth is measured downward from it.
        surface: required f64,
        /// Unit weight of the water or earth, at least 0, in the force unit of the scene per cubic metre. Water has
        /// 9810 N/m³. Also a text with its own unit, such as `"18 kN/m3"` or `"62.4 lbf/ft3"`.
        unit_weight: required f64 [range(min = 0.0), extend("type" = ["number", "string"])],
        /// The coefficient of earth pressure, at least 0; 1 for water. Default 1.
        coefficient: Option<f64> [range(min = 0.0), extend("default" = 1.0)],
        /// Angle of friction between the earth and the blocks, −90 to 90 degrees: the pressure acts at this angle from
        /// the inward normal of an edge. A positive angle drags the blocks down; water has 0 degrees. Default 0.
        friction_angle: Option<f64> [range(min = -90.0, max = 90.0), extend("default" = 0.0)],
    }
}

impl DepthEntry {
    /// Creates the pressure of water below the height `surface`, in the length unit of the scene. `unit_weight` is in
    /// the force unit of the scene per cubic metre.
    pub fn below(surface: f64, unit_weight: f64) -> DepthEntry {
        DepthEntry { surface, unit_weight, ..DepthEntry::default() }
    }
}

entry! {
    /// A load case: which loads act, and by which factors loads and weights are multiplied.
    pub struct CaseEntry {
        /// Name of the case, used by no other case.
        id: required String,
        /// Factor on the weights of all blocks, at least 0. Default 1.
        weights: Option<f64> [range(min = 0.0), extend("default" = 1.0)],
        /// Factor on each load that acts in this case, by the name of the load. Default: all loads act with factor 1.
        loads: bare Option<Map<f64>>,
    }
}

impl CaseEntry {
    /// Creates a load case in which all loads and weights act as listed, until it is changed.
    pub fn new(id: impl Into<String>) -> CaseEntry {
        CaseEntry { id: id.into(), ..CaseEntry::default() }
    }

    /// Lets a load act with this factor. Loads without a factor then do not act.
    pub fn load(mut self, id: impl Into<String>, factor: f64) -> CaseEntry {
        self.loads.get_or_insert_default().0.push((id.into(), factor));
        self
    }
}

entry! {
    /// A small movement of a part of the ground: a rotation about a point, and a translation.
    pub struct MovementEntry {
        /// Name of the part of the ground that moves.
        ground: required String,
        /// Translation [x, y] in the length unit of the scene. Default [0, 0].
        translation: Option<Pair> [extend("default" = [0.0, 0.0])] as vector,
        /// Rotation about the point in the key `about`, in degrees anticlockwise. Default 0.
        rotation: Option<f64> [extend("default" = 0.0)],
        /// Point [x, y], in the length unit of the scene, about which the part turns. Default: the centroid of the part.
        about: Option<Pair>,
    }
}

impl MovementEntry {
    /// Creates a movement of the part of the ground with this id. It is zero until a translation or a rotation is set.
    pub fn of(ground: impl Into<String>) -> MovementEntry {
        MovementEntry { ground: ground.into(), ..MovementEntry::default() }
    }
}

entry! {
    /// A vehicle that travels over the structure. Its axles are loads on the blocks below them, along gravity.
    pub struct VehicleEntry {
        /// The axles, the first in front.
        axles: required Vec<AxleEntry> [length(min = 1)],
        /// Names of the blocks that the vehicle travels over. An axle stands only where no other block lies above.
        /// Default: all placed blocks.
        over: Vec<String>,
        /// Distance between further positions that are analysed for a smoother influence line, in the length unit of the
        /// scene, at least 0; more than 1 000 in one direction are left out. Every position with an axle at an end of the
        /// top of a block is analysed: one of these is the most dangerous position.
        step: Option<f64> [range(min = 0.0), extend("default" = 0.0)],
        /// Whether the vehicle also travels to the left. Default true.
        both_ways: Option<bool> [extend("default" = true)],
    }
}

entry! {
    /// An axle of a vehicle.
    pub struct AxleEntry {
        /// Weight on the axle in the force unit of the scene, at least 0.
        weight: required f64 [range(min = 0.0)],
        /// Distance behind the first axle in the length unit of the scene. Default 0.
        offset: Option<f64> [extend("default" = 0.0)],
    }
}
