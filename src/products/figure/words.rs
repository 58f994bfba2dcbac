//! The number formats of figures. They are defined in [`wording`](crate::wording).

pub use crate::wording::number::quantity;
pub(crate) use crate::wording::number::{
    FULL, counted, degrees, force, letter, listed, percent, round_below, round_below_in,
};
