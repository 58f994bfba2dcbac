//! Converts the lengths and view boxes of an SVG to user units, and finds the physical size of its page.

use core::str::FromStr;

use roxmltree::Node;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};

use super::name::INKSCAPE_NAMESPACE;
use crate::sources::import::subpath::Affine;

/// Pixels per inch in CSS.
const CSS_DPI: f64 = 96.0;

/// The size to which percentages refer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Viewport {
    pub(super) width: f64,
    pub(super) height: f64,
    /// The width and height that a `<use>` element sets for its symbol.
    pub(super) copied: (Option<f64>, Option<f64>),
}

/// The page of the root element.
pub(super) struct Page {
    pub(super) viewport: Viewport,
    /// The x coordinate of the left edge, in user units.
    pub(super) left: f64,
    /// The y coordinate of the lower edge, in user units. The y axis points down.
    pub(super) bottom: f64,
    /// Metres per user unit and the size from which it follows, if the drawing has a physical size.
    pub(super) unit: Option<(f64, String)>,
}

/// Reads the viewport, the position of the page and its physical size from the attributes of the root element.
pub(super) fn page(root: Node<'_, '_>) -> Page {
    let sizes = ["width", "height"].map(|name| root.attribute(name).and_then(|t| Length::from_str(t).ok()));
    let dpi = pixels_per_inch(root);
    let pixels = |i: usize| sizes[i].and_then(|l| in_pixels(l, None)).map(|p| p * dpi / CSS_DPI).filter(|p| *p > 0.0);
    let given = view_box(root);
    let view = given.or_else(|| Some(ViewBox::new(0.0, 0.0, pixels(0)?, pixels(1)?)));
    let metres = |i: usize| sizes[i].and_then(physical).filter(|m| *m > 0.0);
    let mut unit = None;
    if let Some(view) = given {
        // If width and height give different scales, viewers use the smaller one.
        let per_width = metres(0).map(|m| m / view.w);
        let per_height = metres(1).map(|m| m / view.h);
        let scale = match (per_width, per_height) {
            (Some(w), Some(h)) => Some(w.min(h)),
            (w, h) => w.or(h),
        };
        if let Some(scale) = scale.filter(|s| s.is_finite() && *s > 0.0) {
            unit = Some((neat(scale), described(root, per_width.is_some())));
        }
    } else if metres(0).or(metres(1)).is_some() {
        let program = if dpi == CSS_DPI { "" } else { " and is by an Inkscape before 0.92" };
        unit = Some((0.0254 / dpi, format!("it has no viewBox{program}, and a pixel is then 1/{dpi} inch")));
    }
    let shown = view.unwrap_or(ViewBox::new(0.0, 0.0, 0.0, 0.0));
    Page {
        viewport: Viewport { width: shown.w, height: shown.h, copied: (None, None) },
        left: shown.x,
        bottom: shown.y + shown.h,
        unit,
    }
}

/// Returns the number of user units per inch of a drawing without a view box: 96, or 90 for old versions of Inkscape.
fn pixels_per_inch(root: Node<'_, '_>) -> f64 {
    let version = root.attribute((INKSCAPE_NAMESPACE, "version")).unwrap_or("");
    let mut numbers = version.split(|c: char| !c.is_ascii_digit()).map(str::parse::<u32>);
    match (numbers.next(), numbers.next()) {
        (Some(Ok(0)), Some(Ok(minor))) if minor < 92 => 90.0,
        _ => CSS_DPI,
    }
}

/// Returns a sentence with the size of the page that determines the scale, such as `it is 210mm wide`.
fn described(root: Node<'_, '_>, by_width: bool) -> String {
    let (name, way) = if by_width { ("width", "wide") } else { ("height", "high") };
    format!("it is {} {way}", root.attribute(name).unwrap_or("").trim())
}

/// Reads an attribute as a length in user units. A percentage refers to the length `whole`. Returns `None` if the
/// attribute is missing or not valid.
pub(super) fn length(node: Node<'_, '_>, name: &str, whole: f64) -> Option<f64> {
    in_pixels(Length::from_str(node.attribute(name)?).ok()?, Some(whole))
}

pub(super) fn view_box(node: Node<'_, '_>) -> Option<ViewBox> {
    let text = node.attribute("viewBox")?;
    let view = ViewBox::from_str(text).ok()?;
    [view.x, view.y, view.w, view.h].iter().all(|v| v.is_finite()).then_some(view)
}

/// Returns the map from a view box to a viewport of this width and height. `ratio` is the attribute
/// `preserveAspectRatio`.
pub(super) fn fitted(view: ViewBox, width: f64, height: f64, ratio: AspectRatio) -> Affine {
    let (sx, sy) = (width / view.w, height / view.h);
    if ratio.align == Align::None {
        return Affine::scale(sx, sy).after(&Affine::translation(-view.x, -view.y));
    }
    let scale = if ratio.slice { sx.max(sy) } else { sx.min(sy) };
    let (free_x, free_y) = (width - scale * view.w, height - scale * view.h);
    let (x, y) = match ratio.align {
        Align::XMinYMin | Align::None => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    };
    Affine::translation(x * free_x, y * free_y)
        .after(&Affine::scale(scale, scale))
        .after(&Affine::translation(-view.x, -view.y))
}

fn in_pixels(length: Length, whole: Option<f64>) -> Option<f64> {
    let n = length.number;
    let pixels = match length.unit {
        LengthUnit::None | LengthUnit::Px => n,
        LengthUnit::Percent => n / 100.0 * whole?,
        // The default font size of browsers is 16 pixels.
        LengthUnit::Em => 16.0 * n,
        LengthUnit::Ex => 8.0 * n,
        _ => physical(length)? / 0.0254 * CSS_DPI,
    };
    pixels.is_finite().then_some(pixels)
}

/// Converts a length to metres; `None` if its unit is not absolute.
fn physical(length: Length) -> Option<f64> {
    let metres = match length.unit {
        LengthUnit::Mm => 1e-3,
        LengthUnit::Cm => 1e-2,
        LengthUnit::In => 0.0254,
        LengthUnit::Pt => 0.0254 / 72.0,
        LengthUnit::Pc => 0.0254 / 6.0,
        _ => return None,
    };
    Some(length.number * metres)
}

/// Rounds a scale to 15 digits. This removes the rounding error of a division, so that the result of 0.21 m / 210 is
/// 0.001.
fn neat(scale: f64) -> f64 {
    format!("{scale:.14e}").parse().unwrap_or(scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(attributes: &str) -> Option<f64> {
        let text = format!("<svg {attributes}/>");
        let document = roxmltree::Document::parse(&text).expect("XML");
        page(document.root_element()).unit.map(|u| u.0)
    }

    #[test]
    fn the_unit_of_a_drawing_follows_from_its_physical_size() {
        assert_eq!(unit("width='210mm' height='297mm' viewBox='0 0 210 297'"), Some(0.001));
        assert_eq!(unit("width='20cm' viewBox='0 0 50 10'"), Some(0.004));
        for pixels in ["width='10in' height='5in'", "width='5mm'"] {
            let found = unit(pixels).expect("a size");
            assert!((found / 0.0254 * 96.0 - 1.0).abs() < 1e-13, "{found}");
        }
        assert_eq!(unit("width='72pt' height='72pt' viewBox='0 0 2 1'"), Some(0.0127));
        // Inkscape before 0.92 counted 90 pixels per inch.
        let old =
            "width='1220mm' height='610mm' xmlns:i='http://www.inkscape.org/namespaces/inkscape' i:version='0.48.4'";
        assert!((unit(old).expect("a size") * 354.33 - 0.1).abs() < 1e-6);
        for none in ["width='800px' height='600px'", "width='100%' viewBox='0 0 5 5'", "viewBox='0 0 5 5'", ""] {
            assert_eq!(unit(none), None, "{none}");
        }
    }

    #[test]
    fn a_view_box_is_fitted_as_specified() {
        use crate::geometry::Point;
        let view = ViewBox::new(10.0, 0.0, 4.0, 2.0);
        let at = |ratio: &str| {
            let ratio = AspectRatio::from_str(ratio).expect("a ratio");
            fitted(view, 8.0, 8.0, ratio).point(Point::new(14.0, 2.0))
        };
        assert_eq!(at("xMidYMid"), Point::new(8.0, 6.0));
        assert_eq!(at("xMinYMax"), Point::new(8.0, 8.0));
        assert_eq!(at("none"), Point::new(8.0, 8.0));
        assert_eq!(at("xMinYMin slice"), Point::new(16.0, 8.0));
    }
}
