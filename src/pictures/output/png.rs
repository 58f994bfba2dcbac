//! [`render`] converts an SVG to a PNG with the resvg library.

mod pack;
#[cfg(test)]
mod tests;

use resvg::tiny_skia::{Pixmap, Transform};

use self::pack::{encode, straight};
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
