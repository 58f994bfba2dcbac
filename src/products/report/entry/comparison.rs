//! [`compared`]: makes the report entry that compares two scenes.
//!
//! 1. Steps are paired by their order, blocks by their ids, and interfaces by their two bodies. Of several interfaces
//!    between the same bodies, those at the same place are paired, and the others are paired by their order.
//! 2. A force counts as changed if its difference between the scenes is more than 5 % of the larger of the two forces.
//! 3. Numbers in tables are in the units of the scenes. If the scenes have different units, these numbers are in metres
//!    and newtons, except margins, and a note says so.
//! 4. The first page is about the step that matters most, see [`governing`], and lists what differs between the scenes.
//!    Of the other steps, only those that differ have figures.
//! 5. Both figures mark changed forces, changed blocks (outline, position, weight, friction, loads, robots), and blocks
//!    that only one scene has.

mod difference;

use difference::{Settings, Shapes};

use super::hover::onto_scene;
use super::part::FigureCount;
use super::row::file_name;
use super::{Entry, Figure, File, Grid, ReportOptions, Row, Section, SheetPart, bullet, sheet};
use crate::geometry::{Point, range_of};
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, Verdict};
use crate::mechanics::scene::Scene;
use crate::mechanics::scene::format::UnitsEntry;
use crate::pictures::drawing::{Camera, Colour, Drawing, Group, Outline, PagePoint, Path, Stroke};
use crate::products::figure::{self, ForceChange, Kind, count_in_words, noise, shared_forces};
use crate::products::wording::failure::pair;
use crate::products::wording::margin::headline;
use crate::products::wording::number::{counted, digits, letter, listed, percent, tenths};
use crate::products::wording::verdict;
use crate::text::{capitalised, line};

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
    let titles = sides.map(|side| match side.analysis.given().title.trim() {
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
/// report: first the step that matters most, with all that differs between the scenes, then the other steps that differ.
fn steps(sides: [Side<'_>; 2], report_options: &ReportOptions) -> (Vec<String>, Vec<Section>) {
    let [was, is] = sides;
    let options = sheet::options(report_options);
    let counts = sides.map(|side| side.analysis.frames.len());
    let mut notes = Vec::new();
    if counts[0] != counts[1] {
        let [a, b] = counts.map(|n| counted(n, "step"));
        notes.push(format!("The first has {a}, the second {b}; steps are compared in their order."));
    }
    if common_units(sides).is_none() {
        let words = "The two scenes have different units. The tables that compare them are in metres and newtons; \
                     figures, sentences and margins are in the units of their scene.";
        notes.push(words.to_owned());
    }
    let pairs: Vec<Pair<'_>> = (0..counts[0].min(counts[1])).map(|number| Pair::new(sides, number)).collect();
    let mut stated: Vec<String> = pairs.iter().map(Pair::sentence).collect();
    let governing = governing(&pairs);
    let several = counts[0].max(counts[1]) > 1;
    let shown = pairs.iter().filter(|pair| pair.differs() && pair.number != governing).map(|pair| pair.number);
    let shown: Vec<usize> = [governing].into_iter().chain(shown).collect();
    let drawn = sides.map(|side| figure::panels_of(side.analysis, Kind::Forces, &options, &shown));
    let [before, after] = drawn.map(Vec::into_iter);
    let mut sections = Vec::new();
    for ((number, a), b) in shown.iter().zip(before).zip(after) {
        let pair = &pairs[*number];
        let mut section = sheet::empty(is.analysis.given(), *number, pair.frames[1].verdict);
        section.parts.push(SheetPart::Text(pair.sentence()));
        let is_first = *number == governing;
        if is_first {
            section.parts.extend(notes.drain(..).map(SheetPart::Note));
        }
        section.parts.extend(pair.parts([a, b], is_first, report_options));
        if is_first && several {
            section.parts.push(SheetPart::Table(table(&pairs)));
        }
        section.parts.push(SheetPart::Table(pair.forces.grid(is.analysis.given(), pair.units)));
        sections.push(section);
    }
    for number in counts[0].min(counts[1])..counts[0].max(counts[1]) {
        let (side, why) = if number < counts[0] {
            (was, "Only the first scene has this step.")
        } else {
            (is, "Only the second scene has this step.")
        };
        let found = &side.analysis.frames[number];
        let drawings = figure::panels_of(side.analysis, Kind::Forces, &options, &[number]);
        let figures = drawings.into_iter().map(|drawing| plate(side, found, drawing)).collect();
        let mut section = sheet::empty(side.analysis.given(), number, found.verdict);
        section.parts = vec![SheetPart::Text(why.to_owned()), SheetPart::Figures(figures)];
        stated.push(why.to_owned());
        sections.push(section);
    }
    for section in &mut sections {
        // `sheet::empty` considers only one scene, but letters are needed if either scene has several steps.
        let number = section.letter.clone();
        section.letter = if several { number } else { String::new() };
    }
    let mut count = FigureCount::default();
    sections.iter_mut().for_each(|section| count.number_parts(&mut section.parts));
    (stated, sections)
}

/// Returns the index of the step that matters most: the first whose verdict differs, otherwise the first that does not
/// stand, otherwise the last that differs.
fn governing(pairs: &[Pair<'_>]) -> usize {
    let verdicts = |pair: &Pair<'_>| pair.frames.map(|frame| frame.verdict);
    let changed = pairs.iter().find(|pair| verdicts(pair)[0] != verdicts(pair)[1]);
    let falls = || pairs.iter().find(|pair| verdicts(pair)[1] != Verdict::Stable);
    let last = || pairs.iter().rev().find(|pair| pair.differs());
    changed.or_else(falls).or_else(last).map_or(pairs.len() - 1, |pair| pair.number)
}

/// Makes the table of all steps that both scenes have.
fn table(pairs: &[Pair<'_>]) -> Grid {
    let mut grid = Grid::new("All steps", &["step", "first", "second", "what differs"]);
    for pair in pairs {
        let title = pair.sides[1].analysis.given().frames[pair.number].title.as_str();
        let verdict = |side: usize| {
            let words = headline(pair.sides[side].analysis.at(pair.number));
            let verdict = pair.frames[side].verdict.plain();
            if words.is_empty() { verdict.to_owned() } else { words }
        };
        let differs = match pair.sentence().split_once("; ") {
            Some((_, differs)) if pair.differs() => capitalised(differs),
            _ => "Nothing.".to_owned(),
        };
        let title = line(&format!("({}) {title}", letter(pair.number)));
        grid.add("", [title, line(&verdict(0)), line(&verdict(1)), differs]);
    }
    grid
}

/// Returns the units of both scenes, or `None` if the units of the two scenes differ.
fn common_units(sides: [Side<'_>; 2]) -> Option<UnitsEntry> {
    let [was, is] = sides.map(|side| side.analysis.given().units);
    let sizes = [was, is].map(|units| [units.length().size, units.force().size]);
    (sizes[0] == sizes[1]).then_some(is)
}

/// Makes the figure of one scene. Its caption has the path of the scene file, its changed values, and the verdict.
fn plate(side: Side<'_>, frame_analysis: &FrameAnalysis, drawing: Drawing) -> Figure {
    let set = &side.analysis.given().set;
    let with = if set.is_empty() { String::new() } else { format!(" with {}", listed(set)) };
    let name = line(&format!("{}{with}", file_name(side.file.name)));
    Figure {
        caption: format!("{name}: {}.", frame_analysis.verdict.plain()),
        drawing,
        dark: None,
        touches: Vec::new(),
        subject: None,
    }
}

/// A step that both scenes have.
struct Pair<'a> {
    sides: [Side<'a>; 2],
    /// The index of the step.
    number: usize,
    frames: [&'a FrameAnalysis; 2],
    units: UnitsEntry,
    shape: Shapes,
    settings: Settings,
    forces: SharedForces<'a>,
}

impl<'a> Pair<'a> {
    fn new(sides: [Side<'a>; 2], number: usize) -> Pair<'a> {
        let units = common_units(sides).unwrap_or_default();
        Pair {
            sides,
            number,
            frames: sides.map(|side| &*side.analysis.frames[number]),
            units,
            shape: Shapes::new(sides, Some(number), units),
            settings: Settings::new(sides, number, units),
            forces: SharedForces::new(sides, number),
        }
    }

    /// True if the inputs, the verdict or a force of the step differ.
    fn differs(&self) -> bool {
        self.frames[0].verdict != self.frames[1].verdict
            || !self.shape.stated().is_empty()
            || !self.settings.is_empty()
            || self.forces.changed().next().is_some()
    }

    /// Returns one sentence with the two verdicts and all changes.
    fn sentence(&self) -> String {
        let mut stated = vec![match self.frames.map(|frame| frame.verdict) {
            [Verdict::Stable, Verdict::Stable] => "both stand".to_owned(),
            [Verdict::Unstable, Verdict::Unstable] => "both fall".to_owned(),
            [Verdict::Undecided, Verdict::Undecided] => "both are undecided".to_owned(),
            [a, b] => format!("the first {}, the second {}", a.verb(), b.verb()),
        }];
        let mut differs = self.shape.stated();
        if differs.is_empty() {
            differs.push("the blocks and their places are the same".into());
        }
        stated.extend(differs);
        stated.extend(self.settings.stated());
        stated.push(count_in_words(self.forces.changed().count(), self.forces.all.len()));
        format!("{}.", capitalised(&line(&stated.join("; "))))
    }

    /// Returns the figures and tables of the step. On the first page of a report, `is_first`, the tables have all that
    /// differs between the two scenes.
    fn parts(&self, drawings: [Drawing; 2], is_first: bool, report_options: &ReportOptions) -> Vec<SheetPart> {
        let mut parts = Vec::new();
        for (which, side) in [("First", 0), ("Second", 1)] {
            // That a structure stands is in the sentence above.
            if self.frames[side].verdict != Verdict::Stable {
                let described = verdict::sentence(self.sides[side].analysis.at(self.number));
                parts.push(SheetPart::Note(format!("{which}: {}", line(&described))));
            }
        }
        parts.push(SheetPart::Figures(self.plates(drawings, report_options)));
        if !is_first {
            return parts;
        }
        let steps = self.sides.map(|side| side.analysis.frames.len());
        let mut settings = Settings::new(self.sides, self.number, self.units);
        for number in 0..steps[0].min(steps[1]) {
            settings.add(Settings::new(self.sides, number, self.units));
        }
        let [then, now] = self.frames;
        parts.extend(
            [
                Shapes::new(self.sides, None, self.units).grid(),
                settings.grid(),
                margins(self.sides, self.number),
                totals(then, now, self.units),
            ]
            .map(SheetPart::Table),
        );
        parts
    }

    /// Marks in both figures what differs.
    fn plates(&self, drawings: [Drawing; 2], report_options: &ReportOptions) -> Vec<Figure> {
        let colour = report_options.theme.motion;
        let [loaded, now_loaded] = &self.settings.blocks;
        let outlines =
            [[&self.shape.gone_or_changed[..], loaded].concat(), [&self.shape.new_or_changed[..], now_loaded].concat()];
        let mut plates = Vec::new();
        for (side, mut drawing) in drawings.into_iter().enumerate() {
            let rings = self.forces.changed().map(|f| f.contacts[side].resultant.at);
            let (scene, rings) = (self.sides[side].analysis.given(), rings.collect::<Vec<Point>>());
            // If every block differs, an outline around each says nothing.
            let all = outlines[side].len() >= scene.frames[self.number].placed.len();
            mark(&mut drawing, scene, if all { &[] } else { &outlines[side] }, &rings, colour);
            plates.push(plate(self.sides[side], self.frames[side], drawing));
        }
        if self.differs()
            && let Some(last) = plates.last_mut()
        {
            last.caption.push_str(
                " Each figure has its own scales for arrows and colours. Outlined in both: blocks that only one has, or \
                 whose outline, place, weight, friction, load or robot differs, unless all do; ringed: forces that \
                 changed by over 5 %.",
            );
        }
        plates
    }
}

/// The forces at the interfaces that both frames have.
struct SharedForces<'a> {
    /// One entry for each common interface, changed or not.
    pub all: Vec<ForceChange<'a>>,
    /// Forces of at most this magnitude, N, count as zero.
    noise: f64,
}

impl<'a> SharedForces<'a> {
    /// Pairs the interfaces of frame `number` (from 0) of the first analysis with those of the same frame of the second;
    /// see [`shared_forces`].
    pub fn new(sides: [Side<'a>; 2], number: usize) -> SharedForces<'a> {
        let [was, is] = sides.map(|side| {
            let analysis = side.analysis;
            (&**analysis.given(), &analysis.frames[number].contacts[..])
        });
        let all = shared_forces([was, is]);
        let forces = was.1.iter().chain(is.1);
        SharedForces { all, noise: noise(forces.map(Contact::amount)) }
    }

    /// Iterates over the forces that changed by more than 5 % of the larger force. Forces at the level of rounding
    /// errors are left out.
    pub fn changed(&self) -> impl Iterator<Item = &ForceChange<'a>> {
        self.all.iter().filter(|force| force.is_change(self.noise))
    }

    /// Makes the table of the forces that changed, in the given units. `scene` is the second scene.
    pub fn grid(&self, scene: &Scene, units: UnitsEntry) -> Grid {
        let unit = units.force();
        let heads = ["first", "second"].map(|which| format!("#{which}, {}", unit.symbol()));
        let mut grid = Grid::new(
            "Forces that changed by over 5 %",
            &[
                "between",
                &heads[0],
                &heads[1],
                "#change of the magnitude",
                "#magnitude of the vector change, relative to the larger force",
            ],
        );
        for force in self.changed() {
            let [a, b] = force.amounts();
            let cells = [
                line(&pair(scene, force.contacts[1].interface.bodies)),
                digits(unit.value_from_si(a)),
                digits(unit.value_from_si(b)),
                change(a, b),
                percent(force.difference() / force.larger()),
            ];
            grid.add("", cells);
        }
        grid
    }
}

/// Writes the change of a number relative to `before`, in percent, with its sign. The text is `none` if there is no
/// change except for rounding, and `from nothing` if `before` is 0 and `after` is not.
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

/// Makes a table that compares two frames by weight, total force, total sticking and largest force at an interface, in
/// the given units.
fn totals(then: &FrameAnalysis, now: &FrameAnalysis, units: UnitsEntry) -> Grid {
    let unit = units.force();
    let mut grid = Grid::new("In numbers", &["what", "#first", "#second", "#change"]);
    let largest = FrameAnalysis::largest_at_contacts;
    for (what, a, b) in [
        ("weight of all blocks", then.weight, now.weight),
        ("total force", then.total_force, now.total_force),
        ("total sticking", then.total_sticking, now.total_sticking),
        ("largest force at an interface", largest(then), largest(now)),
    ] {
        let [first, second] = [a, b].map(|force| digits(unit.value_from_si(force)));
        let what = format!("{what}, {}", unit.symbol());
        grid.add("", [what, first, second, change(a, b)]);
    }
    grid
}

/// Makes a table that compares the margins of two frames, with one row for each margin. `number` is the index of both
/// frames.
fn margins(sides: [Side<'_>; 2], number: usize) -> Grid {
    let mut grid = Grid::new("Margins", &["margin", "first", "second"]);
    let [first, second] = sides.map(|side| bullet::margin_bars(side.analysis.at(number)));
    for bullet in &first {
        let same = second.iter().find(|b| b.name == bullet.name);
        let after = same.map_or("–".to_owned(), |b| b.words.clone());
        grid.add("", [bullet.name.clone(), bullet.words.clone(), after]);
    }
    for bullet in second.iter().filter(|b| first.iter().all(|a| a.name != b.name)) {
        grid.add("", [bullet.name.clone(), "–".to_owned(), bullet.words.clone()]);
    }
    grid
}

/// The smallest and largest radius of the ring around a changed force, in pixels.
const RING_RADIUS_LIMITS: (f64, f64) = (3.0, 9.0);

/// Returns the radius of the rings in pixels. It is smaller if many rings would overlap. `places` has their centres.
fn radius(places: &[PagePoint]) -> f64 {
    let (least, most) = RING_RADIUS_LIMITS;
    let span = |of: fn(&PagePoint) -> f64| {
        let (low, high) = range_of(places.iter().map(of));
        (high - low).max(0.0)
    };
    let (width, height) = (span(|p| p.x), span(|p| p.y));
    let count = places.len() as f64;
    // Estimate the distance between neighbouring rings, as if they were spread evenly over their bounding box or
    // along a line.
    let apart = f64::max(libm::sqrt(width * height / count), width.max(height) / count);
    match places.len() {
        0 | 1 => most,
        _ => (0.3 * apart).clamp(least, most),
    }
}

/// Draws an outline around some blocks, and a ring around some points, in a drawing of the scene. `blocks` has the
/// indices of the blocks, and `rings` has the points in metres.
fn mark(drawing: &mut Drawing, scene: &Scene, blocks: &[usize], rings: &[Point], colour: Colour) {
    if blocks.is_empty() && rings.is_empty() {
        return;
    }
    let marks = |camera: &Camera| {
        let mut outline = Outline::default();
        for block in blocks {
            outline.extend(camera.polygon(&scene.blocks[*block].body.polygon));
        }
        let mut group = Group { echo: true, ..Group::with_class("changed") };
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
