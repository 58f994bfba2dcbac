//! `drystone vary`: for which values of one number, or of two, a structure stands.

mod store;
mod varied;

use std::path::{Path, PathBuf};

use clap::Args;
pub(crate) use varied::{Answer, Ordinate, Varied};

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::new;
use crate::entry::cli::picture::{Format, Picture};
use crate::entry::cli::progress::Progress;
use crate::entry::cli::source;
use crate::entry::cli::style_args::StyleArgs;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::AnalysisArgs;
use crate::pictures::output::file::Existing;
use crate::products::vary;
use crate::read::file::ending;
use store::ResultFile;

/// Find for which values of one number, or of two, a structure stands
///
/// A number is any number of the scene file, such as friction=0.2..0.9, 'loads[0].at[0]=0..4' or blocks.V3.weight=0..500;
/// tilt and load_factor; or, with arch, wall, tower, doorway, ladder, incline or lattice in place of a scene file, a
/// dimension of drystone new: drystone vary arch voussoirs=31 thickness=0.1..0.6. One number gives the intervals in which the
/// structure stands, whose ends lie between a value that stands and one that falls. Two give a map.
#[derive(Debug, Args)]
pub(crate) struct Vary {
    /// The scene file, or the name of a structure of drystone new
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// NAME=FROM..TO varies a number; NAME=VALUE sets it; NAME>=VALUE or NAME<=VALUE asks whether a number of the result is
    /// reached instead of whether the structure stands: a margin such as load_factor or tilt, placement, or a key of a frame
    #[arg(required = true, value_name = "NUMBER")]
    numbers: Vec<String>,
    /// Files to write: a picture (.svg, .png, .pdf, .tikz), .json or .csv. May be given several times
    #[arg(short, long, value_name = "OUT")]
    output: Vec<PathBuf>,
    /// For one number: the number of the result that a picture shows as a curve, such as load_factor
    #[arg(long, value_name = "NAME")]
    curve: Option<String>,
    /// For two numbers: draw lines of equal values of this number of the result on the map, such as load_factor. Takes longer
    /// than the map alone
    #[arg(long, value_name = "NAME")]
    isolines: Option<String>,
    /// Save each result in FILE as soon as it is found. If FILE has results of an earlier run of the same question, use
    /// them, even if that run was stopped
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// Write the scene of each sample into the folder DIR; its name has the values
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    /// Significant digits of the ends of intervals
    #[arg(long, value_name = "N", default_value = "4", value_parser = clap::value_parser!(u32).range(2..=9))]
    digits: u32,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    look: StyleArgs,
    #[command(flatten)]
    level: AnalysisArgs,
}

impl Vary {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let shown = self.scene.to_string_lossy();
        let is_structure = new::dimensions(&shown).is_some() && !self.scene.exists();
        let inputs: Vec<&Path> =
            [self.scene.as_path()].into_iter().filter(|_| !is_structure).chain(self.look.file()).collect();
        destination::refuse_overwrites(&self.output, &inputs)?;
        let forms = self.output.iter().map(|path| self.form(path)).collect::<Result<Vec<_>, _>>()?;
        let bytes = || source::bytes(&self.scene);
        let name = if self.scene.as_os_str() == "-" { "standard input".into() } else { shown };
        let ordinate = Ordinate { curve: self.curve.as_deref(), isolines: self.isolines.as_deref() };
        let mut varied = Varied::read(&name, bytes, &self.numbers, ordinate, &self.level)?;
        if forms.iter().any(Option::is_some) && varied.ranges.len() == 1 && self.curve.is_none() {
            return Err(CliError::from(
                "a picture of one number needs --curve NAME, such as --curve load_factor; two numbers give a map",
            )
            .into());
        }
        let theme = self.look.theme()?;
        let fonts = self.picture.fonts()?;
        if let Some(path) = &self.resume {
            destination::refuse_overwrites(std::slice::from_ref(path), &inputs)?;
            varied.store = Some(ResultFile::open(path, &varied.asked())?);
        }
        let progress = Progress::begin(0, terminal.shows_progress());
        let answer = varied.answer(self.digits, || progress.step());
        drop(progress);
        let (json, lines) = varied.told(&answer);
        let samples = match &answer {
            Answer::One(samples) => samples,
            Answer::Two(map, _) => &map.samples,
        };
        if let Some(folder) = &self.keep {
            let scenes = samples.iter().filter_map(|sample| varied.scene_file(&sample.at));
            let files: Vec<(PathBuf, Vec<u8>)> = scenes.map(|(name, bytes)| (folder.join(name), bytes)).collect();
            destination::make_folder(folder, folder.parent().unwrap_or(Path::new("")))?;
            destination::write(&files, Existing::Replace, &[])?;
        }
        let mut files = Vec::new();
        for (path, form) in self.output.iter().zip(forms) {
            let bytes = match (form, ending(path).as_str()) {
                (Some(format), _) => {
                    let mut drawing = varied.drawing(&answer, &theme, self.picture.page());
                    if self.picture.draws_words(format) {
                        drawing.items.iter_mut().for_each(|item| missing_glyphs::spell(item, &fonts));
                    }
                    self.picture.bytes(drawing, format, &fonts)?
                }
                (None, "csv") => vary::csv(&varied.question, &varied.ranges, samples).into_bytes(),
                _ => (json.to_string() + "\n").into_bytes(),
            };
            files.push((path.clone(), bytes));
        }
        destination::write(&files, Existing::Replace, &self.output)?;
        if self.json {
            terminal.print_bytes((json.to_string() + "\n").as_bytes())?;
        } else {
            terminal.print_bytes((lines.join("\n") + "\n").as_bytes())?;
        }
        Ok(ExitStatus::Done)
    }

    /// Returns the format of a picture; `None` for JSON and CSV.
    fn form(&self, path: &Path) -> Result<Option<Format>, CliError> {
        let named = ending(path);
        match Format::from_ending(&named).filter(|format| format.animate().is_none() || *format == Format::Png) {
            Some(format) => {
                self.picture.check(format)?;
                Ok(Some(format))
            }
            None if matches!(named.as_str(), "json" | "csv") => Ok(None),
            None => Err(CliError::CommandLine(format!(
                "{}: the name of the output file must end in .svg, .png, .pdf, .tikz, .json or .csv",
                path.display()
            ))),
        }
    }
}
