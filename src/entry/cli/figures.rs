//! `drystone figures`: draws the gallery, figures 1 to 9 of Vallat (2023), with captions. `drystone shapes`: draws a sheet
//! of the built-in shapes.

use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::entry::cli::destination::{self, Destination};
use crate::entry::cli::error::{CliError, Ended, all_or_errors};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::picture::{Format, Picture};
use crate::entry::cli::style_args::StyleArgs;
use crate::entry::cli::terminal::Terminal;
use crate::pictures::output::file::Existing;
use crate::pictures::output::fonts::Fonts;
use crate::pictures::output::format::Settings;
use crate::pictures::output::png::{Compression, Size};
use crate::pictures::output::svg::Words;
use crate::products::figure::{self, Plate};
use crate::text::typed_word;

/// Draw the gallery: figures 1 to 9 of Vallat (2023), each as SVG, PNG and PDF, with captions
#[derive(Debug, Args)]
pub(crate) struct Figures {
    /// Folder for the figures; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Only this format
    #[arg(long, value_parser = typed_word::<Format>(), value_name = "FORMAT")]
    format: Option<Format>,
    #[command(flatten)]
    look: StyleArgs,
}

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

/// The files of the gallery: their paths and contents.
type Files = Vec<(PathBuf, Vec<u8>)>;

impl Figures {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let theme = self.look.theme()?;
        let plates = figure::gallery(&theme);
        let formats: Vec<Format> = match self.format {
            Some(format) => vec![format],
            None => vec![Format::Svg, Format::Png, Format::Pdf],
        };
        let drawn = plates.par_iter().map(|plate| files(plate, &formats, &self.output)).collect();
        let mut files = all_or_errors(drawn)?.concat();
        let captions = self.output.join("captions.md");
        files.push((captions, captions_of(&plates).into_bytes()));
        let paths: Vec<PathBuf> = files.iter().map(|(path, _)| path.clone()).collect();
        let style: Vec<&Path> = self.look.file().into_iter().collect();
        destination::refuse_overwrites(&paths, &style)?;
        let count = files.len();
        destination::make_folder(&self.output, &self.output)?;
        destination::write(&files, Existing::Replace, &[])?;
        terminal.note(&format!("{}: {} figures, {count} files", self.output.display(), plates.len()));
        Ok(ExitStatus::Done)
    }
}

fn files(plate: &Plate, formats: &[Format], folder: &Path) -> Result<Files, CliError> {
    let settings = Settings {
        size: Size::Scale(2.0),
        width_mm: None,
        words: Words::default(),
        compression: Compression::default(),
        dark: None,
        source: None,
        fonts: &Fonts::default(),
    };
    let file = |format: &Format| {
        let bytes = format.write(&plate.drawing, &settings);
        let bytes = bytes.map_err(|error| CliError::not_written(plate.name, error))?;
        let path = folder.join(format!("{}.{}", plate.name, format.ending()));
        Ok((path, bytes))
    };
    formats.iter().map(file).collect()
}

fn captions_of(plates: &[Plate]) -> String {
    let one = |plate: &Plate| format!("**{}** {}\n", plate.name, plate.caption);
    plates.iter().map(one).collect::<Vec<_>>().join("\n")
}

impl Shapes {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let theme = self.look.theme()?;
        let destination = Destination::from_path(&self.output);
        let format = destination.format(self.picture.requested_format())?;
        self.picture.check(format)?;
        if let (Destination::Stdout, true, Some(why)) = (&destination, terminal.is_watched(), format.unreadable()) {
            return Err(CliError::from(why).into());
        }
        let fonts = self.picture.fonts()?;
        let bytes = self.picture.bytes(figure::shapes(&theme), format, &fonts)?;
        let path = match &destination {
            Destination::Stdout => {
                terminal.print_bytes(&bytes)?;
                return Ok(ExitStatus::Done);
            }
            Destination::File(path) => path.clone(),
            Destination::Folder(folder) => folder.join(format!("shapes.{}", format.ending())),
        };
        let style: Vec<&Path> = self.look.file().into_iter().collect();
        destination::refuse_overwrites(std::slice::from_ref(&path), &style)?;
        if let Destination::Folder(folder) = &destination {
            destination::make_folder(folder, folder)?;
        }
        destination::write(&[(path, bytes)], Existing::Replace, destination.typed())?;
        Ok(ExitStatus::Done)
    }
}
