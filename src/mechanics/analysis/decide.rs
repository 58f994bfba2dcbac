//! How a verdict is reached: every route, in the order in which it is tried.
//!
//! A verdict is believed for its proof alone ([`crate::proof`]): forces that balance every body, or a motion that nothing
//! stops. A route may save time; it can never decide without a proof. All routes for one component end in a [`Decision`]
//! or in [`Findings`].
//!
//! For one component, by [`decide_component`]:
//!
//! | | route | file | decides because |
//! |---|---|---|---|
//! | 1 | closed form | `decide.rs`, `solve::determinate` | no load, nothing to rest on, or forces that balance alone determines |
//! | 2 | without idle limits | `decide.rs` | most robots stay far below their limits; without these the program is smaller |
//! | 3 | programs in order | `programs.rs`, `strategy/` | each may give forces or a motion, whose proof is then computed |
//! | 3a | – rebalance locally | `rebalance.rs` | forces that balance the whole may leave a light body unbalanced; it is solved again in its own scale |
//! | 3b | – free a motion of the solver's error | `motion.rs`, `pieces.rs` | a motion must open or hold every contact exactly |
//! | 4 | complete | `complete.rs` | least force of what stands, least adhesion of what falls |
//!
//! Route 4 can turn a fall into *stable*, and only if the program of least adhesion finds forces that balance every body.
//! Then both proofs hold. A motion is believed within a tolerance, and so the forces win.
//!
//! Where only the verdict counts, by [`decide_verdict`]: first forces and motions of similar components
//! (`proof_cache.rs`), then routes 1 to 3. Margins use it.
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
pub(super) use proof_cache::ProofCache;
pub(super) use verdict_only::{Ends, decide_verdict, remember_limit, verdict_from_cache};
pub(super) use wedging::only_by_wedging;

use super::{Failure, Options, UndecidedReason, Verdict};
use crate::assembly::Assembly;
use crate::program::{Program, Scale, UnknownCounts, adhesion_columns, columns};
use crate::proof::{Forces, Motion, Proof, ProofThreshold, fastest};
use crate::solve::{Amounts, Effort, SolverSettings, determinate};
use programs::Decision;
pub use strategy::Method;
pub(super) use strategy::Place;

/// Bodies slower than this are left out of a reported mechanism; the fastest point has speed 1. A solver's motion of resting
/// bodies is 1e-9 and below, so ten times less would list bodies at rest, and ten times more hides slow ones in a picture
/// of a thousand pixels not yet.
const MIN_SHOWN_SPEED: f64 = 1e-7;

/// Components of a velocity below this are reported as 0: they are the solver's rounding.
const SPEED_NOISE: f64 = 1e-9;

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

/// One component of a frame with everything that its decision depends on.
struct Component<'a> {
    assembly: &'a Assembly,
    /// Units of length and force of its programs.
    scale: Scale,
    /// The solver's settings, in the order in which they are tried.
    settings: Vec<SolverSettings>,
    /// What a proof must show to be believed.
    demand: ProofThreshold,
    /// Whether forces of least sum and failures are computed after the verdict.
    complete_result: bool,
    /// What is known of its distance from the limit of stability.
    place: Place,
}

/// Decides one component and computes what belongs to its verdict.
pub(super) fn decide_component(assembly: &Assembly, options: Options) -> Findings {
    let component = Component::new(assembly, options);
    let program = Program::new(assembly, component.scale);
    // Reported for each effect, also for those without a program to solve.
    let count = UnknownCounts::new(&program, &columns(&program))
        .plus(&UnknownCounts::new(&program, &adhesion_columns(&program)));
    if let Some(found) = component.in_closed_form(&program) {
        return Findings { count, ..found };
    }
    // Robot limits that can hardly be reached are left out first. If the answer reaches one of them, decide again with all.
    if let Some(generous) = program.without_non_binding_limits() {
        let decision = component.complete(&generous, component.decide_by_programs(&generous));
        if decision.verdict != Verdict::Undecided && program.allows(&decision.amounts.grip) {
            return Findings {
                count,
                ..component.findings(decision)
            };
        }
    }
    let decision = component.complete(&program, component.decide_by_programs(&program));
    Findings {
        count,
        ..component.findings(decision)
    }
}

impl<'a> Component<'a> {
    /// A component in its own scale.
    fn new(assembly: &'a Assembly, options: Options) -> Component<'a> {
        Component {
            assembly,
            scale: Scale::from_assembly(assembly),
            settings: options.solver_settings(),
            demand: options.accuracy.demand(),
            complete_result: !options.verdict_only,
            place: Place::Anywhere,
        }
    }

    fn believes(&self, proof: &Proof) -> bool {
        proof.meets(self.demand)
    }

    /// Route 1: what can be answered without a solver.
    fn in_closed_form(&self, program: &Program) -> Option<Findings> {
        let found = if self.assembly.heaviest_load() == 0.0 {
            // No load: no force is needed.
            self.stands(self.prove_forces(&Amounts::none(program)))
        } else if let Some((mechanism, proof)) = self.falls_freely() {
            Findings {
                verdict: Verdict::Unstable,
                unsupported: true,
                mechanism,
                proof,
                ..self.stands(self.prove_forces(&Amounts::none(program)))
            }
        } else {
            // Forces that balance alone determines, as in a stack.
            let carried = self.prove_forces(&determinate(program)?);
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
        // What is missing: each adhesion above the noise, in newtons.
        let (mut failures, mut total_sticking) = (Vec::new(), 0.0);
        if let (Some(adhesion), Verdict::Unstable) = (&decision.adhesion, decision.verdict) {
            failures = self.failures(adhesion);
            total_sticking = failure::total(&failures, self.assembly.length);
        }
        let mut mechanism = decision.mechanism;
        if decision.verdict != Verdict::Unstable {
            mechanism.clear();
        }
        // The proof used all bodies. Bodies slower than MIN_SHOWN_SPEED are not reported.
        let mut bodies = self.assembly.bodies.iter();
        mechanism.retain(|m| {
            bodies
                .next()
                .is_some_and(|body| fastest(body, m) > MIN_SHOWN_SPEED)
        });
        for motion in &mut mechanism {
            // Velocities of the solver's rounding become 0. The spin is compared as the speed of a point at distance L.
            let plain = |v: f64| if v.abs() < SPEED_NOISE { 0.0 } else { v };
            motion.velocity = motion.velocity.map(plain);
            motion.spin = plain(motion.spin * self.assembly.length) / self.assembly.length;
        }
        // The forces of a falling component balance together with the adhesion that is missing.
        let forces = match (decision.verdict, &decision.adhesion) {
            (Verdict::Unstable, _) if !self.complete_result => Forces::none(self.assembly),
            (Verdict::Unstable, Some(adhesion)) => {
                self.prove_with_adhesion(&decision.amounts, adhesion).0
            }
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
            unsupported: decision.beyond_adhesion && decision.verdict == Verdict::Unstable,
            mechanism,
            proof: decision.proof,
            method: decision.method,
            effort: decision.effort,
            count: UnknownCounts::default(),
        }
    }
}
