//! [`About`]: what the program has to know about a kind of figure before it draws it.

/// The name of a kind of figure, and its requirements. Every kind has a name, a help text and a title.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct About {
    /// The name on the command line and in settings, in lower case.
    pub name: &'static str,
    /// One line for the help of `drystone render --kind`.
    pub help: &'static str,
    /// The title of the figure if the scene has none.
    pub title: &'static str,
    /// Whether the analysis has to compute the margins.
    pub needs_margins: bool,
    /// Whether the analysis has to compute the forces that a block can carry.
    pub needs_capacity: bool,
    /// Whether the analysis has to compute how accurately the blocks must be placed.
    pub needs_placement: bool,
    /// Whether the analysis has to find out which blocks may leave.
    pub needs_removable: bool,
    /// Whether the analysis has to compute how a margin changes with corners, weights, friction and loads.
    pub needs_sensitivity: bool,
    /// Whether each falling part is shown with one elementary mechanism
    /// ([`Analysis::elementary`](crate::mechanics::analysis::Analysis::elementary)), and an animation shows several steps of its
    /// motion.
    pub needs_elementary_mechanisms: bool,
    /// Whether the arrows of all panels have one scale, independent of the options.
    pub shares_arrow_scale: bool,
    /// Whether the figure shows no verdicts, independent of the options.
    pub hides_verdicts: bool,
    /// Whether the line of the verdict states another margin than the headline margin.
    pub states_own_margin: bool,
    /// Whether the figure shows only the block that the options name, in one frame.
    pub shows_one_block: bool,
}
