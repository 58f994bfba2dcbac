//! [`Session`]: a structure that grows and shrinks by one block at a time, with a verdict after every step.
//!
//! For loops that ask after each step, as a planner or a training loop does. What was found for the last step is the first
//! guess for the next, and is believed for its proof alone: a verdict of a session is the one that the same blocks and
//! holds have in a scene file of their own. On a lattice a step costs what is new; elsewhere the blocks are read anew with
//! each one that comes, since the tolerance within which edges touch is that of all coordinates together.

mod refusal;

use std::collections::BTreeMap;

pub use refusal::SessionError;

use crate::analysis::{
    Analysis, MarginKinds, Margins, Options, Source, Verdict, WarmStart, hinges_on_gaps,
};
use crate::geometry::{Cell, Point};
use crate::interface::{Interfaces, LatticeEdges};
use crate::scene::format::{BlockEntry, SceneFile};
use crate::scene::{BlockId, BodyId, Hold, RobotId, Scene, SceneError};

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
    /// What was given, with the blocks that stand and without who holds what.
    file: SceneFile,
    /// The same without bodies, robots and loads: what a block is read by.
    bare: SceneFile,
    /// Who holds which block, where it was said at which point.
    grips: BTreeMap<RobotId, (String, Option<Point>)>,
    /// The same, checked, its one frame being what stands. On a lattice blocks that were removed are still in it.
    scene: Scene,
    found: Interfaces,
    lookup: Lookup,
    guess: WarmStart,
    options: Options,
    verdict: Verdict,
    source: Source,
}

/// What is looked up of the blocks that stand.
#[derive(Clone, Debug, Default)]
struct Lookup {
    numbers: BTreeMap<String, BlockId>,
    /// On a lattice: who is in which cell, and who has which edges.
    cells: BTreeMap<Cell, BodyId>,
    edges: LatticeEdges,
}

impl Session {
    /// Begins with a scene: its ground, robots, shapes and materials, and the blocks that stand already.
    ///
    /// # Errors
    /// What is wrong with the scene; and steps, which are the session's own.
    pub fn new(file: SceneFile) -> Result<Session, SessionError> {
        Session::with(file, Options::default())
    }

    /// Begins with a scene, and verdicts as accurate as asked for. Margins and wedging are not found out; a deadline is one
    /// for all steps.
    ///
    /// # Errors
    /// As [`Session::new`].
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
        session.judge();
        Ok(session)
    }

    /// Places a block. Without an id it has the least number, from 1, that is no other's.
    ///
    /// # Errors
    /// Everything that is wrong with it, such as an overlap with what stands; nothing is placed then.
    pub fn place(&mut self, mut block: BlockEntry) -> Result<Verdict, SessionError> {
        let id = block.id.get_or_insert_with(|| self.free_number()).clone();
        if self.lookup.numbers.contains_key(&id) {
            return Err(SessionError::Twice(id));
        }
        let grown = self.grows() && self.grow(&block)?;
        self.file.blocks.push(block);
        if !grown && let Err(problems) = self.read_anew() {
            self.file.blocks.pop();
            return Err(problems.into());
        }
        Ok(self.judge())
    }

    /// Takes a block away, with the loads on it.
    ///
    /// # Errors
    /// No such block stands, or a robot holds it; nothing is taken away then.
    pub fn remove(&mut self, block: &str) -> Result<Verdict, SessionError> {
        let number = self.block(block)?;
        if let Some(hold) = self.scene.frames[0]
            .holds
            .iter()
            .find(|h| h.block == number)
        {
            let robot = self.scene.robots[hold.robot.0].id.clone();
            return Err(SessionError::Held(block.into(), robot));
        }
        self.file.loads.retain(|load| load.block != block);
        let named = |entry: &BlockEntry| entry.id.as_deref() == Some(block);
        self.file.blocks.retain(|entry| !named(entry));
        if self.grows() {
            let id = BodyId::Block(number);
            let cells = self.scene.blocks[number.0].body.cells.clone();
            self.lookup.remove(block, id, &cells.unwrap_or_default());
            self.found.all.retain(|seam| !seam.bodies.contains(&id));
            self.scene.loads.retain(|load| load.block != number);
            self.scene.frames[0].placed.retain(|b| *b != number);
        } else {
            // Numbers and the tolerance are others now.
            self.guess = WarmStart::default();
            self.read_anew()?;
        }
        Ok(self.judge())
    }

    /// Has a robot hold a block, at a point in metres or at its centroid.
    ///
    /// # Errors
    /// No such robot, no such block, a point that is no number, or the robot holds another block.
    pub fn hold(
        &mut self,
        robot: &str,
        block: &str,
        at: Option<Point>,
    ) -> Result<Verdict, SessionError> {
        let (robot_id, number) = (self.robot(robot)?, self.block(block)?);
        let point = at.unwrap_or(self.scene.blocks[number.0].centroid);
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
        holds.push(Hold {
            robot: robot_id,
            block: number,
            at: point,
        });
        holds.sort_by_key(|hold| hold.robot);
        self.grips.insert(robot_id, (block.into(), at));
        Ok(self.judge())
    }

    /// Has a robot let go.
    ///
    /// # Errors
    /// No such robot, or it holds nothing.
    pub fn release(&mut self, robot: &str) -> Result<Verdict, SessionError> {
        let id = self.robot(robot)?;
        let holds = &mut self.scene.frames[0].holds;
        let before = holds.len();
        holds.retain(|hold| hold.robot != id);
        if holds.len() == before {
            return Err(SessionError::HoldsNothing(robot.into()));
        }
        self.grips.remove(&id);
        Ok(self.judge())
    }

    /// The verdict on what stands.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// What that verdict came from.
    pub fn source(&self) -> Source {
        self.source
    }

    /// What stands as a scene of one frame, for figures and for all that a verdict does not tell. On a lattice the blocks
    /// that were removed are in it too, in no frame.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Everything there is to find out about what stands.
    pub fn analysis(&self) -> Analysis {
        Analysis::with(&self.scene, &self.options)
    }

    /// At which values of friction, tilt, loads, kernel and robot limits what stands does so: the margins that
    /// [`Session::analysis`] finds with [`Options::margins`].
    ///
    /// ```
    /// use drystone::scene::format::BlockEntry;
    /// use drystone::{Scene, analysis::MarginKinds, session::Session};
    /// let brick = BlockEntry::new("a").polygon([[0, 0], [3, 0], [3, 2], [0, 2]]);
    /// let floor = [[-9.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-9.0, 0.0]];
    /// let session = Session::new(Scene::builder().friction(0.5).ground(floor).block(brick))?;
    /// let margins = session.margins(MarginKinds::ALL).expect("a session has one frame");
    /// assert!((margins.horizontal_load.left.at().expect("it slides") - 0.5).abs() < 1e-6);
    /// # Ok::<(), drystone::session::SessionError>(())
    /// ```
    pub fn margins(&self, kinds: MarginKinds) -> Option<Margins> {
        let options = self.options.margins(true).margin_kinds(kinds);
        let frames = Analysis::with(&self.scene, &options).frames;
        frames.into_iter().next()?.margins
    }

    fn judge(&mut self) -> Verdict {
        (self.verdict, self.source) = if hinges_on_gaps(&self.scene, &self.found) {
            let frames = Analysis::with(&self.scene, &self.options).frames;
            let verdict = frames.first().map_or(Verdict::Stable, |f| f.verdict);
            (verdict, Source::Examined)
        } else {
            let frame = &self.scene.frames[0];
            let interfaces = match self.scene.exact {
                true => self.found.all.iter().collect(),
                false => self.found.in_frame(&self.scene, frame),
            };
            self.guess
                .verdict(&self.scene, frame, &interfaces, &self.options)
        };
        self.verdict
    }

    /// Whether what is new is all that a block brings: on a lattice, where no other block changes what touches.
    fn grows(&self) -> bool {
        self.scene.exact && !self.scene.corner_contacts
    }

    /// Adds a block of cells to what stands; false where that takes a closer look, at a block that is none or that is in
    /// the way of another.
    fn grow(&mut self, block: &BlockEntry) -> Result<bool, SceneError> {
        let alone = Scene::new(SceneFile {
            blocks: vec![block.clone()],
            ..self.bare.clone()
        })?;
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

    /// Reads all blocks that stand as one scene; where something is wrong with it, all stays as it is.
    fn read_anew(&mut self) -> Result<(), SceneError> {
        let mut scene = Scene::new(self.file.clone())?;
        self.lookup = Lookup::new(&scene);
        let grips = self.grips.iter();
        let holds = grips.filter_map(|(robot, (block, at))| {
            let block = *self.lookup.numbers.get(block)?;
            Some(Hold {
                robot: *robot,
                block,
                at: at.unwrap_or(scene.blocks[block.0].centroid),
            })
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
        number
            .map(RobotId)
            .ok_or_else(|| SessionError::NoRobot(name.into()))
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
