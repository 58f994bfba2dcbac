//! [`Joint`]: what a mechanism does at an interface: a hinge where one end keeps contact, a slip where it slides.
//!
//! Along a mechanism nothing admissible can object to, a contact opens with at least μ times the speed at which it
//! slides. One that opens with just that still rubs: it slips. One that opens faster is free.

use crate::analysis::{Analysis, Contact, FrameAnalysis, Motion};
use crate::geometry::{Point, Vector};
use crate::scene::{BlockId, BodyId};

/// Speeds below this share of the largest between two bodies are noise of the solution.
const NOISE: f64 = 2e-3;

/// How the two bodies of an interface move against each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joint {
    /// The contact's number in the frame.
    pub contact: usize,
    /// The application point about which it turns, where one keeps contact and the other opens.
    pub hinge: Option<Point>,
    /// Speed of the first body past the second along (−n_y, n_x), 0 where it does not slide or no longer touches.
    pub slip: f64,
}

impl Joint {
    /// Whether the bodies part without touching.
    pub fn opens(&self) -> bool {
        self.hinge.is_none() && self.slip == 0.0
    }
}

/// Every interface of a frame whose bodies move against each other.
pub(crate) fn joints(analysis: &Analysis<'_>, frame: usize) -> Vec<Joint> {
    let found = &analysis.frames[frame];
    let motions = by_block(analysis, found);
    let relative: Vec<[Vector; 2]> = found
        .contacts
        .iter()
        .map(|contact| {
            contact.application_points.map(|p| {
                let [a, b] = contact.interface.bodies;
                velocity(analysis, &motions, a, p) - velocity(analysis, &motions, b, p)
            })
        })
        .collect();
    let largest = relative
        .iter()
        .flatten()
        .map(|v| v.norm())
        .fold(0.0, f64::max);
    if largest <= 0.0 {
        return Vec::new();
    }
    let spin = |body| match body {
        BodyId::Ground(_) => 0.0,
        BodyId::Block(BlockId(id)) => motions[id].map_or(0.0, |m| m.spin),
    };
    let one = |(number, contact): (usize, &Contact)| {
        let [a, b] = contact.interface.bodies;
        let turning = (spin(a) - spin(b)).abs() * analysis.length;
        let found = joint(contact, relative[number], turning, NOISE * largest)?;
        Some(Joint {
            contact: number,
            ..found
        })
    };
    found.contacts.iter().enumerate().filter_map(one).collect()
}

/// `None` where the two bodies stay together.
fn joint(contact: &Contact, relative: [Vector; 2], turning: f64, noise: f64) -> Option<Joint> {
    let interface = &contact.interface;
    let along = relative.map(|v| v.dot(&interface.tangent()));
    let free = [0, 1].map(|k| relative[k].dot(&interface.normal) - interface.friction * along[k].abs());
    let touches = free.map(|speed| speed <= noise);
    let points = contact.application_points;
    let hinge = match touches {
        [true, false] => Some(points[0]),
        [false, true] => Some(points[1]),
        // The two points are one, or nearly: they keep contact together while the bodies turn about them.
        [true, true] if turning > 5.0 * noise => Some(points[0]),
        _ => None,
    };
    let slide = match touches {
        [true, _] => along[0],
        [_, true] => along[1],
        _ => 0.0,
    };
    let slip = if slide.abs() > noise { slide } else { 0.0 };
    let parted = touches == [false, false];
    (hinge.is_some() || slip != 0.0 || parted).then_some(Joint {
        contact: 0,
        hinge,
        slip,
    })
}

/// The motion of each block by its number, `None` for those that stay.
fn by_block(analysis: &Analysis<'_>, found: &FrameAnalysis) -> Vec<Option<Motion>> {
    let mut motions = vec![None; analysis.scene.blocks.len()];
    for motion in &found.mechanism {
        motions[motion.block.0] = Some(*motion);
    }
    motions
}

fn velocity(
    analysis: &Analysis<'_>,
    motions: &[Option<Motion>],
    body: BodyId,
    at: Point,
) -> Vector {
    match body {
        BodyId::Ground(_) => Vector::zeros(),
        BodyId::Block(id) => motions[id.0].map_or(Vector::zeros(), |m| m.at(analysis.scene, at)),
    }
}
