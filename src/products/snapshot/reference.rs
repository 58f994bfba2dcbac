//! [`Part`]: a reference file of a scene or figure, and the options that produce it.

use std::path::{Path, PathBuf};

use super::layer::Layer;
use super::setting::Settings;
use crate::products::figure::Kind;

/// A reference file of a snapshot, and the options that produce it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The layer whose content the file stores.
    pub layer: Layer,
    /// The path of the file.
    pub file: PathBuf,
    /// The kind of figure.
    pub kind: Kind,
    /// The name of the theme of the figure.
    pub theme: String,
    /// The width of the picture in pixels; `None` for the natural width of the drawing.
    pub width: Option<u32>,
}

/// Lists the reference files of a scene or figure for the layers in the settings: one file of facts, one SVG for each
/// kind of figure, and one PNG for each combination of kind, theme and width. The path of each file is `base` with
/// suffixes for its combination.
pub fn parts(base: &Path, settings: &Settings) -> Vec<Part> {
    let mut parts = Vec::new();
    let has = |layer: Layer| settings.layers.contains(&layer);
    let first_theme = settings.themes.first().cloned().unwrap_or_default();
    let part = |layer, marks: &[String], kind, theme: &str, width| Part {
        layer,
        file: file_name(base, marks, layer),
        kind,
        theme: theme.to_owned(),
        width,
    };
    if has(Layer::Facts) {
        parts.push(part(Layer::Facts, &[], Kind::Forces, &first_theme, None));
    }
    for (k, kind) in settings.kinds.iter().enumerate() {
        // The first kind, the first theme and the first width have no suffix in the file name.
        let kind_mark = (k > 0).then(|| kind.name().to_owned());
        if has(Layer::Svg) {
            let marks: Vec<String> = kind_mark.iter().cloned().collect();
            parts.push(part(Layer::Svg, &marks, *kind, &first_theme, None));
        }
        if !has(Layer::Pixels) {
            continue;
        }
        for (t, theme) in settings.themes.iter().enumerate() {
            let theme_mark = (t > 0).then(|| theme.clone());
            for (w, width) in widths(settings).into_iter().enumerate() {
                let width_mark = width.filter(|_| w > 0).map(|w| format!("w{w}"));
                let marks = [&kind_mark, &theme_mark, &width_mark];
                let marks: Vec<String> = marks.into_iter().flatten().cloned().collect();
                parts.push(part(Layer::Pixels, &marks, *kind, theme, width));
            }
        }
    }
    parts
}

/// Returns the picture widths in the settings, in pixels. If the settings have no widths, returns only `None`, which
/// stands for the natural width of the drawing.
fn widths(settings: &Settings) -> Vec<Option<u32>> {
    match settings.widths.as_slice() {
        [] => vec![None],
        some => some.iter().copied().map(Some).collect(),
    }
}

/// Returns the path of a reference: `arch.dark.png` for the base `arch`, the mark `dark` and the layer `Pixels`.
fn file_name(base: &Path, marks: &[String], layer: Layer) -> PathBuf {
    let extension = match layer {
        Layer::Facts => "txt",
        Layer::Svg => "svg",
        Layer::Pixels => "png",
    };
    let mut name = base.file_name().unwrap_or_default().to_os_string();
    for suffix in marks.iter().map(String::as_str).chain([extension]) {
        name.push(format!(".{suffix}"));
    }
    base.with_file_name(name)
}
