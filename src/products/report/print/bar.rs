//! [`draw`]: draws a margin as a bar, with the same shapes as in HTML.

use super::flow::Flow;
use crate::drawing::{Colour, Outline, PagePoint, Path, Stroke};
use crate::output::pdf::Role;
use crate::report::entry::{BarEnd, MarginBar};
use crate::wording::margin::Position;

/// Height of a bar.
pub(super) const HEIGHT: f64 = 16.0;
/// The scale ends this far from the bar's ends.
const INSET: f64 = 6.0;
const SAFE: u32 = 0x002e_8b62;
const FALLS: u32 = 0x009c_1515;

/// Draws a bar of the width `wide`, with its upper left corner at a point, in pixels.
pub(super) fn draw(flow: &mut Flow, bar: &MarginBar, at: PagePoint, wide: f64) {
    let room = wide - 2.0 * INSET;
    let x = |value: f64| at.x + INSET + room * bar.share(value);
    let middle = at.y + 0.5 * HEIGHT;
    let ink = flow.theme.ink;
    let line = |from: (f64, f64), to: (f64, f64)| {
        Outline::line([PagePoint::new(from.0, from.1), PagePoint::new(to.0, to.1)])
    };
    let scale = line((at.x + INSET, middle), (at.x + wide - INSET, middle));
    flow.add(Path::stroked(scale, Stroke::new(flow.theme.rule, 2.5)));
    if let Some((from, to)) = bar.safe {
        let safe = line((x(from), middle), (x(to), middle));
        flow.add(Path::stroked(
            safe,
            Stroke::new(Colour::hex(SAFE), 6.0).mitred(),
        ));
        for (end, value, outward) in [(bar.ends.0, from, -1.0), (bar.ends.1, to, 1.0)] {
            let upright = line((x(value), at.y + 2.0), (x(value), at.y + HEIGHT - 2.0));
            match end {
                BarEnd::Domain => {}
                BarEnd::Edge => flow.add(Path::stroked(upright, Stroke::new(ink, 1.5))),
                BarEnd::Unconfirmed => {
                    flow.add(Path::stroked(
                        upright,
                        Stroke::new(ink, 1.5).dashed([2.0, 2.0]),
                    ));
                }
                BarEnd::Open => {
                    let tip = [(0.0, -6.0), (outward * INSET, 0.0), (0.0, 6.0)];
                    let tip = tip.map(|(dx, dy)| PagePoint::new(x(value) + dx, middle + dy));
                    flow.add(Path::filled(Outline::ring(tip), Colour::hex(SAFE)));
                }
            }
        }
    }
    if let Some((least, most)) = bar.now {
        for value in if least < most {
            vec![least, most]
        } else {
            vec![least]
        } {
            let here = PagePoint::new(x(value), middle);
            match bar.position {
                Position::Inside => flow.add(Path::filled(Outline::circle(here, 4.0), ink)),
                Position::Outside => {
                    for sign in [-1.0, 1.0] {
                        let cross = line(
                            (here.x - 4.0, middle - sign * 4.0),
                            (here.x + 4.0, middle + sign * 4.0),
                        );
                        flow.add(Path::stroked(cross, Stroke::new(Colour::hex(FALLS), 2.0)));
                    }
                }
                Position::Unknown => {
                    flow.add(Path::stroked(
                        Outline::circle(here, 3.5),
                        Stroke::new(ink, 1.5),
                    ));
                }
            }
        }
    }
    flow.close(Role::Artifact);
}
