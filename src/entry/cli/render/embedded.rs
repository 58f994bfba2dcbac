//! Draws figures of an existing analysis for a caller in the same process, such as the Python module. The options
//! have the same form as the arguments of `render` on the command line.

use clap::Parser;

use super::{ANIMATION_WIDTH, Render};
use crate::entry::cli::error::CliError;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::picture::Format;
use crate::entry::cli::source::Source;
use crate::mechanics::analysis::{Analysis, Options};
use crate::mechanics::scene::Sketch;
use crate::pictures::drawing::Drawing;
use crate::pictures::output::animation;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;

/// A command line that consists of the options of `render` only.
#[derive(Debug, Parser)]
#[command(name = "figure", disable_help_flag = true)]
struct Line {
    #[command(flatten)]
    render: Render,
}

/// Parses the options of `render`. Returns the options, the format for the file extension `ending`, and the fonts of
/// `--font`.
fn parsed(words: &[String], ending: &str) -> Result<(Render, Format, Fonts), String> {
    let output = format!("figure.{ending}");
    let head = ["figure", "scene.json", "-o", output.as_str()];
    let line = head.into_iter().chain(words.iter().map(String::as_str));
    let render = Line::try_parse_from(line).map_err(|error| trimmed(&error.render().to_string()))?.render;
    if render.panels || render.pages || render.watch || render.strict || render.frame.is_some() {
        let why = "the options panels, pages, watch, strict and frame are available on the command line only";
        return Err(why.into());
    }
    let format = Format::from_ending(ending).ok_or_else(|| {
        let known = Format::ALL.map(Format::ending).join(", ");
        format!("there is no format {ending}; a figure is one of {known}")
    })?;
    render.check_kind(format).map_err(|error| words_of(&error))?;
    let fonts = render.picture.fonts().map_err(|error| words_of(&error))?;
    Ok((render, format, fonts))
}

/// Draws a figure, or an animation if `words` contains `--animate`, and returns its bytes. `words` are options of
/// `render`, and `ending` selects the format.
///
/// # Errors
/// Returns a message if `render` does not accept the words, or if the picture cannot be written.
pub(crate) fn figure(words: &[String], ending: &str, analysis: &Analysis) -> Result<Vec<u8>, String> {
    let (render, format, fonts) = parsed(words, ending)?;
    let drawn = || {
        let theme = render.look.theme()?;
        let options = render.options(theme);
        let mut analysis = analysis.clone();
        let analysis_options = render.with_requests(&Options::default(), &analysis.scene)?;
        if render.kind.panels().is_some_and(|kind| kind.lacks(&analysis, &analysis_options)) {
            analysis = render.analysed(&analysis.scene, &analysis_options);
        }
        let source = Source { path: "the scene".into(), scene: (*analysis.scene).clone() };
        let options = render.zoomed(&source, &options)?;
        if render.picture.draws_words(format) && missing_glyphs::lacks(&analysis.scene, &fonts) {
            analysis.scene = missing_glyphs::legible(&analysis.scene, &fonts).into();
        }
        match render.animate {
            None => {
                let drawing = render.drawing(&source, &analysis, &options)?;
                render.picture.bytes(drawing, format, &fonts)
            }
            Some(seconds) => {
                let kind = render.kind.panels().unwrap_or_default();
                let film = figure::film(&analysis, kind, &options, seconds);
                let animate = format.animate().unwrap_or(animation::gif);
                let picture = render.picture.clone().or_width(ANIMATION_WIDTH, format);
                picture.animated(film, animate, &fonts)
            }
        }
    };
    drawn().map_err(|error| words_of(&error))
}

/// Draws the outlines of a scene that is not valid, with its problems marked and numbered, and returns the bytes of the
/// picture. `text` is the scene as JSON.
///
/// # Errors
/// Returns a message in the same cases as [`figure`].
pub(crate) fn sketch(words: &[String], ending: &str, text: &str) -> Result<Vec<u8>, String> {
    let (render, format, fonts) = parsed(words, ending)?;
    let drawn = || {
        let options = render.options(render.look.theme()?);
        let sketch = Sketch::from_bytes(text.as_bytes(), render.level.contact_tolerance);
        let drawing: Drawing = figure::broken(&sketch, &options);
        render.picture.bytes(drawing, format, &fonts)
    };
    drawn().map_err(|error| words_of(&error))
}

/// Returns the message of an error, without the parts that are useful only on the command line.
fn words_of(error: &CliError) -> String {
    trimmed(error.page(None).text())
}

/// Removes from a message of the command line the word "error" at its start, and the usage and the hint at its end.
fn trimmed(text: &str) -> String {
    let text = text.trim_start_matches("error: ");
    let ends = ["\n\nUsage: ", "\n\nFor more information, try"];
    let end = ends.iter().filter_map(|end| text.find(end)).min();
    text[..end.unwrap_or(text.len())].trim_end().to_owned()
}
