//! Draws the verdict of a sheet with its headline margin.

use super::bar;
use super::flow::{Flow, GAP, LINE, SMALL};
use crate::analysis::Verdict;
use crate::drawing::text::wrap;
use crate::drawing::{Anchor, Colour, Face, Outline, PagePoint, Path};
use crate::output::pdf::Role;
use crate::report::entry::Badge;
use crate::report::head::sign;
use crate::wording::verdict::plain;

impl Flow {
    /// Draws the verdict with the headline margin, on a tinted panel.
    pub fn badge(&mut self, badge: &Badge) {
        let (ink, tint) = match badge.verdict {
            Verdict::Stable => (Colour::hex(0x17743f), Colour::hex(0xe8f3ec)),
            Verdict::Unstable => (Colour::hex(0x9c1515), Colour::hex(0xf9eaea)),
            Verdict::Undecided => (Colour::hex(0x5d646e), Colour::hex(0xeeeff1)),
        };
        let (left, room) = (self.left, self.room);
        let beside = 150.0;
        let sentence = self.legible(&badge.sentence);
        let short = badge.bar.as_ref().map(|bar| self.legible(&bar.short()));
        let inner = room - beside - GAP;
        let lines = |words: &str, face: Face, size: f64| {
            LINE * size * wrap(words, face, size, inner).len() as f64
        };
        let headline = self.legible(&format!("{}.", badge.headline));
        let high =
            20.0 + if badge.headline.is_empty() {
                0.0
            } else {
                lines(&headline, Face::SansBold, 14.0)
            } + short
                .as_ref()
                .map_or(0.0, |words| 22.0 + lines(words, Face::Sans, SMALL))
                + lines(&sentence, Face::Sans, SMALL);
        self.reserve(high + 8.0);
        let top = self.y;
        let panel = |from: f64, to: f64| {
            Outline::ring(
                [(from, top), (to, top), (to, top + high), (from, top + high)]
                    .map(|(x, y)| PagePoint::new(x, y)),
            )
        };
        self.add(Path::filled(panel(left, left + room), tint));
        self.add(Path::filled(panel(left, left + 5.0), ink));
        self.close(Role::Artifact);
        self.y = top + 10.0;
        let word = format!("{} {}", sign(badge.verdict), plain(badge.verdict));
        self.put(
            &word,
            left + 18.0,
            Face::SerifBold,
            18.0,
            ink,
            Anchor::Start,
        );
        self.close(Role::Paragraph);
        (self.left, self.room) = (left + beside, inner);
        if !badge.headline.is_empty() {
            self.words(
                &headline,
                Face::SansBold,
                14.0,
                self.theme.ink,
                &Role::Paragraph,
            );
        }
        if let (Some(of), Some(short)) = (&badge.bar, short) {
            let at = PagePoint::new(self.left, self.y + 2.0);
            bar::draw(self, of, at, 240.0);
            self.y += 22.0;
            self.words(
                &short,
                Face::Sans,
                SMALL,
                self.theme.faint,
                &Role::Paragraph,
            );
        }
        self.words(
            &sentence,
            Face::Sans,
            SMALL,
            self.theme.ink,
            &Role::Paragraph,
        );
        (self.left, self.room) = (left, room);
        self.y = top + high + 8.0;
    }
}
