//! `drystone render`: draws figures of scenes.

mod output;
mod preview;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use output::{Rendered, paths, summary, without_faults};

use crate::entry::cli::destination::{self, Destination};
use crate::entry::cli::draw::DrawArgs;
use crate::entry::cli::error::{CliError, Ended, all_or_errors};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::missing_glyphs;
use crate::entry::cli::picture::Format;
use crate::entry::cli::progress::Progress;
use crate::entry::cli::source::{self, Source};
use crate::entry::cli::terminal::Terminal;
use crate::entry::cli::watch;
use crate::entry::value::FrameChoice;
use crate::mechanics::analysis::{self, Analysis, MarginKind, Verdict};
use crate::mechanics::scene::Scene;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;

/// Draw scenes with their forces and failures as SVG, PNG, GIF, PDF or TikZ
#[derive(Clone, Debug, Args)]
pub(crate) struct Render {
    /// Scene files, or folders of them; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// The output: a .svg, .png, .gif, .pdf or .tikz file, a folder (existing, or ending in a slash), or - for
    /// standard output; may be left out with --serve
    #[arg(short, long, value_name = "OUT", required_unless_present = "serve")]
    output: Option<PathBuf>,
    #[command(flatten)]
    draw: DrawArgs,
    /// Write every panel of a strip to a separate file, with its letter after the name
    #[arg(long, conflicts_with = "animate")]
    panels: bool,
    /// Split a long strip into A4 pages, each a separate file with its number after the name; {p} in the name, or {0p}
    /// for numbers of equal length, says where the number stands
    #[arg(long, conflicts_with_all = ["animate", "panels"])]
    pages: bool,
    /// Draw only the outlines, with the problems of a scene that is not valid marked and numbered; the exit code is 2
    /// if there are problems
    #[arg(long, conflicts_with_all = ["animate", "panels", "pages", "frame", "zoom", "block", "margin", "corners", "set"])]
    broken: bool,
    /// Draw again whenever a scene or the style file changes, until the program is stopped
    #[arg(long)]
    watch: bool,
    /// With --watch: show the figures on a page of this machine, http://127.0.0.1:PORT, which follows each save and
    /// shows problems at their place; put this option after the scenes
    #[arg(long, value_name = "PORT", num_args = 0..=1, requires = "watch", value_parser = port)]
    #[arg(conflicts_with_all = ["animate", "panels", "pages", "broken"])]
    serve: Option<Option<u16>>,
    /// Draw only one frame: its number from 1, its letter in the strip, or last
    #[arg(long, value_name = "N")]
    frame: Option<FrameChoice>,
    /// Exit with 1 or 3, as check does, if something is unstable or undecided
    #[arg(long)]
    strict: bool,
    /// Leave the scene file out of the picture; without this option, an SVG, PNG or PDF of one scene carries it, and check
    /// and import read it from there
    #[arg(long)]
    no_source: bool,
    /// Accepted for habit: render always replaces its own output
    #[arg(long, hide = true)]
    force: bool,
}

impl Render {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        if self.force {
            terminal.note("--force does nothing: render always replaces its pictures, and never a file that it reads");
        }
        if let Some(note) = self.draw.figure.note() {
            terminal.note(&note);
        }
        if !self.watch {
            return self.once(terminal);
        }
        let scenes = source::files(&self.scenes)?.scenes;
        if scenes.iter().any(|file| file == Path::new("-")) {
            return Err(vec!["--watch needs files; standard input (-) cannot be read again".into()]);
        }
        source::refuse_streams(&scenes)?;
        match self.serve {
            Some(port) => preview::serve(self, port, scenes, terminal),
            None => watch::repeat(|| self.watched(), terminal, || self.started().once(terminal)),
        }
    }

    /// Returns the files that the figures depend on: the scenes, with all that are now in folders, and the style file.
    fn watched(&self) -> Vec<PathBuf> {
        let style = self.draw.look.file().map(Path::to_path_buf);
        source::candidates(&self.scenes).into_iter().chain(style).collect()
    }

    /// Returns the same command with a time limit that counts from now.
    fn started(&self) -> Render {
        let mut render = self.clone();
        render.draw.figure.level = self.draw.figure.level.started();
        render
    }

    /// Draws all figures once: checks the options, reads the scenes, draws in parallel, and writes the files.
    fn once(&self, terminal: &Terminal) -> Ended {
        let destination = Destination::from_path(self.output.as_deref().unwrap_or(Path::new("-")));
        let format = destination.format(self.draw.picture.requested_format())?;
        self.draw.check(format)?;
        let scenes = source::files(&self.scenes)?.noted(terminal);
        self.check_count(&scenes, &destination, format, terminal)?;
        self.check_parts(&destination)?;
        let fonts = self.draw.picture.fonts()?;
        if self.broken {
            return self.sketched(&scenes, &destination, format, &fonts, terminal);
        }
        let joins = self.joins(scenes.len(), &destination);
        let read = source::read_apart_from_faults(scenes, self.frame, &self.draw.figure.level);
        let (options, (sources, mut faults)) = match (self.draw.options(), read) {
            (Ok(options), Ok(sources)) => (options, sources),
            (options, sources) => {
                let scenes = sources.err().into_iter().flatten();
                return Err(options.err().into_iter().chain(scenes).collect());
            }
        };
        if sources.is_empty() || (joins && !faults.is_empty()) {
            return Err(faults);
        }
        let read: Vec<&Path> = sources.iter().map(|source| source.path.as_path()).collect();
        let paths = paths(&destination, &read, format)?;
        let inputs: Vec<&Path> = read.into_iter().chain(self.draw.look.file()).collect();
        destination::refuse_overwrites(&paths, &inputs)?;

        let rendered = self.render_all(&sources, joins, &options, format, &fonts, terminal);
        let (rendered, paths) = without_faults(rendered, paths, &mut faults);
        if rendered.is_empty() {
            return Err(faults);
        }
        let rendered = all_or_errors(rendered)?;
        let ending = rendered.iter().map(|r| r.ending).max();
        if self.draw.picture.draws_words(format) {
            missing_glyphs::warn(&sources, &fonts, terminal);
        }
        self.write(rendered, &destination, &paths, terminal)?;
        for fault in &faults {
            terminal.refuse(fault);
        }
        Ok(if !faults.is_empty() {
            ExitStatus::WrongInput
        } else if self.strict {
            ending.unwrap_or(ExitStatus::Done)
        } else {
            ExitStatus::Done
        })
    }

    /// Refuses `--margin` for figures that cannot show the requested margin. Refuses `--panels` and `--pages` for figures of one block and for standard output.
    fn check_parts(&self, destination: &Destination) -> Result<(), CliError> {
        let is_stdout = matches!(destination, Destination::Stdout);
        let figure = &self.draw.figure;
        let (kind, margin) = (figure.kind(), figure.margin.map(|margin| margin.0));
        let is_central = kind == figure::Kind::Joints && margin == Some(MarginKind::Kernel);
        let shows_margin = kind == figure::Kind::Mechanism || kind.needs_sensitivity() || is_central;
        let why = if margin.is_some() && !shows_margin {
            "--margin selects the margin of a figure; add --kind mechanism or --kind sensitivity, or with kernel --kind joints"
        } else if self.writes_parts() && (kind.shows_one_block() || is_stdout) {
            "--panels and --pages write the parts of a figure to files; give a file or folder, and any kind but freebody"
        } else {
            return Ok(());
        };
        Err(why.into())
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
        let progress = Progress::begin(2 * sources.len(), terminal.shows_progress());
        let analysis_options = self.draw.figure.level.options();
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
        let several = scenes.len() > 1 && !self.joins(scenes.len(), destination);
        let why = match destination {
            Destination::File(path) if several => Some(format!(
                "{} scenes cannot be written to the one file {}; give a folder, with a slash at the end of its name",
                scenes.len(),
                path.display()
            )),
            Destination::Stdout if several => {
                Some("only one picture can be written to standard output; give a folder".into())
            }
            Destination::Stdout if terminal.is_watched() => format.unreadable(),
            _ => None,
        };
        why.map_or(Ok(()), |why| Err(why.into()))
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
        let mut draw = self.draw.clone();
        if !self.no_source {
            draw.picture = draw.picture.carrying(&source.file);
        }
        let figure = &draw.figure;
        let wrong = |why| CliError::CommandLine(format!("{}: {why}", source.name()));
        let options = &figure.for_scene(options, &source.scene).map_err(wrong)?;
        let scene = self.shown(source, format, fonts);
        let analysis = figure.analysed(&scene, *analysis_options)?;
        progress.step();
        let mut summary = summary(&analysis);
        let falls = analysis.frames.iter().any(|frame| frame.verdict == Verdict::Unstable);
        if draw.animate.is_some() && figure.kind() == figure::Kind::Mechanism && options.at.is_none() && !falls {
            summary.push_str("; nothing moves");
        }
        let bytes = if self.writes_parts() {
            let parts = draw.parts(&analysis, figure.kind(), options, self.pages);
            let one = |part| draw.picture.bytes(part, format, fonts);
            parts.into_iter().map(one).collect::<Result<_, _>>()?
        } else {
            let (bytes, is_high) = draw.bytes(&analysis, options, format, fonts)?;
            if is_high {
                summary.push_str("; taller than an A4 page, --pages splits it");
            }
            vec![bytes]
        };
        progress.step();
        Ok(Rendered { bytes, ending: ExitStatus::from_analysis(&analysis), summary })
    }

    /// Returns the scene as the figure shows it: with code points instead of characters that no font has, if drystone
    /// lays out its text.
    fn shown(&self, source: &Source, format: Format, fonts: &Fonts) -> Arc<Scene> {
        if self.draw.picture.draws_words(format) {
            missing_glyphs::legible(&source.scene, fonts).into()
        } else {
            source.scene.clone()
        }
    }

    /// True if the command draws one figure that compares two scenes, instead of one figure for each scene.
    fn joins(&self, scenes: usize, destination: &Destination) -> bool {
        self.draw.figure.kind() == figure::Kind::Compare
            && scenes == 2
            && !matches!(destination, Destination::Folder(_))
    }

    /// Draws the last frames of two scenes next to each other, with the changes between them.
    fn compared(
        &self,
        sources: [&Source; 2],
        analysis_options: &analysis::Options,
        options: &figure::Options,
        format: Format,
        fonts: &Fonts,
    ) -> Result<Rendered, CliError> {
        if self.draw.figure.zoom.is_some() || self.panels || self.pages || self.draw.animate.is_some() {
            let why = "a comparison of two scenes is one picture; leave out --zoom, --panels, --pages and --animate";
            return Err(why.into());
        }
        let scenes = sources.map(|source| self.shown(source, format, fonts));
        let [before, after] = [&scenes[0], &scenes[1]].map(|s| Analysis::exact(s.clone(), analysis_options));
        let title = |number: usize| match scenes[number].title.as_str() {
            title if title.is_empty() || scenes[0].title == scenes[1].title => sources[number].stem(),
            title => title.to_owned(),
        };
        let last = |analysis: &Analysis| analysis.frames.len() - 1;
        let (a, b) = ((&before, last(&before)), (&after, last(&after)));
        let (scene, frames) = analysis::pair(a, b, [title(0), title(1)]).map_err(|why| {
            let names = sources.map(Source::name);
            CliError::CommandLine(format!("{} and {}: {why}", names[0], names[1]))
        })?;
        let joined = Analysis::of_parts(scene, frames);
        Ok(Rendered {
            bytes: vec![self.draw.bytes(&joined, options, format, fonts)?.0],
            ending: ExitStatus::from_analysis(&joined),
            summary: summary(&joined),
        })
    }
}

fn port(typed: &str) -> Result<u16, String> {
    typed.parse().map_err(|_| "a port is a number up to 65535; put --serve after the scenes".into())
}
