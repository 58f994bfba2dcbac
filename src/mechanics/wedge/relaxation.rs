//! [`VariableLayout::relaxation`]: the relaxation of a branch-and-bound node to linear constraints, as a quadratic
//! program.
//!
//! The unknowns are the displacements of the blocks, the normal force at each application point, the friction force of
//! each contact and the force components of the robots. For points and faces that the node decides, the springs' law
//! becomes equalities and inequalities. For open points and faces, the springs' law is relaxed to N ≥ 0, N ≥ −g and |T|
//! ≤ μ(N1 + N2), where g is the opening of a point.

use super::node::{Branch, Node};
use super::spring::{Slide, Springs};
use crate::mechanics::program::{Column, QuadraticProgram};

/// The weight of ½|unknowns|² in the objective, multiplied by Σ |load|. This term makes the optimum unique and finite.
///
/// The linear terms of the objective have coefficients of about 1. If this weight were ten times larger, it would
/// compete with them.
const REGULARIZATION: f64 = 1e-3;

/// The indices at which the kinds of unknown begin: displacements at 0, then normal forces, friction forces and robots'
/// components.
pub(super) struct VariableLayout {
    pub points: usize,
    pub faces: usize,
    grips: usize,
    end: usize,
    /// Σ |load|, the unit of forces and displacements.
    size: f64,
}

/// Rows Ax = b or Ax ≤ b under construction.
#[derive(Default)]
struct Rows {
    entries: Vec<(usize, usize, f64)>,
    bound: Vec<f64>,
}

impl Rows {
    fn add(&mut self, entries: impl IntoIterator<Item = (usize, f64)>, bound: f64) {
        let row = self.bound.len();
        let entries = entries.into_iter();
        self.entries.extend(entries.map(|(k, v)| (row, k, v)));
        self.bound.push(bound);
    }
}

/// The rows and the linear objective under construction.
struct Builder {
    equal: Rows,
    at_most: Rows,
    linear: Vec<f64>,
}

impl VariableLayout {
    pub fn new(springs: &Springs) -> VariableLayout {
        let points = springs.program.loads.len();
        let faces = points + springs.points.len();
        let grips = faces + springs.tangents.len();
        let sum: f64 = springs.program.loads.iter().map(|v| v.abs()).sum();
        VariableLayout { points, faces, grips, end: grips + springs.grips.len(), size: sum.max(f64::MIN_POSITIVE) }
    }

    /// Returns the part of a solution `x` that contains the forces and torques of the robots.
    pub fn grips<'x>(&self, x: &'x [f64]) -> &'x [f64] {
        &x[self.grips..self.end]
    }

    /// Builds the relaxation of a node. Its objective favours complementarity: min Σ (N + (N + g)) over the open
    /// points, plus a small quadratic term.
    pub fn relaxation(&self, springs: &Springs, node: &Node) -> QuadraticProgram {
        let mut builder = Builder { equal: Rows::default(), at_most: Rows::default(), linear: vec![0.0; self.end] };
        self.add_balance(springs, &mut builder);
        let pressing = self.add_points(springs, node, &mut builder);
        self.add_faces(springs, node, &pressing, &mut builder);
        self.add_robots(springs, &mut builder);
        let Builder { equal, at_most, linear } = builder;
        // The equalities come first, as the solver requires.
        let equalities = equal.bound.len();
        let rows = at_most.entries.into_iter();
        let rows = rows.map(|(r, k, v)| (r + equalities, k, v));
        let weight = REGULARIZATION / self.size;
        QuadraticProgram {
            unknowns: self.end,
            quadratic: (0..self.end).map(|k| (k, k, weight)).collect(),
            linear,
            matrix: equal.entries.into_iter().chain(rows).collect(),
            bound: equal.bound.into_iter().chain(at_most.bound).collect(),
            equalities,
        }
    }

    /// Adds the equilibrium equations of all blocks, three rows for each block. They are the first rows of the program.
    fn add_balance(&self, springs: &Springs, builder: &mut Builder) {
        let loads = &springs.program.loads;
        let mut balance = vec![Vec::new(); loads.len()];
        let mut enter = |column: &Column, unknown: usize| {
            let entries = column.entries();
            entries.for_each(|(row, v)| balance[row].push((unknown, v)));
        };
        for (k, point) in springs.points.iter().enumerate() {
            enter(&point.column, self.points + k);
        }
        for (k, tangent) in springs.tangents.iter().enumerate() {
            enter(tangent, self.faces + k);
        }
        for (k, grip) in springs.grips.iter().enumerate() {
            enter(&grip.column, self.grips + k);
        }
        for (row, entries) in balance.into_iter().enumerate() {
            builder.equal.add(entries, loads[row]);
        }
    }

    /// Adds the springs' law at the points, N = max(0, −g). The law is relaxed for open points.
    ///
    /// Returns, for each contact, the indices of the unknown normal forces that may be above 0.
    fn add_points(&self, springs: &Springs, node: &Node, builder: &mut Builder) -> Vec<Vec<usize>> {
        let mut pressing = vec![Vec::new(); springs.tangents.len()];
        for (k, point) in springs.points.iter().enumerate() {
            let normal = self.points + k;
            let gap = |sign: f64| point.column.entries().map(move |(row, v)| (row, sign * v));
            match node.pressed[k] {
                // The point does not press: N = 0 and g ≥ 0.
                Some(false) => {
                    builder.equal.add([(normal, 1.0)], 0.0);
                    builder.at_most.add(gap(-1.0), 0.0);
                }
                // The point presses: N = −g and N ≥ 0.
                Some(true) => {
                    builder.equal.add(gap(1.0).chain([(normal, 1.0)]), 0.0);
                    builder.at_most.add([(normal, -1.0)], 0.0);
                }
                // The point is open (not decided): N ≥ 0 and N ≥ −g.
                None => {
                    builder.at_most.add([(normal, -1.0)], 0.0);
                    (builder.at_most).add(gap(-1.0).chain([(normal, -1.0)]), 0.0);
                    builder.linear[normal] += 2.0;
                    gap(1.0).for_each(|(row, v)| builder.linear[row] += v);
                }
            }
            if node.pressed[k] != Some(false) {
                pressing[point.contact].push(normal);
            }
        }
        pressing
    }

    /// Adds the springs' law at the faces, T = −slip, limited to ±μ(N1 + N2). The law is relaxed for open faces.
    fn add_faces(&self, springs: &Springs, node: &Node, pressing: &[Vec<usize>], builder: &mut Builder) {
        for (k, tangent) in springs.tangents.iter().enumerate() {
            let friction = self.faces + k;
            let mu = springs.program.contacts[k].friction;
            if pressing[k].is_empty() || mu == 0.0 {
                builder.equal.add([(friction, 1.0)], 0.0);
                continue;
            }
            let normals = |by: f64| pressing[k].iter().map(move |n| (*n, by));
            let slip = |sign: f64| tangent.entries().map(move |(row, v)| (row, sign * v));
            let slides = node.slides[k];
            if let Some(Slide::Forth | Slide::Back) = slides {
                let sign = slides.map_or(0.0, Slide::friction_sign);
                // The face slides: T = ±μ(N1 + N2).
                let full = normals(-sign * mu).chain([(friction, 1.0)]);
                builder.equal.add(full, 0.0);
                // The slip is at least the elongation that the friction force causes in the spring.
                builder.at_most.add(slip(sign).chain(normals(mu)), 0.0);
                continue;
            }
            if slides.is_some() {
                // The face sticks: T = −slip.
                builder.equal.add(slip(1.0).chain([(friction, 1.0)]), 0.0);
            }
            for sign in [1.0, -1.0] {
                // The friction limit: |T| ≤ μ(N1 + N2).
                let cone = normals(-mu).chain([(friction, sign)]);
                builder.at_most.add(cone, 0.0);
            }
        }
    }

    /// Adds the limits of the robots. Without robots, adds a row instead which says that the loads do no negative work.
    fn add_robots(&self, springs: &Springs, builder: &mut Builder) {
        let grips = springs.grips.iter().enumerate();
        for (k, grip) in grips.filter(|g| g.1.limit.is_finite()) {
            for sign in [1.0, -1.0] {
                builder.at_most.add([(self.grips + k, sign)], grip.limit);
            }
        }
        if springs.grips.is_empty() {
            // At rest, the work −loads·u of the loads equals Σ N² + Σ |T s|, which is not negative.
            let loads = springs.program.loads.iter().copied().enumerate();
            builder.at_most.add(loads.filter(|e| e.1 != 0.0), 0.0);
        }
    }

    /// Branching rule: returns the open point or face at which a solution violates the law of the springs most. `None`
    /// if there is no open point, and no open face that may transmit force.
    pub fn most_violated(&self, springs: &Springs, node: &Node, x: &[f64]) -> Option<Branch> {
        let u = &x[..self.points];
        let mut worst: Option<(f64, Branch)> = None;
        let mut consider = |violation: f64, branch: Branch| {
            if worst.as_ref().is_none_or(|w| violation > w.0) {
                worst = Some((violation, branch));
            }
        };
        let mut normal = vec![0.0; springs.tangents.len()];
        for (k, point) in springs.points.iter().enumerate() {
            let force = x[self.points + k].max(0.0);
            normal[point.contact] += force;
            if node.pressed[k].is_none() {
                // Complementarity: N or N + g must be 0.
                consider(force.min(force + point.column.dot(u)), Branch::Point(k));
            }
        }
        for (k, tangent) in springs.tangents.iter().enumerate() {
            if node.slides[k].is_none() && node.may_carry(springs, k) {
                let limit = springs.program.contacts[k].friction * normal[k];
                let law = (-tangent.dot(u)).clamp(-limit, limit);
                consider((x[self.faces + k] - law).abs(), Branch::Face(k));
            }
        }
        worst.map(|w| w.1)
    }
}
