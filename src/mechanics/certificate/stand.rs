//! Forces with slack for the proof that a frame stands, and the order in which the residuals of its bodies are corrected.

use std::collections::{BTreeMap, BinaryHeap};

use super::check::LARGEST_STEP;
use super::{FrameForm, Step};
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::program::{Force, Program, Scale, columns};
use crate::mechanics::solve::{Amounts, Conditioning, Limit, any_balance, balance, largest_factor};
use crate::mechanics::statics::assembly::Assembly;

/// If all contacts may press without limit, as a wedged stone does, each normal force gets this share of the heaviest
/// load.
const SLACK_OF_WEDGED: f64 = 0.1;

/// The share of each robot's limit that is kept as slack.
const SLACK_OF_ROBOTS: f64 = 1e-6;

/// The largest number of bodies that are corrected at once.
pub(super) const MAX_AT_ONCE: usize = 16;

/// Returns any forces that balance the loads, as an interior-point method finds them: far from the limits of most contacts.
/// `None` if a program has no result.
pub(super) fn inner_forces(assembly: &Assembly) -> Option<Vec<[f64; 3]>> {
    forces_of(assembly, |program| Some((any_balance(program).forces?, 0.0)))
}

/// Returns the forces with the largest slack. `None` if a program has no result.
pub(super) fn slack_forces(assembly: &Assembly) -> Option<Vec<[f64; 3]>> {
    forces_of(assembly, |program| {
        // The direction in which the loads change if each contact point takes one unit of pressure for itself.
        let mut pressures = vec![0.0; program.loads.len()];
        for column in columns(program) {
            if matches!(column.force, Force::Ray { friction: 0.0, .. }) {
                column.add_to(&mut pressures, -1.0);
            }
        }
        let found = largest_factor(program, &pressures);
        if let Limit::At(slack) = found.limit {
            return Some((found.forces?, slack));
        }
        let slack = SLACK_OF_WEDGED * Scale::HEAVIEST;
        for (load, pressure) in program.loads.iter_mut().zip(&pressures) {
            *load += slack * pressure;
        }
        Some((balance(program, Conditioning::Full).forces?, slack))
    })
}

/// Returns the forces of all components in the order of [`listed_forces`], from the forces of each program and what is
/// added to each of its normal forces. Robots keep some slack.
fn forces_of(assembly: &Assembly, solve: impl Fn(&mut Program) -> Option<(Amounts, f64)>) -> Option<Vec<[f64; 3]>> {
    let count = assembly.contacts.len();
    let mut forces = vec![[0.0; 3]; count + assembly.grips.len()];
    for component in assembly.components() {
        let mut program = Program::new(&component, Scale::from_assembly(&component));
        for limit in program.grips.iter_mut().flat_map(|grip| &mut grip.limits) {
            *limit *= 1.0 - SLACK_OF_ROBOTS;
        }
        let interfaces: Vec<usize> = component.contacts.iter().map(|contact| contact.interface).collect();
        let holds: Vec<usize> = component.grips.iter().map(|grip| grip.hold).collect();
        let places = links_of(assembly, &interfaces, &holds);
        let (amounts, slack) = solve(&mut program)?;
        let unit = program.scale.force;
        let (contacts, grips) = places.split_at(component.contacts.len());
        for (k, (place, contact)) in contacts.iter().zip(&component.contacts).enumerate() {
            let points = contact.points_in_use();
            let more = |point: usize| if point < points { slack } else { 0.0 };
            let [n1, n2] = [0, 1].map(|i| (amounts.normal[k][i] + more(i)) * unit);
            forces[*place] = [n1, n2, amounts.friction[k] * unit];
        }
        for (place, [x, y, moment]) in grips.iter().zip(&amounts.grip) {
            forces[*place] = [x * unit, y * unit, moment * program.scale.moment()];
        }
    }
    Some(forces)
}

/// Returns the places of contacts and of grips, given by their indices in the frame, in the order of [`listed_forces`].
pub(super) fn links_of(assembly: &Assembly, interfaces: &[usize], holds: &[usize]) -> Vec<usize> {
    let of_contact: BTreeMap<_, _> = assembly.contacts.iter().map(|c| c.interface).zip(0..).collect();
    let of_grip: BTreeMap<_, _> = assembly.grips.iter().map(|g| g.hold).zip(assembly.contacts.len()..).collect();
    interfaces.iter().map(|i| of_contact[i]).chain(holds.iter().map(|i| of_grip[i])).collect()
}

/// A component of a force that may change, with the force and moment about the body's centroid that it exerts, and its
/// slack in newtons.
struct Change {
    number: usize,
    wrench: [f64; 3],
    slack: f64,
}

/// Returns the order of corrections: bodies far from the ground first, each with components of forces that lead on to
/// bodies nearer to the ground.
///
/// From the ground outward, the body whose contact with an anchored body has the largest slack is anchored next. If no
/// body has such a contact with two points and friction, one with independent components at several contacts is taken.
/// Three are needed, or fewer if all forces on the body span fewer dimensions, as in a stack without friction. Bodies that
/// remain, or all bodies with `at_once`, are corrected at once. Also returns the least slack of the components that correct
/// single bodies; −∞ if bodies remain.
pub(super) fn order(assembly: &Assembly, frame: &FrameForm, forces: &[[f64; 3]], at_once: bool) -> (Vec<Step>, f64) {
    let count = assembly.bodies.len();
    let mut links_of: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (k, contact) in assembly.contacts.iter().enumerate() {
        links_of[contact.on].push(k);
        if let Some(from) = contact.from {
            links_of[from].push(k);
        }
    }
    for (k, grip) in assembly.grips.iter().enumerate() {
        links_of[grip.body].push(assembly.contacts.len() + k);
    }
    // The components of a link that may change the balance of a body.
    let changes = |link: usize, body: usize| -> Vec<Change> {
        let centroid = assembly.bodies[body].centroid;
        let change = |i: usize, force: Vector, at: Point, torque: f64, slack: f64| {
            let moment = (cross(at - centroid, force) + torque) / assembly.length;
            Change { number: 3 * link + i, wrench: [force.x, force.y, moment], slack }
        };
        let [one, two, three] = forces[link];
        if let Some(contact) = assembly.contacts.get(link) {
            let (axis, along) = (contact.normal, quarter_turn(contact.normal));
            let friction = (contact.friction * (one + two) - three.abs()) / (1.0 + contact.friction);
            let (first, second) =
                if contact.friction > 0.0 { (one.min(friction), two.min(friction)) } else { (one, two) };
            let mut list = vec![change(0, axis, contact.points[0], 0.0, first)];
            if frame.contacts[link].points.len() == 2 {
                list.push(change(1, axis, contact.points[1], 0.0, second));
            }
            if contact.friction > 0.0 {
                list.push(change(2, along, contact.points[0], 0.0, friction));
            }
            return list;
        }
        let grip = &assembly.grips[link - assembly.contacts.len()];
        let axes = [
            (Vector::x(), 0.0, grip.limits.fx),
            (Vector::y(), 0.0, grip.limits.fy),
            (Vector::zeros(), 1.0, grip.limits.torque),
        ];
        let changes = axes.into_iter().enumerate().filter(|(_, (.., limit))| *limit > 0.0);
        changes
            .map(|(i, (force, torque, limit))| {
                let unit = if i == 2 { assembly.length } else { 1.0 };
                change(i, force, grip.at, torque, (limit - forces[link][i].abs()) / unit)
            })
            .collect()
    };
    let other = |link: usize, body: usize| match assembly.contacts.get(link) {
        Some(contact) if contact.on == body => contact.from,
        Some(contact) => Some(contact.on),
        None => None,
    };
    // The number of dimensions of the loads and of all forces on each body.
    let dimensions = (0..count).map(|body| {
        let mut all: Vec<Change> = links_of[body].iter().flat_map(|link| changes(*link, body)).collect();
        let load = assembly.bodies[body].load;
        let wrench = [load.force.x, load.force.y, load.moment / assembly.length];
        all.push(Change { number: 0, wrench, slack: 0.0 });
        independent(&all).len()
    });
    let dimensions: Vec<usize> = dimensions.collect();
    let whole = |link: usize, body: usize| {
        let changes = changes(link, body);
        let chosen = independent(&changes);
        let slack = changes.iter().map(|change| change.slack).fold(f64::INFINITY, f64::min);
        (chosen.len() == dimensions[body]).then_some((slack, chosen))
    };

    let mut is_anchored = vec![false; count];
    let mut order: Vec<Step> = Vec::new();
    let mut heap: BinaryHeap<(i64, Vec<usize>, usize)> = BinaryHeap::new();
    let reach = |heap: &mut BinaryHeap<(i64, Vec<usize>, usize)>, link: usize, body: usize| {
        if let Some((slack, chosen)) = whole(link, body) {
            heap.push((ordered(slack.to_bits() as i64), chosen, body));
        }
    };
    for (body, links) in links_of.iter().enumerate().filter(|_| !at_once) {
        for link in links.iter().filter(|link| other(**link, body).is_none()) {
            reach(&mut heap, *link, body);
        }
    }
    let mut least = f64::INFINITY;
    loop {
        let next = match heap.pop() {
            _ if at_once => break,
            Some((_, _, body)) if is_anchored[body] => continue,
            Some((slack, chosen, body)) => Some((body, chosen, f64::from_bits(ordered(slack) as u64))),
            // No single contact leads on: combine the components of several.
            None => (0..count).filter(|body| !is_anchored[*body]).find_map(|body| {
                let leading = links_of[body].iter().filter(|link| other(**link, body).is_none_or(|o| is_anchored[o]));
                let mut all: Vec<Change> = leading.flat_map(|link| changes(*link, body)).collect();
                all.sort_by(|a, b| b.slack.total_cmp(&a.slack));
                let chosen = independent(&all);
                let used = all.iter().filter(|change| chosen.contains(&change.number));
                let slack = used.map(|change| change.slack).fold(f64::INFINITY, f64::min);
                (chosen.len() == dimensions[body]).then_some((body, chosen, slack))
            }),
        };
        let Some((body, components, slack)) = next else { break };
        least = least.min(slack);
        is_anchored[body] = true;
        order.push((vec![frame.placed[body]], components));
        for link in &links_of[body] {
            if let Some(next) = other(*link, body).filter(|next| !is_anchored[*next]) {
                reach(&mut heap, *link, next);
            }
        }
    }
    // Correct the remaining bodies together, with those that they touch.
    for first in 0..count {
        if std::mem::replace(&mut is_anchored[first], true) {
            continue;
        }
        least = f64::NEG_INFINITY;
        let (mut bodies, mut all) = (vec![first], Vec::new());
        let mut seen = 0;
        while let Some(body) = bodies.get(seen).copied() {
            seen += 1;
            for link in &links_of[body] {
                if let Some(next) = other(*link, body).filter(|next| !std::mem::replace(&mut is_anchored[*next], true))
                {
                    bodies.push(next);
                }
                all.extend(changes(*link, body).into_iter().filter(|change| change.slack > 0.0));
            }
        }
        all.sort_by(|a, b| b.slack.total_cmp(&a.slack).then(a.number.cmp(&b.number)));
        let mut numbers: Vec<usize> = all.iter().map(|change| change.number).collect();
        numbers.dedup();
        numbers.truncate(LARGEST_STEP);
        if bodies.len() <= MAX_AT_ONCE {
            order.push((bodies.iter().map(|body| frame.placed[*body]).collect(), numbers));
        }
    }
    order.reverse();
    (order, least)
}

/// Returns whole numbers that are ordered as the doubles with these bits; applied twice, the bits (see [`f64::total_cmp`]).
fn ordered(bits: i64) -> i64 {
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

/// Two directions count as dependent if the sine of their angle is less than this.
const DEPENDENT: f64 = 1e-6;

/// Returns the first components in the list, at most three, whose forces and moments are independent.
fn independent(changes: &[Change]) -> Vec<usize> {
    let mut chosen: Vec<(usize, [f64; 3])> = Vec::new();
    let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    for change in changes {
        let size = dot(&change.wrench, &change.wrench).sqrt();
        if size == 0.0 || chosen.len() == 3 {
            continue;
        }
        let mut rest = change.wrench.map(|v| v / size);
        // Gram and Schmidt: subtract the parts along the chosen directions.
        for (_, direction) in &chosen {
            let along = dot(&rest, direction);
            rest = [0, 1, 2].map(|i| rest[i] - along * direction[i]);
        }
        let left = dot(&rest, &rest).sqrt();
        if left > DEPENDENT {
            chosen.push((change.number, rest.map(|v| v / left)));
        }
    }
    chosen.into_iter().map(|(number, _)| number).collect()
}
