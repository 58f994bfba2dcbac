//! Proofs of a placement tolerance: forces for all errors up to it, and a motion for a pattern of errors beyond it.

use std::collections::{BTreeMap, BTreeSet};

use super::fraction::{Number, Rational, Vector, square, square_length};
use super::limits::{DISTANCES, Limits};
use super::links::{length_of_normal, normal_of};
use super::make::listed_forces;
use super::number::{is_spent, spend};
use super::stand::{links_of, order};
use super::{BodyForm, Change, ContactForm, ErrorsForm, FrameForm, LimitForm, Sparse};
use crate::mechanics::analysis::{Placement, Verdict};

impl FrameForm {
    /// Returns the largest error of a body, metres. That of the ground is 0.
    fn error<N: Number>(&self, body: usize) -> N {
        let Some(errors) = self.errors.as_ref().filter(|_| !is_spent()) else { return N::zero() };
        spend(self.placed.len() + errors.scales.len());
        if !self.placed.contains(&body) {
            return N::zero();
        }
        let own = errors.scales.iter().rev().find(|(other, _)| *other == body);
        own.map_or(N::exact(1.0), |(_, scale)| N::exact(*scale)).times(&N::exact(errors.size))
    }

    /// Returns by which share of its length the errors move the ends of a contact inward. It is rounded to the safe side:
    /// up for forces, down for a motion. `None` if the numbers are too large.
    pub(super) fn inset<N: Number>(&self, contact: &ContactForm) -> Option<N> {
        let [one, other] = contact.bodies.map(|body| self.error::<Rational>(body));
        let body = contact.bodies[usize::from(other > one)];
        if self.errors.is_none() || one.is_zero() && other.is_zero() {
            return Some(N::zero());
        }
        let length = root(&square_length(&normal_of(contact)), self.verdict == "unstable")?;
        self.error::<N>(body).over(&N::exact(length))
    }

    /// Returns the largest moment by which the errors of a body change its balance, N·m, rounded like
    /// [`inset`](Self::inset).
    pub(super) fn moment<N: Number>(&self, body: usize, form: &BodyForm) -> Option<N> {
        let size = |force| root(&square_length(&Vector::new(force)), self.verdict != "unstable").map(N::exact);
        let mut sum = N::exact(form.weight).times(&size(self.gravity)?);
        let factor = |fixed: bool| N::exact(if fixed { 1.0 } else { self.load_factor.abs() });
        let further = self.force.iter().filter(|(other, _)| *other == body).map(|(_, load)| (load, true));
        for (load, fixed) in form.loads.iter().map(|load| (load, load.fixed)).chain(further) {
            sum = sum.plus(&factor(fixed).times(&size(load.force)?));
        }
        Some(sum.times(&self.error(body)))
    }

    /// Returns what is not valid in the errors of the frame.
    pub(super) fn error_faults(&self, bodies: &[BodyForm]) -> Option<&'static str> {
        let errors = self.errors.as_ref()?;
        let is_placed = |list: &Sparse, least: f64, most: f64| {
            let different: BTreeSet<usize> = list.iter().map(|(body, _)| *body).collect();
            different.len() == list.len()
                && list.iter().all(|(body, value)| self.placed.contains(body) && (least..=most).contains(value))
        };
        let too_short = |contact: &ContactForm| {
            let taken = self.inset::<Rational>(contact).map(|inset| inset + Rational::exact(self.kernel / 2.0));
            taken.is_none_or(|taken| taken > Rational::exact(0.5))
        };
        let has_room = |contact: &ContactForm| {
            contact.points.len() == 2 || contact.bodies.iter().all(|body| self.error::<Rational>(*body).is_zero())
        };
        if errors.size < 0.0 || !is_placed(&errors.scales, 0.0, f64::MAX) || !is_placed(&errors.pattern, -1.0, 1.0) {
            Some("an error is not valid")
        } else if self.placed.iter().any(|body| self.moment::<Rational>(*body, &bodies[*body]).is_none()) {
            Some("a force is too large")
        } else if self.verdict == "stable" && !(errors.pattern.is_empty() && self.contacts.iter().all(has_room)) {
            Some("a pattern, or a contact at one point, leaves no room for all errors")
        } else {
            self.contacts.iter().any(too_short).then_some("an error leaves a joint no length")
        }
    }
}

/// Returns a double whose square is at least, or at most, the given number; `None` if no double is near enough.
fn root(number: &Rational, is_above: bool) -> Option<f64> {
    let mut root = number.float().sqrt();
    for _ in 0..8 {
        let own = root.is_finite().then(|| square(&Rational::exact(root)))?;
        if if is_above { own >= *number } else { own <= *number } {
            return Some(root);
        }
        root = if is_above { root.next_up() } else { root.next_down() };
    }
    None
}

impl Limits<'_> {
    /// Adds the proofs of a placement tolerance: the largest one that is exactly proved, and the pattern that falls.
    pub(super) fn add_placement(&self, proofs: &mut Vec<LimitForm>, found: &Placement) {
        let placed = self.assembly.bodies.iter().zip(&self.bare.placed);
        let scales = placed.map(|(body, index)| (*index, self.scene.blocks[body.block.0].placement));
        let scales: Sparse = scales.filter(|(_, scale)| *scale != 1.0).collect();
        let errors = |size, pattern| Some(ErrorsForm { size, scales: scales.clone(), pattern });
        let name = |size: f64| format!("placement {size} m");
        let mut last = None;
        for share in DISTANCES.into_iter().filter(|_| found.proved > 0.0) {
            let change = Change { errors: errors(found.proved * (1.0 - share), Vec::new()), ..Change::default() };
            let bare = FrameForm { verdict: Verdict::Stable.word().to_owned(), ..change.of(self.bare) };
            let Some(proved) = self.for_all_errors(&bare, found) else { break };
            let is_exact = self.certificate.proof_faults(&proved).is_empty();
            last = Some(LimitForm::new(&name(found.proved), change, proved));
            if is_exact {
                break;
            }
        }
        proofs.extend(last);
        let Some(at) = found.falls_at else { return };
        // Errors that leave a joint no length are no errors, so a tolerance that ends with the joint has no proof beyond it.
        let errors_beyond = errors(at * (1.0 + DISTANCES[0]), Vec::new());
        let beyond =
            FrameForm { verdict: Verdict::Unstable.word().to_owned(), errors: errors_beyond, ..self.bare.clone() };
        if beyond.error_faults(&self.certificate.bodies).is_some() {
            return;
        }
        proofs.extend(self.proof(&name(at), Verdict::Unstable, &found.mechanism, &|share| {
            let size = at * (1.0 + share);
            let (signs, moved) = found.with_errors(self.scene, self.assembly, size);
            let pattern = self.bare.placed.iter().copied().zip(signs).filter(|(_, sign)| *sign != 0.0);
            (Change { errors: errors(size, pattern.collect()), ..Change::default() }, moved)
        }));
    }

    /// Adds to a frame with errors the forces that balance it for all of them. The order of their correction has the
    /// largest slack that all errors leave.
    fn for_all_errors(&self, bare: &FrameForm, found: &Placement) -> Option<FrameForm> {
        let size = bare.errors.as_ref()?.size;
        let insets = bare.contacts.iter().map(|contact| bare.inset::<Rational>(contact));
        let insets: Vec<f64> = insets.map(|share| Some(share?.float() / (1.0 - bare.kernel))).collect::<Option<_>>()?;
        // N₁ and N₂ act at the ends of the contact in the analysis, and farther inward in the certificate.
        let inward = |link: usize, [n1, n2, t]: [f64; 3]| {
            let Some(share) = insets.get(link) else { return [n1, n2, t] };
            let [n1, n2] = [n1, n2].map(|n| (n - share * (n1 + n2)) / (1.0 - 2.0 * share));
            [n1, n2, t]
        };
        let rows = |link: usize, [n1, n2, t]: [f64; 3]| match bare.contacts.get(link) {
            Some(ContactForm { friction, .. }) => [n1, n2, friction * (n1 + n2) - t, friction * (n1 + n2) + t],
            None => [n1, n2, t, 0.0],
        };
        let mut forces: Vec<[f64; 3]> = listed_forces(self.assembly, self.found);
        let mut spread = vec![[0.0; 4]; forces.len()];
        let mut reactions = Vec::new();
        for proof in &found.proofs {
            let links = links_of(self.assembly, &proof.interfaces, &proof.holds);
            let by_link = |entries: &[(usize, f64)]| {
                let mut sum: BTreeMap<usize, [f64; 3]> = BTreeMap::new();
                entries
                    .iter()
                    .for_each(|(number, force)| sum.entry(links[number / 3]).or_default()[number % 3] = *force);
                sum.into_iter().map(|(link, force)| (link, inward(link, force)))
            };
            links.iter().for_each(|link| forces[*link] = [0.0; 3]);
            by_link(&proof.forces).for_each(|(link, force)| forces[link] = force);
            for (block, entries) in &proof.reactions {
                let body = self.assembly.bodies.iter().position(|body| body.block == *block)?;
                let mut own = Sparse::new();
                for (link, force) in by_link(entries) {
                    let more = rows(link, force).map(|value| size * value.abs());
                    spread[link].iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
                    let length = bare.contacts.get(link).map_or(1.0, length_of_normal);
                    own.extend((0..3).map(|i| (3 * link + i, force[i] / length)).filter(|(_, force)| *force != 0.0));
                }
                reactions.push((bare.placed[body], own));
            }
        }
        let slack = forces.iter().enumerate().map(|(link, force)| match bare.contacts.get(link) {
            Some(ContactForm { friction, .. }) => {
                let [n1, n2, left, right] = [0, 1, 2, 3].map(|i| rows(link, *force)[i] - spread[link][i]);
                [n1, n2, (friction * (n1 + n2) - left.min(right)).max(0.0)]
            }
            None => [0, 1, 2].map(|i| force[i].abs() + spread[link][i]),
        });
        let (order, _) = order(self.assembly, bare, &slack.collect::<Vec<_>>(), false);
        let mut proved = self.certificate.with_forces(bare, self.assembly, &forces, Some(f64::NEG_INFINITY))?;
        if let Some(forces) = &mut proved.forces {
            (forces.order, forces.reactions) = (order, reactions);
        }
        Some(proved)
    }
}
