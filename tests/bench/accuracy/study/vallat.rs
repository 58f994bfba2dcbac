//! [`vallat_program`]: the linear program of \[Vallat23\] in which every force may exceed its
//! limit at a high cost, exactly as published.

use drystone::internals::program::{Column, ContactTerm, Force, GripTerm, Program, QuadraticProgram, columns};

/// Returns the linear program of \[Vallat23\] §2.0.7–8, in which every force may exceed its limit
/// at the high cost β.
///
/// Every interface and every grip has six unknowns at cost 1. Each of these has an opposite partner at cost β. All
/// unknowns are at least 0. The constraints are A_eq x = b_eq, f⁺ + f⁻ ≤ μN per application point, and robot unknowns ≤
/// limit. This program is used only to measure how much a large β reduces speed and accuracy.
///
/// The order of the unknowns is N1, f1⁺, f1⁻, N2, f2⁺, f2⁻ for each interface, then Fx±, Fy±, M± for each grip, then
/// all opposite partners in the same order.
pub fn vallat_program(program: &Program, beta: f64) -> QuadraticProgram {
    let unknowns = source_unknowns(program);
    let n = unknowns.columns.len();
    let mut matrix = Vec::with_capacity(14 * n);
    for (j, column) in unknowns.columns.iter().enumerate() {
        for (row, value) in column {
            matrix.push((*row, j, *value));
            matrix.push((*row, n + j, -value));
        }
    }
    let mut bound = program.loads.clone();
    let equalities = bound.len();
    // Friction cone at each application point: f⁺ + f⁻ − μN ≤ 0.
    for (first, friction) in unknowns.cones {
        let row = bound.len();
        matrix.extend([(row, first, -friction), (row, first + 1, 1.0), (row, first + 2, 1.0)]);
        bound.push(0.0);
    }
    for (j, limit) in unknowns.limits.into_iter().filter(|l| l.1.is_finite()) {
        matrix.push((bound.len(), j, 1.0));
        bound.push(limit);
    }
    // All unknowns are at least 0.
    for j in 0..2 * n {
        matrix.push((bound.len(), j, -1.0));
        bound.push(0.0);
    }
    let linear = (0..2 * n).map(|j| if j < n { 1.0 } else { beta }).collect();
    QuadraticProgram { unknowns: 2 * n, quadratic: Vec::new(), linear, matrix, bound, equalities }
}

/// The unknowns of Vallat's program without their opposite partners.
struct SourceUnknowns {
    /// The coefficients of each unknown as (row, value) pairs.
    columns: Vec<Vec<(usize, f64)>>,
    /// For each application point: the index of its normal force, which is followed by two friction unknowns, and μ.
    cones: Vec<(usize, f64)>,
    /// For each robot unknown: its index and its limit.
    limits: Vec<(usize, f64)>,
}

/// Builds Vallat's unknowns from the columns of two auxiliary programs: one with friction coefficient 1, and one with
/// robots without limits.
fn source_unknowns(program: &Program) -> SourceUnknowns {
    let mut unknowns = SourceUnknowns { columns: Vec::new(), cones: Vec::new(), limits: Vec::new() };
    let rough = Program {
        contacts: (program.contacts.iter()).map(|contact| ContactTerm { friction: 1.0, ..*contact }).collect(),
        grips: Vec::new(),
        ..program.clone()
    };
    // With μ = 1 the three generators at a point are n̂, (n̂ + t̂)/2 and (n̂ − t̂)/2. The differences of the last two
    // are t̂ and −t̂.
    for generators in columns(&rough).chunks(3) {
        if let Force::Ray { contact, .. } = generators[0].force {
            let friction = program.contacts[contact].friction;
            unknowns.cones.push((unknowns.columns.len(), friction));
        }
        let [normal, left, right] = generators else { continue };
        unknowns.columns.extend([normal.entries().collect(), difference(left, right), difference(right, left)]);
    }
    let unlimited = Program {
        contacts: Vec::new(),
        grips: (program.grips.iter()).map(|grip| GripTerm { limits: [f64::INFINITY; 3], ..*grip }).collect(),
        ..program.clone()
    };
    for column in columns(&unlimited) {
        if let Force::Grip { grip, component, .. } = column.force {
            let limit = program.grips[grip].limits[component];
            unknowns.limits.push((unknowns.columns.len(), limit));
        }
        unknowns.columns.push(column.entries().collect());
    }
    unknowns
}

/// Returns the coefficients of one column minus those of another column.
fn difference(column: &Column, other: &Column) -> Vec<(usize, f64)> {
    let mut difference: Vec<(usize, f64)> = column.entries().collect();
    for (row, value) in other.entries() {
        match difference.iter_mut().find(|entry| entry.0 == row) {
            Some(entry) => entry.1 -= value,
            None => difference.push((row, -value)),
        }
    }
    difference
}
