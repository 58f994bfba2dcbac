//! Writes the texts of a figure with panels: the legend, and the captions, verdicts and descriptions of the panels.

use super::super::arrow::{ArrowKind, ForceArrow};
use super::super::label;
use super::super::legend;
use super::super::verdict;
use super::super::words::{counted, letter, quantity};
use super::Strip;
use crate::geometry::Bounds;
use crate::pictures::drawing::{Face, text};

/// Largest number of lines of a caption. Longer captions end in "…".
const MAX_CAPTION_LINES: usize = 8;

impl Strip<'_> {
    /// Returns the entries of the legend of this figure, including notes on arrows and labels that are left out.
    pub(super) fn entries(&self) -> Vec<legend::Entry> {
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
            entries.extend(legend::metres(self.layout.scale, self.layout.content, self.context.analysis.scene.units));
        }
        entries
    }

    /// Returns the part of the scene that the panel of a frame shows, metres. The panels of all frames show the same
    /// width, so that structures are aligned in columns.
    pub(super) fn shows(&self, frame: usize) -> Bounds {
        if self.alike { self.context.view } else { self.context.row(&[frame]) }
    }

    /// Returns `what` with the caption of the frame before it, such as `(a) First step: falls`. `between` separates the
    /// parts of the caption.
    pub(super) fn labelled(&self, frame: usize, between: &str, what: &str) -> String {
        let caption = self.caption(frame, between);
        if caption.is_empty() { what.to_owned() } else { format!("{caption}: {what}") }
    }

    /// Returns the lines of the caption of a frame; empty if the options exclude captions.
    pub(super) fn caption_lines(&self, frame: usize) -> Vec<String> {
        if !self.context.options.captions {
            return Vec::new();
        }
        text::sentence_lines(
            &self.caption(frame, " "),
            Face::Serif,
            self.context.options.theme.sizes.caption,
            self.layout.panel,
            MAX_CAPTION_LINES,
        )
    }

    /// Returns the text of a verdict in two parts; the first part is for the line of the symbol. If the whole text fits
    /// in this line, the second part is `None`. Otherwise the first part is only the verdict, and the second the rest.
    pub(super) fn headline(&self, frame: usize) -> (String, Option<String>) {
        let size = self.context.options.theme.sizes.verdict;
        let frame_analysis = &self.context.analysis.frames[frame];
        let words = self.content.headline(self.context, frame);
        let symbol = 1.2 * size + 6.0;
        let room = match (self.layout.columns, self.context.options.width) {
            (1, None) => self.layout.panel.max(300.0),
            (1, Some(width)) => width - 2.0 * self.layout.margin,
            _ => self.layout.panel,
        };
        if symbol + text::width(&words, Face::SansBold, size) <= room {
            return (words, None);
        }
        let badge = verdict::badge(frame_analysis);
        let rest = words.strip_prefix(badge).unwrap_or(&words);
        let rest = rest.trim_start_matches([':', ',', ' ']).to_owned();
        (badge.to_owned(), Some(rest).filter(|rest| !rest.is_empty()))
    }

    /// Returns the caption of a frame, such as `(a) Initial situation`. If there is only one frame, the letter is left
    /// out, and also the title if it is the title of the scene. In a zoomed figure, the caption names the block in the
    /// centre.
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

    /// Returns a sentence for screen readers about a frame: its caption, the number and the weight of its blocks, its
    /// verdict with the reason, and its notices.
    pub(super) fn described(&self, frame: usize) -> String {
        let (scene, frame_analysis) = (&self.context.analysis.scene, &self.context.analysis.frames[frame]);
        let blocks = counted(scene.frames[frame].placed.len(), "block");
        let weight = quantity(frame_analysis.weight, scene.units.force());
        let what = format!("{blocks}, {weight} in all");
        if !self.context.options.verdicts {
            return self.labelled(frame, " ", &what) + ".";
        }
        let what = format!("{what}, {}", verdict::word(frame_analysis.verdict));
        let mut sentence = self.labelled(frame, " ", &what);
        let more = [self.context.statements[frame].clone()];
        for more in more.iter().chain(&frame_analysis.notices).filter(|m| !m.is_empty()) {
            sentence.push_str("; ");
            sentence.push_str(&more.replace(text::NO_BREAK, " "));
        }
        sentence + "."
    }
}
