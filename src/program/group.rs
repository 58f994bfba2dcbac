//! [`Group`]: blocks that can influence each other, found by following interfaces that avoid the ground.

use crate::interface::Interface;
use crate::scene::{BlockId, BodyId, Frame};

/// Blocks that can influence each other, with all that acts on them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Group {
    /// The blocks, by number.
    pub blocks: Vec<BlockId>,
    /// The interfaces that touch them, as numbers among the frame's.
    pub interfaces: Vec<usize>,
    /// The holds on them, as numbers among the frame's.
    pub holds: Vec<usize>,
}

/// Splits a frame into groups, in the order of their first blocks.
///
/// Two blocks are in one group when a chain of interfaces leads from one to the other without passing the ground.
pub fn groups(blocks: usize, frame: &Frame, interfaces: &[&Interface]) -> Vec<Group> {
    let mut parent: Vec<usize> = (0..blocks).collect();
    for interface in interfaces {
        if let [BodyId::Block(a), BodyId::Block(b)] = interface.bodies {
            let (a, b) = (root(&mut parent, a.0), root(&mut parent, b.0));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut placed: Vec<BlockId> = frame.placed.clone();
    placed.sort();
    let mut number = vec![usize::MAX; blocks];
    let mut groups: Vec<Group> = Vec::new();
    for block in placed {
        let r = root(&mut parent, block.0);
        if number[r] == usize::MAX {
            number[r] = groups.len();
            groups.push(Group {
                blocks: Vec::new(),
                interfaces: Vec::new(),
                holds: Vec::new(),
            });
        }
        groups[number[r]].blocks.push(block);
    }
    for (i, interface) in interfaces.iter().enumerate() {
        if let BodyId::Block(block) = interface.bodies[0] {
            groups[number[root(&mut parent, block.0)]]
                .interfaces
                .push(i);
        }
    }
    for (i, hold) in frame.holds.iter().enumerate() {
        groups[number[root(&mut parent, hold.block.0)]]
            .holds
            .push(i);
    }
    groups
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}
