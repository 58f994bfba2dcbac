//! Writes the lines of text of a drawing as SVG.

#[cfg(feature = "embed")]
use super::font;
use super::outline::number;
use super::{DEFAULT_FACE, Form, Writer};
use crate::pictures::drawing::{Anchor, Face, Stroke, Text};
use crate::text::xml;

impl Writer<'_> {
    /// Writes a line of text, either as SVG text or as the outlines of its letters.
    pub(super) fn words(&mut self, text: &Text) {
        self.texts += 1;
        if let Form::Outlines(outlines) = self.form {
            // Text without visible letters, such as spaces, has no outlines.
            if let Some(steps) = outlines.get(&self.texts).filter(|steps| !steps.is_empty()) {
                self.put("<path");
                self.attribute("role", "img");
                self.attribute("aria-label", &xml(&text.words));
                self.attribute("d", steps);
                self.ink(text);
                self.put("/>\n");
            }
            return;
        }
        self.put("<text");
        #[cfg(feature = "png")]
        if let Form::Numbered = self.form {
            self.attribute("id", &format!("t{}", self.texts));
        }
        self.attribute("x", &number(text.at.x));
        self.attribute("y", &number(text.at.y));
        match text.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.attribute("text-anchor", "middle"),
            Anchor::End => self.attribute("text-anchor", "end"),
        }
        if text.face.families() != DEFAULT_FACE.families() {
            let families = self.families(text.face);
            self.attribute("font-family", &families);
        }
        self.attribute("font-size", &number(text.size));
        if text.face.weight() != 400 {
            self.attribute("font-weight", &text.face.weight().to_string());
        }
        if text.face.italic() {
            self.attribute("font-style", "italic");
        }
        self.ink(text);
        self.put(">");
        let words = xml(&text.words);
        self.put(&words);
        self.put("</text>\n");
    }

    fn ink(&mut self, text: &Text) {
        self.attribute("fill", &text.fill.css());
        if let Some((colour, width)) = text.halo {
            self.stroke(&Stroke::new(colour, 2.0 * width));
        }
    }

    /// Returns the font families of a face, as a value for the attribute `font-family`.
    pub(super) fn families(&self, face: Face) -> String {
        match self.form {
            #[cfg(feature = "embed")]
            Form::Embedded(_) => {
                format!("'{}', {}", font::family(face, self.mark), face.families())
            }
            _ => face.families().to_owned(),
        }
    }
}
