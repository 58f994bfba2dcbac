//! `drystone man`: writes manual pages. No other file uses `clap_mangen`.

use std::path::PathBuf;

use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;

use crate::entry::cli::CommandLine;
use crate::entry::cli::destination;
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;
use crate::pictures::output::file::Existing;

/// Write the manual pages into a folder, one for each command
///
/// To a folder in which the program man looks for pages: drystone man ~/.local/share/man/man1
#[derive(Debug, Args)]
pub(crate) struct Manual {
    /// The folder; created if it does not exist
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

impl Manual {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let mut pages = Vec::new();
        let mut command = CommandLine::command();
        command.build();
        collect(&command, &mut pages).map_err(|error| {
            let what = self.folder.display().to_string();
            vec![CliError::NotWritten { what, why: error.to_string() }]
        })?;
        let files: Vec<(PathBuf, Vec<u8>)> =
            (pages.into_iter()).map(|(name, page)| (self.folder.join(name), page)).collect();
        destination::make_folder(&self.folder).map_err(|c| vec![c])?;
        destination::write(&files, Existing::Replace).map_err(|c| vec![c])?;
        terminal.note(&format!("wrote {} pages into {}", files.len(), self.folder.display()));
        Ok(ExitStatus::Done)
    }
}

/// Adds the pages of a command and of its subcommands: `drystone-new-arch.1` for `drystone new arch`.
fn collect(command: &Command, pages: &mut Vec<(String, Vec<u8>)>) -> std::io::Result<()> {
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render(&mut page)?;
    pages.push((man.get_filename(), page));
    for inner in command.get_subcommands() {
        if inner.get_name() != "help" {
            collect(inner, pages)?;
        }
    }
    Ok(())
}
