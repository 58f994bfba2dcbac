//! Computes which forces a lintel on two posts can carry, and which blocks move under larger forces.
//!
//! Change the numbers below: the span, the posts, the friction, or the point at which the force acts.

#![allow(clippy::print_stdout, reason = "the example prints its results")]

use std::error::Error;

use drystone::analysis::{CapacityRequest, Cases, ForceAt};
use drystone::scene::Point;
use drystone::scene::format::{BlockEntry, Pair};
use drystone::{Analysis, Scene};

/// Clear distance between the posts, metres.
const SPAN: f64 = 4.0;
/// Width and height of a post, metres.
const POST: (f64, f64) = (1.0, 3.0);
const FRICTION: f64 = 0.6;

fn main() -> Result<(), Box<dyn Error>> {
    let (width, height) = POST;
    let right = SPAN + width;
    let scene = Scene::builder()
        .friction(FRICTION)
        .ground(rectangle(-1.0, -1.0, right + width + 1.0, 0.0))
        .block(BlockEntry::new("left").polygon(rectangle(0.0, 0.0, width, height)).weight(6.0))
        .block(BlockEntry::new("right").polygon(rectangle(right, 0.0, right + width, height)).weight(6.0))
        .block(BlockEntry::new("lintel").polygon(rectangle(0.0, height, right + width, height + 1.0)).weight(11.0))
        .build()?;
    let lintel = scene.block_named("lintel").ok_or("there is no lintel")?;

    // The force acts at the middle of the upper edge of the lintel.
    let at = ForceAt::Point(Point::new(0.5 * (right + width), height + 1.0));
    let request = CapacityRequest::of_block(lintel).at(at);
    let analysis = Analysis::new(&scene);
    let capacity = analysis.capacity(0, &request)?;
    println!("corners of the set of forces (Fx, Fy), in newtons:");
    for vertex in &capacity.vertices {
        println!("  {:8.3} {:8.3}", vertex.force.x, vertex.force.y);
    }
    for ray in &capacity.rays {
        println!("  unbounded in the direction {:.3} {:.3}", ray.x, ray.y);
    }
    for (number, edge) in capacity.edges.iter().enumerate() {
        let moving = edge.mechanism.iter().map(|m| scene.blocks()[m.block.0].id.as_str());
        let moving: Vec<&str> = moving.collect();
        println!("beyond edge {number}, these blocks move: {}", moving.join(", "));
    }
    println!("the largest force to the right is {:.3?} N", capacity.reach([1.0, 0.0]));

    // The largest force to the right that the lintel carries at every tilt of up to 2° to either side, with every
    // friction coefficient from 0.5 to 0.7.
    let cases = Cases::default().tilt(-2.0, 2.0).friction(0.5, 0.7);
    let for_all = analysis.capacity(0, &request.cases(cases))?;
    println!("for every tilt and friction: {:.3?} N", for_all.reach([1.0, 0.0]));
    Ok(())
}

fn rectangle(left: f64, bottom: f64, right: f64, top: f64) -> Vec<Pair> {
    vec![[left, bottom], [right, bottom], [right, top], [left, top]]
}
