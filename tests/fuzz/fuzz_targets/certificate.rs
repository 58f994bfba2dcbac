//! Any certificate is proved by the checker of the library and by `examples/verify/verify.py`, or by neither. Nothing
//! panics, and both end.

#![no_main]

use std::io::Write;
use std::process::Command;

use drystone::certificate::Certificate;
use libfuzzer_sys::fuzz_target;

const VERIFY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/verify/verify.py");

fuzz_target!(|bytes: &[u8]| {
    let Ok(certificate) = Certificate::from_json(bytes) else {
        return;
    };
    let Ok(checked) = certificate.check() else {
        return;
    };
    let path = std::env::temp_dir().join(format!("drystone-fuzz-{}.json", std::process::id()));
    std::fs::File::create(&path).and_then(|mut file| file.write_all(bytes)).expect("a file");
    let by_python = Command::new("python3").arg(VERIFY).arg(&path).output().expect("python3");
    // A certificate that needs too much arithmetic is given up by the library.
    let is_given_up =
        checked.frames.iter().flat_map(|frame| &frame.faults).any(|fault| fault.contains("steps of arithmetic"));
    let said = String::from_utf8_lossy(&by_python.stdout);
    assert!(by_python.stderr.is_empty(), "{}", String::from_utf8_lossy(&by_python.stderr));
    assert!(is_given_up || checked.is_exact() == by_python.status.success(), "{checked:?}\n{said}");
});
