//! [`Problem`]: every way a scene is wrong, in words.
//!
//! All sentences of the room stand here, one function each: what was found, and what to do about it.

use std::fmt;
use std::ops::Range;

use super::finding::Finding;
use super::name::nearest;
use super::source::Source;
use crate::geometry::Point;

/// One thing that is wrong with a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where in the scene, as `blocks[3].polygon[1]`; empty for the whole file.
    pub path: String,
    /// Line in the text, from 1; 0 where there is no text.
    pub line: usize,
    /// Column in that line in characters, from 1; 0 where there is no text.
    pub column: usize,
    /// Bytes of the text that are meant, absent where there is no text.
    pub span: Option<Range<usize>>,
    /// What is wrong, with the numbers found.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

/// All that is wrong with a scene, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Problems {
    /// The text that was read, from which all spans count; absent for a scene made in code.
    pub text: Option<String>,
    /// The problems, at least one.
    pub list: Vec<Problem>,
}

impl Problems {
    /// Findings with their places in a text, sorted by place.
    pub(super) fn place(findings: Vec<Finding>, source: Option<&Source<'_>>) -> Problems {
        let mut list: Vec<Problem> = findings
            .into_iter()
            .map(|finding| {
                let span = source.and_then(|s| s.find(&finding.path, finding.mark));
                Problem::new(finding.path.to_string(), span, source, finding.wording)
            })
            .collect();
        list.sort_by_key(|p| p.span.as_ref().map(|s| s.start));
        Problems {
            text: source.map(|s| s.text.to_string()),
            list,
        }
    }

    /// A single problem of the text itself.
    pub(super) fn of_text(source: &Source<'_>, span: Range<usize>, wording: Wording) -> Problems {
        let problem = Problem::new(String::new(), Some(span), Some(source), wording);
        Problems {
            text: Some(source.text.to_string()),
            list: vec![problem],
        }
    }
}

impl Problem {
    fn new(
        path: String,
        span: Option<Range<usize>>,
        source: Option<&Source<'_>>,
        wording: Wording,
    ) -> Problem {
        let (line, column) = match (&span, source) {
            (Some(span), Some(source)) => source.place(span.start),
            _ => (0, 0),
        };
        Problem {
            path,
            line,
            column,
            span,
            message: wording.message,
            help: wording.help,
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.line > 0 {
            write!(f, "line {}, column {}", self.line, self.column)?;
            f.write_str(if self.path.is_empty() { ": " } else { ", " })?;
        }
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        f.write_str(&self.message)?;
        if !self.help.is_empty() {
            write!(f, "\n  help: {}", self.help)?;
        }
        Ok(())
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.list.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            problem.fmt(f)?;
        }
        Ok(())
    }
}

impl std::error::Error for Problem {}
impl std::error::Error for Problems {}

/// What to say of a problem.
#[derive(Clone, Debug)]
pub(super) struct Wording {
    message: String,
    help: String,
}

fn say(message: impl Into<String>, help: impl Into<String>) -> Wording {
    Wording {
        message: message.into(),
        help: help.into(),
    }
}

/// A number as a person writes it: six digits, powers of ten where it is very large or small.
fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return x.to_string();
    }
    let magnitude = libm::floor(libm::log10(x.abs()));
    if !(-5.0..9.0).contains(&magnitude) {
        return format!("{:e}", format!("{x:.5e}").parse::<f64>().unwrap_or(x));
    }
    let decimals = (5.0 - magnitude).max(0.0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        text
    }
}

fn pair(p: [f64; 2]) -> String {
    format!("({}, {})", number(p[0]), number(p[1]))
}

fn point(p: Point) -> String {
    pair([p.x, p.y])
}

/// A text cut to what fits into a sentence.
pub(super) fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 {
        text.to_string()
    } else {
        text.chars().take(37).chain("…".chars()).collect()
    }
}

/// "a, b or c"
pub(super) fn choice(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().collect();
    match items.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        Some((last, _)) => last.clone(),
        None => "nothing".into(),
    }
}

// The text.

pub(super) fn not_utf8(byte: u8, utf16: bool) -> Wording {
    let help = if utf16 {
        "the file looks like UTF-16; save it as UTF-8"
    } else {
        "save the file in the encoding UTF-8"
    };
    say(format!("the byte 0x{byte:02X} is not UTF-8 text"), help)
}

pub(super) fn empty_text() -> Wording {
    say(
        "the file is empty",
        "start from the scene that `drystone new` writes",
    )
}

pub(super) fn early_end(opened: Option<(char, usize, usize)>) -> Wording {
    let help = match opened {
        Some((c, line, column)) => format!(
            "the `{c}` opened in line {line}, column {column} is never closed; is a part of the file missing?"
        ),
        None => "a part of the file seems to be missing".into(),
    };
    say("the file ends too early", help)
}

pub(super) fn not_a_number(word: &str) -> Wording {
    say(
        format!("`{word}` is not a number JSON knows"),
        "give a finite number; leave a robot's limit out where there is none",
    )
}

pub(super) fn foreign_word(word: &str, meant: &str) -> Wording {
    say(format!("`{word}` is not JSON"), format!("write `{meant}`"))
}

pub(super) fn bare_word(word: &str) -> Wording {
    say(
        format!("`{}` is not JSON", shortened(word)),
        "put strings and keys in double quotes",
    )
}

pub(super) fn comment() -> Wording {
    say(
        "JSON has no comments",
        "take the comment out; `title` holds text for people",
    )
}

pub(super) fn single_quotes() -> Wording {
    say(
        "JSON has no single quotes",
        "put strings and keys in double quotes",
    )
}

pub(super) fn trailing_comma() -> Wording {
    say(
        "a comma after the last entry",
        "take the comma out, or add the entry that follows it",
    )
}

pub(super) fn number_too_large(text: &str) -> Wording {
    say(
        format!("the number {} is too large", shortened(text)),
        "give a number of at most 1e12",
    )
}

pub(super) fn odd_number(text: &str) -> Wording {
    say(
        format!("`{}` is not a number of JSON", shortened(text)),
        "write numbers as 0.5, -2 or 1e3: no leading + or 0, and a digit on both sides of the point",
    )
}

pub(super) fn too_deep() -> Wording {
    say(
        "nested more than 127 deep",
        "a scene needs no more than seven levels of brackets",
    )
}

pub(super) fn open_string() -> Wording {
    say(
        "a string runs over the end of its line",
        "close it with a double quote; write a line break inside it as \\n",
    )
}

pub(super) fn missing_comma(words: &str) -> Wording {
    say(
        words,
        "put a comma between entries, and check that every bracket is closed",
    )
}

pub(super) fn not_json(words: &str) -> Wording {
    say(
        format!("this is not JSON: {words}"),
        "correct the text here, or shortly before",
    )
}

// Keys and types.

pub(super) fn reader_says(words: &str) -> Wording {
    say(
        words,
        "see `drystone schema` for what a scene file may hold",
    )
}

pub(super) fn wrong_type(expected: &str, found: &str) -> Wording {
    say(
        format!("expected {expected}, found {found}"),
        format!("write {expected} here"),
    )
}

pub(super) fn wrong_length(found: usize, expected: &str) -> Wording {
    let entries = if found == 1 {
        "1 entry".into()
    } else {
        format!("{found} entries")
    };
    say(
        format!("expected {expected}, found {entries}"),
        format!("write {expected} here"),
    )
}

pub(super) fn unknown_choice(text: &str, known: &[String]) -> Wording {
    let names = choice(known.iter().map(|n| format!("\"{n}\"")));
    let help = match nearest(text, known.iter().map(String::as_str)) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("write {names}"),
    };
    say(
        format!("expected {names}, found \"{}\"", shortened(text)),
        help,
    )
}

pub(super) fn unknown_key<'k>(key: &str, known: impl Iterator<Item = &'k str> + Clone) -> Wording {
    let help = match nearest(key, known.clone()) {
        Some(near) => format!("the nearest known key is `{near}`"),
        None => format!("known keys are {}", known.collect::<Vec<_>>().join(", ")),
    };
    say(format!("unknown key `{}`", shortened(key)), help)
}

pub(super) fn duplicate_key(key: &str, line: usize, column: usize) -> Wording {
    say(
        format!(
            "the key `{}` stands here twice; first in line {line}, column {column}",
            shortened(key)
        ),
        "take one of the two out",
    )
}

pub(super) fn missing_key(key: &str) -> Wording {
    let help = match key {
        "drystone" => "add `\"drystone\": 1`, the version of the scene format".into(),
        "blocks" => "add `\"blocks\": […]`, the list of blocks; it may be empty".into(),
        _ => format!("add `\"{key}\"`"),
    };
    say(format!("the key `{key}` is missing"), help)
}

// Numbers.

pub(super) fn version(found: i64) -> Wording {
    say(
        format!("version {found} of the scene format is not known"),
        "write `\"drystone\": 1`",
    )
}

pub(super) fn not_finite(x: f64) -> Wording {
    say(format!("the number is {x}"), "give a finite number")
}

pub(super) fn absurd(x: f64, largest: f64) -> Wording {
    say(
        format!("the number {} is beyond ±{}", number(x), number(largest)),
        "check the units: metres, kilograms, newtons",
    )
}

pub(super) fn negative(what: &str, x: f64) -> Wording {
    say(
        format!("negative {what} {}", number(x)),
        format!("give a {what} of at least 0"),
    )
}

pub(super) fn kernel(x: f64) -> Wording {
    say(
        format!("the kernel {} is outside 0 … 1", number(x)),
        "give the share of each contact to stay clear of: 0 for none, 0.2 for a fifth",
    )
}

pub(super) fn side(x: f64) -> Wording {
    say(
        format!("the grid's side {} is not more than 0", number(x)),
        "give the edge length of a cell in metres",
    )
}

pub(super) fn too_heavy(weight: f64, largest: f64) -> Wording {
    say(
        format!(
            "the block comes out {} N heavy, beyond {}",
            number(weight),
            number(largest)
        ),
        "check the units of density, thickness, gravity and polygon",
    )
}

pub(super) fn colour(text: &str) -> Wording {
    say(
        format!("\"{}\" is not a colour", shortened(text)),
        "write a colour as \"#8b6b3d\" or \"#863\"",
    )
}

// Names.

pub(super) fn unknown_name(sort: &str, name: &str, known: &[&str]) -> Wording {
    let help = match nearest(name, known.iter().copied()) {
        Some(near) => format!("the nearest known {sort} is `{near}`"),
        None if known.is_empty() => format!("the scene has no {sort}s"),
        None if known.len() <= 12 => {
            format!(
                "known {sort}s are {}",
                known
                    .iter()
                    .map(|n| shortened(n))
                    .collect::<Vec<_>>()
                    .join(", ")
            )
        }
        None => format!(
            "the scene has {} {sort}s, none with a name like it",
            known.len()
        ),
    };
    say(format!("unknown {sort} `{}`", shortened(name)), help)
}

pub(super) fn id_twice(sort: &str, id: &str, first: &str) -> Wording {
    say(
        format!(
            "the {sort} id `{}` is used twice; first by {first}",
            shortened(id)
        ),
        format!("give every {sort} an id of its own"),
    )
}

pub(super) fn reserved_id() -> Wording {
    say(
        "the id `ground` is reserved: results name the ground so",
        "give the block another id",
    )
}

pub(super) fn empty_id(sort: &str) -> Wording {
    say(
        format!("the {sort}'s id is empty"),
        "give it a name of at least one letter",
    )
}

pub(super) fn built_in_shape(name: &str) -> Wording {
    say(
        format!("`{name}` is the name of a built-in shape"),
        "give the shape another name",
    )
}

pub(super) fn pair_twice(names: &[String; 2], first: usize) -> Wording {
    say(
        format!(
            "the pair {}, {} is listed twice; first in friction_pairs[{first}]",
            shortened(&names[0]),
            shortened(&names[1])
        ),
        "take one of the two out; the order of the names does not matter",
    )
}

// Outlines.

/// A side of an outline, by its corners' numbers.
pub(super) struct Side {
    /// The hole it belongs to; the outline where absent.
    pub(super) hole: Option<usize>,
    /// The numbers of its corners, from 0.
    pub(super) corners: [usize; 2],
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the side from corner {} to {}",
            self.corners[0], self.corners[1]
        )?;
        self.hole
            .map_or(Ok(()), |hole| write!(f, " of hole {hole}"))
    }
}

pub(super) fn too_few_corners(found: usize) -> Wording {
    say(
        format!("{found} different corners enclose nothing"),
        "give at least three corners",
    )
}

pub(super) fn zero_area() -> Wording {
    say(
        "the outline encloses no area",
        "give corners that do not all lie on one line",
    )
}

pub(super) fn crossing(a: &Side, b: &Side, at: Point) -> Wording {
    say(
        format!("{a} meets {b} at {}", point(at)),
        "list the corners in order around the outline, without crossing or touching it; corners count from 0",
    )
}

pub(super) fn hole_outside() -> Wording {
    say(
        "the hole does not lie inside the outline, or lies inside another hole",
        "move the hole, or make it a block of its own",
    )
}

pub(super) fn no_outline() -> Wording {
    say(
        "it has no `polygon`, no `cells` and no `shape`",
        "give one of the three",
    )
}

pub(super) fn no_shape_outline() -> Wording {
    say(
        "the shape has no `polygon` and no `cells`",
        "give one of the two",
    )
}

pub(super) fn two_outlines(first: &str, second: &str) -> Wording {
    say(
        format!("it has both `{first}` and `{second}`"),
        "give one of the two",
    )
}

pub(super) fn holes_alone() -> Wording {
    say(
        "`holes` go with a `polygon`",
        "give the outline as `polygon`, or leave the holes out; cells simply leave theirs out",
    )
}

pub(super) fn cells_without_grid() -> Wording {
    say(
        "cells need a grid",
        "add `\"grid\": { \"kind\": \"triangular\", \"side\": 1 }` to the scene, or give a polygon",
    )
}

pub(super) fn shape_without_grid(name: &str) -> Wording {
    say(
        format!("the built-in shape `{name}` needs a triangular grid"),
        "add `\"grid\": { \"kind\": \"triangular\", \"side\": 1 }` to the scene, or describe a shape of your own in `shapes`",
    )
}

pub(super) fn no_cells() -> Wording {
    say("the list of cells is empty", "give at least one cell")
}

pub(super) fn square_cell() -> Wording {
    say(
        "a cell of the triangular grid says which triangle it is",
        "write [x, y, \"up\"] or [x, y, \"down\"]",
    )
}

pub(super) fn triangle_cell() -> Wording {
    say(
        "a cell of the square grid has no \"up\" or \"down\"",
        "write [x, y]",
    )
}

pub(super) fn cell_twice(first: usize) -> Wording {
    say(
        format!("the cell is listed twice; first as number {first}, counting from 0"),
        "take one of the two out",
    )
}

pub(super) fn cells_apart() -> Wording {
    say(
        "the cells are not all joined by edges",
        "make each connected part a block of its own",
    )
}

pub(super) fn not_whole(p: [f64; 2]) -> Wording {
    say(
        format!("{} is not a lattice point", pair(p)),
        "cells lie at whole numbers; a polygon may lie anywhere",
    )
}

pub(super) fn beyond_lattice(p: [f64; 2], reach: f64) -> Wording {
    say(
        format!("{} is beyond ±{} lattice steps", pair(p), number(reach)),
        "move the scene towards the origin",
    )
}

pub(super) fn angle_off_lattice(angle: f64, turn: f64) -> Wording {
    say(
        format!("a turn by {}° leaves the lattice", number(angle)),
        format!("give a multiple of {}°, or use a polygon", number(turn)),
    )
}

// Bodies together.

pub(super) fn overlap(a: &str, b: &str, area: f64, at: Point, frame: Option<&str>) -> Wording {
    let when = frame.map_or(String::new(), |f| format!(" in {f}"));
    say(
        format!(
            "{a} and {b} overlap by {} m² around {}{when}",
            number(area),
            point(at)
        ),
        "move them apart until they only touch",
    )
}

pub(super) fn more_overlaps(listed: usize) -> Wording {
    say(
        format!("there are more overlaps than the {listed} listed"),
        "correct these first",
    )
}

// Steps.

pub(super) fn placed_twice(block: &str, since: usize, now: usize) -> Wording {
    let when = if since == now {
        "earlier in this step".into()
    } else {
        format!("by steps[{since}]")
    };
    say(
        format!("the block `{}` is already placed, {when}", shortened(block)),
        "place a block once; `remove` it first to place it anew",
    )
}

pub(super) fn removed_unplaced(block: &str) -> Wording {
    say(
        format!("the block `{}` is removed but not placed", shortened(block)),
        "remove only blocks that an earlier step placed",
    )
}

pub(super) fn removed_held(block: &str, robot: &str) -> Wording {
    say(
        format!(
            "the block `{}` is removed while the robot `{}` holds it",
            shortened(block),
            shortened(robot)
        ),
        format!(
            "add \"{}\" to `release` of this step or an earlier one",
            shortened(robot)
        ),
    )
}

pub(super) fn held_unplaced(robot: &str, block: &str) -> Wording {
    say(
        format!(
            "the robot `{}` holds the block `{}`, which is not placed",
            shortened(robot),
            shortened(block)
        ),
        format!(
            "add \"{}\" to `place` of this step or an earlier one",
            shortened(block)
        ),
    )
}

pub(super) fn holds_two(robot: &str, held: &str, block: &str) -> Wording {
    let (robot, held, block) = (shortened(robot), shortened(held), shortened(block));
    say(
        format!("the robot `{robot}` is to hold the block `{block}` while it still holds `{held}`"),
        format!("a robot holds one block; add \"{robot}\" to `release` of this step first"),
    )
}

pub(super) fn planned_placed(robot: &str, block: &str) -> Wording {
    say(
        format!(
            "the robot `{}` plans the block `{}`, which is already placed",
            shortened(robot),
            shortened(block)
        ),
        "plan only blocks that are not placed",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        for (x, text) in [
            (0.5, "0.5"),
            (-3.0, "-3"),
            (1e13, "1e13"),
            (123_456.0, "123456"),
            (0.1 + 0.2, "0.3"),
            (1.0 / 3.0, "0.333333"),
            (1e-9, "1e-9"),
            (2_000_000.0, "2000000"),
            (-0.0, "0"),
        ] {
            assert_eq!(number(x), text);
        }
    }

    #[test]
    fn choices_read_well() {
        assert_eq!(
            choice(["a".to_string(), "b".to_string(), "c".to_string()]),
            "a, b or c"
        );
        assert_eq!(choice(["a".to_string()]), "a");
    }
}
