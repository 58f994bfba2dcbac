//! Reads and writes style files. A style file is a JSON or TOML file that describes a theme, or how a theme differs
//! from another theme.
//!
//! The keys are the names of the fields of [`Theme`]. The key `theme` names the theme that the file changes. All keys
//! are optional. All problems are reported at once.

mod reading;
mod value;

use core::fmt;

use super::super::colour::Colour;
use super::super::ramp;
use super::{Sizes, Theme, Widths};
use reading::ThemeReader;
use value::Value;

/// The format of a style file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Notation {
    /// JSON.
    Json,
    /// TOML.
    #[cfg(feature = "toml")]
    Toml,
}

/// A problem of a style file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct StyleProblem {
    /// The path to the value, such as `widths.force` or `arrows[2]`; empty for the file as a whole.
    pub path: String,
    /// What is wrong.
    pub message: String,
    /// What is expected; empty if the message says it.
    pub help: String,
}

/// All problems of a style file, in the order of the file; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StyleProblems(pub Vec<StyleProblem>);

impl Theme {
    /// Reads the theme that a style file describes. Values that are not in the file come from the theme `base`. If
    /// `base` is `None`, they come from the theme that the file names, or from the default theme if the file names
    /// none.
    ///
    /// # Errors
    /// Returns all problems of the file.
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
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let value = match notation {
            Notation::Json => value::json(text),
            #[cfg(feature = "toml")]
            Notation::Toml => value::toml(text),
        };
        let value = value.map_err(|problem| StyleProblems(vec![problem]))?;
        let mut reading = ThemeReader::default();
        let Value::Table(entries) = value else {
            reading.note("", format!("{} is not a style", value.stated()), "give a table of keys and values".into());
            return Err(StyleProblems(reading.problems));
        };
        let named = reading.base(&entries);
        let mut theme = base.cloned().or(named).unwrap_or_default();
        reading.theme(&entries, &mut theme);
        if reading.problems.is_empty() { Ok(theme) } else { Err(StyleProblems(reading.problems)) }
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

impl fmt::Display for StyleProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.message)?;
        if !self.help.is_empty() {
            write!(f, "\n  help: {}", self.help)?;
        }
        Ok(())
    }
}

impl fmt::Display for StyleProblems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, problem) in self.0.iter().enumerate() {
            if number > 0 {
                f.write_str("\n")?;
            }
            problem.fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for StyleProblems {}
