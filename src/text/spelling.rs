//! [`nearest`]: finds the known name that the author of an unknown name probably meant.
//!
//! Names are compared by the optimal string alignment distance: the number of letters to change, insert, delete, or
//! swap with a neighbour. References: Damerau 1964; Levenshtein 1966; Ukkonen 1985 for stopping as soon as the
//! distance exceeds a limit.

/// The largest number of letters of a name that are compared. The time grows with the square of this number.
const MAX_LETTERS: usize = 80;

/// Returns the known name that is most similar to `name`; the first if several are equally similar. `None` if no name
/// is similar enough.
///
/// A known name is similar if its edit distance from `name` is at most 1 + n/3, where n is the number of letters of
/// `name`. The distance must also be less than n, unless the known name starts with `name`.
pub fn nearest<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    // This limit keeps the search fast if a file has many unknown names and many known ones.
    const MAX_COMPARED_NAMES: usize = 2000;
    let mut wanted = Vec::new();
    letters(name, &mut wanted);
    let mut max_distance = 1 + wanted.len() / 3;
    let (mut best, mut rows, mut found) = (None, Rows::default(), Vec::new());
    for other in known.into_iter().take(MAX_COMPARED_NAMES) {
        letters(other, &mut found);
        let Some(distance) = rows.distance(&wanted, &found, max_distance) else {
            continue;
        };
        if distance < wanted.len() || other.starts_with(name) {
            best = Some(other);
            // From here on, only a smaller distance is accepted, so that the first of several equally similar names is
            // returned.
            match distance.checked_sub(1) {
                Some(nearer) => max_distance = nearer,
                None => break,
            }
        }
    }
    best
}

/// Writes the letters of a name to `into` in lower case, at most [`MAX_LETTERS`].
fn letters(name: &str, into: &mut Vec<char>) {
    into.clear();
    if name.is_ascii() {
        let small = |b: u8| char::from(b.to_ascii_lowercase());
        into.extend(name.bytes().take(MAX_LETTERS).map(small));
    } else {
        into.extend(name.to_lowercase().chars().take(MAX_LETTERS));
    }
}

/// Three rows of the table of distances between prefixes; the memory is reused for each pair of names.
#[derive(Default)]
struct Rows {
    /// The row before `last`, needed for swaps.
    before: Vec<usize>,
    last: Vec<usize>,
    /// The row that is being filled.
    row: Vec<usize>,
}

impl Rows {
    /// Returns the edit distance of two names; `None` if it exceeds `max_distance`.
    fn distance(&mut self, a: &[char], b: &[char], max_distance: usize) -> Option<usize> {
        if a.len().abs_diff(b.len()) > max_distance {
            return None;
        }
        // A common prefix and a common suffix do not change the distance, so remove them.
        let same = a.iter().zip(b).take_while(|(x, y)| x == y).count();
        let (a, b) = (&a[same..], &b[same..]);
        let backwards = a.iter().rev().zip(b.iter().rev());
        let same = backwards.take_while(|(x, y)| x == y).count();
        let (a, b) = (&a[..a.len() - same], &b[..b.len() - same]);
        for row in [&mut self.before, &mut self.last, &mut self.row] {
            row.clear();
            row.extend(0..=b.len());
        }
        let mut least_before = 0;
        for (i, x) in a.iter().enumerate() {
            self.row[0] = i + 1;
            let (mut left, mut least) = (i + 1, i + 1);
            for (j, y) in b.iter().enumerate() {
                let change = usize::from(x != y);
                let mut here = (self.last[j + 1] + 1).min(left + 1).min(self.last[j] + change);
                if i > 0 && j > 0 && *x == b[j - 1] && a[i - 1] == *y {
                    here = here.min(self.before[j - 1] + 1);
                }
                self.row[j + 1] = here;
                left = here;
                least = least.min(here);
            }
            // Stop early: each row depends only on the two rows before it, so no later value can be smaller than their
            // minima.
            if least > max_distance && least_before + 1 > max_distance {
                return None;
            }
            least_before = least;
            std::mem::swap(&mut self.before, &mut self.last);
            std::mem::swap(&mut self.last, &mut self.row);
        }
        Some(self.last[b.len()]).filter(|distance| *distance <= max_distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_suggested() {
        let keys = ["friction", "kernel", "density", "blocks"];
        for (typed, meant) in [
            ("fricton", Some("friction")),
            ("Kernel", Some("kernel")),
            ("block", Some("blocks")),
            ("densiyt", Some("density")),
            ("colour", None),
        ] {
            assert_eq!(nearest(typed, keys), meant, "{typed}");
        }
        assert_eq!(nearest("b", ["a", "c"]), None, "one letter is not like another");
    }

    /// The edit distance of two names from the complete table, as in the definition.
    fn plain(a: &[char], b: &[char]) -> usize {
        let mut table = vec![vec![0; b.len() + 1]; a.len() + 1];
        for i in 0..=a.len() {
            for j in 0..=b.len() {
                let mut least = if i == 0 || j == 0 { i + j } else { usize::MAX };
                if i > 0 && j > 0 {
                    let change = usize::from(a[i - 1] != b[j - 1]);
                    least = (table[i - 1][j] + 1).min(table[i][j - 1] + 1).min(table[i - 1][j - 1] + change);
                }
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    least = least.min(table[i - 2][j - 2] + 1);
                }
                table[i][j] = least;
            }
        }
        table[a.len()][b.len()]
    }

    #[test]
    fn the_shortened_computation_returns_the_same_distances_as_the_full_table() {
        // All words of up to four letters from an alphabet of three, and two words of five letters. They contain
        // every case in which two words start or end alike, swap letters, or differ.
        let mut words = vec![String::new()];
        let mut first = 0;
        for _ in 0..4 {
            let end = words.len();
            for i in first..end {
                for c in ['a', 'b', 'c'] {
                    words.push(format!("{}{c}", words[i]));
                }
            }
            first = end;
        }
        words.push("acbba".into());
        words.push("abcab".into());
        let words: Vec<Vec<char>> = words.iter().map(|w| w.chars().collect()).collect();
        let mut rows = Rows::default();
        for a in &words {
            for b in &words {
                let all = plain(a, b);
                for reach in 0..=5 {
                    let found = rows.distance(a, b, reach);
                    assert_eq!(found, Some(all).filter(|d| *d <= reach), "{a:?} {b:?}");
                }
            }
        }
    }
}
