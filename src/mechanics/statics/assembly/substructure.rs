//! [`Substructure`]: a selection of the bodies of an assembly. All other bodies are fixed.

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
        let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); self.bodies.len()];
        for contact in &self.contacts {
            if let Some(from) = contact.from {
                neighbours[contact.on].push(from);
                neighbours[from].push(contact.on);
            }
        }
        let mut seen = vec![false; self.bodies.len()];
        let mut sets = Vec::new();
        for first in (0..self.bodies.len()).filter(|k| member[*k]) {
            if seen[first] {
                continue;
            }
            // Find the component by breadth-first search from its first body.
            seen[first] = true;
            let mut set = vec![first];
            let mut next = 0;
            while let Some(body) = set.get(next).copied() {
                next += 1;
                for other in &neighbours[body] {
                    if member[*other] && !seen[*other] {
                        seen[*other] = true;
                        set.push(*other);
                    }
                }
            }
            set.sort_unstable();
            sets.push(set);
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
