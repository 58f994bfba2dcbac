//! [`advance`] returns the advance width of a character in one of the built-in fonts.
//!
//! The widths are a table in `assets/fonts/advances.bin`, so that text can be measured without the fonts. A browser
//! draws the text of figures itself, and the module for browsers would be twice as large with the fonts. A test
//! compares the table with the fonts. If `UPDATE_SNAPSHOTS=1` is set, the test writes a new table.
//!
//! The table has one part for each face, in the order of `Face::ALL`. A part begins with the units per em and the
//! number of runs. A run consists of characters with consecutive code points. The first character and the length of
//! each run follow, and then the widths in units. All numbers have two bytes, lower byte first, except that a first
//! character has four bytes.

use std::sync::LazyLock;

/// The bytes of the tables of all faces, one after the other.
static BYTES: &[u8] = include_bytes!("../../../assets/fonts/advances.bin");

/// The table of each face.
static TABLES: LazyLock<Vec<Table>> = LazyLock::new(|| {
    let mut rest = BYTES;
    let next = || (!rest.is_empty()).then(|| Table::read(&mut rest));
    std::iter::from_fn(next).collect()
});

/// Returns the advance width of a character as a fraction of the font size. `face` is the index of the face in
/// `Face::ALL`. Returns `None` if this face has no glyph for the character.
pub(super) fn advance(face: usize, character: char) -> Option<f64> {
    TABLES.get(face)?.advance(character)
}

/// The widths of one face.
struct Table {
    units_per_em: u32,
    runs: Vec<Run>,
}

/// The widths of characters with consecutive code points.
struct Run {
    first: u32,
    widths: Vec<u16>,
}

impl Table {
    /// Reads the table of one face from the beginning of `bytes`, and removes it from `bytes`.
    fn read(bytes: &mut &[u8]) -> Table {
        let units_per_em = u32::from(short(bytes));
        let heads = (0..short(bytes)).map(|_| {
            let [low, high] = [short(bytes), short(bytes)].map(u32::from);
            (high << 16 | low, short(bytes))
        });
        let heads: Vec<(u32, u16)> = heads.collect();
        let run = |(first, length)| Run { first, widths: (0..length).map(|_| short(bytes)).collect() };
        Table { units_per_em, runs: heads.into_iter().map(run).collect() }
    }

    fn advance(&self, character: char) -> Option<f64> {
        let number = u32::from(character);
        let after = self.runs.partition_point(|run| run.first <= number);
        let run = &self.runs[after.checked_sub(1)?];
        let units = *run.widths.get((number - run.first) as usize)?;
        Some(self.rounded(units))
    }

    /// Converts a width in font units to a fraction of the font size. It is rounded as in the font libraries skrifa and
    /// FreeType.
    fn rounded(&self, units: u16) -> f64 {
        let scale = ((64 << 16) + self.units_per_em / 2) / self.units_per_em;
        let bits = (scale * u32::from(units) + 32) / 64;
        f64::from(bits) / 65536.0
    }
}

/// Removes the first two bytes of `bytes`, and returns them as a little-endian number.
fn short(bytes: &mut &[u8]) -> u16 {
    let (number, rest) =
        bytes.split_first_chunk::<2>().expect("the table is complete; a test compares it with the fonts");
    *bytes = rest;
    u16::from_le_bytes(*number)
}

/// Makes the bytes of the table of one face from its units per em and its characters, sorted, with their widths.
#[cfg(test)]
pub(super) fn written(units_per_em: u16, characters: &[(char, u16)]) -> Vec<u8> {
    let follows = |a: &(char, u16), b: &(char, u16)| u32::from(a.0) + 1 == u32::from(b.0);
    let runs: Vec<&[(char, u16)]> = characters.chunk_by(follows).collect();
    let mut bytes = units_per_em.to_le_bytes().to_vec();
    let length = |length: usize| u16::try_from(length).expect("a font has fewer characters");
    bytes.extend(length(runs.len()).to_le_bytes());
    for run in &runs {
        bytes.extend(u32::from(run[0].0).to_le_bytes());
        bytes.extend(length(run.len()).to_le_bytes());
    }
    let widths = characters.iter().flat_map(|(_, width)| width.to_le_bytes());
    bytes.extend(widths);
    bytes
}

/// True if `bytes` equal the stored table. The caller computes `bytes` from the fonts.
#[cfg(test)]
pub(super) fn is(bytes: &[u8]) -> bool {
    bytes == BYTES
}
