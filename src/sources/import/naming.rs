//! [`Naming`]: decides from the names of elements which of them are ground or robots, and which are ignored.

use std::cell::RefCell;
use std::collections::BTreeSet;

use super::draft::Role;

/// Words that usually name the ground, in lower case. They are used only for drawings without other ground.
const GROUND_WORDS: [&str; 21] = [
    "abutment",
    "abutments",
    "bedrock",
    "boden",
    "earth",
    "footing",
    "footings",
    "foundation",
    "foundations",
    "fundament",
    "pier base",
    "pier bases",
    "soil",
    "sol",
    "springing",
    "suelo",
    "support",
    "supports",
    "terrain",
    "terreno",
    "widerlager",
];
/// The largest number of names that are kept for messages.
const MAX_KEPT_NAMES: usize = 1000;

/// The rules that determine the roles of elements from their names.
#[derive(Debug, Default)]
pub(super) struct Naming<'o> {
    /// Names of layers and elements that an option declares as ground.
    pub(super) ground: &'o [String],
    /// Whether a name such as "abutment" makes an element ground.
    pub(super) guess: bool,
    /// The names that became ground because of `ground` or a guess.
    made_ground: RefCell<BTreeSet<String>>,
    seen: RefCell<BTreeSet<String>>,
}

impl<'o> Naming<'o> {
    pub(super) fn new(ground: &'o [String], guess: bool) -> Naming<'o> {
        Naming { ground, guess, ..Naming::default() }
    }

    /// Returns the role of an element with this name. `None` if no role follows from the name.
    pub(super) fn role(&self, name: &str) -> Option<Role> {
        let name = name.trim();
        keep(&self.seen, name);
        if self.ground.iter().any(|g| same(g, name)) || (self.guess && is_ground_word(name)) {
            keep(&self.made_ground, name);
            return Some(Role::Ground);
        }
        Role::from_name(name)
    }

    /// Returns the names of elements that became ground because of an option or a guess, in alphabetical order.
    pub(super) fn made_ground(&self) -> Vec<String> {
        self.made_ground.borrow().iter().cloned().collect()
    }

    /// Returns the names of elements and layers in the drawing, at most 1000, in alphabetical order.
    pub(super) fn seen(&self) -> Vec<String> {
        self.seen.borrow().iter().cloned().collect()
    }

    /// Returns the names in the option `ground` that no element or layer of the drawing has.
    pub(super) fn missing(&self) -> Vec<&'o String> {
        let made = self.made_ground.borrow();
        let is_missing = |wanted: &&String| !made.iter().any(|name| same(wanted, name));
        self.ground.iter().filter(is_missing).collect()
    }
}

fn keep(names: &RefCell<BTreeSet<String>>, name: &str) {
    let mut names = names.borrow_mut();
    if !name.is_empty() && names.len() < MAX_KEPT_NAMES && !names.contains(name) {
        names.insert(name.to_owned());
    }
}

/// True if two names are equal, apart from upper and lower case.
fn same(a: &str, b: &str) -> bool {
    a.trim().to_lowercase() == b.trim().to_lowercase()
}

/// True if a name is a word for the ground, perhaps followed by a number or other words: `Abutments`, `support_2`.
fn is_ground_word(name: &str) -> bool {
    let name = name.to_lowercase();
    GROUND_WORDS.iter().any(|word| name.strip_prefix(word).is_some_and(|rest| !rest.starts_with(char::is_alphabetic)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_the_ground_are_guessed_on_request() {
        let guess = Naming::new(&[], true);
        for name in ["Abutments", "support_2", "Pier base left", "SOL", "Boden"] {
            assert_eq!(guess.role(name), Some(Role::Ground), "{name}");
        }
        for name in ["solid", "supporting", "pier", "stone", ""] {
            assert_eq!(guess.role(name), None, "{name}");
        }
        assert_eq!(guess.made_ground().len(), 5);
        assert_eq!(Naming::default().role("Abutments"), None);
        let layers = ["Pfeiler".to_owned(), "Felsen".to_owned()];
        let given = Naming::new(&layers, false);
        assert_eq!(given.role("pfeiler "), Some(Role::Ground));
        assert_eq!(given.missing(), [&layers[1]]);
    }
}
