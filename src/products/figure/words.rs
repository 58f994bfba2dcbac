//! Reexports the number formats that figures use from [`wording`](crate::wording).

pub use crate::wording::number::quantity;
pub(crate) use crate::wording::number::{
    FULL_UTILISATION, counted, degrees, force, letter, listed, percent, round_below, round_below_in,
};
