//! [`Setting`]: a value that replaces one in the syntax tree of a scene file before it is read, such as `friction=0.5`.
//!
//! The tree is edited, not the scene, so that a changed scene is checked like any other, and its file can be stored and
//! read again. The title states the changes.

use std::fmt;
use std::str::FromStr;

use super::load::FixedPart;
use super::unit::split_unit;
use crate::geometry::Vector;
use crate::mechanics::scene::{Code, Problem, SceneError};
use crate::read::path::Segment;
use crate::read::tree::{Entry, List, MAX_DEPTH, Object, Tree, parse};
use crate::read::{Node, NodeKind, Path, Source};
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
        if name.split(['.', '[']).count() > MAX_DEPTH {
            return Err(format!("the name of a value has at most {MAX_DEPTH} parts"));
        }
        // A word without quotes is a string: `units.length=mm`.
        let value =
            if parse(value).is_ok() { value.to_owned() } else { with_zero(value).unwrap_or_else(|| quoted(value)) };
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

    /// Gives the value its place in the tree. Returns the path at which messages look for it.
    fn apply<'t>(&'t self, tree: &mut Tree<'t>, text: &str) -> Result<Path, Box<Problem>> {
        let mut path = Path::default();
        match (self.name.as_str(), self.number()) {
            ("tilt", Some(degrees)) => {
                tilt(tree, text, degrees)?;
                path.0.push(Segment::Key("gravity".into()));
            }
            ("load_factor", Some(factor)) => {
                multiply_loads(tree, factor)?;
                path.0.push(Segment::Key("loads".into()));
            }
            (name, _) => tree.root = put(tree, text, tree.root.clone(), (name, &self.value), &mut path)?,
        }
        Ok(path)
    }
}

/// The path of the value of each setting in the scene file, in the order of the settings.
pub(in crate::mechanics::scene) type Paths = Vec<String>;

/// Applies all settings, and states them in the title. Returns their paths.
pub(in crate::mechanics::scene) fn apply<'t>(
    settings: &'t [Setting],
    source: &mut Source<'t>,
) -> Result<Paths, SceneError> {
    let (mut paths, mut wrong) = (Vec::new(), Vec::new());
    let Some(tree) = source.tree.as_mut() else { return Ok(paths) };
    for setting in settings {
        match setting.apply(tree, source.text) {
            Ok(path) => paths.push(path.to_string()),
            Err(problem) => {
                let message = format!("{setting}: {}", problem.message);
                wrong.push(Problem { message, ..*problem });
            }
        }
    }
    if !wrong.is_empty() {
        return Err(SceneError { text: None, list: wrong });
    }
    let stated = settings.iter().filter(|setting| setting.name != "title");
    let stated: Vec<String> = stated.map(|setting| format!("{} = {}", setting.name, setting.value)).collect();
    let words = format!("with {}", stated.join(", "));
    if stated.is_empty() {
        return Ok(paths);
    }
    let title = match entry(tree, &tree.root, "title").map(|entry| &entry.value.kind) {
        Some(NodeKind::Text(title)) if !title.is_empty() => format!("{title}, {words}"),
        _ => words,
    };
    // If the file is not an object, reading it gives the error.
    if let Ok(root) = put(tree, source.text, tree.root.clone(), ("title", "\"\""), &mut Path::default())
        && let NodeKind::Object(Object(keys)) = &root.kind
    {
        let mut keys = tree.entries[keys.clone()].iter_mut();
        if let Some(entry) = keys.find(|entry| entry.name == "title") {
            entry.value.kind = NodeKind::Text(title.into());
        }
        tree.root = root;
    }
    Ok(paths)
}

/// True if a path is the path `outer`, or that of something inside the value there.
pub(in crate::mechanics::scene) fn is_within(path: &str, outer: &str) -> bool {
    let rest = path.strip_prefix(outer);
    !outer.is_empty() && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// The keys from which the weight of a block follows.
const WEIGHTS: [&str; 3] = ["weight", "mass", "density"];

/// Gives a value, as JSON, to a name as seen from `node`. Extends `path`, the path of `node`, to that of the value. Keys
/// that are missing on the way are added; the path then ends at the first of them. Returns the changed node.
fn put<'t>(
    tree: &mut Tree<'t>,
    text: &str,
    mut node: Node<'t>,
    (name, value): (&str, &'t str),
    path: &mut Path,
) -> Result<Node<'t>, Box<Problem>> {
    let home = node.range.start;
    if name.is_empty() {
        return Ok(tree.add(value, home).unwrap_or(node));
    }
    match node.kind.clone() {
        NodeKind::List(list) => {
            let (number, rest) = item(tree, &list, name, path)?;
            path.0.push(Segment::Index(number));
            let at = list.0.start + number;
            tree.items[at] = put(tree, text, tree.items[at].clone(), (rest, value), path)?;
        }
        NodeKind::Object(Object(mut keys)) => {
            let entries = keys.clone().filter_map(|at| Some((at, after(name, &tree.entries[at].name)?)));
            let found = entries.min_by_key(|(_, rest)| rest.len());
            let (at, rest) = found.unwrap_or_else(|| {
                // A body without a position is at the origin.
                let is_body = path.0.len() == 2
                    && ["blocks", "ground"].iter().any(|list| path.0[0] == Segment::Key((*list).into()));
                let is_position = is_body && matches!(name, "at[0]" | "at[1]");
                let (key, rest) = match is_position {
                    true => name.split_at(2),
                    false => name.split_once('.').unwrap_or((name, "")),
                };
                let none = Node { range: home..home, kind: NodeKind::Object(Object(0..0)) };
                let origin = is_position.then(|| tree.add("[0, 0]", home).ok()).flatten();
                let value = origin.unwrap_or(none);
                let at = tree.entries.len();
                tree.entries.push(Entry { name: key.to_owned().into(), name_range: home..home, value });
                tree.entries.extend_from_within(keys.clone());
                keys = at..tree.entries.len();
                (at, rest.trim_matches('.'))
            });
            let key = tree.entries[at].name.to_string();
            let is_weight = path.0.first() == Some(&Segment::Key("blocks".into())) && WEIGHTS.contains(&&*key);
            for rival in tree.entries[keys.clone()].iter_mut().filter(|_| is_weight && rest.is_empty()) {
                if WEIGHTS.contains(&&*rival.name) && rival.name != key {
                    rival.value.kind = NodeKind::Null;
                }
            }
            path.0.push(Segment::Key(key));
            let (inner, mut added) = (tree.entries[at].value.clone(), Path::default());
            let path = if found.is_some() { path } else { &mut added };
            tree.entries[at].value = put(tree, text, inner, (rest, value), path)?;
            node.kind = NodeKind::Object(Object(keys));
        }
        _ => {
            // The value of an earlier setting has no text in the file.
            let written = text.get(node.range).filter(|written| !written.is_empty());
            let shown = shortened(written.unwrap_or("the value set before"));
            return Err(unknown(path, format!("{shown} has no key {name:?}"), "name a key of the scene file".into()));
        }
    }
    Ok(node)
}

/// Returns the entry of an object with this key.
fn entry<'n, 't>(tree: &'n Tree<'t>, node: &Node<'_>, key: &str) -> Option<&'n Entry<'t>> {
    let NodeKind::Object(object) = &node.kind else { return None };
    tree.entries(object).iter().find(|entry| entry.name == key)
}

/// Finds the entry of a list with which `name` begins. Returns its index, and the rest of the name.
fn item<'n>(tree: &Tree<'_>, list: &List, name: &'n str, path: &Path) -> Result<(usize, &'n str), Box<Problem>> {
    if let Some((index, rest)) = name.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
        let number = index.parse().ok().filter(|number| *number < list.len());
        let help = format!("the list has {} entries, counted from 0", list.len());
        let number = number.ok_or_else(|| unknown(path, format!("there is no entry [{index}]"), help))?;
        return Ok((number, rest.strip_prefix('.').unwrap_or(rest)));
    }
    let text = |item: &Node<'_>, key: &str| match &entry(tree, item, key)?.value.kind {
        NodeKind::Text(name) => Some(name.to_string()),
        _ => None,
    };
    let id = |(number, item): (usize, &Node<'_>)| {
        text(item, "id").or_else(|| text(item, "block")).unwrap_or_else(|| (number + 1).to_string())
    };
    let ids: Vec<String> = tree.items(list).iter().enumerate().map(id).collect();
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

/// Returns the number with this name in a JSON text; names are those of a [`Setting`]. With `of_last`, the name starts at the
/// last entry of the list with this key. If the value is an object of numbers, returns the smallest. `"unbounded"` is infinite.
pub(crate) fn number_in(json: &str, of_last: Option<&str>, name: &str) -> Option<f64> {
    let tree = parse(json).ok()?;
    let start = match of_last {
        None => &tree.root,
        Some(key) => match &entry(&tree, &tree.root, key)?.value.kind {
            NodeKind::List(list) => tree.items(list).last()?,
            _ => return None,
        },
    };
    smallest(&tree, at(&tree, start, name)?)
}

/// Returns the value with this name as seen from `node`.
fn at<'n, 't>(tree: &'n Tree<'t>, node: &'n Node<'t>, name: &str) -> Option<&'n Node<'t>> {
    match &node.kind {
        _ if name.is_empty() => Some(node),
        NodeKind::List(list) => {
            let (number, rest) = item(tree, list, name, &Path::default()).ok()?;
            at(tree, tree.items(list).get(number)?, rest)
        }
        NodeKind::Object(object) => {
            let found = tree.entries(object).iter().filter_map(|entry| Some((entry, after(name, &entry.name)?)));
            let (entry, rest) = found.min_by_key(|(_, rest)| rest.len())?;
            at(tree, &entry.value, rest)
        }
        _ => None,
    }
}

/// Returns a number, or the smallest number of an object.
fn smallest(tree: &Tree<'_>, node: &Node<'_>) -> Option<f64> {
    match &node.kind {
        NodeKind::Number(number) => Some(*number),
        NodeKind::Text(word) if word == "unbounded" => Some(f64::INFINITY),
        NodeKind::Object(sides) => {
            let sides = tree.entries(sides).iter().map(|side| smallest(tree, &side.value));
            sides.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::min)
        }
        _ => None,
    }
}

/// Turns gravity by an angle in degrees, positive anticlockwise.
fn tilt(tree: &mut Tree<'_>, text: &str, degrees: f64) -> Result<(), Box<Problem>> {
    let pair = |tree: &Tree<'_>| {
        let gravity = &entry(tree, &tree.root, "gravity")?.value;
        let NodeKind::List(list) = &gravity.kind else { return None };
        let vector = vector(tree, gravity)?;
        Some((list.0.start, vector.x, vector.y))
    };
    if pair(tree).is_none() {
        tree.root = put(tree, text, tree.root.clone(), ("gravity", "[0, -9.81]"), &mut Path::default())?;
    }
    if let Some((at, x, y)) = pair(tree) {
        let (sin, cos) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        tree.items[at].kind = NodeKind::Number(x * cos - y * sin);
        tree.items[at + 1].kind = NodeKind::Number(x * sin + y * cos);
    }
    Ok(())
}

/// Returns a list of two numbers as a vector. `None` for another value.
fn vector(tree: &Tree<'_>, node: &Node<'_>) -> Option<Vector> {
    let NodeKind::List(list) = &node.kind else { return None };
    match tree.items(list) {
        [Node { kind: NodeKind::Number(x), .. }, Node { kind: NodeKind::Number(y), .. }] => Some(Vector::new(*x, *y)),
        _ => None,
    }
}

/// Multiplies the forces, torques and pressures of all loads that are not fixed. Of a load of which only a part is fixed,
/// multiplies the rest. Refuses such a pressure.
fn multiply_loads(tree: &mut Tree<'_>, factor: f64) -> Result<(), Box<Problem>> {
    let Some(NodeKind::List(loads)) = entry(tree, &tree.root, "loads").map(|entry| entry.value.kind.clone()) else {
        return Ok(());
    };
    let times = |node: &mut Node<'_>| {
        match &mut node.kind {
            NodeKind::Number(amount) => *amount *= factor,
            // A unit weight may have a unit.
            NodeKind::Text(text) => {
                if let Some((amount, unit)) = split_unit(text) {
                    *text = format!("{} {unit}", amount * factor).into();
                }
            }
            _ => {}
        }
    };
    for load in tree.items(&loads).to_vec() {
        let fixed = entry(tree, &load, "fixed").map(|fixed| fixed.value.kind.clone());
        let is_fixed = fixed == Some(NodeKind::Flag(true));
        let gravity = entry(tree, &tree.root, "gravity").and_then(|entry| vector(tree, &entry.value));
        let part = match &fixed {
            Some(NodeKind::Text(part)) if part == "vertical" => Some(FixedPart::Vertical),
            Some(NodeKind::Text(_)) => Some(FixedPart::Horizontal),
            _ => None,
        };
        let direction = part.map(|part| part.direction(gravity.unwrap_or_default()));
        if direction.is_some() && entry(tree, &load, "pressure").is_some() {
            let message = "only a part of a pressure is fixed, so no other pressure replaces it".to_owned();
            let help = "use the margin load_factor, or change the unit_weight of the pressure".to_owned();
            return Err(unknown(&Path(vec![Segment::Key("loads".into())]), message, help));
        }
        let NodeKind::Object(Object(keys)) = load.kind else { continue };
        for at in keys.filter(|_| !is_fixed) {
            if !["force", "torque", "pressure"].contains(&&*tree.entries[at].name) {
                continue;
            }
            match tree.entries[at].value.kind.clone() {
                NodeKind::List(List(parts)) => {
                    // The fixed part of the force keeps its amount.
                    let force = direction.and_then(|_| vector(tree, &tree.entries[at].value));
                    let kept = direction.zip(force).map_or(Vector::zeros(), |(along, force)| along * along.dot(&force));
                    for (node, kept) in tree.items[parts].iter_mut().zip([kept.x, kept.y]) {
                        times(node);
                        if let NodeKind::Number(amount) = &mut node.kind {
                            *amount += kept * (1.0 - factor);
                        }
                    }
                }
                NodeKind::Object(Object(parts)) => {
                    let parts = tree.entries[parts].iter_mut().filter(|part| part.name == "unit_weight");
                    parts.for_each(|part| times(&mut part.value));
                }
                _ => times(&mut tree.entries[at].value),
            }
        }
    }
    Ok(())
}

/// Returns what follows `begin` and a point in a name; `None` if the name does not begin so.
fn after<'n>(name: &'n str, begin: &str) -> Option<&'n str> {
    let rest = name.strip_prefix(begin)?;
    if rest.is_empty() || rest.starts_with('[') { Some(rest) } else { rest.strip_prefix('.') }
}

/// Returns a number that begins with a point, such as `-.5`, with a zero before the point; `None` for other text.
fn with_zero(value: &str) -> Option<String> {
    let (sign, digits) = value.strip_prefix('-').map_or(("", value), |digits| ("-", digits));
    let number = format!("{sign}0{digits}");
    (digits.starts_with('.') && parse(&number).is_ok()).then_some(number)
}

fn quoted(text: &str) -> String {
    json(&serde_json::Value::from(text).to_string()).into_owned()
}

fn unknown(path: &Path, message: String, help: String) -> Box<Problem> {
    let problem = Problem::alone(Code::UnknownName, message, help);
    Box::new(Problem { path: path.to_string(), ..problem })
}
