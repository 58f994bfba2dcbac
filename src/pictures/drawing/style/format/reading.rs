//! [`ThemeReader`]: reads the keys of a style file and collects all problems.

use super::value::Value;
use super::{
    AMPLITUDES_KEY, COLOUR_FIELDS, FONT_SIZE_LIMITS, LIST_FIELDS, PIXEL_UNIT, SIZE_FIELDS, StyleProblem, Theme,
    WIDTH_FIELDS,
};
use crate::pictures::drawing::colour::Colour;
use crate::pictures::drawing::ramp;
use crate::text::nearest;

/// Reads the keys of a file and collects all problems.
#[derive(Default)]
pub(super) struct ThemeReader {
    pub(super) problems: Vec<StyleProblem>,
}

impl ThemeReader {
    /// Adds a problem to the list. `path` is the path to the value, and `help` says what is expected.
    pub(super) fn note(&mut self, path: &str, message: String, help: String) {
        self.problems.push(StyleProblem { path: path.to_owned(), message, help });
    }

    /// Returns the theme that the key `theme` of a file names. Returns `None` if there is no such key or if the name is
    /// unknown. [`ThemeReader::theme`] reports an unknown name.
    pub(super) fn base(&self, entries: &[(String, Value)]) -> Option<Theme> {
        let named = |(key, value): &(String, Value)| match value {
            Value::Text(name) if key == "theme" => Theme::named(name),
            _ => None,
        };
        entries.iter().find_map(named)
    }

    /// Reads all keys of a file. Writes their values to the fields of `theme`, and collects all problems.
    pub(super) fn theme(&mut self, entries: &[(String, Value)], theme: &mut Theme) {
        for (number, (key, value)) in entries.iter().enumerate() {
            self.once(entries, number, key);
            if let Some((_, field)) = COLOUR_FIELDS.iter().find(|c| c.0 == key) {
                if let Some(colour) = self.colour(key, value) {
                    *field(theme) = colour;
                }
            } else if let Some((_, field)) = LIST_FIELDS.iter().find(|l| l.0 == key) {
                if let Some(colours) = self.colours(key, value, 1) {
                    *field(theme) = colours;
                }
            } else if key == AMPLITUDES_KEY {
                if let Some(colours) = self.amplitudes(value) {
                    theme.amplitudes = colours;
                }
            } else if key == "widths" {
                let known = WIDTH_FIELDS.map(|(key, _, range, unit)| (key, range, unit));
                for (place, number) in self.numbers(key, value, &known) {
                    *WIDTH_FIELDS[place].1(&mut theme.widths) = number;
                }
            } else if key == "sizes" {
                let known = SIZE_FIELDS.map(|(key, _)| (key, FONT_SIZE_LIMITS, PIXEL_UNIT));
                for (place, number) in self.numbers(key, value, &known) {
                    *SIZE_FIELDS[place].1(&mut theme.sizes) = number;
                }
            } else if key == "theme" {
                self.name(key, value, &Theme::NAMES, "theme");
            } else {
                let lists = LIST_FIELDS.iter().map(|l| l.0);
                let others = ["theme", AMPLITUDES_KEY, "widths", "sizes"];
                let known = COLOUR_FIELDS.iter().map(|c| c.0).chain(lists).chain(others);
                self.unknown(key, key, &known.collect::<Vec<_>>());
            }
        }
    }

    /// Reports a problem if an earlier entry has the same key as the entry with the index `number`.
    fn once(&mut self, entries: &[(String, Value)], number: usize, path: &str) {
        let key = &entries[number].0;
        if entries[..number].iter().any(|e| e.0 == *key) {
            self.note(path, "this key is given twice".into(), "keep one of them".into());
        }
    }

    fn unknown(&mut self, path: &str, key: &str, known: &[&str]) {
        let help = match nearest(key, known.iter().copied()) {
            Some(near) => format!("the nearest known key is `{near}`"),
            None => format!("known keys are {}", known.join(", ")),
        };
        self.note(path, "unknown key".into(), help);
    }

    /// Reports a problem if the value is not one of the known names. `sort` is what the names stand for, for example
    /// "theme"; the message contains this word.
    fn name(&mut self, path: &str, value: &Value, known: &[&str], sort: &str) {
        let Value::Text(name) = value else {
            return self.note(path, format!("{} is not a {sort}", value.stated()), known.join(", "));
        };
        if known.contains(&name.as_str()) {
            return;
        }
        let near = nearest(name, known.iter().copied()).map(|near| format!("; the nearest is {near}"));
        let help = format!("known names are {}{}", known.join(", "), near.unwrap_or_default());
        self.note(path, format!("{} is not a {sort}", value.stated()), help);
    }

    fn colour(&mut self, path: &str, value: &Value) -> Option<Colour> {
        let colour = match value {
            Value::Text(text) => Colour::from_css(text),
            _ => None,
        };
        if colour.is_none() {
            let help = "give #rrggbb or #rgb in quotes, such as \"#d55e00\" or \"#d50\"";
            self.note(path, format!("{} is not a colour", value.stated()), help.into());
        }
        colour
    }

    /// Reads a list of colours. Returns `None` if the value is not a list or an entry is not a colour. Reports a
    /// problem in these cases, and if there are fewer than `least` colours.
    fn colours(&mut self, path: &str, value: &Value, least: usize) -> Option<Vec<Colour>> {
        let Value::List(list) = value else {
            let help = "give a list of colours, such as [\"#0072b2\", \"#56b4e9\"]";
            self.note(path, format!("{} is not a list of colours", value.stated()), help.into());
            return None;
        };
        if list.len() < least {
            let help = format!("give at least {least}");
            self.note(path, format!("{} colours are too few", list.len()), help);
        }
        let colours: Vec<Option<Colour>> =
            (0..).zip(list).map(|(i, value): (usize, _)| self.colour(&format!("{path}[{i}]"), value)).collect();
        colours.into_iter().collect()
    }

    fn amplitudes(&mut self, value: &Value) -> Option<Vec<Colour>> {
        if let Value::Text(name) = value {
            self.name(AMPLITUDES_KEY, value, &ramp::NAMES, "colour ramp");
            return ramp::named(name);
        }
        let stops = self.colours(AMPLITUDES_KEY, value, 2)?;
        Some(ramp::between(&stops))
    }

    /// Reads a table of numbers. `known` lists each possible key with the range and unit of its number. Returns each
    /// valid number with the index of its key in `known`. Reports a problem for every other entry.
    fn numbers(&mut self, path: &str, value: &Value, known: &[(&str, [f64; 2], &str)]) -> Vec<(usize, f64)> {
        let keys: Vec<&str> = known.iter().map(|k| k.0).collect();
        let mut numbers = Vec::new();
        let Value::Table(entries) = value else {
            let help = format!("give a table with some of {}", keys.join(", "));
            self.note(path, format!("{} is not a table of {path}", value.stated()), help);
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
                Value::Number(number) if (least..=most).contains(number) => numbers.push((place, *number)),
                _ => {
                    let help = format!("give a number of {unit} from {least} to {most}");
                    self.note(&path, format!("{} cannot be drawn", value.stated()), help);
                }
            }
        }
        numbers
    }
}
