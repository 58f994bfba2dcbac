//! [`Outlines`]: the bodies of a drawing as polygons with holes, with flattened curves, and its robots as points.

use super::choice::{self, Chosen};
use super::draft::{Draft, Part, PartGeometry, Role, Values};
use super::region::regions;
use super::subpath::Subpath;
use super::{MAX_NAMES, Remark, limit};
use crate::geometry::snap::{Corner, Rings, area, polygon};
use crate::geometry::{Bounds, Circle, Point, Polygon, PolygonError, cross};
use crate::mechanics::scene::Problem;
use crate::text::first_of;

/// The largest coordinate in metres; scene files have the same limit.
const MAX_COORDINATE: f64 = 1e12;

/// The warning about a drawing without ground.
pub(super) const NO_GROUND: &str = "no part of the drawing is ground, so nothing supports the blocks";

/// The bodies and robots of a drawing.
#[derive(Clone)]
pub(super) struct Outlines {
    /// The parts of the ground, then the blocks, in the order of the drawing.
    pub(super) bodies: Vec<Body>,
    pub(super) robots: Vec<Robot>,
}

/// A block or a part of the ground.
#[derive(Clone)]
pub(super) struct Body {
    pub(super) kind: Role,
    pub(super) name: String,
    pub(super) element: String,
    pub(super) rings: Rings,
    /// The circle, if the body is one. Its ring is only for messages.
    pub(super) circle: Option<Circle>,
    pub(super) fill: Option<[u8; 3]>,
    pub(super) values: Values,
}

/// A robot with its grip point.
#[derive(Clone)]
pub(super) struct Robot {
    pub(super) name: String,
    pub(super) element: String,
    pub(super) at: Point,
}

/// Removes parts with coordinates that are too large or not numbers. Returns the size of the drawing: the diagonal of
/// the bounding box of all blocks, in metres.
pub(super) fn size(draft: &mut Draft) -> f64 {
    let hull = |part: &Part| -> Vec<Point> {
        let point = if let PartGeometry::Point(at) = part.form { Some(at) } else { None };
        part.subpaths().iter().flat_map(Subpath::hull).chain(point).collect()
    };
    let mut around: Option<Bounds> = None;
    let (mut kept, mut out) = (Vec::new(), Vec::new());
    for part in std::mem::take(&mut draft.parts) {
        let hull = hull(&part);
        // A coordinate that is NaN fails this test too.
        if hull.iter().all(|p| p.x.abs() <= MAX_COORDINATE && p.y.abs() <= MAX_COORDINATE) {
            if part.kind == Role::Block {
                let own = Bounds::from_points(hull);
                around = around.into_iter().chain(own).reduce(Bounds::union);
            }
            kept.push(part);
        } else {
            out.push(part.element);
        }
    }
    draft.parts = kept;
    for element in out {
        draft.lose("outline", &element, &format!("it has coordinates beyond {MAX_COORDINATE:e} m"), "");
    }
    around.map_or(0.0, Bounds::diagonal)
}

impl Outlines {
    /// Flattens the parts of a draft and splits them into regions. `flatten` is the largest distance of a chord from
    /// its curve. `close` is the largest gap between the ends of an outline that counts as closed. Both are in metres.
    pub(super) fn new(draft: &mut Draft, flatten: f64, close: f64) -> Outlines {
        let mut outlines = Outlines { bodies: Vec::new(), robots: Vec::new() };
        for part in std::mem::take(&mut draft.parts) {
            match part.form {
                PartGeometry::Point(at) => outlines.robots.push(Robot { name: part.name, element: part.element, at }),
                PartGeometry::Subpaths(ref subpaths, rule) => {
                    let rings: Vec<_> = subpaths.iter().filter_map(|s| s.flattened(flatten, close)).collect();
                    if rings.is_empty() {
                        draft.lose("outline", &part.element, "it has no outline", "");
                    }
                    if limit::has_too_many_pairs(&rings) {
                        let why = format!("its {} outlines are too many to find the holes among them", rings.len());
                        draft.lose("outline", &part.element, &why, "break it apart into several paths");
                        continue;
                    }
                    let rings = clipped(draft, &part, rings, flatten);
                    let circles: Vec<(Vec<Corner>, Circle)> =
                        subpaths.iter().filter_map(|s| Some((s.flattened(flatten, close)?, s.circle()?))).collect();
                    for rings in regions(rings, rule) {
                        // A circle that is cut or has a hole is a polygon.
                        let circle = circles.iter().find(|(ring, _)| rings[..] == [ring.clone()]).map(|found| found.1);
                        outlines.add(draft, &part, rings, circle);
                    }
                }
            }
        }
        outlines
    }

    /// Gives the bodies that `values` choose their role, and sorts the bodies: the ground, then the blocks. If there are
    /// blocks but no ground, adds a list of the bodies to the notes. `names` are the names in the drawing.
    ///
    /// # Errors
    /// Returns a message if a value chooses no body.
    pub(super) fn assign_roles(
        &mut self,
        draft: &mut Draft,
        values: &[Chosen<'_>],
        names: &[String],
    ) -> Result<(), String> {
        let is_ground = |body: &Body| body.kind == Role::Ground;
        if values.is_empty() && (self.bodies.is_empty() || self.bodies.iter().any(is_ground)) {
            self.bodies.sort_by_key(|b| b.kind == Role::Block);
            return Ok(());
        }
        let polygons: Vec<Option<Polygon>> = self.bodies.iter().map(Body::polygon).collect();
        let list = choice::list(self.bodies.iter().map(|b| b.element.as_str()), &polygons, draft.unit);
        let roles = match choice::roles(values, &polygons, draft.unit) {
            Ok(roles) => roles,
            Err(why) => {
                draft.notes.extend(list);
                return Err(why);
            }
        };
        for (body, role) in self.bodies.iter_mut().zip(roles) {
            body.kind = role.unwrap_or(body.kind);
        }
        let left_out = self.bodies.iter().filter(|b| b.kind == Role::Ignored).count();
        if left_out > 0 {
            draft.notes.push(format!("left out with --ignore: {left_out} of {} bodies", self.bodies.len()));
            self.bodies.retain(|b| b.kind != Role::Ignored);
        }
        if !self.bodies.iter().any(is_ground) && !self.bodies.is_empty() {
            let names = if names.is_empty() {
                String::new()
            } else {
                format!("; the drawing has {}", first_of(names.to_vec(), MAX_NAMES))
            };
            draft.remark(
                "",
                NO_GROUND,
                format!("choose it with --ground: a name, a number below, a point x,y in it, or below:Y{names}"),
            );
            draft.notes.extend(list);
        }
        self.bodies.sort_by_key(|b| b.kind == Role::Block);
        Ok(())
    }

    fn add(&mut self, draft: &mut Draft, part: &Part, rings: Rings, circle: Option<Circle>) {
        let polygon = match polygon(&rings) {
            Ok(polygon) => polygon,
            Err(flaws) => {
                remark_flaws(draft, part, &flaws);
                return;
            }
        };
        if part.kind == Role::Robot {
            self.robots.push(Robot { name: part.name.clone(), element: part.element.clone(), at: polygon.centroid() });
        } else {
            self.bodies.push(Body {
                kind: part.kind,
                name: part.name.clone(),
                element: part.element.clone(),
                rings,
                circle,
                fill: part.fill,
                values: part.values,
            });
        }
    }

    /// Returns the thickness of the thinnest body in metres. The thickness of a body is 2 A / P for its area A and
    /// perimeter P, which is exact for a long strip.
    pub(super) fn thinnest(&self) -> f64 {
        let thickness = |body: &Body| {
            let polygon = polygon(&body.rings).ok()?;
            let around: f64 = polygon.edges().map(|e| e.length()).sum();
            Some(2.0 * polygon.area() / around)
        };
        let all = self.bodies.iter().filter_map(thickness);
        all.fold(f64::INFINITY, f64::min)
    }

    /// Returns the bounding boxes of all bodies with the role `kind`: of the blocks, or of the parts of the ground.
    pub(super) fn boxes(&self, kind: Role) -> Vec<Bounds> {
        let bodies = self.bodies.iter().filter(|b| b.kind == kind);
        bodies.filter_map(|b| Bounds::from_points(b.rings.iter().flatten().map(|c| c.at))).collect()
    }

    /// Returns the number of parts of the ground.
    pub(super) fn ground(&self) -> usize {
        self.bodies.iter().filter(|b| b.kind == Role::Ground).count()
    }

    /// Returns the body to which a problem of the scene belongs.
    pub(super) fn body_of(&self, problem: &Problem) -> Option<&Body> {
        let block = entry(problem, "blocks").map(|i| self.ground() + i);
        self.bodies.get(block.or_else(|| entry(problem, "ground"))?)
    }

    /// Converts a problem of the scene to a remark about the element of the drawing.
    pub(super) fn located(&self, problem: &Problem) -> Remark {
        let ground = self.ground();
        let body = self.body_of(problem).map(|b| b.element.clone());
        let robot = || entry(problem, "robots").and_then(|i| self.robots.get(i)).map(|r| r.element.clone());
        // The user does not know the numbers of the ground's parts, so replace `ground[2]` by the name of its
        // element.
        let mut message = String::new();
        let mut segments = problem.message.split("ground[");
        message.extend(segments.next());
        for segment in segments {
            let named = segment.split_once(']').and_then(|(number, rest)| {
                let number: usize = number.parse().ok()?;
                let body = self.bodies[..ground].get(number)?;
                Some(format!("the ground's {}{rest}", body.element))
            });
            message += &named.unwrap_or_else(|| format!("ground[{segment}"));
        }
        Remark {
            element: body.or_else(robot).unwrap_or_else(|| problem.path.clone()),
            message,
            help: problem.help.clone(),
        }
    }
}

/// Returns the index of the entry of `list` to which a problem of the scene belongs.
fn entry(problem: &Problem, list: &str) -> Option<usize> {
    let rest = problem.path.strip_prefix(list)?.strip_prefix('[')?;
    rest.split(']').next()?.parse().ok()
}

/// Returns the parts of the rings inside all clip paths of `part`. A clip path that is not convex, and does not contain
/// the rings, is reported and not used.
fn clipped(draft: &mut Draft, part: &Part, mut rings: Vec<Vec<Corner>>, flatten: f64) -> Vec<Vec<Corner>> {
    for clip in &part.clips {
        let Some(mut window) = clip.flattened(flatten, 0.0) else { continue };
        if area(&window) < 0.0 {
            window.reverse();
        }
        let edges: Vec<[Point; 2]> =
            (0..window.len()).map(|i| [window[i].at, window[(i + 1) % window.len()].at]).collect();
        let left = |[a, b]: [Point; 2], p: Point| cross(b - a, p - a) / (b - a).norm();
        let slack = 1e-9 * Bounds::from_points(window.iter().map(|c| c.at)).map_or(0.0, Bounds::diagonal);
        let is_inside = |p: Point| edges.iter().all(|edge| left(*edge, p) >= -slack);
        if rings.iter().flatten().all(|corner| is_inside(corner.at)) {
            continue;
        }
        if !window.iter().all(|corner| is_inside(corner.at)) {
            let window = polygon(&vec![window]).ok();
            if !window.is_some_and(|w| rings.iter().flatten().all(|corner| w.contains(corner.at))) {
                let why = "its clip path is not convex; the whole outline is imported";
                draft.remark(&part.element, why, "cut the outline itself");
            }
            continue;
        }
        // Sutherland and Hodgman 1974: cut with one edge of the window after the other.
        for edge in edges {
            for ring in &mut rings {
                let mut kept: Vec<Corner> = Vec::new();
                for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                    let (from, to) = (left(edge, a.at), left(edge, b.at));
                    if from >= -slack {
                        kept.push(*a);
                    }
                    if (from > slack && to < -slack) || (from < -slack && to > slack) {
                        let at = a.at + (b.at - a.at) * (from / (from - to));
                        kept.push(Corner { at, curved: a.curved && from < 0.0 });
                    }
                }
                *ring = kept;
            }
            rings.retain(|ring| ring.len() > 2);
        }
        if rings.is_empty() {
            draft.lose("outline", &part.element, "its clip path hides it", "");
        }
    }
    rings
}

fn remark_flaws(draft: &mut Draft, part: &Part, flaws: &[PolygonError]) {
    let point = |p: &Point| format!("({:.4}, {:.4}) m", p.x, p.y);
    let (message, help) = match flaws.first() {
        Some(PolygonError::Crossing { at, .. }) => {
            let more = match flaws.len() {
                1 => String::new(),
                n => format!(", and in {} more places", n - 1),
            };
            (
                format!("its outline crosses or touches itself at {}{more}", point(at)),
                "draw it without crossings, or in parts",
            )
        }
        Some(PolygonError::HoleOutside { .. }) => (
            "its holes overlap or lie outside it".into(),
            "draw the holes inside the outline and apart from each other",
        ),
        _ => ("it encloses no area".into(), "draw it as an outline with an area"),
    };
    draft.lose("outline", &part.element, &message, help);
}

impl Body {
    /// Returns the polygon of the body. [`Outlines::new`] has found it valid; `None` if a later change has made it
    /// invalid.
    pub(super) fn polygon(&self) -> Option<Polygon> {
        self.circle.map(Circle::polygon).or_else(|| polygon(&self.rings).ok())
    }
}
