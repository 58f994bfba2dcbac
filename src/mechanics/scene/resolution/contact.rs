//! Resolves the listed contacts, and gives each body without an outline a schematic outline.

use super::Resolution;
use crate::geometry::{Bounds, Point, Polygon, Vector, convex_hull, quarter_turn, sin_cos_degrees};
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::name::Names;
use crate::mechanics::scene::number::{at_least_zero, is_sane};
use crate::mechanics::scene::problem;
use crate::mechanics::scene::{Block, BlockId, Body, BodyId, Ground, ListedContact};
use crate::read::Trail;

/// The radius of a schematic disc, and half the width of a schematic support, as a fraction of the diagonal of the
/// rectangle around all centres and contacts.
const SYMBOL_SIZE_SHARE: f64 = 0.03;
/// The number of corners of the schematic disc around a centre.
const DISC_CORNERS: usize = 8;

/// Returns the number of the part of the ground with this id.
pub(super) fn part_named(ground: &[Option<Ground>], id: &str) -> Option<usize> {
    ground.iter().position(|part| part.as_ref().is_some_and(|own| own.id.as_deref() == Some(id)))
}

impl Resolution<'_> {
    /// True if the file lists its contacts, or has a block without an outline. Contacts are then not computed from
    /// outlines, and bodies are not healed.
    pub(super) fn has_schematic_bodies(&self) -> bool {
        !self.file.contacts.is_empty() || self.file.blocks.iter().any(|b| b.centre.is_some() && !b.has_outline())
    }

    /// Returns the contacts listed in the file whose bodies, point and normal are valid. Reports all problems. A
    /// contact with an invalid friction coefficient is reported and gets the friction coefficient of the scene. The name
    /// `ground` stands for the part of the ground that is nearest to the contact.
    pub(super) fn contacts(
        &self,
        findings: &mut Findings,
        blocks: &Names<'_>,
        ground: &[Option<Ground>],
    ) -> Vec<ListedContact> {
        let nearest = |at: [f64; 2]| {
            let at = Point::new(at[0], at[1]);
            let distances =
                ground.iter().map(|part| part.as_ref().map_or(f64::INFINITY, |g| g.body.polygon.distance(at)));
            distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |found| found.0)
        };
        let top = Trail::Top;
        let list = top.key("contacts");
        let mut contacts = Vec::new();
        for (i, entry) in self.file.contacts.iter().enumerate() {
            let at = list.index(i);
            let sound =
                is_sane(findings, &at.key("at"), &entry.at) & is_sane(findings, &at.key("normal"), &[entry.normal]);
            let friction = at_least_zero(findings, &at, "friction", entry.friction);
            let names = at.key("bodies");
            let mut bodies = [0, 1].map(|side| match entry.bodies[side].as_str() {
                "ground" => Some(BodyId::Ground(nearest(entry.at))),
                name => match (blocks.get(name), part_named(ground, name)) {
                    (None, Some(part)) => Some(BodyId::Ground(part)),
                    _ => blocks.find(findings, &names.index(side), name).map(|number| BodyId::Block(BlockId(number))),
                },
            });
            if let [Some(a), Some(b)] = bodies
                && a == b
            {
                findings.add(&names, problem::message::contact_of_one());
                bodies[0] = None;
            }
            let ([Some(a), Some(b)], true) = (bodies, sound) else {
                continue;
            };
            let (sin, cos) = sin_cos_degrees(entry.normal);
            let normal = Vector::new(cos, sin);
            // Put the two bodies in the order that all interfaces have: the later block first, the ground last.
            let (bodies, normal) = if a > b { ([a, b], normal) } else { ([b, a], -normal) };
            contacts.push(ListedContact {
                bodies,
                at: Point::new(entry.at[0], entry.at[1]),
                normal,
                friction: friction.unwrap_or(self.friction),
            });
        }
        contacts
    }

    /// Gives each block without an outline a schematic outline: the convex hull of its contacts and of a small disc
    /// around its centre. If the scene has no ground, adds a small part of the ground at each contact with the ground.
    pub(super) fn add_schematic_outlines(
        &self,
        ground: &mut Vec<Option<Ground>>,
        blocks: &mut [Option<Block>],
        contacts: &mut [ListedContact],
    ) {
        let centres = blocks.iter().flatten().map(|b| b.centroid);
        let points = centres.chain(contacts.iter().map(|c| c.at));
        let extent = Bounds::from_points(points).map_or(0.0, Bounds::diagonal);
        let sign = SYMBOL_SIZE_SHARE * if extent > 0.0 { extent } else { 1.0 };
        for (i, block) in blocks.iter_mut().enumerate() {
            let Some(block) = block.as_mut().filter(|b| b.body.is_schematic) else {
                continue;
            };
            let own = BodyId::Block(BlockId(i));
            let touching = contacts.iter().filter(|c| c.bodies.contains(&own));
            let disc = (0..DISC_CORNERS).map(|k| {
                let (sin, cos) = sin_cos_degrees(360.0 / DISC_CORNERS as f64 * k as f64);
                block.centroid + Vector::new(cos, sin) * sign
            });
            let outline = convex_hull(touching.map(|c| c.at).chain(disc).collect());
            block.body.polygon = Polygon::from_valid_rings(vec![outline]);
        }
        if ground.is_empty() {
            for contact in contacts {
                if let BodyId::Ground(number) = &mut contact.bodies[1] {
                    *number = ground.len();
                    let body = self.support(contact.at, contact.normal, sign);
                    ground.push(Some(Ground { id: None, body }));
                }
            }
        }
    }

    /// Returns a schematic support for a contact with the ground at the point `at`. Seen from the contact, the support
    /// lies in the direction −`normal`. Its width is twice `size`.
    fn support(&self, at: Point, normal: Vector, size: f64) -> Body {
        let along = quarter_turn(normal) * size;
        let back = normal * (-0.8 * size);
        let corners = vec![at - along, at - along + back, at + along + back, at + along];
        self.schematic(corners)
    }

    /// Returns a schematic body, whose outline is the convex hull of `corners`.
    pub(super) fn schematic(&self, corners: Vec<Point>) -> Body {
        Body {
            polygon: Polygon::from_valid_rings(vec![convex_hull(corners)]),
            circle: None,
            cells: None,
            material: None,
            friction: self.friction,
            fill: None,
            gap: 0.0,
            rounding: 0.0,
            is_schematic: true,
        }
    }
}
