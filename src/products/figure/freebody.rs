//! Draws a block as a free body: all forces on the block with their names, and a table of these forces with their sum.
//!
//! Weight, loads, forces of other bodies and robots, and missing forces each have an arrow and a row in the table. The
//! length of the arrow shows the magnitude. A block with one interface has separate normal and friction forces at
//! each end of the interface, named as in figure 1 of the thesis ([Vallat23](crate::doc::references) §2.0.3). A block
//! with two or three interfaces has one force at each end of an interface, numbered as in figure 2 of the thesis. A
//! block with more interfaces has one force for each interface. With [`Corners::All`](super::option::Corners) the
//! arrows name every unknown force instead, even if it is zero. All arrows of normal forces then have the same length,
//! and so on for each kind of force.
//!
//! Bodies that touch the block are outlined, and ground is hatched.

mod arrow;
mod force;
mod surroundings;
mod table;

use arrow::{Arrow, Arrows, NOISE, least_length, longest};
use force::{Force, forces, largest};
use surroundings::{Piece, clipped, corners, distinct, neighbours, view};
use table::Table;

use super::arrow::round_above;
use super::canvas::Canvas;
use super::design::{ArrowSize, Layer, Mark, around, unit};
use super::option::{Corners, Options};
use super::panel::{About, Figure, Subject};
use super::placing::Label;
use super::verdict;
use crate::mechanics::analysis::{Analysis, Contact};
use crate::mechanics::scene::{BlockId, BodyId};
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::pictures::drawing::{Anchor, Face, Group, Item, Outline, PagePoint, Path, Text, hatch, text};
use crate::products::wording::number::{letter, listed, quantity, round_below_in};

/// Font size of the table, pixels.
const LIST_SIZE: f64 = 15.0;
/// Largest number of names of forces and of bodies.
const MAX_NAMES: usize = 150;
/// Largest size of the block in a picture, mm.
const LARGEST_BLOCK: f64 = 46.0;
/// Ranks of the names of forces and coordinates, of the block itself, and of the bodies around it.
const SYMBOL_RANK: u8 = 10;
const NAME_RANK: u8 = 80;

/// The figure of a free body.
pub(crate) struct FreeBody;

impl Figure for FreeBody {
    fn about(&self) -> About {
        About {
            shows_one_block: true,
            ..About::new(
                "freebody",
                "One block as a free body: all forces on it, with their names and a table of them",
                "A block cut free",
            )
        }
    }

    fn subject(&self, analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        let block = shown_block(analysis, options);
        let placed = |frame: &usize| analysis.given().frames[*frame].placed.contains(&block);
        let frames: Vec<usize> = match frames {
            Some(frames) => frames.iter().copied().filter(placed).collect(),
            None => (0..analysis.frames.len()).rev().find(placed).into_iter().collect(),
        };
        let views = frames.iter().map(|frame| view(analysis, block, &contacts(analysis, *frame, block)));
        let own = analysis.given().blocks.get(block.0).map(|block| block.body.polygon.bounds());
        let bounds = views.reduce(|a, b| a.union(b)).or(own);
        let Some(bounds) = bounds else { return Subject::structure(analysis, options, Some(&frames)) };
        let side = own.map_or(1.0, |own| own.width().max(own.height()));
        Subject { frames, bounds, is_cut: false, block: (side, LARGEST_BLOCK) }
    }

    fn caption(&self, analysis: &Analysis, frame: usize, options: &Options) -> String {
        let scene = analysis.given();
        let Some(block) = scene.blocks.get(shown_block(analysis, options).0) else { return String::new() };
        let mut words = format!("Block {} cut free", block.id);
        if scene.frames.len() > 1 {
            words.push_str(&format!(", step ({}) of {}", letter(frame), scene.frames.len()));
            if !scene.frames[frame].title.is_empty() {
                words.push_str(&format!(": {}", scene.frames[frame].title));
            }
        }
        words
    }

    fn verdict(&self, analysis: &Analysis, frame: usize) -> String {
        let word = verdict::badge(&analysis.frames[frame]);
        if analysis.given().frames[frame].placed.len() > 1 { format!("the structure {word}") } else { word.to_owned() }
    }

    fn words(&self, _analysis: &Analysis, _frame: usize, _options: &Options) -> Vec<String> {
        Vec::new()
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        let Some(body) = Body::new(canvas) else { return };
        let arrows = Arrows::new(canvas, &body).all();
        body.around(canvas);
        body.arrows(canvas, &arrows);
        if body.guided {
            body.guides(canvas);
        }
        body.axes(canvas);
    }

    fn description(&self, canvas: &Canvas<'_>) -> String {
        let Some(body) = Body::new(canvas) else { return String::new() };
        let arrows = Arrows::new(canvas, &body).all();
        let titles: Vec<&str> = arrows.iter().map(|arrow| arrow.title.as_str()).collect();
        let mut stated = body.table(canvas).stated();
        if body.guided {
            let places = surroundings::places(canvas.analysis, body.block, &body.contacts);
            stated.extend(places.iter().map(|place| place.iter().map(Piece::stated).collect()));
        }
        format!("{}. {}.", titles.join(". "), stated.join("; "))
    }

    fn list(&self, canvas: &Canvas<'_>, room: f64) -> (Group, f64) {
        match Body::new(canvas) {
            Some(body) if canvas.options.keys => body.list(canvas, room),
            _ => (Group::default(), 0.0),
        }
    }
}

/// Returns the block that the options name; without one, the block on which the largest contact force acts.
fn shown_block(analysis: &Analysis, options: &Options) -> BlockId {
    if let Some(block) = options.block {
        return block;
    }
    let contacts = analysis.frames.last().map_or(&[][..], |frame| &frame.contacts);
    let largest = contacts.iter().max_by(|a, b| a.amount().total_cmp(&b.amount()));
    let bodies = largest.map(|contact| contact.interface.bodies);
    let block = bodies.into_iter().flatten().find_map(|body| match body {
        BodyId::Block(id) => Some(id),
        BodyId::Ground(_) => None,
    });
    let placed = || analysis.given().frames.iter().rev().find_map(|frame| frame.placed.first().copied());
    block.or_else(placed).unwrap_or(BlockId(0))
}

fn contacts(analysis: &Analysis, frame: usize, block: BlockId) -> Vec<&Contact> {
    let contacts = analysis.frames[frame].contacts.iter();
    contacts.filter(|contact| contact.interface.bodies.contains(&BodyId::Block(block))).collect()
}

/// The block of a figure with all that acts on it.
struct Body<'a> {
    block: BlockId,
    /// The contacts of the block.
    contacts: Vec<&'a Contact>,
    forces: Vec<Force>,
    /// Whether the figure shows coordinates: the block has exactly one interface, and no robot holds the block. In other
    /// cases the dashed lines to the axes would make the picture unreadable.
    guided: bool,
}

impl<'a> Body<'a> {
    /// Returns `None` if the frame of the canvas does not place the block.
    fn new(canvas: &Canvas<'a>) -> Option<Body<'a>> {
        let (analysis, frame) = (canvas.analysis, canvas.number);
        let block = shown_block(analysis, canvas.options);
        if !canvas.frame().placed.contains(&block) {
            return None;
        }
        let contacts = contacts(analysis, frame, block);
        let forces = forces(analysis, frame, block, &contacts, canvas.options);
        let guided = contacts.len() == 1 && !canvas.frame().holds.iter().any(|hold| hold.block == block);
        Some(Body { block, contacts, forces, guided })
    }

    fn table(&self, canvas: &Canvas<'_>) -> Table {
        let block = &canvas.scene().blocks[self.block.0];
        let size = block.body.polygon.bounds().diagonal();
        Table::new(&self.forces, block.centroid, size, canvas.scene().units)
    }

    /// Returns the force of the longest arrow, N.
    fn largest(&self, canvas: &Canvas<'_>) -> f64 {
        largest(&self.forces, unit(canvas.scene(), None), canvas.options)
    }

    /// Draws the block and the parts near it of the bodies that touch it. Ground is hatched.
    fn around(&self, canvas: &mut Canvas<'_>) {
        let (scene, theme, view) = (canvas.scene(), canvas.theme(), canvas.structure);
        let own = BodyId::Block(self.block);
        let bodies = neighbours(&self.contacts, self.block).into_iter().chain([own]);
        for (number, body) in bodies.enumerate() {
            let polygon = &scene.body(body).polygon;
            let name = scene.name(body);
            let is_ground = matches!(body, BodyId::Ground(_));
            let title = if is_ground { "Ground".to_owned() } else { format!("Block {name}") };
            let on_page = |ring: &Vec<_>| ring.iter().map(|p| canvas.place(*p)).collect();
            let rings: Vec<Vec<PagePoint>> = polygon.rings().iter().map(on_page).collect();
            let sides = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
            let edges = Outline::lines(sides.filter_map(|(a, b)| view.part_of([*a, *b])));
            let width = if body == own { 0.34 } else { 0.24 };
            let edges = vec![Path::stroked(edges, canvas.pen(theme.ink, width))];
            if is_ground {
                let hatching = Outline::lines(hatch(&rings, view, canvas.mm(1.3)));
                let hatching = vec![Path::stroked(hatching, canvas.pen(theme.faint, 0.15))];
                canvas.put(Mark::new(Layer::Ground, "body", hatching).titled(title.clone()).avoided(0.0));
            } else {
                let visible: Vec<Vec<PagePoint>> = rings.iter().map(|ring| clipped(ring, view)).collect();
                let inside = around(visible.iter().flatten().copied());
                let shown = visible.into_iter().map(Outline::ring).reduce(|mut all, ring| {
                    all.extend(ring);
                    all
                });
                let fill = vec![Path::filled(shown.unwrap_or_default(), theme.page)];
                canvas.put(Mark::new(Layer::Stone, "block", fill).titled(title.clone()));
                if let Some(inside) = inside.filter(|_| canvas.options.labels && number < MAX_NAMES) {
                    let middle = inside.at.moved(inside.width / 2.0, inside.height / 2.0);
                    // Names of one rank are left out together, so each body has a rank of its own.
                    let rank = NAME_RANK + (number.min(100) as u8);
                    let label = Label::new(name.to_owned(), theme.faint, vec![middle], rank);
                    canvas.label(Label { inside: Some(inside), ..label });
                }
            }
            let class = if body == own { "block" } else { "body" };
            canvas.put(Mark::new(Layer::Stone, class, edges).titled(title).avoided(0.2));
        }
    }

    /// Draws the arrows that are long enough to be seen, those of missing forces above the others, and asks for their
    /// names.
    fn arrows(&self, canvas: &mut Canvas<'_>, arrows: &[Arrow]) {
        let names = canvas.options.labels;
        for (number, arrow) in arrows.iter().filter(|arrow| arrow.is_seen()).enumerate() {
            let shapes = arrow.shapes(canvas);
            let layer = if arrow.missing { Layer::Missing } else { Layer::Force };
            canvas.put(Mark::new(layer, "force", shapes).titled(arrow.title.clone()).avoided(0.25));
            if let Some(symbol) = arrow.symbol.clone().filter(|_| names && number < MAX_NAMES) {
                let ink = canvas.theme().ink;
                let (anchors, away) = arrow.anchors();
                let label = Label::new(symbol.stated(), ink, anchors, SYMBOL_RANK + u8::from(!arrow.missing));
                canvas.label(Label { symbol: Some(symbol), away, ..label });
            }
        }
    }

    /// Draws dashed lines from the application points and the centroid to the left and lower edges of the picture, with
    /// the names of their coordinates, such as `c_x`.
    fn guides(&self, canvas: &mut Canvas<'_>) {
        let theme = canvas.theme();
        let all = canvas.extent();
        let (left, floor) = (all.at.x - canvas.mm(2.0), all.at.y + all.height + canvas.mm(1.0));
        let mut points = vec![("c", String::new(), canvas.scene().blocks[self.block.0].centroid)];
        for contact in &self.contacts {
            let count = distinct(contact).len();
            for (k, corner) in corners(contact, self.block).iter().enumerate().take(count) {
                points.push(("p", (k + 1).to_string(), corner.at));
            }
        }
        let size = canvas.label_size();
        let dash = canvas.dashes(theme.faint, 0.18, [0.9, 0.7]);
        for (letter, number, point) in points {
            let p = canvas.place(point);
            for (end, axis) in [(PagePoint::new(left, p.y), "y"), (PagePoint::new(p.x, floor), "x")] {
                let line = vec![Path::stroked(Outline::line([end, p]), dash.clone())];
                canvas.put(Mark::new(Layer::Stone, "guides", line).avoided(0.1));
                let symbol = Symbol::new(letter, Accent::None, &format!("{axis}{number}"));
                let (wide, high) = symbol.size(1.4 * size);
                let fixed = match axis {
                    "y" => end.moved(-canvas.mm(0.8) - wide / 2.0, 0.0),
                    _ => end.moved(0.0, canvas.mm(0.4) + high / 2.0),
                };
                let away = Some(if axis == "y" { (-1.0, 0.0) } else { (0.0, 1.0) });
                let label = Label::new(symbol.stated(), theme.ink, vec![end], 1);
                canvas.label(Label { symbol: Some(symbol), fixed: Some(fixed), away, ..label });
            }
        }
    }

    /// Draws two arrows at the lower left of the picture that show the directions of the x and y axes.
    fn axes(&self, canvas: &mut Canvas<'_>) {
        let theme = canvas.theme();
        let all = canvas.extent();
        let long = canvas.mm(6.5);
        let aside = canvas.mm(if self.guided { 4.5 } else { 1.0 });
        let origin = PagePoint::new(all.at.x - aside, all.at.y + all.height + canvas.mm(8.5));
        let size = ArrowSize { length: long, shaft: canvas.mm(0.26), head: (canvas.mm(1.1), canvas.mm(1.4)) };
        let shapes = [(1.0, 0.0), (0.0, -1.0)].map(|u| Path::filled(size.outline(origin, u), theme.ink)).to_vec();
        let mark = Mark::new(Layer::Around, "axes", shapes).titled("Axes: x to the right, y up");
        canvas.put(mark.avoided(0.2));
        let far = long + canvas.mm(2.0);
        for (name, at) in [("x", origin.moved(far, 0.0)), ("y", origin.moved(0.0, -far))] {
            let label = Label::at(at, name.into(), theme.ink, 0);
            canvas.label(Label { symbol: Some(Symbol::new(name, Accent::None, "")), ..label });
        }
    }

    /// Draws the scale of the arrows, centred at x = 0: an arrow for a round number of newtons. `y` is the baseline of
    /// its text. The result is empty if lengths show no magnitudes.
    fn scale(&self, canvas: &Canvas<'_>, y: f64) -> Vec<Item> {
        let (largest, units) = (self.largest(canvas), canvas.scene().units.force());
        let (amount, theme) = (round_below_in(largest, units), canvas.theme());
        if !(amount > 0.0) {
            return Vec::new();
        }
        let (size, gap, words) = (theme.sizes.key, canvas.mm(1.2), quantity(amount, units));
        let width = amount / largest * longest(canvas, self.block);
        let left = -(width + gap + text::width(&words, Face::Sans, size)) / 2.0;
        let outline = arrow::size(canvas, width, 1.0).outline(PagePoint::new(left, y - 0.36 * size), (1.0, 0.0));
        let words = Text::new(PagePoint::new(left + width + gap, y), words, Face::Sans, size, theme.faint);
        vec![Path::filled(outline, theme.ink).into(), words.into()]
    }

    /// Returns the notes on the picture: that lengths show no magnitudes, which small forces have enlarged arrows, how
    /// many forces are left out, and that the forces on the block do not balance.
    fn notes(&self, canvas: &Canvas<'_>) -> Vec<String> {
        let mut notes = Vec::new();
        if canvas.options.corners == Corners::All {
            notes.push("arrows name forces; their lengths show no amounts".to_owned());
        }
        let (largest, newtons) = (self.largest(canvas), canvas.scene().units.force());
        notes.extend(self.enlarged(canvas, largest));
        let arrows = Arrows::new(canvas, self).all();
        let unseen = arrows.iter().filter(|arrow| !arrow.is_seen()).count();
        if unseen > 0 {
            let amount = quantity(round_above(largest * NOISE), newtons);
            let forces = if unseen == 1 { "force" } else { "forces" };
            notes.push(format!("{unseen} {forces} under {amount} not drawn"));
        }
        if canvas.found().unsupported.contains(&self.block) {
            notes.push("the forces on this block do not balance: it falls even if all contacts could stick".to_owned());
        }
        notes
    }

    /// Returns a note on small forces whose arrows are longer than in proportion to their magnitudes. Returns `None`
    /// if there is no such arrow. `largest` is the force of the longest arrow, N.
    fn enlarged(&self, canvas: &Canvas<'_>, largest: f64) -> Option<String> {
        let (units, edge) = (canvas.scene().units, unit(canvas.scene(), None));
        let longest = longest(canvas, self.block);
        let mut small: Vec<String> = Vec::new();
        for force in &self.forces {
            let limit = largest * least_length(canvas, force) / longest;
            let is_small = |amount: f64| amount > NOISE * largest && amount < limit;
            let what = if force.kind.is_failure() { "missing " } else { "" };
            if is_small(force.force.norm()) {
                small.push(format!("{what}forces under {}", quantity(limit, units.force())));
            }
        }
        for force in self.forces.iter().filter(|force| force.torque != 0.0) {
            let limit = largest * least_length(canvas, force) / longest * edge;
            if force.torque.abs() < limit {
                let what = if force.kind.is_failure() { "missing " } else { "" };
                small.push(format!("{what}torques under {}", quantity(limit, units.torque())));
            }
        }
        small.sort();
        small.dedup();
        (!small.is_empty()).then(|| format!("{} are drawn larger", listed(&small)))
    }

    /// Draws the scale, the notes, the table of the forces and, if the figure shows coordinates, their values.
    fn list(&self, canvas: &Canvas<'_>, room: f64) -> (Group, f64) {
        let theme = canvas.theme();
        let mut group = Group::with_class("values");
        let size = theme.sizes.key;
        let mut y = 1.2 * size;
        let scale = self.scale(canvas, y);
        y = if scale.is_empty() { 0.0 } else { y };
        group.items.extend(scale);
        for line in self.notes(canvas).iter().flat_map(|note| text::wrap(note, Face::Sans, size, room)) {
            y += 1.36 * size;
            let words = Text::new(PagePoint::new(0.0, y), line, Face::Sans, size, theme.faint);
            group.items.push(words.anchored(Anchor::Middle).into());
        }
        y += canvas.mm(1.6);
        let (list, height) = self.table(canvas).draw(PagePoint::new(0.0, y), room, LIST_SIZE, theme);
        group.items.push(list.into());
        y += height + canvas.mm(1.2);
        if self.guided {
            let values = surroundings::places(canvas.analysis, self.block, &self.contacts);
            for row in surroundings::rows(&values, LIST_SIZE, room) {
                y += 1.55 * LIST_SIZE;
                let mut at = PagePoint::new(-surroundings::width(&row, LIST_SIZE) / 2.0, y);
                for piece in row {
                    let (items, width): (Vec<Item>, f64) = piece.draw(at, LIST_SIZE, theme);
                    group.items.extend(items);
                    at = at.moved(width, 0.0);
                }
            }
            y += 0.5 * LIST_SIZE;
        }
        (group, y)
    }
}
