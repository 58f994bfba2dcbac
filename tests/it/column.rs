//! Figures of real structures in one column of a journal, 84 mm wide: faults that readers found once.

use drystone::Analysis;
use drystone::analysis::Options as AnalysisOptions;
use drystone::drawing::{Drawing, Group, PagePoint};
use drystone::figure::{self, Kind, Options};

use crate::labels::{COLUMN, classes, ink, pieces, texts};
use crate::pictures::scene;

fn drawn(name: &str, kind: Kind) -> Drawing {
    let scene = scene(&format!("tests/reference/column/{name}.json"));
    figure::draw(&Analysis::with(&scene, &AnalysisOptions::default()), kind, &Options::default().width(COLUMN))
}

fn words(drawing: &Drawing) -> String {
    let page = Group { items: drawing.items.clone(), ..Group::default() };
    texts(&page).iter().map(|text| format!("{}\n", text.words)).collect()
}

/// True if a point of the line lies in the box.
fn crosses([left, top, right, bottom]: [f64; 4], [a, b]: [PagePoint; 2]) -> bool {
    (0..=40).any(|i| {
        let t = f64::from(i) / 40.0;
        let (x, y) = (a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
        left < x && x < right && top < y && y < bottom
    })
}

#[test]
fn no_label_lies_on_the_outline_of_a_planned_block() {
    let mut outlines = 0;
    for (name, kind) in [("bridge8", Kind::Forces), ("bridge8", Kind::Thrust), ("robotcorbel", Kind::Forces)] {
        let drawing = drawn(name, kind);
        for panel in classes(&drawing.items, &["picture"]) {
            let labels: Vec<_> = classes(&panel.items, &["labels"]).into_iter().flat_map(texts).collect();
            for plan in classes(&panel.items, &["plan"]) {
                outlines += 1;
                for label in &labels {
                    assert!(!pieces(plan).iter().any(|line| crosses(ink(label), *line)), "{name}: {}", label.words);
                }
            }
        }
    }
    assert!(outlines >= 5, "{outlines}");
}

#[test]
fn the_line_of_thrust_of_what_falls_leaves_the_stone_or_is_too_steep_where_it_says_so() {
    let drawing = drawn("corbel_falls", Kind::Thrust);
    assert_eq!(classes(&drawing.items, &["leaves"]).len(), 8);
    assert!(words(&drawing).contains("leaves the stone at 8 joints"), "{}", words(&drawing));
    // Here every joint has its force inside, and one lacks friction.
    let drawing = drawn("flyingbuttress_over", Kind::Thrust);
    assert_eq!(classes(&drawing.items, &["leaves", "slips"]).len(), 1);
    assert!(words(&drawing).contains("too steep for friction at 1 joint"), "{}", words(&drawing));
}

#[test]
fn a_strip_of_many_steps_is_not_much_higher_than_wide() {
    for (name, kind, most) in [
        ("robotcorbel", Kind::Forces, 1.4),
        ("robotcorbel", Kind::Flow, 1.4),
        ("bridge8", Kind::Thrust, 1.4),
        // The labels of the robots need half a column.
        ("bridge8", Kind::Forces, 2.1),
    ] {
        let drawing = drawn(name, kind);
        assert!(drawing.height <= most * drawing.width, "{name}: {} by {}", drawing.width, drawing.height);
    }
}

#[test]
fn the_key_states_the_scale_of_missing_forces_and_what_is_drawn_at_the_ground() {
    let drawing = drawn("robotcorbel", Kind::Forces);
    // The missing forces have the scale of the joints, in which all of them are too short to see.
    assert!(words(&drawing).contains("missing; stub: under 5 kN"), "{}", words(&drawing));
    assert!(words(&drawing).contains("one head at ground"), "{}", words(&drawing));
}

#[test]
fn the_flow_at_the_foot_of_a_pier_stays_in_the_pier() {
    let drawing = drawn("flyingbuttress_over", Kind::Flow);
    let points = |class: &str| -> Vec<PagePoint> {
        let groups = classes(&drawing.items, &[class]);
        groups.into_iter().flat_map(pieces).flatten().collect()
    };
    let (bands, stones) = (points("strand"), points("block"));
    let bottom = stones.iter().map(|p| p.y).fold(f64::MIN, f64::max);
    let right = |points: &[PagePoint]| points.iter().map(|p| p.x).fold(f64::MIN, f64::max);
    let foot: Vec<PagePoint> = bands.into_iter().filter(|p| p.y > bottom - 1.0).collect();
    assert!(foot.len() >= 4 && right(&foot) <= right(&stones) + 0.5, "{} beyond {}", right(&foot), right(&stones));
}
