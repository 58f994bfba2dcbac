//! [`Wedged`]: what shows that a frame stands only by a self-stress, in metres and newtons.

use super::Motion;
use crate::assembly::Assembly;
use crate::geometry::Vector;
use crate::program::Scale;
use crate::solve::Squeeze;

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
    /// Cases of pressing and sliding points that were ruled out.
    pub cases: usize,
}

impl Wedged {
    /// What a solver found of one component.
    pub(super) fn of(assembly: &Assembly, scale: Scale, squeeze: &Squeeze) -> Wedged {
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
            cases: squeeze.cases,
        }
    }
}
