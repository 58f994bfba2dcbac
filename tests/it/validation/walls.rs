//! Walls of Ferris and Tin-Loi (2001). The horizontal load on each brick is the same fraction of its weight.

use serde_json::{Value, json};

use super::measure::horizontal;
use crate::structure::rectangle;

/// A wall of bricks of 0.4 m by 0.175 m. Each course lists the lengths of its bricks, in bricks. A negative length is
/// a gap.
fn wall(courses: &[&[f64]]) -> Value {
    let (length, height) = (0.4, 0.175);
    let mut blocks = Vec::new();
    for (row, course) in courses.iter().enumerate() {
        let mut x = 0.0;
        for part in *course {
            if *part > 0.0 {
                let polygon = rectangle(x * length, row as f64 * height, part * length, height);
                blocks.push(json!({ "id": format!("{}", blocks.len() + 1), "polygon": polygon }));
            }
            x += part.abs();
        }
    }
    let width = courses[0].iter().map(|part| part.abs()).sum::<f64>() * length;
    json!({ "drystone": 1, "friction": 0.65, "density": 1000,
        "ground": [{ "polygon": rectangle(0.0, -height, width, height) }], "blocks": blocks })
}

const FIVE: &[f64] = &[1.0, 1.0, 1.0, 1.0, 1.0];
const FIVE_HALVES: &[f64] = &[0.5, 1.0, 1.0, 1.0, 1.0, 0.5];

fn running_bond(courses: usize) -> Value {
    let rows: Vec<&[f64]> = (0..courses).map(|k| if k % 2 == 0 { FIVE_HALVES } else { FIVE }).collect();
    wall(&rows)
}

/// The wall with this number, from 1 to 5.
pub fn ferris(number: usize) -> Value {
    match number {
        1 => running_bond(6),
        2 => running_bond(10),
        3 => {
            let (a, b): (&[f64], &[f64]) = (&[1.0; 4], &[0.5, 1.0, 1.0, 1.0, 0.5]);
            let (c, d): (&[f64], &[f64]) = (&[0.5, 1.0, -1.0, 1.0, 0.5], &[1.0, 0.5, -1.0, 0.5, 1.0]);
            wall(&[a, b, a, c, d, c, d, c, a, b, a])
        }
        4 => {
            let (a, b) = (FIVE_HALVES, FIVE);
            let c: &[f64] = &[1.0, -1.0, 1.0, -1.0, 1.0];
            let d: &[f64] = &[0.5, 0.5, -1.0, 0.5, 0.5, -1.0, 0.5, 0.5];
            wall(&[a, b, a, c, d, c, d, c, a, b, a])
        }
        _ => {
            let (a, b): (&[f64], &[f64]) = (&[0.5, 1.0, 1.0, 0.5], &[1.0; 3]);
            let (c, d): (&[f64], &[f64]) = (&[1.0, -1.0, 1.0], &[0.5, 0.5, -1.0, 0.5, 0.5]);
            wall(&[a, b, a, c, d, c, d, c, a, b, a, c, d, c, d, c, a, b, a])
        }
    }
}

pub fn pushed<const NUMBER: usize>() -> f64 {
    horizontal(&ferris(NUMBER))
}
