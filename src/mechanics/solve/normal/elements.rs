//! [`Elements`]: the columns of a program as rows of a few entries each.
//!
//! Forces of one contact stand side by side and touch the same two bodies. They are kept as one small dense matrix, a
//! family, whose unknowns are looked up once for all of them.

use std::ops::Range;

/// Columns of a few entries each.
#[derive(Clone, Debug)]
pub(super) struct Elements {
    unknowns: usize,
    families: Vec<Slots>,
    place: Vec<u32>,
    value: Vec<f64>,
}

/// Where a family stands.
#[derive(Clone, Debug)]
struct Slots {
    columns: Range<usize>,
    places: Range<usize>,
    values: Range<usize>,
}

/// Columns side by side with entries at the same unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Family<'a> {
    /// The first of its columns.
    pub first: usize,
    /// The unknowns, in order.
    pub places: &'a [u32],
    /// Column by column an entry for each unknown.
    pub values: &'a [f64],
}

impl Elements {
    /// From (column, unknown, value) entries, where bodies have three unknowns each. A column joins the one before it where one
    /// of the two touches no body that the other does not.
    pub fn new(
        unknowns: usize,
        columns: usize,
        entries: impl Iterator<Item = (usize, usize, f64)> + Clone,
    ) -> Elements {
        let sparse = Sparse::new(columns, entries);
        let mut families: Vec<Range<usize>> = Vec::new();
        let (mut bodies, mut own): (Vec<u32>, Vec<u32>) = Default::default();
        for k in 0..columns {
            own.clear();
            own.extend(sparse.entries(k).map(|(place, _)| place / 3));
            let within = |a: &[u32], b: &[u32]| a.iter().all(|body| b.contains(body));
            let (fewer, more) = (within(&own, &bodies), within(&bodies, &own));
            match families.last_mut() {
                Some(family) if fewer || more => family.end = k + 1,
                _ => families.push(k..k + 1),
            }
            if !fewer {
                std::mem::swap(&mut bodies, &mut own);
            }
        }
        sparse.gathered(unknowns, &families)
    }

    /// The same with given families.
    pub fn in_families(
        unknowns: usize,
        families: &[Range<usize>],
        entries: impl Iterator<Item = (usize, usize, f64)> + Clone,
    ) -> Elements {
        let columns = families.last().map_or(0, |family| family.end);
        Sparse::new(columns, entries).gathered(unknowns, families)
    }

    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// How many columns there are.
    pub fn count(&self) -> usize {
        self.families.last().map_or(0, |family| family.columns.end)
    }

    /// How many families there are.
    pub fn families(&self) -> usize {
        self.families.len()
    }

    pub fn family(&self, k: usize) -> Family<'_> {
        let slots = &self.families[k];
        Family {
            first: slots.columns.start,
            places: &self.place[slots.places.clone()],
            values: &self.value[slots.values.clone()],
        }
    }

    /// The entries of a family, column by column, to be changed.
    pub fn values_mut(&mut self, k: usize) -> &mut [f64] {
        &mut self.value[self.families[k].values.clone()]
    }

    /// The most entries that a column has.
    pub fn widest(&self) -> usize {
        let sizes = self.families.iter().map(|family| family.places.len());
        sizes.max().unwrap_or(0)
    }

    /// Numbers the unknowns anew.
    pub fn renumber(&mut self, number: &[u32]) {
        let mut before: Vec<(u32, usize)> = Vec::new();
        let mut row: Vec<f64> = Vec::new();
        for family in &self.families {
            let places = &mut self.place[family.places.clone()];
            before.clear();
            before.extend(
                places
                    .iter()
                    .enumerate()
                    .map(|(k, p)| (number[*p as usize], k)),
            );
            before.sort_unstable();
            for (place, (new, _)) in places.iter_mut().zip(&before) {
                *place = *new;
            }
            for entries in self.value[family.values.clone()].chunks_exact_mut(before.len().max(1)) {
                row.clear();
                row.extend_from_slice(entries);
                for (entry, (_, k)) in entries.iter_mut().zip(&before) {
                    *entry = row[*k];
                }
            }
        }
    }

    /// Adds Σ amount·column to a sum.
    pub fn add(&self, amounts: &[f64], sum: &mut [f64]) {
        for (k, slots) in self.families.iter().enumerate() {
            let family = self.family(k);
            let amounts = &amounts[slots.columns.clone()];
            match family.places.len() {
                3 => family.add::<3>(amounts, sum),
                6 => family.add::<6>(amounts, sum),
                0 => {}
                width => {
                    for (row, amount) in family.values.chunks_exact(width).zip(amounts) {
                        for (place, value) in family.places.iter().zip(row) {
                            sum[*place as usize] += value * amount;
                        }
                    }
                }
            }
        }
    }

    /// columnᵀy of every column.
    pub fn along(&self, y: &[f64], products: &mut [f64]) {
        for (k, slots) in self.families.iter().enumerate() {
            let family = self.family(k);
            let products = &mut products[slots.columns.clone()];
            match family.places.len() {
                3 => family.along::<3>(y, products),
                6 => family.along::<6>(y, products),
                0 => products.fill(0.0),
                width => {
                    for (row, product) in family.values.chunks_exact(width).zip(products) {
                        let entries = family.places.iter().zip(row);
                        *product = entries
                            .fold(0.0, |sum, (place, value)| sum + value * y[*place as usize]);
                    }
                }
            }
        }
    }
}

impl Family<'_> {
    fn add<const W: usize>(&self, amounts: &[f64], sum: &mut [f64]) {
        let mut own = [0.0; W];
        for (row, amount) in self.values.as_chunks::<W>().0.iter().zip(amounts) {
            for (own, value) in own.iter_mut().zip(row) {
                *own += value * amount;
            }
        }
        for (place, own) in self.places.iter().zip(own) {
            sum[*place as usize] += own;
        }
    }

    fn along<const W: usize>(&self, y: &[f64], products: &mut [f64]) {
        let mut own = [0.0; W];
        for (own, place) in own.iter_mut().zip(self.places) {
            *own = y[*place as usize];
        }
        for (row, product) in self.values.as_chunks::<W>().0.iter().zip(products) {
            *product = row.iter().zip(&own).map(|(value, y)| value * y).sum();
        }
    }

    /// Σ weight·column·columnᵀ: of entry (i, j) of its lower triangle, i ≥ j, at j·width + i.
    pub fn products(&self, weights: &[f64], sums: &mut Vec<f64>) {
        let width = self.places.len();
        sums.clear();
        match width {
            3 => sums.extend_from_slice(self.squared::<3>(weights).as_flattened()),
            6 => sums.extend_from_slice(self.squared::<6>(weights).as_flattened()),
            0 => {}
            _ => {
                sums.resize(width * width, 0.0);
                for (row, weight) in self.values.chunks_exact(width).zip(&weights[self.first..]) {
                    for (sums, value) in sums.chunks_exact_mut(width).zip(row) {
                        let by = weight * value;
                        for (sum, value) in sums.iter_mut().zip(row) {
                            *sum += by * value;
                        }
                    }
                }
            }
        }
    }

    fn squared<const W: usize>(&self, weights: &[f64]) -> [[f64; W]; W] {
        let mut sums = [[0.0; W]; W];
        let rows = self.values.as_chunks::<W>().0.iter();
        for (row, weight) in rows.zip(&weights[self.first..]) {
            for (sums, value) in sums.iter_mut().zip(row) {
                let by = weight * value;
                for (sum, value) in sums.iter_mut().zip(row) {
                    *sum += by * value;
                }
            }
        }
        sums
    }
}

/// Columns as lists of entries.
struct Sparse {
    /// Column k owns entries `start[k]..start[k + 1]`.
    start: Vec<usize>,
    entries: Vec<(u32, f64)>,
}

impl Sparse {
    fn new(columns: usize, entries: impl Iterator<Item = (usize, usize, f64)> + Clone) -> Sparse {
        let mut start = vec![0; columns + 1];
        for (column, _, _) in entries.clone() {
            start[column + 1] += 1;
        }
        for k in 0..columns {
            start[k + 1] += start[k];
        }
        let mut next = start.clone();
        let mut list = vec![(0, 0.0); start[columns]];
        for (column, unknown, value) in entries {
            list[next[column]] = (unknown as u32, value);
            next[column] += 1;
        }
        Sparse {
            start,
            entries: list,
        }
    }

    fn entries(&self, k: usize) -> impl Iterator<Item = (u32, f64)> {
        self.entries[self.start[k]..self.start[k + 1]]
            .iter()
            .copied()
    }

    /// Families of columns, each with all unknowns that its columns touch.
    fn gathered(&self, unknowns: usize, families: &[Range<usize>]) -> Elements {
        let mut elements = Elements {
            unknowns,
            families: Vec::new(),
            place: Vec::new(),
            value: Vec::with_capacity(self.entries.len()),
        };
        let mut places: Vec<u32> = Vec::new();
        for columns in families {
            places.clear();
            let entries = columns.clone().flat_map(|k| self.entries(k));
            places.extend(entries.map(|(place, _)| place));
            places.sort_unstable();
            places.dedup();
            let (first, begin) = (elements.place.len(), elements.value.len());
            for k in columns.clone() {
                let row = elements.value.len();
                elements.value.resize(row + places.len(), 0.0);
                for (place, value) in self.entries(k) {
                    if let Ok(at) = places.binary_search(&place) {
                        elements.value[row + at] += value;
                    }
                }
            }
            elements.place.extend_from_slice(&places);
            elements.families.push(Slots {
                columns: columns.clone(),
                places: first..elements.place.len(),
                values: begin..elements.value.len(),
            });
        }
        elements
    }
}
