//! [`Case`]: a component exactly at an end of the interval in which it stands, where it begins to fall.

use crate::geometry::cross;
use crate::mechanics::analysis::margin::MarginKind;
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::Motion;
use crate::mechanics::solve::{LimitState, limit_state};
use crate::mechanics::statics::assembly::{Assembly, LoadVector};

/// One component at one end of the interval of a parameter.
pub(super) struct Case<'a> {
    /// The component with the current values of all parameters.
    pub component: &'a Assembly,
    /// The margin whose parameter is at the end of its interval.
    pub kind: MarginKind,
    /// The value of the parameter at the end.
    pub value: f64,
    /// 1 at the upper end, −1 at the lower one.
    pub outward: f64,
    /// How the blocks begin to move just beyond the end.
    pub mechanism: &'a [Motion],
}

/// How far inside the end the linear program begins, as a fraction of the loads there. The fractions are tried in turn.
///
/// The state at the end is the same for every fraction. With a large fraction, the program may begin where the
/// component does not stand. A small fraction loses digits.
const START_SHARES: [f64; 3] = [0.05, 2e-3, 1e-4];

/// The state is accepted if the program ends this close to the end of the interval, as a fraction of the loads.
const END_TOL: f64 = 1e-3;

impl Case<'_> {
    /// Returns the component with the parameter set to `value`.
    pub fn at(&self, value: f64) -> Assembly {
        (self.kind.about().setting)(value).apply(self.component)
    }

    /// Returns the derivative of the load on each body with respect to the parameter, at `value`. `None` if the loads
    /// do not depend on the parameter.
    pub fn growth(&self, value: f64) -> Option<Vec<LoadVector>> {
        let growth = (self.kind.about().growth?)(value);
        let bodies = growth.apply(self.component).bodies;
        Some(bodies.iter().map(|body| body.load).collect())
    }

    /// Returns a load on each body that makes the component fall: the change of the loads if the parameter goes beyond
    /// the end. If the loads do not depend on the parameter, the load is a force and a moment along the mechanism.
    pub fn push(&self, value: f64) -> Vec<LoadVector> {
        if let Some(growth) = self.growth(value) {
            let outward = growth.into_iter().map(|load| load.times(self.outward));
            return outward.collect();
        }
        let length = self.component.length;
        let bodies = self.component.bodies.iter();
        let along = bodies.map(|body| {
            let motion = self.mechanism.iter().find(|m| m.block == body.block);
            motion.map_or(LoadVector::ZERO, |motion| LoadVector {
                force: motion.velocity,
                moment: motion.spin * length * length,
            })
        });
        along.collect()
    }

    /// Computes the forces and the mechanism at the end of the interval. Returns the linear program and its solution.
    /// `None` if there are no loads, or if the program finds another end.
    pub fn solved(&self, changed: &Assembly) -> Option<(Program, LimitState)> {
        let program = Program::new(changed, Scale::from_assembly(changed));
        let scale = program.scale;
        let mut direction = Vec::with_capacity(program.loads.len());
        for load in self.push(self.value) {
            direction.extend([-load.force.x, -load.force.y, -load.moment / scale.length]);
        }
        let size = |list: &[f64]| list.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let (loads, push) = (size(&program.loads), size(&direction));
        if loads == 0.0 || push == 0.0 {
            return None;
        }
        direction.iter_mut().for_each(|v| *v *= loads / push);
        START_SHARES.iter().find_map(|share| {
            let mut inside = program.clone();
            for (load, push) in inside.loads.iter_mut().zip(&direction) {
                *load -= share * push;
            }
            let state = limit_state(&inside, &direction)?;
            let is_same = (state.factor - share).abs() <= END_TOL.max(0.1 * share);
            is_same.then_some((program.clone(), state))
        })
    }
}

/// Converts a load, whose moment is about the centroid, to force x, force y and the moment about `origin`.
pub(super) fn load_at(load: &LoadVector, centroid: crate::geometry::Point, origin: crate::geometry::Point) -> [f64; 3] {
    let moment = load.moment + cross(centroid - origin, load.force);
    [load.force.x, load.force.y, moment]
}
