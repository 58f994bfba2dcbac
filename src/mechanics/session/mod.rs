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

pub use error::SessionError;
pub use plan::{PlanError, plan};

use crate::geometry::{Cell, Point};
use crate::mechanics::analysis::{
    Analysis, CapacityError, CapacityRequest, LoadCapacity, MarginKinds, Margins, Options, Source, Verdict, WarmStart,
    capacity_of, hinges_on_gaps,
};
use crate::mechanics::scene::format::{BlockEntry, SceneFile};
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
        if !file.steps.is_empty() {
            return Err(SessionError::Steps);
        }
        let scene = Scene::new(file.clone())?;
        let grips = scene.frames[0].holds.iter().map(|hold| {
            let given = file.robots[hold.robot.0].at.map(|_| hold.at);
            (hold.robot, (scene.blocks[hold.block.0].id.clone(), given))
        });
        let mut session = Session {
            grips: grips.collect(),
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
        };
        for (robot, read) in session.file.robots.iter_mut().zip(&session.scene.robots) {
            (robot.holds, robot.at) = (None, None);
            robot.id = Some(read.id.clone());
        }
        for (block, read) in session.file.blocks.iter_mut().zip(&session.scene.blocks) {
            block.id = Some(read.id.clone());
        }
        session.update_verdict();
        Ok(session)
    }

    /// Places a block, and returns the verdict. A block without an id gets as its id the smallest number (1, 2, …) that
    /// no placed block has.
    ///
    /// # Errors
    /// Returns an error, and places nothing, if the block is not valid, for example because it overlaps another block,
    /// or if its id is in use.
    pub fn place(&mut self, mut block: BlockEntry) -> Result<Verdict, SessionError> {
        let id = block.id.get_or_insert_with(|| self.free_number()).clone();
        if self.lookup.numbers.contains_key(&id) {
            return Err(SessionError::Twice(id));
        }
        let added = self.is_incremental() && self.add_cells(&block)?;
        self.file.blocks.push(block);
        if !added && let Err(problems) = self.read_again() {
            self.file.blocks.pop();
            return Err(problems.into());
        }
        Ok(self.update_verdict())
    }

    /// Removes a block and the loads on it, and returns the verdict.
    ///
    /// # Errors
    /// Returns an error, and removes nothing, if the block is not placed, if a robot holds it, or if the
    /// scene without the block is not valid.
    pub fn remove(&mut self, block: &str) -> Result<Verdict, SessionError> {
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
        Ok(self.update_verdict())
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
        Ok(self.update_verdict())
    }

    /// Makes a robot release the block that it holds, and returns the verdict.
    ///
    /// # Errors
    /// Returns an error if the robot does not exist or holds nothing.
    pub fn release(&mut self, robot: &str) -> Result<Verdict, SessionError> {
        let id = self.robot(robot)?;
        let holds = &mut self.scene.frames[0].holds;
        let before = holds.len();
        holds.retain(|hold| hold.robot != id);
        if holds.len() == before {
            return Err(SessionError::HoldsNothing(robot.into()));
        }
        self.grips.remove(&id);
        Ok(self.update_verdict())
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
        let mut file = self.file.clone();
        // Leave out listed contacts of blocks that were removed.
        let names: BTreeSet<&str> =
            (self.file.blocks.iter()).filter_map(|b| b.id.as_deref()).chain(["ground"]).collect();
        let exists = |name: &String| names.contains(name.as_str());
        file.contacts.retain(|c| c.bodies.iter().all(exists));
        let mut scene = Scene::new(file)?;
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
