//! [`Picture`]: the pixels of a PNG file of any program. [`Difference`]: the pixels that differ between two pictures.
//!
//! Every PNG becomes 8-bit red, green, blue and alpha, not premultiplied; of 16-bit channels, the upper 8 bits are used. Two
//! pixels count as equal if no channel differs by more than a tolerance.

use std::io::{Cursor, ErrorKind};

use png::{BitDepth, ColorType, DecodingError, Transformations};

use super::layer::UnreadableReference;
use crate::pictures::output::png::{MAX_PIXELS, MAX_SIDE};

/// The first bytes of a PNG.
const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// The largest difference of a channel that nobody can see, of 255, if only one of [`INVISIBLE_SHARE`] pixels differs.
const MAX_INVISIBLE: u8 = 16;
const INVISIBLE_SHARE: u64 = 10_000;
/// The colour of pixels that differ.
const CHANGED: [u8; 4] = [0xd4, 0x00, 0x1a, 255];
/// The colour of the area that only one of the pictures has.
const BEYOND: [u8; 4] = [0xb8, 0xd4, 0xf0, 255];
/// The colour of the rectangle around the pixels that differ, and its distance from them in pixels.
const BOX: ([u8; 4], u32) = ([0xf0, 0x70, 0x80, 255], 3);

/// A picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
    /// Red, green, blue and alpha of each pixel, row by row from the upper left corner, not premultiplied. If alpha
    /// is 0, the other channels are 0 too, because they are invisible.
    rgba: Vec<[u8; 4]>,
}

impl Picture {
    /// Makes a picture from its pixels: red, green, blue and alpha, row by row, not premultiplied.
    ///
    /// # Panics
    /// If there are not `width` × `height` pixels.
    pub fn new(width: u32, height: u32, mut rgba: Vec<[u8; 4]>) -> Picture {
        let count = u64::from(width) * u64::from(height);
        assert_eq!(rgba.len() as u64, count, "the number of pixels must be width times height");
        for pixel in rgba.iter_mut().filter(|p| p[3] == 0) {
            *pixel = [0; 4];
        }
        Picture { width, height, rgba }
    }

    /// Decodes a PNG.
    ///
    /// # Errors
    /// [`UnreadableReference`] if the bytes are not a PNG, or a PNG that is damaged, too large or animated.
    ///
    /// # Example
    /// ```
    /// use drystone::snapshot::picture::Picture;
    /// let refused = Picture::decode(b"<svg/>").expect_err("no PNG");
    /// assert_eq!(refused.to_string(), "it is not a PNG: it is an SVG or another XML file");
    /// ```
    pub fn decode(bytes: &[u8]) -> Result<Picture, UnreadableReference> {
        require_png(bytes)?;
        let wrong = |error: DecodingError| match error {
            DecodingError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => truncated(bytes),
            error => UnreadableReference(format!("it is a damaged PNG: {error}")),
        };
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(wrong)?;
        let info = reader.info();
        let (width, height) = (info.width, info.height);
        let large = || {
            UnreadableReference(format!(
                "{width} × {height} pixels are too many: at most {MAX_SIDE} along a side and {} million in all",
                MAX_PIXELS / 1_000_000
            ))
        };
        if width > MAX_SIDE || height > MAX_SIDE || u64::from(width) * u64::from(height) > MAX_PIXELS {
            return Err(large());
        }
        if let Some(animation) = info.animation_control.filter(|a| a.num_frames > 1) {
            let words = "a snapshot must be a single picture";
            return Err(UnreadableReference(format!(
                "it is an animation of {} pictures; {words}",
                animation.num_frames
            )));
        }
        let mut data = vec![0; reader.output_buffer_size().ok_or_else(large)?];
        let frame = reader.next_frame(&mut data).map_err(wrong)?;
        reader.finish().map_err(wrong)?;
        data.truncate(frame.buffer_size());
        let pixels = data.chunks_exact(frame.color_type.samples()).map(|pixel| match *pixel {
            [grey] => [grey, grey, grey, 255],
            [grey, alpha] => [grey, grey, grey, alpha],
            [r, g, b] => [r, g, b, 255],
            [r, g, b, a, ..] => [r, g, b, a],
            [] => [0; 4],
        });
        Ok(Picture::new(width, height, pixels.collect()))
    }

    /// Encodes the picture as a PNG without loss.
    ///
    /// # Errors
    /// The message of the PNG encoder.
    pub fn encode(&self) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(self.rgba.as_flattened())?;
            writer.finish()
        });
        written.map_err(|error| error.to_string())?;
        Ok(bytes)
    }

    /// Returns red, green, blue and alpha of the pixel in column x and row y, from 0.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        self.rgba[y as usize * self.width as usize + x as usize]
    }

    /// Returns all pixels, row by row.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.rgba
    }
}

/// The difference of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The number of pixels that differ, in the area that both pictures share.
    pub changed: u64,
    /// The number of pixels in the area that both pictures share.
    pub of: u64,
    /// The largest difference of a channel among the pixels that differ, 0 … 255.
    pub largest: u8,
    /// Left, top, width and height of the bounding box of the pixels that differ; `None` if no pixel differs.
    pub bounds: Option<[u32; 4]>,
    /// Width and height of the expected picture, then of the found picture, in pixels.
    pub sizes: [(u32, u32); 2],
    /// Columns and rows of the pixels that differ.
    pixels: Vec<(u32, u32)>,
}

impl Difference {
    /// Compares the picture `found` with the expected picture. Two pixels are equal if none of their channels differ by
    /// more than `tolerance`, 0 … 254. Colours are multiplied by alpha before they are compared.
    ///
    /// # Example
    /// ```
    /// use drystone::snapshot::picture::{Difference, Picture};
    /// let page = |x: usize| {
    ///     let mut pixels = vec![[250, 250, 250, 255]; 40];
    ///     pixels[x] = [10, 20, 30, 255];
    ///     Picture::new(8, 5, pixels)
    /// };
    /// let found = Difference::new(&page(3), &page(12), 1);
    /// assert_eq!((found.changed, found.bounds), (2, Some([3, 0, 2, 2])));
    /// assert_eq!(found.words(), "2 of 40 pixels differ, by up to 240 of 255, within 2 × 2 pixels from (3, 0)");
    /// ```
    pub fn new(expected: &Picture, found: &Picture, tolerance: u8) -> Difference {
        let (width, height) = (expected.width.min(found.width), expected.height.min(found.height));
        let mut largest = 0;
        let mut pixels = Vec::new();
        for y in 0..height {
            let row = |p: &Picture| {
                let begin = y as usize * p.width as usize;
                begin..begin + width as usize
            };
            // Skip equal rows and equal pixels, because most pixels are usually equal.
            let (a, b) = (&expected.rgba[row(expected)], &found.rgba[row(found)]);
            if a == b {
                continue;
            }
            for (x, (a, b)) in (0..width).zip(a.iter().zip(b)) {
                let by = if a == b { 0 } else { visible_difference(*a, *b) };
                if by > tolerance {
                    largest = largest.max(by);
                    pixels.push((x, y));
                }
            }
        }
        let across = pixels.iter().map(|p| p.0);
        let edges = (across.clone().min(), across.max(), pixels.first(), pixels.last());
        let bounds = match edges {
            (Some(left), Some(right), Some(first), Some(last)) => {
                Some([left, first.1, right - left + 1, last.1 - first.1 + 1])
            }
            _ => None,
        };
        Difference {
            changed: pixels.len() as u64,
            of: u64::from(width) * u64::from(height),
            largest,
            bounds,
            sizes: [expected, found].map(|p| (p.width, p.height)),
            pixels,
        }
    }

    /// True if the pictures count as equal: they have the same size, and no pixel differs by more than the tolerance.
    pub fn is_none(&self) -> bool {
        self.changed == 0 && self.sizes[0] == self.sizes[1]
    }

    /// True if nobody can see the difference: equal sizes, no channel differs by more than 16 of 255, and at most 0.01 %
    /// of the pixels differ.
    pub fn is_invisible(&self) -> bool {
        self.sizes[0] == self.sizes[1]
            && self.largest <= MAX_INVISIBLE
            && self.changed.saturating_mul(INVISIBLE_SHARE) <= self.of
    }

    /// Describes the difference in words; empty if the pictures count as equal.
    pub fn words(&self) -> String {
        let [(ew, eh), (fw, fh)] = self.sizes;
        let mut words = Vec::new();
        if (ew, eh) != (fw, fh) {
            words.push(format!("{ew} × {eh} pixels expected, {fw} × {fh} found"));
        }
        if let Some([x, y, w, h]) = self.bounds {
            words.push(format!(
                "{} of {} pixels differ, by up to {} of 255, within {w} × {h} pixels from ({x}, {y})",
                self.changed, self.of, self.largest
            ));
        }
        words.join("; ")
    }

    /// Draws an image of the difference. The expected picture is pale grey. Pixels that differ are red, and a rectangle
    /// encloses them. Pixels outside one of the pictures are blue.
    pub fn image(&self, expected: &Picture) -> Picture {
        let [(ew, eh), (fw, fh)] = self.sizes;
        let (wide, high) = (ew.max(fw), eh.max(fh));
        let mut image = Picture::new(wide, high, vec![BEYOND; wide as usize * high as usize]);
        let index = |x: u32, y: u32| y as usize * wide as usize + x as usize;
        for y in 0..eh.min(fh) {
            for x in 0..ew.min(fw) {
                image.rgba[index(x, y)] = pale_grey(expected.pixel(x, y));
            }
        }
        if let Some([x, y, w, h]) = self.bounds {
            let (left, top) = (x.saturating_sub(BOX.1), y.saturating_sub(BOX.1));
            let (right, bottom) = ((x + w - 1 + BOX.1).min(wide - 1), (y + h - 1 + BOX.1).min(high - 1));
            let across = (left..=right).flat_map(|x| [(x, top), (x, bottom)]);
            for (x, y) in across.chain((top..=bottom).flat_map(|y| [(left, y), (right, y)])) {
                image.rgba[index(x, y)] = BOX.0;
            }
        }
        for (x, y) in &self.pixels {
            image.rgba[index(*x, *y)] = CHANGED;
        }
        image
    }
}

/// Returns the largest difference of a channel between two colours, from 0 to 255. Red, green and blue are multiplied
/// by alpha first, and alpha counts as a channel.
fn visible_difference(a: [u8; 4], b: [u8; 4]) -> u8 {
    let premultiplied = |[r, g, b, alpha]: [u8; 4]| {
        let share = |c: u8| ((u16::from(c) * u16::from(alpha) + 127) / 255) as u8;
        [share(r), share(g), share(b), alpha]
    };
    let channels = premultiplied(a).into_iter().zip(premultiplied(b)).map(|(a, b)| a.abs_diff(b));
    channels.max().unwrap_or(0)
}

/// Converts a colour to pale grey, by its brightness. There are only 32 levels, so that the PNG is small.
fn pale_grey([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let grey = (299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b)) / 1000;
    let ink = (255 - grey) * u32::from(a) / 255;
    let pale = 255 - (ink / 8 * 8) * 2 / 5;
    [pale as u8, pale as u8, pale as u8, 255]
}

fn truncated(bytes: &[u8]) -> UnreadableReference {
    UnreadableReference(format!("it is truncated after {} bytes", bytes.len()))
}

/// Returns an error that names the kind of file, unless the bytes begin like a PNG.
fn require_png(bytes: &[u8]) -> Result<(), UnreadableReference> {
    UnreadableReference::check(bytes, "picture")?;
    if bytes.starts_with(PNG_SIGNATURE) {
        return Ok(());
    }
    if PNG_SIGNATURE.starts_with(bytes) {
        return Err(truncated(bytes));
    }
    let kind = match bytes {
        b if b.starts_with(b"\x89PNG") => {
            "its line endings were converted as in a text file; mark *.png as binary in .gitattributes"
        }
        [b'<', ..] => "it is an SVG or another XML file",
        _ => "it begins with other bytes",
    };
    Err(UnreadableReference(format!("it is not a PNG: {kind}")))
}
