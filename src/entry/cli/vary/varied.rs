//! [`Varied`]: what varies, how each scene is made and examined, and what is told of all.

use serde_json::Value;

use super::store::{self, ResultFile};
use crate::clock::Instant;
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::new;
use crate::entry::request::AnalysisArgs;
use crate::mechanics::analysis::{Accuracy, Analysis, Ask, MarginKind, Options, Verdict, verdicts};
use crate::mechanics::scene::format::{Expectation, SceneFile};
use crate::mechanics::scene::{Scene, SceneError, Setting, number_in};
use crate::mechanics::vary::{Found, Map, Range, Sample, State, ValueGrid, scan};
use crate::pictures::drawing::{Drawing, Theme};
use crate::products::figure::Fall;
use crate::products::result;
use crate::products::vary::{self, Question};
use crate::text::{self, Word};

/// The number of values of one number that are examined before the ends are found.
const FIRST_VALUES: usize = 33;

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
    /// The file with the results of this run and of earlier ones.
    pub(super) store: Option<ResultFile>,
    pub(crate) question: Question,
}

/// What is asked of a scene in addition to its verdict.
#[derive(Clone, Copy, Default)]
struct Wanted {
    /// How it falls.
    words: bool,
    /// The number of the result that a picture shows.
    number: bool,
}

/// The number of the result that a picture shows: as a curve over one number, or as isolines on a map.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ordinate<'o> {
    pub(crate) curve: Option<&'o str>,
    pub(crate) isolines: Option<&'o str>,
}

impl Varied {
    /// Reads what varies. `bytes` returns the scene file if `name` is not a structure.
    pub(crate) fn read(
        name: &str,
        bytes: impl FnOnce() -> Result<Vec<u8>, CliError>,
        numbers: &[String],
        ordinate: Ordinate<'_>,
        level: &AnalysisArgs,
    ) -> Result<Varied, CliError> {
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
        let ordinate = match (ranges.len(), ordinate) {
            (2, Ordinate { curve: Some(_), .. }) => {
                return Err("--curve is for one number that varies; a map takes --isolines".into());
            }
            (1, Ordinate { isolines: Some(_), .. }) => {
                return Err("--isolines is for two numbers that vary; one number takes --curve".into());
            }
            (_, Ordinate { curve, isolines }) => curve.or(isolines),
        };
        let base = match dimensions {
            Some(_) => Base::Structure(name.to_owned(), own),
            None => Base::File(bytes()?),
        };
        let given = |range: &Range| match (range.name.as_str(), &base) {
            ("tilt", _) => Some(0.0),
            ("load_factor", _) => Some(1.0),
            (name, Base::File(bytes)) => number_in(std::str::from_utf8(bytes).ok()?, None, name),
            (name, Base::Structure(structure, _)) => new::default_of(structure, name),
        };
        let named = [ordinate].into_iter().flatten().chain(goal.iter().map(|goal: &Goal| goal.name.as_str()));
        let mut options =
            Options { deadline: level.options().deadline, accuracy: level.accuracy, ..Options::default() };
        for name in named {
            let word = name.trim_start_matches("signed_margins.");
            if let Some(kind) = MarginKind::all().into_iter().find(|kind| kind.word() == word) {
                options.ask.margins = options.ask.margins.with(kind);
            }
            options.ask.placement |= name.split('.').next() == Some("placement");
        }
        let written = |goal: &Goal| format!("{}{}{}", goal.name, if goal.is_least { ">=" } else { "<=" }, goal.value);
        let question = Question {
            name: name.to_owned(),
            goal: goal.as_ref().map(written),
            ordinate: ordinate.map(str::to_owned),
            given: ranges.iter().map(given).collect(),
            is_interval: goal.is_none()
                && ranges.len() == 1
                && (ranges[0].name == "friction" || !of_structure[0] && is_linear(&ranges[0].name)),
            units: ["m".into(), "N".into()],
        };
        let mut varied = Varied {
            base,
            ranges,
            is_dimension: of_structure,
            fixed,
            goal,
            level: level.clone(),
            options,
            store: None,
            question,
        };
        // If there is no valid scene at either end of the ranges nor in their middle, return the first problem now. The usual
        // cause is a wrong name.
        let ways = [0.0, 1.0, 0.5].map(|share| {
            let value = |range: &Range| {
                let value = range.from + share * (range.to - range.from);
                if range.is_whole { value.round() } else { value }
            };
            varied.scene(&varied.ranges.iter().map(value).collect::<Vec<f64>>())
        });
        // A step that is meant to fall holds at the values where it falls. These values need not be an interval.
        let is_meant = |scene: &Scene| scene.frames.iter().any(|frame| frame.expected == Some(Expectation::Unstable));
        if ways.iter().flatten().any(|(scene, _)| is_meant(scene)) {
            varied.question.is_interval = false;
        }
        if let Some((scene, _)) = ways.iter().flatten().next() {
            varied.question.units = [scene.units.length(), scene.units.force()].map(|unit| unit.symbol());
        }
        match ways {
            [Err(why), Err(_), Err(_)] => Err(why),
            _ => Ok(varied),
        }
    }

    /// Describes the question: all that the results depend on.
    pub(super) fn asked(&self) -> String {
        let scene = match &self.base {
            Base::File(bytes) => format!("scene {:016x}", text::hash(bytes)),
            Base::Structure(name, own) => format!("{name} {own:?}"),
        };
        let names: Vec<&str> = self.ranges.iter().map(|range| range.name.as_str()).collect();
        let fixed: Vec<String> = self.fixed.iter().map(ToString::to_string).collect();
        let (question, level) = (&self.question, &self.level);
        format!(
            "{scene}; {names:?} {fixed:?}; {:?} {:?}; {:?} {:?}",
            question.goal, question.ordinate, level.accuracy, level.contact_tolerance
        )
    }

    /// Returns a name for the scene with these values, such as `friction=0.5 kernel=0.1.json`, and the bytes of its file. `None`
    /// if the values give no valid scene.
    pub(super) fn scene_file(&self, at: &[f64]) -> Option<(String, Vec<u8>)> {
        let values = self.ranges.iter().zip(at).map(|(range, value)| format!("{}={value}", range.name));
        let name = values.collect::<Vec<_>>().join(" ").replace(['/', '\\', ':'], "_");
        Some((name + ".json", self.scene(at).ok()?.1.to_json().into_bytes()))
    }

    /// Returns the scene with these values, and its file.
    fn scene(&self, at: &[f64]) -> Result<(Scene, SceneFile), CliError> {
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

    /// Returns the result of an earlier run at these values, or else examines the scene.
    fn found(&self, at: &[f64], wanted: Wanted) -> Found {
        let key = store::key(at, wanted.words, wanted.number);
        let known = self.store.as_ref().and_then(|store| store.get(&key));
        known.unwrap_or_else(|| {
            if self.is_late() {
                let words = "the time limit was reached".to_owned();
                return Found { state: State::Undecided, value: None, words };
            }
            let found = self.examined(at, wanted);
            // Do not save a result that the time limit may have cut short.
            if let Some(store) = self.store.as_ref().filter(|_| !self.is_late()) {
                store.add(at, &key, &found);
            }
            found
        })
    }

    fn is_late(&self) -> bool {
        self.options.deadline.is_some_and(|end| Instant::now() > end)
    }

    fn examined(&self, at: &[f64], wanted: Wanted) -> Found {
        let scene = match self.scene(at) {
            Ok((scene, _)) => scene,
            Err(why) => return Found { state: State::NoScene, value: None, words: first_problem(&why) },
        };
        if let (None, false, Accuracy::Standard) = (&self.goal, wanted.number, self.level.accuracy) {
            let found = verdicts(&scene, &self.options);
            let state = state_of(&scene, &found);
            if state != State::Fails || !wanted.words {
                return Found { state, value: None, words: String::new() };
            }
        }
        // Margins are computed only where a number is wanted.
        let has_number = wanted.number || self.goal.is_some();
        let options = if has_number { self.options } else { Options { ask: Ask::NOTHING, ..self.options } };
        let analysis = Analysis::exact(scene, &options);
        let found: Vec<Verdict> = analysis.frames.iter().map(|frame| frame.verdict).collect();
        let mut state = state_of(analysis.given(), &found);
        let words = if state == State::Fails { how_it_falls(&analysis) } else { String::new() };
        let mut text = None;
        let mut number = |name: &str| -> Option<f64> {
            let json = || result::to_json(&analysis, result::Timing::LeftOut, result::Layout::OneLine);
            let text: &String = text.get_or_insert_with(json);
            let is_margin = MarginKind::all().iter().any(|kind| kind.word() == name);
            let name = match name {
                "placement" => "placement.proved".to_owned(),
                name if is_margin => format!("margins.{name}"),
                name => name.to_owned(),
            };
            number_in(text, Some("frames"), &name)
        };
        if let (Some(goal), State::Holds) = (&self.goal, state) {
            let value = number(&goal.name);
            let is_reached = value.map(|value| if goal.is_least { value >= goal.value } else { value <= goal.value });
            state = if is_reached == Some(true) { State::Holds } else { State::Fails };
        }
        let value = self.question.ordinate.as_deref().filter(|_| wanted.number).and_then(&mut number);
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
    Two(Box<Map>, Option<ValueGrid>),
}

impl Varied {
    /// Examines as many scenes as the ends of intervals with so many digits, or the border of a map, need. `step` is called
    /// after each.
    pub(crate) fn answer(&self, digits: u32, step: impl Fn() + Sync) -> Answer {
        let of = |at: &[f64], wanted: Wanted| {
            let found = self.found(at, wanted);
            step();
            found
        };
        let has_number = self.question.ordinate.is_some();
        let count = if has_number { 2 * FIRST_VALUES } else { FIRST_VALUES };
        match &self.ranges[..] {
            [x, y] => {
                let map = Map::new([x.clone(), y.clone()], |at, words| of(at, Wanted { words, number: false }));
                let field =
                    has_number.then(|| ValueGrid::new(&map, |at| of(at, Wanted { words: false, number: true })));
                Answer::Two(Box::new(map), field)
            }
            ranges => {
                Answer::One(scan(&ranges[0], count, digits, |at| of(at, Wanted { words: true, number: has_number })))
            }
        }
    }

    /// Returns what was found as JSON, and as lines of text.
    pub(crate) fn told(&self, answer: &Answer) -> (Value, Vec<String>) {
        let (question, range) = (&self.question, &self.ranges[0]);
        match answer {
            Answer::One(samples) => (question.json(range, samples), question.lines(range, samples)),
            Answer::Two(map, field) => (question.map_json(map, field.as_ref()), question.map_lines(map)),
        }
    }

    /// Says what was found in a title and a paragraph, for a report.
    pub(crate) fn paragraph(&self, answer: &Answer) -> [String; 2] {
        match answer {
            Answer::One(samples) => self.question.paragraph(&self.ranges[0], samples),
            Answer::Two(map, _) => self.question.map_paragraph(map),
        }
    }

    /// Draws a curve, or a map. Without `width`, in pixels, it has the width of a screen.
    pub(crate) fn drawing(&self, answer: &Answer, theme: &Theme, width: Option<f64>) -> Drawing {
        match answer {
            Answer::One(samples) => vary::curve(&self.question, &self.ranges[0], samples, theme, width),
            Answer::Two(map, field) => vary::map(&self.question, map, field.as_ref(), theme, width),
        }
    }
}
