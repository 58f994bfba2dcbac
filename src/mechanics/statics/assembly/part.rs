//! Parts of an assembly: [`Assembly::components`] splits it into parts that cannot influence each other, and a
//! [`Substructure`] is a selection of its bodies, with all other bodies fixed.

use super::{Assembly, AssemblyContact, AssemblyGrip};

/// Some bodies of an assembly, with all other bodies fixed as if they were ground.
#[derive(Clone, Debug)]
pub struct Substructure {
    /// The selected bodies as an assembly. Its length L is the median length of its edge contacts, or the median radius
    /// of its bodies if it has none.
    pub assembly: Assembly,
    /// For each body of the substructure: its index in the whole assembly.
    pub bodies: Vec<usize>,
    /// For each contact of the substructure: its index in the whole assembly.
    ///
    /// The forces N1, N2 and T have the same values in both assemblies. If the two bodies of a contact are exchanged
    /// here, its normal and tangent are reversed too.
    pub contacts: Vec<usize>,
    /// For each grip of the substructure: its index in the whole assembly.
    pub grips: Vec<usize>,
}

impl Assembly {
    /// Returns the substructure of the bodies with these indices. The indices must be in ascending order.
    pub fn substructure(&self, bodies: &[usize]) -> Substructure {
        let mut place = vec![None; self.bodies.len()];
        for (number, body) in bodies.iter().enumerate() {
            place[*body] = Some(number);
        }
        let (mut contacts, mut grips) = (Vec::new(), Vec::new());
        let mut part = Assembly {
            bodies: bodies.iter().map(|k| self.bodies[*k].clone()).collect(),
            contacts: Vec::new(),
            grips: Vec::new(),
            ..*self
        };
        for (number, contact) in self.contacts.iter().enumerate() {
            let from = contact.from.and_then(|body| place[body]);
            let Some(seen) = contact.with_bodies(place[contact.on], from) else {
                continue;
            };
            part.contacts.push(seen);
            contacts.push(number);
        }
        for (number, grip) in self.grips.iter().enumerate() {
            if let Some(body) = place[grip.body] {
                part.grips.push(AssemblyGrip { body, ..*grip });
                grips.push(number);
            }
        }
        // The length L of the part is the median length of its edge contacts, or else the median radius of its bodies.
        let lengths = part.contacts.iter().map(|c| (c.ends[1] - c.ends[0]).norm());
        let lengths: Vec<f64> = lengths.filter(|length| *length > 0.0).collect();
        let radii = part.bodies.iter().map(|body| body.radius());
        part.length = super::median(lengths).or_else(|| super::median(radii.collect())).unwrap_or(self.length);
        Substructure { assembly: part, bodies: bodies.to_vec(), contacts, grips }
    }

    /// Returns the connected components of the bodies for which `member` is true, as lists of body indices in ascending
    /// order. Two bodies are connected if there is a contact between them.
    pub fn connected(&self, member: &[bool]) -> Vec<Vec<usize>> {
        let mut joined = DisjointSets::new(self.bodies.len());
        for contact in &self.contacts {
            if let Some(from) = contact.from.filter(|from| member[*from] && member[contact.on]) {
                joined.union(contact.on, from);
            }
        }
        // A set is named by its least member, which comes first.
        let mut number_of_root = vec![0; self.bodies.len()];
        let mut sets: Vec<Vec<usize>> = Vec::new();
        for body in (0..self.bodies.len()).filter(|body| member[*body]) {
            let root = joined.find(body);
            if root == body {
                number_of_root[root] = sets.len();
                sets.push(Vec::new());
            }
            sets[number_of_root[root]].push(body);
        }
        sets
    }
}

impl AssemblyContact {
    /// Returns this contact for another assembly, in which its two bodies have the indices `on` and `from`. The index
    /// `None` means the ground. Returns `None` if both are the same body or both are the ground.
    ///
    /// If the first body becomes ground, the two bodies are exchanged, because the first body is never the ground.
    fn with_bodies(&self, on: Option<usize>, from: Option<usize>) -> Option<AssemblyContact> {
        match (on, from) {
            _ if on == from => None,
            (Some(on), from) => Some(AssemblyContact { on, from, ..*self }),
            (None, Some(from)) => Some(AssemblyContact {
                on: from,
                from: None,
                bodies: [self.bodies[1], self.bodies[0]],
                normal: -self.normal,
                ..*self
            }),
            (None, None) => None,
        }
    }
}

impl Assembly {
    /// Returns the connected components of the assembly, in the order of their first bodies.
    ///
    /// Two bodies are in one component if a chain of contacts connects them without passing through the ground. All
    /// components keep the length L of the whole assembly, so that torques have the same weight in each of them.
    pub fn components(&self) -> Vec<Assembly> {
        let sets = self.connected(&vec![true; self.bodies.len()]);
        // For each body: its component, and its index in this component.
        let mut place = vec![(0, 0); self.bodies.len()];
        let part = |(number, set): (usize, &Vec<usize>)| {
            set.iter().enumerate().for_each(|(index, body)| place[*body] = (number, index));
            let bodies = set.iter().map(|body| self.bodies[*body].clone()).collect();
            Assembly { bodies, contacts: Vec::new(), grips: Vec::new(), ..*self }
        };
        let mut parts: Vec<Assembly> = sets.iter().enumerate().map(part).collect();
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
