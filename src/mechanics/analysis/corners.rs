//! Whether corners that touch decide a verdict.
//!
//! A corner that touches an edge or another corner carries no force unless the scene asks for it: in reality it breaks off or
//! slips. But a ladder at a wall, a common exercise, stands only by its corners. So two kinds of frames say so: those that
//! would stand if more corners carried force, and those that stand only because corners carry force.

use std::sync::Arc;

use super::{Analysis, FrameAnalysis, Options, Verdict, repeat};
use crate::mechanics::scene::{CornerContacts, Scene};
use crate::mechanics::statics::interface::Interfaces;

/// In scenes with more blocks, corners are not searched for this.
const MAX_BLOCKS: usize = 1000;

/// Decides the scene again in all conditions: with more corners that carry force, and with none. Marks the frames whose
/// verdict changes. Corners can only help. So more corners are tried only for frames that fall, and no corners only for
/// frames that stand.
pub(super) fn add_corners(analysis: &mut Analysis, options: &Options) {
    let scene = analysis.given().clone();
    if options.verdict_only || scene.blocks.len() > MAX_BLOCKS || scene.lists_contacts() {
        return;
    }
    let source = repeat::source_of_each(&scene.frames);
    let mut contacts = None;
    for corners in [CornerContacts::ON_EDGES, CornerContacts::ALL, CornerContacts::NONE] {
        let (from, to) = match (scene.corner_contacts, corners) {
            (now, other) if now == other || now.on_corners() && other.on_edges() => continue,
            (_, CornerContacts::NONE) => (Verdict::Stable, Verdict::Unstable),
            _ => (Verdict::Unstable, Verdict::Stable),
        };
        let is_open = |found: &FrameAnalysis| found.verdict == from && !found.corners_decide;
        if !analysis.frames.iter().any(|found| is_open(found)) || options.is_late() {
            continue;
        }
        let changed = Scene { corner_contacts: corners, ..Scene::clone(&scene) };
        let count = contacts.get_or_insert_with(|| Interfaces::new(&scene).all.len());
        if Interfaces::new(&changed).all.len() == *count {
            continue;
        }
        let verdicts = Analysis::decide(changed.into(), &options.only_verdict()).frames;
        for (k, first) in source.iter().copied().enumerate() {
            if k != first {
                analysis.frames[k] = analysis.frames[first].clone();
            } else if is_open(&analysis.frames[k]) && verdicts[k].verdict == to {
                let found = Arc::make_mut(&mut analysis.frames[k]);
                found.corners_decide = true;
                found.notices.push(notice(corners));
            }
        }
    }
}

/// Says what would change if these corners carried force.
fn notice(corners: CornerContacts) -> String {
    let (which, value) = match corners {
        CornerContacts::NONE => {
            return "it stands only because corners that touch carry force (`corner_contacts`); without them it falls"
                .into();
        }
        CornerContacts::ON_EDGES => ("corners that touch an edge", "on_edges"),
        _ => ("corners that touch", "true"),
    };
    format!("{which} carry no force here; with `--set corner_contacts={value}` they do, and it stands")
}
