//! Places the labels of a picture: one search and one cost for all kinds of figures.
//!
//! Labels are placed in the order of their ranks. A label tries 24 directions and 8 distances around each of its
//! anchors, and takes the position of least cost. A position on a mark or on another label is never taken. The cost
//! counts the distance, covered edges of stones, the part inside stones, near marks, and a leader.

use std::collections::BTreeMap;

use super::design::{Layer, Look, Mark, around, overlaps};
use super::option::Options;
use crate::geometry::{Aabb, BoxIndex, Point, convex_hull, range_of};
use crate::pictures::drawing::symbol::Symbol;
use crate::pictures::drawing::{
    Anchor, Colour, Face, Group, Item, Outline, PagePoint, PageRect, Path, Segment, Stroke, Text, text,
};

/// The distances from the anchor that are tried, mm.
const DISTANCES: [f64; 8] = [0.5, 1.0, 1.6, 2.4, 3.4, 4.6, 6.0, 7.5];
/// The distances that are tried if no position at the others is free, mm.
const FAR: [f64; 6] = [9.5, 12.0, 15.0, 18.5, 22.0, 26.0];
/// The number of directions that are tried.
const DIRECTIONS: u32 = 24;
/// A label farther from its anchor than this has a leader, mm.
const LEADER_DISTANCE: f64 = 1.6;
/// A shorter leader is not drawn, mm.
const LEAST_LEADER: f64 = 1.4;
/// A leader may run over the mark at its anchor for this length, mm: from the centre of the disc of a robot to its edge.
const ALONG: f64 = 1.7;
/// If the best position near the anchor costs more than this, positions farther away are tried too.
const FAR_COST: f64 = 4.0;
/// How far the halo of a label reaches beyond its text, mm.
const HALO: f64 = 0.45;
/// The cost of each mm of the edges of stones under a label.
const EDGE_COST: f64 = 0.5;
/// If fewer than this share of the blocks can have a name, none has one.
const LEAST_NAMED: f64 = 0.7;

/// At most this many labels of a picture are placed besides names in blocks, those of the least rank. To place a label,
/// all marks near its anchor are tested, so the time would grow with the square of their number. Nobody can read that
/// many labels.
const MAX_LABELS: usize = 500;

/// The font size of a symbol as a multiple of the size of other labels.
const SYMBOL_SIZE: f64 = 1.35;
/// The cost of a label that lies beside its panel, per mm.
const BESIDE_PANEL: f64 = 3.0;

/// A text that needs a position.
#[derive(Clone, Debug)]
pub(crate) struct Label {
    pub words: String,
    pub bold: bool,
    pub colour: Colour,
    /// The points that the text may stand beside, the best first.
    pub anchors: Vec<PagePoint>,
    /// Labels with a smaller rank are placed first.
    pub rank: u8,
    /// The direction from the anchor in which the text stands best.
    pub away: Option<(f64, f64)>,
    /// The middle of a position that is taken without a search if no other label lies there.
    pub fixed: Option<PagePoint>,
    /// Whether the text is the name of a block: it then only stands in this rectangle, inside the block, without a
    /// leader. All names of one rank are left out if too few of them have a place.
    pub inside: Option<PageRect>,
    /// Whether a name stands beside the block, with a leader, if it has no place inside. The words below the picture
    /// mention the block.
    pub is_mentioned: bool,
    /// A mathematical symbol that is drawn instead of the words.
    pub symbol: Option<Symbol>,
}

impl Label {
    /// Returns a label that may stand beside any of these points.
    pub fn new(words: String, colour: Colour, anchors: Vec<PagePoint>, rank: u8) -> Label {
        let (away, fixed, inside, symbol) = (None, None, None, None);
        Label { words, bold: false, colour, anchors, rank, away, fixed, inside, is_mentioned: false, symbol }
    }

    /// Returns a label with its middle at this point, if no other label lies there.
    pub fn at(at: PagePoint, words: String, colour: Colour, rank: u8) -> Label {
        Label { fixed: Some(at), ..Label::new(words, colour, vec![at], rank) }
    }

    /// Returns the width and the height of the ink, pixels. `size` is the font size in pixels.
    fn size(&self, size: f64) -> (f64, f64) {
        match &self.symbol {
            Some(symbol) => symbol.size(SYMBOL_SIZE * size),
            None => (text::width(&self.words, face(self), size), 0.95 * size),
        }
    }
}

/// The labels that have a position.
#[derive(Default)]
pub(crate) struct PlacedLabels {
    pub items: Vec<Item>,
    pub rects: Vec<PageRect>,
}

/// A convex shape that labels must not cover, and how many marks have it at this place.
struct Obstacle {
    corners: Vec<PagePoint>,
    count: usize,
}

/// What is already drawn where labels are placed.
pub(crate) struct Surroundings {
    obstacles: BoxIndex<Obstacle>,
    edges: BoxIndex<[PagePoint; 2]>,
    stones: BoxIndex<Vec<PagePoint>>,
    structure: PageRect,
    /// The x coordinate of a line between two drawings: no label crosses it, and each stays on the side of its anchor.
    pub gutter: Option<f64>,
    /// The cost of a label that lies wholly in stones.
    inside: f64,
}

impl Surroundings {
    /// `has_fills` is true if the colours of the stones show a quantity.
    pub fn new(marks: &[Mark], structure: PageRect, has_fills: bool, look: Look) -> Surroundings {
        let mut obstacles: BTreeMap<Vec<[u64; 2]>, Obstacle> = BTreeMap::new();
        let mut add = |corners: Vec<PagePoint>| {
            let place = corners.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect();
            obstacles.entry(place).or_insert(Obstacle { corners, count: 0 }).count += 1;
        };
        for mark in marks {
            let Some(clear) = mark.avoid else { continue };
            for path in &mark.shapes {
                let clear = look.mm(clear) + path.stroke.as_ref().map_or(0.0, |s| s.width / 2.0);
                let points: Vec<PagePoint> = path.outline.points().collect();
                if path.fill.is_some() {
                    add(grown(hull(points), clear));
                } else {
                    let lines = lines(&path.outline).into_iter();
                    lines.for_each(|ends| add(grown(hull(ends.to_vec()), clear)));
                }
            }
        }
        let rings: Vec<Vec<PagePoint>> = marks
            .iter()
            .filter(|mark| mark.layer == Layer::Stone && ["block", "displaced", "plan"].contains(&mark.class))
            .flat_map(|mark| mark.shapes.first())
            .flat_map(|path| rings(&path.outline))
            .collect();
        let edges: Vec<[PagePoint; 2]> =
            rings.iter().flat_map(|ring| (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]])).collect();
        Surroundings {
            obstacles: BoxIndex::new(obstacles.into_values().collect(), |o: &Obstacle| bounds(&o.corners)),
            edges: BoxIndex::new(edges, |edge| bounds(edge)),
            stones: BoxIndex::new(rings, |ring| bounds(ring)),
            structure,
            gutter: None,
            inside: if has_fills {
                3.0
            } else if look.large {
                0.9
            } else {
                1.3
            },
        }
    }

    /// True if a label beside an anchor would cross the line between two drawings.
    fn parts(&self, rect: PageRect, anchor: PagePoint) -> bool {
        let is_left = |gutter: f64| anchor.x < gutter;
        self.gutter.is_some_and(|x| if is_left(x) { rect.at.x + rect.width > x } else { rect.at.x < x })
    }

    /// Returns the number of obstacles that a rectangle covers.
    fn covered(&self, rect: PageRect) -> usize {
        let corners = corners(rect);
        let met = self.obstacles.intersecting(bounds(&corners)).filter(|o| convex_meet(&o.corners, &corners));
        met.map(|obstacle| obstacle.count).sum()
    }

    fn is_clear(&self, rect: PageRect) -> bool {
        let corners = corners(rect);
        !self.obstacles.intersecting(bounds(&corners)).any(|o| convex_meet(&o.corners, &corners))
    }

    /// Returns the number of obstacles on a leader. An obstacle at its anchor only counts if the leader runs along it
    /// for more than `along` pixels.
    fn crossed(&self, from: PagePoint, anchor: PagePoint, near: f64, along: f64) -> usize {
        let line = [from, anchor];
        let at = corners(grown_rect(PageRect { at: anchor, width: 0.0, height: 0.0 }, near));
        let crossed = self.obstacles.intersecting(bounds(&line)).filter(|o| convex_meet(&o.corners, &line));
        let crossed = crossed.filter(|o| !convex_meet(&o.corners, &at) || chord(&o.corners, line) > along);
        crossed.map(|obstacle| obstacle.count).sum()
    }

    /// Returns the length of the edges of stones in a rectangle, pixels.
    fn edge_length(&self, rect: PageRect) -> f64 {
        let edges = self.edges.intersecting(bounds(&corners(rect)));
        let lengths = edges.filter_map(|edge| rect.part_of(*edge)).map(|[a, b]| b.distance(a));
        // The index gives no order: add the lengths in an order that does not depend on it.
        let mut lengths: Vec<f64> = lengths.collect();
        lengths.sort_by(f64::total_cmp);
        lengths.iter().sum()
    }

    /// Returns the share of a rectangle that lies in stones, from 15 points in it.
    fn share_inside(&self, rect: PageRect) -> f64 {
        let stones: Vec<&Vec<PagePoint>> = self.stones.intersecting(bounds(&corners(rect))).collect();
        let points = (0..15_u32).map(|i| {
            let (column, row) = (f64::from(i % 5), f64::from(i / 5));
            rect.at.moved(rect.width * (0.5 + column) / 5.0, rect.height * (0.5 + row) / 3.0)
        });
        points.filter(|p| stones.iter().any(|ring| contains(ring, *p))).count() as f64 / 15.0
    }
}

/// A position for a label.
#[derive(Clone, Copy)]
struct Position {
    cost: f64,
    rect: PageRect,
    leader: Option<PagePoint>,
}

/// Places the labels, those of the least rank first. A label without a position is left out.
pub(crate) fn labels(mut labels: Vec<Label>, drawn: &Surroundings, look: Look, options: &Options) -> PlacedLabels {
    labels.sort_by_key(|label| label.rank);
    let (names, others): (Vec<Label>, Vec<Label>) =
        labels.into_iter().partition(|label| label.inside.is_some() && !label.is_mentioned);
    let mut placed = PlacedLabels::default();
    let size = look.text * options.theme.sizes.amount;
    for mut label in others.into_iter().take(MAX_LABELS) {
        let (wide, high) = label.size(size);
        if label.inside.is_some() {
            if let Some(rect) = name_place(&label, (wide, 0.74 * size), drawn, &placed.rects, look) {
                placed.put(&label, Position { cost: 0.0, rect, leader: None }, look, options);
                continue;
            }
            label.inside = None;
        }
        let size = (wide + look.mm(0.4), high + look.mm(0.3));
        if let Some(position) = search(&label, size, drawn, &placed.rects, look) {
            placed.put(&label, position, look, options);
        }
    }
    for names in names.chunk_by(|a, b| a.rank == b.rank) {
        let found: Vec<(&Label, PageRect)> = names
            .iter()
            .filter_map(|label| {
                let wide = text::width(&label.words, face(label), size);
                let rect = name_place(label, (wide, 0.74 * size), drawn, &placed.rects, look)?;
                Some((label, rect))
            })
            .collect();
        if found.len() as f64 >= LEAST_NAMED * names.len() as f64 {
            for (label, rect) in found {
                placed.put(label, Position { cost: 0.0, rect, leader: None }, look, options);
            }
        }
    }
    placed
}

fn face(label: &Label) -> Face {
    if label.bold { Face::SansBold } else { Face::Sans }
}

impl PlacedLabels {
    fn put(&mut self, label: &Label, position: Position, look: Look, options: &Options) {
        let (rect, theme) = (position.rect, &options.theme);
        let size = look.text * theme.sizes.amount;
        let is_name = label.inside.is_some() || label.is_mentioned || label.symbol.is_some();
        let class = if is_name { "name" } else { "amount" };
        let mut group = Group::with_class(class);
        if let Some(anchor) = position.leader {
            let from = nearest(rect, anchor);
            let long = anchor.distance(from);
            let share = (1.0 - look.mm(0.5) / long.max(1e-9)).max(0.0);
            let to = from.moved(share * (anchor.x - from.x), share * (anchor.y - from.y));
            let line = Outline::line([from, to]);
            if long > look.mm(LEAST_LEADER) {
                group = group.with(Path::stroked(line.clone(), Stroke::new(theme.page, look.mm(0.5))));
                group = group.with(Path::stroked(line, Stroke::new(label.colour, look.mm(0.18))));
                // Small boxes along the leader; one box around it would take the space of other labels.
                let count = libm::ceil(long / look.mm(1.5)).max(1.0);
                let at = |k: f64| from.moved(k / count * (to.x - from.x), k / count * (to.y - from.y));
                let boxes = (0..count as u32).filter_map(|k| around([at(f64::from(k)), at(f64::from(k + 1))]));
                self.rects.extend(boxes.map(|part| grown_rect(part, look.mm(0.4))));
            }
        }
        if let Some(symbol) = &label.symbol {
            let (wide, high) = label.size(size);
            let at = rect.at.moved((rect.width - wide) / 2.0, (rect.height - high) / 2.0);
            let rect = PageRect { at, width: wide, height: high };
            self.items.push(group.with(symbol.draw(rect, SYMBOL_SIZE * size, label.colour)).into());
            self.rects.push(rect);
            return;
        }
        let base = rect.at.moved(rect.width / 2.0, rect.height / 2.0 + 0.36 * size);
        let words = Text::new(base, label.words.as_str(), face(label), size, label.colour).anchored(Anchor::Middle);
        let words = if label.inside.is_some() { words } else { words.with_halo(theme.page, look.mm(0.75)) };
        self.items.push(group.with(words).into());
        self.rects.push(rect);
    }
}

/// Returns the position of least cost; `None` if no position is free.
fn search(label: &Label, size: (f64, f64), drawn: &Surroundings, placed: &[PageRect], look: Look) -> Option<Position> {
    let free = |rect: PageRect| !placed.iter().any(|other| overlaps(rect, *other, 0.0));
    if let Some(middle) = label.fixed {
        let rect = centred(middle, size);
        if free(rect) {
            return Some(Position { cost: 0.0, rect, leader: None });
        }
    }
    let at = |distances: &[f64]| around_anchors(label, size, distances, drawn, placed, look);
    let near = at(&DISTANCES);
    // The amounts of loads stay together in their order.
    if near.is_some_and(|near| near.cost <= FAR_COST || label.away.is_some()) {
        return near;
    }
    let far = at(&FAR).filter(|far| near.is_none_or(|near| far.cost < near.cost));
    far.or(near)
}

/// Returns the position of least cost at these distances from the anchors of a label, mm.
fn around_anchors(
    label: &Label,
    size: (f64, f64),
    distances: &[f64],
    drawn: &Surroundings,
    placed: &[PageRect],
    look: Look,
) -> Option<Position> {
    let free = |rect: PageRect| !placed.iter().any(|other| overlaps(rect, *other, 0.0));
    let mut best: Option<Position> = None;
    for (number, anchor) in label.anchors.iter().enumerate() {
        for &distance in distances {
            for direction in 0..DIRECTIONS {
                let angle = f64::from(direction) * core::f64::consts::TAU / f64::from(DIRECTIONS);
                let (ux, uy) = (libm::cos(angle), libm::sin(angle));
                let reach = look.mm(distance);
                let aside = |u: f64, side: f64| u * reach + side / 2.0 * (1.6 * u).clamp(-1.0, 1.0);
                let rect = centred(anchor.moved(aside(ux, size.0), aside(uy, size.1)), size);
                if drawn.parts(rect, *anchor) {
                    continue;
                }
                let start = 0.55 * distance + 0.3 * number as f64;
                if !free(rect) || best.is_some_and(|best| start - 2.1 > best.cost) || !drawn.is_clear(rect) {
                    continue;
                }
                if let Some((cost, leader)) = cost(label, (*anchor, distance), rect, drawn, placed, look)
                    && best.is_none_or(|best| start + cost < best.cost - 1e-6)
                {
                    best = Some(Position { cost: start + cost, rect, leader });
                }
            }
        }
    }
    best
}

/// Returns the cost of a position apart from its distance, and the end of its leader if it needs one. `None` if its
/// leader would cross a label.
fn cost(
    label: &Label,
    (anchor, distance): (PagePoint, f64),
    rect: PageRect,
    drawn: &Surroundings,
    placed: &[PageRect],
    look: Look,
) -> Option<(f64, Option<PagePoint>)> {
    let per_mm = |pixels: f64| pixels / look.mm(1.0);
    let middle = rect.at.moved(rect.width / 2.0, rect.height / 2.0);
    let (dx, dy) = (middle.x - anchor.x, middle.y - anchor.y);
    let mut cost = 0.0;
    if let Some((x, y)) = label.away {
        cost -= 0.9 * (dx * x + dy * y) / libm::hypot(dx, dy).max(1e-9);
    }
    // Keep the label within the panel, which is centred about the structure.
    let centre = drawn.structure.at.x + drawn.structure.width / 2.0;
    let beside = (centre - rect.at.x).max(rect.at.x + rect.width - centre) - look.panel / 2.0;
    cost += BESIDE_PANEL * per_mm(beside.max(0.0));
    // The halo of the text covers edges close to it.
    let edges = per_mm(drawn.edge_length(grown_rect(rect, look.mm(HALO))));
    let inside = drawn.share_inside(rect);
    let near = drawn.covered(grown_rect(rect, look.mm(0.75)));
    cost += EDGE_COST * edges + drawn.inside * inside + 0.5 * near.saturating_sub(1) as f64;
    if label.bold && look.large && inside > 0.99 && edges < 0.05 {
        cost -= 1.2;
    }
    let mut leader = None;
    if distance > LEADER_DISTANCE {
        let from = nearest(rect, anchor);
        let line = [from, anchor];
        let crosses = |other: &&PageRect| other.part_of(line).is_some();
        if placed.iter().any(|other| crosses(&other)) {
            return None;
        }
        cost += 0.8 + 2.0 * drawn.crossed(from, anchor, look.mm(0.35), look.mm(ALONG)) as f64;
        leader = Some(anchor);
    }
    let structure = drawn.structure;
    let beyond = (structure.at.x - look.mm(2.0) - rect.at.x).max(0.0)
        + (rect.at.x + rect.width - structure.at.x - structure.width - look.mm(2.0)).max(0.0);
    cost += if look.is_strip { 0.4 } else { 0.04 } * per_mm(beyond);
    let inward = dx * (anchor.x - structure.at.x - structure.width / 2.0);
    // A rounding error must not decide on which side of its anchor a label lies.
    cost += if inward < -(look.mm(0.02) * look.mm(0.02)) { 0.25 } else { 0.0 };
    cost += if middle.y > structure.at.y + structure.height { 0.8 } else { 0.0 };
    Some((cost, leader))
}

/// Returns a position for the name of a block: inside the block, clear of marks and labels, near its middle.
fn name_place(
    label: &Label,
    (wide, high): (f64, f64),
    drawn: &Surroundings,
    placed: &[PageRect],
    look: Look,
) -> Option<PageRect> {
    let (inside, middle) = (label.inside?, *label.anchors.first()?);
    let (across, down) = (inside.width - wide - look.mm(1.4), inside.height - high - look.mm(1.4));
    if across <= 0.0 || down <= 0.0 {
        return None;
    }
    let mut places: Vec<(f64, PagePoint)> = (0..25_u32)
        .map(|i| {
            let at = inside.at.moved(
                wide / 2.0 + look.mm(0.7) + across * f64::from(i % 5) / 4.0,
                high / 2.0 + look.mm(0.7) + down * f64::from(i / 5) / 4.0,
            );
            ((at.x - middle.x).abs() + (at.y - middle.y).abs(), at)
        })
        .collect();
    places.insert(0, (0.0, middle));
    // A rounding error must not decide between two positions at the same distance.
    places.sort_by_key(|place| (place.0 / look.mm(0.05)).round() as i64);
    let fits = |rect: PageRect| {
        let space = grown_rect(rect, look.mm(0.55));
        drawn.edge_length(space) <= 0.0
            && drawn.share_inside(space) >= 1.0
            && drawn.is_clear(grown_rect(rect, look.mm(0.2)))
            && !placed.iter().any(|other| overlaps(rect, *other, 0.0))
    };
    places.into_iter().map(|(_, at)| centred(at, (wide, high))).find(|rect| fits(*rect))
}

fn centred(middle: PagePoint, (width, height): (f64, f64)) -> PageRect {
    PageRect { at: middle.moved(-width / 2.0, -height / 2.0), width, height }
}

fn grown_rect(rect: PageRect, by: f64) -> PageRect {
    PageRect { at: rect.at.moved(-by, -by), width: rect.width + 2.0 * by, height: rect.height + 2.0 * by }
}

fn nearest(rect: PageRect, to: PagePoint) -> PagePoint {
    PagePoint::new(
        to.x.clamp(rect.at.x, rect.at.x + rect.width.max(0.0)),
        to.y.clamp(rect.at.y, rect.at.y + rect.height.max(0.0)),
    )
}

fn corners(rect: PageRect) -> [PagePoint; 4] {
    let (w, h) = (rect.width, rect.height);
    [rect.at, rect.at.moved(w, 0.0), rect.at.moved(w, h), rect.at.moved(0.0, h)]
}

fn bounds(points: &[PagePoint]) -> Aabb {
    let rect = around(points.iter().copied());
    let rect = rect.unwrap_or(PageRect { at: PagePoint::new(f64::INFINITY, f64::INFINITY), width: 0.0, height: 0.0 });
    Aabb { min: [rect.at.x, rect.at.y], max: [rect.at.x + rect.width, rect.at.y + rect.height] }
}

/// Returns the parts of an outline as lists of their points.
fn rings(outline: &Outline) -> Vec<Vec<PagePoint>> {
    let mut rings: Vec<Vec<PagePoint>> = Vec::new();
    for segment in &outline.segments {
        match (*segment, rings.last_mut()) {
            (Segment::Move(p), _) => rings.push(vec![p]),
            (Segment::Line(p) | Segment::Curve(_, _, p), Some(ring)) => ring.push(p),
            _ => {}
        }
    }
    rings
}

/// Returns the straight lines of an outline, with those that close its parts.
fn lines(outline: &Outline) -> Vec<[PagePoint; 2]> {
    let is_closed = outline.segments.iter().any(|segment| matches!(segment, Segment::Close));
    let of = |ring: &Vec<PagePoint>| {
        let count = if is_closed && ring.len() > 2 { ring.len() } else { ring.len().saturating_sub(1) };
        (0..count).map(|i| [ring[i], ring[(i + 1) % ring.len()]]).collect::<Vec<_>>()
    };
    rings(outline).iter().flat_map(of).collect()
}

fn contains(ring: &[PagePoint], p: PagePoint) -> bool {
    let mut inside = false;
    for i in 0..ring.len() {
        let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
            inside = !inside;
        }
    }
    inside
}

/// Returns the corners of the convex hull of the points; at least one.
fn hull(points: Vec<PagePoint>) -> Vec<PagePoint> {
    let hull = convex_hull(points.iter().map(|p| Point::new(p.x, p.y)).collect());
    if hull.is_empty() {
        points.into_iter().take(1).collect()
    } else {
        hull.into_iter().map(|p| PagePoint::new(p.x, p.y)).collect()
    }
}

/// Returns the length of the part of a line segment that lies in a convex shape, whose corners are in the order of
/// [`hull`].
fn chord(shape: &[PagePoint], [a, b]: [PagePoint; 2]) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for i in 0..shape.len() {
        let (p, q) = (shape[i], shape[(i + 1) % shape.len()]);
        let [from, to] = [a, b].map(|x| (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x));
        match (from < 0.0, to < 0.0) {
            (true, true) => return 0.0,
            (true, false) => low = low.max(from / (from - to)),
            (false, true) => high = high.min(from / (from - to)),
            (false, false) => {}
        }
    }
    (high - low).max(0.0) * b.distance(a)
}

/// Returns a convex shape that contains every point within `by` pixels of a corner, measured along the axes.
fn grown(corners: Vec<PagePoint>, by: f64) -> Vec<PagePoint> {
    if by <= 0.0 {
        return corners;
    }
    // An octagon around each corner is close enough to a circle.
    let cut = by * 0.414;
    let around = |p: PagePoint| {
        [(by, cut), (cut, by), (-cut, by), (-by, cut), (-by, -cut), (-cut, -by), (cut, -by), (by, -cut)]
            .map(|(x, y)| p.moved(x, y))
    };
    hull(corners.into_iter().flat_map(around).collect())
}

/// True if two convex shapes share a point: no line along an edge of either separates them. A shape may be a point or
/// a line segment.
fn convex_meet(a: &[PagePoint], b: &[PagePoint]) -> bool {
    let separates = |edges: &[PagePoint]| {
        (0..edges.len()).any(|i| {
            let (from, to) = (edges[i], edges[(i + 1) % edges.len()]);
            let normal = (to.y - from.y, from.x - to.x);
            let range = |points: &[PagePoint]| range_of(points.iter().map(|p| p.x * normal.0 + p.y * normal.1));
            let (of_a, of_b) = (range(a), range(b));
            of_a.1 < of_b.0 || of_b.1 < of_a.0
        })
    };
    !separates(a) && !separates(b)
}
