//! Compares our solver, which uses the normal equations, with clarabel. Both solve the same programs of walls that
//! are upright, near their limit or falling.
//!
//! `cargo bench --bench solvers` prints a row for each program: iterations and milliseconds of each
//! solver, and their ratio. `BLOCKS=10000` includes the wall of that size.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "the table is the output; a scene that cannot be read is a bug in this benchmark"
)]

mod turn;

use std::hint::black_box;

use drystone::internals::effect::{FrameContext, assemble};
use drystone::internals::interface::Interfaces;
use drystone::internals::program::{
    Aim, Column, Program, QuadraticProgram, Scale, adhesion_columns, columns, kinematic_form,
};
use drystone::internals::solve::{Conditioning, SolverSettings, Status, by_clarabel, solve_with};
use serde_json::{Value, json};

use turn::Turns;
use turn::structure::{scene, wall};

const TURNS: Turns = Turns { least: 1, most: 5, seconds: 5.0 };

fn main() {
    let most: usize = std::env::var("BLOCKS").map_or(2_100, |text| text.parse().unwrap());
    println!(
        "| bricks | turned by | program | unknowns | status | iterations | ms | status of clarabel | iterations | ms | ratio |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for (across, courses) in [(20, 20), (30, 30), (45, 45), (99, 100)] {
        let file = wall(across, courses);
        let blocks = file["blocks"].as_array().unwrap().len();
        if blocks > most {
            continue;
        }
        for angle in [0.0, 26.0, 40.0] {
            for (name, problem) in problems(&program(&file, angle)) {
                print_row(blocks, angle, name, &problem);
            }
        }
    }
}

fn print_row(blocks: usize, angle: f64, name: &str, problem: &QuadraticProgram) {
    let settings = SolverSettings::from(Conditioning::Plain);
    let [ours, theirs] = [solve_with, by_clarabel].map(|solver| solver(problem, settings));
    let times = TURNS.medians::<&dyn Fn()>(&[&|| drop(black_box(solve_with(black_box(problem), settings))), &|| {
        drop(black_box(by_clarabel(black_box(problem), settings)))
    }]);
    println!(
        "| {blocks} | {angle}° | {name} | {} | {} | {} | {:.0} | {} | {} | {:.0} | {:.1} |",
        problem.unknowns,
        word(ours.status),
        ours.iterations,
        times[0],
        word(theirs.status),
        theirs.iterations,
        times[1],
        times[1] / times[0],
    );
}

fn word(status: Status) -> &'static str {
    match status {
        Status::Solved => "solved",
        Status::Infeasible => "infeasible",
        Status::Unbounded => "unbounded",
        Status::Unsolved => "nothing",
    }
}

/// The programs that a check solves, each with its name.
fn problems(program: &Program) -> [(&'static str, QuadraticProgram); 3] {
    let all = columns(program);
    let largest = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let loads: Vec<f64> = program.loads.iter().map(|v| v / largest).collect();
    let with_adhesion: Vec<Column> = [all.clone(), adhesion_columns(program)].concat();
    let sticks = |c: &Column| f64::from(u8::from(c.force.is_adhesion()));
    [
        ("least force", kinematic_form(&program.loads, &all, &Aim::Least(&|c: &Column| c.cost)).0),
        ("least residual", kinematic_form(&loads, &all, &Aim::Residual).0),
        ("least sticking", kinematic_form(&loads, &with_adhesion, &Aim::Least(&sticks)).0),
    ]
}

/// The program of a wall whose gravity is rotated from downwards towards the right.
fn program(file: &Value, degrees: f64) -> Program {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let mut file = file.clone();
    file["gravity"] = json!([9.81 * sin, -9.81 * cos]);
    let scene = scene(&file);
    let found = Interfaces::new(&scene);
    let frame = &scene.frames()[0];
    let (assembly, _) = assemble(&FrameContext { scene: &scene, frame, interfaces: &found.in_frame(frame) });
    Program::new(&assembly, Scale::from_assembly(&assembly))
}
