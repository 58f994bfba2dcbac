//! The forms in which a program is handed to the conic solver.
//!
//! [`QuadraticProgram`]: min ½ xᵀPx + qᵀx  s.t.  the first `equalities` rows Ax = b, the others Ax ≤ b. Poses never mention metres.

use super::{Column, Force, Program, columns};

/// A problem for the conic solver, matrices as (row, column, value) lists.
#[derive(Clone, Debug)]
pub struct QuadraticProgram {
    /// Unknowns.
    pub unknowns: usize,
    /// Upper triangle of P.
    pub quadratic: Vec<(usize, usize, f64)>,
    /// q.
    pub linear: Vec<f64>,
    /// A.
    pub matrix: Vec<(usize, usize, f64)>,
    /// b.
    pub bound: Vec<f64>,
    /// How many of the first rows are equalities.
    pub equalities: usize,
}

/// The kinematic dual: max loadsᵀy  s.t.  columnᵀy ≤ cost for every column; its multipliers are the forces.
///
/// Three unknowns per block and one row per column. A limited column gets one more unknown w ≥ 0: columnᵀy − w ≤ cost, at
/// −limit·w in the objective. A pair of columns ± with cost 0 and no limit is one equality. Rows stand in the columns'
/// order, so that the dual of row k is the amount of column k; a pair's equality carries the amount of the first less the
/// second.
pub fn kinematic_dual(
    loads: &[f64],
    columns: &[Column],
    cost: impl Fn(&Column) -> f64,
) -> (QuadraticProgram, Vec<usize>) {
    let mut conic = QuadraticProgram {
        unknowns: loads.len(),
        quadratic: Vec::new(),
        linear: loads.iter().map(|v| -v).collect(),
        matrix: Vec::with_capacity(columns.len() * 6),
        bound: Vec::with_capacity(columns.len()),
        equalities: 0,
    };
    let mut row_of = vec![usize::MAX; columns.len()];
    let free = |k: usize| match (columns[k].force, columns.get(k + 1).map(|c| c.force)) {
        // A grip's two signs stand side by side, + first.
        (
            Force::Grip {
                grip,
                component,
                sign,
            },
            Some(next),
        ) => {
            let partner = Force::Grip {
                grip,
                component,
                sign: -1.0,
            };
            sign > 0.0
                && next == partner
                && columns[k].limit.is_infinite()
                && cost(&columns[k]) == 0.0
        }
        _ => false,
    };
    let mut k = 0;
    while k < columns.len() {
        if free(k) {
            let row = conic.bound.len();
            conic
                .matrix
                .extend(columns[k].entries().map(|(i, v)| (row, i, v)));
            conic.bound.push(0.0);
            row_of[k] = row;
            k += 1;
        }
        k += 1;
    }
    conic.equalities = conic.bound.len();
    let mut k = 0;
    while k < columns.len() {
        if row_of[k] != usize::MAX {
            k += 2;
            continue;
        }
        let row = conic.bound.len();
        conic
            .matrix
            .extend(columns[k].entries().map(|(i, v)| (row, i, v)));
        conic.bound.push(cost(&columns[k]));
        row_of[k] = row;
        k += 1;
    }
    for (k, column) in columns.iter().enumerate() {
        if column.limit.is_finite() {
            let w = conic.unknowns;
            conic.unknowns += 1;
            conic.linear.push(column.limit);
            conic.matrix.push((row_of[k], w, -1.0));
            conic.matrix.push((conic.bound.len(), w, -1.0));
            conic.bound.push(0.0);
        }
    }
    (conic, row_of)
}

/// The dual of  max λ  s.t.  Σ amount·column = loads + λ·toward:  max loadsᵀy  s.t.  columnᵀy ≤ 0, towardᵀy ≥ 1.
///
/// The last row is the one of λ: its dual is the largest λ ≥ 0.
pub fn load_factor_dual(
    loads: &[f64],
    toward: &[f64],
    columns: &[Column],
) -> (QuadraticProgram, Vec<usize>) {
    let (mut conic, row_of) = kinematic_dual(loads, columns, |_| 0.0);
    let row = conic.bound.len();
    let entries = toward.iter().enumerate().filter(|(_, v)| **v != 0.0);
    conic.matrix.extend(entries.map(|(i, v)| (row, i, -v)));
    conic.bound.push(-1.0);
    (conic, row_of)
}

/// The dual of  min |λ|  s.t.  Σ amount·column = loads + λ·toward:  max loadsᵀy  s.t.  columnᵀy ≤ 0, −1 ≤ towardᵀy ≤ 1.
///
/// The last two rows are those of λ: the dual of the first less that of the second is λ.
pub fn nearest_factor_dual(
    loads: &[f64],
    toward: &[f64],
    columns: &[Column],
) -> (QuadraticProgram, Vec<usize>) {
    let (mut conic, row_of) = kinematic_dual(loads, columns, |_| 0.0);
    for sign in [-1.0, 1.0] {
        let row = conic.bound.len();
        let entries = toward.iter().enumerate().filter(|(_, v)| **v != 0.0);
        conic
            .matrix
            .extend(entries.map(|(i, v)| (row, i, sign * v)));
        conic.bound.push(1.0);
    }
    (conic, row_of)
}

/// The dual of  min Σ |what is left unbalanced|:  max loadsᵀy  s.t.  columnᵀy ≤ 0, −1 ≤ y ≤ 1.
///
/// It has an optimum whether the program stands or falls, and both stories in it: forces that leave least, and the motion
/// of largest power.
pub fn least_residual_dual(loads: &[f64], columns: &[Column]) -> (QuadraticProgram, Vec<usize>) {
    let (mut conic, row_of) = kinematic_dual(loads, columns, |_| 0.0);
    for row in 0..loads.len() {
        for sign in [1.0, -1.0] {
            conic.matrix.push((conic.bound.len(), row, sign));
            conic.bound.push(1.0);
        }
    }
    (conic, row_of)
}

/// The shortest change d of velocities:  min ½ |d|²  s.t.  columnᵀd = value for the first `equalities` of the columns, and
/// columnᵀd ≥ value for the others.
pub fn least_change(
    unknowns: usize,
    columns: &[(&Column, f64)],
    equalities: usize,
) -> QuadraticProgram {
    let mut conic = QuadraticProgram {
        unknowns,
        quadratic: (0..unknowns).map(|i| (i, i, 1.0)).collect(),
        linear: vec![0.0; unknowns],
        matrix: Vec::with_capacity(6 * columns.len()),
        bound: Vec::with_capacity(columns.len()),
        equalities,
    };
    for (row, (column, value)) in columns.iter().enumerate() {
        // The solver's inequalities are of the other kind, Ax ≤ b.
        let sign = if row < equalities { 1.0 } else { -1.0 };
        let entries = column.entries();
        conic
            .matrix
            .extend(entries.map(|(i, v)| (row, i, sign * v)));
        conic.bound.push(sign * value);
    }
    conic
}

/// The amounts of least Σ amount², of either sign, that give `loads`.
pub fn least_norm(loads: &[f64], columns: &[Column]) -> QuadraticProgram {
    let entries = columns.iter().enumerate();
    QuadraticProgram {
        unknowns: columns.len(),
        quadratic: (0..columns.len()).map(|i| (i, i, 1.0)).collect(),
        linear: vec![0.0; columns.len()],
        matrix: entries
            .flat_map(|(j, column)| column.entries().map(move |(row, value)| (row, j, value)))
            .collect(),
        bound: loads.to_vec(),
        equalities: loads.len(),
    }
}

/// Amounts to be corrected by `size` times the unknowns.
#[derive(Clone, Copy, Debug)]
pub struct Correction<'a> {
    /// The amounts so far.
    pub amounts: &'a [f64],
    /// What one unit of an unknown stands for.
    pub size: f64,
}

/// The forces of least Σ force² among the amounts ≥ 0 of the given columns that give `loads`.
///
/// With a `correction` the unknowns are changes to given amounts, and the squares are those of the changes of each column:
/// the squares of forces leave columns that undo each other, such as a robot's push and pull, without bound, and where both
/// may be changed the solver ends without a status.
/// Else the squares are those of N1, N2, T of each contact and of each component of a grip, not of the generators, so the
/// answer does not depend on how a cone is written.
pub fn least_squares(
    loads: &[f64],
    columns: &[Column],
    correction: Option<Correction>,
) -> QuadraticProgram {
    let mut quadratic = Vec::new();
    if correction.is_some() {
        quadratic.extend((0..columns.len()).map(|j| (j, j, 1.0)));
    }
    // Columns of one contact stand side by side; products reach back only to the contact's first column.
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
        let (floor, size) = correction.map_or((0.0, 1.0), |c| (c.amounts[j] / c.size, c.size));
        matrix.push((bound.len(), j, -1.0));
        bound.push(floor);
        if column.limit.is_finite() {
            matrix.push((bound.len(), j, 1.0));
            bound.push(column.limit / size - floor);
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

/// A second sum and the most it may come to.
pub type CostCap<'a> = (&'a dyn Fn(&Column) -> f64, f64);

/// The forces themselves as unknowns: min Σ cost·amount  s.t.  they balance `loads`, 0 ≤ amount ≤ limit.
///
/// With a [`CostCap`] = (cost, most) a second sum is bounded, Σ cost·amount ≤ most: the second stage of a lexicographic program.
/// Kept, like [`source`], to show what the kinematic dual saves.
pub fn force_primal(
    loads: &[f64],
    columns: &[Column],
    cost: impl Fn(&Column) -> f64,
    cap: Option<CostCap>,
) -> QuadraticProgram {
    let mut conic = least_squares(loads, columns, None);
    conic.quadratic.clear();
    conic.linear = columns.iter().map(cost).collect();
    if let Some((cost, most)) = cap {
        let row = conic.bound.len();
        let entries = columns.iter().enumerate().map(|(j, c)| (row, j, cost(c)));
        conic.matrix.extend(entries.filter(|e| e.2 != 0.0));
        conic.bound.push(most);
    }
    conic
}

/// Inner product of two columns in (N1, N2, T) of one contact or in one grip component; `None` for different places.
pub(crate) fn product(a: &Force, b: &Force) -> Option<f64> {
    match (*a, *b) {
        (
            Force::Ray {
                contact: c,
                point: p,
                normal: m,
                friction: s,
            },
            Force::Ray {
                contact: d,
                point: q,
                normal: n,
                friction: t,
            },
        ) if c == d => Some(if p == q { m * n } else { 0.0 } + s * t),
        (
            Force::Grip {
                grip: g,
                component: c,
                sign: s,
            },
            Force::Grip {
                grip: h,
                component: d,
                sign: t,
            },
        )
        | (
            Force::StickGrip {
                grip: g,
                component: c,
                sign: s,
            },
            Force::StickGrip {
                grip: h,
                component: d,
                sign: t,
            },
        ) if g == h => Some(if c == d { s * t } else { 0.0 }),
        (
            Force::StickNormal {
                contact: c,
                point: p,
            },
            Force::StickNormal {
                contact: d,
                point: q,
            },
        ) if c == d => Some(f64::from(u8::from(p == q))),
        (
            Force::StickFriction {
                contact: c,
                sign: s,
            },
            Force::StickFriction {
                contact: d,
                sign: t,
            },
        ) if c == d => Some(s * t),
        (Force::StickNormal { contact: c, .. }, Force::StickFriction { contact: d, .. })
            if c == d =>
        {
            Some(0.0)
        }
        _ => None,
    }
}

/// The source's soft program exactly as posed ([Vallat23](crate::doc::references) §2.0.7–8): six unknowns per
/// interface and per grip, each with an
/// opposite partner at cost β, all ≥ 0; rows A_eq x = b_eq, f⁺ + f⁻ ≤ μN per corner, robot unknowns ≤ limit.
///
/// It is kept to show what β costs in time and digits; nothing else rests on it. The unknowns stand interface by
/// interface as N1, f1⁺, f1⁻, N2, f2⁺, f2⁻, then grip by grip as Fx±, Fy±, M±, then all partners.
pub fn vallat_program(program: &Program, beta: f64) -> QuadraticProgram {
    let mut posed: Vec<Column> = Vec::new();
    let mut cones: Vec<(usize, f64)> = Vec::new();
    let mut limits: Vec<(usize, f64)> = Vec::new();
    let smooth = Program {
        grips: Vec::new(),
        ..program.clone()
    };
    let rough = Program {
        contacts: smooth
            .contacts
            .iter()
            .map(|c| super::ContactTerm {
                friction: 1.0,
                ..*c
            })
            .collect(),
        ..smooth
    };
    // With μ = 1 the generators n̂, (n̂ + t̂)/2, (n̂ − t̂)/2 of a point give t̂ and −t̂ back as differences.
    for chunk in columns(&rough).chunks(3) {
        if let Force::Ray { contact, .. } = chunk[0].force {
            cones.push((posed.len(), program.contacts[contact].friction));
        }
        posed.extend([chunk[0], chunk[1].less(&chunk[2]), chunk[2].less(&chunk[1])]);
    }
    let full = super::Program {
        contacts: Vec::new(),
        grips: program
            .grips
            .iter()
            .map(|g| super::GripTerm {
                limits: [f64::INFINITY; 3],
                ..*g
            })
            .collect(),
        ..program.clone()
    };
    for column in columns(&full) {
        if let Force::Grip {
            grip, component, ..
        } = column.force
        {
            limits.push((posed.len(), program.grips[grip].limits[component]));
        }
        posed.push(column);
    }
    let n = posed.len();
    let mut matrix = Vec::with_capacity(14 * n);
    for (j, column) in posed.iter().enumerate() {
        for (row, value) in column.entries() {
            matrix.push((row, j, value));
            matrix.push((row, n + j, -value));
        }
    }
    let mut bound = program.loads.clone();
    let equalities = bound.len();
    for (first, friction) in cones {
        let row = bound.len();
        matrix.extend([
            (row, first, -friction),
            (row, first + 1, 1.0),
            (row, first + 2, 1.0),
        ]);
        bound.push(0.0);
    }
    for (j, limit) in limits.into_iter().filter(|l| l.1.is_finite()) {
        matrix.push((bound.len(), j, 1.0));
        bound.push(limit);
    }
    for j in 0..2 * n {
        matrix.push((bound.len(), j, -1.0));
        bound.push(0.0);
    }
    let linear = (0..2 * n).map(|j| if j < n { 1.0 } else { beta }).collect();
    QuadraticProgram {
        unknowns: 2 * n,
        quadratic: Vec::new(),
        linear,
        matrix,
        bound,
        equalities,
    }
}
