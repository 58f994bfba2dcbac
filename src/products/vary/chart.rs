//! [`map`] draws the regions of two numbers, [`curve`] a number of the result over one number that varies.

use super::{Question, axis_title, levels, short};
use crate::mechanics::vary::{Map, Range, Sample, State, ValueGrid, intervals};
use crate::pictures::chart::round_step;
use crate::pictures::drawing::{
    Anchor, Colour, Drawing, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme, text,
};
use crate::products::wording::number::digits;

/// The width of a picture without `--width-mm`, the margin around it, and the ratio of height and width of the plane, pixels.
const WIDTH: f64 = 560.0;
const MARGIN: f64 = 10.0;
const RATIO: f64 = 0.78;
/// The width of an isoline, pixels.
const ISOLINE_WIDTH: f64 = 0.9;

/// A plane with two axes on a page.
struct Plane<'a> {
    theme: &'a Theme,
    /// The place of the plane, pixels.
    rect: PageRect,
    /// The least and the largest value along each axis.
    from: [f64; 2],
    to: [f64; 2],
    /// The font size, pixels.
    size: f64,
    items: Vec<Item>,
}

/// An entry of the legend.
struct Key<'k> {
    words: &'k str,
    colour: Colour,
    mark: Mark,
}

/// The mark of an entry of the legend.
#[derive(Clone, Copy)]
enum Mark {
    Square,
    Dot,
    Line,
}

impl<'a> Plane<'a> {
    fn new(theme: &'a Theme, width: Option<f64>, ranges: [(f64, f64); 2], left: f64) -> Plane<'a> {
        let size = theme.sizes.key;
        let width = width.unwrap_or(WIDTH);
        let (left, right) = (MARGIN + left + 0.9 * size, MARGIN + 1.2 * size);
        let wide = (width - left - right).max(10.0 * size);
        let rect = PageRect { at: PagePoint::new(left, MARGIN + 2.0 * size), width: wide, height: RATIO * wide };
        let [x, y] = ranges;
        Plane { theme, rect, from: [x.0, y.0], to: [x.1, y.1], size, items: Vec::new() }
    }

    fn place(&self, [x, y]: [f64; 2]) -> PagePoint {
        let share = |value: f64, axis: usize| (value - self.from[axis]) / (self.to[axis] - self.from[axis]);
        let PageRect { at, width, height } = self.rect;
        at.moved(share(x, 0) * width, (1.0 - share(y, 1)) * height)
    }

    fn fill(&mut self, rings: &[Vec<[f64; 2]>], colour: Colour, title: &str) {
        let mut outline = Outline::default();
        for ring in rings {
            outline.extend(Outline::ring(ring.iter().map(|pair| self.place(*pair))));
        }
        if !outline.segments.is_empty() {
            let group = Group::with_class("region").titled(title).with(Path::filled(outline, colour));
            self.items.push(Item::Group(group));
        }
    }

    /// Draws lines of words around a middle.
    fn words(&mut self, at: PagePoint, lines: &[String], colour: Colour, face: Face) {
        let high = 1.25 * self.size;
        for (number, line) in lines.iter().enumerate() {
            let down = (number as f64 - 0.5 * (lines.len() as f64 - 1.0)) * high + 0.35 * self.size;
            let text = Text::new(at.moved(0.0, down), line, face, self.size, colour);
            self.items.push(text.anchored(Anchor::Middle).into());
        }
    }

    /// Draws the frame, the ticks with their numbers, and the names of the axes.
    fn axes(&mut self, names: [&str; 2], whole: [bool; 2]) {
        let (theme, size) = (self.theme, self.size);
        let PageRect { at, width, height } = self.rect;
        let corners = [at, at.moved(width, 0.0), at.moved(width, height), at.moved(0.0, height)];
        let mut frame =
            Group::with_class("axes").with(Path::stroked(Outline::ring(corners), Stroke::new(theme.ink, 1.0)));
        let tick = 0.35 * size;
        for (axis, is_whole) in whole.into_iter().enumerate() {
            let room = if axis == 0 { width / (4.5 * size) } else { height / (3.2 * size) };
            let (step, values) = ticks(self.from[axis], self.to[axis], room, is_whole);
            for value in values {
                let mut pair = self.from;
                pair[axis] = value;
                let from = self.place(pair);
                let (to, text_at, anchor) = match axis {
                    0 => (from.moved(0.0, tick), from.moved(0.0, tick + 1.05 * size), Anchor::Middle),
                    _ => (from.moved(-tick, 0.0), from.moved(-1.6 * tick, 0.35 * size), Anchor::End),
                };
                frame = frame
                    .with(Path::stroked(Outline::line([from, to]), Stroke::new(theme.ink, 1.0)))
                    .with(Text::new(text_at, number(value, step), Face::Sans, size, theme.ink).anchored(anchor));
            }
        }
        let below = at.moved(width / 2.0, height + tick + 2.5 * size);
        // The name of the upright axis stands above it, so that nobody turns the head.
        let above = PagePoint::new(MARGIN, at.y - 1.1 * size);
        self.items.push(Item::Group(
            frame
                .with(Text::new(below, names[0], Face::Sans, size, theme.ink).anchored(Anchor::Middle))
                .with(Text::new(above, names[1], Face::Sans, size, theme.ink)),
        ));
    }

    /// Draws the legend below the plane, and ends the drawing.
    fn finish(mut self, keys: &[Key<'_>], title: String, description: String) -> Drawing {
        let (theme, size) = (self.theme, self.size);
        let (left, right) = (self.rect.at.x, self.rect.at.x + self.rect.width);
        let (mut x, mut y) = (left, self.rect.at.y + self.rect.height + 5.0 * size);
        for key in keys {
            let wide = 1.4 * size + text::width(key.words, Face::Sans, size);
            if x > left && x + wide > right {
                (x, y) = (left, y + 1.5 * size);
            }
            let at = PagePoint::new(x + 0.4 * size, y - 0.35 * size);
            let half = 0.4 * size;
            let square = [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| at.moved(x, y));
            let mark = match key.mark {
                Mark::Dot => Path::filled(Outline::circle(at, 0.3 * size), key.colour),
                Mark::Line => Path::stroked(
                    Outline::line([at.moved(-1.5 * half, 0.0), at.moved(1.5 * half, 0.0)]),
                    Stroke::new(key.colour, ISOLINE_WIDTH),
                ),
                Mark::Square => {
                    Path::filled(Outline::ring(square), key.colour).with_stroke(Stroke::new(theme.faint, 0.7))
                }
            };
            self.items.push(mark.into());
            self.items
                .push(Text::new(PagePoint::new(x + 1.2 * size, y), key.words, Face::Sans, size, theme.ink).into());
            x += wide + 1.4 * size;
        }
        Drawing {
            width: (right + 1.2 * size + MARGIN).ceil(),
            height: (y + 0.4 * size + MARGIN).ceil(),
            title,
            description,
            background: Some(theme.page),
            items: self.items,
        }
    }
}

/// Returns round numbers between two values, at most about `room`, and their distance: 1, 2 or 5 times a power of ten.
fn ticks(from: f64, to: f64, room: f64, is_whole: bool) -> (f64, Vec<f64>) {
    let least = (to - from) / room.max(1.0);
    let step = round_step(least).max(if is_whole { 1.0 } else { 0.0 });
    let (first, last) = (libm::ceil(from / step - 1e-9) as i64, libm::floor(to / step + 1e-9) as i64);
    (step, (first..=last).map(|number| number as f64 * step).collect())
}

/// Writes a number of an axis. All numbers of an axis have as many decimals as their distance needs.
fn number(value: f64, step: f64) -> String {
    let decimals = libm::ceil(-libm::log10(step) - 1e-9).clamp(0.0, 15.0) as usize;
    if step < 1e-4 || value.abs() >= 1e6 {
        return digits(value);
    }
    format!("{value:.decimals$}").replace('-', "−")
}

/// The width of the widest number of an axis, pixels.
fn widest(from: f64, to: f64, theme: &Theme) -> f64 {
    let size = theme.sizes.key;
    let (step, values) = ticks(from, to, 10.0, false);
    values.into_iter().map(|value| text::width(&number(value, step), Face::Sans, size)).fold(0.0, f64::max)
}

/// Returns the colour of a region.
fn colour(theme: &Theme, state: State) -> Colour {
    match state {
        State::Holds => theme.stands.mixed(theme.page, 0.82),
        State::Fails => theme.falls.mixed(theme.page, 0.86),
        State::Undecided => theme.undecided.mixed(theme.page, 0.6),
        State::NoScene => theme.ground,
    }
}

/// Returns the colour of letters on a region.
fn letters(theme: &Theme, state: State) -> Colour {
    let own = match state {
        State::Holds => theme.stands,
        State::Fails => theme.falls,
        State::Undecided => theme.undecided,
        State::NoScene => theme.faint,
    };
    theme.letters_on(colour(theme, state), Some(own))
}

/// Draws a map of two numbers: its regions, their border and their names. With `field`, it also draws the isolines of a number
/// of the result. `width` is in pixels.
pub(crate) fn map(
    question: &Question,
    map: &Map,
    field: Option<&ValueGrid>,
    theme: &Theme,
    width: Option<f64>,
) -> Drawing {
    let [x, y] = &map.ranges;
    let ranges = [x.shown(), y.shown()];
    let mut plane = Plane::new(theme, width, ranges, widest(y.from, y.to, theme));
    let [(left, right), (low, high)] = ranges;
    let whole = vec![[left, low], [right, low], [right, high], [left, high]];
    plane.fill(&[whole], colour(theme, State::Fails), question.word(State::Fails));
    let mut border = Outline::default();
    let mut keys: Vec<Key<'_>> = Vec::new();
    for state in State::ALL {
        let rings = map.region(state);
        if rings.is_empty() {
            continue;
        }
        keys.push(Key { words: question.word(state), colour: colour(theme, state), mark: Mark::Square });
        if state == State::Fails {
            continue;
        }
        let outlines: Vec<Vec<[f64; 2]>> =
            rings.iter().map(|ring| ring.iter().map(|(pair, _)| *pair).collect()).collect();
        plane.fill(&outlines, colour(theme, state), question.word(state));
        for ring in rings {
            let next = ring.iter().cycle().skip(1);
            let lines = ring.iter().zip(next).filter(|((_, is_outer), _)| !is_outer);
            for run in runs(lines.map(|((from, _), (to, _))| [*from, *to])) {
                border.extend(Outline::line(run.into_iter().map(|pair| plane.place(pair))));
            }
        }
    }
    if !border.segments.is_empty() {
        let line = Path::stroked(border, Stroke::new(theme.ink, 1.6));
        plane.items.push(Item::Group(Group::with_class("border").with(line)));
    }
    // Isolines and their numbers are drawn first. The names of the regions must leave these numbers free.
    let mut taken: Vec<[PagePoint; 2]> = Vec::new();
    let ordinate = question.ordinate.as_deref().unwrap_or_default();
    if let Some(field) = field {
        isolines(&mut plane, field, &axis_title(ordinate, &question.units), &mut taken);
    }
    // A name in the middle of each region, and of each way to fall, where it fits.
    for (state, name, at, room) in names(question, map) {
        let room = 2.0 * room * plane.rect.width.min(plane.rect.height) - plane.size;
        let lines = text::wrap(&name, Face::Sans, plane.size, room.max(5.0 * plane.size));
        let wide = lines.iter().map(|line| text::width(line, Face::Sans, plane.size)).fold(0.0, f64::max);
        let (half, high) = (0.5 * wide + 3.0, 0.65 * plane.size * lines.len() as f64 + 3.0);
        let PageRect { at: corner, width, height } = plane.rect;
        let middle = plane.place(at);
        let middle = PagePoint::new(
            middle.x.clamp(corner.x + half, (corner.x + width - half).max(corner.x + half)),
            middle.y.clamp(corner.y + high, (corner.y + height - high).max(corner.y + high)),
        );
        let [from, to] = [middle.moved(-half, -high), middle.moved(half, high)];
        // No pair of another region lies below it, and no other name.
        let covers = |pair: &[f64]| {
            let at = plane.place([pair[0], pair[1]]);
            from.x <= at.x && at.x <= to.x && from.y <= at.y && at.y <= to.y
        };
        let is_other = |sample: &Sample| {
            let is_named = !sample.found.words.is_empty() && sample.found.state == State::Fails;
            sample.found.state != state || is_named && !name.ends_with(&format!(": {}", sample.found.words))
        };
        let hides = map.samples.iter().any(|sample| is_other(sample) && covers(&sample.at));
        let meets = taken.iter().any(|[a, b]| from.x < b.x && a.x < to.x && from.y < b.y && a.y < to.y);
        if !hides && !meets {
            taken.push([from, to]);
            plane.words(middle, &lines, letters(theme, state), Face::Sans);
        }
    }
    let lines = format!("lines: {}", axis_title(ordinate, &question.units));
    if field.is_some() {
        keys.push(Key { words: &lines, colour: theme.stands, mark: Mark::Line });
    }
    if let [Some(a), Some(b)] = question.given[..]
        && (x.from..=x.to).contains(&a)
        && (y.from..=y.to).contains(&b)
    {
        let dot =
            Path::filled(Outline::circle(plane.place([a, b]), 0.3 * plane.size), theme.ink).cased(theme.page, 1.2);
        plane.items.push(Item::Group(Group::with_class("given").titled("the scene as given").with(dot)));
        keys.push(Key { words: "the scene as given", colour: theme.ink, mark: Mark::Dot });
    }
    let name = |range: &Range| axis_title(&range.name, &question.units);
    plane.axes([&name(x), &name(y)], [x.is_whole, y.is_whole]);
    plane.finish(&keys, format!("{}: {} and {}", question.name, x.name, y.name), question.map_lines(map).join(" "))
}

/// Draws the isolines of a number of the result, and writes the value of each isoline on it: at its middle, or at the nearest
/// place where no other text is. If there is no such place, the value is left out. `taken` lists the places of texts.
fn isolines(plane: &mut Plane<'_>, field: &ValueGrid, name: &str, taken: &mut Vec<[PagePoint; 2]>) {
    let (theme, size) = (plane.theme, plane.size);
    let (ink, below) = (theme.stands, colour(theme, State::Holds));
    let levels = levels(field);
    let step = levels.windows(2).next().map_or(1.0, |pair| pair[1] - pair[0]);
    let mut group = Group::with_class("isolines").titled(name);
    let mut labels = Vec::new();
    for level in levels {
        let mut lines: Vec<Vec<PagePoint>> = field
            .lines(level)
            .into_iter()
            .map(|line| line.into_iter().map(|pair| plane.place(pair)).collect())
            .collect();
        let long = |line: &Vec<PagePoint>| {
            line.windows(2).map(|ends| libm::hypot(ends[1].x - ends[0].x, ends[1].y - ends[0].y)).sum::<f64>()
        };
        lines.sort_by(|a, b| long(b).total_cmp(&long(a)));
        let words = number(level, step);
        let (half, high) = (0.5 * text::width(&words, Face::Sans, size) + 2.0, 0.6 * size);
        if let Some(line) = lines.first().filter(|line| long(line) > 4.0 * half) {
            let mut places: Vec<usize> = (0..line.len()).collect();
            places.sort_by_key(|at| at.abs_diff(line.len() / 2));
            let is_inside = |[from, to]: &[PagePoint; 2]| {
                let PageRect { at, width, height } = plane.rect;
                from.x > at.x && from.y > at.y && to.x < at.x + width && to.y < at.y + height
            };
            let rooms = places.into_iter().map(|at| [line[at].moved(-half, -high), line[at].moved(half, high)]);
            let free = rooms.filter(is_inside).find(|[from, to]| {
                !taken.iter().any(|[a, b]| from.x < b.x && a.x < to.x && from.y < b.y && a.y < to.y)
            });
            if let Some(room) = free {
                // Wider than the text, so that other texts do not touch it.
                taken.push([room[0].moved(-0.4 * size, 0.0), room[1].moved(0.4 * size, 0.0)]);
                let at = PagePoint::new(room[0].x + half, room[0].y + high + 0.35 * size);
                let words = Text::new(at, words, Face::Sans, size, theme.letters_on(below, Some(ink)));
                labels.push(words.anchored(Anchor::Middle).with_halo(below, 4.0));
            }
        }
        for line in lines {
            group = group.with(Path::stroked(Outline::line(line), Stroke::new(ink, ISOLINE_WIDTH)));
        }
    }
    for label in labels {
        group = group.with(label);
    }
    plane.items.push(Item::Group(group));
}

/// Joins lines that follow each other.
fn runs(lines: impl Iterator<Item = [[f64; 2]; 2]>) -> Vec<Vec<[f64; 2]>> {
    let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
    for [from, to] in lines {
        match runs.last_mut() {
            Some(run) if run.last() == Some(&from) => run.push(to),
            _ => runs.push(vec![from, to]),
        }
    }
    runs
}

/// Returns a label for each region: its state, its words, a pair of values well inside, and how far it is to the next region, as
/// a share of the ranges. The values at which the structure falls are one region for each kind of mechanism: hinges, sliding, or
/// both.
fn names(question: &Question, map: &Map) -> Vec<(State, String, [f64; 2], f64)> {
    let shares = |at: &[f64]| {
        let share = |axis: usize| (at[axis] - map.ranges[axis].from) / (map.ranges[axis].to - map.ranges[axis].from);
        [share(0), share(1)]
    };
    let name = |sample: &Sample| match (sample.found.state, sample.found.words.as_str()) {
        (State::Fails, words) if !words.is_empty() => format!("{}: {words}", question.word(State::Fails)),
        (state, _) => question.word(state).to_owned(),
    };
    let all: Vec<(String, &Sample, [f64; 2])> =
        map.samples.iter().map(|sample| (name(sample), sample, shares(&sample.at))).collect();
    let differ = |a: &(String, &Sample, [f64; 2]), b: &(String, &Sample, [f64; 2])| {
        a.0 != b.0 && (a.1.found.state != b.1.found.state || !b.1.found.words.is_empty())
    };
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    let mut best: Vec<(State, String, [f64; 2], f64)> = Vec::new();
    let is_named = |sample: &Sample| sample.found.state != State::Fails || !sample.found.words.is_empty();
    let has_names = all.iter().any(|(_, sample, _)| sample.found.state == State::Fails && is_named(sample));
    for entry in all.iter().filter(|(_, sample, _)| !has_names || is_named(sample)) {
        let (own, sample, at) = entry;
        let others = all.iter().filter(|other| differ(entry, other)).map(|(_, _, other)| distance(*at, *other));
        // Half as far from the border of the picture is enough.
        let edge = at.iter().map(|share| 2.0 * share.min(1.0 - share)).fold(f64::INFINITY, f64::min);
        let room = others.fold(edge.max(0.0), f64::min);
        let pair = [sample.at[0], sample.at[1]];
        match best.iter_mut().find(|(_, name, ..)| name == own) {
            Some(entry) if entry.3 < room => *entry = (sample.found.state, own.clone(), pair, room),
            Some(_) => {}
            None => best.push((sample.found.state, own.clone(), pair, room)),
        }
    }
    best.retain(|(.., room)| *room > 0.06);
    best
}

/// Draws a number of the result over the number that varies. Where the structure falls, there is no curve. `width` is in
/// pixels.
pub(crate) fn curve(
    question: &Question,
    range: &Range,
    samples: &[Sample],
    theme: &Theme,
    width: Option<f64>,
) -> Drawing {
    let ordinate = question.ordinate.as_deref().unwrap_or_default();
    let ordinate_title = axis_title(ordinate, &question.units);
    let value = |sample: &Sample| sample.found.value.filter(|value| value.is_finite());
    let values: Vec<f64> = samples.iter().filter_map(value).collect();
    let (least, most) =
        values.iter().fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(*value), high.max(*value)));
    let top = if most > least { most + 0.06 * (most - least) } else { least + 1.0 };
    let low = if least < 0.0 { least - 0.06 * (most - least) } else { 0.0 };
    let mut plane = Plane::new(theme, width, [(range.from, range.to), (low, top)], widest(low, top, theme));
    let mut keys: Vec<Key<'_>> = Vec::new();
    let found = intervals(samples);
    for (number, interval) in found.iter().enumerate() {
        // Between two intervals, the border is drawn in the middle of the values that were examined.
        let from = if number == 0 { interval.from } else { 0.5 * (found[number - 1].to + interval.from) };
        let to = found.get(number + 1).map_or(interval.to, |next| 0.5 * (interval.to + next.from));
        let ring = vec![[from, low], [to, low], [to, top], [from, top]];
        let words = question.word(interval.state);
        plane.fill(&[ring], colour(theme, interval.state), words);
        if keys.iter().all(|key| key.words != words) {
            keys.push(Key { words, colour: colour(theme, interval.state), mark: Mark::Square });
        }
        if number > 0 {
            let line = Outline::line([plane.place([from, low]), plane.place([from, top])]);
            let end = Path::stroked(line, Stroke::new(theme.ink, 1.2).dashed([3.0, 2.0]));
            let below = found[number - 1].state == State::Holds;
            let value = if below { found[number - 1].to } else { interval.from };
            let (aside, anchor) = if below { (-0.4, Anchor::End) } else { (0.4, Anchor::Start) };
            let at = plane.place([from, top]).moved(aside * plane.size, 1.2 * plane.size);
            let words = Text::new(at, short(value), Face::Sans, plane.size, theme.ink).anchored(anchor);
            plane.items.push(Item::Group(Group::with_class("end").titled(short(value)).with(end).with(words)));
        }
    }
    let mut outline = Outline::default();
    for run in samples.chunk_by(|a, b| a.found.state == b.found.state && value(a).is_some() == value(b).is_some()) {
        let points: Vec<PagePoint> =
            run.iter().filter_map(|sample| Some(plane.place([sample.at[0], value(sample)?]))).collect();
        if points.len() > 1 {
            outline.extend(Outline::line(points));
        }
    }
    if !outline.segments.is_empty() {
        let line = Path::stroked(outline, Stroke::new(theme.ink, 1.8));
        plane.items.push(Item::Group(Group::with_class("curve").titled(&*ordinate_title).with(line)));
    }
    plane.axes([&axis_title(&range.name, &question.units), &ordinate_title], [range.is_whole, false]);
    let title = format!("{}: {ordinate} over {}", question.name, range.name);
    plane.finish(&keys, title, question.lines(range, samples).join(" "))
}
