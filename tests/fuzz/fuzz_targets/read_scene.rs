//! Any bytes are either read as a scene or refused with a list of problems. Each problem has a message, and its
//! position lies inside the text. Nothing panics.

#![no_main]

use drystone::Scene;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Err(problems) = Scene::from_slice(bytes) else {
        return;
    };
    assert!(!problems.list.is_empty(), "refused without a problem");
    for problem in &problems.list {
        assert!(!problem.message.is_empty());
        if let (Some(span), Some(text)) = (&problem.span, &problems.text) {
            assert!(span.start <= span.end && span.end <= text.len(), "{problem:?}");
            assert!(text.is_char_boundary(span.start) && text.is_char_boundary(span.end), "{problem:?}");
        }
    }
    assert!(!problems.to_string().is_empty());
});
