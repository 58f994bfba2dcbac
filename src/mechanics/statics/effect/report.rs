//! The reports on effects that depend on the verdict or on the user's options. Only sticking adds unknowns to a linear
//! program; none changes the verdict.
//!
//! - Sticking: the missing forces, also called adhesion. With these additional forces, from mortar or from stronger
//!   robots, a falling structure would stand. They show where the structure fails. First the sum of the missing forces is
//!   minimised, then the sum of all forces. Source: [Vallat23](crate::doc::references) §2.0.8, which minimises a weighted
//!   sum of both.
//! - Mechanism: the motion with which a frame begins to collapse. The solution already contains it, because the dual
//!   variables of the balance of forces are virtual velocities. Source: Livesley 1978.
//! - Margins: how far loads, friction, tilt, the safety kernel and the limits of robots may change before the verdict
//!   changes. Each margin solves separate programs. Sources: the load factor of limit analysis, Livesley 1978; the
//!   geometric safety factor, Heyman 1966.
//! - Wedging: whether a frame stands only by a self-stress that its loads do not build up; see [`wedging`].
//! - Placement: how accurately the blocks of a frame must be placed. Its programs have forces that are affine in the
//!   errors.
//! - Movements: how a structure follows small movements of its supports. Each movement is one program with the same
//!   forces and another objective.
//! - Vehicle: the load factor for each position of a vehicle. Each position is one program with other loads.

use super::{EffectName, EffectReport, counted};

/// Whether the least missing forces were computed, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdhesionSearch {
    /// Computed, because admissible forces cannot balance the loads.
    Found,
    /// Not computed, because the frame stands.
    NotNeeded,
    /// Not computed, because the frame falls and only its verdict was requested.
    NotRequested,
}

/// Returns the report on sticking. `blocks` is the number of blocks in the frame. `unknowns` is the number of unknowns
/// that sticking adds to the linear program, or would add if it were computed.
pub fn sticking(blocks: usize, search: AdhesionSearch, unknowns: usize) -> EffectReport {
    match search {
        AdhesionSearch::Found => {
            let why = format!("no admissible forces balance the {}", counted(blocks, "block"));
            EffectReport::simulated(EffectName::Sticking, why, unknowns)
        }
        AdhesionSearch::NotNeeded => {
            EffectReport::skipped(EffectName::Sticking, "the frame stands without it", unknowns)
        }
        AdhesionSearch::NotRequested => {
            let why = "only the verdict was asked for, and a motion proves that it falls";
            EffectReport::skipped(EffectName::Sticking, why, unknowns)
        }
    }
}

/// Returns the report on the mechanism. A mechanism is computed only if the frame is unstable.
pub fn mechanism(unstable: bool) -> EffectReport {
    if unstable {
        EffectReport::simulated(EffectName::Mechanism, "the frame falls".to_string(), 0)
    } else {
        EffectReport::skipped(EffectName::Mechanism, "the frame does not fall", 0)
    }
}

/// Returns the report on margins. `decided_count` is the number of verdicts that were computed for the margins, each
/// for one connected part of the structure with a changed quantity. It is `None` if margins were not requested.
pub fn margins(decided_count: Option<usize>) -> EffectReport {
    match decided_count {
        None => EffectReport::skipped(EffectName::Margins, "not requested", 0),
        Some(n) => {
            EffectReport::simulated(EffectName::Margins, format!("requested; computed {}", counted(n, "verdict")), 0)
        }
    }
}

/// The answer of the check for wedging.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wedging {
    /// Not requested.
    NotRequested,
    /// Not checked, because the frame does not stand.
    Falls,
    /// Undecided: a state of rest was neither found nor ruled out. The text states the reason.
    Undecided(String),
    /// The springs have a state of rest: the frame does not need wedging.
    FromRest,
    /// The springs have no state of rest; the text says how this was shown.
    OnlyByWedging(String),
}

/// Returns the report on wedging. Wedging is checked only if it was requested and the frame stands.
///
/// A self-stress is a set of contact forces that balance each other without any load. Pure statics accepts any
/// self-stress: a block between two walls "stands" at any μ > 0, squeezed by a force that nothing produces.
///
/// The model has a normal spring at every application point, which can only press, and a tangential spring along every
/// interface. All springs have the same stiffness and no stress before the loads act; friction follows Coulomb's law.
/// "Only by wedging" means that these springs have no state of rest under the loads. The question and its models H and
/// A are from Kao et al. 2022.
pub fn wedging(wedging: Wedging) -> EffectReport {
    match wedging {
        Wedging::NotRequested => EffectReport::skipped(EffectName::Wedging, "not requested", 0),
        Wedging::Falls => EffectReport::skipped(EffectName::Wedging, "the frame does not stand", 0),
        Wedging::Undecided(why) => {
            EffectReport::simulated(EffectName::Wedging, format!("requested, but undecided: {why}"), 0)
        }
        Wedging::FromRest => EffectReport::simulated(
            EffectName::Wedging,
            "requested: springs without initial stress come to rest under the loads".to_string(),
            0,
        ),
        Wedging::OnlyByWedging(shown) => EffectReport::simulated(
            EffectName::Wedging,
            format!("requested: springs without initial stress do not come to rest under the loads; {shown}"),
            0,
        ),
    }
}

/// Returns the report on the placement tolerance, which was requested. It is computed if the frame stands.
pub fn placement(stands: bool) -> EffectReport {
    if stands {
        let why = "requested: errors of joints, centres of gravity and loads, all independent".to_owned();
        EffectReport::simulated(EffectName::Placement, why, 0)
    } else {
        EffectReport::skipped(EffectName::Placement, "the frame does not stand", 0)
    }
}

/// Returns the report on the movements of supports, which the scene lists. They are computed if the frame stands.
pub fn movements(movements: usize, stands: bool) -> EffectReport {
    if stands {
        EffectReport::simulated(EffectName::Movements, counted(movements, "movement"), 0)
    } else {
        EffectReport::skipped(EffectName::Movements, "the frame does not stand", 0)
    }
}

/// Returns the report on the vehicle of the scene. `positions` is the number of positions that were analysed, if there are
/// any.
pub fn vehicle(stands: bool, positions: Option<usize>) -> EffectReport {
    match (stands, positions) {
        (_, Some(count)) => EffectReport::simulated(EffectName::Vehicle, counted(count, "position"), 0),
        (true, None) => EffectReport::skipped(EffectName::Vehicle, "no position could be analysed", 0),
        (false, None) => EffectReport::skipped(EffectName::Vehicle, "the frame does not stand", 0),
    }
}
