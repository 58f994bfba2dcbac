//! Converts the basic shapes of SVG to subpaths.

use core::f64::consts::FRAC_PI_2;

use roxmltree::Node;
use svgtypes::PointsParser;

use super::path;
use super::viewport::{Viewport, length};
use crate::geometry::{Point, Vector};
use crate::sources::import::subpath::{Arc, Segment, Subpath};

/// Returns the subpaths of a shape, in the coordinates of its element.
///
/// # Errors
/// Returns a message if the shape has no valid size, has no points, or has path data that cannot be read.
pub(super) fn subpaths(node: Node<'_, '_>, viewport: Viewport) -> Result<Vec<Subpath>, String> {
    match node.tag_name().name() {
        "rect" => rect(node, viewport),
        "circle" | "ellipse" => ellipse(node, viewport),
        tag @ ("polygon" | "polyline") => polyline(node, tag == "polygon"),
        "line" => {
            let place = |x, y| point(node, viewport, [x, y]);
            let segments = vec![Segment::Line(place("x2", "y2"))];
            Ok(vec![Subpath { start: place("x1", "y1"), segments, closed: false }])
        }
        _ => path::subpaths(node.attribute("d").unwrap_or(""))
            .map_err(|why| format!("its path data cannot be read ({why})")),
    }
}

/// Reads a point from two attributes. A coordinate whose attribute is missing is 0.
fn point(node: Node<'_, '_>, viewport: Viewport, [x, y]: [&str; 2]) -> Point {
    Point::new(length(node, x, viewport.width).unwrap_or(0.0), length(node, y, viewport.height).unwrap_or(0.0))
}

fn positive(name: &str, value: Option<f64>) -> Result<f64, String> {
    match value {
        Some(v) if v > 0.0 => Ok(v),
        Some(v) => Err(format!("its {name} is {v}")),
        None => Err(format!("it has no {name}")),
    }
}

fn rect(node: Node<'_, '_>, viewport: Viewport) -> Result<Vec<Subpath>, String> {
    let across = |name| length(node, name, viewport.width);
    let down = |name| length(node, name, viewport.height);
    let width = positive("width", across("width"))?;
    let height = positive("height", down("height"))?;
    let radius = |own: Option<f64>, other: Option<f64>, side: f64| own.or(other).unwrap_or(0.0).clamp(0.0, side / 2.0);
    let (rx, ry) = (across("rx"), down("ry"));
    let radii = Vector::new(radius(rx, ry, width), radius(ry, rx, height));
    let at = point(node, viewport, ["x", "y"]);
    Ok(vec![rectangle(at, Vector::new(width, height), radii)])
}

fn ellipse(node: Node<'_, '_>, viewport: Viewport) -> Result<Vec<Subpath>, String> {
    let (rx, ry) = if node.tag_name().name() == "circle" {
        // Percentages of a radius refer to the diagonal of the viewport divided by √2.
        let diagonal = libm::hypot(viewport.width, viewport.height) / core::f64::consts::SQRT_2;
        let r = positive("radius", length(node, "r", diagonal))?;
        (r, r)
    } else {
        let rx = length(node, "rx", viewport.width);
        let ry = length(node, "ry", viewport.height);
        (positive("radius rx", rx.or(ry))?, positive("radius ry", ry.or(rx))?)
    };
    let centre = point(node, viewport, ["cx", "cy"]);
    Ok(vec![Subpath::ellipse(centre, rx, ry)])
}

fn polyline(node: Node<'_, '_>, closed: bool) -> Result<Vec<Subpath>, String> {
    let text = node.attribute("points").unwrap_or("");
    let points: Vec<Point> = PointsParser::from(text).map(|p| Point::new(p.0, p.1)).collect();
    let subpath = Subpath::closed(&points).ok_or("it has no points")?;
    Ok(vec![Subpath { closed, ..subpath }])
}

fn rectangle(at: Point, size: Vector, radii: Vector) -> Subpath {
    let corner = |x: f64, y: f64| at + Vector::new(x * size.x, y * size.y);
    if !(radii.x > 0.0 && radii.y > 0.0) {
        let segments = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Segment::Line(corner(x, y))).to_vec();
        return Subpath { start: at, segments, closed: true };
    }
    let (u, v) = (Vector::new(radii.x, 0.0), Vector::new(0.0, radii.y));
    let mut segments = Vec::new();
    // The segments run clockwise on the page, from the end of the rounded upper left corner.
    let roundings = [
        (corner(1.0, 0.0) - u + v, -1.0, -v, u),
        (corner(1.0, 1.0) - u - v, 0.0, u, v),
        (corner(0.0, 1.0) + u - v, 1.0, v, -u),
        (corner(0.0, 0.0) + u + v, 2.0, -u, -v),
    ];
    for (centre, quarters, from, to) in roundings {
        segments.push(Segment::Line(centre + from));
        segments.push(Segment::Arc(Arc {
            centre,
            u,
            v,
            from: quarters * FRAC_PI_2,
            sweep: FRAC_PI_2,
            to: centre + to,
        }));
    }
    Subpath { start: corner(0.0, 0.0) + u, segments, closed: true }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::snap::area;

    fn shape(element: &str) -> Result<Vec<Subpath>, String> {
        let document = roxmltree::Document::parse(element).expect("XML");
        let viewport = Viewport { width: 200.0, height: 100.0, copied: (None, None) };
        subpaths(document.root_element(), viewport)
    }

    fn shape_area(element: &str) -> f64 {
        let subpaths = shape(element).expect("a shape");
        area(&subpaths[0].flattened(1e-4, 1e-9).expect("closed"))
    }

    #[test]
    fn shapes_have_the_expected_areas() {
        let quarter = core::f64::consts::FRAC_PI_4;
        for (element, expected) in [
            ("<rect x='1' y='2' width='4' height='3'/>", 12.0),
            ("<rect width='4' height='3' rx='1'/>", 12.0 - 4.0 + 4.0 * quarter),
            ("<rect width='4' height='3' rx='9' ry='0.5'/>", 12.0 - 4.0 + 4.0 * quarter),
            ("<rect width='10%' height='10%'/>", 200.0),
            ("<circle cx='3' r='2'/>", 16.0 * quarter),
            ("<ellipse rx='2' ry='1'/>", 8.0 * quarter),
            ("<polygon points='0 0,4 0 4,3'/>", 6.0),
            ("<path d='M0 0h4v3z'/>", 6.0),
        ] {
            let found = shape_area(element);
            assert!((found - expected).abs() < 2e-3, "{element}: {found} {expected}");
        }
    }

    #[test]
    fn shapes_without_a_size_are_reported() {
        for (element, why) in [
            ("<rect width='4'/>", "it has no height"),
            ("<circle r='-1'/>", "its radius is -1"),
            ("<polygon/>", "it has no points"),
            ("<path d='M0 0 L'/>", "its path data"),
        ] {
            let described = shape(element).expect_err("no shape");
            assert!(described.starts_with(why), "{described}");
        }
    }
}
