//! Draws points on two logarithmic axes, with a legend.

use plotters::prelude::*;
use plotters::style::RGBColor;

use super::{DrawingResult, GRID, INK, LogAxes, Page, UNITS_PER_PIXEL, decades, font, large, words_from};
use crate::pictures::chart::{LARGE_SIZE, Scatter, power_of_ten};

/// The colour of the Pareto front.
const FRONT_COLOUR: RGBColor = RGBColor(240, 190, 60);

/// Draws points on two logarithmic axes into `svg`, with a legend.
pub(in crate::pictures::chart) fn scatter(chart: &Scatter, svg: &mut String) -> DrawingResult {
    let area = large(svg);
    area.fill(&WHITE)?;
    let all = chart.series.iter().flat_map(|s| &s.points);
    let (left, right) = decades(all.clone().map(|p| p.x));
    let (low, high) = decades(all.map(|p| p.y));
    let ten = |e: i32| libm::exp10(f64::from(e));
    let mut axes = ChartBuilder::on(&area)
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
        .axis_style(INK.stroke_width(UNITS_PER_PIXEL as u32))
        .bold_line_style(GRID.stroke_width(UNITS_PER_PIXEL as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    draw_points(&mut axes, chart)?;
    draw_legend(&area, chart)?;
    area.present()?;
    Ok(())
}

/// Returns the stroke of the crosses that mark wrong results.
fn cross_stroke() -> ShapeStyle {
    RGBColor(215, 20, 30).stroke_width(4 * UNITS_PER_PIXEL as u32)
}

/// Draws the Pareto front, above it the series of points, and on top the crosses that mark wrong results.
fn draw_points(axes: &mut LogAxes<'_, '_>, chart: &Scatter) -> DrawingResult {
    let front = stair(&chart.front.1);
    axes.draw_series(LineSeries::new(front, FRONT_COLOUR.stroke_width(6 * UNITS_PER_PIXEL as u32)))?;
    for series in &chart.series {
        let [r, g, b] = series.colour;
        let colour = RGBColor(r, g, b);
        axes.draw_series(LineSeries::new(
            series.points.iter().map(|p| (p.x, p.y)),
            colour.stroke_width(3 * UNITS_PER_PIXEL as u32 / 2),
        ))?;
        let dots = series.points.iter().map(|p| (p.x, p.y));
        axes.draw_series(dots.map(|at| Circle::new(at, 4 * UNITS_PER_PIXEL, colour.filled())))?;
    }
    let all = chart.series.iter().flat_map(|s| &s.points);
    let wrong = all.filter(|p| p.wrong);
    axes.draw_series(wrong.map(|p| Cross::new((p.x, p.y), 8 * UNITS_PER_PIXEL, cross_stroke())))?;
    Ok(())
}

/// Returns the corners of the Pareto front as a step line. From each point, y stays constant up to the x of the next
/// point. There it jumps to the y of the next point.
fn stair(front: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut stair: Vec<(f64, f64)> = Vec::new();
    for (x, y) in front {
        if let Some(last) = stair.last().copied() {
            stair.push((*x, last.1));
        }
        stair.push((*x, *y));
    }
    stair
}

/// Draws the legend to the right of the axes.
fn draw_legend(area: &Page<'_>, chart: &Scatter) -> DrawingResult {
    let (name, front) = &chart.front;
    let mut y = 60 * UNITS_PER_PIXEL;
    let x = (LARGE_SIZE.0 - 225) * UNITS_PER_PIXEL;
    let words = |text: &str, y: i32| {
        let at = (x + 30 * UNITS_PER_PIXEL, y);
        area.draw(&Text::new(text.to_owned(), at, words_from(font(12))))
    };
    for series in &chart.series {
        let [r, g, b] = series.colour;
        let dot = Circle::new((x + 12 * UNITS_PER_PIXEL, y), 4 * UNITS_PER_PIXEL, RGBColor(r, g, b).filled());
        area.draw(&dot)?;
        words(&series.name, y)?;
        y += 20 * UNITS_PER_PIXEL;
    }
    if !front.is_empty() {
        y += 8 * UNITS_PER_PIXEL;
        let line = vec![(x, y), (x + 24 * UNITS_PER_PIXEL, y)];
        area.draw(&PathElement::new(line, FRONT_COLOUR.stroke_width(6 * UNITS_PER_PIXEL as u32)))?;
        words(name, y)?;
        y += 20 * UNITS_PER_PIXEL;
    }
    if chart.series.iter().flat_map(|s| &s.points).any(|p| p.wrong) {
        y += 4 * UNITS_PER_PIXEL;
        area.draw(&Cross::new((x + 12 * UNITS_PER_PIXEL, y), 8 * UNITS_PER_PIXEL, cross_stroke()))?;
        words(&chart.wrong, y)?;
    }
    Ok(())
}
