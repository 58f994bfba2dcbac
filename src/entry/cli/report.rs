//! `drystone report`: writes a report on one or more scenes as HTML, Markdown, PDF or JSON.

mod task;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use task::Task;

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::progress::Progress;
use crate::entry::cli::source::{self, Source};
use crate::entry::cli::style_args::StyleArgs;
use crate::entry::cli::terminal::Terminal;
use crate::entry::cli::vary::{Ordinate, Varied};
use crate::entry::request::{AnalysisArgs, AskArgs};
use crate::mechanics::analysis::{Analysis, MarginKind, MarginKinds, Question};
use crate::pictures::drawing::Theme;
use crate::pictures::output::file::Existing;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;
use crate::products::report::entry::{Entry, File, ReportOptions, Side, compared};
use crate::products::report::page::{Form, Piece, Refused, Report as Page};
use crate::products::result::Timing;
use crate::products::study::{TOLERANCES, study};
use crate::products::wording::number::counted;
use crate::read::file::{self, ending};

/// Write a report on scenes: verdicts with reasons, figures, forces, margins and proofs
#[derive(Debug, Args)]
pub(crate) struct Report {
    /// Scene files, or folders with .json files in them and their subfolders; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Output: a file that ends in .html, .md (with its figures next to it), .pdf or .json; with --split a folder
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Make the figures of an HTML report interactive: readers drag the stones. FILE is the script interactive.js of a
    /// release, or its folder. Without FILE, the script is searched beside the program, or in the Python package; put
    /// the option after the scenes then
    #[arg(long, value_name = "FILE", num_args = 0..=1, conflicts_with_all = ["split", "compare"])]
    interactive: Option<Option<PathBuf>>,
    /// Write an index and a page for each scene into the folder OUT
    #[arg(long)]
    split: bool,
    /// Report what changed from the first SCENE to the second: two files, or two folders with files of the same names; or
    /// from one SCENE as written to the same SCENE with --set
    #[arg(long, conflicts_with = "accuracy_study")]
    compare: bool,
    /// Add an appendix with all other results: all joints, effects, solver details, charts
    #[arg(long)]
    full: bool,
    /// Add what drystone vary finds for one number of each scene, or for two: 'friction=0.2..0.9 --curve load_factor'. May be
    /// given several times
    #[arg(long, value_name = "NUMBERS", conflicts_with = "compare")]
    vary: Vec<String>,
    /// Order the scenes by their headline margin, the smallest first
    #[arg(long)]
    sort: bool,
    /// Measure the time and the errors of the accuracy levels on each scene; the times differ from run to run
    #[arg(long)]
    accuracy_study: bool,
    /// Add solving times; without them, the same scenes give the same bytes
    #[arg(long)]
    timing: bool,
    /// Title of the report
    #[arg(long, value_name = "WORDS")]
    title: Option<String>,
    /// Exit with 1 or 3, as check does, if something is unstable or undecided
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    look: StyleArgs,
    #[command(flatten)]
    ask: AskArgs,
    #[command(flatten)]
    level: AnalysisArgs,
}

/// The digits of the ends of intervals, and the width of the picture of numbers that vary, pixels.
const VARY_DIGITS: u32 = 4;
const VARY_WIDTH: f64 = 480.0;

/// The name of the script file that `examples/playground/build.sh` makes.
const SCRIPT_NAME: &str = "interactive.js";
/// The variable with the folder of the Python package, which the package sets.
const SCRIPT_VARIABLE: &str = "DRYSTONE_INTERACTIVE";
/// How to get the file, for error messages.
const SCRIPT_MADE: &str = concat!(
    "download interactive.js of the release v",
    env!("CARGO_PKG_VERSION"),
    " of drystone, or make it with examples/playground/build.sh in its repository"
);

/// The margins in a report, unless `--margins` requests all margins.
const DEFAULT_MARGINS: [MarginKind; 4] =
    [MarginKind::LoadFactor, MarginKind::Friction, MarginKind::FrictionFactor, MarginKind::Tilt];

/// Files that are not valid scenes, with the error for the command line.
type InvalidFiles = Vec<(Refused, CliError)>;

/// The part of the report for one task and the exit status of the task, or the files that are not valid scenes.
type TaskResult = Result<(Piece, ExitStatus), InvalidFiles>;

/// The results of all tasks.
struct TaskResults {
    pieces: Vec<Piece>,
    wrong: InvalidFiles,
    /// The worst exit status.
    ending: ExitStatus,
}

impl Report {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let form = self.form()?;
        let interactive = self.interactive_script(form)?;
        let theme = self.look.theme()?;
        let (tasks, mut notes) = self.tasks()?;
        self.check_targets(&tasks, form)?;
        // Without a chosen theme, a web page follows the light or dark mode of the reader's system, so it needs figures
        // for both.
        let follows = matches!(form, Form::Html | Form::Split) && !self.look.is_chosen();
        let report_options = ReportOptions {
            theme,
            dark: follows.then(|| Theme::named("dark")).flatten(),
            full: self.full,
            theme_name: self.look.name().map(str::to_owned),
            timing: if self.timing { Timing::Included } else { Timing::LeftOut },
        };
        let TaskResults { pieces, wrong, ending } = self.describe_all(&tasks, form, &report_options, terminal)?;
        let (refused, complaints): (Vec<Refused>, Vec<CliError>) = wrong.into_iter().unzip();
        if pieces.is_empty() && !complaints.is_empty() {
            return Err(complaints);
        }
        if self.compare && pieces.len() > 1 {
            let words = "The table shows the margins, blocks and largest forces of the second scene of each pair.";
            notes.push(words.to_owned());
        }
        for complaint in &complaints {
            terminal.refuse(complaint);
        }
        let is_dark = || report_options.theme.page.brightness() < 0.5;
        let report = Page {
            title: self.heading(&pieces),
            pieces,
            refused,
            notes,
            compares: self.compare,
            dark: self.look.is_chosen().then(is_dark),
            interactive,
        };
        let words = report.summary();
        write(report, form, &self.output)?;
        terminal.note(&format!("{}: {words}", self.output.display()));
        Ok(if !complaints.is_empty() {
            ExitStatus::WrongInput
        } else if self.strict {
            ending
        } else {
            ExitStatus::Done
        })
    }

    /// Returns the script of interactive figures if it was requested. Only an HTML report can contain it.
    fn interactive_script(&self, form: Form) -> Result<Option<String>, CliError> {
        match &self.interactive {
            Some(_) if form != Form::Html => {
                let shown = self.output.display();
                Err(format!("{shown}: only an HTML report can be interactive; give --output a name that ends in .html")
                    .into())
            }
            Some(given) => script(given.as_deref()).map(Some),
            None => Ok(None),
        }
    }

    /// Returns an error if the main file of the report would overwrite an input file of the command.
    fn check_targets(&self, tasks: &[Task], form: Form) -> Result<(), CliError> {
        let main = match form {
            Form::Split => self.output.join("index.html"),
            _ => self.output.clone(),
        };
        let inputs = tasks.iter().flat_map(Task::paths);
        let inputs = inputs.chain(self.look.file()).chain(self.interactive.iter().flatten().map(PathBuf::as_path));
        let inputs: Vec<&Path> = inputs.collect();
        destination::refuse_overwrites(&[main], &inputs)
    }

    /// Analyses the scenes of all tasks. Returns the parts of the report, the files that are not valid scenes, and the
    /// worst exit status of the valid scenes.
    fn describe_all(
        &self,
        tasks: &[Task],
        form: Form,
        report_options: &ReportOptions,
        terminal: &Terminal,
    ) -> Result<TaskResults, CliError> {
        let progress = Progress::begin(tasks.len(), terminal.shows_progress());
        let numbered: Vec<(usize, &Task)> = tasks.iter().enumerate().collect();
        let one = |(number, task): &(usize, &Task)| {
            progress.doing(&task.name());
            let first = task.paths()[0];
            let made = source::isolated(first, || self.describe(task, number + 1, form, report_options));
            progress.step();
            // If drystone itself fails on a scene, the overview lists this scene among the files that are not valid
            // scenes.
            made.unwrap_or_else(|fault| Ok(Err(vec![(refused(first, &fault), fault)])))
        };
        let described: Vec<Result<TaskResult, CliError>> = if self.accuracy_study {
            // Analyse one scene after the other, because parallel work would disturb the measured times.
            numbered.iter().map(one).collect()
        } else {
            numbered.par_iter().map(one).collect()
        };
        let (mut pieces, mut wrong) = (Vec::new(), Vec::new());
        let mut ending = ExitStatus::Done;
        for described in described {
            match described? {
                Ok((piece, ended)) => {
                    pieces.push(piece);
                    ending = ending.max(ended);
                }
                Err(files) => wrong.extend(files),
            }
        }
        if self.sort {
            pieces.sort_by(|a: &Piece, b: &Piece| a.row.reserve.total_cmp(&b.row.reserve));
        }
        Ok(TaskResults { pieces, wrong, ending })
    }

    fn form(&self) -> Result<Form, CliError> {
        let shown = self.output.display();
        let Some(form) = form_of(&self.output) else {
            if self.split {
                return Ok(Form::Split);
            }
            return Err(format!(
                "{shown}: the file name of a report must end in .html, .md, .pdf or .json; a folder needs --split"
            )
            .into());
        };
        if form == Form::Json && !self.vary.is_empty() {
            return Err(format!("{shown}: a JSON report has no pages for --vary; use drystone vary --json").into());
        }
        if self.split {
            return Err(format!("{shown}: --split writes many pages; give a folder, without an ending").into());
        }
        Ok(form)
    }

    fn heading(&self, pieces: &[Piece]) -> String {
        match (&self.title, pieces) {
            (Some(title), _) => title.clone(),
            (None, [one]) => one.row.title.clone(),
            (None, several) if self.compare => {
                format!("What changed: {}", counted(several.len(), "comparison"))
            }
            (None, several) => format!("Do they stand? {}", counted(several.len(), "scene")),
        }
    }

    /// Analyses the scenes of one task and makes its part of the report. `number` counts the tasks from 1.
    fn describe(
        &self,
        task: &Task,
        number: usize,
        form: Form,
        report_options: &ReportOptions,
    ) -> Result<TaskResult, CliError> {
        let mut read = match self.read(task) {
            Ok(read) => read,
            Err(wrong) => return Ok(Err(wrong)),
        };
        for source in read.iter().filter(|_| form != Form::Json) {
            if let Err(why) = figure::check_panels(&source.scene, "write a .json report") {
                let complaint = CliError::CommandLine(format!("{}: {why}", source.name()));
                return Ok(Err(vec![(refused(&source.path, &complaint), complaint)]));
            }
        }
        if form == Form::Pdf {
            // A PDF contains text in the built-in fonts of drystone. Code points replace characters that these fonts
            // lack.
            for source in &mut read {
                source.scene = missing_glyphs::legible(&source.scene, &Fonts::default()).into();
            }
        }
        let mut analyses = Vec::new();
        for source in &read {
            match self.ask.of(&source.scene) {
                Ok(mut ask) => {
                    // As in `check`, JSON contains margins only if they were requested.
                    if form != Form::Json && !ask.has(Question::Margins) {
                        ask.margins = MarginKinds::new(&DEFAULT_MARGINS);
                    }
                    analyses.push(Analysis::exact(source.scene.clone(), &self.level.options().also(ask)));
                }
                Err(why) => {
                    let complaint = CliError::CommandLine(format!("{}: {why}", source.name()));
                    return Ok(Err(vec![(refused(&source.path, &complaint), complaint)]));
                }
            }
        }
        let ending = analyses.iter().map(ExitStatus::from_analysis).max();
        let Some(mut entry) = entry(&read, &analyses, report_options) else {
            return Ok(Err(Vec::new()));
        };
        if form == Form::Markdown {
            make_figures_legible(&mut entry, &read, analyses, report_options);
        }
        if self.accuracy_study {
            let mut scene = Arc::unwrap_or_clone(read[0].scene.clone());
            if scene.title.is_empty() {
                scene.title = read[0].stem();
            }
            let measured = study(&[scene], &TOLERANCES, &mut |_| {});
            entry.add_study(&measured).map_err(|e| undone(&e))?;
        }
        for typed in &self.vary {
            // A scene may lack the number that varies. The other scenes still have their part of the report.
            if let Err(complaint) = self.add_varied(&mut entry, &read[0], typed, form, report_options) {
                return Ok(Err(vec![(refused(&read[0].path, &complaint), complaint)]));
            }
        }
        let piece = Piece::new(&entry, number, form, &stem_of(&self.output)).map_err(|e| undone(&e))?;
        Ok(Ok((piece, ending.unwrap_or(ExitStatus::Done))))
    }

    /// Adds the section of the numbers that vary. `typed` has the arguments that follow the scene in `drystone vary`.
    fn add_varied(
        &self,
        entry: &mut Entry,
        source: &Source,
        typed: &str,
        form: Form,
        options: &ReportOptions,
    ) -> Result<(), CliError> {
        let (mut numbers, mut ordinate) = (Vec::new(), Ordinate::default());
        let mut words = typed.split_whitespace();
        while let Some(word) = words.next() {
            match word {
                "--curve" => ordinate.curve = words.next(),
                "--isolines" => ordinate.isolines = words.next(),
                number => numbers.push(number.to_owned()),
            }
        }
        let wrong = |why: CliError| CliError::CommandLine(format!("--vary {typed:?}: {}", why.message()));
        // The bytes have the values of --set already.
        let (bytes, level) = (|| Ok(source.file.clone()), AnalysisArgs { set: Vec::new(), ..self.level.clone() });
        let varied = Varied::read(&source.name(), bytes, &numbers, ordinate, &level).map_err(wrong)?;
        let answer = varied.answer(VARY_DIGITS, || ());
        let width = Some(VARY_WIDTH);
        let is_drawn = ordinate.curve.is_some() || varied.ranges.len() == 2;
        let fonts = Fonts::default();
        let drawn = |theme: &Theme| {
            let mut drawing = varied.drawing(&answer, theme, width);
            if matches!(form, Form::Pdf | Form::Markdown) {
                drawing.items.iter_mut().for_each(|item| missing_glyphs::spell(item, &fonts));
            }
            drawing
        };
        let picture = is_drawn.then(|| (drawn(&options.theme), options.dark.as_ref().map(drawn)));
        let settings = self.level.set.iter().flat_map(|setting| ["--set".to_owned(), setting.to_string()]);
        let words: Vec<String> = typed.split_whitespace().map(str::to_owned).chain(settings).collect();
        entry.add_varied(&words, varied.paragraph(&answer), picture);
        Ok(())
    }

    /// Reads the scenes of a task. The error contains the files that are not valid scenes.
    fn read(&self, task: &Task) -> Result<Vec<Source>, InvalidFiles> {
        let mut read = Vec::new();
        let mut wrong = Vec::new();
        let as_written = AnalysisArgs { set: Vec::new(), ..self.level.clone() };
        for (side, path) in task.paths().into_iter().enumerate() {
            let is_as_written = self.compare && side == 0 && self.scenes.len() == 1;
            match source::read_one(path, if is_as_written { &as_written } else { &self.level }) {
                Ok(source) => read.push(source),
                Err(complaint) => wrong.push((refused(path, &complaint), complaint)),
            }
        }
        if wrong.is_empty() { Ok(read) } else { Err(wrong) }
    }
}

/// Returns the form of a report that the extension of its file selects.
pub(crate) fn form_of(output: &Path) -> Option<Form> {
    match ending(output).as_str() {
        "html" => Some(Form::Html),
        "md" => Some(Form::Markdown),
        "pdf" => Some(Form::Pdf),
        "json" => Some(Form::Json),
        _ => None,
    }
}

/// Returns the name of a report's file without folders and extension.
pub(crate) fn stem_of(output: &Path) -> String {
    output.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Writes the files of a report, all or none. `output` is the file of the report, or the folder of a split report.
pub(crate) fn write(report: Page, form: Form, output: &Path) -> Result<(), CliError> {
    let folder = if form == Form::Split { output } else { output.parent().unwrap_or(Path::new("")) };
    let made = report.files(form, &stem_of(output)).map_err(|error| undone(&error))?;
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::with_capacity(made.len());
    for (number, (name, bytes)) in made.into_iter().enumerate() {
        // Use the path of a file as the user typed it: its extension may be in upper case.
        let is_typed = number == 0 && form != Form::Split;
        files.push((if is_typed { output.to_owned() } else { folder.join(name) }, bytes));
    }
    let mut folders: Vec<&Path> =
        files.iter().skip(usize::from(form != Form::Split)).filter_map(|f| f.0.parent()).collect();
    folders.dedup();
    for own in folders {
        destination::make_folder(own, folder)?;
    }
    destination::write(&files, Existing::Replace, &[output.to_owned()])
}

fn undone(error: &dyn std::error::Error) -> CliError {
    CliError::not_written("the report", error)
}

fn refused(path: &Path, complaint: &CliError) -> Refused {
    Refused { name: path.display().to_string(), problems: complaint.problems() }
}

/// Returns the report entry of one scene, or of two scenes that are compared. Returns `None` if there is no scene.
fn entry(read: &[Source], analyses: &[Analysis], report_options: &ReportOptions) -> Option<Entry> {
    let names: Vec<String> = read.iter().map(|s| s.path.display().to_string()).collect();
    let texts: Vec<String> = read.iter().map(Source::text).collect();
    let file = |i: usize| File { name: &names[i], text: &texts[i] };
    match analyses {
        [was, is] => {
            let side = |i: usize, analysis| Side { file: file(i), analysis };
            Some(compared([side(0, was), side(1, is)], report_options))
        }
        [one, ..] => Some(Entry::new(file(0), one, report_options)),
        [] => None,
    }
}

/// If a scene has characters that drystone's fonts lack, draws the figures of the entry again with code points instead
/// of these characters. The other text stays unchanged, because the program that shows the Markdown has its own fonts.
fn make_figures_legible(
    entry: &mut Entry,
    read: &[Source],
    mut analyses: Vec<Analysis>,
    report_options: &ReportOptions,
) {
    let fonts = Fonts::default();
    let lacks = |analysis: &Analysis| missing_glyphs::lacks(analysis.given(), &fonts);
    if !analyses.iter().any(lacks) {
        return;
    }
    for analysis in &mut analyses {
        analysis.change_scenes(|scene| missing_glyphs::legible(scene, &fonts));
    }
    if let Some(drawn) = self::entry(read, &analyses, report_options) {
        entry.take_figures(drawn);
    }
}

/// Reads the script. `given` is the file, or the folder that contains it; `None` searches the folder of the program and
/// the one that the Python package names.
///
/// # Errors
/// Returns an error if the file cannot be read, is not this script, or belongs to another version of drystone.
fn script(given: Option<&Path>) -> Result<String, CliError> {
    let package = std::env::var_os(SCRIPT_VARIABLE).map(PathBuf::from);
    let program = std::env::current_exe().ok().and_then(|file| Some(file.parent()?.to_owned()));
    let mut usual = package.into_iter().chain(program).map(|folder| folder.join(SCRIPT_NAME));
    let path = match given {
        Some(path) if path.is_dir() => path.join(SCRIPT_NAME),
        Some(path) => path.to_owned(),
        None => usual.find(|file| file.is_file()).ok_or_else(|| {
            CliError::from(format!("--interactive finds no {SCRIPT_NAME} beside the program; {SCRIPT_MADE}"))
        })?,
    };
    let shown = path.display();
    let script = file::text(&path).map_err(|error| CliError::not_read(&shown, format!("{error}; {SCRIPT_MADE}")))?;
    let version = env!("CARGO_PKG_VERSION");
    let found = script
        .strip_prefix("// drystone ")
        .and_then(|rest| rest.split_once(": interactive figures\n"))
        .filter(|(_, rest)| !rest.contains("</script") && !rest.contains("<!--"));
    match found {
        Some((own, _)) if own == version => Ok(script),
        Some((own, _)) if own.len() < 40 && !own.contains('\n') => Err(format!(
            "{shown} belongs to drystone {own}, and this is drystone {version}; {SCRIPT_MADE} for its own version"
        )
        .into()),
        _ => Err(format!("{shown} is not the script of interactive figures, {SCRIPT_NAME}; {SCRIPT_MADE}").into()),
    }
}
