//! [`Layer`]: the three layers in which a snapshot is compared with its references. [`UnreadableReference`]: why a
//! reference of a layer cannot be compared.

use crate::text::is_conflict_mark;

/// A form in which a result is stored and compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Layer {
    /// Verdict, interfaces and forces, as JSON.
    Facts,
    /// The text of the drawing.
    Svg,
    /// The pixels of the picture.
    Pixels,
}

impl Layer {
    /// All layers, from the results to the picture. A difference in one layer usually explains those in later
    /// layers.
    pub const ALL: [Layer; 3] = [Layer::Facts, Layer::Svg, Layer::Pixels];

    /// Returns the name of the layer in settings and reports.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Facts => "facts",
            Layer::Svg => "svg",
            Layer::Pixels => "pixels",
        }
    }

    /// Returns the layer with this name; `None` if there is no such layer.
    pub fn named(name: &str) -> Option<Layer> {
        Layer::ALL.into_iter().find(|layer| layer.name() == name)
    }
}

/// The reason why a reference cannot be compared, such as `it is empty (0 bytes)`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct UnreadableReference(pub String);

impl UnreadableReference {
    /// Checks that a file is not empty, no Git LFS pointer and without merge conflicts. `what` is the content that is
    /// expected: `facts`, `drawing` or `picture`.
    pub(super) fn check(bytes: &[u8], what: &str) -> Result<(), UnreadableReference> {
        let refuse = |words: String| Err(UnreadableReference(words));
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return refuse("it is empty (0 bytes)".into());
        }
        if bytes.starts_with(b"version https://git-lfs") {
            return refuse(format!("it is a Git LFS pointer and not the {what}; fetch it with `git lfs pull`"));
        }
        let text = std::str::from_utf8(bytes).unwrap_or_default();
        match text.lines().position(is_conflict_mark) {
            Some(line) => refuse(format!(
                "line {} is a mark of a merge conflict; resolve it, or accept the {what} again",
                line + 1
            )),
            None => Ok(()),
        }
    }
}
