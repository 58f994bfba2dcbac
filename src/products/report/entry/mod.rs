//! [`Entry`]: what a report tells of one scene, in words, numbers and drawings, without any markup.
//!
//! Made once from an analysis; every writer reads it and none asks the analysis again, so that a page, its Markdown and its
//! PDF cannot disagree. Every word that came from a file is one harmless line here already ([`text::line`]); a writer
//! still puts it through its own sink.

mod bullet;
mod chosen;
mod comparison;
mod cost;
mod grid;
mod row;
mod step;
mod touch;

pub use bullet::MarginBar;
pub use comparison::{Side, compared};
pub use grid::{Grid, Line};
pub use row::{Row, Thumbnail};
pub use step::Step;
pub use touch::{HoverTarget, touched};

use std::borrow::Cow;

use crate::analysis::Analysis;
use crate::chart::{self, Course};
use crate::drawing::{Drawing, Theme};
use crate::output::svg::OutlineError;
use crate::report::accuracy;
use crate::result::{Layout, Timing, accuracy_json, to_json_of};
use crate::study::{Study, summary};
use crate::text;
use crate::wording::number::{letter, prefixed};

/// What a report is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportOptions {
    /// Colours of the figures.
    pub theme: Theme,
    /// The theme's name where one was chosen, for the command that makes a figure again.
    pub theme_name: Option<String>,
    /// Whether it tells how long solving took.
    pub timing: Timing,
}

impl Default for ReportOptions {
    fn default() -> ReportOptions {
        ReportOptions {
            theme: Theme::default(),
            theme_name: None,
            timing: Timing::LeftOut,
        }
    }
}

/// A scene's file: its name as it was given, and its text.
#[derive(Clone, Copy, Debug)]
pub struct File<'f> {
    /// The path as given, `-` for standard input.
    pub name: &'f str,
    /// The text.
    pub text: &'f str,
}

/// What a report tells of one scene.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its line in the table of all scenes.
    pub row: Row,
    /// What is to be reported of the scene as a whole.
    pub remarks: Vec<String>,
    /// Its steps, one per frame.
    pub steps: Vec<Step>,
    /// Charts over its steps; none where there is one step.
    pub charts: Vec<Chart>,
    /// What accuracy costs on it, where that was asked for.
    pub study: Option<Chart>,
    /// Commands that make its figures again, each with what it makes.
    pub commands: Vec<(String, String)>,
    /// The scene file to copy, the same values with harmless characters.
    pub source: String,
    /// The objects of `check --json`, one line each.
    pub results: Vec<String>,
}

/// A figure and what it shows.
#[derive(Clone, Debug)]
pub struct Figure {
    /// What it shows.
    pub caption: String,
    /// The figure.
    pub drawing: Drawing,
}

/// A chart as an SVG document, and what it shows.
#[derive(Clone, Debug)]
pub struct Chart {
    /// What it shows.
    pub caption: String,
    /// The SVG.
    pub svg: String,
}

impl Chart {
    /// The SVG as a document of its own.
    pub(crate) fn document(&self) -> Cow<'_, str> {
        if self.svg.contains("xmlns=") {
            return Cow::Borrowed(&self.svg);
        }
        let head = "<svg xmlns=\"http://www.w3.org/2000/svg\"";
        Cow::Owned(self.svg.replacen("<svg", head, 1))
    }
}

impl Entry {
    /// What a report tells of an analysis.
    pub fn new(file: File<'_>, analysis: &Analysis, wanted: &ReportOptions) -> Entry {
        let steps = step::all(analysis, wanted);
        Entry {
            row: Row::new(file.name, analysis),
            remarks: analysis
                .scene
                .tolerance_words()
                .iter()
                .map(|words| text::line(words))
                .chain(chosen::left_out(analysis))
                .collect(),
            charts: courses(analysis),
            study: None,
            commands: commands(file.name, analysis, wanted),
            source: text::json(file.text),
            results: vec![result(file.name, analysis, wanted.timing)],
            steps,
        }
    }

    /// Adds what accuracy costs on the scene.
    ///
    /// # Errors
    /// Where the words of the picture cannot be laid out.
    pub fn measured(&mut self, study: &Study) -> Result<(), OutlineError> {
        self.study = Some(Chart {
            caption: format!(
                "What accuracy costs on this scene. {}",
                accuracy::heading(study)
            ),
            svg: accuracy::picture(&summary(study), study.cases.len())?,
        });
        let measured = accuracy_json(study);
        let compact = measured.lines().map(str::trim).collect::<String>();
        for result in &mut self.results {
            let rest = result.trim_start_matches('{');
            *result = format!("{{\"accuracy\":{compact},{rest}");
        }
        Ok(())
    }
}

/// The object of `check --json` in one line, with the file it was read from.
fn result(name: &str, analysis: &Analysis, timing: Timing) -> String {
    let object = to_json_of(name, analysis, timing, Layout::OneLine);
    object.trim_end().to_owned()
}

/// The commands that make a scene's figures again.
fn commands(name: &str, analysis: &Analysis, wanted: &ReportOptions) -> Vec<(String, String)> {
    let theme = wanted
        .theme_name
        .as_ref()
        .map_or(String::new(), |theme| format!(" --theme {theme}"));
    let file = text::shell(name);
    let command = |kind: &str| format!("drystone render {file} -o figure.svg{kind}{theme}");
    let mut commands = vec![("the figure of forces".to_owned(), command(""))];
    if analysis.frames.iter().any(step::has_mechanism) {
        let how = "how it falls".to_owned();
        commands.push((how, command(" --kind mechanism")));
    }
    if chosen::left_out(analysis).is_some() {
        let each = "a figure of each step".to_owned();
        commands.push((each, command(" --panels")));
    }
    commands.push((
        "the numbers".to_owned(),
        format!("drystone check --json {file}"),
    ));
    commands
}

/// Charts over the steps of a scene.
fn courses(analysis: &Analysis) -> Vec<Chart> {
    let frames = &analysis.frames;
    if frames.len() < 2 {
        return Vec::new();
    }
    let steps: Vec<String> = (0..frames.len()).map(letter).collect();
    let blue = [68, 121, 180];
    let red = [168, 0, 0];
    let totals = frames.iter().map(|f| f.total_force.max(f.total_sticking));
    let (newtons, factor) = prefixed(totals.fold(0.0, f64::max), "N");
    let mut lines = vec![(
        "forces".to_owned(),
        blue,
        frames
            .iter()
            .map(|f| Some(f.total_force * factor))
            .collect(),
    )];
    if frames.iter().any(|f| f.total_sticking > 0.0) {
        lines.push((
            "sticking".to_owned(),
            red,
            frames
                .iter()
                .map(|f| Some(f.total_sticking * factor))
                .collect(),
        ));
    }
    let caption = match lines.len() {
        1 => "Total force over the steps",
        _ => "Total force over the steps, and what would have to be glued",
    };
    let mut charts = vec![(caption, newtons.as_str(), lines)];
    if frames.iter().any(|f| f.margins.is_some()) {
        let tilt = frames.iter().map(|f| {
            let margins = f.margins.as_ref()?;
            let [left, right] = [&margins.tilt.left, &margins.tilt.right].map(|m| m.at());
            match (left, right) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            }
        });
        let friction = frames.iter().map(|f| f.margins.as_ref()?.friction.at());
        charts.push((
            "The smaller of the largest tilts to either side, over the steps",
            "degrees",
            vec![("tilt".to_owned(), blue, tilt.collect())],
        ));
        charts.push((
            "The least friction with which it stands, over the steps",
            "coefficient",
            vec![("friction".to_owned(), blue, friction.collect())],
        ));
    }
    let drawn = charts.into_iter().filter_map(|(caption, y, lines)| {
        let chart = Course {
            title: caption.to_owned(),
            y: y.to_owned(),
            steps: steps.clone(),
            lines,
        };
        // A chart of no numbers is no chart.
        let svg = chart::course(&chart).ok()?;
        Some(Chart {
            caption: caption.to_owned(),
            svg,
        })
    });
    drawn.collect()
}
