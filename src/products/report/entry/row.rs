//! [`Row`]: the row of one scene in the table of all scenes.

use std::sync::Arc;

use super::bullet;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, STANDS, Verdict};
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{BlockId, Scene};
use crate::pictures::drawing::{Camera, Outline, PagePoint, Segment};
use crate::products::wording::failure;
use crate::products::wording::margin::headline;
use crate::products::wording::number::{letter, quantity};
use crate::text::{self, line};

/// Width and height of a thumbnail, in pixels.
const THUMBNAIL_SIZE: (f64, f64) = (96.0, 60.0);
/// Largest number of blocks in a thumbnail. If there are more, only every n-th block is drawn, because a reader could
/// not distinguish all of them.
const MAX_THUMBNAIL_BLOCKS: usize = 400;

/// The row of a scene in the table of all scenes.
#[derive(Clone, Debug)]
pub struct Row {
    /// The number of the scene in its report, from 1.
    pub number: usize,
    /// The path as given by the user.
    pub name: String,
    /// The title of the scene, or the name of its file.
    pub title: String,
    /// The worst verdict of the steps; in a comparison, of the second scene.
    pub verdict: Verdict,
    /// In a comparison, the verdict of the first scene; otherwise `None`.
    pub before: Option<Verdict>,
    /// The steps that have the worst verdict, such as ` in step (c) of 5`; empty if all stand, or for a single frame.
    pub steps: String,
    /// The number of steps that stand, and the number of all steps.
    pub stand: (usize, usize),
    /// The number of different blocks that the steps place.
    pub blocks: usize,
    /// The most important margin of the governing step in words; empty if no margin was computed.
    pub headline: String,
    /// The relative distance of the current value from the nearest end of this margin, 0 … 1. It is −1 for a falling
    /// scene whose most important margin is not the load factor, and 2 if no margin was computed.
    pub reserve: f64,
    /// The largest force at an interface or of a robot in N, in the listed balances of the steps that stand. `None` if no
    /// step stands, because the forces of a falling step include the missing forces.
    pub largest: Option<f64>,
    /// The units in which the forces are written.
    pub units: UnitsEntry,
    /// What fails in the first step that does not stand: its unsupported blocks, otherwise its largest failure,
    /// otherwise the reason for the doubt. Empty if all steps stand. In a comparison, the changes of the first step.
    pub fails: String,
    /// A small picture.
    pub thumbnail: Thumbnail,
}

/// A small picture: outlines as SVG path data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Thumbnail {
    /// The blocks.
    pub blocks: String,
    /// The ground.
    pub ground: String,
}

impl Row {
    /// Makes the row of an analysis. `name` is the path as given by the user.
    pub fn new(name: &str, analysis: &Analysis) -> Row {
        let scene = analysis.given();
        let frames = &analysis.frames;
        let number = governing(analysis);
        let bars = bullet::margin_bars(analysis.at(number));
        let bar = bars.first();
        let standing = || frames.iter().filter(|f| f.verdict == Verdict::Stable);
        let mut placed: Vec<usize> = scene.frames.iter().flat_map(|f| f.placed.iter().map(|id| id.0)).collect();
        placed.sort_unstable();
        placed.dedup();
        let fails = analysis.each().find(|solved| solved.found.verdict != Verdict::Stable);
        let fails = fails.map_or(String::new(), |solved| {
            let unsupported = failure::unsupported_phrase(solved);
            let largest = failure::by_amount(solved.found).into_iter().next();
            let largest = largest.map(|f| failure::missing_phrase(scene, f));
            unsupported.or(largest).unwrap_or_else(|| solved.found.doubt())
        });
        let title = match scene.title.trim() {
            "" => file_name(name),
            title => text::line(title),
        };
        Row {
            number: 1,
            name: text::line(name),
            title,
            verdict: analysis.verdict(),
            before: None,
            steps: worst_steps(frames),
            stand: (standing().count(), frames.len()),
            blocks: placed.len(),
            headline: line(&headline(analysis.at(number))),
            reserve: bar.map_or(2.0, |bar| match analysis.verdict() {
                Verdict::Unstable if !bar.is_load_factor => -1.0,
                _ => bar.reserve,
            }),
            units: scene.units,
            largest: standing().map(|f| f.largest_force()).reduce(f64::max),
            fails: text::line(&fails),
            thumbnail: thumbnail(scene, &placed.iter().map(|id| BlockId(*id)).collect::<Vec<_>>()),
        }
    }
}

impl Row {
    /// Returns the verdict as text, or both verdicts of a comparison: `stands → falls`. Of a scene with several steps, it
    /// names the steps: `falls in step (c) of 5`.
    pub(crate) fn verdict_words(&self) -> String {
        match self.before {
            Some(before) => format!("{} → {}", before.plain(), self.verdict.plain()),
            None => format!("{}{}", self.verdict.plain(), self.steps),
        }
    }

    /// Returns the headline margin as text, or a dash if there is no margin.
    pub(crate) fn margin_words(&self) -> String {
        match self.headline.as_str() {
            "" => "–".to_owned(),
            words => words.to_owned(),
        }
    }

    /// Returns the largest force as text with its unit; `none stands` if no frame stands.
    pub(crate) fn largest_words(&self) -> String {
        let words = |largest| quantity(largest, self.units.force());
        self.largest.map_or_else(|| format!("none {STANDS}"), words)
    }
}

/// Says which steps have the worst verdict, if not all steps stand: ` in step (c) of 5`. Empty for a single frame.
fn worst_steps(frames: &[Arc<FrameAnalysis>]) -> String {
    let worst = frames.iter().map(|frame| frame.verdict).max().filter(|worst| *worst != Verdict::Stable);
    let is_worst = |number: &usize| Some(frames[*number].verdict) == worst;
    let steps: Vec<String> = (0..frames.len()).filter(is_worst).map(|number| format!("({})", letter(number))).collect();
    match (&steps[..], frames.len()) {
        ([], _) | (_, 1) => String::new(),
        ([step], count) => format!(" in step {step} of {count}"),
        (steps, count) => format!(" in {} of {count} steps, first in {}", steps.len(), steps[0]),
    }
}

/// Returns the name of a file without folders and without `.json`; `standard input` for `-`.
pub(super) fn file_name(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = last.strip_suffix(".json").unwrap_or(last);
    text::line(if stem == "-" { "standard input" } else { stem })
}

/// Draws a small picture of the given blocks and the ground. Of very many blocks, only some are drawn. The picture is
/// empty if there are no blocks.
pub(super) fn thumbnail(scene: &Scene, placed: &[BlockId]) -> Thumbnail {
    let Some(bounds) = scene.bounds(placed) else {
        return Thumbnail::default();
    };
    let (width, height) = THUMBNAIL_SIZE;
    let size = f64::max(bounds.width() / (width - 6.0), bounds.height() / (height - 8.0));
    if !(size > 0.0 && size.is_finite()) {
        return Thumbnail::default();
    }
    let scale = 1.0 / size;
    let at = PagePoint::new((width - scale * bounds.width()) / 2.0, height - 5.0 - scale * bounds.height());
    let camera = Camera::new(bounds, at, scale);
    let every = placed.len().div_ceil(MAX_THUMBNAIL_BLOCKS).max(1);
    let mut blocks = String::new();
    for id in placed.iter().step_by(every) {
        blocks.push_str(&path_data(&camera.polygon(&scene.blocks[id.0].body.polygon)));
    }
    let mut ground = String::new();
    for part in scene.ground.iter().take(MAX_THUMBNAIL_BLOCKS) {
        ground.push_str(&path_data(&camera.polygon(&part.body.polygon)));
    }
    Thumbnail { blocks, ground }
}

/// Returns the SVG path data of an outline, rounded to 0.1 pixels. Curves become straight lines. Points outside the
/// thumbnail are moved to its border.
fn path_data(outline: &Outline) -> String {
    let (width, height) = THUMBNAIL_SIZE;
    let number = |x: f64| {
        let tenths = (x * 10.0).round() / 10.0 + 0.0;
        format!("{tenths}")
    };
    let point = |p: &PagePoint| format!("{} {}", number(p.x.clamp(0.0, width)), number(p.y.clamp(0.0, height)));
    let step = |segment: &Segment| match segment {
        Segment::Move(p) => format!("M{}", point(p)),
        Segment::Line(p) => format!("L{}", point(p)),
        Segment::Curve(_, _, p) => format!("L{}", point(p)),
        Segment::Close => "Z".into(),
    };
    outline.segments.iter().map(step).collect()
}

/// Returns the index of the governing step, from 0. This is the first step that falls. If no step falls, it is the
/// first undecided step. If all steps stand, it is the step whose headline margin has the smallest relative reserve.
pub(super) fn governing(analysis: &Analysis) -> usize {
    let of = |verdict| analysis.frames.iter().position(|f| f.verdict == verdict);
    let first = of(Verdict::Unstable).or_else(|| of(Verdict::Undecided));
    first.unwrap_or_else(|| {
        let reserve = |number: &usize| {
            let bars = bullet::margin_bars(analysis.at(*number));
            bars.first().map_or(1.0, |bar| bar.reserve)
        };
        // If several steps have the same reserve, the last of them governs, because it usually has the most blocks.
        let steps = (0..analysis.frames.len()).rev();
        steps.min_by(|a, b| reserve(a).total_cmp(&reserve(b))).unwrap_or(0)
    })
}
