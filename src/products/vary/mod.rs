//! What is told of numbers that vary: sentences, JSON, CSV, and the pictures of one number ([`curve`]) and of two ([`map`]).

mod chart;

use serde_json::{Value, json};

pub(crate) use chart::{curve, map};

use crate::mechanics::vary::{Interval, Map, Range, Sample, State, intervals};
use crate::products::wording::number::digits;

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
            let Interval { state, from, to, words } = interval;
            let values =
                if from == to { format!("at {}", short(from)) } else { format!("{} to {}", short(from), short(to)) };
            let words = if words.is_empty() { words } else { format!("  ({words})") };
            format!("  {:<11} {values}{words}", self.word(state))
        });
        [head].into_iter().chain(rows).chain([format!("  {}", self.proof(samples))]).collect()
    }

    /// Says how many of the pairs of a map hold.
    pub(crate) fn map_lines(&self, map: &Map) -> Vec<String> {
        let [x, y] = &map.ranges;
        let range = |range: &Range| format!("{} from {} to {}", range.name, digits(range.from), digits(range.to));
        let count = |state: State| map.samples.iter().filter(|sample| sample.found.state == state).count();
        let states = [State::Holds, State::Fails, State::Undecided, State::NoScene];
        let counts = states.into_iter().filter(|state| count(*state) > 0);
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
            json!({ "state": state_key(interval.state), "from": interval.from, "to": interval.to, "words": interval.words })
        });
        text["is_interval"] = json!(self.is_interval);
        text["intervals"] = json!(list.collect::<Vec<_>>());
        text["samples"] = entries(samples);
        text
    }

    /// Writes the outlines of the region that holds, and all samples, as JSON.
    pub(crate) fn map_json(&self, map: &Map) -> Value {
        let mut text = self.head(&map.ranges);
        let rings = map.region(State::Holds).into_iter();
        let rings = rings.map(|ring| ring.into_iter().map(|(pair, _)| pair).collect::<Vec<_>>());
        text["region"] = json!(rings.collect::<Vec<_>>());
        text["samples"] = entries(&map.samples);
        text
    }
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
        rows.push(numbers.chain([state_key(sample.found.state).to_owned()]).chain(value).collect::<Vec<_>>().join(","));
    }
    rows.join("\n") + "\n"
}

fn entries(samples: &[Sample]) -> Value {
    let entry = |sample: &Sample| {
        let value = sample.found.value.filter(|value| value.is_finite());
        json!({ "at": sample.at, "state": state_key(sample.found.state), "value": value })
    };
    json!(samples.iter().map(entry).collect::<Vec<_>>())
}

/// Returns the word of a state in JSON and CSV.
fn state_key(state: State) -> &'static str {
    match state {
        State::Holds => "holds",
        State::Fails => "fails",
        State::Undecided => "undecided",
        State::NoScene => "no_scene",
    }
}

/// Writes a value with all its digits: the values at ends are short decimals.
fn short(value: f64) -> String {
    let text = format!("{value}");
    if text.len() > 9 { digits(value) } else { text.replace('-', "−") }
}

/// Returns the name of a number for an axis.
pub(crate) fn axis_name(name: &str) -> String {
    match name {
        "friction" => "friction coefficient".into(),
        "kernel" => "safety kernel".into(),
        "tilt" => "tilt, degrees".into(),
        "angle" => "angle, degrees".into(),
        "load_factor" => "load factor".into(),
        "horizontal_load" => "horizontal load, share of the weight".into(),
        "thickness" | "span" | "width" | "height" | "length" | "lean" | "jamb" | "lintel" | "side" => {
            format!("{name}, m")
        }
        "placement" => "placement error, m".into(),
        other => other.replace('_', " "),
    }
}
