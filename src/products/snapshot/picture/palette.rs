//! [`Palette`]: at most 256 colours for a picture, and by how much that rounds each.
//!
//! Our pictures are flat: a few colours cover nearly all of a page, and many hundreds stand along smoothed edges. The first are
//! kept as they are, so that a changed colour is seen however small the change; the others are gathered in boxes, the box with the
//! widest channel being cut in half until the table is full, which keeps the largest rounding small. Rounding is reported
//! per colour in the file, as two hexadecimal digits each: a comparison that did not know it would have to be blind by as
//! much everywhere.

use std::collections::BTreeMap;

use super::{Picture, ROUNDING, SUBJECT, Subject};

/// Colours in a table.
const MOST: usize = 256;
/// So many of the commonest colours are kept as they are.
const KEPT: usize = 128;
/// So many pixels have a colour that is worth keeping as it is.
const COMMON: usize = 24;

/// A table of colours.
pub(super) struct Palette {
    /// The colours, in order.
    colours: Vec<[u8; 4]>,
    /// By how much a channel of a pixel may differ from its colour in the table.
    rounding: Vec<u8>,
    /// The place in the table of each colour of the picture.
    place: BTreeMap<[u8; 4], u8>,
}

impl Palette {
    /// The table for these pixels. `None` where something shows through and there are too many colours: those pictures are kept
    /// whole.
    pub(super) fn new(pixels: &[[u8; 4]]) -> Option<Palette> {
        let mut counts: BTreeMap<[u8; 4], usize> = BTreeMap::new();
        for run in pixels.chunk_by(|a, b| a == b) {
            *counts.entry(run[0]).or_default() += run.len();
        }
        if counts.len() <= MOST {
            let exact = counts.into_keys().map(|c| (c, vec![c])).collect();
            return Some(Palette::with(exact));
        }
        if counts.keys().any(|c| c[3] < 255) {
            return None;
        }
        let mut common: Vec<([u8; 4], usize)> = counts.iter().map(|(c, n)| (*c, *n)).collect();
        common.retain(|(_, count)| *count >= COMMON);
        // The commonest first; the map's order decides between equals.
        common.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        common.truncate(KEPT);
        let mut entries: Vec<([u8; 4], Vec<[u8; 4]>)> = Vec::with_capacity(MOST);
        for (colour, _) in common {
            counts.remove(&colour);
            entries.push((colour, vec![colour]));
        }
        let rest: Vec<[u8; 4]> = counts.into_keys().collect();
        for members in boxes(rest, MOST - entries.len()) {
            entries.push((middle(&members), members));
        }
        Some(Palette::with(entries))
    }

    fn with(mut entries: Vec<([u8; 4], Vec<[u8; 4]>)>) -> Palette {
        entries.sort();
        let mut palette = Palette {
            colours: Vec::new(),
            rounding: Vec::new(),
            place: BTreeMap::new(),
        };
        for (number, (colour, members)) in entries.into_iter().enumerate() {
            let far = members.iter().map(|m| apart(*m, colour)).max();
            palette.colours.push(colour);
            palette.rounding.push(far.unwrap_or(0));
            let places = members.into_iter().map(|m| (m, number as u8));
            palette.place.extend(places);
        }
        palette
    }

    /// The note of the roundings, where there are any.
    fn note(&self) -> Option<String> {
        let any = self.rounding.iter().any(|r| *r > 0);
        any.then(|| self.rounding.iter().map(|r| format!("{r:02x}")).collect())
    }
}

/// The roundings of a note, by colour. A note that does not fit its table says nothing.
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

/// The largest difference of a channel.
pub(super) fn apart(a: [u8; 4], b: [u8; 4]) -> u8 {
    let channels = a.iter().zip(b).map(|(a, b)| a.abs_diff(b));
    channels.max().unwrap_or(0)
}

/// Lowest and highest value of the widest channel, and which that is.
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

/// Colours in at most so many boxes, the largest width of a box being as small as halving makes it.
fn boxes(all: Vec<[u8; 4]>, most: usize) -> Vec<Vec<[u8; 4]>> {
    let mut boxes = vec![all];
    let mut widths = vec![widest(&boxes[0])];
    while boxes.len() < most {
        let wide = |w: &(u8, u8, usize)| w.1.saturating_sub(w.0);
        // The first of the widest.
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
        let (below, above): (Vec<_>, Vec<_>) =
            boxes[at].iter().copied().partition(|m| m[channel] <= cut);
        widths[at] = widest(&below);
        boxes[at] = below;
        widths.push(widest(&above));
        boxes.push(above);
    }
    boxes
}

/// The member nearest to the middle of a box: a colour of its own in every table.
fn middle(members: &[[u8; 4]]) -> [u8; 4] {
    let mut centre = [0; 4];
    for (channel, value) in centre.iter_mut().enumerate() {
        let values = members.iter().map(|m| m[channel]);
        let (low, high) = values.fold((255, 0), |(low, high), v| (v.min(low), v.max(high)));
        *value = low + (high - low) / 2;
    }
    let nearest = members.iter().min_by_key(|m| apart(**m, centre));
    nearest.copied().unwrap_or(centre)
}

/// A PNG with this table, or with all its colours where there is none.
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
        let stated = encoder.add_text_chunk(SUBJECT.into(), subject.name().into());
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
            // Neighbours in a table are no neighbours in colour: differences say nothing.
            encoder.set_filter(png::Filter::NoFilter);
            let opaque = palette.colours.iter().flat_map(|c| [c[0], c[1], c[2]]);
            encoder.set_palette(opaque.collect::<Vec<u8>>());
            if palette.colours.iter().any(|c| c[3] < 255) {
                encoder.set_trns(palette.colours.iter().map(|c| c[3]).collect::<Vec<u8>>());
            }
            if let Some(note) = palette.note() {
                let stated = encoder.add_text_chunk(ROUNDING.into(), note);
                stated.map_err(failed)?;
            }
            data = Vec::with_capacity(picture.rgba.len());
            for run in picture.rgba.chunk_by(|a, b| a == b) {
                let place = palette.place.get(&run[0]).copied().unwrap_or_default();
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

    /// A page of one colour with a smooth ramp of very many others in a corner.
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
    fn common_colours_are_kept_and_every_rounding_is_told() {
        let page = page();
        let bytes = page.encode(Some(Subject::Scene)).expect("encoded");
        let read = Picture::decode(&bytes).expect("readable");
        assert_eq!(read.subject, Some(Subject::Scene));
        assert_eq!(read.rounded([255; 4]), 0);
        assert_eq!(read.rounded([30, 60, 90, 255]), 0);
        let mut worst = 0;
        for (before, after) in page.pixels().iter().zip(read.pixels()) {
            let far = apart(*before, *after);
            assert!(far <= read.rounded(*after), "{before:?} {after:?}");
            worst = worst.max(far);
        }
        assert!((1..32).contains(&worst), "{worst}");
        assert_eq!(bytes, page.encode(Some(Subject::Scene)).expect("again"));
    }

    #[test]
    fn few_colours_and_clear_pages_lose_nothing() {
        let few = Picture::new(3, 1, vec![[1, 2, 3, 255], [9, 9, 9, 40], [7, 7, 7, 0]]);
        let read = Picture::decode(&few.encode(None).expect("encoded")).expect("readable");
        assert_eq!(read, few);
        let many = (0..1000u32).map(|i| [(i % 250) as u8, (i / 250) as u8, 5, 1 + (i % 200) as u8]);
        let many = Picture::new(1000, 1, many.collect());
        let read = Picture::decode(&many.encode(None).expect("encoded")).expect("readable");
        assert_eq!(read, many);
    }

    #[test]
    fn a_note_that_does_not_fit_says_nothing() {
        assert!(rounding("0102", &[0; 9]).is_empty());
        assert!(rounding("zz01ff", &[0; 9]).is_empty());
        assert_eq!(rounding("03", &[1, 2, 4])[&[1, 2, 4, 255]], 3);
    }
}
