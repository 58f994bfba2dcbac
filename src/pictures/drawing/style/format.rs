//! Style files: a theme, or what is to differ from one, as a person writes it down in JSON or TOML.
//!
//! The keys are the names of the fields of [`Theme`], with `theme` for the one that is started from. Everything may be left
//! out. All that is wrong is reported at once.

mod value;

use core::fmt;

use super::super::colour::Colour;
use super::super::ramp;
use super::{Sizes, Theme, Widths};
use crate::text::nearest;
use value::Value;

/// How a style file is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Notation {
    /// JSON.
    Json,
    /// TOML.
    #[cfg(feature = "toml")]
    Toml,
}

/// One thing that is wrong with a style file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct StyleProblem {
    /// Where, such as `widths.force` or `arrows[2]`; empty for the file as a whole.
    pub path: String,
    /// What was found.
    pub message: String,
    /// What is expected; empty where the message says it.
    pub help: String,
}

/// All that is wrong with a style file, in the file's order; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StyleProblems(pub Vec<StyleProblem>);

impl Theme {
    /// The theme that a style file describes: `base` where it is given, else the theme that the file names, else the
    /// default, with everything changed that the file tells.
    ///
    /// # Errors
    /// All that is wrong with the file.
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
    pub fn read(
        text: &str,
        notation: Notation,
        base: Option<&Theme>,
    ) -> Result<Theme, StyleProblems> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let value = match notation {
            Notation::Json => value::json(text),
            #[cfg(feature = "toml")]
            Notation::Toml => value::toml(text),
        };
        let value = value.map_err(|problem| StyleProblems(vec![problem]))?;
        let mut reading = Reading::default();
        let Value::Table(entries) = value else {
            reading.note(
                "",
                format!("{} is no style", value.stated()),
                "give a table of keys and values".into(),
            );
            return Err(StyleProblems(reading.problems));
        };
        let named = reading.base(&entries);
        let mut theme = base.cloned().or(named).unwrap_or_default();
        reading.theme(&entries, &mut theme);
        if reading.problems.is_empty() {
            Ok(theme)
        } else {
            Err(StyleProblems(reading.problems))
        }
    }

    /// The whole theme as a style file in JSON, which reads back to the same theme.
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
        if let Some(name) = Theme::NAMES
            .iter()
            .find(|name| Theme::named(name).as_ref() == Some(self))
        {
            lines.push(format!("  \"theme\": \"{name}\""));
        }
        for (key, field) in COLOURS {
            lines.push(format!("  \"{key}\": \"{}\"", field(&mut theme).css()));
        }
        for (key, field) in LISTS {
            lines.push(format!("  \"{key}\": {}", list(field(&mut theme))));
        }
        let known = ramp::NAMES
            .iter()
            .find(|name| ramp::named(name).as_ref() == Some(&self.amplitudes));
        let amplitudes = match known {
            Some(name) => format!("\"{name}\""),
            None => list(&stops(&self.amplitudes)),
        };
        lines.push(format!("  \"{AMPLITUDES}\": {amplitudes}"));
        let widths =
            WIDTHS.map(|(key, field, ..)| format!("\"{key}\": {}", field(&mut theme.widths)));
        lines.push(format!("  \"widths\": {{ {} }}", widths.join(", ")));
        let sizes = SIZES.map(|(key, field)| format!("\"{key}\": {}", field(&mut theme.sizes)));
        lines.push(format!("  \"sizes\": {{ {} }}", sizes.join(", ")));
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}

/// A field of a theme that is one colour, by its key.
type ColourField = (&'static str, fn(&mut Theme) -> &mut Colour);

const COLOURS: [ColourField; 15] = [
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

/// A field of a theme that is a list of colours, by its key.
type ListField = (&'static str, fn(&mut Theme) -> &mut Vec<Colour>);

const LISTS: [ListField; 2] = [("arrows", |t| &mut t.arrows), ("robots", |t| &mut t.robots)];

const AMPLITUDES: &str = "amplitudes";

/// A width by its key, with the least and the most that can be drawn, and its unit.
type WidthField = (
    &'static str,
    fn(&mut Widths) -> &mut f64,
    [f64; 2],
    &'static str,
);

const WIDTHS: [WidthField; 6] = [
    ("force", |w| &mut w.force, [0.005, 0.5], EDGES),
    ("robot", |w| &mut w.robot, [0.005, 0.5], EDGES),
    ("failure", |w| &mut w.failure, [0.005, 0.5], EDGES),
    ("disc", |w| &mut w.disc, [0.02, 2.0], EDGES),
    ("outline", |w| &mut w.outline, [0.05, 20.0], PIXELS),
    ("casing", |w| &mut w.casing, [0.0, 20.0], PIXELS),
];

const EDGES: &str = "unit edges";
const PIXELS: &str = "pixels";

/// A size by its key.
type SizeField = (&'static str, fn(&mut Sizes) -> &mut f64);

const SIZES: [SizeField; 7] = [
    ("title", |s| &mut s.title),
    ("caption", |s| &mut s.caption),
    ("verdict", |s| &mut s.verdict),
    ("reason", |s| &mut s.reason),
    ("key", |s| &mut s.key),
    ("name", |s| &mut s.name),
    ("amount", |s| &mut s.amount),
];

/// Smaller letters cannot be read, larger ones leave no room for the figure.
const LETTERS: [f64; 2] = [8.0, 100.0];

/// The fewest stops in even steps from which a ramp can be made again, all of its colours at worst.
fn stops(ramp: &[Colour]) -> Vec<Colour> {
    // Steps that meet whole entries of 256.
    for step in [255, 85, 51, 17, 15, 5, 3] {
        let stops: Vec<Colour> = ramp.iter().step_by(step).copied().collect();
        if ramp::between(&stops) == ramp {
            return stops;
        }
    }
    ramp.to_vec()
}

/// Goes through a file and notes all that is wrong.
#[derive(Default)]
struct Reading {
    problems: Vec<StyleProblem>,
}

impl Reading {
    fn note(&mut self, path: &str, message: String, help: String) {
        self.problems.push(StyleProblem {
            path: path.to_owned(),
            message,
            help,
        });
    }

    /// The theme that a file names; what is wrong with the name is noted when its key comes.
    fn base(&self, entries: &[(String, Value)]) -> Option<Theme> {
        let named = |(key, value): &(String, Value)| match value {
            Value::Text(name) if key == "theme" => Theme::named(name),
            _ => None,
        };
        entries.iter().find_map(named)
    }

    fn theme(&mut self, entries: &[(String, Value)], theme: &mut Theme) {
        for (number, (key, value)) in entries.iter().enumerate() {
            self.once(entries, number, key);
            if let Some((_, field)) = COLOURS.iter().find(|c| c.0 == key) {
                if let Some(colour) = self.colour(key, value) {
                    *field(theme) = colour;
                }
            } else if let Some((_, field)) = LISTS.iter().find(|l| l.0 == key) {
                if let Some(colours) = self.colours(key, value, 1) {
                    *field(theme) = colours;
                }
            } else if key == AMPLITUDES {
                if let Some(colours) = self.amplitudes(value) {
                    theme.amplitudes = colours;
                }
            } else if key == "widths" {
                let known = WIDTHS.map(|(key, _, range, unit)| (key, range, unit));
                for (place, number) in self.numbers(key, value, &known) {
                    *WIDTHS[place].1(&mut theme.widths) = number;
                }
            } else if key == "sizes" {
                let known = SIZES.map(|(key, _)| (key, LETTERS, PIXELS));
                for (place, number) in self.numbers(key, value, &known) {
                    *SIZES[place].1(&mut theme.sizes) = number;
                }
            } else if key == "theme" {
                self.name(key, value, &Theme::NAMES, "theme");
            } else {
                let lists = LISTS.iter().map(|l| l.0);
                let others = ["theme", AMPLITUDES, "widths", "sizes"];
                let known = COLOURS.iter().map(|c| c.0).chain(lists).chain(others);
                self.unknown(key, key, &known.collect::<Vec<_>>());
            }
        }
    }

    /// Notes a key that was there before.
    fn once(&mut self, entries: &[(String, Value)], number: usize, path: &str) {
        let key = &entries[number].0;
        if entries[..number].iter().any(|e| e.0 == *key) {
            self.note(
                path,
                "this key is given twice".into(),
                "keep one of them".into(),
            );
        }
    }

    fn unknown(&mut self, path: &str, key: &str, known: &[&str]) {
        let help = match nearest(key, known.iter().copied()) {
            Some(near) => format!("the nearest known key is `{near}`"),
            None => format!("known keys are {}", known.join(", ")),
        };
        self.note(path, "unknown key".into(), help);
    }

    /// A name that is one of those known.
    fn name(&mut self, path: &str, value: &Value, known: &[&str], sort: &str) {
        let Value::Text(name) = value else {
            return self.note(
                path,
                format!("{} is no {sort}", value.stated()),
                known.join(", "),
            );
        };
        if known.contains(&name.as_str()) {
            return;
        }
        let near =
            nearest(name, known.iter().copied()).map(|near| format!("; the nearest is {near}"));
        let help = format!("known are {}{}", known.join(", "), near.unwrap_or_default());
        self.note(path, format!("{} is no {sort}", value.stated()), help);
    }

    fn colour(&mut self, path: &str, value: &Value) -> Option<Colour> {
        let colour = match value {
            Value::Text(text) => Colour::from_css(text),
            _ => None,
        };
        if colour.is_none() {
            let help = "give #rrggbb or #rgb in quotes, such as \"#d55e00\" or \"#d50\"";
            self.note(
                path,
                format!("{} is no colour", value.stated()),
                help.into(),
            );
        }
        colour
    }

    /// A list of at least so many colours.
    fn colours(&mut self, path: &str, value: &Value, least: usize) -> Option<Vec<Colour>> {
        let Value::List(list) = value else {
            let help = "give a list of colours, such as [\"#0072b2\", \"#56b4e9\"]";
            self.note(
                path,
                format!("{} is no list of colours", value.stated()),
                help.into(),
            );
            return None;
        };
        if list.len() < least {
            let help = format!("give at least {least}");
            self.note(path, format!("{} colours are too few", list.len()), help);
        }
        let colours: Vec<Option<Colour>> = (0..)
            .zip(list)
            .map(|(i, value): (usize, _)| self.colour(&format!("{path}[{i}]"), value))
            .collect();
        colours.into_iter().collect()
    }

    fn amplitudes(&mut self, value: &Value) -> Option<Vec<Colour>> {
        if let Value::Text(name) = value {
            self.name(AMPLITUDES, value, &ramp::NAMES, "row of colours");
            return ramp::named(name);
        }
        let stops = self.colours(AMPLITUDES, value, 2)?;
        Some(ramp::between(&stops))
    }

    /// Numbers by their keys, of which each has its range and unit: each number with the place of its key among those known.
    fn numbers(
        &mut self,
        path: &str,
        value: &Value,
        known: &[(&str, [f64; 2], &str)],
    ) -> Vec<(usize, f64)> {
        let keys: Vec<&str> = known.iter().map(|k| k.0).collect();
        let mut numbers = Vec::new();
        let Value::Table(entries) = value else {
            let help = format!("give a table with some of {}", keys.join(", "));
            self.note(
                path,
                format!("{} is no table of {path}", value.stated()),
                help,
            );
            return numbers;
        };
        for (number, (key, value)) in entries.iter().enumerate() {
            let path = format!("{path}.{key}");
            self.once(entries, number, &path);
            let Some(place) = keys.iter().position(|k| k == key) else {
                self.unknown(&path, key, &keys);
                continue;
            };
            let (_, [least, most], unit) = known[place];
            match value {
                Value::Number(number) if (least..=most).contains(number) => {
                    numbers.push((place, *number))
                }
                _ => {
                    let help = format!("give a number of {unit} from {least} to {most}");
                    self.note(&path, format!("{} cannot be drawn", value.stated()), help);
                }
            }
        }
        numbers
    }
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
