//! The time of a step of a session: walls are built brick by brick on a square lattice and then changed.
//!
//! `cargo bench --bench session` prints medians in microseconds, and how many steps were answered from the warm start.
//! "From scratch" means that a scene of the same blocks is built in memory and analysed, without a warm start.
//! `BLOCKS=20 cargo bench --bench session` uses only walls of 20 blocks.

#![allow(clippy::print_stdout, reason = "a benchmark reports on standard output")]

use std::time::Instant;

use drystone::analysis::{Options, Source, Verdict, verdicts};
use drystone::scene::format::{BlockEntry, CellEntry, GridKind, GroundEntry, RobotEntry, SceneFile};
use drystone::session::Session;
use drystone::{Analysis, Scene};

/// The number of times each wall is built.
const ROUNDS: usize = 41;

fn main() {
    println!("| blocks | step | µs, median | answered from the warm start |");
    println!("|---|---|---|---|");
    let chosen = std::env::var("BLOCKS").ok().and_then(|n| n.parse().ok());
    for blocks in chosen.map_or(vec![20, 200], |blocks: usize| vec![blocks]) {
        let mut steps = Steps::default();
        let rounds = if blocks > 100 { 5 } else { ROUNDS };
        let mut wholes = Vec::new();
        for _ in 0..rounds {
            let start = Instant::now();
            lay(blocks, &mut steps);
            wholes.push(start.elapsed().as_secs_f64() * 1e6);
        }
        for (name, list) in &mut steps.0 {
            let known = list.iter().filter(|s| s.1 == Source::WarmStart).count();
            let share = 100 * known / list.len();
            let times = list.iter().map(|s| s.0).collect();
            println!("| {blocks} | {name} | {:.1} | {share} % |", median(times));
        }
        println!("| {blocks} | all steps | {:.0} | |", median(wholes));
        let file = (0..blocks).fold(empty(blocks), |file, k| file.block(brick(k, blocks)));
        let scratch = |examine: &dyn Fn(&Scene) -> Verdict| {
            let one = |_| {
                let start = Instant::now();
                let scene = Scene::new(file.clone()).expect("sound");
                assert_eq!(examine(&scene), Verdict::Stable);
                start.elapsed().as_secs_f64() * 1e6
            };
            median((0..rounds).map(one).collect())
        };
        let alone = scratch(&|scene| verdicts(scene, &Options::default())[0]);
        println!("| {blocks} | from scratch, the verdict alone | {alone:.1} | |");
        let whole = scratch(&|scene| Analysis::new(scene).verdict());
        println!("| {blocks} | from scratch, everything | {whole:.1} | |");
    }
}

/// The steps of each kind: the time in microseconds, and how the verdict was found.
#[derive(Default)]
struct Steps(Vec<(&'static str, Vec<(f64, Source)>)>);

impl Steps {
    fn take(
        &mut self,
        name: &'static str,
        session: &mut Session,
        step: impl FnOnce(&mut Session) -> Verdict,
    ) -> Verdict {
        let start = Instant::now();
        let verdict = step(session);
        let micros = start.elapsed().as_secs_f64() * 1e6;
        let known = (micros, session.source());
        match self.0.iter_mut().find(|(n, _)| *n == name) {
            Some((_, list)) => list.push(known),
            None => self.0.push((name, vec![known])),
        }
        verdict
    }
}

/// Builds a wall and changes it: its last brick is held, released and removed, and bricks are placed in the air.
fn lay(blocks: usize, steps: &mut Steps) {
    let mut session = Session::new(empty(blocks)).expect("sound");
    for k in 0..blocks {
        let brick = brick(k, blocks);
        let verdict = steps.take("place a brick", &mut session, |s| s.place(brick).expect("free"));
        assert_eq!(verdict, Verdict::Stable);
    }
    let top = blocks.to_string();
    let verdict = steps.take("hold the last brick", &mut session, |s| s.hold("r0", &top, None).expect("there"));
    assert_eq!(verdict, Verdict::Stable);
    let verdict = steps.take("release it", &mut session, |s| s.release("r0").expect("held"));
    assert_eq!(verdict, Verdict::Stable);
    let in_the_air = || cells(-40, 3);
    let verdict = steps.take("place a brick in the air", &mut session, |s| s.place(in_the_air()).expect("free"));
    assert_eq!(verdict, Verdict::Unstable);
    for k in 0..3 {
        let more = cells(-30 + 4 * k, 0);
        let verdict = steps.take("place another while it falls", &mut session, |s| s.place(more).expect("free"));
        assert_eq!(verdict, Verdict::Unstable);
    }
    let name = (blocks + 1).to_string();
    let verdict = steps.take("remove the falling brick", &mut session, |s| s.remove(&name).expect("there"));
    assert_eq!(verdict, Verdict::Stable);
    let verdict = steps.take("remove the last brick", &mut session, |s| s.remove(&top).expect("there"));
    assert_eq!(verdict, Verdict::Stable);
}

fn empty(blocks: usize) -> SceneFile {
    let floor = (-50..4 * blocks as i64).map(|x| CellEntry::Square(x as f64, -1.0));
    Scene::builder()
        .grid(GridKind::Square, 0.5)
        .ground(GroundEntry::default().cells(floor.collect::<Vec<_>>()))
        .robot(RobotEntry::default())
}

/// The brick with this number in a pyramid in running bond, counted row by row from below.
fn brick(number: usize, blocks: usize) -> BlockEntry {
    let mut width = 1;
    while width * (width + 1) / 2 < blocks {
        width += 1;
    }
    let (mut row, mut left) = (0, number);
    while left >= width - row {
        left -= width - row;
        row += 1;
    }
    cells((row + 2 * left) as i64, row as i64)
}

fn cells(x: i64, y: i64) -> BlockEntry {
    let cell = |k: i64| CellEntry::Square((x + k) as f64, y as f64);
    BlockEntry::default().cells([cell(0), cell(1)]).weight(2.0)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
