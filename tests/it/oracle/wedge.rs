//! Checks the certificate that a structure stands only by wedging. By the exact simplex, every ruled-out case is
//! infeasible, and the cases together cover all patterns. The rows are built here from the contacts that drystone
//! finds and the law of the springs.

use dashu_ratio::RBig;
use drystone::analysis::{FrameAnalysis, Options, RuledOut, Slide};
use drystone::scene::BodyId;
use drystone::{Analysis, Scene};

use super::simplex::{LinearProgram, Row};
use super::touch::exact;
use crate::structure::scene;
use crate::wedging::{bar_between_walls, h_model};

/// The normal forces may sum to at most this many times the total weight.
const FAR: i64 = 1_000_000;

/// Entries of a row: unknowns and their coefficients.
type Entries = Vec<(usize, RBig)>;

/// The linear program of a frame's springs. Its unknowns are the three velocities of each block, then the normal
/// force at each point, then the friction of each interface. Velocities and friction have a positive and a negative
/// part.
struct Springs<'a> {
    scene: &'a Scene,
    frame: &'a FrameAnalysis,
    program: LinearProgram,
}

impl<'a> Springs<'a> {
    fn of(scene: &'a Scene, frame: &'a FrameAnalysis) -> Springs<'a> {
        let unknowns = 6 * scene.blocks().len() + 4 * frame.contacts.len();
        let program = LinearProgram { costs: vec![RBig::ZERO; unknowns], rows: Vec::new() };
        Springs { scene, frame, program }
    }

    fn normal(&self, contact: usize, point: usize) -> usize {
        6 * self.scene.blocks().len() + 2 * contact + point
    }

    /// The friction of a contact, or minus it, times a factor.
    fn friction(&self, contact: usize, by: &RBig) -> Entries {
        let first = 6 * self.scene.blocks().len() + 2 * self.frame.contacts.len() + 2 * contact;
        vec![(first, by.clone()), (first + 1, -by.clone())]
    }

    /// A unit force at a point of a contact, along its normal or its face, as (equilibrium row, coefficient).
    fn column(&self, contact: usize, point: usize, along_face: bool) -> Vec<(usize, RBig)> {
        let contact = &self.frame.contacts[contact];
        let normal = contact.interface.normal;
        let direction =
            if along_face { [-exact(normal.y), exact(normal.x)] } else { [exact(normal.x), exact(normal.y)] };
        let at = contact.application_points[point];
        let [on, from] = contact.interface.bodies;
        let mut column = Vec::new();
        for (body, sign) in [(on, RBig::ONE), (from, -RBig::ONE)] {
            let BodyId::Block(number) = body else {
                continue;
            };
            let centroid = self.scene.blocks()[number.0].centroid;
            let arm = [exact(at.x) - exact(centroid.x), exact(at.y) - exact(centroid.y)];
            let moment = &arm[0] * &direction[1] - &arm[1] * &direction[0];
            let force = [direction[0].clone(), direction[1].clone(), moment];
            for (k, value) in force.into_iter().enumerate() {
                column.push((3 * number.0 + k, value * &sign));
            }
        }
        column
    }

    /// The speed at which a point opens, or a face slips along (−n_y, n_x), times a factor.
    fn speed(&self, contact: usize, point: usize, along_face: bool, by: &RBig) -> Entries {
        let column = self.column(contact, point, along_face);
        let both = |(row, v): (usize, RBig)| {
            let v = v * by;
            [(2 * row, v.clone()), (2 * row + 1, -v)]
        };
        column.into_iter().flat_map(both).collect()
    }

    fn row(&mut self, entries: Entries, bound: RBig, equality: bool) {
        self.program.rows.push(Row { entries, bound, equality });
    }

    /// Adds the rows that all cases have in common: equilibrium, the power of the loads, and the bound on the normal
    /// forces.
    fn common(&mut self) {
        let mut balance: Vec<Entries> = vec![Vec::new(); 3 * self.scene.blocks().len()];
        for contact in 0..self.frame.contacts.len() {
            for point in 0..2 {
                let unknown = self.normal(contact, point);
                for (row, v) in self.column(contact, point, false) {
                    balance[row].push((unknown, v));
                }
            }
            for (row, v) in self.column(contact, 0, true) {
                balance[row].extend(self.friction(contact, &v));
            }
        }
        let weights: Vec<RBig> = self.scene.blocks().iter().map(|b| exact(b.weight)).collect();
        let mut work = Vec::new();
        for (row, entries) in balance.into_iter().enumerate() {
            let held = match row % 3 {
                1 => weights[row / 3].clone(),
                _ => RBig::ZERO,
            };
            if row % 3 == 1 {
                work.extend([(2 * row, held.clone()), (2 * row + 1, -held.clone())]);
            }
            self.row(entries, held, true);
        }
        self.row(work, RBig::ZERO, false);
        let all = weights.iter().fold(RBig::ZERO, |sum, w| sum + w) * RBig::from(FAR);
        let points = (0..self.frame.contacts.len()).flat_map(|c| [(c, 0), (c, 1)]);
        let sum = points.map(|(c, p)| (self.normal(c, p), RBig::ONE)).collect();
        self.row(sum, all, false);
    }

    /// Adds the rows of the law of the springs in one case.
    fn law(&mut self, case: &RuledOut) {
        for contact in 0..self.frame.contacts.len() {
            let presses = |point: usize| {
                let mut points = case.points.iter();
                let of = points.find(|p| (p.interface, p.point) == (contact, point));
                of.map(|p| p.presses)
            };
            for point in 0..2 {
                let normal = self.normal(contact, point);
                let with_normal = |mut entries: Entries, by: RBig| {
                    entries.push((normal, by));
                    entries
                };
                let opening = self.speed(contact, point, false, &RBig::ONE);
                let closing = self.speed(contact, point, false, &-RBig::ONE);
                match presses(point) {
                    Some(true) => self.row(with_normal(opening, RBig::ONE), RBig::ZERO, true),
                    Some(false) => {
                        self.row(vec![(normal, RBig::ONE)], RBig::ZERO, true);
                        self.row(closing, RBig::ZERO, false);
                    }
                    None => self.row(with_normal(closing, -RBig::ONE), RBig::ZERO, false),
                }
            }
            let mu = exact(self.frame.contacts[contact].interface.friction);
            let most = |by: RBig| {
                let factor = &mu * &by;
                [0, 1].map(|point| (self.normal(contact, point), factor.clone()))
            };
            let integer = |by: i64| RBig::from(by);
            let (least, whole) = (most(-RBig::ONE), most(RBig::ONE));
            for sign in [1, -1] {
                let mut entries = self.friction(contact, &integer(sign));
                entries.extend(least.clone());
                self.row(entries, RBig::ZERO, false);
            }
            let face = case.faces.iter().find(|f| f.interface == contact);
            match face.map(|f| f.slides) {
                None => {}
                Some(Slide::Sticks) => {
                    let mut entries = self.speed(contact, 0, true, &RBig::ONE);
                    entries.extend(self.friction(contact, &RBig::ONE));
                    self.row(entries, RBig::ZERO, true);
                }
                Some(slides) => {
                    // Friction acts at its limit against the slip, and the slip is at least the friction force
                    // divided by the stiffness 1.
                    let along = if slides == Slide::Forth { 1 } else { -1 };
                    let mut limit = self.friction(contact, &integer(along));
                    limit.extend(whole.clone());
                    self.row(limit, RBig::ZERO, true);
                    let mut slip = self.speed(contact, 0, true, &integer(-along));
                    slip.extend(whole.clone());
                    self.row(slip, RBig::ZERO, false);
                }
            }
        }
    }
}

/// The fraction of all patterns that a case covers: a factor of ½ for each of its points and ⅓ for each of its faces.
fn share(case: &RuledOut) -> RBig {
    let half = RBig::from_parts(1.into(), 2_u8.into());
    let third = RBig::from_parts(1.into(), 3_u8.into());
    let points = case.points.iter().fold(RBig::ONE, |s, _| s * &half);
    case.faces.iter().fold(points, |s, _| s * &third)
}

/// Whether two cases exclude each other: they differ at some point or face.
fn exclude_each_other(one: &RuledOut, other: &RuledOut) -> bool {
    let points = one.points.iter().any(|a| {
        let same = |b: &&_| ends(a) == ends(b);
        other.points.iter().find(same).is_some_and(|b| a.presses != b.presses)
    });
    points
        || one.faces.iter().any(|a| {
            let mut faces = other.faces.iter();
            faces.any(|b| a.interface == b.interface && a.slides != b.slides)
        })
}

fn ends(point: &drystone::analysis::PointCase) -> (usize, usize) {
    (point.interface, point.point)
}

#[test]
fn the_exact_program_confirms_every_ruled_out_case_of_wedging() {
    let mut cases = 0;
    for file in [bar_between_walls(0.0, 0.7), bar_between_walls(0.2, 0.7), h_model(0.7)] {
        let scene = scene(&file);
        let options = Options::default().wedging(true);
        let analysis = Analysis::with(scene.clone(), &options);
        let frame = &analysis.frames[0];
        let wedged = frame.wedged.as_ref().expect("the certificate of wedging");
        let all = wedged.ruled_out.iter().fold(RBig::ZERO, |sum, c| sum + share(c));
        assert_eq!(all, RBig::ONE, "the cases cover all patterns");
        for (k, case) in wedged.ruled_out.iter().enumerate() {
            for other in &wedged.ruled_out[k + 1..] {
                assert!(exclude_each_other(case, other), "{case:?} {other:?}");
            }
            let mut springs = Springs::of(&scene, frame);
            springs.common();
            springs.law(case);
            assert!(!springs.program.is_feasible(), "{case:?}");
            cases += 1;
        }
        // Without the rows of a case the program is feasible, so the cases are the reason for infeasibility.
        let mut springs = Springs::of(&scene, frame);
        springs.common();
        assert!(springs.program.is_feasible());
    }
    assert!(cases > 30, "{cases}");
}
