//! [`shapes`]: draws an overview of shapes that consist of lattice cells. Each shape is drawn with its name, the lines
//! between its cells, and its origin.

use super::design::SCREEN_MARGIN;
use super::stage::seams;
use crate::geometry::{Bounds, Cell, Lattice, LatticeKind, Point};
use crate::mechanics::scene::{Body, shape};
use crate::pictures::drawing::{Anchor, Camera, Drawing, Face, Group, Outline, PagePoint, Path, Stroke, Text, Theme};

/// Length of the side of a lattice cell, pixels.
const UNIT_LENGTH: f64 = 46.0;
/// Largest width of a row of shapes, pixels.
const MAX_ROW_WIDTH: f64 = 900.0;

/// Draws an overview of the built-in shapes on the triangular lattice.
pub fn shapes(theme: &Theme) -> Drawing {
    let lattice = Lattice { kind: LatticeKind::Triangular, side: 1.0 };
    let named = shape::BUILT_IN.map(|name| (name, shape::cells(name).unwrap_or_default()));
    sheet(lattice, &named, theme)
}

/// A shape of the sheet.
struct SheetShape<'n> {
    name: &'n str,
    body: Body,
    /// The shown part around the shape and its origin, metres.
    view: Bounds,
}

impl<'n> SheetShape<'n> {
    /// Creates a shape from lattice cells; `None` if the cells do not form a valid polygon.
    fn new(lattice: Lattice, name: &'n str, cells: &[Cell]) -> Option<SheetShape<'n>> {
        let polygon = lattice.polygon(cells)?;
        let origin = Bounds { min: Point::origin(), max: Point::origin() };
        let view = polygon.bounds().union(origin).grown(0.12 * lattice.side);
        let body = Body {
            polygon,
            circle: None,
            cells: Some(cells.to_vec()),
            material: None,
            friction: 0.0,
            fill: None,
            gap: 0.0,
            rounding: 0.0,
            is_schematic: false,
        };
        Some(SheetShape { name, body, view })
    }

    /// Draws the outline of the shape, the lines between its cells, and a small cross at its origin. Its name is
    /// centred at `caption`.
    fn draw(&self, lattice: Lattice, camera: &Camera, caption: PagePoint, theme: &Theme) -> Group {
        let fill = theme.amplitude(0.02);
        let outline = camera.polygon(&self.body.polygon);
        let seam = Stroke::new(theme.seam_on(fill, 0.35), 1.0);
        let seams = seams(&self.body, Some(lattice), camera);
        let origin = camera.place(Point::origin());
        let arm = |dx: f64, dy: f64| Outline::line([origin.moved(-dx, -dy), origin.moved(dx, dy)]);
        let mut cross = arm(5.0, 0.0);
        cross.extend(arm(0.0, 5.0));
        let count = self.body.cells.as_ref().map_or(0, Vec::len);
        let size = theme.sizes.caption;
        let name = Text::new(caption, self.name, Face::Serif, size, theme.ink);
        Group::with_class("shape")
            .titled(format!("{}: {count} cells", self.name))
            .with(Path::filled(outline.clone(), fill))
            .with(Path::stroked(seams, seam))
            .with(Path::stroked(outline, Stroke::new(theme.outline, 1.5)))
            .with(Path::stroked(cross.clone(), Stroke::new(theme.page, 4.0)))
            .with(Path::stroked(cross, Stroke::new(theme.failure, 1.8)))
            .with(name.anchored(Anchor::Middle))
    }
}

/// Draws all shapes: for each of them its outline, the lines between its cells, and a small cross at its lattice
/// origin. The key `at` of a block in a scene file is the position of this origin.
fn sheet(lattice: Lattice, named: &[(&str, Vec<Cell>)], theme: &Theme) -> Drawing {
    let shapes = named.iter();
    let shapes = shapes.filter_map(|(name, cells)| SheetShape::new(lattice, name, cells));
    let shapes: Vec<SheetShape<'_>> = shapes.collect();
    let scale = UNIT_LENGTH / lattice.side;
    // The shapes of a row are on the same baseline. The tallest shape of the sheet determines the height of all rows.
    let heights = shapes.iter().map(|shape| shape.view.height() * scale);
    let tallest = heights.fold(0.0, f64::max);
    let mut items = Vec::new();
    let (mut x, mut y, mut widest) = (SCREEN_MARGIN, SCREEN_MARGIN, 0.0_f64);
    for shape in &shapes {
        let (wide, high) = (shape.view.width() * scale, shape.view.height() * scale);
        let width = wide.max(100.0);
        if x > SCREEN_MARGIN && x + width > MAX_ROW_WIDTH {
            (x, y) = (SCREEN_MARGIN, y + tallest + 64.0);
        }
        let at = PagePoint::new(x + (width - wide) / 2.0, y + tallest - high);
        let camera = Camera::new(shape.view, at, scale);
        let caption = PagePoint::new(x + width / 2.0, y + tallest + 26.0);
        items.push(shape.draw(lattice, &camera, caption, theme).into());
        x += width + 36.0;
        widest = widest.max(x - 36.0);
    }
    let note = PagePoint::new(SCREEN_MARGIN, y + tallest + 62.0);
    let words = "The cross is the shape's origin: the lattice point that “at” names.";
    items.push(Text::new(note, words, Face::Sans, theme.sizes.key, theme.faint).into());
    Drawing {
        width: (widest.max(420.0) + SCREEN_MARGIN).ceil(),
        height: (note.y + SCREEN_MARGIN - 8.0).ceil(),
        title: "Built-in shapes".into(),
        description: "Outlines of the shapes, the seams between their cells, and their origins.".into(),
        background: Some(theme.page),
        items,
    }
}
