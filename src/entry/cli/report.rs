//! `drystone report`: many scenes on one page that a person reads.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use crate::analysis::{self, Analysis};
use crate::cli::complaint::CliError;
use crate::cli::destination;
use crate::cli::ending::ExitStatus;
use crate::cli::level::AnalysisArgs;
use crate::cli::look::StyleArgs;
use crate::cli::progress::{Progress, Shown};
use crate::cli::script;
use crate::cli::source::{self, Source};
use crate::cli::terminal::Terminal;
use crate::output::file::Existing;
use crate::output::fonts::Fonts;
use crate::report::entry::{Entry, File, ReportOptions, Side, compared};
use crate::report::page::{Form, Piece, Refused, Report as Page};
use crate::result::Timing;
use crate::study::{TOLERANCES, study};
use crate::wording::number::counted;

/// Report on scenes, on one page: verdicts with their reasons, figures, forces, margins, proofs
#[derive(Debug, Args)]
pub(crate) struct Report {
    /// Scene files, and folders, of which every .json below is taken; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Output: a file that ends in .html, .md (with its figures next to it), .pdf or .json; with --split a folder
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Write an index and a page for each scene into the folder OUT
    #[arg(long)]
    split: bool,
    /// Report what changed from the first SCENE to the second: two files, or two folders with files of the same names
    #[arg(long, conflicts_with = "accuracy_study")]
    compare: bool,
    /// Add the margins of each step
    #[arg(long)]
    margins: bool,
    /// Measure on each scene what accuracy costs in time; the times differ from run to run
    #[arg(long)]
    accuracy_study: bool,
    /// Add how long solving took; without it the same scenes give the same bytes
    #[arg(long)]
    timing: bool,
    /// What stands above the report
    #[arg(long, value_name = "WORDS")]
    title: Option<String>,
    /// End with 1 or 3, as check does, where something is unstable or undecided
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    look: StyleArgs,
    #[command(flatten)]
    level: AnalysisArgs,
}

/// What became of a file or of two: its piece and how it ended, or the files that are no scenes.
type Made = Result<(Piece, ExitStatus), Vec<(Refused, CliError)>>;

/// A scene in a report, or two that it compares.
enum Task {
    One(PathBuf),
    Two([PathBuf; 2]),
}

impl Report {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let form = self.form().map_err(|c| vec![c])?;
        let theme = self.look.theme().map_err(|c| vec![c])?;
        let (tasks, mut notes) = self.tasks()?;
        let inputs: Vec<&Path> = tasks.iter().flat_map(Task::paths).collect();
        let main = match form {
            Form::Split => self.output.join("index.html"),
            _ => self.output.clone(),
        };
        let style: Vec<&Path> = self.look.file().into_iter().collect();
        let all: Vec<&Path> = inputs.iter().copied().chain(style).collect();
        destination::apart(&[main], &all).map_err(|c| vec![c])?;
        let wanted = ReportOptions {
            theme,
            theme_name: self.look.name().map(str::to_owned),
            timing: if self.timing {
                Timing::Included
            } else {
                Timing::LeftOut
            },
        };
        let options = analysis::Options {
            margins: self.margins,
            ..self.level.options()
        };
        let shown = if terminal.shows_progress() {
            Shown::WhenLong
        } else {
            Shown::Never
        };
        let progress = Progress::begin(tasks.len(), shown);
        let numbered: Vec<(usize, &Task)> = tasks.iter().enumerate().collect();
        let one = |(number, task): &(usize, &Task)| {
            progress.doing(&task.name());
            let first = task.paths()[0];
            let made = source::isolated(first, || {
                self.made(task, number + 1, form, &wanted, &options)
            });
            progress.step();
            // The overview lists a fault of the program like a file that is no scene.
            made.unwrap_or_else(|fault| Ok(Err(vec![(refused(first, &fault), fault)])))
        };
        let made: Vec<Result<Made, CliError>> = if self.accuracy_study {
            // Scenes analysed at the same time would disturb each other's timing.
            numbered.iter().map(one).collect()
        } else {
            numbered.par_iter().map(one).collect()
        };
        drop(progress);
        let mut pieces = Vec::new();
        let mut refused = Vec::new();
        let mut complaints = Vec::new();
        let mut ending = ExitStatus::Done;
        for made in made {
            match made.map_err(|c| vec![c])? {
                Ok((piece, ended)) => {
                    pieces.push(piece);
                    ending = ending.max(ended);
                }
                Err(wrong) => {
                    for (file, complaint) in wrong {
                        refused.push(file);
                        complaints.push(complaint);
                    }
                }
            }
        }
        if pieces.is_empty() && !complaints.is_empty() {
            return Err(complaints);
        }
        if self.compare && pieces.len() > 1 {
            let words = "In the table margins, friction, blocks and largest forces are those of the second scenes.";
            notes.push(words.to_owned());
        }
        for complaint in &complaints {
            terminal.refuse(complaint);
        }
        let report = Page {
            title: self.heading(&pieces),
            pieces,
            refused,
            notes,
            compares: self.compare,
            dark: self
                .look
                .is_chosen()
                .then(|| wanted.theme.page.brightness() < 0.5),
        };
        let words = report.summary();
        self.write(report, form).map_err(|c| vec![c])?;
        terminal.note(&format!("{}: {words}", self.output.display()));
        Ok(match (complaints.is_empty(), self.strict) {
            (false, _) => ExitStatus::WrongInput,
            (true, true) => ending,
            (true, false) => ExitStatus::Done,
        })
    }

    fn form(&self) -> Result<Form, CliError> {
        let shown = self.output.display();
        let ending = self
            .output
            .extension()
            .map(|e| e.to_string_lossy().to_ascii_lowercase());
        let form = match ending.as_deref() {
            Some("html") => Form::Html,
            Some("md") => Form::Markdown,
            Some("pdf") => Form::Pdf,
            Some("json") => Form::Json,
            _ if self.split => return Ok(Form::Split),
            _ => {
                let why = format!(
                    "{shown}: a report is .html, .md, .pdf or .json, or a folder with --split"
                );
                return Err(CliError::CommandLine(why));
            }
        };
        if self.split {
            let why =
                format!("{shown}: --split writes many pages; give a folder, without an ending");
            return Err(CliError::CommandLine(why));
        }
        Ok(form)
    }

    fn stem(&self) -> String {
        let stem = self.output.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
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

    /// The scenes of the report, and notes on files that have no counterpart.
    fn tasks(&self) -> Result<(Vec<Task>, Vec<String>), Vec<CliError>> {
        if self.compare {
            return self.pairs();
        }
        if self.scenes.iter().filter(|p| *p == Path::new("-")).count() > 1 {
            let why = "standard input (-) can be read only once";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        let mut tasks = Vec::new();
        let mut complaints = Vec::new();
        for path in &self.scenes {
            if !path.is_dir() {
                tasks.push(Task::One(path.clone()));
                continue;
            }
            match below(path) {
                Ok(files) if files.is_empty() => {
                    let why = format!("{}: there is no .json file in this folder", path.display());
                    complaints.push(CliError::CommandLine(why));
                }
                Ok(files) => tasks.extend(files.into_iter().map(Task::One)),
                Err(complaint) => complaints.push(complaint),
            }
        }
        if complaints.is_empty() {
            Ok((tasks, Vec::new()))
        } else {
            Err(complaints)
        }
    }

    fn pairs(&self) -> Result<(Vec<Task>, Vec<String>), Vec<CliError>> {
        let refuse = |why: &str| vec![CliError::CommandLine(why.into())];
        let [a, b] = self.scenes.as_slice() else {
            return Err(refuse(
                "--compare takes two scenes, or two folders of scenes",
            ));
        };
        match (a.is_dir(), b.is_dir()) {
            (false, false) => Ok((vec![Task::Two([a.clone(), b.clone()])], Vec::new())),
            (true, true) => {
                let one = |complaint| vec![complaint];
                let (first, second) = (below(a).map_err(one)?, below(b).map_err(one)?);
                let mut tasks = Vec::new();
                let mut notes = Vec::new();
                for path in &first {
                    let inside = path.strip_prefix(a).unwrap_or(path);
                    let other = b.join(inside);
                    if second.contains(&other) {
                        tasks.push(Task::Two([path.clone(), other]));
                    } else {
                        notes.push(format!("Only in the first folder: {}", inside.display()));
                    }
                }
                for path in &second {
                    let inside = path.strip_prefix(b).unwrap_or(path);
                    if !first.contains(&a.join(inside)) {
                        notes.push(format!("Only in the second folder: {}", inside.display()));
                    }
                }
                if tasks.is_empty() {
                    return Err(refuse(
                        "--compare finds no file of the same name in both folders",
                    ));
                }
                Ok((tasks, notes))
            }
            _ => Err(refuse(
                "--compare takes two files or two folders, not one of each",
            )),
        }
    }

    /// A task's piece of the report.
    fn made(
        &self,
        task: &Task,
        number: usize,
        form: Form,
        wanted: &ReportOptions,
        options: &analysis::Options,
    ) -> Result<Made, CliError> {
        let mut read = Vec::new();
        let mut wrong = Vec::new();
        for path in task.paths() {
            match source::with_text(path, self.level.contact_tolerance) {
                Ok(source) => read.push(source),
                Err(complaint) => wrong.push((refused(path, &complaint), complaint)),
            }
        }
        if !wrong.is_empty() {
            return Ok(Err(wrong));
        }
        if form == Form::Pdf {
            // Its words are drawn here, in our fonts.
            for (source, _) in &mut read {
                source.scene = script::legible(&source.scene, &Fonts::default());
            }
        }
        let analyses: Vec<Analysis> = read
            .iter()
            .map(|(source, _)| Analysis::with(&source.scene, options))
            .collect();
        let ending = analyses.iter().map(ExitStatus::from_analysis).max();
        let names: Vec<String> = read.iter().map(|(s, _)| shown(s)).collect();
        let file = |i: usize| File {
            name: &names[i],
            text: &read[i].1,
        };
        let described = |analyses: &[Analysis]| match analyses {
            [was, is] => {
                let side = |i: usize, analysis| Side {
                    file: file(i),
                    analysis,
                };
                Some(compared([side(0, was), side(1, is)], wanted))
            }
            [one, ..] => Some(Entry::new(file(0), one, wanted)),
            [] => None,
        };
        let Some(mut entry) = described(&analyses) else {
            return Ok(Err(Vec::new()));
        };
        if form == Form::Markdown {
            // In Markdown only the figures use our fonts; the reader's program sets the text.
            let fonts = Fonts::default();
            let lacks = |analysis: &Analysis| script::lacks(&analysis.scene, &fonts);
            if analyses.iter().any(lacks) {
                let mut drawn = analyses;
                for analysis in &mut drawn {
                    analysis.scene = script::legible(&analysis.scene, &fonts).into();
                }
                let steps = described(&drawn).map_or(Vec::new(), |entry| entry.steps);
                for (step, drawn) in entry.steps.iter_mut().zip(steps) {
                    step.plates = drawn.plates;
                }
            }
        }
        if self.accuracy_study {
            let mut scene = read[0].0.scene.clone();
            if scene.title.is_empty() {
                scene.title = read[0].0.stem();
            }
            let measured = study(&[scene], &TOLERANCES, &mut |_| {});
            entry.add_study(&measured).map_err(|e| undone(&e))?;
        }
        let piece = Piece::new(&entry, number, form, &self.stem()).map_err(|e| undone(&e))?;
        Ok(Ok((piece, ending.unwrap_or(ExitStatus::Done))))
    }

    fn write(&self, report: Page, form: Form) -> Result<(), CliError> {
        let folder = match form {
            Form::Split => self.output.clone(),
            _ => self.output.parent().unwrap_or(Path::new("")).to_owned(),
        };
        let made = report
            .files(form, &self.stem())
            .map_err(|error| undone(&error))?;
        let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::with_capacity(made.len());
        for (number, (name, bytes)) in made.into_iter().enumerate() {
            let path = match (form, number) {
                (Form::Split, _) | (_, 1..) => folder.join(name),
                // As it was typed, whatever the letters of its ending.
                _ => self.output.clone(),
            };
            files.push((path, bytes));
        }
        let mut folders: Vec<&Path> = files
            .iter()
            .skip(usize::from(form != Form::Split))
            .filter_map(|f| f.0.parent())
            .collect();
        folders.dedup();
        for folder in folders {
            destination::make_folder(folder)?;
        }
        destination::write(&files, Existing::Replace)
    }
}

impl Task {
    fn paths(&self) -> Vec<&Path> {
        match self {
            Task::One(path) => vec![path.as_path()],
            Task::Two(paths) => paths.iter().map(PathBuf::as_path).collect(),
        }
    }

    fn name(&self) -> String {
        let names = self.paths().into_iter();
        names
            .map(|p| p.display().to_string())
            .collect::<Vec<_>>()
            .join(" → ")
    }
}

/// The path as typed.
fn shown(source: &Source) -> String {
    source.path.display().to_string()
}

fn undone(error: &dyn std::error::Error) -> CliError {
    CliError::NotWritten {
        what: "the report".into(),
        why: error.to_string(),
    }
}

fn refused(path: &Path, complaint: &CliError) -> Refused {
    Refused {
        name: path.display().to_string(),
        problems: complaint.problems(),
    }
}

/// Every .json file below a folder, in the order of their paths. Links to folders are not followed: they may lead in a
/// circle.
fn below(folder: &Path) -> Result<Vec<PathBuf>, CliError> {
    let unread = |path: &Path, error: &std::io::Error| CliError::NotRead {
        what: path.display().to_string(),
        why: error.to_string(),
    };
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).map_err(|e| unread(&folder, &e))?;
        for entry in entries {
            let entry = entry.map_err(|e| unread(&folder, &e))?;
            let kind = entry.file_type().map_err(|e| unread(&entry.path(), &e))?;
            let path = entry.path();
            let json = path
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("json"));
            if kind.is_dir() {
                folders.push(path);
            } else if json && path.is_file() {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}
