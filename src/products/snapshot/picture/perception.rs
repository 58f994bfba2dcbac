//! Decides whether two colours look different, and whether a pixel is part of an antialiased edge.
//!
//! Colour distance: Kotsarenko and Ramos (2010), in the YIQ colour space. Antialiasing: Vyšniauskas (2009). A pixel
//! is antialiased if it has a darker and a brighter neighbour, and one of these lies in an area of one colour in both
//! pictures. The tool pixelmatch uses the same two rules, and a test compares the numbers of differing pixels.

use super::Picture;

/// The largest squared colour distance: that between black and white.
const MAX_DISTANCE: f64 = 35_215.0;

/// Blends a colour with a white background. Channels range from 0 to 255.
fn on_white([r, g, b, a]: [u8; 4]) -> [f64; 3] {
    let share = f64::from(a) / 255.0;
    [r, g, b].map(|c| 255.0 + (f64::from(c) - 255.0) * share)
}

/// Returns the brightness of a colour: the channel Y of YIQ.
fn brightness([r, g, b]: [f64; 3]) -> f64 {
    0.298_895_31 * r + 0.586_622_47 * g + 0.114_482_23 * b
}

/// True if the distance of two colours exceeds a threshold, so that they look different. The threshold ranges from 0
/// (any difference counts) to 1 (the distance between black and white).
pub(super) fn differ(a: [u8; 4], b: [u8; 4], threshold: f64) -> bool {
    distance(a, b) > MAX_DISTANCE * threshold * threshold
}

/// Returns the squared colour distance in the YIQ colour space, from 0 to [`MAX_DISTANCE`].
fn distance(a: [u8; 4], b: [u8; 4]) -> f64 {
    if a == b {
        return 0.0;
    }
    let (a, b) = (on_white(a), on_white(b));
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let y = brightness(d);
    let i = 0.595_977_99 * d[0] - 0.274_176_1 * d[1] - 0.321_801_89 * d[2];
    let q = 0.211_470_17 * d[0] - 0.522_617_11 * d[1] + 0.311_146_94 * d[2];
    0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q
}

/// Returns the neighbours of a pixel, at most eight. The second value is true if the pixel lies at the border of the
/// picture.
fn neighbours(picture: &Picture, x: u32, y: u32) -> (impl Iterator<Item = (u32, u32)>, bool) {
    let (left, top) = (x.saturating_sub(1), y.saturating_sub(1));
    let (right, bottom) = ((x + 1).min(picture.width - 1), (y + 1).min(picture.height - 1));
    let edge = x == left || x == right || y == top || y == bottom;
    let all = (left..=right).flat_map(move |i| (top..=bottom).map(move |j| (i, j)));
    (all.filter(move |place| *place != (x, y)), edge)
}

/// True if a pixel of `picture` is part of an antialiased edge that `other` also has.
pub(super) fn is_antialiased(picture: &Picture, other: &Picture, x: u32, y: u32) -> bool {
    // Find the darkest and the brightest neighbour. A pixel with more than two neighbours of its own brightness lies
    // inside an area and not at an edge.
    let own = brightness(on_white(picture.pixel(x, y)));
    let (around, edge) = neighbours(picture, x, y);
    let mut equal = usize::from(edge);
    let (mut brightest, mut darkest) = ((0.0, (x, y)), (0.0, (x, y)));
    for (i, j) in around {
        let delta = if picture.pixel(i, j) == picture.pixel(x, y) {
            0.0
        } else {
            own - brightness(on_white(picture.pixel(i, j)))
        };
        if delta == 0.0 {
            equal += 1;
            if equal > 2 {
                return false;
            }
        } else if delta < brightest.0 {
            brightest = (delta, (i, j));
        } else if delta > darkest.0 {
            darkest = (delta, (i, j));
        }
    }
    let is_flat = |(i, j): (u32, u32)| is_flat(picture, i, j) && is_flat(other, i, j);
    brightest.0 < 0.0 && darkest.0 > 0.0 && (is_flat(brightest.1) || is_flat(darkest.1))
}

/// True if more than two neighbours of a pixel have the same colour as the pixel. The border of the picture counts as
/// one neighbour.
fn is_flat(picture: &Picture, x: u32, y: u32) -> bool {
    let (around, edge) = neighbours(picture, x, y);
    let own = picture.pixel(x, y);
    let same = around.filter(|(i, j)| picture.pixel(*i, *j) == own);
    same.count() + usize::from(edge) > 2
}
