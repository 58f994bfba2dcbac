//! [`DxfWalk`]: visits the entities of a DXF drawing, inserts blocks, and groups the curves by layer. It
//! leaves out outlines that are drawn twice.

use std::collections::BTreeMap;

use super::entity::{Shape, count, curve, point, turn};
use super::hatch;
use super::record::{Block, Document, Record};
use crate::sources::import::draft::{Draft, FillRule, Part, PartGeometry, Role, Values};
use crate::sources::import::limit::{MAX_BODIES, too_many};
use crate::sources::import::naming::Naming;
use crate::sources::import::stone::Stone;
use crate::sources::import::subpath::{Affine, Subpath};

/// The largest number of lines and outlines, copies included. Several lines make one outline.
const MAX_LINES: usize = 10 * MAX_BODIES;
/// The largest nesting depth of blocks.
const MAX_DEPTH: usize = 16;
/// Kinds of entities without outlines that drawings often contain. They are counted, and not reported one by one.
const ANNOTATIONS: &str = "ACAD_PROXY_ENTITY ATTDEF ATTRIB DIMENSION IMAGE LEADER MTEXT MULTILEADER OLE2FRAME RAY SEQEND \
    TEXT TOLERANCE VIEWPORT WIPEOUT XLINE ACAD_TABLE";

/// The state of the walk.
pub(super) struct DxfWalk<'d> {
    pub(super) document: &'d Document<'d>,
    pub(super) naming: &'d Naming<'d>,
    /// Metres per unit of the drawing.
    pub(super) metres: f64,
    pub(super) draft: Draft,
    /// The groups of lines: those of one layer in one insertion.
    pub(super) groups: BTreeMap<(String, usize), usize>,
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
            if self.draft.parts.len() > MAX_LINES {
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
            self.draft.skip("they are in paper space", described(entity, around));
            return None;
        }
        let layer = match entity.text(8).unwrap_or("0") {
            "0" => around.layer.clone(),
            layer => layer.to_owned(),
        };
        if self.document.hidden_layers.contains(layer.as_str()) {
            self.draft.skip("their layers are off or frozen", described(entity, around));
            return None;
        }
        let role = self.naming.role(&layer).or(around.role);
        if role == Some(Role::Ignored) {
            self.draft.skip(self.naming.why_ignored(), described(entity, around));
            return None;
        }
        Some(EntityContext { layer, role, ..around.clone() })
    }

    fn entity(&mut self, entity: &Record<'_>, vertices: &[Record<'_>], place: EntityContext) {
        let element = described(entity, &place);
        match curve(entity, vertices) {
            Some(Shape::Curve(curve)) => {
                self.part(&place, vec![curve.mapped(&place.map)], element);
            }
            Some(Shape::Point(at)) if place.role == Some(Role::Robot) => {
                let form = PartGeometry::Point(place.map.point(at));
                self.draft.parts.push(new_part(&place, form, element));
            }
            Some(Shape::Point(_)) => self.annotation("point", element),
            Some(Shape::Unreadable(why)) => {
                self.draft.lose("entity", &element, why, "draw the block as a closed polyline");
            }
            None if ANNOTATIONS.split(' ').any(|kind| kind == entity.kind) => {
                let is_text = matches!(entity.kind, "TEXT" | "MTEXT" | "ATTRIB" | "ATTDEF");
                self.annotation(if is_text { "text" } else { "annotation" }, element);
            }
            None => {
                let why = "entities of this kind are not read";
                self.draft.lose("entity", &element, why, "draw the block as a closed polyline");
            }
        }
    }

    /// Notes and counts an entity that never becomes a block.
    fn annotation(&mut self, what: &'static str, element: String) {
        self.draft.skip("they have no outline", element);
        *self.draft.left_out.entry(what).or_default() += 1;
    }

    fn part(&mut self, place: &EntityContext, curves: Vec<Subpath>, element: String) {
        let form = PartGeometry::Subpaths(curves, FillRule::EvenOdd);
        let next = self.groups.len();
        let group = *self.groups.entry((place.layer.clone(), place.insertion)).or_insert(next);
        self.draft.parts.push(Part { group, ..new_part(place, form, element) });
    }

    /// Reads the entities of the block that an INSERT entity inserts, once for each place in its grid of rows and
    /// columns.
    fn insert(&mut self, insert: &Record<'_>, around: &EntityContext) -> Result<(), String> {
        let name = insert.text(2).unwrap_or("");
        let element = described(insert, around);
        let Some(block) = self.document.blocks.get(name) else {
            let why = format!("its block `{}` is not in the file", crate::text::heading(name, 60));
            self.draft.lose("entity", &element, &why, "");
            return Ok(());
        };
        // If flag 4 or 8 is set in group code 70, the block refers to another drawing file.
        if block.head.has_flag(70, 4 | 8) {
            let help = "bind the external drawing, or explode it";
            self.draft.lose("entity", &element, "it refers to another drawing file", help);
            return Ok(());
        }
        if around.depth >= MAX_DEPTH {
            let why = format!("blocks are nested more than {MAX_DEPTH} levels deep");
            self.draft.lose("entity", &element, &why, "explode the blocks");
            return Ok(());
        }
        let mut role = around.role;
        if let Some(own) = self.naming.role(name) {
            role = Some(own);
        }
        if role == Some(Role::Ignored) {
            self.draft.skip(self.naming.why_ignored(), element);
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
                self.part(place, loops.iter().map(|curve| curve.mapped(&place.map)).collect(), element);
                if let Some(part) = self.draft.parts.last_mut() {
                    part.is_fill = true;
                }
            }
            Err(why) => self.draft.lose("hatch", &element, why, ""),
        }
    }
}

fn new_part(place: &EntityContext, form: PartGeometry, element: String) -> Part {
    let stone = Stone::from_name(&place.layer);
    let values = Values { friction: stone.map(|s| s.friction), density: stone.map(|s| s.density), ..Values::default() };
    Part { values, ..Part::new(place.role, &place.block, element, form) }
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
    Affine::scale(turn(insert).unwrap_or(1.0), 1.0).after(&map)
}
