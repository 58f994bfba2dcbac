//! Writes animated PNG and GIF files, which show pictures one after the other and repeat endlessly.
//!
//! A picture is stored as a patch, the part that differs from the previous picture. If every pixel is opaque, all
//! pictures share one palette of at most 255 colours, with one more index for pixels that do not change. Files of both
//! formats then have about the same size.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use super::fonts::Fonts;
use super::png::{PngError, Raster, Size, rgba_in};

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

/// A rectangle of new pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Patch {
    /// Distance of the left edge of the patch from the left edge of the picture, pixels.
    pub x: u32,
    /// Distance of the upper edge of the patch from the upper edge of the picture, pixels.
    pub y: u32,
    /// Width of the patch in pixels.
    pub width: u32,
    /// Height of the patch in pixels.
    pub height: u32,
    /// The pixels row by row: the new colour of a pixel, and whether it differs from the old colour.
    pub pixels: Vec<([u8; 4], bool)>,
    /// The time for which the picture is shown, hundredths of a second.
    pub hundredths: u16,
}

impl Patch {
    /// Returns the red, green, blue and alpha bytes of all pixels of the patch, including unchanged pixels.
    pub fn all_pixels(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|(colour, _)| *colour).collect()
    }
}

/// Converts pictures, each with its duration in seconds, to patches. Returns the patches, and the width and height of
/// the pictures in pixels. A picture that equals the previous picture gets no patch; its duration is added to that of
/// the previous picture.
fn patches(rasters: impl Iterator<Item = Result<(Raster, f64), PngError>>) -> Result<(Vec<Patch>, [u32; 2]), PngError> {
    let mut patches: Vec<Patch> = Vec::new();
    let mut last: Option<Raster> = None;
    for raster in rasters {
        let (raster, seconds) = raster?;
        let hundredths = (seconds * 100.0).round() as u16;
        if let Some(last) = &last
            && (last.width, last.height) != (raster.width, raster.height)
        {
            return Err(PngError::Encode("the pictures differ in size".to_owned()));
        }
        match (patch(last.as_ref(), &raster, hundredths), patches.last_mut()) {
            (None, Some(before)) => before.hundredths = before.hundredths.saturating_add(hundredths),
            (patch, _) => patches.extend(patch),
        }
        last = Some(raster);
    }
    let size = last.map_or([0, 0], |last| [last.width, last.height]);
    Ok((patches, size))
}

/// Returns the smallest patch that contains all pixels that differ from the previous picture `before`. Returns `None`
/// if no pixel differs. Without a previous picture, the patch is the whole picture.
fn patch(before: Option<&Raster>, raster: &Raster, hundredths: u16) -> Option<Patch> {
    let across = raster.width as usize;
    let Some(before) = before else {
        return Some(Patch {
            x: 0,
            y: 0,
            width: raster.width,
            height: raster.height,
            pixels: raster.rgba.iter().map(|colour| (*colour, true)).collect(),
            hundredths,
        });
    };
    let rows = before.rgba.chunks(across).zip(raster.rgba.chunks(across));
    let changed: Vec<usize> = rows.enumerate().filter_map(|(y, (old, new))| (old != new).then_some(y)).collect();
    let (top, bottom) = (*changed.first()?, *changed.last()?);
    let (mut left, mut right) = (across, 0);
    for y in changed {
        let row = y * across..(y + 1) * across;
        let (old, new) = (&before.rgba[row.clone()], &raster.rgba[row]);
        let differs = |x: &usize| old[*x] != new[*x];
        left = left.min((0..across).find(differs).unwrap_or(across));
        right = right.max((0..across).rev().find(differs).unwrap_or(0));
    }
    let mut pixels = Vec::with_capacity((right + 1 - left) * (bottom + 1 - top));
    for y in top..=bottom {
        let row = y * across + left..=y * across + right;
        let both = before.rgba[row.clone()].iter().zip(&raster.rgba[row]);
        pixels.extend(both.map(|(old, new)| (*new, old != new)));
    }
    Some(Patch {
        x: left as u32,
        y: top as u32,
        width: (right + 1 - left) as u32,
        height: (bottom + 1 - top) as u32,
        pixels,
        hundredths,
    })
}

/// The index of a pixel that does not change.
const UNCHANGED_INDEX: u8 = 0;
/// Largest number of colours, which have the other indices.
const MAX_COLOURS: usize = 255;
/// If there are more colours, this number of the most frequent colours is kept exactly. These are usually fills and
/// lines.
const EXACT_COLOURS: usize = 96;
/// All other colours are grouped by the leading bits of each channel. Fewer than this number of bits per channel are
/// compared.
const CHANNEL_BITS: u32 = 7;

/// The colours of an animation.
struct Palette {
    /// The colours in the order of their indices, which begin at 1.
    colours: Vec<[u8; 3]>,
    /// The index of the nearest palette colour for each colour of the pictures.
    numbers: BTreeMap<[u8; 3], u8>,
}

impl Palette {
    /// Creates the palette for all pictures of an animation. Returns `None` if a changed pixel is not opaque.
    pub fn new(patches: &[Patch]) -> Option<Palette> {
        let counts = counts(patches)?;
        let colours = chosen(&counts);
        let number = |colour: &[u8; 3]| {
            let near = colours.iter().enumerate();
            let nearest = near.min_by_key(|(_, other)| distance(*colour, **other));
            nearest.map_or(UNCHANGED_INDEX, |(number, _)| number as u8 + 1)
        };
        let numbers = counts.keys().map(|colour| (*colour, number(colour)));
        Some(Palette { numbers: numbers.collect(), colours })
    }

    /// Returns the number of indices in the palette, including the index of unchanged pixels.
    pub fn len(&self) -> usize {
        self.colours.len() + 1
    }

    /// Returns the bytes of the palette: red, green and blue for each index in order.
    pub fn bytes(&self) -> Vec<u8> {
        let all = [[0; 3]].into_iter().chain(self.colours.iter().copied());
        all.flatten().collect()
    }

    /// Returns the place in the palette of the colour of each pixel of a patch, row by row. A pixel that does not change
    /// has [`UNCHANGED_INDEX`].
    pub fn indices(&self, patch: &Patch) -> Vec<u8> {
        // Neighbouring pixels often have the same colour, so keep the last colour and its index.
        let mut known = ([0; 3], None);
        let number = |(colour, changed): &([u8; 4], bool)| {
            if !changed {
                return UNCHANGED_INDEX;
            }
            let colour = opaque(*colour);
            if known.1.is_none() || known.0 != colour {
                known = (colour, self.numbers.get(&colour).copied());
            }
            known.1.unwrap_or(UNCHANGED_INDEX)
        };
        patch.pixels.iter().map(number).collect()
    }
}

fn opaque([red, green, blue, _]: [u8; 4]) -> [u8; 3] {
    [red, green, blue]
}

/// Counts the changed pixels of each colour. Returns `None` if a changed pixel is not opaque.
fn counts(patches: &[Patch]) -> Option<BTreeMap<[u8; 3], usize>> {
    let mut counts = BTreeMap::new();
    let changed = |patch: &'_ Patch| -> Vec<[u8; 4]> {
        let pixels = patch.pixels.iter().filter(|(_, changed)| *changed);
        pixels.map(|(colour, _)| *colour).collect()
    };
    for patch in patches {
        for alike in changed(patch).chunk_by(|a, b| a == b) {
            if alike[0][3] != u8::MAX {
                return None;
            }
            *counts.entry(opaque(alike[0])).or_insert(0) += alike.len();
        }
    }
    Some(counts)
}

/// Returns the colours of the palette. Up to [`MAX_COLOURS`] colours are all kept. If there are more, the result has
/// the most frequent colours, and one colour for each group of similar colours among the others.
fn chosen(counts: &BTreeMap<[u8; 3], usize>) -> Vec<[u8; 3]> {
    let mut colours: Vec<([u8; 3], usize)> = counts.iter().map(|(c, n)| (*c, *n)).collect();
    if colours.len() > MAX_COLOURS {
        colours.sort_by_key(|(colour, count)| (core::cmp::Reverse(*count), *colour));
        let others = colours.split_off(EXACT_COLOURS);
        colours.extend(reduced(&others, MAX_COLOURS - EXACT_COLOURS));
    }
    colours.into_iter().map(|(colour, _)| colour).collect()
}

/// Groups colours that have the same leading bits in each channel, and returns the first colour of each group. Compares
/// as many bits as possible such that there are at most `most` groups.
fn reduced(colours: &[([u8; 3], usize)], most: usize) -> Vec<([u8; 3], usize)> {
    for bits in (1..CHANNEL_BITS).rev() {
        let mut groups = BTreeMap::new();
        for (colour, count) in colours {
            let group = colour.map(|channel| channel >> (8 - bits));
            groups.entry(group).or_insert((*colour, *count));
        }
        if groups.len() <= most {
            return groups.into_values().collect();
        }
    }
    Vec::new()
}

fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    let channels = a.into_iter().zip(b);
    channels.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
}
