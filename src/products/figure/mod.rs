//! Draws the results of an analysis as figures.
//!
//! The figures convert the numbers of an [`Analysis`](crate::mechanics::analysis::Analysis) to shapes of a
//! [`Drawing`](crate::pictures::drawing::Drawing). No verdict depends on computations in this folder. The [`Kind`] of a figure
//! determines its content; each kind is in a separate file.

mod arrow;
mod bearing;
mod block_arrows;
mod broken;
mod cad;
mod canvas;
mod capacity;
mod change;
mod collapse;
mod compare;
mod description;
mod design;
mod displacement;
mod draw;
mod fall;
mod fill;
mod flow;
mod freebody;
mod funicular;
mod gallery;
mod gives;
mod joint_forces;
mod joints;
mod kind;
mod load;
mod mechanism;
mod moving;
mod option;
mod page;
mod panel;
mod parallel_arrows;
mod placing;
mod ring;
mod sensitivity;
mod shapes;
mod sheet;
mod stage;
mod symmetric;
mod structure;
mod thrust;
mod verdict;
mod view;

pub use crate::mechanics::analysis::acting::ForceKind as ArrowKind;
pub use arrow::{ForceArrow, Head, Marks, TurnArrow, TurnKind, arrows, marks};
pub use broken::broken;
pub use cad::dxf;
#[cfg(feature = "report")]
pub(crate) use change::{ForceChange, count_in_words, noise, shared_forces};
pub use description::caption;
pub(crate) use draw::check_panels;
pub use draw::{draw, film, forces, least_size, panels, panels_of, split};
#[cfg(feature = "report")]
pub(crate) use fall::{Fall, Joint};
pub use gallery::{Plate, gallery};
pub use kind::Kind;
#[cfg(feature = "cli")]
pub(crate) use kind::cheap_margins;
pub use option::{ArrowScale, At, Corners, Fill, ForceStyle, Normalisation, Options};
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) use option::{free_block, named_block};
pub use ring::ring;
pub use shapes::shapes;
pub use view::View;

pub use crate::products::wording::number::quantity;
