use super::*;
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::BodyId;
use crate::products::figure::design::unit;

fn falling() -> Vec<Scene> {
    [
        include_str!("../../../../assets/study/arch-27-thin.json"),
        include_str!("../../../../assets/study/stack-harmonic-falls.json"),
        include_str!("../../../../assets/thesis/figure-8-right.json"),
    ]
    .map(|text| Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}")))
    .into()
}

#[test]
fn displaced_blocks_keep_their_areas_and_sides() {
    for scene in falling() {
        let analysis = Analysis::new(&scene);
        let displaced = Course::new(&Fall::of(&analysis, 0), unit(&scene, None)).at(1.0);
        let mut count = 0;
        for (block, displacement) in scene.blocks.iter().zip(&displaced) {
            let Some(displacement) = displacement else {
                continue;
            };
            let (before, after) = (&block.body.polygon, displacement.polygon(&block.body.polygon));
            assert!((before.area() - after.area()).abs() < 1e-9 * before.area());
            for (a, b) in before.edges().zip(after.edges()) {
                assert!((a.length() - b.length()).abs() < 1e-9 * a.length());
            }
            count += 1;
        }
        assert!(count > 4, "{count} blocks move");
    }
}

#[test]
fn no_block_overlaps_another_during_the_displacement() {
    for scene in falling() {
        let analysis = Analysis::new(&scene).elementary();
        let course = Course::new(&Fall::of(&analysis, 0), unit(&scene, None));
        for step in 0..=20 {
            let displaced = course.at(f64::from(step) / 20.0);
            let blocks = scene.blocks.iter().zip(&displaced);
            let mut bodies: Vec<Polygon> = blocks
                .map(|(block, displacement)| match displacement {
                    Some(displacement) => displacement.polygon(&block.body.polygon),
                    None => block.body.polygon.clone(),
                })
                .collect();
            bodies.extend(scene.ground.iter().map(|g| g.body.polygon.clone()));
            for (i, a) in bodies.iter().enumerate() {
                for b in &bodies[..i] {
                    let common = overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), 0.0);
                    let share = common.map_or(0.0, |o| o.area) / a.area().min(b.area());
                    assert!(share < 0.005, "{share} of the smaller at step {step}");
                }
            }
        }
    }
}

#[test]
fn hinges_stay_closed_during_the_displacement() {
    let scene = &falling()[0];
    let analysis = Analysis::new(scene).elementary();
    let displaced = Course::new(&Fall::of(&analysis, 0), unit(scene, None)).at(1.0);
    let at = |body: BodyId, p: Point| match body {
        BodyId::Block(id) => displaced[id.0].map_or(p, |d| d.moved(p)),
        BodyId::Ground(_) => p,
    };
    let mut hinges = 0;
    for joint in Fall::of(&analysis, 0).joints {
        let Some(hinge) = joint.hinge else { continue };
        let [a, b] = analysis.frames[0].contacts[joint.contact].interface.bodies;
        let gap = (at(a, hinge) - at(b, hinge)).norm();
        assert!(gap < 1e-5, "{gap} m");
        hinges += 1;
    }
    assert!(hinges >= 4, "{hinges}");
}

#[test]
fn a_rotation_keeps_its_centre_and_all_distances() {
    let centroid = Point::new(3.0, 2.0);
    let corner = Point::new(4.0, 1.0);
    for spin in [0.8, -1e-9, 0.0] {
        // The block rotates about the corner: the velocity of the centroid is spin × arm.
        let velocity = if spin == 0.0 { Vector::new(1.0, -0.5) } else { quarter_turn(centroid - corner) * spin };
        let motion = Motion { block: BlockId(0), velocity, spin };
        let moved = Displacement::along(&motion, centroid, 0.6);
        if spin != 0.0 {
            assert!((moved.moved(corner) - corner).norm() < 1e-12);
        } else {
            assert!((moved.moved(corner) - corner - velocity * 0.6).norm() < 1e-12);
        }
        let far = Point::new(-7.0, 5.0);
        let distance = (moved.moved(far) - moved.moved(centroid)).norm();
        assert!((distance - (far - centroid).norm()).abs() < 1e-12);
    }
}

#[test]
fn a_small_block_far_from_a_large_block_does_not_rotate_too_far() {
    let brick = |id: &str, x: f64, size: f64| {
        format!(
            r#"{{ "id": "{id}", "weight": 6,
                 "polygon": [[{x},0],[{},0],[{},{size}],[{x},{size}]] }}"#,
            x + size,
            x + size
        )
    };
    // Only the left third of each block rests on ground, so the block tips.
    let ground = |x: f64, size: f64| {
        format!(r#"{{ "polygon": [[{x},-1],[{},-1],[{},0],[{x},0]] }}"#, x + size / 3.0, x + size / 3.0)
    };
    let text = format!(
        r#"{{ "drystone": 1, "ground": [{}, {}], "blocks": [{}, {}] }}"#,
        ground(0.0, 9.0),
        ground(200.0, 0.3),
        brick("large", 0.0, 9.0),
        brick("small", 200.0, 0.3)
    );
    let scene = Scene::from_json(&text).unwrap_or_else(|problems| panic!("{problems}"));
    let displaced = Course::new(&Fall::of(&Analysis::new(&scene), 0), unit(&scene, None)).at(1.0);
    for (block, displacement) in scene.blocks.iter().zip(displaced) {
        let displacement = displacement.expect("a displaced block");
        let turned = displacement.turned(Vector::new(1.0, 0.0));
        assert!(libm::atan2(turned.y, turned.x).abs() < 0.36, "{}", block.id);
        let way = (displacement.moved(block.centroid) - block.centroid).norm();
        assert!(way > 0.02 * block.body.polygon.area().sqrt(), "{way}");
    }
}

#[test]
fn joints_that_could_only_stay_closed_at_rest_open() {
    // Two columns side by side, each of which turns about its own foot. At their joint they would slide without an
    // opening only if they did not turn.
    let column = |id: &str, x: f64| {
        format!(r#"{{ "id": "{id}", "weight": 8, "polygon": [[{x},0],[{},0],[{},4],[{x},4]] }}"#, x + 1.0, x + 1.0)
    };
    let text = format!(
        r#"{{ "drystone": 1, "friction": 0.3, "ground": [{{ "polygon": [[-5,-1],[6,-1],[6,0],[-5,0]] }}],
              "blocks": [{}, {}] }}"#,
        column("a", 0.0),
        column("b", 1.0)
    );
    let scene = Scene::from_json(&text).unwrap_or_else(|problems| panic!("{problems}"));
    let options = crate::mechanics::analysis::Options::default().margins(crate::mechanics::analysis::MarginKinds::ALL);
    let analysis = Analysis::with(&scene, &options);
    let (_, motions) = analysis.edge(0, crate::mechanics::analysis::MarginKind::Tilt).expect("it falls");
    let displaced = Course::new(&Fall::with(&analysis, 0, &motions), unit(&scene, None)).at(1.0);
    for (block, displacement) in scene.blocks.iter().zip(displaced) {
        let turned = displacement.expect("a displaced block").turned(Vector::new(1.0, 0.0));
        assert!(turned.y.abs() > 0.02, "block {} does not visibly turn", block.id);
    }
}
