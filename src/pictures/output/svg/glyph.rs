//! [`numbered`] converts a line of text to the outlines of its letters, at their positions in the picture.

use resvg::tiny_skia::{PathSegment, Point};
use resvg::usvg::{Node, Text};

use super::outline::Steps;
use crate::pictures::drawing::PagePoint;

/// Returns the number in the id of a line of text (`t1`, `t2` …), and the SVG path data of its letters. Returns `None`
/// if the id has another form.
pub(super) fn numbered(text: &Text) -> Option<(usize, String)> {
    let number = text.id().strip_prefix('t')?.parse().ok()?;
    let mut pen = Steps::default();
    let place = |p: Point| PagePoint::new(f64::from(p.x), f64::from(p.y));
    for node in text.flattened().children() {
        let Node::Path(path) = node else { continue };
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(p) => pen.begin(place(p)),
                PathSegment::LineTo(p) => pen.line(place(p)),
                PathSegment::QuadTo(a, p) => pen.curve('q', &[place(a), place(p)]),
                PathSegment::CubicTo(a, b, p) => pen.curve('c', &[place(a), place(b), place(p)]),
                PathSegment::Close => pen.close(),
            }
        }
    }
    Some((number, pen.data))
}
