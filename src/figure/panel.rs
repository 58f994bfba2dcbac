//! One frame drawn: ground, blocks, plans, arrows block by block, robots, and what fails on top of all.

use core::f64::consts::FRAC_PI_2;

use super::fill::FillScale;
use super::label;
use super::mark::{ArrowKind, ForceArrow, TurnArrow, TurnKind};
use super::stage::{DISC, MANY, Stage};
use super::words::{force, quantity};
use crate::drawing::arrow::{straight, turning};
use crate::drawing::{Anchor, Camera, Colour, Face, Group, Outline, Path, Stroke, Text, text};
use crate::geometry::Lattice;
use crate::scene::{Block, BlockId, Body, BodyId, Rgb};

/// Radius of a turning arrow in unit edges: around a robot's disc.
const TURN: f64 = 0.46;

/// What the camera sees of frame `number`.
pub(crate) fn picture(stage: &Stage<'_>, number: usize, camera: &Camera) -> Group {
    let pen = Pen::of(stage, number, camera);
    let many = stage.analysis.scene.frames[number].placed.len() > MANY;
    let mut group = Group::of_class("picture");
    group.items.push(pen.ground().into());
    group.items.push(
        if many {
            pen.blocks_by_colour()
        } else {
            pen.blocks()
        }
        .into(),
    );
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
    group.items.push(pen.arrows(true).into());
    group
        .items
        .retain(|item| !matches!(item, crate::drawing::Item::Group(g) if g.items.is_empty()));
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

struct Pen<'a> {
    stage: &'a Stage<'a>,
    number: usize,
    camera: &'a Camera,
    /// Width of an outline, pixels.
    line: f64,
    /// Width of the seam around arrows, pixels.
    casing: f64,
}

impl<'a> Pen<'a> {
    fn of(stage: &'a Stage<'a>, number: usize, camera: &'a Camera) -> Pen<'a> {
        let unit = camera.length(stage.unit);
        Pen {
            stage,
            number,
            camera,
            line: (0.028 * unit).clamp(0.25, 1.5),
            casing: (0.016 * unit).clamp(0.1, 1.0),
        }
    }

    fn unit(&self) -> f64 {
        self.camera.length(self.stage.unit)
    }

    fn ground(&self) -> Group {
        let theme = &self.stage.options.theme;
        let scene = self.stage.analysis.scene;
        let mut group = Group::of_class("ground").titled("Ground");
        if scene.ground.is_empty() {
            return group;
        }
        group.clip = Some(self.camera.rect(self.stage.view));
        for ground in &scene.ground {
            let fill = ground.body.fill.map_or(theme.ground, colour);
            let outline = self.camera.polygon(&ground.body.polygon);
            group.items.push(
                Path::filled(outline, fill)
                    .with_stroke(Stroke::new(theme.outline, self.line))
                    .into(),
            );
        }
        group
    }

    fn fill(&self, place: usize, id: BlockId) -> Colour {
        let scene = self.stage.analysis.scene;
        match scene.blocks[id.0].body.fill {
            Some(fill) => colour(fill),
            None => self
                .stage
                .options
                .theme
                .amplitude(self.stage.fills.shares[self.number][place]),
        }
    }

    fn seam(&self, fill: Colour) -> Stroke {
        // A touch lighter or darker than the block: visible on any fill, never louder than an outline.
        let theme = &self.stage.options.theme;
        let towards = if fill.brightness() < 0.5 {
            theme.page
        } else {
            theme.ink
        };
        Stroke::new(fill.mixed(towards, 0.22), 0.6 * self.line)
    }

    fn blocks(&self) -> Group {
        let (scene, theme) = (self.stage.analysis.scene, &self.stage.options.theme);
        let frame = &scene.frames[self.number];
        let mut group = Group::of_class("blocks");
        for (place, id) in frame.placed.iter().enumerate() {
            let block = &scene.blocks[id.0];
            let fill = self.fill(place, *id);
            let outline = self.camera.polygon(&block.body.polygon);
            let mut body = Group::of_class("block").titled(format!("Block {}", block.id));
            body.description = self.told(place, block);
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
        group.items.extend(self.names().into_iter().map(Into::into));
        group
    }

    /// A block's numbers in words.
    fn told(&self, place: usize, block: &Block) -> String {
        let share = self.stage.fills.shares[self.number][place];
        let fill = match self.stage.fills.scale {
            FillScale::Limit(limit) => {
                format!(
                    "colour: {:.1} % of the robots' limit of {}",
                    100.0 * share,
                    quantity(limit, "N")
                )
            }
            FillScale::Largest(largest) => format!("colour: {}", quantity(share * largest, "N")),
        };
        format!("weight {}, {fill}", quantity(block.weight, "N"))
    }

    fn names(&self) -> Vec<Text> {
        let size = (0.25 * self.unit()).clamp(0.0, 14.0);
        if !self.stage.options.labels || size < 8.0 {
            return Vec::new();
        }
        let scene = self.stage.analysis.scene;
        let frame = &scene.frames[self.number];
        let half = |id: BlockId| text::width(&scene.blocks[id.0].id, Face::SansBold, size) / 2.0;
        let metres = self.stage.unit / self.unit();
        let radius = |id: BlockId| libm::hypot(half(id), 0.38 * size) * metres;
        let places = label::places(self.stage, frame, &self.stage.marks[self.number], radius);
        let name = |(place, (id, at)): (usize, (&BlockId, Option<crate::geometry::Point>))| {
            let fill = self.fill(place, *id);
            let ink = if fill.brightness() < 0.55 {
                Colour::WHITE
            } else {
                Colour::BLACK
            };
            let at = self.camera.place(at?).moved(0.0, 0.36 * size);
            let words = scene.blocks[id.0].id.as_str();
            Some(
                Text::new(at, words, Face::SansBold, size, fill.mixed(ink, 0.75))
                    .anchored(Anchor::Middle),
            )
        };
        frame
            .placed
            .iter()
            .zip(places)
            .enumerate()
            .filter_map(name)
            .collect()
    }

    /// As [`Pen::blocks`] for scenes of very many blocks: one path for all blocks of a colour.
    fn blocks_by_colour(&self) -> Group {
        let (scene, theme) = (self.stage.analysis.scene, &self.stage.options.theme);
        let frame = &scene.frames[self.number];
        let mut group = Group::of_class("blocks").titled(format!("{} blocks", frame.placed.len()));
        let mut colours: Vec<(Colour, Outline)> = Vec::new();
        for (place, id) in frame.placed.iter().enumerate() {
            let fill = self.fill(place, *id);
            let outline = self.camera.polygon(&scene.blocks[id.0].body.polygon);
            match colours.iter_mut().find(|c| c.0 == fill) {
                Some(known) => known.1.extend(outline),
                None => colours.push((fill, outline)),
            }
        }
        for (fill, outline) in colours {
            group.items.push(
                Path::filled(outline, fill)
                    .with_stroke(Stroke::new(theme.outline, self.line))
                    .into(),
            );
        }
        group
    }

    fn plans(&self) -> Group {
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

    fn discs(&self) -> Group {
        let (scene, theme) = (self.stage.analysis.scene, &self.stage.options.theme);
        let mut group = Group::of_class("robots");
        for hold in &scene.frames[self.number].holds {
            let disc = Outline::circle(self.camera.place(hold.at), DISC * self.unit());
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

    fn arrow(&self, arrow: &ForceArrow) -> Path {
        let width = self.camera.length(arrow.width);
        let outline = straight(
            self.camera.place(arrow.at),
            self.camera.turn(arrow.vector),
            width,
        );
        Path::filled(outline, arrow.colour).cased(self.stage.options.theme.casing, self.casing)
    }

    fn turn(&self, turn: &TurnArrow) -> Path {
        let radius = TURN * self.stage.unit;
        let sweep = (turn.arc.abs() / radius).clamp(0.7, 5.0) * turn.arc.signum();
        let outline = turning(
            self.camera.place(turn.at),
            self.camera.length(radius),
            FRAC_PI_2 - sweep / 2.0,
            sweep,
            self.camera.length(turn.width),
        );
        Path::filled(outline, turn.colour).cased(self.stage.options.theme.casing, self.casing)
    }

    /// The arrows of what is there, or of what is missing, each with its numbers.
    fn arrows(&self, missing: bool) -> Group {
        let marks = &self.stage.marks[self.number];
        let mut group = Group::of_class(if missing { "failures" } else { "forces" });
        for arrow in marks
            .arrows
            .iter()
            .filter(|a| a.kind.is_failure() == missing)
        {
            let title = self.arrow_told(arrow);
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
            .filter(|t| matches!(t.kind, TurnKind::Missing(_)) == missing)
        {
            let title = self.turn_told(turn);
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
        let mut colours: Vec<(Colour, Outline)> = Vec::new();
        for arrow in self.stage.marks[self.number]
            .arrows
            .iter()
            .filter(|a| !a.kind.is_failure())
        {
            let outline = self.arrow(arrow).outline;
            match colours.iter_mut().find(|c| c.0 == arrow.colour) {
                Some(known) => known.1.extend(outline),
                None => colours.push((arrow.colour, outline)),
            }
        }
        group.items.extend(
            colours
                .into_iter()
                .map(|(fill, outline)| Path::filled(outline, fill).into()),
        );
        group
    }

    fn arrow_told(&self, arrow: &ForceArrow) -> String {
        let scene = self.stage.analysis.scene;
        let named = |id: BodyId| match id {
            BodyId::Ground(_) => "the ground".to_owned(),
            BodyId::Block(_) => format!("block {}", scene.name(id)),
        };
        let robot = |id: crate::scene::RobotId| format!("robot {}", scene.robots[id.0].id);
        let (on, amount) = (named(arrow.on), force(arrow.force));
        let torque = quantity(arrow.force.norm() * self.stage.unit, "N·m");
        match arrow.kind {
            ArrowKind::Weight => format!("Weight of {on}: {amount}"),
            ArrowKind::Load => format!("Load on {on}: {amount}"),
            ArrowKind::Contact(from) => format!("Force on {on} from {}: {amount}", named(from)),
            ArrowKind::Normal(from) => {
                format!("Normal force on {on} from {}: {amount}", named(from))
            }
            ArrowKind::Friction(from) => {
                format!("Friction force on {on} from {}: {amount}", named(from))
            }
            ArrowKind::Robot(id) => format!("Force on {on} from {}: {amount}", robot(id)),
            ArrowKind::RobotTorque(id) => format!("Torque on {on} from {}: {torque}", robot(id)),
            ArrowKind::MissingPull(from) => {
                format!("Missing pull on {on} from {}: {amount}", named(from))
            }
            ArrowKind::MissingFriction(from) => {
                format!("Missing friction on {on} from {}: {amount}", named(from))
            }
            ArrowKind::MissingRobotForce(id) => {
                format!("Missing force on {on} from {}: {amount}", robot(id))
            }
            ArrowKind::MissingTorque(id) => {
                format!("Missing torque on {on} from {}: {torque}", robot(id))
            }
        }
    }

    fn turn_told(&self, turn: &TurnArrow) -> String {
        let scene = self.stage.analysis.scene;
        let direction = if turn.torque > 0.0 {
            "anticlockwise"
        } else {
            "clockwise"
        };
        let amount = format!("{} {direction}", quantity(turn.torque.abs(), "N·m"));
        let on = scene.name(turn.on);
        match turn.kind {
            TurnKind::Load => format!("Torque of a load on block {on}: {amount}"),
            TurnKind::Robot(id) => format!(
                "Torque on block {on} from robot {}: {amount}",
                scene.robots[id.0].id
            ),
            TurnKind::Missing(id) => {
                format!(
                    "Missing torque on block {on} from robot {}: {amount}",
                    scene.robots[id.0].id
                )
            }
        }
    }
}
