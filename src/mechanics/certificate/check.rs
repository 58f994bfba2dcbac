//! [`Certificate::check`]: decides in exact rational arithmetic whether the forces or the motion of each frame prove its
//! verdict.
//!
//! No number is rounded: each double is the rational number that it is. The method needs no solver: sums, products, and
//! for each body with a residual one system of three equations. `examples/verify/verify.py` does the same, and was
//! written from the page [`certificate`](crate::doc::certificate).

use std::collections::BTreeSet;

use super::fraction::{Number, Rational, Vector, Wrench, eliminate, solve};
use super::links::{Link, length_of_normal, sides};
use super::number::{Interval, WORK, allow, is_spent, spend};
use super::{BodyForm, Certificate, ContactForm, FrameForm, LimitForm, Pair, Step};
use crate::mechanics::solve::is_late;

/// The result of checking a certificate.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// One entry for each frame.
    pub frames: Vec<FrameCheck>,
    /// One entry for each side of an end of a margin, or of a corner or an edge of a capacity.
    pub limits: Vec<LimitCheck>,
    /// The largest distance of a contact point from the outlines of its two bodies, metres. 0 if the contacts are given
    /// by the scene.
    pub farthest: f64,
}

/// The result of checking one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameCheck {
    /// The number of the frame, from 1.
    pub frame: usize,
    /// The verdict that the certificate states.
    pub verdict: String,
    /// What is not exactly as the certificate states, in sentences. Empty if the verdict is proved.
    pub faults: Vec<String>,
}

/// The result of checking one changed frame.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitCheck {
    /// The number of the frame that is changed, from 1.
    pub frame: usize,
    /// What is proved, as in the certificate.
    pub of: String,
    /// The rotation of gravity in degrees, anticlockwise positive; `None` if it is not changed.
    pub turned: Option<f64>,
    /// The verdict that the certificate states for the changed frame.
    pub verdict: String,
    /// What is not exactly as the certificate states, in sentences. Empty if the verdict is proved.
    pub faults: Vec<String>,
}

impl FrameCheck {
    /// True if the verdict is `stable` or `unstable` and exactly proved.
    pub fn is_exact(&self) -> bool {
        self.faults.is_empty()
    }
}

impl Certificate {
    /// Checks the certificate in exact arithmetic. Returns the errors in its form if it cannot be read as a proof, such
    /// as an index without a body.
    pub fn check(&self) -> Result<Checked, Vec<String>> {
        allow(WORK[0] + WORK[1] * self.to_json().len() as u64);
        let checked = self.checked();
        allow(u64::MAX);
        checked
    }

    fn checked(&self) -> Result<Checked, Vec<String>> {
        let errors = self.form_errors(&self.bodies, &self.frames);
        if !errors.is_empty() {
            return Err(errors);
        }
        let mut farthest = 0.0_f64;
        let frames = self.frames.iter().map(|frame| {
            let mut faults = self.place_faults(frame, &mut farthest);
            faults.extend(self.proof_faults(frame));
            FrameCheck { frame: frame.frame, verdict: frame.verdict.clone(), faults }
        });
        let frames: Vec<FrameCheck> = frames.collect();
        let limits = self.limits.iter().map(|limit| LimitCheck {
            frame: limit.frame,
            of: limit.of.clone(),
            turned: self.turned(limit),
            verdict: limit.verdict.clone(),
            faults: self.limit_faults(limit),
        });
        Ok(Checked { frames, limits: limits.collect(), farthest })
    }

    /// Returns by which angle, in degrees, a change rotates gravity. Sines are no fractions, so this is rounded.
    fn turned(&self, limit: &LimitForm) -> Option<f64> {
        let [x, y] = self.frames.iter().find(|frame| frame.frame == limit.frame)?.gravity;
        let [a, b] = limit.change.gravity?;
        Some(libm::atan2(x * b - y * a, x * a + y * b).to_degrees())
    }

    /// Checks the places of the contacts of a changed frame, and its proof.
    pub(super) fn limit_faults(&self, limit: &LimitForm) -> Vec<String> {
        spend(self.frames.len());
        if let Some(why) = given_up() {
            return vec![why];
        }
        let Some(frame) = self.frames.iter().find(|frame| frame.frame == limit.frame) else {
            return vec![format!("there is no frame {}", limit.frame)];
        };
        let changed = FrameForm {
            verdict: limit.verdict.clone(),
            forces: limit.forces.clone(),
            motion: limit.motion.clone(),
            still: limit.still.clone(),
            ..limit.change.of(frame)
        };
        let loaded = limit.change.loads.as_ref().map(|loads| self.with_loads(loads));
        let own = loaded.as_ref().unwrap_or(self);
        let bodies = loaded.as_ref().map_or(&[][..], |loaded| &loaded.bodies);
        let mut faults = own.form_errors(bodies, std::slice::from_ref(&changed));
        if limit.change.loads.iter().flatten().any(|(body, ..)| !frame.placed.contains(body)) {
            faults.push("a load on a body that is not placed".to_owned());
        }
        if limit.change.grip_limits.as_ref().is_some_and(|limits| limits.len() != frame.grips.len()) {
            faults.push("the limits are not those of the grips".to_owned());
        }
        if faults.is_empty() {
            // The contacts that lock a joint do not lie at the outlines, so their places are not checked.
            let mut joints = changed.clone();
            joints.contacts.truncate(frame.contacts.len());
            faults = own.place_faults(&joints, &mut 0.0);
            faults.extend(own.proof_faults(&changed));
        }
        faults
    }

    /// Checks the forces or the motion of a frame, as its verdict needs.
    pub(super) fn proof_faults(&self, frame: &FrameForm) -> Vec<String> {
        spend(100 * (self.bodies.len() + frame.contacts.len()));
        let faults = match (frame.verdict.as_str(), &frame.forces, &frame.motion) {
            _ if is_spent() => Vec::new(),
            ("stable", Some(_), _) if self.force_faults::<Interval>(frame).is_empty() => Vec::new(),
            ("stable", Some(_), _) => self.force_faults::<Rational>(frame),
            ("unstable", _, Some(_)) if self.motion_faults::<Interval>(frame).is_empty() => Vec::new(),
            ("unstable", _, Some(_)) => self.motion_faults::<Rational>(frame),
            ("stable", None, _) => vec!["the certificate contains no forces".to_owned()],
            ("unstable", _, None) => vec!["the certificate contains no motion".to_owned()],
            _ => vec!["the certificate states no verdict".to_owned()],
        };
        given_up().map_or(faults, |why| vec![why])
    }

    /// Returns what makes bodies and frames of the certificate unreadable as a proof: indices without an entry, lists of a
    /// wrong length, and numbers of a wrong sign.
    fn form_errors(&self, bodies: &[BodyForm], frames: &[FrameForm]) -> Vec<String> {
        let mut errors = Vec::new();
        macro_rules! need {
            ($fine:expr, $($text:tt)+) => {
                if !$fine {
                    errors.push(format!($($text)+));
                }
            };
        }
        need!(self.drystone_certificate == 1, "version {} is not 1", self.drystone_certificate);
        need!(self.distance >= 0.0 && self.shortest >= 0.0, "a distance is negative");
        for body in bodies {
            let mut rings = std::iter::once(&body.outline).chain(&body.holes);
            need!(
                body.circle.is_some() || rings.all(|ring| ring.len() >= 3),
                "an outline of {} has fewer than 3 corners",
                body.id
            );
            need!(body.circle.is_none_or(|circle| circle.radius > 0.0), "the radius of {} is not more than 0", body.id);
            let none = Rational::ZERO;
            let area = |ring: &Vec<Pair>| sides::<Rational>(ring).fold(none.clone(), |sum, [p, q]| sum + p.cross(&q));
            let (outline, holes): (_, Vec<Rational>) = (area(&body.outline), body.holes.iter().map(area).collect());
            let fine = body.circle.is_some() || outline > none && holes.iter().all(|hole| *hole <= none);
            need!(fine, "the outline of {} has no area, or a ring runs the wrong way", body.id);
            let left = holes.into_iter().fold(outline, |sum, hole| sum + hole);
            need!(
                body.circle.is_some() || !fine || left > none,
                "the holes of {} are larger than its outline",
                body.id
            );
            need!(body.weight >= 0.0, "the weight of {} is negative", body.id);
        }
        let numbers: BTreeSet<usize> = frames.iter().map(|frame| frame.frame).collect();
        need!(numbers.len() == frames.len(), "two frames have the same number");
        let is_block = |index: usize| self.bodies.get(index).is_some_and(|body| !body.ground);
        for frame in frames {
            let n = frame.frame;
            let different: BTreeSet<usize> = frame.placed.iter().copied().collect();
            let is_placed = |index: usize| is_block(index) && different.contains(&index);
            let fine = different.len() == frame.placed.len() && frame.placed.iter().all(|index| is_block(*index));
            need!(fine, "frame {n}: a placed body is no block, or is placed twice");
            need!((0.0..=1.0).contains(&frame.kernel), "frame {n}: the kernel is not between 0 and 1");
            for (k, contact) in frame.contacts.iter().enumerate() {
                let [on, from] = contact.bodies;
                let is_ground = self.bodies.get(from).is_some_and(|body| body.ground);
                need!(
                    is_placed(on) && on != from && (is_ground || is_placed(from)),
                    "frame {n}, contact {k}: the bodies {on} and {from} are not two bodies of this frame"
                );
                let normals = matches!((contact.points.len(), contact.normal), (2, None) | (1, Some(_)));
                need!(normals, "frame {n}, contact {k}: needs two points, or one point and a normal");
                need!(
                    contact.points.len() != 2 || contact.points[0] != contact.points[1],
                    "frame {n}, contact {k}: its two points are equal"
                );
                need!(
                    contact.friction.min(contact.factor.unwrap_or(1.0)) >= 0.0,
                    "frame {n}, contact {k}: its friction is negative"
                );
            }
            need!(
                frame.force.as_ref().is_none_or(|(body, _)| is_placed(*body)),
                "frame {n}: a load on a body that is not placed"
            );
            for (k, grip) in frame.grips.iter().enumerate() {
                need!(is_placed(grip.body), "frame {n}, grip {k}: holds no placed block");
                need!(
                    grip.limits.iter().flatten().all(|limit| *limit >= 0.0),
                    "frame {n}, grip {k}: a limit is negative"
                );
            }
            need!(
                frame.error_faults(&self.bodies).is_none(),
                "frame {n}: {}",
                frame.error_faults(&self.bodies).unwrap_or_default()
            );
            if let Some(forces) = &frame.forces {
                let (contacts, grips) = (frame.contacts.len(), frame.grips.len());
                need!(
                    forces.contacts.len() == contacts && forces.grips.len() == grips,
                    "frame {n}: the forces are not those of {contacts} contacts and {grips} grips"
                );
            }
            let reactions = frame.forces.iter().flat_map(|forces| &forces.reactions);
            for (body, entries) in reactions {
                let count = 3 * (frame.contacts.len() + frame.grips.len());
                need!(
                    is_placed(*body) && entries.iter().all(|(component, _)| *component < count),
                    "frame {n}: a reaction names a body or a component that is not there"
                );
            }
            let steps = frame.forces.iter().flat_map(|forces| &forces.order).chain(&frame.still);
            for (bodies, components) in steps {
                let count = 3 * (frame.contacts.len() + frame.grips.len());
                let fine = bodies.iter().all(|body| is_placed(*body)) && components.iter().all(|c| *c < count);
                need!(fine, "frame {n}: a step names a body or a component that is not there");
                need!(
                    bodies.len().max(components.len()) <= LARGEST_STEP,
                    "frame {n}: a step has more than {LARGEST_STEP} bodies or components"
                );
            }
            for motion in frame.motion.iter().flatten() {
                need!(is_placed(motion.body), "frame {n}: the motion of a body that is not placed");
            }
        }
        errors
    }

    /// Checks that the forces of a frame, corrected in the given order, balance every body and keep every limit, for all of
    /// its errors.
    fn force_faults<N: Number>(&self, frame: &FrameForm) -> Vec<String> {
        let Some(forces) = &frame.forces else { return Vec::new() };
        let mut faults = Vec::new();
        let links = self.links(frame);
        let amounts = forces.contacts.iter().chain(&forces.grips).flatten().map(|v| N::exact(*v)).collect();
        let mut loads = vec![Wrench::zero(); self.bodies.len()];
        frame.placed.iter().for_each(|body| loads[*body] = self.load(*body, frame));
        let amounts: Vec<N> = self.corrected(frame, &links, &forces.order, amounts, loads, &mut faults);
        // By how much the errors of the bodies change the conditions of each contact and grip.
        let mut spread = vec![[N::zero(), N::zero(), N::zero(), N::zero()]; links.len()];
        let loose = if frame.errors.is_some() && faults.is_empty() { &frame.placed[..] } else { &[] };
        for body in loose.iter().take_while(|_| !is_spent()) {
            spend(forces.reactions.len());
            let size = N::exact(frame.errors.as_ref().map_or(0.0, |errors| errors.size));
            let mut own = vec![N::zero(); amounts.len()];
            let reactions = forces.reactions.iter().filter(|(other, _)| other == body);
            for (component, amount) in reactions.flat_map(|(_, entries)| entries) {
                own[*component] = own[*component].plus(&N::exact(*amount).times(&size));
            }
            let mut loads = vec![Wrench::zero(); self.bodies.len()];
            loads[*body].moment = frame.moment(*body, &self.bodies[*body]).unwrap_or_else(|| N::exact(f64::NAN));
            let own = self.corrected(frame, &links, &forces.order, own, loads, &mut faults);
            for (link, sums) in spread.iter_mut().enumerate() {
                for (sum, value) in sums.iter_mut().zip(conditions(frame, link, &own)) {
                    *sum = sum.plus(&value.magnitude()).reduced();
                }
            }
        }
        // Check the inequalities of contacts and grips.
        for (k, contact) in frame.contacts.iter().enumerate() {
            let mut miss = |by: N, what: &str| {
                if !by.is_at_most_zero() {
                    let names = self.names(contact);
                    faults.push(format!("{names}: {what} by {:.1e} N", by.float() * length_of_normal(contact)));
                }
            };
            let values = conditions(frame, k, &amounts);
            let texts = ["the first normal force pulls", "the second normal force pulls"];
            let texts = texts.into_iter().chain(["the friction exceeds its limit"; 2]);
            for ((value, spread), what) in values.iter().zip(&spread[k]).zip(texts) {
                miss(spread.minus(value), what);
            }
            if contact.points.len() == 1 {
                miss(values[1].plus(&spread[k][1]), "a second normal force without a point presses");
            }
        }
        for (k, grip) in frame.grips.iter().enumerate() {
            let link = frame.contacts.len() + k;
            let values = conditions(frame, link, &amounts);
            for ((value, spread), limit) in values.iter().zip(&spread[link]).zip(grip.limits) {
                let by = limit.map(|limit| value.magnitude().plus(spread).minus(&N::exact(limit)));
                if let Some(by) = by.filter(|by| !by.is_at_most_zero()) {
                    faults.push(format!("{} exceeds its limit by {:.1e}", grip.robot, by.float()));
                }
            }
        }
        faults
    }

    /// Returns the amounts of all components after the corrections in the given order, and adds what is wrong with them.
    fn corrected<N: Number>(
        &self,
        frame: &FrameForm,
        links: &[Link<N>],
        order: &[Step],
        mut amounts: Vec<N>,
        loads: Vec<Wrench<N>>,
        faults: &mut Vec<String>,
    ) -> Vec<N> {
        spend(20 * (amounts.len() + loads.len()));
        // The residual of each body: its loads and the forces of its contacts and grips.
        let mut residual = loads;
        for (component, amount) in amounts.iter().enumerate().filter(|(_, amount)| !amount.is_zero()) {
            let link = &links[component / 3];
            let wrench = link.wrenches[component % 3].times(amount);
            if let Some(from) = link.from {
                residual[from] = residual[from].minus(&wrench);
            }
            residual[link.on] = residual[link.on].plus(&wrench);
        }
        // Carry the residuals on to the next bodies, by changes of the forces.
        let mut done = vec![false; self.bodies.len()];
        for (bodies, components) in order.iter().take_while(|_| !is_spent()) {
            spend(bodies.len() * components.len());
            let leads_on = components.iter().all(|component| {
                let ends = links[component / 3].bodies();
                ends.iter().any(|body| bodies.contains(body)) && ends.iter().all(|body| !done[*body])
            });
            let is_new = bodies.iter().all(|body| !std::mem::replace(&mut done[*body], true));
            let names = || bodies.iter().map(|body| self.bodies[*body].id.as_str()).collect::<Vec<_>>().join(", ");
            if !leads_on || !is_new {
                faults.push(format!("the order of the corrections is wrong at {}", names()));
                continue;
            }
            let Some(changes) = correction(links, &residual, bodies, components) else {
                faults.push(format!("the forces that correct {} cannot carry what is left over", names()));
                continue;
            };
            for (component, change) in components.iter().zip(&changes) {
                amounts[*component] = amounts[*component].plus(change);
            }
            let others = components.iter().flat_map(|c| links[c / 3].bodies()).filter(|body| !bodies.contains(body));
            let others: BTreeSet<usize> = others.collect();
            // A single other body receives what was left over. In this usual case no fraction arises, and the numbers
            // stay short.
            let single = others.iter().next().filter(|_| bodies.len() == 1 && others.len() == 1);
            if let Some(other) = single.filter(|_| components.iter().all(|c| links[c / 3].bodies().len() == 2)) {
                residual[*other] = residual[*other].plus(&residual[bodies[0]]);
            } else {
                for other in others {
                    for (component, change) in components.iter().zip(&changes) {
                        if let Some(wrench) = links[component / 3].on_body(component % 3, other) {
                            residual[other] = residual[other].plus(&wrench.times(change)).reduced();
                        }
                    }
                }
            }
            bodies.iter().for_each(|body| residual[*body] = Wrench::zero());
        }
        for index in &frame.placed {
            let worst = residual[*index].entries().map(|v| v.float().abs()).into_iter().fold(0.0, f64::max);
            if !residual[*index].entries().iter().all(|v| v.is_zero()) {
                faults.push(format!("{} does not balance by {worst:.1e} N", self.bodies[*index].id));
            }
        }
        amounts
    }

    /// Checks that no force of a contact or of a grip can resist the motion of a frame, and that its loads do work.
    fn motion_faults<N: Number>(&self, frame: &FrameForm) -> Vec<String> {
        let mut faults = Vec::new();
        if !N::DECIDES && !frame.still.is_empty() {
            return vec!["only equations of rational numbers are solved".to_owned()];
        }
        // The motion of each body: the velocity of the origin, and the angular velocity.
        let mut motions = vec![Wrench::<N>::zero(); self.bodies.len()];
        for motion in frame.motion.iter().flatten() {
            let (velocity, spin) = (Vector::new(motion.velocity), N::exact(motion.spin));
            let at: Vector<N> = self.point(motion.body, motion.at);
            let at_origin = velocity.minus(&at.turned().times(&spin));
            motions[motion.body] = Wrench { force: at_origin, moment: spin };
        }
        let links = self.links(frame);
        for (bodies, components) in frame.still.iter().take_while(|_| !is_spent()) {
            // Find the changes of the motions after which no component has power.
            let rows = components.iter().map(|component| {
                let own = |body: &usize| links[component / 3].on_body(component % 3, *body);
                let mut row: Vec<N> =
                    bodies.iter().flat_map(|body| own(body).unwrap_or_else(Wrench::zero).into_entries()).collect();
                let powers = links[component / 3].bodies().into_iter().filter_map(|body| Some((body, own(&body)?)));
                row.push(powers.fold(N::zero(), |sum, (body, wrench)| sum.minus(&wrench.power(&motions[body]))));
                row
            });
            let changes = eliminate(rows.collect(), 3 * bodies.len()).unwrap_or_default();
            for (body, change) in bodies.iter().zip(changes.chunks_exact(3)) {
                motions[*body] = motions[*body].plus(&Wrench::of_entries(change));
            }
        }
        let powers = frame.placed.iter().map(|index| self.load(*index, frame).power(&motions[*index]));
        let mut power = powers.fold(N::zero(), |sum, power| sum.plus(&power));
        for (contact, link) in frame.contacts.iter().zip(&links) {
            let relative = match link.from {
                Some(from) => motions[link.on].minus(&motions[from]),
                None => motions[link.on].clone(),
            };
            let [first, second, sliding] = link.wrenches.each_ref().map(|wrench| wrench.power(&relative));
            for opening in [first, second].into_iter().take(contact.points.len()) {
                let by = contact.exact_mu::<N>().times(&sliding.magnitude()).minus(&opening);
                if !by.is_at_most_zero() {
                    let by = by.float() / length_of_normal(contact);
                    faults.push(format!("{}: a contact force can resist, by {by:.1e}", self.names(contact)));
                }
            }
        }
        for grip in &frame.grips {
            for (wrench, limit) in self.grip_wrenches(grip).iter().zip(grip.limits) {
                let speed = wrench.power(&motions[grip.body]).magnitude();
                match limit {
                    Some(limit) => power = power.minus(&speed.times(&N::exact(limit))),
                    None if !speed.is_at_most_zero() => {
                        faults.push(format!(
                            "{} holds without a limit, but moves by {:.1e}",
                            grip.robot,
                            speed.float()
                        ));
                    }
                    None => {}
                }
            }
        }
        if !power.is_positive() {
            faults.push(format!("the loads do no work along the motion: {:.1e}", power.float()));
        }
        faults
    }

    /// The names of the two bodies of a contact.
    pub(super) fn names(&self, contact: &ContactForm) -> String {
        let [on, from] = contact.bodies.map(|index| self.bodies[index].id.as_str());
        format!("{on} on {from}")
    }
}

/// Returns why proofs are given up, if they are.
fn given_up() -> Option<String> {
    let [own, each] = WORK;
    is_spent().then(|| match is_late() {
        true => LATE.to_owned(),
        false => format!(
            "the check needs more than the {own} steps of arithmetic, and {each} for each byte, that a certificate may \
             take; write one for each frame with check --frame"
        ),
    })
}

/// What a proof misses after the deadline.
pub(super) const LATE: &str = "the time limit was reached";

/// Returns what must be at least 0 at a contact, N₁, N₂, and μ (N₁ + N₂) ∓ T; or the components of a grip.
fn conditions<N: Number>(frame: &FrameForm, link: usize, amounts: &[N]) -> [N; 4] {
    let [n1, n2, t] = [0, 1, 2].map(|i| amounts[3 * link + i].clone());
    let Some(contact) = frame.contacts.get(link) else { return [n1, n2, t, N::zero()] };
    let limit = contact.exact_mu::<N>().times(&n1.plus(&n2));
    [n1, n2, limit.minus(&t), limit.plus(&t)]
}

/// Returns by how much the components are changed so that the bodies balance exactly; `None` if no changes do.
fn correction<N: Number>(
    links: &[Link<N>],
    residual: &[Wrench<N>],
    bodies: &[usize],
    components: &[usize],
) -> Option<Vec<N>> {
    let column =
        |component: &usize, body: usize| links[component / 3].on_body(component % 3, body).unwrap_or_else(Wrench::zero);
    if bodies.iter().all(|body| residual[*body].entries().iter().all(|v| v.is_zero())) {
        return Some(vec![N::zero(); components.len()]);
    }
    if let ([body], [_, _, _]) = (bodies, components) {
        let columns: Vec<Wrench<N>> = components.iter().map(|component| column(component, *body)).collect();
        if let Some(changes) = solve(&columns, &residual[*body].negative()) {
            return Some(changes.to_vec());
        }
    }
    let rows = bodies.iter().flat_map(|body| {
        let columns: Vec<Wrench<N>> = components.iter().map(|component| column(component, *body)).collect();
        [0, 1, 2].map(|i| {
            let sides = columns.iter().map(|column| column.entries()[i].clone());
            sides.chain([residual[*body].entries()[i].negative()]).collect::<Vec<_>>()
        })
    });
    eliminate(rows.collect(), components.len())
}

/// The largest number of bodies or components of a step. The equations of more would take long to solve exactly.
pub(super) const LARGEST_STEP: usize = 200;
