//! Components: bodies that can influence each other, found by following contacts that avoid the ground.

use super::{Assembly, AssemblyContact, AssemblyGrip};

impl Assembly {
    /// Parts the assembly into components, in the order of their first bodies.
    ///
    /// Two bodies are in one component when a chain of contacts leads from one to the other without passing the ground.
    /// L stays that of the whole, so that torques weigh alike everywhere.
    pub fn components(&self) -> Vec<Assembly> {
        let mut sets = DisjointSets::new(self.bodies.len());
        for contact in &self.contacts {
            if let Some(from) = contact.from {
                sets.union(contact.on, from);
            }
        }
        let mut parts: Vec<Assembly> = Vec::new();
        // By root the component's number; by body its component and its number there.
        let mut part_of_root: Vec<Option<usize>> = vec![None; self.bodies.len()];
        let mut place = Vec::with_capacity(self.bodies.len());
        for (number, body) in self.bodies.iter().enumerate() {
            let root = sets.find(number);
            let part = *part_of_root[root].get_or_insert_with(|| {
                parts.push(Assembly {
                    bodies: Vec::new(),
                    contacts: Vec::new(),
                    grips: Vec::new(),
                    ..*self
                });
                parts.len() - 1
            });
            place.push((part, parts[part].bodies.len()));
            parts[part].bodies.push(body.clone());
        }
        for contact in &self.contacts {
            let (part, on) = place[contact.on];
            parts[part].contacts.push(AssemblyContact {
                on,
                from: contact.from.map(|body| place[body].1),
                ..*contact
            });
        }
        for grip in &self.grips {
            let (part, body) = place[grip.body];
            parts[part].grips.push(AssemblyGrip { body, ..*grip });
        }
        parts
    }

    /// Whether it touches no ground and nobody holds it.
    pub fn is_unsupported(&self) -> bool {
        self.grips.is_empty() && self.contacts.iter().all(|c| c.from.is_some())
    }
}

/// Disjoint sets of numbers, each known by its least member.
pub(crate) struct DisjointSets {
    above: Vec<usize>,
}

impl DisjointSets {
    /// So many numbers, each a set of its own.
    pub fn new(count: usize) -> DisjointSets {
        DisjointSets {
            above: (0..count).collect(),
        }
    }

    /// The least member of a number's set.
    pub fn find(&mut self, mut number: usize) -> usize {
        while self.above[number] != number {
            self.above[number] = self.above[self.above[number]];
            number = self.above[number];
        }
        number
    }

    /// Makes the sets of two numbers one.
    pub fn union(&mut self, one: usize, other: usize) {
        let (one, other) = (self.find(one), self.find(other));
        self.above[one.max(other)] = one.min(other);
    }
}
