//! [`labels`]: names of blocks and robots, and amounts on request, where they hide nothing.
//!
//! A name stands inside its block where there is room, beside it with a leader line where there is none. Labels lie on
//! no arrow, outline, disc or other label; one for which nowhere is clear is left out, and the figure counts those. What
//! the words below a frame name comes first, and bears its name in a frame of any number of blocks.

mod solid;
mod spoken;

use solid::Solids;
use spoken::names;

use super::arrow::{ArrowKind, ForceArrow, TurnArrow, TurnKind};
use super::pen::{CENTROID, DOT, Pen};
use super::stage::Stage;
use super::view;
use super::words::{counted, listed, quantity};
use crate::drawing::placement::{Ink, Placed, Wish, place_where};
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
/// Places tried along each axis of a block.
const TRIED: usize = 13;
/// Letters are no smaller than this, pixels.
const SMALLEST: f64 = 9.0;
/// Distances from a block's middle are ranked in steps of this share of the block's diagonal.
const RANK: f64 = 1e-3;
/// Height of a line of letters, in sizes.
const HIGH: f64 = 0.96;

/// A label before it has a place.
struct Label {
    words: String,
    face: Face,
    size: f64,
    class: &'static str,
    wish: Wish,
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
    let mut group = Group::of_class(CLASS);
    let labels = wanted(pen, view);
    if labels.is_empty() {
        return group;
    }
    let mut ink = ink();
    let page = pen.camera.rect(view);
    let wishes: Vec<Wish> = labels.iter().map(|l| l.wish.clone()).collect();
    let solids = Solids::of(pen);
    let abroad = |number: usize, rect: PageRect| {
        let own: Option<BlockId> = labels[number].of;
        own.is_some_and(|own| solids.other(pen, own, rect))
    };
    let places = place_where(&mut ink, page, &wishes, &abroad);
    let mut missing: Vec<(&str, usize)> = Vec::new();
    for (label, placed) in labels.iter().zip(places) {
        if placed.is_none_or(|p| p.disliked) {
            pen.stage.cramped.set(pen.stage.cramped.get() + 1);
        }
        if let Some(placed) = placed {
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

/// What a figure says of the labels that its frames are too full for; `None` where there are none.
pub(crate) fn left_out(stage: &Stage<'_>) -> Option<String> {
    let options = stage.options;
    let frames = &stage.analysis.scene.frames;
    let most = frames.iter().map(|f| f.placed.len()).max().unwrap_or(0);
    let what = match (options.labels, options.amounts) {
        (true, true) => "names and amounts",
        (true, false) => "names",
        (false, true) => "amounts",
        (false, false) => return None,
    };
    let named = (0..frames.len()).any(|frame| !mentioned(stage, frame).is_empty());
    let but = if named {
        " but those the text names"
    } else {
        ""
    };
    (most > MOST_BLOCKS).then(|| format!("{most} blocks: {what} left out{but}"))
}

fn wanted(pen: &Pen<'_>, view: Bounds) -> Vec<Label> {
    let options = pen.stage.options;
    let frame = &pen.stage.analysis.scene.frames[pen.number];
    let few = frame.placed.len() <= MOST_BLOCKS;
    let mut labels = Vec::new();
    if options.labels {
        let first = mentioned(pen.stage, pen.number);
        let names = first.iter().filter_map(|id| name(pen, *id, view));
        labels.extend(names.map(|label| Label {
            named: true,
            ..label
        }));
        labels.extend(robots(pen, view));
        if few {
            let others = frame.placed.iter().filter(|id| !first.contains(id));
            // Leaders from everywhere to everywhere would hide the figure: small blocks are named where they lie.
            let roam = pen.unit() >= ROOMY || frame.placed.len() <= FEW;
            let names = others.filter_map(|id| name(pen, *id, view));
            labels.extend(names.map(|label| Label {
                wish: Wish {
                    roams: label.wish.roams && roam,
                    ..label.wish
                },
                ..label
            }));
        }
    }
    if few {
        labels.extend(amounts(pen));
    }
    labels.retain(|label| !label.words.is_empty());
    labels
}

/// The blocks that the words below a frame name, in placing order.
fn mentioned(stage: &Stage<'_>, frame: usize) -> Vec<BlockId> {
    let scene = &stage.analysis.scene;
    let stated = &stage.statements[frame];
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
        .min(pen.stage.options.theme.sizes.name)
}

fn label(words: String, face: Face, size: f64, class: &'static str, wish: Wish) -> Label {
    let size_of = (text::width(&words, face, size), HIGH * size);
    Label {
        wish: Wish {
            size: size_of,
            ..wish
        },
        words,
        face,
        size,
        class,
        colour: None,
        named: false,
        of: None,
    }
}

/// The name of a block; `None` where nothing of it is in view.
fn name(pen: &Pen<'_>, id: BlockId, view: Bounds) -> Option<Label> {
    let block = &pen.stage.analysis.scene.blocks[id.0];
    let zoomed = pen.stage.options.zoom.is_some();
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
    let wish = Wish {
        anchor: pen.camera.place(pen.moved(id, block.centroid)),
        from: 0.4 * pen.unit(),
        size: (0.0, 0.0),
        preferred: inside(&block.body.polygon, block.centroid, zoomed.then_some(view))
            .into_iter()
            .map(|p| pen.camera.place(pen.moved(id, p)))
            .collect(),
        ease: 0.5 * size,
        roams: !zoomed || view::holds(view, block.centroid),
    };
    let label = label(block.id.clone(), Face::SansBold, size, "name", wish);
    Some(Label {
        of: Some(id),
        ..label
    })
}

fn robots(pen: &Pen<'_>, view: Bounds) -> Vec<Label> {
    let scene = &pen.stage.analysis.scene;
    let size = name_size(pen, pen.unit());
    // Above the smallest letters names of robots stand back a little.
    let size = (0.9 * size).max(size.min(SMALLEST));
    let named = |hold: &crate::scene::Hold| {
        let wish = Wish {
            anchor: pen.camera.place(pen.moved(hold.block, hold.at)),
            from: pen.disc() + 2.0,
            size: (0.0, 0.0),
            preferred: Vec::new(),
            ease: 0.0,
            roams: true,
        };
        let id = scene.robots[hold.robot.0].id.clone();
        Label {
            of: Some(hold.block),
            ..label(id, Face::Sans, size, "robot-name", wish)
        }
    };
    let zoomed = pen.stage.options.zoom.is_some();
    let holds = scene.frames[pen.number].holds.iter();
    let shown = holds.filter(|hold| !zoomed || view::holds(view, hold.at));
    shown.map(named).collect()
}

fn amounts(pen: &Pen<'_>) -> Vec<Label> {
    let (marks, options) = (&pen.stage.marks[pen.number], pen.stage.options);
    // How large a load is belongs to the question, not to the answer: it is always told.
    let asked = |load: bool| options.amounts || (load && options.labels);
    let size = (0.2 * pen.unit())
        .max(SMALLEST)
        .min(pen.stage.options.theme.sizes.amount);
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
        let wish = Wish {
            anchor: from.moved(0.5 * along.0, 0.5 * along.1),
            from: (0.5 * pen.width(arrow)).max(DOT) + 3.0,
            size: (0.0, 0.0),
            preferred: beside(from, along, pen.width(arrow), (wide, HIGH * size)),
            ease: 0.0,
            roams: true,
        };
        Label {
            colour: Some(arrow.colour),
            ..label(words, Face::Sans, size, "amount", wish)
        }
    });
    let turns = marks.turns.iter().filter(|t| pen.turn_seen(t));
    let turns = turns.filter(|t| asked(t.kind == TurnKind::Load));
    let turning = turns.map(|turn| {
        let wish = Wish {
            anchor: pen.camera.place(turn.at),
            from: pen.camera.length(0.7 * pen.stage.unit),
            size: (0.0, 0.0),
            preferred: Vec::new(),
            ease: 0.0,
            roams: true,
        };
        let words = quantity(turn.torque.abs(), "N·m");
        Label {
            colour: Some(turn.colour),
            ..label(words, Face::Sans, size, "amount", wish)
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

/// The ink of ground, blocks, plans, discs and arrows.
pub(crate) fn ink(pen: &Pen<'_>) -> Ink {
    let mut ink = Ink::default();
    let scene = &pen.stage.analysis.scene;
    let frame = &scene.frames[pen.number];
    let planned = frame.plans.iter().map(|p| p.block);
    let blocks = frame.placed.iter().copied().chain(planned);
    let polygons = blocks
        .map(|id| &scene.blocks[id.0].body.polygon)
        .chain(scene.ground.iter().map(|g| &g.body.polygon));
    for edge in polygons.flat_map(Polygon::edges) {
        let (from, to) = (pen.camera.place(edge.from), pen.camera.place(edge.to));
        ink.line(from, to, pen.line);
    }
    for hold in &frame.holds {
        ink.disc(pen.camera.place(pen.moved(hold.block, hold.at)), pen.disc());
    }
    let marks = &pen.stage.marks[pen.number];
    for arrow in marks.arrows.iter().filter(|a| pen.seen(a)) {
        let (from, along) = (pen.camera.place(arrow.at), pen.camera.turn(arrow.reach()));
        ink.arrow(from, along, pen.width(arrow));
        if arrow.kind == ArrowKind::Weight {
            ink.disc(from, CENTROID * pen.width(arrow) + 1.0);
        }
    }
    for arrow in pen.dots() {
        ink.disc(pen.camera.place(arrow.at), DOT + 0.5);
    }
    for turn in marks.turns.iter().filter(|t| pen.turn_seen(t)) {
        turning(&mut ink, pen, turn);
    }
    ink
}

/// A turning arrow's outline, cut across into pieces from its inner to its outer edge.
fn turning(ink: &mut Ink, pen: &Pen<'_>, turn: &TurnArrow) {
    let points: Vec<PagePoint> = pen.turn(turn).outline.points().collect();
    let centre = pen.camera.place(turn.at);
    for pair in points.windows(2) {
        let width = 3.0 * pen.camera.length(turn.width);
        // Points of the head and of both edges, each joined to the next, as wide as the head: no gap between them.
        if libm::hypot(pair[0].x - centre.x, pair[0].y - centre.y) > 0.0 {
            ink.line(pair[0], pair[1], width);
        }
    }
}

fn drawn(pen: &Pen<'_>, label: &Label, placed: Placed) -> Group {
    let theme = &pen.stage.options.theme;
    let at = middle(placed.rect).moved(0.0, 0.36 * label.size);
    let mut group = Group::of_class(label.class);
    if let Some(leader) = placed.leader {
        let line = Path::stroked(Outline::line(leader), Stroke::new(theme.faint, 0.6));
        group = group.with(line.with_opacity(0.8));
    }
    // A label lies on no outline, so it lies on one fill or on the page.
    let below = pen.below(middle(placed.rect));
    let colour = theme.letters_on(below, label.colour);
    let words = Text::new(at, label.words.as_str(), label.face, label.size, colour);
    group.with(words.anchored(Anchor::Middle))
}

/// A label for which nowhere is clear, over whatever lies at its anchor, with a seam around its letters.
fn over(pen: &Pen<'_>, label: &Label) -> Group {
    let below = pen.below(label.wish.anchor);
    let colour = pen.stage.options.theme.letters_on(below, label.colour);
    let at = label.wish.anchor.moved(0.0, 0.36 * label.size);
    let words = Text::new(at, label.words.as_str(), label.face, label.size, colour);
    let words = words.anchored(Anchor::Middle).with_halo(below, 1.5);
    Group::of_class(label.class).with(words)
}

fn middle(rect: PageRect) -> PagePoint {
    rect.at.moved(rect.width / 2.0, rect.height / 2.0)
}
