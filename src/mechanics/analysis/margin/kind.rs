//! [`MarginKind`]: a kind of margin, such as friction or tilt. [`MarginKinds`]: a set of kinds, such as the requested
//! margins.

use crate::text::Word;

/// A kind of margin. Tilt and horizontal load have one margin to each side, and robots have one margin for each limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MarginKind {
    /// [`Margins::friction`](super::Margins::friction).
    Friction,
    /// [`Margins::tilt`](super::Margins::tilt), to both sides.
    Tilt,
    /// [`Margins::horizontal_load`](super::Margins::horizontal_load), to both sides.
    HorizontalLoad,
    /// [`Margins::kernel`](super::Margins::kernel).
    Kernel,
    /// [`Margins::load_factor`](super::Margins::load_factor).
    LoadFactor,
    /// [`Margins::robots`](super::Margins::robots), every limit of every robot.
    Robots,
}

impl MarginKind {
    /// All margins.
    pub const ALL: [MarginKind; 6] = [
        MarginKind::Friction,
        MarginKind::Tilt,
        MarginKind::HorizontalLoad,
        MarginKind::Kernel,
        MarginKind::LoadFactor,
        MarginKind::Robots,
    ];

    /// Returns the margin with this name in results; `None` if no margin has this name. A hyphen counts as an
    /// underscore, and capital letters count as small letters.
    pub fn from_word(word: &str) -> Option<MarginKind> {
        let word = word.replace('-', "_").to_ascii_lowercase();
        MarginKind::ALL.into_iter().find(|kind| kind.word() == word)
    }

    /// True if a sensitivity can be computed for this margin: for every margin except the limits of robots.
    pub fn has_sensitivity(self) -> bool {
        self != MarginKind::Robots
    }

    /// Returns the name of this margin in results, such as `load_factor`.
    pub fn word(self) -> &'static str {
        match self {
            MarginKind::Friction => "friction",
            MarginKind::Tilt => "tilt",
            MarginKind::HorizontalLoad => "horizontal_load",
            MarginKind::Kernel => "kernel",
            MarginKind::LoadFactor => "load_factor",
            MarginKind::Robots => "robots",
        }
    }
}

/// Names a margin for users: with hyphens, or with underscores as in results.
impl Word for MarginKind {
    fn all() -> Vec<MarginKind> {
        MarginKind::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        match self {
            MarginKind::HorizontalLoad => "horizontal-load",
            MarginKind::LoadFactor => "load-factor",
            kind => MarginKind::word(kind),
        }
    }

    fn alias(self) -> Option<&'static str> {
        let name = MarginKind::word(self);
        (name != Word::word(self)).then_some(name)
    }
}

/// A set of margins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MarginKinds {
    bits: u8,
}

impl MarginKinds {
    /// The set of all margins.
    pub const ALL: MarginKinds = MarginKinds { bits: 0b11_1111 };

    /// Creates a set of margins from a list.
    pub fn new(list: &[MarginKind]) -> MarginKinds {
        let bits = list.iter().fold(0, |bits, kind| bits | bit(*kind));
        MarginKinds { bits }
    }

    /// Returns this set with one margin added.
    #[must_use]
    pub fn with(self, kind: MarginKind) -> MarginKinds {
        MarginKinds { bits: self.bits | bit(kind) }
    }

    /// True if the set contains this margin.
    pub fn has(self, kind: MarginKind) -> bool {
        self.bits & bit(kind) != 0
    }
}

impl Default for MarginKinds {
    fn default() -> MarginKinds {
        MarginKinds::ALL
    }
}

fn bit(kind: MarginKind) -> u8 {
    1 << kind as u8
}
