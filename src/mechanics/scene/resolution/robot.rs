//! Resolves robots and loads: checks their numbers and finds the blocks to which they refer.

use super::Resolution;
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::finding::Findings;
use crate::mechanics::scene::format::LimitsEntry;
use crate::mechanics::scene::name::Names;
use crate::mechanics::scene::number::{at_least_zero, is_amount, is_sane};
use crate::mechanics::scene::{BlockId, Grip, Limits, Load, Robot};
use crate::read::Trail;

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
            let grip = |block: BlockId| entry.at.map_or(centroids[block.0], |p| Point::new(p[0], p[1]));
            robots.push(Robot {
                id: self.robot_ids[i].clone(),
                limits: limits(findings, &at.key("limits"), entry.limits.as_ref()),
                holds: block.map(|block| Grip { block, at: grip(block) }),
            });
        }
        robots
    }

    pub(super) fn loads(&self, findings: &mut Findings, blocks: &Names<'_>, centroids: &[Point]) -> Vec<Load> {
        let top = Trail::Top;
        let list = top.key("loads");
        let mut loads = Vec::new();
        for (i, entry) in self.file.loads.iter().enumerate() {
            let at = list.index(i);
            let force = entry.force.unwrap_or([0.0, 0.0]);
            let torque = entry.torque.unwrap_or(0.0);
            is_amount(findings, &at.key("force"), &force);
            is_amount(findings, &at.key("torque"), &[torque]);
            if let Some(point) = entry.at {
                is_sane(findings, &at.key("at"), &point);
            }
            let Some(block) = blocks.find(findings, &at.key("block"), &entry.block).map(BlockId) else {
                continue;
            };
            let point = entry.at.map_or(centroids[block.0], |p| Point::new(p[0], p[1]));
            loads.push(Load {
                block,
                force: Vector::new(force[0], force[1]),
                at: point,
                torque,
                at_centroid: entry.at.is_none(),
            });
        }
        loads
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
