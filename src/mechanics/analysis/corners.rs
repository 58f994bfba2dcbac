//! Whether corners that touch decide a verdict.
//!
//! A corner that touches an edge or another corner carries no force unless the scene asks for it: in reality it breaks off or
//! slips. But a ladder at a wall, a common exercise, stands only by its corners. So two kinds of frames say so: those that
//! would stand if more corners carried force, and those that stand only because corners carry force.

use std::sync::Arc;

use super::{Analysis, FrameAnalysis, Options, Verdict, repeat};
use crate::mechanics::scene::{CornerContacts, Scene};
use crate::mechanics::statics::interface::{ContactKind, Interfaces};
use crate::text::first_of;

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
    add_near_corners(analysis, options);
}

/// A corner is near an edge up to this multiple of the distance within which they touch.
const NEAR: f64 = 10.0;

/// Notes the frames that fall, but would stand if corners near an edge touched it and carried force.
fn add_near_corners(analysis: &mut Analysis, options: &Options) {
    let given = analysis.given().clone();
    let is_open = |found: &FrameAnalysis| found.verdict == Verdict::Unstable && !found.corners_decide;
    if !analysis.frames.iter().any(|found| is_open(found)) || options.is_late() {
        return;
    }
    let corners = if given.corner_contacts.on_edges() { given.corner_contacts } else { CornerContacts::ON_EDGES };
    let touching = Interfaces::new(&Scene { corner_contacts: corners, ..Scene::clone(&given) });
    let mut wider = Scene { corner_contacts: corners, ..Scene::clone(&given) };
    wider.tolerance.gap *= NEAR;
    let ground = wider.ground.iter_mut().map(|part| &mut part.body);
    ground.chain(wider.blocks.iter_mut().map(|block| &mut block.body)).for_each(|body| body.gap *= NEAR);
    let known = |bodies| touching.all.iter().any(|interface| interface.bodies == bodies);
    let near =
        Interfaces::new(&wider).all.into_iter().filter(|new| new.kind == ContactKind::Corner && !known(new.bodies));
    let pairs: Vec<String> = near.map(|new| new.bodies.map(|body| wider.name(body)).join(" and ")).collect();
    if pairs.is_empty() {
        return;
    }
    let tolerance = given.units.typed_length(wider.tolerance.gap);
    let value = tolerance.split(' ').next().unwrap_or_default();
    let notice = format!(
        "a corner comes near an edge, but is not within the {} that count as contact: {}; with `--set \
         contact_tolerance={value} --set corner_contacts=on_edges` it stands",
        given.units.small_length(given.tolerance.gap, 2),
        first_of(pairs, 3)
    );
    let verdicts = Analysis::decide(wider.into(), &options.only_verdict()).frames;
    for (found, near) in analysis.frames.iter_mut().zip(&verdicts) {
        if is_open(found) && near.verdict == Verdict::Stable {
            Arc::make_mut(found).notices.push(notice.clone());
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
