//! [`Graph`]: the sparsity pattern of the matrix of the normal equations, and its order by minimum degree.

use super::column_groups::ColumnGroups;

/// The sparsity pattern of A·Aᵀ: for every unknown, the unknowns that share a column with it, itself included, in
/// ascending order.
pub(super) struct Graph {
    /// Where the neighbours of each unknown begin in `list`, and the length of `list`.
    pub starts: Vec<usize>,
    pub list: Vec<u32>,
}

impl Graph {
    pub fn new(columns: &ColumnGroups) -> Graph {
        let n = columns.unknowns();
        // Count, for each unknown, the groups that have an entry in its row.
        let mut begin = vec![0; n + 1];
        let groups = || (0..columns.group_count()).map(|k| columns.group(k).rows);
        for row in groups().flatten() {
            begin[*row as usize + 1] += 1;
        }
        for k in 0..n {
            begin[k + 1] += begin[k];
        }
        // Counting sort: list the groups that have an entry in each row.
        let mut next = begin.clone();
        let mut groups_of = vec![0; begin[n]];
        for (k, rows) in groups().enumerate() {
            for row in rows {
                groups_of[next[*row as usize]] = k;
                next[*row as usize] += 1;
            }
        }
        let mut graph = Graph {
            starts: Vec::with_capacity(n + 1),
            // `list` includes the diagonal entries, which `amd` expects and does not count as neighbours.
            list: Vec::new(),
        };
        graph.starts.push(0);
        // The neighbours of an unknown are the union of the rows of its groups. `seen` marks the neighbours that are
        // already in the list.
        let mut seen = vec![usize::MAX; n];
        for unknown in 0..n {
            let first = graph.list.len();
            seen[unknown] = unknown;
            graph.list.push(unknown as u32);
            for k in &groups_of[begin[unknown]..begin[unknown + 1]] {
                for other in columns.group(*k).rows {
                    if seen[*other as usize] != unknown {
                        seen[*other as usize] = unknown;
                        graph.list.push(*other);
                    }
                }
            }
            graph.list[first..].sort_unstable();
            graph.starts.push(graph.list.len());
        }
        graph
    }

    /// The number of unknowns.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The neighbours of an unknown, itself included.
    pub fn neighbours(&self, unknown: usize) -> &[u32] {
        &self.list[self.starts[unknown]..self.starts[unknown + 1]]
    }

    /// An order of elimination by approximate minimum degree (Amestoy, Davis and Duff 1996). `None` if there are too many
    /// entries for 32-bit indices, or if `amd` finds no order.
    pub fn by_minimum_degree(&self) -> Option<Vec<usize>> {
        let count = i32::try_from(self.count()).ok()?;
        let (starts, list) = self.as_i32()?;
        let (order, _, _) = amd::order(count, &starts, &list, &amd::Control::default()).ok()?;
        Some(order.iter().map(|k| *k as usize).collect())
    }

    /// Converts the pattern to the 32-bit integers that `amd` expects. `None` if there are too many entries for 32
    /// bits.
    fn as_i32(&self) -> Option<(Vec<i32>, Vec<i32>)> {
        let starts = self.starts.iter().map(|k| i32::try_from(*k).ok());
        let list = self.list.iter().map(|k| i32::try_from(*k).ok());
        Some((starts.collect::<Option<_>>()?, list.collect::<Option<_>>()?))
    }
}
