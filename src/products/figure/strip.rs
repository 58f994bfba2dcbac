//! [`Strip`]: draws a page of panels, one per frame, each with its caption and verdict, and one legend below all
//! panels. [`PanelContent`] draws the content of a panel.

use super::arrow::{ArrowKind, ForceArrow};
use super::content::PanelContent;
use super::context::FigureContext;
use super::dimension;
use super::label;
use super::layout::{Layout, PRINT_COLUMN};
use super::legend;
use super::option::{ArrowScale, Options};
use super::title;
use super::verdict;
use super::words::{counted, letter, quantity};
use crate::analysis::Analysis;
use crate::drawing::{
    Anchor, Camera, Drawing, Face, Group, Item, Outline, PagePoint, Path, Stroke, Text, text,
};
use crate::geometry::{Bounds, Point};

/// Height of a line of a caption, as a multiple of its font size.
const CAPTION_LINE: f64 = 22.0 / 17.0;
/// Height of a line of the text below a verdict, as a multiple of its font size.
const REASON_LINE: f64 = 1.36;
/// Space for names around a panel if names need it: on both sides, and above and below, pixels.
const SPACE_FOR_NAMES: (f64, f64) = (24.0, 30.0);
/// Longer captions and texts are cut with an ellipsis.
const MAX_CAPTION_LINES: usize = 8;
const MAX_REASON_LINES: usize = 12;
/// Largest number of frames in the description of a figure.
const MAX_DESCRIBED_FRAMES: usize = 30;

/// Draws a figure with a panel of this content for each frame.
pub(crate) fn strip(
    analysis: &Analysis,
    content: &'static dyn PanelContent,
    options: &Options,
) -> Drawing {
    let context = FigureContext::new(analysis, options, content);
    let count = analysis.frames.len();
    let drawn = |context: &FigureContext<'_>| {
        let layout = Layout::new(context, count);
        let strip = Strip {
            content,
            context,
            layout,
            captions: None,
            alike: false,
        };
        (strip.drawing(), context.cramped.get(), layout.scale)
    };
    let (drawing, cramped, scale) = drawn(&context);
    if cramped == 0 || options.zoom.is_some() || scale <= 0.0 {
        return drawing;
    }
    // Some names do not fit into their blocks. Draw the figure again with space around the structure, and keep it if
    // this helps at least half of these names.
    let (across, up) = SPACE_FOR_NAMES;
    let roomy = context.with_room(across / scale, up / scale);
    let (roomier, still, _) = drawn(&roomy);
    if 2 * still <= cramped {
        roomier
    } else {
        drawing
    }
}

/// Draws the panels of [`strip`] for these frames, each on a page of its own. All pages have the same size and scale,
/// as an animation needs.
pub(crate) fn pages(
    analysis: &Analysis,
    content: &'static dyn PanelContent,
    options: &Options,
    frames: impl Iterator<Item = usize>,
) -> Vec<Drawing> {
    let steps = frames.map(|frame| (frame, options.way));
    steps_of(analysis, content, options, steps)
}

/// Like [`pages`], for pairs of a frame and the share of their paths (0 to 1) by which its blocks are displaced.
pub(crate) fn steps_of(
    analysis: &Analysis,
    content: &'static dyn PanelContent,
    options: &Options,
    steps: impl Iterator<Item = (usize, f64)>,
) -> Vec<Drawing> {
    let mut context = FigureContext::new(analysis, options, content);
    let mut pages: Vec<Drawing> = Vec::new();
    for (frame, way) in steps {
        context.go(way);
        let strip = Strip {
            content,
            context: &context,
            layout: Layout::new(&context, 1),
            captions: None,
            alike: true,
        };
        pages.push(page(&[&strip], &[(0, frame)], &analysis.scene.title));
    }
    let highest = pages.iter().map(|p| p.height).fold(0.0, f64::max);
    for page in &mut pages {
        page.height = highest;
    }
    pages
}

/// Draws the panels of [`strip`] on several pages at one scale. A page has as many rows as fit if it is at most `high`
/// times as high as wide, but at least one.
pub(crate) fn split(
    analysis: &Analysis,
    content: &'static dyn PanelContent,
    options: &Options,
    high: f64,
) -> Vec<Drawing> {
    let context = FigureContext::new(analysis, options, content);
    let count = analysis.frames.len();
    let layout = Layout::roomy(&context, count);
    let strip = Strip {
        content,
        context: &context,
        layout,
        captions: None,
        alike: false,
    };
    let order: Vec<(usize, usize)> = (0..count).map(|frame| (0, frame)).collect();
    let drawn = |order: &[(usize, usize)]| page(&[&strip], order, &analysis.scene.title);
    let mut pages = Vec::new();
    let mut rest = &order[..];
    while !rest.is_empty() {
        let mut taken = layout.columns.min(rest.len());
        let mut page = drawn(&rest[..taken]);
        while taken < rest.len() {
            let more = (taken + layout.columns).min(rest.len());
            let next = drawn(&rest[..more]);
            if next.height > high * next.width {
                break;
            }
            (taken, page) = (more, next);
        }
        pages.push(page);
        rest = &rest[taken..];
    }
    pages
}

/// Gaps between the parts of a page, pixels.
struct Gaps {
    below_title: f64,
    above_rule: f64,
    below_rule: f64,
    /// Height of a line of the legend, as a multiple of its font size.
    key_line: f64,
}

impl Gaps {
    /// Returns the gaps of a page. They are smaller on a page as wide as a column of print, so that text does not fill
    /// half of it.
    fn new(width: Option<f64>) -> Gaps {
        match width.is_some_and(|width| width < PRINT_COLUMN) {
            true => Gaps {
                below_title: 10.0,
                above_rule: 11.0,
                below_rule: 4.0,
                key_line: legend::NARROW_LINE,
            },
            false => Gaps {
                below_title: 18.0,
                above_rule: 20.0,
                below_rule: 8.0,
                key_line: legend::LINE,
            },
        }
    }
}

/// A strip of panels of one kind.
pub(crate) struct Strip<'a> {
    pub content: &'static dyn PanelContent,
    pub context: &'a FigureContext<'a>,
    pub layout: Layout,
    /// Captions of the frames, instead of their letters and titles.
    pub captions: Option<&'a [String]>,
    /// Whether every panel shows the part of the scene that all panels need together, as in an animation.
    pub alike: bool,
}

/// Draws a page of panels with one legend below them. `order` gives the index of the strip and the frame of each panel.
/// All strips have one layout. The structures of a row are on one level.
pub(crate) fn page(strips: &[&Strip<'_>], order: &[(usize, usize)], heading: &str) -> Drawing {
    let Some(first) = strips.first() else {
        return Drawing::default();
    };
    let (options, layout) = (first.context.options, first.layout);
    let theme = &options.theme;
    let entries = legend::joined(strips.iter().map(|strip| strip.entries()).collect(), theme);
    let margin = layout.margin;
    let gaps = Gaps::new(options.width);
    // A narrow picture gets a page wide enough for its words.
    let inner = match options.width {
        Some(width) => (width - 2.0 * margin).max(1.0),
        None => layout
            .content
            .max(legend::widest(&entries, theme).min(640.0))
            .max(300.0),
    };
    let fitted = |entry: legend::Entry| entry.fitted(inner, theme);
    let entries: Vec<legend::Entry> = entries.into_iter().map(fitted).collect();
    let width = inner + 2.0 * margin;
    let middle = width / 2.0;
    let left = middle - layout.content / 2.0;
    let mut items: Vec<Item> = Vec::new();
    let mut y = margin;
    if options.titles && !heading.is_empty() {
        let (lines, size) = title::lines(heading, inner, theme);
        for line in lines {
            let below = size * 5.0 / 22.0;
            y += size;
            let at = PagePoint::new(middle, y - below);
            items.push(
                Text::new(at, line, title::FACE, size, theme.ink)
                    .anchored(Anchor::Middle)
                    .into(),
            );
            y += below;
        }
        y += gaps.below_title;
    }
    for (number, row) in order.chunks(layout.columns).enumerate() {
        if number > 0 {
            y += 30.0;
        }
        let views = row
            .iter()
            .map(|(strip, frame)| strips[*strip].shows(*frame));
        let views: Vec<Bounds> = views.collect();
        let low = views.iter().map(|v| v.min.y).fold(f64::INFINITY, f64::min);
        let high = views
            .iter()
            .map(|v| v.max.y)
            .fold(f64::NEG_INFINITY, f64::max);
        let mut bottom = y;
        // The verdicts of a row are on one level, below its longest caption.
        let captions = row
            .iter()
            .map(|(strip, frame)| strips[*strip].caption_lines(*frame).len())
            .max()
            .unwrap_or(0);
        for (column, ((strip, frame), view)) in row.iter().zip(views).enumerate() {
            let view = Bounds {
                min: Point::new(view.min.x, low),
                max: Point::new(view.max.x, high),
            };
            let x = left + column as f64 * (layout.panel + layout.gap);
            let at = PagePoint::new(x, y);
            let (mut panel, end) = strips[*strip].panel(*frame, (view, captions), at);
            if strips.len() > 1 {
                let id = panel.id.take();
                panel.id = id.map(|id| format!("{}-{id}", strip + 1));
            }
            items.push(panel.into());
            bottom = f64::max(bottom, end);
        }
        y = bottom;
    }
    if !entries.is_empty() {
        y += gaps.above_rule;
        let rule = Outline::line([
            PagePoint::new(middle - inner / 2.0, y),
            PagePoint::new(middle + inner / 2.0, y),
        ]);
        items.push(Path::stroked(rule, Stroke::new(theme.rule, 1.0)).into());
        y += gaps.below_rule;
        let (key, height) = legend::draw(&entries, (middle, y), inner, gaps.key_line, theme);
        items.push(key.into());
        y += height - 10.0;
    }
    let described: Vec<String> = order
        .iter()
        .take(MAX_DESCRIBED_FRAMES)
        .map(|(strip, frame)| strips[*strip].described(*frame))
        .collect();
    Drawing {
        width: width.ceil(),
        height: (y + margin).ceil(),
        title: [heading, first.content.title()][usize::from(heading.is_empty())].to_owned(),
        description: described.join(" "),
        background: Some(theme.page),
        items,
    }
}

impl Strip<'_> {
    fn drawing(&self) -> Drawing {
        let frames = 0..self.context.marks.len();
        let order: Vec<(usize, usize)> = frames.map(|frame| (0, frame)).collect();
        page(&[self], &order, &self.context.analysis.scene.title)
    }

    /// Returns the entries of the legend.
    fn entries(&self) -> Vec<legend::Entry> {
        let options = self.context.options;
        let unit = self.layout.scale * self.context.unit;
        let mut entries = if options.keys {
            let mut entries = self.content.entries(self.context, unit);
            entries.extend(label::left_out(self.context).map(legend::Entry::Note));
            entries
        } else {
            Vec::new()
        };
        if self.context.arrows_too_small(self.layout.scale) {
            let arrows = self.context.marks.iter().flat_map(|m| &m.arrows);
            let left_out = |a: &&ForceArrow| !a.kind.is_failure() && a.kind != ArrowKind::Load;
            let count = arrows.filter(left_out).count();
            let left_out = format!("{} too small to read, left out", counted(count, "arrow"));
            entries.push(legend::Entry::Note(left_out));
        }
        if options.scale_bar {
            entries.extend(legend::metres(self.layout.scale, self.layout.content));
        }
        entries
    }

    /// Returns the part of the scene that the panel of a frame shows, metres. It is as wide as all frames need, so that
    /// structures are aligned in columns.
    fn shows(&self, frame: usize) -> Bounds {
        if self.alike {
            self.context.view
        } else {
            self.context.row(&[frame])
        }
    }

    /// Draws the panel of a frame with its upper left corner at `at`: picture, caption and verdict. The picture shows
    /// `view` (metres); the caption has space for `captions` lines. Also returns the position of its lower end, pixels.
    fn panel(
        &self,
        frame: usize,
        (view, captions): (Bounds, usize),
        at: PagePoint,
    ) -> (Group, f64) {
        let (context, layout) = (self.context, self.layout);
        let (options, theme) = (context.options, &context.options.theme);
        let (size, line_height) = (theme.sizes.caption, CAPTION_LINE * theme.sizes.caption);
        let found = &context.analysis.frames[frame];
        let aside = (layout.panel - view.width() * layout.scale) / 2.0;
        let camera = Camera::new(view, at.moved(aside, 0.0), layout.scale);
        let mut group = Group {
            id: Some(format!("frame-{}", frame + 1)),
            ..Group::with_class("frame")
        };
        group.title = self.labelled(frame, ": ", verdict::word(found.verdict));
        let picture = self.content.picture(context, frame, view, &camera);
        let cramped = without_room(&picture);
        group = group.with(picture);
        let middle = at.x + layout.panel / 2.0;
        let mut y = at.y + view.height() * layout.scale;
        if options.dimensions {
            group = group.with(dimension::lines(context, frame, view, &camera));
            y += dimension::BELOW;
        }
        let lines = self.caption_lines(frame);
        y += if captions > 0 { 10.0 } else { 0.0 };
        for (number, line) in lines.into_iter().enumerate() {
            let below = size * 5.0 / 17.0;
            let at = PagePoint::new(middle, y + (number + 1) as f64 * line_height - below);
            group = group
                .with(Text::new(at, line, Face::Serif, size, theme.ink).anchored(Anchor::Middle));
        }
        y += captions as f64 * line_height;
        if options.verdicts || options.keys {
            y += 8.0;
            let half = theme.sizes.verdict * 10.0 / 13.5;
            let (signs, below) = self.verdict(frame, PagePoint::new(middle, y + half));
            group.items.extend(signs);
            y += 2.2 * half + below;
            let reason = if options.verdicts {
                let said = [
                    self.headline(frame).1,
                    Some(context.statements[frame].clone()),
                ];
                let said = said.into_iter().flatten().filter(|words| !words.is_empty());
                said.collect::<Vec<String>>().join("; ")
            } else {
                String::new()
            };
            let size = theme.sizes.reason;
            let unseen = context.marks[frame].unseen(context.unit, layout.scale);
            let unseen = unseen.filter(|_| !context.arrows_too_small(layout.scale));
            let lines = text::balanced(&reason, Face::Sans, size, layout.panel, MAX_REASON_LINES);
            let unseen = unseen.map(|u| text::balanced(&u, Face::Sans, size, layout.panel, 2));
            let cramped = cramped.map(|c| text::balanced(&c, Face::Sans, size, layout.panel, 2));
            let notes = unseen.into_iter().chain(cramped).flatten();
            for line in lines.into_iter().chain(notes) {
                y += REASON_LINE * size;
                let at = PagePoint::new(middle, y - 0.32 * size);
                group = group.with(
                    Text::new(at, line, Face::Sans, size, theme.faint).anchored(Anchor::Middle),
                );
            }
        }
        (group, y)
    }

    /// Returns a text about a frame, after its caption if it has one.
    fn labelled(&self, frame: usize, between: &str, what: &str) -> String {
        let caption = self.caption(frame, between);
        if caption.is_empty() {
            what.to_owned()
        } else {
            format!("{caption}: {what}")
        }
    }

    /// Returns the lines of the caption; none if the options exclude captions.
    fn caption_lines(&self, frame: usize) -> Vec<String> {
        if !self.context.options.captions {
            return Vec::new();
        }
        text::balanced(
            &self.caption(frame, " "),
            Face::Serif,
            self.context.options.theme.sizes.caption,
            self.layout.panel,
            MAX_CAPTION_LINES,
        )
    }

    /// Draws the mark and the text of a verdict and the scale of arrows in one line about `centre`. If the panel is too
    /// narrow, the scale is below. Also returns the additional height in pixels.
    fn verdict(&self, frame: usize, centre: PagePoint) -> (Vec<Item>, f64) {
        let theme = &self.context.options.theme;
        let found = &self.context.analysis.frames[frame];
        let size = theme.sizes.verdict;
        let radius = size * 7.5 / 13.5;
        let (word, _) = self.headline(frame);
        let wide = text::width(&word, Face::SansBold, size);
        let options = self.context.options;
        let lead = if options.verdicts {
            2.0 * radius + 6.0 + wide + 22.0
        } else {
            0.0
        };
        let unit = self.layout.scale * self.context.unit;
        let scale = match self.context.options.scale {
            ArrowScale::Panel => {
                let marks = &self.context.marks[frame];
                legend::scale(
                    marks.newtons_per_unit,
                    marks.largest(),
                    unit,
                    self.context.options,
                )
            }
            ArrowScale::Strip => None,
        };
        let scale =
            scale.filter(|_| options.keys && !self.context.arrows_too_small(self.layout.scale));
        let long = scale.as_ref().map_or(0.0, |scale| {
            legend::widest(std::slice::from_ref(scale), theme)
        });
        let alone = (lead - 22.0).max(0.0);
        let stacked = scale.is_some() && alone > 0.0 && lead + long > self.layout.panel;
        let total = if scale.is_none() || stacked {
            alone
        } else {
            lead + long
        };
        let start = centre.moved(-total / 2.0, 0.0);
        let colour = verdict::badge_colour(found, theme);
        let at = start.moved(2.0 * radius + 6.0, 0.35 * size);
        let mut items: Vec<Item> = Vec::new();
        let signs: [Item; 2] = [
            verdict::mark_in(
                colour,
                found.verdict,
                start.moved(radius, 0.0),
                radius,
                theme,
            )
            .into(),
            Text::new(at, word, Face::SansBold, size, colour).into(),
        ];
        if options.verdicts {
            items.extend(signs);
        }
        let below = if stacked { 1.7 * size } else { 0.0 };
        if let Some(scale) = scale {
            let at = if stacked {
                centre.moved(-long / 2.0, below)
            } else {
                start.moved(lead, 0.0)
            };
            items.extend(legend::single(&scale, at, theme).0);
        }
        (items, below)
    }

    /// Returns the text next to the mark of a verdict. If it is wider than the panel, returns only the verdict, and the
    /// rest of the text separately.
    fn headline(&self, frame: usize) -> (String, Option<String>) {
        let size = self.context.options.theme.sizes.verdict;
        let found = &self.context.analysis.frames[frame];
        let words = self.content.headline(self.context, frame);
        let sign = 1.2 * size + 6.0;
        let room = match (self.layout.columns, self.context.options.width) {
            (1, None) => self.layout.panel.max(300.0),
            (1, Some(width)) => width - 2.0 * self.layout.margin,
            _ => self.layout.panel,
        };
        if sign + text::width(&words, Face::SansBold, size) <= room {
            return (words, None);
        }
        let badge = verdict::badge(found);
        let rest = words.strip_prefix(badge).unwrap_or(&words);
        let rest = rest.trim_start_matches([':', ',', ' ']).to_owned();
        (badge.to_owned(), Some(rest).filter(|rest| !rest.is_empty()))
    }

    /// Returns the caption of a frame, such as `(a) Initial situation`. It has no letter if there is only one frame,
    /// and no title if the heading already has this title. A zoomed figure names its block.
    fn caption(&self, frame: usize, between: &str) -> String {
        let scene = &self.context.analysis.scene;
        if let Some(caption) = self.captions.and_then(|all| all.get(frame)) {
            return caption.clone();
        }
        let title = &scene.frames[frame].title;
        let mut parts = Vec::new();
        if scene.frames.len() > 1 {
            parts.push(format!("({})", letter(frame)));
        }
        if !title.is_empty() && (scene.frames.len() > 1 || *title != scene.title) {
            parts.push(title.clone());
        }
        if let Some(block) = self.context.options.zoom {
            parts.push(format!("around block {}", scene.blocks[block.0].id));
        }
        parts.join(between)
    }

    /// Describes a frame in a sentence.
    fn described(&self, frame: usize) -> String {
        let (scene, found) = (
            &self.context.analysis.scene,
            &self.context.analysis.frames[frame],
        );
        let blocks = counted(scene.frames[frame].placed.len(), "block");
        let weight = quantity(found.weight, "N");
        let what = format!(
            "{blocks}, {weight} in all, {}",
            verdict::word(found.verdict)
        );
        let mut sentence = self.labelled(frame, " ", &what);
        let more = [self.context.statements[frame].clone()];
        for more in more.iter().chain(&found.notices).filter(|m| !m.is_empty()) {
            sentence.push_str("; ");
            sentence.push_str(&more.replace(text::NO_BREAK, " "));
        }
        sentence + "."
    }
}

/// Returns the note of a picture on labels without space; `None` if there is no such label.
fn without_room(picture: &Group) -> Option<String> {
    let groups = picture.items.iter().filter_map(|item| match item {
        Item::Group(group) if group.class == label::CLASS => Some(group.description.clone()),
        _ => None,
    });
    groups.into_iter().find(|labelled| !labelled.is_empty())
}
