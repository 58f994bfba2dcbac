//! [`Wall`], [`Tower`] and [`Doorway`]: structures of blocks with horizontal joints.

use super::{STONE_DENSITY, block, floor, rectangle, rounded};
use crate::mechanics::scene::format::{GripEntry, HoldEntry, Map, RobotEntry, SceneFile, StepEntry};

/// A wall in running bond. Every second course has half bricks at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// The number of courses.
    pub courses: usize,
    /// The number of bricks in a course; two half bricks count as one brick.
    pub bricks: usize,
    /// Length of a brick, in metres.
    pub length: f64,
    /// Height of a course, in metres.
    pub height: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for Wall {
    /// Returns a wall of 6 courses of 5 bricks, 0.25 m by 0.08 m each, with a friction coefficient of 0.7. It stands.
    fn default() -> Wall {
        Wall { courses: 6, bricks: 5, length: 0.25, height: 0.08, friction: 0.7 }
    }
}

impl Wall {
    /// Returns a scene file with the wall on the ground, of stone with 2500 kg/m³.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict, starter::Wall};
    /// let wall = Scene::new(Wall::default().scene())?;
    /// assert_eq!(wall.blocks().len(), 3 * 5 + 3 * 6);
    /// assert_eq!(Analysis::new(&wall).verdict(), Verdict::Stable);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn scene(&self) -> SceneFile {
        let least = self.height.min(0.5 * self.length);
        let x = |halves: usize| rounded(0.5 * self.length * halves as f64, least);
        let y = |course: usize| rounded(self.height * course as f64, least);
        let mut blocks = Vec::new();
        for course in 0..self.courses {
            // The positions of the joints, in half bricks from the left end.
            let joints: Vec<usize> = if course % 2 == 0 {
                (0..=self.bricks).map(|i| 2 * i).collect()
            } else {
                let inner = (0..self.bricks).map(|i| 2 * i + 1);
                (std::iter::once(0).chain(inner)).chain([2 * self.bricks]).collect()
            };
            for (i, pair) in joints.windows(2).enumerate() {
                let corners = rectangle([x(pair[0]), y(course)], [x(pair[1]), y(course + 1)]);
                blocks.push(block(format!("{}.{}", course + 1, i + 1), corners));
            }
        }
        SceneFile {
            title: Some(format!("A wall of {} courses of {} bricks", self.courses, self.bricks)),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            ground: vec![floor(-x(2), x(2 * self.bricks + 2), y(2))],
            blocks,
            ..SceneFile::default()
        }
    }
}

/// A stack of blocks, each shifted to the right relative to the block below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tower {
    /// The number of blocks.
    pub blocks: usize,
    /// Width of a block, in metres.
    pub width: f64,
    /// Height of a block, in metres.
    pub height: f64,
    /// The shift of each block to the right relative to the block below, in metres. The tower stands if the shift is
    /// at most the width divided by the number of blocks.
    pub lean: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for Tower {
    /// Returns a tower of 8 blocks of 1 m by 0.5 m, each 0.1 m to the right of the block below. It stands, and would
    /// stand with shifts of up to 0.125 m.
    fn default() -> Tower {
        Tower { blocks: 8, width: 1.0, height: 0.5, lean: 0.1, friction: 0.7 }
    }
}

impl Tower {
    /// Returns a scene file with the tower on the ground, of stone with 2500 kg/m³.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict, starter::Tower};
    /// let tower = |lean| Scene::new(Tower { lean, ..Tower::default() }.scene());
    /// assert_eq!(Analysis::new(&tower(0.12)?).verdict(), Verdict::Stable);
    /// assert_eq!(Analysis::new(&tower(0.13)?).verdict(), Verdict::Unstable);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn scene(&self) -> SceneFile {
        let least = self.height.min(self.width);
        let round = |x: f64| rounded(x, least);
        let storey = |i: usize| {
            let (x, y) = (self.lean * i as f64, self.height * i as f64);
            let corners = rectangle([round(x), round(y)], [round(x + self.width), round(y + self.height)]);
            block((i + 1).to_string(), corners)
        };
        SceneFile {
            title: Some(format!(
                "A tower of {} blocks, each {} m to the right of the one below",
                self.blocks, self.lean
            )),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            ground: vec![floor(round(-self.width), round(2.0 * self.width), round(self.height))],
            blocks: (0..self.blocks).map(storey).collect(),
            ..SceneFile::default()
        }
    }
}

/// Two jambs and a lintel, built in three steps. A robot holds the free end of the lintel until the second jamb is
/// placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doorway {
    /// The number of blocks in each jamb.
    pub courses: usize,
    /// Clear width, in metres.
    pub width: f64,
    /// Clear height, in metres.
    pub height: f64,
    /// Width of a jamb, in metres.
    pub jamb: f64,
    /// Height of the lintel, in metres.
    pub lintel: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for Doorway {
    /// Returns a doorway 1 m wide and 2 m high. Each jamb has 4 blocks. The structure stands after every step.
    fn default() -> Doorway {
        Doorway { courses: 4, width: 1.0, height: 2.0, jamb: 0.4, lintel: 0.3, friction: 0.7 }
    }
}

impl Doorway {
    /// Returns a scene file with the doorway on the ground, built in three steps, of stone with 2500 kg/m³.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict, starter::Doorway};
    /// let doorway = Scene::new(Doorway::default().scene())?;
    /// let analysis = Analysis::new(&doorway);
    /// assert_eq!(analysis.frames.len(), 3);
    /// assert_eq!(analysis.verdict(), Verdict::Stable);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn scene(&self) -> SceneFile {
        let least =
            [self.jamb, self.lintel, self.height / self.courses.max(1) as f64].into_iter().fold(self.width, f64::min);
        let round = |x: f64| rounded(x, least);
        let top = round(self.height);
        let (left, right) = (round(self.jamb), round(self.jamb + self.width));
        let end = round(2.0 * self.jamb + self.width);
        let level = |i: usize| round(self.height * i as f64 / self.courses.max(1) as f64);
        let mut blocks = Vec::new();
        for (side, from, to) in [("left", 0.0, left), ("right", right, end)] {
            for i in 0..self.courses {
                let corners = rectangle([from, level(i)], [to, level(i + 1)]);
                blocks.push(block(jamb_block(side, i), corners));
            }
        }
        let lintel = rectangle([0.0, top], [end, round(self.height + self.lintel)]);
        blocks.push(block("lintel".into(), lintel));
        let grip = GripEntry {
            block: "lintel".into(),
            at: Some([round(end - 0.5 * self.jamb), round(self.height + 0.5 * self.lintel)]),
        };
        SceneFile {
            title: Some(format!("A doorway {} m wide and {} m high", self.width, self.height)),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            ground: vec![floor(round(-self.jamb), round(end + self.jamb), round(self.lintel))],
            blocks,
            robots: vec![RobotEntry { id: Some("robot".into()), ..RobotEntry::default() }],
            steps: self.steps(grip),
            ..SceneFile::default()
        }
    }

    /// Returns the steps: the left jamb; then the lintel, which the robot holds; then the right jamb, and the robot
    /// lets go.
    fn steps(&self, grip: GripEntry) -> Vec<StepEntry> {
        let jamb = |side: &str| {
            let blocks = (0..self.courses).map(|i| jamb_block(side, i));
            blocks.collect::<Vec<_>>()
        };
        vec![
            StepEntry {
                title: Some("The left jamb".into()),
                place: jamb("left"),
                plan: Map(vec![("robot".into(), "lintel".into())]),
                ..StepEntry::default()
            },
            StepEntry {
                title: Some("The robot holds the lintel".into()),
                place: vec!["lintel".into()],
                hold: Map(vec![("robot".into(), HoldEntry::Grip(grip))]),
                ..StepEntry::default()
            },
            StepEntry {
                title: Some("The right jamb takes over".into()),
                release: vec!["robot".into()],
                place: jamb("right"),
                ..StepEntry::default()
            },
        ]
    }
}

/// Returns the id of a block in a jamb: `left 1`.
fn jamb_block(side: &str, course: usize) -> String {
    format!("{side} {}", course + 1)
}
