//! Any bytes are either read as a theme or refused with a list of problems. A theme that is written as a style file
//! and read again is the same theme. Nothing panics.

#![no_main]

use drystone::drawing::Theme;
use drystone::drawing::style::format::Notation;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    for notation in [Notation::Json, Notation::Toml] {
        match Theme::read(&text, notation, None) {
            Ok(theme) => {
                let written = theme.to_json();
                let again = Theme::read(&written, Notation::Json, None).expect("a file that we write is valid");
                assert_eq!(again.to_json(), written);
            }
            Err(problems) => {
                assert!(!problems.0.is_empty(), "refused without a problem");
                assert!(problems.0.iter().all(|p| !p.to_string().is_empty()));
            }
        }
    }
});
