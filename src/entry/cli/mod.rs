//! The command line, with one file per command.
//!
//! Commands write results to standard output or files, and everything else to standard error. They return an exit
//! code. A command, except `batch`, reads and checks all of its input before it writes anything, and writes an output
//! file completely or not at all.
//!
//! | code | meaning |
//! |---|---|
//! | 0 | done; with `check`, or `render --strict`: everything is stable |
//! | 1 | done, and something is unstable |
//! | 2 | the input or the command line is wrong; nothing was written, except by `batch` and `report`, which answer the valid scenes and list the others; or an internal fault occurred on a scene, and the command answered the other scenes |
//! | 3 | done, nothing is unstable, and something is undecided |
//! | 4 | the output could not be written |
//!
//! If several codes apply, the first of 2, 4, 1, 3 is used: errors matter more than verdicts, and a falling frame
//! matters more than an undecided one.

mod accuracy;
mod batch;
mod check;
pub(super) mod error;
mod destination;
pub(super) mod draw;
mod exit_status;
mod export;
mod figures;
mod import;
mod style_args;
mod mdbook;
mod new;
mod page;
mod plan;
pub(super) mod picture;
mod print;
mod progress;
mod render;
pub(super) mod report;
pub(super) mod missing_glyphs;
mod signal;
mod snapshot;
mod source;
mod table;
mod terminal;
pub(super) mod vary;
mod verify;
mod watch;
mod watchdog;

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::{OutputArgs, Terminal};
use crate::entry::cli::watchdog::Watchdog;
use crate::entry::value::TimeLimit;

const AFTER_LONG_HELP: &str = "\
A verdict of 'stands' means that a balance of forces exists for rigid blocks at rest, laid dry (no cohesion). A balance \
that exists only by wedging counts too.

Exit codes: 0 done and everything stands, 1 something falls, 2 the input or the command line is wrong, 3 something is \
undecided, 4 the output could not be written. A picture of a falling structure is a success: render, report and shapes \
end with 0 once it is written, unless --strict.";

/// Decide whether a structure of dry-laid blocks stands, find its forces, and draw figures
#[derive(Debug, Parser)]
#[command(name = "drystone", version, arg_required_else_help = true, max_term_width = 80, after_long_help = AFTER_LONG_HELP)]
struct CommandLine {
    #[command(flatten)]
    output: OutputArgs,
    #[command(subcommand)]
    command: Command,
}

/// Declares the commands: an enum, and the function that runs one of them.
macro_rules! commands {
    ($($(#[$name:meta])* $command:ident($args:ty),)*) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($(#[$name])* $command($args),)*
        }

        impl Command {
            fn run(&self, terminal: &Terminal) -> Ended {
                match self {
                    $(Command::$command(command) => command.run(terminal),)*
                }
            }
        }
    };
}

commands! {
    Render(Box<render::Render>),
    Figures(figures::Figures),
    Check(check::Check),
    Batch(Box<batch::Batch>),
    Verify(verify::Verify),
    Report(report::Report),
    Accuracy(accuracy::Accuracy),
    Schema(print::Schema),
    New(new::New),
    Plan(plan::Plan),
    Vary(Box<vary::Vary>),
    Import(import::Import),
    Export(export::Export),
    #[command(name = "mdbook")]
    MdBook(mdbook::MdBook),
    Markdown(mdbook::Markdown),
    Shapes(figures::Shapes),
    Snapshot(snapshot::Snapshot),
    Style(print::Style),
    Completions(print::Completions),
    #[command(name = "man")]
    Manual(print::Manual),
}

/// Runs the command line of this process and returns its exit code.
pub fn run() -> ExitCode {
    ExitCode::from(run_with(std::env::args_os()))
}

/// Runs a command line, whose first word is the name of the program, and returns the exit code.
pub fn run_with(words: impl Iterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = words.collect();
    let given = CommandLine::command().try_get_matches_from(join_list(words.clone().into_iter()));
    let (line, limit) = match given.and_then(|given| Ok((CommandLine::from_arg_matches(&given)?, time_limit(&given)))) {
        Ok((mut line, limit)) => {
            if let Command::Import(import) = &mut line.command {
                let typed = words.iter().skip(1).map(|word| word.to_string_lossy().into());
                import.words = ["drystone".to_owned()].into_iter().chain(typed).collect();
            }
            (line, limit)
        }
        Err(error) => {
            let printed = error.print().and_then(|()| io::stdout().flush());
            return refused(&error, printed).number();
        }
    };
    signal::listen();
    let terminal = Terminal::new(line.output);
    let _watchdog = Watchdog::start(limit, &terminal);
    let ending = line.command.run(&terminal).unwrap_or_else(|complaints| complain(&terminal, &complaints));
    ending.number()
}

/// Returns the time limit of a whole command. `batch` has one for each scene, and `--watch` one for each run.
fn time_limit(given: &ArgMatches) -> Option<TimeLimit> {
    let (name, own) = given.subcommand().filter(|(name, _)| *name != "batch")?;
    let watches = name == "render" && own.get_flag("watch");
    own.try_get_one::<TimeLimit>("time_limit").ok().flatten().filter(|_| !watches).copied()
}

/// Returns the exit status after `clap` has printed help, the version or an error. `printed` says whether the printing
/// succeeded.
fn refused(error: &clap::Error, printed: io::Result<()>) -> ExitStatus {
    if error.use_stderr() {
        return ExitStatus::WrongInput;
    }
    match terminal::written(printed) {
        Ok(()) => ExitStatus::Done,
        Err(complaint) => {
            // Standard output could not be written. If standard error cannot be written either, only the exit code
            // reports this.
            let page = complaint.page(terminal::error_width());
            let _ = write!(io::stderr(), "{}", page.text());
            complaint.ending()
        }
    }
}

fn complain(terminal: &Terminal, complaints: &[CliError]) -> ExitStatus {
    for complaint in complaints {
        terminal.refuse(complaint);
    }
    complaints.iter().map(CliError::ending).max().unwrap_or(ExitStatus::Done)
}

/// Joins the option `--margins` and a list in the next argument into one argument, `--margins=LIST`.
///
/// `check --margins scene.json` requests all margins, and `check --margins friction,tilt scene.json` requests two. The
/// argument after `--margins` is taken as a list if it looks like names, unless a file with this name exists.
fn join_list(words: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut joined: Vec<OsString> = Vec::new();
    for word in words {
        if let (Some(last), Some(list)) = (joined.last_mut(), word.to_str())
            && last == "--margins"
            && is_list(list)
        {
            last.push("=");
            last.push(list);
        } else {
            joined.push(word);
        }
    }
    joined
}

fn is_list(word: &str) -> bool {
    let letters = |c: char| c.is_ascii_lowercase() || matches!(c, ',' | '-' | '_');
    !word.starts_with('-') && word.chars().all(letters) && !Path::new(word).exists()
}
