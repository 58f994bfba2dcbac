//! [`Picture`]: reads PNG files from any program, and writes small reference files.
//!
//! Every PNG becomes 8-bit red, green, blue and alpha, not premultiplied; 16-bit channels are rounded to 8 bits. For
//! other files, [`Picture::decode`] returns a [`PictureError`] that names the kind of file. [`Picture::encode`] may
//! round rare colours to make the file small. It then stores the rounding of each colour, and [`Difference`] allows
//! for it.
//!
//! `output::png` writes the pictures for users; this module reads and writes references.

mod difference;
mod palette;
mod perception;

use std::collections::BTreeMap;
use std::io::{Cursor, ErrorKind};

use png::{BitDepth, ColorType, DecodingError, Transformations};

pub use difference::{Difference, PixelTolerance};
use palette::Palette;

use crate::pictures::output::png::{MAX_PIXELS, MAX_SIDE};

/// The PNG text keyword for the subject of a reference: a scene or a figure.
const SUBJECT_KEYWORD: &str = "drystone-snapshot";
/// The PNG text keyword for the roundings of the colours in the palette.
const ROUNDING_KEYWORD: &str = "drystone-rounding";
/// The first bytes of a Git LFS pointer.
const LFS_POINTER_START: &[u8] = b"version https://git-lfs";
/// The first bytes of a PNG.
const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// What a reference picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A scene file next to the reference.
    Scene,
    /// A drawing from a test.
    Figure,
}

impl Subject {
    fn name(self) -> &'static str {
        match self {
            Subject::Scene => "scene",
            Subject::Figure => "figure",
        }
    }
}

/// The reason why a file cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// The file is empty.
    #[error("it is empty (0 bytes)")]
    Empty,
    /// A Git LFS pointer in place of the file.
    #[error("it is a Git LFS pointer and not the picture; fetch it with `git lfs pull`")]
    Pointer,
    /// A file of another format.
    #[error("it is not a PNG: {0}")]
    Foreign(&'static str),
    /// A PNG whose end is missing.
    #[error("it is truncated after {0} bytes")]
    Truncated(usize),
    /// A PNG that cannot be decoded.
    #[error("it is a damaged PNG: {0}")]
    Damaged(String),
    /// A picture with too many pixels.
    #[error(
        "{width} × {height} pixels are too many: at most {MAX_SIDE} along a side and {} million in all",
        MAX_PIXELS / 1_000_000
    )]
    Large {
        /// The width in pixels.
        width: u32,
        /// The height in pixels.
        height: u32,
    },
    /// An animation.
    #[error("it is an animation of {0} pictures; a snapshot must be a single picture")]
    Animation(u32),
}

/// A picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The width in pixels.
    pub width: u32,
    /// The height in pixels.
    pub height: u32,
    /// Red, green, blue and alpha of each pixel, row by row from the upper left corner, not premultiplied. If alpha
    /// is 0, the other channels are 0 too, because they are invisible.
    rgba: Vec<[u8; 4]>,
    /// For each colour of the palette, the largest rounding error of a channel. Empty if the file stores no roundings.
    rounding: BTreeMap<[u8; 4], u8>,
    /// The subject that the file states; `None` if it states none.
    pub subject: Option<Subject>,
}

impl Picture {
    /// Makes a picture from its pixels: red, green, blue and alpha, row by row, not premultiplied.
    ///
    /// # Panics
    /// If there are not `width` × `height` pixels.
    pub fn new(width: u32, height: u32, mut rgba: Vec<[u8; 4]>) -> Picture {
        assert_eq!(
            rgba.len() as u64,
            u64::from(width) * u64::from(height),
            "the number of pixels must be width times height"
        );
        for pixel in rgba.iter_mut().filter(|p| p[3] == 0) {
            *pixel = [0; 4];
        }
        Picture { width, height, rgba, rounding: BTreeMap::new(), subject: None }
    }

    /// Decodes a PNG.
    ///
    /// # Errors
    /// [`PictureError`] if the bytes are not a PNG, or a PNG that is damaged, too large or animated.
    ///
    /// # Example
    /// ```
    /// use drystone::snapshot::picture::{Picture, PictureError};
    /// assert_eq!(Picture::decode(b""), Err(PictureError::Empty));
    /// let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n";
    /// assert_eq!(Picture::decode(pointer), Err(PictureError::Pointer));
    /// ```
    pub fn decode(bytes: &[u8]) -> Result<Picture, PictureError> {
        if let Some(foreign) = not_png_error(bytes) {
            return Err(foreign);
        }
        let wrong = |error: DecodingError| match error {
            DecodingError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => {
                PictureError::Truncated(bytes.len())
            }
            error => PictureError::Damaged(error.to_string()),
        };
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(Transformations::EXPAND);
        let mut reader = decoder.read_info().map_err(wrong)?;
        let info = reader.info();
        let (width, height) = (info.width, info.height);
        let most = width > MAX_SIDE || height > MAX_SIDE;
        if most || u64::from(width) * u64::from(height) > MAX_PIXELS {
            return Err(PictureError::Large { width, height });
        }
        if let Some(animation) = info.animation_control.filter(|a| a.num_frames > 1) {
            return Err(PictureError::Animation(animation.num_frames));
        }
        let stated = |keyword: &str| {
            let mut texts = info.uncompressed_latin1_text.iter();
            texts.find(|t| t.keyword == keyword).map(|t| t.text.clone())
        };
        let (subject, rounding) = (stated(SUBJECT_KEYWORD), stated(ROUNDING_KEYWORD));
        let colours = info.palette.as_deref().unwrap_or_default();
        let rounding = rounding.map(|text| palette::rounding(&text, colours));
        let size = reader.output_buffer_size();
        let mut data = vec![0; size.ok_or(PictureError::Large { width, height })?];
        let frame = reader.next_frame(&mut data).map_err(wrong)?;
        reader.finish().map_err(wrong)?;
        data.truncate(frame.buffer_size());
        let mut picture = Picture::new(width, height, to_rgba(&data, frame.color_type, frame.bit_depth));
        picture.rounding = rounding.unwrap_or_default();
        picture.subject = [Subject::Scene, Subject::Figure].into_iter().find(|s| subject.as_deref() == Some(s.name()));
        Ok(picture)
    }

    /// Encodes the picture as a small PNG with a palette of at most 256 colours. If an opaque picture has more colours,
    /// frequent colours stay exact, and similar other colours are merged. The file then stores the largest rounding
    /// error of each palette colour. If a picture with transparent pixels has more colours, it is stored exactly,
    /// without a palette.
    ///
    /// # Errors
    /// The message of the PNG encoder.
    pub fn encode(&self, subject: Option<Subject>) -> Result<Vec<u8>, String> {
        palette::encode(self, Palette::new(&self.rgba).as_ref(), subject)
    }

    /// Returns red, green, blue and alpha of the pixel in column x and row y, from 0.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        self.rgba[y as usize * self.width as usize + x as usize]
    }

    /// Returns all pixels, row by row.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.rgba
    }

    /// True if another program has probably removed the note on rounded colours from the file: the picture has 200 to
    /// 256 colours, but neither this note nor a subject.
    pub(super) fn has_lost_rounding_note(&self) -> bool {
        let mut colours: Vec<[u8; 4]> = self.rgba.chunk_by(|a, b| a == b).map(|run| run[0]).collect();
        colours.sort_unstable();
        colours.dedup();
        self.rounding.is_empty() && self.subject.is_none() && (200..=256).contains(&colours.len())
    }

    /// Returns the largest rounding error of a channel of this colour, 0 … 255.
    fn rounding_of(&self, colour: [u8; 4]) -> u8 {
        self.rounding.get(&colour).copied().unwrap_or(0)
    }
}

/// Returns `None` if the bytes begin like a PNG. Otherwise returns an error that names the kind of file.
fn not_png_error(bytes: &[u8]) -> Option<PictureError> {
    let begins = |with: &[u8]| bytes.starts_with(with);
    if bytes.is_empty() {
        return Some(PictureError::Empty);
    }
    if begins(LFS_POINTER_START) {
        return Some(PictureError::Pointer);
    }
    if begins(PNG_SIGNATURE) {
        return None;
    }
    if PNG_SIGNATURE.starts_with(bytes) {
        return Some(PictureError::Truncated(bytes.len()));
    }
    Some(PictureError::Foreign(match bytes {
        b if b.starts_with(b"\x89PNG") => {
            "its line endings were converted as in a text file; mark *.png as binary in .gitattributes"
        }
        b if b.starts_with(b"\xff\xd8") => "it is a JPEG",
        b if b.starts_with(b"GIF8") => "it is a GIF",
        b if b.starts_with(b"RIFF") => "it is a WebP or another RIFF file",
        b if b.len() >= 7 && b[..7].iter().all(|b| *b == b'<') => "it contains a merge conflict",
        [b'<', ..] => "it is an SVG or another XML file",
        b if b.iter().all(|b| *b == 0) => "all its bytes are zero",
        _ => "it begins with unknown bytes",
    }))
}

/// Converts samples of any colour type to 8-bit red, green, blue and alpha. The decoder has already expanded
/// palettes, and samples with fewer than 8 bits.
fn to_rgba(data: &[u8], colour: ColorType, depth: BitDepth) -> Vec<[u8; 4]> {
    let eight: Vec<u8>;
    let samples = if depth == BitDepth::Sixteen {
        let round = |pair: &[u8]| {
            let value = u32::from(pair[0]) << 8 | u32::from(pair[1]);
            ((value * 255 + 32_767) / 65_535) as u8
        };
        eight = data.chunks_exact(2).map(round).collect();
        &eight
    } else {
        data
    };
    match colour {
        ColorType::Grayscale => samples.iter().map(|v| [*v, *v, *v, 255]).collect(),
        ColorType::GrayscaleAlpha => {
            let pairs = samples.chunks_exact(2);
            pairs.map(|p| [p[0], p[0], p[0], p[1]]).collect()
        }
        ColorType::Rgba => {
            let fours = samples.chunks_exact(4);
            fours.map(|p| [p[0], p[1], p[2], p[3]]).collect()
        }
        ColorType::Rgb | ColorType::Indexed => {
            let threes = samples.chunks_exact(3);
            threes.map(|p| [p[0], p[1], p[2], 255]).collect()
        }
    }
}
