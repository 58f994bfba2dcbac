//! Tests of the sparse factor and of the groups of columns, against products with the matrix.

use super::*;

fn elements(unknowns: usize, columns: &[Vec<(usize, f64)>]) -> ColumnGroups {
    let entries = columns.iter().enumerate();
    let entries = entries.flat_map(|(k, column)| column.iter().map(move |(i, v)| (k, *i, *v)));
    ColumnGroups::new(unknowns, columns.len(), entries)
}

#[test]
fn a_factor_solves_its_system_for_one_and_for_two_right_hand_sides() {
    let mut numbers = RandomNumbers(7);
    for (wide, high) in [(1, 1), (1, 30), (30, 1), (9, 12), (23, 5)] {
        let (unknowns, columns) = lattice(wide, high, &mut numbers);
        let mut posed = elements(unknowns, &columns);
        let plain = posed.clone();
        let mut factor = Cholesky::new(&mut posed).expect("an order of elimination exists");
        let weights: Vec<f64> = columns.iter().map(|_| 1.5 + numbers.next()).collect();
        let mut doubled = weights.clone();
        doubled.iter_mut().for_each(|w| *w *= 2.0);
        // The second factorisation must not depend on the first.
        factor.factor(&posed, &doubled, 0.0);
        factor.factor(&posed, &weights, 0.0);
        let wanted: [Vec<f64>; 2] = std::array::from_fn(|_| (0..unknowns).map(|_| numbers.next()).collect());
        let ordered = [0, 1].map(|n| factor.to_elimination_order(&wanted[n]));
        let mut both: Vec<[f64; 2]> = (0..unknowns).map(|k| [ordered[0][k], ordered[1][k]]).collect();
        let mut one: Vec<[f64; 1]> = ordered[0].iter().map(|v| [*v]).collect();
        factor.solve(&mut both);
        factor.solve(&mut one);
        let found = [
            both.iter().map(|v| v[0]).collect(),
            both.iter().map(|v| v[1]).collect(),
            one.iter().map(|v| v[0]).collect::<Vec<f64>>(),
        ];
        for (found, wanted) in found.iter().zip([&wanted[0], &wanted[1], &wanted[0]]) {
            let x = factor.to_program_order(found);
            let mut along = vec![0.0; columns.len()];
            plain.transpose_product(&x, &mut along);
            along.iter_mut().zip(&weights).for_each(|(a, w)| *a *= w);
            let mut given = vec![0.0; unknowns];
            plain.add_product(&along, &mut given);
            for (given, wanted) in given.iter().zip(wanted) {
                assert!((given - wanted).abs() < 1e-7, "{wide} × {high}: {given} for {wanted}");
            }
        }
    }
}

#[test]
fn an_unknown_without_columns_is_zero() {
    // The second of three blocks, with unknowns 3 to 5, has no column. Unknowns 7 and 8 of the third block have none
    // either.
    let columns = vec![vec![(0, 2.0)], vec![(1, 1.0)], vec![(2, 1.0)], vec![(6, 1.0), (0, 1.0)]];
    let mut posed = elements(9, &columns);
    let mut factor = Cholesky::new(&mut posed).expect("an order of elimination exists");
    factor.factor(&posed, &[1.0; 4], 0.0);
    let mut x: Vec<[f64; 1]> = factor.to_elimination_order(&[1.0; 9]).iter().map(|v| [*v]).collect();
    factor.solve(&mut x);
    let x = factor.to_program_order(&x.iter().map(|v| v[0]).collect::<Vec<_>>());
    // (4 + 1)·x₀ + x₆ = 1 and x₀ + x₆ = 1.
    for (k, wanted) in [(0, 0.0), (1, 1.0), (2, 1.0), (6, 1.0)] {
        assert!((x[k] - wanted).abs() < 1e-14, "{x:?}");
    }
    assert!([3, 4, 5, 7, 8].iter().all(|k| x[*k] == 0.0), "{x:?}");
}

#[test]
fn columns_of_the_same_two_bodies_form_one_group_with_the_same_products() {
    let mut numbers = RandomNumbers(3);
    let mut column =
        |unknowns: &[usize]| -> Vec<(usize, f64)> { unknowns.iter().map(|i| (*i, numbers.next())).collect() };
    // Bodies 0 and 1: a normal force, a friction force, and both together. Then body 1 and the ground, bodies 1 and
    // 2, no body, and a single unknown of body 2.
    let columns = vec![
        column(&[1, 2, 4, 5]),
        column(&[0, 2, 3, 5]),
        column(&[0, 1, 2, 3, 4, 5]),
        column(&[4]),
        column(&[3, 4, 5, 6, 7, 8]),
        column(&[]),
        column(&[8]),
    ];
    let mut elements = elements(9, &columns);
    assert_eq!([elements.column_count(), elements.group_count()], [7, 2]);
    assert_eq!(elements.group(0).rows, [0, 1, 2, 3, 4, 5]);
    assert_eq!(elements.group(1).rows, [3, 4, 5, 6, 7, 8]);
    assert_eq!(elements.group(1).first, 4);
    let position: Vec<u32> = vec![4, 0, 8, 2, 6, 1, 7, 3, 5];
    elements.permute_rows(&position);
    let amounts: Vec<f64> = (0..7).map(|_| numbers.next()).collect();
    let y: Vec<f64> = (0..9).map(|_| numbers.next()).collect();
    let (mut sum, mut products) = (vec![0.0; 9], vec![0.0; 7]);
    elements.add_product(&amounts, &mut sum);
    elements.transpose_product(&y, &mut products);
    for (k, column) in columns.iter().enumerate() {
        let along: f64 = column.iter().map(|(i, v)| v * y[position[*i] as usize]).sum();
        assert!((products[k] - along).abs() < 1e-14, "column {k}");
        for (i, v) in column {
            sum[position[*i] as usize] -= v * amounts[k];
        }
    }
    assert!(sum.iter().all(|v| v.abs() < 1e-14), "{sum:?}");
}
