//! [`Plan`]: computes the position of the polygon of forces, in metres.

use crate::geometry::{Bounds, Point, Vector, in_half_plane};
use crate::mechanics::analysis::{Analysis, FrameAnalysis, LoadCapacity};

/// Length at which the largest force is drawn if the polygon is at the loaded point, as a fraction of the size of the
/// structure.
const MAX_POLYGON_SHARE: f64 = 0.42;
/// A polygon that is smaller than this fraction of its largest force is drawn apart from the loaded point, at a
/// separate scale.
const SMALL_POLYGON_SHARE: f64 = 0.25;
/// Size of a polygon that is drawn apart, as a fraction of the size of the structure.
const SEPARATE_POLYGON_SHARE: f64 = 0.4;
/// Gap between the structure and the items next to it, as a fraction of the size of the structure.
const GAP_SHARE: f64 = 0.1;
/// Unbounded sets of forces are cut off at this multiple of the largest force of a vertex.
const CUT_OFF_RATIO: f64 = 1.7;
/// The largest number of small pictures.
const MAX_SMALL_PICTURES: usize = 4;
/// If a frame has more blocks than this, the figure has no small pictures.
const MAX_BLOCKS_WITH_PICTURES: usize = 300;
/// The number of corners of the circle at which unbounded sets are cut off.
const CIRCLE_CORNERS: usize = 48;

/// If the structure is wider than this multiple of its height, a polygon that is drawn apart is above it.
const WIDE_RATIO: f64 = 1.5;

/// The position of the polygon of a frame, and its edges.
pub(super) struct Plan<'a> {
    pub capacity: &'a LoadCapacity,
    /// The loaded point, or the middle of two loaded points.
    pub point: Point,
    /// The position at which the force 0 is drawn: the loaded point, unless the polygon is drawn apart.
    pub zero: Point,
    /// Whether the polygon is drawn apart.
    pub is_apart: bool,
    /// The scale of the polygon, metres per newton.
    pub scale: f64,
    /// The corners of the drawn polygon, metres.
    pub ring: Vec<Point>,
    pub sides: Vec<DrawnEdge>,
    /// The indices of the edges that have numbers and small pictures, in the order of the numbers from 1.
    pub numbers: Vec<usize>,
}

/// A drawn edge of the polygon. Its ends are in metres, and `outward` is its outward unit normal.
pub(super) struct DrawnEdge {
    pub ends: [Point; 2],
    /// For each end, whether the true edge continues beyond this end without limit.
    pub is_open: [bool; 2],
    pub outward: Vector,
    /// The number of the edge in the figure, from 1; `None` if the edge has no small picture.
    pub number: Option<usize>,
}

impl<'a> Plan<'a> {
    /// Computes the position of the polygon of a frame. Returns `None` if the carried forces of this frame were not
    /// computed, or if the block can carry no force.
    pub fn new(analysis: &'a Analysis, frame: usize) -> Option<Plan<'a>> {
        let capacity = analysis.frames.get(frame)?.capacity.as_ref()?;
        let structure = structure(analysis)?;
        let size = structure.width().max(structure.height());
        let point = middle(&capacity.at);
        let cut = cut(analysis);
        let ring = ring(capacity, cut);
        let own = Bounds::from_points(ring.iter().map(|force| Point::from(*force)))?;
        let first = *ring.first()?;
        let extent = ring.iter().map(|f| (f - first).norm()).fold(0.0, f64::max);
        let farthest = farthest(analysis, cut);
        let is_bounded = capacity.rays.is_empty();
        let is_apart = is_bounded
            && extent < SMALL_POLYGON_SHARE * farthest
            && extent > 1e-6 * farthest
            && analysis.frames.len() == 1;
        let (scale, zero) = if !is_apart {
            (MAX_POLYGON_SHARE * size / farthest, point)
        } else if structure.width() > WIDE_RATIO * structure.height() {
            let scale = 0.5 * SEPARATE_POLYGON_SHARE * size / extent;
            let middle = 0.5 * (own.min.x + own.max.x) * scale;
            (scale, Point::new(point.x - middle, structure.max.y + GAP_SHARE * size - own.min.y * scale))
        } else {
            let scale = SEPARATE_POLYGON_SHARE * size / extent;
            let middle = 0.5 * (own.min.y + own.max.y) * scale;
            (scale, Point::new(structure.max.x + GAP_SHARE * size - own.min.x * scale, point.y - middle))
        };
        let place = |force: &Vector| zero + force * scale;
        let numbers = edges_with_pictures(analysis, capacity);
        let sides = sides(capacity, cut, &numbers, &place);
        let ring = ring.iter().map(place).collect();
        Some(Plan { capacity, point, zero, is_apart, scale, ring, sides, numbers })
    }

    /// Returns the mean of the corners of the drawn polygon, a point in metres.
    pub fn middle(&self) -> Point {
        middle(&self.ring)
    }
}

/// Returns the box around the blocks of all frames, in metres. Returns `None` if there are no blocks.
fn structure(analysis: &Analysis) -> Option<Bounds> {
    let scene = analysis.given();
    let placed = scene.frames.iter().flat_map(|frame| &frame.placed);
    scene.bounds(placed)
}

fn middle(points: &[Point]) -> Point {
    let sum: Vector = points.iter().map(|p| p.coords).sum();
    Point::from(sum / points.len().max(1) as f64)
}

/// Returns every frame for which the carried forces were computed, together with these forces. The scale of the
/// polygons is the same for all these frames.
fn capacities(analysis: &Analysis) -> impl Iterator<Item = (&FrameAnalysis, &LoadCapacity)> {
    let frames = analysis.frames.iter();
    frames.filter_map(|frame| Some((&**frame, frame.capacity.as_ref()?)))
}

/// Returns the largest magnitude of a force at a vertex of the polygons of all frames, N. It is at least 0.001 times
/// the weight of the heaviest frame.
fn largest(analysis: &Analysis) -> f64 {
    let each = capacities(analysis).map(|(frame, capacity)| {
        let forces = capacity.vertices.iter().map(|v| v.force.norm());
        forces.fold(1e-3 * frame.weight, f64::max)
    });
    each.fold(f64::MIN_POSITIVE, f64::max)
}

/// Returns the magnitude at which unbounded sets of forces are cut off, N.
fn cut(analysis: &Analysis) -> f64 {
    CUT_OFF_RATIO * largest(analysis)
}

/// Returns the largest magnitude of a drawn force in all frames, N: `cut` if the set of any frame is unbounded.
fn farthest(analysis: &Analysis, cut: f64) -> f64 {
    let is_open = capacities(analysis).any(|(_, capacity)| !capacity.rays.is_empty());
    if is_open { cut } else { largest(analysis) }
}

/// Returns the corners of the set of forces, N. An unbounded set is cut off at a circle of radius `cut`.
fn ring(capacity: &LoadCapacity, cut: f64) -> Vec<Vector> {
    if capacity.rays.is_empty() {
        return capacity.vertices.iter().map(|v| v.force).collect();
    }
    if capacity.vertices.is_empty() {
        return Vec::new();
    }
    // `outline` is the unbounded set as a polygon that is cut off far outside the circle.
    let outline = capacity.bounded_polygon(UNBOUNDED_RATIO * cut);
    if outline.len() < 3 {
        return capacity.bounded_polygon(cut);
    }
    let corner = |k: usize| {
        let (sin, cos) = libm::sincos(k as f64 * std::f64::consts::TAU / CIRCLE_CORNERS as f64);
        Vector::new(cos, sin) * cut
    };
    let mut ring: Vec<Vector> = (0..CIRCLE_CORNERS).map(corner).collect();
    for (k, a) in outline.iter().enumerate() {
        let along = outline[(k + 1) % outline.len()] - a;
        if along.norm() > 0.0 {
            let normal = Vector::new(along.y, -along.x).normalize();
            ring = in_half_plane(&ring, |force| normal.dot(force) - normal.dot(a));
        }
    }
    ring
}

/// Before they are cut off, unbounded sets extend to this multiple of the radius of the circle.
const UNBOUNDED_RATIO: f64 = 1e3;

/// Returns the indices of the polygon's edges that get a small picture: the longest edges, in ascending order.
/// Unbounded edges count as the longest. The list is empty if the analysis has several frames or many blocks.
fn edges_with_pictures(analysis: &Analysis, capacity: &LoadCapacity) -> Vec<usize> {
    let frames = analysis.given().frames.iter();
    let most = frames.map(|frame| frame.placed.len()).max().unwrap_or(0);
    if analysis.frames.len() > 1 || most > MAX_BLOCKS_WITH_PICTURES {
        return Vec::new();
    }
    let mut chosen: Vec<usize> = capacity.longest_edges();
    chosen.truncate(MAX_SMALL_PICTURES);
    // Sort by index, so that the numbers in the figure run anticlockwise.
    chosen.sort_unstable();
    chosen
}

/// Returns the edges of the polygon as they are drawn. An unbounded edge ends at the circle at which forces are cut
/// off.
fn sides(capacity: &LoadCapacity, cut: f64, numbers: &[usize], place: &dyn Fn(&Vector) -> Point) -> Vec<DrawnEdge> {
    let force = |vertex: Option<usize>| vertex.map(|k| capacity.vertices[k].force);
    let mut sides = Vec::new();
    for (k, edge) in capacity.edges.iter().enumerate() {
        let along = Vector::new(-edge.normal.y, edge.normal.x);
        let known = [force(edge.ends[0]), force(edge.ends[1])];
        let base = known[0].or(known[1]).unwrap_or(edge.normal * edge.limit);
        // Intersection of the line of the edge with the circle at which forces are cut off.
        let far = |sign: f64| {
            let (b, c) = (base.dot(&along), base.norm_squared() - cut * cut);
            let root = (b * b - c).max(0.0).sqrt();
            base + along * (-b + sign * root)
        };
        let ends = [known[0].unwrap_or(far(-1.0)), known[1].unwrap_or(far(1.0))];
        sides.push(DrawnEdge {
            ends: [place(&ends[0]), place(&ends[1])],
            is_open: [edge.ends[0].is_none(), edge.ends[1].is_none()],
            outward: edge.normal,
            number: numbers.iter().position(|n| *n == k).map(|n| n + 1),
        });
    }
    sides
}
