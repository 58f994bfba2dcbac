//! [`Reference`]: computes the true verdict, the total force and the largest force of a linear program, with a
//! certificate. The total is given only if at least twelve digits are certain.
//!
//! 1. If a balance without adhesion has a certified optimum ([`optimum`]), the program is stable. Its value is the
//!    least total force.
//! 2. Otherwise adhesion is allowed, and its total is minimised. A certified optimum above 0 means unstable, and a
//!    certified optimum of 0 means stable, without a value for the total force.
//! 3. Otherwise a motion that even adhesion does not resist proves the program unstable.
//! 4. Otherwise the reference is undecided.
//!
//! The reference value for the largest single force is the largest resultant of the optimal forces with the least sum
//! of squares. A program may have many optima, but only one of them has the least sum of squared forces. The unknowns
//! are N1, N2 and T of each contact, and three components of each grip.
//!
//! 1. A quadratic program on the optimal face, solved in f64, suggests the faces of the friction cones that contain
//!    the forces.
//! 2. On these faces, the least-squares solution follows from one linear system. It is refined in [`Double`]
//!    precision.
//! 3. The result is accepted if the forces are admissible, if their sum is the certified optimum, and if no column of
//!    the optimal face reduces the sum of squares (the Karush-Kuhn-Tucker conditions), each to [`OPTIMALITY_TOL`].
//!
//! Every f64 of the program counts as exact. An exact rational simplex method would also certify the result, but the
//! length of its numbers grows with the size of the program.

use std::collections::BTreeMap;

use super::double::Double;
use super::optimum::{OPTIMALITY_TOL, Optimum, add, entries, optimum, power, product};
use super::skyline::Skyline;
use drystone::analysis::Verdict;
use drystone::internals::program::{Column, Force, Program, adhesion_columns, columns, least_squares};
use drystone::internals::solve::{Conditioning, Effort, Status, least_cost, solve};

/// Largest relative gap of a certificate whose value counts as known to twelve digits.
const MAX_GAP: f64 = 1e-12;
/// A motion is only a proof if its power, relative to the largest load, is above this multiple of its largest
/// violation. The factor is far above the rounding errors of the solver.
const MIN_POWER_OVER_VIOLATION: f64 = 1e6;
/// If the power of a motion is below this, relative to the largest velocity, it may be a rounding error.
const MIN_POWER: f64 = 1e-9;

/// The true solution of one program, in its scaled numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// The exact verdict, without a tolerance; `Undecided` if nothing could be certified.
    pub verdict: Verdict,
    /// The least total force if the part stands; the least total adhesion if it falls and adhesion could hold it.
    pub total: Option<f64>,
    /// The largest resultant of the unique forces (the optimal forces with the least sum of squares), if the part
    /// stands. `None` if it could not be certified.
    pub largest: Option<f64>,
    /// The largest possible relative error of `total`: the duality gap, plus the residuals of both solutions.
    pub gap: f64,
}

impl Reference {
    /// Computes the true verdict, the total force and the largest force of a program, with a bound on the error of the
    /// total force.
    pub fn new(program: &Program) -> Reference {
        let unknown = Reference { verdict: Verdict::Undecided, total: None, largest: None, gap: 0.0 };
        let admissible = columns(program);
        if let Some(optimum) = optimum(&program.loads, &admissible, |c| c.cost) {
            let value = optimum.value;
            return Reference {
                verdict: Verdict::Stable,
                total: (optimum.gap <= MAX_GAP).then_some(value.near()),
                largest: largest_of_unique(program, &admissible, &optimum),
                gap: optimum.gap,
            };
        }
        let mut all = admissible;
        all.extend(adhesion_columns(program));
        let adheres = |c: &Column| if c.force.is_adhesion() { 1.0 } else { 0.0 };
        if let Some(optimum) = optimum(&program.loads, &all, adheres) {
            let largest = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let least = optimum.value.near();
            return match least > OPTIMALITY_TOL * largest {
                // The total is certainly positive if its relative error is below 1; the limit 0.5 leaves a factor of
                // 2. A small total among large forces may be known to fewer than twelve digits. Then only the verdict
                // is reported.
                true if optimum.gap < 0.5 => Reference {
                    verdict: Verdict::Unstable,
                    total: (optimum.gap <= MAX_GAP).then_some(least),
                    gap: optimum.gap,
                    ..unknown
                },
                true => unknown,
                // No adhesion is needed, but the program without adhesion has no certified optimum: the structure
                // stands exactly at its limit.
                false => Reference { verdict: Verdict::Stable, ..unknown },
            };
        }
        Reference {
            verdict: if falls_despite_adhesion(&program.loads, &all) { Verdict::Unstable } else { Verdict::Undecided },
            ..unknown
        }
    }
}

/// True if the solver finds a motion along which the loads have power, and which not even adhesion resists.
fn falls_despite_adhesion(loads: &[f64], all: &[Column]) -> bool {
    let adheres = |c: &Column| if c.force.is_adhesion() { 1.0 } else { 0.0 };
    let solved = least_cost(loads, all, Conditioning::Full, &mut Effort::default(), adheres);
    let y: Vec<Double> = solved.y.iter().map(|v| Double::from(*v)).collect();
    let size = y.iter().fold(0.0, |m: f64, v| m.max(v.abs().near()));
    let violation = all.iter().map(|c| product(&entries(c), &y).near()).fold(0.0, f64::max);
    let power = power(loads, &y).near();
    let largest = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    solved.status == Status::Unbounded
        && power / largest > MIN_POWER_OVER_VIOLATION * violation
        && power > MIN_POWER * size
}

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
fn largest_of_unique(program: &Program, columns: &[Column], optimum: &Optimum) -> Option<f64> {
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
