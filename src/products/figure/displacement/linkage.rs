//! [`Linkage`]: moves rigid bodies that are joined by hinges and sliding joints, and keeps these joints closed along
//! the path.
//!
//! Every body first moves along its own velocity. This alone would open the joints, by gaps proportional to the square
//! of the angle. A few steps of Newton's method, each with the least-norm correction, then close all joints.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::Displacement;
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::Motion;
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::products::figure::fall::{Fall, Joint};

/// Joints are not closed if there are more bodies than this, because closing them would take longer than the drawing.
const MAX_BODIES: usize = 40;
/// Largest number of steps of Newton's method.
const MAX_STEPS: usize = 12;
/// Largest gap of a joint that counts as closed, as a fraction of the length scale of the frame.
const CLOSURE_TOL: f64 = 1e-7;
/// Largest accepted correction of the positions, as a fraction of the displacements. With a larger correction, the joints
/// cannot be closed sensibly (some linkages are locked, so only the position at rest would close them), and the bodies
/// keep the positions without correction.
const MAX_CORRECTION: f64 = 0.5;
/// Number that is added to each diagonal entry of the matrix, relative to the largest of these entries. Redundant
/// equations would make the matrix singular.
const REGULARIZATION: f64 = 1e-10;
/// The step of the difference quotients of Newton's method, as a fraction of the length scale of the frame.
const STEP: f64 = 1e-6;

/// A condition of a closed joint.
#[derive(Clone, Copy, Debug)]
enum Condition {
    /// The two bodies keep this point in common: two equations.
    Hinge(Point),
    /// A point of the first body stays on a line of the second body. At the beginning, the line passes through this
    /// point, and the vector is the normal of the line.
    OnLine(Point, Vector),
    /// The two bodies turn by the same angle.
    Parallel,
}

/// A condition between two bodies. Each body is an index into the members of the linkage; `None` is a body at rest.
#[derive(Clone, Copy, Debug)]
struct Link {
    bodies: [Option<usize>; 2],
    condition: Condition,
}

/// A rigid body of one or more blocks.
#[derive(Clone, Debug)]
struct Member {
    blocks: Vec<BlockId>,
    /// The velocity of `centre` and the spin of the body.
    motion: Motion,
    centre: Point,
}

/// A group of connected blocks that move. The positions of its bodies are a vector with three numbers for each body: the
/// translation of its centre in metres, and its rotation in radians times `length`.
#[derive(Clone, Debug)]
pub(super) struct Linkage {
    members: Vec<Member>,
    links: Vec<Link>,
    /// The length scale of the frame in metres.
    length: f64,
}

impl Linkage {
    /// Creates the linkage of the moving blocks in `group`. It contains the conditions of every joint of these blocks
    /// at which the two bodies stay in contact.
    pub fn new(fall: &Fall<'_>, group: &[Motion]) -> Linkage {
        let within = |body: &Vec<Motion>| body.iter().any(|m| group.iter().any(|g| g.block == m.block));
        let member = |body: Vec<Motion>| {
            let middles = body.iter().map(|m| fall.scene.blocks[m.block.0].centroid.coords);
            // Mirrored bodies have mirrored centres, so a symmetric mechanism stays symmetric on its way.
            let centre = Point::from(middles.sum::<Vector>() / body.len() as f64);
            let motion = Motion { velocity: body[0].at(fall.scene, centre), ..body[0] };
            Member { blocks: body.iter().map(|m| m.block).collect(), motion, centre }
        };
        let members: Vec<Member> = fall.rigid_bodies().into_iter().filter(within).map(member).collect();
        let mut number_of: BTreeMap<BlockId, usize> = BTreeMap::new();
        for (number, member) in members.iter().enumerate() {
            number_of.extend(member.blocks.iter().map(|block| (*block, number)));
        }
        let mut links = Vec::new();
        for joint in &fall.joints {
            let interface = &fall.found.contacts[joint.contact].interface;
            let bodies = interface.bodies.map(|body| match body {
                BodyId::Block(block) => number_of.get(&block).copied(),
                BodyId::Ground(_) => None,
            });
            if bodies[0] != bodies[1] {
                let conditions = conditions(fall.scene, interface.bodies, interface.normal, joint);
                let link = |(is_turned, condition)| {
                    let [a, b] = bodies;
                    Link { bodies: if is_turned { [b, a] } else { bodies }, condition }
                };
                links.extend(conditions.into_iter().map(link));
            }
        }
        Linkage { members, links, length: fall.found.length.max(f64::MIN_POSITIVE) }
    }

    /// Returns the blocks of the linkage.
    pub fn blocks(&self) -> impl Iterator<Item = BlockId> {
        self.members.iter().flat_map(|member| member.blocks.iter().copied())
    }

    /// Returns the displacement of each block. `amplitude` is the displacement, in metres, of a point of speed 1. All
    /// joints stay closed if Newton's method finds such positions. Otherwise the displacement of every rigid body
    /// follows from its own velocity and spin alone, and joints may open.
    pub fn displaced(&self, amplitude: f64) -> Vec<(BlockId, Displacement)> {
        let start = self.free(amplitude);
        self.placed(&self.closed(&start).unwrap_or(start))
    }

    /// Returns the positions of the bodies if every body moves along its own velocity, and joints may open.
    fn free(&self, amplitude: f64) -> DVector<f64> {
        let poses = self.members.iter().flat_map(|member| {
            let way = Displacement::along(&member.motion, member.centre, amplitude).translation;
            [way.x, way.y, amplitude * member.motion.spin * self.length]
        });
        DVector::from_iterator(3 * self.members.len(), poses)
    }

    /// Returns the positions of the bodies at equal steps of the way to `amplitude`, beginning at rest. All joints stay
    /// closed; the list ends early where this is not possible.
    pub fn way(&self, amplitude: f64, steps: usize) -> Vec<DVector<f64>> {
        let mut way = vec![self.free(0.0)];
        for step in 1..=steps {
            let free = self.free(amplitude * step as f64 / steps as f64);
            let next = if self.links.is_empty() {
                Some(free)
            } else {
                // The bodies go on as in the step before.
                let guess = match &way[..] {
                    [.., before, last] => last * 2.0 - before,
                    _ => free,
                };
                self.closed(&guess)
            };
            match next {
                Some(poses) => way.push(poses),
                None => break,
            }
        }
        way
    }

    /// Returns the displacement of each block in these positions.
    pub fn placed(&self, poses: &DVector<f64>) -> Vec<(BlockId, Displacement)> {
        let one = |(number, member): (usize, &Member)| {
            let displacement = self.displacement(number, poses);
            member.blocks.iter().map(|block| (*block, displacement)).collect::<Vec<_>>()
        };
        self.members.iter().enumerate().flat_map(one).collect()
    }

    fn displacement(&self, number: usize, poses: &DVector<f64>) -> Displacement {
        let pose = poses.rows(3 * number, 3);
        Displacement::new(self.members[number].centre, pose[2] / self.length, Vector::new(pose[0], pose[1]))
    }

    /// Returns positions of the bodies near `start` for which all joints are closed. Returns `None` if there are no
    /// joints or too many bodies, or if Newton's method does not find such positions.
    fn closed(&self, start: &DVector<f64>) -> Option<DVector<f64>> {
        if self.links.is_empty() || self.members.len() > MAX_BODIES {
            return None;
        }
        let mut poses = start.clone();
        for _ in 0..MAX_STEPS {
            let (rows, gaps) = self.equations(&mut poses);
            if gaps.amax() <= CLOSURE_TOL * self.length {
                let correction = (&poses - start).norm();
                return (correction <= MAX_CORRECTION * start.norm()).then_some(poses);
            }
            let mut square = &rows * rows.transpose();
            let ridge = REGULARIZATION * square.diagonal().amax().max(f64::MIN_POSITIVE);
            for i in 0..square.nrows() {
                square[(i, i)] += ridge;
            }
            poses -= rows.transpose() * square.cholesky()?.solve(&gaps);
        }
        None
    }

    /// Returns the Jacobian matrix of all joint conditions, from central differences, and the gap of each condition in
    /// metres. The positions are unchanged afterwards.
    fn equations(&self, poses: &mut DVector<f64>) -> (DMatrix<f64>, DVector<f64>) {
        let step = STEP * self.length;
        let (mut gaps, mut entries) = (Vec::new(), Vec::new());
        for link in &self.links {
            let first_row = gaps.len();
            gaps.extend(self.gaps(link, poses));
            for column in link.bodies.into_iter().flatten().flat_map(|body| 3 * body..3 * body + 3) {
                let here = poses[column];
                let [before, after] = [-step, step].map(|step| {
                    poses[column] = here + step;
                    self.gaps(link, poses)
                });
                poses[column] = here;
                for (number, (after, before)) in after.iter().zip(before).enumerate() {
                    entries.push((first_row + number, column, (after - before) / (2.0 * step)));
                }
            }
        }
        let mut rows = DMatrix::zeros(gaps.len(), poses.len());
        for (row, column, value) in entries {
            rows[(row, column)] = value;
        }
        (rows, DVector::from_vec(gaps))
    }

    /// Returns the gaps of a joint in metres.
    fn gaps(&self, link: &Link, poses: &DVector<f64>) -> Vec<f64> {
        let moved = link.bodies.map(|body| body.map(|number| self.displacement(number, poses)));
        let gap = |at: Point| {
            let [first, second] = moved.map(|body| body.map_or(at, |displacement| displacement.moved(at)));
            first - second
        };
        match link.condition {
            Condition::Hinge(at) => gap(at).iter().copied().collect(),
            Condition::OnLine(at, normal) => {
                let normal = moved[1].map_or(normal, |displacement| displacement.turned(normal));
                vec![normal.dot(&gap(at))]
            }
            Condition::Parallel => {
                let [first, second] = link.bodies.map(|body| body.map_or(0.0, |number| poses[3 * number + 2]));
                vec![first - second]
            }
        }
    }
}

/// Returns the conditions that keep a joint closed. The flag of a condition is true if its two bodies have to be
/// exchanged: the line of [`Condition::OnLine`] then belongs to the first body of the contact. A joint whose bodies
/// separate, or that opens while it slides, has no conditions.
fn conditions(scene: &Scene, bodies: [BodyId; 2], normal: Vector, joint: &Joint) -> Vec<(bool, Condition)> {
    if let Some(at) = joint.hinge {
        return vec![(false, Condition::Hinge(at))];
    }
    if joint.slip == 0.0 || joint.lift != 0.0 {
        return Vec::new();
    }
    let Some(at) = joint.touch else {
        // The bodies slide along their whole interface, so they stay parallel.
        return vec![(false, Condition::Parallel), (false, Condition::OnLine(joint.at, normal))];
    };
    // A corner of one body slides along an edge of the other body.
    let is_corner = |body: BodyId| {
        let polygon = &scene.body(body).polygon;
        let near = 1e-6 * polygon.bounds().diagonal();
        polygon.rings().iter().flatten().any(|corner| (corner - at).norm() <= near)
    };
    vec![(!is_corner(bodies[0]) && is_corner(bodies[1]), Condition::OnLine(at, normal))]
}
