//! [`Session`]: places and removes blocks one by one, lets robots hold and release blocks, and returns the verdict
//! after each of these steps.
//!
//! A session is for planners and training loops that need a verdict after each step. The solution of the last step is
//! the warm start for the next step. The result of a warm start is accepted only with a proof. The verdict is therefore
//! the same as for a scene file with the same blocks and holds.
//!
//! On a lattice without corner contacts, contacts are found with integer arithmetic, so a step updates only the
//! contacts of one block. In other scenes, every new block can change the contact tolerance, which depends on all
//! coordinates. The whole scene is therefore read again after a block is placed or removed.

mod error;
mod plan;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

pub use error::SessionError;
pub use plan::{PlanError, plan};

use crate::geometry::{Cell, Point};
use crate::mechanics::analysis::{
    Analysis, CapacityError, CapacityRequest, LoadCapacity, MarginKinds, Margins, Options, Source, Verdict, WarmStart,
    capacity_of, hinges_on_gaps,
};
use crate::mechanics::scene::format::{BlockEntry, GripEntry, HoldEntry, SceneFile, StepEntry};
use crate::mechanics::scene::{BlockId, BodyId, Grip, RobotId, Scene, SceneError};
use crate::mechanics::solve::DeadlineGuard;
use crate::mechanics::statics::interface::{Interfaces, LatticeEdges};

/// A structure under construction.
///
/// ```
/// use drystone::scene::format::{BlockEntry, RobotEntry};
/// use drystone::{Scene, analysis::Verdict, session::Session};
///
/// let brick = |id: &str, x: f64, y: f64| {
///     BlockEntry::new(id).polygon([[x, y], [x + 3.0, y], [x + 3.0, y + 1.0], [x, y + 1.0]])
/// };
/// let floor = [[-9.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-9.0, 0.0]];
/// let mut session = Session::new(Scene::builder().ground(floor).robot(RobotEntry::new("crane")))?;
/// assert_eq!(session.place(brick("a", 0.0, 0.0))?, Verdict::Stable);
/// assert_eq!(session.place(brick("b", 2.0, 1.0))?, Verdict::Unstable);
/// assert_eq!(session.hold("crane", "b", None)?, Verdict::Stable);
/// assert_eq!(session.place(brick("c", -1.0, 1.0))?, Verdict::Stable);
/// assert_eq!(session.release("crane")?, Verdict::Unstable);
/// assert_eq!(session.remove("b")?, Verdict::Stable);
/// assert!(session.remove("b").unwrap_err().to_string().contains("no block b"));
/// # Ok::<(), drystone::session::SessionError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Session {
    /// The scene file at the start, with the names of all blocks and robots.
    start: Arc<SceneFile>,
    /// The steps so far, each with the block that it places. Grip points are in metres.
    steps: Vec<Arc<(StepEntry, Option<BlockEntry>)>>,
    /// The given scene file with the blocks placed so far, without holds.
    file: SceneFile,
    /// The scene file without title, bodies, robots, loads and listed contacts: the context for reading a single block.
    bare: SceneFile,
    /// The block that each robot holds, with the grip point if it was given.
    grips: BTreeMap<RobotId, (String, Option<Point>)>,
    /// The checked scene. Its only frame contains the placed blocks. On a lattice, it still contains blocks that were
    /// removed.
    scene: Scene,
    found: Interfaces,
    lookup: Lookup,
    guess: WarmStart,
    options: Options,
    verdict: Verdict,
    source: Source,
}

/// Indices of the placed blocks.
#[derive(Clone, Debug, Default)]
struct Lookup {
    numbers: BTreeMap<String, BlockId>,
    /// On a lattice: the body in each cell, and the bodies at each edge.
    cells: BTreeMap<Cell, BodyId>,
    edges: LatticeEdges,
}

impl Session {
    /// Starts a session with a scene: its ground, robots, shapes, materials and blocks.
    ///
    /// # Errors
    /// Returns an error if the scene is not valid, or if it has steps.
    pub fn new(file: SceneFile) -> Result<Session, SessionError> {
        Session::with(file, Options::default())
    }

    /// Starts a session with options for the analysis. The steps of a session compute no margins and do not check
    /// wedging. A deadline limits all steps together.
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Session::new`].
    pub fn with(file: SceneFile, options: Options) -> Result<Session, SessionError> {
        let mut session = Session::started(file, options)?;
        session.update_verdict();
        Ok(session)
    }

    /// Starts a session without a verdict.
    fn started(mut file: SceneFile, options: Options) -> Result<Session, SessionError> {
        if !file.steps.is_empty() {
            return Err(SessionError::Steps);
        }
        let scene = Scene::new(file.clone())?;
        for (robot, read) in file.robots.iter_mut().zip(&scene.robots) {
            robot.id = Some(read.id.clone());
        }
        for (block, read) in file.blocks.iter_mut().zip(&scene.blocks) {
            block.id = Some(read.id.clone());
        }
        let grips = scene.frames[0].holds.iter().map(|hold| {
            let given = file.robots[hold.robot.0].at.map(|_| hold.at);
            (hold.robot, (scene.blocks[hold.block.0].id.clone(), given))
        });
        let grips = grips.collect();
        let start = Arc::new(file.clone());
        file.robots.iter_mut().for_each(|robot| (robot.holds, robot.at) = (None, None));
        Ok(Session {
            start,
            steps: Vec::new(),
            grips,
            bare: SceneFile {
                title: None,
                blocks: Vec::new(),
                ground: Vec::new(),
                robots: Vec::new(),
                loads: Vec::new(),
                contacts: Vec::new(),
                ..file.clone()
            },
            lookup: Lookup::new(&scene),
            found: Interfaces::new(&scene),
            scene,
            file,
            guess: WarmStart::default(),
            options,
            verdict: Verdict::Stable,
            source: Source::Examined,
        })
    }

    /// Repeats the steps of [`Session::done`] after the same start, and solves only the last state.
    #[cfg(feature = "python")]
    pub(crate) fn repeated(start: SceneFile, done: SceneFile, options: Options) -> Result<Session, SessionError> {
        let mut session = Session::started(start, options)?;
        let mut blocks = done.blocks.into_iter();
        for step in done.steps {
            blocks.by_ref().take(step.place.len()).try_for_each(|block| session.add(block))?;
            step.remove.iter().try_for_each(|block| session.take_away(block))?;
            step.release.iter().try_for_each(|robot| session.let_go(robot))?;
            for (robot, hold) in step.hold.0 {
                let (block, at) = match hold {
                    HoldEntry::Block(block) => (block, None),
                    HoldEntry::Grip(grip) => (grip.block, grip.at),
                };
                session.grip(&robot, &block, at.map(Point::from))?;
            }
        }
        session.update_verdict();
        Ok(session)
    }

    /// Returns the scene file at the start, and one with the steps so far and the blocks that they place, in this order.
    /// Two of these blocks may have the same name, and grip points are in metres.
    #[cfg(feature = "python")]
    pub(crate) fn done(&self) -> (&SceneFile, SceneFile) {
        let steps = self.steps.iter().map(|step| step.0.clone()).collect();
        let blocks = self.steps.iter().filter_map(|step| step.1.clone()).collect();
        (&self.start, SceneFile { blocks, steps, ..SceneFile::default() })
    }

    /// Returns the session as a scene file with steps. The first step places the blocks of the start, if it has any; each
    /// step of the session follows. A block that is placed again in another way after it was removed gets another name,
    /// such as `a (2)`. The `expect` of the start is left out.
    ///
    /// ```
    /// use drystone::scene::format::BlockEntry;
    /// use drystone::{Analysis, Scene, session::Session};
    /// let brick = |x: f64, y: f64| BlockEntry::new("a").polygon([[x, y], [x + 3.0, y], [x + 3.0, y + 1.0], [x, y + 1.0]]);
    /// let floor = [[-9.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-9.0, 0.0]];
    /// let mut session = Session::new(Scene::builder().ground(floor))?;
    /// session.place(brick(0.0, 0.0))?;
    /// session.remove("a")?;
    /// session.place(brick(4.0, 0.0))?;
    /// let scene = Scene::new(session.scene_file())?;
    /// assert_eq!(scene.blocks()[1].id, "a (2)");
    /// assert_eq!(Analysis::new(&scene).frames.len(), 3);
    /// # Ok::<(), drystone::session::SessionError>(())
    /// ```
    pub fn scene_file(&self) -> SceneFile {
        let mut file = SceneFile { expect: None, ..(*self.start).clone() };
        let mut first = StepEntry::default().place(file.blocks.iter().filter_map(|block| block.id.clone()));
        for robot in &mut file.robots {
            let (block, at) = (robot.holds.take(), robot.at.take());
            first.hold.0.extend(robot.id.clone().zip(block.map(|block| HoldEntry::Grip(GripEntry { block, at }))));
        }
        file.steps.extend(Some(first).filter(|step| !step.place.is_empty()));
        let unit = self.scene.units.length();
        // The names that the placed blocks have in the file, if they are others.
        let mut names = BTreeMap::<String, String>::new();
        for (step, block) in self.steps.iter().map(|step| &**step) {
            let mut step = step.clone();
            if let (Some(block), Some(id)) = (block, step.place.first_mut()) {
                let known = |name: &String| file.blocks.iter().find(|block| block.id.as_ref() == Some(name));
                // The loads on a block vanish when it is removed, so that a loaded block is not the same again.
                let is_same = |name: &String| {
                    let as_named = |old: &BlockEntry| BlockEntry { id: Some(name.clone()), ..block.clone() } == *old;
                    let is_loaded = file.loads.iter().any(|load| load.block.as_ref() == Some(name));
                    known(name).is_none_or(|old| as_named(old) && !is_loaded)
                };
                let others = (2_usize..).map(|n| format!("{id} ({n})"));
                let name = std::iter::once(id.clone()).chain(others).find(is_same).unwrap_or_default();
                if known(&name).is_none() {
                    file.blocks.push(BlockEntry { id: Some(name.clone()), ..block.clone() });
                }
                names.insert(std::mem::replace(id, name.clone()), name);
            }
            let named = |name: &mut String| {
                if let Some(new) = names.get(name) {
                    name.clone_from(new);
                }
            };
            step.remove.iter_mut().for_each(named);
            for (_, hold) in &mut step.hold.0 {
                match hold {
                    HoldEntry::Block(block) => named(block),
                    HoldEntry::Grip(grip) => {
                        named(&mut grip.block);
                        grip.at = grip.at.map(|at| at.map(|x| unit.value_from_si(x)));
                    }
                }
            }
            file.steps.push(step);
        }
        file
    }

    /// Returns the placed blocks, and what robots hold, as a scene file without steps.
    pub fn placed_file(&self) -> SceneFile {
        let (mut file, unit) = (self.file_without_holds(), self.scene.units.length());
        for (robot, (block, at)) in &self.grips {
            let robot = &mut file.robots[robot.0];
            robot.holds = Some(block.clone());
            robot.at = at.map(|at| [at.x, at.y].map(|x| unit.value_from_si(x)));
        }
        file
    }

    /// Places a block, and returns the verdict. A block without an id gets as its id the smallest number (1, 2, …) that
    /// no placed block has.
    ///
    /// # Errors
    /// Returns an error, and places nothing, if the block is not valid, for example because it overlaps another block,
    /// or if its id is in use.
    pub fn place(&mut self, block: BlockEntry) -> Result<Verdict, SessionError> {
        self.add(block)?;
        Ok(self.update_verdict())
    }

    fn add(&mut self, mut block: BlockEntry) -> Result<(), SessionError> {
        let id = block.id.get_or_insert_with(|| self.free_number()).clone();
        if self.lookup.numbers.contains_key(&id) {
            return Err(SessionError::Twice(id));
        }
        let added = self.is_incremental() && self.add_cells(&block)?;
        self.file.blocks.push(block.clone());
        if !added && let Err(problems) = self.read_again() {
            self.file.blocks.pop();
            return Err(problems.into());
        }
        self.steps.push(Arc::new((StepEntry::default().place([id]), Some(block))));
        Ok(())
    }

    /// Removes a block and the loads on it, and returns the verdict.
    ///
    /// # Errors
    /// Returns an error, and removes nothing, if the block is not placed, if a robot holds it, or if the
    /// scene without the block is not valid.
    pub fn remove(&mut self, block: &str) -> Result<Verdict, SessionError> {
        self.take_away(block)?;
        Ok(self.update_verdict())
    }

    fn take_away(&mut self, block: &str) -> Result<(), SessionError> {
        let number = self.block(block)?;
        if let Some(hold) = self.scene.frames[0].holds.iter().find(|h| h.block == number) {
            let robot = self.scene.robots[hold.robot.0].id.clone();
            return Err(SessionError::Held(block.into(), robot));
        }
        if self.is_incremental() {
            self.remove_from_file(block);
            let id = BodyId::Block(number);
            let cells = self.scene.blocks[number.0].body.cells.clone();
            self.lookup.remove(block, id, &cells.unwrap_or_default());
            self.found.all.retain(|seam| !seam.bodies.contains(&id));
            self.scene.loads.retain(|load| load.block != number);
            self.scene.frames[0].placed.retain(|b| *b != number);
        } else {
            let kept = self.file.clone();
            self.remove_from_file(block);
            if let Err(problems) = self.read_again() {
                self.file = kept;
                return Err(problems.into());
            }
            // Reading the scene again may change block indices and the tolerance, so the warm start is no longer valid.
            self.guess = WarmStart::default();
        }
        self.steps.push(Arc::new((StepEntry::default().remove([block]), None)));
        Ok(())
    }

    fn remove_from_file(&mut self, block: &str) {
        self.file.loads.retain(|load| load.block.as_deref() != Some(block));
        let named = |entry: &BlockEntry| entry.id.as_deref() == Some(block);
        self.file.blocks.retain(|entry| !named(entry));
    }

    /// Makes a robot hold a block, and returns the verdict. `at` is the grip point in metres; `None` means the centroid
    /// of the block.
    ///
    /// # Errors
    /// Returns an error if the robot or the block does not exist, if the point is not valid, or if the robot holds
    /// another block.
    pub fn hold(&mut self, robot: &str, block: &str, at: Option<Point>) -> Result<Verdict, SessionError> {
        self.grip(robot, block, at)?;
        Ok(self.update_verdict())
    }

    fn grip(&mut self, robot: &str, block: &str, at: Option<Point>) -> Result<(), SessionError> {
        let (robot_id, number) = (self.robot(robot)?, self.block(block)?);
        let grip = Grip::new(number, at, self.scene.blocks[number.0].centroid);
        let point = grip.at;
        if !(point.x.abs() <= 1e12 && point.y.abs() <= 1e12) {
            return Err(SessionError::NoPlace(point.x, point.y));
        }
        let holds = &mut self.scene.frames[0].holds;
        if let Some(other) = holds.iter().find(|hold| hold.robot == robot_id) {
            if other.block != number {
                let other = self.scene.blocks[other.block.0].id.clone();
                return Err(SessionError::HoldsAnother(robot.into(), other));
            }
            holds.retain(|hold| hold.robot != robot_id);
        }
        holds.push(grip.by(robot_id));
        holds.sort_by_key(|hold| hold.robot);
        self.grips.insert(robot_id, (block.into(), at));
        let step = StepEntry::default();
        let step = match at {
            None => step.hold(robot, block),
            Some(at) => step.hold_at(robot, block, [at.x, at.y]),
        };
        self.steps.push(Arc::new((step, None)));
        Ok(())
    }

    /// Makes a robot release the block that it holds, and returns the verdict.
    ///
    /// # Errors
    /// Returns an error if the robot does not exist or holds nothing.
    pub fn release(&mut self, robot: &str) -> Result<Verdict, SessionError> {
        self.let_go(robot)?;
        Ok(self.update_verdict())
    }

    fn let_go(&mut self, robot: &str) -> Result<(), SessionError> {
        let id = self.robot(robot)?;
        let holds = &mut self.scene.frames[0].holds;
        let before = holds.len();
        holds.retain(|hold| hold.robot != id);
        if holds.len() == before {
            return Err(SessionError::HoldsNothing(robot.into()));
        }
        self.grips.remove(&id);
        self.steps.push(Arc::new((StepEntry::default().release([robot]), None)));
        Ok(())
    }

    /// Returns the verdict on the blocks that are placed at present.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Returns how the latest verdict was found: by a warm start or by a complete analysis.
    pub fn source(&self) -> Source {
        self.source
    }

    /// Returns the placed blocks as a scene with one frame, for figures and further analysis. On a lattice, the scene
    /// may still list removed blocks, but its frame does not contain them.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Analyses the placed blocks completely, with forces, failures and mechanism.
    pub fn analysis(&self) -> Analysis {
        Analysis::with(&self.scene, &self.options)
    }

    /// Computes the requested margins of the placed blocks: how far friction, tilt, loads, robot limits and the safety
    /// kernel may change before the blocks fall. The values equal those of [`Session::analysis`] with
    /// [`Options::margins`]. The result is never `None`, because a session always has one frame.
    ///
    /// ```
    /// use drystone::scene::format::BlockEntry;
    /// use drystone::{Scene, analysis::{MarginKind, MarginKinds}, session::Session};
    /// let brick = BlockEntry::new("a").polygon([[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]]);
    /// let floor = [[-9.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-9.0, 0.0]];
    /// let session = Session::new(Scene::builder().friction(0.5).ground(floor).block(brick))?;
    /// let margins = session.margins(MarginKinds::ALL).expect("a session has one frame");
    /// assert!((margins.least(MarginKind::HorizontalLoad).expect("it slides") + 0.5).abs() < 1e-6);
    /// # Ok::<(), drystone::session::SessionError>(())
    /// ```
    pub fn margins(&self, kinds: MarginKinds) -> Option<Margins> {
        let options = self.options.margins(kinds);
        Analysis::with(&self.scene, &options).frames.first()?.margins.clone()
    }

    /// Computes all forces that a placed block can carry in addition to its present loads. See [`Analysis::capacity`].
    ///
    /// # Errors
    /// Returns an error if the request is not valid, or if no proof was found.
    pub fn capacity(&self, request: &CapacityRequest) -> Result<LoadCapacity, CapacityError> {
        let _until = DeadlineGuard::new(self.options.deadline);
        let interfaces = if self.scene.exact { self.found.clone() } else { Interfaces::new(&self.scene) };
        capacity_of(&self.scene, &interfaces, 0, request)
    }

    /// Computes and stores the verdict on the placed blocks.
    fn update_verdict(&mut self) -> Verdict {
        let is_examined = hinges_on_gaps(&self.scene, &self.found) || self.scene.has_conditions();
        (self.verdict, self.source) = if is_examined {
            let frames = Analysis::with(&self.scene, &self.options.only_verdict()).frames;
            let verdict = frames.first().map_or(Verdict::Stable, |f| f.verdict);
            (verdict, Source::Examined)
        } else {
            let frame = &self.scene.frames[0];
            let interfaces =
                if self.scene.exact { self.found.all.iter().collect() } else { self.found.in_frame(frame) };
            self.guess.verdict(&self.scene, frame, &interfaces, &self.options)
        };
        self.verdict
    }

    /// True if a step can be computed without reading the whole scene again: if all bodies consist of lattice cells,
    /// and the scene has no corner contacts.
    fn is_incremental(&self) -> bool {
        // Pressures between two points act on edges that touch no other body, so every block may change them.
        let changes_pressures = self.file.loads.iter().any(|load| !load.between.is_empty());
        self.scene.exact && !self.scene.corner_contacts.on_edges() && !changes_pressures
    }

    /// Adds a block that consists of lattice cells, without reading the whole scene again. Returns false, and adds
    /// nothing, if the block has no cells or overlaps another body. The caller then reads the whole scene again,
    /// which adds the block or returns an error. Returns an error if the block alone is not valid.
    fn add_cells(&mut self, block: &BlockEntry) -> Result<bool, SceneError> {
        let alone = Scene::new(SceneFile { blocks: vec![block.clone()], ..self.bare.clone() })?;
        let new = alone.blocks.into_iter().next();
        let cells = new.as_ref().and_then(|new| new.body.cells.clone());
        let (Some(new), Some(cells), Some(lattice)) = (new, cells, self.scene.lattice) else {
            return Ok(false);
        };
        if self.lookup.are_taken(&cells) {
            return Ok(false);
        }
        let number = BlockId(self.scene.blocks.len());
        let id = BodyId::Block(number);
        self.lookup.numbers.insert(new.id.clone(), number);
        self.lookup.enter(id, &cells);
        self.scene.blocks.push(new);
        self.scene.frames[0].placed.push(number);
        let edges = &self.lookup.edges;
        let seams = edges.interfaces_of(&self.scene, &lattice, id, &cells);
        self.found.all.extend(seams);
        Ok(true)
    }

    /// Reads all placed blocks again as one scene. Keeps the current scene if this fails.
    fn read_again(&mut self) -> Result<(), SceneError> {
        let mut scene = Scene::new(self.file_without_holds())?;
        self.lookup = Lookup::new(&scene);
        let grips = self.grips.iter();
        let holds = grips.filter_map(|(robot, (block, at))| {
            let block = *self.lookup.numbers.get(block)?;
            Some(Grip::new(block, *at, scene.blocks[block.0].centroid).by(*robot))
        });
        scene.frames[0].holds = holds.collect();
        self.found = Interfaces::new(&scene);
        self.scene = scene;
        Ok(())
    }

    /// Returns the placed blocks as a scene file, without the listed contacts of blocks that were removed.
    fn file_without_holds(&self) -> SceneFile {
        let mut file = self.file.clone();
        let names: BTreeSet<&str> =
            (self.file.blocks.iter()).filter_map(|b| b.id.as_deref()).chain(["ground"]).collect();
        let exists = |name: &String| names.contains(name.as_str());
        file.contacts.retain(|c| c.bodies.iter().all(exists));
        file
    }

    fn block(&self, name: &str) -> Result<BlockId, SessionError> {
        let number = self.lookup.numbers.get(name).copied();
        number.ok_or_else(|| SessionError::NoBlock(name.into()))
    }

    fn robot(&self, name: &str) -> Result<RobotId, SessionError> {
        let number = self.scene.robots.iter().position(|r| r.id == name);
        number.map(RobotId).ok_or_else(|| SessionError::NoRobot(name.into()))
    }

    fn free_number(&self) -> String {
        let numbers = (1_usize..).map(|n| n.to_string());
        let free = |n: &String| !self.lookup.numbers.contains_key(n);
        numbers.into_iter().find(free).unwrap_or_default()
    }
}

impl Lookup {
    fn new(scene: &Scene) -> Lookup {
        let mut lookup = Lookup::default();
        for (number, ground) in scene.ground.iter().enumerate() {
            if let Some(cells) = &ground.body.cells {
                lookup.enter(BodyId::Ground(number), cells);
            }
        }
        for (number, block) in scene.blocks.iter().enumerate() {
            lookup.numbers.insert(block.id.clone(), BlockId(number));
            if let Some(cells) = &block.body.cells {
                lookup.enter(BodyId::Block(BlockId(number)), cells);
            }
        }
        lookup
    }

    fn enter(&mut self, id: BodyId, cells: &[Cell]) {
        self.cells.extend(cells.iter().map(|cell| (*cell, id)));
        self.edges.add(id, cells);
    }

    fn are_taken(&self, cells: &[Cell]) -> bool {
        cells.iter().any(|cell| self.cells.contains_key(cell))
    }

    fn remove(&mut self, name: &str, id: BodyId, cells: &[Cell]) {
        self.numbers.remove(name);
        for cell in cells {
            self.cells.remove(cell);
        }
        self.edges.remove(id, cells);
    }
}
