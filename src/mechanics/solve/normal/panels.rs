//! [`Supernodes`]: the order of elimination, and which rows every column of the factor has.
//!
//! Columns with the same rows below them make a panel, a dense matrix. A panel joins the one above it where few zeros come
//! in. Literature: Davis, Direct Methods for Sparse Linear Systems, 2006, chapters 4 and 7.

use std::ops::Range;

use super::elements::Elements;

/// Columns that have the same rows below them.
#[derive(Clone, Debug)]
pub(super) struct Supernode {
    /// The first of its columns.
    pub first: usize,
    /// How many there are.
    pub width: usize,
    /// Its rows below them, in [`Supernodes::rows`].
    pub rows: Range<usize>,
    /// How many panels hand their products to it.
    pub children: usize,
}

/// A factor without its values.
#[derive(Clone, Debug)]
pub(super) struct Supernodes {
    /// The position of each unknown in the order of elimination.
    pub position: Vec<u32>,
    /// Children stand before their parents, families side by side.
    pub panels: Vec<Supernode>,
    /// The rows of all panels, as positions.
    pub rows: Vec<u32>,
}

impl Supernodes {
    /// Of Σ weight·column·columnᵀ; `None` where no order is found.
    pub fn new(elements: &Elements) -> Option<Supernodes> {
        let graph = Graph::new(elements);
        let count = i32::try_from(graph.count()).ok()?;
        let (starts, list) = graph.as_i32()?;
        let (order, _, _) = amd::order(count, &starts, &list, &amd::Control::default()).ok()?;
        let order: Vec<usize> = order.iter().map(|k| *k as usize).collect();
        let ordered = Ordered {
            graph: &graph,
            position: &inverse(&order),
            order: &order,
        };
        let parent = ordered.tree();
        let post = postorder(&parent);
        let again = inverse(&post);
        let order: Vec<usize> = post.iter().map(|k| order[*k]).collect();
        let parents = post.iter().map(|k| parent[*k].map(|p| again[p]));
        let parent: Vec<Option<usize>> = parents.collect();
        let position = inverse(&order);
        let ordered = Ordered {
            graph: &graph,
            position: &position,
            order: &order,
        };
        let groups = groups(&parent, &ordered.heights(&parent));
        let (panels, rows) = ordered.panels(&groups);
        Some(Supernodes {
            position: position.iter().map(|k| *k as u32).collect(),
            panels,
            rows,
        })
    }
}

/// For every unknown those that share a column with it, itself among them, in order.
struct Graph {
    starts: Vec<usize>,
    list: Vec<u32>,
}

impl Graph {
    fn new(elements: &Elements) -> Graph {
        let n = elements.unknowns();
        let mut begin = vec![0; n + 1];
        let families = || (0..elements.families()).map(|k| elements.family(k).places);
        for place in families().flatten() {
            begin[*place as usize + 1] += 1;
        }
        for k in 0..n {
            begin[k + 1] += begin[k];
        }
        let mut next = begin.clone();
        let mut families_of = vec![0; begin[n]];
        for (k, places) in families().enumerate() {
            for place in places {
                families_of[next[*place as usize]] = k;
                next[*place as usize] += 1;
            }
        }
        let mut graph = Graph {
            starts: Vec::with_capacity(n + 1),
            // The crate that orders wants the diagonal: it subtracts it from the count.
            list: Vec::new(),
        };
        graph.starts.push(0);
        let mut seen = vec![usize::MAX; n];
        for unknown in 0..n {
            let first = graph.list.len();
            seen[unknown] = unknown;
            graph.list.push(unknown as u32);
            for k in &families_of[begin[unknown]..begin[unknown + 1]] {
                for other in elements.family(*k).places {
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

    /// The same in the numbers of the crate that orders; `None` where there are too many.
    fn as_i32(&self) -> Option<(Vec<i32>, Vec<i32>)> {
        let starts = self.starts.iter().map(|k| i32::try_from(*k).ok());
        let list = self.list.iter().map(|k| i32::try_from(*k).ok());
        Some((starts.collect::<Option<_>>()?, list.collect::<Option<_>>()?))
    }
}

/// The matrix in an order of elimination.
struct Ordered<'a> {
    graph: &'a Graph,
    /// The unknown at each position.
    order: &'a [usize],
    /// The position of each unknown.
    position: &'a [usize],
}

impl Ordered<'_> {
    /// Positions of the entries of the row at a position.
    fn row(&self, k: usize) -> impl Iterator<Item = usize> {
        let unknown = self.order[k];
        let of = self.graph.starts[unknown]..self.graph.starts[unknown + 1];
        let others = self.graph.list[of].iter();
        others.map(|other| self.position[*other as usize])
    }

    /// The elimination tree: the parent of a column is the first row below its diagonal.
    fn tree(&self) -> Vec<Option<usize>> {
        let n = self.order.len();
        let (mut parent, mut ancestor) = (vec![None; n], vec![None; n]);
        for k in 0..n {
            for mut i in self.row(k).filter(|i| *i < k) {
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

    /// How many entries each column of the factor has, the diagonal among them.
    fn heights(&self, parent: &[Option<usize>]) -> Vec<usize> {
        let n = self.order.len();
        let (mut heights, mut seen) = (vec![1; n], vec![usize::MAX; n]);
        for k in 0..n {
            seen[k] = k;
            for j in self.row(k).filter(|j| *j < k) {
                let mut at = Some(j);
                while let Some(j) = at.filter(|j| seen[*j] != k) {
                    seen[j] = k;
                    heights[j] += 1;
                    at = parent[j];
                }
            }
        }
        heights
    }

    /// The rows of every panel: those of the matrix, and those of the panels that hand on to it.
    fn panels(&self, groups: &[Group]) -> (Vec<Supernode>, Vec<u32>) {
        let n = self.order.len();
        let mut of_column = vec![0; n];
        for (g, group) in groups.iter().enumerate() {
            of_column[group.first..group.end()].fill(g);
        }
        let mut panels: Vec<Supernode> = Vec::with_capacity(groups.len());
        let mut rows: Vec<u32> = Vec::new();
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); groups.len()];
        let mut seen = vec![usize::MAX; n];
        for (g, group) in groups.iter().enumerate() {
            let begin = rows.len();
            let mut meet = |i: usize, rows: &mut Vec<u32>| {
                if i >= group.end() && seen[i] != g {
                    seen[i] = g;
                    rows.push(i as u32);
                }
            };
            for k in group.first..group.end() {
                self.row(k).for_each(|i| meet(i, &mut rows));
            }
            let own = std::mem::take(&mut children[g]);
            for child in &own {
                for k in panels[*child].rows.clone() {
                    meet(rows[k] as usize, &mut rows);
                }
            }
            rows[begin..].sort_unstable();
            if let Some(first) = rows.get(begin) {
                children[of_column[*first as usize]].push(g);
            }
            panels.push(Supernode {
                first: group.first,
                width: group.width,
                rows: begin..rows.len(),
                children: own.len(),
            });
        }
        (panels, rows)
    }
}

/// Columns that are to make one panel.
struct Group {
    first: usize,
    width: usize,
    /// Rows below them.
    rows: usize,
    /// Entries that are kept although they are 0.
    zeros: f64,
}

impl Group {
    fn end(&self) -> usize {
        self.first + self.width
    }

    /// This panel and the one above it as one; `None` where too many zeros would come in.
    fn joined(&self, above: &Group) -> Option<Group> {
        let width = self.width + above.width;
        let new = self.width * (above.width + above.rows).saturating_sub(self.rows);
        let zeros = self.zeros + above.zeros + new as f64;
        let all = 0.5 * (width * width) as f64 + (width * above.rows) as f64;
        let share = zeros / all;
        let few = match width {
            0..=6 => true,
            7..=16 => share < 0.5,
            17..=48 => share < 0.15,
            _ => share < 0.05,
        };
        few.then_some(Group {
            first: self.first,
            width,
            rows: above.rows,
            zeros,
        })
    }
}

/// Gathers columns of equal rows, then panels with those above them.
fn groups(parent: &[Option<usize>], heights: &[usize]) -> Vec<Group> {
    let n = parent.len();
    let mut children = vec![0; n];
    for p in parent.iter().flatten() {
        children[*p] += 1;
    }
    let follows =
        |k: usize| parent[k - 1] == Some(k) && heights[k - 1] == heights[k] + 1 && children[k] == 1;
    let firsts: Vec<usize> = (0..n).filter(|k| *k == 0 || !follows(*k)).collect();
    let mut groups: Vec<Group> = Vec::new();
    for (k, first) in firsts.iter().enumerate() {
        let end = firsts.get(k + 1).copied().unwrap_or(n);
        let mut group = Group {
            first: *first,
            width: end - first,
            rows: heights[end - 1] - 1,
            zeros: 0.0,
        };
        // The last of its children stands just before it.
        while let Some(last) = groups.last() {
            let above = parent[last.end() - 1];
            if !above.is_some_and(|p| (group.first..group.end()).contains(&p)) {
                break;
            }
            let Some(joined) = last.joined(&group) else {
                break;
            };
            groups.pop();
            group = joined;
        }
        groups.push(group);
    }
    groups
}

fn inverse(order: &[usize]) -> Vec<usize> {
    let mut at = vec![0; order.len()];
    for (k, v) in order.iter().enumerate() {
        at[*v] = k;
    }
    at
}

/// An order in which children stand before their parents, families side by side.
fn postorder(parent: &[Option<usize>]) -> Vec<usize> {
    let n = parent.len();
    let mut children: Vec<Option<usize>> = vec![None; n];
    let mut next: Vec<Option<usize>> = vec![None; n];
    let mut roots = None;
    for k in (0..n).rev() {
        let head = match parent[k] {
            Some(p) => &mut children[p],
            None => &mut roots,
        };
        next[k] = head.replace(k);
    }
    let (mut post, mut stack) = (Vec::with_capacity(n), Vec::new());
    while let Some(root) = roots {
        roots = next[root];
        stack.push(root);
        while let Some(k) = stack.last() {
            match children[*k].take() {
                Some(child) => {
                    children[*k] = next[child];
                    stack.push(child);
                }
                None => post.extend(stack.pop()),
            }
        }
    }
    post
}
