//! A file that a picture carries: the scene from which the figure was drawn, byte for byte, compressed with zlib.
//!
//! | format | place of the file |
//! |---|---|
//! | SVG | an element `metadata` with the attribute `data-drystone="scene"`, in base64 |
//! | PNG | a chunk `iTXt` with the keyword `drystone-scene` |
//! | PDF | the attachment `scene.json`, which [`pdf`](super::pdf) writes |
//!
//! A file of another format carries nothing.

use std::borrow::Cow;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};

/// The largest file that a picture carries, in bytes. Reading stops here, so that a small picture cannot fill the memory.
pub(crate) const MAX_BYTES: usize = 64 << 20;

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
/// The length of the signature of a PNG and of its first chunk.
#[cfg(feature = "cli")]
const PNG_HEAD: usize = PNG.len() + 25;
/// The type of the chunk, its keyword, the marks "compressed" and "with zlib", and no language and no other keyword.
const CHUNK: &[u8] = b"iTXtdrystone-scene\0\x01\0\0\0";
const ELEMENT: &str = "<metadata data-drystone=\"scene\">";

/// Why a picture gives back no file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum AttachmentError {
    /// The picture carries no file.
    #[error("this picture carries no scene; drystone render puts it into an SVG, PNG or PDF, without --no-source")]
    Missing,
    /// The file is damaged.
    #[error("the scene in this picture is damaged")]
    Damaged,
    /// The file has more than [`MAX_BYTES`] bytes.
    #[error("the scene in this picture is larger than {} MiB", MAX_BYTES >> 20)]
    TooLarge,
}

/// True if these are the bytes of a PNG or a PDF, which can only be a picture with a scene; an SVG may be a drawing.
pub(crate) fn is_picture(bytes: &[u8]) -> bool {
    bytes.starts_with(PNG) || bytes.starts_with(b"%PDF-")
}

/// Returns the picture, an SVG or a PNG, with the file in it, if there is one. Any other picture stays as it is.
#[cfg(feature = "cli")]
pub(crate) fn attached(mut picture: Vec<u8>, file: Option<&[u8]>) -> Vec<u8> {
    let Some(file) = file else { return picture };
    let packed = || miniz_oxide::deflate::compress_to_vec_zlib(file, 9);
    if picture.starts_with(PNG) {
        let mut chunk = [&[0; 4], CHUNK, &packed()].concat();
        let length = (chunk.len() - 8) as u32;
        chunk[..4].copy_from_slice(&length.to_be_bytes());
        chunk.extend(crc(&chunk[4..]).to_be_bytes());
        picture.splice(PNG_HEAD..PNG_HEAD, chunk);
    } else if picture.ends_with(b"</svg>\n") {
        picture.truncate(picture.len() - "</svg>\n".len());
        picture.extend(format!("{ELEMENT}{}</metadata>\n</svg>\n", STANDARD.encode(packed())).bytes());
    }
    picture
}

/// Returns the file that an SVG, PNG or PDF carries.
pub(crate) fn file_in(picture: &[u8]) -> Result<Vec<u8>, AttachmentError> {
    let packed = if picture.starts_with(PNG) {
        in_png(&picture[PNG.len()..]).map(Cow::from)
    } else if picture.starts_with(b"%PDF-") {
        in_pdf(picture).map(Cow::from)
    } else {
        let text = after(picture, ELEMENT.as_bytes());
        text.map(|text| {
            let end = text.iter().position(|byte| *byte == b'<').unwrap_or(text.len());
            // An editor may break the line.
            let letters = text[..end].iter().copied().filter(|byte| !byte.is_ascii_whitespace());
            STANDARD.decode(letters.collect::<Vec<u8>>()).unwrap_or_default().into()
        })
    };
    let packed = packed.ok_or(AttachmentError::Missing)?;
    decompress_to_vec_zlib_with_limit(&packed, MAX_BYTES).map_err(|error| match error.status {
        TINFLStatus::HasMoreOutput => AttachmentError::TooLarge,
        _ => AttachmentError::Damaged,
    })
}

/// Returns the packed file in the chunks of a PNG.
fn in_png(mut chunks: &[u8]) -> Option<&[u8]> {
    loop {
        let (length, rest) = chunks.split_first_chunk::<4>()?;
        let chunk = rest.get(..(u32::from_be_bytes(*length) as usize).checked_add(4)?)?;
        if let Some(packed) = chunk.strip_prefix(CHUNK) {
            return Some(packed);
        }
        chunks = rest.get(chunk.len() + 4..)?;
    }
}

/// Returns the packed file in the first attachment of a PDF, and what follows it; zlib knows where the file ends.
fn in_pdf(pdf: &[u8]) -> Option<&[u8]> {
    after(after(pdf, b"/Type/EmbeddedFile/")?, b"stream\n")
}

/// Returns the bytes after these words.
fn after<'b>(bytes: &'b [u8], words: &[u8]) -> Option<&'b [u8]> {
    let at = bytes.windows(words.len()).position(|window| window == words)?;
    Some(&bytes[at + words.len()..])
}

/// Returns the checksum of a chunk of a PNG, CRC-32.
#[cfg(feature = "cli")]
fn crc(bytes: &[u8]) -> u32 {
    let one = |crc: u32| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| one(crc)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::output::fonts::Fonts;
    use crate::pictures::output::png::{Compression, Size, render_in};

    const FILE: &[u8] = b"\xef\xbb\xbf{ \"drystone\": 1,\r\n\t\"title\": \"A wall <of> 5 \xe2\x82\xac\" }\r\n";
    const SVG: &str = "<svg xmlns='http://www.w3.org/2000/svg' width='3' height='2'/>";

    fn png() -> Vec<u8> {
        render_in(SVG, Size::Natural, &Fonts::default(), Compression::Small).expect("a picture")
    }

    #[test]
    fn a_picture_gives_its_file_back_byte_for_byte() {
        for picture in [png(), b"<svg>\n</svg>\n".to_vec()] {
            assert_eq!(file_in(&picture), Err(AttachmentError::Missing));
            for file in [FILE, b"", &[0, 255, 10].repeat(99_999)] {
                let carrying = attached(picture.clone(), Some(file));
                assert_eq!(file_in(&carrying).as_deref(), Ok(file));
                assert_eq!(attached(picture.clone(), Some(file)), carrying, "the same bytes each time");
            }
        }
        assert_eq!(attached(b"GIF89a".to_vec(), Some(FILE)), b"GIF89a");
    }

    #[test]
    fn damaged_pictures_are_refused_without_filling_the_memory() {
        let bomb = attached(b"<svg>\n</svg>\n".to_vec(), Some(&vec![b' '; MAX_BYTES + 1]));
        assert_eq!(file_in(&bomb), Err(AttachmentError::TooLarge));
        let carrying = attached(png(), Some(FILE));
        for cut in 0..carrying.len() {
            assert!(file_in(&carrying[..cut]).map_or(true, |file| file == FILE), "{cut}");
        }
        let mut endless = carrying.clone();
        endless[PNG_HEAD..PNG_HEAD + 4].copy_from_slice(&[255; 4]);
        assert_eq!(file_in(&endless), Err(AttachmentError::Missing));
        let mut damaged = carrying;
        damaged[PNG_HEAD + 4 + CHUNK.len() + 9] ^= 1;
        assert_eq!(file_in(&damaged), Err(AttachmentError::Damaged));
        for wrong in
            ["%PDF-1.7\n/Type/EmbeddedFile/", "%PDF-1.7\n/Type/EmbeddedFile//Length 99999999999999999999 stream\nx"]
        {
            assert!(file_in(wrong.as_bytes()).is_err(), "{wrong}");
        }
        for letters in ["", "!", "eJw=", "eJ"] {
            let svg = format!("<svg>{ELEMENT}{letters}");
            assert_eq!(file_in(svg.as_bytes()), Err(AttachmentError::Damaged), "{letters}");
        }
    }
}
