//! That no springs come to rest: every way in which points press and faces slide is ruled out.
//!
//! A case says of some points whether they press and of some faces how they slide; the others are left open, held only
//! by N ≥ 0, N ≥ −g and |T| ≤ μ(N1 + N2). Together with the balance, the robots' limits and the fact that springs at
//! rest hold no more energy than the loads gave them, these are linear in displacements and forces. Where they contradict
//! each other, multipliers show it, and are tested here; where they do not, the case is split. The cases ruled out
//! cover everything, so that their multipliers together are the certificate.

use super::certificate::contradicts;
use super::spring::{Pattern, Slide, Springs};
use crate::program::{Column, Program, QuadraticProgram};
use crate::solve::{Conditioning, Status, TOLERANCE, solve};

/// Cases looked at before the question stays open.
const MOST_CASES: usize = 1500;

/// Rows of all those cases together: large structures get fewer cases.
const MOST_ROWS: usize = 100_000;

/// What came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Search {
    /// No springs come to rest: these cases, which together are all there are, were ruled out.
    NoRest(Vec<RuledOut>),
    /// Springs come to rest.
    Rests,
    /// Too many cases, or one that was neither ruled out nor led to rest.
    Open,
}

/// One case: what is reported of each point and each face.
#[derive(Clone)]
struct Case {
    pressed: Vec<Option<bool>>,
    slides: Vec<Option<Slide>>,
}

/// Looks at every case.
pub(super) fn search(program: &Program) -> Search {
    let springs = Springs::new(program, 1.0);
    let layout = Layout::new(&springs);
    let rough = |k: usize| program.contacts[k].friction > 0.0;
    let mut cases = vec![Case {
        pressed: vec![None; springs.points.len()],
        slides: (0..program.contacts.len())
            .map(|k| (!rough(k)).then_some(Slide::Forth))
            .collect(),
    }];
    let (mut seen, mut rows) = (0, 0);
    let mut ruled_out = Vec::new();
    while let Some(case) = cases.pop() {
        let conic = layout.posed(&springs, &case);
        (seen, rows) = (seen + 1, rows + conic.bound.len());
        if seen > MOST_CASES || rows > MOST_ROWS {
            return Search::Open;
        }
        let answer = solve(&conic, TOLERANCE, Conditioning::Full);
        let split = match answer.status {
            Status::Infeasible if contradicts(&conic, &answer.z, program) => {
                ruled_out.push(case.described(&springs, &rough));
                continue;
            }
            Status::Solved => {
                let at = |k: usize| answer.x[k];
                let u: Vec<f64> = (0..program.loads.len()).map(at).collect();
                // Robots yield about what they are asked to give; here they give it where they are.
                let given = layout.given(&answer.x).iter().zip(&springs.grips);
                let given: Vec<f64> = given.map(|(f, g)| f + g.column.dot(&u)).collect();
                let robots = Springs::around(program, &given, 1.0);
                let led = robots.pattern(&u, &robots.whole());
                for pattern in [case.imposed(&led), led] {
                    if robots.rest(&pattern, &u).is_some() {
                        return Search::Rests;
                    }
                }
                layout.worst(&springs, &case, &answer.x)
            }
            // Without an answer the case is split all the same: its parts say more.
            _ => case.first_open(&springs),
        };
        let Some(split) = split else {
            return Search::Open;
        };
        cases.extend(case.split(split));
    }
    Search::NoRest(ruled_out)
}

/// A way of pressing and sliding that springs at rest cannot have, whatever the points and faces do of which it says nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuledOut {
    /// Contacts, application points of each (0 or 1), and whether they press.
    pub points: Vec<(usize, usize, bool)>,
    /// Contacts with friction, and how their faces slide.
    pub faces: Vec<(usize, Slide)>,
}

/// Where a case is split.
enum Split {
    Point(usize),
    Face(usize),
}

impl Case {
    /// The parts of a case, the last of which is looked at first.
    fn split(&self, at: Split) -> Vec<Case> {
        let with = |change: &dyn Fn(&mut Case)| {
            let mut part = self.clone();
            change(&mut part);
            part
        };
        match at {
            Split::Point(k) => [false, true]
                .map(|pressed| with(&|c| c.pressed[k] = Some(pressed)))
                .to_vec(),
            Split::Face(k) => [Slide::Forth, Slide::Back, Slide::Sticks]
                .map(|slides| with(&|c| c.slides[k] = Some(slides)))
                .to_vec(),
        }
    }

    /// A face no point of which presses carries nothing, however it slides.
    fn carries(&self, springs: &Springs, contact: usize) -> bool {
        let of = springs.points.iter().zip(&self.pressed);
        of.filter(|(p, _)| p.contact == contact)
            .any(|(_, pressed)| *pressed != Some(false))
    }

    /// What the case says.
    fn described(&self, springs: &Springs, rough: &dyn Fn(usize) -> bool) -> RuledOut {
        let end = |k: usize| {
            let before = springs.points[..k].iter();
            let contact = springs.points[k].contact;
            before.filter(|p| p.contact == contact).count()
        };
        let points = self.pressed.iter().enumerate();
        let faces = self.slides.iter().enumerate();
        RuledOut {
            points: points
                .filter_map(|(k, pressed)| Some((springs.points[k].contact, end(k), (*pressed)?)))
                .collect(),
            faces: faces
                .filter(|(k, _)| rough(*k))
                .filter_map(|(k, slides)| Some((k, (*slides)?)))
                .collect(),
        }
    }

    fn first_open(&self, springs: &Springs) -> Option<Split> {
        let point = self
            .pressed
            .iter()
            .position(Option::is_none)
            .map(Split::Point);
        let face = |k: &usize| self.slides[*k].is_none() && self.carries(springs, *k);
        point.or_else(|| (0..self.slides.len()).find(face).map(Split::Face))
    }

    /// A pattern with what the case says put in.
    fn imposed(&self, pattern: &Pattern) -> Pattern {
        let mut imposed = pattern.clone();
        for (to, given) in imposed.pressed.iter_mut().zip(&self.pressed) {
            *to = given.unwrap_or(*to);
        }
        for (to, given) in imposed.slides.iter_mut().zip(&self.slides) {
            *to = given.unwrap_or(*to);
        }
        imposed
    }
}

/// Where the unknowns stand: displacements, normal forces, friction forces, robots' components.
struct Layout {
    points: usize,
    faces: usize,
    grips: usize,
    end: usize,
    /// Force of a unit load, by which guiding terms are measured.
    size: f64,
}

/// Rows Ax ≤ b in the making.
#[derive(Default)]
struct Rows {
    entries: Vec<(usize, usize, f64)>,
    bound: Vec<f64>,
}

impl Rows {
    fn add(&mut self, entries: impl IntoIterator<Item = (usize, f64)>, bound: f64) {
        let row = self.bound.len();
        self.entries
            .extend(entries.into_iter().map(|(k, v)| (row, k, v)));
        self.bound.push(bound);
    }
}

impl Layout {
    fn new(springs: &Springs) -> Layout {
        let points = springs.program.loads.len();
        let faces = points + springs.points.len();
        let grips = faces + springs.tangents.len();
        let sum: f64 = springs.program.loads.iter().map(|v| v.abs()).sum();
        Layout {
            points,
            faces,
            grips,
            end: grips + springs.grips.len(),
            size: sum.max(f64::MIN_POSITIVE),
        }
    }

    /// What robots give, by grip.
    fn given<'x>(&self, x: &'x [f64]) -> &'x [f64] {
        &x[self.grips..self.end]
    }

    /// A case as a problem for the solver: the least sum of N and N + g at the points of which it says nothing.
    fn posed(&self, springs: &Springs, case: &Case) -> QuadraticProgram {
        let loads = &springs.program.loads;
        let (mut equal, mut less) = (Rows::default(), Rows::default());
        let mut balance = vec![Vec::new(); loads.len()];
        let mut enter = |column: &Column, unknown: usize| {
            column
                .entries()
                .for_each(|(row, v)| balance[row].push((unknown, v)));
        };
        let points = springs.points.iter().map(|p| &p.column);
        points
            .enumerate()
            .for_each(|(k, c)| enter(c, self.points + k));
        springs
            .tangents
            .iter()
            .enumerate()
            .for_each(|(k, c)| enter(c, self.faces + k));
        springs
            .grips
            .iter()
            .enumerate()
            .for_each(|(k, g)| enter(&g.column, self.grips + k));
        for (row, entries) in balance.into_iter().enumerate() {
            equal.add(entries, loads[row]);
        }
        let mut linear = vec![0.0; self.end];
        let mut pressing = vec![Vec::new(); springs.tangents.len()];
        for (k, point) in springs.points.iter().enumerate() {
            let normal = self.points + k;
            let gap = |sign: f64| point.column.entries().map(move |(row, v)| (row, sign * v));
            match case.pressed[k] {
                Some(false) => {
                    equal.add([(normal, 1.0)], 0.0);
                    less.add(gap(-1.0), 0.0);
                }
                Some(true) => {
                    equal.add(gap(1.0).chain([(normal, 1.0)]), 0.0);
                    less.add([(normal, -1.0)], 0.0);
                }
                None => {
                    less.add([(normal, -1.0)], 0.0);
                    less.add(gap(-1.0).chain([(normal, -1.0)]), 0.0);
                    linear[normal] += 2.0;
                    gap(1.0).for_each(|(row, v)| linear[row] += v);
                }
            }
            if case.pressed[k] != Some(false) {
                pressing[point.contact].push(normal);
            }
        }
        for (k, tangent) in springs.tangents.iter().enumerate() {
            let friction = self.faces + k;
            let mu = springs.program.contacts[k].friction;
            if pressing[k].is_empty() || mu == 0.0 {
                equal.add([(friction, 1.0)], 0.0);
                continue;
            }
            let normals = |by: f64| pressing[k].iter().map(move |n| (*n, by));
            let slip = |sign: f64| tangent.entries().map(move |(row, v)| (row, sign * v));
            let slides = case.slides[k];
            if let Some(Slide::Forth | Slide::Back) = slides {
                let way = slides.map_or(0.0, Slide::friction);
                equal.add(normals(-way * mu).chain([(friction, 1.0)]), 0.0);
                // The slip, against friction, is at least what the friction force would stretch its spring by.
                less.add(slip(way).chain(normals(mu)), 0.0);
                continue;
            }
            if slides.is_some() {
                equal.add(slip(1.0).chain([(friction, 1.0)]), 0.0);
            }
            for sign in [1.0, -1.0] {
                less.add(normals(-mu).chain([(friction, sign)]), 0.0);
            }
        }
        for (k, grip) in springs
            .grips
            .iter()
            .enumerate()
            .filter(|g| g.1.limit.is_finite())
        {
            for sign in [1.0, -1.0] {
                less.add([(self.grips + k, sign)], grip.limit);
            }
        }
        if springs.grips.is_empty() {
            // The loads' work, −loads·u, is Σ N² + Σ |T s| and not negative.
            less.add(
                loads.iter().copied().enumerate().filter(|e| e.1 != 0.0),
                0.0,
            );
        }
        let equalities = equal.bound.len();
        let rows = less
            .entries
            .into_iter()
            .map(|(r, k, v)| (r + equalities, k, v));
        QuadraticProgram {
            unknowns: self.end,
            quadratic: (0..self.end).map(|k| (k, k, 1e-3 / self.size)).collect(),
            linear,
            matrix: equal.entries.into_iter().chain(rows).collect(),
            bound: equal.bound.into_iter().chain(less.bound).collect(),
            equalities,
        }
    }

    /// Where an answer misses the springs' law most, among what the case leaves open.
    fn worst(&self, springs: &Springs, case: &Case, x: &[f64]) -> Option<Split> {
        let u = &x[..self.points];
        let mut worst: Option<(f64, Split)> = None;
        let mut consider = |off: f64, split: Split| {
            if worst.as_ref().is_none_or(|w| off > w.0) {
                worst = Some((off, split));
            }
        };
        let mut normal = vec![0.0; springs.tangents.len()];
        for (k, point) in springs.points.iter().enumerate() {
            let force = x[self.points + k].max(0.0);
            normal[point.contact] += force;
            if case.pressed[k].is_none() {
                consider(force.min(force + point.column.dot(u)), Split::Point(k));
            }
        }
        for (k, tangent) in springs.tangents.iter().enumerate() {
            if case.slides[k].is_none() && case.carries(springs, k) {
                let most = springs.program.contacts[k].friction * normal[k];
                let law = (-tangent.dot(u)).clamp(-most, most);
                consider((x[self.faces + k] - law).abs(), Split::Face(k));
            }
        }
        worst.map(|w| w.1)
    }
}
