//! [`Drawing`]: shapes and text on a page, without any mechanics.
//!
//! A page has its origin in the upper left corner, x to the right and y down, in pixels at natural size. [`Camera`] is
//! the one place at which the scene's upward y turns over. What is drawn later lies on top. Nothing here knows what a
//! force is, and nothing here knows a file format: `output` writes a drawing down.

pub mod arrow;
mod camera;
mod colour;
pub mod difference;
pub(crate) mod hatch;
mod outline;
pub(crate) mod placement;
pub(crate) mod ramp;
pub mod style;
pub(crate) mod symbol;
pub mod text;

pub use camera::Camera;
pub use colour::Colour;
pub use outline::{Outline, Segment};
pub use ramp::PLASMA;
pub use style::{Sizes, Theme, Widths};
pub use text::{Anchor, Face, Text};

/// A place on the page in pixels, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PagePoint {
    /// To the right.
    pub x: f64,
    /// Down.
    pub y: f64,
}

impl PagePoint {
    /// The point at (x, y).
    pub fn new(x: f64, y: f64) -> PagePoint {
        PagePoint { x, y }
    }

    /// The point moved right by `x` and down by `y`.
    pub fn moved(self, x: f64, y: f64) -> PagePoint {
        PagePoint {
            x: self.x + x,
            y: self.y + y,
        }
    }
}

/// An upright rectangle on the page.
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
    /// The part of a line inside the rectangle; `None` if the line does not meet the rectangle.
    pub(crate) fn part_of(self, [from, to]: [PagePoint; 2]) -> Option<[PagePoint; 2]> {
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        let along = (to.x - from.x, to.y - from.y);
        for (start, step, low, size) in [
            (from.x, along.0, self.at.x, self.width),
            (from.y, along.1, self.at.y, self.height),
        ] {
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

/// A picture: a page and what is on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Width of the page in pixels.
    pub width: f64,
    /// Height of the page in pixels.
    pub height: f64,
    /// What it shows, in a few words; read aloud and shown when hovering.
    pub title: String,
    /// What it shows, in sentences.
    pub description: String,
    /// Colour of the page, `None` for a transparent one.
    pub background: Option<Colour>,
    /// What is on the page, the lowest first.
    pub items: Vec<Item>,
}

/// One thing on a page.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A shape.
    Path(Path),
    /// A line of words.
    Text(Text),
    /// Several things that belong together.
    Group(Group),
}

/// A shape with its paint.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The shape. Rings that turn the other way cut holes (the nonzero rule).
    pub outline: Outline,
    /// Colour of its inside.
    pub fill: Option<Colour>,
    /// Line along its edge.
    pub stroke: Option<Stroke>,
    /// Whether the fill lies over the line, which then shows its outer half only.
    pub fill_last: bool,
    /// 0 invisible … 1 opaque.
    pub opacity: f64,
}

impl Path {
    /// A filled shape without a line.
    pub fn filled(outline: Outline, fill: Colour) -> Path {
        Path {
            outline,
            fill: Some(fill),
            stroke: None,
            fill_last: false,
            opacity: 1.0,
        }
    }

    /// A line without a fill.
    pub fn stroked(outline: Outline, stroke: Stroke) -> Path {
        Path {
            outline,
            fill: None,
            stroke: Some(stroke),
            fill_last: false,
            opacity: 1.0,
        }
    }

    /// The same shape with a line along its edge. The line lies above the fill.
    pub fn with_stroke(self, stroke: Stroke) -> Path {
        Path {
            stroke: Some(stroke),
            ..self
        }
    }

    /// The same shape with a border of `colour`, of which `width` pixels are visible outside the shape.
    pub fn cased(self, colour: Colour, width: f64) -> Path {
        Path {
            stroke: Some(Stroke::new(colour, 2.0 * width)),
            fill_last: true,
            ..self
        }
    }

    /// The same shape with an opacity from 0 to 1.
    pub fn with_opacity(self, opacity: f64) -> Path {
        Path { opacity, ..self }
    }
}

/// A line's paint.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width in pixels.
    pub width: f64,
    /// Lengths of dashes and gaps in turn, in pixels; empty for a continuous line.
    pub dash: Vec<f64>,
    /// How corners look.
    pub join: Join,
}

impl Stroke {
    /// A continuous line with round corners.
    pub fn new(colour: Colour, width: f64) -> Stroke {
        Stroke {
            colour,
            width,
            dash: Vec::new(),
            join: Join::Round,
        }
    }

    /// The same line, dashed.
    pub fn dashed(self, dash: impl Into<Vec<f64>>) -> Stroke {
        Stroke {
            dash: dash.into(),
            ..self
        }
    }

    /// The same line with sharp corners.
    pub fn mitred(self) -> Stroke {
        Stroke {
            join: Join::Miter,
            ..self
        }
    }
}

/// How a line turns a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    /// Rounded, ends too.
    Round,
    /// Pointed, ends square to the line.
    Miter,
}

/// Things that belong together, named for readers and programs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// A name that is unique in the drawing, or none.
    pub id: Option<String>,
    /// What kind of thing it is, for style sheets and scripts; empty for none.
    pub class: String,
    /// A short name, shown when hovering; empty for none.
    pub title: String,
    /// More about it; empty for none.
    pub description: String,
    /// Whether it only repeats what lies below it, for the eye alone: then it hides nothing from a hovering mouse or a
    /// screen reader.
    pub echo: bool,
    /// The part of the page within which it shows; everything where `None`.
    pub clip: Option<PageRect>,
    /// How the scene that it shows lies on the page, told to programs that read the drawing back; `None` for no scene.
    pub camera: Option<Camera>,
    /// What is in it, the lowest first.
    pub items: Vec<Item>,
}

impl Group {
    /// An empty group with a class and without a title.
    pub fn with_class(class: &str) -> Group {
        Group {
            class: class.to_owned(),
            ..Group::default()
        }
    }

    /// The same group with a title.
    pub fn titled(self, title: impl Into<String>) -> Group {
        Group {
            title: title.into(),
            ..self
        }
    }

    /// The same group with one more item on top.
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
