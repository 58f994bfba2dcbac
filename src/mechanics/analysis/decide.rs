//! Decides whether a component stands or falls. The two tables below list the routes to a verdict, for one component
//! and for a whole frame. The routes are tried in the order of their numbers.
//!
//! A verdict needs a proof ([`crate::mechanics::proof`]): forces that balance every body, or a motion that no admissible forces
//! can stop. A route may save time, but it never decides without a proof. All routes for one component return an
//! [`Outcome`].
//!
//! For one component, by [`decide_component`]:
//!
//! | | route | file | decides because |
//! |---|---|---|---|
//! | 1 | closed form | `decide.rs`, `solve::determinate` | no load, no support, or forces that the balance equations alone determine |
//! | 2 | without non-binding limits | `decide.rs` | most robots stay far below their limits; without these limits the program is smaller |
//! | 3 | programs in order | `programs.rs`, `strategy/` | each may find forces or a motion, whose proof is then computed |
//! | 3a | – rebalance locally | `rebalance.rs` | forces that balance the component as a whole may leave light bodies unbalanced; these bodies are solved again in their own scale |
//! | 3b | – remove the solver's error from a motion | `forces.rs` | a motion must not violate any contact, not even by rounding |
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
//! | 0 | warm start of `verdicts` and `Session`: the balance nearest to the loads, from the last step's active set | `analysis/warm_start.rs`, `verdict_only.rs` |
//! | 5 | gaps closed: if the verdict depends on a gap or overlap of less than 1 % of a block, it becomes *undecided* | `analysis/gaps_closed.rs` |

mod complete;
mod failure;
mod forces;
mod proof_cache;
mod programs;
mod rebalance;
mod verdict_only;
mod wedging;
mod strategy;

pub(super) use proof_cache::ProofCache;
#[cfg(feature = "certificate")]
pub(crate) use verdict_only::mechanism_of;
pub(super) use verdict_only::{
    Candidate, LimitResults, add_limit_to_cache, decide_verdict, decided_forces, least_force_error,
    proved_exact_motion, proved_forces, proved_motion, verdict_from_cache,
};
pub(super) use wedging::only_by_wedging;

use super::{Failure, Options, UndecidedReason, Verdict};
use crate::mechanics::program::{Program, Scale, UnknownCounts};
use crate::mechanics::proof::{Forces, Motion, Proof, ProofThreshold, fastest};
use crate::mechanics::solve::{Amounts, Balance, Choice, Effort, SolverSettings, determinate};
use crate::mechanics::statics::assembly::Assembly;
use forces::ProvedForces;
pub(super) use strategy::LimitDistance;
pub use strategy::Method;

/// Bodies slower than this are left out of a reported mechanism; the fastest point has speed 1. Solver noise on resting
/// bodies reaches 1e-9, so a value a hundred times smaller could list bodies at rest. Even a value ten times larger
/// would hide no visible motion in a picture of a thousand pixels.
const MIN_SHOWN_SPEED: f64 = 1e-7;

/// Components of a velocity that are smaller than this are reported as 0, because they are rounding errors of the
/// solver. A motion says nothing about a force if the point where the force acts moves more slowly than this.
pub(super) const SPEED_NOISE: f64 = 1e-9;

/// The verdict on one component, its proof, and all other results. Forces are in the order of its contacts and grips.
///
/// A route creates it, and later routes improve it. The amounts are in program units, everything else in metres and
/// newtons.
#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub verdict: Verdict,
    /// The reason if the verdict is *undecided*; `None` otherwise.
    pub doubt: Option<UndecidedReason>,
    /// Forces that balance, or that balance together with the missing adhesion.
    pub forces: Forces,
    /// The same forces, before rounding errors were corrected.
    amounts: Amounts,
    /// A proved lower bound for the sum of balancing forces, N; `None` if none was proved.
    pub force_bound: Option<f64>,
    /// Whether the forces are proved to have the least sum.
    pub least_force: bool,
    /// The adhesion that is missing for a balance; `None` if the component stands or no adhesion was computed.
    adhesion: Option<Amounts>,
    /// The missing adhesion as forces at contacts and robots.
    pub failures: Vec<Failure>,
    pub total_sticking: f64,
    /// Whether no adhesion at the application points could hold the component.
    pub unsupported: bool,
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    /// The strategy that decided.
    pub method: Method,
    pub effort: Effort,
    /// For each effect, the number of unknowns in the component's program, including the unknowns for adhesion.
    pub count: UnknownCounts,
    /// The answer of the program of least adhesion, if it was solved before the failures are computed.
    least_adhesion: Option<Balance>,
    /// Whether only some bodies fall, and the adhesion that these lack is known.
    only_some_fall: bool,
}

impl Outcome {
    /// Creates an outcome with the verdict *undecided* and zero forces.
    fn undecided(assembly: &Assembly, program: &Program) -> Outcome {
        Outcome {
            verdict: Verdict::Undecided,
            doubt: None,
            forces: Forces::zero(assembly),
            amounts: Amounts::zero(program),
            force_bound: None,
            least_force: false,
            adhesion: None,
            failures: Vec::new(),
            total_sticking: 0.0,
            unsupported: false,
            mechanism: Vec::new(),
            proof: Proof::Mechanism { power: 0.0, worst_violation: 0.0 },
            method: Method::LeastForce,
            effort: Effort::default(),
            count: UnknownCounts::default(),
            least_adhesion: None,
            only_some_fall: false,
        }
    }

    /// Sets the verdict *stable*, with the forces that prove it.
    fn stand(&mut self, proved: ProvedForces) {
        self.verdict = Verdict::Stable;
        self.proof = proved.proof;
        (self.amounts, self.forces) = (proved.amounts, proved.forces);
    }

    /// Sets the verdict *unstable*, with the mechanism that proves it.
    fn fall(&mut self, mechanism: Vec<Motion>, proof: Proof) {
        self.verdict = Verdict::Unstable;
        (self.mechanism, self.proof) = (mechanism, proof);
    }
}

/// One component of a frame with everything that its decision depends on.
struct Component<'a> {
    assembly: &'a Assembly,
    /// The units of length and force of the component's programs.
    scale: Scale,
    /// The solver's settings with plain and with full conditioning, in the order in which they are tried.
    settings: [SolverSettings; 2],
    /// The thresholds that a proof must meet.
    threshold: ProofThreshold,
    /// What is known about the component's distance from the limit of stability.
    limit_distance: LimitDistance,
}

/// Decides whether one component stands, and computes its forces, or its failures and its mechanism.
pub(super) fn decide_component(assembly: &Assembly, options: Options) -> Outcome {
    let component = Component::new(assembly, options);
    let program = Program::new(assembly, component.scale);
    // Count the unknowns first: they are reported for each effect, even if no program is solved.
    let count = UnknownCounts::new(&program);
    let closed = (!options.is_overdue()).then(|| component.in_closed_form(&program));
    if let Some(outcome) = closed.flatten() {
        return Outcome { count, ..outcome };
    }
    // First leave out those limits of robots that are far above the loads. If the resulting forces exceed such a limit,
    // or if the result is undecided, decide again with all limits.
    let generous = program.without_non_binding_limits();
    let generous = generous.map(|program| component.complete(&program, component.decide_by_programs(&program)));
    let outcome = generous
        .filter(|outcome| outcome.verdict != Verdict::Undecided && program.allows(&outcome.amounts.grip))
        .unwrap_or_else(|| component.complete(&program, component.decide_by_programs(&program)));
    Outcome { count, ..component.finish(outcome) }
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
            limit_distance: LimitDistance::Unknown,
        }
    }

    /// Whether forces of least sum and failures are computed after the verdict.
    fn is_complete(&self) -> bool {
        self.settings[0].choice == Choice::Unique
    }

    fn accepts(&self, proof: &Proof) -> bool {
        proof.meets(self.threshold)
    }

    /// Route 1: decides a component in closed form, without a solver. `None` if no closed form applies, or if the
    /// forces that the balance equations determine have no proof.
    fn in_closed_form(&self, program: &Program) -> Option<Outcome> {
        let falls_freely = self.falls_freely();
        let amounts = match falls_freely {
            // Without loads, zero forces balance every body.
            _ if self.assembly.heaviest_load() == 0.0 => Amounts::zero(program),
            Some(_) => Amounts::zero(program),
            // The balance equations alone determine the forces, as in a stack.
            None => determinate(program)?,
        };
        let proved = self.prove_forces(amounts);
        if falls_freely.is_none() && !self.accepts(&proved.proof) {
            return None;
        }
        let mut outcome = Outcome {
            force_bound: Some(proved.forces.sum(self.assembly.length)),
            least_force: true,
            method: Method::ClosedForm,
            ..Outcome::undecided(self.assembly, program)
        };
        outcome.stand(proved);
        if let Some((mechanism, proof)) = falls_freely {
            outcome.fall(mechanism, proof);
            outcome.unsupported = true;
        }
        Some(outcome)
    }

    /// Adds what is reported of an outcome: the failures in newtons, the mechanism without bodies at rest, and the
    /// forces of a component that falls.
    fn finish(&self, mut outcome: Outcome) -> Outcome {
        if outcome.verdict != Verdict::Unstable {
            outcome.mechanism.clear();
            outcome.unsupported = false;
            return outcome;
        }
        // Convert the missing adhesion to failures in newtons. Amounts that are only solver noise are left out.
        if let Some(adhesion) = &outcome.adhesion {
            outcome.failures = self.failures(adhesion);
            outcome.total_sticking = failure::total(&outcome.failures, self.assembly.length);
        }
        // The mechanism is proved with all bodies, but bodies slower than MIN_SHOWN_SPEED are not reported.
        let mut bodies = self.assembly.bodies.iter();
        outcome.mechanism.retain(|m| bodies.next().is_some_and(|body| fastest(body, m) > MIN_SHOWN_SPEED));
        for motion in &mut outcome.mechanism {
            // Set velocities that are only rounding of the solver to 0. The spin is measured as the speed of a point
            // at distance L.
            let plain = |v: f64| if v.abs() < SPEED_NOISE { 0.0 } else { v };
            motion.velocity = motion.velocity.map(plain);
            motion.spin = plain(motion.spin * self.assembly.length) / self.assembly.length;
        }
        // The contact forces of a component that falls balance it only together with the missing adhesion.
        let amounts = outcome.amounts.clone();
        outcome.forces = match &outcome.adhesion {
            _ if !self.is_complete() => Forces::zero(self.assembly),
            Some(adhesion) => self.prove_with_adhesion(amounts, adhesion).0,
            None => self.prove_forces(amounts).forces,
        };
        outcome
    }
}
