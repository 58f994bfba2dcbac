//! [`Facts`]: the main inputs and the results of a scene, as text that people can read, store and compare.
//!
//! Each fact is one line, under the heading of the scene or of its frame. The object and its names are before the
//! colon, its values are after the colon.
//!
//! ```text
//! drystone facts 2
//! scene "Two bricks": gravity 0.0000 -9.8100 m/s²
//! block "a": weight 6.00000 N, centroid 1.00000 0.50000 m, μ 0.7
//! load "a": force 0.00000 -2.00000 N, at 1.00000 1.00000 m
//!
//! frame 1 "All of it": stable
//!   sums: blocks 1, weight 6.00000 N, total force 8.00000 N, total sticking 0.00000 N
//!   interface "a" "ground": N 8.00000 N, T 0.00000 N, N at its ends 4.00000 4.00000 N, μ 0.7
//! ```
//!
//! Forces are rounded so that the largest weight or load has [`DIGITS`] significant digits. Lengths and torques are
//! rounded in the same way. Two numbers with a unit count as equal if they differ by at most 1.5 units of the last
//! digit: rounding errors of the solver are smaller, and a change by one percent is far larger. Frames that are
//! undecided have no proof, so their forces are not reported.

mod change;
mod compare;
mod read;
mod round;
mod write;

pub use change::Change;
pub use read::FactsError;
pub use write::DIGITS;

use crate::mechanics::analysis::Analysis;

/// The version of the format. The first line of a facts file states it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    /// Without the friction coefficients of blocks, pairs of materials and listed contacts, without the limits of
    /// robots, and without loads.
    One,
    /// With all of these.
    Two,
}

impl Version {
    const ALL: [Version; 2] = [Version::One, Version::Two];

    fn number(self) -> u8 {
        match self {
            Version::One => 1,
            Version::Two => 2,
        }
    }
}

/// The main inputs and the results of a scene, as lines of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Facts {
    version: Version,
    /// The facts of the scene, then those of each frame.
    sections: Vec<Section>,
}

/// The facts of the scene, or of one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Section {
    /// The heading.
    head: Fact,
    facts: Vec<Fact>,
}

/// One line: an object and its values.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Fact {
    /// The kind of object: `block`, `interface`, `failure tension`.
    kind: String,
    /// The names of the object.
    names: Vec<String>,
    values: Vec<Value>,
}

/// One value of an object: a word, or a quantity with its numbers and perhaps a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Value {
    /// The name of the quantity; empty for a word.
    name: String,
    /// The numbers as text; empty for a word.
    numbers: Vec<String>,
    /// The unit, or the word. Empty for a quantity without a unit.
    unit: String,
}

impl Facts {
    /// Collects the facts of an analysis. Forces are rounded so that the largest weight or load has `digits`
    /// significant digits, usually [`DIGITS`]. All other forces have the same number of decimals.
    ///
    /// ```
    /// use drystone::{Analysis, Scene, snapshot::fact::{DIGITS, Facts}};
    /// let described = |load: f64| {
    ///     let scene = Scene::from_json(&format!(r#"{{ "drystone": 1, "friction": 0.5,
    ///         "ground": [{{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }}],
    ///         "blocks": [{{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 3 }}],
    ///         "loads": [{{ "block": "a", "force": [0, {}], "at": [2.5, 2] }}] }}"#, -load)).expect("sound");
    ///     Facts::new(&Analysis::new(&scene), DIGITS)
    /// };
    /// let changes = described(0.0).changes(&described(1.2));
    /// let words: Vec<&str> = changes.iter().map(|change| change.words.as_str()).collect();
    /// assert!(words.contains(&"interface a–ground: N 3 → 4.2 N, N at its ends 1.5, 1.5 → 2.1, 2.1 N"), "{words:?}");
    /// assert!(described(1.2).changes(&described(1.2 + 1e-9)).is_empty());
    /// ```
    pub fn new(analysis: &Analysis, digits: usize) -> Facts {
        write::from_analysis(analysis, digits)
    }

    /// Returns the facts as text, in the format of reference files.
    pub fn text(&self) -> String {
        write::text(self)
    }

    /// Reads facts from the text of a reference file.
    ///
    /// # Errors
    /// [`FactsError`] if the text is not a list of facts. If lines cannot be read, the error names the first of them.
    pub fn read(text: &str) -> Result<Facts, FactsError> {
        read::facts(text)
    }

    /// Describes how the facts `found` differ from these facts. Changes of the scene come first. Then come changes of
    /// the results, the most important first. The list is empty if there is no difference.
    ///
    /// If these facts were read from a file of version 1, facts that version 1 does not contain are not compared.
    pub fn changes(&self, found: &Facts) -> Vec<Change> {
        compare::changes(self, found)
    }

    /// Returns these facts without those that the given version of the format does not contain.
    fn in_version(&self, version: Version) -> Facts {
        let mut facts = self.clone();
        if version == Version::One {
            facts.version = Version::One;
            let scenes = facts.sections.iter_mut().filter(|s| s.head.kind == "scene");
            for scene in scenes {
                scene.facts.retain(|fact| fact.kind == "block");
                for block in &mut scene.facts {
                    block.values.retain(|value| value.name != "μ");
                }
            }
        }
        facts
    }
}
