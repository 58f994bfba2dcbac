//! Scenes with hundreds of bodies at one place: what a scene holds in memory is counted, and does not grow with the square
//! of the length of its file.

#![no_main]

use std::fmt::Write;

use arbitrary::Arbitrary;
use drystone::Scene;
use drystone::internals::interface::Interfaces;
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Crowd {
    corner_contacts: bool,
    rows: Vec<Row>,
}

/// Equal parallelograms, each moved on from the one before.
#[derive(Arbitrary, Debug)]
struct Row {
    is_ground: bool,
    count: u16,
    at: [i8; 2],
    size: [u8; 2],
    lean: i8,
    by: [i8; 2],
}

fn text(crowd: &Crowd) -> String {
    let mut lists = [String::new(), String::new()];
    for row in &crowd.rows {
        let list = &mut lists[usize::from(row.is_ground)];
        let ([width, height], lean) = (row.size.map(|v| 1 + i32::from(v)), i32::from(row.lean));
        for i in 0..i32::from(row.count % 2000) {
            let [x, y] = [0, 1].map(|k| i32::from(row.at[k]) + i * i32::from(row.by[k]));
            let (right, high) = (x + width, y + height);
            let corners = format!("[{x},{y}],[{right},{y}],[{},{high}],[{},{high}]", right + lean, x + lean);
            let _ = write!(list, "{{\"polygon\":[{corners}]}},");
        }
    }
    let [blocks, ground] = lists.map(|list| list.trim_end_matches(',').to_owned());
    let corners = crowd.corner_contacts;
    format!("{{\"drystone\":1,\"corner_contacts\":{corners},\"ground\":[{ground}],\"blocks\":[{blocks}]}}")
}

fuzz_target!(|crowd: Crowd| {
    let text = text(&crowd);
    let Ok(scene) = Scene::from_json(&text) else {
        return;
    };
    // The limits of SECURITY.md: each pair of bodies may touch at each of their corners.
    let contacts = Interfaces::new(&scene).all.len();
    assert!(contacts <= 8 * (100_000 + text.len()), "{contacts} contacts from {} bytes", text.len());
});
