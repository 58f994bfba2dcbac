//! Draws the picture of a free-body diagram: the block, the bodies that touch it, the arrows of the forces, the axes,
//! and the dashed lines from points to the axes. Each function adds its shapes to the [`Ink`], which names must not
//! cover.

use super::around::{corners, distinct, neighbours};
use super::arrow::Arrow;
use super::{MARGIN, NAME_SIZE, SPACE_BELOW, Sheet};
use crate::geometry::{Point, Polygon};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::arrow::{straight, turning};
use crate::pictures::drawing::hatch::{hatch, lines};
use crate::pictures::drawing::placement::{Ink, LabelRequest};
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::pictures::drawing::{Group, Outline, PagePoint, PageRect, Path, Stroke};
use crate::products::figure::arrow::MIN_VISIBLE_ARROW;

/// Distance of hatching lines, pixels.
const HATCH_SPACING: f64 = 7.0;
/// Width of the border that separates an arrow from an outline below it, pixels.
const CASING: f64 = 0.8;

impl Sheet<'_> {
    /// Draws the outlines of the bodies that touch the block. Ground is hatched.
    pub(super) fn neighbours(&self, ink: &mut Ink) -> Group {
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
                let hatching = hatch(&rings, page, HATCH_SPACING);
                for [from, to] in hatching.iter().filter_map(|line| page.part_of(*line)) {
                    ink.line(from, to, 0.8);
                }
                drawn = drawn.with(Path::stroked(lines(&hatching), Stroke::new(theme.faint, 0.8)));
            }
            self.add_edges(ink, polygon, page);
            drawn = drawn.with(Path::stroked(outline, Stroke::new(theme.ink, 1.3)));
            group.items.push(drawn.into());
        }
        group
    }

    /// Draws the block: its outline, filled with the colour of the page.
    pub(super) fn body(&self, ink: &mut Ink) -> Group {
        let theme = &self.options.theme;
        self.add_edges(ink, self.polygon(), self.camera.rect(self.view));
        let outline = self.camera.polygon(self.polygon());
        Group::with_class("block")
            .titled(format!("Block {}", self.name()))
            .with(Path::filled(outline, theme.page).with_stroke(Stroke::new(theme.ink, 1.8)))
    }

    /// Adds the visible parts of the edges of a polygon to the ink, so that no name covers them. `seen` is the visible
    /// part of the page.
    fn add_edges(&self, ink: &mut Ink, polygon: &Polygon, seen: PageRect) {
        for edge in polygon.edges() {
            let line = [edge.from, edge.to].map(|p| self.camera.place(p));
            if let Some([from, to]) = seen.part_of(line) {
                ink.line(from, to, 1.8);
            }
        }
    }

    /// Draws dashed lines from the application points and the centroid to the left and lower edges of the picture. Adds
    /// the names of their coordinates, such as `c_x`, to `requests`.
    pub(super) fn guide_lines(&self, ink: &mut Ink, requests: &mut Vec<(Symbol, LabelRequest)>) -> Group {
        let theme = &self.options.theme;
        let mut group = Group::with_class("guides");
        let mut described = vec![("c", String::new(), self.analysis.scene.blocks[self.block.0].centroid)];
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
            let ends = [(PagePoint::new(left, p.y), "y"), (PagePoint::new(p.x, floor), "x")];
            for (end, axis) in ends {
                group = group.with(Path::stroked(Outline::line([end, p]), dash()));
                ink.line(end, p, 1.2);
                let symbol = Symbol::new(letter, Accent::None, &format!("{axis}{number}"));
                let (wide, high) = symbol.size(NAME_SIZE);
                // If names would overlap at the axis, they get different distances from it: each name has three
                // possible rows.
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
                        with_leader: Vec::new(),
                        padding: 0.0,
                        max_distance: None,
                    },
                ));
            }
        }
        group
    }

    /// True if an arrow is long enough to be visible.
    pub(super) fn seen(arrow: &Arrow) -> bool {
        let (x, y) = arrow.along;
        let length = libm::hypot(x, y);
        arrow.turn.map_or(length, |sweep| length * sweep.abs()) >= MIN_VISIBLE_ARROW
    }

    /// Draws the arrows of the forces and torques that are long enough to be visible, those of missing forces above the
    /// others. Adds the names of the forces to `requests`.
    pub(super) fn drawn(&self, ink: &mut Ink, requests: &mut Vec<(Symbol, LabelRequest)>) -> Group {
        let theme = &self.options.theme;
        let mut group = Group::with_class("forces");
        let seen = self.arrows.iter().filter(|a| Sheet::seen(a));
        let (missing, others): (Vec<&Arrow>, Vec<&Arrow>) = seen.partition(|a| a.missing);
        for arrow in others.into_iter().chain(missing) {
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
                Path::filled(path, arrow.colour).cased(theme.page, CASING)
            };
            let drawn = Group::with_class("force").titled(arrow.title.as_str()).with(path);
            group.items.push(drawn.into());
            let Some(symbol) = &arrow.symbol else {
                continue;
            };
            let (wide, high) = symbol.size(NAME_SIZE);
            requests.push((
                symbol.clone(),
                LabelRequest {
                    anchor: from.moved(0.7 * arrow.along.0, 0.7 * arrow.along.1),
                    first_ring: 5.0,
                    size: (wide, high),
                    preferred: arrow.beside(from, wide, high),
                    with_leader: Vec::new(),
                    padding: 0.0,
                    max_distance: Some(f64::INFINITY),
                },
            ));
        }
        group
    }

    /// Draws two arrows below the picture that show the directions of the x and y axes.
    pub(super) fn axes(&self, ink: &mut Ink) -> Group {
        let theme = &self.options.theme;
        let origin = PagePoint::new(MARGIN + 4.0, self.floor() + if self.guides() { 30.0 } else { SPACE_BELOW - 4.0 });
        let mut group = Group::with_class("axes").titled("Axes: x to the right, y up");
        let ends = [((40.0, 0.0), "x", (14.0, 0.0)), ((0.0, -40.0), "y", (0.0, -14.0))];
        for (along, name, beyond) in ends {
            ink.arrow(origin, along, 1.4);
            group = group.with(Path::filled(straight(origin, along, 1.4), theme.ink));
            let symbol = Symbol::new(name, Accent::None, "");
            let (wide, high) = symbol.size(NAME_SIZE);
            let at = origin.moved(along.0 + beyond.0 - wide / 2.0, along.1 + beyond.1 - 0.62 * high);
            let rect = PageRect { at, width: wide, height: high };
            ink.rect(rect);
            group = group.with(symbol.draw(rect, NAME_SIZE, theme.ink));
        }
        group
    }
}
