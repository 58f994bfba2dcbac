//! `drystone mdbook` runs a preprocessor for mdBook that replaces scenes in the chapters by figures; `drystone markdown`
//! does the same with one file.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::report::stem_of;
use crate::entry::cli::source;
use crate::entry::cli::terminal::Terminal;
use crate::pictures::output::attachment::attached;
use crate::pictures::output::file::Existing;
use crate::products::report::book;

/// Draw the scenes in the chapters of an mdBook; mdbook runs this preprocessor itself
///
/// In book.toml, add [preprocessor.drystone] with command = "drystone mdbook". In a chapter, add a fenced block that
/// begins with drystone and contains a scene, or names a file with file=scene.json. More options: kind=, block=,
/// theme=, width=, amounts, nocaption.
#[derive(Debug, Args)]
pub(crate) struct MdBook {
    #[command(subcommand)]
    command: Option<MdBookCommand>,
}

#[derive(Debug, Subcommand)]
enum MdBookCommand {
    /// Report whether a renderer is supported: exit with 0 for html, with 1 for any other
    Supports {
        /// The renderer's name
        renderer: String,
    },
}

impl MdBook {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        if let Some(MdBookCommand::Supports { renderer }) = &self.command {
            return Ok(if renderer == "html" { ExitStatus::Done } else { ExitStatus::Unstable });
        }
        let input = text(Path::new("-"))?;
        let drawn = book::illustrate(&input).map_err(|problems| CliError::Book(problems.0))?;
        terminal.print_bytes(drawn.as_bytes())?;
        Ok(ExitStatus::Done)
    }
}

/// Draw the scenes in a Markdown file: each becomes an SVG file with alt text
///
/// A fenced block that begins with drystone contains a scene, or names a file with file=scene.json. More options: kind=,
/// block=, theme= (auto for light and dark pages), width=, amounts, nocaption.
#[derive(Debug, Args)]
pub(crate) struct Markdown {
    /// The Markdown file; - reads standard input
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The Markdown file to write; the pictures stand next to it, as OUT-1.svg, OUT-2.svg and so on
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Leave the scene files out of the pictures
    #[arg(long)]
    no_source: bool,
}

impl Markdown {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let text = text(&self.input)?;
        let (text, pictures) = book::illustrate_text(&text, &self.input, &stem_of(&self.output))
            .map_err(|problems| CliError::Book(problems.0))?;
        let folder = self.output.parent().unwrap_or(Path::new(""));
        let count = pictures.len();
        let mut files = vec![(self.output.clone(), text.into_bytes())];
        files.extend(pictures.into_iter().map(|picture| {
            let scene = Some(picture.scene.as_bytes()).filter(|_| !self.no_source);
            (folder.join(picture.name), attached(picture.svg.into_bytes(), scene))
        }));
        let paths: Vec<PathBuf> = files.iter().map(|(path, _)| path.clone()).collect();
        destination::refuse_overwrites(&paths, &[&self.input])?;
        destination::make_folder(folder, folder)?;
        destination::write(&files, Existing::Replace, std::slice::from_ref(&self.output))?;
        terminal.note(&format!("{}: {count} {}", self.output.display(), if count == 1 { "figure" } else { "figures" }));
        Ok(ExitStatus::Done)
    }
}

/// Reads a text file, or standard input for `-`.
fn text(path: &Path) -> Result<String, CliError> {
    String::from_utf8(source::bytes(path)?)
        .map_err(|_| CliError::not_read(source::name(path), "it is not valid UTF-8; save it as UTF-8"))
}
