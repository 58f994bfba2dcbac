//! The command `figures`, free-body diagrams, animated steps, and books.

use std::fs;

use super::Bench;

#[test]
fn the_gallery_is_drawn_in_every_format_with_captions() {
    let bench = Bench::new();
    let ran = bench.run("figures -o gallery --theme paper");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.err.contains("10 figures, 31 files"), "{}", ran.err);
    let captions = fs::read_to_string(bench.path("gallery/captions.md")).expect("captions");
    for name in [
        "figure-1",
        "figure-2",
        "figure-3a",
        "figure-3b",
        "figure-4",
        "figure-5",
        "figure-6",
        "figure-7",
        "figure-8",
        "figure-9",
    ] {
        for (ending, begins) in [("svg", b"<svg".as_slice()), ("png", b"\x89PNG"), ("pdf", b"%PDF")] {
            let bytes = fs::read(bench.path(&format!("gallery/{name}.{ending}"))).expect("drawn");
            assert!(bytes.starts_with(begins) && bytes.len() > 2000, "{name}.{ending}");
        }
        assert!(captions.contains(&format!("**{name}** ")), "{name}");
    }
    // With corner contacts, which the source leaves out, the bridge stands.
    assert!(captions.contains("a bridge of five blocks. It falls: "));
    assert!(captions.contains("The same with corner contacts. It stands."));
    assert!(captions.contains("robot r0 would have to give 5.74 N·m more torque"));
    let ran = bench.run("figures -o one --format svg");
    assert!(ran.err.contains("10 figures, 11 files"), "{}", ran.err);
}

#[test]
fn the_block_of_a_free_body_is_chosen_by_its_name() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json -o free.svg --kind freebody --block lintel");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let svg = fs::read_to_string(bench.path("free.svg")).expect("drawn");
    assert!(svg.contains("Force F_1^(2) on block lintel"));
    for (line, message) in [
        ("render stands.json -o a.svg --kind freebody", "add --block with one of these names: left, right, lintel"),
        ("render stands.json -o a.svg --kind freebody --block lintl", "did you mean lintel?"),
        ("render stands.json -o a.svg --block lintel", "add --kind freebody"),
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, 2, "{line}");
        assert!(ran.err.contains(message), "{line}: {}", ran.err);
    }
    assert!(!bench.path("a.svg").exists());
}

#[test]
fn steps_follow_one_another_in_an_animated_png() {
    let bench = Bench::new();
    let ran = bench.run("render falls.json -o steps.png --kind build --animate 0.5");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let bytes = fs::read(bench.path("steps.png")).expect("drawn");
    let at = bytes.windows(4).position(|w| w == b"acTL").expect("it is animated");
    assert_eq!(bytes[at + 4..at + 8], 2_u32.to_be_bytes(), "two frames");
    let delay = bytes.windows(4).position(|w| w == b"fcTL").expect("frames") + 24;
    assert_eq!(bytes[delay..delay + 4], [0, 50, 0, 100], "50 hundredths of a second");
    let ran = bench.run("render falls.json -o steps.gif --kind build --animate 0.5");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let bytes = fs::read(bench.path("steps.gif")).expect("drawn");
    assert!(bytes.starts_with(b"GIF89a"));
    assert_eq!(bytes[6..8], 800_u16.to_le_bytes(), "800 pixels wide");
    for line in [
        "render falls.json -o steps.svg --kind build --animate 0.5",
        "render falls.json -o steps.png --animate 0",
        "render falls.json -o steps.png --kind freebody --block left --animate 1",
    ] {
        assert_eq!(bench.run(line).code, 2, "{line}");
    }
}

#[test]
fn each_panel_is_written_to_a_separate_file() {
    let bench = Bench::new();
    let ran = bench.run("render falls.json -o step.svg --panels");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(!bench.path("step.svg").exists());
    for name in ["step-a.svg", "step-b.svg"] {
        let svg = fs::read_to_string(bench.path(name)).expect(name);
        assert_eq!(svg.matches("class=\"frame\"").count(), 1, "{name}");
    }
    for line in [
        "render falls.json -o - --panels",
        "render stands.json -o a.svg --kind freebody --block left --panels",
        "render falls.json -o a.png --kind build --animate 1 --panels",
    ] {
        assert_eq!(bench.run(line).code, 2, "{line}");
    }
}

#[test]
fn the_surroundings_of_a_block_are_chosen_by_its_name() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json -o near.svg --zoom lintel --fill none");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let svg = fs::read_to_string(bench.path("near.svg")).expect("drawn");
    assert!(svg.contains("around block lintel"));
    let ran = bench.run("render stands.json -o near.svg --zoom lintl");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("did you mean lintel?"), "{}", ran.err);
}

#[test]
fn a_figure_for_latex_contains_its_text_and_closes_its_groups() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json -o a.tikz --width-mm 84");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let tikz = fs::read_to_string(bench.path("a.tikz")).expect("drawn");
    let count = |what: &str| tikz.matches(what).count();
    assert_eq!((count("\\begin{tikzpicture}"), count("\\end{tikzpicture}")), (1, 1));
    assert_eq!(count("\\begin{scope}"), count("\\end{scope}"));
    assert!(tikz.contains("{lintel}") && tikz.contains("{stands}"));
    assert!(!tikz.contains("NaN") && !tikz.contains("inf"));
}

#[test]
fn quotes_in_a_title_need_no_font_encoding_of_latex() {
    let bench = Bench::new();
    let scene = r#"{ "drystone": 1, "title": "the \"arch\"", "ground": [{ "polygon": [[-1,-1],[3,-1],[3,0],[-1,0]] }],
        "blocks": [{ "id": "the \"key\"", "polygon": [[0,0],[1,0],[1,1],[0,1]] }] }"#;
    fs::write(bench.path("quotes.json"), scene).expect("a scene");
    let ran = bench.run("render quotes.json -o a.tikz");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let tikz = fs::read_to_string(bench.path("a.tikz")).expect("drawn");
    let is_drawn = |line: &&str| !line.starts_with('%');
    assert!(tikz.contains("{the \\char34{}key\\char34{}}"), "{tikz}");
    assert!(tikz.lines().filter(is_drawn).all(|line| !line.contains('"')), "{tikz}");
}

#[test]
fn characters_that_no_font_has_are_named_and_never_drawn_as_boxes() {
    let bench = Bench::new();
    let scene = r#"{ "drystone": 1, "title": "石塔", "ground": [{ "polygon": [[-1,-1],[3,-1],[3,0],[-1,0]] }],
        "blocks": [{ "id": "لوح", "polygon": [[0,0],[2,0],[2,1],[0,1]], "weight": 4 }] }"#;
    fs::write(bench.path("stone.json"), scene).expect("writable");
    for line in ["render stone.json -o s.png", "render stone.json -o s.pdf", "render stone.json -o s.svg --text paths"]
    {
        let ran = bench.run(line);
        assert_eq!(ran.code, 0, "{line}: {}", ran.err);
        for named in ["石 (U+77F3)", "塔 (U+5854)", "U+0644", "--font FILE"] {
            assert!(ran.err.contains(named), "{line}: {}", ran.err);
        }
    }
    let svg = fs::read_to_string(bench.path("s.svg")).expect("drawn");
    assert!(svg.contains("aria-label=\"U+77F3\u{a0}5854\""), "spelled out");
    // In SVG the text stays as it is, because the browser has its own fonts.
    let ran = bench.run("render stone.json -o named.svg");
    assert!(ran.code == 0 && !ran.err.contains("warning"), "{}", ran.err);
    let svg = fs::read_to_string(bench.path("named.svg")).expect("drawn");
    assert!(svg.contains(">石塔</text>"));
    for (line, message) in [
        ("render stone.json -o s.png --font stone.json", "it is not a font"),
        ("render stone.json -o s.png --font none.ttf", "none.ttf"),
    ] {
        let ran = bench.run(line);
        assert!(ran.code == 2 && ran.err.contains(message), "{line}: {}", ran.err);
    }
}

#[test]
fn a_book_with_an_invalid_scene_fails() {
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
    assert!(ran.err.contains("one.md, line 3: the scene is not valid"), "{}", ran.err);
}

#[test]
fn two_scenes_are_compared_and_invalid_comparisons_are_reported() {
    let bench = Bench::new();
    let text = fs::read_to_string(bench.path("stands.json")).expect("there");
    let heavier = text.replace("\"weight\": 11", "\"weight\": 9").replace("0.6", "0.5");
    assert_ne!(heavier, text);
    fs::write(bench.path("lighter.json"), &heavier).expect("writable");
    let ran = bench.run("render stands.json lighter.json --kind compare -o diff.svg");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let svg = fs::read_to_string(bench.path("diff.svg")).expect("drawn");
    assert!(svg.contains("changed: lintel"), "{svg}");
    assert!(svg.contains("friction 0.5 in place of 0.6"), "{svg}");
    // The outline of the lintel does not change, so no previous outline is drawn.
    assert!(!svg.contains("class=\"gone\"") && svg.contains("class=\"new\""));
    assert!(svg.contains("new or changed"), "{svg}");
    // The lintel and the joints below it are in both scenes, although its weight differs: all joints are compared.
    assert!(svg.contains("4 of 4 shared forces changed"), "{svg}");
    assert_eq!(svg.matches("class=\"change\"").count(), 4);
    let ran = bench.run("render stands.json stands.json --kind compare -o same.svg");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let svg = fs::read_to_string(bench.path("same.svg")).expect("drawn");
    assert!(svg.contains("none of "), "{svg}");
    assert!(svg.contains(" shared forces changed by over 5 %"), "{svg}");
    let other = text.replace("-1, -1", "-2, -1");
    assert_ne!(other, text);
    fs::write(bench.path("other.json"), &other).expect("writable");
    let ran = bench.run("render stands.json other.json --kind compare -o no.svg");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("the second scene has another ground"), "{}", ran.err);
    let ran = bench.run("render stands.json lighter.json --kind forces -o no.svg");
    assert_eq!(ran.code, 2);
    assert!(!bench.path("no.svg").exists());
}

#[test]
fn a_strip_too_large_for_a_png_is_refused_with_options_to_split_it() {
    let bench = Bench::new();
    let steps = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/steps30.json");
    fs::copy(steps, bench.path("steps.json")).expect("copied");
    for (scene, split) in [("steps", "; or split its 30 steps: --pages"), ("stands", "")] {
        let ran = bench.run(&format!("render {scene}.json --width 31000 -o {scene}.png"));
        assert_eq!(ran.code, 2);
        assert!(ran.err.contains("at most 100 million"), "{}", ran.err);
        assert!(ran.err.contains(split), "{}", ran.err);
        assert!(ran.err.contains("split") != split.is_empty(), "{}", ran.err);
    }
}

#[test]
fn a_long_strip_is_split_into_pages_and_a_margin_has_a_direction() {
    let bench = Bench::new();
    let steps = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/steps30.json");
    fs::copy(steps, bench.path("steps.json")).expect("copied");
    let ran = bench.run("render steps.json --theme thesis --columns 3 --pages -o steps.svg");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let mut frames = 0;
    let mut pages = 0;
    while let Ok(svg) = fs::read_to_string(bench.path(&format!("steps-{}.svg", pages + 1))) {
        pages += 1;
        frames += svg.matches("class=\"frame\"").count();
        let number = |name: &str| -> f64 {
            let rest = svg.split(&format!(" {name}=\"")).nth(1).expect(name);
            rest.split('"').next().and_then(|n| n.parse().ok()).expect(name)
        };
        assert!(number("height") <= 1.42 * number("width"), "page {pages}");
    }
    assert_eq!(frames, 30);
    assert_eq!(pages, 2, "with two pages, the message lists both files");
    let files = "steps-1.svg and steps-2.svg: 30 frames";
    assert!(ran.err.contains(files), "{}", ran.err);
    let ran = bench.run("render stands.json --zoom elephant -o no.svg");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("; the blocks are "), "{}", ran.err);
    let ran = bench.run("render stands.json --margin load-factor -o no.svg");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("--kind mechanism"), "{}", ran.err);
    let ran = bench.run("render stands.json --kind mechanism --at horizontal-load -o push.svg");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let svg = fs::read_to_string(bench.path("push.svg")).expect("drawn");
    assert!(svg.contains("horizontal load, as a share of the weights: "), "{svg}");
}
