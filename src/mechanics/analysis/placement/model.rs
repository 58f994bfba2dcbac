//! [`Model`]: the equilibrium of a component whose joints, centres of gravity and loads may be off their places.
//!
//! The unknowns x are N₁, N₂ and T of each joint, and the force and torque of each grip. Their equations A x = b do not
//! depend on the errors. With all ends of joints up to d inside their places, the conditions of a joint are
//! N₁ ≥ δ (N₁ + N₂), N₂ ≥ δ (N₁ + N₂) and |T| ≤ μ (N₁ + N₂), where δ is the error divided by the length of the joint.
//! Each condition is one [`Row`]: row · x ≤ limit.

use std::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::geometry::{Vector, cross, quarter_turn};
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::statics::assembly::Assembly;

/// The largest error at each end of a joint, as a share of its length. A joint without length gives programs that no
/// solver can solve.
pub(super) const LARGEST_ERROR: f64 = 0.4995;

/// A joint of at most this share of the component's length acts at one point: with a kernel of 1, only the rounding of
/// coordinates is left between its ends.
const MIN_LENGTH: f64 = 1e-12;

/// What is added to the diagonal of the normal equations, as a share of its largest entry. Repeated corrections remove
/// its effect.
const REGULARISATION: f64 = 1e-12;

/// A condition on the forces: the sum of coefficient · unknown is at most `limit`.
pub(super) struct Row {
    pub entries: Vec<(usize, f64)>,
    pub limit: f64,
    /// The change of the row's value per unit of tolerance, per unit of N₁ + N₂, and the unknown N₁; `None` if the row
    /// does not depend on the tolerance.
    pub growth: Option<(usize, f64)>,
}

impl Row {
    /// Returns row · x.
    pub fn times(&self, x: &[f64]) -> f64 {
        self.entries.iter().map(|(unknown, value)| value * x[*unknown]).sum()
    }

    /// Returns the derivative of row · x with respect to the tolerance.
    pub fn growth(&self, x: &[f64]) -> f64 {
        self.growth.map_or(0.0, |(first, rate)| rate * (x[first] + x[first + 1]))
    }
}

/// A direction of the forces of a joint or grip.
pub(super) struct Line {
    pub entries: Vec<(usize, f64)>,
    /// The rows of the joint or grip.
    pub rows: Range<usize>,
}

/// A joint: its first unknown, the number of its unknowns (2 without friction, else 3), and what its rows need.
struct Joint {
    first: usize,
    friction: f64,
    /// How much of the joint's length an error of 1 takes away at each end.
    rate: f64,
}

/// The equilibrium of a component in program units: lengths in L, forces divided by [`Scale::HEAVIEST`].
pub(super) struct Model {
    /// The entries of each column of A.
    pub columns: Vec<Vec<(usize, f64)>>,
    /// The right-hand side without errors: minus the loads of each body.
    pub loads: Vec<f64>,
    /// The moment of each body per unit of error: its weight and the magnitudes of its loads, times its own scale.
    pub moments: Vec<f64>,
    /// Metres per unit of length.
    pub metres: f64,
    /// Newtons per unit of force.
    pub newtons: f64,
    /// The component of each unknown: 3k + i for number i of contact k; the grips follow the contacts.
    pub components: Vec<usize>,
    joints: Vec<Joint>,
    grips: Vec<(usize, f64)>,
    normal: Option<Cholesky<f64, Dyn>>,
}

impl Model {
    /// Sets up the model. `moments` are N per body, and `scales` say by how much the error of each body is multiplied.
    /// `None` if some contact acts at one point, so that no error at all is allowed.
    pub fn new(component: &Assembly, moments: &[f64], scales: &[f64]) -> Option<Model> {
        let scale = Scale::from_assembly(component);
        let program = Program::new(component, scale);
        let unit = scale.force * Scale::HEAVIEST;
        let (mut columns, mut components) = (Vec::new(), Vec::new());
        let mut joints = Vec::new();
        for (k, (contact, term)) in component.contacts.iter().zip(&program.contacts).enumerate() {
            let length = (contact.points[1] - contact.points[0]).norm() / scale.length;
            if term.points < 2 || length <= MIN_LENGTH {
                return None;
            }
            let first = columns.len();
            let tangent = quarter_turn(term.normal);
            let friction = (term.friction > 0.0).then_some((tangent, 0));
            for (direction, point) in [(term.normal, 0), (term.normal, 1)].into_iter().chain(friction) {
                let own = (term.on.0, term.on.1[point], direction);
                let other = term.from.map(|(body, arms)| (body, arms[point], -direction));
                components.push(3 * k + columns.len() - first);
                columns.push([Some(own), other].into_iter().flatten().flat_map(force_entries).collect());
            }
            let error = contact.from.map_or(0.0, |body| scales[body]).max(scales[contact.on]);
            joints.push(Joint { first, friction: term.friction, rate: error / length });
        }
        let mut grips = Vec::new();
        for (k, grip) in program.grips.iter().enumerate() {
            for number in (0..3).filter(|number| grip.limits[*number] > 0.0) {
                grips.push((columns.len(), grip.limits[number] / Scale::HEAVIEST));
                components.push(3 * (component.contacts.len() + k) + number);
                columns.push(match number {
                    0 => force_entries((grip.block, grip.arm, Vector::new(1.0, 0.0))).collect(),
                    1 => force_entries((grip.block, grip.arm, Vector::new(0.0, 1.0))).collect(),
                    _ => vec![(3 * grip.block + 2, 1.0)],
                });
            }
        }
        let loads: Vec<f64> = program.loads.iter().map(|load| load / Scale::HEAVIEST).collect();
        let moments: Vec<f64> = moments.iter().zip(scales).map(|(moment, own)| moment * own / unit).collect();
        let mut normal = DMatrix::zeros(loads.len(), loads.len());
        for column in &columns {
            for (i, a) in column {
                for (j, b) in column {
                    normal[(*i, *j)] += a * b;
                }
            }
        }
        // Without friction, some rows have no entries; they are balanced already, and this keeps the matrix regular.
        let largest = normal.diagonal().max();
        for row in 0..loads.len() {
            normal[(row, row)] += REGULARISATION * largest;
        }
        let normal = Cholesky::new(normal);
        let metres = scale.length;
        Some(Model { columns, loads, moments, metres, newtons: unit, components, joints, grips, normal })
    }

    /// Returns the largest error that leaves every joint a thousandth of its length.
    pub fn end_of_joints(&self) -> f64 {
        let rates = self.joints.iter().map(|joint| joint.rate);
        LARGEST_ERROR / rates.fold(0.0, f64::max)
    }

    /// Returns the joints that leave the least room for errors.
    pub fn shortest(&self) -> impl Iterator<Item = usize> {
        let least = LARGEST_ERROR / self.end_of_joints() * (1.0 - 1e-6);
        self.joints.iter().enumerate().filter(move |(_, joint)| joint.rate >= least).map(|(k, _)| k)
    }

    /// Returns the rows at a tolerance. Their number and order do not depend on it.
    pub fn rows(&self, tolerance: f64) -> Vec<Row> {
        let mut rows = Vec::new();
        for joint in &self.joints {
            let Joint { first, friction, rate } = *joint;
            let share = rate * tolerance;
            let growth = (rate > 0.0).then_some((first, rate));
            for (own, other) in [(first, first + 1), (first + 1, first)] {
                rows.push(Row { entries: vec![(own, share - 1.0), (other, share)], limit: 0.0, growth });
            }
            if friction > 0.0 {
                for sign in [1.0, -1.0] {
                    let entries = vec![(first, -friction), (first + 1, -friction), (first + 2, sign)];
                    rows.push(Row { entries, limit: 0.0, growth: None });
                }
            }
        }
        for (unknown, limit) in self.grips.iter().filter(|grip| grip.1.is_finite()) {
            for sign in [1.0, -1.0] {
                rows.push(Row { entries: vec![(*unknown, sign)], limit: *limit, growth: None });
            }
        }
        rows
    }

    /// Returns the lines along which two rows of a joint, or the row of a grip, are 0. Σ weight |row · x| is linear between
    /// such lines, so that every x is a sum of forces along them at no higher a sum.
    pub fn lines(&self, tolerance: f64) -> Vec<Line> {
        let mut lines = Vec::new();
        let mut row = 0;
        for Joint { first, friction, rate } in &self.joints {
            let (share, first) = (rate * tolerance, *first);
            let rows = row..row + if *friction > 0.0 { 4 } else { 2 };
            row = rows.end;
            let mut add = |entries: Vec<(usize, f64)>| lines.push(Line { entries, rows: rows.clone() });
            for (a, b) in [(share, 1.0 - share), (1.0 - share, share)] {
                let pressure = vec![(first, a), (first + 1, b)];
                if *friction > 0.0 {
                    for side in [1.0, -1.0] {
                        add([&pressure[..], &[(first + 2, side * friction)]].concat());
                    }
                } else {
                    add(pressure);
                }
            }
            if *friction > 0.0 {
                add(vec![(first, 1.0), (first + 1, -1.0)]);
                add(vec![(first + 2, 1.0)]);
            }
        }
        for (unknown, limit) in &self.grips {
            let rows = row..row + if limit.is_finite() { 2 } else { 0 };
            row = rows.end;
            lines.push(Line { entries: vec![(*unknown, 1.0)], rows });
        }
        lines
    }

    /// Returns the contact to which each row belongs; `None` for the rows of grips.
    pub fn contact_of_row(&self, row: usize) -> Option<usize> {
        let mut next = 0;
        self.joints.iter().position(|joint| {
            next += if joint.friction > 0.0 { 4 } else { 2 };
            row < next
        })
    }

    /// Returns the load vector of a moment of 1 on a body.
    pub fn unit_moment(&self, body: usize) -> Vec<f64> {
        let mut loads = vec![0.0; self.loads.len()];
        loads[3 * body + 2] = 1.0;
        loads
    }

    /// Returns the forces nearest to `x` with A x = `loads`, and the largest residual that is left.
    pub fn balanced(&self, mut x: Vec<f64>, loads: &[f64]) -> (Vec<f64>, f64) {
        let mut residual = self.residual(&x, loads);
        if let Some(normal) = &self.normal {
            for _ in 0..3 {
                let step = normal.solve(&DVector::from_column_slice(&residual));
                for (amount, column) in x.iter_mut().zip(&self.columns) {
                    *amount += column.iter().map(|(row, value)| value * step[*row]).sum::<f64>();
                }
                residual = self.residual(&x, loads);
            }
        }
        let left = residual.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        (x, left)
    }

    /// Returns `loads` − A x.
    fn residual(&self, x: &[f64], loads: &[f64]) -> Vec<f64> {
        let mut left = loads.to_vec();
        for (amount, column) in x.iter().zip(&self.columns) {
            for (row, value) in column {
                left[*row] -= value * amount;
            }
        }
        left
    }
}

/// Returns the coefficients of a force of 1 in `direction` that acts on a body at `arm` from its centroid.
fn force_entries((body, arm, direction): (usize, Vector, Vector)) -> impl Iterator<Item = (usize, f64)> {
    [(3 * body, direction.x), (3 * body + 1, direction.y), (3 * body + 2, cross(arm, direction))].into_iter()
}
