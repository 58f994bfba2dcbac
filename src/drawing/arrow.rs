//! Arrows as filled outlines: a straight one whose shaft is the vector, and one that turns about a point.
//!
//! The head lies beyond the shaft, as in the source's figures: of width 3·w and length 4.5·w for a shaft of width w, so
//! that a short arrow still tells its direction and the shaft alone tells its amount.

use core::f64::consts::PI;

use super::{Outline, PagePoint, Segment};

/// Width of a head in shaft widths.
pub const HEAD_WIDTH: f64 = 3.0;
/// Length of a head in shaft widths.
pub const HEAD_LENGTH: f64 = 4.5;

/// An arrow whose shaft runs from `from` by `along` (right and down), `width` pixels wide. Empty for a zero vector.
pub fn straight(from: PagePoint, along: (f64, f64), width: f64) -> Outline {
    let length = libm::hypot(along.0, along.1);
    if length.is_nan() || length <= 0.0 {
        return Outline::default();
    }
    let (ux, uy) = (along.0 / length, along.1 / length);
    let at =
        |forward: f64, aside: f64| from.moved(ux * forward - uy * aside, uy * forward + ux * aside);
    let (half, head) = (width / 2.0, HEAD_WIDTH * width / 2.0);
    Outline::ring([
        at(0.0, -half),
        at(length, -half),
        at(length, -head),
        at(length + HEAD_LENGTH * width, 0.0),
        at(length, head),
        at(length, half),
        at(0.0, half),
    ])
}

/// The head alone of the arrow that [`straight`] draws, open where the shaft meets it, so that a line along its edge
/// leaves no seam between the two.
pub fn head(from: PagePoint, along: (f64, f64), width: f64) -> Outline {
    let arrow = straight(from, along, width);
    // Corners 1 to 5 of the arrow: from one edge of the shaft around the tip to the other.
    let corners = arrow.points().skip(1).take(5);
    Outline::line(corners)
}

/// An arrow along a circle about `centre`, from the angle `start` through `sweep` radians, both anticlockwise as seen on
/// the page (from the x axis to the right), `width` pixels wide. The head lies beyond the sweep. Empty for a zero sweep.
pub fn turning(centre: PagePoint, radius: f64, start: f64, sweep: f64, width: f64) -> Outline {
    if !(sweep.abs() > 0.0 && radius > 0.0) {
        return Outline::default();
    }
    let at = |angle: f64, r: f64| centre.moved(r * libm::cos(angle), -r * libm::sin(angle));
    let (half, head) = (width / 2.0, HEAD_WIDTH * width / 2.0);
    let end = start + sweep;
    let mut outline = Outline {
        segments: vec![Segment::Move(at(start, radius + half))],
    };
    arc(&mut outline, centre, radius + half, start, sweep);
    outline.segments.push(Segment::Line(at(end, radius + head)));
    // The tip lies as far along the circle as a straight head is long, and a little outside it: a head that follows the
    // circle looks bent, one along the tangent looks as if it flew off.
    let beyond = sweep.signum() * HEAD_LENGTH * width / radius;
    let tip = at(end + 0.8 * beyond, radius + 0.12 * HEAD_LENGTH * width);
    outline.segments.push(Segment::Line(tip));
    outline.segments.push(Segment::Line(at(end, radius - head)));
    outline.segments.push(Segment::Line(at(end, radius - half)));
    arc(&mut outline, centre, radius - half, end, -sweep);
    outline.segments.push(Segment::Close);
    outline
}

/// Appends a circular arc as cubics of at most an eighth of a turn each; the outline already stands at its beginning.
fn arc(outline: &mut Outline, centre: PagePoint, radius: f64, start: f64, sweep: f64) {
    let parts = (sweep.abs() / (PI / 4.0)).ceil().clamp(1.0, 64.0);
    let step = sweep / parts;
    let reach = 4.0 / 3.0 * libm::tan(step / 4.0) * radius;
    let at = |angle: f64, along: f64| {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        centre.moved(radius * cos - along * sin, -radius * sin - along * cos)
    };
    for part in 0..parts as usize {
        let (from, to) = (
            start + step * part as f64,
            start + step * (part as f64 + 1.0),
        );
        outline
            .segments
            .push(Segment::Curve(at(from, reach), at(to, -reach), at(to, 0.0)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shaft_is_the_vector_and_the_head_lies_beyond_it() {
        let outline = straight(PagePoint::new(1.0, 2.0), (0.0, -10.0), 2.0);
        let points: Vec<PagePoint> = outline.points().collect();
        assert_eq!(points[3], PagePoint::new(1.0, 2.0 - 10.0 - 9.0));
        assert_eq!((points[2].x - points[4].x).abs(), 6.0);
        assert_eq!(points[1].y, -8.0);
        assert!(
            straight(PagePoint::new(1.0, 2.0), (0.0, 0.0), 2.0)
                .segments
                .is_empty()
        );
    }

    #[test]
    fn a_positive_sweep_turns_anticlockwise_on_the_page() {
        let centre = PagePoint::new(0.0, 0.0);
        let outline = turning(centre, 10.0, 0.0, PI / 2.0, 1.0);
        // A quarter turn from the right ends above the centre, its tip further to the left.
        let tip = outline
            .points()
            .fold(centre, |t, p| if p.x < t.x { p } else { t });
        assert!(tip.x < -3.0 && tip.y < -8.0, "{tip:?}");
        let back = turning(centre, 10.0, 0.0, -PI / 2.0, 1.0);
        assert!(back.points().all(|p| p.y > -2.0));
    }
}
