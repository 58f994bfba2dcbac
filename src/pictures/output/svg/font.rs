//! [`embedded`] embeds subsets of the built-in fonts in the SVG. A subset has only the characters of the drawing.
//!
//! The subsetter removes the table that maps characters to glyphs, and the tables for kerning, because PDF does not
//! need them. Browsers need this information, so it is computed again from the characters of the drawing and from the
//! positions of their glyphs.

use std::collections::{BTreeMap, BTreeSet};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use write_fonts::FontBuilder;
use write_fonts::read::{FontRef, TableProvider as _};
use write_fonts::tables::cmap::Cmap;
use write_fonts::types::{GlyphId, Tag};

use crate::pictures::drawing::Face;
use crate::pictures::output::tree::Run;

/// Returns a style sheet that embeds a subset of each built-in font of the text. The names of the font families begin
/// with `mark`.
///
/// # Errors
/// Returns a message with the face and the reason why its subset could not be made.
pub(super) fn embedded(runs: &[Run], mark: &str) -> Result<String, String> {
    let mut sheet = String::new();
    for face in Face::ALL {
        let of_face: Vec<&Run> = runs.iter().filter(|run| run.face == face).collect();
        if of_face.is_empty() {
            continue;
        }
        let font = cut(face, &of_face).map_err(|why| format!("{face:?}: {why}"))?;
        let kind = if font.starts_with(b"OTTO") { "otf" } else { "ttf" };
        sheet.push_str(&format!(
            "@font-face{{font-family:'{}';font-weight:{};font-style:{};src:url(data:font/{kind};base64,{})}}\n",
            family(face, mark),
            face.weight(),
            if face.italic() { "italic" } else { "normal" },
            STANDARD.encode(font)
        ));
    }
    Ok(sheet)
}

/// Returns the name of the embedded font family of a face. The name begins with `mark`, because other drawings on the
/// same page embed other subsets.
pub(super) fn family(face: Face, mark: &str) -> String {
    match face {
        Face::Serif | Face::SerifItalic | Face::SerifBold => format!("{mark}-serif"),
        Face::Sans | Face::SansBold => format!("{mark}-sans"),
    }
}

/// Returns a font file with only those glyphs of a face that the text uses.
fn cut(face: Face, runs: &[&Run]) -> Result<Vec<u8>, String> {
    let whole = FontRef::new(face.data()).map_err(|e| e.to_string())?;
    let mut characters = BTreeMap::new();
    for c in runs.iter().flat_map(|r| &r.glyphs).flat_map(|g| g.characters.chars()) {
        if let Some(glyph) = face.glyph(c) {
            characters.insert(c, glyph);
        }
    }
    let glyphs: BTreeSet<u16> = characters.values().copied().collect();
    let glyphs: Vec<u16> = glyphs.into_iter().collect();
    let numbers = subsetter::GlyphRemapper::new_from_glyphs_sorted(&glyphs);
    let new = |glyph: u16| numbers.get(glyph).unwrap_or_default();
    let small = subsetter::subset(face.data(), 0, &numbers).map_err(|e| e.to_string())?;
    let small = FontRef::new(&small).map_err(|e| e.to_string())?;
    let table = Cmap::from_mappings(characters.iter().map(|(c, g)| (*c, GlyphId::new(u32::from(new(*g))))))
        .map_err(|e| e.to_string())?;

    let mut font = FontBuilder::new();
    font.add_table(&table).map_err(|e| e.to_string())?;
    let tag = Tag::new(b"OS/2");
    if let Some(data) = whole.table_data(tag) {
        font.add_raw(tag, data.as_bytes().to_vec());
    }
    // A table `name` without names: a browser takes the name from the style sheet.
    font.add_raw(Tag::new(b"name"), vec![0, 0, 0, 0, 0, 6]);
    if let Some(post) = whole.table_data(Tag::new(b"post")) {
        // Write the table `post` in version 3, which has no glyph names. The old names do not fit the new glyph
        // indices.
        let mut head = post.as_bytes().get(..32).ok_or("the post table is truncated")?.to_vec();
        head[..4].copy_from_slice(&[0, 3, 0, 0]);
        font.add_raw(Tag::new(b"post"), head);
    }
    let pairs = kerning(&whole, face, runs)?;
    let pairs: BTreeMap<(u16, u16), i16> = pairs.into_iter().map(|((a, b), by)| ((new(a), new(b)), by)).collect();
    if let Some(table) = kern(&pairs) {
        font.add_raw(Tag::new(b"kern"), table);
    }
    font.copy_missing_tables(small);
    Ok(font.build())
}

/// Returns the kerning of each pair of neighbouring glyphs in the text, in font units. Negative kerning moves the
/// second glyph closer to the first.
fn kerning(font: &FontRef<'_>, face: Face, runs: &[&Run]) -> Result<BTreeMap<(u16, u16), i16>, String> {
    let units = f64::from(font.head().map_err(|e| e.to_string())?.units_per_em());
    let widths = font.hmtx().map_err(|e| e.to_string())?;
    let mut pairs = BTreeMap::new();
    for run in runs {
        for pair in run.glyphs.windows(2) {
            let [a, b] = pair else { continue };
            // True if the glyph stands for exactly one character. The glyph of a ligature is not in the subset.
            let own = |placed: &crate::pictures::output::tree::Placed| {
                let mut characters = placed.characters.chars();
                let only = characters.next().filter(|_| characters.next().is_none());
                only.and_then(|c| face.glyph(c)) == Some(placed.glyph)
            };
            let Some(alone) = widths.advance(GlyphId::new(u32::from(a.glyph))) else {
                continue;
            };
            let by = (b.at.0 - a.at.0) / run.size * units - f64::from(alone);
            // Kerning of at most half a font unit is a rounding error.
            if own(a) && own(b) && by.abs() > 0.5 {
                pairs.entry((a.glyph, b.glyph)).or_insert(by.round() as i16);
            }
        }
    }
    Ok(pairs)
}

/// Returns the bytes of a font's `kern` table: version 0, with one horizontal subtable of format 0. Returns `None` if
/// there are no pairs or more than 10 000 pairs.
fn kern(pairs: &BTreeMap<(u16, u16), i16>) -> Option<Vec<u8>> {
    let count = u16::try_from(pairs.len()).ok().filter(|n| (1..=10_000).contains(n))?;
    let log = count.ilog2() as u16;
    let range = 6 << log;
    let header = [0, 1, 0, 14 + 6 * count, 1, count, range, log, 6 * count - range];
    let mut table: Vec<u8> = header.iter().flat_map(|n: &u16| n.to_be_bytes()).collect();
    for ((left, right), by) in pairs {
        table.extend(left.to_be_bytes());
        table.extend(right.to_be_bytes());
        table.extend(by.to_be_bytes());
    }
    Some(table)
}
