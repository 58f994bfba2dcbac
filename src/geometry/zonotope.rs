//! Computes the gauge of a zonotope at a point: the least factor by which the zonotope must be scaled to contain the
//! point.
//!
//! The zonotope of the generators g₁ … gₘ is the set { Σ aᵢ gᵢ : |aᵢ| ≤ 1 }. Its gauge (Minkowski functional) at a
//! point r is the smallest τ ≥ 0 for which r lies in the zonotope scaled by τ. A convex body is the intersection of the
//! half-spaces of its facets. Each facet of a zonotope in space is spanned by two of its generators, and the zonotope's
//! half-width along a normal n is Σ |n·gᵢ|. Therefore
//!
//! ```text
//! τ = max |n·r| / Σ |n·gᵢ|   over n = gᵢ × gⱼ
//! ```
//!
//! A zonotope that is flat, or a line segment, has no such facets. The normals that bound it within its plane or line
//! are therefore tried too. Every direction n gives a lower bound of τ, so additional directions do no harm.
//!
//! [`zonotope_gauge`] evaluates this formula. [`zonotope_gauge_bound`] and [`quick_gauge_bound`] return upper bounds
//! in linear time, from the combination with the least sum of squared coefficients.
//!
//! Reference: Ziegler, Lectures on Polytopes, 1995, chapter 7 (zonotopes); Rockafellar, Convex Analysis, 1970, §15
//! (gauges).

/// A vector in space.
pub type Vec3 = [f64; 3];

/// Up to this number of generators, all pairs are tested. Larger sets are first reduced by adding up similar
/// generators.
///
/// The test takes m³ steps for m generators. If generators are added up, the result can be larger than the gauge.
const MAX_GENERATORS: usize = 40;

/// Above this number, generators are first added up by direction cells, because merging by pairs also takes m³ steps.
const MAX_PAIRED_GENERATORS: usize = 120;

/// Up to this number of generators, the exact gauge takes no longer to compute than an upper bound.
const MAX_GENERATORS_TESTED_AT_ONCE: usize = 12;

/// A bound of the relative rounding error of a sum of three products, with some reserve.
///
/// If it were ten times smaller, rounding could give a flat zonotope a width, and a point outside its plane a finite
/// τ. If it were ten times larger, τ would be several per cent too large if the width of a zonotope is 10⁻¹² of its
/// length.
const ROUNDING_TOL: f64 = 16.0 * f64::EPSILON;

/// Returns the gauge of a zonotope: the smallest factor τ for which `point` lies in the zonotope scaled by τ. Infinity
/// if there is no such factor. The zonotope is the set { Σ aᵢ gᵢ : |aᵢ| ≤ 1 } of the generators gᵢ.
///
/// The result is never too small. It is exact up to rounding for at most 120 generators with at most 40 different
/// directions. Otherwise generators of similar direction are added up, and the result may be too large.
///
/// ```
/// use drystone::internals::geometry::zonotope_gauge;
/// let axes = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
/// assert!((zonotope_gauge(&axes, [1.0, -3.0, 0.0]) - 1.0).abs() < 1e-12);
/// assert_eq!(zonotope_gauge(&axes[..2], [1.0, -3.0, 0.1]), f64::INFINITY);
/// ```
pub fn zonotope_gauge(generators: &[Vec3], point: Vec3) -> f64 {
    if norm(point) == 0.0 {
        return 0.0;
    }
    let longest = generators.iter().map(|g| norm(*g)).fold(0.0, f64::max);
    if longest == 0.0 || !longest.is_finite() || !norm(point).is_finite() {
        return f64::INFINITY;
    }
    // Scale so that the longest generator has length 1; products of very long generators could overflow.
    let scaled = |v: &Vec3| v.map(|x| x / longest);
    let reduced = reduce(generators.iter().map(scaled));
    gauge_over_normals(&reduced, scaled(&point))
}

/// Returns an upper bound of [`zonotope_gauge`]. For up to 12 generators it is the gauge itself.
///
/// The bound is the largest coefficient |aᵢ| of the combination Σ aᵢ gᵢ = `point` with the least Σ aᵢ², found from the
/// normal equations. `None` if the generators are so close to a plane that these equations cannot be solved accurately.
pub fn zonotope_gauge_bound(generators: &[Vec3], point: Vec3) -> Option<f64> {
    if generators.len() <= MAX_GENERATORS_TESTED_AT_ONCE {
        return Some(zonotope_gauge(generators, point));
    }
    // The Gram matrix G = Σ g gᵀ of the scaled generators.
    let longest = generators.iter().map(|g| norm(*g)).fold(0.0, f64::max);
    let mut gram = [[0.0; 3]; 3];
    for g in generators {
        for (row, a) in gram.iter_mut().zip(g) {
            for (sum, b) in row.iter_mut().zip(g) {
                *sum += (a / longest) * (b / longest);
            }
        }
    }
    // Solve G y = point by cofactors. The coefficients are then aᵢ = gᵢ·y.
    let [a, b, c] = gram;
    let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, cofactors[0]);
    let trace = a[0] + b[1] + c[2];
    // If the determinant is less than 10⁻⁹ times the cube of the trace, fewer than seven digits of the coefficients are
    // correct.
    if !(determinant > 1e-9 * trace * trace * trace) {
        return None;
    }
    let scaled = point.map(|v| v / longest);
    let mut y = [0.0; 3];
    for (row, part) in cofactors.iter().zip(scaled) {
        for (sum, v) in y.iter_mut().zip(row) {
            *sum += v * part / determinant;
        }
    }
    let max = generators.iter().map(|g| dot(g.map(|v| v / longest), y).abs()).fold(0.0, f64::max);
    // The factor covers the loss of digits in the division by a small determinant.
    Some(max * (1.0 + 1e-5))
}

/// Returns an upper bound of the result of [`zonotope_gauge`]. This bound is larger than that of
/// [`zonotope_gauge_bound`], but faster to compute.
///
/// Each axis is scaled by the generators' root sum of squares along this axis; the least-squares combination does not
/// depend on this scaling. Without it, the forces on a body that is pushed sideways without friction would form a
/// nearly flat zonotope. `None` if rounding makes the bound unreliable, or if there are more than 40 generators.
pub fn quick_gauge_bound(generators: &[Vec3], point: Vec3) -> Option<f64> {
    if generators.len() > MAX_GENERATORS {
        return None;
    }
    let (mut squares, mut products, mut lengths) = ([0.0; 3], [0.0; 3], 0.0);
    for [x, y, z] in generators {
        let own = [x * x, y * y, z * z];
        for (sum, square) in squares.iter_mut().zip(own) {
            *sum += square;
        }
        for (sum, product) in products.iter_mut().zip([y * z, z * x, x * y]) {
            *sum += product;
        }
        lengths += (own[0] + own[1] + own[2]).sqrt();
    }
    // The scaled Gram matrix has ones on its diagonal and p, q, r off the diagonal.
    let [a, b, c] = squares.map(f64::sqrt);
    let [p, q, r] = [products[0] / (b * c), products[1] / (c * a), products[2] / (a * b)];
    let determinant = 1.0 + 2.0 * p * q * r - p * p - q * q - r * r;
    // The determinant lies between 0 and 1. If it is below 10⁻³, the generators are so close to a plane that rounding
    // matters.
    if !(determinant > 1e-3) {
        return None;
    }
    // Solve by cofactors and scale the solution back to the units of the axes.
    let [x, y, z] = [point[0] / a, point[1] / b, point[2] / c];
    let solution = [
        ((1.0 - p * p) * x + (p * q - r) * y + (r * p - q) * z) / (determinant * a),
        ((p * q - r) * x + (1.0 - q * q) * y + (q * r - p) * z) / (determinant * b),
        ((r * p - q) * x + (q * r - p) * y + (1.0 - r * r) * z) / (determinant * c),
    ];
    let max = generators.iter().map(|g| dot(*g, solution).abs()).fold(0.0, f64::max);
    // `zonotope_gauge` subtracts rounding from each width of the zonotope. No width is less than the square root of the
    // Gram matrix's smallest eigenvalue. With ones on the diagonal, this eigenvalue is at least 4/9 of the determinant.
    let min_width = (determinant * 4.0 / 9.0).sqrt() * a.min(b).min(c);
    let rounding = 2.0 * ROUNDING_TOL * lengths / min_width;
    let bound = max * (1.0 + 1e-4 + 2.0 * rounding) + ROUNDING_TOL * norm(point) / min_width;
    let is_reliable = rounding < 0.25 && solution.iter().all(|v| v.is_finite()) && bound.is_finite();
    is_reliable.then_some(bound)
}

/// Returns the gauge of a zonotope at `point`: the largest |n·point| / Σ |n·gᵢ| over all normals n that can bound the
/// zonotope. No generator gᵢ may be longer than 1.
fn gauge_over_normals(generators: &[Vec3], point: Vec3) -> f64 {
    let by_length = |a: &Vec3, b: &Vec3| norm(*a).total_cmp(&norm(*b));
    let Some(longest) = generators.iter().copied().max_by(by_length) else {
        return f64::INFINITY;
    };
    let mut gauge: f64 = 0.0;
    let rounding = Rounding {
        distance: ROUNDING_TOL * norm(point),
        width: ROUNDING_TOL * generators.iter().map(|g| norm(*g)).sum::<f64>(),
    };
    let mut try_normal = |normal: Vec3| {
        let length = norm(normal);
        if length > 0.0 {
            let normal = normal.map(|v| v / length);
            gauge = gauge.max(ratio(generators, point, normal, rounding));
        }
    };
    // Try the normals of the facets. Each facet is spanned by a pair of generators.
    for (k, a) in generators.iter().enumerate() {
        for b in &generators[..k] {
            try_normal(cross(*a, *b));
        }
    }
    // `plane` is the normal of the plane in which a flat zonotope lies. If the zonotope is a line segment, `plane` is
    // the normal of any plane through the segment.
    let plane = generators
        .iter()
        .map(|g| cross(longest, *g))
        .max_by(by_length)
        .filter(|n| norm(*n) > ROUNDING_TOL * norm(longest) * norm(longest));
    let plane = plane.unwrap_or_else(|| {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let across = axes.map(|axis| cross(longest, axis));
        across.into_iter().max_by(by_length).unwrap_or_default()
    });
    // Try the normal of the plane, and the direction of the longest generator, which bounds a line segment. Then try
    // two directions for each generator: the normal of the generator within the plane, and the direction perpendicular
    // to this normal and to the generator, which is the plane's normal up to rounding.
    try_normal(plane);
    try_normal(longest);
    for g in generators {
        let in_plane = cross(plane, *g);
        try_normal(in_plane);
        try_normal(cross(in_plane, *g));
    }
    gauge
}

/// Bounds of the rounding errors of the two sums in [`ratio`].
#[derive(Clone, Copy)]
struct Rounding {
    /// Bound of the error of |n·point|.
    distance: f64,
    /// Bound of the error of Σ |n·gᵢ|.
    width: f64,
}

/// Returns |n·point| / Σ |n·gᵢ| for the normal n, a lower bound of the gauge. The rounding error is subtracted from the
/// width Σ |n·gᵢ|, so that the gauge is never too small. The result is 0 if |n·point| is only rounding, and infinity if
/// no width remains.
fn ratio(generators: &[Vec3], point: Vec3, normal: Vec3, rounding: Rounding) -> f64 {
    let distance = dot(normal, point).abs();
    if distance <= rounding.distance {
        return 0.0;
    }
    let width: f64 = generators.iter().map(|g| dot(normal, *g).abs()).sum();
    let certain_width = width - rounding.width;
    if certain_width > 0.0 { distance / certain_width } else { f64::INFINITY }
}

/// Returns at most [`MAX_GENERATORS`] generators. Their zonotope lies within the zonotope of the generators passed in.
///
/// Replacing two generators by their sum can only make the zonotope smaller and the gauge larger. Adding up parallel
/// generators does not change the zonotope.
fn reduce(generators: impl ExactSizeIterator<Item = Vec3>) -> Vec<Vec3> {
    // If there are very many generators, add up those in the same cell of directions. Otherwise add up only parallel
    // ones.
    let use_cells = generators.len() > MAX_PAIRED_GENERATORS;
    let mut reduced: Vec<Vec3> = Vec::with_capacity(generators.len().min(MAX_PAIRED_GENERATORS));
    let cells = if use_cells { 3 * CELLS_PER_SIDE * CELLS_PER_SIDE } else { 0 };
    let mut cell_sums: Vec<Vec3> = vec![[0.0; 3]; cells];
    for g in generators.filter(|g| norm(*g) > 0.0) {
        if use_cells {
            let cell_sum = &mut cell_sums[direction_cell(g)];
            *cell_sum = aligned_sum(*cell_sum, g);
            continue;
        }
        let is_parallel = |a: &Vec3| norm(cross(*a, g)) <= ROUNDING_TOL * norm(*a) * norm(g);
        match reduced.iter_mut().find(|a| is_parallel(a)) {
            Some(a) => *a = aligned_sum(*a, g),
            None => reduced.push(g),
        }
    }
    reduced.extend(cell_sums.into_iter().filter(|g| norm(*g) > 0.0));
    // Until few enough generators are left, add up the pair for which the zonotope shrinks least.
    while reduced.len() > MAX_GENERATORS {
        let mut best = (f64::INFINITY, 0, 1);
        for i in 0..reduced.len() {
            for j in i + 1..reduced.len() {
                // The loss is the length of the component of the shorter generator that is perpendicular to the longer
                // one.
                let (a, b) = (reduced[i], reduced[j]);
                let loss = norm(cross(a, b)) / norm(a).max(norm(b));
                if loss < best.0 {
                    best = (loss, i, j);
                }
            }
        }
        let (_, i, j) = best;
        reduced[i] = aligned_sum(reduced[i], reduced[j]);
        reduced.swap_remove(j);
    }
    reduced
}

/// The faces of a cube around the origin are divided into square cells, to group generators by their directions. This
/// is the number of cells along each edge of a face.
const CELLS_PER_SIDE: usize = 6;

/// Returns the index of the cell, on a face of a cube, to which the vector `g` points. Opposite faces share their
/// cells, so opposite vectors belong to the same cell.
fn direction_cell(g: Vec3) -> usize {
    let axis = (0..3).max_by(|i, j| g[*i].abs().total_cmp(&g[*j].abs())).unwrap_or(0);
    let place = |k: usize| {
        let share = 0.5 * (g[(axis + k) % 3] / g[axis] + 1.0);
        ((share * CELLS_PER_SIDE as f64) as usize).min(CELLS_PER_SIDE - 1)
    };
    (axis * CELLS_PER_SIDE + place(1)) * CELLS_PER_SIDE + place(2)
}

/// Returns the sum of two generators. The second generator is reversed if the angle between them exceeds 90°.
fn aligned_sum(a: Vec3, b: Vec3) -> Vec3 {
    let sign = if dot(a, b) < 0.0 { -1.0 } else { 1.0 };
    [a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2]]
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests;
