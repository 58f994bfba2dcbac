//! [`Entry`]: the content of a report on one scene: text, numbers and drawings without markup.
//!
//! An entry is made once from an analysis. Its main content is a list of [`Section`]s, which consist of [`SheetPart`]s.
//! The writers for HTML, Markdown and PDF read only the entry, so their contents agree. In an entry, each name or title
//! from a scene file is one line without control characters ([`text::line`]). Each writer escapes it for its format.

mod balance;
mod bullet;
mod collapse;
mod comparison;
mod inputs;
mod joints;
mod part;
mod row;
mod sheet;
mod steps;
mod hover;
mod unit;

pub use bullet::{BarEnd, MarginBar};
pub use comparison::{Side, compared};
pub use hover::{HoverTarget, touched};
pub use part::{Badge, Chart, Figure, Grid, Line, Section, SheetPart, TableCell};
pub use row::{Row, Thumbnail};

use crate::mechanics::analysis::{Analysis, Verdict};
use crate::pictures::chart::ChartError;
use crate::pictures::drawing::{Drawing, Theme};
use crate::products::report::accuracy;
use crate::products::result::{Layout, Timing, accuracy_json, to_json_of};
use crate::products::study::Case;
use crate::text;

/// The options of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportOptions {
    /// The theme of the figures.
    pub theme: Theme,
    /// The theme of a second drawing of each figure, for readers whose system uses dark colours. `None` for a report
    /// without second drawings.
    pub dark: Option<Theme>,
    /// The name of the theme if the user chose one. The commands that make figures repeat it.
    pub theme_name: Option<String>,
    /// Whether the report contains solving times.
    pub timing: Timing,
    /// Whether an appendix for each step lists all joints, failures and effects, and the numbers of the proof. A report
    /// that compares two scenes has no appendix.
    pub full: bool,
}

impl Default for ReportOptions {
    fn default() -> ReportOptions {
        ReportOptions { theme: Theme::default(), dark: None, theme_name: None, timing: Timing::LeftOut, full: false }
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
    /// The row of the scene in the table of all scenes.
    pub row: Row,
    /// Project, author and date, if the scene states them: `Project: …`. Empty for a comparison.
    pub details: Vec<String>,
    /// The sections of the report.
    pub sections: Vec<Section>,
    /// The version of drystone and a hash of the scene file, in one line. A comparison has the hashes of both files.
    pub origin: String,
    /// Commands that make the figures, the full report and the numbers again. Each pair has the purpose of a command
    /// and the command.
    pub commands: Vec<(String, String)>,
    /// The text of the scene file, for copying. JSON escapes replace invisible characters in it. Empty for a
    /// comparison.
    pub source: String,
    /// For each scene, the JSON object that `check --json` writes, but on one line.
    pub results: Vec<String>,
    /// The changes of a comparison, one sentence for each step; empty for a single scene.
    pub changes: Vec<String>,
}

impl Entry {
    /// Makes the content of a report from an analysis. `file` is the scene file of the analysis.
    pub fn new(file: File<'_>, analysis: &Analysis, options: &ReportOptions) -> Entry {
        let scene = analysis.given();
        let named = [("Project", &scene.project), ("Author", &scene.author), ("Date", &scene.date)];
        let details = named.into_iter().filter(|(_, words)| !words.trim().is_empty());
        Entry {
            row: Row::new(file.name, analysis),
            details: details.map(|(what, words)| text::line(&format!("{what}: {words}"))).collect(),
            sections: steps::sections(analysis, options),
            origin: format!("drystone {}, scene {}", env!("CARGO_PKG_VERSION"), hash(file.text)),
            commands: commands(file.name, analysis, options),
            source: text::json(file.text).into_owned(),
            results: vec![result(file.name, analysis, options.timing)],
            changes: Vec::new(),
        }
    }

    /// Replaces the figures by those of `other`, an entry of the same scene. In the figures of `other`, code points
    /// such as `U+4E2D` replace all characters that the fonts of drystone lack.
    pub(crate) fn take_figures(&mut self, other: Entry) {
        let others = other.sections.into_iter().flat_map(|section| section.parts);
        let mut others = others.filter(|part| matches!(part, SheetPart::Figures(_)));
        for part in self.sections.iter_mut().flat_map(|section| &mut section.parts) {
            if matches!(part, SheetPart::Figures(_))
                && let Some(drawn) = others.next()
            {
                *part = drawn;
            }
        }
    }

    /// Adds a section with a picture of numbers that vary, and what it shows in words. `picture` has the drawing, and the same
    /// one for readers whose system uses dark colours. `arguments` are those of `drystone vary`
    /// after the scene.
    pub(crate) fn add_varied(
        &mut self,
        arguments: &[String],
        [title, paragraph]: [String; 2],
        picture: Option<(Drawing, Option<Drawing>)>,
    ) {
        let parts = self.sections.iter().flat_map(|section| &section.parts);
        let count: usize = parts.map(SheetPart::count_figures).sum();
        let figure = picture.map(|(drawing, dark)| Figure {
            caption: text::line(&format!("Figure {}: {title}", count + 1)),
            drawing,
            dark,
            touches: Vec::new(),
            subject: None,
        });
        let figures = figure.into_iter().map(|figure| SheetPart::Figures(vec![figure]));
        self.sections.push(Section {
            letter: String::new(),
            title: text::line(&format!("For which values: {title}")),
            verdict: self.row.verdict,
            begins_page: false,
            parts: figures.chain([SheetPart::Text(text::line(&paragraph))]).collect(),
        });
        let word =
            |word: &str| if word.starts_with("--") { format!(" {word}") } else { format!(" {}", text::shell(word)) };
        let words = arguments.iter().map(|own| word(own)).collect::<String>();
        self.commands
            .push(("numbers that vary".to_owned(), format!("drystone vary {}{words}", text::shell(&self.row.name))));
    }

    /// Adds an accuracy study to the report: a section with the chart of the study, and its numbers in the JSON.
    ///
    /// # Errors
    /// If the chart cannot be drawn.
    pub fn add_study(&mut self, study: &[Case]) -> Result<(), ChartError> {
        let heading = accuracy::heading(study);
        let chart = Chart {
            caption: format!("What accuracy costs on this scene. {heading}"),
            svg: accuracy::svg(study)?,
            wide: true,
        };
        self.sections.push(Section {
            letter: String::new(),
            title: String::new(),
            verdict: self.row.verdict,
            begins_page: false,
            parts: vec![SheetPart::Charts(vec![chart])],
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

/// Returns a hash that identifies the text of a scene file: FNV-1a as 16 hexadecimal digits.
fn hash(file: &str) -> String {
    format!("{:016x}", text::hash(file.as_bytes()))
}

/// Returns the result of the scene as `check --json` writes it, but on one line.
fn result(name: &str, analysis: &Analysis, timing: Timing) -> String {
    let object = to_json_of(name, analysis, timing, Layout::OneLine);
    object.trim_end().to_owned()
}

/// Returns the commands that make the figures, the full report and the numbers of a scene again. Each pair has the
/// purpose of a command and the command.
fn commands(name: &str, analysis: &Analysis, options: &ReportOptions) -> Vec<(String, String)> {
    let theme = options.theme_name.as_ref().map_or(String::new(), |theme| format!(" --theme {theme}"));
    let set = analysis.given().set.iter().map(|setting| format!(" --set {}", text::shell(setting)));
    let file = text::shell(name) + &set.collect::<String>();
    let command = |kind: &str| format!("drystone render {file} -o figure.svg{kind}{theme}");
    let mut commands = vec![("the figure of forces".to_owned(), command(""))];
    let falls = analysis.frames.iter().any(|f| f.verdict == Verdict::Unstable && !f.mechanism.is_empty());
    if falls {
        commands.push(("how it falls".to_owned(), command(" --kind mechanism")));
    }
    commands.push((
        "all joints, effects and solver details".to_owned(),
        format!("drystone report --full {file} -o report.pdf"),
    ));
    commands.push(("the numbers".to_owned(), format!("drystone check --json {file}")));
    commands
}

/// Makes the table of all scenes, with links to the scenes. `compares` is true if each row compares two scenes. `pages`
/// has the page numbers of the scenes, in the order of their numbers; `None` for a report without numbered pages.
pub(crate) fn overview(rows: &[&Row], compares: bool, pages: Option<&[usize]>) -> Grid {
    let fails = if compares { "what changed" } else { "what fails" };
    let mut heads = vec!["picture", "name", "verdict", "headline margin", fails];
    heads.extend(pages.map(|_| "#page"));
    let mut grid = Grid::new("", &heads);
    for row in rows {
        let name = TableCell { scene: Some(row.number), ..row.title.clone().into() };
        let mut cells = vec![
            TableCell::picture(row.thumbnail.clone()),
            name,
            row.verdict_words().into(),
            row.margin_words().into(),
            row.fails.clone().into(),
        ];
        cells.extend(pages.and_then(|p| p.get(row.number - 1)).map(|page| TableCell::from(page.to_string())));
        grid.add("", cells);
    }
    grid
}
