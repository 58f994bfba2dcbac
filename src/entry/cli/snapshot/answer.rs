//! Reviews snapshots in the terminal. It shows each snapshot that differs, as text and, if the terminal can show
//! pictures, as a picture, and asks whether to accept it.

use std::io::{self, BufRead};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::page::Page;
use crate::entry::cli::terminal::Terminal;
use crate::products::snapshot::outcome::{Acceptance, CheckOutcome, Snapshot};
use crate::products::snapshot::store::{self, Access};

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
pub(super) fn ask(terminal: &Terminal, report: &mut CheckOutcome) -> Result<ExitStatus, Vec<CliError>> {
    let pictures = pictures(terminal);
    let total = report.failing().count();
    let mut number = 0;
    let mut failed = Vec::new();
    let mut answers = io::stdin().lock().lines();
    'all: for snapshot in report.snapshots.iter_mut().filter(|s| !s.matches()) {
        number += 1;
        show(terminal, snapshot, pictures).map_err(|c| vec![c])?;
        loop {
            let mut page = Page::default();
            page.words(&format!("{number} of {total}, {}: ", snapshot.name));
            page.literal("accept? y(es), n(o), s(kip), q(uit) ");
            terminal.print(&page).map_err(|c| vec![c])?;
            // At the end of the input, no further snapshot is accepted.
            let Some(Ok(answer)) = answers.next() else {
                break 'all;
            };
            match answer.trim().to_lowercase().as_str() {
                "y" | "yes" => {
                    // Lock the folder for each snapshot separately, because people may take long to answer.
                    let _lock = store::lock_folders(snapshot.folders(), Access::Write);
                    if let Err(unwritten) = snapshot.store(Acceptance::Accept) {
                        failed.push(super::not_written(unwritten));
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
    Ok(super::ending(report))
}

fn show(terminal: &Terminal, snapshot: &Snapshot, pictures: Pictures) -> Result<(), CliError> {
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
