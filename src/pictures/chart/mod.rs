//! Charts as SVG: [`scatter`] draws points on two logarithmic axes; [`growth`] draws lines on two logarithmic axes;
//! [`bars`] draws a histogram; [`course`] draws values over the steps of a scene.
//!
//! The one door to plotters is `plot`. plotters counts in whole pixels and lets labels collide; so the picture is drawn at ten times its size and the SVG's
//! width and height are rewritten over the same view box. Logarithmic axes shorter than a decade lose their labels, so
//! they are rounded outward to whole decades and at least two long. Words are set in our own font, registered under the
//! name that the SVG then carries, so that no machine's fonts reach a picture.

mod plot;

use std::fmt;

/// Width and height of a scatter.
const SIZE: (i32, i32) = (900, 620);
/// Width and height of bars and courses.
const SMALL: (i32, i32) = (420, 250);

/// The colour of axes and words, so that a page can give them its own.
pub const INK: &str = "#2D2D32";
/// The colour of the lines behind.
pub const GRID: &str = "#E1E1E4";

/// Points that belong together, in the order of their line.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What the legend says.
    pub name: String,
    /// Red, green, blue.
    pub colour: [u8; 3],
    /// The points.
    pub points: Vec<Point>,
}

/// One point; both coordinates above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Along.
    pub x: f64,
    /// Up.
    pub y: f64,
    /// Whether it is struck out by a large red cross.
    pub wrong: bool,
}

/// A scatter on two logarithmic axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// Above the picture.
    pub title: String,
    /// Below.
    pub x: String,
    /// Beside.
    pub y: String,
    /// The points.
    pub series: Vec<Series>,
    /// What the crosses mean.
    pub wrong: String,
    /// A stair of points that no other is better than, by rising x, and what the legend calls it.
    pub front: (String, Vec<(f64, f64)>),
}

/// A picture that plotters could not draw.
#[derive(Debug, thiserror::Error)]
#[error("the chart could not be drawn: {0}")]
pub struct ChartError(String);

impl ChartError {
    fn new(error: impl fmt::Display) -> ChartError {
        ChartError(error.to_string())
    }
}

/// The power of ten as text: `10⁻³`.
pub fn power_of_ten(exponent: i32) -> String {
    let plain = exponent.to_string();
    let digits = plain.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => char::from_u32(0x2070 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
    });
    format!("10{}", digits.collect::<String>())
}

/// Draws a scatter chart as an SVG document.
///
/// # Errors
/// Where plotters refuses, which no finite and positive points make it do.
///
/// # Example
/// ```
/// use drystone::internals::chart::{Point, Scatter, Series, scatter};
/// let point = |x, y| Point { x, y, wrong: false };
/// let svg = scatter(&Scatter {
///     title: "Time and error".into(),
///     x: "time".into(),
///     y: "error".into(),
///     series: vec![Series { name: "ours".into(), colour: [0, 90, 160], points: vec![point(2.0, 1e-9), point(3.0, 1e-12)] }],
///     wrong: "wrong".into(),
///     front: (String::new(), Vec::new()),
/// })?;
/// assert!(svg.starts_with("<svg") && svg.contains("10⁻⁹") && svg.contains("ours"));
/// # Ok::<(), drystone::internals::chart::ChartError>(())
/// ```
pub fn scatter(chart: &Scatter) -> Result<String, ChartError> {
    plot::document(SIZE, &chart.title, |svg| plot::scatter(chart, svg))
}

/// What grows with a size, on two logarithmic axes, each named beside its end.
///
/// Lines are told apart by their names and not by colours; those that matter are dark and thick.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Above the picture.
    pub title: String,
    /// Below.
    pub x: String,
    /// Beside.
    pub y: String,
    /// What grows.
    pub lines: Vec<Growing>,
    /// What crosses in place of dots mean.
    pub wrong: String,
}

/// One thing that grows.
#[derive(Clone, Debug, PartialEq)]
pub struct Growing {
    /// Its name.
    pub name: String,
    /// Whether it is one of those that matter.
    pub ours: bool,
    /// By rising size.
    pub points: Vec<Point>,
}

/// Draws a growth chart as an SVG document.
///
/// # Errors
/// Where plotters refuses, which no finite and positive points make it do; and for no points.
pub fn growth(chart: &Growth) -> Result<String, ChartError> {
    if chart.lines.iter().any(|line| line.points.is_empty()) || chart.lines.is_empty() {
        return Err(ChartError::new("there is nothing to draw"));
    }
    plot::document(SIZE, &chart.title, |svg| plot::growth(chart, svg))
}

/// How often what occurs: a bar for every stretch between two edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// What it shows, read aloud; the picture itself has no title.
    pub title: String,
    /// Below.
    pub x: String,
    /// Beside.
    pub y: String,
    /// The edges of the bars, rising, one more than there are bars.
    pub edges: Vec<f64>,
    /// How many lie between each two edges.
    pub counts: Vec<usize>,
    /// Red, green, blue.
    pub colour: [u8; 3],
}

impl Bars {
    /// Sorts values into about ten bars with round limits, beginning at 0. There are no bars if no value is above 0. A
    /// value on the limit of two bars belongs to the higher bar; the largest limit belongs to the last bar.
    ///
    /// ```
    /// use drystone::internals::chart::Bars;
    /// let bars = Bars::counted(&[0.5, 1.0, 7.0, 9.9], None);
    /// assert_eq!((bars.edges[1], bars.counts[0], bars.counts[1], bars.counts[9]), (1.0, 1, 1, 1));
    /// ```
    pub fn counted(values: &[f64], most: Option<f64>) -> Bars {
        let largest = most.unwrap_or_else(|| values.iter().copied().fold(0.0, f64::max));
        let mut bars = Bars {
            title: String::new(),
            x: String::new(),
            y: String::new(),
            edges: Vec::new(),
            counts: Vec::new(),
            colour: [68, 121, 180],
        };
        if !(largest > 0.0 && largest.is_finite()) {
            return bars;
        }
        let step = round_step(largest / 10.0);
        let count = (libm::ceil(largest / step - 1e-9) as usize).max(1);
        bars.edges = (0..=count).map(|i| i as f64 * step).collect();
        bars.counts = vec![0; count];
        for value in values {
            let bar = (libm::floor(value / step + 1e-9).max(0.0) as usize).min(count - 1);
            bars.counts[bar] += 1;
        }
        bars
    }
}

/// Draws a histogram as an SVG document.
///
/// # Errors
/// Where plotters refuses, or there are no bars.
pub fn bars(chart: &Bars) -> Result<String, ChartError> {
    if chart.counts.is_empty() || chart.edges.len() != chart.counts.len() + 1 {
        return Err(ChartError::new("there is nothing to count"));
    }
    plot::document(SMALL, &chart.title, |svg| plot::bars(chart, svg))
}

/// One quantity, or several of one unit, from step to step.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// What it shows, read aloud; the picture itself has no title.
    pub title: String,
    /// Beside.
    pub y: String,
    /// The names of the steps, short.
    pub steps: Vec<String>,
    /// The quantities, each with a name written at its end, a value for every step, none where there is none.
    pub lines: Vec<(String, [u8; 3], Vec<Option<f64>>)>,
}

/// Draws a course chart as an SVG document.
///
/// # Errors
/// Where plotters refuses, or there is nothing to draw.
pub fn course(chart: &Course) -> Result<String, ChartError> {
    let values = chart.lines.iter().flat_map(|l| l.2.iter().flatten());
    if chart.steps.is_empty() || !values.clone().all(|v| v.is_finite()) || values.count() == 0 {
        return Err(ChartError::new("there is nothing to draw"));
    }
    plot::document(SMALL, &chart.title, |svg| plot::course(chart, svg))
}

/// The smallest of 1, 2 and 5 times a power of ten that is at least `value`.
pub(crate) fn round_step(value: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(value)));
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|s| s * power >= value * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Face;

    #[test]
    fn every_value_is_counted_once_between_round_edges() {
        let values: Vec<f64> = (0..137).map(|i| 0.31 * f64::from(i)).collect();
        let bars = Bars::counted(&values, None);
        assert_eq!(bars.counts.iter().sum::<usize>(), 137);
        assert_eq!(bars.edges.last(), Some(&45.0));
        assert_eq!(Bars::counted(&[0.0], None).counts, Vec::<usize>::new());
        assert_eq!(
            Bars::counted(&[1.0, 0.05], Some(1.0)).counts,
            [1, 0, 0, 0, 0, 0, 0, 0, 0, 1]
        );
        assert!(super::bars(&Bars::counted(&[], None)).is_err());
    }

    #[test]
    fn bars_and_courses_are_small_and_name_what_they_show() {
        let mut chart = Bars::counted(&[1.0, 2.0, 2.5], None);
        (chart.title, chart.x, chart.y) = ("t<".into(), "force, N".into(), "count".into());
        let svg = super::bars(&chart).expect("drawn");
        assert!(
            svg.contains("force, N") && svg.contains("t&lt;") && svg.len() < 9000,
            "{}",
            svg.len()
        );
        let course = super::course(&Course {
            title: "over the steps".into(),
            y: "N".into(),
            steps: vec!["a".into(), "b".into(), "c".into()],
            lines: vec![
                ("sum".into(), [0, 0, 200], vec![Some(3.0), None, Some(5.0)]),
                (
                    "missing".into(),
                    [200, 0, 0],
                    vec![None, Some(1.0), Some(2.0)],
                ),
            ],
        });
        assert!(course.is_ok_and(|svg| svg.contains("sum") && svg.contains("missing")));
    }

    #[test]
    fn axes_run_over_whole_decades() {
        assert_eq!(plot::decades([2.0, 3.0].into_iter()), (0, 2));
        assert_eq!(plot::decades([1e-16, 0.5].into_iter()), (-17, 0));
        assert_eq!(plot::decades(std::iter::empty()), (-1, 1));
        assert_eq!(power_of_ten(-16), "10⁻¹⁶");
        assert_eq!(power_of_ten(3), "10³");
    }

    #[test]
    fn our_font_has_every_character_of_the_axes() {
        for exponent in -19..20 {
            for c in power_of_ten(exponent).chars() {
                assert!(Face::Sans.has(c), "{c}");
            }
        }
    }
}
