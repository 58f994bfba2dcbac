//! Route 5: makes a verdict undecided if it depends on a small gap or overlap that may be a drawing error.
//!
//! Edges that face each other with a gap above the contact tolerance and below a hundredth of the smaller block's size
//! may have been meant to touch. So may bodies with an overlap of this size. A frame with such places is decided twice:
//! as it is written, where neither gaps nor overlaps carry force, and with all of them closed. If necessary, they are
//! closed by a larger length, which allows for corners with rounded coordinates. If the verdicts differ, the intended
//! structure is unknown. The frame is then undecided, and the reason lists the places and a tolerance that closes them.
//! If the verdicts agree, a notice reports the overlaps. A frame also becomes undecided if it falls, but stands if very
//! short contacts carry force. If the scene gives a tolerance, none of this is checked.

use super::analyse::{analyse, analyse_frames};
use super::{Ask, FrameAnalysis, Options, UndecidedReason, Verdict};
use crate::geometry::Point;
use crate::mechanics::scene::{BodyId, Frame, Note, NoteCode, Penetration, Scene, ToleranceSource, size};
use crate::mechanics::statics::interface::{
    ContactsByBody, Interface, Interfaces, MAX_GAP_PER_SIZE, NearMiss, pinning_stone,
};
use crate::text::first_of;

/// The largest number of places that a message names.
const MAX_NAMED_PLACES: usize = 3;
/// The largest number of notes on gaps that are nearly contacts.
const MAX_NOTED_GAPS: usize = 10;
/// All places are closed by the widest gap or overlap times this factor: one percent more than needed, so that
/// rounding leaves none open.
const CLOSING_FACTOR: f64 = 1.01;
/// A corner with rounded coordinates is farther from its true position than from the true edges, and gaps and overlaps
/// are measured from the edges. The closing length may therefore have to be the widest gap or overlap times this
/// factor.
const CORNER_CLOSING_FACTOR: f64 = 2.5;

/// A place where two bodies may have been meant to touch.
#[derive(Clone, Copy)]
struct AmbiguousPlace {
    bodies: [BodyId; 2],
    at: Point,
    /// The width of the gap or the depth of the overlap, metres.
    size: f64,
    overlaps: bool,
}

impl From<&NearMiss> for AmbiguousPlace {
    fn from(gap: &NearMiss) -> AmbiguousPlace {
        AmbiguousPlace { bodies: gap.bodies, at: gap.at, size: gap.distance, overlaps: false }
    }
}

impl From<&Penetration> for AmbiguousPlace {
    fn from(overlap: &Penetration) -> AmbiguousPlace {
        AmbiguousPlace { bodies: overlap.bodies, at: overlap.at, size: overlap.depth, overlaps: true }
    }
}

/// Analyses the scene again: once with very short contacts added, and once with all small gaps and overlaps closed. A
/// frame becomes undecided if this changes its verdict. If the deadline has passed, every frame with overlapping bodies
/// becomes undecided. Does nothing if the scene gives a contact tolerance.
pub(super) fn recheck(scene: &Scene, interfaces: &Interfaces, frames: &mut [FrameAnalysis], options: &Options) {
    if scene.healed.source == ToleranceSource::Given {
        return;
    }
    // A second analysis cannot change frames that are already undecided.
    if frames.iter().all(|frame| is_undecided(frame.verdict)) {
        return;
    }
    if options.is_late() {
        leave_overlaps_undecided(scene, frames);
        return;
    }
    recheck_with_slivers(scene, interfaces, frames, options);
    if interfaces.near_misses.is_empty() && scene.penetrations.is_empty() {
        return;
    }
    let places = ambiguous_places(scene, interfaces);
    // Close all gaps and overlaps of all frames by the same length, which depends on the widest of them.
    let Some(widest) = (places.iter().flatten().map(|p| p.size)).reduce(f64::max) else {
        return;
    };
    let closed = closed_verdicts(scene, frames, &places, widest, options);
    for (number, (frame, mut places)) in frames.iter_mut().zip(places).enumerate() {
        if places.is_empty() {
            continue;
        }
        places.sort_by(|a, b| b.size.total_cmp(&a.size));
        let closed = closed.iter().map(|(by, all)| (*by, all[number].verdict));
        compare_verdicts(scene, frame, &places, &closed.collect::<Vec<_>>());
    }
}

/// Returns, for each frame, the small gaps and overlaps where bodies may have been meant to touch. Gaps that a pinning
/// stone keeps open are left out.
fn ambiguous_places(scene: &Scene, interfaces: &Interfaces) -> Vec<Vec<AmbiguousPlace>> {
    let touching = ContactsByBody::new(&interfaces.all);
    let in_frame = |frame: &Frame| {
        let is_placed = frame.presence();
        // A gap that a pinning stone between the two bodies keeps open is intended, so it is left out.
        let gaps = (interfaces.near_misses.iter())
            .filter(|gap| gap.bodies.iter().all(&is_placed))
            .filter(|gap| pinning_stone(gap, &touching, &is_placed, scene.tolerance.gap).is_none());
        let overlaps = (scene.penetrations.iter()).filter(|o| o.bodies.iter().all(&is_placed));
        gaps.map(AmbiguousPlace::from).chain(overlaps.map(AmbiguousPlace::from)).collect()
    };
    scene.frames.iter().map(in_frame).collect()
}

/// Analyses the scene with gaps and overlaps closed by slightly more than the widest of them. If the verdict of some
/// frame with gaps or overlaps does not change, also closes them by a larger length, because corners with rounded
/// coordinates may be farther from their true position. Returns each closing length, in metres, with the frames that
/// were analysed with it.
fn closed_verdicts(
    scene: &Scene,
    frames: &[FrameAnalysis],
    places: &[Vec<AmbiguousPlace>],
    widest: f64,
    options: &Options,
) -> Vec<(f64, Vec<FrameAnalysis>)> {
    let options = Options { ask: Ask::NOTHING, ..*options };
    let closed = |closing: f64| (closing, analyse(&scene.closed(closing), &options).1);
    let mut all = vec![closed(CLOSING_FACTOR * widest)];
    let is_unchanged = |((frame, other), places): ((&FrameAnalysis, &FrameAnalysis), &Vec<AmbiguousPlace>)| {
        !places.is_empty() && frame.verdict == other.verdict
    };
    if frames.iter().zip(&all[0].1).zip(places).any(is_unchanged) {
        let sizes = scene.blocks.iter().map(|b| size(&b.body.polygon));
        let smallest = sizes.fold(f64::INFINITY, f64::min);
        let wider = (CORNER_CLOSING_FACTOR * widest).min(MAX_GAP_PER_SIZE * smallest);
        if wider > CLOSING_FACTOR * widest {
            all.push(closed(wider));
        }
    }
    all
}

/// Makes a frame undecided if its verdict changes when gaps and overlaps are closed. Otherwise, if bodies overlap, adds
/// a notice. `closed` contains each closing length in metres with its verdict; `places` are sorted, the largest first.
fn compare_verdicts(scene: &Scene, frame: &mut FrameAnalysis, places: &[AmbiguousPlace], closed: &[(f64, Verdict)]) {
    let overlaps: Vec<AmbiguousPlace> = places.iter().copied().filter(|p| p.overlaps).collect();
    // Use the first closing length whose verdict is decided and differs from the verdict of the frame. If there is
    // none, use the first length.
    let differs = |(_, other): &&(f64, Verdict)| !is_undecided(*other) && *other != frame.verdict;
    let Some((closing, other)) = closed.iter().find(differs).or(closed.first()).copied() else {
        return;
    };
    // If bodies overlap, the frame keeps its verdict only if the second analysis, in which these bodies only touch, is
    // decided and gives the same verdict. If there are only gaps, an undecided second analysis changes nothing.
    let is_unsure = is_undecided(frame.verdict) || (is_undecided(other) && overlaps.is_empty());
    if frame.verdict != other && !is_unsure {
        frame.doubts = vec![gaps_reason(scene, [frame.verdict, other], places, closing)];
        frame.verdict = Verdict::Undecided;
    } else if !overlaps.is_empty() && !is_undecided(frame.verdict) {
        frame.notices.push(format!(
            "bodies overlap; the verdict is the same whether they touch there or not, the forces are those without \
             touching: {}",
            list_places(scene, &overlaps)
        ));
    }
}

fn is_undecided(verdict: Verdict) -> bool {
    verdict == Verdict::Undecided
}

/// Makes every frame with overlapping bodies undecided: after the deadline, the second verdict cannot be computed.
fn leave_overlaps_undecided(scene: &Scene, frames: &mut [FrameAnalysis]) {
    for (frame, scene_frame) in frames.iter_mut().zip(&scene.frames) {
        let placed = scene_frame.presence();
        let mut overlaps = scene.penetrations.iter();
        if !is_undecided(frame.verdict) && overlaps.any(|o| o.bodies.iter().all(&placed)) {
            frame.doubts = vec![UndecidedReason::Late];
            frame.verdict = Verdict::Undecided;
        }
    }
}

/// Analyses the scene again, also using contacts that are shorter than the minimum length. A frame that falls without
/// these contacts and stands with them becomes undecided.
fn recheck_with_slivers(scene: &Scene, interfaces: &Interfaces, frames: &mut [FrameAnalysis], options: &Options) {
    let falls = frames.iter().any(|f| f.verdict == Verdict::Unstable);
    if interfaces.slivers.is_empty() || !falls {
        return;
    }
    let options = Options { ask: Ask::NOTHING, ..*options };
    let others = analyse_frames(scene, &interfaces.with_slivers(), &options);
    for ((frame, other), scene_frame) in frames.iter_mut().zip(&others).zip(&scene.frames) {
        if [frame.verdict, other.verdict] != [Verdict::Unstable, Verdict::Stable] {
            continue;
        }
        let placed = scene_frame.presence();
        let slivers = (interfaces.slivers.iter()).filter(|s| s.bodies.iter().all(&placed));
        frame.doubts = vec![slivers_reason(scene, &slivers.collect::<Vec<&Interface>>())];
        frame.verdict = Verdict::Undecided;
    }
}

/// Returns the reason for an undecided frame that stands only if very short contacts carry force.
fn slivers_reason(scene: &Scene, slivers: &[&Interface]) -> UndecidedReason {
    let mut slivers = slivers.to_vec();
    slivers.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let places = slivers.iter().map(|sliver| {
        let [a, b] = sliver.bodies.map(|body| scene.name(body));
        let (length, at) = (sliver.length(), sliver.middle());
        let (length, at) = (scene.units.small_length(length, 2), scene.units.coordinates(at));
        format!("{length} between {a} and {b} at {at}")
    });
    let places = first_of(places, MAX_NAMED_PLACES);
    let length = |sliver: Option<&&Interface>| sliver.map_or(0.0, |s| s.length());
    let (counting, ignoring) = (0.5 * length(slivers.last()), CLOSING_FACTOR * length(slivers.first()));
    let words = format!(
        "it stands if contacts of almost no length carry force and falls if they are only touching corners: {places}; \
         a contact_tolerance of {} counts them, one of {} does not",
        scene.units.typed_length(counting),
        scene.units.typed_length(ignoring),
    );
    UndecidedReason::Slivers { counting, ignoring, words }
}

/// Returns the notes of the scene, and further notes for the first few gaps that are nearly contacts.
pub(super) fn notes(scene: &Scene, interfaces: &Interfaces) -> Vec<Note> {
    let mut notes = scene.notes.clone();
    let code = NoteCode::NearMiss;
    if scene.healed.source == ToleranceSource::Given || scene.silences(code) {
        return notes;
    }
    let touching = ContactsByBody::new(&interfaces.all);
    let gaps: Vec<&NearMiss> = (interfaces.near_misses.iter())
        .filter(|gap| {
            scene.frames.iter().any(|frame| {
                let is_placed = frame.presence();
                gap.bodies.iter().all(&is_placed)
                    && pinning_stone(gap, &touching, &is_placed, scene.tolerance.gap).is_none()
            })
        })
        .take(MAX_NOTED_GAPS + 1)
        .collect();
    for (number, gap) in gaps.iter().take(MAX_NOTED_GAPS).enumerate() {
        let [a, b] = gap.bodies.map(|body| scene.name(body));
        let is_last = number + 1 == MAX_NOTED_GAPS && gaps.len() > MAX_NOTED_GAPS;
        let more = if is_last { "; there are more such gaps" } else { "" };
        let message = format!(
            "{a} and {b} nearly touch at {}, {} apart{more}",
            scene.units.coordinates(gap.at),
            scene.units.small_length(gap.distance, 2)
        );
        let hint = format!(
            "close it, or give \"contact_tolerance\": {:.1e} to count it as a contact",
            scene.units.length().value_from_si(1.06 * gap.distance)
        );
        // The note must name a block, not the ground. If both bodies are blocks, it names the later one.
        let body = gap.bodies[0].max(gap.bodies[1]);
        notes.push(scene.note(code, body, &message, &hint));
    }
    notes
}

/// Returns the reason why a frame is undecided. `verdicts` are the verdicts with the gaps open and with them closed.
fn gaps_reason(scene: &Scene, verdicts: [Verdict; 2], places: &[AmbiguousPlace], closing: f64) -> UndecidedReason {
    UndecidedReason::Gaps {
        open: verdicts[0],
        closed: verdicts[1],
        closing,
        words: gaps_explanation(scene, verdicts, places, closing),
    }
}

fn gaps_explanation(scene: &Scene, verdicts: [Verdict; 2], places: &[AmbiguousPlace], closing: f64) -> String {
    let [written, closed] = verdicts.map(Verdict::verb);
    let closing = scene.units.typed_length(closing);
    let enough = format!("a contact_tolerance of {closing} closes them");
    let (places, overlap) = (list_places(scene, places), places.iter().any(|p| p.overlaps));
    if overlap {
        return format!(
            "it {written} if overlaps and narrow gaps carry no force and {closed} if bodies touch there: {places}; \
             {enough}, and bodies drawn apart do not touch"
        );
    }
    format!(
        "it {written} with narrow gaps open and {closed} with them closed: {places}; {enough}, one of {} leaves them \
         open",
        scene.units.small_length(scene.tolerance.gap, 2),
    )
}

/// Lists the first few gaps and overlaps with their sizes and bodies, and adds the number of the others.
fn list_places(scene: &Scene, places: &[AmbiguousPlace]) -> String {
    let places = places.iter().map(|place| {
        let kind = if place.overlaps { " of overlap" } else { "" };
        format!(
            "{}{kind} between {} and {} at {}",
            scene.units.small_length(place.size, 2),
            scene.name(place.bodies[0]),
            scene.name(place.bodies[1]),
            scene.units.coordinates(place.at)
        )
    });
    first_of(places, MAX_NAMED_PLACES)
}
