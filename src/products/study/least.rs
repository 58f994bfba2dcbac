//! Computes, in extended precision, the forces with the least sum of squares among the optimal forces (the forces with
//! the least sum of magnitudes). They are unique. The largest resultant of these forces at a contact or grip is the
//! reference value for the largest single force.
//!
//! A program may have many optima, but only one of them has the least sum of squared forces. The unknowns are N1, N2
//! and T of each contact, and three components of each grip.
//!
//! 1. A quadratic program on the optimal face, solved in f64, suggests the faces of the friction cones that contain
//!    the forces.
//! 2. On these faces, the least-squares solution follows from one linear system. It is refined in [`Double`]
//!    precision.
//! 3. The result is accepted if the forces are admissible, if their sum is the certified optimum, and if no column of
//!    the optimal face reduces the sum of squares (the Karush-Kuhn-Tucker conditions), each to [`OPTIMALITY_TOL`].

use std::collections::BTreeMap;

use super::double::Double;
use super::optimum::{OPTIMALITY_TOL, Optimum, add, entries, product};
use super::skyline::Skyline;
use crate::mechanics::program::{Column, Force, Program, least_squares};
use crate::mechanics::solve::{Conditioning, Status, solve};

/// The number of the contact or grip at which a force acts: contacts come first, then grips.
type Place = usize;

/// A direction of the force at one contact or grip. It is orthogonal to the other directions at the same contact or
/// grip.
struct Axis {
    place: Place,
    direction: [Double; 3],
    /// The column of the program for the force `direction`: pairs of row and value.
    entries: Vec<(usize, Double)>,
    /// The squared length of `direction`.
    square: Double,
}

/// Returns the largest resultant, at a contact or grip, of the optimal forces with the least sum of squares. It is in
/// the scaled units of the program. Returns `None` if the forces cannot be certified, or if a robot is at its limit.
pub(super) fn largest_of_unique(program: &Program, columns: &[Column], optimum: &Optimum) -> Option<f64> {
    if optimum.limited {
        return None;
    }
    let face: Vec<Column> = optimum.face.iter().map(|j| columns[*j]).collect();
    for tolerance in [1e-9, 1e-11, 1e-7] {
        let conic = least_squares(&program.loads, &face, None);
        let answer = solve(&conic, tolerance, Conditioning::Full);
        if answer.status != Status::Solved {
            continue;
        }
        // Read the multipliers of the constraints −x ≤ 0. Each column has one such row; a column with a limit also has
        // a row for this limit.
        let mut row = program.loads.len();
        let mut multiplier = Vec::with_capacity(face.len());
        for column in &face {
            multiplier.push(answer.z[row]);
            row += 1 + usize::from(column.limit.is_finite());
        }
        // A column counts as used if its amount times this factor exceeds its multiplier. Several factors are tried,
        // because rounding errors can hide which columns are used.
        for factor in [1.0, 1e2, 1e-2, 1e4, 1e-4] {
            let used = face.iter().zip(&answer.x).zip(&multiplier).filter(|((_, x), z)| **x * factor > **z);
            let axes = axes(program, used.map(|((c, _), _)| c));
            if let Some(largest) = certified(program, &face, &axes, optimum.value) {
                return Some(largest);
            }
        }
    }
    None
}

/// Returns the contact or grip of a column, and the components of its unit force: N1, N2 and T at a contact; Fx, Fy and
/// torque at a grip.
fn place(program: &Program, column: &Column) -> (Place, [Double; 3]) {
    let mut vector = [Double::ZERO; 3];
    match column.force {
        Force::Ray { contact, point, normal, friction } => {
            vector[point] = normal.into();
            vector[2] = friction.into();
            (contact, vector)
        }
        Force::Grip { grip, component, sign } => {
            vector[component] = sign.into();
            (program.contacts.len() + grip, vector)
        }
        // This case never occurs: this function gets only columns without adhesion.
        _ => (usize::MAX, vector),
    }
}

fn dot(a: &[Double; 3], b: &[Double; 3]) -> Double {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Makes the force directions of the used columns at each contact or grip orthogonal, by Gram-Schmidt. The columns of
/// one contact or grip must be consecutive.
fn axes<'a>(program: &Program, used: impl Iterator<Item = &'a Column>) -> Vec<Axis> {
    let mut axes: Vec<Axis> = Vec::new();
    for column in used {
        let (place, mut direction) = place(program, column);
        let mut rows: BTreeMap<usize, Double> = entries(column).into_iter().collect();
        let whole = dot(&direction, &direction).near();
        for axis in axes.iter().rev().take_while(|a| a.place == place) {
            let share = dot(&direction, &axis.direction) / axis.square;
            for (d, a) in direction.iter_mut().zip(&axis.direction) {
                *d = *d - share * *a;
            }
            for (row, value) in &axis.entries {
                let at = rows.entry(*row).or_default();
                *at = *at - share * *value;
            }
        }
        let square = dot(&direction, &direction);
        // Leave out directions that depend on the earlier ones. Directions are rounded to 1e-16, so the remainder of
        // a dependent direction has about 1e-32 of its squared length. The threshold 1e-20 lies far above this.
        if square.near() > 1e-20 * whole {
            axes.push(Axis { place, direction, entries: rows.into_iter().collect(), square });
        }
    }
    axes
}

/// Solves for the forces along the axes. Returns the largest resultant, or `None` if the forces do not balance the
/// loads, are not admissible, are not optimal, or do not have the least sum of squares. `total` is the certified
/// optimum of the sum of forces.
fn certified(program: &Program, face: &[Column], axes: &[Axis], total: Double) -> Option<f64> {
    let one = Double::from(1.0);
    let terms = axes.iter().map(|axis| (one / axis.square, axis.entries.as_slice()));
    let matrix = Skyline::new(program.loads.len(), terms);
    let loads: Vec<Double> = program.loads.iter().map(|v| Double::from(*v)).collect();
    let mut w = vec![Double::ZERO; loads.len()];
    let mut rest = loads.clone();
    let amounts =
        |w: &[Double]| -> Vec<Double> { axes.iter().map(|axis| product(&axis.entries, w) / axis.square).collect() };
    for _ in 0..4 {
        for (w, d) in w.iter_mut().zip(matrix.solve(&rest)) {
            *w = *w + d;
        }
        rest = loads.clone();
        for (axis, amount) in axes.iter().zip(amounts(&w)) {
            add(&mut rest, &axis.entries, -amount);
        }
    }
    let places = program.contacts.len() + program.grips.len();
    let mut forces = vec![[Double::ZERO; 3]; places];
    for (axis, amount) in axes.iter().zip(amounts(&w)) {
        for (f, d) in forces[axis.place].iter_mut().zip(&axis.direction) {
            *f = *f + amount * *d;
        }
    }
    let size = total.near().max(1e-300);
    let small = OPTIMALITY_TOL * size;
    let balanced = rest.iter().all(|r| r.abs().near() <= small);
    let (contacts, grips) = forces.split_at(program.contacts.len());
    let admissible = contacts.iter().zip(&program.contacts).all(|(f, contact)| {
        let pressed = f[0] + f[1];
        let most = Double::from(contact.friction) * pressed;
        let slip = (f[2].abs() - most).near();
        f[0].near().min(f[1].near()) >= -small && slip <= OPTIMALITY_TOL * size
    });
    let sum = forces.iter().flatten().fold(Double::ZERO, |s, v| s + v.abs());
    let optimal = (sum - total).abs().near() <= 10.0 * OPTIMALITY_TOL * size;
    let shortest = face.iter().all(|column| {
        let (place, direction) = place(program, column);
        let gain = dot(&direction, &forces[place]) - product(&entries(column), &w);
        gain.near() >= -small
    });
    if !(balanced && admissible && optimal && shortest) {
        return None;
    }
    let norm = |x: Double, y: Double| libm::hypot(x.near(), y.near());
    let contacts = contacts.iter().map(|f| norm(f[0] + f[1], f[2]));
    let grips = grips.iter().map(|f| norm(f[0], f[1]));
    Some(contacts.chain(grips).fold(0.0, f64::max))
}
