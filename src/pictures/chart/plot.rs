//! How plotters draws our charts: the one door to it.

use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, RGBColor, register_font};

use super::{
    Bars, ChartError, Course, Growing, Growth, Point, SIZE, SMALL, Scatter, power_of_ten,
    round_step,
};
use crate::drawing::Face;
use crate::text::xml;

/// Picture units per unit of the page.
const FINE: i32 = 10;
/// The fonts of the SVG: ours first, and that under the one name plotters always asks for.
const FONT: &str = "sans-serif";

/// What plotters says where it refuses.
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// An SVG document of a size in pixels, drawn ten times as large.
pub(super) fn document(
    (width, height): (i32, i32),
    title: &str,
    draw: impl FnOnce(&mut String) -> Drawn,
) -> Result<String, ChartError> {
    static FONTS: Once = Once::new();
    FONTS.call_once(|| {
        // It fails only for a font file that cannot be read, and then drawing says so.
        let _ = register_font(FONT, FontStyle::Normal, Face::Sans.data());
        let _ = register_font(FONT, FontStyle::Bold, Face::SansBold.data());
    });
    let mut svg = String::new();
    draw(&mut svg).map_err(ChartError::new)?;
    let (w, h) = (width * FINE, height * FINE);
    let head = format!("width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\"");
    if !svg.contains(&head) {
        return Err(ChartError::new("the head of the SVG is not where it was"));
    }
    let page = format!(
        "width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{}\"",
        xml(title)
    );
    Ok(svg.replacen(&head, &page, 1).replace(
        &format!("font-family=\"{FONT}\""),
        "font-family=\"Inter, 'Helvetica Neue', Arial, sans-serif\"",
    ))
}

/// Whole decades around some numbers, at least two.
pub(super) fn decades(values: impl Iterator<Item = f64> + Clone) -> (i32, i32) {
    let least = values.clone().fold(f64::INFINITY, f64::min);
    let most = values.fold(0.0, f64::max);
    if !(least > 0.0 && most.is_finite() && least <= most) {
        return (-1, 1);
    }
    // A little room, so that no mark sits on the frame.
    let low = libm::floor(libm::log10(least) - 0.1) as i32;
    let high = libm::ceil(libm::log10(most) + 0.1) as i32;
    (low, high.max(low + 2))
}

/// Draws a scatter.
pub(super) fn scatter(chart: &Scatter, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let (w, h) = ((SIZE.0 * FINE) as u32, (SIZE.1 * FINE) as u32);
    let area = SVGBackend::with_string(svg, (w, h)).into_drawing_area();
    area.fill(&WHITE)?;
    let all = chart.series.iter().flat_map(|s| &s.points);
    let (left, right) = decades(all.clone().map(|p| p.x));
    let (low, high) = decades(all.map(|p| p.y));
    let ten = |e: i32| libm::exp10(f64::from(e));
    let ink = RGBColor(45, 45, 50);
    let font = |size: i32| (FONT, size * FINE).into_font().color(&ink);
    let mut axes = ChartBuilder::on(&area)
        .margin(14 * FINE)
        .margin_right(230 * FINE)
        .caption(&chart.title, font(17))
        .x_label_area_size(46 * FINE)
        .y_label_area_size(66 * FINE)
        .build_cartesian_2d(
            (ten(left)..ten(right)).log_scale(),
            (ten(low)..ten(high)).log_scale(),
        )?;
    let label = |v: &f64| power_of_ten(libm::round(libm::log10(*v)) as i32);
    // plotters takes the number as an upper bound, ends included.
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
        .axis_style(ink.stroke_width(FINE as u32))
        .bold_line_style(RGBColor(225, 225, 228).stroke_width(FINE as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let (name, front) = &chart.front;
    let gold = RGBColor(240, 190, 60);
    // A stair: between two points nothing better than the slower one's error is to be had at the faster one's time.
    let mut stair: Vec<(f64, f64)> = Vec::new();
    for (x, y) in front {
        if let Some(last) = stair.last().copied() {
            stair.push((*x, last.1));
        }
        stair.push((*x, *y));
    }
    axes.draw_series(LineSeries::new(stair, gold.stroke_width(6 * FINE as u32)))?;
    for series in &chart.series {
        let [r, g, b] = series.colour;
        let colour = RGBColor(r, g, b);
        axes.draw_series(LineSeries::new(
            series.points.iter().map(|p| (p.x, p.y)),
            colour.stroke_width(3 * FINE as u32 / 2),
        ))?;
        let dots = series.points.iter().map(|p| (p.x, p.y));
        axes.draw_series(dots.map(|at| Circle::new(at, 4 * FINE, colour.filled())))?;
    }
    let red = RGBColor(215, 20, 30).stroke_width(4 * FINE as u32);
    let wrong = chart
        .series
        .iter()
        .flat_map(|s| &s.points)
        .filter(|p| p.wrong);
    axes.draw_series(wrong.clone().map(|p| Cross::new((p.x, p.y), 8 * FINE, red)))?;
    // The legend stands beside the picture, where no point can be.
    let mut y = 60 * FINE;
    let x = (SIZE.0 - 225) * FINE;
    let words = |text: &str, y: i32| {
        let style = font(12).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(text.to_owned(), (x + 30 * FINE, y), style))
    };
    for series in &chart.series {
        let [r, g, b] = series.colour;
        let dot = Circle::new((x + 12 * FINE, y), 4 * FINE, RGBColor(r, g, b).filled());
        area.draw(&dot)?;
        words(&series.name, y)?;
        y += 20 * FINE;
    }
    if !front.is_empty() {
        y += 8 * FINE;
        let line = vec![(x, y), (x + 24 * FINE, y)];
        area.draw(&PathElement::new(line, gold.stroke_width(6 * FINE as u32)))?;
        words(name, y)?;
        y += 20 * FINE;
    }
    if wrong.count() > 0 {
        y += 4 * FINE;
        area.draw(&Cross::new((x + 12 * FINE, y), 8 * FINE, red))?;
        words(&chart.wrong, y)?;
    }
    area.present()?;
    Ok(())
}

const INK: RGBColor = RGBColor(45, 45, 50);
const GRID: RGBColor = RGBColor(225, 225, 228);

/// An empty page of a small chart.
fn small(svg: &mut String) -> DrawingArea<SVGBackend<'_>, Shift> {
    let size = ((SMALL.0 * FINE) as u32, (SMALL.1 * FINE) as u32);
    SVGBackend::with_string(svg, size).into_drawing_area()
}

/// A tick's number, without the noise of the sums that made it and without zeros that say nothing.
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

/// Draws what grows.
pub(super) fn growth(chart: &Growth, svg: &mut String) -> Drawn {
    let (w, h) = ((SIZE.0 * FINE) as u32, (SIZE.1 * FINE) as u32);
    let area = SVGBackend::with_string(svg, (w, h)).into_drawing_area();
    area.fill(&WHITE)?;
    let plain = |size: i32| (FONT, size * FINE).into_font();
    let font = |size: i32| plain(size).color(&INK);
    let all = || chart.lines.iter().flat_map(|line| &line.points);
    let (low, high) = decades(all().map(|p| p.y));
    let sizes = all().map(|p| p.x);
    let (least, most) = sizes.fold((f64::INFINITY, 0.0), |(a, b), x| (x.min(a), x.max(b)));
    let ten = |e: i32| libm::exp10(f64::from(e));
    let mut axes = ChartBuilder::on(&area)
        .margin(14 * FINE)
        .margin_right(250 * FINE)
        .caption(&chart.title, font(17))
        .x_label_area_size(46 * FINE)
        .y_label_area_size(66 * FINE)
        .build_cartesian_2d(
            (0.8 * least..1.25 * most).log_scale(),
            (ten(low)..ten(high)).log_scale(),
        )?;
    axes.configure_mesh()
        .x_labels(4)
        .y_labels((high - low + 3).clamp(4, 10) as usize)
        .x_label_formatter(&|v| grouped(*v))
        .y_label_formatter(&|v| grouped(*v))
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .label_style(font(12))
        .axis_desc_style(font(13))
        .axis_style(INK.stroke_width(FINE as u32))
        .bold_line_style(GRID.stroke_width(FINE as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let dark = RGBColor(20, 70, 130);
    let pale = RGBColor(140, 140, 146);
    let style = |ours: bool| if ours { (dark, 3) } else { (pale, 1) };
    let mut ends: Vec<(i32, i32, &Growing)> = Vec::new();
    // Ours lie above the others.
    for ours in [false, true] {
        let (colour, width) = style(ours);
        for line in chart.lines.iter().filter(|line| line.ours == ours) {
            let points = || line.points.iter().map(|p| (p.x, p.y));
            let stroke = colour.stroke_width((width * FINE) as u32);
            axes.draw_series(LineSeries::new(points(), stroke))?;
            let right = line.points.iter().filter(|p| !p.wrong);
            let dot = |p: &Point| Circle::new((p.x, p.y), (3 + width) * FINE, colour.filled());
            axes.draw_series(right.map(dot))?;
            let wrong = line.points.iter().filter(|p| p.wrong);
            let cross = INK.stroke_width(2 * FINE as u32);
            axes.draw_series(wrong.map(|p| Cross::new((p.x, p.y), 5 * FINE, cross)))?;
            if let Some(end) = points().next_back() {
                let (x, y) = axes.backend_coord(&end);
                ends.push((y, x, line));
            }
        }
    }
    // Names stand beside the picture in the order of their lines' ends, pushed apart and joined to them.
    ends.sort_by_key(|end| (end.0, end.1));
    let apart = 17 * FINE;
    let left = (SIZE.0 - 232) * FINE;
    let mut places: Vec<i32> = ends.iter().map(|end| end.0).collect();
    let mut free = 40 * FINE;
    for place in &mut places {
        *place = (*place).max(free);
        free = *place + apart;
    }
    // Those that were pushed down make room for each other upwards, so that none is far from its line.
    let mut below = (SIZE.1 - 66) * FINE;
    for (place, end) in places.iter_mut().zip(&ends).rev() {
        *place = (*place).min(below).min((*place + end.0) / 2 + apart);
        below = *place - apart;
    }
    for (y, (end, x, line)) in places.into_iter().zip(ends) {
        let (colour, _) = style(line.ours);
        let joint = vec![
            (x + 8 * FINE, end),
            (left - 14 * FINE, y),
            (left - 4 * FINE, y),
        ];
        let thin = colour.mix(0.8).stroke_width(FINE as u32 / 2);
        area.draw(&PathElement::new(joint, thin))?;
        let face = match line.ours {
            true => plain(12).style(FontStyle::Bold).color(&dark),
            false => font(12),
        };
        let words = face.pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(line.name.clone(), (left, y), words))?;
    }
    if all().any(|p| p.wrong) {
        let y = (SIZE.1 - 24) * FINE;
        let cross = INK.stroke_width(2 * FINE as u32);
        area.draw(&Cross::new((left + 5 * FINE, y), 5 * FINE, cross))?;
        let words = font(12).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(
            chart.wrong.clone(),
            (left + 18 * FINE, y),
            words,
        ))?;
    }
    area.present()?;
    Ok(())
}

/// A power of ten with its thousands set apart: `10 000`, `0.1`.
fn grouped(value: f64) -> String {
    let text = tick(value);
    match text.strip_suffix("000").filter(|_| !text.contains('.')) {
        Some(thousands) => format!("{thousands}\u{a0}000"),
        None => text,
    }
}

/// Draws bars.
pub(super) fn bars(chart: &Bars, svg: &mut String) -> Drawn {
    let area = small(svg);
    let font = |size: i32| (FONT, size * FINE).into_font().color(&INK);
    let (first, last) = (chart.edges[0], chart.edges[chart.edges.len() - 1]);
    let most = chart.counts.iter().copied().max().unwrap_or(1) as f64;
    let step = round_step(most / 4.0).max(1.0);
    let top = libm::ceil(most / step) * step;
    let mut axes = ChartBuilder::on(&area)
        .margin(8 * FINE)
        .margin_right(20 * FINE)
        .x_label_area_size(38 * FINE)
        .y_label_area_size(48 * FINE)
        .build_cartesian_2d(first..last, 0.0..top)?;
    axes.configure_mesh()
        .disable_x_mesh()
        .x_labels(6)
        .y_labels(5)
        .x_label_formatter(&|v| tick(*v))
        .y_label_formatter(&|v| tick(*v))
        .x_desc(&chart.x)
        .y_desc(&chart.y)
        .set_all_tick_mark_size(4 * FINE)
        .label_style(font(12))
        .axis_desc_style(font(12))
        .axis_style(INK.stroke_width(FINE as u32))
        .bold_line_style(GRID.stroke_width(FINE as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let [r, g, b] = chart.colour;
    let gap = 0.06 * (chart.edges[1] - chart.edges[0]);
    let filled = chart.counts.iter().enumerate().filter(|c| *c.1 > 0);
    axes.draw_series(filled.map(|(i, count)| {
        let corners = [
            (chart.edges[i] + gap, 0.0),
            (chart.edges[i + 1] - gap, *count as f64),
        ];
        Rectangle::new(corners, RGBColor(r, g, b).filled())
    }))?;
    area.present()?;
    Ok(())
}

/// Draws a course.
pub(super) fn course(chart: &Course, svg: &mut String) -> Drawn {
    let area = small(svg);
    let font = |size: i32| (FONT, size * FINE).into_font().color(&INK);
    let values = chart.lines.iter().flat_map(|l| l.2.iter().flatten());
    let most = values.copied().fold(0.0, f64::max);
    let step = round_step(if most > 0.0 { most / 4.0 } else { 0.25 });
    let top = libm::ceil(most / step - 1e-9).max(1.0) * step;
    let last = (chart.steps.len() - 1).max(1) as f64;
    let named = chart.lines.len() > 1;
    let mut axes = ChartBuilder::on(&area)
        .margin(8 * FINE)
        .margin_right(if named { 104 } else { 18 } * FINE)
        .x_label_area_size(38 * FINE)
        .y_label_area_size(54 * FINE)
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
        .set_all_tick_mark_size(4 * FINE)
        .label_style(font(12))
        .axis_desc_style(font(12))
        .axis_style(INK.stroke_width(FINE as u32))
        .bold_line_style(GRID.stroke_width(FINE as u32))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let mut ends: Vec<(i32, &str)> = Vec::new();
    for (name, [r, g, b], values) in &chart.lines {
        let colour = RGBColor(*r, *g, *b);
        let at = |i: usize| values.get(i).copied().flatten().map(|v| (i as f64, v));
        let points: Vec<(f64, f64)> = (0..values.len()).filter_map(at).collect();
        // A step without a value parts the line.
        let pairs = (1..values.len()).filter_map(|i| Some([at(i - 1)?, at(i)?]));
        for pair in pairs {
            axes.draw_series(LineSeries::new(pair, colour.stroke_width(2 * FINE as u32)))?;
        }
        axes.draw_series(
            points
                .iter()
                .map(|at| Circle::new(*at, 3 * FINE, colour.filled())),
        )?;
        if let Some(end) = points.last() {
            ends.push((axes.backend_coord(end).1, name));
        }
    }
    if named {
        // Names stand at the ends of their lines, pushed apart where these meet.
        ends.sort();
        let mut free = i32::MIN;
        for (y, name) in ends {
            let y = y.max(free);
            free = y + 13 * FINE;
            let style = font(12).pos(Pos::new(HPos::Left, VPos::Center));
            let at = ((SMALL.0 - 92) * FINE, y);
            area.draw(&Text::new(name.to_owned(), at, style))?;
        }
    }
    area.present()?;
    Ok(())
}
