//! [`Facts`]: what was found out about a scene, as text that a person reads, keeps beside the scene and compares.
//!
//! One line per fact, under a heading per frame: what is known by its names stands before the colon, what was found about it
//! behind.
//!
//! ```text
//! drystone facts 1
//! scene "Two bricks": gravity 0.0000 -9.8100 m/s²
//! block "a": weight 6.00000 N, centroid 1.00000 0.50000 m
//!
//! frame 1 "All of it": stable
//!   sums: blocks 1, weight 6.00000 N, total force 6.00000 N, total sticking 0.00000 N
//!   interface "a" "ground": N 6.00000 N, T 0.00000 N, N at its ends 3.00000 3.00000 N, μ 0.7
//! ```
//!
//! Numbers are rounded to so many digits of the largest load of a block, and compared within one and a half of the last digit:
//! noise of a solution is below that, a change by a hundredth far above it. Where nothing is proved, in frames that are
//! undecided, no forces are reported.

mod compare;
mod read;
mod round;
mod write;

pub use compare::Change;
pub use read::FactsError;
pub use write::DIGITS;

use crate::analysis::Analysis;

/// What was found out about a scene, as lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Facts {
    /// Those of the scene as a whole, and then those of each frame.
    sections: Vec<Section>,
}

/// The facts of the scene, or of one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Section {
    /// The line it begins with.
    head: Fact,
    facts: Vec<Fact>,
}

/// A line: what it is about, and what was found.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Fact {
    /// What sort of thing: `block`, `interface`, `failure tension`.
    kind: String,
    /// Its names.
    names: Vec<String>,
    values: Vec<Value>,
}

/// One thing found: a word, or a quantity with its numbers and unit.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Value {
    /// What it is; empty for a word alone.
    name: String,
    /// The numbers as they are written; none for a word.
    numbers: Vec<String>,
    /// The unit, or the word.
    unit: String,
}

impl Facts {
    /// The facts of an analysis, its numbers rounded to so many digits: [`DIGITS`] unless there is a reason.
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
        write::of(analysis, digits)
    }

    /// The text to keep.
    pub fn text(&self) -> String {
        write::text(self)
    }

    /// Facts from a text that was kept.
    ///
    /// # Errors
    /// [`FactsError`] with the line that is none.
    pub fn read(text: &str) -> Result<Facts, FactsError> {
        read::facts(text)
    }

    /// What became of these facts in others, in words, what matters most first; nothing where they agree.
    pub fn changes(&self, found: &Facts) -> Vec<Change> {
        compare::changes(self, found)
    }
}
