//! [`Program`]: the balance of one group of blocks that influence each other, in pure numbers.
//!
//! For every block three rows (force x, force y, moment about its own centroid over L), for every force a column
//! ([`Column`]). Invariant: lengths are in parts of the median interface length L, forces such that the heaviest load is
//! [`Scale::HEAVIEST`], moments about the block's own centroid, so that neither place nor units reach the solver.
//! `column` holds the only index arithmetic, `scale` the only units, `pose` the forms handed to the solver.

mod column;
mod group;
mod pose;
mod scale;

pub use column::{Column, Force, columns, sticking_columns};
pub use group::{Group, groups};
pub(crate) use pose::product;
pub use pose::{
    Cap, Conic, Correction, elastic, force_form, kinematic, least_left, least_squares, most_of,
    shortest, smallest, source,
};
pub use scale::Scale;

use crate::effect::Plan;
use crate::geometry::{Point, Vector, cross};
use crate::interface::{ContactKind, Interface};
use crate::scene::{BodyId, Frame, Scene};

/// The balance of one group of blocks, in pure numbers.
#[derive(Clone, Debug)]
pub struct Program {
    /// How many blocks; block k owns rows 3k, 3k+1, 3k+2.
    pub blocks: usize,
    /// What contacts and robots must give each block: minus its loads, as (x, y, moment).
    pub need: Vec<f64>,
    /// The contacts.
    pub contacts: Vec<Contact>,
    /// The grips.
    pub grips: Vec<GripTerm>,
    /// The units.
    pub scale: Scale,
}

/// One contact as the program sees it.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Its number among the frame's interfaces.
    pub interface: usize,
    /// The pushed block and the arms of the application points about its centroid.
    pub on: (usize, [Vector; 2]),
    /// The partner, unless it is the ground.
    pub from: Option<(usize, [Vector; 2])>,
    /// Unit normal into `on`.
    pub normal: Vector,
    /// Friction coefficient, 0 where friction is not simulated.
    pub friction: f64,
    /// 2 application points, 1 for a corner contact.
    pub points: usize,
}

/// One grip as the program sees it.
#[derive(Clone, Debug)]
pub struct GripTerm {
    /// Its number among the frame's holds.
    pub hold: usize,
    /// The held block.
    pub block: usize,
    /// Arm of the grip point about the block's centroid.
    pub arm: Vector,
    /// Limits of force x, force y, torque/L; infinite without limit, 0 where the component is not simulated.
    pub limits: [f64; 3],
}

impl Program {
    /// A limit beyond so many times the sum of all loads is lavish.
    const LAVISH: f64 = 10.0;

    /// The program without the limits that can hardly matter, if there are such.
    ///
    /// A limit costs three rows and an unknown, and one of 10⁹ loads enters the aim as a number that drowns all others.
    /// An answer that breaks a limit left out here fails its proof and is sought again with all limits.
    pub fn without_lavish_limits(&self) -> Option<Program> {
        let sum: f64 = self.need.iter().map(|v| v.abs()).sum();
        let lavish = |limit: f64| limit.is_finite() && limit > Self::LAVISH * sum;
        let any = self.grips.iter().flat_map(|g| g.limits).any(lavish);
        any.then(|| {
            let mut program = self.clone();
            for limit in program
                .grips
                .iter_mut()
                .flat_map(|g| &mut g.limits)
                .filter(|l| lavish(**l))
            {
                *limit = f64::INFINITY;
            }
            program
        })
    }

    /// Whether some amounts keep every grip within this program's limits, up to rounding.
    pub fn allows(&self, grips: &[[f64; 3]]) -> bool {
        self.grips.iter().zip(grips).all(|(term, given)| {
            term.limits
                .iter()
                .zip(given)
                .all(|(limit, amount)| amount.abs() <= limit * (1.0 + 1e-9) + 1e-9)
        })
    }
}

/// Load on a block about its centroid, (F_x, F_y, M) in newtons and N·m: its weight and what the scene lists for it.
pub fn load_on(scene: &Scene, plan: &Plan, block: crate::scene::BlockId) -> (Vector, f64) {
    let body = &scene.blocks[block.0];
    let mut force = scene.down() * body.weight;
    let mut moment = 0.0;
    if plan.loads {
        for load in scene.loads.iter().filter(|l| l.block == block) {
            force += load.force;
            moment += cross(load.at - body.centroid, load.force) + load.torque;
        }
    }
    (force, moment)
}

/// Poses the balance of one group of blocks of a frame.
///
/// `interfaces` are those of the whole frame; `scale` is the frame's.
pub fn assemble(
    scene: &Scene,
    frame: &Frame,
    interfaces: &[&Interface],
    plan: &Plan,
    group: &Group,
    scale: Scale,
) -> Program {
    let mut row = vec![usize::MAX; scene.blocks.len()];
    let mut need = Vec::with_capacity(3 * group.blocks.len());
    for (k, block) in group.blocks.iter().enumerate() {
        row[block.0] = k;
        let (force, moment) = load_on(scene, plan, *block);
        need.extend([
            -force.x / scale.force,
            -force.y / scale.force,
            -moment / scale.moment(),
        ]);
    }
    let arms = |body: BodyId, points: [Point; 2]| match body {
        BodyId::Ground(_) => None,
        BodyId::Block(id) => Some((
            row[id.0],
            points.map(|p| (p - scene.blocks[id.0].centroid) / scale.length),
        )),
    };
    let contacts = group
        .interfaces
        .iter()
        .filter_map(|number| {
            let interface = interfaces[*number];
            let points = interface.application_points(plan.kernel);
            Some(Contact {
                interface: *number,
                on: arms(interface.bodies[0], points)?,
                from: arms(interface.bodies[1], points),
                normal: interface.normal,
                friction: if plan.friction {
                    interface.friction
                } else {
                    0.0
                },
                points: if interface.kind == ContactKind::Edge {
                    2
                } else {
                    1
                },
            })
        })
        .collect();
    let grips = group
        .holds
        .iter()
        .map(|number| {
            let hold = frame.holds[*number];
            let limits = scene.robots[hold.robot.0].limits;
            GripTerm {
                hold: *number,
                block: row[hold.block.0],
                arm: (hold.at - scene.blocks[hold.block.0].centroid) / scale.length,
                limits: [
                    limits.fx / scale.force,
                    limits.fy / scale.force,
                    limits.torque / scale.moment(),
                ],
            }
        })
        .collect();
    Program {
        blocks: group.blocks.len(),
        need,
        contacts,
        grips,
        scale,
    }
}
