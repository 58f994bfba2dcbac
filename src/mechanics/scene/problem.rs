//! [`Problem`]: an error in a scene file, with its position, a message and a remedy.
//!
//! The files of this folder contain all messages of the scene module, one function for each. A message describes what
//! was found and what to do about it.

mod code;
pub(super) mod message;
pub(super) mod outline;

use std::fmt;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

pub use code::Code;
pub(super) use code::codes;

use super::BodyId;
use crate::geometry::Point;
use crate::read::mistake::{write_problem, write_problems};
use crate::read::{Broken, Cause, Dialect, Expected, Kind, Mistake, NodeKind, Source};

/// An error in a scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Problem {
    /// The kind of problem.
    pub code: Code,
    /// The path of the value or key in the scene, such as `blocks[3].polygon[1]`; empty for the whole file.
    pub path: String,
    /// Line in the text, from 1; 0 if there is no text.
    pub line: usize,
    /// Column in that line in characters, from 1; 0 if there is no text.
    pub column: usize,
    /// The range of bytes in the text; `None` if there is no text.
    pub span: Option<Range<usize>>,
    /// The description of the problem, with the numbers found.
    pub message: String,
    /// The remedy.
    pub help: String,
    /// The point of the structure at which the problem lies; `None` if it does not belong to a point.
    pub place: Option<Place>,
}

/// The place of a problem in a structure.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Place {
    /// A point of the outline of the body with the problem, in the units of the file, before the body is rotated and
    /// moved.
    Own(Point),
    /// A point, in the units of the file, in the overlap of the body with the problem and this other body.
    Between(Point, BodyId),
}

/// All problems of a scene, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct SceneError {
    /// The text that was read, to which all spans refer; `None` for a scene built in code.
    pub text: Option<String>,
    /// The problems; at least one if the scene is not valid.
    pub list: Vec<Problem>,
}

impl SceneError {
    /// Creates an error with one problem, for a text that could not be parsed.
    pub(super) fn broken(text: &str, broken: Broken) -> SceneError {
        let source = Source::plain(text);
        let problem = Problem::new(String::new(), Some(broken.span), Some(&source), broken.mistake.into());
        SceneError { text: Some(source.text.to_string()), list: vec![problem] }
    }
}

impl Problem {
    /// Creates a problem. Computes its line and column from the range of bytes `span` in the text `source`. If `span`
    /// or `source` is `None`, line and column are 0.
    pub(super) fn new(
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
            code: wording.code,
            path: crate::text::line(&path),
            line,
            column,
            span,
            message: wording.message,
            help: wording.help,
            place: wording.place,
        }
    }

    /// A problem without a place in the file.
    pub(crate) fn alone(code: Code, message: String, help: impl Into<String>) -> Problem {
        let help = help.into();
        Problem { code, path: String::new(), line: 0, column: 0, span: None, message, help, place: None }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_problem(f, (self.line, self.column), &self.path, &self.message, &self.help)
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_problems(f, &self.list)
    }
}

impl std::error::Error for Problem {}
impl std::error::Error for SceneError {}

/// The code, message and remedy of a problem, before its place in the file is known.
#[derive(Clone, Debug)]
pub(super) struct Wording {
    code: Code,
    message: String,
    help: String,
    place: Option<Place>,
}

impl Wording {
    /// Adds the point of the structure at which the problem lies, in the units of the file.
    pub(super) fn at(self, place: Place) -> Wording {
        Wording { place: Some(place), ..self }
    }

    /// Returns the message and the remedy.
    pub(super) fn parts(&self) -> (&str, &str) {
        (&self.message, &self.help)
    }
}

/// A mistake of the reader.
impl From<Mistake> for Wording {
    fn from(mistake: Mistake) -> Wording {
        let code = match mistake.kind {
            Kind::NotUtf8 => Code::NotUtf8,
            Kind::Empty => Code::EmptyFile,
            Kind::EndsEarly => Code::EndsEarly,
            Kind::TooDeep => Code::NestedTooDeep,
            Kind::OtherFormat => Code::OtherFormat,
            Kind::Syntax => Code::NotJson,
            Kind::WrongType => Code::WrongType,
            Kind::WrongLength => Code::WrongLength,
            Kind::UnknownKey => Code::UnknownKey,
            Kind::DuplicateKey => Code::DuplicateKey,
            Kind::MissingKey => Code::MissingKey,
            Kind::UnknownChoice => Code::UnknownChoice,
            Kind::TooLarge => Code::TooLarge,
            Kind::More => Code::MoreProblems,
        };
        new_wording(code, mistake.message, mistake.help)
    }
}

fn new_wording(code: Code, message: impl Into<String>, help: impl Into<String>) -> Wording {
    // Messages quote names and other text from the file. A line break in such text must not start a new line in the
    // output.
    Wording { code, message: crate::text::line(&message.into()), help: crate::text::line(&help.into()), place: None }
}

/// Formats a number for messages with at most six significant digits, but with all digits before the point. If its
/// absolute value is at least 10⁹ or below 10⁻⁵, a number other than 0 is written with a power of ten.
pub(in crate::mechanics) fn digits(x: f64) -> String {
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
    crate::text::without_zeros(&format!("{x:.decimals$}")).to_owned()
}

fn pair(p: [f64; 2]) -> String {
    format!("({}, {})", digits(p[0]), digits(p[1]))
}

fn point(p: Point) -> String {
    pair([p.x, p.y])
}

/// The dialect of scene files.
pub(in crate::mechanics::scene) const SCENE: Dialect = Dialect { noun: "scene", remedy, lines_before: 0 };

fn remedy(cause: Cause<'_>) -> Option<String> {
    let words = match cause {
        Cause::WrongType { at, expected, found, written } => match (expected, found) {
            (Expected::Point, NodeKind::Number(_)) => {
                "write each point in brackets: an outline is [[x, y], [x, y], …], and `holes` is a list of outlines"
            }
            (Expected::Vector, NodeKind::Number(_)) => {
                let size = written.trim_start_matches('-');
                return Some(format!(
                    "write [x, y], where y points up: {size} downwards is [0, -{size}]; gravity already acts on every block"
                ));
            }
            (Expected::Number, NodeKind::Text(text)) if at.ends_in("friction") && !text.contains(',') => {
                "write a number such as 0.6; to name what a body is made of, use `material`, and give its friction in `materials`"
            }
            (Expected::Number, NodeKind::Text(text)) if !text.contains(',') => {
                "write a number without a unit; the units are metres, newtons, kilograms and degrees, unless the file gives other `units`; only a density or a unit weight may have one, such as \"18 kN/m3\""
            }
            (Expected::Object, NodeKind::Text(unit)) if at.ends_in("units") => {
                let key = if matches!(unit.as_ref(), "N" | "kN" | "MN" | "lbf") { "force" } else { "length" };
                return Some(format!("write \"units\": {{ \"{key}\": {written} }}"));
            }
            // Only the version of the format is read as a whole number.
            (Expected::Whole, _) => "write 1, the version of the scene format",
            _ => return None,
        },
        Cause::UnknownKey("cohesion" | "adhesion" | "mortar" | "tensile_strength", _) => {
            "joints are dry: they transmit pressure and friction, but no tension; remove the key"
        }
        Cause::UnknownKey(key, known) => {
            let meant = synonym(key).filter(|meant| known.contains(meant))?;
            return Some(format!("the key is called `{meant}` here"));
        }
        Cause::MissingKey("drystone") => "add `\"drystone\": 1`, the version of the scene format",
        Cause::MissingKey("blocks") => "add `\"blocks\": […]`, the list of blocks; it may be empty",
        Cause::MissingKey(_) | Cause::NotToml => return None,
        Cause::Empty => "start from the scene that `drystone new` writes",
        Cause::OtherFormat("XML") => "a scene is written as JSON; `drystone import` converts a drawing to a scene",
        Cause::OtherFormat(_) => {
            "a scene is written as JSON, which begins with `{`; `drystone new` writes a scene to start from"
        }
        Cause::TooDeep => "a scene needs no more than seven levels of brackets",
        Cause::Comment => "remove the comment; the key `title` can hold a text for people",
        Cause::NotANumber => "give a finite number; if a robot has no limit, leave the limit out",
    };
    Some(words.into())
}

/// Returns the key of the scene format that means the same as `key`, a word that other programs use. `None` if no such
/// key is known.
fn synonym(key: &str) -> Option<&'static str> {
    Some(match key.to_lowercase().as_str() {
        "mu" | "μ" | "friction_coefficient" => "friction",
        "floor" | "base" | "foundation" | "supports" => "ground",
        "bodies" | "bricks" | "stones" | "elements" | "voussoirs" => "blocks",
        "name" | "label" => "id",
        "vertices" | "points" | "corners" | "coordinates" | "outline" => "polygon",
        "color" | "colour" => "fill",
        "rotation" | "rotate" | "theta" => "angle",
        "position" | "pos" | "origin" | "offset" => "at",
        "version" => "drystone",
        "lattice" => "grid",
        "forces" => "loads",
        "torque_limit" | "moment" => "torque",
        "tolerance" => "contact_tolerance",
        _ => return None,
    })
}

/// An environment variable for tests, which only builds with debug assertions read. If its value is `faulty#2`, the
/// second call of [`isolate`] with a name that contains `faulty` panics.
#[cfg(debug_assertions)]
const FAULT_VARIABLE: &str = "DRYSTONE_TEST_FAULT";

/// Calls `work` for one scene. If `work` panics, the panic becomes a problem with the code [`Code::InternalFault`]; the
/// other scenes of a command are still processed.
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
    let message = "an internal error of the program occurred on this scene; the scene itself may be correct";
    Problem::alone(Code::InternalFault, message.into(), "please report this error together with the scene")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_messages_have_up_to_six_digits() {
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
            assert_eq!(digits(x), text);
        }
    }

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
