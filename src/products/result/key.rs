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
    key("drystone", Type::Text, "", "", "the version of the program"),
    key("file", Type::Text, "", "from the command line", "the path of the scene file as given; for a file in a given folder, the path of the folder and the name of the file; `-` for standard input"),
    key("scene", Type::Text, "", "", "the title of the scene; empty if the scene has none"),
    key("contact_tolerance", Type::Object, "", "", "the contact tolerance: the largest gap at which two edges still touch, where this value comes from, and how corners were moved to close gaps"),
    key("contact_tolerance.gap", Type::Number, "m", "", "the contact tolerance: edges at most this far apart touch; 0 if all bodies consist of lattice cells"),
    key("contact_tolerance.from", Type::Word(&["lattice", "given", "decimals", "significant_digits", "float32", "size", "noise"]), "", "", "the source of the tolerance: `lattice`, exact contacts of lattice cells; `given`, a value of the scene file or the command line; `decimals`, `significant_digits` and `float32`, an estimate from the way coordinates are written; `size` and `noise`, an estimate from the size of the scene"),
    key("contact_tolerance.digits", Type::Count, "", "if `from` is `decimals` or `significant_digits`", "the number of decimals or of significant digits with which the coordinates are written"),
    key("contact_tolerance.healed_within", Type::Number, "m", "", "the distance within which corners were merged with other corners or edges; 0 if coordinates are used as written"),
    key("contact_tolerance.moved_corners", Type::Count, "", "", "the number of corners that were moved to merge them with other corners or edges"),
    key("contact_tolerance.largest_move", Type::Number, "m", "", "the largest distance by which a corner was moved"),
    key("notes", Type::Objects, "", "if there are notes and `--no-notes` is not given", "notes on parts of the scene that its author probably did not intend"),
    key("notes[].code", Type::Text, "", "", "the kind of note, one of the codes listed below"),
    key("notes[].path", Type::Text, "", "", "the place in the scene, for example `robots[0].at`"),
    key("notes[].line", Type::Place, "", "", "the line in the text of the scene, from 1; null if the note has no line"),
    key("notes[].message", Type::Text, "", "", "what was found in the scene"),
    key("notes[].hint", Type::Text, "", "", "how to change the scene, and how to silence the note"),
    key("frames", Type::Objects, "", "", "the results of the frames: one object for each step; one object for a scene without steps"),
    key("frames[].title", Type::Text, "", "", "the title of the step; empty if the step has none"),
    key("frames[].verdict", Type::Word(&["stable", "unstable", "undecided"]), "", "", "stable: admissible forces balance all blocks; unstable: a collapse mechanism exists; undecided: neither is proved"),
    key("frames[].doubt", Type::Text, "", "if the frame is undecided", "why the frame is undecided"),
    key("frames[].length", Type::Number, "m", "", "the length L that turns torques into forces in the sums: the median length of the frame's interfaces without corner contacts (the shorter of the two in the middle); in a frame without interfaces the square root of the median block's area; 1 in an empty frame"),
    key("frames[].total_force", Type::Number, "N", "", "the sum of the magnitudes of all forces: Σ(N₁ + N₂ + \\|T\\|) over all interfaces, plus Σ(\\|Fx\\| + \\|Fy\\| + \\|M\\|/L) over all robots"),
    key("frames[].total_force_least", Type::Flag, "", "only if `false`", "whether `total_force` is the least possible sum of forces"),
    key("frames[].total_force_bound", Type::Number, "N", "if the frame stands and a bound was found", "a lower bound of `total_force` for all balances, from a motion of the blocks (weak duality)"),
    key("frames[].total_sticking", Type::Number, "N", "", "the sum of the magnitudes of the missing forces in `failures`, computed like `total_force`; 0 if the frame stands, if no adhesion would help (`unsupported`), and with `--verdict-only`, which does not compute it"),
    key("frames[].weight", Type::Number, "N", "", "the weight of all placed blocks"),
    key("frames[].blocks", Type::Objects, "", "with `--blocks`", "the placed blocks, in the order in which they were placed"),
    key("frames[].blocks[].id", Type::Text, "", "", "the id of the block"),
    key("frames[].blocks[].centre", Type::Pair, "m", "", "the point at which the weight of the block acts"),
    key("frames[].blocks[].area", Type::Number, "m²", "", "the area inside the outline of the block, without the holes"),
    key("frames[].blocks[].weight", Type::Number, "N", "", "the weight of the block"),
    key("frames[].blocks[].vertices", Type::Points, "m", "", "the corners of the block's outline, anticlockwise, after corners were merged"),
    key("frames[].blocks[].holes", Type::Rings, "m", "if the block has holes", "the corners of each hole of the block"),
    key("frames[].interfaces", Type::Objects, "", "", "the contacts between bodies; forces act on `bodies[0]`"),
    key("frames[].interfaces[].bodies", Type::Names, "", "", "the two bodies that touch; `ground` is the ground"),
    key("frames[].interfaces[].kind", Type::Word(&["corner"]), "", "at corner contacts", "marks the contact of a corner with an edge or with another corner"),
    key("frames[].interfaces[].ends", Type::Pairs, "m", "", "the two ends of the interface"),
    key("frames[].interfaces[].application_points", Type::Pairs, "m", "", "the two points at which the normal forces act: the ends of the interface, moved inward by the kernel"),
    key("frames[].interfaces[].normal", Type::Pair, "", "", "the unit normal of the interface, which points into `bodies[0]`"),
    key("frames[].interfaces[].mu", Type::Number, "", "", "the friction coefficient of the interface"),
    key("frames[].interfaces[].normal_forces", Type::Pair, "N", "", "the normal forces at the two application points of the interface, at least 0"),
    key("frames[].interfaces[].friction_force", Type::Number, "N", "", "the friction force at the interface, positive along (−n_y, n_x), where n is the normal"),
    key("frames[].interfaces[].resultant", Type::Object, "", "", "the resultant of the forces at the interface"),
    key("frames[].interfaces[].resultant.at", Type::Pair, "m", "", "the point at which the resultant acts"),
    key("frames[].interfaces[].resultant.force", Type::Pair, "N", "", "the resultant force on `bodies[0]`"),
    key("frames[].interfaces[].friction_used", Type::Number, "", "", "the friction force as a share of the largest possible friction μN, from 0 to 1; 0 without friction; in a falling frame for the balance that includes the missing forces"),
    key("frames[].robots", Type::Objects, "", "", "the robots that hold a block in this frame, in the order of the scene"),
    key("frames[].robots[].id", Type::Text, "", "", "the id of the robot"),
    key("frames[].robots[].holds", Type::Text, "", "", "the block that the robot holds"),
    key("frames[].robots[].at", Type::Pair, "m", "", "the grip point of the robot"),
    key("frames[].robots[].force", Type::Pair, "N", "", "the force of the robot on the block"),
    key("frames[].robots[].torque", Type::Number, "N·m", "", "the torque of the robot on the block, positive anticlockwise"),
    key("frames[].robots[].limit_used", Type::Number, "", "", "the largest share of a limit that the robot uses, from 0 to 1; 0 for a robot without limits, or with all limits 0; in a falling frame for the balance that includes the missing forces"),
    key("frames[].failures", Type::Objects, "", "", "the missing forces: what contacts and robots would have to exert beyond their limits for a balance; empty if the frame stands; none for `unsupported` blocks"),
    key("frames[].failures[].kind", Type::Word(&["tension", "friction", "robot_force", "robot_torque"]), "", "", "`tension`: a contact opens; `friction`: a contact slides; `robot_force`, `robot_torque`: a robot cannot exert the force or the torque"),
    key("frames[].failures[].bodies", Type::Names, "", "for a missing force at a contact", "the two bodies in contact"),
    key("frames[].failures[].robot", Type::Text, "", "for a missing force or torque of a robot", "the robot whose limit is exceeded"),
    key("frames[].failures[].holds", Type::Text, "", "for a missing force or torque of a robot", "the block that the robot holds"),
    key("frames[].failures[].at", Type::Pair, "m", "", "the point at which the force or torque is missing; for friction the middle of the interface"),
    key("frames[].failures[].force", Type::Pair, "N", "unless a torque is missing", "the missing force, on `bodies[0]` or on the block"),
    key("frames[].failures[].torque", Type::Number, "N·m", "if a torque is missing", "the missing torque on the block, positive anticlockwise"),
    key("frames[].failures[].amount", Type::Number, "N or N·m", "", "the size of the missing force, in N; for a missing force of a robot \\|Fx\\| + \\|Fy\\|; for a missing torque its size in N·m"),
    key("frames[].unsupported", Type::NameList, "", "if there are unsupported blocks", "the blocks that would fall even if all contacts and grips could stick"),
    key("frames[].mechanism", Type::Motions, "", "", "the velocities of the blocks as the collapse begins; empty if the frame stands"),
    key("frames[].margins", Type::Object, "", IF_MARGINS_REQUESTED, "the margins, which show how far the frame is from collapse; a margin is null if the frame stands at no value, if the margin does not exist in this frame, or if no value was confirmed; in the last case a notice says so"),
    key("frames[].margins.friction", Type::Margin, "", IF_MARGIN_REQUESTED, "the least friction coefficient, the same at all interfaces, at which the frame stands"),
    key("frames[].margins.tilt", Type::Object, "", IF_MARGIN_REQUESTED, "the largest angles by which gravity can turn to the left and to the right while the frame stands; each is null if it falls without a turn"),
    key("frames[].margins.tilt.left", Type::Margin, "°", "", "the largest tilt of gravity to the left (clockwise)"),
    key("frames[].margins.tilt.right", Type::Margin, "°", "", "the largest tilt of gravity to the right (anticlockwise)"),
    key("frames[].margins.horizontal_load", Type::Object, "", IF_MARGIN_REQUESTED, "the largest horizontal force on every block at which the frame stands, as a share of the weight of the block"),
    key("frames[].margins.horizontal_load.left", Type::Margin, "", "", "the largest horizontal force to the left"),
    key("frames[].margins.horizontal_load.right", Type::Margin, "", "", "the largest horizontal force to the right"),
    key("frames[].margins.kernel", Type::Margin, "", IF_MARGIN_REQUESTED, "the largest kernel at which the frame stands"),
    key("frames[].margins.load_factor", Type::Margin, "", IF_MARGIN_REQUESTED, "the largest factor on the loads at which the frame stands; null also for a frame without loads"),
    key("frames[].margins.robots", Type::ByRobot, "", "", "the least limits of each robot that holds a block, by its name; empty if they were not requested"),
    key("frames[].margins.robots.*.fx", Type::Margin, "N", "", "the least limit of the robot's horizontal force at which the frame stands"),
    key("frames[].margins.robots.*.fy", Type::Margin, "N", "", "the least limit of the robot's vertical force at which the frame stands"),
    key("frames[].margins.robots.*.torque", Type::Margin, "N·m", "", "the least limit of the robot's torque at which the frame stands"),
    key("frames[].margins.intervals", Type::Object, "", "", "for each parameter, the interval of values at which the frame stands if all else is unchanged; an end is `null` if there is no limit; an interval is `null` if the frame stands at no value; `\"withheld\"` replaces what no verdict confirms, and a notice says why"),
    key("frames[].margins.intervals.friction", Type::Interval, "", IF_MARGIN_REQUESTED, "the interval of the friction coefficient, the same at all interfaces, from 0 to 1000"),
    key("frames[].margins.intervals.tilt", Type::Interval, "°", IF_MARGIN_REQUESTED, "the interval of the tilt of gravity, negative to the left; loads do not tilt"),
    key("frames[].margins.intervals.horizontal_load", Type::Interval, "", IF_MARGIN_REQUESTED, "the interval of the horizontal force on every block as a share of its weight, negative to the left"),
    key("frames[].margins.intervals.kernel", Type::Interval, "", IF_MARGIN_REQUESTED, "the interval of the kernel, from 0 to 1; without an upper end if the frame stands at 1"),
    key("frames[].margins.intervals.load_factor", Type::Interval, "", "if requested, if there are loads", "the interval of the factor on the loads, at least 0; the factor 1 stands for the loads of the scene"),
    key("frames[].margins.intervals.robots", Type::ByRobot, "", "if requested, if robots hold blocks", "the intervals of the limits of each robot, by the name of the robot; each limit is varied alone"),
    key("frames[].margins.intervals.robots.*.fx", Type::Interval, "N", "", "the interval of the limit of the robot's horizontal force"),
    key("frames[].margins.intervals.robots.*.fy", Type::Interval, "N", "", "the interval of the limit of the robot's vertical force"),
    key("frames[].margins.intervals.robots.*.torque", Type::Interval, "N·m", "", "the interval of the limit of the robot's torque"),
    key("frames[].margins.excluded", Type::Object, "", "if an interval is `null`", "why the frame stands at no value of a parameter: motions of the blocks, each with the values of the parameter that the motion excludes; together the motions exclude all values. If two parts of the frame conflict, one motion excludes the values below a limit, and the other motion excludes the values above a smaller limit"),
    key("frames[].margins.excluded.friction", Type::Exclusions, "", "if the interval of this parameter is `null`", "the motions that exclude all friction coefficients up to 1000, the largest coefficient that is tried"),
    key("frames[].margins.excluded.tilt", Type::Exclusions, "°", "if the interval of this parameter is `null`", "the motions that exclude all turns of gravity; their ranges cover a full turn"),
    key("frames[].margins.excluded.horizontal_load", Type::Exclusions, "", "if the interval of this parameter is `null`", "the motions that exclude all horizontal loads"),
    key("frames[].margins.excluded.kernel", Type::Exclusions, "", "if the interval of this parameter is `null`", "the motions that exclude all kernels"),
    key("frames[].margins.excluded.load_factor", Type::Exclusions, "", "if the interval of this parameter is `null`", "the motions that exclude all factors on the loads"),
    key("frames[].margins.excluded.robots", Type::ByRobot, "", "if the interval of a limit is `null`", "the motions that exclude all values of a robot's limits, by the name of the robot"),
    key("frames[].margins.excluded.robots.*.fx", Type::Exclusions, "N", "if the interval of this limit is `null`", "the motions that exclude all limits of the robot's horizontal force"),
    key("frames[].margins.excluded.robots.*.fy", Type::Exclusions, "N", "if the interval of this limit is `null`", "the motions that exclude all limits of the robot's vertical force"),
    key("frames[].margins.excluded.robots.*.torque", Type::Exclusions, "N·m", "if the interval of this limit is `null`", "the motions that exclude all limits of the robot's torque"),
    key("frames[].margins.notes", Type::NameList, "", "if there are remarks", "remarks on the intervals, one sentence each"),
    key("frames[].margins.mechanisms", Type::Object, "", "", "the motion of the blocks just beyond each margin; empty for a margin that is unbounded or null, and for a margin that was not requested"),
    key("frames[].margins.mechanisms.friction", Type::Motions, "", "", "the motion just below the least friction coefficient"),
    key("frames[].margins.mechanisms.tilt", Type::Object, "", "", "the motions just beyond the largest tilts"),
    key("frames[].margins.mechanisms.tilt.left", Type::Motions, "", "", "the motion just beyond the largest tilt to the left"),
    key("frames[].margins.mechanisms.tilt.right", Type::Motions, "", "", "the motion just beyond the largest tilt to the right"),
    key("frames[].margins.mechanisms.horizontal_load", Type::Object, "", "", "the motions just beyond the largest horizontal loads"),
    key("frames[].margins.mechanisms.horizontal_load.left", Type::Motions, "", "", "the motion just beyond the largest horizontal load to the left"),
    key("frames[].margins.mechanisms.horizontal_load.right", Type::Motions, "", "", "the motion just beyond the largest horizontal load to the right"),
    key("frames[].margins.mechanisms.kernel", Type::Motions, "", "", "the motion just beyond the largest safety kernel"),
    key("frames[].margins.mechanisms.load_factor", Type::Motions, "", "", "the motion just beyond the largest factor on the loads"),
    key("frames[].margins.mechanisms.robots", Type::ByRobot, "", "", "the motions just below the least limits of each robot, by the name of the robot"),
    key("frames[].margins.mechanisms.robots.*.fx", Type::Motions, "", "", "the motion just below the least limit of the robot's horizontal force"),
    key("frames[].margins.mechanisms.robots.*.fy", Type::Motions, "", "", "the motion just below the least limit of the robot's vertical force"),
    key("frames[].margins.mechanisms.robots.*.torque", Type::Motions, "", "", "the motion just below the least limit of the robot's torque"),
    key("frames[].margins.mechanisms.intervals", Type::Object, "", "", "the motion of the blocks just beyond each end of an interval; if an interval is `null`, its motions are in `excluded`"),
    key("frames[].margins.mechanisms.intervals.tilt", Type::MotionPairs, "", "if this parameter has an interval", "the motions just beyond the lower and the upper end of the interval of the tilt"),
    key("frames[].margins.mechanisms.intervals.horizontal_load", Type::MotionPairs, "", "if this parameter has an interval", "the motions just beyond the lower and the upper end of the interval of the horizontal load"),
    key("frames[].margins.mechanisms.intervals.load_factor", Type::MotionPairs, "", "if this parameter has an interval", "the motions just beyond the lower and the upper end of the interval of the factor on the loads"),
    key("frames[].sensitivity", Type::Object, "", "with `--sensitivity`", "how the ends of the interval of one margin change with vertices, weights, friction and loads: exact derivatives for unchanged contacts. If forces and mechanism are not unique, the margin may have a kink; the backward and the forward derivative are then given, or `at_kink` if these derivatives were not computed"),
    key("frames[].sensitivity.parameter", Type::Word(&["friction", "tilt", "horizontal_load", "kernel", "load_factor"]), "", "", "the parameter of the margin"),
    key("frames[].sensitivity.ends", Type::Objects, "", "", "the ends of the margin's interval that have a value and a mechanism"),
    key("frames[].sensitivity.ends[].end", Type::Word(&["low", "high"]), "", "", "the lower or the upper end of the interval"),
    key("frames[].sensitivity.ends[].value", Type::Number, "", "", "the value of the parameter at this end: in degrees for the tilt, otherwise without a unit"),
    key("frames[].sensitivity.ends[].vertices", Type::Objects, "", "", "the derivatives for each vertex of each placed block"),
    key("frames[].sensitivity.ends[].vertices[].block", Type::Text, "", "", "the block to which the vertex belongs"),
    key("frames[].sensitivity.ends[].vertices[].vertex", Type::Count, "", "", "the index of the vertex in the outline, from 0 and anticlockwise; the vertices of holes follow those of the outline"),
    key("frames[].sensitivity.ends[].vertices[].at", Type::Pair, "m", "", "the position of the vertex"),
    key("frames[].sensitivity.ends[].vertices[].with", Type::NameList, "", "", "the other bodies whose vertices move together with this vertex, so that no joint opens"),
    key("frames[].sensitivity.ends[].vertices[].moves", Type::Word(&["freely", "along", "not"]), "", "", "whether the vertex can move freely, only along an edge of another body, or not at all without opening or bending a joint"),
    key("frames[].sensitivity.ends[].vertices[].along", Type::Pair, "", "if `moves` is `along`", "the unit vector along the edge of the other body"),
    key("frames[].sensitivity.ends[].vertices[].unique", Type::Flag, "", "", "whether the backward and the forward derivative are equal"),
    key("frames[].sensitivity.ends[].vertices[].slope", Type::SlopePair, "1/m", "", "the change of the value per metre by which the vertex moves along x and along y; if the vertex can move only along an edge, the derivative along the edge as a vector along this edge; null if the vertex cannot move"),
    key("frames[].sensitivity.ends[].weights", Type::Objects, "", "", "the derivatives for the weight of each placed block"),
    key("frames[].sensitivity.ends[].weights[].block", Type::Text, "", "", "the block whose weight changes"),
    key("frames[].sensitivity.ends[].weights[].unique", Type::Flag, "", "", "whether the backward and the forward derivative are equal"),
    key("frames[].sensitivity.ends[].weights[].slope", Type::Slope, "1/N", "", "the change of the value per newton of the block's weight; the centroid of the block does not move"),
    key("frames[].sensitivity.ends[].friction", Type::Objects, "", "", "the derivatives for the friction coefficient of each interface; empty for the friction margin, because this margin sets all friction coefficients"),
    key("frames[].sensitivity.ends[].friction[].interface", Type::Count, "", "", "the index of the interface in `interfaces`, from 0"),
    key("frames[].sensitivity.ends[].friction[].bodies", Type::Names, "", "", "the two bodies of the interface"),
    key("frames[].sensitivity.ends[].friction[].unique", Type::Flag, "", "", "whether the backward and the forward derivative are equal"),
    key("frames[].sensitivity.ends[].friction[].slope", Type::Slope, "", "", "the change of the value per unit of the interface's friction coefficient"),
    key("frames[].sensitivity.ends[].friction_of_all", Type::Object, "", "unless the margin is the friction margin", "the derivative if all friction coefficients change by the same amount"),
    key("frames[].sensitivity.ends[].friction_of_all.unique", Type::Flag, "", "", "whether the backward and the forward derivative are equal"),
    key("frames[].sensitivity.ends[].friction_of_all.slope", Type::Slope, "", "", "the change of the value per unit by which all friction coefficients change"),
    key("frames[].sensitivity.ends[].loads", Type::Objects, "", "", "the derivatives for each load on a placed block"),
    key("frames[].sensitivity.ends[].loads[].load", Type::Count, "", "", "the index of the load in `loads` of the scene, from 0"),
    key("frames[].sensitivity.ends[].loads[].block", Type::Text, "", "", "the block on which the load acts"),
    key("frames[].sensitivity.ends[].loads[].at", Type::Pair, "m", "", "the point at which the load acts"),
    key("frames[].sensitivity.ends[].loads[].unique", Type::Flag, "", "", "whether the backward and the forward derivative are equal"),
    key("frames[].sensitivity.ends[].loads[].slope", Type::SlopePair, "1/m", "", "the change of the value per metre by which the point of the load moves along x and along y"),
    key("frames[].sensitivity.without_value", Type::Objects, "", "", "the ends of the interval that have no value or no mechanism"),
    key("frames[].sensitivity.without_value[].end", Type::Word(&["low", "high"]), "", "", "the lower or the upper end of the interval"),
    key("frames[].sensitivity.without_value[].reason", Type::Word(&["not_applicable", "stands_at_no_value", "unbounded", "range_ends", "unconfirmed", "unsolved"]), "", "", "why the end has no value: `not_applicable`, the margin does not exist in this frame (for example, the frame has no loads), or the scene lists its contacts; `stands_at_no_value`, the frame falls at every value; `unbounded`, the frame stands at every value in this direction; `range_ends`, the range of the parameter ends here; `unconfirmed`, no verdict confirms the end; `unsolved`, forces and mechanism could not be computed"),
    key("frames[].capacity", Type::Object, "", "with `--capacity`, if the block is placed", "all forces (Fx, Fy) that the block can carry at this point, in addition to its present loads: the convex hull of `vertices`, extended without end along `rays`"),
    key("frames[].capacity.block", Type::Text, "", "", "the block on which the force acts"),
    key("frames[].capacity.at", Type::Points, "m", "", "the point at which the force acts; for a free contact two points, and the force is then the resultant of the forces at these points"),
    key("frames[].capacity.robot", Type::Text, "", "if the force is that of a robot", "the robot that holds the block at this point; the limits of its force are ignored"),
    key("frames[].capacity.shape", Type::Word(&["empty", "point", "segment", "polygon", "unbounded", "everything"]), "", "", "the shape of the set of forces"),
    key("frames[].capacity.stands_without", Type::Flag, "", "", "whether the frame stands without an additional force, so that (0, 0) belongs to the set"),
    key("frames[].capacity.vertices", Type::Points, "N", "", "the corners of the set, anticlockwise; each corner is proved by forces"),
    key("frames[].capacity.rays", Type::Points, "", "", "the unit directions in which the set is unbounded, anticlockwise; empty if the set is bounded"),
    key("frames[].capacity.edges", Type::Objects, "", "", "the edges of the set, anticlockwise; each edge is proved by a motion"),
    key("frames[].capacity.edges[].from", Type::Index, "", "", "the index of the vertex at which the edge begins, from 0; null if the edge is unbounded there"),
    key("frames[].capacity.edges[].to", Type::Index, "", "", "the index of the vertex at which the edge ends, from 0; null if the edge is unbounded there"),
    key("frames[].capacity.edges[].normal", Type::Pair, "", "", "the unit normal of the edge, which points out of the set"),
    key("frames[].capacity.edges[].limit", Type::Number, "N", "", "the largest component, along the normal of the edge, of a force in the set"),
    key("frames[].capacity.edges[].mechanism", Type::Motions, "", "", "the motion of the blocks just beyond the edge"),
    key("frames[].capacity.edges[].case", Type::Count, "", "", "the index of the extreme case of `--for-all` to which the edge belongs, from 0"),
    key("frames[].capacity.balances", Type::Objects, "", "unless `--for-all` gives more than one case", "the contact forces that prove each vertex, in the order of `vertices`"),
    key("frames[].capacity.balances[].torque", Type::Number, "N·m", "", "the torque, about the first point of a free contact, on the block; 0 if the force acts at one point"),
    key("frames[].capacity.balances[].interfaces", Type::Objects, "", "", "the forces at the interfaces of all blocks that influence this block"),
    key("frames[].capacity.balances[].interfaces[].interface", Type::Count, "", "", "the index of the interface in `interfaces`, from 0"),
    key("frames[].capacity.balances[].interfaces[].normal_forces", Type::Pair, "N", "", "the normal forces at the two application points of the interface"),
    key("frames[].capacity.balances[].interfaces[].friction_force", Type::Number, "N", "", "the friction force at the interface"),
    key("frames[].capacity.mechanism", Type::Motions, "", "if a motion proves that the set is empty", "the motion with which the frame falls at every value of the force; if each case has forces but no force belongs to all cases, the motion of one edge of one case"),
    key("frames[].capacity.gap", Type::Number, "N", "", "a bound on the error of the set: every force that no motion excludes is at most this far from the set of proved forces; the bound is at most a millionth of the size of the set or a few billionths of the heaviest load"),
    key("frames[].capacity.cases", Type::Count, "", "", "the number of extreme cases whose sets were intersected; 1 without `--for-all`"),
    key("frames[].only_by_wedging", Type::FlagOrOpen, "", "with `--wedging`, if the frame stands", "whether the frame stands only because blocks are wedged, which means that they press on each other although no load presses them together; null if this could not be decided, and `effects` then gives the reason"),
    key("frames[].wedging", Type::Object, "", "with `--wedging`, if `only_by_wedging` is `true`", "the proof that the frame stands only by wedging"),
    key("frames[].wedging.must_press", Type::Objects, "", "", "the interfaces that open or slide if the springs give way; in every balance, the sum of their normal forces is at least `normal_force_at_least`, if a bound was found"),
    key("frames[].wedging.must_press[].interface", Type::Count, "", "", "the index of the interface in `interfaces`, from 0"),
    key("frames[].wedging.must_press[].bodies", Type::Names, "", "", "the two bodies of the interface"),
    key("frames[].wedging.normal_force_at_least", Type::Number, "N", "if a bound was found", "a lower bound of the sum of the normal forces at the interfaces in `must_press`"),
    key("frames[].wedging.bound", Type::Objects, "", "if a bound was found", "the motion of the blocks that proves the bound `normal_force_at_least`"),
    key("frames[].wedging.bound[].block", Type::Text, "", "", "the block that moves"),
    key("frames[].wedging.bound[].at", Type::Pair, "m", "", "the point of the block whose velocity is given"),
    key("frames[].wedging.bound[].velocity", Type::Pair, "", "", "the velocity of the point `at`"),
    key("frames[].wedging.bound[].spin", Type::Number, "1/m", "", "the spin of the block, positive anticlockwise"),
    key("frames[].wedging.gives_way", Type::Objects, "", "", "the motion of the blocks if all contacts are springs without initial stress"),
    key("frames[].wedging.gives_way[].block", Type::Text, "", "", "the block that moves"),
    key("frames[].wedging.gives_way[].at", Type::Pair, "m", "", "the point of the block whose velocity is given"),
    key("frames[].wedging.gives_way[].velocity", Type::Pair, "", "", "the velocity of the point `at`"),
    key("frames[].wedging.gives_way[].spin", Type::Number, "1/m", "", "the spin of the block, positive anticlockwise"),
    key("frames[].wedging.presses_nothing", Type::Flag, "", "", "whether the motion `gives_way` compresses no interface"),
    key("frames[].wedging.cases", Type::Count, "", "", "the number of cases of pressing and sliding that were ruled out"),
    key("frames[].wedging.ruled_out", Type::Objects, "", "", "the cases of pressing and sliding in which springs at the contacts cannot be at rest; together the cases cover all ways in which the contacts can press and slide"),
    key("frames[].wedging.ruled_out[].points", Type::Objects, "", "", "the application points for which the case says whether they press"),
    key("frames[].wedging.ruled_out[].points[].interface", Type::Count, "", "", "the index of the interface in `interfaces`, from 0"),
    key("frames[].wedging.ruled_out[].points[].point", Type::Count, "", "", "the index of the application point at the interface, 0 or 1"),
    key("frames[].wedging.ruled_out[].points[].presses", Type::Flag, "", "", "whether the application point presses in this case"),
    key("frames[].wedging.ruled_out[].faces", Type::Objects, "", "", "the interfaces with friction for which the case says how they slide"),
    key("frames[].wedging.ruled_out[].faces[].interface", Type::Count, "", "", "the index of the interface in `interfaces`, from 0"),
    key("frames[].wedging.ruled_out[].faces[].slides", Type::Text, "", "", "the direction of sliding: `forth`, along (−n_y, n_x), where n is the normal of the interface; `back`, the opposite direction; `sticks`, the interface does not slide"),
    key("frames[].effects", Type::Objects, "", "", "the effects that were considered for this frame"),
    key("frames[].effects[].effect", Type::Text, "", "", "`weight`, `contact`, `friction`, `kernel`, `robots`, `robot torque`, `loads`, `corner contacts`, `sticking`, `mechanism`, `margins` or `wedging`"),
    key("frames[].effects[].simulated", Type::Flag, "", "", "whether the effect was simulated; an effect that the frame does not need is not simulated"),
    key("frames[].effects[].why", Type::Text, "", "", "why the effect was simulated or not"),
    key("frames[].effects[].unknowns", Type::Count, "", "", "the number of unknowns that the effect adds, or would have added if the effect is left out"),
    key("frames[].proof", Type::Object, "", "", "numbers that show how exactly the verdict is proved, computed from outlines, forces and motions alone: by forces if the frame stands, by a motion if it falls, by either if it is undecided"),
    key("frames[].proof.worst_imbalance", Type::Number, "", "in a proof by forces", "the largest imbalance of a block: the smallest fraction such that the block balances if each force on it changes by at most this fraction of its magnitude and moves by at most this fraction of the block's radius"),
    key("frames[].proof.worst_share", Type::Number, "", "in a proof by forces", "the largest unbalanced force on a block, as a share of the load on this block"),
    key("frames[].proof.worst_pull", Type::Number, "", "in a proof by forces", "the largest tension at an application point, as a share of the forces at this contact"),
    key("frames[].proof.worst_slip", Type::Number, "", "in a proof by forces", "the largest excess of friction over μN, as a share of the forces at this contact, or the largest excess of a robot's force or torque over its limit, as a share of that force or torque; the larger of the two"),
    key("frames[].proof.power", Type::Number, "", "in a proof by a motion", "a lower bound of the power of the loads along the motion, less the power that robots can absorb; as a share of the loads on the moving blocks, each weighted by the speed of its block"),
    key("frames[].proof.worst_violation", Type::Number, "", "in a proof by a motion", "the largest velocity against which an admissible force could act, relative to the speed of the fastest point"),
    key("frames[].proof.no_balance_below", Type::Bound, "", "in a proof by a motion", "a multiple of the loads on the moving blocks: forces whose sum is below this multiple cannot balance the blocks; `\"unbounded\"` if no forces can balance them"),
    key("frames[].solve", Type::Object, "", "", "how the verdict was found"),
    key("frames[].solve.method", Type::Text, "", "", "the method that decided: `closed form`, `kinematic`, `kinematic, refined`, `least residual` or `least sticking`"),
    key("frames[].solve.iterations", Type::Count, "", "", "the number of iterations of the solvers"),
    key("frames[].solve.programs", Type::Count, "", "", "the number of linear programs that were solved for the verdict and the forces"),
    key("frames[].solve.groups", Type::Count, "", "", "the number of separate groups of blocks; blocks of different groups cannot influence each other"),
    key("frames[].solve.reused", Type::Count, "", "", "the number of separate groups of blocks whose result was reused from an earlier frame"),
    key("frames[].solve.seconds", Type::Number, "s", "unless `--no-timing`", "the time taken for the whole frame; only this value and `stages` may differ from run to run"),
    key("frames[].solve.stages", Type::Object, "", "unless `--no-timing`", "the time of each stage"),
    key("frames[].solve.stages.assembly", Type::Number, "s", "", "the time for assembling the bodies, contacts and loads of the frame"),
    key("frames[].solve.stages.solution", Type::Number, "s", "", "the time for solving and proving: verdict, forces, failures, mechanism"),
    key("frames[].solve.stages.wedging", Type::Number, "s", "", "the time of the test for wedging; 0 if it was not requested"),
    key("frames[].solve.stages.margins", Type::Number, "s", "", "the time for the margins; 0 if they were not requested"),
    key("frames[].notices", Type::NameList, "", "if there are notices", "remarks on this frame, in sentences for people"),
];

/// Every key of the object that replaces the result of a refused file.
#[rustfmt::skip]
pub const REFUSAL_KEYS: &[Key] = &[
    key("file", Type::Text, "", "", "the path of the file as given"),
    key("problems", Type::Objects, "", "", "all problems of the file, at least one"),
    key("problems[].code", Type::Text, "", "", "the kind of problem, one of the codes listed below"),
    key("problems[].path", Type::Text, "", "", "the place in the scene, for example `blocks[3].polygon[1]`; empty for the whole file"),
    key("problems[].line", Type::Place, "", "", "the line in the file, from 1; null if the problem has no line"),
    key("problems[].column", Type::Place, "", "", "the column in characters, from 1; null if the problem has no column"),
    key("problems[].message", Type::Text, "", "", "the problem in words, with the numbers that were found"),
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
