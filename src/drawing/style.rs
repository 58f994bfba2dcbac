//! [`Colour`] and [`Theme`]: every colour a figure uses, in one place.

use super::plasma::PLASMA;

/// A colour, 8 bits a channel: red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// White.
    pub const WHITE: Colour = Colour([255, 255, 255]);
    /// Black.
    pub const BLACK: Colour = Colour([0, 0, 0]);

    /// A colour from 0xrrggbb.
    ///
    /// ```
    /// use drystone::drawing::Colour;
    /// assert_eq!(Colour::hex(0x2f4f50), Colour([47, 79, 80]));
    /// ```
    pub const fn hex(value: u32) -> Colour {
        Colour([(value >> 16) as u8, (value >> 8) as u8, value as u8])
    }

    /// The colour as `#rrggbb`.
    pub fn css(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// This colour with `share` (0 … 1) of another mixed in.
    pub fn mixed(self, other: Colour, share: f64) -> Colour {
        let mix =
            |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u8;
        let (a, b) = (self.0, other.0);
        Colour([mix(a[0], b[0]), mix(a[1], b[1]), mix(a[2], b[2])])
    }

    /// How bright it looks, 0 … 1 (the weights of Rec. 709 on the coded values; enough to choose black or white ink).
    pub fn brightness(self) -> f64 {
        let [r, g, b] = self.0;
        (0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)) / 255.0
    }
}

/// The colours of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    /// The page.
    pub page: Colour,
    /// Words and rules.
    pub ink: Colour,
    /// Words of lesser weight.
    pub faint: Colour,
    /// Thin lines that part or frame.
    pub rule: Colour,
    /// The seam around an arrow that keeps it apart from what it crosses.
    pub casing: Colour,
    /// Colours of the arrows of blocks 0, 1, 2 …, over and over.
    pub arrows: Vec<Colour>,
    /// Colours of robots 0, 1, 2 …, over and over.
    pub robots: Vec<Colour>,
    /// What fails.
    pub failure: Colour,
    /// The ground.
    pub ground: Colour,
    /// Blocks where colours do not tell amplitudes.
    pub block: Colour,
    /// Outlines of blocks.
    pub outline: Colour,
    /// Seams between the cells of a block.
    pub seam: Colour,
    /// 256 colours for amplitudes, as 0xrrggbb, smallest first.
    pub amplitudes: &'static [u32; 256],
    /// What moves where a structure falls.
    pub motion: Colour,
    /// Where a resultant is safe.
    pub safe: Colour,
    /// The mark of a structure that stands.
    pub stands: Colour,
    /// The mark of a structure that falls.
    pub falls: Colour,
    /// The mark of a structure of which neither is proved.
    pub undecided: Colour,
}

impl Theme {
    /// The source's colours on white paper.
    pub fn paper() -> Theme {
        let all = |values: &[u32]| values.iter().map(|v| Colour::hex(*v)).collect();
        Theme {
            page: Colour::WHITE,
            ink: Colour::hex(0x1c1f24),
            faint: Colour::hex(0x5d646e),
            rule: Colour::hex(0xd9dce1),
            casing: Colour::WHITE,
            arrows: all(&[0x008066, 0x40a066, 0x80c066, 0x209066, 0x60b066]),
            robots: all(&[0xfaed2d, 0xffc303, 0xffa200, 0xfc7f00]),
            failure: Colour::hex(0xff0000),
            ground: Colour::hex(0x2f4f4f),
            block: Colour::hex(0xeceef1),
            outline: Colour::hex(0x808080),
            seam: Colour::hex(0x808080),
            amplitudes: &PLASMA,
            motion: Colour::hex(0x4479b4),
            safe: Colour::hex(0x008066),
            stands: Colour::hex(0x17824f),
            falls: Colour::hex(0xc62121),
            undecided: Colour::hex(0x6b7280),
        }
    }

    /// The arrow colour of the block placed as number `place`, from 1: entry `place` mod 5 of five, so the first block
    /// wears the second colour, as in the source.
    pub fn arrow(&self, place: usize) -> Colour {
        entry(&self.arrows, place).unwrap_or(self.ink)
    }

    /// The colour of a robot by its number, from 0.
    pub fn robot(&self, number: usize) -> Colour {
        entry(&self.robots, number).unwrap_or(self.ink)
    }

    /// The colour of an amplitude as a share of the largest: entry ⌊256·share⌋ of 256, the ends holding on.
    ///
    /// ```
    /// use drystone::drawing::{Colour, Theme};
    /// assert_eq!(Theme::paper().amplitude(8.1667 / 1000.0), Colour::hex(0x130789));
    /// assert_eq!(Theme::paper().amplitude(1.0), Colour::hex(0xf0f921));
    /// ```
    pub fn amplitude(&self, share: f64) -> Colour {
        // `as` holds on at the ends and takes a share that is no number as 0.
        let entry = (share * 256.0) as usize;
        Colour::hex(self.amplitudes[entry.min(255)])
    }
}

/// An entry of a list that begins again at its end.
fn entry(list: &[Colour], number: usize) -> Option<Colour> {
    number
        .checked_rem(list.len())
        .and_then(|i| list.get(i))
        .copied()
}

impl Default for Theme {
    fn default() -> Theme {
        Theme::paper()
    }
}
