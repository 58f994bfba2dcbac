//! Tests of the corrections of forces that leave single blocks unbalanced.

use super::*;
use crate::mechanics::program::{ContactTerm, Scale};
use crate::mechanics::statics::interface::ContactKind;

/// A tower of blocks with these weights. Each block is 1 wide and 1 high.
fn tower(weights: &[f64], friction: f64) -> Program {
    let foot = [Vector::new(0.5, -0.5), Vector::new(-0.5, -0.5)];
    let head = [Vector::new(0.5, 0.5), Vector::new(-0.5, 0.5)];
    Program {
        blocks: weights.len(),
        loads: weights.iter().flat_map(|w| [0.0, *w, 0.0]).collect(),
        contacts: (0..weights.len())
            .map(|k| ContactTerm {
                on: (k, foot),
                from: (k > 0).then(|| (k - 1, head)),
                normal: Vector::new(0.0, 1.0),
                friction,
                points: 2,
                kind: ContactKind::Edge,
            })
            .collect(),
        grips: Vec::new(),
        scale: Scale { length: 1.0, force: 1.0 },
    }
}

/// Normal forces that carry the weights of a tower, each with an error of about a billionth of the total weight.
fn rough(weights: &[f64]) -> Amounts {
    let above = |k: usize| weights[k..].iter().sum::<f64>();
    let off = |k: usize| 1e-9 * ((7 * k % 5) as f64 - 2.0) * above(0);
    Amounts {
        normal: (0..weights.len())
            .map(|k| [0.5 * above(k) + off(k), 0.5 * above(k) + off(k + 1)].map(|v| v.max(0.0)))
            .collect(),
        friction: vec![0.0; weights.len()],
        grip: Vec::new(),
    }
}

#[test]
fn a_light_block_on_heavy_blocks_is_balanced_relative_to_its_own_weight() {
    let weights = [300.0, 300.0, 1.0, 1e-4, 1e-5];
    let program = tower(&weights, 0.5);
    let start = rough(&weights);
    let mut effort = Effort::default();
    let found = rebalance_relative(&program, &start, &mut effort).expect("it stands");
    let (residual, total) = block_residuals(&program, &found);
    assert!(largest_scaled(&residual, &row_scales(&program, &total)) < 1e-11);
    assert!(found.normal.iter().flatten().all(|n| *n >= 0.0));
}

#[test]
fn a_correction_balances_without_tension() {
    let program = tower(&[1.0], 0.0);
    let start = Amounts { normal: vec![[0.9, 0.0]], friction: vec![0.0], grip: Vec::new() };
    let mut effort = Effort::default();
    let found = rebalance_absolute(&program, &start, &mut effort).expect("it stands");
    for normal in found.normal[0] {
        assert!((normal - 0.5).abs() < 1e-12, "{normal}");
    }
    // A block that is pulled upward has no balance.
    let mut lifted = program.clone();
    lifted.loads[1] = -1.0;
    assert!(rebalance_absolute(&lifted, &start, &mut effort).is_none());
}
