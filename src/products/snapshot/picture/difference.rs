//! [`Difference`]: counts the pixels that differ, and shows where they are.

use super::Picture;
use super::palette::max_channel_difference;
use super::perception::{differ, is_antialiased};

/// The largest differences at which two pixels count as equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelTolerance {
    /// The largest allowed difference of a channel, 0 … 255. Colours of transparent pixels are multiplied by alpha
    /// first. The default is 1: another processor or compiler may round a blended colour to the neighbouring value.
    pub channel: u8,
    /// If given, a pixel that differs by more than `channel` counts as different only if it also looks different. Its
    /// colour distance must exceed this threshold (0 … 1), and it must not be antialiasing of the same edge. The tool
    /// pixelmatch uses 0.1.
    pub perceptual: Option<f64>,
}

impl Default for PixelTolerance {
    fn default() -> PixelTolerance {
        PixelTolerance { channel: 1, perceptual: None }
    }
}

/// The result for one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PixelMark {
    Same,
    /// The pixels differ only in antialiasing, so they count as equal.
    Smoothed,
    Changed,
    /// The position is outside one of the pictures.
    Beyond,
}

/// The pixels at one position in both pictures.
struct PixelPair<'p> {
    expected: &'p Picture,
    found: &'p Picture,
    x: u32,
    y: u32,
}

impl PixelPair<'_> {
    /// Compares the two pixels. Returns the mark of the pixel, and the largest difference of a colour channel.
    /// Returns `None` if the tolerance allows this difference.
    fn compare(&self, tolerance: PixelTolerance) -> Option<(PixelMark, u8)> {
        let (expected, found) = (self.expected, self.found);
        let (a, b) = (expected.pixel(self.x, self.y), found.pixel(self.x, self.y));
        // Allow for the palette of a reference, which may have rounded the colours.
        let rounding = expected.rounding_of(a).max(found.rounding_of(b));
        let by = visible_difference(a, b);
        if by <= tolerance.channel.saturating_add(rounding) {
            return None;
        }
        let Some(threshold) = tolerance.perceptual else {
            return Some((PixelMark::Changed, by));
        };
        if !differ(a, b, threshold) {
            return None;
        }
        // Antialiasing is detected from neighbouring pixels. Neighbours at the same position can be
        // compared only in pictures of equal size.
        let same_size = (expected.width, expected.height) == (found.width, found.height);
        let antialiased = same_size
            && (is_antialiased(expected, found, self.x, self.y) || is_antialiased(found, expected, self.x, self.y));
        let mark = if antialiased { PixelMark::Smoothed } else { PixelMark::Changed };
        Some((mark, by))
    }
}

/// The difference of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The number of pixels that differ, in the area that both pictures share.
    pub changed: u64,
    /// The number of pixels that differ only in antialiasing. Such pixels count as equal.
    pub smoothed: u64,
    /// The number of pixels in the area that both pictures share.
    pub of: u64,
    /// The largest difference of a channel among the pixels that differ, 0 … 255.
    pub largest: u8,
    /// Left, top, width and height of the bounding box of the pixels that differ; `None` if no pixel differs.
    pub bounds: Option<[u32; 4]>,
    /// Width and height of the expected picture, then of the found picture, in pixels.
    pub sizes: [(u32, u32); 2],
    marks: Vec<PixelMark>,
}

impl Difference {
    /// Compares the picture `found` with the expected picture.
    ///
    /// # Example
    /// ```
    /// use drystone::snapshot::picture::{Difference, Picture, PixelTolerance};
    /// let page = |x: usize| {
    ///     let mut pixels = vec![[250, 250, 250, 255]; 40];
    ///     pixels[x] = [10, 20, 30, 255];
    ///     Picture::new(8, 5, pixels)
    /// };
    /// let found = Difference::new(&page(3), &page(12), PixelTolerance::default());
    /// assert_eq!((found.changed, found.bounds), (2, Some([3, 0, 2, 2])));
    /// assert_eq!(found.words(), "2 of 40 pixels differ, by up to 240 of 255, within 2 × 2 pixels from (3, 0)");
    /// ```
    pub fn new(expected: &Picture, found: &Picture, tolerance: PixelTolerance) -> Difference {
        let (width, height) = (expected.width.min(found.width), expected.height.min(found.height));
        let mut difference = Difference {
            changed: 0,
            smoothed: 0,
            of: u64::from(width) * u64::from(height),
            largest: 0,
            bounds: None,
            sizes: [expected, found].map(|p| (p.width, p.height)),
            marks: Vec::new(),
        };
        let mut marked: Vec<(u32, u32, PixelMark)> = Vec::new();
        for y in 0..height {
            let row = |p: &Picture| {
                let begin = y as usize * p.width as usize;
                begin..begin + width as usize
            };
            // 1. Skip equal rows and equal pixels, because most pixels are usually equal.
            let (a, b) = (&expected.rgba[row(expected)], &found.rgba[row(found)]);
            if a == b {
                continue;
            }
            for (x, (a, b)) in (0..width).zip(a.iter().zip(b)) {
                if a == b {
                    continue;
                }
                // 2. Compare the pixel, and mark it if it differs.
                let pair = PixelPair { expected, found, x, y };
                if let Some((mark, by)) = pair.compare(tolerance) {
                    difference.count(mark, by, x, y);
                    marked.push((x, y, mark));
                }
            }
        }
        // 3. Store the marks, which the image of the difference needs.
        if !difference.is_none() {
            difference.set_marks(&marked);
        }
        difference
    }

    /// Adds a differing pixel to the counts and to the bounding box.
    fn count(&mut self, mark: PixelMark, by: u8, x: u32, y: u32) {
        if mark == PixelMark::Smoothed {
            self.smoothed += 1;
            return;
        }
        self.changed += 1;
        self.largest = self.largest.max(by);
        self.bounds = Some(match self.bounds {
            None => [x, y, 1, 1],
            Some([left, top, width, height]) => {
                let (right, bottom) = ((left + width).max(x + 1), (top + height).max(y + 1));
                let (left, top) = (left.min(x), top.min(y));
                [left, top, right - left, bottom - top]
            }
        });
    }

    /// Stores the marks of all pixels, in an area that covers both pictures.
    fn set_marks(&mut self, marked: &[(u32, u32, PixelMark)]) {
        let [(ew, eh), (fw, fh)] = self.sizes;
        let (all_across, all_down) = (ew.max(fw), eh.max(fh));
        self.marks = vec![PixelMark::Beyond; all_across as usize * all_down as usize];
        let index = |x: u32, y: u32| y as usize * all_across as usize + x as usize;
        for y in 0..eh.min(fh) {
            let begin = index(0, y);
            self.marks[begin..begin + ew.min(fw) as usize].fill(PixelMark::Same);
        }
        for (x, y, mark) in marked {
            self.marks[index(*x, *y)] = *mark;
        }
    }

    /// True if the pictures count as equal: they have the same size, and no pixel differs by more than the tolerance.
    /// Pixels that differ only in antialiasing count as equal.
    pub fn is_none(&self) -> bool {
        self.changed == 0 && self.sizes[0] == self.sizes[1]
    }

    /// Describes the difference in words; empty if the pictures count as equal.
    pub fn words(&self) -> String {
        let [(ew, eh), (fw, fh)] = self.sizes;
        let mut words = Vec::new();
        if (ew, eh) != (fw, fh) {
            words.push(format!("{ew} × {eh} pixels expected, {fw} × {fh} found"));
        }
        if let Some([x, y, w, h]) = self.bounds {
            let smoothed = match self.smoothed {
                0 => String::new(),
                n => format!("; {n} more differ only in antialiasing"),
            };
            words.push(format!(
                "{} of {} pixels differ, by up to {} of 255, within {w} × {h} pixels from ({x}, {y}){smoothed}",
                self.changed, self.of, self.largest
            ));
        }
        words.join("; ")
    }

    /// Draws an image of the difference. The expected picture is pale grey. Pixels that differ are red, and a rectangle
    /// encloses them. Pixels that differ only in antialiasing are yellow, and pixels outside one of the pictures are
    /// blue.
    pub fn image(&self, expected: &Picture) -> Picture {
        let [(ew, eh), (fw, fh)] = self.sizes;
        let (wide, high) = (ew.max(fw), eh.max(fh));
        let mut pixels = Vec::with_capacity(self.marks.len());
        for y in 0..high {
            for x in 0..wide {
                let mark = self.marks.get(y as usize * wide as usize + x as usize);
                pixels.push(match mark.copied().unwrap_or(PixelMark::Same) {
                    PixelMark::Changed => [0xd4, 0x00, 0x1a, 255],
                    PixelMark::Smoothed => [0xe8, 0xb4, 0x00, 255],
                    PixelMark::Beyond => [0xb8, 0xd4, 0xf0, 255],
                    PixelMark::Same if x < ew && y < eh => pale_grey(expected.pixel(x, y)),
                    PixelMark::Same => [255; 4],
                });
            }
        }
        let mut picture = Picture::new(wide, high, pixels);
        if let Some([x, y, w, h]) = self.bounds {
            frame(&mut picture, [x, y, w, h]);
        }
        picture
    }
}

/// Returns the largest difference of a channel between two colours, from 0 to 255. Red, green and blue are multiplied
/// by alpha first, and alpha counts as a channel.
fn visible_difference(a: [u8; 4], b: [u8; 4]) -> u8 {
    if a[3] == 255 && b[3] == 255 {
        return max_channel_difference(a, b);
    }
    let premultiplied = |[r, g, b, alpha]: [u8; 4]| {
        let share = |c: u8| ((u16::from(c) * u16::from(alpha) + 127) / 255) as u8;
        [share(r), share(g), share(b), alpha]
    };
    max_channel_difference(premultiplied(a), premultiplied(b))
}

/// Converts a colour to one of 32 levels of pale grey, by its brightness. With few colours, the PNG is small.
fn pale_grey([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let grey = (299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b)) / 1000;
    let ink = (255 - grey) * u32::from(a) / 255;
    let pale = 255 - (ink / 8 * 8) * 2 / 5;
    [pale as u8, pale as u8, pale as u8, 255]
}

/// Draws a rectangle around a box (x, y, width, height), at a distance of 3 pixels.
fn frame(picture: &mut Picture, [x, y, w, h]: [u32; 4]) {
    const BOX_DISTANCE: u32 = 3;
    const BOX_COLOUR: [u8; 4] = [0xf0, 0x70, 0x80, 255];
    let (left, top) = (x.saturating_sub(BOX_DISTANCE), y.saturating_sub(BOX_DISTANCE));
    let right = (x + w - 1 + BOX_DISTANCE).min(picture.width - 1);
    let bottom = (y + h - 1 + BOX_DISTANCE).min(picture.height - 1);
    let wide = picture.width as usize;
    let changed = [0xd4, 0x00, 0x1a, 255];
    let mut put = |x: u32, y: u32| {
        let pixel = &mut picture.rgba[y as usize * wide + x as usize];
        if *pixel != changed {
            *pixel = BOX_COLOUR;
        }
    };
    for x in left..=right {
        put(x, top);
        put(x, bottom);
    }
    for y in top..=bottom {
        put(left, y);
        put(right, y);
    }
}
