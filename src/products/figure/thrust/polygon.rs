//! The force polygon beside the line of thrust, as on plates of graphic statics: the load line of weights and loads, and the
//! reactions of the ground, robots and missing forces that close it. All polygons of a figure have one scale.
//!
//! If one chain of blocks leads from the ground to the ground, the two reactions meet in the pole O, and a ray from it
//! shows the force in the joint with the same number. Reactions are R₁, R₂, … at the structure and in the polygon. Forces
//! that are missing between two blocks are no sides, because they act in opposite pairs.

use std::borrow::Cow;

use super::chain::{Chain, chains};
use super::{shown, states};
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::{
    ActingForce, Contact, Failure, ForceKind, FrameAnalysis, SolvedFrame, Verdict, acting_forces,
};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::pictures::drawing::{Colour, Outline, PagePoint, PageRect, Path};
use crate::products::figure::canvas::Canvas;
use crate::products::figure::description::described;
use crate::products::figure::design::{ArrowSize, Key, Layer, Mark, along, direction};
use crate::products::figure::option::Options;
use crate::products::figure::panel::Subject;
use crate::products::figure::placing::Label;
use crate::products::wording::number::{force, quantity, round_below_in};

/// The panel of the polygon is this fraction of the width of the structure wide, and at least this fraction of its height.
const PANEL: (f64, f64) = (0.8, 0.55);
/// The space beside the polygon for its amounts, as a fraction of the width of the panel.
const BESIDE: f64 = 0.45;
/// The space on both sides of the line between the two drawings, and the space for amounts beside loads that come from the
/// right, mm.
const GUTTER: f64 = 2.0;
const LABELS: f64 = 9.0;
/// Largest height of the polygon as a fraction of the width of its panel, if the structure is lower.
const HEIGHT: f64 = 0.8;
/// A polygon is closed if its gap is at most this fraction of the sum of the magnitudes of all forces. Rounding errors
/// are far smaller, and missing forces are far larger.
const CLOSURE_TOL: f64 = 1e-6;
/// Forces of the ground and of robots below this fraction of the largest force may be errors of the solver.
const NOISE: f64 = 1e-9;
/// With more joints at one part of the ground, the part has one reaction.
const MAX_REACTIONS: usize = 6;
/// If reactions are nearer to the load line than this fraction of the size of the polygon, they are moved aside.
const OVERLAP_SHARE: f64 = 0.03;
/// Widths of arrows, of the rays and of the dots of the load line, mm.
const ARROW: f64 = 0.5;
const RAY: f64 = 0.18;
const DOT: f64 = 0.28;
/// The longest reaction at the structure, and the longest arrow that shows the scale, mm.
const REACTION: f64 = 8.0;
const SCALE_ARROW: f64 = 12.0;

/// Adds the panel of the polygon to the part of the scene that is shown.
pub(super) fn widened(subject: &mut Subject) {
    let (wide, high) = (subject.bounds.width(), subject.bounds.height());
    subject.bounds.max.x += PANEL.0 * wide.max(PANEL.1 * high);
}

/// A side of the polygon.
struct Side {
    kind: ForceKind,
    force: Vector,
    /// The point where the force acts on the structure, metres.
    at: Point,
    /// R₁ or the name of a robot; empty for other forces.
    name: String,
    title: String,
    /// For weights, the ends of the single weights, N from the beginning of the side.
    inner: Vec<Vector>,
}

/// The polygon of a frame.
struct Polygon {
    sides: Vec<Side>,
    chain: Option<Chain>,
}

impl Polygon {
    fn new(solved: SolvedFrame<'_>) -> Polygon {
        let SolvedFrame { scene, found, .. } = solved;
        let frame = solved.frame();
        let mut all = acting_forces(scene, frame, found, Contact::acting);
        all.retain(|side| !matches!(side.kind.partner(), Some(BodyId::Block(_))));
        let largest = all.iter().map(|side| side.force.norm()).fold(0.0, f64::max);
        all.retain(|side| side.force.norm() > NOISE * largest);
        let on_ground = |joint: usize| matches!(found.contacts[joint].interface.bodies[1], BodyId::Ground(_));
        let chain = chains(solved).into_iter().find(|chain| {
            let ends = [chain.joints.first(), chain.joints.last()];
            chain.blocks.len() == frame.placed.len() && ends.into_iter().flatten().all(|joint| on_ground(*joint))
        });
        // Applied forces from left to right, those of a chain in its order; then reactions from right to left.
        let place = |block: BlockId| match &chain {
            Some(chain) => chain.blocks.iter().position(|other| *other == block).unwrap_or(0) as f64,
            None => scene.blocks[block.0].centroid.x,
        };
        let (mut applied, rest): (Vec<ActingForce>, Vec<ActingForce>) =
            all.into_iter().partition(|side| side.kind.is_applied() || chain.is_some() && side.kind.robot().is_some());
        applied.sort_by(|a, b| place(a.on).total_cmp(&place(b.on)));
        let (ground, others): (Vec<ActingForce>, Vec<ActingForce>) =
            rest.into_iter().partition(|side| matches!(side.kind, ForceKind::Contact(_)));
        let mut sides: Vec<Side> = Vec::new();
        for acting in &applied {
            match sides.last_mut() {
                Some(last) if last.kind == ForceKind::Weight && acting.kind == ForceKind::Weight => {
                    last.inner.push(last.force);
                    last.force += acting.force;
                    last.title =
                        format!("Weights of {} blocks: {}", last.inner.len() + 1, force(last.force, scene.units));
                }
                _ => sides.push(side(scene, acting)),
            }
        }
        let mut reactions = reactions(scene, ground);
        reactions.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
        for (number, side) in reactions.iter_mut().enumerate() {
            let digits = (number + 1).to_string();
            let below = digits.chars().filter_map(|digit| char::from_u32(0x2080 + digit.to_digit(10)?));
            side.name = format!("R{}", below.collect::<String>());
        }
        sides.extend(reactions.into_iter().rev());
        sides.extend(others.iter().map(|acting| side(scene, acting)));
        Polygon { sides, chain }
    }

    /// Returns the corners, which begin at the origin, N.
    fn corners(&self) -> Vec<Point> {
        let mut at = Point::origin();
        let next = self.sides.iter().map(|side| {
            at += side.force;
            at
        });
        std::iter::once(Point::origin()).chain(next).collect()
    }

    /// Returns the number of sides that are weights, loads or robots of a chain: those of the load line.
    fn applied(&self) -> usize {
        let is_reaction =
            |side: &Side| !(side.kind.is_applied() || self.chain.is_some() && side.kind.robot().is_some());
        self.sides.iter().position(is_reaction).unwrap_or(self.sides.len())
    }
}

/// True if the sum of the forces is zero, except for rounding.
fn closes<'s>(sides: impl Iterator<Item = &'s Side> + Clone) -> bool {
    let sum: Vector = sides.clone().map(|side| side.force).sum();
    let all: f64 = sides.map(|side| side.force.norm()).sum();
    sum.norm() <= CLOSURE_TOL * all
}

fn side(scene: &Scene, acting: &ActingForce) -> Side {
    let what = match acting.kind.partner() {
        Some(_) => {
            let word = if acting.kind.is_failure() { "Missing force" } else { "Force" };
            format!("{word} on block {} from the ground", scene.blocks[acting.on.0].id)
        }
        None => described(scene, acting.kind, BodyId::Block(acting.on)),
    };
    let name = acting.kind.robot().map_or(String::new(), |robot| scene.robots[robot.0].id.clone());
    let title = format!("{what}: {}", force(acting.force, scene.units));
    Side { kind: acting.kind, force: acting.force, at: acting.at, name, title, inner: Vec::new() }
}

/// Returns the reactions: one for each joint with the ground, or one for each part of the ground if there are many.
fn reactions(scene: &Scene, ground: Vec<ActingForce>) -> Vec<Side> {
    if ground.len() <= MAX_REACTIONS {
        return ground.iter().map(|acting| side(scene, acting)).collect();
    }
    let mut sums: Vec<Side> = Vec::new();
    for acting in &ground {
        let own = side(scene, acting);
        match sums.iter_mut().find(|sum| sum.kind == own.kind) {
            Some(sum) => {
                // The points are weighted by their forces.
                let [a, b] = [sum.force.norm(), own.force.norm()];
                sum.at += (own.at - sum.at) * (b / (a + b));
                sum.force += own.force;
                sum.title = format!("Force from the ground: {}", force(sum.force, scene.units));
            }
            None => sums.push(own),
        }
    }
    sums
}

/// Returns why the polygon of a structure that falls closes or not. Missing forces between two blocks act in opposite
/// pairs, so they do not change the polygon.
fn closure(polygon: &Polygon, failures: &[Failure]) -> &'static str {
    let mut missing = polygon.sides.iter().filter(|side| side.kind.is_failure());
    let robots = missing.clone().any(|side| side.kind.robot().is_some());
    let ground = missing.any(|side| side.kind.robot().is_none());
    let carried = || polygon.sides.iter().filter(|side| !side.kind.is_failure());
    let is_open = !closes(carried());
    match (ground, robots) {
        (true, false) if is_open => "the force polygon closes only with the missing forces at the ground",
        (false, true) if is_open => "the force polygon closes only with the missing forces from robots",
        (true, true) if is_open => {
            "the force polygon closes only with the missing forces at the ground and from robots"
        }
        (false, false) if failures.iter().any(|failure| failure.force().norm() > 0.0) => {
            "the force polygon closes, because the forces missing inside the structure act in pairs"
        }
        (false, false) => "the force polygon closes, because only torques are missing",
        _ => "the force polygon closes even without the missing forces, because their sum is zero",
    }
}

/// Returns the forces of the polygon: those of the line of thrust of a frame that stands, otherwise those found.
fn found<'a>(canvas: &Canvas<'a>, number: usize) -> Cow<'a, FrameAnalysis> {
    let found = &canvas.analysis.frames[number];
    match found.verdict {
        Verdict::Stable => shown(states(canvas, number), found),
        _ => Cow::Borrowed(found),
    }
}

/// Draws the polygon to the right of the structure, the reactions at the structure, and the numbers of the joints. Returns
/// what the words say about it.
pub(super) fn draw(canvas: &mut Canvas<'_>) -> Vec<String> {
    let number = canvas.number;
    let own = found(canvas, number);
    let polygon = Polygon::new(canvas.solved().with_results(&own));
    if polygon.sides.len() < 2 {
        return vec!["no force polygon: there are no two forces".to_owned()];
    }
    let Some(scale) = scale(canvas) else { return Vec::new() };
    let panel = panel(canvas);
    reactions_at_structure(canvas, &polygon);
    drawn(canvas, &polygon, &own, (panel, scale));
    let how = match canvas.found().verdict {
        _ if !closes(polygon.sides.iter()) => "the force polygon is open",
        Verdict::Unstable => closure(&polygon, &canvas.found().failures),
        Verdict::Stable => "the force polygon is closed",
        Verdict::Undecided => "the force polygon of the forces found is closed",
    };
    if canvas.look.is_strip { Vec::new() } else { vec![how.to_owned()] }
}

/// Returns the rectangle of the panel, pixels.
fn panel(canvas: &Canvas<'_>) -> PageRect {
    let options = Options { zoom: None, ..canvas.options.clone() };
    let structure = canvas.camera.rect(Subject::structure(canvas.analysis, &options, None).bounds);
    let right = structure.at.x + structure.width;
    let width = (canvas.structure.at.x + canvas.structure.width - right).max(1.0);
    // Loads from the right lie between the structure and the panel.
    let most = canvas.extent_of_marks();
    let loads = if most > right + canvas.mm(2.0 * GUTTER) { canvas.mm(LABELS) } else { 0.0 };
    let at = PagePoint::new(most.max(right) + loads + canvas.mm(2.0 * GUTTER), structure.at.y);
    PageRect { at, width, height: structure.height }
}

/// Returns the one scale of all polygons, pixels per newton.
fn scale(canvas: &Canvas<'_>) -> Option<f64> {
    let panel = panel(canvas);
    let wide = (1.0 - BESIDE) * panel.width;
    let high = panel.height.max(HEIGHT * panel.width);
    let bounds = (0..canvas.analysis.frames.len()).filter_map(|frame| {
        let polygon = Polygon::new(canvas.analysis.at(frame).with_results(&found(canvas, frame)));
        Bounds::from_points(polygon.corners())
    });
    let fitting = bounds.map(|own| (wide / own.width()).min(high / own.height()));
    fitting.filter(|scale| *scale > 0.0 && scale.is_finite()).reduce(f64::min)
}

/// Returns the colour of a force.
fn ink(canvas: &Canvas<'_>, kind: ForceKind) -> Colour {
    let theme = canvas.theme();
    match kind {
        ForceKind::Weight => theme.ink,
        ForceKind::Load => theme.load,
        ForceKind::Robot(robot) => theme.letters_on(theme.page, Some(theme.robot(robot.0))),
        kind if kind.is_failure() => theme.failure,
        _ => theme.motion.mixed(theme.ink, 0.45),
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

fn arrow(canvas: &Canvas<'_>, kind: ForceKind, length: f64) -> ArrowSize {
    let wide = if kind.is_failure() { 0.9 } else { ARROW };
    canvas.arrow(length, [wide, 1.2 + wide, 1.8], 0.6)
}

/// Draws the reactions of the ground at the structure, with their tips at the joints, and their names at their tails.
fn reactions_at_structure(canvas: &mut Canvas<'_>, polygon: &Polygon) {
    let reactions = || polygon.sides.iter().filter(|side| matches!(side.kind, ForceKind::Contact(_)));
    let largest = reactions().map(|side| side.force.norm()).fold(0.0, f64::max);
    for side in reactions() {
        let u = direction(side.force);
        let length = (canvas.mm(REACTION) * side.force.norm() / largest).max(canvas.mm(1.6));
        let tail = along(canvas.place(side.at), u, -length, 0.0);
        let outline = arrow(canvas, side.kind, length).outline(tail, u);
        let mark = Mark::new(Layer::Load, "reaction", vec![shape(canvas, side.kind, outline)]);
        canvas.put(mark.titled(side.title.clone()).avoided(0.2));
        if canvas.options.labels {
            let label = Label::new(side.name.clone(), ink(canvas, side.kind), vec![tail], 3);
            canvas.label(Label { bold: true, away: Some((-u.0, -u.1)), ..label });
        }
    }
}

/// Draws the polygon with the names and the amounts of its sides, and the line between it and the structure.
fn drawn(canvas: &mut Canvas<'_>, polygon: &Polygon, own: &FrameAnalysis, (panel, scale): (PageRect, f64)) {
    let (theme, units) = (canvas.theme(), canvas.scene().units.force());
    let corners = polygon.corners();
    let Some(bounds) = Bounds::from_points(corners.iter().copied()) else { return };
    let applied = polygon.applied();
    let size = bounds.width().max(bounds.height());
    let aside = if covers(&corners[..=applied], &corners[applied..], size) { canvas.mm(4.0) } else { 0.0 };
    // The names of the reactions need more space than amounts. Those of an arch are on the left, beside its pole.
    let share = if polygon.chain.is_some() { 0.56 } else { 0.38 };
    let middle = PagePoint::new(panel.at.x + share * panel.width, panel.at.y + panel.height / 2.0);
    let half = [bounds.min.x + bounds.max.x, bounds.min.y + bounds.max.y].map(|sum| 0.5 * sum);
    let shift = 0.5 * aside;
    let place = |p: Point, is_reaction: bool| {
        let x = middle.x + scale * (p.x - half[0]) + if is_reaction { shift } else { -shift };
        PagePoint::new(x, middle.y - scale * (p.y - half[1]))
    };
    // No text crosses the line between the two drawings.
    let x = panel.at.x - canvas.mm(GUTTER);
    let high = 0.5 * panel.height.max(scale * bounds.height());
    let rule = Outline::line([-high, high].map(|y| PagePoint::new(x, middle.y + y)));
    let path = Path::stroked(rule, canvas.pen(theme.faint.mixed(theme.page, 0.6), 0.16));
    canvas.put(Mark::new(Layer::Ground, "gutter", vec![path]).avoided(0.6));
    canvas.gutter = Some(x);
    rays(canvas, polygon, &corners, own, &place);
    let centre = half[0];
    let missing = arrow(canvas, ForceKind::MissingPull(BodyId::Ground(0)), canvas.mm(4.8));
    let missing =
        shape(canvas, ForceKind::MissingPull(BodyId::Ground(0)), missing.outline(PagePoint::new(0.0, 0.0), (1.0, 0.0)));
    let missing = Key::new(50, "missing", vec![missing], canvas.mm(4.8));
    for (number, side) in polygon.sides.iter().enumerate() {
        let is_reaction = number >= applied;
        let [from, to] = [number, number + 1].map(|corner| place(corners[corner], is_reaction));
        let length = to.distance(from).max(1e-9);
        let u = ((to.x - from.x) / length, (to.y - from.y) / length);
        let outline = arrow(canvas, side.kind, length).outline(from, u);
        let mark = Mark::new(Layer::Force, "side", vec![shape(canvas, side.kind, outline)]).titled(side.title.clone());
        canvas.put(if side.kind.is_failure() { mark.keyed(&missing) } else { mark }.avoided(0.2));
        let dots = side.inner.iter().map(|inner| place(corners[number] + *inner, is_reaction));
        let dots: Vec<Path> = dots.map(|at| canvas.disc(at, DOT, theme.ink)).collect();
        canvas.put(Mark::new(Layer::Symbol, "vertices", dots));
        let amount = quantity(side.force.norm(), units);
        let words = match side.kind {
            _ if side.name.is_empty() => amount,
            _ => format!("{} = {amount}", side.name),
        };
        if canvas.states_amounts() {
            // The load line has its amounts on the side that is away from the reactions.
            let is_left = 0.5 * (corners[number].x + corners[number + 1].x) < centre;
            let outward = match (is_reaction, aside > 0.0) {
                (false, true) => -1.0,
                (true, true) => 1.0,
                (false, false) if polygon.chain.is_some() => 1.0,
                _ if is_left => -1.0,
                _ => 1.0,
            };
            let anchors = [0.5, 0.3, 0.7, 0.15, 0.85].map(|share| along(from, u, share * length, 0.0)).to_vec();
            // The amounts of the load line of an arch give way to the numbers of its rays.
            let rank = if polygon.chain.is_some() && !is_reaction { 35 } else { 4 };
            let label = Label::new(words, ink(canvas, side.kind), anchors, rank);
            canvas.label(Label { away: Some((outward, 0.0)), ..label });
        }
    }
    if aside > 0.0 {
        let stroke = canvas.dashes(theme.faint, 0.15, [0.4, 0.4]);
        let key = Key::line(60, "reactions moved aside", canvas.mm(4.8), stroke.clone());
        let closed = closes(polygon.sides.iter());
        for corner in [applied, 0].into_iter().take(if closed { 2 } else { 1 }) {
            let other = if corner == 0 { corners.len() - 1 } else { corner };
            let join = Outline::line([place(corners[corner], false), place(corners[other], true)]);
            let mark = Mark::new(Layer::Force, "join", vec![Path::stroked(join, stroke.clone())]).keyed(&key);
            canvas.put(mark.titled("The same corner of the force polygon"));
        }
    }
    if let (Some(last), false) = (corners.last(), closes(polygon.sides.iter())) {
        let gap = Outline::line([place(*last, true), place(corners[0], false)]);
        let path = Path::stroked(gap, canvas.dashes(theme.failure, 0.26, [0.9, 0.7]));
        canvas.put(Mark::new(Layer::Force, "gap", vec![path]).titled("The force that is missing for equilibrium"));
    }
    let newtons = round_below_in(canvas.mm(SCALE_ARROW) / scale, units);
    let symbol = arrow(canvas, ForceKind::Weight, newtons * scale).outline(PagePoint::new(0.0, 0.0), (1.0, 0.0));
    let words = format!("{} of weight in the force polygon", quantity(newtons, units));
    canvas.explain(Key::new(20, words, vec![Path::filled(symbol, theme.ink)], newtons * scale));
}

/// Draws the pole, a ray for each inner joint of the chain, and the numbers of the joints at the structure.
fn rays(
    canvas: &mut Canvas<'_>,
    polygon: &Polygon,
    corners: &[Point],
    own: &FrameAnalysis,
    place: &impl Fn(Point, bool) -> PagePoint,
) {
    let Some(chain) = &polygon.chain else { return };
    let theme = canvas.theme();
    let pole = corners[0] - chain.forces[0];
    let vertices: Vec<PagePoint> = chain.forces.iter().map(|force| place(pole + *force, false)).collect();
    let units = canvas.scene().units;
    let ink = theme.motion;
    for (k, (vertex, ray)) in vertices.iter().zip(&chain.forces).enumerate() {
        let line = Path::stroked(Outline::line([place(pole, false), *vertex]), canvas.pen(ink, RAY));
        let title = format!("Ray {}: {}", k + 1, force(*ray, units));
        canvas.put(Mark::new(Layer::Force, "ray", vec![line]).titled(title).avoided(0.05));
    }
    let label = |words: String, ink: Colour, at: PagePoint, away: (f64, f64), rank: u8| {
        let label = Label::new(words, ink, vec![at], rank);
        Label { away: Some(away), ..label }
    };
    canvas.label(label("O".into(), theme.ink, place(pole, false), (-1.0, 0.0), 6));
    // If all loads are vertical, the thrust H is the distance of the pole from the load line, at the scale of the polygon.
    let thrust = format!("H = {}", canvas.newtons(chain.crown_thrust));
    canvas.label(label(thrust, theme.ink, place(pole, false), (0.0, 1.0), 5));
    // Numbers that would lie on each other are left out; those of the joints on the structure remain.
    let apart = 1.1 * canvas.label_size();
    let mut kept: Vec<usize> = Vec::new();
    let last = vertices.len() - 1;
    for (k, vertex) in vertices.iter().enumerate() {
        let is_free = kept.last().is_none_or(|other| vertex.distance(vertices[*other]) >= apart);
        if k == last || is_free && vertex.distance(vertices[last]) >= apart {
            kept.push(k);
        }
    }
    for k in kept {
        canvas.label(label((k + 1).to_string(), ink, vertices[k], (1.0, 0.0), 30));
    }
    let points = chain.joints.iter().map(|joint| own.contacts[*joint].resultant.at);
    let Some(bounds) = Bounds::from_points(points) else { return };
    let middle = 0.5 * (bounds.min.x + bounds.max.x);
    for (k, joint) in chain.joints.iter().enumerate() {
        let ends = own.contacts[*joint].interface.ends;
        let outward = |p: &Point| p.y + 0.5 * (p.x - middle).abs();
        let [inner, outer] = if outward(&ends[0]) < outward(&ends[1]) { ends } else { [ends[1], ends[0]] };
        let along = outer - inner;
        let away = (along.x / along.norm().max(f64::MIN_POSITIVE), -along.y / along.norm().max(f64::MIN_POSITIVE));
        canvas.label(label((k + 1).to_string(), ink, canvas.place(outer), away, 29));
    }
    canvas.note(79, "ray from O: force in the joint of this number");
}

/// True if sides of reactions would cover sides of the load line, because they lie on the same line. `acting` are the
/// corners of the load line, `answering` the others. `size` is the size of the polygon, in the unit of these corners.
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
