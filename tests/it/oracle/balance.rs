//! The equilibrium of a frame as exact linear programs with the unknowns of the source. They are built from the
//! corners of the bodies.
//!
//! The normal of an interface is its segment turned by 90°. It is not scaled to length 1, because a unit normal is
//! usually irrational. Normal forces and friction are both in units of that length, so |T| ≤ μ(N1 + N2) is unchanged.

use std::collections::{BTreeMap, BTreeSet};

use dashu_ratio::RBig;
use drystone::internals::proof::Proof;
use drystone::scene::{Hold, Scene};

use super::simplex::{LinearProgram, Row};
use super::touch::{Pair, Touch, corners, cross, dot, exact, minus, pair};

/// Blocks that touch each other, directly or through other blocks, and the contacts and robots that act on them.
pub struct Balance<'a> {
    scene: &'a Scene,
    pub blocks: Vec<usize>,
    touches: Vec<&'a Touch>,
    holds: Vec<Hold>,
    /// The median length of all interfaces; torques are divided by it.
    length: f64,
    centroids: Vec<Pair>,
    /// What cannot move.
    pub locked: Option<Locked>,
}

/// What cannot move: each block is held by any torque, or each touch carries any friction force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Locked {
    Turning,
    Sliding,
}

/// The sum to be minimised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sum {
    Forces,
    Sticking,
}

/// The number of a block's row for forces along x. The rows for forces along y and moments follow it.
type First = usize;

impl<'a> Balance<'a> {
    /// The groups of blocks in the first frame of a scene.
    pub fn groups(scene: &'a Scene, touches: &'a [Touch]) -> Vec<Balance<'a>> {
        let mut mark: Vec<usize> = (0..scene.blocks().len()).collect();
        for _ in 0..scene.blocks().len() {
            for touch in touches {
                if let Some(from) = touch.from {
                    let least = mark[touch.on].min(mark[from]);
                    (mark[touch.on], mark[from]) = (least, least);
                }
            }
        }
        let length = median(touches.iter().map(|t| norm(&minus(&t.ends[1], &t.ends[0]))).collect())
            .or_else(|| median(scene.blocks().iter().map(|b| b.body.polygon.area().sqrt()).collect()))
            .unwrap_or(1.0);
        let centroids: Vec<Pair> = scene.blocks().iter().map(|b| centroid(&corners(&b.body))).collect();
        (0..scene.blocks().len())
            .filter(|first| mark[*first] == *first)
            .map(|first| Balance {
                scene,
                blocks: (0..mark.len()).filter(|k| mark[*k] == first).collect(),
                touches: touches.iter().filter(|t| mark[t.on] == first).collect(),
                holds: scene.frames()[0].holds.iter().filter(|h| mark[h.block.0] == first).copied().collect(),
                length,
                centroids: centroids.clone(),
                locked: None,
            })
            .collect()
    }

    /// Whether some admissible forces balance every block.
    pub fn stands(&self) -> bool {
        self.admissible().is_feasible()
    }

    /// The least Σ(N1+N2+|T|) + Σ(|Fx|+|Fy|+|M|/L) in equilibrium, newtons.
    pub fn least_force(&self) -> Option<f64> {
        self.admissible().least().map(|v| v.to_f64_fast())
    }

    /// The least sum of adhesion at contacts and of robot forces beyond their limits that gives equilibrium, newtons.
    /// `None` if no such forces give equilibrium.
    pub fn least_sticking(&self) -> Option<f64> {
        self.soft().least().map(|v| v.to_f64_fast())
    }

    /// The least sum as an exact fraction. `None` if there is no equilibrium.
    pub fn least_exactly(&self, sum: Sum) -> Option<RBig> {
        self.program(sum).least()
    }

    fn program(&self, sum: Sum) -> LinearProgram {
        match sum {
            Sum::Forces => self.admissible(),
            Sum::Sticking => self.soft(),
        }
    }

    /// For each block the smallest and the largest sum of the forces that act on it, newtons, among all forces of the
    /// whole group whose sum is at most `least`.
    ///
    /// The sum may exceed `least` by a rounding error, because the costs are lengths, and these are rounded square
    /// roots.
    pub fn sums_on_blocks(&self, sum: Sum, least: &RBig) -> Vec<[f64; 2]> {
        let most = least * exact(1.0 + 4.0 * f64::EPSILON);
        let mut program = self.program(sum);
        program.rows.push(Row {
            entries: program.costs.iter().cloned().enumerate().collect(),
            bound: most.clone(),
            equality: false,
        });
        // For each block the costs of the unknowns that act on it, and of all others.
        let objectives: Vec<Vec<RBig>> = (0..self.blocks.len())
            .flat_map(|place| {
                let rows = &program.rows[3 * place..3 * place + 3];
                let acts: BTreeSet<usize> = rows.iter().flat_map(|row| row.entries.iter().map(|e| e.0)).collect();
                [true, false].map(|own| {
                    let costs = program.costs.iter().enumerate();
                    costs.map(|(k, cost)| if acts.contains(&k) == own { cost.clone() } else { RBig::ZERO }).collect()
                })
            })
            .collect();
        let optima = program.optima(&objectives).expect("the optimum fits");
        let sums: Vec<RBig> = optima
            .iter()
            .zip(&objectives)
            .map(|(x, costs)| x.iter().zip(costs).fold(RBig::ZERO, |sum, (v, c)| sum + v * c))
            .collect();
        let sides = sums.chunks_exact(2);
        sides.map(|side| [side[0].to_f64_fast(), (&most - &side[1]).to_f64_fast()]).collect()
    }

    /// Whether no adhesion gives equilibrium, even with an imbalance up to the tolerance.
    pub fn cannot_be_held(&self) -> bool {
        self.least_imbalance(self.soft()) > Proof::IMBALANCE_TOL
    }

    /// The soft program of the source for an infinite β: only adhesion has a cost.
    fn soft(&self) -> LinearProgram {
        let mut program = self.admissible();
        program.costs.iter_mut().for_each(|c| *c = RBig::ZERO);
        for touch in &self.touches {
            let axes = Axes::of(touch);
            let cost = exact(axes.length);
            for at in self.application_points(touch) {
                let pull = program.unknown(cost.clone());
                self.act(&mut program, touch, pull, &at, &negative(&axes.normal));
            }
            for along in [axes.tangent.clone(), negative(&axes.tangent)] {
                let slip = program.unknown(cost.clone());
                self.act(&mut program, touch, slip, &touch.ends[0], &along);
            }
        }
        for hold in &self.holds {
            for component in 0..3 {
                for sign in [1.0, -1.0] {
                    let beyond = program.unknown(self.grip_cost(component));
                    self.grip(&mut program, hold, beyond, component, sign);
                }
            }
        }
        program
    }

    /// The least possible largest imbalance of any block, relative to the heaviest load (times L for moments). It is
    /// 0 if the group stands.
    pub fn distance(&self) -> f64 {
        self.least_imbalance(self.admissible())
    }

    /// The least possible largest imbalance of any row of a program, relative to the heaviest load (times L for
    /// moments).
    pub(super) fn least_imbalance(&self, mut program: LinearProgram) -> f64 {
        program.costs.iter_mut().for_each(|c| *c = RBig::ZERO);
        let largest = program.unknown(RBig::ONE);
        for row in 0..3 * self.blocks.len() {
            let size = exact(self.size(row));
            let rest = program.unknown(RBig::ZERO);
            program.rows[row].entries.extend([(rest, RBig::ONE), (largest, -size.clone())]);
            let entries = vec![(rest, RBig::ONE), (largest, RBig::from(-2) * size)];
            program.rows.push(Row { entries, bound: RBig::ZERO, equality: false });
        }
        program.least().map_or(f64::INFINITY, |v| v.to_f64_fast())
    }

    /// Whether the group stands, and also stands if any one component of a block's load changes by `share` times that
    /// load.
    pub fn stands_with_margin(&self, share: f64) -> bool {
        self.stands()
            && (0..3 * self.blocks.len()).all(|row| {
                let block = self.blocks[row / 3];
                let own = self.gross_load(block) * if row % 3 == 2 { self.radius(block) } else { 1.0 };
                [share, -share].iter().all(|share| {
                    let mut program = self.admissible();
                    program.rows[row].bound += exact(share * own);
                    program.is_feasible()
                })
            })
    }

    /// Whether changes within the tolerance change the verdict.
    pub fn is_borderline(&self) -> bool {
        if self.stands() {
            !self.stands_with_margin(Proof::IMBALANCE_TOL)
        } else {
            self.stands_within(Proof::IMBALANCE_TOL)
        }
    }

    /// Whether the group stands if each force on a block may change by `band` times its magnitude, and may move by
    /// `band` times the block's radius. The forces on the two bodies of a contact change independently.
    ///
    /// All constraints are linear: a change z of a force x obeys |z| ≤ band · x, and moved forces exert an additional
    /// moment of at most band · R · Σ |F|.
    pub fn stands_within(&self, band: f64) -> bool {
        let mut program = self.admissible();
        let band = exact(band);
        for (place, block) in self.blocks.iter().enumerate() {
            let first = 3 * place;
            // For each unknown that acts on this block, its three entries.
            let mut columns: BTreeMap<usize, [RBig; 3]> = BTreeMap::new();
            for row in 0..3 {
                for (unknown, value) in &program.rows[first + row].entries {
                    let column = columns.entry(*unknown).or_insert_with(|| [RBig::ZERO, RBig::ZERO, RBig::ZERO]);
                    column[row] += value;
                }
            }
            let radius = exact(self.radius(*block));
            let load = self.load(*block);
            let size = |column: &[RBig; 3]| exact(norm(&[column[0].clone(), column[1].clone()]));
            let mut moved =
                Row { entries: Vec::new(), bound: &band * &radius * exact(self.gross_load(*block)), equality: false };
            for sign in [RBig::ONE, -RBig::ONE] {
                let moment = program.unknown(RBig::ZERO);
                program.rows[first + 2].entries.push((moment, sign));
                moved.entries.push((moment, RBig::ONE));
            }
            for (unknown, column) in &columns {
                moved.entries.push((*unknown, -(&band * &radius * size(column))));
            }
            program.rows.push(moved);
            let forces = columns.into_iter().map(|(u, column)| (Some(u), column));
            for (unknown, column) in forces.chain([(None, load)]) {
                let mut changed = Row {
                    entries: Vec::new(),
                    bound: if unknown.is_none() { band.clone() } else { RBig::ZERO },
                    equality: false,
                };
                for sign in [RBig::ONE, -RBig::ONE] {
                    let change = program.unknown(RBig::ZERO);
                    for (row, value) in column.iter().enumerate() {
                        program.rows[first + row].entries.push((change, value * &sign));
                    }
                    changed.entries.push((change, RBig::ONE));
                }
                changed.entries.extend(unknown.map(|u| (u, -band.clone())));
                program.rows.push(changed);
            }
        }
        program.is_feasible()
    }

    /// The distance of a block's farthest corner from its centroid.
    fn radius(&self, block: usize) -> f64 {
        let corners = corners(&self.scene.blocks()[block].body);
        let reach = corners.iter().map(|c| norm(&minus(c, &self.centroids[block])));
        reach.fold(0.0, f64::max)
    }

    /// The sum of the magnitudes of all loads on a block. A moment is divided by the block's radius.
    fn gross_load(&self, block: usize) -> f64 {
        let listed = self.scene.loads().iter().filter(|l| l.block.0 == block);
        let listed = listed.map(|l| {
            let at = minus(&pair(l.at.x, l.at.y), &self.centroids[block]);
            let moment = cross(&at, &pair(l.force.x, l.force.y)).to_f64_fast() + l.torque;
            libm::hypot(l.force.x, l.force.y) + moment.abs() / self.radius(block)
        });
        self.scene.blocks()[block].weight + listed.sum::<f64>()
    }

    /// The reference for the imbalance of a row: the heaviest load, times L for moments.
    fn size(&self, row: First) -> f64 {
        let load = |k: &usize| {
            let [x, y, m] = self.load(*k).map(|v| v.to_f64_fast());
            libm::hypot(x, y).max(m.abs() / self.length).max(self.scene.blocks()[*k].weight)
        };
        let heaviest = self.blocks.iter().map(load).fold(0.0, f64::max);
        let heaviest = if heaviest > 0.0 { heaviest } else { 1.0 };
        if row % 3 == 2 { heaviest * self.length } else { heaviest }
    }

    /// The hard program of the source: first three rows per block, then friction and limits.
    pub(super) fn admissible(&self) -> LinearProgram {
        let mut program = LinearProgram::default();
        for block in &self.blocks {
            for load in self.load(*block) {
                program.rows.push(Row { entries: Vec::new(), bound: -load, equality: true });
            }
        }
        for touch in &self.touches {
            let axes = Axes::of(touch);
            let cost = exact(axes.length);
            let mut entries = Vec::new();
            for at in self.application_points(touch) {
                let press = program.unknown(cost.clone());
                self.act(&mut program, touch, press, &at, &axes.normal);
                entries.push((press, -exact(touch.friction)));
            }
            if touch.friction > 0.0 || self.locked == Some(Locked::Sliding) {
                for along in [axes.tangent.clone(), negative(&axes.tangent)] {
                    let rub = program.unknown(cost.clone());
                    self.act(&mut program, touch, rub, &touch.ends[0], &along);
                    entries.push((rub, RBig::ONE));
                }
                if self.locked != Some(Locked::Sliding) {
                    program.rows.push(Row { entries, bound: RBig::ZERO, equality: false });
                }
            }
        }
        for place in 0..if self.locked == Some(Locked::Turning) { self.blocks.len() } else { 0 } {
            for sign in [1.0, -1.0] {
                let torque = program.unknown(RBig::ZERO);
                program.rows[3 * place + 2].entries.push((torque, exact(sign)));
            }
        }
        for hold in &self.holds {
            let limits = self.scene.robots()[hold.robot.0].limits;
            for (component, limit) in [limits.fx, limits.fy, limits.torque].into_iter().enumerate() {
                for sign in [1.0, -1.0] {
                    let push = program.unknown(self.grip_cost(component));
                    self.grip(&mut program, hold, push, component, sign);
                    if limit.is_finite() {
                        let entries = vec![(push, RBig::ONE)];
                        program.rows.push(Row { entries, bound: exact(limit), equality: false });
                    }
                }
            }
        }
        program
    }

    /// The load on a block: force along x, force along y, moment about the centroid.
    pub(super) fn load(&self, block: usize) -> [RBig; 3] {
        let mut load = self.weight(block);
        for listed in self.scene.loads().iter().filter(|l| l.block.0 == block) {
            let force = pair(listed.force.x, listed.force.y);
            let at = pair(listed.at.x, listed.at.y);
            load[2] += cross(&minus(&at, &self.centroids[block]), &force) + exact(listed.torque);
            let [x, y] = force;
            load[0] += x;
            load[1] += y;
        }
        load
    }

    /// A block's weight as a load.
    pub(super) fn weight(&self, block: usize) -> [RBig; 3] {
        let gravity = self.scene.gravity();
        let size = libm::hypot(gravity.x, gravity.y);
        let weight = exact(self.scene.blocks()[block].weight);
        let parts = [exact(gravity.x), exact(gravity.y)];
        let square = |v: &RBig| v * v;
        // The direction is a fraction if the length is one.
        let [x, y] = if size > 0.0 && square(&exact(size)) == square(&parts[0]) + square(&parts[1]) {
            parts.map(|v| v / exact(size))
        } else {
            let down = if size > 0.0 { gravity / size } else { gravity };
            [exact(down.x), exact(down.y)]
        };
        [&weight * x, &weight * y, RBig::ZERO]
    }

    /// Both ends of the interface, each moved inward by half of `kernel` times its length.
    fn application_points(&self, touch: &Touch) -> [Pair; 2] {
        let share = exact(self.scene.kernel()) / RBig::from(2);
        let along = minus(&touch.ends[1], &touch.ends[0]);
        let inward = along.map(|v| v * &share);
        let [a, b] = &touch.ends;
        [[&a[0] + &inward[0], &a[1] + &inward[1]], minus(b, &inward)]
    }

    /// Adds an unknown force of a contact: on the first body, and in the opposite direction on the other.
    fn act(&self, program: &mut LinearProgram, touch: &Touch, unknown: usize, at: &Pair, force: &Pair) {
        self.push(program, touch.on, unknown, at, force);
        if let Some(from) = touch.from {
            self.push(program, from, unknown, at, &negative(force));
        }
    }

    pub(super) fn push(&self, program: &mut LinearProgram, block: usize, unknown: usize, at: &Pair, force: &Pair) {
        let first = self.first_row(block);
        let moment = cross(&minus(at, &self.centroids[block]), force);
        for (offset, value) in [&force[0], &force[1], &moment].into_iter().enumerate() {
            program.rows[first + offset].entries.push((unknown, value.clone()));
        }
    }

    fn grip(&self, program: &mut LinearProgram, hold: &Hold, unknown: usize, component: usize, sign: f64) {
        let block = hold.block.0;
        match component {
            0 => self.push(program, block, unknown, &pair(hold.at.x, hold.at.y), &pair(sign, 0.0)),
            1 => self.push(program, block, unknown, &pair(hold.at.x, hold.at.y), &pair(0.0, sign)),
            _ => program.rows[self.first_row(block) + 2].entries.push((unknown, exact(sign))),
        }
    }

    fn grip_cost(&self, component: usize) -> RBig {
        if component == 2 { exact(1.0 / self.length) } else { RBig::ONE }
    }

    fn first_row(&self, block: usize) -> First {
        let place = self.blocks.iter().position(|b| *b == block);
        3 * place.expect("the block belongs to this group")
    }
}

/// The normal and the tangent of an interface, both as long as the interface.
struct Axes {
    normal: Pair,
    tangent: Pair,
    length: f64,
}

impl Axes {
    fn of(touch: &Touch) -> Axes {
        let tangent = minus(&touch.ends[1], &touch.ends[0]);
        let normal = [tangent[1].clone(), -tangent[0].clone()];
        Axes { normal, length: norm(&tangent), tangent }
    }
}

fn negative(v: &Pair) -> Pair {
    [-v[0].clone(), -v[1].clone()]
}

fn norm(v: &Pair) -> f64 {
    dot(v, v).to_f64_fast().sqrt()
}

fn median(mut lengths: Vec<f64>) -> Option<f64> {
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len().saturating_sub(1) / 2).copied()
}

fn centroid(corners: &[Pair]) -> Pair {
    let (mut area, mut sum) = (RBig::ZERO, [RBig::ZERO, RBig::ZERO]);
    for i in 0..corners.len() {
        let (a, b) = (&corners[i], &corners[(i + 1) % corners.len()]);
        let part = cross(a, b);
        for (total, k) in sum.iter_mut().zip(0..) {
            *total += &part * (&a[k] + &b[k]);
        }
        area += part;
    }
    sum.map(|v| v / (RBig::from(3) * &area))
}
