//! Draws the force polygon next to the structure, as on plates of graphic statics: the external forces on the structure
//! as arrows, each of which begins at the tip of the previous arrow.
//!
//! Its first sides are weights and loads, block by block. Then come the forces of the ground and the robots, and
//! finally missing forces from the ground and from robots, which are hollow and dashed. The polygon is closed if the
//! structure is in equilibrium. Forces that are missing between two blocks are no sides, because they act in opposite
//! pairs. If no other forces are missing, the polygon of a structure that falls is closed too. The forces of the ground
//! have the same letters at the structure and in the polygon. All polygons of a figure have one scale.

use std::rc::Rc;

use super::canvas::Canvas;
use super::description::described;
use super::design::{Key, Layer, Look, Mark, along, direction, unit};
use super::option::Options;
use super::panel::{About, Figure, Subject, View};
use super::placing::Label;
use super::{load, stage};
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::{ActingForce, Analysis, Contact, Failure, ForceKind, Verdict, acting_forces};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path, Stroke};
use crate::products::wording::number::{force, letter, quantity, round_below_in};
use crate::products::wording::verdict;

/// Largest width and height of the polygon, as a fraction of the larger side of the structure.
const POLYGON_SIZE: f64 = 0.75;
/// Largest height of the polygon as a fraction of the structure's width. If the structure is higher than this, the
/// height of the structure is the limit.
const POLYGON_HEIGHT: f64 = 0.4;
/// Gap between structure and polygon as a fraction of the structure's diagonal, and the least gap in unit lengths.
const POLYGON_GAP: (f64, f64) = (0.22, 1.0);
/// Space for amounts to the right of the polygon, as a fraction of the width of the structure.
const AMOUNT_SPACE: f64 = 0.15;
/// A polygon is closed if its gap is at most this fraction of the sum of the magnitudes of all forces. Rounding errors
/// are far smaller, and missing forces are far larger.
const CLOSURE_TOL: f64 = 1e-6;
/// Forces of the ground and of robots below this fraction of the largest force may be errors of the solver.
const NOISE: f64 = 1e-9;
/// If two points of a reaction are nearer to an action (a weight or a load) than this fraction of the polygon's size,
/// all reactions are moved sideways, so that they do not cover the actions.
const OVERLAP_SHARE: f64 = 0.03;
/// Distance by which reactions are moved sideways, as a fraction of the polygon's size.
const REACTION_OFFSET: f64 = 0.09;
/// Longest arrow that shows the scale of a polygon in the legend, mm.
const SCALE_ARROW: f64 = 12.0;
/// At most this many forces of the ground have letters.
const MAX_LETTERS: usize = 12;

/// The figure of the force polygon.
pub(crate) struct ForcePolygon;

impl Figure for ForcePolygon {
    fn about(&self) -> About {
        About::new(
            "polygon",
            "The external forces on the structure, and their force polygon next to it",
            "The force polygon of a dry-laid structure",
        )
    }

    fn subject(&self, analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        let subject = Subject::structure(analysis, options, frames);
        if options.zoom.is_some() {
            return subject;
        }
        let chains = (0..analysis.frames.len()).filter_map(|frame| Chain::new(analysis, frame));
        let corners = chains.filter_map(|chain| Bounds::from_points(chain.sides.into_iter().flatten()));
        let mut bounds = corners.fold(subject.bounds, Bounds::union);
        bounds.max.x += AMOUNT_SPACE * subject.bounds.width();
        Subject { bounds, ..subject }
    }

    fn scale(&self, view: &View<'_>, look: Look) -> f64 {
        let frames = 0..view.analysis.frames.len();
        let ground = frames.flat_map(|frame| sides(view.analysis, frame)).filter(|side| !side.kind.is_applied());
        let largest = ground.map(|side| side.force.norm()).fold(0.0, f64::max);
        if largest > 0.0 { look.mm(8.0) / largest } else { 0.0 }
    }

    fn words(&self, analysis: &Analysis, frame: usize, _options: &Options) -> Vec<String> {
        let sides = sides(analysis, frame);
        let found = &analysis.frames[frame];
        if sides.is_empty() {
            return Vec::new();
        }
        let how = match (found.verdict, is_closed(&sides)) {
            (_, false) => "the force polygon is open",
            (Verdict::Stable, true) => "the force polygon is closed",
            (Verdict::Unstable, true) => closure(&sides, &found.failures),
            (Verdict::Undecided, true) => "the force polygon of the forces found is closed",
        };
        let why = verdict::reason(&analysis.scene, found);
        let why = Some(why).filter(|why| found.verdict == Verdict::Undecided && !why.is_empty());
        std::iter::once(how.to_owned()).chain(why).collect()
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        let structure = Subject::structure(canvas.analysis, canvas.options, None).bounds;
        let all = core::mem::replace(&mut canvas.structure, canvas.camera.rect(structure));
        stage::ground(canvas);
        canvas.structure = all;
        stage::blocks(canvas);
        let sides = sides(canvas.analysis, canvas.number);
        at_structure(canvas, &sides);
        stage::held(canvas);
        load::loads(canvas);
        stage::names(canvas);
        if canvas.options.zoom.is_none() {
            polygon(canvas, &sides);
        }
    }
}

/// Returns the external forces on the structure of a frame, in the order of the polygon: weights and loads block by
/// block, forces of the ground and of robots, missing forces.
fn sides(analysis: &Analysis, frame: usize) -> Vec<ActingForce> {
    let (scene, found) = analysis.at(frame);
    let mut all = acting_forces(scene, &scene.frames[frame], found, Contact::acting);
    all.retain(|side| !matches!(side.kind.partner(), Some(BodyId::Block(_))));
    let largest = all.iter().map(|side| side.force.norm()).fold(0.0, f64::max);
    all.retain(|side| side.force.norm() > NOISE * largest);
    all
}

/// True if the sum of the forces is zero, except for rounding.
fn is_closed(sides: &[ActingForce]) -> bool {
    let sum: Vector = sides.iter().map(|side| side.force).sum();
    let all: f64 = sides.iter().map(|side| side.force.norm()).sum();
    sum.norm() <= CLOSURE_TOL * all
}

/// Returns why the polygon of a structure that falls is closed. Missing forces between two blocks act in opposite pairs,
/// so they do not change the polygon.
fn closure(sides: &[ActingForce], failures: &[Failure]) -> &'static str {
    let mut missing = sides.iter().filter(|side| side.kind.is_failure());
    let robots = missing.clone().any(|side| side.kind.robot().is_some());
    let ground = missing.any(|side| side.kind.robot().is_none());
    let carried: Vec<ActingForce> = sides.iter().filter(|side| !side.kind.is_failure()).cloned().collect();
    match (ground, robots) {
        (true, false) if !is_closed(&carried) => "the force polygon closes only with the missing forces at the ground",
        (false, true) if !is_closed(&carried) => "the force polygon closes only with the missing forces from robots",
        (true, true) if !is_closed(&carried) => {
            "the force polygon closes only with the missing forces at the ground and from robots"
        }
        (false, false) if failures.iter().any(|failure| failure.force().norm() > 0.0) => {
            "the force polygon closes, because the forces missing inside the structure act in pairs"
        }
        (false, false) => "the force polygon closes, because only torques are missing",
        _ => "the force polygon closes even without the missing forces, because their sum is zero",
    }
}

/// The polygon of a frame: the ends of each side in the scene, metres, and the scale.
struct Chain {
    sides: Vec<[Point; 2]>,
    /// Pairs of positions of the same corner, if actions and reactions are drawn apart; otherwise empty.
    joins: Vec<[Point; 2]>,
    /// Metres per newton.
    scale: f64,
}

/// Returns the corners of a polygon that begins at the origin, N.
fn corners(sides: &[ActingForce]) -> Vec<Point> {
    let mut at = Point::origin();
    let next = sides.iter().map(|side| {
        at += side.force;
        at
    });
    std::iter::once(Point::origin()).chain(next).collect()
}

impl Chain {
    /// Places the polygon of a frame to the right of the structure. Returns `None` if this frame has fewer than two
    /// external forces.
    fn new(analysis: &Analysis, frame: usize) -> Option<Chain> {
        let scene = &analysis.scene;
        let structure = scene.bounds(&stage::shown_blocks(scene))?;
        let scale = scale(analysis, structure)?;
        let sides = sides(analysis, frame);
        let corners = corners(&sides);
        let own = Bounds::from_points(corners.iter().copied()).filter(|_| corners.len() > 2)?;
        let size = own.width().max(own.height());
        let acting = sides.iter().position(|side| !side.kind.is_applied()).unwrap_or(sides.len());
        let is_covered = covers(&corners[..=acting], &corners[acting..], size);
        let aside = if is_covered { REACTION_OFFSET * size } else { 0.0 };
        let (share, least) = POLYGON_GAP;
        let apart = (share * structure.diagonal()).max(least * unit(scene, None));
        let middle = 0.5 * (structure.min.y + structure.max.y);
        let left = structure.max.x + apart;
        let shift = Vector::new(left - scale * own.min.x, middle - 0.5 * scale * (own.min.y + own.max.y));
        let place = |p: Point, aside: f64| Point::from((p.coords + Vector::new(aside, 0.0)) * scale + shift);
        let side = |(number, ends): (usize, &[Point])| {
            let aside = if number < acting { 0.0 } else { aside };
            [place(ends[0], aside), place(ends[1], aside)]
        };
        let ends = [(corners[acting], corners[acting]), (*corners.last()?, corners[0])];
        let joins = ends.map(|(answer, act)| [place(act, 0.0), place(answer, aside)]).to_vec();
        let sides = corners.windows(2).enumerate().map(side).collect();
        Some(Chain { sides, joins: if aside > 0.0 { joins } else { Vec::new() }, scale })
    }
}

/// Returns the one scale of all polygons, metres per newton; `None` if there is no polygon.
fn scale(analysis: &Analysis, structure: Bounds) -> Option<f64> {
    let size = POLYGON_SIZE * structure.width().max(structure.height());
    let high = structure.height().max(POLYGON_HEIGHT * structure.width()).min(size);
    let polygons = (0..analysis.frames.len()).map(|frame| corners(&sides(analysis, frame)));
    let boxes = polygons.filter(|corners| corners.len() > 2).filter_map(Bounds::from_points);
    let fitting = boxes.map(|own| (size / own.width()).min(high / own.height()));
    fitting.filter(|scale| *scale > 0.0 && scale.is_finite()).reduce(f64::min)
}

/// True if sides of reactions would cover sides of actions, because they lie on the same line. `acting` are the corners
/// at the ends of all actions (weights and loads), `answering` those at the ends of all reactions. `size` is the size
/// of the polygon, in the unit of these corners.
fn covers(acting: &[Point], answering: &[Point], size: f64) -> bool {
    // Two sides overlap if the midpoint and the first quarter point of one of them both lie close to the other.
    let from = |[a, b]: [Point; 2], p: Point| {
        let way = b - a;
        let length = way.norm_squared();
        let share = if length > 0.0 { ((p - a).dot(&way) / length).clamp(0.0, 1.0) } else { 0.0 };
        (p - (a + way * share)).norm()
    };
    let lies_on = |short: [Point; 2], long: [Point; 2]| {
        let middle = nalgebra::center(&short[0], &short[1]);
        let quarter = nalgebra::center(&short[0], &middle);
        [middle, quarter].iter().all(|p| from(long, *p) < OVERLAP_SHARE * size)
    };
    let pairs = |corners: &[Point]| corners.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<[Point; 2]>>();
    let (acting, answering) = (pairs(acting), pairs(answering));
    acting.iter().any(|a| answering.iter().any(|b| lies_on(*a, *b) || lies_on(*b, *a)))
}

/// Returns the colour of a force.
fn ink(canvas: &Canvas<'_>, kind: ForceKind) -> Colour {
    let theme = canvas.theme();
    match kind {
        ForceKind::Weight => theme.ink,
        ForceKind::Load => theme.load,
        ForceKind::Robot(robot) => theme.letters_on(theme.page, Some(theme.robot(robot.0))),
        kind if kind.is_failure() => theme.failure,
        _ => theme.arrow(1),
    }
}

/// Returns an arrow of a force, hollow and dashed for a missing force.
fn shape(canvas: &Canvas<'_>, kind: ForceKind, outline: Outline) -> Path {
    let (ink, page) = (ink(canvas, kind), canvas.theme().page);
    if kind.is_failure() {
        let edge = canvas.dashes(ink, 0.22, [0.55, 0.4]);
        return Path::filled(outline, page).with_stroke(edge);
    }
    Path::filled(outline, ink).cased(page, canvas.mm(0.12))
}

/// Describes a force, such as `Weight of block a: 6 N at 270°`.
fn title(canvas: &Canvas<'_>, side: &ActingForce) -> String {
    let scene = canvas.scene();
    let what = match side.kind.partner() {
        Some(_) => {
            let word = if side.kind.is_failure() { "Missing force" } else { "Force" };
            format!("{word} on block {} from the ground", scene.blocks[side.on.0].id)
        }
        None => described(scene, side.kind, BodyId::Block(side.on)),
    };
    format!("{what}: {}", force(side.force, scene.units))
}

/// Returns the name of each force in the figure: a letter for each of the largest forces of the ground, from left to
/// right, and the names of robots. Other forces have no names.
fn names(canvas: &Canvas<'_>, sides: &[ActingForce]) -> Vec<Option<String>> {
    let mut ground: Vec<usize> = (0..sides.len()).filter(|i| matches!(sides[*i].kind, ForceKind::Contact(_))).collect();
    ground.sort_by(|a, b| sides[*b].force.norm().total_cmp(&sides[*a].force.norm()));
    ground.truncate(MAX_LETTERS);
    ground.sort_by(|a, b| sides[*a].at.x.total_cmp(&sides[*b].at.x));
    let name = |(number, side): (usize, &ActingForce)| match side.kind {
        ForceKind::Robot(robot) => Some(canvas.scene().robots[robot.0].id.clone()),
        _ => ground.iter().position(|i| *i == number).map(|place| letter(place).to_uppercase()),
    };
    sides.iter().enumerate().map(name).collect()
}

/// Draws the forces of the ground and of robots at the structure, with their names, and the missing forces.
fn at_structure(canvas: &mut Canvas<'_>, sides: &[ActingForce]) {
    for (side, name) in sides.iter().zip(names(canvas, sides)) {
        let norm = side.force.norm();
        if side.kind.is_applied() {
            continue;
        }
        let u = direction(side.force);
        let (at, length) = (canvas.place(side.at), (canvas.scale * norm).max(canvas.mm(1.6)));
        let outline = canvas.arrow(length, [0.7, 1.7, 1.7], 0.62).outline(at, u);
        let layer = if side.kind.is_failure() { Layer::Missing } else { Layer::Force };
        let mark = Mark::new(layer, "force", vec![shape(canvas, side.kind, outline)]).titled(title(canvas, side));
        canvas.put(mark.avoided(0.2));
        if let Some(name) = name.filter(|_| matches!(side.kind, ForceKind::Contact(_)) && canvas.options.labels) {
            let anchors = vec![along(at, u, 0.0, 0.0), along(at, u, 0.5 * length, 0.0)];
            let away = Some((-u.0, -u.1));
            canvas.label(Label { bold: true, away, ..Label::new(name, ink(canvas, side.kind), anchors, 3) });
        }
    }
}

/// Draws the force polygon of the frame, with the names and the amounts of its sides. If actions and reactions are
/// drawn apart, dashed lines connect the two positions of each common corner. A dashed line closes the gap of an open
/// polygon.
fn polygon(canvas: &mut Canvas<'_>, sides: &[ActingForce]) {
    let Some(chain) = Chain::new(canvas.analysis, canvas.number) else { return };
    let (theme, units) = (canvas.theme(), canvas.scene().units.force());
    let (missing_key, scale_key, join_key) = keys(canvas, &chain);
    let tagged: Vec<(&ActingForce, Option<String>)> = sides.iter().zip(names(canvas, sides)).collect();
    let middle = chain.sides.iter().flatten().map(|p| p.x).sum::<f64>() / (2 * chain.sides.len()).max(1) as f64;
    for ((side, name), ends) in tagged.into_iter().zip(&chain.sides) {
        let [from, to] = ends.map(|p| canvas.place(p));
        let length = to.distance(from).max(1e-9);
        let u = ((to.x - from.x) / length, (to.y - from.y) / length);
        let wide = if side.kind.is_failure() { 0.9 } else { 0.42 };
        let outline = canvas.arrow(length, [wide, 1.2 + wide, 1.7], 0.6).outline(from, u);
        let mark = Mark::new(Layer::Force, "side", vec![shape(canvas, side.kind, outline)]).titled(title(canvas, side));
        let mark = if side.kind.is_failure() { mark.keyed(&missing_key) } else { mark };
        canvas.put(mark.avoided(0.2));
        let amount = quantity(side.force.norm(), units);
        let words = match (side.kind, name) {
            (kind, _) if kind == ForceKind::Load || kind.is_failure() => amount,
            (_, Some(name)) => format!("{name}: {amount}"),
            _ => continue,
        };
        // The name stands outside of the polygon.
        let outward = if nalgebra::center(&ends[0], &ends[1]).x < middle { -1.0 } else { 1.0 };
        let anchors = [0.5, 0.3, 0.7].map(|share| along(from, u, share * length, 0.0)).to_vec();
        if canvas.states_amounts() {
            let label = Label::new(words, ink(canvas, side.kind), anchors, 4);
            canvas.label(Label { away: Some((outward, 0.0)), ..label });
        }
    }
    weights(canvas, sides, &chain);
    canvas.explain(scale_key);
    let line = |canvas: &Canvas<'_>, ends: [Point; 2]| Outline::line(ends.map(|p| canvas.place(p)));
    let closed = is_closed(sides);
    // In an open polygon, the second line would look like the line of the gap, so it is left out.
    for join in chain.joins.iter().take(if closed { 2 } else { 1 }) {
        let path = Path::stroked(line(canvas, *join), join_stroke(canvas));
        let mark = Mark::new(Layer::Force, "join", vec![path]).keyed(&join_key);
        canvas.put(mark.titled("The same corner of the force polygon, drawn at two places"));
    }
    if let (Some(last), Some(first), false) = (chain.sides.last(), chain.sides.first(), closed) {
        let stroke = canvas.dashes(theme.failure, 0.26, [0.9, 0.7]);
        let path = Path::stroked(line(canvas, [last[1], first[0]]), stroke);
        let mark = Mark::new(Layer::Force, "gap", vec![path]);
        canvas.put(mark.titled("The force that is missing for equilibrium"));
    }
}

/// Writes the sum of the weights beside their sides, if these follow one another without a load between them.
fn weights(canvas: &mut Canvas<'_>, sides: &[ActingForce], chain: &Chain) {
    let count = sides.iter().take_while(|side| side.kind == ForceKind::Weight).count();
    let all = sides.iter().filter(|side| side.kind == ForceKind::Weight).count();
    let Some([[from, _], [_, to]]) =
        chain.sides.first().zip(chain.sides.get(count.wrapping_sub(1))).map(|(a, b)| [*a, *b])
    else {
        return;
    };
    if count != all || !canvas.states_amounts() {
        return;
    }
    let sum: Vector = sides.iter().take(count).map(|side| side.force).sum();
    let words = if count == 1 { "weight" } else { "weights" };
    let words = format!("{words}: {}", canvas.newtons(sum.norm()));
    let at = |share: f64| canvas.place(from + (to - from) * share);
    let label = Label::new(words, canvas.theme().ink, vec![at(0.5), at(0.3), at(0.7)], 5);
    canvas.label(Label { away: Some((-1.0, 0.0)), ..label });
}

fn join_stroke(canvas: &Canvas<'_>) -> Stroke {
    canvas.dashes(canvas.theme().faint, 0.15, [0.4, 0.4])
}

/// Returns the entries of the legend: a missing force, the scale, and corners at two places.
fn keys(canvas: &Canvas<'_>, chain: &Chain) -> (Rc<Key>, Rc<Key>, Rc<Key>) {
    let (theme, units) = (canvas.theme(), canvas.scene().units.force());
    let start = PagePoint::new(0.0, 0.0);
    let arrow = |length: f64, wide: f64| canvas.arrow(length, [wide, 1.2 + wide, 1.7], 0.6).outline(start, (1.0, 0.0));
    let width = canvas.mm(4.8);
    let symbol = vec![shape(canvas, ForceKind::MissingPull(BodyId::Ground(0)), arrow(width, 0.9))];
    let missing = Key::new(50, "missing", symbol, width);
    let scale = canvas.camera.length(chain.scale);
    let amount = round_below_in(canvas.mm(SCALE_ARROW) / scale, units);
    let symbol = vec![Path::filled(arrow(amount * scale, 0.42), theme.ink)];
    let words = format!("{} in the force polygon", quantity(amount, units));
    let scale = Key::new(20, words, symbol, amount * scale);
    let words = "the same corner of the force polygon, drawn at two places";
    (missing, scale, Key::line(60, words, width, join_stroke(canvas)))
}
