//! Stacks of equal blocks of length 1 that reach beyond the edge of a table.

use serde_json::{Value, json};

use super::measure::limit;
use crate::structure::{harmonic, rectangle};

/// The reach of a stack with one block on another. All overhangs of the harmonic stack are multiplied by the largest
/// factor with which the stack stands.
pub fn one_on_one<const N: usize>() -> f64 {
    let reach: f64 = (1..=N).map(|k| 0.5 / k as f64).sum();
    reach * limit([1.001, 0.999], 1e-9, |share| harmonic(N, share))
}

/// The left ends of the blocks, level by level, in the stacks of three to six blocks with the largest reach. The
/// table ends at x = 0. The positions were computed with a separate nonlinear program, without drystone.
const BEST: [&[&[f64]]; 4] = [
    &[&[-0.5], &[-1.0, 0.0]],
    &[&[-0.478553390734276], &[-0.9125794650956026, 0.1678932188134525], &[-0.7767603629835739]],
    &[&[-0.6477225584072697], &[-1.2513252641361823, -0.195445115010332], &[-0.7100619474358845, 0.30455488498966815]],
    &[
        &[-0.6276846177546515],
        &[-1.3255220716495955, -0.1720359120763135],
        &[-0.949554608651463, 0.43670021437136897],
        &[-0.3619030042393444],
    ],
];

/// The best stack of `n` blocks (3 to 6) without friction, moved to the right by `by`.
pub fn best(n: usize, by: f64) -> Value {
    let mut blocks = Vec::new();
    for (level, row) in BEST[n - 3].iter().enumerate() {
        for x in *row {
            let polygon = rectangle(x + by, 0.25 * level as f64, 1.0, 0.25);
            let id = format!("{}", blocks.len() + 1);
            blocks.push(json!({ "id": id, "polygon": polygon, "weight": 1.0 }));
        }
    }
    json!({ "drystone": 1, "friction": 0, "ground": [{ "polygon": rectangle(-2.0, -0.5, 2.0, 0.5) }], "blocks": blocks })
}

/// The reach of the best stack, moved to the right as far as possible without falling.
pub fn several_on_one<const N: usize>() -> f64 {
    let ends = BEST[N - 3].concat();
    let reach = ends.into_iter().fold(f64::MIN, f64::max) + 1.0;
    reach + limit([1e-3, -1e-3], 1e-9, |by| best(N, by))
}
