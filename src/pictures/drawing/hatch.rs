//! [`hatch`] fills an outline with parallel lines, as engineering drawings show the ground.

use super::{Outline, PagePoint, PageRect};

/// Returns the parts of parallel 45° lines that lie inside the rings and inside `page`. `spacing` is the vertical
/// distance of neighbouring lines in pixels. The rings are filled by the even-odd rule, so holes stay empty. Parts that
/// are shorter than a pixel may be left out.
pub fn hatch(rings: &[Vec<PagePoint>], page: PageRect, spacing: f64) -> Vec<[PagePoint; 2]> {
    let mut lines = Vec::new();
    if !(spacing > 0.0) {
        return lines;
    }
    // The lines run down to the right on the page. Along each line, y − x has the constant value `level`.
    let first = page.at.y - page.at.x - page.width;
    let count = ((page.width + page.height) / spacing).floor();
    for number in 0..=count as usize {
        let level = first + spacing * number as f64;
        let mut cuts: Vec<f64> = Vec::new();
        for ring in rings {
            for i in 0..ring.len() {
                let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
                let (above, below) = (a.y - a.x - level, b.y - b.x - level);
                // A corner on the line counts as a corner below the line. The line then cuts each ring an even number
                // of times.
                if (above >= 0.0) != (below >= 0.0) {
                    cuts.push(a.x + (b.x - a.x) * above / (above - below));
                }
            }
        }
        cuts.sort_by(f64::total_cmp);
        let low = page.at.x.max(page.at.y - level);
        let high = (page.at.x + page.width).min(page.at.y + page.height - level);
        for pair in cuts.chunks_exact(2) {
            let (from, to) = (pair[0].max(low), pair[1].min(high));
            if to - from > 0.5 {
                let at = |x: f64| PagePoint::new(x, x + level);
                lines.push([at(from), at(to)]);
            }
        }
    }
    lines
}

/// Returns one outline that consists of these lines.
pub fn lines(lines: &[[PagePoint; 2]]) -> Outline {
    let mut outline = Outline::default();
    for line in lines {
        outline.extend(Outline::line(*line));
    }
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lie_inside_the_outline_and_outside_holes() {
        let square = |from: f64, to: f64| {
            vec![PagePoint::new(from, from), PagePoint::new(to, from), PagePoint::new(to, to), PagePoint::new(from, to)]
        };
        let page = PageRect { at: PagePoint::new(0.0, 0.0), width: 80.0, height: 200.0 };
        let rings = [square(10.0, 100.0), square(40.0, 60.0)];
        let drawn = hatch(&rings, page, 5.0);
        assert!(drawn.len() > 20);
        for [a, b] in drawn {
            assert!((b.y - a.y - (b.x - a.x)).abs() < 1e-9);
            let middle = PagePoint::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0);
            let inside = |p: PagePoint, from: f64, to: f64| p.x > from && p.x < to && p.y > from && p.y < to;
            assert!(inside(middle, 10.0, 100.0) && !inside(middle, 40.0, 60.0));
            assert!(a.x >= 9.99 && b.x <= 80.01 && b.y <= 100.01);
        }
        assert!(hatch(&rings, page, 0.0).is_empty());
    }
}
