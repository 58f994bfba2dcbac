//! [`Certificate::new`]: writes the certificate of an analysis.
//!
//! Forces of least sum lie on the edge of many contacts, where an exact correction would leave the contact. So the
//! forces of a certificate are those with the largest slack: each normal force is at least s, and s is the largest
//! possible. With N = s + N', this is the largest load factor along the loads −s on every contact point, one linear
//! program for each component. The corrections of the bodies go along a tree of contacts with large slack, found as
//! Prim's algorithm finds a spanning tree.

use std::collections::BinaryHeap;

use super::check::LARGEST_STEP;
use super::limits::Limits;
use super::{BodyForm, Certificate, ContactForm, ForcesForm, FrameForm, GripForm, LoadForm, MotionForm, Pair, Step};
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::analysis::{Analysis, FrameAnalysis, Verdict, mechanism_of};
use crate::mechanics::program::{Column, Force, Program, Scale, columns};
use crate::mechanics::proof::{Motion, net_power};
use crate::mechanics::scene::{BodyId, Scene};
use crate::mechanics::solve::{Amounts, Conditioning, Effort, Limit, Status, balance, dual, largest_factor};
use crate::mechanics::statics::assembly::{Assembly, AssemblyContact};
use crate::mechanics::statics::effect::{FrameContext, assemble};
use crate::mechanics::statics::interface::{ContactKind, Interfaces};

/// If all contacts may press without limit, as a wedged stone does, each normal force gets this share of the heaviest
/// load.
const SLACK_OF_WEDGED: f64 = 0.1;

/// A force up to this share of the heaviest load counts as 0 if bodies are corrected at once; a velocity up to this share
/// of the largest one likewise.
const NEGLIGIBLE: f64 = 1e-7;

/// The largest number of bodies that are corrected at once.
const MAX_AT_ONCE: usize = 16;

/// The share of each robot's limit that is kept as slack.
const SLACK_OF_ROBOTS: f64 = 1e-6;

impl Certificate {
    /// Writes the certificate of an analysis. `scene_sha256` is the hash of the scene file in hexadecimal digits, or
    /// empty.
    pub fn new(analysis: &Analysis, scene_sha256: String) -> Certificate {
        let scene = &*analysis.scene;
        let interfaces = Interfaces::new(scene);
        let mut certificate = Certificate {
            drystone_certificate: 1,
            scene_sha256,
            distance: distance(scene, &interfaces),
            corners_carry: scene.corner_contacts(),
            shortest: scene.tolerance().min_length.max(scene.tolerance().rounding),
            listed: scene.lists_contacts(),
            bodies: bodies(scene),
            frames: Vec::new(),
            limits: Vec::new(),
        };
        for (number, found) in analysis.frames.iter().enumerate() {
            let frame = &scene.frames[number];
            let context = FrameContext { scene, frame, interfaces: &interfaces.in_frame(scene, frame) };
            let (assembly, _) = assemble(&context);
            let bare = frame_form(scene, &assembly, number + 1, found.verdict);
            let proved = match found.verdict {
                Verdict::Stable => certificate.standing(&bare, &assembly, Some(found)),
                Verdict::Unstable => certificate.falling(&bare, &assembly, &found.mechanism),
                Verdict::Undecided => bare.clone(),
            };
            certificate.frames.push(proved);
            certificate
                .limits
                .extend(Limits { certificate: &certificate, bare: &bare, assembly: &assembly, found }.all());
        }
        certificate
    }

    /// Notes in an analysis which verdicts this certificate proves exactly, and what the others miss.
    pub fn note_in(&self, analysis: &mut Analysis) {
        for (form, found) in self.frames.iter().zip(&mut analysis.frames) {
            if found.verdict == Verdict::Undecided {
                continue;
            }
            let faults = self.proof_faults(form);
            found.exact = Some(faults.is_empty());
            if let Some(fault) = faults.first() {
                found.notices.push(format!("the verdict is not proved in exact arithmetic: {fault}"));
            }
        }
    }

    /// Adds forces to a frame that stands: those with the largest slack, or else those of the analysis, whichever leave
    /// fewer faults. If no order of single bodies corrects them, all bodies are corrected at once.
    pub(super) fn standing(&self, bare: &FrameForm, assembly: &Assembly, found: Option<&FrameAnalysis>) -> FrameForm {
        let slack = || Some(self.with_forces(bare, assembly, &slack_forces(assembly)?, false));
        let listed = || Some(self.with_forces(bare, assembly, &listed_forces(assembly, found?), false));
        let slack_at_once = || Some(self.with_forces(bare, assembly, &slack_forces(assembly)?, true));
        let listed_at_once = || Some(self.with_forces(bare, assembly, &listed_forces(assembly, found?), true));
        self.best(bare, &[&slack, &listed, &slack_at_once, &listed_at_once])
    }

    /// Adds a motion to a frame that falls: the given one, or else one that opens more contacts and keeps those exactly
    /// closed that cannot open.
    pub(super) fn falling(&self, bare: &FrameForm, assembly: &Assembly, mechanism: &[Motion]) -> FrameForm {
        let listed = || Some(with_motion(bare, assembly, &motion_of_all(assembly, mechanism), false));
        let opening = || Some(with_motion(bare, assembly, &opening_motion(assembly, mechanism)?, false));
        let still = || Some(with_motion(bare, assembly, &opening_motion(assembly, mechanism)?, true));
        let given_still = || Some(with_motion(bare, assembly, &motion_of_all(assembly, mechanism), true));
        let fresh = || Some(with_motion(bare, assembly, &motion_of_all(assembly, &mechanism_of(assembly)), false));
        let fresh_opening =
            || Some(with_motion(bare, assembly, &opening_motion(assembly, &mechanism_of(assembly))?, true));
        self.best(bare, &[&listed, &opening, &still, &given_still, &fresh, &fresh_opening])
    }

    /// Returns the first candidate that proves its verdict exactly, or the one with the fewest faults.
    fn best(&self, bare: &FrameForm, candidates: &[&dyn Fn() -> Option<FrameForm>]) -> FrameForm {
        let mut best: Option<(usize, FrameForm)> = None;
        for candidate in candidates {
            let Some(form) = candidate() else { continue };
            let faults = self.proof_faults(&form).len();
            if best.as_ref().is_none_or(|(fewest, _)| faults < *fewest) {
                best = Some((faults, form));
            }
            if faults == 0 {
                break;
            }
        }
        best.map_or_else(|| bare.clone(), |(_, form)| form)
    }

    /// Adds forces, in newtons, and the order of their correction. With `at_once`, forces that are nearly 0 become 0, and
    /// all bodies that touch are corrected in one step.
    fn with_forces(&self, bare: &FrameForm, assembly: &Assembly, forces: &[[f64; 3]], at_once: bool) -> FrameForm {
        let mut forces = forces.to_vec();
        let negligible = NEGLIGIBLE * assembly.heaviest_load();
        for amount in forces.iter_mut().flatten().filter(|amount| at_once && amount.abs() <= negligible) {
            *amount = 0.0;
        }
        let (of_contacts, of_grips) = forces.split_at(assembly.contacts.len());
        let contacts = bare.contacts.iter().zip(of_contacts).map(|(contact, [n1, n2, t])| {
            let length = normal_of(contact).norm();
            match contact.points.len() {
                2 => [n1 / length, n2 / length, t / length],
                _ => [(n1 + n2) / length, 0.0, t / length],
            }
        });
        let order = order(assembly, bare, &forces, at_once);
        let forces = ForcesForm { contacts: contacts.collect(), grips: of_grips.to_vec(), order };
        FrameForm { forces: Some(forces), ..bare.clone() }
    }
}

/// Writes a frame without its proof.
fn frame_form(scene: &Scene, assembly: &Assembly, number: usize, verdict: Verdict) -> FrameForm {
    let first_block = scene.ground().len();
    let body_of = |body: usize| first_block + assembly.bodies[body].block.0;
    let grips = assembly.grips.iter().map(|grip| GripForm {
        robot: scene.robots()[grip.robot.0].id.clone(),
        body: body_of(grip.body),
        at: pair(grip.at),
        limits: [grip.limits.fx, grip.limits.fy, grip.limits.torque].map(|v| v.is_finite().then_some(v)),
    });
    FrameForm {
        frame: number,
        verdict: verdict.word().to_owned(),
        gravity: [assembly.pull.x, assembly.pull.y],
        load_factor: 1.0,
        force: None,
        placed: (0..assembly.bodies.len()).map(body_of).collect(),
        contacts: assembly.contacts.iter().map(|contact| contact_form(contact, first_block)).collect(),
        grips: grips.collect(),
        forces: None,
        motion: None,
        still: Vec::new(),
    }
}

/// Writes the bodies of a scene: the ground, then the blocks.
fn bodies(scene: &Scene) -> Vec<BodyForm> {
    let ring = |points: &[Point]| points.iter().map(|p| pair(*p)).collect();
    let form = |body: BodyId, id: &str| BodyForm {
        id: id.to_owned(),
        ground: matches!(body, BodyId::Ground(_)),
        outline: ring(scene.body(body).polygon.outline()),
        holes: scene.body(body).polygon.holes().iter().map(|hole| ring(hole)).collect(),
        weight: 0.0,
        centre: None,
        loads: Vec::new(),
    };
    let ground = (0..scene.ground().len()).map(|k| form(BodyId::Ground(k), "ground"));
    let blocks = scene.blocks().iter().enumerate().map(|(k, block)| {
        let id = crate::mechanics::scene::BlockId(k);
        let loads = scene.loads().iter().filter(|load| load.block == id);
        let centre =
            (block.body.is_schematic || block.centroid != block.body.polygon.centroid()).then(|| pair(block.centroid));
        BodyForm {
            weight: block.weight,
            centre,
            loads: loads
                .map(|load| LoadForm { force: [load.force.x, load.force.y], at: pair(load.at), torque: load.torque })
                .collect(),
            ..form(BodyId::Block(id), &block.id)
        }
    });
    ground.chain(blocks).collect()
}

/// Returns the largest distance, in metres, of an end of an interface from the outlines of its bodies; at least the
/// rounding of coordinates.
fn distance(scene: &Scene, interfaces: &Interfaces) -> f64 {
    let ends = interfaces.all.iter().flat_map(|i| i.ends.iter().flat_map(|at| i.bodies.map(|body| (body, *at))));
    let farthest = ends.map(|(body, at)| scene.body(body).polygon.distance(at).abs()).fold(0.0, f64::max);
    let bounds = scene.blocks().iter().map(|block| block.body.polygon.bounds());
    let extent = bounds.map(|b| b.min.coords.norm().max(b.max.coords.norm())).fold(0.0, f64::max);
    (farthest * (1.0 + 1e-9)).max(extent * 1e-12)
}

fn pair(point: Point) -> Pair {
    [point.x, point.y]
}

/// Writes a contact. If its two points coincide, it has one point and a normal.
fn contact_form(contact: &AssemblyContact, first_block: usize) -> ContactForm {
    let index = |body: BodyId| match body {
        BodyId::Ground(k) => k,
        BodyId::Block(id) => first_block + id.0,
    };
    let [first, second] = contact.points;
    let one_point = contact.kind == ContactKind::Corner || first == second;
    let along = contact.ends[1] - contact.ends[0];
    let normal = match contact.kind {
        ContactKind::Edge => [along.y, -along.x],
        _ => [contact.normal.x, contact.normal.y],
    };
    ContactForm {
        bodies: contact.bodies.map(index),
        points: if one_point { vec![pair(first)] } else { vec![pair(first), pair(second)] },
        normal: one_point.then_some(normal),
        ends: (contact.kind == ContactKind::Edge && contact.ends != contact.points).then(|| contact.ends.map(pair)),
        friction: contact.friction,
    }
}

/// The normal of a contact, not normalised.
fn normal_of(contact: &ContactForm) -> Vector {
    match (&contact.points[..], contact.normal) {
        ([first, second], _) => Vector::new(second[1] - first[1], first[0] - second[0]),
        (_, normal) => normal.unwrap_or_default().into(),
    }
}

/// Returns, for each contact N₁, N₂ and T and for each grip force x, force y and torque, the forces of the analysis.
fn listed_forces(assembly: &Assembly, found: &FrameAnalysis) -> Vec<[f64; 3]> {
    let contacts = assembly.contacts.iter().map(|contact| {
        let listed = &found.contacts[contact.interface];
        [listed.normal_forces[0], listed.normal_forces[1], listed.friction_force]
    });
    let grips = assembly.grips.iter().map(|grip| {
        let robot = &found.robots[grip.hold];
        [robot.force.x, robot.force.y, robot.torque]
    });
    contacts.chain(grips).collect()
}

/// Returns the forces with the largest slack, in the order of [`listed_forces`]. `None` if a program has no result.
fn slack_forces(assembly: &Assembly) -> Option<Vec<[f64; 3]>> {
    let mut forces = vec![[0.0; 3]; assembly.contacts.len() + assembly.grips.len()];
    for component in assembly.components() {
        let mut program = Program::new(&component, Scale::from_assembly(&component));
        for limit in program.grips.iter_mut().flat_map(|grip| &mut grip.limits) {
            *limit *= 1.0 - SLACK_OF_ROBOTS;
        }
        // The direction in which the loads change if each contact point takes one unit of pressure for itself.
        let mut pressures = vec![0.0; program.loads.len()];
        for column in columns(&program) {
            if matches!(column.force, Force::Ray { friction: 0.0, .. }) {
                column.add_to(&mut pressures, -1.0);
            }
        }
        let (slack, amounts) = match largest_factor(&program, &pressures) {
            found if matches!(found.limit, Limit::At(_)) => match found.limit {
                Limit::At(slack) => (slack, found.forces?),
                _ => return None,
            },
            _ => {
                let slack = SLACK_OF_WEDGED * Scale::HEAVIEST;
                for (load, pressure) in program.loads.iter_mut().zip(&pressures) {
                    *load += slack * pressure;
                }
                (slack, balance(&program, Conditioning::Full).forces?)
            }
        };
        put(&mut forces, assembly, &component, &program, &amounts, slack);
    }
    Some(forces)
}

/// Puts the forces of a component, in newtons, at their places in the frame. `slack` is added to each normal force.
fn put(
    forces: &mut [[f64; 3]],
    assembly: &Assembly,
    component: &Assembly,
    program: &Program,
    amounts: &Amounts,
    slack: f64,
) {
    let unit = program.scale.force;
    for (k, contact) in component.contacts.iter().enumerate() {
        let place = assembly.contacts.iter().position(|c| c.interface == contact.interface);
        let points = contact.points_in_use();
        let more = |point: usize| if point < points { slack } else { 0.0 };
        let [n1, n2] = [0, 1].map(|i| (amounts.normal[k][i] + more(i)) * unit);
        if let Some(place) = place {
            forces[place] = [n1, n2, amounts.friction[k] * unit];
        }
    }
    for (grip, [x, y, moment]) in component.grips.iter().zip(&amounts.grip) {
        if let Some(place) = assembly.grips.iter().position(|g| g.hold == grip.hold) {
            forces[assembly.contacts.len() + place] = [x * unit, y * unit, moment * program.scale.moment()];
        }
    }
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
/// remain, or all bodies with `at_once`, are corrected at once.
fn order(assembly: &Assembly, frame: &FrameForm, forces: &[[f64; 3]], at_once: bool) -> Vec<Step> {
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
    let mut heap: BinaryHeap<(Slack, Vec<usize>, usize)> = BinaryHeap::new();
    let reach = |heap: &mut BinaryHeap<(Slack, Vec<usize>, usize)>, link: usize, body: usize| {
        if let Some((slack, chosen)) = whole(link, body) {
            heap.push((Slack(slack), chosen, body));
        }
    };
    for (body, links) in links_of.iter().enumerate().filter(|_| !at_once) {
        for link in links.iter().filter(|link| other(**link, body).is_none()) {
            reach(&mut heap, *link, body);
        }
    }
    while !at_once {
        let next = match heap.pop() {
            Some((_, _, body)) if is_anchored[body] => continue,
            Some((_, chosen, body)) => Some((body, chosen)),
            // No single contact leads on: combine the components of several.
            None => (0..count).filter(|body| !is_anchored[*body]).find_map(|body| {
                let leading = links_of[body].iter().filter(|link| other(**link, body).is_none_or(|o| is_anchored[o]));
                let mut all: Vec<Change> = leading.flat_map(|link| changes(*link, body)).collect();
                all.sort_by(|a, b| b.slack.total_cmp(&a.slack));
                Some((body, independent(&all))).filter(|(body, chosen)| chosen.len() == dimensions[*body])
            }),
        };
        let Some((body, components)) = next else { break };
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
    order
}

/// A slack that can be ordered.
#[derive(Clone, Copy, PartialEq)]
struct Slack(f64);

impl Eq for Slack {}

impl PartialOrd for Slack {
    fn partial_cmp(&self, other: &Slack) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Slack {
    fn cmp(&self, other: &Slack) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
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

/// Returns the motion of each body; zero for bodies without an entry, which are at rest.
fn motion_of_all(assembly: &Assembly, mechanism: &[Motion]) -> Vec<Motion> {
    let listed = assembly.bodies.iter().map(|body| {
        let moving = mechanism.iter().find(|motion| motion.block == body.block);
        moving.copied().unwrap_or(Motion { block: body.block, velocity: Vector::zeros(), spin: 0.0 })
    });
    listed.collect()
}

/// Returns a motion in which every contact opens a little more than in the motion of the analysis, so that rounding does
/// not close it. No contact closes, and the sum of all openings is the largest if each counts up to 1. `None` if the
/// program has no result.
fn opening_motion(assembly: &Assembly, mechanism: &[Motion]) -> Option<Vec<Motion>> {
    let mut motions = motion_of_all(assembly, mechanism);
    for component in assembly.components() {
        let own: Vec<usize> = component
            .bodies
            .iter()
            .filter_map(|body| assembly.bodies.iter().position(|other| other.block == body.block))
            .collect();
        if own.iter().all(|body| motions[*body].velocity == Vector::zeros() && motions[*body].spin == 0.0) {
            continue;
        }
        let program = Program::new(&component, Scale::from_assembly(&component));
        // Each contact force may be arbitrarily large without a cost, and up to 1 with a gain. In the kinematic dual, no
        // contact closes, and an opening counts up to 1.
        let mut columns = columns(&program);
        let rays = columns.iter().filter(|column| matches!(column.force, Force::Ray { .. }));
        let rays: Vec<Column> = rays.copied().collect();
        let rays = rays.into_iter().map(|mut ray| {
            ray.limit = 1.0;
            ray
        });
        columns.extend(rays);
        let cost = |column: &Column| {
            let is_gain = matches!(column.force, Force::Ray { .. }) && column.limit.is_finite();
            if is_gain { -1.0 } else { 0.0 }
        };
        let none = vec![0.0; program.loads.len()];
        let solved = dual(&none, &columns, Conditioning::Full, &mut Effort::default(), cost);
        if solved.status != Status::Solved {
            return None;
        }
        // Scale the motion of the analysis up until its sum with the opening motion does work.
        let listed: Vec<Motion> = own.iter().map(|body| motions[*body]).collect();
        let opening = component.bodies.iter().zip(solved.y.chunks_exact(3)).map(|(body, y)| Motion {
            block: body.block,
            velocity: -Vector::new(y[0], y[1]),
            spin: -y[2] / program.scale.length,
        });
        let opening: Vec<Motion> = opening.collect();
        let (gain, loss) = (net_power(&component, &listed), net_power(&component, &opening));
        let factor = if gain > 0.0 { (2.0 * loss.abs() / gain).max(1.0) } else { 1.0 };
        for (k, body) in own.iter().enumerate() {
            motions[*body].velocity = listed[k].velocity * factor + opening[k].velocity;
            motions[*body].spin = listed[k].spin * factor + opening[k].spin;
        }
    }
    Some(motions)
}

/// Adds a motion. The motion of a held body is given at its grip point, which stands still exactly if the robot has no
/// limit. With `still`, velocities that are nearly 0 become 0, and contacts that nearly stay closed stay so exactly.
fn with_motion(bare: &FrameForm, assembly: &Assembly, motions: &[Motion], still: bool) -> FrameForm {
    let speed = |motion: &Motion| motion.velocity.norm().max(motion.spin.abs() * assembly.length);
    let negligible = NEGLIGIBLE * motions.iter().map(speed).fold(0.0, f64::max);
    let rests = |motion: &Motion| still && speed(motion) <= negligible;
    let motions: Vec<Motion> = motions
        .iter()
        .map(|motion| if rests(motion) { Motion { velocity: Vector::zeros(), spin: 0.0, ..*motion } } else { *motion })
        .collect();
    let steps = if still { still_steps(bare, assembly, &motions, negligible) } else { Vec::new() };
    let forms = assembly.bodies.iter().zip(&motions).enumerate().map(|(number, (body, motion))| {
        let grip = assembly.grips.iter().find(|grip| grip.body == number);
        let at = grip.map_or(body.centroid, |grip| grip.at);
        let mut velocity = motion.about(body.centroid, at);
        let mut spin = motion.spin;
        if let Some(grip) = grip {
            velocity.x = if grip.limits.fx.is_finite() { velocity.x } else { 0.0 };
            velocity.y = if grip.limits.fy.is_finite() { velocity.y } else { 0.0 };
            spin = if grip.limits.torque.is_finite() { spin } else { 0.0 };
        }
        MotionForm { body: bare.placed[number], at: pair(at), velocity: [velocity.x, velocity.y], spin }
    });
    let moving = forms.filter(|motion| motion.velocity != [0.0; 2] || motion.spin != 0.0);
    FrameForm { motion: Some(moving.collect()), still: steps, ..bare.clone() }
}

/// Returns, for each group of moving bodies, the components that have no power along the motion and shall have none at all.
fn still_steps(bare: &FrameForm, assembly: &Assembly, motions: &[Motion], negligible: f64) -> Vec<Step> {
    let moves = |body: usize| motions[body].velocity != Vector::zeros() || motions[body].spin != 0.0;
    let velocity = |body: usize, at: Point| motions[body].about(assembly.bodies[body].centroid, at);
    // The bodies that each component joins.
    let mut closed: Vec<(usize, Vec<usize>)> = Vec::new();
    for (k, contact) in assembly.contacts.iter().enumerate() {
        let bodies: Vec<usize> = std::iter::once(contact.on).chain(contact.from).filter(|body| moves(*body)).collect();
        let mut slides = true;
        for (i, at) in contact.points.iter().enumerate().take(bare.contacts[k].points.len()) {
            let from = contact.from.map_or(Vector::zeros(), |from| velocity(from, *at));
            let relative = velocity(contact.on, *at) - from;
            let sliding = relative.dot(&contact.tangent()).abs();
            if relative.dot(&contact.normal) - contact.friction * sliding <= negligible {
                closed.push((3 * k + i, bodies.clone()));
                slides &= sliding > negligible || contact.friction == 0.0;
            }
        }
        if !slides {
            closed.push((3 * k + 2, bodies));
        }
    }
    for (k, grip) in assembly.grips.iter().enumerate() {
        let limits = [grip.limits.fx, grip.limits.fy, grip.limits.torque];
        let held = (0..3).filter(|i| limits[*i].is_infinite() && moves(grip.body));
        closed.extend(held.map(|i| (3 * (assembly.contacts.len() + k) + i, vec![grip.body])));
    }
    closed.retain(|(_, bodies)| !bodies.is_empty());
    let mut steps: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
    for (component, bodies) in closed {
        // Join the groups that share a body with this component.
        let (joined, rest): (Vec<_>, Vec<_>) =
            steps.into_iter().partition(|(group, _)| group.iter().any(|body| bodies.contains(body)));
        let mut group: Vec<usize> = joined.iter().flat_map(|(group, _)| group.clone()).chain(bodies).collect();
        group.sort_unstable();
        group.dedup();
        let components = joined.into_iter().flat_map(|(_, components)| components).chain([component]).collect();
        steps = rest;
        steps.push((group, components));
    }
    steps.retain(|(group, components)| group.len() <= MAX_AT_ONCE && components.len() <= LARGEST_STEP);
    for body in steps.iter_mut().flat_map(|(group, _)| group) {
        *body = bare.placed[*body];
    }
    steps
}
