//! [`Shapes`] and [`Settings`]: the differences between two frames. Shapes are the blocks: those that only one frame has,
//! and blocks with the same id that differ. Settings are all other inputs: gravity, kernel, corner contacts, friction of
//! pairs of materials, loads and robots.

use std::collections::BTreeMap;

use super::Side;
use crate::geometry::Point;
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{Block, CornerContacts, Limits, Scene, Unit};
use crate::products::report::entry::{Grid, inputs};
use crate::products::wording::failure::shortened;
use crate::products::wording::number::{amount, digits, listed, place};
use crate::text::line;

/// A block counts as moved if its centroid moved by more than `MOVE_TOL` times the largest absolute coordinate of all
/// block corners in the two scenes.
const MOVE_TOL: f64 = 1e-6;
/// Largest number of blocks that a sentence names.
const MAX_NAMED_BLOCKS: usize = 6;

/// The differences between the blocks of two frames.
#[derive(Default)]
pub(super) struct Shapes {
    /// Indices of blocks of the first frame that are missing or different in the second frame.
    pub gone_or_changed: Vec<usize>,
    /// Indices of blocks of the second frame that are missing or different in the first frame.
    pub new_or_changed: Vec<usize>,
    gone: Vec<String>,
    new: Vec<String>,
    /// The ids of changed blocks, each with a description of its changes.
    changed: Vec<(String, String)>,
}

impl Shapes {
    /// Compares the blocks of the two frames with index `number`, or all blocks. `units` are the units of the values in
    /// the descriptions of changes.
    pub fn new(sides: [Side<'_>; 2], number: Option<usize>, units: UnitsEntry) -> Shapes {
        let blocks = |side: Side<'_>| -> Vec<(String, usize)> {
            let scene = side.analysis.given();
            let placed = |number: usize| scene.frames[number].placed.iter().map(|id| id.0).collect();
            let mut placed: Vec<usize> = number.map_or_else(|| (0..scene.blocks.len()).collect(), placed);
            placed.sort_unstable();
            let named = placed.into_iter().map(|i| (scene.blocks[i].id.clone(), i));
            named.collect()
        };
        // Keep the blocks in the order of the file, because sorting by name would put v10 before v2.
        let [then, now] = sides.map(blocks);
        let [before, after] = [&then, &now]
            .map(|list| -> BTreeMap<&str, usize> { list.iter().map(|(id, i)| (id.as_str(), *i)).collect() });
        let [was, is] = sides.map(|side| side.analysis.given());
        let max_coordinate = max_coordinate(is).max(max_coordinate(was));
        let mut shapes = Shapes::default();
        for (id, old) in &then {
            let Some(new) = after.get(id.as_str()) else {
                shapes.gone.push(line(id));
                shapes.gone_or_changed.push(*old);
                continue;
            };
            let how = differs(&was.blocks[*old], &is.blocks[*new], max_coordinate, units);
            if !how.is_empty() {
                shapes.gone_or_changed.push(*old);
                shapes.new_or_changed.push(*new);
                shapes.changed.push((line(id), how));
            }
        }
        for (id, new) in &now {
            if !before.contains_key(id.as_str()) {
                shapes.new.push(line(id));
                shapes.new_or_changed.push(*new);
            }
        }
        shapes
    }

    pub fn stated(&self) -> Vec<String> {
        let changed: Vec<String> = self.changed.iter().map(|c| c.0.clone()).collect();
        let kinds = [("gone", &self.gone), ("new", &self.new), ("changed", &changed)];
        let described = kinds.into_iter().filter(|k| !k.1.is_empty());
        described
            .map(|(how, names)| format!("{how}: {}", listed(&shortened(names.clone(), MAX_NAMED_BLOCKS))))
            .collect()
    }

    pub fn grid(&self) -> Grid {
        let mut grid = Grid::new("Blocks that differ", &["block", "how"]);
        let alone = |names: &[String], how: &str| -> Vec<(String, String)> {
            let named = names.iter().map(|name| (name.clone(), how.to_owned()));
            named.collect()
        };
        let gone = alone(&self.gone, "only in the first");
        let new = alone(&self.new, "only in the second");
        // Blocks that differ in the same way share one row of the table.
        let mut ways: Vec<(&str, Vec<String>)> = Vec::new();
        for (name, how) in gone.iter().chain(&new).chain(&self.changed) {
            match ways.iter_mut().find(|way| way.0 == how) {
                Some((_, names)) => names.push(name.clone()),
                None => ways.push((how, vec![name.clone()])),
            }
        }
        for (how, names) in ways {
            grid.add("", [listed(&names), how.to_owned()]);
        }
        grid
    }
}

/// Returns the largest absolute coordinate of all corners of blocks, m.
fn max_coordinate(scene: &Scene) -> f64 {
    let corners = scene.blocks.iter().flat_map(|b| b.body.polygon.outline());
    corners.map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max)
}

/// Describes the differences of a block between two scenes. Returns an empty text if the blocks are equal.
/// `max_coordinate` is the largest absolute coordinate in the two scenes, m.
fn differs(was: &Block, is: &Block, max_coordinate: f64, units: UnitsEntry) -> String {
    let mut how = Vec::new();
    let moved = is.centroid - was.centroid;
    let near = MOVE_TOL * max_coordinate;
    let rings = |block: &Block| -> Vec<Vec<Point>> { block.body.polygon.rings().to_vec() };
    let (before, after) = (rings(was), rings(is));
    let same_shape = before.len() == after.len()
        && before
            .iter()
            .zip(&after)
            .all(|(a, b)| a.len() == b.len() && a.iter().zip(b).all(|(p, q)| (q - p - moved).norm() <= 2.0 * near));
    if !same_shape {
        how.push("another outline".to_owned());
    }
    if moved.norm() > near {
        let by = place(Point::from(moved), units);
        how.push(format!("centroid moved by {by}"));
    }
    if (is.weight - was.weight).abs() > 1e-9 * is.weight.abs().max(was.weight.abs()) {
        let [a, b] = [was.weight, is.weight].map(|w| amount(w, units.force()));
        how.push(format!("weight {a} → {b}"));
    }
    if is.body.friction != was.body.friction {
        let (a, b) = (digits(was.body.friction), digits(is.body.friction));
        how.push(format!("friction coefficient {a} → {b}"));
    }
    listed(&how)
}

/// Largest number of differences that a sentence names.
const MAX_NAMED_DIFFERENCES: usize = 4;

/// The inputs of one frame. Each input has a name, a value in words, and the index of the block on which it acts
/// (`None` if it acts on no single block).
type FrameInputs = Vec<(String, String, Option<usize>)>;

/// The inputs that differ between two frames, apart from the blocks.
pub(super) struct Settings {
    /// For each input that differs: its name, its value in the first frame, and its value in the second frame.
    lines: Vec<[String; 3]>,
    /// The indices of the blocks whose loads or robots differ, in the first and in the second frame.
    pub blocks: [Vec<usize>; 2],
}

impl Settings {
    /// Compares the inputs of the two frames with index `number`. `units` are the units of the values in words. They
    /// are the same for both sides, because the words are compared.
    pub fn new(sides: [Side<'_>; 2], number: usize, units: UnitsEntry) -> Settings {
        let [then, now] = sides.map(|side| given(side.analysis.given(), number, units));
        let mut settings = Settings { lines: Vec::new(), blocks: [Vec::new(), Vec::new()] };
        let words = |list: &FrameInputs, name: &str| {
            let found = list.iter().find(|g| g.0 == name);
            found.map_or("none".to_owned(), |g| g.1.clone())
        };
        let mut names: Vec<&str> = then.iter().map(|g| g.0.as_str()).collect();
        for (name, ..) in &now {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        for name in names {
            let both = [&then, &now].map(|list| words(list, name));
            if both[0] == both[1] {
                continue;
            }
            for (list, blocks) in [&then, &now].into_iter().zip(&mut settings.blocks) {
                let found = list.iter().filter(|g| g.0 == name);
                blocks.extend(found.filter_map(|g| g.2));
            }
            let [a, b] = both;
            settings.lines.push([name.to_owned(), a, b]);
        }
        settings
    }

    /// Adds the differences of another step.
    pub fn add(&mut self, other: Settings) {
        self.lines.extend(other.lines);
        let mut known = Vec::new();
        self.lines.retain(|line| {
            !known.contains(line) && {
                known.push(line.clone());
                true
            }
        });
    }

    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    pub fn stated(&self) -> Vec<String> {
        if self.lines.is_empty() {
            return Vec::new();
        }
        let names = self.lines.iter().map(|l| l[0].clone()).collect();
        vec![format!("otherwise: {}", listed(&shortened(names, MAX_NAMED_DIFFERENCES)))]
    }

    pub fn grid(&self) -> Grid {
        let mut grid = Grid::new("What else differs", &["what", "first", "second"]);
        for line in &self.lines {
            grid.add("", line.clone());
        }
        grid
    }
}

/// Returns the inputs of a frame, apart from its blocks, in the given units.
fn given(scene: &Scene, number: usize, units: UnitsEntry) -> FrameInputs {
    let frame = &scene.frames[number];
    let corners = match scene.corner_contacts {
        CornerContacts::All(true) => "carry force",
        CornerContacts::All(false) => "carry none",
        CornerContacts::At(_) => "carry force on edges",
    };
    let mut given: FrameInputs = vec![
        ("gravity".into(), vector(scene.gravity.x, scene.gravity.y, "m/s²"), None),
        ("safety kernel".into(), digits(scene.kernel), None),
        ("corners that touch".into(), corners.into(), None),
    ];
    for (pair, friction) in &scene.friction_pairs {
        let [a, b] = pair.map(|i| line(&scene.materials[i].name));
        given.push((format!("friction of {a} on {b}"), digits(*friction), None));
    }
    for set in &scene.joint_sets {
        let friction = set.friction.map_or_else(|| "as its bodies".to_owned(), digits);
        given.push((format!("friction of the joints {}", line(&set.id)), friction, None));
    }
    for block in &frame.placed {
        let loads = scene.loads.iter().filter(|load| load.block == *block);
        let words: Vec<String> = loads
            .map(|load| {
                let newtons = units.force();
                let [x, y] = [load.force.x, load.force.y].map(|f| newtons.value_from_si(f));
                let force = vector(x, y, &newtons.symbol());
                let torque = match load.torque {
                    0.0 => String::new(),
                    torque => format!(", torque {}", amount(torque, units.torque())),
                };
                let fixed = inputs::fixed_part(scene, load).map_or(String::new(), |part| format!(", {part}"));
                format!("{force} at {}{torque}{fixed}", place(load.at, units))
            })
            .collect();
        if !words.is_empty() {
            let name = format!("load on {}", line(&scene.blocks[block.0].id));
            given.push((name, listed(&words), Some(block.0)));
        }
    }
    for case in scene.cases() {
        given.push((format!("load case {}", line(&case.id)), inputs::factors(scene, case), None));
    }
    if let Some(vehicle) = &scene.vehicle {
        let ways = if vehicle.both_ways { ", both ways" } else { "" };
        given.push(("axles of the vehicle".into(), inputs::axles(vehicle, units) + ways, None));
    }
    for movement in &scene.movements {
        let [x, y] = [movement.translation.x, movement.translation.y].map(|way| units.length().value_from_si(way));
        let turn = match movement.rotation {
            0.0 => String::new(),
            turn => format!(", {}°", digits(turn.to_degrees())),
        };
        let way = vector(x, y, &units.length().symbol()) + &turn;
        given.push((format!("movement of ground {}", movement.ground + 1), way, None));
    }
    for hold in &frame.holds {
        let robot = &scene.robots[hold.robot.0];
        let held = line(&scene.blocks[hold.block.0].id);
        let words = format!("holds {held} at {}, {}", place(hold.at, units), limits(robot.limits, units));
        given.push((format!("robot {}", line(&robot.id)), words, Some(hold.block.0)));
    }
    given
}

fn vector(x: f64, y: f64, unit: &str) -> String {
    format!("({}, {}) {unit}", digits(x), digits(y))
}

fn limits(of: Limits, units: UnitsEntry) -> String {
    let limit = |value: f64, unit: Unit| match value {
        value if value.is_finite() => amount(value, unit),
        _ => "any".to_owned(),
    };
    format!(
        "limits {} across, {} up, {} torque",
        limit(of.fx, units.force()),
        limit(of.fy, units.force()),
        limit(of.torque, units.torque())
    )
}
