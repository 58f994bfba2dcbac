//! [`write()`] writes a drawing as a TikZ picture for LaTeX documents. LaTeX sets the text of the picture in the fonts
//! of the document.
//!
//! The picture only needs the package `tikz`. Halos of text are left out. Include the file with `\input`.

use std::fmt::Write as _;

use super::{MM_PER_INCH, PIXELS_PER_INCH};
use crate::pictures::drawing::{
    Anchor, Colour, Drawing, Face, Group, Item, Join, Outline, PagePoint, Path, Segment, Stroke, Text,
};
use crate::text::is_hidden;

/// PostScript points per inch; TeX calls them big points (`bp`).
const BIG_POINTS_PER_INCH: f64 = 72.0;

/// Writes a drawing as a `tikzpicture`. `width_mm` is its width in millimetres. If it is `None`, one pixel is 1/96
/// inch.
///
/// # Panics
/// Panics if a number of the drawing is not finite. No valid scene causes this.
///
/// # Example
/// ```
/// use drystone::drawing::{Colour, Drawing, Face, PagePoint, Text};
/// let words = Text::new(PagePoint::new(5.0, 20.0), "50 % & more", Face::Serif, 12.0, Colour::BLACK);
/// let drawing = Drawing { width: 120.0, height: 30.0, title: "A word".into(), description: String::new(),
///     background: None, items: vec![words.into()] };
/// let tikz = drystone::output::tikz::write(&drawing, None);
/// assert!(tikz.contains(r"\begin{tikzpicture}") && tikz.contains(r"50 \% \& more"));
/// ```
pub fn write(drawing: &Drawing, width_mm: Option<f64>) -> String {
    let unit = match width_mm {
        Some(mm) => mm / drawing.width * BIG_POINTS_PER_INCH / MM_PER_INCH,
        None => BIG_POINTS_PER_INCH / PIXELS_PER_INCH,
    };
    let mut pen = TikzWriter { text: String::new(), unit };
    pen.line(&format!("% {}", comment(&drawing.title)));
    pen.line(&format!("\\begin{{tikzpicture}}[x={u}bp,y=-{u}bp,line join=round,line cap=round]", u = number(unit)));
    let (w, h) = (number(drawing.width), number(drawing.height));
    match drawing.background {
        Some(page) => pen.line(&format!("\\fill[{}] (0,0) rectangle ({w},{h});", fill(page))),
        None => pen.line(&format!("\\path (0,0) rectangle ({w},{h});")),
    }
    pen.items(&drawing.items);
    pen.line("\\end{tikzpicture}");
    pen.text
}

struct TikzWriter {
    text: String,
    /// Big points per pixel.
    unit: f64,
}

impl TikzWriter {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn items(&mut self, items: &[Item]) {
        for item in items {
            match item {
                Item::Path(path) => self.path(path),
                Item::Text(text) => self.words(text),
                Item::Group(group) => self.group(group),
            }
        }
    }

    fn group(&mut self, group: &Group) {
        let Some(clip) = group.clip else {
            self.items(&group.items);
            return;
        };
        let end = clip.at.moved(clip.width, clip.height);
        self.line("\\begin{scope}");
        self.line(&format!("\\clip {} rectangle {};", place(clip.at), place(end)));
        self.items(&group.items);
        self.line("\\end{scope}");
    }

    fn path(&mut self, path: &Path) {
        if path.outline.segments.is_empty() {
            return;
        }
        let steps = steps(&path.outline);
        let opacity = if path.opacity < 1.0 { format!(",opacity={}", number(path.opacity)) } else { String::new() };
        let filled = path.fill.map(|c| format!("\\fill[{}{opacity}] {steps};", fill(c)));
        let drawn = path.stroke.as_ref().filter(|s| s.width > 0.0);
        let drawn = drawn.map(|s| format!("\\draw[{}{opacity}] {steps};", self.stroke(s)));
        let mut passes = [filled, drawn];
        if path.fill_last {
            passes.reverse();
        }
        for pass in passes.into_iter().flatten() {
            self.line(&pass);
        }
    }

    fn stroke(&self, stroke: &Stroke) -> String {
        let mut stated = format!("draw={},line width={}bp", colour(stroke.colour), number(stroke.width * self.unit));
        if stroke.join == Join::Miter {
            stated.push_str(",line join=miter,line cap=butt");
        }
        if !stroke.dash.is_empty() {
            stated.push_str(",dash pattern=");
            for (i, length) in stroke.dash.iter().enumerate() {
                let what = if i % 2 == 0 { "on" } else { "off" };
                // Writing to a `String` cannot fail.
                let _ = write!(stated, "{what} {}bp ", number(length * self.unit));
            }
        }
        stated
    }

    fn words(&mut self, text: &Text) {
        let anchor = match text.anchor {
            Anchor::Start => "base west",
            Anchor::Middle => "base",
            Anchor::End => "base east",
        };
        let face = match text.face {
            Face::Serif => "",
            Face::SerifItalic => "\\itshape",
            Face::SerifBold => "\\bfseries",
            Face::Sans => "\\sffamily",
            Face::SansBold => "\\sffamily\\bfseries",
        };
        let size = text.size * self.unit;
        self.line(&format!(
            "\\node[anchor={anchor},inner sep=0pt,text={},font=\\fontsize{{{}bp}}{{{}bp}}\\selectfont{face}] at {} {{{}}};",
            colour(text.fill),
            number(size),
            number(1.2 * size),
            place(text.at),
            escaped(&text.words)
        ));
    }
}

fn colour(Colour([r, g, b]): Colour) -> String {
    format!("{{rgb,255:red,{r};green,{g};blue,{b}}}")
}

fn fill(of: Colour) -> String {
    format!("fill={}", colour(of))
}

fn place(p: PagePoint) -> String {
    format!("({},{})", number(p.x), number(p.y))
}

fn steps(outline: &Outline) -> String {
    let mut steps = String::new();
    for segment in &outline.segments {
        let step = match *segment {
            Segment::Move(p) => place(p),
            Segment::Line(p) => format!("--{}", place(p)),
            Segment::Curve(a, b, c) => {
                format!("..controls{}and{}..{}", place(a), place(b), place(c))
            }
            Segment::Close => "--cycle".to_owned(),
        };
        steps.push_str(&step);
    }
    steps
}

/// Formats a number with at most three decimals and without an exponent, which TeX cannot read.
fn number(value: f64) -> String {
    crate::text::decimals(value, 3)
}

/// Replaces control characters, such as line breaks and changes of the writing direction, by spaces, so that the text
/// fits in a one-line comment.
fn comment(text: &str) -> String {
    text.chars().map(|c| if is_hidden(c) { ' ' } else { c }).collect()
}

/// Escapes text for LaTeX. Letters of other scripts are not changed, except μ, which becomes `$\mu$`.
fn escaped(words: &str) -> String {
    let mut out = String::with_capacity(words.len());
    for c in comment(words).chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => {
                out.push('\\');
                out.push(c);
            }
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '|' => out.push_str("\\textbar{}"),
            // Also without the font encoding T1, which \\textquotedbl needs.
            '"' => out.push_str("\\char34{}"),
            '\u{a0}' => out.push('~'),
            '−' => out.push_str("$-$"),
            '·' => out.push_str("$\\cdot$"),
            '×' => out.push_str("$\\times$"),
            '°' => out.push_str("$^{\\circ}$"),
            'µ' | 'μ' => out.push_str("$\\mu$"),
            '≤' => out.push_str("$\\leq$"),
            '≥' => out.push_str("$\\geq$"),
            '…' => out.push_str("\\ldots{}"),
            '–' => out.push_str("--"),
            '—' => out.push_str("---"),
            '⁻' => out.push_str("$^{-}$"),
            '⁰'..='⁹' | '¹' | '²' | '³' => match "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c) {
                Some(digit) => {
                    let _ = write!(out, "$^{{{digit}}}$");
                }
                None => out.push(c),
            },
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_text_is_escaped_and_braces_are_balanced() {
        let nasty = "\\input{/etc/passwd} 50 % of #1 $x_2^3$ & ~ {{ } |<>\" 2×10⁻³ N·m\u{7}\n";
        let escaped = escaped(nasty);
        assert!(escaped.contains("\\textgreater{}\\char34{} 2"), "{escaped}");
        assert!(!escaped.contains("\\input") && !escaped.contains('\n'));
        let mut depth = 0;
        let mut before = ' ';
        for c in escaped.chars() {
            match c {
                '{' if before != '\\' => depth += 1,
                '}' if before != '\\' => depth -= 1,
                _ => {}
            }
            assert!(depth >= 0);
            before = c;
        }
        assert_eq!(depth, 0, "{escaped}");
        assert!(escaped.contains("$\\times$10$^{-}$$^{3}$ N$\\cdot$m"), "{escaped}");
    }

    #[test]
    fn numbers_have_no_exponent_and_no_minus_zero() {
        assert_eq!(number(1e-9), "0");
        assert_eq!(number(-1e-9), "0");
        assert_eq!(number(123456.7891), "123456.789");
    }
}
