//! `drystone schema`: prints the JSON Schema of scene files or of results.

use clap::Args;

use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;
use crate::products::result;

/// Print the JSON Schema of scene files, or of results
///
/// With the schema, an editor completes and checks a scene while you write it. Put the path of the schema into the
/// scene as "$schema".
#[derive(Debug, Args)]
pub(crate) struct Schema {
    /// Print the schema of the output of check --json instead of the schema of scene files
    #[arg(long)]
    result: bool,
}

impl Schema {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let text = if self.result { result::schema() } else { crate::mechanics::scene::schema() };
        terminal.print_bytes(text.as_bytes()).map_err(|c| vec![c])?;
        Ok(ExitStatus::Done)
    }
}
