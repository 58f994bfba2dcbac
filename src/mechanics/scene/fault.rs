//! [`isolate`]: limits an internal fault of the program to the scene on which it happened.
//!
//! Every command that answers several scenes runs each of them in here. A panic becomes a problem of that one scene, and the
//! other scenes are answered.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::{Code, Problem, SceneError};

/// In builds with debug assertions, `faulty#2` in this variable makes the second work on a scene whose name contains `faulty`
/// end in a fault. It lets tests look at what every command does then.
#[cfg(debug_assertions)]
const INJECTED: &str = "DRYSTONE_TEST_FAULT";

/// Runs `work` for one scene. A panic becomes a problem with the code [`Code::InternalFault`].
///
/// `name` is how a person knows the scene: its path. The work may leave its own data half done, so nothing that it changes may
/// be used after a fault.
///
/// # Errors
/// The fault, as the one problem of the scene.
pub(crate) fn isolate<R>(name: &str, work: impl FnOnce() -> R) -> Result<R, SceneError> {
    let work = || {
        inject_fault(name);
        work()
    };
    catch_unwind(AssertUnwindSafe(work)).map_err(|_| SceneError {
        text: None,
        list: vec![internal_fault()],
    })
}

#[cfg(debug_assertions)]
fn inject_fault(name: &str) {
    use std::sync::atomic::{AtomicUsize, Ordering};

    static WORKS: AtomicUsize = AtomicUsize::new(0);
    let Ok(injected) = std::env::var(INJECTED) else {
        return;
    };
    let (part, number) = injected.rsplit_once('#').unwrap_or((&injected, "1"));
    if name.contains(part) {
        let works = WORKS.fetch_add(1, Ordering::Relaxed) + 1;
        assert!(
            works.to_string() != number,
            "a fault was injected into {name}"
        );
    }
}

#[cfg(not(debug_assertions))]
fn inject_fault(_: &str) {}

fn internal_fault() -> Problem {
    Problem {
        code: Code::InternalFault,
        path: String::new(),
        line: 0,
        column: 0,
        span: None,
        message:
            "the program failed on this scene; that is its own fault and no fault of the scene"
                .into(),
        help: "please report it with the scene".into(),
        place: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_problem_and_an_answer_stays_an_answer() {
        assert_eq!(isolate("a.json", || 7), Ok(7));
        let numbers: Vec<usize> = Vec::new();
        let fault = isolate("a.json", || numbers[3]).expect_err("a fault");
        assert_eq!(fault.list.len(), 1);
        assert_eq!(fault.list[0].code, Code::InternalFault);
        assert!(fault.list[0].help.contains("report"));
    }
}
