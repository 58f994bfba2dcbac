//! [`Setting`]: a value that replaces one in the text of a scene file before it is read, such as `friction=0.5`.
//!
//! The text is edited, not the scene, so that a changed scene is checked like any other, and its text can be stored
//! and read again. The title states the changes.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use crate::mechanics::scene::{Code, Problem, SceneError};
use crate::read::path::Segment;
use crate::read::tree::{Entry, List, parse};
use crate::read::{Node, NodeKind, Path, tree::Tree};
use crate::text::{json, nearest, shortened};

/// The name of a value in a scene file, and the value that replaces it.
///
/// The name has the keys on the way to the value, separated by points: `friction`, `units.length`. An entry of a list is
/// named by its id, or a load by its block: `blocks.V3.weight`; or by its number from 0: `loads[0].force`. There are two
/// more names: `tilt` turns gravity by an angle in degrees, positive to the right (anticlockwise), and `load_factor`
/// multiplies all loads. Settings apply in their order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Setting {
    pub(in crate::mechanics::scene) name: String,
    /// The value as JSON.
    value: String,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(typed: &str) -> Result<Setting, String> {
        let wrong = || "give a key of the scene and its value, such as friction=0.5 or blocks.V3.weight=20".to_owned();
        let (name, value) = typed.split_once('=').ok_or_else(wrong)?;
        let (name, value) = (name.trim(), value.trim());
        if name.is_empty() || value.is_empty() {
            return Err(wrong());
        }
        // A word without quotes is a string: `units.length=mm`. JSON has no number without a digit before the point.
        let digits =
            value.strip_prefix('-').unwrap_or(value).strip_prefix('.').filter(|_| value.parse::<f64>().is_ok());
        let value = match digits {
            Some(digits) => format!("{}0.{digits}", if value.starts_with('-') { "-" } else { "" }),
            None if parse(value).is_ok() => value.to_owned(),
            None => quoted(value),
        };
        let setting = Setting { name: name.to_owned(), value };
        if setting.is_factor() && !setting.number().is_some_and(f64::is_finite) {
            return Err(format!("{name} needs a number, such as {name}=2"));
        }
        Ok(setting)
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.name, self.value)
    }
}

impl Setting {
    /// True if the name is no key of a scene file.
    fn is_factor(&self) -> bool {
        matches!(self.name.as_str(), "tilt" | "load_factor")
    }

    fn number(&self) -> Option<f64> {
        self.value.parse().ok()
    }

    /// Returns the changed text, and the path of the value in it.
    fn applied(&self, text: &str) -> Result<(String, String), Box<Problem>> {
        // A text that is not JSON is left as it is; reading it gives the error.
        let Ok(tree) = parse(text) else { return Ok((text.to_owned(), String::new())) };
        let root = Place { tree: &tree, text };
        let (edits, path) = match (self.name.as_str(), self.number()) {
            ("tilt", Some(degrees)) => (root.tilted(degrees), "gravity".to_owned()),
            ("load_factor", Some(factor)) => (root.with_loads(factor), "loads".to_owned()),
            _ => {
                let mut path = Path::default();
                (root.edits(&tree.root, &self.name, &self.value, &mut path)?, path.to_string())
            }
        };
        Ok((edited(text, edits), path))
    }
}

/// Each setting with the path of its value in the scene file.
pub(in crate::mechanics::scene) type Paths<'s> = Vec<(&'s Setting, String)>;

/// Returns the text with all settings applied and stated in the title, and the path of each value.
pub(in crate::mechanics::scene) fn changed<'s>(
    text: &str,
    settings: &'s [Setting],
) -> Result<(String, Paths<'s>), SceneError> {
    let mut changed = text.to_owned();
    let (mut paths, mut wrong) = (Vec::new(), Vec::new());
    for setting in settings {
        match setting.applied(&changed) {
            Ok((text, path)) => {
                changed = text;
                paths.push((setting, path));
            }
            Err(problem) => wrong.push(*problem),
        }
    }
    if !wrong.is_empty() {
        return Err(SceneError { text: None, list: wrong });
    }
    let stated = settings.iter().filter(|setting| setting.name != "title");
    let stated: Vec<String> = stated.map(|setting| format!("{} = {}", setting.name, setting.value)).collect();
    let Some(tree) = parse(&changed).ok().filter(|_| !stated.is_empty()) else { return Ok((changed, paths)) };
    let root = Place { tree: &tree, text: &changed };
    let title = match root.entry(&tree.root, "title").map(|entry| &entry.value.kind) {
        Some(NodeKind::Text(title)) if !title.is_empty() => format!("{title}, with {}", stated.join(", ")),
        _ => format!("with {}", stated.join(", ")),
    };
    let edits = root.edits(&tree.root, "title", &quoted(&title), &mut Path::default());
    Ok((edits.map_or(changed.clone(), |edits| edited(&changed, edits)), paths))
}

/// True if a path is the path `outer`, or that of something inside the value there.
pub(in crate::mechanics::scene) fn is_within(path: &str, outer: &str) -> bool {
    let rest = path.strip_prefix(outer);
    !outer.is_empty() && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// Ranges of bytes of a text, and what replaces them.
type Edits = Vec<(Range<usize>, String)>;

fn edited(text: &str, mut edits: Edits) -> String {
    edits.sort_by_key(|(range, _)| range.start);
    let mut text = text.to_owned();
    for (range, new) in edits.into_iter().rev() {
        text.replace_range(range, &new);
    }
    text
}

/// A text with its values.
struct Place<'t> {
    tree: &'t Tree<'t>,
    text: &'t str,
}

impl<'t> Place<'t> {
    fn entry(&self, node: &'t Node<'t>, key: &str) -> Option<&'t Entry<'t>> {
        let NodeKind::Object(object) = &node.kind else { return None };
        self.tree.entries(object).iter().find(|entry| entry.name == key)
    }

    fn list(&self, key: &str) -> &'t [Node<'t>] {
        match self.entry(&self.tree.root, key).map(|entry| &entry.value.kind) {
            Some(NodeKind::List(list)) => self.tree.items(list),
            _ => &[],
        }
    }

    fn number(&self, node: &Node<'t>) -> Option<f64> {
        if let NodeKind::Number(number) = node.kind { Some(number) } else { None }
    }

    fn numbers(&self, node: &Node<'t>) -> Option<Vec<f64>> {
        let NodeKind::List(list) = &node.kind else { return None };
        self.tree.items(list).iter().map(|item| self.number(item)).collect()
    }

    /// Gives `name`, as seen from `node`, the value `value`. Extends `path`, the path of `node`, to that of the value.
    fn edits(&self, node: &'t Node<'t>, name: &str, value: &str, path: &mut Path) -> Result<Edits, Box<Problem>> {
        match &node.kind {
            NodeKind::List(list) => {
                let items = self.tree.items(list);
                let (number, rest) = self.item(list, name, path)?;
                path.0.push(Segment::Index(number));
                match rest {
                    "" => Ok(vec![(items[number].range.clone(), value.to_owned())]),
                    rest => self.edits(&items[number], rest, value, path),
                }
            }
            NodeKind::Object(object) => {
                let entries = self.tree.entries(object);
                let fitting = entries.iter().filter_map(|entry| Some((entry, after(name, &entry.name)?)));
                let Some((entry, rest)) = fitting.max_by_key(|(entry, _)| entry.name.len()) else {
                    let (key, rest) = name.split_once('.').unwrap_or((name, ""));
                    path.0.push(Segment::Key(key.to_owned()));
                    let inner = rest.split('.').filter(|key| !key.is_empty()).rev();
                    let value = inner.fold(value.to_owned(), |value, key| format!("{{{}: {value}}}", quoted(key)));
                    let comma = if entries.is_empty() { "" } else { "," };
                    let start = node.range.start + 1;
                    let mut edits = vec![(start..start, format!(" {}: {value}{comma}", quoted(key)))];
                    edits.extend(self.without_rivals(entries, key, path));
                    return Ok(edits);
                };
                path.0.push(Segment::Key(entry.name.to_string()));
                if !rest.is_empty() {
                    return self.edits(&entry.value, rest, value, path);
                }
                let mut edits = vec![(entry.value.range.clone(), value.to_owned())];
                edits.extend(self.without_rivals(entries, &entry.name, path));
                Ok(edits)
            }
            _ => {
                let shown = shortened(&self.text[node.range.clone()]);
                Err(unknown(path, format!("{shown} has no key {name:?}"), "name a key of the scene file".into()))
            }
        }
    }

    /// Removes the other keys from which the weight of a block would follow.
    fn without_rivals(&self, entries: &[Entry<'t>], key: &str, path: &Path) -> Edits {
        const WEIGHTS: [&str; 3] = ["weight", "mass", "density"];
        let is_weight = path.0.first() == Some(&Segment::Key("blocks".into())) && WEIGHTS.contains(&key);
        let rivals = entries.iter().filter(|entry| is_weight && entry.name != key);
        let rivals = rivals.filter(|entry| WEIGHTS.contains(&&*entry.name));
        rivals.map(|entry| (entry.value.range.clone(), "null".to_owned())).collect()
    }

    /// Finds the entry of a list with which `name` begins. Returns its index, and the rest of the name.
    fn item<'n>(&self, list: &'t List, name: &'n str, path: &Path) -> Result<(usize, &'n str), Box<Problem>> {
        let items = self.tree.items(list);
        if let Some((index, rest)) = name.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
            let number = index.parse().ok().filter(|number| *number < items.len());
            let help = format!("the list has {} entries, counted from 0", items.len());
            let number = number.ok_or_else(|| unknown(path, format!("there is no entry [{index}]"), help))?;
            return Ok((number, rest.strip_prefix('.').unwrap_or(rest)));
        }
        let text = |item: &'t Node<'t>, key: &str| match self.entry(item, key).map(|entry| &entry.value.kind) {
            Some(NodeKind::Text(name)) => Some(name.to_string()),
            _ => None,
        };
        let id = |(number, item): (usize, &'t Node<'t>)| {
            text(item, "id").or_else(|| text(item, "block")).unwrap_or_else(|| (number + 1).to_string())
        };
        let ids: Vec<String> = items.iter().enumerate().map(id).collect();
        let fitting = ids.iter().enumerate().filter_map(|(number, id)| Some((number, id.len(), after(name, id)?)));
        fitting.max_by_key(|(_, length, _)| *length).map(|(number, _, rest)| (number, rest)).ok_or_else(|| {
            let wanted = name.rsplit_once('.').map_or(name, |(id, _)| id);
            let help = match nearest(wanted, ids.iter().map(String::as_str)) {
                Some(near) => format!("did you mean {near:?}?"),
                None => "give an id, or a number from 0 in square brackets, such as [0]".into(),
            };
            unknown(path, format!("the scene has no entry {wanted:?} here"), help)
        })
    }

    /// Turns gravity by an angle in degrees, positive anticlockwise.
    fn tilted(&self, degrees: f64) -> Edits {
        let given = self.entry(&self.tree.root, "gravity").and_then(|entry| self.numbers(&entry.value));
        let [x, y] = given.and_then(|numbers| numbers.try_into().ok()).unwrap_or([0.0, -9.81]);
        let (sin, cos) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        let turned = format!("[{}, {}]", x * cos - y * sin, x * sin + y * cos);
        self.edits(&self.tree.root, "gravity", &turned, &mut Path::default()).unwrap_or_default()
    }

    /// Multiplies the forces, torques and pressures of all loads that are not fixed.
    fn with_loads(&self, factor: f64) -> Edits {
        let mut edits = Edits::new();
        for load in self.list("loads") {
            let of = |node, key| self.entry(node, key).map(|entry| &entry.value);
            if of(load, "fixed").is_some_and(|fixed| matches!(fixed.kind, NodeKind::Flag(true))) {
                continue;
            }
            let pressure = of(load, "pressure");
            let weight = pressure.and_then(|pressure| of(pressure, "unit_weight"));
            for amount in [of(load, "force"), of(load, "torque"), pressure, weight].into_iter().flatten() {
                if let Some(parts) = self.numbers(amount) {
                    let parts: Vec<String> = parts.iter().map(|part| (part * factor).to_string()).collect();
                    edits.push((amount.range.clone(), format!("[{}]", parts.join(", "))));
                } else if let Some(number) = self.number(amount) {
                    edits.push((amount.range.clone(), (number * factor).to_string()));
                }
            }
        }
        edits
    }
}

/// Returns what follows `begin` and a point in a name; `None` if the name does not begin so.
fn after<'n>(name: &'n str, begin: &str) -> Option<&'n str> {
    let rest = name.strip_prefix(begin)?;
    if rest.is_empty() || rest.starts_with('[') { Some(rest) } else { rest.strip_prefix('.') }
}

fn quoted(text: &str) -> String {
    json(&serde_json::Value::from(text).to_string()).into_owned()
}

fn unknown(path: &Path, message: String, help: String) -> Box<Problem> {
    let problem = Problem::alone(Code::UnknownName, format!("--set: {message}"), help);
    Box::new(Problem { path: path.to_string(), ..problem })
}
