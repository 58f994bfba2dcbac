//! Reports the progress of a batch on standard error: the number of scenes, the speed and the remaining time.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use crate::clock::Instant;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::terminal::Terminal;
use crate::entry::value::between;
use crate::mechanics::analysis::Verdict;
use crate::products::wording::number::counted as in_words;
use crate::products::wording::verdict::counted;

/// The default interval between two reports on a terminal.
const REPORT_INTERVAL: Duration = Duration::from_secs(2);

/// The progress of a batch.
pub(super) struct BatchProgress<'t> {
    terminal: &'t Terminal,
    start: Instant,
    /// The interval between two reports; `None` for no reports.
    every: Option<Duration>,
    reported: Instant,
    /// The size of all inputs in bytes; `None` if it is not known.
    all: Option<u64>,
    /// The number of bytes read so far, including `read_before`.
    read: Arc<AtomicU64>,
    /// The number of input bytes with scenes that an earlier run has answered.
    read_before: u64,
    /// The number of scenes that an earlier run has answered.
    before: usize,
    /// The number of scenes with each verdict of [`VERDICTS`], and the number of scenes that are not valid.
    counts: [usize; 4],
}

/// The verdicts in the order of the counts of [`BatchProgress`].
const VERDICTS: [Verdict; 3] = [Verdict::Stable, Verdict::Unstable, Verdict::Undecided];

impl<'t> BatchProgress<'t> {
    /// Starts the clock. `every` is the interval between two reports in seconds; if it is `None`, a terminal gets a
    /// report every 2 s, and any other output gets no reports. `all` is the size of the inputs in bytes, and `read`
    /// counts the bytes read so far.
    pub fn begin(
        terminal: &'t Terminal,
        every: Option<f64>,
        all: Option<u64>,
        read: Arc<AtomicU64>,
    ) -> BatchProgress<'t> {
        let now = Instant::now();
        let watched = terminal.shows_progress().then_some(REPORT_INTERVAL);
        BatchProgress {
            terminal,
            start: now,
            every: every.map(Duration::from_secs_f64).or(watched),
            reported: now,
            all,
            read,
            read_before: 0,
            before: 0,
            counts: [0; 4],
        }
    }

    /// Sets the number of scenes that an earlier run has answered, prints this number if it is not 0, and restarts the
    /// clock.
    pub fn skipped(&mut self, scenes: usize) {
        self.before = scenes;
        self.read_before = self.read.load(Ordering::Relaxed);
        self.start = Instant::now();
        if scenes > 0 {
            self.terminal.note(&format!("{scenes} scenes are answered already"));
        }
    }

    /// Counts one more answered scene, and prints a report if the interval since the last report has passed.
    pub fn step(&mut self, ending: ExitStatus) {
        let kind = match ending {
            ExitStatus::Done => 0,
            ExitStatus::Unstable => 1,
            ExitStatus::Undecided => 2,
            ExitStatus::WrongInput | ExitStatus::NotWritten => 3,
        };
        self.counts[kind] += 1;
        let now = Instant::now();
        if self.every.is_some_and(|every| now - self.reported >= every) {
            self.reported = now;
            let words = self.words((now - self.start).as_secs_f64());
            self.terminal.note(&words);
        }
    }

    /// Prints the totals of this run, with the time if progress is reported.
    pub fn end(&self) {
        let seconds = self.start.elapsed().as_secs_f64();
        let counts: Vec<String> = (self.counts.iter().enumerate())
            .filter(|(_, count)| **count > 0)
            .map(|(kind, count)| match VERDICTS.get(kind) {
                Some(verdict) => counted(*count, *verdict),
                None => format!("{count} not valid"),
            })
            .collect();
        let done: usize = self.counts.iter().sum();
        let rate = done as f64 / seconds.max(1e-9);
        let pace = self.every.map(|_| format!(" in {seconds:.1} s, {rate:.0} a second"));
        self.terminal.note(&format!(
            "{}{}: {}",
            in_words(done, "scene"),
            pace.unwrap_or_default(),
            if counts.is_empty() { "nothing to do".to_owned() } else { counts.join(", ") }
        ));
    }

    fn words(&self, seconds: f64) -> String {
        let done: usize = self.counts.iter().sum();
        let rate = done as f64 / seconds.max(1e-9);
        let read = self.read.load(Ordering::Relaxed);
        let left = self.all.and_then(|all| {
            let (own, rest) = (read.checked_sub(self.read_before)? as f64, all.checked_sub(read)? as f64);
            (own > 0.0).then(|| format!(", {} left", span(seconds * rest / own)))
        });
        format!("{} scenes, {rate:.0} a second{}", self.before + done, left.unwrap_or_default())
    }
}

/// Returns a duration in at most two units: `59 s`, `3 min 20 s` or `1 h 2 min`.
fn span(seconds: f64) -> String {
    let whole = seconds.round().max(0.0) as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, m, s) => format!("{m} min {s} s"),
        (h, m, _) => format!("{h} h {m} min"),
    }
}

/// Parses the interval between two progress reports, in seconds.
pub(super) fn seconds(typed: &str) -> Result<f64, String> {
    between(typed, [0.01, 86_400.0], || "give a time in seconds, from 0.01 to 86400".into())
}

#[cfg(test)]
mod tests {
    use super::span;

    #[test]
    fn times_are_written_in_at_most_two_units() {
        for (seconds, words) in [(0.4, "0 s"), (59.6, "1 min 0 s"), (3_725.0, "1 h 2 min"), (200_000.0, "55 h 33 min")]
        {
            assert_eq!(span(seconds), words);
        }
    }
}
