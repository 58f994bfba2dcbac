//! [`render`]: an SVG of ours as PNG bytes.

mod letter;
mod pack;
mod paint;

use resvg::tiny_skia::{Pixmap, Transform};

use self::pack::{encode, straight};
use super::fonts::Fonts;
use super::{MM_PER_INCH, svg, tree};
use crate::drawing::Drawing;

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

/// As [`render_in`], of a drawing that is not written out as SVG first: the same picture in half the time.
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
    let (mut pixels, scale) = page(natural, size)?;
    resvg::render(&tree, scale, &mut pixels.as_mut());
    Ok(pixels)
}

#[cfg(feature = "cli")]
fn painted(drawing: &Drawing, size: Size, fonts: &Fonts) -> Result<Pixmap, PngError> {
    if fonts.more().is_empty() {
        let natural = [drawing.width, drawing.height].map(|side| svg::rounded(side) as f32);
        let (mut pixels, scale) = page(natural.into(), size)?;
        paint::paint(drawing, scale, &mut pixels).map_err(PngError::Svg)?;
        return Ok(pixels);
    }
    // A page that is too large is refused before it is written out, which takes far more memory than the drawing.
    check(drawing.width, drawing.height, size)?;
    // Letters of other fonts may be pictures themselves, in many colours.
    raster(&svg::for_pixels(drawing), size, fonts)
}

/// The clear pixels of a picture, and how a drawing is scaled to them.
fn page((width, height): (f32, f32), size: Size) -> Result<(Pixmap, Transform), PngError> {
    let natural = (f64::from(width), f64::from(height));
    let (width, height) = pixels(natural.0, natural.1, size)?;
    let Some(pixels) = Pixmap::new(width as u32, height as u32) else {
        return Err(PngError::Size { width, height });
    };
    // Stretched to whole pixels, by less than one in all, so that no edge of the page is half covered.
    let scale = Transform::from_scale((width / natural.0) as f32, (height / natural.1) as f32);
    Ok((pixels, scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Colour, Drawing, Face, PagePoint, Text};
    use crate::output::svg;

    fn words(words: &str, face: Face) -> String {
        let text = Text::new(PagePoint::new(5.0, 30.0), words, face, 24.0, Colour::BLACK);
        svg::write(&Drawing {
            width: 120.0,
            height: 40.0,
            title: String::new(),
            description: String::new(),
            background: Some(Colour::WHITE),
            items: vec![text.into()],
        })
    }

    /// Share of dark pixels.
    fn ink(svg: &str) -> f64 {
        let bytes = render(svg, Size::Natural).expect("a picture");
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("png");
        let mut data = vec![0; reader.output_buffer_size().expect("size")];
        reader.next_frame(&mut data).expect("frame");
        data.chunks_exact(3).filter(|p| p[0] < 128).count() as f64 / (data.len() as f64 / 3.0)
    }

    #[test]
    fn every_face_leaves_ink_and_bold_leaves_more() {
        for face in Face::ALL {
            assert!(ink(&words("Block 3", face)) > 0.02, "{face:?}");
        }
        assert!(
            ink(&words("Block 3", Face::SerifBold)) > 1.15 * ink(&words("Block 3", Face::Serif))
        );
        assert!(ink(&words("Block 3", Face::SansBold)) > 1.05 * ink(&words("Block 3", Face::Sans)));
        assert_eq!(ink(&words("", Face::Sans)), 0.0);
    }

    #[test]
    fn characters_no_font_has_leave_a_question_mark_and_no_box() {
        let picture =
            |text: &str, face| render(&words(text, face), Size::Natural).expect("a picture");
        for face in [Face::Serif, Face::Sans] {
            for unknown in ["石", "🪨", "ア", "\u{e000}", "لوح"] {
                let marks = "?".repeat(unknown.chars().count());
                assert_eq!(picture(unknown, face), picture(&marks, face), "{unknown}");
            }
        }
    }

    fn decoded(bytes: Vec<u8>) -> Vec<u8> {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::ALPHA | png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("png");
        let mut data = vec![0; reader.output_buffer_size().expect("size")];
        reader.next_frame(&mut data).expect("frame");
        data
    }

    #[test]
    fn a_picture_has_the_pixels_drawn_however_it_is_packed() {
        let ramp = "<linearGradient id='r'><stop stop-color='#f00'/><stop offset='0.5' stop-color='#0f0'/><stop offset='1' stop-color='#00f'/></linearGradient>\
                    <rect width='600' height='40' fill='url(#r)'";
        // A table of few colours, some half clear; many opaque ones; many half clear ones.
        for (inside, colour_type) in [
            (
                "<rect width='9' height='9' fill='#123456' opacity='0.4'/>".to_owned(),
                3,
            ),
            (format!("{ramp}/>"), 2),
            (format!("{ramp} opacity='0.9'/>"), 6),
        ] {
            let svg = format!(
                "<svg xmlns='http://www.w3.org/2000/svg' width='600' height='40'>{inside}</svg>"
            );
            let drawn = rgba(&svg, Size::Natural).expect("drawn").rgba.concat();
            let [small, quick] = [Compression::Small, Compression::Quick].map(|compression| {
                render_in(&svg, Size::Natural, &Fonts::default(), compression).expect("packed")
            });
            assert_eq!(small[25], colour_type, "the PNG's colour type");
            assert!(small.len() <= quick.len());
            for packed in [small, quick] {
                assert!(decoded(packed) == drawn, "{inside}");
            }
        }
    }

    #[test]
    fn the_same_text_gives_the_same_bytes() {
        let svg = words("Same", Face::Serif);
        assert_eq!(
            render(&svg, Size::Scale(2.5)).expect("one"),
            render(&svg, Size::Scale(2.5)).expect("two")
        );
    }

    #[test]
    fn absurd_sizes_and_foreign_text_are_refused_in_words() {
        let svg = words("x", Face::Serif);
        for size in [
            Size::Width(0),
            Size::Width(60_000),
            Size::Scale(0.0),
            Size::Scale(-1.0),
            Size::Scale(f64::NAN),
            Size::Scale(1e9),
            Size::Width(31_000),
        ] {
            let refused = render(&svg, size).expect_err("out of range");
            assert!(
                matches!(refused, PngError::Size { .. })
                    && refused.to_string().contains("at most 100 million")
            );
        }
        assert!(matches!(
            render("no svg", Size::Natural),
            Err(PngError::Svg(_))
        ));
    }
}
