//! Builds a scene in Rust: how far can a stack of n bricks reach beyond an edge?
//!
//! The largest overhang is known: half the length of a brick times 1 + 1/2 + … + 1/n. The example shows that a stack
//! with 0.1 % less overhang stands, and that a stack with 0.1 % more overhang falls.

#![allow(clippy::print_stdout, reason = "the example prints its results")]

use std::error::Error;

use drystone::scene::SceneError;
use drystone::scene::format::{BlockEntry, Pair};
use drystone::{Analysis, Scene};

const BRICKS: usize = 6;

fn main() -> Result<(), Box<dyn Error>> {
    for share in [0.999, 1.001] {
        let scene = stack(share)?;
        let frame = &Analysis::new(&scene).frames[0];
        let reach: f64 = (1..=BRICKS).map(|n| share * 0.5 / n as f64).sum();
        println!(
            "{BRICKS} bricks reach {reach:.4} m beyond the edge: {:?}, proved by {:?}",
            frame.verdict, frame.proof
        );
    }
    Ok(())
}

/// Builds a stack of bricks of 1 m × 0.25 m. The k-th brick from the top overhangs the brick below it by `share`/2k
/// metres.
fn stack(share: f64) -> Result<Scene, SceneError> {
    let mut right = 0.0;
    let mut scene = Scene::builder().ground(rectangle(-3.0, -1.0, 0.0, 0.0));
    for row in 0..BRICKS {
        right += share * 0.5 / (BRICKS - row) as f64;
        let bottom = 0.25 * row as f64;
        let outline = rectangle(right - 1.0, bottom, right, bottom + 0.25);
        scene = scene.block(BlockEntry::new(format!("brick {row}")).polygon(outline));
    }
    scene.build()
}

fn rectangle(left: f64, bottom: f64, right: f64, top: f64) -> Vec<Pair> {
    vec![[left, bottom], [right, bottom], [right, top], [left, top]]
}
