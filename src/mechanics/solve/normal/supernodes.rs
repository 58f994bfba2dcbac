//! [`Supernodes`]: the sparsity pattern of the factor, divided into supernodes.
//!
//! Consecutive columns of the factor with the same rows below them form a supernode, which is stored as a dense matrix.
//! A supernode is merged with its parent if that stores few extra zeros (relaxed supernodes, Ashcraft and Grimes 1989).
//! Reference: Davis, Direct Methods for Sparse Linear Systems, SIAM 2006, chapter 4.

use std::ops::Range;

use super::column_groups::ColumnGroups;
use super::elimination_tree::{Graph, OrderedGraph};

/// Consecutive columns of the factor with the same rows below them.
#[derive(Clone, Debug)]
pub(super) struct Supernode {
    /// The position of its first column.
    pub first: usize,
    /// The number of its columns.
    pub width: usize,
    /// The rows below its columns, as a range of [`Supernodes::rows`].
    pub rows: Range<usize>,
    /// The number of its children in the assembly tree: supernodes whose update matrices it receives.
    pub children: usize,
}

/// The sparsity pattern of a factor, without values.
#[derive(Clone, Debug)]
pub(super) struct Supernodes {
    /// The position of each unknown in the order of elimination.
    pub position: Vec<u32>,
    /// The supernodes in postorder: children before their parents, each subtree consecutive.
    pub list: Vec<Supernode>,
    /// The rows below all supernodes, as positions in the order of elimination, ascending within each supernode.
    pub rows: Vec<u32>,
}

impl Supernodes {
    /// Symbolic analysis of A·W·Aᵀ, whose pattern does not depend on the weights; `None` if no order of elimination is
    /// found.
    pub fn new(columns: &ColumnGroups) -> Option<Supernodes> {
        let graph = Graph::new(columns);
        let ordered = OrderedGraph::new(&graph)?;
        let ranges = relaxed_supernodes(&ordered.parent, &ordered.column_counts());
        let (list, rows) = symbolic_factor(&ordered, &ranges);
        Some(Supernodes { position: ordered.position.iter().map(|k| *k as u32).collect(), list, rows })
    }
}

/// Symbolic factorization: computes the rows below every supernode. They are the rows with an entry in its columns, and
/// the rows of the update matrices of its children.
fn symbolic_factor(ordered: &OrderedGraph<'_>, ranges: &[ColumnRange]) -> (Vec<Supernode>, Vec<u32>) {
    let n = ordered.parent.len();
    let mut supernode_of = vec![0; n];
    for (g, range) in ranges.iter().enumerate() {
        supernode_of[range.first..range.end()].fill(g);
    }
    let mut supernodes: Vec<Supernode> = Vec::with_capacity(ranges.len());
    let mut rows: Vec<u32> = Vec::new();
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); ranges.len()];
    let mut seen = vec![usize::MAX; n];
    for (g, range) in ranges.iter().enumerate() {
        // Collect the rows below the supernode; `seen` avoids repeated rows.
        let begin = rows.len();
        let mut insert = |i: usize, rows: &mut Vec<u32>| {
            if i >= range.end() && seen[i] != g {
                seen[i] = g;
                rows.push(i as u32);
            }
        };
        for k in range.first..range.end() {
            ordered.row(k).for_each(|i| insert(i, &mut rows));
        }
        // Add the rows of the children's update matrices.
        let own_children = std::mem::take(&mut children[g]);
        for child in &own_children {
            for k in supernodes[*child].rows.clone() {
                insert(rows[k] as usize, &mut rows);
            }
        }
        rows[begin..].sort_unstable();
        // The parent is the supernode that contains the first row below this supernode.
        if let Some(first) = rows.get(begin) {
            children[supernode_of[*first as usize]].push(g);
        }
        supernodes.push(Supernode {
            first: range.first,
            width: range.width,
            rows: begin..rows.len(),
            children: own_children.len(),
        });
    }
    (supernodes, rows)
}

/// A range of columns that will form one supernode.
struct ColumnRange {
    first: usize,
    width: usize,
    /// The number of rows below the columns.
    rows: usize,
    /// The number of zeros that are stored among the values.
    zeros: f64,
}

impl ColumnRange {
    fn end(&self) -> usize {
        self.first + self.width
    }

    /// Returns this supernode merged with its parent, which follows it; `None` if too many zeros would be stored.
    ///
    /// The wider the supernode, the smaller the allowed fraction of zeros, because the work for each zero grows with
    /// the width. CHOLMOD uses the same scheme with widths of 4, 16 and 48 and fractions of 0.8, 0.1 and 0.05.
    fn merge(&self, parent: &ColumnRange) -> Option<ColumnRange> {
        let width = self.width + parent.width;
        let new = self.width * (parent.width + parent.rows).saturating_sub(self.rows);
        let zeros = self.zeros + parent.zeros + new as f64;
        let all = 0.5 * (width * width) as f64 + (width * parent.rows) as f64;
        let share = zeros / all;
        let is_worth_it = match width {
            0..=6 => true,
            7..=16 => share < 0.5,
            17..=48 => share < 0.15,
            _ => share < 0.05,
        };
        is_worth_it.then_some(ColumnRange { first: self.first, width, rows: parent.rows, zeros })
    }
}

/// Finds the fundamental supernodes (chains of columns with equal rows), and merges them with their parents.
fn relaxed_supernodes(parent: &[Option<usize>], counts: &[usize]) -> Vec<ColumnRange> {
    let n = parent.len();
    // A column belongs to the supernode of the previous column if it is the parent of that column in the elimination
    // tree, has one row fewer, and has no other child.
    let mut children = vec![0; n];
    for p in parent.iter().flatten() {
        children[*p] += 1;
    }
    let continues = |k: usize| parent[k - 1] == Some(k) && counts[k - 1] == counts[k] + 1 && children[k] == 1;
    let firsts: Vec<usize> = (0..n).filter(|k| *k == 0 || !continues(*k)).collect();
    let mut ranges: Vec<ColumnRange> = Vec::new();
    for (k, first) in firsts.iter().enumerate() {
        let end = firsts.get(k + 1).copied().unwrap_or(n);
        let mut range = ColumnRange { first: *first, width: end - first, rows: counts[end - 1] - 1, zeros: 0.0 };
        // In a postorder, the last child comes just before its parent. Only this child can be merged.
        while let Some(last) = ranges.last() {
            let above = parent[last.end() - 1];
            if !above.is_some_and(|p| (range.first..range.end()).contains(&p)) {
                break;
            }
            let Some(merged) = last.merge(&range) else {
                break;
            };
            ranges.pop();
            range = merged;
        }
        ranges.push(range);
    }
    ranges
}
