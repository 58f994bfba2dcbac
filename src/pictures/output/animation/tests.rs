use super::*;

fn step(x: u32, seconds: f64) -> Step {
    let svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='40'>\
         <rect width='60' height='40' fill='#ffffff'/>\
         <rect x='{x}' y='10' width='10' height='10' fill='#204060'/></svg>"
    );
    Step { svg, seconds }
}

/// Returns the pictures of a GIF as a viewer shows them, each with its duration in hundredths of a second.
fn shown(gif: &[u8]) -> Vec<(Vec<[u8; 3]>, u16)> {
    let mut decoder = ::gif::DecodeOptions::new();
    decoder.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = decoder.read_info(gif).expect("a GIF");
    let width = usize::from(decoder.width());
    let mut page = vec![[0; 3]; width * usize::from(decoder.height())];
    let mut pictures = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        let across = usize::from(frame.width);
        for (number, pixel) in frame.buffer.as_chunks::<4>().0.iter().enumerate() {
            let x = usize::from(frame.left) + number % across;
            let y = usize::from(frame.top) + number / across;
            if pixel[3] > 0 {
                page[y * width + x] = [pixel[0], pixel[1], pixel[2]];
            }
        }
        pictures.push((page.clone(), frame.delay));
    }
    pictures
}

#[test]
fn a_gif_shows_every_picture_for_its_time() {
    let steps = [step(0, 0.5), step(5, 0.25), step(5, 0.25), step(20, 1.0)];
    let bytes = gif(&steps, Size::Natural, &Fonts::default()).expect("drawn");
    let pictures = shown(&bytes);
    let delays: Vec<u16> = pictures.iter().map(|(_, delay)| *delay).collect();
    assert_eq!(delays, [50, 50, 100], "equal consecutive pictures are merged");
    for ((picture, _), x) in pictures.iter().zip([0, 5, 20]) {
        assert_eq!(picture[15 * 60 + x], [0x20, 0x40, 0x60]);
        assert_eq!(picture[15 * 60 + x + 10], [0xff; 3]);
        assert_eq!(picture[5 * 60 + x], [0xff; 3]);
    }
}

#[test]
fn an_animated_png_begins_with_its_first_picture_and_counts_all() {
    let steps = [step(0, 0.5), step(30, 1.0)];
    let bytes = apng(&steps, Size::Natural, &Fonts::default()).expect("drawn");
    let at = bytes.windows(4).position(|w| w == b"acTL");
    let at = at.expect("it is animated");
    assert_eq!(bytes[at + 4..at + 8], 2_u32.to_be_bytes());
    let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes));
    reader.set_transformations(::png::Transformations::EXPAND);
    let mut reader = reader.read_info().expect("a PNG");
    let mut buffer = vec![0; reader.output_buffer_size().expect("small")];
    reader.next_frame(&mut buffer).expect("a picture");
    let pixel = &buffer[4 * (15 * 60 + 5)..][..4];
    assert_eq!(pixel, [0x20, 0x40, 0x60, 0xff]);
}

#[test]
fn animations_that_cannot_be_shown_are_refused_with_a_reason() {
    let fonts = Fonts::default();
    let refused = |steps: &[Step]| gif(steps, Size::Natural, &fonts).expect_err("refused").to_string();
    assert!(refused(&[]).contains("nothing to show"));
    assert!(refused(&[step(0, 0.0)]).contains("0.01 to 600 seconds"));
    let clear = Step { svg: "<svg xmlns='http://www.w3.org/2000/svg' width='6' height='4'/>".to_owned(), seconds: 1.0 };
    assert!(refused(&[clear]).contains("transparent"));
}

#[test]
fn many_colours_are_reduced_to_similar_ones() {
    let squares: String = (0..900)
        .map(|n| {
            let (x, y) = (n % 30, n / 30);
            let (red, green) = (x * 8, y * 8);
            format!("<rect x='{x}' y='{y}' width='1' height='1' fill='rgb({red},{green},90)'/>")
        })
        .collect();
    let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' width='30' height='30'>{squares}</svg>");
    let bytes = gif(&[Step { svg, seconds: 1.0 }], Size::Natural, &Fonts::default());
    let pictures = shown(&bytes.expect("drawn"));
    for (number, pixel) in pictures[0].0.iter().enumerate() {
        let wanted = [(number % 30 * 8) as u8, (number / 30 * 8) as u8, 90];
        let off = pixel.iter().zip(wanted).map(|(a, b)| a.abs_diff(b)).max();
        assert!(off.is_some_and(|off| off <= 64), "{pixel:?} for {wanted:?}");
    }
}
