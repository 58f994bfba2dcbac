//! Tests of contacts in scenes made of cells.

use super::*;
use crate::mechanics::statics::interface::lattice::LatticeEdges;

fn squares(list: &[(f64, f64)]) -> Vec<CellEntry> {
    let cells = list.iter().map(|(x, y)| CellEntry::Square(*x, *y));
    cells.collect()
}

/// A U of cells, a bar inside it that touches it on three sides, and a lid on both.
fn lidded() -> Scene {
    Scene::builder()
        .grid(GridKind::Square, 2.0)
        .friction(0.5)
        .ground(GroundEntry::default().cells(squares(&[(0.0, -1.0), (1.0, -1.0), (2.0, -1.0)])))
        .block(BlockEntry::new("u").cells(squares(&[(0.0, 1.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0)])))
        .block(BlockEntry::new("bar").cells(squares(&[(1.0, 1.0)])))
        .block(BlockEntry::new("lid").cells(squares(&[(0.0, 2.0), (1.0, 2.0), (2.0, 2.0)])))
        .build()
        .expect("the scene is valid")
}

#[test]
fn interfaces_of_one_body_at_a_time_are_those_of_all_bodies_together() {
    let scene = lidded();
    let all = Interfaces::new(&scene);
    assert!(all.near_misses.is_empty() && all.slivers.is_empty() && all.notices.is_empty());
    let block = |n: usize| BodyId::Block(BlockId(n));
    let pairs: Vec<[BodyId; 2]> = all.all.iter().map(|i| i.bodies).collect();
    let (u, bar, lid) = (block(0), block(1), block(2));
    let ground = BodyId::Ground(0);
    let expected = [[u, ground], [bar, u], [bar, u], [bar, u], [lid, u], [lid, u], [lid, bar]];
    assert_eq!(pairs, expected);
    let lattice = scene.lattice.expect("a lattice");
    let cells = |id: BodyId| scene.body(id).cells.clone().expect("cells");
    let mut edges = LatticeEdges::default();
    let mut sorted = Vec::new();
    for id in [ground, u, bar, lid] {
        edges.add(id, &cells(id));
        let mut own = edges.interfaces_of(&scene, &lattice, id, &cells(id));
        own.sort_by(|a, b| {
            let place = |i: &Interface| [i.ends[0].x, i.ends[0].y, i.ends[1].x, i.ends[1].y];
            let order = a.bodies.cmp(&b.bodies);
            order.then(place(a).partial_cmp(&place(b)).expect("numbers"))
        });
        sorted.extend(own);
    }
    assert_eq!(sorted, all.all);
    // Without the bar the lid lies on the arms of the U alone.
    edges.remove(bar, &cells(bar));
    let left = edges.interfaces_of(&scene, &lattice, lid, &cells(lid));
    let pairs: Vec<[BodyId; 2]> = left.iter().map(|i| i.bodies).collect();
    assert_eq!(pairs, [[lid, u], [lid, u]]);
}

/// A slope of triangles with one tip in the middle of its side and another on its top.
#[test]
fn tips_of_cells_touch_sides_and_tips_at_nodes() {
    let triangles = |list: &[(f64, f64, CellHalf)]| {
        let cells = list.iter().map(|(x, y, half)| CellEntry::Triangle(*x, *y, *half));
        cells.collect::<Vec<_>>()
    };
    let (up, down) = (CellHalf::Up, CellHalf::Down);
    let slope = triangles(&[(0.0, 0.0, up), (0.0, 1.0, down), (0.0, 1.0, up), (0.0, 2.0, down), (0.0, 2.0, up)]);
    let scene = Scene::builder()
        .grid(GridKind::Triangular, 0.3)
        .friction(0.5)
        .corner_contacts(true)
        .ground(GroundEntry::default().cells(slope))
        .block(BlockEntry::new("beside").cells(triangles(&[(-1.0, 1.0, up)])))
        .block(BlockEntry::new("above").cells(triangles(&[(0.0, 3.0, up)])))
        .build()
        .expect("the scene is valid");
    let found = Interfaces::new(&scene).all;
    let root = libm::sqrt(0.75);
    let expected = [(FIRST, [0.5, root], [-root, 0.5]), (SECOND, [1.5, 3.0 * root], [0.5, root])];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (tip, (body, at, normal)) in found.iter().zip(expected) {
        assert_eq!(tip.bodies, [body, BodyId::Ground(0)]);
        assert_eq!(tip.kind, ContactKind::Corner);
        assert!(near(tip.ends[0].coords, at.map(|v| 0.3 * v)), "{tip:?}");
        assert!(near(tip.normal, normal), "{tip:?}");
    }
}

/// A row of cells next to the slope shares its side of 0.6 m. This is one interface with exact coordinates.
#[test]
fn rows_of_triangles_share_slanted_sides() {
    let triangles = |list: &[(f64, f64, CellHalf)]| {
        let cells = list.iter();
        let cells = cells.map(|(x, y, half)| CellEntry::Triangle(*x, *y, *half));
        cells.collect::<Vec<_>>()
    };
    let (up, down) = (CellHalf::Up, CellHalf::Down);
    let slope = [(7.0, 5.0, up), (7.0, 6.0, down), (7.0, 6.0, up)];
    let beside = [(6.0, 6.0, down), (6.0, 6.0, up), (6.0, 7.0, down)];
    let scene = Scene::builder()
        .grid(GridKind::Triangular, 0.3)
        .friction(0.5)
        .ground(GroundEntry::default().cells(triangles(&slope)))
        .block(BlockEntry::new("beside").cells(triangles(&beside)))
        .build()
        .expect("the scene is valid");
    let found = Interfaces::new(&scene).all;
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0].length() - 0.6).abs() < 1e-12);
    assert!(near(found[0].normal, [-libm::sqrt(0.75), 0.5]));
    // The interface extends from node to node, to the last digit.
    let lattice = scene.lattice.expect("a lattice");
    let ends = [(7, 7), (7, 5)].map(|node| lattice.node(node));
    assert_eq!(found[0].ends, ends);
    assert!(near(ends[1].coords, [0.3 * 9.5, 1.5 * libm::sqrt(0.75)]));
}

/// Forces between parts of the ground have no influence, so there are no contacts between them.
#[test]
fn parts_of_the_ground_have_no_contacts_with_each_other() {
    let part = |x: f64, y: f64| GroundEntry::default().cells(squares(&[(x, y)]));
    let cells = Scene::builder()
        .grid(GridKind::Square, 2.0)
        .friction(0.5)
        .corner_contacts(true)
        .ground(part(0.0, 0.0))
        .ground(part(1.0, 0.0))
        .ground(part(2.0, 1.0))
        .block(BlockEntry::new("on").cells(squares(&[(0.0, 1.0)])))
        .build()
        .expect("the scene is valid");
    let on = [FIRST, BodyId::Ground(0)];
    let tip = [FIRST, BodyId::Ground(1)];
    let pairs = |scene: &Scene| {
        let found = Interfaces::new(scene).all;
        found.iter().map(|i| i.bodies).collect::<Vec<_>>()
    };
    assert_eq!(pairs(&cells), [on, tip]);
    let drawn = scene(
        vec![rectangle(0.0, 0.0, 1.0, 1.0), rectangle(1.0, 0.0, 1.0, 1.0), rectangle(2.0, 1.0, 1.0, 1.0)],
        vec![rectangle(0.0, 1.0, 0.5, 1.0)],
    );
    assert_eq!(pairs(&drawn), [on]);
}
