//! Decides whether a component stands or falls. The two tables below list the routes to a verdict, for one component
//! and for a whole frame. The routes are tried in the order of their numbers.
//!
//! A verdict needs a proof ([`crate::mechanics::proof`]): forces that balance every body, or a motion that no admissible forces
//! can stop. A route may save time, but it never decides without a proof. All routes for one component return a
//! [`Decision`] or [`Findings`].
//!
//! For one component, by [`decide_component`]:
//!
//! | | route | file | decides because |
//! |---|---|---|---|
//! | 1 | closed form | `decide.rs`, `solve::determinate` | no load, no support, or forces that the balance equations alone determine |
//! | 2 | without non-binding limits | `decide.rs` | most robots stay far below their limits; without these limits the program is smaller |
//! | 3 | programs in order | `programs.rs`, `strategy/` | each may find forces or a motion, whose proof is then computed |
//! | 3a | – rebalance locally | `rebalance.rs` | forces that balance the component as a whole may leave light bodies unbalanced; these bodies are solved again in their own scale |
//! | 3b | – remove the solver's error from a motion | `motion.rs`, `pieces.rs` | a motion must not violate any contact, not even by rounding |
//! | 4 | complete | `complete.rs` | forces of least sum if the component stands, least adhesion if it falls |
//!
//! Route 4 can change *unstable* to *stable*, but only if the program of least adhesion finds forces that balance
//! every body. Then both proofs hold. The proof of a motion has a tolerance, so the forces decide.
//!
//! If only the verdict is needed, by [`decide_verdict`]: first forces and motions of similar components
//! (`proof_cache.rs`), then routes 1 to 3. Margins and capacities need only the verdict.
//!
//! For whole frames:
//!
//! | | route | file |
//! |---|---|---|
//! | 0 | warm start of `verdicts` and `Session`: the balance nearest to the loads, from the last step's active set | `analysis/warm_start.rs`, `candidate.rs` |
//! | 5 | gaps closed: if the verdict depends on a gap or overlap of less than 1 % of a block, it becomes *undecided* | `analysis/gaps_closed.rs` |

mod complete;
mod failure;
mod forces;
mod limit_proof;
mod proof_cache;
mod candidate;
mod programs;
mod rebalance;
mod motion;
mod pieces;
mod verdict_only;
mod wedging;
mod strategy;
mod parallel_joints;

pub(super) use candidate::Candidate;
pub(super) use limit_proof::{decided_forces, proved_exact_motion, proved_forces, proved_motion};
pub(super) use proof_cache::ProofCache;
pub(super) use verdict_only::{
    LimitResults, add_limit_to_cache, decide_verdict, least_force_error, verdict_from_cache,
};
pub(super) use wedging::only_by_wedging;

use super::{Failure, Options, UndecidedReason, Verdict};
use crate::mechanics::program::{Program, Scale, UnknownCounts, adhesion_columns, columns};
use crate::mechanics::proof::{Forces, Motion, Proof, ProofThreshold, fastest};
use crate::mechanics::solve::{Amounts, Effort, SolverSettings, determinate};
use crate::mechanics::statics::assembly::Assembly;
use programs::Decision;
pub(super) use strategy::LimitDistance;
pub use strategy::Method;

/// Bodies slower than this are left out of a reported mechanism; the fastest point has speed 1. Solver noise on resting
/// bodies reaches 1e-9, so a value a hundred times smaller could list bodies at rest. Even a value ten times larger
/// would hide no visible motion in a picture of a thousand pixels.
const MIN_SHOWN_SPEED: f64 = 1e-7;

/// Components of a velocity that are smaller than this are reported as 0, because they are rounding errors of the
/// solver.
const SPEED_NOISE: f64 = 1e-9;

/// The results for one component. Forces are in the order of its contacts and grips.
#[derive(Clone, Debug)]
pub(super) struct Findings {
    pub verdict: Verdict,
    pub doubt: Option<UndecidedReason>,
    pub forces: Forces,
    /// A proved lower bound for the sum of balancing forces, N; `None` if none was proved.
    pub force_bound: Option<f64>,
    /// Whether the forces are proved to have the least sum.
    pub least_force: bool,
    pub failures: Vec<Failure>,
    pub total_sticking: f64,
    pub unsupported: bool,
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    pub method: Method,
    pub effort: Effort,
    /// For each effect, the number of unknowns in the component's program, including the unknowns for adhesion.
    pub count: UnknownCounts,
}

/// One component of a frame with everything that its decision depends on.
struct Component<'a> {
    assembly: &'a Assembly,
    /// The units of length and force of the component's programs.
    scale: Scale,
    /// The solver's settings, in the order in which they are tried.
    settings: Vec<SolverSettings>,
    /// The thresholds that a proof must meet.
    threshold: ProofThreshold,
    /// Whether forces of least sum and failures are computed after the verdict.
    complete_result: bool,
    /// What is known about the component's distance from the limit of stability.
    limit_distance: LimitDistance,
}

/// Decides whether one component stands, and computes its forces, or its failures and its mechanism.
pub(super) fn decide_component(assembly: &Assembly, options: Options) -> Findings {
    let component = Component::new(assembly, options);
    let program = Program::new(assembly, component.scale);
    // Count the unknowns first: they are reported for each effect, even if no program is solved.
    let count = UnknownCounts::new(&program, &columns(&program))
        .plus(&UnknownCounts::new(&program, &adhesion_columns(&program)));
    if let Some(found) = component.in_closed_form(&program) {
        return Findings { count, ..found };
    }
    // First leave out those limits of robots that are far above the loads. If the resulting forces exceed such a limit,
    // or if the result is undecided, decide again with all limits.
    if let Some(generous) = program.without_non_binding_limits() {
        let decision = component.complete(&generous, component.decide_by_programs(&generous));
        if decision.verdict != Verdict::Undecided && program.allows(&decision.amounts.grip) {
            return Findings { count, ..component.findings(decision) };
        }
    }
    let decision = component.complete(&program, component.decide_by_programs(&program));
    Findings { count, ..component.findings(decision) }
}

impl<'a> Component<'a> {
    /// Creates a component, with units of length and force that suit it. `options` determine the solver settings and
    /// the accuracy.
    fn new(assembly: &'a Assembly, options: Options) -> Component<'a> {
        Component {
            assembly,
            scale: Scale::from_assembly(assembly),
            settings: options.solver_settings(),
            threshold: options.accuracy.demand(),
            complete_result: !options.verdict_only,
            limit_distance: LimitDistance::Unknown,
        }
    }

    fn accepts(&self, proof: &Proof) -> bool {
        proof.meets(self.threshold)
    }

    /// Route 1: decides a component in closed form, without a solver. `None` if no closed form applies, or if the
    /// forces that the balance equations determine have no proof.
    fn in_closed_form(&self, program: &Program) -> Option<Findings> {
        let found = if self.assembly.heaviest_load() == 0.0 {
            // Without loads, zero forces balance every body.
            self.stands(self.prove_forces(&Amounts::zero(program)))
        } else if let Some((mechanism, proof)) = self.falls_freely() {
            Findings {
                verdict: Verdict::Unstable,
                unsupported: true,
                mechanism,
                proof,
                ..self.stands(self.prove_forces(&Amounts::zero(program)))
            }
        } else {
            // The balance equations alone determine the forces, as in a stack.
            let proved = self.prove_forces(&determinate(program)?);
            if !self.accepts(&proved.proof) {
                return None;
            }
            self.stands(proved)
        };
        Some(found)
    }

    /// Returns the findings of a stable component whose forces were computed in closed form.
    fn stands(&self, proved: forces::ProvedForces) -> Findings {
        Findings {
            verdict: Verdict::Stable,
            doubt: None,
            force_bound: Some(proved.forces.sum(self.assembly.length)),
            forces: proved.forces,
            least_force: true,
            failures: Vec::new(),
            total_sticking: 0.0,
            unsupported: false,
            mechanism: Vec::new(),
            proof: proved.proof,
            method: Method::ClosedForm,
            effort: Effort::default(),
            count: UnknownCounts::default(),
        }
    }

    /// Converts a decision from program units to findings in metres and newtons.
    fn findings(&self, decision: Decision) -> Findings {
        // Convert the missing adhesion to failures in newtons. Amounts that are only solver noise are left out.
        let (mut failures, mut total_sticking) = (Vec::new(), 0.0);
        if let (Some(adhesion), Verdict::Unstable) = (&decision.adhesion, decision.verdict) {
            failures = self.failures(adhesion);
            total_sticking = failure::total(&failures, self.assembly.length);
        }
        let mut mechanism = decision.mechanism;
        if decision.verdict != Verdict::Unstable {
            mechanism.clear();
        }
        // The mechanism is proved with all bodies, but bodies slower than MIN_SHOWN_SPEED are not reported.
        let mut bodies = self.assembly.bodies.iter();
        mechanism.retain(|m| bodies.next().is_some_and(|body| fastest(body, m) > MIN_SHOWN_SPEED));
        for motion in &mut mechanism {
            // Set velocities that are only rounding of the solver to 0. The spin is measured as the speed of a point
            // at distance L.
            let plain = |v: f64| if v.abs() < SPEED_NOISE { 0.0 } else { v };
            motion.velocity = motion.velocity.map(plain);
            motion.spin = plain(motion.spin * self.assembly.length) / self.assembly.length;
        }
        // If a component falls, its contact forces balance it only together with the missing adhesion.
        let forces = match (decision.verdict, &decision.adhesion) {
            (Verdict::Unstable, _) if !self.complete_result => Forces::zero(self.assembly),
            (Verdict::Unstable, Some(adhesion)) => self.prove_with_adhesion(&decision.amounts, adhesion).0,
            _ => self.prove_forces(&decision.amounts).forces,
        };
        Findings {
            verdict: decision.verdict,
            doubt: decision.doubt,
            forces,
            force_bound: decision.force_bound,
            least_force: decision.least_force,
            failures,
            total_sticking,
            unsupported: decision.adhesion_cannot_hold && decision.verdict == Verdict::Unstable,
            mechanism,
            proof: decision.proof,
            method: decision.method,
            effort: decision.effort,
            count: UnknownCounts::default(),
        }
    }
}
