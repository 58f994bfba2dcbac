//! [`StyleArgs`]: the options `--theme` and `--style`, which `render`, `batch`, `report`, `figures` and `shapes` share.

use std::path::{Path, PathBuf};

use crate::entry::cli::error::CliError;
use crate::entry::value::ThemeName;
use crate::pictures::drawing::Theme;
use crate::pictures::drawing::style::format::Notation;
use crate::read::file;
use crate::text::{Word, typed_word};

request! {
    /// The theme, and a style file that changes it.
    #[derive(Clone, Debug)]
    pub(crate) struct StyleArgs(given) {
        /// The look: plain with one mark at each joint, as in Vallat (2023), for print and greyscale, for all kinds of
        /// colour vision, for a dark page, or auto for an SVG that is plain on light pages and dark on dark pages
        /// [default: plain, but thesis for scenes on a lattice]
        theme: Option<ThemeChoice> = given.word("theme"),
            arg(long, value_name = "NAME", env = "DRYSTONE_THEME", hide_env_values = true,
                value_parser = typed_word::<ThemeChoice>());
        /// A style file (.json or .toml) with your own colours, widths and sizes, or its content as JSON; `drystone style`
        /// prints one to start from
        style: Option<PathBuf> = given.text("style").map(PathBuf::from),
            arg(long, value_name = "FILE", env = "DRYSTONE_STYLE", hide_env_values = true);
    }
}

/// A theme, or `auto` for the themes `plain` and `dark` in one SVG.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ThemeChoice {
    One(ThemeName),
    Auto,
}

impl Word for ThemeChoice {
    fn all() -> Vec<ThemeChoice> {
        ThemeName::all().into_iter().map(ThemeChoice::One).chain([ThemeChoice::Auto]).collect()
    }

    fn word(self) -> &'static str {
        match self {
            ThemeChoice::One(name) => name.0,
            ThemeChoice::Auto => "auto",
        }
    }
}

impl StyleArgs {
    /// Returns the style file, if one was given.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.style.as_deref().filter(|style| written(style).is_none())
    }

    /// Returns the name of the theme, if one was given and no style file changes it.
    pub(crate) fn name(&self) -> Option<&str> {
        self.theme.map(Word::word).filter(|_| self.style.is_none())
    }

    /// True if the command line has a theme or a style file.
    pub(crate) fn is_chosen(&self) -> bool {
        self.theme.is_some() || self.style.is_some()
    }

    /// True if the figure follows the colours that its reader prefers.
    pub(crate) fn is_auto(&self) -> bool {
        matches!(self.theme, Some(ThemeChoice::Auto))
    }

    /// Returns the selected theme, with the changes that the style file makes to it. Refuses `auto`.
    pub(crate) fn theme(&self) -> Result<Theme, CliError> {
        if self.is_auto() {
            return Err("--theme auto is only for render, markdown and mdbook; choose plain or dark".into());
        }
        self.light_theme()
    }

    /// Returns the selected theme, with the changes that the style file makes to it. The theme of `auto` is `plain`.
    pub(crate) fn light_theme(&self) -> Result<Theme, CliError> {
        let base = self.theme.map(|theme| match theme {
            ThemeChoice::One(name) => name.theme(),
            ThemeChoice::Auto => Theme::plain(),
        });
        match &self.style {
            None => Ok(base.unwrap_or_default()),
            Some(_) if self.is_auto() => Err("--style changes one theme; leave out --theme auto".into()),
            Some(style) => match written(style) {
                Some(text) => Theme::read(text, Notation::Json, base.as_ref()).map_err(|mut problems| {
                    // The text is a value of the command line or of Python, without lines.
                    problems.0.iter_mut().for_each(|problem| problem.line = 0);
                    CliError::Style { name: "style".into(), problems }
                }),
                None => read(style, base.as_ref()),
            },
        }
    }
}

/// Returns the content of a style that is given in place of the name of a file.
fn written(style: &Path) -> Option<&str> {
    style.to_str().filter(|text| text.trim_start().starts_with('{'))
}

fn read(path: &Path, base: Option<&Theme>) -> Result<Theme, CliError> {
    let name = path.display().to_string();
    let notation = match file::ending(path).as_str() {
        "json" => Notation::Json,
        "toml" => Notation::Toml,
        _ => {
            return Err(CliError::from(format!(
                "--style {name}: a style file ends in .json or .toml; to draw normal and friction forces separately, use \
                 --arrows components"
            )));
        }
    };
    let text = file::text(path).map_err(|error| CliError::not_read(&name, error))?;
    Theme::read(&text, notation, base).map_err(|problems| CliError::Style { name, problems })
}
