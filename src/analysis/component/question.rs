//! Questions about a component beside what [`solved`](super::solved) finds out.

use super::{Case, Findings};
use crate::analysis::{Options, Verdict, Wedged};
use crate::assembly::Assembly;
use crate::effect::wedging::Wedging;
use crate::program::Program;
use crate::proof::Motion;
use crate::scene::Scene;
use crate::solve::{Reach, Squeeze, reach};

/// Whether a component stands, and how it begins to move where it falls: the verdict of [`solved`](super::solved) without
/// the rest.
pub(in crate::analysis) fn judged(assembly: &Assembly) -> (Verdict, Vec<Motion>) {
    let case = Case::of(assembly, Options::default());
    let program = Program::of(assembly, case.scale);
    if let Some(found) = case.in_closed_form(&program) {
        return (found.verdict, found.mechanism);
    }
    // A motion that less limited robots cannot stop is a mechanism all the same.
    if let Some(generous) = program.without_lavish_limits() {
        let decision = case.decided(&generous);
        let allowed = || program.allows(&decision.amounts.grip);
        match decision.verdict {
            Verdict::Unstable => return (Verdict::Unstable, decision.mechanism),
            Verdict::Stable if allowed() => return (Verdict::Stable, Vec::new()),
            _ => {}
        }
    }
    let decision = case.decided(&program);
    (decision.verdict, decision.mechanism)
}

/// Whether some component stands only by wedging, and what shows it; nothing is said where none surely does and some
/// component stays open.
pub(in crate::analysis) fn only_by_wedging<'a>(
    scene: &Scene,
    components: impl Iterator<Item = (&'a Assembly, &'a Findings)>,
) -> (Option<bool>, Wedging, Option<Wedged>) {
    let mut answer = (Some(false), Wedging::FromRest, None);
    for (assembly, found) in components {
        let case = Case::of(assembly, Options::default());
        let program = Program::of(assembly, case.scale);
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
        match reach(&program, &given) {
            Reach::FromRest => {}
            Reach::OnlyWedged(squeeze) => {
                let shown = shown(&squeeze, case.scale.force, body, face);
                let wedged = Wedged::of(assembly, case.scale, &squeeze);
                return (Some(true), Wedging::Only(shown), Some(wedged));
            }
            Reach::Unclear(doubt) => answer = (None, Wedging::Open(doubt.to_string()), None),
        }
    }
    answer
}

/// What shows that no springs come to rest, in words.
fn shown<'n>(
    squeeze: &Squeeze,
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
    words.push_str(&format!("; cases ruled out: {}", squeeze.cases));
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
