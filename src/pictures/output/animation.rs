//! Writes animated PNG and GIF files, which show pictures one after the other and repeat endlessly.
//!
//! A picture is stored as the part that differs from the previous picture. If every pixel is opaque, all pictures share
//! one palette, and files of both formats have about the same size.

mod palette;
mod patch;
#[cfg(test)]
mod tests;

use palette::{Palette, UNCHANGED_INDEX};
use patch::{Patch, patches};

use super::fonts::Fonts;
use super::png::{PngError, Size, rgba_in};

/// A picture of an animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The picture as SVG.
    pub svg: String,
    /// The time for which it is shown, seconds.
    pub seconds: f64,
}

/// Writes pictures as an animated PNG that repeats endlessly. A program that cannot show animated PNG files shows the
/// first picture.
///
/// # Errors
/// Returns [`PngError::Svg`] and [`PngError::Size`] as [`png::render`](super::png::render) does. Returns
/// [`PngError::Encode`] if there are no pictures, if they differ in size, or if the duration of a picture is less than
/// 0.01 or more than 600 seconds.
pub fn apng(steps: &[Step], size: Size, fonts: &Fonts) -> Result<Vec<u8>, PngError> {
    let (patches, [width, height]) = film(steps, size, fonts)?;
    let failed = |e: ::png::EncodingError| PngError::Encode(e.to_string());
    let palette = Palette::new(&patches);
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, width, height);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_filter(::png::Filter::NoFilter);
    encoder.set_deflate_compression(::png::DeflateCompression::Level(6));
    match &palette {
        Some(palette) => {
            encoder.set_color(::png::ColorType::Indexed);
            encoder.set_palette(palette.bytes());
            let mut opaque = vec![u8::MAX; palette.len()];
            opaque[usize::from(UNCHANGED_INDEX)] = 0;
            encoder.set_trns(opaque);
        }
        None => encoder.set_color(::png::ColorType::Rgba),
    }
    encoder.set_animated(patches.len() as u32, 0).map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    for (number, patch) in patches.iter().enumerate() {
        // The encoder checks after each call that the frame lies inside the picture. Therefore move the frame to the
        // upper left corner before its size changes.
        writer.reset_frame_position().map_err(failed)?;
        writer.set_frame_dimension(patch.width, patch.height).map_err(failed)?;
        writer.set_frame_position(patch.x, patch.y).map_err(failed)?;
        writer.set_frame_delay(patch.hundredths, 100).map_err(failed)?;
        let over = palette.is_some() && number > 0;
        let blend = if over { ::png::BlendOp::Over } else { ::png::BlendOp::Source };
        writer.set_blend_op(blend).map_err(failed)?;
        let data = match &palette {
            Some(palette) => palette.indices(patch),
            None => patch.all_pixels(),
        };
        writer.write_image_data(&data).map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Writes pictures as a GIF that repeats endlessly. All pictures together have at most 255 colours; further colours are
/// replaced by similar ones.
///
/// # Errors
/// Returns the errors of [`apng`], and also [`PngError::Encode`] if a pixel is transparent or a side is longer than
/// 65 535 pixels.
pub fn gif(steps: &[Step], size: Size, fonts: &Fonts) -> Result<Vec<u8>, PngError> {
    let (patches, [width, height]) = film(steps, size, fonts)?;
    let wrong = |why: &str| PngError::Encode(why.to_owned());
    let palette = Palette::new(&patches)
        .ok_or_else(|| wrong("a GIF must not have transparent pixels; give the page a colour"))?;
    let side = |pixels: u32| u16::try_from(pixels).map_err(|_| wrong("a GIF has at most 65535 pixels along a side"));
    let failed = |e: ::gif::EncodingError| PngError::Encode(e.to_string());
    let mut bytes = Vec::new();
    let mut encoder = ::gif::Encoder::new(&mut bytes, side(width)?, side(height)?, &palette.bytes()).map_err(failed)?;
    if patches.len() > 1 {
        encoder.set_repeat(::gif::Repeat::Infinite).map_err(failed)?;
    }
    for patch in &patches {
        let frame = ::gif::Frame {
            delay: patch.hundredths,
            transparent: Some(UNCHANGED_INDEX),
            top: side(patch.y)?,
            left: side(patch.x)?,
            width: side(patch.width)?,
            height: side(patch.height)?,
            buffer: palette.indices(patch).into(),
            ..::gif::Frame::default()
        };
        encoder.write_frame(&frame).map_err(failed)?;
    }
    // The encoder writes the end of the file when it is dropped.
    drop(encoder);
    Ok(bytes)
}

/// Renders all pictures of an animation. Returns the changed part of each picture, and the width and height of the
/// pictures in pixels.
fn film(steps: &[Step], size: Size, fonts: &Fonts) -> Result<(Vec<Patch>, [u32; 2]), PngError> {
    let wrong = |why: &str| Err(PngError::Encode(why.to_owned()));
    if steps.is_empty() {
        return wrong("there is nothing to show");
    }
    let sound = |step: &Step| (0.01..=600.0).contains(&step.seconds);
    if !steps.iter().all(sound) {
        return wrong("each picture is shown for 0.01 to 600 seconds");
    }
    let rasters = steps.iter().map(|step| Ok((rgba_in(&step.svg, size, fonts)?, step.seconds)));
    patches(rasters)
}
