//! Compares derivatives of margins with difference quotients, for which scenes are changed and analysed again.

use drystone::analysis::{CornerMoves, EndSensitivity, MarginKind, NoSensitivity, Options, Sensitivity, Slope};
use drystone::internals::geometry::Vector;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::oracle::number_of;
use crate::random::Random;
use crate::structure::{block, on_floor, rectangle, scene, wall};

/// The sensitivity of the first frame.
fn sensitivity(file: &Value, kind: MarginKind) -> Sensitivity {
    of_scene(&scene(file), kind)
}

fn of_scene(scene: &Scene, kind: MarginKind) -> Sensitivity {
    let options = Options::default().sensitivity(kind);
    let analysis = Analysis::with(scene, &options);
    analysis.frames[0].sensitivity.clone().expect("requested")
}

/// An end of the margin: the upper one if `is_high`.
fn end(file: &Value, kind: MarginKind, is_high: bool) -> Result<EndSensitivity, NoSensitivity> {
    let found = sensitivity(file, kind);
    if is_high { found.high } else { found.low }
}

/// A change of one number in a scene file. The methods return `None` if the changed file has no such margin.
#[derive(Clone, Copy)]
struct Change<'a> {
    file: &'a Value,
    kind: MarginKind,
    is_high: bool,
    step: f64,
    apply: &'a dyn Fn(&mut Value, f64),
}

impl Change<'_> {
    /// The end of the margin after the number is changed by `by`.
    fn value(&self, by: f64) -> Option<f64> {
        let mut file = self.file.clone();
        (self.apply)(&mut file, by);
        let scene = Scene::from_json(&file.to_string()).ok()?;
        let found = of_scene(&scene, self.kind);
        let end = if self.is_high { found.high } else { found.low };
        Some(end.ok()?.value)
    }

    /// The backward and the forward derivative, each extrapolated from the differences of two steps.
    fn slopes(&self) -> Option<[f64; 2]> {
        let h = self.step;
        let here = self.value(0.0)?;
        let side = |sign: f64| {
            let [near, far] = [h, 2.0 * h].map(|by| self.value(sign * by));
            let [near, far] = [near? - here, far? - here];
            Some((2.0 * near - 0.5 * far) / (sign * h))
        };
        Some([side(-1.0)?, side(1.0)?])
    }

    /// The central difference, extrapolated from two steps.
    fn central(&self) -> Option<f64> {
        let difference = |h: f64| Some((self.value(h)? - self.value(-h)?) / (2.0 * h));
        let [near, far] = [difference(self.step)?, difference(2.0 * self.step)?];
        Some((4.0 * near - far) / 3.0)
    }
}

/// All polygons of a file, ground first.
fn polygons(file: &Value) -> Vec<(&'static str, usize, Vec<[f64; 2]>)> {
    let mut all = Vec::new();
    for list in ["ground", "blocks"] {
        for (k, body) in file[list].as_array().into_iter().flatten().enumerate() {
            let corners = body["polygon"].as_array().expect("a polygon");
            let corner = |c: &Value| [0, 1].map(|i| c[i].as_f64().expect("a number"));
            all.push((list, k, corners.iter().map(corner).collect()));
        }
    }
    all
}

/// Moves all corners at a point. Corners inside an edge that this rotates are moved with the edge, by iteration.
fn move_corner(file: &mut Value, at: [f64; 2], by: [f64; 2]) {
    let all = polygons(file);
    let points: Vec<[f64; 2]> = all.iter().flat_map(|p| p.2.clone()).collect();
    let near = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]) < 1e-9;
    let mut moved: Vec<[f64; 2]> = points.iter().map(|p| if near(*p, at) { by } else { [0.0; 2] }).collect();
    // For each corner inside an edge of another body: the corner, the ends of the edge, the position along it and its
    // normal.
    let mut guides = Vec::new();
    let mut first = 0;
    for (.., ring) in &all {
        for k in 0..ring.len() {
            let (a, b) = (first + k, first + (k + 1) % ring.len());
            let along = [points[b][0] - points[a][0], points[b][1] - points[a][1]];
            let long = libm::hypot(along[0], along[1]);
            for (c, p) in points.iter().enumerate() {
                let from = [p[0] - points[a][0], p[1] - points[a][1]];
                let share = (from[0] * along[0] + from[1] * along[1]) / (long * long);
                let off = (along[0] * from[1] - along[1] * from[0]) / long;
                if off.abs() < 1e-9 && share * long > 1e-9 && (1.0 - share) * long > 1e-9 {
                    guides.push((c, a, b, share, [-along[1] / long, along[0] / long]));
                }
            }
        }
        first += ring.len();
    }
    for _ in 0..400 {
        let mut most: f64 = 0.0;
        for (c, a, b, share, n) in &guides {
            let normal = |k: usize| moved[k][0] * n[0] + moved[k][1] * n[1];
            let target = (1.0 - share) * normal(*a) + share * normal(*b) - normal(*c);
            most = most.max(target.abs());
            if target == 0.0 {
                continue;
            }
            for (k, p) in points.iter().enumerate() {
                if near(*p, points[*c]) && k != *c {
                    moved[k] = [moved[k][0] + target * n[0], moved[k][1] + target * n[1]];
                }
            }
            moved[*c] = [moved[*c][0] + target * n[0], moved[*c][1] + target * n[1]];
        }
        if most < 1e-17 {
            break;
        }
    }
    let mut next = 0;
    for (list, k, ring) in all {
        for corner in 0..ring.len() {
            let by = moved[next];
            let place = &mut file[list][k]["polygon"][corner];
            *place = json!([ring[corner][0] + by[0], ring[corner][1] + by[1]]);
            next += 1;
        }
    }
}

/// The counts of the comparison of one scene.
#[derive(Default, Debug)]
pub struct Tally {
    pub slopes: usize,
    pub kinks: usize,
    /// The kinks at which the two one-sided difference quotients differ.
    pub jumps: usize,
    pub skipped: usize,
    /// One of this many derivatives is compared.
    every: usize,
    /// The number of derivatives so far.
    count: usize,
    pub worst: f64,
    pub wrong: Vec<String>,
}

impl Tally {
    fn compare(&mut self, what: &str, slope: Slope, scale: f64, change: &Change) {
        self.count += 1;
        if !self.count.is_multiple_of(self.every) {
            return;
        }
        match slope {
            Slope::Unique(slope) => {
                // If the margin has a kink nearby, a smaller step may not reach it.
                let errors = [1.0, 1.0 / 64.0].into_iter().filter_map(|factor| {
                    let step = factor * change.step;
                    let difference = Change { step, ..*change }.central()?;
                    Some(((slope - difference).abs() / scale, difference))
                });
                let is_small = |found: &(f64, f64)| found.0 <= 1e-6;
                let mut errors = errors.peekable();
                let first = errors.peek().copied();
                let Some((error, difference)) = errors.find(is_small).or(first) else {
                    self.skipped += 1;
                    return;
                };
                self.slopes += 1;
                self.worst = self.worst.max(error);
                if error > 1e-6 {
                    let sides = change.slopes();
                    self.wrong.push(format!("{what}: {slope:.9} instead of {difference:.9}, {sides:?}"));
                }
            }
            _ => {
                let sides = Change { step: change.step / 16.0, ..*change }.slopes().or_else(|| change.slopes());
                self.kinks += 1;
                self.jumps += usize::from(sides.is_some_and(|[a, b]| (a - b).abs() > 1e-5 * scale));
            }
        }
    }
}

/// Compares one of `every` derivatives of an end with difference quotients. `None` if the margin has no such end.
pub fn compared(file: &Value, kind: MarginKind, is_high: bool, every: usize) -> Option<Tally> {
    let found = end(file, kind, is_high).ok()?;
    let mut tally = Tally { every, ..Tally::default() };
    let change = |step: f64, apply: &dyn Fn(&mut Value, f64), slope, what: &str, scale: f64, tally: &mut Tally| {
        let change = Change { file, kind, is_high, step, apply };
        tally.compare(what, slope, scale, &change);
    };
    let size = found.value.abs().max(0.01);
    let mut done: Vec<[f64; 2]> = Vec::new();
    for corner in &found.corners {
        let at = [corner.at.x, corner.at.y];
        if done.iter().any(|p| libm::hypot(p[0] - at[0], p[1] - at[1]) < 1e-9) {
            continue;
        }
        done.push(at);
        let directions = match corner.moves {
            CornerMoves::Freely([x, y]) => vec![([1.0, 0.0], x), ([0.0, 1.0], y)],
            CornerMoves::Along { direction, slope } => vec![([direction.x, direction.y], slope)],
            _ => continue,
        };
        for (direction, slope) in directions {
            let apply = |file: &mut Value, by: f64| {
                move_corner(file, at, direction.map(|v| v * by));
            };
            let what = format!("corner {} of {:?} along {direction:?}", corner.corner, corner.block);
            change(2e-4, &apply, slope, &what, size, &mut tally);
        }
    }
    for (number, (block, slope)) in found.weights.iter().enumerate() {
        let k = block.0;
        let weight = scene(file).blocks()[k].weight;
        let apply = |file: &mut Value, by: f64| {
            let own = file["blocks"][k].as_object_mut().expect("a block");
            own.remove("density");
            own.insert("weight".into(), json!(weight + by));
        };
        let step = 1e-3 * weight.max(1e-3);
        change(step, &apply, *slope, &format!("weight {number}"), size / weight.max(1e-3), &mut tally);
    }
    for load in &found.loads {
        let (k, at, slopes) = (load.entry, load.at, load.slopes);
        for (axis, slope) in slopes.iter().enumerate() {
            let apply = |file: &mut Value, by: f64| {
                let mut at = [at.x, at.y];
                at[axis] += by;
                file["loads"][k]["at"] = json!(at);
            };
            change(2e-4, &apply, *slope, &format!("load {k}, axis {axis}"), size, &mut tally);
        }
    }
    if let Some(slope) = found.friction_of_all {
        let friction = file["friction"].as_f64().expect("a coefficient");
        let apply = |file: &mut Value, by: f64| file["friction"] = json!(friction + by);
        change(1e-4, &apply, slope, "friction", size, &mut tally);
    }
    Some(tally)
}

/// A semicircular arch with centreline radius 1 on two springers that share its end faces, with a load of 1 in the
/// middle of the outer side of one voussoir. `weigh` is an object with the key that sets the weight of each
/// voussoir, `density` or `weight`.
fn loaded_arch(count: usize, thickness: f64, friction: f64, loaded: usize, weigh: &Value) -> Value {
    let radii = [1.0 - thickness / 2.0, 1.0 + thickness / 2.0];
    let at = |k: usize, radius: f64| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * k as f64 / count as f64);
        [-radius * cos, radius * sin]
    };
    let blocks: Vec<Value> = (0..count)
        .map(|k| {
            let corners = [(k, 0), (k + 1, 0), (k + 1, 1), (k, 1)].map(|(k, r)| at(k, radii[r]));
            // Anticlockwise.
            let corners: Vec<[f64; 2]> = corners.into_iter().rev().collect();
            let mut block = json!({ "id": format!("v{k}"), "polygon": corners });
            for (key, value) in weigh.as_object().expect("keys") {
                block[key] = value.clone();
            }
            block
        })
        .collect();
    let springer = |k: usize| {
        let [a, b] = radii.map(|r| at(k, r));
        let mut corners = vec![a, b, [b[0], b[1] - 0.3], [a[0], a[1] - 0.3]];
        if a[0] < b[0] {
            corners.reverse();
        }
        json!({ "polygon": corners })
    };
    let [a, b] = [loaded, loaded + 1].map(|k| at(k, radii[1]));
    let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    json!({ "drystone": 1, "friction": friction, "gravity": [0, -1],
        "ground": [springer(0), springer(count)], "blocks": blocks,
        "loads": [{ "block": format!("v{loaded}"), "force": [0, -1], "at": middle }] })
}

/// An arch of 15 voussoirs, thickness 0.2 and friction 0.6, with a load on voussoir 4, counted from 0. Its load
/// factor, 0.4692019, was known before this program computed derivatives.
#[test]
fn the_derivatives_of_a_loaded_arch_equal_central_differences() {
    let file = loaded_arch(15, 0.2, 0.6, 4, &json!({ "density": 1 }));
    let found = end(&file, MarginKind::LoadFactor, true).expect("a largest factor");
    assert!((found.value - 0.469_201_9).abs() < 5e-8, "{}", found.value);
    let tally = compared(&file, MarginKind::LoadFactor, true, 1).expect("it has an end");
    // The corners of 14 joints and of the two springings: 32 corners, each along x and y.
    assert!(tally.wrong.is_empty(), "{:?}", tally.wrong);
    assert_eq!((tally.kinks, tally.skipped), (0, 0));
    assert_eq!(tally.slopes, 64 + 15 + 2 + 1);
    assert!(tally.worst < 6e-10, "{}", tally.worst);
}

#[test]
fn the_derivatives_of_a_factor_on_the_friction_equal_central_differences() {
    for (count, thickness) in [(5, 0.5), (6, 0.8)] {
        let file = loaded_arch(count, thickness, 0.4, 1, &json!({ "density": 1 }));
        let found = end(&file, MarginKind::FrictionFactor, false).expect("a least factor");
        let all = found.friction_of_all.and_then(|slope| slope.unique()).expect("unique");
        let friction = file["friction"].as_f64().expect("a coefficient");
        // The least coefficient c is fixed, so the factor is c/μ.
        assert!((all + found.value / friction).abs() < 1e-6, "{all} {}", found.value);
        let tally = compared(&file, MarginKind::FrictionFactor, false, 1).expect("it has an end");
        assert!(tally.wrong.is_empty() && tally.slopes > 5, "{tally:?}");
    }
}

/// A random arch, wall or stack with a load.
fn random_scene(random: &mut Random) -> Value {
    let load = |block: &str, random: &mut Random| {
        let force = [random.between(-1.0, 1.0), random.between(-1.5, 0.2)];
        json!([{ "block": block, "force": force }])
    };
    match random.below(3) {
        0 => {
            let count = random.whole(5, 12) as usize;
            let weigh = if random.percent(50) {
                json!({ "density": 1 })
            } else {
                json!({ "weight": random.between(0.1, 0.4) })
            };
            let (thickness, friction) = (random.between(0.12, 0.35), random.between(0.3, 1.0));
            loaded_arch(count, thickness, friction, random.below(count), &weigh)
        }
        1 => {
            let (columns, rows) = (random.whole(1, 3) as usize, random.whole(1, 4) as usize);
            let mut file = wall(columns, rows);
            let blocks = file["blocks"].as_array_mut().expect("blocks");
            for block in blocks.iter_mut() {
                if random.percent(50) {
                    block["weight"] = json!(random.between(3.0, 9.0));
                }
            }
            let last = blocks.len() - 1;
            let name = blocks[last]["id"].as_str().expect("a name").to_owned();
            file["loads"] = load(&name, random);
            file["friction"] = json!(random.between(0.3, 0.9));
            file
        }
        _ => {
            let mut y = 0.0;
            let count = random.whole(1, 5);
            let mut blocks = Vec::new();
            for k in 0..count {
                let (width, high) = (random.between(0.6, 1.6), random.between(0.3, 1.0));
                let x = random.between(-0.2, 0.2) - width / 2.0;
                let polygon = rectangle(x, y, width, high);
                y += high;
                blocks.push(block(&k.to_string(), polygon, random.between(1.0, 9.0)));
            }
            let mut file = on_floor(random.between(0.3, 0.9), blocks);
            file["loads"] = load(&random.below(count as usize).to_string(), random);
            file
        }
    }
}

/// Compares `count` random scenes, beginning with number `first`. Returns the sum of their counts, and the number of
/// ends.
fn random_scenes(first: u64, count: u64, every: usize) -> (Tally, usize) {
    let mut sum = Tally::default();
    let mut ends = 0;
    for seed in first..first + count {
        let mut random = Random::new(seed);
        let file = random_scene(&mut random);
        let kind = random.one_of(&[
            MarginKind::LoadFactor,
            MarginKind::LoadFactor,
            MarginKind::HorizontalLoad,
            MarginKind::Tilt,
            MarginKind::Friction,
            MarginKind::Kernel,
        ]);
        for is_high in [false, true] {
            let Some(tally) = compared(&file, kind, is_high, every) else {
                continue;
            };
            ends += 1;
            sum.slopes += tally.slopes;
            sum.kinks += tally.kinks;
            sum.jumps += tally.jumps;
            sum.skipped += tally.skipped;
            sum.worst = sum.worst.max(tally.worst);
            let wrong = tally.wrong.into_iter();
            sum.wrong.extend(wrong.map(|w| format!("seed {seed} {kind:?} {is_high}: {w}")));
        }
    }
    (sum, ends)
}

/// `DRYSTONE_SENSITIVITY_SCENES=200` compares more scenes, and `DRYSTONE_SENSITIVITY_EVERY=1` compares every
/// derivative instead of one of five.
#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn the_derivatives_of_random_scenes_equal_central_differences() {
    let first = number_of("DRYSTONE_SENSITIVITY_FIRST", 1);
    let wanted = number_of("DRYSTONE_SENSITIVITY_SCENES", 30);
    let every = number_of("DRYSTONE_SENSITIVITY_EVERY", 5) as usize;
    let (sum, ends) = random_scenes(first, wanted, every);
    println!(
        "{ends} ends: {} derivatives, the worst off by {:.1e} of the margin; {} at a kink, {} of them with a jump; {} not compared; {} wrong",
        sum.slopes,
        sum.worst,
        sum.kinks,
        sum.jumps,
        sum.skipped,
        sum.wrong.len()
    );
    assert!(sum.wrong.is_empty(), "{:#?}", sum.wrong);
    assert!(ends as u64 * 3 > 2 * wanted, "{ends} ends, {sum:?}");
    assert!(sum.slopes > 5 * ends, "{ends} ends, {sum:?}");
}

/// A block of 10 N and 2 m × 2 m tips over its right lower corner under 3 times a push of 1 N at a height of 4 m, held by
/// a robot of 1 N per component at the centroid: 4 λ = 10 + 1 + 1. The grip point moves with the centroid, if the file
/// gives none.
#[test]
fn a_grip_without_a_point_moves_with_the_centroid() {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 0.0, 2.0, 2.0), 10.0)]);
    file["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "force": 1 } }]);
    file["loads"] = json!([{ "block": "a", "force": [1, 0], "at": [2, 4] }]);
    let slope = |file: &Value| {
        let found = end(file, MarginKind::LoadFactor, true).expect("a largest factor");
        assert!((found.value - 3.0).abs() < 1e-6, "{}", found.value);
        let tally = compared(file, MarginKind::LoadFactor, true, 1).expect("it has an end");
        assert!(tally.wrong.is_empty(), "{:?}", tally.wrong);
        found.corners[3].moves.gradient().expect("unique")
    };
    // The left upper corner moves by 1 m to the left: the centroid moves by 5/12 m to the left and 1/12 m down or up.
    assert!((slope(&file) - Vector::new(-17.0 / 24.0, 7.0 / 24.0)).norm() < 1e-9);
    file["robots"][0]["at"] = json!([1, 1]);
    assert!((slope(&file) - Vector::new(-15.0 / 24.0, 5.0 / 24.0)).norm() < 1e-9);
}
