//! Checks in exact arithmetic that the contacts of a frame are those of its outlines: each lies where it says, and none is
//! left out.

use std::collections::BTreeMap;

use super::fraction::{Number, Rational, Vector, square, square_length};
use super::links::{ends, normal_of};
use super::number::{is_spent, spend};
use super::{BodyForm, Certificate, CircleForm, ContactForm, FrameForm, Pair};
use crate::geometry::{Aabb, BoxIndex};

/// An edge of a body, with its inside on the left, and the box around it.
type Edge = (Aabb, [Vector; 2]);

impl Certificate {
    /// Checks that the contact points of a frame lie at both outlines and that every pair of bodies that touch has its
    /// contact. Raises `farthest` to the largest distance of a point from an outline.
    pub(super) fn place_faults(&self, frame: &FrameForm, farthest: &mut f64) -> Vec<String> {
        if self.listed {
            return Vec::new();
        }
        let mut faults = Vec::new();
        let allowed = square(&Rational::exact(self.distance));
        for contact in frame.contacts.iter().take_while(|_| !is_spent()) {
            let around = bounds(&contact.points).grown(2.0 * self.distance);
            let mut edges_at = Vec::new();
            for (body, sign) in contact.bodies.iter().zip([1, -1]) {
                let edges = edges(&self.bodies[*body], &around);
                for at in &contact.points {
                    let at = Vector::new(*at);
                    let (away, is_near) = match self.bodies[*body].circle {
                        Some(circle) => {
                            let (away, is_near) = self.at_circle(&at, circle);
                            (away, is_near && contact.points.len() == 1)
                        }
                        None => {
                            let nearest =
                                |edges: &[Edge]| edges.iter().map(|(_, [a, b])| distance_squared(&at, a, b)).min();
                            let near = nearest(&edges).filter(|near| *near <= allowed);
                            let all = || nearest(&super::places::edges(&self.bodies[*body], &EVERYWHERE));
                            let Some(nearest) = near.or_else(all) else { continue };
                            (nearest.float().sqrt(), nearest <= allowed)
                        }
                    };
                    *farthest = farthest.max(away);
                    if !is_near {
                        faults.push(format!("{}: a point does not lie at both outlines", self.names(contact)));
                    }
                }
                edges_at.push((edges, sign));
            }
            if !self.faces(contact, &edges_at) {
                faults.push(format!("{}: the normal does not point from one body into the other", self.names(contact)));
            }
        }
        if frame.verdict == "unstable" {
            faults.extend(self.missing_contacts(frame));
        }
        faults
    }

    /// True if the normal of a contact is that of the outlines: it makes an angle of less than 0.6° with the inner normal
    /// of an edge of the first body or with the outer normal of an edge of the second body at the contact. Where two
    /// corners meet, it separates them.
    fn faces(&self, contact: &ContactForm, edges_at: &[(Vec<Edge>, i32)]) -> bool {
        let normal = normal_of(contact);
        let allowed = square(&Rational::exact(self.distance));
        let middle = Vector::new(contact.points[0]);
        let is_corner = contact.points.len() == 1
            && edges_at.iter().all(|(edges, sign)| separates(&normal, edges, *sign, &middle, &allowed));
        let faces_circle = contact.bodies.iter().zip([1, -1]).any(|(body, sign)| {
            let Some(circle) = self.bodies[*body].circle else { return false };
            agrees(&normal, &Vector::new(circle.centre).minus(&middle), sign)
        });
        is_corner
            || faces_circle
            || edges_at.iter().any(|(edges, sign)| {
                edges.iter().any(|(_, [a, b])| {
                    agrees(&normal, &b.minus(a).turned(), *sign) && distance_squared(&middle, a, b) <= allowed
                })
            })
    }

    /// Returns the pairs of bodies that touch in a frame without a contact.
    ///
    /// Two outlines that come close do so at a corner of one of them. So each corner that lies at another outline must
    /// lie at a contact of these bodies. Where corners carry no force, one corner alone needs no contact, but two on the
    /// same edges that are farther apart than the shortest joint do. Where corners carry force only on edges, one corner
    /// that lies at another needs none.
    fn missing_contacts(&self, frame: &FrameForm) -> Vec<String> {
        let mut faults = Vec::new();
        let allowed = square(&Rational::exact(self.distance));
        let covered = square(&Rational::exact(2.0 * self.distance + self.shortest));
        let ground = (0..self.bodies.len()).filter(|index| self.bodies[*index].ground);
        let present: Vec<usize> = ground.chain(frame.placed.iter().copied()).collect();
        let boxes: Vec<Aabb> = self.bodies.iter().map(BodyForm::bounds).collect();
        // Bodies whose boxes, grown by twice the distance, do not meet do not touch.
        let reach = 2.0 * self.distance;
        let index = BoxIndex::new(present.clone(), |body| boxes[*body]);
        let mut joined = BTreeMap::<[usize; 2], Vec<[Vector; 2]>>::new();
        for contact in &frame.contacts {
            let [one, other] = contact.bodies;
            joined.entry([one.min(other), one.max(other)]).or_default().push(ends(contact));
        }
        for one in &present {
            let mut others: Vec<usize> = index.intersecting(boxes[*one].grown(reach)).copied().collect();
            others.retain(|other| other > one);
            others.sort_unstable();
            for other in &others {
                let bodies = [&self.bodies[*one], &self.bodies[*other]];
                if bodies.iter().all(|body| body.ground) {
                    continue;
                }
                let spans = joined.get(&[*one, *other]).map_or(&[][..], Vec::as_slice);
                let is_covered = |at: &Vector| spans.iter().any(|[a, b]| distance_squared(at, a, b) <= covered);
                let edges =
                    [edges(bodies[0], &boxes[*other].grown(reach)), edges(bodies[1], &boxes[*one].grown(reach))];
                if bodies.iter().any(|body| body.circle.is_some()) {
                    if self.circles_touch(bodies, &edges, spans) {
                        faults.push(format!("{} and {} touch without a contact", bodies[0].id, bodies[1].id));
                    }
                    continue;
                }
                for (around, [a, b]) in &edges[0] {
                    if is_spent() {
                        return faults;
                    }
                    spend(2 * edges[1].len());
                    let around = around.grown(reach);
                    for (_, [c, d]) in edges[1].iter().filter(|(other, _)| around.intersects(other)) {
                        let near = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
                        let near = near.into_iter().filter(|(at, p, q)| distance_squared(at, p, q) <= allowed);
                        let bare: Vec<&Vector> = near.map(|(at, ..)| at).filter(|at| !is_covered(at)).collect();
                        let apart = bare.iter().flat_map(|p| bare.iter().map(|q| square_length(&p.minus(q)))).max();
                        let is_corner = apart.as_ref().is_none_or(|apart| *apart <= covered);
                        let is_tip = |at: &Vector| {
                            let is_near = |end: &Vector| square_length(&at.minus(end)) <= covered;
                            [[a, b], [c, d]].iter().all(|ends| ends.iter().any(|end| is_near(end)))
                        };
                        let carries = |at: &&&Vector| self.corners_carry.on_corners() || !is_tip(at);
                        if !is_corner || self.corners_carry.on_edges() && bare.iter().any(|at| carries(&at)) {
                            let names = bodies.map(|body| body.id.as_str()).join(" and ");
                            faults.push(format!("{names} touch without a contact"));
                        }
                    }
                }
            }
        }
        faults.dedup();
        faults
    }

    /// Returns the distance of a point from a circle in metres, rounded, and whether it is at most the stated distance.
    fn at_circle(&self, at: &Vector, circle: CircleForm) -> (f64, bool) {
        let (radius, distance) = (Rational::exact(circle.radius), Rational::exact(self.distance));
        let away = square_length(&at.minus(&Vector::new(circle.centre)));
        let is_near =
            away <= square(&(&radius + &distance)) && (radius < distance || away >= square(&(&radius - &distance)));
        ((away.float().sqrt() - circle.radius).abs(), is_near)
    }

    /// True if two bodies, of which at least one is a circle, touch where they have no contact.
    ///
    /// The foot of a circle on an edge must lie at a contact. Beside a contact, an edge leaves the circle slowly: at a
    /// chord whose square is 4 r d, the gap is twice the distance d.
    fn circles_touch(&self, bodies: [&BodyForm; 2], edges: &[Vec<Edge>; 2], spans: &[[Vector; 2]]) -> bool {
        let distance = Rational::exact(self.distance);
        if let [Some(one), Some(other)] = bodies.map(|body| body.circle) {
            let away = square_length(&Vector::new(one.centre).minus(&Vector::new(other.centre)));
            return spans.is_empty()
                && away <= square(&(Rational::exact(one.radius) + Rational::exact(other.radius) + distance));
        }
        (0..2).any(|k| {
            let Some(circle) = bodies[k].circle else { return false };
            let (centre, radius) = (Vector::new(circle.centre), Rational::exact(circle.radius));
            let reach = square(&(&radius + &distance));
            let covered =
                square(&Rational::exact(2.0 * self.distance + self.shortest)) + Rational::from(4) * &radius * &distance;
            edges[1 - k].iter().any(|(_, [a, b])| {
                let along = b.minus(a);
                let (length, place) = (square_length(&along), along.dot(&centre.minus(a)));
                let is_end = place < Rational::ZERO || place > length;
                if (is_end && !self.corners_carry.on_edges()) || distance_squared(&centre, a, b) > reach {
                    return false;
                }
                let share = if place < Rational::ZERO { Rational::ZERO } else { place.min(length.clone()) } / length;
                let foot = Vector { x: &a.x + along.x * &share, y: &a.y + along.y * &share };
                spans.iter().all(|[p, _]| square_length(&foot.minus(p)) > covered)
            })
        })
    }
}

/// True if a contact normal has the direction of an inner normal of the first body (sign 1), or of an outer one of the second
/// body (sign −1).
fn agrees(normal: &Vector, inner: &Vector, sign: i32) -> bool {
    let along = normal.dot(inner) * Rational::from(sign);
    along > Rational::ZERO && square(&normal.cross(inner)) <= Rational::exact(ANGLE_SQUARED) * square(&along)
}

/// True if both edges of a body that meet at a corner lie on its own side of the contact: along the normal for the first
/// body (sign 1), against it for the second (sign −1).
fn separates(normal: &Vector, edges: &[Edge], sign: i32, at: &Vector, allowed: &Rational) -> bool {
    let ends = edges.iter().flat_map(|(_, [a, b])| [(a, b), (b, a)]);
    let ways = ends.filter(|(near, _)| square_length(&near.minus(at)) <= *allowed).map(|(near, far)| far.minus(near));
    let ways: Vec<Vector> = ways.collect();
    ways.len() == 2
        && ways.iter().all(|way| {
            let along = normal.dot(way) * Rational::from(sign);
            along >= Rational::ZERO || square(&along) <= Rational::exact(ANGLE_SQUARED) * square(&normal.cross(way))
        })
}

/// The square of the tangent of the largest angle between a contact and the edge that it lies at. A joint of bricks
/// within the contact tolerance may be turned by about 0.1°.
const ANGLE_SQUARED: f64 = 1e-4;

/// A box around all.
const EVERYWHERE: Aabb = Aabb { min: [f64::NEG_INFINITY; 2], max: [f64::INFINITY; 2] };

/// The edges of a body whose boxes meet a box; none for a circle.
fn edges(body: &BodyForm, around: &Aabb) -> Vec<Edge> {
    let rings = std::iter::once(&body.outline).chain(&body.holes);
    let sides = rings.flat_map(|ring| {
        spend(5 * ring.len());
        ring.iter().zip(ring.iter().cycle().skip(1))
    });
    let near = sides.map(|(p, q)| (bounds([p, q]), [p, q])).filter(|(own, _)| own.intersects(around));
    near.map(|(own, ends)| (own, ends.map(|at| Vector::new(*at)))).collect()
}

/// The box around points.
fn bounds<'p>(points: impl IntoIterator<Item = &'p Pair>) -> Aabb {
    let none = Aabb { min: [f64::INFINITY; 2], max: [f64::NEG_INFINITY; 2] };
    points.into_iter().fold(none, |Aabb { min, max }, p| Aabb {
        min: [min[0].min(p[0]), min[1].min(p[1])],
        max: [max[0].max(p[0]), max[1].max(p[1])],
    })
}

impl BodyForm {
    /// The box around the body.
    fn bounds(&self) -> Aabb {
        spend(5 * self.outline.len());
        let ends = self.circle.map(|CircleForm { centre, radius }| {
            [centre.map(|at| (at - radius).next_down()), centre.map(|at| (at + radius).next_up())]
        });
        bounds(self.outline.iter().chain(ends.iter().flatten()))
    }
}

/// The square of the distance of a point from a segment.
fn distance_squared(at: &Vector, a: &Vector, b: &Vector) -> Rational {
    let (along, from) = (b.minus(a), at.minus(a));
    let (length, place) = (square_length(&along), along.dot(&from));
    if place <= Rational::ZERO {
        square_length(&from)
    } else if place >= length {
        square_length(&at.minus(b))
    } else {
        square(&along.cross(&from)) / length
    }
}
