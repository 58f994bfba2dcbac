//! Draws the verdict of a frame, with its reasons and the headline margin, on a page of a PDF.

use super::bar;
use super::flow::{COLUMN_GAP, Flow, LINE_HEIGHT, SMALL_TEXT_SIZE};
use crate::mechanics::analysis::Verdict;
use crate::pictures::drawing::text::wrap;
use crate::pictures::drawing::{Anchor, Colour, Face, Outline, PagePoint, Path};
use crate::pictures::output::pdf::Role;
use crate::products::report::entry::Badge;
use crate::products::report::head::sign;
use crate::products::wording::verdict::plain;

/// Width of the space for the verdict at the left of the panel, pixels.
const WORD_WIDTH: f64 = 150.0;
/// Space above and below the content of the panel, pixels.
const PADDING: f64 = 10.0;
/// Height of the bar of the headline margin, with the space below it, pixels.
const BAR_HEIGHT: f64 = 22.0;
/// Font size of the headline, pixels.
const HEADLINE_SIZE: f64 = 14.0;

/// The texts of a badge. Code points replace characters that the fonts do not have.
struct BadgeTexts {
    headline: Option<String>,
    /// The headline margin in words.
    margin: Option<String>,
    sentence: String,
}

impl BadgeTexts {
    /// Returns the height, in pixels, of the panel for these texts. A line of text is at most `room` pixels wide.
    fn height(&self, room: f64) -> f64 {
        let lines =
            |words: &str, face: Face, size: f64| LINE_HEIGHT * size * wrap(words, face, size, room).len() as f64;
        let headline = self.headline.as_ref();
        let headline = headline.map_or(0.0, |words| lines(words, Face::SansBold, HEADLINE_SIZE));
        let margin = self.margin.as_ref();
        let margin = margin.map_or(0.0, |words| BAR_HEIGHT + lines(words, Face::Sans, SMALL_TEXT_SIZE));
        2.0 * PADDING + headline + margin + lines(&self.sentence, Face::Sans, SMALL_TEXT_SIZE)
    }
}

impl Flow {
    /// Adds a tinted panel with the verdict, its reasons and the headline margin.
    pub fn badge(&mut self, badge: &Badge) {
        let (left, room) = (self.left, self.room);
        let inner = room - WORD_WIDTH - COLUMN_GAP;
        let headline = (!badge.headline.is_empty()).then(|| format!("{}.", badge.headline));
        let words = BadgeTexts {
            headline: headline.map(|words| self.legible(&words)),
            margin: badge.bar.as_ref().map(|bar| self.legible(&bar.short())),
            sentence: self.legible(&badge.sentence),
        };
        let high = words.height(inner);
        self.reserve(high + 8.0);
        let top = self.y;
        self.verdict_panel(badge.verdict, high);
        (self.left, self.room) = (left + WORD_WIDTH, inner);
        let (ink, faint) = (self.theme.ink, self.theme.faint);
        if let Some(headline) = &words.headline {
            self.words(headline, Face::SansBold, HEADLINE_SIZE, ink, &Role::Paragraph);
        }
        if let (Some(of), Some(margin)) = (&badge.bar, &words.margin) {
            let at = PagePoint::new(self.left, self.y + 2.0);
            bar::draw(self, of, at, 240.0);
            self.y += BAR_HEIGHT;
            self.words(margin, Face::Sans, SMALL_TEXT_SIZE, faint, &Role::Paragraph);
        }
        self.words(&words.sentence, Face::Sans, SMALL_TEXT_SIZE, ink, &Role::Paragraph);
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
        let word = format!("{} {}", sign(verdict), plain(verdict));
        let x = left + 18.0;
        self.put(&word, x, Face::SerifBold, 18.0, ink, Anchor::Start);
        self.close(Role::Paragraph);
    }
}
