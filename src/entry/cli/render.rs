//! `drystone render`: draws figures of scenes.

mod args;
mod broken;
mod choice;
#[cfg(feature = "python")]
pub(in crate::entry) mod embedded;
mod output;
mod pair;
mod target;

use std::path::{Path, PathBuf};

use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

pub(crate) use args::Render;
use choice::KindChoice;
use output::{Rendered, all, summary, without_faults};
use target::paths;

use crate::entry::cli::destination::{self, Destination};
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::picture::{Format, or_split};
use crate::entry::cli::progress::{BarVisibility, Progress};
use crate::entry::cli::source::{self, Source};
use crate::entry::cli::terminal::Terminal;
use crate::entry::cli::watch;
use crate::mechanics::analysis::{self, Analysis, Toward};
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Drawing, Theme};
use crate::pictures::output::animation;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;

/// A strip of more frames than this may be too large for a PNG.
const MAX_PNG_FRAMES: usize = 50;
/// The width of an animation in pixels, if the command line gives none.
const ANIMATION_WIDTH: u32 = 800;
/// A strip higher than this many page heights does not fit on a page.
const MAX_PAGE_HEIGHTS: f64 = 1.02;

impl Render {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        if !self.watch {
            return self.once(terminal);
        }
        let mut files = source::files(&self.scenes).map_err(|c| vec![c])?;
        if files.iter().any(|file| file == Path::new("-")) {
            let why = "--watch needs files; standard input (-) cannot be read again";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        files.extend(self.look.file().map(Path::to_path_buf));
        watch::repeat(&files, terminal, || self.once(terminal))
    }

    /// Draws all figures once: checks the options, reads the scenes, draws in parallel, and writes the files.
    fn once(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let one = |complaint| vec![complaint];
        let destination = Destination::from_path(&self.output);
        let format = destination.format(self.picture.requested_format()).map_err(one)?;
        self.check_kind(format).map_err(one)?;
        let scenes = source::files(&self.scenes).map_err(one)?;
        self.check_count(&scenes, &destination, format, terminal).map_err(one)?;
        self.check_parts(&destination).map_err(one)?;
        let fonts = self.picture.fonts().map_err(one)?;
        if self.broken {
            return self.sketched(&scenes, &destination, format, &fonts, terminal);
        }
        let (theme, (sources, mut faults)) = match (
            self.look.theme(),
            source::read_apart_from_faults(&scenes, self.frame, self.level.contact_tolerance),
        ) {
            (Ok(theme), Ok(sources)) => (theme, sources),
            (theme, sources) => {
                let scenes = sources.err().into_iter().flatten();
                return Err(theme.err().into_iter().chain(scenes).collect());
            }
        };
        let joins = self.joins(scenes.len(), &destination);
        if sources.is_empty() || (joins && !faults.is_empty()) {
            return Err(faults);
        }
        let read: Vec<&Path> = sources.iter().map(|source| source.path.as_path()).collect();
        let paths = paths(&destination, &read, format).map_err(one)?;
        let inputs: Vec<&Path> = read.into_iter().chain(self.look.file()).collect();
        destination::refuse_overwrites(&paths, &inputs).map_err(one)?;

        let options = self.options(theme);
        let rendered = self.render_all(&sources, joins, &options, format, &fonts, terminal);
        let (rendered, paths) = without_faults(rendered, paths, &mut faults);
        if rendered.is_empty() {
            return Err(faults);
        }
        let rendered = all(rendered)?;
        let ending = rendered.iter().map(|r| r.ending).max();
        if self.picture.draws_words(format) {
            missing_glyphs::warn(&sources, &fonts, terminal);
        }
        self.write(rendered, &destination, &paths, terminal).map_err(one)?;
        for fault in &faults {
            terminal.refuse(fault);
        }
        Ok(match (faults.is_empty(), self.strict) {
            (false, _) => ExitStatus::WrongInput,
            (true, true) => ending.unwrap_or(ExitStatus::Done),
            (true, false) => ExitStatus::Done,
        })
    }

    /// Refuses options that do not fit the kind of figure or the format.
    fn check_kind(&self, format: Format) -> Result<(), CliError> {
        self.picture.check(format)?;
        let is_freebody = self.kind == KindChoice::Freebody;
        let why = if self.block.is_some() && !is_freebody {
            "--block names the block of a free-body diagram; add --kind freebody"
        } else if self.corners && !is_freebody {
            "--corners applies to the forces of a free-body diagram; add --kind freebody"
        } else if self.animate.is_some() && (format.animate().is_none() || self.kind.panels().is_none()) {
            "--animate makes a GIF or PNG of the frames of a figure; write a .gif or .png, of any kind but freebody"
        } else {
            return Ok(());
        };
        Err(CliError::CommandLine(why.into()))
    }

    /// Refuses `--margin` and `--capacity` for figures that cannot show the requested margin or the capacity. Refuses
    /// `--panels` and `--pages` for free-body diagrams and for standard output.
    fn check_parts(&self, destination: &Destination) -> Result<(), CliError> {
        let is_stdout = matches!(destination, Destination::Stdout);
        let varies = self.kind.needs_sensitivity();
        let why = if self.margin.is_some() && !self.kind.needs_margins() && !varies {
            "--margin selects the margin of a figure; add --kind margin or --kind sensitivity"
        } else if self.margin.is_some() && self.toward().is_none() && !varies {
            "--kind margin cannot show the margins friction and kernel; use --kind sensitivity"
        } else if self.capacity.are_requested() && !self.kind.needs_capacity() {
            "--capacity selects the block of a capacity figure; add --kind capacity"
        } else if self.writes_parts() && (self.kind.panels().is_none() || is_stdout) {
            "--panels and --pages write the parts of a figure to files; give a file or folder, and any kind but freebody"
        } else {
            return Ok(());
        };
        Err(CliError::CommandLine(why.into()))
    }

    /// True if each figure is written as several files, with `--panels` or `--pages`.
    fn writes_parts(&self) -> bool {
        self.panels || self.pages
    }

    /// Analyses and draws the scenes in parallel. If `joins` is true, two scenes become one figure that compares them.
    fn render_all(
        &self,
        sources: &[Source],
        joins: bool,
        options: &figure::Options,
        format: Format,
        fonts: &Fonts,
        terminal: &Terminal,
    ) -> Vec<Result<Rendered, CliError>> {
        let shown = if terminal.shows_progress() { BarVisibility::WhenLong } else { BarVisibility::Never };
        let progress = Progress::begin(2 * sources.len(), shown);
        let mut analysis_options = self.level.options();
        analysis_options.margins = self.kind.needs_margins();
        match sources {
            [before, after] if joins => {
                let work = || self.compared([before, after], &analysis_options, options, format, fonts);
                vec![source::isolated(&after.path, work).flatten()]
            }
            sources => {
                let one = |source: &Source| {
                    let work = || self.render(source, &analysis_options, options, format, fonts, &progress);
                    source::isolated(&source.path, work).flatten()
                };
                sources.par_iter().map(one).collect()
            }
        }
    }

    /// Returns an error if several figures would go to one file or to standard output, or if binary data would be
    /// printed to a terminal. Does not read the scenes.
    fn check_count(
        &self,
        scenes: &[PathBuf],
        destination: &Destination,
        format: Format,
        terminal: &Terminal,
    ) -> Result<(), CliError> {
        if self.joins(scenes.len(), destination) {
            return match (destination, format.unreadable()) {
                (Destination::Stdout, Some(why)) if terminal.is_watched() => Err(CliError::CommandLine(why)),
                _ => Ok(()),
            };
        }
        let why = match destination {
            Destination::File(path) if scenes.len() > 1 => {
                let (count, shown) = (scenes.len(), path.display());
                format!(
                    "{count} scenes cannot be written to the one file {shown}; give a folder, with a slash at the end of its name"
                )
            }
            Destination::Stdout if scenes.len() > 1 => {
                "only one picture can be written to standard output; give a folder".into()
            }
            Destination::Stdout if terminal.is_watched() => match format.unreadable() {
                Some(why) => why,
                None => return Ok(()),
            },
            _ => return Ok(()),
        };
        Err(CliError::CommandLine(why))
    }

    fn render(
        &self,
        source: &Source,
        analysis_options: &analysis::Options,
        options: &figure::Options,
        format: Format,
        fonts: &Fonts,
        progress: &Progress,
    ) -> Result<Rendered, CliError> {
        progress.doing(&source.name());
        let options = &self.zoomed(source, options)?;
        let scene = if self.picture.draws_words(format) {
            missing_glyphs::legible(&source.scene, fonts)
        } else {
            source.scene.clone()
        };
        let analysis_options = self.with_requests(analysis_options, &scene)?;
        let analysis = self.analysed(&scene, &analysis_options);
        progress.step();
        let mut summary = summary(&analysis);
        let kind = self.kind.panels();
        let split = |complaint| match kind {
            Some(_) => or_split(complaint, analysis.frames.len()),
            None => complaint,
        };
        if let (Some(kind), Format::Png) = (kind, format)
            && !self.writes_parts()
            && analysis.frames.len() > MAX_PNG_FRAMES
        {
            // Check the size before the layout, which takes a long time for a figure with many frames.
            let size = figure::least_size(&analysis, kind, options);
            self.picture.check_png(size).map_err(split)?;
        }
        let bytes = match (self.animate, kind) {
            (None, Some(kind)) if self.writes_parts() => {
                let parts = self.parts(&analysis, kind, options);
                let one = |part| self.picture.bytes(part, format, fonts);
                parts.into_iter().map(one).collect::<Result<_, _>>()?
            }
            (Some(seconds), kind) => {
                let film = figure::film(&analysis, kind.unwrap_or_default(), options, seconds);
                let animate = format.animate().unwrap_or(animation::gif);
                let picture = self.picture.clone().or_width(ANIMATION_WIDTH, format);
                vec![picture.animated(film, animate, fonts)?]
            }
            (None, kind) => {
                let drawing = self.drawing(source, &analysis, options)?;
                let high = self.picture.page_ratio() * drawing.width;
                if kind.is_some() && analysis.frames.len() > 1 && drawing.height > MAX_PAGE_HEIGHTS * high {
                    summary.push_str("; taller than an A4 page, --pages splits it");
                }
                let bytes = self.picture.bytes(drawing, format, fonts);
                vec![bytes.map_err(split)?]
            }
        };
        progress.step();
        Ok(Rendered { bytes, ending: ExitStatus::from_analysis(&analysis), summary })
    }

    /// Returns the options with the block that `--zoom` names.
    fn zoomed(&self, source: &Source, options: &figure::Options) -> Result<figure::Options, CliError> {
        let mut options = options.clone();
        if let Some(name) = &self.zoom {
            let wrong = |why| CliError::CommandLine(format!("{}: {why}", source.name()));
            options.zoom = Some(figure::named_block(&source.scene, name).map_err(wrong)?);
        }
        Ok(options)
    }

    /// Draws the pages or the panels of a figure.
    fn parts(&self, analysis: &Analysis, kind: figure::Kind, options: &figure::Options) -> Vec<Drawing> {
        if self.pages {
            figure::split(analysis, kind, options, self.picture.page_ratio())
        } else {
            figure::panels(analysis, kind, options)
        }
    }

    /// Returns the analysis options with the block of `--capacity` and the ranges of `--for-all`. If the figure shows
    /// the sensitivity of a margin, the options also name the margin of `--margin`.
    fn with_requests(
        &self,
        analysis_options: &analysis::Options,
        scene: &Scene,
    ) -> Result<analysis::Options, CliError> {
        let mut analysis_options = self.capacity.add_to(*analysis_options, scene)?;
        if self.kind.needs_sensitivity() {
            analysis_options.sensitivity = self.margin.map(|margin| margin.0);
        }
        Ok(analysis_options)
    }

    /// Returns the parameter of the margin that `--margin` names: tilt, horizontal load or load factor. Returns `None`
    /// without this option, and for the margins of friction and kernel.
    fn toward(&self) -> Option<Toward> {
        self.margin.and_then(|margin| Toward::from_margin(margin.0))
    }

    /// Analyses a scene, and also computes the margins, the sensitivity or the capacity that this kind of figure shows.
    fn analysed(&self, scene: &Scene, analysis_options: &analysis::Options) -> Analysis {
        match self.kind.panels() {
            Some(kind) => kind.analysed(scene, analysis_options),
            None => Analysis::with(scene, analysis_options),
        }
    }

    fn drawing(&self, source: &Source, analysis: &Analysis, options: &figure::Options) -> Result<Drawing, CliError> {
        if let Some(kind) = self.kind.panels() {
            return Ok(figure::draw(analysis, kind, options));
        }
        let (frame, block) = figure::free_block(&source.scene, self.block.as_deref())
            .map_err(|why| CliError::CommandLine(format!("{}: {why}", source.name())))?;
        let drawing = figure::freebody(analysis, frame, block, options);
        Ok(drawing.expect("the block was found in this frame"))
    }

    fn options(&self, theme: Theme) -> figure::Options {
        figure::Options {
            style: self.arrows.figure(),
            normalisation: self.normalise.figure(),
            scale: self.arrow_scale.figure(),
            fill: self.fill.figure(),
            toward: self.toward().unwrap_or_default(),
            titles: !self.no_title,
            captions: !self.no_caption,
            verdicts: !self.no_verdict,
            keys: !self.no_key,
            scale_bar: self.scale_bar,
            dimensions: self.dimensions,
            with_polygon: self.with_polygon,
            corners: if self.corners { figure::Corners::All } else { figure::Corners::Few },
            columns: self.columns.map(usize::from),
            amounts: self.amounts,
            width: self.picture.page(),
            theme,
            ..figure::Options::default()
        }
    }
}
