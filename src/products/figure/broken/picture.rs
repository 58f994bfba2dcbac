//! Draws the outlines of a scene that may be invalid, with the numbered marks of its problems and gaps.

use super::super::option::Options;
use crate::geometry::{Bounds, Point};
use crate::mechanics::scene::{BodyId, Code, Sketch, SketchedBody};
use crate::pictures::drawing::hatch::{hatch, lines};
use crate::pictures::drawing::text::width;
use crate::pictures::drawing::{Anchor, Camera, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text};

/// Radius of a number's disc, pixels.
pub(super) const DISC_RADIUS: f64 = 9.0;
/// Distance between the hatched lines of an overlap, pixels.
const HATCH_SPACING: f64 = 5.0;

/// A numbered mark of a problem or a gap. `at` is its position in the units of the scene file, and `bodies` are the
/// bodies that have the problem or the gap.
pub(super) struct NumberedMark {
    pub at: Point,
    pub bodies: Vec<BodyId>,
    /// The code of the problem; `None` for a gap.
    pub code: Option<Code>,
    pub number: usize,
}

/// Returns the shown part of the scene, in units of the scene file. It contains all blocks and marks, or the ground and
/// all marks if there are no blocks. Returns `None` if there is nothing to show, or only a single point.
pub(super) fn view(sketch: &Sketch, marks: &[NumberedMark]) -> Option<Bounds> {
    let corners = |blocks: bool| {
        let bodies = sketch.bodies.iter();
        let bodies = bodies.filter(move |b| matches!(b.id, BodyId::Block(_)) == blocks);
        Bounds::from_points(bodies.flat_map(|body| body.rings.iter().flatten().copied()))
    };
    let places = Bounds::from_points(marks.iter().map(|mark| mark.at));
    let shown = [corners(true).or_else(|| corners(false)), places];
    let around = shown.into_iter().flatten().reduce(Bounds::union)?;
    let size = around.width().max(around.height());
    // The scale cannot be computed for a single point.
    (size > 0.0 && size.is_finite()).then(|| around.grown(0.1 * size))
}

/// Draws the bodies and the names of the blocks, and hatches the areas in which bodies overlap.
pub(super) fn structure(
    sketch: &Sketch,
    marks: &[NumberedMark],
    camera: &Camera,
    rect: PageRect,
    options: &Options,
) -> Group {
    let theme = &options.theme;
    let mut group = Group::with_class("bodies");
    group.clip = Some(rect);
    let wrong = |id: BodyId| (marks.iter()).any(|m| m.code.is_some() && m.bodies.contains(&id));
    for body in &sketch.bodies {
        let outline = drawn(body, camera);
        let fill = match body.id {
            BodyId::Ground(_) => theme.ground,
            BodyId::Block(_) => theme.block,
        };
        let stroke = if wrong(body.id) { Stroke::new(theme.failure, 2.0) } else { Stroke::new(theme.outline, 1.2) };
        let shape = Group::with_class("body")
            .titled(body.name.clone())
            .with(Path::filled(outline.clone(), fill).with_opacity(0.75))
            .with(Path::stroked(outline, stroke));
        group = group.with(shape);
    }
    for mark in marks.iter().filter(|m| m.code == Some(Code::Overlap)) {
        let pair: Vec<&SketchedBody> = (mark.bodies.iter()).filter_map(|id| sketch.body(*id)).collect();
        if let [a, b] = pair[..] {
            let rings = |body: &SketchedBody| -> Vec<Vec<PagePoint>> {
                let ring = |ring: &Vec<Point>| ring.iter().map(|p| camera.place(*p)).collect();
                body.rings.iter().map(ring).collect()
            };
            let common = shared(&hatch(&rings(a), rect, HATCH_SPACING), &hatch(&rings(b), rect, HATCH_SPACING));
            let stroke = Stroke::new(theme.failure, 1.4);
            group = group.with(Path::stroked(lines(&common), stroke));
        }
    }
    for body in &sketch.bodies {
        if let (BodyId::Block(_), Some(name)) = (body.id, name(body, marks, camera, options)) {
            group = group.with(name);
        }
    }
    group
}

/// Returns the outline of a body on the page.
fn drawn(body: &SketchedBody, camera: &Camera) -> Outline {
    let mut outline = Outline::default();
    for ring in &body.rings {
        outline.extend(Outline::ring(ring.iter().map(|p| camera.place(*p))));
    }
    outline
}

/// Draws the name of a block at the centre of its bounding box, or below the centre if a mark covers it. Returns `None`
/// if there is no space for the name.
fn name(body: &SketchedBody, marks: &[NumberedMark], camera: &Camera, options: &Options) -> Option<Text> {
    let theme = &options.theme;
    let bounds = Bounds::from_points(body.rings.iter().flatten().copied())?;
    let (size, rect) = (theme.sizes.name, camera.rect(bounds));
    if width(&body.name, Face::Sans, size) > 0.9 * rect.width || size > 0.8 * rect.height {
        return None;
    }
    let middle = PagePoint::new(rect.at.x + rect.width / 2.0, rect.at.y + rect.height / 2.0);
    let reach = width(&body.name, Face::Sans, size) / 2.0 + 2.0 * DISC_RADIUS;
    let covered = marks.iter().any(|mark| {
        let place = camera.place(mark.at);
        (place.x - middle.x).abs() < reach && (place.y - middle.y).abs() < size
    });
    let down = if covered { size + DISC_RADIUS } else { 0.0 };
    if down + 0.5 * size > rect.height / 2.0 {
        return None;
    }
    let at = middle.moved(0.0, down + 0.35 * size);
    let words = Text::new(at, body.name.clone(), Face::Sans, size, theme.ink);
    Some(words.anchored(Anchor::Middle).with_halo(theme.block, 2.0))
}

/// Returns the segments along which a hatch line of one body coincides with a hatch line of the other body.
fn shared(a: &[[PagePoint; 2]], b: &[[PagePoint; 2]]) -> Vec<[PagePoint; 2]> {
    let level = |line: &[PagePoint; 2]| line[0].y - line[0].x;
    let mut common = Vec::new();
    for one in a {
        for other in b {
            if (level(one) - level(other)).abs() > 0.1 {
                continue;
            }
            let (from, to) = (one[0].x.max(other[0].x), one[1].x.min(other[1].x));
            if to > from {
                let at = |x: f64| PagePoint::new(x, x + level(one));
                common.push([at(from), at(to)]);
            }
        }
    }
    common
}

/// Draws the marks, each with its number in a disc next to it. The discs do not overlap if there is space.
pub(super) fn numbers(marks: &[NumberedMark], camera: &Camera, options: &Options) -> Group {
    let theme = &options.theme;
    let mut group = Group::with_class("marks");
    let mut taken: Vec<PagePoint> = Vec::new();
    for mark in marks {
        let place = camera.place(mark.at);
        let colour = if mark.code.is_some() { theme.failure } else { theme.ink };
        let stroke = Stroke::new(colour, 1.6);
        let symbol = match mark.code {
            Some(Code::CrossingOutline) => {
                let mut cross = cross_arm(place, 5.0, 5.0);
                cross.extend(cross_arm(place, 5.0, -5.0));
                Path::stroked(cross, stroke)
            }
            Some(_) => Path::filled(Outline::circle(place, 2.6), colour),
            None => Path::stroked(Outline::circle(place, 5.0), stroke),
        };
        let at = free_disc_position(place, &taken);
        taken.push(at);
        let leader = Outline::line([place, at]);
        let ring = Group::with_class("mark")
            .titled(format!("mark {}", mark.number))
            .with(Path::stroked(leader, Stroke::new(colour, 0.8)))
            .with(symbol)
            .with(disc(mark.number, at, options));
        group = group.with(ring);
    }
    group
}

fn cross_arm(at: PagePoint, x: f64, y: f64) -> Outline {
    Outline::line([at.moved(-x, -y), at.moved(x, y)])
}

/// Returns a position next to `place`, at which a disc covers neither `place` nor a disc with its centre in `taken`.
/// Returns `place` if there is no such position nearby.
fn free_disc_position(place: PagePoint, taken: &[PagePoint]) -> PagePoint {
    const DIRECTIONS: [(f64, f64); 8] =
        [(0.7, -0.7), (-0.7, -0.7), (0.7, 0.7), (-0.7, 0.7), (0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)];
    let clear = |at: &PagePoint| {
        let distance = |other: &PagePoint| libm::hypot(at.x - other.x, at.y - other.y);
        taken.iter().all(|other| distance(other) > 2.2 * DISC_RADIUS)
    };
    let far = |turn: usize| 2.2 * DISC_RADIUS * (1 + turn) as f64;
    let places = (0..20).flat_map(|turn| DIRECTIONS.map(|(x, y)| place.moved(far(turn) * x, far(turn) * y)));
    let mut places = places.filter(clear);
    places.next().unwrap_or(place)
}

/// Draws a disc with a number.
pub(super) fn disc(number: usize, at: PagePoint, options: &Options) -> Group {
    let theme = &options.theme;
    let size = 1.2 * DISC_RADIUS;
    let words = Text::new(at.moved(0.0, 0.36 * size), number.to_string(), Face::SansBold, size, theme.ink);
    Group::with_class("number")
        .with(Path::filled(Outline::circle(at, DISC_RADIUS), theme.page).with_stroke(Stroke::new(theme.ink, 1.2)))
        .with(words.anchored(Anchor::Middle))
}
