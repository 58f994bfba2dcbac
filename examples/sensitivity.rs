//! Prints how the load factor of an arch changes with friction and with the corners of the voussoirs, to find changes
//! that make the arch stronger.
//!
//! Change the numbers below and run `cargo run --example sensitivity`.

#![allow(clippy::print_stdout, reason = "the example prints its results")]

use std::error::Error;
use std::f64::consts::PI;

use drystone::analysis::{CornerMoves, MarginKind};
use drystone::scene::SceneError;
use drystone::scene::format::{BlockEntry, LoadEntry, Pair};
use drystone::{Analysis, Scene};

/// The number of voussoirs.
const VOUSSOIRS: usize = 15;
/// The radius of the centreline, metres.
const RADIUS: f64 = 1.0;
/// The thickness of the arch, metres.
const THICKNESS: f64 = 0.2;
/// The friction coefficient of every joint.
const FRICTION: f64 = 0.6;
/// The index of the loaded voussoir, from 0.
const LOADED: usize = 4;
/// The load, newtons.
const LOAD: Pair = [0.0, -1000.0];
/// The distance by which each corner is moved, metres.
const STEP: f64 = 0.01;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = arch()?;
    let analysis = Analysis::new(&scene);
    let found = match analysis.sensitivity(0, MarginKind::LoadFactor) {
        Ok(found) => found,
        Err(reason) => {
            println!("No derivatives: {reason:?}");
            return Ok(());
        }
    };
    let Ok(end) = found.high else {
        println!("The load may grow without limit.");
        return Ok(());
    };
    println!("The arch carries {:.4} times its load.", end.value);
    if let Some(friction) = end.friction_of_all.and_then(|slope| slope.unique()) {
        println!("With 0.1 more friction: load factor {:.4}", end.value + 0.1 * friction);
    }
    // Print the corners with the largest gradients. Each printed move is in the direction in which the load factor
    // grows most.
    let mut corners: Vec<_> = end.corners.iter().collect();
    let steepness = |moves: CornerMoves| moves.gradient().map_or(0.0, |slope| slope.norm());
    corners.sort_by(|a, b| steepness(b.moves).total_cmp(&steepness(a.moves)));
    for corner in corners.iter().take(8) {
        let Some(slope) = corner.moves.gradient() else {
            println!("The load factor has a kink at a corner of {}.", scene.blocks()[corner.block.0].id);
            continue;
        };
        let to = slope * (STEP / slope.norm());
        println!(
            "Corner {} of {} moved by ({:+.4}, {:+.4}) m: load factor {:.4}",
            corner.corner + 1,
            scene.blocks()[corner.block.0].id,
            to.x,
            to.y,
            end.value + slope.norm() * STEP
        );
    }
    Ok(())
}

/// Builds a semicircular arch on two supports.
fn arch() -> Result<Scene, SceneError> {
    let (inner, outer) = (RADIUS - THICKNESS / 2.0, RADIUS + THICKNESS / 2.0);
    let mut scene = Scene::builder()
        .friction(FRICTION)
        .density(2200.0)
        .ground(vec![[-outer, -0.3], [-inner, -0.3], [-inner, 0.0], [-outer, 0.0]])
        .ground(vec![[inner, -0.3], [outer, -0.3], [outer, 0.0], [inner, 0.0]]);
    for k in 0..VOUSSOIRS {
        let [a, b, c, d] = [(k + 1, inner), (k, inner), (k, outer), (k + 1, outer)];
        let corners = [a, d, c, b].map(|(joint, radius)| point(joint, radius));
        scene = scene.block(BlockEntry::new(format!("v{k}")).polygon(corners));
    }
    let [a, b] = [point(LOADED, outer), point(LOADED + 1, outer)];
    let middle = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    let load = LoadEntry::on(format!("v{LOADED}")).force(LOAD).at(middle);
    scene.load(load).build()
}

/// Returns the point of a joint at the given distance from the centre of the arch. Joint 0 is the left springing.
fn point(joint: usize, radius: f64) -> Pair {
    let angle = PI * joint as f64 / VOUSSOIRS as f64;
    let height = if joint == VOUSSOIRS { 0.0 } else { radius * libm::sin(angle) };
    [-radius * libm::cos(angle), height]
}
