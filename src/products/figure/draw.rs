//! [`draw`] and what else makes drawings of an analysis: pages, panels, and how large they become.

use super::kind::Kind;
use super::layout::Layout;
use super::option::Options;
use super::strip::{self, strip};
use crate::analysis::{Analysis, Verdict};
use crate::drawing::Drawing;

/// Pictures of a mechanism in motion beside the first.
const WAY: u32 = 12;

/// A figure of this kind, one panel per frame.
///
/// Units: the page is in pixels at natural size.
pub fn draw(analysis: &Analysis, kind: Kind, options: &Options) -> Drawing {
    if kind == Kind::Mechanism {
        return strip(&analysis.elementary(), kind, &kind.options(options));
    }
    strip(analysis, kind, &kind.options(options))
}

/// The panels of [`draw`] a page each, all alike in size and scale: the pictures of an animation. A frame that falls by a
/// mechanism has several, along its way.
pub fn pages(analysis: &Analysis, kind: Kind, options: &Options) -> Vec<Drawing> {
    if kind == Kind::Mechanism {
        return moving(&analysis.elementary(), &kind.options(options));
    }
    strip::pages(
        analysis,
        kind,
        &kind.options(options),
        0..analysis.frames.len(),
    )
}

/// The panels of [`draw`] a page each, one per frame, all alike in size and scale.
pub fn panels(analysis: &Analysis, kind: Kind, options: &Options) -> Vec<Drawing> {
    let all: Vec<usize> = (0..analysis.frames.len()).collect();
    panels_of(analysis, kind, options, &all)
}

/// As [`panels`], of these frames alone, counted from 0; frames that there are not are passed over.
pub fn panels_of(
    analysis: &Analysis,
    kind: Kind,
    options: &Options,
    frames: &[usize],
) -> Vec<Drawing> {
    let count = analysis.frames.len();
    let there = frames.iter().copied().filter(|frame| *frame < count);
    if kind == Kind::Mechanism {
        return strip::pages(&analysis.elementary(), kind, &kind.options(options), there);
    }
    strip::pages(analysis, kind, &kind.options(options), there)
}

/// The panels of [`draw`] in rows on pages no higher than `high` times their width, each with its title and key; all to one
/// scale. A single row that is higher has a page of its own.
pub fn split(analysis: &Analysis, kind: Kind, options: &Options, high: f64) -> Vec<Drawing> {
    if kind == Kind::Mechanism {
        return strip::split(&analysis.elementary(), kind, &kind.options(options), high);
    }
    strip::split(analysis, kind, &kind.options(options), high)
}

/// A width and a height that [`draw`] makes no smaller, pixels: told without drawing, so that what is too large for a file
/// can be refused soon.
pub fn least_size(analysis: &Analysis, kind: Kind, options: &Options) -> (f64, f64) {
    let options = kind.options(options);
    let stage = kind.stage(analysis, &options);
    Layout::new(&stage, analysis.frames.len()).least(&stage)
}

/// The pages of a mechanism: each frame that falls in steps along its way, each other frame once.
fn moving(analysis: &Analysis, options: &Options) -> Vec<Drawing> {
    let at = |step: u32| {
        let options = Options {
            way: f64::from(step) / f64::from(WAY),
            ..options.clone()
        };
        strip::pages(
            analysis,
            Kind::Mechanism,
            &options,
            0..analysis.frames.len(),
        )
    };
    let steps: Vec<Vec<Drawing>> = (0..=WAY).map(at).collect();
    let mut pages = Vec::new();
    for (frame, found) in analysis.frames.iter().enumerate() {
        let falls = found.verdict == Verdict::Unstable;
        let shown = if falls { steps.len() } else { 1 };
        pages.extend(steps[..shown].iter().filter_map(|s| s.get(frame).cloned()));
    }
    pages
}
