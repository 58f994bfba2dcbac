//! [`broken`]: draws the outlines of an invalid scene, with marked and numbered problems and without forces.

use super::layout::MAX_MARGIN;
use super::option::Options;
use crate::drawing::hatch::{hatch, lines};
use crate::drawing::text::{cut, width, wrap};
use crate::drawing::{
    Anchor, Camera, Drawing, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text,
};
use crate::geometry::{Bounds, Point};
use crate::interface::Interfaces;
use crate::scene::{BodyId, Code, Sketch, SketchedBody, Spot};

/// Largest number of problems, and of gaps, that are marked and listed; the others are counted.
const SHOWN: usize = 30;
/// Width of the page if the options give none, pixels.
const WIDE: f64 = 900.0;
/// Largest height of the picture of the structure, as a share of the page's width.
const HIGH: f64 = 0.7;
/// Radius of a number's disc, pixels.
const DISC: f64 = 9.0;
/// Distance between the hatched lines of an overlap, pixels.
const HATCH: f64 = 5.0;

/// A numbered mark.
struct Marked {
    at: Point,
    bodies: Vec<BodyId>,
    /// The code of the problem; `None` for a gap.
    code: Option<Code>,
    number: usize,
}

/// Draws the outlines of a scene file with its problems. Each problem has a number at its position and an entry in the
/// list below. Gaps that are nearly contacts are marked too. Only the theme and the width of the options are used.
///
/// # Example
/// ```
/// use drystone::{figure, output, scene::Sketch};
/// let sketch = Sketch::from_bytes(br#"{ "drystone": 1, "blocks": [
///     { "id": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]] },
///     { "id": "b", "polygon": [[1, 0], [4, 0], [4, 1], [1, 1]] }] }"#, None);
/// let svg = output::svg::write(&figure::broken(&sketch, &figure::Options::default()));
/// assert!(svg.contains("overlap 1 m deep"));
/// ```
pub fn broken(sketch: &Sketch, options: &Options) -> Drawing {
    let theme = &options.theme;
    let wide = options.width.unwrap_or(WIDE);
    let room = wide - 2.0 * MAX_MARGIN;
    let (marks, entries) = marks(sketch);
    let count = sketch.problems.list.len();
    let verdict = match count {
        0 => "no problem found".to_owned(),
        1 => "refused, with 1 problem".to_owned(),
        _ => format!("refused, with {count} problems"),
    };
    let title = match sketch.title.as_str() {
        "" => verdict.clone(),
        title => format!("{title}: {verdict}"),
    };
    let mut items = Vec::new();
    let mut y = MAX_MARGIN;
    let size = theme.sizes.title;
    let lines = wrap(&title, Face::SerifBold, size, room);
    for line in cut(lines, 3, Face::SerifBold, size, room) {
        y += size;
        let at = PagePoint::new(MAX_MARGIN, y);
        items.push(Text::new(at, line, Face::SerifBold, size, theme.ink).into());
        y += 0.3 * size;
    }
    y += 0.5 * MAX_MARGIN;
    if let Some(view) = view(sketch, &marks) {
        let scale = (room / view.width()).min(HIGH * wide / view.height());
        let rect = PageRect {
            at: PagePoint::new(MAX_MARGIN + (room - scale * view.width()) / 2.0, y),
            width: scale * view.width(),
            height: scale * view.height(),
        };
        let camera = Camera::new(view, rect.at, scale);
        items.push(structure(sketch, &marks, &camera, rect, options).into());
        items.push(numbers(&marks, &camera, options).into());
        y += rect.height + 0.5 * MAX_MARGIN;
    }
    let size = theme.sizes.reason;
    let indent = 2.0 * DISC + 10.0;
    let mut list = Group::with_class("problems");
    for (number, entry) in &entries {
        let lines = wrap(entry, Face::Sans, size, room - indent);
        y += 0.6 * size;
        if let Some(number) = number {
            let at = PagePoint::new(MAX_MARGIN + DISC, y + 0.65 * size);
            list = list.with(disc(*number, at, options));
        }
        for line in cut(lines, 6, Face::Sans, size, room - indent) {
            y += size;
            let at = PagePoint::new(MAX_MARGIN + indent, y);
            list = list.with(Text::new(at, line, Face::Sans, size, theme.ink));
            y += 0.35 * size;
        }
    }
    items.push(list.into());
    let listed: Vec<&str> = entries.iter().map(|e| e.1.as_str()).collect();
    Drawing {
        width: wide,
        height: (y + MAX_MARGIN).ceil(),
        title,
        description: format!(
            "Outlines as they are written, without forces. {}",
            listed.join(" ")
        ),
        background: Some(theme.page),
        items,
    }
}

/// Returns the marks, and the entries of the list below the picture, each with the number of its mark if it has one.
fn marks(sketch: &Sketch) -> (Vec<Marked>, Vec<(Option<usize>, String)>) {
    let mut marks = Vec::new();
    let mut entries = Vec::new();
    let problems = sketch.problems.list.iter().zip(&sketch.places);
    for (i, (problem, spot)) in problems.enumerate().take(SHOWN) {
        let number = i + 1;
        if let Some(Spot { at, bodies }) = spot {
            marks.push(Marked {
                at: *at,
                bodies: bodies.clone(),
                code: Some(problem.code),
                number,
            });
        }
        let line = match problem.line {
            0 => String::new(),
            line => format!("line {line}, "),
        };
        let path = match problem.path.as_str() {
            "" => String::new(),
            path => format!("{path}: "),
        };
        let place = if spot.is_some() {
            ""
        } else {
            " (it has no place in the picture)"
        };
        entries.push((
            Some(number),
            format!("{line}{path}{}{place}.", problem.message),
        ));
    }
    let more = sketch.problems.list.len().saturating_sub(SHOWN);
    if more > 0 {
        entries.push((None, format!("And {more} more problems.")));
    }
    // Near misses are only found if each body is valid. Overlaps do not matter.
    let near = sketch
        .scene
        .as_ref()
        .map(|scene| Interfaces::new(scene).near_misses);
    let near = near.unwrap_or_default();
    for (i, gap) in near.iter().enumerate().take(SHOWN) {
        let number = sketch.problems.list.len().min(SHOWN) + i + 1;
        let name = |id| sketch.body(id).map_or("", |body| body.name.as_str());
        entries.push((
            Some(number),
            format!(
                "A gap of at most {} m between {} and {}, which carries nothing.",
                digits(gap.distance),
                name(gap.bodies[0]),
                name(gap.bodies[1])
            ),
        ));
        marks.push(Marked {
            at: gap.at,
            bodies: gap.bodies.to_vec(),
            code: None,
            number,
        });
    }
    let more = near.len().saturating_sub(SHOWN);
    if more > 0 {
        entries.push((None, format!("And {more} more gaps.")));
    }
    (marks, entries)
}

/// Formats a positive number with two significant digits, and any other number as `0`.
fn digits(x: f64) -> String {
    if !(x > 0.0) {
        return "0".into();
    }
    let decimals = (1.0 - libm::floor(libm::log10(x))).clamp(0.0, 12.0);
    format!("{x:.*}", decimals as usize)
}

/// Returns the part of the scene that is shown: all blocks and marks, or the ground if there are no blocks. Returns
/// `None` if it has no size.
fn view(sketch: &Sketch, marks: &[Marked]) -> Option<Bounds> {
    let corners = |blocks: bool| {
        let bodies = sketch.bodies.iter();
        let bodies = bodies.filter(move |b| matches!(b.id, BodyId::Block(_)) == blocks);
        Bounds::from_points(bodies.flat_map(|body| body.rings.iter().flatten().copied()))
    };
    let places = Bounds::from_points(marks.iter().map(|mark| mark.at));
    let shown = [corners(true).or_else(|| corners(false)), places];
    let around = shown.into_iter().flatten().reduce(Bounds::union)?;
    let size = around.width().max(around.height());
    // A single point gives no scale.
    (size > 0.0 && size.is_finite()).then(|| around.grown(0.1 * size))
}

/// Draws the bodies, and hatches the areas in which they overlap.
fn structure(
    sketch: &Sketch,
    marks: &[Marked],
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
        let stroke = if wrong(body.id) {
            Stroke::new(theme.failure, 2.0)
        } else {
            Stroke::new(theme.outline, 1.2)
        };
        let shape = Group::with_class("body")
            .titled(body.name.clone())
            .with(Path::filled(outline.clone(), fill).with_opacity(0.75))
            .with(Path::stroked(outline, stroke));
        group = group.with(shape);
    }
    for mark in marks.iter().filter(|m| m.code == Some(Code::Overlap)) {
        let pair: Vec<&SketchedBody> = (mark.bodies.iter())
            .filter_map(|id| sketch.body(*id))
            .collect();
        if let [a, b] = pair[..] {
            let rings = |body: &SketchedBody| -> Vec<Vec<PagePoint>> {
                let ring = |ring: &Vec<Point>| ring.iter().map(|p| camera.place(*p)).collect();
                body.rings.iter().map(ring).collect()
            };
            let common = shared(
                &hatch(&rings(a), rect, HATCH),
                &hatch(&rings(b), rect, HATCH),
            );
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

/// Returns the name of a block at its centre, or below a mark that is there. Returns `None` if there is no space.
fn name(body: &SketchedBody, marks: &[Marked], camera: &Camera, options: &Options) -> Option<Text> {
    let theme = &options.theme;
    let bounds = Bounds::from_points(body.rings.iter().flatten().copied())?;
    let (size, rect) = (theme.sizes.name, camera.rect(bounds));
    if width(&body.name, Face::Sans, size) > 0.9 * rect.width || size > 0.8 * rect.height {
        return None;
    }
    let middle = PagePoint::new(rect.at.x + rect.width / 2.0, rect.at.y + rect.height / 2.0);
    let reach = width(&body.name, Face::Sans, size) / 2.0 + 2.0 * DISC;
    let covered = marks.iter().any(|mark| {
        let place = camera.place(mark.at);
        (place.x - middle.x).abs() < reach && (place.y - middle.y).abs() < size
    });
    let down = if covered { size + DISC } else { 0.0 };
    if down + 0.5 * size > rect.height / 2.0 {
        return None;
    }
    let at = middle.moved(0.0, down + 0.35 * size);
    let words = Text::new(at, body.name.clone(), Face::Sans, size, theme.ink);
    Some(words.anchored(Anchor::Middle).with_halo(theme.block, 2.0))
}

/// Returns the common parts of the hatch lines of two bodies.
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

/// Draws the marks, each with its number in a disc next to it. The discs do not overlap.
fn numbers(marks: &[Marked], camera: &Camera, options: &Options) -> Group {
    let theme = &options.theme;
    let mut group = Group::with_class("marks");
    let mut taken: Vec<PagePoint> = Vec::new();
    for mark in marks {
        let place = camera.place(mark.at);
        let colour = if mark.code.is_some() {
            theme.failure
        } else {
            theme.ink
        };
        let stroke = Stroke::new(colour, 1.6);
        let sign = match mark.code {
            Some(Code::CrossingOutline) => {
                let mut cross = arm(place, 5.0, 5.0);
                cross.extend(arm(place, 5.0, -5.0));
                Path::stroked(cross, stroke)
            }
            Some(_) => Path::filled(Outline::circle(place, 2.6), colour),
            None => Path::stroked(Outline::circle(place, 5.0), stroke),
        };
        let at = beside(place, &taken);
        taken.push(at);
        let leader = Outline::line([place, at]);
        let ring = Group::with_class("mark")
            .titled(format!("mark {}", mark.number))
            .with(Path::stroked(leader, Stroke::new(colour, 0.8)))
            .with(sign)
            .with(disc(mark.number, at, options));
        group = group.with(ring);
    }
    group
}

fn arm(at: PagePoint, x: f64, y: f64) -> Outline {
    Outline::line([at.moved(-x, -y), at.moved(x, y)])
}

/// Returns the nearest position next to `place` at which a disc does not overlap the discs in `taken`.
fn beside(place: PagePoint, taken: &[PagePoint]) -> PagePoint {
    const AROUND: [(f64, f64); 8] = [
        (0.7, -0.7),
        (-0.7, -0.7),
        (0.7, 0.7),
        (-0.7, 0.7),
        (0.0, -1.0),
        (1.0, 0.0),
        (0.0, 1.0),
        (-1.0, 0.0),
    ];
    let clear = |at: &PagePoint| {
        let apart = |other: &PagePoint| libm::hypot(at.x - other.x, at.y - other.y);
        taken.iter().all(|other| apart(other) > 2.2 * DISC)
    };
    let far = |turn: usize| 2.2 * DISC * (1 + turn) as f64;
    let places =
        (0..20).flat_map(|turn| AROUND.map(|(x, y)| place.moved(far(turn) * x, far(turn) * y)));
    let mut places = places.filter(clear);
    places.next().unwrap_or(place)
}

/// Draws a disc with a number.
fn disc(number: usize, at: PagePoint, options: &Options) -> Group {
    let theme = &options.theme;
    let size = 1.2 * DISC;
    let words = Text::new(
        at.moved(0.0, 0.36 * size),
        number.to_string(),
        Face::SansBold,
        size,
        theme.ink,
    );
    Group::with_class("number")
        .with(
            Path::filled(Outline::circle(at, DISC), theme.page)
                .with_stroke(Stroke::new(theme.ink, 1.2)),
        )
        .with(words.anchored(Anchor::Middle))
}
