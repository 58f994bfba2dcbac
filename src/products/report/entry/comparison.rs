//! [`compared`]: makes the report entry that compares two scenes.
//!
//! 1. Steps are paired by their order, blocks by their ids, and interfaces by their bodies and their order between these.
//! 2. A force counts as changed if it differs by more than 5 % of the larger one.
//! 3. Changed blocks (outline, place, weight, friction, loads, robots) and changed forces are marked in both figures.

mod setting;
mod shape;

use std::collections::BTreeMap;

use super::bullet;
use super::row::file_name;
use super::sheet;
use super::touch::onto_scene;
use super::{Entry, Figure, File, Grid, ReportOptions, Row, Section, SheetPart};
use crate::analysis::{Analysis, Contact, FrameAnalysis, Verdict};
use crate::drawing::{Camera, Colour, Drawing, Group, Outline, PagePoint, Path, Stroke};
use crate::figure::{self, Kind};
use crate::geometry::Point;
use crate::scene::Scene;
use crate::text::line;
use crate::wording::failure::pair;
use crate::wording::number::{counted, digits, letter, percent, tenths};
use crate::wording::verdict::{self, plain};
use setting::Settings;
use shape::Shapes;

/// Forces that differ by more than this share of the larger one count as changed.
const CHANGE_TOL: f64 = 0.05;
/// The smallest and largest radius of the ring around a changed force, in pixels.
const RING: (f64, f64) = (3.0, 9.0);

/// One of the two scenes of a comparison.
#[derive(Clone, Copy, Debug)]
pub struct Side<'s> {
    /// The scene file.
    pub file: File<'s>,
    /// Its analysis.
    pub analysis: &'s Analysis,
}

/// Makes the content of a report that compares two scenes: the first, then the second.
pub fn compared(sides: [Side<'_>; 2], wanted: &ReportOptions) -> Entry {
    let [was, is] = sides;
    let options = sheet::options(wanted);
    let mut figures = sides.map(|side| {
        let panels = figure::panels(side.analysis, Kind::Forces, &options);
        panels.into_iter().map(Some).collect::<Vec<_>>()
    });
    let counts = sides.map(|side| side.analysis.frames.len());
    let mut sections = Vec::new();
    if counts[0] != counts[1] {
        let [a, b] = counts.map(|n| counted(n, "step"));
        let words =
            format!("The first has {a}, the second {b}; steps are compared in their order.");
        let mut section = sheet::empty(&is.analysis.scene, 0, is.analysis.verdict());
        (section.letter, section.title) = (String::new(), String::new());
        section.parts.push(SheetPart::Note(words));
        sections.push(section);
    }
    let mut stated = Vec::new();
    let several = counts[0].max(counts[1]) > 1;
    for number in 0..counts[0].max(counts[1]) {
        let drawn = [0, 1].map(|side: usize| figures[side].get_mut(number).and_then(Option::take));
        let (sentence, mut section) = match drawn {
            [Some(a), Some(b)] => both([was, is], number, [a, b], wanted),
            [a, b] => {
                let (side, drawing) = if a.is_some() { (was, a) } else { (is, b) };
                alone(side, number, drawing, only_in(counts, number))
            }
        };
        // `sheet::empty` sees one scene only; letters are needed if either scene has several steps.
        section.letter = if several {
            letter(number)
        } else {
            String::new()
        };
        stated.push(sentence);
        sections.push(section);
    }
    let mut row = Row::new(is.file.name, is.analysis);
    row.before = Some(was.analysis.verdict());
    let names = sides.map(|side| line(side.file.name));
    let titles = sides.map(|side| match side.analysis.scene.title.trim() {
        "" => file_name(side.file.name),
        title => line(title),
    });
    row.title = if titles[0] == titles[1] {
        titles[1].clone()
    } else {
        format!("{} → {}", titles[0], titles[1])
    };
    row.name = format!("{} → {}", names[0], names[1]);
    row.fails = stated.first().cloned().unwrap_or_default();
    let commands = sides.map(|side| super::commands(side.file.name, side.analysis, wanted));
    let origins = sides.map(|side| super::hash(side.file.text));
    Entry {
        row,
        details: Vec::new(),
        sections,
        origin: format!(
            "drystone {}, scenes {}",
            env!("CARGO_PKG_VERSION"),
            origins.join(" and ")
        ),
        commands: commands.concat(),
        source: String::new(),
        results: sides
            .map(|side| super::result(side.file.name, side.analysis, wanted.timing))
            .to_vec(),
        changes: stated,
    }
}

fn only_in(counts: [usize; 2], number: usize) -> &'static str {
    if number < counts[0] {
        "Only the first scene has this step."
    } else {
        "Only the second scene has this step."
    }
}

/// Describes a step that only one of the scenes has: its sentence `why`, and its section.
fn alone(side: Side<'_>, number: usize, drawing: Option<Drawing>, why: &str) -> (String, Section) {
    let (scene, found) = (&side.analysis.scene, &side.analysis.frames[number]);
    let mut section = sheet::empty(scene, number, found.verdict);
    section.parts.push(SheetPart::Text(why.to_owned()));
    let figures = drawing.map(|d| plate(side, found, d)).into_iter();
    section.parts.push(SheetPart::Figures(figures.collect()));
    (why.to_owned(), section)
}

fn plate(side: Side<'_>, found: &FrameAnalysis, drawing: Drawing) -> Figure {
    let scale = "the scales of arrows and colours are those of this figure only";
    let name = line(side.file.name);
    Figure {
        caption: format!("{name}: {}; {scale}.", plain(found.verdict)),
        drawing,
        dark: None,
        touches: Vec::new(),
    }
}

/// Compares a step that both scenes have: a sentence about the changes, and the section.
fn both(
    sides: [Side<'_>; 2],
    number: usize,
    drawings: [Drawing; 2],
    wanted: &ReportOptions,
) -> (String, Section) {
    let [was, is] = sides;
    let [then, now] = sides.map(|side| &side.analysis.frames[number]);
    let shape = Shapes::new(sides, number);
    let forces = forces(sides, number);
    let settings = Settings::new(sides, number);
    let sentence = changes_sentence([then, now], &shape, &settings, &forces);
    let sentence = format!("{}.", capital(&line(&sentence)));
    let mut section = sheet::empty(&is.analysis.scene, number, now.verdict);
    section.parts.push(SheetPart::Text(sentence.clone()));
    for (side, found, scene) in [
        ("First", then, &was.analysis.scene),
        ("Second", now, &is.analysis.scene),
    ] {
        let described = line(&verdict::sentence(scene, found));
        section
            .parts
            .push(SheetPart::Note(format!("{side}: {described}")));
    }
    let grids = [
        totals(then, now),
        margins(sides, number),
        shape.grid(),
        settings.grid(),
        grid(&is.analysis.scene, &forces),
    ];
    let colour = wanted.theme.motion;
    let [loaded, now_loaded] = settings.blocks;
    let outlines = [
        [shape.gone_or_changed, loaded].concat(),
        [shape.new_or_changed, now_loaded].concat(),
    ];
    let rings = [0, 1].map(|side: usize| {
        let changed = forces.iter().filter(|f| f.changed());
        changed.map(|f| f.at[side]).collect::<Vec<Point>>()
    });
    let mut plates = Vec::new();
    for (side, (found, mut drawing)) in [then, now].into_iter().zip(drawings).enumerate() {
        let scene = &sides[side].analysis.scene;
        mark(&mut drawing, scene, &outlines[side], &rings[side], colour);
        plates.push(plate(sides[side], found, drawing));
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

/// Returns a sentence about both verdicts and all changes of a step, without a full stop.
fn changes_sentence(
    [then, now]: [&FrameAnalysis; 2],
    shape: &Shapes,
    settings: &Settings,
    forces: &[SharedForce],
) -> String {
    let mut stated = vec![match (then.verdict, now.verdict) {
        (Verdict::Stable, Verdict::Stable) => "both stand".to_owned(),
        (Verdict::Unstable, Verdict::Unstable) => "both fall".to_owned(),
        (Verdict::Undecided, Verdict::Undecided) => "both are undecided".to_owned(),
        (a, b) => format!("the first {}, the second {}", verb(a), verb(b)),
    }];
    let mut differs = shape.stated();
    if differs.is_empty() {
        differs.push("the same blocks in the same places".into());
    }
    stated.extend(differs);
    stated.extend(settings.stated());
    stated.push(match forces.iter().filter(|f| f.changed()).count() {
        _ if forces.is_empty() => "no interface that both have".to_owned(),
        0 => "no force changed by over 5 %".to_owned(),
        n => format!(
            "{n} of {} changed by over 5 %",
            counted(forces.len(), "shared force")
        ),
    });
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

/// The forces of both frames at the same interface.
struct SharedForce {
    between: [crate::scene::BodyId; 2],
    amounts: [f64; 2],
    difference: f64,
    noise: f64,
    at: [Point; 2],
}

impl SharedForce {
    fn changed(&self) -> bool {
        let larger = self.amounts[0].max(self.amounts[1]);
        larger > self.noise && self.difference > CHANGE_TOL * larger
    }
}

/// Pairs the interfaces of both frames by the names of their bodies. Several interfaces between two bodies are paired
/// by their order.
fn forces(sides: [Side<'_>; 2], number: usize) -> Vec<SharedForce> {
    let key = |scene: &Scene, contact: &Contact| {
        contact.interface.bodies.map(|b| scene.name(b).to_owned())
    };
    let [was, is] = sides.map(|side| (&side.analysis.scene, &side.analysis.frames[number]));
    let mut before: BTreeMap<[String; 2], Vec<&Contact>> = BTreeMap::new();
    for contact in &was.1.contacts {
        before.entry(key(was.0, contact)).or_default().push(contact);
    }
    let sizes = was.1.contacts.iter().chain(&is.1.contacts);
    // Forces below a millionth of the largest force are rounding errors of the solver.
    let noise = 1e-6 * sizes.map(|c| c.resultant.force.norm()).fold(0.0, f64::max);
    let mut taken: BTreeMap<[String; 2], usize> = BTreeMap::new();
    let mut shared = Vec::new();
    for contact in &is.1.contacts {
        let key = key(is.0, contact);
        let turn = taken.entry(key.clone()).or_default();
        let Some(then) = before.get(&key).and_then(|list| list.get(*turn)) else {
            continue;
        };
        *turn += 1;
        shared.push(SharedForce {
            between: contact.interface.bodies,
            amounts: [then, contact].map(|c| c.resultant.force.norm()),
            difference: (contact.resultant.force - then.resultant.force).norm(),
            noise,
            at: [then, contact].map(|c| c.resultant.at),
        });
    }
    shared
}

fn change(before: f64, after: f64) -> String {
    if (after - before).abs() <= 1e-9 * before.abs() {
        return "none".to_owned();
    }
    if before == 0.0 {
        return "from nothing".to_owned();
    }
    let sign = if after < before { "−" } else { "+" };
    match (after / before - 1.0).abs() {
        little if little < 0.0005 => format!("{sign}under 0.1 %"),
        share => format!("{sign}{}", tenths(share)),
    }
}

fn totals(then: &FrameAnalysis, now: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new("In numbers", &["what", "#first", "#second", "#change"]);
    let largest = |f: &FrameAnalysis| {
        let forces = f.contacts.iter().map(|c| c.resultant.force.norm());
        forces.fold(0.0, f64::max)
    };
    for (what, a, b) in [
        ("weight of all blocks, N", then.weight, now.weight),
        ("total force, N", then.total_force, now.total_force),
        ("total sticking, N", then.total_sticking, now.total_sticking),
        (
            "largest force at an interface, N",
            largest(then),
            largest(now),
        ),
    ] {
        grid.add("", [what.to_owned(), digits(a), digits(b), change(a, b)]);
    }
    grid
}

fn margins(sides: [Side<'_>; 2], number: usize) -> Grid {
    let mut grid = Grid::new("Margins", &["margin", "first", "second"]);
    let [first, second] =
        sides.map(|side| bullet::margin_bars(&side.analysis.scene, &side.analysis.frames[number]));
    for bullet in &first {
        let same = second.iter().find(|b| b.name == bullet.name);
        let after = same.map_or("–".to_owned(), |b| b.words.clone());
        grid.add("", [bullet.name.clone(), bullet.words.clone(), after]);
    }
    for bullet in second
        .iter()
        .filter(|b| first.iter().all(|a| a.name != b.name))
    {
        grid.add(
            "",
            [bullet.name.clone(), "–".to_owned(), bullet.words.clone()],
        );
    }
    grid
}

fn grid(scene: &Scene, forces: &[SharedForce]) -> Grid {
    let mut grid = Grid::new(
        "Forces that changed by over 5 %",
        &[
            "between",
            "#first, N",
            "#second, N",
            "#change of the amount",
            "#change as a vector, relative to the larger",
        ],
    );
    for force in forces.iter().filter(|f| f.changed()) {
        let [a, b] = force.amounts;
        let cells = [
            line(&pair(scene, force.between)),
            digits(a),
            digits(b),
            change(a, b),
            percent(force.difference / a.max(b)),
        ];
        grid.add("", cells);
    }
    grid
}

/// Returns the radius of the rings in pixels: smaller if many rings would overlap.
fn radius(places: &[PagePoint]) -> f64 {
    let (least, most) = RING;
    let span = |of: fn(&PagePoint) -> f64| {
        let (low, high) = places
            .iter()
            .map(of)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
        (high - low).max(0.0)
    };
    let (width, height) = (span(|p| p.x), span(|p| p.y));
    let count = places.len() as f64;
    // The mean distance of the rings if they were spread evenly over their bounding box, or along a line.
    let apart = f64::max(
        libm::sqrt(width * height / count),
        width.max(height) / count,
    );
    match places.len() {
        0 | 1 => most,
        _ => (0.3 * apart).clamp(least, most),
    }
}

/// Marks blocks with an outline and points with a ring in a drawing of the scene. `blocks` are numbers of blocks;
/// `rings` are in metres.
fn mark(drawing: &mut Drawing, scene: &Scene, blocks: &[usize], rings: &[Point], colour: Colour) {
    if blocks.is_empty() && rings.is_empty() {
        return;
    }
    let marks = |camera: &Camera| {
        let mut outline = Outline::default();
        for block in blocks {
            outline.extend(camera.polygon(&scene.blocks[*block].body.polygon));
        }
        let mut group = Group {
            echo: true,
            ..Group::with_class("changed")
        };
        if !outline.segments.is_empty() {
            group = group.with(Path::stroked(outline, Stroke::new(colour, 3.0)));
        }
        let places: Vec<PagePoint> = rings.iter().map(|at| camera.place(*at)).collect();
        let radius = radius(&places);
        for at in places {
            let circle = Outline::circle(at, radius);
            group = group.with(Path::stroked(circle, Stroke::new(colour, 1.8)));
        }
        group
    };
    onto_scene(drawing, &marks);
}
