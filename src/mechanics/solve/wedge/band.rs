//! [`Band`]: square systems whose entries stand near the diagonal, by elimination with row exchanges.
//!
//! Blocks that touch are numbered near each other by [`order`], so that a row is as wide as a layer of the structure and
//! not as the whole of it. The matrices are not symmetric where faces slide.

use crate::program::Program;

/// A pivot below this is put in its place: the unknown is not determined, and the residual tells whether that matters.
const LEAST_PIVOT: f64 = 1e-14;

/// A matrix with `reach` entries on either side of the diagonal.
pub(super) struct Band {
    size: usize,
    reach: usize,
    rows: Vec<f64>,
    exchanged: Vec<usize>,
}

impl Band {
    /// A matrix of zeros.
    pub(super) fn new(size: usize, reach: usize) -> Band {
        let reach = reach.min(size.saturating_sub(1));
        Band {
            size,
            reach,
            // Row exchanges fill in as many entries again on the right.
            rows: vec![0.0; size * (3 * reach + 1)],
            exchanged: Vec::with_capacity(size),
        }
    }

    fn at(&self, row: usize, column: usize) -> usize {
        row * (3 * self.reach + 1) + column + self.reach - row
    }

    /// Adds to an entry.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.at(row, column);
        self.rows[at] += value;
    }

    /// Eliminates below the diagonal.
    pub(super) fn factored(mut self) -> Band {
        for k in 0..self.size {
            let last = (k + self.reach).min(self.size - 1);
            let end = (k + 2 * self.reach).min(self.size - 1);
            let mut best = k;
            for row in k + 1..=last {
                if self.rows[self.at(row, k)].abs() > self.rows[self.at(best, k)].abs() {
                    best = row;
                }
            }
            self.exchanged.push(best);
            if best != k {
                for column in k..=end {
                    let (a, b) = (self.at(k, column), self.at(best, column));
                    self.rows.swap(a, b);
                }
            }
            let diagonal = self.at(k, k);
            if self.rows[diagonal].abs() < LEAST_PIVOT {
                self.rows[diagonal] = LEAST_PIVOT;
            }
            for row in k + 1..=last {
                let at = self.at(row, k);
                if self.rows[at] == 0.0 {
                    continue;
                }
                let factor = self.rows[at] / self.rows[diagonal];
                self.rows[at] = factor;
                for column in k + 1..=end {
                    let (to, from) = (self.at(row, column), self.at(k, column));
                    self.rows[to] -= factor * self.rows[from];
                }
            }
        }
        self
    }

    /// The answer of a factored matrix to one right side.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        for k in 0..self.size {
            x.swap(k, self.exchanged[k]);
            let known = x[k];
            if known != 0.0 {
                let last = (k + self.reach).min(self.size - 1);
                for (row, value) in x.iter_mut().enumerate().take(last + 1).skip(k + 1) {
                    *value -= self.rows[self.at(row, k)] * known;
                }
            }
        }
        for k in (0..self.size).rev() {
            let end = (k + 2 * self.reach).min(self.size - 1);
            for column in k + 1..=end {
                x[k] -= self.rows[self.at(k, column)] * x[column];
            }
            x[k] /= self.rows[self.at(k, k)];
        }
        x
    }
}

/// A place for every block such that blocks that touch have places near each other, and how far they are apart at most.
pub(super) fn order(program: &Program) -> (Vec<usize>, usize) {
    let mut beside = vec![Vec::new(); program.blocks];
    let pairs = || {
        let pair = |c: &crate::program::ContactTerm| Some((c.on.0, c.from.as_ref()?.0));
        program.contacts.iter().filter_map(pair)
    };
    for (a, b) in pairs() {
        beside[a].push(b);
        beside[b].push(a);
    }
    let mut place = vec![usize::MAX; program.blocks];
    let mut next = 0;
    // Layer by layer from the farthest block of a first pass, the Cuthill–McKee way.
    let layers = |from: usize, place: &[usize]| {
        let mut list = vec![from];
        let mut seen: Vec<bool> = place.iter().map(|p| *p != usize::MAX).collect();
        seen[from] = true;
        let mut k = 0;
        while k < list.len() {
            let mut around: Vec<usize> = beside[list[k]].clone();
            around.sort_by_key(|b| (beside[*b].len(), *b));
            for block in around {
                if !seen[block] {
                    seen[block] = true;
                    list.push(block);
                }
            }
            k += 1;
        }
        list
    };
    for block in 0..program.blocks {
        if place[block] != usize::MAX {
            continue;
        }
        let farthest = layers(block, &place).last().copied().unwrap_or(block);
        for found in layers(farthest, &place) {
            place[found] = next;
            next += 1;
        }
    }
    let apart = pairs().map(|(a, b)| place[a].abs_diff(place[b])).max();
    (place, apart.unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_is_solved_with_row_exchanges() {
        // [0 2 0; 3 0 1; 0 4 5] x = [4, 6, 23], x = (1, 2, 3).
        let mut band = Band::new(3, 1);
        for (row, column, value) in [
            (0, 1, 2.0),
            (1, 0, 3.0),
            (1, 2, 1.0),
            (2, 1, 4.0),
            (2, 2, 5.0),
        ] {
            band.add(row, column, value);
        }
        let x = band.factored().solve(&[4.0, 6.0, 23.0]);
        for (found, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{x:?}");
        }
    }
}
