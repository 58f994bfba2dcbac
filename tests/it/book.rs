//! The mdBook preprocessor: how it changes the chapters of a book, and the messages if it cannot.

use drystone::report::book::{illustrate, illustrate_text};
use serde_json::{Value, json};

const SCENE: &str = r#"{ "drystone": 1, "title": "An overhang",
  "ground": [{ "polygon": [[0, 0], [2, 0], [2, -1], [0, -1]] }],
  "blocks": [{ "id": "plank", "polygon": [[1, 0], [5, 0], [5, 1], [1, 1]], "weight": 8 }] }"#;

/// The input that mdbook sends to a preprocessor, for a book with one chapter and one subchapter.
fn input(chapter: &str, below: &str) -> String {
    let chapter_of = |name: &str, content: &str, items: Value| {
        json!({ "Chapter": { "name": name, "content": content, "number": [1], "sub_items": items,
            "path": format!("{name}.md"), "source_path": format!("{name}.md"), "parent_names": [] } })
    };
    let inner = chapter_of("inner", below, json!([]));
    let root = env!("CARGO_MANIFEST_DIR");
    let context = json!({ "root": root, "renderer": "html", "mdbook_version": "0.5.1",
        "config": { "book": { "src": "assets/thesis" } } });
    json!([context, { "items": [chapter_of("outer", chapter, json!([inner])), "Separator"] }]).to_string()
}

fn contents(book: &str) -> [String; 2] {
    let book: Value = serde_json::from_str(book).expect("a book");
    assert_eq!(book["items"][1], "Separator");
    let outer = &book["items"][0]["Chapter"];
    let inner = &outer["sub_items"][0]["Chapter"];
    [outer, inner].map(|c| c["content"].as_str().expect("content").to_owned())
}

#[test]
fn scenes_become_figures_with_captions_and_the_rest_of_a_chapter_is_unchanged() {
    let chapter = format!("# One\n\n```drystone\n{SCENE}\n```\n\nAfter it.\n\n```rust\nlet drystone = 1;\n```\n");
    let below = "A list:\n\n- item\n\n```drystone file=figure-8-right.json kind=mechanism theme=dark\n```\n";
    let [outer, inner] = contents(&illustrate(&input(&chapter, below)).expect("drawn"));
    assert!(outer.starts_with("# One\n\n<figure class=\"drystone\""), "{outer}");
    assert!(outer.contains("<svg xmlns") && outer.contains("<title id="));
    assert!(outer.contains("<figcaption>An overhang. It falls: block plank would have to stick"));
    assert!(outer.ends_with("\n\nAfter it.\n\n```rust\nlet drystone = 1;\n```\n"), "{outer}");
    let figure = &outer[outer.find("<figure").expect("there")..outer.find("</figure>").expect("there")];
    assert!(!figure.contains("\n\n"), "an empty line would end the HTML");
    assert!(inner.contains("<figcaption>Figure 8, right: a bridge of five blocks. It falls"));
    assert!(inner.contains("#15181d"), "the dark page");
}

#[test]
fn a_figure_stays_inside_its_list_and_its_quotation() {
    let chapter = "- item\n\n  ```drystone file=figure-1.json\n  ```\n\n- next\n";
    let below = "> said\n>\n> ```drystone file=figure-1.json\n> ```\n>\n> more\n";
    let drawn = contents(&illustrate(&input(chapter, below)).expect("drawn"));
    for (content, margin) in drawn.iter().zip(["  ", "> "]) {
        let figure = content.find("<figure").expect("a figure");
        let end = content.find("</figure>").expect("its end");
        assert!(content[figure..end].lines().skip(1).all(|l| l.starts_with(margin)), "{content}");
    }
    assert!(drawn[0].ends_with("\n\n- next\n") && drawn[1].ends_with("> more\n"));
}

#[test]
fn every_broken_scene_is_reported_with_its_chapter_and_line() {
    let chapter = "one\ntwo\n\n```drystone\n{ \"drystone\": 1, \"blocks\": [{}] }\n```\n";
    let below = "```drystone file=nowhere.json\n```\n\n```drystone kind=spiral file=figure-1.json\n```\n\n```drystone colour=red\n```\n";
    let problems = illustrate(&input(chapter, below)).expect_err("all are broken").to_string();
    for message in [
        "outer.md, line 4: the scene is not valid",
        "inner.md, line 1: cannot read",
        "nowhere.json",
        "inner.md, line 4: there is no kind of figure \"spiral\"; known are forces, flow, mechanism",
        "inner.md, line 7: unknown option \"colour=red\"",
    ] {
        assert!(problems.contains(message), "{message} is not in {problems}");
    }
    for no_book in ["", "{}", "[1, 2]", "[{}, {}]"] {
        let problems = illustrate(no_book).expect_err("no book").to_string();
        assert!(problems.contains("mdbook runs the command itself"), "{problems}");
    }
}

/// A text of a stranger may name any file. What is in a file that is no scene is not quoted.
#[test]
fn the_content_of_a_file_that_is_no_scene_is_not_quoted() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("secret.txt"), "password = hunter2\n").expect("writable");
    let text = "```drystone file=secret.txt\n```\n";
    let refused = illustrate_text(text, &folder.path().join("page.md"), "page").expect_err("no scene").to_string();
    assert!(refused.contains("secret.txt is no scene file") && !refused.contains("hunter2"), "{refused}");
}
