//! Draws the differences between consecutive frames: blocks that were added or removed, and interfaces whose forces
//! changed.
//!
//! Each frame is compared with the previous frame. All forces have one scale. A ring marks an interface whose force
//! changed by more than 5 % of the larger of the two forces. The previous force is drawn there in a faint colour below
//! the present force. The words name the loads that changed.

use super::canvas::Canvas;
use super::change::{ForceChange, count_in_words, noise, shared_forces};
use super::design::{Key, Layer, Look, Mark};
use super::joint_forces::{JointForces, mark};
use super::option::Options;
use super::panel::{About, Figure, View};
use crate::geometry::Vector;
use crate::mechanics::analysis::{Analysis, Verdict};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::pictures::drawing::{Outline, PagePoint, Path};
use crate::products::wording::failure::pair;
use crate::products::wording::number::{force, listed, quantity};

/// The radius of the ring that marks a change, mm.
const RING_RADIUS: f64 = 1.5;
/// Opacity of previous forces.
const FAINT: f64 = 0.35;
/// Largest number of blocks that a sentence names.
const MAX_NAMED_BLOCKS: usize = 4;

/// The figure of the changes between frames.
pub(crate) struct Comparison;

impl Figure for Comparison {
    fn about(&self) -> About {
        About::new(
            "compare",
            "Changes between consecutive frames, or between the last frames of two scenes",
            "Changes in a dry-laid structure",
        )
    }

    fn scale(&self, view: &View<'_>, look: Look) -> f64 {
        JointForces.scale(view, look)
    }

    fn words(&self, analysis: &Analysis, frame: usize, _: &Options) -> Vec<String> {
        let words = changes_in_words(analysis, frame);
        if words.is_empty() { Vec::new() } else { vec![words.join("; ")] }
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        outlines(canvas);
        canvas.mentioned.extend(mentioned(canvas.analysis, canvas.number));
        let changes = changes(canvas.analysis, canvas.number).0;
        for change in &changes {
            previous(canvas, change);
        }
        JointForces.draw(canvas);
        rings(canvas, &changes);
    }
}

/// Returns the blocks that were added since the previous frame, and the blocks that were removed since then. Both lists
/// are empty for the first frame.
fn blocks(analysis: &Analysis, frame: usize) -> [Vec<BlockId>; 2] {
    let Some(earlier) = frame.checked_sub(1) else { return [Vec::new(), Vec::new()] };
    let frames = &analysis.given().frames;
    let (now, before) = (&frames[frame].placed, &frames[earlier].placed);
    let without = |a: &[BlockId], b: &[BlockId]| a.iter().copied().filter(|id| !b.contains(id)).collect();
    [without(now, before), without(before, now)]
}

/// Returns the blocks of `gone` whose outlines differ from the outlines of all blocks of `new`.
fn left_behind(scene: &Scene, new: &[BlockId], gone: &[BlockId]) -> Vec<BlockId> {
    let outline = |id: &BlockId| scene.blocks[id.0].body.polygon.outline();
    let is_left = |id: &BlockId| !new.iter().any(|other| outline(other) == outline(id));
    gone.iter().copied().filter(is_left).collect()
}

/// Compares the forces of a frame with those of the previous frame. Returns the interfaces that both frames have and
/// whose forces changed, and the number of interfaces that both frames have.
fn changes(analysis: &Analysis, frame: usize) -> (Vec<ForceChange<'_>>, usize) {
    let Some(earlier) = frame.checked_sub(1) else { return (Vec::new(), 0) };
    let scene = &**analysis.given();
    let shared = shared_forces([earlier, frame].map(|f| (scene, &analysis.frames[f].contacts[..])));
    let count = shared.len();
    let noise = noise(shared.iter().map(ForceChange::larger));
    (shared.into_iter().filter(|change| change.is_change(noise)).collect(), count)
}

/// Draws thick outlines around new blocks, and dashed outlines of blocks that are gone.
fn outlines(canvas: &mut Canvas<'_>) {
    let (analysis, scene, ink) = (canvas.analysis, canvas.scene(), canvas.theme().motion);
    // A block with other properties than before counts as new.
    let is_changed = |frame: usize| {
        let [new, gone] = blocks(analysis, frame).map(|ids| ids.into_iter().map(|id| &scene.blocks[id.0].id));
        let gone: Vec<&String> = gone.collect();
        new.into_iter().any(|name| gone.contains(&name))
    };
    let (new_words, gone_words) = if (0..analysis.frames.len()).any(is_changed) {
        ("new or changed", "gone, or the previous outline")
    } else {
        ("new", "gone")
    };
    let [new, gone] = blocks(analysis, canvas.number);
    let gone = left_behind(scene, &new, &gone);
    let dashed = canvas.dashes(ink, 0.3, [0.95, 0.75]);
    let all = [
        ("gone", gone, dashed, (15, gone_words), "Blocks that are gone"),
        ("new", new, canvas.pen(ink, 0.55), (14, new_words), "Blocks that are new"),
    ];
    for (class, ids, stroke, (rank, words), title) in all {
        let key = Key::block(rank, words, canvas.look, |small| vec![Path::stroked(small, stroke.clone())]);
        let mut outline = Outline::default();
        for id in &ids {
            outline.extend(canvas.camera.polygon(&scene.blocks[id.0].body.polygon));
        }
        if !ids.is_empty() {
            let mark = Mark::new(Layer::Force, class, vec![Path::stroked(outline, stroke)]).keyed(&key);
            canvas.put(mark.titled(title));
        }
    }
}

/// Draws the previous force of a joint in a faint colour.
fn previous(canvas: &mut Canvas<'_>, change: &ForceChange<'_>) {
    let then = change.contacts[0];
    let newtons = then.amount();
    if newtons * canvas.scale < canvas.mm(0.1) {
        return;
    }
    let u = then.resultant.force / newtons;
    let is_block = then.interface.bodies.map(|body| matches!(body, BodyId::Block(_)));
    let sign = if is_block[0] { 1.0 } else { -1.0 };
    let at = canvas.place(then.resultant.at);
    let both = is_block == [true; 2];
    let outline = mark(canvas.look, at, (sign * u.x, -sign * u.y), canvas.scale * newtons, both);
    let path = Path::filled(outline, canvas.theme().faint).with_opacity(FAINT);
    canvas.put(Mark::new(Layer::Force, "before", vec![path]));
}

/// Draws a ring around each force that changed.
fn rings(canvas: &mut Canvas<'_>, changes: &[ForceChange<'_>]) {
    let (scene, radius) = (canvas.scene(), canvas.mm(RING_RADIUS));
    let stroke = canvas.pen(canvas.theme().motion, 0.3);
    let small = 0.7 * radius;
    let symbol = vec![Path::stroked(Outline::circle(PagePoint::new(small, 0.0), small), stroke.clone())];
    let words = "force changed by over 5\u{a0}%; before: faint";
    let key = Key::new(16, words, symbol, 2.0 * small);
    for change in changes {
        let now = change.contacts[1];
        let pair = pair(scene, now.interface.bodies);
        let [was, is] = change.amounts().map(|amount| canvas.newtons(amount));
        let ring = Path::stroked(Outline::circle(canvas.place(now.resultant.at), radius), stroke.clone());
        let mark = Mark::new(Layer::Symbol, "change", vec![ring]).keyed(&key);
        canvas.put(mark.titled(format!("Between {pair}: {was} before, {is} now")).avoided(0.1));
    }
}

/// Returns the blocks that the words about a frame name.
fn mentioned(analysis: &Analysis, frame: usize) -> Vec<BlockId> {
    let [new, gone] = blocks(analysis, frame);
    let name = |id: &BlockId| &analysis.given().blocks[id.0].id;
    let gone = gone.iter().copied().filter(|id| !new.iter().any(|other| name(other) == name(id)));
    let lists = [new.clone(), gone.collect::<Vec<BlockId>>()];
    lists.into_iter().filter(|ids| ids.len() <= MAX_NAMED_BLOCKS).flatten().collect()
}

/// Says in words what changed since the previous frame.
fn changes_in_words(analysis: &Analysis, frame: usize) -> Vec<String> {
    let Some(earlier) = frame.checked_sub(1) else {
        let is_alone = analysis.frames.len() == 1;
        let words = "there is only one frame, so there is nothing to compare";
        return if is_alone { vec![words.to_owned()] } else { Vec::new() };
    };
    let mut stated = Vec::new();
    let [was, is] = [earlier, frame].map(|f| analysis.frames[f].verdict);
    if was != is {
        stated.push(match is {
            Verdict::Stable => "stands, unlike the previous frame".to_owned(),
            Verdict::Unstable => "falls, unlike the previous frame".to_owned(),
            Verdict::Undecided => "undecided, unlike the previous frame".to_owned(),
        });
    }
    let name = |id: BlockId| analysis.given().blocks[id.0].id.clone();
    let [came, went] = blocks(analysis, frame).map(|ids| ids.into_iter().map(name).collect::<Vec<String>>());
    // `both` are the names of blocks that both frames contain, but with different outlines, weights or loads.
    let both: Vec<String> = came.iter().filter(|n| went.contains(n)).cloned().collect();
    let alone = |names: &[String]| -> Vec<String> { names.iter().filter(|n| !both.contains(n)).cloned().collect() };
    let loads: Vec<(&String, String)> =
        both.iter().filter_map(|name| Some((name, changed_load(analysis, [earlier, frame], name)?))).collect();
    let loaded = |name: &String| loads.iter().any(|(other, _)| *other == name);
    let reshaped: Vec<String> = both.iter().filter(|name| !loaded(name)).cloned().collect();
    for (names, how) in [(alone(&came), "new"), (alone(&went), "gone"), (reshaped, "changed")] {
        match names.len() {
            0 => {}
            n if n <= MAX_NAMED_BLOCKS => stated.push(format!("{how}: {}", listed(&names))),
            n => stated.push(format!("{how}: {n} blocks")),
        }
    }
    match loads.len() {
        n if n <= MAX_NAMED_BLOCKS => stated.extend(loads.into_iter().map(|(_, change)| change)),
        n => stated.push(format!("other loads on {n} blocks")),
    }
    let (changed, shared) = changes(analysis, frame);
    stated.push(count_in_words(changed.len(), shared));
    stated
}

/// Describes how the sum of the loads on the block with this name changed between two frames: `load on block a: 2 kN at
/// 270° before, 3 kN at 270° now`. Returns `None` if it did not change.
fn changed_load(analysis: &Analysis, frames: [usize; 2], name: &str) -> Option<String> {
    let scene = analysis.given();
    let sum = |frame: usize| {
        let placed = &scene.frames[frame].placed;
        let own = scene.loads.iter().filter(|l| placed.contains(&l.block) && scene.blocks[l.block.0].id == name);
        own.fold((Vector::zeros(), 0.0), |(force, torque), load| (force + load.force, torque + load.torque))
    };
    let [was, is] = frames.map(sum);
    let words = |(load, turning): (Vector, f64)| match (load.norm() > 0.0, turning != 0.0) {
        (false, false) => "none".to_owned(),
        (false, true) => quantity(turning, scene.units.torque()),
        (true, false) => force(load, scene.units),
        (true, true) => format!("{} and {}", force(load, scene.units), quantity(turning, scene.units.torque())),
    };
    (was != is).then(|| format!("load on block {name}: {} before, {} now", words(was), words(is)))
}
