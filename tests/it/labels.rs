//! Labels cover neither other labels nor lines. This is measured on the finished drawings, independently of the code
//! that places the labels.

mod pages;

use drystone::analysis::Analysis;
use drystone::drawing::{Anchor, Drawing, Face, Group, Item, PagePoint, Segment, Text, text};
use drystone::figure::{self, Options};
use drystone::scene::BlockId;

use crate::lines::contributed;
use crate::pictures::{gallery, scene};

/// An axis-parallel box: left, top, right, bottom.
pub(crate) type Box4 = [f64; 4];

/// The inked area of a text: from the height of capitals to the baseline, and down to its descenders if it has any.
pub(crate) fn ink(text: &Text) -> Box4 {
    let wide = text::width(&text.words, text.face, text.size);
    let left = match text.anchor {
        Anchor::Start => text.at.x,
        Anchor::Middle => text.at.x - wide / 2.0,
        Anchor::End => text.at.x - wide,
    };
    let deep = if text.words.contains(['g', 'j', 'p', 'q', 'y', 'µ', '(', ')', ',']) { 0.2 } else { 0.0 };
    [left, text.at.y - 0.72 * text.size, left + wide, text.at.y + deep * text.size]
}

fn union(a: Box4, b: Box4) -> Box4 {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

pub(crate) fn texts(group: &Group) -> Vec<Text> {
    let mut found = Vec::new();
    for item in &group.items {
        match item {
            Item::Text(text) => found.push(text.clone()),
            Item::Group(inner) => found.extend(texts(inner)),
            Item::Path(_) => {}
        }
    }
    found
}

/// All groups of a class, including those inside other groups.
fn of_class<'d>(items: &'d [Item], class: &str, found: &mut Vec<&'d Group>) {
    for item in items {
        if let Item::Group(group) = item {
            if group.class == class {
                found.push(group);
            }
            of_class(&group.items, class, found);
        }
    }
}

pub(crate) fn classes<'d>(items: &'d [Item], wanted: &[&str]) -> Vec<&'d Group> {
    let mut found = Vec::new();
    for class in wanted {
        of_class(items, class, &mut found);
    }
    found
}

/// The straight segments of a group's own paths; curves are replaced by their control polygons.
pub(crate) fn pieces(group: &Group) -> Vec<[PagePoint; 2]> {
    let mut pieces = Vec::new();
    for item in &group.items {
        let Item::Path(path) = item else { continue };
        // The seams between the cells of a block are not edges; its filled outline is.
        if group.class == "block" && path.fill.is_none() {
            continue;
        }
        let (mut start, mut last) = (None, None);
        for segment in &path.outline.segments {
            let points = match segment {
                Segment::Move(p) => {
                    (start, last) = (Some(*p), Some(*p));
                    vec![]
                }
                Segment::Line(p) => vec![*p],
                Segment::Curve(a, b, c) => vec![*a, *b, *c],
                Segment::Close => start.into_iter().collect(),
            };
            for point in points {
                pieces.extend(last.map(|from| [from, point]));
                last = Some(point);
            }
        }
    }
    pieces
}

/// Whether a segment passes through the inside of a box.
pub(crate) fn through([a, b]: [PagePoint; 2], bounds: Box4) -> bool {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (start, along, low, high) in [(a.x, b.x - a.x, bounds[0], bounds[2]), (a.y, b.y - a.y, bounds[1], bounds[3])] {
        if along == 0.0 {
            if start <= low || start >= high {
                return false;
            }
        } else {
            let (p, q) = ((low - start) / along, (high - start) / along);
            from = from.max(p.min(q));
            to = to.min(p.max(q));
        }
    }
    from < to
}

/// The number of labels in a drawing, and a complaint for each label whose ink lies on another label or on a path of
/// a class in `barred`.
pub(crate) fn hidden(items: &[Item], labels: &[&str], barred: &[&str]) -> (usize, Vec<String>) {
    let mut labelled: Vec<(String, Box4)> = Vec::new();
    for label in classes(items, labels) {
        let all = texts(label);
        let words: String = all.iter().map(|t| t.words.as_str()).collect();
        if let Some(bounds) = all.iter().map(ink).reduce(union) {
            labelled.push((words, bounds));
        }
    }
    let mut complaints = Vec::new();
    for (i, (words, a)) in labelled.iter().enumerate() {
        for (other, b) in &labelled[..i] {
            if a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3] {
                complaints.push(format!("{words} lies on {other}"));
            }
        }
        for group in classes(items, barred) {
            if pieces(group).iter().any(|piece| through(*piece, *a)) {
                complaints.push(format!("{words} lies on {} {}", group.class, group.title));
            }
        }
    }
    (labelled.len(), complaints)
}

/// The panels of a drawing.
fn panels(drawing: &Drawing) -> Vec<&[Item]> {
    let frames = classes(&drawing.items, &["picture"]);
    frames.iter().map(|g| g.items.as_slice()).collect()
}

#[test]
fn names_and_magnitudes_cover_nothing_in_the_gallery() {
    let mut count = 0;
    for amounts in [false, true] {
        let options = Options::default().amounts(amounts);
        for (name, scene) in gallery() {
            let drawing = figure::forces(&Analysis::new(&scene), &options);
            for items in panels(&drawing) {
                // Amounts have a halo, and may lie on the edge of a block.
                let barred = ["robot", "force", "torque", "load", "missing"];
                let (labels, complaints) = hidden(items, &["name", "amount"], &barred);
                count += labels;
                assert!(complaints.is_empty(), "{name}: {complaints:?}");
            }
        }
    }
    assert!(count > 150, "only {count} labels were checked");
}

/// The width of a column of a journal, 84 mm, in pixels that are printed at 0.8 of their natural size.
pub(crate) const COLUMN: f64 = 84.0 / 25.4 * 96.0 / 0.8;

/// The width of two columns, 174 mm.
const TWO_COLUMNS: f64 = 174.0 / 25.4 * 96.0 / 0.8;

/// Whether a text contains a name as a separate word.
fn names(text: &str, name: &str) -> bool {
    let apart = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
    // A number is a name only at the end of a phrase or before a word that continues a sentence about a block. Before a
    // unit or a noun it is an amount or a count.
    let is_number = !name.contains(char::is_alphabetic);
    let may_follow = |rest: &str| {
        let word = rest.trim_start_matches([' ', '\u{a0}', '\u{202f}']);
        let verbs = ["and ", "or ", "falls", "fall ", "is ", "are ", "at ", "in ", "on ", "under ", "with "];
        word.is_empty()
            || word.starts_with([',', '.', ';', ':', ')'])
            || verbs.iter().any(|verb| word.starts_with(verb))
    };
    // Digits on both sides of a point form one number.
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let goes_on = |rest: &str| rest.starts_with('.') && digit(rest.chars().nth(1));
    let began = |before: &str| before.ends_with('.') && digit(before.chars().rev().nth(1));
    text.match_indices(name).any(|(at, _)| {
        let (before, rest) = (&text[..at], &text[at + name.len()..]);
        apart(before.chars().next_back())
            && apart(rest.chars().next())
            && (!is_number || may_follow(rest))
            && !goes_on(rest)
            && !began(before)
    })
}

/// The words below a picture name no block that has no name in the picture. Titles of the author may name any block.
#[test]
fn blocks_that_the_words_below_a_frame_name_have_labels() {
    let mut named = 0;
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let options = drystone::analysis::Options::default();
        let analysis = Analysis::with(
            &scene,
            &match drystone::analysis::CapacityRequest::default_for(&scene) {
                Some(request) => options.capacity(request),
                None => options,
            },
        );
        use figure::Kind::{Capacity, Compare, Forces, Mechanism, Thrust};
        for width in [None, Some(COLUMN)] {
            let mut options = Options::default();
            options.width = width;
            for kind in [Forces, Mechanism, Thrust, Capacity, Compare] {
                let drawing = figure::draw(&analysis, kind, &options);
                let what = format!("{name} {} {width:?}", kind.name());
                let frames = classes(&drawing.items, &["frame"]);
                assert_eq!(frames.len(), scene.frames().len(), "{what}");
                for (frame, group) in scene.frames().iter().zip(frames) {
                    let own = group.items.iter().filter_map(|item| match item {
                        Item::Text(text) if text.face == Face::Sans => Some(text.words.as_str()),
                        _ => None,
                    });
                    let below = own.collect::<Vec<&str>>().join(" ");
                    let labels = classes(&group.items, &["name"]);
                    let labels: Vec<String> = labels.into_iter().flat_map(texts).map(|text| text.words).collect();
                    let blocks = frame.placed.iter().map(|id| &scene.blocks()[id.0].id);
                    // Some blocks have the name of a direction.
                    let is_block = |id: &&String| !["left", "right"].contains(&id.as_str());
                    let named_below = |id: &&String| names(&below, id) && !names(&frame.title, id);
                    for id in blocks.filter(is_block).filter(named_below) {
                        named += 1;
                        assert!(labels.contains(id), "{what}: {id} of {below:?} has no label");
                    }
                }
            }
        }
    }
    assert!(named > 60, "{named} named");
}

#[test]
fn a_figure_zoomed_to_a_block_names_it_and_draws_its_forces() {
    let scene = scene("tests/scenes/tinyhuge.json");
    let pebble = scene.blocks().iter().position(|b| b.id == "pebble").expect("there is one");
    let options = Options::default().zoom(BlockId(pebble));
    let drawing = figure::forces(&Analysis::new(&scene), &options);
    let layers = classes(&drawing.items, &["blocks", "forces"]);
    assert!(!layers.is_empty() && layers.iter().all(|layer| layer.clip.is_some()));
    let labels: Vec<String> = classes(&drawing.items, &["name"]).into_iter().flat_map(texts).map(|t| t.words).collect();
    assert!(labels.contains(&"pebble".to_owned()), "{labels:?}");
    // The block and its name lie on the page.
    let block = classes(&drawing.items, &["block"])[0];
    let corners = pieces(block).concat();
    let is_on_page = |at: &PagePoint| (0.0..=drawing.width).contains(&at.x) && (0.0..=drawing.height).contains(&at.y);
    assert!(corners.iter().all(is_on_page), "{corners:?}");
    let forces = classes(&drawing.items, &["force"]);
    assert!(forces.iter().any(|f| f.title.contains("between pebble") || f.title.contains("and pebble")));
    let page = Group { items: drawing.items.clone(), ..Group::default() };
    assert!(texts(&page).iter().any(|t| t.words == "around block pebble"));
}

#[test]
fn the_measurement_finds_a_hidden_label() {
    let scene = scene("assets/thesis/figure-4.json");
    let drawing = figure::forces(&Analysis::new(&scene), &Options::default());
    let mut items = panels(&drawing)[0].to_vec();
    let weight = classes(&items, &["force"])[0];
    let at = pieces(weight)[0][0];
    let words = Text::new(at, "hidden", drystone::drawing::Face::Sans, 12.0, drystone::drawing::Colour::BLACK)
        .anchored(Anchor::Middle);
    items.push(Group::with_class("name").with(words).into());
    let (_, complaints) = hidden(&items, &["name"], &["force"]);
    assert!(complaints.iter().any(|c| c.starts_with("hidden lies on")), "{complaints:?}");
}
