//! Draws arrows as filled outlines: straight arrows and arrows along a circle.
//!
//! The length of an arrow from tail to tip is exactly the length of the vector that it shows. For a shaft of width w
//! the head is 3·w wide and 4.5·w long and lies within that length. An arrow shorter than its head is only a head,
//! scaled down, so that all lengths can be compared.

use core::f64::consts::PI;

use super::{Outline, PagePoint, Segment};

/// Width of a head in shaft widths.
pub const HEAD_WIDTH: f64 = 3.0;
/// Length of a head in shaft widths.
pub const HEAD_LENGTH: f64 = 4.5;

/// Returns the length and the width of the head of an arrow. `length` is the length of the whole arrow, and `width` is
/// the width of its shaft. All four lengths have the same unit.
pub fn head_size(length: f64, width: f64) -> (f64, f64) {
    let full = HEAD_LENGTH * width;
    let long = length.min(full);
    (long, HEAD_WIDTH / HEAD_LENGTH * long)
}

/// Returns the outline of a straight arrow with its tail at `from` and its tip at `from` + `along`. The vector `along`
/// is in pixels, positive to the right and down. The shaft is `width` pixels wide. The outline is empty if `along` is
/// zero.
pub fn straight(from: PagePoint, along: (f64, f64), width: f64) -> Outline {
    let length = libm::hypot(along.0, along.1);
    if length.is_nan() || length <= 0.0 {
        return Outline::default();
    }
    let (ux, uy) = (along.0 / length, along.1 / length);
    let at = |forward: f64, aside: f64| from.moved(ux * forward - uy * aside, uy * forward + ux * aside);
    let (long, wide) = head_size(length, width);
    let (neck, head) = (length - long, wide / 2.0);
    let half = (width / 2.0).min(head / HEAD_WIDTH);
    Outline::ring([
        at(0.0, -half),
        at(neck, -half),
        at(neck, -head),
        at(length, 0.0),
        at(neck, head),
        at(neck, half),
        at(0.0, half),
    ])
}

/// Returns the outline of the head of the arrow that [`straight`] draws. The outline is open towards the shaft, so that
/// a stroke along it does not cross the arrow between head and shaft.
pub fn head(from: PagePoint, along: (f64, f64), width: f64) -> Outline {
    let arrow = straight(from, along, width);
    // Corners 1 to 5 of the arrow, counted from 0, go from one side of the shaft around the tip to the other side.
    let corners = arrow.points().skip(1).take(5);
    Outline::line(corners)
}

/// Returns the outline of an arrow along a circle around `centre`. The arrow begins at the angle `start` and turns
/// through the angle `sweep`. Angles are in radians. They are 0 to the right of the centre and increase anticlockwise
/// on the page; a negative `sweep` turns clockwise. The shaft is `width` pixels wide. The outline is empty if `sweep`
/// is zero or `radius` is not positive.
pub fn turning(centre: PagePoint, radius: f64, start: f64, sweep: f64, width: f64) -> Outline {
    if !(sweep.abs() > 0.0 && radius > 0.0) {
        return Outline::default();
    }
    let at = |angle: f64, r: f64| centre.moved(r * libm::cos(angle), -r * libm::sin(angle));
    let (long, wide) = head_size(sweep.abs() * radius, width);
    let head = wide / 2.0;
    let half = (width / 2.0).min(head / HEAD_WIDTH);
    let shaft = sweep - sweep.signum() * long / radius;
    let (neck, end) = (start + shaft, start + sweep);
    let mut outline = Outline { segments: vec![Segment::Move(at(start, radius + half))] };
    if shaft != 0.0 {
        arc(&mut outline, centre, radius + half, start, shaft);
    }
    outline.segments.push(Segment::Line(at(neck, radius + head)));
    // The tip lies slightly outside the circle. With its tip on the circle, the head would look bent inwards. With its
    // tip on the tangent, the head would look bent outwards.
    let tip = at(end, radius + 0.12 * long);
    outline.segments.push(Segment::Line(tip));
    outline.segments.push(Segment::Line(at(neck, radius - head)));
    outline.segments.push(Segment::Line(at(neck, radius - half)));
    if shaft != 0.0 {
        arc(&mut outline, centre, radius - half, neck, -shaft);
    }
    outline.segments.push(Segment::Close);
    outline
}

/// Appends a circular arc to the outline, as cubic curves of at most an eighth of a turn each. The outline must end at
/// the point where the arc begins.
fn arc(outline: &mut Outline, centre: PagePoint, radius: f64, start: f64, sweep: f64) {
    let parts = (sweep.abs() / (PI / 4.0)).ceil().clamp(1.0, 64.0);
    let step = sweep / parts;
    // With control points at this distance from the ends of a cubic curve, the curve approximates the arc.
    let handle = 4.0 / 3.0 * libm::tan(step / 4.0) * radius;
    let at = |angle: f64, along: f64| {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        centre.moved(radius * cos - along * sin, -radius * sin - along * cos)
    };
    for part in 0..parts as usize {
        let (from, to) = (start + step * part as f64, start + step * (part as f64 + 1.0));
        outline.segments.push(Segment::Curve(at(from, handle), at(to, -handle), at(to, 0.0)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the distance from the tail to the point that is farthest along the arrow.
    fn tip_distance(along: (f64, f64), width: f64) -> f64 {
        let outline = straight(PagePoint::new(1.0, 2.0), along, width);
        let length = libm::hypot(along.0, along.1);
        let far = |p: PagePoint| ((p.x - 1.0) * along.0 + (p.y - 2.0) * along.1) / length;
        outline.points().map(far).fold(0.0, f64::max)
    }

    #[test]
    fn an_arrow_has_the_requested_length_from_tail_to_tip() {
        for length in [0.01, 0.5, 3.0, 8.9, 9.0, 9.1, 40.0, 1e4] {
            assert!((tip_distance((0.0, -length), 2.0) - length).abs() < 1e-9 * length);
            assert!((tip_distance((0.6 * length, 0.8 * length), 2.0) - length).abs() < 1e-9 * length);
        }
        assert!(straight(PagePoint::new(1.0, 2.0), (0.0, 0.0), 2.0).segments.is_empty());
    }

    #[test]
    fn an_arrow_shorter_than_its_head_gets_a_smaller_head() {
        assert_eq!(head_size(100.0, 2.0), (9.0, 6.0));
        assert_eq!(head_size(4.5, 2.0), (4.5, 3.0));
        let wide = |length: f64| {
            let points = straight(PagePoint::new(0.0, 0.0), (length, 0.0), 2.0);
            points.points().map(|p| p.y).fold(0.0, f64::max)
        };
        assert!((wide(4.5) - 1.5).abs() < 1e-12 && (wide(0.9) - 0.3).abs() < 1e-12);
    }

    #[test]
    fn a_positive_sweep_turns_anticlockwise_on_the_page() {
        let centre = PagePoint::new(0.0, 0.0);
        let outline = turning(centre, 10.0, 0.0, PI / 2.0, 1.0);
        // A quarter turn from the right ends above the centre.
        let tip = outline.points().fold(centre, |t, p| if p.y < t.y { p } else { t });
        assert!(tip.x.abs() < 1.0 && tip.y < -9.0, "{tip:?}");
        let back = turning(centre, 10.0, 0.0, -PI / 2.0, 1.0);
        assert!(back.points().all(|p| p.y > -2.0) && back.points().any(|p| p.y > 9.0));
    }
}
