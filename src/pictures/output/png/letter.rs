//! [`lines`]: words as the letters they consist of, each set once and then known.
//!
//! resvg sets the words, kerning and all. What it found is kept, since pictures of many structures say the same few words.
//! The outlines of letters are kept too, in units of their fonts, so that a letter is put in its place in one step, as
//! resvg does it, and falls on the same pixels.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};

use resvg::tiny_skia::{Path, PathBuilder, PathSegment, Point};
use resvg::usvg;

use crate::drawing::text::{Pull, outline};
use crate::drawing::{Anchor, Colour, Drawing, Face, PagePoint, Text};
use crate::output::fonts::Fonts;
use crate::output::{svg, tree};

/// A line of words whose place is the origin.
#[derive(Default)]
pub(super) struct Line {
    letters: Vec<Letter>,
}

struct Letter {
    outline: Arc<Path>,
    /// Pixels per unit of the font.
    scale: f32,
    /// Where it begins.
    at: (f32, f32),
}

impl Line {
    /// The letters of the line where its place is (x, y); `None` where they leave no ink.
    pub fn outline(&self, x: f32, y: f32) -> Option<Path> {
        let sum = |count: fn(&Path) -> usize| self.letters.iter().map(|l| count(&l.outline)).sum();
        let mut all = PathBuilder::with_capacity(sum(Path::len), sum(|path| path.points().len()));
        for Letter { outline, scale, at } in &self.letters {
            let (x, y) = (x + at.0, y + at.1);
            // The y of fonts is up.
            let put = |p: Point| (p.x * scale + x, p.y * -scale + y);
            for segment in outline.segments() {
                match segment {
                    PathSegment::MoveTo(p) => {
                        let (x, y) = put(p);
                        all.move_to(x, y);
                    }
                    PathSegment::LineTo(p) => {
                        let (x, y) = put(p);
                        all.line_to(x, y);
                    }
                    PathSegment::QuadTo(a, p) => {
                        let ((a, b), (x, y)) = (put(a), put(p));
                        all.quad_to(a, b, x, y);
                    }
                    PathSegment::CubicTo(a, c, p) => {
                        let ((a, b), (c, d), (x, y)) = (put(a), put(c), put(p));
                        all.cubic_to(a, b, c, d, x, y);
                    }
                    PathSegment::Close => all.close(),
                }
            }
        }
        all.finish()
    }
}

/// Lines and letters that were set before.
#[derive(Default)]
struct Known {
    /// By face, size and end: words alike in these look alike wherever they stand.
    lines: HashMap<Setting, HashMap<String, Arc<Line>>>,
    count: usize,
    letters: HashMap<(Face, u16), Option<Arc<Path>>>,
}

type Setting = (Face, u64, Anchor);

fn setting(text: &Text) -> Setting {
    (text.face, text.size.to_bits(), text.anchor)
}

/// So many lines are kept, some megabytes at most.
const MOST_KEPT: usize = 4096;

static KNOWN: LazyLock<Mutex<Known>> = LazyLock::new(Mutex::default);

fn known() -> MutexGuard<'static, Known> {
    // It is sound at every moment, whoever held it last.
    KNOWN.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Known {
    fn line(&self, text: &Text) -> Option<Arc<Line>> {
        let line = self.lines.get(&setting(text))?.get(&text.words);
        line.map(Arc::clone)
    }

    fn keep(&mut self, text: &Text, line: Arc<Line>) {
        if self.count >= MOST_KEPT {
            self.lines.clear();
            self.count = 0;
        }
        let alike = self.lines.entry(setting(text)).or_default();
        if alike.insert(text.words.clone(), line).is_none() {
            self.count += 1;
        }
    }

    fn letter(&mut self, face: Face, glyph: u16) -> Option<Arc<Path>> {
        let letter = self.letters.entry((face, glyph));
        letter
            .or_insert_with(|| drawn(face, glyph).map(Arc::new))
            .clone()
    }
}

/// The lines of some texts, in their order.
///
/// # Errors
/// What resvg has against their words.
pub(super) fn lines(texts: &[&Text]) -> Result<Vec<Arc<Line>>, String> {
    let mut lines: Vec<Option<Arc<Line>>> = {
        let known = known();
        texts.iter().map(|text| known.line(text)).collect()
    };
    let unknown = texts.iter().zip(&lines).filter(|(_, line)| line.is_none());
    let mut seen = HashSet::new();
    let new: Vec<&Text> = unknown
        .map(|(text, _)| *text)
        .filter(|text| seen.insert((setting(text), text.words.as_str())))
        .collect();
    if !new.is_empty() {
        let set = set(&new)?;
        let mut known = known();
        let mut found = HashMap::new();
        for (text, line) in new.into_iter().zip(set) {
            known.keep(text, Arc::clone(&line));
            found.insert((setting(text), text.words.as_str()), line);
        }
        for (text, line) in texts.iter().zip(&mut lines) {
            if line.is_none() {
                *line = found
                    .get(&(setting(text), text.words.as_str()))
                    .map(Arc::clone);
            }
        }
    }
    Ok(lines.into_iter().map(Option::unwrap_or_default).collect())
}

/// Texts set by resvg, their places at the origin.
fn set(texts: &[&Text]) -> Result<Vec<Arc<Line>>, String> {
    let plain = |text: &&Text| {
        let origin = PagePoint::new(0.0, 0.0);
        let text = Text::new(origin, &text.words, text.face, text.size, Colour::BLACK)
            .anchored(text.anchor);
        text.into()
    };
    let page = Drawing {
        width: 1.0,
        height: 1.0,
        items: texts.iter().map(plain).collect(),
        ..Drawing::default()
    };
    let tree = tree::read(&svg::numbered(&page), &Fonts::default())?;
    let mut lines: Vec<Arc<Line>> = Vec::new();
    lines.resize_with(texts.len(), Arc::default);
    let mut known = known();
    for text in tree::texts(tree.root()) {
        // The first is `t1`. Words without ink are not in the tree.
        let number = text
            .id()
            .strip_prefix('t')
            .and_then(|n| n.parse::<usize>().ok());
        if let Some(line) = number.and_then(|n| lines.get_mut(n - 1)) {
            *line = Arc::new(line_of(text, &mut known));
        }
    }
    Ok(lines)
}

fn line_of(text: &usvg::Text, known: &mut Known) -> Line {
    let glyphs = text
        .layouted()
        .iter()
        .flat_map(|span| &span.positioned_glyphs);
    let letters = glyphs.filter_map(|glyph| {
        let put = glyph.transform();
        let id = u16::try_from(glyph.id.0).ok()?;
        Some(Letter {
            outline: known.letter(tree::face(glyph.font)?, id)?,
            scale: put.sx,
            at: (put.tx, put.ty),
        })
    });
    Line {
        letters: letters.collect(),
    }
}

/// The outline of a letter in units of its font, y up.
fn drawn(face: Face, glyph: u16) -> Option<Path> {
    let mut path = PathBuilder::new();
    outline(face, glyph, |pull| match pull {
        Pull::Move([x, y]) => path.move_to(x, y),
        Pull::Line([x, y]) => path.line_to(x, y),
        Pull::Quad([a, b], [x, y]) => path.quad_to(a, b, x, y),
        Pull::Cubic([a, b], [c, d], [x, y]) => path.cubic_to(a, b, c, d, x, y),
        Pull::Close => path.close(),
    });
    path.finish()
}
