//! [`ring`]: draws the colours of arrows as a colour wheel. Each sector states which blocks have its colour. The
//! colours of robots and of missing forces are below the wheel.

use core::f64::consts::TAU;

use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::{
    Anchor, Colour, Drawing, Face, Group, Item, Outline, PagePoint, Path, Segment, Stroke, Text, Theme,
};

/// Width of the page, pixels.
const PAGE_WIDTH: f64 = 360.0;
/// Inner and outer radius of the ring, pixels.
const RING_RADII: (f64, f64) = (58.0, 112.0);
/// Font size, pixels.
const FONT_SIZE: f64 = 14.0;

/// Draws the colour wheel of the forces on blocks. The sectors begin at the right with entry 0 of the theme's colours
/// and continue anticlockwise. Each sector states the numbers of the first two blocks with its colour. Blocks are
/// counted from 1 in placing order.
///
/// Units: the page is in pixels at natural size.
pub fn ring(theme: &Theme) -> Drawing {
    let centre = PagePoint::new(PAGE_WIDTH / 2.0, 30.0 + RING_RADII.1);
    let mut items: Vec<Item> = Vec::new();
    for entry in 0..theme.arrows.len() {
        items.push(labelled_sector(centre, entry, theme).into());
    }
    let line = |y: f64, words: &str| -> Item {
        let at = PagePoint::new(centre.x, y);
        Text::new(at, words, Face::Sans, FONT_SIZE, theme.faint).anchored(Anchor::Middle).into()
    };
    items.push(line(centre.y - 0.15 * FONT_SIZE, "forces on"));
    items.push(line(centre.y + 1.05 * FONT_SIZE, "blocks"));
    let mut y = centre.y + RING_RADII.1 + 40.0;
    items.extend(robots(PagePoint::new(centre.x, y), theme));
    y += 32.0;
    items.push(line(y, "robots, repeated in this order"));
    y += 30.0;
    let arrow = straight(PagePoint::new(centre.x - 34.0, y), (67.0, 0.0), 5.6);
    let failure =
        Group::with_class("failure").titled(format!("Missing forces have the colour {}", theme.failure.css()));
    items.push(failure.with(Path::filled(arrow, theme.failure)).into());
    y += 28.0;
    items.push(line(y, "missing forces: adhesion, friction or robot forces"));
    Drawing {
        width: PAGE_WIDTH,
        height: (y + 24.0).ceil(),
        title: "The colours of forces".into(),
        description: "All forces on a block have one colour; block i, in placing order from 1, takes entry i mod \
                      the number of colours, counted anticlockwise from the right."
            .into(),
        background: Some(theme.page),
        items,
    }
}

/// Draws the sector of a colour with the numbers of the first two blocks that have this colour. `entry` is the index of
/// the colour in the theme.
fn labelled_sector(centre: PagePoint, entry: usize, theme: &Theme) -> Group {
    let count = theme.arrows.len();
    let colour = theme.arrows[entry];
    let sweep = TAU / count as f64;
    let from = sweep * entry as f64;
    // With n colours, block i (from 1) has the colour with the index i mod n, so block 1 has the second colour.
    let first = if entry == 0 { count } else { entry };
    let blocks = format!("{first}, {}, …", first + count);
    let sector = Path::filled(sector(centre, from, sweep), colour);
    let middle = from + sweep / 2.0;
    let at = polar(centre, (RING_RADII.0 + RING_RADII.1) / 2.0, middle).moved(0.0, 0.36 * FONT_SIZE);
    let ink = theme.letters_on(colour, None);
    let words = Text::new(at, blocks.as_str(), Face::SansBold, 12.0, ink);
    Group::with_class("sector")
        .titled(format!("Blocks {blocks} have the colour {}", colour.css()))
        .with(sector.with_stroke(Stroke::new(theme.page, 2.0)))
        .with(words.anchored(Anchor::Middle))
}

/// Draws the discs of robots in a row, centred at `centre`.
fn robots(centre: PagePoint, theme: &Theme) -> Vec<Item> {
    let count = theme.robots.len() as f64;
    let disc = |(number, colour): (usize, &Colour)| {
        let x = (number as f64 - (count - 1.0) / 2.0) * 40.0;
        let disc = Path::filled(Outline::circle(centre.moved(x, 0.0), 13.0), *colour)
            .with_stroke(Stroke::new(colour.mixed(theme.ink, 0.35), 0.8));
        Group::with_class("robot").titled(format!("Robot {number} has the colour {}", colour.css())).with(disc).into()
    };
    theme.robots.iter().enumerate().map(disc).collect()
}

fn polar(centre: PagePoint, radius: f64, angle: f64) -> PagePoint {
    centre.moved(radius * libm::cos(angle), -radius * libm::sin(angle))
}

/// Returns the outline of a sector of the wheel. It begins at the angle `from` and extends over the angle `sweep`, in
/// radians anticlockwise. Its arcs are approximated by short straight lines.
fn sector(centre: PagePoint, from: f64, sweep: f64) -> Outline {
    let steps = 72;
    let angle = |step: i32| from + sweep * f64::from(step) / f64::from(steps);
    let outer = (0..=steps).map(|s| polar(centre, RING_RADII.1, angle(s)));
    let inner = (0..=steps).rev().map(|s| polar(centre, RING_RADII.0, angle(s)));
    let mut outline = Outline::line(outer.chain(inner));
    outline.segments.push(Segment::Close);
    outline
}
