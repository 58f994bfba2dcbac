//! [`Elements`]: the columns of a program as rows of a few entries each.

/// Columns of a few entries each.
#[derive(Clone, Debug)]
pub(super) struct Elements {
    unknowns: usize,
    /// Column k owns entries `start[k]..start[k + 1]`.
    start: Vec<usize>,
    place: Vec<u32>,
    value: Vec<f64>,
}

impl Elements {
    /// From (column, unknown, value) entries.
    pub fn of(
        unknowns: usize,
        columns: usize,
        entries: impl Iterator<Item = (usize, usize, f64)> + Clone,
    ) -> Elements {
        let mut start = vec![0; columns + 1];
        for (column, _, _) in entries.clone() {
            start[column + 1] += 1;
        }
        for k in 0..columns {
            start[k + 1] += start[k];
        }
        let mut next = start.clone();
        let (mut place, mut value) = (vec![0; start[columns]], vec![0.0; start[columns]]);
        for (column, unknown, amount) in entries {
            place[next[column]] = unknown as u32;
            value[next[column]] = amount;
            next[column] += 1;
        }
        let mut elements = Elements {
            unknowns,
            start,
            place,
            value,
        };
        elements.sort();
        elements
    }

    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// How many columns there are.
    pub fn count(&self) -> usize {
        self.start.len() - 1
    }

    /// The most entries that a column has.
    pub fn widest(&self) -> usize {
        let sizes = self.start.windows(2).map(|pair| pair[1] - pair[0]);
        sizes.max().unwrap_or(0)
    }

    /// The unknowns of a column, in order.
    pub fn places(&self, k: usize) -> &[u32] {
        &self.place[self.start[k]..self.start[k + 1]]
    }

    /// Its entries, in the order of its unknowns.
    pub fn values(&self, k: usize) -> &[f64] {
        &self.value[self.start[k]..self.start[k + 1]]
    }

    /// The same, to be changed.
    pub fn values_mut(&mut self, k: usize) -> &mut [f64] {
        &mut self.value[self.start[k]..self.start[k + 1]]
    }

    /// Numbers the unknowns anew.
    pub fn renumber(&mut self, number: &[u32]) {
        for place in &mut self.place {
            *place = number[*place as usize];
        }
        self.sort();
    }

    /// Brings the entries of every column in the order of their unknowns. They are few: by insertion.
    fn sort(&mut self) {
        for of in self.start.windows(2) {
            for i in of[0] + 1..of[1] {
                let mut j = i;
                while j > of[0] && self.place[j - 1] > self.place[j] {
                    self.place.swap(j - 1, j);
                    self.value.swap(j - 1, j);
                    j -= 1;
                }
            }
        }
    }

    /// Adds Σ amount·column to a sum.
    pub fn add(&self, amounts: &[f64], sum: &mut [f64]) {
        for (of, amount) in self.start.windows(2).zip(amounts) {
            let of = of[0]..of[1];
            for (place, value) in self.place[of.clone()].iter().zip(&self.value[of]) {
                sum[*place as usize] += value * amount;
            }
        }
    }

    /// columnᵀy of every column.
    pub fn along(&self, y: &[f64], products: &mut [f64]) {
        for (of, product) in self.start.windows(2).zip(products) {
            let of = of[0]..of[1];
            let entries = self.place[of.clone()].iter().zip(&self.value[of]);
            *product = entries.fold(0.0, |sum, (place, value)| sum + value * y[*place as usize]);
        }
    }
}
