//! [`Note`]: points out something in a scene that is allowed, but that the author of the scene probably did not intend.
//!
//! A note is not an error: the scene is analysed as written. A scene can switch off notes by their codes, in `silence`.

use std::collections::BTreeSet;

use super::finding::Finding;
use super::format::{HoldEntry, Pair, PressureEntry, SceneFile};
use super::problem::{Wording, codes, message as say};
use super::{BlockId, Body, BodyId, RobotId, Scene};
use crate::geometry::{Bounds, Point};
use crate::read::{Mark, Source};
use crate::read::{Path, Trail};

/// Friction coefficients above this are probably mistakes: those of dry stone, brick, wood and rubber are lower.
pub(super) const MAX_PLAUSIBLE_FRICTION: f64 = 2.0;

/// The diagonals in metres that a typical block may have. Others come from a missing or a wrong unit.
const PLAUSIBLE_SIZES: std::ops::RangeInclusive<f64> = 1e-4..=100.0;

/// The densities that a stone, a brick or a metal may have, kg/m³. Others are probably in another unit.
const PLAUSIBLE_DENSITIES: std::ops::RangeInclusive<f64> = 300.0..=20_000.0;

/// The unit weights that water and earth may have, N/m³: under water 8 000, at most three times that of water.
const PLAUSIBLE_UNIT_WEIGHTS: std::ops::RangeInclusive<f64> = 3_000.0..=40_000.0;

codes! {
    /// The kind of a note. Later versions may add codes, but the word of a code never changes.
    NoteCode;
    FrictionHigh "friction_high" "a friction coefficient above 2",
    GripOutside "grip_outside" "a grip point that lies outside the block",
    LoadOutside "load_outside" "a load that acts outside its block",
    UnusedRobot "unused_robot" "a robot that never holds or plans a block",
    UnusedBlock "unused_block" "a block that no step places or plans",
    DefaultDensity "default_density" "blocks whose weight comes from the default density, 1 kg/m³",
    NoGround "no_ground" "a scene without ground",
    NearMiss "near_miss" "edges that nearly touch: the gap between them is up to 1 % of the size of a block",
    NoBlocks "no_blocks" "a scene without blocks",
    NoWeight "no_weight" "blocks that all weigh nothing, without loads",
    ImplausibleSize "implausible_size" "blocks whose typical size is above 100 m or below 0.1 mm",
    ImplausibleDensity "implausible_density" "a density below 300 or above 20 000 kg/m³",
    ImplausibleUnitWeight "implausible_unit_weight" "a unit weight of water or earth below 3 000 or above 40 000 N/m³",
    BelowGround "below_ground" "blocks that all lie below the ground, or all beside it and above nothing",
    SetUnused "set_unused" "a value of `--set` that changes nothing",
    AngleRadians "angle_radians" "an angle that is probably a multiple of 15° given in radians, with three decimals or more",
}

/// Something that is allowed but probably not intended.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Note {
    /// The kind of note.
    pub code: NoteCode,
    /// Its place in the scene, such as `robots[0].at`.
    pub path: String,
    /// Line in the text, from 1; 0 if there is no text.
    pub line: usize,
    /// A description of what was found, with its numbers.
    pub message: String,
    /// What to do about it, and how to switch off such notes.
    pub hint: String,
}

impl NoteCode {
    /// Returns the note code that is written as `word` in JSON; `None` if there is no such code.
    pub fn named(word: &str) -> Option<NoteCode> {
        NoteCode::ALL.iter().copied().find(|c| c.word() == word)
    }
}

impl Note {
    /// Creates a note. Adds to the hint how the author can switch off such notes.
    fn new(code: NoteCode, path: String, line: usize, message: &str, hint: &str) -> Note {
        Note {
            code,
            path: crate::text::line(&path),
            line,
            message: crate::text::line(message),
            hint: crate::text::line(&format!(
                "{hint}; if the input is intended, add \"silence\": [\"{code}\"] to the scene"
            )),
        }
    }
}

impl Scene {
    /// Creates a note about a body. The note contains the line of the body in the file.
    pub(crate) fn note(&self, code: NoteCode, body: BodyId, message: &str, hint: &str) -> Note {
        let (list, lines, number) = match body {
            BodyId::Ground(i) => ("ground", &self.lines.ground, i),
            BodyId::Block(BlockId(i)) => ("blocks", &self.lines.blocks, i),
        };
        let line = lines.get(number).copied().unwrap_or(0);
        Note::new(code, format!("{list}[{number}]"), line, message, hint)
    }

    /// True if the author of the scene switched off notes with this code.
    pub(crate) fn silences(&self, code: NoteCode) -> bool {
        self.silenced.contains(&code)
    }
}

/// The line of each body in the file, from 1; empty for a scene built in code.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Lines {
    pub(crate) ground: Vec<usize>,
    pub(crate) blocks: Vec<usize>,
}

impl Lines {
    /// Finds the line in which each entry of `ground` and `blocks` begins in the text of a scene file.
    pub(super) fn new(source: &Source<'_>) -> Lines {
        let list = |key| {
            let starts = source.starts(key);
            starts.map(|byte| source.line(byte)).collect()
        };
        Lines { ground: list("ground"), blocks: list("blocks") }
    }
}

/// Returns the notes on a valid scene. `source` is asked for its text only if there are notes. Notes on edges that nearly
/// touch are added later, when contacts are found.
pub(super) fn of<'s>(file: &SceneFile, scene: &Scene, source: impl Fn() -> Option<&'s Source<'s>>) -> Vec<Note> {
    let mut notes = Notes { list: Vec::new(), scene };
    notes.friction(file);
    notes.angles(file);
    notes.grips(file);
    notes.loads(file);
    notes.unused(file);
    notes.weights(file);
    notes.emptiness();
    notes.sizes();
    notes.densities(file);
    notes.unit_weights(file);
    notes.heights();
    if scene.ground.is_empty() && !file.blocks.is_empty() {
        let at = Trail::Top;
        notes.add(NoteCode::NoGround, &at.key("ground"), say::no_ground());
    }
    let place = |finding: &Finding| {
        let span = source().and_then(|s| Some((s, s.find(&finding.path, finding.mark)?)));
        span.map_or(0, |(source, span)| source.line(span.start))
    };
    (notes.list.iter())
        .map(|(code, finding)| {
            let (message, hint) = finding.wording.parts();
            let path = finding.path.to_string();
            Note::new(*code, path, place(finding), message, hint)
        })
        .collect()
}

struct Notes<'s> {
    list: Vec<(NoteCode, Finding)>,
    scene: &'s Scene,
}

impl Notes<'_> {
    fn add(&mut self, code: NoteCode, at: &Trail<'_>, wording: Wording) {
        if !self.scene.silences(code) {
            let path: Path = at.path();
            let mark = Mark::Value;
            self.list.push((code, Finding { path, mark, wording }));
        }
    }

    fn friction(&mut self, file: &SceneFile) {
        let top = Trail::Top;
        let mut check = |at: &Trail<'_>, friction: Option<f64>| {
            if let Some(mu) = friction.filter(|mu| *mu > MAX_PLAUSIBLE_FRICTION) {
                self.add(NoteCode::FrictionHigh, &at.key("friction"), say::friction_high(mu));
            }
        };
        check(&top, file.friction);
        for (i, set) in file.joint_sets.iter().enumerate() {
            check(&top.key("joint_sets").index(i), set.friction);
        }
        for (name, material) in &file.materials.0 {
            check(&top.key("materials").key(name), material.friction);
        }
        for (i, pair) in file.friction_pairs.iter().enumerate() {
            check(&top.key("friction_pairs").index(i), Some(pair.friction));
        }
        for (i, part) in file.ground.iter().enumerate() {
            check(&top.key("ground").index(i), part.friction);
        }
        for (i, block) in file.blocks.iter().enumerate() {
            check(&top.key("blocks").index(i), block.friction);
        }
    }

    fn angles(&mut self, file: &SceneFile) {
        let top = Trail::Top;
        let mut check = |at: &Trail<'_>, angle: Option<f64>| {
            if let Some((angle, degrees)) = angle.and_then(|a| Some((a, in_degrees(a)?))) {
                let wording = say::angle_radians(angle, degrees);
                self.add(NoteCode::AngleRadians, &at.key("angle"), wording);
            }
        };
        for (i, part) in file.ground.iter().enumerate() {
            check(&top.key("ground").index(i), part.angle);
        }
        for (i, block) in file.blocks.iter().enumerate() {
            check(&top.key("blocks").index(i), block.angle);
        }
    }

    fn grips(&mut self, file: &SceneFile) {
        let scene = self.scene;
        let top = Trail::Top;
        for (i, robot) in file.robots.iter().enumerate() {
            if let (Some(at), Some(grip)) = (robot.at, scene.robots[i].holds) {
                self.grip(&top.key("robots").index(i).key("at"), at, grip.block);
            }
        }
        let numbers: std::collections::BTreeMap<&str, usize> =
            (scene.blocks.iter().enumerate().rev()).map(|(i, b)| (b.id.as_str(), i)).collect();
        for (k, step) in file.steps.iter().enumerate() {
            for (robot, hold) in &step.hold.0 {
                if let HoldEntry::Grip(grip) = hold
                    && let Some(at) = grip.at
                    && let Some(block) = numbers.get(grip.block.as_str())
                {
                    let steps = top.key("steps");
                    let step = steps.index(k);
                    let hold = step.key("hold");
                    self.grip(&hold.key(robot).key("at"), at, BlockId(*block));
                }
            }
        }
    }

    fn grip(&mut self, path: &Trail<'_>, at: Pair, block: BlockId) {
        let held = &self.scene.blocks[block.0];
        if let Some(distance) = self.outside(&held.body, at) {
            let unit = self.scene.units.length();
            let wording = say::grip_outside(&held.id, at, distance, &unit.symbol());
            self.add(NoteCode::GripOutside, path, wording);
        }
    }

    /// Returns the distance of the point `at` from the outline of a body, if the point is outside. The point and the
    /// distance are in the units of the file. `None` if the point lies in the body or within its contact tolerance, or
    /// if the body has no outline in the file.
    fn outside(&self, body: &Body, at: Pair) -> Option<f64> {
        let unit = self.scene.units.length();
        if body.is_schematic {
            return None;
        }
        let at = at.map(|x| x * unit.size);
        outside(body, at).map(|distance| unit.value_from_si(distance))
    }

    fn loads(&mut self, file: &SceneFile) {
        let top = Trail::Top;
        for load in &self.scene.loads {
            let loaded = &self.scene.blocks[load.block.0];
            if let Some(at) = file.loads[load.entry].at
                && let Some(distance) = self.outside(&loaded.body, at)
            {
                let unit = self.scene.units.length();
                let wording = say::load_outside(&loaded.id, at, distance, &unit.symbol());
                let loads = top.key("loads");
                self.add(NoteCode::LoadOutside, &loads.index(load.entry).key("at"), wording);
            }
        }
    }

    fn unused(&mut self, file: &SceneFile) {
        let scene = self.scene;
        let top = Trail::Top;
        let mut blocks: BTreeSet<BlockId> = BTreeSet::new();
        let mut robots: BTreeSet<RobotId> = BTreeSet::new();
        for frame in &scene.frames {
            blocks.extend(&frame.placed);
            blocks.extend(frame.plans.iter().map(|p| p.block));
            robots.extend(frame.holds.iter().map(|h| h.robot));
            robots.extend(frame.plans.iter().map(|p| p.robot));
        }
        for (i, robot) in scene.robots.iter().enumerate() {
            if !robots.contains(&RobotId(i)) {
                let wording = say::unused_robot(&robot.id, file.steps.is_empty());
                self.add(NoteCode::UnusedRobot, &top.key("robots").index(i), wording);
            }
        }
        for (i, block) in scene.blocks.iter().enumerate() {
            if !blocks.contains(&BlockId(i)) {
                let wording = say::unused_block(&block.id);
                self.add(NoteCode::UnusedBlock, &top.key("blocks").index(i), wording);
            }
        }
    }

    fn emptiness(&mut self) {
        let top = Trail::Top;
        let scene = self.scene;
        if scene.blocks.is_empty() {
            self.add(NoteCode::NoBlocks, &top.key("blocks"), say::no_blocks());
        } else if scene.loads.is_empty() && scene.blocks.iter().all(|block| block.weight == 0.0) {
            self.add(NoteCode::NoWeight, &top.key("blocks"), say::no_weight());
        }
    }

    fn sizes(&mut self) {
        let drawn = self.scene.blocks.iter().filter(|block| !block.body.is_schematic);
        let mut sizes: Vec<f64> = drawn.map(|block| block.body.polygon.bounds().diagonal()).collect();
        sizes.sort_by(f64::total_cmp);
        let Some(&typical) = sizes.get(sizes.len() / 2) else { return };
        if !PLAUSIBLE_SIZES.contains(&typical) {
            let top = Trail::Top;
            self.add(NoteCode::ImplausibleSize, &top.key("blocks"), say::implausible_size(typical));
        }
    }

    /// Adds a note on the first density that no material has. Without weight, 0 is meant.
    fn densities(&mut self, file: &SceneFile) {
        let is_odd = |density: Option<f64>| density.filter(|own| *own != 0.0 && !PLAUSIBLE_DENSITIES.contains(own));
        let top = Trail::Top;
        let (materials, blocks) = (top.key("materials"), top.key("blocks"));
        let add = |notes: &mut Notes<'_>, at: &Trail<'_>, density| {
            notes.add(NoteCode::ImplausibleDensity, &at.key("density"), say::implausible_density(density));
        };
        if let Some(density) = is_odd(file.density) {
            add(self, &top, density);
        } else if let Some((name, density)) =
            file.materials.0.iter().find_map(|(name, own)| Some((name, is_odd(own.density)?)))
        {
            add(self, &materials.key(name), density);
        } else if let Some((number, density)) =
            file.blocks.iter().enumerate().find_map(|(number, own)| Some((number, is_odd(own.density)?)))
        {
            add(self, &blocks.index(number), density);
        }
    }

    /// Adds a note on the first unit weight that neither water nor earth has.
    fn unit_weights(&mut self, file: &SceneFile) {
        let unit = self.scene.units.force();
        let loads = Trail::Top.key("loads");
        for (number, load) in file.loads.iter().enumerate() {
            let Some(PressureEntry::ByDepth(depth)) = &load.pressure else { continue };
            let newtons = depth.unit_weight * unit.size;
            if newtons != 0.0 && !PLAUSIBLE_UNIT_WEIGHTS.contains(&newtons) {
                let at = loads.index(number);
                let wording = say::implausible_unit_weight(depth.unit_weight, newtons, &unit.symbol().to_string());
                self.add(NoteCode::ImplausibleUnitWeight, &at.key("pressure").key("unit_weight"), wording);
                return;
            }
        }
    }

    /// Adds a note if all blocks lie below the ground. Also adds it if no block lies above any part of the ground, and
    /// none of their boxes meet. The blocks of a flat arch between two walls meet the walls.
    fn heights(&mut self) {
        let scene = self.scene;
        let is_held =
            scene.robots.iter().any(|r| r.holds.is_some()) || scene.frames.iter().any(|f| !f.holds.is_empty());
        if is_held
            || scene.ground.is_empty()
            || scene.blocks.is_empty()
            || scene.blocks.iter().any(|b| b.body.is_schematic)
        {
            return;
        }
        let ground: Vec<Bounds> = scene.ground.iter().map(|g| g.body.polygon.bounds()).collect();
        let bottom = ground.iter().map(|b| b.min.y).fold(f64::INFINITY, f64::min);
        let gap = scene.tolerance.gap;
        let boxes = || scene.blocks.iter().map(|block| block.body.polygon.bounds());
        let hang = || boxes().all(|b| b.max.y <= bottom + gap);
        let carries = |block: &Bounds, part: &Bounds| {
            let is_over = part.min.y < block.min.y && part.min.x < block.max.x && block.min.x < part.max.x;
            is_over || block.grown(gap).intersects(*part)
        };
        let float = || boxes().all(|block| !ground.iter().any(|part| carries(&block, part)));
        if hang() || float() {
            let top = Trail::Top;
            self.add(NoteCode::BelowGround, &top.key("ground"), say::below_ground());
        }
    }

    fn weights(&mut self, file: &SceneFile) {
        let is_limited = |limits: &super::Limits| limits.fx.is_finite() || limits.fy.is_finite() || limits.torque > 0.0;
        let gravity = file.gravity.unwrap_or([0.0, -9.81]);
        if file.density.is_some() || gravity == [0.0, 0.0] {
            return;
        }
        let beside = match (&self.scene.loads[..], &self.scene.robots) {
            ([_, ..], _) => Some("loads"),
            (_, robots) if robots.iter().any(|r| is_limited(&r.limits)) => Some("limits"),
            _ => None,
        };
        let has_density = |name: &str| (file.materials.0.iter()).any(|m| m.0 == name && m.1.density.is_some());
        let light: Vec<usize> = (file.blocks.iter().enumerate())
            .filter(|(_, b)| b.weight.is_none() && b.mass.is_none() && b.density.is_none())
            .filter(|(_, b)| b.centre.is_none() || b.has_outline())
            .filter(|(_, b)| !b.material.as_deref().is_some_and(has_density))
            .map(|(i, _)| i)
            .collect();
        if let Some(first) = light.first() {
            let top = Trail::Top;
            let force = self.scene.units.force.unwrap_or_default().name();
            let wording = say::default_density(light.len(), beside, force);
            self.add(NoteCode::DefaultDensity, &top.key("blocks").index(*first), wording);
        }
    }
}

/// Returns the angle in degrees that the author probably meant if `angle` looks like radians; otherwise `None`. A
/// number looks like radians if, to three decimals, it is a multiple of 15° in radians, up to a full turn. Numbers
/// with at most two decimals do not count, because degrees are often written with two decimals.
fn in_degrees(angle: f64) -> Option<f64> {
    let step = std::f64::consts::PI / 12.0;
    let count = (angle / step).round();
    let in_hundredths = (100.0 * angle - (100.0 * angle).round()).abs() < 1e-9;
    let fits = (1.0..=24.0).contains(&count.abs()) && (angle - count * step).abs() <= 5e-4;
    (fits && !in_hundredths).then_some(15.0 * count)
}

/// Returns the distance of a point from a polygon, in metres. `None` if the point is inside, or outside by at most
/// `gap` metres.
fn outside(body: &Body, at: Pair) -> Option<f64> {
    let distance = body.distance(Point::new(at[0], at[1]));
    // Because of rounding, a point on the boundary can seem to lie slightly outside. Do not report such points.
    let noise = 1e-9 * body.polygon.bounds().diagonal();
    (distance > body.gap.max(noise)).then_some(distance)
}
