//! [`Condition`]: the weights and loads with which an answer was found.

/// One of the conditions in which a frame must stand. Without a case and a position, it is the scene as it is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Condition {
    /// The index of the load case of the scene.
    pub case: Option<usize>,
    /// The index of the position of the vehicle in [`Influence::positions`](super::Influence::positions).
    pub position: Option<usize>,
}
