//! [`Method`]: the solution methods that the study compares, and [`Outcome`]: their results. The measured time of a
//! method includes setting up its linear program.

use super::Task;
use super::vallat::vallat_program;
use drystone::analysis::{Accuracy, Analysis, Options, Proof, Verdict};
use drystone::internals::program::{Column, Program, Scale, adhesion_columns, columns, force_primal};
use drystone::internals::solve::{
    Amounts, Choice, Conditioning, Effort, SolverSettings, Status, balance_in, least_adhesion_in, least_cost, solve,
};

/// An adhesion up to this fraction of the largest adhesion is a rounding error of the solver and not a failure.
const MIN_FAILURE_SHARE: f64 = 1e-6;

/// A solution method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The program of the source publication, which allows adhesion. The value is the exponent of the penalty β: one
    /// newton of adhesion costs as much as 10^exponent newtons of force.
    Source(u8),
    /// The program without adhesion, whose unknowns are forces. If it has no solution, the lexicographic programs with
    /// adhesion: first the least adhesion, then the least force with this adhesion.
    ForceForm,
    /// Only the kinematic dual programs. Their unknowns are velocities.
    Kinematic,
    /// The kinematic dual program, then the unique forces on its optimal face: the optimal forces with the least sum of
    /// squares.
    Unique,
    /// The complete analysis of the command `check` at an accuracy level, with proofs and repeated solutions.
    Level(Accuracy),
}

impl Method {
    /// All methods, in the order of the table.
    pub const ALL: [Method; 9] = [
        Method::Source(2),
        Method::Source(4),
        Method::Source(6),
        Method::Source(8),
        Method::ForceForm,
        Method::Kinematic,
        Method::Unique,
        Method::Level(Accuracy::Standard),
        Method::Level(Accuracy::Proved),
    ];

    /// Returns the name of the method for tables.
    pub fn name(self) -> &'static str {
        match self {
            Method::Source(2) => "source, β = 10²",
            Method::Source(4) => "source, β = 10⁴",
            Method::Source(6) => "source, β = 10⁶",
            Method::Source(_) => "source, β = 10⁸",
            Method::ForceForm => "hard, then lexicographic",
            Method::Kinematic => "kinematic",
            Method::Unique => "kinematic, unique forces",
            Method::Level(Accuracy::Standard) => "standard",
            Method::Level(_) => "proved",
        }
    }

    /// Solves a frame with this method. `tolerance` is the tolerance of the solver.
    pub fn solve(self, task: &Task<'_>, tolerance: f64) -> Outcome {
        if let Method::Level(accuracy) = self {
            return level(task, accuracy, tolerance);
        }
        let mut whole = Outcome::empty();
        for program in &task.programs {
            let one = match self {
                Method::Source(exponent) => as_posed(program, libm::exp10(f64::from(exponent)), tolerance),
                Method::ForceForm => force(program, tolerance),
                Method::Kinematic => kinematic(program, tolerance),
                _ => unique(program, tolerance),
            };
            whole = whole.and(one.in_newtons(program.scale));
        }
        whole
    }
}

/// Returns the adhesion above which an independent part of a frame counts as falling, in the scaled units of its
/// program. Relative to the heaviest load, it is the tolerance of the proofs or ten times the tolerance of the solver,
/// whichever is larger.
fn min_counted_adhesion(tolerance: f64) -> f64 {
    Scale::HEAVIEST * Proof::IMBALANCE_TOL.max(10.0 * tolerance)
}

fn effort(iterations: usize) -> Effort {
    Effort { iterations, programs: 1 }
}

/// Returns the largest component of the unbalanced loads, if the columns have these amounts.
fn imbalance(loads: &[f64], columns: &[Column], amounts: &[f64]) -> f64 {
    let mut rest = loads.to_vec();
    for (column, amount) in columns.iter().zip(amounts) {
        column.add_to(&mut rest, -amount);
    }
    rest.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

/// Solves the program of the source publication, with the cost `beta` per unit of adhesion. The verdict is stable if
/// the adhesion of the solution is at most [`min_counted_adhesion`].
fn as_posed(program: &Program, beta: f64, tolerance: f64) -> Outcome {
    let conic = vallat_program(program, beta);
    let answer = solve(&conic, tolerance, Conditioning::Full);
    let effort = effort(answer.iterations);
    match answer.status {
        Status::Infeasible => return Outcome::falls(None, 0, effort),
        Status::Solved => {}
        _ => return Outcome::undecided(effort),
    }
    let n = conic.unknowns / 2;
    let adhesion: f64 = answer.x[n..].iter().map(|v| v.max(0.0)).sum();
    if adhesion > min_counted_adhesion(tolerance) {
        let most = answer.x[n..].iter().fold(0.0, |m: f64, v| m.max(*v));
        let points = answer.x[n..].iter().filter(|v| **v > MIN_FAILURE_SHARE * most).count();
        return Outcome::falls(Some(adhesion), points, effort);
    }
    let mut amounts = Amounts::zero(program);
    let mut next = 0;
    for (k, contact) in program.contacts.iter().enumerate() {
        for point in 0..contact.points {
            amounts.normal[k][point] = answer.x[next];
            amounts.friction[k] += answer.x[next + 1] - answer.x[next + 2];
            next += 3;
        }
    }
    for grip in &mut amounts.grip {
        for component in grip {
            *component = answer.x[next] - answer.x[next + 1];
            next += 2;
        }
    }
    let mut rest = conic.bound[..conic.equalities].to_vec();
    // Compute the imbalance without the adhesion, because the forces alone must balance the loads.
    for (row, column, value) in &conic.matrix {
        if *row < conic.equalities && *column < n {
            rest[*row] -= value * answer.x[*column];
        }
    }
    let off = rest.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let sum = answer.x[..n].iter().sum();
    Outcome { total: Some(sum), ..Outcome::stands(&amounts, off, effort) }
}

fn adhesion_cost(column: &Column) -> f64 {
    f64::from(u8::from(column.force.is_adhesion()))
}

/// Solves primal programs, whose unknowns are forces, without a penalty. The first program has no adhesion. If it has
/// no solution, the second program finds the least adhesion, and the third the least force with this adhesion.
fn force(program: &Program, tolerance: f64) -> Outcome {
    let loads = &program.loads;
    let admissible = columns(program);
    let cost = |c: &Column| c.cost;
    let hard = solve(&force_primal(loads, &admissible, cost, None), tolerance, Conditioning::Full);
    let mut iterations = hard.iterations;
    if hard.status == Status::Solved {
        return standing(program, &admissible, &hard.x, effort(iterations));
    }
    let mut all = admissible;
    all.extend(adhesion_columns(program));
    let first = solve(&force_primal(loads, &all, adhesion_cost, None), tolerance, Conditioning::Full);
    iterations += first.iterations;
    let certain = hard.status == Status::Infeasible;
    match first.status {
        Status::Solved => {}
        Status::Infeasible => return Outcome::falls(None, 0, effort(iterations)),
        _ if certain => return Outcome::falls(None, 0, effort(iterations)),
        _ => return Outcome::undecided(effort(iterations)),
    }
    let sum = |x: &[f64]| -> f64 { all.iter().zip(x).map(|(c, x)| adhesion_cost(c) * x).sum() };
    let least = sum(&first.x);
    let most = least * (1.0 + tolerance) + tolerance;
    let second = solve(&force_primal(loads, &all, cost, Some((&adhesion_cost, most))), tolerance, Conditioning::Full);
    iterations += second.iterations;
    let x = if second.status == Status::Solved { &second.x } else { &first.x };
    if !certain && least <= min_counted_adhesion(tolerance) {
        return standing(program, &all, x, effort(iterations));
    }
    let adheres = || all.iter().zip(x).filter(|(c, _)| c.force.is_adhesion());
    let largest = adheres().map(|(_, x)| *x).fold(0.0, f64::max);
    let points = adheres().filter(|(_, x)| **x > MIN_FAILURE_SHARE * largest).count();
    Outcome::falls(Some(least), points, effort(iterations))
}

/// Returns the outcome for a balance with the amounts `x` of the columns. Adhesion is set to 0, so the imbalance
/// includes the forces that it would contribute.
fn standing(program: &Program, columns: &[Column], x: &[f64], effort: Effort) -> Outcome {
    let mut amounts = Amounts::zero(program);
    let mut own = Vec::with_capacity(columns.len());
    for (column, x) in columns.iter().zip(x) {
        let x = if column.force.is_adhesion() { 0.0 } else { *x };
        own.push(x);
        amounts.add(column.force, x);
    }
    Outcome::stands(&amounts, imbalance(&program.loads, columns, &own), effort)
}

fn settings(tolerance: f64, choice: Choice) -> SolverSettings {
    SolverSettings { tolerance, choice, ..Conditioning::Plain.into() }
}

/// Solves dual programs, whose unknowns are velocities. The first program has no adhesion. If it has no solution, a
/// second program finds the least adhesion.
fn kinematic(program: &Program, tolerance: f64) -> Outcome {
    let settings = settings(tolerance, Choice::Any);
    let mut effort = Effort::default();
    let admissible = columns(program);
    let hard = least_cost(&program.loads, &admissible, settings, &mut effort, |c| c.cost);
    if hard.status == Status::Solved {
        return standing(program, &admissible, &hard.amounts, effort);
    }
    let mut all = admissible;
    all.extend(adhesion_columns(program));
    let soft = least_cost(&program.loads, &all, settings, &mut effort, adhesion_cost);
    let adheres = || all.iter().zip(&soft.amounts).filter(|(c, _)| c.force.is_adhesion());
    let least: f64 = adheres().map(|(_, x)| *x).sum();
    let certain = hard.status == Status::Unbounded;
    match soft.status {
        Status::Solved if !certain && least <= min_counted_adhesion(tolerance) => {
            standing(program, &all, &soft.amounts, effort)
        }
        Status::Solved => {
            let largest = adheres().map(|(_, x)| *x).fold(0.0, f64::max);
            let points = adheres().filter(|(_, x)| **x > MIN_FAILURE_SHARE * largest).count();
            Outcome::falls(Some(least), points, effort)
        }
        Status::Unbounded => Outcome::falls(None, 0, effort),
        _ if certain => Outcome::falls(None, 0, effort),
        _ => Outcome::undecided(effort),
    }
}

/// Solves the dual program, and then computes the unique forces on its optimal face. If the program has no solution,
/// does the same for the program with the least adhesion. The analysis uses the same method, and adds proofs.
fn unique(program: &Program, tolerance: f64) -> Outcome {
    let settings = settings(tolerance, Choice::Unique);
    let hard = balance_in(program, settings);
    if let Some(amounts) = hard.forces {
        let off = amounts.unbalanced(program);
        return Outcome::stands(&amounts, off, hard.effort);
    }
    let soft = least_adhesion_in(program, settings);
    let effort = hard.effort.plus(soft.effort);
    let certain = hard.motion.is_some();
    if let (Some(forces), Some(adhesion)) = (&soft.forces, &soft.adhesion) {
        let least = adhesion.total();
        if !certain && least <= min_counted_adhesion(tolerance) {
            let off = forces.unbalanced(program);
            return Outcome::stands(forces, off, effort);
        }
        let parts = || adhesion.normal.iter().flatten().chain(&adhesion.friction).chain(adhesion.grip.iter().flatten());
        let most = parts().fold(0.0, |m: f64, v| m.max(v.abs()));
        let points = parts().filter(|v| v.abs() > MIN_FAILURE_SHARE * most).count();
        return Outcome::falls(Some(least), points, effort);
    }
    if certain || soft.motion.is_some() { Outcome::falls(None, 0, effort) } else { Outcome::undecided(effort) }
}

/// Runs the complete analysis at an accuracy level. The measured time begins after the interfaces have been found.
fn level(task: &Task<'_>, accuracy: Accuracy, tolerance: f64) -> Outcome {
    let options = Options::default().accuracy(accuracy).tolerance(tolerance);
    let analysis = Analysis::with(task.scene, &options);
    let frame = &analysis.frames[task.frame];
    let contacts = frame.contacts.iter().map(|c| c.resultant.force.norm());
    let grips = frame.robots.iter().map(|r| r.force.norm());
    let (imbalance, violation) = match frame.proof {
        Proof::Forces { worst_imbalance, .. } => (Some(worst_imbalance), None),
        Proof::Mechanism { power, worst_violation } => (None, Some(worst_violation / power)),
    };
    Outcome {
        verdict: frame.verdict,
        total: match frame.verdict {
            Verdict::Stable => Some(frame.total_force),
            Verdict::Unstable if frame.unsupported.is_empty() => Some(frame.total_sticking),
            _ => None,
        },
        largest: Some(contacts.chain(grips).fold(0.0, f64::max)),
        points: frame.failures.len(),
        imbalance,
        violation,
        iterations: frame.solve.iterations,
        seconds: Some(frame.solve.seconds),
    }
}

/// The result of a method for a whole frame or for an independent part of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The verdict.
    pub verdict: Verdict,
    /// The total force if the frame stands, the total adhesion if it falls, in N. `None` if the method does not find
    /// it.
    pub total: Option<f64>,
    /// The largest resultant at a contact or grip, in N. `None` if the method does not find it.
    pub largest: Option<f64>,
    /// The number of failures.
    pub points: usize,
    /// The largest imbalance, if the verdict was found from forces. For the accuracy levels it is relative to the
    /// forces on a block, for the other methods to the heaviest load.
    pub imbalance: Option<f64>,
    /// The largest violation of the motion relative to its power, if the verdict was found from a motion. Only the
    /// accuracy levels give it.
    pub violation: Option<f64>,
    /// The number of iterations of the solvers.
    pub iterations: usize,
    /// The solving time in s; `None` if the method does not measure it.
    pub seconds: Option<f64>,
}

impl Outcome {
    /// Returns the outcome for a frame without loads: it stands, and all forces are zero.
    pub fn empty() -> Outcome {
        Outcome {
            verdict: Verdict::Stable,
            total: Some(0.0),
            largest: Some(0.0),
            points: 0,
            imbalance: Some(0.0),
            violation: None,
            iterations: 0,
            seconds: None,
        }
    }

    fn undecided(effort: Effort) -> Outcome {
        Outcome {
            verdict: Verdict::Undecided,
            total: None,
            largest: None,
            imbalance: None,
            iterations: effort.iterations,
            ..Outcome::empty()
        }
    }

    /// Returns the outcome for a part of a frame that falls. Adhesion of `total` at `points` failures would hold it.
    /// `total` is in the scaled units of the program; `None` if it is not known.
    fn falls(total: Option<f64>, points: usize, effort: Effort) -> Outcome {
        Outcome { verdict: Verdict::Unstable, total, points, ..Outcome::undecided(effort) }
    }

    /// Returns the outcome for a part of a frame that stands: the forces `amounts` balance the loads. `imbalance` is
    /// the largest error of this balance, in the scaled units of the program.
    fn stands(amounts: &Amounts, imbalance: f64, effort: Effort) -> Outcome {
        Outcome {
            verdict: Verdict::Stable,
            total: Some(amounts.total()),
            largest: Some(largest(amounts)),
            imbalance: Some(imbalance / Scale::HEAVIEST),
            ..Outcome::undecided(effort)
        }
    }

    /// Converts the forces from the scaled units of a program to newtons.
    fn in_newtons(self, scale: Scale) -> Outcome {
        Outcome { total: self.total.map(|v| v * scale.force), largest: self.largest.map(|v| v * scale.force), ..self }
    }

    /// Combines the outcomes of two independent parts of a frame. If their verdicts are equal, sums are added, and the
    /// larger of two largest values is kept. If their verdicts differ, the combined outcome is that of the worse part,
    /// with the iterations of both parts.
    fn and(self, other: Outcome) -> Outcome {
        let both = |a: Option<f64>, b: Option<f64>, join: fn(f64, f64) -> f64| a.zip(b).map(|(a, b)| join(a, b));
        let iterations = self.iterations + other.iterations;
        if self.verdict == other.verdict {
            Outcome {
                total: both(self.total, other.total, |a, b| a + b),
                largest: both(self.largest, other.largest, f64::max),
                points: self.points + other.points,
                imbalance: both(self.imbalance, other.imbalance, f64::max),
                iterations,
                ..self
            }
        } else {
            let worse = if self.verdict > other.verdict { self } else { other };
            Outcome { iterations, ..worse }
        }
    }
}

/// Returns the magnitude of the largest resultant at a contact or grip, in the scaled units of the program.
fn largest(amounts: &Amounts) -> f64 {
    let contacts = amounts.normal.iter().zip(&amounts.friction).map(|(n, t)| libm::hypot(n[0] + n[1], *t));
    let grips = amounts.grip.iter().map(|g| libm::hypot(g[0], g[1]));
    contacts.chain(grips).fold(0.0, f64::max)
}
