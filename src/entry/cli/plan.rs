//! `drystone plan`: finds an order in which a structure can be built with a few robots, and writes it as steps.

use std::path::PathBuf;

use clap::Args;

use crate::entry::cli::destination;
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::source;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::AnalysisArgs;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::scene::format::SceneFile;
use crate::mechanics::session::{PlanError, plan};

/// Find an order of placing all blocks such that every step stands while robots hold single blocks
///
/// Writes the scene with these steps. Draw them with drystone render --kind build. The scene's own steps are left out.
/// The robots of the scene hold one block each, at its centroid, within their limits. A robot may release a block and
/// hold another one in the same step. Whether a block fits between the others on its way is not tested.
#[derive(Debug, Args)]
pub(crate) struct Plan {
    /// The scene; - reads standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// How many robots without limits of force build a scene that has no robots [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=16))]
    robots: Option<u8>,
    /// The file to write; - or nothing prints the scene
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "output")]
    force: bool,
    #[command(flatten)]
    level: AnalysisArgs,
}

impl Plan {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let output = destination::file(self.output.as_ref());
        if let Some(path) = output {
            destination::refuse_overwrites(&[path.to_owned()], &[&self.scene])?;
        }
        let source = source::read_one(&self.scene, &self.level)?;
        let name = source.name();
        let mut file = SceneFile::from_json(&source.text())
            .map_err(|problems| CliError::Scene { name: name.clone(), problems })?;
        file.tolerate(self.level.contact_tolerance);
        let options = self.level.options();
        let planned = match source::isolated(&self.scene, || plan(file, self.robots.map(usize::from), &options))? {
            Ok(planned) => planned,
            Err(PlanError::SceneError(problems)) => return Err(CliError::Scene { name, problems }.into()),
            Err(why @ PlanError::Robots(_)) => return Err(CliError::from(format!("{name}: {why}")).into()),
            Err(why) => {
                terminal.note(&format!("{name}: {why}"));
                let is_proved =
                    matches!(why, PlanError::NoOrder(_) | PlanError::Finished { verdict: Verdict::Unstable, .. });
                return Ok(if is_proved { ExitStatus::Unstable } else { ExitStatus::Undecided });
            }
        };
        destination::deliver(terminal, output, planned.to_json().into_bytes(), self.force)?;
        if let Some(path) = output {
            let (scene, picture) = (path.display(), path.with_extension("svg"));
            let picture = picture.display();
            terminal.note(&format!("wrote {scene}; draw it with: drystone render {scene} --kind build -o {picture}"));
        }
        Ok(ExitStatus::Done)
    }
}
