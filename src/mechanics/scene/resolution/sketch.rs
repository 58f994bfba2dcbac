//! Finds the outlines with which the bodies of a scene file can be drawn, even if these outlines are not valid.

use super::Resolution;
use super::body::BodyEntry;
use crate::geometry::{Cell, Lattice, Point};
use crate::mechanics::scene::finding::{Finding, Findings, UnreadParts};
use crate::mechanics::scene::format::{CellEntry, Pair, SceneFile};
use crate::mechanics::scene::number::MAX_MAGNITUDE;
use crate::mechanics::scene::outline::{cell_parts, node, placed_point};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::read::Trail;

/// A body of the scene file, at its position in the scene. Healing does not change it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SketchedBody {
    /// The id of the body.
    pub id: BodyId,
    /// The id of a block, or a name such as `ground[2]` for a part of the ground.
    pub name: String,
    /// Its outline and holes, in the units of the file. They may cross, and may have any number of corners.
    pub rings: Vec<Vec<Point>>,
    pub(in crate::mechanics::scene) placement: Placement,
}

/// The position of a body: it is rotated about its origin and then moved.
#[derive(Clone, Copy, Debug)]
pub(in crate::mechanics::scene) struct Placement {
    lattice: Option<Lattice>,
    at: Pair,
    angle: f64,
}

impl Placement {
    pub(in crate::mechanics::scene) fn place(&self, p: Point) -> Point {
        placed_point(self.lattice, p.into(), self.at, self.angle)
    }
}

/// Returns all bodies that can be drawn, the ground first. Also returns the scene if all its bodies are valid; they may
/// overlap, and its lengths are in the units of the file, not in SI units. Adds all problems to `found`.
pub(in crate::mechanics::scene) fn sketch(
    file: &SceneFile,
    unread: UnreadParts,
    found: &mut Vec<Finding>,
) -> (Vec<SketchedBody>, Option<Scene>) {
    let mut findings = Findings::with_unread(unread);
    findings.units = file.units.unwrap_or_default();
    let resolution = Resolution::new(&mut findings, file);
    let scene = resolution.scene(&mut findings);
    found.append(&mut findings.list);
    (resolution.sketch(&mut findings), scene)
}

impl Resolution<'_> {
    fn sketch(&self, findings: &mut Findings) -> Vec<SketchedBody> {
        let (ground, blocks) = (self.ground(findings), self.blocks(findings));
        let grounds = self.file.ground.iter().zip(&ground).enumerate();
        let grounds = grounds.map(|(i, (entry, sound))| {
            let rings = sound.as_ref().map(|g| g.body.polygon.rings().to_vec());
            let name = format!("ground[{i}]");
            self.sketched(BodyId::Ground(i), name, rings, &entry.into())
        });
        let blocks = self.file.blocks.iter().zip(&blocks).enumerate();
        let blocks = blocks.map(|(i, (entry, sound))| {
            let rings = sound.as_ref().map(|b| b.body.polygon.rings().to_vec());
            let id = BodyId::Block(BlockId(i));
            self.sketched(id, self.ids[i].clone(), rings, &entry.into())
        });
        grounds.chain(blocks).filter(|body| !body.rings.is_empty()).collect()
    }

    fn sketched(
        &self,
        id: BodyId,
        name: String,
        sound: Option<Vec<Vec<Point>>>,
        written: &BodyEntry<'_>,
    ) -> SketchedBody {
        let (at, angle) = (written.at.unwrap_or([0.0, 0.0]), written.angle.unwrap_or(0.0));
        let placement = Placement { lattice: self.lattice, at, angle };
        let rings = sound.unwrap_or_else(|| self.raw(written, placement));
        SketchedBody { id, name, rings, placement }
    }

    /// Returns the outline and holes of a body as written, rotated and moved to the body's position. Rings without
    /// corners, or with coordinates that are too large, are left out.
    fn raw(&self, written: &BodyEntry<'_>, placement: Placement) -> Vec<Vec<Point>> {
        let shape = written.shape.and_then(|name| {
            let shapes = &self.file.shapes.0;
            shapes.iter().find(|s| s.0 == name).map(|s| &s.1)
        });
        let polygon = written.polygon.or_else(|| shape.and_then(|s| s.polygon.as_deref()));
        let cells = written.cells.or_else(|| shape.and_then(|s| s.cells.as_deref()));
        let holes = shape.map_or(written.holes, |s| s.holes.as_slice());
        let rings: Vec<Vec<Point>> = match (polygon, cells) {
            (Some(corners), _) => std::iter::once(corners)
                .chain(holes.iter().map(Vec::as_slice))
                .map(|ring| ring.iter().map(|c| Point::new(c[0], c[1])).collect())
                .collect(),
            (None, Some(cells)) => cells.iter().filter_map(|cell| self.cell(*cell)).collect(),
            (None, None) => Vec::new(),
        };
        let placed = rings.into_iter().map(|ring| {
            let corners = ring.into_iter().map(|p| placement.place(p));
            corners.collect::<Vec<Point>>()
        });
        let drawable = |p: &Point| p.x.abs() <= MAX_MAGNITUDE && p.y.abs() <= MAX_MAGNITUDE;
        placed.filter(|ring| !ring.is_empty() && ring.iter().all(drawable)).collect()
    }

    /// Returns the corners of one cell, in the units of the file. `None` if the scene has no lattice or the cell's
    /// coordinates are not allowed.
    fn cell(&self, cell: CellEntry) -> Option<Vec<Point>> {
        let lattice = self.lattice?;
        let (at, shape) = cell_parts(cell);
        let (x, y) = node(&mut Findings::default(), &Trail::Top, at)?;
        let corners = Cell { x, y, shape }.corners();
        let point = |(x, y): (i64, i64)| lattice.point(x as f64, y as f64);
        Some(corners.into_iter().map(point).collect())
    }
}
