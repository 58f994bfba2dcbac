//! [`Linkage`]: moves rigid bodies that are joined by hinges and sliding joints, and keeps these joints closed along
//! the path.
//!
//! Every body first moves along its own velocity. This alone would open the joints, by gaps proportional to the square
//! of the angle. A few steps of Newton's method, each with the least-norm correction, then close all joints.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::super::joint::Joint;
use super::group::rigid_bodies;
use super::rigid::Displacement;
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::analysis::{Analysis, Motion};
use crate::mechanics::scene::{BlockId, BodyId, Scene};

/// Joints are not closed if there are more bodies than this, because closing them would take longer than the drawing.
const MAX_BODIES: usize = 40;
/// Largest number of steps of Newton's method.
const MAX_STEPS: usize = 12;
/// Largest gap of a joint that counts as closed, as a fraction of the length scale of the frame.
const CLOSURE_TOL: f64 = 1e-7;
/// Largest accepted correction of a body's position, as a fraction of the largest displacement. With a larger
/// correction, the joints cannot be closed sensibly, and the bodies keep the positions without correction.
const MAX_CORRECTION: f64 = 1.0;
/// Number that is added to each diagonal entry of the matrix, relative to the largest of these entries. Redundant
/// equations would make the matrix singular.
const REGULARIZATION: f64 = 1e-10;

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

/// A group of connected blocks that move.
#[derive(Clone, Debug)]
pub(super) struct Linkage {
    members: Vec<Member>,
    links: Vec<Link>,
    /// The length in metres by which angles are multiplied, so that they have the unit of translations.
    length: f64,
}

/// The displacement of a body from its original position: the translation of its centre in metres, and its rotation in
/// radians.
#[derive(Clone, Copy, Debug)]
struct Pose {
    way: Vector,
    angle: f64,
}

impl Linkage {
    /// Creates the linkage of the moving blocks in `group`. It contains the conditions of every joint of these blocks
    /// at which the two bodies stay in contact. `joints` are all joints of the frame.
    pub fn new(analysis: &Analysis, frame: usize, joints: &[Joint], group: &[Motion]) -> Linkage {
        let (scene, frame_analysis) = (&analysis.scene, &analysis.frames[frame]);
        let within = |body: &Vec<Motion>| body.iter().any(|m| group.iter().any(|g| g.block == m.block));
        let bodies = rigid_bodies(analysis, frame, joints).into_iter().filter(within);
        let members: Vec<Member> = bodies.map(|body| member(scene, &body)).collect();
        let mut number_of: BTreeMap<BlockId, usize> = BTreeMap::new();
        for (number, member) in members.iter().enumerate() {
            number_of.extend(member.blocks.iter().map(|block| (*block, number)));
        }
        let mut links = Vec::new();
        for joint in joints {
            let interface = &frame_analysis.contacts[joint.contact].interface;
            let bodies = interface.bodies.map(|body| match body {
                BodyId::Block(block) => number_of.get(&block).copied(),
                BodyId::Ground(_) => None,
            });
            if bodies[0] == bodies[1] {
                continue;
            }
            links.extend(conditions(scene, interface.bodies, interface.normal, joint).into_iter().map(
                |(turned, condition)| Link { bodies: if turned { [bodies[1], bodies[0]] } else { bodies }, condition },
            ));
        }
        Linkage { members, links, length: frame_analysis.length.max(f64::MIN_POSITIVE) }
    }

    /// Returns the number of blocks in the linkage.
    pub fn len(&self) -> usize {
        self.blocks().count()
    }

    /// Returns the blocks of the linkage.
    pub fn blocks(&self) -> impl Iterator<Item = BlockId> {
        self.members.iter().flat_map(|member| member.blocks.iter().copied())
    }

    /// Returns the displacement of each block. `amplitude` is the displacement, in metres, of a point of speed 1. All
    /// joints stay closed if Newton's method finds such positions. Otherwise the displacement of every rigid body
    /// follows from its own velocity and spin alone, and joints may open.
    pub fn displaced(&self, amplitude: f64) -> Vec<(BlockId, Displacement)> {
        let start: Vec<Pose> = self
            .members
            .iter()
            .map(|member| Pose {
                way: Displacement::new(&member.motion, member.centre, amplitude).translation(),
                angle: amplitude * member.motion.spin,
            })
            .collect();
        let poses = self.closed(&start).unwrap_or(start);
        let mut displaced = Vec::new();
        for (member, pose) in self.members.iter().zip(poses) {
            let displacement = Displacement::from_pose(member.centre, pose.angle, pose.way);
            displaced.extend(member.blocks.iter().map(|block| (*block, displacement)));
        }
        displaced
    }

    /// Returns positions and rotations of the bodies near `start` for which all joints are closed. Returns `None` if
    /// there are no joints or too many bodies, or if Newton's method does not find such positions.
    fn closed(&self, start: &[Pose]) -> Option<Vec<Pose>> {
        if self.links.is_empty() || self.members.len() > MAX_BODIES {
            return None;
        }
        let mut poses = start.to_vec();
        for _ in 0..MAX_STEPS {
            let (rows, gaps) = self.equations(&poses);
            if gaps.amax() <= CLOSURE_TOL * self.length {
                let far = |(pose, start): (&Pose, &Pose)| (pose.way - start.way).norm();
                let correction = poses.iter().zip(start).map(far).fold(0.0, f64::max);
                let way = start.iter().map(|p| p.way.norm() + p.angle.abs() * self.length);
                let way = way.fold(0.0, f64::max);
                return (correction <= MAX_CORRECTION * way).then_some(poses);
            }
            let mut square = &rows * rows.transpose();
            let ridge = REGULARIZATION * square.diagonal().amax().max(f64::MIN_POSITIVE);
            for i in 0..square.nrows() {
                square[(i, i)] += ridge;
            }
            let multipliers = square.cholesky()?.solve(&gaps);
            let step = rows.transpose() * multipliers;
            for (number, pose) in poses.iter_mut().enumerate() {
                pose.way -= Vector::new(step[3 * number], step[3 * number + 1]);
                pose.angle -= step[3 * number + 2] / self.length;
            }
        }
        None
    }

    /// Returns the Jacobian matrix of all joint conditions, and the residual of each condition in metres. The matrix
    /// has three columns for each body: x, y, and angle × [`Linkage::length`].
    fn equations(&self, poses: &[Pose]) -> (DMatrix<f64>, DVector<f64>) {
        let count = self.links.iter().map(|link| match link.condition {
            Condition::Hinge(_) => 2,
            Condition::OnLine(..) | Condition::Parallel => 1,
        });
        let mut system = System {
            rows: DMatrix::zeros(count.sum(), 3 * self.members.len()),
            gaps: DVector::zeros(0),
            length: self.length,
        };
        system.gaps = DVector::zeros(system.rows.nrows());
        let mut row = 0;
        for link in &self.links {
            row += self.add(link, poses, row, &mut system);
        }
        (system.rows, system.gaps)
    }

    /// Writes the linearized equations of a link into `system`, starting at the row `row`. Returns the number of
    /// equations.
    fn add(&self, link: &Link, poses: &[Pose], row: usize, system: &mut System) -> usize {
        let [first, second] = link.bodies;
        match link.condition {
            Condition::Hinge(point) => {
                let gap = self.place(first, poses, point) - self.place(second, poses, point);
                for (number, axis) in [Vector::x(), Vector::y()].into_iter().enumerate() {
                    system.gaps[row + number] = gap.dot(&axis);
                    for (body, sign) in [(first, 1.0), (second, -1.0)] {
                        let arm = self.arm(body, poses, point);
                        system.add(row + number, body, axis * sign, arm);
                    }
                }
                2
            }
            Condition::OnLine(point, normal) => {
                let angle = second.map_or(0.0, |body| poses[body].angle);
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                let normal = normal * cos + quarter_turn(normal) * sin;
                let way = self.place(first, poses, point) - self.place(second, poses, point);
                system.gaps[row] = normal.dot(&way);
                system.add(row, first, normal, self.arm(first, poses, point));
                // The line belongs to the second body and turns with it about its centre.
                let arm = self.arm(second, poses, point) + way;
                system.add(row, second, -normal, arm);
                1
            }
            Condition::Parallel => {
                let angle = |body: Option<usize>| body.map_or(0.0, |body| poses[body].angle);
                system.gaps[row] = (angle(first) - angle(second)) * self.length;
                for (body, sign) in [(first, 1.0), (second, -1.0)] {
                    if let Some(body) = body {
                        system.rows[(row, 3 * body + 2)] += sign;
                    }
                }
                1
            }
        }
    }

    /// Returns the vector from the centre of a displaced body to one of its points, metres. `point` is the position of
    /// this point before the displacement. The vector is zero for a body at rest.
    fn arm(&self, body: Option<usize>, poses: &[Pose], point: Point) -> Vector {
        body.map_or(Vector::zeros(), |body| {
            let (centre, pose) = (self.members[body].centre, poses[body]);
            Displacement::from_pose(centre, pose.angle, pose.way).turned(point - centre)
        })
    }

    /// Returns the displaced position of a point of a body, metres. `body` is `None` for a body at rest.
    fn place(&self, body: Option<usize>, poses: &[Pose], point: Point) -> Point {
        body.map_or(point, |body| self.members[body].centre + poses[body].way + self.arm(Some(body), poses, point))
    }
}

/// The Jacobian matrix of all joint conditions and their residuals in metres.
struct System {
    rows: DMatrix<f64>,
    gaps: DVector<f64>,
    length: f64,
}

impl System {
    /// Adds to a row the derivatives of a point's position in the direction `along` with respect to the pose of its
    /// body. `arm` is the vector from the centre of the body to the point.
    fn add(&mut self, row: usize, body: Option<usize>, along: Vector, arm: Vector) {
        let Some(body) = body else {
            return;
        };
        self.rows[(row, 3 * body)] += along.x;
        self.rows[(row, 3 * body + 1)] += along.y;
        self.rows[(row, 3 * body + 2)] += along.dot(&quarter_turn(arm)) / self.length;
    }
}

fn member(scene: &Scene, body: &[Motion]) -> Member {
    let first = body[0];
    Member {
        blocks: body.iter().map(|m| m.block).collect(),
        motion: first,
        centre: scene.blocks[first.block.0].centroid,
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
    match joint.touch {
        // The bodies slide along their whole interface, so they stay parallel.
        None => vec![(false, Condition::Parallel), (false, Condition::OnLine(joint.at, normal))],
        // A corner of one body slides along an edge of the other body.
        Some(at) => {
            let is_corner = |body: BodyId| {
                let mut corners = scene.body(body).polygon.rings().iter().flatten();
                let near = 1e-6 * scene.body(body).polygon.bounds().diagonal();
                corners.any(|corner| (corner - at).norm() <= near)
            };
            let turned = !is_corner(bodies[0]) && is_corner(bodies[1]);
            vec![(turned, Condition::OnLine(at, normal))]
        }
    }
}
