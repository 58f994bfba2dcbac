//! Route 5: verdicts that depend on small gaps and overlaps become undecided.
//!
//! Edges that face each other with a gap above the contact tolerance and below a hundredth of the block's size may have
//! been meant to touch, and so may bodies that overlap by as little. Where there are such places a frame is judged both
//! ways: as it is written, where neither a gap nor an overlap carries force, and with all of them closed, if need be as far as
//! the corners beside them may be off. If the verdicts
//! differ nobody can say which structure was meant: the frame is undecided, with the places and the tolerance that settles
//! it. If they agree an overlap is reported beside the verdict. A tolerance that somebody gave settles it already.

use super::{FrameAnalysis, Options, UndecidedReason, Verdict, analyse, analyse_frames};
use crate::geometry::Point;
use crate::interface::{ContactsByBody, Interface, Interfaces, NearMiss, pinning_stone};
use crate::scene::{BodyId, Note, NoteCode, Penetration, Scene, ToleranceSource, size};

/// Places named in a message.
const MAX_NAMED_PLACES: usize = 3;
/// Gaps that are nearly contacts and are noted one by one.
const MAX_NOTED_GAPS: usize = 10;
/// What may have been meant to touch is closed by so many times the widest of it.
const ENOUGH: f64 = 1.01;
/// A corner that is off by rounding lies farther from where it belongs than from either of its edges, along which gaps and
/// overlaps are measured: closing may take so many times the widest of them.
const CORNERS: f64 = 2.5;
/// What is meant to touch is no farther apart than this part of the smallest block's size.
const NARROW: f64 = 0.01;

/// Where two bodies may have been meant to touch.
#[derive(Clone, Copy)]
struct Place {
    bodies: [BodyId; 2],
    at: Point,
    /// The width of the gap or the depth of the overlap, metres.
    size: f64,
    overlaps: bool,
}

impl From<&NearMiss> for Place {
    fn from(gap: &NearMiss) -> Place {
        Place {
            bodies: gap.bodies,
            at: gap.at,
            size: gap.distance,
            overlaps: false,
        }
    }
}

impl From<&Penetration> for Place {
    fn from(overlap: &Penetration) -> Place {
        Place {
            bodies: overlap.bodies,
            at: overlap.at,
            size: overlap.depth,
            overlaps: true,
        }
    }
}

/// Analyses the scene again with all small gaps and overlaps closed. Frames whose verdict then differs become undecided.
pub(super) fn recheck(
    scene: &Scene,
    found: &Interfaces,
    frames: &mut [FrameAnalysis],
    options: &Options,
) {
    if scene.healed.source == ToleranceSource::Given {
        return;
    }
    recheck_with_slivers(scene, found, frames, options);
    if found.near_misses.is_empty() && scene.penetrations.is_empty() {
        return;
    }
    let touching = ContactsByBody::new(&found.all);
    let places: Vec<Vec<Place>> = (scene.frames.iter())
        .map(|frame| {
            let mut placed = vec![false; scene.blocks.len()];
            for block in &frame.placed {
                placed[block.0] = true;
            }
            let stands = |body: &BodyId| match body {
                BodyId::Ground(_) => true,
                BodyId::Block(id) => placed[id.0],
            };
            let gaps = (found.near_misses.iter())
                .filter(|gap| gap.bodies.iter().all(stands))
                .filter(|gap| pinning_stone(gap, &touching, stands, scene.tolerance.gap).is_none());
            let overlaps = (scene.penetrations.iter()).filter(|o| o.bodies.iter().all(stands));
            gaps.map(Place::from)
                .chain(overlaps.map(Place::from))
                .collect()
        })
        .collect();
    let Some(widest) = (places.iter().flatten().map(|p| p.size)).reduce(f64::max) else {
        return;
    };
    let options = Options {
        margins: false,
        wedging: false,
        ..*options
    };
    let closed = |closing: f64| (closing, analyse(&scene.closed(closing), &options).1);
    let mut others = vec![closed(ENOUGH * widest)];
    let same = |((frame, other), places): ((&FrameAnalysis, &FrameAnalysis), &Vec<Place>)| {
        !places.is_empty() && frame.verdict == other.verdict
    };
    if frames.iter().zip(&others[0].1).zip(&places).any(same) {
        let sizes = scene.blocks.iter().map(|b| size(&b.body.polygon));
        let smallest = sizes.fold(f64::INFINITY, f64::min);
        let wider = (CORNERS * widest).min(NARROW * smallest);
        if wider > ENOUGH * widest {
            others.push(closed(wider));
        }
    }
    for (number, (frame, mut places)) in frames.iter_mut().zip(places).enumerate() {
        places.sort_by(|a, b| b.size.total_cmp(&a.size));
        let overlaps: Vec<Place> = places.iter().copied().filter(|p| p.overlaps).collect();
        let open = |verdict: Verdict| verdict == Verdict::Undecided;
        let closed = others
            .iter()
            .map(|(closing, all)| (*closing, all[number].verdict));
        let decided = |(_, other): &(f64, Verdict)| !open(*other) && *other != frame.verdict;
        let (closing, other) = (closed.clone().find(decided))
            .or(closed.clone().next())
            .unwrap_or((ENOUGH * widest, frame.verdict));
        // Beside an overlap no verdict is given that was not reached both ways.
        let unsure = open(frame.verdict) || (open(other) && overlaps.is_empty());
        if places.is_empty() {
            continue;
        }
        if frame.verdict != other && !unsure {
            frame.doubts = vec![gaps(scene, [frame.verdict, other], &places, closing)];
            frame.verdict = Verdict::Undecided;
        } else if !overlaps.is_empty() && !open(frame.verdict) {
            frame.notices.push(format!(
                "bodies overlap; the verdict is the same whether they touch there or not, the forces are those without \
                 touching: {}",
                listed(scene, &overlaps)
            ));
        }
    }
}

/// Analyses the scene again with contacts that were too short to count. Frames that fall without and stand with them become undecided.
fn recheck_with_slivers(
    scene: &Scene,
    found: &Interfaces,
    frames: &mut [FrameAnalysis],
    options: &Options,
) {
    let falls = frames.iter().any(|f| f.verdict == Verdict::Unstable);
    if found.slivers.is_empty() || !falls {
        return;
    }
    let options = Options {
        margins: false,
        wedging: false,
        ..*options
    };
    let others = analyse_frames(scene, &found.with_slivers(), &options);
    for ((frame, other), played) in frames.iter_mut().zip(&others).zip(&scene.frames) {
        if [frame.verdict, other.verdict] != [Verdict::Unstable, Verdict::Stable] {
            continue;
        }
        let placed = |body: &BodyId| match body {
            BodyId::Ground(_) => true,
            BodyId::Block(id) => played.placed.contains(id),
        };
        let slivers = (found.slivers.iter()).filter(|s| s.bodies.iter().all(placed));
        frame.doubts = vec![slivers_of(scene, &slivers.collect::<Vec<&Interface>>())];
        frame.verdict = Verdict::Undecided;
    }
}

fn slivers_of(scene: &Scene, slivers: &[&Interface]) -> UndecidedReason {
    let mut slivers = slivers.to_vec();
    slivers.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let named = slivers.iter().take(MAX_NAMED_PLACES).map(|sliver| {
        let [a, b] = sliver.bodies.map(|body| scene.name(body));
        let (length, at) = (sliver.length(), sliver.middle());
        format!(
            "{length:.2e} m between {a} and {b} at ({:.4}, {:.4})",
            at.x, at.y
        )
    });
    let named: Vec<String> = named.collect();
    let more = match slivers.len() - named.len() {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let length = |sliver: Option<&&Interface>| sliver.map_or(0.0, |s| s.length());
    let (counting, ignoring) = (
        0.5 * length(slivers.last()),
        ENOUGH * length(slivers.first()),
    );
    let words = format!(
        "it stands where contacts of next to no length carry force and falls where they are touching corners: {}{more}; a \
         contact_tolerance of {counting:.2e} m counts them, one of {ignoring:.2e} m does not",
        named.join(", "),
    );
    UndecidedReason::Slivers {
        counting,
        ignoring,
        words,
    }
}

/// The scene's own notes, and one for each of the first few gaps that are nearly contacts.
pub(super) fn notes(scene: &Scene, found: &Interfaces) -> Vec<Note> {
    let mut notes = scene.notes.clone();
    let code = NoteCode::NearMiss;
    if scene.healed.source == ToleranceSource::Given || scene.silences(code) {
        return notes;
    }
    let touching = ContactsByBody::new(&found.all);
    let gaps: Vec<&NearMiss> = (found.near_misses.iter())
        .filter(|gap| {
            scene.frames.iter().any(|frame| {
                let stands = |body: &BodyId| match body {
                    BodyId::Ground(_) => true,
                    BodyId::Block(id) => frame.placed.contains(id),
                };
                gap.bodies.iter().all(stands)
                    && pinning_stone(gap, &touching, stands, scene.tolerance.gap).is_none()
            })
        })
        .take(MAX_NOTED_GAPS + 1)
        .collect();
    for (number, gap) in gaps.iter().take(MAX_NOTED_GAPS).enumerate() {
        let [a, b] = gap.bodies.map(|body| scene.name(body));
        let is_last = number + 1 == MAX_NOTED_GAPS && gaps.len() > MAX_NOTED_GAPS;
        let more = if is_last {
            "; there are more such gaps"
        } else {
            ""
        };
        let message = format!(
            "{a} and {b} nearly touch at ({:.4}, {:.4}), {:.2e} m apart{more}",
            gap.at.x, gap.at.y, gap.distance
        );
        let hint = format!(
            "close it, or give \"contact_tolerance\": {:.1e} to count it as a contact",
            1.06 * gap.distance
        );
        // A block rather than the ground, of two blocks the later one.
        let body = gap.bodies[0].max(gap.bodies[1]);
        notes.push(scene.note(code, body, &message, &hint));
    }
    notes
}

fn gaps(scene: &Scene, verdicts: [Verdict; 2], places: &[Place], closing: f64) -> UndecidedReason {
    UndecidedReason::Gaps {
        open: verdicts[0],
        closed: verdicts[1],
        closing,
        words: words(scene, verdicts, places, closing),
    }
}

fn words(scene: &Scene, verdicts: [Verdict; 2], places: &[Place], closing: f64) -> String {
    let [written, closed] = verdicts.map(|verdict| match verdict {
        Verdict::Stable => "stands",
        Verdict::Unstable => "falls",
        Verdict::Undecided => "is undecided",
    });
    let enough = format!("a contact_tolerance of {closing:.2e} m closes them");
    let (places, overlap) = (listed(scene, places), places.iter().any(|p| p.overlaps));
    if overlap {
        return format!(
            "it {written} where overlaps and narrow gaps carry nothing and {closed} where bodies touch there: {places}; \
             {enough}, and bodies drawn clear of each other do not touch"
        );
    }
    format!(
        "it {written} with narrow gaps open and {closed} with them closed: {places}; {enough}, one of {:.2e} m leaves them \
         open",
        scene.tolerance.gap,
    )
}

/// The first of some places, and how many more there are.
fn listed(scene: &Scene, places: &[Place]) -> String {
    let named = places.iter().take(MAX_NAMED_PLACES).map(|place| {
        let kind = if place.overlaps { " of overlap" } else { "" };
        format!(
            "{:.2e} m{kind} between {} and {} at ({:.4}, {:.4})",
            place.size,
            scene.name(place.bodies[0]),
            scene.name(place.bodies[1]),
            place.at.x,
            place.at.y
        )
    });
    let named: Vec<String> = named.collect();
    let more = match places.len() - named.len() {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    named.join(", ") + &more
}
