//! The outlines of blocks and ground in random scenes, without weights.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use crate::random::Random;

type Cell = (i64, i64);

/// Blocks of up to four squares, dropped one after the other onto the ground and the earlier blocks.
pub fn square_pile(chance: &mut Random) -> Value {
    let mut taken = BTreeSet::new();
    let mut ground = Vec::new();
    for x in 0..5 {
        if chance.percent(80) {
            let height = if chance.percent(20) { 1 } else { 0 };
            let column: Vec<Cell> = (-1..height).map(|y| (x, y)).collect();
            taken.extend(column.iter().copied());
            ground.push(json!({ "cells": column.iter().map(|c| [c.0, c.1]).collect::<Vec<_>>() }));
        }
    }
    let mut blocks = Vec::new();
    for _ in 0..chance.whole(1, 8) {
        let mut piece: Vec<Cell> = vec![(chance.whole(0, 4), 0)];
        for _ in 0..chance.whole(0, 3) {
            let (x, y) = chance.one_of(&piece);
            let next = chance.one_of(&[(x + 1, y), (x - 1, y), (x, y + 1)]);
            if !piece.contains(&next) {
                piece.push(next);
            }
        }
        let free = |down: i64| piece.iter().all(|c| !taken.contains(&(c.0, c.1 + 40 - down)));
        let fall = (0..=40).take_while(|down| free(*down)).last().unwrap_or(0);
        let rise = if chance.percent(5) { 1 } else { 0 };
        piece.iter_mut().for_each(|c| c.1 += 40 - fall + rise);
        taken.extend(piece.iter().copied());
        blocks.push(json!({ "cells": piece.iter().map(|c| [c.0, c.1]).collect::<Vec<_>>() }));
    }
    json!({ "grid": { "kind": "square", "side": chance.one_of(&[1.0, 0.5, 0.1]) }, "ground": ground, "blocks": blocks })
}

/// A triangle of the lattice: column, row, and whether it points up.
type Triangle = (i64, i64, bool);

/// Blocks of one to six triangles. Each begins with a free triangle next to the ground or an earlier block.
pub fn triangular_pile(chance: &mut Random) -> Value {
    let neighbours = |(x, y, up): Triangle| {
        if up {
            [(x, y, false), (x - 1, y + 1, false), (x, y + 1, false)]
        } else {
            [(x, y, true), (x + 1, y - 1, true), (x, y - 1, true)]
        }
    };
    let buried = |c: Triangle| if c.2 { c.1 < 0 } else { c.1 < 1 };
    let written = |c: &Triangle| json!([c.0, c.1, if c.2 { "up" } else { "down" }]);
    let foot: Vec<Triangle> = (-2..4).filter(|_| chance.percent(75)).map(|x| (x, 0, false)).collect();
    let foot = if foot.is_empty() { vec![(0, 0, false)] } else { foot };
    let mut taken: BTreeSet<Triangle> = foot.iter().copied().collect();
    let mut blocks = Vec::new();
    for _ in 0..chance.whole(1, 8) {
        let around = |cells: &mut dyn Iterator<Item = Triangle>, taken: &BTreeSet<Triangle>| -> Vec<Triangle> {
            let all: BTreeSet<Triangle> = cells.flat_map(neighbours).collect();
            all.into_iter().filter(|c| !taken.contains(c) && !buried(*c)).collect()
        };
        let free = around(&mut taken.iter().copied(), &taken);
        if free.is_empty() {
            break;
        }
        let mut piece = vec![chance.one_of(&free)];
        taken.insert(piece[0]);
        for _ in 0..chance.one_of(&[0, 1, 2, 3, 5, 5]) {
            let free = around(&mut piece.iter().copied(), &taken);
            if free.is_empty() {
                break;
            }
            piece.push(chance.one_of(&free));
            taken.extend(piece.last().copied());
        }
        blocks.push(json!({ "cells": piece.iter().map(written).collect::<Vec<_>>() }));
    }
    let ground: Vec<Value> = foot.iter().map(|c| json!({ "cells": [written(c)] })).collect();
    json!({ "grid": { "kind": "triangular" }, "ground": ground, "blocks": blocks })
}

/// Courses of bricks of random widths at random positions, rotated so that `along` is the direction of a course.
///
/// The components of `along` and its length are integers, so the rotated corners are exact.
pub fn bricks(chance: &mut Random, along: [i64; 2]) -> Value {
    let place = |x: i64, y: i64| {
        let (c, s) = (along[0] as f64 / 8.0, along[1] as f64 / 8.0);
        json!([x as f64 * c - y as f64 * s, x as f64 * s + y as f64 * c])
    };
    let box_of = |x: i64, y: i64, width: i64, height: i64| json!({ "polygon": [place(x, y), place(x + width, y), place(x + width, y + height), place(x, y + height)] });
    let mut ground = vec![box_of(-24, -8, 48, 8)];
    if chance.percent(30) {
        ground.push(box_of(-24, 0, 8, chance.whole(4, 24)));
    }
    if chance.percent(20) {
        ground.push(box_of(16, 0, 8, chance.whole(4, 24)));
    }
    let wanted = chance.whole(1, 8);
    let mut blocks = Vec::new();
    let mut below = (-16, 16);
    let mut y = 0;
    while (blocks.len() as i64) < wanted {
        let height = chance.one_of(&[2, 4, 4, 8]);
        let mut x = if y == 0 { chance.whole(-16, 0) } else { chance.whole(below.0 - 6, below.1 - 1) };
        x = x.max(-16);
        let left = x;
        let mut right = x;
        for _ in 0..chance.whole(1, 3) {
            let width = chance.one_of(&[2, 4, 6, 8, 8, 12, 16]).min(16 - x);
            if (blocks.len() as i64) >= wanted || width < 2 {
                break;
            }
            blocks.push(box_of(x, y, width, height));
            right = x + width;
            x = right + chance.one_of(&[0, 0, 1, 4]);
        }
        below = if right > left { (left, right) } else { below };
        y += height;
    }
    json!({ "ground": ground, "blocks": blocks })
}

/// A rectangle cut by straight lines, on a floor, sometimes between walls, sometimes with one piece missing.
pub fn cut_wall(chance: &mut Random) -> Value {
    loop {
        let (width, height) = (chance.whole(4, 16) as f64 / 4.0, chance.whole(3, 12) as f64 / 4.0);
        let mut pieces = vec![vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]];
        for _ in 0..chance.whole(1, 4) {
            let through = [chance.share() * width, chance.share() * height];
            let angle = chance.share() * std::f64::consts::PI;
            let normal = [libm::cos(angle), libm::sin(angle)];
            pieces = pieces.iter().flat_map(|p| cut(p, through, normal)).filter(|p| p.len() > 2).collect();
        }
        if chance.percent(40) && pieces.len() > 1 {
            pieces.swap_remove(chance.whole(0, pieces.len() as i64 - 1) as usize);
        }
        let long = |p: &Vec<[f64; 2]>| {
            (0..p.len()).all(|i| {
                let (a, b) = (p[i], p[(i + 1) % p.len()]);
                libm::hypot(b[0] - a[0], b[1] - a[1]) > 0.02
            })
        };
        if pieces.len() > 8 || !pieces.iter().all(long) {
            continue;
        }
        let mut ground = vec![json!({ "polygon": [[-2, -1], [width + 2.0, -1], [width + 2.0, 0], [-2, 0]] })];
        if chance.percent(40) {
            ground.push(json!({ "polygon": [[-2, 0], [0, 0], [0, height], [-2, height]] }));
        }
        if chance.percent(40) {
            ground.push(json!({ "polygon": [[width, 0], [width + 2.0, 0], [width + 2.0, height], [width, height]] }));
        }
        let blocks: Vec<Value> = pieces.iter().map(|p| json!({ "polygon": p })).collect();
        return json!({ "ground": ground, "blocks": blocks });
    }
}

/// The two parts into which a line cuts a convex piece; one may be empty. Neighbours that share an edge have exactly
/// the same new corner on it.
fn cut(piece: &[[f64; 2]], through: [f64; 2], normal: [f64; 2]) -> [Vec<[f64; 2]>; 2] {
    let side = |p: [f64; 2]| normal[0] * (p[0] - through[0]) + normal[1] * (p[1] - through[1]);
    let (mut above, mut below) = (Vec::new(), Vec::new());
    for i in 0..piece.len() {
        let (a, b) = (piece[i], piece[(i + 1) % piece.len()]);
        if side(a) > 0.0 {
            above.push(a)
        } else {
            below.push(a)
        }
        if (side(a) > 0.0) != (side(b) > 0.0) {
            let (low, high) = if (a[0], a[1]) < (b[0], b[1]) { (a, b) } else { (b, a) };
            let t = side(low) / (side(low) - side(high));
            let corner = [low[0] + t * (high[0] - low[0]), low[1] + t * (high[1] - low[1])];
            above.push(corner);
            below.push(corner);
        }
    }
    [above, below]
}

/// Voussoirs of uneven thickness between two abutments. Coordinates are rounded to 1/64.
pub fn arch(chance: &mut Random) -> Value {
    let n = chance.whole(1, 7);
    let (inner, thickness) = (1.0, 0.1 + chance.share() * 0.6);
    let (from, to) = (chance.share() * 0.9, 3.1 - chance.share() * 0.9);
    let round = |v: f64| (v * 64.0).round() / 64.0;
    let at = |radius: f64, angle: f64| [round(-radius * libm::cos(angle)), round(radius * libm::sin(angle))];
    let mut joints = Vec::new();
    for k in 0..=n {
        let angle = from + (to - from) * k as f64 / n as f64;
        let turn = if chance.percent(30) { (chance.share() - 0.5) * 0.3 } else { 0.0 };
        let outer = inner + thickness * (1.0 + 0.3 * chance.share());
        joints.push([at(inner, angle + turn / n as f64), at(outer, angle - turn / n as f64)]);
    }
    let voussoir = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| json!({ "polygon": [a[0], a[1], b[1], b[0]] });
    let blocks: Vec<Value> = joints.windows(2).map(|j| voussoir(j[0], j[1])).collect();
    let beyond = |[i, o]: [[f64; 2]; 2], sign: f64| {
        let back = [sign * 0.5 * (o[1] - i[1]), -sign * 0.5 * (o[0] - i[0])];
        voussoir([i, o], [i, o].map(|p| [p[0] + back[0], p[1] + back[1]]))
    };
    let ground = [beyond(joints[0], -1.0), beyond(joints[n as usize], 1.0)];
    json!({ "ground": ground, "blocks": blocks })
}
