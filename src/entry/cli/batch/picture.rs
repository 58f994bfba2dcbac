//! [`PictureOutput`]: draws the scenes of a batch into a folder.

use std::path::PathBuf;
use std::sync::Arc;

use crate::analysis::Analysis;
use crate::cli::destination;
use crate::cli::error::CliError;
use crate::cli::missing_glyphs;
use crate::cli::picture::{Format, Picture};
use crate::figure;
use crate::output::file::Existing;
use crate::output::fonts::Fonts;
use crate::result::PictureOutcome;

/// The options for pictures, and their folder.
pub(super) struct PictureOutput {
    pub(super) folder: PathBuf,
    pub(super) format: Format,
    pub(super) picture: Picture,
    pub(super) fonts: Fonts,
    pub(super) options: figure::Options,
}

impl PictureOutput {
    /// Draws a scene and writes the picture file, whose name without the extension is `name`. Returns the name of the
    /// file, or the reason why the picture cannot be drawn. Returns an error if the file cannot be written.
    pub(super) fn draw(&self, analysis: &Analysis, name: &str) -> Result<PictureOutcome, CliError> {
        let name = format!("{name}.{}", self.format.ending());
        let legible = match self.picture.draws_words(self.format) {
            true => Arc::new(missing_glyphs::legible(&analysis.scene, &self.fonts)),
            false => Arc::clone(&analysis.scene),
        };
        let shown = Analysis { scene: legible, frames: analysis.frames.clone(), notes: Vec::new() };
        let drawing = figure::forces(&shown, &self.options);
        match self.picture.bytes(drawing, self.format, &self.fonts) {
            Ok(bytes) => {
                let file = (self.folder.join(&name), bytes);
                destination::write(&[file], Existing::Replace)?;
                Ok(PictureOutcome::Drawn(name))
            }
            Err(CliError::CommandLine(why) | CliError::NotWritten { why, .. }) => Ok(PictureOutcome::Refused(why)),
            Err(other) => Err(other),
        }
    }
}
