//! [`nearest`]: the known name that was probably meant by an unknown one.

/// The known name that looks most like another one, if any is near.
pub fn nearest<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    // Comparing a long list of unknown names with a long list of known ones must not take minutes.
    const MOST: usize = 2000;
    let wanted: Vec<char> = name.to_lowercase().chars().take(80).collect();
    let reach = 1 + wanted.len() / 3;
    known
        .into_iter()
        .take(MOST)
        .map(|other| {
            (
                distance(
                    &wanted,
                    &other.to_lowercase().chars().take(80).collect::<Vec<_>>(),
                    reach,
                ),
                other,
            )
        })
        .filter(|(d, other)| *d <= reach && (*d < wanted.len() || other.starts_with(name)))
        .min_by_key(|(d, _)| *d)
        .map(|(_, other)| other)
}

/// How many letters have to be changed, added, left out or swapped; anything beyond `reach` counts as beyond.
fn distance(a: &[char], b: &[char], reach: usize) -> usize {
    if a.len().abs_diff(b.len()) > reach {
        return reach + 1;
    }
    let mut before: Vec<usize> = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (last[j] + 1).min(row[j - 1] + 1).min(last[j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = last;
        last = row;
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_the_one_meant() {
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
        assert_eq!(
            nearest("b", ["a", "c"]),
            None,
            "one letter is not like another"
        );
    }
}
