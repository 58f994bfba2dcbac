//! The result of one frame, as written in JSON.

use super::Timing;
use super::json::{Json, motions, object};
use super::margin::{case, margins_of};
use super::question::{capacity, conditions, movement, placement, removable, vehicle, wedging};
use super::sensitivity::sensitivity;
use crate::geometry::Point;
use crate::mechanics::analysis::{
    Contact, EffectName, Failure, MarginKind, Proof, RobotForce, SolveReport, SolvedFrame, Stages,
};
use crate::mechanics::scene::{BlockId, Scene};
use crate::mechanics::statics::interface::ContactKind;

/// Returns one entry of the key `frames`. `blocks` are the placed blocks, if they were requested.
pub(super) fn frame<'a>(solved: SolvedFrame<'a>, blocks: Option<&[BlockId]>, timing: Timing) -> Json<'a> {
    let SolvedFrame { scene, found: frame, .. } = solved;
    let is_simulated = |effect: EffectName| frame.effects.iter().any(|e| e.effect == effect && e.simulated);
    let cases = frame.cases.as_ref();
    let envelope = cases.iter().flat_map(|cases| cases.envelope.iter().enumerate()).map(|(interface, range)| {
        object! { interface: interface, normal: range.normal, friction: range.friction }
    });
    let effects = frame.effects.iter().map(|effect| {
        object! {
            effect: effect.effect.word(),
            simulated: effect.simulated,
            why: &effect.why,
            unknowns: effect.unknowns,
        }
    });
    object! {
        title: &solved.frame().title,
        verdict: frame.verdict.word(),
        doubt: Json::from(frame.doubt()).unless_empty(),
        length: frame.length,
        total_force: frame.total_force,
        total_force_least: (!frame.least_force).then_some(false),
        total_force_bound: frame.force_bound,
        total_sticking: frame.total_sticking,
        weight: frame.weight,
        blocks: blocks.map(|blocks| Json::list(blocks.iter().map(|id| block(scene, *id)))),
        interfaces: Json::list(frame.contacts.iter().map(|contact| interface(scene, contact))),
        robots: Json::list(frame.robots.iter().map(|held| robot(scene, held))),
        failures: Json::list(frame.failures.iter().map(|missing| failure(scene, missing))),
        unsupported: Json::list(frame.unsupported.iter().map(|id| &scene.blocks[id.0].id)).unless_empty(),
        corners_decide: frame.corners_decide.then_some(true),
        mechanism: motions(scene, &frame.mechanism),
        margins: frame.margins.as_ref().map(|margins| margins_of(scene, margins)),
        signed_margins: Json::object(MarginKind::with_sign().map(|kind| {
            let is_asked = frame.margins.as_ref().is_some_and(|margins| margins.kinds.has(kind));
            let number = || Json::Number(solved.signed_margin(kind).unwrap_or(f64::NAN));
            (kind.word(), if is_asked { number() } else { Json::Absent })
        }))
        .unless_empty(),
        sensitivity: frame.sensitivity.as_ref().map(|found| sensitivity(solved, found)),
        placement: frame.placement.as_ref().map(|found| placement(scene, found)),
        cases: Json::list(cases.iter().flat_map(|cases| &cases.each).map(|own| case(scene, own))).unless_empty(),
        governing_case: cases.map(|cases| &cases.each[cases.governing].id),
        envelope: Json::list(envelope).unless_empty(),
        conditions: (cases.is_some() || frame.vehicle.is_some()).then(|| conditions(frame)),
        movements: Json::list(frame.movements.iter().map(|moved| movement(scene, moved))).unless_empty(),
        removable: frame.removable.as_ref().map(|rows| removable(scene, rows)),
        vehicle: frame.vehicle.as_ref().map(|influence| vehicle(scene, influence)),
        verdict_without_vehicle: frame.under_vehicle.map(|under| under.alone.word()),
        governing_position: frame.under_vehicle.and_then(|under| under.position),
        capacity: frame.capacity.as_ref().map(|found| capacity(scene, found)),
        only_by_wedging: is_simulated(EffectName::Wedging).then(|| Json::or_null(frame.only_by_wedging)),
        wedging: frame.wedged.as_ref().map(|wedged| wedging(solved, wedged)),
        effects: Json::list(effects),
        proof: proof(frame.proof, frame.exact),
        solve: solve(&frame.solve, timing),
        notices: Json::list(&frame.notices).unless_empty(),
    }
}

fn block(scene: &Scene, id: BlockId) -> Json<'_> {
    let block = &scene.blocks[id.0];
    let ring = |corners: &[Point]| Json::list(corners.iter().copied());
    let polygon = &block.body.polygon;
    object! {
        id: &block.id,
        centre: block.centroid,
        area: polygon.area(),
        weight: block.weight,
        vertices: ring(polygon.outline()),
        holes: Json::list(polygon.holes().iter().map(|hole| ring(hole))).unless_empty(),
    }
}

fn interface<'a>(scene: &'a Scene, contact: &Contact) -> Json<'a> {
    let interface = &contact.interface;
    let word = || {
        let is_round = interface.bodies.iter().any(|body| scene.body(*body).circle.is_some());
        if is_round { "circle" } else { "corner" }
    };
    object! {
        bodies: interface.bodies.map(|body| scene.name(body)),
        kind: (interface.kind == ContactKind::Corner).then(word),
        ends: interface.ends,
        application_points: contact.application_points,
        normal: interface.normal,
        mu: interface.friction,
        normal_forces: contact.normal_forces,
        friction_force: contact.friction_force,
        resultant: object! { at: contact.resultant.at, force: contact.resultant.force },
        friction_used: contact.friction_used,
        eccentricity: contact.eccentricity(),
        in_middle_third: contact.is_in_middle_third(),
        pressure: contact.pressure(scene.thickness),
    }
}

fn robot<'a>(scene: &'a Scene, robot: &RobotForce) -> Json<'a> {
    object! {
        id: &scene.robots[robot.robot.0].id,
        holds: &scene.blocks[robot.block.0].id,
        at: robot.at,
        force: robot.force,
        torque: robot.torque,
        limit_used: robot.limit_used,
    }
}

/// A failure. It has either `bodies` or `robot` and `holds`, and either `force` or `torque`.
fn failure<'a>(scene: &'a Scene, failure: &Failure) -> Json<'a> {
    let (first, second) = failure.bodies();
    let is_torque = matches!(failure, Failure::RobotTorque { .. });
    object! {
        kind: failure.word(),
        bodies: second.map(|second| [first, second].map(|body| scene.name(body))),
        robot: failure.robot().map(|robot| &scene.robots[robot.0].id),
        holds: second.is_none().then(|| scene.name(first)),
        at: failure.at(),
        force: (!is_torque).then(|| failure.force()),
        torque: is_torque.then(|| failure.torque()),
        amount: failure.amount(),
    }
}

/// The numbers of a proof. `no_balance_below` is the sum of forces, relative to the loads of the moving blocks, below
/// which no forces balance; `"unbounded"` if no forces balance at all.
fn proof<'a>(proof: Proof, exact: Option<bool>) -> Json<'a> {
    match proof {
        Proof::Forces { worst_imbalance, worst_share, worst_pull, worst_slip } => object! {
            worst_imbalance: worst_imbalance,
            worst_share: worst_share,
            worst_pull: worst_pull,
            worst_slip: worst_slip,
            exact: exact,
        },
        Proof::Mechanism { power, worst_violation } => object! {
            power: power,
            worst_violation: worst_violation,
            no_balance_below: match proof.excluded_force_sum() {
                sum if sum.is_finite() => Json::Number(sum),
                _ => "unbounded".into(),
            },
            exact: exact,
        },
    }
}

/// The method that decided a frame, its iterations and its time.
fn solve<'a>(solve: &SolveReport, timing: Timing) -> Json<'a> {
    let timed = timing == Timing::Included;
    let seconds = |stages: Stages| {
        object! {
            assembly: stages.assembly,
            solution: stages.solution,
            wedging: stages.wedging,
            margins: stages.margins,
            placement: (stages.placement > 0.0).then_some(stages.placement),
        }
    };
    object! {
        method: solve.method.name(),
        iterations: solve.iterations,
        programs: solve.programs,
        groups: solve.groups,
        reused: solve.reused,
        seconds: timed.then_some(solve.seconds),
        stages: timed.then(|| seconds(solve.stages)),
    }
}
