//! What is told of numbers that vary: sentences, JSON, CSV, and the pictures of one number ([`curve`]) and of two ([`map`]).

mod chart;

use serde_json::{Value, json};

pub(crate) use chart::{curve, map};

use crate::mechanics::vary::{Interval, Map, Range, Sample, State, ValueGrid, intervals};
use crate::pictures::chart::round_step;
use crate::products::wording::number::digits;
use crate::text::capitalised;

/// What is examined: how the numbers vary, and what is asked of each scene.
#[derive(Clone, Debug)]
pub(crate) struct Question {
    /// The scene, such as `arch.json`.
    pub name: String,
    /// What is asked of the result, such as `load_factor>=2`; `None` if the structure must stand.
    pub goal: Option<String>,
    /// The number of the result that a curve shows.
    pub ordinate: Option<String>,
    /// The values of the scene as it is given; `None` for a value that does not stand in the file.
    pub given: Vec<Option<f64>>,
    /// Whether theory says that a single interval holds.
    pub is_interval: bool,
    /// The symbols of the units of length and of force in the scene file.
    pub units: [String; 2],
}

impl Question {
    /// Returns the word of a state, such as `stands`.
    pub(crate) fn word(&self, state: State) -> &'static str {
        match (state, &self.goal) {
            (State::Holds, None) => "stands",
            (State::Fails, None) => "falls",
            (State::Holds, Some(_)) => "reached",
            (State::Fails, Some(_)) => "not reached",
            (State::Undecided, _) => "undecided",
            (State::NoScene, _) => "no scene",
        }
    }

    /// Says what is proved between the samples.
    fn proof(&self, samples: &[Sample]) -> String {
        let count = samples.len();
        if self.is_interval && samples.iter().any(|sample| sample.found.state == State::Holds) {
            "proved between these values too: the loads or the friction limits are linear in this number".into()
        } else {
            format!("found on {count} values; between two equal results nothing is proved")
        }
    }

    /// Writes the intervals of one number, one in each line.
    pub(crate) fn lines(&self, range: &Range, samples: &[Sample]) -> Vec<String> {
        let head = format!("{}: {} from {} to {}", self.name, range.name, digits(range.from), digits(range.to));
        let head = self.goal.as_ref().map_or(head.clone(), |goal| format!("{head}, {goal}"));
        let rows = intervals(samples).into_iter().map(|interval| {
            let words = if interval.words.is_empty() { String::new() } else { format!("  ({})", interval.words) };
            format!("  {:<11} {}{words}", self.word(interval.state), values(&interval))
        });
        [head].into_iter().chain(rows).chain([format!("  {}", self.proof(samples))]).collect()
    }

    /// Returns the intervals of one number as a title and a paragraph, for a report.
    pub(crate) fn paragraph(&self, range: &Range, samples: &[Sample]) -> [String; 2] {
        let goal = self.goal.as_ref().map_or(String::new(), |goal| format!(", {goal}"));
        let parts = intervals(samples).into_iter().map(|interval| {
            let words = if interval.words.is_empty() { String::new() } else { format!(" ({})", interval.words) };
            format!("{} {}{words}", self.word(interval.state), values(&interval))
        });
        let said = parts.collect::<Vec<_>>().join("; ");
        let title = format!("{} from {} to {}{goal}", range.name, digits(range.from), digits(range.to));
        [title, format!("{}. {}.", capitalised(&said), capitalised(&self.proof(samples)))]
    }

    /// Returns what a map shows as a title and a paragraph, for a report.
    pub(crate) fn map_paragraph(&self, map: &Map) -> [String; 2] {
        let lines = self.map_lines(map);
        let title = lines[0].strip_prefix(&format!("{}: ", self.name)).unwrap_or(&lines[0]).to_owned();
        let goal = self.goal.as_ref().map_or(String::new(), |goal| format!(", {goal}"));
        [
            title + &goal,
            lines[1..].iter().map(|line| format!("{}.", capitalised(line.trim()))).collect::<Vec<_>>().join(" "),
        ]
    }

    /// Says how many of the pairs of a map hold.
    pub(crate) fn map_lines(&self, map: &Map) -> Vec<String> {
        let [x, y] = &map.ranges;
        let range = |range: &Range| format!("{} from {} to {}", range.name, digits(range.from), digits(range.to));
        let count = |state: State| map.samples.iter().filter(|sample| sample.found.state == state).count();
        let counts = State::ALL.into_iter().filter(|state| count(*state) > 0);
        let counts: Vec<String> = counts.map(|state| format!("{} {}", count(state), self.word(state))).collect();
        vec![
            format!("{}: {}, {}", self.name, range(x), range(y)),
            format!("  {} pairs: {}", map.samples.len(), counts.join(", ")),
            "  each point of the border lies between two of them; between equal pairs nothing is proved".into(),
        ]
    }

    fn head(&self, ranges: &[Range]) -> Value {
        let ranges = ranges
            .iter()
            .zip(&self.given)
            .map(|(range, given)| json!({ "name": range.name, "from": range.from, "to": range.to, "given": given }));
        json!({ "ranges": ranges.collect::<Vec<_>>(), "goal": self.goal, "value": self.ordinate })
    }

    /// Writes the intervals and all samples of one number as JSON.
    pub(crate) fn json(&self, range: &Range, samples: &[Sample]) -> Value {
        let mut text = self.head(std::slice::from_ref(range));
        let list = intervals(samples).into_iter().map(|interval| {
            json!({ "state": interval.state.word(), "from": interval.from, "to": interval.to, "words": interval.words })
        });
        text["is_interval"] = json!(self.is_interval);
        text["intervals"] = json!(list.collect::<Vec<_>>());
        text["samples"] = entries(samples);
        text
    }

    /// Writes the outlines of the region that holds, all samples, and the lines of equal values as JSON.
    pub(crate) fn map_json(&self, map: &Map, field: Option<&ValueGrid>) -> Value {
        let mut text = self.head(&map.ranges);
        let rings = map.region(State::Holds).into_iter();
        let rings = rings.map(|ring| ring.into_iter().map(|(pair, _)| pair).collect::<Vec<_>>());
        text["region"] = json!(rings.collect::<Vec<_>>());
        text["samples"] = entries(&map.samples);
        if let Some(field) = field {
            let line = |level: &f64| json!({ "value": level, "lines": field.lines(*level) });
            text["isolines"] = json!(levels(field).iter().map(line).collect::<Vec<_>>());
        }
        text
    }
}

/// A map has about this many isolines: lines along which a number of the result has the same value.
const ISOLINE_COUNT: f64 = 9.0;

/// Returns the values of the isolines: round numbers at equal distances between the least and the largest value on the map.
pub(crate) fn levels(field: &ValueGrid) -> Vec<f64> {
    let Some((low, high)) = field.extent().filter(|(low, high)| high > low) else { return Vec::new() };
    let step = round_step((high - low) / ISOLINE_COUNT);
    let (first, last) = (libm::ceil(low / step) as i64, libm::floor(high / step) as i64);
    (first..=last).map(|number| number as f64 * step).collect()
}

/// Writes samples as CSV: a column for each number, the result, and the number of the result.
pub(crate) fn csv(question: &Question, ranges: &[Range], samples: &[Sample]) -> String {
    let quoted = |text: &str| match text.contains([',', '"', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    };
    let names = ranges.iter().map(|range| quoted(&range.name));
    let value = question.ordinate.iter().map(|name| quoted(name));
    let mut rows = vec![names.chain(["state".to_owned()]).chain(value).collect::<Vec<_>>().join(",")];
    for sample in samples {
        let numbers = sample.at.iter().map(f64::to_string);
        let value =
            sample.found.value.filter(|value| value.is_finite()).map_or(String::new(), |value| value.to_string());
        let value = question.ordinate.iter().map(|_| value.clone());
        rows.push(numbers.chain([sample.found.state.word().to_owned()]).chain(value).collect::<Vec<_>>().join(","));
    }
    rows.join("\n") + "\n"
}

fn entries(samples: &[Sample]) -> Value {
    let entry = |sample: &Sample| {
        let value = sample.found.value.filter(|value| value.is_finite());
        json!({ "at": sample.at, "state": sample.found.state.word(), "value": value })
    };
    json!(samples.iter().map(entry).collect::<Vec<_>>())
}

/// Writes the two ends of an interval.
fn values(interval: &Interval) -> String {
    let (from, to) = (short(interval.from), short(interval.to));
    if interval.from == interval.to { format!("at {from}") } else { format!("{from} to {to}") }
}

/// Writes a value with all its digits: the values at ends are short decimals.
fn short(value: f64) -> String {
    let text = format!("{value}");
    if text.len() > 9 { digits(value) } else { text.replace('-', "−") }
}

/// Returns the title of an axis: the name of a number and its unit. `units` has the symbols of the units of length and of
/// force.
pub(crate) fn axis_title(name: &str, units: &[String; 2]) -> String {
    let [length, force] = units;
    match name {
        "friction" => "friction coefficient".into(),
        "kernel" => "safety kernel".into(),
        "tilt" => "tilt, degrees".into(),
        "angle" => "angle, degrees".into(),
        "load_factor" => "load factor".into(),
        "horizontal_load" => "horizontal load, share of the weight".into(),
        "thickness" | "span" | "width" | "height" | "length" | "lean" | "jamb" | "lintel" | "side" => {
            format!("{name}, {length}")
        }
        "placement" => "placement error, m".into(),
        // A path, such as `blocks.pier.weight`: its last key has the unit.
        path if path.contains(['.', '[']) => {
            let key = path.trim_end_matches(|c: char| c == '[' || c == ']' || c.is_ascii_digit());
            match key.rsplit('.').next().unwrap_or(key) {
                "weight" | "force" => format!("{path}, {force}"),
                "torque" => format!("{path}, {force} {length}"),
                "at" | "polygon" | "centre" | "radius" | "grip" => format!("{path}, {length}"),
                "mass" => format!("{path}, kg"),
                _ => path.to_owned(),
            }
        }
        "total_force" | "total_sticking" | "weight" => format!("{}, N", name.replace('_', " ")),
        other => other.replace('_', " "),
    }
}
