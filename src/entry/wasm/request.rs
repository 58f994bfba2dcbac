//! What the functions for JavaScript return: results as JSON, and figures as SVG.

use super::Refusal;
use crate::entry::request::{CheckArgs, FigureArgs, Refused, in_json};
use crate::entry::value::{Background, FrameChoice, ThemeName, between, millimetres};
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::Sketch;
use crate::pictures::drawing::style::format::Notation;
use crate::pictures::drawing::{Drawing, Theme};
use crate::pictures::output::{page_width, svg};
use crate::products::figure;
use crate::products::result::{Layout, Timing, to_json, to_json_of, to_json_with_blocks};

request! {
    /// What an analysis computes, and what its JSON contains.
    #[derive(Clone, Debug)]
    pub(crate) struct ResultArgs(given) {
        what: CheckArgs = CheckArgs::read(given), command(flatten);
        /// Whether the JSON contains times.
        timing: bool = given.flag("timing"), arg(skip);
        /// Whether the JSON contains the placed blocks.
        blocks: bool = given.flag("blocks"), arg(skip);
        /// The name of the scene file in the JSON.
        file: Option<String> = given.text("file"), arg(skip);
    }
}

request! {
    /// A figure on its page.
    #[derive(Clone, Debug)]
    pub(crate) struct PageArgs(given) {
        figure: FigureArgs = FigureArgs::read(given), command(flatten);
        /// The frame that is drawn; without a choice all frames.
        frame: Option<FrameChoice> = given.value("frame", str::parse), arg(skip);
        /// The theme.
        theme: Option<ThemeName> = given.word("theme"), arg(skip);
        /// The text of a style file, which changes the theme.
        style: Option<String> = given.text("style"), arg(skip);
        /// The width in print, millimetres.
        width_mm: Option<f64> = given.value("width_mm", millimetres), arg(skip);
        /// The width of the page, pixels.
        width_px: Option<f64> = given.value("width_px", pixels), arg(skip);
        /// The colour of the page.
        background: Option<Background> = given.value("background", str::parse), arg(skip);
        /// Whether only the outlines of a scene are drawn, which may be invalid, with its problems.
        broken: bool = given.flag("broken"), arg(skip);
    }
}

impl ResultArgs {
    /// Returns an analysis as the JSON of `drystone check --json`.
    pub(super) fn written(&self, analysis: &Analysis) -> String {
        let timing = if self.timing { Timing::Included } else { Timing::LeftOut };
        match (self.blocks, self.file.as_deref()) {
            (true, file) => to_json_with_blocks(file, analysis, timing, Layout::Lines),
            (false, Some(file)) => to_json_of(file, analysis, timing, Layout::Lines),
            (false, None) => to_json(analysis, timing, Layout::Lines),
        }
    }
}

impl PageArgs {
    /// Analyses a scene and draws it as SVG.
    pub(super) fn figure(&self, text: &str) -> Result<String, Refusal> {
        let level = &self.figure.level;
        if self.broken {
            let sketch = Sketch::from_bytes(text.as_bytes(), level.contact_tolerance);
            return self.svg(figure::broken(&sketch, &self.options()?));
        }
        let scene = level.scene(text, self.frame)?;
        self.page(&self.figure.analysed(&scene, level.options()).map_err(Refused::from)?)
    }

    /// Draws an existing analysis as SVG. If the figure shows results that the analysis lacks, the scene is analysed
    /// again.
    pub(super) fn drawn(&self, analysis: &Analysis) -> Result<String, Refusal> {
        self.page(&self.figure.completed(analysis).map_err(Refused::from)?)
    }

    /// Draws an analysis that has all results for the figure.
    fn page(&self, analysis: &Analysis) -> Result<String, Refusal> {
        let options = self.figure.for_scene(&self.options()?, analysis.given()).map_err(Refused::from)?;
        self.svg(figure::draw(analysis, self.figure.kind(), &options))
    }

    fn options(&self) -> Result<figure::Options, Refusal> {
        let base = self.theme.map(ThemeName::theme);
        let theme = match &self.style {
            None => base.unwrap_or_default(),
            Some(text) => Theme::read(text, Notation::Json, base.as_ref())
                .map_err(|problems| Refusal::from(format!("style: {problems}")))?,
        };
        let options = self.figure.options(theme, self.width_px.or(self.width_mm.map(page_width)));
        options.map_err(|why| in_json(&why).into())
    }

    fn svg(&self, drawing: Drawing) -> Result<String, Refusal> {
        let page = Background::under(self.background, drawing);
        let options = svg::Options { width_mm: self.width_mm, ..svg::Options::default() };
        svg::write_with(&page, &options).map_err(|error| error.to_string().into())
    }
}

/// Parses the width of a page.
fn pixels(typed: &str) -> Result<f64, String> {
    between(typed, [100.0, 20_000.0], || "it must be a width in pixels, from 100 to 20000".into())
}
