//! Draws charts with the plotters library. No other module uses this library.

mod course;
mod growth;
mod scatter;

use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, RGBColor, TextStyle, register_font};

use super::{Bars, ChartError, LARGE_SIZE, SMALL_SIZE, round_step};
use crate::pictures::drawing::Face;
use crate::text::xml;
pub(super) use course::course;
pub(super) use growth::growth;
pub(super) use scatter::scatter;

/// Number of units of the drawn picture per pixel of the page.
const UNITS_PER_PIXEL: i32 = 10;
/// The family name that plotters writes for all text. The built-in font is registered under this name.
const FONT_FAMILY: &str = "sans-serif";

/// The result of drawing: the error of plotters if it fails.
type DrawingResult = Result<(), Box<dyn std::error::Error>>;

/// Returns the SVG document that `draw` writes, scaled to this width and height in pixels. `draw` must draw the picture
/// [`UNITS_PER_PIXEL`] times as large. `title` is for screen readers.
pub(super) fn document(
    (width, height): (i32, i32),
    title: &str,
    draw: impl FnOnce(&mut String) -> DrawingResult,
) -> Result<String, ChartError> {
    static FONTS: Once = Once::new();
    FONTS.call_once(|| {
        // Ignore an error here: registration fails only if the font cannot be read, and then drawing fails too.
        let _ = register_font(FONT_FAMILY, FontStyle::Normal, Face::Sans.data());
        let _ = register_font(FONT_FAMILY, FontStyle::Bold, Face::SansBold.data());
    });
    let mut svg = String::new();
    draw(&mut svg).map_err(ChartError::new)?;
    let (w, h) = (width * UNITS_PER_PIXEL, height * UNITS_PER_PIXEL);
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
pub(super) fn decades(values: impl Iterator<Item = f64> + Clone) -> (i32, i32) {
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

const INK: RGBColor = RGBColor(45, 45, 50);
const GRID: RGBColor = RGBColor(225, 225, 228);

/// The page on which plotters draws.
type Page<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Axes with a logarithmic scale in both directions.
type LogAxes<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

/// Returns the style of chart text with a font size of `size` pixels.
fn font<'a>(size: i32) -> TextStyle<'a> {
    (FONT_FAMILY, size * UNITS_PER_PIXEL).into_font().color(&INK)
}

/// Returns `style`, changed so that text begins at the point where it is drawn and is vertically centred on this point.
fn words_from<'a>(style: TextStyle<'a>) -> TextStyle<'a> {
    style.pos(Pos::new(HPos::Left, VPos::Center))
}

/// Creates an empty page of the size [`LARGE_SIZE`]. What is drawn on the page is written to `svg`.
fn large(svg: &mut String) -> Page<'_> {
    let size = ((LARGE_SIZE.0 * UNITS_PER_PIXEL) as u32, (LARGE_SIZE.1 * UNITS_PER_PIXEL) as u32);
    SVGBackend::with_string(svg, size).into_drawing_area()
}

/// Creates an empty page of the size [`SMALL_SIZE`]. What is drawn on the page is written to `svg`.
fn small(svg: &mut String) -> Page<'_> {
    let size = ((SMALL_SIZE.0 * UNITS_PER_PIXEL) as u32, (SMALL_SIZE.1 * UNITS_PER_PIXEL) as u32);
    SVGBackend::with_string(svg, size).into_drawing_area()
}

/// Formats the number at an axis tick with four significant digits, without trailing zeros.
fn tick(value: f64) -> String {
    let rounded = format!("{value:.3e}").parse().unwrap_or(value);
    if rounded == 0.0 {
        return "0".into();
    }
    match f64::abs(rounded) {
        size if (1e-3..1e6).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// Draws a histogram into `svg`.
pub(super) fn bars(chart: &Bars, svg: &mut String) -> DrawingResult {
    let area = small(svg);
    let (first, last) = (chart.edges[0], chart.edges[chart.edges.len() - 1]);
    let most = chart.counts.iter().copied().max().unwrap_or(1) as f64;
    let step = round_step(most / 4.0).max(1.0);
    let top = libm::ceil(most / step) * step;
    let mut axes = ChartBuilder::on(&area)
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
        .axis_style(INK.stroke_width(UNITS_PER_PIXEL as u32))
        .bold_line_style(GRID.stroke_width(UNITS_PER_PIXEL as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let [r, g, b] = chart.colour;
    let gap = 0.06 * (chart.edges[1] - chart.edges[0]);
    let filled = chart.counts.iter().enumerate().filter(|c| *c.1 > 0);
    axes.draw_series(filled.map(|(i, count)| {
        let corners = [(chart.edges[i] + gap, 0.0), (chart.edges[i + 1] - gap, *count as f64)];
        Rectangle::new(corners, RGBColor(r, g, b).filled())
    }))?;
    area.present()?;
    Ok(())
}
