//! SVG files with costly entities, attributes, style rules and clip paths.

use super::{run, run_within, svg};

/// The time of the parser of XML and of the style rules may grow with the square of a file. Such files are refused unread.
#[test]
fn costly_xml_and_styles() {
    let refused = |name: &str, text: String, words: &str| {
        let ran = run_within(700_000, name, &text, &format!("import {name}"));
        let start: String = ran.messages.chars().take(400).collect();
        assert!(ran.code == Some(2) && ran.messages.contains(words), "{name}: {:?} {start}", ran.code);
    };
    let entity = |value: &str, body: &str| format!(r#"<!DOCTYPE s [<!ENTITY x "{value}">]>{}"#, svg(body));
    let uses = format!("<text>{}</text>", "&x;".repeat(90_000));
    refused("entity.svg", entity(&"A".repeat(400_000), &uses), "its entities may expand to 36000000000 bytes");
    refused("nested.svg", entity("&y;", &uses), "an entity contains elements or other entities");
    let attributes: String = (0..60_000).map(|i| format!("a{i}=\"1\" ")).collect();
    refused("attributes.svg", svg(&format!("<rect {attributes}/>")), "too many attributes");
    let rules: String = (0..20_000).map(|i| format!(".c{i}{{fill:red}}")).collect();
    let classes: String = (0..20_000).map(|i| format!("c{i} ")).collect();
    let rects = r#"<rect width="3" height="3"/>"#.repeat(5_000);
    let body = format!(r#"<style>{rules}</style><rect class="{classes}"/>{rects}"#);
    refused("rules.svg", svg(&body), "20000 style rules are too many");
    let body = format!("<style>{}</style>{}", "*{fill:red}".repeat(80_000), &rects[..2_800]);
    refused("all.svg", svg(&body), "80000 style rules are too many");
    let corners: String = (0..3_000)
        .map(|k| {
            let (sin, cos) = libm::sincos(2.4 * f64::from(k));
            format!("{:.1},{:.1} ", 500.0 + 499.0 * cos, 500.0 + 499.0 * sin)
        })
        .collect();
    let clip = format!(r#"<clipPath id="c"><polygon points="{corners}"/></clipPath>"#);
    let rect = |i: usize, clip: &str| {
        format!(r#"<rect {clip} x="{}" y="{}" width="14" height="14"/>"#, i % 70 * 14, i / 70 * 14)
    };
    let each: String = (0..4_900).map(|i| rect(i, r#"clip-path="url(#c)""#)).collect();
    refused("clip.svg", svg(&(clip.clone() + &each)), "its clip paths have more than 500000 corners");
    let all: String = (0..4_900).map(|i| rect(i, "")).collect();
    let body = format!(r#"{clip}<g clip-path="url(#c)">{all}</g>"#);
    refused("group.svg", svg(&body), "its clip paths have more than 500000 corners");
    // What programs write is read: entities for names of namespaces, apostrophes in comments, a quotation mark in text.
    let body = r#"<!-- don't --><desc>a "quote and 5 > 3</desc><rect id="a" width="3" height="3"/>"#;
    let ran = run("fine.svg", &entity("http://www.w3.org/2000/svg", body), "import fine.svg");
    assert_eq!(ran.code, Some(0), "{}", ran.messages);
}
