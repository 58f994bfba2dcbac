//! [`Change`]: a difference between two lists of facts.

use std::collections::BTreeMap;

/// A difference between two lists of facts.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// A description on one line.
    pub words: String,
    /// The weight for sorting; the change with the largest weight comes first. Changes of the scene itself have the
    /// largest weights, because they cause the other changes. Then come verdicts, falling blocks, objects that appear
    /// or vanish, failures, and numbers. The weight of a number is its change in units of its last digit.
    pub(super) weight: f64,
}

/// If more than this number of blocks or interfaces changed in the same way, one line reports all of them.
pub(super) const MAX_SINGLE_CHANGES: usize = 4;

/// If more than [`MAX_SINGLE_CHANGES`] facts of a kind changed in the same way, reports them in one line, such as
/// `20 blocks: μ 0.7 → 0.5` for the kind `block`. Considers the changes from index `from` on. Their words begin with
/// `place`, which names the frame or is empty.
pub(super) fn group_equal(from: usize, place: &str, kind: &str, changes: &mut Vec<Change>) {
    let how = |words: &str| -> Option<String> {
        let words = words.strip_prefix(place)?.strip_prefix(kind)?;
        let (_, how) = words.strip_prefix(' ')?.rsplit_once(": ")?;
        how.contains(" → ").then(|| how.to_owned())
    };
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for words in changes[from..].iter().filter_map(|c| how(&c.words)) {
        *counts.entry(words).or_default() += 1;
    }
    counts.retain(|_, count| *count > MAX_SINGLE_CHANGES);
    let mut is_first = counts.clone();
    let mut index = 0;
    changes.retain_mut(|change| {
        index += 1;
        let same = how(&change.words).filter(|how| index > from && counts.contains_key(how));
        let Some(how) = same else {
            return true;
        };
        change.words = format!("{place}{} {kind}s: {how}", counts[&how]);
        is_first.remove(&how).is_some()
    });
}
