//! [`MarginArgs`]: the option `--margins` and its optional list, which `check` and `batch` share.

use std::ffi::OsString;
use std::path::Path;

use clap::{Args, ValueEnum};

use crate::analysis::{MarginKind, MarginKinds, Options};

/// Whether margins are computed, and which.
#[derive(Clone, Debug, Args)]
pub(crate) struct MarginArgs {
    /// Compute how far each frame is from its limit: least friction, largest tilt, horizontal load, kernel and factor
    /// on the loads, least limits of robots; or only some of these, such as friction,tilt
    #[arg(
        long,
        value_enum,
        value_name = "LIST",
        value_delimiter = ',',
        num_args = 0..,
        require_equals = true
    )]
    margins: Option<Vec<Name>>,
}

/// A margin, by its name in results.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Name {
    Friction,
    Tilt,
    #[value(alias = "horizontal_load")]
    HorizontalLoad,
    Kernel,
    #[value(alias = "load_factor")]
    LoadFactor,
    Robots,
}

/// A margin with one parameter, whose sensitivity can be computed.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Varied {
    #[value(alias = "load_factor")]
    LoadFactor,
    Tilt,
    #[value(alias = "horizontal_load")]
    HorizontalLoad,
    Friction,
    Kernel,
}

impl Varied {
    /// Returns the kind of margin that this word of the command line selects.
    pub(crate) fn kind(self) -> MarginKind {
        match self {
            Varied::LoadFactor => MarginKind::LoadFactor,
            Varied::Tilt => MarginKind::Tilt,
            Varied::HorizontalLoad => MarginKind::HorizontalLoad,
            Varied::Friction => MarginKind::Friction,
            Varied::Kernel => MarginKind::Kernel,
        }
    }
}

impl Name {
    fn kind(self) -> MarginKind {
        match self {
            Name::Friction => MarginKind::Friction,
            Name::Tilt => MarginKind::Tilt,
            Name::HorizontalLoad => MarginKind::HorizontalLoad,
            Name::Kernel => MarginKind::Kernel,
            Name::LoadFactor => MarginKind::LoadFactor,
            Name::Robots => MarginKind::Robots,
        }
    }
}

impl MarginArgs {
    /// True if margins are requested.
    pub(crate) fn are_requested(&self) -> bool {
        self.margins.is_some()
    }

    /// Adds the requested margins to the options of an analysis.
    pub(crate) fn add_to(&self, options: Options) -> Options {
        match self.margins.as_deref() {
            None => options,
            Some(names) => Options {
                margins: true,
                margin_kinds: kinds(names),
                ..options
            },
        }
    }

    /// Returns the names on the command line: `none`, `all`, or a list.
    pub(crate) fn described(&self) -> String {
        match self.margins.as_deref() {
            None => "none".into(),
            Some([]) => "all".into(),
            Some(names) => {
                let words = names.iter().filter_map(ValueEnum::to_possible_value);
                let words: Vec<String> = words.map(|word| word.get_name().to_owned()).collect();
                words.join(",")
            }
        }
    }
}

/// Returns the margins in a list; all margins for an empty list.
fn kinds(names: &[Name]) -> MarginKinds {
    if names.is_empty() {
        return MarginKinds::ALL;
    }
    let kinds: Vec<MarginKind> = names.iter().map(|name| name.kind()).collect();
    MarginKinds::new(&kinds)
}

/// Returns the margins with these names, or all margins if the list is empty. The error is the first name that is not
/// a margin.
#[cfg(feature = "python")]
pub(crate) fn named(names: &[String]) -> Result<MarginKinds, String> {
    let read = |name: &String| Name::from_str(name, true).map_err(|_| name.clone());
    let names = names
        .iter()
        .map(read)
        .collect::<Result<Vec<Name>, String>>()?;
    Ok(kinds(&names))
}

/// Returns the margin with this name whose sensitivity can be computed; `None` if there is none.
#[cfg(feature = "python")]
pub(crate) fn varied(name: &str) -> Option<MarginKind> {
    Varied::from_str(name, true).ok().map(Varied::kind)
}

/// Joins the option `--margins` and a list in the next word to one word, `--margins=LIST`.
///
/// `check --margins scene.json` requests all margins, and `check --margins friction,tilt scene.json` requests two.
/// The word after `--margins` is a list if it looks like names, unless a file has this name.
pub(crate) fn join_list(words: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    for word in words {
        if let (Some(last), Some(list)) = (joined.last_mut(), word.to_str())
            && last == "--margins"
            && is_list(list)
        {
            last.push("=");
            last.push(list);
        } else {
            joined.push(word);
        }
    }
    joined
}

fn is_list(word: &str) -> bool {
    let letters = |c: char| c.is_ascii_lowercase() || matches!(c, ',' | '-' | '_');
    !word.starts_with('-') && word.chars().all(letters) && !Path::new(word).exists()
}
