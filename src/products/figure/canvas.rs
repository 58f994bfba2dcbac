//! [`Canvas`]: the picture of one frame. A kind of figure puts [`Mark`]s and [`Label`]s on it. The canvas knows from
//! them where labels may lie, which entries the legend needs, and how much space the picture takes.
//!
//! Lengths of the design are millimetres on paper ([`Look::mm`]); positions on the canvas are pixels.

use core::cell::OnceCell;
use std::rc::Rc;

use super::design::{ArrowSize, Key, Layer, Look, Mark, around, colour, unit};
use super::displacement::{Course, Displacement};
use super::moving::Moving;
use super::option::{ArrowScale, Options};
use super::placing::{self, Label, Surroundings};
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::{Analysis, FrameAnalysis, SolvedFrame, ThrustState, ThrustStates};
use crate::mechanics::scene::{BlockId, BodyId, Frame, Scene};
use crate::pictures::drawing::style::ForceMarks;
use crate::pictures::drawing::{Camera, Colour, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Theme};
use crate::products::wording::number::quantity;

/// If a frame has more blocks than this, shapes with the same paint are one path without tooltips. Thousands of
/// elements would make a file slow to open.
const MANY_BLOCKS: usize = 1000;
/// A shape is only joined to one of this many paths before it, so that a picture of many colours takes linear time.
const JOINED_PATHS: usize = 64;

/// Results of one frame that take long. All pictures of the figure share them, and so do frames that share their results.
#[derive(Default)]
pub(crate) struct Shared {
    /// The paths of the blocks in the collapses that the figure shows.
    pub courses: OnceCell<Vec<Course>>,
    /// The motion that the figure shows of the frame.
    pub moving: OnceCell<Moving>,
    /// The forces of the largest kernel.
    pub central: OnceCell<Option<ThrustState>>,
    /// The extremes between which the forces of the frame may lie.
    pub thrust: OnceCell<ThrustStates>,
}

/// The picture of one frame while a kind of figure draws it.
pub(crate) struct Canvas<'a> {
    pub analysis: &'a Analysis,
    /// The index of the frame, from 0.
    pub number: usize,
    pub options: &'a Options,
    /// The results of every frame that the pictures share.
    pub shared: &'a [Rc<Shared>],
    pub camera: Camera,
    pub look: Look,
    /// The length of a force in the one scale of the figure, pixels per newton.
    pub scale: f64,
    /// Whether loads and missing forces have this scale too.
    pub shares_scale: bool,
    /// The blocks of all frames, or the part of the scene that is shown, pixels.
    pub structure: PageRect,
    /// The fill of each placed block, in placing order, with the meaning of its colour in words; empty for plain blocks.
    pub fills: Vec<(Colour, String)>,
    /// The part of the canvas outside of which marks are cut off; `None` if nothing is cut off.
    pub window: Option<PageRect>,
    /// The displacements of the blocks, indexed by block; `None` for a block that is drawn where it stands. The list may
    /// be shorter than the number of blocks.
    pub displaced: Vec<Option<Displacement>>,
    /// The part of the ground that is drawn where it moves to, and its displacement.
    pub moved_ground: Option<(usize, Displacement)>,
    /// The x coordinate of a line between two drawings, which no label crosses, pixels.
    pub gutter: Option<f64>,
    /// The words after the verdict, if the figure finds them while it draws.
    pub words: Option<Vec<String>>,
    /// The blocks that these words mention.
    pub mentioned: Vec<BlockId>,
    marks: Vec<Mark>,
    labels: Vec<Label>,
    notes: Vec<Rc<Key>>,
}

/// A finished picture.
pub(crate) struct Picture {
    pub group: Group,
    /// The smallest rectangle around everything that is drawn.
    pub extent: PageRect,
    /// The entries that the legend needs.
    pub keys: Vec<Rc<Key>>,
    /// What a screen reader says about the picture; empty for only the verdict.
    pub description: String,
    /// The words after the verdict, if the figure found them while it drew.
    pub words: Option<Vec<String>>,
    /// A list below the picture, centred at x = 0 below y = 0, and its height, pixels.
    pub list: (Group, f64),
}

impl<'a> Canvas<'a> {
    /// Creates an empty canvas on which `view` (metres) begins at (0, 0), with `zoom` pixels per metre.
    pub fn new(
        analysis: &'a Analysis,
        (number, shared): (usize, &'a [Rc<Shared>]),
        options: &'a Options,
        look: Look,
        (view, zoom): (Bounds, f64),
        scale: f64,
    ) -> Canvas<'a> {
        let camera = Camera::new(view, PagePoint::new(0.0, 0.0), zoom);
        let structure = camera.rect(view);
        let (marks, labels, notes) = (Vec::new(), Vec::new(), Vec::new());
        let (window, displaced, fills, words, mentioned) = (None, Vec::new(), Vec::new(), None, Vec::new());
        Canvas {
            analysis,
            number,
            options,
            shared,
            camera,
            look,
            scale,
            shares_scale: false,
            structure,
            fills,
            window,
            displaced,
            moved_ground: None,
            gutter: None,
            words,
            mentioned,
            marks,
            labels,
            notes,
        }
    }

    /// Returns the frame of the picture, with its results and the scene to which they belong.
    pub fn solved(&self) -> SolvedFrame<'a> {
        self.analysis.at(self.number)
    }

    pub fn scene(&self) -> &'a Scene {
        self.solved().scene
    }

    pub fn frame(&self) -> &'a Frame {
        self.solved().frame()
    }

    pub fn found(&self) -> &'a FrameAnalysis {
        self.solved().found
    }

    pub fn theme(&self) -> &'a Theme {
        &self.options.theme
    }

    /// Returns the fill of a block: that of the scene, or that of its place in the placing order, from 0.
    pub fn fill(&self, place: usize, id: BlockId) -> Colour {
        let own = self.scene().blocks[id.0].body.fill.map(colour);
        own.or_else(|| self.fills.get(place).map(|fill| fill.0)).unwrap_or(self.theme().block)
    }

    /// Converts a point of the scene to its position on the canvas.
    pub fn place(&self, point: Point) -> PagePoint {
        self.camera.place(point)
    }

    /// Returns the results of this frame that its pictures share.
    pub fn own(&self) -> &'a Shared {
        &self.shared[self.number]
    }

    /// Returns the displacement of a block; `None` if it is drawn where it stands.
    pub fn displacement(&self, block: BlockId) -> Option<&Displacement> {
        self.displaced.get(block.0)?.as_ref()
    }

    /// Converts a point of a body, which moves with the body, to its position on the canvas.
    pub fn place_on(&self, body: BodyId, point: Point) -> PagePoint {
        self.place(self.displacement_of(body).map_or(point, |moved| moved.moved(point)))
    }

    fn displacement_of(&self, body: BodyId) -> Option<&Displacement> {
        match body {
            BodyId::Block(block) => self.displacement(block),
            BodyId::Ground(part) => self.moved_ground.as_ref().filter(|moved| moved.0 == part).map(|moved| &moved.1),
        }
    }

    /// Converts a direction that turns with a body to a direction on the canvas, of the same length.
    pub fn turn_on(&self, body: BodyId, direction: Vector) -> (f64, f64) {
        let turned = self.displacement_of(body).map_or(direction, |moved| moved.turned(direction));
        (turned.x, -turned.y)
    }

    /// Converts millimetres of the design to pixels.
    pub fn mm(&self, length: f64) -> f64 {
        self.look.mm(length)
    }

    /// Returns a line `width` mm wide.
    pub fn pen(&self, colour: Colour, width: f64) -> Stroke {
        Stroke::new(colour, self.mm(width))
    }

    /// Returns a dashed line: its width, and the lengths of a dash and of a gap, in mm.
    pub fn dashes(&self, colour: Colour, width: f64, dash: [f64; 2]) -> Stroke {
        self.pen(colour, width).dashed(dash.map(|length| self.mm(length)))
    }

    /// Returns a disc around `at`. `radius` is in mm.
    pub fn disc(&self, at: PagePoint, radius: f64, fill: Colour) -> Path {
        Path::filled(Outline::circle(at, self.mm(radius)), fill)
    }

    /// Returns the sizes of an arrow `length` pixels long: the width of its shaft, and the width and the length of its
    /// head, in mm. The head takes at most the fraction `most` of the arrow.
    pub fn arrow(&self, length: f64, [shaft, wide, long]: [f64; 3], most: f64) -> ArrowSize {
        ArrowSize { length, shaft: self.mm(shaft), head: (self.mm(wide), self.mm(long).min(most * length)) }
    }

    /// Returns the unit length of the blocks, pixels.
    pub fn unit(&self) -> f64 {
        self.camera.length(unit(self.scene(), self.options.zoom))
    }

    /// Converts a number of unit lengths to pixels, with a least and a largest value in mm.
    pub fn in_units(&self, (units, least, most): (f64, f64, f64)) -> f64 {
        (units * self.unit()).clamp(self.mm(least), self.mm(most))
    }

    /// Returns the font size of labels, pixels.
    pub fn label_size(&self) -> f64 {
        self.look.text * self.theme().sizes.amount
    }

    /// True if loads, missing forces, robots and the largest force have labels with their amounts.
    pub fn states_amounts(&self) -> bool {
        self.options.labels && self.options.main_amounts
    }

    /// Writes a force in the unit of the scene.
    pub fn newtons(&self, newtons: f64) -> String {
        quantity(newtons, self.scene().units.force())
    }

    /// True if all panels have the same scale of forces. In the look of the thesis, each panel has its own.
    pub fn has_one_scale(&self) -> bool {
        !self.look.is_strip || self.options.scale == ArrowScale::Strip || self.theme().forces != ForceMarks::Blocks
    }

    /// True if the frame has so many blocks that single marks have no tooltips.
    pub fn many(&self) -> bool {
        self.frame().placed.len() > MANY_BLOCKS
    }

    /// Puts a mark on the canvas, above the marks of lower layers and the earlier marks of its layer.
    pub fn put(&mut self, mark: Mark) {
        if !mark.shapes.is_empty() {
            self.marks.push(mark);
        }
    }

    /// Adds an entry to the legend that explains no mark.
    pub fn note(&mut self, rank: u8, words: &str) {
        self.notes.push(Key::new(rank, words, Vec::new(), 0.0));
    }

    /// Adds an entry to the legend, whether or not it explains a mark.
    pub fn explain(&mut self, key: Rc<Key>) {
        self.notes.push(key);
    }

    /// Returns the smallest rectangle around the structure and all marks that are already drawn, pixels.
    pub fn extent(&self) -> PageRect {
        if let Some(window) = self.window {
            return window;
        }
        let points = self.marks.iter().flat_map(|mark| &mark.shapes).flat_map(|path| path.outline.points());
        around(points.chain(corners(self.structure))).unwrap_or(self.structure)
    }

    /// Returns the right edge of all marks that are already drawn, pixels.
    pub fn extent_of_marks(&self) -> f64 {
        let points = self.marks.iter().flat_map(|mark| &mark.shapes).flat_map(|path| path.outline.points());
        points.map(|p| p.x).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Asks for a label. Labels are placed when the picture is finished.
    pub fn label(&mut self, label: Label) {
        self.labels.push(label);
    }

    /// Places the labels and returns the picture.
    pub fn finish(mut self) -> Picture {
        let mut labels = core::mem::take(&mut self.labels);
        if let Some(window) = self.window {
            let seen = |p: &PagePoint| overlaps(window, PageRect { at: *p, width: 0.0, height: 0.0 });
            self.marks.retain(|mark| {
                let rect = around(mark.shapes.iter().flat_map(|path| path.outline.points()));
                mark.layer == Layer::Around || rect.is_some_and(|rect| overlaps(window, rect))
            });
            // Labels beside the window belong to its dimensions.
            let near = self.mm(12.0);
            let beside = |p: &PagePoint| {
                let at = PagePoint::new(p.x - near, p.y - near);
                overlaps(window, PageRect { at, width: 2.0 * near, height: 2.0 * near })
            };
            labels.retain(|label| label.anchors.iter().any(seen) || label.fixed.as_ref().is_some_and(beside));
        }
        let mut surroundings = Surroundings::new(&self.marks, self.structure, !self.fills.is_empty(), self.look);
        surroundings.gutter = self.gutter;
        let placed = placing::labels(labels, &surroundings, self.look, self.options);
        let shown = |mark: &&Mark| self.window.is_none() || mark.layer == Layer::Around;
        let points = self.marks.iter().filter(shown).flat_map(|mark| &mark.shapes);
        let points = points.flat_map(|path| path.outline.points());
        let around_all = points.chain(placed.rects.iter().flat_map(|rect| corners(*rect)));
        let extent = around(around_all.chain(self.window.iter().flat_map(|window| corners(*window))));
        let extent = extent.unwrap_or(self.structure);
        let mut keys: Vec<Rc<Key>> = self.marks.iter().filter_map(|mark| mark.key.clone()).collect();
        keys.append(&mut self.notes);
        keys.sort_by_key(|key| key.rank);
        keys.dedup_by_key(|key| key.rank);
        let many = self.many();
        let mut group = Group { camera: Some(self.camera), ..Group::with_class("picture") };
        let mut layers = Layer::ALL.map(|(_, class)| Group::with_class(class));
        if many {
            layers[Layer::Stone as usize].title = format!("{} blocks", self.frame().placed.len());
        }
        let mut bulk: Vec<(usize, Path)> = Vec::new();
        for mark in self.marks {
            let layer = mark.layer as usize;
            if many && mark.layer <= Layer::Symbol {
                mark.shapes.into_iter().for_each(|path| merge(&mut bulk, layer, path));
                continue;
            }
            let items = mark.shapes.into_iter().map(Item::from).collect();
            let drawn = Group { description: mark.description, items, ..Group::with_class(mark.class) };
            layers[layer].items.push(drawn.titled(mark.title).into());
        }
        for (layer, path) in bulk {
            layers[layer].items.push(path.into());
        }
        for (mut layer, (which, _)) in layers.into_iter().zip(Layer::ALL) {
            layer.clip = self.window.filter(|_| which != Layer::Around);
            if !layer.items.is_empty() {
                group.items.push(layer.into());
            }
        }
        if !placed.items.is_empty() {
            group.items.push(Group { items: placed.items, ..Group::with_class("labels") }.into());
        }
        Picture { group, extent, keys, description: String::new(), words: self.words, list: (Group::default(), 0.0) }
    }
}

/// Returns two opposite corners of a rectangle.
pub(crate) fn corners(rect: PageRect) -> [PagePoint; 2] {
    [rect.at, rect.at.moved(rect.width, rect.height)]
}

/// True if two rectangles share a point.
fn overlaps(a: PageRect, b: PageRect) -> bool {
    a.at.x <= b.at.x + b.width
        && b.at.x <= a.at.x + a.width
        && a.at.y <= b.at.y + b.height
        && b.at.y <= a.at.y + a.height
}

/// Adds a path to a path of its layer with the same paint, if there is one among the last [`JOINED_PATHS`].
fn merge(bulk: &mut Vec<(usize, Path)>, layer: usize, path: Path) {
    let same = |other: &Path| {
        (other.fill, other.fill_last) == (path.fill, path.fill_last)
            && other.stroke == path.stroke
            && other.opacity.to_bits() == path.opacity.to_bits()
    };
    let recent = bulk.iter_mut().rev().filter(|(at, _)| *at == layer).take(JOINED_PATHS);
    match recent.map(|(_, other)| other).find(|other| same(other)) {
        Some(other) => other.outline.extend(path.outline),
        None => bulk.push((layer, path)),
    }
}
