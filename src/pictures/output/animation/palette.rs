//! [`Palette`]: the colours of all pictures of an animation, at most 255. One more index marks pixels that do not
//! change.

use std::collections::BTreeMap;

use super::patch::Patch;

/// The index of a pixel that does not change.
pub(super) const UNCHANGED_INDEX: u8 = 0;
/// Largest number of colours, which have the other indices.
const MAX_COLOURS: usize = 255;
/// If there are more colours, this number of the most frequent colours is kept exactly. These are usually fills and
/// lines.
const EXACT_COLOURS: usize = 96;
/// All other colours are grouped by the leading bits of each channel. Fewer than this number of bits per channel are
/// compared.
const CHANNEL_BITS: u32 = 7;

/// The colours of an animation.
pub(super) struct Palette {
    /// The colours in the order of their indices, which begin at 1.
    colours: Vec<[u8; 3]>,
    /// The index of the nearest palette colour for each colour of the pictures.
    numbers: BTreeMap<[u8; 3], u8>,
}

impl Palette {
    /// Creates the palette for all pictures of an animation. Returns `None` if a changed pixel is not opaque.
    pub fn new(patches: &[Patch]) -> Option<Palette> {
        let counts = counts(patches)?;
        let colours = chosen(&counts);
        let number = |colour: &[u8; 3]| {
            let near = colours.iter().enumerate();
            let nearest = near.min_by_key(|(_, other)| distance(*colour, **other));
            nearest.map_or(UNCHANGED_INDEX, |(number, _)| number as u8 + 1)
        };
        let numbers = counts.keys().map(|colour| (*colour, number(colour)));
        Some(Palette { numbers: numbers.collect(), colours })
    }

    /// Returns the number of indices in the palette, including the index of unchanged pixels.
    pub fn len(&self) -> usize {
        self.colours.len() + 1
    }

    /// Returns the bytes of the palette: red, green and blue for each index in order.
    pub fn bytes(&self) -> Vec<u8> {
        let all = [[0; 3]].into_iter().chain(self.colours.iter().copied());
        all.flatten().collect()
    }

    /// Returns an index for each pixel of a patch, row by row: that of its colour in the palette, or
    /// [`UNCHANGED_INDEX`] if the pixel does not change.
    pub fn indices(&self, patch: &Patch) -> Vec<u8> {
        // Neighbouring pixels often have the same colour, so keep the last colour and its index.
        let mut known = ([0; 3], None);
        let number = |(colour, changed): &([u8; 4], bool)| {
            if !changed {
                return UNCHANGED_INDEX;
            }
            let colour = opaque(*colour);
            if known.1.is_none() || known.0 != colour {
                known = (colour, self.numbers.get(&colour).copied());
            }
            known.1.unwrap_or(UNCHANGED_INDEX)
        };
        patch.pixels.iter().map(number).collect()
    }
}

fn opaque([red, green, blue, _]: [u8; 4]) -> [u8; 3] {
    [red, green, blue]
}

/// Counts the changed pixels of each colour. Returns `None` if a changed pixel is not opaque.
fn counts(patches: &[Patch]) -> Option<BTreeMap<[u8; 3], usize>> {
    let mut counts = BTreeMap::new();
    let changed = |patch: &'_ Patch| -> Vec<[u8; 4]> {
        let pixels = patch.pixels.iter().filter(|(_, changed)| *changed);
        pixels.map(|(colour, _)| *colour).collect()
    };
    for patch in patches {
        for alike in changed(patch).chunk_by(|a, b| a == b) {
            if alike[0][3] != u8::MAX {
                return None;
            }
            *counts.entry(opaque(alike[0])).or_insert(0) += alike.len();
        }
    }
    Some(counts)
}

/// Returns the colours of the palette. Up to [`MAX_COLOURS`] colours are all kept. If there are more, the result has
/// the most frequent colours, and one colour for each group of similar colours among the others.
fn chosen(counts: &BTreeMap<[u8; 3], usize>) -> Vec<[u8; 3]> {
    let mut colours: Vec<([u8; 3], usize)> = counts.iter().map(|(c, n)| (*c, *n)).collect();
    if colours.len() > MAX_COLOURS {
        colours.sort_by_key(|(colour, count)| (core::cmp::Reverse(*count), *colour));
        let others = colours.split_off(EXACT_COLOURS);
        colours.extend(reduced(&others, MAX_COLOURS - EXACT_COLOURS));
    }
    colours.into_iter().map(|(colour, _)| colour).collect()
}

/// Groups colours that have the same leading bits in each channel, and returns the first colour of each group. Compares
/// as many bits as possible such that there are at most `most` groups.
fn reduced(colours: &[([u8; 3], usize)], most: usize) -> Vec<([u8; 3], usize)> {
    for bits in (1..CHANNEL_BITS).rev() {
        let mut groups = BTreeMap::new();
        for (colour, count) in colours {
            let group = colour.map(|channel| channel >> (8 - bits));
            groups.entry(group).or_insert((*colour, *count));
        }
        if groups.len() <= most {
            return groups.into_values().collect();
        }
    }
    Vec::new()
}

fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    let channels = a.into_iter().zip(b);
    channels.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
}
