//! Draws two scenes in one figure that compares them.

use super::choice::KindChoice;
use super::{Render, Rendered, summary};
use crate::entry::cli::destination::Destination;
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::picture::Format;
use crate::entry::cli::source::Source;
use crate::mechanics::analysis::{self, Analysis};
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;
use std::sync::Arc;

impl Render {
    /// True if the command draws one figure that compares two scenes, instead of one figure for each scene.
    pub(super) fn joins(&self, scenes: usize, destination: &Destination) -> bool {
        self.kind == KindChoice::Panels(figure::Kind::Compare)
            && scenes == 2
            && !matches!(destination, Destination::Folder(_))
    }

    /// Draws the last frames of two scenes next to each other, with the changes between them.
    pub(super) fn compared(
        &self,
        sources: [&Source; 2],
        analysis_options: &analysis::Options,
        options: &figure::Options,
        format: Format,
        fonts: &Fonts,
    ) -> Result<Rendered, CliError> {
        if self.zoom.is_some() || self.panels || self.pages || self.animate.is_some() {
            let why = "a comparison of two scenes is one picture; leave out --zoom, --panels, --pages and --animate";
            return Err(CliError::CommandLine(why.into()));
        }
        let scenes = sources.map(|source| {
            if self.picture.draws_words(format) {
                missing_glyphs::legible(&source.scene, fonts)
            } else {
                source.scene.clone()
            }
        });
        let [before, after] = [&scenes[0], &scenes[1]].map(|s| Analysis::with(s, analysis_options));
        let title = |number: usize| match scenes[number].title.as_str() {
            title if title.is_empty() || scenes[0].title == scenes[1].title => sources[number].stem(),
            title => title.to_owned(),
        };
        let last = |analysis: &Analysis| analysis.frames.len() - 1;
        let (a, b) = ((&before, last(&before)), (&after, last(&after)));
        let (scene, frames) = analysis::pair(a, b, [title(0), title(1)]).map_err(|why| {
            let names = sources.map(Source::name);
            CliError::CommandLine(format!("{} and {}: {why}", names[0], names[1]))
        })?;
        let joined = Analysis { scene: Arc::new(scene), frames, notes: Vec::new() };
        let drawing = figure::draw(&joined, figure::Kind::Compare, options);
        Ok(Rendered {
            bytes: vec![self.picture.bytes(drawing, format, fonts)?],
            ending: ExitStatus::from_analysis(&joined),
            summary: summary(&joined),
        })
    }
}
