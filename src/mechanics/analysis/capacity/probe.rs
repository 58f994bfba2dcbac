//! [`Probe`]: a component with an unlimited force at one point of a block. A linear program finds which forces can act
//! at this point.

use std::cell::Cell;

use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::decide::{
    SPEED_NOISE, decided_forces, proved_exact_motion, proved_forces, proved_motion,
};
use crate::mechanics::analysis::margin::{LimitChange, Setting};
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::{Forces, Motion, Proof, check_forces, net_power};
use crate::mechanics::scene::{Limits, RobotId};
use crate::mechanics::solve::{Amounts, ForcePolygon, Limit, force_polygon, support};
use crate::mechanics::statics::assembly::{Assembly, AssemblyGrip, load_about};

/// A motion is proved under a force that lies this far beyond the limit, relative to the size of the force. The power
/// along the motion is linear in the force, so the proof holds up to the line on which the power is 0.
const SHARE_BEYOND_LIMIT: f64 = 4e-3;

/// How far inside the limit forces are tried, relative to the size of the force, if the farthest force has no proof.
const SHARES_INSIDE_LIMIT: [f64; 4] = [0.0, 1e-9, 1e-8, MAX_SHARE_INSIDE];

/// The tolerance of the refinement, as a fraction of the size of the set.
pub(super) const RELATIVE_TOL: f64 = 2e-7;

/// The last entry of `SHARES_INSIDE_LIMIT`, which is half of the relative tolerance of the refinement. The farthest force
/// and the half-plane of its motion also agree if the force lies within this distance of the boundary; otherwise the
/// program is solved again with full conditioning.
const MAX_SHARE_INSIDE: f64 = 0.5 * RELATIVE_TOL;

/// A search for the farthest forces gives up after this many programs and decisions without a proof. Sets that are found
/// need up to a few tens; a wall of 410 bricks went on for 154 s.
const MAX_FAILED_CHECKS: usize = 100;

/// A component, and the point of a body at which the additional force acts.
pub(super) struct Probe {
    given: Assembly,
    /// The component with one more grip, without limits, at the point. It is the last grip of the list.
    pub held: Assembly,
    program: Program,
    body: usize,
    at: Point,
    /// True if the force acts at two points. The probe then also exerts a torque without limit.
    has_torque: bool,
    /// True if forces and motions are proved. They are not proved for the recession cone: a proof is relative to the
    /// forces on each body, and without loads most bodies have no force. The loaded component proves the edges and a
    /// far force instead.
    proves: bool,
    /// The number of programs and decisions so far that gave no proof of a farthest force or of its half-plane.
    failed_checks: Cell<usize>,
}

/// A force that is carried, with its proof.
#[derive(Clone, Debug)]
pub(super) struct CarriedForce {
    pub force: Vector,
    pub torque: f64,
    pub forces: Forces,
    pub proof: Proof,
}

/// A half-plane that contains all carried forces F: normal · F ≤ limit.
#[derive(Clone, Debug)]
pub(super) struct HalfPlane {
    pub normal: Vector,
    pub limit: f64,
    pub motion: Vec<Motion>,
    pub proof: Proof,
}

impl HalfPlane {
    /// Returns the distance, N, from a force outward to the boundary; negative if the force lies outside the
    /// half-plane.
    pub fn beyond(&self, force: Vector) -> f64 {
        self.limit - self.normal.dot(&force)
    }
}

/// The farthest carried force in a direction.
#[derive(Clone, Debug)]
pub(super) enum Farthest {
    /// The farthest force is finite.
    At {
        /// The farthest force; `None` if it has no proof.
        carried: Option<CarriedForce>,
        /// The motion that excludes farther forces; `None` if it has no proof.
        half_plane: Option<HalfPlane>,
    },
    /// There is no farthest force: forces of any size are carried.
    Unbounded,
    /// Either no force is carried, or the program has no result.
    None,
}

impl Probe {
    /// Creates the probe of a force at one point of a body, or of a contact with free forces at two points. Two free
    /// forces are equivalent to a free force and a free torque at the first point.
    pub fn new(given: &Assembly, body: usize, points: &[Point]) -> Probe {
        let has_torque = points.len() > 1;
        let at = points[0];
        let torque = if has_torque { f64::INFINITY } else { 0.0 };
        let held = with_grip(given, body, at, [f64::INFINITY, f64::INFINITY, torque]);
        let program = Program::new(&held, Scale::from_assembly(given));
        Probe { given: given.clone(), held, program, body, at, has_torque, proves: true, failed_checks: Cell::new(0) }
    }

    /// Returns the same probe without loads, for the recession cone. Any multiple of a force that the block carries
    /// without loads may be added to any force that it carries with loads. Finite limits of robots are set to 0;
    /// unlimited robots stay.
    pub fn without_loads(&self) -> Probe {
        let unloaded = Setting { limits: LimitChange::FiniteToZero, ..Setting::UNLOADED };
        let given = unloaded.apply(&self.given);
        let points = [self.at; 2];
        let count = if self.has_torque { 2 } else { 1 };
        Probe { proves: false, ..Probe::new(&given, self.body, &points[..count]) }
    }

    /// Returns the load of the most heavily loaded body of the component, N; 1 if there are no loads.
    pub fn heaviest(&self) -> f64 {
        match self.given.heaviest_load() {
            0.0 => 1.0,
            heaviest => heaviest,
        }
    }

    /// Converts the index of a contact in the component to its index in the frame.
    pub fn interface(&self, contact: usize) -> usize {
        self.given.contacts[contact].interface
    }

    /// Returns the number of checks without a proof, if there were so many that the search gives up.
    pub fn given_up_after(&self) -> Option<usize> {
        let failed = self.failed_checks.get();
        (failed >= MAX_FAILED_CHECKS).then_some(failed)
    }

    /// Counts checks without a proof.
    fn count_failed(&self, checks: usize) {
        self.failed_checks.set(self.failed_checks.get() + checks);
    }

    /// Returns the carried force that is farthest in a unit direction (the support point of the set). `reach` is the
    /// largest magnitude of each component of the force, N; `None` if there is no limit.
    pub fn farthest(&self, direction: Vector, reach: Option<f64>) -> Farthest {
        if self.given_up_after().is_some() {
            return Farthest::None;
        }
        let mut program = self.program.clone();
        if let Some(most) = reach {
            let grip = self.given.grips.len();
            let most = most / program.scale.force;
            program.grips[grip].limits[0] = most;
            program.grips[grip].limits[1] = most;
        }
        let first = self.farthest_in(&program, direction, false);
        // If the force or the motion has no proof, or if they do not agree, solve the program again with full
        // conditioning: equilibration and iterative refinement. If its force has no proof either, try forces slightly
        // inside the limit.
        match first {
            Farthest::At { carried, half_plane } if self.proves && !self.agree(&carried, &half_plane) => {
                self.count_failed(1);
                let second = match self.farthest_in(&program, direction, true) {
                    Farthest::At { carried: again, half_plane: closer } => {
                        self.best(direction, [carried, again], [half_plane, closer])
                    }
                    _ => Farthest::At { carried, half_plane },
                };
                if !matches!(&second, Farthest::At { carried, half_plane } if self.agree(carried, half_plane)) {
                    self.count_failed(1);
                }
                second
            }
            other => other,
        }
    }

    /// Returns the polygon of all carried forces, as the simplex method finds it. `None` if it was not found.
    pub fn polygon(&self) -> Option<ForcePolygon> {
        force_polygon(&self.program, self.given.grips.len())
    }

    /// True if a force and a half-plane are both proved, and the force lies on the boundary of the half-plane.
    fn agree(&self, carried: &Option<CarriedForce>, half_plane: &Option<HalfPlane>) -> bool {
        let (Some(carried), Some(half_plane)) = (carried, half_plane) else {
            return false;
        };
        let size = carried.force.norm().max(self.heaviest());
        half_plane.beyond(carried.force) <= MAX_SHARE_INSIDE * size
    }

    /// Combines the results of two programs for the same direction: the farther force, and the half-plane whose
    /// boundary is nearer to this force. If no force was proved, uses the half-plane with the smaller limit.
    fn best(
        &self,
        direction: Vector,
        carried: [Option<CarriedForce>; 2],
        half_planes: [Option<HalfPlane>; 2],
    ) -> Farthest {
        let far = |carried: &CarriedForce| direction.dot(&carried.force);
        let carried = carried.into_iter().flatten();
        let carried = carried.max_by(|a, b| far(a).total_cmp(&far(b)));
        let beyond = |half_plane: &HalfPlane| match &carried {
            Some(carried) => half_plane.beyond(carried.force).abs(),
            None => half_plane.limit,
        };
        let half_planes = half_planes.into_iter().flatten();
        let half_plane = half_planes.min_by(|a, b| beyond(a).total_cmp(&beyond(b)));
        Farthest::At { carried, half_plane }
    }

    fn farthest_in(&self, program: &Program, direction: Vector, is_retry: bool) -> Farthest {
        let grip = self.given.grips.len();
        let found = support(program, grip, direction, is_retry);
        match (found.limit, found.forces, found.motion) {
            (Limit::At(_), Some(forces), Some(motion)) => {
                let near = forces.grip[grip];
                let near = Vector::new(near[0], near[1]) * self.program.scale.force;
                if self.proves {
                    Farthest::At {
                        carried: match self.carried(&forces) {
                            None if is_retry => self.carried_near(near, direction),
                            carried => carried,
                        },
                        half_plane: self.half_plane(near, direction, &motion),
                    }
                } else {
                    Farthest::At { carried: Some(self.unproved(near)), half_plane: None }
                }
            }
            (Limit::Unbounded, ..) => Farthest::Unbounded,
            _ => Farthest::None,
        }
    }

    fn unproved(&self, force: Vector) -> CarriedForce {
        let forces = Forces::zero(&self.given);
        CarriedForce { force, torque: 0.0, proof: check_forces(&self.given, &forces), forces }
    }

    /// Proves the force that the additional grip exerts in a solution of the program. `None` if this solution has no
    /// proof.
    pub fn carried(&self, amounts: &Amounts) -> Option<CarriedForce> {
        let (mut forces, proof) = proved_forces(&self.held, &self.program, amounts)?;
        let own = forces.grips.pop()?;
        Some(CarriedForce { force: own.force, torque: own.torque, forces, proof })
    }

    /// Proves a carried force near the farthest force. Decides the component under the farthest force, then under
    /// forces slightly farther inside, opposite to `direction`. If all fail, decides the component with a free force,
    /// and accepts the resulting force if it is about as far in `direction` as the farthest force. Only this last step
    /// is used if the force acts at two points.
    fn carried_near(&self, farthest: Vector, direction: Vector) -> Option<CarriedForce> {
        let size = farthest.norm().max(self.heaviest());
        let under = |inside: f64| {
            let force = farthest - direction * (inside * size);
            let (forces, proof) = self.decided(&self.with_force(force))?;
            Some(CarriedForce { force, torque: 0.0, forces, proof })
        };
        let near = if self.has_torque { None } else { SHARES_INSIDE_LIMIT.into_iter().find_map(under) };
        near.or_else(|| {
            let (mut forces, proof) = self.decided(&self.held)?;
            let own = forces.grips.pop()?;
            let is_as_far = direction.dot(&(farthest - own.force)) <= MAX_SHARE_INSIDE * size;
            is_as_far.then_some(CarriedForce { force: own.force, torque: own.torque, forces, proof })
        })
    }

    /// Decides a component; see [`decided_forces`].
    fn decided(&self, component: &Assembly) -> Option<(Forces, Proof)> {
        let found = decided_forces(component);
        self.count_failed(usize::from(found.is_none()));
        found
    }

    /// Returns the half-plane normal · F ≤ limit that a motion proves: the velocities `y` of the program exclude every
    /// force outside the half-plane. `near` is a force near the limit, and `direction` points outward. `None` if the
    /// motion has no proof under a force just beyond `near`, or if the point of the force hardly moves.
    pub fn half_plane(&self, near: Vector, direction: Vector, y: &[f64]) -> Option<HalfPlane> {
        let size = near.norm().max(self.heaviest());
        let beyond = self.with_force(near + direction * (SHARE_BEYOND_LIMIT * size));
        let program = Program::new(&beyond, self.program.scale);
        // Motions from the simplex method have only rounding errors. Motions from an interior-point method need a
        // correction.
        let (motion, proof) =
            proved_exact_motion(&beyond, &program, y).or_else(|| proved_motion(&beyond, &program, y))?;
        let own = &motion[self.body];
        let velocity = own.about(self.given.bodies[self.body].centroid, self.at);
        let speed = velocity.norm();
        (speed > SPEED_NOISE).then(|| HalfPlane {
            normal: velocity / speed,
            limit: -net_power(&self.given, &motion) / speed,
            motion,
            proof,
        })
    }

    /// Returns the component with an additional force at the point, N. If the probe is a contact, an unlimited torque
    /// also acts on the body, so that the body cannot rotate.
    fn with_force(&self, force: Vector) -> Assembly {
        let mut assembly = if self.has_torque {
            with_grip(&self.given, self.body, self.at, [0.0, 0.0, f64::INFINITY])
        } else {
            self.given.clone()
        };
        let body = &mut assembly.bodies[self.body];
        let more = load_about(body.centroid, self.at, force, 0.0);
        body.fixed = body.fixed.plus(more);
        body.load = body.load.plus(more);
        assembly
    }
}

/// Returns a copy of the assembly in which a robot with the given limits [Fx, Fy, torque] also holds a body. Its grip
/// is the last of the list.
pub(in crate::mechanics) fn with_grip(given: &Assembly, body: usize, at: Point, limits: [f64; 3]) -> Assembly {
    let mut held = given.clone();
    let [fx, fy, torque] = limits;
    held.grips.push(AssemblyGrip {
        hold: usize::MAX,
        robot: RobotId(usize::MAX),
        body,
        at,
        limits: Limits { fx, fy, torque },
    });
    held
}
