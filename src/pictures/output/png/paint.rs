//! [`paint`]: a drawing in pixels, without the way round by SVG text.
//!
//! The picture is that of the drawing's SVG, pixel for pixel: places are rounded as they are written there, the same
//! rasteriser fills the same shapes in the same order, and what is seen through or cut off is drawn apart first, as
//! resvg does it. Tests hold both against each other.

use std::sync::Arc;
use std::vec::IntoIter;

use resvg::tiny_skia::{
    FillRule, FilterQuality, IntRect, LineCap, LineJoin, Mask, NonZeroRect, Paint, Path,
    PathBuilder, Pattern, Pixmap, PixmapMut, PremultipliedColorU8, Rect, SpreadMode, Stroke,
    StrokeDash, Transform,
};

use super::letter::{Line, lines};
use crate::drawing::{self, Colour, Drawing, Item, Join, PageRect, Text};
use crate::output::svg::{Pen, rounded, trace};

/// Puts what is on a drawing's page on pixels that have the page's colour, scaled to fill them.
///
/// # Errors
/// What resvg has against the words.
pub(super) fn paint(
    drawing: &Drawing,
    scale: Transform,
    pixels: &mut Pixmap,
) -> Result<(), String> {
    let mut texts = Vec::new();
    words(&drawing.items, &mut texts);
    let mut lines = lines(&texts)?.into_iter();
    let mut marks = Vec::new();
    collect(&drawing.items, &mut lines, &mut marks);
    let (width, height) = (pixels.width(), pixels.height());
    let around = |side: u32| i32::try_from(side).unwrap_or(i32::MAX).saturating_mul(-2);
    let (x, y) = (around(width), around(height));
    if let Some(most) = IntRect::from_xywh(x, y, 5 * width, 5 * height) {
        put(&marks, most, scale, &mut pixels.as_mut());
    }
    Ok(())
}

/// What leaves ink, the lowest first.
enum Mark {
    Shape(Shape),
    /// What is in a rectangle, and the rectangle.
    Part(Vec<Mark>, PageRect),
}

struct Shape {
    path: Path,
    fill: Option<Colour>,
    stroke: Option<(Colour, Stroke)>,
    fill_last: bool,
    opacity: f32,
}

/// Every line of words, in order.
fn words<'d>(items: &'d [Item], texts: &mut Vec<&'d Text>) {
    for item in items {
        match item {
            Item::Path(_) => {}
            Item::Text(text) => texts.push(text),
            Item::Group(group) => words(&group.items, texts),
        }
    }
}

fn collect(items: &[Item], lines: &mut IntoIter<Arc<Line>>, marks: &mut Vec<Mark>) {
    for item in items {
        match item {
            Item::Path(path) => marks.extend(shape(path).map(Mark::Shape)),
            Item::Text(text) => {
                let line = lines.next().unwrap_or_default();
                marks.extend(letters(text, &line).map(Mark::Shape));
            }
            Item::Group(group) => match group.clip {
                None => collect(&group.items, lines, marks),
                Some(clip) => {
                    let mut within = Vec::new();
                    collect(&group.items, lines, &mut within);
                    marks.push(Mark::Part(within, clip));
                }
            },
        }
    }
}

fn shape(path: &drawing::Path) -> Option<Shape> {
    let most = path.outline.segments.len();
    let mut builder = PathBuilder::with_capacity(most, 3 * most);
    trace(&path.outline, &mut builder);
    Some(Shape {
        path: builder.finish()?,
        fill: path.fill,
        stroke: path.stroke.as_ref().map(|s| (s.colour, stroke(s))),
        fill_last: path.fill_last,
        opacity: match path.opacity < 1.0 {
            true => rounded(path.opacity).clamp(0.0, 1.0) as f32,
            false => 1.0,
        },
    })
}

fn letters(text: &Text, line: &Line) -> Option<Shape> {
    let path = line.outline(rounded(text.at.x) as f32, rounded(text.at.y) as f32)?;
    let halo = |(colour, width)| {
        let seam = drawing::Stroke::new(colour, 2.0 * width);
        (colour, stroke(&seam))
    };
    Some(Shape {
        path,
        fill: Some(text.fill),
        stroke: text.halo.map(halo),
        fill_last: true,
        opacity: 1.0,
    })
}

fn stroke(stroke: &drawing::Stroke) -> Stroke {
    let mut dash: Vec<f32> = stroke.dash.iter().map(|d| rounded(*d) as f32).collect();
    if dash.len() % 2 == 1 {
        dash.extend_from_within(..);
    }
    let (line_cap, line_join) = match stroke.join {
        Join::Round => (LineCap::Round, LineJoin::Round),
        Join::Miter => (LineCap::Butt, LineJoin::Miter),
    };
    Stroke {
        width: rounded(stroke.width) as f32,
        line_cap,
        line_join,
        // None where there are no dashes or none has a length.
        dash: StrokeDash::new(dash, 0.0),
        ..Stroke::default()
    }
}

impl Pen for PathBuilder {
    fn begin(&mut self, x: f64, y: f64) {
        self.move_to(x as f32, y as f32);
    }

    fn line(&mut self, x: f64, y: f64) {
        self.line_to(x as f32, y as f32);
    }

    fn curve(&mut self, [(a, b), (c, d), (x, y)]: [(f64, f64); 3]) {
        let single = |v: f64| v as f32;
        self.cubic_to(
            single(a),
            single(b),
            single(c),
            single(d),
            single(x),
            single(y),
        );
    }

    fn close(&mut self) {
        PathBuilder::close(self);
    }
}

/// Draws marks; what is drawn apart is at most `most`, in pixels.
fn put(marks: &[Mark], most: IntRect, transform: Transform, pixels: &mut PixmapMut<'_>) {
    for mark in marks {
        match mark {
            Mark::Shape(shape) if shape.opacity == 1.0 => ink(shape, transform, pixels),
            Mark::Shape(shape) => {
                through(shape, most, transform, pixels);
            }
            Mark::Part(within, clip) => {
                part(within, *clip, most, transform, pixels);
            }
        }
    }
}

fn ink(shape: &Shape, transform: Transform, pixels: &mut PixmapMut<'_>) {
    let fill = |pixels: &mut PixmapMut<'_>| {
        let bounds = shape.path.bounds();
        let flat = bounds.width() == 0.0 || bounds.height() == 0.0;
        if let Some(colour) = shape.fill.filter(|_| !flat) {
            pixels.fill_path(
                &shape.path,
                &paint_of(colour),
                FillRule::Winding,
                transform,
                None,
            );
        }
    };
    if shape.fill_last {
        line(shape, transform, pixels);
        fill(pixels);
    } else {
        fill(pixels);
        line(shape, transform, pixels);
    }
}

fn line(shape: &Shape, transform: Transform, pixels: &mut PixmapMut<'_>) {
    if let Some((colour, stroke)) = &shape.stroke {
        pixels.stroke_path(&shape.path, &paint_of(*colour), stroke, transform, None);
    }
}

fn paint_of(Colour([r, g, b]): Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, u8::MAX);
    paint
}

/// A shape that is seen through.
fn through(
    shape: &Shape,
    most: IntRect,
    transform: Transform,
    pixels: &mut PixmapMut<'_>,
) -> Option<()> {
    let layer = Layer::new(extent(shape)?.to_non_zero_rect()?, most, transform)?;
    let mut apart = layer.pixels()?;
    ink(shape, layer.transform, &mut apart.as_mut());
    layer.join(&apart, shape.opacity, pixels);
    Some(())
}

/// Marks within a rectangle.
fn part(
    within: &[Mark],
    clip: PageRect,
    most: IntRect,
    transform: Transform,
    pixels: &mut PixmapMut<'_>,
) -> Option<()> {
    let clip = rectangle(clip)?;
    let layer = Layer::new(seen(within, clip)?, most, transform)?;
    let mut apart = layer.pixels()?;
    put(within, most, layer.transform, &mut apart.as_mut());
    let mut mask = Mask::new(apart.width(), apart.height())?;
    let clip = PathBuilder::from_rect(clip);
    mask.fill_path(&clip, FillRule::Winding, true, layer.transform);
    apart.apply_mask(&mask);
    layer.join(&apart, 1.0, pixels);
    Some(())
}

fn rectangle(rect: PageRect) -> Option<Rect> {
    let [x, y, width, height] =
        [rect.at.x, rect.at.y, rect.width, rect.height].map(|v| rounded(v) as f32);
    Rect::from_xywh(x, y, width, height).filter(|r| r.width() > 0.0 && r.height() > 0.0)
}

/// The part of a rectangle in which marks may leave ink.
fn seen(marks: &[Mark], clip: Rect) -> Option<NonZeroRect> {
    let extents = marks.iter().filter_map(|mark| match mark {
        Mark::Shape(shape) => extent(shape),
        Mark::Part(within, clip) => Some(seen(within, rectangle(*clip)?)?.to_rect()),
    });
    let all = extents.reduce(|a, b| {
        Rect::from_ltrb(
            a.left().min(b.left()),
            a.top().min(b.top()),
            a.right().max(b.right()),
            a.bottom().max(b.bottom()),
        )
        .unwrap_or(a)
    })?;
    all.intersect(&clip)?.to_non_zero_rect()
}

/// Where a shape may leave ink, on the page.
fn extent(shape: &Shape) -> Option<Rect> {
    let stroked = shape.stroke.as_ref().and_then(|(_, stroke)| {
        let solid = Stroke {
            dash: None,
            ..stroke.clone()
        };
        shape.path.stroke(&solid, 1.0)?.compute_tight_bounds()
    });
    stroked.or_else(|| shape.path.compute_tight_bounds())
}

/// Pixels beside the page on which something is drawn apart.
struct Layer {
    place: IntRect,
    /// From the drawing to these pixels.
    transform: Transform,
}

impl Layer {
    /// For what lies within an extent; two pixels more on every side hold the edges that are covered in part.
    fn new(extent: NonZeroRect, most: IntRect, transform: Transform) -> Option<Layer> {
        let extent = extent.transform(transform)?;
        let place = IntRect::from_xywh(
            (extent.x().floor() as i32).checked_sub(2)?,
            (extent.y().floor() as i32).checked_sub(2)?,
            (extent.width().ceil() as u32).checked_add(4)?,
            (extent.height().ceil() as u32).checked_add(4)?,
        )?;
        let place = IntRect::from_ltrb(
            place.left().max(most.left()),
            place.top().max(most.top()),
            place.right().min(most.right()),
            place.bottom().min(most.bottom()),
        )?;
        // As resvg has it, whose roundings place the same edges on the same pixels.
        let start = |at: f32, first: i32| at - (at - first as f32);
        let shift =
            Transform::from_translate(-start(extent.x(), place.x()), -start(extent.y(), place.y()));
        Some(Layer {
            place,
            transform: shift.pre_concat(transform),
        })
    }

    fn pixels(&self) -> Option<Pixmap> {
        Pixmap::new(self.place.width(), self.place.height())
    }

    /// Lays what was drawn apart over the page.
    fn join(&self, apart: &Pixmap, opacity: f32, pixels: &mut PixmapMut<'_>) {
        if opacity == 1.0 {
            return self.cover(apart, pixels);
        }
        let place = Transform::from_translate(self.place.x() as f32, self.place.y() as f32);
        let paint = Paint {
            shader: Pattern::new(
                apart.as_ref(),
                SpreadMode::Pad,
                FilterQuality::Bilinear,
                opacity,
                place,
            ),
            ..Paint::default()
        };
        let path = PathBuilder::from_rect(self.place.to_rect());
        pixels.fill_path(
            &path,
            &paint,
            FillRule::Winding,
            Transform::identity(),
            None,
        );
    }

    /// Likewise, as it is. Most pixels are full or clear, and no more is done for them than has to be.
    fn cover(&self, apart: &Pixmap, pixels: &mut PixmapMut<'_>) {
        let (left, top) = (self.place.left(), self.place.top());
        let (width, height) = (pixels.width() as i32, pixels.height() as i32);
        let columns = left.max(0)..self.place.right().min(width);
        let lines = top.max(0)..self.place.bottom().min(height);
        if columns.is_empty() {
            return;
        }
        let span = |row: i32, wide: u32, left: i32| {
            let start = row as usize * wide as usize + (columns.start - left) as usize;
            start..start + columns.len()
        };
        let page = pixels.pixels_mut();
        for y in lines {
            let above = &apart.pixels()[span(y - top, apart.width(), left)];
            let below = &mut page[span(y, width as u32, 0)];
            for (below, above) in below.iter_mut().zip(above) {
                match above.alpha() {
                    0 => {}
                    u8::MAX => *below = *above,
                    _ => *below = over(*above, *below),
                }
            }
        }
    }
}

/// A pixel that covers another in part, in the numbers in which the rasteriser reckons.
fn over(above: PremultipliedColorU8, below: PremultipliedColorU8) -> PremultipliedColorU8 {
    let unit = |byte: u8| f32::from(byte) * (1.0 / 255.0);
    let rest = 1.0 - unit(above.alpha());
    let mixed = |above: u8, below: u8| {
        let mixed = unit(below) * rest + unit(above);
        (mixed.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8
    };
    PremultipliedColorU8::from_rgba(
        mixed(above.red(), below.red()),
        mixed(above.green(), below.green()),
        mixed(above.blue(), below.blue()),
        mixed(above.alpha(), below.alpha()),
    )
    .unwrap_or(above)
}
