//! Tests of small drawings that are imported as scenes.

use super::draft::Scale;
use super::naming::Naming;
use super::*;
use crate::geometry::Point;

fn svg(body: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' \
             xmlns:xlink='http://www.w3.org/1999/xlink' viewBox='0 0 20 10'>\n{body}\n</svg>"
    )
}

fn taken(body: &str) -> Imported {
    import(&svg(body), Format::Svg, &Options::default()).expect("a scene")
}

fn ids(imported: &Imported) -> Vec<&str> {
    imported.scene.blocks.iter().filter_map(|b| b.id.as_deref()).collect()
}

fn bounds(imported: &Imported, block: usize) -> [f64; 4] {
    let scene = Scene::from_json(&imported.scene.to_json()).expect("a valid scene");
    let b = scene.blocks[block].body.polygon.bounds();
    [b.min.x, b.min.y, b.max.x, b.max.y]
}

#[test]
fn the_role_of_an_element_follows_from_its_layer_and_name() {
    let imported = taken(
        "<g id='Ground_layer'><rect y='9' width='20' height='1' fill='#777'/></g>
         <g inkscape:groupmode='layer' inkscape:label='Blocks'>
           <rect id='rect12' inkscape:label='left' x='1' y='7' width='2' height='2' fill='#8b6b3d'/>
           <g id='g1' inkscape:label='right'><path id='path5' d='M5 9h2v-2h-2z' fill='#8b6b3d'/></g>
           <rect id='left' x='9' y='7' width='2' height='2' style='fill:#00f'/>
         </g>
         <circle id='robot-a' cx='2' cy='8' r='.3'/>
         <g id='guides'><path d='M0 0L9 9'/></g>",
    );
    assert_eq!(ids(&imported), ["left", "right", "left-2"]);
    let (file, robot) = (&imported.scene, &imported.scene.robots[0]);
    assert_eq!(file.ground[0].fill.as_deref(), Some("#777777"));
    assert_eq!(robot.id.as_deref(), Some("robot-a"));
    assert_eq!((robot.holds.as_deref(), robot.at), (Some("left"), Some([2.0, 2.0])));
    let materials: Vec<&str> = file.materials.0.iter().map(|m| m.0.as_str()).collect();
    assert_eq!(materials, ["fill-0000ff", "fill-8b6b3d"]);
    assert_eq!(file.blocks[2].material.as_deref(), Some("fill-0000ff"));
    assert_eq!(imported.remarks, []);
    assert!(
        imported
            .notes
            .iter()
            .any(|n| n.starts_with("left out, because its name begins with") && n.ends_with("g \"guides\"")),
        "{:?}",
        imported.notes
    );
}

#[test]
fn transforms_copies_and_symbols_place_elements_as_in_a_viewer() {
    let imported = taken(
        "<defs><rect id='brick' width='4' height='2'/>
           <symbol id='half' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol></defs>
         <use id='a' href='#brick' x='1' y='8'/>
         <g transform='translate(10 5) scale(.5)'><use id='b' xlink:href='#brick' transform='rotate(90)'/></g>
         <use id='c' href='#half' x='15' y='2' width='3' height='3'/>
         <svg id='d' x='1' y='1' width='2' height='2' viewBox='0 0 4 4'><rect width='4' height='2'/></svg>",
    );
    assert_eq!(ids(&imported), ["a", "b", "c", "d"]);
    assert_eq!(bounds(&imported, 0), [1.0, 0.0, 5.0, 2.0]);
    assert_eq!(bounds(&imported, 1), [9.0, 3.0, 10.0, 5.0]);
    assert_eq!(bounds(&imported, 2), [15.0, 5.0, 18.0, 8.0]);
    assert_eq!(bounds(&imported, 3), [1.0, 8.0, 3.0, 9.0]);
}

#[test]
fn a_stone_in_a_hole_is_kept_and_a_repeated_stone_is_left_out() {
    let imported = taken(
        "<path id='frame' fill-rule='evenodd' d='M1 1h8v8h-8zM3 3h4v4h-4z'/>
         <path id='filling' d='M3 3h4v4h-4z'/><path id='again' d='M3 3h4v4h-4z'/>",
    );
    assert_eq!(ids(&imported), ["frame", "filling"]);
    assert!(imported.notes.contains(&"left out: exact repeats (1)".to_owned()), "{:?}", imported.notes);
}

#[test]
fn everything_that_cannot_be_imported_is_reported_at_once() {
    let imported = taken(
        "<rect id='good' x='1' y='1' width='2' height='2' clip-path='url(#c)' mask='url(#m)' fill='url(#g)'/>
         <path id='open' d='M15 5L18 5L18 2'/><path d='M0 0L'/><text id='words' x='3'>no block</text><image id='photo'/>
         <polygon id='bow' points='10,1 12,3 12,1 10,3'/><polygon id='flat' points='10,1 12,1 14,1'/>
         <rect id='none' width='0' height='3'/><use id='lost' href='#nowhere'/>
         <rect style='display:none' width='3' height='3'/>
         <g id='me'><use href='#me'/></g><circle id='robot' cx='19' cy='9' r='1'/>",
    );
    assert_eq!(ids(&imported), ["good"]);
    let described: Vec<(&str, &str)> = imported
        .remarks
        .iter()
        .map(|r| (r.element.as_str(), r.message.split([';', ':']).next().unwrap_or("")))
        .collect();
    let expected = [
        ("rect \"good\"", "masks are not supported"),
        ("rect \"good\"", "its clip path is not a single outline"),
        ("rect \"good\"", "a gradient or pattern cannot become a material"),
        ("<path> in line 3", "its path data cannot be read (unexpected end of stream)"),
        ("text \"words\"", "a text cannot become a block"),
        ("image \"photo\"", "an image has no outlines"),
        ("rect \"none\"", "its width is 0"),
        ("use \"lost\"", "it copies #nowhere, which does not exist"),
        ("<use> in line 7", "it copies itself"),
        ("path \"open\"", "it is open"),
        ("polygon \"bow\"", "its outline crosses or touches itself at (11.0000, 8.0000) m"),
        ("polygon \"flat\"", "it encloses no area"),
        ("", "no part of the drawing is ground, so nothing supports the blocks"),
        ("circle \"robot\"", "its centre (19, 1) m is in no block, so the robot holds nothing"),
    ];
    assert_eq!(described, expected);
}

#[test]
fn holes_and_islands_come_from_the_fill_rule() {
    let imported =
        taken("<path id='ring' fill-rule='evenodd' d='M1 1h6v6h-6z m1 1h4v4h-4z m1 1h1v1h-1z M10 1h2v2h-2z'/>");
    assert_eq!(ids(&imported), ["ring", "ring-2", "ring-3"]);
    assert_eq!(imported.scene.blocks[0].holes.len(), 1);
}

#[test]
fn overlapping_blocks_are_refused_with_their_elements() {
    let refusal = import(
        &svg("<rect id='ground' y='8' width='20' height='2'/><rect id='a' x='1' y='5' width='3' height='4'/>
              <text>x</text>"),
        Format::Svg,
        &Options::default(),
    )
    .expect_err("overlapping blocks");
    assert_eq!(refusal.problems.len(), 1);
    assert_eq!(refusal.problems[0].element, "rect \"a\"");
    assert!(
        refusal.problems[0]
            .message
            .contains("block `a` and the ground's rect \"ground\" overlap by 1 m, with a common area of 3 m²"),
        "{}",
        refusal.problems[0].message
    );
    assert_eq!(refusal.remarks.len(), 1);
}

#[test]
fn an_empty_drawing_and_wrong_options_are_refused() {
    let empty = import(&svg("<g id='ground'><rect width='3' height='3'/></g>"), Format::Svg, &Options::default());
    assert!(empty.expect_err("no block").problems[0].message.contains("nothing in the drawing becomes a block"));
    let options = Options { scale: Some(0.0), flatten: Some(f64::NAN), gap: Some(-1.0), ..Options::default() };
    assert_eq!(import("", Format::Wkt, &options).expect_err("invalid options").problems.len(), 3);
    for text in ["", "<svg", "<html/>"] {
        assert!(import(text, Format::Svg, &Options::default()).is_err(), "{text}");
    }
}

#[test]
fn elements_with_huge_coordinates_are_left_out() {
    let imported = taken(
        "<rect id='a' width='3' height='3'/><rect id='b' x='1e200' width='3' height='3'/>
        <g transform='scale(1e300)'><g transform='scale(1e300)'><rect id='c' width='3' height='3'/></g></g>",
    );
    assert_eq!(ids(&imported), ["a"]);
    // Equal remarks are one, and the other remark states that nothing is ground.
    assert_eq!(imported.remarks.len(), 2, "{:?}", imported.remarks);
    assert_eq!(imported.remarks[0].element, "rect \"b\", rect \"c\"");
}

#[test]
fn too_many_copies_and_too_many_levels_are_refused() {
    let mut body = String::from("<defs><g id='g0'><rect width='1' height='1'/></g>");
    for k in 1..12 {
        let copies = format!("<use href='#g{}'/>", k - 1).repeat(10);
        body += &format!("<g id='g{k}'>{copies}</g>");
    }
    body += "</defs><path d='M0 0 1 1'/><use href='#g11' x='5'/>";
    let document = svg(&body);
    let refused = svg::read(&document, Scale::default(), None, &Naming::default()).expect_err("too many");
    assert!(refused.contains("copies included"), "{refused}");
    let deep = format!("{}<rect width='3' height='3'/>{}", "<g>".repeat(5000), "</g>".repeat(5000));
    let draft = svg::read(&svg(&deep), Scale::default(), None, &Naming::default()).expect("XML");
    assert!(draft.parts.is_empty() && draft.remarks[0].message.contains("levels deep"));
}

#[test]
fn the_common_curve_of_two_neighbours_has_no_gaps() {
    // Both paths contain the same half circle: one as a single arc, the other as two arcs.
    let imported = taken(
        "<rect id='ground' y='9' width='20' height='1'/>
         <path id='cradle' d='M3 9V4H4A4 4 0 0 0 12 4H13V9Z'/>
         <path id='bowl' d='M4 4A4 4 0 0 0 9 7.873A4 4 0 0 0 12 4Z'/>",
    );
    let scene = Scene::from_json(&imported.scene.to_json()).expect("a valid scene");
    let area: f64 = scene.blocks.iter().map(|b| b.body.polygon.area()).sum();
    assert!((area - 50.0).abs() < 1e-6, "together they fill a box: {area}");
    let bowl = scene.blocks[1].body.polygon.bounds();
    assert!((bowl.min - Point::new(4.0, 2.0)).norm() < 0.02, "{bowl:?}");
}
