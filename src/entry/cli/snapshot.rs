//! `drystone snapshot`: compares the results and pictures of scenes with references that are stored next to the scenes.

mod answer;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::entry::cli::destination;
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::page::Page;
use crate::entry::cli::progress::{BarVisibility, Progress};
use crate::entry::cli::terminal::Terminal;
use crate::pictures::output::file::{Existing, WriteError};
use crate::products::snapshot::outcome::{Acceptance, folders};
use crate::products::snapshot::store::{self, Access};
use crate::products::snapshot::{CheckOutcome, DiscoveryError, check, ci, discover, review};

/// Compare scenes and their pictures with stored references, and explain what changed
///
/// Every scene in the folders has its references next to it: name.txt (facts), name.svg and name.png. Changed and new
/// results are written next to them as .new.* and .diff.png until they are accepted. The file drystone-snapshots.toml
/// sets which layers are checked, at which widths, and with which tolerances.
///
/// Exit codes: 0 everything agrees with the references, 1 something differs, 2 a scene or the command line is wrong,
/// 4 a file could not be written.
#[derive(Debug, Args)]
pub(crate) struct Snapshot {
    /// Folders, or single scenes
    #[arg(value_name = "DIR", default_value = ".")]
    folders: Vec<PathBuf>,
    /// Write the results as references; refused if CI is set
    #[arg(long)]
    accept: bool,
    /// Write the results as references, even if CI is set
    #[arg(long)]
    accept_in_ci: bool,
    /// Check only scenes whose path, without .json, contains this text or matches it as a pattern with *; if it
    /// equals the path of a scene, check only this scene
    #[arg(long, value_name = "FILTER")]
    only: Option<String>,
    /// Write a page that shows the expected picture, the difference and the new picture. Without a file, review the
    /// changes in the terminal
    #[arg(long, value_name = "FILE.html", num_args = 0..=1)]
    review: Option<Option<PathBuf>>,
    /// Write the result as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Print the result as annotations that GitHub shows next to the code
    #[arg(long)]
    github: bool,
}

impl Snapshot {
    pub(crate) fn run(&self, terminal: &Terminal) -> Result<ExitStatus, Vec<CliError>> {
        let asks = matches!(self.review, Some(None));
        let accepts = self.accept || self.accept_in_ci;
        self.check_options(asks, accepts).map_err(|c| vec![c])?;
        let found = discover(&self.folders, self.only.as_deref()).map_err(complaints)?;
        if found.jobs.is_empty() && found.orphans.is_empty() && found.faults.is_empty() {
            return Err(vec![self.nothing_found_error()]);
        }
        let shown = if terminal.shows_progress() { BarVisibility::WhenLong } else { BarVisibility::Never };
        let folders = folders(found.jobs.iter().flat_map(|j| &j.parts).map(|p| &p.file));
        let access = if accepts { Access::Write } else { Access::Read };
        let turn = store::lock_folders(folders, access);
        let progress = Progress::begin(found.jobs.len(), shown);
        let mut report = check(found, &|name| {
            progress.doing(name);
            progress.step();
        });
        drop(progress);

        let failing: Vec<String> = report.failing().map(|s| s.name.clone()).collect();
        let described = report.lines();
        // Make the review page before the results are accepted, so that it still shows the accepted changes.
        let page = match &self.review {
            Some(Some(_)) => review::page(&report, &self.folders),
            _ => String::new(),
        };
        let unwritten = if accepts { report.store(Acceptance::Accept) } else { report.store(Acceptance::Propose) };
        self.write_reports(&report, page).map_err(|c| vec![c])?;
        drop(turn);
        self.print_result(terminal, &report, &described, accepts, &failing)?;
        match unwritten {
            // Without --accept, the files that could not be written only help people to inspect the differences. The
            // exit code does not depend on them.
            Err(failed) if !accepts => {
                for WriteError { path, why } in failed {
                    terminal.note(&format!("could not write {}: {why}", path.display()));
                }
            }
            Err(failed) => return Err(failed.into_iter().map(not_written).collect()),
            Ok(()) => {}
        }
        if asks {
            return answer::ask(terminal, &mut report);
        }
        Ok(ending(&report))
    }

    /// Writes the review page if `--review` names a file, and the JUnit file if `--junit` is given.
    fn write_reports(&self, report: &CheckOutcome, page: String) -> Result<(), CliError> {
        let mut written = Vec::new();
        if let Some(Some(file)) = &self.review {
            written.push((file.clone(), page.into_bytes()));
        }
        if let Some(file) = &self.junit {
            written.push((file.clone(), ci::junit(report).into_bytes()));
        }
        destination::write(&written, Existing::Replace)
    }

    /// Returns an error if options contradict each other, or if the review page is not an .html file. If the variable
    /// `CI` is set, also returns an error for accepting results or reviewing them in the terminal without
    /// `--accept-in-ci`.
    fn check_options(&self, asks: bool, accepts: bool) -> Result<(), CliError> {
        let refuse = |why: &str| Err(CliError::CommandLine(why.to_owned()));
        if let Some(Some(page)) = &self.review {
            let html = page.extension().is_some_and(|e| e.eq_ignore_ascii_case("html"));
            if !html {
                return Err(CliError::CommandLine(format!(
                    "--review {}: the page is an .html file; to review the changes in the terminal, put --review \
                    after the folders",
                    page.display()
                )));
            }
        }
        if asks && accepts {
            return refuse("--accept accepts all changes, and --review asks about each; leave one of them out");
        }
        if store::in_ci() && !self.accept_in_ci && (self.accept || asks) {
            return refuse(
                "CI is set, so nobody would inspect the new references; accept them on your own machine, or with \
                 --accept-in-ci if this is meant",
            );
        }
        let outputs: Vec<PathBuf> = self.review.iter().flatten().chain(&self.junit).cloned().collect();
        destination::refuse_overwrites(&outputs, &[])
    }

    fn nothing_found_error(&self) -> CliError {
        let places: Vec<String> = self.folders.iter().map(|f| f.display().to_string()).collect();
        let filter = self.only.as_ref().map_or_else(String::new, |f| {
            format!(" whose path {} {f:?}", if f.contains('*') { "fits" } else { "contains" })
        });
        CliError::CommandLine(format!(
            "there is no scene under {}{filter}: a scene is a .json file with the key \"drystone\"",
            places.join(", ")
        ))
    }

    /// Prints the differences (as annotations with `--github`) and a summary. If there are differences and they were
    /// not accepted, also prints the commands to review and to accept them.
    fn print_result(
        &self,
        terminal: &Terminal,
        report: &CheckOutcome,
        described: &[String],
        accepts: bool,
        failing: &[String],
    ) -> Result<(), Vec<CliError>> {
        let mut page = Page::default();
        if self.github {
            for annotation in ci::annotations(report) {
                page.line(&annotation);
            }
        } else if !terminal.is_quiet() {
            for line in described {
                page.line(line);
            }
        }
        terminal.print(&page).map_err(|c| vec![c])?;
        let after: Vec<&str> = report.failing().map(|s| s.name.as_str()).collect();
        let accepted = failing.iter().filter(|name| !after.contains(&name.as_str())).count();
        if accepts {
            terminal.note(&format!("{accepted} accepted; {}", report.summary()));
            return Ok(());
        }
        terminal.note(&report.summary());
        if !report.matches() {
            let places: Vec<String> =
                self.folders.iter().map(|f| crate::text::shell(&f.display().to_string())).collect();
            let places = places.join(" ");
            terminal.note(&format!("to review: drystone snapshot {places} --review review.html; to accept: drystone snapshot {places} --accept"));
        }
        Ok(())
    }
}

fn ending(report: &CheckOutcome) -> ExitStatus {
    if !report.faults.is_empty() {
        ExitStatus::WrongInput
    } else if report.matches() {
        ExitStatus::Done
    } else {
        ExitStatus::Unstable
    }
}

fn not_written(unwritten: WriteError) -> CliError {
    CliError::NotWritten { what: unwritten.path.display().to_string(), why: unwritten.why.to_string() }
}

fn complaints(faults: Vec<DiscoveryError>) -> Vec<CliError> {
    let name = |path: &Path| path.display().to_string();
    let complaint = |fault| match fault {
        DiscoveryError::Scene { path, problems } => CliError::Scene { name: name(&path), problems },
        DiscoveryError::Unreadable { path, reason } => CliError::NotRead { what: name(&path), why: reason },
        DiscoveryError::Settings { path, problem } => CliError::CommandLine(format!("{}:{problem}", path.display())),
        DiscoveryError::Clash(words) => CliError::CommandLine(words),
    };
    faults.into_iter().map(complaint).collect()
}
