//! One frame drawn: ground, blocks, plans, arrows block by block, robots, and what fails on top of all.

use core::f64::consts::FRAC_PI_2;

use super::arrow::{ForceArrow, LEAST_SEEN, TurnArrow, TurnKind};
use super::displacement::Displacement;
use super::label;
use super::stage::{MANY, Stage};
use super::told;
use crate::drawing::arrow::{head, straight, turning};
use crate::drawing::placement::Ink;
use crate::drawing::{Camera, Colour, Group, Item, Outline, PagePoint, Path, Stroke};
use crate::geometry::{Bounds, Lattice, Point, Vector};
use crate::scene::{BlockId, Body, BodyId, Rgb};

/// Radius of a turning arrow in unit edges: around a robot's disc.
const TURN: f64 = 0.46;

/// Where a unit edge is shorter than this, pixels, arrows are texture rather than signs.
pub(crate) const TEXTURE: f64 = 20.0;
/// How strongly a displaced block is coloured, 0 … 1.
pub(crate) const MOVED: f64 = 0.38;
/// Where a unit edge is at least this long, pixels, outlines have their full width.
const LARGE: f64 = 1.5 / 0.028;
/// And seams around arrows theirs.
const LARGER: f64 = 0.9 / 0.012;
/// Least width of a shaft, pixels, where blocks are large enough to bear it.
const LEAST_SHAFT: f64 = 2.5;

/// What the camera sees of frame `number`; ground is cut at the edge of `view`.
pub(crate) fn picture(stage: &Stage<'_>, number: usize, view: Bounds, camera: &Camera) -> Group {
    let pen = Pen::of(stage, number, camera);
    let many = pen.many();
    let mut group = Group {
        camera: Some(*camera),
        ..Group::of_class("picture")
    };
    group.items.push(pen.ground(view).into());
    group.items.push(pen.blocks().into());
    group.items.push(pen.plans().into());
    group.items.push(pen.discs().into());
    group.items.push(
        if many {
            pen.arrows_by_colour()
        } else {
            pen.arrows(false)
        }
        .into(),
    );
    if !many && pen.unit() >= TEXTURE {
        group.items.push(pen.heads().into());
    }
    group.items.push(pen.arrows(true).into());
    group
        .items
        .push(label::labels(&pen, view, label::ink(&pen)).into());
    group
        .items
        .retain(|item| !matches!(item, Item::Group(g) if g.items.is_empty()));
    group
}

/// A scene's colour on the page.
pub(crate) fn colour(rgb: Rgb) -> Colour {
    Colour(rgb.0)
}

/// The seams between a body's lattice cells: every edge of a cell that two of its cells share, once.
pub(crate) fn seams(body: &Body, lattice: Option<Lattice>, camera: &Camera) -> Outline {
    let mut outline = Outline::default();
    let (Some(cells), Some(lattice)) = (&body.cells, lattice) else {
        return outline;
    };
    let mut steps = std::collections::BTreeSet::new();
    for cell in cells {
        let corners = cell.corners();
        for i in 0..corners.len() {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            if steps.contains(&(b, a)) {
                let place = |c: (i64, i64)| camera.place(lattice.point(c.0 as f64, c.1 as f64));
                outline.extend(Outline::line([place(a), place(b)]));
            }
            steps.insert((a, b));
        }
    }
    outline
}

/// Outlines joined by colour, in the order in which the colours came.
#[derive(Default)]
pub(crate) struct ByColour(Vec<(Colour, Outline)>);

impl ByColour {
    pub fn add(&mut self, fill: Colour, outline: Outline) {
        match self.0.iter_mut().find(|known| known.0 == fill) {
            Some(known) => known.1.extend(outline),
            None => self.0.push((fill, outline)),
        }
    }

    pub fn paths(self, stroke: Option<Stroke>) -> impl Iterator<Item = Item> {
        let path = move |(fill, outline)| Path {
            stroke: stroke.clone(),
            ..Path::filled(outline, fill)
        };
        self.0.into_iter().map(path).map(Item::from)
    }

    /// The same as lines so many pixels wide.
    pub fn lines(self, width: f64) -> impl Iterator<Item = Item> {
        let path = move |(colour, outline)| Path::stroked(outline, Stroke::new(colour, width));
        self.0.into_iter().map(path).map(Item::from)
    }
}

/// What draws the parts of a frame's picture.
pub(crate) struct Pen<'a> {
    pub stage: &'a Stage<'a>,
    /// The frame, from 0.
    pub number: usize,
    pub camera: &'a Camera,
    /// Place in the placing order of each block, by its number; `None` for a block that is not placed.
    places: Vec<Option<usize>>,
    /// Where each block is drawn, by its number, where that is not its place in the scene.
    displaced: Vec<Option<Displacement>>,
    /// Width of an outline, pixels.
    pub line: f64,
    /// Width of the seam around arrows, pixels.
    casing: f64,
    /// How much wider than told arrows are drawn: at small scales, so that their colours can be told apart.
    wider: f64,
}

impl<'a> Pen<'a> {
    pub(crate) fn of(stage: &'a Stage<'a>, number: usize, camera: &'a Camera) -> Pen<'a> {
        let unit = camera.length(stage.unit);
        let (scene, widths) = (stage.analysis.scene, &stage.options.theme.widths);
        let mut places = vec![None; scene.blocks.len()];
        for (place, id) in scene.frames[number].placed.iter().enumerate() {
            places[id.0] = Some(place);
        }
        Pen {
            places,
            displaced: stage.kind.displacements(
                stage.analysis,
                number,
                stage.unit,
                stage.options.way,
            ),
            stage,
            number,
            camera,
            line: (unit / LARGE).clamp(1.0 / 6.0, 1.0) * widths.outline,
            casing: (unit / LARGER).clamp(1.0 / 9.0, 1.0) * widths.casing,
            // Texture would turn to soup.
            wider: if unit < TEXTURE {
                1.0
            } else {
                (LEAST_SHAFT / (widths.force * unit)).clamp(1.0, 1.35)
            },
        }
    }

    pub(crate) fn unit(&self) -> f64 {
        self.camera.length(self.stage.unit)
    }

    pub(crate) fn ground(&self, view: Bounds) -> Group {
        let theme = &self.stage.options.theme;
        let scene = self.stage.analysis.scene;
        let mut group = Group::of_class("ground").titled("Ground");
        if scene.ground.is_empty() {
            return group;
        }
        group.clip = Some(self.camera.rect(view));
        let mut colours = ByColour::default();
        for ground in &scene.ground {
            let fill = ground.body.fill.map_or(theme.ground, colour);
            colours.add(fill, self.camera.polygon(&ground.body.polygon));
        }
        group
            .items
            .extend(colours.paths(Some(Stroke::new(theme.outline, self.line))));
        group
    }

    /// How a block is displaced, `None` where it is drawn in its place.
    pub(crate) fn displacement(&self, id: BlockId) -> Option<&Displacement> {
        self.displaced.get(id.0)?.as_ref()
    }

    /// Where a point of a block is drawn, metres.
    pub(crate) fn moved(&self, id: BlockId, point: Point) -> Point {
        self.displacement(id).map_or(point, |d| d.moved(point))
    }

    /// Whether the frame has so many blocks that its parts are joined by colour, without names.
    pub(crate) fn many(&self) -> bool {
        self.stage.analysis.scene.frames[self.number].placed.len() > MANY
    }

    /// A picture of plain parts: ground, these blocks, plans, robots, and the kind's own marks, labels clear of `ink`.
    pub(crate) fn picture(
        &self,
        view: Bounds,
        blocks: Group,
        marks: Vec<Group>,
        ink: Ink,
    ) -> Group {
        let mut group = Group {
            camera: Some(*self.camera),
            ..Group::of_class("picture")
        };
        let parts = [self.ground(view), blocks, self.plans(), self.discs()];
        let parts = parts.into_iter().chain(marks);
        group.items.extend(parts.map(Item::from));
        group.items.push(label::labels(self, view, ink).into());
        group
            .items
            .retain(|item| !matches!(item, Item::Group(g) if g.items.is_empty()));
        group
    }

    fn fill(&self, place: usize, id: BlockId) -> Colour {
        let scene = self.stage.analysis.scene;
        if self.displacement(id).is_some() {
            let theme = &self.stage.options.theme;
            return theme.page.mixed(theme.motion, MOVED);
        }
        match scene.blocks[id.0].body.fill {
            Some(fill) => colour(fill),
            None if !self.stage.kind.tells_amplitudes() => self.stage.options.theme.block,
            None => self
                .stage
                .options
                .theme
                .amplitude(self.stage.fills.shares[self.number][place]),
        }
    }

    /// The colour that a block, ground or the page has at a place.
    pub(crate) fn below(&self, at: PagePoint) -> Colour {
        let (scene, theme) = (self.stage.analysis.scene, &self.stage.options.theme);
        let at = self.camera.back(at);
        let placed = &scene.frames[self.number].placed;
        let block = placed.iter().position(|id| {
            let at = self.displacement(*id).map_or(at, |d| d.back(at));
            scene.blocks[id.0].body.polygon.contains(at)
        });
        let ground = || scene.ground.iter().find(|g| g.body.polygon.contains(at));
        match block {
            Some(place) => self.fill(place, placed[place]),
            None => ground().map_or(theme.page, |g| g.body.fill.map_or(theme.ground, colour)),
        }
    }

    /// Radius of a robot's disc, pixels.
    pub(crate) fn disc(&self) -> f64 {
        self.stage.options.theme.widths.disc * self.unit()
    }

    /// Width of an arrow's shaft as it is drawn, pixels.
    pub(crate) fn width(&self, arrow: &ForceArrow) -> f64 {
        let wider = if arrow.kind.is_failure() {
            1.0
        } else {
            self.wider
        };
        wider * self.camera.length(arrow.width)
    }

    fn seam(&self, fill: Colour) -> Stroke {
        Stroke::new(
            self.stage.options.theme.seam_on(fill, 0.22),
            0.6 * self.line,
        )
    }

    /// The blocks that are drawn in their places.
    pub(crate) fn blocks(&self) -> Group {
        if self.many() {
            return self.blocks_by_colour();
        }
        let (scene, theme) = (self.stage.analysis.scene, &self.stage.options.theme);
        let frame = &scene.frames[self.number];
        let mut group = Group::of_class("blocks");
        for (place, id) in frame.placed.iter().enumerate() {
            if self.displacement(*id).is_some() {
                continue;
            }
            let block = &scene.blocks[id.0];
            let fill = self.fill(place, *id);
            let outline = self.camera.polygon(&block.body.polygon);
            let mut body = Group::of_class("block").titled(format!("Block {}", block.id));
            body.description = told::block(self.stage, self.number, place, block);
            body = body.with(Path::filled(outline.clone(), fill));
            let seams = seams(&block.body, scene.lattice, self.camera);
            body = body.with(Path::stroked(seams, self.seam(fill)));
            group.items.push(
                body.with(Path::stroked(
                    outline,
                    Stroke::new(theme.outline, self.line),
                ))
                .into(),
            );
        }
        group
    }

    /// As [`Pen::blocks`] for scenes of very many blocks: one path for all blocks of a colour.
    fn blocks_by_colour(&self) -> Group {
        let (scene, theme) = (self.stage.analysis.scene, &self.stage.options.theme);
        let frame = &scene.frames[self.number];
        let mut group = Group::of_class("blocks").titled(format!("{} blocks", frame.placed.len()));
        let mut colours = ByColour::default();
        for (place, id) in frame.placed.iter().enumerate() {
            if self.displacement(*id).is_some() {
                continue;
            }
            let outline = self.camera.polygon(&scene.blocks[id.0].body.polygon);
            colours.add(self.fill(place, *id), outline);
        }
        group
            .items
            .extend(colours.paths(Some(Stroke::new(theme.outline, self.line))));
        group
    }

    pub(crate) fn plans(&self) -> Group {
        let scene = self.stage.analysis.scene;
        let mut group = Group::of_class("plans");
        for plan in &scene.frames[self.number].plans {
            let (block, robot) = (&scene.blocks[plan.block.0], &scene.robots[plan.robot.0]);
            let ink = self.stage.options.theme.robot(plan.robot.0);
            let title = format!("Block {}, planned by robot {}", block.id, robot.id);
            let seams = seams(&block.body, scene.lattice, self.camera);
            let outline = self.camera.polygon(&block.body.polygon);
            let planned = Group::of_class("plan")
                .titled(title)
                .with(Path::stroked(seams, Stroke::new(ink, 0.9 * self.line)))
                .with(Path::stroked(outline, Stroke::new(ink, 1.8 * self.line)));
            group.items.push(planned.into());
        }
        group
    }

    pub(crate) fn discs(&self) -> Group {
        let (scene, theme) = (self.stage.analysis.scene, &self.stage.options.theme);
        let mut group = Group::of_class("robots");
        for hold in &scene.frames[self.number].holds {
            let at = self.moved(hold.block, hold.at);
            let disc = Outline::circle(self.camera.place(at), self.disc());
            let title = format!(
                "Robot {} holds block {}",
                scene.robots[hold.robot.0].id, scene.blocks[hold.block.0].id
            );
            let edge = theme.robot(hold.robot.0).mixed(theme.ink, 0.35);
            let path = Path::filled(disc, theme.robot(hold.robot.0))
                .with_stroke(Stroke::new(edge, 0.7 * self.line));
            group
                .items
                .push(Group::of_class("robot").titled(title).with(path).into());
        }
        group
    }

    /// Whether an arrow is long enough to be seen.
    pub(crate) fn seen(&self, arrow: &ForceArrow) -> bool {
        self.camera.length(arrow.reach().norm()) >= LEAST_SEEN
    }

    /// Whether a turning arrow is long enough to be seen.
    pub(crate) fn turn_seen(&self, turn: &TurnArrow) -> bool {
        self.camera.length(turn.arc.abs()) >= LEAST_SEEN
    }

    fn arrow(&self, arrow: &ForceArrow) -> Path {
        let outline = straight(
            self.camera.place(arrow.at),
            self.camera.turn(arrow.reach()),
            self.width(arrow),
        );
        Path::filled(outline, arrow.colour).cased(self.seam_around(arrow), self.casing)
    }

    /// The seam that sets an arrow off from the block it acts on.
    fn seam_around(&self, arrow: &ForceArrow) -> Colour {
        let theme = &self.stage.options.theme;
        let frame = &self.stage.analysis.scene.frames[self.number];
        let BodyId::Block(on) = arrow.on else {
            return theme.casing;
        };
        match self.places.get(on.0).copied().flatten() {
            Some(place) => theme.casing_on(self.fill(place, frame.placed[place]), arrow.colour),
            None => theme.casing,
        }
    }

    /// The heads of all arrows once more, above all shafts: along a line of thrust arrows lie on each other, and a shaft
    /// must not hide which way another points.
    fn heads(&self) -> Group {
        let mut group = Group {
            echo: true,
            ..Group::of_class("heads")
        };
        let marks = &self.stage.marks[self.number];
        let there = marks.arrows.iter().filter(|a| !a.kind.is_failure());
        for arrow in there.filter(|a| self.seen(a)) {
            let width = self.width(arrow);
            let (from, along) = (self.camera.place(arrow.at), self.camera.turn(arrow.reach()));
            let head = Path::filled(head(from, along, width), arrow.colour);
            group
                .items
                .push(head.cased(self.seam_around(arrow), self.casing).into());
        }
        group
    }

    pub(crate) fn turn(&self, turn: &TurnArrow) -> Path {
        let radius = TURN * self.stage.unit;
        let sweep = turn.arc / radius;
        let outline = turning(
            self.camera.place(turn.at),
            self.camera.length(radius),
            self.clearest(turn, radius, sweep) - sweep / 2.0,
            sweep,
            self.camera.length(turn.width),
        );
        Path::filled(outline, turn.colour).cased(self.stage.options.theme.casing, self.casing)
    }

    /// The direction from a turning arrow's centre to its middle in which it keeps farthest from straight arrows; the
    /// top where that is as good as any.
    fn clearest(&self, turn: &TurnArrow, radius: f64, sweep: f64) -> f64 {
        let arrows = &self.stage.marks[self.number].arrows;
        let ends = [-0.5 * sweep, 0.5 * sweep];
        let clear = |middle: f64| {
            let from_arrows = |share: f64| {
                let angle = middle + ends[0] + (ends[1] - ends[0]) * share;
                let p = turn.at + Vector::new(libm::cos(angle), libm::sin(angle)) * radius;
                arrows
                    .iter()
                    .map(|a| label::from_arrow(a, p))
                    .fold(f64::INFINITY, f64::min)
            };
            (0..9)
                .map(|i| from_arrows(f64::from(i) / 8.0))
                .fold(f64::INFINITY, f64::min)
        };
        let mut best = (clear(FRAC_PI_2), FRAC_PI_2);
        for step in [1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 6] {
            let middle = FRAC_PI_2 + f64::from(step) * FRAC_PI_2 / 3.0;
            let room = clear(middle);
            if room > best.0 + 0.02 * self.stage.unit {
                best = (room, middle);
            }
        }
        best.1
    }

    /// The arrows of what is there, or of what is missing, each with its numbers.
    pub(crate) fn arrows(&self, missing: bool) -> Group {
        let marks = &self.stage.marks[self.number];
        let mut group = Group::of_class(if missing { "failures" } else { "forces" });
        for arrow in marks
            .arrows
            .iter()
            .filter(|a| a.kind.is_failure() == missing && self.seen(a))
        {
            let title = told::arrow(self.stage, arrow);
            group.items.push(
                Group::of_class("force")
                    .titled(title)
                    .with(self.arrow(arrow))
                    .into(),
            );
        }
        for turn in marks
            .turns
            .iter()
            .filter(|t| matches!(t.kind, TurnKind::Missing(_)) == missing && self.turn_seen(t))
        {
            let title = told::turn(self.stage, turn);
            group.items.push(
                Group::of_class("torque")
                    .titled(title)
                    .with(self.turn(turn))
                    .into(),
            );
        }
        group
    }

    /// As [`Pen::arrows`] for scenes of very many blocks: one path for all arrows of a colour.
    fn arrows_by_colour(&self) -> Group {
        let mut group = Group::of_class("forces");
        let mut colours = ByColour::default();
        for arrow in self.stage.marks[self.number]
            .arrows
            .iter()
            .filter(|a| !a.kind.is_failure() && self.seen(a))
        {
            colours.add(arrow.colour, self.arrow(arrow).outline);
        }
        group.items.extend(colours.paths(None));
        group
    }
}
