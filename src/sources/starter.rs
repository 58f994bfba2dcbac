//! Generates the scene files of common structures from their dimensions and numbers of blocks.
//!
//! These scene files are starting points for users (`drystone new arch`), benchmarks and tests. The coordinates of
//! faces that touch are rounded to the same values, so rounding does not open any joint. Lengths are in metres, x
//! points right, y up.

use crate::mechanics::scene::format::{
    BlockEntry, CellEntry, CellHalf, CornerContacts, GridEntry, GridKind, GripEntry, GroundEntry, HoldEntry, Map, Pair,
    RobotEntry, SceneFile, StepEntry,
};

/// Coordinates are rounded to this many significant digits of the smallest length of the structure. The numbers are
/// short, and the rounding error is far smaller than any block.
const SIGNIFICANT_DIGITS: f64 = 4.0;

/// Rounds a coordinate, in metres, to the place of the fourth significant digit of `least`, the smallest length of the
/// structure in metres.
fn rounded(x: f64, least: f64) -> f64 {
    let decimals = SIGNIFICANT_DIGITS - 1.0 - libm::floor(libm::log10(least));
    let power = libm::pow(10.0, decimals.clamp(0.0, 15.0));
    let whole = (x * power).round() / power;
    // Adding 0 turns −0 into 0.
    whole + 0.0
}

/// Returns the four corners of the rectangle with the opposite corners `from` and `to`, in metres.
fn rectangle(from: Pair, to: Pair) -> Vec<Pair> {
    vec![from, [to[0], from[1]], to, [from[0], to[1]]]
}

fn block(id: String, polygon: Vec<Pair>) -> BlockEntry {
    BlockEntry { id: Some(id), polygon: Some(polygon), ..BlockEntry::default() }
}

/// Returns ground from x = `left` to x = `right`, in metres. It is `depth` metres thick, with its surface at y = 0.
fn floor(left: f64, right: f64, depth: f64) -> GroundEntry {
    GroundEntry { polygon: Some(rectangle([left, -depth], [right, 0.0])), ..GroundEntry::default() }
}

/// Density of stone, kg/m³.
const STONE_DENSITY: f64 = 2500.0;

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

/// A ladder that leans at a wall: its lower corner stands on the floor, its upper corner touches the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ladder {
    /// The length from the floor to the wall, in metres.
    pub length: f64,
    /// The thickness, in metres.
    pub thickness: f64,
    /// The angle between the ladder and the floor, from 5 to 85 degrees.
    pub angle: f64,
    /// Friction coefficient at the floor.
    pub friction: f64,
    /// Friction coefficient at the wall.
    pub wall_friction: f64,
}

impl Default for Ladder {
    /// Returns a ladder of 4 m by 0.06 m at 65° to the floor, with a friction coefficient of 0.7 at the floor and a smooth
    /// wall. It stands.
    fn default() -> Ladder {
        Ladder { length: 4.0, thickness: 0.06, angle: 65.0, friction: 0.7, wall_friction: 0.0 }
    }
}

impl Ladder {
    /// Returns a scene file with the ladder, the floor and the wall. The ladder weighs 200 N. Corners that touch an edge carry
    /// force.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict, starter::Ladder};
    /// // A thin ladder at a smooth wall stands if the friction at the floor is at least 1 / (2 tan 65°) = 0.233.
    /// let ladder = |friction| Scene::new(Ladder { friction, thickness: 1e-3, ..Ladder::default() }.scene());
    /// assert_eq!(Analysis::new(&ladder(0.235)?).verdict(), Verdict::Stable);
    /// assert_eq!(Analysis::new(&ladder(0.231)?).verdict(), Verdict::Unstable);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn scene(&self) -> SceneFile {
        let round = |x: f64| rounded(x, self.thickness);
        let (sin, cos) = libm::sincos(self.angle.to_radians());
        let (x, y) = (round(self.length * cos), round(self.length * sin));
        let across = [-round(self.thickness * sin), round(self.thickness * cos)];
        let outline = vec![[0.0, 0.0], [x, y], [round(x + across[0]), round(y + across[1])], across];
        let depth = round(0.1 * self.length);
        let [mut floor, mut wall] = [
            rectangle([-depth, -depth], [round(x + depth), 0.0]),
            rectangle([x, 0.0], [round(x + depth), round(y + depth)]),
        ]
        .map(|polygon| GroundEntry { polygon: Some(polygon), ..GroundEntry::default() });
        floor.id = Some("floor".into());
        (wall.id, wall.friction) = (Some("wall".into()), Some(self.wall_friction));
        SceneFile {
            title: Some(format!("A ladder at {}° to the floor", self.angle)),
            friction: Some(self.friction.max(self.wall_friction)),
            corner_contacts: Some(CornerContacts::ON_EDGES),
            ground: vec![GroundEntry { friction: Some(self.friction), ..floor }, wall],
            blocks: vec![BlockEntry { weight: Some(200.0), ..block("ladder".into(), outline) }],
            ..SceneFile::default()
        }
    }
}

/// A block on an inclined plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incline {
    /// The angle of the plane to the horizontal, from 0 to 85 degrees.
    pub angle: f64,
    /// Width of the block along the plane, in metres.
    pub width: f64,
    /// Height of the block, in metres.
    pub height: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for Incline {
    /// Returns a block of 1 m by 1 m on a plane at 20°, with a friction coefficient of 0.7. It stands.
    fn default() -> Incline {
        Incline { angle: 20.0, width: 1.0, height: 1.0, friction: 0.7 }
    }
}

impl Incline {
    /// Returns a scene file with the block, of stone with 2500 kg/m³, on the plane. Corners that touch an edge carry force.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict, starter::Incline};
    /// let block = |angle, friction| Scene::new(Incline { angle, friction, ..Incline::default() }.scene());
    /// // It slides where tan α exceeds μ, and topples where tan α exceeds the ratio of width and height.
    /// assert_eq!(Analysis::new(&block(34.9, 0.7)?).verdict(), Verdict::Stable);
    /// assert_eq!(Analysis::new(&block(35.1, 0.7)?).verdict(), Verdict::Unstable);
    /// assert_eq!(Analysis::new(&block(45.1, 2.0)?).verdict(), Verdict::Unstable);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn scene(&self) -> SceneFile {
        let round = |x: f64| rounded(x, self.width.min(self.height));
        let plane = rectangle([0.0, -round(0.5 * self.width)], [round(4.0 * self.width), 0.0]);
        let corners = rectangle([round(1.5 * self.width), 0.0], [round(2.5 * self.width), round(self.height)]);
        SceneFile {
            title: Some(format!("A block on a plane at {}°", self.angle)),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            corner_contacts: Some(CornerContacts::ON_EDGES),
            ground: vec![GroundEntry {
                id: Some("plane".into()),
                polygon: Some(plane),
                angle: Some(self.angle),
                ..GroundEntry::default()
            }],
            blocks: vec![BlockEntry { angle: Some(self.angle), ..block("block".into(), corners) }],
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

/// A semicircular arch of equal voussoirs on level ground.
///
/// A thin arch falls. With sufficient friction and many voussoirs, an arch stands if its thickness is at least 0.1075
/// times the radius of its centre line.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, analysis::Verdict, starter::Arch};
/// let arch = |thickness| Scene::new(Arch { thickness, ..Arch::default() }.scene());
/// assert_eq!(Analysis::new(&arch(0.4)?).verdict(), Verdict::Stable);
/// assert_eq!(Analysis::new(&arch(0.15)?).verdict(), Verdict::Unstable);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arch {
    /// The number of voussoirs, at least 2.
    pub voussoirs: usize,
    /// Clear width between the springings, in metres; from an angle of 180° on, twice the inner radius.
    pub span: f64,
    /// The thickness from the inner to the outer face, in metres.
    pub thickness: f64,
    /// The angle of embrace: the angle at the centre between the springings, from 20 to 300 degrees.
    pub angle: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for Arch {
    /// Returns a semicircular arch of 13 voussoirs with a clear width of 4 m, 0.4 m thick, with a friction coefficient of
    /// 0.7. It stands.
    fn default() -> Arch {
        Arch { voussoirs: 13, span: 4.0, thickness: 0.4, angle: 180.0, friction: 0.7 }
    }
}

impl Arch {
    /// Returns a scene file with the arch on the ground, of stone with 2500 kg/m³.
    pub fn scene(&self) -> SceneFile {
        let half = 0.5 * self.angle.to_radians();
        let inner = 0.5 * self.span / if self.angle < 180.0 { libm::sin(half) } else { 1.0 };
        let outer = inner + self.thickness;
        let least = self.thickness.min(self.span);
        let is_semicircle = self.angle == 180.0;
        // The directions from the centre, from the left springing to the right one.
        let direction = |number: usize| match number {
            // Both springings of a semicircle are at the height 0 exactly, without rounding errors.
            0 if is_semicircle => [-1.0, 0.0],
            n if is_semicircle && n == self.voussoirs => [1.0, 0.0],
            n => {
                let from_top = half * (1.0 - 2.0 * n as f64 / self.voussoirs as f64);
                [-libm::sin(from_top), libm::cos(from_top)]
            }
        };
        let round = |pair: Pair| pair.map(|x| rounded(x, least));
        let joint = |number: usize, radius: f64| round(direction(number).map(|x| radius * x));
        let voussoir = |i: usize| {
            let corners = vec![joint(i, inner), joint(i, outer), joint(i + 1, outer), joint(i + 1, inner)];
            block((i + 1).to_string(), corners)
        };
        let aside = rounded(outer + self.thickness, least);
        // Below a springing that is not level, a stone of the ground continues the arch.
        let below = |number: usize, to: f64| {
            let ([x, y], thick) = (direction(number), to * self.thickness);
            let beyond = |radius: f64| round([radius * x - thick * y, radius * y + thick * x]);
            let polygon = vec![joint(number, inner), joint(number, outer), beyond(outer), beyond(inner)];
            GroundEntry { polygon: Some(polygon), ..GroundEntry::default() }
        };
        let ground = match is_semicircle {
            true => vec![floor(-aside, aside, self.thickness)],
            false => vec![below(0, 1.0), below(self.voussoirs, -1.0)],
        };
        let embrace = if is_semicircle { String::new() } else { format!(", {}° at its centre", self.angle) };
        SceneFile {
            title: Some(format!(
                "A round arch of {} voussoirs over {} m, {} m thick{embrace}",
                self.voussoirs, self.span, self.thickness
            )),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            ground,
            blocks: (0..self.voussoirs).map(voussoir).collect(),
            ..SceneFile::default()
        }
    }
}

/// A pile of triangular cells that point up and down alternately. Each row has one upward triangle fewer than the row
/// below.
///
/// Contacts on a lattice are computed exactly, from integer coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticePile {
    /// The number of rows, which is also the number of triangles that stand on the ground.
    pub rows: usize,
    /// Edge length of a cell, in metres.
    pub side: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for LatticePile {
    /// Returns a pile of 3 rows of triangles with edges of 1 m and a friction coefficient of 0.7. It stands.
    fn default() -> LatticePile {
        LatticePile { rows: 3, side: 1.0, friction: 0.7 }
    }
}

impl LatticePile {
    /// Returns a scene file with the pile on the ground, of stone with 2500 kg/m³.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict, starter::LatticePile};
    /// let pile = |friction| Scene::new(LatticePile { friction, ..LatticePile::default() }.scene());
    /// assert_eq!(pile(0.7)?.blocks().len(), 9);
    /// assert_eq!(Analysis::new(&pile(0.7)?).verdict(), Verdict::Stable);
    /// assert_eq!(Analysis::new(&pile(0.05)?).verdict(), Verdict::Unstable);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn scene(&self) -> SceneFile {
        let up = |x: usize, y: f64| CellEntry::Triangle(x as f64, y, CellHalf::Up);
        let down = |x: usize, y: f64| CellEntry::Triangle(x as f64, y, CellHalf::Down);
        let mut blocks = Vec::new();
        for row in 0..self.rows {
            let (count, y) = (self.rows - row, row as f64);
            let cells = (0..count).map(|x| up(x, y)).chain((1..count).map(|x| down(x - 1, y + 1.0)));
            for cell in cells {
                blocks.push(BlockEntry { cells: Some(vec![cell]), ..BlockEntry::default() });
            }
        }
        // The ground is a strip of cells below y = 0. On the right it extends one side length beyond the pile.
        let strip = (0..=self.rows).flat_map(|x| [up(x, -1.0), down(x, 0.0)]);
        SceneFile {
            title: Some(format!("A pile of triangles in {} rows", self.rows)),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            grid: Some(GridEntry { kind: GridKind::Triangular, side: Some(self.side) }),
            ground: vec![GroundEntry { cells: Some(strip.collect()), ..GroundEntry::default() }],
            blocks,
            ..SceneFile::default()
        }
    }
}
