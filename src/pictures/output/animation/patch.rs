//! [`Patch`]: the part of a picture that differs from the previous picture.

use super::super::png::{PngError, Raster};

/// A rectangle of new pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Patch {
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
pub(super) fn patches(
    rasters: impl Iterator<Item = Result<(Raster, f64), PngError>>,
) -> Result<(Vec<Patch>, [u32; 2]), PngError> {
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
