//! [`Node`]: a node of the search tree, which decides of some points whether they press and of some faces how they slide.

use super::spring::{Pattern, Slide, Springs};

/// A pattern of pressing and sliding that springs at rest cannot have, whatever the points and faces do that it leaves open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuledOut {
    /// (contact, application point 0 or 1, whether it presses).
    pub points: Vec<(usize, usize, bool)>,
    /// (contact with friction, how its face slides).
    pub faces: Vec<(usize, Slide)>,
}

/// What is decided of each point and each face; `None` is open.
#[derive(Clone)]
pub(super) struct Node {
    pub pressed: Vec<Option<bool>>,
    pub slides: Vec<Option<Slide>>,
}

/// What a node branches on.
pub(super) enum Branch {
    /// An application point: pressed or not.
    Point(usize),
    /// A face: slides forth, slides back or sticks.
    Face(usize),
}

impl Node {
    /// The root: only faces without friction are decided, for which it does not matter.
    pub fn root(springs: &Springs) -> Node {
        let contacts = springs.program.contacts.iter();
        let slides = contacts.map(|c| (!(c.friction > 0.0)).then_some(Slide::Forth));
        Node {
            pressed: vec![None; springs.points.len()],
            slides: slides.collect(),
        }
    }

    /// The children of a node. The last one is to be explored first.
    pub fn children(&self, at: Branch) -> Vec<Node> {
        let with = |change: &dyn Fn(&mut Node)| {
            let mut child = self.clone();
            change(&mut child);
            child
        };
        match at {
            Branch::Point(k) => [false, true]
                .map(|pressed| with(&|c| c.pressed[k] = Some(pressed)))
                .to_vec(),
            Branch::Face(k) => [Slide::Forth, Slide::Back, Slide::Sticks]
                .map(|slides| with(&|c| c.slides[k] = Some(slides)))
                .to_vec(),
        }
    }

    /// Whether a face may carry force. If none of its points presses it does not, however it slides.
    pub fn may_carry(&self, springs: &Springs, contact: usize) -> bool {
        let points = springs.points.iter().zip(&self.pressed);
        points
            .filter(|(p, _)| p.contact == contact)
            .any(|(_, pressed)| *pressed != Some(false))
    }

    /// What the node decides, in terms of contacts.
    pub fn described(&self, springs: &Springs) -> RuledOut {
        // Which of its contact's points a point is.
        let end = |k: usize| {
            let former = springs.points[..k].iter();
            let contact = springs.points[k].contact;
            former.filter(|p| p.contact == contact).count()
        };
        let points = self.pressed.iter().enumerate();
        let faces = self.slides.iter().enumerate();
        RuledOut {
            points: points
                .filter_map(|(k, pressed)| Some((springs.points[k].contact, end(k), (*pressed)?)))
                .collect(),
            faces: faces
                .filter(|(k, _)| springs.program.contacts[*k].friction > 0.0)
                .filter_map(|(k, slides)| Some((k, (*slides)?)))
                .collect(),
        }
    }

    /// The first open point, else the first open face that may carry force.
    pub fn first_open(&self, springs: &Springs) -> Option<Branch> {
        let point = self.pressed.iter().position(Option::is_none);
        let face = |k: &usize| self.slides[*k].is_none() && self.may_carry(springs, *k);
        point
            .map(Branch::Point)
            .or_else(|| (0..self.slides.len()).find(face).map(Branch::Face))
    }

    /// A pattern with the node's decisions put in.
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
