//! Gaps on which a verdict hinges.
//!
//! Edges that face each other with a gap above the contact tolerance and below a hundredth of the block's size may have
//! been meant to touch. Where there are such gaps a frame is judged both ways, with the gaps open, as they are written, and
//! closed. If the verdicts differ nobody can say which structure was meant: the frame is undecided, with the places and
//! the tolerance that settles it. A tolerance that somebody gave settles it already.

use std::collections::BTreeMap;

use super::{Ask, FrameAnalysis, Options, Verdict, examine};
use crate::interface::{Interface, Interfaces, Near};
use crate::scene::{BodyId, Note, NoteCode, Scene, ToleranceSource};

/// So many places are named.
const NAMED: usize = 3;
/// So many gaps that are nearly contacts are noted one by one.
const NOTED: usize = 10;
/// The gaps are closed by so many times the widest of them.
const ENOUGH: f64 = 1.01;

/// Makes frames undecided that stand with gaps open and fall with them closed, or the other way round.
pub(super) fn judge(
    scene: &Scene,
    found: &Interfaces,
    frames: &mut [FrameAnalysis],
    options: &Options,
) {
    if scene.healed.source == ToleranceSource::Given || found.near.is_empty() {
        return;
    }
    let mut touching: BTreeMap<BodyId, Vec<&Interface>> = BTreeMap::new();
    for interface in &found.all {
        for body in interface.bodies {
            touching.entry(body).or_default().push(interface);
        }
    }
    let gaps: Vec<Vec<&Near>> = (scene.frames.iter())
        .map(|frame| {
            let mut placed = vec![false; scene.blocks.len()];
            for block in &frame.placed {
                placed[block.0] = true;
            }
            let stands = |body: &BodyId| match body {
                BodyId::Ground(_) => true,
                BodyId::Block(id) => placed[id.0],
            };
            (found.near.iter())
                .filter(|gap| gap.bodies.iter().all(stands))
                .filter(|gap| !held_open(gap, &touching, stands, scene.tolerance.gap))
                .collect()
        })
        .collect();
    let Some(widest) = (gaps.iter().flatten().map(|n| n.distance)).reduce(f64::max) else {
        return;
    };
    let closed = scene.closed(ENOUGH * widest);
    let options = Options {
        margins: Ask::No,
        wedging: Ask::No,
        ..*options
    };
    let (_, others) = examine(&closed, &options);
    for ((frame, other), gaps) in frames.iter_mut().zip(&others).zip(&gaps) {
        let differ = matches!(
            (frame.verdict, other.verdict),
            (Verdict::Stable, Verdict::Unstable) | (Verdict::Unstable, Verdict::Stable)
        );
        if differ && !gaps.is_empty() {
            frame.doubt = words(scene, frame.verdict, gaps);
            frame.verdict = Verdict::Undecided;
        }
    }
}

/// The scene's own notes, and one for each of the first few gaps that are nearly contacts.
pub(super) fn notes(scene: &Scene, found: &Interfaces) -> Vec<Note> {
    let mut notes = scene.notes.clone();
    let code = NoteCode::NearMiss;
    if scene.healed.source == ToleranceSource::Given || scene.silences(code) {
        return notes;
    }
    let mut touching: BTreeMap<BodyId, Vec<&Interface>> = BTreeMap::new();
    for interface in &found.all {
        for body in interface.bodies {
            touching.entry(body).or_default().push(interface);
        }
    }
    let gaps: Vec<&Near> = (found.near.iter())
        .filter(|gap| {
            scene.frames.iter().any(|frame| {
                let stands = |body: &BodyId| match body {
                    BodyId::Ground(_) => true,
                    BodyId::Block(id) => frame.placed.contains(id),
                };
                gap.bodies.iter().all(stands)
                    && !held_open(gap, &touching, stands, scene.tolerance.gap)
            })
        })
        .take(NOTED + 1)
        .collect();
    for (number, gap) in gaps.iter().take(NOTED).enumerate() {
        let [a, b] = gap.bodies.map(|body| scene.name(body));
        let is_last = number + 1 == NOTED && gaps.len() > NOTED;
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

/// Whether a stone that stands between the two bodies keeps the gap open: a pinning stone is meant, and so is its gap.
///
/// Such a stone touches both, on opposite sides, and is as high between them as the gap is wide.
fn held_open(
    gap: &Near,
    touching: &BTreeMap<BodyId, Vec<&Interface>>,
    stands: impl Fn(&BodyId) -> bool,
    tolerance: f64,
) -> bool {
    let [one, other] = gap.bodies;
    let of = |body: BodyId| touching.get(&body).map_or(&[][..], |list| &list[..]);
    of(one).iter().any(|below| {
        let stone = partner(below, one);
        let is_stone = matches!(stone, BodyId::Block(_)) && stands(&stone);
        is_stone
            && of(other).iter().any(|above| {
                let across = (above.middle() - below.middle()).dot(&below.normal).abs();
                let opposite = below.normal.dot(&above.normal).abs() > 0.99;
                partner(above, other) == stone
                    && opposite
                    && across > 0.5 * gap.distance
                    && across <= 1.1 * gap.distance + tolerance
            })
    })
}

fn partner(interface: &Interface, body: BodyId) -> BodyId {
    let [a, b] = interface.bodies;
    if a == body { b } else { a }
}

fn words(scene: &Scene, open: Verdict, gaps: &[&Near]) -> String {
    let (open, closed) = match open {
        Verdict::Stable => ("stands", "falls"),
        _ => ("falls", "stands"),
    };
    let mut gaps = gaps.to_vec();
    gaps.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    let places: Vec<String> = (gaps.iter().take(NAMED))
        .map(|n| {
            format!(
                "{:.2e} m between {} and {} at ({:.4}, {:.4})",
                n.distance,
                scene.name(n.bodies[0]),
                scene.name(n.bodies[1]),
                n.at.x,
                n.at.y
            )
        })
        .collect();
    let more = match gaps.len() - places.len() {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let widest = gaps.first().map_or(0.0, |n| n.distance);
    format!(
        "it {open} with narrow gaps open and {closed} with them closed: {}{more}; a contact_tolerance of {:.2e} m closes \
         them, one of {:.2e} m leaves them open",
        places.join(", "),
        ENOUGH * widest,
        scene.tolerance.gap,
    )
}
