//! Questions about a component beside what [`solved`](super::solved) finds out.

use super::ladder::Decision;
use super::{Case, Findings, Place, ProofCache};
use crate::analysis::{Options, Verdict, Wedged};
use crate::assembly::Assembly;
use crate::effect::wedging::Wedging;
use crate::program::Program;
use crate::proof::{Forces, Motion};
use crate::scene::Scene;
use crate::solve::{Amounts, Effort, SelfStress, SelfStressCheck, check_self_stress, is_late};

/// Whether a component stands, and how it begins to move where it falls: the verdict of [`solved`](super::solved) without
/// the rest. What is found is remembered among the guesses; where one of them is a proof already, no program is solved.
pub(in crate::mechanics::analysis) fn judged(
    assembly: &Assembly,
    place: Place,
    guesses: &mut ProofCache,
) -> (Verdict, Vec<Motion>) {
    let guess = guessed(assembly, guesses);
    if guess.0 != Verdict::Undecided || is_late() {
        return guess;
    }
    let case = Case {
        place,
        ..Case::new(assembly, ALONE)
    };
    let program = Program::new(assembly, case.scale);
    if let Some(found) = case.in_closed_form(&program) {
        return (found.verdict, found.mechanism);
    }
    let decision = decided(&case, &program);
    match decision.verdict {
        Verdict::Stable => guesses.add_forces(assembly, case.carried(&decision.amounts).forces),
        Verdict::Unstable => guesses.add_motion(decision.mechanism.clone()),
        Verdict::Undecided => {}
    }
    (decision.verdict, decision.mechanism)
}

/// The same from the guesses alone; undecided where none is a proof.
pub(in crate::mechanics::analysis) fn guessed(
    assembly: &Assembly,
    guesses: &ProofCache,
) -> (Verdict, Vec<Motion>) {
    if is_late() {
        return (Verdict::Undecided, Vec::new());
    }
    let case = Case::new(assembly, ALONE);
    if guesses.balances(&case) {
        return (Verdict::Stable, Vec::new());
    }
    match guesses.falls(&case) {
        Some(motion) => (Verdict::Unstable, motion),
        None => (Verdict::Undecided, Vec::new()),
    }
}

/// The verdict is all that margins want.
const ALONE: Options = Options {
    verdict_only: true,
    ..Options::PLAIN
};

fn decided(case: &Case, program: &Program) -> Decision {
    // A motion that less limited robots cannot stop is a mechanism all the same.
    if let Some(generous) = program.without_non_binding_limits() {
        let decision = case.decided(&generous);
        let allowed = || program.allows(&decision.amounts.grip);
        match decision.verdict {
            Verdict::Unstable => return decision,
            Verdict::Stable if allowed() => return decision,
            _ => {}
        }
    }
    case.decided(program)
}

/// What a program found at the edge of standing, in its pure numbers.
#[derive(Debug)]
pub(in crate::mechanics::analysis) struct Ends<'a> {
    /// The program.
    pub program: &'a Program,
    /// Forces that balance just there, and the component on which they do.
    pub forces: Option<(&'a Amounts, &'a Assembly)>,
    /// The motion by which it begins to fall, and a component well beyond.
    pub motion: Option<(&'a [f64], &'a Assembly)>,
}

/// Remembers what a program found at the edge; the forces in newtons are returned.
pub(in crate::mechanics::analysis) fn learn(
    ends: &Ends,
    guesses: &mut ProofCache,
) -> Option<Forces> {
    let case = |assembly| Case {
        scale: ends.program.scale,
        ..Case::new(assembly, ALONE)
    };
    if let Some((y, assembly)) = ends.motion {
        let mut effort = Effort::default();
        let found = case(assembly).falling(ends.program, y, &mut effort);
        if let Some((motion, _)) = found {
            guesses.add_motion(motion);
        }
    }
    let (amounts, assembly) = ends.forces?;
    let forces = case(assembly).carried(amounts).forces;
    guesses.add_forces(assembly, forces.clone());
    Some(forces)
}

/// Whether some component stands only by wedging, and what shows it; nothing is said where none surely does and some
/// component stays open.
pub(in crate::mechanics::analysis) fn only_by_wedging<'a>(
    scene: &Scene,
    components: impl Iterator<Item = (&'a Assembly, &'a Findings)>,
) -> (Option<bool>, Wedging, Option<Wedged>) {
    let mut answer = (Some(false), Wedging::FromRest, None);
    for (assembly, found) in components {
        let case = Case::new(assembly, Options::default());
        let program = Program::new(assembly, case.scale);
        let given: Vec<[f64; 3]> = found
            .forces
            .grips
            .iter()
            .map(|held| {
                let force = held.force / case.scale.force;
                [force.x, force.y, held.torque / case.scale.moment()]
            })
            .collect();
        let body = |body: usize| scene.blocks[assembly.bodies[body].block.0].id.as_str();
        let face = |contact: usize| {
            let [on, from] = assembly.contacts[contact].bodies;
            format!("{}|{}", scene.name(on), scene.name(from))
        };
        match check_self_stress(&program, &given) {
            SelfStressCheck::FromRest => {}
            SelfStressCheck::OnlyWedged(squeeze) => {
                let shown = shown(&squeeze, case.scale.force, body, face);
                let wedged = Wedged::new(assembly, case.scale, &squeeze);
                return (Some(true), Wedging::Only(shown), Some(wedged));
            }
            SelfStressCheck::Undecided(doubt) => {
                answer = (None, Wedging::Open(doubt.to_string()), None)
            }
        }
    }
    answer
}

/// What shows that no springs come to rest, in words.
fn shown<'n>(
    squeeze: &SelfStress,
    unit: f64,
    body: impl Fn(usize) -> &'n str,
    face: impl Fn(usize) -> String,
) -> String {
    let moving = squeeze.moving().map(|block| body(block).to_string());
    let mut words = format!("as they give way, {} moves", several(moving));
    if squeeze.presses_nothing {
        words.push_str(" and presses nothing");
    }
    let faces = several(squeeze.contacts.iter().map(|contact| face(*contact)));
    if let Some(least) = squeeze.least.filter(|least| *least > 0.0) {
        let newtons = least * unit;
        words.push_str(&format!(
            "; to balance, {faces} must press with {newtons:.3e} N or more in all"
        ));
    }
    words.push_str(&format!("; cases ruled out: {}", squeeze.cases.len()));
    words
}

/// The first of some names, and how many more there are.
fn several(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    match names.len() {
        0..=4 => names.join(", "),
        n => format!("{} and {} more", names[..4].join(", "), n - 4),
    }
}
