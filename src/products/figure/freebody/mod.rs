//! [`freebody`]: draws the free-body diagram of a block: all forces on the block with their names, and a table of these
//! forces with their sum.
//!
//! Weight, loads, forces of other bodies and robots, and missing forces each have an arrow and a row in the list. The
//! length of the arrow shows the magnitude. A block with one interface has separate normal and friction forces at
//! each end of the interface, named as in figure 1 of the thesis ([Vallat23](crate::doc::references) §2.0.3). A block
//! with two or three interfaces has one force at each end of an interface, numbered as in figure 2 of the thesis. A
//! block with more interfaces has one force for each interface. With [`Corners::All`](super::option::Corners) the
//! arrows name every unknown force instead, even if it is zero. All arrows of normal forces then have the same length,
//! and so on for each kind of force.
//!
//! Bodies that touch the block are outlined, and ground is hatched.

mod around;
mod arrow;
mod diagram;
mod foot;
mod force;
mod heading;
mod names;
mod picture;
mod table;
mod value;

use around::{around_arrows, guided, view};
use arrow::Arrow;
use diagram::arrows;
use force::{Force, forces};
use heading::heading;

use super::option::Options;
use crate::geometry::{Bounds, Polygon};
use crate::mechanics::analysis::{Analysis, Contact};
use crate::mechanics::scene::{BlockId, BodyId};
use crate::pictures::drawing::placement::{Ink, LabelRequest};
use crate::pictures::drawing::symbol::Symbol;
use crate::pictures::drawing::{Anchor, Camera, Drawing, Face, Item, PagePoint, PageRect, Text};

/// Font size of names in the drawing, pixels.
const NAME_SIZE: f64 = 19.0;
/// Font size of the list of forces, pixels.
const LIST_SIZE: f64 = 15.0;
/// Font size of the heading, pixels.
const HEADING_SIZE: f64 = 20.0;
/// Font size of the line below the heading, pixels.
const SUBHEADING_SIZE: f64 = 15.0;
/// Largest width and height of a picture, pixels.
const MAX_PICTURE_SIZE: f64 = 440.0;
/// Space to the left of the picture for axes and names of coordinates, pixels.
const SPACE_LEFT: f64 = 74.0;
/// Space below the picture for axes and names of coordinates, pixels.
const SPACE_BELOW: f64 = 58.0;
/// Margin of the page, pixels.
const MARGIN: f64 = 24.0;
/// Width of the page if the options set none, pixels.
const DEFAULT_WIDTH: f64 = 2.0 * MARGIN + SPACE_LEFT + MAX_PICTURE_SIZE;

/// Draws the free-body diagram of a block of a frame. Frames are counted from 0. Returns `None` if the frame does not
/// exist or does not contain the block.
///
/// Units: the page is in pixels at natural size.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, figure, output, scene::BlockId};
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.6,
///     "ground": [{ "polygon": [[0, 0], [9, 3], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[3, 1], [6, 2], [6, 4], [3, 3]], "weight": 6 }] }"#)?;
/// let analysis = Analysis::new(&scene);
/// let drawing = figure::freebody(&analysis, 0, BlockId(0), &figure::Options::default()).expect("block a stands there");
/// let svg = output::svg::write(&drawing);
/// assert!(svg.contains("Normal force F_s1 on block a: 2.85 N at 108°"));
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn freebody(analysis: &Analysis, frame: usize, block: BlockId, options: &Options) -> Option<Drawing> {
    let placed = &analysis.scene.frames.get(frame)?.placed;
    if !placed.contains(&block) {
        return None;
    }
    let sheet = Sheet::new(analysis, frame, block, options);
    Some(sheet.drawing())
}

/// The page of a free-body diagram.
struct Sheet<'a> {
    analysis: &'a Analysis,
    options: &'a Options,
    frame: usize,
    block: BlockId,
    /// The contacts of the block.
    contacts: Vec<&'a Contact>,
    view: Bounds,
    camera: Camera,
    /// Width of the page, pixels.
    width: f64,
    /// The part of the page for arrows and their names.
    picture: PageRect,
    /// The lines above the picture, each with its font and its font size in pixels.
    heading: Vec<(String, Face, f64)>,
    forces: Vec<Force>,
    arrows: Vec<Arrow>,
}

impl<'a> Sheet<'a> {
    fn new(analysis: &'a Analysis, frame: usize, block: BlockId, options: &'a Options) -> Sheet<'a> {
        let frame_analysis = &analysis.frames[frame];
        let touches = |c: &&Contact| c.interface.bodies.contains(&BodyId::Block(block));
        let contacts: Vec<&Contact> = frame_analysis.contacts.iter().filter(touches).collect();
        let view = view(analysis, block, &contacts);
        let width = options.width.unwrap_or(DEFAULT_WIDTH);
        let heading = heading(analysis, frame, block, options, width);
        let high: f64 = heading.iter().map(|h| 1.2 * h.2).sum();
        let top = MARGIN + if heading.is_empty() { 0.0 } else { high + 10.0 };
        let forces = forces(analysis, frame, block, &contacts, options);
        let guided = guided(analysis, frame, block, &contacts);
        let left = if guided { MARGIN + SPACE_LEFT } else { MARGIN };
        let room = (width - MARGIN - left).max(60.0);
        // Arrows and their names need margins (`pads`) around the shown part of the scene. Compute the scale for the
        // space between these margins.
        let fitted = |pads: [f64; 4]| {
            let across = (room - pads[0] - pads[2]).max(40.0) / view.width();
            let scale = across.min(MAX_PICTURE_SIZE / view.height());
            let scale = if scale.is_finite() { scale } else { 1.0 };
            let spare = room - pads[0] - pads[2] - view.width() * scale;
            let at = PagePoint::new(left + pads[0] + spare.max(0.0) / 2.0, top + pads[1]);
            Camera::new(view, at, scale)
        };
        let mut pads = [0.0; 4];
        for _ in 0..4 {
            let camera = fitted(pads);
            let arrows = arrows(analysis, (frame, block), &contacts, &forces, &camera, options);
            pads = around_arrows(&camera.rect(view), &arrows, &camera);
        }
        let camera = fitted(pads);
        let shown = camera.rect(view);
        Sheet {
            arrows: arrows(analysis, (frame, block), &contacts, &forces, &camera, options),
            forces,
            analysis,
            options,
            frame,
            block,
            contacts,
            view,
            camera,
            width,
            picture: PageRect { at: PagePoint::new(left, top), width: room, height: shown.height + pads[1] + pads[3] },
            heading,
        }
    }

    /// Returns the y coordinate of the lower edge of the picture on the page, in pixels.
    fn floor(&self) -> f64 {
        self.picture.at.y + self.picture.height
    }

    fn polygon(&self) -> &Polygon {
        &self.analysis.scene.blocks[self.block.0].body.polygon
    }

    fn name(&self) -> &str {
        &self.analysis.scene.blocks[self.block.0].id
    }

    fn guides(&self) -> bool {
        guided(self.analysis, self.frame, self.block, &self.contacts)
    }

    fn drawing(&self) -> Drawing {
        let theme = &self.options.theme;
        let mut items: Vec<Item> = Vec::new();
        let title = format!("Block {} cut free", self.name());
        let mut y = MARGIN - 4.0;
        for (line, face, size) in &self.heading {
            y += 1.2 * size;
            let at = PagePoint::new(self.width / 2.0, y);
            let words = Text::new(at, line.as_str(), *face, *size, theme.ink);
            items.push(words.anchored(Anchor::Middle).into());
        }
        let mut ink = Ink::default();
        items.push(self.neighbours(&mut ink).into());
        items.push(self.body(&mut ink).into());
        let mut requests: Vec<(Symbol, LabelRequest)> = Vec::new();
        if self.guides() {
            items.push(self.guide_lines(&mut ink, &mut requests).into());
        }
        items.push(self.drawn(&mut ink, &mut requests).into());
        items.push(self.axes(&mut ink).into());
        let (names, nameless) = self.names(&mut ink, &requests);
        items.push(names.into());
        let (values, end) = self.values(self.floor() + SPACE_BELOW + 8.0, nameless);
        items.push(values.into());
        Drawing {
            width: self.width.ceil(),
            height: (end + MARGIN).ceil(),
            title,
            description: self.described(),
            background: Some(theme.page),
            items,
        }
    }
}
