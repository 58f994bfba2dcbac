//! Writes numbers and SVG path data with as few characters as possible, at a precision of 1/100 pixel.
//! `numbered` converts a line of text to the outlines of its letters, at their positions in the picture.

use crate::pictures::drawing::{Outline, PagePoint, Segment};
use crate::text::decimals;

/// Formats a number with at most two decimals (1/100 pixel), without trailing zeros and without −0.
///
/// # Panics
/// Panics if the number is not finite.
pub(super) fn number(value: f64) -> String {
    decimals(value, 2)
}

/// Appends the SVG path data of an outline to `data`.
pub(super) fn steps(data: &mut String, outline: &Outline) {
    let mut pen = Steps { data: std::mem::take(data), ..Steps::default() };
    for segment in &outline.segments {
        match *segment {
            Segment::Move(p) => pen.begin(p),
            Segment::Line(p) => pen.line(p),
            Segment::Curve(a, b, c) => pen.curve('c', &[a, b, c]),
            Segment::Close => pen.close(),
        }
    }
    *data = pen.data;
}

/// Collects path data. Coordinates are relative to the end of the last segment, which takes fewer digits. They are
/// whole hundredths of a pixel, so that rounding errors do not add up.
#[derive(Default)]
pub(super) struct Steps {
    /// The path data so far.
    pub data: String,
    begin: (i64, i64),
    at: (i64, i64),
    letter: char,
}

impl Steps {
    /// Begins a new subpath at the point `to`.
    pub fn begin(&mut self, to: PagePoint) {
        self.at = hundredths(to);
        self.begin = self.at;
        self.put('M', &[self.at.0, self.at.1]);
    }

    /// Adds a straight line from the current point to the point `to`.
    pub fn line(&mut self, to: PagePoint) {
        let to = hundredths(to);
        let (x, y) = (to.0 - self.at.0, to.1 - self.at.1);
        match (x, y) {
            // Also write a line of length 0, because a line with round ends is then drawn as a dot.
            (_, 0) => self.put('h', &[x]),
            (0, _) => self.put('v', &[y]),
            _ => self.put('l', &[x, y]),
        }
        self.at = to;
    }

    /// Adds a Bézier curve. `points` are its control points and its end point. A quadratic curve (letter `q`) has one
    /// control point, and a cubic curve (letter `c`) has two.
    pub fn curve(&mut self, letter: char, points: &[PagePoint]) {
        let from = self.at;
        for (number, point) in points.iter().enumerate() {
            self.at = hundredths(*point);
            let step = [self.at.0 - from.0, self.at.1 - from.1];
            match number {
                0 => self.put(letter, &step),
                _ => self.more(&step),
            }
        }
    }

    /// Closes the subpath with a straight line.
    pub fn close(&mut self) {
        self.put('z', &[]);
        self.at = self.begin;
    }

    fn put(&mut self, letter: char, numbers: &[i64]) {
        // Omit a command letter that is the same as the previous one. Always write `M`: without it, further coordinates
        // would mean a line.
        let stated = letter == self.letter && !matches!(letter, 'M' | 'z');
        if !stated {
            self.data.push(letter);
            self.letter = letter;
        }
        let Some((first, more)) = numbers.split_first() else {
            return;
        };
        if stated {
            self.more(&[*first])
        } else {
            put(&mut self.data, *first)
        }
        self.more(more);
    }

    /// Appends numbers after another number. A space separates them, except before a minus sign.
    fn more(&mut self, numbers: &[i64]) {
        for number in numbers {
            if *number >= 0 {
                self.data.push(' ');
            }
            put(&mut self.data, *number);
        }
    }
}

/// Rounds the coordinates of a point (pixels) to whole hundredths of a pixel.
fn hundredths(point: PagePoint) -> (i64, i64) {
    let whole = |value: f64| {
        assert!(value.is_finite(), "a drawing holds the number {value}; every number of a drawing is finite");
        // `as` saturates, but only for points far outside any page.
        (value * 100.0).round() as i64
    };
    (whole(point.x), whole(point.y))
}

/// Appends a number of hundredths to `data` as a decimal number without trailing zeros. This function is faster than
/// `format!`; a drawing has thousands of numbers.
fn put(data: &mut String, hundredths: i64) {
    let (whole, part) = (hundredths.unsigned_abs() / 100, hundredths.unsigned_abs() % 100);
    if hundredths < 0 {
        data.push('-');
    }
    if whole > 0 || part == 0 {
        let digits = whole.checked_ilog10().unwrap_or(0);
        for place in (0..=digits).rev() {
            data.push(digit(whole / 10_u64.pow(place)));
        }
    }
    if part > 0 {
        data.push('.');
        data.push(digit(part / 10));
        if part % 10 > 0 {
            data.push(digit(part));
        }
    }
}

/// Returns the last decimal digit of a number.
fn digit(number: u64) -> char {
    char::from(b'0' + (number % 10) as u8)
}

/// Returns the number in the id of a line of text (`t1`, `t2` …), and the SVG path data of its letters. Returns `None`
/// if the id has another form.
#[cfg(feature = "png")]
pub(super) fn numbered(text: &resvg::usvg::Text) -> Option<(usize, String)> {
    use resvg::tiny_skia::{PathSegment, Point};
    use resvg::usvg::Node;
    let number = text.id().strip_prefix('t')?.parse().ok()?;
    let mut pen = Steps::default();
    let place = |p: Point| PagePoint::new(f64::from(p.x), f64::from(p.y));
    for node in text.flattened().children() {
        let Node::Path(path) = node else { continue };
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(p) => pen.begin(place(p)),
                PathSegment::LineTo(p) => pen.line(place(p)),
                PathSegment::QuadTo(a, p) => pen.curve('q', &[place(a), place(p)]),
                PathSegment::CubicTo(a, b, p) => pen.curve('c', &[place(a), place(b), place(p)]),
                PathSegment::Close => pen.close(),
            }
        }
    }
    Some((number, pen.data))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(outline: &Outline) -> String {
        let mut data = String::new();
        steps(&mut data, outline);
        data
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (-0.004, "0"),
            (1.5, "1.5"),
            (-2.25, "-2.25"),
            (100.0, "100"),
            (1.0 / 3.0, "0.33"),
        ];
        for (value, expected) in cases {
            assert_eq!(number(value), expected);
        }
        for (hundredths, expected) in [(0, "0"), (-5, "-.05"), (70, ".7"), (-1230, "-12.3"), (4, ".04"), (101, "1.01")]
        {
            let mut text = String::new();
            put(&mut text, hundredths);
            assert_eq!(text, expected);
        }
    }

    #[test]
    fn path_data_follows_the_outline() {
        let p = PagePoint::new;
        let outline = Outline {
            segments: vec![
                Segment::Move(p(10.0, 20.0)),
                Segment::Line(p(15.5, 20.004)),
                Segment::Line(p(15.5, 12.25)),
                Segment::Line(p(14.0, 12.0)),
                Segment::Line(p(13.0, 13.0)),
                Segment::Curve(p(1.0, 2.0), p(3.0, 3.0), p(13.5, 12.96)),
                Segment::Close,
                Segment::Move(p(-0.001, -1.0)),
                Segment::Line(p(-0.001, -1.0)),
            ],
        };
        let expected = "M10 20h5.5v-7.75l-1.5-.25-1 1c-12-11-10-10 .5-.04zM0-1h0";
        assert_eq!(written(&outline), expected);
    }

    #[test]
    fn rounding_errors_do_not_add_up() {
        let outline = Outline::line((0..=3000).map(|i| PagePoint::new(f64::from(i) / 3.0, 0.5)));
        let data = written(&outline);
        let sum: f64 = data.trim_start_matches("M0 .5h").split(' ').map(|n| n.parse::<f64>().expect("a number")).sum();
        assert!((sum - 1000.0).abs() < 1e-6, "{sum}");
    }
}
