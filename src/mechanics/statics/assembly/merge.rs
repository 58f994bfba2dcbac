//! [`Assembly::merged`]: replaces each group of bodies that move together by one rigid body.

use super::{Assembly, AssemblyBody, AssemblyContact, AssemblyGrip, LoadVector, load_about};
use crate::geometry::{Point, Vector};

impl Assembly {
    /// Returns the assembly in which the bodies of each group are merged into one rigid body.
    ///
    /// `group` contains the number of the group of each body. A body without a group becomes part of the ground. The
    /// centroid of a merged body is the mean of its members' centroids. Contacts within a group or within the ground,
    /// and grips on bodies that become ground, are omitted.
    pub fn merged(&self, group: &[Option<usize>]) -> Assembly {
        let count = group.iter().flatten().max().map_or(0, |last| last + 1);
        let mut members: Vec<Vec<&AssemblyBody>> = vec![Vec::new(); count];
        for (body, group) in self.bodies.iter().zip(group) {
            if let Some(group) = group {
                members[*group].push(body);
            }
        }
        let contacts = self.contacts.iter().filter_map(|contact| {
            let from = contact.from.and_then(|body| group[body]);
            contact.with_bodies(group[contact.on], from)
        });
        let grips = self.grips.iter().filter_map(|grip| Some(AssemblyGrip { body: group[grip.body]?, ..*grip }));
        Assembly {
            bodies: members.iter().filter_map(|list| merged_body(list)).collect(),
            contacts: contacts.collect(),
            grips: grips.collect(),
            ..*self
        }
    }
}

/// Merges several bodies into one rigid body; `None` for an empty list.
fn merged_body(members: &[&AssemblyBody]) -> Option<AssemblyBody> {
    let first = members.first()?;
    let sum: Vector = members.iter().map(|body| body.centroid.coords).sum();
    let centroid = Point::from(sum / members.len() as f64);
    // The load of each member keeps its line of action, so it has an additional moment about the common centroid.
    let summed = |load: fn(&AssemblyBody) -> LoadVector| {
        members.iter().fold(LoadVector::ZERO, |sum, body| {
            let own = load(body);
            sum.plus(load_about(centroid, body.centroid, own.force, own.moment))
        })
    };
    let corners = members.iter().flat_map(|body| body.corners.iter().copied());
    Some(AssemblyBody {
        block: first.block,
        centroid,
        corners: corners.collect(),
        weight: members.iter().map(|body| body.weight).sum(),
        listed: summed(|body| body.listed),
        load: summed(|body| body.load),
    })
}

impl AssemblyContact {
    /// Returns this contact for another assembly, in which its two bodies have the indices `on` and `from`. The index
    /// `None` means the ground. Returns `None` if both are the same body or both are the ground.
    ///
    /// If the first body becomes ground, the two bodies are exchanged, because the first body is never the ground.
    pub(super) fn with_bodies(&self, on: Option<usize>, from: Option<usize>) -> Option<AssemblyContact> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::scene::{BlockId, BodyId};
    use crate::mechanics::statics::interface::ContactKind;

    fn body(number: usize, at: [f64; 2], force: [f64; 2], moment: f64) -> AssemblyBody {
        AssemblyBody {
            block: BlockId(number),
            centroid: Point::new(at[0], at[1]),
            corners: [Point::new(at[0], at[1])].into(),
            weight: 1.0,
            listed: LoadVector::ZERO,
            load: LoadVector { force: Vector::new(force[0], force[1]), moment },
        }
    }

    fn contact(on: usize, from: Option<usize>) -> AssemblyContact {
        let block = |body: usize| BodyId::Block(BlockId(body));
        AssemblyContact {
            interface: 0,
            bodies: [block(on), from.map_or(BodyId::Ground(0), block)],
            on,
            from,
            kind: ContactKind::Edge,
            ends: [Point::origin(); 2],
            points: [Point::origin(); 2],
            normal: Vector::new(0.0, 1.0),
            friction: 0.5,
        }
    }

    /// If a piece moves, its load does the same work as the loads of its bodies, each with its own velocity in the
    /// piece.
    #[test]
    fn the_load_of_a_piece_does_the_work_of_the_loads_of_its_bodies() {
        let bodies = vec![
            body(0, [0.0, 0.0], [1.0, -3.0], 0.5),
            body(1, [2.0, 1.0], [0.0, -2.0], 0.0),
            body(2, [1.0, 5.0], [-4.0, 1.0], -2.0),
            body(3, [9.0, 9.0], [7.0, 7.0], 7.0),
        ];
        let contacts =
            vec![contact(1, Some(0)), contact(2, Some(1)), contact(3, Some(2)), contact(0, None), contact(3, None)];
        let assembly = Assembly {
            bodies,
            contacts,
            grips: Vec::new(),
            pull: Vector::new(0.0, -1.0),
            load_factor: 1.0,
            length: 1.0,
        };
        // The last body belongs to the ground.
        let joined = assembly.merged(&[Some(1), Some(0), Some(1), None]);
        let [one, two] = &joined.bodies[..] else {
            panic!("there are not two pieces");
        };
        assert_eq!((one.centroid, one.weight), (Point::new(2.0, 1.0), 1.0));
        assert_eq!((two.centroid, two.weight), (Point::new(0.5, 2.5), 2.0));
        let (velocity, spin) = (Vector::new(0.3, -0.7), 0.9);
        let work = |load: LoadVector, arm: Vector| {
            let own = velocity + crate::geometry::quarter_turn(arm) * spin;
            load.force.dot(&own) + load.moment * spin
        };
        let apart: f64 =
            [0, 2].map(|k| &assembly.bodies[k]).map(|b| work(b.load, b.centroid - two.centroid)).iter().sum();
        let together = work(two.load, Vector::zeros());
        assert!((together - apart).abs() < 1e-12, "{together}, {apart}");

        // The contacts are: on the first piece from the second, the reverse, and two between the second piece
        // and the ground. One of these two is reversed.
        let seen: Vec<_> = joined.contacts.iter().map(|c| (c.on, c.from, c.normal.y)).collect();
        let expected = [(0, Some(1), 1.0), (1, Some(0), 1.0), (1, None, -1.0), (1, None, 1.0)];
        assert_eq!(seen, expected);
        assert_eq!(joined.contacts[2].bodies[1], BodyId::Block(BlockId(3)));
    }
}
