//! [`Fonts`]: the built-in fonts, and fonts that a user adds for other scripts.
//!
//! Text that drystone itself lays out never uses fonts that are installed on the machine, so the same drawing and the
//! same font files give the same picture everywhere. [`Fonts::spelled`] replaces characters that no font has by their
//! code points.

use std::borrow::Cow;
use std::sync::Arc;

use crate::pictures::drawing::{Face, text};

/// The built-in fonts, and fonts that were added.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fonts {
    more: Vec<Arc<Vec<u8>>>,
}

impl Fonts {
    /// Adds font files or font collections (.ttf, .otf, .ttc) to the built-in fonts. A character that the built-in
    /// fonts do not have is drawn in the first added font that has it.
    ///
    /// # Errors
    /// Returns the index, from 0, of the first file that is not a readable font.
    ///
    /// # Example
    /// ```
    /// use drystone::output::fonts::Fonts;
    /// assert_eq!(Fonts::with(vec![b"no font".to_vec()]), Err(0));
    /// assert_eq!(Fonts::with(Vec::new()), Ok(Fonts::default()));
    /// ```
    pub fn with(files: Vec<Vec<u8>>) -> Result<Fonts, usize> {
        if let Some(wrong) = files.iter().position(|data| !text::opens(data)) {
            return Err(wrong);
        }
        Ok(Fonts { more: files.into_iter().map(Arc::new).collect() })
    }

    /// Returns the added font files.
    #[cfg(feature = "png")]
    pub(super) fn more(&self) -> &[Arc<Vec<u8>>] {
        &self.more
    }

    /// True if one of the fonts has the character. Always true for white space.
    pub fn has(&self, c: char) -> bool {
        (c.is_whitespace() && !c.is_control())
            || matches!(c, '\n' | '\t' | '\r')
            || Face::ALL.iter().any(|face| face.has(c))
            || self.more.iter().any(|data| text::covers(data, c))
    }

    /// Returns the characters of a text that none of the fonts has. Each character is listed once, in the order of
    /// first appearance.
    pub fn lacking(&self, text: &str) -> Vec<char> {
        let mut lacking = Vec::new();
        for c in text.chars().filter(|c| !c.is_ascii_graphic() && !self.has(*c)) {
            if !lacking.contains(&c) {
                lacking.push(c);
            }
        }
        lacking
    }

    /// Replaces each character that none of the fonts has by its code point. Names of blocks that differ in such a
    /// character therefore still look different.
    ///
    /// ```
    /// use drystone::output::fonts::Fonts;
    /// assert_eq!(Fonts::default().spelled("Камень 石頭"), "Камень U+77F3\u{a0}982D");
    /// ```
    pub fn spelled<'t>(&self, text: &'t str) -> Cow<'t, str> {
        if self.lacking(text).is_empty() {
            return Cow::Borrowed(text);
        }
        let mut out = String::new();
        let mut within = false;
        for c in text.chars() {
            let lacks = !c.is_ascii_graphic() && !self.has(c);
            if lacks {
                out.push_str(if within { "\u{a0}" } else { "U+" });
                out.push_str(&format!("{:04X}", u32::from(c)));
            } else {
                out.push(c);
            }
            within = lacks;
        }
        Cow::Owned(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_in_no_font_are_spelled_out_so_that_names_stay_different() {
        let fonts = Fonts::default();
        let names = ["石", "塔", "لوح", "पत्थर", "돌", "🪨", "a\u{202e}b", "\u{7}"];
        let mut spelled: Vec<String> = names.iter().map(|n| fonts.spelled(n).into_owned()).collect();
        for name in &spelled {
            assert!(fonts.lacking(name).is_empty(), "{name}");
        }
        spelled.sort();
        spelled.dedup();
        assert_eq!(spelled.len(), names.len());
        for plain in ["Keystone 3", "Größe · 4,5 m²", "Камень", "µ ≤ 0.7", "a\tb"] {
            assert_eq!(fonts.spelled(plain), plain);
        }
        assert_eq!(fonts.lacking("石頭石"), ['石', '頭']);
    }
}
