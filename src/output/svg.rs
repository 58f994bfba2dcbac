//! [`write()`]: a drawing as SVG text, with what resvg and browsers understand alike and nothing else.
//!
//! Attributes stand in a fixed order and every number goes through one printer, so that the same drawing is the same
//! bytes. Names of elements begin with a mark made from the drawing's own content: several figures can share a page.

use std::fmt::Write as _;

use crate::drawing::{
    Anchor, Drawing, Group, Item, Join, Outline, PagePoint, Path, Segment, Stroke, Text,
};

/// A drawing as an SVG document.
///
/// # Panics
/// Where a number of the drawing is not finite: that is an error of ours, never of a scene.
///
/// # Example
/// ```
/// use drystone::drawing::{Colour, Drawing, Outline, PagePoint, Path};
/// let mark = Path::filled(Outline::circle(PagePoint::new(6.0, 2.5), 2.0), Colour::BLACK);
/// let drawing = Drawing {
///     width: 12.0,
///     height: 5.0,
///     title: "A dot & no more".into(),
///     description: String::new(),
///     background: None,
///     items: vec![mark.into()],
/// };
/// let svg = drystone::output::svg::write(&drawing);
/// assert!(svg.contains("viewBox=\"0 0 12 5\"") && svg.contains("A dot &amp; no more"));
/// ```
pub fn write(drawing: &Drawing) -> String {
    let mark = format!("d{:08x}", fold(&document(drawing, "")));
    document(drawing, &mark)
}

fn document(drawing: &Drawing, mark: &str) -> String {
    let mut svg = Writer {
        text: String::new(),
        mark,
        clips: 0,
    };
    let (w, h) = (number(drawing.width), number(drawing.height));
    svg.put(&format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
         role=\"graphics-document document\" aria-labelledby=\"{mark}-title {mark}-desc\">\n"
    ));
    svg.put(&format!(
        "<title id=\"{mark}-title\">{}</title>\n",
        escaped(&drawing.title)
    ));
    svg.put(&format!(
        "<desc id=\"{mark}-desc\">{}</desc>\n",
        escaped(&drawing.description)
    ));
    if let Some(colour) = drawing.background {
        svg.put(&format!(
            "<rect width=\"{w}\" height=\"{h}\" fill=\"{}\"/>\n",
            colour.css()
        ));
    }
    for item in &drawing.items {
        svg.item(item);
    }
    svg.put("</svg>\n");
    svg.text
}

struct Writer<'m> {
    text: String,
    mark: &'m str,
    clips: usize,
}

impl Writer<'_> {
    fn put(&mut self, text: &str) {
        self.text.push_str(text);
    }

    fn attribute(&mut self, name: &str, value: &str) {
        // A `String` takes every character; this cannot fail.
        let _ = write!(self.text, " {name}=\"{value}\"");
    }

    fn item(&mut self, item: &Item) {
        match item {
            Item::Path(path) => self.path(path),
            Item::Text(text) => self.words(text),
            Item::Group(group) => self.group(group),
        }
    }

    fn group(&mut self, group: &Group) {
        let mut clip = None;
        if let Some(rect) = group.clip {
            self.clips += 1;
            let id = format!("{}-clip{}", self.mark, self.clips);
            self.put(&format!(
                "<clipPath id=\"{id}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
                number(rect.at.x),
                number(rect.at.y),
                number(rect.width),
                number(rect.height)
            ));
            clip = Some(id);
        }
        self.put("<g");
        if let Some(id) = &group.id {
            let id = format!("{}-{}", self.mark, escaped(id));
            self.attribute("id", &id);
        }
        if !group.class.is_empty() {
            self.attribute("class", &escaped(&group.class));
        }
        if !group.title.is_empty() {
            // A group of titled things is for reading on into, any other is one picture.
            self.attribute(
                "role",
                if holds_titles(&group.items) {
                    "group"
                } else {
                    "img"
                },
            );
        }
        if group.echo {
            self.attribute("aria-hidden", "true");
            self.attribute("pointer-events", "none");
        }
        if let Some(id) = clip {
            self.attribute("clip-path", &format!("url(#{id})"));
        }
        if let Some(camera) = &group.camera {
            // Pixels per metre and the place of the scene's origin, in full: with them the scene can be read back.
            let origin = camera.origin();
            self.attribute("data-drystone-scale", &camera.length(1.0).to_string());
            self.attribute(
                "data-drystone-origin",
                &format!("{} {}", origin.x, origin.y),
            );
        }
        self.put(">");
        if !group.title.is_empty() {
            self.put(&format!("<title>{}</title>", escaped(&group.title)));
        }
        if !group.description.is_empty() {
            self.put(&format!("<desc>{}</desc>", escaped(&group.description)));
        }
        self.put("\n");
        for item in &group.items {
            self.item(item);
        }
        self.put("</g>\n");
    }

    fn path(&mut self, path: &Path) {
        if path.outline.segments.is_empty() {
            return;
        }
        self.put("<path");
        self.attribute("d", &steps(&path.outline));
        let fill = path.fill.map_or_else(|| "none".to_owned(), |c| c.css());
        self.attribute("fill", &fill);
        if let Some(stroke) = &path.stroke {
            self.stroke(stroke);
            if path.fill_last {
                self.attribute("paint-order", "stroke");
            }
        }
        if path.opacity < 1.0 {
            self.attribute("opacity", &number(path.opacity));
        }
        self.put("/>\n");
    }

    fn stroke(&mut self, stroke: &Stroke) {
        self.attribute("stroke", &stroke.colour.css());
        self.attribute("stroke-width", &number(stroke.width));
        if stroke.join == Join::Round {
            self.attribute("stroke-linejoin", "round");
            self.attribute("stroke-linecap", "round");
        }
        if !stroke.dash.is_empty() {
            let dash: Vec<String> = stroke.dash.iter().map(|d| number(*d)).collect();
            self.attribute("stroke-dasharray", &dash.join(" "));
        }
    }

    fn words(&mut self, text: &Text) {
        self.put("<text");
        self.attribute("x", &number(text.at.x));
        self.attribute("y", &number(text.at.y));
        match text.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.attribute("text-anchor", "middle"),
            Anchor::End => self.attribute("text-anchor", "end"),
        }
        self.attribute("font-family", text.face.families());
        self.attribute("font-size", &number(text.size));
        if text.face.weight() != 400 {
            self.attribute("font-weight", &text.face.weight().to_string());
        }
        if text.face.italic() {
            self.attribute("font-style", "italic");
        }
        self.attribute("fill", &text.fill.css());
        if let Some((colour, width)) = text.halo {
            self.stroke(&Stroke::new(colour, 2.0 * width));
            self.attribute("paint-order", "stroke");
        }
        self.put(">");
        let words = escaped(&text.words);
        self.put(&words);
        self.put("</text>\n");
    }
}

fn holds_titles(items: &[Item]) -> bool {
    items
        .iter()
        .any(|item| matches!(item, Item::Group(g) if !g.title.is_empty() || holds_titles(&g.items)))
}

fn steps(outline: &Outline) -> String {
    let mut d = String::new();
    let mut put = |letter: char, points: &[PagePoint]| {
        d.push(letter);
        for (i, p) in points.iter().enumerate() {
            if i > 0 {
                d.push(' ');
            }
            d.push_str(&number(p.x));
            d.push(' ');
            d.push_str(&number(p.y));
        }
    };
    for segment in &outline.segments {
        match *segment {
            Segment::Move(p) => put('M', &[p]),
            Segment::Line(p) => put('L', &[p]),
            Segment::Curve(a, b, c) => put('C', &[a, b, c]),
            Segment::Close => put('Z', &[]),
        }
    }
    d
}

/// The one number printer: at most two decimals, a hundredth of a pixel, no needless zero, no −0.
///
/// # Panics
/// For a number that is not finite.
fn number(value: f64) -> String {
    assert!(
        value.is_finite(),
        "a drawing holds the number {value}; every number of a drawing is finite"
    );
    let mut text = format!("{value:.2}");
    let kept = text.trim_end_matches('0').trim_end_matches('.').len();
    text.truncate(kept);
    if text == "-0" { "0".to_owned() } else { text }
}

/// Text as XML holds it: marks replaced, and the code points that XML forbids left out.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t'
            | '\n'
            | '\r'
            | ' '..='\u{7e}'
            | '\u{a0}'..='\u{fdcf}'
            | '\u{fdf0}'..='\u{fffd}' => out.push(c),
            // Above the first plane the last two code points of each plane are no characters.
            '\u{10000}'.. if u32::from(c) & 0xfffe != 0xfffe => out.push(c),
            _ => {}
        }
    }
    out
}

/// 32 bits that differ for different texts, as a rule (FNV-1a, the two halves folded).
fn fold(text: &str) -> u32 {
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
    });
    (hash ^ (hash >> 32)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Colour, Face, PageRect};

    fn page(items: Vec<Item>) -> Drawing {
        Drawing {
            width: 40.0,
            height: 30.0,
            title: "t".into(),
            description: "d".into(),
            background: None,
            items,
        }
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (-0.004, "0"),
            (1.5, "1.5"),
            (-2.25, "-2.25"),
            (100.0, "100"),
            (1.0 / 3.0, "0.33"),
        ];
        for (value, expected) in cases {
            assert_eq!(number(value), expected);
        }
    }

    #[test]
    #[should_panic(expected = "every number of a drawing is finite")]
    fn a_number_that_is_none_is_refused() {
        write(&page(vec![
            Path::filled(
                Outline::circle(PagePoint::new(f64::NAN, 0.0), 1.0),
                Colour::BLACK,
            )
            .into(),
        ]));
    }

    #[test]
    fn hostile_words_stay_words() {
        let nasty = "</text><script>'\"&\u{0}\u{1b}\u{fffe}\u{1ffff}石🪨";
        let text = Text::new(
            PagePoint::new(0.0, 9.0),
            nasty,
            Face::Sans,
            9.0,
            Colour::BLACK,
        );
        let group = Group {
            id: Some(nasty.into()),
            ..Group::of_class(nasty)
        }
        .titled(nasty)
        .with(text);
        let svg = write(&page(vec![group.into()]));
        assert!(
            svg.contains("&lt;/text&gt;&lt;script&gt;&#39;&quot;&amp;石🪨</text>"),
            "{svg}"
        );
        assert!(!svg.contains("<script") && !svg.contains('\u{fffe}') && !svg.contains('\u{1b}'));
    }

    #[test]
    fn names_carry_the_mark_of_their_figure() {
        let clipped = |x: f64| {
            let clip = Some(PageRect {
                at: PagePoint::new(x, 0.0),
                width: 5.0,
                height: 5.0,
            });
            write(&page(vec![
                Group {
                    id: Some("a".into()),
                    clip,
                    ..Group::default()
                }
                .into(),
            ]))
        };
        let (one, two) = (clipped(1.0), clipped(2.0));
        let id = |svg: &str| {
            svg.split("clipPath id=\"")
                .nth(1)
                .and_then(|s| s.split('"').next())
                .map(str::to_owned)
        };
        assert_ne!(id(&one), id(&two));
        assert!(one.contains(&format!("url(#{})", id(&one).expect("a clip"))));
        assert_eq!(one, clipped(1.0));
    }
}
