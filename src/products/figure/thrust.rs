//! Draws the line of thrust: the path of the compressive forces through the blocks, from interface to interface.
//!
//! [`segments`] computes the line in each block, along true lines of action. If there is no single line of action in a
//! block, a lighter line connects the joints; the legend calls it schematic. The line therefore runs from support to
//! support without gaps. Of a frame that falls, the line is that of the forces with the missing forces; where a joint
//! would have to pull, it leaves the stone. Of a frame that stands on two supports, thin lines show the least and the
//! greatest thrust. H is the horizontal thrust at the crown.

mod chain;
mod leaving;
mod polygon;

use std::borrow::Cow;
use std::rc::Rc;

use chain::chains;
use leaving::{left_at, slips, with_missing_forces};

use super::bearing::pressed;
use super::canvas::Canvas;
use super::description::exerted_by;
use super::design::{Key, Layer, Mark};
use super::funicular::{ThrustSegment, segments};
use super::option::Options;
use super::panel::{About, Figure, Subject};
use super::{load, stage};
use crate::mechanics::analysis::{
    Analysis, Contact, ForceKind, FrameAnalysis, MarginKind, ThrustState, ThrustStates, Verdict,
};
use crate::mechanics::statics::interface::ContactKind;
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path, Stroke, Theme};
use crate::products::wording::failure::pair;
use crate::products::wording::number::{counted, force, listed};
use crate::products::wording::verdict;

/// The width of the line of thrust for the largest force in unit lengths, with its least and largest value in mm.
const WIDEST: (f64, f64, f64) = (0.13, 0.34, 1.2);
/// Width of the line for a force of zero, as a fraction of the width for the largest force.
const MIN_WIDTH_SHARE: f64 = 0.22;
/// The number of different widths in frames with very many blocks, in which all lines of one width are one path.
const WIDTH_STEPS: f64 = 8.0;
/// Width of the lines of least and of greatest thrust, mm, and their dashes.
const LIMIT_WIDTH: f64 = 0.24;
const LIMIT_DASHES: [[f64; 2]; 2] = [[1.3, 0.55], [0.37, 0.45]];
/// Length of a line in the legend, mm.
const KEY_LENGTH: f64 = 4.8;

/// The figure of the line of thrust.
pub(crate) struct ThrustLine;

impl Figure for ThrustLine {
    fn about(&self) -> About {
        About::new("thrust", "The line of thrust through the blocks", "The line of thrust in a dry-laid structure")
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        let mut frames = 0..analysis.frames.len();
        if frames.any(|frame| analysis.thrust_states(frame).least.is_some()) { &[MarginKind::Kernel] } else { &[] }
    }

    fn subject(&self, analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        let mut subject = Subject::structure(analysis, options, frames);
        if options.with_polygon && !subject.is_cut {
            polygon::widened(&mut subject);
        }
        subject
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        let states = states(canvas, canvas.number);
        let found = shown(states, canvas.found());
        let segments = segments(canvas.solved().with_results(&found));
        // The ground ends beside the structure, not below the force polygon.
        let all = canvas.structure;
        if canvas.window.is_none() {
            let options = Options { with_polygon: false, ..canvas.options.clone() };
            canvas.structure = canvas.camera.rect(Subject::structure(canvas.analysis, &options, None).bounds);
        }
        stage::ground(canvas);
        canvas.structure = all;
        stage::blocks(canvas);
        limits(canvas, states);
        let keys = Keys::new(canvas);
        if !segments.is_empty() {
            canvas.explain(Rc::clone(&keys.scale));
        }
        lines(canvas, &found, &segments, &keys);
        dots(canvas, &found, &keys);
        stage::held(canvas);
        load::loads(canvas);
        let polygon =
            if canvas.options.with_polygon && canvas.window.is_none() { polygon::draw(canvas) } else { Vec::new() };
        stage::names(canvas);
        if states.central.is_some() {
            canvas.note(80, "other figures: forces of least sum");
        }
        let mut words = words(canvas, &found);
        words.extend(polygon);
        canvas.words = Some(words);
    }
}

/// Returns the extreme thrust states of a frame.
fn states<'a>(canvas: &Canvas<'a>, frame: usize) -> &'a ThrustStates {
    let analysis = canvas.analysis;
    canvas.shared[frame].thrust.get_or_init(|| analysis.thrust_states(frame))
}

/// Returns the forces whose line of thrust the figure shows: the most central forces, those farthest from the ends of
/// the joints, if they are known. Otherwise returns the forces that the analysis found, for a frame that falls with its
/// missing forces.
fn shown<'a>(states: &'a ThrustStates, found: &'a FrameAnalysis) -> Cow<'a, FrameAnalysis> {
    match &states.central {
        _ if found.verdict == Verdict::Unstable => Cow::Owned(with_missing_forces(found)),
        Some(state) => Cow::Borrowed(&state.frame),
        None => Cow::Borrowed(found),
    }
}

/// Returns the words after the verdict.
fn words(canvas: &Canvas<'_>, shown: &FrameAnalysis) -> Vec<String> {
    let (found, states) = (canvas.found(), states(canvas, canvas.number));
    let why = verdict::reason(canvas.solved());
    let parts = |words: String| if words.is_empty() { Vec::new() } else { vec![words] };
    let state = match found.verdict {
        Verdict::Undecided => return vec![format!("no line of thrust is proved; {why}")],
        Verdict::Unstable => {
            let leaves = shown.contacts.iter().filter(|contact| left_at(contact).is_some()).count();
            let slides = shown.contacts.iter().filter(|contact| slips(contact, found)).count();
            let whats = [("leaves the stone", leaves), ("is too steep for friction", slides)];
            let whats = whats.into_iter().filter(|what| what.1 > 0);
            let whats: Vec<String> =
                whats.map(|(what, count)| format!("{what} at {}", counted(count, "joint"))).collect();
            // The panels of a strip only mark the joints.
            return match whats.is_empty() {
                _ if canvas.look.is_strip => Vec::new(),
                true => vec!["the line of thrust needs the missing forces".into()],
                false => vec![format!("the line of thrust {}", listed(&whats))],
            };
        }
        Verdict::Stable if states.central.is_some() => return [thrusts(canvas, states), parts(why)].concat(),
        Verdict::Stable if has_many_lines(canvas, canvas.number) && states.supports > 2 => {
            Some("more than two supports: no single horizontal thrust".into())
        }
        Verdict::Stable => None,
    };
    state.into_iter().chain(parts(why)).collect()
}

/// States the horizontal thrust H at the crown: that of the line shown, and the least and the greatest. If loads act
/// sideways between crown and supports, the thrust at the supports follows. Empty in a figure of several frames.
fn thrusts(canvas: &Canvas<'_>, states: &ThrustStates) -> Vec<String> {
    if canvas.analysis.frames.len() != 1 {
        return Vec::new();
    }
    let amount = |newtons: f64| canvas.newtons(newtons);
    let crown = |state: &ThrustState| Some(chains(canvas.solved().with_results(&state.frame)).first()?.crown_thrust);
    let stated = |of: &dyn Fn(&ThrustState) -> Option<f64>| {
        let shown = amount(of(states.central.as_ref()?)?);
        let range = [&states.least, &states.greatest].map(|state| state.as_ref().and_then(of).map(amount));
        let [Some(least), Some(greatest)] = range else { return Some(shown) };
        Some(format!("{shown} ({least} to {greatest})"))
    };
    let supports = stated(&|state| Some(state.thrust));
    match (stated(&crown), supports) {
        (Some(crown), Some(supports)) if crown != supports => {
            vec![format!("H = {crown} at the crown"), format!("{supports} at the supports")]
        }
        (Some(crown), _) => vec![format!("H = {crown}")],
        (None, Some(supports)) => vec![format!("thrust {supports} at the supports")],
        (None, None) => Vec::new(),
    }
}

/// True if the line of thrust of a frame that stands is one of many possible lines, because there are more unknown
/// forces than equations of equilibrium.
fn has_many_lines(canvas: &Canvas<'_>, frame: usize) -> bool {
    let found = &canvas.analysis.frames[frame];
    let unknowns = |contact: &Contact| if contact.interface.kind == ContactKind::Corner { 2 } else { 3 };
    let contacts: usize = found.contacts.iter().map(unknowns).sum();
    let equations = 3 * canvas.scene().frames[frame].placed.len();
    found.verdict == Verdict::Stable && contacts + 3 * found.robots.len() > equations
}

fn schematic_colour(theme: &Theme) -> Colour {
    theme.page.mixed(theme.motion, 0.45)
}

/// Returns the colour of the line in a frame that does not stand: a grey that is visible in print.
fn carried_colour(theme: &Theme) -> Colour {
    theme.block.mixed(theme.faint, 0.7)
}

/// The widths of the line, and the entries of the legend.
struct Keys {
    /// The largest force of a joint or a robot in any panel, N, and the width of its line, pixels.
    largest: f64,
    widest: f64,
    scale: Rc<Key>,
    line: Rc<Key>,
    carried: Rc<Key>,
    schematic: Rc<Key>,
    dot: Rc<Key>,
    leaves: Rc<Key>,
    slips: Rc<Key>,
}

impl Keys {
    fn new(canvas: &Canvas<'_>) -> Keys {
        let (analysis, theme) = (canvas.analysis, canvas.theme());
        let mut largest: f64 = 0.0;
        let (mut many, mut central) = (false, false);
        for (number, found) in analysis.frames.iter().enumerate() {
            let shown = shown(states(canvas, number), found);
            largest = largest.max(shown.largest_force());
            let is_central = states(canvas, number).central.is_some();
            many |= has_many_lines(canvas, number) && !is_central;
            central |= is_central;
        }
        let widest = canvas.in_units(WIDEST);
        let shows = canvas.newtons(largest);
        let line = match (central, many) {
            (true, true) => "most central line, or of the forces of least sum",
            (true, false) => "most central line",
            (false, true) => "line of thrust of the forces of least sum",
            (false, false) => "line of thrust",
        };
        let start = PagePoint::new(0.0, 0.0);
        let stroked = |rank: u8, words: String, colour: Colour| {
            Key::line(rank, words, canvas.mm(KEY_LENGTH), Stroke::new(colour, widest))
        };
        let round =
            |rank: u8, words: &str, radius: f64, symbol: Path| Key::new(rank, words, vec![symbol], 2.0 * radius);
        let radius = canvas.mm(0.6);
        let dot = dot(canvas, start.moved(radius, 0.0));
        let (half, stroke) = (canvas.mm(2.0), canvas.pen(theme.failure, 0.35));
        let out = Path::stroked(Key::piece(2.0 * half), stroke);
        let leaves = vec![out, ring(canvas, start.moved(half, 0.0))];
        let words = "outside the stone";
        let leaves = Key::new(15, words, leaves, 2.0 * half);
        let steep = steep(canvas, start.moved(canvas.mm(0.7), 0.0));
        Keys {
            largest,
            widest,
            scale: stroked(9, format!("{shows} at this width"), theme.ink),
            line: stroked(10, line.to_owned(), theme.motion),
            carried: stroked(11, "line with the missing forces".to_owned(), carried_colour(theme)),
            schematic: stroked(16, "schematic: no line of action".to_owned(), schematic_colour(theme)),
            dot: round(14, "resultant", radius, dot),
            leaves,
            slips: round(17, "too steep for friction", canvas.mm(0.7), steep),
        }
    }

    /// Returns the width of the line of a force, pixels.
    fn width(&self, canvas: &Canvas<'_>, newtons: f64) -> f64 {
        let share = (newtons / self.largest.max(f64::MIN_POSITIVE)).min(1.0);
        let share = MIN_WIDTH_SHARE + (1.0 - MIN_WIDTH_SHARE) * share;
        let share = if canvas.many() { (share * WIDTH_STEPS).round() / WIDTH_STEPS } else { share };
        self.widest * share
    }
}

/// Draws the line of thrust: first its schematic parts, then the true lines of action on top of them. The line is red
/// where it runs outside its block, and grey elsewhere in a frame that does not stand.
fn lines(canvas: &mut Canvas<'_>, shown: &FrameAnalysis, segments: &[ThrustSegment], keys: &Keys) {
    let (scene, theme, stands) = (canvas.scene(), canvas.theme(), shown.verdict == Verdict::Stable);
    let mut order: Vec<&ThrustSegment> = segments.iter().collect();
    order.sort_by_key(|segment| (segment.through, segment.leaves));
    for segment in order {
        let (colour, key) = match () {
            () if !stands => (carried_colour(theme), &keys.carried),
            () if segment.through => (theme.motion, &keys.line),
            () => (schematic_colour(theme), &keys.schematic),
        };
        let (start, way) = (segment.from, segment.to - segment.from);
        let line = |canvas: &Canvas<'_>, [from, to]: [f64; 2], ink: Colour| {
            let outline = Outline::line([start + way * from, start + way * to].map(|p| canvas.place(p)));
            Path::stroked(outline, Stroke::new(ink, keys.width(canvas, segment.force.norm())))
        };
        let mut shapes = vec![line(canvas, [0.0, 1.0], colour)];
        let mut key = key;
        if segment.leaves {
            let rings = scene.blocks[segment.on.0].body.polygon.rings();
            let outside = load::parts(rings, start, way).into_iter().filter(|part| !part.1);
            shapes.extend(outside.map(|(ends, _)| line(canvas, ends, theme.failure)));
            key = &keys.leaves;
        }
        let class = if segment.through { "thrust" } else { "schematic" };
        let mark = Mark::new(Layer::Force, class, shapes).keyed(key);
        canvas.put(mark.titled(title(canvas, segment)).avoided(0.1));
    }
}

/// Describes a segment of the line of thrust: its block, what exerts the force along the segment, and the magnitude of
/// this force.
fn title(canvas: &Canvas<'_>, segment: &ThrustSegment) -> String {
    let scene = canvas.scene();
    let on = &scene.blocks[segment.on.0].id;
    let by = match segment.kind {
        ForceKind::Load => "a load".to_owned(),
        kind => exerted_by(scene, kind).unwrap_or("a joint, combined with loads".to_owned()),
    };
    let force = force(segment.force, scene.units);
    if segment.through {
        format!("Force on block {on} from {by}: {force}")
    } else {
        format!("Schematic path of the force from {by} through block {on}: {force}")
    }
}

/// Draws a dot at the point where the resultant of each interface acts, and a ring where it lies outside the stone.
fn dots(canvas: &mut Canvas<'_>, shown: &FrameAnalysis, keys: &Keys) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    for (contact, _) in pressed(canvas.solved().with_results(shown)) {
        let (at, pair) = (canvas.place(contact.resultant.at), pair(scene, contact.interface.bodies));
        let mark = if let Some(end) = left_at(contact) {
            let out = Outline::line([canvas.place(end), at]);
            let out = Path::stroked(out, canvas.pen(theme.failure, 0.35));
            let title = format!("The line of thrust leaves the joint between {pair}");
            Mark::new(Layer::Missing, "leaves", vec![out, ring(canvas, at)]).titled(title).keyed(&keys.leaves)
        } else if slips(contact, canvas.found()) {
            let title = format!("The line of thrust is too steep for the friction between {pair}");
            Mark::new(Layer::Missing, "slips", vec![steep(canvas, at)]).titled(title).keyed(&keys.slips)
        } else {
            let amount = canvas.newtons(contact.amount());
            let mark = Mark::new(Layer::Symbol, "resultant", vec![dot(canvas, at)]).keyed(&keys.dot);
            mark.titled(format!("Between {pair}: {amount}"))
        };
        canvas.put(mark.avoided(0.15));
    }
}

fn dot(canvas: &Canvas<'_>, at: PagePoint) -> Path {
    let radius = canvas.in_units((0.06, 0.2, 0.55));
    Path::filled(Outline::circle(at, radius), canvas.theme().ink).cased(canvas.theme().page, 0.3 * radius)
}

/// Draws the mark of a joint whose force needs more friction than there is: a red square.
fn steep(canvas: &Canvas<'_>, at: PagePoint) -> Path {
    let half = canvas.mm(0.6);
    let corners = [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| at.moved(x, y));
    Path::filled(Outline::ring(corners), canvas.theme().failure).cased(canvas.theme().page, canvas.mm(0.15))
}

fn ring(canvas: &Canvas<'_>, at: PagePoint) -> Path {
    let stroke = canvas.pen(canvas.theme().failure, 0.35);
    canvas.disc(at, 0.7, canvas.theme().page).with_stroke(stroke)
}

/// Draws the thin lines of least and of greatest thrust. A line whose state is not known is left out.
fn limits(canvas: &mut Canvas<'_>, states: &ThrustStates) {
    let theme = canvas.theme();
    let both = [
        (&states.least, "thrust-least", "Least thrust", 12),
        (&states.greatest, "thrust-greatest", "Greatest thrust", 13),
    ];
    for ((state, class, name, rank), dashes) in both.into_iter().zip(LIMIT_DASHES) {
        let Some(state) = state else { continue };
        let ink = theme.motion.mixed(theme.ink, 0.45);
        let stroke = canvas.dashes(ink, LIMIT_WIDTH, dashes);
        let pieces = segments(canvas.solved().with_results(&state.frame)).into_iter();
        let outline = Outline::lines(pieces.map(|piece| [piece.from, piece.to].map(|p| canvas.place(p))));
        let key = Key::line(rank, name.to_lowercase(), canvas.mm(KEY_LENGTH), stroke.clone());
        let thrust = canvas.newtons(state.thrust);
        let mark = Mark::new(Layer::Force, class, vec![Path::stroked(outline, stroke)]).keyed(&key);
        canvas.put(mark.titled(format!("{name}: {thrust} horizontally at the supports")).avoided(0.1));
    }
}
