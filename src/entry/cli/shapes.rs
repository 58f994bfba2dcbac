//! `drystone shapes`: draws a sheet of the built-in shapes.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::entry::cli::destination::{self, Destination};
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::picture::Picture;
use crate::entry::cli::style_args::StyleArgs;
use crate::entry::cli::terminal::Terminal;
use crate::pictures::drawing::Theme;
use crate::pictures::output::file::Existing;
use crate::products::figure;

/// Draw the built-in shapes of the triangular lattice, with their cells and origins
#[derive(Debug, Args)]
pub(crate) struct Shapes {
    /// The output: a .svg, .png or .pdf file, a folder, or - for standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    look: StyleArgs,
}

impl Shapes {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let theme = self.look.theme().map_err(|c| vec![c])?;
        self.draw(&theme, terminal).map_err(|c| vec![c])?;
        Ok(ExitStatus::Done)
    }

    fn draw(&self, theme: &Theme, terminal: &Terminal) -> Result<(), CliError> {
        let destination = Destination::from_path(&self.output);
        let format = destination.format(self.picture.requested_format())?;
        self.picture.check(format)?;
        if let (Destination::Stdout, true, Some(why)) = (&destination, terminal.is_watched(), format.unreadable()) {
            return Err(CliError::CommandLine(why));
        }
        let fonts = self.picture.fonts()?;
        let bytes = self.picture.bytes(figure::shapes(theme), format, &fonts)?;
        let path = match &destination {
            Destination::Stdout => return terminal.print_bytes(&bytes),
            Destination::File(path) => path.clone(),
            Destination::Folder(folder) => folder.join(format!("shapes.{}", format.ending())),
        };
        let style: Vec<&Path> = self.look.file().into_iter().collect();
        destination::refuse_overwrites(std::slice::from_ref(&path), &style)?;
        if let Destination::Folder(folder) = &destination {
            destination::make_folder(folder)?;
        }
        destination::write(&[(path, bytes)], Existing::Replace)
    }
}
