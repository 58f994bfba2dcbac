//! Resolves blocks and parts of the ground: their outlines, positions and weights.

use super::Resolution;
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::format::{self, Pair};
use crate::mechanics::scene::number::{MAX_MAGNITUDE, at_least_zero, is_sane};
use crate::mechanics::scene::outline::{self, Outline};
use crate::mechanics::scene::problem;
use crate::mechanics::scene::{Block, Body, Ground, Rgb};
use crate::read::Trail;

/// The keys that blocks and ground share.
pub(super) struct BodyEntry<'f> {
    pub(super) polygon: Option<&'f [Pair]>,
    pub(super) holes: &'f [Vec<Pair>],
    pub(super) cells: Option<&'f [format::CellEntry]>,
    circle: Option<&'f format::CircleEntry>,
    pub(super) shape: Option<&'f str>,
    pub(super) at: Option<Pair>,
    pub(super) angle: Option<f64>,
    material: Option<&'f str>,
    friction: Option<f64>,
    fill: Option<&'f str>,
}

macro_rules! from_entries {
    ($($entry:ident)*) => {
        $(
            impl<'f> From<&'f format::$entry> for BodyEntry<'f> {
                fn from(entry: &'f format::$entry) -> BodyEntry<'f> {
                    BodyEntry {
                        polygon: entry.polygon.as_deref(),
                        holes: &entry.holes,
                        cells: entry.cells.as_deref(),
                        circle: entry.circle.as_ref(),
                        shape: entry.shape.as_deref(),
                        at: entry.at,
                        angle: entry.angle,
                        material: entry.material.as_deref(),
                        friction: entry.friction,
                        fill: entry.fill.as_deref(),
                    }
                }
            }
        )*
    };
}

from_entries! { BlockEntry GroundEntry }

impl Resolution<'_> {
    pub(super) fn outline(
        &self,
        findings: &mut Findings,
        at: &Trail<'_>,
        polygon: Option<&[Pair]>,
        holes: &[Vec<Pair>],
        cells: Option<&[format::CellEntry]>,
        circle: Option<&format::CircleEntry>,
    ) -> Option<Outline> {
        if polygon.is_none() && !holes.is_empty() {
            findings.add(&at.key("holes"), problem::outline::holes_alone());
            return None;
        }
        if findings.is_unread(at) {
            return None;
        }
        match (polygon, cells, circle) {
            (Some(corners), ..) => outline::polygon(findings, at, corners, holes),
            (None, Some(entries), _) if self.grid_known => outline::cells(findings, at, self.lattice, entries),
            (None, None, Some(entry)) => outline::circle(findings, at, entry),
            _ => None,
        }
    }

    fn body(&self, findings: &mut Findings, at: &Trail<'_>, entry: &BodyEntry<'_>) -> Option<Body> {
        let material = entry.material.and_then(|m| self.materials.find(findings, &at.key("material"), m));
        let values = material.map(|m| self.material_entries[m]);
        let friction = at_least_zero(findings, at, "friction", entry.friction);
        let fill = entry.fill.and_then(|f| colour(findings, &at.key("fill"), f));
        let angle = entry.angle.unwrap_or(0.0);
        let place = entry.at.unwrap_or([0.0, 0.0]);
        let sound = is_sane(findings, &at.key("angle"), &[angle]) & is_sane(findings, &at.key("at"), &place);
        let given = [
            ("polygon", entry.polygon.is_some()),
            ("cells", entry.cells.is_some()),
            ("circle", entry.circle.is_some()),
            ("shape", entry.shape.is_some()),
        ];
        let mut given = given.iter().filter(|g| g.1).map(|g| g.0);
        let outline = match (given.next(), given.next()) {
            (None, _) => {
                findings.add(at, problem::outline::no_outline());
                None
            }
            (Some(first), Some(second)) => {
                findings.add(at, problem::outline::two_outlines(first, second));
                None
            }
            (Some("shape"), None) => {
                if !entry.holes.is_empty() {
                    findings.add(&at.key("holes"), problem::outline::holes_alone());
                }
                self.shape(findings, &at.key("shape"), entry.shape.unwrap_or("")).cloned()
            }
            (Some(_), None) => self.outline(findings, at, entry.polygon, entry.holes, entry.cells, entry.circle),
        };
        if !sound || !self.grid_known || findings.is_unread(at) {
            return None;
        }
        let outline::Placed { polygon, cells, circle } =
            outline::placed(findings, at, self.lattice, outline?, place, angle)?;
        Some(Body {
            polygon,
            circle,
            cells,
            material,
            friction: friction.or(values.and_then(|v| v.friction)).unwrap_or(self.friction),
            fill: fill.or(values.and_then(|v| v.fill)),
            gap: 0.0,
            rounding: 0.0,
            is_schematic: false,
        })
    }

    fn shape(&self, findings: &mut Findings, at: &Trail<'_>, name: &str) -> Option<&Outline> {
        let number = self.shapes.find(findings, at, name)?;
        let outline = self.outlines[number].as_ref();
        if outline.is_none() && number >= self.file.shapes.0.len() && self.grid_known {
            findings.add(at, problem::outline::shape_without_grid(name));
        }
        outline
    }

    pub(super) fn ground(&self, findings: &mut Findings) -> Vec<Option<Ground>> {
        let top = Trail::Top;
        let list = top.key("ground");
        (self.file.ground.iter().enumerate())
            .map(|(i, entry)| {
                Some(Ground { id: entry.id.clone(), body: self.body(findings, &list.index(i), &entry.into())? })
            })
            .collect()
    }

    pub(super) fn blocks(&self, findings: &mut Findings) -> Vec<Option<Block>> {
        let top = Trail::Top;
        let list = top.key("blocks");
        (self.file.blocks.iter().enumerate()).map(|(i, entry)| self.block(findings, &list.index(i), entry, i)).collect()
    }

    fn block(&self, findings: &mut Findings, at: &Trail<'_>, entry: &format::BlockEntry, i: usize) -> Option<Block> {
        let weight = at_least_zero(findings, at, "weight", entry.weight);
        let mass = at_least_zero(findings, at, "mass", entry.mass);
        let density = at_least_zero(findings, at, "density", entry.density);
        let placement = at_least_zero(findings, at, "placement", entry.placement).unwrap_or(1.0);
        if let Some(centre) = entry.centre.filter(|_| !entry.has_outline()) {
            let newtons = weight.map(|w| w * self.units.force().size);
            let weight = newtons.or(mass.map(|mass| mass * self.gravity.norm()));
            let block = self.schematic_block(findings, at, entry, i, centre, weight)?;
            return Some(Block { placement, mass: mass.filter(|_| entry.weight.is_none()), ..block });
        }
        let centre = entry.centre.filter(|centre| is_sane(findings, &at.key("centre"), centre));
        let body = self.body(findings, at, &entry.into())?;
        let area = match (&body.cells, self.lattice) {
            (Some(cells), Some(lattice)) => cells.len() as f64 * lattice.cell_area(),
            _ => body.area(),
        };
        let density =
            density.or_else(|| body.material.and_then(|m| self.material_entries[m].density)).unwrap_or(self.density);
        let weighs_by_area = weight.is_none() && mass.is_none();
        // Compute the weight in newtons. The given weight, the area and the thickness are in the units of the file.
        let [length, force] = [self.units.length().size, self.units.force().size];
        let volume = || area * self.thickness * (length * length * length);
        let weight = match weight {
            Some(weight) => weight * force,
            None => mass.unwrap_or_else(|| density * volume()) * self.gravity.norm(),
        };
        if !weight.is_finite() || weight > MAX_MAGNITUDE {
            findings.add(at, problem::message::too_heavy(weight, MAX_MAGNITUDE));
            return None;
        }
        let own_centre = centre.map(|centre| {
            let place = entry.at.unwrap_or([0.0, 0.0]);
            outline::placed_point(self.lattice, centre, place, entry.angle.unwrap_or(0.0))
        });
        Some(Block {
            id: self.ids[i].clone(),
            centroid: own_centre.unwrap_or_else(|| body.centroid()),
            has_own_centre: own_centre.is_some(),
            body,
            weight,
            placement,
            weighs_by_area,
            mass: mass.filter(|_| entry.weight.is_none()),
        })
    }
}

impl Resolution<'_> {
    /// Creates a block from an entry that gives its centre instead of an outline. `weight` is in newtons. Returns
    /// `None` if the block is not valid.
    fn schematic_block(
        &self,
        findings: &mut Findings,
        at: &Trail<'_>,
        entry: &format::BlockEntry,
        i: usize,
        centre: Pair,
        weight: Option<f64>,
    ) -> Option<Block> {
        let others = [("at", entry.at.is_some()), ("angle", entry.angle.is_some())];
        let other = others.iter().find(|other| other.1);
        if let Some((other, _)) = other {
            findings.add(at, problem::outline::two_outlines("centre", other));
        }
        if weight.is_none() && entry.weight.is_none() && entry.mass.is_none() {
            findings.add(at, problem::outline::centre_without_mass());
        }
        let material = entry.material.as_deref();
        let material = material.and_then(|m| self.materials.find(findings, &at.key("material"), m));
        let fill = entry.fill.as_deref();
        let fill = fill.and_then(|f| colour(findings, &at.key("fill"), f));
        let is_sound = is_sane(findings, &at.key("centre"), &centre);
        let weight = weight.filter(|_| is_sound && other.is_none())?;
        if !weight.is_finite() || weight > MAX_MAGNITUDE {
            findings.add(at, problem::message::too_heavy(weight, MAX_MAGNITUDE));
            return None;
        }
        let centroid = Point::new(centre[0], centre[1]);
        let beside = [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)].map(|v| centroid + v);
        let values = material.map(|m| self.material_entries[m]);
        Some(Block {
            id: self.ids[i].clone(),
            centroid,
            body: Body {
                material,
                fill: fill.or(values.and_then(|v| v.fill)),
                // This outline is a placeholder. `add_schematic_outlines` replaces it when the contacts are known.
                ..self.schematic([vec![centroid], beside.to_vec()].concat())
            },
            has_own_centre: true,
            weight,
            placement: 1.0,
            weighs_by_area: false,
            mass: None,
        })
    }
}

/// Parses a colour `#rrggbb` or `#rgb`. Reports other text and returns `None`.
pub(super) fn colour(findings: &mut Findings, at: &Trail<'_>, text: &str) -> Option<Rgb> {
    let digits: Option<Vec<u8>> = text
        .strip_prefix('#')
        .and_then(|hex| hex.chars().map(|c| c.to_digit(16).and_then(|d| u8::try_from(d).ok())).collect());
    match digits.as_deref() {
        Some([r, g, b]) => Some(Rgb([r * 17, g * 17, b * 17])),
        Some([a, b, c, d, e, f]) => Some(Rgb([a * 16 + b, c * 16 + d, e * 16 + f])),
        _ => {
            findings.add(at, problem::message::colour(text));
            None
        }
    }
}
