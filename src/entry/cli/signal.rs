//! Handles signals: deletes temporary files before a signal ends the process.
//!
//! No other file uses `signal-hook`. Only Unix systems have such signals.

#[cfg(unix)]
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
#[cfg(unix)]
use signal_hook::iterator::Signals;
#[cfg(unix)]
use signal_hook::low_level::emulate_default_handler;

/// Starts a thread that handles signals until the process ends.
#[cfg(unix)]
pub(crate) fn listen() {
    let ignored = ignored();
    let wanted = [SIGINT, SIGTERM, SIGHUP, SIGXFSZ];
    let wanted = wanted.into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // If no handler can be installed, signals have their default effect.
    let Ok(mut signals) = Signals::new(wanted) else {
        return;
    };
    let listener = std::thread::Builder::new().name("signals".into());
    let _ = listener.spawn(move || {
        for signal in signals.forever() {
            // SIGXFSZ: the file exceeds its size limit. The write fails, as on a full disk, and its error is reported.
            if signal == SIGXFSZ {
                continue;
            }
            // Keep the guard until the end, so that no thread creates another temporary file.
            let nothing_new = crate::pictures::output::file::abandon();
            let _ = emulate_default_handler(signal);
            drop(nothing_new);
        }
    });
}

/// Returns the signals that this process has ignored since its start, for example because `nohup` started it. Each
/// signal is one bit; signal 1 is the lowest bit. Only Linux reports which signals are ignored; on other systems, the
/// result is 0.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// Does nothing, because signals are handled only on Unix.
#[cfg(not(unix))]
pub(crate) fn listen() {}
