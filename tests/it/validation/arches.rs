//! Arches under their own weight, on a tilted ground, and with a horizontal load.

use std::f64::consts::PI;
use std::sync::OnceLock;

use drystone::Analysis;
use drystone::analysis::Contact;
use serde_json::{Value, json};

use super::measure::{frame, friction, horizontal, limit, tilt};
use crate::structure::{rectangle, scene};

/// An arch of `n` voussoirs with radial joints. It spans an angle of `embrace` degrees, and its mean radius is 1.
pub struct Arch {
    pub n: usize,
    pub thickness: f64,
    pub friction: f64,
    pub embrace: f64,
    /// Whether the weight of a voussoir acts on the mean radius instead of at its centroid.
    pub on_the_line: bool,
}

/// The number of voussoirs of the arches whose limit is computed.
const FINE: usize = 60;

impl Arch {
    pub fn semicircle(n: usize, thickness: f64, friction: f64) -> Self {
        let (embrace, on_the_line) = (180.0, false);
        Self { n, thickness, friction, embrace, on_the_line }
    }

    fn point(&self, radius: f64, k: f64) -> [f64; 2] {
        let degrees = (180.0 - self.embrace) / 2.0 + self.embrace * k / self.n as f64;
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let ends = self.embrace == 180.0 && (k == 0.0 || k == self.n as f64);
        [-radius * cos, if ends { 0.0 } else { radius * sin }]
    }

    fn joint(&self, k: usize) -> [[f64; 2]; 2] {
        let half = self.thickness / 2.0;
        [self.point(1.0 - half, k as f64), self.point(1.0 + half, k as f64)]
    }

    /// The ground behind the joint at a springing. It is 0.3 thick.
    fn abutment(&self, k: usize) -> Value {
        let [inner, outer] = self.joint(k);
        let side = if k == 0 { -1.0 } else { 1.0 };
        let length = libm::hypot(outer[0] - inner[0], outer[1] - inner[1]);
        let along = [side * (outer[1] - inner[1]) / length, -side * (outer[0] - inner[0]) / length];
        let back = |p: [f64; 2]| [p[0] + 0.3 * along[0], p[1] + 0.3 * along[1]];
        json!({ "polygon": [inner, outer, back(outer), back(inner)] })
    }

    pub fn file(&self) -> Value {
        let weight = PI * self.embrace / 180.0 / self.n as f64 * self.thickness;
        let half = (self.embrace / self.n as f64 / 2.0).to_radians();
        let (mut blocks, mut loads) = (Vec::new(), Vec::new());
        for k in 0..self.n {
            let ([a, b], [d, c]) = (self.joint(k), self.joint(k + 1));
            let mut block = json!({ "id": format!("v{k}"), "polygon": [a, d, c, b] });
            if self.on_the_line {
                // The centroid of an arc of the mean circle.
                let at = self.point(libm::sin(half) / half, k as f64 + 0.5);
                block["weight"] = json!(0);
                loads.push(json!({ "block": format!("v{k}"), "force": [0.0, -weight], "at": at }));
            }
            blocks.push(block);
        }
        let ground = if self.embrace == 180.0 {
            json!([{ "polygon": rectangle(-1.6, -0.3, 3.2, 0.3) }])
        } else {
            json!([self.abutment(0), self.abutment(self.n)])
        };
        json!({ "drystone": 1, "friction": self.friction, "gravity": [0, -1],
            "ground": ground, "blocks": blocks, "loads": loads })
    }
}

fn on_the_line(thickness: f64, friction: f64) -> Value {
    let mut arch = Arch::semicircle(FINE, thickness, friction);
    arch.on_the_line = true;
    arch.file()
}

pub fn least_thickness() -> f64 {
    limit([0.106, 0.109], 1e-7, |t| Arch::semicircle(FINE, t, 2.0).file())
}

pub fn least_thickness_on_the_line() -> f64 {
    limit([0.106, 0.109], 1e-7, |t| on_the_line(t, 2.0))
}

/// The least thickness of the arch, rounded up to 10⁻⁵. There the forces are unique, up to about 10⁻⁵.
const THIN: f64 = 0.10741;

/// The horizontal thrust of the thinnest arch, divided by weight per length times radius.
pub fn thrust_of_the_thinnest() -> f64 {
    let frame = frame(&on_the_line(THIN, 2.0));
    let crown = frame.contacts.iter().find(|c| c.interface.ends.iter().all(|p| p.x.abs() < 1e-9));
    let crown = crown.expect("an even number of voussoirs has a joint at the crown");
    crown.normal_forces.iter().sum::<f64>() / THIN
}

/// The least and the greatest horizontal thrust with which the thinnest arch is in equilibrium, divided by weight per
/// length times radius. At the least thickness both are equal.
fn thrusts_of_the_thinnest() -> [f64; 2] {
    static FOUND: OnceLock<[f64; 2]> = OnceLock::new();
    *FOUND.get_or_init(|| {
        let states = Analysis::new(scene(&on_the_line(THIN, 2.0))).thrust_states(0);
        let both = [states.least, states.greatest];
        both.map(|state| state.expect("an arch has a thrust").thrust / THIN)
    })
}

pub fn least_thrust_of_the_thinnest() -> f64 {
    thrusts_of_the_thinnest()[0]
}

pub fn greatest_thrust_of_the_thinnest() -> f64 {
    thrusts_of_the_thinnest()[1]
}

/// The angle from the crown, degrees, and the radius of the resultant of a joint.
fn resultant(contact: &Contact) -> [f64; 2] {
    let [p, q] = contact.interface.ends;
    let middle = p + (q - p) * 0.5;
    let at = contact.resultant.at;
    [libm::atan2(middle.x, middle.y).to_degrees(), libm::hypot(at.x, at.y)]
}

/// The angle from the crown at which the line of thrust touches the intrados, degrees. It is the extremum of a
/// parabola through the three nearest joints.
pub fn hinge_of_the_thinnest() -> f64 {
    let frame = frame(&on_the_line(THIN, 2.0));
    let mut joints: Vec<[f64; 2]> = frame.contacts.iter().map(resultant).collect();
    joints.retain(|[angle, _]| *angle > 1.0);
    joints.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let lowest = (1..joints.len() - 1).min_by(|a, b| joints[*a][1].total_cmp(&joints[*b][1]));
    let k = lowest.expect("joints");
    let [before, here, after] = [joints[k - 1], joints[k], joints[k + 1]];
    let bend = after[1] - 2.0 * here[1] + before[1];
    here[0] - (here[0] - before[0]) * (after[1] - before[1]) / (2.0 * bend)
}

pub fn friction_of_the_thinnest() -> f64 {
    friction(&on_the_line(THIN, 2.0))
}

pub fn friction_of_a_thick_arch() -> f64 {
    static FOUND: OnceLock<f64> = OnceLock::new();
    *FOUND.get_or_init(|| friction(&on_the_line(0.3, 2.0)))
}

/// The least thickness for a friction coefficient a millionth above `friction_of_a_thick_arch`.
pub fn thickness_at_least_friction() -> f64 {
    let mu = friction_of_a_thick_arch() * (1.0 + 1e-6);
    limit([0.195, 0.205], 1e-6, |t| on_the_line(t, mu))
}

/// Points of a circle about the origin between two abscissae, above the axis.
fn circle(radius: f64, from: f64, to: f64, parts: usize) -> Vec<[f64; 2]> {
    let angle = |x: f64| libm::asin((x / radius).clamp(-1.0, 1.0));
    let (first, last) = (angle(from), angle(to));
    let mut points: Vec<[f64; 2]> = (0..=parts)
        .map(|j| {
            let (sin, cos) = libm::sincos(first + (last - first) * j as f64 / parts as f64);
            [radius * sin, radius * cos]
        })
        .collect();
    let y = |x: f64| libm::sqrt((radius * radius - x * x).max(0.0));
    (points[0], points[parts]) = ([from, y(from)], [to, y(to)]);
    points
}

/// A semicircular arch with mean radius 1 and vertical joints, at most `cuts`.
pub fn cut_vertically(thickness: f64, cuts: usize) -> Value {
    let (inner, outer) = (1.0 - thickness / 2.0, 1.0 + thickness / 2.0);
    let mut at: Vec<f64> =
        (0..=cuts).map(|k| -libm::cos(PI * k as f64 / cuts as f64)).filter(|x| x.abs() < 0.995 * inner).collect();
    let mut blocks = Vec::new();
    let half = at.len() / 2;
    at[half] = 0.0;
    for k in 0..half {
        at[2 * half - k] = -at[k];
    }
    let ring = |from: f64, to: f64, foot: bool| {
        let parts = if foot { 8 } else { 2 };
        let above = if foot { -outer } else { from };
        let below = if foot { -inner } else { from };
        let mut polygon = circle(outer, above, to, parts);
        polygon.extend(circle(inner, below, to, parts).into_iter().rev());
        polygon
    };
    let foot = ring(0.0, at[0], true);
    blocks.push(foot.iter().map(|[x, y]| [-x, *y]).rev().collect());
    blocks.push(foot);
    blocks.extend(at.windows(2).map(|pair| ring(pair[0], pair[1], false)));
    let blocks: Vec<Value> = blocks
        .into_iter()
        .enumerate()
        .map(|(k, polygon)| json!({ "id": format!("v{k}"), "polygon": polygon }))
        .collect();
    json!({ "drystone": 1, "friction": 20, "gravity": [0, -1],
        "ground": [{ "polygon": rectangle(-1.6, -0.3, 3.2, 0.3) }], "blocks": blocks })
}

pub fn least_thickness_cut_vertically() -> f64 {
    limit([0.107, 0.112], 1e-7, |t| cut_vertically(t, 60))
}

/// Oppenheim's arch, which spans an angle of 157.5°. Its thickness is 0.15 of the radius. The published arch has
/// seven voussoirs.
pub fn oppenheim(voussoirs: usize) -> Value {
    let mut arch = Arch::semicircle(voussoirs, 0.15, 2.0);
    arch.embrace = 157.5;
    arch.file()
}

pub fn oppenheim_pushed() -> f64 {
    horizontal(&oppenheim(7))
}

/// The sample arch of LACT3: the 25 middle voussoirs of a semicircle of 27, with radii of 317 and 373.3 mm and φ =
/// 30°. The ground has the shape of the two outer voussoirs.
pub fn lact3() -> Value {
    let at = |radius: f64, k: usize| {
        let (sin, cos) = libm::sincos(PI * k as f64 / 27.0);
        [-radius * cos, radius * sin]
    };
    let (inner, outer) = (0.317, 0.3733);
    let blocks: Vec<Value> = (1..26)
        .map(|k| {
            json!({ "id": format!("v{k}"),
                "polygon": [at(inner, k), at(outer, k), at(outer, k + 1), at(inner, k + 1)] })
        })
        .collect();
    let base = [
        at(outer, 1),
        at(inner, 1),
        [-inner, 0.0],
        [inner, 0.0],
        at(inner, 26),
        at(outer, 26),
        [outer, 0.0],
        [0.6233, 0.0],
        [0.6233, -0.075],
        [-0.6233, -0.075],
        [-0.6233, 0.0],
        [-outer, 0.0],
    ];
    json!({ "drystone": 1, "friction": libm::tan(PI / 6.0), "ground": [{ "polygon": base }], "blocks": blocks })
}

pub fn lact3_tilted() -> f64 {
    tilt(&lact3())
}
