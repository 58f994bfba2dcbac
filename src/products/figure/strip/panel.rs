//! Draws a panel of a figure: the picture of a frame, and below it the caption, the verdict and the reason for the
//! verdict.

use super::super::dimension;
use super::super::label;
use super::super::legend::{self, Entry};
use super::super::option::ArrowScale;
use super::super::pen::Pen;
use super::super::verdict;
use super::Strip;
use crate::geometry::Bounds;
use crate::pictures::drawing::{Anchor, Camera, Face, Group, Item, PagePoint, Text, text};

/// Height of a line of a caption, as a multiple of its font size.
const CAPTION_LINE: f64 = 22.0 / 17.0;
/// Height of a line of the text below a verdict, as a multiple of its font size.
const REASON_LINE: f64 = 1.36;
/// Largest number of lines of a reason. Longer reasons end in "…".
const MAX_REASON_LINES: usize = 12;
/// Gap between the symbol of a verdict and its text, pixels.
const MARK_GAP: f64 = 6.0;
/// Gap between the text of a verdict and the scale of arrows, pixels.
const SCALE_GAP: f64 = 22.0;

/// The position of a panel, the part of the scene that it shows, and the space for its caption.
pub(super) struct PanelPosition {
    /// The upper left corner of the panel.
    pub at: PagePoint,
    /// The part of the scene that the picture shows, metres.
    pub view: Bounds,
    /// The number of caption lines for which there is space below the picture.
    pub captions: usize,
}

impl Strip<'_> {
    /// Draws the panel of a frame: picture, caption, verdict and reason. Also returns the y coordinate below the panel,
    /// pixels.
    pub(super) fn panel(&self, frame: usize, place: PanelPosition) -> (Group, f64) {
        let (context, layout) = (self.context, self.layout);
        let (view, at) = (place.view, place.at);
        let frame_analysis = &context.analysis.frames[frame];
        let aside = (layout.panel - view.width() * layout.scale) / 2.0;
        let camera = Camera::new(view, at.moved(aside, 0.0), layout.scale);
        let mut group = Group { id: Some(format!("frame-{}", frame + 1)), ..Group::with_class("frame") };
        let word = if context.options.verdicts { verdict::word(frame_analysis.verdict) } else { "no verdict is shown" };
        group.title = self.labelled(frame, ": ", word);
        let picture = self.content.picture(&Pen::new(context, frame, &camera), view);
        let cramped = without_room(&picture);
        group = group.with(picture);
        let mut below = PagePoint::new(at.x + layout.panel / 2.0, at.y + view.height() * layout.scale);
        if context.options.dimensions {
            group = group.with(dimension::lines(context, frame, view, &camera));
            below.y += dimension::SPACE_BELOW;
        }
        let (lines, mut below) = self.caption_at(frame, below, place.captions);
        group.items.extend(lines);
        if context.options.verdicts || context.options.keys {
            below.y += 8.0;
            let half = context.options.theme.sizes.verdict * 10.0 / 13.5;
            let (symbols, more) = self.verdict(frame, below.moved(0.0, half));
            group.items.extend(symbols);
            below.y += 2.2 * half + more;
            let (lines, end) = self.reason(frame, below, cramped);
            group.items.extend(lines);
            below = end;
        }
        (group, below.y)
    }

    /// Writes the caption of a frame below the point `top`. Space for `captions` lines is reserved, even if the caption
    /// has fewer lines. Also returns the point below this space.
    fn caption_at(&self, frame: usize, top: PagePoint, captions: usize) -> (Vec<Item>, PagePoint) {
        let theme = &self.context.options.theme;
        let (size, line_height) = (theme.sizes.caption, CAPTION_LINE * theme.sizes.caption);
        let mut y = top.y;
        y += if captions > 0 { 10.0 } else { 0.0 };
        let mut items = Vec::new();
        for (number, line) in self.caption_lines(frame).into_iter().enumerate() {
            let below = size * 5.0 / 17.0;
            let at = PagePoint::new(top.x, y + (number + 1) as f64 * line_height - below);
            let words = Text::new(at, line, Face::Serif, size, theme.ink);
            items.push(words.anchored(Anchor::Middle).into());
        }
        (items, PagePoint::new(top.x, y + captions as f64 * line_height))
    }

    /// Draws the symbol and the text of a verdict, followed by the scale of arrows, in one line centred at `centre`. If
    /// the panel is too narrow, the scale is on a second line. Also returns the height of the second line in pixels, or
    /// 0.
    fn verdict(&self, frame: usize, centre: PagePoint) -> (Vec<Item>, f64) {
        let options = self.context.options;
        let theme = &options.theme;
        let size = theme.sizes.verdict;
        let (word, _) = self.headline(frame);
        let wide = text::width(&word, Face::SansBold, size);
        let lead = if options.verdicts { 2.0 * mark_radius(size) + MARK_GAP + wide + SCALE_GAP } else { 0.0 };
        let scale = self.scale_of_panel(frame);
        let scale_width = scale.as_ref().map_or(0.0, |scale| legend::widest(std::slice::from_ref(scale), theme));
        let alone = (lead - SCALE_GAP).max(0.0);
        let stacked = scale.is_some() && alone > 0.0 && lead + scale_width > self.layout.panel;
        let total = if scale.is_none() || stacked { alone } else { lead + scale_width };
        let start = centre.moved(-total / 2.0, 0.0);
        let mut items: Vec<Item> = Vec::new();
        if options.verdicts {
            items.extend(self.marked_verdict(frame, word, start));
        }
        let below = if stacked { 1.7 * size } else { 0.0 };
        if let Some(scale) = scale {
            let at = if stacked { centre.moved(-scale_width / 2.0, below) } else { start.moved(lead, 0.0) };
            items.extend(legend::single(&scale, at, theme));
        }
        (items, below)
    }

    /// Returns the legend entry for the scale of arrows of a panel. Returns `None` if all panels have the same scale,
    /// if there is no legend, or if the panel shows no arrows, for example because they are too small.
    fn scale_of_panel(&self, frame: usize) -> Option<Entry> {
        let (context, options) = (self.context, self.context.options);
        let too_small = context.arrows_too_small(self.layout.scale);
        if options.scale != ArrowScale::Panel || !options.keys || too_small {
            return None;
        }
        let marks = &context.marks[frame];
        let unit = self.layout.scale * context.unit;
        let units = self.context.analysis.scene.units;
        legend::scale(marks.newtons_per_unit, marks.largest(), unit, options, units)
    }

    /// Draws the symbol of a verdict and the text `words` to its right. `start` is the middle of the left edge of the
    /// symbol.
    fn marked_verdict(&self, frame: usize, words: String, start: PagePoint) -> [Item; 2] {
        let theme = &self.context.options.theme;
        let frame_analysis = &self.context.analysis.frames[frame];
        let size = theme.sizes.verdict;
        let radius = mark_radius(size);
        let colour = verdict::badge_colour(frame_analysis, theme);
        let centre = start.moved(radius, 0.0);
        let at = start.moved(2.0 * radius + MARK_GAP, 0.35 * size);
        [
            verdict::mark_in(colour, frame_analysis.verdict, centre, radius, theme).into(),
            Text::new(at, words, Face::SansBold, size, colour).into(),
        ]
    }

    /// Writes the reason for a verdict below the point `top`. Notes follow it: on arrows that are too small to be
    /// visible, and on labels without space (`cramped`). Also returns the point below the text.
    fn reason(&self, frame: usize, top: PagePoint, cramped: Option<String>) -> (Vec<Item>, PagePoint) {
        let (context, layout) = (self.context, self.layout);
        let theme = &context.options.theme;
        let reason = if context.options.verdicts {
            let said = [self.headline(frame).1, Some(context.statements[frame].clone())];
            let said = said.into_iter().flatten().filter(|words| !words.is_empty());
            said.collect::<Vec<String>>().join("; ")
        } else {
            String::new()
        };
        let size = theme.sizes.reason;
        let broken = |words: &str, most| text::sentence_lines(words, Face::Sans, size, layout.panel, most);
        let unseen = context.marks[frame].unseen(context.unit, layout.scale, context.analysis.scene.units);
        let unseen = unseen.filter(|_| !context.arrows_too_small(layout.scale));
        let notes: Vec<String> = unseen.into_iter().chain(cramped).collect();
        let joined = notes.join("; ");
        // Two notes share a line if it has room for both.
        let notes = if text::width(&joined, Face::Sans, size) <= layout.panel { vec![joined.clone()] } else { notes };
        let notes = notes.iter().filter(|note| !note.is_empty());
        let notes = notes.flat_map(|note| broken(note, 2));
        let mut lines = broken(&reason, MAX_REASON_LINES);
        lines.extend(notes);
        if context.options.is_column() && !reason.is_empty() && !joined.is_empty() {
            let together = broken(&format!("{reason}; {joined}"), MAX_REASON_LINES);
            lines = if together.len() < lines.len() { together } else { lines };
        }
        let mut items = Vec::new();
        let mut y = top.y;
        for line in lines {
            y += REASON_LINE * size;
            let at = PagePoint::new(top.x, y - 0.32 * size);
            let words = Text::new(at, line, Face::Sans, size, theme.faint);
            items.push(words.anchored(Anchor::Middle).into());
        }
        (items, PagePoint::new(top.x, y))
    }
}

/// Returns the radius of the symbol of a verdict, in pixels. `size` is the font size of the verdict.
fn mark_radius(size: f64) -> f64 {
    size * 7.5 / 13.5
}

/// Returns the note on labels for which the picture has no space, such as `no room for 2 names`. Returns `None` if
/// there are no such labels.
fn without_room(picture: &Group) -> Option<String> {
    let groups = picture.items.iter().filter_map(|item| match item {
        Item::Group(group) if group.class == label::CLASS => Some(group.description.clone()),
        _ => None,
    });
    groups.into_iter().find(|labelled| !labelled.is_empty())
}
