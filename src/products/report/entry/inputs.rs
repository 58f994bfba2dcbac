//! Makes the tables of the inputs of a frame: [`materials`], [`loads`], [`vehicle`], [`robots`] and [`facts`].

use super::Grid;
use super::unit::Units;
use crate::geometry::{Vector, range_of};
use crate::mechanics::analysis::SolvedFrame;
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{Axle, BlockId, Case, CornerContacts, Limits, Load, Scene, Vehicle};
use crate::products::wording::number::{amount, counted, digits, place, quantity, tenths};
use crate::products::wording::question;
use crate::text::{first_of, line};

/// Largest number of loads, robots or pairs of materials in a table, unless the report is full.
pub(super) const MAX_ROWS: usize = 12;
/// A row of the table of loads names at most this many blocks.
const MAX_NAMED: usize = 3;

/// Writes the lowest and the highest of several values.
fn range(values: impl Iterator<Item = f64>) -> String {
    match range_of(values) {
        (low, high) if low > high => "–".to_owned(),
        (low, high) => match [low, high].map(digits) {
            [low, high] if low == high => low,
            [low, high] => format!("{low} to {high}"),
        },
    }
}

/// Makes a table with a row for each material of the blocks of a frame.
pub(super) fn materials(scene: &Scene, number: usize, units: Units) -> Grid {
    let mut groups: Vec<(Option<usize>, Vec<BlockId>)> = Vec::new();
    for block in &scene.frames[number].placed {
        let material = scene.blocks[block.0].body.material;
        match groups.iter_mut().find(|g| g.0 == material) {
            Some((_, blocks)) => blocks.push(*block),
            None => groups.push((material, vec![*block])),
        }
    }
    let weight = |blocks: &[BlockId]| -> f64 {
        let weights = blocks.iter().map(|id| scene.blocks[id.0].weight);
        weights.sum()
    };
    let newtons = units.newtons(groups.iter().map(|g| weight(&g.1)));
    let mass = |id: &BlockId| scene.blocks[id.0].mass;
    let has_masses = scene.frames[number].placed.iter().any(|id| mass(id).is_some());
    let mut heads = vec!["material".to_owned(), "#blocks".to_owned(), "#density, kg/m³".to_owned()];
    heads.extend(has_masses.then(|| "#mass of a block, kg".to_owned()));
    heads.extend(["#friction μ".to_owned(), newtons.head("weight")]);
    let mut grid = Grid::new("", &heads);
    for (material, blocks) in &groups {
        let name = match material {
            Some(material) => line(&scene.materials[*material].name),
            None => if groups.len() == 1 { "all blocks" } else { "other blocks" }.to_owned(),
        };
        let densities = blocks.iter().filter_map(|id| density(scene, *id));
        let frictions = blocks.iter().map(|id| scene.blocks[id.0].body.friction);

        let mut cells = vec![name, blocks.len().to_string(), range(densities)];
        cells.extend(has_masses.then(|| range(blocks.iter().filter_map(mass))));
        cells.extend([range(frictions), newtons.write(weight(blocks))]);
        grid.add("", cells);
    }
    grid
}

/// Returns the density of a block in kg/m³, computed from its weight and outline. Returns `None` if the file gives its
/// weight or mass instead, or if gravity or thickness is zero.
fn density(scene: &Scene, block: BlockId) -> Option<f64> {
    let own = &scene.blocks[block.0];
    if !own.weighs_by_area {
        return None;
    }
    let volume = own.body.polygon.area() * scene.thickness;
    let density = own.weight / (scene.gravity.norm() * volume);
    // Rounding to seven digits removes the rounding error of this division, so that equal densities compare as equal.
    density.is_finite().then(|| format!("{density:.6e}").parse().unwrap_or(density))
}

/// Writes what a load case consists of: `1.35 × earth, 0.9 × weights`.
pub(super) fn factors(given: &Scene, case: &Case) -> String {
    let ids = &given.load_ids;
    let name =
        |number: usize| ids.get(number).and_then(|id| id.as_deref()).map_or(format!("load {}", number + 1), line);
    let loads = case.loads.iter().enumerate().filter(|(_, factor)| **factor != 0.0);
    let loads = loads.map(|(number, factor)| (name(number), *factor)).chain([("weights".to_owned(), case.weights)]);
    let part = |(name, factor): (String, f64)| {
        if factor == 1.0 { name } else { format!("{} × {name}", digits(factor)) }
    };
    first_of(loads.map(part).collect::<Vec<_>>(), MAX_ROWS)
}

/// Makes a table with a row for each load of a frame, also for the axles of a vehicle at the position that governs: loads
/// that the scene as it is `given` does not have. Loads after the first `most` share one row with their sum.
pub(super) fn loads(given: &Scene, solved: SolvedFrame<'_>, most: usize) -> Grid {
    let SolvedFrame { scene, number, .. } = solved;
    let units = Units::new(solved);
    let axles_from = given.loads.iter().map(|load| load.entry + 1).max().unwrap_or(0);
    let placed = &scene.frames[number].placed;
    let loads = scene.loads_on(placed);
    let newtons = units.newtons(loads.iter().map(|l| l.force.norm()));
    let torques = units.torques(loads.iter().map(|l| l.torque));
    let metres = units.lengths(loads.iter().flat_map(|l| [l.at.x, l.at.y]));
    let turns = loads.iter().any(|l| l.torque != 0.0);
    let mut heads =
        vec!["load on".to_owned(), metres.head("x"), metres.head("y"), newtons.head("force"), "direction".to_owned()];
    heads.extend(turns.then(|| torques.head("torque")));
    let mut grid = Grid::new("", &heads);
    let name = |block: BlockId| line(&scene.blocks[block.0].id);
    // A pressure acts on several blocks; the row gives its resultant.
    let target = |load: &Load| {
        let parts = scene.loads.iter().filter(|part| part.entry == load.entry && placed.contains(&part.block));
        let mut blocks: Vec<BlockId> = parts.map(|part| part.block).collect();
        blocks.dedup();
        let target = match load.spread {
            Some(_) => format!("pressure on {}", first_of(blocks.into_iter().map(name), MAX_NAMED)),
            None => name(load.block),
        };
        if load.entry >= axles_from {
            return format!("axle {} on {target}", load.entry - axles_from + 1);
        }
        let fixed = fixed_part(scene, load).map_or(String::new(), |part| format!(" ({part})"));
        // The figures write this id at the load.
        scene.load_id(load).map_or(target.clone(), |id| format!("{}: {target}", line(id))) + &fixed
    };
    for load in loads.iter().take(most) {
        let mut cells = vec![
            target(load),
            metres.write(load.at.x),
            metres.write(load.at.y),
            newtons.write(load.force.norm()),
            direction(load.force),
        ];
        cells.extend(turns.then(|| torques.write(load.torque)));
        grid.add("", cells);
    }
    if loads.len() > most {
        let rest = &loads[most..];
        let sum: Vector = rest.iter().map(|l| l.force).sum();
        let what = format!("{} more, together", rest.len());
        let mut cells = vec![what, "–".into(), "–".into(), newtons.write(sum.norm()), direction(sum)];
        cells.extend(turns.then(|| torques.write(rest.iter().map(|l| l.torque).sum())));
        grid.add("", cells);
    }
    grid
}

/// Describes the direction of a force: `downwards`, `to the right`, `down and right, 30.0° from the vertical`. Returns
/// `–` for a force of 0.
fn direction(force: Vector) -> String {
    let negligible = 1e-9 * force.norm();
    let across = match force.x {
        x if x > negligible => Some("right"),
        x if x < -negligible => Some("left"),
        _ => None,
    };
    let along = match force.y {
        y if y > negligible => Some("up"),
        y if y < -negligible => Some("down"),
        _ => None,
    };
    match (across, along) {
        (None, None) => "–".to_owned(),
        (None, Some(along)) => format!("{along}wards"),
        (Some(across), None) => format!("to the {across}"),
        (Some(across), Some(along)) => {
            let angle = libm::atan2(force.x.abs(), force.y.abs()).to_degrees();
            format!("{along} and {across}, {angle:.1}° from the vertical")
        }
    }
}

/// Makes a table of the robots that hold blocks in a frame, with the limits of their forces and torques. Robots after
/// the first `most` are only counted.
pub(super) fn robots(scene: &Scene, number: usize, most: usize) -> Grid {
    let holds = &scene.frames[number].holds;
    let mut grid = Grid::new("", &["robot", "holds", "at", "limits: horizontal, vertical, torque"]);
    for hold in holds.iter().take(most) {
        let robot = &scene.robots[hold.robot.0];
        let cells = [
            line(&robot.id),
            line(&scene.blocks[hold.block.0].id),
            place(hold.at, scene.units),
            limits(robot.limits, scene.units),
        ];
        grid.add("", cells);
    }
    if holds.len() > most {
        let more = format!("{} more", holds.len() - most);
        grid.add("", [more, String::new(), String::new(), String::new()]);
    }
    grid
}

/// Makes a table of the axles of the vehicle, if the scene has one.
pub(super) fn vehicle(scene: &Scene, units: Units) -> Grid {
    let axles = scene.vehicle.iter().flat_map(|vehicle| &vehicle.axles);
    let newtons = units.newtons(axles.clone().map(|axle| axle.weight));
    let metres = units.lengths(axles.clone().map(|axle| axle.offset));
    let mut grid = Grid::new("", &["axle".to_owned(), newtons.head("weight"), metres.head("behind the first")]);
    for (number, axle) in axles.enumerate() {
        grid.add("", [(number + 1).to_string(), newtons.write(axle.weight), metres.write(axle.offset)]);
    }
    grid
}

/// Lists the axles of a vehicle: `100 kN, 80 kN 3.2 m behind`.
pub(super) fn axles(vehicle: &Vehicle, units: UnitsEntry) -> String {
    let axle = |axle: &Axle| match axle.offset {
        0.0 => quantity(axle.weight, units.force()),
        offset => format!("{} {} behind", quantity(axle.weight, units.force()), amount(offset, units.length())),
    };
    first_of(vehicle.axles.iter().map(axle), MAX_ROWS)
}

/// Says which part of a load a load factor does not multiply; `None` if it multiplies the whole load.
pub(super) fn fixed_part(scene: &Scene, load: &Load) -> Option<&'static str> {
    match load.fixed_along {
        _ if load.is_fixed => Some("fixed"),
        Some(along) if along.dot(&scene.down()).abs() > 0.5 => Some("vertical part fixed"),
        Some(_) => Some("horizontal part fixed"),
        None => None,
    }
}

fn limits(limits: Limits, units: UnitsEntry) -> String {
    let limit = |value: f64, words: String| if value.is_finite() { words } else { "none".to_owned() };
    let parts = [
        limit(limits.fx, quantity(limits.fx, units.force())),
        limit(limits.fy, quantity(limits.fy, units.force())),
        limit(limits.torque, quantity(limits.torque, units.torque())),
    ];
    parts.join(", ")
}

/// Makes a table of the other inputs of a scene as it is given: gravity, thickness, course of the vehicle, movements, ground,
/// friction of pairs of materials, kernel, corner contacts and tolerance. Of each kind it has at most `most` rows.
pub(super) fn facts(scene: &Scene, number: usize, most: usize) -> Grid {
    let mut grid = Grid::new("", &["input", "value"]);
    let mut add = |what: &str, value: String| grid.add("", [what.to_owned(), value]);
    let gravity = match scene.gravity.norm() {
        0.0 => "none".to_owned(),
        g => format!("{} m/s² {}", digits(g), direction(scene.gravity)),
    };
    add("gravity", gravity);
    let placed = &scene.frames[number].placed;
    if !scene.loads.iter().any(|l| placed.contains(&l.block)) {
        add("loads", "none but the weights".to_owned());
    }
    add("thickness, into the page", amount(scene.thickness, scene.units.length()));
    if let Some(vehicle) = &scene.vehicle {
        let over = vehicle.over.iter().map(|block| line(&scene.blocks[block.0].id)).collect::<Vec<_>>();
        let over = if over.is_empty() { "the tops of all blocks".to_owned() } else { first_of(over, most) };
        let ways = if vehicle.both_ways { "both ways" } else { "to the right" };
        add("vehicle travels", format!("{ways}, over {over}"));
    }
    for moved in 0..scene.movements.len().min(most) {
        add("movement of a support", line(&question::movement(scene, moved)));
    }
    let friction = range(scene.ground.iter().map(|g| g.body.friction));
    let ground = match scene.ground.len() {
        0 => "none".to_owned(),
        parts => format!("{}, fixed; friction μ {friction}", counted(parts, "part")),
    };
    add("ground", ground);
    for (pair, friction) in scene.friction_pairs.iter().take(most) {
        let [a, b] = pair.map(|i| line(&scene.materials[i].name));
        add(&format!("μ of {a} on {b}"), digits(*friction));
    }
    for set in scene.joint_sets.iter().filter(|set| set.friction.is_some()).take(most) {
        add(&format!("μ of the joints {}", line(&set.id)), set.friction.map(digits).unwrap_or_default());
    }
    let kernel = match scene.kernel {
        0.0 => "0".to_owned(),
        kernel => format!("{}: forces stay in the middle {} of each joint", digits(kernel), tenths(1.0 - kernel)),
    };
    add("safety kernel", kernel);
    match scene.corner_contacts {
        CornerContacts::All(false) => {}
        CornerContacts::All(true) => add("corners", "corners that touch carry force".to_owned()),
        CornerContacts::At(_) => add("corners", "corners that touch an edge carry force".to_owned()),
    }
    if scene.healed.corners > 0 {
        let moved = scene.tolerance_words().unwrap_or_default();
        add("tolerance", line(&moved));
    }
    grid
}
