//! Draws figures of the scenes in Markdown texts: [`illustrate`] is a preprocessor of mdBook, and [`illustrate_text`]
//! writes the figures of one text as files.
//!
//! A fenced code block with the language `drystone` contains a scene, or names a scene file with `file=…`. A figure with a
//! caption replaces the block. Options follow the word `drystone`, as `name=value` or
//! `name`:
//!
//! | option | meaning |
//! |---|---|
//! | `file=scene.json` | the scene file; its path is relative to the file of the chapter |
//! | `kind=mechanism` | the kind of figure: the name of a [`Kind`]; without this option, `forces` |
//! | `block=a` | the id of the block in a free-body diagram; not needed if the scene has only one block |
//! | `theme=dark` | the theme of the figure; `auto` follows the colours that the reader prefers |
//! | `width=600` | the width of the figure in pixels |
//! | `amounts` | the arrows have labels with their magnitudes, in frames with at most 60 blocks |
//! | `nocaption` | no caption below the figure |

use std::path::{Path, PathBuf};

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag};
use serde_json::Value;

use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::{BlockId, Scene};
use crate::pictures::drawing::{Drawing, Theme};
use crate::pictures::output::svg;
use crate::products::figure::{self, Kind, View};
use crate::read::file;
use crate::text;

/// Code blocks whose opening fence is followed by this word contain a scene, and are replaced by its figure.
const FENCE_WORD: &str = "drystone";

/// All problems found in a book, one message each.
#[derive(Debug, thiserror::Error)]
#[error("{}", .0.join("\n\n"))]
pub struct BookError(pub Vec<String>);

/// Draws the scenes of a book. `input` is the JSON text `[context, book]` that mdBook gives to a preprocessor.
/// Returns the JSON text of the book with figures.
///
/// # Errors
/// If the input is not the JSON of an mdBook preprocessor, or if scenes cannot be drawn. For each of these scenes,
/// the error states the chapter, the line and the reason.
pub fn illustrate(input: &str) -> Result<String, BookError> {
    let invalid = |why: &str| {
        BookError(vec![format!(
            "this is not the input of an mdBook preprocessor ({why}); mdbook runs the command itself, from \
             [preprocessor.drystone] in book.toml"
        )])
    };
    let mut input: Value = serde_json::from_str(input).map_err(|e| invalid(&e.to_string()))?;
    let root = PathBuf::from(input[0]["root"].as_str().unwrap_or("."));
    let source = input[0]["config"]["book"]["src"].as_str().unwrap_or("src");
    let source = root.join(source);
    let Some(mut book) = input.get_mut(1).map(Value::take) else {
        return Err(invalid("the JSON has no book after the context"));
    };
    let mut problems = Vec::new();
    // mdBook 0.5 uses the key `items` for the chapters, earlier versions use `sections`.
    let key = if book["items"].is_array() { "items" } else { "sections" };
    let Some(items) = book.get_mut(key).and_then(Value::as_array_mut) else {
        return Err(invalid("the JSON of the book has no list of chapters"));
    };
    for found in items.iter_mut().filter_map(|i| i.get_mut("Chapter")) {
        chapter(found, &source, &mut problems);
    }
    if problems.is_empty() { Ok(book.to_string()) } else { Err(BookError(problems)) }
}

/// A figure of a text, as a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Illustration {
    /// The name of the file.
    pub name: String,
    /// The picture.
    pub svg: String,
    /// The scene file.
    pub scene: String,
}

/// Draws the scenes in a Markdown text. `path` is its file. Returns the text, with references to pictures in place of the
/// scenes, and the pictures, whose names begin with `stem`.
///
/// # Errors
/// If scenes cannot be drawn. For each of these scenes, the error states the line and the reason.
pub fn illustrate_text(content: &str, path: &Path, stem: &str) -> Result<(String, Vec<Illustration>), BookError> {
    let (mut pictures, mut problems) = (Vec::new(), Vec::new());
    let drawn = illustrated(content, path, &mut problems, &mut |figure| {
        let name = format!("{stem}-{}.svg", pictures.len() + 1);
        let caption = text::markdown(&figure.caption);
        let below = if figure.shows_caption { format!("\n\n*{caption}*") } else { String::new() };
        let reference = format!("![{caption}](<{name}>){below}");
        pictures.push(Illustration { name, svg: figure.svg, scene: figure.scene });
        reference
    });
    if problems.is_empty() { Ok((drawn, pictures)) } else { Err(BookError(problems)) }
}

/// Draws the scenes in a chapter and in its sub-chapters. `source` is the folder of the chapter files. Adds a message
/// to `problems` for each scene that cannot be drawn.
fn chapter(chapter: &mut Value, source: &Path, problems: &mut Vec<String>) {
    let path = chapter["source_path"].as_str().or(chapter["path"].as_str());
    let path = source.join(path.unwrap_or("draft.md"));
    if let Some(content) = chapter.get_mut("content")
        && let Some(text) = content.as_str()
    {
        *content = Value::String(illustrated(text, &path, problems, &mut html));
    }
    if let Some(items) = chapter.get_mut("sub_items").and_then(Value::as_array_mut) {
        for below in items.iter_mut().filter_map(|i| i.get_mut("Chapter")) {
            self::chapter(below, source, problems);
        }
    }
}

/// Returns the text of a chapter with a figure in place of each code block of the language `drystone`. `path` is the
/// file of the chapter, and `placed` writes a figure as text. Adds a message to `problems` for each code block that
/// cannot be drawn.
fn illustrated(
    content: &str,
    path: &Path,
    problems: &mut Vec<String>,
    placed: &mut dyn FnMut(Figure) -> String,
) -> String {
    let mut drawn = String::new();
    let mut done = 0;
    let mut parser = Parser::new_ext(content, Options::all()).into_offset_iter();
    while let Some((event, place)) = parser.next() {
        let Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) = event else {
            continue;
        };
        let Some(options) =
            info.strip_prefix(FENCE_WORD).filter(|rest| rest.is_empty() || rest.starts_with([' ', ',', '\t']))
        else {
            continue;
        };
        let mut body = String::new();
        for (event, _) in parser.by_ref() {
            match event {
                Event::Text(text) => body.push_str(&text),
                _ => break,
            }
        }
        let line = content[..place.start].matches('\n').count() + 1;
        match figure(options, &body, path) {
            Ok(figure) => {
                let text = placed(figure);
                drawn.push_str(&content[done..place.start]);
                drawn.push_str(&text.replace('\n', &format!("\n{}", margin(content, place.start))));
                if !content[place.end..].starts_with("\n\n") {
                    drawn.push_str("\n\n");
                }
                done = place.end;
            }
            Err(why) => {
                let chapter = text::line(&path.display().to_string());
                problems.push(format!("{chapter}, line {line}: {why}"));
            }
        }
    }
    drawn.push_str(&content[done..]);
    drawn
}

/// Returns the indentation of a code block that begins at byte `start`: the text before its opening fence, in which
/// spaces replace all characters except `>`. Without this indentation, the figure would leave the list or quotation
/// that contains the code block.
fn margin(content: &str, start: usize) -> String {
    let line = content[..start].rfind('\n').map_or(0, |end| end + 1);
    let kept = |c: char| if c == '>' { c } else { ' ' };
    content[line..start].chars().map(kept).collect()
}

/// The options of a `drystone` code block.
struct FigureRequest {
    file: Option<String>,
    kind: String,
    block: Option<String>,
    caption: bool,
    /// Whether the figure follows the colours that the reader prefers.
    is_auto: bool,
    options: figure::Options,
}

/// A figure for a text.
struct Figure {
    svg: String,
    caption: String,
    /// Whether the caption stands below the figure.
    shows_caption: bool,
    /// The scene file.
    scene: String,
}

impl FigureRequest {
    fn read(words: &str) -> Result<FigureRequest, String> {
        let mut request = FigureRequest {
            file: None,
            kind: "forces".to_owned(),
            block: None,
            caption: true,
            is_auto: false,
            options: figure::Options::default(),
        };
        for word in words.split([' ', ',', '\t']).filter(|w| !w.is_empty()) {
            let (name, value) = word.split_once('=').unwrap_or((word, ""));
            match (name, value) {
                ("file", value) if !value.is_empty() => request.file = Some(value.to_owned()),
                ("kind", value) if !value.is_empty() => value.clone_into(&mut request.kind),
                ("block", value) if !value.is_empty() => request.block = Some(value.to_owned()),
                ("theme", "auto") => (request.is_auto, request.options.theme) = (true, Theme::plain()),
                ("theme", value) => {
                    request.options.theme = Theme::named(value)
                        .ok_or(format!("there is no theme {value:?}; known are {}, auto", Theme::NAMES.join(", ")))?;
                }
                ("width", value) => {
                    let width = value.parse().ok().filter(|w| (100.0..=4000.0).contains(w));
                    request.options.width = Some(width.ok_or("width= must be a number of pixels from 100 to 4000")?);
                }
                ("amounts", "") => request.options.amounts = true,
                ("nocaption", "") => request.caption = false,
                _ => {
                    return Err(format!(
                        "unknown option {word:?}; known are file=, kind=, block=, theme=, width=, amounts, nocaption"
                    ));
                }
            }
        }
        Ok(request)
    }
}

/// Returns the figure for a code block, or the reason why it cannot be drawn. `words` are the options of the code
/// block, `body` is its content, and `chapter` is the file of the chapter.
fn figure(words: &str, body: &str, chapter: &Path) -> Result<Figure, String> {
    let request = FigureRequest::read(words)?;
    let text = match &request.file {
        Some(named) => {
            let path = chapter.parent().unwrap_or(Path::new("")).join(named);
            let found = file::text(&path).map_err(|e| text::line(&format!("cannot read {}: {e}", path.display())))?;
            // The problems of a scene quote its file. No stranger's text may bring another file into a page or a log.
            if !found.contains("\"drystone\"") {
                return Err(text::line(&format!("{} is no scene file: it has no key \"drystone\"", path.display())));
            }
            found
        }
        None => body.to_owned(),
    };
    let scene = Scene::from_json(&text).map_err(|problems| {
        let whose = match &request.file {
            Some(file) => text::line(&format!("the scene {file} is not valid; lines are counted in that file")),
            None => "the scene is not valid; lines are counted from the first line of the block".to_owned(),
        };
        format!("{whose}:\n{problems}")
    })?;
    let analysis = Analysis::new(&scene);
    let light = drawing(&analysis, &request, request.options.clone())?;
    let words = svg::Options {
        // Text drawn as outlines looks the same on machines without the fonts.
        words: svg::Words::Outlines,
        ..svg::Options::default()
    };
    let svg = if request.is_auto {
        let options = figure::Options { theme: Theme::dark(), ..request.options.clone() };
        svg::write_pair(&light, &drawing(&analysis, &request, options)?, &words)
    } else {
        svg::write_with(&light, &words)
    };
    let caption = text::line(&figure::caption(&analysis));
    Ok(Figure { svg: svg.map_err(|e| e.to_string())?, caption, shows_caption: request.caption, scene: text })
}

/// Writes a figure as HTML.
fn html(figure: Figure) -> String {
    // An empty line would end the HTML block in Markdown.
    let lines: Vec<&str> = figure.svg.lines().filter(|l| !l.trim().is_empty()).collect();
    let caption = if figure.shows_caption {
        maud::html! { figcaption { (figure.caption) } }.into_string()
    } else {
        String::new()
    };
    format!("<figure class=\"drystone\" style=\"overflow-x: auto\">\n{}\n{caption}</figure>", lines.join("\n"))
}

fn drawing(analysis: &Analysis, request: &FigureRequest, options: figure::Options) -> Result<Drawing, String> {
    let name = request.kind.as_str();
    let known = || Kind::ALL.map(Kind::name).join(", ");
    let view =
        View::from_name(name).ok_or_else(|| format!("there is no kind of figure {name:?}; known are {}", known()))?;
    let (kind, mut options) = (view.kind, view.options(&options));
    if kind.shows_one_block() {
        let scene = analysis.given();
        let block = match &request.block {
            Some(id) => scene.blocks.iter().position(|b| b.id == *id),
            None => (scene.blocks.len() == 1).then_some(0),
        };
        let block = BlockId(block.ok_or("block= must be the id of a block in the scene")?);
        if !scene.frames.iter().any(|frame| frame.placed.contains(&block)) {
            return Err("no step of the scene places this block".to_owned());
        }
        options.block = Some(block);
    }
    Ok(figure::draw(analysis, kind, &options))
}
