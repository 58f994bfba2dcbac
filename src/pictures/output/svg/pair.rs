//! [`merged`]: one SVG for light and dark pages.

use std::collections::{BTreeMap, BTreeSet};

/// The beginning of a value that is a colour.
const COLOUR: &str = "=\"#";
/// The number of its digits.
const DIGITS: usize = 6;

/// Merges two documents of a drawing in a light and a dark theme; they may differ only in colours, and all ids in them
/// begin with `mark`. The result is the light document with a style sheet, which gives each colour its dark one if the
/// reader prefers dark pages. Programs without style sheets show the light picture.
///
/// A rule of the style sheet finds its elements by their light colour. A light colour that stands for a second dark colour
/// is changed by at least 1/255, which is not visible. Returns `None` if the documents differ in more than colours.
pub(super) fn merged(light: &str, dark: &str, mark: &str) -> Option<String> {
    let mut dark_of: BTreeMap<u32, u32> = BTreeMap::new();
    let mut rules = BTreeSet::new();
    let (mut parts, mut others) = (light.split(COLOUR), dark.split(COLOUR));
    let first = parts.next().filter(|part| Some(*part) == others.next())?;
    let (mut text, mut before) = (first.to_owned(), first);
    for part in parts {
        let (colour, other) = (part.get(..DIGITS)?, others.next()?);
        let after = &part[DIGITS..];
        if other.get(DIGITS..)? != after {
            return None;
        }
        let [colour, other] = [colour, &other[..DIGITS]].map(|digits| u32::from_str_radix(digits, 16).ok());
        let (colour, other) = (colour?, other?);
        let is_free = |candidate: &u32| *dark_of.get(candidate).unwrap_or(&other) == other;
        let colour = (0..256).map(|change| colour ^ change).find(is_free)?;
        dark_of.insert(colour, other);
        if colour != other {
            rules.insert((before.rsplit(' ').next()?, colour, other));
        }
        text.push_str(&format!("{COLOUR}{colour:06x}{after}"));
        before = after;
    }
    if others.next().is_some() {
        return None;
    }
    let rule = |(name, colour, other): (&str, u32, u32)| {
        format!(".{mark} [{name}{COLOUR}{colour:06x}\"]{{{name}:#{other:06x}}}\n")
    };
    let rules: String = rules.into_iter().map(rule).collect();
    let sheet = format!("</desc>\n<style>\n@media (prefers-color-scheme: dark) {{\n{rules}}}\n</style>\n");
    Some(text.replacen("<svg ", &format!("<svg class=\"{mark}\" "), 1).replacen("</desc>\n", &sheet, 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_colour_with_two_dark_ones_is_changed_a_little() {
        let text = |one: &str, other: &str| {
            format!(
                "<svg width=\"9\"><desc></desc>\n<a fill=\"#{one}\"/><b fill=\"#{other}\" stroke=\"#{one}\"/></svg>"
            )
        };
        let merged = merged(&text("ffffff", "ffffff"), &text("000000", "111111"), "m").expect("equal but for colours");
        assert_eq!(
            merged,
            "<svg class=\"m\" width=\"9\"><desc></desc>\n<style>\n@media (prefers-color-scheme: dark) {\n\
             .m [fill=\"#fffffe\"]{fill:#111111}\n.m [fill=\"#ffffff\"]{fill:#000000}\n\
             .m [stroke=\"#ffffff\"]{stroke:#000000}\n}\n</style>\n\
             <a fill=\"#ffffff\"/><b fill=\"#fffffe\" stroke=\"#ffffff\"/></svg>"
        );
        let light = text("ffffff", "eeeeee");
        for other in
            [light.replace("<b", "<c"), light.replace("/></svg>", "/><i fill=\"#000000\"/></svg>"), String::new()]
        {
            assert_eq!(super::merged(&light, &other, "m"), None, "{other}");
        }
    }
}
