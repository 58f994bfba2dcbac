//! [`DeadlineGuard`]: a time limit for all optimisation programs that a thread solves.

use std::cell::Cell;

use crate::clock::Instant;

thread_local! {
    /// The time after which solvers on this thread stop; `None` if there is no time limit.
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// While this guard exists, all solvers on this thread stop at the deadline that was given to [`DeadlineGuard::new`].
///
/// The deadline applies to all optimisation programs that a thread solves, one after another. It is a thread-local
/// value, so that it need not be an argument of every function that solves one of them.
#[derive(Debug)]
pub(crate) struct DeadlineGuard {
    former: Option<Instant>,
}

impl DeadlineGuard {
    /// Sets the deadline of this thread; `None` means no deadline. When the guard is dropped, the previous deadline
    /// applies again.
    pub(crate) fn new(deadline: Option<Instant>) -> DeadlineGuard {
        DeadlineGuard { former: DEADLINE.replace(deadline) }
    }
}

impl Drop for DeadlineGuard {
    fn drop(&mut self) {
        DEADLINE.set(self.former);
    }
}

/// Returns the deadline of this thread; `None` if it has no deadline.
pub(crate) fn deadline() -> Option<Instant> {
    DEADLINE.get()
}

/// True if the deadline of this thread has passed.
pub(crate) fn is_late() -> bool {
    deadline().is_some_and(|end| Instant::now() >= end)
}
