//! [`sheet`]: the main section of a report, about one frame. It fills about two pages: first verdict, pictures and
//! inputs, then balance, joints, margins and assumptions.

use super::joints::{Ranking, robots};
use super::row::headline_words;
use super::unit::Units;
use super::{Badge, Figure, Grid, ReportOptions, Section, SheetPart, TableCell, balance, bullet, inputs, verdict_text};
use crate::mechanics::analysis::{Analysis, EffectName, FrameAnalysis, MovementOutcome, Verdict};
use crate::mechanics::scene::Scene;
use crate::mechanics::scene::Unit;
use crate::pictures::drawing::Drawing;
use crate::products::figure::{self, Kind, Options};
use crate::products::wording::number::letter;
use crate::products::wording::verdict::plain;
use crate::products::wording::{movement, placement, proof, removable, verdict};
use crate::text::line;

/// Width of a figure, in pixels. It is half a page, so that labels are legible in print and on a phone.
const FIGURE_WIDTH: f64 = 440.0;
/// Height of the picture in a figure, in pixels.
const FIGURE_HEIGHT: f64 = 300.0;

/// Returns the options for figures in a report. The figures have no titles and no verdicts, because the page shows
/// both.
pub(super) fn options(report_options: &ReportOptions) -> Options {
    Options {
        theme: report_options.theme.clone(),
        titles: false,
        captions: false,
        verdicts: false,
        width: Some(FIGURE_WIDTH),
        height: Some(FIGURE_HEIGHT),
        ..Options::default()
    }
}

/// Makes a section without parts for the step with index `number`. Its title is the title of the step. If there are
/// several steps, the section also has a letter, and a step without a title is called `Step 1`, `Step 2`, ….
pub(super) fn empty(scene: &Scene, number: usize, verdict: Verdict) -> Section {
    let several = scene.frames.len() > 1;
    let title = line(&scene.frames[number].title);
    Section {
        letter: if several { letter(number) } else { String::new() },
        title: if title.is_empty() && several { format!("Step {}", number + 1) } else { title },
        verdict,
        begins_page: false,
        parts: Vec::new(),
    }
}

/// Makes the main section of a report, about the frame with index `number`. `steps` is the table of all steps if the
/// scene has several, otherwise `None`.
pub(super) fn sheet(
    analysis: &Analysis,
    number: usize,
    steps: Option<Grid>,
    report_options: &ReportOptions,
) -> Section {
    let (scene, frame_analysis) = (&analysis.scene, &analysis.frames[number]);
    let ranking = Ranking::new(scene, frame_analysis);
    let mut section = empty(scene, number, frame_analysis.verdict);
    let parts = &mut section.parts;
    parts.push(SheetPart::Badge(Box::new(badge(scene, number, frame_analysis))));
    parts.push(SheetPart::Figures(figures(analysis, number, report_options, &ranking)));
    parts.extend(failure_description(analysis, number));
    parts.push(given(scene, number, Units::new(scene, frame_analysis)));
    if let Some(steps) = steps {
        parts.push(SheetPart::Heading("Steps".to_owned()));
        parts.push(SheetPart::Table(steps));
    }
    parts.push(SheetPart::Heading("Reactions and balance".to_owned()));
    parts.push(SheetPart::Table(balance::whole(analysis, number)));
    parts.push(SheetPart::Heading("Governing joints".to_owned()));
    parts.push(SheetPart::Table(ranking.table(false)));
    parts.push(SheetPart::Note(ranking.words()));
    parts.push(SheetPart::Table(robots(scene, frame_analysis)));
    if let Some(block) = ranking.block() {
        parts.push(SheetPart::Heading("Governing block".to_owned()));
        parts.push(SheetPart::Table(balance::of_block(analysis, number, block)));
    }
    parts.push(SheetPart::Note(balance::check_words(frame_analysis)));
    parts.extend(margins(scene, frame_analysis));
    parts.extend(movements(scene, frame_analysis));
    parts.push(SheetPart::Heading("Assumptions and proof".to_owned()));
    parts.push(SheetPart::Text(assumptions(scene, frame_analysis)));
    parts.push(SheetPart::Text(proof::sentence(frame_analysis.proof)));
    parts.extend(remarks(scene, frame_analysis).into_iter().map(SheetPart::Note));
    section
}

/// Describes steps that do not stand, in two columns. `numbers` has the indices of the steps. Each step has its first
/// figure and the reason for its verdict.
pub(super) fn others(analysis: &Analysis, numbers: &[usize], report_options: &ReportOptions) -> Vec<SheetPart> {
    let scene = &analysis.scene;
    let column = |number: &usize| {
        let frame_analysis = &analysis.frames[*number];
        let own = empty(scene, *number, frame_analysis.verdict);
        let mut figures = figures(analysis, *number, report_options, &Ranking::new(scene, frame_analysis));
        figures.truncate(1);
        figures.iter_mut().for_each(|figure| figure.touches.clear());
        vec![
            SheetPart::Heading(format!("({}) {}: {}", own.letter, own.title, plain(own.verdict))),
            SheetPart::Figures(figures),
            SheetPart::Note(sentence(scene, frame_analysis)),
        ]
    };
    let columns: Vec<Vec<SheetPart>> = numbers.iter().map(column).collect();
    columns.chunks(2).map(|pair| SheetPart::Columns(pair.to_vec())).collect()
}

/// Returns a sentence with the verdict and its reasons. Forces and torques have the unit and
/// SI prefix that the report uses for this frame.
fn sentence(scene: &Scene, frame_analysis: &FrameAnalysis) -> String {
    let units = Units::new(scene, frame_analysis);
    let write = |value: f64, unit: Unit| units.words(value, unit);
    line(&verdict::sentence_with(scene, frame_analysis, &write))
}

fn badge(scene: &Scene, number: usize, frame_analysis: &FrameAnalysis) -> Badge {
    Badge {
        verdict: frame_analysis.verdict,
        headline: headline_words(scene, number, frame_analysis),
        bar: bullet::margin_bars(scene, frame_analysis).into_iter().next(),
        sentence: sentence(scene, frame_analysis),
    }
}

/// Draws the figures of a frame. For a falling frame, they show the collapse and the forces. For a standing frame, they
/// show the force flow, and how the frame would fall beyond its margin. For an undecided frame, they show the forces.
/// A collapse or fall that is not known has no figure. Without interfaces, forces replace the force flow.
fn figures(analysis: &Analysis, number: usize, report_options: &ReportOptions, ranking: &Ranking<'_>) -> Vec<Figure> {
    let frame_analysis = &analysis.frames[number];
    let options = options(report_options);
    let dark = report_options.dark.as_ref().map(|theme| Options { theme: theme.clone(), ..options.clone() });
    let drawn = |kind: Kind, change: &dyn Fn(&mut Options)| -> Option<(Drawing, Option<Drawing>)> {
        let one = |options: &Options| {
            let mut options = options.clone();
            change(&mut options);
            let panels = figure::panels_of(analysis, kind, &options, &[number]);
            panels.into_iter().next()
        };
        Some((one(&options)?, dark.as_ref().and_then(one)))
    };
    let mut figures = Vec::new();
    for (kind, caption) in kinds_of_figures(frame_analysis) {
        let toward = verdict_text::toward(frame_analysis).filter(|_| kind == Kind::Margin);
        let change = |options: &mut Options| {
            if let Some(toward) = toward {
                options.toward = toward;
            }
        };
        if let Some((drawing, dark)) = drawn(kind, &change) {
            let touches = if figures.is_empty() { ranking.touches() } else { Vec::new() };
            figures.push(Figure { caption: caption.to_owned(), drawing, dark, touches, subject: Some((kind, number)) });
        }
    }
    figures
}

/// Returns the kinds of the figures of a frame, with their captions.
fn kinds_of_figures(frame_analysis: &FrameAnalysis) -> Vec<(Kind, &'static str)> {
    let mut kinds = Vec::new();
    match frame_analysis.verdict {
        Verdict::Unstable => {
            if !frame_analysis.mechanism.is_empty() {
                let caption = "How the structure begins to fall. Dashed: the blocks before they move.";
                kinds.push((Kind::Mechanism, caption));
            }
            let caption = if frame_analysis.failures.is_empty() {
                "The forces on every block."
            } else {
                "The forces on every block; missing forces have the colour of failures."
            };
            kinds.push((Kind::Forces, caption));
        }
        verdict => {
            let has_flow = !frame_analysis.contacts.is_empty() && verdict != Verdict::Undecided;
            kinds.push(if has_flow {
                (Kind::Flow, "How the forces run from joint to joint.")
            } else {
                (Kind::Forces, "The forces on every block.")
            });
            if verdict_text::toward(frame_analysis).is_some() {
                let caption = "How the structure would fall just beyond its margin.";
                kinds.push((Kind::Margin, caption));
            }
            if frame_analysis.movements.iter().any(|m| matches!(m.outcome, MovementOutcome::Follows(_))) {
                kinds.push((Kind::Movement, "How the structure cracks as its support moves, enlarged."));
            }
        }
    }
    kinds
}

/// Describes where the frame fails or would fail first, and what would change its verdict.
fn failure_description(analysis: &Analysis, number: usize) -> Vec<SheetPart> {
    let (scene, frame_analysis) = (&analysis.scene, &analysis.frames[number]);
    let column = |heading: &str, words: Vec<String>| {
        let words = words.into_iter().map(SheetPart::Text);
        [SheetPart::Heading(heading.to_owned())].into_iter().chain(words).collect::<Vec<_>>()
    };
    let first: Vec<String> = verdict_text::fails_first(analysis, number).into_iter().collect();
    let take = verdict_text::changes_of_verdict(scene, frame_analysis);
    let take = if take.is_empty() { take } else { vec![take.join(" ")] };
    let heading = match frame_analysis.verdict {
        Verdict::Unstable => "Where the structure fails",
        _ => "Where the structure would fail first",
    };
    let mut columns = Vec::new();
    if !first.is_empty() {
        columns.push(column(heading, first));
    }
    if !take.is_empty() {
        columns.push(column("What it would take", take));
    }
    if columns.is_empty() { Vec::new() } else { vec![SheetPart::Columns(columns)] }
}

/// Makes two columns with the inputs of the frame with index `number`.
fn given(scene: &Scene, number: usize, units: Units) -> SheetPart {
    let titled = |heading: &str, grid: Grid| {
        if grid.lines.is_empty() {
            Vec::new()
        } else {
            vec![SheetPart::Heading(heading.to_owned()), SheetPart::Table(grid)]
        }
    };
    let mut left = titled("Materials", inputs::materials(scene, number, units));
    left.extend(titled("Loads", inputs::loads(scene, number, units)));
    left.extend(titled("Robots", inputs::robots(scene, number, units)));
    SheetPart::Columns(vec![left, titled("Supports and settings", inputs::facts(scene, number, units))])
}

fn margins(scene: &Scene, frame_analysis: &FrameAnalysis) -> Vec<SheetPart> {
    let mut grid = Grid::new("", &["margin", "bar", "in words"]);
    for bar in bullet::margin_bars(scene, frame_analysis) {
        let words = bar.words.clone();
        grid.add("", [TableCell::from(bar.name.clone()), TableCell::bar(bar), words.into()]);
    }
    if grid.lines.is_empty() {
        return Vec::new();
    }
    let notes = frame_analysis.margins.iter().flat_map(|margins| &margins.intervals.notes);
    let mut parts = vec![SheetPart::Heading("Margins".to_owned()), SheetPart::Table(grid)];
    parts.push(SheetPart::Note(bullet::SHAPES_LEGEND.to_owned()));
    parts.extend(notes.map(|note| SheetPart::Note(line(&format!("Note: {note}.")))));
    parts
}

/// Returns the table of the movements of supports, if there are any.
fn movements(scene: &Scene, frame_analysis: &FrameAnalysis) -> Vec<SheetPart> {
    if frame_analysis.movements.is_empty() {
        return Vec::new();
    }
    let mut grid = Grid::new("", &["if", "force on the support", "joints that open most"]);
    for moved in &frame_analysis.movements {
        let [force, joints] = match &moved.outcome {
            MovementOutcome::Follows(cracked) => {
                [movement::force(scene, cracked), movement::cracks(scene, frame_analysis, cracked)]
            }
            other => [String::new(), movement::without_state(other).to_owned()],
        };
        grid.add("", [movement::movement(scene, moved), force, joints].map(|words| line(&words)));
    }
    let note = "Of all forces that balance the structure, those whose force on the support does least work on the \
                movement (H to the right, V upwards). Small displacements, per millimetre of the movement; a joint that \
                slides also opens, by μ times the slip.";
    let heading = SheetPart::Heading("Movements of supports".to_owned());
    vec![heading, SheetPart::Table(grid), SheetPart::Note(note.to_owned())]
}

fn assumptions(scene: &Scene, frame_analysis: &FrameAnalysis) -> String {
    let frames = match scene.frames.len() {
        1 => "settlement, time, impact, earthquakes and the order of construction",
        _ => "settlement, time, impact and earthquakes",
    };
    let least = match (frame_analysis.verdict, frame_analysis.least_force) {
        (Verdict::Stable, true) => " Other balances of forces may exist; the one shown has the least sum of forces.",
        (Verdict::Stable, false) => {
            " Other balances of forces may exist; it was not proved that the one shown has the least sum of forces."
        }
        _ => "",
    };
    format!(
        "Rigid blocks in one plane, at rest, laid dry: joints transmit compression and friction, but no tension; friction \
         follows Coulomb's law with one coefficient μ. Not considered: the strength of the stone, {frames}.{least}"
    )
}

/// Returns the remarks at the end of the main section. They are the placement tolerance, the blocks that may leave, the result of the test for
/// wedging, if the test was made and did not show that the structure stands without wedging, and the notices of the
/// analysis.
fn remarks(scene: &Scene, frame_analysis: &FrameAnalysis) -> Vec<String> {
    let placement = frame_analysis.placement.as_ref();
    let placement = placement.map(|p| format!("Placement: {}.", line(&placement::sentence(scene, frame_analysis, p))));
    let rows = frame_analysis.removable.iter();
    let rows = rows.map(|rows| format!("Removable: {}.", line(&removable::phrases(scene, rows).join("; "))));
    let wedging = frame_analysis
        .effects
        .iter()
        .find(|e| e.effect == EffectName::Wedging && e.simulated)
        .filter(|_| frame_analysis.only_by_wedging != Some(false));
    let wedging = wedging.map(|w| format!("Wedging: {}.", line(&w.why)));
    let notices = frame_analysis.notices.iter().map(|n| format!("Note: {}.", line(n)));
    placement.into_iter().chain(rows).chain(wedging).chain(notices).collect()
}
