//! Checks whether a component stands only by wedging: by a self-stress that its loads do not cause when the contacts
//! are unstressed at first.

use super::{Component, Outcome};
use crate::mechanics::analysis::{Options, Wedged};
use crate::mechanics::program::Program;
use crate::mechanics::scene::Scene;
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect::report::Wedging;
use crate::mechanics::wedge::{SelfStress, SelfStressCheck, check_self_stress};
use crate::text::{first_of, power_of_ten};

/// The largest number of blocks, and of contacts, that a sentence names.
const MAX_NAMES: usize = 4;

/// Checks whether some component stands only by wedging. Returns the answer, the outcome for the effect report, and
/// the proof. The answer is `None` if some components are undecided and none is proved to stand only by wedging.
pub(in crate::mechanics::analysis) fn only_by_wedging<'a>(
    scene: &Scene,
    components: impl Iterator<Item = (&'a Assembly, &'a Outcome)>,
) -> (Option<bool>, Wedging, Option<Wedged>) {
    let mut answer = (Some(false), Wedging::FromRest, None);
    for (assembly, found) in components {
        let component = Component::new(assembly, Options::default());
        let program = Program::new(assembly, component.scale);
        let grip_forces: Vec<[f64; 3]> = found
            .forces
            .grips
            .iter()
            .map(|held| {
                let force = held.force / component.scale.force;
                [force.x, force.y, held.torque / component.scale.moment()]
            })
            .collect();
        let body = |body: usize| scene.blocks[assembly.bodies[body].block.0].id.as_str();
        let face = |contact: usize| {
            let [on, from] = assembly.contacts[contact].bodies;
            format!("{}|{}", scene.name(on), scene.name(from))
        };
        match check_self_stress(&program, &grip_forces) {
            SelfStressCheck::FromRest => {}
            SelfStressCheck::OnlyWedged(self_stress) => {
                let newtons = |force: f64| {
                    let unit = scene.units.force();
                    let force = unit.value_from_si(force * component.scale.force);
                    format!("{} {}", power_of_ten(force, 3), unit.symbol())
                };
                let shown = describe(&self_stress, newtons, body, face);
                let wedged = Wedged::new(assembly, component.scale, &self_stress);
                return (Some(true), Wedging::OnlyByWedging(shown), Some(wedged));
            }
            SelfStressCheck::Undecided(doubt) => answer = (None, Wedging::Undecided(doubt.to_string()), None),
        }
    }
    answer
}

/// Describes the proof of wedging in words: which blocks move if the contacts are springs without initial stress, which
/// normal forces every balance needs at the wedged contacts, and how many cases were ruled out.
fn describe<'n>(
    self_stress: &SelfStress,
    force: impl Fn(f64) -> String,
    body: impl Fn(usize) -> &'n str,
    face: impl Fn(usize) -> String,
) -> String {
    let moving = self_stress.moving_blocks().map(|block| body(block).to_string());
    let mut words =
        format!("as the springs give way, these blocks move: {}", first_of(moving.collect::<Vec<String>>(), MAX_NAMES));
    if self_stress.presses_nothing {
        words.push_str(" (they press no contact)");
    }
    let faces = first_of(self_stress.contacts.iter().map(|contact| face(*contact)), MAX_NAMES);
    if let Some(least) = self_stress.least_normal_sum.filter(|least| *least > 0.0) {
        words.push_str(&format!("; in every balance, the normal forces at {faces} sum to {} or more", force(least)));
    }
    words.push_str(&format!("; cases of pressing and sliding ruled out: {}", self_stress.ruled_out.len()));
    words
}
