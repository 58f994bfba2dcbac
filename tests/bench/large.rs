//! How the time of each stage grows with the number of blocks: reading, contacts, assembly, solving, proof, drawing,
//! and all of them together.
//!
//! `cargo bench --bench large` prints the time of each stage and its peak memory (`max alloc`). The structures are
//! walls in running bond, arches, and separate towers of ten blocks each, with 100 and 1 000 blocks. `BLOCKS=10000
//! cargo bench --bench large` uses that number of blocks instead.

use divan::{AllocProfiler, Bencher, black_box};
use drystone::internals::assembly::Assembly;
use drystone::internals::effect::{FrameContext, assemble};
use drystone::internals::interface::Interfaces;
use drystone::internals::program::{Program, Scale};
use drystone::internals::proof::{self, ContactForces, Forces, GripForces};
use drystone::internals::solve::{Conditioning, balance};
use drystone::scene::format::{Pair, SceneFile};
use drystone::{Analysis, Scene, figure, output};

#[global_allocator]
static MEMORY: AllocProfiler = AllocProfiler::system();

fn main() {
    divan::main();
}

/// A kind of structure and its number of blocks.
#[derive(Clone, Copy, Debug)]
struct Case(&'static str, usize);

impl std::fmt::Display for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.0, self.1)
    }
}

fn cases() -> Vec<Case> {
    let chosen = std::env::var("BLOCKS").ok().and_then(|n| n.parse().ok());
    let sizes = chosen.map_or(vec![100, 1000], |size: usize| vec![size]);
    let kinds = ["wall", "arch", "towers"];
    let of = |size: usize| kinds.map(|kind| Case(kind, size));
    sizes.into_iter().flat_map(of).collect()
}

#[divan::bench(args = cases(), sample_count = 5, sample_size = 1)]
fn a_read(bencher: Bencher, case: Case) {
    let text = file(case).to_json();
    bencher.bench_local(|| Scene::from_json(black_box(&text)).map(|scene| scene.blocks().len()));
}

#[divan::bench(args = cases(), sample_count = 5, sample_size = 1)]
fn b_find_contacts(bencher: Bencher, case: Case) {
    let scene = scene(case);
    bencher.bench_local(|| Interfaces::new(black_box(&scene)));
}

#[divan::bench(args = cases(), sample_count = 5, sample_size = 1)]
fn c_assemble(bencher: Bencher, case: Case) {
    let scene = scene(case);
    let found = Interfaces::new(&scene);
    bencher.bench_local(|| programs(&components(black_box(&scene), &found).1));
}

#[divan::bench(args = cases(), sample_count = 3, sample_size = 1)]
fn d_solve(bencher: Bencher, case: Case) {
    let scene = scene(case);
    let found = Interfaces::new(&scene);
    let programs = programs(&components(&scene, &found).1);
    bencher.bench_local(|| -> usize {
        let solved = programs.iter().map(|p| balance(p, Conditioning::Plain));
        solved.map(|found| found.effort.iterations).sum()
    });
}

#[divan::bench(args = cases(), sample_count = 5, sample_size = 1)]
fn e_prove(bencher: Bencher, case: Case) {
    let scene = scene(case);
    let found = Interfaces::new(&scene);
    let (whole, _) = components(&scene, &found);
    let forces = forces(&Analysis::new(&scene));
    assert!(proof::check_forces(&whole, &forces).holds());
    bencher.bench_local(|| proof::check_forces(black_box(&whole), &forces));
}

#[divan::bench(args = cases(), sample_count = 3, sample_size = 1)]
fn f_analyse(bencher: Bencher, case: Case) {
    let scene = scene(case);
    bencher.bench_local(|| Analysis::new(black_box(&scene)).verdict());
}

#[divan::bench(args = cases(), sample_count = 3, sample_size = 1)]
fn g_draw_as_svg(bencher: Bencher, case: Case) {
    let scene = scene(case);
    let analysis = Analysis::new(&scene);
    let options = figure::Options::default();
    bencher.bench_local(|| output::svg::write(&figure::forces(black_box(&analysis), &options)).len());
}

fn components(scene: &Scene, found: &Interfaces) -> (Assembly, Vec<Assembly>) {
    let frame = &scene.frames()[0];
    let interfaces = found.in_frame(frame);
    let (assembly, _) = assemble(&FrameContext { scene, frame, interfaces: &interfaces });
    let parts = assembly.components();
    (assembly, parts)
}

fn programs(parts: &[Assembly]) -> Vec<Program> {
    let of = |part: &Assembly| Program::new(part, Scale::from_assembly(part));
    parts.iter().map(of).collect()
}

/// The forces that an analysis found, in the form that a proof needs.
fn forces(analysis: &Analysis) -> Forces {
    let frame = &analysis.frames[0];
    let contacts = frame
        .contacts
        .iter()
        .map(|contact| ContactForces { normal: contact.normal_forces, friction: contact.friction_force });
    let grips = frame.robots.iter().map(|robot| GripForces { force: robot.force, torque: robot.torque });
    Forces { contacts: contacts.collect(), grips: grips.collect() }
}

fn scene(case: Case) -> Scene {
    Scene::new(file(case)).expect("sound")
}

fn file(case: Case) -> SceneFile {
    let polygons = match case {
        Case("wall", blocks) => wall(blocks),
        Case("arch", blocks) => arch(blocks),
        Case(_, blocks) => towers(blocks),
    };
    let floor = Scene::builder().ground(rectangle(-1e5, -1.0, 2e5, 1.0)).contact_tolerance(1e-6);
    polygons.into_iter().fold(floor, SceneFile::block)
}

fn wall(blocks: usize) -> Vec<Vec<Pair>> {
    let rows = (blocks as f64 / 2.5).sqrt().round() as usize;
    let columns = blocks / rows;
    let mut bricks = Vec::new();
    for row in 0..rows {
        let mut cuts: Vec<f64> = (0..=columns).map(|c| c as f64).collect();
        if row % 2 == 1 {
            cuts = (0..columns).map(|c| c as f64 + 0.5).collect();
            cuts.insert(0, 0.0);
            cuts.push(columns as f64);
        }
        for cut in cuts.windows(2) {
            bricks.push(rectangle(cut[0], 0.5 * row as f64, cut[1] - cut[0], 0.5));
        }
    }
    bricks
}

fn arch(blocks: usize) -> Vec<Vec<Pair>> {
    let radius = blocks as f64 / 10.0;
    let at = |share: f64, k: usize| -> Pair {
        let angle = std::f64::consts::PI * k as f64 / blocks as f64;
        let y = if k == 0 || k == blocks { 0.0 } else { libm::sin(angle) };
        [-radius * share * libm::cos(angle), radius * share * y]
    };
    let stone = |k: usize| vec![at(0.9, k), at(0.9, k + 1), at(1.1, k + 1), at(1.1, k)];
    (0..blocks).map(stone).collect()
}

fn towers(blocks: usize) -> Vec<Vec<Pair>> {
    let brick = |k: usize| rectangle(2.0 * (k / 10) as f64 + 0.03 * (k % 10) as f64, 0.5 * (k % 10) as f64, 1.0, 0.5);
    (0..blocks).map(brick).collect()
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Vec<Pair> {
    vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
}
