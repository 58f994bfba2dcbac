//! [`Strip`]: a page of panels, one per frame, each with its caption and verdict, and one key below them all. What a
//! panel shows is its [`Kind`]'s affair.

use super::kind::Kind;
use super::label;
use super::layout::{GAP, Layout};
use super::legend;
use super::option::{ArrowScale, Options};
use super::stage::Stage;
use super::verdict;
use super::words::{letter, quantity};
use crate::analysis::{Analysis, FrameAnalysis};
use crate::drawing::{
    Anchor, Camera, Drawing, Face, Group, Item, Outline, PagePoint, Path, Stroke, Text, text,
};
use crate::geometry::Bounds;

/// Height of a caption's line, in sizes of its letters.
const CAPTION_LINE: f64 = 22.0 / 17.0;
/// Height of a line of what is said below a verdict, in sizes of its letters.
const REASON_LINE: f64 = 1.36;
const MOST_CAPTION_LINES: usize = 6;
const MOST_REASON_LINES: usize = 4;

/// The figure of an analysis: a panel of this kind for each frame.
pub(crate) fn strip(analysis: &Analysis<'_>, kind: Kind, options: &Options) -> Drawing {
    let stage = Stage::of(analysis, kind, options);
    let strip = Strip {
        stage: &stage,
        layout: Layout::of(&stage, analysis.frames.len()),
        only: None,
    };
    strip.drawing()
}

/// The panels of [`strip`] a page each, all pages alike in size and scale, so that they can follow one another in place.
pub(crate) fn pages(analysis: &Analysis<'_>, kind: Kind, options: &Options) -> Vec<Drawing> {
    let stage = Stage::of(analysis, kind, options);
    let page = |frame| {
        let strip = Strip {
            stage: &stage,
            layout: Layout::of(&stage, 1),
            only: Some(frame),
        };
        strip.drawing()
    };
    let mut pages: Vec<Drawing> = (0..analysis.frames.len()).map(page).collect();
    let highest = pages.iter().map(|p| p.height).fold(0.0, f64::max);
    for page in &mut pages {
        page.height = highest;
    }
    pages
}

struct Strip<'a> {
    stage: &'a Stage<'a>,
    layout: Layout,
    /// The one frame that is drawn, all of them where `None`.
    only: Option<usize>,
}

impl Strip<'_> {
    fn drawing(&self) -> Drawing {
        let (options, scene) = (self.stage.options, self.stage.analysis.scene);
        let theme = &options.theme;
        let unit = self.layout.scale * self.stage.unit;
        let entries = if options.keys {
            let mut entries = self.stage.kind.entries(self.stage, unit);
            entries.extend(label::left_out(self.stage).map(legend::Entry::Note));
            entries
        } else {
            Vec::new()
        };
        let margin = self.layout.margin;
        // A narrow picture gets a page wide enough for its words.
        let inner = match options.width {
            Some(width) => (width - 2.0 * margin).max(1.0),
            None => self
                .layout
                .content
                .max(legend::widest(&entries, theme).min(640.0))
                .max(300.0),
        };
        let fitted = |entry: legend::Entry| entry.fitted(inner, theme);
        let entries: Vec<legend::Entry> = entries.into_iter().flat_map(fitted).collect();
        let width = inner + 2.0 * margin;
        let middle = width / 2.0;
        let left = middle - self.layout.content / 2.0;
        let mut items: Vec<Item> = Vec::new();
        let mut y = margin;
        if options.captions && !scene.title.is_empty() {
            let (face, size) = (Face::SerifBold, theme.sizes.title);
            let lines = text::wrap(&scene.title, face, size, inner);
            for line in text::cut(lines, 3, face, size, inner) {
                let below = size * 5.0 / 22.0;
                y += size;
                let at = PagePoint::new(middle, y - below);
                items.push(
                    Text::new(at, line, face, size, theme.ink)
                        .anchored(Anchor::Middle)
                        .into(),
                );
                y += below;
            }
            y += 18.0;
        }
        let frames: Vec<usize> = match self.only {
            Some(frame) => vec![frame],
            None => (0..self.stage.marks.len()).collect(),
        };
        let rows: Vec<&[usize]> = frames.chunks(self.layout.columns).collect();
        for (number, row) in rows.iter().enumerate() {
            if number > 0 {
                y += 30.0;
            }
            let view = match self.only {
                Some(_) => self.stage.view,
                None => self.stage.row(row),
            };
            let mut bottom = y;
            // Verdicts of a row stand side by side, below its longest caption.
            let captions = row
                .iter()
                .map(|f| self.caption_lines(*f).len())
                .max()
                .unwrap_or(0);
            for (column, frame) in row.iter().enumerate() {
                let x = left + column as f64 * (self.layout.panel + GAP);
                let (panel, end) = self.panel(*frame, (view, captions), PagePoint::new(x, y));
                items.push(panel.into());
                bottom = f64::max(bottom, end);
            }
            y = bottom;
        }
        if !entries.is_empty() {
            y += 20.0;
            let rule = Outline::line([
                PagePoint::new(middle - inner / 2.0, y),
                PagePoint::new(middle + inner / 2.0, y),
            ]);
            items.push(Path::stroked(rule, Stroke::new(theme.rule, 1.0)).into());
            y += 8.0;
            let (key, height) = legend::draw(&entries, middle, y, inner, theme);
            items.push(key.into());
            y += height - 10.0;
        }
        Drawing {
            width: width.ceil(),
            height: (y + margin).ceil(),
            title: if scene.title.is_empty() {
                self.stage.kind.title().into()
            } else {
                scene.title.clone()
            },
            description: self.told(),
            background: Some(theme.page),
            items,
        }
    }

    /// A frame's picture of what lies in `view`, its caption in the room of so many lines, and its verdict, with the
    /// upper left corner at `at`; and where it ends below.
    fn panel(
        &self,
        frame: usize,
        (view, captions): (Bounds, usize),
        at: PagePoint,
    ) -> (Group, f64) {
        let (stage, layout) = (self.stage, self.layout);
        let (options, theme) = (stage.options, &stage.options.theme);
        let (size, line_height) = (theme.sizes.caption, CAPTION_LINE * theme.sizes.caption);
        let found = &stage.analysis.frames[frame];
        let aside = (layout.panel - view.width() * layout.scale) / 2.0;
        let camera = Camera::new(view, at.moved(aside, 0.0), layout.scale);
        let mut group = Group {
            id: Some(format!("frame-{}", frame + 1)),
            ..Group::of_class("frame")
        };
        group.title = self.said(frame, ": ", verdict::word(found.verdict));
        group = group.with(stage.kind.picture(stage, frame, view, &camera));
        let middle = at.x + layout.panel / 2.0;
        let mut y = at.y + view.height() * layout.scale;
        let lines = self.caption_lines(frame);
        y += if captions > 0 { 10.0 } else { 0.0 };
        for (number, line) in lines.into_iter().enumerate() {
            let below = size * 5.0 / 17.0;
            let at = PagePoint::new(middle, y + (number + 1) as f64 * line_height - below);
            group = group
                .with(Text::new(at, line, Face::Serif, size, theme.ink).anchored(Anchor::Middle));
        }
        y += captions as f64 * line_height;
        if options.keys {
            y += 8.0;
            let half = theme.sizes.verdict * 10.0 / 13.5;
            group
                .items
                .extend(self.verdict(frame, PagePoint::new(middle, y + half)));
            y += 2.2 * half;
            let (reason, size) = (stage.kind.reason(stage, frame), theme.sizes.reason);
            let unseen = stage.marks[frame].unseen(stage.unit, layout.scale);
            let lines = balanced(&reason, Face::Sans, size, layout.panel, MOST_REASON_LINES);
            let unseen = unseen.map(|u| balanced(&u, Face::Sans, size, layout.panel, 2));
            for line in lines.into_iter().chain(unseen.into_iter().flatten()) {
                y += REASON_LINE * size;
                let at = PagePoint::new(middle, y - 0.32 * size);
                group = group.with(
                    Text::new(at, line, Face::Sans, size, theme.faint).anchored(Anchor::Middle),
                );
            }
        }
        (group, y)
    }

    /// Something said of a frame, after its caption where it has one.
    fn said(&self, frame: usize, between: &str, what: &str) -> String {
        let caption = self.caption(frame, between);
        if caption.is_empty() {
            what.to_owned()
        } else {
            format!("{caption}: {what}")
        }
    }

    /// The caption as it is broken into lines; none where captions are not wanted.
    fn caption_lines(&self, frame: usize) -> Vec<String> {
        if !self.stage.options.captions {
            return Vec::new();
        }
        balanced(
            &self.caption(frame, " "),
            Face::Serif,
            self.stage.options.theme.sizes.caption,
            self.layout.panel,
            MOST_CAPTION_LINES,
        )
    }

    /// The mark, the word and the scale of arrows in one line about `centre`.
    fn verdict(&self, frame: usize, centre: PagePoint) -> Vec<Item> {
        let theme = &self.stage.options.theme;
        let found = &self.stage.analysis.frames[frame];
        let word = verdict::word(found.verdict);
        let size = theme.sizes.verdict;
        let wide = text::width(word, Face::SansBold, size);
        let radius = size * 7.5 / 13.5;
        let lead = 2.0 * radius + 6.0 + wide;
        let unit = self.layout.scale * self.stage.unit;
        let scale = match self.stage.options.scale {
            ArrowScale::Panel => legend::scale(
                self.stage.marks[frame].newtons_per_unit,
                unit,
                self.stage.options,
            ),
            ArrowScale::Strip => None,
        };
        let total = lead
            + scale.as_ref().map_or(0.0, |s| {
                22.0 + legend::widest(std::slice::from_ref(s), theme)
            });
        let start = centre.moved(-total / 2.0, 0.0);
        let colour = verdict::colour(found.verdict, theme);
        let at = start.moved(2.0 * radius + 6.0, 0.35 * size);
        let mut items: Vec<Item> = vec![
            verdict::mark(found.verdict, start.moved(radius, 0.0), radius, theme).into(),
            Text::new(at, word, Face::SansBold, size, colour).into(),
        ];
        if let Some(scale) = scale {
            items.extend(legend::single(&scale, start.moved(lead + 22.0, 0.0), theme).0);
        }
        items
    }

    /// `(a) Initial situation`; without a letter where there is but one frame, without what the heading says already.
    fn caption(&self, frame: usize, between: &str) -> String {
        let scene = self.stage.analysis.scene;
        let title = &scene.frames[frame].title;
        if scene.frames.len() > 1 {
            let letter = letter(frame);
            return if title.is_empty() {
                format!("({letter})")
            } else {
                format!("({letter}){between}{title}")
            };
        }
        if *title == scene.title {
            String::new()
        } else {
            title.clone()
        }
    }

    /// The whole figure in sentences.
    fn told(&self) -> String {
        let scene = self.stage.analysis.scene;
        let tell = |(frame, found): (usize, &FrameAnalysis)| {
            let count = scene.frames[frame].placed.len();
            let blocks = if count == 1 {
                "1 block".to_owned()
            } else {
                format!("{count} blocks")
            };
            let weight = quantity(found.weight, "N");
            let what = format!(
                "{blocks}, {weight} in all, {}",
                verdict::word(found.verdict)
            );
            let mut sentence = self.said(frame, " ", &what);
            for more in [self.stage.kind.reason(self.stage, frame)]
                .iter()
                .chain(&found.notices)
                .filter(|m| !m.is_empty())
            {
                sentence.push_str("; ");
                sentence.push_str(&more.replace(text::NO_BREAK, " "));
            }
            sentence + "."
        };
        let frames: Vec<String> = self
            .stage
            .analysis
            .frames
            .iter()
            .enumerate()
            .take(30)
            .map(tell)
            .collect();
        frames.join(" ")
    }
}

/// Words in as few lines as `room` allows, and those about equally long.
fn balanced(words: &str, face: Face, size: f64, room: f64, most: usize) -> Vec<String> {
    let mut lines = text::cut(text::wrap(words, face, size, room), most, face, size, room);
    let count = lines.len();
    if count < 2 || lines.last().is_some_and(|l| l.ends_with('…')) {
        return lines;
    }
    let mut narrower = room;
    while narrower > room / 3.0 {
        narrower -= 4.0;
        let next = text::wrap(words, face, size, narrower);
        if next.len() > count {
            break;
        }
        lines = next;
    }
    lines
}
