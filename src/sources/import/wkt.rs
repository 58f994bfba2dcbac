//! Reads well-known text into a [`Draft`]: one geometry per line, with an optional name before it, or a table with a
//! column of well-known text.

use super::draft::{Draft, FillRule, PartGeometry, Role};
use super::geojson::{Properties, degrees_problem, labelled};
use super::naming::Naming;
use super::subpath::{Segment, Subpath};
use crate::geometry::{Point, Vector, cross};

/// The largest nesting depth of collections; deeper ones could overflow the stack.
const MAX_DEPTH: usize = 50;

/// The headings of a column of well-known text.
const GEOMETRY_KEYS: [&str; 5] = ["wkt", "geometry", "geom", "the_geom", "wkt_geom"];

/// Reads lines of well-known text (WKT), or a table with a column of it. `scale` is in metres per unit. Lines that begin
/// with `#` are comments, and lines that cannot be read are reported. A geometry may go on in the next line.
///
/// # Errors
/// Returns a message if the coordinates look like degrees, unless the user gave the scale (`is_scale_given`).
pub(super) fn read(text: &str, scale: f64, is_scale_given: bool, naming: &Naming<'_>) -> Result<Draft, String> {
    let mut draft = Draft::default();
    if let Some((separator, columns)) = table(text) {
        let rows = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).skip(1);
        for (number, line) in rows {
            let (at, cells) = (format!("line {}", number + 1), cells(line, separator));
            let pairs = || columns.iter().zip(&cells);
            let given = pairs().map(|(key, cell)| (key.trim().to_owned(), cell.trim().into())).collect();
            let about = Properties::read(&given, None, &at, naming, &mut draft);
            let geometry = pairs().find(|(key, _)| is_column(key)).map_or("", |found| found.1);
            add(&mut draft, naming, &at, about, geometry, scale);
        }
    } else {
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).peekable();
        while let Some((number, line)) = lines.next() {
            if line.trim_start().starts_with('#') {
                continue;
            }
            let mut whole = line.trim().to_owned();
            let mut depth = open(&whole);
            // A list that is still open goes on in the next line, unless another geometry begins there.
            while depth > 0
                && is_geometry(&whole)
                && let Some((_, next)) = lines.next_if(|next| whole.ends_with([',', '(']) || !is_geometry(next.1))
            {
                depth += open(next);
                whole = whole + " " + next.trim();
            }
            let (name, rest) = named(&whole);
            let about = Properties { kind: naming.role(name), name: name.to_owned(), ..Properties::default() };
            add(&mut draft, naming, &format!("line {}", number + 1), about, rest, scale);
        }
    }
    let system = text.to_lowercase().contains("srid=4326").then_some("EPSG:4326");
    match degrees_problem(&draft, system).filter(|_| !is_scale_given) {
        Some(why) => Err(why),
        None => Ok(draft),
    }
}

/// Returns how many more parentheses a line opens than it closes.
fn open(line: &str) -> isize {
    line.chars().map(|c| isize::from(c == '(') - isize::from(c == ')')).sum()
}

/// True if a text is a table with a column of well-known text.
pub(super) fn is_table(text: &str) -> bool {
    table(text).is_some()
}

fn is_column(heading: &str) -> bool {
    GEOMETRY_KEYS.iter().any(|key| heading.trim().eq_ignore_ascii_case(key))
}

/// True if a line has the word of a geometry before a parenthesis.
pub(super) fn is_geometry(line: &str) -> bool {
    let mut reader = Reader::new(named(line).1);
    let word = reader.kind();
    let known = ["POINT", "STRING", "POLYGON", "CURVE", "COLLECTION", "SURFACE", "TRIANGLE"];
    known.iter().any(|ending| word.ends_with(ending)) && (reader.accept('(') || reader.peek_word() == "EMPTY")
}

/// Returns the separator and the headings of a table with a column of well-known text; `None` for other text.
fn table(text: &str) -> Option<(char, Vec<String>)> {
    let heading = text.lines().find(|line| !line.trim().is_empty())?;
    let split = |separator| (separator, cells(heading, separator));
    [',', ';', '\t'].map(split).into_iter().find(|(_, columns)| columns.iter().any(|heading| is_column(heading)))
}

/// Splits a row of a table into cells. Cells in quotes may contain the separator; two quotes stand for one.
fn cells(line: &str, separator: char) -> Vec<String> {
    let (mut cells, mut is_quoted) = (vec![String::new()], false);
    for c in line.trim_end().chars() {
        match (c, cells.last_mut()) {
            ('"', _) => is_quoted = !is_quoted,
            (c, _) if c == separator && !is_quoted => cells.push(String::new()),
            (c, Some(cell)) => cell.push(c),
            (_, None) => {}
        }
    }
    cells
}

/// Adds the geometry in a line to the draft.
fn add(draft: &mut Draft, naming: &Naming<'_>, at: &str, about: Properties, text: &str, scale: f64) {
    let element = labelled(at, &about.name);
    if about.kind == Some(Role::Ignored) {
        draft.skip(naming.why_ignored(), element);
        return;
    }
    let robot = about.kind == Some(Role::Robot);
    let mut reader = Reader { scale, robot, ..Reader::new(text) };
    let read = reader.geometry(0).and_then(|()| {
        if reader.rest.trim().is_empty() { Ok(()) } else { Err(reader.expected_error("the end of the line")) }
    });
    if let Err(why) = read {
        draft.lose("element", &element, &why, "write a line as: name; POLYGON ((0 0, 2 0, 2 1, 0 0))");
        return;
    }
    for (what, why) in &reader.lost {
        draft.lose(what, &element, why, "");
    }
    reader.geometries.into_iter().for_each(|form| about.part(form, element.clone(), draft));
}

/// Splits a line into name and geometry, at the last semicolon or tab before the first parenthesis. The prefix
/// `SRID=…;`, which databases write, is not a name.
fn named(line: &str) -> (&str, &str) {
    let geometry = line.find('(').unwrap_or(line.len());
    match line[..geometry].rfind([';', '\t']) {
        Some(end) => {
            let name = line[..end].trim_matches(|c: char| c.is_whitespace() || c == ';');
            let is_system = name.get(..5).is_some_and(|s| s.eq_ignore_ascii_case("srid="));
            (if is_system { "" } else { name.trim_matches('"') }, &line[end + 1..])
        }
        None => ("", line),
    }
}

struct Reader<'t> {
    rest: &'t str,
    scale: f64,
    /// Whether points are allowed. They are allowed only as grip points of robots.
    robot: bool,
    geometries: Vec<PartGeometry>,
    /// What encloses no area or is not known, with the reason.
    lost: Vec<(&'static str, String)>,
}

impl<'t> Reader<'t> {
    fn new(rest: &'t str) -> Reader<'t> {
        Reader { rest, scale: 1.0, robot: false, geometries: Vec::new(), lost: Vec::new() }
    }

    /// Reads a geometry, and its members if it is a collection. A member that encloses no area, or of an unknown kind, does
    /// not concern the others.
    fn geometry(&mut self, depth: usize) -> Result<(), String> {
        if depth > MAX_DEPTH {
            return Err(format!("collections are nested more than {MAX_DEPTH} levels deep"));
        }
        let word = self.kind();
        if word.is_empty() {
            return Err(self.expected_error("a geometry such as POLYGON"));
        }
        if self.peek_word() == "EMPTY" {
            self.word();
            self.lost.push(("empty geometry", "it is empty".into()));
            return Ok(());
        }
        match word.as_str() {
            "POLYGON" | "CURVEPOLYGON" | "TRIANGLE" => self.surface(),
            "MULTIPOLYGON" | "MULTISURFACE" => self.list(|reader| match reader.peek_word().is_empty() {
                true => reader.surface(),
                false => reader.geometry(depth + 1),
            }),
            "LINESTRING" | "CIRCULARSTRING" | "COMPOUNDCURVE" => {
                let line = self.curve(&word)?;
                self.add(Vec::from_iter(line));
                Ok(())
            }
            "MULTILINESTRING" | "MULTICURVE" => self.list(|reader| {
                let word = reader.kind();
                let line = reader.curve(&word)?;
                reader.add(Vec::from_iter(line));
                Ok(())
            }),
            "POINT" if self.robot => {
                self.expect('(')?;
                let spot = self.point()?;
                self.geometries.push(PartGeometry::Point(spot));
                self.expect(')')
            }
            "GEOMETRYCOLLECTION" => self.list(|reader| reader.geometry(depth + 1)),
            "POINT" | "MULTIPOINT" => self.pass_over("point", "a point encloses no area".into()),
            _ => self.pass_over("element", format!("{word} is not a known geometry")),
        }
    }

    /// Reads the word that names a geometry, without the letters that announce heights and measures.
    fn kind(&mut self) -> String {
        let mut word = self.word();
        if matches!(self.peek_word().as_str(), "Z" | "M" | "ZM") {
            self.word();
        }
        for ending in ["ZM", "Z", "M"] {
            if let Some(plain) = word.strip_suffix(ending).filter(|p| p.ends_with(['N', 'T', 'G', 'E'])) {
                word = plain.to_owned();
            }
        }
        word
    }

    /// Skips the list in parentheses that follows, and reports it as left out.
    fn pass_over(&mut self, what: &'static str, why: String) -> Result<(), String> {
        self.expect('(')?;
        let mut depth = 1;
        while depth > 0 {
            let Some(end) = self.rest.find(['(', ')']) else { return self.expect(')') };
            depth = if self.rest[end..].starts_with('(') { depth + 1 } else { depth - 1 };
            self.rest = &self.rest[end + 1..];
        }
        self.lost.push((what, why));
        Ok(())
    }

    fn add(&mut self, outlines: Vec<Subpath>) {
        self.geometries.push(PartGeometry::Subpaths(outlines, FillRule::EvenOdd));
    }

    /// Reads the outline of a polygon, and its holes.
    fn surface(&mut self) -> Result<(), String> {
        let mut outlines = Vec::new();
        self.list(|reader| {
            let word = reader.kind();
            outlines.extend(reader.curve(&word)?.into_iter().map(|curve| Subpath { closed: true, ..curve }));
            Ok(())
        })?;
        self.add(outlines);
        Ok(())
    }

    /// Reads the points of a line or curve, whose kind was `word`. Returns nothing if it has no points.
    fn curve(&mut self, word: &str) -> Result<Option<Subpath>, String> {
        if word == "COMPOUNDCURVE" {
            let mut whole: Option<Subpath> = None;
            self.list(|reader| {
                let word = reader.kind();
                match (&mut whole, reader.curve(&word)?) {
                    (Some(whole), Some(next)) => whole.segments.extend(next.segments),
                    (whole, next) => *whole = next,
                }
                Ok(())
            })?;
            return Ok(whole);
        }
        let mut points = Vec::new();
        self.list(|reader| {
            points.push(reader.point()?);
            Ok(())
        })?;
        let Some(line) = Subpath::closed(&points) else { return Ok(None) };
        let arcs = |three: &[Point]| arcs(three[0], three[1], three[2]);
        let segments = match word {
            "CIRCULARSTRING" => points.windows(3).step_by(2).flat_map(arcs).collect(),
            _ => line.segments,
        };
        Ok(Some(Subpath { segments, closed: false, ..line }))
    }

    fn list(&mut self, mut entry: impl FnMut(&mut Self) -> Result<(), String>) -> Result<(), String> {
        self.expect('(')?;
        loop {
            entry(self)?;
            if !self.accept(',') {
                return self.expect(')');
            }
        }
    }

    /// Reads a point of two numbers. A third and fourth number (height and measure) are ignored.
    fn point(&mut self) -> Result<Point, String> {
        let p = Point::new(self.number()?, self.number()?) * self.scale;
        for _ in 0..2 {
            if self.number().is_err() {
                break;
            }
        }
        Ok(p)
    }

    fn number(&mut self) -> Result<f64, String> {
        self.rest = self.rest.trim_start();
        let end = self
            .rest
            .find(|c: char| !(c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '+')))
            .unwrap_or(self.rest.len());
        match self.rest[..end].parse::<f64>() {
            Ok(number) => {
                self.rest = &self.rest[end..];
                Ok(number)
            }
            Err(_) => Err(self.expected_error("a number")),
        }
    }

    fn word(&mut self) -> String {
        let word = self.peek_word();
        self.rest = &self.rest.trim_start()[word.len()..];
        word
    }

    fn peek_word(&self) -> String {
        let letters = self.rest.trim_start().chars();
        letters.take_while(char::is_ascii_alphabetic).map(|c| c.to_ascii_uppercase()).collect()
    }

    fn accept(&mut self, mark: char) -> bool {
        match self.rest.trim_start().strip_prefix(mark) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, mark: char) -> Result<(), String> {
        if self.accept(mark) { Ok(()) } else { Err(self.expected_error(&format!("`{mark}`"))) }
    }

    fn expected_error(&self, wanted: &str) -> String {
        let found: String = self.rest.trim_start().chars().take(20).collect();
        if found.is_empty() {
            format!("it ends where {wanted} should be")
        } else {
            format!("there is `{found}` where {wanted} should be")
        }
    }
}

/// Returns the two arcs of the circle through three points; one circle, if the first point is also the last.
fn arcs(from: Point, middle: Point, to: Point) -> [Segment; 2] {
    let chord = to - from;
    // The angle of an arc is twice the angle that its chord makes with the whole chord at the other end (Euclid III.20).
    // The bulge of an arc is the tangent of a quarter of its angle.
    let bulge = |a: Vector, b: Vector| libm::tan(libm::atan2(cross(a, b), a.dot(&b)) / 2.0);
    let [first, second] = if from == to { [1.0; 2] } else { [bulge(chord, to - middle), bulge(middle - from, chord)] };
    [Segment::bulged(from, middle, first), Segment::bulged(middle, to, second)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_line_is_a_geometry_with_an_optional_name() {
        let text = "# a comment\nground; POLYGON((0 0, 4 0, 4 -1, 0 0))\n\
            a\tMULTIPOLYGON (((0 0,1 0,0 1,0 0)), ((5 0,6 0,5 1),(5.1 0.1,5.2 0.1,5.1 0.2)))\n\
            SRID=25832;polygon z ((0 0 1, 1e0 0 1, 0 +1 1))\n\
            robot-1; POINT (0.2 0.3)\n\nGEOMETRYCOLLECTION(POLYGONZ((0 0 1,1 0 1,0 1 1)),POLYGON EMPTY)\n\
            guide; POLYGON((0 0,1 0,0 1))\nb; LINESTRING (0 0, 1 1)\nPOLYGON ((0 0, 1 x))\nPOLYGON EMPTY\nPOLYGON((0 0,1 0,0 1)) x\n(";
        let draft = read(text, 1.0, true, &Naming::default()).expect("readable");
        let parts: Vec<(&str, Role)> = draft.parts.iter().map(|p| (p.name.as_str(), p.kind)).collect();
        assert_eq!(
            parts,
            [
                ("ground", Role::Ground),
                ("a", Role::Block),
                ("a", Role::Block),
                ("", Role::Block),
                ("robot-1", Role::Robot),
                ("", Role::Block),
                // A line, which may be part of an outline.
                ("b", Role::Block)
            ]
        );
        assert!(matches!(&draft.parts[2].form, PartGeometry::Subpaths(subpaths, _) if subpaths.len() == 2));
        assert!(matches!(draft.parts[4].form, PartGeometry::Point(p) if p == Point::new(0.2, 0.3)));
        let remarks: Vec<&str> = draft.remarks.iter().map(|r| r.message.as_str()).collect();
        assert_eq!(
            remarks,
            [
                "it is empty; left out",
                "there is `x))` where a number should be; left out",
                "it is empty; left out",
                "there is `x` where the end of the line should be; left out",
                "there is `(` where a geometry such as POLYGON should be; left out"
            ]
        );
        assert_eq!(draft.skipped.len(), 1);
    }

    #[test]
    fn a_table_has_a_column_of_well_known_text() {
        let text =
            "WKT,id,name\n\"POLYGON ((-1 -0.3,4 -0.3,4 0,-1 0))\",0,ground\n\"POLYGON ((0 0,1 0,1 0.5,0 0.5))\",1,a\n";
        assert!(is_table(text) && !is_table("a; POLYGON((0 0,1 0,0 1))"));
        let draft = read(text, 1.0, true, &Naming::default()).expect("readable");
        let parts: Vec<(&str, Role)> = draft.parts.iter().map(|p| (p.name.as_str(), p.kind)).collect();
        assert_eq!(parts, [("ground", Role::Ground), ("a", Role::Block)]);
        assert_eq!(draft.remarks, []);
    }
}
