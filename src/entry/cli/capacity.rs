//! [`CapacityArgs`]: the options `--capacity` and `--for-all`, which `check` and `render` share.

use clap::Args;

use crate::entry::cli::error::CliError;
use crate::mechanics::analysis::{Options, typed_capacity};
use crate::mechanics::scene::Scene;

/// The block whose capacity is computed, and the ranges of `--for-all`: the block must be able to carry the forces for
/// all values in these ranges.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct CapacityArgs {
    /// Compute all forces that a block can carry in addition to the forces that already act: BLOCK at its centroid
    /// (or the force of the robot that holds it), BLOCK@x,y at a point, BLOCK@x,y..x,y at two points, as their
    /// resultant
    #[arg(long, value_name = "BLOCK[@x,y]")]
    capacity: Option<String>,
    /// With --capacity: only forces that the block can carry for all values in these ranges, such as
    /// tilt=±2,horizontal=±0.05,friction=0.5..0.7
    #[arg(long, value_name = "RANGES", requires = "capacity", allow_hyphen_values = true)]
    for_all: Option<String>,
}

impl CapacityArgs {
    /// True if `--capacity` was given.
    pub(crate) fn are_requested(&self) -> bool {
        self.capacity.is_some()
    }

    /// Adds the block of `--capacity` and the ranges of `--for-all` to the options of an analysis. Without
    /// `--capacity`, the options stay unchanged.
    pub(crate) fn add_to(&self, options: Options, scene: &Scene) -> Result<Options, CliError> {
        let Some(typed) = &self.capacity else {
            return Ok(options);
        };
        let request = typed_capacity(scene, typed, self.for_all.as_deref());
        let request = request.map_err(CliError::CommandLine)?;
        Ok(options.capacity(request))
    }
}
