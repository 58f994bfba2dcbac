//! `drystone style`: prints a theme as a style file that a user can edit.

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;
use crate::pictures::drawing::Theme;

/// Print a theme as a style file, for the option --style
///
/// Change some keys and delete the others: keys that a style file does not have come from the theme that it names.
#[derive(Debug, Args)]
pub(crate) struct Style {
    /// The theme to print
    #[arg(long, value_name = "NAME", default_value = "thesis", value_parser = PossibleValuesParser::new(Theme::NAMES))]
    theme: String,
}

impl Style {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let theme = Theme::named(&self.theme).unwrap_or_default();
        let json = theme.to_json();
        terminal.print_bytes(json.as_bytes()).map_err(|c| vec![c])?;
        Ok(ExitStatus::Done)
    }
}
