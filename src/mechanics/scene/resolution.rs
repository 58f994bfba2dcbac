//! From a [`SceneFile`] to a [`Scene`]: defaults filled in, names resolved, numbers and outlines checked.

use std::collections::BTreeMap;

mod body;
mod robot;
pub(super) mod sketch;

use self::body::colour;
use super::collision::{self, Comparison};
use super::finding::{Finding, Findings, UnreadParts};
use super::format::{self, Pair, SceneFile};
use super::frame::Hold;
use super::heal::{self, Healed, HealingReach, ToleranceSource};
use super::name::{self, Names};
use super::note::{Lines, NoteCode};
use super::number::{SMALLEST_EXTENT, at_least_zero, is_amount, is_sane};
use super::outline::Outline;
use super::path::Trail;
use super::play::{self, StepContext};
use super::problem;
use super::rounding::{self, Rounding};
use super::shape;
use super::{Block, BlockId, Body, BodyId, Material, Rgb, RobotId, Scene};
use crate::geometry::{Bounds, Lattice, LatticeKind, Point, Polygon, Tolerance, Vector};

const FRICTION: f64 = 0.7;
const DENSITY: f64 = 1.0;
const THICKNESS: f64 = 1.0;
const GRAVITY: Pair = [0.0, -9.81];

/// The scene a file describes, or all that is wrong with it.
///
/// With parts of the file in doubt the answer is wrong in any case, perhaps without a finding.
pub(super) fn resolve(file: &SceneFile, doubt: UnreadParts) -> Result<Scene, Vec<Finding>> {
    let mut findings = Findings::doubting(doubt);
    let scene = Resolution::new(&mut findings, file).scene(&mut findings);
    match scene {
        Some(scene) if findings.list.is_empty() => Ok(scene),
        _ => Err(findings.list),
    }
}

/// How far a corner may lie off the edge that it touches, metres: the two ends of the edge and the corner are each off by the
/// error of a coordinate.
fn misfit(rounding: &Rounding) -> f64 {
    3.0 * rounding.error
}

/// What the whole file says, for its bodies to use.
struct Resolution<'f> {
    file: &'f SceneFile,
    gravity: Vector,
    kernel: f64,
    friction: f64,
    density: f64,
    thickness: f64,
    lattice: Option<Lattice>,
    /// Whether the grid could be read, so that bodies can be.
    grid_known: bool,
    materials: Names<'f>,
    material_entries: Vec<MaterialValues>,
    shapes: Names<'f>,
    outlines: Vec<Option<Outline>>,
    ids: Vec<String>,
    robot_ids: Vec<String>,
}

/// A material's own values, sound ones only.
#[derive(Clone, Copy)]
struct MaterialValues {
    density: Option<f64>,
    friction: Option<f64>,
    fill: Option<Rgb>,
}

impl<'f> Resolution<'f> {
    fn new(findings: &mut Findings, file: &'f SceneFile) -> Resolution<'f> {
        let top = Trail::Top;
        if file.drystone.0 != 1 {
            findings.add(
                &top.key("drystone"),
                problem::number::version(file.drystone.0),
            );
        }
        let gravity = file.gravity.unwrap_or(GRAVITY);
        is_amount(findings, &top.key("gravity"), &gravity);
        let kernel = file.kernel.unwrap_or(0.0);
        if is_sane(findings, &top.key("kernel"), &[kernel]) && !(0.0..=1.0).contains(&kernel) {
            findings.add(&top.key("kernel"), problem::number::kernel(kernel));
        }
        name::once(findings, &top.key("materials"), &file.materials);
        name::once(findings, &top.key("shapes"), &file.shapes);
        let lattice = lattice(findings, file.grid.as_ref());
        let grid_known =
            !findings.doubt.touches_key("grid") && lattice.is_some() == file.grid.is_some();
        let names = |list: &[(String, _)]| list.len();
        let materials = Names::new(
            "material",
            file.materials.0.iter().map(|m| m.0.as_str()).collect(),
            findings
                .doubt
                .hides_names("materials", names(&file.materials.0)),
        );
        let shapes = Names::new(
            "shape",
            file.shapes
                .0
                .iter()
                .map(|s| s.0.as_str())
                .chain(shape::BUILT_IN)
                .collect(),
            findings.doubt.hides_names("shapes", file.shapes.0.len()),
        );
        let mut resolution = Resolution {
            file,
            gravity: Vector::new(gravity[0], gravity[1]),
            kernel,
            friction: at_least_zero(findings, &top, "friction", file.friction).unwrap_or(FRICTION),
            density: at_least_zero(findings, &top, "density", file.density).unwrap_or(DENSITY),
            thickness: at_least_zero(findings, &top, "thickness", file.thickness)
                .unwrap_or(THICKNESS),
            lattice,
            grid_known,
            materials,
            material_entries: Vec::new(),
            shapes,
            outlines: Vec::new(),
            ids: file
                .blocks
                .iter()
                .enumerate()
                .map(|(i, b)| b.id.clone().unwrap_or_else(|| (i + 1).to_string()))
                .collect(),
            robot_ids: file
                .robots
                .iter()
                .enumerate()
                .map(|(i, r)| r.id.clone().unwrap_or_else(|| format!("r{i}")))
                .collect(),
        };
        resolution.material_entries = material_values(findings, file);
        resolution.outlines = resolution.shape_outlines(findings);
        resolution
    }

    fn scene(&self, findings: &mut Findings) -> Option<Scene> {
        let top = Trail::Top;
        let (mut ground, mut blocks) = (self.ground(findings), self.blocks(findings));
        let mut outlines = (ground.iter().flatten().map(|g| &g.body))
            .chain(blocks.iter().flatten().map(|b| &b.body));
        let exact = self.lattice.is_some() && outlines.all(|body| body.cells.is_some());
        let given = at_least_zero(
            findings,
            &top,
            "contact_tolerance",
            self.file.contact_tolerance,
        );
        // A lattice and a given tolerance need not be guessed from the digits.
        let rounding = match exact || given.is_some() {
            true => None,
            false => rounding::of(self.file),
        };
        let reach = if exact {
            HealingReach::EXACT
        } else {
            self.reach(given, rounding, &blocks)
        };
        let healed = if exact {
            Healed {
                source: ToleranceSource::Lattice,
                ..Healed::default()
            }
        } else {
            heal::heal(&mut ground, &mut blocks, reach)
        };
        ids(
            findings,
            &top.key("blocks"),
            "block",
            &self.ids,
            self.file.blocks.iter().map(|b| b.id.is_some()),
        );
        ids(
            findings,
            &top.key("robots"),
            "robot",
            &self.robot_ids,
            self.file.robots.iter().map(|r| r.id.is_some()),
        );
        let friction_pairs = self.friction_pairs(findings);
        let block_names = Names::new(
            "block",
            self.ids.iter().map(String::as_str).collect(),
            findings.doubt.hides_names("blocks", self.ids.len()),
        );
        let robot_names = Names::new(
            "robot",
            self.robot_ids.iter().map(String::as_str).collect(),
            findings.doubt.hides_names("robots", self.robot_ids.len()),
        );
        let centroids: Vec<Point> = blocks
            .iter()
            .map(|b| b.as_ref().map_or(Point::origin(), |b| b.centroid))
            .collect();
        let robots = self.robots(findings, &block_names, &centroids);
        let loads = self.loads(findings, &block_names, &centroids);
        let grips: Vec<Option<(BlockId, Point)>> = robots
            .iter()
            .map(|r| r.holds.map(|g| (g.block, g.at)))
            .collect();
        let frames = if self.file.steps.is_empty() {
            let holds = |(i, grip): (usize, &Option<(BlockId, Point)>)| {
                grip.map(|(block, at)| Hold {
                    robot: RobotId(i),
                    block,
                    at,
                })
            };
            vec![play::whole(
                blocks.len(),
                grips.iter().enumerate().filter_map(holds).collect(),
            )]
        } else {
            // What follows a step that could not be read is anybody's guess.
            let known = findings
                .doubt
                .first_entry("steps")
                .unwrap_or(usize::MAX)
                .min(self.file.steps.len());
            let cast = StepContext {
                blocks: &block_names,
                robots: &robot_names,
                centroids: &centroids,
                grips: &grips,
            };
            play::frames(findings, &self.file.steps[..known], &cast)
        };
        let bodies: Vec<(BodyId, &Body)> = (ground.iter().enumerate())
            .filter_map(|(i, g)| g.as_ref().map(|g| (BodyId::Ground(i), &g.body)))
            .chain(
                (blocks.iter().enumerate())
                    .filter_map(|(i, b)| b.as_ref().map(|b| (BodyId::Block(BlockId(i)), &b.body))),
            )
            .collect();
        let steps_unknown = findings.doubt.touches_key("steps") && self.file.steps.is_empty();
        let mut penetrations = Vec::new();
        if !steps_unknown {
            let lattice = self.lattice.filter(|_| exact);
            let comparison = Comparison {
                bodies,
                names: &self.ids,
                frames: &frames,
                lattice,
                given: reach.source == ToleranceSource::Given,
            };
            penetrations = collision::check(findings, &comparison);
        }
        Some(Scene {
            title: self.file.title.clone().unwrap_or_default(),
            gravity: self.gravity,
            thickness: self.thickness,
            kernel: self.kernel,
            lattice: self.lattice,
            exact,
            tolerance: if exact {
                Tolerance::EXACT
            } else {
                Tolerance::from_gap(reach.gap())
            },
            healed,
            misfit: rounding.map_or(0.0, |r| misfit(&r)),
            penetrations,
            ground: ground.into_iter().collect::<Option<_>>()?,
            blocks: blocks.into_iter().collect::<Option<_>>()?,
            robots,
            loads,
            materials: self
                .file
                .materials
                .0
                .iter()
                .map(|m| Material { name: m.0.clone() })
                .collect(),
            friction_pairs,
            corner_contacts: self.file.corner_contacts.unwrap_or(false),
            frames,
            notes: Vec::new(),
            silenced: silenced(findings, self.file),
            lines: Lines::default(),
        })
    }

    /// How close is close: as given, else from how the coordinates are written and how large the scene is.
    fn reach(
        &self,
        given: Option<f64>,
        rounding: Option<Rounding>,
        blocks: &[Option<Block>],
    ) -> HealingReach {
        if let Some(gap) = given {
            return HealingReach {
                source: ToleranceSource::Given,
                usual: 0.0,
                healing: gap,
            };
        }
        let polygons = || blocks.iter().flatten().map(|b| &b.body.polygon);
        let median = |mut sizes: Vec<f64>| {
            sizes.sort_by(f64::total_cmp);
            sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
        };
        let around = polygons().map(Polygon::bounds).reduce(Bounds::union);
        let typical = median(polygons().map(|p| p.bounds().diagonal()).collect());
        let usual = Tolerance::new(around.map_or(0.0, Bounds::diagonal), typical).gap;
        let small = median(polygons().map(heal::size).collect());
        match rounding.filter(|r| misfit(r) <= heal::FINE * small) {
            Some(rounding) => HealingReach {
                source: rounding.source,
                usual,
                healing: misfit(&rounding),
            },
            None => HealingReach {
                source: ToleranceSource::Size,
                usual,
                healing: 0.0,
            },
        }
    }

    fn shape_outlines(&self, findings: &mut Findings) -> Vec<Option<Outline>> {
        let top = Trail::Top;
        let list = top.key("shapes");
        let mut outlines = Vec::new();
        for (name, entry) in &self.file.shapes.0 {
            let at = list.key(name);
            if shape::BUILT_IN.contains(&name.as_str()) {
                findings.add_key(&at, problem::name::built_in_shape(name));
            }
            outlines.push(match (&entry.polygon, &entry.cells) {
                (Some(_), Some(_)) => {
                    findings.add(&at, problem::outline::two_outlines("polygon", "cells"));
                    None
                }
                (None, None) => {
                    findings.add(&at, problem::outline::no_shape_outline());
                    None
                }
                (polygon, cells) => self.outline(
                    findings,
                    &at,
                    polygon.as_deref(),
                    &entry.holes,
                    cells.as_deref(),
                ),
            });
        }
        for name in shape::BUILT_IN {
            let triangular = self
                .lattice
                .is_some_and(|l| l.kind == LatticeKind::Triangular);
            outlines.push(
                shape::cells(name)
                    .filter(|_| triangular)
                    .map(Outline::Cells),
            );
        }
        outlines
    }

    fn friction_pairs(&self, findings: &mut Findings) -> Vec<([usize; 2], f64)> {
        let top = Trail::Top;
        let list = top.key("friction_pairs");
        let mut pairs = Vec::new();
        let mut seen: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for (i, entry) in self.file.friction_pairs.iter().enumerate() {
            let at = list.index(i);
            let between = at.key("between");
            let friction = at_least_zero(findings, &at, "friction", Some(entry.friction));
            let a = self
                .materials
                .find(findings, &between.index(0), &entry.between[0]);
            let b = self
                .materials
                .find(findings, &between.index(1), &entry.between[1]);
            let (Some(a), Some(b)) = (a, b) else { continue };
            let pair = [a.min(b), a.max(b)];
            if let Some(first) = seen.get(&pair) {
                findings.add(&between, problem::name::pair_twice(&entry.between, *first));
                continue;
            }
            seen.insert(pair, i);
            pairs.extend(friction.map(|friction| (pair, friction)));
        }
        pairs
    }
}

/// The sorts of notes that the file silences.
fn silenced(findings: &mut Findings, file: &SceneFile) -> Vec<NoteCode> {
    let top = Trail::Top;
    let list = top.key("silence");
    let mut codes = Vec::new();
    for (i, word) in file.silence.iter().enumerate() {
        match NoteCode::named(word) {
            Some(code) => codes.push(code),
            None => {
                let words: Vec<String> = NoteCode::ALL.iter().map(|c| c.to_string()).collect();
                findings.add(&list.index(i), problem::entry::unknown_choice(word, &words));
            }
        }
    }
    codes
}

fn lattice(findings: &mut Findings, entry: Option<&format::GridEntry>) -> Option<Lattice> {
    let entry = entry?;
    let (top, side) = (Trail::Top, entry.side.unwrap_or(1.0));
    let grid = top.key("grid");
    let at = grid.key("side");
    if !is_sane(findings, &at, &[side]) {
        return None;
    }
    if side <= 0.0 {
        findings.add(&at, problem::number::side(side));
        return None;
    }
    if side < SMALLEST_EXTENT {
        findings.add(&at, problem::number::tiny_extent(side, SMALLEST_EXTENT));
        return None;
    }
    let kind = match entry.kind {
        format::GridKind::Triangular => LatticeKind::Triangular,
        format::GridKind::Square => LatticeKind::Square,
    };
    Some(Lattice { kind, side })
}

fn material_values(findings: &mut Findings, file: &SceneFile) -> Vec<MaterialValues> {
    let top = Trail::Top;
    let list = top.key("materials");
    let mut values = Vec::new();
    for (name, entry) in &file.materials.0 {
        let at = list.key(name);
        values.push(MaterialValues {
            density: at_least_zero(findings, &at, "density", entry.density),
            friction: at_least_zero(findings, &at, "friction", entry.friction),
            fill: entry
                .fill
                .as_deref()
                .and_then(|f| colour(findings, &at.key("fill"), f)),
        });
    }
    values
}

/// Notes ids that are used twice, empty or reserved.
fn ids(
    findings: &mut Findings,
    list: &Trail<'_>,
    sort: &str,
    ids: &[String],
    given: impl Iterator<Item = bool>,
) {
    let mut first: BTreeMap<&str, usize> = BTreeMap::new();
    for (i, (id, given)) in ids.iter().zip(given).enumerate() {
        let entry = list.index(i);
        let inner = entry.key("id");
        let at = if given { &inner } else { &entry };
        if id.is_empty() {
            findings.add(at, problem::name::empty_id(sort));
        } else if sort == "block" && id == "ground" {
            findings.add(at, problem::name::reserved_id());
        }
        if let Some(first) = first.get(id.as_str()) {
            findings.add(
                at,
                problem::name::id_twice(sort, id, &list.index(*first).path().to_string()),
            );
        } else {
            first.insert(id, i);
        }
    }
}
