//! [`Text`]: a line of text, and the width of text in the built-in fonts.
//!
//! The width of a text is the sum of advances, without kerning. Kerning moves a pair by a few hundredths of the font
//! size, which does not matter for line breaks and positions. If a face lacks a character, another font has to draw it,
//! and its width is estimated.

use std::sync::OnceLock;

use skrifa::MetadataProvider;
use skrifa::raw::{FileRef, FontRef};

use super::advance::advance;
use super::{Colour, PagePoint};

/// A built-in font. All text of figures uses these fonts, except for characters that they lack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face {
    /// Libertinus Serif.
    Serif,
    /// Libertinus Serif Italic.
    SerifItalic,
    /// Libertinus Serif Bold.
    SerifBold,
    /// Inter.
    Sans,
    /// Inter SemiBold.
    SansBold,
}

impl Face {
    /// All faces.
    pub const ALL: [Face; 5] = [Face::Serif, Face::SerifItalic, Face::SerifBold, Face::Sans, Face::SansBold];

    /// Returns the bytes of the font file of this face.
    pub fn data(self) -> &'static [u8] {
        match self {
            Face::Serif => include_bytes!("../../../assets/fonts/LibertinusSerif-Regular.otf"),
            Face::SerifItalic => include_bytes!("../../../assets/fonts/LibertinusSerif-Italic.otf"),
            Face::SerifBold => include_bytes!("../../../assets/fonts/LibertinusSerif-Bold.otf"),
            Face::Sans => include_bytes!("../../../assets/fonts/Inter-Regular.ttf"),
            Face::SansBold => include_bytes!("../../../assets/fonts/Inter-SemiBold.ttf"),
        }
    }

    /// Returns the list of font families for CSS: first the built-in font, then similar fonts that a reader may have
    /// installed.
    pub fn families(self) -> &'static str {
        match self {
            Face::Serif | Face::SerifItalic | Face::SerifBold => {
                "'Libertinus Serif', 'Linux Libertine O', Palatino, Georgia, serif"
            }
            Face::Sans | Face::SansBold => "Inter, 'Helvetica Neue', Arial, sans-serif",
        }
    }

    /// Returns the font weight for CSS: 400 is regular, 600 is semi-bold and 700 is bold.
    pub fn weight(self) -> u16 {
        match self {
            Face::Serif | Face::SerifItalic | Face::Sans => 400,
            Face::SansBold => 600,
            Face::SerifBold => 700,
        }
    }

    /// True if the face is italic.
    pub fn italic(self) -> bool {
        self == Face::SerifItalic
    }

    /// True if the face has a glyph for a character.
    pub fn has(self, character: char) -> bool {
        advance(self as usize, character).is_some()
    }

    /// Returns the index of the glyph for a character in this face; `None` if the face has no such glyph.
    pub fn glyph(self, character: char) -> Option<u16> {
        let glyph = self.font().charmap().map(character)?;
        u16::try_from(glyph.to_u32()).ok()
    }

    fn font(self) -> FontRef<'static> {
        FontRef::new(self.data()).expect("the built-in font files are valid; a test opens each")
    }
}

/// Which point of a line of text lies at [`Text::at`], the position of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The position of the anchor, on the baseline.
    pub at: PagePoint,
    /// The point of the line that lies at `at`.
    pub anchor: Anchor,
    /// The text.
    pub words: String,
    /// The font.
    pub face: Face,
    /// Size of the font in pixels.
    pub size: f64,
    /// The colour of the letters.
    pub fill: Colour,
    /// Colour and width in pixels of a border around the letters, which separates them from their background.
    pub halo: Option<(Colour, f64)>,
}

impl Text {
    /// Creates a line of text. The left end of its baseline lies at `at`. `size` is the font size in pixels.
    pub fn new(at: PagePoint, words: impl Into<String>, face: Face, size: f64, fill: Colour) -> Text {
        Text { at, anchor: Anchor::Start, words: words.into(), face, size, fill, halo: None }
    }

    /// Returns the same text with another anchor: the start, the middle or the end of the line then lies at
    /// [`Text::at`].
    pub fn anchored(self, anchor: Anchor) -> Text {
        Text { anchor, ..self }
    }

    /// Returns the same text with a border (halo) around its letters; `width` is in pixels.
    pub fn with_halo(self, colour: Colour, width: f64) -> Text {
        Text { halo: Some((colour, width)), ..self }
    }
}

/// The no-break space. Lines are not broken at this space.
pub const NO_BREAK: char = '\u{a0}';

/// True if the bytes are a readable font file, or a font collection with at least one readable font.
pub fn opens(data: &[u8]) -> bool {
    FileRef::new(data).is_ok_and(|file| file.fonts().any(|font| font.is_ok()))
}

/// True if the font, or one font of the collection, has a glyph for the character.
pub fn covers(data: &[u8], character: char) -> bool {
    let Ok(file) = FileRef::new(data) else {
        return false;
    };
    let mut fonts = file.fonts().filter_map(Result::ok);
    fonts.any(|font| font.charmap().map(character).is_some())
}

/// Returns the width of a text in pixels. `size` is the font size in pixels.
pub fn width(words: &str, face: Face, size: f64) -> f64 {
    let common = common_advances(face);
    let advance = |c: char| match common.get(c as usize) {
        Some(advance) => *advance,
        None => advance(face as usize, c).unwrap_or_else(|| estimated_advance(c)),
    };
    words.chars().map(advance).sum::<f64>() * size
}

/// Estimates the width of a character that the built-in font does not have, as a fraction of the font size. Square
/// characters, such as Chinese characters, have the width 1.
fn estimated_advance(c: char) -> f64 {
    match u32::from(c) {
        0x1100..=0x115F
        | 0x2E80..=0xA4CF
        | 0xAC00..=0xD7A3
        | 0xF900..=0xFAFF
        | 0xFE30..=0xFE6F
        | 0xFF00..=0xFF60
        | 0x1F000..=0x3FFFF => 1.0,
        _ => 0.62,
    }
}

/// Returns the advance widths of the 128 ASCII characters as fractions of the font size. The widths are computed once,
/// because line breaking needs them often.
fn common_advances(face: Face) -> &'static [f64] {
    static KNOWN: [OnceLock<Vec<f64>>; Face::ALL.len()] = [const { OnceLock::new() }; Face::ALL.len()];
    KNOWN[face as usize].get_or_init(|| {
        let width = |c| advance(face as usize, c).unwrap_or_else(|| estimated_advance(c));
        (0..128_u8).map(|c| width(char::from(c))).collect()
    })
}

/// Breaks text into lines that are at most `room` pixels wide. A word that is wider than a line is split. A sequence of
/// white space counts as one space. Lines are not broken at [`NO_BREAK`]. Empty text gives no lines.
pub fn wrap(words: &str, face: Face, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    let breaks = |c: char| c.is_whitespace() && c != NO_BREAK;
    for word in words.split(breaks).filter(|word| !word.is_empty()) {
        let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if width(&longer, face, size) <= room {
            line = longer;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for character in word.chars() {
            line.push(character);
            if line.chars().count() > 1 && width(&line, face, size) > room {
                line.pop();
                lines.push(std::mem::take(&mut line));
                line.push(character);
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// Breaks text into as few lines as possible. A line is at most `room` pixels wide, and text after line `most` is cut
/// off. Text that is not cut off has lines of about the same length, so that the last line is rarely a single word.
pub fn balanced(words: &str, face: Face, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines = cut(wrap(words, face, size, room), most, face, size, room);
    let count = lines.len();
    if count < 2 || lines.last().is_some_and(|l| l.ends_with('…')) {
        return lines;
    }
    let mut narrower = room;
    while narrower > room / 3.0 {
        narrower -= 4.0;
        let next = wrap(words, face, size, narrower);
        if next.len() > count {
            break;
        }
        lines = next;
    }
    lines
}

/// Breaks a sentence into lines as [`balanced`] does, but keeps each number and the next word, such as its unit, on one
/// line. The lines contain no [`NO_BREAK`].
pub fn sentence_lines(words: &str, face: Face, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut unbroken = String::with_capacity(words.len());
    let mut after_digit = false;
    for character in words.chars() {
        let joins = after_digit && character == ' ';
        unbroken.push(if joins { NO_BREAK } else { character });
        after_digit = character.is_ascii_digit();
    }
    let lines = balanced(&unbroken, face, size, room, most).into_iter();
    lines.map(|line| line.replace(NO_BREAK, " ")).collect()
}

/// Returns the first `most` lines. If this leaves out lines, the last returned line ends in "…" and is shortened to at
/// most `room` pixels.
pub fn cut(mut lines: Vec<String>, most: usize, face: Face, size: f64, room: f64) -> Vec<String> {
    if lines.len() > most {
        lines.truncate(most);
        if let Some(last) = lines.last_mut() {
            while !last.is_empty() && width(&format!("{last} …"), face, size) > room {
                last.pop();
            }
            let kept = last.trim_end().len();
            last.truncate(kept);
            last.push_str(" …");
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use skrifa::instance::{LocationRef, Size};

    use super::*;
    use crate::pictures::drawing::advance;

    /// Returns the characters of a face with their widths in font units.
    fn characters(face: Face) -> Vec<(char, u16)> {
        let font = face.font();
        let metrics = font.glyph_metrics(Size::unscaled(), LocationRef::default());
        let width = |glyph| metrics.advance_width(glyph).unwrap_or(0.0) as u16;
        (char::MIN..=char::MAX).filter_map(|c| Some((c, width(font.charmap().map(c)?)))).collect()
    }

    #[test]
    fn the_table_of_widths_contains_the_widths_of_the_fonts() {
        let table = Face::ALL.map(|face| {
            let metrics = face.font().metrics(Size::unscaled(), LocationRef::default());
            advance::written(metrics.units_per_em, &characters(face))
        });
        let table = table.concat();
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
            let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
            std::fs::write(root.join("assets/fonts/advances.bin"), &table).expect("written");
        }
        assert!(advance::is(&table), "set UPDATE_SNAPSHOTS=1, and build again");
    }

    #[test]
    fn the_widths_of_the_table_equal_those_of_skrifa() {
        for face in Face::ALL {
            let font = face.font();
            let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
            for (c, _) in characters(face) {
                let glyph = font.charmap().map(c).expect("it has the character");
                let width = metrics.advance_width(glyph).map(f64::from);
                assert_eq!(advance(face as usize, c), width, "{face:?} {c:?}");
            }
        }
    }

    #[test]
    fn widths_depend_on_the_letters_and_are_proportional_to_the_size() {
        for face in Face::ALL {
            assert!(width("W", face, 20.0) > 2.0 * width("i", face, 20.0), "{face:?}");
            let (one, two) = (width("Robot 0", face, 10.0), width("Robot 0", face, 20.0));
            assert!((two - 2.0 * one).abs() < 1e-3 && one > 20.0, "{face:?} {one}");
        }
    }

    #[test]
    fn wrapping_keeps_every_word_and_no_line_is_too_wide() {
        let words = "The robot 0 wants to place anewblockwithanamethatisfartoolong here";
        let lines = wrap(words, Face::Serif, 15.0, 120.0);
        assert!(lines.len() > 3);
        assert!(lines.iter().all(|l| width(l, Face::Serif, 15.0) <= 120.0));
        assert_eq!(lines.concat().replace(' ', ""), words.replace(' ', ""));
        assert!(wrap(" \n\t", Face::Serif, 15.0, 120.0).is_empty());
        assert_eq!(
            wrap("a pull of 750\u{a0}mN", Face::Sans, 12.0, 80.0).last().map(String::as_str),
            Some("750\u{a0}mN")
        );
        let cut = cut(lines, 2, Face::Serif, 15.0, 120.0);
        assert_eq!(cut.len(), 2);
        assert!(cut[1].ends_with('…') && width(&cut[1], Face::Serif, 15.0) <= 120.0);
    }

    #[test]
    fn balancing_adds_no_line_and_leaves_no_line_with_a_single_word() {
        let words = "A flying buttress that takes a vault's thrust";
        let greedy = wrap(words, Face::SerifBold, 20.0, 380.0);
        let balanced = balanced(words, Face::SerifBold, 20.0, 380.0, 5);
        assert_eq!((greedy.len(), balanced.len()), (2, 2));
        assert_eq!(greedy[1], "thrust");
        assert!(balanced[1].split(' ').count() > 2, "{balanced:?}");
        assert_eq!(balanced.join(" "), words);
    }

    #[test]
    fn every_face_has_all_characters_of_the_texts_of_drystone() {
        let ours = "ABCXYZabcxyz0123456789 .,;:·–—…()[]|/+-−×=±°²³½≤≥→∑√μΣφθ∞“”‘’□";
        for face in Face::ALL {
            for c in ours.chars() {
                assert!(face.has(c), "{face:?} lacks {c:?}");
            }
        }
        assert!(!Face::Serif.has('石'));
    }
}
