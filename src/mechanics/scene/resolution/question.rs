//! Resolves the questions of a file: the movements of parts of the ground, and a vehicle.

use std::collections::BTreeMap;

use super::Resolution;
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::name::Names;
use crate::mechanics::scene::number::{at_least_zero, is_amount, is_sane};
use crate::mechanics::scene::{Axle, BlockId, Ground, Movement, Vehicle, problem};
use crate::read::Trail;

impl Resolution<'_> {
    /// Reports ids of parts of the ground that are empty, reserved, or also the id of a block or of another part.
    pub(super) fn check_ground_ids(&self, findings: &mut Findings) {
        let top = Trail::Top;
        let (blocks, list) = (top.key("blocks"), top.key("ground"));
        let given = || self.file.ground.iter().enumerate().filter_map(|(i, part)| Some((i, part.id.as_deref()?)));
        if given().next().is_none() {
            return;
        }
        let mut first: BTreeMap<&str, Trail<'_>> = BTreeMap::new();
        for (i, id) in self.ids.iter().enumerate() {
            first.entry(id).or_insert(blocks.index(i));
        }
        for (i, id) in given() {
            let entry = list.index(i);
            let at = entry.key("id");
            match (id, first.get(id)) {
                ("", _) => findings.add(&at, problem::message::empty_id("part of the ground")),
                ("ground", _) => findings.add(&at, problem::message::reserved_id("part of the ground")),
                (id, Some(other)) => {
                    findings.add(&at, problem::message::id_twice("body", id, &other.path().to_string()));
                }
                (id, None) => {
                    first.insert(id, list.index(i));
                }
            }
        }
    }

    pub(super) fn movements(&self, findings: &mut Findings, ground: &[Option<Ground>]) -> Vec<Movement> {
        if self.file.movements.is_empty() {
            return Vec::new();
        }
        let top = Trail::Top;
        let list = top.key("movements");
        let parts = self.file.ground.iter().enumerate();
        let (numbers, ids): (Vec<usize>, Vec<&str>) = parts.filter_map(|(i, g)| Some((i, g.id.as_deref()?))).unzip();
        let names = Names::new("ground id", ids, findings.unread.hides_names("ground", self.file.ground.len()));
        let mut movements = Vec::new();
        for (i, entry) in self.file.movements.iter().enumerate() {
            let at = list.index(i);
            let [x, y] = entry.translation.unwrap_or([0.0, 0.0]);
            let degrees = entry.rotation.unwrap_or(0.0);
            let sound = is_amount(findings, &at.key("translation"), &[x, y])
                & is_amount(findings, &at.key("rotation"), &[degrees])
                & entry.about.is_none_or(|about| is_sane(findings, &at.key("about"), &about));
            if sound && [x, y, degrees] == [0.0; 3] {
                findings.add(&at, problem::message::no_movement());
            }
            let number = names.find(findings, &at.key("ground"), &entry.ground).map(|found| numbers[found]);
            let Some((number, part)) = number.and_then(|n| Some((n, ground.get(n)?.as_ref()?))) else { continue };
            movements.push(Movement {
                ground: number,
                translation: Vector::new(x, y),
                rotation: degrees.to_radians(),
                about: entry.about.map_or_else(|| part.body.polygon.centroid(), |[x, y]| Point::new(x, y)),
            });
        }
        movements
    }

    pub(super) fn vehicle(&self, findings: &mut Findings, blocks: &Names<'_>) -> Option<Vehicle> {
        let entry = self.file.vehicle.as_ref()?;
        let top = Trail::Top;
        let at = top.key("vehicle");
        let list = at.key("axles");
        if entry.axles.is_empty() {
            findings.add(&list, problem::message::no_axles());
        }
        let mut axles = Vec::new();
        for (i, axle) in entry.axles.iter().enumerate() {
            let inner = list.index(i);
            let weight = at_least_zero(findings, &inner, "weight", Some(axle.weight)).unwrap_or(0.0);
            let offset = axle.offset.unwrap_or(0.0);
            is_sane(findings, &inner.key("offset"), &[offset]);
            axles.push(Axle { weight, offset });
        }
        let names = at.key("over");
        let over = entry.over.iter().enumerate();
        let over = over.filter_map(|(i, name)| blocks.find(findings, &names.index(i), name).map(BlockId)).collect();
        let step = at_least_zero(findings, &at, "step", entry.step).unwrap_or(0.0);
        Some(Vehicle { axles, over, step, both_ways: entry.both_ways.unwrap_or(true) })
    }
}
