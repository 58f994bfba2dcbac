//! Precedence between keys: outlines and their positions, weights, friction.

use serde_json::{Value, json};

use super::Shown::{Refused, Result};
use super::{Claim, ENDS, MU, WEIGHT, assert_claims, block, cells, file, put, stands};
use crate::structure::rectangle;

#[test]
fn outlines_weights_and_friction_are_found_in_the_order_of_the_page() {
    let materials = json!({ "oak": { "density": 700, "friction": 0.5 }, "stone": {} });
    let all = json!({ "weight": 5, "mass": 7, "density": 9, "material": "oak" });
    let without = |keys: &[&str]| {
        let mut some = all.clone();
        keys.iter().for_each(|key| some[key] = Value::Null);
        block(some, json!({ "materials": materials, "density": 3, "gravity": [0, -10] }))
    };
    let floor = |keys: Value| {
        let mut floor = json!({ "polygon": rectangle(-20.0, -1.0, 60.0, 1.0) });
        put(&mut floor, keys);
        json!([floor])
    };
    let pair = |between: [&str; 2], own: f64| {
        let scene = json!({ "materials": materials, "ground": floor(json!({ "material": between[1], "friction": 0.2 })),
            "friction_pairs": [{ "between": between, "friction": 1.5 }] });
        block(json!({ "material": "oak", "friction": own }), scene)
    };
    let hole = json!({ "holes": [rectangle(0.25, 0.25, 0.5, 0.5)] });
    assert_claims(vec![
        Claim("the `weight` of the block, in the force unit of the scene", without(&[]), Result(WEIGHT, json!(5))),
        Claim("the `mass` of the block in kilograms times gravity", without(&["weight"]), Result(WEIGHT, json!(70))),
        Claim("The density is that of the block", without(&["weight", "mass"]), Result(WEIGHT, json!(90))),
        Claim(
            "otherwise it is that of its material, or that of the scene",
            without(&["weight", "mass", "density"]),
            Result(WEIGHT, json!(7000)),
        ),
        Claim(
            "or that of the scene if the material has none",
            without(&["weight", "mass", "density", "material"]),
            Result(WEIGHT, json!(30)),
        ),
        Claim(
            "the area of the block times the thickness times the density times gravity",
            block(hole, json!({})),
            Result(WEIGHT, json!(0.75 * 9.81)),
        ),
        Claim(
            "The weight acts at the centroid of the outline, in the direction of gravity",
            block(json!({ "weight": 5 }), json!({ "gravity": [3, -4], "friction": 2 })),
            Result("/frames/0/interfaces/0/resultant", json!({ "at": [0.875, 0.0], "force": [-3.0, 4.0] })),
        ),
        Claim(
            "no weight acts, not even a given `weight`",
            block(json!({ "weight": 5 }), json!({ "gravity": [0, 0], "ground": [] })),
            stands(),
        ),
        Claim(
            "The friction coefficient of an interface comes from the `friction_pairs` entry of the two materials",
            pair(["oak", "stone"], 0.1),
            Result(MU, json!(1.5)),
        ),
        Claim(
            "If both names are equal, the coefficient applies between two bodies of this material",
            pair(["oak", "oak"], 0.1),
            Result(MU, json!(1.5)),
        ),
        Claim(
            "the smaller of the friction coefficients of the two bodies",
            block(json!({ "friction": 0.9 }), json!({ "ground": floor(json!({ "friction": 0.3 })) })),
            Result(MU, json!(0.3)),
        ),
        Claim(
            "The friction coefficient of a body is its own",
            block(json!({ "material": "oak", "friction": 0.6 }), json!({ "materials": materials })),
            Result(MU, json!(0.6)),
        ),
        Claim(
            "that of its material, or that of the scene",
            block(json!({ "material": "oak" }), json!({ "materials": materials })),
            Result(MU, json!(0.5)),
        ),
        Claim("or that of the scene", file(json!({ "friction": 0.4 })), Result(MU, json!(0.4))),
        Claim(
            "The corners of a polygon may be listed in either direction",
            block(json!({ "polygon": [[0, 0], [0, 1], [1, 1], [1, 0]] }), json!({})),
            stands(),
        ),
        Claim(
            "need not be convex",
            block(json!({ "polygon": [[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]] }), json!({})),
            stands(),
        ),
        Claim(
            "turned by `angle` about the point (0, 0) of its own coordinates, and then moved by `at`",
            block(json!({ "polygon": rectangle(0.0, 0.0, 2.0, 1.0), "angle": 90, "at": [5, 0] }), json!({})),
            Result(ENDS, json!([[5, 0], [4, 0]])),
        ),
        Claim(
            "or in lattice coordinates if the scene has a `grid`",
            block(json!({ "at": [3, 0] }), json!({ "grid": { "kind": "triangular", "side": 2 } })),
            Result(ENDS, json!([[7, 0], [6, 0]])),
        ),
        Claim(
            "A polygon in a scene with a grid may lie anywhere",
            block(json!({ "at": [0.3, 0], "angle": 0.0 }), json!({ "grid": { "kind": "square" } })),
            Result(ENDS, json!([[1.3, 0], [0.3, 0]])),
        ),
        Claim(
            "of 90° on the square lattice",
            cells(json!({ "angle": 90, "at": [1, 0] })),
            Result("/frames/0/interfaces/0/ends", json!([[0.5, 0], [0, 0]])),
        ),
        Claim(
            "its `at` consists of whole numbers",
            cells(json!({ "at": [0.5, 0] })),
            Refused("off_lattice", "is not a lattice point"),
        ),
        Claim(
            "of 90° on the square lattice",
            cells(json!({ "angle": 60 })),
            Refused("off_lattice", "a multiple of 90°"),
        ),
        Claim(
            "its `angle` is a multiple of 60° on the triangular lattice",
            json!({ "drystone": 1, "grid": { "kind": "triangular" },
            "blocks": [{ "shape": "hexagon", "angle": 90 }] }),
            Refused("off_lattice", "a multiple of 60°"),
        ),
    ]);
    let mut file = cells(json!({}));
    file["contact_tolerance"] = json!(0.1);
    assert_claims(vec![Claim("`contact_tolerance` has no effect", file, Result("/contact_tolerance/gap", json!(0)))]);
}
