//! Commands that print or write what the program knows about itself: `drystone schema`, `drystone style`,
//! `drystone completions` and `drystone man`. No other file uses `clap_complete` and `clap_mangen`.

use std::path::PathBuf;

use clap::{Args, Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;

use crate::entry::cli::CommandLine;
use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;
use crate::entry::value::ThemeName;
use crate::pictures::output::file::Existing;
use crate::products::result;
use crate::text::typed_word;

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
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let text = if self.result { result::schema() } else { crate::mechanics::scene::schema() };
        terminal.print_bytes(text.as_bytes())?;
        Ok(ExitStatus::Done)
    }
}

/// Print a theme as a style file, for the option --style
///
/// Change some keys and delete the others: keys that a style file does not have come from the theme that it names.
#[derive(Debug, Args)]
pub(crate) struct Style {
    /// The theme to print
    #[arg(long, value_name = "NAME", default_value = "plain", value_parser = typed_word::<ThemeName>())]
    theme: ThemeName,
}

impl Style {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let json = self.theme.theme().to_json();
        terminal.print_bytes(json.as_bytes())?;
        Ok(ExitStatus::Done)
    }
}

/// Print the completion script for a shell
///
/// For bash: drystone completions bash > ~/.local/share/bash-completion/completions/drystone
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let mut bytes = Vec::new();
        clap_complete::generate(self.shell, &mut CommandLine::command(), "drystone", &mut bytes);
        terminal.print_bytes(&bytes)?;
        Ok(ExitStatus::Done)
    }
}

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
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let mut pages = Vec::new();
        let mut command = CommandLine::command();
        command.build();
        collect(&command, &mut pages).map_err(|error| CliError::not_written(self.folder.display(), error))?;
        let files: Vec<(PathBuf, Vec<u8>)> =
            (pages.into_iter()).map(|(name, page)| (self.folder.join(name), page)).collect();
        destination::make_folder(&self.folder, &self.folder)?;
        destination::write(&files, Existing::Replace, &[])?;
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
