//! `drystone new`: a small scene to build on.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::complaint::Complaint;
use crate::cli::destination;
use crate::cli::ending::Ending;
use crate::cli::terminal::Terminal;
use crate::output::file::Existing;

/// Write a small starter scene to build on
#[derive(Debug, Args)]
pub(crate) struct New {
    /// The file to write; - or nothing prints the scene
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file where it is there already
    #[arg(long, requires = "output")]
    force: bool,
}

impl New {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<Ending, Vec<Complaint>> {
        let text = crate::scene::starter();
        match self
            .output
            .as_deref()
            .filter(|path| *path != Path::new("-"))
        {
            None => terminal.print_bytes(text.as_bytes()),
            Some(path) => self.write(path, text, terminal),
        }
        .map_err(|c| vec![c])?;
        Ok(Ending::Done)
    }

    fn write(&self, path: &Path, text: &str, terminal: &Terminal) -> Result<(), Complaint> {
        let shown = path.display();
        let existing = if self.force {
            Existing::Replace
        } else {
            Existing::Keep
        };
        destination::write(&[(path.to_owned(), text.as_bytes().to_vec())], existing)?;
        terminal.note(&format!(
            "wrote {shown}; see what it does with: drystone render {shown} -o scene.svg"
        ));
        Ok(())
    }
}
