//! [`plan`]: an order in which a structure can be built, such that every step stands with a few robots, each of which
//! holds one block.
//!
//! The search takes the finished structure apart, because the last blocks are mostly the difficult ones. A state is a
//! set of placed blocks and a set of held blocks. From a state that stands, it takes away a block, lets a robot release
//! a block, or lets a robot take hold of one, if the new state stands. Blocks that stand without help are taken away
//! first, the highest before the others. Only a block that moves when the structure falls can help, so a robot takes
//! hold of such blocks only. In every state, blocks that touch connect each block with the ground, so that no block
//! waits in the air for its neighbours. No state is entered or analysed twice.

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

/// A set of placed blocks and those of them that robots hold.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct State {
    placed: BTreeSet<BlockId>,
    held: BTreeSet<BlockId>,
}

impl State {
    fn changed(&self, change: impl FnOnce(&mut State)) -> State {
        let mut next = self.clone();
        change(&mut next);
        next
    }
}

/// The blocks that move when a state falls, with their largest speed.
type Moving = BTreeMap<BlockId, f64>;

/// A state on the path of the search, and what was not yet tried from there.
struct Node {
    state: State,
    /// The blocks that were not yet taken away, the next one last.
    leave: Vec<BlockId>,
    /// The blocks that moved in the states that fell.
    moving: Moving,
    /// The states with other holds that were not yet tried, the next one last. `None` before they are known.
    others: Option<Vec<State>>,
}

struct Search<'s> {
    scene: &'s Scene,
    robots: usize,
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

/// Finds an order of placing all blocks of a scene, such that every step stands with at most this many robots, each of
/// which holds one block at its centroid. Each block is placed against the ground or a block that is connected with it.
/// Returns the scene with these steps. The robots have the limits of the first robot of the scene, or no limit of force;
/// other robots, the steps and the expected verdict of the scene are left out. Whether a block fits between the others
/// on its way is not tested.
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
/// assert!(plan(file.clone(), 0, &Options::default()).unwrap_err().to_string().starts_with("no order exists"));
/// let planned = plan(file, 1, &Options::default())?.build()?;
/// assert_eq!(planned.frames().len(), 5);
/// assert_eq!(Analysis::new(&planned).verdict(), Verdict::Stable);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the reason if the scene is not valid, or if no order was found.
pub fn plan(mut file: SceneFile, robots: usize, options: &Options) -> Result<SceneFile, PlanError> {
    let limits = file.robots.first().and_then(|robot| robot.limits.clone());
    let robot = |k| RobotEntry { limits: limits.clone(), ..RobotEntry::new(format!("r{k}")) };
    file.robots = (1..=robots).map(robot).collect();
    file.steps.clear();
    file.expect = None;
    let scene = Scene::new(file.clone())?;
    let all = State { placed: (0..scene.blocks.len()).map(BlockId).collect(), held: BTreeSet::new() };
    let mut search = Search {
        scene: &scene,
        robots,
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
    file.steps = steps(&scene, &path);
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
        Node { state, leave, moving: Moving::new(), others: None }
    }

    /// Returns the next state that stands and was not entered.
    fn next(&mut self, node: &mut Node) -> Option<State> {
        while let Some(block) = node.leave.pop() {
            let without = node.state.changed(|next| {
                next.placed.remove(&block);
                next.held.remove(&block);
            });
            if self.stands(&without, &mut node.moving) {
                return Some(without);
            }
        }
        if node.others.is_none() {
            let State { placed, held } = &node.state;
            let can_help = |block: &BlockId| placed.contains(block) && !held.contains(block);
            let mut help: Vec<(&BlockId, &f64)> = node.moving.iter().filter(|(block, _)| can_help(block)).collect();
            help.retain(|_| held.len() < self.robots);
            help.sort_by(|a, b| a.1.total_cmp(b.1));
            let holding = |(block, _): (&BlockId, &f64)| node.state.changed(|next| next.held.extend([*block]));
            let released = |block: &BlockId| node.state.changed(|next| next.held.retain(|held| held != block));
            node.others = Some(help.into_iter().map(holding).chain(held.iter().map(released)).collect());
        }
        let others = node.others.as_mut()?;
        std::iter::from_fn(|| others.pop()).find(|state| self.stands(state, &mut node.moving))
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
        let hold = |(robot, block): (usize, &BlockId)| {
            Grip::new(*block, None, self.scene.blocks[block.0].centroid).by(RobotId(robot))
        };
        let frame = Frame {
            title: String::new(),
            placed: state.placed.iter().copied().collect(),
            holds: state.held.iter().enumerate().map(hold).collect(),
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
        let (placed, robots) = (&self.smallest.placed, self.robots);
        let robots = if robots == 1 { "1 robot".to_owned() } else { format!("{robots} robots") };
        let names = first_of(placed.iter().map(|block| self.name(block)), MAX_NAMED);
        let came = format!("taking blocks away from the end left {} of {}", placed.len(), self.scene.blocks.len());
        match fate {
            "" => format!("{came} ({names})"),
            _ => format!("{came} ({names}); whichever of them is placed last, the others {fate} with {robots}"),
        }
    }
}

/// Writes a path of states, from the empty one to the finished structure, as steps of a scene.
fn steps(scene: &Scene, path: &[State]) -> Vec<StepEntry> {
    let name = |block: &BlockId| scene.blocks[block.0].id.clone();
    let robot = |k: usize| scene.robots[k].id.clone();
    let mut robot_of: BTreeMap<BlockId, usize> = BTreeMap::new();
    let mut steps: Vec<StepEntry> = Vec::new();
    let mut released: Vec<String> = Vec::new();
    for pair in path.windows(2) {
        let gone = pair[0].held.difference(&pair[1].held);
        released.extend(gone.filter_map(|block| robot_of.remove(block)).map(robot));
        let placed = pair[1].placed.difference(&pair[0].placed).next();
        let taken = pair[1].held.difference(&pair[0].held).next();
        if placed.is_none() && taken.is_none() {
            continue;
        }
        // A robot that is free takes hold in the step before. A robot that releases a block first needs a new step.
        let last = steps.pop_if(|_| placed.is_none() && released.is_empty());
        let mut step = last.unwrap_or_else(|| StepEntry::default().release(released.drain(..)));
        step = step.place(placed.map(name));
        let free = (0..scene.robots.len()).find(|k| !robot_of.values().any(|busy| busy == k));
        if let (Some(block), Some(free)) = (taken, free) {
            robot_of.insert(*block, free);
            step = step.hold(robot(free), name(block));
        }
        steps.push(step);
    }
    if !released.is_empty() {
        steps.push(StepEntry::default().release(released));
    }
    steps
}
