//! [`DxfWalk`]: visits the entities of a DXF drawing, inserts blocks, and groups the curves by layer. It
//! leaves out outlines that are drawn twice.

use std::collections::BTreeMap;

use super::chain::{OpenCurve, chains};
use super::entity::{Extrusion, Shape, count, curve, extrusion, point};
use super::hatch;
use super::record::{Block, Document, Record};
use crate::geometry::{Bounds, Point};
use crate::sources::import::LENGTH_TOL;
use crate::sources::import::draft::{Draft, FillRule, Part, PartGeometry, Role, Values};
use crate::sources::import::limit::{MAX_BODIES, too_many};
use crate::sources::import::naming::Naming;
use crate::sources::import::stone::Stone;
use crate::sources::import::subpath::{Affine, Subpath};
use crate::text::and_more;

/// The largest nesting depth of blocks.
const MAX_DEPTH: usize = 16;
/// Kinds of entities without outlines that drawings often contain. They are counted, and not reported one by one.
const ANNOTATIONS: [&str; 17] = [
    "ACAD_PROXY_ENTITY",
    "ATTDEF",
    "ATTRIB",
    "DIMENSION",
    "IMAGE",
    "LEADER",
    "MTEXT",
    "MULTILEADER",
    "OLE2FRAME",
    "RAY",
    "SEQEND",
    "TEXT",
    "TOLERANCE",
    "VIEWPORT",
    "WIPEOUT",
    "XLINE",
    "ACAD_TABLE",
];

/// The state of the walk.
pub(super) struct DxfWalk<'d> {
    pub(super) document: &'d Document<'d>,
    pub(super) naming: &'d Naming<'d>,
    /// Metres per unit of the drawing.
    pub(super) metres: f64,
    pub(super) draft: Draft,
    /// Open curves by layer and by insertion: only curves of one layer in one insertion form a loop.
    pub(super) open: BTreeMap<(String, usize), (EntityContext, Vec<OpenCurve>)>,
    pub(super) hatches: Vec<(EntityContext, Vec<Subpath>, String)>,
    /// The number of entities that are left out, by reason.
    pub(super) left_out: BTreeMap<String, usize>,
    /// The number of insertions so far.
    pub(super) inserted: usize,
}

/// The properties that entities inherit: their transform, layer, block and role.
#[derive(Clone, Debug)]
pub(super) struct EntityContext {
    map: Affine,
    /// The name of the layer. Entities of a block on layer 0 inherit the layer of the INSERT.
    layer: String,
    /// The name of the innermost block with a name; empty outside of blocks.
    block: String,
    role: Option<Role>,
    insertion: usize,
    depth: usize,
}

impl<'d> DxfWalk<'d> {
    /// Reads the entities of the drawing, and those of the blocks that they insert.
    ///
    /// # Errors
    /// Returns a message if the drawing has too many outlines.
    pub(super) fn drawing(&mut self) -> Result<(), String> {
        let place = EntityContext {
            map: Affine::scale(self.metres, self.metres),
            layer: "0".into(),
            block: String::new(),
            role: None,
            insertion: 0,
            depth: 0,
        };
        self.entities(self.document.entities, &place)
    }

    fn entities(&mut self, records: &'d [Record<'d>], around: &EntityContext) -> Result<(), String> {
        for (i, entity) in records.iter().enumerate() {
            if self.draft.parts.len() > MAX_BODIES {
                return Err(too_many(self.draft.parts.len()).message);
            }
            if entity.kind == "VERTEX" || entity.kind == "SEQEND" {
                continue;
            }
            let Some(place) = self.place(entity, around) else {
                continue;
            };
            match entity.kind {
                "INSERT" => self.insert(entity, &place)?,
                "HATCH" => self.hatch(entity, &place),
                _ => {
                    let vertices = &records[i + 1..];
                    let end = vertices.iter().position(|r| r.kind != "VERTEX");
                    self.entity(entity, &vertices[..end.unwrap_or(vertices.len())], place);
                }
            }
        }
        Ok(())
    }

    /// Returns the transform, layer and role of an entity, which depend on those of the block around it. Returns
    /// `None`, and counts the entity as left out, if it is in paper space or on a hidden or ignored layer.
    fn place(&mut self, entity: &Record<'_>, around: &EntityContext) -> Option<EntityContext> {
        if entity.integer(67) == 1 {
            self.leave("entities in paper space");
            return None;
        }
        let layer = match entity.text(8).unwrap_or("0") {
            "0" => around.layer.clone(),
            layer => layer.to_owned(),
        };
        if self.document.hidden_layers.contains(layer.as_str()) {
            self.leave("entities on layers that are off or frozen");
            return None;
        }
        let role = self.naming.role(&layer).or(around.role);
        if role == Some(Role::Ignored) {
            self.leave("entities on layers whose names begin with ignore or guide, or are given with --ignore");
            return None;
        }
        Some(EntityContext { layer, role, ..around.clone() })
    }

    fn entity(&mut self, entity: &Record<'_>, vertices: &[Record<'_>], place: EntityContext) {
        let element = described(entity, &place);
        match curve(entity, vertices) {
            Some(Shape::Curve(curve)) => {
                let curve = curve.mapped(&place.map);
                if curve.closed {
                    self.part(&place, vec![curve], element);
                } else {
                    let key = (place.layer.clone(), place.insertion);
                    let (_, list) = self.open.entry(key).or_insert((place, Vec::new()));
                    list.push(OpenCurve { curve, element });
                }
            }
            Some(Shape::Point(at)) if place.role == Some(Role::Robot) => {
                let form = PartGeometry::Point(place.map.point(at));
                self.draft.parts.push(new_part(&place, form, element));
            }
            Some(Shape::Point(_)) => self.leave("POINT"),
            Some(Shape::Unreadable(why)) => {
                self.draft.remark(element, format!("{why}; left out"), "draw the block as a closed polyline")
            }
            None if ANNOTATIONS.contains(&entity.kind) => self.leave(entity.kind),
            None => self.draft.remark(
                element,
                "entities of this kind are not read; left out",
                "draw the block as a closed polyline",
            ),
        }
    }

    fn part(&mut self, place: &EntityContext, curves: Vec<Subpath>, element: String) {
        let form = PartGeometry::Subpaths(curves, FillRule::EvenOdd);
        self.draft.parts.push(new_part(place, form, element));
    }

    /// Reads the entities of the block that an INSERT entity inserts, once for each place in its grid of rows and
    /// columns.
    fn insert(&mut self, insert: &Record<'_>, around: &EntityContext) -> Result<(), String> {
        let name = insert.text(2).unwrap_or("");
        let element = described(insert, around);
        let Some(block) = self.document.blocks.get(name) else {
            let why = format!("its block `{}` is not in the file; left out", crate::text::heading(name, 60));
            self.draft.remark(element, why, "");
            return Ok(());
        };
        // If flag 4 or 8 is set in group code 70, the block refers to another drawing file.
        if block.head.has_flag(70, 4 | 8) {
            let help = "bind the external drawing, or explode it";
            self.draft.remark(element, "it refers to another drawing file; left out", help);
            return Ok(());
        }
        if around.depth >= MAX_DEPTH {
            let why = format!("blocks are nested more than {MAX_DEPTH} levels deep; left out");
            self.draft.remark(element, why, "explode the blocks");
            return Ok(());
        }
        let mut role = around.role;
        if let Some(own) = self.naming.role(name) {
            role = Some(own);
        }
        if role == Some(Role::Ignored) {
            self.leave("entities in blocks whose names begin with ignore or guide, or are given with --ignore");
            return Ok(());
        }
        let times = |code: i32| insert.text(code).map_or(1, count).max(1);
        let (columns, rows) = (times(70), times(71));
        if columns.saturating_mul(rows) > MAX_BODIES {
            return Err(too_many(columns.saturating_mul(rows)).message);
        }
        for cell in 0..columns * rows {
            self.inserted += 1;
            if self.inserted > 10 * MAX_BODIES {
                return Err(too_many(self.inserted).message);
            }
            let place = EntityContext {
                map: around.map.after(&transform(insert, block, [cell % columns, cell / columns])),
                // Names of anonymous blocks, such as those of dimensions and hatches, begin with an asterisk. No user
                // gave them, so the name of the outer block is kept.
                block: if name.starts_with('*') { around.block.clone() } else { name.to_owned() },
                role,
                insertion: self.inserted,
                depth: around.depth + 1,
                ..around.clone()
            };
            self.entities(block.entities, &place)?;
        }
        Ok(())
    }

    fn hatch(&mut self, entity: &Record<'_>, place: &EntityContext) {
        let element = described(entity, place);
        match hatch::loops(entity) {
            Ok(loops) => {
                let loops = loops.iter().map(|curve| curve.mapped(&place.map)).collect();
                self.hatches.push((place.clone(), loops, element));
            }
            Err(why) => self.draft.remark(element, format!("{why}; left out"), ""),
        }
    }

    fn leave(&mut self, reason: &str) {
        *self.left_out.entry(reason.to_owned()).or_default() += 1;
    }

    /// Joins open curves into loops, adds the boundaries of hatches that do not fill a drawn outline, adds notes
    /// about everything that is left out, and returns the draft.
    pub(super) fn finish(mut self) -> Draft {
        let boxes = self.open.values().flat_map(|(_, list)| list).map(|o| around(&o.curve));
        let size = boxes.chain(self.draft.parts.iter().map(part_box)).flatten().reduce(Bounds::union);
        // Two ends meet if their distance is at most `LENGTH_TOL` times the size of the drawing.
        let tolerance = LENGTH_TOL * size.map_or(0.0, Bounds::diagonal);
        for ((layer, _), (place, list)) in std::mem::take(&mut self.open) {
            self.chain(&layer, &place, list, tolerance);
        }
        self.add_hatches();
        for (reason, number) in std::mem::take(&mut self.left_out) {
            self.draft.notes.push(format!("left out: {reason} ({number})"));
        }
        self.draft
    }

    fn chain(&mut self, layer: &str, place: &EntityContext, list: Vec<OpenCurve>, tolerance: f64) {
        let chained = if tolerance > 0.0 { chains(list, tolerance) } else { Default::default() };
        for (curve, element) in chained.loops {
            self.part(place, vec![curve], element);
        }
        let Some(first) = chained.left.first() else {
            return;
        };
        let more = match and_more(chained.left.len() - 1) {
            none if none.is_empty() => none,
            more => format!("{more} on layer {}", crate::text::heading(layer, 60)),
        };
        let (why, help) = match chained.branch {
            Some(at) => (
                format!(
                    "more than two lines meet at ({:.6}, {:.6}) m, so they form no single loop; left out",
                    at.x, at.y
                ),
                "draw each block as a closed polyline, for example with the command BOUNDARY",
            ),
            None => ("the lines do not close to a loop; left out".to_owned(), "close the outline"),
        };
        self.draft.remark(format!("{}{more}", first.element), why, help);
    }

    /// Adds the boundaries of hatches as outlines, unless they coincide with outlines that are drawn.
    fn add_hatches(&mut self) {
        let mut drawn: Vec<Bounds> = self.draft.parts.iter().filter_map(part_box).collect();
        drawn.sort_by(|a, b| a.min.x.total_cmp(&b.min.x));
        let mut filled = 0;
        for (place, loops, element) in std::mem::take(&mut self.hatches) {
            let total = loops.len();
            let own: Vec<Subpath> =
                loops.into_iter().filter(|curve| around(curve).is_some_and(|own| !coincides(own, &drawn))).collect();
            filled += total - own.len();
            if !own.is_empty() {
                self.part(&place, own, element);
            }
        }
        if filled > 0 {
            self.draft.notes.push(format!("left out: boundaries of hatches that fill a drawn outline ({filled})"));
        }
    }
}

fn new_part(place: &EntityContext, form: PartGeometry, element: String) -> Part {
    let stone = Stone::from_name(&place.layer);
    Part {
        kind: place.role.unwrap_or(Role::Block),
        name: place.block.clone(),
        element,
        form,
        clips: Vec::new(),
        fill: None,
        values: Values { friction: stone.map(|s| s.friction), density: stone.map(|s| s.density), weight: None },
    }
}

/// Returns the kind, layer and line of an entity as text, so that the user finds it in the drawing.
fn described(entity: &Record<'_>, place: &EntityContext) -> String {
    let layer = crate::text::heading(&place.layer, 60);
    format!("{} on layer {layer} in line {}", entity.kind, entity.line)
}

/// Returns the map from the coordinates of a block to the coordinates in which it is inserted. The order is: subtract
/// the base point, scale, shift to the row and column, rotate, move. A normal that points down mirrors the result.
fn transform(insert: &Record<'_>, block: &Block<'_>, [column, row]: [usize; 2]) -> Affine {
    let number = |code, default| insert.number(code).unwrap_or(default);
    let base = point(block.head, 10);
    let at = point(insert, 10);
    let offset = [column as f64 * number(44, 0.0), row as f64 * number(45, 0.0)];
    let map = Affine::translation(at.x, at.y)
        .after(&Affine::rotation(number(50, 0.0)))
        .after(&Affine::translation(offset[0], offset[1]))
        .after(&Affine::scale(number(41, 1.0), number(42, 1.0)))
        .after(&Affine::translation(-base.x, -base.y));
    match extrusion(insert) {
        Extrusion::Down => Affine::scale(-1.0, 1.0).after(&map),
        _ => map,
    }
}

/// Two outlines coincide if their boxes differ by at most this share of their size.
const COINCIDENCE_TOL: f64 = 1e-6;

/// Returns the bounding box of a curve, in which an arc counts as its whole ellipse. Returns `None` if a coordinate is
/// not finite.
pub(super) fn around(curve: &Subpath) -> Option<Bounds> {
    let hull = curve.hull();
    let is_finite = hull.iter().all(|p: &Point| p.x.is_finite() && p.y.is_finite());
    if is_finite { Bounds::from_points(hull) } else { None }
}

/// Returns the bounding box of a part; `None` for a point, or if no curve has finite coordinates.
pub(super) fn part_box(part: &Part) -> Option<Bounds> {
    match &part.form {
        PartGeometry::Subpaths(curves, _) => curves.iter().filter_map(around).reduce(Bounds::union),
        PartGeometry::Point(_) => None,
    }
}

/// True if the box `own` coincides with one of `boxes`, within a millionth of the diagonal of `own`. `boxes` must be
/// sorted by `min.x`.
pub(super) fn coincides(own: Bounds, boxes: &[Bounds]) -> bool {
    let tolerance = COINCIDENCE_TOL * own.diagonal();
    let first = boxes.partition_point(|b| b.min.x < own.min.x - tolerance);
    boxes[first..]
        .iter()
        .take_while(|b| b.min.x <= own.min.x + tolerance)
        .any(|b| (b.min - own.min).norm() <= tolerance && (b.max - own.max).norm() <= tolerance)
}
