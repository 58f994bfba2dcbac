//! Analyses all frames of a scene, one after the other.
//!
//! For each frame: assemble it, split it into components, decide the components that did not occur in an earlier frame,
//! and combine the results. If they are requested, wedging, margins, sensitivity and
//! the placement tolerance follow.

use std::collections::BTreeMap;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::decide::{self, Method, Outcome, decide_component};
use super::frame::complete_frame;
use super::frame::{Key, key};
use super::frame::{SolveReport, Stages};
use super::gather::{add_component, unloaded_frame};
use super::margin::{self, Margins, Part};
use super::placement;
use super::sensitivity::{self, Sensitivity};
use super::{FrameAnalysis, Options, UndecidedReason, Verdict};
use crate::clock::Instant;
use crate::mechanics::program::UnknownCounts;
use crate::mechanics::scene::{RobotId, Scene};
use crate::mechanics::solve::{DeadlineGuard, Effort};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect::report::{self, Wedging};
use crate::mechanics::statics::effect::{self, EffectReport, FrameContext};
use crate::mechanics::statics::interface::Interfaces;

/// Fewer components than this are decided on one thread: starting several threads costs more than it saves.
#[cfg(feature = "parallel")]
const MIN_PARALLEL_COMPONENTS: usize = 17;

/// Results for the components of earlier frames.
#[derive(Default)]
pub(super) struct ResultCache {
    findings: BTreeMap<Key, Outcome>,
    margins: BTreeMap<Key, Margins>,
}

/// A component of a frame, with its key in the cache and the results of its decision.
struct SolvedComponent<'a> {
    component: &'a Assembly,
    key: &'a Key,
    findings: &'a Outcome,
}

/// Finds the interfaces of a scene and analyses every frame. Gaps and overlaps between blocks stay as they are drawn.
pub(super) fn analyse(scene: &Scene, options: &Options) -> (Interfaces, Vec<FrameAnalysis>) {
    let interfaces = Interfaces::new(scene);
    let frames = analyse_frames(scene, &interfaces, options);
    (interfaces, frames)
}

/// Analyses every frame of a scene. `interfaces` are the interfaces of the whole scene.
pub(super) fn analyse_frames(scene: &Scene, interfaces: &Interfaces, options: &Options) -> Vec<FrameAnalysis> {
    let mut known = ResultCache::default();
    let frames = scene.frames.iter();
    frames
        .map(|frame| {
            let frame_interfaces = interfaces.in_frame(frame);
            let context = FrameContext { scene, frame, interfaces: &frame_interfaces };
            let mut analysis = analyse_frame(&context, *options, &mut known);
            analysis.notices.extend(interfaces.notices.iter().cloned());
            analysis
        })
        .collect()
}

/// Analyses one frame. Takes the results of components from `known` if they are there, and adds the results of new
/// components to `known`.
pub(super) fn analyse_frame(context: &FrameContext, options: Options, known: &mut ResultCache) -> FrameAnalysis {
    let start = Instant::now();
    let seconds = || start.elapsed().as_secs_f64();
    // Assemble bodies, contacts and loads. Split them into components: no force can act between bodies of different
    // components.
    let (assembly, reports) = effect::assemble(context);
    let components = assembly.components();
    let keys: Vec<Key> = components.iter().map(key).collect();
    let mut stages = Stages { assembly: seconds(), ..Stages::default() };
    // Decide each component.
    let (effort, fresh) = decide_fresh(&components, &keys, options, &mut known.findings);
    let solved = (components.iter().zip(&keys)).map(|(component, key)| {
        let findings = known.findings.get(key)?;
        Some(SolvedComponent { component, key, findings })
    });
    let solved: Vec<SolvedComponent> = solved.flatten().collect();
    // Combine the verdicts and forces of the components.
    let mut analysis = combine(context, &assembly, reports, &solved, options);
    stages.solution = seconds() - stages.assembly;
    analysis.solve = SolveReport {
        method: (solved.iter().map(|s| s.findings.method).max()).unwrap_or(Method::ClosedForm),
        iterations: effort.iterations,
        programs: effort.programs,
        groups: components.len(),
        reused: components.len() - fresh,
        seconds: 0.0,
        stages,
    };
    // Check wedging and compute margins, if they are requested.
    let _until = DeadlineGuard::new(options.deadline);
    let before = seconds();
    let wedging = find_wedging(context.scene, &mut analysis, &solved, options);
    let after = seconds();
    if options.ask.wedging {
        analysis.solve.stages.wedging = after - before;
    }
    let decided_count = find_margins(context.scene, &mut analysis, &solved, options, &mut known.margins);
    if decided_count.is_some() {
        analysis.solve.stages.margins = seconds() - after;
    }
    analysis.sensitivity = find_sensitivity(context, &analysis, &solved, options, &known.margins);
    analysis.effects.push(report::margins(decided_count));
    analysis.effects.push(report::wedging(wedging));
    if options.ask.placement {
        let before = seconds();
        if analysis.verdict == Verdict::Stable {
            let components = solved.iter().map(|s| s.component);
            analysis.placement = placement::find_placement(context.scene, components);
        }
        analysis.solve.stages.placement = seconds() - before;
        analysis.effects.push(report::placement(analysis.verdict == Verdict::Stable));
    }
    analysis.solve.seconds = seconds();
    analysis
}

/// Decides the components that are not in `known`, and adds their findings to `known`. Returns the total effort and the
/// number of these components.
fn decide_fresh(
    components: &[Assembly],
    keys: &[Key],
    options: Options,
    known: &mut BTreeMap<Key, Outcome>,
) -> (Effort, usize) {
    let fresh: Vec<usize> = (0..components.len()).filter(|k| !known.contains_key(&keys[*k])).collect();
    let decide_one = |k: &usize| {
        // A deadline guard applies only to the thread that creates it, so each task creates one.
        let _until = DeadlineGuard::new(options.deadline);
        decide_component(&components[*k], options)
    };
    // The results keep the order of the components, even if several threads compute them.
    #[cfg(feature = "parallel")]
    let findings: Vec<Outcome> = if fresh.len() >= MIN_PARALLEL_COMPONENTS {
        fresh.par_iter().map(decide_one).collect()
    } else {
        fresh.iter().map(decide_one).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let findings: Vec<Outcome> = fresh.iter().map(decide_one).collect();
    let effort = findings.iter().fold(Effort::default(), |sum, f| sum.plus(f.effort));
    for (k, findings) in fresh.iter().zip(findings) {
        known.insert(keys[*k].clone(), findings);
    }
    (effort, fresh.len())
}

/// Combines the findings of the components into the analysis of the frame.
fn combine(
    context: &FrameContext,
    assembly: &Assembly,
    reports: Vec<EffectReport>,
    solved: &[SolvedComponent],
    options: Options,
) -> FrameAnalysis {
    let mut analysis = unloaded_frame(context, assembly, reports);
    for SolvedComponent { component, findings, .. } in solved {
        add_component(&mut analysis, component, findings, context.scene.kernel);
    }
    let count = solved.iter().fold(UnknownCounts::default(), |sum, s| sum.plus(&s.findings.count));
    complete_frame(&mut analysis, context, &count, options.verdict_only);
    if analysis.verdict == Verdict::Undecided && options.is_late() {
        analysis.doubts.insert(0, UndecidedReason::Late);
    }
    analysis
}

/// If `options` request it, checks whether a stable frame stands only by wedging. Writes the answer to `analysis`, and
/// returns the outcome for the effect report.
fn find_wedging(scene: &Scene, analysis: &mut FrameAnalysis, solved: &[SolvedComponent], options: Options) -> Wedging {
    match (options.ask.wedging, analysis.verdict) {
        (false, _) => Wedging::NotRequested,
        (true, Verdict::Stable) => {
            let components = solved.iter().map(|s| (s.component, s.findings));
            let (only, shown, wedged) = decide::only_by_wedging(scene, components);
            (analysis.only_by_wedging, analysis.wedged) = (only, wedged);
            shown
        }
        (true, _) => Wedging::Falls,
    }
}

/// Computes the margins of a frame. Stores them in `analysis`, with a notice for each withheld margin. Returns how many
/// changed copies of the frame's components were evaluated for this; `None` if `options` request no margins.
fn find_margins(
    scene: &Scene,
    analysis: &mut FrameAnalysis,
    solved: &[SolvedComponent],
    options: Options,
    known: &mut BTreeMap<Key, Margins>,
) -> Option<usize> {
    let kinds = options.ask.with_needed().margins;
    if kinds.is_empty() {
        return None;
    }
    let parts = solved.iter().map(|s| Part { component: s.component, key: s.key, findings: s.findings });
    let parts: Vec<Part> = parts.collect();
    let (margins, decided_count) = margin::find_margins(&parts, kinds, known);
    let name = |robot: RobotId| scene.robots[robot.0].id.clone();
    analysis.notices.extend(margins.withheld(name));
    let most = parts.iter().map(|part| part.component.grips.len()).max().unwrap_or_default();
    if kinds.has(margin::MarginKind::Robots) && most > margin::MAX_ROBOTS {
        analysis.notices.push(format!(
            "margins: {most} robots that hold connected blocks are too many, the limits of at most {} are \
             examined; use fewer robots",
            margin::MAX_ROBOTS
        ));
    }
    analysis.margins = Some(margins);
    Some(decided_count)
}

/// Computes the sensitivity of one margin: its derivatives with respect to geometry, weights, friction and loads.
/// `None` if `options` do not request a sensitivity, or if the frame has no margins.
fn find_sensitivity(
    context: &FrameContext,
    analysis: &FrameAnalysis,
    solved: &[SolvedComponent],
    options: Options,
    known: &BTreeMap<Key, Margins>,
) -> Option<Sensitivity> {
    let kind = options.ask.sensitivity?;
    let margins = analysis.margins.as_ref()?;
    let parts = solved.iter().map(|s| sensitivity::Part {
        component: s.component,
        interval: known.get(s.key).and_then(|margins| margins.of(kind)),
    });
    let parts: Vec<sensitivity::Part> = parts.collect();
    Some(sensitivity::find(context, &parts, margins.of(kind), kind))
}
