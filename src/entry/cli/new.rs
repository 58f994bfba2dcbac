//! `drystone new`: writes an example, or a structure with given dimensions, as a scene to start from.

use std::any::TypeId;
use std::path::PathBuf;

use clap::builder::RangedU64ValueParser;
use clap::{Args, Command, FromArgMatches, Subcommand, ValueEnum};

use crate::entry::cli::destination;
use crate::entry::cli::error::Ended;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;
use crate::sources::starter::{Arch, Doorway, Incline, Ladder, LatticePile, Tower, Wall};

/// Write a scene to start from: a small example, or a structure with your dimensions
#[derive(Debug, Args)]
pub(crate) struct New {
    #[command(subcommand)]
    kind: Option<Structure>,
    /// The small example, if no structure is named: one that stands in every step, or one that falls in a step
    #[arg(long, value_enum, value_name = "NAME", default_value = "stands")]
    example: Example,
    /// The file to write; - or nothing prints the scene
    #[arg(short, long, value_name = "FILE", global = true)]
    output: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "output", global = true)]
    force: bool,
}

/// A small example.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Example {
    Stands,
    Falls,
}

/// The friction of a structure.
#[derive(Clone, Copy, Debug, Args)]
struct Friction {
    /// Friction coefficient
    #[arg(long, value_name = "MU", default_value = "0.7", value_parser = at_least_zero)]
    friction: f64,
}

#[derive(Debug, Subcommand)]
enum Structure {
    /// A round arch
    Arch {
        /// How many voussoirs
        #[arg(long, value_name = "N", default_value = "13", value_parser = count().range(2..=1000))]
        voussoirs: usize,
        /// Clear width in metres; from an angle of 180 degrees on, twice the inner radius
        #[arg(long, value_name = "M", default_value = "4", value_parser = length)]
        span: f64,
        /// Thickness from the inner to the outer face in metres
        #[arg(long, value_name = "M", default_value = "0.4", value_parser = length)]
        thickness: f64,
        /// Angle of embrace: between the springings, at the centre, in degrees
        #[arg(long, value_name = "DEG", default_value = "180", value_parser = |typed: &str| angle(typed, [20.0, 300.0]))]
        angle: f64,
        #[command(flatten)]
        friction: Friction,
    },
    /// A wall in running bond
    Wall {
        /// How many courses
        #[arg(long, value_name = "N", default_value = "6", value_parser = count())]
        courses: usize,
        /// Bricks in a course
        #[arg(long, value_name = "N", default_value = "5", value_parser = count())]
        bricks: usize,
        /// Length of a brick in metres
        #[arg(long, value_name = "M", default_value = "0.25", value_parser = length)]
        length: f64,
        /// Height of a course in metres
        #[arg(long, value_name = "M", default_value = "0.08", value_parser = length)]
        height: f64,
        #[command(flatten)]
        friction: Friction,
    },
    /// A tower of blocks that leans to the right
    Tower {
        /// How many blocks
        #[arg(long, value_name = "N", default_value = "8", value_parser = count())]
        blocks: usize,
        /// Width of a block in metres
        #[arg(long, value_name = "M", default_value = "1", value_parser = length)]
        width: f64,
        /// Height of a block in metres
        #[arg(long, value_name = "M", default_value = "0.5", value_parser = length)]
        height: f64,
        /// Shift of each block to the right, relative to the block below, in metres
        #[arg(long, value_name = "M", default_value = "0.1", value_parser = at_least_zero)]
        lean: f64,
        #[command(flatten)]
        friction: Friction,
    },
    /// Two jambs and a lintel, in three steps with a robot
    Doorway {
        /// Blocks in each jamb
        #[arg(long, value_name = "N", default_value = "4", value_parser = count())]
        courses: usize,
        /// Clear width in metres
        #[arg(long, value_name = "M", default_value = "1", value_parser = length)]
        width: f64,
        /// Clear height in metres
        #[arg(long, value_name = "M", default_value = "2", value_parser = length)]
        height: f64,
        /// Width of a jamb in metres
        #[arg(long, value_name = "M", default_value = "0.4", value_parser = length)]
        jamb: f64,
        /// Height of the lintel in metres
        #[arg(long, value_name = "M", default_value = "0.3", value_parser = length)]
        lintel: f64,
        #[command(flatten)]
        friction: Friction,
    },
    /// A ladder that leans at a wall
    Ladder {
        /// Length from the floor to the wall in metres
        #[arg(long, value_name = "M", default_value = "4", value_parser = length)]
        length: f64,
        /// Thickness in metres
        #[arg(long, value_name = "M", default_value = "0.06", value_parser = length)]
        thickness: f64,
        /// Angle between the ladder and the floor in degrees
        #[arg(long, value_name = "DEG", default_value = "65", value_parser = |typed: &str| angle(typed, [5.0, 85.0]))]
        angle: f64,
        /// Friction coefficient at the wall
        #[arg(long, value_name = "MU", default_value = "0", value_parser = at_least_zero)]
        wall_friction: f64,
        #[command(flatten)]
        friction: Friction,
    },
    /// A block on an inclined plane
    Incline {
        /// Angle of the plane to the horizontal in degrees
        #[arg(long, value_name = "DEG", default_value = "20", value_parser = |typed: &str| angle(typed, [0.0, 85.0]))]
        angle: f64,
        /// Width of the block along the plane in metres
        #[arg(long, value_name = "M", default_value = "1", value_parser = length)]
        width: f64,
        /// Height of the block in metres
        #[arg(long, value_name = "M", default_value = "1", value_parser = length)]
        height: f64,
        #[command(flatten)]
        friction: Friction,
    },
    /// A pile of triangles on the triangular lattice
    Lattice {
        /// How many rows
        #[arg(long, value_name = "N", default_value = "3", value_parser = count())]
        rows: usize,
        /// Edge length of a cell in metres
        #[arg(long, value_name = "M", default_value = "1", value_parser = length)]
        side: f64,
        #[command(flatten)]
        friction: Friction,
    },
}

fn count() -> RangedU64ValueParser<usize> {
    RangedU64ValueParser::new().range(1..=1000)
}

fn length(typed: &str) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(metres) if (1e-6..=1e6).contains(&metres) => Ok(metres),
        _ => Err("it must be a length in metres, from 0.000001 to 1000000".into()),
    }
}

fn angle(typed: &str, [least, most]: [f64; 2]) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(degrees) if (least..=most).contains(&degrees) => Ok(degrees),
        _ => Err(format!("it must be an angle from {least} to {most} degrees")),
    }
}

fn at_least_zero(typed: &str) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(number) if (0.0..=1e6).contains(&number) => Ok(number),
        _ => Err("it must be a number from 0 to 1000000".into()),
    }
}

impl Structure {
    fn text(&self) -> String {
        let scene = match *self {
            Structure::Arch { voussoirs, span, thickness, angle, friction: Friction { friction } } => {
                Arch { voussoirs, span, thickness, angle, friction }.scene()
            }
            Structure::Wall { courses, bricks, length, height, friction: Friction { friction } } => {
                Wall { courses, bricks, length, height, friction }.scene()
            }
            Structure::Tower { blocks, width, height, lean, friction: Friction { friction } } => {
                Tower { blocks, width, height, lean, friction }.scene()
            }
            Structure::Doorway { courses, width, height, jamb, lintel, friction: Friction { friction } } => {
                Doorway { courses, width, height, jamb, lintel, friction }.scene()
            }
            Structure::Ladder { length, thickness, angle, wall_friction, friction: Friction { friction } } => {
                Ladder { length, thickness, angle, friction, wall_friction }.scene()
            }
            Structure::Incline { angle, width, height, friction: Friction { friction } } => {
                Incline { angle, width, height, friction }.scene()
            }
            Structure::Lattice { rows, side, friction: Friction { friction } } => {
                LatticePile { rows, side, friction }.scene()
            }
        };
        scene.to_json()
    }
}

/// Returns the dimensions of a structure: their names, and which are whole numbers. `None` if there is no such structure.
pub(crate) fn dimensions(structure: &str) -> Option<Vec<(String, bool)>> {
    let command = command();
    let whole = |argument: &clap::Arg| argument.get_value_parser().type_id() == TypeId::of::<usize>();
    let arguments = command.find_subcommand(structure)?.get_arguments();
    let named = arguments.filter_map(|argument| Some((argument.get_long()?.replace('-', "_"), whole(argument))));
    Some(named.filter(|(name, _)| name != "help").collect())
}

/// Returns the number that a dimension of a structure has if it is not given.
pub(crate) fn default_of(structure: &str, dimension: &str) -> Option<f64> {
    let command = command();
    let mut arguments = command.find_subcommand(structure)?.get_arguments();
    let own = arguments.find(|argument| argument.get_long().is_some_and(|long| long.replace('-', "_") == dimension))?;
    own.get_default_values().first()?.to_str()?.parse().ok()
}

/// Returns the scene of a structure with these dimensions, or what is wrong with them.
pub(crate) fn structure(name: &str, dimensions: &[(String, String)]) -> Result<String, String> {
    let given = dimensions.iter().map(|(dimension, value)| format!("--{}={value}", dimension.replace('_', "-")));
    let words = [name.to_owned()].into_iter().chain(given);
    let matches = command().try_get_matches_from(words).and_then(|matches| Structure::from_arg_matches(&matches));
    let structure = matches.map_err(|error| {
        let text = error.to_string();
        text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned()
    })?;
    Ok(structure.text())
}

fn command() -> Command {
    Structure::augment_subcommands(Command::new("new").no_binary_name(true))
}

impl New {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let text = match &self.kind {
            Some(kind) => kind.text(),
            None => match self.example {
                Example::Stands => crate::mechanics::scene::starter().to_owned(),
                Example::Falls => crate::mechanics::scene::falling_starter().to_owned(),
            },
        };
        let file = destination::file(self.output.as_ref());
        destination::deliver(terminal, file, text.into_bytes(), self.force)?;
        if let Some(path) = file {
            let (shown, picture) = (path.display(), path.with_extension("svg"));
            let picture = picture.display();
            terminal.note(&format!("wrote {shown}; see what it does with: drystone render {shown} -o {picture}"));
        }
        Ok(ExitStatus::Done)
    }
}
