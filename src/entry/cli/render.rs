//! `drystone render`: scenes in, figures out.

mod broken;
mod choice;
mod pair;
mod target;

use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};

use choice::{ArrowScale, Arrows, Fill, KindChoice, Margin, Normalise};
use target::{part_path, paths};

use crate::analysis::{self, Analysis, Verdict};
use crate::cli::complaint::CliError;
use crate::cli::destination::{self, Destination};
use crate::cli::ending::ExitStatus;
use crate::cli::level::AnalysisArgs;
use crate::cli::look::StyleArgs;
use crate::cli::picture::{Format, Picture, or_split};
use crate::cli::progress::{Progress, Shown};
use crate::cli::script;
use crate::cli::source::{self, FrameChoice, Source};
use crate::cli::terminal::Terminal;
use crate::cli::watch;
use crate::drawing::{Drawing, Theme};
use crate::figure;
use crate::output::file::Existing;
use crate::output::fonts::Fonts;
use crate::scene::{BlockId, Scene};
use crate::text::nearest;
use crate::wording::verdict::{counted, plain};

/// Draw scenes with their forces, and what fails, as SVG, PNG, PDF or TikZ
#[derive(Debug, Args)]
pub(crate) struct Render {
    /// Scene files, or folders of them; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Where to: a .svg, .png, .pdf or .tikz file, a folder (existing, or ending in a slash), or - for standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    look: StyleArgs,
    /// One resulting arrow per interface and block, or its normal and friction apart
    #[arg(long, value_enum, default_value = "resultant")]
    arrows: Arrows,
    /// What is one unit long: the largest arrow drawn, or the largest single unknown as in the source
    #[arg(long, value_enum, default_value = "drawn")]
    normalise: Normalise,
    /// Arrows to one scale in each panel, or in the whole strip
    #[arg(long, value_enum, default_value = "panel")]
    arrow_scale: ArrowScale,
    /// What the figure shows
    #[arg(long, value_enum, default_value = "forces")]
    kind: KindChoice,
    /// The block that a free-body diagram cuts free, by its id
    #[arg(long, value_name = "ID")]
    block: Option<String>,
    /// In a free-body diagram name every force that may act at every end of its interfaces, also those that are zero
    #[arg(long)]
    corners: bool,
    /// Show the frames one after the other in an animated PNG, each for this many seconds; a mechanism moves in steps
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    animate: Option<f64>,
    /// Write its amount next to every arrow
    #[arg(long)]
    amounts: bool,
    /// What the colours of blocks show
    #[arg(long, value_enum, default_value = "amplitude")]
    fill: Fill,
    /// Leave out the figure's title
    #[arg(long)]
    no_title: bool,
    /// Leave out the frames' captions
    #[arg(long)]
    no_caption: bool,
    /// Leave out the verdicts and what is written below them
    #[arg(long)]
    no_verdict: bool,
    /// Leave out the key and the scale of arrows
    #[arg(long)]
    no_key: bool,
    /// Show a bar of a round number of metres
    #[arg(long)]
    scale_bar: bool,
    /// Measure the width and height of all blocks, or of the block of --zoom, at the edges of each panel
    #[arg(long)]
    dimensions: bool,
    /// Show the neighbourhood of one block only, by its id
    #[arg(long, value_name = "ID")]
    zoom: Option<String>,
    /// Write every panel of a strip to a file of its own, its letter after the name
    #[arg(long, conflicts_with = "animate")]
    panels: bool,
    /// Split a long strip over several A4 pages, each a file of its own, its number after the name
    #[arg(long, conflicts_with_all = ["animate", "panels"])]
    pages: bool,
    /// Of --kind margin, in which direction [default: tilt]
    #[arg(long, value_enum, value_name = "DIRECTION")]
    margin: Option<Margin>,
    /// Panels per row of a strip
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    columns: Option<u16>,
    /// Draw the outlines alone with the problems of a refused scene marked and numbered; ends with 2 where there are any
    #[arg(long, conflicts_with_all = ["animate", "panels", "pages", "frame", "zoom", "block", "margin", "corners"])]
    broken: bool,
    /// Draw again whenever a scene or the style file is saved, until the program is stopped
    #[arg(long)]
    watch: bool,
    /// Draw one frame only, by number from 1, by its letter in the strip, or last
    #[arg(long, value_name = "N")]
    frame: Option<FrameChoice>,
    /// End with 1 or 3, as check does, where something is unstable or undecided
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    level: AnalysisArgs,
}

/// A strip of more frames than this may be too large for a PNG.
const MANY: usize = 50;
/// A strip higher than this many page heights does not fit on a page.
const TALL: f64 = 1.02;

/// A figure and what it shows.
struct Rendered {
    /// One for each file; more than one where each panel has its own.
    bytes: Vec<Vec<u8>>,
    ending: ExitStatus,
    summary: String,
}

/// The results and the paths they are written to, where the program did not fail; its faults go to `faults`.
fn without_faults(
    rendered: Vec<Result<Rendered, CliError>>,
    paths: Vec<PathBuf>,
    faults: &mut Vec<CliError>,
) -> (Vec<Result<Rendered, CliError>>, Vec<PathBuf>) {
    let (mut results, mut targets) = (Vec::new(), Vec::new());
    let mut paths = paths.into_iter();
    for result in rendered {
        // On standard output there is no path.
        let path = paths.next();
        match result {
            Err(complaint) if complaint.is_internal_fault() => faults.push(complaint),
            other => {
                results.push(other);
                targets.extend(path);
            }
        }
    }
    (results, targets)
}

fn seconds(typed: &str) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(seconds) if (0.01..=600.0).contains(&seconds) => Ok(seconds),
        _ => Err("it is a time in seconds, from 0.01 to 600".into()),
    }
}

impl Render {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        if !self.watch {
            return self.once(terminal);
        }
        let mut files = source::files(&self.scenes).map_err(|c| vec![c])?;
        if files.iter().any(|file| file == Path::new("-")) {
            let why = "--watch looks at files; standard input (-) cannot be saved again";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        files.extend(self.look.file().map(Path::to_path_buf));
        watch::repeat(&files, terminal, || self.once(terminal))
    }

    /// Draws everything once.
    fn once(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let destination = Destination::from_path(&self.output);
        let format = destination
            .format(self.picture.asked())
            .map_err(|c| vec![c])?;
        self.picture.check(format).map_err(|c| vec![c])?;
        if self.block.is_some() && self.kind != KindChoice::Freebody {
            let why = "--block names the block of a free-body diagram; add --kind freebody";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        if self.corners && self.kind != KindChoice::Freebody {
            let why = "--corners is about the forces of a free-body diagram; add --kind freebody";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        if self.animate.is_some() && (format != Format::Png || self.kind.panels().is_none()) {
            let why = "--animate makes a PNG of the frames of a figure; write a .png, of any kind but freebody";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        let scenes = source::files(&self.scenes).map_err(|c| vec![c])?;
        self.check_count(&scenes, &destination, format, terminal)
            .map_err(|c| vec![c])?;
        if self.margin.is_some() && !self.kind.needs_margins() {
            let why = "--margin is about the direction of a margin; add --kind margin";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        let parts = self.panels || self.pages;
        if parts && (self.kind.panels().is_none() || matches!(destination, Destination::Stdout)) {
            let why = "--panels and --pages write the parts of a figure to files; give a file or folder, and any kind but freebody";
            return Err(vec![CliError::CommandLine(why.into())]);
        }
        let fonts = self.picture.fonts().map_err(|c| vec![c])?;
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
        let options = self.options(theme);
        let joins = self.joins(scenes.len(), &destination);
        if sources.is_empty() || (joins && !faults.is_empty()) {
            return Err(faults);
        }
        let read: Vec<&Path> = sources.iter().map(|source| source.path.as_path()).collect();
        let paths = paths(&destination, &read, format).map_err(|c| vec![c])?;
        let inputs: Vec<&Path> = read.into_iter().chain(self.look.file()).collect();
        destination::apart(&paths, &inputs).map_err(|c| vec![c])?;

        let shown = if terminal.shows_progress() {
            Shown::WhenLong
        } else {
            Shown::Never
        };
        let progress = Progress::begin(2 * sources.len(), shown);
        let mut asked = self.level.options();
        if self.kind.needs_margins() {
            asked.margins = true;
        }
        let rendered: Vec<Result<Rendered, CliError>> = match &sources[..] {
            [before, after] if joins => {
                let work = || self.compared([before, after], &asked, &options, format, &fonts);
                vec![source::isolated(&after.path, work).flatten()]
            }
            sources => {
                let one = |source: &Source| {
                    let work = || self.render(source, &asked, &options, format, &fonts, &progress);
                    source::isolated(&source.path, work).flatten()
                };
                sources.par_iter().map(one).collect()
            }
        };
        drop(progress);
        let (rendered, paths) = without_faults(rendered, paths, &mut faults);
        if rendered.is_empty() {
            return Err(faults);
        }
        let rendered = all(rendered)?;

        let ending = rendered
            .iter()
            .map(|r| r.ending)
            .max()
            .unwrap_or(ExitStatus::Done);
        let summaries: Vec<String> = rendered.iter().map(|r| r.summary.clone()).collect();
        let bytes = rendered.into_iter().map(|r| r.bytes);
        if self.picture.draws_words(format) {
            script::warn(&sources, &fonts, terminal);
        }
        if let Destination::Stdout = destination {
            for picture in bytes.flatten() {
                terminal.print_bytes(&picture).map_err(|c| vec![c])?;
            }
        } else {
            if let Destination::Folder(folder) = &destination {
                destination::make_folder(folder).map_err(|c| vec![c])?;
            }
            let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
            for (path, pictures) in paths.iter().zip(bytes) {
                if !parts {
                    files.extend(pictures.into_iter().map(|bytes| (path.clone(), bytes)));
                    continue;
                }
                for (number, bytes) in pictures.into_iter().enumerate() {
                    let part = if self.pages {
                        (number + 1).to_string()
                    } else {
                        figure::letter(number)
                    };
                    files.push((part_path(path, &part), bytes));
                }
            }
            destination::write(&files, Existing::Replace).map_err(|c| vec![c])?;
            for (path, summary) in paths.iter().zip(summaries) {
                terminal.note(&format!("{}: {summary}", path.display()));
            }
        }
        for fault in &faults {
            terminal.refuse(fault);
        }
        Ok(match (faults.is_empty(), self.strict) {
            (false, _) => ExitStatus::WrongInput,
            (true, true) => ending,
            (true, false) => ExitStatus::Done,
        })
    }

    /// What can be refused before any scene is read.
    fn check_count(
        &self,
        scenes: &[PathBuf],
        destination: &Destination,
        format: Format,
        terminal: &Terminal,
    ) -> Result<(), CliError> {
        if self.joins(scenes.len(), destination) {
            return match (destination, format.unreadable()) {
                (Destination::Stdout, Some(why)) if terminal.is_watched() => {
                    Err(CliError::CommandLine(why))
                }
                _ => Ok(()),
            };
        }
        let why = match destination {
            Destination::File(path) if scenes.len() > 1 => {
                let (count, shown) = (scenes.len(), path.display());
                format!(
                    "{count} scenes do not go into the one file {shown}; give a folder, its name ending in a slash"
                )
            }
            Destination::Stdout if scenes.len() > 1 => {
                "only one picture at a time goes to standard output; give a folder".into()
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
        asked: &analysis::Options,
        options: &figure::Options,
        format: Format,
        fonts: &Fonts,
        progress: &Progress,
    ) -> Result<Rendered, CliError> {
        progress.doing(&source.name());
        let mut options = options.clone();
        if let Some(name) = &self.zoom {
            let wrong = |why| CliError::CommandLine(format!("{}: {why}", source.name()));
            options.zoom = Some(self.found(&source.scene, name).map_err(wrong)?);
        }
        let options = &options;
        let scene = if self.picture.draws_words(format) {
            script::legible(&source.scene, fonts)
        } else {
            source.scene.clone()
        };
        let analysis = Analysis::with(&scene, asked);
        progress.step();
        let mut summary = summary(&analysis);
        let kind = self.kind.panels();
        let split = |complaint| match kind {
            Some(_) => or_split(complaint, analysis.frames.len()),
            None => complaint,
        };
        if let (Some(kind), Format::Png) = (kind, format)
            && !self.panels
            && !self.pages
            && analysis.frames.len() > MANY
        {
            // What no PNG could hold is refused before it is laid out.
            self.picture
                .check_png(figure::least_size(&analysis, kind, options))
                .map_err(split)?;
        }
        let bytes = match (self.animate, kind) {
            (None, Some(kind)) if self.panels || self.pages => {
                let pages = if self.pages {
                    figure::split(&analysis, kind, options, self.picture.page_ratio())
                } else {
                    figure::panels(&analysis, kind, options)
                };
                let page = |page| self.picture.bytes(page, format, fonts);
                pages.into_iter().map(page).collect::<Result<_, _>>()?
            }
            (Some(seconds), kind) => {
                let pages = figure::pages(&analysis, kind.unwrap_or_default(), options);
                vec![self.picture.animated(pages, seconds, fonts)?]
            }
            (None, kind) => {
                let drawing = self.drawing(source, &analysis, options)?;
                let high = self.picture.page_ratio() * drawing.width;
                if kind.is_some() && analysis.frames.len() > 1 && drawing.height > TALL * high {
                    summary.push_str("; taller than an A4 page, --pages splits it");
                }
                let bytes = self.picture.bytes(drawing, format, fonts);
                vec![bytes.map_err(split)?]
            }
        };
        progress.step();
        Ok(Rendered {
            bytes,
            ending: ExitStatus::from_analysis(&analysis),
            summary,
        })
    }

    fn drawing(
        &self,
        source: &Source,
        analysis: &Analysis,
        options: &figure::Options,
    ) -> Result<Drawing, CliError> {
        if let Some(kind) = self.kind.panels() {
            return Ok(figure::draw(analysis, kind, options));
        }
        let (frame, block) = self
            .cut_free(&source.scene)
            .map_err(|why| CliError::CommandLine(format!("{}: {why}", source.name())))?;
        let drawing = figure::freebody(analysis, frame, block, options);
        Ok(drawing.expect("the block was found in this frame"))
    }

    /// The block that is cut free, and the last frame in which it stands.
    fn cut_free(&self, scene: &Scene) -> Result<(usize, BlockId), String> {
        let placed = |id: BlockId| scene.frames.iter().rposition(|f| f.placed.contains(&id));
        let Some(name) = &self.block else {
            return match (scene.blocks.as_slice(), placed(BlockId(0))) {
                ([_], Some(frame)) => Ok((frame, BlockId(0))),
                _ => {
                    let ids: Vec<&str> = scene.blocks.iter().map(|b| b.id.as_str()).collect();
                    let more = if ids.len() > 12 { ", …" } else { "" };
                    Err(format!(
                        "a free-body diagram is of one block; choose with --block one of {}{more}",
                        ids[..ids.len().min(12)].join(", ")
                    ))
                }
            };
        };
        let block = self.found(scene, name)?;
        match placed(block) {
            Some(frame) => Ok((frame, block)),
            None => Err(format!("block {name} is not placed in the frames shown")),
        }
    }

    /// The block of a name.
    fn found(&self, scene: &Scene, name: &str) -> Result<BlockId, String> {
        let number = scene.blocks.iter().position(|b| b.id == name);
        number.map(BlockId).ok_or_else(|| {
            let known = scene.blocks.iter().map(|b| b.id.as_str());
            let near = nearest(name, known)
                .map_or_else(String::new, |near| format!("; did you mean {near}?"));
            format!("it has no block {name}{near}")
        })
    }

    fn options(&self, theme: Theme) -> figure::Options {
        figure::Options {
            style: self.arrows.figure(),
            normalisation: self.normalise.figure(),
            scale: self.arrow_scale.figure(),
            fill: self.fill.figure(),
            toward: self.margin.unwrap_or(Margin::Tilt).toward(),
            titles: !self.no_title,
            captions: !self.no_caption,
            verdicts: !self.no_verdict,
            keys: !self.no_key,
            scale_bar: self.scale_bar,
            dimensions: self.dimensions,
            corners: if self.corners {
                figure::Corners::All
            } else {
                figure::Corners::Few
            },
            columns: self.columns.map(usize::from),
            amounts: self.amounts,
            width: self.picture.page(),
            theme,
            ..figure::Options::default()
        }
    }
}

/// Every result, or every complaint.
fn all<T>(results: Vec<Result<T, CliError>>) -> Result<Vec<T>, Vec<CliError>> {
    let mut good = Vec::with_capacity(results.len());
    let mut complaints = Vec::new();
    for result in results {
        match result {
            Ok(value) => good.push(value),
            Err(complaint) => complaints.push(complaint),
        }
    }
    if complaints.is_empty() {
        Ok(good)
    } else {
        Err(complaints)
    }
}

/// `6 frames: 5 stand, 1 falls`.
fn summary(analysis: &Analysis) -> String {
    let count = |verdict| {
        analysis
            .frames
            .iter()
            .filter(|f| f.verdict == verdict)
            .count()
    };
    let parts: Vec<String> = [Verdict::Stable, Verdict::Unstable, Verdict::Undecided]
        .into_iter()
        .filter(|v| count(*v) > 0)
        .map(|v| match analysis.frames.len() {
            1 => plain(v).into(),
            _ => counted(count(v), v),
        })
        .collect();
    match analysis.frames.len() {
        1 => parts.join(", "),
        n => format!("{n} frames: {}", parts.join(", ")),
    }
}
