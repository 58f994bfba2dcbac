//! [`Entry`]: the content of a report on one scene: text, numbers and drawings without markup.
//!
//! An entry is made once from an analysis. The writers for HTML, Markdown and PDF read the entry only, so their contents
//! agree. Text from scene files is reduced to one safe line here ([`text::line`]), and each writer escapes it for its
//! format.

mod bullet;
mod chosen;
mod comparison;
mod cost;
mod grid;
mod row;
mod step;
mod touch;

pub use bullet::{BarEnd, MarginBar};
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

/// The options of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportOptions {
    /// The theme of the figures.
    pub theme: Theme,
    /// The name of the theme if the user chose one; the commands in the report repeat it.
    pub theme_name: Option<String>,
    /// Whether it reports solving times.
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

/// A scene file: its name as given by the user, and its text.
#[derive(Clone, Copy, Debug)]
pub struct File<'f> {
    /// The path as given; `-` for standard input.
    pub name: &'f str,
    /// The text of the file.
    pub text: &'f str,
}

/// The content of a report on one scene.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its row in the table of all scenes.
    pub row: Row,
    /// Sentences about the whole scene.
    pub remarks: Vec<String>,
    /// Its steps, one per frame.
    pub steps: Vec<Step>,
    /// Charts over its steps; empty for a single step.
    pub charts: Vec<Chart>,
    /// The accuracy study of the scene, if requested.
    pub study: Option<Chart>,
    /// Commands that draw its figures again: the purpose and the command.
    pub commands: Vec<(String, String)>,
    /// The scene file for copying: the same values, with escaped characters.
    pub source: String,
    /// The objects of `check --json`, one line each.
    pub results: Vec<String>,
}

/// A figure with its caption.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The caption.
    pub caption: String,
    /// The figure.
    pub drawing: Drawing,
}

/// A chart as an SVG document, with its caption.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The caption.
    pub caption: String,
    /// The SVG.
    pub svg: String,
}

impl Chart {
    /// The SVG with the namespace that a file needs.
    pub(crate) fn document(&self) -> Cow<'_, str> {
        if self.svg.contains("xmlns=") {
            return Cow::Borrowed(&self.svg);
        }
        let head = "<svg xmlns=\"http://www.w3.org/2000/svg\"";
        Cow::Owned(self.svg.replacen("<svg", head, 1))
    }
}

impl Entry {
    /// The content of a report on an analysis.
    pub fn new(file: File<'_>, analysis: &Analysis, options: &ReportOptions) -> Entry {
        let steps = step::all(analysis, options);
        Entry {
            row: Row::new(file.name, analysis),
            remarks: analysis
                .scene
                .tolerance_words()
                .iter()
                .map(|words| text::line(words))
                .chain(chosen::left_out(analysis))
                .collect(),
            charts: step_charts(analysis),
            study: None,
            commands: commands(file.name, analysis, options),
            source: text::json(file.text),
            results: vec![result(file.name, analysis, options.timing)],
            steps,
        }
    }

    /// Adds the accuracy study of the scene.
    ///
    /// # Errors
    /// If the text of the picture cannot be laid out.
    pub fn add_study(&mut self, study: &Study) -> Result<(), OutlineError> {
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

/// The result of the scene as JSON in one line, like `check --json`.
fn result(name: &str, analysis: &Analysis, timing: Timing) -> String {
    let object = to_json_of(name, analysis, timing, Layout::OneLine);
    object.trim_end().to_owned()
}

/// Commands that draw the figures of a scene again.
fn commands(name: &str, analysis: &Analysis, options: &ReportOptions) -> Vec<(String, String)> {
    let theme = options
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

/// Charts over the steps of a scene: forces, tilt, friction.
fn step_charts(analysis: &Analysis) -> Vec<Chart> {
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
        _ => "Total force and total sticking over the steps",
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
            "Largest tilt (the smaller of left and right) over the steps",
            "degrees",
            vec![("tilt".to_owned(), blue, tilt.collect())],
        ));
        charts.push((
            "Least friction coefficient with which it stands, over the steps",
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
        // A chart without any number is left out.
        let svg = chart::course(&chart).ok()?;
        Some(Chart {
            caption: caption.to_owned(),
            svg,
        })
    });
    drawn.collect()
}
