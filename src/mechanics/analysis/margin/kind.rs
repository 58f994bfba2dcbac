//! [`MarginKind`]: a kind of margin, such as friction or tilt. [`MarginKinds`]: a set of kinds, such as the requested
//! margins.
//!
//! [`About`] declares all that distinguishes a kind: its words, its unit, and how it changes a component. A further kind
//! needs a name in [`MarginKind`] and its declaration in [`ABOUT`].

use super::path::{Path, Predictor};
use super::trial::{Setting, Trial, has_factored_loads, largest_factored_friction};
use crate::mechanics::statics::assembly::Assembly;
use crate::text::Word;

/// A kind of margin: the parameter that is varied, alone, until the frame falls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum MarginKind {
    /// The friction coefficient, the same at every interface, from 0 to [`MarginKind::MAX_FRICTION`]. Its interval has no
    /// upper end. The margin is the lower end, 0 if the frame needs no friction.
    Friction,
    /// The rotation of gravity in degrees. It is positive if the tip of the gravity vector moves to the right. Listed
    /// loads do not rotate. Both ends are margins.
    #[default]
    Tilt,
    /// The fraction of each weight that acts at right angles to gravity, in addition to the weight; negative to the
    /// left. Both ends are margins.
    HorizontalLoad,
    /// The safety kernel, from 0 upwards. The upper end is the margin; it is unbounded if the frame stands with a kernel
    /// of 1.
    Kernel,
    /// The factor on the listed loads, at least 0; 1 means the loads as listed. The upper end is the margin. A frame
    /// without listed loads has no such interval.
    LoadFactor,
    /// The factor on all friction coefficients, at least 0; 1 means the coefficients as given, and smooth interfaces stay
    /// smooth. Its interval has no upper end. The margin is the lower end. One divided by it is the factor of safety of
    /// geotechnics. A frame without friction has no such interval.
    FrictionFactor,
    /// The factor on the listed loads, at least 0, for the same structure in which no block can turn: a torque of any size
    /// holds each block, but no force does. The upper end is the margin. It is the factor of safety against sliding.
    Sliding,
    /// The factor on the listed loads, at least 0, for the same structure in which no joint can slide, not even a smooth one.
    /// The upper end is the margin. It is the factor of safety against overturning.
    Overturning,
    /// The factor on the listed loads, at least 0, if the force at every joint must lie in its middle third. The upper end is
    /// the margin. It gives the loads of the permissible state.
    MiddleThird,
    /// The limits of every robot that holds a block, each varied alone. The lower ends are the margins.
    Robots,
}

/// Returns how a component changes with a parameter, from its change for a value of the parameter.
type PathOf = fn(&Trial, fn(f64) -> Setting) -> Path<'static>;

/// The names, units and texts of a kind of margin. Where there are two texts, the first is for the lower end of the
/// interval, and the second for the upper end.
pub(crate) struct About {
    /// The name in results, and with hyphens.
    pub words: [&'static str; 2],
    /// The parameter in a sentence.
    pub name: &'static str,
    /// The unit that is written after a value.
    pub unit: &'static str,
    /// The ends as a notice names them.
    pub notice: [&'static str; 2],
    /// The quantities that the ends limit, for sensitivities.
    pub limited: [&'static str; 2],
    /// The meaning of its keys in results: the margin, the interval, the exclusions, and the motions beyond the margin.
    pub keys: [&'static str; 4],
    /// The condition for its interval in results.
    pub condition: &'static str,
    /// A value of the parameter: what the collapse at the margin happens at.
    pub at: &'static str,
    /// Whether the lower and the upper end are margins. Both are if values may be negative: then the margins lie to the
    /// left and to the right of 0.
    pub ends: [bool; 2],
    /// The present value; `None` if it depends on the scene.
    pub present: Option<f64>,
    /// Whether the parameter has a meaning for a component; `None` if it has one for every component.
    pub(super) applies: Option<fn(&Assembly) -> bool>,
    /// Changes the structure, if the margin belongs to a structure with the same bodies and loads but other conditions.
    pub(crate) structure: Option<fn(Assembly) -> Assembly>,
    /// The change of a component for a value of the parameter.
    pub(in crate::mechanics::analysis) setting: fn(f64) -> Setting,
    /// The loads that the parameter adds per unit, at a value; `None` if the loads do not depend on it.
    pub(in crate::mechanics::analysis) growth: Option<fn(f64) -> Setting>,
    /// How a component changes with the parameter.
    path: PathOf,
}

impl About {
    const PLAIN: About = About {
        words: [""; 2],
        name: "",
        unit: "",
        notice: [""; 2],
        limited: [""; 2],
        keys: [""; 4],
        condition: "if requested",
        at: "",
        ends: [true; 2],
        present: None,
        applies: None,
        structure: None,
        setting: |_| Setting::default(),
        growth: None,
        path: |_, setting| Path::new(Predictor::Plane, setting),
    };
}

/// A factor on the loads.
const LOADED: About = About {
    limited: ["least load factor", "load factor"],
    condition: "if requested, with loads",
    ends: [false, true],
    present: Some(1.0),
    applies: Some(has_factored_loads),
    setting: |loads| Setting { loads, ..Setting::default() },
    growth: Some(|_| Setting { loads: 1.0, ..Setting::UNLOADED }),
    path: |trial, setting| {
        let load_ratio = trial.weights_to_loads();
        let (typical_small, typical_large) = (load_ratio.min(1.0), load_ratio.max(1.0));
        Path { typical_small, typical_large, load_ratio, ..Path::new(Predictor::Plane, setting) }
    },
    ..About::PLAIN
};

/// The declarations of all kinds, in the order of [`MarginKind::ALL`].
static ABOUT: [About; MarginKind::ALL.len()] = [
    About {
        words: ["friction", "friction"],
        name: "friction coefficient",
        notice: ["the least friction", "the largest friction"],
        limited: ["least friction"; 2],
        keys: [
            "least friction coefficient, the same at all interfaces",
            "friction coefficient, the same at all interfaces, from 0 to 1000",
            "they exclude all coefficients up to 1000, the largest that is tried",
            "just below the least friction coefficient",
        ],
        at: "this friction",
        ends: [true, false],
        setting: |mu| Setting { friction: Some(mu), ..Setting::default() },
        path: |_, setting| Path::threshold(MarginKind::MAX_FRICTION, setting),
        ..About::PLAIN
    },
    About {
        words: ["tilt", "tilt"],
        name: "tilt of gravity",
        unit: "°",
        notice: ["the largest tilt in degrees to the left", "the largest tilt in degrees to the right"],
        limited: ["tilt"; 2],
        keys: [
            "largest turns of gravity at which the frame stands; each is null if it falls without a turn",
            "tilt of gravity, negative to the left; loads do not tilt",
            "they exclude all turns of gravity; the ranges cover a full turn",
            "just beyond the largest tilts",
        ],
        at: "this tilt",
        present: Some(0.0),
        setting: |degrees| Setting::tilted(degrees, 1.0),
        // Gravity grows across its direction.
        growth: Some(|degrees| {
            let Setting { along, across, .. } = Setting::tilted(degrees + 90.0, 1_f64.to_radians());
            Setting { along, across, ..Setting::UNLOADED }
        }),
        path: |_, setting| Path { min_value: f64::NEG_INFINITY, ..Path::new(Predictor::Arc, setting) },
        ..About::PLAIN
    },
    About {
        words: ["horizontal_load", "horizontal-load"],
        name: "horizontal load, as a share of the weights",
        notice: ["the largest horizontal share to the left", "the largest horizontal share to the right"],
        limited: ["horizontal share"; 2],
        keys: [
            "largest horizontal force on every block, as a share of its weight",
            "horizontal force on every block as a share of its weight, negative to the left",
            "they exclude all values",
            "just beyond the largest horizontal loads",
        ],
        at: "this push",
        present: Some(0.0),
        setting: |across| Setting { across, ..Setting::default() },
        growth: Some(|_| Setting { across: 1.0, ..Setting::UNLOADED }),
        path: |trial, setting| {
            let load_ratio = 1.0 / trial.weights_to_loads();
            let typical_large = load_ratio.max(1.0);
            Path { min_value: f64::NEG_INFINITY, typical_large, load_ratio, ..Path::new(Predictor::Plane, setting) }
        },
        ..About::PLAIN
    },
    About {
        words: ["kernel", "kernel"],
        name: "safety kernel",
        notice: ["the least kernel", "the largest kernel"],
        limited: ["largest kernel"; 2],
        keys: [
            "largest kernel",
            "kernel, from 0 to 1; without an upper end if the frame stands at 1",
            "they exclude all values",
            "just beyond the largest kernel",
        ],
        at: "this kernel",
        ends: [false, true],
        setting: |kernel| Setting { kernel: Some(kernel), ..Setting::default() },
        path: |_, setting| Path::threshold(1.0, setting),
        ..About::PLAIN
    },
    About {
        words: ["load_factor", "load-factor"],
        name: "factor on the loads",
        notice: ["the least factor on the loads", "the largest factor on the loads"],
        keys: [
            "largest factor on the loads; null also without loads",
            "factor on the loads, at least 0; 1 stands for the loads of the scene",
            "they exclude all values",
            "just beyond the largest factor on the loads",
        ],
        at: "this load",
        ..LOADED
    },
    About {
        words: ["friction_factor", "friction-factor"],
        name: "factor on the friction",
        notice: ["the least factor on the friction", "the largest factor on the friction"],
        limited: ["least friction factor"; 2],
        keys: [
            "least factor on all friction coefficients; null also without friction",
            "factor on all friction coefficients; 1 stands for those of the scene, and smooth interfaces stay smooth",
            "they exclude all factors up to that which makes the largest coefficient 1000",
            "just below the least factor on the friction",
        ],
        condition: "if requested, with friction",
        at: "this friction",
        ends: [true, false],
        present: Some(1.0),
        applies: Some(|component| largest_factored_friction(component) > 0.0),
        setting: |friction_factor| Setting { friction_factor, ..Setting::default() },
        path: |trial, setting| Path::threshold(MarginKind::MAX_FRICTION / trial.largest_factored_friction(), setting),
        ..About::PLAIN
    },
    About {
        words: ["sliding", "sliding"],
        name: "factor on the loads if nothing can turn (sliding)",
        notice: [
            "the least factor on the loads if nothing can turn",
            "the largest factor on the loads if nothing can turn",
        ],
        keys: [
            "largest factor on the loads if no block can turn: the factor of safety against sliding; null also without loads",
            "factor on the loads if no block can turn, at least 0",
            "they exclude all values",
            "just beyond the largest factor if no block can turn",
        ],
        at: "this load, if nothing can turn",
        structure: Some(Assembly::without_turning),
        ..LOADED
    },
    About {
        words: ["overturning", "overturning"],
        name: "factor on the loads if nothing can slide (overturning)",
        notice: [
            "the least factor on the loads if nothing can slide",
            "the largest factor on the loads if nothing can slide",
        ],
        keys: [
            "largest factor on the loads if no joint can slide, smooth ones neither: the factor of safety against overturning; null also without loads",
            "factor on the loads if no joint can slide, at least 0",
            "they exclude all values",
            "just beyond the largest factor if no joint can slide",
        ],
        at: "this load, if nothing can slide",
        structure: Some(Assembly::without_sliding),
        ..LOADED
    },
    About {
        words: ["middle_third", "middle-third"],
        name: "factor on the loads within the middle third of all joints",
        notice: [
            "the least factor on the loads within the middle third",
            "the largest factor on the loads within the middle third",
        ],
        keys: [
            "largest factor on the loads with which forces in the middle third of every joint balance the frame; null also without loads",
            "factor on the loads within the middle third of every joint, at least 0",
            "they exclude all values",
            "just beyond the largest factor, if forces keep to the middle third",
        ],
        at: "this load, within the middle third",
        structure: Some(Assembly::with_middle_third),
        ..LOADED
    },
    About { words: ["robots", "robots"], at: "this limit", ends: [true, false], ..About::PLAIN },
];

impl MarginKind {
    /// All margins.
    pub const ALL: [MarginKind; 10] = [
        MarginKind::Friction,
        MarginKind::Tilt,
        MarginKind::HorizontalLoad,
        MarginKind::Kernel,
        MarginKind::LoadFactor,
        MarginKind::FrictionFactor,
        MarginKind::Sliding,
        MarginKind::Overturning,
        MarginKind::MiddleThird,
        MarginKind::Robots,
    ];

    /// The largest friction coefficient that is tried.
    pub const MAX_FRICTION: f64 = 1e3;

    /// Returns the margins with a sign ([`SolvedFrame::signed_margin`](super::super::SolvedFrame::signed_margin)): all but
    /// [`MarginKind::Friction`] and [`MarginKind::Robots`].
    pub(crate) fn with_sign() -> impl Iterator<Item = MarginKind> {
        MarginKind::of_frame().filter(|kind| *kind != MarginKind::Friction)
    }

    /// Returns the distance of the present value of the parameter from one end of its interval, as a share: 0 at this end,
    /// positive inside, and negative outside.
    pub(in crate::mechanics::analysis) fn share(self, kernel: f64, end: f64, is_upper: bool) -> f64 {
        let outward = if is_upper { end } else { -end };
        match self {
            MarginKind::Tilt => outward / 90.0,
            MarginKind::HorizontalLoad => outward,
            MarginKind::Kernel if !is_upper => 1.0,
            MarginKind::Kernel if end < kernel => end / kernel - 1.0,
            MarginKind::Kernel => (end - kernel) / (1.0 - kernel).max(f64::MIN_POSITIVE),
            _ => {
                let ratio = if is_upper { end } else { 1.0 / end };
                if ratio < 1.0 { ratio - 1.0 } else { 1.0 - 1.0 / ratio }
            }
        }
    }

    /// Returns the margins of the whole frame: all but the limits of robots.
    pub(crate) fn of_frame() -> impl Iterator<Item = MarginKind> {
        MarginKind::ALL.into_iter().filter(|kind| *kind != MarginKind::Robots)
    }

    /// Returns the declaration of this kind.
    pub(crate) const fn about(self) -> &'static About {
        &ABOUT[self as usize]
    }

    /// True if a value can be negative. A negative value points to the left.
    pub(crate) const fn is_signed(self) -> bool {
        let [low, high] = self.about().ends;
        low && high
    }

    /// True if the loads change with the parameter, so that one value after another is a state of the same structure.
    pub(crate) fn changes_loads(self) -> bool {
        self.about().growth.is_some()
    }

    /// Returns how a component changes with the parameter.
    pub(super) fn path(self, trial: &Trial) -> Path<'static> {
        let about = self.about();
        (about.path)(trial, about.setting)
    }

    /// Returns the margin with this name in results; `None` if no margin has this name. A hyphen counts as an
    /// underscore, and capital letters count as small letters.
    pub fn from_word(word: &str) -> Option<MarginKind> {
        Word::from_word(word)
    }

    /// True if a sensitivity can be computed for this margin: for every margin of the structure as it is, except the limits
    /// of robots.
    pub fn has_sensitivity(self) -> bool {
        self != MarginKind::Robots && self.about().structure.is_none()
    }

    /// True if the parameter is a factor on the listed loads.
    pub(crate) fn multiplies_loads(self) -> bool {
        self == MarginKind::LoadFactor || self.about().structure.is_some()
    }

    /// Returns the name of this margin in results, such as `load_factor`.
    pub fn word(self) -> &'static str {
        self.about().words[0]
    }
}

/// Names a margin for users: with hyphens, or with underscores as in results.
impl Word for MarginKind {
    fn all() -> Vec<MarginKind> {
        MarginKind::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        self.about().words[1]
    }

    fn alias(self) -> Option<&'static str> {
        let [name, typed] = self.about().words;
        (name != typed).then_some(name)
    }
}

/// A set of margins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MarginKinds {
    bits: u16,
}

impl MarginKinds {
    /// The empty set.
    pub const NONE: MarginKinds = MarginKinds { bits: 0 };

    /// The set of all margins.
    pub const ALL: MarginKinds = MarginKinds { bits: (1 << MarginKind::ALL.len()) - 1 };

    /// The margins of the structure as it is: all but [`MarginKind::Sliding`], [`MarginKind::Overturning`] and
    /// [`MarginKind::MiddleThird`].
    #[cfg(any(feature = "cli", feature = "wasm"))]
    pub(crate) const AS_IT_IS: MarginKinds = {
        let others = [MarginKind::Sliding, MarginKind::Overturning, MarginKind::MiddleThird];
        MarginKinds {
            bits: MarginKinds::ALL.bits & !(1 << others[0] as u16 | 1 << others[1] as u16 | 1 << others[2] as u16),
        }
    };

    /// Creates a set of margins from a list.
    pub fn new(list: &[MarginKind]) -> MarginKinds {
        list.iter().fold(MarginKinds::NONE, |set, kind| set.with(*kind))
    }

    /// Returns this set with one margin added.
    #[must_use]
    pub fn with(self, kind: MarginKind) -> MarginKinds {
        MarginKinds { bits: self.bits | 1 << kind as u16 }
    }

    /// Returns the margins of this set and of another one.
    #[must_use]
    pub fn and(self, other: MarginKinds) -> MarginKinds {
        MarginKinds { bits: self.bits | other.bits }
    }

    /// True if the set contains no margin.
    pub fn is_empty(self) -> bool {
        self.bits == 0
    }

    /// True if the set contains this margin.
    pub fn has(self, kind: MarginKind) -> bool {
        self.bits & 1 << kind as u16 != 0
    }
}
