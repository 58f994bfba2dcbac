//! [`Node`]: a node of the search tree of `branch_and_bound`. It decides whether some application points press
//! and how the faces of some contacts slide.

use super::spring::{Pattern, Slide, Springs};

/// A pattern of pressing points and sliding faces that springs at rest cannot have. Points and faces that are not
/// listed may be in any state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuledOut {
    /// The fixed points: (contact, application point 0 or 1, whether it presses).
    pub points: Vec<(usize, usize, bool)>,
    /// The fixed faces: (contact with friction, how its face slides).
    pub faces: Vec<(usize, Slide)>,
}

/// The decisions for each point and each face; `None` means that it is open.
#[derive(Clone)]
pub(super) struct Node {
    pub pressed: Vec<Option<bool>>,
    pub slides: Vec<Option<Slide>>,
}

/// The point or face on which the search branches.
pub(super) enum Branch {
    /// An application point with two children: it presses or not.
    Point(usize),
    /// A face with three children: it slides forth, slides back or sticks.
    Face(usize),
}

impl Node {
    /// Returns the root of the search tree. All points and faces are open (undecided), except the faces without
    /// friction, for which the decision has no effect.
    pub fn root(springs: &Springs) -> Node {
        let contacts = springs.program.contacts.iter();
        let slides = contacts.map(|c| (!(c.friction > 0.0)).then_some(Slide::Forth));
        Node { pressed: vec![None; springs.points.len()], slides: slides.collect() }
    }

    /// Returns the children of this node for a branch at the point or face `at`. The last child of the list is explored
    /// first.
    pub fn children(&self, at: Branch) -> Vec<Node> {
        let with = |change: &dyn Fn(&mut Node)| {
            let mut child = self.clone();
            change(&mut child);
            child
        };
        match at {
            Branch::Point(k) => [false, true].map(|pressed| with(&|c| c.pressed[k] = Some(pressed))).to_vec(),
            Branch::Face(k) => {
                [Slide::Forth, Slide::Back, Slide::Sticks].map(|slides| with(&|c| c.slides[k] = Some(slides))).to_vec()
            }
        }
    }

    /// True if a face may transmit a friction force: at least one of its points presses or is undecided.
    pub fn may_carry(&self, springs: &Springs, contact: usize) -> bool {
        let points = springs.points.iter().zip(&self.pressed);
        points.filter(|(p, _)| p.contact == contact).any(|(_, pressed)| *pressed != Some(false))
    }

    /// Returns the decisions of the node, with the indices of their contacts and application points.
    pub fn ruled_out(&self, springs: &Springs) -> RuledOut {
        // Returns the index of a point within its contact, 0 or 1.
        let end = |k: usize| {
            let former = springs.points[..k].iter();
            let contact = springs.points[k].contact;
            former.filter(|p| p.contact == contact).count()
        };
        let points = self.pressed.iter().enumerate();
        let faces = self.slides.iter().enumerate();
        RuledOut {
            points: points.filter_map(|(k, pressed)| Some((springs.points[k].contact, end(k), (*pressed)?))).collect(),
            faces: faces
                .filter(|(k, _)| springs.program.contacts[*k].friction > 0.0)
                .filter_map(|(k, slides)| Some((k, (*slides)?)))
                .collect(),
        }
    }

    /// Returns the first undecided point. If all points are decided, returns the first undecided face that may transmit
    /// a friction force. `None` if there is no such face.
    pub fn first_open(&self, springs: &Springs) -> Option<Branch> {
        let point = self.pressed.iter().position(Option::is_none);
        let face = |k: &usize| self.slides[*k].is_none() && self.may_carry(springs, *k);
        point.map(Branch::Point).or_else(|| (0..self.slides.len()).find(face).map(Branch::Face))
    }

    /// Returns a copy of `pattern` in which the decided points and faces have the states that the node decides.
    pub fn impose_on(&self, pattern: &Pattern) -> Pattern {
        let mut imposed = pattern.clone();
        for (to, decided) in imposed.pressed.iter_mut().zip(&self.pressed) {
            *to = decided.unwrap_or(*to);
        }
        for (to, decided) in imposed.slides.iter_mut().zip(&self.slides) {
            *to = decided.unwrap_or(*to);
        }
        imposed
    }
}
