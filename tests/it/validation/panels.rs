//! Figures of the source, [Vallat23], with the numbers that its author's program computed.

use drystone::Analysis;
use serde_json::Value;

use crate::structure::scene;

fn file(name: &str) -> Value {
    let path = format!("{}/assets/thesis/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a scene of the source");
    serde_json::from_str(&text).expect("JSON")
}

fn total_force(name: &str, frame: usize) -> f64 {
    Analysis::new(scene(&file(name))).frames[frame].total_force
}

fn sticking(name: &str) -> f64 {
    Analysis::new(scene(&file(name))).frames[0].total_sticking
}

pub fn figure_3b() -> f64 {
    total_force("figure-3b", 0)
}

pub fn figure_4c() -> f64 {
    total_force("figure-4", 2)
}

pub fn figure_5b() -> f64 {
    total_force("figure-5", 1)
}

pub fn figure_6e() -> f64 {
    total_force("figure-6-kernel-02", 1)
}

pub fn figure_8_left() -> f64 {
    total_force("figure-8-left", 0)
}

pub fn figure_8_right() -> f64 {
    sticking("figure-8-right")
}

pub fn figure_9a() -> f64 {
    sticking("figure-9a")
}
