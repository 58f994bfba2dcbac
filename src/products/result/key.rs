//! [`KEYS`]: every key of a result with its type, unit and meaning. [`schema`] makes a JSON Schema from them.
//!
//! A test reads the results of many scenes. It fails if one of their keys is missing here, or if a key listed here
//! never occurs.

use serde_json::{Value, json};

pub use super::value_type::Type;
use crate::mechanics::scene::Code;

/// A key of a result.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// The path of the key, for example `frames[].robots[].force`; `*` stands for the name of any robot.
    pub path: &'static str,
    /// The type of the value.
    pub kind: Type,
    /// The unit of the value; empty if it has no unit.
    pub unit: &'static str,
    /// The condition under which the key is present; empty if it is always present.
    pub when: &'static str,
    /// The meaning of the value.
    pub meaning: &'static str,
}

const fn key(path: &'static str, kind: Type, unit: &'static str, when: &'static str, meaning: &'static str) -> Key {
    Key { path, kind, unit, when, meaning }
}

const IF_MARGINS_REQUESTED: &str = "with `--margins`";
/// The condition for keys that are only present if this margin was requested. A request without names requests all
/// margins.
const IF_MARGIN_REQUESTED: &str = "if requested";

/// Every key of a result, in the order in which a result has them.
#[rustfmt::skip]
pub const KEYS: &[Key] = &[
    key("drystone", Type::Text, "", "", "version of the program"),
    key("file", Type::Text, "", "from the command line", "path of the scene file as given; for a file in a given folder, the path of the folder and the name of the file; `-` for standard input"),
    key("scene", Type::Text, "", "", "title of the scene; empty if the scene has none"),
    key("contact_tolerance", Type::Object, "", "", "largest gap at which edges still touch, and how corners were moved"),
    key("contact_tolerance.gap", Type::Number, "m", "", "edges at most this far apart touch; 0 if all bodies consist of lattice cells"),
    key("contact_tolerance.from", Type::Word(&["lattice", "given", "decimals", "significant_digits", "float32", "size", "noise"]), "", "", "source of the tolerance: `lattice`, cells touch exactly; `given`, the scene file or the command line; `decimals`, `significant_digits`, `float32`, how coordinates are written; `size`, `noise`, the size of the scene"),
    key("contact_tolerance.digits", Type::Count, "", "if `from` is `decimals` or `significant_digits`", "number of these digits"),
    key("contact_tolerance.healed_within", Type::Number, "m", "", "distance within which corners were merged; 0 if coordinates are used as written"),
    key("contact_tolerance.moved_corners", Type::Count, "", "", "number of moved corners"),
    key("contact_tolerance.largest_move", Type::Number, "m", "", "largest move of a corner"),
    key("notes", Type::Objects, "", "if there are notes and `--no-notes` is not given", "what the author probably did not intend"),
    key("notes[].code", Type::Text, "", "", "kind of note, one of the codes below"),
    key("notes[].path", Type::Text, "", "", "place in the scene, for example `robots[0].at`"),
    key("notes[].line", Type::Place, "", "", "line in the scene file, from 1"),
    key("notes[].message", Type::Text, "", "", "what was found in the scene"),
    key("notes[].hint", Type::Text, "", "", "how to change the scene, and how to silence the note"),
    key("frames", Type::Objects, "", "", "one result for each step, or one for a scene without steps"),
    key("frames[].title", Type::Text, "", "", "title of the step; empty if it has none"),
    key("frames[].verdict", Type::Word(&["stable", "unstable", "undecided"]), "", "", "stable: admissible forces balance all blocks; unstable: a collapse mechanism exists; undecided: neither is proved"),
    key("frames[].doubt", Type::Text, "", "if the frame is undecided", "why the frame is undecided"),
    key("frames[].length", Type::Number, "m", "", "length L that turns torques into forces in the sums: median length of the interfaces without corner contacts (the shorter of the two in the middle); in a frame without interfaces the square root of the median block's area; 1 in an empty frame"),
    key("frames[].total_force", Type::Number, "N", "", "sum of all forces: Σ(N₁ + N₂ + \\|T\\|) over all interfaces, plus Σ(\\|Fx\\| + \\|Fy\\| + \\|M\\|/L) over all robots"),
    key("frames[].total_force_least", Type::Flag, "", "only if `false`", "whether `total_force` is the least possible sum"),
    key("frames[].total_force_bound", Type::Number, "N", "if the frame stands and a bound was found", "lower bound of `total_force` for all balances, from a motion (weak duality)"),
    key("frames[].total_sticking", Type::Number, "N", "", "sum of the missing forces in `failures`, computed like `total_force`; 0 if the frame stands, if no adhesion would help (`unsupported`), and with `--verdict-only`, which does not compute it"),
    key("frames[].weight", Type::Number, "N", "", "weight of all placed blocks"),
    key("frames[].blocks", Type::Objects, "", "with `--blocks`", "placed blocks, in the order of placing"),
    key("frames[].blocks[].id", Type::Text, "", "", "id of the block"),
    key("frames[].blocks[].centre", Type::Pair, "m", "", "point at which its weight acts"),
    key("frames[].blocks[].area", Type::Number, "m²", "", "area of the block, without its holes"),
    key("frames[].blocks[].weight", Type::Number, "N", "", "weight of the block"),
    key("frames[].blocks[].vertices", Type::Points, "m", "", "corners of its outline, anticlockwise, after healing"),
    key("frames[].blocks[].holes", Type::Rings, "m", "if the block has holes", "corners of each hole"),
    key("frames[].interfaces", Type::Objects, "", "", "contacts between bodies; forces act on `bodies[0]`"),
    key("frames[].interfaces[].bodies", Type::Names, "", "", "two bodies that touch; `ground` is the ground"),
    key("frames[].interfaces[].kind", Type::Word(&["corner"]), "", "at corner contacts", "a corner touches an edge or another corner"),
    key("frames[].interfaces[].ends", Type::Pairs, "m", "", "ends of the interface"),
    key("frames[].interfaces[].application_points", Type::Pairs, "m", "", "points of the normal forces: the ends, moved inward by the kernel"),
    key("frames[].interfaces[].normal", Type::Pair, "", "", "unit normal, which points into `bodies[0]`"),
    key("frames[].interfaces[].mu", Type::Number, "", "", "friction coefficient"),
    key("frames[].interfaces[].normal_forces", Type::Pair, "N", "", "normal forces at the two application points, at least 0"),
    key("frames[].interfaces[].friction_force", Type::Number, "N", "", "friction force, positive along (−n_y, n_x), where n is the normal"),
    key("frames[].interfaces[].resultant", Type::Object, "", "", "resultant of the forces at the interface"),
    key("frames[].interfaces[].resultant.at", Type::Pair, "m", "", "point at which it acts"),
    key("frames[].interfaces[].resultant.force", Type::Pair, "N", "", "force on `bodies[0]`"),
    key("frames[].interfaces[].friction_used", Type::Number, "", "", "friction force as a share of the largest possible friction μN, from 0 to 1; 0 without friction; in a falling frame for the balance that includes the missing forces"),
    key("frames[].robots", Type::Objects, "", "", "robots that hold a block in this frame, in the order of the scene"),
    key("frames[].robots[].id", Type::Text, "", "", "id of the robot"),
    key("frames[].robots[].holds", Type::Text, "", "", "block that it holds"),
    key("frames[].robots[].at", Type::Pair, "m", "", "grip point"),
    key("frames[].robots[].force", Type::Pair, "N", "", "force on the block"),
    key("frames[].robots[].torque", Type::Number, "N·m", "", "torque on the block, positive anticlockwise"),
    key("frames[].robots[].limit_used", Type::Number, "", "", "largest share of a limit that the robot uses, from 0 to 1; 0 for a robot without limits, or with all limits 0; in a falling frame for the balance that includes the missing forces"),
    key("frames[].failures", Type::Objects, "", "", "missing forces: what contacts and robots would have to exert beyond their limits; empty if the frame stands; none for `unsupported` blocks"),
    key("frames[].failures[].kind", Type::Word(&["tension", "friction", "robot_force", "robot_torque"]), "", "", "`tension`: a contact opens; `friction`: a contact slides; `robot_force`, `robot_torque`: a robot cannot exert the force or the torque"),
    key("frames[].failures[].bodies", Type::Names, "", "at a contact", "bodies in contact"),
    key("frames[].failures[].robot", Type::Text, "", "at a robot", "robot whose limit is exceeded"),
    key("frames[].failures[].holds", Type::Text, "", "at a robot", "block that it holds"),
    key("frames[].failures[].at", Type::Pair, "m", "", "point at which it is missing; for friction the middle of the interface"),
    key("frames[].failures[].force", Type::Pair, "N", "unless a torque is missing", "missing force, on `bodies[0]` or on the block"),
    key("frames[].failures[].torque", Type::Number, "N·m", "if a torque is missing", "missing torque on the block, positive anticlockwise"),
    key("frames[].failures[].amount", Type::Number, "N or N·m", "", "size of the missing force or torque; for a force of a robot \\|Fx\\| + \\|Fy\\|"),
    key("frames[].unsupported", Type::NameList, "", "if there are unsupported blocks", "blocks that would fall even if all contacts and grips could stick"),
    key("frames[].mechanism", Type::Motions, "", "", "velocities of the blocks as the collapse begins; empty if the frame stands"),
    key("frames[].margins", Type::Object, "", IF_MARGINS_REQUESTED, "how far the frame is from collapse: the extreme values at which it stands; a margin is null if the frame stands at no value, if the margin does not exist in this frame, or if no value was confirmed (a notice then says so)"),
    key("frames[].margins.friction", Type::Margin, "", IF_MARGIN_REQUESTED, "least friction coefficient, the same at all interfaces"),
    key("frames[].margins.tilt", Type::Object, "", IF_MARGIN_REQUESTED, "largest turns of gravity at which the frame stands; each is null if it falls without a turn"),
    key("frames[].margins.tilt.left", Type::Margin, "°", "", "to the left (clockwise)"),
    key("frames[].margins.tilt.right", Type::Margin, "°", "", "to the right (anticlockwise)"),
    key("frames[].margins.horizontal_load", Type::Object, "", IF_MARGIN_REQUESTED, "largest horizontal force on every block, as a share of its weight"),
    key("frames[].margins.horizontal_load.left", Type::Margin, "", "", "in this direction"),
    key("frames[].margins.horizontal_load.right", Type::Margin, "", "", "in this direction"),
    key("frames[].margins.kernel", Type::Margin, "", IF_MARGIN_REQUESTED, "largest kernel"),
    key("frames[].margins.load_factor", Type::Margin, "", IF_MARGIN_REQUESTED, "largest factor on the loads; null also without loads"),
    key("frames[].margins.robots", Type::ByRobot, "", "", "least limits of each robot that holds a block; empty if they were not requested"),
    key("frames[].margins.robots.*.fx", Type::Margin, "N", "", "least limit of its horizontal force"),
    key("frames[].margins.robots.*.fy", Type::Margin, "N", "", "least limit of its vertical force"),
    key("frames[].margins.robots.*.torque", Type::Margin, "N·m", "", "least limit of its torque"),
    key("frames[].margins.intervals", Type::Object, "", "", "for each parameter, the values at which the frame stands if all else is unchanged; an end is `null` if there is no limit; an interval is `null` if the frame stands at no value; `\"withheld\"` replaces what no verdict confirms, and a notice says why"),
    key("frames[].margins.intervals.friction", Type::Interval, "", IF_MARGIN_REQUESTED, "friction coefficient, the same at all interfaces, from 0 to 1000"),
    key("frames[].margins.intervals.tilt", Type::Interval, "°", IF_MARGIN_REQUESTED, "tilt of gravity, negative to the left; loads do not tilt"),
    key("frames[].margins.intervals.horizontal_load", Type::Interval, "", IF_MARGIN_REQUESTED, "horizontal force on every block as a share of its weight, negative to the left"),
    key("frames[].margins.intervals.kernel", Type::Interval, "", IF_MARGIN_REQUESTED, "kernel, from 0 to 1; without an upper end if the frame stands at 1"),
    key("frames[].margins.intervals.load_factor", Type::Interval, "", "if requested, with loads", "factor on the loads, at least 0; 1 stands for the loads of the scene"),
    key("frames[].margins.intervals.robots", Type::ByRobot, "", "if requested, with robots that hold blocks", "limits of each robot, each varied alone"),
    key("frames[].margins.intervals.robots.*.fx", Type::Interval, "N", "", "limit of its horizontal force"),
    key("frames[].margins.intervals.robots.*.fy", Type::Interval, "N", "", "limit of its vertical force"),
    key("frames[].margins.intervals.robots.*.torque", Type::Interval, "N·m", "", "limit of its torque"),
    key("frames[].margins.excluded", Type::Object, "", "if an interval is `null`", "why the frame stands at no value: motions, each with the values that it excludes; together they exclude all. If two parts of the frame conflict, one motion excludes the values below a limit, and the other those above a smaller limit"),
    key("frames[].margins.excluded.friction", Type::Exclusions, "", "if its interval is `null`", "they exclude all coefficients up to 1000, the largest that is tried"),
    key("frames[].margins.excluded.tilt", Type::Exclusions, "°", "if its interval is `null`", "they exclude all turns of gravity; the ranges cover a full turn"),
    key("frames[].margins.excluded.horizontal_load", Type::Exclusions, "", "if its interval is `null`", "they exclude all values"),
    key("frames[].margins.excluded.kernel", Type::Exclusions, "", "if its interval is `null`", "they exclude all values"),
    key("frames[].margins.excluded.load_factor", Type::Exclusions, "", "if its interval is `null`", "they exclude all values"),
    key("frames[].margins.excluded.robots", Type::ByRobot, "", "if its interval is `null`", "they exclude all values of a robot's limits"),
    key("frames[].margins.excluded.robots.*.fx", Type::Exclusions, "N", "if its interval is `null`", "they exclude all limits of its horizontal force"),
    key("frames[].margins.excluded.robots.*.fy", Type::Exclusions, "N", "if its interval is `null`", "they exclude all limits of its vertical force"),
    key("frames[].margins.excluded.robots.*.torque", Type::Exclusions, "N·m", "if its interval is `null`", "they exclude all limits of its torque"),
    key("frames[].margins.notes", Type::NameList, "", "if there are remarks", "remarks on the intervals, one sentence each"),
    key("frames[].margins.mechanisms", Type::Object, "", "", "motion just beyond each margin; empty for a margin that is unbounded or null, and for a margin that was not requested"),
    key("frames[].margins.mechanisms.friction", Type::Motions, "", "", "just below the least friction coefficient"),
    key("frames[].margins.mechanisms.tilt", Type::Object, "", "", "just beyond the largest tilts"),
    key("frames[].margins.mechanisms.tilt.left", Type::Motions, "", "", "to this side"),
    key("frames[].margins.mechanisms.tilt.right", Type::Motions, "", "", "to this side"),
    key("frames[].margins.mechanisms.horizontal_load", Type::Object, "", "", "just beyond the largest horizontal loads"),
    key("frames[].margins.mechanisms.horizontal_load.left", Type::Motions, "", "", "in this direction"),
    key("frames[].margins.mechanisms.horizontal_load.right", Type::Motions, "", "", "in this direction"),
    key("frames[].margins.mechanisms.kernel", Type::Motions, "", "", "just beyond the largest kernel"),
    key("frames[].margins.mechanisms.load_factor", Type::Motions, "", "", "just beyond the largest factor on the loads"),
    key("frames[].margins.mechanisms.robots", Type::ByRobot, "", "", "just below the least limits of each robot"),
    key("frames[].margins.mechanisms.robots.*.fx", Type::Motions, "", "", "just below this limit"),
    key("frames[].margins.mechanisms.robots.*.fy", Type::Motions, "", "", "just below this limit"),
    key("frames[].margins.mechanisms.robots.*.torque", Type::Motions, "", "", "just below this limit"),
    key("frames[].margins.mechanisms.intervals", Type::Object, "", "", "motions just beyond the lower and the upper end of an interval; if an interval is `null`, its motions are in `excluded`"),
    key("frames[].margins.mechanisms.intervals.tilt", Type::MotionPairs, "", "if it has an interval", "at the ends of this interval"),
    key("frames[].margins.mechanisms.intervals.horizontal_load", Type::MotionPairs, "", "if it has an interval", "at the ends of this interval"),
    key("frames[].margins.mechanisms.intervals.load_factor", Type::MotionPairs, "", "if it has an interval", "at the ends of this interval"),
    key("frames[].sensitivity", Type::Object, "", "with `--sensitivity`", "exact derivatives of the ends of one margin's interval with respect to vertices, weights, friction and loads, for unchanged contacts. If forces and mechanism are not unique, the margin may have a kink; the backward and the forward derivative are then given, or `at_kink` if they were not computed"),
    key("frames[].sensitivity.parameter", Type::Word(&["friction", "tilt", "horizontal_load", "kernel", "load_factor"]), "", "", "parameter of the margin"),
    key("frames[].sensitivity.ends", Type::Objects, "", "", "ends of the interval that have a value and a mechanism"),
    key("frames[].sensitivity.ends[].end", Type::Word(&["low", "high"]), "", "", "lower or upper end"),
    key("frames[].sensitivity.ends[].value", Type::Number, "", "", "value of the parameter: in degrees for the tilt, otherwise without a unit"),
    key("frames[].sensitivity.ends[].vertices", Type::Objects, "", "", "for each vertex of each placed block"),
    key("frames[].sensitivity.ends[].vertices[].block", Type::Text, "", "", "block of the vertex"),
    key("frames[].sensitivity.ends[].vertices[].vertex", Type::Count, "", "", "index of the vertex in the outline, from 0 and anticlockwise; the vertices of holes follow"),
    key("frames[].sensitivity.ends[].vertices[].at", Type::Pair, "m", "", "position of the vertex"),
    key("frames[].sensitivity.ends[].vertices[].with", Type::NameList, "", "", "other bodies whose vertices move with this one, so that no joint opens"),
    key("frames[].sensitivity.ends[].vertices[].moves", Type::Word(&["freely", "along", "not"]), "", "", "whether the vertex can move freely, only along an edge of another body, or not at all without opening or bending a joint"),
    key("frames[].sensitivity.ends[].vertices[].along", Type::Pair, "", "if `moves` is `along`", "unit vector along this edge"),
    key("frames[].sensitivity.ends[].vertices[].unique", Type::Flag, "", "", "whether both derivatives are equal"),
    key("frames[].sensitivity.ends[].vertices[].slope", Type::SlopePair, "1/m", "", "change of the value per metre by which the vertex moves along x and along y; if it can move only along an edge, a vector along this edge; null if it cannot move"),
    key("frames[].sensitivity.ends[].weights", Type::Objects, "", "", "for the weight of each placed block"),
    key("frames[].sensitivity.ends[].weights[].block", Type::Text, "", "", "block whose weight changes"),
    key("frames[].sensitivity.ends[].weights[].unique", Type::Flag, "", "", "whether both derivatives are equal"),
    key("frames[].sensitivity.ends[].weights[].slope", Type::Slope, "1/N", "", "change of the value per newton of weight; the centroid does not move"),
    key("frames[].sensitivity.ends[].friction", Type::Objects, "", "", "for the friction coefficient of each interface; empty for the friction margin, which sets all coefficients"),
    key("frames[].sensitivity.ends[].friction[].interface", Type::Count, "", "", "index in `interfaces`, from 0"),
    key("frames[].sensitivity.ends[].friction[].bodies", Type::Names, "", "", "bodies of the interface"),
    key("frames[].sensitivity.ends[].friction[].unique", Type::Flag, "", "", "whether both derivatives are equal"),
    key("frames[].sensitivity.ends[].friction[].slope", Type::Slope, "", "", "change of the value per unit of the friction coefficient"),
    key("frames[].sensitivity.ends[].friction_of_all", Type::Object, "", "unless the margin is the friction margin", "for the same change of all friction coefficients"),
    key("frames[].sensitivity.ends[].friction_of_all.unique", Type::Flag, "", "", "whether both derivatives are equal"),
    key("frames[].sensitivity.ends[].friction_of_all.slope", Type::Slope, "", "", "change of the value per unit of all coefficients"),
    key("frames[].sensitivity.ends[].loads", Type::Objects, "", "", "for each load on a placed block"),
    key("frames[].sensitivity.ends[].loads[].load", Type::Count, "", "", "index in `loads` of the scene, from 0"),
    key("frames[].sensitivity.ends[].loads[].block", Type::Text, "", "", "block on which the load acts"),
    key("frames[].sensitivity.ends[].loads[].at", Type::Pair, "m", "", "point at which the load acts"),
    key("frames[].sensitivity.ends[].loads[].unique", Type::Flag, "", "", "whether both derivatives are equal"),
    key("frames[].sensitivity.ends[].loads[].slope", Type::SlopePair, "1/m", "", "change of the value per metre by which this point moves along x and along y"),
    key("frames[].sensitivity.without_value", Type::Objects, "", "", "ends of the interval that have no value or no mechanism"),
    key("frames[].sensitivity.without_value[].end", Type::Word(&["low", "high"]), "", "", "lower or upper end"),
    key("frames[].sensitivity.without_value[].reason", Type::Word(&["not_applicable", "stands_at_no_value", "unbounded", "range_ends", "unconfirmed", "unsolved"]), "", "", "`not_applicable`: the margin does not exist in this frame (for example without loads), or the scene lists its contacts; `stands_at_no_value`: the frame falls at every value; `unbounded`: it stands at every value in this direction; `range_ends`: the range of the parameter ends here; `unconfirmed`: no verdict confirms the end; `unsolved`: forces and mechanism could not be computed"),
    key("frames[].capacity", Type::Object, "", "with `--capacity`, if the block is placed", "all forces (Fx, Fy) that the block can carry at this point, in addition to its present loads: the convex hull of `vertices`, extended without end along `rays`"),
    key("frames[].capacity.block", Type::Text, "", "", "block on which the force acts"),
    key("frames[].capacity.at", Type::Points, "m", "", "point at which the force acts; for a free contact two points, and the force is their resultant"),
    key("frames[].capacity.robot", Type::Text, "", "if the force is that of a robot", "robot that holds the block at this point; the limits of its force are ignored"),
    key("frames[].capacity.shape", Type::Word(&["empty", "point", "segment", "polygon", "unbounded", "everything"]), "", "", "shape of the set of forces"),
    key("frames[].capacity.stands_without", Type::Flag, "", "", "whether the frame stands without an additional force"),
    key("frames[].capacity.vertices", Type::Points, "N", "", "corners of the set, anticlockwise, each proved by forces"),
    key("frames[].capacity.rays", Type::Points, "", "", "unit directions in which the set is unbounded, anticlockwise; empty if it is bounded"),
    key("frames[].capacity.edges", Type::Objects, "", "", "edges of the set, anticlockwise, each proved by a motion"),
    key("frames[].capacity.edges[].from", Type::Index, "", "", "index of the vertex where the edge begins, from 0; null if it is unbounded there"),
    key("frames[].capacity.edges[].to", Type::Index, "", "", "the same for its other end"),
    key("frames[].capacity.edges[].normal", Type::Pair, "", "", "unit normal, which points out of the set"),
    key("frames[].capacity.edges[].limit", Type::Number, "N", "", "largest component of a force in the set along this normal"),
    key("frames[].capacity.edges[].mechanism", Type::Motions, "", "", "motion just beyond the edge"),
    key("frames[].capacity.edges[].case", Type::Count, "", "", "index of the extreme case of `--for-all` to which the edge belongs, from 0"),
    key("frames[].capacity.balances", Type::Objects, "", "unless `--for-all` gives more than one case", "contact forces that prove each vertex, in the order of `vertices`"),
    key("frames[].capacity.balances[].torque", Type::Number, "N·m", "", "torque on the block, about the first point of a free contact; 0 if the force acts at one point"),
    key("frames[].capacity.balances[].interfaces", Type::Objects, "", "", "interfaces of all blocks that influence this block"),
    key("frames[].capacity.balances[].interfaces[].interface", Type::Count, "", "", "index in `interfaces`, from 0"),
    key("frames[].capacity.balances[].interfaces[].normal_forces", Type::Pair, "N", "", "normal forces at the two application points"),
    key("frames[].capacity.balances[].interfaces[].friction_force", Type::Number, "N", "", "friction force"),
    key("frames[].capacity.mechanism", Type::Motions, "", "if a motion proves that the set is empty", "motion with which the frame falls at every force; if no force belongs to all cases, the motion of one edge of one case"),
    key("frames[].capacity.gap", Type::Number, "N", "", "bound on the error of the set: every force that no motion excludes is at most this far from the proved forces; at most a millionth of the size of the set or a few billionths of the heaviest load"),
    key("frames[].capacity.cases", Type::Count, "", "", "number of extreme cases whose sets were intersected; 1 without `--for-all`"),
    key("frames[].only_by_wedging", Type::FlagOrOpen, "", "with `--wedging`, if the frame stands", "whether the frame stands only because blocks press on each other although no load presses them together; null if this could not be decided, and `effects` then gives the reason"),
    key("frames[].wedging", Type::Object, "", "with `--wedging`, if `only_by_wedging` is `true`", "proof that the frame stands only by wedging"),
    key("frames[].wedging.must_press", Type::Objects, "", "", "interfaces that open or slide if the springs give way; in every balance, their normal forces sum to at least `normal_force_at_least`, if a bound was found"),
    key("frames[].wedging.must_press[].interface", Type::Count, "", "", "index in `interfaces`, from 0"),
    key("frames[].wedging.must_press[].bodies", Type::Names, "", "", "bodies of the interface"),
    key("frames[].wedging.normal_force_at_least", Type::Number, "N", "if a bound was found", "lower bound of the sum of the normal forces in `must_press`"),
    key("frames[].wedging.bound", Type::Objects, "", "if a bound was found", "motion that proves this bound"),
    key("frames[].wedging.bound[].block", Type::Text, "", "", "block that moves"),
    key("frames[].wedging.bound[].at", Type::Pair, "m", "", "point whose velocity is given"),
    key("frames[].wedging.bound[].velocity", Type::Pair, "", "", "velocity of this point"),
    key("frames[].wedging.bound[].spin", Type::Number, "1/m", "", "spin of the block, positive anticlockwise"),
    key("frames[].wedging.gives_way", Type::Objects, "", "", "motion of the blocks if all contacts are springs without initial stress"),
    key("frames[].wedging.gives_way[].block", Type::Text, "", "", "block that moves"),
    key("frames[].wedging.gives_way[].at", Type::Pair, "m", "", "point whose velocity is given"),
    key("frames[].wedging.gives_way[].velocity", Type::Pair, "", "", "velocity of this point"),
    key("frames[].wedging.gives_way[].spin", Type::Number, "1/m", "", "spin of the block, positive anticlockwise"),
    key("frames[].wedging.presses_nothing", Type::Flag, "", "", "whether the motion `gives_way` compresses no interface"),
    key("frames[].wedging.cases", Type::Count, "", "", "number of cases that were ruled out"),
    key("frames[].wedging.ruled_out", Type::Objects, "", "", "cases of pressing and sliding in which springs at the contacts cannot be at rest; together they cover all"),
    key("frames[].wedging.ruled_out[].points", Type::Objects, "", "", "application points that the case fixes"),
    key("frames[].wedging.ruled_out[].points[].interface", Type::Count, "", "", "index in `interfaces`, from 0"),
    key("frames[].wedging.ruled_out[].points[].point", Type::Count, "", "", "index of the application point, 0 or 1"),
    key("frames[].wedging.ruled_out[].points[].presses", Type::Flag, "", "", "whether the point presses"),
    key("frames[].wedging.ruled_out[].faces", Type::Objects, "", "", "interfaces with friction that the case fixes"),
    key("frames[].wedging.ruled_out[].faces[].interface", Type::Count, "", "", "index in `interfaces`, from 0"),
    key("frames[].wedging.ruled_out[].faces[].slides", Type::Text, "", "", "`forth`: it slides along (−n_y, n_x), where n is the normal of the interface; `back`: in the opposite direction; `sticks`: it does not slide"),
    key("frames[].effects", Type::Objects, "", "", "effects that were considered for this frame"),
    key("frames[].effects[].effect", Type::Text, "", "", "`weight`, `contact`, `friction`, `kernel`, `robots`, `robot torque`, `loads`, `corner contacts`, `sticking`, `mechanism`, `margins` or `wedging`"),
    key("frames[].effects[].simulated", Type::Flag, "", "", "whether it was simulated"),
    key("frames[].effects[].why", Type::Text, "", "", "reason"),
    key("frames[].effects[].unknowns", Type::Count, "", "", "number of unknowns that the effect adds, or would have added"),
    key("frames[].proof", Type::Object, "", "", "how exactly the verdict is proved: by forces if the frame stands, by a motion if it falls, by either if it is undecided"),
    key("frames[].proof.worst_imbalance", Type::Number, "", "in a proof by forces", "largest imbalance of a block: it balances if each force on it changes by at most this fraction of its magnitude and moves by at most this fraction of the block's radius"),
    key("frames[].proof.worst_share", Type::Number, "", "in a proof by forces", "largest unbalanced force on a block, as a share of the load on this block"),
    key("frames[].proof.worst_pull", Type::Number, "", "in a proof by forces", "largest tension at an application point, as a share of the forces at this contact"),
    key("frames[].proof.worst_slip", Type::Number, "", "in a proof by forces", "largest excess of friction over μN, as a share of the forces at this contact, or of a robot's force or torque over its limit, as a share of that force or torque; the larger of the two"),
    key("frames[].proof.power", Type::Number, "", "in a proof by a motion", "lower bound of the power of the loads along the motion, less what robots can absorb; as a share of the loads on the moving blocks, each weighted by the speed of its block"),
    key("frames[].proof.worst_violation", Type::Number, "", "in a proof by a motion", "largest velocity against which an admissible force could act, relative to the fastest point"),
    key("frames[].proof.no_balance_below", Type::Bound, "", "in a proof by a motion", "forces whose sum is below this multiple of the loads on the moving blocks cannot balance the blocks; `\"unbounded\"` if no forces can"),
    key("frames[].solve", Type::Object, "", "", "how the verdict was found"),
    key("frames[].solve.method", Type::Text, "", "", "method that decided: `closed form`, `kinematic`, `kinematic, refined`, `least residual` or `least sticking`"),
    key("frames[].solve.iterations", Type::Count, "", "", "iterations of the solvers"),
    key("frames[].solve.programs", Type::Count, "", "", "linear programs solved for the verdict and the forces"),
    key("frames[].solve.groups", Type::Count, "", "", "separate groups of blocks, which cannot influence each other"),
    key("frames[].solve.reused", Type::Count, "", "", "groups whose result was reused from an earlier frame"),
    key("frames[].solve.seconds", Type::Number, "s", "unless `--no-timing`", "time for the whole frame; only this value and `stages` may differ from run to run"),
    key("frames[].solve.stages", Type::Object, "", "unless `--no-timing`", "time of each stage"),
    key("frames[].solve.stages.assembly", Type::Number, "s", "", "assembling the frame"),
    key("frames[].solve.stages.solution", Type::Number, "s", "", "solving and proving"),
    key("frames[].solve.stages.wedging", Type::Number, "s", "", "test for wedging; 0 if it was not requested"),
    key("frames[].solve.stages.margins", Type::Number, "s", "", "margins; 0 if they were not requested"),
    key("frames[].notices", Type::NameList, "", "if there are notices", "remarks on this frame, in sentences for people"),
];

/// Every key of the object that replaces the result of a refused file.
#[rustfmt::skip]
pub const REFUSAL_KEYS: &[Key] = &[
    key("file", Type::Text, "", "", "path of the file as given"),
    key("problems", Type::Objects, "", "", "all problems of the file, at least one"),
    key("problems[].code", Type::Text, "", "", "kind of problem, one of the codes below"),
    key("problems[].path", Type::Text, "", "", "place in the scene, for example `blocks[3].polygon[1]`; empty for the whole file"),
    key("problems[].line", Type::Place, "", "", "line in the file, from 1; null if there is none"),
    key("problems[].column", Type::Place, "", "", "column in characters, from 1; null if there is none"),
    key("problems[].message", Type::Text, "", "", "problem in words, with its numbers"),
    key("problems[].hint", Type::Text, "", "", "how to remove the problem"),
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
    let velocity =
        described(Type::Pair, "velocity of the centroid of the block, relative to the fastest point, whose speed is 1");
    let spin = described(Type::Number, "1/m, anticlockwise positive");
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "drystone result",
        "description": "The output of `drystone check --json` for one scene file. Units are SI, and y points up.",
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
                "from": described(Type::Number, "lower end of the values; null if they have no lower end"),
                "to": described(Type::Number, "upper end of the values; null if they have no upper end"),
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

/// Makes the JSON Schema of an object with these keys, including the objects inside it.
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
