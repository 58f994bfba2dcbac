//! [`Change`]: a difference between two lists of facts.

use std::collections::BTreeMap;

/// A difference.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// A description on one line.
    pub words: String,
    /// The weight for sorting. Changes of the scene itself have the largest weight, because they cause the other
    /// changes. Then come verdicts, falling blocks, objects that appear or vanish, failures, and numbers. The weight
    /// of a number is its change in units of its last digit.
    pub(super) weight: f64,
}

/// If more than this number of blocks changed in the same way, one line reports all of them.
pub(super) const MAX_SINGLE_BLOCKS: usize = 4;

/// If more than [`MAX_SINGLE_BLOCKS`] blocks changed in the same way, reports them in one line: `20 blocks: μ 0.7 → 0.5`.
/// Considers the changes from index `from` on.
pub(super) fn group_equal(from: usize, changes: &mut Vec<Change>) {
    let how = |words: &str| -> Option<String> {
        let (_, how) = words.strip_prefix("block ")?.rsplit_once(": ")?;
        how.contains(" → ").then(|| how.to_owned())
    };
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for words in changes[from..].iter().filter_map(|c| how(&c.words)) {
        *counts.entry(words).or_default() += 1;
    }
    counts.retain(|_, count| *count > MAX_SINGLE_BLOCKS);
    let mut is_first = counts.clone();
    let mut index = 0;
    changes.retain_mut(|change| {
        index += 1;
        let same = how(&change.words).filter(|how| index > from && counts.contains_key(how));
        let Some(how) = same else {
            return true;
        };
        change.words = format!("{} blocks: {how}", counts[&how]);
        is_first.remove(&how).is_some()
    });
}
