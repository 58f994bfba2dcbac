//! [`Theme`]: all colours, line widths and sizes that a user may choose for a figure.

pub mod format;
mod named;
#[cfg(test)]
mod tests;

use super::colour::Colour;
use super::difference::{contrast, lightness};

/// A fill brighter than this has dark seams and letters.
const BRIGHT_FILL: f64 = 0.6;
/// Least contrast of letters with their background: WCAG 2 level AA asks for 4.5.
const MIN_CONTRAST: f64 = 4.55;
/// An arrow that is darker than a bright block by so much lightness stands off by itself, and keeps the usual seam.
const STANDS_OFF: f64 = 53.0;

/// The look of a figure: its colours, widths and sizes.
///
/// The themes that have a name are `thesis`, the source's colours and the default; `paper`, for print, also in grey;
/// `colourblind`, after Okabe and Ito; and `dark`. How far apart two colours are that can meet is measured, and a test
/// holds these numbers. ΔE is CIEDE2000 ([`difference`](super::difference)); of `paper` lightness alone counts, as a grey
/// print shows it; of `colourblind` the number is the least of full sight and the three deficiencies.
///
/// | least distance | `thesis` ΔE | `paper` ΔL* | `colourblind` ΔE | `dark` ΔE |
/// |---|---|---|---|---|
/// | arrows of blocks placed one after the other | 13.1 | 14.7 | 12.1 | 23.6 |
/// | a force's arrow and a robot's | 24.9 | 35.5 | 17.9 | 17.7 |
/// | what fails and any other arrow | 35.5 | 17.0 | 12.5 | 34.7 |
/// | an arrow, or its seam, and what lies below | 33.1 | 36.9 | 27.0 | 30.0 |
/// | letters and what lies below | 38.8 | 44.1 | 35.7 | 38.2 |
///
/// What lies below is a block of any amplitude, a plain one, the ground or the page; there an arrow counts with its seam,
/// whichever is farther. Amplitudes grow darker on a light page and lighter on a dark one; those of `paper` run from L* 95
/// to 35. Letters have a contrast of at least 4.5 with whatever they lie on. What fails, and what falls, differs in lightness
/// from what is green, so that a grey print tells them apart.
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
    /// Loads.
    pub load: Colour,
    /// What fails.
    pub failure: Colour,
    /// The ground.
    pub ground: Colour,
    /// Blocks where colours do not tell amplitudes.
    pub block: Colour,
    /// Outlines of blocks.
    pub outline: Colour,
    /// What moves where a structure falls.
    pub motion: Colour,
    /// Where a resultant is safe.
    pub safe: Colour,
    /// Colours for amplitudes in even steps, smallest first.
    pub amplitudes: Vec<Colour>,
    /// The mark of a structure that stands.
    pub stands: Colour,
    /// The mark of a structure that falls.
    pub falls: Colour,
    /// The mark of a structure of which neither is proved.
    pub undecided: Colour,
    /// How wide lines and arrows are.
    pub widths: Widths,
    /// How large letters are.
    pub sizes: Sizes,
}

/// How wide lines and arrows are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widths {
    /// Shaft of a force's arrow, unit edges.
    pub force: f64,
    /// Shaft of a robot's arrow, unit edges.
    pub robot: f64,
    /// Shaft of a failure's arrow, unit edges.
    pub failure: f64,
    /// Radius of a robot's disc, unit edges.
    pub disc: f64,
    /// Outline of a block, pixels, where blocks are large; small ones have thinner outlines.
    pub outline: f64,
    /// Seam around an arrow, pixels, where blocks are large; among small ones it is thinner.
    pub casing: f64,
}

/// How large letters are, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// The figure's title.
    pub title: f64,
    /// A frame's caption.
    pub caption: f64,
    /// A frame's verdict.
    pub verdict: f64,
    /// What is written below a verdict.
    pub reason: f64,
    /// The key.
    pub key: f64,
    /// Names of blocks where these are large; names of robots are a tenth smaller.
    pub name: f64,
    /// Amounts beside arrows where there is room.
    pub amount: f64,
}

impl Widths {
    /// The source's widths.
    pub const DEFAULT: Widths = Widths {
        force: 0.05,
        robot: 0.07,
        failure: 0.10,
        disc: 0.3,
        outline: 1.5,
        casing: 0.9,
    };
}

impl Sizes {
    /// Letters that read well where a figure is as wide as a printed page.
    pub const DEFAULT: Sizes = Sizes {
        title: 22.0,
        caption: 17.0,
        verdict: 13.5,
        reason: 12.5,
        key: 12.5,
        name: 14.0,
        amount: 11.5,
    };
}

impl Theme {
    /// The arrow colour of a block. `place` is its number in the order of placing, from 1. The colour is entry `place` mod
    /// 5 of five, so the first block has the second colour, as in the source.
    pub fn arrow(&self, place: usize) -> Colour {
        entry(&self.arrows, place).unwrap_or(self.ink)
    }

    /// The colour of a robot by its number, from 0.
    pub fn robot(&self, number: usize) -> Colour {
        entry(&self.robots, number).unwrap_or(self.ink)
    }

    /// The colour of an amplitude. `share` is the amplitude divided by the largest one; the colour is entry ⌊256·share⌋ of
    /// 256. Values outside 0 to 1 are clamped.
    ///
    /// ```
    /// use drystone::drawing::{Colour, Theme};
    /// assert_eq!(Theme::thesis().amplitude(0.0), Colour::hex(0xfef3dd));
    /// assert_eq!(Theme::thesis().amplitude(1.0), Colour::hex(0x56207c));
    /// ```
    pub fn amplitude(&self, share: f64) -> Colour {
        let count = self.amplitudes.len();
        // `as` saturates, and turns a share that is not a number into 0.
        let entry = ((share * count as f64) as usize).min(count.saturating_sub(1));
        self.amplitudes.get(entry).copied().unwrap_or(self.block)
    }

    /// The border colour that separates an arrow from its block. It is dark on a bright block, unless the arrow is much
    /// darker than the block.
    pub fn casing_on(&self, block: Colour, arrow: Colour) -> Colour {
        let lost =
            block.brightness() > BRIGHT_FILL && lightness(block) - lightness(arrow) < STANDS_OFF;
        if lost {
            arrow.mixed(self.darker(), 0.8)
        } else {
            self.casing
        }
    }

    /// The colour of the line between the cells of a block. It is lighter or darker than the block by `share` of the
    /// possible difference, so that it is visible on every block but weaker than an outline.
    pub fn seam_on(&self, block: Colour, share: f64) -> Colour {
        let towards = if block.brightness() < 0.5 {
            self.lighter()
        } else {
            self.darker()
        };
        block.mixed(towards, share)
    }

    /// The colour of text on a block or on the page. If `of` is given, the text gets a shade of that colour. Its [contrast]
    /// with the background is at least 4.5.
    pub fn letters_on(&self, below: Colour, of: Option<Colour>) -> Colour {
        let ink = if contrast(Colour::WHITE, below) > contrast(Colour::BLACK, below) {
            Colour::WHITE
        } else {
            Colour::BLACK
        };
        let (from, least) = match of {
            Some(colour) => (colour, 11),
            None => (below, 15),
        };
        // Try shades in steps of 1/20 towards black or white. One of these two is readable on any colour.
        let shade = |step: u32| from.mixed(ink, f64::from(step) / 20.0);
        let legible = |colour: &Colour| contrast(*colour, below) >= MIN_CONTRAST;
        (least..=20).map(shade).find(legible).unwrap_or(ink)
    }

    /// The brighter of the page colour and the ink colour.
    fn lighter(&self) -> Colour {
        if self.page.brightness() < self.ink.brightness() {
            self.ink
        } else {
            self.page
        }
    }

    /// The darker of the page colour and the ink colour.
    fn darker(&self) -> Colour {
        if self.page.brightness() < self.ink.brightness() {
            self.page
        } else {
            self.ink
        }
    }
}

/// The entry of a list by a number that may exceed its length; the list then starts again.
fn entry(list: &[Colour], number: usize) -> Option<Colour> {
    number
        .checked_rem(list.len())
        .and_then(|i| list.get(i))
        .copied()
}

impl Default for Theme {
    fn default() -> Theme {
        Theme::thesis()
    }
}
