//! The options of `drystone render`.

use std::path::PathBuf;

use clap::Args;

use super::choice::{ArrowScale, Arrows, Fill, KindChoice, Normalise};
use crate::entry::cli::analysis_args::AnalysisArgs;
use crate::entry::cli::capacity::CapacityArgs;
use crate::entry::cli::margins::SensitivityMargin;
use crate::entry::cli::picture::Picture;
use crate::entry::cli::source::FrameChoice;
use crate::entry::cli::style_args::StyleArgs;

/// Draw scenes with their forces and failures as SVG, PNG, GIF, PDF or TikZ
#[derive(Debug, Args)]
pub(crate) struct Render {
    /// Scene files, or folders of them; - reads standard input
    #[arg(required = true, value_name = "SCENE")]
    pub(super) scenes: Vec<PathBuf>,
    /// The output: a .svg, .png, .gif, .pdf or .tikz file, a folder (existing, or ending in a slash), or - for
    /// standard output
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,
    #[command(flatten)]
    pub(super) picture: Picture,
    #[command(flatten)]
    pub(super) look: StyleArgs,
    /// One resultant arrow for each interface and block, or separate arrows for normal and friction force
    #[arg(long, value_enum, default_value = "resultant")]
    pub(super) arrows: Arrows,
    /// The force whose arrow has unit length: the largest drawn force, or the largest single unknown, as in Vallat
    /// (2023)
    #[arg(long, value_enum, default_value = "drawn")]
    pub(super) normalise: Normalise,
    /// One scale of arrows for each panel, or for the whole strip
    #[arg(long, value_enum, default_value = "panel")]
    pub(super) arrow_scale: ArrowScale,
    /// What the figure shows
    #[arg(long, value_enum, default_value = "forces")]
    pub(super) kind: KindChoice,
    /// The id of the block of a free-body diagram
    #[arg(long, value_name = "ID")]
    pub(super) block: Option<String>,
    /// In a free-body diagram, name all forces that may act at the ends of its interfaces, even those that are zero
    #[arg(long)]
    pub(super) corners: bool,
    /// Show the frames one after the other in a GIF or an animated PNG, each for this many seconds; falling blocks
    /// move for this time, and then rest for one second
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(super) animate: Option<f64>,
    /// Write the magnitude of the force next to every arrow
    #[arg(long)]
    pub(super) amounts: bool,
    /// The quantity that the colours of blocks show
    #[arg(long, value_enum, default_value = "amplitude")]
    pub(super) fill: Fill,
    #[command(flatten)]
    pub(super) capacity: CapacityArgs,
    /// Leave out the figure's title
    #[arg(long)]
    pub(super) no_title: bool,
    /// Leave out the frames' captions
    #[arg(long)]
    pub(super) no_caption: bool,
    /// Leave out the verdicts and the text below them
    #[arg(long)]
    pub(super) no_verdict: bool,
    /// Leave out the key and the scale of arrows
    #[arg(long)]
    pub(super) no_key: bool,
    /// Show a scale bar with a round number of metres
    #[arg(long)]
    pub(super) scale_bar: bool,
    /// Draw dimension lines at the edges of each panel: width and height of all blocks, or of the block of --zoom
    #[arg(long)]
    pub(super) dimensions: bool,
    /// Draw the force polygon next to the line of thrust of --kind thrust: a load line, a pole, and a ray for each joint
    #[arg(long)]
    pub(super) with_polygon: bool,
    /// Show only the neighbourhood of the block with this id
    #[arg(long, value_name = "ID")]
    pub(super) zoom: Option<String>,
    /// Write every panel of a strip to a separate file, with its letter after the name
    #[arg(long, conflicts_with = "animate")]
    pub(super) panels: bool,
    /// Split a long strip into A4 pages, each a separate file with its number after the name
    #[arg(long, conflicts_with_all = ["animate", "panels"])]
    pub(super) pages: bool,
    /// The margin of --kind margin [default: tilt] or --kind sensitivity [default: load-factor if there are loads, otherwise
    /// tilt]
    #[arg(long, value_enum, value_name = "MARGIN")]
    pub(super) margin: Option<SensitivityMargin>,
    /// Panels per row of a strip
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) columns: Option<u16>,
    /// Draw only the outlines, with the problems of a scene that is not valid marked and numbered; the exit code is 2
    /// if there are problems
    #[arg(long, conflicts_with_all = ["animate", "panels", "pages", "frame", "zoom", "block", "margin", "corners"])]
    pub(super) broken: bool,
    /// Draw again whenever a scene or the style file changes, until the program is stopped
    #[arg(long)]
    pub(super) watch: bool,
    /// Draw only one frame: its number from 1, its letter in the strip, or last
    #[arg(long, value_name = "N")]
    pub(super) frame: Option<FrameChoice>,
    /// Exit with 1 or 3, as check does, if something is unstable or undecided
    #[arg(long)]
    pub(super) strict: bool,
    #[command(flatten)]
    pub(super) level: AnalysisArgs,
}

fn seconds(typed: &str) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(seconds) if (0.01..=600.0).contains(&seconds) => Ok(seconds),
        _ => Err("it must be a time in seconds, from 0.01 to 600".into()),
    }
}
