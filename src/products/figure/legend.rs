//! The legend: explains the colours and signs of a figure. It only lists those that occur.

mod sign;

use sign::{SAMPLE, load_dot, load_sign, missing_dot, weight_sign};

use super::arrow::{ArrowKind, ForceArrow, LEAST_SEEN, Marks, TurnKind};
use super::context::FigureContext;
use super::description;
use super::limit;
use super::option::{ArrowScale, Options};
use super::pen::{DOT_RADIUS, MIN_READABLE_UNIT_EDGE};
use super::words::{counted, quantity, round_below};
use crate::drawing::arrow::{HEAD_LENGTH, straight};
use crate::drawing::{
    Colour, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme, text,
};

/// Height of a line of the legend, as a multiple of its font size.
pub(crate) const LINE: f64 = 2.08;
/// Height of a line of the legend on a page as wide as a column of print, as a multiple of its font size.
pub(crate) const NARROW_LINE: f64 = 1.7;
/// Distance of the lines of an entry that needs several lines, as a multiple of the font size.
const WRAPPED_LINE: f64 = 1.25;
/// Smallest width of the text of an entry, pixels.
const MIN_WORDS_WIDTH: f64 = 60.0;
const ENTRY_GAP: f64 = 28.0;
const SIGN_GAP: f64 = 9.0;
/// Length of a line in the legend, pixels.
const LINE_LENGTH: f64 = 26.0;

/// An entry of the legend.
pub(crate) enum Entry {
    /// Arrow colours, each with the name of its block.
    Blocks(Vec<(Colour, String)>),
    /// The arrow colours alone, if there are too many blocks to list.
    Colours(Vec<Colour>),
    /// The disc of a robot: its colour and its name.
    Robot(Colour, String),
    /// The outline of a planned block.
    Planned(Colour),
    /// Missing forces.
    Missing,
    /// A bar of amplitude colours: the labels of its ends, the name of the quantity, and the colour of a share.
    Amplitudes([String; 2], String, fn(&Theme, f64) -> Colour),
    /// The scale of arrows: the length of an arrow from tail to tip and the width of its shaft in pixels, and its
    /// force.
    Scale(f64, f64, String),
    /// A line: its colour, its width in pixels, and its meaning.
    Line(Colour, f64, String),
    /// A scale bar: its length in pixels, and the length that it shows.
    Metres(f64, String),
    /// A note, such as on labels that are left out.
    Note(String),
    /// A sign: the function that draws it from the middle of its left end, its width in pixels, and its meaning.
    Sign(fn(PagePoint, &Theme) -> Vec<Item>, f64, String),
}

impl Entry {
    /// Returns the entry for a width of `room` pixels. Arrow colours lose the names of their blocks if these do not
    /// fit.
    pub(crate) fn fitted(self, room: f64, theme: &Theme) -> Entry {
        match self {
            Entry::Blocks(_) if self.width(theme) > room => Entry::Colours(theme.arrows.clone()),
            entry => entry,
        }
    }

    /// True if another entry has the same meaning.
    fn same(&self, other: &Entry) -> bool {
        match (self, other) {
            (Entry::Blocks(a), Entry::Blocks(b)) => a == b,
            (Entry::Colours(_), Entry::Colours(_))
            | (Entry::Planned(_), Entry::Planned(_))
            | (Entry::Missing, Entry::Missing) => true,
            (Entry::Robot(a, name), Entry::Robot(b, other)) => (a, name) == (b, other),
            (Entry::Amplitudes(a, what, _), Entry::Amplitudes(b, other, _)) => {
                (a, what) == (b, other)
            }
            (Entry::Line(_, a, what), Entry::Line(_, b, other)) => (a, what) == (b, other),
            (Entry::Scale(a, _, what), Entry::Scale(b, _, other)) => (a, what) == (b, other),
            (Entry::Metres(a, what), Entry::Metres(b, other)) => (a, what) == (b, other),
            (Entry::Note(a), Entry::Note(b)) | (Entry::Sign(_, _, a), Entry::Sign(_, _, b)) => {
                a == b
            }
            _ => false,
        }
    }

    /// Returns the width of the sign to the left of the text, including the gap between them, pixels.
    fn sign_width(&self, theme: &Theme) -> f64 {
        let wide = |words: &str| text::width(words, Face::Sans, theme.sizes.key);
        match self {
            Entry::Blocks(blocks) => blocks
                .iter()
                .map(|b| 8.0 + 22.0 + 5.0 + wide(&b.1))
                .fold(wide(ON_BLOCK), |sum, block| sum + block),
            Entry::Colours(colours) => 30.0 * colours.len() as f64,
            Entry::Robot(..) | Entry::Planned(_) => 2.0 * SIGN_GAP + 7.0,
            Entry::Missing => 34.0 + 7.0,
            Entry::Amplitudes([low, high], ..) => {
                wide(low) + 7.0 + BAR_LENGTH + 7.0 + wide(high) + 8.0
            }
            Entry::Scale(length, ..) | Entry::Metres(length, _) => length + 7.0,
            Entry::Line(..) => LINE_LENGTH + 7.0,
            Entry::Note(_) => 0.0,
            Entry::Sign(_, width, _) => width + 7.0,
        }
    }

    /// Returns the text to the right of the sign.
    fn words(&self) -> String {
        match self {
            Entry::Blocks(_) => String::new(),
            Entry::Colours(_) => COLOURS.to_owned(),
            Entry::Robot(_, id) => robot(id),
            Entry::Planned(_) => PLANNED.to_owned(),
            Entry::Missing => MISSING.to_owned(),
            Entry::Amplitudes(_, words, _)
            | Entry::Scale(_, _, words)
            | Entry::Line(_, _, words)
            | Entry::Metres(_, words)
            | Entry::Note(words)
            | Entry::Sign(_, _, words) => words.clone(),
        }
    }

    /// Returns the width of the entry in one line, pixels.
    fn width(&self, theme: &Theme) -> f64 {
        let words = text::width(&self.words(), Face::Sans, theme.sizes.key);
        self.sign_width(theme) + words
    }

    /// Draws the entry in one line with the middle of its left end at `at`.
    fn draw(&self, at: PagePoint, theme: &Theme) -> Vec<Item> {
        let mut items = self.sign(at, theme);
        let words = self.words();
        if !words.is_empty() {
            items.push(written(
                &words,
                at.moved(self.sign_width(theme), 0.0),
                theme,
            ));
        }
        items
    }

    /// Draws the sign of the entry with the middle of its left end at `at`.
    fn sign(&self, at: PagePoint, theme: &Theme) -> Vec<Item> {
        let size = theme.sizes.key;
        let words = |x: f64, words: &str| written(words, at.moved(x, 0.0), theme);
        match self {
            Entry::Blocks(blocks) => {
                let mut items = vec![words(0.0, ON_BLOCK)];
                let mut x = text::width(ON_BLOCK, Face::Sans, size);
                for (colour, id) in blocks {
                    x += 8.0;
                    items.push(
                        Path::filled(straight(at.moved(x, 0.0), (22.0, 0.0), 2.6), *colour).into(),
                    );
                    x += 22.0 + 5.0;
                    items.push(words(x, id));
                    x += text::width(id, Face::Sans, size);
                }
                items
            }
            Entry::Colours(colours) => {
                let arrow = |(i, colour): (usize, &Colour)| -> Item {
                    let shaft = straight(at.moved(30.0 * i as f64, 0.0), (22.0, 0.0), 2.6);
                    Path::filled(shaft, *colour).into()
                };
                colours.iter().enumerate().map(arrow).collect()
            }
            Entry::Robot(colour, _) => {
                let edge = colour.mixed(theme.ink, 0.35);
                let disc = Path::filled(
                    Outline::circle(at.moved(SIGN_GAP, 0.0), 0.8 * SIGN_GAP),
                    *colour,
                );
                vec![disc.with_stroke(Stroke::new(edge, 0.8)).into()]
            }
            Entry::Planned(colour) => {
                let hexagon = [
                    (-1.0, 0.0),
                    (-0.5, -0.87),
                    (0.5, -0.87),
                    (1.0, 0.0),
                    (0.5, 0.87),
                    (-0.5, 0.87),
                ];
                let corner = |(x, y): (f64, f64)| {
                    at.moved(SIGN_GAP + 0.85 * SIGN_GAP * x, 0.85 * SIGN_GAP * y)
                };
                let outline = Outline::ring(hexagon.map(corner));
                vec![Path::stroked(outline, Stroke::new(*colour, 1.8)).into()]
            }
            Entry::Missing => {
                vec![Path::filled(straight(at, (34.0, 0.0), 4.0), theme.failure).into()]
            }
            Entry::Amplitudes([low, high], _, ramp) => {
                let start = text::width(low, Face::Sans, size) + 7.0;
                let mut items = vec![words(0.0, low)];
                let parts = 64;
                for part in 0..parts {
                    // Each part reaches to the end of the bar, and the next part covers it, so that there are no gaps.
                    let x = BAR_LENGTH * f64::from(part) / f64::from(parts);
                    let rect = PageRect {
                        at: at.moved(start + x, -5.0),
                        width: BAR_LENGTH - x,
                        height: 10.0,
                    };
                    let fill = ramp(theme, (f64::from(part) + 0.5) / f64::from(parts));
                    items.push(Path::filled(Outline::rounded(rect, 0.0), fill).into());
                }
                items.push(words(start + BAR_LENGTH + 7.0, high));
                items
            }
            Entry::Line(colour, width, _) => {
                let line = Outline::line([at, at.moved(LINE_LENGTH, 0.0)]);
                let path = Path::stroked(line, Stroke::new(*colour, *width).mitred());
                vec![path.into()]
            }
            Entry::Metres(length, _) => {
                let mut bar = Outline::line([at, at.moved(*length, 0.0)]);
                for x in [0.0, *length] {
                    bar.extend(Outline::line([at.moved(x, -4.0), at.moved(x, 4.0)]));
                }
                vec![Path::stroked(bar, Stroke::new(theme.faint, 1.4)).into()]
            }
            Entry::Note(_) => Vec::new(),
            Entry::Sign(sign, ..) => sign(at, theme),
            Entry::Scale(length, width, _) => {
                vec![Path::filled(straight(at, (*length, 0.0), *width), theme.faint).into()]
            }
        }
    }
}

/// Returns a text of the legend. `at` is its left end, at half the height of the line.
fn written(words: &str, at: PagePoint, theme: &Theme) -> Item {
    let size = theme.sizes.key;
    let at = at.moved(0.0, 0.36 * size);
    Text::new(at, words, Face::Sans, size, theme.faint).into()
}

/// Replaces the space after each number by a non-breaking space, so that the number and the next word stay on one line.
fn glued(words: &str) -> String {
    let mut glued = String::with_capacity(words.len());
    let mut after_digit = false;
    for character in words.chars() {
        let joins = after_digit && character == ' ';
        glued.push(if joins { text::NO_BREAK } else { character });
        after_digit = character.is_ascii_digit();
    }
    glued
}

/// An entry with its text broken into lines.
struct Laid<'e> {
    entry: &'e Entry,
    lines: Vec<String>,
    width: f64,
}

impl<'e> Laid<'e> {
    /// Breaks the text of an entry so that the entry fits into `room` pixels.
    fn new(entry: &'e Entry, room: f64, theme: &Theme) -> Laid<'e> {
        let (words, size) = (entry.words(), theme.sizes.key);
        let sign = entry.sign_width(theme);
        let left = (room - sign).max(MIN_WORDS_WIDTH);
        let lines = text::balanced(&glued(&words), Face::Sans, size, left, usize::MAX);
        let lines: Vec<String> = lines
            .iter()
            .map(|l| l.replace(text::NO_BREAK, " "))
            .collect();
        let widths = lines.iter().map(|line| text::width(line, Face::Sans, size));
        let width = sign + widths.fold(0.0, f64::max);
        Laid {
            entry,
            lines,
            width,
        }
    }

    /// Returns the additional height compared with an entry of one line, pixels.
    fn extra_height(&self, theme: &Theme) -> f64 {
        self.lines.len().saturating_sub(1) as f64 * WRAPPED_LINE * theme.sizes.key
    }

    /// Draws the entry with the middle of its left end at `at`.
    fn draw(&self, at: PagePoint, theme: &Theme) -> Vec<Item> {
        let mut items = self.entry.sign(at, theme);
        let first = at.moved(
            self.entry.sign_width(theme),
            -0.5 * self.extra_height(theme),
        );
        for (number, line) in self.lines.iter().enumerate() {
            let down = number as f64 * WRAPPED_LINE * theme.sizes.key;
            items.push(written(line, first.moved(0.0, down), theme));
        }
        items
    }
}

/// Joins the entries of several legends, each entry once. If their arrow colours name different blocks, only the
/// colours remain.
pub(crate) fn joined(keys: Vec<Vec<Entry>>, theme: &Theme) -> Vec<Entry> {
    let mut all: Vec<Entry> = Vec::new();
    for entry in keys.into_iter().flatten() {
        if all.iter().any(|known| known.same(&entry)) {
            continue;
        }
        let blocks = |e: &Entry| matches!(e, Entry::Blocks(_) | Entry::Colours(_));
        match all.iter_mut().find(|known| blocks(known) && blocks(&entry)) {
            Some(known) => *known = Entry::Colours(theme.arrows.clone()),
            None => all.push(entry),
        }
    }
    all
}

/// Largest number of robots in the legend; the others are counted.
const MAX_LISTED_ROBOTS: usize = 16;
const ON_BLOCK: &str = "force on block";
const COLOURS: &str = "the forces on a block share a colour";
const PLANNED: &str = "planned block";
const MISSING: &str = "missing force, without which it falls";
/// The arrow of a torque has a least length, so that its direction is visible.
const TURNING: &str = "turning loads by their amounts, small ones drawn larger";
const BAR_LENGTH: f64 = 120.0;

/// Returns the name of a robot in the legend: `robot` and its name, or only its name if that begins with `robot`.
fn robot(id: &str) -> String {
    match id
        .get(..5)
        .is_some_and(|start| start.eq_ignore_ascii_case("robot"))
    {
        true => id.to_owned(),
        false => format!("robot {id}"),
    }
}

/// Returns an arrow that shows the scale of a panel. An arrow of `newtons` N is one unit edge (`unit` pixels) long, and
/// the largest force is `largest` N. Returns `None` if there is no force.
pub(crate) fn scale(newtons: f64, largest: f64, unit: f64, options: &Options) -> Option<Entry> {
    let largest = if options.printed() { newtons } else { largest };
    let amount = round_below(largest);
    let width = options.theme.widths.force * unit;
    // The arrow of the scale has the same form as the other arrows.
    let beyond = if options.printed() {
        HEAD_LENGTH * width
    } else {
        0.0
    };
    (amount > 0.0).then(|| {
        let length = amount / newtons * unit + beyond;
        Entry::Scale(length, width, quantity(amount, "N"))
    })
}

/// Returns the common scale of the arrows of all panels; `None` if there are no forces. `unit` is the unit edge in
/// pixels.
pub(crate) fn shared_scale(context: &FigureContext<'_>, unit: f64) -> Option<Entry> {
    let most = |of: fn(&Marks) -> f64| context.marks.iter().map(of).fold(0.0, f64::max);
    let newtons = most(|m| m.newtons_per_unit);
    scale(newtons, most(Marks::largest), unit, context.options)
}

/// Returns the entries for everything that occurs in a figure of forces. `unit` is the unit edge in pixels.
pub(crate) fn entries(context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
    let (scene, theme) = (&context.analysis.scene, &context.options.theme);
    let mut entries = Vec::new();
    if context.options.scale == ArrowScale::Strip {
        entries.extend(shared_scale(context, unit));
    }
    let scale_of_page = unit / context.unit;
    let is_seen = |a: &ForceArrow| a.reach().norm() * scale_of_page >= LEAST_SEEN;
    // If colours show the forces, or arrows are too small to be visible, no arrows have to be explained.
    let is_drawn = |kind: fn(ArrowKind) -> bool| {
        let mut arrows = context.marks.iter().flat_map(|m| &m.arrows);
        !context.arrows_too_small(scale_of_page) && arrows.any(|a| kind(a.kind) && is_seen(a))
    };
    let mut seen: Vec<(Colour, String)> = Vec::new();
    let mut clash = false;
    for (place, id) in scene
        .frames
        .iter()
        .flat_map(|f| f.placed.iter().enumerate())
    {
        let entry = (theme.arrow(place + 1), scene.blocks[id.0].id.clone());
        if !seen.contains(&entry) {
            clash |= seen.iter().any(|s| s.0 == entry.0 || s.1 == entry.1);
            seen.push(entry);
        }
    }
    let short = seen.iter().all(|s| s.1.chars().count() <= 12);
    if !clash && short && !seen.is_empty() && seen.len() <= 6 {
        entries.push(Entry::Blocks(seen));
    } else if seen.len() > 1 && is_drawn(|kind| !kind.is_failure()) {
        entries.push(Entry::Colours(theme.arrows.clone()));
    }
    // In small figures weights have no ring at their tails, so there is nothing to explain.
    if !context.options.printed()
        && unit >= MIN_READABLE_UNIT_EDGE
        && is_drawn(|kind| kind == ArrowKind::Weight)
    {
        let words = "weight, from the centroid".to_owned();
        entries.push(Entry::Sign(weight_sign, SAMPLE, words));
    }
    if !context.options.printed() && !context.arrows_too_small(scale_of_page) {
        entries.extend(limits(context));
    }
    entries.extend(loads(context));
    entries.extend(robots(context));
    let missing = context.marks.iter().any(|m| {
        m.arrows.iter().any(|a| a.kind.is_failure() && is_seen(a))
            || m.turns
                .iter()
                .any(|t| matches!(t.kind, TurnKind::Missing(_)))
    });
    if missing {
        entries.push(Entry::Missing);
    }
    let small = |kind: fn(ArrowKind) -> bool| {
        let mut arrows = context.marks.iter().flat_map(|m| &m.arrows);
        arrows.any(|a| kind(a.kind) && description::dotted(a, is_seen(a)))
    };
    if small(|kind| kind == ArrowKind::Load) {
        let words = "load too small for an arrow".to_owned();
        entries.push(Entry::Sign(load_dot, 2.0 * DOT_RADIUS, words));
    }
    if small(ArrowKind::is_failure) {
        let words = "missing force too small for an arrow".to_owned();
        entries.push(Entry::Sign(missing_dot, 2.0 * DOT_RADIUS, words));
    }
    let painted = scene.blocks.iter().any(|b| b.body.fill.is_none());
    if painted && context.fills.vary() {
        let (ends, what) = context.fills.key();
        entries.push(Entry::Amplitudes(ends, what, context.fills.ramp()));
    }
    entries
}

/// Returns a scale bar of a round number of metres. It is at most a quarter of `content` pixels long; `scale` is in
/// pixels per metre.
pub(crate) fn metres(scale: f64, content: f64) -> Option<Entry> {
    let metres = round_below(0.25 * content / scale);
    (metres > 0.0).then(|| Entry::Metres(metres * scale, quantity(metres, "m")))
}

/// Returns the sign of joints at their limit; `None` if no frame has such a joint.
pub(crate) fn limits(context: &FigureContext<'_>) -> Option<Entry> {
    let scene = &context.analysis.scene;
    let mut frames = context.analysis.frames.iter();
    let any = frames.any(|found| !limit::reached(scene, found).is_empty());
    any.then(|| Entry::Sign(limit::key_sign, 11.0, limit::MEANING.to_owned()))
}

/// Returns the sign of loads with their magnitudes; `None` if no frame shows a load.
pub(crate) fn loads(context: &FigureContext<'_>) -> Option<Entry> {
    let scene = &context.analysis.scene;
    let placed = |block| scene.frames.iter().any(|f| f.placed.contains(&block));
    let loads = scene.loads.iter().filter(|l| placed(l.block));
    let turns = loads.clone().any(|l| l.torque != 0.0);
    let amounts: Vec<f64> = loads.map(|l| l.force.norm()).filter(|a| *a > 0.0).collect();
    let least = amounts.iter().copied().fold(f64::INFINITY, f64::min);
    let most = amounts.iter().copied().fold(0.0, f64::max);
    let (least, most) = (quantity(least, "N"), quantity(most, "N"));
    let words = match amounts.len() {
        0 if turns => return Some(Entry::Note(TURNING.into())),
        0 => return None,
        1 => format!("load of {most}"),
        n if least == most => format!("{n} loads of {most} each"),
        n => format!("{n} loads of {least} to {most}"),
    };
    let words = match own_scale(context) {
        true => format!("{words}, drawn larger than other forces"),
        false => words,
    };
    let words = if turns {
        format!("{words}; {TURNING}")
    } else {
        words
    };
    Some(Entry::Sign(load_sign, SAMPLE, words))
}

/// True if the arrows of loads have a larger scale than other forces in any frame.
fn own_scale(context: &FigureContext<'_>) -> bool {
    let longer = |marks: &Marks, arrow: &ForceArrow| {
        let usual = arrow.force.norm() / marks.newtons_per_unit * context.unit;
        arrow.kind == ArrowKind::Load && arrow.vector.norm() > 1.01 * usual
    };
    let mut frames = context.marks.iter();
    frames.any(|marks| marks.arrows.iter().any(|arrow| longer(marks, arrow)))
}

/// Returns the robots that hold or plan a block in any frame, and the sign of a planned block.
pub(crate) fn robots(context: &FigureContext<'_>) -> Vec<Entry> {
    let (scene, theme) = (&context.analysis.scene, &context.options.theme);
    let mut entries = Vec::new();
    let holds = |number: usize| {
        scene
            .frames
            .iter()
            .any(|f| f.holds.iter().any(|h| h.robot.0 == number))
    };
    let plans = |number: usize| {
        scene
            .frames
            .iter()
            .any(|f| f.plans.iter().any(|p| p.robot.0 == number))
    };
    let busy = |number: &usize| holds(*number) || plans(*number);
    let busy: Vec<usize> = (0..scene.robots.len()).filter(busy).collect();
    for number in busy.iter().take(MAX_LISTED_ROBOTS) {
        let id = scene.robots[*number].id.clone();
        entries.push(Entry::Robot(theme.robot(*number), id));
    }
    if busy.len() > MAX_LISTED_ROBOTS {
        let left = busy.len() - MAX_LISTED_ROBOTS;
        entries.push(Entry::Note(format!("and {}", counted(left, "more robot"))));
    }
    if let Some(number) = (0..scene.robots.len()).find(|n| plans(*n)) {
        entries.push(Entry::Planned(theme.robot(number)));
    }
    entries
}

/// A line of the legend: entries next to each other.
#[derive(Default)]
struct KeyLine<'e> {
    entries: Vec<Laid<'e>>,
    width: f64,
}

/// Puts each entry into the first line of at most `room` pixels that has space for it.
fn lines<'e>(entries: &'e [Entry], room: f64, theme: &Theme) -> Vec<KeyLine<'e>> {
    let mut lines: Vec<KeyLine<'e>> = Vec::new();
    for entry in entries {
        let laid = Laid::new(entry, room, theme);
        let fits = |line: &&mut KeyLine<'e>| line.width + ENTRY_GAP + laid.width <= room;
        match lines.iter_mut().find(fits) {
            Some(line) => {
                line.width += ENTRY_GAP + laid.width;
                line.entries.push(laid);
            }
            None => lines.push(KeyLine {
                width: laid.width,
                entries: vec![laid],
            }),
        }
    }
    lines
}

/// Draws the legend in lines of at most `room` pixels, centred about `middle`, downwards from `top`. Also returns its
/// height in pixels. `line` is the height of a line as a multiple of the font size.
pub(crate) fn draw(
    entries: &[Entry],
    (middle, top): (f64, f64),
    room: f64,
    line: f64,
    theme: &Theme,
) -> (Group, f64) {
    let mut group = Group::with_class("key");
    let mut height = 0.0;
    for key_line in lines(entries, room, theme) {
        let extra = key_line.entries.iter().map(|e| e.extra_height(theme));
        let high = line * theme.sizes.key + extra.fold(0.0, f64::max);
        let mut at = PagePoint::new(middle - key_line.width / 2.0, top + height + high / 2.0);
        for entry in &key_line.entries {
            group.items.extend(entry.draw(at, theme));
            at = at.moved(entry.width + ENTRY_GAP, 0.0);
        }
        height += high;
    }
    (group, height)
}

/// Draws one entry with the middle of its left end at `at`. Also returns its width in pixels.
pub(crate) fn single(entry: &Entry, at: PagePoint, theme: &Theme) -> (Vec<Item>, f64) {
    (entry.draw(at, theme), entry.width(theme))
}

/// Returns the width of the widest entry, pixels.
pub(crate) fn widest(entries: &[Entry], theme: &Theme) -> f64 {
    let widths = entries.iter().map(|entry| entry.width(theme));
    widths.fold(0.0, f64::max)
}
