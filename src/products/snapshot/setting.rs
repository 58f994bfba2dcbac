//! [`Settings`]: the settings of a check, read from `drystone-snapshots.toml`.

use std::path::{Path, PathBuf};

use super::fact::DIGITS;
use super::layer::Layer;
use crate::pictures::drawing::Theme;
use crate::pictures::output::png::MAX_SIDE;
use crate::products::figure::{Kind, View};
use crate::read::{
    self, Dialect, Expected, Mark, Mistake, Node, NodeKind, Notation, Read, Reader, Trail, from_text, read_keys, word,
};

/// The name of the settings file.
pub const SETTINGS_FILE: &str = "drystone-snapshots.toml";

/// The settings of a check.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// The layers to compare.
    pub layers: Vec<Layer>,
    /// The kinds of figures, also with what they show, such as `mechanism-tilt`. The first kind is stored as `name.svg`,
    /// every other kind as `name.KIND.svg`.
    pub kinds: Vec<View>,
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
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            layers: Layer::ALL.to_vec(),
            kinds: vec![Kind::Forces.into()],
            themes: vec![Theme::NAMES[0].into()],
            widths: Vec::new(),
            digits: DIGITS,
            channel_tolerance: 1,
            hashes_pixels: false,
            most_kilobytes: None,
            ignore: Vec::new(),
            scenes: Vec::new(),
        }
    }
}

read_keys! {
    Settings {
        layers as |r, node, at| {
            let layers = Layer::ALL.map(|layer| (layer.name(), layer));
            named(r, node, at, |r, node, at| r.choice(node, at, &layers))
        },
        kinds as |r, node, at| views(r, node, at),
        themes as |r, node, at| {
            let themes = Theme::NAMES.map(|name| (name, name));
            let names = named(r, node, at, |r, node, at| r.choice(node, at, &themes))?;
            Some(names.into_iter().map(String::from).collect())
        },
        widths as |r, node, at| distinct(r, node, at, |r, node, at| r.whole_within(node, at, [16, MAX_SIDE])),
        digits as |r, node, at| r.whole_within(node, at, [2, 12]).map(|n| n as usize),
        hashes_pixels "pixels" as |r, node, at| r.choice(node, at, &[("png", false), ("hash", true)]),
        channel_tolerance as |r, node, at| r.whole_within(node, at, [0, 254]).map(|n| n as u8),
        most_kilobytes as |r, node, at| r.whole_within(node, at, [1, 1_000_000]).map(|n| Some(u64::from(n))),
        ignore,
        scenes as |r, node, at| {
            let paths: Vec<String> = Read::read(r, node, at)?;
            Some(paths.into_iter().map(PathBuf::from).collect())
        },
    }
}

/// Reads a list of words, each at most once. The list must not be empty.
fn named<'s, T: PartialEq + Copy>(
    r: &mut Reader<'s>,
    node: &'s Node<'s>,
    at: &Trail<'_>,
    read: impl FnMut(&mut Reader<'s>, &'s Node<'s>, &Trail<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    if matches!(&node.kind, NodeKind::List(list) if list.len() == 0) {
        r.wrong(node, at, Expected::Other("a list that is not empty, or no such key for the default"));
        return None;
    }
    distinct(r, node, at, read)
}

/// Reads a list of kinds of figures.
fn views<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Vec<View>> {
    let mut shown: Vec<View> = Vec::new();
    for view in named(r, node, at, word::<View>)? {
        // Two kinds of the last version may be one kind now.
        if !shown.iter().any(|other| other.name() == view.name()) {
            shown.push(view);
        }
    }
    Some(shown)
}

/// Reads a list of values, each at most once.
fn distinct<'s, T: PartialEq>(
    r: &mut Reader<'s>,
    node: &'s Node<'s>,
    at: &Trail<'_>,
    mut read: impl FnMut(&mut Reader<'s>, &'s Node<'s>, &Trail<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    let list = r.entries(node, at, |r, node, at| read(r, node, at).map(Some))?;
    let list: Vec<T> = list.into_iter().flatten().collect();
    if (0..list.len()).any(|i| list[..i].contains(&list[i])) {
        let message = "the list contains a value twice; both would have the same reference file";
        r.report(at, Mark::Value, Mistake::new(read::Kind::UnknownChoice, message, "remove one of the two"));
    }
    Some(list)
}

impl Settings {
    /// Returns what to write instead of names of the last version.
    pub fn notes(&self) -> Vec<String> {
        let note = |view: &View| Some(view.note()?.replace("--kind", "the kind"));
        self.kinds.iter().filter_map(note).collect()
    }

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
    /// assert!(wrong[0].starts_with("1:10: kinds[0]: expected \"forces\", "));
    /// assert!(wrong[1].starts_with("2:1: width: unknown key `width`; the nearest known key is `widths`"));
    /// # Ok::<(), Vec<String>>(())
    /// ```
    pub fn read(text: &str) -> Result<Settings, Vec<String>> {
        let described = |p: read::Problem| {
            let path = if p.path.is_empty() { String::new() } else { format!("{}: ", p.path) };
            format!("{}:{}: {path}{}; {}", p.line, p.column, p.message, p.help)
        };
        from_text(text, Notation::Toml, &Dialect::plain("settings"), <Settings as Read>::read)
            .map_err(|problems| problems.0.into_iter().map(described).collect())
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
