//! `drystone export`: writes a frame of a scene as a drawing for CAD programs.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::source;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::AnalysisArgs;
use crate::entry::value::FrameChoice;
use crate::mechanics::analysis::Analysis;
use crate::products::figure;
use crate::read::file::ending;

/// Write a frame as a DXF drawing in metres: structure, line of thrust or collapse
///
/// Blocks, ground and grips of robots are on the layers "blocks", "ground" and "robots". The names of all other layers
/// begin with "guide", and import leaves these layers out. So the drawing can be edited in a CAD program and imported
/// again.
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// The scene file; - reads standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// The .dxf file to write; - or nothing prints the drawing
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the output file if it exists
    #[arg(long, requires = "output")]
    force: bool,
    /// Frame: its number from 1, its letter, or last
    #[arg(long, value_name = "N", default_value = "last")]
    frame: FrameChoice,
    #[command(flatten)]
    level: AnalysisArgs,
}

impl Export {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let file = destination::file(self.output.as_ref());
        if let Some(file) = file {
            check_name(file)?;
            destination::refuse_overwrites(&[file.to_owned()], &[&self.scene])?;
        }
        let scenes = [self.scene.clone()];
        let sources = source::read(&scenes, Some(self.frame), &self.level)?;
        let Some(source) = sources.first() else {
            let why = format!("there is no scene file in {}", self.scene.display());
            return Err(CliError::CommandLine(why).into());
        };
        let text = source::isolated(&self.scene, || {
            figure::dxf(&Analysis::exact(source.scene.clone(), &self.level.options()), 0)
        });
        // Without `--force`, keep an existing file: it may be the drawing from which the scene was imported.
        destination::deliver(terminal, file, text?.into_bytes(), self.force)?;
        if let Some(path) = file {
            terminal.note(&format!("wrote {}", path.display()));
        }
        Ok(ExitStatus::Done)
    }
}

/// Refuses an output that is a folder, or whose name does not end in `.dxf`.
fn check_name(file: &Path) -> Result<(), CliError> {
    let why = match ending(file).as_str() {
        _ if file.is_dir() => "is a folder; name the .dxf file in it",
        "dxf" => return Ok(()),
        _ => "does not end in .dxf, the only format of export; pictures come from drystone render",
    };
    Err(format!("{} {why}", file.display()).into())
}
