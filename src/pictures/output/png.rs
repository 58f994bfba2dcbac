//! [`render`] converts an SVG to a PNG with the resvg library. `encode` writes pixels as a PNG without loss, with one,
//! three or four bytes per pixel: as few as possible.

#[cfg(test)]
mod tests;

use resvg::tiny_skia::{Pixmap, PremultipliedColorU8, Transform};

use super::fonts::Fonts;
use super::{MM_PER_INCH, tree};

/// The size of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Size {
    /// One pixel per unit of the drawing.
    Natural,
    /// Width in pixels; the height keeps the proportions of the drawing.
    Width(u32),
    /// Pixels per unit of the drawing.
    Scale(f64),
    /// For print: a width and a resolution, which the file records.
    Print {
        /// Width in mm.
        width_mm: f64,
        /// Pixels per inch.
        dpi: f64,
    },
}

/// The compression of a PNG. It does not change the pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// Small files.
    #[default]
    Small,
    /// Takes a quarter of the time of `Small`, and files are a third larger. Suitable for thousands of pictures.
    Quick,
}

impl Compression {
    /// Returns the compression level for deflate.
    fn level(self) -> u8 {
        match self {
            Compression::Small => 6,
            Compression::Quick => 1,
        }
    }
}

/// Why a picture could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The text is not an SVG that resvg can draw.
    #[error("the drawing cannot be read as SVG: {0}")]
    Svg(String),
    /// The picture would be too large or too small.
    #[error(
        "a picture of {width:.0} × {height:.0} pixels is out of range; each side must have 1 to {MAX_SIDE} pixels \
         and the picture at most {} million pixels. Choose another width or scale",
        MAX_PIXELS / 1_000_000
    )]
    Size {
        /// Requested width, pixels.
        width: f64,
        /// Requested height, pixels.
        height: f64,
    },
    /// The encoder failed.
    #[error("the picture cannot be encoded: {0}")]
    Encode(String),
}

/// Largest number of pixels of a picture.
pub const MAX_PIXELS: u64 = 100_000_000;
/// Largest number of pixels along a side.
pub const MAX_SIDE: u32 = 32_000;

/// Renders an SVG and returns the bytes of a PNG file. The picture is transparent where the SVG is empty.
///
/// # Errors
/// Returns [`PngError::Size`] if the picture would have more than [`MAX_PIXELS`] pixels, a side above [`MAX_SIDE`] or
/// no pixels; returns [`PngError::Svg`] for text that is not SVG.
///
/// # Example
/// ```
/// use drystone::output::png::{Size, render};
/// let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='3' height='2'/>";
/// let png = render(svg, Size::Width(30))?;
/// assert_eq!(&png[16..24], [0, 0, 0, 30, 0, 0, 0, 20]);
/// # Ok::<(), drystone::output::png::PngError>(())
/// ```
pub fn render(svg: &str, size: Size) -> Result<Vec<u8>, PngError> {
    render_in(svg, size, &Fonts::default(), Compression::default())
}

/// Like [`render`], with additional fonts and a compression level.
///
/// # Errors
/// See [`render`].
pub fn render_in(svg: &str, size: Size, fonts: &Fonts, compression: Compression) -> Result<Vec<u8>, PngError> {
    encode(raster(svg, size, fonts)?, per_metre(size), compression)
}

/// Returns the resolution of a picture for print, in pixels per metre. Returns `None` if the size is not for print.
fn per_metre(size: Size) -> Option<u32> {
    match size {
        Size::Print { dpi, .. } => Some((dpi * 1000.0 / MM_PER_INCH).round() as u32),
        _ => None,
    }
}

/// The pixels of a picture, not compressed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue and alpha of each pixel, row by row from the upper left corner, not premultiplied.
    pub rgba: Vec<[u8; 4]>,
}

/// Like [`render`], but returns the pixels instead of a PNG file.
///
/// # Errors
/// See [`render`].
pub fn rgba(svg: &str, size: Size) -> Result<Raster, PngError> {
    rgba_in(svg, size, &Fonts::default())
}

/// Like [`rgba`], with additional fonts.
///
/// # Errors
/// See [`render`].
pub(super) fn rgba_in(svg: &str, size: Size, fonts: &Fonts) -> Result<Raster, PngError> {
    let pixels = raster(svg, size, fonts)?;
    Ok(Raster {
        width: pixels.width(),
        height: pixels.height(),
        rgba: pixels.pixels().iter().map(|p| straight(*p)).collect(),
    })
}

/// Checks that a drawing of this width and height in pixels gives a PNG of an allowed size.
///
/// # Errors
/// Returns [`PngError::Size`] if the size is out of range.
pub fn check(width: f64, height: f64, size: Size) -> Result<(), PngError> {
    pixels(width, height, size).map(drop)
}

/// Returns the width and height of a picture in whole pixels. `natural_width` and `natural_height` are the width and
/// height of the drawing. Returns an error if the size of the picture is out of range.
fn pixels(natural_width: f64, natural_height: f64, size: Size) -> Result<(f64, f64), PngError> {
    let scale = match size {
        Size::Natural => 1.0,
        Size::Width(width) => f64::from(width) / natural_width,
        Size::Scale(scale) => scale,
        Size::Print { width_mm, dpi } => width_mm / MM_PER_INCH * dpi / natural_width,
    };
    let (width, height) = ((natural_width * scale).round(), (natural_height * scale).round());
    let fits = |side: f64| (1.0..=f64::from(MAX_SIDE)).contains(&side);
    if fits(width) && fits(height) && width * height <= MAX_PIXELS as f64 {
        Ok((width, height))
    } else {
        Err(PngError::Size { width: natural_width * scale, height: natural_height * scale })
    }
}

/// Renders an SVG to pixels. The colours are premultiplied by their opacity.
fn raster(svg: &str, size: Size, fonts: &Fonts) -> Result<Pixmap, PngError> {
    let tree = tree::read(svg, fonts).map_err(PngError::Svg)?;
    let natural = (f64::from(tree.size().width()), f64::from(tree.size().height()));
    let (width, height) = pixels(natural.0, natural.1, size)?;
    let mut pixels = Pixmap::new(width as u32, height as u32).ok_or(PngError::Size { width, height })?;
    // Stretch the drawing by less than one pixel, so that it fills whole pixels. Otherwise the border pixels of the
    // picture would be partly transparent.
    let scale = Transform::from_scale((width / natural.0) as f32, (height / natural.1) as f32);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    Ok(pixels)
}

/// The filter type "none" of a row. Filters store differences of neighbouring pixels. This makes files of photographs
/// smaller, but files of figures larger, and it takes time.
const NO_FILTER: u8 = 0;

/// Returns the bytes of a PNG file. `per_metre` is the resolution in pixels per metre that the file records, if any.
fn encode(pixels: Pixmap, per_metre: Option<u32>, compression: Compression) -> Result<Vec<u8>, PngError> {
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
fn straight(pixel: PremultipliedColorU8) -> [u8; 4] {
    let c = pixel.demultiply();
    [c.red(), c.green(), c.blue(), c.alpha()]
}
