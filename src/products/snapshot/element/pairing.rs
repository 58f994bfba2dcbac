//! [`pairs`]: which element of one list stands for which of another.
//!
//! What is the same in both lists holds its place first; in the gaps between, what is called the same; in the gaps between
//! those, what is of one kind, where there are as many of it.

use std::hash::{DefaultHasher, Hash, Hasher};

use super::tree::Element;

/// Lists beyond this product of lengths are paired from the front instead of at best.
const MOST: usize = 4_000_000;

type Pair<'e> = (Option<&'e Element>, Option<&'e Element>);

/// The elements of two lists in pairs, in order; what has no partner stands alone.
pub(super) fn pairs<'e>(old: &'e [Element], new: &'e [Element]) -> Vec<Pair<'e>> {
    let mut pairs = Vec::new();
    between(old, new, 0, &mut pairs);
    pairs
}

/// What two elements that may stand for the same thing have in common, ever less of it.
fn key(element: &Element, stage: usize) -> u64 {
    // Within one run only: nothing of it is reported.
    let mut hasher = DefaultHasher::new();
    match stage {
        0 => element.hash(&mut hasher),
        1 => {
            let places = element
                .place_of("d")
                .map_or(0, |d| d.matches(char::is_alphabetic).count());
            (
                &element.tag,
                &element.class,
                element.label(),
                &element.words,
                places,
            )
                .hash(&mut hasher);
        }
        _ => (&element.tag, &element.class, element.label()).hash(&mut hasher),
    }
    hasher.finish()
}

fn between<'e>(old: &'e [Element], new: &'e [Element], stage: usize, pairs: &mut Vec<Pair<'e>>) {
    if stage == 3 || old.is_empty() || new.is_empty() {
        pair_rest(old, new, pairs);
        return;
    }
    let keys = |list: &[Element]| list.iter().map(|e| key(e, stage)).collect::<Vec<u64>>();
    let (mut a, mut b) = (0, 0);
    for (i, j) in common(&keys(old), &keys(new)) {
        between(&old[a..i], &new[b..j], stage + 1, pairs);
        pairs.push((Some(&old[i]), Some(&new[j])));
        (a, b) = (i + 1, j + 1);
    }
    between(&old[a..], &new[b..], stage + 1, pairs);
}

/// Pairs of one kind where there are as many of it; the rest came or went.
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

/// A longest list of places at which two lists have the same keys in the same order.
fn common(old: &[u64], new: &[u64]) -> Vec<(usize, usize)> {
    let ahead = old.iter().zip(new).take_while(|(a, b)| a == b).count();
    let (a, b) = (&old[ahead..], &new[ahead..]);
    let behind = a
        .iter()
        .rev()
        .zip(b.iter().rev())
        .take_while(|(a, b)| a == b)
        .count();
    let (a, b) = (&a[..a.len() - behind], &b[..b.len() - behind]);
    let mut found: Vec<(usize, usize)> = (0..ahead).map(|i| (i, i)).collect();
    let middle = if a.len().saturating_mul(b.len()) > MOST {
        from_the_front(a, b)
    } else {
        longest(a, b)
    };
    found.extend(middle.into_iter().map(|(i, j)| (i + ahead, j + ahead)));
    let (i, j) = (old.len() - behind, new.len() - behind);
    found.extend((0..behind).map(|k| (i + k, j + k)));
    found
}

/// By a table of the lengths that the rests have in common.
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

/// Each with the next of the same key, where that does not skip more than a few.
fn from_the_front(a: &[u64], b: &[u64]) -> Vec<(usize, usize)> {
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
