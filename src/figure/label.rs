//! [`labels`]: names of blocks and robots, and amounts on request, where they hide nothing.
//!
//! A name stands inside its block where there is room, beside it with a leader line where there is none. Labels lie on
//! no arrow, outline, disc or other label; one for which nowhere is clear is left out, and their description counts those.

use super::arrow::{ForceArrow, TurnArrow};
use super::panel::Pen;
use super::stage::Stage;
use super::words::quantity;
use crate::drawing::arrow::head_size;
use crate::drawing::placement::{Ink, Placed, Wish, place};
use crate::drawing::{
    Anchor, Colour, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, text,
};
use crate::geometry::{Bounds, Point, Polygon};
use crate::scene::{BlockId, BodyId};

/// Above so many blocks in a frame labels would be soup.
pub(crate) const MOST_BLOCKS: usize = 60;
/// Places tried along each axis of a block.
const TRIED: usize = 13;
/// Letters smaller than this are left out, pixels.
const SMALLEST: f64 = 9.0;
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
}

/// The labels of a frame, clear of all `ink`.
pub(crate) fn labels(pen: &Pen<'_>, view: Bounds, mut ink: Ink) -> Group {
    let mut group = Group::of_class("labels");
    let labels = wanted(pen);
    if labels.is_empty() {
        return group;
    }
    let page = pen.camera.rect(view);
    let wishes: Vec<Wish> = labels.iter().map(|l| l.wish.clone()).collect();
    let places = place(&mut ink, page, &wishes);
    let mut missing = 0;
    for (label, placed) in labels.iter().zip(places) {
        match placed {
            Some(placed) => group.items.push(drawn(pen, label, placed).into()),
            None => missing += 1,
        }
    }
    if missing > 0 {
        let labels = if missing == 1 {
            "label has"
        } else {
            "labels have"
        };
        group.description = format!("{missing} {labels} no room");
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
    (most > MOST_BLOCKS).then(|| format!("{most} blocks: {what} left out"))
}

fn wanted(pen: &Pen<'_>) -> Vec<Label> {
    let options = pen.stage.options;
    let frame = &pen.stage.analysis.scene.frames[pen.number];
    let mut labels = Vec::new();
    if frame.placed.len() > MOST_BLOCKS {
        return labels;
    }
    if options.labels {
        labels.extend(frame.placed.iter().map(|id| name(pen, *id)));
        labels.extend(robots(pen));
    }
    if options.amounts {
        labels.extend(amounts(pen));
    }
    labels.retain(|label| label.size >= SMALLEST && !label.words.is_empty());
    labels
}

/// Size of a block's name, pixels.
fn name_size(pen: &Pen<'_>) -> f64 {
    (0.25 * pen.unit()).min(pen.stage.options.theme.sizes.name)
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
    }
}

fn name(pen: &Pen<'_>, id: BlockId) -> Label {
    let block = &pen.stage.analysis.scene.blocks[id.0];
    let size = name_size(pen);
    let wish = Wish {
        anchor: pen.camera.place(pen.moved(id, block.centroid)),
        from: 0.4 * pen.unit(),
        size: (0.0, 0.0),
        preferred: inside(&block.body.polygon, block.centroid)
            .into_iter()
            .map(|p| pen.camera.place(pen.moved(id, p)))
            .collect(),
        ease: 0.5 * size,
        roams: true,
    };
    label(block.id.clone(), Face::SansBold, size, "name", wish)
}

fn robots(pen: &Pen<'_>) -> Vec<Label> {
    let scene = pen.stage.analysis.scene;
    let size = name_size(pen);
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
        label(id, Face::Sans, size, "robot-name", wish)
    };
    scene.frames[pen.number].holds.iter().map(named).collect()
}

fn amounts(pen: &Pen<'_>) -> Vec<Label> {
    let marks = &pen.stage.marks[pen.number];
    let size = (0.2 * pen.unit())
        .max(SMALLEST)
        .min(pen.stage.options.theme.sizes.amount);
    // Between two blocks the same amount acts both ways: it is said once, on the block of the lower number.
    let said = |arrow: &&ForceArrow| match (arrow.kind.partner(), arrow.on) {
        (Some(BodyId::Block(partner)), BodyId::Block(on)) => on.0 < partner.0,
        _ => true,
    };
    let seen = marks.arrows.iter().filter(|a| pen.seen(a));
    let straight = seen.filter(said).map(|arrow| {
        let words = quantity(arrow.force.norm(), "N");
        let (from, along) = (pen.camera.place(arrow.at), pen.camera.turn(arrow.reach()));
        let wide = text::width(&words, Face::Sans, size);
        let wish = Wish {
            anchor: from.moved(0.5 * along.0, 0.5 * along.1),
            from: 0.5 * pen.width(arrow) + 3.0,
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

/// Places inside a polygon, those nearest to its middle first.
fn inside(polygon: &Polygon, middle: Point) -> Vec<Point> {
    let bounds = polygon.bounds();
    let share = |i: usize| (i as f64 + 0.5) / TRIED as f64;
    let mut points: Vec<Point> = (0..TRIED * TRIED)
        .map(|i| {
            let x = bounds.min.x + bounds.width() * share(i % TRIED);
            let y = bounds.min.y + bounds.height() * share(i / TRIED);
            Point::new(x, y)
        })
        .filter(|p| polygon.contains(*p))
        .collect();
    points.sort_by(|a, b| (a - middle).norm().total_cmp(&(b - middle).norm()));
    points
}

/// The ink of ground, blocks, plans, discs and arrows.
pub(crate) fn ink(pen: &Pen<'_>) -> Ink {
    let mut ink = Ink::default();
    let scene = pen.stage.analysis.scene;
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

fn middle(rect: PageRect) -> PagePoint {
    rect.at.moved(rect.width / 2.0, rect.height / 2.0)
}

/// How far a point is from an arrow's ink, metres; below 0 inside it.
pub(crate) fn from_arrow(arrow: &ForceArrow, p: Point) -> f64 {
    let reach = arrow.reach();
    let length = reach.norm();
    if length <= 0.0 {
        return f64::INFINITY;
    }
    let (long, wide) = head_size(length, arrow.width);
    let tip = arrow.at + reach;
    let neck = tip - reach * (long / length);
    let shaft = from_segment(arrow.at, neck, p) - arrow.width / 2.0;
    // The head is a wedge; two thirds of half its width around its axis cover it.
    let head = from_segment(neck, tip, p) - wide / 3.0;
    shaft.min(head)
}

fn from_segment(a: Point, b: Point, p: Point) -> f64 {
    let along = b - a;
    let length = along.norm_squared();
    let share = if length > 0.0 {
        ((p - a).dot(&along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p - (a + along * share)).norm()
}
