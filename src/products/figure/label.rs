//! [`labels`]: names of blocks and robots, and amounts on request, where they hide nothing.
//!
//! A name stands inside its block where there is room, beside it with a leader line where there is none. Labels lie on
//! no arrow, outline, disc or other label; one for which nowhere is clear is left out, and the figure counts those. What
//! the words below a frame name comes first, and bears its name in a frame of any number of blocks.

mod obstacle;
mod solid;
mod spoken;

pub(crate) use obstacle::ink;

use solid::Solids;
use spoken::names;

use super::arrow::{ArrowKind, ForceArrow, TurnKind};
use super::context::FigureContext;
use super::pen::{DOT, Pen};
use super::view;
use super::words::{counted, listed, quantity};
use crate::drawing::placement::{Ink, LabelRequest, Placed, nearest, place_where};
use crate::drawing::{
    Anchor, Colour, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, text,
};
use crate::geometry::{Bounds, Point, Polygon};
use crate::scene::{BlockId, BodyId};

/// Above so many blocks in a frame labels would be soup.
pub(crate) const MOST_BLOCKS: usize = 60;
/// Where a unit edge is at least this long, pixels, any name may stand beside its block …
const ROOMY: f64 = 26.0;
/// … and of so many blocks in any case.
const FEW: usize = 12;
/// In other frames a name stands in its block or beside it, at most so many pixels off.
const BESIDE: f64 = 8.0;
/// A name beside its block has a leader where another block's middle is less than so many times as far.
const DOUBT: f64 = 1.5;
/// Places tried along each axis of a block.
const TRIED: usize = 13;
/// Letters are no smaller than this, pixels.
const SMALLEST: f64 = 9.0;
/// Distances from a block's middle are ranked in steps of this share of the block's diagonal.
const RANK: f64 = 1e-3;
/// A name of several words has at most so many lines …
const MOST_LINES: usize = 3;
/// … so far apart, in sizes, …
const PITCH: f64 = 1.1;
/// … and keeps so far from the sides of its block, pixels.
const INSET: f64 = 4.0;
/// How a character is spelled out that no font has.
const SPELLED: &str = "U+";
/// Height of a line of letters, in sizes.
const HIGH: f64 = 0.96;

/// A label before it has a place.
struct Label {
    /// Its words, in lines.
    lines: Vec<String>,
    face: Face,
    size: f64,
    class: &'static str,
    request: LabelRequest,
    /// The colour of what it tells of; `None` for plain letters.
    colour: Option<Colour>,
    /// Whether the words below the frame name it: then it is there in any case.
    named: bool,
    /// The block it stands for: in another it would seem to name that one.
    of: Option<BlockId>,
}

/// The class of a frame's labels; the description of their group counts those without room.
pub(crate) const CLASS: &str = "labels";

/// The labels of a frame, clear of all `ink`, which is asked for where there are any.
pub(crate) fn labels(pen: &Pen<'_>, view: Bounds, ink: impl FnOnce() -> Ink) -> Group {
    let mut group = Group::with_class(CLASS);
    let labels = wanted(pen, view);
    if labels.is_empty() {
        return group;
    }
    let mut ink = ink();
    let page = pen.camera.rect(view);
    let requests: Vec<LabelRequest> = labels.iter().map(|l| l.request.clone()).collect();
    let solids = Solids::new(pen);
    let abroad = |number: usize, rect: PageRect| {
        let own: Option<BlockId> = labels[number].of;
        own.is_some_and(|own| solids.other(pen, own, rect))
    };
    let places = place_where(&mut ink, page, &requests, &abroad);
    let mut missing: Vec<(&str, usize)> = Vec::new();
    for (label, placed) in labels.iter().zip(places) {
        if placed.is_none_or(|p| p.disliked) {
            pen.context.cramped.set(pen.context.cramped.get() + 1);
        }
        if let Some(mut placed) = placed {
            if placed.leader.is_none() && doubtful(pen, label, placed.rect) {
                placed.leader = Some([
                    nearest(placed.rect, label.request.anchor),
                    label.request.anchor,
                ]);
            }
            group.items.push(drawn(pen, label, placed).into());
            continue;
        }
        if label.named {
            group.items.push(over(pen, label).into());
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

/// Whether a name beside its block could be taken for another block's, whose middle is nearly as near.
fn doubtful(pen: &Pen<'_>, label: &Label, rect: PageRect) -> bool {
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
    others.any(|id| far(id) < DOUBT * far(own))
}

/// What a figure says of the labels that its frames are too full for; `None` where there are none.
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
    (most > MOST_BLOCKS).then(|| format!("{most} blocks: {what} left out{but}"))
}

fn wanted(pen: &Pen<'_>, view: Bounds) -> Vec<Label> {
    let options = pen.context.options;
    let frame = &pen.context.analysis.scene.frames[pen.number];
    let few = frame.placed.len() <= MOST_BLOCKS;
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
            // Leaders from everywhere to everywhere would hide the figure.
            let roam = pen.unit() >= ROOMY || frame.placed.len() <= FEW;
            let names = others.filter_map(|id| name(pen, *id, view));
            labels.extend(names.map(|label| {
                let mut request = label.request;
                if !roam {
                    request.roams = request.roams.map(|far| far.min(BESIDE));
                }
                Label { request, ..label }
            }));
        }
    }
    if few {
        labels.extend(amounts(pen));
    }
    labels.retain(|label| label.lines.iter().any(|line| !line.is_empty()));
    labels
}

/// The blocks that the words below a frame name, in placing order.
fn mentioned(context: &FigureContext<'_>, frame: usize) -> Vec<BlockId> {
    let scene = &context.analysis.scene;
    let stated = &context.statements[frame];
    let placed = scene.frames[frame].placed.iter().copied();
    placed
        .filter(|id| names(stated, &scene.blocks[id.0].id))
        .collect()
}

/// Edge of a block of which so much is the root of its area.
const EDGE: f64 = 0.6;
/// A block whose edge is so many unit edges long is a boulder.
const BOULDER: f64 = 3.0;

/// Size of the name of a block whose edge is so many pixels long, pixels.
fn name_size(pen: &Pen<'_>, edge: f64) -> f64 {
    (0.25 * edge)
        .max(SMALLEST)
        .min(pen.context.options.theme.sizes.name)
}

fn label(
    words: String,
    face: Face,
    size: f64,
    class: &'static str,
    request: LabelRequest,
) -> Label {
    let size_of = (text::width(&words, face, size), HIGH * size);
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

/// A name of several words in lines that fit across its block, where one line does not and few do. What is spelled out in
/// code points for want of a font may be broken between any two of them.
fn broken(label: Label, across: f64) -> Label {
    let name = label.lines.concat();
    if label.request.size.0 <= across {
        return label;
    }
    let (name, most) = match name.contains(SPELLED) {
        true => (name.replace(text::NO_BREAK, " "), 2 * MOST_LINES),
        false => (name, MOST_LINES),
    };
    let lines = text::balanced(&name, label.face, label.size, across, most + 1);
    // A word broken in two is no name any more.
    let whole = lines.join(" ").split(' ').eq(name.split_whitespace());
    if !whole || lines.len() > most {
        return label;
    }
    let widths = lines.iter().map(|l| text::width(l, label.face, label.size));
    let size = (
        widths.fold(0.0, f64::max),
        label.size * (HIGH + PITCH * (lines.len() - 1) as f64),
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

/// The name of a block; `None` where nothing of it is in view.
fn name(pen: &Pen<'_>, id: BlockId, view: Bounds) -> Option<Label> {
    let block = &pen.context.analysis.scene.blocks[id.0];
    let zoomed = pen.context.options.zoom.is_some();
    if zoomed && view::common(view, block.body.polygon.bounds()).is_none() {
        return None;
    }
    // A boulder among pebbles has a name that is read from as far off as the boulder is.
    let own = pen
        .camera
        .length(EDGE * libm::sqrt(block.body.polygon.area()));
    let size = if own > BOULDER * pen.unit() {
        name_size(pen, own)
    } else {
        name_size(pen, pen.unit())
    };
    // Beside a pebble its name stands as near as the pebble is small.
    let extent = block.body.polygon.bounds().diagonal();
    let request = LabelRequest {
        anchor: pen.camera.place(pen.moved(id, block.centroid)),
        from: (0.4 * pen.unit()).min(0.5 * pen.camera.length(extent) + 2.0),
        size: (0.0, 0.0),
        preferred: inside(&block.body.polygon, block.centroid, zoomed.then_some(view))
            .into_iter()
            .map(|p| pen.camera.place(pen.moved(id, p)))
            .collect(),
        ease: 0.5 * size,
        roams: (!zoomed || view::holds(view, block.centroid)).then_some(f64::INFINITY),
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
    // Above the smallest letters names of robots stand back a little.
    let size = (0.9 * size).max(size.min(SMALLEST));
    let named = |hold: &crate::scene::Hold| {
        let request = LabelRequest {
            anchor: pen.camera.place(pen.moved(hold.block, hold.at)),
            from: pen.disc() + 2.0,
            size: (0.0, 0.0),
            preferred: Vec::new(),
            ease: 0.0,
            roams: Some(f64::INFINITY),
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

fn amounts(pen: &Pen<'_>) -> Vec<Label> {
    let (marks, options) = (&pen.context.marks[pen.number], pen.context.options);
    // How large a load is belongs to the question, not to the answer: it is always told.
    let asked = |load: bool| options.amounts || (load && options.labels);
    let size = (0.2 * pen.unit())
        .max(SMALLEST)
        .min(pen.context.options.theme.sizes.amount);
    // Between two blocks the same amount acts both ways: it is said once, on the block of the lower number.
    let stated = |arrow: &&ForceArrow| match (arrow.kind.partner(), arrow.on) {
        (Some(BodyId::Block(partner)), BodyId::Block(on)) => on.0 < partner.0,
        _ => true,
    };
    let seen = |a: &&ForceArrow| pen.seen(a) || a.kind == ArrowKind::Load;
    let seen = marks.arrows.iter().filter(seen);
    let wanted = |arrow: &&ForceArrow| asked(arrow.kind == ArrowKind::Load) && stated(arrow);
    let straight = seen.filter(wanted).map(|arrow| {
        let words = quantity(arrow.force.norm(), "N");
        let (from, along) = (pen.camera.place(arrow.at), pen.camera.turn(arrow.reach()));
        let wide = text::width(&words, Face::Sans, size);
        let request = LabelRequest {
            anchor: from.moved(0.5 * along.0, 0.5 * along.1),
            from: (0.5 * pen.width(arrow)).max(DOT) + 3.0,
            size: (0.0, 0.0),
            preferred: beside(from, along, pen.width(arrow), (wide, HIGH * size)),
            ease: 0.0,
            roams: Some(f64::INFINITY),
        };
        Label {
            colour: Some(arrow.colour),
            ..label(words, Face::Sans, size, "amount", request)
        }
    });
    let turns = marks.turns.iter().filter(|t| pen.turn_seen(t));
    let turns = turns.filter(|t| asked(t.kind == TurnKind::Load));
    let turning = turns.map(|turn| {
        let request = LabelRequest {
            anchor: pen.camera.place(turn.at),
            from: pen.camera.length(0.7 * pen.context.unit),
            size: (0.0, 0.0),
            preferred: Vec::new(),
            ease: 0.0,
            roams: Some(f64::INFINITY),
        };
        let words = quantity(turn.torque.abs(), "N·m");
        Label {
            colour: Some(turn.colour),
            ..label(words, Face::Sans, size, "amount", request)
        }
    });
    straight.chain(turning).collect()
}

/// Middles of a label of this size beside an arrow's shaft, on either side, and beyond its tip.
fn beside(
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
    // How far a label's middle is from a line it touches from this direction.
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

/// Places inside a polygon, those nearest to its middle first; of a part of it where only that is in view.
fn inside(polygon: &Polygon, middle: Point, view: Option<Bounds>) -> Vec<Point> {
    let whole = polygon.bounds();
    let bounds = view.and_then(|v| view::common(v, whole)).unwrap_or(whole);
    let share = |i: usize| (i as f64 + 0.5) / TRIED as f64;
    let points: Vec<Point> = (0..TRIED * TRIED)
        .map(|i| {
            let x = bounds.min.x + bounds.width() * share(i % TRIED);
            let y = bounds.min.y + bounds.height() * share(i / TRIED);
            Point::new(x, y)
        })
        .filter(|p| polygon.contains(*p))
        .collect();
    // Distances that differ by rounding alone are equal: then the raster's own order decides, from lower left on, so that
    // noise in a centroid moves no name.
    let step = RANK * whole.diagonal();
    let rank = |p: &Point| ((p - middle).norm() / step).round();
    let mut ranked: Vec<(f64, Point)> = points.into_iter().map(|p| (rank(&p), p)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.into_iter().map(|(_, p)| p).collect()
}

fn drawn(pen: &Pen<'_>, label: &Label, placed: Placed) -> Group {
    let theme = &pen.context.options.theme;
    let mut group = Group::with_class(label.class);
    if let Some(leader) = placed.leader {
        // A thin grey line on a dark fill would be lost: a seam of the page's colour carries it.
        let seam = Path::stroked(Outline::line(leader), Stroke::new(theme.page, 2.0));
        let line = Path::stroked(Outline::line(leader), Stroke::new(theme.faint, 0.7));
        group = group.with(seam.with_opacity(0.7)).with(line);
    }
    // A label lies on no outline, so it lies on one fill or on the page.
    let below = pen.below(middle(placed.rect));
    let colour = theme.letters_on(below, label.colour);
    let halo = pen.context.lines_cross_names.then_some(below);
    lettered(group, label, middle(placed.rect), colour, halo)
}

/// A label for which nowhere is clear, over whatever lies at its anchor, with a seam around its letters.
fn over(pen: &Pen<'_>, label: &Label) -> Group {
    let below = pen.below(label.request.anchor);
    let colour = pen.context.options.theme.letters_on(below, label.colour);
    let group = Group::with_class(label.class);
    lettered(group, label, label.request.anchor, colour, Some(below))
}

/// The lines of a label about its middle, on request with a seam around their letters.
fn lettered(
    mut group: Group,
    label: &Label,
    middle: PagePoint,
    colour: Colour,
    halo: Option<Colour>,
) -> Group {
    let half = 0.5 * (label.lines.len() as f64 - 1.0);
    for (number, line) in label.lines.iter().enumerate() {
        let down = 0.36 + PITCH * (number as f64 - half);
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
