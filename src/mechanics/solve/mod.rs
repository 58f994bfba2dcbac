//! Solving a program: least force where it stands, least sticking where it falls, one unique set of forces to draw.
//!
//! Makes [`Balance`] and [`Stuck`] in the program's pure numbers. Neither is a verdict: the forces and the motion go to
//! [`crate::proof`], which decides. `conic` alone names the solvers.
//!
//! Among several optima the one of least Σ force² is drawn. It is found on the face of optima: an interior-point answer
//! is strictly complementary, so a column belongs to the face exactly where its amount outweighs its slack.

mod balance;
mod conic;
mod correction;
mod determinate;
mod exact;
mod factor;
mod limit;
mod nearest;
mod normal;
#[cfg(test)]
mod numbers;
mod polish;
pub(crate) mod ray;
mod refine;
mod residual;
mod slanted;
mod stick;
mod tangent;
mod wedge;

pub use balance::{Balance, balance, balance_at_first_look, balance_in};
pub(crate) use conic::DeadlineGuard;
pub use conic::{
    Answer, Choice, Conditioning, CrossoverTolerance, ITERATIONS, SolverSettings, Status,
    TOLERANCE, by_clarabel, solve, solve_within,
};
pub use determinate::{collapse, determinate};
pub use limit::{Extreme, Limit, least, most, nearest_factor};
pub use nearest::{BoundedNnls, generators};
pub use polish::polished;
pub use refine::{corrected, relative};
pub use residual::{Residual, any_balance, least_residual};
pub use stick::{Stuck, stick, stick_in};
pub use tangent::Tangent;
pub use wedge::{RuledOut, SelfStress, SelfStressCheck, Slide, reach};

use crate::geometry::{Vector, cross, quarter_turn};
use crate::program::{
    Column, Force, Program, QuadraticProgram, force_primal, kinematic_dual, least_squares,
};
use correction::{refined, settled};

/// Amounts of the forces of a program, pure numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Amounts {
    /// Per contact: normal forces at the two application points. Of sticking: pulls.
    pub normal: Vec<[f64; 2]>,
    /// Per contact: friction along (−n_y, n_x).
    pub friction: Vec<f64>,
    /// Per grip: force x, force y, torque/L.
    pub grip: Vec<[f64; 3]>,
}

impl Amounts {
    /// No force anywhere.
    pub fn none(program: &Program) -> Amounts {
        Amounts {
            normal: vec![[0.0; 2]; program.contacts.len()],
            friction: vec![0.0; program.contacts.len()],
            grip: vec![[0.0; 3]; program.grips.len()],
        }
    }

    /// Σ (N1 + N2 + |T|) + Σ (|Fx| + |Fy| + |M|/L), the source's cost.
    pub fn total(&self) -> f64 {
        let contacts: f64 = self
            .normal
            .iter()
            .flatten()
            .chain(&self.friction)
            .map(|v| v.abs())
            .sum();
        contacts + self.grip.iter().flatten().map(|v| v.abs()).sum::<f64>()
    }

    /// Worst of what the forces leave unbalanced of a program's loads, pure numbers.
    pub fn unbalanced(&self, program: &Program) -> f64 {
        let mut rest = program.loads.clone();
        let mut act = |block: usize, force: Vector, moment: f64| {
            for (row, value) in [force.x, force.y, moment].into_iter().enumerate() {
                rest[3 * block + row] -= value;
            }
        };
        for (k, contact) in program.contacts.iter().enumerate() {
            let (normal, tangent) = (contact.normal, quarter_turn(contact.normal));
            let [first, second] = self.normal[k].map(|amount| normal * amount);
            let first = first + tangent * self.friction[k];
            let both = [(contact.on, 1.0)].into_iter();
            for ((block, arms), sign) in both.chain(contact.from.map(|from| (from, -1.0))) {
                let moment = cross(arms[0], first) + cross(arms[1], second);
                act(block, (first + second) * sign, moment * sign);
            }
        }
        for (grip, [x, y, moment]) in program.grips.iter().zip(&self.grip) {
            let force = Vector::new(*x, *y);
            act(grip.block, force, cross(grip.arm, force) + moment);
        }
        largest(&rest)
    }

    /// Multiplies every amount.
    fn multiply(&mut self, by: f64) {
        let friction = self.friction.iter_mut();
        let (normal, grip) = (self.normal.iter_mut(), self.grip.iter_mut());
        let pairs = normal.flatten().chain(friction);
        pairs.chain(grip.flatten()).for_each(|v| *v *= by);
    }

    /// Adds `amount` of a force.
    pub fn add(&mut self, force: Force, amount: f64) {
        match force {
            Force::Ray {
                contact,
                point,
                normal,
                friction,
            } => {
                self.normal[contact][point] += normal * amount;
                self.friction[contact] += friction * amount;
            }
            Force::StickNormal { contact, point } => self.normal[contact][point] += amount,
            Force::StickFriction { contact, sign } => self.friction[contact] += sign * amount,
            Force::Grip {
                grip,
                component,
                sign,
            }
            | Force::StickGrip {
                grip,
                component,
                sign,
            } => {
                self.grip[grip][component] += sign * amount;
            }
        }
    }
}

/// How much work something took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Interior-point iterations.
    pub iterations: usize,
    /// Programs handed to the solver.
    pub programs: usize,
}

impl Effort {
    /// The sum of two efforts.
    pub fn and(self, other: Effort) -> Effort {
        Effort {
            iterations: self.iterations + other.iterations,
            programs: self.programs + other.programs,
        }
    }
}

/// A solved kinematic dual.
#[derive(Clone, Debug)]
pub struct Dual {
    /// How it ended; `Unbounded` means that `y` is a motion nothing stops.
    pub status: Status,
    /// The virtual velocities against which loads work.
    pub y: Vec<f64>,
    /// Amount of each column.
    pub amounts: Vec<f64>,
    /// Slack of each column: by how much it is too dear to be used.
    pub slack: Vec<f64>,
    /// What one more unit of each column's limit would save.
    pub multipliers: Vec<f64>,
    /// The least cost, as the dual knows it.
    pub objective: f64,
}

impl Dual {
    /// Whether each column belongs to the face of optima: its slack is at most `margin` times its amount.
    pub fn active(&self, margin: f64) -> Vec<bool> {
        self.amounts
            .iter()
            .zip(&self.slack)
            .map(|(amount, slack)| margin * amount > *slack)
            .collect()
    }
}

/// A face of optima: the columns that may still be chosen, and those that every optimum uses to their limit.
#[derive(Clone)]
struct Face {
    /// What the columns must give, beside what the full ones do.
    loads: Vec<f64>,
    columns: Vec<Column>,
    amounts: Vec<f64>,
    full: Vec<Column>,
}

impl Face {
    fn whole(loads: &[f64], columns: Vec<Column>) -> Face {
        let amounts = vec![0.0; columns.len()];
        Face {
            loads: loads.to_vec(),
            columns,
            amounts,
            full: Vec::new(),
        }
    }

    /// The same columns with other amounts.
    fn with(self, amounts: Vec<f64>) -> Face {
        Face { amounts, ..self }
    }

    /// The face's part on which the optima of a solved dual of it lie.
    ///
    /// A limited column whose bound has a multiplier above what it leaves unused is full; only then is every balance on
    /// the face an optimum.
    fn narrowed(&self, solved: &Dual, margin: f64) -> Face {
        let mut face = Face {
            columns: Vec::new(),
            amounts: Vec::new(),
            ..self.clone()
        };
        let active = solved.active(margin);
        for (k, column) in self.columns.iter().enumerate() {
            let amount = solved.amounts[k];
            if column.limit.is_finite() && solved.multipliers[k] > column.limit - amount {
                column.add_to(&mut face.loads, -column.limit);
                face.full.push(*column);
            } else if active[k] {
                face.columns.push(*column);
                face.amounts.push(amount);
            }
        }
        face
    }

    /// The face with the columns of which `keep` holds.
    fn only(&self, keep: impl Fn(&Column, f64) -> bool) -> Face {
        let mut face = Face {
            columns: Vec::new(),
            amounts: Vec::new(),
            ..self.clone()
        };
        for (column, amount) in self.columns.iter().zip(&self.amounts) {
            if keep(column, *amount) {
                face.columns.push(*column);
                face.amounts.push(*amount);
            }
        }
        face
    }

    /// What the amounts cost, those of the full columns included.
    fn cost(&self, amounts: &[f64]) -> f64 {
        let chosen: f64 = self
            .columns
            .iter()
            .zip(amounts)
            .map(|(c, a)| c.cost * a)
            .sum();
        chosen + self.full.iter().map(|c| c.cost * c.limit).sum::<f64>()
    }

    /// The admissible and the sticking forces.
    fn gathered(&self, program: &Program) -> (Amounts, Amounts) {
        let (mut admissible, mut sticking) = (Amounts::none(program), Amounts::none(program));
        let chosen = self.columns.iter().zip(self.amounts.iter().copied());
        let full = self.full.iter().map(|c| (c, c.limit));
        for (column, amount) in chosen.chain(full) {
            let to = if column.force.is_sticking() {
                &mut sticking
            } else {
                &mut admissible
            };
            to.add(column.force, amount);
        }
        (admissible, sticking)
    }
}

/// Solves the kinematic dual of some columns, again with full conditioning where the quick way ends without a status.
pub fn dual(
    loads: &[f64],
    columns: &[Column],
    settings: impl Into<SolverSettings>,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Dual {
    let (conic, row_of) = kinematic_dual(loads, columns, cost);
    let answer = solved_with_retry(&conic, settings, effort);
    of_velocities(loads, columns, &conic, &row_of, &answer)
}

/// The optimum of a kinematic form, in terms of columns.
fn of_velocities(
    loads: &[f64],
    columns: &[Column],
    conic: &QuadraticProgram,
    row_of: &[usize],
    answer: &Answer,
) -> Dual {
    let n = columns.len();
    let mut solved = Dual {
        status: answer.status,
        y: vec![0.0; loads.len()],
        amounts: vec![0.0; n],
        slack: vec![0.0; n],
        multipliers: vec![0.0; n],
        objective: 0.0,
    };
    if answer.x.is_empty() {
        return solved;
    }
    for (k, row) in row_of.iter().enumerate() {
        if *row == usize::MAX {
            // The second of a pair posed as one equality: both are active, whatever they carry.
            solved.amounts[k] = f64::max(f64::MIN_POSITIVE, -answer.z[row_of[k - 1]]);
        } else if *row < conic.equalities {
            solved.amounts[k] = f64::max(f64::MIN_POSITIVE, answer.z[*row]);
        } else {
            solved.amounts[k] = answer.z[*row].max(0.0);
            solved.slack[k] = answer.s[*row];
        }
    }
    solved.y.copy_from_slice(&answer.x[..loads.len()]);
    // Limited columns own the unknowns after the velocities, in their order.
    let limited = (0..n).filter(|k| columns[*k].limit.is_finite());
    for (k, multiplier) in limited.zip(&answer.x[loads.len()..]) {
        solved.multipliers[k] = multiplier.max(0.0);
    }
    solved.objective = -conic
        .linear
        .iter()
        .zip(&answer.x)
        .map(|(q, x)| q * x)
        .sum::<f64>();
    solved
}

/// Solves the same program with the forces themselves as unknowns.
///
/// Its rows are the balance, its multipliers the velocities. Near the edge of standing it takes about half the iterations
/// of the kinematic form, of which each is a third dearer, and tells less sharply which columns belong to the optimum.
fn in_forces(
    loads: &[f64],
    columns: &[Column],
    settings: impl Into<SolverSettings>,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Dual {
    let conic = force_primal(loads, columns, cost, None);
    let answer = once(&conic, settings.into(), effort);
    let n = columns.len();
    let mut solved = Dual {
        // No forces balance exactly where nothing bounds the velocities.
        status: match answer.status {
            Status::Infeasible => Status::Unbounded,
            Status::Unbounded => Status::Infeasible,
            other => other,
        },
        y: vec![0.0; loads.len()],
        amounts: vec![0.0; n],
        slack: vec![0.0; n],
        multipliers: vec![0.0; n],
        objective: 0.0,
    };
    if answer.x.is_empty() {
        return solved;
    }
    for (y, multiplier) in solved.y.iter_mut().zip(&answer.z) {
        *y = -multiplier;
    }
    // A column's row of x ≥ 0 is followed by that of its limit, if it has one.
    let mut row = loads.len();
    for (k, column) in columns.iter().enumerate() {
        solved.amounts[k] = answer.x[k].max(0.0);
        solved.slack[k] = answer.z[row];
        row += 1;
        if column.limit.is_finite() {
            solved.multipliers[k] = answer.z[row].max(0.0);
            row += 1;
        }
    }
    let costs = conic.linear.iter().zip(&answer.x).map(|(q, x)| q * x);
    solved.objective = costs.sum();
    solved
}

/// Solves, and solves again with full conditioning where the quick way ends without a status.
fn solved_with_retry(
    conic: &QuadraticProgram,
    settings: impl Into<SolverSettings>,
    effort: &mut Effort,
) -> Answer {
    let settings = settings.into();
    let answer = once(conic, settings, effort);
    if answer.status == Status::Unsolved && settings.conditioning == Conditioning::Plain {
        let full = SolverSettings {
            conditioning: Conditioning::Full,
            ..settings
        };
        return once(conic, full, effort);
    }
    answer
}

/// Solves in one way only.
fn once(conic: &QuadraticProgram, settings: SolverSettings, effort: &mut Effort) -> Answer {
    once_within(conic, settings, ITERATIONS, effort)
}

/// Solves in one way only, in a given number of iterations.
fn once_within(
    conic: &QuadraticProgram,
    settings: SolverSettings,
    iterations: usize,
    effort: &mut Effort,
) -> Answer {
    let answer = solve_within(conic, settings, iterations);
    *effort = effort.and(Effort {
        iterations: answer.iterations,
        programs: 1,
    });
    answer
}

/// The amounts of least Σ force² on given columns, if there are such.
///
/// Where the balance leaves no choice they come from elimination, exact to rounding; else from a quadratic program.
fn least_squares_amounts(
    loads: &[f64],
    columns: &[Column],
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Vec<f64>> {
    if columns.is_empty() {
        return Some(Vec::new());
    }
    if let Some(amounts) = exact::only(loads, columns).or_else(|| exact::least(loads, columns)) {
        return Some(amounts);
    }
    let answer = solved_with_retry(&least_squares(loads, columns, None), settings, effort);
    (answer.status == Status::Solved).then(|| answer.x.iter().map(|v| v.max(0.0)).collect())
}

fn remainder(loads: &[f64], columns: &[Column], amounts: &[f64]) -> Vec<f64> {
    let mut rest: Vec<f64> = loads.to_vec();
    for (column, amount) in columns.iter().zip(amounts) {
        column.add_to(&mut rest, -amount);
    }
    rest
}

fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}
