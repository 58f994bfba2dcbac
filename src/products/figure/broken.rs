//! [`broken`]: draws the outlines of a scene file that may be invalid. Its problems are marked and numbered; forces are
//! not drawn.

mod picture;

use picture::{DISC_RADIUS, NumberedMark, disc, numbers, structure, view};

use super::design::SCREEN_MARGIN;
use super::option::Options;
use crate::mechanics::scene::{Problem, Sketch, Spot};
use crate::mechanics::statics::interface::Interfaces;
use crate::pictures::drawing::text::{cut, wrap};
use crate::pictures::drawing::{Camera, Drawing, Face, Group, PagePoint, PageRect, Text};

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
