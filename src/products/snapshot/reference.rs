//! [`Part`]: a reference file of a scene or figure, and the options that produce it.

use std::path::{Path, PathBuf};

use super::layer::Layer;
use super::setting::Settings;
use crate::pictures::drawing::Theme;
use crate::products::figure::{Kind, View};

/// A reference file of a snapshot, and the options that produce it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The layer whose content the file stores.
    pub layer: Layer,
    /// The path of the file.
    pub file: PathBuf,
    /// What the figure shows.
    pub view: View,
    /// The name of the theme of the figure.
    pub theme: String,
    /// The width of the picture in pixels; `None` for the natural width of the drawing.
    pub width: Option<u32>,
}

impl Part {
    /// True if the file stores only a hash of the pixels.
    pub(super) fn is_hash(&self) -> bool {
        self.file.extension().is_some_and(|extension| extension == HASH_EXTENSION)
    }
}

/// The extension of a file with a hash of the pixels, and the first words of this file.
const HASH_EXTENSION: &str = "hash";
pub(super) const HASH_WORDS: &str = "drystone pixels ";

/// Lists the reference files of a scene or figure for the layers in the settings: one file of facts, one SVG for each
/// kind of figure, and one picture for each combination of kind, theme and width. The path of each file is `base` with
/// suffixes for its combination, such as `arch.dark.png`. The first kind, theme and width have no suffix.
pub fn parts(base: &Path, settings: &Settings) -> Vec<Part> {
    let mut parts = Vec::new();
    let has = |layer: Layer| settings.layers.contains(&layer);
    let first_theme = settings.themes.first().cloned().unwrap_or_default();
    let mut part = |layer, marks: &[Option<String>], view, theme: &str, width| {
        let extension = match layer {
            Layer::Facts => "txt",
            Layer::Svg => "svg",
            Layer::Pixels if settings.hashes_pixels => HASH_EXTENSION,
            Layer::Pixels => "png",
        };
        let mut name = base.file_name().unwrap_or_default().to_os_string();
        for suffix in marks.iter().flatten().map(String::as_str).chain([extension]) {
            name.push(format!(".{suffix}"));
        }
        parts.push(Part { layer, file: base.with_file_name(name), view, theme: theme.to_owned(), width });
    };
    if has(Layer::Facts) {
        part(Layer::Facts, &[], Kind::Forces.into(), &first_theme, None);
    }
    // Without widths in the settings, pictures have the natural width of the drawing.
    let widths: Vec<Option<u32>> = match settings.widths.as_slice() {
        [] => vec![None],
        some => some.iter().copied().map(Some).collect(),
    };
    for (k, kind) in settings.kinds.iter().enumerate() {
        let kind_mark = (k > 0).then(|| kind.name().to_owned());
        if has(Layer::Svg) {
            part(Layer::Svg, std::slice::from_ref(&kind_mark), *kind, &first_theme, None);
        }
        let themes = settings.themes.iter().filter(|_| has(Layer::Pixels));
        for (t, theme) in themes.enumerate() {
            let theme_mark = (t > 0).then(|| theme.clone());
            for (w, width) in widths.iter().enumerate() {
                let width_mark = width.filter(|_| w > 0).map(|w| format!("w{w}"));
                let marks = [kind_mark.clone(), theme_mark.clone(), width_mark];
                part(Layer::Pixels, &marks, *kind, theme, *width);
            }
        }
    }
    parts
}

/// True if the file of a scene with this suffix, such as `dark.w320`, can only be a reference: each part of the suffix is
/// the name of a kind of figure or of a theme, or a width.
pub(super) fn is_reference_suffix(suffix: &str) -> bool {
    suffix.split('.').all(|mark| {
        let is_width = mark.strip_prefix('w').is_some_and(|width| width.parse::<u32>().is_ok());
        is_width || View::from_name(mark).is_some() || Theme::NAMES.contains(&mark)
    })
}
