//! Any bytes are either a theme, which is written as a style file that gives the same theme, or a list of problems; never a
//! panic.

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
                let again = Theme::read(&written, Notation::Json, None).expect("our own file is sound");
                assert_eq!(again.to_json(), written);
            }
            Err(problems) => {
                assert!(!problems.0.is_empty(), "refused without a word");
                assert!(problems.0.iter().all(|p| !p.to_string().is_empty()));
            }
        }
    }
});
