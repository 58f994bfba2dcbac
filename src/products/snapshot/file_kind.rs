//! Recognises scenes, damaged scenes and references by the content of a file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::mechanics::scene::{Code, Scene, isolate};

/// True if a file counts as a scene or as a damaged scene.
///
/// A file counts as a scene if it contains the text `"drystone"`, with the quotation marks. A file that is not valid
/// JSON counts as a damaged scene if it is empty, is not UTF-8, or contains `drystone`, `blocks` or `polygon`.
pub(super) fn looks_like_scene(bytes: &[u8]) -> bool {
    let has = |word: &[u8]| bytes.windows(word.len()).any(|w| w == word);
    if has(b"\"drystone\"") {
        return true;
    }
    let is_meant = has(b"drystone") || has(b"blocks") || has(b"polygon");
    let is_empty = bytes.iter().all(u8::is_ascii_whitespace);
    if !is_meant && !is_empty && std::str::from_utf8(bytes).is_ok() {
        return false;
    }
    let is_damage =
        |code| matches!(code, Code::NotUtf8 | Code::EmptyFile | Code::EndsEarly | Code::NotJson | Code::OtherFormat);
    match isolate("a file", || Scene::from_slice(bytes)) {
        Ok(Err(problems)) => problems.list.iter().any(|problem| is_damage(problem.code)),
        _ => false,
    }
}

/// True if the first 4 KiB of a file contain a mark that identifies the file as a reference of a scene. False if the
/// file cannot be read.
pub(super) fn has_reference_mark(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(4096).read_to_end(&mut head));
    let marks: [&[u8]; 2] = [b"drystone facts ", b"drystone-snapshot\0scene"];
    read.is_ok() && (head.starts_with(marks[0]) || head.windows(marks[1].len()).any(|w| w == marks[1]))
}
