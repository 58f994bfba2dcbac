//! [`render`]: an SVG of ours as PNG bytes.

#[cfg(feature = "cli")]
mod letter;
mod pack;
#[cfg(feature = "cli")]
mod paint;
#[cfg(test)]
mod tests;

use resvg::tiny_skia::{Color, IntSize, Pixmap, Transform};

use self::pack::{encode, straight};
use super::fonts::Fonts;
use super::{MM_PER_INCH, svg, tree};
use crate::drawing::{Colour, Drawing};

/// How large a picture is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Size {
    /// One pixel per unit of the drawing.
    Natural,
    /// So many pixels wide, as high as the drawing then is.
    Width(u32),
    /// So many pixels per unit of the drawing.
    Scale(f64),
    /// For print: so wide, at so many pixels per inch, and the file says so.
    Print {
        /// Width in mm.
        width_mm: f64,
        /// Pixels per inch.
        dpi: f64,
    },
}

/// How hard a PNG is packed. The picture is the same, pixel for pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// Small files.
    #[default]
    Small,
    /// A fourth of the time, for files a third larger: for thousands of pictures.
    Quick,
}

impl Compression {
    /// Of deflate.
    fn level(self) -> u8 {
        match self {
            Compression::Small => 6,
            Compression::Quick => 1,
        }
    }
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The text is no SVG that can be drawn.
    #[error("the drawing cannot be read as SVG: {0}")]
    Svg(String),
    /// The picture would be too large or too small.
    #[error(
        "a picture of {width:.0} × {height:.0} pixels is out of range; each side must have 1 to {MOST_ACROSS} pixels \
         and both together at most {} million. Choose another width or scale",
        MOST_PIXELS / 1_000_000
    )]
    Size {
        /// Width asked for, pixels.
        width: f64,
        /// Height asked for, pixels.
        height: f64,
    },
    /// The encoder failed.
    #[error("the picture cannot be encoded: {0}")]
    Encode(String),
}

/// Most pixels in a picture.
pub const MOST_PIXELS: u64 = 100_000_000;
/// Most pixels along a side.
pub const MOST_ACROSS: u32 = 32_000;

/// An SVG drawing as PNG, transparent where the drawing leaves the page clear.
///
/// # Errors
/// [`PngError::Size`] where the picture would have more than [`MOST_PIXELS`] pixels, a side above [`MOST_ACROSS`] or no
/// pixel at all; [`PngError::Svg`] for text that is no SVG.
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

/// As [`render`], with more fonts than ours, packed as told.
///
/// # Errors
/// As [`render`].
pub fn render_in(
    svg: &str,
    size: Size,
    fonts: &Fonts,
    compression: Compression,
) -> Result<Vec<u8>, PngError> {
    encode(raster(svg, size, fonts)?, per_metre(size), compression)
}

/// As [`render_in`], of a drawing that is not written out as SVG first: the same picture, sooner.
#[cfg(feature = "cli")]
pub(crate) fn of_drawing(
    drawing: &Drawing,
    size: Size,
    fonts: &Fonts,
    compression: Compression,
) -> Result<Vec<u8>, PngError> {
    encode(painted(drawing, size, fonts)?, per_metre(size), compression)
}

/// Pixels in a metre, where the picture is for print.
fn per_metre(size: Size) -> Option<u32> {
    match size {
        Size::Print { dpi, .. } => Some((dpi * 1000.0 / MM_PER_INCH).round() as u32),
        _ => None,
    }
}

/// The pixels of a picture, before they are packed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green, blue and alpha of each, row by row from the upper left corner, not premultiplied.
    pub rgba: Vec<[u8; 4]>,
}

/// As [`render`], without packing the pixels into a PNG.
///
/// # Errors
/// As [`render`].
pub fn rgba(svg: &str, size: Size) -> Result<Raster, PngError> {
    let pixels = raster(svg, size, &Fonts::default())?;
    Ok(Raster {
        width: pixels.width(),
        height: pixels.height(),
        rgba: pixels.pixels().iter().map(|p| straight(*p)).collect(),
    })
}

/// Drawings of one size as an animated PNG, each shown for `seconds`, over and over. Where animation is unknown the first
/// is shown.
///
/// # Errors
/// As [`render`]; and [`PngError::Encode`] for no drawings, drawings of several sizes, and a time that is not between a
/// hundredth of a second and ten minutes.
pub fn animate(
    svgs: &[String],
    size: Size,
    seconds: f64,
    fonts: &Fonts,
) -> Result<Vec<u8>, PngError> {
    animated(svgs.iter().map(|svg| raster(svg, size, fonts)), seconds)
}

/// As [`animate`], of drawings that are not written out as SVG first.
#[cfg(feature = "cli")]
pub(crate) fn animate_drawings(
    drawings: &[Drawing],
    size: Size,
    seconds: f64,
    fonts: &Fonts,
) -> Result<Vec<u8>, PngError> {
    let each = drawings.iter();
    animated(each.map(|drawing| painted(drawing, size, fonts)), seconds)
}

fn animated(
    each: impl Iterator<Item = Result<Pixmap, PngError>>,
    seconds: f64,
) -> Result<Vec<u8>, PngError> {
    let wrong = |why: &str| Err(PngError::Encode(why.to_owned()));
    if !(0.01..=600.0).contains(&seconds) {
        return wrong("each picture is shown for 0.01 to 600 seconds");
    }
    let pictures = each.collect::<Result<Vec<Pixmap>, PngError>>()?;
    let Some(first) = pictures.first() else {
        return wrong("there is nothing to show");
    };
    let same = |p: &Pixmap| (p.width(), p.height()) == (first.width(), first.height());
    if !pictures.iter().all(same) {
        return wrong("the pictures differ in size");
    }
    let failed = |e: png::EncodingError| PngError::Encode(e.to_string());
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, first.width(), first.height());
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_filter(png::Filter::NoFilter);
    encoder.set_deflate_compression(png::DeflateCompression::Level(Compression::Small.level()));
    encoder.set_color(png::ColorType::Rgba);
    encoder
        .set_animated(pictures.len() as u32, 0)
        .map_err(failed)?;
    encoder
        .set_frame_delay((seconds * 100.0).round() as u16, 100)
        .map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    for picture in &pictures {
        let data: Vec<u8> = picture.pixels().iter().flat_map(|p| straight(*p)).collect();
        writer.write_image_data(&data).map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Whether a drawing of a width and height in its own units becomes a PNG of a size that can be made, before any of it is.
///
/// # Errors
/// [`PngError::Size`] where it does not.
pub fn check(width: f64, height: f64, size: Size) -> Result<(), PngError> {
    pixels(width, height, size).map(drop)
}

/// Width and height in whole pixels.
fn pixels(natural_width: f64, natural_height: f64, size: Size) -> Result<(f64, f64), PngError> {
    let scale = match size {
        Size::Natural => 1.0,
        Size::Width(width) => f64::from(width) / natural_width,
        Size::Scale(scale) => scale,
        Size::Print { width_mm, dpi } => width_mm / MM_PER_INCH * dpi / natural_width,
    };
    let (width, height) = (
        (natural_width * scale).round(),
        (natural_height * scale).round(),
    );
    let fits = |side: f64| (1.0..=f64::from(MOST_ACROSS)).contains(&side);
    if fits(width) && fits(height) && width * height <= MOST_PIXELS as f64 {
        Ok((width, height))
    } else {
        Err(PngError::Size {
            width: natural_width * scale,
            height: natural_height * scale,
        })
    }
}

fn raster(svg: &str, size: Size, fonts: &Fonts) -> Result<Pixmap, PngError> {
    let tree = tree::read(svg, fonts).map_err(PngError::Svg)?;
    let natural = (tree.size().width(), tree.size().height());
    let (mut pixels, scale) = page(natural, size, None)?;
    resvg::render(&tree, scale, &mut pixels.as_mut());
    Ok(pixels)
}

#[cfg(feature = "cli")]
fn painted(drawing: &Drawing, size: Size, fonts: &Fonts) -> Result<Pixmap, PngError> {
    if !fonts.more().is_empty() {
        // A page that is too large is refused before it is written out, which takes far more memory than the drawing.
        check(drawing.width, drawing.height, size)?;
        // Letters of other fonts may be pictures themselves, in many colours.
        return raster(&svg::for_pixels(drawing), size, fonts);
    }
    let natural = [drawing.width, drawing.height].map(|side| svg::rounded(side) as f32);
    let (mut pixels, scale) = page(natural.into(), size, drawing.background)?;
    paint::paint(drawing, scale, &mut pixels).map_err(PngError::Svg)?;
    Ok(pixels)
}

/// The pixels of a picture, all of one colour or clear, and how a drawing is scaled to them.
fn page(
    (width, height): (f32, f32),
    size: Size,
    background: Option<Colour>,
) -> Result<(Pixmap, Transform), PngError> {
    let natural = (f64::from(width), f64::from(height));
    let (width, height) = pixels(natural.0, natural.1, size)?;
    // Stretched to whole pixels, by less than one in all, so that no edge of the page is half covered.
    let scale = Transform::from_scale((width / natural.0) as f32, (height / natural.1) as f32);
    let pixels = match (background, IntSize::from_wh(width as u32, height as u32)) {
        // All bytes of a white page are alike: they are set once, and not cleared before.
        (Some(Colour::WHITE), Some(size)) => {
            let bytes = vec![u8::MAX; 4 * size.width() as usize * size.height() as usize];
            Pixmap::from_vec(bytes, size)
        }
        (background, Some(size)) => {
            let mut pixels = Pixmap::new(size.width(), size.height());
            if let (Some(pixels), Some(Colour([r, g, b]))) = (&mut pixels, background) {
                pixels.fill(Color::from_rgba8(r, g, b, u8::MAX));
            }
            pixels
        }
        (_, None) => None,
    };
    let pixels = pixels.ok_or(PngError::Size { width, height })?;
    Ok((pixels, scale))
}
