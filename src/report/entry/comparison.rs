//! [`compared`]: two scenes side by side, and what changed from one to the other.
//!
//! Blocks are the same where their ids are, interfaces where their bodies are and they lie in one place; steps are compared
//! in their order. A force has changed where it differs by more than a twentieth of the larger one. What the second scene
//! has more or otherwise is marked in both figures.

use std::collections::BTreeMap;

use super::bullet;
use super::row::file_name;
use super::step::{self, Step};
use super::touch::onto_scene;
use super::{Entry, Figure, File, Grid, Row, Wanted};
use crate::analysis::{Analysis, Contact, FrameAnalysis, Verdict};
use crate::drawing::{Camera, Colour, Drawing, Group, Outline, Path, Stroke};
use crate::figure::{self, Kind};
use crate::geometry::Point;
use crate::scene::{Block, Scene};
use crate::text::line;
use crate::wording::failure::{pair, shortened};
use crate::wording::number::{counted, digits, letter, listed, tenths};
use crate::wording::verdict::{self, plain};

/// A force, a weight or a margin has changed where it differs by more than this share of the larger one.
const CHANGED: f64 = 0.05;
/// Corners differ where they lie farther apart than this share of the scene's reach.
const MOVED: f64 = 1e-6;
/// So many blocks are named.
const MOST_NAMED: usize = 6;
/// Radius of the ring around a changed force, pixels.
const RING: f64 = 9.0;

/// One of two scenes that are compared.
#[derive(Clone, Copy, Debug)]
pub struct Side<'s> {
    /// Its file.
    pub file: File<'s>,
    /// What was found out about it.
    pub analysis: &'s Analysis,
}

/// What a report tells of two scenes beside each other.
pub fn compared(sides: [Side<'_>; 2], wanted: &Wanted) -> Entry {
    let [was, is] = sides;
    let options = step::options(wanted);
    let mut figures = sides.map(|side| {
        let panels = figure::panels(side.analysis, Kind::Forces, &options);
        panels.into_iter().map(Some).collect::<Vec<_>>()
    });
    let counts = sides.map(|side| side.analysis.frames.len());
    let mut remarks = Vec::new();
    if counts[0] != counts[1] {
        let [a, b] = counts.map(|n| counted(n, "step"));
        remarks.push(format!(
            "The first has {a}, the second {b}; steps are compared in their order."
        ));
    }
    let mut steps = Vec::new();
    let mut stated = Vec::new();
    for number in 0..counts[0].max(counts[1]) {
        let drawn = [0, 1].map(|side: usize| figures[side].get_mut(number).and_then(Option::take));
        let step = match drawn {
            [Some(a), Some(b)] => both([was, is], number, [a, b], wanted),
            [a, b] => {
                let (side, drawing) = if a.is_some() { (was, a) } else { (is, b) };
                alone(side, number, drawing, only_in(counts, number))
            }
        };
        stated.push(step.sentence.clone());
        steps.push(step);
    }
    let mut row = Row::of(is.file.name, is.analysis);
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
    let entries = sides.map(|side| Entry {
        row: row.clone(),
        remarks: Vec::new(),
        steps: Vec::new(),
        charts: Vec::new(),
        study: None,
        commands: super::commands(side.file.name, side.analysis, wanted),
        source: String::new(),
        results: vec![super::result(side.file.name, side.analysis, wanted.timing)],
    });
    let [first, second] = entries;
    Entry {
        remarks,
        steps,
        commands: first.commands.into_iter().chain(second.commands).collect(),
        results: first.results.into_iter().chain(second.results).collect(),
        ..second
    }
}

fn only_in(counts: [usize; 2], number: usize) -> &'static str {
    if number < counts[0] {
        "Only the first scene has this step."
    } else {
        "Only the second scene has this step."
    }
}

/// A step that one of the two has not.
fn alone(side: Side<'_>, number: usize, drawing: Option<Drawing>, why: &str) -> Step {
    let (scene, found) = (&side.analysis.scene, &side.analysis.frames[number]);
    Step {
        plates: drawing.map(|d| plate(side, found, d)).into_iter().collect(),
        ..bare(scene, number, found.verdict, why.to_owned())
    }
}

fn bare(scene: &Scene, number: usize, verdict: Verdict, sentence: String) -> Step {
    let several = scene.frames.len() > 1;
    Step {
        letter: if several {
            letter(number)
        } else {
            String::new()
        },
        title: line(&scene.frames[number].title),
        verdict,
        sentence,
        remarks: Vec::new(),
        plates: Vec::new(),
        touches: Vec::new(),
        bullets: Vec::new(),
        charts: Vec::new(),
        grids: Vec::new(),
        proof: String::new(),
    }
}

fn plate(side: Side<'_>, found: &FrameAnalysis, drawing: Drawing) -> Figure {
    let scale = "arrows to its own scale";
    let name = line(side.file.name);
    Figure {
        caption: format!("{name}: {}; {scale}.", plain(found.verdict)),
        drawing,
    }
}

/// A step that both have.
fn both(sides: [Side<'_>; 2], number: usize, drawings: [Drawing; 2], wanted: &Wanted) -> Step {
    let [was, is] = sides;
    let [then, now] = sides.map(|side| &side.analysis.frames[number]);
    let shape = Shapes::of(sides, number);
    let forces = forces(sides, number);
    let mut stated = vec![match (then.verdict, now.verdict) {
        (a, b) if a == b => format!("both: {}", plain(a)),
        (a, b) => format!("first: {}; second: {}", plain(a), plain(b)),
    }];
    stated.extend(shape.stated());
    stated.push(match forces.iter().filter(|f| f.changed()).count() {
        0 => "no force changed by over 5 %".to_owned(),
        n => format!(
            "{n} of {} changed by over 5 %",
            counted(forces.len(), "shared force")
        ),
    });
    let sentence = stated.join("; ");
    let mut step = bare(
        &is.analysis.scene,
        number,
        now.verdict,
        format!("{}.", capital(&line(&sentence))),
    );
    for (side, found, scene) in [
        ("First", then, &was.analysis.scene),
        ("Second", now, &is.analysis.scene),
    ] {
        let described = line(&verdict::sentence(scene, found));
        step.remarks.push(format!("{side}: {described}"));
    }
    step.grids = [
        totals(then, now),
        margins(sides, number),
        shape.grid(),
        grid(&is.analysis.scene, &forces),
    ]
    .into_iter()
    .filter(|g| !g.lines.is_empty())
    .collect();
    let colour = wanted.theme.motion;
    let outlines = [&shape.gone_or_changed, &shape.new_or_changed];
    let rings = [0, 1].map(|side: usize| {
        let changed = forces.iter().filter(|f| f.changed());
        changed.map(|f| f.at[side]).collect::<Vec<Point>>()
    });
    for (side, (found, mut drawing)) in [then, now].into_iter().zip(drawings).enumerate() {
        let scene = &sides[side].analysis.scene;
        mark(&mut drawing, scene, outlines[side], &rings[side], colour);
        step.plates.push(plate(sides[side], found, drawing));
    }
    let last = step.plates.last_mut();
    if let Some(last) = last {
        last.caption.push_str(
            " Outlined in both: blocks that only one has or that are shaped, placed or loaded otherwise; ringed: forces \
             that changed by over 5 %.",
        );
    }
    step
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// How the blocks of two frames differ.
#[derive(Default)]
struct Shapes {
    /// Blocks of the first, by number, that the second has not or has otherwise.
    gone_or_changed: Vec<usize>,
    /// Blocks of the second that the first has not or had otherwise.
    new_or_changed: Vec<usize>,
    gone: Vec<String>,
    new: Vec<String>,
    changed: Vec<(String, String)>,
}

impl Shapes {
    fn of(sides: [Side<'_>; 2], number: usize) -> Shapes {
        let blocks = |side: Side<'_>| -> BTreeMap<String, usize> {
            let scene = &side.analysis.scene;
            let placed = scene.frames[number].placed.iter();
            placed
                .map(|id| (scene.blocks[id.0].id.clone(), id.0))
                .collect()
        };
        let [then, now] = sides.map(blocks);
        let [was, is] = sides.map(|side| &side.analysis.scene);
        let reach = reach(is).max(reach(was));
        let mut shapes = Shapes::default();
        for (id, before) in &then {
            let Some(after) = now.get(id) else {
                shapes.gone.push(line(id));
                shapes.gone_or_changed.push(*before);
                continue;
            };
            let how = differs(&was.blocks[*before], &is.blocks[*after], reach);
            if !how.is_empty() {
                shapes.gone_or_changed.push(*before);
                shapes.new_or_changed.push(*after);
                shapes.changed.push((line(id), how));
            }
        }
        for (id, after) in &now {
            if !then.contains_key(id) {
                shapes.new.push(line(id));
                shapes.new_or_changed.push(*after);
            }
        }
        shapes
    }

    fn stated(&self) -> Vec<String> {
        let changed: Vec<String> = self.changed.iter().map(|c| c.0.clone()).collect();
        let kinds = [
            ("gone", &self.gone),
            ("new", &self.new),
            ("changed", &changed),
        ];
        let described = kinds.into_iter().filter(|k| !k.1.is_empty());
        let mut stated: Vec<String> = described
            .map(|(how, names)| format!("{how}: {}", listed(&shortened(names.clone(), MOST_NAMED))))
            .collect();
        if stated.is_empty() {
            stated.push("the same blocks in the same places".into());
        }
        stated
    }

    fn grid(&self) -> Grid {
        let mut grid = Grid::new("Blocks that differ", &["block", "how"]);
        for name in &self.gone {
            grid.add("", [name.clone(), "only in the first".into()]);
        }
        for name in &self.new {
            grid.add("", [name.clone(), "only in the second".into()]);
        }
        for (name, how) in &self.changed {
            grid.add("", [name.clone(), how.clone()]);
        }
        grid
    }
}

/// The farthest corner from the origin, m.
fn reach(scene: &Scene) -> f64 {
    let corners = scene.blocks.iter().flat_map(|b| b.body.polygon.outline());
    corners
        .map(|p| p.x.abs().max(p.y.abs()))
        .fold(0.0, f64::max)
}

/// How a block differs from what it was; empty where it does not.
fn differs(was: &Block, is: &Block, reach: f64) -> String {
    let mut how = Vec::new();
    let moved = is.centroid - was.centroid;
    let near = MOVED * reach;
    let rings = |block: &Block| -> Vec<Vec<Point>> { block.body.polygon.rings().to_vec() };
    let (before, after) = (rings(was), rings(is));
    let same_shape = before.len() == after.len()
        && before.iter().zip(&after).all(|(a, b)| {
            a.len() == b.len()
                && a.iter()
                    .zip(b)
                    .all(|(p, q)| (q - p - moved).norm() <= 2.0 * near)
        });
    if !same_shape {
        how.push("another outline".to_owned());
    }
    if moved.norm() > near {
        let (x, y) = (digits(moved.x), digits(moved.y));
        how.push(format!("centroid moved by ({x}, {y}) m"));
    }
    if (is.weight - was.weight).abs() > 1e-9 * is.weight.abs().max(was.weight.abs()) {
        let (a, b) = (digits(was.weight), digits(is.weight));
        how.push(format!("weight {a} N → {b} N"));
    }
    if is.body.friction != was.body.friction {
        let (a, b) = (digits(was.body.friction), digits(is.body.friction));
        how.push(format!("friction coefficient {a} → {b}"));
    }
    listed(&how)
}

/// A force that both frames have at one interface.
struct Shared {
    between: [crate::scene::BodyId; 2],
    amounts: [f64; 2],
    difference: f64,
    noise: f64,
    at: [Point; 2],
}

impl Shared {
    fn changed(&self) -> bool {
        let larger = self.amounts[0].max(self.amounts[1]);
        larger > self.noise && self.difference > CHANGED * larger
    }
}

/// The interfaces that both frames have, by the names of their bodies and, of several between two bodies, by their order.
fn forces(sides: [Side<'_>; 2], number: usize) -> Vec<Shared> {
    let key = |scene: &Scene, contact: &Contact| {
        contact.interface.bodies.map(|b| scene.name(b).to_owned())
    };
    let [was, is] = sides.map(|side| (&side.analysis.scene, &side.analysis.frames[number]));
    let mut before: BTreeMap<[String; 2], Vec<&Contact>> = BTreeMap::new();
    for contact in &was.1.contacts {
        before.entry(key(was.0, contact)).or_default().push(contact);
    }
    let sizes = was.1.contacts.iter().chain(&is.1.contacts);
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
        shared.push(Shared {
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
    if before == 0.0 {
        return if after == 0.0 { "none" } else { "new" }.to_owned();
    }
    let sign = if after < before { "−" } else { "+" };
    format!("{sign}{}", tenths((after / before - 1.0).abs()))
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
        sides.map(|side| bullet::of(&side.analysis.scene, &side.analysis.frames[number]));
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

fn grid(scene: &Scene, forces: &[Shared]) -> Grid {
    let mut grid = Grid::new(
        "Forces that changed by over 5 %",
        &[
            "between",
            "#first, N",
            "#second, N",
            "#change of the amount",
        ],
    );
    for force in forces.iter().filter(|f| f.changed()) {
        let [a, b] = force.amounts;
        let cells = [
            line(&pair(scene, force.between)),
            digits(a),
            digits(b),
            change(a, b),
        ];
        grid.add("", cells);
    }
    grid
}

/// Outlines blocks and rings points of a scene in its drawing.
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
            ..Group::of_class("changed")
        };
        if !outline.segments.is_empty() {
            group = group.with(Path::stroked(outline, Stroke::new(colour, 3.0)));
        }
        for ring in rings {
            let circle = Outline::circle(camera.place(*ring), RING);
            group = group.with(Path::stroked(circle, Stroke::new(colour, 1.8)));
        }
        group
    };
    onto_scene(drawing, &marks);
}
