//! Every valid random pile of bricks has a result with finite numbers and a figure. A decided verdict has a proof
//! that holds; an undecided one has a reason. Nothing panics.

#![no_main]

use arbitrary::Arbitrary;
use drystone::analysis::Verdict;
use drystone::scene::format::{BlockEntry, LimitsEntry, LoadEntry, Pair, RobotEntry, SceneFile};
use drystone::{Analysis, Scene, figure, output};
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Heap {
    friction: u8,
    kernel: u8,
    gravity: (i8, i8),
    corner_contacts: bool,
    bricks: Vec<Brick>,
    held: Option<(u8, u16)>,
    load: Option<(u8, i16, i16)>,
}

/// A brick that is placed on the highest brick below it. A leaning brick is a parallelogram.
#[derive(Arbitrary, Debug)]
struct Brick {
    x: u8,
    width: u8,
    height: u8,
    lean: i8,
    weight: u16,
}

fn corners(x: f64, y: f64, width: f64, height: f64, lean: f64) -> [Pair; 4] {
    [[x, y], [x + width, y], [x + width + lean, y + height], [x + lean, y + height]]
}

fn made(heap: &Heap) -> SceneFile {
    let mut file = Scene::builder()
        .friction(f64::from(heap.friction) / 64.0)
        .kernel(f64::from(heap.kernel) / 255.0)
        .gravity([f64::from(heap.gravity.0) / 16.0, f64::from(heap.gravity.1) / 16.0])
        .corner_contacts(heap.corner_contacts)
        .ground(corners(-1.0, -1.0, 12.0, 1.0, 0.0));
    let mut tops: Vec<(f64, f64, f64)> = Vec::new();
    for (number, brick) in heap.bricks.iter().take(12).enumerate() {
        let (x, width) = (f64::from(brick.x % 20) * 0.5, f64::from(brick.width % 6) * 0.5 + 0.5);
        let (height, lean) = (f64::from(brick.height % 4) * 0.5 + 0.5, f64::from(brick.lean % 2) * 0.25);
        let (from, to) = (x + lean.min(0.0), x + width + lean.max(0.0));
        let below = tops.iter().filter(|t| t.0 < to && from < t.1).map(|t| t.2).fold(0.0, f64::max);
        tops.push((from, to, below + height));
        file.blocks.push(
            BlockEntry::new(number.to_string())
                .polygon(corners(x, below, width, height, lean))
                .weight(f64::from(brick.weight)),
        );
    }
    let name = |k: u8| file.blocks.get(usize::from(k)).and_then(|b| b.id.clone());
    if let Some((block, limit)) = heap.held {
        let limits = LimitsEntry::default().force(f64::from(limit)).torque(f64::from(limit % 7));
        let mut robot = RobotEntry::default().limits(limits);
        robot.holds = name(block);
        file.robots.push(robot);
    }
    if let Some((block, x, y)) = heap.load
        && let Some(block) = name(block)
    {
        let load = LoadEntry::on(block).force([f64::from(x), f64::from(y)]);
        file.loads.push(load);
    }
    file
}

fuzz_target!(|heap: Heap| {
    let Ok(scene) = Scene::new(made(&heap)) else {
        return;
    };
    let analysis = Analysis::new(&scene);
    for frame in &analysis.frames {
        assert!(frame.total_force.is_finite() && frame.total_sticking.is_finite());
        match frame.verdict {
            Verdict::Undecided => assert!(!frame.doubt().is_empty()),
            _ => assert!(frame.proof.holds(), "{:?}", frame.proof),
        }
        for contact in &frame.contacts {
            assert!(contact.normal_forces.iter().all(|n| *n >= 0.0 && n.is_finite()));
        }
    }
    assert!(output::svg::write(&figure::forces(&analysis, &figure::Options::default())).ends_with("</svg>\n"));
});
