//! Converts a [`SceneFile`] to a [`Scene`]: fills in defaults, resolves names, and checks numbers and outlines.

mod body;
mod closeness;
mod contact;
mod free_edges;
mod list;
mod load;
mod sketch;

use self::closeness::Closeness;
use self::list::material_values;
pub use self::sketch::SketchedBody;
pub(super) use self::sketch::sketch;
use super::collision::{self, Comparison, Penetration};
use super::finding::{Finding, Findings, UnreadParts};
use super::format::{self, CornerContacts, Pair, SceneFile, UnitsEntry};
use super::name::{self, Names};
use super::note::{Lines, NoteCode};
use super::number::{SMALLEST_EXTENT, at_least_zero, is_amount, is_sane};
use super::outline::Outline;
use super::steps::{self, StepContext};
use super::{Block, BlockId, BodyId, Frame, Grip, Ground, Material, Rgb, Robot, RobotId, Scene, problem, shape, unit};
use crate::geometry::{Lattice, LatticeKind, Point, Vector};
use crate::read::Trail;
use crate::read::reader::unknown_choice;

const DEFAULT_FRICTION: f64 = 0.7;
const DEFAULT_DENSITY: f64 = 1.0;
const DEFAULT_THICKNESS: f64 = 1.0;
const DEFAULT_GRAVITY: Pair = [0.0, -9.81];

/// Returns the scene that a file describes, or all problems that were found.
///
/// If parts of the file could not be read, the result may be an incomplete scene or an empty list of problems. The
/// caller must then not use the scene.
pub(super) fn resolve(file: &SceneFile, unread: UnreadParts) -> Result<Scene, Vec<Finding>> {
    let mut findings = Findings::with_unread(unread);
    findings.units = file.units.unwrap_or_default();
    let scene = Resolution::new(&mut findings, file).scene(&mut findings);
    match scene {
        Some(mut scene) if findings.list.is_empty() => {
            unit::to_si(&mut scene);
            Ok(scene)
        }
        _ => Err(findings.list),
    }
}

/// The largest number of corners of all bodies that use a shape.
const MAX_CORNERS: usize = 1_000_000;
/// The largest number of loads in all load cases together. Each case has a factor for each load.
const MAX_CASE_LOADS: usize = 1_000_000;

/// The largest number of blocks. A wall of this many takes about 5 GB of memory.
const MAX_BLOCKS: usize = 250_000;

/// A scene file, with the values of the whole file that its bodies use: units, gravity, defaults, materials and shapes.
struct Resolution<'f> {
    file: &'f SceneFile,
    units: UnitsEntry,
    gravity: Vector,
    kernel: f64,
    friction: f64,
    density: f64,
    thickness: f64,
    lattice: Option<Lattice>,
    /// Whether the grid is valid, or absent. Otherwise no body can be resolved.
    grid_known: bool,
    materials: Names<'f>,
    material_entries: Vec<MaterialValues>,
    shapes: Names<'f>,
    outlines: Vec<Option<Outline>>,
    ids: Vec<String>,
    robot_ids: Vec<String>,
    load_ids: Vec<String>,
}

/// The values that a material gives. A value that is not valid is absent.
#[derive(Clone, Copy)]
struct MaterialValues {
    density: Option<f64>,
    friction: Option<f64>,
    fill: Option<Rgb>,
}

impl<'f> Resolution<'f> {
    /// Resolves the values that apply to the whole file, such as gravity, the lattice, materials and shapes. The
    /// outlines of shapes come last because they need the lattice.
    fn new(findings: &mut Findings, file: &'f SceneFile) -> Resolution<'f> {
        let top = Trail::Top;
        let (gravity, kernel) = general_values(findings, file);
        name::once(findings, &top.key("materials"), &file.materials);
        name::once(findings, &top.key("shapes"), &file.shapes);
        let lattice = lattice(findings, file.grid.as_ref());
        let grid_known = !findings.unread.touches_key("grid") && lattice.is_some() == file.grid.is_some();
        let (materials, shapes) = list_names(findings, file);
        let mut resolution = Resolution {
            file,
            units: file.units.unwrap_or_default(),
            gravity,
            kernel,
            friction: at_least_zero(findings, &top, "friction", file.friction).unwrap_or(DEFAULT_FRICTION),
            density: at_least_zero(findings, &top, "density", file.density).unwrap_or(DEFAULT_DENSITY),
            thickness: at_least_zero(findings, &top, "thickness", file.thickness).unwrap_or(DEFAULT_THICKNESS),
            lattice,
            grid_known,
            materials,
            material_entries: Vec::new(),
            shapes,
            outlines: Vec::new(),
            ids: (file.blocks.iter().enumerate())
                .map(|(i, b)| b.id.clone().unwrap_or_else(|| (i + 1).to_string()))
                .collect(),
            robot_ids: (file.robots.iter().enumerate())
                .map(|(i, r)| r.id.clone().unwrap_or_else(|| format!("r{i}")))
                .collect(),
            load_ids: (file.loads.iter().enumerate())
                .map(|(i, l)| l.id.clone().unwrap_or_else(|| (i + 1).to_string()))
                .collect(),
        };
        resolution.material_entries = material_values(findings, file);
        resolution.outlines = resolution.shape_outlines(findings);
        resolution
    }

    /// Returns the scene; `None` if one of its bodies is not valid. Problems are reported in the order of the calls in
    /// this function.
    fn scene(&self, findings: &mut Findings) -> Option<Scene> {
        let blocks = self.file.blocks.len();
        if blocks > MAX_BLOCKS {
            findings.add(&Trail::Top.key("blocks"), problem::message::too_many_blocks(blocks, MAX_BLOCKS));
            return None;
        }
        let corners = self.corners_of_shapes();
        if corners > MAX_CORNERS {
            findings.add(&Trail::Top.key("shapes"), problem::message::too_many_corners(corners, MAX_CORNERS));
            return None;
        }
        let (loads, cases, most) = (self.file.loads.len(), self.file.cases.len(), MAX_CASE_LOADS);
        if loads.saturating_mul(cases) > most {
            findings.add(&Trail::Top.key("cases"), problem::message::too_many_case_loads([loads, cases], most));
            return None;
        }
        let most = steps::MAX_PLACED_BLOCKS;
        if self.file.steps.is_empty() && blocks * self.case_count() > most {
            findings.add(&Trail::Top.key("blocks"), problem::message::too_many_placed(most));
            return None;
        }
        let (mut ground, mut blocks) = (self.ground(findings), self.blocks(findings));
        let names = self.body_names(findings);
        let mut contacts = self.contacts(findings, &names.blocks, &ground);
        if self.has_schematic_bodies() {
            self.add_schematic_outlines(&mut ground, &mut blocks, &mut contacts);
        }
        let closeness = self.heal(findings, &mut ground, &mut blocks);
        self.check_ids(findings);
        self.check_ground_ids(findings);
        let friction_pairs = self.friction_pairs(findings);
        let joint_sets = self.joint_sets(findings, &names.blocks, &ground);
        let centroids: Vec<Point> =
            (blocks.iter()).map(|b| b.as_ref().map_or(Point::origin(), |b| b.centroid)).collect();
        let robots = self.robots(findings, &names.blocks, &centroids);
        let loads = self.loads(findings, &names.blocks, &ground, &blocks);
        let cases = self.cases(findings);
        let movements = self.movements(findings, &ground);
        let vehicle = self.vehicle(findings, &names.blocks);
        let mut frames = self.frames(findings, &names, &robots, &centroids);
        for frame in &mut frames {
            frame.expected = frame.expected.or(self.file.expect);
        }
        let penetrations = self.penetrations(findings, &ground, &blocks, &frames, &closeness);
        let materials = self.file.materials.0.iter();
        Some(Scene {
            title: self.file.title.clone().unwrap_or_default(),
            author: self.file.author.clone().unwrap_or_default(),
            project: self.file.project.clone().unwrap_or_default(),
            date: self.file.date.clone().unwrap_or_default(),
            units: self.units,
            gravity: self.gravity,
            thickness: self.thickness,
            kernel: self.kernel,
            lattice: self.lattice,
            exact: closeness.exact,
            tolerance: closeness.tolerance(),
            healed: closeness.healed,
            misfit: closeness.misfit,
            penetrations,
            ground: ground.into_iter().collect::<Option<_>>()?,
            blocks: blocks.into_iter().collect::<Option<_>>()?,
            robots,
            loads,
            load_ids: self.file.loads.iter().map(|load| load.id.clone()).collect(),
            cases,
            movements,
            vehicle,
            materials: materials.map(|m| Material { name: m.0.clone() }).collect(),
            friction_pairs,
            joint_sets,
            // A listed contact is a single point, so it transmits force in the same way as a corner contact.
            corner_contacts: match self.file.corner_contacts {
                _ if !contacts.is_empty() => CornerContacts::ALL,
                given => given.unwrap_or(CornerContacts::NONE),
            },
            contacts,
            frames,
            notes: Vec::new(),
            silenced: silenced(findings, self.file),
            lines: Lines::default(),
            set: Vec::new(),
        })
    }

    /// Returns how often a frame is analysed: once for each load case, or once.
    fn case_count(&self) -> usize {
        self.file.cases.len().max(1)
    }

    /// Returns the sum of the corners of all bodies that use a shape.
    fn corners_of_shapes(&self) -> usize {
        let used = self.file.ground.iter().map(|entry| &entry.shape);
        let used = used.chain(self.file.blocks.iter().map(|entry| &entry.shape)).flatten();
        let corners = |name: &String| match self.shapes.get(name).and_then(|number| self.outlines[number].as_ref()) {
            Some(Outline::Polygon(polygon)) => polygon.rings().iter().map(Vec::len).sum(),
            Some(Outline::Cells(cells)) => cells.len(),
            Some(Outline::Circle(_)) | None => 0,
        };
        used.map(corners).sum()
    }

    /// Returns the names of all blocks and robots. Contacts, robots, loads and steps refer to these names.
    fn body_names(&self, findings: &Findings) -> BodyNames<'_> {
        let hidden = |list: &str, ids: &[String]| findings.unread.hides_names(list, ids.len());
        BodyNames {
            blocks: Names::new("block", self.ids.iter().map(String::as_str).collect(), hidden("blocks", &self.ids)),
            robots: Names::new(
                "robot",
                self.robot_ids.iter().map(String::as_str).collect(),
                hidden("robots", &self.robot_ids),
            ),
        }
    }

    /// Executes the steps and returns the frame after each of them. If the file has no steps, returns one frame with
    /// all blocks.
    fn frames(
        &self,
        findings: &mut Findings,
        names: &BodyNames<'_>,
        robots: &[Robot],
        centroids: &[Point],
    ) -> Vec<Frame> {
        if self.file.steps.is_empty() {
            let holds = robots.iter().enumerate().filter_map(|(i, robot)| Some(robot.holds?.by(RobotId(i))));
            return vec![steps::frame_without_steps(centroids.len(), holds.collect())];
        }
        // If a step could not be read, the frames from this step on are unknown. Execute only the steps before it.
        let known = (findings.unread.first_entry("steps")).unwrap_or(usize::MAX).min(self.file.steps.len());
        let grips: Vec<Option<Grip>> = robots.iter().map(|robot| robot.holds).collect();
        let context = StepContext { blocks: &names.blocks, robots: &names.robots, centroids, grips: &grips };
        steps::frames(findings, &self.file.steps[..known], &context, self.case_count())
    }

    /// Finds bodies that overlap. Returns the overlaps that are small enough to be allowed, and reports the larger
    /// ones. Also reports a point at which too many corners meet. Checks nothing if the file lists contacts or has a
    /// block without an outline.
    fn penetrations(
        &self,
        findings: &mut Findings,
        ground: &[Option<Ground>],
        blocks: &[Option<Block>],
        frames: &[Frame],
        closeness: &Closeness,
    ) -> Vec<Penetration> {
        // If the steps could not be read, it is unknown which blocks are present at the same time. Do not report
        // overlaps then.
        if findings.unread.touches_key("steps") && self.file.steps.is_empty() {
            return Vec::new();
        }
        let grounds = (ground.iter().enumerate()).filter_map(|(i, g)| g.as_ref().map(|g| (BodyId::Ground(i), &g.body)));
        let blocks =
            (blocks.iter().enumerate()).filter_map(|(i, b)| b.as_ref().map(|b| (BodyId::Block(BlockId(i)), &b.body)));
        if self.has_schematic_bodies() {
            return Vec::new();
        }
        let bodies: Vec<_> = grounds.chain(blocks).collect();
        if self.file.corner_contacts.is_some_and(CornerContacts::on_edges) && self.file.contacts.is_empty() {
            collision::check_crowding(findings, &bodies, frames, closeness.tolerance().gap);
        }
        let comparison = Comparison {
            bodies,
            names: &self.ids,
            frames,
            lattice: self.lattice.filter(|_| closeness.exact),
            given: closeness.is_given(),
        };
        collision::check(findings, &comparison)
    }
}

/// The names of blocks and robots.
struct BodyNames<'s> {
    blocks: Names<'s>,
    robots: Names<'s>,
}

/// Checks the version of the scene format, gravity and the safety kernel. Returns gravity in m/s² and the safety
/// kernel.
fn general_values(findings: &mut Findings, file: &SceneFile) -> (Vector, f64) {
    let top = Trail::Top;
    if file.drystone.0 != 1 {
        findings.add(&top.key("drystone"), problem::message::version(file.drystone.0));
    }
    let gravity = file.gravity.unwrap_or(DEFAULT_GRAVITY);
    is_amount(findings, &top.key("gravity"), &gravity);
    let kernel = file.kernel.unwrap_or(0.0);
    if is_sane(findings, &top.key("kernel"), &[kernel]) && !(0.0..=1.0).contains(&kernel) {
        findings.add(&top.key("kernel"), problem::message::kernel(kernel));
    }
    (Vector::new(gravity[0], gravity[1]), kernel)
}

/// Returns the names of the materials, and the names of all shapes including the built-in shapes.
fn list_names<'f>(findings: &Findings, file: &'f SceneFile) -> (Names<'f>, Names<'f>) {
    let (materials, shapes) = (&file.materials.0, &file.shapes.0);
    let materials = Names::new(
        "material",
        materials.iter().map(|m| m.0.as_str()).collect(),
        findings.unread.hides_names("materials", materials.len()),
    );
    let names = shapes.iter().map(|s| s.0.as_str());
    let shapes = Names::new(
        "shape",
        names.chain(shape::BUILT_IN).collect(),
        findings.unread.hides_names("shapes", shapes.len()),
    );
    (materials, shapes)
}

/// Returns the codes of the notes that the file switches off. Reports unknown codes.
fn silenced(findings: &mut Findings, file: &SceneFile) -> Vec<NoteCode> {
    let top = Trail::Top;
    let list = top.key("silence");
    let mut codes = Vec::new();
    for (i, word) in file.silence.iter().enumerate() {
        match NoteCode::named(word) {
            Some(code) => codes.push(code),
            None => {
                let words: Vec<&str> = NoteCode::ALL.iter().map(|c| c.word()).collect();
                findings.add(&list.index(i), unknown_choice(word, &words).into());
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
        findings.add(&at, problem::message::side(side));
        return None;
    }
    if side < SMALLEST_EXTENT {
        let wording = problem::message::tiny_extent(side, SMALLEST_EXTENT, findings.units);
        findings.add(&at, wording);
        return None;
    }
    let kind = match entry.kind {
        format::GridKind::Triangular => LatticeKind::Triangular,
        format::GridKind::Square => LatticeKind::Square,
    };
    Some(Lattice { kind, side })
}
