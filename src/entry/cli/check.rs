//! `drystone check`: does it stand, in a table for a person or as JSON for a program.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::analysis::{Analysis, MarginKind, MarginKinds, Options};
use crate::cli::complaint::CliError;
use crate::cli::ending::ExitStatus;
use crate::cli::level::AnalysisArgs;
use crate::cli::page::Page;
use crate::cli::progress::{Progress, Shown};
use crate::cli::source::{self, FrameChoice};
use crate::cli::table;
use crate::cli::terminal::Terminal;
use crate::result::{Layout, Timing, refusal, to_json_of};
use crate::scene::Note;

/// Say whether scenes stand, what fails, and how that is proved
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// Scene files, or folders of them; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Print JSON: one object for a scene, or a line for each of several; a file that is wrong gets its problems in its place
    #[arg(long)]
    json: bool,
    /// Leave out how long it took, so that the same scene gives the same bytes
    #[arg(long)]
    no_timing: bool,
    /// Tell how far each frame is from the edge: least friction, largest tilt, horizontal load, kernel and factor on the
    /// loads, robots' least limits; or some of these, such as friction,tilt
    #[arg(
        long,
        value_enum,
        value_name = "LIST",
        value_delimiter = ',',
        num_args = 0..,
        require_equals = true
    )]
    margins: Option<Vec<Name>>,
    /// Tell the verdict with its proof and leave out the rest: what fails, and which of several balances is the one to draw
    #[arg(long)]
    verdict_only: bool,
    /// Leave out notes of what is allowed and seldom meant; a scene silences single ones by "silence": ["code"]
    #[arg(long)]
    no_notes: bool,
    /// Say below the tables what their words mean
    #[arg(long, conflicts_with = "json")]
    explain: bool,
    /// Examine one frame only, by number from 1, by its letter in the strip, or last
    #[arg(long, value_name = "N")]
    frame: Option<FrameChoice>,
    #[command(flatten)]
    level: AnalysisArgs,
}

/// A margin by the name it has in results.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Name {
    Friction,
    Tilt,
    #[value(alias = "horizontal_load")]
    HorizontalLoad,
    Kernel,
    #[value(alias = "load_factor")]
    LoadFactor,
    Robots,
}

/// All margins, or those named.
fn kinds(names: &[Name]) -> MarginKinds {
    if names.is_empty() {
        return MarginKinds::ALL;
    }
    let kinds = names.iter().map(|name| match name {
        Name::Friction => MarginKind::Friction,
        Name::Tilt => MarginKind::Tilt,
        Name::HorizontalLoad => MarginKind::HorizontalLoad,
        Name::Kernel => MarginKind::Kernel,
        Name::LoadFactor => MarginKind::LoadFactor,
        Name::Robots => MarginKind::Robots,
    });
    MarginKinds::new(&kinds.collect::<Vec<_>>())
}

/// The words of a command line, with the list that may follow `--margins` joined to it.
///
/// `check --margins scene.json` asks for all, and `check --margins friction,tilt scene.json` for two: a word of names
/// alone is a list, unless there is a file of that name.
pub(crate) fn joined(words: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    for word in words {
        if let (Some(last), Some(list)) = (joined.last_mut(), word.to_str())
            && last == "--margins"
            && is_list(list)
        {
            last.push("=");
            last.push(list);
        } else {
            joined.push(word);
        }
    }
    joined
}

fn is_list(word: &str) -> bool {
    let letters = |c: char| c.is_ascii_lowercase() || matches!(c, ',' | '-' | '_');
    !word.starts_with('-') && word.chars().all(letters) && !Path::new(word).exists()
}

impl Check {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let outcomes = source::read_each(&self.scenes, self.frame, self.level.contact_tolerance)
            .map_err(|c| vec![c])?;
        // Programs get an object for every file, in its place; a person reads of what is wrong before anything else.
        let layout = if outcomes.len() == 1 {
            Layout::Lines
        } else {
            Layout::OneLine
        };
        let mut sources = Vec::new();
        let mut refused = Vec::new();
        for (number, (path, outcome)) in outcomes.into_iter().enumerate() {
            match outcome {
                Ok(source) => sources.push(source),
                Err(complaint) => refused.push((number, path, complaint)),
            }
        }
        if !self.json && !refused.is_empty() {
            return Err(refused
                .into_iter()
                .map(|(.., complaint)| complaint)
                .collect());
        }
        let shown = if terminal.shows_progress() {
            Shown::WhenLong
        } else {
            Shown::Never
        };
        let progress = Progress::begin(sources.len(), shown);
        let options = Options {
            margins: self.margins.is_some(),
            margin_kinds: kinds(self.margins.as_deref().unwrap_or_default()),
            verdict_only: self.verdict_only,
            ..self.level.options()
        };
        let analyses: Vec<Analysis> = sources
            .par_iter()
            .map(|source| {
                progress.doing(&source.name());
                let mut analysis = Analysis::with(&source.scene, &options);
                if self.no_notes {
                    analysis.notes.clear();
                }
                progress.step();
                analysis
            })
            .collect();
        drop(progress);

        let timing = if self.no_timing {
            Timing::LeftOut
        } else {
            Timing::Included
        };
        let printed = if self.json {
            let mut objects: Vec<String> = (sources.iter().zip(&analyses))
                .map(|(source, analysis)| {
                    let file = source.path.to_string_lossy();
                    to_json_of(&file, analysis, timing, layout)
                })
                .collect();
            for (number, path, complaint) in &refused {
                let file = path.to_string_lossy();
                objects.insert(*number, refusal(&file, &complaint.problems(), layout));
                terminal.refuse(complaint);
            }
            terminal.print_bytes(objects.concat().as_bytes())
        } else {
            let mut page = Page::default();
            let width = terminal.width();
            if !terminal.is_quiet() {
                for (source, analysis) in sources.iter().zip(&analyses) {
                    page.append(&table::of(&source.name(), analysis, timing, width));
                    page.append(&noted(&analysis.notes));
                    page.end();
                }
                if self.explain {
                    page.append(&table::explained(width));
                }
            }
            terminal.print(&page)
        };
        printed.map_err(|c| vec![c])?;
        let wrong = refused.iter().map(|(.., complaint)| complaint.ending());
        Ok((analyses.iter().map(ExitStatus::from_analysis))
            .chain(wrong)
            .max()
            .unwrap_or(ExitStatus::Done))
    }
}

/// Notes below a table, a line each with what to do about it in the next.
fn noted(notes: &[Note]) -> Page {
    let mut page = Page::default();
    for note in notes {
        let line = match note.line {
            0 => String::new(),
            line => format!("line {line}, "),
        };
        page.line(&format!("  note: {line}{}: {}", note.path, note.message));
        page.line(&format!("        {}", note.hint));
    }
    page
}
