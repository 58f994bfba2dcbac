//! `drystone schema`: the JSON Schema of a scene file, for editors and other programs.

use clap::Args;

use crate::cli::complaint::Complaint;
use crate::cli::ending::Ending;
use crate::cli::terminal::Terminal;

/// Print the JSON Schema of scene files
///
/// An editor that is given it completes and checks a scene while it is written. Put its path into the scene as "$schema".
#[derive(Debug, Args)]
pub(crate) struct Schema {}

impl Schema {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<Ending, Vec<Complaint>> {
        let mut text = crate::scene::schema();
        if !text.ends_with('\n') {
            text.push('\n');
        }
        terminal.print_bytes(text.as_bytes()).map_err(|c| vec![c])?;
        Ok(Ending::Done)
    }
}
