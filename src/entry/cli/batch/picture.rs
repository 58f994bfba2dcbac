//! [`PictureOutput`]: draws the scenes of a batch into a folder.

use std::path::PathBuf;
use std::sync::Arc;

use crate::entry::cli::destination;
use crate::entry::cli::error::CliError;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::picture::{Format, Picture};
use crate::mechanics::analysis::Analysis;
use crate::pictures::output::file::Existing;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;
use crate::products::result::PictureOutcome;

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
