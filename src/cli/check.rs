//! `drystone check`: does it stand, in a table for a person or as JSON for a program.

use std::path::PathBuf;

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::analysis::{Analysis, Ask, Options};
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
    /// loads, robots' least limits
    #[arg(long)]
    margins: bool,
    /// Tell the verdict with its proof and leave out the rest: what fails, and which of several balances is the one to draw
    #[arg(long)]
    verdict_only: bool,
    /// Examine one frame only, by number from 1 or by its letter in the strip
    #[arg(long, value_name = "N")]
    frame: Option<FrameChoice>,
    #[command(flatten)]
    level: Level,
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
            margins: asked(self.margins),
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
