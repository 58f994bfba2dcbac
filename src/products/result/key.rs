//! [`KEYS`]: every key of a result with its type, unit and meaning, as a tree. [`schema`](super::schema()) makes a JSON
//! Schema from it.
//!
//! A test reads the results of many scenes. It fails if one of their keys is missing here, or if a key listed here
//! never occurs.

use self::Type::{
    Bound, ByRobot, Count, Exclusions, Flag, FlagOrOpen, Index, Interval, Margin, MotionPairs, Motions, NameList,
    Names, Number, Object, Objects, Pair, Pairs, Place, Points, Rings, Slope, SlopePair, Text, Word,
};
use crate::mechanics::analysis::MarginKind;

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// Any text.
    Text,
    /// One of the listed words.
    Word(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
    /// `true`, `false`, or `null` if it could not be decided.
    FlagOrOpen,
    /// A whole number, at least 0.
    Count,
    /// A line or column number from 1, or `null` if there is no position.
    Place,
    /// A whole number from 0, or `null` if there is no such index.
    Index,
    /// A number; `null` if it could not be computed, which happens only in undecided frames.
    Number,
    /// A number, or `"unbounded"`.
    Bound,
    /// A number; `null` if there is no value, for example because the frame falls at every value; `"unbounded"` if the
    /// interval of values at which the frame stands has no end in this direction.
    Margin,
    /// An interval `[low, high]`, `null` if it is empty, or `"withheld"`. Each end is a number, `null` if there is no
    /// limit, or `"withheld"`.
    Interval,
    /// A derivative: a number, or `"at_kink"`.
    Slope,
    /// Derivatives along x and y: `[x, y]`, or `"at_kink"` if one of them is not unique; `null` for a vertex that cannot
    /// move.
    SlopePair,
    /// Two lists of motions: just beyond the lower end and just beyond the upper end of an interval.
    MotionPairs,
    /// A point or vector, `[x, y]`.
    Pair,
    /// Two points, `[[x, y], [x, y]]`.
    Pairs,
    /// Any number of points, `[[x, y], …]`.
    Points,
    /// A list of lists of points.
    Rings,
    /// Two names.
    Names,
    /// A list of names.
    NameList,
    /// A list of `{ "block", "velocity", "spin" }`: how blocks move.
    Motions,
    /// A list of `{ "from", "to", "mechanism" }`: values at which a frame falls by one motion. An end that is `null`
    /// has no limit.
    Exclusions,
    /// An object.
    Object,
    /// A list of objects.
    Objects,
    /// An object with a key for each robot, by its name.
    ByRobot,
}

impl Type {
    /// Describes the type in words, for the table of keys.
    pub fn words(self) -> String {
        let fixed = match self {
            Word(words) => {
                let quoted: Vec<String> = words.iter().map(|w| format!("`\"{w}\"`")).collect();
                return quoted.join(", ");
            }
            Text => "text",
            Flag => "boolean",
            FlagOrOpen => "boolean or null",
            Count => "integer",
            Place | Index => "integer or null",
            Number => "number",
            Bound => "number or `\"unbounded\"`",
            Margin => "margin",
            Interval => "interval",
            Slope => "derivative",
            SlopePair => "two derivatives",
            MotionPairs => "two motions",
            Pair => "[x, y]",
            Pairs => "two points",
            Points => "points",
            Rings => "lists of points",
            Names => "two names",
            NameList => "texts",
            Motions => "motion",
            Exclusions => "exclusions",
            Object => "object",
            Objects => "objects",
            ByRobot => "object by robot",
        };
        fixed.into()
    }
}

/// A key of a result.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// The key.
    pub name: &'static str,
    /// The type of the value.
    pub kind: Type,
    /// The unit of the value; empty if it has no unit.
    pub unit: &'static str,
    /// The condition under which the key is present; empty if it is always present.
    pub when: &'static str,
    /// The meaning of the value.
    pub meaning: &'static str,
    /// The keys of the value, if it is an object, a list of objects, or an object by robot.
    pub keys: &'static [Key],
}

impl Key {
    const fn unit(self, unit: &'static str) -> Key {
        Key { unit, ..self }
    }

    const fn when(self, when: &'static str) -> Key {
        Key { when, ..self }
    }

    const fn of(self, keys: &'static [Key]) -> Key {
        Key { keys, ..self }
    }
}

const fn key(name: &'static str, kind: Type, meaning: &'static str) -> Key {
    Key { name, kind, unit: "", when: "", meaning, keys: &[] }
}

/// Returns the path of every key, with the key, in the order in which a result has them: for example
/// `frames[].robots[].force`; `*` stands for the name of any robot.
pub fn paths(keys: &[Key]) -> Vec<(String, Key)> {
    let mut list = Vec::new();
    for key in keys {
        list.push((key.name.to_owned(), *key));
        let link = match key.kind {
            Objects => "[].",
            ByRobot => ".*.",
            _ => ".",
        };
        list.extend(paths(key.keys).into_iter().map(|(path, inner)| (format!("{}{link}{path}", key.name), inner)));
    }
    list
}

const IF_MARGINS_REQUESTED: &str = "with `--margins`";
/// The condition for keys that are only present if this margin was requested. A request without names requests all
/// margins.
const IF_MARGIN_REQUESTED: &str = "if requested";

const IF_NO_INTERVAL: &str = "if its interval is `null`";
const UNIQUE: Key = key("unique", Flag, "whether both derivatives are equal");
const INTERFACE: Key = key("interface", Count, "index in `interfaces`, from 0");
const TILT_SIDES: &[Key] = &[
    key("left", Margin, "to the left (clockwise)").unit("°"),
    key("right", Margin, "to the right (anticlockwise)").unit("°"),
];
const MOVING_BLOCK: &[Key] = &[
    key("block", Text, "block that moves"),
    key("at", Pair, "point whose velocity is given").unit("m"),
    key("velocity", Pair, "velocity of this point"),
    key("spin", Number, "spin of the block, positive anticlockwise").unit("1/m"),
];
const SIDES: &[Key] = &[key("left", Margin, "to this side"), key("right", Margin, "to this side")];
const MOTIONS_TO_SIDES: &[Key] = &[key("left", Motions, "to this side"), key("right", Motions, "to this side")];

/// The condition of the keys of the normal stress.
const IF_EDGE_PRESSES: &str = "if an edge presses";

/// The number of kinds of margins of the whole frame. The limits of robots are the last kind.
const FRAME_KINDS: usize = MarginKind::ALL.len() - 1;

/// Returns one key for each kind of margin of the whole frame, and then `more` keys. `of` says what the values are:
/// margins, intervals, exclusions, or motions beyond the margins.
const fn of_margins<const N: usize>(of: Type, more: &[Key]) -> [Key; N] {
    let mut keys = [key("", Text, ""); N];
    let mut k = 0;
    while k < N {
        keys[k] = if k < FRAME_KINDS { of_margin(&of, MarginKind::ALL[k]) } else { more[k - FRAME_KINDS] };
        k += 1;
    }
    keys
}

const fn of_margin(of: &Type, kind: MarginKind) -> Key {
    let about = kind.about();
    let ([margin, interval, excluded, beyond], name) = (about.keys, about.words[0]);
    let sides = kind.is_signed();
    match of {
        Margin if !sides => key(name, Margin, margin).when(IF_MARGIN_REQUESTED),
        Margin => {
            let sides = if about.unit.is_empty() { SIDES } else { TILT_SIDES };
            key(name, Object, margin).of(sides).when(IF_MARGIN_REQUESTED)
        }
        Interval => key(name, Interval, interval).unit(about.unit).when(about.condition),
        Exclusions => key(name, Exclusions, excluded).unit(about.unit).when(IF_NO_INTERVAL),
        Objects => key(name, Objects, "at the lower and at the upper end").of(CONDITION).when(IF_MARGIN_REQUESTED),
        _ if sides => key(name, Object, beyond).of(MOTIONS_TO_SIDES),
        _ => key(name, Motions, beyond),
    }
}

/// The keys of the margins of a frame.
#[rustfmt::skip]
static MARGINS: [Key; FRAME_KINDS + 5] = of_margins(Margin, &[
    key("robots", ByRobot, "least limits of each robot that holds a block; empty if they were not requested").of(&[
        key("fx", Margin, "least limit of this force").unit("N"),
        key("fy", Margin, "least limit of this force").unit("N"),
        key("torque", Margin, "least limit of its torque").unit("N·m"),
    ]),
    key("intervals", Object, "for each parameter, the values at which the frame stands if all else is unchanged; an end is `null` if there is no limit; an interval is `null` if the frame stands at no value; `\"withheld\"` replaces what no verdict confirms, and a notice says why").of(&INTERVALS),
    key("excluded", Object, "why the frame stands at no value: motions, each with the values that it excludes; together they exclude all. If two parts of the frame conflict, one motion excludes the values below a limit, and the other those above a smaller limit").when("if an interval is `null`").of(&EXCLUDED),
    key("notes", NameList, "remarks on the intervals, one sentence each").when("if there are remarks"),
    key("mechanisms", Object, "motion just beyond each margin; empty for a margin that is unbounded or null, and for a margin that was not requested").of(&MECHANISMS),
]);

/// The keys of the margins with a sign.
static SIGNED: [Key; FRAME_KINDS - 1] = {
    let mut keys = [key("", Number, ""); FRAME_KINDS - 1];
    let mut k = 0;
    while k < FRAME_KINDS - 1 {
        let about = MarginKind::ALL[k + 1].about();
        keys[k] = key(about.words[0], Number, about.name).when(IF_MARGIN_REQUESTED);
        k += 1;
    }
    keys
};

/// How a structure follows a movement of a support.
const MOVEMENT: &[Key] = &[
    key("ground", Text, "part of the ground that moves"),
    key("outcome", Word(&["follows", "jams", "untouched", "unsolved"]), "`follows`: it cracks and follows the support; `jams`: rigid blocks cannot follow; `untouched`: no block touches the support where it moves; `unsolved`: the solver ended without a result"),
    key("unit", Number, "displacement of the fastest point at which the structure touches the support; `joints` and `velocities` are per metre of it").unit("m").when("if it follows"),
    key("force", Pair, "force of the structure on the support: H to the right, V upwards").unit("N").when("if it follows"),
    key("work", Number, "work of this force on the movement, the least of all forces that balance the frame").unit("J").when("if it follows"),
    key("joints", Objects, "joints that open or slide").when("if it follows").of(&[
        INTERFACE,
        key("end", Count, "application point that stays closed, 0 or 1").when("if the joint opens about one end"),
        key("opening", Number, "how far it opens at its wider end").unit("m/m"),
        key("slip", Number, "how far the first body slides along (−n_y, n_x)").unit("m/m"),
    ]),
    key("velocities", Motions, "displacement of the placed blocks").when("if it follows"),
];

const CONDITION: &[Key] = &[
    key("case", Text, "load case").when("if the scene has load cases"),
    key("position", Count, "index of the position of the vehicle in `vehicle.positions`, from 0")
        .when("if the vehicle decides"),
];

static CONDITIONS: [Key; FRAME_KINDS] = of_margins(Objects, &[]);

#[rustfmt::skip]
static INTERVALS: [Key; FRAME_KINDS + 1] = of_margins(Interval, &[
    key("robots", ByRobot, "limits of each robot, each varied alone").when("if requested, with robots that hold blocks").of(&[
        key("fx", Interval, "limit of this force").unit("N"),
        key("fy", Interval, "limit of this force").unit("N"),
        key("torque", Interval, "limit of its torque").unit("N·m"),
    ]),
]);

#[rustfmt::skip]
static EXCLUDED: [Key; FRAME_KINDS + 1] = of_margins(Exclusions, &[
    key("robots", ByRobot, "they exclude all limits of a robot").when(IF_NO_INTERVAL).of(&[
        key("fx", Exclusions, "they exclude all limits of this force").unit("N").when(IF_NO_INTERVAL),
        key("fy", Exclusions, "they exclude all limits of this force").unit("N").when(IF_NO_INTERVAL),
        key("torque", Exclusions, "they exclude all limits of its torque").unit("N·m").when(IF_NO_INTERVAL),
    ]),
]);

#[rustfmt::skip]
static MECHANISMS: [Key; FRAME_KINDS + 2] = of_margins(Motions, &[
    key("robots", ByRobot, "just below the least limits of each robot").of(&[
        key("fx", Motions, "just below this limit"),
        key("fy", Motions, "just below this limit"),
        key("torque", Motions, "just below this limit"),
    ]),
    key("intervals", Object, "motions just beyond the lower and the upper end of an interval; if an interval is `null`, its motions are in `excluded`").of(&[
        key("tilt", MotionPairs, "at the ends of this interval").when("if it has an interval"),
        key("horizontal_load", MotionPairs, "at the ends of this interval").when("if it has an interval"),
        key("load_factor", MotionPairs, "at the ends of this interval").when("if it has an interval"),
    ]),
]);

/// Every key of a result, in the order in which a result has them.
#[rustfmt::skip]
pub static KEYS: &[Key] = &[
    key("drystone", Text, "version of the program"),
    key("file", Text, "path of the scene file: as given, or that of its given folder and its name; `-` for standard input").when("from the command line"),
    key("scene", Text, "title of the scene; empty if the scene has none"),
    key("set", NameList, "values of the scene file that were replaced, such as `friction=0.5`; the title states them too").when("with `--set`"),
    key("contact_tolerance", Object, "largest gap at which edges still touch, and how corners were moved").of(&[
        key("gap", Number, "edges at most this far apart touch; 0 if all bodies consist of lattice cells").unit("m"),
        key("from", Word(&["lattice", "given", "decimals", "significant_digits", "float32", "size", "noise"]), "source of the tolerance: `lattice`, cells touch exactly; `given`, the scene file or the command line; `decimals`, `significant_digits`, `float32`, how coordinates are written; `size`, `noise`, the size of the scene"),
        key("digits", Count, "number of these digits").when("if `from` is `decimals` or `significant_digits`"),
        key("healed_within", Number, "distance within which corners were merged; 0 if coordinates are used as written").unit("m"),
        key("moved_corners", Count, "number of moved corners"),
        key("largest_move", Number, "largest move of a corner").unit("m"),
    ]),
    key("notes", Objects, "what the author probably did not intend").when("if there are notes and `--no-notes` is not given").of(&[
        key("code", Text, "kind of note, one of the codes below"),
        key("path", Text, "place in the scene, for example `robots[0].at`"),
        key("line", Place, "line in the scene file, from 1"),
        key("message", Text, "what was found in the scene"),
        key("hint", Text, "how to change the scene, and how to silence the note"),
    ]),
    key("frames", Objects, "one result for each step, or one for a scene without steps").of(&[
        key("title", Text, "title of the step; empty if it has none"),
        key("verdict", Word(&["stable", "unstable", "undecided"]), "stable: admissible forces balance all blocks; unstable: a collapse mechanism exists; undecided: neither is proved"),
        key("doubt", Text, "why the frame is undecided").when("if the frame is undecided"),
        key("length", Number, "length L that turns torques into forces in the sums: median length of the interfaces without corner contacts (the shorter of the two in the middle); in a frame without interfaces the square root of the median block's area; 1 in an empty frame").unit("m"),
        key("total_force", Number, "sum of all forces: Σ(N₁ + N₂ + \\|T\\|) over all interfaces, plus Σ(\\|Fx\\| + \\|Fy\\| + \\|M\\|/L) over all robots").unit("N"),
        key("total_force_least", Flag, "whether `total_force` is the least possible sum").when("only if `false`"),
        key("total_force_bound", Number, "lower bound of `total_force` for all balances, from a motion (weak duality)").unit("N").when("if the frame stands and a bound was found"),
        key("total_sticking", Number, "sum of the missing forces in `failures`, computed like `total_force`; 0 if the frame stands, if no adhesion would help (`unsupported`), and with `--verdict-only`, which does not compute it").unit("N"),
        key("weight", Number, "weight of all placed blocks").unit("N"),
        key("blocks", Objects, "placed blocks, in the order of placing").when("with `--blocks`").of(&[
            key("id", Text, "id of the block"),
            key("centre", Pair, "point at which its weight acts").unit("m"),
            key("area", Number, "area of the block, without its holes").unit("m²"),
            key("weight", Number, "weight of the block").unit("N"),
            key("vertices", Points, "corners of its outline, anticlockwise, after healing").unit("m"),
            key("holes", Rings, "corners of each hole").unit("m").when("if the block has holes"),
        ]),
        key("interfaces", Objects, "contacts between bodies; forces act on `bodies[0]`").of(&[
            key("bodies", Names, "two bodies that touch; `ground` is the ground"),
            key("kind", Word(&["corner", "circle"]), "a corner touches an edge or another corner, or a circle touches").when("at contacts of one point"),
            key("ends", Pairs, "ends of the interface").unit("m"),
            key("application_points", Pairs, "points of the normal forces: the ends, moved inward by the kernel").unit("m"),
            key("normal", Pair, "unit normal, which points into `bodies[0]`"),
            key("mu", Number, "friction coefficient"),
            key("normal_forces", Pair, "normal forces at the two application points, at least 0").unit("N"),
            key("friction_force", Number, "friction force, positive along (−n_y, n_x), where n is the normal").unit("N"),
            key("resultant", Object, "resultant of the forces at the interface").of(&[
                key("at", Pair, "point at which it acts").unit("m"),
                key("force", Pair, "force on `bodies[0]`").unit("N"),
            ]),
            key("friction_used", Number, "friction force as a share of the largest possible friction μN, from 0 to 1; 0 without friction; in a falling frame for the balance that includes the missing forces"),
            key("eccentricity", Number, "distance of the resultant from the middle of the interface, positive along (−n_y, n_x); in a falling frame for the balance that includes the missing forces").unit("m").when(IF_EDGE_PRESSES),
            key("in_middle_third", Flag, "whether the resultant lies in the middle third of the interface").when(IF_EDGE_PRESSES),
            key("pressure", Pair, "pressure at the two ends, if it varies linearly and there is no tension; in a falling frame for the balance that includes the missing forces").unit("N/m²").when("if an edge presses, unless the resultant is at an end"),
        ]),
        key("robots", Objects, "robots that hold a block in this frame, in the order of the scene").of(&[
            key("id", Text, "id of the robot"),
            key("holds", Text, "block that it holds"),
            key("at", Pair, "grip point").unit("m"),
            key("force", Pair, "force on the block").unit("N"),
            key("torque", Number, "torque on the block, positive anticlockwise").unit("N·m"),
            key("limit_used", Number, "largest share of a limit that the robot uses, from 0 to 1; 0 for a robot without limits, or with all limits 0; in a falling frame for the balance that includes the missing forces"),
        ]),
        key("failures", Objects, "missing forces: what contacts and robots would have to exert beyond their limits; empty if the frame stands; none for `unsupported` blocks").of(&[
            key("kind", Word(&["tension", "friction", "robot_force", "robot_torque"]), "`tension`: a contact opens; `friction`: a contact slides; `robot_force`, `robot_torque`: a robot cannot exert the force or the torque"),
            key("bodies", Names, "bodies in contact").when("at a contact"),
            key("robot", Text, "robot whose limit is exceeded").when("at a robot"),
            key("holds", Text, "block that it holds").when("at a robot"),
            key("at", Pair, "point at which it is missing; for friction the middle of the interface").unit("m"),
            key("force", Pair, "missing force, on `bodies[0]` or on the block").unit("N").when("unless a torque is missing"),
            key("torque", Number, "missing torque on the block, positive anticlockwise").unit("N·m").when("if a torque is missing"),
            key("amount", Number, "size of the missing force or torque; for a force of a robot \\|Fx\\| + \\|Fy\\|").unit("N or N·m"),
        ]),
        key("unsupported", NameList, "blocks that would fall even if all contacts and grips could stick").when("if there are unsupported blocks"),
        key("corners_decide", Flag, "whether the verdict would be the other one if corners that touch carried force, or if they did not").when("only if `true`"),
        key("mechanism", Motions, "velocities of the blocks as the collapse begins; empty if the frame stands"),
        key("margins", Object, "how far the frame is from collapse: the extreme values at which it stands; a margin is null if the frame stands at no value, if the margin does not exist in this frame, or if no value was confirmed (a notice then says so)").when(IF_MARGINS_REQUESTED).of(&MARGINS),
        key("signed_margins", Object, "for each margin, one number that is positive if the frame stands and negative if it falls: how far the present value is from the nearest end of the interval, as a share from −1 to 1; below −1 if the frame stands at no value; of `sliding`, `overturning` and `middle_third`, for the changed structure").when("with `--margins`, except for `friction` and `robots`").of(&SIGNED),
        key("sensitivity", Object, "exact derivatives of the ends of one margin's interval with respect to vertices, weights, friction and loads, for unchanged contacts. At a kink, where a derivative differs between the possible forces and mechanisms, it is `at_kink`").when("with `--sensitivity`").of(&[
            key("parameter", Word(&["friction", "tilt", "horizontal_load", "kernel", "load_factor", "friction_factor"]), "parameter of the margin"),
            key("ends", Objects, "ends of the interval that have a value and a mechanism").of(&[
                key("end", Word(&["low", "high"]), "lower or upper end"),
                key("value", Number, "value of the parameter: in degrees for the tilt, otherwise without a unit"),
                key("vertices", Objects, "for each vertex of each placed block").of(&[
                    key("block", Text, "block of the vertex"),
                    key("vertex", Count, "index of the vertex in the outline, from 0 and anticlockwise; the vertices of holes follow"),
                    key("at", Pair, "position of the vertex").unit("m"),
                    key("with", NameList, "other bodies whose vertices move with this one, so that no joint opens"),
                    key("moves", Word(&["freely", "along", "not"]), "whether the vertex can move freely, only along an edge of another body, or not at all without opening or bending a joint"),
                    key("along", Pair, "unit vector along this edge").when("if `moves` is `along`"),
                    UNIQUE,
                    key("slope", SlopePair, "change of the value per metre by which the vertex moves along x and along y; if it can move only along an edge, a vector along this edge; null if it cannot move").unit("1/m"),
                ]),
                key("weights", Objects, "for the weight of each placed block").of(&[
                    key("block", Text, "block whose weight changes"),
                    UNIQUE,
                    key("slope", Slope, "change of the value per newton of weight; the centroid does not move").unit("1/N"),
                ]),
                key("friction", Objects, "for the friction coefficient of each interface; empty for the friction margin, which sets all coefficients").of(&[
                    INTERFACE,
                    key("bodies", Names, "bodies of the interface"),
                    UNIQUE,
                    key("slope", Slope, "change of the value per unit of the friction coefficient"),
                ]),
                key("friction_of_all", Object, "for the same change of all friction coefficients").when("unless the margin is the friction margin").of(&[
                    UNIQUE,
                    key("slope", Slope, "change of the value per unit of all coefficients"),
                ]),
                key("loads", Objects, "for each load on a placed block").of(&[
                    key("load", Count, "index in `loads` of the scene, from 0"),
                    key("block", Text, "block on which the load acts"),
                    key("at", Pair, "point at which the load acts").unit("m"),
                    UNIQUE,
                    key("slope", SlopePair, "change of the value per metre by which this point moves along x and along y").unit("1/m"),
                ]),
            ]),
            key("without_value", Objects, "ends of the interval that have no value or no mechanism").of(&[
                key("end", Word(&["low", "high"]), "lower or upper end"),
                key("reason", Word(&["not_applicable", "stands_at_no_value", "unbounded", "range_ends", "unconfirmed", "unsolved"]), "`not_applicable`: the margin does not exist in this frame (for example without loads), or the scene lists its contacts; `stands_at_no_value`: the frame falls at every value; `unbounded`: it stands at every value in this direction; `range_ends`: the range of the parameter ends here; `unconfirmed`: no verdict confirms the end; `unsolved`: forces and mechanism could not be computed"),
            ]),
        ]),
        key("capacity", Object, "all forces (Fx, Fy) that the block can carry at this point, in addition to its present loads: the convex hull of `vertices`, extended without end along `rays`").when("with `--capacity`, if the block is placed").of(&[
            key("block", Text, "block on which the force acts"),
            key("at", Points, "point at which the force acts; for a free contact two points, and the force is their resultant").unit("m"),
            key("robot", Text, "robot that holds the block at this point; the limits of its force are ignored").when("if the force is that of a robot"),
            key("shape", Word(&["empty", "point", "segment", "polygon", "unbounded", "everything"]), "shape of the set of forces"),
            key("stands_without", Flag, "whether the frame stands without an additional force"),
            key("vertices", Points, "corners of the set, anticlockwise, each proved by forces").unit("N"),
            key("rays", Points, "unit directions in which the set is unbounded, anticlockwise; empty if it is bounded"),
            key("edges", Objects, "edges of the set, anticlockwise, each proved by a motion").of(&[
                key("from", Index, "index of the vertex where the edge begins, from 0; null if it is unbounded there"),
                key("to", Index, "the same for its other end"),
                key("normal", Pair, "unit normal, which points out of the set"),
                key("limit", Number, "largest component of a force in the set along this normal").unit("N"),
                key("mechanism", Motions, "motion just beyond the edge"),
                key("case", Count, "index of the extreme case of `--for-all` to which the edge belongs, from 0"),
            ]),
            key("balances", Objects, "contact forces that prove each vertex, in the order of `vertices`").when("unless `--for-all` gives more than one case").of(&[
                key("torque", Number, "torque on the block, about the first point of a free contact; 0 if the force acts at one point").unit("N·m"),
                key("interfaces", Objects, "interfaces of all blocks that influence this block").of(&[
                    INTERFACE,
                    key("normal_forces", Pair, "normal forces at the two application points").unit("N"),
                    key("friction_force", Number, "friction force").unit("N"),
                ]),
            ]),
            key("mechanism", Motions, "motion with which the frame falls at every force; if no force belongs to all cases, the motion of one edge of one case").when("if a motion proves that the set is empty"),
            key("gap", Number, "error of the set: every force that no motion excludes is at most this far from the proved forces; at most a millionth of the size of the set or a few billionths of the heaviest load").unit("N"),
            key("cases", Count, "number of extreme cases whose sets were intersected; 1 without `--for-all`"),
        ]),
        key("placement", Object, "how accurately the blocks must be placed: all joints, centres of gravity and loads may be off at the same time").when("with `--placement`, if the frame stands and errors of some block count").of(&[
            key("proved", Number, "the frame stands for all errors up to this").unit("m"),
            key("falls_at", Number, "with errors of this size it falls, in the directions of `pattern`").unit("m").when("if such a pattern was found"),
            key("limited_by", Word(&["balance", "joint_length", "point_contact", "too_many_blocks", "search", "time_limit"]), "why `proved` is not larger: no larger tolerance has such a proof; a joint has no length left; a contact acts at one point; a part has too many blocks; the search ended before the optimum; the time limit ended the search"),
            key("joint", Count, "index in `interfaces`, from 0, of the joint that decides").when("if a joint decides"),
            key("block", Text, "block whose error does most of the work in `mechanism`").when("if a pattern was found"),
            key("pattern", Objects, "errors of the centres of gravity with which the frame falls; the ends of all joints are off by `falls_at` too").of(&[
                key("block", Text, "block that is off its place"),
                key("offset", Pair, "error of its centre of gravity, across gravity; its loads are off to the side that turns it the same way").unit("m"),
            ]),
            key("mechanism", Motions, "motion with which it then falls"),
            key("blocks", Objects, "for each block, how far it alone may be off while all others are in place").of(&[
                key("block", Text, "block that is off its place"),
                key("proved", Number, "the frame stands if only this block is off by up to this").unit("m"),
            ]),
        ]),
        key("cases", Objects, "load cases; the answers to questions, such as margins and capacity, hold in all of them; the forces are those of the worst case").when("if the scene has load cases").of(&[
            key("id", Text, "name of the case"),
            key("verdict", Word(&["stable", "undecided", "unstable"]), "verdict in this case"),
            key("load_factor", Margin, "largest factor on the loads in this case").when(IF_MARGIN_REQUESTED),
            key("tilt", Object, "largest turns of gravity in this case").when(IF_MARGIN_REQUESTED).of(TILT_SIDES),
            key("movements", Objects, "how the structure follows each movement of a support in this case").when("if the scene lists `movements` and the frame stands in this case").of(MOVEMENT),
        ]),
        key("governing_case", Text, "the worst case: that with the worst verdict, then the least load factor").when("if the scene has load cases"),
        key("envelope", Objects, "the least and the greatest forces at each interface in the listed balances of all cases").when("if the scene has load cases").of(&[
            INTERFACE,
            key("normal", Pair, "least and greatest sum of the normal forces").unit("N"),
            key("friction", Pair, "least and greatest friction force").unit("N"),
        ]),
        key("conditions", Object, "the conditions that decide the answers: load cases, and positions of the vehicle").when("if the scene has load cases, or a vehicle and the frame stands without it").of(&[
            key("margins", Object, "for each margin, the conditions that decide the lower and the upper end of its interval").when(IF_MARGINS_REQUESTED).of(&CONDITIONS),
            key("placement", Objects, "the conditions that decide the proved tolerance, and the errors with which the frame falls").when("with `--placement`, if the frame stands").of(CONDITION),
            key("removable", Objects, "for each row of `removable`, the condition that decides it").when("with `--removable`").of(CONDITION),
            key("capacity", Objects, "for each edge of `capacity`, the condition that decides it").when("with `--capacity`, if the set has edges").of(CONDITION),
        ]),
        key("movements", Objects, "how the structure follows each movement of a support, for small displacements; a joint that slides also opens, by μ times the slip").when("if the scene lists `movements` and the frame stands").of(MOVEMENT),
        key("removable", Objects, "for each placed block, in the order of placing, whether it may leave").when("with `--removable`").of(&[
            key("block", Text, "block"),
            key("stands", FlagOrOpen, "whether the rest stands without the block and without the robot that holds it"),
            key("force", Number, "least force with which a robot must hold the block, at its grip point or else at its centroid, while its joints still touch, so that the whole frame stands; 0 if it stands without this robot").unit("N").when("if a force suffices"),
            key("help", Object, "least help with which the rest stands: one more robot that holds one other block at its centroid").when("if the rest falls, and one robot can help").of(&[
                key("block", Text, "block that the robot holds"),
                key("force", Number, "least force of the robot").unit("N"),
            ]),
        ]),
        key("vehicle", Object, "influence line of the vehicle: the largest load factor for each of its positions").when("if the scene has a `vehicle` and the frame stands without it").of(&[
            key("governing", Count, "index in `positions`, from 0, of the position with the least factor").when("if some factor is limited"),
            key("mechanism", Motions, "motion just beyond this factor"),
            key("positions", Objects, "positions that were analysed, in the order of travel").of(&[
                key("at", Number, "coordinate of the first axle: x if gravity points downwards").unit("m"),
                key("toward", Word(&["right", "left"]), "direction of travel"),
                key("factor", Bound, "largest factor on the weight of the vehicle and on all loads that are not fixed with which the frame is proved to stand"),
                key("axles", Objects, "axles on the structure").of(&[
                    key("axle", Count, "index of the axle, from 0"),
                    key("block", Text, "block below the axle"),
                    key("at", Pair, "point at which it stands").unit("m"),
                ]),
            ]),
        ]),
        key("verdict_without_vehicle", Word(&["stable"]), "verdict on the frame without its vehicle; all other results are those with the axles as loads").when("if the frame stands only without its vehicle"),
        key("governing_position", Count, "index in `vehicle.positions`, from 0, of the position of the vehicle to which the results belong").when("if the frame stands only without its vehicle, and has an influence line"),
        key("only_by_wedging", FlagOrOpen, "whether the frame stands only because blocks press on each other although no load presses them together; null if undecided, with the reason in `effects`").when("with `--wedging`, if the frame stands"),
        key("wedging", Object, "proof that the frame stands only by wedging").when("with `--wedging`, if `only_by_wedging` is `true`").of(&[
            key("must_press", Objects, "interfaces that open or slide if the springs give way; in every balance, their normal forces sum to at least `normal_force_at_least`, if a bound was found").of(&[
                INTERFACE,
                key("bodies", Names, "bodies of the interface"),
            ]),
            key("normal_force_at_least", Number, "lower bound of the sum of the normal forces in `must_press`").unit("N").when("if a bound was found"),
            key("bound", Objects, "motion that proves this bound").when("if a bound was found").of(MOVING_BLOCK),
            key("gives_way", Objects, "motion of the blocks if all contacts are springs without initial stress").of(MOVING_BLOCK),
            key("presses_nothing", Flag, "whether the motion `gives_way` compresses no interface"),
            key("cases", Count, "number of cases that were ruled out"),
            key("ruled_out", Objects, "cases of pressing and sliding in which springs at the contacts cannot be at rest; together they cover all").of(&[
                key("points", Objects, "application points that the case fixes").of(&[
                    INTERFACE,
                    key("point", Count, "index of the application point, 0 or 1"),
                    key("presses", Flag, "whether the point presses"),
                ]),
                key("faces", Objects, "interfaces with friction that the case fixes").of(&[
                    INTERFACE,
                    key("slides", Text, "`forth`: it slides along (−n_y, n_x), where n is the normal of the interface; `back`: in the opposite direction; `sticks`: it does not slide"),
                ]),
            ]),
        ]),
        key("effects", Objects, "effects that were considered for this frame").of(&[
            key("effect", Text, "`weight`, `contact`, `friction`, `kernel`, `robots`, `robot torque`, `loads`, `corner contacts`, `sticking`, `mechanism`, `margins` or `wedging`; also `placement`, `movements` and `vehicle` if they are computed"),
            key("simulated", Flag, "whether it was simulated"),
            key("why", Text, "reason"),
            key("unknowns", Count, "number of unknowns that the effect adds, or would have added"),
        ]),
        key("proof", Object, "how exactly the verdict is proved: by forces if the frame stands, by a motion if it falls, by either if it is undecided").of(&[
            key("worst_imbalance", Number, "largest imbalance of a block: it balances if each force on it changes by at most this share of its magnitude and moves by at most this share of the block's radius").when("in a proof by forces"),
            key("worst_share", Number, "largest unbalanced force on a block, as a share of the load on this block").when("in a proof by forces"),
            key("worst_pull", Number, "largest tension at an application point, as a share of the forces at this contact").when("in a proof by forces"),
            key("worst_slip", Number, "largest excess of friction over μN, as a share of the forces at this contact, or of a robot's force or torque over its limit, as a share of it").when("in a proof by forces"),
            key("power", Number, "lower bound of the power of the loads along the motion, less what robots can absorb; as a share of the loads on the moving blocks, each weighted by the speed of its block").when("in a proof by a motion"),
            key("worst_violation", Number, "largest velocity against which an admissible force could act, relative to the fastest point").when("in a proof by a motion"),
            key("no_balance_below", Bound, "forces whose sum is below this multiple of the loads on the moving blocks cannot balance the blocks; `\"unbounded\"` if no forces can").when("in a proof by a motion"),
            key("exact", Flag, "whether forces or a motion prove the verdict in exact arithmetic; if not, a notice says what is missed").when("with `--certificate`, `--accuracy proved` or `--accuracy exact`"),
        ]),
        key("solve", Object, "how the verdict was found").of(&[
            key("method", Text, "method that decided: `closed form`, `kinematic`, `kinematic, refined`, `least residual` or `least sticking`"),
            key("iterations", Count, "iterations of the solvers"),
            key("programs", Count, "linear programs solved for the verdict and the forces"),
            key("groups", Count, "separate groups of blocks, which cannot influence each other"),
            key("reused", Count, "groups whose result was reused from an earlier frame"),
            key("seconds", Number, "time for the whole frame; only this value and `stages` may differ from run to run").unit("s").when("unless `--no-timing`"),
            key("stages", Object, "time of each stage").when("unless `--no-timing`").of(&[
                key("assembly", Number, "assembling the frame").unit("s"),
                key("solution", Number, "solving and proving").unit("s"),
                key("wedging", Number, "test for wedging; 0 if it was not requested").unit("s"),
                key("placement", Number, "placement tolerance").unit("s").when("with `--placement`"),
                key("margins", Number, "margins; 0 if they were not requested").unit("s"),
            ]),
        ]),
        key("notices", NameList, "remarks on this frame, in sentences for people").when("if there are notices"),
    ]),
];

/// Every key of the object that replaces the result of a refused file.
#[rustfmt::skip]
pub static REFUSAL_KEYS: &[Key] = &[
    key("file", Text, "path of the file as given"),
    key("problems", Objects, "all problems of the file, at least one").of(&[
        key("code", Text, "kind of problem, one of the codes below"),
        key("path", Text, "place in the scene, for example `blocks[3].polygon[1]`; empty for the whole file"),
        key("line", Place, "line in the file, from 1; null if there is none"),
        key("column", Place, "column in characters, from 1; null if there is none"),
        key("message", Text, "problem in words, with its numbers"),
        key("hint", Text, "how to remove the problem"),
    ]),
];
