//! Structures that fall under gravity in several directions. Their failures are listed, and the missing forces of
//! these failures balance every block.

use drystone::Analysis;
use drystone::analysis::{EffectName, Failure, FrameAnalysis, MarginKind, MarginKinds, Options, Verdict, verdicts};
use drystone::internals::effect::{FrameContext, assemble};
use drystone::internals::geometry::{Point, Vector, cross};
use drystone::internals::interface::Interfaces;
use drystone::internals::program::{
    Aim, Column, Program, Scale, adhesion_columns, columns, force_primal, kinematic_form,
};
use drystone::internals::solve::{Conditioning, Status, TOLERANCE, solve};
use drystone::scene::{BodyId, Scene};
use serde_json::{Value, json};

use crate::structure::{arch, block, first, on_floor, rectangle, scene, tilted, wall};

/// The largest unbalanced force on a block, N, or unbalanced moment divided by 1 m. Weights, contact forces and
/// adhesion are summed.
fn unbalanced(scene: &Scene, frame: &FrameAnalysis) -> f64 {
    let mut sums: Vec<(Vector, f64)> = Vec::new();
    for block in scene.blocks() {
        sums.push((scene.down() * block.weight, 0.0));
    }
    let mut act = |bodies: [BodyId; 2], at: Point, force: Vector| {
        for (body, sign) in bodies.into_iter().zip([1.0, -1.0]) {
            if let BodyId::Block(id) = body {
                sums[id.0].0 += force * sign;
                sums[id.0].1 += cross(at - scene.blocks()[id.0].centroid, force * sign);
            }
        }
    };
    for contact in &frame.contacts {
        let bodies = contact.interface.bodies;
        for (at, normal) in contact.application_points.iter().zip(contact.normal_forces) {
            act(bodies, *at, contact.interface.normal * normal);
        }
        let along = contact.interface.tangent() * contact.friction_force;
        act(bodies, contact.application_points[0], along);
    }
    for failure in &frame.failures {
        match *failure {
            Failure::Tension { bodies, at, force } | Failure::Friction { bodies, at, force } => {
                act(bodies, at, force);
            }
            _ => panic!("no robot holds anything here"),
        }
    }
    let sizes = sums.iter().map(|(force, moment)| force.norm().max(moment.abs()));
    sizes.fold(0.0, f64::max)
}

fn amount(failure: &Failure) -> f64 {
    match failure {
        Failure::Tension { force, .. } | Failure::Friction { force, .. } => force.norm(),
        _ => 0.0,
    }
}

/// Asserts that a tilted structure falls, and that its failures balance every block and sum to the total adhesion.
fn assert_failures_are_listed(file: Value, degrees: f64) {
    let scene = scene(&tilted(file, degrees));
    let frame = Analysis::new(&scene).frames.remove(0);
    assert_eq!(frame.verdict, Verdict::Unstable, "{degrees}°");
    assert!(!frame.failures.is_empty(), "{degrees}°: no failure is listed");
    let off = unbalanced(&scene, &frame);
    assert!(off < 1e-4, "{degrees}°: a block of 6 N has an unbalanced force of {off} N");
    let sum: f64 = frame.failures.iter().map(amount).sum();
    assert!(
        (sum - frame.total_sticking).abs() < 1e-9 * frame.total_sticking,
        "{degrees}°: the failures sum to {sum} N instead of {}",
        frame.total_sticking
    );
    // A force of less than a millionth of a block's weight would be a rounding error of the solver.
    let lightest = scene.blocks().iter().map(|block| block.weight);
    let lightest = lightest.fold(f64::INFINITY, f64::min);
    let least = frame.failures.iter().map(amount);
    let least = least.fold(f64::INFINITY, f64::min);
    assert!(
        least > 1e-6 * lightest,
        "{degrees}°: a failure of {least} N is listed, and the lightest block weighs {lightest} N"
    );
}

/// A wall of 20 courses falls beyond 25.7°. At 26° the least adhesion is half of a brick's weight.
#[test]
fn tilted_walls_list_their_failures() {
    for degrees in [26.0_f64, 30.0, 40.0, 60.0] {
        assert_failures_are_listed(wall(10, 10), degrees.max(30.0));
        assert_failures_are_listed(wall(20, 20), degrees);
    }
}

#[test]
fn tilted_arches_list_their_failures() {
    for degrees in [26.0, 40.0, 60.0] {
        assert_failures_are_listed(arch(101, 0.3, 0.7), degrees);
    }
}

/// The least-squares forces of a long arch are unique: they do not depend on the order of the blocks.
#[test]
fn the_forces_of_a_long_arch_do_not_depend_on_the_order_of_its_blocks() {
    let mut file = arch(1001, 0.3, 0.7);
    let before = scene(&file);
    file["blocks"].as_array_mut().unwrap().reverse();
    let after = scene(&file);
    let [before, after] = [&before, &after].map(|scene| Analysis::new(scene).frames.remove(0));
    assert_eq!(before.verdict, Verdict::Stable);
    assert!((before.total_force - after.total_force).abs() < 1e-7 * before.total_force);
    let worst = |frame: &FrameAnalysis| {
        let used = frame.contacts.iter().map(|c| c.resultant.force.norm());
        used.fold(0.0, f64::max)
    };
    assert!((worst(&before) - worst(&after)).abs() < 1e-6 * worst(&before));
}

/// With `verdict_only`, the result contains the verdict and its proof. The program for the least adhesion is not
/// solved, and a notice states this.
#[test]
fn the_verdict_alone_is_proved_and_a_notice_states_what_is_missing() {
    let verdict_only = Options::default().verdict_only(true);
    let files = [
        (wall(10, 10), 0.0, Verdict::Stable),
        (wall(10, 10), 28.0, Verdict::Stable),
        (wall(10, 10), 30.0, Verdict::Unstable),
        (wall(20, 20), 60.0, Verdict::Unstable),
        (arch(101, 0.3, 0.7), 0.0, Verdict::Stable),
        (arch(101, 0.3, 0.7), 40.0, Verdict::Unstable),
    ];
    for (file, degrees, verdict) in files {
        let scene = scene(&tilted(file, degrees));
        let frame = Analysis::with(&scene, &verdict_only).frames.remove(0);
        let whole = Analysis::new(&scene).frames.remove(0);
        assert_eq!((frame.verdict, whole.verdict), (verdict, verdict), "{degrees}°");
        assert!(frame.proof.holds());
        assert_eq!(verdicts(&scene, &Options::default()), [verdict]);
        let programs = |frame: &FrameAnalysis| frame.solve.programs;
        assert!(programs(&frame) <= programs(&whole), "{degrees}°");
        let sticking = |frame: &FrameAnalysis| {
            let effect = frame.effects.iter().find(|e| e.effect == EffectName::Sticking);
            let effect = effect.expect("every effect is listed");
            (effect.simulated, effect.why.contains("only the verdict"))
        };
        let falls = verdict == Verdict::Unstable;
        assert_eq!(sticking(&frame), (false, falls));
        assert_eq!(sticking(&whole), (falls, false));
        assert!(frame.notices.iter().any(|n| n.starts_with("only the verdict")));
        assert!(frame.failures.is_empty() && frame.total_sticking == 0.0);
        if falls {
            assert!(2 * programs(&frame) < programs(&whole), "{degrees}°");
            assert_eq!(frame.total_force, 0.0);
            assert!(!frame.mechanism.is_empty());
        } else {
            let off = (frame.total_force - whole.total_force).abs();
            assert!(off < 1e-6 * whole.total_force, "{degrees}°: off by {off} N");
        }
    }
}

/// A motion of very many blocks has little power. If it violates no contact, it still proves the fall. In the second
/// case, another brick touches the lowest one, so the forces are not unique. Then one program is enough.
#[test]
fn the_verdict_of_a_high_tilted_stack_needs_at_most_one_program() {
    let at = |k: i32| rectangle(0.0, 0.5 * f64::from(k), 1.0, 0.5);
    let mut bricks: Vec<Value> = (0..2_000).map(|k| block(&k.to_string(), at(k), 6.0)).collect();
    let verdict_only = Options::default().verdict_only(true);
    for programs in [0, 1] {
        let scene = scene(&tilted(on_floor(0.7, bricks.clone()), 26.0));
        let frame = Analysis::with(&scene, &verdict_only).frames.remove(0);
        assert_eq!(frame.verdict, Verdict::Unstable);
        assert!(frame.proof.holds());
        assert_eq!(frame.solve.programs, programs);
        bricks.push(block("neighbour", rectangle(-1.0, 0.0, 1.0, 0.5), 6.0));
    }
}

/// A stack that leans by nine tenths of its limit, alone and with another brick that touches the lowest one. With
/// that brick the forces are not unique: an arbitrary balance may have no proof, but the balance of least forces has
/// one. The program of the least residual would end without a result after 200 iterations.
#[test]
fn the_verdict_alone_of_a_stack_of_ten_thousand_blocks_needs_few_programs() {
    let at = |k: i32| rectangle(9e-5 * f64::from(k), 0.25 * f64::from(k), 1.0, 0.25);
    let neighbour = block("neighbour", rectangle(-1.0, 0.0, 1.0, 0.25), 1.0);
    let alone: Vec<_> = (0..10_000).map(|k| block(&k.to_string(), at(k), 1.0)).collect();
    let with_neighbour = alone.iter().cloned().chain([neighbour]).collect();
    let verdict_only = Options::default().verdict_only(true);
    for (bricks, most) in [(alone, 0), (with_neighbour, 8)] {
        for (degrees, verdict) in [(0.0, Verdict::Stable), (40.0, Verdict::Unstable)] {
            let scene = scene(&tilted(on_floor(0.7, bricks.clone()), degrees));
            let frame = Analysis::with(&scene, &verdict_only).frames.remove(0);
            assert_eq!(frame.verdict, verdict, "{degrees}°");
            let solve = &frame.solve;
            assert!(solve.programs <= most && solve.iterations <= 60, "{degrees}°: {solve:?}");
        }
    }
}

/// The centre of gravity of the m bricks above a joint lies half a brick and (m − 1)/2 shifts to the right of the
/// joint's left end. If it lies beyond the right end, the left end needs a tension: the weight of these bricks times
/// the distance beyond the right end, divided by the length of the joint.
#[test]
fn the_adhesion_of_a_falling_stack_follows_from_the_balance_above_each_joint() {
    let (bricks, shift) = (10_000, 1.1e-4);
    let at = |k: usize| rectangle(shift * k as f64, 0.25 * k as f64, 1.0, 0.25);
    let all = (0..bricks).map(|k| block(&k.to_string(), at(k), 1.0));
    let mut file = on_floor(0.7, all.collect());
    file["contact_tolerance"] = json!(1e-9);
    let frame = first(&file);
    let pulls: Vec<f64> = (0..bricks)
        .map(|k| {
            let above = (bricks - k) as f64;
            let face = if k == 0 { 1.0 } else { 1.0 - shift };
            f64::max(0.0, above * (0.5 + 0.5 * shift * (above - 1.0) - face) / face)
        })
        .collect();
    let total: f64 = pulls.iter().sum();
    assert_eq!(frame.verdict, Verdict::Unstable);
    assert!((frame.total_sticking - total).abs() < 1e-9 * total);
    let joints = pulls.iter().filter(|pull| **pull > 0.0).count();
    assert_eq!(frame.failures.len(), joints);
    assert!(joints > 900 && frame.solve.programs <= 3, "{:?}", frame.solve);
}

/// The program of a structure whose blocks are all connected.
pub fn program(scene: &Scene) -> Program {
    let found = Interfaces::new(scene);
    let frame = &scene.frames()[0];
    let (assembly, _) = assemble(&FrameContext { scene, frame, interfaces: &found.in_frame(frame) });
    Program::new(&assembly, Scale::from_assembly(&assembly))
}

/// With about a thousand blocks, plain conditioning uses the normal equations and full conditioning uses clarabel.
#[test]
fn two_solvers_agree_on_a_thousand_bricks_that_stand_or_fall() {
    let file = wall(30, 30);
    for (degrees, stands) in [(0.0, true), (40.0, false)] {
        let program = program(&scene(&tilted(file.clone(), degrees)));
        let (loads, all) = (&program.loads, columns(&program));
        let least_force = kinematic_form(loads, &all, &Aim::Least(&|c: &Column| c.cost)).0;
        let any_balance = force_primal(loads, &all, |_| 0.0, None);
        let least_residual = kinematic_form(loads, &all, &Aim::Residual).0;
        let expected =
            if stands { [Status::Solved; 3] } else { [Status::Unbounded, Status::Infeasible, Status::Solved] };
        let problems = [least_force, any_balance, least_residual];
        for (problem, status) in problems.iter().zip(expected) {
            let [ours, theirs] =
                [Conditioning::Plain, Conditioning::Full].map(|conditioning| solve(problem, TOLERANCE, conditioning));
            assert_eq!((ours.status, theirs.status), (status, status));
            assert_ne!(ours.x, theirs.x, "the same solver was used twice");
            if status == Status::Solved {
                let costs = [&ours, &theirs].map(|answer| {
                    let terms = problem.linear.iter().zip(&answer.x);
                    terms.map(|(q, x)| q * x).sum::<f64>()
                });
                let off = (costs[0] - costs[1]).abs();
                assert!(off < 1e-6 * costs[1].abs().max(1.0), "{costs:?}");
            }
        }
    }
}

/// So close to the limit, a step of the normal equations leaves 10⁻⁶ of the loads unbalanced. But the program still
/// ends within 60 iterations.
#[test]
fn a_wall_a_hundred_thousandth_before_its_limit_is_balanced_quickly() {
    let limit = 24.299_095;
    let program = program(&scene(&tilted(wall(30, 30), limit * (1.0 - 1e-5))));
    let all = columns(&program);
    let largest = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let loads: Vec<f64> = program.loads.iter().map(|v| v / largest).collect();
    for problem in [force_primal(&loads, &all, |_| 0.0, None), kinematic_form(&loads, &all, &Aim::Residual).0] {
        let answer = solve(&problem, TOLERANCE, Conditioning::Plain);
        assert_eq!(answer.status, Status::Solved);
        assert!(answer.iterations < 60, "{}", answer.iterations);
    }
}

/// A ten-thousandth of a degree beyond its limit, a wall needs almost no adhesion. For velocities that violate no
/// column, the power of the loads is a lower bound of the least adhesion (weak duality). The reported adhesion equals
/// this bound.
#[test]
fn just_beyond_its_limit_a_wall_needs_the_least_adhesion_by_duality() {
    let file = wall(16, 16);
    let options = Options::default().margins(MarginKinds::new(&[MarginKind::Tilt]));
    let upright = Analysis::with(scene(&file), &options).frames.remove(0);
    let margins = upright.margins.as_ref().expect("margins were requested");
    let limit = margins.most(MarginKind::Tilt).expect("the tilt has a limit");
    let scene = scene(&tilted(file, limit + 1e-4));
    let frame = Analysis::new(&scene).frames.remove(0);
    assert_eq!(frame.verdict, Verdict::Unstable);

    let program = program(&scene);
    let mut all = columns(&program);
    all.extend(adhesion_columns(&program));
    let cost = |c: &Column| f64::from(u8::from(c.force.is_adhesion()));
    let (problem, _) = kinematic_form(&program.loads, &all, &Aim::Least(&cost));
    let y = solve(&problem, TOLERANCE, Conditioning::Plain).x;
    let violated = all.iter().map(|c| c.dot(&y) - cost(c));
    assert!(violated.fold(0.0, f64::max) < 1e-12);
    let power: f64 = program.loads.iter().zip(&y).map(|(l, y)| l * y).sum();
    let bound = power * program.scale.force;
    assert!(bound > 0.0 && bound < 1e-5 * frame.total_force, "{bound} N");
    let off = frame.total_sticking / bound - 1.0;
    assert!(off.abs() < 1e-6, "{} N instead of {bound} N", frame.total_sticking);
}

/// The centre of gravity of all bricks above the lowest one lies a thousandth of a brick beyond the right end of the
/// lowest joint. For all other joints and for the ground, the centre of gravity of the bricks above lies inside. So
/// all bricks but the lowest tip about that end as one body.
#[test]
fn a_tall_leaning_stack_tips_as_one_body() {
    let (count, high) = (300_u32, 0.25);
    let shift = 1.002 / f64::from(count);
    let bricks = (0..count).map(|k| {
        let at = rectangle(shift * f64::from(k), high * f64::from(k), 1.0, high);
        block(&format!("b{k}"), at, 1.0)
    });
    let scene = scene(&on_floor(0.7, bricks.collect()));
    let analysis = Analysis::with(&scene, &Options::default().verdict_only(true));
    let frame = &analysis.frames[0];
    assert_eq!(frame.verdict, Verdict::Unstable);
    assert!(frame.solve.programs <= 5, "{} programs", frame.solve.programs);
    let hinge = Point::new(1.0, high);
    let spin = frame.mechanism[0].spin;
    assert!(spin < 0.0, "to the right: {spin}");
    assert_eq!(frame.mechanism.len(), count as usize - 1);
    for motion in &frame.mechanism {
        let arm = scene.blocks()[motion.block.0].centroid - hinge;
        let expected = Vector::new(-arm.y, arm.x) * spin;
        assert!((motion.spin - spin).abs() < 1e-12 * spin.abs());
        let off = (motion.velocity - expected).norm();
        assert!(off < 1e-6, "{motion:?}, off by {off:e}");
    }
}
