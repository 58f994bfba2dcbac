//! Draws charts as SVG with the crate plotters. [`scatter`] draws points on two logarithmic axes, and [`bars`] draws a
//! histogram.
//!
//! plotters rounds to whole pixels, and its labels can overlap. Therefore the picture is drawn ten times as large. Then
//! the width and height of the SVG, but not its view box, are divided by ten. A logarithmic axis shorter than a decade
//! would have no labels, so logarithmic axes cover at least two whole decades. Text is measured with the built-in font,
//! so the fonts of the machine do not change a picture.

use std::fmt;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, RGBColor, TextStyle, register_font};

use crate::pictures::drawing::Face;
use crate::text::xml;

/// Width and height of scatter charts, pixels.
const LARGE_SIZE: (i32, i32) = (900, 620);
/// Width and height of histograms, pixels.
const SMALL_SIZE: (i32, i32) = (420, 250);

/// The colour of axes and text. A page that contains the chart can replace this colour by another one.
pub const INK: &str = "#2D2D32";
/// The colour of grid lines.
pub const GRID: &str = "#E1E1E4";
const INK_RGB: RGBColor = RGBColor(45, 45, 50);
const GRID_RGB: RGBColor = RGBColor(225, 225, 228);

/// Number of units of the drawn picture per pixel of the page.
pub const UNITS_PER_PIXEL: i32 = 10;
/// The family name that plotters writes for all text. The built-in font is registered under this name.
const FONT_FAMILY: &str = "sans-serif";

/// The page on which plotters draws.
pub type Page<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The result of drawing: the error of plotters if it fails.
pub type DrawingResult = Result<(), Box<dyn std::error::Error>>;

/// The error for a chart that could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("the chart could not be drawn: {0}")]
pub struct ChartError(String);

impl ChartError {
    fn new(error: impl fmt::Display) -> ChartError {
        ChartError(error.to_string())
    }
}

/// Returns the SVG document that `draw` draws, scaled to this width and height in pixels. `draw` must draw the picture
/// [`UNITS_PER_PIXEL`] times as large. `title` is for screen readers.
///
/// # Errors
/// Returns [`ChartError`] if the plotters library reports an error.
pub fn document(
    (width, height): (i32, i32),
    title: &str,
    draw: impl FnOnce(&Page<'_>) -> DrawingResult,
) -> Result<String, ChartError> {
    static FONTS: Once = Once::new();
    FONTS.call_once(|| {
        // Ignore an error here: registration fails only if the font cannot be read, and then drawing fails too.
        let _ = register_font(FONT_FAMILY, FontStyle::Normal, Face::Sans.data());
        let _ = register_font(FONT_FAMILY, FontStyle::Bold, Face::SansBold.data());
    });
    let (w, h) = (width * UNITS_PER_PIXEL, height * UNITS_PER_PIXEL);
    let mut svg = String::new();
    let area = SVGBackend::with_string(&mut svg, (w as u32, h as u32)).into_drawing_area();
    draw(&area).map_err(ChartError::new)?;
    area.present().map_err(ChartError::new)?;
    drop(area);
    let head = format!("width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\"");
    if !svg.contains(&head) {
        return Err(ChartError::new("the SVG of plotters does not begin with the expected attributes"));
    }
    let page = format!(
        "width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{}\"",
        xml(title)
    );
    Ok(svg.replacen(&head, &page, 1).replace(
        &format!("font-family=\"{FONT_FAMILY}\""),
        "font-family=\"Inter, 'Helvetica Neue', Arial, sans-serif\"",
    ))
}

/// Returns the exponents of two powers of ten, one below and one above all values. The exponents differ by at least 2.
/// Returns (−1, 1) if there are no values, or if a value is not positive and finite.
pub fn decades(values: impl Iterator<Item = f64> + Clone) -> (i32, i32) {
    let least = values.clone().fold(f64::INFINITY, f64::min);
    let most = values.fold(0.0, f64::max);
    if !(least > 0.0 && most.is_finite() && least <= most) {
        return (-1, 1);
    }
    // Leave some space, so that no point lies on the frame of the chart.
    let low = libm::floor(libm::log10(least) - 0.1) as i32;
    let high = libm::ceil(libm::log10(most) + 0.1) as i32;
    (low, high.max(low + 2))
}

/// Returns the style of chart text with a font size of `size` pixels.
pub fn font<'a>(size: i32) -> TextStyle<'a> {
    (FONT_FAMILY, size * UNITS_PER_PIXEL).into_font().color(&INK_RGB)
}

/// Returns `style`, changed so that text begins at the point where it is drawn and is vertically centred on this point.
pub fn words_from<'a>(style: TextStyle<'a>) -> TextStyle<'a> {
    style.pos(Pos::new(HPos::Left, VPos::Center))
}

/// Formats the number at an axis tick with four significant digits, without trailing zeros.
pub fn tick(value: f64) -> String {
    let rounded = format!("{value:.3e}").parse().unwrap_or(value);
    if rounded == 0.0 {
        return "0".into();
    }
    match f64::abs(rounded) {
        size if (1e-3..1e6).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// Formats the power of ten with this exponent, for example `10⁻³` for −3.
pub fn power_of_ten(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        digit => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit.to_digit(10).unwrap_or(0) as usize).unwrap_or(digit),
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

/// Returns the smallest number of the form 1·10ⁿ, 2·10ⁿ or 5·10ⁿ, with an integer n, that is at least `value`. `value`
/// must be positive.
pub(crate) fn round_step(value: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(value)));
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|s| s * power >= value * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

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
/// })?;
/// assert!(svg.starts_with("<svg") && svg.contains("10⁻⁹") && svg.contains("ours"));
/// # Ok::<(), drystone::internals::chart::ChartError>(())
/// ```
pub fn scatter(chart: &Scatter) -> Result<String, ChartError> {
    document(LARGE_SIZE, &chart.title, |area| draw_scatter(chart, area))
}

fn draw_scatter(chart: &Scatter, area: &Page<'_>) -> DrawingResult {
    area.fill(&WHITE)?;
    let all = chart.series.iter().flat_map(|s| &s.points);
    let (left, right) = decades(all.clone().map(|p| p.x));
    let (low, high) = decades(all.clone().map(|p| p.y));
    let ten = |e: i32| libm::exp10(f64::from(e));
    let mut axes = ChartBuilder::on(area)
        .margin(14 * UNITS_PER_PIXEL)
        .margin_right(230 * UNITS_PER_PIXEL)
        .caption(&chart.title, font(17))
        .x_label_area_size(46 * UNITS_PER_PIXEL)
        .y_label_area_size(66 * UNITS_PER_PIXEL)
        .build_cartesian_2d((ten(left)..ten(right)).log_scale(), (ten(low)..ten(high)).log_scale())?;
    let label = |v: &f64| power_of_ten(libm::round(libm::log10(*v)) as i32);
    // The greatest number of labels that plotters may draw on an axis, including the labels at both ends.
    let every = |low: i32, high: i32| (high - low + 3).clamp(4, 10) as usize;
    axes.configure_mesh()
        .x_labels(every(left, right))
        .y_labels(every(low, high))
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .label_style(font(12))
        .axis_desc_style(font(13))
        .axis_style(INK_RGB.stroke_width(UNITS_PER_PIXEL as u32))
        .bold_line_style(GRID_RGB.stroke_width(UNITS_PER_PIXEL as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    // Draw the series with their names to the right of the axes, and on top the crosses that mark wrong results.
    let (x, mut y) = ((LARGE_SIZE.0 - 225) * UNITS_PER_PIXEL, 60 * UNITS_PER_PIXEL);
    let words = |text: &str, y: i32| {
        area.draw(&Text::new(text.to_owned(), (x + 30 * UNITS_PER_PIXEL, y), words_from(font(12))))
    };
    for Series { name, colour: [r, g, b], points } in &chart.series {
        let colour = RGBColor(*r, *g, *b);
        let points = || points.iter().map(|p| (p.x, p.y));
        axes.draw_series(LineSeries::new(points(), colour.stroke_width(3 * UNITS_PER_PIXEL as u32 / 2)))?;
        axes.draw_series(points().map(|at| Circle::new(at, 4 * UNITS_PER_PIXEL, colour.filled())))?;
        area.draw(&Circle::new((x + 12 * UNITS_PER_PIXEL, y), 4 * UNITS_PER_PIXEL, colour.filled()))?;
        words(name, y)?;
        y += 20 * UNITS_PER_PIXEL;
    }
    let stroke = RGBColor(215, 20, 30).stroke_width(4 * UNITS_PER_PIXEL as u32);
    let wrong = || all.clone().filter(|p| p.wrong);
    axes.draw_series(wrong().map(|p| Cross::new((p.x, p.y), 8 * UNITS_PER_PIXEL, stroke)))?;
    if wrong().next().is_some() {
        y += 4 * UNITS_PER_PIXEL;
        area.draw(&Cross::new((x + 12 * UNITS_PER_PIXEL, y), 8 * UNITS_PER_PIXEL, stroke))?;
        words(&chart.wrong, y)?;
    }
    Ok(())
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
    document(SMALL_SIZE, &chart.title, |area| draw_bars(chart, area))
}

fn draw_bars(chart: &Bars, area: &Page<'_>) -> DrawingResult {
    let (first, last) = (chart.edges[0], chart.edges[chart.edges.len() - 1]);
    let most = chart.counts.iter().copied().max().unwrap_or(1) as f64;
    let step = round_step(most / 4.0).max(1.0);
    let top = libm::ceil(most / step) * step;
    let mut axes = ChartBuilder::on(area)
        .margin(8 * UNITS_PER_PIXEL)
        .margin_right(20 * UNITS_PER_PIXEL)
        .x_label_area_size(38 * UNITS_PER_PIXEL)
        .y_label_area_size(48 * UNITS_PER_PIXEL)
        .build_cartesian_2d(first..last, 0.0..top)?;
    axes.configure_mesh()
        .disable_x_mesh()
        .x_labels(6)
        .y_labels(5)
        .x_label_formatter(&|v| tick(*v))
        .y_label_formatter(&|v| tick(*v))
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .set_all_tick_mark_size(4 * UNITS_PER_PIXEL)
        .label_style(font(12))
        .axis_desc_style(font(12))
        .axis_style(INK_RGB.stroke_width(UNITS_PER_PIXEL as u32))
        .bold_line_style(GRID_RGB.stroke_width(UNITS_PER_PIXEL as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let [r, g, b] = chart.colour;
    let gap = 0.06 * (chart.edges[1] - chart.edges[0]);
    let filled = chart.counts.iter().enumerate().filter(|c| *c.1 > 0);
    axes.draw_series(filled.map(|(i, count)| {
        let corners = [(chart.edges[i] + gap, 0.0), (chart.edges[i + 1] - gap, *count as f64)];
        Rectangle::new(corners, RGBColor(r, g, b).filled())
    }))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn bar_charts_are_small_files_with_labels() {
        let mut chart = Bars::counted(&[1.0, 2.0, 2.5], None);
        (chart.title, chart.x, chart.y) = ("t<".into(), "force, N".into(), "count".into());
        let svg = super::bars(&chart).expect("drawn");
        assert!(svg.contains("force, N") && svg.contains("t&lt;") && svg.len() < 9000, "{}", svg.len());
    }

    #[test]
    fn axes_begin_and_end_at_powers_of_ten() {
        assert_eq!(decades([2.0, 3.0].into_iter()), (0, 2));
        assert_eq!(decades([1e-16, 0.5].into_iter()), (-17, 0));
        assert_eq!(decades(std::iter::empty()), (-1, 1));
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
