//! [`entries`]: reads the rows of a list of bodies, contacts or boxes, as text or JSON. The headings of columns decide what
//! a number is; without headings, its place does.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::draft::Remark;

/// The meaning of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Column {
    Name,
    First,
    Second,
    X,
    Y,
    Mass,
    /// The direction of a normal, or the angle of a box, in radians.
    Angle,
    Friction,
    Width,
    Height,
    Radius,
    Fixed,
}

use Column::{Angle, First, Fixed, Friction, Height, Mass, Name, Radius, Second, Width, X, Y};

/// The words for each column, without signs between words, in lower case, and what their numbers are multiplied by.
const WORDS: [(Column, f64, &str); 15] = [
    (Name, 1.0, "id no nr number index name label body block bodyid nummer"),
    (First, 1.0, "i b1 body1 bodya bodyi block1 blocka bodyid1 first firstbody"),
    (Second, 1.0, "j b2 body2 bodyb bodyj block2 blockb bodyid2 second secondbody"),
    (X, 1.0, "x"),
    (Y, 1.0, "y"),
    (Mass, 1.0, "m mass masskg kg masse"),
    (Angle, 1.0, "theta θ normal normalangle angle phi φ direction rotation winkel normale"),
    (Friction, 1.0, "mu μ µ friction frictioncoefficient coefficientoffriction reibung"),
    (Width, 1.0, "w width breite"),
    (Height, 1.0, "h height höhe"),
    (Radius, 1.0, "radius"),
    (Fixed, 1.0, "fixed static isstatic ground type bodytype"),
    // Half of the size, as in Box2D, or twice.
    (Width, 2.0, "hx halfwidth"),
    (Height, 2.0, "hy halfheight"),
    (Radius, 0.5, "diameter durchmesser"),
];
/// Units of lengths and of masses, in metres and kilograms.
const UNITS: [(bool, f64, &str); 8] = [
    (true, 1.0, "m metre metres meter meters"),
    (true, 1e-3, "mm millimetres"),
    (true, 1e-2, "cm centimetres"),
    (true, 0.0254, "in inch inches"),
    (true, 0.3048, "ft feet foot"),
    (false, 1.0, "kg kilograms"),
    (false, 1e-3, "g grams"),
    (false, 1e3, "t tonnes"),
];
/// Words that may stand beside `x` and `y`.
const BESIDE: &str = "of mass pos position coord coordinate centre center centroid contact point cog c g p m";

/// A body, a contact or a box: where it is in the file, and the text of its columns.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) place: String,
    pub(super) cells: BTreeMap<Column, String>,
    /// The number of numbers, if their places decide what they are; 0 if headings do.
    by_place: usize,
}

/// The entries of a list, the notes on its headings, and the problems of rows that cannot be read.
#[derive(Debug, Default)]
pub(super) struct Entries {
    pub(super) all: Vec<Entry>,
    pub(super) notes: Vec<String>,
    pub(super) problems: Vec<Remark>,
    /// The unit of x in the first headings.
    unit: Option<f64>,
}

/// The form of a row, for messages.
pub(super) const FORM: &str = "a body has three numbers: x, y, mass, or its number before them; a contact has six: first \
    body, second body, x, y, direction of the normal in radians, friction; other orders need headings";

impl Entry {
    pub(super) fn has(&self, columns: &[Column]) -> bool {
        columns.iter().all(|column| self.cells.contains_key(column))
    }

    /// True for a box or a disc.
    pub(super) fn is_box(&self) -> bool {
        self.has(&[X, Y, Width, Height]) || self.has(&[X, Y, Radius])
    }

    pub(super) fn number(&self, column: Column) -> Option<f64> {
        value(self.cells.get(&column)?)
    }
}

impl Entries {
    pub(super) fn problem(&mut self, place: &str, message: impl Into<String>, help: &str) {
        self.problems.push(Remark { element: place.into(), message: message.into(), help: help.into() });
    }

    /// Adds a row of cells without headings.
    fn by_place(&mut self, place: &str, cells: Vec<String>) {
        match by_count(cells.len()) {
            Some(columns) => {
                let cells = columns.iter().copied().zip(cells).collect();
                self.all.push(Entry { place: place.into(), cells, by_place: columns.len() });
            }
            None => self.problem(place, format!("it has {} numbers", cells.len()), FORM),
        }
    }
}

/// Returns the columns of a row with this many numbers and no headings.
fn by_count(count: usize) -> Option<&'static [Column]> {
    match count {
        3 => Some(&[X, Y, Mass]),
        4 => Some(&[Name, X, Y, Mass]),
        6 => Some(&[First, Second, X, Y, Angle, Friction]),
        _ => None,
    }
}

/// Returns what a heading means, and what its numbers are multiplied by: they may be in degrees, or in a unit that the
/// heading names in brackets or at its end. Upper and lower case make no difference. `None` if it is not understood.
fn column(heading: &str) -> Option<(Column, f64)> {
    let heading = heading.to_lowercase();
    let (plain, brackets) = heading.split_once(['[', '(']).unwrap_or((&heading, ""));
    let is_angle = |word: &str| (word.starts_with("deg") || word.starts_with("rad")) && word != "radius";
    let words = plain.split(|c: char| !c.is_alphanumeric());
    let mut words: Vec<&str> = words.filter(|word| !word.is_empty() && !is_angle(word)).collect();
    let mut unit = brackets.trim_end_matches([']', ')']).trim();
    let (column, factor) = meaning(&words).or_else(|| {
        unit = words.pop()?;
        meaning(&words).filter(|found| size_in(found.0, unit).is_some())
    })?;
    match column {
        Angle if heading.contains('°') || heading.contains("deg") => Some((column, 1.0_f64.to_radians())),
        // Longer words in brackets are remarks.
        X | Y | Width | Height | Radius | Mass => {
            let size = size_in(column, unit).or((unit.is_empty() || unit.len() > 4).then_some(1.0))?;
            Some((column, size * factor))
        }
        _ => Some((column, factor)),
    }
}

/// Returns the size of a unit for the numbers of a column.
fn size_in(column: Column, unit: &str) -> Option<f64> {
    let is_length = matches!(column, X | Y | Width | Height | Radius);
    let fits = |known: &&(bool, f64, &str)| known.0 == is_length && has_word(known.2, unit);
    UNITS.iter().find(fits).filter(|_| is_length || column == Mass).map(|known| known.1)
}

fn has_word(list: &str, word: &str) -> bool {
    list.split(' ').any(|known| known == word)
}

fn meaning(words: &[&str]) -> Option<(Column, f64)> {
    let joined = words.concat();
    let axis = |name: &str| {
        let rest: Vec<&str> = words.iter().copied().filter(|word| *word != name).collect();
        (rest.len() < words.len() && rest.iter().all(|word| has_word(BESIDE, word)))
            || [joined.strip_prefix(name), joined.strip_suffix(name)].into_iter().flatten().any(|w| has_word(BESIDE, w))
    };
    let is_it =
        |known: &&(Column, f64, &str)| has_word(known.2, &joined) || (matches!(known.0, X | Y) && axis(known.2));
    WORDS.iter().find(is_it).map(|known| (known.0, known.1))
}

/// Returns a text without the mark that some programs write at its beginning.
pub(super) fn unmarked(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// The headings of the rows that follow.
struct Headings {
    words: Vec<String>,
    columns: Vec<Option<(Column, f64)>>,
    /// Whether the columns are taken by their places, because too few headings are understood.
    by_place: bool,
}

impl Headings {
    /// Reads headings. Notes the columns that are not read, and those that are taken by their place.
    fn new(place: &str, words: Vec<String>, entries: &mut Entries) -> Option<Headings> {
        let mut columns: Vec<Option<(Column, f64)>> = words.iter().map(|word| column(word)).collect();
        let list =
            |words: Vec<&String>| words.into_iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
        // Two columns of bodies are the two bodies of a contact; elsewhere, the second is the name.
        let of = |columns: &[Option<(Column, f64)>], wanted: Column| -> Vec<usize> {
            (0..columns.len()).filter(|i| columns[*i].is_some_and(|c| c.0 == wanted)).collect()
        };
        if let [one, other] = of(&columns, Name)[..] {
            [columns[one], columns[other]] = match of(&columns, Mass).is_empty() && of(&columns, Width).is_empty() {
                true => [Some((First, 1.0)), Some((Second, 1.0))],
                false => [None, columns[other]],
            };
        }
        let twice = WORDS.iter().map(|known| of(&columns, known.0)).find(|places| places.len() > 1);
        if let Some(places) = twice {
            let alike = list(places.iter().map(|i| &words[*i]).collect());
            entries.problem(place, format!("its headings {alike} mean the same"), "leave one of the columns out");
            return Some(Headings { words, columns: Vec::new(), by_place: true });
        }
        let has = |wanted: &[Column]| wanted.iter().all(|w| !of(&columns, *w).is_empty());
        let kinds: [&[Column]; 4] =
            [&[X, Y, Mass], &[First, Second, X, Y, Angle], &[X, Y, Width, Height], &[X, Y, Radius]];
        if kinds.iter().any(|kind| has(kind)) {
            let unread: Vec<&String> =
                words.iter().zip(&columns).filter(|(_, c)| c.is_none()).map(|(w, _)| w).collect();
            if !unread.is_empty() {
                entries.notes.push(format!("{place}: columns that are not read: {}", list(unread)));
            }
            let unit = of(&columns, X).iter().find_map(|i| columns[*i]).map_or(1.0, |x| x.1);
            if *entries.unit.get_or_insert(unit) != unit {
                let message = "its places are in another unit than those of the headings before";
                entries.problem(place, message, "name the unit in all headings");
            }
            let in_units = columns.iter().flatten().any(|c| c.1 != 1.0 && c.0 != Angle);
            if in_units {
                entries.notes.push(format!(
                    "{place}: numbers are converted to m and kg by the words of {}",
                    list(words.iter().collect())
                ));
            }
            return Some(Headings { words, columns, by_place: false });
        }
        let places = by_count(words.len())?;
        // A column with an unknown unit, or of weights, is no column of masses.
        let is_other = |word: &String| word.contains(['[', '(']) || word.to_lowercase().contains("weight");
        let unknown = words.iter().zip(&columns).any(|(word, column)| column.is_none() && is_other(word));
        let fits = |(column, place): (&Option<(Column, f64)>, &Column)| column.is_none_or(|c| c == (*place, 1.0));
        let agrees = !unknown && columns.iter().zip(places).all(fits);
        if !agrees {
            let message = format!("its headings {} name neither a body nor a contact", list(words.iter().collect()));
            entries.problem(place, message, "name the columns x, y, mass, or b1, b2, x, y, theta, mu");
            columns.clear();
        } else if columns.iter().any(Option::is_none) {
            let taken = words.iter().zip(places).map(|(word, column)| format!("`{word}` as {}", name(*column)));
            entries.notes.push(format!("{place}: columns are taken {}", taken.collect::<Vec<_>>().join(", ")));
        }
        Some(Headings { words, columns, by_place: true })
    }
}

/// Returns the word for a column in messages.
fn name(column: Column) -> &'static str {
    match column {
        Name => "the number of the body",
        First => "the first body",
        Second => "the second body",
        X => "x",
        Y => "y",
        Mass => "mass",
        Angle => "direction of the normal",
        Friction => "friction",
        Width => "width",
        Height => "height",
        Radius => "radius",
        Fixed => "fixed",
    }
}

/// Reads the entries of files. With several files, the place of an entry begins with the name of its file. With
/// `decimal_comma`, commas are decimal points.
pub(super) fn entries(files: &[(&str, &str)], decimal_comma: bool) -> Entries {
    let mut entries = Entries::default();
    for (file, text) in files {
        let text = unmarked(text);
        let prefix = if files.len() > 1 { format!("{file} ") } else { String::new() };
        match serde_json::from_str::<Value>(text) {
            Ok(value @ (Value::Object(_) | Value::Array(_))) => json(&value, &prefix, &mut entries),
            Err(error) if text.trim_start().starts_with('{') => {
                entries.problem(file, error.to_string(), "correct the JSON text");
            }
            _ => written(text, decimal_comma, &prefix, &mut entries),
        }
    }
    // Either all bodies begin with their number, or none.
    if entries.all.iter().any(|entry| entry.by_place == 3) {
        let (numbered, others) = std::mem::take(&mut entries.all).into_iter().partition(|entry| entry.by_place == 4);
        entries.all = others;
        let numbered: Vec<Entry> = numbered;
        numbered.iter().for_each(|entry| entries.problem(&entry.place, "it has 4 numbers", FORM));
    }
    entries
}

/// Reads rows of numbers, separated by commas, semicolons, tabs or spaces. Comments begin with `#` or `%`, and may be
/// headings.
fn written(text: &str, decimal_comma: bool, prefix: &str, entries: &mut Entries) {
    let mut headings: Option<Headings> = None;
    let has_points = {
        let outside: String = text.split('"').step_by(2).collect();
        outside.split('.').skip(1).any(|after| after.starts_with(|c: char| c.is_ascii_digit()))
    };
    for (number, line) in text.lines().enumerate() {
        let place = format!("{prefix}line {}", number + 1);
        // Commas in quotes are decimal points.
        let parts = line.split('"').enumerate();
        if let Some((_, part)) = parts.clone().find(|(i, part)| i % 2 == 1 && has_points && is_grouped(part)) {
            let message = format!("the comma in `{part}` may be a decimal point or separate thousands");
            entries.problem(&place, message, "write the number without a comma");
            continue;
        }
        let line: String = parts
            .map(|(i, part)| if i % 2 == 1 || decimal_comma { part.replace(',', ".") } else { part.into() })
            .collect();
        let (line, is_comment) = match line.trim_start().strip_prefix(['#', '%']) {
            Some(rest) => (rest.to_owned(), true),
            None => (line.split(['#', '%']).next().unwrap_or("").to_owned(), false),
        };
        for row in rows(&line) {
            let separator = [';', '\t', ','].into_iter().find(|s| row.contains(*s));
            let mut columns: Vec<String> = match separator {
                Some(separator) => row.split(separator).map(|cell| cell.trim().to_owned()).collect(),
                None => row.split_whitespace().map(str::to_owned).collect(),
            };
            while columns.last().is_some_and(String::is_empty) {
                columns.pop();
            }
            let is_heading =
                columns.len() > 1 && !row.contains('=') && columns.iter().all(|cell| begins_with_word(cell));
            if is_comment {
                if columns.len() > 2 && columns.iter().all(|cell| column(cell).is_some()) {
                    headings = Headings::new(&place, columns, entries);
                }
                continue;
            }
            let is_row = |headings: &&Headings| headings.words.len() == columns.len() && !headings.by_place;
            if is_heading {
                headings = Headings::new(&place, columns, entries);
            } else if let Some(headings) = headings.as_ref().filter(is_row) {
                let cells = headings.columns.iter().zip(columns).filter(|(_, cell)| !cell.is_empty());
                let cells = cells.filter_map(|(column, cell)| Some(((*column)?.0, converted(cell, (*column)?.1))));
                entries.all.push(Entry { place: place.clone(), cells: cells.collect(), by_place: 0 });
            } else if !headings.as_ref().is_some_and(|h| h.words.len() == columns.len() && h.columns.is_empty()) {
                plain(&row, &place, entries);
            }
        }
    }
}

/// Reads a row without headings.
fn plain(row: &str, place: &str, entries: &mut Entries) {
    let is_separator = |c: char| matches!(c, ',' | ';' | ':') || c.is_whitespace();
    let cells = row.split(is_separator).filter(|cell| !cell.is_empty());
    let mut cells: Vec<String> = cells.map(str::to_owned).collect();
    if cells.first().is_some_and(|cell| matches!(cell.to_lowercase().as_str(), "body" | "contact")) {
        cells.remove(0);
    }
    match cells.iter().filter(|cell| value(cell).is_some()).count() {
        0 => {}
        count if count == cells.len() => entries.by_place(place, cells),
        _ => entries.problem(place, "it has words between numbers", FORM),
    }
}

/// Returns the rows in a line: the whole line, or the innermost lists in it, as in the source text of a program.
fn rows(line: &str) -> Vec<String> {
    let is_tuple = line.trim_start().starts_with('(');
    let line = if is_tuple { line.replace('(', "[").replace(')', "]") } else { line.to_owned() };
    let is_prose = begins_with_word(line.trim()) && !["=", "[[", "(["].iter().any(|sign| line.contains(sign));
    if !line.contains(['[', ']']) || is_prose {
        return vec![line];
    }
    let lists = line.split(']').filter_map(|part| Some(part.rsplit_once('[')?.1.to_owned()));
    lists.filter(|list| !list.trim().is_empty()).collect()
}

/// Multiplies the number in a cell.
fn converted(cell: String, factor: f64) -> String {
    match value(&cell).filter(|_| factor != 1.0) {
        // A quotient has no more digits than needed: 0.35 m for 350 mm.
        Some(number) if (1.0 / factor).fract() == 0.0 => (number / (1.0 / factor)).to_string(),
        Some(number) => (number * factor).to_string(),
        None => cell,
    }
}

/// True if a word says that a body is fixed, or that something is so.
pub(super) fn is_true(word: &str) -> bool {
    let word = word.trim().to_lowercase();
    has_word("1 1.0 true yes ja fixed static kinematic ground x", &word)
}

/// Parses a number whose decimal point may be a comma; `None` if its comma may separate thousands.
pub(super) fn decimal(text: &str) -> Option<f64> {
    value(&text.replacen(',', ".", 1)).filter(|_| !is_grouped(text))
}

/// True for a number such as `1,200`.
fn is_grouped(text: &str) -> bool {
    let mut groups = text.trim().trim_start_matches(['-', '+']).split(',');
    let first = groups.next().unwrap_or("");
    let groups: Vec<&str> = groups.collect();
    let is_count = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    (1..4).contains(&first.len())
        && is_count(first)
        && !first.starts_with('0')
        && !groups.is_empty()
        && groups.iter().all(|group| group.len() == 3 && is_count(group))
}

fn begins_with_word(cell: &str) -> bool {
    let first = cell.split_whitespace().next().unwrap_or("");
    first.starts_with(char::is_alphabetic) && value(first).is_none()
}

/// Parses a finite number: also a product or quotient with π as in a script, such as `-np.pi/2.`, and `deg2rad(30)`.
pub(super) fn value(cell: &str) -> Option<f64> {
    let mut cell = cell.trim().replace('π', "pi").to_lowercase();
    for module in ["np.", "numpy.", "math."] {
        cell = cell.replace(module, "");
    }
    let degrees = ["deg2rad(", "radians("].iter().find_map(|function| cell.strip_prefix(function)?.strip_suffix(')'));
    if let Some(degrees) = degrees {
        return value(degrees).map(f64::to_radians);
    }
    let factor = |text: &str| {
        let text = text.trim();
        match text.strip_suffix("pi").map(|times| times.trim()) {
            Some("" | "+") => Some(core::f64::consts::PI),
            Some("-") => Some(-core::f64::consts::PI),
            Some(times) => times.parse::<f64>().ok().map(|times| times * core::f64::consts::PI),
            None => text.parse().ok(),
        }
    };
    let mut product = 1.0;
    for (i, quotient) in cell.split('*').flat_map(|part| part.split('/').enumerate()) {
        product = if i == 0 { product * factor(quotient)? } else { product / factor(quotient)? };
    }
    Some(product).filter(|number: &f64| number.is_finite())
}

/// Reads the lists of a JSON value: `bodies`, `contacts` or `boxes` of an object, or a plain list. An entry is a list of
/// numbers, or an object with named numbers.
fn json(value: &Value, prefix: &str, entries: &mut Entries) {
    let lists = ["bodies", "contacts", "boxes"].map(|key| (key, &value[key]));
    let whole = [("entry ", value)];
    let lists = if value.is_array() { &whole[..] } else { &lists[..] };
    let mut unread: BTreeSet<String> = BTreeSet::new();
    for (list, value) in lists {
        for (i, entry) in value.as_array().into_iter().flatten().enumerate() {
            let place = format!("{prefix}{list}[{i}]");
            if let Some(cells) = entry.as_array() {
                match cells.iter().map(text).collect() {
                    Some(cells) => entries.by_place(&place, cells),
                    None => entries.problem(&place, "its numbers cannot be read", FORM),
                }
                continue;
            }
            let mut cells = BTreeMap::new();
            for (key, value) in entry.as_object().into_iter().flatten() {
                let pair: &[Column] = match key.to_lowercase().as_str() {
                    "bodies" => &[First, Second],
                    "centre" | "center" | "at" | "position" | "pos" => &[X, Y],
                    "size" => &[Width, Height],
                    _ => &[],
                };
                let listed = pair.iter().copied().zip(value.as_array().into_iter().flatten());
                let before = cells.len();
                cells.extend(listed.filter_map(|(column, value)| Some((column, text(value)?))));
                match (column(key), text(value)) {
                    (Some((column, factor)), Some(cell)) => drop(cells.insert(column, converted(cell, factor))),
                    _ if cells.len() == before => drop(unread.insert(format!("`{key}`"))),
                    _ => {}
                }
            }
            entries.all.push(Entry { place, cells, by_place: 0 });
        }
    }
    if !unread.is_empty() {
        let keys = unread.into_iter().collect::<Vec<_>>().join(", ");
        entries.notes.push(format!("{prefix}keys that are not read: {keys}"));
    }
}

fn text(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Number(_) | Value::Bool(_) => Some(value.to_string()),
        _ => None,
    }
}
