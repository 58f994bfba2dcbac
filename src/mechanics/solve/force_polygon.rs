//! [`force_polygon`]: all forces that a grip without force limits can exert in equilibrium, as corners and edges.
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
//! 4. Repeat until n has turned by 360°, or until an edge is unbounded. In the second case, also walk clockwise.
//!
//! The results are candidates. The caller proves each force and each motion.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::basis_factor::{elimination_order, placed};
use super::limit::farthest_cost;
use super::scaled::ScaledProgram;
use super::simplex::{MIN_PIVOT, Move, Simplex, Variable};
use super::{Amounts, Conditioning, Effort, Optimum, Status, is_late};
use crate::geometry::{Vector, cross, quarter_turn};
use crate::mechanics::program::{Aim, Column, Force, Program};

/// All forces of a grip: a convex polygon, which may be unbounded on one side.
#[derive(Clone, Debug)]
pub struct ForcePolygon {
    /// The corners, anticlockwise, and with each corner an edge that begins or ends there. If the polygon is unbounded,
    /// the edges of the first and the last corner are unbounded.
    pub corners: Vec<PolygonCorner>,
    /// If the polygon is unbounded: two balances. The force of the grip is far along the first edge in the first of
    /// them, and far along the last edge in the second.
    pub far: Option<[Amounts; 2]>,
}

/// A corner of the polygon, and one of its two edges.
#[derive(Clone, Debug)]
pub struct PolygonCorner {
    /// Forces that balance the loads, in program units. The force of the grip is the corner.
    pub forces: Amounts,
    /// The outward unit normal of the edge.
    pub normal: Vector,
    /// The motion of the blocks beyond the edge: three velocities for each block. The grip point moves by `normal`.
    pub motion: Vec<f64>,
}

/// The angles, in radians, that are tried in turn for the first direction, until the polygon has a farthest force in
/// this direction. The first angle points upwards, because most blocks can carry any force that presses them down. The
/// angles are normals of edges only by chance, unlike the axes. They are 60° apart, so one of them suits every polygon
/// that is unbounded in a range of directions of at most 120°.
const FIRST_ANGLES: [f64; 6] = [1.747, 0.7, 2.794, -0.347, -2.442, -1.395];

/// Normals that differ by at most this angle, in radians, belong to one edge. The error of a corner is at most this
/// angle times the length of an edge. With 1e-11, rounding would divide edges; with 1e-7, corners could be lost.
const SAME_ANGLE: f64 = 1e-9;

/// A corner is new if it is at least this far from the last one, relative to the largest force so far. The tolerance of
/// the polygon is about a hundred times as large.
const SAME_FORCE: f64 = 1e-9;

/// The walk has at most this many moves for each row of the program. A wall of 250 bricks needs up to 8. With a tenth
/// of this value, walls would need the slower method, one program for each direction; with ten times this value, a walk
/// that does not end would take long.
const MAX_MOVES_PER_ROW: usize = 20;

/// Which way the walk goes around the polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    Anticlockwise,
    Clockwise,
}

impl Turn {
    fn sign(self) -> f64 {
        match self {
            Turn::Anticlockwise => 1.0,
            Turn::Clockwise => -1.0,
        }
    }
}

/// Returns the polygon of all forces that the grip with the index `grip` can exert while every block stays balanced.
/// `None` if no force balances the loads, if the polygon is unbounded in too many directions, or if the walk fails.
pub fn force_polygon(program: &Program, grip: usize) -> Option<ForcePolygon> {
    let mut walk = first_basis(program, grip)?;
    walk.reach_vertex()?;
    walk.reach_farthest()?;
    let mut other_way = walk.clone();
    let (after, far) = walk.around(Turn::Anticlockwise)?;
    let Some(last_far) = far else {
        return Some(ForcePolygon { corners: after, far: None });
    };
    // The polygon is unbounded. Also walk clockwise from the first corner, to the other unbounded edge.
    let (mut corners, first_far) = other_way.around(Turn::Clockwise)?;
    corners.reverse();
    corners.extend(after);
    Some(ForcePolygon { corners, far: Some([first_far?, last_far]) })
}

/// Finds a farthest force by an interior-point method, and a basis with as many columns of this optimum as possible.
/// `None` if there is no farthest force in any direction that is tried, or if no suitable basis is found.
fn first_basis(program: &Program, grip: usize) -> Option<Walk<'_>> {
    let scaled = ScaledProgram::new(program);
    let ScaledProgram { load, loads, columns, .. } = &scaled;
    let position = elimination_order(columns, program.blocks)?;
    let mut placed_loads = vec![0.0; loads.len()];
    for (load, position) in loads.iter().zip(&position) {
        placed_loads[*position] = *load;
    }
    let (normal, optimum) = first_optimum(&scaled, grip)?;
    let unknowns = unknowns(columns, &optimum, &position);
    let own = |component: usize| {
        let is_own = |force: &Force| {
            matches!(
                *force,
                Force::Grip { grip: g, component: c, .. } if (g, c) == (grip, component)
            )
        };
        unknowns.iter().position(|unknown| is_own(&unknown.force))
    };
    let own = [own(0)?, own(1)?];
    let variables = unknowns.iter().map(|u| u.variable.clone()).collect();
    let simplex = Simplex::new(variables, placed_loads, |k| unknowns[k].rank);
    // A column without bounds must be basic: the amount of a column outside the basis stays at one of its bounds.
    let is_free = |v: &Variable| v.lower == f64::NEG_INFINITY && v.upper == f64::INFINITY;
    let mut free = (0..unknowns.len()).filter(|k| is_free(&unknowns[*k].variable));
    free.all(|k| simplex.is_basic(k)).then(|| Walk {
        program,
        load: *load,
        forces: unknowns.iter().map(|unknown| unknown.force).collect(),
        moves_left: MAX_MOVES_PER_ROW * loads.len(),
        position,
        simplex,
        own,
        normal,
    })
}

/// Tries the directions [`FIRST_ANGLES`] in turn until there is a farthest force of the grip in this direction. Returns
/// the direction and the optimum. `None` if there is no such direction, if no force balances the loads, or if the
/// solver ends without a result.
fn first_optimum(scaled: &ScaledProgram, grip: usize) -> Option<(Vector, Optimum)> {
    for angle in FIRST_ANGLES {
        let (sin, cos) = libm::sincos(angle);
        let direction = Vector::new(cos, sin);
        let cost = farthest_cost(grip, direction);
        let optimum = scaled.solve(&Aim::Least(&cost), [Conditioning::Plain.into()], &mut Effort::default());
        match optimum.status {
            Status::Solved => return Some((direction, optimum)),
            // Forces of any size are possible in this direction.
            Status::Infeasible => {}
            Status::Unbounded | Status::Unsolved => return None,
        }
    }
    None
}

/// A column as an unknown of the simplex method.
struct Unknown {
    force: Force,
    variable: Variable,
    /// Unknowns with a smaller rank are preferred for the first basis.
    rank: usize,
}

/// Returns the unknowns of the simplex method with their amounts at an optimum. The two directions of a grip component
/// become one unknown, whose amount may be negative.
fn unknowns(columns: &[Column], optimum: &Optimum, position: &[usize]) -> Vec<Unknown> {
    let is_active = optimum.active(1.0);
    let unknown = |(k, column): (usize, &Column)| {
        let (lower, amount, rank) = match column.force {
            Force::Grip { sign, .. } if sign < 0.0 => return None,
            Force::Grip { .. } => {
                let amount = optimum.amounts[k] - optimum.amounts[k + 1];
                (-column.limit, amount.max(-column.limit), 0)
            }
            _ if is_active[k] => (0.0, optimum.amounts[k], 0),
            _ => (0.0, 0.0, 1),
        };
        Some(Unknown {
            force: column.force,
            variable: Variable {
                column: placed(column, position),
                lower,
                upper: column.limit,
                amount: amount.min(column.limit),
            },
            rank,
        })
    };
    columns.iter().enumerate().filter_map(unknown).collect()
}

/// The state of the walk around the polygon: a basis whose force of the grip is the farthest in the direction `normal`,
/// and thus the present corner.
#[derive(Clone)]
struct Walk<'a> {
    program: &'a Program,
    /// The magnitude of the largest load, in program units. The amounts of the simplex method are relative to it.
    load: f64,
    /// The force of each unknown of the simplex method.
    forces: Vec<Force>,
    /// The position of each row of the program in the order of elimination.
    position: Vec<usize>,
    simplex: Simplex,
    /// The unknowns of the two components of the grip force.
    own: [usize; 2],
    /// The present direction, a unit vector.
    normal: Vector,
    moves_left: usize,
}

impl Walk<'_> {
    /// Moves amounts outside the basis to a bound (crossover, [Megiddo91](crate::doc::references)); `None` if it fails.
    fn reach_vertex(&mut self) -> Option<()> {
        for k in 0..self.forces.len() {
            let variable = &self.simplex.variables[k];
            let is_at_bound = variable.amount == variable.lower || variable.amount == variable.upper;
            if !self.simplex.is_basic(k) && !is_at_bound {
                let force = Vector::zeros();
                let (variable, sign) = (k, -1.0);
                self.move_to_end(&Change { variable, sign, force })?;
            }
        }
        Some(())
    }

    /// Moves to a farthest force in the present direction, by the primal simplex method. The start from the
    /// interior-point method is accurate to about nine digits, so few moves are needed. `None` if the walk must end.
    fn reach_farthest(&mut self) -> Option<()> {
        loop {
            let changes = self.changes();
            let gain = |change: &Change| change.force.dot(&self.normal);
            let best = changes.iter().max_by(|a, b| gain(a).total_cmp(&gain(b)));
            match best.filter(|change| gain(change) > MIN_PIVOT) {
                Some(change) => self.move_to_end(change)?,
                None => return Some(()),
            }
        }
    }

    /// Walks around the polygon once, or to an unbounded edge. Returns the corners with the edges along which the walk
    /// left them, and, if an edge is unbounded, forces far along it. `None` if the walk fails.
    fn around(&mut self, way: Turn) -> Option<(Vec<PolygonCorner>, Option<Amounts>)> {
        let mut corners: Vec<PolygonCorner> = Vec::new();
        let (mut turned, mut last_turned) = (0.0, f64::NEG_INFINITY);
        let mut size = self.force().norm();
        loop {
            // Steps 1 and 2: rotate to the normal of the next edge.
            let (turn, change) = self.next_edge(way)?;
            turned += turn;
            if turned >= TAU - SAME_ANGLE {
                return Some((corners, None));
            }
            self.normal = -quarter_turn(change.force.normalize()) * way.sign();
            // Step 3: move along the edge.
            let before = self.force();
            let is_new = turned > last_turned + SAME_ANGLE;
            let corner = is_new.then(|| self.corner());
            if self.move_amount(&change)? == Move::Endless {
                corners.extend(corner);
                let length = size.max(1.0) / change.force.norm();
                self.simplex.step(change.variable, change.sign * length);
                return Some((corners, Some(self.amounts())));
            }
            let after = self.force();
            size = size.max(after.norm());
            if let Some(corner) = corner.filter(|_| (after - before).norm() > SAME_FORCE * size) {
                last_turned = turned;
                corners.push(corner);
            }
        }
    }

    /// Returns the next edge: the angle from the present direction to the normal of this edge, in radians, and the
    /// column that changes along the edge. `None` if no column changes the force, or if the angle would be more than
    /// 180°.
    fn next_edge(&self, way: Turn) -> Option<(f64, Change)> {
        let tangent = quarter_turn(self.normal) * way.sign();
        let turns = self.changes().into_iter().map(|change| {
            let across = way.sign() * cross(tangent, change.force);
            let turn = libm::atan2(across, tangent.dot(&change.force));
            // The edge that has just been walked, in the opposite direction, has an angle of 180°. Rounding can turn
            // this angle into −180°, and make the angle of another edge slightly negative.
            if turn < -FRAC_PI_2 { (turn + TAU, change) } else { (turn.max(0.0), change) }
        });
        let turns: Vec<(f64, Change)> = turns.collect();
        let least = turns.iter().map(|(turn, _)| *turn).reduce(f64::min)?;
        // Of the columns for the same edge, take the one with the largest change of the force.
        let first = turns.into_iter().filter(|(turn, _)| *turn <= least + SAME_ANGLE);
        let next = first.max_by(|(_, a), (_, b)| a.force.norm().total_cmp(&b.force.norm()));
        next.filter(|(turn, _)| *turn < PI + SAME_ANGLE)
    }

    /// Returns the change of the grip's force for each column outside the basis that influences this force.
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
            (force.norm() > MIN_PIVOT).then_some(Change { variable: k, sign, force })
        };
        (0..self.forces.len()).filter_map(change).collect()
    }

    /// Changes an amount outside the basis until this amount or a basic amount reaches a bound. `None` if the walk must
    /// end: after too many moves, after the deadline, or because of rounding.
    fn move_amount(&mut self, change: &Change) -> Option<Move> {
        self.moves_left = self.moves_left.checked_sub(1)?;
        let moved = self.simplex.move_amount(change.variable, change.sign)?;
        (!is_late() && self.force().norm().is_finite()).then_some(moved)
    }

    /// Like [`Self::move_amount`]; `None` also if no amount reaches a bound.
    fn move_to_end(&mut self, change: &Change) -> Option<()> {
        (self.move_amount(change)? == Move::Done).then_some(())
    }

    /// Returns the present force of the grip, relative to the largest load.
    fn force(&self) -> Vector {
        let [x, y] = self.own.map(|own| self.simplex.variables[own].amount);
        Vector::new(x, y)
    }

    /// Returns the present amounts as forces of contacts and grips, in program units.
    fn amounts(&self) -> Amounts {
        let mut amounts = Amounts::zero(self.program);
        for (force, variable) in self.forces.iter().zip(&self.simplex.variables) {
            amounts.add(*force, variable.amount * self.load);
        }
        amounts
    }

    /// Returns the present corner, with the edge whose normal is the present direction.
    fn corner(&self) -> PolygonCorner {
        let [x, y] = self.own.map(|own| self.simplex.multipliers(own));
        let velocity = |position: &usize| x[*position] * self.normal.x + y[*position] * self.normal.y;
        PolygonCorner {
            forces: self.amounts(),
            normal: self.normal,
            motion: self.position.iter().map(velocity).collect(),
        }
    }
}

/// How the force of the grip changes with the amount of a column outside the basis.
struct Change {
    variable: usize,
    /// 1 if the amount can increase, −1 if it is at its upper bound and can only decrease.
    sign: f64,
    /// The change of the force per unit of the amount, with the direction of `sign`.
    force: Vector,
}
