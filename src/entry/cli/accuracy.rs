//! `drystone accuracy`: measures the time and the accuracy of solution methods on this machine.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::progress::Progress;
use crate::entry::cli::source;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::AnalysisArgs;
use crate::mechanics::scene::Scene;
use crate::pictures::chart::ChartError;
use crate::pictures::output::file::Existing;
use crate::products::report::accuracy::{csv, markdown, page, svg};
use crate::products::result::accuracy_json;
use crate::products::study::{Case, TOLERANCES, study};
use crate::products::wording::number::counted;
use crate::read::file::ending;

/// Measure the time and the errors of the accuracy levels and of the solver alone at several tolerances
#[derive(Debug, Args)]
pub(crate) struct Accuracy {
    /// Scene files; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// The file to write; it ends in .html, .csv, .json, .svg or .md. May be given several times
    #[arg(short, long, required = true, value_name = "OUT")]
    output: Vec<PathBuf>,
    /// Tolerances of the solver to measure [default: 1e-2 … 1e-12]
    #[arg(long, value_name = "TOL", value_delimiter = ',', value_parser = tolerance)]
    tolerances: Vec<f64>,
}

fn tolerance(typed: &str) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(value) if (1e-15..=0.1).contains(&value) => Ok(value),
        _ => Err("a tolerance must be a number from 1e-15 to 0.1".into()),
    }
}

/// A file format in which the results of an accuracy study can be written: writes a study in this format.
type Form = fn(&[Case]) -> Result<String, ChartError>;

impl Accuracy {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let mut forms = Vec::with_capacity(self.output.len());
        for path in &self.output {
            forms.push((path, form(path)?));
        }
        let scenes: Vec<&Path> = self.scenes.iter().map(PathBuf::as_path).collect();
        destination::refuse_overwrites(&self.output, &scenes)?;
        let sources = source::read(&self.scenes, None, &AnalysisArgs::default())?;
        // A scene without a title gets the name of its file, without the extension, as its title.
        let scenes: Vec<Scene> = sources
            .iter()
            .map(|source| {
                let mut scene = Scene::clone(&source.scene);
                if scene.title.is_empty() {
                    scene.title = source.stem();
                }
                scene
            })
            .collect();
        let frames = scenes.iter().map(|s| s.frames.len()).sum();
        let progress = Progress::begin(frames, terminal.shows_progress());
        let tolerances = if self.tolerances.is_empty() { &TOLERANCES[..] } else { &self.tolerances[..] };
        let study = study(&scenes, tolerances, &mut |name| {
            progress.doing(name);
            progress.step();
        });
        drop(progress);
        let mut files = Vec::with_capacity(forms.len());
        for (path, form) in forms {
            let undrawn = |e: ChartError| vec![CliError::NotWritten { what: "the chart".into(), why: e.to_string() }];
            let text = form(&study).map_err(undrawn)?;
            files.push((path.clone(), text.into_bytes()));
        }
        destination::write(&files, Existing::Replace, &self.output)?;
        for (path, _) in &files {
            terminal.note(&format!("{}: {}", path.display(), counted(frames, "frame")));
        }
        Ok(ExitStatus::Done)
    }
}

fn form(path: &Path) -> Result<Form, CliError> {
    match ending(path).as_str() {
        "html" => Ok(page),
        "csv" => Ok(|study| Ok(csv(study))),
        "json" => Ok(|study| Ok(accuracy_json(study))),
        "svg" => Ok(svg),
        "md" => Ok(|study| Ok(markdown(study))),
        _ => Err(CliError::CommandLine(format!(
            "{}: the name of the output file must end in .html, .csv, .json, .svg or .md",
            path.display()
        ))),
    }
}
