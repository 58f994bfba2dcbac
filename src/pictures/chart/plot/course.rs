//! Draws values over the steps of a scene as lines.

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::RGBColor;

use super::{DrawingResult, GRID, INK, Page, UNITS_PER_PIXEL, font, small, tick, words_from};
use crate::pictures::chart::{Course, SMALL_SIZE, round_step};

type Axes<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws values over the steps of a scene into `svg`.
pub(in crate::pictures::chart) fn course(chart: &Course, svg: &mut String) -> DrawingResult {
    let area = small(svg);
    let values = chart.lines.iter().flat_map(|l| l.2.iter().flatten());
    let most = values.copied().fold(0.0, f64::max);
    let step = round_step(if most > 0.0 { most / 4.0 } else { 0.25 });
    let top = libm::ceil(most / step - 1e-9).max(1.0) * step;
    let last = (chart.steps.len() - 1).max(1) as f64;
    let named = chart.lines.len() > 1;
    let mut axes = ChartBuilder::on(&area)
        .margin(8 * UNITS_PER_PIXEL)
        .margin_right(if named { 104 } else { 18 } * UNITS_PER_PIXEL)
        .x_label_area_size(38 * UNITS_PER_PIXEL)
        .y_label_area_size(54 * UNITS_PER_PIXEL)
        .build_cartesian_2d(0.0..last, 0.0..top)?;
    let name = |v: &f64| {
        let whole = libm::round(*v);
        let near = (v - whole).abs() < 1e-6;
        let step = chart.steps.get(whole.max(0.0) as usize).filter(|_| near);
        step.cloned().unwrap_or_default()
    };
    axes.configure_mesh()
        .disable_x_mesh()
        .x_labels(chart.steps.len().min(9))
        .y_labels(5)
        .x_label_formatter(&name)
        .y_label_formatter(&|v| tick(*v))
        .x_desc("step")
        .y_desc(&chart.y)
        .set_all_tick_mark_size(4 * UNITS_PER_PIXEL)
        .label_style(font(12))
        .axis_desc_style(font(12))
        .axis_style(INK.stroke_width(UNITS_PER_PIXEL as u32))
        .bold_line_style(GRID.stroke_width(UNITS_PER_PIXEL as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let ends = draw_lines(&mut axes, chart)?;
    if named {
        draw_names(&area, ends)?;
    }
    area.present()?;
    Ok(())
}

/// Draws the lines. Returns, for each line with values, the vertical position on the page at which the line ends, and
/// its name.
fn draw_lines<'c>(
    axes: &mut Axes<'_, '_>,
    chart: &'c Course,
) -> Result<Vec<(i32, &'c str)>, Box<dyn std::error::Error>> {
    let mut ends: Vec<(i32, &str)> = Vec::new();
    for (name, [r, g, b], values) in &chart.lines {
        let colour = RGBColor(*r, *g, *b);
        let at = |i: usize| values.get(i).copied().flatten().map(|v| (i as f64, v));
        let points: Vec<(f64, f64)> = (0..values.len()).filter_map(at).collect();
        // Connect only neighbouring steps, so that a step without a value interrupts the line.
        let pairs = (1..values.len()).filter_map(|i| Some([at(i - 1)?, at(i)?]));
        for pair in pairs {
            axes.draw_series(LineSeries::new(pair, colour.stroke_width(2 * UNITS_PER_PIXEL as u32)))?;
        }
        axes.draw_series(points.iter().map(|at| Circle::new(*at, 3 * UNITS_PER_PIXEL, colour.filled())))?;
        if let Some(end) = points.last() {
            ends.push((axes.backend_coord(end).1, name));
        }
    }
    Ok(ends)
}

/// Draws the name of each line to the right of the axes, at the height of the end of the line. Names that would overlap
/// are moved down.
fn draw_names(area: &Page<'_>, mut ends: Vec<(i32, &str)>) -> DrawingResult {
    ends.sort();
    let mut free = i32::MIN;
    for (y, name) in ends {
        let y = y.max(free);
        free = y + 13 * UNITS_PER_PIXEL;
        let at = ((SMALL_SIZE.0 - 92) * UNITS_PER_PIXEL, y);
        area.draw(&Text::new(name.to_owned(), at, words_from(font(12))))?;
    }
    Ok(())
}
