//! [`draw`]: draws the figures of an analysis. Its variants draw animations, separate panels, and pages for print.

use std::borrow::Cow;

use super::kind::Kind;
use super::mechanism::vehicle;
use super::moving::Moving;
use super::option::{At, Options};
use super::sheet;
use super::symmetric::symmetric;
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::Drawing;

/// Time between two pictures of an animated motion, seconds.
const MOTION_FRAME_SECONDS: f64 = 0.1;
/// The least and the largest number of steps of a motion, in addition to the first picture.
const MOTION_STEP_LIMITS: (f64, f64) = (12.0, 150.0);
/// Time for which the end of a motion is shown, seconds.
const MOTION_END_SECONDS: f64 = 1.0;

/// The largest number of panels of a figure. More take long to lay out, and nobody looks at them.
const MAX_PANELS: usize = 2000;

/// Refuses a scene with more frames than a figure may have panels. `remedy` says what to do.
///
/// # Errors
/// The number of frames, the limit and the remedy.
pub(crate) fn check_panels(scene: &Scene, remedy: &str) -> Result<(), String> {
    let count = scene.frames.len();
    if count <= MAX_PANELS {
        return Ok(());
    }
    Err(format!("a figure of {count} panels is too large, at most {MAX_PANELS} are drawn; {remedy}"))
}

/// Draws a figure of this kind with one panel for each frame of the analysis.
///
/// Units: the page is in pixels at natural size.
pub fn draw(analysis: &Analysis, kind: Kind, options: &Options) -> Drawing {
    let options = kind.options(analysis.given(), options);
    sheet::page(&shown(analysis, kind, &options), kind.drawer(&options), &options)
}

/// Draws the forces of an analysis. Each frame has a panel with its marks, its caption and its verdict.
///
/// The force between two bodies is a mark with two heads at the point where it acts. Its length is the force, in one
/// scale for all panels. Missing forces are red. Loads, robots and missing forces have their amounts. All panels show the
/// scene at the same scale.
///
/// For a scene on a lattice, and with the theme `thesis`, the figure looks as in the thesis: every force is an arrow in
/// the colour of the block on which it acts, and missing forces are thick and red. Unless the options select another
/// quantity, the colours of blocks show amplitudes: the larger of the weight and the largest normal force
/// ([Vallat23](crate::doc::references) §2.0.8 and §2.0.9).
///
/// Units: the page is in pixels at natural size. It is about 370 to 1100 wide, unless the options set a width or more
/// columns than fit.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, figure, output};
/// let scene = Scene::from_json(
///     r#"{ "drystone": 1, "title": "A brick",
///          "ground": [ { "polygon": [[-1, -1], [3, -1], [3, 0], [-1, 0]] } ],
///          "blocks": [ { "id": "brick", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "weight": 6 } ] }"#,
/// )?;
/// let drawing = figure::forces(&Analysis::new(&scene), &figure::Options::default());
/// let svg = output::svg::write(&drawing);
/// assert!(svg.contains("Weight of block brick: 6 N at 270°"));
/// let png = output::png::render(&svg, output::png::Size::Width(800))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn forces(analysis: &Analysis, options: &Options) -> Drawing {
    draw(analysis, Kind::Forces, options)
}

/// Draws the pictures of an animation, all at the same size and scale. Returns each picture with the time in seconds
/// for which it is shown. Each frame is shown for `seconds`. If the kind shows mechanisms, the blocks of a frame that
/// falls move during this time along its mechanism, until it is clear what falls, as far as no block enters another:
/// kinematics, not dynamics. They move slowly at the beginning and at the end. Their last position is then shown for one
/// more second. If a symmetric structure falls by a symmetric motion, its blocks move symmetrically.
///
/// Units: all times are in seconds.
pub fn film(analysis: &Analysis, kind: Kind, options: &Options, seconds: f64) -> Vec<(Drawing, f64)> {
    let options = kind.options(analysis.given(), options);
    if kind == Kind::Mechanism && options.at == Some(At::Vehicle) {
        return vehicle::film(&shown(analysis, kind, &options), &options, seconds);
    }
    if !kind.about().needs_elementary_mechanisms {
        let pages = frame_pages(analysis, kind, &options, &all_frames(analysis)).into_iter();
        return pages.map(|page| (page, seconds)).collect();
    }
    let mut steps: Vec<(usize, f64)> = Vec::new();
    let mut times = Vec::new();
    let count = (seconds / MOTION_FRAME_SECONDS).round().clamp(MOTION_STEP_LIMITS.0, MOTION_STEP_LIMITS.1) as u32;
    let moves = |frame| !Moving::new(analysis, frame, &options).motions.is_empty();
    for frame in 0..analysis.frames.len() {
        if !moves(frame) {
            steps.push((frame, 1.0));
            times.push(seconds);
            continue;
        }
        steps.extend((0..=count).map(|step| (frame, eased(f64::from(step) / f64::from(count)))));
        times.extend((0..count).map(|_| (seconds / f64::from(count)).max(0.01)));
        times.push(MOTION_END_SECONDS);
    }
    let analysis = symmetric(analysis, analysis.elementary());
    let options = Options { film: true, ..options };
    let pages = sheet::steps(&analysis, kind.drawer(&options), &options, &steps);
    pages.into_iter().zip(times).collect()
}

/// Converts a fraction of the time (0 to 1) to a fraction of the path (0 to 1). The motion is slow at its beginning
/// and at its end.
fn eased(time: f64) -> f64 {
    time * time * (3.0 - 2.0 * time)
}

/// Draws the panels of [`draw`] as separate pages, one for each frame. All pages have the same size and scale.
pub fn panels(analysis: &Analysis, kind: Kind, options: &Options) -> Vec<Drawing> {
    let options = kind.options(analysis.given(), options);
    frame_pages(&shown(analysis, kind, &options), kind, &options, &all_frames(analysis))
}

/// Like [`panels`], but only for the frames with these indices, counted from 0. Frames that do not exist are skipped.
pub fn panels_of(analysis: &Analysis, kind: Kind, options: &Options, frames: &[usize]) -> Vec<Drawing> {
    let options = kind.options(analysis.given(), options);
    let count = analysis.frames.len();
    let existing: Vec<usize> = frames.iter().copied().filter(|frame| *frame < count).collect();
    frame_pages(&shown(analysis, kind, &options), kind, &options, &existing)
}

/// Draws the figure of [`draw`] on several pages at the same scale, each with a title and a legend. The height of a
/// page is at most `max_ratio` times its width, unless a single row of panels is higher.
pub fn split(analysis: &Analysis, kind: Kind, options: &Options, max_ratio: f64) -> Vec<Drawing> {
    let options = kind.options(analysis.given(), options);
    sheet::split(&shown(analysis, kind, &options), kind.drawer(&options), &options, max_ratio)
}

/// Returns lower bounds for the width and the height of the page of [`draw`], in pixels. The function draws nothing, so
/// a caller can reject a figure that is too large before it is drawn.
pub fn least_size(analysis: &Analysis, kind: Kind, options: &Options) -> (f64, f64) {
    let options = kind.options(analysis.given(), options);
    sheet::least_size(analysis, kind.drawer(&options), &options)
}

fn all_frames(analysis: &Analysis) -> Vec<usize> {
    (0..analysis.frames.len()).collect()
}

/// Returns the analysis that a kind of figure shows: with elementary mechanisms if the kind needs them, without the axles
/// of a vehicle if the kind draws them, otherwise unchanged.
fn shown<'a>(analysis: &'a Analysis, kind: Kind, options: &Options) -> Cow<'a, Analysis> {
    let drives = kind == Kind::Mechanism && options.at == Some(At::Vehicle);
    if drives && analysis.frames.iter().any(|found| found.under_vehicle.is_some()) {
        return Cow::Owned(analysis.without_axles());
    }
    if kind.about().needs_elementary_mechanisms { Cow::Owned(analysis.elementary()) } else { Cow::Borrowed(analysis) }
}

/// Draws one page for each of these frames.
fn frame_pages(analysis: &Analysis, kind: Kind, options: &Options, frames: &[usize]) -> Vec<Drawing> {
    sheet::pages(analysis, kind.drawer(options), options, frames)
}
