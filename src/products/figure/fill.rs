//! [`Fills`]: the colours of blocks, and the quantity that these colours show.
//!
//! The user [chooses](Fill) amplitudes, or none. The amplitude of a block is the larger of its weight and its largest
//! normal force. The legend names the quantity, which is the same for all blocks. Only the
//! rule of the thesis has two quantities. A block that a robot holds shows the used fraction of the robot's force
//! limits. Any other block shows its amplitude as a fraction of the smallest force limit of all robots. If no robot has
//! a force limit, every block shows its amplitude as a fraction of the largest amplitude.

use super::option::Fill;
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, SolvedFrame};
use crate::mechanics::scene::BlockId;
use crate::mechanics::scene::format::UnitsEntry;
use crate::pictures::drawing::{Colour, PLASMA, Theme};
use crate::products::wording::number::quantity;

/// The quantity that colours show, and its value at the end of the colour scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FillScale {
    /// The smallest force limit of all robots, N.
    Limit(f64),
    /// The largest amplitude in the figure, N.
    Largest(f64),
    /// No quantity: blocks have one plain colour.
    Plain,
}

/// The position on the colour scale of each block in each frame. A position is called a share. It is from 0 to 1; with
/// the rule of the thesis it may exceed 1, and the block then has the last colour.
#[derive(Clone, Debug)]
pub(crate) struct Fills {
    /// The quantity that colours show, and its value at the end of the colour scale.
    pub scale: FillScale,
    /// For each frame, the shares of its placed blocks, in placing order.
    pub shares: Vec<Vec<f64>>,
    rule: Fill,
    units: UnitsEntry,
}

impl Fills {
    /// Computes the share of each block in all frames: the position of its colour on the colour scale. `rule` selects
    /// the quantity that colours show.
    pub fn new(analysis: &Analysis, rule: Fill) -> Fills {
        let each = |amount: fn(SolvedFrame<'_>) -> Vec<f64>| -> Vec<Vec<f64>> { analysis.each().map(amount).collect() };
        let (scale, shares) = match rule {
            Fill::Amplitude => to_largest(each(amplitudes), FillScale::Largest),
            Fill::None | Fill::Stress | Fill::Friction => {
                (FillScale::Plain, each(|solved| vec![0.0; solved.frame().placed.len()]))
            }
            Fill::Source => source(analysis, each(amplitudes)),
        };
        Fills { scale, shares, rule, units: analysis.given().units }
    }

    /// Returns the colour of each placed block of a frame, in placing order, and its meaning in words.
    pub fn of(&self, frame: usize, theme: &Theme) -> Vec<(Colour, String)> {
        let plain = self.scale == FillScale::Plain;
        let colour = |share: f64| if plain { theme.block } else { self.colour(theme, share) };
        self.shares[frame].iter().map(|share| (colour(*share), self.description(*share))).collect()
    }

    /// True if the figure needs a legend of colours: colours show a quantity, and the shares differ or are not all near
    /// 0.
    pub fn vary(&self) -> bool {
        let all = || self.shares.iter().flatten().copied();
        let (least, most) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
        self.scale != FillScale::Plain && (most - least > 0.02 || most > 0.08)
    }

    /// Returns the colour at the position `share` (0 to 1) of the colour scale.
    pub fn colour(&self, theme: &Theme, share: f64) -> Colour {
        ramp(self.rule)(theme, share)
    }

    /// Returns the texts of the legend: the smallest and the largest value of the colour scale, and the name of the
    /// quantity.
    pub fn key(&self) -> ([String; 2], String) {
        let ends = |most: String| ["0".to_owned(), most];
        match self.scale {
            FillScale::Limit(limit) => {
                let limit = quantity(limit, self.units.force());
                let what = format!("of the robots' limit of {limit}, by the rule of the thesis");
                (ends("100 %".into()), what)
            }
            FillScale::Largest(largest) => {
                (ends(quantity(largest, self.units.force())), "weight or largest normal force".into())
            }
            FillScale::Plain => (ends(String::new()), String::new()),
        }
    }

    /// Describes the value that the colour of a block shows, such as `colour: 12 N`. `share` is the position of the
    /// colour on the scale, from 0 to 1. Empty if colours show no quantity.
    pub fn description(&self, share: f64) -> String {
        match self.scale {
            FillScale::Limit(limit) => format!(
                "colour: {:.1} % of the robots' limit of {}",
                100.0 * share,
                quantity(limit, self.units.force())
            ),
            FillScale::Largest(largest) => {
                format!("colour: {}", quantity(share * largest, self.units.force()))
            }
            FillScale::Plain => String::new(),
        }
    }
}

fn ramp(rule: Fill) -> fn(&Theme, f64) -> Colour {
    match rule {
        Fill::Source => |_, share| {
            // The conversion with `as` maps negative numbers and NaN to 0.
            let entry = ((share * PLASMA.len() as f64) as usize).min(PLASMA.len() - 1);
            Colour::hex(PLASMA[entry])
        },
        _ => Theme::amplitude,
    }
}

/// Returns the colour scale, and all amounts divided by the largest amount. `scale` makes the colour scale from the
/// largest amount. All amounts have the same unit.
fn to_largest(amounts: Vec<Vec<f64>>, scale: impl Fn(f64) -> FillScale) -> (FillScale, Vec<Vec<f64>>) {
    let largest = amounts.iter().flatten().copied().fold(0.0, f64::max);
    let share = |a: f64| if largest > 0.0 { a / largest } else { 0.0 };
    let frame = |frame: Vec<f64>| frame.into_iter().map(share).collect();
    (scale(largest), amounts.into_iter().map(frame).collect())
}

/// Computes the shares by the rule of the thesis, which the documentation of this module describes. `amplitudes` are
/// those of the placed blocks of each frame, N. Returns the colour scale, and the share of each block.
fn source(analysis: &Analysis, amplitudes: Vec<Vec<f64>>) -> (FillScale, Vec<Vec<f64>>) {
    let scene = analysis.given();
    let limits = scene.robots.iter().flat_map(|r| [r.limits.fx, r.limits.fy]);
    let limit = limits.fold(f64::INFINITY, f64::min);
    if !limit.is_finite() {
        return to_largest(amplitudes, FillScale::Largest);
    }
    let shares = analysis
        .each()
        .zip(amplitudes)
        .map(|(solved, amplitudes)| {
            let of_block = |(block, amplitude): (&BlockId, f64)| {
                robot_limit_used(solved, *block).unwrap_or_else(|| share(amplitude, limit))
            };
            solved.frame().placed.iter().zip(amplitudes).map(of_block).collect()
        })
        .collect();
    (FillScale::Limit(limit), shares)
}

/// Returns amount / limit. If the limit is 0, the result is 1 for a positive amount and 0 otherwise.
fn share(amount: f64, limit: f64) -> f64 {
    if limit > 0.0 {
        amount / limit
    } else if amount > 0.0 {
        1.0
    } else {
        0.0
    }
}

/// Returns the used fraction of the force limits of the robot that holds this block: the larger of |Fx| / limit and
/// |Fy| / limit. Returns `None` if no robot holds the block, or if the robot has no limit for its force.
fn robot_limit_used(solved: SolvedFrame<'_>, block: BlockId) -> Option<f64> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let robot = frame_analysis.robots.iter().find(|r| r.block == block)?;
    let limits = scene.robots[robot.robot.0].limits;
    if !limits.fx.is_finite() && !limits.fy.is_finite() {
        return None;
    }
    Some(share(robot.force.x.abs(), limits.fx).max(share(robot.force.y.abs(), limits.fy)))
}

/// Raises the value of each block, indexed by block, to the largest value of `amount` on its interfaces.
pub(super) fn raise(most: &mut [f64], frame_analysis: &FrameAnalysis, amount: impl Fn(&Contact) -> f64) {
    for contact in &frame_analysis.contacts {
        let amount = amount(contact);
        contact.acting().iter().for_each(|acting| most[acting.on.0] = most[acting.on.0].max(amount));
    }
}

/// Returns, for each placed block in placing order, the largest value of `amount` on the interfaces of the block.
fn largest(solved: SolvedFrame<'_>, amount: impl Fn(&Contact) -> f64) -> Vec<f64> {
    let mut most = vec![0.0_f64; solved.scene.blocks.len()];
    raise(&mut most, solved.found, amount);
    solved.frame().placed.iter().map(|block| most[block.0]).collect()
}

/// Returns, for each placed block in placing order, the larger of its weight and the largest normal force on its
/// interfaces, N.
fn amplitudes(solved: SolvedFrame<'_>) -> Vec<f64> {
    let normals = largest(solved, Contact::normal_force);
    let weights = solved.frame().placed.iter().map(|b| solved.scene.blocks[b.0].weight);
    normals.into_iter().zip(weights).map(|(n, w)| n.max(w)).collect()
}
