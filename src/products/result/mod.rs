//! [`to_json`]: writes an analysis as a JSON object for other programs.
//!
//! Invariant: the same analysis always produces the same bytes, apart from times, which [`Timing::LeftOut`] omits.
//! Numbers are written as the shortest decimal that reads back as the same f64, and never as −0. A number that could
//! not be computed is `null`; this happens only in `undecided` frames. `unsupported`, `notices` and `doubt` are absent
//! if they are empty. `margins` and `only_by_wedging` are absent if they were not requested. `only_by_wedging` is also
//! absent if the frame does not stand.
//!
//! serde is used here and in `scene::format`. That module reads files that people write, and this module writes
//! results for programs. The two modules therefore change for different reasons.

#[cfg(feature = "report")]
mod accuracy;
mod capacity;
mod cases;
mod force;
#[cfg(feature = "import")]
mod import;
#[doc(hidden)]
pub mod key;
mod line;
mod margin;
mod movement;
mod refusal;
mod placement;
mod reach;
mod removable;
mod sensitivity;
mod vehicle;
mod wedging;

use std::io;

use serde::{Serialize, Serializer};

#[cfg(feature = "report")]
pub use accuracy::accuracy_json;
use capacity::Capacity;
pub use capacity::capacity_json;
use cases::{Case, Envelope};
use force::{Interface, Missing, Motion, Robot};
#[cfg(feature = "import")]
pub use import::import_json;
#[cfg(feature = "wasm")]
pub(crate) use import::imported_json;
pub use key::schema;
pub use line::{Fields, Origin, PictureOutcome, UnknownField, line_of, verdict_line};
use margin::Margins;
pub use margin::margins_json;
use movement::Movement;
use placement::Placement;
use reach::Reach;
pub use refusal::{problem_line, refusal};
#[cfg(feature = "wasm")]
pub(crate) use refusal::{problem_list, remark_list};
use removable::Removable;
use sensitivity::Sensitivity;
use vehicle::Vehicle;
use wedging::Wedging;

use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Analysis, EffectName, FrameAnalysis, Proof, SolveReport, Stages};
use crate::mechanics::scene::format::Lines;
use crate::mechanics::scene::{BlockId, Note, Scene, ToleranceSource};
pub use crate::products::wording::verdict::word;
use crate::text;

/// Whether a result contains solving times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// `solve.seconds` and `solve.stages` are present. They differ from run to run.
    Included,
    /// `solve.seconds` and `solve.stages` are absent. The same scene then always produces the same bytes.
    LeftOut,
}

/// The white space in a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One line per property, and one per interface, robot or failure. Ends with a line feed.
    Lines,
    /// Everything on one line, as JSON Lines requires. Ends with a line feed.
    OneLine,
}

/// Writes the result of an analysis as one JSON object.
///
/// Forces act on `bodies[0]`, `normal` points into `bodies[0]`, and `"ground"` names the ground. The `amount` of a
/// failure is the magnitude of the missing force in newtons. For a robot it is `|F_x| + |F_y|`, because the limits of
/// a robot are per component. For a missing torque, it is the magnitude of the torque in N·m.
///
/// # Units
/// Metres, newtons and N·m. A spin is in 1/m, because all velocities are divided by the speed of the fastest point.
///
/// # Example
/// ```
/// use drystone::analysis::Analysis;
/// use drystone::result::{Layout, Timing, to_json};
/// use drystone::scene::Scene;
///
/// let scene = Scene::from_json(
///     r#"{ "drystone": 1, "blocks": [{ "id": "a", "polygon": [[0, 0], [3, 0], [0, 2]] }] }"#)?;
/// let json = to_json(&Analysis::new(&scene), Timing::LeftOut, Layout::OneLine);
/// assert!(json.contains(r#""verdict":"unstable""#), "nothing holds it");
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn to_json(analysis: &Analysis, timing: Timing, layout: Layout) -> String {
    whole(None, analysis, false, timing, layout)
}

/// Like [`to_json`], with the path of the scene file under the key `file`.
pub fn to_json_of(file: &str, analysis: &Analysis, timing: Timing, layout: Layout) -> String {
    whole(Some(file), analysis, false, timing, layout)
}

/// Like [`to_json`], with the placed blocks of each frame under the key `frames[].blocks`. If `file` is given, the
/// result also has the path of the scene file.
pub fn to_json_with_blocks(file: Option<&str>, analysis: &Analysis, timing: Timing, layout: Layout) -> String {
    whole(file, analysis, true, timing, layout)
}

fn whole(file: Option<&str>, analysis: &Analysis, blocks: bool, timing: Timing, layout: Layout) -> String {
    let mut bytes = Vec::new();
    write_json(&mut bytes, file, analysis, blocks, timing, layout).expect("writing into memory succeeds");
    String::from_utf8(bytes).expect("serde_json writes UTF-8")
}

/// Writes the text of [`to_json`], or with `blocks` that of [`to_json_with_blocks`], one frame after the other.
pub(crate) fn write_json(
    out: &mut dyn io::Write,
    file: Option<&str>,
    analysis: &Analysis,
    blocks: bool,
    timing: Timing,
    layout: Layout,
) -> io::Result<()> {
    let mut result = Result::new(analysis, timing);
    (result.file, result.frames.has_blocks) = (file, blocks);
    write(out, &result, layout, 2)
}

/// Writes a value as JSON that ends with a line feed. With [`Layout::Lines`], objects that are nested deeper than `depth`
/// are written on one line.
fn written(value: &impl Serialize, layout: Layout, depth: usize) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes, value, layout, depth).expect("plain structures with text keys always serialise into memory");
    String::from_utf8(bytes).expect("serde_json writes UTF-8")
}

/// Writes a value like [`written`].
fn write(out: &mut dyn io::Write, value: &impl Serialize, layout: Layout, depth: usize) -> io::Result<()> {
    let mut out = Escaping(out);
    match layout {
        Layout::Lines => value.serialize(&mut serde_json::Serializer::with_formatter(&mut out, Lines::new(depth)))?,
        Layout::OneLine => serde_json::to_writer(&mut out, value)?,
    }
    out.0.write_all(b"\n")
}

/// Replaces the characters of JSON that a terminal would interpret.
struct Escaping<'w>(&'w mut dyn io::Write);

impl io::Write for Escaping<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // serde_json writes pieces of text that divide no character.
        let piece = std::str::from_utf8(bytes).map_err(io::Error::other)?;
        self.0.write_all(text::json(piece).as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Writes a value as JSON on one line, without a line feed.
fn compact(value: &(impl Serialize + ?Sized)) -> String {
    text::json(
        serde_json::to_string(value).expect("plain structures with text keys always serialise into memory").as_str(),
    )
    .into_owned()
}

#[derive(Serialize)]
struct Result<'a> {
    drystone: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<&'a str>,
    scene: &'a str,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    set: &'a [String],
    contact_tolerance: Tolerance,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<NoteEntry<'a>>,
    frames: Frames<'a>,
}

/// The frames of a result. Each is made when it is written, so that a result with many frames needs little memory.
struct Frames<'a> {
    analysis: &'a Analysis,
    timing: Timing,
    has_blocks: bool,
}

impl Serialize for Frames<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let scene = &self.analysis.scene;
        let steps = scene.frames.iter().zip(&self.analysis.frames).enumerate();
        serializer.collect_seq(steps.map(|(number, (step, frame))| {
            let mut frame = Frame::new(self.analysis.scene_of(number), &step.title, frame, self.timing);
            frame.blocks = self.has_blocks.then(|| step.placed.iter().map(|id| Block::new(scene, *id)).collect());
            frame
        }))
    }
}

/// The distances within which edges touch and are merged, in metres, the source of these distances, and the corners
/// that were moved.
#[derive(Serialize)]
struct Tolerance {
    gap: Number,
    from: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    digits: Option<usize>,
    healed_within: Number,
    moved_corners: usize,
    largest_move: Number,
}

/// Returns `least`, which is true if the total force is proved to be the least possible. If it is true, serde leaves
/// out the key.
fn is_least(least: &bool) -> bool {
    *least
}

#[derive(Serialize)]
struct Frame<'a> {
    title: &'a str,
    verdict: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    doubt: String,
    length: Number,
    total_force: Number,
    #[serde(skip_serializing_if = "is_least")]
    total_force_least: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    total_force_bound: Option<Number>,
    total_sticking: Number,
    weight: Number,
    /// Only present on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    blocks: Option<Vec<Block<'a>>>,
    interfaces: Vec<Interface<'a>>,
    robots: Vec<Robot<'a>>,
    failures: Vec<Missing<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unsupported: Vec<&'a str>,
    mechanism: Vec<Motion<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    margins: Option<Margins<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sensitivity: Option<Sensitivity<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    placement: Option<Placement<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    cases: Vec<Case<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    governing_case: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    envelope: Vec<Envelope>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    movements: Vec<Movement<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    removable: Option<Vec<Removable<'a>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reach: Option<Reach<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vehicle: Option<Vehicle<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    capacity: Option<Capacity<'a>>,
    /// `Some(None)`, written as `null`, if it was requested but could not be decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    only_by_wedging: Option<Option<bool>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wedging: Option<Wedging<'a>>,
    effects: Vec<Effect<'a>>,
    proof: ProofNumbers,
    solve: Solve,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notices: &'a [String],
}

#[derive(Serialize)]
struct Effect<'a> {
    effect: &'static str,
    simulated: bool,
    why: &'a str,
    unknowns: usize,
}

/// A number for JSON: −0 is written as 0.0, and a number that is not finite as `null`.
#[derive(Clone, Copy)]
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        // Adding 0 turns −0 into 0 and does not change any other number.
        serializer.serialize_f64(self.0 + 0.0)
    }
}

type Pair = [Number; 2];

/// Returns the coordinates of a point in metres.
fn place(p: Point) -> Pair {
    [Number(p.x), Number(p.y)]
}

/// Returns the components of a force, a direction or a velocity.
fn arrow(v: Vector) -> Pair {
    [Number(v.x), Number(v.y)]
}

impl<'a> Result<'a> {
    fn new(analysis: &'a Analysis, timing: Timing) -> Result<'a> {
        let scene = &analysis.scene;
        Result {
            drystone: env!("CARGO_PKG_VERSION"),
            file: None,
            scene: &scene.title,
            set: &scene.set,
            contact_tolerance: Tolerance::new(scene),
            notes: analysis.notes.iter().map(NoteEntry::new).collect(),
            frames: Frames { analysis, timing, has_blocks: false },
        }
    }
}

impl Tolerance {
    fn new(scene: &Scene) -> Tolerance {
        let (from, digits) = match scene.healed.source {
            ToleranceSource::Lattice => ("lattice", None),
            ToleranceSource::Given => ("given", None),
            ToleranceSource::Decimals(k) => ("decimals", Some(k)),
            ToleranceSource::Digits(n) => ("significant_digits", Some(n)),
            ToleranceSource::Float32 => ("float32", None),
            ToleranceSource::Size => ("size", None),
            ToleranceSource::Noise => ("noise", None),
        };
        Tolerance {
            gap: Number(scene.tolerance.gap),
            from,
            digits,
            healed_within: Number(scene.healed.within),
            moved_corners: scene.healed.corners,
            largest_move: Number(scene.healed.distance),
        }
    }
}

impl<'a> Frame<'a> {
    fn new(scene: &'a Scene, title: &'a str, frame: &'a FrameAnalysis, timing: Timing) -> Frame<'a> {
        let block = |id: BlockId| scene.blocks[id.0].id.as_str();
        let cases = frame.cases.as_ref();
        Frame {
            title,
            verdict: word(frame.verdict),
            doubt: frame.doubt(),
            length: Number(frame.length),
            total_force: Number(frame.total_force),
            total_force_least: frame.least_force,
            total_force_bound: frame.force_bound.map(Number),
            total_sticking: Number(frame.total_sticking),
            weight: Number(frame.weight),
            blocks: None,
            interfaces: frame.contacts.iter().map(|c| Interface::new(scene, c)).collect(),
            robots: frame.robots.iter().map(|r| Robot::new(scene, r)).collect(),
            failures: frame.failures.iter().map(|f| Missing::new(scene, f)).collect(),
            unsupported: frame.unsupported.iter().map(|id| block(*id)).collect(),
            mechanism: frame.mechanism.iter().map(|m| Motion::new(scene, m)).collect(),
            margins: frame.margins.as_ref().map(|m| Margins::new(scene, m)),
            sensitivity: (frame.sensitivity.as_ref()).map(|s| Sensitivity::new(scene, frame, s)),
            placement: frame.placement.as_ref().map(|p| Placement::new(scene, p)),
            cases: cases.iter().flat_map(|cases| &cases.each).map(Case::new).collect(),
            governing_case: cases.map(|cases| cases.each[cases.governing].id.as_str()),
            envelope: cases.iter().flat_map(|cases| cases.envelope.iter().enumerate()).map(Envelope::new).collect(),
            movements: frame.movements.iter().map(|m| Movement::new(scene, m)).collect(),
            removable: frame.removable.as_ref().map(|rows| Removable::list(scene, rows)),
            reach: frame.reach.as_ref().map(|found| Reach::new(scene, found)),
            vehicle: frame.vehicle.as_ref().map(|influence| Vehicle::new(scene, influence)),
            capacity: frame.capacity.as_ref().map(|c| Capacity::new(scene, c)),
            only_by_wedging: is_simulated(frame, EffectName::Wedging).then_some(frame.only_by_wedging),
            wedging: (frame.wedged.as_ref()).map(|w| Wedging::new(scene, frame, w)),
            effects: frame
                .effects
                .iter()
                .map(|e| Effect { effect: e.effect.word(), simulated: e.simulated, why: &e.why, unknowns: e.unknowns })
                .collect(),
            proof: ProofNumbers::new(frame.proof, frame.exact),
            solve: Solve::new(&frame.solve, timing),
            notices: &frame.notices,
        }
    }
}

/// A placed block, which the result contains on request.
#[derive(Serialize)]
struct Block<'a> {
    id: &'a str,
    centre: Pair,
    area: Number,
    weight: Number,
    vertices: Vec<Pair>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    holes: Vec<Vec<Pair>>,
}

impl<'a> Block<'a> {
    fn new(scene: &'a Scene, id: BlockId) -> Block<'a> {
        let block = &scene.blocks[id.0];
        let ring = |corners: &[Point]| corners.iter().map(|p| place(*p)).collect();
        let polygon = &block.body.polygon;
        Block {
            id: &block.id,
            centre: place(block.centroid),
            area: Number(polygon.area()),
            weight: Number(block.weight),
            vertices: ring(polygon.outline()),
            holes: polygon.holes().iter().map(|hole| ring(hole)).collect(),
        }
    }
}

/// A note of an analysis.
#[derive(Serialize)]
struct NoteEntry<'a> {
    code: &'static str,
    path: &'a str,
    line: Option<usize>,
    message: &'a str,
    hint: &'a str,
}

impl<'a> NoteEntry<'a> {
    fn new(note: &'a Note) -> NoteEntry<'a> {
        NoteEntry {
            code: note.code.word(),
            path: &note.path,
            line: (note.line > 0).then_some(note.line),
            message: &note.message,
            hint: &note.hint,
        }
    }
}

/// The numbers of a proof.
#[derive(Serialize)]
#[serde(untagged)]
enum ProofNumbers {
    Forces {
        worst_imbalance: Number,
        worst_share: Number,
        worst_pull: Number,
        worst_slip: Number,
        #[serde(skip_serializing_if = "Option::is_none")]
        exact: Option<bool>,
    },
    Mechanism {
        power: Number,
        worst_violation: Number,
        no_balance_below: BalanceBound,
        #[serde(skip_serializing_if = "Option::is_none")]
        exact: Option<bool>,
    },
}

/// The sum of forces, relative to the loads of the moving blocks, below which no forces balance. `"unbounded"` if no
/// forces balance at all.
#[derive(Serialize)]
#[serde(untagged)]
enum BalanceBound {
    Sum(Number),
    Unbounded(&'static str),
}

impl ProofNumbers {
    fn new(proof: Proof, exact: Option<bool>) -> ProofNumbers {
        match proof {
            Proof::Forces { worst_imbalance, worst_share, worst_pull, worst_slip } => ProofNumbers::Forces {
                worst_imbalance: Number(worst_imbalance),
                worst_share: Number(worst_share),
                worst_pull: Number(worst_pull),
                worst_slip: Number(worst_slip),
                exact,
            },
            Proof::Mechanism { power, worst_violation } => ProofNumbers::Mechanism {
                power: Number(power),
                worst_violation: Number(worst_violation),
                no_balance_below: match proof.excluded_force_sum() {
                    sum if sum.is_finite() => BalanceBound::Sum(Number(sum)),
                    _ => BalanceBound::Unbounded("unbounded"),
                },
                exact,
            },
        }
    }
}

/// The method that decided a frame, its iterations and its time.
#[derive(Serialize)]
struct Solve {
    method: &'static str,
    iterations: usize,
    programs: usize,
    groups: usize,
    reused: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stages: Option<StageSeconds>,
}

#[derive(Serialize)]
struct StageSeconds {
    assembly: Number,
    solution: Number,
    wedging: Number,
    margins: Number,
    #[serde(skip_serializing_if = "Option::is_none")]
    placement: Option<Number>,
}

impl Solve {
    fn new(solve: &SolveReport, timing: Timing) -> Solve {
        let timed = timing == Timing::Included;
        let of = |stages: Stages| StageSeconds {
            assembly: Number(stages.assembly),
            solution: Number(stages.solution),
            wedging: Number(stages.wedging),
            margins: Number(stages.margins),
            placement: (stages.placement > 0.0).then_some(Number(stages.placement)),
        };
        Solve {
            method: solve.method.name(),
            iterations: solve.iterations,
            programs: solve.programs,
            groups: solve.groups,
            reused: solve.reused,
            seconds: timed.then_some(Number(solve.seconds)),
            stages: timed.then(|| of(solve.stages)),
        }
    }
}

/// True if the analysis simulated this effect in the frame.
fn is_simulated(frame: &FrameAnalysis, effect: EffectName) -> bool {
    frame.effects.iter().any(|e| e.effect == effect && e.simulated)
}

/// The number of scenes with each verdict in a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Scenes in which every step stands.
    pub stable: usize,
    /// Scenes in which at least one step falls.
    pub unstable: usize,
    /// Scenes in which no step falls and at least one is undecided.
    pub undecided: usize,
    /// Files that are not valid scenes.
    pub refused: usize,
}

/// Writes text as a JSON string, with its quotation marks.
pub fn quoted(words: &str) -> String {
    compact(words)
}

/// Writes a report as one JSON object that ends with a line feed. The object has the counts and a list of the scenes.
/// `list` is the key of this list. `objects` has the entries of the list as JSON, one for each scene, and each entry is
/// written on a line of its own.
///
/// ```
/// use drystone::result::{Counts, report_json};
/// let json = report_json(Counts { stable: 1, ..Counts::default() }, "scenes", &["{\"scene\":\"a\"}".into()]);
/// assert!(json.contains("\"stable\":1") && json.ends_with("\n]}\n"));
/// ```
pub fn report_json(counts: Counts, list: &str, objects: &[String]) -> String {
    let summary = compact(&counts);
    let objects: Vec<&str> = objects.iter().map(|o| o.trim_end()).collect();
    format!(
        "{{\"drystone\":{},\"summary\":{summary},{}:[\n{}\n]}}\n",
        quoted(env!("CARGO_PKG_VERSION")),
        quoted(list),
        objects.join(",\n")
    )
}

#[cfg(test)]
mod tests;
