//! [`lines`]: breaks the title of a figure into lines that fit the width of its page.

use crate::pictures::drawing::{Face, Theme, text};

/// If a title has more lines than this, a smaller font size is used.
const MAX_FULL_SIZE_LINES: usize = 3;
/// The font sizes that are tried in this order, as fractions of the full size. Sizes below that of captions are
/// raised to it.
const SIZE_STEPS: [f64; 3] = [1.0, 0.85, 0.7];
/// Largest number of lines of a title. A longer title is cut and ends with `…`.
const MAX_LINES: usize = 5;

/// The typeface of titles.
pub(crate) const FACE: Face = Face::SerifBold;

/// Breaks a title into lines of at most `room` pixels. Returns the lines and the font size in pixels, which is
/// smaller for long titles. A title that needs more than [`MAX_LINES`] lines is cut.
pub(crate) fn lines(title: &str, room: f64, theme: &Theme) -> (Vec<String>, f64) {
    let least = theme.sizes.caption.min(theme.sizes.title);
    let sizes = SIZE_STEPS.map(|share| (share * theme.sizes.title).max(least));
    let wrapped = |size: f64| text::wrap(title, FACE, size, room);
    let fits = sizes.into_iter().find(|size| wrapped(*size).len() <= MAX_FULL_SIZE_LINES);
    let size = fits.unwrap_or(sizes[SIZE_STEPS.len() - 1]);
    (text::balanced(title, FACE, size, room, MAX_LINES), size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_title_is_set_smaller_before_it_is_cut() {
        let theme = Theme::thesis();
        let (short, size) = lines("A lintel", 360.0, &theme);
        assert_eq!((short.len(), size), (1, theme.sizes.title));
        let long = "A wall of dry stone with a lintel that rests on two posts and carries a tower above the door";
        let (set, smaller) = lines(long, 240.0, &theme);
        assert!(smaller < size && set.concat().replace(' ', "") == long.replace(' ', ""));
        let (cut, _) = lines(&long.repeat(9), 240.0, &theme);
        assert!(cut.len() == MAX_LINES && cut[MAX_LINES - 1].ends_with('…'), "{cut:?}");
    }
}
