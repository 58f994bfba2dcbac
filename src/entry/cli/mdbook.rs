//! `drystone mdbook`: runs a preprocessor for mdBook that replaces scenes in the chapters by figures.

use std::io;

use clap::{Args, Subcommand};

use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;
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
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        if let Some(MdBookCommand::Supports { renderer }) = &self.command {
            return Ok(if renderer == "html" { ExitStatus::Done } else { ExitStatus::Unstable });
        }
        let input = io::read_to_string(io::stdin().lock());
        let input = input.map_err(|error| CliError::not_read("standard input", error))?;
        let drawn = book::illustrate(&input).map_err(|problems| CliError::Book(problems.0))?;
        terminal.print_bytes(drawn.as_bytes())?;
        Ok(ExitStatus::Done)
    }
}
