//! Pictures that carry their scene file, and pictures for light and dark pages.

use std::collections::BTreeMap;
use std::fs;

use super::{Bench, FALLS, STANDS};

#[test]
fn a_picture_gives_its_scene_back_byte_for_byte() {
    let bench = Bench::new();
    // Line ends, a byte order mark and letters of any script survive.
    let odd = format!("\u{feff}{}\r\n\t\r\n", STANDS.replace('\n', "\r\n").replace("A lintel", "Türsturz ⟂"));
    for (name, text) in [("stands", STANDS), ("falls", FALLS), ("odd", &odd)] {
        fs::write(bench.path(&format!("{name}.json")), text).expect("writable");
        for ending in ["svg", "png", "pdf"] {
            let ran = bench.run(&format!("render {name}.json -o {name}.{ending}"));
            assert_eq!(ran.code, 0, "{}", ran.err);
            let option = if ending == "svg" { "--source" } else { "" };
            let ran = bench.run(&format!("import {name}.{ending} -o back.json --force {option}"));
            assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{name}.{ending}");
            assert_eq!(fs::read_to_string(bench.path("back.json")).expect("written"), text, "{name}.{ending}");
            let first = fs::read(bench.path(&format!("{name}.{ending}"))).expect("there");
            bench.run(&format!("render {name}.json -o {name}.{ending}"));
            assert!(first == fs::read(bench.path(&format!("{name}.{ending}"))).expect("there"), "{name}.{ending}");
        }
    }
    // Other programs find the chunk, with a valid checksum.
    let png = fs::read(bench.path("odd.png")).expect("there");
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
    reader.finish().expect("valid chunks");
    let chunk = &reader.info().utf8_text[0];
    assert_eq!((chunk.keyword.as_str(), chunk.get_text().expect("text")), ("drystone-scene", odd));
    // Each page and an animation carry it too.
    bench.run("render falls.json -o falls-{p}.png --panels");
    bench.run("render falls.json -o moves.png --kind build --animate 1");
    for name in ["falls-2.png", "moves.png"] {
        assert_eq!(bench.run(&format!("import {name}")).out, FALLS, "{name}");
    }
}

#[test]
fn a_picture_is_checked_and_drawn_as_its_scene() {
    let bench = Bench::new();
    let json = |file: &str| bench.run(&format!("check --json --no-timing {file}")).out.replace(file, "");
    for ending in ["png", "pdf"] {
        bench.run(&format!("render falls.json -o falls.{ending}"));
        assert_eq!(bench.run(&format!("check falls.{ending}")).code, 1);
        assert_eq!(json(&format!("falls.{ending}")), json("falls.json"));
    }
    assert_eq!(
        bench.run("render falls.png -o - --kind mechanism").out,
        bench.run("render falls.json -o - --kind mechanism").out
    );
    // The file of a picture with other values has these values, as the picture does.
    bench.run("render stands.json -o other.png --set friction=0.01");
    assert!(bench.run("import other.png").out.contains("with friction = 0.01"));
}

#[test]
fn pictures_without_a_scene_and_options_that_change_one_are_refused() {
    let bench = Bench::new();
    for ending in ["svg", "png", "pdf"] {
        bench.run(&format!("render stands.json -o full.{ending}"));
        bench.run(&format!("render stands.json -o bare.{ending} --no-source"));
        let sizes =
            ["full", "bare"].map(|name| fs::metadata(bench.path(&format!("{name}.{ending}"))).expect("there").len());
        assert!(sizes[0] > sizes[1] && sizes[0] < sizes[1] + 1200, "{ending}: {sizes:?}");
        let ran = bench.run(&format!("import bare.{ending} --source"));
        assert_eq!((ran.code, ran.out.as_str()), (2, ""));
        assert!(ran.err.contains("carries no scene"), "{}", ran.err);
    }
    bench.run("render stands.json stands.json --kind compare -o compare.png");
    for (line, words) in [
        ("check bare.png", "bare.png: this picture carries no scene"),
        ("check compare.png", "carries no scene"),
        ("import full.png --scale 1:50", "stays as it is"),
        ("import full.svg --source --json -o log.json", "stays as it is"),
        ("import full.png -o stands.json", "--force"),
        ("render full.png -o full.png", "the same file"),
    ] {
        let ran = bench.run(line);
        assert!(ran.code != 0 && ran.err.contains(words), "{line}: {}", ran.err);
    }
    // The shapes of an SVG decide, so that changes in an editor count.
    let svg = fs::read_to_string(bench.path("full.svg")).expect("there");
    assert!(svg.contains("<metadata data-drystone=\"scene\">"));
    let drawn = bench.run("import full.svg").out;
    assert!(drawn != STANDS && drawn == bench.run("import bare.svg").out, "{drawn}");
    // No name of a file is in a picture.
    let pdf = fs::read(bench.path("full.pdf")).expect("there");
    assert!(!String::from_utf8_lossy(&pdf).contains("stands.json"));
}

/// An SVG without the marks of its ids, and its colours with the names of their attributes.
fn apart(svg: &str, theme: &BTreeMap<(String, String), String>) -> (String, Vec<String>) {
    let mark = svg.split("aria-labelledby=\"").nth(1).and_then(|rest| rest.split('-').next()).expect("a mark");
    let svg = svg.replace(&format!("class=\"{mark}\" "), "").replace(mark, "");
    let mut parts = svg.split("=\"#");
    let mut text = parts.next().expect("a part").to_owned();
    let mut colours = Vec::new();
    for part in parts {
        let name = text.rsplit(' ').next().expect("a name").to_owned();
        let colour = part[..6].to_owned();
        colours.push(theme.get(&(name, colour.clone())).cloned().unwrap_or(colour));
        text.push_str(&part[6..]);
    }
    (text, colours)
}

#[test]
fn a_picture_for_light_and_dark_pages_has_the_colours_of_both_themes() {
    let bench = Bench::new();
    for (scene, words) in [
        ("stands", ""),
        ("falls", "--kind build"),
        ("falls", "--kind mechanism --text paths"),
        ("stands", "--kind joints --background none"),
        ("stands", "--kind mechanism --at tilt"),
        ("stands", "--kind structure"),
        ("stands", "--kind joints --amounts"),
        ("stands", "--fill none --arrows components"),
    ] {
        let drawn =
            |theme: &str| bench.run(&format!("render {scene}.json -o - --no-source --theme {theme} {words}")).out;
        let auto = drawn("auto");
        let (before, rest) = auto.split_once("<style>\n@media (prefers-color-scheme: dark) {\n").expect(words);
        let (rules, rest) = rest.split_once("}\n</style>\n").expect(words);
        let rules: BTreeMap<(String, String), String> = (rules.lines())
            .map(|rule| {
                let (name, rest) = rule.split_once('[').expect(rule).1.split_once("=\"#").expect(rule);
                let dark = rest.split_once(":#").expect(rule).1.trim_end_matches('}');
                ((name.to_owned(), rest[..6].to_owned()), dark.to_owned())
            })
            .collect();
        let picture = format!("{before}{rest}");
        assert_eq!(apart(&picture, &rules), apart(&drawn("dark"), &BTreeMap::new()), "{scene} {words}");
        let (auto, plain) = (apart(&picture, &BTreeMap::new()), apart(&drawn("plain"), &BTreeMap::new()));
        assert_eq!(auto.0, plain.0, "{scene} {words}");
        for (colour, is) in auto.1.iter().zip(&plain.1) {
            let [a, b] = [colour, is].map(|digits| u32::from_str_radix(digits, 16).expect("a colour"));
            assert!(a ^ b < 8, "{scene} {words}: {colour} {is}");
        }
    }
    let png = |theme: &str| {
        let ran = bench.run(&format!("render stands.json -o {theme}.png --no-source --theme {theme}"));
        assert_eq!(ran.code, 0, "{}", ran.err);
        fs::read(bench.path(&format!("{theme}.png"))).expect("there")
    };
    assert!(png("auto") == png("plain"), "a picture of pixels is for light pages");
    for (line, words) in [
        ("render stands.json -o a.svg --theme auto --background white", "leave out --background"),
        ("shapes -o a.svg --theme auto", "only for render, markdown and mdbook"),
        ("render stands.json -o a.svg --theme auto --style none.json", "leave out --theme auto"),
    ] {
        let ran = bench.run(line);
        assert!(ran.code == 2 && ran.err.contains(words), "{line}: {}", ran.err);
    }
}

#[test]
fn scenes_in_markdown_become_pictures_with_alt_text() {
    let bench = Bench::new();
    let text = format!(
        "# Walls\n\n```drystone theme=auto\n{STANDS}\n```\n\n- one\n\n  ```drystone file=falls.json kind=mechanism nocaption\n  ```\n\nEnd.\n"
    );
    fs::write(bench.path("in.md"), &text).expect("writable");
    let ran = bench.run("markdown in.md -o out/walls.md");
    assert_eq!((ran.code, ran.err.trim()), (0, "out/walls.md: 2 figures"), "{}", ran.err);
    assert_eq!(bench.made(), ["in.md", "out"]);
    let written = fs::read_to_string(bench.path("out/walls.md")).expect("written");
    let picture = |number: usize| fs::read_to_string(bench.path(&format!("out/walls-{number}.svg"))).expect("written");
    assert!(picture(1).contains("prefers-color-scheme") && !picture(2).contains("prefers-color-scheme"));
    let lines: Vec<&str> = written.lines().collect();
    assert!(lines[2].starts_with("![") && lines[2].ends_with("](<walls-1.svg>)"), "{written}");
    assert!(lines[4].starts_with('*') && lines[4].trim_matches('*') == &lines[2][2..lines[2].len() - 16], "{written}");
    assert!(written.contains("\n  ![") && written.ends_with("(<walls-2.svg>)\n\nEnd.\n"), "{written}");
    assert_eq!(bench.run("import out/walls-2.svg --source").out, FALLS);
    assert_eq!(bench.run("import out/walls-1.svg --source").out.trim_end(), STANDS.trim_end());
    for (input, output, words) in [
        ("in.md", "in.md", "the same file"),
        ("none.md", "b.md", "none.md"),
        ("wrong.json", "wrong.json", "the same file"),
    ] {
        let ran = bench.run(&format!("markdown {input} -o {output}"));
        assert!(ran.code == 2 && ran.err.contains(words), "{}", ran.err);
    }
    let ran = bench.run_with("markdown - -o c.md", b"a\n```drystone kind=spiral\n{}\n```\n");
    assert!(ran.code == 2 && ran.err.contains("line 2: "), "{}", ran.err);
    assert!(!bench.path("c.md").exists());
}
