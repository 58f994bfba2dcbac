//! Least squares of amounts that may not fall below a floor, by the same normal equations.
//!
//! ```text
//! min ½ xᵀPx + linearᵀx   s.t.   Σ x·column = loads,   s = x + floor ≥ 0,
//! ```
//!
//! where P couples only the few columns of one contact. Every step of Mehrotra's predictor and corrector solves
//! A·W·Aᵀ·y = right-hand side with W = (P + Z/S)⁻¹, one small block for each contact. With the factors P + Z/S = L·Lᵀ it is
//! the matrix of the columns L⁻¹·column, each of weight 1, so that the same factor does. Amounts and what they have above
//! their floors are kept apart: of an amount far above its floor the change would drown in it.

use std::ops::Range;
use std::time::Instant;

use super::cholesky::Cholesky;
use super::elements::Elements;
use super::point::{LEAST_PIVOT, NEARLY, largest};
use super::product::dot;
use super::{Answer, Limits, Status};
use crate::program::QuadraticProgram;

/// Columns of one contact: three for each of its two application points.
const MOST_COLUMNS: usize = 6;

/// The gap is closed to so small a part of the tolerance, where that is in reach: a gap of a billionth of the squares leaves
/// forces off by some 10⁻⁵ of themselves, and one or two steps more are cheap.
const FINER: f64 = 1e-3;

/// Steps shorter than this hardly lead anywhere; nor do long ones that leave more than a share of what was unbalanced, where
/// others leave a third. So many of them in a row lead nowhere: it is so where nothing balances.
const SHORT: f64 = 0.1;
const LONG: f64 = 0.8;
const STAYS: f64 = 0.8;
const IDLE_STEPS: usize = 3;

/// The least squares of a problem with one row = for each velocity, and one for each floor; `None` where it is of another
/// kind, or ends without an optimum.
///
/// Chains are welcome: of an arch of 10 000 stones clarabel calls the least squares infeasible, whose forces are thousands of
/// loads.
pub(super) fn solve(problem: &QuadraticProgram, limits: Limits) -> Option<Answer> {
    let squares = Squares::new(problem)?;
    let mut run = Run::new(squares, problem)?;
    run.start();
    let (mut iterations, mut idle) = (0, 0);
    while !run.is_optimal(limits.tolerance, FINER * limits.tolerance) {
        let late = limits.deadline.is_some_and(|end| Instant::now() >= end);
        if iterations == limits.iterations || late || idle == IDLE_STEPS {
            if run.is_optimal(limits.tolerance, limits.tolerance) {
                break;
            }
            return None;
        }
        let before = largest(&run.left.balance);
        let by = run.step();
        let stays = largest(&run.left.balance) > STAYS * before;
        let in_vain = by > LONG && stays && !run.is_balanced(limits.tolerance);
        idle = if by < SHORT || in_vain { idle + 1 } else { 0 };
        if !run.mean().is_finite() {
            return None;
        }
        iterations += 1;
    }
    let y = run.factor.as_given(&run.y);
    Some(Answer {
        status: Status::Solved,
        z: y.iter().map(|v| -v).chain(run.z).collect(),
        s: vec![0.0; y.len()].into_iter().chain(run.s).collect(),
        x: run.x,
        iterations,
    })
}

/// The quadratic part, block by block.
struct Squares {
    blocks: Vec<Range<usize>>,
    /// Of each block its own square matrix, row by row.
    entries: Vec<f64>,
    /// Where that of each block begins.
    begin: Vec<usize>,
}

impl Squares {
    /// `None` where columns are coupled across more than a few, or floors are not the only inequalities.
    fn new(problem: &QuadraticProgram) -> Option<Squares> {
        let n = problem.unknowns;
        let is_floor = |(row, column, value): &(usize, usize, f64)| {
            *row - problem.equalities == *column && *value == -1.0
        };
        let mut below = problem.matrix.iter().filter(|e| e.0 >= problem.equalities);
        // Fewer columns than rows seldom have a balance at all, which clarabel sees after two iterations.
        if problem.equalities == 0
            || n < problem.equalities
            || problem.bound.len() != problem.equalities + n
            || !below.all(is_floor)
        {
            return None;
        }
        let mut first: Vec<usize> = (0..n).collect();
        for (i, j, _) in &problem.quadratic {
            first[*j] = first[*j].min(*i);
        }
        let (mut starts, mut low) = (Vec::new(), n);
        for j in (0..n).rev() {
            low = low.min(first[j]);
            if low == j {
                starts.push(j);
                low = n;
            }
        }
        starts.reverse();
        let ends = starts.iter().skip(1).copied().chain([n]);
        let blocks: Vec<Range<usize>> = starts.iter().zip(ends).map(|(a, b)| *a..b).collect();
        if blocks.iter().any(|block| block.len() > MOST_COLUMNS) {
            return None;
        }
        let mut begin = vec![0];
        let mut of_column = vec![0; n];
        for (k, block) in blocks.iter().enumerate() {
            of_column[block.clone()].fill(k);
            begin.push(begin[k] + block.len() * block.len());
        }
        let mut entries = vec![0.0; begin[blocks.len()]];
        for (i, j, value) in &problem.quadratic {
            let k = of_column[*i];
            let (start, wide) = (blocks[k].start, blocks[k].len());
            entries[begin[k] + (i - start) * wide + (j - start)] += value;
            if i != j {
                entries[begin[k] + (j - start) * wide + (i - start)] += value;
            }
        }
        Some(Squares {
            blocks,
            entries,
            begin,
        })
    }

    /// P·x.
    fn times(&self, x: &[f64], product: &mut [f64]) {
        for (k, block) in self.blocks.iter().enumerate() {
            let rows = self.entries[self.begin[k]..self.begin[k + 1]].chunks_exact(block.len());
            for (to, row) in product[block.clone()].iter_mut().zip(rows) {
                *to = row.iter().zip(&x[block.clone()]).map(|(p, x)| p * x).sum();
            }
        }
    }
}

/// A run of the method.
struct Run {
    squares: Squares,
    /// The columns, and times L⁻¹, unknowns in the order of elimination.
    given: Elements,
    whitened: Elements,
    factor: Cholesky,
    ones: Vec<f64>,
    /// L of every block, in its lower triangle.
    lower: Vec<f64>,
    loads: Vec<f64>,
    linear: Vec<f64>,
    floor: Vec<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    z: Vec<f64>,
    left: Left,
}

/// What the equations leave.
struct Left {
    /// loads − Σ x·column.
    balance: Vec<f64>,
    /// columnᵀy + z − Px − linear.
    cost: Vec<f64>,
    /// x + floor − s.
    floor: Vec<f64>,
    /// Largest of Σ x·column, of Px and of columnᵀy.
    size: [f64; 3],
}

/// By how much the point is to change.
struct Direction {
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    z: Vec<f64>,
}

impl Run {
    fn new(squares: Squares, problem: &QuadraticProgram) -> Option<Run> {
        let n = problem.unknowns;
        let balance = problem
            .matrix
            .iter()
            .filter(|e| e.0 < problem.equalities)
            .map(|(row, column, value)| (*column, *row, *value));
        let mut given = Elements::in_families(problem.equalities, &squares.blocks, balance);
        if given.widest() > super::MOST_ENTRIES {
            return None;
        }
        let factor = Cholesky::new(&mut given)?;
        let (loads, floor) = problem.bound.split_at(problem.equalities);
        Some(Run {
            lower: vec![0.0; squares.entries.len()],
            squares,
            whitened: given.clone(),
            ones: vec![1.0; n],
            loads: factor.in_order(loads),
            factor,
            linear: problem.linear.clone(),
            floor: floor.to_vec(),
            x: vec![0.0; n],
            y: vec![0.0; problem.equalities],
            s: vec![1.0; n],
            z: vec![1.0; n],
            left: Left {
                balance: vec![0.0; problem.equalities],
                cost: vec![0.0; n],
                floor: vec![0.0; n],
                size: [0.0; 3],
            },
            given,
        })
    }

    /// Where the squares are least without floors, moved above these.
    fn start(&mut self) {
        self.factored();
        let mut side: Vec<[f64; 1]> = self.loads.iter().map(|v| [*v]).collect();
        self.factor.solve(&mut side);
        self.y = side.iter().map(|v| v[0]).collect();
        self.given.along(&self.y, &mut self.x);
        let mut x = std::mem::take(&mut self.x);
        self.weigh(&mut x);
        self.x = x;
        let mean = self.x.iter().map(|x| x.abs()).sum::<f64>() / self.x.len().max(1) as f64;
        let inside = if mean > 0.0 { mean } else { 1.0 };
        for k in 0..self.x.len() {
            self.s[k] = f64::max(self.x[k] + self.floor[k], inside);
            self.z[k] = inside * (inside / self.s[k]);
        }
        self.measure();
    }

    /// What the equations leave at the point.
    fn measure(&mut self) {
        let left = &mut self.left;
        left.balance.fill(0.0);
        self.given.add(&self.x, &mut left.balance);
        let balanced = largest(&left.balance);
        for (rest, load) in left.balance.iter_mut().zip(&self.loads) {
            *rest = load - *rest;
        }
        self.squares.times(&self.x, &mut left.cost);
        let squared = largest(&left.cost);
        self.given.along(&self.y, &mut left.floor);
        left.size = [balanced, squared, largest(&left.floor)];
        for k in 0..self.x.len() {
            left.cost[k] = left.floor[k] + self.z[k] - left.cost[k] - self.linear[k];
            left.floor[k] = (self.x[k] - self.s[k]) + self.floor[k];
        }
    }

    fn mean(&self) -> f64 {
        dot(&self.s, &self.z) / self.s.len().max(1) as f64
    }

    fn is_balanced(&self, tolerance: f64) -> bool {
        largest(&self.left.balance) <= tolerance * f64::max(1.0, self.left.size[0])
    }

    fn is_optimal(&self, tolerance: f64, gap: f64) -> bool {
        let [_, squared, along] = self.left.size;
        let small = |list: &[f64], of: f64| largest(list) <= tolerance * f64::max(1.0, of);
        // The gap, since what the equations leave is little by then.
        let mut product = vec![0.0; self.x.len()];
        self.squares.times(&self.x, &mut product);
        let cost = 0.5 * dot(&self.x, &product) + dot(&self.linear, &self.x);
        self.is_balanced(tolerance)
            && small(&self.left.cost, squared.max(along))
            && small(&self.left.floor, largest(&self.x))
            && dot(&self.s, &self.z) <= gap * f64::max(1.0, cost.abs())
    }

    /// Factors P + Z/S block by block, and the matrix.
    fn factored(&mut self) {
        for (k, block) in self.squares.blocks.iter().enumerate() {
            let (wide, of) = (
                block.len(),
                self.squares.begin[k]..self.squares.begin[k + 1],
            );
            let lower = &mut self.lower[of.clone()];
            lower.copy_from_slice(&self.squares.entries[of]);
            for (i, at) in block.clone().enumerate() {
                lower[i * wide + i] += self.z[at] / self.s[at];
            }
            triangle(lower, wide);
            let places = self.given.family(k).places.len();
            let (given, whitened) = (self.given.family(k).values, self.whitened.values_mut(k));
            for p in 0..places {
                let mut row = [0.0; MOST_COLUMNS];
                for (v, column) in row.iter_mut().zip(given.chunks_exact(places)) {
                    *v = column[p];
                }
                forward(lower, wide, &mut row[..wide]);
                for (v, column) in row.iter().zip(whitened.chunks_exact_mut(places)) {
                    column[p] = *v;
                }
            }
        }
        self.factor.factor(&self.whitened, &self.ones, LEAST_PIVOT);
    }

    /// W times a list, in place.
    fn weigh(&self, list: &mut [f64]) {
        for (k, block) in self.squares.blocks.iter().enumerate() {
            let lower = &self.lower[self.squares.begin[k]..self.squares.begin[k + 1]];
            let own = &mut list[block.clone()];
            forward(lower, block.len(), own);
            backward(lower, block.len(), own);
        }
    }

    /// The direction for which s·z changes by `wanted`, and a share of what is left goes away.
    fn direction(&self, wanted: &[f64], share: f64) -> Direction {
        let n = self.x.len();
        // (P + Z/S) dx = columnᵀdy + room.
        let room: Vec<f64> = (0..n)
            .map(|k| {
                let (s, z) = (self.s[k], self.z[k]);
                share * self.left.cost[k] + (wanted[k] - share * z * self.left.floor[k]) / s
            })
            .collect();
        let mut weighed = room.clone();
        self.weigh(&mut weighed);
        let mut sum = vec![0.0; self.loads.len()];
        self.given.add(&weighed, &mut sum);
        let balance = self.left.balance.iter();
        let sides = balance.zip(&sum).map(|(rest, sum)| [share * rest - sum]);
        let mut side: Vec<[f64; 1]> = sides.collect();
        self.factor.solve(&mut side);
        let y: Vec<f64> = side.iter().map(|v| v[0]).collect();
        let mut x = vec![0.0; n];
        self.given.along(&y, &mut x);
        x.iter_mut().zip(&room).for_each(|(x, r)| *x += r);
        self.weigh(&mut x);
        let s: Vec<f64> = x
            .iter()
            .zip(&self.left.floor)
            .map(|(x, rest)| x + share * rest)
            .collect();
        let z = (0..n).map(|k| (wanted[k] - self.z[k] * s[k]) / self.s[k]);
        Direction {
            z: z.collect(),
            x,
            y,
            s,
        }
    }

    /// The longest step that leaves nothing below 0, at most 1/[`NEARLY`].
    fn longest(&self, along: &Direction) -> f64 {
        let mut longest = 1.0 / NEARLY;
        let (s, z) = (self.s.iter().zip(&along.s), self.z.iter().zip(&along.z));
        for (v, d) in s.chain(z) {
            if v + longest * d < 0.0 {
                longest = -v / d;
            }
        }
        longest
    }

    /// One iteration; the share of its direction that it goes.
    fn step(&mut self) -> f64 {
        self.factored();
        let products = self.s.iter().zip(&self.z);
        let mut wanted: Vec<f64> = products.map(|(s, z)| -s * z).collect();
        let predictor = self.direction(&wanted, 1.0);
        let short = 1.0 - self.longest(&predictor).min(1.0);
        let target = short * short * short * self.mean();
        for (k, wanted) in wanted.iter_mut().enumerate() {
            *wanted += target - predictor.s[k] * predictor.z[k];
        }
        let along = self.direction(&wanted, 1.0 - short * short * short);
        let by = f64::min(NEARLY * self.longest(&along), 1.0);
        let lists = [
            (&mut self.x, &along.x),
            (&mut self.y, &along.y),
            (&mut self.s, &along.s),
            (&mut self.z, &along.z),
        ];
        for (list, along) in lists {
            list.iter_mut().zip(along).for_each(|(v, d)| *v += by * d);
        }
        self.measure();
        by
    }
}

/// The lower triangle L of a small positive matrix L·Lᵀ, in place, row by row.
fn triangle(matrix: &mut [f64], wide: usize) {
    for i in 0..wide {
        for j in 0..=i {
            let before: f64 = (0..j)
                .map(|k| matrix[i * wide + k] * matrix[j * wide + k])
                .sum();
            let rest = matrix[i * wide + j] - before;
            matrix[i * wide + j] = if i == j {
                rest.max(f64::MIN_POSITIVE).sqrt()
            } else {
                rest / matrix[j * wide + j]
            };
        }
    }
}

/// L⁻¹ times a list, in place.
fn forward(lower: &[f64], wide: usize, list: &mut [f64]) {
    for i in 0..wide {
        let before: f64 = (0..i).map(|k| lower[i * wide + k] * list[k]).sum();
        list[i] = (list[i] - before) / lower[i * wide + i];
    }
}

/// L⁻ᵀ times a list, in place.
fn backward(lower: &[f64], wide: usize, list: &mut [f64]) {
    for i in (0..wide).rev() {
        let after: f64 = (i + 1..wide).map(|k| lower[k * wide + i] * list[k]).sum();
        list[i] = (list[i] - after) / lower[i * wide + i];
    }
}
