//! Re-exports the functions of [`wording`](crate::products::wording) with which figures format numbers and lists.

pub use crate::products::wording::number::quantity;
pub(crate) use crate::products::wording::number::{
    FULL_UTILISATION, counted, force, letter, listed, percent, round_below, round_below_in,
};
