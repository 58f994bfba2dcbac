//! `drystone snapshot`: compares the results and pictures of scenes with references that are stored next to the scenes. A
//! review in the terminal shows each snapshot that differs, as text and, if the terminal can show pictures, as a picture,
//! and asks whether to accept it.

use std::io::{self, BufRead};
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use clap::Args;

use super::destination;
use super::error::{CliError, Ended};
use super::exit_status::ExitStatus;
use super::page::Page;
use super::progress::Progress;
use super::source::stem;
use super::terminal::Terminal;
use crate::pictures::output::file::{Existing, WriteError};
use crate::products::snapshot::outcome::{self, Acceptance, folders};
use crate::products::snapshot::store::{self, Access};
use crate::products::snapshot::{CheckOutcome, check, ci, discover, review, summary};
use crate::read;

/// Compare scenes and their pictures with stored references, and explain what changed
///
/// Every scene in the folders has its references next to it: name.txt (facts), name.svg and name.png. Changed and new
/// results are written next to them as .new.* and .diff.png until they are accepted. The file drystone-snapshots.toml
/// sets which layers are checked, at which widths, and with which tolerances.
///
/// Exit codes: 0 everything agrees with the references, 1 something differs, 2 a scene or the command line is wrong,
/// 4 a file could not be written. If a scene is wrong, the other scenes are still checked.
#[derive(Debug, Args)]
pub(crate) struct Snapshot {
    /// Folders, or single scenes
    #[arg(value_name = "DIR", default_value = ".")]
    folders: Vec<PathBuf>,
    /// Write the results as references; refused if CI is set
    #[arg(long)]
    accept: bool,
    /// Write only results that have no reference yet; refused if CI is set
    #[arg(long, conflicts_with = "accept")]
    accept_new: bool,
    /// Delete orphaned references; refused if CI is set
    #[arg(long)]
    prune: bool,
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
    /// Write a summary as Markdown, for a comment or the summary of a job, with its pictures in a folder next to it
    #[arg(long, value_name = "FILE.md")]
    summary: Option<PathBuf>,
    /// Write the result as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Print the result as annotations that GitHub shows next to the code
    #[arg(long)]
    github: bool,
    /// Print the result as JSON
    #[arg(long, conflicts_with = "github")]
    json: bool,
}

impl Snapshot {
    pub(crate) fn run(&self, terminal: &Terminal) -> Ended {
        let asks = matches!(self.review, Some(None));
        let acceptance = if self.accept_new {
            Acceptance::AcceptNew
        } else if self.accept || self.accept_in_ci {
            Acceptance::Accept
        } else {
            Acceptance::Propose
        };
        self.check_options(asks, acceptance)?;
        let found = discover(&self.folders, self.only.as_deref())
            .map_err(|errors| errors.into_iter().map(CliError::CommandLine).collect::<Vec<_>>())?;
        let mut notes: Vec<String> = found.jobs.iter().flat_map(|job| job.settings.notes()).collect();
        notes.sort();
        notes.dedup();
        notes.iter().for_each(|note| terminal.note(note));
        if found.jobs.is_empty() && found.orphans.is_empty() && found.faults.is_empty() {
            return Err(vec![self.nothing_found_error()]);
        }

        let files = found.jobs.iter().flat_map(|j| &j.parts).map(|p| &p.file);
        let folders = folders(files.chain(found.orphans.iter().map(|(file, _)| file)));
        let only_reads = acceptance == Acceptance::Propose && !self.prune;
        let turn = store::lock_folders(folders, if only_reads { Access::Read } else { Access::Write });
        let progress = Progress::begin(found.jobs.len(), terminal.shows_progress());
        let mut report = check(found, &|name| {
            progress.doing(name);
            progress.step();
        });
        drop(progress);

        let pruned = if self.prune { report.prune() } else { Ok(()) };
        let failing = report.failing().count();
        let described = report.changes();
        // Describe the changes before the results are accepted, so that the pages still show the accepted changes.
        let pages = self.pages(&report);
        let unwritten = report.store(acceptance);
        self.write_reports(&report, pages)?;
        drop(turn);
        self.print_result(terminal, &report, &described, failing, acceptance)?;
        let mut errors: Vec<CliError> = pruned.err().into_iter().flatten().map(not_written).collect();
        match unwritten {
            // Without --accept, the files that could not be written only help people to inspect the differences. The
            // exit code does not depend on them.
            Err(failed) if acceptance == Acceptance::Propose => {
                for WriteError { path, why } in failed {
                    terminal.note(&format!("could not write {}: {why}", path.display()));
                }
            }
            unwritten => errors.extend(unwritten.err().into_iter().flatten().map(not_written)),
        }
        let ending = if asks && errors.is_empty() { ask(terminal, &mut report)? } else { ending(&report) };
        errors.extend(report.faults.into_iter().map(|(path, problems)| {
            let name = path.display().to_string();
            CliError::Scene { name, problems }
        }));
        if errors.is_empty() { Ok(ending) } else { Err(errors) }
    }

    /// Returns the path and the content of the review page if `--review` names a file, and of the summary with its
    /// pictures if `--summary` is given.
    fn pages(&self, report: &CheckOutcome) -> Vec<(PathBuf, Vec<u8>)> {
        let mut pages = Vec::new();
        if let Some(Some(file)) = &self.review {
            pages.push((file.clone(), review::page(report, &self.folders).into_bytes()));
        }
        if let Some(file) = &self.summary {
            let folder = format!("{}-pictures", stem(file).replace(['<', '>'], "-"));
            let (text, pictures) = summary::markdown(report, &folder);
            pages.push((file.clone(), text.into_bytes()));
            pages.extend(pictures.into_iter().map(|(name, png)| (file.with_file_name(&folder).join(name), png)));
        }
        pages
    }

    /// Writes the pages, and the JUnit file if `--junit` is given.
    fn write_reports(&self, report: &CheckOutcome, mut written: Vec<(PathBuf, Vec<u8>)>) -> Result<(), CliError> {
        if let Some((picture, _)) = written.iter().find(|(file, _)| read::file::ending(file) == "png") {
            let mut folders = picture.ancestors().skip(1);
            let [own, above] = [(); 2].map(|()| folders.next().unwrap_or(Path::new("")));
            destination::make_folder(own, above)?;
        }
        if let Some(file) = &self.junit {
            written.push((file.clone(), ci::junit(report).into_bytes()));
        }
        destination::write(&written, Existing::Replace, &self.outputs())
    }

    /// Returns an error if options contradict each other, or if the review page is not an .html file. If the variable
    /// `CI` is set, also returns an error for accepting results or reviewing them in the terminal without
    /// `--accept-in-ci`.
    fn check_options(&self, asks: bool, acceptance: Acceptance) -> Result<(), CliError> {
        let refuse = |why: &str| Err(CliError::CommandLine(why.to_owned()));
        if let Some(Some(page)) = &self.review
            && read::file::ending(page) != "html"
        {
            return Err(CliError::CommandLine(format!(
                "--review {}: the page is an .html file; to review the changes in the terminal, put --review \
                 after the folders",
                page.display()
            )));
        }
        if asks && acceptance != Acceptance::Propose {
            return refuse("--accept accepts all changes, and --review asks about each; leave one of them out");
        }
        if asks && self.json {
            return refuse("--review asks questions where --json prints JSON; leave one of them out");
        }
        let changes_references = acceptance != Acceptance::Propose || self.prune || asks;
        if store::in_ci() && !self.accept_in_ci && changes_references {
            return refuse(
                "CI is set, so nobody would inspect the new references; accept them on your own machine, or with \
                 --accept-in-ci if this is meant",
            );
        }
        destination::refuse_overwrites(&self.outputs(), &[])
    }

    /// Returns the files that the user named for pages and lists.
    fn outputs(&self) -> Vec<PathBuf> {
        self.review.iter().flatten().chain(&self.summary).chain(&self.junit).cloned().collect()
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

    /// Prints the differences (as annotations with `--github`, as JSON with `--json`) and a summary. If there are
    /// differences and they were not accepted, also prints the commands to review and to accept them. `failing` is the
    /// number of snapshots that differed before results were accepted.
    fn print_result(
        &self,
        terminal: &Terminal,
        report: &CheckOutcome,
        described: &[String],
        failing: usize,
        acceptance: Acceptance,
    ) -> Result<(), Vec<CliError>> {
        let mut page = Page::default();
        if self.json {
            terminal.print_bytes(ci::json(report).as_bytes())?;
        } else if self.github {
            ci::annotations(report).iter().for_each(|annotation| page.line(annotation));
        } else if !terminal.is_quiet() {
            described.iter().for_each(|line| page.line(line));
            report.pruned.iter().for_each(|file| page.line(&format!("{}: deleted", file.display())));
        }
        terminal.print(&page)?;
        if acceptance != Acceptance::Propose {
            let accepted = failing - report.failing().count();
            terminal.note(&format!("{accepted} accepted; {}", report.summary()));
            return Ok(());
        }
        report.snapshots.iter().flat_map(|s| &s.notes).for_each(|note| terminal.note(note));
        terminal.note(&report.summary());
        if report.failing().next().is_some() {
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

/// The way in which a terminal shows pictures within its text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pictures {
    /// The protocol of iTerm2 and WezTerm.
    Inline,
    /// The protocol of kitty and Ghostty.
    Kitty,
    /// The terminal shows no pictures.
    None,
}

/// The largest part of an encoded picture in one message to kitty, in bytes.
const MAX_CHUNK_BYTES: usize = 4096;

/// Asks for each snapshot that differs whether to accept it: `y` accepts it, `n` and `s` keep the reference, and `q`
/// ends the review. Returns an error if an accepted snapshot could not be written.
fn ask(terminal: &Terminal, report: &mut CheckOutcome) -> Ended {
    let pictures = pictures(terminal);
    let total = report.failing().count();
    let mut number = 0;
    let mut failed = Vec::new();
    let mut answers = io::stdin().lock().lines();
    'all: for snapshot in report.snapshots.iter_mut().filter(|s| !s.matches()) {
        number += 1;
        show(terminal, snapshot, pictures)?;
        loop {
            let mut page = Page::default();
            page.words(&format!("{number} of {total}, {}: ", snapshot.name));
            page.literal("accept? y(es), n(o), s(kip), q(uit) ");
            terminal.print(&page)?;
            // At the end of the input, no further snapshot is accepted.
            let Some(Ok(answer)) = answers.next() else {
                break 'all;
            };
            match answer.trim().to_lowercase().as_str() {
                "y" | "yes" => {
                    // Lock the folder for each snapshot separately, because people may take long to answer.
                    let _lock = store::lock_folders(snapshot.folders(), Access::Write);
                    if let Err(unwritten) = snapshot.store(Acceptance::Accept) {
                        failed.push(not_written(unwritten));
                    }
                    break;
                }
                "n" | "no" | "s" | "skip" => break,
                "q" | "quit" => break 'all,
                _ => {}
            }
        }
    }
    terminal.note(&report.summary());
    if !failed.is_empty() {
        return Err(failed);
    }
    Ok(ending(report))
}

fn show(terminal: &Terminal, snapshot: &outcome::Snapshot, pictures: Pictures) -> Result<(), CliError> {
    let mut page = Page::default();
    page.end();
    page.line(&snapshot.name);
    for line in snapshot.lines() {
        page.line(&line);
    }
    terminal.print(&page)?;
    for finding in &snapshot.findings {
        // Show the picture of the difference if there is one, otherwise the new picture.
        let fresh = Some(&finding.fresh).filter(|fresh| fresh.starts_with(b"\x89PNG"));
        let png = finding.difference.as_ref().or(finding.picture.as_ref()).or(fresh);
        if let Some(png) = png {
            terminal.print_bytes(&drawn(png, pictures))?;
        }
    }
    Ok(())
}

fn pictures(terminal: &Terminal) -> Pictures {
    if !terminal.is_watched() {
        return Pictures::None;
    }
    let value = |name: &str| std::env::var(name).unwrap_or_default();
    let program = value("TERM_PROGRAM");
    match program.as_str() {
        "iTerm.app" | "WezTerm" => Pictures::Inline,
        "ghostty" => Pictures::Kitty,
        _ if !value("KITTY_WINDOW_ID").is_empty() || value("TERM") == "xterm-kitty" => Pictures::Kitty,
        _ => Pictures::None,
    }
}

/// Returns the escape sequences that make a terminal show a PNG picture, with the picture encoded in base64. Returns
/// nothing for a terminal that shows no pictures.
fn drawn(png: &[u8], pictures: Pictures) -> Vec<u8> {
    let data = STANDARD.encode(png);
    match pictures {
        Pictures::None => Vec::new(),
        Pictures::Inline => format!("\x1b]1337;File=inline=1;width=80%:{data}\x07\n").into_bytes(),
        Pictures::Kitty => {
            let pieces: Vec<&[u8]> = data.as_bytes().chunks(MAX_CHUNK_BYTES).collect();
            let mut out = Vec::new();
            for (number, piece) in pieces.iter().enumerate() {
                let begin = if number == 0 { "f=100,a=T," } else { "" };
                let more = usize::from(number + 1 < pieces.len());
                out.extend(format!("\x1b_G{begin}m={more};").bytes());
                out.extend_from_slice(piece);
                out.extend(b"\x1b\\");
            }
            out.push(b'\n');
            out
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_sent_completely_and_only_to_terminals_that_show_them() {
        let png: Vec<u8> = (0..10_000u32).map(|i| i as u8).collect();
        assert!(drawn(&png, Pictures::None).is_empty());
        let inline = String::from_utf8(drawn(&png, Pictures::Inline)).expect("ASCII");
        assert!(inline.starts_with("\x1b]1337;File=inline=1") && inline.ends_with("\x07\n"));
        let kitty = String::from_utf8(drawn(&png, Pictures::Kitty)).expect("ASCII");
        let data: String = kitty
            .split("\x1b_G")
            .filter_map(|piece| piece.split_once(';'))
            .map(|(_, data)| data.trim_end().trim_end_matches("\x1b\\"))
            .collect();
        assert_eq!(STANDARD.decode(data).expect("base 64"), png);
        assert_eq!((kitty.matches("m=1").count(), kitty.matches("m=0").count()), (3, 1));
    }
}
