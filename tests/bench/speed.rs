//! The times of reading, checking and drawing, and of solving our program and the program of the source with the same
//! solver.
//!
//! `cargo bench` prints the least, the median and the mean time of each. The walls are in running bond with half
//! bricks at the ends of every second row. Their only load is their weight.

#[path = "accuracy/study/vallat.rs"]
mod vallat;

use std::fs;
use std::process::Command;

use divan::{Bencher, black_box};
use drystone::internals::effect::{FrameContext, assemble};
use drystone::internals::interface::Interfaces;
use drystone::internals::program::{Program, Scale};
use drystone::internals::solve::{Conditioning, TOLERANCE, balance, solve};
use drystone::scene::format::SceneFile;
use drystone::starter::Wall;
use drystone::{Analysis, Scene, figure, output};
use vallat::vallat_program;

const FIGURE_4: &str = include_str!("../../assets/thesis/figure-4.json");

/// The cost of one newton of sticking in the soft program of the source.
const BETA: f64 = 1e6;

/// The numbers of blocks of the walls.
const WALLS: [usize; 3] = [10, 100, 1000];

fn main() {
    divan::main();
}

#[divan::bench(args = WALLS)]
fn check(bencher: Bencher, blocks: usize) {
    let scene = wall(blocks);
    bencher.bench_local(|| Analysis::new(black_box(&scene)));
}

#[divan::bench(args = WALLS)]
fn our_program(bencher: Bencher, blocks: usize) {
    let program = program(&wall(blocks));
    bencher.bench_local(|| balance(black_box(&program), Conditioning::Plain));
}

/// The solver has its default settings.
#[divan::bench(args = WALLS)]
fn the_sources_soft_program(bencher: Bencher, blocks: usize) {
    let program = program(&wall(blocks));
    bencher.bench_local(|| solve(&vallat_program(black_box(&program), BETA), TOLERANCE, Conditioning::Full));
}

#[divan::bench(args = [10, 100, 1000, 10_050])]
fn read_a_file(bencher: Bencher, blocks: usize) {
    let text = serde_json::to_string(&wall_file(blocks)).expect("a scene is plain data");
    bencher.bench_local(|| Scene::from_json(black_box(&text)).map(|scene| scene.blocks().len()));
}

#[divan::bench]
fn figure_4_as_svg(bencher: Bencher) {
    let scene = Scene::from_json(FIGURE_4).expect("sound");
    let analysis = Analysis::new(&scene);
    bencher.bench_local(|| output::svg::write(&figure::forces(black_box(&analysis), &figure::Options::default())));
}

#[divan::bench]
fn figure_4_from_json_to_png(bencher: Bencher) {
    bencher.bench_local(|| {
        let scene = Scene::from_json(black_box(FIGURE_4)).expect("sound");
        let drawing = figure::forces(&Analysis::new(&scene), &figure::Options::default());
        output::png::render(&output::svg::write(&drawing), output::png::Size::Scale(2.0))
    });
}

#[divan::bench]
fn figure_4_as_a_process(bencher: Bencher) {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("figure-4.json");
    let picture = folder.path().join("figure-4.png");
    fs::write(&scene, FIGURE_4).expect("writable");
    bencher.bench_local(|| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        command.arg("--quiet").arg("render").arg(&scene).arg("-o").arg(&picture);
        assert!(command.status().expect("starts").success());
    });
}

/// The program of a wall. A wall has a single component.
fn program(scene: &Scene) -> Program {
    let found = Interfaces::new(scene);
    let frame = &scene.frames()[0];
    let interfaces = found.in_frame(frame);
    let (assembly, _) = assemble(&FrameContext { scene, frame, interfaces: &interfaces });
    let components = assembly.components();
    assert_eq!(components.len(), 1, "a wall is one component");
    Program::new(&components[0], Scale::from_assembly(&components[0]))
}

fn wall(blocks: usize) -> Scene {
    let scene = Scene::new(wall_file(blocks)).expect("sound");
    assert_eq!(scene.blocks().len(), blocks);
    scene
}

/// A wall of `rows · bricks + rows / 2` blocks: 10, 100 or 1 000, and 10 050 for any other number.
fn wall_file(blocks: usize) -> SceneFile {
    let (rows, bricks) = match blocks {
        10 => (3, 3),
        100 => (8, 12),
        1000 => (16, 62),
        _ => (100, 100),
    };
    let wall = Wall { courses: rows, bricks, length: 2.0, height: 1.0, ..Wall::default() };
    wall.scene()
}
