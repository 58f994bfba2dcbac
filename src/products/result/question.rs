//! The answers to questions that a user or a scene asks about a frame beyond its verdict, as written in JSON.

use super::json::{Json, compact, motions, object};
use crate::mechanics::analysis::{
    Condition, FrameAnalysis, Influence, LoadCapacity, MarginKind, Motion, MovementOutcome, Placement, Removable,
    RuledOut, Slide, SolvedFrame, SupportMovement, Verdict, Wedged,
};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::text::Word;

fn block(scene: &Scene, id: BlockId) -> &str {
    &scene.blocks[id.0].id
}

/// Whether the structure stands; `null` if this is undecided.
fn stands<'a>(verdict: Verdict) -> Json<'a> {
    Json::or_null((verdict != Verdict::Undecided).then_some(verdict == Verdict::Stable))
}

/// The placement tolerance of a frame.
pub(super) fn placement<'a>(scene: &'a Scene, found: &Placement) -> Json<'a> {
    let pattern = found.pattern.iter();
    let blocks = found.blocks.iter();
    object! {
        proved: found.proved,
        falls_at: found.falls_at,
        limited_by: found.limited_by.word(),
        joint: found.joint,
        block: found.block.map(|id| block(scene, id)),
        pattern: Json::list(pattern.map(|error| object! { block: block(scene, error.block), offset: error.offset })),
        mechanism: motions(scene, &found.mechanism),
        blocks: Json::list(blocks.map(|own| object! { block: block(scene, own.block), proved: own.proved })),
    }
}

/// Which blocks of a frame may leave.
pub(super) fn removable<'a>(scene: &'a Scene, rows: &[Removable]) -> Json<'a> {
    Json::list(rows.iter().map(|row| {
        object! {
            block: block(scene, row.block),
            stands: stands(row.rest),
            force: row.force,
            help: row.help.map(|help| object! { block: block(scene, help.block), force: help.force }),
        }
    }))
}

/// The conditions that decide the answers of a frame with load cases or a vehicle.
pub(super) fn conditions(frame: &FrameAnalysis) -> Json<'_> {
    let one = |condition: &Condition| {
        let case = condition.case.zip(frame.cases.as_ref()).map(|(number, cases)| cases.each[number].id.as_str());
        object! { case: case, position: condition.position }
    };
    let both = |pair: &[Condition; 2]| Json::list(pair.iter().map(one));
    let of_kind = |kind: MarginKind| {
        let margin = frame.margins.as_ref().and_then(|margins| margins.margin(kind));
        (kind.word(), margin.map(|margin| both(&margin.conditions)).into())
    };
    let rows = frame.removable.iter().flatten();
    let edges = frame.capacity.iter().flat_map(|capacity| &capacity.edges);
    object! {
        margins: frame.margins.as_ref().map(|_| Json::object(MarginKind::of_frame().map(of_kind))),
        placement: frame.placement.as_ref().map(|found| both(&found.conditions)),
        removable: Json::list(rows.map(|row| one(&row.condition))).unless_empty(),
        capacity: Json::list(edges.map(|edge| one(&edge.condition))).unless_empty(),
    }
}

/// The influence line of a vehicle.
pub(super) fn vehicle<'a>(scene: &'a Scene, influence: &Influence) -> Json<'a> {
    let positions = influence.positions.iter().map(|position| {
        let axles = position.axles.iter();
        object! {
            at: position.at,
            toward: if position.to_right { "right" } else { "left" },
            factor: position.factor.map_or(Json::from("unbounded"), Json::Number),
            axles: Json::list(axles.map(|(axle, id, at)| object! { axle: *axle, block: block(scene, *id), at: *at })),
        }
    });
    object! {
        governing: influence.governing,
        mechanism: motions(scene, &influence.mechanism),
        positions: Json::list(positions),
    }
}

/// How a frame follows a movement of a support.
pub(super) fn movement<'a>(scene: &'a Scene, moved: &SupportMovement) -> Json<'a> {
    let ground = scene.name(BodyId::Ground(scene.movements()[moved.number].ground));
    let outcome = object! { ground: ground, outcome: moved.outcome.word() };
    let MovementOutcome::Follows(cracked) = &moved.outcome else {
        return outcome;
    };
    let joints = cracked.cracks.iter().map(|crack| {
        object! { interface: crack.contact, end: crack.end, opening: crack.opening, slip: crack.slip }
    });
    outcome.and(object! {
        unit: cracked.unit,
        force: cracked.force,
        work: cracked.work,
        joints: Json::list(joints),
        velocities: motions(scene, &cracked.motions),
    })
}

/// Writes a load capacity as one line of JSON: the value of the key `capacity` in the result of a frame.
pub fn capacity_json(scene: &Scene, capacity: &LoadCapacity) -> String {
    compact(&self::capacity(scene, capacity))
}

/// The set of forces that a block can carry. Each vertex is proved by a balance of forces, each edge by a motion.
pub(super) fn capacity<'a>(scene: &'a Scene, found: &LoadCapacity) -> Json<'a> {
    let edges = found.edges.iter().map(|edge| {
        object! {
            from: Json::or_null(edge.ends[0]),
            to: Json::or_null(edge.ends[1]),
            normal: edge.normal,
            limit: edge.limit,
            mechanism: motions(scene, &edge.mechanism),
            case: edge.case,
        }
    });
    let balances = found.vertices.iter().filter(|vertex| vertex.proof.is_some()).map(|vertex| {
        let interfaces = vertex.contacts.iter().map(|forces| {
            object! {
                interface: forces.interface,
                normal_forces: forces.normal,
                friction_force: forces.friction,
            }
        });
        object! { torque: vertex.torque, interfaces: Json::list(interfaces) }
    });
    object! {
        block: block(scene, found.block),
        at: Json::list(found.at.iter().copied()),
        robot: found.robot.map(|robot| scene.robots[robot.0].id.as_str()),
        shape: found.shape().word(),
        stands_without: found.contains([0.0, 0.0]),
        vertices: Json::list(found.vertices.iter().map(|vertex| vertex.force)),
        rays: Json::list(found.rays.iter().copied()),
        edges: Json::list(edges),
        balances: Json::list(balances).unless_empty(),
        mechanism: motions(scene, &found.mechanism).unless_empty(),
        gap: found.gap,
        cases: found.cases,
    }
}

/// The proof that a frame stands only by wedging.
///
/// Each motion includes the point of the block to which its velocity refers. The motion can therefore be checked
/// against the interfaces and forces in the same result, without the scene.
pub(super) fn wedging<'a>(solved: SolvedFrame<'a>, wedged: &Wedged) -> Json<'a> {
    let SolvedFrame { scene, found: frame, .. } = solved;
    let motion = |motions: &[Motion]| {
        Json::list(motions.iter().map(|motion| {
            let block = &scene.blocks[motion.block.0];
            object! { block: &block.id, at: block.centroid, velocity: motion.velocity, spin: motion.spin }
        }))
    };
    let faces = wedged.interfaces.iter().map(|number| {
        let bodies = frame.contacts[*number].interface.bodies.map(|body| scene.name(body));
        object! { interface: *number, bodies: bodies }
    });
    let least = wedged.at_least.as_ref();
    object! {
        must_press: Json::list(faces),
        normal_force_at_least: least.map(|(force, _)| *force),
        bound: least.map(|(_, bound)| motion(bound).unless_empty()),
        gives_way: motion(&wedged.gives_way),
        presses_nothing: wedged.presses_nothing,
        cases: wedged.ruled_out.len(),
        ruled_out: Json::list(wedged.ruled_out.iter().map(ruled_out)),
    }
}

/// A case that was excluded. If each contact is a spring, the cases together cover all ways in which contacts at rest
/// can press and slide.
fn ruled_out<'a>(case: &RuledOut) -> Json<'a> {
    let points = case.points.iter();
    let faces = case.faces.iter().map(|face| {
        let slides = match face.slides {
            Slide::Forth => "forth",
            Slide::Back => "back",
            Slide::Sticks => "sticks",
        };
        object! { interface: face.interface, slides: slides }
    });
    object! {
        points: Json::list(points.map(|p| object! { interface: p.interface, point: p.point, presses: p.presses })),
        faces: Json::list(faces),
    }
}
