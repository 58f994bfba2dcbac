//! [`compared`]: makes the report entry that compares two scenes.
//!
//! 1. Steps are paired by their order, blocks by their ids, and interfaces by their two bodies. Of several interfaces
//!    between the same bodies, those at the same place are paired, and the others are paired by their order.
//! 2. A force counts as changed if its difference between the scenes is more than 5 % of the larger of the two forces.
//! 3. Numbers in tables are in the units of the scenes. If the scenes have different units, these numbers are in metres
//!    and newtons, except margins, and a note says so.
//! 4. Both figures mark changed forces, changed blocks (outline, position, weight, friction, loads, robots), and blocks
//!    that only one scene has.

mod force;
mod mark;
mod number;
mod setting;
mod shape;

use super::row::file_name;
use super::sheet;
use super::{Entry, Figure, File, ReportOptions, Row, Section, SheetPart};
use crate::geometry::Point;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, Verdict};
use crate::mechanics::scene::format::UnitsEntry;
use crate::pictures::drawing::Drawing;
use crate::products::figure::{self, Kind, count_in_words};
use crate::products::wording::number::{counted, letter};
use crate::products::wording::verdict::{self, plain};
use crate::text::line;
use force::SharedForces;
use mark::mark;
use number::{margins, totals};
use setting::Settings;
use shape::Shapes;

/// One of the two scenes of a comparison.
#[derive(Clone, Copy, Debug)]
pub struct Side<'s> {
    /// The scene file.
    pub file: File<'s>,
    /// The analysis of the scene.
    pub analysis: &'s Analysis,
}

/// Makes the content of a report that compares two scenes. `sides` has the first scene, then the second.
pub fn compared(sides: [Side<'_>; 2], report_options: &ReportOptions) -> Entry {
    let [was, is] = sides;
    let (stated, sections) = steps(sides, report_options);
    let mut row = Row::new(is.file.name, is.analysis);
    row.before = Some(was.analysis.verdict());
    let names = sides.map(|side| line(side.file.name));
    let titles = sides.map(|side| match side.analysis.scene.title.trim() {
        "" => file_name(side.file.name),
        title => line(title),
    });
    row.title = if titles[0] == titles[1] { titles[1].clone() } else { format!("{} → {}", titles[0], titles[1]) };
    row.name = format!("{} → {}", names[0], names[1]);
    row.fails = stated.first().cloned().unwrap_or_default();
    let commands = sides.map(|side| super::commands(side.file.name, side.analysis, report_options));
    let origins = sides.map(|side| super::hash(side.file.text));
    Entry {
        row,
        details: Vec::new(),
        sections,
        origin: format!("drystone {}, scenes {}", env!("CARGO_PKG_VERSION"), origins.join(" and ")),
        commands: commands.concat(),
        source: String::new(),
        results: sides.map(|side| super::result(side.file.name, side.analysis, report_options.timing)).to_vec(),
        changes: stated,
    }
}

/// Compares the steps of the two scenes in their order. Returns one sentence for each step, and the sections of the
/// report.
fn steps(sides: [Side<'_>; 2], report_options: &ReportOptions) -> (Vec<String>, Vec<Section>) {
    let [was, is] = sides;
    let options = sheet::options(report_options);
    let mut figures = sides.map(|side| {
        let panels = figure::panels(side.analysis, Kind::Forces, &options);
        panels.into_iter().map(Some).collect::<Vec<_>>()
    });
    let counts = sides.map(|side| side.analysis.frames.len());
    let mut sections = Vec::new();
    if counts[0] != counts[1] {
        let [a, b] = counts.map(|n| counted(n, "step"));
        let words = format!("The first has {a}, the second {b}; steps are compared in their order.");
        sections.push(note(is, words));
    }
    if common_units(sides).is_none() {
        let words = "The two scenes have different units. The tables that compare them are in metres and newtons; \
                     figures, sentences and margins are in the units of their scene.";
        sections.push(note(is, words.to_owned()));
    }
    let mut stated = Vec::new();
    let several = counts[0].max(counts[1]) > 1;
    for number in 0..counts[0].max(counts[1]) {
        let drawn = [0, 1].map(|side: usize| figures[side].get_mut(number).and_then(Option::take));
        let (sentence, mut section) = match drawn {
            [Some(a), Some(b)] => both([was, is], number, [a, b], report_options),
            [a, b] => {
                let (side, drawing) = if a.is_some() { (was, a) } else { (is, b) };
                unpaired_step(side, number, drawing, only_in(counts, number))
            }
        };
        // Set the letter here: `sheet::empty` considers only one scene, but letters are needed if either scene has
        // several steps.
        section.letter = if several { letter(number) } else { String::new() };
        stated.push(sentence);
        sections.push(section);
    }
    (stated, sections)
}

/// Makes a section without a title, which contains only a note with the text `words`.
fn note(side: Side<'_>, words: String) -> Section {
    let mut section = sheet::empty(&side.analysis.scene, 0, side.analysis.verdict());
    (section.letter, section.title) = (String::new(), String::new());
    section.parts.push(SheetPart::Note(words));
    section
}

/// Returns the units of both scenes, or `None` if the units of the two scenes differ.
fn common_units(sides: [Side<'_>; 2]) -> Option<UnitsEntry> {
    let [was, is] = sides.map(|side| side.analysis.scene.units);
    let sizes = [was, is].map(|units| [units.length().size, units.force().size]);
    (sizes[0] == sizes[1]).then_some(is)
}

/// Makes the figure of one scene. Its caption has the path of the scene file and the verdict.
fn plate(side: Side<'_>, frame_analysis: &FrameAnalysis, drawing: Drawing) -> Figure {
    let scale = "this figure has its own scales for arrows and colours";
    let name = line(side.file.name);
    Figure {
        caption: format!("{name}: {}; {scale}.", plain(frame_analysis.verdict)),
        drawing,
        dark: None,
        touches: Vec::new(),
        subject: None,
    }
}

fn only_in(counts: [usize; 2], number: usize) -> &'static str {
    if number < counts[0] { "Only the first scene has this step." } else { "Only the second scene has this step." }
}

/// Makes the sentence and the report section for a step that only one scene has. `why` is the sentence, which states
/// which scene has the step.
fn unpaired_step(side: Side<'_>, number: usize, drawing: Option<Drawing>, why: &str) -> (String, Section) {
    let (scene, frame_analysis) = (&side.analysis.scene, &side.analysis.frames[number]);
    let mut section = sheet::empty(scene, number, frame_analysis.verdict);
    section.parts.push(SheetPart::Text(why.to_owned()));
    let figures = drawing.map(|d| plate(side, frame_analysis, d)).into_iter();
    section.parts.push(SheetPart::Figures(figures.collect()));
    (why.to_owned(), section)
}

/// Compares a step that both scenes have. Returns a sentence about the changes, and the report section for the step.
fn both(
    sides: [Side<'_>; 2],
    number: usize,
    drawings: [Drawing; 2],
    report_options: &ReportOptions,
) -> (String, Section) {
    let [was, is] = sides;
    let [then, now] = sides.map(|side| &side.analysis.frames[number]);
    let units = common_units(sides).unwrap_or_default();
    let shape = Shapes::new(sides, number, units);
    let forces = SharedForces::new(sides, number);
    let settings = Settings::new(sides, number, units);
    let sentence = changes_sentence([then, now], &shape, &settings, &forces);
    let sentence = format!("{}.", capital(&line(&sentence)));
    let mut section = sheet::empty(&is.analysis.scene, number, now.verdict);
    section.parts.push(SheetPart::Text(sentence.clone()));
    for (side, frame_analysis, scene) in [("First", then, &was.analysis.scene), ("Second", now, &is.analysis.scene)] {
        let described = line(&verdict::sentence(scene, frame_analysis));
        section.parts.push(SheetPart::Note(format!("{side}: {described}")));
    }
    let grids = [
        totals(then, now, units),
        margins(sides, number),
        shape.grid(),
        settings.grid(),
        forces.grid(&is.analysis.scene, units),
    ];
    let colour = report_options.theme.motion;
    let [loaded, now_loaded] = settings.blocks;
    let outlines = [[shape.gone_or_changed, loaded].concat(), [shape.new_or_changed, now_loaded].concat()];
    let rings = [0, 1].map(|side: usize| {
        let changed = forces.changed();
        changed.map(|f| f.contacts[side].resultant.at).collect::<Vec<Point>>()
    });
    let mut plates = Vec::new();
    for (side, (frame_analysis, mut drawing)) in [then, now].into_iter().zip(drawings).enumerate() {
        let scene = &sides[side].analysis.scene;
        mark(&mut drawing, scene, &outlines[side], &rings[side], colour);
        plates.push(plate(sides[side], frame_analysis, drawing));
    }
    if let Some(last) = plates.last_mut() {
        last.caption.push_str(
            " Outlined in both: blocks that only one has, or whose outline, place, weight, friction, load or robot \
             differs; ringed: forces that changed by over 5 %.",
        );
    }
    section.parts.push(SheetPart::Figures(plates));
    section.parts.extend(grids.map(SheetPart::Table));
    (sentence, section)
}

/// Returns one sentence, without a full stop, with the two verdicts and all changes of a step.
fn changes_sentence(
    [then, now]: [&FrameAnalysis; 2],
    shape: &Shapes,
    settings: &Settings,
    forces: &SharedForces<'_>,
) -> String {
    let mut stated = vec![match (then.verdict, now.verdict) {
        (Verdict::Stable, Verdict::Stable) => "both stand".to_owned(),
        (Verdict::Unstable, Verdict::Unstable) => "both fall".to_owned(),
        (Verdict::Undecided, Verdict::Undecided) => "both are undecided".to_owned(),
        (a, b) => format!("the first {}, the second {}", verb(a), verb(b)),
    }];
    let mut differs = shape.stated();
    if differs.is_empty() {
        differs.push("the blocks and their places are the same".into());
    }
    stated.extend(differs);
    stated.extend(settings.stated());
    stated.push(count_in_words(forces.changed().count(), forces.all.len()));
    stated.join("; ")
}

/// Returns the verb for a verdict in a sentence: `stands`, `falls`, `is undecided`.
fn verb(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Undecided => "is undecided",
        decided => plain(decided),
    }
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
