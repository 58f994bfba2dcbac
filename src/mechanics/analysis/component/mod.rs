//! One component of an assembly, from its program to a proved verdict in metres and newtons.
//!
//! The verdict is decided on the ladder of [`ladder`]; what a reader wants to know beside it is found afterwards: the
//! forces of least sum where it stands, what fails where it falls.

mod description;
mod failure;
mod forces;
mod guess;
mod candidate;
mod ladder;
mod local;
mod motion;
mod pieces;
mod question;
mod rung;
mod straight;

pub(super) use candidate::Candidate;
pub(super) use guess::ProofCache;
pub(super) use question::{Ends, guessed, judged, learn, only_by_wedging};

use super::{Failure, Options, UndecidedReason, Verdict};
use crate::assembly::Assembly;
use crate::program::{Program, Scale, UnknownCounts, columns, sticking_columns};
use crate::proof::{Forces, Motion, Proof, ProofThreshold, fastest};
use crate::solve::{Amounts, Effort, SolverSettings, determinate};
use ladder::Decision;
pub use rung::Method;
pub(super) use rung::Place;

/// What was found out about one component, forces in the order of its contacts and grips.
#[derive(Clone, Debug)]
pub(super) struct Findings {
    pub verdict: Verdict,
    pub doubt: Option<UndecidedReason>,
    pub forces: Forces,
    /// The sum that admissible forces must have at least to balance, N, where it was shown.
    pub force_bound: Option<f64>,
    /// Whether the forces are shown to be those of least sum, and not just some that balance.
    pub least_force: bool,
    pub failures: Vec<Failure>,
    pub total_sticking: f64,
    pub unsupported: bool,
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    pub method: Method,
    pub effort: Effort,
    /// The unknowns of its program, and those that sticking has or would have.
    pub count: UnknownCounts,
}

/// Everything one component is judged by.
struct Case<'a> {
    assembly: &'a Assembly,
    scale: Scale,
    /// The solver's settings, in the order in which they are tried.
    settings: Vec<SolverSettings>,
    demand: ProofThreshold,
    /// Whether what belongs to a verdict is found after it.
    described: bool,
    place: Place,
}

/// Solves one component, proves its verdict, and finds what belongs to it.
pub(super) fn solved(assembly: &Assembly, options: Options) -> Findings {
    let case = Case::new(assembly, options);
    let program = Program::new(assembly, case.scale);
    let count = UnknownCounts::new(&program, &columns(&program))
        .plus(&UnknownCounts::new(&program, &sticking_columns(&program)));
    if let Some(found) = case.in_closed_form(&program) {
        return Findings { count, ..found };
    }
    // Limits that can hardly matter are left out first; where they do matter after all, everything is done again.
    if let Some(generous) = program.without_non_binding_limits() {
        let decision = case.described(&generous, case.decided(&generous));
        if decision.verdict != Verdict::Undecided && program.allows(&decision.amounts.grip) {
            return Findings {
                count,
                ..case.findings(decision)
            };
        }
    }
    let decision = case.described(&program, case.decided(&program));
    Findings {
        count,
        ..case.findings(decision)
    }
}

impl<'a> Case<'a> {
    /// A component in its own scale.
    fn new(assembly: &'a Assembly, options: Options) -> Case<'a> {
        Case {
            assembly,
            scale: Scale::from_assembly(assembly),
            settings: options.solver_settings(),
            demand: options.accuracy.demand(),
            described: !options.verdict_only,
            place: Place::Anywhere,
        }
    }

    fn believes(&self, proof: &Proof) -> bool {
        proof.meets(self.demand)
    }

    /// What can be answered without a solver.
    fn in_closed_form(&self, program: &Program) -> Option<Findings> {
        let found = if self.assembly.heaviest_load() == 0.0 {
            self.stands(self.carried(&Amounts::none(program)))
        } else if let Some((mechanism, proof)) = self.falls_free() {
            Findings {
                verdict: Verdict::Unstable,
                unsupported: true,
                mechanism,
                proof,
                ..self.stands(self.carried(&Amounts::none(program)))
            }
        } else {
            let carried = self.carried(&determinate(program)?);
            if !self.believes(&carried.proof) {
                return None;
            }
            self.stands(carried)
        };
        Some(found)
    }

    /// Findings of a component that stands by forces found in closed form.
    fn stands(&self, carried: forces::ProvedForces) -> Findings {
        Findings {
            verdict: Verdict::Stable,
            doubt: None,
            force_bound: Some(carried.forces.sum(self.assembly.length)),
            forces: carried.forces,
            least_force: true,
            failures: Vec::new(),
            total_sticking: 0.0,
            unsupported: false,
            mechanism: Vec::new(),
            proof: carried.proof,
            method: Method::ClosedForm,
            effort: Effort::default(),
            count: UnknownCounts::default(),
        }
    }

    /// A decision in metres and newtons.
    fn findings(&self, decision: Decision) -> Findings {
        let (mut failures, mut total_sticking) = (Vec::new(), 0.0);
        if let (Some(sticking), Verdict::Unstable) = (&decision.sticking, decision.verdict) {
            failures = self.failures(sticking);
            total_sticking = failure::total(&failures, self.assembly.length);
        }
        let mut mechanism = decision.mechanism;
        if decision.verdict != Verdict::Unstable {
            mechanism.clear();
        }
        // It was proved with every body; what only trembles is left out of what is shown.
        let mut bodies = self.assembly.bodies.iter();
        mechanism.retain(|m| bodies.next().is_some_and(|body| fastest(body, m) > 1e-7));
        for motion in &mut mechanism {
            let plain = |v: f64| if v.abs() < 1e-9 { 0.0 } else { v };
            motion.velocity = motion.velocity.map(plain);
            motion.spin = plain(motion.spin * self.assembly.length) / self.assembly.length;
        }
        // Forces beside a fall mean something together with what sticks.
        let forces = match (decision.verdict, &decision.sticking) {
            (Verdict::Unstable, _) if !self.described => Forces::none(self.assembly),
            (Verdict::Unstable, Some(sticking)) => {
                self.carried_with_sticking(&decision.amounts, sticking).0
            }
            _ => self.carried(&decision.amounts).forces,
        };
        Findings {
            verdict: decision.verdict,
            doubt: decision.doubt,
            forces,
            force_bound: decision.force_bound,
            least_force: decision.least_force,
            failures,
            total_sticking,
            unsupported: decision.beyond_sticking && decision.verdict == Verdict::Unstable,
            mechanism,
            proof: decision.proof,
            method: decision.method,
            effort: decision.effort,
            count: UnknownCounts::default(),
        }
    }
}
