//! What a signal does to a run: half-written files are taken away before it ends the process as it always does.
//!
//! The only file that names signal-hook. Other systems than Unix end a process without a word, and need nothing here.

#[cfg(unix)]
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
#[cfg(unix)]
use signal_hook::iterator::Signals;
#[cfg(unix)]
use signal_hook::low_level::emulate_default_handler;

/// Listens for as long as the process lives.
#[cfg(unix)]
pub(crate) fn listen() {
    let ignored = ignored();
    let wanted = [SIGINT, SIGTERM, SIGHUP, SIGXFSZ];
    let wanted = wanted
        .into_iter()
        .filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // Where the system gives no handler, signals do what they do without one.
    let Ok(mut signals) = Signals::new(wanted) else {
        return;
    };
    let listener = std::thread::Builder::new().name("signals".into());
    let _ = listener.spawn(move || {
        for signal in signals.forever() {
            // A file that grows beyond its limit: the write fails then, as on a full disk, and that is reported.
            if signal == SIGXFSZ {
                continue;
            }
            let nothing_new = crate::output::file::abandon();
            let _ = emulate_default_handler(signal);
            drop(nothing_new);
        }
    });
}

/// The signals that the parent process wants ignored (as `nohup` does), one bit each, the first the lowest. Linux reports them; elsewhere
/// none are known.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .unwrap_or(0)
}

/// Nothing to listen to.
#[cfg(not(unix))]
pub(crate) fn listen() {}
