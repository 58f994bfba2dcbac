//! [`Drawing`]: a page with shapes and text.
//!
//! The origin of a page is its upper left corner; x points right and y points down, in pixels. Only [`Camera`] converts
//! from the scene, where y points up. Later items lie on top of earlier items. This module does not use forces or file
//! formats; `output` converts a drawing to SVG, PNG and other formats.

mod advance;
pub mod arrow;
mod camera;
mod colour;
pub mod difference;
mod outline;
pub(crate) mod ramp;
pub mod style;
pub(crate) mod symbol;
pub mod text;

pub use camera::Camera;
pub use colour::Colour;
pub(crate) use outline::hatch;
pub use outline::{Outline, Segment};
pub use ramp::PLASMA;
pub use style::{Sizes, Theme, Widths};
pub use text::{Anchor, Face, Text};

/// A position on the page, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PagePoint {
    /// Distance from the left edge of the page.
    pub x: f64,
    /// Distance from the top of the page.
    pub y: f64,
}

impl PagePoint {
    /// Creates the point (x, y).
    pub fn new(x: f64, y: f64) -> PagePoint {
        PagePoint { x, y }
    }

    /// Returns the point moved right by `x` and down by `y` pixels.
    pub fn moved(self, x: f64, y: f64) -> PagePoint {
        PagePoint { x: self.x + x, y: self.y + y }
    }

    /// Returns the distance of another point, pixels.
    pub(crate) fn distance(self, other: PagePoint) -> f64 {
        libm::hypot(other.x - self.x, other.y - self.y)
    }
}

/// A rectangle on the page whose sides are parallel to the sides of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageRect {
    /// Upper left corner.
    pub at: PagePoint,
    /// Width in pixels.
    pub width: f64,
    /// Height in pixels.
    pub height: f64,
}

impl PageRect {
    /// Returns the part of a line segment that lies inside the rectangle, or `None` if there is no such part.
    pub(crate) fn part_of(self, [from, to]: [PagePoint; 2]) -> Option<[PagePoint; 2]> {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        let along = (to.x - from.x, to.y - from.y);
        for (start, step, low, size) in
            [(from.x, along.0, self.at.x, self.width), (from.y, along.1, self.at.y, self.height)]
        {
            if step == 0.0 {
                if start < low || start > low + size {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - start) / step, (low + size - start) / step);
            enters = enters.max(a.min(b));
            leaves = leaves.min(a.max(b));
        }
        let at = |share: f64| from.moved(share * along.0, share * along.1);
        (enters < leaves).then(|| [at(enters), at(leaves)])
    }
}

/// A page and its items.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Width of the page in pixels.
    pub width: f64,
    /// Height of the page in pixels.
    pub height: f64,
    /// A short title, for screen readers and mouse hover.
    pub title: String,
    /// A description in sentences.
    pub description: String,
    /// Colour of the page; `None` for a transparent page.
    pub background: Option<Colour>,
    /// The items on the page, the lowest first.
    pub items: Vec<Item>,
}

/// An item of a page.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A shape.
    Path(Path),
    /// A line of text.
    Text(Text),
    /// Several items that belong together.
    Group(Group),
}

impl Item {
    /// Returns the same item moved right by `x` and down by `y` pixels.
    pub(crate) fn moved(self, x: f64, y: f64) -> Item {
        match self {
            Item::Path(path) => Item::Path(Path { outline: path.outline.moved(x, y), ..path }),
            Item::Text(text) => Item::Text(Text { at: text.at.moved(x, y), ..text }),
            Item::Group(group) => Item::Group(Group {
                camera: group.camera.map(|camera| camera.moved(x, y)),
                clip: group.clip.map(|clip| PageRect { at: clip.at.moved(x, y), ..clip }),
                items: group.items.into_iter().map(|item| item.moved(x, y)).collect(),
                ..group
            }),
        }
    }
}

/// A shape with its paint.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The shape. It is filled by the nonzero rule: rings that turn in the opposite direction cut holes.
    pub outline: Outline,
    /// The fill colour; `None` for no fill.
    pub fill: Option<Colour>,
    /// The line along the outline; `None` for no line.
    pub stroke: Option<Stroke>,
    /// Whether the fill covers the line, so that only the outer half of the line is visible.
    pub fill_last: bool,
    /// Opacity from 0 (invisible) to 1 (opaque).
    pub opacity: f64,
}

impl Path {
    /// Creates a filled shape without a line along its outline.
    pub fn filled(outline: Outline, fill: Colour) -> Path {
        Path { outline, fill: Some(fill), stroke: None, fill_last: false, opacity: 1.0 }
    }

    /// Creates a line along the outline, without a fill.
    pub fn stroked(outline: Outline, stroke: Stroke) -> Path {
        Path { outline, fill: None, stroke: Some(stroke), fill_last: false, opacity: 1.0 }
    }

    /// Returns the same path with a line along its outline. The line is drawn over the fill, unless
    /// [`Path::fill_last`] is true.
    pub fn with_stroke(self, stroke: Stroke) -> Path {
        Path { stroke: Some(stroke), ..self }
    }

    /// Returns the same shape with a border of this colour. `width` is the visible width of the border outside the
    /// shape, in pixels.
    pub fn cased(self, colour: Colour, width: f64) -> Path {
        Path { stroke: Some(Stroke::new(colour, 2.0 * width)), fill_last: true, ..self }
    }

    /// Returns the same shape with an opacity from 0 to 1.
    pub fn with_opacity(self, opacity: f64) -> Path {
        Path { opacity, ..self }
    }
}

/// The colour, width and form of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width in pixels.
    pub width: f64,
    /// Lengths of dashes and gaps in turn, in pixels; empty for a continuous line.
    pub dash: Vec<f64>,
    /// The form of corners and ends.
    pub join: Join,
}

impl Stroke {
    /// Creates the stroke of a continuous line with round corners and ends; `width` is in pixels.
    pub fn new(colour: Colour, width: f64) -> Stroke {
        Stroke { colour, width, dash: Vec::new(), join: Join::Round }
    }

    /// Returns the same stroke with dashes. `dash` contains the lengths of dashes and gaps in turn, in pixels.
    pub fn dashed(self, dash: impl Into<Vec<f64>>) -> Stroke {
        Stroke { dash: dash.into(), ..self }
    }

    /// Returns the same stroke with sharp corners and flat ends instead of round ones.
    pub fn mitred(self) -> Stroke {
        Stroke { join: Join::Miter, ..self }
    }
}

/// The form of the corners and ends of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    /// Round corners and round ends.
    Round,
    /// Sharp corners, and ends cut at a right angle.
    Miter,
}

/// Items that belong together, with names for readers and programs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// An id that is unique in the drawing, or `None`.
    pub id: Option<String>,
    /// The class, for style sheets and scripts; may be empty.
    pub class: String,
    /// A short name, shown on mouse hover; may be empty.
    pub title: String,
    /// A longer description; may be empty.
    pub description: String,
    /// Whether the group only repeats visible items below it. Mouse hover and screen readers ignore such a group.
    pub echo: bool,
    /// The rectangle to which the group is clipped; `None` for no clipping.
    pub clip: Option<PageRect>,
    /// The camera of the scene that the group shows, for programs that read the drawing; `None` for no scene.
    pub camera: Option<Camera>,
    /// Its items, the lowest first.
    pub items: Vec<Item>,
}

impl Group {
    /// Creates an empty group without a title. `class` is its class for style sheets and scripts.
    pub fn with_class(class: &str) -> Group {
        Group { class: class.to_owned(), ..Group::default() }
    }

    /// Returns the same group with a title, which is shown on mouse hover.
    pub fn titled(self, title: impl Into<String>) -> Group {
        Group { title: title.into(), ..self }
    }

    /// Returns the same group with one more item, drawn on top of the others.
    pub fn with(mut self, item: impl Into<Item>) -> Group {
        self.items.push(item.into());
        self
    }
}

impl From<Path> for Item {
    fn from(path: Path) -> Item {
        Item::Path(path)
    }
}

impl From<Text> for Item {
    fn from(text: Text) -> Item {
        Item::Text(text)
    }
}

impl From<Group> for Item {
    fn from(group: Group) -> Item {
        Item::Group(group)
    }
}
