//! Branch and bound over the patterns of pressing and sliding: a proof that no springs come to rest.
//!
//! A node decides of some points whether they press and of some faces how they slide. Its relaxation holds the others only by
//! N ≥ 0, N ≥ −g and |T| ≤ μ(N1 + N2). Together with the balance, the robots' limits and the fact that springs at rest hold no
//! more energy than the loads gave them, these are linear in displacements and forces. Steps for each node:
//!
//! 1. solve the relaxation;
//! 2. if it is infeasible, check the multipliers that show it (Farkas), and prune the node;
//! 3. if it has a solution, try to complete it to springs at rest;
//! 4. else branch on the point or face that misses the law most.
//!
//! The pruned nodes cover all patterns. So their multipliers together are the certificate.

use super::certificate::proves_infeasible;
use super::node::{Node, RuledOut};
use super::relaxation::VariableLayout;
use super::spring::Springs;
use crate::program::Program;
use crate::solve::{Conditioning, Status, TOLERANCE, solve};

/// Nodes explored before the question stays open.
const MAX_NODES: usize = 1500;

/// Rows of all relaxations together: large structures get fewer nodes.
const MAX_ROWS: usize = 100_000;

/// The result of the search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Search {
    /// No springs come to rest. These nodes cover all patterns, and each was ruled out.
    NoRest(Vec<RuledOut>),
    /// Springs come to rest.
    Rests,
    /// Too many nodes, or one that was neither ruled out nor led to rest.
    Open,
}

/// Searches all patterns, depth first.
pub(super) fn search(program: &Program) -> Search {
    let springs = Springs::new(program, 1.0);
    let layout = VariableLayout::new(&springs);
    let mut open_nodes = vec![Node::root(&springs)];
    let (mut explored, mut rows) = (0, 0);
    let mut ruled_out = Vec::new();
    while let Some(node) = open_nodes.pop() {
        let relaxation = layout.relaxation(&springs, &node);
        (explored, rows) = (explored + 1, rows + relaxation.bound.len());
        if explored > MAX_NODES || rows > MAX_ROWS {
            return Search::Open;
        }
        let answer = solve(&relaxation, TOLERANCE, Conditioning::Full);
        let branch = match answer.status {
            Status::Infeasible if proves_infeasible(&relaxation, &answer.z, program) => {
                ruled_out.push(node.described(&springs));
                continue;
            }
            Status::Solved => {
                if leads_to_rest(program, &springs, &layout, &node, &answer.x) {
                    return Search::Rests;
                }
                layout.most_violated(&springs, &node, &answer.x)
            }
            // Without an answer the node is branched on all the same: its children have more equalities.
            _ => node.first_open(&springs),
        };
        let Some(branch) = branch else {
            return Search::Open;
        };
        open_nodes.extend(node.children(branch));
    }
    Search::NoRest(ruled_out)
}

/// Whether springs come to rest in the pattern that a solution of a relaxation has, with or without the node's decisions.
fn leads_to_rest(
    program: &Program,
    springs: &Springs,
    layout: &VariableLayout,
    node: &Node,
    x: &[f64],
) -> bool {
    let u = &x[..program.loads.len()];
    // Robots' springs yield around given forces. Here they are to give what the solution has, at its displacements.
    let components = layout.grips(x).iter().zip(&springs.grips);
    let given: Vec<f64> = components.map(|(f, g)| f + g.column.dot(u)).collect();
    let robots = Springs::around(program, &given, 1.0);
    let pattern = robots.pattern(u, &robots.all_pressed());
    [node.impose_on(&pattern), pattern]
        .iter()
        .any(|pattern| robots.rest(pattern, u).is_some())
}
