//! Output files: SVG is valid in every form, PDF has its size in millimetres and searchable text, and PNG states its
//! size.

use drystone::drawing::{Colour, Drawing};
use drystone::output::svg::{Options, Words};
use drystone::output::{pdf, png, svg};
use drystone::{Analysis, Scene, figure};

const SCENES: [&str; 6] = [
    "thesis/figure-4",
    "thesis/figure-5",
    "thesis/figure-8-left",
    "thesis/figure-8-right",
    "thesis/figure-9b",
    "study/stack-harmonic-falls",
];

fn read(name: &str) -> Scene {
    let path = format!("{}/assets/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the scene is there");
    Scene::from_json(&text).unwrap_or_else(|problems| panic!("{name}:\n{problems}"))
}

fn drawn(scene: &Scene) -> Drawing {
    figure::forces(&Analysis::new(scene), &figure::Options::default())
}

fn figure(name: &str) -> Drawing {
    drawn(&read(name))
}

/// A drawing of a scene whose names contain XML markup and characters that XML forbids.
fn hostile() -> Drawing {
    let nasty = "a]]>&amp;\"'</text><!-- \u{7}石\u{fffe} x";
    let file = serde_json::json!({ "drystone": 1, "title": nasty, "blocks": [
        { "id": nasty, "polygon": [[0, 0], [1, 0], [0, 1]] }, { "id": "]]>", "polygon": [[5, 0], [6, 0], [5, 1]] } ] });
    drawn(&crate::structure::scene(&file))
}

fn written(drawing: &Drawing, words: Words) -> String {
    let options = Options::default().words(words);
    svg::write_with(drawing, &options).expect("written")
}

/// Parses a document and checks that each id occurs once and each reference has a target.
fn sound(svg: &str, what: &str) {
    let document = roxmltree::Document::parse(svg).unwrap_or_else(|e| panic!("{what}: {e}"));
    let mut names = std::collections::BTreeSet::new();
    for node in document.descendants() {
        if let Some(name) = node.attribute("id") {
            assert!(names.insert(name), "{what} has the id {name} twice");
        }
    }
    for node in document.descendants().filter(|n| n.is_element()) {
        let labels = node.attribute("aria-labelledby").unwrap_or_default();
        let clip = node.attribute("clip-path").map(|c| c.trim_start_matches("url(#").trim_end_matches(')'));
        for name in labels.split_whitespace().chain(clip) {
            assert!(names.contains(name), "{what} has no element with the id {name}");
        }
    }
}

#[test]
fn every_svg_is_sound_in_every_form() {
    let mut drawings: Vec<(&str, Drawing)> = SCENES.map(|name| (name, figure(name))).into();
    drawings.push(("shapes", figure::shapes(&drystone::drawing::Theme::thesis())));
    drawings.push(("hostile", hostile()));
    for (name, drawing) in drawings {
        for words in [Words::Names, Words::Embedded, Words::Outlines] {
            let svg = written(&drawing, words);
            sound(&svg, name);
            assert_eq!(svg, written(&drawing, words), "{name}");
            assert_eq!(svg.contains("<text"), words != Words::Outlines, "{name}");
            assert_eq!(svg.contains("@font-face"), words == Words::Embedded, "{name}");
        }
        assert_eq!(svg::write(&drawing), written(&drawing, Words::Names), "{name}");
    }
}

#[test]
fn several_forms_of_a_figure_can_share_a_page() {
    let drawing = figure("thesis/figure-8-left");
    let all = [Words::Names, Words::Embedded, Words::Outlines].map(|words| written(&drawing, words));
    sound(&format!("<div>{}</div>", all.concat()), "a page");
}

/// The pixels of a PNG file as bytes, and the number of bytes per pixel.
fn pixels(bytes: &[u8]) -> (Vec<u8>, usize) {
    let mut decoder = ::png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(::png::Transformations::EXPAND);
    let mut reader = decoder.read_info().expect("png");
    let mut data = vec![0; reader.output_buffer_size().expect("size")];
    let info = reader.next_frame(&mut data).expect("frame");
    (data, info.color_type.samples())
}

#[test]
fn text_as_outlines_is_at_the_position_of_the_text() {
    for name in SCENES {
        let drawing = figure(name);
        let picture = |words| {
            let png = png::render(&written(&drawing, words), png::Size::Scale(2.0));
            pixels(&png.expect("a picture")).0
        };
        let (names, outlines) = (picture(Words::Names), picture(Words::Outlines));
        let apart: Vec<u8> = names.iter().zip(&outlines).map(|(a, b)| a.abs_diff(*b)).collect();
        let mean = apart.iter().map(|a| f64::from(*a)).sum::<f64>() / names.len() as f64;
        assert!(mean < 0.1, "{name}: {mean} of 255 on average");
        let most = apart.iter().copied().max();
        // The edges of letters are smoothed differently: single pixels differ by less than 80 of 255.
        assert!(most < Some(80), "{name}: {most:?}");
    }
}

#[test]
fn embedded_fonts_have_the_letters_and_their_widths() {
    use base64::Engine as _;
    use skrifa::MetadataProvider;
    use skrifa::instance::{LocationRef, Size};
    let svg = written(&figure("thesis/figure-4"), Words::Embedded);
    let mut fonts = 0;
    for rule in svg.split("@font-face").skip(1) {
        let rule = rule.split('}').next().expect("a rule ends");
        let data = rule.split("base64,").nth(1).and_then(|d| d.split(')').next());
        let data = base64::engine::general_purpose::STANDARD.decode(data.expect("data"));
        let data = data.expect("base64");
        let font = skrifa::raw::FontRef::new(&data).expect("a font");
        let face = match (rule.contains("-serif"), rule.contains("weight:400"), rule.contains("italic")) {
            (true, true, false) => drystone::drawing::Face::Serif,
            (true, true, true) => drystone::drawing::Face::SerifItalic,
            (true, false, _) => drystone::drawing::Face::SerifBold,
            (false, true, _) => drystone::drawing::Face::Sans,
            (false, false, _) => drystone::drawing::Face::SansBold,
        };
        let mut letters = 0;
        for (character, glyph) in font.charmap().mappings() {
            let character = char::from_u32(character).expect("a character");
            let width =
                font.glyph_metrics(Size::new(10.0), LocationRef::default()).advance_width(glyph).expect("a width");
            let ours = drystone::drawing::text::width(&character.to_string(), face, 10.0);
            assert!((f64::from(width) - ours).abs() < 1e-3, "{face:?} {character}");
            assert!(font.outline_glyphs().get(glyph).is_some(), "{face:?} {character}");
            letters += 1;
        }
        assert!((1..120).contains(&letters), "{face:?}: {letters} letters");
        assert!(data.len() < 40_000, "{face:?}: {} bytes", data.len());
        fonts += 1;
    }
    assert!(fonts >= 3, "{fonts} fonts");
}

/// The uncompressed streams of a PDF.
fn streams(pdf: &[u8]) -> Vec<Vec<u8>> {
    let find = |from: usize, what: &[u8]| {
        let at = pdf.get(from..)?.windows(what.len()).position(|w| w == what)?;
        Some(from + at)
    };
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(begin) = find(at, b"stream\n") {
        let end = find(begin, b"endstream").expect("a stream ends");
        let data = &pdf[begin + 7..end];
        let unpacked = miniz_oxide::inflate::decompress_to_vec_zlib(data);
        found.push(unpacked.unwrap_or_else(|_| data.to_vec()));
        at = end + 9;
    }
    found
}

#[test]
fn a_pdf_has_its_size_its_fonts_and_its_text_and_no_dates() {
    let drawing = figure("thesis/figure-4");
    let pdf = pdf::write(&drawing, Some(84.0)).expect("a page");
    assert_eq!(pdf, pdf::write(&drawing, Some(84.0)).expect("again"));
    let text = String::from_utf8_lossy(&pdf);
    // 84 mm are 238.11 points.
    let media = text.split("/MediaBox").nth(1).expect("a page");
    let numbers: Vec<f64> = media
        .split(['[', ']'])
        .nth(1)
        .expect("a box")
        .split_whitespace()
        .map(|n| n.parse().expect("a number"))
        .collect();
    let expected = [0.0, 0.0, 238.1102, 238.1102 * drawing.height / drawing.width];
    for (number, expected) in numbers.iter().zip(expected) {
        assert!((number - expected).abs() < 0.01, "{numbers:?}");
    }
    for entry in ["/FontFile", "Libertinus", "Inter", "/ToUnicode", "/Figure", "/Alt"] {
        assert!(text.contains(entry), "no {entry}");
    }
    for date in ["CreationDate", "ModDate", "CreateDate", "ModifyDate"] {
        assert!(!text.contains(date), "it has a {date}");
    }
    assert!(text.contains(&drawing.title), "no title");
    // Every letter of this text is assigned to a glyph.
    let unicode: String = streams(&pdf)
        .iter()
        .map(|s| String::from_utf8_lossy(s).into_owned())
        .filter(|s| s.contains("begincmap"))
        .collect();
    for letter in "Robot 0 wants to place a new block: falls".chars() {
        let code = format!("<{:04X}>", u32::from(letter));
        assert!(unicode.to_uppercase().contains(&code), "{letter:?} cannot be searched");
    }
}

#[test]
fn a_pdf_without_a_width_has_three_quarters_of_a_point_per_pixel() {
    let drawing = Drawing {
        width: 400.0,
        height: 100.0,
        title: String::new(),
        description: String::new(),
        background: None,
        items: Vec::new(),
    };
    let pdf = pdf::write(&drawing, None).expect("a page");
    let text: String = String::from_utf8_lossy(&pdf).split_whitespace().collect();
    assert!(text.contains("/MediaBox[0030075]"));
    for width in [0.0, -5.0, 1e6, f64::NAN] {
        let refused = pdf::write(&drawing, Some(width)).expect_err("no page");
        assert!(refused.to_string().contains("2 to 5080 mm"), "{refused}");
    }
}

#[test]
fn unusual_drawings_become_pdf() {
    for drawing in [hostile(), figure::shapes(&drystone::drawing::Theme::thesis())] {
        assert!(pdf::write(&drawing, None).is_ok());
    }
}

#[test]
fn a_png_for_print_states_its_size_and_a_transparent_page_stays_transparent() {
    let drawing = figure("thesis/figure-8-left");
    let print = png::Size::Print { width_mm: 84.0, dpi: 300.0 };
    let png = png::render(&svg::write(&drawing), print).expect("a picture");
    // 84 mm at 300 pixels per inch; 11 811 pixels per metre.
    assert_eq!(png[16..20], 992_u32.to_be_bytes());
    let place = png.windows(4).position(|w| w == b"pHYs").expect("a size");
    let per_metre = 11_811_u32.to_be_bytes();
    assert_eq!(png[place + 4..place + 12], [per_metre, per_metre].concat());

    let clear = Drawing { background: None, ..drawing.clone() };
    let coloured = Drawing { background: Some(Colour::hex(0xf4f1ea)), ..drawing };
    let corner = |drawing: &Drawing| {
        let svg = svg::write(drawing);
        let (data, channels) = pixels(&png::render(&svg, print).expect("a picture"));
        data[..channels].to_vec()
    };
    assert_eq!(corner(&clear), [0, 0, 0, 0]);
    assert_eq!(corner(&coloured), [0xf4, 0xf1, 0xea]);
}

#[test]
fn a_figure_of_twenty_blocks_is_small() {
    let wall = crate::structure::wall(4, 4);
    let blocks = wall["blocks"].as_array().expect("blocks").len();
    let arch = crate::structure::arch(20, 0.3, 0.7);
    for (name, file) in [("wall", wall), ("arch", arch)] {
        let svg = svg::write(&drawn(&crate::structure::scene(&file)));
        let png = png::render(&svg, png::Size::Width(800)).expect("a picture");
        assert!(blocks >= 18 && svg.len() < 50_000, "{name}: SVG of {} bytes", svg.len());
        assert!(png.len() < 60_000, "{name}: PNG of {} bytes", png.len());
    }
}
