//! `drystone vary`: for which values of one number, or of two, a structure stands.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::Value;

use crate::clock::Instant;
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
use crate::mechanics::analysis::{Accuracy, Analysis, MarginKind, MarginKinds, Options, Verdict, verdicts};
use crate::mechanics::scene::format::Expectation;
use crate::mechanics::scene::{Scene, SceneError, Setting};
use crate::mechanics::vary::{Found, Map, Range, Sample, State, scan};
use crate::pictures::drawing::{Drawing, Theme};
use crate::pictures::output::file::Existing;
use crate::products::figure::Fall;
use crate::products::result;
use crate::products::vary::{self, Question};
use crate::read::file::ending;
use crate::text::Word;

/// The number of values of one number that are examined before the ends are found.
const FIRST_VALUES: usize = 33;

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

/// Where the scenes come from.
enum Base {
    /// The bytes of a scene file.
    File(Vec<u8>),
    /// A structure of `drystone new`, with the dimensions that do not vary.
    Structure(String, Vec<(String, String)>),
}

/// A number of the result that must be at least, or at most, a value.
struct Goal {
    name: String,
    is_least: bool,
    value: f64,
}

/// What varies, and how a scene is made and examined.
pub(crate) struct Varied {
    base: Base,
    /// The numbers that vary, one or two.
    pub(crate) ranges: Vec<Range>,
    /// Whether each of them is a dimension of the structure; otherwise it is a key of the scene.
    is_dimension: Vec<bool>,
    fixed: Vec<Setting>,
    goal: Option<Goal>,
    level: AnalysisArgs,
    options: Options,
    pub(crate) question: Question,
}

impl Varied {
    /// Reads what varies. `bytes` returns the scene file if `name` is not a structure.
    pub(crate) fn read(
        name: &str,
        bytes: impl FnOnce() -> Result<Vec<u8>, CliError>,
        numbers: &[String],
        curve: Option<&str>,
        level: &AnalysisArgs,
    ) -> Result<Varied, CliError> {
        if level.wedging || level.placement || level.removable {
            return Err("--wedging, --placement and --removable have no effect on vary; leave them out".into());
        }
        let dimensions = new::dimensions(name);
        let is_dimension = |own: &str| dimensions.iter().flatten().find(|(dimension, _)| dimension == own);
        let (mut ranges, mut of_structure, mut fixed, mut goal) = (Vec::new(), Vec::new(), level.set.clone(), None);
        let mut own = Vec::new();
        for typed in numbers {
            let wrong = |why: &str| CliError::CommandLine(format!("{typed}: {why}"));
            let compared = typed.split_once(">=").map(|parts| (parts, true));
            if let Some(((name, value), is_least)) =
                compared.or_else(|| typed.split_once("<=").map(|parts| (parts, false)))
            {
                let value = value.trim().parse().map_err(|_| wrong("write a number, such as load_factor>=2"))?;
                if goal.replace(Goal { name: name.trim().to_owned(), is_least, value }).is_some() {
                    return Err(wrong("only one goal can be asked for; leave out the others"));
                }
                continue;
            }
            let how = "write NAME=FROM..TO, NAME=VALUE or NAME>=VALUE, such as friction=0.2..0.9";
            let (name, value) = typed.split_once('=').ok_or_else(|| wrong(how))?;
            let (name, value) = (name.trim(), value.trim());
            let dimension = is_dimension(name);
            let Some((from, to)) = value.split_once("..") else {
                match dimension {
                    Some(_) => own.push((name.to_owned(), value.to_owned())),
                    None => fixed.push(typed.parse().map_err(|why: String| wrong(&why))?),
                }
                continue;
            };
            let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
            let (Some(from), Some(to)) = (number(from), number(to)) else { return Err(wrong(how)) };
            if from >= to {
                return Err(wrong("the first value must be less than the second"));
            }
            let is_whole = dimension.is_some_and(|(_, is_whole)| *is_whole);
            if is_whole && (from.fract() != 0.0 || to.fract() != 0.0) {
                return Err(wrong("this dimension is a whole number"));
            }
            ranges.push(Range { name: name.to_owned(), from, to, is_whole });
            of_structure.push(dimension.is_some());
        }
        if !(1..=2).contains(&ranges.len()) {
            return Err("one number or two must vary, such as friction=0.2..0.9".into());
        }
        if curve.is_some() && ranges.len() == 2 {
            return Err("--curve is for one number that varies; two give a map".into());
        }
        let base = match dimensions {
            Some(_) => Base::Structure(name.to_owned(), own),
            None => Base::File(bytes()?),
        };
        let tree: Option<Value> = match &base {
            Base::File(bytes) => serde_json::from_slice(bytes).ok(),
            Base::Structure(..) => None,
        };
        let given = |range: &Range| match (range.name.as_str(), &base) {
            ("tilt", _) => Some(0.0),
            ("load_factor", _) => Some(1.0),
            (name, Base::File(_)) => tree.as_ref().and_then(|tree| found_at(tree, name)?.as_f64()),
            (name, Base::Structure(structure, _)) => new::default_of(structure, name),
        };
        let named = [curve].into_iter().flatten().chain(goal.iter().map(|goal: &Goal| goal.name.as_str()));
        let mut options =
            Options { deadline: level.options().deadline, accuracy: level.accuracy, ..Options::default() };
        for name in named {
            if let Some(kind) = MarginKind::all().into_iter().find(|kind| kind.word() == name) {
                let kinds = if options.margins { options.margin_kinds.with(kind) } else { MarginKinds::new(&[kind]) };
                options = options.margins(true).margin_kinds(kinds);
            }
            options.placement |= name.split('.').next() == Some("placement");
        }
        let written = |goal: &Goal| format!("{}{}{}", goal.name, if goal.is_least { ">=" } else { "<=" }, goal.value);
        let question = Question {
            name: name.to_owned(),
            goal: goal.as_ref().map(written),
            ordinate: curve.map(str::to_owned),
            given: ranges.iter().map(given).collect(),
            is_interval: goal.is_none()
                && ranges.len() == 1
                && (ranges[0].name == "friction" || !of_structure[0] && is_linear(&ranges[0].name)),
        };
        let mut varied =
            Varied { base, ranges, is_dimension: of_structure, fixed, goal, level: level.clone(), options, question };
        // What gives a scene neither at the ends nor in the middle is refused at once: most often a name that is not there.
        let ways = [0.0, 1.0, 0.5].map(|share| {
            let value = |range: &Range| {
                let value = range.from + share * (range.to - range.from);
                if range.is_whole { value.round() } else { value }
            };
            varied.scene(&varied.ranges.iter().map(value).collect::<Vec<f64>>())
        });
        // Where a step is meant to fall, it holds outside of an interval.
        let is_meant = |scene: &Scene| scene.frames.iter().any(|frame| frame.expected == Some(Expectation::Unstable));
        if ways.iter().flatten().any(is_meant) {
            varied.question.is_interval = false;
        }
        match ways {
            [Err(why), Err(_), Err(_)] => Err(why),
            _ => Ok(varied),
        }
    }

    /// Returns the scene with these values.
    pub(crate) fn scene(&self, at: &[f64]) -> Result<Scene, CliError> {
        let mut settings = self.fixed.clone();
        let mut own = Vec::new();
        for ((range, is_dimension), value) in self.ranges.iter().zip(&self.is_dimension).zip(at) {
            if *is_dimension {
                own.push((range.name.clone(), value.to_string()));
            } else {
                settings.push(format!("{}={value}", range.name).parse().map_err(CliError::CommandLine)?);
            }
        }
        let built;
        let bytes = match &self.base {
            Base::File(bytes) => bytes.as_slice(),
            Base::Structure(name, fixed) => {
                own.extend(fixed.iter().cloned());
                built = new::structure(name, &own).map_err(CliError::CommandLine)?;
                built.as_bytes()
            }
        };
        let scene = Scene::from_slice_changed(bytes, self.level.contact_tolerance, &settings);
        scene.map_err(|problems| CliError::Scene { name: self.question.name.clone(), problems })
    }

    /// Examines the scene with these values. `has_words` asks how it falls.
    fn found(&self, at: &[f64], has_words: bool) -> Found {
        if self.options.deadline.is_some_and(|end| Instant::now() > end) {
            let words = "the time limit was reached".to_owned();
            return Found { state: State::Undecided, value: None, words };
        }
        let scene = match self.scene(at) {
            Ok(scene) => scene,
            Err(why) => return Found { state: State::NoScene, value: None, words: first_problem(&why) },
        };
        if let (None, None, Accuracy::Standard) = (&self.goal, &self.question.ordinate, self.level.accuracy) {
            let found = verdicts(&scene, &self.options);
            let state = state_of(&scene, &found);
            if state != State::Fails || !has_words {
                return Found { state, value: None, words: String::new() };
            }
        }
        let analysis = Analysis::exact(scene, &self.options);
        let found: Vec<Verdict> = analysis.frames.iter().map(|frame| frame.verdict).collect();
        let mut state = state_of(&analysis.scene, &found);
        let words = if state == State::Fails { how_it_falls(&analysis) } else { String::new() };
        let mut numbers = None;
        let mut number = |name: &str| -> Option<f64> {
            let text = || result::to_json(&analysis, result::Timing::LeftOut, result::Layout::OneLine);
            let tree: &Value = numbers.get_or_insert_with(|| serde_json::from_str(&text()).unwrap_or_default());
            let frame = tree.get("frames")?.as_array()?.last()?;
            amount(match name {
                "placement" => frame.get("placement")?.get("proved")?,
                name if MarginKind::all().iter().any(|kind| kind.word() == name) => frame.get("margins")?.get(name)?,
                name => found_at(frame, name)?,
            })
        };
        if let (Some(goal), State::Holds) = (&self.goal, state) {
            let value = number(&goal.name);
            let is_reached = value.map(|value| if goal.is_least { value >= goal.value } else { value <= goal.value });
            state = if is_reached == Some(true) { State::Holds } else { State::Fails };
        }
        let value = self.question.ordinate.as_deref().and_then(&mut number);
        Found { state, value, words }
    }
}

/// Returns whether all frames stand that are meant to.
fn state_of(scene: &Scene, verdicts: &[Verdict]) -> State {
    match ExitStatus::from_verdicts(scene, verdicts.iter().copied()) {
        ExitStatus::Done => State::Holds,
        ExitStatus::Undecided => State::Undecided,
        _ => State::Fails,
    }
}

/// Says how the first frame that falls begins to move: at which kinds of joints.
fn how_it_falls(analysis: &Analysis) -> String {
    let Some(frame) = analysis.frames.iter().position(|frame| frame.verdict == Verdict::Unstable) else {
        return String::new();
    };
    let fall = Fall::of(analysis, frame);
    let hinges = fall.joints.iter().any(|joint| joint.hinge.is_some());
    let slides = fall.joints.iter().any(|joint| joint.slip != 0.0);
    match (hinges, slides) {
        (true, true) => "hinges and sliding",
        (true, false) => "hinges",
        (false, true) => "sliding",
        (false, false) => "",
    }
    .into()
}

/// Returns the number in a value of a result: the smaller one of two sides, infinite without a limit.
fn amount(value: &Value) -> Option<f64> {
    match value {
        Value::String(word) if word == "unbounded" => Some(f64::INFINITY),
        Value::Object(sides) => sides.values().map(amount).collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::min),
        value => value.as_f64(),
    }
}

/// Finds a value by its path, such as `loads[0].at[1]` or `blocks.V3.weight`: an entry of a list is named by its id too.
fn found_at<'t>(tree: &'t Value, path: &str) -> Option<&'t Value> {
    if path.is_empty() {
        return Some(tree);
    }
    let after = |name: &str| {
        let rest = path.strip_prefix(name)?;
        (rest.is_empty() || rest.starts_with(['.', '['])).then(|| rest.strip_prefix('.').unwrap_or(rest))
    };
    match tree {
        Value::Object(keys) => keys.iter().find_map(|(key, value)| found_at(value, after(key)?)),
        Value::Array(list) => list.iter().enumerate().find_map(|(number, entry)| {
            let id = entry.get("id").or_else(|| entry.get("block")).and_then(Value::as_str);
            let rest = after(&format!("[{number}]")).or_else(|| after(id?))?;
            found_at(entry, rest)
        }),
        _ => None,
    }
}

/// True if the loads or the limits of the forces are linear in a number of the scene, and the number does not change its
/// geometry. Forces between two sets of forces that balance then balance too, so the scene stands at an interval of values.
fn is_linear(name: &str) -> bool {
    let last =
        name.rsplit(['.', '[']).find(|part| part.parse::<usize>().is_err() && !part.ends_with(']')).unwrap_or(name);
    matches!(last, "friction" | "kernel" | "load_factor" | "weight" | "mass" | "force" | "torque")
        || name.starts_with("loads") && last == "at"
}

/// Returns the first problem of a scene, without its place in the file.
fn first_problem(why: &CliError) -> String {
    match why {
        CliError::Scene { problems: SceneError { list, .. }, .. } => {
            list.first().map(|problem| problem.message.clone()).unwrap_or_default()
        }
        CliError::CommandLine(why) => why.clone(),
        _ => String::new(),
    }
}

/// What was found for one number, or for two.
pub(crate) enum Answer {
    One(Vec<Sample>),
    Two(Box<Map>),
}

impl Varied {
    /// Examines as many scenes as the ends of intervals with so many digits, or the border of a map, need. `step` is called
    /// after each.
    pub(crate) fn answer(&self, digits: u32, step: impl Fn() + Sync) -> Answer {
        let of = |at: &[f64], has_words: bool| {
            let found = self.found(at, has_words);
            step();
            found
        };
        let count = if self.question.ordinate.is_some() { 2 * FIRST_VALUES } else { FIRST_VALUES };
        match &self.ranges[..] {
            [x, y] => Answer::Two(Box::new(Map::new([x.clone(), y.clone()], of))),
            ranges => Answer::One(scan(&ranges[0], count, digits, |at| of(at, true))),
        }
    }

    /// Returns what was found as JSON, and as lines of text.
    pub(crate) fn told(&self, answer: &Answer) -> (Value, Vec<String>) {
        let (question, range) = (&self.question, &self.ranges[0]);
        match answer {
            Answer::One(samples) => (question.json(range, samples), question.lines(range, samples)),
            Answer::Two(map) => (question.map_json(map), question.map_lines(map)),
        }
    }

    /// Draws a curve, or a map. Without `width`, in pixels, it has the width of a screen.
    pub(crate) fn drawing(&self, answer: &Answer, theme: &Theme, width: Option<f64>) -> Drawing {
        match answer {
            Answer::One(samples) => vary::curve(&self.question, &self.ranges[0], samples, theme, width),
            Answer::Two(map) => vary::map(&self.question, map, theme, width),
        }
    }
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
        let varied = Varied::read(&name, bytes, &self.numbers, self.curve.as_deref(), &self.level)?;
        if forms.iter().any(Option::is_some) && varied.ranges.len() == 1 && self.curve.is_none() {
            return Err(CliError::from(
                "a picture of one number needs --curve NAME, such as --curve load_factor; two numbers give a map",
            )
            .into());
        }
        let theme = self.look.theme()?;
        let fonts = self.picture.fonts()?;
        let progress = Progress::begin(0, terminal.shows_progress());
        let answer = varied.answer(self.digits, || progress.step());
        drop(progress);
        let (json, lines) = varied.told(&answer);
        let samples = match &answer {
            Answer::One(samples) => samples,
            Answer::Two(map) => &map.samples,
        };
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
