//! [`Fills`]: the colours of blocks, which tell the amplitudes that normalised arrows hide.
//!
//! A block's amplitude is the larger of its weight and the largest normal force of one of its interfaces; it is told as
//! a share of the smallest force limit of all robots. A held block tells how far its robot is used instead:
//! max(|Fx|/limit, |Fy|/limit). Where no robot has a limit, amplitudes are shares of the largest in the figure, and the
//! key says so.

use crate::analysis::{Analysis, FrameAnalysis};
use crate::scene::{BlockId, BodyId, Frame, Scene};

/// What a full share stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FillScale {
    /// The smallest force limit of all robots, N.
    Limit(f64),
    /// The largest amplitude in the figure, N.
    Largest(f64),
}

/// Shares of all blocks in all frames.
#[derive(Clone, Debug)]
pub(crate) struct Fills {
    /// What a share of 1 stands for.
    pub scale: FillScale,
    /// For each frame the shares of its placed blocks, in placing order.
    pub shares: Vec<Vec<f64>>,
}

impl Fills {
    /// The shares of every frame.
    pub fn of(analysis: &Analysis<'_>) -> Fills {
        let scene = analysis.scene;
        let frames = || scene.frames.iter().zip(&analysis.frames);
        let amplitudes: Vec<Vec<f64>> = frames()
            .map(|(frame, found)| amplitudes(scene, frame, found))
            .collect();
        let limit = scene
            .robots
            .iter()
            .flat_map(|r| [r.limits.fx, r.limits.fy])
            .fold(f64::INFINITY, f64::min);
        if !limit.is_finite() {
            let largest = amplitudes.iter().flatten().copied().fold(0.0, f64::max);
            let share = |a: &f64| if largest > 0.0 { a / largest } else { 0.0 };
            let shares = amplitudes
                .iter()
                .map(|frame| frame.iter().map(share).collect())
                .collect();
            return Fills {
                scale: FillScale::Largest(largest),
                shares,
            };
        }
        let shares = frames()
            .zip(amplitudes)
            .map(|((frame, found), amplitudes)| {
                let of_block = |(block, amplitude): (&BlockId, f64)| {
                    held(scene, found, *block).unwrap_or_else(|| share(amplitude, limit))
                };
                frame.placed.iter().zip(amplitudes).map(of_block).collect()
            })
            .collect();
        Fills {
            scale: FillScale::Limit(limit),
            shares,
        }
    }

    /// Whether the colours differ enough that a key to them says something.
    pub fn vary(&self) -> bool {
        let all = || self.shares.iter().flatten().copied();
        let (least, most) = (
            all().fold(f64::INFINITY, f64::min),
            all().fold(0.0, f64::max),
        );
        most - least > 0.02 || most > 0.08
    }
}

/// A share of a limit; all of it where the limit is 0 and something is asked of it.
fn share(amount: f64, limit: f64) -> f64 {
    if limit > 0.0 {
        amount / limit
    } else if amount > 0.0 {
        1.0
    } else {
        0.0
    }
}

/// How far the robot that holds a block is used; `None` for a block nobody holds and a robot without limits.
fn held(scene: &Scene, found: &FrameAnalysis, block: BlockId) -> Option<f64> {
    let robot = found.robots.iter().find(|r| r.block == block)?;
    let limits = scene.robots[robot.robot.0].limits;
    if !limits.fx.is_finite() && !limits.fy.is_finite() {
        return None;
    }
    Some(share(robot.force.x.abs(), limits.fx).max(share(robot.force.y.abs(), limits.fy)))
}

fn amplitudes(scene: &Scene, frame: &Frame, found: &FrameAnalysis) -> Vec<f64> {
    let mut largest = vec![0.0_f64; scene.blocks.len()];
    for contact in &found.contacts {
        let normal: f64 = contact.normal_forces.iter().sum();
        for body in contact.interface.bodies {
            if let BodyId::Block(block) = body {
                largest[block.0] = largest[block.0].max(normal);
            }
        }
    }
    frame
        .placed
        .iter()
        .map(|block| largest[block.0].max(scene.blocks[block.0].weight))
        .collect()
}
