//! Mehrotra's predictor and corrector on the homogeneous self-dual form, with Gondzio's further corrections.
//!
//! Unknowns are amounts f ≥ 0, velocities y, slacks z ≥ 0 and the pair τ, κ ≥ 0:
//!
//! ```text
//! Σ f·column = loads·τ,   columnᵀy + z = cost·τ,   loadsᵀy − costᵀf = κ.
//! ```
//!
//! At the end either τ > 0, and f/τ, y/τ are optima, or κ > 0, and y or f shows that there is none. With squares,
//! max loadsᵀy − ½|y|², there always is one: τ stays 1, and the first equation has y on its left as well. Literature:
//! Andersen and Andersen 2000; Gondzio 1996.

use std::time::Instant;

use super::Limits;
use super::cholesky::Cholesky;
use super::elements::Elements;
use super::point::{LEAST_PIVOT, NEARLY, Point, largest};
use super::product::dot as product;
use super::trend::Trend;

/// min Σ cost·amount  s.t.  Σ amount·column = loads, amount ≥ 0.
pub(super) struct Posed<'a> {
    pub elements: &'a Elements,
    pub cost: &'a [f64],
    /// In the order of elimination, as all velocities here.
    pub loads: &'a [f64],
    /// The factor of ½|y|²: 0 or 1.
    pub squares: f64,
}

/// How it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ended {
    /// With an optimum.
    Optimal,
    /// No amounts balance the loads: along y they work, and no column does.
    NothingBalances,
    /// Some amounts balance each other and cost less than nothing.
    CostWithoutEnd,
}

/// What it ended in.
pub(super) struct Optimum {
    /// `None` where it was given up.
    pub ended: Option<Ended>,
    pub amounts: Vec<f64>,
    pub slack: Vec<f64>,
    pub velocities: Vec<f64>,
    pub iterations: usize,
}

/// A certificate may be off by so much, in parts of what it shows.
const CERTAIN: f64 = 1e-8;

/// How many corrections a direction gets at most. Of walls near their edge 1, 2, 3 and 5 end after 82, 77, 69 and 82
/// iterations, where none has not ended after 100.
const CORRECTIONS: usize = 3;

/// A correction aims at a step longer by so much, and stays where it makes it longer by a tenth of that.
const FURTHER: f64 = 0.3;

/// Products amount·slack within this factor of the mean need no correction.
const BAND: f64 = 10.0;

/// How often balance is restored at most.
const RESTORED: usize = 3;

/// An amount that is so many times its slack is not due to the products amount·slack being above 0 yet.
const CLEARLY: f64 = 100.0;

/// Where τ is this small a part of κ a certificate is a few iterations away, and waited for.
const NEXT_TO_NONE: f64 = 1e-4;
const FEW: usize = 3;

/// Steps shorter than this lead nowhere.
const SHORTEST: f64 = 1e-6;

pub(super) fn solve(posed: Posed, factor: &mut Cholesky, limits: Limits) -> Optimum {
    let mut run = Run::new(&posed, factor);
    let (mut iterations, mut restored) = (0, 0);
    let finest = limits.finer.map_or(1.0, |finer| finer.by) * limits.tolerance;
    let mut trend = Trend::default();
    let ended = loop {
        let residual = Residual::new(&posed, &run.at, &mut run.left);
        if let Some(ended) = residual.ended(&posed, finest) {
            break Some(ended);
        }
        if let Some(finer) = limits.finer {
            let near = finer.before * limits.tolerance;
            let now = residual.in_parts_of_cost(run.at.slack_in_use());
            let remains = trend
                .expected(now, finest)
                .is_some_and(|slack| slack > finer.slack);
            if remains && residual.within(&posed, near) == (true, true) {
                run.leave_out(&posed, factor, near);
                break Some(Ended::Optimal);
            }
        }
        let late = limits.deadline.is_some_and(|end| Instant::now() >= end);
        // Where an end is near, what remains unbalanced is rounding: of steps, not of amounts.
        if restored < RESTORED && residual.wants_balance(&posed, finest) {
            run.restore(&posed, factor);
            restored += 1;
            continue;
        }
        let most = match residual.tau < NEXT_TO_NONE * residual.kappa {
            true => limits.iterations + FEW,
            false => limits.iterations,
        };
        let over = iterations >= most || late || !residual.mean.is_finite();
        if over || !run.step(&posed, factor, &residual) {
            break residual.ended(&posed, limits.tolerance);
        }
        iterations += 1;
    };
    let at = run.at;
    let by = match ended {
        Some(Ended::NothingBalances) => 1.0 / product(posed.loads, &at.y),
        Some(Ended::CostWithoutEnd) => -1.0 / product(posed.cost, &at.f),
        _ => 1.0 / at.tau,
    };
    let scaled = |list: Vec<f64>| -> Vec<f64> { list.into_iter().map(|v| v * by).collect() };
    Optimum {
        ended,
        amounts: scaled(at.f),
        slack: scaled(at.z),
        velocities: scaled(at.y),
        iterations,
    }
}

/// What the equations leave.
struct Left {
    /// loads·τ − Σ f·column, less y with squares.
    balance: Vec<f64>,
    /// cost·τ − columnᵀy − z.
    cost: Vec<f64>,
}

struct Residual {
    /// κ + costᵀf − loadsᵀy.
    gap: f64,
    /// Mean of amount·slack, τκ among them.
    mean: f64,
    primal: f64,
    dual: f64,
    /// Largest of the balance that is left and of Σ f·column.
    balance: [f64; 2],
    /// Largest of the cost that is left and of columnᵀy + z.
    cost: [f64; 2],
    /// Largest amount, slack and velocity.
    size: [f64; 3],
    tau: f64,
    kappa: f64,
}

impl Residual {
    fn new(posed: &Posed, at: &Point, left: &mut Left) -> Residual {
        left.balance.fill(0.0);
        posed.elements.add(&at.f, &mut left.balance);
        let balanced = largest(&left.balance);
        for (rest, (load, y)) in left.balance.iter_mut().zip(posed.loads.iter().zip(&at.y)) {
            *rest = load * at.tau - *rest - posed.squares * y;
        }
        posed.elements.along(&at.y, &mut left.cost);
        let mut priced = 0.0f64;
        for ((rest, cost), z) in left.cost.iter_mut().zip(posed.cost).zip(&at.z) {
            let sum = *rest + z;
            priced = priced.max(sum.abs());
            *rest = cost * at.tau - sum;
        }
        let half = 0.5 * posed.squares * product(&at.y, &at.y);
        let primal = product(posed.cost, &at.f) + half;
        let dual = product(posed.loads, &at.y) - half;
        Residual {
            gap: at.kappa + primal - dual,
            mean: (product(&at.f, &at.z) + at.tau * at.kappa) / (at.f.len() + 1) as f64,
            primal,
            dual,
            balance: [largest(&left.balance), balanced],
            cost: [largest(&left.cost), priced],
            size: [largest(&at.f), largest(&at.z), largest(&at.y)],
            tau: at.tau,
            kappa: at.kappa,
        }
    }

    /// Whether what is left unbalanced is within the tolerance, and whether costs and their gap are.
    fn within(&self, posed: &Posed, tolerance: f64) -> (bool, bool) {
        let tau = self.tau;
        let [f, z, y] = self.size;
        let (primal, dual) = (self.primal / tau, self.dual / tau);
        let gap = (primal - dual).abs();
        let balance = f64::max(1.0, largest(posed.loads) + f / tau);
        let cost = f64::max(1.0, largest(posed.cost) + (y + z) / tau);
        let small = self.cost[0] < tolerance * tau * cost;
        (
            self.balance[0] < tolerance * tau * balance,
            small && gap < tolerance * primal.abs().min(dual.abs()).max(1.0),
        )
    }

    /// The gap between the two costs, and a slack, in parts of the cost.
    fn in_parts_of_cost(&self, slack: f64) -> [f64; 2] {
        [self.primal - self.dual, slack].map(|v| v.abs() / self.primal.abs())
    }

    /// Whether only the balance is missing.
    fn wants_balance(&self, posed: &Posed, tolerance: f64) -> bool {
        self.within(posed, tolerance) == (false, true)
    }

    fn ended(&self, posed: &Posed, tolerance: f64) -> Option<Ended> {
        let tau = self.tau;
        let [f, z, y] = self.size;
        if self.within(posed, tolerance) == (true, true) {
            return Some(Ended::Optimal);
        }
        if tau >= self.kappa {
            return None;
        }
        if self.dual > 0.0 && self.cost[1] < CERTAIN * self.dual.min(y + z) {
            return Some(Ended::NothingBalances);
        }
        if self.primal < 0.0 && self.balance[1] < CERTAIN * f64::min(-self.primal, f) {
            return Some(Ended::CostWithoutEnd);
        }
        None
    }
}

/// A run of the method, with the room it needs.
struct Run {
    at: Point,
    left: Left,
    /// amount/slack.
    weight: Vec<f64>,
    /// The part of a direction that goes with τ.
    along_tau: Point,
    direction: Point,
    corrected: Point,
    /// What amount·slack is to change by, to first order.
    wanted: Vec<f64>,
    wanted_next: Vec<f64>,
    room: Vec<f64>,
}

/// The right-hand sides of a direction beside those of amount·slack.
#[derive(Clone, Copy)]
struct Change {
    /// The share of the residuals to be taken away.
    residual: f64,
    /// What τκ is to change by.
    pair: f64,
}

impl Run {
    fn new(posed: &Posed, factor: &mut Cholesky) -> Run {
        let (columns, unknowns) = (posed.cost.len(), posed.loads.len());
        Run {
            at: Point::first(posed, factor),
            left: Left {
                balance: vec![0.0; unknowns],
                cost: vec![0.0; columns],
            },
            weight: vec![0.0; columns],
            along_tau: Point::zero(columns, unknowns),
            direction: Point::zero(columns, unknowns),
            corrected: Point::zero(columns, unknowns),
            wanted: vec![0.0; columns],
            wanted_next: vec![0.0; columns],
            room: vec![0.0; columns],
        }
    }

    /// Changes the amounts as little as gives balance, each in parts of itself.
    ///
    /// A step finds amounts as amount/slack times what velocities differ by. Near the edge of standing these factors differ
    /// so much that 10⁻⁶ of the loads remain unbalanced, step after step; the amounts themselves differ less.
    fn restore(&mut self, posed: &Posed, factor: &mut Cholesky) {
        for (weight, f) in self.weight.iter_mut().zip(&self.at.f) {
            *weight = f * f;
        }
        factor.factor(posed.elements, &self.weight, LEAST_PIVOT);
        let mut side: Vec<[f64; 1]> = self.left.balance.iter().map(|v| [*v]).collect();
        factor.solve(&mut side);
        let multipliers: Vec<f64> = side.iter().map(|v| v[0]).collect();
        posed.elements.along(&multipliers, &mut self.room);
        let share = |(f, r): (&f64, &f64)| -f * r;
        let most = self.at.f.iter().zip(&self.room).map(share);
        let by = f64::min(1.0, NEARLY / most.fold(NEARLY, f64::max));
        for (f, room) in self.at.f.iter_mut().zip(&self.room) {
            *f += by * *f * *f * room;
        }
    }

    /// Leaves out the dear amounts that hardly outweigh their slack, where the others are an optimum to the tolerance without them.
    fn leave_out(&mut self, posed: &Posed, factor: &mut Cholesky, tolerance: f64) {
        let before = self.at.f.clone();
        let slack = self.at.z.iter().zip(posed.cost);
        for (f, (z, cost)) in self.at.f.iter_mut().zip(slack) {
            if *cost > 0.0 && *f <= CLEARLY * z {
                *f = 0.0;
            }
        }
        Residual::new(posed, &self.at, &mut self.left);
        self.restore(posed, factor);
        let residual = Residual::new(posed, &self.at, &mut self.left);
        if residual.within(posed, tolerance) != (true, true) {
            self.at.f = before;
        }
    }

    /// One iteration; false where it leads nowhere.
    fn step(&mut self, posed: &Posed, factor: &mut Cholesky, residual: &Residual) -> bool {
        for (weight, (f, z)) in self.weight.iter_mut().zip(self.at.f.iter().zip(&self.at.z)) {
            *weight = f / z;
        }
        factor.factor(posed.elements, &self.weight, LEAST_PIVOT + posed.squares);
        // The predictor goes for the optimum itself.
        for (wanted, (f, z)) in self.wanted.iter_mut().zip(self.at.f.iter().zip(&self.at.z)) {
            *wanted = -f * z;
        }
        let mut change = Change {
            residual: 1.0,
            pair: -self.at.tau * self.at.kappa,
        };
        let pivot = self.predict(posed, factor, residual, change);
        let short = 1.0 - self.at.longest(&self.direction).min(1.0);
        let target = short * short * short * residual.mean;
        let pair = target + change.pair - self.direction.tau * self.direction.kappa;
        change = Change {
            residual: 1.0 - short * short * short,
            pair: (1.0 - posed.squares) * pair,
        };
        let along = self.direction.f.iter().zip(&self.direction.z);
        for (wanted, (f, z)) in self.wanted.iter_mut().zip(along) {
            *wanted += target - f * z;
        }
        self.direct(posed, factor, residual, change, pivot);
        std::mem::swap(&mut self.direction, &mut self.corrected);
        let mut longest = self.at.longest(&self.direction);
        for _ in 0..CORRECTIONS {
            if longest > 1.0 - 0.1 * FURTHER {
                break;
            }
            let further = f64::min(longest + FURTHER, 1.0);
            let pair = (1.0 - posed.squares) * self.centre(further, target);
            std::mem::swap(&mut self.wanted, &mut self.wanted_next);
            let next = Change {
                pair: change.pair + pair,
                ..change
            };
            self.direct(posed, factor, residual, next, pivot);
            let now = self.at.longest(&self.corrected);
            if now < longest + 0.1 * FURTHER {
                break;
            }
            std::mem::swap(&mut self.direction, &mut self.corrected);
            (longest, change) = (now, next);
        }
        let by = f64::min(NEARLY * longest, 1.0);
        self.at.advance(&self.direction, by);
        by > SHORTEST
    }

    /// Brings the products amount·slack after a step that goes further back to about their mean: into `wanted_next`, and
    /// what τκ is to change by beside.
    fn centre(&mut self, step: f64, target: f64) -> f64 {
        let back = |v: f64, dv: f64, w: f64, dw: f64| {
            let product = (v + step * dv) * (w + step * dw);
            f64::max(
                product.clamp(target / BAND, BAND * target) - product,
                -BAND * target,
            )
        };
        let (at, by) = (&self.at, &self.direction);
        for (k, next) in self.wanted_next.iter_mut().enumerate() {
            *next = self.wanted[k] + back(at.f[k], by.f[k], at.z[k], by.z[k]);
        }
        back(at.tau, by.tau, at.kappa, by.kappa)
    }

    /// The first direction of an iteration, and the part that goes with τ, in one go; the pivot of τ.
    fn predict(
        &mut self,
        posed: &Posed,
        factor: &Cholesky,
        residual: &Residual,
        change: Change,
    ) -> f64 {
        let mut tau_side = posed.loads.to_vec();
        for (room, (weight, cost)) in self.room.iter_mut().zip(self.weight.iter().zip(posed.cost)) {
            *room = weight * cost;
        }
        posed.elements.add(&self.room, &mut tau_side);
        let side = self.side(posed, change);
        let mut both: Vec<[f64; 2]> = tau_side.iter().zip(&side).map(|(a, b)| [*a, *b]).collect();
        factor.solve(&mut both);
        let part = &mut self.along_tau;
        part.y.iter_mut().zip(&both).for_each(|(y, v)| *y = v[0]);
        posed.elements.along(&part.y, &mut part.f);
        let weighted = self.weight.iter().zip(posed.cost);
        for (f, (weight, cost)) in part.f.iter_mut().zip(weighted) {
            *f = weight * (*f - cost);
        }
        let pivot = product(posed.loads, &part.y) - product(posed.cost, &part.f)
            + self.at.kappa / self.at.tau;
        self.corrected
            .y
            .iter_mut()
            .zip(&both)
            .for_each(|(y, v)| *y = v[1]);
        self.complete(posed, residual, change, pivot);
        std::mem::swap(&mut self.direction, &mut self.corrected);
        pivot
    }

    /// A direction with the same factor, into `corrected`.
    fn direct(
        &mut self,
        posed: &Posed,
        factor: &Cholesky,
        residual: &Residual,
        change: Change,
        pivot: f64,
    ) {
        let mut side: Vec<[f64; 1]> = self.side(posed, change).into_iter().map(|v| [v]).collect();
        factor.solve(&mut side);
        self.corrected
            .y
            .iter_mut()
            .zip(&side)
            .for_each(|(y, v)| *y = v[0]);
        self.complete(posed, residual, change, pivot);
    }

    /// The right-hand side of the velocities; leaves in `room` what completes them.
    fn side(&mut self, posed: &Posed, change: Change) -> Vec<f64> {
        for (k, room) in self.room.iter_mut().enumerate() {
            *room = change.residual * self.left.cost[k] - self.wanted[k] / self.at.f[k];
        }
        let mut side: Vec<f64> = self
            .left
            .balance
            .iter()
            .map(|v| change.residual * v)
            .collect();
        let weighted: Vec<f64> = self
            .weight
            .iter()
            .zip(&self.room)
            .map(|(w, r)| w * r)
            .collect();
        posed.elements.add(&weighted, &mut side);
        side
    }

    /// Amounts, slacks, τ and κ that belong to the velocities of `corrected`.
    fn complete(&mut self, posed: &Posed, residual: &Residual, change: Change, pivot: f64) {
        let (at, tau_part, to) = (&self.at, &self.along_tau, &mut self.corrected);
        posed.elements.along(&to.y, &mut to.f);
        for (f, (weight, room)) in to.f.iter_mut().zip(self.weight.iter().zip(&self.room)) {
            *f = weight * (*f - room);
        }
        let gap = change.residual * residual.gap - product(posed.loads, &to.y)
            + product(posed.cost, &to.f)
            + change.pair / at.tau;
        to.tau = (1.0 - posed.squares) * gap / pivot;
        for (y, part) in to.y.iter_mut().zip(&tau_part.y) {
            *y += part * to.tau;
        }
        for (k, f) in to.f.iter_mut().enumerate() {
            *f += tau_part.f[k] * to.tau;
            to.z[k] = (self.wanted[k] - at.z[k] * *f) / at.f[k];
        }
        to.kappa = (change.pair - at.kappa * to.tau) / at.tau;
    }
}
