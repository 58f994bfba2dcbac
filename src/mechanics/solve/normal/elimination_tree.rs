//! Finds the order of elimination of a sparse symmetric matrix, its elimination tree and the column counts of its
//! factor.
//!
//! Steps: approximate minimum degree order (crate `amd`), elimination tree, postorder of the tree, column counts.
//! Reference: Davis, Direct Methods for Sparse Linear Systems, SIAM 2006, chapters 4 and 7.

use super::column_groups::ColumnGroups;

/// The sparsity pattern of A·Aᵀ: for every unknown, the unknowns that share a column with it, itself included, in
/// ascending order.
pub(super) struct Graph {
    starts: Vec<usize>,
    list: Vec<u32>,
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

    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Converts the pattern to the 32-bit integers that `amd` expects. `None` if there are too many entries for 32
    /// bits.
    fn as_i32(&self) -> Option<(Vec<i32>, Vec<i32>)> {
        let starts = self.starts.iter().map(|k| i32::try_from(*k).ok());
        let list = self.list.iter().map(|k| i32::try_from(*k).ok());
        Some((starts.collect::<Option<_>>()?, list.collect::<Option<_>>()?))
    }
}

/// The pattern of the matrix in the order of elimination, with the elimination tree.
pub(super) struct OrderedGraph<'a> {
    graph: &'a Graph,
    /// The unknown at each position.
    order: Vec<usize>,
    /// The position of each unknown.
    pub position: Vec<usize>,
    /// The parent of each column in the elimination tree; `None` for a root. Children come before their parents, and
    /// the columns of a subtree are consecutive.
    pub parent: Vec<Option<usize>>,
}

impl<'a> OrderedGraph<'a> {
    /// Finds an order of elimination with little fill-in, and sorts it into a postorder of the elimination tree. `None`
    /// if the graph is too large for 32-bit indices or `amd` finds no order.
    pub fn new(graph: &'a Graph) -> Option<OrderedGraph<'a>> {
        let count = i32::try_from(graph.count()).ok()?;
        let (starts, list) = graph.as_i32()?;
        // Approximate minimum degree order (Amestoy, Davis and Duff 1996).
        let (order, _, _) = amd::order(count, &starts, &list, &amd::Control::default()).ok()?;
        let order: Vec<usize> = order.iter().map(|k| *k as usize).collect();
        let by_degree = OrderedGraph { graph, position: inverse(&order), order, parent: Vec::new() };
        // A postorder of the tree has the same fill-in and makes columns with equal rows consecutive.
        let parent = by_degree.elimination_tree();
        let post = postorder(&parent);
        let new_position = inverse(&post);
        let order: Vec<usize> = post.iter().map(|k| by_degree.order[*k]).collect();
        let parents = post.iter().map(|k| parent[*k].map(|p| new_position[p]));
        Some(OrderedGraph { graph, position: inverse(&order), parent: parents.collect(), order })
    }

    /// Returns the positions, in the order of elimination, of the entries in the row at position `k`.
    pub fn row(&self, k: usize) -> impl Iterator<Item = usize> {
        let unknown = self.order[k];
        let of = self.graph.starts[unknown]..self.graph.starts[unknown + 1];
        let others = self.graph.list[of].iter();
        others.map(|other| self.position[*other as usize])
    }

    /// Returns the elimination tree: the parent of a column is the row of the first entry below the diagonal in this
    /// column of the factor.
    ///
    /// `ancestor` leads from a column towards the root of the subtree that contains it so far. The search shortens
    /// these paths (Liu 1986).
    fn elimination_tree(&self) -> Vec<Option<usize>> {
        let n = self.order.len();
        let (mut parent, mut ancestor) = (vec![None; n], vec![None; n]);
        for k in 0..n {
            for mut i in self.row(k).filter(|i| *i < k) {
                // Climb to the root of the subtree that contains i; this root becomes a child of k.
                while i < k {
                    match ancestor[i].replace(k) {
                        Some(up) => i = up,
                        None => {
                            parent[i] = Some(k);
                            break;
                        }
                    }
                }
            }
        }
        parent
    }

    /// Returns the number of entries in each column of the factor, the diagonal included.
    ///
    /// The pattern of row k of the factor is a subtree of the elimination tree: the paths from the entries of row k of
    /// the matrix to node k.
    pub fn column_counts(&self) -> Vec<usize> {
        let n = self.order.len();
        let (mut counts, mut seen) = (vec![1; n], vec![usize::MAX; n]);
        for k in 0..n {
            seen[k] = k;
            for j in self.row(k).filter(|j| *j < k) {
                let mut at = Some(j);
                while let Some(j) = at.filter(|j| seen[*j] != k) {
                    seen[j] = k;
                    counts[j] += 1;
                    at = self.parent[j];
                }
            }
        }
        counts
    }
}

/// Returns the inverse of a permutation.
fn inverse(order: &[usize]) -> Vec<usize> {
    let mut at = vec![0; order.len()];
    for (k, v) in order.iter().enumerate() {
        at[*v] = k;
    }
    at
}

/// Returns an order of the tree's nodes with children before parents and every subtree consecutive.
fn postorder(parent: &[Option<usize>]) -> Vec<usize> {
    let n = parent.len();
    // The children are stored as linked lists: the first child of each node, and the next sibling.
    let mut first_child: Vec<Option<usize>> = vec![None; n];
    let mut next: Vec<Option<usize>> = vec![None; n];
    let mut roots = None;
    for k in (0..n).rev() {
        let head = match parent[k] {
            Some(p) => &mut first_child[p],
            None => &mut roots,
        };
        next[k] = head.replace(k);
    }
    let (mut post, mut stack) = (Vec::with_capacity(n), Vec::new());
    // The search is depth first and without recursion, because the tree of a chain is as deep as the chain is long.
    while let Some(root) = roots {
        roots = next[root];
        stack.push(root);
        while let Some(k) = stack.last() {
            match first_child[*k].take() {
                Some(child) => {
                    first_child[*k] = next[child];
                    stack.push(child);
                }
                None => post.extend(stack.pop()),
            }
        }
    }
    post
}
