//! Tests of the solvers on the normal equations: their results meet the optimality conditions and agree with
//! clarabel.

use super::*;
use crate::clock::Instant;
use crate::mechanics::solve::random_numbers::RandomNumbers;
use crate::mechanics::solve::{Conditioning, TOLERANCE};

mod factor;

/// Five random columns for each pair of neighbours in a lattice of blocks, and for each block of the first row and
/// the ground.
fn lattice(wide: usize, high: usize, numbers: &mut RandomNumbers) -> (usize, Vec<Vec<(usize, f64)>>) {
    let mut columns = Vec::new();
    let mut pair = |blocks: &[usize]| {
        for _ in 0..5 {
            let unknowns = blocks.iter().flat_map(|b| [3 * b, 3 * b + 1, 3 * b + 2]);
            columns.push(unknowns.map(|i| (i, numbers.next())).collect());
        }
    };
    for y in 0..high {
        for x in 0..wide {
            let at = y * wide + x;
            match y {
                0 => pair(&[at]),
                _ => pair(&[at - wide, at]),
            }
            if x > 0 {
                pair(&[at - 1, at]);
            }
        }
    }
    (3 * wide * high, columns)
}

/// max loadsᵀy  s.t.  columnᵀy ≤ cost.
fn kinematic(loads: &[f64], columns: &[Vec<(usize, f64)>], cost: &[f64]) -> QuadraticProgram {
    let entries = columns.iter().enumerate();
    QuadraticProgram {
        unknowns: loads.len(),
        quadratic: Vec::new(),
        linear: loads.iter().map(|v| -v).collect(),
        matrix: entries.flat_map(|(k, column)| column.iter().map(move |(i, v)| (k, *i, *v))).collect(),
        bound: cost.to_vec(),
        equalities: 0,
    }
}

/// min costᵀamount  s.t.  Σ amount·column = loads, amount ≥ 0.
fn forces(loads: &[f64], columns: &[Vec<(usize, f64)>], cost: &[f64]) -> QuadraticProgram {
    let entries = columns.iter().enumerate();
    let balance = entries.flat_map(|(k, column)| column.iter().map(move |(i, v)| (*i, k, *v)));
    let signs = (0..columns.len()).map(|k| (loads.len() + k, k, -1.0));
    QuadraticProgram {
        unknowns: columns.len(),
        quadratic: Vec::new(),
        linear: cost.to_vec(),
        matrix: balance.chain(signs).collect(),
        bound: [loads, &vec![0.0; columns.len()]].concat(),
        equalities: loads.len(),
    }
}

fn criteria() -> StoppingCriteria {
    StoppingCriteria { tolerance: TOLERANCE, crossover: None, iterations: 100, deadline: None }
}

fn solved(problem: &QuadraticProgram) -> Answer {
    solve_any_size(problem, criteria(), 0.0).expect("the form of the program is accepted")
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the product Ax.
fn rows(problem: &QuadraticProgram, x: &[f64]) -> Vec<f64> {
    let mut rows = vec![0.0; problem.bound.len()];
    for (row, column, value) in &problem.matrix {
        rows[*row] += value * x[*column];
    }
    rows
}

/// Returns the product Aᵀz.
fn columns(problem: &QuadraticProgram, z: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; problem.unknowns];
    for (row, column, value) in &problem.matrix {
        sums[*column] += value * z[*row];
    }
    sums
}

#[test]
fn an_optimum_of_either_form_meets_its_conditions_and_has_the_cost_of_clarabel() {
    let mut numbers = RandomNumbers(11);
    for (wide, high) in [(6, 4), (13, 9)] {
        let (unknowns, list) = lattice(wide, high, &mut numbers);
        // Some amounts balance the loads, and some velocities respect every cost. Therefore an optimum exists.
        let mut loads = vec![0.0; unknowns];
        let y: Vec<f64> = (0..unknowns).map(|_| numbers.next()).collect();
        let mut cost = Vec::new();
        for column in &list {
            let amount = numbers.next().max(0.0);
            column.iter().for_each(|(i, v)| loads[*i] += amount * v);
            let along: f64 = column.iter().map(|(i, v)| v * y[*i]).sum();
            cost.push(along + numbers.next().max(0.0));
        }
        let problem = kinematic(&loads, &list, &cost);
        let answer = solved(&problem);
        assert_eq!(answer.status, Status::Solved);
        let left = columns(&problem, &answer.z);
        for (k, sum) in left.iter().enumerate() {
            assert!((sum + problem.linear[k]).abs() < 1e-6, "balance of {k}: {sum}");
        }
        for (k, row) in rows(&problem, &answer.x).iter().enumerate() {
            assert!((row + answer.s[k] - cost[k]).abs() < 1e-6, "row {k}");
            assert!(answer.s[k] >= 0.0 && answer.z[k] >= 0.0);
            assert!(answer.s[k] * answer.z[k] < 1e-5, "complementarity of {k}");
        }
        let other = crate::mechanics::solve::solve(&problem, TOLERANCE, Conditioning::Full);
        let (ours, theirs) = (product(&problem.linear, &answer.x), product(&problem.linear, &other.x));
        assert!((ours - theirs).abs() < 1e-6 * theirs.abs().max(1.0), "{ours} and {theirs}");

        let problem = forces(&loads, &list, &cost);
        let answer = solved(&problem);
        assert_eq!(answer.status, Status::Solved);
        let sum = product(&problem.linear, &answer.x);
        assert!((sum + ours).abs() < 1e-6 * ours.abs().max(1.0), "{sum} and {ours}");
        for (k, row) in rows(&problem, &answer.x).iter().enumerate() {
            assert!((row + answer.s[k] - problem.bound[k]).abs() < 1e-6, "row {k}");
        }
        for (k, sum) in columns(&problem, &answer.z).iter().enumerate() {
            assert!((sum + problem.linear[k]).abs() < 1e-6, "column {k}: {sum}");
        }
    }
}

#[test]
fn a_program_without_an_optimum_gets_a_certificate() {
    let mut numbers = RandomNumbers(5);
    let (unknowns, list) = lattice(7, 5, &mut numbers);
    let cost: Vec<f64> = list.iter().map(|_| 1.0).collect();
    // All columns have a positive coefficient for unknown 4, but its load is negative.
    let pressing: Vec<Vec<(usize, f64)>> = list
        .iter()
        .map(|column| {
            let pressed = |(i, v): &(usize, f64)| (*i, if *i == 4 { v.abs() } else { *v });
            column.iter().map(pressed).collect()
        })
        .collect();
    let mut loads = vec![0.0; unknowns];
    loads[4] = -1.0;
    let problem = kinematic(&loads, &pressing, &cost);
    let answer = solved(&problem);
    assert_eq!(answer.status, Status::Unbounded);
    let power = -product(&problem.linear, &answer.x);
    assert!((power - 1.0).abs() < 1e-9, "{power}");
    assert!(rows(&problem, &answer.x).iter().all(|row| *row < 1e-6));
    let problem = forces(&loads, &pressing, &cost);
    let answer = solved(&problem);
    assert_eq!(answer.status, Status::Infeasible);
    // The multipliers of the balance have the opposite sign.
    assert!((product(&loads, &answer.z[..unknowns]) + 1.0).abs() < 1e-9);

    // Two opposite columns whose total cost is negative.
    let mut both = list.clone();
    both.push(list[40].iter().map(|(i, v)| (*i, -v)).collect());
    let mut cheap = cost.clone();
    cheap.push(-2.0);
    let answer = solved(&kinematic(&loads, &both, &cheap));
    assert_eq!(answer.status, Status::Infeasible);
    let sums = columns(&kinematic(&loads, &both, &cheap), &answer.z);
    assert!(sums.iter().all(|v| v.abs() < 1e-6));
    assert!(product(&cheap, &answer.z) < 0.0);
    assert_eq!(solved(&forces(&loads, &both, &cheap)).status, Status::Unbounded);
}

#[test]
fn the_solver_stops_after_its_iterations_and_at_its_deadline() {
    let mut numbers = RandomNumbers(3);
    let (unknowns, list) = lattice(6, 6, &mut numbers);
    let loads: Vec<f64> = (0..unknowns).map(|_| numbers.next()).collect();
    let problem = kinematic(&loads, &list, &vec![1.0; list.len()]);
    let few = StoppingCriteria { iterations: 2, ..criteria() };
    let answer = solve_any_size(&problem, few, 0.0).expect("the form of the program is accepted");
    assert_eq!((answer.status, answer.iterations), (Status::Unsolved, 2));
    let late = StoppingCriteria { deadline: Some(Instant::now()), ..criteria() };
    let answer = solve_any_size(&problem, late, 0.0).expect("the form of the program is accepted");
    assert_eq!((answer.status, answer.iterations), (Status::Unsolved, 0));
}

#[test]
fn other_kinds_of_programs_are_left_to_clarabel() {
    let mut numbers = RandomNumbers(13);
    let (unknowns, list) = lattice(5, 5, &mut numbers);
    let (loads, cost) = (vec![1.0; unknowns], vec![1.0; list.len()]);
    let plain = kinematic(&loads, &list, &cost);
    let taken = |problem: &QuadraticProgram| solve_any_size(problem, criteria(), 0.0).is_some();
    assert!(taken(&plain) && taken(&forces(&loads, &list, &cost)));
    assert!(solve(&plain, criteria()).is_none(), "too few blocks");
    let few = StoppingCriteria { iterations: 1, ..criteria() };
    let unsolved = |least_work: f64| solve_any_size(&plain, few, least_work);
    assert!(unsolved(0.0).is_some_and(|a| a.status == Status::Unsolved));
    assert!(unsolved(1e9).is_none(), "a chain without a result");
    let mut squared = plain.clone();
    squared.quadratic.push((0, 0, 1.0));
    let mut heavy = plain.clone();
    heavy.quadratic = (0..unknowns).map(|k| (k, k, 2.0)).collect();
    let mut equal = plain.clone();
    equal.equalities = 1;
    let mut dense = plain.clone();
    let row = dense.bound.len();
    dense.bound.push(1.0);
    dense.matrix.extend((0..unknowns).map(|i| (row, i, 1.0)));
    let mut limited = forces(&loads, &list, &cost);
    limited.matrix.push((limited.bound.len(), 0, 1.0));
    limited.bound.push(2.0);
    // A quadratic form that couples all columns, and squares of columns that have an upper limit and a floor.
    let mut coupled = forces(&loads, &list, &cost);
    coupled.quadratic = (0..list.len()).map(|k| (0, k, 1.0)).collect();
    let mut capped = limited.clone();
    capped.quadratic = (0..list.len()).map(|k| (k, k, 1.0)).collect();
    for problem in [squared, heavy, equal, dense, limited, coupled, capped] {
        assert!(!taken(&problem));
    }
}

#[test]
fn the_least_norm_velocities_and_amounts_are_those_of_clarabel() {
    let mut numbers = RandomNumbers(17);
    let (unknowns, list) = lattice(8, 6, &mut numbers);
    // Some rows hold at y = 0, others do not.
    let y: Vec<f64> = (0..unknowns).map(|_| numbers.next()).collect();
    let bound = list.iter().map(|column| {
        let along: f64 = column.iter().map(|(i, v)| v * y[*i]).sum();
        0.2 * along + 0.5 * numbers.next().abs()
    });
    let mut shortest = kinematic(&vec![0.0; unknowns], &list, &bound.collect::<Vec<_>>());
    shortest.quadratic = (0..unknowns).map(|k| (k, k, 1.0)).collect();
    assert!(shortest.bound.iter().any(|b| *b < 0.0));
    let loads: Vec<f64> = (0..unknowns).map(|_| numbers.next()).collect();
    let mut smallest = forces(&loads, &list, &vec![0.0; list.len()]);
    smallest.quadratic = (0..list.len()).map(|k| (k, k, 1.0)).collect();
    smallest.matrix.retain(|entry| entry.0 < unknowns);
    smallest.bound.truncate(unknowns);
    for problem in [shortest, smallest] {
        let ours = solved(&problem);
        let theirs = crate::mechanics::solve::solve(&problem, TOLERANCE, Conditioning::Full);
        assert_eq!((ours.status, theirs.status), (Status::Solved, Status::Solved));
        for (a, b) in ours.x.iter().zip(&theirs.x).chain(ours.z.iter().zip(&theirs.z)) {
            assert!((a - b).abs() < 1e-4, "{a} and {b}");
        }
        let half = |x: &[f64]| 0.5 * product(x, x);
        let off = half(&ours.x) - half(&theirs.x);
        assert!(off.abs() < 1e-7, "{off}");
    }
}

#[test]
fn least_squares_with_floors_meet_their_conditions_and_have_the_cost_of_clarabel() {
    let mut numbers = RandomNumbers(19);
    // First amounts ≥ 0, then corrections of amounts, some of which are tiny and some huge.
    for floors in [[0.0, 0.0, 0.0], [1e-3, 1.0, 1e9]] {
        let (unknowns, list) = lattice(9, 7, &mut numbers);
        let mut problem = forces(&vec![0.0; unknowns], &list, &vec![0.0; list.len()]);
        // The quadratic form couples the five columns of a pair. It is G·Gᵀ with three random numbers per column,
        // plus 0.1 on the diagonal.
        for first in (0..list.len()).step_by(5) {
            let rows: Vec<[f64; 3]> = (0..5).map(|_| [(); 3].map(|()| numbers.next())).collect();
            for j in 0..5 {
                for i in 0..=j {
                    let value = product(&rows[i], &rows[j]) + f64::from(u8::from(i == j)) * 0.1;
                    problem.quadratic.push((first + i, first + j, value));
                }
            }
        }
        for (k, column) in list.iter().enumerate() {
            let amount = numbers.next().max(0.0);
            let loads = &mut problem.bound;
            column.iter().for_each(|(i, v)| loads[*i] += amount * v);
            problem.bound[unknowns + k] = floors[k % 3];
        }
        let quadratic = problem.quadratic.clone();
        let squares = |x: &[f64]| {
            let mut product = vec![0.0; x.len()];
            for (i, j, value) in &quadratic {
                product[*i] += value * x[*j];
                if i != j {
                    product[*j] += value * x[*i];
                }
            }
            product
        };
        let ours = solved(&problem);
        assert_eq!(ours.status, Status::Solved);
        let left = columns(&problem, &ours.z);
        for (k, (sum, square)) in left.iter().zip(squares(&ours.x)).enumerate() {
            assert!((sum + square).abs() < 1e-6, "column {k}: {sum}, {square}");
        }
        for (k, row) in rows(&problem, &ours.x).iter().enumerate() {
            let (s, z) = (ours.s[k], ours.z[k]);
            let off = row + s - problem.bound[k];
            assert!(off.abs() < 1e-6, "row {k}: {off}");
            let at_floor = k < unknowns || (s >= 0.0 && z >= 0.0 && s * z < 1e-6);
            assert!(at_floor, "row {k}: {s}, {z}");
        }
        let floors = ours.z[unknowns..].iter().filter(|z| **z > 1e-3).count();
        assert!(floors > 20, "{floors} amounts at their floors");
        // Floors far below all amounts give the same result as floors at −100. With these, clarabel converges.
        problem.bound[unknowns..].iter_mut().for_each(|floor| *floor = floor.min(100.0));
        let theirs = crate::mechanics::solve::by_clarabel(&problem, Conditioning::Full.into());
        assert_eq!(theirs.status, Status::Solved);
        let cost = |x: &[f64]| 0.5 * product(x, &squares(x));
        let off = cost(&ours.x) - cost(&theirs.x);
        assert!(off.abs() < 1e-6 * cost(&theirs.x), "{off}");
    }
}
