//! How a frame follows the movements of its supports, as written in JSON.

use serde::Serialize;

use super::{Motion, Number, Pair, arrow};
use crate::mechanics::analysis::{MovementOutcome, SupportMovement};
use crate::mechanics::scene::{BodyId, Scene};

#[derive(Serialize)]
pub(super) struct Movement<'a> {
    ground: &'a str,
    outcome: &'static str,
    #[serde(flatten)]
    state: Option<State<'a>>,
}

#[derive(Serialize)]
struct State<'a> {
    unit: Number,
    force: Pair,
    work: Number,
    joints: Vec<Joint>,
    velocities: Vec<Motion<'a>>,
}

#[derive(Serialize)]
struct Joint {
    interface: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    end: Option<usize>,
    opening: Number,
    slip: Number,
}

impl<'a> Movement<'a> {
    pub(super) fn new(scene: &'a Scene, moved: &SupportMovement) -> Movement<'a> {
        let state = match &moved.outcome {
            MovementOutcome::Follows(cracked) => Some(State {
                unit: Number(cracked.unit),
                force: arrow(cracked.force),
                work: Number(cracked.work),
                joints: (cracked.cracks.iter())
                    .map(|crack| Joint {
                        interface: crack.contact,
                        end: crack.end,
                        opening: Number(crack.opening),
                        slip: Number(crack.slip),
                    })
                    .collect(),
                velocities: cracked.motions.iter().map(|motion| Motion::new(scene, motion)).collect(),
            }),
            _ => None,
        };
        let ground = scene.name(BodyId::Ground(scene.movements()[moved.number].ground));
        Movement { ground, outcome: moved.outcome.word(), state }
    }
}
