//! Reads SVG from Inkscape, Illustrator and other programs into a [`Draft`].
//!
//! 1. Parse the XML and the style sheets.
//! 2. Walk the tree ([`SvgWalk`]). Each element inherits the transform, the style and the role of the group around
//!    it.
//! 3. Convert shapes to subpaths in metres, with y up.
//!
//! Elements that are drawn but cannot become a body are reported.

mod context;
mod element;
mod figure;
mod name;
mod path;
mod shape;
mod style;
mod viewport;
mod walk;
mod xml;

use std::collections::BTreeMap;

use roxmltree::{Document, Node, ParsingOptions};
use simplecss::{Rule, StyleSheet};

use self::name::Lines;
use self::walk::{MAX_CLIP_CORNERS, MAX_DEPTH, SvgWalk};
use self::xml::{is, words};
use super::draft::{Draft, Scale};
use super::limit::too_many;
use super::naming::Naming;

/// The largest number of comparisons of a part of the selector of a style rule with an element. Each may take half a
/// microsecond, if the rule applies.
const MAX_RULE_MATCHES: usize = 5_000_000;

/// The largest number of style rules. Reading them takes a time that grows with its square: 0.8 s for 5000.
const MAX_RULES: usize = 5_000;

/// The number of bytes of an attribute that a selector reads in the time of one comparison.
const BYTES_PER_MATCH: usize = 64;

/// Reads an SVG into a draft in metres, with y up. `frame` selects a frame of a figure that drystone drew, counted from
/// 0.
///
/// # Errors
/// Returns the reason why the text cannot be read as SVG.
pub(super) fn read(text: &str, scale: Scale, frame: Option<usize>, naming: &Naming<'_>) -> Result<Draft, String> {
    xml::check_cost(text)?;
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| e.to_string())?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let found = root.tag_name().name();
        return Err(format!("its root element is <{found}> and not <svg>"));
    }
    let css = style_text(&document);
    let listed = css.matches('{').count();
    if listed > MAX_RULES {
        return Err(format!(
            "its {listed} style rules are too many, at most {MAX_RULES} are read; simplify its styles"
        ));
    }
    let sheet = StyleSheet::parse(&css);
    let (rules, elements) = (sheet.rules.len(), document.descendants().filter(Node::is_element).count());
    let mut walk = SvgWalk {
        comparisons: comparisons(&sheet, &document),
        reads_all: css.contains('['),
        moves: css.contains("transform"),
        sheet,
        naming,
        styled: 0,
        ids: ids(&document),
        lines: Lines::new(text),
        draft: Draft::default(),
        seen: 0,
        more: 0,
        clip_corners: 0,
    };
    if let Some(title) = root.children().find(|n| is(*n, "title")) {
        walk.draft.title = words(title);
    }
    if let Some(pictures) = figure::frames(root) {
        if scale.ratio.is_some() {
            return Err("a figure by drystone contains its own scale; leave out --scale 1:N".into());
        }
        walk.figure(&pictures, scale.metres, frame)?;
    } else if frame.is_some() {
        return Err("--frame needs a figure by drystone; this drawing has no frames".into());
    } else {
        walk.drawing(root, scale)?;
    }
    let refusal = if walk.styled > MAX_RULE_MATCHES {
        format!("its {rules} style rules and {elements} elements need too many comparisons; simplify its styles")
    } else if walk.clip_corners > MAX_CLIP_CORNERS {
        format!(
            "its clip paths have more than {MAX_CLIP_CORNERS} corners in all clipped elements; cut the outlines themselves"
        )
    } else if walk.more > 0 {
        too_many(walk.draft.parts.len() + walk.more).message
    } else {
        return Ok(walk.draft);
    };
    Err(refusal)
}

/// Returns the largest number of comparisons that the style rules need for one element. A selector with k spaces, such as
/// `g g path`, may try every ancestor at each space: up to depthᵏ comparisons.
fn comparisons(sheet: &StyleSheet<'_>, document: &Document<'_>) -> usize {
    let depth = document.descendants().map(|node| node.ancestors().take(MAX_DEPTH).count()).max().unwrap_or(0);
    let of_rule = |rule: &Rule<'_>| {
        let selector = rule.selector.to_string();
        let signs = selector.split(' ').filter(|word| matches!(*word, ">" | "+")).count();
        let ancestors = selector.matches(' ').count().saturating_sub(2 * signs);
        depth.saturating_pow(ancestors.try_into().unwrap_or(u32::MAX)).saturating_mul(1 + signs)
    };
    sheet.rules.iter().map(of_rule).fold(0, usize::saturating_add)
}

/// Returns how many comparisons the selectors of one style rule take for an element: they may read its classes, or all of
/// its attributes.
fn weight(node: Node<'_, '_>, reads_all: bool) -> usize {
    let read = node.attributes().filter(|own| reads_all || own.name() == "class");
    1 + read.map(|own| own.value().len()).sum::<usize>() / BYTES_PER_MATCH
}

/// Returns the text of all `<style>` elements.
fn style_text(document: &Document<'_>) -> String {
    let mut css = String::new();
    for node in document.descendants().filter(|n| is(*n, "style")) {
        for segment in node.children().filter_map(|c| c.text()) {
            css += segment;
            css.push('\n');
        }
    }
    css
}

/// Returns a map from ids to elements. If several elements have the same id, the map contains the first of them.
fn ids<'a, 'd>(document: &'a Document<'d>) -> BTreeMap<&'a str, Node<'a, 'd>> {
    let mut ids = BTreeMap::new();
    for node in document.descendants() {
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
    }
    ids
}
