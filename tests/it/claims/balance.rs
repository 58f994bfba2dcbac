//! Forces are compared with the outlines: their positions, their balance, and the numbers of the proof. Everything is
//! summed again from the scene's outlines and the JSON of the result, in plain arithmetic.

use drystone::Analysis;
use drystone::analysis::Proof;
use serde_json::Value;

use super::{Checked, cross, dot, less, list, number, pair, structures};
use crate::structure::scene;

/// The forces on one block.
#[derive(Default)]
struct Acting {
    force: [f64; 2],
    moment: f64,
    /// The sum of the magnitudes of all forces, N.
    total: f64,
    /// The sum of the magnitudes of the weight and the listed loads, N. Their moment is divided by the block's
    /// radius.
    load: f64,
    /// The sums of |Fx|, |Fy| and |moment| of all forces.
    scalable: [f64; 3],
}

impl Acting {
    fn add(&mut self, arm: [f64; 2], force: [f64; 2]) {
        self.force[0] += force[0];
        self.force[1] += force[1];
        self.moment += cross(arm, force);
        self.total += norm(force);
        self.scalable[0] += force[0].abs();
        self.scalable[1] += force[1].abs();
        self.scalable[2] += cross(arm, force).abs();
    }

    fn turn(&mut self, torque: f64) {
        self.moment += torque;
        self.scalable[2] += torque.abs();
    }
}

fn norm(v: [f64; 2]) -> f64 {
    dot(v, v).sqrt()
}

fn negative(v: [f64; 2]) -> [f64; 2] {
    [-v[0], -v[1]]
}

fn name(value: &Value) -> &str {
    value.as_str().expect("a name")
}

/// The name and the radius of every block, and the forces on it: weight, loads, contact forces, robot forces and
/// missing forces.
fn acting(checked: &Checked) -> Vec<(String, f64, Acting)> {
    let (scene, frame) = (scene(&checked.file), &checked.json["frames"][0]);
    let down = [scene.down().x, scene.down().y];
    let mut all = Vec::new();
    for (number_of, block) in scene.blocks().iter().enumerate() {
        let centroid = [block.centroid.x, block.centroid.y];
        let corners = block.body.polygon.outline().iter();
        let radius = corners.map(|p| norm(less([p.x, p.y], centroid)));
        let radius = radius.fold(0.0, f64::max);
        let mut acting = Acting::default();
        acting.add([0.0; 2], down.map(|d| d * block.weight));
        acting.load += block.weight;
        let (mut force, mut moment) = ([0.0; 2], 0.0);
        for load in scene.loads().iter().filter(|l| l.block.0 == number_of) {
            let (pull, at) = ([load.force.x, load.force.y], [load.at.x, load.at.y]);
            force = [force[0] + pull[0], force[1] + pull[1]];
            moment += cross(less(at, centroid), pull) + load.torque;
        }
        acting.add([0.0; 2], force);
        acting.turn(moment);
        acting.load += norm(force) + moment.abs() / radius;
        let is_own = |body: &Value| name(body) == block.id;
        for interface in list(&frame["interfaces"]) {
            let Some(side) = list(&interface["bodies"]).iter().position(is_own) else {
                continue;
            };
            let sign = |v: [f64; 2]| if side == 0 { v } else { negative(v) };
            let normal = pair(&interface["normal"]);
            let forces = pair(&interface["normal_forces"]);
            let points = list(&interface["application_points"]);
            for (point, amount) in points.iter().zip(forces) {
                let arm = less(pair(point), centroid);
                acting.add(arm, sign(normal.map(|n| n * amount)));
            }
            let friction = number(&interface["friction_force"]);
            let along = [-normal[1] * friction, normal[0] * friction];
            acting.add(less(pair(&points[0]), centroid), sign(along));
        }
        for robot in list(&frame["robots"]).iter().filter(|r| is_own(&r["holds"])) {
            let arm = less(pair(&robot["at"]), centroid);
            let [x, y] = pair(&robot["force"]);
            acting.add(arm, [x, 0.0]);
            acting.add(arm, [0.0, y]);
            acting.turn(number(&robot["torque"]));
        }
        for failure in list(&frame["failures"]) {
            let sign = match list(&failure["bodies"]).iter().position(is_own) {
                Some(0) => 1.0,
                Some(_) => -1.0,
                None if failure["holds"].is_string() && is_own(&failure["holds"]) => 1.0,
                None => continue,
            };
            if failure["force"].is_array() {
                let arm = less(pair(&failure["at"]), centroid);
                acting.add(arm, pair(&failure["force"]).map(|f| f * sign));
            } else {
                acting.turn(number(&failure["torque"]));
            }
        }
        all.push((block.id.clone(), radius, acting));
    }
    all
}

/// The unbalanced force of a block, in newtons, and as a fraction of its load. A moment is divided by the radius.
fn remainder(radius: f64, acting: &Acting) -> (f64, f64) {
    let force = norm(acting.force).max(acting.moment.abs() / radius);
    (force, force / acting.load)
}

#[test]
fn listed_forces_and_missing_ones_balance_every_block() {
    let (mut standing, mut falling) = (0, 0);
    for checked in structures() {
        let frame = &checked.json["frames"][0];
        let unsupported = list(&frame["unsupported"]);
        if frame["verdict"] == "undecided" {
            continue;
        }
        let all = acting(&checked);
        // The permitted remainder of a frame that falls is a fraction of the forces on its most heavily loaded block.
        let size = all.iter().map(|(.., a)| a.total).fold(0.0, f64::max);
        for (id, radius, acting) in &all {
            if unsupported.iter().any(|block| name(block) == id) {
                continue;
            }
            let (left, _) = remainder(*radius, acting);
            let within = if frame["verdict"] == "stable" { 1e-6 * acting.total } else { 2e-6 * size };
            assert!(left <= within, "{id}: {left} of {size} in {}", checked.file);
        }
        if frame["verdict"] == "stable" { standing += 1 } else { falling += usize::from(unsupported.is_empty()) }
    }
    assert!(standing > 20 && falling > 20, "{standing} {falling}");
}

/// `worst_share` is the largest unbalanced fraction of a block's load, from the forces in the JSON. `worst_imbalance`
/// is at least the relative change of the forces and moments that would balance every block. `worst_pull` and
/// `worst_slip` are computed from the listed forces.
#[test]
fn the_numbers_of_a_proof_by_forces_are_those_of_the_listed_forces() {
    let mut seen = 0;
    for checked in structures() {
        let frame = &checked.json["frames"][0];
        if frame["verdict"] != "stable" {
            continue;
        }
        let proof = &frame["proof"];
        let (mut worst_share, mut least_change): (f64, f64) = (0.0, 0.0);
        let mut rounding: f64 = 0.0;
        for (_, radius, acting) in acting(&checked) {
            if acting.load == 0.0 {
                continue;
            }
            // The rounding error of a plain sum is about 1e-15 of its terms, and more about a distant centroid.
            rounding = rounding.max(1e-13 * acting.total / acting.load);
            worst_share = worst_share.max(remainder(radius, &acting).1);
            // A force may change by a fraction of its magnitude and move by the same fraction of the radius.
            let [x, y, moment] = acting.scalable;
            for (left, can) in [
                (acting.force[0].abs(), x + acting.total),
                (acting.force[1].abs(), y + acting.total),
                (acting.moment.abs(), moment + acting.total * radius),
            ] {
                let noise = 1e-13 * acting.total;
                if left > noise {
                    least_change = least_change.max((left - noise) / (2.0 * can));
                }
            }
        }
        let share = number(&proof["worst_share"]);
        assert!(
            (share - worst_share).abs() <= rounding + 1e-6 * share,
            "{share} {worst_share} {rounding}: {}",
            checked.file
        );
        let imbalance = number(&proof["worst_imbalance"]);
        let own = Analysis::new(scene(&checked.file)).frames[0].proof;
        assert!(
            matches!(own, Proof::Forces { worst_imbalance, .. } if worst_imbalance == imbalance),
            "{imbalance}: {own:?}"
        );
        assert!(imbalance + 1e-12 >= least_change && imbalance <= 1e-7, "{imbalance} {least_change}: {}", checked.file);
        let (mut pull, mut slip): (f64, f64) = (0.0, 0.0);
        for interface in list(&frame["interfaces"]) {
            let [a, b] = pair(&interface["normal_forces"]);
            let friction = number(&interface["friction_force"]).abs();
            let own = a.abs() + b.abs() + friction;
            if own > 0.0 {
                pull = pull.max((-a).max(-b) / own);
                slip = slip.max((friction - number(&interface["mu"]) * (a + b)) / own);
            }
        }
        assert!((number(&proof["worst_pull"]) - pull.max(0.0)).abs() <= 1e-15);
        assert!(number(&proof["worst_slip"]) >= slip - 1e-15, "{proof}");
        seen += 1;
    }
    assert!(seen > 20, "{seen}");
}

/// Limits hold to the last bit, because a reader compares the printed numbers.
#[test]
fn shares_and_forces_lie_within_the_limits_they_are_compared_with() {
    for checked in structures() {
        let frame = &checked.json["frames"][0];
        for interface in list(&frame["interfaces"]) {
            let [a, b] = pair(&interface["normal_forces"]);
            let share = number(&interface["friction_used"]);
            assert!(a >= 0.0 && b >= 0.0 && (0.0..=1.0).contains(&share), "{interface}");
        }
        for robot in list(&frame["robots"]) {
            let share = number(&robot["limit_used"]);
            assert!((0.0..=1.0).contains(&share), "{robot}: {}", checked.file);
            let listed = list(&checked.file["robots"]).iter();
            let limits = &listed.clone().find(|r| r["id"] == robot["id"]).expect("it")["limits"];
            let [x, y] = pair(&robot["force"]);
            for (key, given) in [("fx", x), ("fy", y), ("torque", number(&robot["torque"]))] {
                let limit = limits[key].as_f64().or_else(|| match key {
                    "torque" => Some(0.0),
                    _ => limits["force"].as_f64(),
                });
                let within = limit.is_none_or(|limit| given.abs() <= limit);
                assert!(within, "{robot} {limits}: {}", checked.file);
            }
        }
    }
}

/// Distance of a point from the segment between two corners.
fn distance(at: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (span, arm) = (less(b, a), less(at, a));
    let share = (dot(arm, span) / dot(span, span)).clamp(0.0, 1.0);
    norm(less(arm, span.map(|s| s * share)))
}

#[test]
fn interfaces_lie_on_both_outlines_and_the_kernel_sets_their_application_points() {
    let mut seen = 0;
    for checked in structures() {
        let scene = scene(&checked.file);
        let rings = |body: &str| -> Vec<Vec<[f64; 2]>> {
            let polygons = match body {
                "ground" => scene.ground().iter().map(|g| &g.body.polygon).collect(),
                id => vec![&scene.blocks().iter().find(|b| b.id == id).expect("a block").body.polygon],
            };
            let rings = polygons.into_iter().flat_map(|p| p.rings());
            rings.map(|ring| ring.iter().map(|p| [p.x, p.y]).collect()).collect()
        };
        let from_outline = |body: &str, at: [f64; 2]| {
            let rings = rings(body);
            let edges =
                rings.iter().flat_map(|ring| (0..ring.len()).map(move |k| (ring[k], ring[(k + 1) % ring.len()])));
            edges.map(|(a, b)| distance(at, a, b)).fold(f64::INFINITY, f64::min)
        };
        let gap = number(&checked.json["contact_tolerance"]["gap"]);
        let friction = checked.file["friction"].as_f64().unwrap_or(0.7);
        let kernel = checked.file["kernel"].as_f64().unwrap_or(0.0);
        for interface in list(&checked.json["frames"][0]["interfaces"]) {
            let ends = [pair(&interface["ends"][0]), pair(&interface["ends"][1])];
            let span = less(ends[1], ends[0]);
            let reach = norm(ends[0]).max(norm(ends[1])).max(1.0);
            for body in list(&interface["bodies"]).iter().map(name) {
                for at in ends {
                    let off = from_outline(body, at);
                    assert!(off <= gap + 1e-12 * reach, "{off} {gap} {body}: {interface}");
                }
            }
            let normal = pair(&interface["normal"]);
            assert!((norm(normal) - 1.0).abs() <= 1e-12, "{interface}");
            assert!(dot(normal, span).abs() <= 1e-9 * norm(span), "{interface}");
            // A point slightly along the normal lies in the first body.
            let hair = 1e-3 * norm(span);
            let middle = [0, 1].map(|k| 0.5 * (ends[0][k] + ends[1][k]));
            let inside = [0, 1].map(|k| middle[k] + hair * normal[k]);
            let first = name(&interface["bodies"][0]);
            let winding: i32 = rings(first).iter().map(|ring| winding(ring, inside)).sum();
            assert!(winding != 0, "the normal does not point into {first}: {interface}");
            // The distance of an application point from its end is half of the kernel times the length.
            for (k, at) in list(&interface["application_points"]).iter().enumerate() {
                let share = if k == 0 { 0.5 * kernel } else { 1.0 - 0.5 * kernel };
                let expected = [0, 1].map(|k| ends[0][k] + share * span[k]);
                let off = norm(less(pair(at), expected));
                assert!(off <= 1e-12 * reach, "{off} {kernel}: {interface}");
            }
            assert!((number(&interface["mu"]) - friction).abs() <= 1e-15, "{interface}");
            seen += 1;
        }
    }
    assert!(seen > 200, "{seen}");
}

/// The winding number of a ring about a point.
fn winding(ring: &[[f64; 2]], at: [f64; 2]) -> i32 {
    let mut turns = 0;
    for (k, a) in ring.iter().enumerate() {
        let b = ring[(k + 1) % ring.len()];
        let left = cross(less(b, *a), less(at, *a)) > 0.0;
        match (a[1] <= at[1], b[1] <= at[1]) {
            (true, false) if left => turns += 1,
            (false, true) if !left => turns -= 1,
            _ => {}
        }
    }
    turns
}
