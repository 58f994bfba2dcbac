//! Draws lines on two logarithmic axes, with the name of each line at its right end. The picture of the README that
//! compares drystone with other programs is drawn in this way.

use drystone::internals::chart::{
    ChartError, DrawingResult, Page, Point, UNITS_PER_PIXEL, decades, document, font, tick, words_from,
};
use plotters::prelude::*;
use plotters::style::{FontStyle, RGBColor};

const INK_RGB: RGBColor = RGBColor(45, 45, 50);
const GRID_RGB: RGBColor = RGBColor(225, 225, 228);

/// Width and height of the chart, pixels.
const LARGE_SIZE: (i32, i32) = (900, 620);

/// Axes with a logarithmic scale in both directions.
type LogAxes<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<LogCoord<f64>, LogCoord<f64>>>;

/// Lines on two logarithmic axes.
///
/// Lines have no colours of their own: important lines are dark and thick, and all others are thin and grey.
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
pub struct GrowthLine {
    /// The name, which is written at the right end of the line.
    pub name: String,
    /// Whether the line is important, and therefore dark and thick.
    pub is_highlighted: bool,
    /// The points of the line, by ascending x.
    pub points: Vec<Point>,
}

/// Draws lines on two logarithmic axes and returns the chart as an SVG document.
pub fn growth(chart: &Growth) -> Result<String, ChartError> {
    document(LARGE_SIZE, &chart.title, |area| draw(chart, area))
}

/// The colour of highlighted lines.
const HIGHLIGHT_COLOUR: RGBColor = RGBColor(20, 70, 130);
/// The colour of all other lines.
const OTHER_COLOUR: RGBColor = RGBColor(140, 140, 146);

/// The horizontal position at which the names begin, in units of the drawn picture.
const NAMES_LEFT: i32 = (LARGE_SIZE.0 - 232) * UNITS_PER_PIXEL;
/// The least vertical distance between two names, in units of the drawn picture.
const MIN_NAME_DISTANCE: i32 = 17 * UNITS_PER_PIXEL;

/// A line, and the position of its right end on the page.
struct LineEnd<'c> {
    y: i32,
    x: i32,
    line: &'c GrowthLine,
}

/// Draws all lines on two logarithmic axes.
fn draw(chart: &Growth, area: &Page<'_>) -> DrawingResult {
    area.fill(&WHITE)?;
    let all = || chart.lines.iter().flat_map(|line| &line.points);
    let (low, high) = decades(all().map(|p| p.y));
    let sizes = all().map(|p| p.x);
    let (least, most) = sizes.fold((f64::INFINITY, 0.0), |(a, b), x| (x.min(a), x.max(b)));
    let ten = |e: i32| libm::exp10(f64::from(e));
    let mut axes = ChartBuilder::on(area)
        .margin(14 * UNITS_PER_PIXEL)
        .margin_right(250 * UNITS_PER_PIXEL)
        .caption(&chart.title, font(17))
        .x_label_area_size(46 * UNITS_PER_PIXEL)
        .y_label_area_size(66 * UNITS_PER_PIXEL)
        .build_cartesian_2d((0.8 * least..1.25 * most).log_scale(), (ten(low)..ten(high)).log_scale())?;
    axes.configure_mesh()
        .x_labels(4)
        .y_labels((high - low + 3).clamp(4, 10) as usize)
        .x_label_formatter(&|v| grouped(*v))
        .y_label_formatter(&|v| grouped(*v))
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .label_style(font(12))
        .axis_desc_style(font(13))
        .axis_style(INK_RGB.stroke_width(UNITS_PER_PIXEL as u32))
        .bold_line_style(GRID_RGB.stroke_width(UNITS_PER_PIXEL as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let mut ends = draw_lines(&mut axes, &chart.lines)?;
    ends.sort_by_key(|end| (end.y, end.x));
    draw_names(area, &ends)?;
    if all().any(|p| p.wrong) {
        let y = (LARGE_SIZE.1 - 24) * UNITS_PER_PIXEL;
        let cross = Cross::new((NAMES_LEFT + 5 * UNITS_PER_PIXEL, y), 5 * UNITS_PER_PIXEL, cross_stroke());
        area.draw(&cross)?;
        let at = (NAMES_LEFT + 18 * UNITS_PER_PIXEL, y);
        area.draw(&Text::new(chart.wrong.clone(), at, words_from(font(12))))?;
    }
    Ok(())
}

/// Returns the colour and the width in pixels of a line. Highlighted lines are dark and thick.
fn style(is_highlighted: bool) -> (RGBColor, i32) {
    if is_highlighted { (HIGHLIGHT_COLOUR, 3) } else { (OTHER_COLOUR, 1) }
}

/// Returns the stroke of the crosses that mark wrong results.
fn cross_stroke() -> ShapeStyle {
    INK_RGB.stroke_width(2 * UNITS_PER_PIXEL as u32)
}

/// Draws all lines, the highlighted lines above the others. Returns the right end of each line.
fn draw_lines<'c>(
    axes: &mut LogAxes<'_, '_>,
    lines: &'c [GrowthLine],
) -> Result<Vec<LineEnd<'c>>, Box<dyn std::error::Error>> {
    let mut ends = Vec::new();
    for is_highlighted in [false, true] {
        let (colour, width) = style(is_highlighted);
        for line in lines.iter().filter(|line| line.is_highlighted == is_highlighted) {
            let points = || line.points.iter().map(|p| (p.x, p.y));
            let stroke = colour.stroke_width((width * UNITS_PER_PIXEL) as u32);
            axes.draw_series(LineSeries::new(points(), stroke))?;
            let right = line.points.iter().filter(|p| !p.wrong);
            let dot = |p: &Point| Circle::new((p.x, p.y), (3 + width) * UNITS_PER_PIXEL, colour.filled());
            axes.draw_series(right.map(dot))?;
            let wrong = line.points.iter().filter(|p| p.wrong);
            let cross = |p: &Point| Cross::new((p.x, p.y), 5 * UNITS_PER_PIXEL, cross_stroke());
            axes.draw_series(wrong.map(cross))?;
            if let Some(end) = points().next_back() {
                let (x, y) = axes.backend_coord(&end);
                ends.push(LineEnd { y, x, line });
            }
        }
    }
    Ok(ends)
}

/// Draws the names of the lines to the right of the picture. A thin line joins each name to the end of its line.
fn draw_names(area: &Page<'_>, ends: &[LineEnd<'_>]) -> DrawingResult {
    for (y, end) in name_heights(ends).into_iter().zip(ends) {
        let (colour, _) = style(end.line.is_highlighted);
        let joint = vec![
            (end.x + 8 * UNITS_PER_PIXEL, end.y),
            (NAMES_LEFT - 14 * UNITS_PER_PIXEL, y),
            (NAMES_LEFT - 4 * UNITS_PER_PIXEL, y),
        ];
        let thin = colour.mix(0.8).stroke_width(UNITS_PER_PIXEL as u32 / 2);
        area.draw(&PathElement::new(joint, thin))?;
        let face = if end.line.is_highlighted {
            let bold = ("sans-serif", 12 * UNITS_PER_PIXEL).into_font().style(FontStyle::Bold);
            bold.color(&HIGHLIGHT_COLOUR)
        } else {
            font(12)
        };
        let at = (NAMES_LEFT, y);
        area.draw(&Text::new(end.line.name.clone(), at, words_from(face)))?;
    }
    Ok(())
}

/// Returns the vertical positions of the names on the page, moved apart so that names do not overlap. `ends` is sorted
/// from top to bottom.
fn name_heights(ends: &[LineEnd<'_>]) -> Vec<i32> {
    // From top to bottom: move each name below the name above it.
    let mut heights: Vec<i32> = ends.iter().map(|end| end.y).collect();
    let mut free = 40 * UNITS_PER_PIXEL;
    for height in &mut heights {
        *height = (*height).max(free);
        free = *height + MIN_NAME_DISTANCE;
    }
    // From bottom to top: move names up again, so that no name is far below the end of its line.
    let mut below = (LARGE_SIZE.1 - 66) * UNITS_PER_PIXEL;
    for (height, end) in heights.iter_mut().zip(ends).rev() {
        *height = (*height).min(below).min((*height + end.y) / 2 + MIN_NAME_DISTANCE);
        below = *height - MIN_NAME_DISTANCE;
    }
    heights
}

/// Formats the number at an axis tick, with a space before the last three zeros of a large number: `10 000`, `0.1`.
fn grouped(value: f64) -> String {
    let text = tick(value);
    match text.strip_suffix("000").filter(|_| !text.contains('.')) {
        Some(thousands) => format!("{thousands}\u{a0}000"),
        None => text,
    }
}
