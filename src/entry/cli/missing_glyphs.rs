//! Finds characters of scenes that neither the built-in fonts nor the fonts of `--font` have. A warning names these
//! characters, and figures show their code points.

use std::borrow::Cow;

use crate::entry::cli::page::Page;
use crate::entry::cli::source::Source;
use crate::entry::cli::terminal::Terminal;
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::Item;
use crate::pictures::output::fonts::Fonts;
use crate::text::and_more;

/// Prints a warning for each scene with characters that no font has.
pub(crate) fn warn(sources: &[Source], fonts: &Fonts, terminal: &Terminal) {
    for source in sources {
        let lacking = fonts.lacking(&words(&source.scene).join(" "));
        if lacking.is_empty() {
            continue;
        }
        let shown: Vec<String> = lacking.iter().take(20).map(|c| character(*c)).collect();
        let more = and_more(lacking.len() - shown.len());
        terminal.complain(&Page::new(&format!(
            "warning: {}: no font has {}{more}; they are shown as code points. Give a font that has them with \
             --font FILE",
            source.name(),
            shown.join(" ")
        )));
    }
}

/// True if a scene has characters that no font has.
pub(crate) fn lacks(scene: &Scene, fonts: &Fonts) -> bool {
    !fonts.lacking(&words(scene).join(" ")).is_empty()
}

/// Returns the texts of a scene that figures show.
fn words(scene: &Scene) -> Vec<&str> {
    let blocks = scene.blocks.iter().map(|b| b.id.as_str());
    let robots = scene.robots.iter().map(|r| r.id.as_str());
    let frames = scene.frames.iter().map(|f| f.title.as_str());
    let titles = [&scene.title, &scene.author, &scene.project, &scene.date];
    let titles = titles.into_iter().map(String::as_str);
    let loads = scene.load_ids.iter().flatten().map(String::as_str);
    titles.chain(frames).chain(blocks).chain(robots).chain(loads).collect()
}

/// Returns a copy of the scene in which code points replace the characters that no font has.
pub(crate) fn legible(scene: &Scene, fonts: &Fonts) -> Scene {
    let mut scene = scene.clone();
    let spell = |words: &mut String| {
        if let Cow::Owned(spelled) = fonts.spelled(words) {
            *words = spelled;
        }
    };
    spell(&mut scene.title);
    spell(&mut scene.author);
    spell(&mut scene.project);
    spell(&mut scene.date);
    scene.frames.iter_mut().for_each(|f| spell(&mut f.title));
    scene.blocks.iter_mut().for_each(|b| spell(&mut b.id));
    scene.robots.iter_mut().for_each(|r| spell(&mut r.id));
    scene.load_ids.iter_mut().flatten().for_each(spell);
    scene
}

/// Replaces the characters of a drawing that no font has by code points.
pub(crate) fn spell(item: &mut Item, fonts: &Fonts) {
    match item {
        Item::Text(text) => text.words = fonts.spelled(&text.words).into_owned(),
        Item::Group(group) => group.items.iter_mut().for_each(|item| spell(item, fonts)),
        Item::Path(_) => {}
    }
}

/// Returns a letter or digit with its code point, such as `א (U+05D0)`. For any other character, returns only the code
/// point, because a combining character would change the characters next to it.
fn character(c: char) -> String {
    let number = format!("U+{:04X}", u32::from(c));
    if c.is_alphanumeric() { format!("{c} ({number})") } else { number }
}
