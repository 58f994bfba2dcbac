//! `drystone check`: decides whether structures stand, and prints tables for people or JSON for programs.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::page::Page;
use crate::entry::cli::progress::Progress;
use crate::entry::cli::source::{self, Source};
use crate::entry::cli::table::{self, Detail};
use crate::entry::cli::terminal::Terminal;
use crate::entry::cli::verify;
use crate::entry::request::CheckArgs;
use crate::mechanics::analysis::{Analysis, Question, Verdict};
use crate::mechanics::scene::{Note, Scene};
use crate::products::figure;
use crate::products::result::{Layout, Timing, refusal, write_json};
use crate::products::wording::number::letter;
use crate::products::wording::sensitivity;
use crate::products::wording::verdict::tally;

/// Decide whether structures stand, show what fails, and prove the verdicts
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// Scene files, or folders of them; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Print JSON: one object for one scene, or a line for each of several scenes; for a file that is not valid, its
    /// problems instead of a result
    #[arg(long)]
    json: bool,
    /// Add the placed blocks of each frame to the JSON: name, centre, area, weight and corners
    #[arg(long, requires = "json")]
    blocks: bool,
    /// Leave out times, so that the same scene gives the same bytes
    #[arg(long)]
    no_timing: bool,
    #[command(flatten)]
    what: CheckArgs,
    /// Add the sum of all forces, the sum of the missing forces, the proof, the time and the contact tolerance
    #[arg(long, short, conflicts_with = "json")]
    verbose: bool,
    /// Write a certificate of the verdicts of one scene: forces or a motion for each frame, which drystone verify or any
    /// other program can check in exact arithmetic
    #[arg(long, value_name = "FILE", conflicts_with = "set")]
    certificate: Option<PathBuf>,
    /// Exit with 0 for every verdict; for wrong input, the exit code is still 2
    #[arg(long)]
    exit_zero: bool,
    /// Explain the words of the tables, in a list below the tables
    #[arg(long, conflicts_with = "json")]
    explain: bool,
}

impl Check {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let files = source::files(&self.scenes)?.noted(terminal);
        let reading = Progress::begin(1, terminal.shows_progress());
        reading.doing("reading");
        let outcomes = source::read_each(files, self.what.frame, &self.what.level)?;
        drop(reading);
        // For a single file, the JSON may have several lines. For several files, each file gets one line of JSON.
        let layout = if outcomes.len() == 1 { Layout::Lines } else { Layout::OneLine };
        if self.certificate.is_some() && outcomes.len() != 1 {
            let why = "--certificate writes the certificate of one scene; give one scene file".to_owned();
            return Err(CliError::CommandLine(why).into());
        }
        let mut sources = Vec::new();
        let mut refused = Vec::new();
        for (number, (path, outcome)) in outcomes.into_iter().enumerate() {
            match outcome {
                // A scene without a block that an option names is refused before any scene is analysed.
                Ok(mut source) => match self.choose_blocks(Arc::make_mut(&mut source.scene)) {
                    Ok(_) => sources.push((number, source)),
                    Err(why) => refused.push((number, path, why.into())),
                },
                Err(complaint) => refused.push((number, path, complaint)),
            }
        }
        // Without `--json`, no scene is analysed if any file is not valid. After an internal error in one scene, the
        // other scenes are still answered. With `--json`, every file gets an object.
        let is_wrong = |(.., complaint): &RefusedFile| !complaint.is_internal_fault();
        if !self.json && refused.iter().any(is_wrong) {
            return Err(refused.into_iter().map(|(.., complaint)| complaint).collect());
        }
        let width = terminal.width();
        let answers = self.answers(&sources, layout, terminal, width);

        let mut done = Vec::new();
        for ((number, source), answer) in sources.into_iter().zip(answers) {
            match answer {
                Ok(answer) => done.push(answer),
                Err(complaint) => refused.push((number, source.path, complaint)),
            }
        }
        refused.sort_by_key(|(number, ..)| *number);
        let printed = if self.json {
            let objects = objects(&mut done, &refused, layout);
            terminal.print_with(|out| objects.into_iter().try_for_each(|object| object(out)))
        } else if terminal.is_quiet() {
            terminal.print(&Page::default())
        } else {
            terminal.print(&self.tables(&done, width))
        };
        for (.., complaint) in &refused {
            terminal.refuse(complaint);
        }
        printed?;
        let wrong = refused.iter().map(|(.., complaint)| complaint.ending());
        let endings = done.iter().map(|(ending, ..)| if self.exit_zero { ExitStatus::Done } else { *ending });
        Ok(endings.chain(wrong).max().unwrap_or(ExitStatus::Done))
    }

    /// Analyses all scenes in parallel, and shows a progress bar if this takes long. Returns a result or an error for
    /// each scene, in the order of `sources`.
    fn answers(
        &self,
        sources: &[(usize, Source)],
        layout: Layout,
        terminal: &Terminal,
        width: Option<usize>,
    ) -> Vec<Result<SceneResult, CliError>> {
        let progress = Progress::begin(sources.len(), terminal.shows_progress());
        let is_table = !self.json && !terminal.is_quiet();
        sources
            .par_iter()
            .map(|(_, source)| {
                progress.doing(&source.name());
                let answer = source::isolated(&source.path, || self.answer(source, layout, width, is_table)).flatten();
                progress.step();
                answer
            })
            .collect()
    }

    /// Applies the option `placed` to a scene, and refuses a scene that lacks a block of this option or of `capacity`.
    fn choose_blocks(&self, scene: &mut Scene) -> Result<(), String> {
        self.what.only_placed(scene)?;
        self.what.options(scene).map(drop)
    }

    /// Analyses one scene. Returns its exit status, the verdicts of its frames, and its JSON or its table; the other of
    /// the two is empty. With `is_table`, the table is printed.
    fn answer(
        &self,
        source: &Source,
        layout: Layout,
        width: Option<usize>,
        is_table: bool,
    ) -> Result<SceneResult, CliError> {
        let mut options = self.what.options(&source.scene)?;
        let detail = Detail {
            full: self.verbose.then_some(if self.no_timing { Timing::LeftOut } else { Timing::Included }),
            margins: options.ask.has(Question::Margins),
            ranges: self.explain.then_some(options),
        };
        // The table states the same margin as the line below a picture, if it takes little time.
        if is_table && !options.ask.has(Question::Margins) && !options.verdict_only {
            let kinds = figure::cheap_margins(&source.scene);
            options = kinds.map_or(options, |kinds| options.margins(kinds));
        }
        let mut analysis = self.what.analysed(source.scene.clone(), &options);
        if let Some(output) = &self.certificate {
            verify::write(&mut analysis, &source.path, output, detail.margins, options.deadline)?;
        }
        let timing = if self.no_timing { Timing::LeftOut } else { Timing::Included };
        let ending = ExitStatus::from_analysis(&analysis);
        let verdicts = analysis.frames.iter().map(|frame| frame.verdict).collect();
        if self.json {
            let (file, blocks) = (source.path.to_string_lossy().into_owned(), self.blocks);
            let json: Json = match layout {
                // The JSON of one scene may need more memory than its analysis, and is written piece by piece.
                Layout::Lines => Box::new(move |out| write_json(out, Some(&file), &analysis, blocks, timing, layout)),
                Layout::OneLine => {
                    let mut text = Vec::new();
                    write_json(&mut text, Some(&file), &analysis, blocks, timing, layout)
                        .map_err(|error| CliError::not_written("the result", error))?;
                    Box::new(move |out| out.write_all(&text))
                }
            };
            return Ok((ending, verdicts, Some(json), Page::default()));
        }
        let mut page = table::of(&source.name(), &analysis, &detail, width);
        page.append(&sensitivities(&analysis));
        page.append(&notes_page(&analysis.notes));
        page.end();
        Ok((ending, verdicts, None, page))
    }

    /// Returns the tables of all scenes. Totals follow if there are several scenes. With `--explain`, the meanings of
    /// the words follow too.
    fn tables(&self, done: &[SceneResult], width: Option<usize>) -> Page {
        let mut page = Page::default();
        for (.., table) in done {
            page.append(table);
        }
        if done.len() > 1 {
            page.line(&total(done.iter().map(|(_, verdicts, ..)| verdicts.as_slice())));
        }
        if self.explain {
            page.append(&table::explained(width));
        }
        page
    }
}

/// Writes the JSON of a scene.
type Json = Box<dyn FnOnce(&mut dyn io::Write) -> io::Result<()> + Send>;

/// The exit status of a scene, the verdicts of its frames, its JSON, and its table. There is no JSON without `--json`,
/// and the table is empty with `--json`.
type SceneResult = (ExitStatus, Vec<Verdict>, Option<Json>, Page);

/// The index and the path of a file that has no result, and the error.
type RefusedFile = (usize, PathBuf, CliError);

/// Returns the JSON of all files in their order: the answers of valid files, and the problems of refused files.
/// `refused` must be sorted by the number of the file.
fn objects(done: &mut [SceneResult], refused: &[RefusedFile], layout: Layout) -> Vec<Json> {
    let mut objects: Vec<Json> = done.iter_mut().filter_map(|(_, _, json, _)| json.take()).collect();
    for (number, path, complaint) in refused {
        let json = refusal(&path.to_string_lossy(), &complaint.problems(), layout);
        objects.insert(*number, Box::new(move |out| out.write_all(json.as_bytes())));
    }
    objects
}

/// Returns how many scenes and frames have each verdict: `12 scenes: 10 stand, 2 fall; 40 frames: 38 stand, 2 fall`. The
/// verdict of a scene is the worst verdict of its frames.
fn total<'v>(scenes: impl Iterator<Item = &'v [Verdict]> + Clone) -> String {
    let worst = |frames: &[Verdict]| frames.iter().max().copied().unwrap_or(Verdict::Stable);
    let by_scene: Vec<Verdict> = scenes.clone().map(worst).collect();
    let by_frame: Vec<Verdict> = scenes.flatten().copied().collect();
    let mut words = format!("{} scenes: {}", by_scene.len(), tally(&by_scene));
    if by_frame.len() > by_scene.len() {
        words += &format!("; {} frames: {}", by_frame.len(), tally(&by_frame));
    }
    words
}

/// Returns the lines below a table for the option `--sensitivity`: how the selected margin of each frame changes with
/// the input. Without this option, the page is empty.
fn sensitivities(analysis: &Analysis) -> Page {
    let mut page = Page::default();
    for solved in analysis.each() {
        let Some(sensitivity) = &solved.found.sensitivity else {
            continue;
        };
        if analysis.frames.len() > 1 {
            page.line(&format!("  frame {}", letter(solved.number)));
        }
        for line in sensitivity::lines(solved, sensitivity) {
            page.line(&format!("  {line}"));
        }
    }
    page
}

/// Returns the notes below a table. Each note has two lines: its message, and a hint that says what to change.
fn notes_page(notes: &[Note]) -> Page {
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
