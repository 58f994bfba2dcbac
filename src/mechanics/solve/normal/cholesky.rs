//! [`Cholesky`]: the factor L·Lᵀ of Σ weight·column·columnᵀ, panel by panel.
//!
//! A panel takes the columns whose first unknown is eliminated in it, and the products that its children hand up; it
//! factors its own columns, keeps them, and hands on what is left of its rows (the multifrontal method, Duff and Reid 1983).
//! So the matrix itself is never written down.

use super::elements::Elements;
use super::panels::{Supernode, Supernodes};
use super::product::{Packed, dot, factor};

/// A factor, and all that is needed to make it anew with other weights.
pub(super) struct Cholesky {
    panels: Supernodes,
    /// Where the values of each panel begin: column by column, each of its own width and rows.
    begin: Vec<usize>,
    values: Vec<f64>,
    /// The families of columns that each panel takes.
    taken: Vec<Vec<u32>>,
    scratch: Scratch,
}

/// Room that every factoring uses again.
#[derive(Default)]
struct Scratch {
    /// Where each position stands in the panel at hand.
    local: Vec<u32>,
    /// What panels hand up, the last one last.
    handed: Vec<f64>,
    /// Products of the columns of one family.
    products: Vec<f64>,
    /// Rows of a child that stand side by side in its parent's panel as well.
    runs: Vec<Run>,
    packed: Packed,
}

/// Where column c of a packed lower triangle of `rows` rows would have its row 0.
fn packed_begin(rows: usize, c: usize) -> usize {
    c * rows - c * (c + 1) / 2
}

/// Entries of a packed lower triangle.
fn packed_size(rows: usize) -> usize {
    rows * (rows + 1) / 2
}

impl Cholesky {
    /// Finds the order of elimination, and numbers the unknowns of the columns in it; `None` where there is none.
    pub fn new(elements: &mut Elements) -> Option<Cholesky> {
        let panels = Supernodes::new(elements)?;
        elements.renumber(&panels.position);
        let mut begin = vec![0];
        let mut of_column = vec![0; elements.unknowns()];
        for (k, panel) in panels.panels.iter().enumerate() {
            of_column[panel.first..panel.first + panel.width].fill(k);
            begin.push(begin[k] + panel.width * (panel.width + panel.rows.len()));
        }
        let mut taken = vec![Vec::new(); panels.panels.len()];
        for k in 0..elements.families() {
            if let Some(first) = elements.family(k).places.first() {
                taken[of_column[*first as usize]].push(k as u32);
            }
        }
        let values = vec![0.0; begin[panels.panels.len()]];
        let scratch = Scratch {
            local: vec![0; elements.unknowns()],
            ..Scratch::default()
        };
        Some(Cholesky {
            panels,
            begin,
            values,
            taken,
            scratch,
        })
    }

    /// Multiplications and additions of one factoring.
    pub fn operations(&self) -> f64 {
        let of = |panel: &Supernode| {
            let (w, m) = (panel.width as f64, panel.rows.len() as f64);
            w * m * m + w * w * m + w * w * w / 3.0
        };
        self.panels.panels.iter().map(of).sum()
    }

    /// A list of unknowns in the order of elimination.
    pub fn in_order(&self, list: &[f64]) -> Vec<f64> {
        let mut ordered = vec![0.0; list.len()];
        for (value, position) in list.iter().zip(&self.panels.position) {
            ordered[*position as usize] = *value;
        }
        ordered
    }

    /// A list in the order of elimination as it was given.
    pub fn as_given(&self, list: &[f64]) -> Vec<f64> {
        let positions = self.panels.position.iter();
        positions.map(|position| list[*position as usize]).collect()
    }

    /// Factors Σ weight·column·columnᵀ + least·1.
    pub fn factor(&mut self, elements: &Elements, weights: &[f64], least: f64) {
        let Scratch {
            local,
            handed,
            products,
            runs,
            packed,
        } = &mut self.scratch;
        handed.clear();
        let mut waiting: Vec<usize> = Vec::new();
        for (p, panel) in self.panels.panels.iter().enumerate() {
            let rows = &self.panels.rows[panel.rows.clone()];
            let (width, below) = (panel.width, rows.len());
            let height = width + below;
            let values = &mut self.values[self.begin[p]..self.begin[p + 1]];
            values.fill(0.0);
            for k in 0..width {
                local[panel.first + k] = k as u32;
                values[k * height + k] = least;
            }
            for (k, row) in rows.iter().enumerate() {
                local[*row as usize] = (width + k) as u32;
            }
            // The children's products lie on top; what this panel hands up is gathered behind them and takes their place.
            let first_child = waiting.len() - panel.children;
            let from_children = |p: &usize| packed_size(self.panels.panels[*p].rows.len());
            let size: usize = waiting[first_child..].iter().map(from_children).sum();
            let base = handed.len() - size;
            let own = handed.len();
            handed.resize(own + packed_size(below), 0.0);
            let (children, rest) = handed.split_at_mut(own);
            let mut front = Front {
                width,
                height,
                values,
                rest,
            };
            for k in &self.taken[p] {
                let family = elements.family(*k as usize);
                family.products(weights, products);
                let places = family.places;
                for (i, column) in places.iter().enumerate() {
                    let mut column = front.column(local[*column as usize] as usize);
                    let sums = &products[i * places.len()..(i + 1) * places.len()];
                    for (row, sum) in places[i..].iter().zip(&sums[i..]) {
                        column[local[*row as usize] as usize] += sum;
                    }
                }
            }
            let mut at = base;
            for child in waiting.drain(first_child..) {
                let rows = &self.panels.rows[self.panels.panels[child].rows.clone()];
                Run::all(rows, local, runs);
                for (k, run) in runs.iter().enumerate() {
                    for i in run.from..run.end {
                        let mut column = front.column(run.to + i - run.from);
                        let begin = at;
                        at += rows.len() - i;
                        let products = &children[begin..at];
                        for run in &runs[k..] {
                            let from = run.from.max(i);
                            let to = run.to + from - run.from;
                            column.add(to, &products[from - i..run.end - i]);
                        }
                    }
                }
            }
            factor(front.values, height, width, packed);
            if below > 0 {
                packed.fill(front.values, height, width);
                packed.take_from(front.rest, below, |c| packed_begin(below, c));
                waiting.push(p);
            }
            handed.copy_within(own.., base);
            handed.truncate(base + packed_size(below));
        }
    }

    /// Solves for right-hand sides that stand side by side, in place, in the order of elimination.
    pub fn solve<const N: usize>(&self, x: &mut [[f64; N]]) {
        let mut below: Vec<[f64; N]> = Vec::new();
        for (p, panel) in self.panels.panels.iter().enumerate() {
            let rows = &self.panels.rows[panel.rows.clone()];
            let (width, height) = (panel.width, panel.width + rows.len());
            let values = &self.values[self.begin[p]..self.begin[p + 1]];
            below.clear();
            below.resize(height, [0.0; N]);
            for (k, column) in values.chunks_exact(height).enumerate() {
                let at = panel.first + k;
                for n in 0..N {
                    x[at][n] = (x[at][n] - below[k][n]) * column[k];
                }
                let own = x[at];
                for (sum, l) in below[k + 1..].iter_mut().zip(&column[k + 1..]) {
                    for n in 0..N {
                        sum[n] += l * own[n];
                    }
                }
            }
            for (row, sum) in rows.iter().zip(&below[width..]) {
                for n in 0..N {
                    x[*row as usize][n] -= sum[n];
                }
            }
        }
        let mut lists: [Vec<f64>; N] = std::array::from_fn(|_| Vec::new());
        for (p, panel) in self.panels.panels.iter().enumerate().rev() {
            let rows = &self.panels.rows[panel.rows.clone()];
            let (width, height) = (panel.width, panel.width + rows.len());
            let values = &self.values[self.begin[p]..self.begin[p + 1]];
            for (n, list) in lists.iter_mut().enumerate() {
                list.clear();
                list.extend(x[panel.first..panel.first + width].iter().map(|x| x[n]));
                list.extend(rows.iter().map(|row| x[*row as usize][n]));
            }
            for (k, column) in values.chunks_exact(height).enumerate().rev() {
                for (n, list) in lists.iter_mut().enumerate() {
                    let sum = dot(&list[k + 1..], &column[k + 1..]);
                    list[k] = (list[k] - sum) * column[k];
                    x[panel.first + k][n] = list[k];
                }
            }
        }
    }
}

/// Rows of a panel that stand side by side in another one too.
struct Run {
    from: usize,
    end: usize,
    /// Where the first of them stands there.
    to: usize,
}

impl Run {
    /// All rows, where each stands elsewhere being given.
    fn all(rows: &[u32], local: &[u32], runs: &mut Vec<Run>) {
        runs.clear();
        for (k, row) in rows.iter().enumerate() {
            let to = local[*row as usize] as usize;
            match runs.last_mut() {
                Some(run) if run.to + (k - run.from) == to => run.end = k + 1,
                _ => runs.push(Run {
                    from: k,
                    end: k + 1,
                    to,
                }),
            }
        }
    }
}

/// The matrix of one panel: its own columns, and the lower triangle that it hands up.
struct Front<'a> {
    width: usize,
    height: usize,
    values: &'a mut [f64],
    rest: &'a mut [f64],
}

impl Front<'_> {
    /// A column, such that row r stands at r.
    fn column(&mut self, c: usize) -> Shifted<'_> {
        match c.checked_sub(self.width) {
            None => Shifted {
                list: &mut self.values[c * self.height..(c + 1) * self.height],
                by: 0,
            },
            Some(c) => {
                let rows = self.height - self.width;
                let begin = packed_begin(rows, c) + c;
                Shifted {
                    list: &mut self.rest[begin..begin + rows - c],
                    by: self.width + c,
                }
            }
        }
    }
}

/// Rows from one on.
struct Shifted<'a> {
    list: &'a mut [f64],
    by: usize,
}

impl Shifted<'_> {
    /// Adds a list to the rows from one on.
    fn add(&mut self, row: usize, list: &[f64]) {
        let begin = row - self.by;
        for (v, w) in self.list[begin..begin + list.len()].iter_mut().zip(list) {
            *v += w;
        }
    }
}

impl std::ops::Index<usize> for Shifted<'_> {
    type Output = f64;

    fn index(&self, row: usize) -> &f64 {
        &self.list[row - self.by]
    }
}

impl std::ops::IndexMut<usize> for Shifted<'_> {
    fn index_mut(&mut self, row: usize) -> &mut f64 {
        &mut self.list[row - self.by]
    }
}
