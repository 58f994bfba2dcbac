//! Finds for which values of one or two numbers something holds, such as that a structure stands: [`scan`] finds the ends of
//! the intervals of one number, [`Map`] the border in the plane of two.
//!
//! Nothing is assumed of the set of values but that samples show it. What lies between two equal samples is not proved;
//! each end, and each point of a border, lies between two samples that differ.

use std::collections::BTreeMap;

#[cfg(feature = "parallel")]
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

/// What was found at one value, or at one pair of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// The structure stands, or the number that is asked for is reached.
    Holds,
    /// It falls, or the number is not reached.
    Fails,
    /// Neither is proved.
    Undecided,
    /// The values give no valid scene.
    NoScene,
}

impl State {
    /// All states.
    pub const ALL: [State; 4] = [State::Holds, State::Fails, State::Undecided, State::NoScene];

    /// Returns the word of this state in JSON and CSV.
    pub fn word(self) -> &'static str {
        match self {
            State::Holds => "holds",
            State::Fails => "fails",
            State::Undecided => "undecided",
            State::NoScene => "no_scene",
        }
    }
}

/// The result at one value, or at one pair of values.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// What was found.
    pub state: State,
    /// The number of the result that is asked for; infinite if it has no limit.
    pub value: Option<f64>,
    /// In words: how the structure falls, or why there is no scene; may be empty.
    pub words: String,
}

/// A number that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The name of the number.
    pub name: String,
    /// The least value.
    pub from: f64,
    /// The largest value, more than `from`.
    pub to: f64,
    /// Whether the number is a whole number.
    pub is_whole: bool,
}

/// A result with its values, one for each number that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The values.
    pub at: Vec<f64>,
    /// The result.
    pub found: Found,
}

/// Values of one number in a row with the same result.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// What was found at these values.
    pub state: State,
    /// The least value that was examined.
    pub from: f64,
    /// The largest value that was examined.
    pub to: f64,
    /// The words of the sample at the end that touches another interval.
    pub words: String,
}

/// Finds the results at the values, in their order. `of` is called on all cores.
fn all(places: Vec<Vec<f64>>, of: &(impl Fn(&[f64]) -> Found + Sync)) -> Vec<Sample> {
    let one = |at: Vec<f64>| Sample { found: of(&at), at };
    #[cfg(feature = "parallel")]
    return places.into_par_iter().map(one).collect();
    #[cfg(not(feature = "parallel"))]
    places.into_iter().map(one).collect()
}

impl Range {
    fn steps(&self) -> usize {
        (self.to - self.from) as usize
    }

    /// True if each value has a column of its own in a map.
    fn has_columns(&self) -> bool {
        self.is_whole && self.steps() < MAX_COLUMNS
    }

    /// Returns the least and the largest value on the axis of a map. For whole numbers the axis is half a step longer at each
    /// end.
    pub fn shown(&self) -> (f64, f64) {
        let beyond = if self.has_columns() { 0.5 } else { 0.0 };
        (self.from - beyond, self.to + beyond)
    }

    /// Returns `count` values at equal distances, or all whole numbers if there are fewer.
    fn values(&self, count: usize) -> Vec<f64> {
        let steps = count.max(2) - 1;
        let (from, span) = (self.from, self.to - self.from);
        let mut values: Vec<f64> = (0..=steps).map(|step| from + span * step as f64 / steps as f64).collect();
        values[steps] = self.to;
        if self.is_whole {
            values.iter_mut().for_each(|value| *value = value.round());
            values.dedup();
        }
        values
    }

    /// Returns a short decimal number about half-way between two values, with the wanted number of significant digits;
    /// `None` if none lies between.
    fn between(&self, low: f64, high: f64, digits: u32) -> Option<f64> {
        let tens = |size: f64| libm::floor(libm::log10(size)) as i32;
        let least = tens(self.to - self.from) - digits as i32 - 1;
        let place = if self.is_whole { 0 } else { (tens(low.abs().max(high.abs())) + 1 - digits as i32).max(least) };
        let unit = libm::exp10(f64::from(place));
        // A value that is a multiple of the unit may be a little off as a double.
        let (first, last) = (libm::floor(low / unit + 1e-6) + 1.0, libm::ceil(high / unit - 1e-6) - 1.0);
        let value = libm::floor((first + last) / 2.0) * unit;
        // Written and read again, the number has no digits of the product.
        let value: f64 = format!("{value:.*}", usize::try_from(-place).unwrap_or(0)).parse().ok()?;
        (first <= last && low < value && value < high).then_some(value)
    }
}

/// Examines `count` values of a range, and then halves the distance between neighbours that differ until they differ by one
/// unit of the last of `digits` significant digits. Returns all samples, the least value first.
pub fn scan(range: &Range, count: usize, digits: u32, of: impl Fn(&[f64]) -> Found + Sync) -> Vec<Sample> {
    let mut samples = all(range.values(count).into_iter().map(|value| vec![value]).collect(), &of);
    // Each round halves the distances. Ten digits need some forty rounds.
    for _ in 0..200 {
        let pairs = samples.windows(2).filter(|pair| pair[0].found.state != pair[1].found.state);
        let next: Vec<f64> = pairs.filter_map(|pair| range.between(pair[0].at[0], pair[1].at[0], digits)).collect();
        if next.is_empty() {
            break;
        }
        samples.extend(all(next.into_iter().map(|value| vec![value]).collect(), &of));
        samples.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    }
    samples
}

/// Joins neighbours with the same result.
pub fn intervals(samples: &[Sample]) -> Vec<Interval> {
    let mut intervals: Vec<Interval> = Vec::new();
    for run in samples.chunk_by(|a, b| a.found.state == b.found.state) {
        let [first, last] = [&run[0], &run[run.len() - 1]];
        // The words at the lower end, unless this is the first interval.
        let end = if intervals.is_empty() { last } else { first };
        intervals.push(Interval {
            state: first.found.state,
            from: first.at[0],
            to: last.at[0],
            words: end.found.words.clone(),
        });
    }
    intervals
}

/// A vertex of the grid of a map: its column and its row, from 0.
type Vertex = [usize; 2];

/// An edge of the grid: the column and the row of its first vertex, and its direction: 0 to the next column, 1 to the next
/// row. Columns and rows −1 and one beyond the last are outside of the map.
type Edge = (isize, isize, usize);

/// Which pairs of two numbers hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The two numbers.
    pub ranges: [Range; 2],
    /// The number of cells of the grid along each range.
    pub cells: [usize; 2],
    /// All pairs that were examined.
    pub samples: Vec<Sample>,
    /// The state of each vertex, by columns; inferred inside cells whose corners agree.
    states: Vec<State>,
    /// Where the state changes on an edge: the share of its length.
    changes: BTreeMap<(Vertex, usize), f64>,
}

/// A part of the grid: its first vertex, and its size in cells.
#[derive(Clone, Copy)]
struct Block {
    at: Vertex,
    size: [usize; 2],
}

impl Block {
    fn corners(self) -> [Vertex; 4] {
        let ([x, y], [w, h]) = (self.at, self.size);
        [[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
    }

    fn parts(self) -> Vec<Block> {
        let halves = |at: usize, size: usize| match size {
            1 => vec![(at, 1)],
            _ => vec![(at, size / 2), (at + size / 2, size - size / 2)],
        };
        let rows = halves(self.at[1], self.size[1]);
        let across = halves(self.at[0], self.size[0]).into_iter();
        across.flat_map(|(x, w)| rows.iter().map(move |(y, h)| Block { at: [x, *y], size: [w, *h] })).collect()
    }

    fn vertices(self) -> impl Iterator<Item = Vertex> {
        let ([x, y], [w, h]) = (self.at, self.size);
        (x..=x + w).flat_map(move |column| (y..=y + h).map(move |row| [column, row]))
    }

    /// True if the vertex lies on the outline.
    fn has_on_edge(self, [column, row]: Vertex) -> bool {
        let ([x, y], [w, h]) = (self.at, self.size);
        column == x || column == x + w || row == y || row == y + h
    }
}

/// The number of cells of a map along a range, and of each of the blocks that it begins with.
const CELLS: usize = 64;
const FIRST: usize = 4;
/// A range of at most this many whole numbers has a column of the map for each.
const MAX_COLUMNS: usize = 32;
/// How often the distance of two vertices that differ is halved.
const HALVINGS: usize = 6;

impl Map {
    /// Examines a coarse grid of pairs, then finer grids along the border only, and then finds the border on the edges of the
    /// finest grid, to a four-thousandth of each range. `of` also has whether words are wanted: those of the coarse grid name the
    /// regions.
    pub fn new(ranges: [Range; 2], of: impl Fn(&[f64], bool) -> Found + Sync) -> Map {
        // A whole number has a column with the number in its middle, so two vertices.
        let cells = ranges.each_ref().map(|range| if range.has_columns() { 2 * range.steps() + 1 } else { CELLS });
        let count = (cells[0] + 1) * (cells[1] + 1);
        let mut map =
            Map { ranges, cells, samples: Vec::new(), states: vec![State::Undecided; count], changes: BTreeMap::new() };
        let mut known: BTreeMap<Vertex, State> = BTreeMap::new();
        let first = map.ranges.each_ref().map(|range| if range.has_columns() { 1 } else { FIRST });
        let starts = |axis: usize| (0..cells[axis]).step_by(first[axis]);
        let mut blocks: Vec<Block> =
            starts(0).flat_map(|x| starts(1).map(move |y| Block { at: [x, y], size: first })).collect();
        let mut settled: Vec<Block> = Vec::new();
        while !blocks.is_empty() {
            let mut missing: Vec<Vertex> =
                blocks.iter().flat_map(|block| block.corners()).filter(|vertex| !known.contains_key(vertex)).collect();
            missing.sort_unstable();
            missing.dedup();
            let is_coarse = known.is_empty();
            let found = all(missing.iter().map(|vertex| map.place(*vertex)).collect(), &|at| of(at, is_coarse));
            known.extend(missing.iter().zip(&found).map(|(vertex, sample)| (*vertex, sample.found.state)));
            map.samples.extend(found);
            // A block whose corners agree is settled, until a finer neighbour finds another state on its outline.
            settled.append(&mut blocks);
            let mixed = |block: &Block| {
                let own = known[&block.at];
                let seen = block.vertices().filter(|vertex| block.has_on_edge(*vertex));
                seen.filter_map(|vertex| known.get(&vertex)).any(|state| *state != own)
            };
            let (open, closed): (Vec<Block>, Vec<Block>) =
                settled.into_iter().partition(|block| block.size != [1, 1] && mixed(block));
            settled = closed;
            blocks = open.into_iter().flat_map(Block::parts).collect();
        }
        for block in &settled {
            let state = known[&block.at];
            for vertex in block.vertices() {
                let index = map.index(vertex);
                map.states[index] = state;
            }
        }
        for (vertex, state) in known {
            let index = map.index(vertex);
            map.states[index] = state;
        }
        map.find_changes(&|at| of(at, false));
        map
    }

    /// Halves each edge whose ends differ, some times.
    fn find_changes(&mut self, of: &(impl Fn(&[f64]) -> Found + Sync)) {
        let mut open: Vec<(Vertex, usize, State, [f64; 2])> = Vec::new();
        for column in 0..=self.cells[0] {
            for row in 0..=self.cells[1] {
                for axis in [0, 1] {
                    let vertex = [column, row];
                    if vertex[axis] < self.cells[axis] && self.state(vertex) != self.state(step(vertex, axis)) {
                        open.push((vertex, axis, self.state(vertex), [0.0, 1.0]));
                    }
                }
            }
        }
        for _ in 0..HALVINGS {
            let middle = |(vertex, axis, _, [low, high]): &(Vertex, usize, State, [f64; 2])| {
                let (from, to) = (self.place(*vertex), self.place(step(*vertex, *axis)));
                let share = 0.5 * (low + high);
                (0..2).map(|i| from[i] + share * (to[i] - from[i])).collect::<Vec<f64>>()
            };
            let halved = |edge: &&mut (Vertex, usize, State, [f64; 2])| !self.ranges[edge.1].is_whole;
            let places = open.iter_mut().filter(halved).map(|edge| middle(edge)).collect();
            let found = all(places, of);
            for (edge, sample) in open.iter_mut().filter(halved).zip(&found) {
                let share = 0.5 * (edge.3[0] + edge.3[1]);
                edge.3[usize::from(sample.found.state != edge.2)] = share;
            }
            self.samples.extend(found);
        }
        self.changes = open.into_iter().map(|(at, axis, _, [low, high])| ((at, axis), 0.5 * (low + high))).collect();
    }

    fn index(&self, [column, row]: Vertex) -> usize {
        column * (self.cells[1] + 1) + row
    }

    /// Returns the state of a vertex, given by its column and its row.
    pub fn state(&self, vertex: [usize; 2]) -> State {
        self.states[self.index(vertex)]
    }

    /// Returns the pair of values of a vertex.
    fn place(&self, vertex: Vertex) -> Vec<f64> {
        let value = |axis: usize| {
            let range = &self.ranges[axis];
            if range.has_columns() {
                return range.from + (vertex[axis] / 2) as f64;
            }
            let value = range.from + (range.to - range.from) * vertex[axis] as f64 / self.cells[axis] as f64;
            if range.is_whole { value.round() } else { value }
        };
        vec![value(0), value(1)]
    }

    /// Returns where a vertex is drawn: the outer vertices of a column half a step beside its number.
    fn drawn(&self, vertex: Vertex) -> [f64; 2] {
        let values = self.place(vertex);
        [0, 1].map(|axis| match self.ranges[axis].has_columns() {
            true => values[axis] + (vertex[axis] % 2) as f64 - 0.5,
            false => values[axis],
        })
    }

    /// Returns the outlines of the region in one state, as rings of pairs with the region on their left, and for each pair
    /// whether the line that leads on from it follows the border of the ranges.
    pub fn region(&self, state: State) -> Vec<Vec<([f64; 2], bool)>> {
        let [w, h] = self.cells.map(|count| count as isize);
        let inside = |x: isize, y: isize| {
            (0..=w).contains(&x) && (0..=h).contains(&y) && self.state([x as usize, y as usize]) == state
        };
        // Marching squares, with a ring of cells around the range. Each crossed edge begins one line and ends another.
        let mut next: BTreeMap<Edge, (Edge, bool)> = BTreeMap::new();
        for x in -1..=w {
            for y in -1..=h {
                let corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
                let edges: [Edge; 4] = [(x, y, 0), (x + 1, y, 1), (x, y + 1, 0), (x, y, 1)];
                let is_outer = x < 0 || y < 0 || x == w || y == h;
                let is_in = corners.map(|(x, y)| inside(x, y));
                // Anticlockwise, the region is left on edge k if its first corner is inside and its second is not. The line
                // leads back to the edge on which the region was entered.
                for leaves in (0..4).filter(|k| is_in[*k] && !is_in[(k + 1) % 4]) {
                    let entered = (1..4).map(|back| (leaves + 4 - back) % 4).find(|k| !is_in[*k] && is_in[(k + 1) % 4]);
                    if let Some(entered) = entered {
                        next.insert(edges[leaves], (edges[entered], is_outer));
                    }
                }
            }
        }
        let mut rings = Vec::new();
        while let Some((start, _)) = next.first_key_value().map(|(edge, to)| (*edge, *to)) {
            let mut ring = Vec::new();
            let mut at = start;
            while let Some((to, is_outer)) = next.remove(&at) {
                ring.push((self.crossing(at), is_outer));
                at = to;
            }
            rings.push(ring);
        }
        rings
    }

    /// Returns the pair of values where a state changes on an edge of the grid, or on one outside of it.
    fn crossing(&self, (x, y, axis): Edge) -> [f64; 2] {
        let limit = |i: isize, axis: usize| i.clamp(0, self.cells[axis] as isize) as usize;
        let from = [limit(x, 0), limit(y, 1)];
        let to = [limit(x + isize::from(axis == 0), 0), limit(y + isize::from(axis == 1), 1)];
        let share = self.changes.get(&(from, axis)).filter(|_| from != to).copied().unwrap_or(0.5);
        let (from, to) = (self.drawn(from), self.drawn(to));
        [0, 1].map(|i| from[i] + share * (to[i] - from[i]))
    }
}

/// The values of a number of the result on a regular grid over a [`Map`], at the pairs that hold.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueGrid {
    /// The values of the columns and of the rows.
    places: [Vec<f64>; 2],
    /// The number at each pair, by columns; infinite without a limit, `None` outside of the region.
    values: Vec<Option<f64>>,
}

/// The number of cells of a [`ValueGrid`] along each range.
const GRID_CELLS: usize = 32;

impl ValueGrid {
    /// Examines each pair of the grid that holds on the map. `of` returns the number.
    pub fn new(map: &Map, of: impl Fn(&[f64]) -> Found + Sync) -> ValueGrid {
        let places = map.ranges.each_ref().map(|range| range.values(GRID_CELLS + 1));
        let vertex = |axis: usize, value: f64| {
            let range = &map.ranges[axis];
            let share = (value - range.from) / (range.to - range.from);
            if range.has_columns() {
                2 * (value - range.from) as usize
            } else {
                (share * CELLS as f64).round() as usize
            }
        };
        let pairs: Vec<[f64; 2]> = places[0].iter().flat_map(|x| places[1].iter().map(|y| [*x, *y])).collect();
        let holds = |[x, y]: [f64; 2]| map.state([vertex(0, x), vertex(1, y)]) == State::Holds;
        let inside: Vec<Vec<f64>> = pairs.iter().filter(|pair| holds(**pair)).map(|pair| pair.to_vec()).collect();
        let mut found = all(inside, &of).into_iter();
        let values = pairs.iter().map(|pair| holds(*pair).then(|| found.next()?.found.value).flatten()).collect();
        ValueGrid { places, values }
    }

    /// Returns the least and the largest value that is not infinite. `None` if there is no such value.
    pub fn extent(&self) -> Option<(f64, f64)> {
        let limited = self.values.iter().flatten().filter(|value| value.is_finite());
        limited.map(|value| (*value, *value)).reduce(|(low, high), (a, b)| (low.min(a), high.max(b)))
    }

    /// Returns the isolines of a value: each is a list of pairs in its order. Between two neighbours on the grid, the number
    /// counts as linear. A cell with a corner that does not hold has no isoline.
    pub fn lines(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        let height = self.places[1].len();
        let at = |[x, y]: Vertex| Some((self.values[x * height + y]?, [self.places[0][x], self.places[1][y]]));
        let mut pieces: Vec<[[f64; 2]; 2]> = Vec::new();
        for x in 0..self.places[0].len() - 1 {
            for y in 0..height - 1 {
                let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(at);
                let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
                let edges = [[a, b], [b, c], [d, c], [a, d]];
                let mut crossed = edges.into_iter().filter_map(|[(u, from), (v, to)]| {
                    let share = (level - u) / (v - u);
                    let crosses = (u < level) != (v < level) && share.is_finite();
                    crosses.then(|| [0, 1].map(|i| from[i] + share * (to[i] - from[i])))
                });
                while let (Some(from), Some(to)) = (crossed.next(), crossed.next()) {
                    pieces.push([from, to]);
                }
            }
        }
        // Join pieces that have an end in common. Two neighbouring cells compute exactly the same point on their common edge.
        let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
        while let Some([from, to]) = pieces.pop() {
            let mut run = std::collections::VecDeque::from([from, to]);
            loop {
                let ends = [run[0], run[run.len() - 1]];
                let touches = |piece: &[[f64; 2]; 2]| piece.iter().any(|point| ends.contains(point));
                let Some(next) = pieces.iter().position(touches) else { break };
                let [a, b] = pieces.swap_remove(next);
                match (ends[1] == a, ends[1] == b, ends[0] == a) {
                    (true, ..) => run.push_back(b),
                    (_, true, _) => run.push_back(a),
                    (_, _, true) => run.push_front(b),
                    _ => run.push_front(a),
                }
            }
            runs.push(run.into());
        }
        runs
    }
}

/// Returns the next vertex along an axis.
fn step(mut vertex: Vertex, axis: usize) -> Vertex {
    vertex[axis] += 1;
    vertex
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(holds: bool) -> Found {
        let state = if holds { State::Holds } else { State::Fails };
        Found { state, value: None, words: String::new() }
    }

    fn range(from: f64, to: f64) -> Range {
        Range { name: "x".into(), from, to, is_whole: false }
    }

    #[test]
    fn ends_are_short_decimals_that_differ_by_one_unit_of_the_last_digit() {
        let samples = scan(&range(0.0, 4.0), 9, 4, |at| found(at[0] < 0.612_345 || at[0] > 3.333_333));
        let found = intervals(&samples);
        let ends: Vec<[f64; 2]> = found.iter().map(|interval| [interval.from, interval.to]).collect();
        assert_eq!(ends, [[0.0, 0.6123], [0.6124, 3.333], [3.334, 4.0]]);
        // An end at 0 is found to a hundred-thousandth of the range and no further.
        let samples = scan(&range(0.0, 1.0), 9, 4, |at| super::tests::found(at[0] > 0.0));
        assert!(samples.len() < 40 && samples[1].at[0] <= 1e-5, "{}: {:?}", samples.len(), samples[1].at);
    }

    #[test]
    fn whole_numbers_stay_whole() {
        let blocks = Range { is_whole: true, ..range(2.0, 900.0) };
        let samples = scan(&blocks, 9, 4, |at| found(at[0] <= 317.0));
        assert_eq!(intervals(&samples)[0].to, 317.0);
        assert!(samples.iter().all(|sample| sample.at[0].fract() == 0.0));
    }

    #[test]
    fn lines_of_equal_values_of_a_linear_number_are_straight() {
        let map = Map::new([range(0.0, 2.0), range(0.0, 1.0)], |at, _| found(at[1] < 0.9));
        let field = ValueGrid::new(&map, |at| Found { value: Some(3.0 * at[0] + at[1]), ..found(true) });
        let lines = field.lines(2.2);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].len() > 20 && lines[0].iter().all(|[x, y]| (3.0 * x + y - 2.2).abs() < 1e-9), "{lines:?}");
        assert!(field.lines(9.0).is_empty());
        let (low, high) = field.extent().expect("values");
        assert!(low == 0.0 && (6.8..6.9).contains(&high), "{high}");
    }

    #[test]
    fn a_map_has_the_area_of_its_region_and_costs_by_the_length_of_its_border() {
        let disc = |at: &[f64], _| found(libm::hypot(at[0] - 1.0, at[1] - 1.0) < 0.6);
        let map = Map::new([range(0.0, 2.0), range(0.0, 2.0)], disc);
        let area = |ring: &[([f64; 2], bool)]| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|((a, _), (b, _))| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum::<f64>()
        };
        let of = |state| map.region(state).iter().map(|ring| area(ring)).sum::<f64>();
        let wanted = std::f64::consts::PI * 0.36;
        assert!((of(State::Holds) - wanted).abs() < 2e-3, "{}", of(State::Holds));
        // The hole is cut out of the rest.
        assert!((of(State::Fails) - (4.0 - wanted)).abs() < 2e-3, "{}", of(State::Fails));
        assert_eq!(map.region(State::Fails).len(), 2);
        assert!(map.samples.len() < 2000, "{}", map.samples.len());
    }
}
