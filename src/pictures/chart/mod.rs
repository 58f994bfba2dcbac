//! Draws charts as SVG. [`scatter`] draws points on two logarithmic axes, and [`growth`] draws lines on such axes.
//! [`bars`] draws a histogram, and [`course`] draws values over the steps of a scene.
//!
//! Only `plot` uses plotters. plotters rounds to whole pixels, and its labels can overlap. Therefore the picture is
//! drawn ten times as large. Then the width and height of the SVG, but not its view box, are divided by ten. A
//! logarithmic axis shorter than a decade would have no labels. Logarithmic axes therefore cover at least two whole
//! decades, except the horizontal axis of [`growth`]. Text is measured with the built-in font, so the fonts of the
//! machine do not change a picture.

mod plot;

use std::fmt;

/// Width and height of scatter and growth charts, pixels.
const LARGE_SIZE: (i32, i32) = (900, 620);
/// Width and height of histograms and course charts, pixels.
const SMALL_SIZE: (i32, i32) = (420, 250);

/// The colour of axes and text. A page that contains the chart can replace this colour by another one.
pub const INK: &str = "#2D2D32";
/// The colour of grid lines.
pub const GRID: &str = "#E1E1E4";

/// A series of points of one colour, joined by a line in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The name in the legend.
    pub name: String,
    /// Red, green, blue.
    pub colour: [u8; 3],
    /// The points.
    pub points: Vec<Point>,
}

/// A point of a chart. Both coordinates are above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The value on the horizontal axis.
    pub x: f64,
    /// The value on the vertical axis.
    pub y: f64,
    /// Whether a cross marks the point as wrong.
    pub wrong: bool,
}

/// A scatter plot on two logarithmic axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// The title above the picture.
    pub title: String,
    /// The name of the horizontal axis.
    pub x: String,
    /// The name of the vertical axis.
    pub y: String,
    /// The points, as one or more series.
    pub series: Vec<Series>,
    /// The meaning of the crosses, for the legend.
    pub wrong: String,
    /// The Pareto front: its name in the legend, and its points by ascending x. It is drawn as a step line.
    pub front: (String, Vec<(f64, f64)>),
}

/// The error for a chart that could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("the chart could not be drawn: {0}")]
pub struct ChartError(String);

impl ChartError {
    fn new(error: impl fmt::Display) -> ChartError {
        ChartError(error.to_string())
    }
}

/// Formats the power of ten with this exponent, for example `10⁻³` for −3.
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

/// Draws points on two logarithmic axes and returns the chart as an SVG document.
///
/// # Errors
/// Returns [`ChartError`] if the plotters library reports an error. It reports none for finite, positive coordinates.
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
    plot::document(LARGE_SIZE, &chart.title, |svg| plot::scatter(chart, svg))
}

/// Lines on two logarithmic axes, with the name of each line at its right end.
///
/// Lines have no colours of their own: important lines are dark and thick, and all others are thin and grey.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// The title above the picture.
    pub title: String,
    /// The name of the horizontal axis.
    pub x: String,
    /// The name of the vertical axis.
    pub y: String,
    /// The lines.
    pub lines: Vec<GrowthLine>,
    /// The meaning of the crosses that replace the dots of wrong points.
    pub wrong: String,
}

/// A line of a growth chart.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthLine {
    /// The name, which is written at the right end of the line.
    pub name: String,
    /// Whether the line is important, and therefore dark and thick.
    pub is_highlighted: bool,
    /// The points of the line, by ascending x.
    pub points: Vec<Point>,
}

/// Draws lines on two logarithmic axes and returns the chart as an SVG document.
///
/// # Errors
/// Returns [`ChartError`] if there are no lines, if a line has no points, or if the plotters library reports an
/// error. The library reports none for finite, positive coordinates.
pub fn growth(chart: &Growth) -> Result<String, ChartError> {
    if chart.lines.iter().any(|line| line.points.is_empty()) || chart.lines.is_empty() {
        return Err(ChartError::new("there is nothing to draw"));
    }
    plot::document(LARGE_SIZE, &chart.title, |svg| plot::growth(chart, svg))
}

/// A histogram: a bar for each interval between two edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// A description for screen readers; no title is drawn.
    pub title: String,
    /// The name of the horizontal axis.
    pub x: String,
    /// The name of the vertical axis.
    pub y: String,
    /// The edges of the bars in ascending order. There is one more edge than there are bars.
    pub edges: Vec<f64>,
    /// The number of values between two consecutive edges.
    pub counts: Vec<usize>,
    /// Red, green, blue.
    pub colour: [u8; 3],
}

impl Bars {
    /// Creates a histogram of the values, with five to ten bars of equal width. The edges of the bars are round numbers
    /// from 0 to at least `most`, or to at least the largest value if `most` is `None`. There are no bars if this limit
    /// is not positive and finite. A value on the edge between two bars is counted in the bar to its right. The last
    /// bar also counts all larger values.
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

/// Draws a histogram and returns it as an SVG document.
///
/// # Errors
/// Returns [`ChartError`] if there are no bars, if the number of edges is not one more than the number of bars, or if
/// the plotters library reports an error.
pub fn bars(chart: &Bars) -> Result<String, ChartError> {
    if chart.counts.is_empty() || chart.edges.len() != chart.counts.len() + 1 {
        return Err(ChartError::new("there is nothing to count"));
    }
    plot::document(SMALL_SIZE, &chart.title, |svg| plot::bars(chart, svg))
}

/// The values of one quantity, or of several quantities of one unit, at each step of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// A description for screen readers; no title is drawn.
    pub title: String,
    /// The name of the vertical axis.
    pub y: String,
    /// The short names of the steps.
    pub steps: Vec<String>,
    /// The quantities. Each has a name, which is written at the end of its line, a colour, and a value at each step;
    /// `None` if there is no value at this step.
    pub lines: Vec<(String, [u8; 3], Vec<Option<f64>>)>,
}

/// Draws values over the steps of a scene and returns the chart as an SVG document.
///
/// # Errors
/// Returns [`ChartError`] if there are no steps or no values, if a value is not finite, or if the plotters library
/// reports an error.
pub fn course(chart: &Course) -> Result<String, ChartError> {
    let values = chart.lines.iter().flat_map(|l| l.2.iter().flatten());
    if chart.steps.is_empty() || !values.clone().all(|v| v.is_finite()) || values.count() == 0 {
        return Err(ChartError::new("there is nothing to draw"));
    }
    plot::document(SMALL_SIZE, &chart.title, |svg| plot::course(chart, svg))
}

/// Returns the smallest number of the form 1·10ⁿ, 2·10ⁿ or 5·10ⁿ, with an integer n, that is at least `value`. `value`
/// must be positive.
pub(crate) fn round_step(value: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(value)));
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|s| s * power >= value * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::drawing::Face;

    #[test]
    fn every_value_is_counted_once_between_round_edges() {
        let values: Vec<f64> = (0..137).map(|i| 0.31 * f64::from(i)).collect();
        let bars = Bars::counted(&values, None);
        assert_eq!(bars.counts.iter().sum::<usize>(), 137);
        assert_eq!(bars.edges.last(), Some(&45.0));
        assert_eq!(Bars::counted(&[0.0], None).counts, Vec::<usize>::new());
        assert_eq!(Bars::counted(&[1.0, 0.05], Some(1.0)).counts, [1, 0, 0, 0, 0, 0, 0, 0, 0, 1]);
        assert!(super::bars(&Bars::counted(&[], None)).is_err());
    }

    #[test]
    fn bar_charts_and_line_charts_are_small_files_with_labels() {
        let mut chart = Bars::counted(&[1.0, 2.0, 2.5], None);
        (chart.title, chart.x, chart.y) = ("t<".into(), "force, N".into(), "count".into());
        let svg = super::bars(&chart).expect("drawn");
        assert!(svg.contains("force, N") && svg.contains("t&lt;") && svg.len() < 9000, "{}", svg.len());
        let course = super::course(&Course {
            title: "over the steps".into(),
            y: "N".into(),
            steps: vec!["a".into(), "b".into(), "c".into()],
            lines: vec![
                ("sum".into(), [0, 0, 200], vec![Some(3.0), None, Some(5.0)]),
                ("missing".into(), [200, 0, 0], vec![None, Some(1.0), Some(2.0)]),
            ],
        });
        assert!(course.is_ok_and(|svg| svg.contains("sum") && svg.contains("missing")));
    }

    #[test]
    fn axes_begin_and_end_at_powers_of_ten() {
        assert_eq!(plot::decades([2.0, 3.0].into_iter()), (0, 2));
        assert_eq!(plot::decades([1e-16, 0.5].into_iter()), (-17, 0));
        assert_eq!(plot::decades(std::iter::empty()), (-1, 1));
        assert_eq!(power_of_ten(-16), "10⁻¹⁶");
        assert_eq!(power_of_ten(3), "10³");
    }

    #[test]
    fn the_built_in_font_has_every_character_of_the_axes() {
        for exponent in -19..20 {
            for c in power_of_ten(exponent).chars() {
                assert!(Face::Sans.has(c), "{c}");
            }
        }
    }
}
