//! [`sections`] makes the sections of a report on a scene: the main section about the governing step, with a
//! table of all steps, then pictures of other steps that do not stand, and in a full report an appendix for each step.

use super::joints::Ranking;
use super::part::FigureCount;
use super::row::{governing, thumbnail};
use super::sheet::{empty, others, sheet};
use super::{Chart, Grid, ReportOptions, Section, SheetPart, TableCell};
use crate::mechanics::analysis::{Analysis, EffectName, EffectReport, FrameAnalysis, SolvedFrame, Stages, Verdict};
use crate::pictures::chart::{self, Bars};
use crate::products::result::Timing;
use crate::products::wording::margin::headline;
use crate::products::wording::number::{counted, duration, letter, place, prefixed};
use crate::products::wording::{failure, verdict};
use crate::text::line;

/// Largest number of steps that do not stand and are drawn in addition to the governing step. A full report draws all
/// of them.
const MAX_FALLING_STEPS: usize = 4;

/// Makes the sections of a report on a scene.
pub(super) fn sections(analysis: &Analysis, report_options: &ReportOptions) -> Vec<Section> {
    let count = analysis.frames.len();
    let governing = governing(analysis);
    let steps = (count > 1).then(|| table(analysis));
    let mut drawn = FigureCount::default();
    let mut sections = Vec::from(sheet(analysis, governing, steps, report_options, &mut drawn));
    if count > 1 {
        sections[0].title = format!("{} (the step that governs)", sections[0].title);
    }
    let falling = (0..count).filter(|n| analysis.frames[*n].verdict != Verdict::Stable && *n != governing);
    let falling: Vec<usize> = falling.take(if report_options.full { count } else { MAX_FALLING_STEPS }).collect();
    if !falling.is_empty() {
        let mut section = empty(analysis.given(), governing, analysis.verdict());
        (section.letter, section.title) = (String::new(), "Other steps that do not stand".to_owned());
        section.parts = others(analysis, &falling, report_options);
        drawn.number_parts(&mut section.parts);
        sections.push(section);
    }
    if report_options.full {
        sections.extend((0..count).map(|number| appendix(analysis, number, report_options)));
    }
    sections
}

fn table(analysis: &Analysis) -> Grid {
    let mut grid = Grid::new("", &["picture", "step", "verdict", "headline margin"]);
    for solved @ SolvedFrame { scene, number, found: frame_analysis, .. } in analysis.each() {
        let title = match solved.frame().title.as_str() {
            "" => format!("Step {}", number + 1),
            title => line(title),
        };
        let headline = match headline(solved) {
            words if words.is_empty() => "–".to_owned(),
            words => line(&words),
        };
        grid.add(
            "",
            [
                TableCell::picture(thumbnail(scene, &scene.frames[number].placed)),
                format!("({}) {title}", letter(number)).into(),
                TableCell::strong_if(frame_analysis.verdict != Verdict::Stable, frame_analysis.verdict.plain()),
                headline.into(),
            ],
        );
    }
    grid
}

/// Frames with fewer joints have no charts, because a short table is easier to read than a chart.
const MIN_CHART_JOINTS: usize = 8;

/// Makes the appendix of a frame: all joints that carry force, all failures, effects with their cost, the proof in
/// numbers, and charts. `number` is the index of the frame.
fn appendix(analysis: &Analysis, number: usize, report_options: &ReportOptions) -> Section {
    let solved @ SolvedFrame { scene, found: frame_analysis, .. } = analysis.at(number);
    let mut section = empty(scene, number, frame_analysis.verdict);
    section.title = format!("Appendix {}", section.title).trim_end().to_owned();
    let grids = [
        Ranking::new(solved).table(),
        failures(solved),
        cost(frame_analysis, report_options.timing),
        proved(frame_analysis),
    ];
    section.begins_page = true;
    section.parts.extend(grids.map(SheetPart::Table));
    section.parts.push(SheetPart::Charts(charts(frame_analysis)));
    section
}

fn failures(solved: SolvedFrame<'_>) -> Grid {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut grid = Grid::new("What fails", &["what", "at"]);
    for what in failure::unsupported(solved, usize::MAX) {
        grid.add("", [line(&what), String::new()]);
    }
    for (number, failed) in frame_analysis.failures.iter().enumerate() {
        let cells = [line(&failure::missing_sentence(scene, failed)), place(failed.at(), scene.units)];
        grid.add(format!("f{number}"), cells);
    }
    grid
}

fn proved(frame_analysis: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new("The proof in numbers", &["what", "#how much"]);
    for (what, much) in verdict::proof_numbers(frame_analysis.proof) {
        grid.add("", [what.to_owned(), much]);
    }
    grid
}

fn charts(frame_analysis: &FrameAnalysis) -> Vec<Chart> {
    if frame_analysis.contacts.len() < MIN_CHART_JOINTS {
        return Vec::new();
    }
    let (unit, factor) = prefixed(frame_analysis.largest_at_contacts(), "N");
    let forces: Vec<f64> = frame_analysis.contacts.iter().map(|c| c.amount() * factor).collect();
    let loaded = frame_analysis.contacts.iter().filter(|c| c.amount() > 0.0);
    let used: Vec<f64> = loaded.map(|c| 100.0 * c.friction_used).collect();
    let kinds = [
        ("Number of joints by force", format!("force at a joint, {unit}"), Bars::counted(&forces, None)),
        (
            "Number of loaded joints by share of friction used",
            "friction used, %".to_owned(),
            Bars::counted(&used, Some(100.0)),
        ),
    ];
    let drawn = kinds.into_iter().filter_map(|(caption, x, bars)| {
        let chart = Bars { title: caption.to_owned(), x, y: "joints".to_owned(), ..bars };
        // `chart::bars` returns an error if there are no values. The chart is then left out.
        let svg = chart::bars(&chart).ok()?;
        Some(Chart { caption: caption.to_owned(), svg, wide: false })
    });
    drawn.collect()
}

/// Makes the table of the effects that were simulated or left out in a frame. The table has times only if `timing`
/// includes them.
fn cost(frame_analysis: &FrameAnalysis, timing: Timing) -> Grid {
    let timed = timing == Timing::Included;
    let (caption, heads): (&str, &[&str]) = if timed {
        (
            "What was simulated, what was left out, and what it cost",
            &["effect or stage", "simulated", "why", "#unknowns", "#time"],
        )
    } else {
        ("What was simulated, and what was left out", &["effect", "simulated", "why", "#unknowns"])
    };
    let mut grid = Grid::new(caption, heads);
    let mut add = |(cells, time): ([String; 4], String)| {
        grid.add("", cells.into_iter().chain(timed.then_some(time)));
    };
    for described in &frame_analysis.effects {
        add(effect(described, &frame_analysis.solve.stages));
    }
    if timed {
        stages(&frame_analysis.solve.stages).into_iter().for_each(&mut add);
    }
    add(sum(frame_analysis));
    grid
}

/// Returns the table cells of an effect, and its time in words: `none` for an effect that was left out, `shared` for an
/// effect without a time of its own.
fn effect(described: &EffectReport, stages: &Stages) -> ([String; 4], String) {
    let time = match described.effect {
        _ if !described.simulated => "none".to_owned(),
        EffectName::Margins => duration(stages.margins),
        EffectName::Wedging => duration(stages.wedging),
        EffectName::Placement => duration(stages.placement),
        _ => "shared".to_owned(),
    };
    let name = format!("{}: {}", described.effect, described.effect.meaning());
    let simulated = if described.simulated { "yes" } else { "left out" };
    let unknowns = match (described.simulated, described.unknowns) {
        (_, 0) => "none".to_owned(),
        (true, n) => n.to_string(),
        (false, n) => format!("{n} saved"),
    };
    let why = line(&described.why);
    ([name, simulated.to_owned(), why, unknowns], time)
}

/// Returns the table cells of the stages that all effects share, and their times.
fn stages(stages: &Stages) -> [([String; 4], String); 2] {
    let stage = |name: &str, why: &str, seconds: f64| {
        let cells = [name, "", why, ""].map(str::to_owned);
        (cells, duration(seconds))
    };
    [
        stage(
            "setting up",
            "the equations of all effects are set up together, so no time can be given for a single effect",
            stages.assembly,
        ),
        stage(
            "solving and proving",
            "all effects are solved together and have no times of their own, except margins, wedging and placement",
            stages.solution,
        ),
    ]
}

/// Returns the table cells of the last row, which has the sums over all effects, and the total time.
fn sum(frame_analysis: &FrameAnalysis) -> ([String; 4], String) {
    let solve = &frame_analysis.solve;
    let simulated = frame_analysis.effects.iter().filter(|e| e.simulated);
    let unknowns: usize = simulated.map(|e| e.unknowns).sum();
    let how = format!(
        "{}, {}; {}, {} of them with results of earlier steps",
        counted(solve.programs, "program"),
        counted(solve.iterations, "iteration"),
        counted(solve.groups, "separate part"),
        solve.reused
    );
    let name = format!("all together, decided by: {}", solve.method.name());
    let cells = [name, String::new(), how, unknowns.to_string()];
    (cells, duration(solve.seconds))
}
