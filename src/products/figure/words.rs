//! Re-exports the functions of [`wording`](crate::wording) with which figures format numbers and lists.

pub use crate::wording::number::quantity;
pub(crate) use crate::wording::number::{
    FULL_UTILISATION, counted, degrees, force, letter, listed, percent, round_below, round_below_in,
};
