//! Resolves the lists of a file besides its bodies: materials, friction pairs, shapes and robots. Also checks the
//! ids of blocks and robots.

use std::collections::BTreeMap;

use super::body::colour;
use super::contact::part_named;
use super::{MaterialValues, Resolution};
use crate::geometry::{LatticeKind, Point};
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::format::{LimitsEntry, SceneFile};
use crate::mechanics::scene::name::Names;
use crate::mechanics::scene::number::{at_least_zero, is_sane};
use crate::mechanics::scene::outline::Outline;
use crate::mechanics::scene::{BlockId, BodyId, Grip, Ground, JointBody, JointSet, Limits, Robot, problem, shape};
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
                findings.add_key(&at, problem::message::built_in_shape(name));
            }
            let (polygon, cells, circle) = (entry.polygon.as_deref(), entry.cells.as_deref(), entry.circle.as_ref());
            let given = [("polygon", polygon.is_some()), ("cells", cells.is_some()), ("circle", circle.is_some())];
            let mut given = given.iter().filter(|given| given.1).map(|given| given.0);
            outlines.push(match (given.next(), given.next()) {
                (Some(first), Some(second)) => {
                    findings.add(&at, problem::outline::two_outlines(first, second));
                    None
                }
                (None, _) => {
                    findings.add(&at, problem::outline::no_shape_outline());
                    None
                }
                _ => self.outline(findings, &at, polygon, &entry.holes, cells, circle),
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
                findings.add(&between, problem::message::pair_twice(&entry.between, *first));
                continue;
            }
            seen.insert(pair, i);
            pairs.extend(friction.map(|friction| (pair, friction)));
        }
        pairs.sort_unstable_by_key(|(pair, _)| *pair);
        pairs
    }

    /// Returns the sets of joints. `blocks` are the names of the blocks.
    pub(super) fn joint_sets(
        &self,
        findings: &mut Findings,
        blocks: &Names<'_>,
        ground: &[Option<Ground>],
    ) -> Vec<JointSet> {
        let top = Trail::Top;
        let given: Vec<String> = self.file.joint_sets.iter().map(|set| set.id.clone()).collect();
        ids(findings, &top.key("joint_sets"), "joint set", &given, given.iter().map(|_| true));
        let hidden = findings.unread.hides_names("joint_sets", given.len());
        let names = Names::new("joint set", given.iter().map(String::as_str).collect(), hidden);
        let on = top.key("friction_factor_on");
        let wanted = self.file.friction_factor_on.iter().enumerate();
        let factored: Vec<usize> =
            wanted.filter_map(|(place, name)| names.find(findings, &on.index(place), name)).collect();
        let list = top.key("joint_sets");
        let mut sets = Vec::new();
        for (number, entry) in self.file.joint_sets.iter().enumerate() {
            let at = list.index(number);
            let mut set = JointSet {
                id: entry.id.clone(),
                direction: entry.direction,
                bodies: None,
                materials: None,
                friction: at_least_zero(findings, &at, "friction", entry.friction),
                is_factored: factored.contains(&number),
            };
            if let Some(given) = &entry.bodies {
                let at = at.key("bodies");
                let mut found =
                    given.iter().enumerate().map(|(side, name)| match (name.as_str(), part_named(ground, name)) {
                        ("ground", _) => Some(JointBody::AnyGround),
                        (_, Some(part)) if blocks.get(name).is_none() => Some(JointBody::Is(BodyId::Ground(part))),
                        _ => {
                            let block = blocks.find(findings, &at.index(side), name)?;
                            Some(JointBody::Is(BodyId::Block(BlockId(block))))
                        }
                    });
                set.bodies = found.next().flatten().zip(found.next().flatten());
            }
            if let Some([a, b]) = &entry.materials {
                let at = at.key("materials");
                let a = self.materials.find(findings, &at.index(0), a);
                set.materials = a.zip(self.materials.find(findings, &at.index(1), b));
            }
            sets.push(set);
        }
        sets
    }

    /// Reports ids of blocks, robots, loads and cases that are used twice, empty or reserved.
    pub(super) fn check_ids(&self, findings: &mut Findings) {
        let top = Trail::Top;
        let given = self.file.blocks.iter().map(|b| b.id.is_some());
        ids(findings, &top.key("blocks"), "block", &self.ids, given);
        let given = self.file.robots.iter().map(|r| r.id.is_some());
        ids(findings, &top.key("robots"), "robot", &self.robot_ids, given);
        let given = self.file.loads.iter().map(|l| l.id.is_some());
        ids(findings, &top.key("loads"), "load", &self.load_ids, given);
        let cases: Vec<String> = self.file.cases.iter().map(|case| case.id.clone()).collect();
        ids(findings, &top.key("cases"), "case", &cases, cases.iter().map(|_| true));
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
            findings.add(at, problem::message::empty_id(sort));
        } else if sort == "block" && id == "ground" {
            findings.add(at, problem::message::reserved_id(sort));
        }
        if let Some(first) = first.get(id.as_str()) {
            findings.add(at, problem::message::id_twice(sort, id, &list.index(*first).path().to_string()));
        } else {
            first.insert(id, i);
        }
    }
}

impl Resolution<'_> {
    pub(super) fn robots(&self, findings: &mut Findings, blocks: &Names<'_>, centroids: &[Point]) -> Vec<Robot> {
        let top = Trail::Top;
        let list = top.key("robots");
        let mut robots = Vec::new();
        for (i, entry) in self.file.robots.iter().enumerate() {
            let at = list.index(i);
            let block = entry.holds.as_ref().and_then(|b| blocks.find(findings, &at.key("holds"), b)).map(BlockId);
            if let Some(point) = entry.at {
                is_sane(findings, &at.key("at"), &point);
            }
            let given = entry.at.map(|p| Point::new(p[0], p[1]));
            robots.push(Robot {
                id: self.robot_ids[i].clone(),
                limits: limits(findings, &at.key("limits"), entry.limits.as_ref()),
                holds: block.map(|block| Grip::new(block, given, centroids[block.0])),
            });
        }
        robots
    }
}

fn limits(findings: &mut Findings, at: &Trail<'_>, entry: Option<&LimitsEntry>) -> Limits {
    let Some(entry) = entry else {
        return Limits::default();
    };
    let force = at_least_zero(findings, at, "force", entry.force);
    Limits {
        fx: at_least_zero(findings, at, "fx", entry.fx).or(force).unwrap_or(f64::INFINITY),
        fy: at_least_zero(findings, at, "fy", entry.fy).or(force).unwrap_or(f64::INFINITY),
        torque: at_least_zero(findings, at, "torque", entry.torque).unwrap_or(0.0),
    }
}
