//! [`scatter`]: points on two logarithmic axes, the one door to plotters.
//!
//! plotters counts in whole pixels and lets labels collide; so the picture is drawn at ten times its size and the SVG's
//! width and height are rewritten over the same view box. Logarithmic axes shorter than a decade lose their labels, so
//! they are rounded outward to whole decades and at least two long. Words are set in our own font, registered under the
//! name that the SVG then carries, so that no machine's fonts reach a picture.

use std::fmt;
use std::sync::Once;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, RGBColor, register_font};

use crate::drawing::Face;
use crate::text::xml;

/// Picture units per unit of the page.
const FINE: i32 = 10;
/// Width and height of the page.
const SIZE: (i32, i32) = (900, 620);
/// The fonts of the SVG: ours first, and that under the one name plotters always asks for.
const FONT: &str = "sans-serif";

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
pub struct Undrawn(String);

impl Undrawn {
    fn of(error: impl fmt::Display) -> Undrawn {
        Undrawn(error.to_string())
    }
}

/// Whole decades around some numbers, at least two.
fn decades(values: impl Iterator<Item = f64> + Clone) -> (i32, i32) {
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

/// `10⁻³`.
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

/// Draws a scatter as an SVG document.
///
/// # Errors
/// Where plotters refuses, which no finite and positive points make it do.
///
/// # Example
/// ```
/// use drystone::chart::{Point, Scatter, Series, scatter};
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
/// # Ok::<(), drystone::chart::Undrawn>(())
/// ```
pub fn scatter(chart: &Scatter) -> Result<String, Undrawn> {
    static FONTS: Once = Once::new();
    FONTS.call_once(|| {
        // It fails only for a font file that cannot be read, and then drawing says so.
        let _ = register_font(FONT, FontStyle::Normal, Face::Sans.data());
        let _ = register_font(FONT, FontStyle::Bold, Face::SansBold.data());
    });
    let mut svg = String::new();
    draw(chart, &mut svg).map_err(Undrawn::of)?;
    let (w, h) = (SIZE.0 * FINE, SIZE.1 * FINE);
    let head = format!("width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\"");
    if !svg.contains(&head) {
        return Err(Undrawn::of("the head of the SVG is not where it was"));
    }
    let (width, height) = SIZE;
    let page = format!(
        "width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{}\"",
        xml(&chart.title)
    );
    Ok(svg.replacen(&head, &page, 1).replace(
        &format!("font-family=\"{FONT}\""),
        "font-family=\"Inter, 'Helvetica Neue', Arial, sans-serif\"",
    ))
}

fn draw(chart: &Scatter, svg: &mut String) -> Result<(), Box<dyn std::error::Error>> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_run_over_whole_decades() {
        assert_eq!(decades([2.0, 3.0].into_iter()), (0, 2));
        assert_eq!(decades([1e-16, 0.5].into_iter()), (-17, 0));
        assert_eq!(decades(std::iter::empty()), (-1, 1));
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
