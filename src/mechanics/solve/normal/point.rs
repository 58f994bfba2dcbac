//! [`Point`]: where the interior-point method stands, and by how much it goes on.

use super::cholesky::Cholesky;
use super::interior::Posed;

/// What is added to the diagonal, so that what nothing holds has a pivot.
pub(super) const LEAST_PIVOT: f64 = 1e-12;

/// The share of the way to the nearest bound that a step goes.
pub(super) const NEARLY: f64 = 0.99;

/// Where the method stands, or by how much it goes on.
pub(super) struct Point {
    pub f: Vec<f64>,
    pub z: Vec<f64>,
    pub y: Vec<f64>,
    pub tau: f64,
    pub kappa: f64,
}

impl Point {
    pub fn zero(columns: usize, unknowns: usize) -> Point {
        Point {
            f: vec![0.0; columns],
            z: vec![0.0; columns],
            y: vec![0.0; unknowns],
            tau: 0.0,
            kappa: 0.0,
        }
    }

    /// Where amounts and slacks of least squares stand, moved until all are positive.
    pub fn first(posed: &Posed, factor: &mut Cholesky) -> Point {
        let columns = posed.cost.len();
        factor.factor(
            posed.elements,
            &vec![1.0; columns],
            LEAST_PIVOT + posed.squares,
        );
        let mut dear = vec![0.0; posed.loads.len()];
        posed.elements.add(posed.cost, &mut dear);
        let mut both: Vec<[f64; 2]> = posed
            .loads
            .iter()
            .zip(&dear)
            .map(|(b, c)| [*b, *c])
            .collect();
        factor.solve(&mut both);
        let mut at = Point {
            tau: 1.0,
            kappa: 1.0 - posed.squares,
            ..Point::zero(columns, posed.loads.len())
        };
        let list: Vec<f64> = both.iter().map(|v| v[0]).collect();
        posed.elements.along(&list, &mut at.f);
        at.y = both.iter().map(|v| v[1]).collect();
        posed.elements.along(&at.y, &mut at.z);
        for (z, c) in at.z.iter_mut().zip(posed.cost) {
            *z = c - *z;
        }
        for list in [&mut at.f, &mut at.z] {
            let least = list.iter().fold(f64::INFINITY, |a, b| a.min(*b));
            let mean = list.iter().filter(|v| **v > 0.0).sum::<f64>() / columns as f64;
            let inside = f64::max(1.0, 0.1 * mean);
            let by = if least < inside {
                inside - least.min(0.0)
            } else {
                0.0
            };
            list.iter_mut().for_each(|v| *v += by);
        }
        at
    }

    /// Σ slack of the columns whose amount outweighs it.
    pub fn slack_in_use(&self) -> f64 {
        let both = self.f.iter().zip(&self.z);
        both.filter(|(f, z)| f > z).map(|(_, z)| z).sum()
    }

    /// The longest step along a direction that leaves nothing below 0, at most 1/[`NEARLY`].
    pub fn longest(&self, direction: &Point) -> f64 {
        let pair = [(self.tau, direction.tau), (self.kappa, direction.kappa)];
        let mut longest = 1.0 / NEARLY;
        let (f, z) = (
            self.f.iter().zip(&direction.f),
            self.z.iter().zip(&direction.z),
        );
        for (v, d) in f.chain(z) {
            if v + longest * d < 0.0 {
                longest = -v / d;
            }
        }
        for (v, d) in pair {
            if v + longest * d < 0.0 {
                longest = -v / d;
            }
        }
        longest
    }

    /// Goes along a direction.
    pub fn advance(&mut self, direction: &Point, by: f64) {
        let lists = [
            (&mut self.f, &direction.f),
            (&mut self.z, &direction.z),
            (&mut self.y, &direction.y),
        ];
        for (list, along) in lists {
            for (v, d) in list.iter_mut().zip(along) {
                *v += by * d;
            }
        }
        self.tau += by * direction.tau;
        self.kappa += by * direction.kappa;
        // Only ratios count: neither of the two may leave the range of numbers.
        let size = self.tau.max(self.kappa);
        if !(1e-3..1e3).contains(&size) {
            let lists = [&mut self.f, &mut self.z, &mut self.y];
            lists.into_iter().flatten().for_each(|v| *v /= size);
            self.tau /= size;
            self.kappa /= size;
        }
    }
}

/// The largest of a list, without signs.
pub(super) fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}
