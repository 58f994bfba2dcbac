//! Files of many kinds used as references: each is compared or refused with a specific message, without a panic.

use drystone::output::animation;
use drystone::output::png as ours;
use drystone::snapshot::picture::{Difference, Picture};

/// A picture with a few colours and a gradient.
fn sample() -> Picture {
    let pixel = |i: u32| match i % 24 {
        x @ 0..16 => [(16 * x) as u8, 200, (i / 48) as u8 * 9, 255],
        _ => [255, 255, 255, 255],
    };
    Picture::new(24, 20, (0..480).map(pixel).collect())
}

/// A PNG file as another program may write it.
fn foreign(
    colour: png::ColorType,
    depth: png::BitDepth,
    palette: Option<&[u8]>,
    trns: Option<&[u8]>,
    data: &[u8],
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 4, 2);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette.to_vec());
    }
    if let Some(trns) = trns {
        encoder.set_trns(trns.to_vec());
    }
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(data).expect("pixels");
    writer.finish().expect("an end");
    bytes
}

#[test]
fn every_kind_of_png_is_read_as_the_same_pixels() {
    use png::BitDepth::{Eight, Four, One, Sixteen};
    use png::ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
    // Two rows: black, white, black, white; and the reverse.
    let [b, w] = [[0, 0, 0, 255], [255, 255, 255, 255]];
    let expected = Picture::new(4, 2, vec![b, w, b, w, w, b, w, b]);
    let spread = |one: &[u8], zero: &[u8]| -> Vec<u8> {
        let bits = [0, 1, 0, 1, 1, 0, 1, 0];
        bits.iter().flat_map(|bit| if *bit == 1 { one.to_vec() } else { zero.to_vec() }).collect()
    };
    let table: &[u8] = &[0, 0, 0, 255, 255, 255];
    for (what, bytes) in [
        ("1 bit of grey", foreign(Grayscale, One, None, None, &[0b0101_0000, 0b1010_0000])),
        ("8 bits of grey", foreign(Grayscale, Eight, None, None, &spread(&[255], &[0]))),
        ("16 bits of grey", foreign(Grayscale, Sixteen, None, None, &spread(&[255, 200], &[0, 90]))),
        ("grey with alpha", foreign(GrayscaleAlpha, Eight, None, None, &spread(&[255, 255], &[0, 255]))),
        ("a table of 4 bits", foreign(Indexed, Four, Some(table), None, &[0x01, 0x01, 0x10, 0x10])),
        ("a table of 8 bits", foreign(Indexed, Eight, Some(table), Some(&[255, 255]), &spread(&[1], &[0]))),
        ("8 bits of colour", foreign(Rgb, Eight, None, None, &spread(&[255; 3], &[0; 3]))),
        ("16 bits of colour", foreign(Rgb, Sixteen, None, None, &spread(&[255; 6], &[0; 6]))),
        (
            "16 bits of colour and alpha",
            foreign(Rgba, Sixteen, None, None, &spread(&[255; 8], &[0, 0, 0, 0, 0, 0, 255, 255])),
        ),
    ] {
        assert_eq!(Picture::decode(&bytes).as_ref(), Ok(&expected), "{what}");
    }
    let clear = foreign(Rgba, Eight, None, None, &[9, 9, 9, 0].repeat(8));
    let clear_too = Picture::decode(&foreign(Rgba, Eight, None, None, &[200, 3, 3, 0].repeat(8)));
    let difference = Difference::new(&Picture::decode(&clear).expect("read"), &clear_too.expect("read"), 1);
    assert!(difference.is_none(), "the colour of transparent pixels does not matter");
}

#[test]
fn each_kind_of_invalid_png_has_its_own_message() {
    let bytes = sample().encode().expect("packed");
    let refused = |bytes: &[u8]| Picture::decode(bytes).expect_err("no whole picture").to_string();
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:9f8e\nsize 18231\n";
    let text_mode = String::from_utf8_lossy(&bytes[..8]).replace("\r\n", "\n");
    assert!(text_mode.contains("PNG"));
    let mut damaged = bytes.clone();
    damaged[20] ^= 0xff;
    for (bytes, words) in [
        (&b""[..], "it is empty (0 bytes)"),
        (pointer, "it is a Git LFS pointer"),
        (b"\x89PNG\n\x1a\n", "it is not a PNG: its line endings were converted"),
        (b"<svg/>", "it is not a PNG: it is an SVG"),
        (b"<<<<<<< HEAD\n", "line 1 is a mark of a merge conflict"),
        (&bytes[..5], "it is truncated after 5 bytes"),
        (&bytes[..bytes.len() / 2], "it is truncated after"),
        (&damaged, "it is a damaged PNG"),
    ] {
        assert!(refused(bytes).starts_with(words), "{}", refused(bytes));
    }
    // A header with more pixels than the limit.
    let mut huge = foreign(png::ColorType::Grayscale, png::BitDepth::Eight, None, None, &[0; 8]);
    huge[16..24].copy_from_slice(&[0, 0, 255, 255, 0, 0, 255, 255]);
    let crc = crc(&huge[12..29]);
    huge[29..33].copy_from_slice(&crc.to_be_bytes());
    assert!(refused(&huge).starts_with("65535 × 65535 pixels are too many"), "{}", refused(&huge));
    let page = |colour: &str| animation::Step {
        svg: format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><path d='M0 0h9v9z' fill='{colour}'/></svg>"
        ),
        seconds: 0.5,
    };
    let pages = [page("#f00"), page("#00f")];
    let moving = animation::apng(&pages, ours::Size::Natural, &default_fonts()).expect("an animation");
    assert!(refused(&moving).starts_with("it is an animation of 2 pictures"), "{}", refused(&moving));
}

fn default_fonts() -> drystone::output::fonts::Fonts {
    drystone::output::fonts::Fonts::default()
}

/// The checksum of a chunk of PNG, bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    let mut value = u32::MAX;
    for byte in bytes {
        value ^= u32::from(*byte);
        for _ in 0..8 {
            value = if value & 1 == 1 { 0xedb8_8320 ^ (value >> 1) } else { value >> 1 };
        }
    }
    !value
}

#[test]
fn every_beginning_and_every_damaged_byte_is_refused_or_read_without_a_panic() {
    let bytes = sample().encode().expect("packed");
    for end in 0..bytes.len() {
        assert!(Picture::decode(&bytes[..end]).is_err(), "{end} of {} bytes", bytes.len());
    }
    assert_eq!(Picture::decode(&bytes).map(|p| p.pixels().to_vec()), Ok(sample().pixels().to_vec()));
    for place in 0..bytes.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut damaged = bytes.clone();
            damaged[place] ^= flip;
            // A picture that is read has exactly the pixels of its header.
            if let Ok(picture) = Picture::decode(&damaged) {
                assert_eq!(picture.pixels().len() as u64, u64::from(picture.width) * u64::from(picture.height));
            }
        }
    }
}

#[test]
fn pictures_of_different_sizes_are_reported_with_both_sizes() {
    let one = sample();
    let other = Picture::new(20, 24, vec![[255; 4]; 480]);
    let difference = Difference::new(&one, &other, 1);
    assert!(difference.words().starts_with("24 × 20 pixels expected, 20 × 24 found; "), "{}", difference.words());
    let image = difference.image(&one);
    assert_eq!((image.width, image.height), (24, 24));
    assert_eq!(image.pixel(22, 10), [0xb8, 0xd4, 0xf0, 255], "only one of the pictures has this pixel");
    // A page with an additional white row is a different page.
    let white = |w, h| Picture::new(w, h, vec![[255; 4]; (w * h) as usize]);
    let grown = Difference::new(&white(9, 9), &white(9, 10), 1);
    assert_eq!((grown.is_none(), grown.words().as_str()), (false, "9 × 9 pixels expected, 9 × 10 found"));
}
