//! Places the names of forces, coordinates and bodies of a free-body diagram, so that they do not cover other shapes.

use super::around::{neighbours, runs_on};
use super::{NAME_SIZE, SPACE_BELOW, Sheet};
use crate::geometry::{Polygon, Vector};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::placement::{Ink, LabelRequest, place, place_avoiding};
use crate::pictures::drawing::symbol::Symbol;
use crate::pictures::drawing::{Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, text};

/// Largest number of names of forces, and of bodies, in a picture.
const MAX_NAMES: usize = 150;

impl Sheet<'_> {
    /// Draws the names of forces, coordinates and bodies. Also returns the number of names for which there is no space.
    pub(super) fn names(&self, ink: &mut Ink, requests: &[(Symbol, LabelRequest)]) -> (Group, usize) {
        let mut group = Group::with_class("labels");
        // The picture has no space for more than `MAX_NAMES` names, so do not try to place the others.
        let (requests, beyond) = requests.split_at(requests.len().min(MAX_NAMES));
        let mut nameless = beyond.len();
        ink.index();
        nameless += self.name_symbols(ink, requests, &mut group);
        let others = neighbours(&self.contacts, self.block);
        let blocks = others.iter().copied();
        let blocks = blocks.filter(|body| matches!(body, BodyId::Block(_)));
        let mut blocks: Vec<BodyId> = blocks.collect();
        nameless += blocks.len().saturating_sub(MAX_NAMES);
        blocks.truncate(MAX_NAMES);
        for body in blocks.into_iter().chain([BodyId::Block(self.block)]) {
            nameless += usize::from(!self.name_body(ink, body, &others, &mut group));
        }
        (group, nameless)
    }

    /// Returns the part of the page, in pixels, in which names may be placed.
    fn page_of_names(&self) -> PageRect {
        PageRect {
            at: PagePoint::new(4.0, self.picture.at.y - 6.0),
            width: self.width - 8.0,
            height: self.picture.height + SPACE_BELOW + 2.0,
        }
    }

    /// Draws the names of forces and coordinates. Returns the number of names for which there is no space.
    fn name_symbols(&self, ink: &mut Ink, requests: &[(Symbol, LabelRequest)], group: &mut Group) -> usize {
        let mut nameless = 0;
        let label_requests: Vec<LabelRequest> = requests.iter().map(|w| w.1.clone()).collect();
        let places = place(ink, self.page_of_names(), &label_requests);
        for ((symbol, _), placed) in requests.iter().zip(places) {
            let Some(placed) = placed else {
                nameless += 1;
                continue;
            };
            let mut label = Group::with_class("name");
            if let Some(leader) = placed.leader {
                label = label.with(self.leader(leader));
            }
            let label = label.with(symbol.draw(placed.rect, NAME_SIZE, self.options.theme.ink));
            group.items.push(label.into());
        }
        nameless
    }

    /// Draws the name of a body. `others` are the bodies that touch the block. Returns false if the picture has no
    /// space for the name.
    ///
    /// The name of the block itself may be placed outside the block, with a leader. The names of other bodies are only
    /// placed inside these bodies.
    fn name_body(&self, ink: &mut Ink, body: BodyId, others: &[BodyId], group: &mut Group) -> bool {
        let scene = &self.analysis.scene;
        let name = scene.name(body);
        let polygon = &scene.body(body).polygon;
        let own = body == BodyId::Block(self.block);
        let request = LabelRequest {
            anchor: self.camera.place(polygon.centroid()),
            first_ring: 4.0,
            size: (text::width(name, Face::SerifItalic, NAME_SIZE), 0.96 * NAME_SIZE),
            preferred: self.inside(polygon),
            with_leader: Vec::new(),
            padding: 8.0,
            max_distance: own.then_some(f64::INFINITY),
        };
        let room = if own { self.page_of_names() } else { self.camera.rect(self.view) };
        // Never place the name inside another body, because it would look like the name of that body. If there is no
        // other position, the name is left out. The heading names the block of the diagram anyway.
        let covers_other_block = |_: usize, rect: PageRect| {
            let at = rect.at.moved(rect.width / 2.0, rect.height / 2.0);
            let at = self.camera.back(at);
            let mut others = others.iter().filter(|other| **other != body);
            others.any(|other| {
                let polygon = &scene.body(*other).polygon;
                polygon.contains(at) || runs_on(at, self.view, polygon.bounds())
            })
        };
        let placed = place_avoiding(ink, room, &[request], &covers_other_block)[0];
        let Some(placed) = placed.filter(|placed| !placed.avoided) else {
            return false;
        };
        if let Some(leader) = placed.leader {
            group.items.push(self.leader(leader).into());
        }
        let at = placed.rect.at.moved(0.0, 0.8 * NAME_SIZE);
        let words = Text::new(at, name, Face::SerifItalic, NAME_SIZE, self.options.theme.faint);
        let label = Group::with_class("name").with(words);
        group.items.push(label.into());
        true
    }

    /// Draws the line from a name to the object that it names.
    fn leader(&self, ends: [PagePoint; 2]) -> Path {
        let stroke = Stroke::new(self.options.theme.faint, 0.7);
        Path::stroked(Outline::line(ends), stroke)
    }

    /// Returns positions on the page inside the visible part of a body, sorted by their distances from the middle of
    /// this part.
    fn inside(&self, polygon: &Polygon) -> Vec<PagePoint> {
        let (bounds, view) = (polygon.bounds(), self.view);
        let (min, max) = (bounds.min.sup(&view.min), bounds.max.inf(&view.max));
        let mut places = Vec::new();
        for i in 0..225 {
            let share = |k: i32| (f64::from(k) + 0.5) / 15.0;
            let size = max - min;
            let p = min + Vector::new(size.x * share(i % 15), size.y * share(i / 15));
            if polygon.contains(p) {
                places.push(p);
            }
        }
        let middle = nalgebra::center(&min, &max);
        places.sort_by(|a, b| (a - middle).norm().total_cmp(&(b - middle).norm()));
        places.into_iter().map(|p| self.camera.place(p)).collect()
    }
}
