//! Scenes that are refused according to the page, and similar scenes that are not.

use serde_json::{Value, json};

use super::Shown::{Refused, Result};
use super::{Claim, STANDS, assert_claims, block, cells, file, stands};
use crate::structure::rectangle;

#[test]
fn scenes_that_the_page_says_are_refused_are_refused() {
    let outline = |polygon: Value| block(json!({ "polygon": polygon }), json!({}));
    let hole = |hole: Value| block(json!({ "holes": [hole] }), json!({}));
    let sunk = |depth: f64, scene: Value| block(json!({ "polygon": rectangle(0.0, -depth, 1.0, 1.0) }), scene);
    let given = json!({ "contact_tolerance": 0.1 });
    assert_claims(vec![
        Claim("numbers beyond ±10¹²", file(json!({ "friction": 1.1e12 })), Refused("too_large", "1e12")),
        Claim(
            "a weight above 10¹² N",
            block(json!({ "mass": 9e11 }), json!({})),
            Refused("too_large", "weight would be"),
        ),
        Claim("numbers other than 0 within ±10⁻³⁰", file(json!({ "density": 1e-31 })), Refused("too_small", "1e-30")),
        Claim(
            "negative numbers for a key with \"at least 0\"",
            file(json!({ "thickness": -1 })),
            Refused("negative", "at least 0"),
        ),
        Claim(
            "fewer than three different corners",
            outline(json!([[0, 0], [1, 0], [0, 0]])),
            Refused("too_few_corners", ""),
        ),
        Claim("without area", outline(json!([[0, 0], [1, 0], [2, 0]])), Refused("zero_area", "")),
        Claim(
            "or that cross or touch themselves",
            outline(json!([[0, 0], [1, 1], [1, 0], [0, 1]])),
            Refused("crossing_outline", ""),
        ),
        Claim(
            "holes that do not lie inside their outline",
            hole(rectangle(2.0, 2.0, 1.0, 1.0)),
            Refused("hole_outside", ""),
        ),
        Claim(
            "holes inside another hole",
            block(json!({ "holes": [rectangle(0.1, 0.1, 0.5, 0.5), rectangle(0.2, 0.2, 0.1, 0.1)] }), json!({})),
            Refused("hole_outside", "holes[1]"),
        ),
        Claim(
            "`holes` without a `polygon`",
            block(
                json!({ "polygon": null, "shape": "s", "holes": [rectangle(0.1, 0.1, 0.1, 0.1)] }),
                json!({ "shapes": { "s": { "polygon": rectangle(0.0, 0.0, 1.0, 1.0) } } }),
            ),
            Refused("holes_without_polygon", ""),
        ),
        Claim("a body without an outline", block(json!({ "polygon": null }), json!({})), Refused("no_outline", "")),
        Claim(
            "a body with two outlines",
            block(json!({ "shape": "s" }), json!({ "shapes": { "s": { "polygon": rectangle(0.0, 0.0, 1.0, 1.0) } } })),
            Refused("two_outlines", ""),
        ),
        Claim("cells are not connected", cells(json!({ "cells": [[0, 0], [1, 1]] })), Refused("cells_apart", "")),
        Claim("or are listed twice", cells(json!({ "cells": [[0, 0], [0, 0]] })), Refused("duplicate_cell", "")),
        Claim(
            "lattice coordinates of cells that are not whole",
            cells(json!({ "cells": [[0.5, 0]] })),
            Refused("off_lattice", ""),
        ),
        Claim("or beyond ±10⁶", cells(json!({ "at": [1_000_001, 0] })), Refused("too_large", "lattice steps")),
        Claim(
            "cells or a built-in shape without the grid they need",
            block(json!({ "polygon": null, "cells": [[0, 0]] }), json!({})),
            Refused("needs_grid", ""),
        ),
        Claim(
            "cells or a built-in shape without the grid they need",
            cells(json!({ "cells": null, "shape": "hexagon" })),
            Refused("needs_grid", ""),
        ),
        Claim(
            "ids that are empty or used twice",
            file(json!({ "robots": [{ "id": "r1" }, {}] })),
            Refused("duplicate_id", "r1"),
        ),
        Claim("ids that are empty", block(json!({ "id": "" }), json!({})), Refused("empty_id", "")),
        Claim("a block named `ground`", block(json!({ "id": "ground" }), json!({})), Refused("reserved_name", "")),
        Claim(
            "a shape with the name of a built-in one",
            file(json!({ "shapes": { "up": { "polygon": rectangle(0.0, 0.0, 1.0, 1.0) } } })),
            Refused("reserved_name", ""),
        ),
        Claim("unknown names", file(json!({ "robots": [{ "holds": "x" }] })), Refused("unknown_name", "")),
        Claim("by more than the `contact_tolerance`", sunk(0.15, given.clone()), Refused("overlap", "by 0.15 m,")),
        Claim("bodies may overlap by up to this depth", sunk(0.05, given.clone()), stands()),
        Claim("edges at most this far apart touch", sunk(-0.05, given.clone()), stands()),
        Claim("edges at most this far apart touch", sunk(-0.15, given), Result(STANDS, json!("unstable"))),
        Claim(
            "by at least a hundredth of the size of the smaller block",
            sunk(0.011, json!({})),
            Refused("overlap", ""),
        ),
        Claim("is undecided if the verdicts differ", sunk(0.009, json!({})), Result(STANDS, json!("undecided"))),
        Claim(
            "Parts of the ground may overlap",
            file(json!({ "ground": [{ "polygon": rectangle(-1.0, -1.0, 3.0, 1.0) },
            { "polygon": rectangle(-2.0, -1.0, 3.0, 1.0) }] })),
            stands(),
        ),
        Claim(
            "A block that touches nothing and that no robot holds is not an error: it falls",
            sunk(-5.0, json!({})),
            Result(STANDS, json!("unstable")),
        ),
        Claim(
            "`silence` of a scene switches off the notes",
            block(json!({}), json!({ "density": 2500, "friction": 3, "silence": ["friction_high"] })),
            Result("/notes", Value::Null),
        ),
    ]);
}
