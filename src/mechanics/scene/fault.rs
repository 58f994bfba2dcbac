//! [`isolate`]: runs a function for one scene, so that an internal error of drystone does not affect other scenes.
//!
//! Commands that process several scenes call it for each scene. If the program panics on a scene, only this scene gets
//! a problem, and the other scenes are still processed.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::{Code, Problem, SceneError};

/// An environment variable for tests, which only builds with debug assertions read. If its value is `faulty#2`, the
/// second call of [`isolate`] with a name that contains `faulty` panics.
#[cfg(debug_assertions)]
const FAULT_VARIABLE: &str = "DRYSTONE_TEST_FAULT";

/// Calls `work` for one scene. If `work` panics, the panic becomes a problem with the code [`Code::InternalFault`].
///
/// `name` is the path of the scene, or another name for it. Only tests use it, to select a scene. A panic can leave the
/// data that `work` changes in an invalid state, so the caller must not use these data afterwards.
///
/// # Errors
/// If `work` panics: the internal error, as the only problem of the scene.
pub(crate) fn isolate<R>(name: &str, work: impl FnOnce() -> R) -> Result<R, SceneError> {
    let work = || {
        inject_fault(name);
        work()
    };
    catch_unwind(AssertUnwindSafe(work)).map_err(|_| SceneError { text: None, list: vec![internal_fault()] })
}

#[cfg(debug_assertions)]
fn inject_fault(name: &str) {
    use std::sync::atomic::{AtomicUsize, Ordering};

    static WORKS: AtomicUsize = AtomicUsize::new(0);
    let Ok(injected) = std::env::var(FAULT_VARIABLE) else {
        return;
    };
    let (part, number) = injected.rsplit_once('#').unwrap_or((&injected, "1"));
    if name.contains(part) {
        let works = WORKS.fetch_add(1, Ordering::Relaxed) + 1;
        assert!(works.to_string() != number, "a fault was injected into {name}");
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
        message: "an internal error of the program occurred on this scene; the scene itself may be correct".into(),
        help: "please report this error together with the scene".into(),
        place: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_problem_and_a_result_is_returned_unchanged() {
        assert_eq!(isolate("a.json", || 7), Ok(7));
        let numbers: Vec<usize> = Vec::new();
        let fault = isolate("a.json", || numbers[3]).expect_err("a fault");
        assert_eq!(fault.list.len(), 1);
        assert_eq!(fault.list[0].code, Code::InternalFault);
        assert!(fault.list[0].help.contains("report"));
    }
}
