//! [`labels`]: draws names of blocks and robots, and magnitudes of forces, at positions that avoid other shapes.
//!
//! [`placement`](crate::pictures::drawing::placement) finds the positions; this file determines the labels and their preferred
//! positions. A name is inside its block if there is space, otherwise next to it, usually with a leader line. If a
//! label that the text below the verdict mentions has no free position, it is drawn over other shapes. Any other label
//! without a free position is left out, and a note counts these labels.

mod amount;
mod lettering;
mod name;
mod obstacle;
mod row;
mod solid;
mod mention;

pub(crate) use amount::{CROWDED_AMOUNTS, Callout, EQUAL_FORCE_TOL, MAX_AMOUNTS};
pub(crate) use obstacle::ink;

use amount::{amounts, called_out};
use lettering::{Label, drawn, drawn_over, middle};
use mention::names;
use name::{name, robots};
use solid::DrawnBoxes;

use super::context::FigureContext;
use super::pen::Pen;
use super::view;
use super::words::{counted, listed};
use crate::geometry::Bounds;
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::placement::{Ink, LabelRequest, Placed, nearest, place_avoiding};
use crate::pictures::drawing::{Group, PagePoint, PageRect};

/// In frames with more blocks than this, only blocks that the text mentions are labelled with their names.
pub(crate) const MAX_LABELLED_BLOCKS: usize = 60;
/// If a unit length is at least this long, pixels, names may be at any distance from their blocks.
const ROOMY_UNIT_LENGTH: f64 = 26.0;
/// In frames with at most this many blocks, names may be at any distance from their blocks.
const FEW_BLOCKS: usize = 12;
/// Largest distance of a name from its block in other frames, pixels; longer leaders would hide the figure.
const MAX_DISTANCE: f64 = 8.0;

/// A name outside its block has a leader if the centroid of another block is closer to the name than this multiple of
/// the distance to the centroid of the named block.
const AMBIGUITY_RATIO: f64 = 1.5;

/// In the count of badly placed labels, a left-out amount, or a name without a free position that the text mentions,
/// counts as much as this number of other names.
const LOST_AMOUNT: usize = 100;

/// Two centres of a label are the same if their distance is below this, pixels.
const SAME_PLACE: f64 = 1e-6;

/// The class of the group of a frame's labels. The description of the group counts the labels that are left out.
pub(crate) const CLASS: &str = "labels";

/// Draws the labels of a frame, with additional texts (`callouts`), which are placed before all other labels. `ink`
/// returns the shapes that the labels must not cover; it is called only if there are labels. `view` is the shown part
/// of the scene, metres.
pub(crate) fn labels(pen: &Pen<'_>, view: Bounds, callouts: Vec<Callout>, ink: impl FnOnce() -> Ink) -> Group {
    let mut group = Group::with_class(CLASS);
    let callouts = callouts.into_iter().filter(|_| pen.context.options.labels);
    let callouts = callouts.map(|callout| called_out(pen, callout));
    let labels: Vec<Label> = callouts.chain(all_labels(pen, view)).collect();
    if labels.is_empty() {
        return group;
    }
    let places = positions(pen, view, &labels, ink());
    let mut missing: Vec<(&str, usize)> = Vec::new();
    let rects: Vec<PageRect> = places.iter().flatten().map(|placed| placed.rect).collect();
    for (label, placed) in labels.iter().zip(places) {
        let placed = placed.map(|placed| with_needed_leader(pen, label, placed));
        // A leader across another label makes both labels hard to read, so leave the name out. Amounts, and names that
        // the text mentions, are drawn nevertheless.
        let needed = label.named || label.class == "amount";
        let placed = placed.filter(|placed| needed || !crosses_label(placed, &rects));
        let badness = match placed {
            None if label.named || label.class == "amount" => LOST_AMOUNT,
            Some(p) if !p.avoided && !leaves_row(label, p.rect) => 0,
            _ => 1,
        };
        pen.context.cramped.set(pen.context.cramped.get() + badness);
        if let Some(placed) = placed {
            group.items.push(drawn(pen, label, placed).into());
            continue;
        }
        if label.named {
            group.items.push(drawn_over(pen, label).into());
            continue;
        }
        let what = match label.class {
            "amount" => "amount",
            _ => "name",
        };
        match missing.iter_mut().find(|known| known.0 == what) {
            Some(known) => known.1 += 1,
            None => missing.push((what, 1)),
        }
    }
    let missing: Vec<String> = missing.into_iter().map(|(what, n)| counted(n, what)).collect();
    if !missing.is_empty() {
        group.description = format!("no room for {}", listed(&missing));
    }
    group
}

/// Returns the position of each label; `None` for a label without a free position.
fn positions(pen: &Pen<'_>, view: Bounds, labels: &[Label], mut ink: Ink) -> Vec<Option<Placed>> {
    let page = pen.camera.rect(view);
    let requests: Vec<LabelRequest> = labels.iter().map(|l| l.request.clone()).collect();
    let solids = DrawnBoxes::new(pen);
    let covers_other_block = |number: usize, rect: PageRect| {
        let own: Option<BlockId> = labels[number].of;
        own.is_some_and(|own| solids.other(pen, own, rect))
    };
    let mut places = place_avoiding(&mut ink.clone(), page, &requests, &covers_other_block);
    let lost = labels.iter().zip(&places);
    let lost = lost.filter(|(label, placed)| label.named && placed.is_none());
    let lost: Vec<PageRect> = lost.map(|(label, _)| label.rect_at_anchor()).collect();
    if !lost.is_empty() {
        // Labels in `lost` are drawn over other shapes at their anchors. Place all other labels again, so that none of
        // them covers a label in `lost`.
        lost.into_iter().for_each(|rect| ink.rect(rect));
        places = place_avoiding(&mut ink, page, &requests, &covers_other_block);
    }
    places
}

/// True if the amount of a load in a row of loads is at none of the positions that its request lists. `rect` is the
/// rectangle of the label.
fn leaves_row(label: &Label, rect: PageRect) -> bool {
    let request = &label.request;
    let at = middle(rect);
    let mut own = request.preferred.iter().chain(&request.with_leader);
    let is_at = |p: &PagePoint| libm::hypot(p.x - at.x, p.y - at.y) < SAME_PLACE;
    !request.with_leader.is_empty() && !own.any(is_at)
}

/// Adds a leader line to the position of a name that a reader could otherwise mistake for the name of another block.
fn with_needed_leader(pen: &Pen<'_>, label: &Label, placed: Placed) -> Placed {
    let anchor = label.request.anchor;
    if placed.leader.is_none() && is_ambiguous(pen, label, placed.rect) {
        Placed { leader: Some([nearest(placed.rect, anchor), anchor]), ..placed }
    } else {
        placed
    }
}

/// True if the leader line of a position crosses the rectangle of another label.
fn crosses_label(placed: &Placed, rects: &[PageRect]) -> bool {
    let Some([from, to]) = placed.leader else {
        return false;
    };
    let mut line = Ink::default();
    line.line(from, to, 0.5);
    line.index();
    let mut others = rects.iter().filter(|rect| **rect != placed.rect);
    others.any(|rect| !line.clear(*rect))
}

/// True if a name lies outside its block and a reader could mistake it for the name of another block, because the
/// centroid of that block is closer to the name or nearly as close.
fn is_ambiguous(pen: &Pen<'_>, label: &Label, rect: PageRect) -> bool {
    let scene = &pen.context.analysis.scene;
    let Some(own) = label.of.filter(|_| label.class == "name") else {
        return false;
    };
    let at = pen.camera.back(middle(rect));
    let at = pen.displacement(own).map_or(at, |d| d.back(at));
    if scene.blocks[own.0].body.polygon.contains(at) {
        return false;
    }
    let far = |id: BlockId| {
        let anchor = pen.camera.place(pen.moved(id, scene.blocks[id.0].centroid));
        let end = nearest(rect, anchor);
        libm::hypot(end.x - anchor.x, end.y - anchor.y)
    };
    let others = scene.frames[pen.number].placed.iter().copied();
    let mut others = others.filter(|id| *id != own);
    others.any(|id| far(id) < AMBIGUITY_RATIO * far(own))
}

/// Returns a note such as `80 blocks: names left out` if a frame has too many blocks for labels. Returns
/// `None` if no frame has too many, or if the figure has neither names nor amounts.
pub(crate) fn left_out(context: &FigureContext<'_>) -> Option<String> {
    let options = context.options;
    let frames = &context.analysis.scene.frames;
    let most = frames.iter().map(|f| f.placed.len()).max().unwrap_or(0);
    let what = match (options.labels, options.amounts) {
        (true, true) => "names and amounts",
        (true, false) => "names",
        (false, true) => "amounts",
        (false, false) => return None,
    };
    let named = (0..frames.len()).any(|frame| !mentioned(context, frame).is_empty());
    let but = if named { " except those in the text" } else { "" };
    (most > MAX_LABELLED_BLOCKS).then(|| format!("{most} blocks: {what} left out{but}"))
}

/// Returns all labels of a frame, sorted by importance, the most important first. The amounts of loads in a row come
/// before all others, because other labels would separate them from their arrows.
fn all_labels(pen: &Pen<'_>, view: Bounds) -> Vec<Label> {
    let options = pen.context.options;
    let frame = &pen.context.analysis.scene.frames[pen.number];
    let scene = &pen.context.analysis.scene;
    let shown = |id: &&BlockId| {
        let body = &scene.blocks[id.0].body;
        options.zoom.is_none() || view::intersection(view, body.polygon.bounds()).is_some()
    };
    let few = frame.placed.iter().filter(shown).count() <= MAX_LABELLED_BLOCKS;
    let amounts = amounts(pen, few).into_iter();
    let in_row = |label: &Label| !label.request.with_leader.is_empty();
    let (mut labels, amounts): (Vec<Label>, Vec<Label>) = amounts.partition(in_row);
    let first = if options.labels { mentioned(pen.context, pen.number) } else { Vec::new() };
    let names = first.iter().filter_map(|id| name(pen, *id, view));
    labels.extend(names.map(|label| Label { named: true, ..label }));
    if options.labels {
        labels.extend(robots(pen, view));
    }
    if options.labels && few {
        let unmentioned = frame.placed.iter().filter(|id| !first.contains(id));
        labels.extend(unmentioned.filter_map(|id| close_name(pen, *id, view)));
    }
    labels.extend(amounts);
    labels.retain(|label| label.lines.iter().any(|line| !line.is_empty()));
    labels
}

/// Returns the label with the name of a block that the text does not mention. In a crowded frame, the name stays close
/// to its block, because long leader lines would hide the figure.
fn close_name(pen: &Pen<'_>, id: BlockId, view: Bounds) -> Option<Label> {
    let placed = pen.context.analysis.scene.frames[pen.number].placed.len();
    let any_distance = pen.unit() >= ROOMY_UNIT_LENGTH || placed <= FEW_BLOCKS;
    let mut label = name(pen, id, view)?;
    if !any_distance {
        let far = label.request.max_distance;
        label.request.max_distance = far.map(|far| far.min(MAX_DISTANCE));
    }
    Some(label)
}

/// Returns the blocks whose names occur in the text below the verdict of a frame, in placing order.
fn mentioned(context: &FigureContext<'_>, frame: usize) -> Vec<BlockId> {
    let scene = &context.analysis.scene;
    let stated = &context.statements[frame];
    let placed = scene.frames[frame].placed.iter().copied();
    placed.filter(|id| names(stated, &scene.blocks[id.0].id)).collect()
}
