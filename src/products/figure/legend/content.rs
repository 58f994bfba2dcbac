//! Creates the entries of the legend for all symbols that occur in a figure.

use super::super::arrow::{ArrowKind, ForceArrow, MIN_VISIBLE_ARROW, Marks, TurnKind};
use super::super::context::FigureContext;
use super::super::description;
use super::super::label::{CROWDED_AMOUNTS, MAX_AMOUNTS};
use super::super::limit;
use super::super::option::{ArrowScale, Options};
use super::super::pen::{DOT_RADIUS, MIN_READABLE_UNIT_LENGTH};
use super::super::words::{counted, quantity, round_below_in};
use super::entry::{Entry, MissingWords};
use super::symbol::{BAR_LENGTH, SAMPLE_LENGTH, load_symbol, missing_dot, weight_symbol};
use crate::mechanics::scene::Frame;
use crate::mechanics::scene::format::UnitsEntry;
use crate::pictures::drawing::Colour;
use crate::pictures::drawing::arrow::HEAD_LENGTH;

/// The last words of the names of quantities that colours show. They are left out in a column of print.
const OF_A_BLOCK: &str = " of a block";
/// Length of a bar of colours in a column of print, pixels.
const NARROW_BAR: f64 = 72.0;
/// Largest number of robots in the legend; the others are counted.
const MAX_LISTED_ROBOTS: usize = 16;
/// The text for torques of loads. Their arrows all have the same length.
const TURN_TEXT: &str = "torques of loads not to scale";
/// Largest number of blocks that the legend names. With more blocks, it shows only the colours.
const MAX_NAMED_BLOCKS: usize = 6;
/// Largest length of a block's name in the legend, characters. With a longer name, the legend shows only the colours.
const MAX_NAME_LENGTH: usize = 12;

/// Returns the legend entries for all symbols that occur in a figure of forces. `unit` is the unit length in pixels.
pub(crate) fn entries(context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
    let options = context.options;
    let mut entries = Vec::new();
    if options.scale == ArrowScale::Strip {
        entries.extend(shared_scale(context, unit));
    }
    let drawn = DrawnArrows::new(context, unit);
    entries.extend(block_colours(context, &drawn));
    // The arrow of a weight has a small circle at its tail. Small figures omit this circle, so their legend does not
    // explain it.
    if !options.printed() && unit >= MIN_READABLE_UNIT_LENGTH && drawn.any(|kind| kind == ArrowKind::Weight) {
        let words = if options.is_column() { "weight" } else { "weight, from the centroid" };
        let weight = Entry::Symbol(weight_symbol, SAMPLE_LENGTH, words.to_owned());
        entries.push(weight);
    }
    if !options.printed() && !drawn.too_small {
        entries.extend(limits(context));
    }
    entries.extend(loads(context));
    entries.extend(robots(context));
    entries.extend(missing(context, &drawn));
    if drawn.any_dot(ArrowKind::is_failure) {
        let words = "missing force too small for an arrow".to_owned();
        entries.push(Entry::Symbol(missing_dot, 2.0 * DOT_RADIUS, words));
    }
    let mut blocks = context.analysis.scene.blocks.iter();
    if blocks.any(|b| b.body.fill.is_none()) && context.fills.vary() {
        let (ends, what) = context.fills.key();
        let (what, bar) = if options.is_column() {
            (what.trim_end_matches(OF_A_BLOCK).to_owned(), NARROW_BAR)
        } else {
            (what, BAR_LENGTH)
        };
        entries.push(Entry::Amplitudes(ends, what, context.fills.ramp(), bar));
    }
    entries
}

/// Which arrows of a figure are large enough to be visible.
struct DrawnArrows<'a> {
    context: &'a FigureContext<'a>,
    /// Pixels per metre.
    scale: f64,
    /// Whether arrows in general are too small to read. Colours then show the forces, and arrows are left out.
    too_small: bool,
}

impl<'a> DrawnArrows<'a> {
    fn new(context: &'a FigureContext<'a>, unit: f64) -> DrawnArrows<'a> {
        let scale = unit / context.unit;
        DrawnArrows { context, scale, too_small: context.arrows_too_small(scale) }
    }

    fn arrows(&self) -> impl Iterator<Item = &'a ForceArrow> {
        self.context.marks.iter().flat_map(|m| &m.arrows)
    }

    fn is_seen(&self, arrow: &ForceArrow) -> bool {
        arrow.reach().norm() * self.scale >= MIN_VISIBLE_ARROW || arrow.kind == ArrowKind::Load
    }

    /// True if the figure shows an arrow for which `kind` is true, so that the legend has to explain it. False if the
    /// figure shows no arrows because they are too small.
    fn any(&self, kind: fn(ArrowKind) -> bool) -> bool {
        !self.too_small && self.arrows().any(|a| kind(a.kind) && self.is_seen(a))
    }

    /// True if the figure draws a dot instead of a small arrow for which `kind` is true.
    fn any_dot(&self, kind: fn(ArrowKind) -> bool) -> bool {
        self.arrows().any(|a| kind(a.kind) && description::dotted(a, self.is_seen(a)))
    }
}

/// Returns the legend entry for the colours of arrows: all forces on a block have the same colour. The entry names the
/// blocks if there are few, their names are short, and each colour belongs to one block. Returns `None` if no colour
/// needs an explanation.
fn block_colours(context: &FigureContext<'_>, drawn: &DrawnArrows<'_>) -> Option<Entry> {
    let (scene, theme) = (&context.analysis.scene, &context.options.theme);
    let mut seen: Vec<(Colour, String)> = Vec::new();
    let mut clash = false;
    let placed = scene.frames.iter().map(|frame| &frame.placed);
    for (place, id) in placed.flat_map(|placed| placed.iter().enumerate()) {
        let entry = (theme.arrow(place + 1), scene.blocks[id.0].id.clone());
        if !seen.contains(&entry) {
            clash |= seen.iter().any(|s| s.0 == entry.0 || s.1 == entry.1);
            seen.push(entry);
        }
    }
    let short = |name: &str| name.chars().count() <= MAX_NAME_LENGTH;
    let short = seen.iter().all(|s| short(&s.1));
    if !clash && short && !seen.is_empty() && seen.len() <= MAX_NAMED_BLOCKS {
        Some(Entry::Blocks(seen))
    } else if seen.len() > 1 && drawn.any(|kind| !kind.is_failure()) {
        Some(Entry::Colours(theme.arrows.clone(), false))
    } else {
        None
    }
}

/// Returns the legend entry for missing forces and torques; `None` if no frame shows any of them.
fn missing(context: &FigureContext<'_>, drawn: &DrawnArrows<'_>) -> Option<Entry> {
    let mut forces = drawn.arrows();
    let mut turns = context.marks.iter().flat_map(|m| &m.turns);
    let any = forces.any(|a| a.kind.is_failure() && drawn.is_seen(a))
        || turns.any(|t| matches!(t.kind, TurnKind::Missing(_)));
    any.then_some(Entry::Missing(MissingWords::Usual))
}

/// Returns the legend entry for the scale of arrows: a sample arrow for a round force. The arrow of `newtons` N is one
/// unit length (`unit` pixels) long, and `largest` is the largest force in N. Returns `None` if there are no forces.
pub(crate) fn scale(newtons: f64, largest: f64, unit: f64, options: &Options, units: UnitsEntry) -> Option<Entry> {
    let largest = if options.printed() { newtons } else { largest };
    let amount = round_below_in(largest, units.force());
    let width = options.theme.widths.force * unit;
    // In printed figures, the length of the shaft shows the force. The head of the sample arrow is added to this
    // length.
    let beyond = if options.printed() { HEAD_LENGTH * width } else { 0.0 };
    (amount > 0.0).then(|| {
        let length = amount / newtons * unit + beyond;
        Entry::Scale(length, width, quantity(amount, units.force()))
    })
}

/// Returns the legend entry for the scale of arrows that all panels share; `None` if there are no forces. `unit` is the
/// unit length in pixels.
pub(crate) fn shared_scale(context: &FigureContext<'_>, unit: f64) -> Option<Entry> {
    let most = |of: fn(&Marks) -> f64| context.marks.iter().map(of).fold(0.0, f64::max);
    let newtons = most(|m| m.newtons_per_unit);
    let units = context.analysis.scene.units;
    scale(newtons, most(Marks::largest), unit, context.options, units)
}

/// Returns the legend entry with a scale bar for a round length. The bar is at most a quarter of `content` (pixels)
/// long; `scale` is in pixels per metre. Returns `None` if there is no such length.
pub(crate) fn metres(scale: f64, content: f64, units: UnitsEntry) -> Option<Entry> {
    let metres = round_below_in(0.25 * content / scale, units.length());
    (metres > 0.0).then(|| Entry::Metres(metres * scale, quantity(metres, units.length())))
}

/// Returns the legend entry for joints and robots at their limit; `None` if no frame has any of them.
pub(crate) fn limits(context: &FigureContext<'_>) -> Option<Entry> {
    let scene = &context.analysis.scene;
    let mut frames = context.analysis.frames.iter();
    let joints = frames.clone().any(|f| !limit::reached(scene, f).is_empty());
    let robots = frames.any(|f| !limit::robots_reached(scene, f).is_empty());
    let words = match (joints, robots) {
        (false, false) => return None,
        (true, false) if context.options.is_column() => limit::SHORT_LEGEND_TEXT,
        (true, false) => limit::LEGEND_TEXT,
        (false, true) => limit::ROBOT_LEGEND_TEXT,
        (true, true) if context.options.is_column() => limit::SHORT_JOINT_AND_ROBOT_LEGEND_TEXT,
        (true, true) => limit::JOINT_AND_ROBOT_LEGEND_TEXT,
    };
    Some(Entry::Symbol(limit::key_symbol, 11.0, words.to_owned()))
}

/// Returns the legend entry for loads, with their number and magnitudes. If all loads are torques, the entry is a note
/// on the scale of torques. Returns `None` if no frame has a load.
pub(crate) fn loads(context: &FigureContext<'_>) -> Option<Entry> {
    let scene = &context.analysis.scene;
    let placed = |block| scene.frames.iter().any(|f| f.placed.contains(&block));
    let loads = scene.loads.iter().filter(|l| placed(l.block));
    let turns = loads.clone().any(|l| l.torque != 0.0);
    let amounts: Vec<f64> = loads.map(|l| l.force.norm()).filter(|a| *a > 0.0).collect();
    // In a comparison, the list of loads contains the loads of two scenes. Therefore count the loads of each frame.
    let in_frame = |frame: &Frame| {
        let loads = scene.loads.iter().filter(|l| frame.placed.contains(&l.block));
        loads.filter(|l| l.force.norm() > 0.0).count()
    };
    let counts: Vec<usize> = scene.frames.iter().map(in_frame).collect();
    let most_in_frame = counts.iter().copied().max().unwrap_or(0);
    let number = if counts.iter().all(|count| *count == most_in_frame || *count == 0) {
        format!("{most_in_frame} ")
    } else {
        String::new()
    };
    let least = amounts.iter().copied().fold(f64::INFINITY, f64::min);
    let most = amounts.iter().copied().fold(0.0, f64::max);
    let unit = scene.units.force();
    let (least, most) = (quantity(least, unit), quantity(most, unit));
    let words = match amounts.len() {
        0 if turns => return Some(Entry::Note(TURN_TEXT.into())),
        0 => return None,
        _ if most_in_frame == 1 && least == most => format!("load of {most}"),
        _ if most_in_frame == 1 => format!("load of {least} to {most}"),
        _ if least == most => format!("{number}loads of {most} each"),
        2 => format!("{number}loads of {least} and {most}"),
        _ => format!("{number}loads of {least} to {most}"),
    };
    let words = if own_scale(context) { format!("{words}, drawn larger than other forces") } else { words };
    let words = if context.options.labels && has_too_many_loads(context) {
        format!("{words}, amounts at the largest {MAX_AMOUNTS}")
    } else {
        words
    };
    let words = if turns { format!("{words}; {TURN_TEXT}") } else { words };
    Some(Entry::Symbol(load_symbol, SAMPLE_LENGTH, words))
}

/// True if a frame has so many loads that magnitudes are written only for the largest.
fn has_too_many_loads(context: &FigureContext<'_>) -> bool {
    let loads = |marks: &Marks| {
        let arrows = marks.arrows.iter();
        arrows.filter(|arrow| arrow.kind == ArrowKind::Load).count()
    };
    context.marks.iter().any(|marks| loads(marks) > CROWDED_AMOUNTS)
}

/// True if, in at least one frame, an arrow of a load is drawn at a larger scale than the arrows of other forces. False
/// for frames in which all arrows are loads.
fn own_scale(context: &FigureContext<'_>) -> bool {
    let longer = |marks: &Marks, arrow: &ForceArrow| {
        if marks.newtons_per_unit == 0.0 {
            return false;
        }
        let usual = arrow.force.norm() / marks.newtons_per_unit * context.unit;
        arrow.kind == ArrowKind::Load && arrow.vector.norm() > 1.01 * usual
    };
    let other = |marks: &&Marks| marks.arrows.iter().any(|a| a.kind != ArrowKind::Load);
    let mut frames = context.marks.iter().filter(other);
    frames.any(|marks| marks.arrows.iter().any(|arrow| longer(marks, arrow)))
}

/// Returns the legend entries for the robots that hold or plan a block in at least one frame, and for planned blocks.
/// If there are very many robots, the last of them are only counted.
pub(crate) fn robots(context: &FigureContext<'_>) -> Vec<Entry> {
    let (scene, theme) = (&context.analysis.scene, &context.options.theme);
    let mut entries = Vec::new();
    let holds = |number: usize| scene.frames.iter().any(|f| f.holds.iter().any(|h| h.robot.0 == number));
    let plans = |number: usize| scene.frames.iter().any(|f| f.plans.iter().any(|p| p.robot.0 == number));
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
