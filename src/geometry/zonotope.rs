//! How far a point of space is from being a bounded combination of given directions.
//!
//! The zonotope of generators g₁ … gₘ is the set { Σ aᵢ gᵢ : |aᵢ| ≤ 1 }. [`zonotope_gauge`] finds the smallest τ for which a
//! point lies in τ times it. A convex body is the intersection of the half-spaces of its facets, a zonotope's facets are
//! spanned by pairs of its generators, and its half-width along n is Σ |n·gᵢ|; so
//!
//! ```text
//! τ = max |n·r| / Σ |n·gᵢ|   over n = gᵢ × gⱼ
//! ```
//!
//! A zonotope that is flat or a single line has no such facets; the normals that bound it within its plane or line are
//! tried as well. Any direction n gives a lower bound of τ, so more of them never harm.

/// A point or direction of space.
pub type Triple = [f64; 3];

/// Generators beyond this number are added up in pairs of like direction, which makes the zonotope smaller.
const MOST: usize = 40;

/// Beyond this number they are first added up by cells of direction, so that the work stays bounded.
const MANY: usize = 120;

/// So few generators are tested at once; for more a combination of least squares may do.
const FEW: usize = 12;

/// Several times the rounding of a sum of three products.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The smallest τ for which `point` lies in τ times the zonotope of the generators; infinite where there is none.
///
/// Exact to rounding for up to 40 generators that are not parallel, and never too small: with more of them, those of like
/// direction are added up, and the answer may be larger than the smallest.
///
/// ```
/// use drystone::internals::geometry::zonotope_gauge;
/// let box_of = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
/// assert!((zonotope_gauge(&box_of, [1.0, -3.0, 0.0]) - 1.0).abs() < 1e-12);
/// assert_eq!(zonotope_gauge(&box_of[..2], [1.0, -3.0, 0.1]), f64::INFINITY);
/// ```
pub fn zonotope_gauge(generators: &[Triple], point: Triple) -> f64 {
    if norm(point) == 0.0 {
        return 0.0;
    }
    let size = generators.iter().map(|g| norm(*g)).fold(0.0, f64::max);
    if size == 0.0 || !size.is_finite() || !norm(point).is_finite() {
        return f64::INFINITY;
    }
    let unit = |v: &Triple| v.map(|x| x / size);
    let few = merged(generators.iter().map(unit));
    exact(&few, unit(&point))
}

/// An upper bound of [`zonotope_gauge`], found without looking at facets: the largest |aᵢ| of the combination Σ aᵢ gᵢ of least
/// squares that gives the point. `None` where the generators do not span space well enough to tell.
pub fn zonotope_gauge_bound(generators: &[Triple], point: Triple) -> Option<f64> {
    if generators.len() <= FEW {
        return Some(zonotope_gauge(generators, point));
    }
    let size = generators.iter().map(|g| norm(*g)).fold(0.0, f64::max);
    let mut gram = [[0.0; 3]; 3];
    for g in generators {
        for (row, a) in gram.iter_mut().zip(g) {
            for (sum, b) in row.iter_mut().zip(g) {
                *sum += (a / size) * (b / size);
            }
        }
    }
    let [a, b, c] = gram;
    let minors = [cross(b, c), cross(c, a), cross(a, b)];
    let volume = dot(a, minors[0]);
    let trace = a[0] + b[1] + c[2];
    // Below this the digits of the combination are not enough to believe it.
    if !(volume > 1e-9 * trace * trace * trace) {
        return None;
    }
    let unit = point.map(|v| v / size);
    let mut y = [0.0; 3];
    for (row, part) in minors.iter().zip(unit) {
        for (sum, v) in y.iter_mut().zip(row) {
            *sum += v * part / volume;
        }
    }
    let most = generators
        .iter()
        .map(|g| dot(g.map(|v| v / size), y).abs())
        .fold(0.0, f64::max);
    Some(most * (1.0 + 1e-5))
}

/// A bound that [`zonotope_gauge`] never answers above, without looking at facets: as [`zonotope_gauge_bound`], for any number of
/// generators up to that from which on they are added up. `None` where digits do not suffice to tell.
///
/// The combination of least squares does not depend on the units of the axes, so each axis is measured by what the
/// generators reach along it. A body without friction that pushes sideways is then no nearly flat zonotope.
pub fn quick_gauge_bound(generators: &[Triple], point: Triple) -> Option<f64> {
    if generators.len() > MOST {
        return None;
    }
    let (mut squares, mut products, mut sum) = ([0.0; 3], [0.0; 3], 0.0);
    for [x, y, z] in generators {
        let own = [x * x, y * y, z * z];
        for (sum, square) in squares.iter_mut().zip(own) {
            *sum += square;
        }
        for (sum, product) in products.iter_mut().zip([y * z, z * x, x * y]) {
            *sum += product;
        }
        sum += (own[0] + own[1] + own[2]).sqrt();
    }
    let [a, b, c] = squares.map(f64::sqrt);
    let [p, q, r] = [
        products[0] / (b * c),
        products[1] / (c * a),
        products[2] / (a * b),
    ];
    // The Gram matrix with ones on its diagonal, whose determinant is at most 9/4 times its smallest eigenvalue.
    let volume = 1.0 + 2.0 * p * q * r - p * p - q * q - r * r;
    if !(volume > 1e-3) {
        return None;
    }
    let [x, y, z] = [point[0] / a, point[1] / b, point[2] / c];
    let amounts = [
        ((1.0 - p * p) * x + (p * q - r) * y + (r * p - q) * z) / (volume * a),
        ((p * q - r) * x + (1.0 - q * q) * y + (q * r - p) * z) / (volume * b),
        ((r * p - q) * x + (q * r - p) * y + (1.0 - r * r) * z) / (volume * c),
    ];
    let most = generators
        .iter()
        .map(|g| dot(*g, amounts).abs())
        .fold(0.0, f64::max);
    // No width is less, and so much rounding counts against the generators and for the point.
    let narrowest = (volume * 4.0 / 9.0).sqrt() * a.min(b).min(c);
    let rounding = 2.0 * ROUNDING * sum / narrowest;
    let bound = most * (1.0 + 1e-4 + 2.0 * rounding) + ROUNDING * norm(point) / narrowest;
    let sure = rounding < 0.25 && amounts.iter().all(|v| v.is_finite()) && bound.is_finite();
    sure.then_some(bound)
}

/// The test itself, on generators of size up to 1.
fn exact(generators: &[Triple], point: Triple) -> f64 {
    let longest = generators
        .iter()
        .copied()
        .max_by(|a, b| norm(*a).total_cmp(&norm(*b)));
    let Some(longest) = longest else {
        return f64::INFINITY;
    };
    let mut worst: f64 = 0.0;
    let rounding = Rounding {
        off: ROUNDING * norm(point),
        width: ROUNDING * generators.iter().map(|g| norm(*g)).sum::<f64>(),
    };
    let mut along = |normal: Triple| {
        let length = norm(normal);
        if length > 0.0 {
            let normal = normal.map(|v| v / length);
            worst = worst.max(ratio(generators, point, normal, rounding));
        }
    };
    for (k, a) in generators.iter().enumerate() {
        for b in &generators[..k] {
            along(cross(*a, *b));
        }
    }
    // What bounds a flat zonotope within its plane, and a line along and beside itself.
    let widest = generators
        .iter()
        .map(|g| cross(longest, *g))
        .max_by(|a, b| norm(*a).total_cmp(&norm(*b)))
        .filter(|n| norm(*n) > ROUNDING * norm(longest) * norm(longest));
    let plane = widest.unwrap_or_else(|| {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let across = axes.map(|axis| cross(longest, axis));
        across
            .into_iter()
            .max_by(|a, b| norm(*a).total_cmp(&norm(*b)))
            .unwrap_or_default()
    });
    along(plane);
    along(longest);
    for g in generators {
        let beside = cross(plane, *g);
        along(beside);
        along(cross(beside, *g));
    }
    worst
}

/// By how much the two sums of a [`ratio`] may be off.
#[derive(Clone, Copy)]
struct Rounding {
    off: f64,
    width: f64,
}

/// |n·r| / Σ |n·gᵢ|, its rounding counted against the generators.
fn ratio(generators: &[Triple], point: Triple, normal: Triple, rounding: Rounding) -> f64 {
    let off = dot(normal, point).abs();
    if off <= rounding.off {
        return 0.0;
    }
    let width: f64 = generators.iter().map(|g| dot(normal, *g).abs()).sum();
    let sure = width - rounding.width;
    if sure > 0.0 {
        off / sure
    } else {
        f64::INFINITY
    }
}

/// Generators that differ: parallel ones added up, and those of like direction where they are many.
///
/// The sum of two generators stands for them within their zonotope, never beyond it.
fn merged(generators: impl ExactSizeIterator<Item = Triple>) -> Vec<Triple> {
    let mut all: Vec<Triple> = Vec::with_capacity(generators.len().min(MANY));
    let cells = generators.len() > MANY;
    let mut bins: Vec<Triple> = vec![[0.0; 3]; if cells { 3 * CELLS * CELLS } else { 0 }];
    for g in generators.filter(|g| norm(*g) > 0.0) {
        if cells {
            let bin = &mut bins[cell(g)];
            *bin = sum(*bin, g);
            continue;
        }
        let parallel = |a: &Triple| norm(cross(*a, g)) <= ROUNDING * norm(*a) * norm(g);
        match all.iter_mut().find(|a| parallel(a)) {
            Some(a) => *a = sum(*a, g),
            None => all.push(g),
        }
    }
    all.extend(bins.into_iter().filter(|g| norm(*g) > 0.0));
    while all.len() > MOST {
        let mut best = (f64::INFINITY, 0, 1);
        for i in 0..all.len() {
            for j in i + 1..all.len() {
                // What is lost: the part of the smaller one across the larger.
                let lost = norm(cross(all[i], all[j])) / norm(all[i]).max(norm(all[j]));
                if lost < best.0 {
                    best = (lost, i, j);
                }
            }
        }
        let (_, i, j) = best;
        all[i] = sum(all[i], all[j]);
        all.swap_remove(j);
    }
    all
}

/// Cells along each side of a face of the cube of directions.
const CELLS: usize = 6;

/// The cell of a direction, the same for its opposite.
fn cell(g: Triple) -> usize {
    let axis = (0..3)
        .max_by(|i, j| g[*i].abs().total_cmp(&g[*j].abs()))
        .unwrap_or(0);
    let place = |k: usize| {
        let share = 0.5 * (g[(axis + k) % 3] / g[axis] + 1.0);
        ((share * CELLS as f64) as usize).min(CELLS - 1)
    };
    (axis * CELLS + place(1)) * CELLS + place(2)
}

/// The sum of two generators, the second turned to point as the first does.
fn sum(a: Triple, b: Triple) -> Triple {
    let sign = if dot(a, b) < 0.0 { -1.0 } else { 1.0 };
    [a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2]]
}

fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Triple, b: Triple) -> Triple {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn norm(a: Triple) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests;
