//! Tests of DXF drawings with a few entities: their outlines, roles, notes and remarks.

use core::f64::consts::TAU;

use super::*;
use crate::geometry::Point;
use crate::sources::import::draft::{PartGeometry, Role};
use crate::sources::import::network::join;
use crate::sources::import::subpath::Subpath;
use crate::sources::import::tidy::leave_fills_out;

/// The text of a DXF file with these blocks and entities. Each group is given as a line `code value`.
fn file(blocks: &str, entities: &str) -> String {
    let text = format!("0 SECTION\n2 BLOCKS\n{blocks}\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n{entities}\n0 ENDSEC\n0 EOF");
    let groups = text.lines().map(str::trim).filter(|l| !l.is_empty());
    groups
        .map(|l| l.split_once(' ').expect("code and value"))
        .map(|(code, value)| format!("{code:>3}\n{value}\n"))
        .collect()
}

fn draft(blocks: &str, entities: &str) -> Draft {
    let mut draft = read(&file(blocks, entities), Scale::default(), &Naming::default()).expect("a DXF file");
    leave_fills_out(&mut draft);
    join(&mut draft, 1e-6);
    (draft.notes, draft.remarks) = draft.told();
    draft
}

fn curves(draft: &Draft) -> Vec<&Subpath> {
    let forms = draft.parts.iter().map(|p| match &p.form {
        PartGeometry::Subpaths(curves, _) => curves.as_slice(),
        PartGeometry::Point(_) => &[],
    });
    forms.flatten().collect()
}

/// The area of a curve after flattening, by the shoelace formula; positive if the curve runs anticlockwise.
fn area(curve: &Subpath) -> f64 {
    let corners = curve.flattened(1e-6, 1e-9).expect("closed");
    let at = |i: usize| corners[i % corners.len()].at;
    let twice = (0..corners.len()).map(|i| at(i).x * at(i + 1).y - at(i + 1).x * at(i).y);
    twice.sum::<f64>() / 2.0
}

const SQUARE: &str = "0 LWPOLYLINE\n8 0\n90 4\n70 1\n10 0\n20 0\n10 2\n20 0\n10 2\n20 1\n10 0\n20 1\n";

#[test]
fn a_bulge_of_one_is_a_half_circle() {
    // Two half circles of radius 1: anticlockwise for positive bulges, clockwise for negative ones.
    for bulge in [1.0, -1.0] {
        let text = format!("0 LWPOLYLINE\n8 0\n90 2\n70 1\n10 0\n20 0\n42 {bulge}\n10 2\n20 0\n42 {bulge}");
        let draft = draft("", &text);
        let found = area(curves(&draft)[0]);
        assert!((found - bulge * TAU / 2.0).abs() < 1e-4, "{found}");
    }
    // A quarter circle over the chord from (1, 0) to (0, 1): its bulge is tan(π/8).
    let text =
        format!("0 LWPOLYLINE\n8 0\n90 3\n70 1\n10 0\n20 0\n10 1\n20 0\n42 {}\n10 0\n20 1", libm::tan(TAU / 16.0));
    let found = area(curves(&draft("", &text))[0]);
    assert!((found - TAU / 8.0).abs() < 1e-5, "{found}");
}

#[test]
fn lines_and_arcs_that_meet_form_a_loop_whatever_their_direction() {
    let draft = draft(
        "",
        "0 LINE\n8 stones\n10 1\n20 0\n11 0\n21 0\n
         0 ARC\n8 stones\n10 0\n20 0\n40 1\n50 0\n51 90\n
         0 LINE\n8 stones\n10 0\n20 0\n11 0\n21 1\n
         0 LINE\n8 other\n10 1\n20 0\n11 5\n21 5",
    );
    assert_eq!(draft.parts.len(), 1);
    assert!((area(curves(&draft)[0]).abs() - TAU / 8.0).abs() < 1e-5);
    let remarks: Vec<&str> = draft.remarks.iter().map(|r| r.message.as_str()).collect();
    assert_eq!(remarks, ["it is open; left out"]);
}

#[test]
fn a_line_that_branches_off_an_outline_is_left_out_and_counted() {
    let triangle = "0 LINE\n8 0\n10 0\n20 0\n11 1\n21 0\n0 LINE\n8 0\n10 1\n20 0\n11 0\n21 1\n0 LINE\n8 0\n10 0\n20 1\n11 0\n21 0\n";
    let draft = draft("", &format!("{triangle}0 LINE\n8 0\n10 1\n20 0\n11 2\n21 2"));
    assert_eq!((draft.parts.len(), area(curves(&draft)[0]).abs()), (1, 0.5));
    assert_eq!((draft.remarks[0].message.as_str(), draft.left_out["line"]), ("it is open; left out", 1));
}

#[test]
fn blocks_are_inserted_with_scale_rotation_and_arrays() {
    let block = format!("0 BLOCK\n2 BRICK\n70 0\n10 1\n20 0\n{SQUARE}0 ENDBLK");
    let draft = draft(
        &block,
        "0 INSERT\n8 granite\n2 BRICK\n10 10\n20 20\n41 2\n42 3\n50 90\n
         0 INSERT\n8 0\n2 BRICK\n10 0\n20 0\n70 3\n71 2\n44 2\n45 1\n
         0 INSERT\n8 0\n2 ABSENT\n10 0\n20 0",
    );
    assert_eq!(draft.parts.len(), 7);
    assert_eq!(draft.parts[0].name, "BRICK");
    // A layer with the name of a material sets density and friction.
    assert_eq!(draft.parts[0].values.density, Some(2910.0));
    assert_eq!(draft.parts[1].values.density, None);
    // The base point (1, 0) moves to (10, 20). The corner (2, 1) is 1 to the right of it and 1 above it. Scaling
    // makes this 2 and 3, and then it is rotated.
    let hull = curves(&draft)[0].hull();
    assert!(hull.iter().any(|p| (p - Point::new(7.0, 22.0)).norm() < 1e-12), "{hull:?}");
    // The last copy is in column 2 and row 1, counted from 0. Columns are 2 wide, rows are 1 high, and the base point
    // is subtracted.
    let last = curves(&draft)[6].start;
    assert!((last - Point::new(3.0, 1.0)).norm() < 1e-12, "{last}");
    assert!(draft.remarks[0].message.contains("`ABSENT` is not in the file"));
}

#[test]
fn a_mirrored_polyline_is_read_and_a_tilted_polyline_is_left_out() {
    let mirrored = format!("{SQUARE}210 0\n220 0\n230 -1");
    let found = draft("", &mirrored);
    assert_eq!(curves(&found)[0].hull()[1], Point::new(-2.0, 0.0));
    let tilted = format!("{SQUARE}210 0\n220 1\n230 0");
    let found = draft("", &tilted);
    assert!(found.parts.is_empty() && found.remarks[0].message.contains("plane of the drawing"));
}

#[test]
fn a_hatch_is_imported_only_if_no_outline_is_drawn_around_it() {
    let hatch = |dx: f64| {
        format!(
            "0 HATCH\n8 0\n10 0\n20 0\n91 1\n92 2\n72 0\n73 1\n93 4\n10 {dx}\n20 0\n10 {}\n20 0\n10 {}\n20 1\n10 {dx}\n20 1\n97 0\n",
            dx + 2.0,
            dx + 2.0
        )
    };
    let found = draft("", &format!("{SQUARE}{}{}", hatch(0.0), hatch(5.0)));
    assert_eq!(found.parts.len(), 2);
    assert!(found.notes.iter().any(|n| n.contains("fill a drawn outline (1)")));
    // Edges: a line, and a half circle that is drawn clockwise.
    let edges = "0 HATCH\n8 0\n91 1\n92 1\n93 2\n72 1\n10 1\n20 0\n11 -1\n21 0\n72 2\n10 0\n20 0\n40 1\n50 180\n51 360\n73 0\n97 0\n";
    let found = draft("", edges);
    assert!((area(curves(&found)[0]).abs() - TAU / 4.0).abs() < 1e-4);
}

#[test]
fn the_name_of_a_layer_decides_the_role_of_its_entities() {
    let on = |layer: &str| SQUARE.replacen("8 0", &format!("8 {layer}"), 1);
    let point = "0 POINT\n8 robot arm\n10 1\n20 0.5\n0 POINT\n8 0\n10 1\n20 0.5\n";
    let found = draft("", &[on("Ground"), on("guides"), on("0"), point.into()].concat());
    let roles: Vec<Role> = found.parts.iter().map(|p| p.kind).collect();
    assert_eq!(roles, [Role::Ground, Role::Block, Role::Robot]);
    assert_eq!(found.left_out["point"], 1);
}

#[test]
fn texts_that_are_not_dxf_are_refused_with_a_reason() {
    for (text, why) in [
        ("AutoCAD Binary DXF\r\n", "binary DXF"),
        ("<svg/>", "line 1 is not a DXF group code"),
        ("0\nSECTION\n2\nENTITIES\n0", "ends after the group code in line 5"),
        ("0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n", "no section ENTITIES"),
        ("  5\nA\n", "does not begin with a section"),
    ] {
        let refusal = read(text, Scale::default(), &Naming::default()).expect_err("refused");
        assert!(refusal.contains(why), "{refusal}");
    }
}
