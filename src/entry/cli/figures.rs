//! `drystone figures`: draws the gallery, figures 1 to 9 of Vallat (2023), as SVG, PNG and PDF, and writes their
//! captions.

use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::entry::cli::destination;
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::picture::Format;
use crate::entry::cli::style_args::StyleArgs;
use crate::entry::cli::terminal::Terminal;
use crate::pictures::output::file::Existing;
use crate::pictures::output::fonts::Fonts;
use crate::pictures::output::format::Settings;
use crate::pictures::output::png::{Compression, Size};
use crate::pictures::output::svg::Words;
use crate::products::figure::{self, Plate};

/// Draw the gallery: figures 1 to 9 of Vallat (2023), each as SVG, PNG and PDF, with captions
#[derive(Debug, Args)]
pub(crate) struct Figures {
    /// Folder for the figures; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Only this format
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Format>,
    #[command(flatten)]
    look: StyleArgs,
}

/// The files of the gallery: their paths and contents.
type Files = Vec<(PathBuf, Vec<u8>)>;

impl Figures {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let theme = self.look.theme().map_err(|c| vec![c])?;
        let plates = figure::gallery(&theme);
        let formats: Vec<Format> = match self.format {
            Some(format) => vec![format],
            None => vec![Format::Svg, Format::Png, Format::Pdf],
        };
        let drawn: Vec<Result<Files, CliError>> =
            plates.par_iter().map(|plate| files(plate, &formats, &self.output)).collect();
        let mut files = Vec::new();
        let mut complaints = Vec::new();
        for result in drawn {
            match result {
                Ok(more) => files.extend(more),
                Err(complaint) => complaints.push(complaint),
            }
        }
        if !complaints.is_empty() {
            return Err(complaints);
        }
        let captions = self.output.join("captions.md");
        files.push((captions, captions_of(&plates).into_bytes()));
        let paths: Vec<PathBuf> = files.iter().map(|(path, _)| path.clone()).collect();
        let style: Vec<&Path> = self.look.file().into_iter().collect();
        destination::refuse_overwrites(&paths, &style).map_err(|c| vec![c])?;
        let count = files.len();
        destination::make_folder(&self.output).map_err(|c| vec![c])?;
        destination::write(&files, Existing::Replace).map_err(|c| vec![c])?;
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
        fonts: &Fonts::default(),
    };
    let file = |format: &Format| {
        let bytes = format.write(&plate.drawing, &settings);
        let bytes =
            bytes.map_err(|error| CliError::NotWritten { what: plate.name.to_owned(), why: error.to_string() })?;
        let path = folder.join(format!("{}.{}", plate.name, format.ending()));
        Ok((path, bytes))
    };
    formats.iter().map(file).collect()
}

fn captions_of(plates: &[Plate]) -> String {
    let one = |plate: &Plate| format!("**{}** {}\n", plate.name, plate.caption);
    plates.iter().map(one).collect::<Vec<_>>().join("\n")
}
