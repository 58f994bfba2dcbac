//! Branch and bound over the patterns of pressing points and sliding faces. The search finds a pattern in which the
//! springs come to rest, or proves that there is none.
//!
//! A node decides whether some points press and how some faces slide. For the other points and faces, the relaxation of
//! the node requires only N ≥ 0, N ≥ −g and |T| ≤ μ(N1 + N2), where g is the opening of a point. Further rows are the
//! balance and the robots' limits. Without robots, one more row requires that the loads do no negative work. All rows
//! are linear in displacements and forces. Steps for each node:
//!
//! 1. solve the relaxation;
//! 2. if it is infeasible, check the multipliers that prove it (Farkas), and prune the node;
//! 3. if it has a solution, try to find springs at rest with the pattern of this solution;
//! 4. otherwise branch on the point or face that violates the springs' law most.
//!
//! The pruned nodes together cover all patterns, so their multipliers together are the certificate. Reference: Wolsey,
//! Integer Programming, 1998, chapter 7 (branch and bound).

use super::certificate::proves_infeasible;
use super::node::{Node, RuledOut};
use super::relaxation::VariableLayout;
use super::spring::Springs;
use crate::mechanics::program::Program;
use crate::mechanics::solve::{Conditioning, Status, TOLERANCE, is_late, solve};

/// The largest number of explored nodes. After that, the search ends undecided.
const MAX_NODES: usize = 1500;

/// The largest total number of rows of all relaxations. It limits the time for large structures, which get fewer nodes.
const MAX_ROWS: usize = 100_000;

/// The result of the search.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum SearchOutcome {
    /// The springs have no state of rest: the listed nodes cover all patterns, and each was ruled out.
    NoRest(Vec<RuledOut>),
    /// A pattern was found in which the springs come to rest.
    RestFound,
    /// Undecided: too many nodes, or a node that was neither ruled out nor led to a state of rest.
    Undecided,
}

/// Searches the patterns of pressing points and sliding faces, depth first, for a state of rest or for a proof that
/// there is none.
pub(super) fn search(program: &Program) -> SearchOutcome {
    let springs = Springs::new(program, 1.0);
    let layout = VariableLayout::new(&springs);
    let mut open_nodes = vec![Node::root(&springs)];
    let (mut explored, mut rows) = (0, 0);
    let mut ruled_out = Vec::new();
    while let Some(node) = open_nodes.pop() {
        let relaxation = layout.relaxation(&springs, &node);
        (explored, rows) = (explored + 1, rows + relaxation.bound.len());
        if explored > MAX_NODES || rows > MAX_ROWS || is_late() {
            return SearchOutcome::Undecided;
        }
        // Step 1: solve the relaxation.
        let answer = solve(&relaxation, TOLERANCE, Conditioning::Full);
        let branch = match answer.status {
            // Step 2: prune the node if the certificate is valid.
            Status::Infeasible if proves_infeasible(&relaxation, &answer.z, program) => {
                ruled_out.push(node.ruled_out(&springs));
                continue;
            }
            // Steps 3 and 4: complete the solution, or find where to branch.
            Status::Solved => {
                if leads_to_rest(program, &springs, &layout, &node, &answer.x) {
                    return SearchOutcome::RestFound;
                }
                layout.most_violated(&springs, &node, &answer.x)
            }
            // If the solver has no result, or if its certificate is not valid, branch too: the children have more
            // equalities and may be easier to decide.
            _ => node.first_open(&springs),
        };
        let Some(branch) = branch else {
            return SearchOutcome::Undecided;
        };
        open_nodes.extend(node.children(branch));
    }
    SearchOutcome::NoRest(ruled_out)
}

/// True if the springs come to rest in the pattern of a relaxation's solution `x`. Tries this pattern as it is, and
/// with the decisions of the node imposed on it.
fn leads_to_rest(program: &Program, springs: &Springs, layout: &VariableLayout, node: &Node, x: &[f64]) -> bool {
    let u = &x[..program.loads.len()];
    // A robot's spring exerts its given force at displacement 0. Choose the given forces so that, at the displacements
    // of the solution, the springs exert the robots' forces of the solution.
    let components = layout.grips(x).iter().zip(&springs.grips);
    let given: Vec<f64> = components.map(|(f, g)| f + g.column.dot(u)).collect();
    let robots = Springs::with_given_forces(program, &given, 1.0);
    let pattern = robots.pattern(u, &robots.all_pressed());
    [node.impose_on(&pattern), pattern].iter().any(|pattern| robots.rest(pattern, u).is_some())
}
