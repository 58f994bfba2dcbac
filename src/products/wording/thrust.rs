//! [`thrust_range`] states between which values the horizontal thrust of a frame may lie.

use super::number::quantity;
use crate::mechanics::analysis::Analysis;

/// Describes the range of the horizontal thrust at the supports of a frame (numbered from 0) in a sentence without a full
/// stop. `None` if there is no single thrust, or if it would take too long to compute
/// ([`Analysis::thrust_states`]).
pub fn thrust_range(analysis: &Analysis, frame: usize) -> Option<String> {
    let states = analysis.thrust_states(frame);
    let force = |thrust: f64| quantity(thrust, analysis.scene.units.force());
    let (least, greatest) = (force(states.least?.thrust), states.greatest.map(|state| force(state.thrust)));
    Some(match greatest {
        Some(greatest) if greatest == least => format!("The horizontal thrust is {least} in all of them"),
        Some(greatest) => format!("The horizontal thrust H may lie between {least} and {greatest}"),
        None => format!("The horizontal thrust H is at least {least}"),
    })
}
