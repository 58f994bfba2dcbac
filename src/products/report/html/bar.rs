//! [`bar`]: draws a margin as a bar.

use maud::{Markup, html};

use crate::products::report::entry::{BarEnd, MarginBar};
use crate::products::wording::margin::Position;

/// Width and height of a bar, pixels.
const BAR_SIZE: (f64, f64) = (220.0, 20.0);
/// Distance between an end of the scale and the end of the picture, pixels. It is space for marks and arrows at the
/// ends of the scale.
const INSET: f64 = 7.0;

/// Draws a margin as a bar that covers the values at which the structure stands. An end is a stroke, which is dashed
/// if the end is not confirmed, or an arrow if the structure stands at all values beyond. An end at the limit of the
/// parameter's domain has no mark. The current value is a disc inside the bar, a cross outside it, or a ring if its
/// position is unknown. If there are several current values, the least and the largest are drawn. The shapes differ, so
/// that they are clear without colours.
pub(super) fn bar(bullet: &MarginBar) -> Markup {
    let (width, height) = BAR_SIZE;
    let at = |value: f64| {
        let room = width - 2.0 * INSET;
        let x = ((INSET + room * bullet.share(value)) * 10.0).round() / 10.0;
        if x.is_finite() { x } else { 0.0 }
    };
    let end = |end: BarEnd, at: f64, outward: f64| {
        html! {
            @match end {
                BarEnd::Domain => {}
                BarEnd::Edge => line.edge x1=(at) y1="2" x2=(at) y2="18" {},
                BarEnd::Unconfirmed => line.edge.unconfirmed x1=(at) y1="2" x2=(at) y2="18" {},
                BarEnd::Open => path.open d=(format!("M{at} 3l{} 7l{} 7z", outward * INSET, -outward * INSET)) {},
            }
        }
    };
    html! {
        svg.bar viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img"
            aria-label=(format!("{}: {}", bullet.name, bullet.words)) {
            rect.all x=(INSET) y="8.5" width=(width - 2.0 * INSET) height="3" {}
            @if let Some((from, to)) = bullet.safe {
                rect.safe x=(at(from)) y="6" width=(((at(to) - at(from)) * 10.0).round() / 10.0) height="8" {}
                (end(bullet.ends.0, at(from), -1.0))
                (end(bullet.ends.1, at(to), 1.0))
            }
            @if let Some((least, most)) = bullet.now {
                @if least < most { line.between x1=(at(least)) y1="10" x2=(at(most)) y2="10" {} }
                (now(bullet.position, at(least)))
                @if least < most { (now(bullet.position, at(most))) }
            }
        }
    }
}

/// Draws the mark of the current value. `at` is its x coordinate in pixels.
fn now(position: Position, at: f64) -> Markup {
    html! {
        @match position {
            Position::Inside => circle.now cx=(at) cy="10" r="4.5" {},
            Position::Outside => path.now.outside d=(format!("M{} 5l10 10m0 -10l-10 10", at - 5.0)) {},
            Position::Unknown => circle.now.unknown cx=(at) cy="10" r="4" {},
        }
    }
}
