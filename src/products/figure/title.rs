//! [`lines`]: a figure's title in lines that fit its page.

use crate::drawing::{Face, Theme, text};

/// A title of more lines than this is set smaller …
const FEW: usize = 3;
/// … by these shares of its size, but no smaller than a caption …
const SMALLER: [f64; 3] = [1.0, 0.85, 0.7];
/// … and cut after so many lines.
const MOST: usize = 5;

/// The face of titles.
pub(crate) const FACE: Face = Face::SerifBold;

/// A title in lines of at most `room` pixels, and the size of its letters.
pub(crate) fn lines(title: &str, room: f64, theme: &Theme) -> (Vec<String>, f64) {
    let least = theme.sizes.caption.min(theme.sizes.title);
    let sizes = SMALLER.map(|share| (share * theme.sizes.title).max(least));
    let wrapped = |size: f64| text::wrap(title, FACE, size, room);
    let fits = sizes.into_iter().find(|size| wrapped(*size).len() <= FEW);
    let size = fits.unwrap_or(sizes[SMALLER.len() - 1]);
    (text::balanced(title, FACE, size, room, MOST), size)
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
        assert!(cut.len() == MOST && cut[MOST - 1].ends_with('…'), "{cut:?}");
    }
}
