//! Tests of the content of pictures and of their compression. An SVG written only for pixels must give the same
//! picture as the full SVG.

use super::*;
use crate::pictures::drawing::{
    Anchor, Colour, Drawing, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text,
};
use crate::pictures::output::svg;

fn words(words: &str, face: Face) -> String {
    let text = Text::new(PagePoint::new(5.0, 30.0), words, face, 24.0, Colour::BLACK);
    svg::write(&Drawing {
        width: 120.0,
        height: 40.0,
        title: String::new(),
        description: String::new(),
        background: Some(Colour::WHITE),
        items: vec![text.into()],
    })
}

/// The fraction of dark pixels.
fn ink(svg: &str) -> f64 {
    let bytes = render(svg, Size::Natural).expect("a picture");
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().expect("png");
    let mut data = vec![0; reader.output_buffer_size().expect("size")];
    reader.next_frame(&mut data).expect("frame");
    data.chunks_exact(3).filter(|p| p[0] < 128).count() as f64 / (data.len() as f64 / 3.0)
}

#[test]
fn every_face_draws_letters_and_bold_faces_are_darker() {
    for face in Face::ALL {
        assert!(ink(&words("Block 3", face)) > 0.02, "{face:?}");
    }
    assert!(ink(&words("Block 3", Face::SerifBold)) > 1.15 * ink(&words("Block 3", Face::Serif)));
    assert!(ink(&words("Block 3", Face::SansBold)) > 1.05 * ink(&words("Block 3", Face::Sans)));
    assert_eq!(ink(&words("", Face::Sans)), 0.0);
}

#[test]
fn characters_in_no_font_become_a_question_mark() {
    let picture = |text: &str, face| render(&words(text, face), Size::Natural).expect("a picture");
    for face in [Face::Serif, Face::Sans] {
        for unknown in ["石", "🪨", "ア", "\u{e000}", "لوح"] {
            let marks = "?".repeat(unknown.chars().count());
            assert_eq!(picture(unknown, face), picture(&marks, face), "{unknown}");
        }
    }
}

fn decoded(bytes: Vec<u8>) -> Vec<u8> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::ALPHA | png::Transformations::EXPAND);
    let mut reader = decoder.read_info().expect("png");
    let mut data = vec![0; reader.output_buffer_size().expect("size")];
    reader.next_frame(&mut data).expect("frame");
    data
}

#[test]
fn compression_does_not_change_the_pixels() {
    let ramp = "<linearGradient id='r'><stop stop-color='#f00'/><stop offset='0.5' stop-color='#0f0'/><stop offset='1' stop-color='#00f'/></linearGradient>\
                <rect width='600' height='40' fill='url(#r)'";
    // A palette with a translucent colour; many opaque colours; many translucent colours.
    for (inside, colour_type) in [
        ("<rect width='9' height='9' fill='#123456' opacity='0.4'/>".to_owned(), 3),
        (format!("{ramp}/>"), 2),
        (format!("{ramp} opacity='0.9'/>"), 6),
    ] {
        let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' width='600' height='40'>{inside}</svg>");
        let drawn = rgba(&svg, Size::Natural).expect("drawn").rgba.concat();
        let [small, quick] = [Compression::Small, Compression::Quick]
            .map(|compression| render_in(&svg, Size::Natural, &Fonts::default(), compression).expect("packed"));
        assert_eq!(small[25], colour_type, "the PNG's colour type");
        assert!(small.len() <= quick.len());
        for packed in [small, quick] {
            assert!(decoded(packed) == drawn, "{inside}");
        }
    }
}

#[test]
fn the_same_text_gives_the_same_bytes() {
    let svg = words("Same", Face::Serif);
    assert_eq!(render(&svg, Size::Scale(2.5)).expect("one"), render(&svg, Size::Scale(2.5)).expect("two"));
}

#[test]
fn impossible_sizes_and_invalid_text_are_refused_with_a_reason() {
    let svg = words("x", Face::Serif);
    for size in [
        Size::Width(0),
        Size::Width(60_000),
        Size::Scale(0.0),
        Size::Scale(-1.0),
        Size::Scale(f64::NAN),
        Size::Scale(1e9),
        Size::Width(31_000),
    ] {
        let refused = render(&svg, size).expect_err("out of range");
        assert!(matches!(refused, PngError::Size { .. }) && refused.to_string().contains("at most 100 million"));
    }
    assert!(matches!(render("no svg", Size::Natural), Err(PngError::Svg(_))));
}

fn shapes() -> Vec<Item> {
    let p = PagePoint::new;
    let ink = Colour::hex(0x2f4f8f);
    let ring = Outline::ring([p(8.126, 9.0), p(61.3, 14.625), p(40.007, 51.44)]);
    let ground = Outline::ring([p(-900.0, 70.31), p(950.5, 70.31), p(950.5, 400.0), p(-900.0, 400.0)]);
    let slope = Outline::ring([p(-70.0, 60.0), p(210.5, 75.0), p(90.0, 140.0)]);
    let within = Group { clip: Some(PageRect { at: p(12.3, 20.7), width: 90.4, height: 61.9 }), ..Group::default() };
    let words = |x, y, words: &str, face, size| Text::new(p(x, y), words, face, size, ink);
    vec![
        Path::filled(ring.clone(), Colour::hex(0xcf5f7c)).into(),
        Path::stroked(ring.clone(), Stroke::new(ink, 1.49)).into(),
        Path::stroked(
            Outline::line([p(3.0, 3.0), p(140.0, 44.4), p(12.0, 60.0)]),
            Stroke::new(ink, 0.6).dashed([4.0, 2.5, 1.0]).mitred(),
        )
        .into(),
        Path::filled(Outline::circle(p(90.0, 30.0), 12.345), Colour::WHITE).with_stroke(Stroke::new(ink, 2.0)).into(),
        Path::filled(Outline::circle(p(100.0, 40.0), 20.0), Colour::BLACK).with_opacity(0.35).into(),
        Path::filled(Outline::circle(p(120.0, 20.0), 20.0), ink).cased(Colour::WHITE, 2.5).with_opacity(0.625).into(),
        // A path without area and an empty path.
        Path::filled(Outline::line([p(1.0, 1.0), p(9.0, 1.0)]), ink).into(),
        Path::filled(Outline::default(), ink).into(),
        within
            .clone()
            .with(Path::filled(ground, Colour::hex(0x2f4f4f)).with_stroke(Stroke::new(Colour::hex(0x808080), 1.7)))
            .with(Path::filled(slope, Colour::hex(0x808080)).with_opacity(0.5))
            .with(words(30.0, 60.0, "within, and cut off", Face::SansBold, 14.0))
            .into(),
        Group::with_class("labels")
            .with(words(70.0, 20.0, "Größe 12.5 kN · AVATAR", Face::Sans, 12.5).with_halo(Colour::WHITE, 2.0))
            .with(words(70.0, 36.25, "Keystone fi", Face::SerifItalic, 13.3).anchored(Anchor::Middle))
            .with(words(150.0, 50.0, "שלום 3 石", Face::Serif, 16.0).anchored(Anchor::End))
            .with(words(20.0, 80.0, "  two  spaces <&> ", Face::SerifBold, 9.995))
            .with(words(20.0, 90.0, "e\u{301}\u{327}a\u{308}", Face::Sans, 11.0))
            .with(words(0.0, 0.0, "", Face::Sans, 9.0))
            .with(words(0.0, 9.0, " ", Face::Sans, 9.0))
            .into(),
    ]
}

#[test]
fn an_svg_for_pixels_alone_has_the_pixels_of_the_full_svg() {
    for background in [Some(Colour::WHITE), Some(Colour::hex(0xf4f1ea)), None] {
        let drawing = Drawing { width: 160.37, height: 98.6, background, items: shapes(), ..Drawing::default() };
        for size in [Size::Natural, Size::Width(97), Size::Width(400)] {
            let full = rgba(&svg::write(&drawing), size).expect("a valid SVG");
            let bare = rgba(&svg::for_pixels(&drawing), size).expect("a valid SVG");
            assert!(full == bare, "{background:?} at {size:?}");
        }
    }
}
