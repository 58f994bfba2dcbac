//! [`Assembly::components`]: splits an assembly into parts that cannot influence each other.

use super::{Assembly, AssemblyContact, AssemblyGrip};

impl Assembly {
    /// Returns the connected components of the assembly, in the order of their first bodies.
    ///
    /// Two bodies are in one component if a chain of contacts connects them without passing through the ground. All
    /// components keep the length L of the whole assembly, so that torques have the same weight in each of them.
    pub fn components(&self) -> Vec<Assembly> {
        let mut sets = DisjointSets::new(self.bodies.len());
        for contact in &self.contacts {
            if let Some(from) = contact.from {
                sets.union(contact.on, from);
            }
        }
        let mut parts: Vec<Assembly> = Vec::new();
        // `part_of_root` contains the component of each root of the disjoint sets. `place` contains, for each body, its
        // component and its index in this component.
        let mut part_of_root: Vec<Option<usize>> = vec![None; self.bodies.len()];
        let mut place = Vec::with_capacity(self.bodies.len());
        for (number, body) in self.bodies.iter().enumerate() {
            let root = sets.find(number);
            let part = *part_of_root[root].get_or_insert_with(|| {
                parts.push(Assembly { bodies: Vec::new(), contacts: Vec::new(), grips: Vec::new(), ..*self });
                parts.len() - 1
            });
            place.push((part, parts[part].bodies.len()));
            parts[part].bodies.push(body.clone());
        }
        for contact in &self.contacts {
            let (part, on) = place[contact.on];
            parts[part].contacts.push(AssemblyContact { on, from: contact.from.map(|body| place[body].1), ..*contact });
        }
        for grip in &self.grips {
            let (part, body) = place[grip.body];
            parts[part].grips.push(AssemblyGrip { body, ..*grip });
        }
        parts
    }

    /// True if no body has a contact with the ground and no robot holds a body.
    pub fn is_unsupported(&self) -> bool {
        self.grips.is_empty() && self.contacts.iter().all(|c| c.from.is_some())
    }
}

/// A partition of 0 … n − 1 into disjoint sets (union-find with path halving); each set is named by its least member.
///
/// Reference: Tarjan and van Leeuwen, Worst-Case Analysis of Set Union Algorithms, 1984.
pub(crate) struct DisjointSets {
    parent: Vec<usize>,
}

impl DisjointSets {
    /// Creates `count` sets. Each contains one of the numbers 0 … `count` − 1.
    pub fn new(count: usize) -> DisjointSets {
        DisjointSets { parent: (0..count).collect() }
    }

    /// Returns the least member of the set that contains `number`.
    pub fn find(&mut self, mut number: usize) -> usize {
        while self.parent[number] != number {
            self.parent[number] = self.parent[self.parent[number]];
            number = self.parent[number];
        }
        number
    }

    /// Merges the sets that contain `one` and `other`.
    pub fn union(&mut self, one: usize, other: usize) {
        let (one, other) = (self.find(one), self.find(other));
        self.parent[one.max(other)] = one.min(other);
    }
}
