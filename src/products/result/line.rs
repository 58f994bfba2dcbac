//! Writes a result as one line of a batch: the origin of the scene, and the selected fields.

use std::fmt;
use std::sync::LazyLock;

use serde_json::Value;

use super::json::{Json, compact, object};
use super::key::{KEYS, Key, Type};
use super::{Result, Timing};
use crate::mechanics::analysis::{Analysis, Question, Verdict};
use crate::text;

/// The origin of a scene in a batch: its file, and its line in this file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The path of the file as given; `None` for standard input.
    pub file: Option<String>,
    /// The line in the file or in standard input, from 1. `None` if the whole file is one scene.
    pub line: Option<usize>,
}

impl Origin {
    /// Reads the origin of a scene from a result line that a batch has written. Returns `None` if the line is not JSON.
    pub fn of_line(line: &[u8]) -> Option<Origin> {
        let value: Value = serde_json::from_slice(line).ok()?;
        let line = value["line"].as_u64().and_then(|n| usize::try_from(n).ok());
        Some(Origin { file: value["file"].as_str().map(str::to_owned), line })
    }
}

/// Writes the origin for people: `a.ndjson, line 3`.
impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.file {
            Some(file) => f.write_str(&text::line(file))?,
            None => f.write_str("standard input")?,
        }
        match self.line {
            Some(line) => write!(f, ", line {line}"),
            None => Ok(()),
        }
    }
}

/// The selected fields of a result. Fields are the keys of the result of [`to_json`](super::to_json), joined by dots,
/// such as `frames.proof.power`. A key below a list selects this key of every entry. `verdict` (the worst verdict of all
/// frames) and `all` are also fields.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fields {
    chosen: Vec<Vec<&'static str>>,
}

impl Default for Fields {
    /// Selects the title and the worst verdict.
    fn default() -> Fields {
        Fields { chosen: vec![vec!["scene"], vec!["verdict"]] }
    }
}

/// The key of a frame with the answer to each question.
const ANSWERS: [(Question, &str); 6] = [
    (Question::Margins, "margins"),
    (Question::Sensitivity, "sensitivity"),
    (Question::Capacity, "capacity"),
    (Question::Wedging, "only_by_wedging"),
    (Question::Placement, "placement"),
    (Question::Removable, "removable"),
];

/// A name that is not a field.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no field {typed}{}", match near { Some(near) => format!("; did you mean {near}?"), None => String::new() })]
pub struct UnknownField {
    /// The name as it was typed.
    pub typed: String,
    /// The most similar field.
    pub near: Option<String>,
}

impl Fields {
    /// Reads a list of field names, such as `verdict,frames.total_force`.
    ///
    /// # Errors
    /// All names that are not fields.
    ///
    /// # Example
    /// ```
    /// use drystone::result::Fields;
    /// assert!(Fields::read("verdict,frames.proof").is_ok());
    /// let wrong = Fields::read("verdict,frames.prof").unwrap_err();
    /// assert_eq!(wrong[0].to_string(), "there is no field frames.prof; did you mean frames.proof?");
    /// ```
    pub fn read(list: &str) -> std::result::Result<Fields, Vec<UnknownField>> {
        let (mut chosen, mut unknown) = (Vec::new(), Vec::new());
        for typed in list.split(',').map(str::trim) {
            match find(typed) {
                Some(path) => chosen.push(path),
                None => unknown.push(UnknownField { typed: text::line(typed), near: nearest(typed) }),
            }
        }
        if unknown.is_empty() { Ok(Fields { chosen }) } else { Err(unknown) }
    }

    /// True if the field at `path` is selected: by its own name, by the name of a part of it, or by the name of an
    /// object that contains it. Names without a dot, such as `all` and `frames`, do not count, because they do not
    /// select fields that a result has only on request.
    pub fn ask(&self, path: &[&str]) -> bool {
        let within = |chosen: &Vec<&str>| {
            let short = chosen.len().min(path.len());
            chosen.len() > 1 && path[..short] == chosen[..short]
        };
        self.chosen.iter().any(within)
    }

    /// Returns the questions whose answers are selected.
    pub fn questions(&self) -> impl Iterator<Item = Question> {
        let answers = ANSWERS.into_iter().chain([(Question::Margins, "signed_margins")]);
        answers.filter(|(_, key)| self.ask(&["frames", key])).map(|(question, _)| question)
    }

    /// Selects, in addition, the answers to all questions that are asked, unless parts of them are already selected.
    #[must_use]
    pub fn answering(mut self, is_asked: impl Fn(Question) -> bool) -> Fields {
        for (_, key) in ANSWERS.into_iter().filter(|(question, _)| is_asked(*question)) {
            if !self.ask(&["frames", key]) {
                self.chosen.push(vec!["frames", key]);
            }
        }
        self
    }

    /// Returns the selected paths. `frames.margins` selects the margins without their motions, which are long and must
    /// be selected by their own names.
    fn spelled(&self) -> Vec<Vec<&'static str>> {
        let margins = KEYS.iter().find(|key| key.name == "frames").map_or(&[][..], |key| key.keys);
        let margins = margins.iter().find(|key| key.name == "margins").map_or(&[][..], |key| key.keys);
        let short = margins.iter().filter(|key| !matches!(key.name, "mechanisms" | "excluded"));
        let short: Vec<Vec<&'static str>> = short.map(|key| vec!["frames", "margins", key.name]).collect();
        let spelled = self.chosen.iter().flat_map(|path| match path[..] {
            ["frames", "margins"] => short.clone(),
            _ => vec![path.clone()],
        });
        spelled.collect()
    }

    fn are_all(&self) -> bool {
        self.chosen.iter().any(|path| path == &["all"])
    }

    /// True if no fields except the title and the worst verdict are selected. [`verdict_line`] is then sufficient.
    pub fn are_few(&self) -> bool {
        let few = |path: &Vec<&str>| matches!(path[..], ["scene"] | ["verdict"]);
        self.chosen.iter().all(few)
    }
}

/// Writes the list in the form that [`Fields::read`] reads.
impl fmt::Display for Fields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<String> = self.chosen.iter().map(|path| path.join(".")).collect();
        f.write_str(&names.join(","))
    }
}

/// The picture of a scene, if it was requested.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PictureOutcome {
    /// No picture was requested.
    NotAsked,
    /// The name of the picture file, without its folder.
    Drawn(String),
    /// The reason why no picture could be drawn.
    Refused(String),
}

/// Writes the selected fields of an analysis as one line that ends with a line feed. The line of a scene is the same in
/// every run, unless it has times (`frames.solve` or `frames.solve.seconds` is selected).
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, result::{Fields, PictureOutcome, Origin, line_of}};
/// let scene = Scene::from_json(
///     r#"{ "drystone": 1, "title": "A dart", "blocks": [{ "polygon": [[0, 0], [3, 0], [0, 2]] }] }"#)?;
/// let origin = Origin { line: Some(7), ..Origin::default() };
/// let line = line_of(&origin, &Analysis::new(&scene), &PictureOutcome::NotAsked, &Fields::default());
/// assert_eq!(line, "{\"line\":7,\"scene\":\"A dart\",\"verdict\":\"unstable\"}\n");
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn line_of(origin: &Origin, analysis: &Analysis, picture: &PictureOutcome, fields: &Fields) -> String {
    let mut line = line_start(origin);
    if fields.are_few() {
        line.extend(few(&analysis.given().title, analysis.verdict(), fields));
    } else {
        let timing = if fields.ask(&["frames", "solve"]) { Timing::Included } else { Timing::LeftOut };
        let result = Result { file: None, analysis, blocks: fields.ask(&["frames", "blocks"]), timing };
        let mut whole = result.head();
        whole.push(("frames", Json::list(result.frames())));
        let verdict = ("verdict", analysis.verdict().word().into());
        if fields.are_all() {
            line.push(verdict);
            line.extend(whole);
        } else {
            let behind = whole.iter().position(|(key, _)| *key == "scene").map_or(0, |place| place + 1);
            whole.insert(behind, verdict);
            line.extend(pick(Json::Object(whole), &fields.spelled()).into_entries());
        }
    }
    match picture {
        PictureOutcome::NotAsked => {}
        PictureOutcome::Drawn(name) => line.push(("picture", name.into())),
        PictureOutcome::Refused(why) => line.extend([("picture", Json::Null), ("picture_refused", why.into())]),
    }
    line_end(line)
}

/// Writes the title of a scene and its verdict as one line that ends with a line feed. If one of these fields is not
/// selected, it is left out.
pub fn verdict_line(origin: &Origin, title: &str, verdict: Verdict, fields: &Fields) -> String {
    let mut line = line_start(origin);
    line.extend(few(title, verdict, fields));
    line_end(line)
}

/// Returns the title and the verdict, if these fields are selected.
fn few<'a>(title: &'a str, verdict: Verdict, fields: &Fields) -> Vec<(&'a str, Json<'a>)> {
    let few = Json::object([("scene", title.into()), ("verdict", verdict.word().into())]);
    pick(few, &fields.chosen).into_entries()
}

/// Begins the JSON object of a line with the origin of the scene.
fn line_start(origin: &Origin) -> Vec<(&str, Json<'_>)> {
    object! { file: origin.file.as_ref(), line: origin.line }.into_entries()
}

fn line_end(line: Vec<(&str, Json<'_>)>) -> String {
    compact(&Json::Object(line)) + "\n"
}

/// Returns the paths that begin with `name`, each without this first part. A path that consists only of `name` becomes
/// an empty path.
fn below(chosen: &[Vec<&'static str>], name: &str) -> Vec<Vec<&'static str>> {
    let under = chosen.iter().filter(|path| path.first() == Some(&name));
    under.map(|path| path[1..].to_vec()).collect()
}

/// Returns the selected parts of a value. `chosen` has the selected paths, relative to the value; a path below a list
/// selects a part of each of its entries.
fn pick<'a>(value: Json<'a>, chosen: &[Vec<&'static str>]) -> Json<'a> {
    match value {
        value if chosen.iter().any(Vec::is_empty) => value,
        Json::List(list) => Json::list(list.into_iter().map(|entry| pick(entry, chosen))),
        Json::Object(entries) => Json::object(entries.into_iter().filter_map(|(key, value)| {
            let deeper = below(chosen, key);
            (!deeper.is_empty()).then(|| (key, pick(value, &deeper)))
        })),
        value => value,
    }
}

/// The name of a field, and the fields below it. The fields below a list are the fields of its entries.
#[derive(Debug)]
struct Name {
    word: &'static str,
    parts: Vec<Name>,
}

/// All fields that can be selected, except `all`: the keys of a result, and `verdict`, the worst verdict of all frames. The path of the file and the picture are written without selection.
static NAMES: LazyLock<Vec<Name>> = LazyLock::new(|| {
    let mut names = names(KEYS);
    names.retain(|name| name.word != "file");
    let behind = names.iter().position(|name| name.word == "scene");
    names.insert(behind.map_or(0, |place| place + 1), leaf("verdict"));
    names
});

/// The names of these keys. The keys below the name of a robot cannot be selected one by one, only all together by the
/// name of the object that contains the robots.
fn names(keys: &'static [Key]) -> Vec<Name> {
    let parts = |key: &Key| match key.kind {
        Type::ByRobot => Vec::new(),
        Type::Motions => ["block", "velocity", "spin"].map(leaf).into(),
        _ => names(key.keys),
    };
    keys.iter().map(|key| Name { word: key.name, parts: parts(key) }).collect()
}

fn leaf(word: &'static str) -> Name {
    Name { word, parts: Vec::new() }
}

/// Returns the words of the path of the field with this name, such as `frames`, `proof`; `None` if there is no such
/// field.
fn find(typed: &str) -> Option<Vec<&'static str>> {
    if typed == "all" {
        return Some(vec!["all"]);
    }
    let mut names: &'static [Name] = &NAMES;
    let mut path = Vec::new();
    for word in typed.split('.') {
        let name = names.iter().find(|name| name.word == word)?;
        path.push(name.word);
        names = &name.parts;
    }
    Some(path)
}

/// Returns the name of the field that is most similar to `typed`; `None` if no name is similar.
fn nearest(typed: &str) -> Option<String> {
    let known = all();
    // Suggest the right field if the user typed another common word for the interfaces or for the total force.
    let synonym = match typed.rsplit('.').next().unwrap_or(typed) {
        "forces" | "contacts" | "contact_forces" => Some("frames.interfaces"),
        "force" | "sum_of_forces" => Some("frames.total_force"),
        _ => None,
    };
    if let Some(name) = synonym {
        return Some(name.to_owned());
    }
    text::nearest(typed, known.iter().map(String::as_str)).map(str::to_owned)
}

/// Returns the names of all fields, such as `frames.total_force`.
fn all() -> Vec<String> {
    fn add(names: &[Name], before: &str, list: &mut Vec<String>) {
        for name in names {
            let path = format!("{before}{}", name.word);
            add(&name.parts, &format!("{path}."), list);
            list.push(path);
        }
    }
    let mut list = vec!["all".to_owned()];
    add(&NAMES, "", &mut list);
    list
}
