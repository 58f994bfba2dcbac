//! `drystone batch`: analyses any number of scenes. The output is one line of JSON for each scene, or a CSV table with
//! a row for each frame.

mod input;
mod output;
mod pace;
mod resume;

use std::path::PathBuf;
use std::sync::Arc;
use std::thread;

use clap::Args;

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::picture::{Format, Picture};
use crate::entry::cli::source::read_in_time;
use crate::entry::cli::style_args::StyleArgs;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::{AnalysisArgs, AskArgs};
use crate::mechanics::analysis::{Accuracy, Analysis, Options, Verdict, verdicts};
use crate::mechanics::batch::{Capacity, Record, Records, in_order};
use crate::mechanics::scene::{Code, Problem, Scene, isolate};
use crate::pictures::output::file::Existing;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;
use crate::products::result::{Fields, Origin, PictureOutcome, line_of, problem_line, verdict_line};
use crate::read::file::ending;
use crate::text;
use output::{Output, Target};
use pace::BatchProgress;
use resume::Settings;

/// The default width of a picture in pixels.
const DEFAULT_PICTURE_WIDTH: u32 = 400;

/// Analyse many scenes, one per line, on all cores, and print a line of JSON for each, in the order of the scenes
///
/// A scene that is not valid gets the line { "line", "problems" }, and the other scenes are still analysed. The exit
/// code is 0, 1, 2 or 3 as for check, or 4 if the output could not be written.
#[derive(Debug, Args)]
pub(crate) struct Batch {
    /// Files with one scene per line (.ndjson, .jsonl), scene files (.json), or folders with both; - reads lines from
    /// standard input
    #[arg(value_name = "INPUT", default_value = "-")]
    inputs: Vec<PathBuf>,
    /// Write the lines to a file instead of standard output, each as soon as possible; a file that ends in .csv gets
    /// a table with one row for each frame
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Continue an output file: keep its complete lines and answer the remaining scenes. FILE.resume records the
    /// scenes and the options of these lines; if they differ from those of this run, nothing is written. The exit code
    /// covers only the scenes that this run answers
    #[arg(long, requires = "output")]
    resume: bool,
    /// The fields of a result to write, such as verdict,frames.total_force or all; file and line are always written.
    /// --margins adds frames.margins (the motions beyond them are frames.margins.mechanisms), --wedging adds frames.only_by_wedging
    #[arg(long, value_name = "LIST", value_parser = fields, default_value = "scene,verdict")]
    fields: Fields,
    /// Draw every scene into this folder, by default as PNG, 400 pixels wide. A picture is named after the file and
    /// the line of its scene; the line of its verdict has no margin
    #[arg(long, value_name = "FOLDER")]
    render: Option<PathBuf>,
    /// Number of threads [default: the number of cores, or 1.5 times as many with --render, because pictures wait for
    /// the disk]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Report progress on standard error every N seconds: finished scenes, speed and remaining time
    #[arg(long, value_name = "SECONDS", value_parser = pace::seconds)]
    progress: Option<f64>,
    #[command(flatten)]
    ask: AskArgs,
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    look: StyleArgs,
    #[command(flatten)]
    level: AnalysisArgs,
}

fn fields(typed: &str) -> Result<Fields, String> {
    Fields::read(typed).map_err(|unknown| {
        let words: Vec<String> = unknown.iter().map(ToString::to_string).collect();
        words.join("; ")
    })
}

impl Batch {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let form = self.form()?;
        let work = self.work(form)?;
        let inputs = input::of(&self.inputs, self.render.is_some())?;
        let mut records = Records::new(inputs.list);
        let mut pace = BatchProgress::begin(terminal, self.progress, inputs.bytes, records.read());
        let target = Target { path: self.output.as_deref(), resume: self.resume, settings: self.settings(&work), form };
        let mut output = Output::open(&target, &inputs.files, &mut records)?;
        if let Some(folder) = &self.render {
            destination::make_folder(folder, folder)?;
        }
        pace.skipped(output.done());
        let mut ending = ExitStatus::Done;
        let mut failed = None;
        let mut is_closed = false;
        in_order(
            records,
            Capacity::new(self.threads()),
            move |record| work.answer(record),
            |answer| {
                let written = match answer {
                    None => output.flush(),
                    Some(Ok(answer)) => {
                        ending = ending.max(answer.ending);
                        pace.step(answer.ending);
                        output.write(answer.line.as_bytes(), answer.scene)
                    }
                    Some(Err(complaint)) => Err(complaint),
                };
                let next = written.unwrap_or_else(|complaint| {
                    failed = Some(complaint);
                    std::ops::ControlFlow::Break(())
                });
                is_closed |= next.is_break();
                next
            },
        );
        // Write the answers that are still in memory, even after an error: answers from before the error are valid.
        let flushed = output.flush();
        if !is_closed {
            pace.end();
        }
        match (failed, flushed) {
            (Some(complaint), _) | (None, Err(complaint)) => Err(vec![complaint]),
            (None, Ok(_)) => Ok(ending),
        }
    }

    /// Returns the number of threads that analyse scenes: the value of `--jobs`, or by default one for each core, and
    /// half as many more if pictures are written.
    fn threads(&self) -> usize {
        self.jobs.map_or_else(
            || {
                let cores = thread::available_parallelism().map_or(1, usize::from);
                // Threads wait for the disk while they write pictures, so more threads than cores are needed to keep
                // all cores busy.
                cores + self.render.as_ref().map_or(0, |_| cores.div_ceil(2))
            },
            usize::from,
        )
    }

    /// Returns the output format that the extension of the output file selects: CSV for `.csv`, otherwise lines of
    /// JSON. Returns an error for the extension of another table format, such as `.xlsx`, and for a CSV file together
    /// with an option that CSV does not support.
    fn form(&self) -> Result<Form, CliError> {
        let ending = self.output.as_deref().map(ending).unwrap_or_default();
        let refuse = |why: &str| Err(CliError::from(why));
        match ending.as_str() {
            "csv" if self.resume => refuse(
                "--resume needs one line for each scene, and a .csv file has one row for each frame; write an .ndjson file",
            ),
            "csv" if self.selected() != Fields::default() => refuse(
                "a .csv file has the same columns in every run; for --fields and answers such as --margins write an .ndjson file",
            ),
            "csv" => Ok(Form::Csv),
            "parquet" | "xlsx" | "ods" | "tsv" | "db" | "sqlite" => refuse(&format!(
                "batch writes no .{ending} files; write .csv or .ndjson, which pandas, polars and DuckDB read"
            )),
            _ => Ok(Form::Json),
        }
    }

    fn work(&self, form: Form) -> Result<SceneWork, CliError> {
        let format = self.picture.requested_format().unwrap_or(Format::Png);
        let picture = self.picture.clone().or_width(DEFAULT_PICTURE_WIDTH, format).of_many();
        let drawn = match &self.render {
            None => None,
            Some(folder) => {
                picture.check(format)?;
                Some(PictureOutput {
                    folder: folder.clone(),
                    format,
                    fonts: picture.fonts()?,
                    options: figure::Options {
                        width: picture.page(),
                        theme: self.look.theme()?,
                        ..figure::Options::default()
                    },
                    picture,
                })
            }
        };
        Ok(SceneWork {
            level: self.level.clone(),
            ask: self.ask.clone(),
            fields: self.selected(),
            form,
            drawn: drawn.map(Arc::new),
        })
    }

    /// Returns the fields of the lines: those of `--fields`, and the answers to all questions.
    fn selected(&self) -> Fields {
        self.fields.clone().answering(|question| self.ask.has(question))
    }

    /// Returns the settings on which the output lines depend. The number of threads and the progress report are not
    /// among these settings, because they do not change the lines.
    fn settings(&self, work: &SceneWork) -> Settings {
        let mut settings =
            vec![("drystone", env!("CARGO_PKG_VERSION").to_owned()), ("--fields", work.fields.to_string())];
        settings.extend(self.level.described());
        settings.extend(self.ask.described());
        let (format, look) = match &work.drawn {
            None => ("none", "none".into()),
            Some(drawn) => {
                let look = format!("{:?} {:?}", drawn.picture, drawn.options);
                (drawn.format.ending(), format!("{:016x}", text::hash(look.as_bytes())))
            }
        };
        settings.push(("the format of the pictures", format.into()));
        settings.push(("the hash of the picture style", look));
        Settings(settings)
    }
}

/// The options with which every scene is analysed, drawn and written.
struct SceneWork {
    level: AnalysisArgs,
    ask: AskArgs,
    fields: Fields,
    form: Form,
    drawn: Option<Arc<PictureOutput>>,
}

/// The format of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// One line of JSON for each scene.
    Json,
    /// One row for each frame.
    Csv,
}

/// The output for one scene, with the exit status and the hash of this scene.
struct OutputLine {
    /// One line of JSON, or the CSV rows of all frames.
    line: String,
    ending: ExitStatus,
    /// The hash of the scene.
    scene: u64,
}

impl SceneWork {
    /// Analyses one scene of the input, and returns its output: a line of JSON, or CSV rows. For a scene that is not
    /// valid, and after an internal error of drystone, the output states the problem instead of results. Returns an
    /// error if the picture cannot be written, because later pictures would then fail too.
    fn answer(&self, record: Record) -> Result<OutputLine, CliError> {
        let origin = input::origin(&record);
        let name = input::picture_name(&record);
        let scene = resume::record_hash(&record);
        let shown = input::shown(&record);
        let caught = isolate(&shown, || self.examined(&origin, &name, &record));
        let (line, ending) = caught.unwrap_or_else(|fault| Ok(self.refused(&origin, &fault.list)))?;
        Ok(OutputLine { line, ending, scene })
    }

    fn examined(&self, origin: &Origin, name: &str, record: &Record) -> Result<(String, ExitStatus), CliError> {
        let bytes = match &record.bytes {
            Ok(bytes) => bytes,
            Err(why) => return Ok(self.refused(origin, &[Problem::alone(Code::NotReadable, why.to_owned(), "")])),
        };
        let level = self.level.started();
        let lines_before = record.line.map_or(0, |n| n - 1);
        let scene = match read_in_time(&input::shown(record), lines_before, bytes.to_vec(), &level) {
            Ok(Ok((scene, _))) => scene,
            Ok(Err(mut problems)) => {
                let early = problems.list.iter_mut().filter(|problem| problem.code == Code::EndsEarly);
                early.filter(|_| record.line.is_some()).for_each(|problem| {
                    problem.message = "the line ends too early".into();
                    problem.help = problem.help.replace("part of the file", "part of the line");
                });
                return Ok(self.refused(origin, &problems.list));
            }
            Err(late) => return Ok(self.refused(origin, &[Problem::alone(Code::NotReadable, late, "")])),
        };
        let options = match self.options(&level, &scene) {
            Ok(options) => options,
            Err(why) => return Ok(self.refused(origin, &[Problem::alone(Code::NotReadable, why, "")])),
        };
        let is_plain = self.drawn.is_none() && options.accuracy != Accuracy::Exact;
        if is_plain && self.fields.are_few() && self.form == Form::Json {
            let found = verdicts(&scene, &options);
            let ending = ExitStatus::from_verdicts(&scene, found.iter().copied());
            let verdict = found.into_iter().max().unwrap_or(Verdict::Stable);
            let line = verdict_line(origin, &scene.title, verdict, &self.fields);
            return Ok((line, ending));
        }
        let analysis = Analysis::exact(&scene, &options);
        let picture = match &self.drawn {
            None => PictureOutcome::NotAsked,
            Some(drawn) => drawn.draw(&analysis, name)?,
        };
        let line = match self.form {
            Form::Json => line_of(origin, &analysis, &picture, &self.fields),
            Form::Csv => output::csv_rows(origin, &analysis),
        };
        Ok((line, ExitStatus::from_analysis(&analysis)))
    }

    fn refused(&self, origin: &Origin, problems: &[Problem]) -> (String, ExitStatus) {
        let line = match self.form {
            Form::Json => problem_line(origin, problems),
            Form::Csv => output::csv_problem_row(origin, problems),
        };
        (line, ExitStatus::WrongInput)
    }

    /// Returns the options of the analysis of a scene: the questions of the options, and those whose answers `--fields`
    /// selects.
    fn options(&self, level: &AnalysisArgs, scene: &Scene) -> Result<Options, String> {
        let ask = self.ask.of(scene)?;
        Ok(level.options().also(self.fields.questions().fold(ask, |ask, question| ask.with(question, scene))))
    }
}

/// The options for pictures, and their folder.
struct PictureOutput {
    folder: PathBuf,
    format: Format,
    picture: Picture,
    fonts: Fonts,
    options: figure::Options,
}

impl PictureOutput {
    /// Draws a scene and writes the picture file, whose name without the extension is `name`. Returns the name of the
    /// file, or the reason why the picture cannot be drawn. Returns an error if the file cannot be written.
    fn draw(&self, analysis: &Analysis, name: &str) -> Result<PictureOutcome, CliError> {
        let name = format!("{name}.{}", self.format.ending());
        let mut shown = analysis.clone();
        if self.picture.draws_words(self.format) {
            shown.change_scenes(|scene| missing_glyphs::legible(scene, &self.fonts));
        }
        let drawing = figure::forces(&shown, &self.options);
        match self.picture.bytes(drawing, self.format, &self.fonts) {
            Ok(bytes) => {
                let file = (self.folder.join(&name), bytes);
                destination::write(&[file], Existing::Replace, &[])?;
                Ok(PictureOutcome::Drawn(name))
            }
            Err(CliError::CommandLine(why) | CliError::NotWritten { why, .. }) => Ok(PictureOutcome::Refused(why)),
            Err(other) => Err(other),
        }
    }
}
