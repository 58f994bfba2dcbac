//! The loads of a body, and what each component of a contact or a grip does to the bodies that it joins, as exact wrenches.

use super::fraction::{Number, Vector, Wrench, square_length};
use super::number::{is_spent, spend};
use super::{BodyForm, Certificate, ContactForm, FrameForm, GripForm, LoadForm, Pair};

impl Certificate {
    /// Returns the loads of a body in a frame: its weight at its centroid, its listed loads, and the further load.
    pub(super) fn load<N: Number>(&self, index: usize, frame: &FrameForm) -> Wrench<N> {
        let body = &self.bodies[index];
        if body.ground || is_spent() {
            return Wrench::zero();
        }
        let weight = Vector::new(frame.gravity).times(&N::exact(body.weight));
        let mut sum = Wrench::of_force(&weight, &self.point(index, None));
        let mut add = |load: &LoadForm, factor: f64| {
            let mut wrench: Wrench<N> = Wrench::of_force(&Vector::new(load.force), &self.point(index, load.at));
            wrench.moment = wrench.moment.plus(&N::exact(load.torque));
            sum = sum.plus(&wrench.times(&N::exact(factor)));
        };
        body.loads.iter().for_each(|load| add(load, if load.fixed { 1.0 } else { frame.load_factor }));
        if let Some((_, load)) = frame.force.as_ref().filter(|(body, _)| *body == index) {
            add(load, 1.0);
        }
        let errors = frame.errors.iter().flat_map(|errors| &errors.pattern);
        spend(frame.errors.as_ref().map_or(0, |errors| errors.pattern.len()));
        for (_, sign) in errors.filter(|(body, _)| *body == index) {
            let moment = frame.moment(index, body).unwrap_or_else(|| N::exact(f64::NAN));
            sum.moment = sum.moment.plus(&moment.times(&N::exact(*sign)));
        }
        sum
    }

    /// Returns a point of a body: the given one, or else the one at which its weight acts.
    pub(super) fn point<N: Number>(&self, index: usize, at: Option<Pair>) -> Vector<N> {
        let body = &self.bodies[index];
        let point = at.or(body.centre).map(Vector::new).or_else(|| centroid(body));
        // `form_errors` refuses bodies without area; an interval may be too wide to tell.
        point.unwrap_or_else(|| Vector::new([f64::NAN; 2]))
    }

    /// Returns each contact and grip of a frame as the bodies that it joins and the wrenches of its three components.
    pub(super) fn links<N: Number>(&self, frame: &FrameForm) -> Vec<Link<N>> {
        let contacts = frame.contacts.iter().map(|contact| {
            let [on, from] = contact.bodies;
            let normal = normal_of(contact);
            let ends = ends(contact);
            let errors = frame.inset(contact).unwrap_or_else(|| N::exact(f64::NAN));
            let inward = N::exact(frame.kernel / 2.0).plus(&errors);
            let points = [ends[0].toward(&ends[1], &inward), ends[1].toward(&ends[0], &inward)];
            let wrenches = [
                Wrench::of_force(&normal, &points[0]),
                Wrench::of_force(&normal, &points[1]),
                Wrench::of_force(&normal.turned(), &points[0]),
            ];
            Link { on, from: (!self.bodies[from].ground).then_some(from), wrenches }
        });
        let grips = frame.grips.iter();
        let grips = grips.map(|grip| Link { on: grip.body, from: None, wrenches: self.grip_wrenches(grip) });
        contacts.chain(grips).collect()
    }

    /// Returns the wrenches of a grip's force x, force y and torque.
    pub(super) fn grip_wrenches<N: Number>(&self, grip: &GripForm) -> [Wrench<N>; 3] {
        let at = self.point(grip.body, grip.at);
        let torque = Wrench { force: Vector::new([0.0; 2]), moment: N::exact(1.0) };
        [Wrench::of_force(&Vector::new([1.0, 0.0]), &at), Wrench::of_force(&Vector::new([0.0, 1.0]), &at), torque]
    }
}

/// A contact or a grip: the body on which it acts, the body that receives the opposite force (none for the ground and for
/// robots), and the wrenches of its three components.
pub(super) struct Link<N> {
    pub on: usize,
    pub from: Option<usize>,
    pub wrenches: [Wrench<N>; 3],
}

impl<N: Number> Link<N> {
    /// The bodies that the link joins, without the ground.
    pub fn bodies(&self) -> Vec<usize> {
        std::iter::once(self.on).chain(self.from).collect()
    }

    /// The wrench of a component on a body; `None` if it does not act on this body.
    pub fn on_body(&self, component: usize, body: usize) -> Option<Wrench<N>> {
        let wrench = &self.wrenches[component];
        match body {
            on if on == self.on => Some(wrench.clone()),
            from if Some(from) == self.from => Some(wrench.negative()),
            _ => None,
        }
    }
}

/// The centroid of an outline without its holes; `None` if it may have no area.
fn centroid<N: Number>(body: &BodyForm) -> Option<Vector<N>> {
    if let Some(circle) = body.circle {
        return Some(Vector::new(circle.centre));
    }
    let (mut area, mut x, mut y) = (N::zero(), N::zero(), N::zero());
    for ring in std::iter::once(&body.outline).chain(&body.holes) {
        for [p, q] in sides::<N>(ring) {
            let twice = p.cross(&q);
            x = x.plus(&p.x.plus(&q.x).times(&twice));
            y = y.plus(&p.y.plus(&q.y).times(&twice));
            area = area.plus(&twice);
        }
    }
    let three = area.times(&N::exact(3.0));
    Some(Vector { x: x.over(&three)?, y: y.over(&three)? })
}

/// The sides of a ring, from corner to corner.
pub(super) fn sides<N: Number>(ring: &[Pair]) -> impl Iterator<Item = [Vector<N>; 2]> {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(p, q)| [Vector::new(*p), Vector::new(*q)])
}

/// The normal of a contact, which points into its first body.
pub(super) fn normal_of<N: Number>(contact: &ContactForm) -> Vector<N> {
    match (&contact.points[..], contact.normal) {
        ([first, second], _) => Vector::new(*first).minus(&Vector::new(*second)).turned(),
        (_, normal) => Vector::new(normal.unwrap_or_default()),
    }
}

/// The two ends of a contact, which are the same for one point.
pub(super) fn ends<N: Number>(contact: &ContactForm) -> [Vector<N>; 2] {
    [0, contact.points.len() - 1].map(|end| Vector::new(contact.points[end]))
}

/// The length of the normal, by which components are multiplied to print newtons.
pub(super) fn length_of_normal(contact: &ContactForm) -> f64 {
    square_length(&normal_of(contact)).float().sqrt()
}
