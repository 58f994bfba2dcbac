//! `figures`, free-body diagrams, steps one after the other, and books.

use std::fs;

use super::Bench;

#[test]
fn the_gallery_is_drawn_in_every_format_with_captions() {
    let bench = Bench::new();
    let ran = bench.run("figures -o gallery --theme paper");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.err.contains("13 figures, 40 files"), "{}", ran.err);
    let captions = fs::read_to_string(bench.path("gallery/captions.md")).expect("captions");
    for name in [
        "figure-1",
        "figure-2",
        "figure-3a",
        "figure-3b",
        "figure-4",
        "figure-5",
        "figure-6-kernel-02",
        "figure-7",
        "figure-8",
        "figure-9a",
        "figure-9b",
    ] {
        for (ending, begins) in [
            ("svg", b"<svg".as_slice()),
            ("png", b"\x89PNG"),
            ("pdf", b"%PDF"),
        ] {
            let bytes = fs::read(bench.path(&format!("gallery/{name}.{ending}"))).expect("drawn");
            assert!(
                bytes.starts_with(begins) && bytes.len() > 2000,
                "{name}.{ending}"
            );
        }
        assert!(captions.contains(&format!("**{name}** ")), "{name}");
    }
    // What the source leaves out carries what it refuses.
    assert!(captions.contains("a bridge of five blocks. It falls: "));
    assert!(captions.contains("The same with corner contacts. It stands."));
    assert!(captions.contains("robot r0 would have to give a torque of 5.74 N·m"));
    let ran = bench.run("figures -o one --format svg");
    assert!(ran.err.contains("13 figures, 14 files"), "{}", ran.err);
}

#[test]
fn a_block_is_cut_free_by_its_name() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json -o free.svg --kind freebody --block lintel");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let svg = fs::read_to_string(bench.path("free.svg")).expect("drawn");
    assert!(svg.contains("Force F_1^(2) on block lintel"));
    for (line, said) in [
        (
            "render stands.json -o a.svg --kind freebody",
            "choose with --block one of left, right, lintel",
        ),
        (
            "render stands.json -o a.svg --kind freebody --block lintl",
            "did you mean lintel?",
        ),
        (
            "render stands.json -o a.svg --block lintel",
            "add --kind freebody",
        ),
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, 2, "{line}");
        assert!(ran.err.contains(said), "{line}: {}", ran.err);
    }
    assert!(!bench.path("a.svg").exists());
}

#[test]
fn steps_follow_one_another_in_an_animated_png() {
    let bench = Bench::new();
    let ran = bench.run("render falls.json -o steps.png --kind build --animate 0.5");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let bytes = fs::read(bench.path("steps.png")).expect("drawn");
    let at = bytes
        .windows(4)
        .position(|w| w == b"acTL")
        .expect("it is animated");
    assert_eq!(bytes[at + 4..at + 8], 2_u32.to_be_bytes(), "two frames");
    let delay = bytes.windows(4).position(|w| w == b"fcTL").expect("frames") + 24;
    assert_eq!(
        bytes[delay..delay + 4],
        [0, 50, 0, 100],
        "50 hundredths of a second"
    );
    for line in [
        "render falls.json -o steps.svg --kind build --animate 0.5",
        "render falls.json -o steps.png --animate 0",
        "render falls.json -o steps.png --kind freebody --block left --animate 1",
    ] {
        assert_eq!(bench.run(line).code, 2, "{line}");
    }
}

#[test]
fn a_broken_scene_breaks_the_book() {
    let bench = Bench::new();
    assert_eq!(bench.run("mdbook supports html").code, 0);
    assert_eq!(bench.run("mdbook supports markdown").code, 1);
    let book = |content: &str| {
        format!(
            r#"[{{"root": ".", "config": {{"book": {{"src": "src"}}}}}},
                {{"sections": [{{"Chapter": {{"name": "One", "content": {content:?}, "sub_items": [], "path": "one.md"}}}}]}}]"#
        )
    };
    let ran = bench.run_with("mdbook", book("# One\n\nNothing to draw.\n").as_bytes());
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("Nothing to draw."));
    let ran = bench.run_with("mdbook", book("# One\n\n```drystone\n{}\n```\n").as_bytes());
    assert_eq!((ran.code, ran.out.as_str()), (2, ""));
    assert!(
        ran.err.contains("one.md, line 3: the scene is wrong"),
        "{}",
        ran.err
    );
}
