//! The loads of a body, and what each component of a contact or a grip does to the bodies that it joins, as exact wrenches.

use super::fraction::{Rational, Vector, Wrench, exact, float, square_length, zero};
use super::{BodyForm, Certificate, ContactForm, FrameForm, GripForm, LoadForm};

impl Certificate {
    /// Returns the loads of a body in a frame: its weight at its centroid, its listed loads, and the further load.
    pub(super) fn load(&self, index: usize, frame: &FrameForm) -> Wrench {
        let body = &self.bodies[index];
        if body.ground {
            return Wrench::zero();
        }
        let centre =
            body.centre.map_or_else(|| centroid(body).expect("form_errors refuses bodies without area"), Vector::new);
        let gravity = Vector::new(frame.gravity);
        let weight = exact(body.weight);
        let mut sum = Wrench::of_force(&Vector { x: &gravity.x * &weight, y: &gravity.y * &weight }, &centre);
        let mut add = |load: &LoadForm, factor: f64| {
            let mut wrench = Wrench::of_force(&Vector::new(load.force), &Vector::new(load.at));
            wrench.moment += exact(load.torque);
            sum = sum.plus(&wrench.times(&exact(factor)));
        };
        body.loads.iter().for_each(|load| add(load, if load.fixed { 1.0 } else { frame.load_factor }));
        if let Some((_, load)) = frame.force.as_ref().filter(|(body, _)| *body == index) {
            add(load, 1.0);
        }
        sum
    }

    /// Returns each contact and grip of a frame as the bodies that it joins and the wrenches of its three components.
    pub(super) fn links(&self, frame: &FrameForm) -> Vec<Link> {
        let contacts = frame.contacts.iter().map(|contact| {
            let [on, from] = contact.bodies;
            let normal = normal_of(contact);
            let points: Vec<Vector> = contact.points.iter().map(|p| Vector::new(*p)).collect();
            let last = points.len() - 1;
            let wrenches = [
                Wrench::of_force(&normal, &points[0]),
                Wrench::of_force(&normal, &points[last]),
                Wrench::of_force(&normal.turned(), &points[0]),
            ];
            Link { on, from: (!self.bodies[from].ground).then_some(from), normal, wrenches }
        });
        let grips = frame.grips.iter().map(|grip| Link {
            on: grip.body,
            from: None,
            normal: Vector { x: zero(), y: zero() },
            wrenches: grip_wrenches(grip),
        });
        contacts.chain(grips).collect()
    }
}

/// A contact or a grip: the body on which it acts, the body that receives the opposite force (none for the ground and for
/// robots), its normal, and the wrenches of its three components.
pub(super) struct Link {
    pub on: usize,
    pub from: Option<usize>,
    pub normal: Vector,
    pub wrenches: [Wrench; 3],
}

impl Link {
    /// The bodies that the link joins, without the ground.
    pub fn bodies(&self) -> Vec<usize> {
        std::iter::once(self.on).chain(self.from).collect()
    }

    /// The wrench of a component on a body; `None` if it does not act on this body.
    pub fn on_body(&self, component: usize, body: usize) -> Option<Wrench> {
        let wrench = &self.wrenches[component];
        match body {
            on if on == self.on => Some(wrench.clone()),
            from if Some(from) == self.from => Some(wrench.negative()),
            _ => None,
        }
    }
}

/// The centroid of an outline without its holes, whatever the direction of the rings; `None` if it has no area.
pub(super) fn centroid(body: &BodyForm) -> Option<Vector> {
    if let Some(circle) = body.circle {
        return Some(Vector::new(circle.centre));
    }
    let (mut area, mut x, mut y) = (zero(), zero(), zero());
    for (ring, corners) in std::iter::once(&body.outline).chain(&body.holes).enumerate() {
        let corners: Vec<Vector> = corners.iter().map(|p| Vector::new(*p)).collect();
        let (mut own, mut own_x, mut own_y) = (zero(), zero(), zero());
        for (p, q) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let twice = p.cross(q);
            own_x += (&p.x + &q.x) * &twice;
            own_y += (&p.y + &q.y) * &twice;
            own += twice;
        }
        // The outline counts as positive, and each hole as negative.
        let sign = Rational::from(if (own > zero()) == (ring == 0) { 1 } else { -1 });
        area += own * &sign;
        x += own_x * &sign;
        y += own_y * &sign;
    }
    let three = area * Rational::from(3);
    (three != zero()).then(|| Vector { x: x / &three, y: y / &three })
}

/// The normal of a contact, which points into its first body.
pub(super) fn normal_of(contact: &ContactForm) -> Vector {
    match (&contact.points[..], contact.normal) {
        ([first, second], _) => {
            let tangent = Vector::new(*second).minus(&Vector::new(*first));
            Vector { x: tangent.y, y: -tangent.x }
        }
        (_, normal) => Vector::new(normal.unwrap_or_default()),
    }
}

/// The length of the normal, by which components are multiplied to print newtons.
pub(super) fn length_of_normal(contact: &ContactForm) -> f64 {
    float(&square_length(&normal_of(contact))).sqrt()
}

/// The wrenches of a grip's force x, force y and torque.
pub(super) fn grip_wrenches(grip: &GripForm) -> [Wrench; 3] {
    let at = Vector::new(grip.at);
    let torque = Wrench { force: Vector { x: zero(), y: zero() }, moment: Rational::ONE };
    [Wrench::of_force(&Vector::new([1.0, 0.0]), &at), Wrench::of_force(&Vector::new([0.0, 1.0]), &at), torque]
}
