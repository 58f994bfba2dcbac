//! [`plan`]: an order in which a structure can be built, such that every step stands with a few robots, each of which
//! holds one block.
//!
//! The search takes the finished structure apart, because the last blocks are mostly the difficult ones. A state is a
//! set of placed blocks and a set of held blocks. From a state that stands, the search goes to another one that stands:
//!
//! 1. It takes away a block, the highest first.
//! 2. It lets a robot release a block, or take hold of one.
//! 3. It does both in one step: it takes away a block or releases one, and a robot takes hold of another block. In a step
//!    of building, at most one block is placed and at most one robot takes hold, perhaps one that releases another block
//!    in this step.
//!
//! Only a block that moves when the structure falls can help, so robots take hold of such blocks only. Robots with equal
//! limits are interchangeable, and are one class. In every state, blocks that touch connect each block with the ground,
//! so that no block waits in the air for its neighbours. No state is entered or analysed twice.

use std::collections::{BTreeMap, BTreeSet};

use crate::mechanics::analysis::{Analysis, Options, Verdict};
use crate::mechanics::scene::format::{RobotEntry, SceneFile, StepEntry};
use crate::mechanics::scene::{BlockId, BodyId, Frame, Grip, RobotId, Scene, SceneError};
use crate::mechanics::statics::interface::Interfaces;
use crate::text::{first_of, line};

/// At most this many blocks are named in a message.
const MAX_NAMED: usize = 8;

/// Why no order of building was found. The texts of the last three variants name the blocks of the smallest state that
/// the search reached.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The scene is not valid.
    #[error("{0}")]
    SceneError(#[from] SceneError),
    /// A number of robots is given for a scene that has robots.
    #[error("the scene has its own robots ({0}); leave out the number of robots")]
    Robots(String),
    /// The finished structure is not proved to stand without robots.
    #[error("the finished structure {} without robots{fastest}; an order of building exists only for a structure that stands", verdict.verb())]
    Finished {
        /// Whether it falls or is undecided.
        verdict: Verdict,
        /// If it falls: a part of a sentence that names the fastest block.
        fastest: String,
    },
    /// No order exists.
    #[error("no order exists: {0}")]
    NoOrder(String),
    /// Some states were not decided, and no order leads around them.
    #[error("no order was found, and some states are undecided: {0}")]
    Undecided(String),
    /// The time limit passed.
    #[error("the time limit passed before an order was found: {0}")]
    Late(String),
}

/// A set of placed blocks, and those of them that robots hold, each with the class of its robot.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct State {
    placed: BTreeSet<BlockId>,
    held: BTreeMap<BlockId, usize>,
}

impl State {
    fn changed(&self, change: impl FnOnce(&mut State)) -> State {
        let mut next = self.clone();
        change(&mut next);
        next
    }

    fn without(&self, block: BlockId) -> State {
        self.released(block).changed(|next| next.placed.retain(|placed| *placed != block))
    }

    fn released(&self, block: BlockId) -> State {
        self.changed(|next| next.held.retain(|held, _| *held != block))
    }
}

/// The blocks that move when a state falls, with their largest speed.
type Moving = BTreeMap<BlockId, f64>;

/// The kinds of states that the search tries from a state, in this order.
enum Stage {
    TakeAway,
    Release,
    Hold,
    /// Two changes in one step.
    Both,
}

/// A state on the path of the search, and what was not yet tried from there.
struct Node {
    state: State,
    stage: Stage,
    /// The states of this stage that were not yet tried, the next one last.
    untried: Vec<State>,
    /// The blocks that moved in the states that fell.
    moving: Moving,
}

struct Search<'s> {
    scene: &'s Scene,
    /// The robots of each class.
    classes: Vec<Vec<RobotId>>,
    options: &'s Options,
    /// The pairs of bodies that touch.
    touching: Vec<[BodyId; 2]>,
    /// The states that the search entered.
    entered: BTreeSet<State>,
    /// The states that were analysed: `None` if the state stands.
    analysed: BTreeMap<State, Option<Moving>>,
    /// The state with the fewest blocks that was entered.
    smallest: State,
    has_undecided: bool,
}

/// Finds an order of placing all blocks of a scene, such that every step stands with the robots of the scene, each of
/// which holds at most one block, at its centroid. A scene without robots gets this many, 1 by default, without limits of
/// force. Each block is placed against the ground or a block that is connected with it. Returns the scene with these
/// steps; its own steps and its expected verdict are left out. Whether a block fits between the others on its way is not
/// tested.
///
/// ```
/// use drystone::scene::format::BlockEntry;
/// use drystone::{Analysis, Scene, analysis::{Options, Verdict}, session::plan};
/// let block = |id: &str, x: f64, y: f64, w: f64, h: f64| {
///     BlockEntry::new(id).polygon([[x, y], [x + w, y], [x + w, y + h], [x, y + h]])
/// };
/// // A beam on a narrow base with a weight at each end: a robot holds the beam until both weights are placed.
/// let file = Scene::builder().ground([[0.0, -1.0], [9.0, -1.0], [9.0, 0.0], [0.0, 0.0]])
///     .block(block("base", 3.0, 0.0, 1.0, 1.0)).block(block("beam", 1.0, 1.0, 5.0, 1.0))
///     .block(block("left", 1.0, 2.0, 1.0, 3.0)).block(block("right", 5.0, 2.0, 1.0, 3.0));
/// assert!(plan(file.clone(), Some(0), &Options::default()).unwrap_err().to_string().starts_with("no order exists"));
/// let planned = plan(file, None, &Options::default())?.build()?;
/// assert_eq!(planned.frames().len(), 5);
/// assert_eq!(Analysis::new(&planned).verdict(), Verdict::Stable);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the reason if the scene is not valid, if it has robots and `robots` is given, or if no order was found.
pub fn plan(mut file: SceneFile, robots: Option<usize>, options: &Options) -> Result<SceneFile, PlanError> {
    if file.robots.is_empty() {
        file.robots = (1..=robots.unwrap_or(1)).map(|k| RobotEntry::new(format!("r{k}"))).collect();
    } else if robots.is_some() {
        let scene = Scene::new(file)?;
        return Err(PlanError::Robots(first_of(scene.robots.iter().map(|robot| line(&robot.id)), MAX_NAMED)));
    }
    // Without steps, a robot would hold its block all the time.
    file.robots.iter_mut().for_each(|robot| (robot.holds, robot.at) = (None, None));
    file.steps.clear();
    file.expect = None;
    let scene = Scene::new(file.clone())?;
    let all = State { placed: (0..scene.blocks.len()).map(BlockId).collect(), held: BTreeMap::new() };
    let mut classes: Vec<Vec<RobotId>> = Vec::new();
    for (k, robot) in scene.robots.iter().enumerate() {
        let equal = classes.iter_mut().find(|class| scene.robots[class[0].0].limits == robot.limits);
        match equal {
            Some(class) => class.push(RobotId(k)),
            None => classes.push(vec![RobotId(k)]),
        }
    }
    let mut search = Search {
        scene: &scene,
        classes,
        options,
        touching: Interfaces::new(&scene).all.iter().map(|found| found.bodies).collect(),
        entered: BTreeSet::new(),
        analysed: BTreeMap::new(),
        smallest: all.clone(),
        has_undecided: false,
    };
    let found = match search.verdict(&all) {
        (Verdict::Stable, _) => search.path(all),
        (verdict, moving) if !options.is_late() => {
            let fastest = moving.iter().max_by(|a, b| a.1.total_cmp(b.1)).filter(|_| verdict == Verdict::Unstable);
            let fastest = fastest.map(|(block, _)| format!(", and block {} moves most", search.name(block)));
            return Err(PlanError::Finished { verdict, fastest: fastest.unwrap_or_default() });
        }
        _ => None,
    };
    let Some(mut path) = found else {
        return Err(if options.is_late() {
            PlanError::Late(search.farthest(""))
        } else if search.has_undecided {
            PlanError::Undecided(search.farthest("were not shown to stand"))
        } else {
            PlanError::NoOrder(search.farthest("fall or hang in the air"))
        });
    };
    path.reverse();
    for (block, read) in file.blocks.iter_mut().zip(&scene.blocks) {
        block.id = Some(read.id.clone());
    }
    file.steps = search.steps(&path);
    Ok(file)
}

impl Search<'_> {
    /// Searches a path from a state to the empty one. `None` if there is none, or if the time is over.
    fn path(&mut self, from: State) -> Option<Vec<State>> {
        let mut path = vec![self.enter(from)];
        while let Some(node) = path.last_mut() {
            if node.state.placed.is_empty() {
                return Some(path.into_iter().map(|node| node.state).collect());
            }
            if self.options.is_late() {
                return None;
            }
            match self.next(node) {
                Some(state) => path.push(self.enter(state)),
                None => drop(path.pop()),
            }
        }
        None
    }

    /// Begins the search from a state. The highest block is taken away first.
    fn enter(&mut self, state: State) -> Node {
        self.entered.insert(state.clone());
        if state.placed.len() < self.smallest.placed.len() {
            self.smallest = state.clone();
        }
        let height = |block: &BlockId| -self.scene.gravity.dot(&self.scene.blocks[block.0].centroid.coords);
        let mut leave: Vec<BlockId> = state.placed.iter().copied().collect();
        leave.sort_by(|a, b| height(a).total_cmp(&height(b)));
        let untried = leave.into_iter().map(|block| state.without(block)).collect();
        Node { state, stage: Stage::TakeAway, untried, moving: Moving::new() }
    }

    /// Returns the next state that stands and was not entered.
    fn next(&mut self, node: &mut Node) -> Option<State> {
        loop {
            let untried = &mut node.untried;
            if let Some(state) = std::iter::from_fn(|| untried.pop()).find(|state| self.stands(state, &mut node.moving))
            {
                return Some(state);
            }
            let State { placed, held } = &node.state;
            let released = || held.keys().map(|block| node.state.released(*block));
            (node.stage, node.untried) = match node.stage {
                Stage::TakeAway => (Stage::Release, released().collect()),
                Stage::Release => (Stage::Hold, self.holding(&node.state, &node.moving)),
                Stage::Hold => {
                    // At most one robot takes hold in a step: one that holds the placed block takes no other one.
                    let taken = |block: &BlockId| self.helped(&node.state.without(*block), !held.contains_key(block));
                    let freed = released().flat_map(|state| self.helped(&state, false));
                    (Stage::Both, placed.iter().flat_map(taken).chain(freed).collect())
                }
                Stage::Both => return None,
            };
        }
    }

    /// Returns the states in which one robot more holds a block of those that move, the fastest last.
    fn holding(&self, state: &State, moving: &Moving) -> Vec<State> {
        let can_help = |block: &BlockId| state.placed.contains(block) && !state.held.contains_key(block);
        let mut help: Vec<(&BlockId, &f64)> = moving.iter().filter(|(block, _)| can_help(block)).collect();
        help.sort_by(|a, b| a.1.total_cmp(b.1));
        let busy = |class: usize| state.held.values().filter(|other| **other == class).count();
        let free: Vec<usize> = (0..self.classes.len()).filter(|k| busy(*k) < self.classes[*k].len()).collect();
        let hold = |block: BlockId, class: usize| state.changed(|next| next.held.extend([(block, class)]));
        help.into_iter().flat_map(|(block, _)| free.iter().map(|class| hold(*block, *class))).collect()
    }

    /// Returns the states in which a robot helps a state that falls: a free robot, or with `from_others` also one that
    /// holds another block.
    fn helped(&self, state: &State, from_others: bool) -> Vec<State> {
        let Some(Some(moving)) = self.analysed.get(state) else { return Vec::new() };
        let freed = state.held.keys().filter(|_| from_others).map(|block| state.released(*block));
        let all = freed.flat_map(|freed| self.holding(&freed, moving));
        all.chain(self.holding(state, moving)).collect()
    }

    /// True if a state stands, is connected with the ground, and was not entered, and the time is not over. If it falls,
    /// adds the blocks that move.
    fn stands(&mut self, state: &State, moving: &mut Moving) -> bool {
        if self.options.is_late() || self.entered.contains(state) || !self.is_connected(state) {
            return false;
        }
        if !self.analysed.contains_key(state) {
            let (verdict, motion) = self.verdict(state);
            self.analysed.insert(state.clone(), (verdict != Verdict::Stable).then_some(motion));
        }
        let Some(Some(motion)) = self.analysed.get(state) else { return true };
        for (block, speed) in motion {
            let most = moving.entry(*block).or_default();
            *most = most.max(*speed);
        }
        false
    }

    /// True if blocks that touch connect every placed block with the ground.
    fn is_connected(&self, state: &State) -> bool {
        let mut reached: BTreeSet<BlockId> = BTreeSet::new();
        loop {
            let supports = |body: BodyId| match body {
                BodyId::Ground(_) => true,
                BodyId::Block(block) => reached.contains(&block),
            };
            let pairs = self.touching.iter().flat_map(|[a, b]| [(*a, *b), (*b, *a)]);
            let next: Vec<BlockId> = pairs
                .filter_map(|(from, to)| match to {
                    BodyId::Block(block) if supports(from) && state.placed.contains(&block) => Some(block),
                    _ => None,
                })
                .collect();
            let before = reached.len();
            reached.extend(next);
            if reached.len() == before {
                return before == state.placed.len();
            }
        }
    }

    /// Returns the verdict on a state, and the blocks that may help it to stand.
    fn verdict(&mut self, state: &State) -> (Verdict, Moving) {
        let mut free = self.classes.clone();
        let hold = |(block, class): (&BlockId, &usize)| {
            let robot = free[*class].pop()?;
            Some(Grip::new(*block, None, self.scene.blocks[block.0].centroid).by(robot))
        };
        let frame = Frame {
            title: String::new(),
            placed: state.placed.iter().copied().collect(),
            holds: state.held.iter().filter_map(hold).collect(),
            plans: Vec::new(),
            expected: None,
        };
        let scene = Scene { frames: vec![frame], ..self.scene.clone() };
        let Some(found) = Analysis::with(scene, &self.options.only_verdict()).frames.pop() else {
            return (Verdict::Undecided, Moving::new());
        };
        if found.verdict == Verdict::Undecided {
            self.has_undecided = true;
            return (found.verdict, state.placed.iter().map(|block| (*block, 0.0)).collect());
        }
        let speeds = found.mechanism.iter().map(|motion| (motion.block, motion.velocity.norm()));
        (found.verdict, speeds.collect())
    }

    fn name(&self, block: &BlockId) -> String {
        line(&self.scene.blocks[block.0].id).to_string()
    }

    /// Says how far the search came. `fate` is what happens without the last block of the smallest state.
    fn farthest(&self, fate: &str) -> String {
        let (placed, robots) = (&self.smallest.placed, self.scene.robots.len());
        let robots = if robots == 1 { "1 robot".to_owned() } else { format!("{robots} robots") };
        let names = first_of(placed.iter().map(|block| self.name(block)), MAX_NAMED);
        let came = format!("taking blocks away from the end left {} of {}", placed.len(), self.scene.blocks.len());
        match fate {
            "" => format!("{came} ({names})"),
            _ => format!("{came} ({names}); whichever of them is placed last, the others {fate} with {robots}"),
        }
    }

    /// Writes a path of states, from the empty one to the finished structure, as steps of a scene.
    fn steps(&self, path: &[State]) -> Vec<StepEntry> {
        let name = |block: &BlockId| self.scene.blocks[block.0].id.clone();
        let robot = |robot: RobotId| self.scene.robots[robot.0].id.clone();
        let mut robot_of: BTreeMap<BlockId, RobotId> = BTreeMap::new();
        let mut steps: Vec<StepEntry> = Vec::new();
        let mut released: Vec<String> = Vec::new();
        for pair in path.windows(2) {
            let only = |one: usize| pair[one].held.iter().filter(move |(b, c)| pair[1 - one].held.get(b) != Some(c));
            released.extend(only(0).filter_map(|(block, _)| robot_of.remove(block)).map(robot));
            let placed = pair[1].placed.difference(&pair[0].placed).next();
            let taken = only(1).next();
            if placed.is_none() && taken.is_none() {
                continue;
            }
            // A robot that is free takes hold in the step before. A robot that releases a block first needs a new step.
            let last = steps.pop_if(|_| placed.is_none() && released.is_empty());
            let mut step = last.unwrap_or_else(|| StepEntry::default().release(released.drain(..)));
            step = step.place(placed.map(name));
            let is_free = |robot: &&RobotId| !robot_of.values().any(|busy| busy == *robot);
            let free = taken.and_then(|(block, class)| Some((*block, *self.classes[*class].iter().find(is_free)?)));
            if let Some((block, free)) = free {
                robot_of.insert(block, free);
                step = step.hold(robot(free), name(&block));
            }
            steps.push(step);
        }
        if !released.is_empty() {
            steps.push(StepEntry::default().release(released));
        }
        steps
    }
}
