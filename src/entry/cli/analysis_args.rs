//! [`AnalysisArgs`]: the options `--accuracy`, `--wedging`, `--contact-tolerance` and `--time-limit`, which `check`,
//! `batch`, `render`, `report` and `export` share.

use std::time::Duration;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::clock::Instant;
use crate::mechanics::analysis::{Accuracy, Options};

/// The options of an analysis.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct AnalysisArgs {
    /// How strict the proof of a verdict must be; proved is stricter than standard by a factor of 100 for forces and
    /// 1000 for motions
    #[arg(long, value_name = "LEVEL", default_value = "standard", value_parser = accuracy_parser())]
    accuracy: Accuracy,
    /// Test whether each standing frame stands only by wedging: by a self-stress that its loads do not build up from
    /// rest
    #[arg(long)]
    wedging: bool,
    /// Edges within this many metres touch, and bodies may overlap by up to this depth. It replaces the scene's
    /// `contact_tolerance`, or the value that is estimated from its coordinates
    #[arg(long, value_name = "METRES", value_parser = length)]
    pub(crate) contact_tolerance: Option<f64>,
    /// Stop solving after this many seconds; frames that are not decided by then are undecided
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<Duration>,
}

impl AnalysisArgs {
    /// True if `--wedging` was given.
    pub(crate) fn requests_wedging(self) -> bool {
        self.wedging
    }

    /// Returns the name and the value of each of the four options of [`AnalysisArgs`]. A resume file records these
    /// values, because the results of a batch depend on them.
    pub(crate) fn described(self) -> [(&'static str, String); 4] {
        let level = match self.accuracy {
            Accuracy::Standard => "standard",
            Accuracy::Proved => "proved",
        };
        let tolerance = self.contact_tolerance.map(|metres| format!("{metres} m"));
        let limit = self.time_limit.map(|limit| format!("{limit:?}"));
        [
            ("--accuracy", level.to_owned()),
            ("--wedging", if self.wedging { "yes" } else { "no" }.into()),
            ("--contact-tolerance", tolerance.unwrap_or_else(|| "not given".into())),
            ("--time-limit", limit.unwrap_or_else(|| "not given".into())),
        ]
    }

    /// Returns the options of the analysis, without the contact tolerance, which the reader of the scene applies. The
    /// time limit starts at this call.
    pub(crate) fn options(self) -> Options {
        Options {
            accuracy: self.accuracy,
            wedging: self.wedging,
            deadline: self.time_limit.and_then(|limit| Instant::now().checked_add(limit)),
            ..Options::default()
        }
    }
}

/// Returns the parser for the value of `--accuracy`. The parser refuses the removed level `draft`, with a message that
/// names the level to use instead.
fn accuracy_parser() -> impl TypedValueParser<Value = Accuracy> {
    let names = ["standard", "proved", "draft"];
    let values = names.map(|name| PossibleValue::new(name).hide(name == "draft"));
    PossibleValuesParser::new(values).try_map(|name| match name.as_str() {
        "proved" => Ok(Accuracy::Proved),
        "draft" => Err("the level \"draft\" was removed because it was not faster; use \"standard\", the default"),
        _ => Ok(Accuracy::Standard),
    })
}

fn length(typed: &str) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(metres) if (0.0..=1e12).contains(&metres) => Ok(metres),
        _ => Err("give a length in metres, from 0 to 1e12".into()),
    }
}

fn seconds(typed: &str) -> Result<Duration, String> {
    match typed.parse::<f64>() {
        Ok(seconds) if (0.0..=1e6).contains(&seconds) => Ok(Duration::from_secs_f64(seconds)),
        _ => Err("give a time in seconds, from 0 to 1000000".into()),
    }
}
