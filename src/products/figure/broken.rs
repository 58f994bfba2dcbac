//! [`broken`]: draws the outlines of a scene file that may be invalid. Its problems are marked and numbered; forces are
//! not drawn.

use super::design::SCREEN_MARGIN;
use super::option::Options;
use crate::geometry::{Bounds, Point};
use crate::mechanics::scene::{BodyId, Code, Problem, Sketch, SketchedBody, Spot};
use crate::mechanics::statics::interface::Interfaces;
use crate::pictures::drawing::text::{cut, width, wrap};
use crate::pictures::drawing::{
    Anchor, Camera, Drawing, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, hatch,
};

/// Largest number of problems that are marked and listed, and also of gaps. All others are only counted.
const MAX_MARKED: usize = 30;
/// Width of the page if the options set none, pixels.
const DEFAULT_WIDTH: f64 = 900.0;
/// Largest height of the picture of the structure, as a fraction of the page's width.
const MAX_HEIGHT_SHARE: f64 = 0.7;

/// An entry of the list below the picture.
struct ListEntry {
    /// The number of the mark in the picture; `None` for an entry without a mark.
    number: Option<usize>,
    words: String,
}

impl ListEntry {
    fn numbered(number: usize, words: String) -> ListEntry {
        ListEntry { number: Some(number), words }
    }

    /// Returns a final entry such as `And 3 more gaps.` if there are more than [`MAX_MARKED`] entries of one kind.
    /// Otherwise returns `None`. `count` is the number of all entries of this kind, and `what` is their name in the
    /// plural.
    fn unlisted(count: usize, what: &str) -> Option<ListEntry> {
        let more = count.saturating_sub(MAX_MARKED);
        (more > 0).then(|| ListEntry { number: None, words: format!("And {more} more {what}.") })
    }
}

/// Draws the outlines of a scene file with its problems. A problem with a known position has a numbered mark there, and
/// each problem has an entry in the list below the picture. Narrow gaps between bodies that do not touch are marked and
/// listed too. Only the first 30 problems and the first 30 gaps are shown. Only the theme and the width of the options
/// are used.
///
/// # Example
/// ```
/// use drystone::{figure, output, scene::Sketch};
/// let sketch = Sketch::from_bytes(br#"{ "drystone": 1, "blocks": [
///     { "id": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]] },
///     { "id": "b", "polygon": [[1, 0], [4, 0], [4, 1], [1, 1]] }] }"#, None);
/// let svg = output::svg::write(&figure::broken(&sketch, &figure::Options::default()));
/// assert!(svg.contains("overlap by 1 m"));
/// ```
pub fn broken(sketch: &Sketch, options: &Options) -> Drawing {
    let theme = &options.theme;
    let wide = options.width.unwrap_or(DEFAULT_WIDTH);
    let room = wide - 2.0 * SCREEN_MARGIN;
    let (marks, entries) = marks(sketch);
    let title = title(sketch);
    let mut items = Vec::new();
    let mut y = SCREEN_MARGIN;
    let size = theme.sizes.title;
    let lines = wrap(&title, Face::SerifBold, size, room);
    for line in cut(lines, 3, Face::SerifBold, size, room) {
        y += size;
        let at = PagePoint::new(SCREEN_MARGIN, y);
        items.push(Text::new(at, line, Face::SerifBold, size, theme.ink).into());
        y += 0.3 * size;
    }
    y += 0.5 * SCREEN_MARGIN;
    if let Some(view) = view(sketch, &marks) {
        let scale = (room / view.width()).min(MAX_HEIGHT_SHARE * wide / view.height());
        let rect = PageRect {
            at: PagePoint::new(SCREEN_MARGIN + (room - scale * view.width()) / 2.0, y),
            width: scale * view.width(),
            height: scale * view.height(),
        };
        let camera = Camera::new(view, rect.at, scale);
        items.push(structure(sketch, &marks, &camera, rect, options).into());
        items.push(numbers(&marks, &camera, options).into());
        y += rect.height + 0.5 * SCREEN_MARGIN;
    }
    let (list, y) = list(&entries, y, room, options);
    items.push(list.into());
    let listed: Vec<&str> = entries.iter().map(|e| e.words.as_str()).collect();
    Drawing {
        width: wide,
        height: (y + SCREEN_MARGIN).ceil(),
        title,
        description: format!("The outlines of the scene file, without forces. {}", listed.join(" ")),
        background: Some(theme.page),
        items,
    }
}

/// Returns the title of the drawing: the title of the scene, followed by the number of its problems.
fn title(sketch: &Sketch) -> String {
    let verdict = match sketch.problems.list.len() {
        0 => "no problem found".to_owned(),
        1 => "refused, with 1 problem".to_owned(),
        count => format!("refused, with {count} problems"),
    };
    match sketch.title.as_str() {
        "" => verdict,
        title => format!("{title}: {verdict}"),
    }
}

/// Draws the list of problems and gaps, `room` pixels wide, downwards from the y coordinate `y` (pixels). Also returns
/// the y coordinate below the last line of the list.
fn list(entries: &[ListEntry], mut y: f64, room: f64, options: &Options) -> (Group, f64) {
    let theme = &options.theme;
    let size = theme.sizes.reason;
    let indent = 2.0 * DISC_RADIUS + 10.0;
    let mut list = Group::with_class("problems");
    for entry in entries {
        let lines = wrap(&entry.words, Face::Sans, size, room - indent);
        y += 0.6 * size;
        if let Some(number) = entry.number {
            let at = PagePoint::new(SCREEN_MARGIN + DISC_RADIUS, y + 0.65 * size);
            list = list.with(disc(number, at, options));
        }
        for line in cut(lines, 6, Face::Sans, size, room - indent) {
            y += size;
            let at = PagePoint::new(SCREEN_MARGIN + indent, y);
            list = list.with(Text::new(at, line, Face::Sans, size, theme.ink));
            y += 0.35 * size;
        }
    }
    (list, y)
}

/// Returns the marks in the picture, and the entries of the list below the picture.
fn marks(sketch: &Sketch) -> (Vec<NumberedMark>, Vec<ListEntry>) {
    let mut marks = Vec::new();
    let mut entries = Vec::new();
    let problems = sketch.problems.list.iter().zip(&sketch.places);
    for (i, (problem, spot)) in problems.enumerate().take(MAX_MARKED) {
        let number = i + 1;
        if let Some(Spot { at, bodies }) = spot {
            marks.push(NumberedMark { at: *at, bodies: bodies.clone(), code: Some(problem.code), number });
        }
        let words = problem_in_words(problem, spot.is_some());
        entries.push(ListEntry::numbered(number, words));
    }
    entries.extend(ListEntry::unlisted(sketch.problems.list.len(), "problems"));
    // The search for gaps needs a scene in which every body is valid. Overlaps do not matter.
    let scene = sketch.scene.as_ref();
    let near = scene.map(|scene| Interfaces::new(scene).near_misses);
    let near = near.unwrap_or_default();
    for (i, gap) in near.iter().enumerate().take(MAX_MARKED) {
        let number = sketch.problems.list.len().min(MAX_MARKED) + i + 1;
        let name = |id| sketch.body(id).map_or("", |body| body.name.as_str());
        let words = format!(
            "A gap of at most {} {} between {} and {}: they do not touch, so no force acts between them.",
            digits(gap.distance),
            sketch.units.length().symbol(),
            name(gap.bodies[0]),
            name(gap.bodies[1])
        );
        entries.push(ListEntry::numbered(number, words));
        marks.push(NumberedMark { at: gap.at, bodies: gap.bodies.to_vec(), code: None, number });
    }
    entries.extend(ListEntry::unlisted(near.len(), "gaps"));
    (marks, entries)
}

/// Describes a problem with its line and path in the scene file. `is_marked` is true if the picture has a mark for
/// the problem.
fn problem_in_words(problem: &Problem, is_marked: bool) -> String {
    let line = match problem.line {
        0 => String::new(),
        line => format!("line {line}, "),
    };
    let path = match problem.path.as_str() {
        "" => String::new(),
        path => format!("{path}: "),
    };
    let note = if is_marked { "" } else { " (not marked in the picture)" };
    format!("{line}{path}{}{note}.", problem.message)
}

/// Formats a positive number with two significant digits, or as an integer from 100 on. Returns `0` for any other
/// number.
fn digits(x: f64) -> String {
    if !(x > 0.0) {
        return "0".into();
    }
    let decimals = (1.0 - libm::floor(libm::log10(x))).clamp(0.0, 12.0);
    format!("{x:.*}", decimals as usize)
}

/// Radius of a number's disc, pixels.
const DISC_RADIUS: f64 = 9.0;
/// Distance between the hatched lines of an overlap, pixels.
const HATCH_SPACING: f64 = 5.0;

/// A numbered mark of a problem or a gap. `at` is its position in the units of the scene file, and `bodies` are the
/// bodies that have the problem or the gap.
struct NumberedMark {
    pub at: Point,
    pub bodies: Vec<BodyId>,
    /// The code of the problem; `None` for a gap.
    pub code: Option<Code>,
    pub number: usize,
}

/// Returns the shown part of the scene, in units of the scene file. It contains all blocks and marks, or the ground and
/// all marks if there are no blocks. Returns `None` if there is nothing to show, or only a single point.
fn view(sketch: &Sketch, marks: &[NumberedMark]) -> Option<Bounds> {
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
fn structure(sketch: &Sketch, marks: &[NumberedMark], camera: &Camera, rect: PageRect, options: &Options) -> Group {
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
            group = group.with(Path::stroked(Outline::lines(common), stroke));
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
fn numbers(marks: &[NumberedMark], camera: &Camera, options: &Options) -> Group {
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
        let distance = |other: &PagePoint| at.distance(*other);
        taken.iter().all(|other| distance(other) > 2.2 * DISC_RADIUS)
    };
    let far = |turn: usize| 2.2 * DISC_RADIUS * (1 + turn) as f64;
    let places = (0..20).flat_map(|turn| DIRECTIONS.map(|(x, y)| place.moved(far(turn) * x, far(turn) * y)));
    let mut places = places.filter(clear);
    places.next().unwrap_or(place)
}

/// Draws a disc with a number.
fn disc(number: usize, at: PagePoint, options: &Options) -> Group {
    let theme = &options.theme;
    let size = 1.2 * DISC_RADIUS;
    let words = Text::new(at.moved(0.0, 0.36 * size), number.to_string(), Face::SansBold, size, theme.ink);
    Group::with_class("number")
        .with(Path::filled(Outline::circle(at, DISC_RADIUS), theme.page).with_stroke(Stroke::new(theme.ink, 1.2)))
        .with(words.anchored(Anchor::Middle))
}
