//! [`labels`]: draws names of blocks and robots, and magnitudes of forces, where they cover nothing.
//!
//! [`placement`](crate::drawing::placement) finds the positions; this file determines the labels and their preferred
//! positions. A name is inside its block if there is space, otherwise next to it with a leader line. Labels do not
//! cover arrows, outlines, discs or other labels. A label without a position is left out, and the figure counts these
//! labels. Blocks that the line below the verdict mentions come first; they are named in frames with any number of
//! blocks.

mod obstacle;
mod solid;
mod spoken;

pub(crate) use obstacle::ink;

use solid::Solids;
use spoken::names;

use super::arrow::{ArrowKind, ForceArrow, TurnArrow, TurnKind};
use super::context::FigureContext;
use super::pen::{DOT_RADIUS, Pen};
use super::view;
use super::words::{counted, listed, quantity};
use crate::drawing::placement::{Ink, LabelRequest, Placed, nearest, place_avoiding};
use crate::drawing::{
    Anchor, Colour, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, text,
};
use crate::geometry::{Bounds, Point, Polygon};
use crate::scene::{BlockId, BodyId};

/// In frames with more blocks than this only blocks that the text mentions are labelled.
pub(crate) const MAX_LABELLED_BLOCKS: usize = 60;
/// Largest number of magnitudes of loads and missing forces in such frames, approximately.
const MAX_WRITTEN: usize = 16;
/// If a unit edge is at least this long, pixels, names may be at any distance from their blocks …
const ROOMY_UNIT_EDGE: f64 = 26.0;
/// … and also in frames with at most this many blocks.
const FEW_BLOCKS: usize = 12;
/// Largest distance of a name from its block in other frames, pixels; longer leaders would hide the figure.
const MAX_DISTANCE: f64 = 8.0;
/// A name outside its block has a leader if another block's centroid is close: at most at this multiple of the distance
/// to its own block's centroid.
const AMBIGUITY_RATIO: f64 = 1.5;
/// Number of positions tried along each axis of a block.
const POSITIONS_PER_AXIS: usize = 13;
/// Least font size, pixels.
const MIN_SIZE: f64 = 9.0;
/// Distances from a block's centroid are rounded to this share of the block's diagonal, so that rounding errors do not
/// move a name.
const DISTANCE_STEP: f64 = 1e-3;
/// Largest number of lines of a name.
const MAX_LINES: usize = 3;
/// Distance of the lines of a name, as a multiple of the font size.
const LINE_PITCH: f64 = 1.1;
/// Distance of a broken name from the sides of its block, pixels.
const INSET: f64 = 4.0;
/// The prefix of a code point, which replaces a character that no font has.
const SPELLED: &str = "U+";
/// Height of a line, as a multiple of the font size.
const LINE_HEIGHT: f64 = 0.96;

/// A label without a position yet.
struct Label {
    /// Its lines of text.
    lines: Vec<String>,
    face: Face,
    size: f64,
    class: &'static str,
    request: LabelRequest,
    /// The colour of its arrow; `None` for plain text.
    colour: Option<Colour>,
    /// Whether the text below the frame mentions it. Then it is drawn in any case.
    named: bool,
    /// The block that it names. Inside another block it would seem to name that block.
    of: Option<BlockId>,
}

/// The class of the group of a frame's labels. The description of the group counts labels without a position.
pub(crate) const CLASS: &str = "labels";

/// A text at a point of a picture.
pub(crate) struct Callout {
    /// The point.
    pub at: PagePoint,
    /// Least distance of the text from the point, pixels.
    pub clear: f64,
    /// The text.
    pub words: String,
    /// The colour of the text.
    pub colour: Colour,
}

/// Draws the labels of a frame. They do not cover `ink`, which is only computed if there are labels. `view` is the
/// shown part of the scene, metres.
pub(crate) fn labels(pen: &Pen<'_>, view: Bounds, ink: impl FnOnce() -> Ink) -> Group {
    labels_with(pen, view, Vec::new(), ink)
}

/// Like [`labels`], with callouts, which are placed first.
pub(crate) fn labels_with(
    pen: &Pen<'_>,
    view: Bounds,
    callouts: Vec<Callout>,
    ink: impl FnOnce() -> Ink,
) -> Group {
    let mut group = Group::with_class(CLASS);
    let callouts = callouts.into_iter().filter(|_| pen.context.options.labels);
    let callouts = callouts.map(|callout| called_out(pen, callout));
    let labels: Vec<Label> = callouts.chain(all_labels(pen, view)).collect();
    if labels.is_empty() {
        return group;
    }
    let mut ink = ink();
    let page = pen.camera.rect(view);
    let requests: Vec<LabelRequest> = labels.iter().map(|l| l.request.clone()).collect();
    let solids = Solids::new(pen);
    let covers_other_block = |number: usize, rect: PageRect| {
        let own: Option<BlockId> = labels[number].of;
        own.is_some_and(|own| solids.other(pen, own, rect))
    };
    let places = place_avoiding(&mut ink, page, &requests, &covers_other_block);
    let mut missing: Vec<(&str, usize)> = Vec::new();
    for (label, placed) in labels.iter().zip(places) {
        if placed.is_none_or(|p| p.avoided) {
            pen.context.cramped.set(pen.context.cramped.get() + 1);
        }
        if let Some(mut placed) = placed {
            if placed.leader.is_none() && is_ambiguous(pen, label, placed.rect) {
                placed.leader = Some([
                    nearest(placed.rect, label.request.anchor),
                    label.request.anchor,
                ]);
            }
            group.items.push(drawn(pen, label, placed).into());
            continue;
        }
        if label.named {
            group.items.push(drawn_over(pen, label).into());
            continue;
        }
        let what = match label.class {
            "amount" => "amount",
            _ => "name",
        };
        match missing.iter_mut().find(|known| known.0 == what) {
            Some(known) => known.1 += 1,
            None => missing.push((what, 1)),
        }
    }
    let missing: Vec<String> = missing
        .into_iter()
        .map(|(what, n)| counted(n, what))
        .collect();
    if !missing.is_empty() {
        group.description = format!("no room for {}", listed(&missing));
    }
    group
}

/// True if a name lies outside its block and could be the name of another block, because its centroid is nearly as
/// close.
fn is_ambiguous(pen: &Pen<'_>, label: &Label, rect: PageRect) -> bool {
    let scene = &pen.context.analysis.scene;
    let Some(own) = label.of.filter(|_| label.class == "name") else {
        return false;
    };
    let at = pen.camera.back(middle(rect));
    let at = pen.displacement(own).map_or(at, |d| d.back(at));
    if scene.blocks[own.0].body.polygon.contains(at) {
        return false;
    }
    let far = |id: BlockId| {
        let anchor = pen.camera.place(pen.moved(id, scene.blocks[id.0].centroid));
        let end = nearest(rect, anchor);
        libm::hypot(end.x - anchor.x, end.y - anchor.y)
    };
    let others = scene.frames[pen.number].placed.iter().copied();
    let mut others = others.filter(|id| *id != own);
    others.any(|id| far(id) < AMBIGUITY_RATIO * far(own))
}

/// Returns the note on labels that are left out because a frame has too many blocks; `None` if no label is left out.
pub(crate) fn left_out(context: &FigureContext<'_>) -> Option<String> {
    let options = context.options;
    let frames = &context.analysis.scene.frames;
    let most = frames.iter().map(|f| f.placed.len()).max().unwrap_or(0);
    let what = match (options.labels, options.amounts) {
        (true, true) => "names and amounts",
        (true, false) => "names",
        (false, true) => "amounts",
        (false, false) => return None,
    };
    let named = (0..frames.len()).any(|frame| !mentioned(context, frame).is_empty());
    let but = if named {
        " but those the text names"
    } else {
        ""
    };
    (most > MAX_LABELLED_BLOCKS).then(|| format!("{most} blocks: {what} left out{but}"))
}

/// Returns all labels of a frame, the most important first.
fn all_labels(pen: &Pen<'_>, view: Bounds) -> Vec<Label> {
    let options = pen.context.options;
    let frame = &pen.context.analysis.scene.frames[pen.number];
    let scene = &pen.context.analysis.scene;
    let shown = |id: &&BlockId| {
        let body = &scene.blocks[id.0].body;
        options.zoom.is_none() || view::common(view, body.polygon.bounds()).is_some()
    };
    let few = frame.placed.iter().filter(shown).count() <= MAX_LABELLED_BLOCKS;
    let mut labels = Vec::new();
    if options.labels {
        let first = mentioned(pen.context, pen.number);
        let names = first.iter().filter_map(|id| name(pen, *id, view));
        labels.extend(names.map(|label| Label {
            named: true,
            ..label
        }));
        labels.extend(robots(pen, view));
        if few {
            let others = frame.placed.iter().filter(|id| !first.contains(id));
            // Long leaders in a crowded frame would hide the figure.
            let any_distance = pen.unit() >= ROOMY_UNIT_EDGE || frame.placed.len() <= FEW_BLOCKS;
            let names = others.filter_map(|id| name(pen, *id, view));
            labels.extend(names.map(|label| {
                let mut request = label.request;
                if !any_distance {
                    request.max_distance = request.max_distance.map(|far| far.min(MAX_DISTANCE));
                }
                Label { request, ..label }
            }));
        }
    }
    labels.extend(amounts(pen, few));
    labels.retain(|label| label.lines.iter().any(|line| !line.is_empty()));
    labels
}

/// Returns the blocks that the text below a frame mentions, in placing order.
fn mentioned(context: &FigureContext<'_>, frame: usize) -> Vec<BlockId> {
    let scene = &context.analysis.scene;
    let stated = &context.statements[frame];
    let placed = scene.frames[frame].placed.iter().copied();
    placed
        .filter(|id| names(stated, &scene.blocks[id.0].id))
        .collect()
}

/// Length of a block's edge for the font size of its name, as a share of the square root of its area.
const EDGE_SHARE: f64 = 0.6;
/// The name of a block whose edge is longer than this, in unit edges, has a font size of its own.
const LARGE_BLOCK: f64 = 3.0;

/// Returns the font size of the name of a block with an edge of this length; both in pixels.
fn name_size(pen: &Pen<'_>, edge: f64) -> f64 {
    (0.25 * edge)
        .max(MIN_SIZE)
        .min(pen.context.options.theme.sizes.name)
}

fn label(
    words: String,
    face: Face,
    size: f64,
    class: &'static str,
    request: LabelRequest,
) -> Label {
    let size_of = (text::width(&words, face, size), LINE_HEIGHT * size);
    Label {
        request: LabelRequest {
            size: size_of,
            ..request
        },
        lines: vec![words],
        face,
        size,
        class,
        colour: None,
        named: false,
        of: None,
    }
}

/// Breaks a name of several words into lines that fit into `across` pixels, if one line is too wide. Code points can be
/// separated too. Returns the label unchanged if it would need too many lines or a word would be split.
fn broken(label: Label, across: f64) -> Label {
    let name = label.lines.concat();
    if label.request.size.0 <= across {
        return label;
    }
    let (name, most) = match name.contains(SPELLED) {
        true => (name.replace(text::NO_BREAK, " "), 2 * MAX_LINES),
        false => (name, MAX_LINES),
    };
    let lines = text::balanced(&name, label.face, label.size, across, most + 1);
    // A name with a split word is not readable.
    let whole = lines.join(" ").split(' ').eq(name.split_whitespace());
    if !whole || lines.len() > most {
        return label;
    }
    let widths = lines.iter().map(|l| text::width(l, label.face, label.size));
    let size = (
        widths.fold(0.0, f64::max),
        label.size * (LINE_HEIGHT + LINE_PITCH * (lines.len() - 1) as f64),
    );
    let request = LabelRequest {
        size,
        ..label.request
    };
    Label {
        lines,
        request,
        ..label
    }
}

/// Returns the name of a block; `None` if a zoomed picture does not show any part of the block.
fn name(pen: &Pen<'_>, id: BlockId, view: Bounds) -> Option<Label> {
    let block = &pen.context.analysis.scene.blocks[id.0];
    let zoomed = pen.context.options.zoom.is_some();
    if zoomed && view::common(view, block.body.polygon.bounds()).is_none() {
        return None;
    }
    // The name of a large block among small blocks is larger.
    let own = pen
        .camera
        .length(EDGE_SHARE * libm::sqrt(block.body.polygon.area()));
    let size = if own > LARGE_BLOCK * pen.unit() {
        name_size(pen, own)
    } else {
        name_size(pen, pen.unit())
    };
    // The name of a small block is nearer to it.
    let extent = block.body.polygon.bounds().diagonal();
    let request = LabelRequest {
        anchor: pen.camera.place(pen.moved(id, block.centroid)),
        first_ring: (0.4 * pen.unit()).min(0.5 * pen.camera.length(extent) + 2.0),
        size: (0.0, 0.0),
        preferred: centres_inside(&block.body.polygon, block.centroid, zoomed.then_some(view))
            .into_iter()
            .map(|p| pen.camera.place(pen.moved(id, p)))
            .collect(),
        padding: 0.5 * size,
        max_distance: (!zoomed || view::holds(view, block.centroid)).then_some(f64::INFINITY),
    };
    let label = label(block.id.clone(), Face::SansBold, size, "name", request);
    let across = pen.camera.length(block.body.polygon.bounds().width()) - 2.0 * INSET;
    Some(Label {
        of: Some(id),
        ..broken(label, across)
    })
}

fn robots(pen: &Pen<'_>, view: Bounds) -> Vec<Label> {
    let scene = &pen.context.analysis.scene;
    let size = name_size(pen, pen.unit());
    // Names of robots are slightly smaller than names of blocks, but not below the least size.
    let size = (0.9 * size).max(size.min(MIN_SIZE));
    let named = |hold: &crate::scene::Hold| {
        let request = LabelRequest {
            anchor: pen.camera.place(pen.moved(hold.block, hold.at)),
            first_ring: pen.disc() + 2.0,
            size: (0.0, 0.0),
            preferred: Vec::new(),
            padding: 0.0,
            max_distance: Some(f64::INFINITY),
        };
        let id = scene.robots[hold.robot.0].id.clone();
        let block = scene.blocks[hold.block.0].body.polygon.bounds();
        let across = pen.camera.length(block.width()) - 2.0 * INSET;
        let label = label(id, Face::Sans, size, "robot-name", request);
        Label {
            of: Some(hold.block),
            ..broken(label, across)
        }
    };
    let zoomed = pen.context.options.zoom.is_some();
    let holds = scene.frames[pen.number].holds.iter();
    let shown = holds.filter(|hold| !zoomed || view::holds(view, hold.at));
    shown.map(named).collect()
}

/// Returns the font size of magnitudes, pixels.
fn amount_size(pen: &Pen<'_>) -> f64 {
    (0.2 * pen.unit())
        .max(MIN_SIZE)
        .min(pen.context.options.theme.sizes.amount)
}

/// Converts a callout to a label. If there is no space for it, it is left out and counted.
fn called_out(pen: &Pen<'_>, callout: Callout) -> Label {
    let request = LabelRequest {
        anchor: callout.at,
        first_ring: callout.clear,
        size: (0.0, 0.0),
        preferred: Vec::new(),
        padding: 0.0,
        max_distance: Some(f64::INFINITY),
    };
    let size = pen.context.options.theme.sizes.amount;
    Label {
        colour: Some(callout.colour),
        ..label(callout.words, Face::SansBold, size, "amount", request)
    }
}

/// Returns the labels with the magnitudes of arrows. If a frame does not have `few` blocks, they are only those of the
/// largest loads and missing forces.
fn amounts(pen: &Pen<'_>, few: bool) -> Vec<Label> {
    let marks = &pen.context.marks[pen.number];
    let size = amount_size(pen);
    // The two forces between two blocks have the same magnitude. Write it once, on the block with the lower index.
    let written_here = |arrow: &&ForceArrow| match (arrow.kind.partner(), arrow.on) {
        (Some(BodyId::Block(partner)), BodyId::Block(on)) => on.0 < partner.0,
        _ => true,
    };
    let least = least_written(pen, few);
    let given = |kind: ArrowKind| kind == ArrowKind::Load || kind.is_failure();
    let seen = |a: &&ForceArrow| pen.seen(a) || given(a.kind);
    let first = principal(pen);
    let is_first = |arrow: &ForceArrow| first.iter().any(|f| core::ptr::eq(*f, arrow));
    let wanted = |arrow: &&ForceArrow| {
        is_first(arrow) || (is_written(pen, arrow, few, least) && written_here(arrow))
    };
    let seen = marks.arrows.iter().filter(seen);
    let straight = seen.filter(wanted).map(|arrow| {
        let amount = quantity(arrow.force.norm(), "N");
        let words = match is_first(arrow) && !pen.context.options.amounts {
            true => format!("largest: {amount}"),
            false => amount,
        };
        let (from, along) = (pen.camera.place(arrow.at), pen.camera.turn(arrow.reach()));
        let wide = text::width(&words, Face::Sans, size);
        let request = LabelRequest {
            anchor: from.moved(0.5 * along.0, 0.5 * along.1),
            first_ring: (0.5 * pen.width(arrow)).max(DOT_RADIUS) + 3.0,
            size: (0.0, 0.0),
            preferred: centres_along(from, along, pen.width(arrow), (wide, LINE_HEIGHT * size)),
            padding: 0.0,
            max_distance: Some(f64::INFINITY),
        };
        Label {
            colour: Some(arrow.colour),
            ..label(words, Face::Sans, size, "amount", request)
        }
    });
    let turns = marks.turns.iter().filter(|t| pen.turn_seen(t));
    let options = pen.context.options;
    let is_given = |t: &&TurnArrow| t.kind == TurnKind::Load && options.labels;
    let turns = turns.filter(|t| (options.amounts && few) || is_given(t));
    let turning = turns.map(|turn| {
        let request = LabelRequest {
            anchor: pen.camera.place(turn.at),
            first_ring: pen.camera.length(0.7 * pen.context.unit),
            size: (0.0, 0.0),
            preferred: Vec::new(),
            padding: 0.0,
            max_distance: Some(f64::INFINITY),
        };
        let words = quantity(turn.torque.abs(), "N·m");
        Label {
            colour: Some(turn.colour),
            ..label(words, Face::Sans, size, "amount", request)
        }
    });
    straight.chain(turning).collect()
}

/// True if the magnitude of an arrow is written. Loads and missing forces of at least `least` N have magnitudes even if
/// the options do not request them: they are the question and the answer of a scene.
fn is_written(pen: &Pen<'_>, arrow: &ForceArrow, few: bool, least: f64) -> bool {
    let options = pen.context.options;
    let missing = arrow.kind.is_failure() && !options.printed();
    let given = arrow.kind == ArrowKind::Load || missing;
    (options.amounts && few) || (options.labels && given && arrow.force.norm() >= least)
}

/// Forces that differ by less than this share count as equal: ten times the tolerance of a proof of equilibrium.
pub(super) const SAME_FORCE: f64 = 1e-6;

/// Returns the arrows of the largest force between two bodies and of the largest force of a robot. Returns none if
/// arrows are too small or the options exclude labels.
fn principal<'a>(pen: &Pen<'a>) -> Vec<&'a ForceArrow> {
    let context = pen.context;
    let small = context.arrows_too_small(pen.camera.length(1.0));
    if small || pen.many() || context.options.printed() || !context.options.labels {
        return Vec::new();
    }
    let arrows = &context.marks[pen.number].arrows;
    let largest = |kind: fn(ArrowKind) -> bool| {
        let own = arrows.iter().filter(|a| kind(a.kind) && pen.seen(a));
        own.reduce(|most, a| {
            // If several forces are equal except for rounding, take the first, so that noise does not move a label.
            if a.force.norm() > (1.0 + SAME_FORCE) * most.force.norm() {
                a
            } else {
                most
            }
        })
    };
    let contact = largest(|kind| matches!(kind, ArrowKind::Contact(_)));
    let robot = largest(|kind| matches!(kind, ArrowKind::Robot(_)));
    contact.into_iter().chain(robot).collect()
}

/// Returns the least magnitude of a load or a missing force that is written in a frame, N. If the frame does not have
/// `few` blocks, only the largest magnitudes are written.
fn least_written(pen: &Pen<'_>, few: bool) -> f64 {
    if few {
        return 0.0;
    }
    let arrows = pen.context.marks[pen.number].arrows.iter();
    let given = arrows.filter(|a| a.kind == ArrowKind::Load || a.kind.is_failure());
    let mut amounts: Vec<f64> = given.map(|a| a.force.norm()).collect();
    amounts.sort_by(|a, b| b.total_cmp(a));
    amounts.get(MAX_WRITTEN).copied().unwrap_or(0.0)
}

/// Returns preferred centres of a label of this size: on both sides of an arrow's shaft, and beyond its tip. All
/// lengths are in pixels.
fn centres_along(
    from: PagePoint,
    along: (f64, f64),
    width: f64,
    (wide, high): (f64, f64),
) -> Vec<PagePoint> {
    let length = libm::hypot(along.0, along.1);
    if length.is_nan() || length <= 0.0 {
        return Vec::new();
    }
    let (ux, uy) = (along.0 / length, along.1 / length);
    // The distance of a label's centre from a line with this normal that touches the label.
    let reach = |x: f64, y: f64| x.abs() * wide / 2.0 + y.abs() * high / 2.0;
    let mut middles = Vec::new();
    for share in [0.5, 0.7, 0.3, 0.9, 0.1] {
        for side in [1.0, -1.0] {
            let (nx, ny) = (-uy * side, ux * side);
            let off = 1.5 * width + 2.5 + reach(nx, ny);
            middles.push(from.moved(along.0 * share + nx * off, along.1 * share + ny * off));
        }
    }
    let beyond = length + 3.0 + reach(ux, uy);
    middles.push(from.moved(ux * beyond, uy * beyond));
    middles
}

/// Returns preferred centres inside a polygon, those nearest to `middle` first. If a `view` is given, they are inside
/// the visible part.
fn centres_inside(polygon: &Polygon, middle: Point, view: Option<Bounds>) -> Vec<Point> {
    let whole = polygon.bounds();
    let bounds = view.and_then(|v| view::common(v, whole)).unwrap_or(whole);
    let share = |i: usize| (i as f64 + 0.5) / POSITIONS_PER_AXIS as f64;
    let points: Vec<Point> = (0..POSITIONS_PER_AXIS * POSITIONS_PER_AXIS)
        .map(|i| {
            let x = bounds.min.x + bounds.width() * share(i % POSITIONS_PER_AXIS);
            let y = bounds.min.y + bounds.height() * share(i / POSITIONS_PER_AXIS);
            Point::new(x, y)
        })
        .filter(|p| polygon.contains(*p))
        .collect();
    // Rounded distances are equal if they only differ by rounding errors. The sort is stable, so the order of the grid
    // then decides.
    let step = DISTANCE_STEP * whole.diagonal();
    let rank = |p: &Point| ((p - middle).norm() / step).round();
    let mut ranked: Vec<(f64, Point)> = points.into_iter().map(|p| (rank(&p), p)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.into_iter().map(|(_, p)| p).collect()
}

fn drawn(pen: &Pen<'_>, label: &Label, placed: Placed) -> Group {
    let theme = &pen.context.options.theme;
    let mut group = Group::with_class(label.class);
    if let Some(leader) = placed.leader {
        // A thin grey line is not visible on a dark fill, so draw a border in the colour of the page.
        let seam = Path::stroked(Outline::line(leader), Stroke::new(theme.page, 2.0));
        let line = Path::stroked(Outline::line(leader), Stroke::new(theme.faint, 0.7));
        group = group.with(seam.with_opacity(0.7)).with(line);
    }
    // A label does not cross outlines, so its background has one colour.
    let below = pen.below(middle(placed.rect));
    let colour = theme.letters_on(below, label.colour);
    let halo = pen.context.lines_cross_names.then_some(below);
    lettered(group, label, middle(placed.rect), colour, halo)
}

/// Draws a label without a free position at its anchor, with a halo around its letters.
fn drawn_over(pen: &Pen<'_>, label: &Label) -> Group {
    let below = pen.below(label.request.anchor);
    let colour = pen.context.options.theme.letters_on(below, label.colour);
    let group = Group::with_class(label.class);
    lettered(group, label, label.request.anchor, colour, Some(below))
}

/// Adds the lines of a label to a group, centred at the given point. If a halo is given, the letters get a halo of
/// that colour.
fn lettered(
    mut group: Group,
    label: &Label,
    middle: PagePoint,
    colour: Colour,
    halo: Option<Colour>,
) -> Group {
    let half = 0.5 * (label.lines.len() as f64 - 1.0);
    for (number, line) in label.lines.iter().enumerate() {
        let down = 0.36 + LINE_PITCH * (number as f64 - half);
        let at = middle.moved(0.0, down * label.size);
        let words = Text::new(at, line.as_str(), label.face, label.size, colour);
        let words = words.anchored(Anchor::Middle);
        group = group.with(match halo {
            Some(below) => words.with_halo(below, 1.5),
            None => words,
        });
    }
    group
}

fn middle(rect: PageRect) -> PagePoint {
    rect.at.moved(rect.width / 2.0, rect.height / 2.0)
}
