//! [`Certificate::new`]: writes the certificate of an analysis.
//!
//! The forces of the analysis are used if a tree of contacts with room for corrections leads from every body to the
//! ground, found as Prim's algorithm finds a spanning tree. Forces of least sum often lie on the edge of many contacts,
//! where an exact correction would leave the contact. Then any forces that an interior-point method finds are tried, and at
//! last the forces with the largest slack: each normal force is at least s, and s is the largest possible. With N = s + N',
//! this is the largest load factor along the loads −s on every contact point, one linear program for each component.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::check::LATE;
use super::fall::{NEGLIGIBLE, motion_of_all, opening_motion, with_motion};
use super::limits::Limits;
use super::stand::{inner_forces, order, slack_forces};
use super::{
    BodyForm, Certificate, Change, CircleForm, ContactForm, ForcesForm, FrameForm, GripForm, LimitForm, LoadForm, Pair,
};
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Analysis, Condition, FrameAnalysis, INEXACT, Options, Verdict, mechanism_of};
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::{BodyId, Scene};
use crate::mechanics::solve::{DeadlineGuard, is_late};
use crate::mechanics::statics::assembly::{Assembly, AssemblyContact};
use crate::mechanics::statics::effect::{FrameContext, assemble};
use crate::mechanics::statics::interface::{ContactKind, Interfaces};
use crate::text::line;

/// If the forces of the analysis have this slack at least, as a share of the heaviest load, they are corrected.
const ROOM: f64 = 1e-6;

/// Where the forces of a proof come from: none are needed, the analysis, a program for the middle of all forces, or one for
/// the largest slack.
#[derive(Clone, Copy)]
enum Source {
    None,
    Given,
    Inner,
    Slack,
}

/// A frame with a proof, and what it misses.
type Proved = (FrameForm, Vec<String>);

impl Certificate {
    /// Writes the certificate of an analysis, and notes in the analysis which verdicts it proves exactly and what the
    /// others miss. `scene_sha256` is the hash of the scene file in hexadecimal digits, or empty. Proofs of capacities and
    /// placement tolerances are written if the analysis has them, those of margins `with_margins` only. The bodies have the
    /// loads of the worst case of all frames. A frame that stands also has a proof for each other condition: each load case,
    /// without the vehicle and with it at each of its positions.
    pub fn new(analysis: &mut Analysis, scene_sha256: String, with_margins: bool) -> Certificate {
        let first = analysis.of_each(|number| number);
        let mut proved = BTreeMap::new();
        let mut certificate = Certificate::prove_each(analysis, |form, limits| {
            proved.insert(form.frame, (form.clone(), limits.all(with_margins)));
            !is_late()
        });
        certificate.scene_sha256 = scene_sha256;
        certificate.in_each_condition(analysis, |number, conditions| {
            if let Some((_, limits)) = proved.get_mut(&(number + 1)) {
                limits.extend(conditions);
            }
        });
        for (number, first) in first.into_iter().enumerate() {
            let (frame, (form, limits)) = (number + 1, &proved[&(first + 1)]);
            certificate.frames.push(FrameForm { frame, ..form.clone() });
            certificate.limits.extend(limits.iter().map(|limit| LimitForm { frame, ..limit.clone() }));
        }
        certificate
    }

    /// Proves the verdict of each frame in all conditions except the governing one. Frames that share their results are proved
    /// once. If the proof in a condition is not exact, the frame gets a notice. `keep` receives the number of the frame, from
    /// 0, and the proofs.
    fn in_each_condition(&self, analysis: &mut Analysis, mut keep: impl FnMut(usize, Vec<LimitForm>)) {
        let first: BTreeSet<usize> = analysis.of_each(|number| number).into_iter().collect();
        let mut faults = BTreeMap::new();
        for number in first {
            let (proofs, fault) = self.conditions_of(analysis, number);
            keep(number, proofs);
            faults.extend(fault.map(|fault| (number, fault)));
        }
        analysis.change_each(|number, _, found| {
            if let Some(fault) = faults.get(&number).filter(|_| found.exact == Some(true)) {
                let found = Arc::make_mut(found);
                found.exact = Some(false);
                found.notices.push(inexact(fault));
            }
        });
    }

    /// If a frame stands, proves its verdict in every condition except the governing one, whose proof is the entry of the frame.
    /// Also returns the fault of the first proof that is not exact.
    fn conditions_of(&self, analysis: &Analysis, number: usize) -> (Vec<LimitForm>, Option<String>) {
        let (given, found) = (analysis.given(), &analysis.frames[number]);
        if !given.has_conditions() || found.verdict != Verdict::Stable {
            return (Vec::new(), None);
        }
        let cases: Vec<Option<usize>> = match given.cases().len() {
            0 => vec![None],
            count => (0..count).map(Some).collect(),
        };
        let positions = found.vehicle.as_ref().map_or(0, |line| line.positions.len());
        let positions: Vec<Option<usize>> = [None].into_iter().chain((0..positions).map(Some)).collect();
        let (mut proofs, mut missing) = (Vec::new(), None);
        for condition in
            cases.iter().flat_map(|case| positions.iter().map(|at| Condition { case: *case, position: *at }))
        {
            let Some(alone) = analysis.scene_in(number, condition).alone(number) else { continue };
            let scene = Scene { cases: Vec::new(), vehicle: None, movements: Vec::new(), ..alone };
            let here = self.about(bodies(&scene));
            let other = self.bodies.iter().zip(&here.bodies).enumerate().filter(|(_, (base, own))| base != own);
            let loads: Vec<_> = other.map(|(index, (_, own))| (index, own.weight, own.loads.clone())).collect();
            if loads.is_empty() {
                continue;
            }
            let (interfaces, frame) = (Interfaces::new(&scene), &scene.frames[0]);
            let (assembly, _) =
                assemble(&FrameContext { scene: &scene, frame, interfaces: &interfaces.in_frame(frame) });
            let bare = frame_form(&scene, &assembly, number + 1, Verdict::Stable);
            let own = (!is_late()).then(|| Analysis::with(&scene, &Options::default()).frames.pop()).flatten();
            let (form, faults) = match own.filter(|own| own.verdict == Verdict::Stable) {
                Some(own) => here.standing(&bare, &assembly, Some(&own)),
                None => (bare, vec![if is_late() { LATE } else { "no forces were found" }.to_owned()]),
            };
            let case = condition.case.map(|case| format!("load case {}", line(&given.cases()[case].id)));
            let at = found.vehicle.as_ref().map(|line| match condition.position {
                Some(position) => format!("the first axle at x = {:.4} m", line.positions[position].at),
                None => "without the vehicle".to_owned(),
            });
            let of = case.into_iter().chain(at).collect::<Vec<_>>().join(", ");
            missing = missing.or(faults.first().map(|fault| format!("{of}: {fault}")));
            proofs.push(LimitForm::new(&of, Change { loads: Some(loads), ..Change::default() }, form));
        }
        (proofs, missing)
    }

    /// Notes in an analysis which verdicts exact arithmetic proves and what the others miss, as [`Certificate::new`] does,
    /// but keeps no proof, and ends at the deadline of the options.
    pub(crate) fn note_exact(analysis: &mut Analysis, options: &Options) {
        let _until = DeadlineGuard::new(options.deadline);
        let certificate = Certificate::prove_each(analysis, |_, _| true);
        certificate.in_each_condition(analysis, |_, _| ());
    }

    /// Proves the verdict of each frame, one for all frames that share their results, and notes whether the proof is
    /// exact. `keep` has the proved frame, and what its limits are proved from; it returns whether it kept all. Returns the
    /// certificate without frames.
    fn prove_each(analysis: &mut Analysis, mut keep: impl FnMut(&FrameForm, &Limits<'_>) -> bool) -> Certificate {
        let mut latest = analysis.given().clone();
        let interfaces = Interfaces::new(&latest);
        let mut certificate = Certificate {
            drystone_certificate: 1,
            scene_sha256: String::new(),
            distance: distance(&latest, &interfaces),
            corners_carry: latest.corner_contacts(),
            shortest: latest.tolerance().min_length.max(latest.tolerance().rounding),
            listed: latest.lists_contacts(),
            bodies: bodies(&latest),
            frames: Vec::new(),
            limits: Vec::new(),
        };
        analysis.change_each(|number, scene, found| {
            // With load cases, each frame is proved for the weights and the loads of its governing case.
            if !Arc::ptr_eq(scene, &latest) {
                (certificate.bodies, latest) = (bodies(scene), scene.clone());
            }
            let frame = &scene.frames[number];
            let context = FrameContext { scene, frame, interfaces: &interfaces.in_frame(frame) };
            let (assembly, _) = assemble(&context);
            let bare = frame_form(scene, &assembly, number + 1, found.verdict);
            let (proved, faults) = match found.verdict {
                Verdict::Stable if !is_late() => certificate.standing(&bare, &assembly, Some(found)),
                Verdict::Unstable if !is_late() => certificate.falling(&bare, &assembly, &found.mechanism, false),
                Verdict::Stable | Verdict::Unstable => (bare.clone(), vec![LATE.to_owned()]),
                Verdict::Undecided => (bare.clone(), Vec::new()),
            };
            // The proofs of the limits look for their frame in the certificate, and copy it with all its frames.
            certificate.frames = vec![proved];
            let limits = Limits { scene, certificate: &certificate, bare: &bare, assembly: &assembly, found };
            let is_whole = keep(&certificate.frames[0], &limits);
            if found.verdict != Verdict::Undecided && found.exact.is_none() {
                let found = Arc::make_mut(found);
                found.exact = Some(faults.is_empty());
                found.notices.extend(faults.first().map(|fault| inexact(fault)));
                if !is_whole {
                    found.notices.push(format!("the certificate may lack proofs of this frame: {LATE}"));
                }
            }
        });
        Certificate { bodies: bodies(analysis.given()), frames: Vec::new(), ..certificate }
    }

    /// Adds forces to a frame that stands: those of the analysis, or those with the largest slack, whichever leave
    /// fewer faults. If no order of single bodies corrects them, all bodies are corrected at once.
    pub(super) fn standing(&self, bare: &FrameForm, assembly: &Assembly, found: Option<&FrameAnalysis>) -> Proved {
        let (listed, slack) = (found.map(|found| listed_forces(assembly, found)), OnceCell::new());
        let slack = || slack.get_or_init(|| slack_forces(assembly)).clone();
        let forces = |source: Source| match source {
            // Without loads, no forces are needed.
            Source::None => (assembly.heaviest_load() == 0.0)
                .then(|| vec![[0.0; 3]; assembly.contacts.len() + assembly.grips.len()]),
            // The forces of the analysis need no further program. Often they leave room for the correction of each body.
            Source::Given => listed.clone(),
            Source::Inner => found.and_then(|_| inner_forces(assembly)),
            Source::Slack => slack(),
        };
        let (room, any) = (Some(ROOM * assembly.heaviest_load()), Some(f64::NEG_INFINITY));
        let ways = [
            (Source::None, None),
            (Source::Given, room),
            (Source::Inner, room),
            (Source::Slack, any),
            (Source::Given, any),
            (Source::Slack, None),
        ];
        self.best(bare, ways.into_iter().map(|(source, room)| self.with_forces(bare, assembly, &forces(source)?, room)))
    }

    /// Adds a motion to a frame that falls: the given one, or else one that opens more contacts and keeps those exactly
    /// closed that cannot open. With `given_only`, only the given motion, which needs no program.
    pub(super) fn falling(
        &self,
        bare: &FrameForm,
        assembly: &Assembly,
        mechanism: &[Motion],
        given_only: bool,
    ) -> Proved {
        let (opening, fresh) = (OnceCell::new(), OnceCell::new());
        let fresh = || fresh.get_or_init(|| mechanism_of(assembly));
        let motion = |is_fresh: bool, opens: bool| match (is_fresh, opens) {
            (true, true) => opening_motion(assembly, fresh()),
            (true, false) => Some(motion_of_all(assembly, fresh())),
            (false, true) => opening.get_or_init(|| opening_motion(assembly, mechanism)).clone(),
            (false, false) => Some(motion_of_all(assembly, mechanism)),
        };
        let (given, all) = ([false, false], [[false, true], [true, false], [true, true]]);
        let ways = [given].into_iter().chain(all).take(if given_only { 1 } else { 4 });
        let ways = ways.flat_map(|own| [(own, false), (own, true)]);
        let of = |([is_fresh, opens], still): ([bool; 2], bool)| {
            Some(with_motion(bare, assembly, &motion(is_fresh, opens)?, still))
        };
        self.best(bare, ways.map(of))
    }

    /// Returns the first candidate that proves its verdict exactly, or the one with the fewest faults.
    fn best(&self, bare: &FrameForm, candidates: impl Iterator<Item = Option<FrameForm>>) -> Proved {
        let mut best: Option<Proved> = None;
        for form in candidates.flatten() {
            let faults = self.proof_faults(&form);
            let is_exact = faults.is_empty();
            if best.as_ref().is_none_or(|(_, fewest)| faults.len() < fewest.len()) {
                best = Some((form, faults));
            }
            if is_exact || is_late() {
                break;
            }
        }
        best.unwrap_or_else(|| (bare.clone(), self.proof_faults(bare)))
    }

    /// Adds forces, in newtons, and the order of their correction. `None` if the components by which single bodies are
    /// corrected have less slack than `room` newtons. Without `room`, forces that are nearly 0 become 0, and all bodies
    /// that touch are corrected in one step.
    pub(super) fn with_forces(
        &self,
        bare: &FrameForm,
        assembly: &Assembly,
        forces: &[[f64; 3]],
        room: Option<f64>,
    ) -> Option<FrameForm> {
        let mut forces = forces.to_vec();
        let negligible = if room.is_some() { 0.0 } else { NEGLIGIBLE * assembly.heaviest_load() };
        for amount in forces.iter_mut().flatten().filter(|amount| amount.abs() <= negligible) {
            *amount = 0.0;
        }
        // Rounding may have left a force just outside its friction cone.
        for (contact, [one, two, three]) in assembly.contacts.iter().zip(&mut forces) {
            (*one, *two) = (one.max(0.0), two.max(0.0));
            let limit = contact.friction * (*one + *two) * (1.0 - 16.0 * f64::EPSILON);
            *three = three.clamp(-limit, limit);
        }
        let (order, slack) = order(assembly, bare, &forces, room.is_none());
        if room.is_some_and(|room| slack < room) {
            return None;
        }
        let (of_contacts, of_grips) = forces.split_at(assembly.contacts.len());
        let contacts = bare.contacts.iter().zip(of_contacts).map(|(contact, [n1, n2, t])| {
            let length = normal_of(contact).norm();
            match contact.points.len() {
                2 => [n1 / length, n2 / length, t / length],
                _ => [(n1 + n2) / length, 0.0, t / length],
            }
        });
        let forces =
            ForcesForm { contacts: contacts.collect(), grips: of_grips.to_vec(), order, reactions: Vec::new() };
        Some(FrameForm { forces: Some(forces), ..bare.clone() })
    }
}

/// Says what the exact proof of a verdict misses.
fn inexact(fault: &str) -> String {
    format!("{INEXACT}{fault}")
}

/// Writes a frame without its proof.
fn frame_form(scene: &Scene, assembly: &Assembly, number: usize, verdict: Verdict) -> FrameForm {
    let first_block = scene.ground().len();
    let body_of = |body: usize| first_block + assembly.bodies[body].block.0;
    let grips = assembly.grips.iter().map(|grip| GripForm {
        robot: scene.robots()[grip.robot.0].id.clone(),
        body: body_of(grip.body),
        // A grip at the centroid is at the exact one, which is no double.
        at: (grip.at != assembly.bodies[grip.body].centroid).then(|| pair(grip.at)),
        limits: [grip.limits.fx, grip.limits.fy, grip.limits.torque].map(|v| v.is_finite().then_some(v)),
    });
    FrameForm {
        frame: number,
        verdict: verdict.word().to_owned(),
        gravity: [assembly.pull.x, assembly.pull.y],
        load_factor: 1.0,
        kernel: scene.kernel,
        force: None,
        errors: None,
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
        outline: match scene.body(body).circle {
            Some(_) => Vec::new(),
            None => ring(scene.body(body).polygon.outline()),
        },
        circle: scene.body(body).circle.map(|c| CircleForm { centre: pair(c.centre), radius: c.radius }),
        holes: scene.body(body).polygon.holes().iter().map(|hole| ring(hole)).collect(),
        weight: 0.0,
        centre: None,
        loads: Vec::new(),
    };
    let ground = (0..scene.ground().len()).map(|k| form(BodyId::Ground(k), "ground"));
    let blocks = scene.blocks().iter().enumerate().map(|(k, block)| {
        let id = crate::mechanics::scene::BlockId(k);
        let loads = scene.loads().iter().filter(|load| load.block == id);
        let centre = (block.body.is_schematic || block.centroid != block.body.centroid()).then(|| pair(block.centroid));
        BodyForm {
            weight: block.weight,
            centre,
            loads: loads
                .flat_map(|load| load.parts().into_iter().flatten())
                .map(|load| LoadForm {
                    force: [load.force.x, load.force.y],
                    at: (load.at != block.centroid).then(|| pair(load.at)),
                    torque: load.torque,
                    fixed: load.is_fixed,
                })
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
    let farthest = ends.map(|(body, at)| scene.body(body).distance(at).abs()).fold(0.0, f64::max);
    let bounds = scene.blocks().iter().map(|block| block.body.polygon.bounds());
    let extent = bounds.map(|b| b.min.coords.norm().max(b.max.coords.norm())).fold(0.0, f64::max);
    (farthest * (1.0 + 1e-9)).max(extent * 1e-12)
}

fn pair(point: Point) -> Pair {
    [point.x, point.y]
}

/// Writes a contact along an edge with its two ends, and a contact at a corner with its point and its normal.
fn contact_form(contact: &AssemblyContact, first_block: usize) -> ContactForm {
    let index = |body: BodyId| match body {
        BodyId::Ground(k) => k,
        BodyId::Block(id) => first_block + id.0,
    };
    ContactForm {
        bodies: contact.bodies.map(index),
        points: contact.ends.iter().take(contact.points_in_use()).map(|end| pair(*end)).collect(),
        normal: (contact.kind == ContactKind::Corner).then_some([contact.normal.x, contact.normal.y]),
        friction: contact.friction,
        fixed: !contact.is_factored,
        factor: None,
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
pub(super) fn listed_forces(assembly: &Assembly, found: &FrameAnalysis) -> Vec<[f64; 3]> {
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
