//! Writes the optimisation problems of a program as matrices, in the form that the solvers accept.
//!
//! [`QuadraticProgram`]: minimise ½ xᵀPx + qᵀx subject to Ax = b in the first `equalities` rows and Ax ≤ b in the
//! others.
//!
//! Most problems are built in their dual, the kinematic form: the unknowns are the velocities of the bodies, and the
//! forces are the multipliers of the rows. This form has three unknowns per body; the static form has six per edge
//! contact.
//! Reference: Livesley, Limit analysis of structures formed from rigid blocks, 1978, for the pair of linear programs.

use super::{Column, Force};

/// A convex quadratic program with equalities and inequalities; matrices are lists of (row, column, value).
#[derive(Clone, Debug)]
pub struct QuadraticProgram {
    /// Number of unknowns x.
    pub unknowns: usize,
    /// Upper triangle of the symmetric matrix P; empty for a linear program.
    pub quadratic: Vec<(usize, usize, f64)>,
    /// The linear objective q.
    pub linear: Vec<f64>,
    /// The constraint matrix A.
    pub matrix: Vec<(usize, usize, f64)>,
    /// The right-hand sides b.
    pub bound: Vec<f64>,
    /// The number of equalities, which are the first rows.
    pub equalities: usize,
}

impl QuadraticProgram {
    /// Appends a constraint whose coefficients are those of `column` and whose right-hand side is `bound`. The position
    /// of the row decides whether it is = or ≤.
    fn push_column_row(&mut self, column: &Column, bound: f64) {
        let row = self.bound.len();
        self.matrix.extend(column.entries().map(|(i, v)| (row, i, v)));
        self.bound.push(bound);
    }
}

/// Returns the dual of "minimise the cost of forces that balance `loads`", with velocities y as unknowns: max loadsᵀy
/// s.t. columnᵀy ≤ cost.
///
/// There are three unknowns y per body and one row per column. A column with a limit gets one more unknown w ≥ 0, with
/// columnᵀy − w ≤ cost and −limit·w in the objective. The two directions of a grip component without limit, whose costs
/// are opposite or 0, become one equality, because a pair of opposite inequalities has no interior.
///
/// Returns the problem and the row of each column: the multiplier of that row is the amount of the force. The
/// multiplier of an equality is the amount of the first direction minus that of the second. The second direction has no
/// row: `usize::MAX` is returned for it.
fn kinematic_dual(loads: &[f64], columns: &[Column], cost: impl Fn(&Column) -> f64) -> (QuadraticProgram, Vec<usize>) {
    let mut dual = QuadraticProgram {
        unknowns: loads.len(),
        quadratic: Vec::new(),
        linear: loads.iter().map(|v| -v).collect(),
        matrix: Vec::with_capacity(columns.len() * 6),
        bound: Vec::with_capacity(columns.len()),
        equalities: 0,
    };
    let mut row_of = vec![usize::MAX; columns.len()];
    let is_free_pair = |k: usize| {
        is_first_of_grip_pair(columns, k)
            && columns[k].limit.is_infinite()
            && cost(&columns[k]) == -cost(&columns[k + 1])
    };
    // First add the equalities: one for each pair of opposite columns without limit and with opposite costs.
    let mut k = 0;
    while k < columns.len() {
        if is_free_pair(k) {
            row_of[k] = dual.bound.len();
            dual.push_column_row(&columns[k], cost(&columns[k]));
            k += 1;
        }
        k += 1;
    }
    dual.equalities = dual.bound.len();
    // Then add an inequality for each of the other columns.
    let mut k = 0;
    while k < columns.len() {
        if row_of[k] != usize::MAX {
            k += 2;
            continue;
        }
        row_of[k] = dual.bound.len();
        dual.push_column_row(&columns[k], cost(&columns[k]));
        k += 1;
    }
    // Finally add an unknown w for each limit, with the constraint w ≥ 0.
    for (k, column) in columns.iter().enumerate() {
        if column.limit.is_finite() {
            let w = dual.unknowns;
            dual.unknowns += 1;
            dual.linear.push(column.limit);
            dual.matrix.push((row_of[k], w, -1.0));
            dual.matrix.push((dual.bound.len(), w, -1.0));
            dual.bound.push(0.0);
        }
    }
    (dual, row_of)
}

/// True if the columns k and k + 1 are the positive and the negative direction of the same grip component.
fn is_first_of_grip_pair(columns: &[Column], k: usize) -> bool {
    let next = columns.get(k + 1).map(|column| column.force);
    match columns[k].force {
        Force::Grip { grip, component, sign } if sign > 0.0 => {
            next == Some(Force::Grip { grip, component, sign: -1.0 })
        }
        _ => false,
    }
}

/// Which load factor λ is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// The largest λ ≥ 0.
    Largest,
    /// The λ nearest to 0, positive or negative.
    Nearest,
}

/// What is sought among the forces that balance the loads.
pub enum Aim<'a> {
    /// The forces of least cost. The function returns the cost of one unit of a column.
    Least(&'a dyn Fn(&Column) -> f64),
    /// A λ with which forces balance loads + λ·direction. The number is the largest power of the direction along the
    /// velocities.
    Factor(Factor, &'a [f64], f64),
    /// The forces with the least Σ |residual of the equilibrium equations|.
    Residual,
}

/// Returns the kinematic form of a program of forces, and the row of each column. The second direction of a grip component
/// without limit shares the row of the first and has the row `usize::MAX`.
///
/// Without costs, the dual is max loadsᵀy s.t. columnᵀy ≤ 0. Each aim adds rows at the end:
///
/// - largest λ: directionᵀy ≥ power; λ is the multiplier of this row;
/// - nearest λ: directionᵀy ≥ −power and directionᵀy ≤ power; λ is the multiplier of the first row minus that of the
///   second;
/// - least residual: −1 ≤ y ≤ 1. This dual always has an optimum. −y is the motion in which the loads have the largest
///   power.
pub fn kinematic_form(loads: &[f64], columns: &[Column], aim: &Aim) -> (QuadraticProgram, Vec<usize>) {
    let (mut problem, row_of) = match aim {
        Aim::Least(cost) => kinematic_dual(loads, columns, cost),
        _ => kinematic_dual(loads, columns, |_| 0.0),
    };
    let mut add = |sign: f64, row: &mut dyn Iterator<Item = (usize, f64)>, bound: f64| {
        let number = problem.bound.len();
        problem.matrix.extend(row.filter(|(_, v)| *v != 0.0).map(|(i, v)| (number, i, sign * v)));
        problem.bound.push(bound);
    };
    match aim {
        Aim::Least(_) => {}
        Aim::Factor(factor, direction, power) => {
            let rows: &[(f64, f64)] = match factor {
                Factor::Largest => &[(-1.0, -power)],
                Factor::Nearest => &[(-1.0, *power), (1.0, *power)],
            };
            for (sign, bound) in rows {
                add(*sign, &mut direction.iter().copied().enumerate(), *bound);
            }
        }
        Aim::Residual => {
            for row in 0..loads.len() {
                for sign in [1.0, -1.0] {
                    add(sign, &mut [(row, 1.0)].into_iter(), 1.0);
                }
            }
        }
    }
    (problem, row_of)
}

/// Returns the problem of the least change d of given velocities: min ½ |d|² s.t. columnᵀd = value for the first
/// `equalities` columns, and columnᵀd ≥ value for the other columns.
pub fn least_change(unknowns: usize, columns: &[(&Column, f64)], equalities: usize) -> QuadraticProgram {
    let mut problem = QuadraticProgram {
        unknowns,
        quadratic: (0..unknowns).map(|i| (i, i, 1.0)).collect(),
        linear: vec![0.0; unknowns],
        matrix: Vec::with_capacity(6 * columns.len()),
        bound: Vec::with_capacity(columns.len()),
        equalities,
    };
    for (row, (column, value)) in columns.iter().enumerate() {
        // The solver's inequalities are Ax ≤ b, so the signs of columnᵀd ≥ value are reversed.
        let sign = if row < equalities { 1.0 } else { -1.0 };
        let entries = column.entries();
        problem.matrix.extend(entries.map(|(i, v)| (row, i, sign * v)));
        problem.bound.push(sign * value);
    }
    problem
}

/// Returns the problem of balancing `loads` with the least Σ amount². The amounts may be positive or negative.
pub fn least_norm(loads: &[f64], columns: &[Column]) -> QuadraticProgram {
    let entries = columns.iter().enumerate();
    QuadraticProgram {
        unknowns: columns.len(),
        quadratic: (0..columns.len()).map(|i| (i, i, 1.0)).collect(),
        linear: vec![0.0; columns.len()],
        matrix: entries.flat_map(|(j, column)| column.entries().map(move |(row, value)| (row, j, value))).collect(),
        bound: loads.to_vec(),
        equalities: loads.len(),
    }
}

/// Given amounts that a least-squares problem corrects: the result is amount + `size` · unknown.
#[derive(Clone, Copy, Debug)]
pub struct Correction<'a> {
    /// The given amounts.
    pub amounts: &'a [f64],
    /// The change of an amount per unit of its unknown.
    pub size: f64,
    /// The largest change towards 0 or towards a limit, in units of `size`. With bounds of 10⁸ times the residual, which
    /// no change reaches, the solver would end without a result.
    pub largest: f64,
}

/// Returns the problem of balancing `loads` with the least sum of squared forces. Every amount must be at least 0 and
/// at most the limit of its column.
///
/// Without a `correction`, the squares are those of N1, N2 and T at each contact, and of F_x, F_y and M/L at each grip.
/// The result therefore does not depend on how the friction cone is divided into columns.
///
/// With a `correction`, the unknowns are changes of given amounts, and the sum is over the squared change of each
/// column. Here `loads` are the part of the loads that the given amounts do not balance. With squares of forces,
/// opposite columns, such as the two directions of a robot's force, could grow together without bound, and the solver
/// would end without a result.
pub fn least_squares(loads: &[f64], columns: &[Column], correction: Option<Correction>) -> QuadraticProgram {
    let mut quadratic = Vec::new();
    if correction.is_some() {
        quadratic.extend((0..columns.len()).map(|j| (j, j, 1.0)));
    }
    // The columns of one contact or grip are consecutive. The inner loop therefore stops at the first column of another
    // contact or grip.
    let squared = if correction.is_some() { &[] } else { columns };
    for (j, column) in squared.iter().enumerate() {
        for (i, other) in columns[..=j].iter().enumerate().rev() {
            match product(&other.force, &column.force) {
                Some(0.0) => {}
                Some(value) => quadratic.push((i, j, value)),
                None => break,
            }
        }
    }
    let rows = loads.len();
    let mut matrix = Vec::with_capacity(columns.len() * 7);
    let mut bound = loads.to_vec();
    for (j, column) in columns.iter().enumerate() {
        matrix.extend(column.entries().map(|(row, value)| (row, j, value)));
        let room = |amount: f64| correction.map_or(amount, |c| (amount / c.size).min(c.largest));
        let amount = correction.map_or(0.0, |c| c.amounts[j]);
        matrix.push((bound.len(), j, -1.0));
        bound.push(room(amount));
        if column.limit.is_finite() {
            matrix.push((bound.len(), j, 1.0));
            bound.push(room(column.limit - amount));
        }
    }
    QuadraticProgram {
        unknowns: columns.len(),
        quadratic,
        linear: vec![0.0; columns.len()],
        matrix,
        bound,
        equalities: rows,
    }
}

/// A second cost for each column, and the largest allowed value of Σ cost·amount.
pub type CostCap<'a> = (&'a dyn Fn(&Column) -> f64, f64);

/// Returns the primal problem, in which the forces are the unknowns: min Σ cost·amount s.t. Σ amount·column = `loads`,
/// 0 ≤ amount ≤ limit.
///
/// A [`CostCap`] (cost, max) adds the constraint Σ cost·amount ≤ max, for the second stage of a lexicographic
/// optimisation. If the structure is close to its limit, this form takes fewer iterations than the kinematic dual.
pub fn force_primal(
    loads: &[f64],
    columns: &[Column],
    cost: impl Fn(&Column) -> f64,
    cap: Option<CostCap>,
) -> QuadraticProgram {
    let mut problem = least_squares(loads, columns, None);
    problem.quadratic.clear();
    problem.linear = columns.iter().map(cost).collect();
    if let Some((cost, most)) = cap {
        let row = problem.bound.len();
        let entries = columns.iter().enumerate().map(|(j, c)| (row, j, cost(c)));
        problem.matrix.extend(entries.filter(|e| e.2 != 0.0));
        problem.bound.push(most);
    }
    problem
}

/// Returns the inner product of two forces of amount 1, in the components (N1, N2, T) of a contact or (F_x, F_y, M/L)
/// of a grip.
///
/// `None` if the forces belong to different contacts or grips, or if only one of them is adhesion.
pub(super) fn product(a: &Force, b: &Force) -> Option<f64> {
    let ((place, u), (other, v)) = (components(a), components(b));
    (place == other).then(|| u[0] * v[0] + u[1] * v[1] + u[2] * v[2])
}

/// The contact or grip at which a force acts. Adhesion has separate variants.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Site {
    Contact(usize),
    Grip(usize),
    /// Adhesion of a contact.
    ContactAdhesion(usize),
    /// Adhesion of a grip: its force regardless of its limits.
    GripAdhesion(usize),
}

/// Returns the site at which a force of amount 1 acts, and the components of the force: (N1, N2, T) at a contact,
/// (F_x, F_y, M/L) at a grip. The adhesion of a contact or grip has a site of its own.
fn components(force: &Force) -> (Site, [f64; 3]) {
    let mut own = [0.0; 3];
    let site = match *force {
        Force::Ray { contact, point, normal, friction } => {
            own[point] = normal;
            own[2] = friction;
            Site::Contact(contact)
        }
        Force::Grip { grip, component, sign } => {
            own[component] = sign;
            Site::Grip(grip)
        }
        Force::AdhesionNormal { contact, point } => {
            own[point] = 1.0;
            Site::ContactAdhesion(contact)
        }
        Force::AdhesionFriction { contact, sign } => {
            own[2] = sign;
            Site::ContactAdhesion(contact)
        }
        Force::AdhesionGrip { grip, component, sign } => {
            own[component] = sign;
            Site::GripAdhesion(grip)
        }
    };
    (site, own)
}
