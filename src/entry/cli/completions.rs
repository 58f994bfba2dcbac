//! `drystone completions`: prints completion scripts for shells. No other file uses `clap_complete`.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use crate::entry::cli::CommandLine;
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;

/// Print the completion script for a shell
///
/// For bash: drystone completions bash > ~/.local/share/bash-completion/completions/drystone
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let mut bytes = Vec::new();
        clap_complete::generate(self.shell, &mut CommandLine::command(), "drystone", &mut bytes);
        terminal.print_bytes(&bytes).map_err(|c| vec![c])?;
        Ok(ExitStatus::Done)
    }
}
