//! [`freebody`]: one block cut free, with every force that may act on it by name, and what each amounts to.
//!
//! At each application point of each interface stand the three forces of the program: the normal force along ŝ, and
//! friction to the left and to the right of it ([Vallat23](crate::doc::references) §2.0.3). The arrows name unknowns, so
//! all of a kind are equally long; amounts stand below the drawing. Bodies that touch the block are outlined, ground is
//! hatched.

mod around;
mod force;
mod value;

use around::{distinct, neighbours, view};
use force::{Force, forces};
use value::{Piece, rows};

use super::option::Options;
use super::verdict;
use crate::analysis::{Analysis, Contact};
use crate::drawing::arrow::{straight, turning};
use crate::drawing::hatch::{hatch, lines};
use crate::drawing::placement::{Ink, Wish, place};
use crate::drawing::symbol::{Accent, Symbol};
use crate::drawing::{
    Anchor, Camera, Drawing, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text,
    text,
};
use crate::geometry::{Bounds, Point, Polygon};
use crate::scene::{BlockId, BodyId};

/// Size of names in the drawing, pixels.
const NAME: f64 = 19.0;
/// Size of amounts below it, pixels.
const AMOUNT: f64 = 15.0;
/// Size of the heading, pixels.
const HEADING: f64 = 20.0;
/// Widest and highest a picture becomes, pixels.
const LARGEST: f64 = 440.0;
/// Room to the left of the picture and below it, for axes and the names of coordinates, pixels.
const ASIDE: f64 = 74.0;
/// Room around everything, pixels.
const MARGIN: f64 = 24.0;
/// Width of the page where none is asked for, pixels.
const PAGE: f64 = 2.0 * MARGIN + ASIDE + LARGEST;
/// Distance of hatching lines, pixels.
const HATCH: f64 = 7.0;

/// One block of a frame cut free; `None` where the frame, from 0, has no such block.
///
/// Units: the page is in pixels at natural size.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, figure, output, scene::BlockId};
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.6,
///     "ground": [{ "polygon": [[0, 0], [9, 3], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[3, 1], [6, 2], [6, 4], [3, 3]], "weight": 6 }] }"#)?;
/// let analysis = Analysis::of(&scene);
/// let drawing = figure::freebody(&analysis, 0, BlockId(0), &figure::Options::default()).expect("block a stands there");
/// let svg = output::svg::write(&drawing);
/// assert!(svg.contains("Normal force F_s1 on block a"));
/// # Ok::<(), drystone::scene::Problems>(())
/// ```
pub fn freebody(
    analysis: &Analysis<'_>,
    frame: usize,
    block: BlockId,
    options: &Options,
) -> Option<Drawing> {
    let placed = &analysis.scene.frames.get(frame)?.placed;
    if !placed.contains(&block) {
        return None;
    }
    let sheet = Sheet::of(analysis, frame, block, options);
    Some(sheet.drawing())
}

struct Sheet<'a> {
    analysis: &'a Analysis<'a>,
    options: &'a Options,
    frame: usize,
    block: BlockId,
    /// What touches the block.
    contacts: Vec<&'a Contact>,
    view: Bounds,
    camera: Camera,
    /// Width of the page, pixels.
    width: f64,
    /// Where the picture's lower edge lies on the page.
    floor: f64,
    forces: Vec<Force>,
}

impl<'a> Sheet<'a> {
    fn of(
        analysis: &'a Analysis<'a>,
        frame: usize,
        block: BlockId,
        options: &'a Options,
    ) -> Sheet<'a> {
        let found = &analysis.frames[frame];
        let touches = |c: &&Contact| c.interface.bodies.contains(&BodyId::Block(block));
        let contacts: Vec<&Contact> = found.contacts.iter().filter(touches).collect();
        let view = view(analysis, block, &contacts);
        let width = options.width.unwrap_or(PAGE);
        let room = (width - 2.0 * MARGIN - ASIDE).max(60.0);
        let scale = (room / view.width()).min(LARGEST / view.height());
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let heading = if options.titles { HEADING + 22.0 } else { 0.0 };
        let aside = (room - view.width() * scale) / 2.0;
        let at = PagePoint::new(MARGIN + ASIDE + aside.max(0.0), MARGIN + heading);
        let camera = Camera::new(view, at, scale);
        Sheet {
            forces: forces(analysis, frame, block, &contacts, &camera, options),
            analysis,
            options,
            frame,
            block,
            contacts,
            view,
            camera,
            width,
            floor: at.y + view.height() * scale,
        }
    }

    fn polygon(&self) -> &Polygon {
        &self.analysis.scene.blocks[self.block.0].body.polygon
    }

    fn name(&self) -> &str {
        &self.analysis.scene.blocks[self.block.0].id
    }

    /// Coordinates are told where they stay readable: of a block on one edge, held by nobody.
    fn guides(&self) -> bool {
        let held = self.analysis.scene.frames[self.frame]
            .holds
            .iter()
            .any(|h| h.block == self.block);
        self.contacts.len() == 1 && !held
    }

    fn drawing(&self) -> Drawing {
        let theme = &self.options.theme;
        let mut items: Vec<Item> = Vec::new();
        let title = format!("Block {} cut free", self.name());
        let mut y = MARGIN - 4.0;
        for line in heading(self.analysis, self.block, self.options, self.width) {
            y += 1.2 * HEADING;
            let at = PagePoint::new(self.width / 2.0, y);
            let words = Text::new(at, line, Face::SerifBold, HEADING, theme.ink);
            items.push(words.anchored(Anchor::Middle).into());
        }
        let mut ink = Ink::default();
        items.push(self.neighbours(&mut ink).into());
        items.push(self.body(&mut ink).into());
        let mut wishes: Vec<(Symbol, Wish)> = Vec::new();
        if self.guides() {
            items.push(self.guide_lines(&mut ink, &mut wishes).into());
        }
        items.push(self.arrows(&mut ink, &mut wishes).into());
        items.push(self.axes(&mut ink).into());
        items.push(self.names(&mut ink, &wishes).into());
        let below = if self.guides() { 58.0 } else { 40.0 };
        let (values, end) = self.values(self.floor + below);
        items.push(values.into());
        Drawing {
            width: self.width.ceil(),
            height: (end + MARGIN).ceil(),
            title,
            description: self.told(),
            background: Some(theme.page),
            items,
        }
    }

    /// The bodies the block touches, ground hatched.
    fn neighbours(&self, ink: &mut Ink) -> Group {
        let (scene, theme) = (self.analysis.scene, &self.options.theme);
        let mut group = Group::of_class("neighbours");
        let page = self.camera.rect(self.view);
        group.clip = Some(page);
        for body in neighbours(&self.contacts, self.block) {
            let polygon = &scene.body(body).polygon;
            let outline = self.camera.polygon(polygon);
            let mut drawn = Group::of_class("body").titled(match body {
                BodyId::Ground(_) => "Ground".to_owned(),
                BodyId::Block(_) => format!("Block {}", scene.name(body)),
            });
            if let BodyId::Ground(_) = body {
                let ring = |ring: &Vec<Point>| ring.iter().map(|p| self.camera.place(*p)).collect();
                let rings: Vec<Vec<PagePoint>> = polygon.rings().iter().map(ring).collect();
                let hatching = hatch(&rings, page, HATCH);
                for [from, to] in &hatching {
                    ink.line(*from, *to, 0.8);
                }
                drawn = drawn.with(Path::stroked(
                    lines(&hatching),
                    Stroke::new(theme.faint, 0.8),
                ));
            }
            self.bar(ink, polygon);
            drawn = drawn.with(Path::stroked(outline, Stroke::new(theme.ink, 1.3)));
            group.items.push(drawn.into());
        }
        group
    }

    fn body(&self, ink: &mut Ink) -> Group {
        let theme = &self.options.theme;
        self.bar(ink, self.polygon());
        let outline = self.camera.polygon(self.polygon());
        Group::of_class("block")
            .titled(format!("Block {}", self.name()))
            .with(Path::filled(outline, theme.page).with_stroke(Stroke::new(theme.ink, 1.8)))
    }

    /// Keeps names off an outline.
    fn bar(&self, ink: &mut Ink, polygon: &Polygon) {
        for edge in polygon.edges() {
            let (from, to) = (self.camera.place(edge.from), self.camera.place(edge.to));
            ink.line(from, to, 1.8);
        }
    }

    /// Dashed lines from the application points and the centroid to the edges of the picture, and names for their ends.
    fn guide_lines(&self, ink: &mut Ink, wishes: &mut Vec<(Symbol, Wish)>) -> Group {
        let theme = &self.options.theme;
        let mut group = Group::of_class("guides");
        let mut told = vec![(
            "c",
            String::new(),
            self.analysis.scene.blocks[self.block.0].centroid,
        )];
        for contact in &self.contacts {
            for (k, point) in distinct(contact).into_iter().enumerate() {
                told.push(("p", (k + 1).to_string(), point));
            }
        }
        let dash = || Stroke::new(theme.faint, 1.0).dashed([5.0, 4.0]);
        let (left, floor) = (self.camera.place(self.view.min).x, self.floor);
        for (letter, number, point) in told {
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
                // Names that would meet stand in rows one behind the other.
                let place = |row: f64| match axis {
                    "y" => end.moved(-6.0 - wide / 2.0 - row * (wide + 4.0), -0.08 * high),
                    _ => end.moved(0.0, 1.0 + high / 2.0 + row * (0.7 * high)),
                };
                wishes.push((
                    symbol,
                    Wish {
                        anchor: end,
                        from: 4.0,
                        size: (wide, high),
                        preferred: (0..3).map(|row| place(f64::from(row))).collect(),
                        ease: 0.0,
                        roams: false,
                    },
                ));
            }
        }
        group
    }

    fn arrows(&self, ink: &mut Ink, wishes: &mut Vec<(Symbol, Wish)>) -> Group {
        let mut group = Group::of_class("forces");
        for force in &self.forces {
            let path = match force.turn {
                Some(sweep) => {
                    let radius = libm::hypot(force.along.0, force.along.1);
                    ink.disc(force.from, radius + 1.5 * force.width);
                    turning(force.from, radius, -0.4, sweep, force.width)
                }
                None => {
                    ink.arrow(force.from, force.along, force.width);
                    straight(force.from, force.along, force.width)
                }
            };
            let path = Path::filled(path, force.colour);
            let drawn = Group::of_class("force")
                .titled(force.told.as_str())
                .with(path);
            group.items.push(drawn.into());
            let (wide, high) = force.symbol.size(NAME);
            wishes.push((
                force.symbol.clone(),
                Wish {
                    anchor: force.from.moved(force.along.0, force.along.1),
                    from: 5.0,
                    size: (wide, high),
                    preferred: force.beside(wide, high),
                    ease: 0.0,
                    roams: true,
                },
            ));
        }
        group
    }

    fn axes(&self, ink: &mut Ink) -> Group {
        let theme = &self.options.theme;
        let origin = PagePoint::new(
            MARGIN + 4.0,
            self.floor + if self.guides() { 30.0 } else { 18.0 },
        );
        let mut group = Group::of_class("axes").titled("Axes: x to the right, y up");
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

    /// The names of forces and coordinates, and of the bodies where there is room.
    fn names(&self, ink: &mut Ink, wishes: &[(Symbol, Wish)]) -> Group {
        let theme = &self.options.theme;
        let page = PageRect {
            at: PagePoint::new(2.0, self.camera.place(self.view.max).y - 16.0),
            width: self.width - 4.0,
            height: self.floor - self.camera.place(self.view.max).y + 72.0,
        };
        let mut group = Group::of_class("labels");
        let wanted: Vec<Wish> = wishes.iter().map(|w| w.1.clone()).collect();
        for ((symbol, _), placed) in wishes.iter().zip(place(ink, page, &wanted)) {
            let Some(placed) = placed else { continue };
            let mut label = Group::of_class("name");
            if let Some(leader) = placed.leader {
                let line = Path::stroked(Outline::line(leader), Stroke::new(theme.faint, 0.7));
                label = label.with(line);
            }
            group
                .items
                .push(label.with(symbol.draw(placed.rect, NAME, theme.ink)).into());
        }
        let scene = self.analysis.scene;
        let others = neighbours(&self.contacts, self.block);
        let blocks = others.into_iter().filter(|b| matches!(b, BodyId::Block(_)));
        for body in blocks.chain([BodyId::Block(self.block)]) {
            let name = scene.name(body);
            let size = (text::width(name, Face::SerifItalic, NAME), 0.96 * NAME);
            let wish = Wish {
                anchor: page.at,
                from: 0.0,
                size,
                preferred: self.inside(&scene.body(body).polygon),
                ease: 8.0,
                roams: false,
            };
            if let Some(placed) = place(ink, self.camera.rect(self.view), &[wish])[0] {
                let at = placed.rect.at.moved(0.0, 0.8 * NAME);
                let words = Text::new(at, name, Face::SerifItalic, NAME, theme.faint);
                group.items.push(Group::of_class("name").with(words).into());
            }
        }
        group
    }

    /// Places inside what the picture shows of a body, those nearest to their middle first.
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

    /// What everything amounts to, from `top` down; and where it ends.
    fn values(&self, top: f64) -> (Group, f64) {
        let theme = &self.options.theme;
        let (scene, found) = (self.analysis.scene, &self.analysis.frames[self.frame]);
        let mut group = Group::of_class("values");
        if !self.options.keys {
            return (group, top);
        }
        let middle = self.width / 2.0;
        let word = verdict::word(found.verdict);
        let what = if scene.frames[self.frame].placed.len() > 1 {
            format!("block {}: the structure {word}", self.name())
        } else {
            word.to_owned()
        };
        let wide = text::width(&what, Face::SansBold, 13.5);
        let start = PagePoint::new(middle - wide / 2.0 - 10.0, top + 10.0);
        let colour = verdict::colour(found.verdict, theme);
        group = group
            .with(verdict::mark(found.verdict, start, 7.5, theme))
            .with(Text::new(
                start.moved(13.0, 0.35 * 13.5),
                what,
                Face::SansBold,
                13.5,
                colour,
            ));
        let mut y = top + 44.0;
        let room = self.width - 2.0 * MARGIN;
        let values = value::values(
            self.analysis,
            self.frame,
            self.block,
            &self.contacts,
            self.guides(),
        );
        for row in rows(&values, AMOUNT, room) {
            let wide: f64 = value::width(&row, AMOUNT);
            let mut at = PagePoint::new(middle - wide / 2.0, y);
            for piece in row {
                let (items, width) = piece.draw(at, AMOUNT, theme);
                group.items.extend(items);
                at = at.moved(width, 0.0);
            }
            y += 1.55 * AMOUNT;
        }
        (group, y)
    }

    fn told(&self) -> String {
        let forces: Vec<&str> = self.forces.iter().map(|f| f.told.as_str()).collect();
        let values = value::values(
            self.analysis,
            self.frame,
            self.block,
            &self.contacts,
            self.guides(),
        );
        let said: Vec<String> = values
            .iter()
            .map(|value| value.iter().map(Piece::said).collect())
            .collect();
        format!("{}. {}.", forces.join(". "), said.join("; "))
    }
}

/// What stands above the drawing: the scene's title, or the block's name.
fn heading(analysis: &Analysis<'_>, block: BlockId, options: &Options, width: f64) -> Vec<String> {
    if !options.captions {
        return Vec::new();
    }
    let title = match analysis.scene.title.as_str() {
        "" => format!("Block {} cut free", analysis.scene.blocks[block.0].id),
        title => title.to_owned(),
    };
    let room = width - 2.0 * MARGIN;
    let lines = text::wrap(&title, Face::SerifBold, HEADING, room);
    text::cut(lines, 3, Face::SerifBold, HEADING, room)
}
