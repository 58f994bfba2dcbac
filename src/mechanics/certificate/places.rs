//! Checks in exact arithmetic that the contacts of a frame are those of its outlines: each lies where it says, and none is
//! left out.

use super::fraction::{Number, Rational, Vector, square, square_length};
use super::links::{ends, normal_of, sides};
use super::{BodyForm, Certificate, CircleForm, ContactForm, FrameForm};

impl Certificate {
    /// Checks that the contact points of a frame lie at both outlines and that every pair of bodies that touch has its
    /// contact. Raises `farthest` to the largest distance of a point from an outline.
    pub(super) fn place_faults(&self, frame: &FrameForm, farthest: &mut f64) -> Vec<String> {
        if self.listed {
            return Vec::new();
        }
        let mut faults = Vec::new();
        let allowed = square(&Rational::exact(self.distance));
        for contact in &frame.contacts {
            let mut edges_at = Vec::new();
            for (body, sign) in contact.bodies.iter().zip([1, -1]) {
                let edges = edges(&self.bodies[*body]);
                for at in &contact.points {
                    let at = Vector::new(*at);
                    let (away, is_near) = match self.bodies[*body].circle {
                        Some(circle) => {
                            let (away, is_near) = self.at_circle(&at, circle);
                            (away, is_near && contact.points.len() == 1)
                        }
                        None => {
                            let nearest = edges.iter().map(|[a, b]| distance_squared(&at, a, b)).min();
                            let Some(nearest) = nearest else { continue };
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
    fn faces(&self, contact: &ContactForm, edges_at: &[(Vec<[Vector; 2]>, i32)]) -> bool {
        let normal = normal_of(contact);
        let allowed = square(&Rational::exact(self.distance));
        let middle = Vector::new(contact.points[0]);
        let is_corner = contact.points.len() == 1
            && edges_at.iter().all(|(edges, sign)| separates(&normal, edges, *sign, &middle, &allowed));
        let faces_circle = contact.bodies.iter().zip([1, -1]).any(|(body, sign)| {
            let Some(circle) = self.bodies[*body].circle else { return false };
            let inner = Vector::new(circle.centre).minus(&middle);
            let along = normal.dot(&inner) * Rational::from(sign);
            along > Rational::ZERO && square(&normal.cross(&inner)) <= Rational::exact(ANGLE_SQUARED) * square(&along)
        });
        is_corner
            || faces_circle
            || edges_at.iter().any(|(edges, sign)| {
                edges.iter().any(|[a, b]| {
                    let inner = b.minus(a).turned();
                    let along = normal.dot(&inner) * Rational::from(*sign);
                    let across = square(&normal.cross(&inner));
                    // An edge shorter than the distance bounds no angle; tan² = (10⁻³)² for the others.
                    along > Rational::ZERO
                        && across <= Rational::exact(ANGLE_SQUARED) * square(&along)
                        && distance_squared(&middle, a, b) <= allowed
                })
            })
    }

    /// Returns the pairs of bodies that touch in a frame without a contact.
    ///
    /// Two outlines that come close do so at a corner of one of them. So each corner that lies at another outline must
    /// lie at a contact of these bodies. Where corners carry no force, one corner alone needs no contact, but two on the
    /// same edges that are farther apart than the shortest joint do.
    fn missing_contacts(&self, frame: &FrameForm) -> Vec<String> {
        let mut faults = Vec::new();
        let allowed = square(&Rational::exact(self.distance));
        let covered = square(&Rational::exact(2.0 * self.distance + self.shortest));
        let shortest = square(&Rational::exact(self.shortest + 2.0 * self.distance));
        let ground = (0..self.bodies.len()).filter(|index| self.bodies[*index].ground);
        let present: Vec<usize> = ground.chain(frame.placed.iter().copied()).collect();
        for (k, one) in present.iter().enumerate() {
            for other in &present[k + 1..] {
                let bodies = [&self.bodies[*one], &self.bodies[*other]];
                if bodies.iter().all(|body| body.ground) || !boxes_meet(bodies, self.distance) {
                    continue;
                }
                let contacts =
                    frame.contacts.iter().filter(|c| c.bodies == [*one, *other] || c.bodies == [*other, *one]);
                let spans: Vec<[Vector; 2]> = contacts.map(ends).collect();
                let is_covered = |at: &Vector| spans.iter().any(|[a, b]| distance_squared(at, a, b) <= covered);
                let edges = bodies.map(edges);
                if bodies.iter().any(|body| body.circle.is_some()) {
                    if self.circles_touch(bodies, &edges, &spans) {
                        faults.push(format!("{} and {} touch without a contact", bodies[0].id, bodies[1].id));
                    }
                    continue;
                }
                for [a, b] in &edges[0] {
                    for [c, d] in &edges[1] {
                        let near = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
                        let near = near.into_iter().filter(|(at, p, q)| distance_squared(at, p, q) <= allowed);
                        let bare: Vec<&Vector> = near.map(|(at, ..)| at).filter(|at| !is_covered(at)).collect();
                        let apart = bare.iter().flat_map(|p| bare.iter().map(|q| square_length(&p.minus(q)))).max();
                        let is_corner = apart.as_ref().is_none_or(|apart| *apart <= shortest);
                        if !is_corner || (self.corners_carry && !bare.is_empty()) {
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
    fn circles_touch(&self, bodies: [&BodyForm; 2], edges: &[Vec<[Vector; 2]>; 2], spans: &[[Vector; 2]]) -> bool {
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
            edges[1 - k].iter().any(|[a, b]| {
                let along = b.minus(a);
                let (length, place) = (square_length(&along), along.dot(&centre.minus(a)));
                let is_end = place < Rational::ZERO || place > length;
                if (is_end && !self.corners_carry) || distance_squared(&centre, a, b) > reach {
                    return false;
                }
                let share = if place < Rational::ZERO { Rational::ZERO } else { place.min(length.clone()) } / length;
                let foot = Vector { x: &a.x + along.x * &share, y: &a.y + along.y * &share };
                spans.iter().all(|[p, _]| square_length(&foot.minus(p)) > covered)
            })
        })
    }
}

/// True if both edges of a body that meet at a corner lie on its own side of the contact: along the normal for the first
/// body (sign 1), against it for the second (sign −1).
fn separates(normal: &Vector, edges: &[[Vector; 2]], sign: i32, at: &Vector, allowed: &Rational) -> bool {
    let ends = edges.iter().flat_map(|[a, b]| [(a, b), (b, a)]);
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

/// The edges of a body, with its inside on the left; none for a circle.
fn edges(body: &BodyForm) -> Vec<[Vector; 2]> {
    std::iter::once(&body.outline).chain(&body.holes).flat_map(|ring| sides(ring)).collect()
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

/// True if the boxes around two bodies, grown by twice the distance, meet. Bodies for which this is false do not touch.
fn boxes_meet(bodies: [&BodyForm; 2], distance: f64) -> bool {
    [0, 1].iter().all(|axis| {
        let [one, other] = bodies.map(|body| {
            let ends = body.circle.map(|circle| [-1.0, 1.0].map(|sign| circle.centre[*axis] + sign * circle.radius));
            let places = body.outline.iter().map(|p| p[*axis]).chain(ends.into_iter().flatten());
            places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        });
        one[0] - 2.0 * distance <= other[1] && other[0] - 2.0 * distance <= one[1]
    })
}
