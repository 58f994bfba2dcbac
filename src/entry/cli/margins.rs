//! [`MarginArgs`]: the option `--margins` and its optional list, which `check` and `batch` share.

use std::ffi::OsString;
use std::path::Path;

use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};

use crate::mechanics::analysis::{MarginKind, MarginKinds, Options};

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
    margins: Option<Vec<MarginKind>>,
}

impl ValueEnum for MarginKind {
    fn value_variants<'a>() -> &'a [MarginKind] {
        &MarginKind::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let name = match self {
            MarginKind::HorizontalLoad => "horizontal-load",
            MarginKind::LoadFactor => "load-factor",
            kind => kind.word(),
        };
        let value = PossibleValue::new(name);
        Some(match name == self.word() {
            true => value,
            false => value.alias(self.word()),
        })
    }
}

/// A margin whose sensitivity can be computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SensitivityMargin(pub MarginKind);

impl ValueEnum for SensitivityMargin {
    fn value_variants<'a>() -> &'a [SensitivityMargin] {
        &[
            SensitivityMargin(MarginKind::LoadFactor),
            SensitivityMargin(MarginKind::Tilt),
            SensitivityMargin(MarginKind::HorizontalLoad),
            SensitivityMargin(MarginKind::Friction),
            SensitivityMargin(MarginKind::Kernel),
        ]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        self.0.to_possible_value()
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
            Some(names) => Options { margins: true, margin_kinds: kinds(names), ..options },
        }
    }

    /// Returns the requested margins as text: `none`, `all`, or their names separated by commas.
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

/// Returns the set of the listed margins. An empty list means all margins.
fn kinds(names: &[MarginKind]) -> MarginKinds {
    match names {
        [] => MarginKinds::ALL,
        names => MarginKinds::new(names),
    }
}

/// Joins the option `--margins` and a list in the next argument into one argument, `--margins=LIST`.
///
/// `check --margins scene.json` requests all margins, and `check --margins friction,tilt scene.json` requests two. The
/// argument after `--margins` is taken as a list if it looks like names, unless a file with this name exists.
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
