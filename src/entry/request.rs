//! What a user asks for, on the command line and in the JSON that Python and JavaScript send. Each option is declared
//! once: its name, its help, and how its value is read.

use std::borrow::Cow;
use std::sync::Arc;

use super::value::{FrameChoice, SensitivityMargin, TimeLimit, length, seconds};
use crate::mechanics::analysis::{
    self, Accuracy, Analysis, Ask, CapacityRequest, MarginKind, MarginKinds, Question, typed_capacity,
};
use crate::mechanics::scene::{BlockId, Scene, SceneError, Setting};
use crate::pictures::drawing::Theme;
use crate::products::figure::{self, At, Fill, Kind, View};
use crate::read::{Dialect, Given, requested};
use crate::text::Word;

request! {
    /// How strict, how long and with which contacts a scene is analysed.
    #[derive(Clone, Debug)]
    pub(crate) struct AnalysisArgs(given) {
        /// How strict the proof of a verdict must be; proved is stricter than standard by a factor of 100 for forces
        /// and 1000 for motions, and says which verdicts hold in exact arithmetic; with exact, a verdict that does not is
        /// undecided
        accuracy: Accuracy = given.word("accuracy").unwrap_or_default(),
            arg(long, value_name = "LEVEL", default_value = "standard", env = "DRYSTONE_ACCURACY",
                hide_env_values = true, value_parser = crate::text::typed_word::<Accuracy>());
        /// Edges within this many metres touch, and bodies may overlap by up to this depth. It replaces the scene's
        /// `contact_tolerance`, or the value that is estimated from its coordinates
        contact_tolerance: Option<f64> = given.value("contact_tolerance", length),
            arg(long, value_name = "METRES", value_parser = length);
        /// Stop solving after this many seconds; frames that are not decided by then are undecided
        time_limit: Option<TimeLimit> = given.value("time_limit", seconds),
            arg(long, value_name = "SECONDS", env = "DRYSTONE_TIME_LIMIT", hide_env_values = true,
                value_parser = |typed: &str| seconds(typed).map(TimeLimit::started));
        /// Give a key of the scene another value, such as friction=0.5, kernel=0.2, gravity=[0,-1.62] or
        /// blocks.V3.weight=20, also several times; tilt=5 turns gravity to the right by 5°, and load_factor=2 doubles
        /// all loads
        set: Vec<Setting> = Vec::new(), arg(long, value_name = "KEY=VALUE");
    }
}

request! {
    /// What is asked about every scene beyond its verdicts.
    #[derive(Clone, Debug)]
    pub(crate) struct AskArgs(given) {
        /// Compute how far each frame is from its limit: least friction and factor on it, largest tilt, horizontal load,
        /// kernel and factor on the loads, least limits of robots; or only some of these, such as friction,tilt
        margins: Option<Vec<MarginKind>> = given.all_or_some("margins"),
            arg(long, value_parser = crate::text::typed_word::<MarginKind>(), value_name = "LIST",
                value_delimiter = ',', num_args = 0.., require_equals = true);
        /// Compute how a margin changes with corners, weights, friction and loads, and list the ten changes with the
        /// largest effect; --json has them all
        sensitivity: Option<SensitivityMargin> = given.word("sensitivity"),
            arg(long, value_parser = crate::text::typed_word::<SensitivityMargin>(), value_name = "MARGIN");
        capacity: CapacityArgs = CapacityArgs::read(given), command(flatten);
        /// Test whether each standing frame stands only by wedging: by a self-stress that its loads do not build up
        /// from rest
        wedging: bool = given.flag("wedging"), arg(long);
        /// Compute how accurately the blocks must be placed: the error up to which every standing frame is proved to
        /// stand, and an error with which it falls
        placement: bool = given.flag("placement"), arg(long);
        /// Find out for each block whether the rest stands without it, and the least force of a robot that holds it or
        /// the rest
        removable: bool = given.flag("removable"), arg(long);
    }
}

request! {
    /// The block whose capacity is computed, and the ranges for which it must carry the forces.
    #[derive(Clone, Debug)]
    pub(crate) struct CapacityArgs(given) {
        /// Compute all forces that a block can carry in addition to the forces that already act: BLOCK at its centroid
        /// (or the force of the robot that holds it), BLOCK@x,y at a point, BLOCK@x,y..x,y at two points, as their
        /// resultant
        capacity: Option<String> = given.text("capacity"), arg(long, value_name = "BLOCK[@x,y]");
        /// With --capacity: only forces that the block can carry for all values in these ranges, such as
        /// tilt=±2,horizontal=±0.05,friction=0.5..0.7
        for_all: Option<String> = given.text("for_all"),
            arg(long, value_name = "RANGES", requires = "capacity", allow_hyphen_values = true);
    }
}

request! {
    /// What an analysis computes, and of which frame.
    #[derive(Clone, Debug)]
    pub(crate) struct CheckArgs(given) {
        ask: AskArgs = AskArgs::read(given), command(flatten);
        /// With --placement: only these blocks are off their places, all others are exact
        placed: Option<Vec<String>> = given.list("placed", |r, node, at| r.text(node, at)),
            arg(long, value_name = "BLOCKS", value_delimiter = ',', requires = "placement");
        /// Compute only the verdict with its proof; leave out the failures and the choice of the unique forces
        verdict_only: bool = given.flag("verdict_only"), arg(long);
        /// Leave out notes about allowed input that is rarely intended; a scene silences single notes with "silence":
        /// ["code"]
        no_notes: bool = given.flag("no_notes"), arg(long);
        /// Analyse only one frame: its number from 1, its letter in the strip, or last
        frame: Option<FrameChoice> = given.value("frame", str::parse), arg(long, value_name = "N");
        level: AnalysisArgs = AnalysisArgs::read(given), command(flatten);
    }
}

request! {
    /// What a figure shows.
    #[derive(Clone, Debug)]
    pub(crate) struct FigureArgs(given) {
        /// What the figure shows
        kind: View = given.word("kind").unwrap_or_default(),
            arg(long, default_value = "forces", value_parser = crate::text::typed_word::<View>());
        /// The id of the block of a free-body diagram
        block: Option<String> = given.text("block"), arg(long, value_name = "ID");
        ask: AskArgs = AskArgs::read(given), command(flatten);
        /// The margin of --kind sensitivity [default: load-factor if there are loads, otherwise tilt]; with kernel,
        /// --kind joints shows the forces of the largest kernel
        margin: Option<SensitivityMargin> = given.word("margin"),
            arg(long, value_parser = crate::text::typed_word::<SensitivityMargin>(), value_name = "MARGIN");
        /// Show only the neighbourhood of the block with this id
        zoom: Option<String> = given.text("zoom"), arg(long, value_name = "ID");
        options: figure::Options = figure::Options::read(given), command(flatten);
        level: AnalysisArgs = AnalysisArgs::read(given), command(flatten);
    }
}

/// Reads what a user asks for from the text of a JSON object. Without text, every option has its default value. The
/// error contains all problems, each with its key and a remedy.
pub(crate) fn read_json<T>(text: Option<&str>, read: impl Fn(&mut Given<'_, '_>) -> T) -> Result<T, String> {
    requested(text.unwrap_or("{}"), &Dialect::plain("options"), read).map_err(|mut problems| {
        // The text was written by a program, so lines and columns would mean nothing.
        problems.0.iter_mut().for_each(|problem| problem.line = 0);
        problems.to_string()
    })
}

/// Returns a message about options with the names that JSON has for them: `for_all` instead of `--for-all`.
pub(crate) fn in_json(message: &str) -> String {
    let name = |word: &str| word.strip_prefix("--").map_or_else(|| word.to_owned(), |name| name.replace('-', "_"));
    message.split(' ').map(name).collect::<Vec<_>>().join(" ")
}

/// Why a scene was not analysed or drawn.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Refused {
    /// The scene is not valid.
    Scene(SceneError),
    /// An option does not fit the scene; the text is the message.
    Option(String),
}

impl From<SceneError> for Refused {
    fn from(problems: SceneError) -> Refused {
        Refused::Scene(problems)
    }
}

impl From<String> for Refused {
    fn from(why: String) -> Refused {
        Refused::Option(in_json(&why))
    }
}

impl AnalysisArgs {
    /// Returns the same options with a time limit that counts from now: for the next of several scenes, or for a new run.
    #[cfg(feature = "cli")]
    pub(crate) fn started(&self) -> AnalysisArgs {
        AnalysisArgs { time_limit: self.time_limit.map(TimeLimit::started), ..self.clone() }
    }

    /// Reads the text of a scene. With `frame`, the scene keeps only this frame.
    pub(crate) fn scene(&self, text: &str, frame: Option<FrameChoice>) -> Result<Scene, Refused> {
        let (scene, _) = self.read_scene(0, text.as_bytes())?;
        Ok(match frame {
            Some(frame) => frame.of(&scene, "the scene")?,
            None => scene,
        })
    }

    /// Reads a scene from bytes. In its file, `lines_before` lines stand before these bytes. Also returns the bytes after
    /// the option `set` has replaced values in them.
    pub(crate) fn read_scene<'b>(
        &self,
        lines_before: usize,
        bytes: &'b [u8],
    ) -> Result<(Scene, Cow<'b, [u8]>), SceneError> {
        Scene::from_slice_set(lines_before, bytes, self.contact_tolerance, &self.set)
    }

    /// Returns the options of an analysis that is asked nothing beyond the verdict, without the contact tolerance, which
    /// the reader of the scene applies.
    pub(crate) fn options(&self) -> analysis::Options {
        analysis::Options {
            accuracy: self.accuracy,
            deadline: self.time_limit.and_then(TimeLimit::end),
            ..analysis::Options::default()
        }
    }

    /// Returns the name and the value of each option. A resume file records these values, because the results of a
    /// batch depend on them.
    #[cfg(feature = "cli")]
    pub(crate) fn described(&self) -> [(&'static str, String); 4] {
        let tolerance = self.contact_tolerance.map(|metres| format!("{metres} m"));
        let limit = self.time_limit.map(|limit| format!("{:?}", limit.given));
        [
            ("--accuracy", self.accuracy.word().to_owned()),
            ("--contact-tolerance", tolerance.unwrap_or_else(|| "not given".into())),
            ("--time-limit", limit.unwrap_or_else(|| "not given".into())),
            ("--set", self.set.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
        ]
    }
}

impl AskArgs {
    /// Returns what is asked about a scene.
    pub(crate) fn of(&self, scene: &Scene) -> Result<Ask, String> {
        let margins = match self.margins.as_deref() {
            None => MarginKinds::NONE,
            Some([]) => MarginKinds::ALL,
            Some(list) => MarginKinds::new(list),
        };
        let AskArgs { wedging, placement, removable, .. } = *self;
        let sensitivity = self.sensitivity.map(|margin| margin.0);
        let capacity = self.capacity.of(scene)?;
        Ok(Ask { margins, sensitivity, capacity, wedging, placement, removable })
    }
}

#[cfg(feature = "cli")]
impl AskArgs {
    /// Returns the name and the value of each option, for a resume file.
    pub(crate) fn described(&self) -> [(&'static str, String); 7] {
        let yes = |is_asked| if is_asked { "yes" } else { "no" }.to_owned();
        let text = |value: &Option<String>| value.clone().unwrap_or_else(|| "not given".into());
        let margins = match self.margins.as_deref() {
            None => "none".into(),
            Some([]) => "all".into(),
            Some(list) => list.iter().map(|kind| kind.word()).collect::<Vec<_>>().join(","),
        };
        [
            ("--margins", margins),
            ("--sensitivity", text(&self.sensitivity.map(|margin| margin.0.word().to_owned()))),
            ("--capacity", text(&self.capacity.capacity)),
            ("--for-all", text(&self.capacity.for_all)),
            ("--wedging", yes(self.wedging)),
            ("--placement", yes(self.placement)),
            ("--removable", yes(self.removable)),
        ]
    }

    /// True if a question is asked.
    pub(crate) fn has(&self, question: Question) -> bool {
        match question {
            Question::Margins => self.margins.is_some(),
            Question::Sensitivity => self.sensitivity.is_some(),
            Question::Capacity => self.capacity.capacity.is_some(),
            Question::Wedging => self.wedging,
            Question::Placement => self.placement,
            Question::Removable => self.removable,
        }
    }
}

impl CapacityArgs {
    /// Returns the block of a scene and the ranges.
    pub(crate) fn of(&self, scene: &Scene) -> Result<Option<CapacityRequest>, String> {
        match (&self.capacity, self.for_all.as_deref()) {
            (None, None) => Ok(None),
            (None, Some(_)) => {
                Err("--for-all limits the forces that a block can carry, so it needs --capacity too".into())
            }
            (Some(typed), for_all) => typed_capacity(scene, typed, for_all).map(Some),
        }
    }
}

impl CheckArgs {
    /// Returns the options of the analysis of a scene.
    pub(crate) fn options(&self, scene: &Scene) -> Result<analysis::Options, String> {
        Ok(self.level.options().verdict_only(self.verdict_only).also(self.ask.of(scene)?))
    }

    /// Changes a scene such that only the blocks of the option `placed` are off their places.
    pub(crate) fn only_placed(&self, scene: &mut Scene) -> Result<(), String> {
        let Some(names) = &self.placed else { return Ok(()) };
        if !self.ask.placement {
            return Err("--placed needs --placement".into());
        }
        let off = names.iter().map(|name| figure::named_block(scene, name)).collect::<Result<Vec<_>, _>>()?;
        for (number, block) in scene.blocks.iter_mut().enumerate() {
            if !off.contains(&BlockId(number)) {
                block.placement = 0.0;
            }
        }
        Ok(())
    }

    /// Reads the text of a scene, with the frame that is chosen, and analyses it.
    pub(crate) fn analysis(&self, text: &str) -> Result<Analysis, Refused> {
        let mut scene = self.level.scene(text, self.frame)?;
        self.only_placed(&mut scene)?;
        let options = self.options(&scene)?;
        Ok(self.analysed(scene, &options))
    }

    /// Analyses a scene, and leaves out notes that are not wanted.
    pub(crate) fn analysed(&self, scene: impl Into<Arc<Scene>>, options: &analysis::Options) -> Analysis {
        let mut analysis = Analysis::exact(scene, options);
        if self.no_notes {
            analysis.notes.clear();
        }
        analysis
    }
}

impl FigureArgs {
    /// Returns the kind of figure.
    pub(crate) fn kind(&self) -> Kind {
        self.view().kind
    }

    /// Returns what the figure shows. What blocks could show as colours in the last version is a kind of its own.
    fn view(&self) -> View {
        let is_moved = matches!(self.options.fill, Fill::Stress | Fill::Friction);
        if is_moved && self.kind.kind == Kind::Forces { Kind::Joints.into() } else { self.kind }
    }

    /// Returns what to write instead of names of the last version.
    #[cfg(any(feature = "cli", feature = "python"))]
    pub(crate) fn note(&self) -> Option<String> {
        let is_moved = matches!(self.options.fill, Fill::Stress | Fill::Friction);
        let fill = is_moved.then(|| {
            let fill = self.options.fill.word();
            format!("--fill {fill} is now --kind joints; the next version does not know the old name")
        });
        self.kind.note().or(fill)
    }

    /// Refuses options that do not fit the kind of figure.
    pub(crate) fn check(&self) -> Result<(), String> {
        let is_freebody = self.kind() == Kind::Freebody;
        if self.block.is_some() && !is_freebody {
            return Err("--block names the block of a free-body diagram; add --kind freebody".into());
        }
        if self.ask.removable && self.kind() != Kind::Structure {
            return Err("--removable shows which blocks may leave a structure; add --kind structure".into());
        }
        if self.ask.capacity.capacity.is_some() && !self.kind().needs_capacity() {
            return Err("--capacity selects the block of a capacity figure; add --kind capacity".into());
        }
        if self.ask.sensitivity.is_some() && !self.kind().needs_sensitivity() {
            return Err("--sensitivity selects the margin of a figure; add --kind sensitivity".into());
        }
        if self.options.corners == figure::Corners::All && !is_freebody {
            return Err("--corners applies to the forces of a free-body diagram; add --kind freebody".into());
        }
        Ok(())
    }

    /// Returns what a user asks about a scene for its figure.
    fn ask(&self, scene: &Scene) -> Result<Ask, String> {
        let mut ask = self.ask.of(scene)?;
        ask.removable |= self.view().needs_removable();
        if self.kind().needs_sensitivity() {
            ask.sensitivity = self.margin.map(|margin| margin.0).or(ask.sensitivity);
        }
        Ok(ask)
    }

    /// Analyses a scene for its figure: asks for the answers that the figure shows, too.
    pub(crate) fn analysed(&self, scene: &Scene, options: analysis::Options) -> Result<Analysis, String> {
        Ok(self.kind().analysed(scene, options.also(self.ask(scene)?), &self.shown()))
    }

    /// Returns an analysis with all answers that the figure shows: the given one, or a new one of the same scene if it
    /// was not asked for some.
    #[cfg(any(feature = "python", feature = "wasm"))]
    pub(crate) fn completed(&self, analysis: &Analysis) -> Result<Analysis, String> {
        let (scene, options) = (analysis.given(), analysis.options());
        let ask = self.kind().asks(scene, options.ask.and(self.ask(scene)?), &self.shown());
        if options.ask.covers(ask) {
            return Ok(analysis.clone());
        }
        self.analysed(scene, analysis::Options { deadline: None, verdict_only: false, ..*options })
    }

    /// Returns the options of the figure of a scene, in a theme and on a page of this width in pixels.
    pub(crate) fn options(&self, theme: Theme, width: Option<f64>) -> Result<figure::Options, String> {
        if self.options.at.is_some() && self.kind() != Kind::Mechanism {
            return Err("--at selects the motion of a figure; add --kind mechanism".into());
        }
        if self.kind() == Kind::Mechanism && self.shown().at == Some(At::Margin(MarginKind::Kernel)) {
            return Err("no motion belongs to the margin kernel; use --kind joints or --kind sensitivity".into());
        }
        Ok(figure::Options { theme, width, ..self.shown() })
    }

    /// Returns the options with what the view and the margin ask for.
    fn shown(&self) -> figure::Options {
        let margin = self.margin.map(|margin| margin.0);
        let central = margin == Some(MarginKind::Kernel);
        let at = self.options.at.or(margin.map(At::Margin).filter(|_| self.kind() == Kind::Mechanism));
        self.view().options(&figure::Options { at, central, ..self.options.clone() })
    }

    /// Returns the options with the blocks that the options `zoom` and `block` name.
    pub(crate) fn for_scene(&self, options: &figure::Options, scene: &Scene) -> Result<figure::Options, String> {
        let zoom = self.zoom.as_deref().map(|name| figure::named_block(scene, name)).transpose()?;
        let shows_one = self.kind().shows_one_block();
        if !shows_one {
            figure::check_panels(scene, "choose one with --frame")?;
        }
        let block = shows_one.then(|| figure::free_block(scene, self.block.as_deref())).transpose()?;
        Ok(figure::Options { zoom, block, ..options.clone() })
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_command_has_one_end_and_each_analysis_of_an_option_in_json_its_own() {
        let level = read_json(Some(r#"{ "time_limit": 0.5 }"#), AnalysisArgs::read).expect("options");
        let ends = |level: &AnalysisArgs| {
            let first = level.options().deadline;
            std::thread::sleep(Duration::from_millis(2));
            first < level.options().deadline
        };
        assert!(ends(&level));
        #[cfg(feature = "cli")]
        assert!(!ends(&level.started()));
    }

    #[test]
    fn all_problems_of_a_json_request_are_reported_at_once_with_their_keys() {
        let text = r#"{ "knid": "flow", "fill": "stres", "columns": 0, "time_limit": -1, "margin": "robots" }"#;
        let problems = read_json(Some(text), FigureArgs::read).expect_err("five problems");
        let keys: Vec<&str> = problems.lines().filter(|line| !line.starts_with("  help")).collect();
        assert_eq!(keys.len(), 5, "{problems}");
        for (line, words) in keys.iter().zip(["knid: unknown key", "fill: ", "columns: ", "time_limit: ", "margin: "]) {
            assert!(line.starts_with(words), "{problems}");
        }
        assert!(problems.contains("did you mean \"stress\"?") && problems.contains("`kind`"), "{problems}");
    }

    #[test]
    fn a_json_request_has_the_defaults_and_the_values_of_the_command_line() {
        let empty = read_json(Some("{}"), FigureArgs::read).expect("defaults");
        assert_eq!((empty.options, empty.kind), (figure::Options::default(), View::default()));
        let text = r#"{ "no_title": true, "width": null, "margin": "load_factor", "kind": "freebody" }"#;
        let wrong = read_json(Some(text), FigureArgs::read).expect_err("a figure has no key width of its own");
        assert!(wrong.starts_with("width: unknown key"), "{wrong}");
        let made = read_json(Some(&text.replace("\"width\": null, ", "")), FigureArgs::read).expect("a request");
        assert!(!made.options.titles && made.options.captions && made.kind() == Kind::Freebody);
        assert_eq!(made.margin.map(|margin| margin.0), Some(MarginKind::LoadFactor));
    }

    #[test]
    fn messages_have_the_names_of_json() {
        assert_eq!(in_json("--for-all: 3 is no range; add --capacity"), "for_all: 3 is no range; add capacity");
    }
}
