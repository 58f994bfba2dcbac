//! The built-in themes.

use super::super::colour::Colour;
use super::super::ramp;
use super::{ForceMarks, Sizes, Theme, Widths};

impl Theme {
    /// The names of the themes, the default first (of a scene on a lattice, the second is the default). [`Theme::named`] accepts each of them.
    pub const NAMES: [&str; 5] = ["plain", "thesis", "paper", "colourblind", "dark"];

    /// Returns the built-in theme with this name; `None` for a name that is not in [`Theme::NAMES`].
    ///
    /// ```
    /// use drystone::drawing::Theme;
    /// assert_eq!(Theme::named("dark"), Some(Theme::dark()));
    /// assert!(Theme::NAMES.iter().all(|name| Theme::named(name).is_some()));
    /// ```
    pub fn named(name: &str) -> Option<Theme> {
        match name {
            "plain" => Some(Theme::plain()),
            "thesis" => Some(Theme::thesis()),
            "paper" => Some(Theme::paper()),
            "colourblind" => Some(Theme::colourblind()),
            "dark" => Some(Theme::dark()),
            _ => None,
        }
    }

    /// Returns the default theme of scenes that are not on a lattice: pale stones on a white page, with the colours on the marks. Forces go from green to dark
    /// blue.
    pub fn plain() -> Theme {
        Theme {
            page: Colour::WHITE,
            ink: Colour::hex(0x22262b),
            faint: Colour::hex(0x5a626b),
            rule: Colour::hex(0xd9dce1),
            casing: Colour::WHITE,
            arrows: all(&[0x4f9d34, 0x15876a, 0x125f7e, 0x172465]),
            robots: all(&[0xffe11f, 0xffae00, 0xff7d1a, 0xffd08a]),
            load: Colour::hex(0x7a28b8),
            failure: Colour::hex(0xc40018),
            ground: Colour::hex(0x3c4145),
            block: Colour::hex(0xf1efe9),
            outline: Colour::hex(0xa9a8a2),
            motion: Colour::hex(0x4479b4),
            safe: Colour::hex(0x1b7f4b),
            amplitudes: Theme::thesis().amplitudes,
            stands: Colour::hex(0x1b7f4b),
            falls: Colour::hex(0xa80012),
            undecided: Colour::hex(0x6b7280),
            forces: ForceMarks::Joints,
            widths: Widths::DEFAULT,
            sizes: Sizes::PLAIN,
        }
    }

    /// Returns the theme with the colours of the thesis [Vallat23](crate::doc::references) on a white page.
    pub fn thesis() -> Theme {
        Theme {
            page: Colour::WHITE,
            ink: Colour::hex(0x1c1f24),
            faint: Colour::hex(0x5d646e),
            rule: Colour::hex(0xd9dce1),
            casing: Colour::WHITE,
            arrows: all(&[0x008066, 0x40a066, 0x80c066, 0x209066, 0x60b066]),
            robots: all(&[0xfaed2d, 0xffc303, 0xffa200, 0xfc7f00]),
            load: Colour::hex(0x7a3fc0),
            failure: Colour::hex(0xa80000),
            ground: Colour::hex(0x2f4f4f),
            block: Colour::hex(0xeceef1),
            outline: Colour::hex(0x808080),
            motion: Colour::hex(0x4479b4),
            safe: Colour::hex(0x008066),
            amplitudes: ramp::between(&all(&[0xfef3dd, 0xfbc795, 0xf08f78, 0xcf5f7c, 0x943a86, 0x56207c])),
            stands: Colour::hex(0x17824f),
            falls: Colour::hex(0x9c1515),
            undecided: Colour::hex(0x6b7280),
            forces: ForceMarks::Blocks,
            widths: Widths::DEFAULT,
            sizes: Sizes::DEFAULT,
        }
    }

    /// Returns a theme for print in colour or grey. Items that may touch differ in lightness: force arrows are dark and
    /// blocks are light. Robots are lighter than missing forces, and missing forces are lighter than all other forces.
    pub fn paper() -> Theme {
        Theme {
            ink: Colour::BLACK,
            faint: Colour::hex(0x404040),
            rule: Colour::hex(0xc8c8c8),
            arrows: all(&[0x0a0c22, 0x0c3428, 0x5a3f96]),
            robots: all(&[0xe59a1f, 0xf6c94a]),
            load: Colour::hex(0x2f6fc4),
            failure: Colour::hex(0xf0141e),
            ground: Colour::hex(0xa3a9ae),
            block: Colour::hex(0xf2f2f2),
            outline: Colour::hex(0x4d4d4d),
            motion: Colour::hex(0x35527d),
            safe: Colour::hex(0x1b6b43),
            amplitudes: ramp::between(&all(&[0xf1f1ef, 0x505357])),
            stands: Colour::hex(0x1b6b43),
            falls: Colour::hex(0x8a0f14),
            undecided: Colour::hex(0x555555),
            ..Theme::plain()
        }
    }

    /// Returns a theme with the colours of [Okabe08](crate::doc::references) on a white page. The colours of amplitudes
    /// go from yellow to blue. The theme is suitable for all kinds of colour blindness.
    pub fn colourblind() -> Theme {
        Theme {
            ink: Colour::hex(0x1c1f24),
            faint: Colour::hex(0x5d646e),
            arrows: all(&[0x009e73, 0x56b4e9, 0x0072b2]),
            robots: all(&[0xe69f00, 0xf0e442]),
            load: Colour::hex(0xcc79a7),
            failure: Colour::hex(0xd55e00),
            ground: Colour::hex(0x3f444b),
            block: Colour::hex(0xb9c0ca),
            outline: Colour::hex(0xe4e7eb),
            motion: Colour::hex(0x0072b2),
            safe: Colour::hex(0x009e73),
            amplitudes: ramp::between(&all(&[0xfff4c4, 0xd8c67a, 0x8a8779, 0x52637e, 0x25406b, 0x0a2a57])),
            stands: Colour::hex(0x0072b2),
            falls: Colour::hex(0x7d3600),
            undecided: Colour::hex(0x5d646e),
            ..Theme::plain()
        }
    }

    /// Returns a theme with light ink on a dark page, for screens and projectors.
    pub fn dark() -> Theme {
        Theme {
            page: Colour::hex(0x15181d),
            ink: Colour::hex(0xe8eaed),
            faint: Colour::hex(0xa3abb6),
            rule: Colour::hex(0x333a44),
            casing: Colour::hex(0x15181d),
            arrows: all(&[0x4fc3a1, 0xb9e769, 0x6cb4f5]),
            robots: all(&[0xffe05c, 0xffb347]),
            load: Colour::hex(0xd8a0ff),
            failure: Colour::hex(0xff5252),
            ground: Colour::hex(0x46525f),
            block: Colour::hex(0x2a303a),
            outline: Colour::hex(0x8791a0),
            motion: Colour::hex(0x6cb4f5),
            safe: Colour::hex(0x4fc3a1),
            amplitudes: ramp::between(&all(&[0x262e3a, 0x3d5a80, 0x8a6fb0, 0xe0a37c])),
            stands: Colour::hex(0x6fe0a8),
            falls: Colour::hex(0xff6b6b),
            undecided: Colour::hex(0xa3abb6),
            ..Theme::plain()
        }
    }
}

fn all(values: &[u32]) -> Vec<Colour> {
    values.iter().map(|v| Colour::hex(*v)).collect()
}
