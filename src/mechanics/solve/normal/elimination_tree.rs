//! Finds the order of elimination of a sparse symmetric matrix, its elimination tree and the column counts of its
//! factor.
//!
//! Steps: approximate minimum degree order (crate `amd`), or nested dissection for large graphs, elimination tree,
//! postorder of the tree, column counts.
//! Reference: Davis, Direct Methods for Sparse Linear Systems, SIAM 2006, chapters 4 and 7.

use super::graph::Graph;
use super::nested_dissection;

/// Graphs of fewer unknowns are ordered by minimum degree alone: nested dissection saves little there. 3 000 unknowns are
/// 1 000 blocks.
const MIN_DISSECTED: usize = 3000;

/// The pattern of the matrix in the order of elimination, with the elimination tree.
pub(super) struct OrderedGraph<'a> {
    graph: &'a Graph,
    /// The unknown at each position.
    order: Vec<usize>,
    /// The position of each unknown.
    pub position: Vec<usize>,
    /// The parent of each column in the elimination tree. Children come before their parents, and the columns of a subtree
    /// are consecutive.
    pub parent: Vec<Option<usize>>,
}

impl<'a> OrderedGraph<'a> {
    /// Finds an order of elimination with little fill-in, and sorts it into a postorder of the elimination tree. `None`
    /// if the graph is too large for 32-bit indices or `amd` finds no order.
    ///
    /// For large graphs, the order by nested dissection is tried too. It is taken if its factor takes fewer operations.
    pub fn new(graph: &'a Graph) -> Option<OrderedGraph<'a>> {
        let by_degree = OrderedGraph::with_order(graph, graph.by_minimum_degree()?);
        if graph.count() < MIN_DISSECTED {
            return Some(by_degree);
        }
        let Some(order) = nested_dissection::order(graph) else {
            return Some(by_degree);
        };
        let dissected = OrderedGraph::with_order(graph, order);
        let is_better = dissected.operations() < by_degree.operations();
        Some(if is_better { dissected } else { by_degree })
    }

    /// Sorts an order of elimination into a postorder of its elimination tree. This has the same fill-in and makes
    /// columns with equal rows consecutive.
    fn with_order(graph: &'a Graph, order: Vec<usize>) -> OrderedGraph<'a> {
        let given = OrderedGraph {
            graph,
            position: inverse(&order),
            order,
            parent: Vec::new(),
        };
        let parent = given.elimination_tree();
        let post = postorder(&parent);
        let new_position = inverse(&post);
        let order: Vec<usize> = post.iter().map(|k| given.order[*k]).collect();
        let parents = post.iter().map(|k| parent[*k].map(|p| new_position[p]));
        OrderedGraph {
            graph,
            position: inverse(&order),
            parent: parents.collect(),
            order,
        }
    }

    /// Returns the number of multiplications of a factorization in this order.
    fn operations(&self) -> f64 {
        let counts = self.column_counts();
        counts.iter().map(|count| (count * count) as f64).sum()
    }

    /// Returns the positions, in the order of elimination, of the entries in the row at position `k`.
    pub fn row(&self, k: usize) -> impl Iterator<Item = usize> {
        let unknown = self.order[k];
        let others = self.graph.neighbours(unknown).iter();
        others.map(|other| self.position[*other as usize])
    }

    /// Returns the elimination tree: the parent of a column is the first row below the diagonal in which the factor
    /// has an entry.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::normal::column_groups::ColumnGroups;

    /// The graph of a square wall: every block has three unknowns and touches its four neighbours and one on a diagonal.
    fn wall(side: usize) -> Graph {
        let at = |x: usize, y: usize| 3 * (x * side + y);
        let mut columns: Vec<[usize; 2]> = Vec::new();
        for (x, y) in (0..side * side).map(|k| (k / side, k % side)) {
            let others = [(x + 1, y), (x, y + 1), (x + 1, y + 1)];
            let inside = others.into_iter().filter(|(x, y)| *x < side && *y < side);
            columns.extend(inside.map(|(i, j)| [at(x, y), at(i, j)]));
        }
        let numbered = columns.iter().enumerate();
        let entries = numbered.flat_map(|(k, blocks)| {
            let rows = blocks.iter().flat_map(|first| *first..first + 3);
            rows.map(move |row| (k, row, 1.0))
        });
        Graph::new(&ColumnGroups::new(3 * side * side, columns.len(), entries))
    }

    /// An order by nested dissection contains every unknown once. In a wall of 10 000 blocks, its factor takes fewer
    /// operations than that of the order by minimum degree, and the operations grow at most with the power 1.6.
    #[test]
    fn nested_dissection_takes_fewer_operations_in_large_walls() {
        let operations = [50, 100].map(|side| {
            let graph = wall(side);
            let order = nested_dissection::order(&graph).expect("an order");
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(
                sorted.iter().copied().eq(0..3 * side * side),
                "a permutation"
            );
            let by_degree = graph.by_minimum_degree().expect("an order");
            [order, by_degree].map(|order| OrderedGraph::with_order(&graph, order).operations())
        });
        let [[small, _], [large, by_degree]] = operations;
        assert!(large < 0.95 * by_degree, "{large:e} and {by_degree:e}");
        assert!(large < small * 4.0_f64.powf(1.6), "{small:e} to {large:e}");
        let graph = wall(100);
        let chosen = OrderedGraph::new(&graph).expect("an order");
        assert!(chosen.operations() <= large);
    }

    /// Parts that are not connected, and a single block, are ordered too.
    #[test]
    fn nested_dissection_orders_separate_parts() {
        let towers: Vec<(usize, usize, f64)> = (0..3000)
            .filter(|k| k % 10 != 9)
            .flat_map(|k| [(k, 3 * k, 1.0), (k, 3 * k + 3, 1.0)])
            .collect();
        let graph = Graph::new(&ColumnGroups::new(9000, 3000, towers.into_iter()));
        let mut order = nested_dissection::order(&graph).expect("an order");
        order.sort_unstable();
        assert!(order.into_iter().eq(0..9000));
    }
}
