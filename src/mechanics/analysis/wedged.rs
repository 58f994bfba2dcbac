//! [`Wedged`]: the proof that a frame stands only by a self-stress, in metres and newtons.

use super::Motion;
use crate::assembly::Assembly;
use crate::geometry::Vector;
use crate::program::Scale;
use crate::solve::{self, SelfStress, Slide};

/// The self-stress without which a frame does not stand.
///
/// No springs that start without stress come to rest under the loads: as they give way, the blocks move along `gives_way`,
/// which opens the faces `interfaces` or slides them. In any balance these have to press with `at_least` newtons in all, as `bound`
/// shows: along it no other face takes work, they take at most 1 W for each newton of their normal forces, and the loads
/// give `at_least` watts.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Wedged {
    /// The faces, as numbers of the frame's contacts.
    pub interfaces: Vec<usize>,
    /// The least sum of their normal forces, N, where it was found, and the motion that shows it.
    pub at_least: Option<(f64, Vec<Motion>)>,
    /// How blocks move as springs give way; the fastest moves with about 1.
    pub gives_way: Vec<Motion>,
    /// Whether that presses no face at all.
    pub presses_nothing: bool,
    /// Ways of pressing and sliding that springs at rest cannot have; whatever springs do is one of them.
    pub ruled_out: Vec<RuledOut>,
}

/// A way in which points press and faces slide that springs at rest cannot have, whatever those do of which it says nothing.
///
/// At a point that presses N = −g with g its opening, at one that does not N = 0 and g ≥ 0; a face that sticks has T = −s with
/// s its slip along (−n_y, n_x), |T| ≤ μ(N₁ + N₂), and one that slides T = ∓μ(N₁ + N₂) and ±s ≥ μ(N₁ + N₂). Of the others N ≥ 0,
/// N ≥ −g and |T| ≤ μ(N₁ + N₂) hold all the same. Springs have unit stiffness. Together with the balance, and where no robot
/// holds a block with the condition that the work of the loads is not negative, this has no solution.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct RuledOut {
    /// The application points of which it says whether they press.
    pub points: Vec<PointCase>,
    /// The faces with friction of which it says how they slide.
    pub faces: Vec<FaceCase>,
}

/// Whether an application point presses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PointCase {
    /// Number of the frame's contact.
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
    /// Number of the frame's contact.
    pub interface: usize,
    /// Along (−n_y, n_x), against it, or not at all.
    pub slides: Slide,
}

impl Wedged {
    /// Converts the result of the solver for one component.
    pub(super) fn new(assembly: &Assembly, scale: Scale, squeeze: &SelfStress) -> Wedged {
        let motion = |pure: &[f64]| {
            let bodies = assembly.bodies.iter().zip(pure.chunks_exact(3));
            let motions = bodies.map(|(body, v)| Motion {
                block: body.block,
                velocity: Vector::new(v[0], v[1]),
                spin: v[2] / scale.length,
            });
            motions.collect::<Vec<_>>()
        };
        let contacts = squeeze.contacts.iter();
        Wedged {
            interfaces: contacts.map(|k| assembly.contacts[*k].interface).collect(),
            at_least: (squeeze.least).map(|least| (least * scale.force, motion(&squeeze.bound))),
            gives_way: motion(&squeeze.motion),
            presses_nothing: squeeze.presses_nothing,
            ruled_out: squeeze
                .cases
                .iter()
                .map(|c| described(assembly, c))
                .collect(),
        }
    }
}

/// A case with the numbers of the contacts in the frame.
fn described(assembly: &Assembly, case: &solve::RuledOut) -> RuledOut {
    let interface = |contact: usize| assembly.contacts[contact].interface;
    let points = case.points.iter();
    let faces = case.faces.iter();
    RuledOut {
        points: points
            .map(|&(contact, point, presses)| PointCase {
                interface: interface(contact),
                point,
                presses,
            })
            .collect(),
        faces: faces
            .map(|&(contact, slides)| FaceCase {
                interface: interface(contact),
                slides,
            })
            .collect(),
    }
}
