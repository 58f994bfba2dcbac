//! Describes the answers to questions that a user or a scene asks about a frame beyond its verdict: load cases, how
//! accurately blocks must be placed, which blocks may leave, what reaches a target, movements of supports, and vehicles.

use super::failure::{pair, shortened};
use super::number::{NO_BREAK, amount, counted, digits, listed, place, quantity, three, three_down, three_up};
use crate::geometry::Point;
use crate::mechanics::analysis::{
    Analysis, CaseResult, Condition, Crack, Cracked, FrameAnalysis, Influence, MarginKind, MovementOutcome, Placement,
    PlacementLimit, Removable, SolvedFrame, SupportMovement, VehiclePosition, Verdict,
};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::text::line;

/// Names the case to which the results of a frame belong; `None` if the scene has no cases.
pub fn worst_case(found: &FrameAnalysis) -> Option<String> {
    let cases = found.cases.as_ref()?;
    let word = if cases.is_worst { "worst case" } else { "case" };
    Some(format!("{word}: {}", line(&cases.each[cases.governing].id)))
}

/// Names the conditions that decide an answer: `case wind`, `case wind and case snow with the vehicle`. `None` if the scene
/// has neither cases nor a vehicle that decides.
pub fn conditions(found: &FrameAnalysis, conditions: impl IntoIterator<Item = Condition>) -> Option<String> {
    let name = |condition: Condition| {
        let case = condition.case.zip(found.cases.as_ref()).map(|(case, cases)| {
            let id = line(&cases.each[case].id);
            if id.contains(' ') { format!("“{id}”") } else { id }
        });
        match (case, condition.position) {
            (Some(case), None) => Some(format!("case {case}")),
            (Some(case), Some(_)) => Some(format!("case {case} with the vehicle")),
            (None, Some(_)) => Some("the vehicle".to_owned()),
            (None, None) => None,
        }
    };
    let mut names: Vec<String> = conditions.into_iter().filter_map(name).collect();
    names.dedup();
    (!names.is_empty()).then(|| listed(&names))
}

/// Names what the margin `friction_factor` multiplies: `its friction`, or `the friction of head joints`.
pub fn factored_friction(scene: &Scene) -> String {
    let sets: Vec<String> = scene.factored_sets().map(line).collect();
    if sets.is_empty() { "its friction".to_owned() } else { format!("the friction of {}", listed(&sets)) }
}

/// Returns a line for each case with its verdict and its margin, the worst case marked.
pub fn case_lines(found: &FrameAnalysis) -> Vec<String> {
    let Some(cases) = &found.cases else {
        return Vec::new();
    };
    let mark = |number: usize| match cases.is_worst {
        _ if number != cases.governing => "",
        true => " (the worst case)",
        false => " (its forces are listed)",
    };
    let each = cases.each.iter().enumerate();
    each.map(|(number, case)| format!("case {}: {}{}", line(&case.id), case_verdict(case), mark(number))).collect()
}

/// Returns the verdict of a case in words, with its load factor or its tilt if they were computed.
pub fn case_verdict(case: &CaseResult) -> String {
    let words = case.verdict.plain();
    use MarginKind::{LoadFactor, Tilt};
    let Some(margins) = case.margins.as_ref().filter(|_| case.verdict == Verdict::Stable) else {
        return words.to_owned();
    };
    match (margins.most(LoadFactor), margins.least(Tilt), margins.most(Tilt)) {
        (Some(factor), ..) => format!("{words}, carries its loads times {}", three_down(factor)),
        (None, Some(left), Some(right)) => {
            format!("{words}, falls at {}° to the left, {}° to the right", three_down(-left), three_down(right))
        }
        _ => words.to_owned(),
    }
}

/// Writes a length in the unit of the scene, or in millimetres if the scene gives no unit, with a rounding to one side.
pub fn placement_length(scene: &Scene, metres: f64, rounded: fn(f64) -> String) -> String {
    let unit = scene.units.length();
    if unit.is_chosen {
        return format!("{} {}", rounded(unit.value_from_si(metres)), unit.symbol());
    }
    format!("{} mm", rounded(1e3 * metres))
}

/// States the proved placement tolerance in a few words, for figures.
pub fn placement_proved(scene: &Scene, placement: &Placement) -> String {
    format!("safe for all errors up to {}", placement_length(scene, placement.proved, three_down))
}

/// Describes the placement tolerance of a frame in one sentence without a full stop.
pub fn placement_sentence(solved: SolvedFrame<'_>, placement: &Placement) -> String {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let stands = format!(
        "stands for all errors up to {} (all blocks, their centres of gravity and their loads at once)",
        placement_length(scene, placement.proved, three_down)
    );
    let falls = placement.falls_at.map(|at| {
        let block = placement.block.map(|block| format!("; {} decides", scene.name(BodyId::Block(block))));
        format!(
            "; falls with a pattern of errors of {}{}",
            placement_length(scene, at, three_up),
            block.unwrap_or_default()
        )
    });
    let joint = placement.joint.and_then(|joint| frame_analysis.contacts.get(joint));
    let why = match placement.limited_by {
        PlacementLimit::Balance => String::new(),
        PlacementLimit::JointLength => match joint {
            Some(contact) => {
                format!("; beyond it the joint of {} has no length left", pair(scene, contact.interface.bodies))
            }
            None => "; beyond it a joint has no length left".to_owned(),
        },
        PlacementLimit::PointContact => "; a contact that acts at one point leaves no room for errors".to_owned(),
        PlacementLimit::TooManyBlocks => "; the structure has too many blocks for this test".to_owned(),
        PlacementLimit::Search => "; the search ended before the optimum".to_owned(),
        PlacementLimit::TimeLimit => "; the time limit ended the search".to_owned(),
    };
    let governed = conditions(frame_analysis, placement.conditions).map(|names| format!("; governed by {names}"));
    stands + &falls.unwrap_or_default() + &why + &governed.unwrap_or_default()
}

/// At most this many blocks are named.
const MAX_FREE_NAMED: usize = 8;

/// Says which blocks may leave, what helps the others, and which robots a falling frame needs: phrases without a full
/// stop.
pub fn removable_phrases(scene: &Scene, rows: &[Removable]) -> Vec<String> {
    let name = |block: BlockId| scene.blocks[block.0].id.as_str();
    let force = |newtons: f64| quantity(newtons, scene.units.force());
    let free = rows.iter().filter(|row| row.rest == Verdict::Stable);
    let free: Vec<String> = free.map(|row| name(row.block).to_owned()).collect();
    let mut phrases = vec![match free.len() {
        0 => "no block may leave alone".to_owned(),
        n => {
            let of = counted(rows.len(), "block");
            format!("{n} of {of} may leave alone: {}", listed(&shortened(free, MAX_FREE_NAMED)))
        }
    }];
    let helped = rows.iter().filter_map(|row| Some((row.block, row.help?)));
    if let Some((block, help)) = helped.clone().min_by(|a, b| a.1.force.total_cmp(&b.1.force)) {
        phrases.push(format!(
            "{} may leave while a robot holds another one: the least help is {} on {} for {}",
            counted(helped.count(), "block"),
            force(help.force),
            name(help.block),
            name(block)
        ));
    }
    let held = rows.iter().filter(|row| row.force.is_some_and(|f| f > 0.0));
    let held = held.map(|row| format!("{} on {}", row.force.map(force).unwrap_or_default(), name(row.block)));
    let held: Vec<String> = held.collect();
    if !held.is_empty() {
        phrases.push(format!(
            "it stands with a robot's force of at least {}",
            shortened(held, MAX_FREE_NAMED).join(" or ")
        ));
    }
    phrases
}

/// Says for each block whether it may leave, with what help, and with which least force a robot must hold it otherwise:
/// the cells of the rows of a table.
#[cfg(any(feature = "report", feature = "cli"))]
pub fn removable_rows(scene: &Scene, rows: &[Removable]) -> Vec<[String; 3]> {
    let name = |block: BlockId| scene.blocks[block.0].id.clone();
    let force = |newtons: f64| quantity(newtons, scene.units.force());
    let row = |row: &Removable| {
        let may = match (row.rest, row.help) {
            (Verdict::Stable, _) => "yes".to_owned(),
            (Verdict::Undecided, _) => "undecided".to_owned(),
            (_, Some(help)) => format!("while a robot holds {} with {}", name(help.block), force(help.force)),
            (_, None) => "no".to_owned(),
        };
        let held = row.force.filter(|force| *force > 0.0).map_or(String::new(), force);
        [name(row.block), may, held]
    };
    rows.iter().map(row).collect()
}

/// The largest number of joints that a sentence names.
const MAX_NAMED_JOINTS: usize = 3;

/// Describes a movement: `left moves by (−0.01, 0) m and turns by 0.2°`.
pub fn movement(scene: &Scene, number: usize) -> String {
    let movement = &scene.movements()[number];
    let by = (movement.translation.norm() > 0.0)
        .then(|| format!("moves by {}", place(Point::from(movement.translation), scene.units())));
    let turns = (movement.rotation != 0.0).then(|| format!("turns by {}°", digits(movement.rotation.to_degrees())));
    let ways: Vec<String> = by.into_iter().chain(turns).collect();
    format!("{} {}", scene.name(BodyId::Ground(movement.ground)), listed(&ways))
}

/// Writes the force of the structure on the support: `H = 190 N, V = −1000 N`.
pub fn movement_force(scene: &Scene, cracked: &Cracked) -> String {
    let unit = scene.units().force();
    let written = [cracked.force.x, cracked.force.y].map(|amount| quantity(amount, unit));
    format!("H{NO_BREAK}={NO_BREAK}{}, V{NO_BREAK}={NO_BREAK}{}", written[0], written[1])
}

/// Writes an amount per unit of the movement: `0.62 mm/mm`.
pub fn per_unit(amount: f64) -> String {
    format!("{}{NO_BREAK}mm/mm", three(amount))
}

/// Describes the joints that open or slide most.
pub fn cracks(solved: SolvedFrame<'_>, cracked: &Cracked) -> String {
    let SolvedFrame { scene, found, .. } = solved;
    let mut widest: Vec<&Crack> = cracked.cracks.iter().collect();
    widest.sort_by(|a, b| b.opening.total_cmp(&a.opening).then(a.contact.cmp(&b.contact)));
    let one = |crack: &&Crack| {
        let names = pair(scene, found.contacts[crack.contact].interface.bodies);
        let slides =
            if crack.slip == 0.0 { String::new() } else { format!(" and slide {}", per_unit(crack.slip.abs())) };
        format!("{names} open {}{slides}", per_unit(crack.opening))
    };
    let named: Vec<String> = widest.iter().take(MAX_NAMED_JOINTS).map(one).collect();
    let more = widest.len().saturating_sub(MAX_NAMED_JOINTS);
    let more = if more > 0 { format!("; {} more", counted(more, "joint")) } else { String::new() };
    format!("{}{more}", listed(&named))
}

/// Returns one sentence, without a full stop, about a movement of a support: the force on the support, and which joints
/// open or slide and by how much.
pub fn movement_sentence(solved: SolvedFrame<'_>, moved: &SupportMovement) -> String {
    let SolvedFrame { scene, .. } = solved;
    let first = movement(scene, moved.number);
    match &moved.outcome {
        MovementOutcome::Follows(cracked) => format!(
            "if {first}, the structure pushes it with {}; {} (small displacements; sliding also opens a joint)",
            movement_force(scene, cracked),
            cracks(solved, cracked)
        ),
        other => format!("if {first}, {}", without_state(other)),
    }
}

/// Returns a sentence, without a full stop, about each movement of a support. With load cases, it ends with the force on the
/// support in the other cases.
pub fn movement_sentences(solved: SolvedFrame<'_>) -> Vec<String> {
    let SolvedFrame { scene, found, .. } = solved;
    let of_cases = found.cases.iter().flat_map(|cases| cases.each.iter().enumerate().map(|own| (cases.governing, own)));
    let others: Vec<&CaseResult> =
        of_cases.filter(|(governing, (number, _))| governing != number).map(|(_, (_, case))| case).collect();
    let sentence = |moved: &SupportMovement| {
        let in_others = others.iter().filter_map(|case| {
            let own = case.movements.iter().find(|own| own.number == moved.number)?;
            let words = match &own.outcome {
                MovementOutcome::Follows(cracked) => movement_force(scene, cracked),
                other => without_state(other).to_owned(),
            };
            Some(format!("; in case {}: {words}", line(&case.id)))
        });
        movement_sentence(solved, moved) + &in_others.collect::<String>()
    };
    found.movements.iter().map(sentence).collect()
}

/// States the first movement for a headline: how wide the widest joint opens, or that the structure does not follow.
pub fn movement_headline(solved: SolvedFrame<'_>) -> Option<String> {
    let SolvedFrame { scene, found, .. } = solved;
    let moved = found.movements.first()?;
    let first = movement(scene, moved.number);
    let more = match found.movements.len() {
        1 => String::new(),
        count => format!(" (1 of {count} movements)"),
    };
    let words = match &moved.outcome {
        MovementOutcome::Follows(cracked) => {
            let widest = cracked.cracks.iter().map(|crack| crack.opening).fold(0.0, f64::max);
            let opens = match cracked.cracks.len() {
                0 => "follows without a crack".to_owned(),
                count => {
                    let (joints, open) = (counted(count, "joint"), if count == 1 { "opens" } else { "open" });
                    format!("{joints} {open} by up to {}", quantity(widest * cracked.unit, scene.units().length()))
                }
            };
            format!("{opens} if {first}")
        }
        other => format!("{}, if {first}", without_state(other)),
    };
    Some(words + &more)
}

/// Says why a structure does not follow.
pub fn without_state(outcome: &MovementOutcome) -> &'static str {
    match outcome {
        MovementOutcome::Follows(_) => "the structure cracks and follows",
        MovementOutcome::Jams => "rigid blocks cannot follow: the support would have to crush them",
        MovementOutcome::Untouched => "no block touches it where it moves",
        MovementOutcome::Unsolved => "the solver found no result",
    }
}

/// Describes a position: `first axle at x = 3.2 m, travelling to the right, on A4`.
pub fn vehicle_position(scene: &Scene, position: &VehiclePosition) -> String {
    let mut blocks: Vec<String> = position.axles.iter().map(|axle| scene.blocks()[axle.1.0].id.clone()).collect();
    blocks.dedup();
    let toward = match scene.vehicle() {
        Some(vehicle) if vehicle.axles.len() > 1 && position.to_right => ", travelling to the right",
        Some(vehicle) if vehicle.axles.len() > 1 => ", travelling to the left",
        _ => "",
    };
    format!("first axle at x = {}{toward}, on {}", amount(position.at, scene.units().length()), listed(&blocks))
}

/// States the least factor in a few words: `carries 2.31 × the vehicle`. The factor multiplies the listed loads too, unless
/// they are fixed.
pub fn vehicle_factor(scene: &Scene, influence: &Influence) -> String {
    match influence.governing.and_then(|number| influence.positions[number].factor) {
        None => "carries any multiple of the vehicle".to_owned(),
        Some(factor) if factor < 1.0 => {
            format!("falls under the vehicle: it carries {} × its weight, and stands without it", three_down(factor))
        }
        Some(factor) => {
            let mut loads = scene.loads().iter().filter(|load| !load.is_fixed);
            let is_loaded = loads.any(|load| load.force.norm() > 0.0 || load.torque != 0.0);
            format!("carries {} × the vehicle{}", three_down(factor), if is_loaded { " and its loads" } else { "" })
        }
    }
}

/// States in a few words what a frame does under its vehicle, for the line of the verdict: `carries 2.31 × the vehicle`.
/// `None` if the scene has no vehicle, if no position limits it, or if the frame falls without it.
pub fn vehicle_headline(solved: SolvedFrame<'_>) -> Option<String> {
    let SolvedFrame { scene, found, .. } = solved;
    let influence = found.vehicle.as_ref();
    let factor = influence.and_then(|own| own.positions[own.governing?].factor);
    match found.under_vehicle {
        Some(under) => {
            let alone = format!("{} without it", under.alone.verb());
            let carries = factor.map(|factor| format!("carries {} × its weight, ", three_down(factor)));
            Some(format!("under its vehicle: {}{alone}", carries.unwrap_or_default()))
        }
        None if found.verdict == Verdict::Stable => {
            influence.filter(|_| factor.is_some()).map(|own| vehicle_factor(scene, own))
        }
        None => None,
    }
}

/// Describes the governing position of a vehicle in one sentence without a full stop.
pub fn vehicle_sentence(scene: &Scene, influence: &Influence) -> String {
    let count = counted(influence.positions.len(), "position");
    let governing = influence.governing.map(|number| vehicle_position(scene, &influence.positions[number]));
    let at = governing.map_or(String::new(), |at| format!("; it governs with the {at}"));
    format!("{}{at} ({count})", vehicle_factor(scene, influence))
}

/// Describes the range of the horizontal thrust at the supports of a frame (numbered from 0) in a sentence without a full
/// stop. `None` if there is no single thrust, or if it would take too long to compute
/// ([`Analysis::thrust_states`]).
pub fn thrust_range(analysis: &Analysis, frame: usize) -> Option<String> {
    let states = analysis.thrust_states(frame);
    let force = |thrust: f64| quantity(thrust, analysis.given().units.force());
    let (least, greatest) = (force(states.least?.thrust), states.greatest.map(|state| force(state.thrust)));
    Some(match greatest {
        Some(greatest) if greatest == least => format!("The horizontal thrust is {least} in all of them"),
        Some(greatest) => format!("The horizontal thrust H may lie between {least} and {greatest}"),
        None => format!("The horizontal thrust H is at least {least}"),
    })
}
