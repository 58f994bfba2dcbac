//! [`pairs`]: pairs corresponding elements of two drawings.
//!
//! The algorithm is a longest common subsequence in three stages, as in a text diff:
//!
//! 1. Pair elements that are equal.
//! 2. Between those pairs, pair elements with the same tag, class, label, text and number of path commands.
//! 3. Between those, pair elements with the same tag, class and label.
//!
//! Remaining elements with the same tag and class are paired in their order, if both drawings have equally many of
//! them.

use std::hash::{DefaultHasher, Hash, Hasher};

use super::tree::Element;

/// The largest table for the longest common subsequence: 4 million entries of 4 bytes. Longer lists use a greedy
/// search.
const MAX_TABLE_ENTRIES: usize = 4_000_000;

type Pair<'e> = (Option<&'e Element>, Option<&'e Element>);

/// Pairs the elements of an old list with those of a new list. An element without a partner is paired with `None`.
pub(super) fn pairs<'e>(old: &'e [Element], new: &'e [Element]) -> Vec<Pair<'e>> {
    let mut pairs = Vec::new();
    between(old, new, 0, &mut pairs);
    pairs
}

/// Returns a hash of the properties that an element must share with its partner at this stage of the pairing.
fn key(element: &Element, stage: usize) -> u64 {
    // The hash may differ between versions of Rust. This does no harm, because the hash is not stored or printed.
    let mut hasher = DefaultHasher::new();
    match stage {
        0 => element.hash(&mut hasher),
        1 => {
            let commands = element.place_of("d").map_or(0, |d| d.matches(char::is_alphabetic).count());
            (&element.tag, &element.class, element.label(), &element.words, commands).hash(&mut hasher);
        }
        _ => (&element.tag, &element.class, element.label()).hash(&mut hasher),
    }
    hasher.finish()
}

/// Pairs elements with the same key at this stage. The elements between two such pairs are left to the next stage.
fn between<'e>(old: &'e [Element], new: &'e [Element], stage: usize, pairs: &mut Vec<Pair<'e>>) {
    if stage == 3 || old.is_empty() || new.is_empty() {
        pair_rest(old, new, pairs);
        return;
    }
    let keys = |list: &[Element]| list.iter().map(|e| key(e, stage)).collect::<Vec<u64>>();
    let (mut a, mut b) = (0, 0);
    for (i, j) in longest_common_subsequence(&keys(old), &keys(new)) {
        between(&old[a..i], &new[b..j], stage + 1, pairs);
        pairs.push((Some(&old[i]), Some(&new[j])));
        (a, b) = (i + 1, j + 1);
    }
    between(&old[a..], &new[b..], stage + 1, pairs);
}

/// Pairs elements of the same tag and class in their order, if both lists have equally many of them. Otherwise pairs
/// each of them with `None`, as an element that vanished or appeared.
fn pair_rest<'e>(old: &'e [Element], new: &'e [Element], pairs: &mut Vec<Pair<'e>>) {
    let kind = |e: &Element| (e.tag.clone(), e.class.clone());
    let of = |list: &'e [Element], k: &(String, String)| -> Vec<&'e Element> {
        list.iter().filter(|e| kind(e) == *k).collect()
    };
    let mut kinds: Vec<(String, String)> = old.iter().chain(new).map(kind).collect();
    kinds.sort();
    kinds.dedup();
    for k in kinds {
        let (a, b) = (of(old, &k), of(new, &k));
        if a.len() == b.len() {
            pairs.extend(a.into_iter().map(Some).zip(b.into_iter().map(Some)));
        } else {
            pairs.extend(a.into_iter().map(|e| (Some(e), None)));
            pairs.extend(b.into_iter().map(|e| (None, Some(e))));
        }
    }
}

/// Finds a longest common subsequence of two lists of keys, and returns it as pairs of indices. A common prefix and a
/// common suffix are paired first. For very long lists, the subsequence may not be the longest.
fn longest_common_subsequence(old: &[u64], new: &[u64]) -> Vec<(usize, usize)> {
    let ahead = old.iter().zip(new).take_while(|(a, b)| a == b).count();
    let (a, b) = (&old[ahead..], &new[ahead..]);
    let behind = a.iter().rev().zip(b.iter().rev()).take_while(|(a, b)| a == b).count();
    let (a, b) = (&a[..a.len() - behind], &b[..b.len() - behind]);
    let mut found: Vec<(usize, usize)> = (0..ahead).map(|i| (i, i)).collect();
    let middle = if a.len().saturating_mul(b.len()) > MAX_TABLE_ENTRIES {
        greedy_common_subsequence(a, b)
    } else {
        longest(a, b)
    };
    found.extend(middle.into_iter().map(|(i, j)| (i + ahead, j + ahead)));
    let (i, j) = (old.len() - behind, new.len() - behind);
    found.extend((0..behind).map(|k| (i + k, j + k)));
    found
}

/// Finds the longest common subsequence by dynamic programming, and returns it as pairs of indices. The table contains
/// the length of the longest common subsequence for each pair of suffixes.
fn longest(a: &[u64], b: &[u64]) -> Vec<(usize, usize)> {
    let across = b.len() + 1;
    let mut table = vec![0u32; (a.len() + 1) * across];
    for i in (0..a.len()).rev() {
        for j in (0..b.len()).rev() {
            table[i * across + j] = if a[i] == b[j] {
                table[(i + 1) * across + j + 1] + 1
            } else {
                table[(i + 1) * across + j].max(table[i * across + j + 1])
            };
        }
    }
    let (mut i, mut j) = (0, 0);
    let mut found = Vec::new();
    while i < a.len() && j < b.len() {
        if a[i] == b[j] {
            found.push((i, j));
            (i, j) = (i + 1, j + 1);
        } else if table[(i + 1) * across + j] >= table[i * across + j + 1] {
            i += 1;
        } else {
            j += 1;
        }
    }
    found
}

/// Finds a common subsequence with a greedy method: pairs each key of `a` with its first occurrence among the next 64
/// keys of `b`.
fn greedy_common_subsequence(a: &[u64], b: &[u64]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut next = 0;
    for (i, key) in a.iter().enumerate() {
        let window = &b[next..b.len().min(next + 64)];
        if let Some(far) = window.iter().position(|k| k == key) {
            found.push((i, next + far));
            next += far + 1;
        }
    }
    found
}
