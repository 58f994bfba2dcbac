//! Draws the forces of a structure with one mark at each joint: an arrow with two heads in the true place and direction
//! of the resultant. Its length is the force, in one scale for the whole figure. Small forces are ticks, and none is left
//! out. Missing forces are red, and the hinges and slips are those of the collapse that the line of the verdict names.

use std::rc::Rc;
use std::sync::Arc;

use super::arrow::round_above;
use super::canvas::Canvas;
use super::description::{described, word};
use super::design::{ArrowSize, Key, Layer, Look, Mark, along, direction};
use super::gives::{self, How, Place};
use super::moving::Moving;
use super::option::{Fill, ForceStyle, Normalisation, Options};
use super::panel::{About, Figure, View};
use super::placing::Label;
use super::{load, stage};
use crate::geometry::quarter_turn;
use crate::mechanics::analysis::{ActingForce, Contact, Failure, FrameAnalysis, MarginKind};
use crate::mechanics::scene::{BodyId, Scene};
use crate::pictures::drawing::difference::lightness;
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path, Theme};
use crate::products::wording::failure::pair;
use crate::products::wording::margin::governing;
use crate::products::wording::number::{digits, force, quantity, round_below_in, three_down, three_up};
use crate::products::wording::question::factored_friction;

/// A force below this share of the largest is numerical noise and has no mark.
const NOISE: f64 = 1e-6;
/// Forces that differ by less than this share of the largest have no order.
const ORDER_STEP: f64 = 1e-3;
/// Half the length of a tick, mm: the least half length of a mark.
const TICK: f64 = 0.45;
/// If all missing forces are smaller than this share of the largest force, they are drawn larger.
const ENLARGED: f64 = 0.05;
/// The legend explains ticks if there are at least this many.
const EXPLAINED_TICKS: usize = 3;
/// If a collapse has more hinges and slips than this, the fastest are drawn; the figure of the mechanism shows all.
const MAX_COLLAPSE_MARKS: usize = 6;
/// If more blocks than this are in a frame, only the largest force has an amount, even on request.
const MAX_AMOUNT_BLOCKS: usize = 60;
/// At most this many missing forces have amounts.
const MAX_MISSING_AMOUNTS: usize = 16;

/// The figure of forces with one mark at each joint.
pub(crate) struct JointForces;

impl Figure for JointForces {
    fn scale(&self, view: &View<'_>, look: Look) -> f64 {
        scale(view, look)
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        canvas.shares_scale = true;
        stage::ground(canvas);
        stage::blocks(canvas);
        stage::listed_contacts(canvas);
        if !canvas.look.is_strip {
            collapse(canvas);
        }
        joints(canvas);
        if !(canvas.look.large && weights(canvas)) {
            canvas.note(70, "weights not drawn");
        }
        stage::robots(canvas);
        load::loads(canvas);
        missing(canvas);
        stage::names(canvas);
    }

    fn about(&self) -> About {
        about()
    }
}

/// Returns the name, the description and the requirements of the figure of forces, in both looks.
pub(crate) fn about() -> About {
    About {
        states_margin: true,
        ..About::new(
            "forces",
            "Every force at a joint as a mark in its place, and every missing force",
            "Forces in a dry-laid structure",
        )
    }
}

/// Returns the same for the steps of a construction. Their forces have one scale, so that steps can be compared.
pub(crate) fn about_build() -> About {
    About {
        name: "build",
        help: "The steps of a construction, with one scale of arrows for all steps; --animate shows the steps one after the other",
        shares_arrow_scale: true,
        ..about()
    }
}

/// Returns the largest contact force of some frames, N.
fn largest(frames: &[Arc<FrameAnalysis>]) -> f64 {
    frames.iter().map(|frame| frame.largest_at_contacts()).fold(0.0, f64::max)
}

/// Returns the scale of the forces, pixels of half a mark per newton. With it, the marks of large forces in a block do
/// not meet in most blocks.
fn scale(view: &View<'_>, look: Look) -> f64 {
    let analysis = view.analysis;
    let scene = analysis.given();
    let mut largest = largest(&analysis.frames);
    if largest <= 0.0 {
        // Without contact forces, weights and robots set the scale.
        largest = scene.blocks.iter().map(|block| block.weight).fold(0.0, f64::max);
    }
    if largest <= 0.0 {
        return 0.0;
    }
    let mut candidates = Vec::new();
    for contact in analysis.frames.iter().flat_map(|frame| &frame.contacts) {
        let (at, norm) = (contact.resultant.at, contact.amount());
        if norm < 0.4 * largest {
            continue;
        }
        for acting in contact.acting() {
            let polygon = &scene.blocks[acting.on.0].body.polygon;
            let reach = polygon.bounds().diagonal();
            let way = acting.force * (1.0 / norm);
            let chord = view.zoom * load::inside_length(polygon.rings(), at + way * (1e-6 * reach), way * reach);
            if chord > look.mm(0.5) {
                candidates.push(0.45 * chord / norm);
            }
        }
    }
    candidates.sort_by(f64::total_cmp);
    let place = match (look.large, look.names) {
        (true, _) => candidates.len() / 2,
        (false, true) => candidates.len() / 12,
        (false, false) => candidates.len() / 4,
    };
    let (least, most) = if look.large { (4.0, 9.0) } else { (2.2, 6.5) };
    let longest = candidates.get(place).map_or(look.mm(least), |scale| scale * largest);
    longest.clamp(look.mm(least), look.mm(most)) / largest
}

/// Returns the colour of a force: from the colour of the theme that is nearest to the page to the farthest, by the
/// square root of its share of the largest force.
fn tint(theme: &Theme, share: f64) -> Colour {
    let mut stops = theme.arrows.clone();
    let page = lightness(theme.page);
    stops.sort_by(|a, b| (lightness(*a) - page).abs().total_cmp(&(lightness(*b) - page).abs()));
    let last = stops.len().saturating_sub(1);
    let place = libm::sqrt(share.clamp(0.0, 1.0)) * last as f64;
    let number = (place as usize).min(last.saturating_sub(1));
    match (stops.get(number), stops.get(number + 1)) {
        (Some(low), Some(high)) => low.mixed(*high, (place - number as f64).clamp(0.0, 1.0)),
        (Some(only), None) => *only,
        _ => theme.ink,
    }
}

/// Returns the outline of the mark of a force at `p` along the unit vector `u`. `half` is its half length, pixels.
pub(crate) fn mark(look: Look, p: PagePoint, u: (f64, f64), half: f64, both: bool) -> Outline {
    let half = half.max(look.mm(TICK));
    let (shaft, wide, long) = if look.large { (0.95, 2.2, 2.1) } else { (0.7, 1.6, 1.6) };
    let head = look.mm(long).min(0.62 * half);
    let share = (head / look.mm(long)).max(0.28);
    let size = ArrowSize {
        length: half,
        shaft: look.mm(shaft) * share.max(0.5),
        head: (look.mm(wide) * share.max(0.42), head),
    };
    if both { size.two_headed(p, u) } else { size.outline(p, u) }
}

/// A contact force that is drawn.
struct Drawn<'a> {
    contact: &'a Contact,
    /// Its amount, N.
    newtons: f64,
    at: PagePoint,
    /// Its direction on the page, into the first block.
    u: (f64, f64),
    /// Whether both bodies are blocks.
    both: bool,
}

fn drawn<'a>(canvas: &Canvas<'a>) -> Vec<Drawn<'a>> {
    let noise = NOISE * largest(&canvas.analysis.frames);
    let contacts = canvas.found().contacts.iter();
    let one = |contact: &'a Contact| {
        let force = contact.resultant.force;
        let newtons = force.norm();
        if newtons <= noise {
            return None;
        }
        let u = (force.x / newtons, -force.y / newtons);
        let both = matches!(contact.interface.bodies[1], BodyId::Block(_));
        Some(Drawn { contact, newtons, at: canvas.place(contact.resultant.at), u, both })
    };
    let mut all: Vec<Drawn<'a>> = contacts.filter_map(one).collect();
    // The largest first, so that small marks lie on top.
    // Forces that differ only by rounding errors keep the order of their joints.
    let step = (ORDER_STEP * largest(&canvas.analysis.frames)).max(f64::MIN_POSITIVE);
    all.sort_by_key(|one| core::cmp::Reverse((one.newtons / step).round() as u64));
    all
}

/// Draws the marks of all joints, and asks for the label of the largest.
fn joints(canvas: &mut Canvas<'_>) {
    let (theme, look, scene) = (canvas.theme(), canvas.look, canvas.scene());
    let most = largest(&canvas.analysis.frames);
    let mut all = drawn(canvas);
    let newtons_of_tick = look.mm(TICK) / canvas.scale;
    let every = canvas.analysis.frames.iter().flat_map(|frame| &frame.contacts);
    let ticks = every.map(Contact::amount).filter(|n| *n > NOISE * most && *n < 0.999 * newtons_of_tick).count();
    let (force_key, tick_key) = (force_key(canvas, most), tick_key(canvas, most, newtons_of_tick));
    let casing = look.mm(0.14);
    for one in &all {
        let half = canvas.scale * one.newtons;
        let outline = mark(look, one.at, one.u, half, one.both);
        let path = Path::filled(outline, tint(theme, one.newtons / most)).cased(theme.page, casing);
        let amount = force(one.contact.resultant.force, scene.units);
        let title = format!("Force between {}: {amount}", pair(scene, one.contact.interface.bodies));
        let is_tick = ticks >= EXPLAINED_TICKS && half < 0.999 * look.mm(TICK);
        let mut drawn = Mark::new(Layer::Force, "force", vec![path]).titled(title);
        drawn = drawn.keyed(if is_tick { &tick_key } else { &force_key });
        canvas.put(if half > look.mm(0.8) { drawn.avoided(0.15) } else { drawn });
    }
    let few = canvas.frame().placed.len() <= MAX_AMOUNT_BLOCKS;
    let labelled = if canvas.options.amounts && few { all.len() } else { 1 };
    let own_most = all.iter().map(|one| one.newtons).fold(0.0, f64::max);
    if let Some(place) = all.iter().position(|one| one.newtons >= (1.0 - NOISE) * own_most) {
        all[..=place].rotate_right(1);
    }
    for (number, one) in all.iter().take(labelled).enumerate() {
        label(canvas, one, if number == 0 { 3 } else { 4 }, most);
    }
}

/// Asks for the amount of a force: below the hatching if it acts on the ground, otherwise beside its mark.
fn label(canvas: &mut Canvas<'_>, one: &Drawn<'_>, rank: u8, most: f64) {
    if !canvas.states_amounts() {
        return;
    }
    let half = (canvas.scale * one.newtons).max(canvas.mm(0.4));
    let words = canvas.newtons(one.newtons);
    let size = canvas.label_size();
    let below = one.at.moved(0.0, canvas.mm(1.3 + 0.35 + 0.15) + 0.39 * size);
    let under = !one.both && one.u.1 < -0.5 && canvas.scene().lattice.is_none();
    let ink = tint(canvas.theme(), if rank == 3 { 1.0 } else { one.newtons / most });
    let anchors = [0.5, 0.1, 0.9].map(|share| along(one.at, one.u, share * half, 0.0)).to_vec();
    canvas.label(Label { bold: true, fixed: under.then_some(below), ..Label::new(words, ink, anchors, rank) });
}

fn key_mark(canvas: &Canvas<'_>, newtons: f64, share: f64, both: bool) -> (Vec<Path>, f64) {
    let (look, theme) = (canvas.look, canvas.theme());
    let half = (canvas.scale * newtons).max(look.mm(TICK));
    let before = if both { half } else { 0.0 };
    let outline = mark(look, PagePoint::new(before, 0.0), (1.0, 0.0), half, both);
    (vec![Path::filled(outline, tint(theme, share)).cased(theme.page, look.mm(0.1))], before + half)
}

/// Returns the entry with the scale: a mark of a round amount. A joint with the ground only has the half in the block.
fn force_key(canvas: &Canvas<'_>, most: f64) -> Rc<Key> {
    let bodies = || canvas.analysis.frames.iter().flat_map(|frame| &frame.contacts).map(|c| c.interface.bodies);
    let on_ground = |bodies: [BodyId; 2]| matches!(bodies[1], BodyId::Ground(_));
    let (ground, blocks) = (bodies().any(on_ground), bodies().any(|bodies| !on_ground(bodies)));
    let units = canvas.scene().units.force();
    let share = if canvas.scale * most < canvas.mm(6.0) { 1.0 } else { 0.75 };
    let round = round_below_in(share * most, units);
    let (symbol, width) = key_mark(canvas, round, round / most.max(f64::MIN_POSITIVE), blocks || !ground);
    let what = match (ground, blocks) {
        (true, false) => "from the ground",
        (true, true) => "at a joint; one head at ground",
        (false, _) => "at a joint",
    };
    Key::new(20, format!("{} {what}", quantity(round, units)), symbol, width)
}

/// Returns the entry for ticks: the largest force that is drawn as a tick, rounded up to one digit.
fn tick_key(canvas: &Canvas<'_>, most: f64, newtons: f64) -> Rc<Key> {
    let (symbol, width) = key_mark(canvas, 0.0, 0.5 * newtons / most.max(f64::MIN_POSITIVE), true);
    let units = canvas.scene().units.force();
    let words = format!("up to {}", quantity(units.size * round_above(units.value_from_si(newtons)), units));
    Key::new(10, words, symbol, width)
}

/// Draws the weights of the blocks of a large picture as thin arrows from their centroids. Returns false if they would be
/// too short.
fn weights(canvas: &mut Canvas<'_>) -> bool {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let placed = canvas.frame().placed.iter().map(|id| &scene.blocks[id.0]);
    let heaviest = scene.blocks.iter().map(|block| block.weight).fold(0.0, f64::max);
    let pull = scene.gravity;
    if canvas.scale * heaviest < canvas.mm(1.6) || pull.norm() <= 0.0 {
        return false;
    }
    let down = direction(pull);
    let arrow = |canvas: &Canvas<'_>, at: PagePoint, u: (f64, f64), length: f64| {
        let shaft = canvas.arrow(length, [0.32, 1.15, 1.5], 0.6).outline(at, u);
        let ring = canvas.pen(theme.ink, 0.28);
        vec![
            Path::filled(shaft, theme.ink).cased(theme.page, canvas.mm(0.15)),
            canvas.disc(at, 0.55, theme.page).with_stroke(ring),
        ]
    };
    let symbol = arrow(canvas, PagePoint::new(canvas.mm(0.7), 0.0), (1.0, 0.0), canvas.mm(4.0));
    let key = Key::new(30, "weight", symbol, canvas.mm(4.7));
    for block in placed.filter(|block| block.weight > 0.0) {
        let length = (canvas.scale * block.weight).max(canvas.mm(1.3));
        let shapes = arrow(canvas, canvas.place(block.centroid), down, length);
        let amount = force(pull * (block.weight / pull.norm()), scene.units);
        let title = format!("Weight of block {}: {amount}", block.id);
        canvas.put(Mark::new(Layer::Symbol, "weight", shapes).titled(title).keyed(&key).avoided(0.3));
    }
    true
}

/// Draws the missing forces in red, with their amounts. The arrows of a missing pull meet at its point; those of a
/// missing friction lie on the two sides of the joint. In printed figures, they are drawn with the other arrows.
pub(crate) fn missing(canvas: &mut Canvas<'_>) {
    let (scene, found, look) = (canvas.scene(), canvas.found(), canvas.look);
    let ink = canvas.options.failure();
    let large = look.large;
    let sizes = if large { (1.15, 2.6, 2.1) } else { (0.95, 2.1, 1.7) };
    let arrow = |length: f64| {
        let share = (length / look.mm(4.0)).clamp(0.5, 1.0);
        let head = (share * look.mm(sizes.1), look.mm(sizes.2).min(0.62 * length));
        ArrowSize { length, shaft: share * look.mm(sizes.0), head }
    };
    // One scale for all panels: that of the other forces. If even the largest missing force would be too short, all are
    // hollow, and drawn larger by a factor that stands at them.
    let all = canvas.analysis.frames.iter().flat_map(|frame| &frame.failures);
    let largest = all.map(|failure| failure.force().norm()).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let own_scale = load::joint_scale(canvas);
    let common = own_scale.unwrap_or(if canvas.has_one_scale() { canvas.scale } else { 0.0 });
    let visible = look.mm(if large { 6.0 } else { 5.0 }) / largest;
    let is_tiny = largest < ENLARGED * self::largest(&canvas.analysis.frames);
    let enlarged = own_scale.filter(|own| is_tiny && own * largest < look.mm(load::STUB));
    let enlarged = enlarged.map(|own| two_digits(visible / own));
    let factor = enlarged.map(digits);
    let scale = match (own_scale, enlarged) {
        (Some(own), factor) => own * factor.unwrap_or(1.0),
        (None, _) => common.max(visible),
    };
    let stated = round_below_in(largest.min(look.mm(10.0) / scale), scene.units.force());
    let states_scale = largest > f64::MIN_POSITIVE && !canvas.options.printed();
    let width = if states_scale { (scale * stated).max(look.mm(2.0)) } else { look.mm(4.4) };
    let is_stub = |norm: f64| own_scale.is_some_and(|own| own * norm < look.mm(load::STUB));
    let mut amounts = canvas.analysis.frames.iter().flat_map(|frame| &frame.failures).map(|f| f.force().norm());
    let has_stub = amounts.any(|norm| norm > 0.0 && is_stub(norm));
    let words = match &factor {
        Some(factor) => format!("{} missing, drawn × {factor}", canvas.newtons(stated)),
        None if has_stub => {
            let units = scene.units.force();
            let least = units.size * round_above(units.value_from_si(look.mm(load::STUB) / canvas.scale));
            let stated = if is_stub(largest) { String::new() } else { canvas.newtons(stated) + " " };
            format!("{stated}missing; stub: under {}", quantity(least, units))
        }
        None if states_scale => format!("{} missing", canvas.newtons(stated)),
        None => "missing".into(),
    };
    // A force that would be too short has a hollow arrow of the least length.
    let is_hollow = |norm: f64| enlarged.is_some() || is_stub(norm);
    let (theme, edge) = (canvas.theme(), canvas.dashes(ink, 0.24, [0.7, 0.35]));
    let painted = |outline: Outline, norm: f64| match is_hollow(norm) {
        true => Path::filled(outline, theme.page).with_stroke(edge.clone()),
        false => Path::filled(outline, ink).cased(theme.page, look.mm(0.15)),
    };
    let symbol = painted(arrow(width).outline(PagePoint::new(0.0, 0.0), (1.0, 0.0)), stated);
    let key = Key::new(50, words, vec![symbol], width);
    let mut order: Vec<&Failure> = found.failures.iter().collect();
    order.sort_by(|a, b| b.amount().total_cmp(&a.amount()));
    for (number, failure) in order.into_iter().enumerate() {
        let (at, missing) = (canvas.place(failure.at()), failure.force());
        let norm = missing.norm();
        let cased = |outline: Outline| painted(outline, norm);
        let (what, shapes, anchors, amount) = if let Failure::RobotTorque { torque, .. } = *failure {
            let amount = quantity(torque.abs(), scene.units.torque());
            let shapes = stage::torque(canvas, at, torque, (3.1, 0.6), ink);
            let anchors = [(0.0, -3.0), (3.0, 0.0), (-3.0, 0.0)].map(|(x, y)| at.moved(look.mm(x), look.mm(y)));
            (stage::turning(torque, amount.clone()), shapes, anchors.to_vec(), amount)
        } else if norm > 0.0 {
            let u = direction(missing);
            let most = if own_scale.is_some() { f64::INFINITY } else { look.mm(10.0) };
            let length = (scale * norm).min(most).max(look.mm(if own_scale.is_some() { load::STUB } else { 2.0 }));
            let size = arrow(length);
            let shapes = match failure {
                _ if canvas.options.printed() => Vec::new(),
                Failure::Friction { bodies, .. } => {
                    let normal = found.contacts.iter().find(|c| c.interface.bodies == *bodies);
                    let normal = normal.map_or(quarter_turn(missing), |contact| contact.interface.normal);
                    half_arrows(at, u, (normal.x, -normal.y), size, look.mm(0.25)).map(cased).to_vec()
                }
                Failure::RobotForce { .. } => vec![cased(size.outline(along(at, u, -length, 0.0), u))],
                _ => [u, (-u.0, -u.1)]
                    .map(|u| cased(size.outline(along(at, u, -length - look.mm(0.1), 0.0), u)))
                    .to_vec(),
            };
            let anchors = [-3.0, 3.0, -1.5, 1.5].map(|d| along(at, u, look.mm(d), 0.0));
            let anchors = std::iter::once(at).chain(anchors).collect();
            let words = match &factor {
                Some(factor) if number == 0 => format!("{}, drawn × {factor}", canvas.newtons(norm)),
                _ => canvas.newtons(norm),
            };
            (force(missing, scene.units), shapes, anchors, words)
        } else {
            continue;
        };
        let title = format!("{}: {what}", named(scene, failure));
        canvas.put(Mark::new(Layer::Missing, "missing", shapes).titled(title).keyed(&key).avoided(0.2));
        if number < MAX_MISSING_AMOUNTS {
            stage::amount(canvas, amount, ink, (anchors, 1), None);
        }
    }
}

/// Rounds a positive number to two significant digits.
fn two_digits(number: f64) -> f64 {
    let tens = libm::pow(10.0, libm::floor(libm::log10(number)) - 1.0);
    (number / tens).round() * tens
}

/// Returns the two half arrows of a friction along a joint: the first on the side to which `normal` points, along `u`.
fn half_arrows(at: PagePoint, u: (f64, f64), normal: (f64, f64), size: ArrowSize, gap: f64) -> [Outline; 2] {
    [1.0, -1.0].map(|side| {
        let (u, n) = ((side * u.0, side * u.1), (side * normal.0, side * normal.1));
        let (half, neck) = (size.length / 2.0, size.length / 2.0 - size.head.1);
        let corner = |forward: f64, aside: f64| {
            let at = at.moved(u.0 * forward, u.1 * forward);
            at.moved(n.0 * (gap + aside), n.1 * (gap + aside))
        };
        let (barb, shaft) = (0.6 * size.head.0, 0.6 * size.shaft);
        let corners = [(-half, 0.0), (half, 0.0), (neck, barb), (neck, shaft), (-half, shaft)];
        Outline::ring(corners.map(|(forward, aside)| corner(forward, aside)))
    })
}

/// Names a missing force and the bodies between which it would act.
fn named(scene: &Scene, failure: &Failure) -> String {
    let name = |acting: &ActingForce| match acting.kind.partner() {
        Some(from) => format!("{} between {}", word(acting.kind), pair(scene, [BodyId::Block(acting.on), from])),
        None => described(scene, acting.kind, BodyId::Block(acting.on)),
    };
    failure.acting().first().map_or(String::new(), name)
}

/// Draws the hinges and slips of the collapse that the line of the verdict names, below the forces and beside them.
pub(crate) fn collapse(canvas: &mut Canvas<'_>) {
    let (analysis, number, found) = (canvas.analysis, canvas.number, canvas.found());
    let governing = governing(canvas.solved());
    let moving = canvas.own().moving.get_or_init(|| Moving::governing(analysis, number, &governing));
    let mut joints = gives::of_fall(&moving.fall(analysis, number));
    // A missing friction is drawn at the same place, and shows the slip too.
    let lacks_friction = |pair: [BodyId; 2]| {
        let mut failures = found.failures.iter();
        failures.any(|failure| matches!(failure, Failure::Friction { bodies, .. } if *bodies == pair))
    };
    joints.retain(|joint| matches!(joint.how, How::Hinge(_)) || !lacks_friction(joint.contact.interface.bodies));
    let more = joints.len().saturating_sub(MAX_COLLAPSE_MARKS);
    joints.truncate(MAX_COLLAPSE_MARKS);
    // The marks of a frame that stands belong to the margin that the line names first.
    let factor = found.vehicle.as_ref().and_then(|own| own.positions[own.governing?].factor);
    let at = match (governing.kind, moving.edge) {
        (Some(MarginKind::LoadFactor), Some(factor)) => format!(" at {} × the loads", three_down(factor)),
        (Some(MarginKind::LoadFactor), None) if factor.is_some() => {
            format!(" at {} × the vehicle", factor.map_or(String::new(), three_down))
        }
        (Some(MarginKind::Tilt), Some(angle)) => format!(" at {}° of tilt", three_down(angle.abs())),
        (Some(MarginKind::HorizontalLoad), Some(share)) => format!(" at {} × its weight", three_down(share.abs())),
        (Some(MarginKind::Friction), Some(friction)) => format!(" at friction {}", three_up(friction)),
        (Some(MarginKind::FrictionFactor), Some(factor)) => {
            format!(" at {} × {}", three_up(factor), factored_friction(canvas.scene()))
        }
        _ if governing.at.is_empty() => String::new(),
        _ => format!(" at {}", governing.at),
    };
    gives::draw(canvas, &joints, [format!("hinge{at}"), format!("slides{at}")], Place::Beside);
    if more > 0 {
        canvas.note(63, &format!("and {more} more: --kind mechanism"));
    }
}

/// True if the options ask for what only the figures in the look of the thesis have.
pub(crate) fn asks_for_source_look(options: &Options) -> bool {
    options.style == ForceStyle::Components
        || options.normalisation == Normalisation::Source
        || options.fill == Fill::Source
}
