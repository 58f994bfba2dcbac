//! [`Picture`]: the pixels of a PNG, whoever wrote it.
//!
//! Every sort of PNG becomes 8 bits of red, green, blue and alpha, not premultiplied; 16 bits are rounded to 8. What is no
//! whole PNG is refused with a sentence of its own ([`PictureError`]). A picture written by [`Picture::encode`] may have had
//! its rare colours rounded to make the file small; it then says by how much each, and the comparison counts that in.
//!
//! The second door of the png crate: `output::png` writes what we draw, this reads what anyone wrote.

mod difference;
mod palette;
mod perception;

use std::collections::BTreeMap;
use std::io::{Cursor, ErrorKind};

use png::{BitDepth, ColorType, DecodingError, Transformations};

pub use difference::{Difference, PixelTolerance};
use palette::Palette;

use crate::output::png::{MAX_PIXELS, MAX_SIDE};

/// The keyword under which a reference says what it shows: a scene or a figure.
const SUBJECT: &str = "drystone-snapshot";
/// The keyword under which a reference says by how much the colours of its table were rounded.
const ROUNDING: &str = "drystone-rounding";
/// How a Git LFS pointer begins.
const POINTER: &[u8] = b"version https://git-lfs";
/// How every PNG begins.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// What a reference shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A scene file beside it.
    Scene,
    /// A drawing that a test makes.
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

/// Why a file is no picture to compare with.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// No bytes at all.
    #[error("it is empty (0 bytes)")]
    Empty,
    /// What Git LFS leaves where the file itself was not fetched.
    #[error("it is a Git LFS pointer and not the picture; fetch it with `git lfs pull`")]
    Pointer,
    /// Another format.
    #[error("it is no PNG: {0}")]
    Foreign(&'static str),
    /// The end is missing.
    #[error("it is cut off: its {0} bytes end before the picture does")]
    Truncated(usize),
    /// Something inside is wrong.
    #[error("it is a damaged PNG: {0}")]
    Damaged(String),
    /// More than is compared.
    #[error(
        "{width} × {height} pixels are too many: at most {MAX_SIDE} along a side and {} million in all",
        MAX_PIXELS / 1_000_000
    )]
    Large {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// Several pictures.
    #[error("it is an animation of {0} pictures; a snapshot is one picture")]
    Animation(u32),
}

/// Pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green, blue and alpha of each pixel, row by row from the upper left corner, not premultiplied. Where alpha is 0 the
    /// others are.
    rgba: Vec<[u8; 4]>,
    /// By how much each channel of a colour may have been rounded; colours that are absent were not.
    rounding: BTreeMap<[u8; 4], u8>,
    /// What it says that it shows.
    pub subject: Option<Subject>,
}

impl Picture {
    /// Pixels as they are: red, green, blue and alpha, row by row, not premultiplied.
    ///
    /// # Panics
    /// Where there are not `width` × `height` pixels.
    pub fn new(width: u32, height: u32, mut rgba: Vec<[u8; 4]>) -> Picture {
        assert_eq!(
            rgba.len() as u64,
            u64::from(width) * u64::from(height),
            "a picture has as many pixels as its width times its height"
        );
        for pixel in rgba.iter_mut().filter(|p| p[3] == 0) {
            *pixel = [0; 4];
        }
        Picture {
            width,
            height,
            rgba,
            rounding: BTreeMap::new(),
            subject: None,
        }
    }

    /// The picture in a PNG.
    ///
    /// # Errors
    /// [`PictureError`], whatever the bytes are.
    ///
    /// # Example
    /// ```
    /// use drystone::snapshot::picture::{Picture, PictureError};
    /// assert_eq!(Picture::decode(b""), Err(PictureError::Empty));
    /// let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n";
    /// assert_eq!(Picture::decode(pointer), Err(PictureError::Pointer));
    /// ```
    pub fn decode(bytes: &[u8]) -> Result<Picture, PictureError> {
        if let Some(foreign) = foreign(bytes) {
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
        let (subject, rounding) = (stated(SUBJECT), stated(ROUNDING));
        let colours = info.palette.as_deref().unwrap_or_default();
        let rounding = rounding.map(|text| palette::rounding(&text, colours));
        let size = reader.output_buffer_size();
        let mut data = vec![0; size.ok_or(PictureError::Large { width, height })?];
        let frame = reader.next_frame(&mut data).map_err(wrong)?;
        reader.finish().map_err(wrong)?;
        data.truncate(frame.buffer_size());
        let mut picture = Picture::new(
            width,
            height,
            straight(&data, frame.color_type, frame.bit_depth),
        );
        picture.rounding = rounding.unwrap_or_default();
        picture.subject = [Subject::Scene, Subject::Figure]
            .into_iter()
            .find(|s| subject.as_deref() == Some(s.name()));
        Ok(picture)
    }

    /// A small PNG: a table of at most 256 colours where nothing shows through. Colours that cover much of the picture are kept
    /// as they are, the others are rounded as little as the table allows, and the file says by how much each.
    ///
    /// # Errors
    /// The encoder's reason.
    pub fn encode(&self, subject: Option<Subject>) -> Result<Vec<u8>, String> {
        palette::encode(self, Palette::new(&self.rgba).as_ref(), subject)
    }

    /// Red, green, blue and alpha of the pixel in column x and row y.
    ///
    /// # Panics
    /// Beyond the edge.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        self.rgba[y as usize * self.width as usize + x as usize]
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.rgba
    }

    /// Whether its table is full, as that of a picture whose colours were rounded, and no rounding is reported.
    pub(super) fn lost_its_note(&self) -> bool {
        let mut colours: Vec<[u8; 4]> = self
            .rgba
            .chunk_by(|a, b| a == b)
            .map(|run| run[0])
            .collect();
        colours.sort_unstable();
        colours.dedup();
        self.rounding.is_empty() && self.subject.is_none() && (200..=256).contains(&colours.len())
    }

    /// By how much a channel of this colour may have been rounded when the picture was written.
    fn rounded(&self, colour: [u8; 4]) -> u8 {
        self.rounding.get(&colour).copied().unwrap_or(0)
    }
}

/// What bytes are that do not begin like a PNG.
fn foreign(bytes: &[u8]) -> Option<PictureError> {
    let begins = |with: &[u8]| bytes.starts_with(with);
    if bytes.is_empty() {
        return Some(PictureError::Empty);
    }
    if begins(POINTER) {
        return Some(PictureError::Pointer);
    }
    if begins(SIGNATURE) {
        return None;
    }
    if SIGNATURE.starts_with(bytes) {
        return Some(PictureError::Truncated(bytes.len()));
    }
    Some(PictureError::Foreign(match bytes {
        b if b.starts_with(b"\x89PNG") => {
            "its line ends were changed, as for a text; mark *.png as binary in .gitattributes"
        }
        b if b.starts_with(b"\xff\xd8") => "it is a JPEG",
        b if b.starts_with(b"GIF8") => "it is a GIF",
        b if b.starts_with(b"RIFF") => "it is a WebP or another RIFF file",
        b if b.len() >= 7 && b[..7].iter().all(|b| *b == b'<') => {
            "it has the marks of a merge conflict"
        }
        [b'<', ..] => "it is SVG or another text in angle brackets",
        b if b.iter().all(|b| *b == 0) => "it holds nothing but zeros",
        _ => "it begins with other bytes",
    }))
}

/// Samples of any colour type as red, green, blue and alpha of 8 bits. Palettes and few bits are expanded already.
fn straight(data: &[u8], colour: ColorType, depth: BitDepth) -> Vec<[u8; 4]> {
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
