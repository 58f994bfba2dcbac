//! Whether a difference of two pixels would be seen, and whether it is only another smoothing of the same edge.
//!
//! Distances are those of Kotsarenko and Ramos (2010), in brightness and two axes of colour; smoothed edges are found by the
//! neighbours as Vyšniauskas (2009) does: a pixel between a darker and a brighter neighbour, one of which lies in an even
//! area in both pictures. The same two rules make up pixelmatch, whose counts a test repeats.

use super::Picture;

/// The largest distance there is, between black and white.
const LARGEST: f64 = 35_215.0;

/// A colour on white, its transparency gone.
fn on_white([r, g, b, a]: [u8; 4]) -> [f64; 3] {
    let share = f64::from(a) / 255.0;
    [r, g, b].map(|c| 255.0 + (f64::from(c) - 255.0) * share)
}

fn brightness([r, g, b]: [f64; 3]) -> f64 {
    0.298_895_31 * r + 0.586_622_47 * g + 0.114_482_23 * b
}

/// Whether two colours look different, by a threshold from 0 (any) to 1 (black from white).
pub(super) fn differ(a: [u8; 4], b: [u8; 4], threshold: f64) -> bool {
    distance(a, b) > LARGEST * threshold * threshold
}

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

/// The neighbours of a pixel, and whether it lies at the edge of its picture.
fn neighbours(picture: &Picture, x: u32, y: u32) -> (impl Iterator<Item = (u32, u32)>, bool) {
    let (left, top) = (x.saturating_sub(1), y.saturating_sub(1));
    let (right, bottom) = (
        (x + 1).min(picture.width - 1),
        (y + 1).min(picture.height - 1),
    );
    let edge = x == left || x == right || y == top || y == bottom;
    let all = (left..=right).flat_map(move |i| (top..=bottom).map(move |j| (i, j)));
    (all.filter(move |place| *place != (x, y)), edge)
}

/// Whether a pixel of `picture` is part of a smoothed edge that `other` has too.
pub(super) fn smoothed(picture: &Picture, other: &Picture, x: u32, y: u32) -> bool {
    let own = brightness(on_white(picture.pixel(x, y)));
    let (around, edge) = neighbours(picture, x, y);
    let mut equal = usize::from(edge);
    let (mut darkest, mut brightest) = ((0.0, (x, y)), (0.0, (x, y)));
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
        } else if delta < darkest.0 {
            darkest = (delta, (i, j));
        } else if delta > brightest.0 {
            brightest = (delta, (i, j));
        }
    }
    let even = |(i, j): (u32, u32)| even(picture, i, j) && even(other, i, j);
    darkest.0 < 0.0 && brightest.0 > 0.0 && (even(darkest.1) || even(brightest.1))
}

/// Whether more than two neighbours of a pixel have its colour.
fn even(picture: &Picture, x: u32, y: u32) -> bool {
    let (around, edge) = neighbours(picture, x, y);
    let own = picture.pixel(x, y);
    let same = around.filter(|(i, j)| picture.pixel(*i, *j) == own);
    same.count() + usize::from(edge) > 2
}
