//! [`shapes`]: draws a sheet of shapes made of lattice cells, with their names, the lines between their cells, and
//! their origins.

use super::layout::MAX_MARGIN;
use super::pen::seams;
use crate::drawing::{
    Anchor, Camera, Drawing, Face, Group, Outline, PagePoint, Path, Stroke, Text, Theme,
};
use crate::geometry::{Bounds, Cell, Lattice, LatticeKind, Point};
use crate::scene::{Body, shape};

const UNIT: f64 = 46.0;
const ACROSS: f64 = 900.0;

/// Draws a sheet of the built-in shapes of the triangular lattice.
pub fn shapes(theme: &Theme) -> Drawing {
    let lattice = Lattice {
        kind: LatticeKind::Triangular,
        side: 1.0,
    };
    let named = shape::BUILT_IN.map(|name| (name, shape::cells(name).unwrap_or_default()));
    sheet(lattice, &named, theme)
}

/// Draws each named set of cells: its outline, the lines between its cells, and a small cross at its lattice origin.
/// The key `at` of a scene is the position of this origin.
fn sheet(lattice: Lattice, named: &[(&str, Vec<Cell>)], theme: &Theme) -> Drawing {
    let mut sheet = Vec::new();
    for (name, cells) in named {
        let Some(polygon) = lattice.polygon(cells) else {
            continue;
        };
        let origin = Bounds {
            min: Point::origin(),
            max: Point::origin(),
        };
        let view = polygon.bounds().union(origin).grown(0.12 * lattice.side);
        sheet.push((
            name,
            Body {
                polygon,
                cells: Some(cells.clone()),
                material: None,
                friction: 0.0,
                fill: None,
                gap: 0.0,
                rounding: 0.0,
            },
            view,
        ));
    }
    let scale = UNIT / lattice.side;
    let mut items = Vec::new();
    let (mut x, mut y, mut height, mut widest) = (MAX_MARGIN, MAX_MARGIN, 0.0_f64, 0.0_f64);
    for (name, body, view) in &sheet {
        let width = (view.width() * scale).max(100.0);
        if x > MAX_MARGIN && x + width > ACROSS {
            (x, y, height) = (MAX_MARGIN, y + height + 64.0, 0.0);
        }
        // The shapes of a row are on the same baseline. The tallest shape of the sheet determines the height of all
        // rows.
        let tallest = sheet
            .iter()
            .map(|s| s.2.height() * scale)
            .fold(0.0, f64::max);
        let at = PagePoint::new(
            x + (width - view.width() * scale) / 2.0,
            y + tallest - view.height() * scale,
        );
        let camera = Camera::new(*view, at, scale);
        let fill = theme.amplitude(0.02);
        let outline = camera.polygon(&body.polygon);
        let seam = Stroke::new(theme.seam_on(fill, 0.35), 1.0);
        let origin = camera.place(Point::origin());
        let arm = |dx: f64, dy: f64| Outline::line([origin.moved(-dx, -dy), origin.moved(dx, dy)]);
        let mut cross = arm(5.0, 0.0);
        cross.extend(arm(0.0, 5.0));
        let caption = PagePoint::new(x + width / 2.0, y + tallest + 26.0);
        let shape = Group::with_class("shape")
            .titled(format!(
                "{name}: {} cells",
                body.cells.as_ref().map_or(0, Vec::len)
            ))
            .with(Path::filled(outline.clone(), fill))
            .with(Path::stroked(seams(body, Some(lattice), &camera), seam))
            .with(Path::stroked(outline, Stroke::new(theme.outline, 1.5)))
            .with(Path::stroked(cross.clone(), Stroke::new(theme.page, 4.0)))
            .with(Path::stroked(cross, Stroke::new(theme.failure, 1.8)))
            .with(
                Text::new(caption, **name, Face::Serif, theme.sizes.caption, theme.ink)
                    .anchored(Anchor::Middle),
            );
        items.push(shape.into());
        x += width + 36.0;
        height = height.max(tallest);
        widest = widest.max(x - 36.0);
    }
    let note = PagePoint::new(MAX_MARGIN, y + height + 62.0);
    let words = "The cross is the shape's origin: the lattice point that “at” names.";
    items.push(Text::new(note, words, Face::Sans, theme.sizes.key, theme.faint).into());
    Drawing {
        width: (widest.max(420.0) + MAX_MARGIN).ceil(),
        height: (note.y + MAX_MARGIN - 8.0).ceil(),
        title: "Built-in shapes".into(),
        description: "Outlines of the shapes, the seams between their cells, and their origins."
            .into(),
        background: Some(theme.page),
        items,
    }
}
