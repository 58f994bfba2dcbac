//! Messages about text that cannot be read as JSON or exceeds a limit of the reader.

use super::{Code, Wording, new_wording, shortened};

pub(in crate::mechanics::scene) fn not_utf8(byte: u8, utf16: bool) -> Wording {
    let help =
        if utf16 { "the file looks like UTF-16; save it as UTF-8" } else { "save the file in the encoding UTF-8" };
    new_wording(Code::NotUtf8, format!("the byte 0x{byte:02X} is not UTF-8 text"), help)
}

pub(in crate::mechanics::scene) fn more_problems(listed: usize) -> Wording {
    new_wording(
        Code::MoreProblems,
        format!("there are more problems than the {listed} in this list"),
        "correct the listed problems first; many may have the same cause",
    )
}

pub(in crate::mechanics::scene) fn empty_text() -> Wording {
    new_wording(Code::EmptyFile, "the file is empty", "start from the scene that `drystone new` writes")
}

pub(in crate::mechanics::scene) fn early_end(opened: Option<(char, usize, usize)>) -> Wording {
    let help = match opened {
        Some((c, line, column)) => {
            format!("the `{c}` opened in line {line}, column {column} is never closed; is a part of the file missing?")
        }
        None => "a part of the file seems to be missing".into(),
    };
    new_wording(Code::EndsEarly, "the file ends too early", help)
}

pub(in crate::mechanics::scene) fn not_a_number(word: &str) -> Wording {
    new_wording(
        Code::NotJson,
        format!("`{word}` is not a number in JSON"),
        "give a finite number; if a robot has no limit, leave the limit out",
    )
}

pub(in crate::mechanics::scene) fn foreign_word(word: &str, meant: &str) -> Wording {
    new_wording(Code::NotJson, format!("`{word}` is not JSON"), format!("write `{meant}`"))
}

pub(in crate::mechanics::scene) fn bare_word(word: &str) -> Wording {
    new_wording(Code::NotJson, format!("`{}` is not JSON", shortened(word)), "put strings and keys in double quotes")
}

pub(in crate::mechanics::scene) fn comment() -> Wording {
    new_wording(Code::NotJson, "JSON has no comments", "remove the comment; the key `title` can hold a text for people")
}

pub(in crate::mechanics::scene) fn single_quotes() -> Wording {
    new_wording(Code::NotJson, "JSON has no single quotes", "put strings and keys in double quotes")
}

pub(in crate::mechanics::scene) fn trailing_comma() -> Wording {
    new_wording(
        Code::NotJson,
        "there is a comma after the last entry",
        "remove the comma, or add the entry that follows it",
    )
}

pub(in crate::mechanics::scene) fn number_too_large(text: &str) -> Wording {
    new_wording(Code::TooLarge, format!("the number {} is too large", shortened(text)), "give a number of at most 1e12")
}

pub(in crate::mechanics::scene) fn odd_number(text: &str) -> Wording {
    new_wording(
        Code::NotJson,
        format!("`{}` is not a number in JSON", shortened(text)),
        "write numbers as 0.5, -2 or 1e3: no leading + or 0, and a digit on both sides of the point",
    )
}

pub(in crate::mechanics::scene) fn too_deep() -> Wording {
    new_wording(
        Code::NestedTooDeep,
        "more than 127 brackets are open at once",
        "a scene needs no more than seven levels of brackets",
    )
}

pub(in crate::mechanics::scene) fn open_string() -> Wording {
    new_wording(
        Code::NotJson,
        "a string contains a line break or another control character",
        "close the string on its line; write a line break as \\n and a tab as \\t",
    )
}

pub(in crate::mechanics::scene) fn missing_comma(close: char) -> Wording {
    new_wording(
        Code::NotJson,
        format!("expected `,` or `{close}`"),
        "put a comma between entries, and check that every bracket is closed",
    )
}

pub(in crate::mechanics::scene) fn not_json(expected: &str) -> Wording {
    new_wording(
        Code::NotJson,
        format!("this is not JSON: expected {expected}"),
        "correct the text here, or shortly before this place",
    )
}

pub(in crate::mechanics::scene) fn behind_the_end() -> Wording {
    new_wording(
        Code::NotJson,
        "there is text after the end of the scene",
        "remove the text after the last bracket of the scene, or a superfluous closing bracket before it",
    )
}

pub(in crate::mechanics::scene) fn escape() -> Wording {
    new_wording(
        Code::NotJson,
        "JSON has no such escape sequence in a string",
        "write a backslash as \\\\, a line break as \\n, and any character by its code as \\u00e9",
    )
}

pub(in crate::mechanics::scene) fn surrogate() -> Wording {
    new_wording(
        Code::NotJson,
        "the escape is only half of a surrogate pair",
        "write the character itself, or both halves of its surrogate pair",
    )
}

pub(in crate::mechanics::scene) fn conflict() -> Wording {
    new_wording(
        Code::NotJson,
        "a merge conflict has left two versions of the text here",
        "keep one version, and delete the lines that begin with <<<<<<<, ======= and >>>>>>>",
    )
}

pub(in crate::mechanics::scene) fn other_format(format: &str) -> Wording {
    let help = match format {
        "XML" => "a scene is written as JSON; `drystone import` converts a drawing to a scene",
        _ => "a scene is written as JSON, which begins with `{`; `drystone new` writes a scene to start from",
    };
    new_wording(Code::OtherFormat, format!("this looks like {format}"), help)
}
