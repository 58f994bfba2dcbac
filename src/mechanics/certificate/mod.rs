//! [`Certificate`]: a verdict with all that a stranger needs to check it in exact arithmetic, without this program.
//!
//! A certificate contains the structure in its normal form (outlines of the placed bodies in metres, loads in newtons,
//! contacts with their points), and for each frame either forces or a motion. Every number is a double and stands for
//! the rational number that it is. [`check`](Certificate::check) decides the inequalities with rational arithmetic:
//!
//! - *Stands:* forces that press and stay within the friction cone of every contact. Their residual, which rounding
//!   leaves on each body, is computed exactly and carried to the ground by three force components per body, in the
//!   order that the certificate gives. The corrected forces balance every body exactly; then each inequality is checked
//!   again. Forces with slack at every contact survive the correction, so `make` looks for the largest slack.
//! - *Falls:* a motion along which no contact force can resist, and the loads do more work than the robots can absorb.
//!
//! The page [`certificate`](crate::doc::certificate) describes the file. Both proofs are the theorems of limit analysis
//! ([Livesley78](crate::doc::references)).

mod check;
mod fall;
mod fraction;
mod limits;
mod links;
mod make;
mod number;
mod placement;
mod places;
mod stand;

use serde::{Deserialize, Serialize};

pub use check::{Checked, FrameCheck, LimitCheck};

use self::fraction::Number;
use crate::mechanics::scene::CornerContacts;

/// A point or a vector: x to the right and y up, in metres, newtons or without unit.
pub type Pair = [f64; 2];

/// Bodies and components of forces for which equations are solved exactly. Component 3k + i is number i (0, 1, 2) of
/// contact k; the grips follow the contacts.
pub type Step = (Vec<usize>, Vec<usize>);

/// A body, its weight in newtons, and its loads.
pub type Loaded = (usize, f64, Vec<LoadForm>);

/// Values of some bodies, or of some components of forces, by their number.
pub type Sparse = Vec<(usize, f64)>;

/// The proofs of a scene's frames, and the structure that they are about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// The version of the format: 1.
    pub drystone_certificate: u32,
    /// The SHA-256 of the bytes of the scene file, in hexadecimal digits; empty if the scene is not from a file.
    pub scene_sha256: String,
    /// The largest distance of a contact point from the outlines that it joins, metres. Bodies that come closer than
    /// this need a contact.
    pub distance: f64,
    /// Whether a corner that touches carries force. If not, two outlines may touch along less than `shortest` without a
    /// contact.
    pub corners_carry: CornerContacts,
    /// The length in metres up to which a common edge counts as a corner.
    pub shortest: f64,
    /// Whether the contacts are given by the scene. Their position is then not checked against the outlines.
    pub listed: bool,
    /// All bodies: first the parts of the ground, then the blocks.
    pub bodies: Vec<BodyForm>,
    /// One entry for each frame of the scene.
    pub frames: Vec<FrameForm>,
    /// Proofs of the margins and capacities: for each end of a margin, and for each corner and edge of a capacity, a
    /// changed frame just inside that stands and one just beyond that falls. Also the proofs of a frame that stands in its
    /// other load cases, and under its vehicle.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<LimitForm>,
}

/// A body in metres and newtons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyForm {
    /// The name: the id of a block, or `ground`.
    pub id: String,
    /// Whether the body is a part of the ground, which never moves and bears any load.
    pub ground: bool,
    /// The corners of the outline, metres, anticlockwise; empty for a circle.
    pub outline: Vec<Pair>,
    /// The circle, if the body is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub circle: Option<CircleForm>,
    /// The corners of each hole, metres, clockwise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Pair>>,
    /// The weight, N, along the gravity of the frame.
    pub weight: f64,
    /// The point at which the weight acts, metres, if the scene gives one. Otherwise the checker computes the centroid of the
    /// outline with its holes cut out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre: Option<Pair>,
    /// The loads that act besides the weight.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadForm>,
}

/// A circle, in metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CircleForm {
    /// The centre.
    pub centre: Pair,
    /// The radius, more than 0.
    pub radius: f64,
}

/// A load on a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadForm {
    /// The force, N.
    pub force: Pair,
    /// The point at which it acts, metres; the point at which the weight acts, if it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Pair>,
    /// The torque, N·m, anticlockwise positive.
    pub torque: f64,
    /// Whether the load factor does not multiply the load.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub fixed: bool,
}

/// One frame: what is placed, what touches, and the proof.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrameForm {
    /// The number of the frame, from 1.
    pub frame: usize,
    /// The verdict: `stable`, `unstable` or `undecided`.
    pub verdict: String,
    /// The direction of gravity. Each body has the load weight · gravity.
    pub gravity: Pair,
    /// The factor by which the loads of all bodies, without their weights, are multiplied.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub load_factor: f64,
    /// The safety kernel: the forces of each contact with two points act at least this share of half its length away from
    /// its points.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub kernel: f64,
    /// A further load on a body, which no load factor multiplies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<(usize, LoadForm)>,
    /// The errors of a changed frame.
    #[serde(skip)]
    pub errors: Option<ErrorsForm>,
    /// The indices of the blocks that are placed. The ground is always there.
    pub placed: Vec<usize>,
    /// The contacts.
    pub contacts: Vec<ContactForm>,
    /// The grips of robots.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grips: Vec<GripForm>,
    /// Forces that balance the frame, if it stands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forces: Option<ForcesForm>,
    /// The motion, if the frame falls. A body without an entry is at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Vec<MotionForm>>,
    /// In each step, the motion of the bodies is changed so that the components have no power at all: their contacts
    /// neither open nor close.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub still: Vec<Step>,
}

/// A contact. Its normal n points into the first body. At each point, or as far inward of it as the kernel says, a normal
/// force presses along n; one friction force acts on the first body along t = (−n_y, n_x), with the first normal force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactForm {
    /// The indices of the two bodies. The forces act on the first; the opposite forces act on the second.
    pub bodies: [usize; 2],
    /// The one point or the two ends of the contact, metres. With two, t is the vector from the first to the second, with
    /// its length, and n = (t_y, −t_x).
    pub points: Vec<Pair>,
    /// The normal n of a contact with one point; any length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<Pair>,
    /// The friction coefficient μ: |T| ≤ μ (N₁ + N₂).
    pub friction: f64,
    /// Whether a factor on the friction leaves this coefficient as it is.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub fixed: bool,
    /// The factor on the friction coefficient in a changed frame.
    #[serde(skip)]
    pub(crate) factor: Option<f64>,
}

/// The grip of a robot on a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GripForm {
    /// The name of the robot.
    pub robot: String,
    /// The index of the held body.
    pub body: usize,
    /// The grip point, metres; the point at which the weight acts, if it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Pair>,
    /// The largest |force x| and |force y| in newtons, and |torque| in N·m; `null` without a limit.
    pub limits: [Option<f64>; 3],
}

/// Forces, and the way in which the residual of each body reaches the ground.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ForcesForm {
    /// For each contact N₁, N₂ and T: multiples of the vectors n, n and t, so newtons divided by the length of n. N₂ is 0
    /// for a contact with one point.
    pub contacts: Vec<[f64; 3]>,
    /// For each grip the force x and y on the body, N, and the torque, N·m.
    pub grips: Vec<[f64; 3]>,
    /// In each step, the components are changed so that the bodies balance exactly. The other body of a component is
    /// ground, or is corrected in a later step.
    pub order: Vec<Step>,
    /// If the frame stands for all errors: for each body, the components of the forces that balance the largest additional
    /// moment of this body, for each metre of the size of the errors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reactions: Vec<(usize, Sparse)>,
}

/// Errors in the places of joints, centres of gravity and loads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrorsForm {
    /// The size of the errors, metres.
    pub size: f64,
    /// The factors on the errors of some bodies. That of the others is 1, and that of the ground 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scales: Sparse,
    /// If the frame falls: for each body the share, −1 to 1, of its largest additional moment, anticlockwise positive.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pattern: Sparse,
}

/// The motion of a rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionForm {
    /// The index of the body.
    pub body: usize,
    /// A point that moves with the body, metres; the point at which the weight acts, if it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Pair>,
    /// The velocity of this point.
    pub velocity: Pair,
    /// The angular velocity, anticlockwise positive.
    pub spin: f64,
}

/// One side of an end of a margin, or of a corner or an edge of a capacity: a frame with one change, and its proof.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitForm {
    /// The number of the frame that is changed, from 1.
    pub frame: usize,
    /// What is proved: `load_factor high 2.5`, `capacity corner 1`.
    pub of: String,
    /// The change.
    pub change: Change,
    /// The verdict of the changed frame.
    pub verdict: String,
    /// Forces that balance the changed frame, if it stands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forces: Option<ForcesForm>,
    /// The motion, if the changed frame falls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Vec<MotionForm>>,
    /// Steps as those of a frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub still: Vec<Step>,
}

impl LimitForm {
    fn new(of: &str, change: Change, proved: FrameForm) -> LimitForm {
        let FrameForm { frame, verdict, forces, motion, still, .. } = proved;
        LimitForm { frame, of: of.to_owned(), change, verdict, forces, motion, still }
    }
}

/// The keys of a frame that a changed frame has with other values.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Change {
    /// The factor on the listed loads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load_factor: Option<f64>,
    /// The direction of gravity: rotated for a tilt, and lengthened too for a horizontal load.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Pair>,
    /// The friction coefficient of every contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// The factor on the friction coefficient of every contact that is not `fixed`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_factor: Option<f64>,
    /// The safety kernel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kernel: Option<f64>,
    /// What cannot move.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub locked: Option<Locked>,
    /// A further load on a body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force: Option<(usize, LoadForm)>,
    /// The errors up to which the frame stands, or with which it falls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub errors: Option<ErrorsForm>,
    /// Bodies with another weight and other loads: those of a load case, or of a position of a vehicle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loads: Option<Vec<Loaded>>,
    /// The limits of each grip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grip_limits: Option<Vec<[Option<f64>; 3]>>,
}

/// What cannot move in a changed frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Locked {
    /// No body can turn. Each placed body has one more grip, which carries a torque of any size, but no force.
    Turning,
    /// No contact can slide. Its μ is 0. After all contacts follow two more for each of them, with one point at its middle, the
    /// normals t and −t, and μ = 0.
    Sliding,
}

impl ContactForm {
    /// Returns the two smooth contacts that lock this one against sliding.
    fn locks(&self) -> [ContactForm; 2] {
        let point = |at: usize| self.points[at.min(self.points.len() - 1)];
        let ([x, y], [far_x, far_y]) = (point(0), point(1));
        let [tx, ty] = match self.normal {
            Some([nx, ny]) => [-ny, nx],
            None => [far_x - x, far_y - y],
        };
        let lock = |normal: Pair| ContactForm {
            points: vec![[x + (far_x - x) / 2.0, y + (far_y - y) / 2.0]],
            normal: Some(normal),
            friction: 0.0,
            fixed: true,
            factor: None,
            ..self.clone()
        };
        [lock([tx, ty]), lock([-tx, -ty])]
    }

    /// Returns the friction coefficient times its factor.
    fn exact_mu<N: Number>(&self) -> N {
        let friction = N::exact(self.friction);
        self.factor.map_or_else(|| friction.clone(), |factor| friction.times(&N::exact(factor)))
    }
}

impl Change {
    /// Writes the change as in the file, such as `{"load_factor":2.5}`.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("a change has finite numbers")
    }

    /// Returns the changed frame, without proof.
    pub fn of(&self, frame: &FrameForm) -> FrameForm {
        let mut changed = FrameForm {
            load_factor: self.load_factor.unwrap_or(frame.load_factor),
            gravity: self.gravity.unwrap_or(frame.gravity),
            kernel: self.kernel.unwrap_or(frame.kernel),
            force: self.force.clone().or_else(|| frame.force.clone()),
            errors: self.errors.clone(),
            ..frame.without_proof()
        };
        for contact in &mut changed.contacts {
            contact.friction = self.friction.unwrap_or(contact.friction);
            contact.factor = self.friction_factor.filter(|_| !contact.fixed);
        }
        for (grip, limits) in changed.grips.iter_mut().zip(self.grip_limits.iter().flatten()) {
            grip.limits = *limits;
        }
        match self.locked {
            Some(Locked::Turning) => {
                let held =
                    |body| GripForm { robot: String::new(), body, at: None, limits: [Some(0.0), Some(0.0), None] };
                changed.grips.extend(frame.placed.iter().copied().map(held));
            }
            Some(Locked::Sliding) => {
                let locks = frame.contacts.iter().flat_map(ContactForm::locks);
                changed.contacts.iter_mut().for_each(|contact| contact.friction = 0.0);
                changed.contacts.extend(locks);
            }
            None => {}
        }
        changed
    }
}

impl FrameForm {
    fn without_proof(&self) -> FrameForm {
        FrameForm { forces: None, motion: None, still: Vec::new(), ..self.clone() }
    }
}

impl Checked {
    /// True if there are frames, and the verdicts of all of them and of all changed frames are exactly proved.
    pub fn is_exact(&self) -> bool {
        !self.frames.is_empty()
            && self.frames.iter().all(FrameCheck::is_exact)
            && self.limits.iter().all(|limit| limit.faults.is_empty())
    }
}

fn one() -> f64 {
    1.0
}

fn is_one(factor: &f64) -> bool {
    *factor == 1.0
}

fn is_zero(kernel: &f64) -> bool {
    *kernel == 0.0
}

impl Certificate {
    /// Reads a certificate from JSON. Returns the reason if the text is not one.
    pub fn from_json(text: &[u8]) -> Result<Certificate, String> {
        serde_json::from_slice(text).map_err(|error| error.to_string())
    }

    /// Writes the certificate as JSON, with a line for each frame. Every number reads back to the last bit.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string(self).expect("a certificate has finite numbers and text keys");
        let text = text.replace("\"frames\":[", "\"frames\":[\n").replace("\"limits\":[", "\"limits\":[\n");
        text.replace(",{\"frame\":", ",\n{\"frame\":") + "\n"
    }

    /// Returns the loads of each condition of a frame, with the number of the frame.
    fn conditions(&self) -> impl Iterator<Item = (usize, &Vec<Loaded>)> {
        self.limits.iter().filter_map(|limit| Some((limit.frame, limit.change.loads.as_ref()?)))
    }

    /// Returns a certificate without frames, in which bodies have other weights and loads.
    fn with_loads(&self, loads: &[Loaded]) -> Certificate {
        let mut bodies = self.bodies.clone();
        for (index, weight, loads) in loads {
            if let Some(body) = bodies.get_mut(*index) {
                (body.weight, body.loads) = (*weight, loads.clone());
            }
        }
        self.about(bodies)
    }

    /// Returns a certificate without frames, about other bodies.
    fn about(&self, bodies: Vec<BodyForm>) -> Certificate {
        let scene_sha256 = self.scene_sha256.clone();
        Certificate { bodies, scene_sha256, frames: Vec::new(), limits: Vec::new(), ..*self }
    }

    /// Returns in which part this certificate is about another structure than `other`; `None` if the structures are
    /// equal. The proofs may differ.
    pub fn differs_from(&self, other: &Certificate) -> Option<&'static str> {
        if self.bodies != other.bodies {
            Some("the bodies differ")
        } else if [self.distance, self.shortest] != [other.distance, other.shortest]
            || (self.corners_carry, self.listed) != (other.corners_carry, other.listed)
        {
            Some("the tolerances or the rules of contact differ")
        } else if !self
            .frames
            .iter()
            .map(FrameForm::without_proof)
            .eq(other.frames.iter().map(FrameForm::without_proof))
        {
            Some("the frames differ: verdicts, placed blocks, contacts or robots")
        } else if self.conditions().ne(other.conditions()) {
            Some("the load cases or the positions of the vehicle differ")
        } else if self.scene_sha256 != other.scene_sha256 {
            Some("the file has another hash")
        } else {
            None
        }
    }
}
