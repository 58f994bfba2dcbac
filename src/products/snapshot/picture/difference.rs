//! [`Difference`]: how many pixels differ, by how much, and where.

use super::Picture;
use super::palette::apart;
use super::perception::{differ, smoothed};

/// From when on two pixels differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelTolerance {
    /// So much may each channel differ, of 255. Where something shows through, channels count by how much of them is seen.
    pub channel: u8,
    /// Where given, pixels beyond that are told apart as eyes do: by distances in brightness and colour above this threshold, from
    /// 0 to 1, and not where they only smooth the same edge in another way.
    pub perceptual: Option<f64>,
}

impl Default for PixelTolerance {
    fn default() -> PixelTolerance {
        PixelTolerance {
            channel: 1,
            perceptual: None,
        }
    }
}

/// What a pixel of the difference shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mark {
    Same,
    Smoothed,
    Changed,
    /// Only one of the two pictures reaches so far.
    Beyond,
}

/// How two pictures differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Pixels that differ, where both pictures have pixels.
    pub changed: u64,
    /// Pixels that differ in how an edge is smoothed and are let pass.
    pub smoothed: u64,
    /// Pixels that both pictures have.
    pub of: u64,
    /// The largest difference of a channel among the pixels that differ, of 255.
    pub largest: u8,
    /// Left, top, width and height of the box around the pixels that differ.
    pub bounds: Option<[u32; 4]>,
    /// Width and height of the expected and of the found picture.
    pub sizes: [(u32, u32); 2],
    marks: Vec<Mark>,
}

impl Difference {
    /// Compares a picture with the one that is expected.
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
        let wide = expected.width.max(found.width);
        let high = expected.height.max(found.height);
        let (across, down) = (
            expected.width.min(found.width),
            expected.height.min(found.height),
        );
        let mut difference = Difference {
            changed: 0,
            smoothed: 0,
            of: u64::from(across) * u64::from(down),
            largest: 0,
            bounds: None,
            sizes: [expected, found].map(|p| (p.width, p.height)),
            marks: Vec::new(),
        };
        // The box as left, top, right, bottom.
        let mut seen: Option<[u32; 4]> = None;
        let mut changes: Vec<(u32, u32, Mark)> = Vec::new();
        for y in 0..down {
            let row = |p: &Picture| {
                let begin = y as usize * p.width as usize;
                begin..begin + across as usize
            };
            let (a, b) = (&expected.rgba[row(expected)], &found.rgba[row(found)]);
            if a == b {
                continue;
            }
            for (x, (a, b)) in (0..across).zip(a.iter().zip(b)) {
                if a == b {
                    continue;
                }
                let allowed = tolerance
                    .channel
                    .saturating_add(expected.rounded(*a).max(found.rounded(*b)));
                let by = visible(*a, *b);
                if by <= allowed {
                    continue;
                }
                let mut mark = Mark::Changed;
                if let Some(threshold) = tolerance.perceptual {
                    if !differ(*a, *b, threshold) {
                        continue;
                    }
                    let same_size = difference.sizes[0] == difference.sizes[1];
                    if same_size
                        && (smoothed(expected, found, x, y) || smoothed(found, expected, x, y))
                    {
                        mark = Mark::Smoothed;
                    }
                }
                changes.push((x, y, mark));
                if mark == Mark::Smoothed {
                    difference.smoothed += 1;
                    continue;
                }
                difference.changed += 1;
                difference.largest = difference.largest.max(by);
                seen = Some(match seen {
                    None => [x, y, x, y],
                    Some([l, t, r, d]) => [l.min(x), t.min(y), r.max(x), d.max(y)],
                });
            }
        }
        difference.bounds = seen.map(|[l, t, r, d]| [l, t, r - l + 1, d - t + 1]);
        if !difference.is_none() {
            difference.marks = vec![Mark::Beyond; wide as usize * high as usize];
            let place = |x: u32, y: u32| y as usize * wide as usize + x as usize;
            for y in 0..down {
                difference.marks[place(0, y)..place(0, y) + across as usize].fill(Mark::Same);
            }
            for (x, y, mark) in changes {
                difference.marks[place(x, y)] = mark;
            }
        }
        difference
    }

    /// Whether there is none worth telling.
    pub fn is_none(&self) -> bool {
        self.changed == 0 && self.sizes[0] == self.sizes[1]
    }

    /// The difference in a sentence.
    pub fn words(&self) -> String {
        let [(ew, eh), (fw, fh)] = self.sizes;
        let mut words = Vec::new();
        if (ew, eh) != (fw, fh) {
            words.push(format!("{ew} × {eh} pixels expected, {fw} × {fh} found"));
        }
        if let Some([x, y, w, h]) = self.bounds {
            let smoothed = match self.smoothed {
                0 => String::new(),
                n => format!("; {n} more only smooth an edge in another way"),
            };
            words.push(format!(
                "{} of {} pixels differ, by up to {} of 255, within {w} × {h} pixels from ({x}, {y}){smoothed}",
                self.changed, self.of, self.largest
            ));
        }
        words.join("; ")
    }

    /// The expected picture faded, what differs in red within its box, smoothing that is let pass in yellow, and what only one of
    /// the pictures has in blue.
    pub fn image(&self, expected: &Picture) -> Picture {
        let [(ew, eh), (fw, fh)] = self.sizes;
        let (wide, high) = (ew.max(fw), eh.max(fh));
        let mut pixels = Vec::with_capacity(self.marks.len());
        for y in 0..high {
            for x in 0..wide {
                let mark = self.marks.get(y as usize * wide as usize + x as usize);
                pixels.push(match mark.copied().unwrap_or(Mark::Same) {
                    Mark::Changed => [0xd4, 0x00, 0x1a, 255],
                    Mark::Smoothed => [0xe8, 0xb4, 0x00, 255],
                    Mark::Beyond => [0xb8, 0xd4, 0xf0, 255],
                    Mark::Same if x < ew && y < eh => faded(expected.pixel(x, y)),
                    Mark::Same => [255; 4],
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

/// The largest difference of a channel as it is seen: each channel by its share of alpha, and alpha itself.
fn visible(a: [u8; 4], b: [u8; 4]) -> u8 {
    if a[3] == 255 && b[3] == 255 {
        return apart(a, b);
    }
    let premultiplied = |[r, g, b, alpha]: [u8; 4]| {
        let share = |c: u8| ((u16::from(c) * u16::from(alpha) + 127) / 255) as u8;
        [share(r), share(g), share(b), alpha]
    };
    apart(premultiplied(a), premultiplied(b))
}

/// A pale grey as dark as the colour is, in 32 steps.
fn faded([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let grey = (299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b)) / 1000;
    let ink = (255 - grey) * u32::from(a) / 255;
    let pale = 255 - (ink / 8 * 8) * 2 / 5;
    [pale as u8, pale as u8, pale as u8, 255]
}

/// A line around a box, three pixels off.
fn frame(picture: &mut Picture, [x, y, w, h]: [u32; 4]) {
    const OFF: u32 = 3;
    const LINE: [u8; 4] = [0xf0, 0x70, 0x80, 255];
    let (left, top) = (x.saturating_sub(OFF), y.saturating_sub(OFF));
    let right = (x + w - 1 + OFF).min(picture.width - 1);
    let bottom = (y + h - 1 + OFF).min(picture.height - 1);
    let wide = picture.width as usize;
    let changed = [0xd4, 0x00, 0x1a, 255];
    let mut put = |x: u32, y: u32| {
        let pixel = &mut picture.rgba[y as usize * wide + x as usize];
        if *pixel != changed {
            *pixel = LINE;
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
