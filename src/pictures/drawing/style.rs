//! [`Theme`]: all colours, line widths and sizes that a user may choose for a figure.

pub mod format;
mod named;
#[cfg(test)]
mod tests;

use super::colour::Colour;
use super::difference::{contrast, lightness};

/// Arrows on a fill brighter than this may get a dark border.
const MIN_BRIGHT_FILL: f64 = 0.6;
/// Least contrast of letters with their background. WCAG 2 level AA requires 4.5.
const MIN_CONTRAST: f64 = 4.55;
/// On a bright block, an arrow is visible with the usual border if its lightness L* is lower than that of the block by
/// at least this value.
const MIN_LIGHTNESS_DIFFERENCE: f64 = 53.0;

/// The look of a figure: its colours, widths and sizes.
///
/// The built-in themes are `plain` (pale stones, and one mark for the force at each joint), `thesis` (with the colours of
/// the thesis [Vallat23](crate::doc::references), and an arrow on each block), `paper` (for print, also in grey),
/// `colourblind` (after Okabe and Ito) and `dark`. The default is `plain`, and `thesis` for scenes on a lattice. The table
/// shows the least distance of colours that can touch; a test checks the numbers. ΔE is CIEDE2000
/// ([`difference`](super::difference)). For `paper`, the distance is the difference of lightness, as in a grey print.
/// For `colourblind`, it is the least value for full colour vision and the three deficiencies.
///
/// | least distance | `thesis` ΔE | `paper` ΔL* | `colourblind` ΔE | `dark` ΔE |
/// |---|---|---|---|---|
/// | arrows of blocks placed one after the other | 13.1 | 14.7 | 12.1 | 23.6 |
/// | arrow of a force and of a robot | 24.9 | 35.5 | 17.9 | 17.7 |
/// | arrow of a failure and any other arrow | 35.5 | 17.0 | 12.5 | 34.7 |
/// | arrow, or its border, and background | 33.1 | 36.9 | 27.0 | 30.0 |
/// | text and background | 38.8 | 44.1 | 35.7 | 38.2 |
///
/// A background is a block of any amplitude, a block without amplitude, the ground or the page. For an arrow on a
/// background, the larger of two distances counts: that of the arrow and that of its border. Larger amplitudes are
/// darker on a light page and lighter on a dark page; those of `paper` run from L* 95 to 35. Text has a contrast of
/// at least 4.5 with its background. Colours of failure and fall differ in lightness from green colours, so that a
/// grey print shows the difference.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    /// Background of the page.
    pub page: Colour,
    /// Text and important lines.
    pub ink: Colour,
    /// Less important text.
    pub faint: Colour,
    /// Thin separating lines and frames.
    pub rule: Colour,
    /// The border of an arrow, which separates it from its background.
    pub casing: Colour,
    /// Colours of the arrows of blocks in turn. [`Theme::arrow`] returns the colour of a block.
    pub arrows: Vec<Colour>,
    /// Colours of robots in turn. [`Theme::robot`] returns the colour of a robot.
    pub robots: Vec<Colour>,
    /// Arrows of loads.
    pub load: Colour,
    /// Arrows and marks of failures and of missing forces.
    pub failure: Colour,
    /// The ground.
    pub ground: Colour,
    /// Blocks whose colour shows no amplitude.
    pub block: Colour,
    /// Outlines of blocks.
    pub outline: Colour,
    /// Blocks in their displaced positions, for example during a collapse, and marks of changes.
    pub motion: Colour,
    /// Kernels: the part of an interface in which a resultant is safe, and the forces that a block can carry.
    pub safe: Colour,
    /// Colours of amplitudes in equal steps, the smallest first.
    pub amplitudes: Vec<Colour>,
    /// The mark of a structure that stands.
    pub stands: Colour,
    /// The mark of a structure that falls.
    pub falls: Colour,
    /// The mark of a structure for which neither standing nor falling is proved.
    pub undecided: Colour,
    /// How the forces at a joint are drawn.
    pub forces: ForceMarks,
    /// Widths of lines and arrows.
    pub widths: Widths,
    /// Font sizes.
    pub sizes: Sizes,
}

/// How figures draw the forces at a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceMarks {
    /// One mark with two heads, in the true place of the resultant.
    Joints,
    /// An arrow on each of the two blocks, in the colour of the block, as in the thesis.
    Blocks,
    /// Joints, but blocks in a scene on a lattice. With the colours of `plain`, such a scene has the theme `thesis`.
    Scene,
}

impl ForceMarks {
    /// The names in style files.
    pub const NAMES: [&str; 3] = ["joints", "blocks", "scene"];

    /// Returns the name of this way to draw forces in style files.
    pub fn name(self) -> &'static str {
        ForceMarks::NAMES[self as usize]
    }
}

/// Widths of lines and arrows. The unit length is the side of a lattice cell, or a typical size of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widths {
    /// Shaft of the arrow of a force, in unit lengths.
    pub force: f64,
    /// Shaft of the arrow of a robot, in unit lengths.
    pub robot: f64,
    /// Shaft of the arrow of a failure, in unit lengths.
    pub failure: f64,
    /// Radius of the disc of a robot, in unit lengths.
    pub disc: f64,
    /// Outline of a large block, pixels; small blocks have thinner outlines.
    pub outline: f64,
    /// Border of an arrow on large blocks, pixels. The border is thinner on small blocks.
    pub casing: f64,
}

/// Font sizes, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// The figure's title.
    pub title: f64,
    /// A frame's caption.
    pub caption: f64,
    /// A frame's verdict.
    pub verdict: f64,
    /// The reason below a verdict.
    pub reason: f64,
    /// The legend.
    pub key: f64,
    /// Names of large blocks; names of robots are a tenth smaller.
    pub name: f64,
    /// Magnitudes next to arrows.
    pub amount: f64,
}

impl Widths {
    /// The widths of the thesis [Vallat23](crate::doc::references).
    pub const DEFAULT: Widths =
        Widths { force: 0.05, robot: 0.07, failure: 0.10, disc: 0.3, outline: 1.5, casing: 0.9 };
}

impl Sizes {
    /// Sizes of figures with one mark at each joint. On paper, they are 70 % of these: 9.5, 7.5 and 6.6 pt.
    pub const PLAIN: Sizes =
        Sizes { title: 18.0, caption: 14.2, verdict: 14.2, reason: 12.5, key: 12.5, name: 12.5, amount: 12.5 };

    /// Sizes for a figure that is as wide as a printed page.
    pub const DEFAULT: Sizes =
        Sizes { title: 22.0, caption: 17.0, verdict: 13.5, reason: 12.5, key: 12.5, name: 14.0, amount: 11.5 };
}

impl Theme {
    /// Returns the colour of the force arrows of a block. `place` is the number of the block in the order of placing,
    /// from 1. The colour is entry `place` mod n of the list of n arrow colours. The first block therefore has the
    /// second colour, as in the thesis.
    pub fn arrow(&self, place: usize) -> Colour {
        entry(&self.arrows, place).unwrap_or(self.ink)
    }

    /// Returns the colour of the robot with this index, from 0. If there are more robots than colours, the list of
    /// colours starts again.
    pub fn robot(&self, number: usize) -> Colour {
        entry(&self.robots, number).unwrap_or(self.ink)
    }

    /// Returns the colour of an amplitude. `share` is the amplitude divided by the largest amplitude. The colour is the
    /// entry with the index ⌊256·share⌋ of the 256 colours; the index is clamped to 0 … 255.
    ///
    /// ```
    /// use drystone::drawing::{Colour, Theme};
    /// assert_eq!(Theme::thesis().amplitude(0.0), Colour::hex(0xfef3dd));
    /// assert_eq!(Theme::thesis().amplitude(1.0), Colour::hex(0x56207c));
    /// ```
    pub fn amplitude(&self, share: f64) -> Colour {
        let count = self.amplitudes.len();
        // `as` saturates and turns NaN into 0.
        let entry = ((share * count as f64) as usize).min(count.saturating_sub(1));
        self.amplitudes.get(entry).copied().unwrap_or(self.block)
    }

    /// Returns the colour of the border that separates an arrow from the block behind it. If the block is bright and
    /// the arrow is not much darker, the border is a dark shade of the arrow's colour. Otherwise its colour is
    /// [`Theme::casing`].
    pub fn casing_on(&self, block: Colour, arrow: Colour) -> Colour {
        let lost =
            block.brightness() > MIN_BRIGHT_FILL && lightness(block) - lightness(arrow) < MIN_LIGHTNESS_DIFFERENCE;
        if lost { arrow.mixed(self.darker(), 0.8) } else { self.casing }
    }

    /// Returns the colour of the lines between the cells of a block. The colour of a dark block is mixed with the
    /// lighter of the page and ink colours, and the colour of a bright block with the darker. `share` (0 to 1) is the
    /// fraction of the page or ink colour in the mixture.
    pub fn seam_on(&self, block: Colour, share: f64) -> Colour {
        let towards = if block.brightness() < 0.5 { self.lighter() } else { self.darker() };
        block.mixed(towards, share)
    }

    /// Returns the colour of text on the background `below`. It is a shade of the colour `of`, or of `below` if `of` is
    /// `None`. The [contrast] between text and background is at least 4.5.
    pub fn letters_on(&self, below: Colour, of: Option<Colour>) -> Colour {
        let ink =
            if contrast(Colour::WHITE, below) > contrast(Colour::BLACK, below) { Colour::WHITE } else { Colour::BLACK };
        let (from, least) = match of {
            Some(colour) => (colour, 11),
            None => (below, 15),
        };
        // Mix the colour with black or white, whichever contrasts more with the background, until the text is readable.
        // On any background, either black or white is readable.
        let shade = |step: u32| from.mixed(ink, f64::from(step) / 20.0);
        let legible = |colour: &Colour| contrast(*colour, below) >= MIN_CONTRAST;
        (least..=20).map(shade).find(legible).unwrap_or(ink)
    }

    /// Returns the brighter of the page colour and the ink colour.
    fn lighter(&self) -> Colour {
        if self.page.brightness() < self.ink.brightness() { self.ink } else { self.page }
    }

    /// Returns the theme for a scene: the way to draw forces no longer depends on whether the scene is on a lattice.
    #[must_use]
    pub(crate) fn for_scene(&self, is_lattice: bool) -> Theme {
        match self.forces {
            ForceMarks::Scene if is_lattice && *self == Theme::default() => Theme::thesis(),
            ForceMarks::Scene if is_lattice => Theme { forces: ForceMarks::Blocks, ..self.clone() },
            ForceMarks::Scene => Theme { forces: ForceMarks::Joints, ..self.clone() },
            _ => self.clone(),
        }
    }

    /// Returns the darker of the page colour and the ink colour.
    fn darker(&self) -> Colour {
        if self.page.brightness() < self.ink.brightness() { self.page } else { self.ink }
    }
}

/// Returns the entry with the index `number` mod n of a list of n colours, or `None` for an empty list.
fn entry(list: &[Colour], number: usize) -> Option<Colour> {
    number.checked_rem(list.len()).and_then(|i| list.get(i)).copied()
}

impl Default for Theme {
    fn default() -> Theme {
        Theme { forces: ForceMarks::Scene, ..Theme::plain() }
    }
}
