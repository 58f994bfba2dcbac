//! [`Palette`]: chooses at most 256 colours for a picture, and records for each of them the largest rounding error of
//! the colours that it replaces.
//!
//! Figures are flat: a few colours cover nearly all of the page, and hundreds occur along antialiased edges. The
//! algorithm is a variant of median cut (Heckbert 1982) that minimises the largest error:
//!
//! 1. The most frequent colours stay exact, so that even a small change of such a colour is found.
//! 2. The other colours start in one box. The box with the widest range of a channel is cut in half, again and again,
//!    until the palette is full.
//! 3. In each box, the colour nearest to its centre replaces all colours of the box.
//!
//! The file stores the rounding error of each colour of the palette as two hexadecimal digits. Without these numbers,
//! the comparison would have to allow the largest rounding error for every pixel.

use std::collections::BTreeMap;

use super::{Picture, ROUNDING_KEYWORD, SUBJECT_KEYWORD, Subject};

/// The largest number of colours in a PNG palette.
const MAX_COLOURS: usize = 256;
/// Largest number of frequent colours that stay exact. The rest of the palette is for groups of similar colours.
const MAX_EXACT_COLOURS: usize = 128;
/// A colour is frequent if at least this many pixels have it. The fill of a small arrow head is frequent, the colours
/// of an antialiased edge are not.
const MIN_FREQUENT_PIXELS: usize = 24;

/// A palette.
pub(super) struct Palette {
    /// The colours, sorted.
    colours: Vec<[u8; 4]>,
    /// The largest rounding of a channel, for each colour of the palette.
    rounding: Vec<u8>,
    /// For each colour of the picture, the index of the palette colour that replaces it.
    index: BTreeMap<[u8; 4], u8>,
}

impl Palette {
    /// Makes the palette for these pixels. Returns `None` for a picture with transparent pixels and more than 256
    /// colours, which is stored without a palette.
    pub(super) fn new(pixels: &[[u8; 4]]) -> Option<Palette> {
        let mut counts: BTreeMap<[u8; 4], usize> = BTreeMap::new();
        for run in pixels.chunk_by(|a, b| a == b) {
            *counts.entry(run[0]).or_default() += run.len();
        }
        if counts.len() <= MAX_COLOURS {
            let exact = counts.into_keys().map(|c| (c, vec![c])).collect();
            return Some(Palette::with(exact));
        }
        if counts.keys().any(|c| c[3] < 255) {
            return None;
        }
        let mut common: Vec<([u8; 4], usize)> = counts.iter().map(|(c, n)| (*c, *n)).collect();
        common.retain(|(_, count)| *count >= MIN_FREQUENT_PIXELS);
        // Sort the colours by frequency, the most frequent first. Colours with equal counts keep the order of the
        // map, so that the result is reproducible.
        common.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        common.truncate(MAX_EXACT_COLOURS);
        let mut entries: Vec<([u8; 4], Vec<[u8; 4]>)> = Vec::with_capacity(MAX_COLOURS);
        for (colour, _) in common {
            counts.remove(&colour);
            entries.push((colour, vec![colour]));
        }
        let rest: Vec<[u8; 4]> = counts.into_keys().collect();
        for members in boxes(rest, MAX_COLOURS - entries.len()) {
            entries.push((middle(&members), members));
        }
        Some(Palette::with(entries))
    }

    /// Makes a palette from its colours. Each colour comes with the colours of the picture that it replaces.
    fn with(mut entries: Vec<([u8; 4], Vec<[u8; 4]>)>) -> Palette {
        entries.sort();
        let mut palette = Palette { colours: Vec::new(), rounding: Vec::new(), index: BTreeMap::new() };
        for (number, (colour, members)) in entries.into_iter().enumerate() {
            let far = members.iter().map(|m| max_channel_difference(*m, colour)).max();
            palette.colours.push(colour);
            palette.rounding.push(far.unwrap_or(0));
            let places = members.into_iter().map(|m| (m, number as u8));
            palette.index.extend(places);
        }
        palette
    }

    /// Returns the roundings of all colours as text to store in the file; `None` if no colour was rounded.
    fn note(&self) -> Option<String> {
        let any = self.rounding.iter().any(|r| *r > 0);
        any.then(|| self.rounding.iter().map(|r| format!("{r:02x}")).collect())
    }
}

/// Reads the rounding of each colour of the palette `table` from the stored text. A text that does not have one
/// number for each colour is ignored.
pub(super) fn rounding(note: &str, table: &[u8]) -> BTreeMap<[u8; 4], u8> {
    let digits: Vec<char> = note.chars().collect();
    let values = digits.chunks(2).map(|pair| {
        let pair: String = pair.iter().collect();
        u8::from_str_radix(&pair, 16).ok()
    });
    let values: Option<Vec<u8>> = values.collect();
    let colours = table.chunks_exact(3).map(|c| [c[0], c[1], c[2], 255]);
    match values {
        Some(values) if values.len() == table.len() / 3 => colours.zip(values).collect(),
        _ => BTreeMap::new(),
    }
}

/// Returns the largest difference of a channel between two colours.
pub(super) fn max_channel_difference(a: [u8; 4], b: [u8; 4]) -> u8 {
    let channels = a.iter().zip(b).map(|(a, b)| a.abs_diff(b));
    channels.max().unwrap_or(0)
}

/// Finds the colour channel with the widest range of values. Returns its lowest value, its highest value and its
/// index.
fn widest(members: &[[u8; 4]]) -> (u8, u8, usize) {
    let range = |channel: usize| {
        let values = members.iter().map(|m| m[channel]);
        let (low, high) = values.fold((255, 0), |(low, high), v| (v.min(low), v.max(high)));
        (low, high, channel)
    };
    let mut best = range(0);
    for channel in 1..4 {
        let next = range(channel);
        if next.1.saturating_sub(next.0) > best.1.saturating_sub(best.0) {
            best = next;
        }
    }
    best
}

/// Divides colours into at most `max` boxes of similar colours. The box with the widest range of values in one
/// channel is repeatedly cut at the middle of this range.
fn boxes(all: Vec<[u8; 4]>, max: usize) -> Vec<Vec<[u8; 4]>> {
    let mut boxes = vec![all];
    let mut widths = vec![widest(&boxes[0])];
    while boxes.len() < max {
        let wide = |w: &(u8, u8, usize)| w.1.saturating_sub(w.0);
        // Find the widest box. If several boxes are equally wide, take the first of them.
        let mut at = 0;
        for (place, width) in widths.iter().enumerate() {
            if wide(width) > wide(&widths[at]) {
                at = place;
            }
        }
        let (low, high, channel) = widths[at];
        if high <= low {
            break;
        }
        let cut = low + (high - low) / 2;
        let (below, above): (Vec<_>, Vec<_>) = boxes[at].iter().copied().partition(|m| m[channel] <= cut);
        widths[at] = widest(&below);
        boxes[at] = below;
        widths.push(widest(&above));
        boxes.push(above);
    }
    boxes
}

/// Returns the member of a box that is nearest to the centre of the box. No colour occurs twice in the
/// palette, because no other box contains this colour.
fn middle(members: &[[u8; 4]]) -> [u8; 4] {
    let mut centre = [0; 4];
    for (channel, value) in centre.iter_mut().enumerate() {
        let values = members.iter().map(|m| m[channel]);
        let (low, high) = values.fold((255, 0), |(low, high), v| (v.min(low), v.max(high)));
        *value = low + (high - low) / 2;
    }
    let nearest = members.iter().min_by_key(|m| max_channel_difference(**m, centre));
    nearest.copied().unwrap_or(centre)
}

/// Encodes a picture as PNG with a palette. If `palette` is `None`, the file stores red, green, blue and alpha of each
/// pixel.
pub(super) fn encode(
    picture: &Picture,
    palette: Option<&Palette>,
    subject: Option<Subject>,
) -> Result<Vec<u8>, String> {
    let failed = |error: png::EncodingError| error.to_string();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width, picture.height);
    encoder.set_compression(png::Compression::High);
    encoder.set_depth(png::BitDepth::Eight);
    if let Some(subject) = subject {
        let stated = encoder.add_text_chunk(SUBJECT_KEYWORD.into(), subject.name().into());
        stated.map_err(failed)?;
    }
    let mut data: Vec<u8>;
    match palette {
        None => {
            encoder.set_color(png::ColorType::Rgba);
            data = picture.rgba.as_flattened().to_vec();
        }
        Some(palette) => {
            encoder.set_color(png::ColorType::Indexed);
            // Do not use PNG filters, which store differences of neighbouring bytes. The bytes are palette indices,
            // whose differences do not compress better.
            encoder.set_filter(png::Filter::NoFilter);
            let opaque = palette.colours.iter().flat_map(|c| [c[0], c[1], c[2]]);
            encoder.set_palette(opaque.collect::<Vec<u8>>());
            if palette.colours.iter().any(|c| c[3] < 255) {
                encoder.set_trns(palette.colours.iter().map(|c| c[3]).collect::<Vec<u8>>());
            }
            if let Some(note) = palette.note() {
                let stated = encoder.add_text_chunk(ROUNDING_KEYWORD.into(), note);
                stated.map_err(failed)?;
            }
            data = Vec::with_capacity(picture.rgba.len());
            for run in picture.rgba.chunk_by(|a, b| a == b) {
                let place = palette.index.get(&run[0]).copied().unwrap_or_default();
                data.resize(data.len() + run.len(), place);
            }
        }
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&data).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A page with two large areas of one colour each, and a smooth gradient of many colours in a corner.
    fn page() -> Picture {
        let pixel = |i: u32| {
            let (x, y) = (i % 200, i / 200);
            match (x, y) {
                (0..64, 0..64) => [(x * 4) as u8, (y * 4) as u8, (x + y) as u8, 255],
                (100.., _) => [30, 60, 90, 255],
                _ => [255, 255, 255, 255],
            }
        };
        Picture::new(200, 100, (0..20_000).map(pixel).collect())
    }

    #[test]
    fn frequent_colours_are_exact_and_every_rounding_is_stored() {
        let page = page();
        let bytes = page.encode(Some(Subject::Scene)).expect("encoded");
        let read = Picture::decode(&bytes).expect("readable");
        assert_eq!(read.subject, Some(Subject::Scene));
        assert_eq!(read.rounding_of([255; 4]), 0);
        assert_eq!(read.rounding_of([30, 60, 90, 255]), 0);
        let mut worst = 0;
        for (before, after) in page.pixels().iter().zip(read.pixels()) {
            let far = max_channel_difference(*before, *after);
            assert!(far <= read.rounding_of(*after), "{before:?} {after:?}");
            worst = worst.max(far);
        }
        assert!((1..32).contains(&worst), "{worst}");
        assert_eq!(bytes, page.encode(Some(Subject::Scene)).expect("again"));
    }

    #[test]
    fn pictures_with_few_colours_or_transparent_pixels_are_stored_exactly() {
        let few = Picture::new(3, 1, vec![[1, 2, 3, 255], [9, 9, 9, 40], [7, 7, 7, 0]]);
        let read = Picture::decode(&few.encode(None).expect("encoded")).expect("readable");
        assert_eq!(read, few);
        let many = (0..1000u32).map(|i| [(i % 250) as u8, (i / 250) as u8, 5, 1 + (i % 200) as u8]);
        let many = Picture::new(1000, 1, many.collect());
        let read = Picture::decode(&many.encode(None).expect("encoded")).expect("readable");
        assert_eq!(read, many);
    }

    #[test]
    fn a_note_of_the_wrong_length_is_ignored() {
        assert!(rounding("0102", &[0; 9]).is_empty());
        assert!(rounding("zz01ff", &[0; 9]).is_empty());
        assert_eq!(rounding("03", &[1, 2, 4])[&[1, 2, 4, 255]], 3);
    }
}
