//! [`KEYS`]: every key of a result with its type, unit and meaning. [`schema`] makes a JSON Schema from them.
//!
//! A test reads the results of many scenes. It fails if one of their keys is missing here, or if a key listed here
//! never occurs.

use serde_json::{Value, json};

pub use super::value_type::Type;
use crate::scene::Code;

/// A key of a result.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its path, for example `frames[].robots[].force`; `*` stands for the name of any robot.
    pub path: &'static str,
    /// The type of its value.
    pub kind: Type,
    /// The unit of the value; empty if it has no unit.
    pub unit: &'static str,
    /// The condition under which the key is present; empty if it is always present.
    pub when: &'static str,
    /// Its meaning.
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
/// The condition for keys that are only present if this margin was requested. A request without names requests all
/// margins.
const NAMED: &str = "where requested";

/// Every key of a result, in the order in which a result has them.
#[rustfmt::skip]
pub const KEYS: &[Key] = &[
    key("drystone", Type::Text, "", "", "version of the program"),
    key("file", Type::Text, "", "from the command line", "the path as given, with the file's name where that is a folder; `-` for standard input"),
    key("scene", Type::Text, "", "", "the scene's title; empty where it has none"),
    key("contact_tolerance", Type::Object, "", "", "how close two edges must be to touch, and which corners were moved within that distance"),
    key("contact_tolerance.gap", Type::Number, "m", "", "edges at most this far apart touch; 0 on a lattice"),
    key("contact_tolerance.from", Type::Word(&["lattice", "given", "decimals", "significant_digits", "float32", "size", "noise"]), "", "", "the source of the tolerance: the lattice (exact), a given value, or an estimate from the way coordinates are written or from the size of the scene"),
    key("contact_tolerance.digits", Type::Count, "", "from decimals or digits", "the number of digits of the coordinates"),
    key("contact_tolerance.healed_within", Type::Number, "m", "", "corners and edges at most this far apart were merged"),
    key("contact_tolerance.moved_corners", Type::Count, "", "", "the number of corners that were moved by the merging"),
    key("contact_tolerance.largest_move", Type::Number, "m", "", "the largest distance by which a corner was moved"),
    key("notes", Type::Objects, "", "where there are some, unless `--no-notes`", "what the scene may contain but its author probably did not intend"),
    key("notes[].code", Type::Text, "", "", "the kind of note, one of the codes listed below"),
    key("notes[].path", Type::Text, "", "", "the place in the scene, for example `robots[0].at`"),
    key("notes[].line", Type::Place, "", "", "line in the text, from 1; null where there is none"),
    key("notes[].message", Type::Text, "", "", "what was found"),
    key("notes[].hint", Type::Text, "", "", "how to change it, and how to silence the note"),
    key("frames", Type::Objects, "", "", "one for each step; one for a scene without steps"),
    key("frames[].title", Type::Text, "", "", "the step's title; empty where it has none"),
    key("frames[].verdict", Type::Word(&["stable", "unstable", "undecided"]), "", "", "stable: admissible forces balance all blocks; unstable: a collapse mechanism exists; undecided: neither is proved"),
    key("frames[].doubt", Type::Text, "", "where there is one", "why the frame is undecided"),
    key("frames[].length", Type::Number, "m", "", "the length L that turns torques into forces in the sums: the median length of the frame's interfaces without corner contacts (the shorter of the two in the middle); in a frame without interfaces the square root of the median block's area; 1 in an empty frame"),
    key("frames[].total_force", Type::Number, "N", "", "sum of the amounts of all forces, Σ(N₁ + N₂ + \\|T\\|) + Σ(\\|Fx\\| + \\|Fy\\| + \\|M\\|/L)"),
    key("frames[].total_force_least", Type::Flag, "", "where `false`", "whether that sum is the least possible sum"),
    key("frames[].total_force_bound", Type::Number, "N", "where it stands and a bound was found", "a lower bound of `total_force` for all balances, from a motion of the blocks (weak duality)"),
    key("frames[].total_sticking", Type::Number, "N", "", "the same sum over the missing forces in `failures`; 0 where stable, where no adhesion would help (`unsupported`), and with `--verdict-only`, which does not compute it"),
    key("frames[].weight", Type::Number, "N", "", "the weight of all placed blocks"),
    key("frames[].blocks", Type::Objects, "", "with `--blocks`", "the placed blocks, in the order in which they were placed"),
    key("frames[].blocks[].id", Type::Text, "", "", "the block"),
    key("frames[].blocks[].centre", Type::Pair, "m", "", "the point at which its weight acts"),
    key("frames[].blocks[].area", Type::Number, "m²", "", "the area of its outline without holes"),
    key("frames[].blocks[].weight", Type::Number, "N", "", "its weight"),
    key("frames[].blocks[].vertices", Type::Points, "m", "", "the corners of its outline, anticlockwise, after the merging of corners"),
    key("frames[].blocks[].holes", Type::Rings, "m", "where there are some", "the corners of each hole"),
    key("frames[].interfaces", Type::Objects, "", "", "the contacts between bodies; forces act on `bodies[0]`"),
    key("frames[].interfaces[].bodies", Type::Names, "", "", "the two bodies that touch; `ground` is the ground"),
    key("frames[].interfaces[].kind", Type::Word(&["corner"]), "", "at corner contacts", "a corner that touches an edge or another corner"),
    key("frames[].interfaces[].ends", Type::Pairs, "m", "", "the two ends of the interface"),
    key("frames[].interfaces[].application_points", Type::Pairs, "m", "", "where its two normal forces act: the ends, moved inward by the kernel"),
    key("frames[].interfaces[].normal", Type::Pair, "", "", "the unit normal, which points into `bodies[0]`"),
    key("frames[].interfaces[].mu", Type::Number, "", "", "friction coefficient"),
    key("frames[].interfaces[].normal_forces", Type::Pair, "N", "", "the two normal forces, at least 0"),
    key("frames[].interfaces[].friction_force", Type::Number, "N", "", "the friction force, positive along (−n_y, n_x), where n is the normal"),
    key("frames[].interfaces[].resultant", Type::Object, "", "", "the sum of the forces at the interface"),
    key("frames[].interfaces[].resultant.at", Type::Pair, "m", "", "the point at which it acts"),
    key("frames[].interfaces[].resultant.force", Type::Pair, "N", "", "the force"),
    key("frames[].interfaces[].friction_used", Type::Number, "", "", "the friction force as a share of the largest possible friction μN, from 0 to 1; 0 without friction; in a falling frame for the balance that includes the missing forces"),
    key("frames[].robots", Type::Objects, "", "", "the robots that hold a block in this frame, in the order of the scene"),
    key("frames[].robots[].id", Type::Text, "", "", "the robot"),
    key("frames[].robots[].holds", Type::Text, "", "", "the block it holds"),
    key("frames[].robots[].at", Type::Pair, "m", "", "its grip point"),
    key("frames[].robots[].force", Type::Pair, "N", "", "its force on the block"),
    key("frames[].robots[].torque", Type::Number, "N·m", "", "its torque on the block, anticlockwise positive"),
    key("frames[].robots[].limit_used", Type::Number, "", "", "the largest share of a limit that the robot uses, from 0 to 1; 0 for a robot without limits, or with all limits 0; in a falling frame for the balance that includes the missing forces"),
    key("frames[].failures", Type::Objects, "", "", "the forces that are missing, where the structure would have to stick together; empty where stable; blocks that are `unsupported` have none"),
    key("frames[].failures[].kind", Type::Word(&["tension", "friction", "robot_force", "robot_torque"]), "", "", "a contact that opens, a contact that slides, a force or a torque that a robot cannot give"),
    key("frames[].failures[].bodies", Type::Names, "", "at contacts", "the two bodies in contact"),
    key("frames[].failures[].robot", Type::Text, "", "at robots", "the robot"),
    key("frames[].failures[].holds", Type::Text, "", "at robots", "the block it holds"),
    key("frames[].failures[].at", Type::Pair, "m", "", "the point at which the force is missing"),
    key("frames[].failures[].force", Type::Pair, "N", "unless a torque is missing", "the missing force, on `bodies[0]` or on the block"),
    key("frames[].failures[].torque", Type::Number, "N·m", "where a torque is missing", "the missing torque"),
    key("frames[].failures[].amount", Type::Number, "N or N·m", "", "the size of the missing force; \\|Fx\\| + \\|Fy\\| for a robot; in N·m for a torque"),
    key("frames[].unsupported", Type::NameList, "", "where there are some", "blocks that would fall even if all contacts and grips could stick"),
    key("frames[].mechanism", Type::Motions, "", "", "the velocities of the blocks as the collapse begins; empty where stable"),
    key("frames[].margins", Type::Object, "", ASKED, "the distance of the frame from collapse; a margin is null if the frame stands at no value, or if no value was confirmed, which a notice says"),
    key("frames[].margins.friction", Type::Margin, "", NAMED, "the least friction coefficient, the same at all interfaces, at which the frame stands"),
    key("frames[].margins.tilt", Type::Object, "", NAMED, "the largest turn of gravity at which the frame stands; null if it falls without a turn"),
    key("frames[].margins.tilt.left", Type::Margin, "°", "", "gravity turns to the left (clockwise)"),
    key("frames[].margins.tilt.right", Type::Margin, "°", "", "gravity turns to the right (anticlockwise)"),
    key("frames[].margins.horizontal_load", Type::Object, "", NAMED, "the largest horizontal force on every block, as a share of its weight"),
    key("frames[].margins.horizontal_load.left", Type::Margin, "", "", "to the left"),
    key("frames[].margins.horizontal_load.right", Type::Margin, "", "", "to the right"),
    key("frames[].margins.kernel", Type::Margin, "", NAMED, "the largest kernel"),
    key("frames[].margins.load_factor", Type::Margin, "", NAMED, "the largest factor on the loads; null also for a frame without loads"),
    key("frames[].margins.robots", Type::ByRobot, "", "", "the least limits of each robot that holds a block, by its name; empty if they were not requested"),
    key("frames[].margins.robots.*.fx", Type::Margin, "N", "", "the least sufficient limit of its horizontal force"),
    key("frames[].margins.robots.*.fy", Type::Margin, "N", "", "the least sufficient limit of its vertical force"),
    key("frames[].margins.robots.*.torque", Type::Margin, "N·m", "", "the least sufficient limit of its torque"),
    key("frames[].margins.intervals", Type::Object, "", "", "for each parameter the interval of values at which the frame stands, with all else unchanged; `null` at an end: no limit; `null` for an interval: it stands at no value; `\"withheld\"`: not confirmed by a verdict, and a notice says why"),
    key("frames[].margins.intervals.friction", Type::Interval, "", NAMED, "the friction coefficient, the same at all interfaces, from 0 to 1000"),
    key("frames[].margins.intervals.tilt", Type::Interval, "°", NAMED, "the turn of gravity, negative to the left; loads do not turn"),
    key("frames[].margins.intervals.horizontal_load", Type::Interval, "", NAMED, "the horizontal force on every block as a share of its weight, negative to the left"),
    key("frames[].margins.intervals.kernel", Type::Interval, "", NAMED, "the kernel, from 0 to 1; no upper end if the frame stands at 1"),
    key("frames[].margins.intervals.load_factor", Type::Interval, "", "where requested and there are loads", "the factor on the loads, at least 0; 1 stands for the loads of the scene"),
    key("frames[].margins.intervals.robots", Type::ByRobot, "", "where requested and robots hold blocks", "the limits of each robot by its name; each limit is varied alone"),
    key("frames[].margins.intervals.robots.*.fx", Type::Interval, "N", "", "the limit of its horizontal force"),
    key("frames[].margins.intervals.robots.*.fy", Type::Interval, "N", "", "the limit of its vertical force"),
    key("frames[].margins.intervals.robots.*.torque", Type::Interval, "N·m", "", "the limit of its torque"),
    key("frames[].margins.excluded", Type::Object, "", "where an interval is `null`", "why the frame stands at no value: the values that one motion excludes, for as many motions as are needed to exclude all values; for two conflicting parts one motion below a value and one above a smaller value"),
    key("frames[].margins.excluded.friction", Type::Exclusions, "", "where that interval is `null`", "for the friction coefficient; up to 1000, the largest one that is tried"),
    key("frames[].margins.excluded.tilt", Type::Exclusions, "°", "where that interval is `null`", "for the turn of gravity; the ranges cover a full turn"),
    key("frames[].margins.excluded.horizontal_load", Type::Exclusions, "", "where that interval is `null`", "for the horizontal load"),
    key("frames[].margins.excluded.kernel", Type::Exclusions, "", "where that interval is `null`", "for the kernel"),
    key("frames[].margins.excluded.load_factor", Type::Exclusions, "", "where that interval is `null`", "for the factor on the loads"),
    key("frames[].margins.excluded.robots", Type::ByRobot, "", "where an interval of a limit is `null`", "for the limits of robots, by their names"),
    key("frames[].margins.excluded.robots.*.fx", Type::Exclusions, "N", "where that interval is `null`", "for the limit of its horizontal force"),
    key("frames[].margins.excluded.robots.*.fy", Type::Exclusions, "N", "where that interval is `null`", "for the limit of its vertical force"),
    key("frames[].margins.excluded.robots.*.torque", Type::Exclusions, "N·m", "where that interval is `null`", "for the limit of its torque"),
    key("frames[].margins.notes", Type::NameList, "", "where there are some", "remarks on the intervals, one sentence each"),
    key("frames[].margins.mechanisms", Type::Object, "", "", "the motion of the blocks just beyond each margin; empty for a margin that is unbounded or null"),
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
    key("frames[].margins.mechanisms.intervals", Type::Object, "", "", "the motion of the blocks just beyond each end of an interval; where an interval is `null`, see `excluded`"),
    key("frames[].margins.mechanisms.intervals.tilt", Type::MotionPairs, "", "where there is such an interval", "beyond the ends of the tilt"),
    key("frames[].margins.mechanisms.intervals.horizontal_load", Type::MotionPairs, "", "where there is such an interval", "beyond the ends of the horizontal load"),
    key("frames[].margins.mechanisms.intervals.load_factor", Type::MotionPairs, "", "where there is such an interval", "beyond the ends of the factor on the loads"),
    key("frames[].sensitivity", Type::Object, "", "with `--sensitivity`", "how the ends of one margin change with vertices, weights, friction and loads: exact derivatives with the contacts kept. Where forces and mechanism are not unique, the margin may have a kink: then its derivatives backward and forward are given, or `at_kink` if they were not computed"),
    key("frames[].sensitivity.parameter", Type::Word(&["friction", "tilt", "horizontal_load", "kernel", "load_factor"]), "", "", "the margin"),
    key("frames[].sensitivity.ends", Type::Objects, "", "", "the ends of its interval that have a value and a mechanism"),
    key("frames[].sensitivity.ends[].end", Type::Word(&["low", "high"]), "", "", "which end of the interval"),
    key("frames[].sensitivity.ends[].value", Type::Number, "", "", "the value there, in the unit of the margin"),
    key("frames[].sensitivity.ends[].vertices", Type::Objects, "", "", "each vertex of each placed block"),
    key("frames[].sensitivity.ends[].vertices[].block", Type::Text, "", "", "the block"),
    key("frames[].sensitivity.ends[].vertices[].vertex", Type::Count, "", "", "the number of the vertex in the outline, from 0 and anticlockwise; those of holes follow"),
    key("frames[].sensitivity.ends[].vertices[].at", Type::Pair, "m", "", "its position"),
    key("frames[].sensitivity.ends[].vertices[].with", Type::NameList, "", "", "the other bodies whose vertices move with it, so that no joint opens"),
    key("frames[].sensitivity.ends[].vertices[].moves", Type::Word(&["freely", "along", "not"]), "", "", "whether it can move freely, only along an edge of another body, or not at all without opening or bending a joint"),
    key("frames[].sensitivity.ends[].vertices[].along", Type::Pair, "", "where `moves` is `along`", "the unit vector along the edge"),
    key("frames[].sensitivity.ends[].vertices[].unique", Type::Flag, "", "", "whether the derivative is the same in both directions"),
    key("frames[].sensitivity.ends[].vertices[].slope", Type::SlopePair, "1/m", "", "the change of the value per metre along x and along y; for a vertex that moves along an edge, the part along the edge"),
    key("frames[].sensitivity.ends[].weights", Type::Objects, "", "", "each placed block"),
    key("frames[].sensitivity.ends[].weights[].block", Type::Text, "", "", "the block"),
    key("frames[].sensitivity.ends[].weights[].unique", Type::Flag, "", "", "whether the derivative is the same in both directions"),
    key("frames[].sensitivity.ends[].weights[].slope", Type::Slope, "1/N", "", "the change of the value per newton of its weight; its centroid stays"),
    key("frames[].sensitivity.ends[].friction", Type::Objects, "", "", "each interface; empty for the margin of friction, which sets all coefficients"),
    key("frames[].sensitivity.ends[].friction[].interface", Type::Count, "", "", "its number in `interfaces`, from 0"),
    key("frames[].sensitivity.ends[].friction[].bodies", Type::Names, "", "", "the two bodies"),
    key("frames[].sensitivity.ends[].friction[].unique", Type::Flag, "", "", "whether the derivative is the same in both directions"),
    key("frames[].sensitivity.ends[].friction[].slope", Type::Slope, "", "", "the change of the value per unit of its friction coefficient"),
    key("frames[].sensitivity.ends[].friction_of_all", Type::Object, "", "unless the margin is that of friction", "if all coefficients change by the same amount"),
    key("frames[].sensitivity.ends[].friction_of_all.unique", Type::Flag, "", "", "whether the derivative is the same in both directions"),
    key("frames[].sensitivity.ends[].friction_of_all.slope", Type::Slope, "", "", "the change of the value per unit of the coefficients"),
    key("frames[].sensitivity.ends[].loads", Type::Objects, "", "", "each load on a placed block"),
    key("frames[].sensitivity.ends[].loads[].load", Type::Count, "", "", "its number in `loads` of the scene, from 0"),
    key("frames[].sensitivity.ends[].loads[].block", Type::Text, "", "", "its block"),
    key("frames[].sensitivity.ends[].loads[].at", Type::Pair, "m", "", "its point"),
    key("frames[].sensitivity.ends[].loads[].unique", Type::Flag, "", "", "whether the derivative is the same in both directions"),
    key("frames[].sensitivity.ends[].loads[].slope", Type::SlopePair, "1/m", "", "the change of the value per metre that the point moves along x and along y"),
    key("frames[].sensitivity.without_value", Type::Objects, "", "", "the ends without a value"),
    key("frames[].sensitivity.without_value[].end", Type::Word(&["low", "high"]), "", "", "which end of the interval"),
    key("frames[].sensitivity.without_value[].reason", Type::Word(&["not_applicable", "stands_at_no_value", "unbounded", "range_ends", "unconfirmed", "unsolved"]), "", "", "why: the frame has no loads; it falls at every value; it stands at every value in this direction; the range of the parameter ends here; no verdict confirms the end; forces and mechanism were not computed"),
    key("frames[].capacity", Type::Object, "", "with `--capacity`, where the block is placed", "all forces (Fx, Fy) that may act on the block at this point, in addition to what acts already, such that the frame stands: the convex hull of `vertices`, extended without end along `rays`"),
    key("frames[].capacity.block", Type::Text, "", "", "the block"),
    key("frames[].capacity.at", Type::Points, "m", "", "the point at which the force acts; or the two points of a free contact, whose resultant it is"),
    key("frames[].capacity.robot", Type::Text, "", "where it is the force of a robot", "the robot that holds the block there; the limits of its force do not count"),
    key("frames[].capacity.shape", Type::Word(&["empty", "point", "segment", "polygon", "unbounded", "everything"]), "", "", "the kind of set"),
    key("frames[].capacity.stands_without", Type::Flag, "", "", "whether the frame stands without the force: whether (0, 0) belongs to the set"),
    key("frames[].capacity.vertices", Type::Points, "N", "", "its corners, anticlockwise; each is proved by forces"),
    key("frames[].capacity.rays", Type::Points, "", "", "the unit directions in which it has no end, anticlockwise; empty if it is bounded"),
    key("frames[].capacity.edges", Type::Objects, "", "", "its edges, anticlockwise; each is proved by a motion"),
    key("frames[].capacity.edges[].from", Type::Index, "", "", "the vertex at which it begins, from 0; null where it has no end"),
    key("frames[].capacity.edges[].to", Type::Index, "", "", "the vertex at which it ends"),
    key("frames[].capacity.edges[].normal", Type::Pair, "", "", "its unit normal, which points out of the set"),
    key("frames[].capacity.edges[].limit", Type::Number, "N", "", "the largest force along the normal"),
    key("frames[].capacity.edges[].mechanism", Type::Motions, "", "", "the motion of the blocks just beyond it"),
    key("frames[].capacity.edges[].case", Type::Count, "", "", "the extreme case of `--for-all` that it belongs to, from 0"),
    key("frames[].capacity.balances", Type::Objects, "", "unless `--for-all` gives more than one case", "the forces that prove each vertex, in the order of `vertices`"),
    key("frames[].capacity.balances[].torque", Type::Number, "N·m", "", "the torque of a free contact about its first point; 0 at one point"),
    key("frames[].capacity.balances[].interfaces", Type::Objects, "", "", "the interfaces of the blocks that influence the block"),
    key("frames[].capacity.balances[].interfaces[].interface", Type::Count, "", "", "its number in `interfaces`, from 0"),
    key("frames[].capacity.balances[].interfaces[].normal_forces", Type::Pair, "N", "", "the two normal forces"),
    key("frames[].capacity.balances[].interfaces[].friction_force", Type::Number, "N", "", "the friction force"),
    key("frames[].capacity.mechanism", Type::Motions, "", "where it is empty because a motion shows it", "how the frame falls whatever the force is"),
    key("frames[].capacity.gap", Type::Number, "N", "", "the largest distance from the proved forces of a force that no motion excludes; at most a millionth of the size of the set or a few billionths of the heaviest load"),
    key("frames[].capacity.cases", Type::Count, "", "", "the number of extreme cases whose sets were intersected; 1 without `--for-all`"),
    key("frames[].only_by_wedging", Type::FlagOrOpen, "", "with `--wedging`, where it stands", "whether the frame stands only because blocks are wedged: they press on each other although no load presses them together; null if this could not be decided, with the reason in the effect"),
    key("frames[].wedging", Type::Object, "", "with `--wedging`, where `only_by_wedging` is `true`", "the proof of it"),
    key("frames[].wedging.must_press", Type::Objects, "", "", "interfaces that must carry a normal force in every balance although no load causes one"),
    key("frames[].wedging.must_press[].interface", Type::Count, "", "", "its number in `interfaces`, from 0"),
    key("frames[].wedging.must_press[].bodies", Type::Names, "", "", "the two bodies"),
    key("frames[].wedging.normal_force_at_least", Type::Number, "N", "where a bound was found", "a lower bound of the sum of their normal forces"),
    key("frames[].wedging.bound", Type::Objects, "", "where a bound was found", "the motion that proves the bound"),
    key("frames[].wedging.bound[].block", Type::Text, "", "", "the block"),
    key("frames[].wedging.bound[].at", Type::Pair, "m", "", "the point at which the velocity is given"),
    key("frames[].wedging.bound[].velocity", Type::Pair, "", "", "its velocity there"),
    key("frames[].wedging.bound[].spin", Type::Number, "1/m", "", "its spin, anticlockwise"),
    key("frames[].wedging.gives_way", Type::Objects, "", "", "the motion of the blocks if the joints are slightly elastic"),
    key("frames[].wedging.gives_way[].block", Type::Text, "", "", "the block"),
    key("frames[].wedging.gives_way[].at", Type::Pair, "m", "", "the point at which the velocity is given"),
    key("frames[].wedging.gives_way[].velocity", Type::Pair, "", "", "its velocity there"),
    key("frames[].wedging.gives_way[].spin", Type::Number, "1/m", "", "its spin, anticlockwise"),
    key("frames[].wedging.presses_nothing", Type::Flag, "", "", "whether no interface presses in that motion"),
    key("frames[].wedging.cases", Type::Count, "", "", "the number of cases of pressing and sliding that were ruled out"),
    key("frames[].wedging.ruled_out", Type::Objects, "", "", "these cases; together they are all possible cases, and no springs at rest belong to any of them"),
    key("frames[].wedging.ruled_out[].points", Type::Objects, "", "", "the application points that the case restricts"),
    key("frames[].wedging.ruled_out[].points[].interface", Type::Count, "", "", "the number of its interface in `interfaces`, from 0"),
    key("frames[].wedging.ruled_out[].points[].point", Type::Count, "", "", "the application point of the interface, 0 or 1"),
    key("frames[].wedging.ruled_out[].points[].presses", Type::Flag, "", "", "whether the point presses"),
    key("frames[].wedging.ruled_out[].faces", Type::Objects, "", "", "the interfaces with friction that the case restricts"),
    key("frames[].wedging.ruled_out[].faces[].interface", Type::Count, "", "", "its number in `interfaces`, from 0"),
    key("frames[].wedging.ruled_out[].faces[].slides", Type::Text, "", "", "`forth` along (−n_y, n_x) of its normal, `back` against it, or `sticks`"),
    key("frames[].effects", Type::Objects, "", "", "the effects that were considered for this frame"),
    key("frames[].effects[].effect", Type::Text, "", "", "`weight`, `contact`, `friction`, `kernel`, `robots`, `robot torque`, `loads`, `corner contacts`, `sticking`, `mechanism`, `margins` or `wedging`"),
    key("frames[].effects[].simulated", Type::Flag, "", "", "whether the frame needs this effect"),
    key("frames[].effects[].why", Type::Text, "", "", "the reason"),
    key("frames[].effects[].unknowns", Type::Count, "", "", "the number of unknowns that it adds, or would have added"),
    key("frames[].proof", Type::Object, "", "", "how exactly the verdict is proved, computed from outlines, forces and motions alone: by forces where it stands, by a motion where it falls, by either where undecided"),
    key("frames[].proof.worst_imbalance", Type::Number, "", "of forces", "the smallest share such that the block balances if each force on it changes by at most this share of its amount and moves by at most this share of the block's radius; the largest value of all blocks"),
    key("frames[].proof.worst_share", Type::Number, "", "of forces", "the unbalanced force on a block as a share of its own load; the largest value of all blocks"),
    key("frames[].proof.worst_pull", Type::Number, "", "of forces", "the largest tension at a contact as a share of its forces"),
    key("frames[].proof.worst_slip", Type::Number, "", "of forces", "the largest excess of friction over μN, or of a robot's force over its limit, as a share of the forces there"),
    key("frames[].proof.power", Type::Number, "", "of a motion", "the power of the loads along the motion, less the power that robots can absorb, as a share of the loads on the moving blocks"),
    key("frames[].proof.worst_violation", Type::Number, "", "of a motion", "the largest velocity against which an admissible force could act; the fastest point moves with 1"),
    key("frames[].proof.no_balance_below", Type::Bound, "", "of a motion", "no forces whose sum is below this value balance the blocks, as a multiple of the loads on the moving blocks"),
    key("frames[].solve", Type::Object, "", "", "how the verdict was found"),
    key("frames[].solve.method", Type::Text, "", "", "the method that decided: `closed form`, `kinematic`, `kinematic, refined`, `least residual` or `least sticking`"),
    key("frames[].solve.iterations", Type::Count, "", "", "the number of iterations of the solvers"),
    key("frames[].solve.programs", Type::Count, "", "", "the number of programs that were solved"),
    key("frames[].solve.groups", Type::Count, "", "", "the number of groups of blocks that do not touch each other"),
    key("frames[].solve.reused", Type::Count, "", "", "the number of groups whose result was reused from an earlier frame"),
    key("frames[].solve.seconds", Type::Number, "s", "unless `--no-timing`", "the time taken; only this value and `stages` may differ from run to run"),
    key("frames[].solve.stages", Type::Object, "", "unless `--no-timing`", "the same time by stage"),
    key("frames[].solve.stages.assembly", Type::Number, "s", "", "assembling the bodies, contacts and loads of the frame"),
    key("frames[].solve.stages.solution", Type::Number, "s", "", "solving and proving: verdict, forces, failures, mechanism"),
    key("frames[].solve.stages.wedging", Type::Number, "s", "", "the test for wedging; 0 if it was not requested"),
    key("frames[].solve.stages.margins", Type::Number, "s", "", "the margins; 0 if they were not requested"),
    key("frames[].notices", Type::NameList, "", "where there are some", "remarks on this frame for a person"),
];

/// Every key of the object that replaces the result of a refused file.
#[rustfmt::skip]
pub const REFUSAL_KEYS: &[Key] = &[
    key("file", Type::Text, "", "", "the path as given"),
    key("problems", Type::Objects, "", "", "all problems of the file, at least one"),
    key("problems[].code", Type::Text, "", "", "the kind of problem, one of the codes listed below"),
    key("problems[].path", Type::Text, "", "", "the place in the scene, for example `blocks[3].polygon[1]`; empty for the whole file"),
    key("problems[].line", Type::Place, "", "", "line in the text, from 1; null where there is none"),
    key("problems[].column", Type::Place, "", "", "column in characters, from 1; null where there is none"),
    key("problems[].message", Type::Text, "", "", "the problem, with the numbers found"),
    key("problems[].hint", Type::Text, "", "", "the remedy"),
];

/// Returns the JSON Schema (draft 2020-12) of the output of `check --json` for one file: a result, or the problems of
/// a file that is not a valid scene.
///
/// Later versions add keys, so programs should accept unknown keys. The schema accepts them too.
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
        }, "exclusion": {
            "type": "object",
            "properties": {
                "from": described(Type::Number, "lower end of the values; null: no lower end"),
                "to": described(Type::Number, "upper end of the values; null: no upper end"),
                "mechanism": described(Type::Motions, "the motion with which the frame falls at these values"),
            },
            "required": ["from", "to", "mechanism"],
        } },
    });
    format!("{schema:#}\n")
}

fn described(kind: Type, meaning: &str) -> Value {
    let mut schema = kind.schema();
    schema["description"] = meaning.into();
    schema
}

/// Makes the schema of an object with these keys, and of the objects inside it.
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
