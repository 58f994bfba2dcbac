//! [`Label`]: a text in a figure, with its font, its font size and the positions that it prefers. The functions break a
//! label into lines and draw it.

use super::super::pen::Pen;
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::placement::{LabelRequest, Placed};
use crate::pictures::drawing::{Anchor, Colour, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, text};

/// Least font size, pixels.
pub(super) const MIN_SIZE: f64 = 9.0;
/// Largest number of lines of a name.
const MAX_LINES: usize = 3;
/// Distance of the lines of a name, as a multiple of the font size.
const LINE_PITCH: f64 = 1.1;
/// The prefix of a code point such as `U+05D0`. A code point is written for a character that no font contains.
const CODE_POINT_PREFIX: &str = "U+";
/// Height of a line, as a multiple of the font size.
pub(super) const LINE_HEIGHT: f64 = 0.96;

/// A label without a position yet.
pub(super) struct Label {
    /// The lines of text.
    pub lines: Vec<String>,
    pub face: Face,
    pub size: f64,
    pub class: &'static str,
    pub request: LabelRequest,
    /// The colour of the arrow to which the label belongs; `None` for plain text.
    pub colour: Option<Colour>,
    /// Whether the text below the frame mentions this name or amount. Such a label is always drawn.
    pub named: bool,
    /// The block that the label names; for the name of a robot, the block that the robot holds; `None` for an amount.
    /// The label must not lie inside another block, because it would seem to name that block.
    pub of: Option<BlockId>,
}

impl Label {
    /// Returns the rectangle of the label if it is drawn at its anchor.
    pub fn rect_at_anchor(&self) -> PageRect {
        let (width, height) = self.request.size;
        PageRect { at: self.request.anchor.moved(-0.5 * width, -0.5 * height), width, height }
    }
}

/// Creates a label with one line of text. Sets the size of `request` to the size of this line.
pub(super) fn label(words: String, face: Face, size: f64, class: &'static str, request: LabelRequest) -> Label {
    let size_of = (text::width(&words, face, size), LINE_HEIGHT * size);
    Label {
        request: LabelRequest { size: size_of, ..request },
        lines: vec![words],
        face,
        size,
        class,
        colour: None,
        named: false,
        of: None,
    }
}

/// Breaks a name into lines of at most `across` pixels if it is wider. A line ends between two words, or between two
/// characters that are spelled as code points (`U+05D0`). Returns the label unchanged if it would need too many lines
/// or if a word would be split.
pub(super) fn broken(label: Label, across: f64) -> Label {
    let name = label.lines.concat();
    if label.request.size.0 <= across {
        return label;
    }
    let (name, most) = if name.contains(CODE_POINT_PREFIX) {
        (name.replace(text::NO_BREAK, " "), 2 * MAX_LINES)
    } else {
        (name, MAX_LINES)
    };
    let lines = text::balanced(&name, label.face, label.size, across, most + 1);
    // `balanced` splits a word that is too wide for a line. A name with a split word is hard to read, so it stays in
    // one line.
    let whole = lines.join(" ").split(' ').eq(name.split_whitespace());
    if !whole || lines.len() > most {
        return label;
    }
    let widths = lines.iter().map(|l| text::width(l, label.face, label.size));
    let size = (widths.fold(0.0, f64::max), label.size * (LINE_HEIGHT + LINE_PITCH * (lines.len() - 1) as f64));
    let request = LabelRequest { size, ..label.request };
    Label { lines, request, ..label }
}

/// Draws a label at the position that was found for it, with a leader line if the position has one.
pub(super) fn drawn(pen: &Pen<'_>, label: &Label, placed: Placed) -> Group {
    let theme = &pen.context.options.theme;
    let mut group = Group::with_class(label.class);
    if let Some(leader) = placed.leader {
        // A thin grey line is not visible on a dark block. Therefore first draw a wider line in the page colour, which
        // lies below the grey line.
        let seam = Path::stroked(Outline::line(leader), Stroke::new(theme.page, 2.0));
        let line = Path::stroked(Outline::line(leader), Stroke::new(theme.faint, 0.7));
        group = group.with(seam.with_opacity(0.7)).with(line);
    }
    // A label does not cross outlines, so the whole label has one background colour.
    let below = pen.below(middle(placed.rect));
    let colour = theme.letters_on(below, label.colour);
    let halo = pen.context.lines_cross_names.then_some(below);
    lettered(group, label, middle(placed.rect), colour, halo)
}

/// Draws a label for which no free position was found. It is drawn at its anchor, over other shapes, so its letters
/// have a border in the colour of the background.
pub(super) fn drawn_over(pen: &Pen<'_>, label: &Label) -> Group {
    let below = pen.below(label.request.anchor);
    let colour = pen.context.options.theme.letters_on(below, label.colour);
    let group = Group::with_class(label.class);
    lettered(group, label, label.request.anchor, colour, Some(below))
}

/// Adds the text lines of a label to a group, centred at `middle`. If `halo` is a colour, the letters have a border of
/// this colour.
fn lettered(mut group: Group, label: &Label, middle: PagePoint, colour: Colour, halo: Option<Colour>) -> Group {
    let half = 0.5 * (label.lines.len() as f64 - 1.0);
    for (number, line) in label.lines.iter().enumerate() {
        let down = 0.36 + LINE_PITCH * (number as f64 - half);
        let at = middle.moved(0.0, down * label.size);
        let words = Text::new(at, line.as_str(), label.face, label.size, colour);
        let words = words.anchored(Anchor::Middle);
        group = group.with(match halo {
            Some(below) => words.with_halo(below, 1.5),
            None => words,
        });
    }
    group
}

/// Returns the centre of a rectangle.
pub(super) fn middle(rect: PageRect) -> PagePoint {
    rect.at.moved(rect.width / 2.0, rect.height / 2.0)
}
