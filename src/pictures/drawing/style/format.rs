//! Reads and writes style files. A style file is a JSON or TOML file that describes a theme, or how a theme differs
//! from another theme.
//!
//! The keys are the names of the fields of [`Theme`]. The key `theme` names the theme that the file changes. All keys
//! are optional. All problems are reported at once.

use super::super::colour::Colour;
use super::super::ramp;
use super::{ForceMarks, Sizes, Theme, Widths};
use crate::read::{Cause, Dialect, Expected, Node, NodeKind, Read, Reader, Trail, from_text};

pub use crate::read::{Notation, Problem as StyleProblem, Problems as StyleProblems};

/// The dialect of style files.
const STYLE: Dialect = Dialect {
    lines_before: 0,
    noun: "style",
    remedy: |cause| match cause {
        Cause::NotToml => Some("correct the text here; the name of a style file in JSON must end in .json".into()),
        Cause::OtherFormat(_) => {
            Some("write JSON, which begins with `{`; the name of a style file in TOML must end in .toml".into())
        }
        _ => None,
    },
};

impl Theme {
    /// Reads the theme that a style file describes. Values that are not in the file come from the theme `base`. If
    /// `base` is `None`, they come from the theme that the file names, or from the default theme if the file names
    /// none.
    ///
    /// # Errors
    /// Returns all problems of the file, each with its line, column and path.
    ///
    /// # Example
    /// ```
    /// use drystone::drawing::{Colour, Theme, style::format::Notation};
    /// let file = "theme = 'dark'\nfailure = '#d00'\n[widths]\nforce = 0.06";
    /// let theme = Theme::read(file, Notation::Toml, None)?;
    /// assert_eq!((theme.page, theme.failure), (Theme::dark().page, Colour::hex(0xdd0000)));
    ///
    /// let problems = Theme::read(r#"{ "failur": "red" }"#, Notation::Json, None).unwrap_err();
    /// assert!(problems.to_string().contains("the nearest known key is `failure`"));
    /// # Ok::<(), drystone::drawing::style::format::StyleProblems>(())
    /// ```
    pub fn read(text: &str, notation: Notation, base: Option<&Theme>) -> Result<Theme, StyleProblems> {
        from_text(text, notation, &STYLE, |r, node, at| theme(r, node, at, base))
    }

    /// Writes the whole theme as a style file in JSON. Reading this file gives the same theme.
    ///
    /// ```
    /// use drystone::drawing::{Theme, style::format::Notation};
    /// let dark = Theme::dark();
    /// assert_eq!(Theme::read(&dark.to_json(), Notation::Json, None).as_ref(), Ok(&dark));
    /// ```
    pub fn to_json(&self) -> String {
        let mut theme = self.clone();
        let list = |colours: &[Colour]| {
            let colours: Vec<String> = colours.iter().map(|c| format!("\"{}\"", c.css())).collect();
            format!("[{}]", colours.join(", "))
        };
        let mut lines = Vec::new();
        if let Some(name) = Theme::NAMES.iter().find(|name| Theme::named(name).as_ref() == Some(self)) {
            lines.push(format!("  \"theme\": \"{name}\""));
        }
        for (key, field) in COLOUR_FIELDS {
            lines.push(format!("  \"{key}\": \"{}\"", field(&mut theme).css()));
        }
        for (key, field) in LIST_FIELDS {
            lines.push(format!("  \"{key}\": {}", list(field(&mut theme))));
        }
        lines.push(format!("  \"{FORCES_KEY}\": \"{}\"", self.forces.name()));
        let known = ramp::NAMES.iter().find(|name| ramp::named(name).as_ref() == Some(&self.amplitudes));
        let amplitudes = match known {
            Some(name) => format!("\"{name}\""),
            None => list(&stops(&self.amplitudes)),
        };
        lines.push(format!("  \"{AMPLITUDES_KEY}\": {amplitudes}"));
        let widths = WIDTH_FIELDS.map(|(key, field, ..)| format!("\"{key}\": {}", field(&mut theme.widths)));
        lines.push(format!("  \"widths\": {{ {} }}", widths.join(", ")));
        let sizes = SIZE_FIELDS.map(|(key, field)| format!("\"{key}\": {}", field(&mut theme.sizes)));
        lines.push(format!("  \"sizes\": {{ {} }}", sizes.join(", ")));
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}

/// A field of [`Theme`] that is a colour: its key and the field.
type ColourField = (&'static str, fn(&mut Theme) -> &mut Colour);

const COLOUR_FIELDS: [ColourField; 15] = [
    ("page", |t| &mut t.page),
    ("ink", |t| &mut t.ink),
    ("faint", |t| &mut t.faint),
    ("rule", |t| &mut t.rule),
    ("casing", |t| &mut t.casing),
    ("load", |t| &mut t.load),
    ("failure", |t| &mut t.failure),
    ("ground", |t| &mut t.ground),
    ("block", |t| &mut t.block),
    ("outline", |t| &mut t.outline),
    ("motion", |t| &mut t.motion),
    ("safe", |t| &mut t.safe),
    ("stands", |t| &mut t.stands),
    ("falls", |t| &mut t.falls),
    ("undecided", |t| &mut t.undecided),
];

/// A field of [`Theme`] that is a list of colours: its key and the field.
type ListField = (&'static str, fn(&mut Theme) -> &mut Vec<Colour>);

const LIST_FIELDS: [ListField; 2] = [("arrows", |t| &mut t.arrows), ("robots", |t| &mut t.robots)];

const AMPLITUDES_KEY: &str = "amplitudes";
const FORCES_KEY: &str = "forces";

/// A field of [`Widths`]: its key, the field, its least and largest value, and its unit.
type WidthField = (&'static str, fn(&mut Widths) -> &mut f64, [f64; 2], &'static str);

const WIDTH_FIELDS: [WidthField; 6] = [
    ("force", |w| &mut w.force, [0.005, 0.5], LENGTH_UNIT),
    ("robot", |w| &mut w.robot, [0.005, 0.5], LENGTH_UNIT),
    ("failure", |w| &mut w.failure, [0.005, 0.5], LENGTH_UNIT),
    ("disc", |w| &mut w.disc, [0.02, 2.0], LENGTH_UNIT),
    ("outline", |w| &mut w.outline, [0.05, 20.0], PIXEL_UNIT),
    ("casing", |w| &mut w.casing, [0.0, 20.0], PIXEL_UNIT),
];

const LENGTH_UNIT: &str = "unit lengths";
const PIXEL_UNIT: &str = "pixels";

/// A field of [`Sizes`]: its key and the field.
type SizeField = (&'static str, fn(&mut Sizes) -> &mut f64);

const SIZE_FIELDS: [SizeField; 7] = [
    ("title", |s| &mut s.title),
    ("caption", |s| &mut s.caption),
    ("verdict", |s| &mut s.verdict),
    ("reason", |s| &mut s.reason),
    ("key", |s| &mut s.key),
    ("name", |s| &mut s.name),
    ("amount", |s| &mut s.amount),
];

/// Least and largest font size. Smaller text cannot be read, and larger text leaves no space for the figure.
const FONT_SIZE_LIMITS: [f64; 2] = [8.0, 100.0];

/// Returns the shortest list of evenly spaced colours from which [`ramp::between`] gives exactly this ramp. Returns all
/// 256 colours if no shorter list does.
fn stops(ramp: &[Colour]) -> Vec<Colour> {
    // Only steps that divide 255 are possible, because the last of the 256 entries must be a stop.
    for step in [255, 85, 51, 17, 15, 5, 3] {
        let stops: Vec<Colour> = ramp.iter().step_by(step).copied().collect();
        if ramp::between(&stops) == ramp {
            return stops;
        }
    }
    ramp.to_vec()
}

/// Reads a theme. Values that the text does not give come from `base`, or else from the theme that it names.
fn theme<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>, base: Option<&Theme>) -> Option<Theme> {
    let lists = LIST_FIELDS.iter().map(|l| l.0);
    let others = ["theme", AMPLITUDES_KEY, FORCES_KEY, "widths", "sizes"];
    let keys: Vec<&str> = COLOUR_FIELDS.iter().map(|c| c.0).chain(lists).chain(others).collect();
    let fields = r.object(node, at, &keys)?;
    let named = r.optional(fields, at, "theme", |r, node, at| r.choice(node, at, &Theme::NAMES.map(|n| (n, n))));
    let mut theme = base.cloned().or(named.and_then(Theme::named)).unwrap_or_default();
    let marks = [ForceMarks::Joints, ForceMarks::Blocks, ForceMarks::Scene].map(|marks| (marks.name(), marks));
    if let Some(marks) = r.optional(fields, at, FORCES_KEY, |r, node, at| r.choice(node, at, &marks)) {
        theme.forces = marks;
    }
    for (key, field) in COLOUR_FIELDS {
        if let Some(colour) = r.optional(fields, at, key, Colour::read) {
            *field(&mut theme) = colour;
        }
    }
    for (key, field) in LIST_FIELDS {
        if let Some(list) = r.optional(fields, at, key, |r, node, at| colours(r, node, at, 1)) {
            *field(&mut theme) = list;
        }
    }
    if let Some(colours) = r.optional(fields, at, AMPLITUDES_KEY, amplitudes) {
        theme.amplitudes = colours;
    }
    let known = WIDTH_FIELDS.map(|(key, _, range, unit)| (key, range, unit));
    let widths = r.optional(fields, at, "widths", |r, node, at| numbers(r, node, at, &known)).unwrap_or_default();
    for (width, (_, field, ..)) in widths.into_iter().zip(WIDTH_FIELDS) {
        let field = field(&mut theme.widths);
        *field = width.unwrap_or(*field);
    }
    let known = SIZE_FIELDS.map(|(key, _)| (key, FONT_SIZE_LIMITS, PIXEL_UNIT));
    let sizes = r.optional(fields, at, "sizes", |r, node, at| numbers(r, node, at, &known)).unwrap_or_default();
    for (size, (_, field)) in sizes.into_iter().zip(SIZE_FIELDS) {
        let field = field(&mut theme.sizes);
        *field = size.unwrap_or(*field);
    }
    Some(theme)
}

impl Read for Colour {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Colour> {
        let colour = match &node.kind {
            NodeKind::Text(text) => Colour::from_css(text),
            _ => None,
        };
        if colour.is_none() {
            r.wrong(node, at, Expected::Other("a colour such as \"#d55e00\" or \"#d50\""));
        }
        colour
    }
}

/// Reads a list of at least `least` colours.
fn colours<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>, least: usize) -> Option<Vec<Colour>> {
    match &node.kind {
        NodeKind::List(list) if list.len() >= least => {
            let colours = r.entries(node, at, |r, node, at| Colour::read(r, node, at).map(Some))?;
            colours.into_iter().collect()
        }
        _ => {
            let expected = format!("a list of at least {least} colours, such as [\"#0072b2\", \"#56b4e9\"]");
            r.wrong(node, at, Expected::Other(&expected));
            None
        }
    }
}

fn amplitudes<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Vec<Colour>> {
    if let NodeKind::Text(_) = node.kind {
        return ramp::named(r.choice(node, at, &ramp::NAMES.map(|n| (n, n)))?);
    }
    colours(r, node, at, 2).map(|stops| ramp::between(&stops))
}

/// Reads an object of numbers. `known` lists its possible keys, each with the range and the unit of its number. Returns
/// the number of each key; `None` if the key is absent or its number is out of range.
fn numbers<'s>(
    r: &mut Reader<'s>,
    node: &'s Node<'s>,
    at: &Trail<'_>,
    known: &[(&str, [f64; 2], &str)],
) -> Option<Vec<Option<f64>>> {
    let keys: Vec<&str> = known.iter().map(|k| k.0).collect();
    let fields = r.object(node, at, &keys)?;
    let number = |&(key, range, unit): &(&str, [f64; 2], &str)| {
        let what = format!("a number of {unit}");
        r.optional(fields, at, key, |r, node, at| r.number_within(node, at, range, &what))
    };
    Some(known.iter().map(number).collect())
}
