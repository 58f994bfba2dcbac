//! Draws what every kind of figure shows: the ground, the blocks, the planned blocks and the robots.

use std::rc::Rc;

use super::bearing::robots_reached;
use super::canvas::Canvas;
use super::design::{Key, Layer, Mark, along, colour, direction, overlaps};
use super::placing::Label;
use crate::geometry::{Edge, Lattice};
use crate::mechanics::scene::{BlockId, Body, BodyId, Hold, Scene};
use crate::pictures::drawing::{Camera, Colour, Face, Outline, PagePoint, PageRect, Path, Stroke, arrow, text};
use crate::products::wording::number::{force, quantity, round_below_in};

/// The ranks of the entries of the legend that this module explains.
const PLAN_RANK: u8 = 45;
const LIMIT_RANK: u8 = 62;

/// The number of colours in a bar of the legend.
const COLOURS: u32 = 48;

/// The angle through which the arc of a torque turns: 225°.
const TORQUE_SWEEP: f64 = 1.25 * core::f64::consts::PI;
/// The angle at which the arc of an anticlockwise torque begins: −60°.
const TORQUE_START: f64 = -core::f64::consts::PI / 3.0;

/// Draws the ground as a hatched line along the edges that carry joints in any frame, and along the edges of other parts that
/// face the structure. On a lattice, the ground is drawn as a shape.
pub(crate) fn ground(canvas: &mut Canvas<'_>) {
    let scene = canvas.scene();
    let structure = scene.bounds(&shown_blocks(scene)).map_or(canvas.structure, |bounds| canvas.camera.rect(bounds));
    for (number, ground) in scene.ground.iter().enumerate() {
        let body = BodyId::Ground(number);
        let touches = |edge: &Edge| {
            let mut contacts = canvas.analysis.frames.iter().flat_map(|frame| &frame.contacts);
            contacts.any(|contact| {
                let ends = contact.interface.ends;
                contact.interface.bodies.contains(&body)
                    && ends.iter().all(|end| canvas.camera.length(edge.distance(*end)) < canvas.mm(0.2))
            })
        };
        let mut edges: Vec<Edge> = ground.body.polygon.edges().filter(touches).collect();
        if edges.is_empty() {
            edges = ground.body.polygon.edges().filter(|edge| faces(canvas, edge, structure)).collect();
        }
        if scene.lattice.is_some() {
            let bounds = canvas.camera.rect(ground.body.polygon.bounds());
            // Ground that carries nothing and lies far away does not make the picture larger.
            if overlaps(bounds, structure, canvas.mm(12.0)) {
                let outline = canvas.camera.polygon(&ground.body.polygon);
                let fill = ground.body.fill.map_or(canvas.theme().ground, colour);
                let mark = Mark::new(Layer::Ground, "earth", vec![Path::filled(outline, fill)]);
                canvas.put(mark.titled("Ground").avoided(0.0));
            }
            continue;
        }
        if edges.is_empty() {
            continue;
        }
        let shapes: Vec<Path> = edges.iter().flat_map(|edge| hatched(canvas, body, edge, structure)).collect();
        let mark = Mark::new(Layer::Ground, "earth", shapes);
        canvas.put(mark.titled("Ground").avoided(0.0));
    }
}

/// How far the line of the ground goes beyond the structure, mm.
const GROUND_BEYOND: f64 = 3.0;

/// True if an edge of the ground lies beside the structure, and the structure is in front of it.
fn faces(canvas: &Canvas<'_>, edge: &Edge, structure: PageRect) -> bool {
    let [from, to] = [edge.from, edge.to].map(|p| canvas.camera.place(p));
    let beyond = canvas.mm(GROUND_BEYOND);
    let window = PageRect {
        at: structure.at.moved(-beyond, -beyond),
        width: structure.width + 2.0 * beyond,
        height: structure.height + 2.0 * beyond,
    };
    let middle = structure.at.moved(structure.width / 2.0, structure.height / 2.0);
    let (outward, off) = (edge.outward(), (middle.x - (from.x + to.x) / 2.0, middle.y - (from.y + to.y) / 2.0));
    window.part_of([from, to]).is_some_and(|[from, to]| from.distance(to) > beyond)
        && outward.x * off.0 - outward.y * off.1 > 0.0
}

/// Draws one edge of the ground: a line, and short strokes inside the ground along it. The line ends 3 mm beyond the
/// `structure`.
fn hatched(canvas: &Canvas<'_>, body: BodyId, edge: &Edge, structure: PageRect) -> Vec<Path> {
    let theme = canvas.theme();
    let [mut from, mut to] = [edge.from, edge.to].map(|p| canvas.place_on(body, p));
    let beyond = canvas.mm(GROUND_BEYOND);
    let window = if (to.y - from.y).abs() < (to.x - from.x).abs() {
        PageRect {
            at: PagePoint::new(structure.at.x - beyond, from.y.min(to.y) - 1.0),
            width: structure.width + 2.0 * beyond,
            height: (to.y - from.y).abs() + 2.0,
        }
    } else {
        PageRect {
            at: PagePoint::new(from.x.min(to.x) - 1.0, structure.at.y - beyond),
            width: (to.x - from.x).abs() + 2.0,
            height: structure.height + 2.0 * beyond,
        }
    };
    if let Some(part) = window.part_of([from, to]) {
        [from, to] = part;
    }
    let length = to.distance(from);
    if length <= 0.0 {
        return Vec::new();
    }
    let u = ((to.x - from.x) / length, (to.y - from.y) / length);
    let outward = edge.outward();
    let inward = if u.1 * outward.x + u.0 * outward.y > 0.0 { 1.0 } else { -1.0 };
    let depth = canvas.mm(1.3);
    let first = canvas.mm(0.5);
    let starts = core::iter::successors(Some(first), |at| Some(at + canvas.mm(0.95))).take_while(|at| *at < length);
    let lines = Outline::lines(starts.map(|at| {
        let (reach, start) = (depth.min(at), along(from, u, at, 0.0));
        [start, along(start, u, -reach, inward * reach)]
    }));
    let faint = theme.ground.mixed(theme.page, 0.25);
    // The band below the line is pale. It makes the ground an area, which `import` finds again.
    let corner = |at: PagePoint| along(at, u, 0.0, inward * depth);
    let band = Outline::ring([from, to, corner(to), corner(from)]);
    vec![
        Path::filled(band, theme.ground.mixed(theme.page, 0.9)),
        Path::stroked(lines, canvas.pen(faint, 0.16).mitred()),
        Path::stroked(Outline::line([from, to]), canvas.pen(theme.ground, 0.38).mitred()),
    ]
}

/// Draws the placed blocks that are not displaced in pale colours, and the outlines of the planned ones.
pub(crate) fn blocks(canvas: &mut Canvas<'_>) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let width = canvas.mm(if canvas.look.large { 0.22 } else { 0.16 });
    for (place, id) in canvas.frame().placed.iter().enumerate() {
        if canvas.displacement(*id).is_some() {
            continue;
        }
        let (block, fill) = (&scene.blocks[id.0], canvas.fill(place, *id));
        let outline = canvas.camera.polygon(&block.body.polygon);
        let mut edge = Stroke::new(theme.outline, width);
        if block.body.is_schematic {
            edge = edge.dashed([canvas.mm(0.9), canvas.mm(0.7)]);
        }
        let mut shapes = vec![Path::filled(outline, fill).with_stroke(edge)];
        let inner = seams(&block.body, scene.lattice, &canvas.camera);
        if !inner.segments.is_empty() {
            shapes.push(Path::stroked(inner, Stroke::new(theme.seam_on(fill, 0.22), 0.6 * width)));
        }
        let mut mark = Mark::new(Layer::Stone, "block", shapes).titled(format!("Block {}", block.id));
        mark.description = format!("weight {}", canvas.newtons(block.weight));
        if let Some((_, words)) = canvas.fills.get(place).filter(|_| block.body.fill.is_none()) {
            mark.description = format!("{}, {words}", mark.description);
        }
        canvas.put(mark);
    }
    let symbol = Outline::ring(
        [(0.0, 0.0), (0.7, -1.2), (2.1, -1.2), (2.8, 0.0), (2.1, 1.2), (0.7, 1.2)]
            .map(|(x, y)| PagePoint::new(canvas.mm(x), canvas.mm(y))),
    );
    let symbol = vec![Path::stroked(symbol, canvas.pen(theme.faint, 0.35))];
    let key = Key::new(PLAN_RANK, "planned block", symbol, canvas.mm(2.8));
    for plan in &canvas.frame().plans {
        let (block, robot) = (&scene.blocks[plan.block.0], &scene.robots[plan.robot.0]);
        let ink = theme.robot(plan.robot.0);
        let inner = seams(&block.body, scene.lattice, &canvas.camera);
        let outline = canvas.camera.polygon(&block.body.polygon);
        let shapes = vec![Path::stroked(outline, canvas.pen(ink, 0.45)), Path::stroked(inner, canvas.pen(ink, 0.3))];
        let title = format!("Block {}, planned by robot {}", block.id, robot.id);
        canvas.put(Mark::new(Layer::Stone, "plan", shapes).titled(title).keyed(&key).avoided(0.1));
    }
}

/// Returns the lines between the lattice cells of a body on the page: one line for each edge that two cells share. The
/// result is empty for a body without cells.
pub(crate) fn seams(body: &Body, lattice: Option<Lattice>, camera: &Camera) -> Outline {
    let mut outline = Outline::default();
    let (Some(cells), Some(lattice)) = (&body.cells, lattice) else {
        return outline;
    };
    let mut steps = std::collections::BTreeSet::new();
    for cell in cells {
        let corners = cell.corners();
        for i in 0..corners.len() {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            if steps.contains(&(b, a)) {
                let place = |c: (i64, i64)| camera.place(lattice.point(c.0 as f64, c.1 as f64));
                outline.extend(Outline::line([place(a), place(b)]));
            }
            steps.insert((a, b));
        }
    }
    outline
}

/// Asks for the names of the blocks, inside them, and for the names of all blocks that the words below the picture
/// mention.
pub(crate) fn names(canvas: &mut Canvas<'_>) {
    if !canvas.options.labels || !canvas.options.names {
        return;
    }
    let (theme, placed) = (canvas.theme(), &canvas.frame().placed);
    let absent: Vec<BlockId> = canvas.mentioned.iter().copied().filter(|id| !placed.contains(id)).collect();
    for (place, id) in placed.iter().chain(&absent).enumerate() {
        let fill = if place < placed.len() { canvas.fill(place, *id) } else { theme.page };
        let block = &canvas.scene().blocks[id.0];
        let at = vec![canvas.place_on(BodyId::Block(*id), block.body.polygon.centroid())];
        let polygon = &block.body.polygon;
        let bounds = canvas.displacement(*id).map_or(polygon.bounds(), |moved| moved.polygon(polygon).bounds());
        let inside = Some(canvas.camera.rect(bounds));
        let is_mentioned = canvas.mentioned.contains(id);
        let rank = if is_mentioned { 4 } else { 90 };
        if canvas.look.names || is_mentioned {
            let label = Label::new(block.id.clone(), theme.letters_on(fill, None), at, rank);
            canvas.label(Label { inside, is_mentioned, ..label });
        }
    }
}

/// Asks for the label with the amount of a mark. `anchors` are the points beside which it may stand, and the rank.
pub(crate) fn amount(
    canvas: &mut Canvas<'_>,
    words: String,
    ink: Colour,
    (anchors, rank): (Vec<PagePoint>, u8),
    away: Option<(f64, f64)>,
) {
    if canvas.states_amounts() {
        canvas.label(Label { bold: rank > 0, away, ..Label::new(words, ink, anchors, rank) });
    }
}

/// Draws a torque around `at` as an arc with a head. `sizes` are its radius and width in mm.
pub(crate) fn torque(canvas: &Canvas<'_>, at: PagePoint, torque: f64, sizes: (f64, f64), ink: Colour) -> Vec<Path> {
    let (radius, width) = (canvas.mm(sizes.0), canvas.mm(sizes.1));
    let turned = |outline: Outline| {
        if torque < 0.0 { outline.mapped(|p| PagePoint::new(2.0 * at.x - p.x, p.y)) } else { outline }
    };
    let outline = arrow::turning(at, radius, TORQUE_START, TORQUE_SWEEP, width);
    vec![Path::filled(turned(outline), ink).cased(canvas.theme().page, canvas.mm(0.25))]
}

/// Writes the direction of a torque after its amount.
pub(crate) fn turning(torque: f64, amount: String) -> String {
    let direction = if torque > 0.0 { "anticlockwise" } else { "clockwise" };
    format!("{amount} {direction}")
}

/// Draws the disc of a robot on its grip point.
fn disc(canvas: &mut Canvas<'_>, hold: &Hold) {
    let (scene, edge) = (canvas.scene(), canvas.pen(canvas.theme().ink, 0.22));
    let block = canvas.camera.rect(scene.blocks[hold.block.0].body.polygon.bounds());
    // A large disc hides a small block.
    let radius = (0.45 * block.width.min(block.height)).clamp(canvas.mm(0.9), canvas.mm(1.35));
    let outline = Outline::circle(canvas.place_on(BodyId::Block(hold.block), hold.at), radius);
    let disc = Path::filled(outline, canvas.theme().robot(hold.robot.0)).with_stroke(edge);
    let title = format!("Robot {} holds block {}", scene.robots[hold.robot.0].id, scene.blocks[hold.block.0].id);
    canvas.put(Mark::new(Layer::Symbol, "robot", vec![disc]).titled(title).avoided(0.15));
}

/// Draws a diamond on the disc of each robot whose force or torque reaches one of its limits.
pub(crate) fn robot_limits(canvas: &mut Canvas<'_>) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let diamond = |canvas: &Canvas<'_>, at: PagePoint| {
        let corners = [(0.0, -0.8), (0.8, 0.0), (0.0, 0.8), (-0.8, 0.0)];
        let outline = Outline::ring(corners.map(|(x, y)| at.moved(canvas.mm(x), canvas.mm(y))));
        vec![Path::filled(outline, theme.ink).cased(theme.page, canvas.mm(0.2))]
    };
    let symbol = diamond(canvas, PagePoint::new(canvas.mm(0.8), 0.0));
    let words = "robot at its limit";
    let key = Key::new(LIMIT_RANK, words, symbol, canvas.mm(1.6));
    for robot in robots_reached(canvas.solved()) {
        let title = format!("Robot {} is at its limit", scene.robots[robot.robot.0].id);
        let mark = Mark::new(Layer::Symbol, "limit", diamond(canvas, canvas.place(robot.at)));
        canvas.put(mark.titled(title).keyed(&key).avoided(0.2));
    }
}

/// Draws the robots that hold a block, with their forces and torques: a disc on the grip point, an arrow from it, and
/// an arc. Their labels have their names and forces. In printed figures, the arrow of a robot is drawn with the others.
pub(crate) fn robots(canvas: &mut Canvas<'_>) {
    let (scene, theme, found) = (canvas.scene(), canvas.theme(), canvas.found());
    let edge = canvas.pen(theme.ink, 0.22);
    for hold in &canvas.frame().holds {
        let (name, at, fill) = (&scene.robots[hold.robot.0].id, canvas.place(hold.at), theme.robot(hold.robot.0));
        disc(canvas, hold);
        let Some(robot) = found.robots.iter().find(|robot| robot.robot == hold.robot && robot.block == hold.block)
        else {
            continue;
        };
        let (norm, mut anchors) = (robot.force.norm(), vec![at]);
        let on = scene.name(BodyId::Block(robot.block));
        if canvas.scale * norm > canvas.mm(1e-3) {
            let u = direction(robot.force);
            let length = (canvas.scale * norm).max(canvas.mm(3.4));
            let sizes = if canvas.look.large { [0.75, 1.9, 1.7] } else { [0.6, 1.6, 1.7] };
            let outline = canvas.arrow(length, sizes, 0.6).outline(at, u);
            let title = format!("Force on block {on} from robot {name}: {}", force(robot.force, scene.units));
            let shapes = vec![Path::filled(outline, fill).with_stroke(edge.clone())];
            let shapes = if canvas.options.printed() { Vec::new() } else { shapes };
            canvas.put(Mark::new(Layer::Symbol, "robot-force", shapes).titled(title).avoided(0.2));
            anchors.insert(0, along(at, u, length, 0.0));
        }
        let ink = theme.letters_on(theme.page, Some(fill));
        let mut words = format!("{name}: {}", canvas.newtons(norm));
        if robot.torque.abs() > 1e-9 * found.weight * found.length {
            let stated = quantity(robot.torque.abs(), scene.units.torque());
            let title = format!("Torque on block {on} from robot {name}: {}", turning(robot.torque, stated.clone()));
            let shapes = torque(canvas, at, robot.torque, (2.1, 0.4), ink);
            canvas.put(Mark::new(Layer::Symbol, "robot-torque", shapes).titled(title).avoided(0.2));
            words = format!("{words}, {stated}");
        }
        if canvas.states_amounts() {
            canvas.label(Label::new(words, ink, anchors, 2));
        }
    }
    robot_limits(canvas);
}

/// Draws the discs and the names of the robots that hold a block, without their forces.
pub(crate) fn held(canvas: &mut Canvas<'_>) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    for hold in &canvas.frame().holds {
        disc(canvas, hold);
        let ink = theme.letters_on(theme.page, Some(theme.robot(hold.robot.0)));
        if canvas.options.labels {
            let name = scene.robots[hold.robot.0].id.clone();
            canvas.label(Label::new(name, ink, vec![canvas.place_on(BodyId::Block(hold.block), hold.at)], 2));
        }
    }
}

/// Returns a bar `wide` mm long with the colours of shares from 0 to 1, for the legend.
pub(crate) fn colour_bar(canvas: &Canvas<'_>, wide: f64, colour: impl Fn(f64) -> Colour) -> Vec<Path> {
    // Each piece reaches to the end of the bar, so that no gaps are visible.
    let piece = |number: u32| {
        let (left, right) = (canvas.mm(wide) * f64::from(number) / f64::from(COLOURS), canvas.mm(wide));
        let half = canvas.mm(0.9);
        let corners = [(left, -half), (right, -half), (right, half), (left, half)];
        let share = f64::from(number) / f64::from(COLOURS - 1);
        Path::filled(Outline::ring(corners.map(|(x, y)| PagePoint::new(x, y))), colour(share))
    };
    (0..COLOURS).map(piece).collect()
}

/// Draws a dot at each contact that the scene lists.
pub(crate) fn listed_contacts(canvas: &mut Canvas<'_>) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    if !scene.lists_contacts() {
        return;
    }
    for contact in &canvas.found().contacts {
        let interface = &contact.interface;
        let at = canvas.place(interface.middle());
        let [a, b] = interface.bodies.map(|body| scene.name(body));
        let title = format!("Contact of {a} and {b}: friction coefficient {}", interface.friction);
        let dot = canvas.disc(at, 0.35, theme.ink);
        canvas.put(Mark::new(Layer::Force, "contact", vec![dot]).titled(title));
    }
}

/// Draws dimension lines below and to the left of all that is drawn: the width and the height of the blocks of the
/// frame, or of the block in the centre of a zoomed picture.
pub(crate) fn dimensions(canvas: &mut Canvas<'_>) {
    let scene = canvas.scene();
    let measured = canvas.frame().placed.iter().filter(|id| canvas.options.zoom.is_none_or(|zoomed| zoomed == **id));
    let Some(bounds) = scene.bounds(measured) else { return };
    let (all, blocks, ink) = (canvas.extent(), canvas.camera.rect(bounds), canvas.theme().faint);
    let size = canvas.label_size();
    let (tick, clear) = (canvas.mm(0.7), canvas.mm(2.4));
    let (x, y) = (all.at.x - clear, all.at.y + all.height + clear);
    let (left, right) = (blocks.at.x, blocks.at.x + blocks.width);
    let (top, bottom) = (blocks.at.y, blocks.at.y + blocks.height);
    let line = |from: PagePoint, to: PagePoint, (dx, dy): (f64, f64)| {
        let ends = [from, to].map(|end| [end.moved(-dx, -dy), end.moved(dx, dy)]);
        Path::stroked(Outline::lines([[from, to], ends[0], ends[1]]), canvas.pen(ink, 0.15))
    };
    let across = line(PagePoint::new(left, y), PagePoint::new(right, y), (0.0, tick));
    let up = line(PagePoint::new(x, top), PagePoint::new(x, bottom), (tick, 0.0));
    let words = |metres: f64| quantity(metres, scene.units.length());
    let (wide, high) = (words(bounds.width()), words(bounds.height()));
    let beside = x - canvas.mm(1.2) - text::width(&high, Face::Sans, size) / 2.0;
    let labels = [
        (wide, PagePoint::new((left + right) / 2.0, y + canvas.mm(0.7) + 0.6 * size)),
        (high, PagePoint::new(beside, (top + bottom) / 2.0)),
    ];
    canvas.put(Mark::new(Layer::Around, "dimensions", vec![across, up]).avoided(0.3));
    for (words, at) in labels {
        canvas.label(Label::at(at, words, ink, 5));
    }
}

/// Returns the entry of the legend with a bar of a round length, at most a quarter of the structure.
pub(crate) fn scale_bar(canvas: &Canvas<'_>) -> Option<Rc<Key>> {
    let units = canvas.scene().units.length();
    let metres = round_below_in(0.25 * canvas.camera.metres(canvas.structure.width), units);
    let (width, tick) = (canvas.camera.length(metres), canvas.mm(0.6));
    let line = |from: (f64, f64), to: (f64, f64)| [PagePoint::new(from.0, from.1), PagePoint::new(to.0, to.1)];
    let ends = [0.0, width].map(|x| line((x, -tick), (x, tick)));
    let bar = Outline::lines([line((0.0, 0.0), (width, 0.0)), ends[0], ends[1]]);
    let symbol = vec![Path::stroked(bar, canvas.pen(canvas.theme().ink, 0.22))];
    (metres > 0.0).then(|| Key::new(90, quantity(metres, units), symbol, width))
}

/// Returns the blocks of all frames, placed or planned.
pub(crate) fn shown_blocks(scene: &Scene) -> Vec<BlockId> {
    let frames = scene.frames.iter();
    let mut ids: Vec<BlockId> = frames
        .flat_map(|frame| frame.placed.iter().copied().chain(frame.plans.iter().map(|plan| plan.block)))
        .collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}
