//! [`KEYS`]: every key of a result with its kind, unit and meaning, and the JSON Schema made from them.
//!
//! A test walks the results of many scenes and fails where a key is missing here, or where one here never occurs.

use serde_json::{Value, json};

use crate::scene::Code;

/// What stands behind a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// Any text.
    Text,
    /// One of these words.
    Word(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
    /// `true`, `false`, or `null` where it stays open.
    FlagOrOpen,
    /// A whole number, at least 0.
    Count,
    /// A whole number from 1, or `null` where there is no text to count in.
    Place,
    /// A number; `null` where it could not be computed, which happens in undecided frames only.
    Number,
    /// A number, or `"unbounded"`.
    Bound,
    /// A number, `null` where no value will do, or `"unbounded"` where any will.
    Margin,
    /// Two ends, `[low, high]`: each a number, `null` without end or `"withheld"`; `null` where the interval is empty.
    Interval,
    /// Two lists of motions, beyond the lower and beyond the upper end.
    MotionPairs,
    /// A point or vector, `[x, y]`.
    Pair,
    /// Two points, `[[x, y], [x, y]]`.
    Pairs,
    /// Two names.
    Names,
    /// A list of names.
    NameList,
    /// A list of `{ "block", "velocity", "spin" }`: how blocks move.
    Motions,
    /// An object.
    Object,
    /// A list of objects.
    Objects,
    /// An object with a key for each robot, by its name.
    ByRobot,
}

/// A key of a result.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Where it stands: `frames[].robots[].force`; `*` is any robot's name.
    pub path: &'static str,
    /// What stands behind it.
    pub kind: Type,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// When it is there; empty for always.
    pub when: &'static str,
    /// What it means.
    pub meaning: &'static str,
}

const fn key(
    path: &'static str,
    kind: Type,
    unit: &'static str,
    when: &'static str,
    meaning: &'static str,
) -> Key {
    Key {
        path,
        kind,
        unit,
        when,
        meaning,
    }
}

const ASKED: &str = "with `--margins`";
/// Present only if this margin was requested; without names all are.
const NAMED: &str = "where asked for";

/// Every key of a result, in the order in which a result has them.
#[rustfmt::skip]
pub const KEYS: &[Key] = &[
    key("drystone", Type::Text, "", "", "version of the program"),
    key("file", Type::Text, "", "from the command line", "the path as given, with the file's name where that is a folder; `-` for standard input"),
    key("scene", Type::Text, "", "", "the scene's title; empty where it has none"),
    key("contact_tolerance", Type::Object, "", "", "how close is close, and what was moved within it"),
    key("contact_tolerance.gap", Type::Number, "m", "", "edges this close touch; 0 on a lattice"),
    key("contact_tolerance.from", Type::Word(&["lattice", "given", "decimals", "significant_digits", "float32", "size", "noise"]), "", "", "where it comes from: the lattice is exact, it was given, or it was estimated from how coordinates are written or from the scene's size"),
    key("contact_tolerance.digits", Type::Count, "", "from decimals or digits", "how many digits the coordinates have"),
    key("contact_tolerance.healed_within", Type::Number, "m", "", "corners and edges this close were made one"),
    key("contact_tolerance.moved_corners", Type::Count, "", "", "how many corners that moved"),
    key("contact_tolerance.largest_move", Type::Number, "m", "", "how far the farthest moved"),
    key("notes", Type::Objects, "", "where there are some, unless `--no-notes`", "what is allowed in the scene and seldom meant"),
    key("notes[].code", Type::Text, "", "", "what sort of note, a stable word; see the list"),
    key("notes[].path", Type::Text, "", "", "where in the scene, as `robots[0].at`"),
    key("notes[].line", Type::Place, "", "", "line in the text, from 1; null where there is none"),
    key("notes[].message", Type::Text, "", "", "what was found"),
    key("notes[].hint", Type::Text, "", "", "what to do about it, and how to silence it"),
    key("frames", Type::Objects, "", "", "one for each step; one for a scene without steps"),
    key("frames[].title", Type::Text, "", "", "the step's title; empty where it has none"),
    key("frames[].verdict", Type::Word(&["stable", "unstable", "undecided"]), "", "", "a balance of forces exists; a motion exists that nothing stops; neither is proved"),
    key("frames[].doubt", Type::Text, "", "where there is one", "why the frame is undecided"),
    key("frames[].length", Type::Number, "m", "", "the length L by which torques are weighed against forces in the sums: the median length of the frame's interfaces, corner contacts apart (of two in the middle the shorter); without any the square root of the median block's area, and 1 in an empty frame"),
    key("frames[].total_force", Type::Number, "N", "", "sum of the amounts of all forces, Σ(N₁ + N₂ + \\|T\\|) + Σ(\\|Fx\\| + \\|Fy\\| + \\|M\\|/L)"),
    key("frames[].total_force_least", Type::Flag, "", "where `false`", "whether that sum is the least possible"),
    key("frames[].total_force_bound", Type::Number, "N", "where it stands and was shown", "a sum that no balance can do without, from a motion that bounds it"),
    key("frames[].total_sticking", Type::Number, "N", "", "the same sum over what would have to stick, the `failures`; 0 where stable, but also where nothing that sticks would help (`unsupported`) and where it was not sought (`--verdict-only`)"),
    key("frames[].weight", Type::Number, "N", "", "weight of all blocks placed, whether they stand or not"),
    key("frames[].interfaces", Type::Objects, "", "", "where bodies touch; forces are those on `bodies[0]`"),
    key("frames[].interfaces[].bodies", Type::Names, "", "", "who touches; `ground` is the ground"),
    key("frames[].interfaces[].kind", Type::Word(&["corner"]), "", "at corner contacts", "a tip that touches an edge or a tip"),
    key("frames[].interfaces[].ends", Type::Pairs, "m", "", "the ends of the stretch"),
    key("frames[].interfaces[].application_points", Type::Pairs, "m", "", "where its two normal forces act: the ends, moved inward by the kernel"),
    key("frames[].interfaces[].normal", Type::Pair, "", "", "unit vector into `bodies[0]`"),
    key("frames[].interfaces[].mu", Type::Number, "", "", "friction coefficient"),
    key("frames[].interfaces[].normal_forces", Type::Pair, "N", "", "the two normal forces, at least 0"),
    key("frames[].interfaces[].friction_force", Type::Number, "N", "", "along (−n_y, n_x), n the normal"),
    key("frames[].interfaces[].resultant", Type::Object, "", "", "the force of the whole interface"),
    key("frames[].interfaces[].resultant.at", Type::Pair, "m", "", "where it acts"),
    key("frames[].interfaces[].resultant.force", Type::Pair, "N", "", "the force"),
    key("frames[].interfaces[].friction_used", Type::Number, "", "", "share of the available friction that is used, 0 to 1, and 0 without friction; where it falls, in the balance that the missing forces complete"),
    key("frames[].robots", Type::Objects, "", "", "robots that hold a block in this frame, in the scene's order"),
    key("frames[].robots[].id", Type::Text, "", "", "the robot"),
    key("frames[].robots[].holds", Type::Text, "", "", "the block it holds"),
    key("frames[].robots[].at", Type::Pair, "m", "", "its grip point"),
    key("frames[].robots[].force", Type::Pair, "N", "", "its force on the block"),
    key("frames[].robots[].torque", Type::Number, "N·m", "", "its torque on the block, anticlockwise positive"),
    key("frames[].robots[].limit_used", Type::Number, "", "", "largest share of a limit that is used, 0 to 1, and 0 where there is none or nothing may be given; where it falls, in the balance that the missing forces complete"),
    key("frames[].failures", Type::Objects, "", "", "what would have to stick; empty where stable, and of what is `unsupported`"),
    key("frames[].failures[].kind", Type::Word(&["tension", "friction", "robot_force", "robot_torque"]), "", "", "a contact pulled open, one that slides, a robot's missing force or torque"),
    key("frames[].failures[].bodies", Type::Names, "", "at contacts", "between whom"),
    key("frames[].failures[].robot", Type::Text, "", "at robots", "which robot"),
    key("frames[].failures[].holds", Type::Text, "", "at robots", "the block it holds"),
    key("frames[].failures[].at", Type::Pair, "m", "", "where"),
    key("frames[].failures[].force", Type::Pair, "N", "unless a torque is missing", "the missing force, on `bodies[0]` or on the block"),
    key("frames[].failures[].torque", Type::Number, "N·m", "where a torque is missing", "the missing torque"),
    key("frames[].failures[].amount", Type::Number, "N or N·m", "", "how much is missing: the force's amount, \\|Fx\\| + \\|Fy\\| of a robot, N·m for a torque"),
    key("frames[].unsupported", Type::NameList, "", "where there are some", "blocks that no sticking at the contacts and grips could hold"),
    key("frames[].mechanism", Type::Motions, "", "", "how the blocks that move begin to; empty where stable"),
    key("frames[].margins", Type::Object, "", ASKED, "how far the frame is from its edge; a margin is null where no value will do or none was confirmed, which a notice says"),
    key("frames[].margins.friction", Type::Margin, "", NAMED, "least friction coefficient, the same everywhere, at which it stands"),
    key("frames[].margins.tilt", Type::Object, "", NAMED, "largest turn of gravity at which it still stands; null where it falls unturned"),
    key("frames[].margins.tilt.left", Type::Margin, "°", "", "gravity's tip moves to the left"),
    key("frames[].margins.tilt.right", Type::Margin, "°", "", "gravity's tip moves to the right"),
    key("frames[].margins.horizontal_load", Type::Object, "", NAMED, "largest horizontal share of all weights"),
    key("frames[].margins.horizontal_load.left", Type::Margin, "", "", "to the left"),
    key("frames[].margins.horizontal_load.right", Type::Margin, "", "", "to the right"),
    key("frames[].margins.kernel", Type::Margin, "", NAMED, "largest kernel"),
    key("frames[].margins.load_factor", Type::Margin, "", NAMED, "largest factor on the loads; null also without loads"),
    key("frames[].margins.robots", Type::ByRobot, "", "", "least limits of each robot that holds a block, by its name; empty where they are not asked for"),
    key("frames[].margins.robots.*.fx", Type::Margin, "N", "", "least limit of its horizontal force"),
    key("frames[].margins.robots.*.fy", Type::Margin, "N", "", "least limit of its vertical force"),
    key("frames[].margins.robots.*.torque", Type::Margin, "N·m", "", "least limit of its torque"),
    key("frames[].margins.intervals", Type::Object, "", "", "the values of each parameter at which the frame stands, all other things as they are; `null` at an end: without end; `null` for an interval: it stands at no value; `\"withheld\"`: no verdict confirms it, and a notice says why"),
    key("frames[].margins.intervals.friction", Type::Interval, "", NAMED, "one friction coefficient for every interface, from 0 to 1000"),
    key("frames[].margins.intervals.tilt", Type::Interval, "°", NAMED, "turn of gravity, negative to the left; loads do not turn"),
    key("frames[].margins.intervals.horizontal_load", Type::Interval, "", NAMED, "share of all weights that acts across gravity, negative to the left"),
    key("frames[].margins.intervals.kernel", Type::Interval, "", NAMED, "kernel, from 0 to 1; no upper end where it stands at 1"),
    key("frames[].margins.intervals.load_factor", Type::Interval, "", "where asked for and there are loads", "factor on the loads, at least 0; 1 is as they are listed"),
    key("frames[].margins.intervals.robots", Type::ByRobot, "", "where asked for and robots hold blocks", "limits of each robot, each alone, by its name"),
    key("frames[].margins.intervals.robots.*.fx", Type::Interval, "N", "", "limit of its horizontal force"),
    key("frames[].margins.intervals.robots.*.fy", Type::Interval, "N", "", "limit of its vertical force"),
    key("frames[].margins.intervals.robots.*.torque", Type::Interval, "N·m", "", "limit of its torque"),
    key("frames[].margins.notes", Type::NameList, "", "where there are some", "what must be known about an interval, a sentence each"),
    key("frames[].margins.mechanisms", Type::Object, "", "", "how the blocks begin to move just beyond each margin; empty beyond what has no end or is null"),
    key("frames[].margins.mechanisms.friction", Type::Motions, "", "", "beyond the friction margin"),
    key("frames[].margins.mechanisms.tilt", Type::Object, "", "", "beyond the tilts"),
    key("frames[].margins.mechanisms.tilt.left", Type::Motions, "", "", "to the left"),
    key("frames[].margins.mechanisms.tilt.right", Type::Motions, "", "", "to the right"),
    key("frames[].margins.mechanisms.horizontal_load", Type::Object, "", "", "beyond the horizontal loads"),
    key("frames[].margins.mechanisms.horizontal_load.left", Type::Motions, "", "", "to the left"),
    key("frames[].margins.mechanisms.horizontal_load.right", Type::Motions, "", "", "to the right"),
    key("frames[].margins.mechanisms.kernel", Type::Motions, "", "", "beyond the largest kernel"),
    key("frames[].margins.mechanisms.load_factor", Type::Motions, "", "", "beyond the largest factor on the loads"),
    key("frames[].margins.mechanisms.robots", Type::ByRobot, "", "", "below each robot's least limits, by its name"),
    key("frames[].margins.mechanisms.robots.*.fx", Type::Motions, "", "", "below its least horizontal limit"),
    key("frames[].margins.mechanisms.robots.*.fy", Type::Motions, "", "", "below its least vertical limit"),
    key("frames[].margins.mechanisms.robots.*.torque", Type::Motions, "", "", "below its least limit of torque"),
    key("frames[].margins.mechanisms.intervals", Type::Object, "", "", "how the blocks begin to move beyond both ends of an interval"),
    key("frames[].margins.mechanisms.intervals.tilt", Type::MotionPairs, "", "where it has an interval", "beyond the ends of the tilt"),
    key("frames[].margins.mechanisms.intervals.horizontal_load", Type::MotionPairs, "", "where it has an interval", "beyond the ends of the horizontal load"),
    key("frames[].margins.mechanisms.intervals.load_factor", Type::MotionPairs, "", "where it has an interval", "beyond the ends of the factor on the loads"),
    key("frames[].only_by_wedging", Type::FlagOrOpen, "", "with `--wedging`, where it stands", "whether it stands only because blocks are pressed together by their own tightness; null where that stays open, with the reason in the effect"),
    key("frames[].wedging", Type::Object, "", "with `--wedging`, where `only_by_wedging` is `true`", "what shows it"),
    key("frames[].wedging.must_press", Type::Objects, "", "", "interfaces that have to press, though nothing presses them"),
    key("frames[].wedging.must_press[].interface", Type::Count, "", "", "its number in `interfaces`, from 0"),
    key("frames[].wedging.must_press[].bodies", Type::Names, "", "", "between whom"),
    key("frames[].wedging.normal_force_at_least", Type::Number, "N", "where it was shown", "with so much in all"),
    key("frames[].wedging.bound", Type::Objects, "", "where that was shown", "the motion that bounds it from below"),
    key("frames[].wedging.bound[].block", Type::Text, "", "", "the block"),
    key("frames[].wedging.bound[].at", Type::Pair, "m", "", "the place about which its spin counts"),
    key("frames[].wedging.bound[].velocity", Type::Pair, "", "", "its velocity there"),
    key("frames[].wedging.bound[].spin", Type::Number, "1/m", "", "its spin, anticlockwise"),
    key("frames[].wedging.gives_way", Type::Objects, "", "", "how blocks move as the joints yield a little"),
    key("frames[].wedging.gives_way[].block", Type::Text, "", "", "the block"),
    key("frames[].wedging.gives_way[].at", Type::Pair, "m", "", "the place about which its spin counts"),
    key("frames[].wedging.gives_way[].velocity", Type::Pair, "", "", "its velocity there"),
    key("frames[].wedging.gives_way[].spin", Type::Number, "1/m", "", "its spin, anticlockwise"),
    key("frames[].wedging.presses_nothing", Type::Flag, "", "", "whether that motion presses no interface at all"),
    key("frames[].wedging.cases", Type::Count, "", "", "how many ways of pressing and sliding were ruled out"),
    key("frames[].wedging.ruled_out", Type::Objects, "", "", "these ways; springs at rest have none of them, and there is no other"),
    key("frames[].wedging.ruled_out[].points", Type::Objects, "", "", "application points of which the case says something"),
    key("frames[].wedging.ruled_out[].points[].interface", Type::Count, "", "", "its interface, as a number in `interfaces`"),
    key("frames[].wedging.ruled_out[].points[].point", Type::Count, "", "", "which of its application points, 0 or 1"),
    key("frames[].wedging.ruled_out[].points[].presses", Type::Flag, "", "", "whether it presses"),
    key("frames[].wedging.ruled_out[].faces", Type::Objects, "", "", "interfaces with friction of which the case says something"),
    key("frames[].wedging.ruled_out[].faces[].interface", Type::Count, "", "", "its number in `interfaces`"),
    key("frames[].wedging.ruled_out[].faces[].slides", Type::Text, "", "", "`forth` along (−n_y, n_x) of its normal, `back` against it, or `sticks`"),
    key("frames[].effects", Type::Objects, "", "", "what the frame's mechanics consists of"),
    key("frames[].effects[].effect", Type::Text, "", "", "`weight`, `contact`, `friction`, `kernel`, `robots`, `robot torque`, `loads`, `corner contacts`, `sticking`, `mechanism`, `margins` or `wedging`"),
    key("frames[].effects[].simulated", Type::Flag, "", "", "whether the frame calls for it"),
    key("frames[].effects[].why", Type::Text, "", "", "why, or why not"),
    key("frames[].effects[].unknowns", Type::Count, "", "", "how many unknowns it adds, or would have added"),
    key("frames[].proof", Type::Object, "", "", "how well the verdict is proved, from outlines and forces alone: of forces where it stands, of a motion where it falls, of either where undecided"),
    key("frames[].proof.worst_imbalance", Type::Number, "", "of forces", "the share by which each force on a block would have to change, and to move of the block's radius, for balance; the worst block"),
    key("frames[].proof.worst_share", Type::Number, "", "of forces", "worst imbalance of a block in parts of its own load"),
    key("frames[].proof.worst_pull", Type::Number, "", "of forces", "largest pull at a contact, in parts of its forces"),
    key("frames[].proof.worst_slip", Type::Number, "", "of forces", "largest friction beyond μN, or robot's force beyond its limit, in parts of the forces there"),
    key("frames[].proof.power", Type::Number, "", "of a motion", "power of the loads along the motion less what robots can hold, in parts of the loads of what moves"),
    key("frames[].proof.worst_violation", Type::Number, "", "of a motion", "worst velocity against which an admissible force could act, the fastest point moving with 1"),
    key("frames[].proof.no_balance_below", Type::Bound, "", "of a motion", "below this sum of forces, in loads of what moves, nothing balances"),
    key("frames[].solve", Type::Object, "", "", "how it was found"),
    key("frames[].solve.method", Type::Text, "", "", "what decided: `closed form`, `kinematic`, `kinematic, refined`, `least residual` or `least sticking`"),
    key("frames[].solve.iterations", Type::Count, "", "", "iterations of the solver"),
    key("frames[].solve.programs", Type::Count, "", "", "programs that were solved"),
    key("frames[].solve.groups", Type::Count, "", "", "groups of blocks that do not touch each other"),
    key("frames[].solve.reused", Type::Count, "", "", "groups that were taken over from an earlier frame"),
    key("frames[].solve.seconds", Type::Number, "s", "unless `--no-timing`", "time taken; it and its `stages` are the only values that may differ from run to run"),
    key("frames[].solve.stages", Type::Object, "", "unless `--no-timing`", "where that time went"),
    key("frames[].solve.stages.assembly", Type::Number, "s", "", "posing the frame from what each effect contributes"),
    key("frames[].solve.stages.solution", Type::Number, "s", "", "solving and proving: verdict, forces, what fails, motion"),
    key("frames[].solve.stages.wedging", Type::Number, "s", "", "whether it stands by wedging only; 0 where not asked for"),
    key("frames[].solve.stages.margins", Type::Number, "s", "", "the margins; 0 where not asked for"),
    key("frames[].notices", Type::NameList, "", "where there are some", "what a person should know of this frame"),
];

/// Every key of what stands in the place of a result where a file is refused.
#[rustfmt::skip]
pub const REFUSAL_KEYS: &[Key] = &[
    key("file", Type::Text, "", "", "the path as given"),
    key("problems", Type::Objects, "", "", "all that is wrong with it, at least one"),
    key("problems[].code", Type::Text, "", "", "what sort of problem, a stable word; see the list"),
    key("problems[].path", Type::Text, "", "", "where in the scene, as `blocks[3].polygon[1]`; empty for the whole file"),
    key("problems[].line", Type::Place, "", "", "line in the text, from 1; null where there is none"),
    key("problems[].column", Type::Place, "", "", "column in characters, from 1; null where there is none"),
    key("problems[].message", Type::Text, "", "", "what is wrong, with the numbers found"),
    key("problems[].hint", Type::Text, "", "", "what to do about it"),
];

impl Type {
    /// What stands there, in words.
    pub fn words(self) -> String {
        let fixed = match self {
            Type::Word(words) => {
                let quoted: Vec<String> = words.iter().map(|w| format!("`\"{w}\"`")).collect();
                return quoted.join(", ");
            }
            Type::Text => "text",
            Type::Flag => "true or false",
            Type::FlagOrOpen => "true, false or null",
            Type::Count => "whole number",
            Type::Place => "whole number or null",
            Type::Number => "number",
            Type::Bound => "number or `\"unbounded\"`",
            Type::Margin => "number, null or `\"unbounded\"`",
            Type::Interval => "[low, high] or null",
            Type::MotionPairs => "two lists of motions",
            Type::Pair => "[x, y]",
            Type::Pairs => "[[x, y], [x, y]]",
            Type::Names => "two names",
            Type::NameList => "list of texts",
            Type::Motions => "list of motions",
            Type::Object => "object",
            Type::Objects => "list of objects",
            Type::ByRobot => "object by robot",
        };
        fixed.into()
    }

    fn schema(self) -> Value {
        let number = json!({ "type": ["number", "null"] });
        let pair = json!({ "type": "array", "items": number, "minItems": 2, "maxItems": 2 });
        let unbounded = json!({ "const": "unbounded" });
        match self {
            Type::Text => json!({ "type": "string" }),
            Type::Word(words) => json!({ "type": "string", "enum": words }),
            Type::Flag => json!({ "type": "boolean" }),
            Type::FlagOrOpen => json!({ "type": ["boolean", "null"] }),
            Type::Count => json!({ "type": "integer", "minimum": 0 }),
            Type::Place => json!({ "type": ["integer", "null"], "minimum": 1 }),
            Type::Number => number,
            Type::Bound | Type::Margin => json!({ "anyOf": [number, unbounded] }),
            Type::Interval => {
                let withheld = json!({ "const": "withheld" });
                let end = json!({ "anyOf": [number, withheld] });
                let both = json!({ "type": "array", "items": end, "minItems": 2, "maxItems": 2 });
                json!({ "anyOf": [both, { "type": "null" }, withheld] })
            }
            Type::MotionPairs => {
                let motions = json!({ "type": "array", "items": { "$ref": "#/$defs/motion" } });
                json!({ "type": "array", "items": motions, "minItems": 2, "maxItems": 2 })
            }
            Type::Pair => pair,
            Type::Pairs => json!({ "type": "array", "items": pair, "minItems": 2, "maxItems": 2 }),
            Type::Names => {
                json!({ "type": "array", "items": { "type": "string" }, "minItems": 2, "maxItems": 2 })
            }
            Type::NameList => json!({ "type": "array", "items": { "type": "string" } }),
            Type::Motions => {
                json!({ "type": "array", "items": { "$ref": "#/$defs/motion" } })
            }
            Type::Object => json!({ "type": "object" }),
            Type::Objects => json!({ "type": "array", "items": { "type": "object" } }),
            Type::ByRobot => {
                json!({ "type": "object", "additionalProperties": { "type": "object" } })
            }
        }
    }
}

/// The JSON Schema (draft 2020-12) of what `check --json` prints for one file: a result, or the problems of a refused file.
///
/// Later versions add keys; so a program should not refuse those it does not know, and neither does the schema.
///
/// ```
/// assert!(drystone::result::schema().contains("\"total_sticking\""));
/// ```
pub fn schema() -> String {
    let mut refusal = object(REFUSAL_KEYS);
    let codes: Vec<&str> = Code::ALL.iter().map(|code| code.word()).collect();
    refusal["properties"]["problems"]["items"]["properties"]["code"]["examples"] = json!(codes);
    let velocity = described(
        Type::Pair,
        "velocity of its centroid, relative to the fastest point, which moves with 1",
    );
    let spin = described(Type::Number, "1/m, anticlockwise positive");
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "drystone result",
        "description": "What `drystone check --json` prints for one scene file. SI units, y up.",
        "anyOf": [object(KEYS), refusal],
        "$defs": { "motion": {
            "type": "object",
            "properties": {
                "block": described(Type::Text, "the block"),
                "velocity": velocity,
                "spin": spin,
            },
            "required": ["block", "velocity", "spin"],
        } },
    });
    format!("{schema:#}\n")
}

fn described(kind: Type, meaning: &str) -> Value {
    let mut schema = kind.schema();
    schema["description"] = meaning.into();
    schema
}

/// The schema of an object with these keys, and with the objects in it.
fn object(keys: &[Key]) -> Value {
    let mut root = json!({ "type": "object" });
    for key in keys {
        let mut here = &mut root;
        let mut segments: Vec<&str> = key.path.split('.').collect();
        let last = segments.pop().unwrap_or_default();
        for segment in segments {
            here = match (segment, segment.strip_suffix("[]")) {
                ("*", _) => &mut here["additionalProperties"],
                (_, Some(list)) => &mut here["properties"][list]["items"],
                (name, None) => &mut here["properties"][name],
            };
        }
        let meaning = match (key.unit, key.when) {
            ("", "") => key.meaning.to_owned(),
            (unit, "") => format!("{} ({unit})", key.meaning),
            ("", when) => format!("{}; {when}", key.meaning),
            (unit, when) => format!("{} ({unit}); {when}", key.meaning),
        };
        here["properties"][last] = described(key.kind, &meaning.replace('\\', ""));
        if key.when.is_empty() {
            match here.get_mut("required") {
                Some(Value::Array(required)) => required.push(last.into()),
                _ => here["required"] = json!([last]),
            }
        }
    }
    root
}
