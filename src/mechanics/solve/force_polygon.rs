//! [`force_polygon`]: all forces of a grip without limits with which the blocks stay balanced, as the corners and edges
//! of a polygon.
//!
//! The polygon is the projection of all balances onto the force F of the grip. One interior-point solution gives the
//! farthest force in a first direction n. Then the method walks around the polygon, from one basis of the simplex
//! method to the next (parametric objective, [GassSaaty55](crate::doc::references)):
//!
//! 1. For each column outside the basis, compute the change g of F for one unit of its amount. F is farthest in
//!    direction n if n·g ≤ 0 for all columns.
//! 2. Rotate n anticlockwise until n·g = 0 for some column. F is then farthest along the whole edge that begins at F,
//!    and the multipliers of the basis for this n are the motion beyond the edge.
//! 3. Move along the edge: increase the amount of this column until another amount reaches a bound.
//! 4. Repeat until n has turned by 360°.
//!
//! The results are candidates. The caller proves each force and each motion.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::basis_factor::SparseColumn;
use super::dual::from_kinematic_answer;
use super::limit::columns_in;
use super::reduced_columns::ReducedColumns;
use super::simplex::{Move, Simplex, Variable};
use super::{Amounts, Conditioning, Dual, Status, TOLERANCE, is_late, largest, solve};
use crate::geometry::{Vector, cross, quarter_turn};
use crate::program::{Column, Force, Program, kinematic_dual};

/// A corner of the polygon, and the edge that begins there, anticlockwise.
#[derive(Clone, Debug)]
pub struct PolygonCorner {
    /// Forces that balance the loads and contain the force of the corner, in program units.
    pub forces: Amounts,
    /// The outward unit normal of the edge.
    pub normal: Vector,
    /// The motion beyond the edge: three velocities for each block. The grip point has the velocity `normal`.
    pub motion: Vec<f64>,
}

/// The angle of the first direction, radians. It is the normal of an edge only by chance, unlike the axes.
const FIRST_ANGLE: f64 = 0.7;

/// Changes of F up to this per unit of an amount are rounding. Most changes are near 1, and their rounding is about
/// 1e-13. With 1e-11, rounding could choose a column; with 1e-7, edges of columns with little influence would be
/// missed.
const MIN_CHANGE: f64 = 1e-9;

/// Normals that differ by at most this angle, in radians, belong to one edge. The error of a corner is at most this
/// angle times the length of an edge. With 1e-11, rounding would divide edges; with 1e-7, corners could be lost.
const SAME_ANGLE: f64 = 1e-9;

/// A corner is new if it is at least this far from the last one, relative to the largest force so far. The tolerance of
/// the polygon is about a hundred times as large.
const SAME_FORCE: f64 = 1e-9;

/// The walk has at most this many moves for each row of the program.
const MAX_MOVES_PER_ROW: usize = 20;

/// Returns the corners of the polygon of all forces that `grip` can exert, anticlockwise. `None` if the polygon is
/// unbounded or empty, or if the walk fails.
pub fn force_polygon(program: &Program, grip: usize) -> Option<Vec<PolygonCorner>> {
    let mut walk = Walk::new(program, grip)?;
    walk.to_vertex()?;
    walk.to_farthest()?;
    walk.around()
}

struct Walk<'a> {
    program: &'a Program,
    /// The magnitude of the largest load, in program units. The amounts of the simplex method are relative to it.
    load: f64,
    /// The force of each variable of the simplex method.
    forces: Vec<Force>,
    /// The position of each row of the program in the order of elimination.
    position: Vec<usize>,
    simplex: Simplex,
    /// The variables of the two components of the grip force.
    own: [usize; 2],
    /// The present direction, a unit vector.
    normal: Vector,
    moves_left: usize,
}

impl<'a> Walk<'a> {
    /// Finds an optimum in the first direction by an interior-point method, and a basis that contains as many columns of
    /// this optimum as possible.
    fn new(program: &'a Program, grip: usize) -> Option<Walk<'a>> {
        let load = match largest(&program.loads) {
            0.0 => 1.0,
            load => load,
        };
        let (sin, cos) = libm::sincos(FIRST_ANGLE);
        let normal = Vector::new(cos, sin);
        let loads: Vec<f64> = program.loads.iter().map(|v| v / load).collect();
        let columns = ReducedColumns::new(&columns_in(program, load)).columns;
        let optimum = farthest(&loads, &columns, grip, normal)?;
        let position = elimination_order(&columns, program.blocks)?;
        let mut variables = Vec::with_capacity(columns.len() + loads.len());
        let (mut forces, mut ranks) = (Vec::new(), Vec::new());
        let mut own = [usize::MAX; 2];
        let is_active = optimum.active(1.0);
        for (k, column) in columns.iter().enumerate() {
            let mut variable = Variable {
                column: placed(column, &position),
                lower: 0.0,
                upper: column.limit,
                amount: 0.0,
            };
            let mut rank = usize::from(!is_active[k]);
            if is_active[k] {
                variable.amount = optimum.amounts[k].min(column.limit);
            }
            // The two directions of a grip component become one variable.
            if let Force::Grip { grip: g, component, sign } = column.force {
                if sign < 0.0 {
                    continue;
                }
                variable.lower = -column.limit;
                variable.amount = optimum.amounts[k] - optimum.amounts[k + 1];
                variable.amount = variable.amount.clamp(-column.limit, column.limit);
                rank = 0;
                if g == grip && component < 2 {
                    own[component] = variables.len();
                }
            }
            variables.push(variable);
            forces.push(column.force);
            ranks.push(rank);
        }
        let mut placed_loads = vec![0.0; loads.len()];
        for (load, position) in loads.iter().zip(&position) {
            placed_loads[*position] = *load;
        }
        let moves_left = MAX_MOVES_PER_ROW * loads.len();
        let simplex = Simplex::new(variables, placed_loads, |k| ranks[k]);
        let walk = Walk {
            program,
            load,
            forces,
            position,
            simplex,
            own,
            normal,
            moves_left,
        };
        // An amount without limits must be basic: outside the basis it could not change.
        let free = (0..walk.forces.len()).filter(|k| {
            let variable = &walk.simplex.variables[*k];
            variable.lower == f64::NEG_INFINITY && variable.upper == f64::INFINITY
        });
        let mut free = free;
        free.all(|k| walk.simplex.is_basic(k)).then_some(walk)
    }

    /// Moves every amount outside the basis to a bound (crossover to a vertex, [Megiddo91](crate::doc::references)).
    fn to_vertex(&mut self) -> Option<()> {
        for k in 0..self.forces.len() {
            let variable = &self.simplex.variables[k];
            let is_at_bound = variable.amount == variable.lower || variable.amount == variable.upper;
            if !self.simplex.is_basic(k) && !is_at_bound {
                self.move_amount(k, -1.0)?;
            }
        }
        Some(())
    }

    /// Moves to a farthest force in the present direction: the primal simplex method. The interior-point method is
    /// accurate to about nine digits, so few moves remain.
    fn to_farthest(&mut self) -> Option<()> {
        loop {
            let changes = self.changes();
            let gain = |change: &Change| change.force.dot(&self.normal);
            let best = changes.iter().max_by(|a, b| gain(a).total_cmp(&gain(b)));
            match best.filter(|change| gain(change) > MIN_CHANGE) {
                Some(change) => self.move_amount(change.variable, change.sign)?,
                None => return Some(()),
            }
        }
    }

    /// Walks around the polygon once, anticlockwise.
    fn around(&mut self) -> Option<Vec<PolygonCorner>> {
        let mut corners: Vec<PolygonCorner> = Vec::new();
        let (mut turned, mut last_turned) = (0.0, f64::NEG_INFINITY);
        let mut size = self.force().norm();
        loop {
            // Steps 1 and 2: rotate to the normal of the next edge.
            let (turn, change) = self.next_edge()?;
            turned += turn;
            if turned >= TAU - SAME_ANGLE {
                return Some(corners);
            }
            self.normal = -quarter_turn(change.force.normalize());
            // Step 3: move along the edge.
            let before = self.force();
            let is_new = turned > last_turned + SAME_ANGLE;
            let corner = is_new.then(|| self.corner());
            self.move_amount(change.variable, change.sign)?;
            let after = self.force();
            size = size.max(after.norm());
            if let Some(corner) = corner.filter(|_| (after - before).norm() > SAME_FORCE * size) {
                last_turned = turned;
                corners.push(corner);
            }
        }
    }

    /// Returns the next edge anticlockwise: the angle to its normal, in radians, and the column that changes along it.
    /// `None` if no column changes the force.
    fn next_edge(&self) -> Option<(f64, Change)> {
        let tangent = quarter_turn(self.normal);
        let turns = self.changes().into_iter().map(|change| {
            let turn = libm::atan2(cross(tangent, change.force), tangent.dot(&change.force));
            // Rounding may rotate the edge that has just been walked beyond 180°, and any other edge below 0.
            match turn < -FRAC_PI_2 {
                true => (turn + TAU, change),
                false => (turn.max(0.0), change),
            }
        });
        let turns: Vec<(f64, Change)> = turns.collect();
        let least = turns.iter().map(|(turn, _)| *turn).reduce(f64::min)?;
        // Of the columns for the same edge, take the one with the largest change of the force.
        let first = turns.into_iter().filter(|(turn, _)| *turn <= least + SAME_ANGLE);
        let next = first.max_by(|(_, a), (_, b)| a.force.norm().total_cmp(&b.force.norm()));
        next.filter(|(turn, _)| *turn < PI + SAME_ANGLE)
    }

    /// Returns the changes of the force for all columns outside the basis that influence it.
    fn changes(&self) -> Vec<Change> {
        let [x, y] = self.own.map(|own| self.simplex.multipliers(own));
        let change = |k: usize| {
            let variable = &self.simplex.variables[k];
            if self.simplex.is_basic(k) || variable.lower == variable.upper {
                return None;
            }
            let sign = if variable.amount < variable.upper { 1.0 } else { -1.0 };
            let mut force = Vector::zeros();
            for (row, value) in &variable.column {
                force -= Vector::new(x[*row], y[*row]) * (sign * value);
            }
            (force.norm() > MIN_CHANGE).then_some(Change {
                variable: k,
                sign,
                force,
            })
        };
        (0..self.forces.len()).filter_map(change).collect()
    }

    fn move_amount(&mut self, variable: usize, sign: f64) -> Option<()> {
        self.moves_left = self.moves_left.checked_sub(1)?;
        let moved = self.simplex.move_amount(variable, sign)?;
        (moved == Move::Done && !is_late() && self.force().norm().is_finite()).then_some(())
    }

    /// Returns the present force of the grip, relative to the largest load.
    fn force(&self) -> Vector {
        let [x, y] = self.own.map(|own| self.simplex.variables[own].amount);
        Vector::new(x, y)
    }

    /// Returns the present corner, with the edge whose normal is the present direction.
    fn corner(&self) -> PolygonCorner {
        let mut forces = Amounts::zero(self.program);
        for (force, variable) in self.forces.iter().zip(&self.simplex.variables) {
            if variable.amount != 0.0 {
                forces.add(*force, variable.amount * self.load);
            }
        }
        let [x, y] = self.own.map(|own| self.simplex.multipliers(own));
        let velocity = |position: &usize| x[*position] * self.normal.x + y[*position] * self.normal.y;
        PolygonCorner {
            forces,
            normal: self.normal,
            motion: self.position.iter().map(velocity).collect(),
        }
    }
}

/// How the force of the grip changes with the amount of a column outside the basis.
struct Change {
    variable: usize,
    /// 1 if the amount can only increase, −1 if it can only decrease.
    sign: f64,
    /// The change of the force per unit.
    force: Vector,
}

/// Finds the farthest force of a grip in a direction. `None` if there is no farthest force, or if the solver ends
/// without a result.
fn farthest(loads: &[f64], columns: &[Column], grip: usize, direction: Vector) -> Option<Dual> {
    let cost = |column: &Column| match column.force {
        Force::Grip { grip: g, component, sign } if g == grip && component < 2 => {
            -sign * direction[component]
        }
        _ => 0.0,
    };
    let (problem, row_of) = kinematic_dual(loads, columns, cost);
    let answer = solve(&problem, TOLERANCE, Conditioning::Plain);
    let optimum = from_kinematic_answer(loads, columns, &problem, &row_of, &answer);
    (answer.status == Status::Solved).then_some(optimum)
}

/// Returns the position of each row in an order of elimination with little fill-in (approximate minimum degree,
/// Amestoy, Davis and Duff 1996). `None` if no order is found.
fn elimination_order(columns: &[Column], blocks: usize) -> Option<Vec<usize>> {
    // The neighbours of each block: the blocks that share a column with it, itself included.
    let mut neighbours: Vec<Vec<i32>> = (0..blocks).map(|k| vec![k as i32]).collect();
    for column in columns {
        let of_column = || column.entries().map(|(row, _)| row / 3);
        for block in of_column() {
            neighbours[block].extend(of_column().map(|other| other as i32));
        }
    }
    let (mut starts, mut list) = (vec![0], Vec::new());
    for mut of_block in neighbours {
        of_block.sort_unstable();
        of_block.dedup();
        list.append(&mut of_block);
        starts.push(list.len() as i32);
    }
    let order = amd::order(blocks as i32, &starts, &list, &amd::Control::default());
    let mut position = vec![0; 3 * blocks];
    for (place, block) in order.ok()?.0.iter().enumerate() {
        for row in 0..3 {
            position[3 * *block as usize + row] = 3 * place + row;
        }
    }
    Some(position)
}

/// Returns the coefficients of a column, in the order of elimination.
fn placed(column: &Column, position: &[usize]) -> SparseColumn {
    let entries = column.entries().map(|(row, value)| (position[row], value));
    let mut entries: SparseColumn = entries.collect();
    entries.sort_unstable_by_key(|entry| entry.0);
    entries
}
