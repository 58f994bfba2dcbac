//! Resolves the lists to which the bodies of a file refer: materials, friction pairs and shapes. Also checks the ids of
//! blocks and robots.

use std::collections::BTreeMap;

use super::body::colour;
use super::{MaterialValues, Resolution};
use crate::geometry::LatticeKind;
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::format::SceneFile;
use crate::mechanics::scene::number::at_least_zero;
use crate::mechanics::scene::outline::Outline;
use crate::mechanics::scene::{problem, shape};
use crate::read::Trail;

impl Resolution<'_> {
    /// Returns the outlines of the file's shapes, followed by those of the built-in shapes. An outline is `None` if it
    /// is not valid, or if it is built in and the scene has no triangular lattice.
    pub(super) fn shape_outlines(&self, findings: &mut Findings) -> Vec<Option<Outline>> {
        let top = Trail::Top;
        let list = top.key("shapes");
        let mut outlines = Vec::new();
        for (name, entry) in &self.file.shapes.0 {
            let at = list.key(name);
            if shape::BUILT_IN.contains(&name.as_str()) {
                findings.add_key(&at, problem::name::built_in_shape(name));
            }
            outlines.push(match (&entry.polygon, &entry.cells) {
                (Some(_), Some(_)) => {
                    findings.add(&at, problem::outline::two_outlines("polygon", "cells"));
                    None
                }
                (None, None) => {
                    findings.add(&at, problem::outline::no_shape_outline());
                    None
                }
                (polygon, cells) => self.outline(findings, &at, polygon.as_deref(), &entry.holes, cells.as_deref()),
            });
        }
        for name in shape::BUILT_IN {
            let triangular = self.lattice.is_some_and(|l| l.kind == LatticeKind::Triangular);
            outlines.push(shape::cells(name).filter(|_| triangular).map(Outline::Cells));
        }
        outlines
    }

    /// Returns the friction coefficients that the file gives for pairs of materials. Each pair contains the indices of
    /// the two materials.
    pub(super) fn friction_pairs(&self, findings: &mut Findings) -> Vec<([usize; 2], f64)> {
        let top = Trail::Top;
        let list = top.key("friction_pairs");
        let mut pairs = Vec::new();
        let mut seen: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for (i, entry) in self.file.friction_pairs.iter().enumerate() {
            let at = list.index(i);
            let between = at.key("between");
            let friction = at_least_zero(findings, &at, "friction", Some(entry.friction));
            let a = self.materials.find(findings, &between.index(0), &entry.between[0]);
            let b = self.materials.find(findings, &between.index(1), &entry.between[1]);
            let (Some(a), Some(b)) = (a, b) else { continue };
            let pair = [a.min(b), a.max(b)];
            if let Some(first) = seen.get(&pair) {
                findings.add(&between, problem::name::pair_twice(&entry.between, *first));
                continue;
            }
            seen.insert(pair, i);
            pairs.extend(friction.map(|friction| (pair, friction)));
        }
        pairs
    }

    /// Reports ids of blocks and robots that are used twice, empty or reserved.
    pub(super) fn check_ids(&self, findings: &mut Findings) {
        let top = Trail::Top;
        let given = self.file.blocks.iter().map(|b| b.id.is_some());
        ids(findings, &top.key("blocks"), "block", &self.ids, given);
        let given = self.file.robots.iter().map(|r| r.id.is_some());
        ids(findings, &top.key("robots"), "robot", &self.robot_ids, given);
    }
}

/// Returns the density, friction coefficient and colour that each material gives. Reports invalid values.
pub(super) fn material_values(findings: &mut Findings, file: &SceneFile) -> Vec<MaterialValues> {
    let top = Trail::Top;
    let list = top.key("materials");
    let mut values = Vec::new();
    for (name, entry) in &file.materials.0 {
        let at = list.key(name);
        values.push(MaterialValues {
            density: at_least_zero(findings, &at, "density", entry.density),
            friction: at_least_zero(findings, &at, "friction", entry.friction),
            fill: entry.fill.as_deref().and_then(|f| colour(findings, &at.key("fill"), f)),
        });
    }
    values
}

/// Reports ids in a list of the file that are used twice, empty or reserved. `given` contains, for each id, whether the
/// file gives it; the other ids are defaults.
fn ids(findings: &mut Findings, list: &Trail<'_>, sort: &str, ids: &[String], given: impl Iterator<Item = bool>) {
    let mut first: BTreeMap<&str, usize> = BTreeMap::new();
    for (i, (id, given)) in ids.iter().zip(given).enumerate() {
        let entry = list.index(i);
        let inner = entry.key("id");
        let at = if given { &inner } else { &entry };
        if id.is_empty() {
            findings.add(at, problem::name::empty_id(sort));
        } else if sort == "block" && id == "ground" {
            findings.add(at, problem::name::reserved_id());
        }
        if let Some(first) = first.get(id.as_str()) {
            findings.add(at, problem::name::id_twice(sort, id, &list.index(*first).path().to_string()));
        } else {
            first.insert(id, i);
        }
    }
}
