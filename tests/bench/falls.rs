//! Compares the times of structures that fall and of structures that stand: the same stacks, arches and walls with
//! tilted and with vertical gravity. Both are also compared with the time of the solver alone. It solves only the
//! program with hard constraints of the source, which shows whether forces exist, and not where a structure fails.
//!
//! `cargo bench --bench falls` prints a table; `src/doc/performance.md` gives its ratios. With arguments after
//! `--`, such as `-- "wall 915"`, only the rows whose name contains all of them are measured. `BLOCKS=10000` includes structures of
//! more than 2 100 blocks. The measurements of a row alternate, and each value is a median. Walls are in running
//! bond, μ is 0.7.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "the table is the output; a scene that cannot be read is a bug in this benchmark"
)]

mod turn;
#[path = "accuracy/study/vallat.rs"]
mod vallat;

use std::hint::black_box;

use drystone::analysis::{Options, Verdict};
use drystone::internals::effect::{FrameContext, assemble};
use drystone::internals::interface::Interfaces;
use drystone::internals::program::{Program, QuadraticProgram, Scale};
use drystone::internals::solve::{Conditioning, Status, TOLERANCE, solve};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use turn::Turns;
use turn::structure::{arch, block, on_floor, rectangle, scene, wall};
use vallat::vallat_program;

/// The number of measurements of a row, and the time after which no further round begins.
const TURNS: Turns = Turns { least: 1, most: 7, seconds: 3.0 };

/// Angles by which gravity is rotated, degrees.
const ANGLES: [f64; 4] = [26.0, 30.0, 40.0, 60.0];

fn main() {
    let most: usize = std::env::var("BLOCKS").map_or(2_100, |text| text.parse().unwrap());
    let filters = std::env::args().skip(1).filter(|argument| !argument.starts_with('-'));
    let filters: Vec<String> = filters.collect();
    println!(
        "| structure | upright, ms | solver, ms | turned by | verdict | failures | programs | iterations | ms | ratio | verdict only, ms | ratio | solver, ms | says |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (name, blocks, file) in structures() {
        for angle in ANGLES {
            let row = format!("{name} {blocks} at {angle}°");
            if blocks > most || filters.iter().any(|part| !row.contains(part.as_str())) {
                continue;
            }
            print_row(&name, blocks, &file, angle);
        }
    }
}

/// Measures a structure with vertical and with rotated gravity, and prints its row.
fn print_row(name: &str, blocks: usize, file: &Value, angle: f64) {
    let [stands, falls] = [scene(file), scene(&turned(file, angle))];
    let verdict_only = Options::default().verdict_only(true);
    let upright = Analysis::new(&stands);
    assert_eq!(upright.verdict(), Verdict::Stable, "{name} {blocks} upright");
    let hard = [program(&stands), program(&falls)].map(|program| hard(&program));
    let analysis = Analysis::new(&falls);
    let frame = &analysis.frames[0];
    let status = solve(&hard[1], TOLERANCE, Conditioning::Full).status;
    let work: [&dyn Fn(); 5] = [
        &|| analyse(&stands, &Options::default()),
        &|| analyse(&falls, &Options::default()),
        &|| analyse(&falls, &verdict_only),
        &|| solve_alone(&hard[0]),
        &|| solve_alone(&hard[1]),
    ];
    let times = TURNS.medians(&work);
    let [stands, falls, alone, solver_stands, solver_falls] = <[f64; 5]>::try_from(times).unwrap();
    println!(
        "| {name} {blocks} | {stands:.1} | {solver_stands:.1} | {angle}° | {} | {} | {} | {} | {falls:.1} | {:.1} | {alone:.1} | {:.1} | {solver_falls:.1} | {} |",
        match frame.verdict {
            Verdict::Stable => "stands",
            Verdict::Unstable => "falls",
            Verdict::Undecided => "undecided",
        },
        frame.failures.len(),
        frame.solve.programs,
        frame.solve.iterations,
        falls / stands,
        alone / stands,
        match status {
            Status::Solved => "solved",
            Status::Infeasible => "infeasible",
            Status::Unbounded => "unbounded",
            Status::Unsolved => "nothing",
        }
    );
}

fn analyse(scene: &Scene, options: &Options) {
    black_box(Analysis::with(black_box(scene), options));
}

fn solve_alone(program: &QuadraticProgram) {
    black_box(solve(black_box(program), TOLERANCE, Conditioning::Full));
}

/// The program of the first component of a structure. The structures here have only one.
fn program(scene: &Scene) -> Program {
    let found = Interfaces::new(scene);
    let frame = &scene.frames()[0];
    let (assembly, _) = assemble(&FrameContext { scene, frame, interfaces: &found.in_frame(frame) });
    let component = assembly.components().remove(0);
    Program::new(&component, Scale::from_assembly(&component))
}

/// The hard program of the source: its soft program without the second half of the unknowns, which are the adhesion
/// forces, and without the rows of these unknowns.
fn hard(program: &Program) -> QuadraticProgram {
    let soft = vallat_program(program, 1.0);
    let (unknowns, rows) = (soft.unknowns / 2, soft.bound.len() - soft.unknowns / 2);
    let kept = |entry: &(usize, usize, f64)| entry.0 < rows && entry.1 < unknowns;
    QuadraticProgram {
        unknowns,
        linear: soft.linear[..unknowns].to_vec(),
        matrix: soft.matrix.into_iter().filter(kept).collect(),
        bound: soft.bound[..rows].to_vec(),
        ..soft
    }
}

/// The same file with gravity rotated from downwards towards the right.
fn turned(file: &Value, degrees: f64) -> Value {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let mut file = file.clone();
    file["gravity"] = json!([9.81 * sin, -9.81 * cos]);
    file
}

fn stack(blocks: usize) -> Value {
    let at = |k: usize| rectangle(0.0, 0.5 * k as f64, 1.0, 0.5);
    let blocks = (0..blocks).map(|k| block(&format!("{k}"), at(k), 6.0));
    on_floor(0.7, blocks.collect())
}

fn structures() -> Vec<(String, usize, Value)> {
    let mut all = Vec::new();
    for blocks in [10, 100, 1000, 2000, 10_000] {
        all.push(("stack".to_string(), blocks, stack(blocks)));
    }
    for blocks in [11, 101, 1001, 2001, 10_001] {
        all.push(("arch".to_string(), blocks, arch(blocks, 0.3, 0.7)));
    }
    for (columns, rows) in [(3, 3), (10, 10), (20, 20), (30, 30), (45, 45), (64, 64), (100, 100)] {
        let file = wall(columns, rows);
        let blocks = file["blocks"].as_array().unwrap().len();
        all.push(("wall".to_string(), blocks, file));
    }
    all
}
