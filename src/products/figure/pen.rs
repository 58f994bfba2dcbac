//! [`Pen`]: draws the ground, the blocks, the planned blocks and the robots of a frame. The module `stroke` draws the
//! arrows.

mod listed;
mod stroke;

use super::arrow::ForceArrow;
use super::by_colour::ByColour;
use super::context::{FigureContext, MANY_BLOCKS};
use super::description;
pub(crate) use super::design::colour;
use super::displacement::Displacement;
pub(crate) use super::stage::seams;
use crate::geometry::{Bounds, Point};
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::{Camera, Colour, Group, Outline, PagePoint, Path, Stroke};

/// Radius of the ring at the tail of a weight, as a multiple of its shaft's width.
pub(crate) const CENTROID_RADIUS: f64 = 1.25;
/// Radius of dots in the legend, and of the space that labels leave around small missing forces, pixels.
pub(crate) const DOT_RADIUS: f64 = 2.8;

/// Radius of the dot of a missing force that is too small for an arrow, pixels.
pub(crate) const MISSING_RADIUS: f64 = 1.6;

/// If the unit length is shorter than this, pixels, single arrows cannot be read, and small symbols on arrows are left
/// out.
pub(crate) const MIN_READABLE_UNIT_LENGTH: f64 = 20.0;
/// Opacity of the fill of a displaced block.
pub(crate) const DISPLACED_OPACITY: f64 = 0.38;
/// If the unit length is at least this long, pixels, outlines have their full width.
const FULL_OUTLINE_UNIT_LENGTH: f64 = 1.5 / 0.028;
/// If the unit length is at least this long, pixels, borders of arrows have their full width.
const FULL_CASING_UNIT_LENGTH: f64 = 0.9 / 0.012;
/// Shafts narrower than this, pixels, are drawn wider, by a factor of at most 1.35, unless blocks are very small.
const MIN_SHAFT_WIDTH: f64 = 2.5;

/// Draws the parts of the picture of one frame.
pub(crate) struct Pen<'a> {
    pub context: &'a FigureContext<'a>,
    /// The index of the frame, from 0.
    pub number: usize,
    pub camera: &'a Camera,
    /// The position of each block in the placing order, from 0, indexed by block; `None` for a block that is not
    /// placed.
    places: Vec<Option<usize>>,
    /// The displacements of the blocks, indexed by block; `None` for a block that is not displaced. The list may be
    /// shorter than the number of blocks.
    displaced: &'a [Option<Displacement>],
    /// Width of an outline, pixels.
    pub line: f64,
    /// Width of the border of arrows, pixels.
    casing: f64,
    /// Factor on the width of arrows. It is above 1 at small scales, so that colours can be distinguished.
    wider: f64,
}

impl<'a> Pen<'a> {
    pub(crate) fn new(context: &'a FigureContext<'a>, number: usize, camera: &'a Camera) -> Pen<'a> {
        let unit = camera.length(context.unit);
        let (scene, widths) = (&context.analysis.scene, &context.options.theme.widths);
        let mut places = vec![None; scene.blocks.len()];
        for (place, id) in scene.frames[number].placed.iter().enumerate() {
            places[id.0] = Some(place);
        }
        Pen {
            places,
            displaced: &context.displaced[number],
            context,
            number,
            camera,
            line: (unit / FULL_OUTLINE_UNIT_LENGTH).clamp(1.0 / 6.0, 1.0) * widths.outline,
            casing: (unit / FULL_CASING_UNIT_LENGTH).clamp(1.0 / 9.0, 1.0) * widths.casing,
            // If blocks are very small on the page, wider arrows would hide them.
            wider: if unit < MIN_READABLE_UNIT_LENGTH {
                1.0
            } else {
                (MIN_SHAFT_WIDTH / (widths.force * unit)).clamp(1.0, 1.35)
            },
        }
    }

    /// Returns the unit length in pixels.
    pub(crate) fn unit(&self) -> f64 {
        self.camera.length(self.context.unit)
    }

    pub(crate) fn ground(&self, view: Bounds) -> Group {
        let theme = &self.context.options.theme;
        let scene = &self.context.analysis.scene;
        let mut group = Group::with_class("ground").titled("Ground");
        if scene.ground.is_empty() {
            return group;
        }
        group.clip = Some(self.camera.rect(view));
        let mut colours = ByColour::default();
        for ground in &scene.ground {
            let fill = ground.body.fill.map_or(theme.ground, colour);
            colours.add(fill, self.camera.polygon(&ground.body.polygon));
        }
        group.items.extend(colours.paths(Some(Stroke::new(theme.outline, self.line))));
        group
    }

    /// Returns the displacement of a block; `None` if the block is not displaced.
    pub(crate) fn displacement(&self, id: BlockId) -> Option<&Displacement> {
        self.displaced.get(id.0)?.as_ref()
    }

    /// Returns the displaced position of a point of a block, metres. If the block is not displaced, returns the point.
    pub(crate) fn moved(&self, id: BlockId, point: Point) -> Point {
        self.displacement(id).map_or(point, |d| d.moved(point))
    }

    /// True if the frame has so many blocks that all shapes of one colour are drawn as one path without tooltips.
    pub(crate) fn many(&self) -> bool {
        self.context.analysis.scene.frames[self.number].placed.len() > MANY_BLOCKS
    }

    fn fill(&self, place: usize, id: BlockId) -> Colour {
        let scene = &self.context.analysis.scene;
        if self.displacement(id).is_some() {
            let theme = &self.context.options.theme;
            return theme.page.mixed(theme.motion, DISPLACED_OPACITY);
        }
        match scene.blocks[id.0].body.fill {
            Some(fill) => colour(fill),
            None if self.context.plain() => self.context.options.theme.block,
            None => {
                let share = self.context.fills.shares[self.number][place];
                self.context.fills.colour(&self.context.options.theme, share)
            }
        }
    }

    /// Returns the fill colour at a position on the page: that of a block, of the ground, or of the empty page. The
    /// colour of a label is chosen so that it has a contrast with this colour.
    pub(crate) fn below(&self, at: PagePoint) -> Colour {
        let (scene, theme) = (&self.context.analysis.scene, &self.context.options.theme);
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

    /// Returns the radius of a robot's disc, in pixels.
    pub(crate) fn disc(&self) -> f64 {
        self.context.options.theme.widths.disc * self.unit()
    }

    /// Returns the drawn width of an arrow's shaft in pixels. At small scales, shafts are drawn wider so that their
    /// colours can be distinguished. Exceptions are missing forces, and scales so small that wider arrows would hide
    /// the blocks.
    pub(crate) fn width(&self, arrow: &ForceArrow) -> f64 {
        let wider = if arrow.kind.is_failure() { 1.0 } else { self.wider };
        wider * self.camera.length(arrow.width)
    }

    /// Returns the stroke of the lines between the lattice cells of a block with this fill colour.
    fn seam(&self, fill: Colour) -> Stroke {
        Stroke::new(self.context.options.theme.seam_on(fill, 0.22), 0.6 * self.line)
    }

    /// Draws the blocks that are not displaced, each with a tooltip, and the contacts that the scene file lists. In
    /// frames with very many blocks, draws only the blocks, without separate tooltips.
    pub(crate) fn blocks(&self) -> Group {
        if self.many() {
            return self.blocks_by_colour();
        }
        let (scene, theme) = (&self.context.analysis.scene, &self.context.options.theme);
        let frame = &scene.frames[self.number];
        let mut group = Group::with_class("blocks");
        for (place, id) in frame.placed.iter().enumerate() {
            if self.displacement(*id).is_some() {
                continue;
            }
            let block = &scene.blocks[id.0];
            let fill = self.fill(place, *id);
            let outline = self.camera.polygon(&block.body.polygon);
            let mut body = Group::with_class("block").titled(format!("Block {}", block.id));
            body.description = description::block(self.context, self.number, place, block);
            body = body.with(Path::filled(outline.clone(), fill));
            let seams = seams(&block.body, scene.lattice, self.camera);
            body = body.with(Path::stroked(seams, self.seam(fill)));
            let mut edge = Stroke::new(theme.outline, self.line);
            if block.body.is_schematic {
                edge = edge.dashed([4.0, 3.0]);
                body = body.with(self.centre(block.centroid));
            }
            group.items.push(body.with(Path::stroked(outline, edge)).into());
        }
        if scene.lists_contacts() {
            group.items.push(self.listed_contacts().into());
        }
        group
    }

    /// Draws the blocks that are not displaced, for frames with very many blocks: all blocks of one colour are one
    /// path.
    fn blocks_by_colour(&self) -> Group {
        let (scene, theme) = (&self.context.analysis.scene, &self.context.options.theme);
        let frame = &scene.frames[self.number];
        let mut group = Group::with_class("blocks").titled(format!("{} blocks", frame.placed.len()));
        let mut colours = ByColour::default();
        for (place, id) in frame.placed.iter().enumerate() {
            if self.displacement(*id).is_some() {
                continue;
            }
            let outline = self.camera.polygon(&scene.blocks[id.0].body.polygon);
            colours.add(self.fill(place, *id), outline);
        }
        group.items.extend(colours.paths(Some(Stroke::new(theme.outline, self.line))));
        group
    }

    /// Draws the outlines of the blocks that robots plan to place.
    pub(crate) fn plans(&self) -> Group {
        let scene = &self.context.analysis.scene;
        let mut group = Group::with_class("plans");
        for plan in &scene.frames[self.number].plans {
            let (block, robot) = (&scene.blocks[plan.block.0], &scene.robots[plan.robot.0]);
            let ink = self.context.options.theme.robot(plan.robot.0);
            let title = format!("Block {}, planned by robot {}", block.id, robot.id);
            let seams = seams(&block.body, scene.lattice, self.camera);
            let outline = self.camera.polygon(&block.body.polygon);
            let planned = Group::with_class("plan")
                .titled(title)
                .with(Path::stroked(seams, Stroke::new(ink, 0.9 * self.line)))
                .with(Path::stroked(outline, Stroke::new(ink, 1.8 * self.line)));
            group.items.push(planned.into());
        }
        group
    }

    /// Draws a disc for each robot at the point where it holds a block.
    pub(crate) fn discs(&self) -> Group {
        let (scene, theme) = (&self.context.analysis.scene, &self.context.options.theme);
        let mut group = Group::with_class("robots");
        for hold in &scene.frames[self.number].holds {
            let at = self.moved(hold.block, hold.at);
            let disc = Outline::circle(self.camera.place(at), self.disc());
            let title =
                format!("Robot {} holds block {}", scene.robots[hold.robot.0].id, scene.blocks[hold.block.0].id);
            let edge = theme.robot(hold.robot.0).mixed(theme.ink, 0.35);
            let path = Path::filled(disc, theme.robot(hold.robot.0)).with_stroke(Stroke::new(edge, 0.7 * self.line));
            group.items.push(Group::with_class("robot").titled(title).with(path).into());
        }
        group
    }
}
