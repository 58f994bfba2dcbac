//! Perceptual comparison: its counts equal those of pixelmatch, and differences in smoothing can be ignored.

use drystone::snapshot::picture::{Difference, Picture, PixelTolerance};

/// The centre and the radius of the second disc, the threshold, the number of differing pixels, and the number of
/// pixels that differ only in their smoothing.
type Count = ([f64; 3], f64, u64, u64);

const PIXELMATCH: &[Count] = &[
    ([31.9, 30.2, 17.3], 0.1, 0, 41),
    ([31.9, 30.2, 17.3], 0.02, 0, 105),
    ([32.7, 30.2, 17.3], 0.1, 0, 136),
    ([31.7, 30.2, 18.1], 0.1, 0, 167),
    ([31.7, 30.2, 18.1], 0.3, 0, 99),
    ([29.0, 33.0, 17.3], 0.1, 162, 169),
    ([31.7, 30.2, 40.0], 0.1, 2953, 130),
    ([5.0, 5.0, 9.0], 0.05, 1044, 124),
];

/// A smoothed disc in 64 × 64 pixels, row by row. The arithmetic is the same on all platforms.
fn disc(x: f64, y: f64, radius: f64) -> Picture {
    let pixel = |i: usize| {
        let (px, py) = ((i % 64) as f64 + 0.5 - x, (i / 64) as f64 + 0.5 - y);
        let inside = (radius + 0.5 - (px * px + py * py).sqrt()).clamp(0.0, 1.0);
        let mix = |from: f64, to: f64| (from + (to - from) * inside).round() as u8;
        [mix(250.0, 30.0), mix(240.0, 90.0), mix(230.0, 160.0), 255]
    };
    Picture::new(64, 64, (0..64 * 64).map(pixel).collect())
}

fn perceptual(threshold: f64) -> PixelTolerance {
    PixelTolerance { channel: 0, perceptual: Some(threshold) }
}

/// The second disc is moved or larger. The expected counts are those of pixelmatch 7 at the same threshold.
#[test]
fn counts_are_those_of_pixelmatch() {
    let base = disc(31.7, 30.2, 17.3);
    for (other, threshold, changed, smoothed) in PIXELMATCH {
        let [x, y, r] = *other;
        let found = Difference::new(&base, &disc(x, y, r), perceptual(*threshold));
        assert_eq!((found.changed, found.smoothed), (*changed, *smoothed), "{other:?} at {threshold}");
    }
}

#[test]
fn another_smoothing_of_the_same_edge_is_ignored_only_on_request() {
    let (one, other) = (disc(32.0, 32.0, 16.0), disc(32.2, 32.1, 16.0));
    let strict = Difference::new(&one, &other, PixelTolerance::default());
    assert!(strict.changed > 80, "{}", strict.words());
    let lenient = Difference::new(&one, &other, perceptual(0.1));
    assert!(lenient.is_none() && lenient.smoothed > 0, "{}", lenient.words());
    let moved = Difference::new(&one, &disc(35.0, 32.0, 16.0), perceptual(0.1));
    assert!(moved.changed > 50, "{}", moved.words());
}
