//! [`draw`]: draws a margin as a bar, with the same shapes as in HTML.

use super::flow::{COLUMN_GAP, Flow, LINE_HEIGHT, SMALL_TEXT_SIZE};
use crate::mechanics::analysis::Verdict;
use crate::pictures::drawing::text::wrap;
use crate::pictures::drawing::{Anchor, Colour, Face, Outline, PagePoint, Path, Stroke};
use crate::pictures::output::pdf::Role;
use crate::products::report::entry::{Badge, BarEnd, MarginBar};
use crate::products::report::head::sign;
use crate::products::wording::margin::Position;

/// Height of a bar, pixels.
pub(super) const HEIGHT: f64 = 16.0;
/// Distance between an end of the scale and the end of the picture, pixels.
const INSET: f64 = 6.0;
const SAFE_COLOUR: u32 = 0x002e_8b62;
const FALLS_COLOUR: u32 = 0x009c_1515;

/// Draws a margin as a bar with the width `wide` and the upper left corner `at`, both in pixels.
pub(super) fn draw(flow: &mut Flow, bar: &MarginBar, at: PagePoint, wide: f64) {
    let place = BarPlace { bar, at, wide };
    let rule = Stroke::new(flow.theme.rule, 2.5);
    let (from, to) = (at.x + INSET, at.x + wide - INSET);
    flow.add(Path::stroked(place.along(from, to), rule));
    place.safe_part(flow);
    place.present_value(flow);
    flow.close(Role::Artifact);
}

/// A bar at its position on the page.
struct BarPlace<'b> {
    bar: &'b MarginBar,
    /// The upper left corner of the bar.
    at: PagePoint,
    /// The width of the bar, pixels.
    wide: f64,
}

impl BarPlace<'_> {
    /// Returns the x coordinate on the page, in pixels, of a value of the parameter.
    fn x(&self, value: f64) -> f64 {
        self.at.x + INSET + (self.wide - 2.0 * INSET) * self.bar.share(value)
    }

    /// Returns the y coordinate of the centre line of the bar, in pixels.
    fn middle(&self) -> f64 {
        self.at.y + 0.5 * HEIGHT
    }

    /// Returns the part of the bar's centre line between two x coordinates, in pixels.
    fn along(&self, from: f64, to: f64) -> Outline {
        let y = self.middle();
        Outline::line([PagePoint::new(from, y), PagePoint::new(to, y)])
    }

    /// Draws the part of the bar for the values at which the structure stands. An end is a stroke if it is confirmed,
    /// a dashed stroke if it is not confirmed, and an arrow if the structure stands at all values beyond. An end at the
    /// limit of the parameter's domain has no mark.
    fn safe_part(&self, flow: &mut Flow) {
        let Some((from, to)) = self.bar.safe else {
            return;
        };
        let ink = flow.theme.ink;
        let safe = Stroke::new(Colour::hex(SAFE_COLOUR), 6.0).mitred();
        flow.add(Path::stroked(self.along(self.x(from), self.x(to)), safe));
        for (end, value, outward) in [(self.bar.ends.0, from, -1.0), (self.bar.ends.1, to, 1.0)] {
            let x = self.x(value);
            let upright =
                Outline::line([PagePoint::new(x, self.at.y + 2.0), PagePoint::new(x, self.at.y + HEIGHT - 2.0)]);
            let stroke = Stroke::new(ink, 1.5);
            match end {
                BarEnd::Domain => {}
                BarEnd::Edge => flow.add(Path::stroked(upright, stroke)),
                BarEnd::Unconfirmed => {
                    flow.add(Path::stroked(upright, stroke.dashed([2.0, 2.0])));
                }
                BarEnd::Open => {
                    let tip = [(0.0, -6.0), (outward * INSET, 0.0), (0.0, 6.0)];
                    let tip = tip.map(|(dx, dy)| PagePoint::new(x + dx, self.middle() + dy));
                    flow.add(Path::filled(Outline::ring(tip), Colour::hex(SAFE_COLOUR)));
                }
            }
        }
    }

    /// Draws the current value: a disc in the safe part, a cross outside it, or a ring if its position is unknown. If
    /// there are several current values, such as the friction of different interfaces, the least and the largest value
    /// are drawn.
    fn present_value(&self, flow: &mut Flow) {
        let Some((least, most)) = self.bar.now else {
            return;
        };
        let values = if least < most { vec![least, most] } else { vec![least] };
        let ink = flow.theme.ink;
        for value in values {
            let here = PagePoint::new(self.x(value), self.middle());
            match self.bar.position {
                Position::Inside => flow.add(Path::filled(Outline::circle(here, 4.0), ink)),
                Position::Outside => {
                    for sign in [-1.0, 1.0] {
                        let arm = (4.0, sign * 4.0);
                        let cross = Outline::line([here.moved(-arm.0, -arm.1), here.moved(arm.0, arm.1)]);
                        flow.add(Path::stroked(cross, Stroke::new(Colour::hex(FALLS_COLOUR), 2.0)));
                    }
                }
                Position::Unknown => {
                    let circle = Outline::circle(here, 3.5);
                    flow.add(Path::stroked(circle, Stroke::new(ink, 1.5)));
                }
            }
        }
    }
}

/// Width of the space for the verdict at the left of the panel, pixels.
const WORD_WIDTH: f64 = 150.0;
/// Space above and below the content of the panel, pixels.
const PADDING: f64 = 10.0;
/// Font size of the headline, pixels.
const HEADLINE_SIZE: f64 = 14.0;

impl Flow {
    /// Adds a tinted panel with the verdict, the headline margin and the reasons.
    pub fn badge(&mut self, badge: &Badge) {
        let (left, room) = (self.left, self.room);
        let inner = room - WORD_WIDTH - COLUMN_GAP;
        let lines = |words: &str, face: Face, size: f64| {
            let count = if words.is_empty() { 0 } else { wrap(words, face, size, inner).len() };
            LINE_HEIGHT * size * count as f64
        };
        let [headline, sentence] = [&badge.headline, &badge.sentence].map(|words| self.legible(words));
        let text = lines(&headline, Face::SansBold, HEADLINE_SIZE) + lines(&sentence, Face::Sans, SMALL_TEXT_SIZE);
        let high = 2.0 * PADDING + text.max(LINE_HEIGHT * HEADLINE_SIZE);
        self.reserve(high + 8.0);
        let top = self.y;
        self.verdict_panel(badge.verdict, high);
        (self.left, self.room) = (left + WORD_WIDTH, inner);
        let ink = self.theme.ink;
        for (words, face, size) in [(headline, Face::SansBold, HEADLINE_SIZE), (sentence, Face::Sans, SMALL_TEXT_SIZE)]
        {
            if !words.is_empty() {
                self.words(&words, face, size, ink, &Role::Paragraph);
            }
        }
        (self.left, self.room) = (left, room);
        self.y = top + high + 8.0;
    }

    /// Draws the tinted panel, `high` pixels high, with the verdict at its left edge.
    fn verdict_panel(&mut self, verdict: Verdict, high: f64) {
        let (ink, tint) = match verdict {
            Verdict::Stable => (Colour::hex(0x17743f), Colour::hex(0xe8f3ec)),
            Verdict::Unstable => (Colour::hex(0x9c1515), Colour::hex(0xf9eaea)),
            Verdict::Undecided => (Colour::hex(0x5d646e), Colour::hex(0xeeeff1)),
        };
        let (left, top) = (self.left, self.y);
        let panel = |to: f64| {
            Outline::ring(
                [(left, top), (to, top), (to, top + high), (left, top + high)].map(|(x, y)| PagePoint::new(x, y)),
            )
        };
        self.add(Path::filled(panel(left + self.room), tint));
        self.add(Path::filled(panel(left + 5.0), ink));
        self.close(Role::Artifact);
        self.y = top + PADDING;
        let word = format!("{} {}", sign(verdict), verdict.plain());
        let x = left + 18.0;
        self.put(&word, x, Face::SerifBold, 18.0, ink, Anchor::Start);
        self.close(Role::Paragraph);
    }
}
