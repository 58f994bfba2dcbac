//! [`freebody`]: draws the free-body diagram of a block: all forces on it with their names, and a list of the forces
//! with their sum.
//!
//! Weight, loads, forces of other bodies and robots, and missing forces each have an arrow and a row in the list. The
//! length of the arrow shows the magnitude. A block with one interface has separate normal and friction forces at each
//! end, named as in figure 1 of the thesis ([Vallat23](crate::doc::references) §2.0.3). With two or three interfaces
//! each end has one force, numbered as in its figure 2. With more, each interface has one force. With
//! [`Corners::All`](super::option::Corners) the arrows name every unknown of the program instead, even if it is zero.
//! All arrows of a kind then have the same length.
//!
//! Bodies that touch the block are outlined, and ground is hatched.

mod apart;
mod around;
mod arrow;
mod diagram;
mod foot;
mod force;
mod heading;
mod table;
mod value;

use around::{around_arrows, corners, distinct, guided, neighbours, runs_on, view};
use arrow::Arrow;
use diagram::arrows;
use force::{Force, forces};
use heading::heading;

use super::option::Options;
use crate::analysis::{Analysis, Contact};
use crate::drawing::arrow::{straight, turning};
use crate::drawing::hatch::{hatch, lines};
use crate::drawing::placement::{Ink, LabelRequest, place, place_avoiding};
use crate::drawing::symbol::{Accent, Symbol};
use crate::drawing::{
    Anchor, Camera, Drawing, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text,
    text,
};
use crate::figure::arrow::LEAST_SEEN;
use crate::geometry::{Bounds, Point, Polygon};
use crate::scene::{BlockId, BodyId};

/// Font size of names in the drawing, pixels.
const NAME: f64 = 19.0;
/// Font size of the list below it, pixels.
const AMOUNT: f64 = 15.0;
/// Font size of the heading, pixels.
const HEADING: f64 = 20.0;
/// Font size of the line below the heading, pixels.
const SUBHEADING: f64 = 15.0;
/// Largest width and height of a picture, pixels.
const LARGEST: f64 = 440.0;
/// Space to the left of the picture for axes and names of coordinates, pixels.
const ASIDE: f64 = 74.0;
/// Space below the picture for axes and names of coordinates, pixels.
const BELOW: f64 = 58.0;
/// Largest number of names of forces, and of bodies, in a picture.
const MOST_NAMES: usize = 150;
/// Margin of the page, pixels.
const MARGIN: f64 = 24.0;
/// Width of the page if the options give none, pixels.
const PAGE: f64 = 2.0 * MARGIN + ASIDE + LARGEST;
/// Distance of hatching lines, pixels.
const HATCH: f64 = 7.0;

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
pub fn freebody(
    analysis: &Analysis,
    frame: usize,
    block: BlockId,
    options: &Options,
) -> Option<Drawing> {
    let placed = &analysis.scene.frames.get(frame)?.placed;
    if !placed.contains(&block) {
        return None;
    }
    let sheet = Sheet::new(analysis, frame, block, options);
    Some(sheet.drawing())
}

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
    /// The lines above the drawing, with face and font size.
    heading: Vec<(String, Face, f64)>,
    forces: Vec<Force>,
    arrows: Vec<Arrow>,
}

impl<'a> Sheet<'a> {
    fn new(
        analysis: &'a Analysis,
        frame: usize,
        block: BlockId,
        options: &'a Options,
    ) -> Sheet<'a> {
        let found = &analysis.frames[frame];
        let touches = |c: &&Contact| c.interface.bodies.contains(&BodyId::Block(block));
        let contacts: Vec<&Contact> = found.contacts.iter().filter(touches).collect();
        let view = view(analysis, block, &contacts);
        let width = options.width.unwrap_or(PAGE);
        let heading = heading(analysis, frame, block, options, width);
        let high: f64 = heading.iter().map(|h| 1.2 * h.2).sum();
        let top = MARGIN + if heading.is_empty() { 0.0 } else { high + 10.0 };
        let forces = forces(analysis, frame, block, &contacts, options);
        let guided = guided(analysis, frame, block, &contacts);
        let left = if guided { MARGIN + ASIDE } else { MARGIN };
        let room = (width - MARGIN - left).max(60.0);
        // Arrows and their names need space (`pads`) around the shown part; compute the scale that remains.
        let fitted = |pads: [f64; 4]| {
            let across = (room - pads[0] - pads[2]).max(40.0) / view.width();
            let scale = across.min(LARGEST / view.height());
            let scale = if scale.is_finite() { scale } else { 1.0 };
            let spare = room - pads[0] - pads[2] - view.width() * scale;
            let at = PagePoint::new(left + pads[0] + spare.max(0.0) / 2.0, top + pads[1]);
            Camera::new(view, at, scale)
        };
        let mut pads = [0.0; 4];
        for _ in 0..4 {
            let camera = fitted(pads);
            let arrows = arrows(analysis, block, &contacts, &forces, &camera, options);
            pads = around_arrows(&camera.rect(view), &arrows, &camera);
        }
        let camera = fitted(pads);
        let shown = camera.rect(view);
        Sheet {
            arrows: arrows(analysis, block, &contacts, &forces, &camera, options),
            forces,
            analysis,
            options,
            frame,
            block,
            contacts,
            view,
            camera,
            width,
            picture: PageRect {
                at: PagePoint::new(left, top),
                width: room,
                height: shown.height + pads[1] + pads[3],
            },
            heading,
        }
    }

    /// Returns the position of the lower edge of the picture on the page.
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
        let (values, end) = self.values(self.floor() + BELOW + 8.0, nameless);
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

    /// Draws the bodies that touch the block; ground is hatched.
    fn neighbours(&self, ink: &mut Ink) -> Group {
        let (scene, theme) = (&self.analysis.scene, &self.options.theme);
        let mut group = Group::with_class("neighbours");
        let page = self.camera.rect(self.view);
        group.clip = Some(page);
        for body in neighbours(&self.contacts, self.block) {
            let polygon = &scene.body(body).polygon;
            let outline = self.camera.polygon(polygon);
            let mut drawn = Group::with_class("body").titled(match body {
                BodyId::Ground(_) => "Ground".to_owned(),
                BodyId::Block(_) => format!("Block {}", scene.name(body)),
            });
            if let BodyId::Ground(_) = body {
                let ring = |ring: &Vec<Point>| ring.iter().map(|p| self.camera.place(*p)).collect();
                let rings: Vec<Vec<PagePoint>> = polygon.rings().iter().map(ring).collect();
                let hatching = hatch(&rings, page, HATCH);
                for [from, to] in hatching.iter().filter_map(|line| page.part_of(*line)) {
                    ink.line(from, to, 0.8);
                }
                drawn = drawn.with(Path::stroked(
                    lines(&hatching),
                    Stroke::new(theme.faint, 0.8),
                ));
            }
            self.bar(ink, polygon, page);
            drawn = drawn.with(Path::stroked(outline, Stroke::new(theme.ink, 1.3)));
            group.items.push(drawn.into());
        }
        group
    }

    fn body(&self, ink: &mut Ink) -> Group {
        let theme = &self.options.theme;
        self.bar(ink, self.polygon(), self.camera.rect(self.view));
        let outline = self.camera.polygon(self.polygon());
        Group::with_class("block")
            .titled(format!("Block {}", self.name()))
            .with(Path::filled(outline, theme.page).with_stroke(Stroke::new(theme.ink, 1.8)))
    }

    /// Adds the visible edges of a polygon to the ink, so that no name covers them.
    fn bar(&self, ink: &mut Ink, polygon: &Polygon, seen: PageRect) {
        for edge in polygon.edges() {
            let line = [edge.from, edge.to].map(|p| self.camera.place(p));
            if let Some([from, to]) = seen.part_of(line) {
                ink.line(from, to, 1.8);
            }
        }
    }

    /// Draws dashed lines from the application points and the centroid to the edges of the picture. Adds the names of
    /// their coordinates to `requests`.
    fn guide_lines(&self, ink: &mut Ink, requests: &mut Vec<(Symbol, LabelRequest)>) -> Group {
        let theme = &self.options.theme;
        let mut group = Group::with_class("guides");
        let mut described = vec![(
            "c",
            String::new(),
            self.analysis.scene.blocks[self.block.0].centroid,
        )];
        for contact in &self.contacts {
            let count = distinct(contact).len();
            for (k, corner) in corners(contact, self.block).iter().enumerate().take(count) {
                described.push(("p", (k + 1).to_string(), corner.at));
            }
        }
        let dash = || Stroke::new(theme.faint, 1.0).dashed([5.0, 4.0]);
        let (left, floor) = (self.picture.at.x, self.floor());
        for (letter, number, point) in described {
            let p = self.camera.place(point);
            let ends = [
                (PagePoint::new(left, p.y), "y"),
                (PagePoint::new(p.x, floor), "x"),
            ];
            for (end, axis) in ends {
                group = group.with(Path::stroked(Outline::line([end, p]), dash()));
                ink.line(end, p, 1.2);
                let symbol = Symbol::new(letter, Accent::None, &format!("{axis}{number}"));
                let (wide, high) = symbol.size(NAME);
                // Names that would overlap are placed in rows.
                let place = |row: f64| match axis {
                    "y" => end.moved(-6.0 - wide / 2.0 - row * (wide + 4.0), -0.08 * high),
                    _ => end.moved(0.0, 1.0 + high / 2.0 + row * (0.7 * high)),
                };
                requests.push((
                    symbol,
                    LabelRequest {
                        anchor: end,
                        first_ring: 4.0,
                        size: (wide, high),
                        preferred: (0..3).map(|row| place(f64::from(row))).collect(),
                        padding: 0.0,
                        max_distance: None,
                    },
                ));
            }
        }
        group
    }

    /// True if an arrow is long enough to be visible.
    fn seen(arrow: &Arrow) -> bool {
        let (x, y) = arrow.along;
        let length = libm::hypot(x, y);
        arrow.turn.map_or(length, |sweep| length * sweep.abs()) >= LEAST_SEEN
    }

    fn drawn(&self, ink: &mut Ink, requests: &mut Vec<(Symbol, LabelRequest)>) -> Group {
        let theme = &self.options.theme;
        let mut group = Group::with_class("forces");
        for arrow in self.arrows.iter().filter(|a| Sheet::seen(a)) {
            let from = self.camera.place(arrow.at);
            let path = match arrow.turn {
                Some(sweep) => {
                    let radius = libm::hypot(arrow.along.0, arrow.along.1);
                    ink.disc(from, radius + 1.5 * arrow.width);
                    turning(from, radius, -0.4, sweep, arrow.width)
                }
                None => {
                    ink.arrow(from, arrow.along, arrow.width);
                    straight(from, arrow.along, arrow.width)
                }
            };
            let path = if arrow.hollow {
                let edge = Stroke::new(arrow.colour, 1.1).mitred();
                Path::filled(path, theme.page).with_stroke(edge)
            } else {
                Path::filled(path, arrow.colour)
            };
            let drawn = Group::with_class("force")
                .titled(arrow.title.as_str())
                .with(path);
            group.items.push(drawn.into());
            let Some(symbol) = &arrow.symbol else {
                continue;
            };
            let (wide, high) = symbol.size(NAME);
            requests.push((
                symbol.clone(),
                LabelRequest {
                    anchor: from.moved(0.7 * arrow.along.0, 0.7 * arrow.along.1),
                    first_ring: 5.0,
                    size: (wide, high),
                    preferred: arrow.beside(from, wide, high),
                    padding: 0.0,
                    max_distance: Some(f64::INFINITY),
                },
            ));
        }
        group
    }

    fn axes(&self, ink: &mut Ink) -> Group {
        let theme = &self.options.theme;
        let origin = PagePoint::new(
            MARGIN + 4.0,
            self.floor() + if self.guides() { 30.0 } else { BELOW - 4.0 },
        );
        let mut group = Group::with_class("axes").titled("Axes: x to the right, y up");
        let ends = [
            ((40.0, 0.0), "x", (14.0, 0.0)),
            ((0.0, -40.0), "y", (0.0, -14.0)),
        ];
        for (along, name, beyond) in ends {
            ink.arrow(origin, along, 1.4);
            group = group.with(Path::filled(straight(origin, along, 1.4), theme.ink));
            let symbol = Symbol::new(name, Accent::None, "");
            let (wide, high) = symbol.size(NAME);
            let at = origin.moved(
                along.0 + beyond.0 - wide / 2.0,
                along.1 + beyond.1 - 0.62 * high,
            );
            let rect = PageRect {
                at,
                width: wide,
                height: high,
            };
            ink.rect(rect);
            group = group.with(symbol.draw(rect, NAME, theme.ink));
        }
        group
    }

    /// Draws the names of forces, coordinates and bodies. Also returns the number of names without space.
    fn names(&self, ink: &mut Ink, requests: &[(Symbol, LabelRequest)]) -> (Group, usize) {
        let theme = &self.options.theme;
        let page = PageRect {
            at: PagePoint::new(4.0, self.picture.at.y - 6.0),
            width: self.width - 8.0,
            height: self.picture.height + BELOW + 2.0,
        };
        // A picture has no space for more names, so do not try to place them.
        let (requests, beyond) = requests.split_at(requests.len().min(MOST_NAMES));
        let mut nameless = beyond.len();
        ink.index();
        let mut group = Group::with_class("labels");
        let wanted: Vec<LabelRequest> = requests.iter().map(|w| w.1.clone()).collect();
        for ((symbol, _), placed) in requests.iter().zip(place(ink, page, &wanted)) {
            let Some(placed) = placed else {
                nameless += 1;
                continue;
            };
            let mut label = Group::with_class("name");
            if let Some(leader) = placed.leader {
                let line = Path::stroked(Outline::line(leader), Stroke::new(theme.faint, 0.7));
                label = label.with(line);
            }
            group
                .items
                .push(label.with(symbol.draw(placed.rect, NAME, theme.ink)).into());
        }
        let scene = &self.analysis.scene;
        let others = neighbours(&self.contacts, self.block);
        let blocks = others
            .iter()
            .copied()
            .filter(|b| matches!(b, BodyId::Block(_)));
        let mut blocks: Vec<BodyId> = blocks.collect();
        nameless += blocks.len().saturating_sub(MOST_NAMES);
        blocks.truncate(MOST_NAMES);
        for body in blocks.into_iter().chain([BodyId::Block(self.block)]) {
            let name = scene.name(body);
            let size = (text::width(name, Face::SerifItalic, NAME), 0.96 * NAME);
            // The name of the block itself may be placed outside it, with a leader. The other names are only placed
            // inside their blocks.
            let own = body == BodyId::Block(self.block);
            let middle = scene.body(body).polygon.centroid();
            let request = LabelRequest {
                anchor: self.camera.place(middle),
                first_ring: 4.0,
                size,
                preferred: self.inside(&scene.body(body).polygon),
                padding: 8.0,
                max_distance: own.then_some(f64::INFINITY),
            };
            let room = if own {
                page
            } else {
                self.camera.rect(self.view)
            };
            // Inside another body the name would seem to be the name of that body. The heading names the block in any
            // case.
            let covers_other_block = |_: usize, rect: PageRect| {
                let at = rect.at.moved(rect.width / 2.0, rect.height / 2.0);
                let at = self.camera.back(at);
                let mut others = others.iter().filter(|other| **other != body);
                others.any(|other| {
                    let polygon = &scene.body(*other).polygon;
                    polygon.contains(at) || runs_on(at, self.view, polygon.bounds())
                })
            };
            match place_avoiding(ink, room, &[request], &covers_other_block)[0]
                .filter(|p| !p.avoided)
            {
                Some(placed) => {
                    if let Some(leader) = placed.leader {
                        let line = Outline::line(leader);
                        let line = Path::stroked(line, Stroke::new(theme.faint, 0.7));
                        group.items.push(line.into());
                    }
                    let at = placed.rect.at.moved(0.0, 0.8 * NAME);
                    let words = Text::new(at, name, Face::SerifItalic, NAME, theme.faint);
                    group
                        .items
                        .push(Group::with_class("name").with(words).into());
                }
                None => nameless += 1,
            }
        }
        (group, nameless)
    }

    /// Returns positions on the page inside the visible part of a body, those nearest to its middle first.
    fn inside(&self, polygon: &Polygon) -> Vec<PagePoint> {
        let (bounds, view) = (polygon.bounds(), self.view);
        let (min, max) = (bounds.min.sup(&view.min), bounds.max.inf(&view.max));
        let mut places = Vec::new();
        for i in 0..225 {
            let share = |k: i32| (f64::from(k) + 0.5) / 15.0;
            let size = max - min;
            let p =
                min + crate::geometry::Vector::new(size.x * share(i % 15), size.y * share(i / 15));
            if polygon.contains(p) {
                places.push(p);
            }
        }
        let middle = nalgebra::center(&min, &max);
        places.sort_by(|a, b| (a - middle).norm().total_cmp(&(b - middle).norm()));
        places.into_iter().map(|p| self.camera.place(p)).collect()
    }
}
