//! [`encode`] writes pixels as a PNG without loss, with one, three or four bytes per pixel: as few as possible.

use resvg::tiny_skia::{Pixmap, PremultipliedColorU8};

use super::{Compression, PngError};

/// The filter type "none" of a row. Filters store differences of neighbouring pixels. This makes files of photographs
/// smaller, but files of figures larger, and it takes time.
const NO_FILTER: u8 = 0;

/// Returns the bytes of a PNG file. `per_metre` is the resolution in pixels per metre that the file records, if any.
pub(super) fn encode(pixels: Pixmap, per_metre: Option<u32>, compression: Compression) -> Result<Vec<u8>, PngError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixels.width(), pixels.height());
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_pixel_dims(per_metre.map(|n| png::PixelDimensions { xppu: n, yppu: n, unit: png::Unit::Meter }));
    let rows = fewest(pixels, &mut encoder);
    let failed = |e: png::EncodingError| PngError::Encode(e.to_string());
    let mut writer = encoder.write_header().map_err(failed)?;
    // Compress all rows at once. If rows were compressed one by one, the compressor would clear its buffers each time
    // and take twice as long.
    let packed = miniz_oxide::deflate::compress_to_vec_zlib(&rows, compression.level());
    writer.write_chunk(png::chunk::IDAT, &packed).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Sets the colour type with the fewest bytes per pixel in the encoder, and returns the bytes of all rows. A pixel
/// takes one byte if there are at most 256 colours, three bytes in other opaque pictures, and four bytes otherwise.
/// Each row begins with the byte of its filter type.
fn fewest(pixels: Pixmap, encoder: &mut png::Encoder<'_, &mut Vec<u8>>) -> Vec<u8> {
    let mut table = Table::default();
    if let Some(runs) = runs(&pixels, &mut table) {
        // Sort the palette, so that it does not depend on where the colours are in the picture.
        let colours: Vec<[u8; 4]> = table.found.iter().map(|p| straight(*p)).collect();
        let mut sorted = colours.clone();
        sorted.sort_unstable();
        let number = |colour| sorted.binary_search(colour).unwrap_or_default() as u8;
        let numbers: Vec<u8> = colours.iter().map(number).collect();
        let width = pixels.width() as usize;
        let mut rows = Vec::with_capacity((1 + width) * pixels.height() as usize);
        for (colour, alike) in runs {
            if rows.len() % (1 + width) == 0 {
                rows.push(NO_FILTER);
            }
            rows.resize(rows.len() + alike, numbers[usize::from(colour)]);
        }
        encoder.set_color(png::ColorType::Indexed);
        let colours = sorted.iter().flat_map(|c| [c[0], c[1], c[2]]);
        encoder.set_palette(colours.collect::<Vec<_>>());
        if sorted.iter().any(|c| c[3] < 255) {
            encoder.set_trns(sorted.iter().map(|c| c[3]).collect::<Vec<_>>());
        }
        return rows;
    }
    // `fold` tests all pixels without an early exit, so that the compiler can test several pixels at once.
    let all = pixels.data().as_chunks::<4>().0;
    if all.iter().fold(u8::MAX, |least, pixel| least & pixel[3]) == u8::MAX {
        encoder.set_color(png::ColorType::Rgb);
        // If all pixels are opaque, premultiplied colours are equal to straight colours.
        return rows(&pixels, |p| [p.red(), p.green(), p.blue()]);
    }
    encoder.set_color(png::ColorType::Rgba);
    rows(&pixels, straight)
}

/// Returns the picture as runs of equal pixels, row by row, and adds their colours to `table`. A run consists of the
/// index of its colour in `table` and its number of pixels. Returns `None` if there are more than [`MAX_COLOURS`]
/// colours.
fn runs(pixels: &Pixmap, table: &mut Table) -> Option<Vec<(u8, usize)>> {
    let mut runs = Vec::new();
    for row in pixels.pixels().chunks_exact(pixels.width() as usize) {
        let mut rest = row;
        while let Some(first) = rest.first() {
            let alike = alike(rest, *first);
            runs.push((table.number(*first)?, alike));
            rest = &rest[alike..];
        }
    }
    Some(runs)
}

/// Returns the number of pixels at the beginning of `row` that equal `first`. The function compares eight pixels at
/// once, because figures have large areas of one colour.
fn alike(row: &[PremultipliedColorU8], first: PremultipliedColorU8) -> usize {
    let (eights, _) = row.as_chunks::<8>();
    let same = |eight: &&[PremultipliedColorU8; 8]| eight.iter().fold(true, |same, p| same & (*p == first));
    let whole = 8 * eights.iter().take_while(same).count();
    whole + row[whole..].iter().take_while(|p| **p == first).count()
}

/// Largest number of colours of a palette, because a pixel is one byte.
const MAX_COLOURS: usize = 256;
/// Size of the hash table of colours: a power of two, and large enough that most slots stay free.
const TABLE_SIZE: usize = 4 * MAX_COLOURS;

/// The colours of a picture with their indices, in the order in which they were found.
struct Table {
    found: Vec<PremultipliedColorU8>,
    /// A hash table of the indices of the colours. Each index is in the slot of its hash, or in the next free slot.
    places: [Option<u8>; TABLE_SIZE],
}

impl Default for Table {
    fn default() -> Table {
        Table { found: Vec::new(), places: [None; TABLE_SIZE] }
    }
}

impl Table {
    /// Returns the index of a colour. A colour that is not yet in the table gets the next index. Returns `None` if all
    /// indices are used.
    fn number(&mut self, colour: PremultipliedColorU8) -> Option<u8> {
        let bits = u32::from_le_bytes([colour.red(), colour.green(), colour.blue(), colour.alpha()]);
        // Multiplicative hashing: the factor is 2³² divided by the golden ratio. The high bits of the product depend on
        // all channels.
        let mut place = (bits.wrapping_mul(0x9e37_79b9) >> 22) as usize;
        while let Some(number) = self.places[place] {
            if self.found[usize::from(number)] == colour {
                return Some(number);
            }
            place = (place + 1) % TABLE_SIZE;
        }
        let number = u8::try_from(self.found.len()).ok()?;
        self.places[place] = Some(number);
        self.found.push(colour);
        Some(number)
    }
}

fn rows<const N: usize>(pixels: &Pixmap, bytes: impl Fn(PremultipliedColorU8) -> [u8; N]) -> Vec<u8> {
    let (width, height) = (pixels.width() as usize, pixels.height() as usize);
    let mut rows = vec![NO_FILTER; (1 + N * width) * height];
    let all = pixels.pixels().chunks_exact(width);
    for (row, pixels) in rows.chunks_exact_mut(1 + N * width).zip(all) {
        let (places, _) = row[1..].as_chunks_mut::<N>();
        for (place, pixel) in places.iter_mut().zip(pixels) {
            *place = bytes(*pixel);
        }
    }
    rows
}

/// Returns the red, green, blue and alpha bytes of a pixel, not premultiplied.
pub(super) fn straight(pixel: PremultipliedColorU8) -> [u8; 4] {
    let c = pixel.demultiply();
    [c.red(), c.green(), c.blue(), c.alpha()]
}
