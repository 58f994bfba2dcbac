//! [`Wedged`]: the proof that a frame stands only by wedging, that is, by a self-stress, in metres and newtons.

use super::Motion;
use crate::mechanics::program::Scale;
use crate::mechanics::proof::motions_of;
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::wedge::{self, SelfStress, Slide};

/// The proof that a frame does not stand without a self-stress.
///
/// If all contacts are springs without initial stress, they do not come to rest under the loads. The blocks move
/// along `gives_way`, and the faces `interfaces` open or slide. In every balance the normal forces on these faces sum
/// to at least `at_least` newtons. The motion in `at_least` proves this. Along it, no other face absorbs power. These
/// faces absorb at most 1 W for each newton of their normal forces, and the loads have a power of `at_least` watts.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Wedged {
    /// The faces, as indices into the contacts of the frame.
    pub interfaces: Vec<usize>,
    /// A lower bound of the sum of their normal forces, N, and the motion that proves it; `None` if none was found.
    pub at_least: Option<(f64, Vec<Motion>)>,
    /// The motion of the blocks if contacts are springs; the fastest block has a speed of about 1.
    pub gives_way: Vec<Motion>,
    /// Whether the motion `gives_way` compresses no face.
    pub presses_nothing: bool,
    /// The states of pressing and sliding that springs at rest cannot have. Together they cover all possible states.
    pub ruled_out: Vec<RuledOut>,
}

/// A state of pressing points and sliding faces that springs at rest cannot have, whatever the state of points and
/// faces that it does not list.
///
/// At a point that presses, N = −g, where g is its opening. At a point that does not press, N = 0 and g ≥ 0. A face
/// that sticks has T = −s, where s is its slip along (−n_y, n_x), and |T| ≤ μ(N₁ + N₂). A face that slides has T =
/// ∓μ(N₁ + N₂) and ±s ≥ μ(N₁ + N₂). At points and faces that are not listed, N ≥ 0, N ≥ −g and |T| ≤ μ(N₁ + N₂) hold
/// in every state. Springs have unit stiffness. If no robot holds a block, the work of the loads is not negative.
/// Together with the balance, these conditions have no solution.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct RuledOut {
    /// The application points whose state is given.
    pub points: Vec<PointCase>,
    /// The faces with friction whose state is given.
    pub faces: Vec<FaceCase>,
}

/// Whether an application point presses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PointCase {
    /// The index of the contact in the frame.
    pub interface: usize,
    /// Which of its application points, 0 or 1.
    pub point: usize,
    /// Whether its spring is compressed.
    pub presses: bool,
}

/// How a face with friction slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FaceCase {
    /// The index of the contact in the frame.
    pub interface: usize,
    /// Whether the face slides, and in which direction: along (−n_y, n_x) or against it.
    pub slides: Slide,
}

impl Wedged {
    /// Converts the proof for one component from program units to metres and newtons.
    pub(super) fn new(assembly: &Assembly, scale: Scale, self_stress: &SelfStress) -> Wedged {
        let motion = |velocities: &[f64]| motions_of(assembly, velocities, scale.length);
        let contacts = self_stress.contacts.iter();
        Wedged {
            interfaces: contacts.map(|k| assembly.contacts[*k].interface).collect(),
            at_least: (self_stress.least_normal_sum)
                .map(|least| (least * scale.force, motion(&self_stress.bounding_motion))),
            gives_way: motion(&self_stress.motion),
            presses_nothing: self_stress.presses_nothing,
            ruled_out: self_stress.ruled_out.iter().map(|c| with_frame_indices(assembly, c)).collect(),
        }
    }
}

/// Converts a case that the solver ruled out: replaces contact indices of the component by those of the frame.
fn with_frame_indices(assembly: &Assembly, case: &wedge::RuledOut) -> RuledOut {
    let interface = |contact: usize| assembly.contacts[contact].interface;
    let points = case.points.iter();
    let faces = case.faces.iter();
    RuledOut {
        points: points
            .map(|&(contact, point, presses)| PointCase { interface: interface(contact), point, presses })
            .collect(),
        faces: faces.map(|&(contact, slides)| FaceCase { interface: interface(contact), slides }).collect(),
    }
}
