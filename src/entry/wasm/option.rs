//! The options of the functions for JavaScript, read from JSON.

use std::time::Duration;

use serde::Deserialize;

use super::Refusal;
use crate::clock::Instant;
use crate::mechanics::analysis::{Accuracy, Analysis, MarginKind, MarginKinds, Options, typed_capacity};
use crate::mechanics::scene::format::parsed;
use crate::mechanics::scene::{Scene, SceneError};

/// Reads options from JSON text. Without text, all options have their default values.
pub(super) fn read<T: Default + for<'a> Deserialize<'a>>(text: Option<&str>) -> Result<T, Refusal> {
    match text {
        None => Ok(T::default()),
        Some(text) => parsed(text).map_err(|why| Refusal::of_option(format!("options: {why}"))),
    }
}

/// The options of `check`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct CheckOptions {
    pub(super) margins: Margins,
    wedging: bool,
    verdict_only: bool,
    accuracy: Level,
    pub(super) contact_tolerance: Option<f64>,
    time_limit: Option<f64>,
    pub(super) frame: Option<FrameChoice>,
    pub(super) no_notes: bool,
    pub(super) timing: bool,
    pub(super) blocks: bool,
    pub(super) file: Option<String>,
    capacity: Option<String>,
    for_all: Option<String>,
    sensitivity: Option<SensitivityMargin>,
}

impl CheckOptions {
    /// Reads a scene, and analyses it. The time limit starts at this call.
    pub(super) fn analysis(&self, text: &str) -> Result<Analysis, Refusal> {
        let analysis_options = self.analysis_options()?;
        let scene = scene(text, self.contact_tolerance, self.frame)?;
        let (capacity, for_all) = (self.capacity.as_deref(), self.for_all.as_deref());
        let analysis_options = with_capacity(analysis_options, &scene, capacity, for_all)?;
        Ok(Analysis::with(scene, &analysis_options))
    }

    /// Returns the options of the analysis that do not depend on the scene.
    fn analysis_options(&self) -> Result<Options, Refusal> {
        let mut analysis_options =
            Options::default().accuracy(self.accuracy.accuracy()).wedging(self.wedging).verdict_only(self.verdict_only);
        analysis_options.deadline = deadline(self.time_limit)?;
        if let Some(kinds) = self.margins.kinds() {
            analysis_options = analysis_options.margins(true).margin_kinds(kinds);
        }
        analysis_options.sensitivity = self.sensitivity.map(|margin| margin.0);
        Ok(analysis_options)
    }
}

/// Adds the request to compute the forces that a block can carry, if `capacity` names a block.
pub(super) fn with_capacity(
    analysis_options: Options,
    scene: &Scene,
    capacity: Option<&str>,
    for_all: Option<&str>,
) -> Result<Options, Refusal> {
    match (capacity, for_all) {
        (None, None) => Ok(analysis_options),
        (None, Some(_)) => {
            Err(Refusal::of_option("for_all limits the forces that a block can carry, so it needs capacity too"))
        }
        (Some(typed), cases) => match typed_capacity(scene, typed, cases) {
            Ok(request) => Ok(analysis_options.capacity(request)),
            // The message names options as on the command line, with hyphens. Use the names of this interface.
            Err(why) => Err(Refusal::of_option(match why.strip_prefix("--for-all") {
                Some(rest) => format!("for_all{rest}"),
                None => why.trim_start_matches('-').to_owned(),
            })),
        },
    }
}

/// Returns the time at which an analysis must stop if it may take `time_limit` seconds from now. `None` if there is no
/// limit.
pub(super) fn deadline(time_limit: Option<f64>) -> Result<Option<Instant>, Refusal> {
    match time_limit {
        Some(seconds) if !(0.0..=1e6).contains(&seconds) => {
            Err(Refusal::of_option("time_limit is a time in seconds, from 0 to 1000000"))
        }
        limit => Ok(limit.and_then(|s| Instant::now().checked_add(Duration::from_secs_f64(s)))),
    }
}

/// Reads a scene. `tolerance`, in metres, replaces the contact tolerance of the file. With `frame`, the scene keeps
/// only this frame.
pub(super) fn scene(text: &str, tolerance: Option<f64>, frame: Option<FrameChoice>) -> Result<Scene, Refusal> {
    if tolerance.is_some_and(|metres| !(0.0..=1e12).contains(&metres)) {
        return Err(Refusal::of_option("contact_tolerance is a length in metres, at least 0"));
    }
    let scene: Result<Scene, SceneError> = Scene::from_json_within(text, tolerance);
    let mut scene = scene?;
    if let Some(choice) = frame {
        let count = scene.frames.len();
        let number = match choice {
            FrameChoice::Number(number) => number,
            FrameChoice::Last(_) => count,
        };
        if !(1..=count).contains(&number) {
            let why = format!("there is no frame {number}: frames have numbers from 1 to {count}");
            return Err(Refusal::of_option(why));
        }
        scene.frames = vec![scene.frames[number - 1].clone()];
    }
    Ok(scene)
}

/// The choice of a frame: its number from 1, or "last".
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged, expecting = "a frame is a number from 1, or \"last\"")]
pub(super) enum FrameChoice {
    Number(usize),
    Last(Last),
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Last {
    Last,
}

/// The level of accuracy, which determines how strict the proofs are.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Level {
    #[default]
    Standard,
    Proved,
}

impl Level {
    pub(super) fn accuracy(self) -> Accuracy {
        match self {
            Level::Standard => Accuracy::Standard,
            Level::Proved => Accuracy::Proved,
        }
    }
}

/// The margins to compute: all, none, or those of a list.
#[derive(Clone, Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "margins are true, false, or a list of friction, tilt, horizontal_load, kernel, load_factor and robots"
)]
pub(super) enum Margins {
    Whether(bool),
    These(Vec<Margin>),
}

impl Default for Margins {
    fn default() -> Margins {
        Margins::Whether(false)
    }
}

impl Margins {
    fn kinds(&self) -> Option<MarginKinds> {
        match self {
            Margins::Whether(false) => None,
            Margins::Whether(true) => Some(MarginKinds::ALL),
            Margins::These(list) => {
                let kinds: Vec<MarginKind> = list.iter().map(|margin| margin.0).collect();
                Some(MarginKinds::new(&kinds))
            }
        }
    }
}

/// A margin, by its name in results.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Margin(MarginKind);

impl TryFrom<String> for Margin {
    type Error = String;

    fn try_from(word: String) -> Result<Margin, String> {
        let kind = MarginKind::from_word(&word).map(Margin);
        kind.ok_or_else(|| {
            let why = "margins are friction, tilt, horizontal_load, kernel, load_factor and robots";
            format!("there is no margin {word:?}; {why}")
        })
    }
}

/// A margin whose sensitivity can be computed, by its name in results.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct SensitivityMargin(pub MarginKind);

impl TryFrom<String> for SensitivityMargin {
    type Error = String;

    fn try_from(word: String) -> Result<SensitivityMargin, String> {
        let kind = MarginKind::from_word(&word).filter(|kind| kind.has_sensitivity());
        kind.map(SensitivityMargin).ok_or_else(|| {
            let known = "load_factor, tilt, horizontal_load, friction and kernel";
            format!("a sensitivity can be computed for the margins {known}, not for {word:?}")
        })
    }
}
