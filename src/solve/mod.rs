//! Solving a program: least force where it stands, least sticking where it falls, one unique set of forces to draw.
//!
//! Makes [`Balance`] and [`Stuck`] in the program's pure numbers. Neither is a verdict: the forces and the motion go to
//! [`crate::proof`], which decides. `conic` alone names the solver.
//!
//! Among several optima the one of least Σ force² is drawn. It is found on the face of optima: an interior-point answer
//! is strictly complementary, so a column belongs to the face exactly where its amount outweighs its slack.

mod balance;
mod conic;
mod exact;
mod single;
mod stick;

pub use balance::{Balance, balance};
pub use conic::{Answer, Care, Status, TOLERANCE, solve};
pub use single::single;
pub use stick::{Stuck, stick};

use crate::program::{Column, Conic, Force, Program, kinematic, least_squares};

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

    /// Adds `amount` of a force.
    fn add(&mut self, force: Force, amount: f64) {
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

/// A solved kinematic twin.
struct Twin {
    status: Status,
    /// The virtual velocities against which loads work.
    y: Vec<f64>,
    /// Amount of each column.
    amounts: Vec<f64>,
    /// Whether each column belongs to the face of optima.
    active: Vec<bool>,
    aim: f64,
}

/// Solves the kinematic twin of some columns, again with full care where the quick way ends nowhere.
fn twin(
    need: &[f64],
    columns: &[Column],
    care: Care,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Twin {
    let (conic, row_of) = kinematic(need, columns, cost);
    let answer = careful(&conic, care, effort);
    if answer.x.is_empty() {
        let n = columns.len();
        return Twin {
            status: answer.status,
            y: vec![0.0; need.len()],
            amounts: vec![0.0; n],
            active: vec![false; n],
            aim: 0.0,
        };
    }
    let mut amounts = vec![0.0; columns.len()];
    let mut active = vec![false; columns.len()];
    for (k, row) in row_of.iter().enumerate() {
        if *row == usize::MAX {
            // The second of a pair posed as one equality.
            amounts[k] = f64::max(0.0, -answer.z[row_of[k - 1]]);
            active[k] = true;
        } else if *row < conic.equalities {
            amounts[k] = f64::max(0.0, answer.z[*row]);
            active[k] = true;
        } else {
            amounts[k] = answer.z[*row].max(0.0);
            active[k] = answer.z[*row] > answer.s[*row];
        }
    }
    let y = answer.x[..need.len()].to_vec();
    let aim = need.iter().zip(&y).map(|(b, y)| b * y).sum();
    Twin {
        status: answer.status,
        y,
        amounts,
        active,
        aim,
    }
}

/// Solves, and solves again with full care where the quick way ends nowhere.
fn careful(conic: &Conic, care: Care, effort: &mut Effort) -> Answer {
    let mut answer = solve(conic, TOLERANCE, care);
    *effort = effort.and(Effort {
        iterations: answer.iterations,
        programs: 1,
    });
    if answer.status == Status::Unclear && care == Care::Quick {
        answer = solve(conic, TOLERANCE, Care::Full);
        *effort = effort.and(Effort {
            iterations: answer.iterations,
            programs: 1,
        });
    }
    answer
}

/// The amounts of least Σ force² on given columns, if there are such.
///
/// Where the balance leaves no choice they come from elimination, exact to rounding; else from a quadratic program.
fn tidy(need: &[f64], columns: &[Column], care: Care, effort: &mut Effort) -> Option<Vec<f64>> {
    if columns.is_empty() {
        return Some(Vec::new());
    }
    if let Some(amounts) = exact::only(need, columns) {
        return Some(amounts);
    }
    let answer = careful(&least_squares(need, columns), care, effort);
    (answer.status == Status::Solved).then(|| answer.x.iter().map(|v| v.max(0.0)).collect())
}

/// Columns that are active, with their amounts.
fn kept(columns: &[Column], amounts: &[f64], active: &[bool]) -> (Vec<Column>, Vec<f64>) {
    let pick = columns.iter().zip(amounts).zip(active).filter(|(_, a)| **a);
    pick.map(|((column, amount), _)| (*column, *amount)).unzip()
}

/// The forces of some columns' amounts.
fn gathered(program: &Program, columns: &[Column], amounts: &[f64]) -> (Amounts, Amounts) {
    let (mut admissible, mut sticking) = (Amounts::none(program), Amounts::none(program));
    for (column, amount) in columns.iter().zip(amounts) {
        let to = if column.force.sticks() {
            &mut sticking
        } else {
            &mut admissible
        };
        to.add(column.force, *amount);
    }
    (admissible, sticking)
}
