//! Draws the symbol of a verdict: a disc with a tick, a cross or a question mark, so that the verdict is clear without
//! colours. Its text comes from [`wording`](crate::products::wording).

use crate::mechanics::analysis::{Analysis, FrameAnalysis, Verdict};
use crate::pictures::drawing::{Colour, Group, Outline, PagePoint, Path, Stroke, Theme};

/// With more blocks than this in a frame, a figure does not ask for a margin that it can do without, because it would
/// take longer than the figure.
const MAX_BLOCKS: usize = 200;

/// True if every frame has so few blocks that its margins take little time.
pub(crate) fn has_cheap_margins(analysis: &Analysis) -> bool {
    analysis.given().frames.iter().all(|frame| frame.placed.len() <= MAX_BLOCKS)
}

/// Returns the colour of the symbol of a verdict.
pub(crate) fn colour(verdict: Verdict, theme: &Theme) -> Colour {
    match verdict {
        Verdict::Stable => theme.stands,
        Verdict::Unstable => theme.falls,
        Verdict::Undecided => theme.undecided,
    }
}

/// Returns the text next to the symbol of the verdict of a frame, such as `stands` or `stands only by wedging`.
pub(crate) fn badge(frame_analysis: &FrameAnalysis) -> &'static str {
    match frame_analysis.only_by_wedging {
        Some(true) if frame_analysis.verdict == Verdict::Stable => "stands only by wedging",
        _ => frame_analysis.verdict.plain(),
    }
}

/// Returns the colour of the symbol of the verdict of a frame. A frame that stands only by wedging has the colour of an
/// undecided frame.
pub(crate) fn badge_colour(frame_analysis: &FrameAnalysis, theme: &Theme) -> Colour {
    match frame_analysis.only_by_wedging {
        Some(true) if frame_analysis.verdict == Verdict::Stable => theme.undecided,
        _ => colour(frame_analysis.verdict, theme),
    }
}

/// Draws the symbol of a verdict in a given colour: a disc of radius `r` pixels with a tick (stable), a cross
/// (unstable) or a question mark (undecided).
pub(crate) fn mark_in(colour: Colour, verdict: Verdict, centre: PagePoint, r: f64, theme: &Theme) -> Group {
    let at = |x: f64, y: f64| centre.moved(x * r, y * r);
    let pen = || Stroke::new(theme.page, 0.24 * r);
    let disc = Path::filled(Outline::circle(centre, r), colour);
    let group = Group::with_class("verdict").with(disc);
    match verdict {
        Verdict::Stable => {
            group.with(Path::stroked(Outline::line([at(-0.45, 0.04), at(-0.13, 0.38), at(0.46, -0.34)]), pen()))
        }
        Verdict::Unstable => group
            .with(Path::stroked(Outline::line([at(-0.36, -0.36), at(0.36, 0.36)]), pen()))
            .with(Path::stroked(Outline::line([at(-0.36, 0.36), at(0.36, -0.36)]), pen())),
        Verdict::Undecided => {
            let mut hook = Outline::line([at(-0.3, -0.26)]);
            hook.segments.extend([
                crate::pictures::drawing::Segment::Curve(at(-0.28, -0.72), at(0.42, -0.68), at(0.3, -0.2)),
                crate::pictures::drawing::Segment::Curve(at(0.24, 0.0), at(0.0, 0.0), at(0.0, 0.22)),
            ]);
            group
                .with(Path::stroked(hook, pen()))
                .with(Path::filled(Outline::circle(at(0.0, 0.54), 0.15 * r), theme.page))
        }
    }
}
