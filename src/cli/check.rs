//! `drystone check`: does it stand, in a table for a person or as JSON for a program.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::analysis::{Analysis, Ask, MarginKind, MarginKinds, Options};
use crate::cli::complaint::Complaint;
use crate::cli::ending::Ending;
use crate::cli::level::Level;
use crate::cli::page::Page;
use crate::cli::progress::{Progress, Shown};
use crate::cli::source::{self, FrameChoice};
use crate::cli::table;
use crate::cli::terminal::Terminal;
use crate::report::result::{Layout, Timing, to_json};

/// Say whether scenes stand, what fails, and how that is proved
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// Scene files; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Print JSON: one object for a scene, or a line for each of several
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
    /// Examine one frame only, by number from 1 or by its letter in the strip
    #[arg(long, value_name = "N")]
    frame: Option<FrameChoice>,
    #[command(flatten)]
    level: Level,
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
    MarginKinds::of(&kinds.collect::<Vec<_>>())
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
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<Ending, Vec<Complaint>> {
        let sources = source::read(&self.scenes, self.frame, self.level.contact_tolerance)?;
        let shown = if terminal.shows_progress() {
            Shown::WhenLong
        } else {
            Shown::Never
        };
        let progress = Progress::begin(sources.len(), shown);
        let options = Options {
            margins: asked(self.margins.is_some()),
            margin_kinds: kinds(self.margins.as_deref().unwrap_or_default()),
            verdict_only: asked(self.verdict_only),
            ..self.level.options()
        };
        let analyses: Vec<Analysis> = sources
            .par_iter()
            .map(|source| {
                progress.doing(&source.name());
                let analysis = Analysis::with(&source.scene, &options);
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
        let layout = if sources.len() == 1 {
            Layout::Lines
        } else {
            Layout::OneLine
        };
        let printed = if self.json {
            let results = analyses.iter().map(|a| to_json(a, timing, layout));
            terminal.print_bytes(results.collect::<String>().as_bytes())
        } else {
            let mut page = Page::default();
            if !terminal.is_quiet() {
                for (source, analysis) in sources.iter().zip(&analyses) {
                    page.append(&table::of(&source.name(), analysis, timing));
                    page.end();
                }
                page.ours(table::LIMITS);
            }
            terminal.print(&page)
        };
        printed.map_err(|c| vec![c])?;
        Ok(analyses
            .iter()
            .map(Ending::of)
            .max()
            .unwrap_or(Ending::Done))
    }
}

fn asked(flag: bool) -> Ask {
    if flag { Ask::Yes } else { Ask::No }
}
