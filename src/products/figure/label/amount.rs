//! Creates the labels that show the magnitudes of loads, forces and torques.

use core::cmp::Ordering;

use super::super::arrow::{ArrowKind, ForceArrow, TurnArrow};
use super::super::pen::{DOT_RADIUS, Pen};
use super::super::words::quantity;
use super::lettering::{LINE_HEIGHT, Label, MIN_SIZE, label};
use super::row::RowPlaces;
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::placement::LabelRequest;
use crate::pictures::drawing::{Colour, Face, PagePoint, text};

/// Approximate largest number of magnitudes of loads and missing forces that are written in frames with many blocks.
pub(crate) const MAX_AMOUNTS: usize = 16;
/// If a frame would have more magnitudes, only the largest [`MAX_AMOUNTS`] are written. Nobody can read hundreds of
/// numbers in a picture, and the search for free positions takes milliseconds for each.
pub(crate) const CROWDED_AMOUNTS: usize = 200;
/// Forces whose relative difference is below this count as equal. The value is ten times the tolerance of a proof of
/// equilibrium.
pub(crate) const EQUAL_FORCE_TOL: f64 = 1e-6;

/// A text at a point of a picture.
pub(crate) struct Callout {
    /// The point that the text describes.
    pub at: PagePoint,
    /// Least distance of the text from the point, pixels.
    pub clear: f64,
    /// The text.
    pub words: String,
    /// The colour of the text.
    pub colour: Colour,
}

/// Returns the font size of labels with magnitudes, in pixels. It is smaller if the unit length is short on the page.
fn amount_size(pen: &Pen<'_>) -> f64 {
    (0.2 * pen.unit()).max(MIN_SIZE).min(pen.context.options.theme.sizes.amount)
}

/// Converts a callout to a label. If the picture has no space for the label, the label is left out and counted.
pub(super) fn called_out(pen: &Pen<'_>, callout: Callout) -> Label {
    let request = LabelRequest {
        anchor: callout.at,
        first_ring: callout.clear,
        size: (0.0, 0.0),
        preferred: Vec::new(),
        with_leader: Vec::new(),
        padding: 0.0,
        max_distance: Some(f64::INFINITY),
    };
    let size = pen.context.options.theme.sizes.amount;
    Label { colour: Some(callout.colour), ..label(callout.words, Face::SansBold, size, "amount", request) }
}

/// Returns the labels with the magnitudes of the largest contact force, the largest force of a robot, the loads and the
/// missing forces. If the options request magnitudes and the frame has few blocks (`few`), all other forces also have
/// labels. In a frame with many blocks, only the largest of the loads and missing forces have labels.
pub(super) fn amounts(pen: &Pen<'_>, few: bool) -> Vec<Label> {
    let marks = &pen.context.marks[pen.number];
    let options = pen.context.options;
    let least = least_written(pen, few);
    let first = principal(pen);
    let is_first = |arrow: &ForceArrow| first.iter().any(|f| core::ptr::eq(*f, arrow));
    let is_input = |kind: ArrowKind| kind == ArrowKind::Load || kind.is_failure();
    let has_amount = |arrow: &&ForceArrow| {
        let seen = pen.seen(arrow) || is_input(arrow.kind);
        let written = is_written(pen, arrow, few, least) && is_first_of_pair(arrow);
        seen && (is_first(arrow) || written)
    };
    let mut straight: Vec<&ForceArrow> = marks.arrows.iter().filter(has_amount).collect();
    if options.amounts {
        straight.sort_by(|a, b| by_importance(a, b));
    }
    let straight = largest(straight, |arrow| if is_first(arrow) { f64::INFINITY } else { arrow.force.norm() });
    let is_robot = |arrow: &&ForceArrow| matches!(arrow.kind, ArrowKind::Robot(_));
    let robots = marks.arrows.iter().filter(is_robot).count();
    let straight = straight.into_iter().map(|arrow| {
        let amount = quantity(arrow.force.norm(), pen.context.analysis.scene.units.force());
        let words = match arrow.kind {
            _ if options.amounts || !is_first(arrow) => amount,
            ArrowKind::Robot(_) if robots == 1 => format!("robot: {amount}"),
            ArrowKind::Robot(_) => format!("largest of a robot: {amount}"),
            _ => format!("largest: {amount}"),
        };
        Label { named: is_first(arrow), ..force_label(pen, arrow, words) }
    });
    // All arcs of torques are equally long, so each has its amount.
    let turns = marks.turns.iter().filter(|_| options.labels || (options.amounts && few));
    let turns = largest(turns.collect(), |turn| turn.torque.abs());
    let turns = turns.into_iter().map(|turn| torque_label(pen, turn));
    let mut labels: Vec<Label> = turns.chain(straight).collect();
    // The amounts of loads in a row come first, and keep their order. Those of torques come next, because they have the
    // fewest places.
    labels.sort_by_key(|label| label.request.with_leader.is_empty());
    labels
}

/// Returns the items whose magnitudes are written, in their order: all of them, or if there are more than
/// [`CROWDED_AMOUNTS`], the largest [`MAX_AMOUNTS`]. Of items of equal size, the first are selected.
fn largest<T>(items: Vec<&T>, size: impl Fn(&T) -> f64) -> Vec<&T> {
    if items.len() <= CROWDED_AMOUNTS {
        return items;
    }
    let mut order: Vec<usize> = (0..items.len()).collect();
    order.sort_by(|a, b| size(items[*b]).total_cmp(&size(items[*a])));
    order.truncate(MAX_AMOUNTS);
    order.sort_unstable();
    order.into_iter().map(|k| items[k]).collect()
}

/// Compares two arrows by the importance of their amounts: missing forces come first, then all other forces, each from
/// the largest to the smallest. If there is no space, the least important amounts are left out.
fn by_importance(a: &ForceArrow, b: &ForceArrow) -> Ordering {
    let missing = b.kind.is_failure().cmp(&a.kind.is_failure());
    missing.then(b.force.norm().total_cmp(&a.force.norm()))
}

/// True unless the magnitude of the force is written at the opposite arrow. The two opposite forces between two blocks
/// have the same magnitude, which is written only once.
fn is_first_of_pair(arrow: &ForceArrow) -> bool {
    match (arrow.kind.partner(), arrow.on) {
        (Some(BodyId::Block(partner)), BodyId::Block(on)) => on.0 < partner.0,
        _ => true,
    }
}

/// Creates the label of the arrow of a force, with the text `words`.
fn force_label(pen: &Pen<'_>, arrow: &ForceArrow, words: String) -> Label {
    let size = amount_size(pen);
    let (from, along) = (pen.camera.place(arrow.at), pen.camera.turn(arrow.reach()));
    let wide = text::width(&words, Face::Sans, size);
    let extent = (wide, LINE_HEIGHT * size);
    let request = LabelRequest {
        anchor: from.moved(0.5 * along.0, 0.5 * along.1),
        first_ring: (0.5 * pen.width(arrow)).max(DOT_RADIUS) + 3.0,
        size: (0.0, 0.0),
        preferred: centres_along(from, along, pen.width(arrow), extent),
        with_leader: Vec::new(),
        padding: 0.0,
        max_distance: Some(f64::INFINITY),
    };
    let request = match RowPlaces::new(pen, arrow, extent) {
        Some(row) => LabelRequest { anchor: row.tail, preferred: vec![row.first], with_leader: row.others, ..request },
        None => request,
    };
    Label { colour: Some(arrow.colour), ..label(words, Face::Sans, size, "amount", request) }
}

/// Creates the label with the magnitude of a torque next to its arrow.
fn torque_label(pen: &Pen<'_>, turn: &TurnArrow) -> Label {
    let words = quantity(turn.torque.abs(), pen.context.analysis.scene.units.torque());
    let size = amount_size(pen);
    let (wide, high) = (text::width(&words, Face::Sans, size), LINE_HEIGHT * size);
    let (centre, radius) = (pen.camera.place(turn.at), pen.camera.length(pen.turn_radius(turn)));
    let middle = pen.turn_middle(turn);
    let along = |angle: f64, far: f64| centre.moved(far * libm::cos(angle), -far * libm::sin(angle));
    // Prefer positions outside the circle of the arrow; the last position is inside it.
    let beside = |(off, side): (f64, f64)| {
        let angle = middle + off;
        let reach = 0.5 * (wide * libm::cos(angle).abs() + high * libm::sin(angle).abs());
        let gap = pen.camera.length(2.0 * turn.width) + 3.0 + reach;
        along(angle, radius + side * gap)
    };
    let offs = [0.0, 0.3, -0.3, 0.6, -0.6, 0.9, -0.9];
    let places = offs.map(|off| (off, 1.0)).into_iter().chain([(0.0, -1.0)]);
    let request = LabelRequest {
        anchor: along(middle, radius),
        first_ring: pen.camera.length(2.0 * turn.width) + 3.0,
        size: (0.0, 0.0),
        preferred: places.map(beside).collect(),
        with_leader: Vec::new(),
        padding: 0.0,
        max_distance: Some(f64::INFINITY),
    };
    Label { colour: Some(turn.colour), ..label(words, Face::Sans, size, "amount", request) }
}

/// True if the magnitude of a force is written next to its arrow. Loads and missing forces of at least `least` newtons
/// have labels even if the options do not request magnitudes.
fn is_written(pen: &Pen<'_>, arrow: &ForceArrow, few: bool, least: f64) -> bool {
    let options = pen.context.options;
    let missing = arrow.kind.is_failure() && !options.printed();
    let given = arrow.kind == ArrowKind::Load || missing;
    (options.amounts && few) || (options.labels && given && arrow.force.norm() >= least)
}

/// Returns the arrow of the largest force between two bodies and the arrow of the largest force of a robot. The list is
/// empty if arrows are too small to read, if the frame has very many blocks, if the options exclude labels, or in the
/// style of the thesis.
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
            // If several forces are equal except for rounding, take the first of them, so that rounding errors do not
            // move a label.
            if a.force.norm() > (1.0 + EQUAL_FORCE_TOL) * most.force.norm() { a } else { most }
        })
    };
    let contact = largest(|kind| matches!(kind, ArrowKind::Contact(_)));
    let robot = largest(|kind| matches!(kind, ArrowKind::Robot(_)));
    contact.into_iter().chain(robot).collect()
}

/// Returns the least magnitude, in newtons, of loads and missing forces that have labels. It is 0 if `few` is true
/// (the frame has few blocks). Otherwise it is chosen so that about `MAX_AMOUNTS` of them have labels.
fn least_written(pen: &Pen<'_>, few: bool) -> f64 {
    if few {
        return 0.0;
    }
    let arrows = pen.context.marks[pen.number].arrows.iter();
    let given = arrows.filter(|a| a.kind == ArrowKind::Load || a.kind.is_failure());
    let mut amounts: Vec<f64> = given.map(|a| a.force.norm()).collect();
    amounts.sort_by(|a, b| b.total_cmp(a));
    amounts.get(MAX_AMOUNTS).copied().unwrap_or(0.0)
}

/// Returns the preferred centres of a label on the page: on both sides of the arrow's shaft, and beyond its tip.
/// `width` is the width of the shaft, and `wide` and `high` are the width and height of the label, all in pixels.
fn centres_along(from: PagePoint, along: (f64, f64), width: f64, (wide, high): (f64, f64)) -> Vec<PagePoint> {
    let length = libm::hypot(along.0, along.1);
    if length.is_nan() || length <= 0.0 {
        return Vec::new();
    }
    let (ux, uy) = (along.0 / length, along.1 / length);
    // `reach` returns the distance from the centre of a label to a line that touches the label. (x, y) is the unit
    // normal of the line.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Vector};
    use crate::mechanics::scene::BlockId;
    use crate::products::figure::arrow::Head;

    #[test]
    fn if_there_are_too_many_amounts_only_the_largest_are_labelled() {
        let few: Vec<f64> = (0..CROWDED_AMOUNTS).map(|k| k as f64).collect();
        assert_eq!(largest(few.iter().collect(), |v| *v).len(), CROWDED_AMOUNTS);
        // 0, 1, 2, …, 499 repeated: the largest 16 of 15 000 are the first 16 with the value 499.
        let many: Vec<f64> = (0..15_000).map(|k| f64::from(k % 500)).collect();
        let written = largest(many.iter().collect(), |v| *v);
        assert_eq!(written, vec![&499.0; MAX_AMOUNTS]);
        assert!(core::ptr::eq(written[0], &raw const many[499]));
        assert!(core::ptr::eq(written[15], &raw const many[499 + 15 * 500]));
    }

    #[test]
    fn missing_forces_have_the_most_important_amounts_and_then_the_largest_forces() {
        let arrow = |newtons: f64, kind: ArrowKind| ForceArrow {
            on: BodyId::Block(BlockId(0)),
            at: Point::origin(),
            vector: Vector::new(newtons, 0.0),
            force: Vector::new(newtons, 0.0),
            colour: Colour::WHITE,
            width: 1.0,
            head: Head::Within,
            kind,
        };
        let partner = BodyId::Block(BlockId(1));
        let mut arrows = [
            arrow(1.0, ArrowKind::Weight),
            arrow(9.0, ArrowKind::Contact(partner)),
            arrow(0.5, ArrowKind::MissingPull(partner)),
            arrow(4.0, ArrowKind::Load),
            arrow(0.7, ArrowKind::MissingFriction(partner)),
        ];
        arrows.sort_by(by_importance);
        let order = arrows.map(|arrow| arrow.force.x);
        assert_eq!(order, [0.7, 0.5, 9.0, 4.0, 1.0]);
    }
}
