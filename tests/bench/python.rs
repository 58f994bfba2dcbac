//! The time that the Python package adds to a step of a session and to a small check, compared with the same calls in
//! Rust.
//!
//! `PYTHON=.venv/bin/python cargo bench --bench python` needs an interpreter with the package, compiled with the same
//! optimisation. The measurements of Rust and Python alternate. The time of a round is the median of its calls, and
//! the table has the medians of the rounds, in microseconds.

#![allow(clippy::print_stdout, reason = "a benchmark reports on standard output")]

use std::hint::black_box;
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};
use std::time::Instant;

use drystone::scene::format::{BlockEntry, CellEntry, GridKind, GroundEntry, RobotEntry};
use drystone::session::Session;
use drystone::{Analysis, Scene};

/// The number of rounds, and the number of calls of each kind in a round.
const ROUNDS: usize = 21;
const CALLS: usize = 200;

fn main() {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".into());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bench/peers/package.py");
    let mut child = Command::new(python)
        .args([script, &CALLS.to_string()])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("PYTHON is an interpreter");
    let mut input = child.stdin.take().expect("piped");
    let mut answers = BufReader::new(child.stdout.take().expect("piped")).lines();
    let mut names: Vec<String> = Vec::new();
    let (mut rust, mut package): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        rust.push(round().iter().map(|row| row.1).collect());
        writeln!(input, "round").expect("the script reads");
        let mut times = Vec::new();
        for (name, _) in round() {
            let line = answers.next().expect("a line for each row").expect("text");
            let (python_name, micros) = line.rsplit_once('\t').expect("a name and a time");
            assert_eq!(python_name, name, "Rust and Python measure the same calls");
            times.push(micros.parse().expect("a number"));
            if names.len() < rust[0].len() {
                names.push(name.into());
            }
        }
        package.push(times);
    }
    drop(input);
    let _ = child.wait();
    println!("| call | Rust, µs | Python, µs | added, µs |");
    println!("|---|---|---|---|");
    for (number, name) in names.iter().enumerate() {
        let of = |rounds: &[Vec<f64>]| median(rounds.iter().map(|round| round[number]).collect());
        let (rust, python) = (of(&rust), of(&package));
        println!("| {name} | {rust:.1} | {python:.1} | {:.1} |", python - rust);
    }
}

/// Runs one round in Rust. Returns the name of each row and the median time of its calls, microseconds.
fn round() -> Vec<(&'static str, f64)> {
    let mut rows = Vec::new();
    let free = Scene::builder()
        .friction(0.6)
        .ground(FLOOR)
        .robot(RobotEntry::new("crane"))
        .block(brick("a", 0.0, 0.0))
        .block(brick("b", 3.0, 0.0));
    let squares = (-9..9).map(|x| CellEntry::Square(f64::from(x), -1.0));
    let lattice = Scene::builder()
        .friction(0.6)
        .grid(GridKind::Square, 1.0)
        .ground(GroundEntry::default().cells(squares.collect::<Vec<_>>()))
        .robot(RobotEntry::new("crane"))
        .block(cells("a", 0.0, 0.0))
        .block(cells("b", 3.0, 0.0));
    let mut session = Session::new(free).expect("sound");
    steps(&mut rows, "outlines", &mut session, || brick("c", 1.0, 1.0));
    let mut session = Session::new(lattice).expect("sound");
    steps(&mut rows, "cells", &mut session, || cells("c", 1.0, 1.0));

    let built = || {
        let scene = Scene::builder().friction(0.6).ground(FLOOR);
        scene.block(brick("a", 0.0, 0.0)).block(brick("b", 1.0, 1.0))
    };
    let file = built();
    let check = |file| Analysis::new(Scene::new(file).expect("sound"));
    let times = (0..CALLS).map(|_| timed(|| check(file.clone())));
    rows.push(("check a scene of two blocks", median(times.collect())));
    let times = (0..CALLS).map(|_| timed(|| check(built())));
    rows.push(("build it and check it", median(times.collect())));
    rows
}

const FLOOR: [[f64; 2]; 4] = [[-9.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-9.0, 0.0]];

fn steps(rows: &mut Vec<(&'static str, f64)>, kind: &str, session: &mut Session, block: impl Fn() -> BlockEntry) {
    let mut times: [Vec<f64>; 4] = Default::default();
    for _ in 0..CALLS {
        times[0].push(timed(|| session.place(block()).expect("free")));
        times[1].push(timed(|| session.hold("crane", "c", None).expect("free")));
        times[2].push(timed(|| session.release("crane").expect("held")));
        times[3].push(timed(|| session.remove("c").expect("placed")));
    }
    let names = match kind {
        "cells" => ["place, cells", "hold, cells", "release, cells", "remove, cells"],
        _ => ["place, outlines", "hold, outlines", "release, outlines", "remove, outlines"],
    };
    rows.extend(names.into_iter().zip(times.map(median)));
}

fn brick(id: &str, x: f64, y: f64) -> BlockEntry {
    BlockEntry::new(id).polygon([[x, y], [x + 3.0, y], [x + 3.0, y + 1.0], [x, y + 1.0]])
}

fn cells(id: &str, x: f64, y: f64) -> BlockEntry {
    let cell = |k| CellEntry::Square(x + k, y);
    BlockEntry::new(id).cells([cell(0.0), cell(1.0), cell(2.0)])
}

/// The time of a call, microseconds.
fn timed<T>(call: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(call());
    start.elapsed().as_secs_f64() * 1e6
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
