//! [`Settings`]: the settings of a check, read from `drystone-snapshots.toml`. No other file of this folder uses the
//! toml crate.

use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::fact::DIGITS;
use super::layer::Layer;
use crate::pictures::drawing::Theme;
use crate::pictures::output::png::MAX_SIDE;
use crate::products::figure::Kind;

/// The name of the settings file.
pub const SETTINGS_FILE: &str = "drystone-snapshots.toml";

/// The settings of a check.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// The layers to compare.
    pub layers: Vec<Layer>,
    /// The kinds of figures. The first kind is stored as `name.svg`, every other kind as `name.KIND.svg`.
    pub kinds: Vec<Kind>,
    /// The names of the themes. The first theme is stored as `name.png`, every other theme as `name.THEME.png`. Only
    /// the first theme is stored as SVG.
    pub themes: Vec<String>,
    /// The widths of pictures in pixels. The first width is stored as `name.png`, every other width as, for example,
    /// `name.w320.png`. If the list is empty, a picture has one pixel per unit of the drawing.
    pub widths: Vec<u32>,
    /// The significant digits of a force that is as large as the largest weight or load.
    pub digits: usize,
    /// The largest difference of a colour channel at which two pixels count as equal, of 255. The default is 1:
    /// another processor or compiler may round a blended colour to the neighbouring value.
    pub channel_tolerance: u8,
    /// True if a reference stores only a hash of the pixels, in place of the picture.
    pub hashes_pixels: bool,
    /// The largest size of a reference picture, in kilobytes (1000 bytes) per panel; `None` for no limit.
    pub most_kilobytes: Option<u64>,
    /// Scene files to ignore: paths relative to the settings file, in which `*` stands for any text.
    pub ignore: Vec<String>,
    /// More scenes or folders of scenes, relative to the settings file. Their references are stored next to the
    /// settings file.
    pub scenes: Vec<PathBuf>,
    /// Notes on keys that have no effect.
    pub notes: Vec<String>,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            layers: Layer::ALL.to_vec(),
            kinds: vec![Kind::Forces],
            themes: vec!["thesis".into()],
            widths: Vec::new(),
            digits: DIGITS,
            channel_tolerance: 1,
            hashes_pixels: false,
            most_kilobytes: None,
            ignore: Vec::new(),
            scenes: Vec::new(),
            notes: Vec::new(),
        }
    }
}

/// All keys of the settings file.
const KEYS: [&str; 11] = [
    "layers",
    "kinds",
    "themes",
    "widths",
    "digits",
    "pixels",
    "channel_tolerance",
    "perceptual_threshold",
    "most_kilobytes",
    "ignore",
    "scenes",
];

impl Settings {
    /// Reads the text of a settings file. Keys that are missing have their default values.
    ///
    /// # Errors
    /// One message for each problem, which begins with its line and column.
    ///
    /// # Example
    /// ```
    /// use drystone::snapshot::Settings;
    /// let settings = Settings::read("kinds = [\"forces\", \"thrust\"]\nwidths = [640]")?;
    /// assert_eq!((settings.kinds.len(), settings.channel_tolerance), (2, 1));
    /// let wrong = Settings::read("kinds = [\"force\"]\nwidth = 9").expect_err("two problems");
    /// assert!(wrong[0].starts_with("1:10: kinds: there is no \"force\""));
    /// assert!(wrong[1].starts_with("2:1: there is no key width"));
    /// # Ok::<(), Vec<String>>(())
    /// ```
    pub fn read(text: &str) -> Result<Settings, Vec<String>> {
        let (table, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            let described = errors.iter().map(|e| {
                let place = e.span().map_or(0, |span| span.start);
                format!("{}: not valid TOML: {}", place_in(text, place), e.message())
            });
            return Err(described.collect());
        }
        let mut reading = SettingsReader { text, settings: Settings::default(), problems: Vec::new() };
        for (key, value) in table.get_ref() {
            reading.key(key, value);
        }
        // Sort the problems by their position in the file, because the TOML table has another order.
        reading.problems.sort();
        if reading.problems.is_empty() {
            return Ok(reading.settings);
        }
        let described = reading.problems.into_iter();
        Err(described.map(|(at, words)| format!("{}: {words}", place_in(text, at))).collect())
    }
}

/// Returns the line and column at a byte offset, both counted from 1, as `2:1`.
fn place_in(text: &str, at: usize) -> String {
    let before = text.get(..at).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
    format!("{line}:{column}")
}

/// The state while a settings file is read.
struct SettingsReader<'t> {
    text: &'t str,
    settings: Settings,
    /// The problems found so far, each with its byte offset in the text.
    problems: Vec<(usize, String)>,
}

type SpannedValue<'v> = Spanned<DeValue<'v>>;

impl SettingsReader<'_> {
    /// Adds a problem at a byte offset of the text.
    fn wrong(&mut self, at: usize, words: String) {
        self.problems.push((at, words));
    }

    fn key<'v>(&mut self, key: &Spanned<std::borrow::Cow<'v, str>>, value: &SpannedValue<'v>) {
        let at = key.span().start;
        match key.get_ref().as_ref() {
            "layers" => self.settings.layers = self.named("layers", value, &Layer::ALL.map(Layer::name), Layer::named),
            "kinds" => {
                let names: Vec<&str> = Kind::ALL.iter().map(|k| k.name()).collect();
                self.settings.kinds = self.named("kinds", value, &names, Kind::from_name);
            }
            "themes" => {
                let known = |name: &str| Theme::named(name).map(|_| name.to_owned());
                self.settings.themes = self.named("themes", value, &Theme::NAMES, known);
            }
            "widths" => {
                let widths = self.list("widths", value);
                let widths: Vec<u64> =
                    widths.iter().filter_map(|w| self.whole("widths", w, 16, u64::from(MAX_SIDE))).collect();
                self.settings.widths = widths.into_iter().map(|w| w as u32).collect();
                self.report_duplicates("widths", value, self.settings.widths.clone());
            }
            "digits" => {
                if let Some(digits) = self.whole("digits", value, 2, 12) {
                    self.settings.digits = digits as usize;
                }
            }
            "pixels" => match value.get_ref().as_str() {
                Some("hash") => self.settings.hashes_pixels = true,
                Some("png") => {}
                _ => {
                    let stated = self.text.get(value.span()).unwrap_or_default();
                    let stated = crate::text::heading(stated, 40);
                    self.wrong(
                        value.span().start,
                        format!("pixels: there is no {stated}; there are \"png\", \"hash\""),
                    );
                }
            },
            "channel_tolerance" => {
                if let Some(channel) = self.whole("channel_tolerance", value, 0, 254) {
                    self.settings.channel_tolerance = channel as u8;
                }
            }
            "perceptual_threshold" => self.threshold(value),
            "most_kilobytes" => self.settings.most_kilobytes = self.whole("most_kilobytes", value, 1, 1_000_000),
            "ignore" => self.settings.ignore = self.texts("ignore", value),
            "scenes" => {
                let paths = self.texts("scenes", value);
                self.settings.scenes = paths.into_iter().map(PathBuf::from).collect();
            }
            other => {
                let other = crate::text::heading(other, 40);
                self.wrong(at, format!("there is no key {other}; there are {}", KEYS.join(", ")));
            }
        }
    }

    fn list<'v, 'f>(&mut self, key: &str, value: &'f SpannedValue<'v>) -> Vec<&'f SpannedValue<'v>> {
        match value.get_ref() {
            DeValue::Array(list) => list.iter().collect(),
            other => {
                let found = other.type_str();
                self.wrong(
                    value.span().start,
                    format!("{key} must be a list in square brackets, not a value of type {found}"),
                );
                Vec::new()
            }
        }
    }

    fn texts(&mut self, key: &str, value: &SpannedValue<'_>) -> Vec<String> {
        let mut texts = Vec::new();
        for entry in self.list(key, value) {
            match entry.get_ref() {
                DeValue::String(text) => texts.push(text.to_string()),
                other => {
                    let found = other.type_str();
                    self.wrong(
                        entry.span().start,
                        format!("{key} must contain strings in quotation marks, not a value of type {found}"),
                    );
                }
            }
        }
        texts
    }

    /// Reads a list of names, and returns their values. `known` returns the value of a name, or `None` for an unknown
    /// name. Reports an empty list, unknown names and duplicates as problems.
    fn named<T: PartialEq + Clone>(
        &mut self,
        key: &str,
        value: &SpannedValue<'_>,
        names: &[&str],
        known: impl Fn(&str) -> Option<T>,
    ) -> Vec<T> {
        let before = self.problems.len();
        let mut found = Vec::new();
        for entry in self.list(key, value) {
            let name = entry.get_ref().as_str().unwrap_or_default();
            match known(name) {
                Some(one) => found.push(one),
                None => {
                    let stated = self.text.get(entry.span()).unwrap_or_default();
                    let stated = crate::text::heading(stated, 40);
                    self.wrong(
                        entry.span().start,
                        format!("{key}: there is no {stated}; there are {}", names.join(", ")),
                    );
                }
            }
        }
        if found.is_empty() && self.problems.len() == before {
            self.wrong(value.span().start, format!("{key} is empty; remove it to use the default"));
        }
        self.report_duplicates(key, value, found.clone());
        found
    }

    fn report_duplicates<T: PartialEq>(&mut self, key: &str, value: &SpannedValue<'_>, list: Vec<T>) {
        let again = |i: usize| list[..i].contains(&list[i]);
        if (0..list.len()).any(again) {
            self.wrong(
                value.span().start,
                format!("{key} contains a value twice; both would have the same reference file"),
            );
        }
    }

    /// Reads a whole number from `least` to `most`. Any other value is reported as a problem.
    fn whole(&mut self, key: &str, value: &SpannedValue<'_>, least: u64, most: u64) -> Option<u64> {
        let number = match value.get_ref() {
            DeValue::Integer(number) => u64::from_str_radix(number.as_str(), number.radix()).ok(),
            _ => None,
        };
        if number.is_none_or(|n| n < least || n > most) {
            let stated = self.text.get(value.span()).unwrap_or_default();
            let stated = crate::text::heading(stated, 40);
            self.wrong(value.span().start, format!("{key}: {stated} is not a whole number from {least} to {most}"));
            return None;
        }
        number
    }

    fn threshold(&mut self, value: &SpannedValue<'_>) {
        let stated = self.text.get(value.span()).unwrap_or_default();
        match stated.parse::<f64>() {
            Ok(threshold) if (0.0..=1.0).contains(&threshold) => {
                let note = "perceptual_threshold has no effect: pixels are compared by channel_tolerance";
                self.settings.notes.push(note.into());
            }
            _ => {
                let stated = crate::text::heading(stated, 40);
                self.wrong(
                    value.span().start,
                    format!("perceptual_threshold: {stated} is not a number from 0 to 1; a usual value is 0.1"),
                );
            }
        }
    }
}

/// Finds the settings file for a folder: in the folder itself, or in the nearest folder above it. The search does not
/// go above a folder that contains `.git`. Returns `None` if there is no settings file.
pub fn nearest(folder: &Path) -> Option<PathBuf> {
    let start = std::path::absolute(folder).ok()?;
    for above in start.ancestors() {
        let file = above.join(SETTINGS_FILE);
        if file.is_file() {
            return Some(file);
        }
        if above.join(".git").exists() {
            return None;
        }
    }
    None
}

/// True if a name matches a pattern. In the pattern, `*` stands for any text, including none.
pub fn matches_pattern(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    let parts: Vec<&str> = parts.collect();
    let Some((last, middle)) = parts.split_last() else {
        return rest.is_empty();
    };
    for part in middle {
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    rest.len() >= last.len() && rest.ends_with(last)
}

#[cfg(test)]
mod tests;
