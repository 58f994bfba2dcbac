//! [`Settings`]: the inputs that differ between two frames, apart from their blocks: gravity, kernel, corner contacts,
//! friction of pairs of materials, loads and robots.

use super::Side;
use crate::mechanics::scene::Unit;
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{Limits, Scene};
use crate::products::report::entry::Grid;
use crate::products::wording::failure::shortened;
use crate::products::wording::number::{amount, digits, listed, place};
use crate::text::line;

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
        let [then, now] = sides.map(|side| given(&side.analysis.scene, number, units));
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
    let corners = if scene.corner_contacts { "carry force" } else { "carry none" };
    let mut given: FrameInputs = vec![
        ("gravity".into(), vector(scene.gravity.x, scene.gravity.y, "m/s²"), None),
        ("safety kernel".into(), digits(scene.kernel), None),
        ("corners that touch".into(), corners.into(), None),
    ];
    for (pair, friction) in &scene.friction_pairs {
        let [a, b] = pair.map(|i| line(&scene.materials[i].name));
        given.push((format!("friction of {a} on {b}"), digits(*friction), None));
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
                format!("{force} at {}{torque}", place(load.at, units))
            })
            .collect();
        if !words.is_empty() {
            let name = format!("load on {}", line(&scene.blocks[block.0].id));
            given.push((name, listed(&words), Some(block.0)));
        }
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
