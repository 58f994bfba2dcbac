//! Tests of numbers that are not finite, of hostile text, and of the identifiers of several figures on a page.

use super::*;

use crate::pictures::drawing::{Colour, Outline, PagePoint, PageRect, Text};

fn page(items: Vec<Item>) -> Drawing {
    Drawing { width: 40.0, height: 30.0, title: "t".into(), description: "d".into(), background: None, items }
}

#[test]
#[should_panic(expected = "every number of a drawing is finite")]
fn a_number_that_is_not_finite_is_refused() {
    write(&page(vec![Path::filled(Outline::circle(PagePoint::new(f64::NAN, 0.0), 1.0), Colour::BLACK).into()]));
}

#[test]
fn hostile_text_is_escaped() {
    let nasty = "</text><script>'\"&\u{0}\u{1b}\u{fffe}\u{1ffff}石🪨";
    let text = Text::new(PagePoint::new(0.0, 9.0), nasty, Face::Sans, 9.0, Colour::BLACK);
    let group = Group { id: Some(nasty.into()), ..Group::with_class(nasty) }.titled(nasty).with(text);
    let svg = write(&page(vec![group.into()]));
    assert!(svg.contains("&lt;/text&gt;&lt;script&gt;&#39;&quot;&amp;\u{fffd}\u{fffd}石🪨</text>"), "{svg}");
    assert!(!svg.contains("<script") && !svg.contains('\u{fffe}') && !svg.contains('\u{1b}'));
}

#[test]
fn figures_have_different_identifiers() {
    let clipped = |x: f64| {
        let clip = Some(PageRect { at: PagePoint::new(x, 0.0), width: 5.0, height: 5.0 });
        write(&page(vec![Group { id: Some("a".into()), clip, ..Group::default() }.into()]))
    };
    let (one, two) = (clipped(1.0), clipped(2.0));
    let id = |svg: &str| svg.split("clipPath id=\"").nth(1).and_then(|s| s.split('"').next()).map(str::to_owned);
    assert_ne!(id(&one), id(&two));
    assert!(one.contains(&format!("url(#{})", id(&one).expect("a clip"))));
    assert_eq!(one, clipped(1.0));
}
