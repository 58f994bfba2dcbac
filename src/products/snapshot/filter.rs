//! [`Filter`]: decides which scenes `--only` selects.

use super::setting::matches_pattern;

/// The filter of `--only`. It selects scenes and references by their names.
pub(super) enum Filter<'f> {
    /// Selects all names.
    All,
    /// Selects the scene with this name, and its references.
    Exactly(&'f str),
    /// Selects names that match this pattern, in which `*` stands for any text.
    Pattern(&'f str),
    /// Selects names that contain this text.
    Containing(&'f str),
}

impl<'f> Filter<'f> {
    /// Makes the filter for the text `only`; `None` selects all scenes. If the text equals one of the scene `names`,
    /// the filter selects only this scene. Otherwise a text with `*` is a pattern for names, and any other text must
    /// occur in a name.
    pub(super) fn new(only: Option<&'f str>, mut names: impl Iterator<Item = String>) -> Filter<'f> {
        match only {
            None => Filter::All,
            Some(filter) if names.any(|name| name == filter) => Filter::Exactly(filter),
            Some(filter) if filter.contains('*') => Filter::Pattern(filter),
            Some(filter) => Filter::Containing(filter),
        }
    }

    /// True if the filter selects this name.
    pub(super) fn selects(&self, name: &str) -> bool {
        match self {
            Filter::All => true,
            // The name may also be the name of a reference, which is the name of its scene, a dot and more.
            Filter::Exactly(scene) => {
                name.strip_prefix(scene).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            }
            Filter::Pattern(pattern) => matches_pattern(pattern, name),
            Filter::Containing(part) => name.contains(part),
        }
    }
}
