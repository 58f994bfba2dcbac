//! [`Progress`]: a progress bar on standard error, which appears when the work takes longer than half a second.
//!
//! No other file uses `indicatif`. The bar counts steps of work. If margins are computed, the number of computed
//! verdicts is shown next to the bar: a margin needs the verdicts of many changed frames, for example tilted ones. The
//! bar is removed when the work is done.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::mechanics::analysis::trials;

/// The bar appears after this time, so shorter work has no bar.
const BAR_DELAY: Duration = Duration::from_millis(500);

/// The progress of a command, shown as a bar.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    waiter: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Starts a progress bar with this number of steps, which appears if the work takes longer than half a second and
    /// `is_shown` is true.
    pub(crate) fn begin(steps: usize, is_shown: bool) -> Progress {
        if is_shown {
            Progress::on(steps, BAR_DELAY, ProgressDrawTarget::stderr())
        } else {
            Progress { bar: ProgressBar::hidden(), waiter: None }
        }
    }

    fn on(steps: usize, patience: Duration, target: ProgressDrawTarget) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(steps as u64), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {wide_bar} {pos}/{len}{trials} {elapsed}") {
            let before = trials();
            let counted = move |_: &ProgressState, to: &mut dyn std::fmt::Write| {
                let since = trials().saturating_sub(before);
                if since > 0 {
                    // If this text cannot be written, the bar is drawn without it.
                    let _ = write!(to, ", {since} verdicts for margins,");
                }
            };
            bar.set_style(style.with_key("trials", counted));
        }
        let (done, over) = channel();
        let waiting = bar.clone();
        let waiter = thread::spawn(move || {
            if over.recv_timeout(patience) == Err(RecvTimeoutError::Timeout) {
                waiting.set_draw_target(target);
                // One step may take many seconds. The spinner keeps moving, so that the user sees that the program is
                // working.
                waiting.enable_steady_tick(Duration::from_millis(100));
                waiting.tick();
            }
        });
        Progress { bar, waiter: Some((done, waiter)) }
    }

    /// Shows a description of the current work.
    pub(crate) fn doing(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// Counts one finished step.
    pub(crate) fn step(&self) {
        self.bar.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((done, waiter)) = self.waiter.take() {
            drop(done);
            // Ignore the result: if the thread has panicked, no bar is shown, and the work is done anyway.
            let _ = waiter.join();
        }
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::sync::{Arc, Mutex};

    use indicatif::TermLike;

    use super::*;

    #[derive(Clone, Debug, Default)]
    struct Paper(Arc<Mutex<String>>);

    impl Paper {
        fn put(&self, text: &str) -> io::Result<()> {
            self.0.lock().expect("never poisoned").push_str(text);
            Ok(())
        }

        fn text(&self) -> String {
            self.0.lock().expect("never poisoned").clone()
        }
    }

    impl TermLike for Paper {
        fn width(&self) -> u16 {
            80
        }
        fn move_cursor_up(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn write_line(&self, text: &str) -> io::Result<()> {
            self.put(text)
        }
        fn write_str(&self, text: &str) -> io::Result<()> {
            self.put(text)
        }
        fn clear_line(&self) -> io::Result<()> {
            Ok(())
        }
        fn flush(&self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn the_progress_of_margins_counts_verdicts() {
        let paper = Paper::default();
        let target = ProgressDrawTarget::term_like(Box::new(paper.clone()));
        let progress = Progress::on(1, Duration::ZERO, target);
        let scene = crate::mechanics::scene::Scene::from_json(
            r#"{ "drystone": 1, "blocks": [{ "id": "a", "polygon": [[0, 0], [3, 0], [0, 2]] }] }"#,
        );
        let options =
            crate::mechanics::analysis::Options::default().margins(crate::mechanics::analysis::MarginKinds::ALL);
        crate::mechanics::analysis::Analysis::with(scene.expect("valid"), &options);
        thread::sleep(Duration::from_millis(300));
        drop(progress);
        let drawn = paper.text();
        assert!(drawn.contains("verdicts for margins"), "{drawn:?}");
    }

    fn drawn(patience: Duration, work: Duration) -> String {
        let paper = Paper::default();
        let progress = Progress::on(3, patience, ProgressDrawTarget::term_like(Box::new(paper.clone())));
        progress.doing("wall.json");
        progress.step();
        thread::sleep(work);
        progress.step();
        drop(progress);
        paper.text()
    }

    #[test]
    fn short_work_draws_nothing() {
        assert_eq!(drawn(Duration::from_secs(60), Duration::ZERO), "");
    }

    #[test]
    fn long_work_draws_a_bar_with_its_name() {
        let drawn = drawn(Duration::ZERO, Duration::from_millis(300));
        assert!(drawn.contains("wall.json"), "{drawn:?}");
        assert!(drawn.contains("1/3"), "{drawn:?}");
    }
}
